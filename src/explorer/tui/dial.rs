//! A dial: one knob on the screen, with its range, its steps and where it is going.

use crate::tui::units::{Unit, Units, sig};
use asperity_engine::plan::Plan;
use asperity_engine::scene::{ContactKind, Knob, Scene, SceneError, Steps, Surface};

/// Whether a dial can be turned.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DialState {
    /// It can.
    Live,
    /// It cannot, and why.
    Dead(&'static str),
}

/// One knob on the screen. Values are SI.
#[derive(Debug, Clone, PartialEq)]
pub struct Dial {
    /// What it turns.
    pub knob: Knob,
    /// Name on the screen.
    pub label: &'static str,
    /// What is shown over the value: Rq over A where a surface is known by its Rq, else 1.
    pub shown: f64,
    /// Small steps.
    pub steps: Steps,
    /// Small steps in a big one.
    pub far: i32,
    /// Minimum.
    pub min: f64,
    /// Maximum.
    pub max: f64,
    /// The scene's value.
    pub home: f64,
    /// Where the run is.
    pub now: f64,
    /// Where it is going.
    pub target: f64,
    /// Typical values and what they are typical of, for the digit keys.
    pub typical: Vec<(f64, &'static str)>,
    /// Whether it can be turned.
    pub state: DialState,
}

impl Dial {
    /// A value of it in the unit that it is shown in: S keeps its two decimals, so that it does not jump about.
    pub fn figure(&self, value: f64, digits: i32) -> String {
        match self.knob {
            Knob::SlideRoll => format!("{value:.2}"),
            Knob::ForceN
            | Knob::ForceNPerM
            | Knob::Amplitude1M
            | Knob::Amplitude2M
            | Knob::EntrainmentMS => sig(value, digits),
        }
    }

    /// The value that so many small steps away is.
    pub fn turned(&self, n: i32) -> f64 {
        let steps = f64::from(n);
        let value = match self.steps {
            Steps::Equal(step) => ((self.target / step).round() + steps) * step,
            Steps::Ratio(ratio) => {
                let place = (self.target / self.home).ln() / ratio.ln();
                self.home * ratio.powf(place.round() + steps)
            }
        };
        self.clamped(value)
    }

    /// The value at a part (0 to 1) of the slider, on a step.
    pub fn at_fraction(&self, fraction: f64) -> f64 {
        let fraction = fraction.clamp(0.0, 1.0);
        let value = match self.steps {
            Steps::Equal(step) => {
                let raw = self.min + (self.max - self.min) * fraction;
                (raw / step).round() * step
            }
            Steps::Ratio(ratio) => {
                let raw = self.min * (self.max / self.min).powf(fraction);
                let place = ((raw / self.home).ln() / ratio.ln()).round();
                self.home * ratio.powf(place)
            }
        };
        self.clamped(value)
    }

    /// The step that is nearest to a value.
    pub fn nearest(&self, value: f64) -> f64 {
        self.at_fraction(self.fraction(value))
    }

    /// Whether it is the dial for `knob`; a lesson that turns the load means either kind of it.
    pub fn answers(&self, knob: Knob) -> bool {
        self.knob == knob || self.knob.is_load() && knob.is_load()
    }

    /// A value, refused in words where a hand could not turn it there.
    ///
    /// # Errors
    /// [`SceneError::Value`] with knob, value and range.
    pub fn checked(&self, value: f64) -> Result<f64, SceneError> {
        let key = self.knob.key();
        if let DialState::Dead(reason) = self.state {
            let reason = format!("nothing: the surface is {reason}");
            return Err(SceneError::value(key, value, reason));
        }
        if (self.min..=self.max).contains(&value) {
            return Ok(value);
        }
        let range = format!("{} to {} {}", self.min, self.max, self.knob.unit());
        Err(SceneError::value(key, value, range))
    }

    /// Where on the slider a value is, 0 to 1.
    pub fn fraction(&self, value: f64) -> f64 {
        let fraction = match self.steps {
            Steps::Equal(_) => (value - self.min) / (self.max - self.min),
            Steps::Ratio(_) => (value / self.min).ln() / (self.max / self.min).ln(),
        };
        if fraction.is_finite() {
            fraction.clamp(0.0, 1.0)
        } else {
            0.0
        }
    }

