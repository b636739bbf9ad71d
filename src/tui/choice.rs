//! What a run cannot turn while it goes: another scene, lay, wavelength, oil, stress measure, life model,
//! grid. Choices make a draft of a scene; its plan is made at once, so that what cannot be computed is told
//! before anything is started.

use crate::plan::Plan;
use crate::scene::{LifeModel, Scene, StressMeasure, Surface, presets};
use crate::tui::units::{Units, sig};

/// One choice.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Choice {
    /// Preset: everything else follows.
    Preset,
    /// Lay of a body's roughness.
    Lay(usize),
    /// Wavelength of a body's roughness.
    Wavelength(usize),
    /// Viscosity of the oil.
    Viscosity,
    /// Effective stress.
    Measure,
    /// Life model.
    Model,
    /// Nodes per side.
    Nodes,
}

/// Lay of a sinusoidal surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Lay {
    Smooth,
    Transverse,
    Longitudinal,
    Isotropic,
    Other,
}

/// Viscosities, wavelengths: ten values a decade.
const STEP: f64 = 1.258_925_411_794_167_2;

impl Choice {
    /// All of them, in the order of the panel.
    pub const ALL: [Self; 9] = [
        Self::Preset,
        Self::Lay(0),
        Self::Wavelength(0),
        Self::Lay(1),
        Self::Wavelength(1),
        Self::Viscosity,
        Self::Measure,
        Self::Model,
        Self::Nodes,
    ];

    /// Name on the screen.
    pub fn name(self) -> &'static str {
        match self {
            Self::Preset => "scene",
            Self::Lay(0) => "lay of body 1",
            Self::Lay(_) => "lay of body 2",
            Self::Wavelength(0) => "wavelength 1",
            Self::Wavelength(_) => "wavelength 2",
            Self::Viscosity => "viscosity of the oil",
            Self::Measure => "effective stress",
            Self::Model => "life model",
            Self::Nodes => "nodes per side",
        }
    }

    /// What a draft has chosen, in words.
    pub fn shown(self, draft: &Draft, units: Units) -> String {
        match self {
            Self::Preset => draft.preset.unwrap_or("as it is").to_owned(),
            other => other.of_scene(&draft.scene, units),
        }
    }

    /// Shortest wave of a body's roughness along x or y, m.
    pub fn wave_m(scene: &Scene, body: usize) -> Option<f64> {
        wavelength(surface(scene, body))
    }

    /// What a scene has, in words.
    pub fn of_scene(self, scene: &Scene, units: Units) -> String {
        match self {
            Self::Preset => scene.title.clone(),
            Self::Lay(body) => match lay(surface(scene, body)) {
                Lay::Smooth => "smooth",
                Lay::Transverse => "transverse",
                Lay::Longitudinal => "longitudinal",
                Lay::Isotropic => "isotropic",
                Lay::Other => "as in the scene",
            }
            .to_owned(),
            Self::Wavelength(body) => match wavelength(surface(scene, body)) {
                Some(wave_m) => {
                    let over_a = sig(wave_m / scene.hertz().a_m, 2);
                    format!("{}  W/a {over_a}", units.length().show(wave_m, 3))
                }
                None => "no wave".to_owned(),
            },
            Self::Viscosity => scene.lubricant.as_ref().map_or_else(
                || "dry".to_owned(),
                |oil| format!("{} mPa s", sig(1e3 * oil.viscosity_pa_s, 3)),
            ),
            Self::Measure => scene
                .stress
                .as_ref()
                .map_or("none", |stress| stress.measure.name())
                .to_owned(),
            Self::Model => scene
                .life
                .as_ref()
                .map_or("none", |life| life.model.name())
                .to_owned(),
            Self::Nodes => scene.grid.nodes.to_string(),
        }
    }

    fn turn(self, draft: &mut Draft, by: i32) {
        let scene = &mut draft.scene;
        match self {
            Self::Preset => draft.take_preset(by),
            Self::Lay(body) => turn_lay(scene, body, by),
            Self::Wavelength(body) => {
                if let Surface::Sinusoid {
                    wavelength_x_m,
                    wavelength_y_m,
                    ..
                } = surface_mut(scene, body)
                {
                    *wavelength_x_m = stepped(*wavelength_x_m, by);
                    *wavelength_y_m = stepped(*wavelength_y_m, by);
                }
            }
            Self::Viscosity => {
                if let Some(oil) = &mut scene.lubricant {
                    oil.viscosity_pa_s = stepped(oil.viscosity_pa_s, by);
                }
            }
            Self::Measure => {
                let all = [
                    StressMeasure::VonMises,
                    StressMeasure::MaxShear,
                    StressMeasure::Octahedral,
                ];
                if let Some(stress) = &mut scene.stress {
                    stress.measure = shifted(&all, stress.measure, by);
                }
            }
            Self::Model => {
                if let Some(life) = &mut scene.life {
                    life.model = shifted(&LifeModel::ALL, life.model, by);
                }
            }
            Self::Nodes => {
                let all = [65, 129, 257, 513];
                scene.grid.nodes = shifted(&all, scene.grid.nodes, by);
            }
        }
    }
}

