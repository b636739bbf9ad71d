//! One frame, three painters: the recording, the exported picture and the terminal show the same colour at the same
//! place, above the range and in contact too, in maps and over time.
#![cfg(all(feature = "rerun", feature = "tui"))]
#![expect(clippy::unwrap_used, reason = "tests")]

use std::path::Path;
use std::sync::Arc;

use super::recording::{Contents, event, shown as cut};
use crate::common::tui_fixture::{setup_planned, theme};
use asperity_engine::observe::{Began, Observer, Overwrite, RunContext};
use asperity_engine::plan::Plan;
use asperity_engine::scene::{ContactKind, Override, Record, Scene};
use asperity_engine::sim::{Frame, Simulation};
use asperity_explorer::tui::action::Action;
use asperity_explorer::tui::app::{App, MapKind};
use asperity_explorer::tui::event::{Pointer, PointerAct};
use asperity_explorer::tui::pixels::Medium;
use asperity_explorer::tui::theme::{ColorDepth, Glyphs};
use asperity_explorer::tui::view;
use asperity_picture::export::{Export, Format};
use asperity_picture::{ABOVE, CONTACT, Ramp};
use asperity_recorder::Recorder;
use ratatui::layout::Rect;

type Rgb = [u8; 3];

/// A map that all three have: where it is in each of them.
struct Shown {
    map: MapKind,
    entity: &'static str,
    over: Option<&'static str>,
    file: &'static str,
    ramp: Ramp,
}

const SHOWN: [Shown; 3] = [
    Shown {
        map: MapKind::Pressure,
        entity: "maps/pressure_GPa",
        over: None,
        file: "pressure",
        ramp: Ramp::Inferno,
    },
    Shown {
        map: MapKind::Film,
        entity: "maps/film_um",
        over: Some("maps/contact_spots"),
        file: "film",
        ramp: Ramp::Viridis,
    },
    Shown {
        map: MapKind::Stress,
        entity: "slice_y0/effective_stress_GPa",
        over: None,
        file: "effective_stress",
        ramp: Ramp::Magma,
    },
];

/// A passage's first frame and one after it, without the material point, whose mark would hide what lies below.
fn frames(scene: &Scene) -> Vec<Arc<Frame>> {
    let mut simulation = Simulation::new(scene, Plan::new(scene).unwrap(), 1).unwrap();
    let mut frames = Vec::new();
    while frames.len() < 2 {
        simulation.step().unwrap();
        if [1, 12].contains(&simulation.passage_steps()) {
            let mut frame = Frame::default();
            simulation.fill(&mut frame);
            frame.material_point = None;
            frames.push(Arc::new(frame));
        }
    }
    frames
}

fn scene(name: &str, sets: &[&str]) -> Scene {
    let sets: Vec<Override> = sets.iter().map(|set| set.parse().unwrap()).collect();
    Scene::load_with(name, &sets).unwrap()
}

/// Where the nodes of a map are, in half-widths, and which row of it is drawn lowest.
struct Places {
    x: Vec<f64>,
    y: Vec<f64>,
    is_below: bool,
}

impl Places {
    fn of(frame: &Frame, map: MapKind) -> Self {
        let along = |n: usize, first: f64, step: f64, half: f64| -> Vec<f64> {
            (0..n).map(|k| (first + step * k as f64) / half).collect()
        };
        let x = along(frame.nx, frame.x_min_m, frame.dx_m, frame.a_m);
        let is_below = map == MapKind::Stress;
        let y = if is_below {
            let depths = &frame.slice.as_ref().unwrap().depths_m;
            depths.iter().map(|depth| depth / frame.a_m).collect()
        } else {
            along(frame.ny, frame.y_min_m, frame.dy_m, frame.b_m)
        };
        Self { x, y, is_below }
    }

    /// The row from above.
    fn row(&self, j: usize) -> usize {
        if self.is_below {
            j
        } else {
            self.y.len() - 1 - j
        }
    }

