//! What a link asks for: lines `key=value`, as `scene=twin_disc`, `S=0.5`, `nodes=129`, or any key of a scene.

use std::fmt::Write as _;
use std::path::Path;
use std::sync::Arc;

use crate::tui::app::App;
use crate::tui::lessons::{Lesson, built_in};
use crate::tui::theme::Contrast;
use asperity_engine::files::give_file;
use asperity_engine::plan::Plan;
use asperity_engine::scene::{
    Knob, MapEdge, MapLevel, MapOutliers, Override, Scene, SceneError, Surface, presets,
};

/// Nodes per side of the finest mesh unless asked for: a page has one thread, and climbs to it from the first life on.
const NODES: usize = 129;
/// Maximum number of nodes per side in a page.
const MAX_NODES: usize = 257;
/// Maximum size of a link or file, bytes.
const MAX_BYTES: usize = 256 << 10;
/// Keys of a link that are no keys of a scene.
const KEYS: &str = "scene, lesson, nodes, contrast, S, load, A1, A2, U or a key of a scene";

/// What is to be shown.
pub(super) struct PageLink {
    /// The scene.
    pub(super) scene: Scene,
    /// Its name.
    pub(super) name: String,
    /// Nodes per side; `None`: as the page has them.
    pub(super) nodes: Option<usize>,
    /// A lesson to begin with.
    pub(super) lesson: Option<Arc<Lesson>>,
    /// Contrast.
    pub(super) contrast: Contrast,
    /// Its keys of a scene, as a link has them.
    pub(super) keys: String,
}

impl PageLink {
    /// Reads the lines of a link.
    pub(super) fn read(text: &str) -> Result<Self, String> {
        if text.len() > MAX_BYTES {
            return Err(format!("a link of {} bytes is refused", text.len()));
        }
        let mut name = presets::QUICK.to_owned();
        let (mut nodes, mut lesson, mut contrast) = (None, None, Contrast::default());
        let (mut overrides, mut knobs) = (Vec::<Override>::new(), Vec::new());
        let mut keys = Vec::new();
        for line in text.lines().filter(|line| !line.trim().is_empty()) {
            let (key, value) = line.split_once('=').ok_or_else(|| not_a_pair(line))?;
            let (key, value) = (key.trim(), value.trim());
            match key {
                "scene" => value.clone_into(&mut name),
                "nodes" => nodes = Some(nodes_of(value)?),
                "lesson" => lesson = Some(lesson_of(value)?),
                "contrast" => contrast = contrast_of(value)?,
                "S" | "load" | "A1" | "A2" | "U" => knobs.push((key, number(key, value)?)),
                _ if key.contains('.') => {
                    overrides.push(line.parse::<Override>().map_err(|e| e.to_string())?);
                    keys.push(format!("&{key}={}", escaped(value)));
                }
                _ => return Err(format!("{} is not a key of a link: {KEYS}", said(key))),
            }
        }
        if presets::find(&name).is_none() {
            let names: Vec<&str> = presets::listed().map(|preset| preset.name).collect();
            let names = names.join(", ");
            return Err(format!("{} is not a scene: {names}", said(&name)));
        }
        if let Some(set) = presets::opening(&name) {
            overrides.insert(0, set.parse().map_err(|e: SceneError| e.to_string())?);
        }
        let mut scene = Scene::load_with(&name, &overrides).map_err(|e| e.to_string())?;
        for (key, value) in knobs {
            turn(&mut scene, key, value)?;
        }
        Ok(Self {
            scene: whole(&scene)?,
            name,
            nodes,
            lesson,
            contrast,
            keys: keys.concat(),
        })
    }

    /// Reads a file's text: a lesson if it has beats, else a scene.
    pub(super) fn from_file(text: &str) -> Result<Self, String> {
        if text.len() > MAX_BYTES {
            return Err(format!("a file of {} bytes is refused", text.len()));
        }
        if text.lines().any(|line| line.trim() == "[[beat]]") {
            let lesson = Lesson::from_toml(text, "the lesson").map_err(|e| e.to_string())?;
            return Ok(Self {
                lesson: Some(Arc::new(lesson)),
                ..Self::read("")?
            });
        }
        Ok(Self {
            scene: Scene::from_toml(text).map_err(|e| e.to_string())?,
            name: "scene".to_owned(),
            ..Self::read("")?
        })
    }
}