/// The next of a list, round and round.
fn shifted<T: Copy + PartialEq>(all: &[T], now: T, by: i32) -> T {
    let place = all.iter().position(|one| *one == now).unwrap_or(0) as i32;
    all[(place + by).rem_euclid(all.len() as i32) as usize]
}

/// Ten steps a decade, to three digits.
fn stepped(value: f64, by: i32) -> f64 {
    if !value.is_finite() {
        return value;
    }
    let raw = value * STEP.powi(by);
    let unit = 10.0_f64.powf(raw.log10().floor() - 2.0);
    (raw / unit).round() * unit
}

fn surface(scene: &Scene, body: usize) -> &Surface {
    if body == 0 {
        &scene.body_1.surface
    } else {
        &scene.body_2.surface
    }
}

fn surface_mut(scene: &mut Scene, body: usize) -> &mut Surface {
    if body == 0 {
        &mut scene.body_1.surface
    } else {
        &mut scene.body_2.surface
    }
}

fn lay(surface: &Surface) -> Lay {
    match *surface {
        Surface::Smooth {} => Lay::Smooth,
        Surface::Sinusoid {
            wavelength_x_m: x,
            wavelength_y_m: y,
            angle_deg: 0.0,
            ..
        } => match (x.is_finite(), y.is_finite()) {
            (true, false) => Lay::Transverse,
            (false, true) => Lay::Longitudinal,
            (true, true) => Lay::Isotropic,
            (false, false) => Lay::Other,
        },
        Surface::Sinusoid { .. } | Surface::HeightMap { .. } => Lay::Other,
    }
}

fn wavelength(surface: &Surface) -> Option<f64> {
    match *surface {
        Surface::Sinusoid {
            wavelength_x_m: x,
            wavelength_y_m: y,
            ..
        } => Some(x.min(y)).filter(|wave| wave.is_finite()),
        Surface::Smooth {} | Surface::HeightMap { .. } => None,
    }
}

fn turn_lay(scene: &mut Scene, body: usize, by: i32) {
    let all = [
        Lay::Smooth,
        Lay::Transverse,
        Lay::Longitudinal,
        Lay::Isotropic,
    ];
    let next = shifted(&all, lay(surface(scene, body)), by);
    // A surface that was smooth takes wave and height from its mate, or typical ones.
    let known = |body: usize| wavelength(surface(scene, body));
    let wave_m = known(body)
        .or_else(|| known(1 - body))
        .unwrap_or_else(|| stepped(0.4 * scene.hertz().a_m, 0));
    let height = |body: usize| Some(surface(scene, body).amplitude_m()).filter(|a| *a > 0.0);
    let amplitude_m = height(body).or_else(|| height(1 - body)).unwrap_or(2e-7);
    let wave = |wavelength_x_m, wavelength_y_m| Surface::Sinusoid {
        amplitude_m,
        wavelength_x_m,
        wavelength_y_m,
        angle_deg: 0.0,
        phase_deg: 0.0,
    };
    *surface_mut(scene, body) = match next {
        Lay::Smooth | Lay::Other => Surface::Smooth {},
        Lay::Transverse => wave(wave_m, f64::INFINITY),
        Lay::Longitudinal => wave(f64::INFINITY, wave_m),
        Lay::Isotropic => wave(wave_m, wave_m),
    };
}

