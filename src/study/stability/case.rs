//! Cases as data (`assets/studies/stability.toml`), and the scene that each of them means.
//!
//! A case sets one or more keys to extreme values. Beside the keys of a scene there are some that no scene has because they
//! depend on others: see [`Lever`].

use std::collections::BTreeMap;

use serde::Deserialize;

use super::super::{planned, scene_with};
use asperity_engine::physics::hertz::Hertz;
use asperity_engine::plan::Plan;
use asperity_engine::scene::{ContactKind, Event, Scene};
use asperity_engine::sim::Knob;

/// Step of the passage at which knobs are turned, as a share of it.
pub(super) const JUMP_AT: f64 = 0.125;
/// The set, as it stands in the program.
const CASES: &str = include_str!("../../../assets/studies/stability.toml");

/// Waves of a rough case that says nothing else: nodes a wave, and amplitude of each body, m.
const WAVE_NODES: f64 = 8.0;
const WAVE_AMPLITUDE_M: f64 = 3e-7;
/// Nodes a wave that any domain resolves.
const LONG_WAVE_NODES: f64 = 64.0;

/// Surfaces of a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Texture {
    /// Transverse waves on body 1, a product of waves on body 2.
    #[default]
    Rough,
    /// No roughness.
    Smooth,
    /// As in the scene.
    Own,
}

/// Who turns a knob in mid-run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TurnedBy {
    /// An event of the scene: the plan foresees it.
    #[default]
    ByScript,
    /// A hand: the plan does not know.
    ByHand,
}

/// One case.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// Name.
    pub name: String,
    /// What the case is extreme in.
    pub group: String,
    /// Keys that are set whatever the push.
    #[serde(default)]
    pub set: Vec<String>,
    /// Surfaces.
    #[serde(default)]
    pub texture: Texture,
    /// Length of the passage, in lengths of 4 a.
    #[serde(default = "one")]
    pub passages: f64,
    /// Whether the quick form runs it.
    #[serde(default)]
    pub quick: bool,
    /// Who turns the knobs of its jumps.
    #[serde(default)]
    pub turned: TurnedBy,
    /// Keys with their extreme values.
    #[serde(default)]
    pub push: BTreeMap<String, f64>,
}

fn one() -> f64 {
    1.0
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    scene: String,
    set: Vec<String>,
    case: Vec<Case>,
}

/// The set: what all cases start from, and the cases.
#[derive(Debug, Clone, PartialEq)]
pub struct CaseSet {
    /// Preset.
    pub scene: String,
    /// Keys set in all of them.
    pub set: Vec<String>,
    /// The cases.
    pub cases: Vec<Case>,
}

/// What a pushed key means.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Lever {
    /// What several keys of the scene follow from: `moes.m` and `moes.l` (Moes' groups: viscosity and its pressure
    /// coefficient), `wave.nodes` (wavelength in nodes of the grid, both bodies), `wave.amplitude_m` (of each body),
    /// `shape.ellipticity` (b/a of the Hertz ellipse: the radius across).
    Derived,
    /// `jump.KEY`: a knob turned in the middle of the passage.
    Jump(Knob),
    /// A key of the scene.
    Key,
}

impl Lever {
    fn of(name: &str) -> Self {
        match name {
            "moes.m" | "moes.l" | "wave.nodes" | "wave.amplitude_m" | "shape.ellipticity" => {
                Self::Derived
            }
            _ => name
                .strip_prefix("jump.")
                .and_then(Knob::from_key)
                .map_or(Self::Key, Self::Jump),
        }
    }
}

/// A case made ready to run.
#[derive(Debug, Clone)]
pub(super) struct Ready {
    pub(super) scene: Scene,
    pub(super) plan: Plan,
    pub(super) jumps: Vec<(Knob, f64)>,
}

impl CaseSet {
    /// The set that comes with the program.
    ///
    /// # Errors
    /// What is wrong with the data.
    pub fn shipped() -> Result<Self, String> {
        let file: File = toml::from_str(CASES).map_err(|error| error.to_string())?;
        Ok(Self {
            scene: file.scene,
            set: file.set,
            cases: file.case,
        })
    }

    /// The scene of a case on `nodes` per side.
    ///
    /// # Errors
    /// Why it is refused.
    pub(super) fn ready(&self, case: &Case, nodes: usize) -> Result<Ready, String> {
        let mut texts = self.set.clone();
        texts.push(format!("grid.nodes={nodes}"));
        texts.push(format!("time.passages={}", case.passages));
        texts.extend(case.set.iter().cloned());
        let mut jumps = Vec::new();
        for (name, value) in &case.push {
            match Lever::of(name) {
                Lever::Jump(knob) => jumps.push((knob, *value)),
                Lever::Key => texts.push(format!("{name}={value:e}")),
                Lever::Derived => {}
            }
        }
        let foreseen = match case.turned {
            TurnedBy::ByScript => &jumps[..],
            TurnedBy::ByHand => &[],
        };
        let smooth = ["body_1", "body_2"].map(|body| format!("{body}.surface.kind=smooth"));
        let mut bare = texts.clone();
        bare.extend(smooth.clone());
        let derived = self.derived(case, &bare)?;
        texts.extend(derived.iter().cloned());
        bare.extend(derived);
        match case.texture {
            Texture::Own => {}
            Texture::Smooth => texts.extend(smooth),
            Texture::Rough => {
                // The domain, and with it the spacing, follows from the amplitude: long waves of it show both.
                let (_, smooth) = planned(self.with_events(&bare, foreseen)?)?;
                bare.extend(waves(case, &smooth, LONG_WAVE_NODES));
                let (_, rough) = planned(self.with_events(&bare, foreseen)?)?;
                let nodes = case.push.get("wave.nodes").copied();
                texts.extend(waves(case, &rough, nodes.unwrap_or(WAVE_NODES)));
            }
        }
        let (scene, plan) = planned(self.with_events(&texts, foreseen)?)?;
        Ok(Ready { scene, plan, jumps })
    }

