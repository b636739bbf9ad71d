//! A dial: one knob on the screen, with its range, its steps and where it is going.

use crate::plan::Plan;
use crate::scene::keys::{self, Kind};
use crate::scene::{ContactKind, Scene, Surface};
use crate::sim::{Knob, Metrics};
use crate::tui::units::{Unit, Units};

/// How a dial's range is divided.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scale {
    /// Steps of equal difference.
    Linear {
        /// Small step.
        step: f64,
    },
    /// Steps of equal ratio, counted from the scene's value.
    Ratio {
        /// Small step.
        ratio: f64,
    },
}

/// Whether a dial can be turned.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Life {
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
    /// Division of the range.
    pub scale: Scale,
    /// Small steps in a big one.
    pub far: i32,
    /// Least value.
    pub min: f64,
    /// Greatest value.
    pub max: f64,
    /// The scene's value.
    pub home: f64,
    /// Where the run is.
    pub now: f64,
    /// Where it is going.
    pub target: f64,
    /// Typical values, for the digit keys.
    pub typical: Vec<f64>,
    /// Whether it can be turned.
    pub life: Life,
}

impl Dial {
    /// The value that so many small steps away is.
    pub fn turned(&self, steps: i32) -> f64 {
        let steps = f64::from(steps);
        let value = match self.scale {
            Scale::Linear { step } => ((self.target / step).round() + steps) * step,
            Scale::Ratio { ratio } => {
                let place = (self.target / self.home).ln() / ratio.ln();
                self.home * ratio.powf(place.round() + steps)
            }
        };
        self.clamped(value)
    }

    /// The value at a part (0 to 1) of the slider, on a step.
    pub fn at_fraction(&self, fraction: f64) -> f64 {
        let fraction = fraction.clamp(0.0, 1.0);
        let value = match self.scale {
            Scale::Linear { step } => {
                let raw = self.min + (self.max - self.min) * fraction;
                (raw / step).round() * step
            }
            Scale::Ratio { ratio } => {
                let raw = self.min * (self.max / self.min).powf(fraction);
                let place = ((raw / self.home).ln() / ratio.ln()).round();
                self.home * ratio.powf(place)
            }
        };
        self.clamped(value)
    }

    /// Whether it is the dial for `knob`; a lesson that turns the load means either kind of it.
    pub fn answers(&self, knob: Knob) -> bool {
        let load = |knob| matches!(knob, Knob::ForceN | Knob::ForceNPerM);
        self.knob == knob || load(self.knob) && load(knob)
    }

