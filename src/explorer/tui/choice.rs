//! What a run cannot turn while it goes: another scene, lay, wavelength, oil, stress measure, life model,
//! grid, operating point. Choices make a draft of a scene; its plan is made at once, so that what cannot be computed is
//! told before anything is started.

mod draft;
mod drawn;
mod numbers;

pub use self::draft::{Draft, Form};
pub use self::drawn::Drawn;

use std::f64::consts::SQRT_2;

use crate::tui::kinds::shifted;
use crate::tui::units::{Units, sig};
use asperity_engine::scene::{
    ContactKind, LifeModel, Override, Scene, SceneError, StressMeasure, Surface,
};

/// One choice.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Choice {
    /// Preset: everything else follows.
    Preset,
    /// Equivalent radius along the rolling direction, or across.
    Radius(usize),
    /// Young's modulus of a body.
    Young(usize),
    /// Load, of a line per length.
    Load,
    /// A number of a drawing.
    Drawn(Drawn),
    /// Maximum Hertz pressure.
    HertzPressure,
    /// Entrainment speed.
    Speed,
    /// Slide-to-roll ratio.
    SlideRoll,
    /// Pressure-viscosity coefficient.
    PressureViscosity,
    /// Amplitude of a body's roughness.
    Amplitude(usize),
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
    Random,
    Other,
}

/// Viscosities, wavelengths: ten values a decade.
const STEP: f64 = 1.258_925_411_794_167_2;

impl Choice {
    /// What a scene is put together from, in the order of the panel.
    pub const SCENE: [Self; 9] = [
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
            Self::Radius(0) => "radius along x",
            Self::Radius(_) => "radius across",
            Self::Young(0) => "modulus of body 1",
            Self::Young(_) => "modulus of body 2",
            Self::Load => "load",
            Self::HertzPressure => "Hertz pressure",
            Self::Speed => "entrainment speed U",
            Self::SlideRoll => "slide-to-roll ratio S",
            Self::PressureViscosity => "pressure-viscosity",
            Self::Amplitude(0) => "amplitude 1",
            Self::Amplitude(_) => "amplitude 2",
            Self::Drawn(drawn) => drawn.name(),
        }
    }

    /// What a draft has chosen, in words.
    pub fn shown(self, draft: &Draft, units: Units) -> String {
        match self {
            Self::Preset => draft.preset.unwrap_or("as it is").to_owned(),
            Self::Drawn(drawn) => drawn.shown(draft, units),
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
                Lay::Random => "random",
                Lay::Other => "as in the scene",
            }
            .to_owned(),
            Self::Wavelength(body) => match wavelength(surface(scene, body)) {
                Some(wave_m) => {
                    let over_a = sig(wave_m / scene.hertz().a_m, 2);
                    let which = match surface(scene, body) {
                        Surface::Random(_) => "shortest, ",
                        Surface::Smooth {}
                        | Surface::Sinusoid { .. }
                        | Surface::HeightMap { .. } => "",
                    };
                    format!("{}  {which}W/a {over_a}", units.length().show(wave_m, 3))
                }
                None => "no wave".to_owned(),
            },
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
            number => number.number_shown(scene, units),
        }
    }

    /// # Errors
    ///
    /// A surface that the rules of scenes refuse; the scene stays as it was.
    fn turn(self, draft: &mut Draft, by: i32) -> Result<(), SceneError> {
        let scene = &mut draft.scene;
        match self {
            Self::Preset => draft.take_preset(by),
            Self::Lay(body) => return turn_lay(scene, body, by),
            Self::Wavelength(body) => turn_wave(self, draft, body, by),
            Self::Measure => {
                if let Some(stress) = &mut scene.stress {
                    stress.measure = shifted(&StressMeasure::ALL, stress.measure, by);
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
            Self::Drawn(drawn) => {
                if let Some(value) = drawn.turned(draft, by) {
                    draft.put(self, value);
                }
            }
            number => {
                if let Some(value) = number.number_turned(scene, by) {
                    draft.put(number, value);
                }
            }
        }
        Ok(())
    }
}

/// Longer or shorter waves, both of a product alike; of a made surface its shortest.
fn turn_wave(choice: Choice, draft: &mut Draft, body: usize, by: i32) {
    if let Surface::Sinusoid { .. } = surface(&draft.scene, body) {
        draft.keep();
        if let Surface::Sinusoid {
            wavelength_x_m,
            wavelength_y_m,
            ..
        } = surface_mut(&mut draft.scene, body)
        {
            *wavelength_x_m = stepped(*wavelength_x_m, by);
            *wavelength_y_m = stepped(*wavelength_y_m, by);
        }
        draft.judge();
    } else if let Some(value) = choice.number_turned(&draft.scene, by) {
        draft.put(choice, value);
    }
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
        Surface::Random(_) => Lay::Random,
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
        Surface::Random(_) => surface.cutoff_short_m(),
        Surface::Smooth {} | Surface::HeightMap { .. } => None,
    }
}