/// What is shown with a measured surface on body 1, from a file that was dropped: its name, a line end, its bytes. As `asperity
/// surface` puts it into a scene: repeated, its plane taken off.
pub(super) fn with_map(
    (shown, nodes): (String, usize),
    dropped: &[u8],
) -> Result<PageLink, String> {
    let end = dropped.iter().position(|byte| *byte == b'\n');
    let (name, bytes) = dropped.split_at(end.unwrap_or(0));
    let name = String::from_utf8_lossy(name);
    let name = name.rsplit(['/', '\\']).next().unwrap_or_default();
    give_file(name, bytes.get(1..).unwrap_or_default().to_vec());
    let mut scene = Scene::from_toml(&shown).map_err(|e| e.to_string())?;
    scene.title = format!("{name} on body 1");
    scene.body_1.surface = Surface::HeightMap {
        file: name.to_owned(),
        pixel_m: None,
        edge: MapEdge::Periodic,
        unit_m: None,
        level: Some(MapLevel::Plane),
        outliers: MapOutliers::default(),
        amplitude_m: None,
        crop_m: None,
        turn_deg: None,
        s_filter_m: None,
        l_filter_m: None,
        start_x_m: None,
        digest: None,
        map: None,
    };
    scene
        .read_maps(Path::new(""))
        .map_err(|error| format!("{error}; or drop a scene that names {} with it", said(name)))?;
    Ok(PageLink {
        scene: whole(&scene)?,
        name: "scene".to_owned(),
        nodes: Some(nodes),
        ..PageLink::read("")?
    })
}

/// The scene on so many nodes, `None`: on the page's or its own fewer ones, or on as many more as it needs and has; and its plan.
pub(super) fn on_nodes(scene: &Scene, nodes: Option<usize>) -> Result<(Scene, Plan), String> {
    let own = scene.grid.nodes.min(MAX_NODES);
    let mut scene = scene.clone();
    // No recorder here.
    scene.record = None;
    let mut nodes = nodes.unwrap_or(NODES.min(own));
    loop {
        scene.grid.nodes = nodes;
        match Plan::new(&scene) {
            Ok(plan) => return Ok((scene, plan)),
            Err(error) if nodes >= own => return Err(error.to_string()),
            Err(_) => nodes = (2 * nodes - 1).min(own),
        }
    }
}

/// The link that shows what is shown now: the scene's name, nodes, its keys in the link that opened it, and the knobs that
/// were turned.
pub(super) fn written(app: &App, nodes: usize, keys: &str) -> String {
    let turned = app
        .choice
        .dials
        .iter()
        .filter(|dial| dial.target != dial.home);
    let knobs = turned.map(|dial| format!("&{}={}", short(dial.knob), dial.target));
    let knobs: String = knobs.collect();
    format!("scene={}&nodes={nodes}{keys}{knobs}", app.run.setup.name)
}

/// A value in an address: what is no letter, digit or plain sign as `%` and its bytes.
fn escaped(value: &str) -> String {
    let mut text = String::with_capacity(value.len());
    for byte in value.bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'-' | b'_' | b'.' => {
                text.push(char::from(byte));
            }
            // Writing to a string cannot fail.
            _ => drop(write!(text, "%{byte:02X}")),
        }
    }
    text
}

/// A knob's name in links.
fn short(knob: Knob) -> &'static str {
    match knob {
        Knob::SlideRoll => "S",
        Knob::ForceN | Knob::ForceNPerM => "load",
        Knob::Amplitude1M => "A1",
        Knob::Amplitude2M => "A2",
        Knob::EntrainmentMS => "U",
    }
}

/// The scene, checked as one that is read.
fn whole(scene: &Scene) -> Result<Scene, String> {
    Scene::from_toml(&scene.to_toml()).map_err(|e| e.to_string())
}

fn turn(scene: &mut Scene, key: &str, value: f64) -> Result<(), String> {
    let (load, mut knobs) = (Knob::of_load(scene.contact.kind), Knob::ALL.into_iter());
    let is_named = |knob: &Knob| short(*knob) == key && (!knob.is_load() || *knob == load);
    let Some(knob) = knobs.find(is_named) else {
        return Err(format!("{key} is not a knob"));
    };
    if knob.surface(scene).is_none() && knob.body().is_some() {
        return Err(format!("{key}: the surface of that body has no amplitude"));
    }
    if !knob.takes(value) {
        return Err(format!("{key} = {value} is refused"));
    }
    knob.put(scene, value);
    Ok(())
}