    /// Whether the picture reaches so far.
    fn hold(&self, [x, y]: [f64; 2]) -> bool {
        let within = |places: &[f64], at: f64| {
            let [low, high] = [places[0], places[places.len() - 1]];
            (low.min(high)..=low.max(high)).contains(&at)
        };
        within(&self.x, x) && within(&self.y, y)
    }

    fn near(places: &[f64], at: f64) -> usize {
        let off = |k: &usize| (places[*k] - at).abs();
        let all = 0..places.len();
        all.min_by(|one, two| off(one).total_cmp(&off(two)))
            .unwrap()
    }
}

/// Colours of the nodes, row by row from above, and how smooth the field is there: as the viewer paints them.
fn recorded(contents: &Contents, shown: &Shown, step: i64, columns: usize) -> Vec<(Rgb, f64)> {
    let image = format!("{}/image", shown.entity);
    let top = contents.top(&image);
    let shares: Vec<f64> = contents.values(&image)[&step]
        .iter()
        .map(|value| value / top)
        .collect();
    let classes = shown
        .over
        .map(|over| contents.pictures(over)[&step].clone());
    let rows = shares.len() / columns;
    let class = |at: usize| classes.as_ref().map_or(0, |classes| classes[at]);
    let one = |at: usize| {
        let colour = match class(at) {
            0 => shown.ramp.colour(shares[at] as f32, 1.0),
            1 => CONTACT,
            _ => ABOVE,
        };
        let (i, j) = (at % columns, at / columns);
        let mut steep = 0.0_f64;
        for row in j.saturating_sub(1)..=(j + 1).min(rows - 1) {
            for column in i.saturating_sub(1)..=(i + 1).min(columns - 1) {
                let other = row * columns + column;
                let differs = if class(other) == class(at) { 0.0 } else { 1.0 };
                steep = steep.max((shares[other] - shares[at]).abs() * f64::from(class(at) == 0));
                steep = steep.max(differs);
            }
        }
        (colour, steep)
    };
    (0..shares.len()).map(one).collect()
}

/// The pixels of an exported map: red, green, blue of the axes' inside, and its size.
fn exported(file: &Path) -> (Vec<Rgb>, [usize; 2]) {
    /// Room around the axes.
    const LEFT: usize = 75;
    const ABOVE_THEM: usize = 87;
    const RIGHT: usize = 103;
    const BELOW_THEM: usize = 63;
    let reader = png::Decoder::new(std::io::BufReader::new(std::fs::File::open(file).unwrap()));
    let mut reader = reader.read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    assert_eq!(info.color_type, png::ColorType::Rgb);
    let (width, height) = (info.width as usize, info.height as usize);
    let size = [width - LEFT - RIGHT, height - ABOVE_THEM - BELOW_THEM];
    let mut pixels = Vec::new();
    for row in 0..size[1] {
        for column in 0..size[0] {
            let at = 3 * ((row + ABOVE_THEM) * width + column + LEFT);
            pixels.push([bytes[at], bytes[at + 1], bytes[at + 2]]);
        }
    }
    (pixels, size)
}

/// Middles of the terminal's cells: place in half-widths, and colour.
fn on_screen(app: &mut App, map: MapKind) -> Vec<([f64; 2], Rgb)> {
    const CELL: (u16, u16) = (9, 19);
    while app.map() != map {
        app.apply(Action::NextMap);
    }
    let screen = Rect::new(0, 0, 160, 48);
    let picture = view::picture(app, screen, CELL).unwrap();
    let middles = picture.area.positions().map(|at| {
        let pressed = Pointer {
            act: PointerAct::Press,
            column: at.x,
            row: at.y,
        };
        let Some(Action::Probe(x, y)) = view::pointed(app, screen, pressed) else {
            panic!("the map is read where it is pressed")
        };
        let column = usize::from((at.x - picture.area.x) * CELL.0 + CELL.0 / 2);
        let row = usize::from((at.y - picture.area.y) * CELL.1 + CELL.1 / 2);
        let pixel = 4 * (row * picture.width + column);
        let [r, g, b, _] = picture.rgba[pixel..pixel + 4] else {
            panic!("four bytes")
        };
        ([x, y], [r, g, b])
    });
    middles.collect()
}

