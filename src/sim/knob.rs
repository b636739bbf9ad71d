//! The knobs that may be turned while a simulation runs.

use super::{Quantity, named};

/// A knob. Values are SI; a knob is a target that the drive walks towards, so that turning it is a
/// physical ramp and not a jump.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Knob {
    /// `motion.slide_roll`, S = (U2 - U1)/U.
    SlideRoll,
    /// `load.force_n`, N: the load of a point contact.
    ForceN,
    /// `body_1.surface.amplitude_m`, m.
    Amplitude1M,
    /// `body_2.surface.amplitude_m`, m.
    Amplitude2M,
    /// `motion.entrainment_m_s`, m/s.
    EntrainmentMS,
    /// `load.force_n_per_m`, N/m: the load of a line.
    ForceNPerM,
}

impl Knob {
    /// Every knob.
    pub const ALL: [Self; 6] = [
        Self::SlideRoll,
        Self::ForceN,
        Self::Amplitude1M,
        Self::Amplitude2M,
        Self::EntrainmentMS,
        Self::ForceNPerM,
    ];

    /// The scene key that this knob turns.
    pub fn key(self) -> &'static str {
        match self {
            Self::SlideRoll => "motion.slide_roll",
            Self::ForceN => "load.force_n",
            Self::Amplitude1M => "body_1.surface.amplitude_m",
            Self::Amplitude2M => "body_2.surface.amplitude_m",
            Self::EntrainmentMS => "motion.entrainment_m_s",
            Self::ForceNPerM => "load.force_n_per_m",
        }
    }

    /// What it turns, as the catalogue has it.
    pub fn quantity(self) -> &'static Quantity {
        match self {
            Self::SlideRoll => const { named("slide_roll") },
            Self::ForceN | Self::ForceNPerM => const { named("load_n") },
            Self::Amplitude1M => const { named("amplitude_1_m") },
            Self::Amplitude2M => const { named("amplitude_2_m") },
            Self::EntrainmentMS => const { named("entrainment_m_s") },
        }
    }

    /// The knob with that scene key.
    pub fn from_key(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|knob| knob.key() == key)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::keys;

    #[test]
    fn knobs_are_the_keys_that_scenes_may_script() {
        let keys: Vec<_> = Knob::ALL.iter().map(|knob| knob.key()).collect();
        assert_eq!(keys, keys::KNOB_KEYS);
        for knob in Knob::ALL {
            assert!(keys::find(knob.key()).is_some());
            assert_eq!(Knob::from_key(knob.key()), Some(knob));
        }
    }
}