fn number(key: &str, value: &str) -> Result<f64, String> {
    let number = value.parse().ok().filter(|value: &f64| value.is_finite());
    number.ok_or_else(|| format!("{key} = {} is not a number", said(value)))
}

fn nodes_of(value: &str) -> Result<usize, String> {
    let nodes = value
        .parse()
        .ok()
        .filter(|nodes: &usize| (33..=MAX_NODES).contains(nodes) && (nodes - 1).is_power_of_two());
    nodes.ok_or_else(|| format!("nodes = {} is refused: 33, 65, 129 or 257", said(value)))
}

fn lesson_of(value: &str) -> Result<Arc<Lesson>, String> {
    let place = crate::tui::lessons::FILES
        .iter()
        .position(|(name, _)| *name == value);
    let lesson = place.and_then(|place| built_in().get(place).cloned());
    lesson.ok_or_else(|| {
        let names = crate::tui::lessons::FILES.map(|(name, _)| name).join(", ");
        format!("{} is not a lesson: {names}", said(value))
    })
}

fn contrast_of(value: &str) -> Result<Contrast, String> {
    match value {
        "normal" => Ok(Contrast::Normal),
        "high" => Ok(Contrast::High),
        "light" => Ok(Contrast::Light),
        _ => Err(format!(
            "contrast = {} is refused: normal, high or light",
            said(value)
        )),
    }
}

fn not_a_pair(line: &str) -> String {
    format!("{} is not key=value", said(line))
}