fn differ(one: Rgb, two: Rgb) -> u8 {
    one.iter()
        .zip(two)
        .map(|(a, b)| a.abs_diff(b))
        .max()
        .unwrap()
}

/// What was compared: places in all, in contact, above the range.
#[derive(Default)]
struct Compared {
    all: usize,
    in_contact: usize,
    above: usize,
}

/// Between nodes painters interpolate differently, so smooth places are compared: fields that change by less than this
/// share of the range from node to node ...
const SMOOTH: f64 = 0.012;
/// ... whose colours differ by no more than this: the steepest part of a map rises by 11 in such a step, and the recording
/// stores eleven bits.
const ALIKE: u8 = 12;

/// All three get that scene, the exported picture one that ranges of its own may come from.
fn compare(scene: &Scene, of_export: &Scene) -> Compared {
    let frames = frames(scene);
    // A recording and exported pictures show the contact and no more.
    let [_, last] = &[0, 1].map(|k| cut(&frames[k]));
    let folder = tempfile::tempdir().unwrap();
    let context = |scene: &Scene| RunContext {
        scene: Arc::new(scene.clone()),
        scene_toml: scene.to_toml(),
        plan_text: String::new(),
        program: "a test".to_owned(),
        began: Began::FromScene,
    };
    let file = folder.path().join("run.rrd");
    let mut recorder = Recorder::create(&file, Overwrite::Refuse, &Record::default()).unwrap();
    let pictures = folder.path().join("pictures");
    let mut export = Export::create(&pictures, Overwrite::Refuse, &[Format::Png]).unwrap();
    let setup = setup_planned(scene, "a test", &Plan::new(scene).unwrap());
    let mut app = App::new(setup, Vec::new(), theme(ColorDepth::True, Glyphs::Unicode));
    app.set_medium(Medium::Page);
    app.apply(Action::Zoom);
    recorder.begin(&context(scene)).unwrap();
    export.begin(&context(of_export)).unwrap();
    for frame in &frames {
        recorder.frame(frame).unwrap();
        export.frame(frame).unwrap();
        app.take_frame(Arc::clone(frame));
    }
    recorder.finish().unwrap();
    export.finish().unwrap();
    let contents = Contents::read(&file);
    let step = last.step as i64;
    let mut compared = Compared::default();
    for shown in &SHOWN {
        let places = Places::of(last, shown.map);
        let recorded = recorded(&contents, shown, step, last.nx);
        let is_exported = last.kind == ContactKind::Point || shown.map == MapKind::Stress;
        let name = format!("step_{:06}_{}.png", last.step, shown.file);
        let exported = is_exported.then(|| exported(&pictures.join(name)));
        for ([x, y], colour) in on_screen(&mut app, shown.map) {
            if !places.hold([x, y]) {
                continue;
            }
            let (i, j) = (Places::near(&places.x, x), Places::near(&places.y, y));
            let row = places.row(j);
            let (expected, steep) = recorded[row * last.nx + i];
            // The ring of Hertz's contact lies over pictures.
            let ring = match last.kind {
                ContactKind::Point => x.hypot(y),
                ContactKind::Line => x.abs(),
            };
            if steep > SMOOTH || (!places.is_below && (ring - 1.0).abs() < 0.12) {
                continue;
            }
            let at = format!("{:?} of {} at {x:.2}, {y:.2}", shown.map, scene.title);
            assert!(
                differ(colour, expected) <= ALIKE,
                "{at}: terminal {colour:?}, recording {expected:?}"
            );
            if let Some((pixels, [wide, tall])) = &exported {
                let ends = |places: &[f64]| (places[0], places[places.len() - 1]);
                let ((x_0, x_1), (y_0, y_1)) = (ends(&places.x), ends(&places.y));
                // On paper depths are rows of the same height.
                let down = if places.is_below {
                    j as f64 / (places.y.len() - 1) as f64
                } else {
                    (y_1 - places.y[j]) / (y_1 - y_0)
                };
                let column = ((places.x[i] - x_0) / (x_1 - x_0) * (wide - 1) as f64).round();
                let pixel = (down * (tall - 1) as f64).round() as usize * wide + column as usize;
                assert!(
                    differ(pixels[pixel], expected) <= ALIKE,
                    "{at}: picture {:?}, recording {expected:?}",
                    pixels[pixel]
                );
            }
            compared.all += 1;
            compared.in_contact += usize::from(expected == CONTACT);
            compared.above += usize::from(expected == ABOVE);
        }
    }
    over_time(&contents, &frames, &mut app);
    compared
}