    /// The scene with its jumps as an event.
    fn with_events(&self, texts: &[String], jumps: &[(Knob, f64)]) -> Result<Scene, String> {
        let mut scene = scene_with(&self.scene, texts)?;
        if !jumps.is_empty() {
            let length_m = 4.0 * scene.hertz().a_m * scene.time.most_passages();
            scene.events.push(Event {
                at_s: JUMP_AT * length_m / scene.motion.entrainment_m_s.abs(),
                set: jumps
                    .iter()
                    .map(|(knob, value)| (knob.key().to_owned(), *value))
                    .collect(),
                caption: String::new(),
            });
        }
        Ok(scene)
    }

    /// Keys that follow from others of the scene: of the ellipse and of Moes' groups.
    fn derived(&self, case: &Case, texts: &[String]) -> Result<Vec<String>, String> {
        let get = |name: &str| case.push.get(name).copied();
        let mut found = Vec::new();
        if let Some(ellipticity) = get("shape.ellipticity") {
            let rx_m = scene_with(&self.scene, texts)?.contact.rx_m;
            found.push(format!(
                "contact.ry_m={:e}",
                rx_m * radius_ratio(ellipticity)
            ));
        }
        if let Some((m, l)) = get("moes.m").zip(get("moes.l")) {
            let scene = scene_with(&self.scene, texts)?;
            let (e_prime_pa, rx_m) = (scene.e_prime_pa(), scene.contact.rx_m);
            let load = scene.force_n() / (e_prime_pa * rx_m * rx_m);
            // M = W/(2U)^{3/4}, L = G (2U)^{1/4}, U = η0 u/(E'R), G = α E'.
            let twice_speed = (load / m).powf(4.0 / 3.0);
            let speed_m_s = scene.motion.entrainment_m_s.abs();
            let viscosity = 0.5 * twice_speed * e_prime_pa * rx_m / speed_m_s;
            let alpha = l / twice_speed.powf(0.25) / e_prime_pa;
            found.push(format!("lubricant.viscosity_pa_s={viscosity:e}"));
            found.push(format!("lubricant.pressure_viscosity_per_pa={alpha:e}"));
        }
        Ok(found)
    }
}

/// Overrides that put waves of so many nodes on both bodies.
fn waves(case: &Case, plan: &Plan, nodes: f64) -> Vec<String> {
    // A touch more than asked for: rounding must not make 4 nodes fewer than 4.
    let nodes = nodes * (1.0 + 1e-9);
    let amplitude_m = case.push.get("wave.amplitude_m").copied();
    let amplitude_m = amplitude_m.unwrap_or(WAVE_AMPLITUDE_M);
    let (wave_x, wave_y) = (nodes * plan.dx_m, nodes * plan.dy_m);
    vec![
        "body_1.surface.kind=sinusoid".to_owned(),
        "body_2.surface.kind=sinusoid".to_owned(),
        format!("body_1.surface.wavelength_x_m={wave_x:e}"),
        format!("body_2.surface.wavelength_x_m={wave_x:e}"),
        format!("body_1.surface.amplitude_m={amplitude_m:e}"),
        format!("body_2.surface.amplitude_m={amplitude_m:e}"),
        match plan.kind {
            ContactKind::Line => "body_2.surface.wavelength_y_m=inf".to_owned(),
            ContactKind::Point => format!("body_2.surface.wavelength_y_m={wave_y:e}"),
        },
    ]
}

/// Ry/Rx of a Hertz ellipse with that b/a: it grows with the ratio, so bisection finds it.
fn radius_ratio(ellipticity: f64) -> f64 {
    let of = |ln_ratio: f64| Hertz::from_force(1.0, ln_ratio.exp(), 1e11, 1.0).ellipticity();
    let (mut low, mut high) = (-12.0, 12.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if of(middle) < ellipticity {
            low = middle;
        } else {
            high = middle;
        }
    }
    low.exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_set_is_large_and_every_case_makes_a_scene() {
        let set = CaseSet::shipped().expect("good data");
        assert!(set.cases.len() >= 60, "{}", set.cases.len());
        let mut names: Vec<_> = set.cases.iter().map(|case| &case.name).collect();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), set.cases.len(), "names are unique");
        for case in &set.cases {
            for nodes in [33, 65] {
                let ready = set.ready(case, nodes);
                assert!(ready.is_ok(), "{}: {:?}", case.name, ready.err());
            }
            for name in case.push.keys().filter(|name| name.starts_with("jump.")) {
                assert_ne!(Lever::of(name), Lever::Key, "{name}");
            }
        }
    }

    #[test]
    fn levers_reach_what_they_say() {
        let set = CaseSet::shipped().expect("good data");
        let find = |lever: &str| {
            let case = set.cases.iter().find(|case| case.push.contains_key(lever));
            let case = case.expect("a case with that lever");
            (set.ready(case, 65).expect("ready"), case.push[lever])
        };
        let (ready, m) = find("moes.m");
        let groups = ready.plan.film.expect("a film").groups;
        assert!((groups.m / m - 1.0).abs() < 1e-9);
        let (ready, ellipticity) = find("shape.ellipticity");
        assert!((ready.plan.hertz.ellipticity() / ellipticity - 1.0).abs() < 1e-6);
        let (ready, nodes) = find("wave.nodes");
        let wave = ready.plan.waves[0].expect("rough");
        assert!((wave.nodes[0] / nodes - 1.0).abs() < 1e-6);
    }
}