fn turn_lay(scene: &mut Scene, body: usize, by: i32) -> Result<(), SceneError> {
    // A line contact is the same at every y.
    let all: &[Lay] = match scene.kind() {
        ContactKind::Point => &[
            Lay::Smooth,
            Lay::Transverse,
            Lay::Longitudinal,
            Lay::Isotropic,
            Lay::Random,
        ],
        ContactKind::Line => &[Lay::Smooth, Lay::Transverse, Lay::Random],
    };
    let next = shifted(all, lay(surface(scene, body)), by);
    // A surface that was smooth takes wave and height from its mate, or typical ones; a made one has waves of its Rq and
    // twice its shortest.
    let known = |body: usize| {
        let surface = surface(scene, body);
        let times = if lay(surface) == Lay::Random {
            2.0
        } else {
            1.0
        };
        wavelength(surface).map(|wave_m| times * wave_m)
    };
    let wave_m = known(body)
        .or_else(|| known(1 - body))
        .unwrap_or_else(|| stepped(0.4 * scene.hertz().a_m, 0));
    let height = |body: usize| {
        let height_m = match surface(scene, body) {
            Surface::Random(random) => SQRT_2 * random.rq_m,
            other @ (Surface::Smooth {} | Surface::Sinusoid { .. } | Surface::HeightMap { .. }) => {
                other.amplitude_m()
            }
        };
        Some(height_m).filter(|height_m| *height_m > 0.0)
    };
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
        Lay::Random => {
            let own_m = surface(scene, body).rq_m();
            let rq_m = if own_m > 0.0 {
                own_m
            } else {
                amplitude_m / SQRT_2
            };
            *scene = with_made_surface(scene, body, rq_m, wave_m)?;
            return Ok(());
        }
        Lay::Transverse => wave(wave_m, f64::INFINITY),
        Lay::Longitudinal => wave(f64::INFINITY, wave_m),
        Lay::Isotropic => wave(wave_m, wave_m),
    };
    Ok(())
}