/// The film's newest row over time has the colours of the map's middle row.
fn over_time(contents: &Contents, frames: &[Arc<Frame>], app: &mut App) {
    let [before, last] = &[0, 1].map(|k| cut(&frames[k]));
    let nx = last.nx;
    let maps = contents.pictures("maps/contact_spots");
    let map = &maps[&(last.step as i64)];
    let rows = contents.pictures("kymograph/film_y0_um/over");
    let (_, over) = rows.last_key_value().unwrap();
    // The map's rows count from above.
    let middle = last.ny - 1 - last.ny / 2;
    assert_eq!(over[over.len() - nx..], map[middle * nx..(middle + 1) * nx]);
    assert!(over.contains(&2), "the bath is above the range");
    let now = on_screen(app, MapKind::FilmWaves);
    let lowest = now.iter().map(|([_, y], _)| *y).fold(f64::MIN, f64::max);
    // The middle of the lowest cell is a little before now: the frame before holds there.
    let row = &maps[&(before.step as i64)][middle * nx..(middle + 1) * nx];
    let places = Places::of(before, MapKind::Film);
    for ([x, y], colour) in &now {
        let i = Places::near(&places.x, *x);
        let near = &row[i.saturating_sub(2)..=(i + 2).min(nx - 1)];
        let is_shown = (places.x[0]..=places.x[nx - 1]).contains(x);
        if *y == lowest && is_shown && near.iter().all(|class| *class == row[i]) {
            assert_eq!(*colour == ABOVE, row[i] == 2, "{x}");
            assert_eq!(*colour == CONTACT, row[i] == 1, "{x}");
        }
    }
}

/// The comparison is sharp: one painter to whom an amplitude is announced that the others know nothing of is found.
#[test]
#[should_panic(expected = "picture [")]
fn a_painter_with_another_range_is_found() {
    let scene = scene("demonstration_quick", &["grid.nodes=65"]);
    let mut announced = scene.clone();
    announced.events = vec![event("body_1.surface.amplitude_m", 5e-6)];
    compare(&scene, &announced);
}

#[test]
fn two_presets_a_line_contact_and_a_dry_scene_look_alike_in_all_painters() {
    const SMALL: &str = "grid.nodes=65";
    let mut dry = scene("demonstration_quick", &[SMALL, "record=none"]);
    dry.lubricant = None;
    let scenes = [
        scene("demonstration_quick", &[SMALL]),
        // Its waves stand so that enough of the last frame is smooth.
        scene(
            "fzg_point_b",
            &["grid.nodes=129", "body_1.surface.phase_deg=90"],
        ),
        scene("mtm_ball_on_disc", &[SMALL]),
        dry,
    ];
    let compared: Vec<Compared> = scenes.iter().map(|scene| compare(scene, scene)).collect();
    for (scene, compared) in scenes.iter().zip(&compared) {
        println!(
            "{}: {} places, {} in contact, {} above the range",
            scene.title, compared.all, compared.in_contact, compared.above
        );
        // Of the screen's places those that recordings show too.
        assert!(compared.all > 250 && compared.above > 20, "{}", scene.title);
    }
    assert_eq!(scenes[1].contact.kind, ContactKind::Line);
    assert!(compared.iter().any(|compared| compared.in_contact > 20));
}
