//! The knobs: now and target. A target is walked to at the knob's own rate, so that turning a knob is
//! a physical ramp.

use serde::{Deserialize, Serialize};

use crate::scene::Knob;

/// One knob's state.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Setting {
    /// Value of the present step.
    pub(super) now: f64,
    /// Where it goes.
    pub(super) target: f64,
    /// Largest change per dimensionless time (a/U).
    pub(super) rate: f64,
}

impl Setting {
    fn walk(&mut self, dt: f64) {
        let most = self.rate * dt;
        let remaining = self.target - self.now;
        // The last step lands exactly on the target.
        self.now = if remaining.abs() <= most * (1.0 + 1e-9) {
            self.target
        } else {
            self.now + most.copysign(remaining)
        };
    }
}

/// All knobs, SI.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Drive {
    settings: [Setting; Knob::ALL.len()],
}

impl Drive {
    /// Knobs at rest at `values`, with `rates` per a/U.
    pub(super) fn new(values: impl Fn(Knob) -> (f64, f64)) -> Self {
        Self {
            settings: Knob::ALL.map(|knob| {
                let (now, rate) = values(knob);
                Setting {
                    now,
                    target: now,
                    rate,
                }
            }),
        }
    }

    /// The same knobs, but of smooth bodies in pure rolling.
    pub(super) fn smooth(&self) -> Self {
        let mut smooth = self.clone();
        for knob in Knob::OF_ROUGHNESS_AND_SLIDING {
            smooth.jump(knob, 0.0);
        }
        smooth
    }

    fn index(knob: Knob) -> usize {
        Knob::ALL.iter().position(|&k| k == knob).unwrap_or(0)
    }

    /// A knob's state.
    pub(super) fn get(&self, knob: Knob) -> Setting {
        self.settings[Self::index(knob)]
    }

    /// Moves a target.
    pub(super) fn aim(&mut self, knob: Knob, target: f64) {
        self.settings[Self::index(knob)].target = target;
    }

    /// Puts a knob where it is asked to be, without a ramp.
    pub(super) fn jump(&mut self, knob: Knob, value: f64) {
        let setting = &mut self.settings[Self::index(knob)];
        (setting.now, setting.target) = (value, value);
    }

    /// Whether a knob is on its way.
    pub(super) fn is_walking(&self) -> bool {
        self.settings
            .iter()
            .any(|setting| setting.now != setting.target)
    }

    /// Time (a/U) until all knobs are where they go.
    pub(super) fn walk_left(&self) -> f64 {
        let settings = self
            .settings
            .iter()
            .filter(|setting| setting.now != setting.target);
        settings
            .map(|setting| (setting.target - setting.now).abs() / setting.rate)
            .fold(0.0, f64::max)
    }

    /// One time step of `dt` (a/U).
    pub(super) fn walk(&mut self, dt: f64) {
        for setting in &mut self.settings {
            setting.walk(dt);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ramps_arrive_exactly() {
        let mut drive = Drive::new(|_| (0.0, 0.1));
        drive.aim(Knob::SlideRoll, 0.5);
        for _ in 0..5 {
            assert_ne!(drive.get(Knob::SlideRoll).now, 0.5);
            drive.walk(1.0);
        }
        assert_eq!(drive.get(Knob::SlideRoll).now, 0.5);
    }
}