/// What came from outside, for a message.
fn said(text: &str) -> String {
    let text: String = text.chars().filter(|c| !c.is_control()).take(40).collect();
    format!("\"{text}\"")
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "tests")]
    use super::*;

    fn refused(text: &str) -> String {
        match PageLink::read(text) {
            Ok(_) => panic!("{text:?} is taken"),
            Err(reason) => reason,
        }
    }

    #[test]
    fn a_link_turns_knobs_and_sets_keys() {
        let link = "scene=twin_disc\nS=0.2\nload=900\nnodes=129\ncontrast=light\n\nlubricant.viscosity_pa_s=0.02";
        let link = PageLink::read(link).unwrap();
        assert_eq!((link.name.as_str(), link.nodes), ("twin_disc", Some(129)));
        assert_eq!(link.contrast, Contrast::Light);
        assert_eq!(link.scene.motion.slide_roll, 0.2);
        let load = Knob::of_load(link.scene.contact.kind);
        assert!([Knob::ForceN, Knob::ForceNPerM].contains(&load));
        assert_eq!(link.scene.lubricant.unwrap().viscosity_pa_s(), 0.02);
        let nothing = PageLink::read("").unwrap();
        assert_eq!(
            (nothing.name.as_str(), nothing.nodes),
            (presets::QUICK, None)
        );
        assert!(PageLink::read("lesson=load").unwrap().lesson.is_some());
    }

    /// What is refused, and the word that says which part of it.
    #[test]
    fn hostile_links_are_refused_by_key_and_range() {
        for (text, named) in [
            ("scene=<script>", "<script>"),
            ("scene=../../etc/passwd", "is not a scene"),
            ("scene=", "is not a scene"),
            ("S=NaN", "S ="),
            ("S=inf", "S ="),
            ("S=1e300", "S ="),
            ("S=-2.1", "S ="),
            ("load=-1", "load ="),
            ("load=0", "load ="),
            ("A1=1", "A1 ="),
            ("U=0", "U ="),
            ("nodes=64", "33, 65, 129 or 257"),
            ("nodes=17", "33, 65, 129 or 257"),
            ("nodes=513", "33, 65, 129 or 257"),
            ("nodes=-65", "33, 65, 129 or 257"),
            ("nodes=99999999999999999999", "33, 65, 129 or 257"),
            ("lesson=none", "is not a lesson"),
            ("contrast=pink", "normal, high or light"),
            ("x=1", "a key of a scene"),
            ("grid=1", "a key of a scene"),
            ("S", "key=value"),
            ("motion.slide_roll=[[[", "motion.slide_roll"),
            ("motion.slide_roll=7", "motion.slide_roll"),
            ("grid.nodes=1000000", "grid.nodes"),
            ("no.such=1", "no"),
            ("\0=\u{fffd}", "is not a key"),
        ] {
            let reason = refused(text);
            assert!(reason.contains(named), "{text:?}: {reason}");
            assert!(!reason.contains('\0'), "{reason:?}");
        }
        assert!(refused(&"S=0.1\n".repeat(50_000)).contains("bytes"));
        let long = refused(&format!("S={}", "9".repeat(1000)));
        assert!(long.len() < 200, "{long}");
    }

    #[test]
    fn values_are_escaped_in_an_address() {
        assert_eq!(escaped("4e-4"), "4e-4");
        assert_eq!(escaped("\"a&b=%\" #µ"), "%22a%26b%3D%25%22%20%23%C2%B5");
    }

    #[test]
    fn a_file_is_a_lesson_or_a_scene_or_refused() {
        let scene = PageLink::read("scene=twin_disc").unwrap().scene;
        let dropped = PageLink::from_file(&scene.to_toml()).unwrap();
        assert_eq!((dropped.scene, dropped.lesson.is_none()), (scene, true));
        for text in ["no = [scene", "", "[[beat]]\n", "a = 1", "\u{feff}"] {
            assert!(PageLink::from_file(text).is_err(), "{text:?}");
        }
        assert!(PageLink::from_file(&" ".repeat(MAX_BYTES + 1)).is_err());
    }

    /// A map that says its sides, dropped on a scene: its heights on body 1 whatever becomes of the scene then, as a run that reads
    /// the file has them.
    #[test]
    fn a_dropped_map_is_the_surface_of_body_1() {
        let text = |width: &str| {
            let rows = (0..16).map(|row| {
                let z = |column: i32| f64::from((7 * row + 3 * column) % 11) * 1e-8;
                let row: Vec<String> = (0..32).map(|column| format!("{:e}", z(column))).collect();
                row.join(",")
            });
            let rows: Vec<String> = rows.collect();
            format!("# Value units: m\n{width}{}\n", rows.join("\n"))
        };
        let wide = text("# Width: 640 µm\n");
        let shown = PageLink::read("scene=twin_disc").unwrap().scene.to_toml();
        let dropped =
            with_map((shown.clone(), 65), format!("flank.csv\n{wide}").as_bytes()).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("flank.csv");
        std::fs::write(&file, &wide).unwrap();
        let mut by_file = Scene::from_toml(&shown).unwrap();
        by_file
            .body_1
            .surface
            .clone_from(&dropped.scene.body_1.surface);
        if let Surface::HeightMap { file: own, map, .. } = &mut by_file.body_1.surface {
            *own = file.to_string_lossy().replace("flank", "other");
            *map = None;
        }
        std::fs::rename(&file, folder.path().join("other.csv")).unwrap();
        by_file.read_maps(Path::new("")).unwrap();
        let heights = |scene: &Scene| scene.body_1.surface.relief_heights_m().unwrap();
        assert_eq!(heights(&dropped.scene), heights(&by_file));
        // The forms of the explorer read the scene again.
        let again = PageLink::from_file(&dropped.scene.to_toml()).unwrap();
        assert_eq!(heights(&again.scene), heights(&by_file));
        let small = format!("small.csv\n{}", text(""));
        let reason = with_map((shown.clone(), 65), small.as_bytes())
            .err()
            .unwrap();
        assert!(
            reason.contains("pixel_m") && reason.contains("small.csv"),
            "{reason}"
        );
        for hostile in [
            "",
            "\n",
            "x",
            "a.csv\n",
            "../../x.sur\nnothing",
            "a.x3p\nPK\x03\x04",
        ] {
            let reason = with_map((shown.clone(), 65), hostile.as_bytes())
                .err()
                .unwrap();
            assert!(
                reason.contains("body_1.surface.file"),
                "{hostile:?}: {reason}"
            );
        }
    }

    /// Of every scene there is: on the page's nodes, or on as many more as it needs, never more than its own.
    #[test]
    fn every_scene_has_a_plan_in_the_page() {
        for preset in presets::all() {
            let scene = PageLink::read(&format!("scene={}", preset.name))
                .unwrap()
                .scene;
            let mut few = scene.clone();
            few.grid.nodes = 65;
            // Who asks for fewer nodes gets them.
            let few = on_nodes(&few, None).ok();
            assert!(
                few.is_none_or(|(few, _)| few.grid.nodes == 65),
                "{}",
                preset.name
            );
            let (on_page, _) = on_nodes(&scene, None).unwrap();
            let nodes = on_page.grid.nodes;
            assert!(
                (NODES..=scene.grid.nodes.clamp(NODES, MAX_NODES)).contains(&nodes),
                "{}",
                preset.name
            );
        }
    }
}
