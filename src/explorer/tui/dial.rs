//! A dial: one knob on the screen, with its range, its steps and where it is going.

use crate::tui::units::{Unit, Units};
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
        units.unit(self.knob.quantity().dimension, kind)
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
        let mut dial = dial(knob, home, (kind, p_hertz_pa));
        if knob.surface(scene).is_some_and(Surface::is_smooth) {
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

fn dial(knob: Knob, home: f64, load: (ContactKind, f64)) -> Dial {
    let line = knob.line();
    let ([min, max], typical) = knob.reach(home, load);
    Dial {
        knob,
        label: knob.name(),
        steps: line.steps,
        far: line.big_step,
        min,
        max,
        home,
        now: home,
        target: home,
        typical,
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
        let mut dial = dial(Knob::SlideRoll, 0.5, POINT);
        assert_relative_eq!(dial.turned(1), 0.55, epsilon = 1e-12);
        dial.target = 0.537;
        assert_relative_eq!(dial.turned(1), 0.60, epsilon = 1e-12);
        assert_eq!(dial.turned(1000), 2.0);
        assert_eq!(dial.turned(-1000), -2.0);
    }

    #[test]
    fn ratio_steps_return_to_the_scenes_value() {
        let mut dial = dial(Knob::ForceN, 800.0, POINT);
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
            dial(Knob::SlideRoll, 0.5, POINT),
            dial(Knob::ForceN, 800.0, POINT),
            dial(Knob::EntrainmentMS, 1.0, POINT),
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
        let dial = dial(Knob::ForceN, 800.0, POINT);
        assert!(!dial.typical.is_empty() && dial.typical.len() <= 9);
        for (force, _) in &dial.typical {
            let p = 1.73 * (force / 800.0).cbrt();
            assert_relative_eq!((p / 0.25).round() * 0.25, p, epsilon = 1e-9);
        }
    }

    #[test]
    fn a_line_has_a_load_per_length() {
        let dial = dial(Knob::ForceNPerM, 4.22e5, (ContactKind::Line, 1.347e9));
        assert_eq!(dial.knob, Knob::ForceNPerM);
        assert_eq!(dial.unit(Units::Gpa).name, "N/m");
        for (force, _) in &dial.typical {
            let p = 1.347 * (force / 4.22e5).sqrt();
            assert_relative_eq!((p / 0.25).round() * 0.25, p, epsilon = 1e-9);
        }
        assert!(dial.answers(Knob::ForceN) && !dial.answers(Knob::SlideRoll));
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