/// A made surface in place of a body's waves, of their Rq: with the proportions of the preset `random_rollers`, Gaussian with a
/// correlation of a third and no waves below half of theirs; in a line contact ridges.
fn with_made_surface(
    scene: &Scene,
    body: usize,
    rq_m: f64,
    wave_m: f64,
) -> Result<Scene, SceneError> {
    let third_m = stepped(wave_m / 3.0, 0);
    let across_m = match scene.kind() {
        ContactKind::Point => third_m,
        ContactKind::Line => f64::INFINITY,
    };
    let table = format!("body_{}.surface", body + 1);
    let words = ["kind=random", "autocorrelation=gaussian"];
    let words = words.map(|set| format!("{table}.{set}").parse());
    let numbers = [
        ("rq_m", rq_m),
        ("correlation_x_m", third_m),
        ("correlation_y_m", across_m),
        ("cutoff_short_m", stepped(wave_m / 2.0, 0)),
    ];
    let numbers = numbers.map(|(key, value)| Override::number(&format!("{table}.{key}"), value));
    let sets: Vec<Override> = words.into_iter().chain(numbers).collect::<Result<_, _>>()?;
    Scene::from_toml_with(&scene.to_toml(), "the scene", &sets)
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_engine::scene::presets;

    fn draft() -> Draft {
        Draft::new(Scene::load(presets::QUICK).expect("a preset"), Form::Scene)
    }

    #[test]
    fn every_choice_can_be_turned_round_and_stays_a_scene() {
        for form in [Form::Scene, Form::Point] {
            for (row, choice) in form.rows().iter().enumerate() {
                let mut draft = draft();
                draft.turn_to(form);
                draft.row = row;
                let before = choice.shown(&draft, Units::default());
                draft.turn(1);
                assert_ne!(choice.shown(&draft, Units::default()), before, "{choice:?}");
                assert!(draft.scene.validate().is_ok(), "{choice:?}");
                assert!(!draft.verdict.as_ref().map_or(true, String::is_empty));
            }
        }
    }

    /// The lay goes round through a made surface of the waves' Rq, of a point and of a line; its row of waves is its shortest.
    #[test]
    fn waves_become_a_made_surface_of_their_rq() {
        for preset in [presets::QUICK, "fzg_point_b"] {
            let mut draft = Draft::new(Scene::load(preset).expect("a preset"), Form::Scene);
            let waves = draft.scene.body_1.surface.clone();
            draft.row = 1;
            let mut before = 0.0;
            while lay(&draft.scene.body_1.surface) != Lay::Random {
                before = draft.scene.body_1.surface.rq_m();
                draft.turn(1);
                assert!(draft.verdict.is_ok(), "{preset}: {:?}", draft.verdict);
            }
            let made = &draft.scene.body_1.surface;
            assert!((made.rq_m() / before - 1.0).abs() < 1e-12, "{preset}");
            let (_, heights_m, _) = made.relief_heights_m().expect("heights");
            let squares: f64 = heights_m.iter().map(|z_m| z_m * z_m).sum();
            let rq_m = (squares / heights_m.len() as f64).sqrt();
            assert!((rq_m / before - 1.0).abs() < 1e-6, "{preset}");
            let half = 0.5 * wavelength(&waves).expect("a wave");
            assert!(
                (wavelength(made).unwrap_or(0.0) / half - 1.0).abs() < 5e-3,
                "{preset}"
            );
            let shown = Choice::Wavelength(0).shown(&draft, Units::default());
            assert!(shown.contains("shortest"), "{shown}");
            typed(&mut draft, Choice::Wavelength(0), "80");
            assert_eq!(draft.scene.body_1.surface.cutoff_short_m(), Some(8e-5));
            draft.undo();
            draft.undo();
            assert!((draft.scene.body_1.surface.rq_m() / before - 1.0).abs() < 1e-12);
        }
    }

    /// Waves too short for a made surface's keys: the refusal names key, value and range, and nothing has changed.
    #[test]
    fn a_made_surface_that_is_refused_says_why() {
        let mut draft = draft();
        draft.scene.body_1.surface = Surface::Sinusoid {
            amplitude_m: 1e-9,
            wavelength_x_m: 1.5e-7,
            wavelength_y_m: 1.5e-7,
            angle_deg: 0.0,
            phase_deg: 0.0,
        };
        draft.row = 1;
        let before = draft.scene.clone();
        draft.turn(1);
        let said = draft.verdict.clone().expect_err("refused");
        assert!(said.contains("body_1.surface.correlation_x_m"), "{said}");
        assert_eq!(draft.scene, before);
        draft.undo();
        assert_eq!(draft.scene, before);
    }

    fn typed(draft: &mut Draft, choice: Choice, text: &str) {
        draft.turn_to(match choice {
            Choice::Drawn(_) => Form::Drawing,
            _ => Form::Point,
        });
        let rows = draft.form.rows();
        let place = rows.iter().position(|own| *own == choice);
        draft.row = place.expect("a row");
        draft.begin_typing();
        draft.typed = Some(text.to_owned());
        draft.set_typed(Units::default());
    }

    /// Every number of the form in the scene that would be run, in SI.
    #[test]
    fn numbers_are_typed_in_the_units_that_are_shown() {
        let mut draft = draft();
        for (choice, text, key, si) in [
            (Choice::Radius(0), "10", "contact.rx_m", 0.01),
            (Choice::Radius(1), "12,5", "contact.ry_m", 0.0125),
            (Choice::Young(0), "210", "body_1.young_pa", 2.1e11),
            (Choice::Young(1), "70", "body_2.young_pa", 7e10),
            (Choice::Load, "300", "load.force_n", 300.0),
            (Choice::Speed, "1.5", "motion.entrainment_m_s", 1.5),
            (Choice::SlideRoll, "−0.25", "motion.slide_roll", -0.25),
            (Choice::Viscosity, "40", "lubricant.viscosity_pa_s", 0.04),
            (
                Choice::PressureViscosity,
                "20",
                "lubricant.pressure_viscosity_per_pa",
                2e-8,
            ),
            (
                Choice::Amplitude(0),
                "0.2",
                "body_1.surface.amplitude_m",
                2e-7,
            ),
            (
                Choice::Wavelength(1),
                "150",
                "body_2.surface.wavelength_y_m",
                1.5e-4,
            ),
        ] {
            typed(&mut draft, choice, text);
            assert!(draft.verdict.is_ok(), "{choice:?}: {:?}", draft.verdict);
            let table: toml::Table = draft.scene.to_toml().parse().expect("a scene");
            let found = key.split('.').fold(None, |at: Option<&toml::Value>, name| {
                at.map_or_else(|| table.get(name), |at| at.get(name))
            });
            let found = found.and_then(toml::Value::as_float).expect("a number");
            assert!((found / si - 1.0).abs() < 1e-12, "{key}: {found}");
        }
        // Load and pressure exclude each other.
        typed(&mut draft, Choice::HertzPressure, "1.2");
        let load = &draft.scene.load;
        assert_eq!((load.force_n, load.hertz_pressure_pa), (None, Some(1.2e9)));
        let shown = |choice: Choice| choice.shown(&draft, Units::default());
        assert!(shown(Choice::Load).contains("from the Hertz pressure"));
        assert_eq!(shown(Choice::HertzPressure), "1.2 GPa");
    }

    #[test]
    fn a_number_out_of_range_is_refused_by_key_value_and_range() {
        let mut draft = draft();
        let before = draft.scene.clone();
        typed(&mut draft, Choice::Young(0), "1e9");
        let reason = draft.verdict.clone().err().unwrap_or_default();
        for part in ["body_1.young_pa", "1e18", "1e6 to 1e13 Pa"] {
            assert!(reason.contains(part), "{part}: {reason}");
        }
        assert_eq!(draft.scene, before);
        draft.choose(1);
        assert!(draft.verdict.is_ok(), "what was refused is past");
        typed(&mut draft, Choice::Young(0), "a");
        let reason = draft.verdict.clone().err().unwrap_or_default();
        assert!(reason.contains("no number"), "{reason}");
        // A line has no radius across, a smooth body no wave.
        draft.take("fzg_point_b");
        assert_eq!(Choice::Radius(1).keys(&draft.scene), Vec::<String>::new());
        assert_eq!(Choice::Load.keys(&draft.scene), ["load.force_n_per_m"]);
    }

    /// Both radii, both turns, Ra and a grade, against what a hand makes of them; one without its mate changes nothing and says
    /// what is missing.
    #[test]
    fn numbers_of_drawings_become_those_of_the_scene() {
        let mut draft = draft();
        let first = draft.scene.clone();
        let of = Choice::Drawn;
        typed(&mut draft, of(Drawn::Temperature), "60");
        let reason = draft.verdict.clone().err().unwrap_or_default();
        assert!(reason.contains("lubricant.vg"), "{reason}");
        assert_eq!(draft.scene, first);
        for (drawn, text) in [
            (Drawn::Grade, "220"),
            (Drawn::Radius(0), "20"),
            (Drawn::Radius(1), "30"),
            (Drawn::Across(0), "-50"),
            (Drawn::MeanHeight(0), "0.1"),
            (Drawn::Turns(0), "1500"),
        ] {
            typed(&mut draft, of(drawn), text);
        }
        let reason = draft.verdict.clone().err().unwrap_or_default();
        assert!(reason.contains("the other body"), "{reason}");
        typed(&mut draft, of(Drawn::Across(1)), "15");
        typed(&mut draft, of(Drawn::Turns(1)), "1250");
        assert!(draft.verdict.is_ok(), "{:?}", draft.verdict);
        let scene = &draft.scene;
        let pi = std::f64::consts::PI;
        let speeds_m_s = [
            1500.0 / 60.0 * 2.0 * pi * 0.02,
            1250.0 / 60.0 * 2.0 * pi * 0.03,
        ];
        let u_m_s = 0.5 * (speeds_m_s[0] + speeds_m_s[1]);
        for (found, by_hand) in [
            (scene.contact.rx_m, 0.012),
            (
                scene.contact.ry_m.unwrap_or(0.0),
                1.0 / (1.0 / 0.015 - 1.0 / 0.05),
            ),
            (scene.motion.entrainment_m_s, u_m_s),
            (
                scene.motion.slide_roll,
                (speeds_m_s[1] - speeds_m_s[0]) / u_m_s,
            ),
            (scene.body_1.surface.amplitude_m(), pi / 2.0 * 1e-7),
        ] {
            assert!((found / by_hand - 1.0).abs() < 1e-9, "{found} {by_hand}");
        }
        let oil = scene.lubricant.as_ref().expect("oil");
        assert_eq!((oil.vg, oil.temperature_c), (Some(220.0), Some(60.0)));
        // The radii stay where the speed is typed as such, the turns do not; the last change is taken back.
        typed(&mut draft, Choice::Speed, "2");
        let shown = |draft: &Draft, drawn: Drawn| of(drawn).shown(draft, Units::default());
        assert_eq!(shown(&draft, Drawn::Turns(0)), "–             U 2.000 m/s");
        assert_eq!(shown(&draft, Drawn::Radius(1)), "30 mm         R 12.00 mm");
        draft.undo();
        assert!(shown(&draft, Drawn::Turns(0)).starts_with("1500 1/min"));
        let before = draft.scene.clone();
        typed(&mut draft, of(Drawn::MeanHeight(0)), "1e6");
        let reason = draft.verdict.clone().err().unwrap_or_default();
        assert!(reason.contains("body_1.surface.ra_m"), "{reason}");
        assert_eq!(draft.scene, before);
        assert!(shown(&draft, Drawn::MeanHeight(0)).starts_with("0.1 µm"));
        // Nor is one that is refused for itself and not for a mate: a slope of 3.
        typed(&mut draft, of(Drawn::MeanHeight(0)), "60");
        assert!(draft.verdict.is_err());
        assert!(shown(&draft, Drawn::MeanHeight(0)).starts_with("0.1 µm"));
        // A row that is turned beyond what is allowed has set nothing, and what was typed stays.
        draft.turn_to(Form::Point);
        let amplitude = |choice: &Choice| *choice == Choice::Amplitude(0);
        draft.row = Choice::POINT.iter().position(amplitude).expect("a row");
        draft.turn(30);
        assert!(draft.verdict.is_err());
        assert!(shown(&draft, Drawn::MeanHeight(0)).starts_with("0.1 µm"));
    }

    #[test]
    fn a_turned_wave_can_be_taken_back() {
        for (preset, wave_m) in [("demonstration", 2e-4), ("random_rollers", 6e-5)] {
            let mut draft = draft();
            draft.take(preset);
            draft.row = 2;
            let wave = |draft: &Draft| wavelength(surface(&draft.scene, 0)).unwrap_or_default();
            assert_eq!(wave(&draft), wave_m);
            draft.turn(1);
            assert!(
                wave(&draft) > 1.2 * wave_m && draft.verdict.is_ok(),
                "{preset}"
            );
            draft.undo();
            assert_eq!(wave(&draft), wave_m, "{preset}");
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
        assert_eq!(rough(&draft), (Lay::Transverse, Some(2e-4), 5e-7));
        draft.turn(1);
        assert_eq!(rough(&draft), (Lay::Longitudinal, Some(2e-4), 5e-7));
        draft.turn(1);
        assert_eq!(rough(&draft), (Lay::Isotropic, Some(2e-4), 5e-7));
        draft.turn(1);
        assert_eq!(rough(&draft).0, Lay::Random);
        draft.turn(1);
        assert_eq!(rough(&draft).0, Lay::Smooth);
        draft.turn(1);
        assert_eq!(rough(&draft), (Lay::Transverse, Some(2e-4), 5e-7));
    }

    #[test]
    fn changes_are_taken_back_one_by_one_and_digits_edit_their_row() {
        let mut draft = draft();
        let first = draft.scene.clone();
        draft.row = 1;
        draft.turn(1);
        let second = draft.scene.clone();
        assert!(second != first);
        draft.turn_to(Form::Point);
        let number = |choice: &Choice| !choice.keys(&second).is_empty();
        draft.row = Form::Point
            .rows()
            .iter()
            .position(number)
            .expect("a number");
        draft.turn(1);
        let third = draft.scene.clone();
        assert!(third != second);
        // All rows were a preset's once, by a digit that was meant for one.
        draft.take_digit(2);
        assert_eq!(
            (draft.typed.take().as_deref(), &draft.scene),
            (Some("3"), &third)
        );
        for before in [&second, &first, &first] {
            draft.undo();
            assert_eq!(&draft.scene, before);
        }
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