    /// Where on the slider a value is, 0 to 1.
    pub fn fraction(&self, value: f64) -> f64 {
        let fraction = match self.scale {
            Scale::Linear { .. } => (value - self.min) / (self.max - self.min),
            Scale::Ratio { .. } => (value / self.min).ln() / (self.max / self.min).ln(),
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

    /// Unit of its values.
    pub fn unit(&self, units: Units) -> Unit {
        let kind = match self.knob {
            Knob::ForceNPerM => ContactKind::Line,
            _ => ContactKind::Point,
        };
        units.unit(self.knob.quantity().dimension, kind)
    }

    fn span(&self) -> f64 {
        match self.scale {
            Scale::Linear { .. } => self.max - self.min,
            Scale::Ratio { .. } => 0.0,
        }
    }

    fn clamped(&self, value: f64) -> f64 {
        value.clamp(self.min, self.max)
    }
}

/// Where a knob is going in a frame, if the frame says so.
pub fn knob_target(metrics: &Metrics, knob: Knob) -> Option<f64> {
    match knob {
        Knob::SlideRoll => Some(metrics.slide_roll_target),
        Knob::ForceN | Knob::ForceNPerM => Some(metrics.load_target_n),
        Knob::Amplitude1M | Knob::Amplitude2M | Knob::EntrainmentMS => None,
    }
}

/// The dials of a scene whose load is `load_n` (a line: N/m) and gives `p_hertz_pa`.
pub fn dials(scene: &Scene, load_n: f64, p_hertz_pa: f64) -> Vec<Dial> {
    Knob::ALL
        .into_iter()
        .filter_map(|knob| match knob {
            Knob::SlideRoll => Some(slide_roll(scene.motion.slide_roll)),
            // One place for the load, whichever kind it is.
            Knob::ForceN => Some(load(scene.kind(), load_n, p_hertz_pa)),
            Knob::ForceNPerM => None,
            Knob::Amplitude1M => Some(amplitude(knob, &scene.body_1.surface)),
            Knob::Amplitude2M => Some(amplitude(knob, &scene.body_2.surface)),
            Knob::EntrainmentMS => Some(speed(scene.motion.entrainment_m_s)),
        })
        .map(within_the_scenes_range)
        .map(|dial| within_the_domain(dial, scene))
        .collect()
}

/// No dial turns the load beyond the domain of the run, which would refuse it.
fn within_the_domain(mut dial: Dial, scene: &Scene) -> Dial {
    if matches!(dial.knob, Knob::ForceN | Knob::ForceNPerM)
        && let Ok(plan) = Plan::new(scene)
    {
        dial.max = dial.max.min(plan.most_force_n());
        let (min, max) = (dial.min, dial.max);
        dial.typical.retain(|value| (min..=max).contains(value));
    }
    dial
}

/// No dial reaches where the run would refuse to go.
fn within_the_scenes_range(mut dial: Dial) -> Dial {
    let bounds = match keys::find(dial.knob.key()).map(|key| key.kind) {
        Some(Kind::EitherSign(least, most)) if dial.home < 0.0 => Some((-most, -least)),
        Some(Kind::Number(least, most) | Kind::EitherSign(least, most)) => Some((least, most)),
        _ => None,
    };
    if let Some((least, most)) = bounds {
        dial.min = dial.min.max(least);
        dial.max = dial.max.min(most);
        let (min, max) = (dial.min, dial.max);
        dial.typical.retain(|value| (min..=max).contains(value));
    }
    dial
}

fn slide_roll(home: f64) -> Dial {
    let limit = 2.0;
    Dial {
        knob: Knob::SlideRoll,
        label: "S slide-to-roll",
        scale: Scale::Linear { step: 0.05 },
        far: 5,
        min: -limit,
        max: limit,
        home,
        now: home,
        target: home,
        typical: vec![0.0, 0.05, 0.1, 0.25, 0.5, 0.75, 1.0, 1.3, 1.5],
        life: Life::Live,
    }
}

/// From a ninth of the scene's load to four times it, up to the Hertz pressure that scenes may
/// have; typical values by Hertz pressure.
fn load(kind: ContactKind, home: f64, p_hertz_pa: f64) -> Dial {
    const MOST_PA: f64 = 1e10;
    let order = kind.hertz_shape().order();
    let most = home * (MOST_PA / p_hertz_pa).powi(order);
    let (min, max) = (home / 9.0, (home * 4.0).min(most).max(home));
    let typical = [
        0.75e9, 1.0e9, 1.25e9, 1.5e9, 1.75e9, 2.0e9, 2.25e9, 2.5e9, 3.0e9,
    ]
    .into_iter()
    .map(|p: f64| home * (p / p_hertz_pa).powi(order))
    .filter(|force| (min..=max).contains(force))
    .collect();
    Dial {
        knob: match kind {
            ContactKind::Point => Knob::ForceN,
            ContactKind::Line => Knob::ForceNPerM,
        },
        label: "load",
        scale: Scale::Ratio { ratio: 1.05 },
        far: 5,
        min,
        max,
        home,
        now: home,
        target: home,
        typical,
        life: Life::Live,
    }
}

fn amplitude(knob: Knob, surface: &Surface) -> Dial {
    let (home, life) = match surface {
        Surface::Smooth {} => (0.0, Life::Dead("smooth")),
        Surface::Sinusoid { .. } | Surface::HeightMap { .. } => (surface.amplitude_m(), Life::Live),
    };
    let max = (2.0 * home / 1e-7).ceil().max(6.0) * 1e-7;
    Dial {
        knob,
        label: if knob == Knob::Amplitude1M {
            "A₁ roughness 1"
        } else {
            "A₂ roughness 2"
        },
        scale: Scale::Linear { step: 1e-8 },
        far: 5,
        min: 0.0,
        max,
        home,
        now: home,
        target: home,
        typical: [
            0.0, 0.05e-6, 0.1e-6, 0.15e-6, 0.2e-6, 0.3e-6, 0.4e-6, 0.5e-6, 0.6e-6,
        ]
        .into_iter()
        .filter(|value| *value <= max)
        .collect(),
        life,
    }
}

fn speed(home: f64) -> Dial {
    let (slow, fast) = (home / 10.0, home * 10.0);
    let (min, max) = (slow.min(fast), slow.max(fast));
    Dial {
        knob: Knob::EntrainmentMS,
        label: "U entrainment",
        scale: Scale::Ratio { ratio: 1.1 },
        far: 5,
        min,
        max,
        home,
        now: home,
        target: home,
        typical: [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0]
            .into_iter()
            .map(|value| value * home.signum())
            .filter(|value| (min..=max).contains(value))
            .collect(),
        life: Life::Live,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn steps_land_on_round_values_and_stop_at_the_ends() {
        let mut dial = slide_roll(0.5);
        assert_relative_eq!(dial.turned(1), 0.55, epsilon = 1e-12);
        dial.target = 0.537;
        assert_relative_eq!(dial.turned(1), 0.60, epsilon = 1e-12);
        assert_eq!(dial.turned(1000), 2.0);
        assert_eq!(dial.turned(-1000), -2.0);
    }

    #[test]
    fn ratio_steps_return_to_the_scenes_value() {
        let mut dial = load(ContactKind::Point, 800.0, 1.73e9);
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
            slide_roll(0.5),
            load(ContactKind::Point, 800.0, 1.73e9),
            speed(1.0),
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
        let dial = load(ContactKind::Point, 800.0, 1.73e9);
        assert!(!dial.typical.is_empty() && dial.typical.len() <= 9);
        for force in &dial.typical {
            let p = 1.73 * (force / 800.0).cbrt();
            assert_relative_eq!((p / 0.25).round() * 0.25, p, epsilon = 1e-9);
        }
    }

    #[test]
    fn a_line_has_a_load_per_length() {
        let dial = load(ContactKind::Line, 4.22e5, 1.347e9);
        assert_eq!(dial.knob, Knob::ForceNPerM);
        assert_eq!(dial.unit(Units::Gpa).name, "N/m");
        for force in &dial.typical {
            let p = 1.347 * (force / 4.22e5).sqrt();
            assert_relative_eq!((p / 0.25).round() * 0.25, p, epsilon = 1e-9);
        }
        assert!(dial.answers(Knob::ForceN) && !dial.answers(Knob::SlideRoll));
    }

    #[test]
    fn a_smooth_surface_has_a_dead_dial() {
        let dial = amplitude(Knob::Amplitude1M, &Surface::Smooth {});
        assert_eq!(dial.life, Life::Dead("smooth"));
    }
}