    /// Whether the run is still on its way to the target.
    pub fn is_moving(&self) -> bool {
        (self.now - self.target).abs() > 1e-3 * self.target.abs().max(0.1 * self.span())
    }

    /// The first word of its label.
    pub fn name(&self) -> &'static str {
        self.label.split(' ').next().unwrap_or(self.label)
    }

    /// Unit of its values.
    pub fn unit(&self, units: Units) -> Unit {
        let kind = self.knob.load_of().unwrap_or_default();
        let unit = units.unit(self.knob.quantity().dimension, kind);
        Unit {
            per_si: unit.per_si * self.shown,
            ..unit
        }
    }

    fn span(&self) -> f64 {
        match self.steps {
            Steps::Equal(_) => self.max - self.min,
            Steps::Ratio(_) => 0.0,
        }
    }

    fn clamped(&self, value: f64) -> f64 {
        value.clamp(self.min, self.max)
    }
}

/// The dials of a scene whose load is `load_n` (a line: N/m) and gives `p_hertz_pa`: one place for the load, whichever kind
/// it is.
pub fn dials(scene: &Scene, load_n: f64, p_hertz_pa: f64) -> Vec<Dial> {
    let (kind, mut dials) = (scene.kind(), Vec::new());
    for place in Knob::ALL {
        let (knob, home) = match place {
            Knob::ForceN => (Knob::of_load(kind), load_n),
            Knob::ForceNPerM => continue,
            knob => (knob, knob.of(scene)),
        };
        let surface = knob.surface(scene);
        let shown = surface.map_or(1.0, shown);
        let mut dial = dial(knob, home, shown, (kind, p_hertz_pa));
        if surface.is_some_and(Surface::is_smooth) {
            dial.state = DialState::Dead("smooth");
        }
        // The run would refuse a load beyond its domain.
        if knob.is_load()
            && let Ok(plan) = Plan::new(scene)
        {
            dial.max = dial.max.min(plan.maximum_force_n());
            let (min, max) = (dial.min, dial.max);
            dial.typical
                .retain(|(value, _)| (min..=max).contains(value));
        }
        dials.push(dial);
    }
    dials
}

/// Rq over A of a surface whose greatest height nobody states: one that is made or measured.
fn shown(surface: &Surface) -> f64 {
    match surface {
        Surface::Smooth {} | Surface::Sinusoid { .. } => 1.0,
        Surface::Random(_) | Surface::HeightMap { .. } => {
            let ratio = surface.rq_m() / surface.amplitude_m();
            if ratio > 0.0 { ratio } else { 1.0 }
        }
    }
}