/// A scene in the making.
#[derive(Debug, Clone)]
pub struct Draft {
    /// The scene.
    pub scene: Scene,
    /// Row that is chosen.
    pub row: usize,
    /// The plan in short, or why there is none.
    pub verdict: Result<String, String>,
    /// The preset that was chosen.
    pub preset: Option<&'static str>,
}

impl Draft {
    /// From a scene.
    pub fn new(scene: Scene) -> Self {
        let mut draft = Self {
            scene,
            row: 0,
            verdict: Ok(String::new()),
            preset: None,
        };
        draft.judge();
        draft
    }

    /// Chooses another row.
    pub fn choose(&mut self, by: i32) {
        let rows = Choice::ALL.len() as i32;
        self.row = (self.row as i32 + by).rem_euclid(rows) as usize;
    }

    /// Turns the chosen row.
    pub fn turn(&mut self, by: i32) {
        Choice::ALL[self.row].turn(self, by);
        self.judge();
    }

    fn take_preset(&mut self, by: i32) {
        let all = presets::all();
        let now = self
            .preset
            .and_then(|name| all.iter().position(|preset| preset.name == name));
        let place = match now {
            Some(place) => (place as i32 + by).rem_euclid(all.len() as i32) as usize,
            None if by > 0 => 0,
            None => all.len() - 1,
        };
        match Scene::load(all[place].name) {
            Ok(scene) => (self.scene, self.preset) = (scene, Some(all[place].name)),
            Err(error) => self.verdict = Err(error.to_string()),
        }
    }

    fn judge(&mut self) {
        let made = self
            .scene
            .validate()
            .map_err(|error| error.to_string())
            .and_then(|()| Plan::new(&self.scene).map_err(|error| error.to_string()));
        self.verdict = made.map(|plan| {
            format!(
                "p_h {} GPa, {} MB, {} s a passage of 4 a on one core",
                sig(plan.hertz.p_max_pa * 1e-9, 3),
                sig(plan.cost.memory_bytes as f64 * 1e-6, 2),
                sig(plan.cost.time_s / self.scene.time.passages.max(1e-9), 2),
            )
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn draft() -> Draft {
        Draft::new(Scene::load(crate::scene::presets::QUICK).expect("a preset"))
    }

    #[test]
    fn every_choice_can_be_turned_round_and_stays_a_scene() {
        for (row, choice) in Choice::ALL.into_iter().enumerate() {
            let mut draft = draft();
            draft.row = row;
            let before = choice.shown(&draft, Units::default());
            draft.turn(1);
            assert_ne!(choice.shown(&draft, Units::default()), before, "{choice:?}");
            assert!(draft.scene.validate().is_ok(), "{choice:?}");
            assert!(!draft.verdict.as_ref().map_or(true, String::is_empty));
        }
    }

    #[test]
    fn lays_keep_wave_and_height() {
        let mut draft = draft();
        let rough = |draft: &Draft| {
            let surface = &draft.scene.body_1.surface;
            (lay(surface), wavelength(surface), surface.amplitude_m())
        };
        draft.row = 1;
        assert_eq!(rough(&draft), (Lay::Transverse, Some(2e-4), 3e-7));
        draft.turn(1);
        assert_eq!(rough(&draft), (Lay::Longitudinal, Some(2e-4), 3e-7));
        draft.turn(1);
        assert_eq!(rough(&draft), (Lay::Isotropic, Some(2e-4), 3e-7));
        draft.turn(1);
        assert_eq!(rough(&draft).0, Lay::Smooth);
        draft.turn(1);
        assert_eq!(rough(&draft), (Lay::Transverse, Some(2e-4), 3e-7));
    }

    #[test]
    fn a_wave_that_the_grid_does_not_carry_is_refused_in_words() {
        let mut draft = draft();
        draft.row = 2;
        for _ in 0..8 {
            draft.turn(-1);
        }
        let reason = draft.verdict.err().unwrap_or_default();
        assert!(reason.contains("nodes"), "{reason}");
    }
}