fn dial(knob: Knob, home: f64, shown: f64, load: (ContactKind, f64)) -> Dial {
    let line = knob.line();
    // Range, steps and typical values are round in what is shown.
    let ([min, max], typical) = knob.reach(home * shown, load);
    let typical = typical.into_iter().map(|(value, of)| (value / shown, of));
    Dial {
        knob,
        label: match knob {
            Knob::Amplitude1M if shown != 1.0 => "Rq₁ roughness 1",
            Knob::Amplitude2M if shown != 1.0 => "Rq₂ roughness 2",
            knob => knob.name(),
        },
        shown,
        steps: match line.steps {
            Steps::Equal(step) => Steps::Equal(step / shown),
            Steps::Ratio(ratio) => Steps::Ratio(ratio),
        },
        far: line.big_step,
        min: min / shown,
        max: max / shown,
        home,
        now: home,
        target: home,
        typical: typical.collect(),
        state: DialState::Live,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const POINT: (ContactKind, f64) = (ContactKind::Point, 1.73e9);

    #[test]
    fn steps_land_on_round_values_and_stop_at_the_ends() {
        let mut dial = dial(Knob::SlideRoll, 0.5, 1.0, POINT);
        assert_relative_eq!(dial.turned(1), 0.55, epsilon = 1e-12);
        dial.target = 0.537;
        assert_relative_eq!(dial.turned(1), 0.60, epsilon = 1e-12);
        assert_eq!(dial.turned(1000), 2.0);
        assert_eq!(dial.turned(-1000), -2.0);
    }

    #[test]
    fn ratio_steps_return_to_the_scenes_value() {
        let mut dial = dial(Knob::ForceN, 800.0, 1.0, POINT);
        for _ in 0..5 {
            dial.target = dial.turned(1);
        }
        assert_relative_eq!(dial.target, 800.0 * 1.05_f64.powi(5), max_relative = 1e-12);
        dial.target = dial.turned(-5);
        assert_relative_eq!(dial.target, 800.0, max_relative = 1e-12);
    }

    #[test]
    fn sliders_go_both_ways() {
        for dial in [
            dial(Knob::SlideRoll, 0.5, 1.0, POINT),
            dial(Knob::ForceN, 800.0, 1.0, POINT),
            dial(Knob::EntrainmentMS, 1.0, 1.0, POINT),
        ] {
            assert_relative_eq!(dial.fraction(dial.min), 0.0);
            assert_relative_eq!(dial.fraction(dial.max), 1.0, epsilon = 1e-12);
            for part in [0.0, 0.25, 0.5, 0.9, 1.0] {
                let back = dial.fraction(dial.at_fraction(part));
                // Within one step of the slider.
                assert!((back - part).abs() < 0.02, "{:?} {part} {back}", dial.knob);
            }
        }
    }

    #[test]
    fn typical_loads_are_round_hertz_pressures_inside_the_range() {
        let dial = dial(Knob::ForceN, 800.0, 1.0, POINT);
        assert!(!dial.typical.is_empty() && dial.typical.len() <= 9);
        for (force, _) in &dial.typical {
            let p = 1.73 * (force / 800.0).cbrt();
            assert_relative_eq!((p / 0.25).round() * 0.25, p, epsilon = 1e-9);
        }
    }

    #[test]
    fn a_line_has_a_load_per_length() {
        let dial = dial(Knob::ForceNPerM, 4.22e5, 1.0, (ContactKind::Line, 1.347e9));
        assert_eq!(dial.knob, Knob::ForceNPerM);
        assert_eq!(dial.unit(Units::Gpa).name, "N/m");
        for (force, _) in &dial.typical {
            let p = 1.347 * (force / 4.22e5).sqrt();
            assert_relative_eq!((p / 0.25).round() * 0.25, p, epsilon = 1e-9);
        }
        assert!(dial.answers(Knob::ForceN) && !dial.answers(Knob::SlideRoll));
    }

    /// The preset's surfaces are made with Rq = 0.2 and 0.2 um; their greatest heights are what the seed gives.
    #[test]
    fn a_made_surface_is_turned_by_its_rq() {
        let scene = Scene::load("random_rollers").expect("a preset");
        let dials = dials(&scene, 800.0, 1.73e9);
        for (place, name) in [(2, "Rq₁"), (3, "Rq₂")] {
            let mut dial = dials[place].clone();
            let unit = dial.unit(Units::Gpa);
            assert_eq!((dial.name(), unit.name), (name, "µm"));
            assert_relative_eq!(unit.of(dial.home), 0.2, epsilon = 1e-12);
            dial.target = dial.turned(1);
            assert_relative_eq!(unit.of(dial.target), 0.21, epsilon = 1e-12);
            let mut turned = scene.clone();
            dial.knob.put(&mut turned, dial.target);
            assert_relative_eq!(
                turned.surfaces()[place - 2].rq_m(),
                0.21e-6,
                epsilon = 1e-15
            );
            assert!(
                dial.typical
                    .iter()
                    .any(|(value, _)| (unit.of(*value) - 0.3).abs() < 1e-9)
            );
        }
    }

    #[test]
    fn a_smooth_surface_has_a_dead_dial() {
        let mut scene = Scene::load("demonstration").expect("a preset");
        scene.body_1.surface = Surface::Smooth {};
        let dials = dials(&scene, 800.0, 1.73e9);
        let life = |knob| {
            dials
                .iter()
                .find(|dial| dial.knob == knob)
                .map(|dial| dial.state)
        };
        assert_eq!(life(Knob::Amplitude1M), Some(DialState::Dead("smooth")));
        assert_eq!(life(Knob::Amplitude2M), Some(DialState::Live));
    }
}
