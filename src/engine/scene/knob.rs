//! The knobs that may be turned while a simulation runs: each with a line of what it is. Scripted events, sweeps, the drive, the
//! explorer and the help read it; unit, range and meaning are those of the [key](Knob::scene_key) that it turns.

use std::fmt::Write as _;

use super::keys::{self, Key};
use super::{ContactKind, Load, Scene, Surface};

crate::closed_set! {
    /// A knob, each with the scene key that it turns and its symbol and name on the screen. Values are SI; a knob is a target
    /// that the drive walks towards, so that turning it is a physical ramp and not a jump.
    #[derive(Hash, PartialOrd, Ord)]
    pub enum Knob {
        /// S = (U2 - U1)/U.
        SlideRoll = "motion.slide_roll" "S slide-to-roll",
        /// The load of a point contact, N.
        ForceN = "load.force_n" "load",
        /// Amplitude of body 1, m.
        Amplitude1M = "body_1.surface.amplitude_m" "A₁ roughness 1",
        /// Amplitude of body 2, m.
        Amplitude2M = "body_2.surface.amplitude_m" "A₂ roughness 2",
        /// Entrainment speed, m/s.
        EntrainmentMS = "motion.entrainment_m_s" "U entrainment",
        /// The load of a line, N/m.
        ForceNPerM = "load.force_n_per_m" "load",
    }
}

/// What the table says of a knob.
#[derive(Debug, Clone, Copy)]
pub struct KnobLine {
    /// Scalar of a frame that says where it is.
    pub quantity: &'static str,
    /// Scalar that says where it is going, if frames tell.
    pub target: Option<&'static str>,
    /// Which values a hand reaches, within the range of the key.
    pub reach: Reach,
    /// Small steps.
    pub steps: Steps,
    /// Small steps in a big one.
    pub big_step: i32,
    /// Typical values, each with what it is typical of (a preset by its name), or "".
    pub typical: &'static [(f64, &'static str)],
    /// How fast it is walked to its target.
    pub ramp: RampRate,
}

/// How a range is divided.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Steps {
    /// Steps of equal difference.
    Equal(f64),
    /// Steps of equal ratio, counted from the scene's value.
    Ratio(f64),
}

/// Which values a hand reaches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reach {
    /// The whole range of the key.
    Key,
    /// From one part in so many of the scene's value to so many times it.
    Times(f64, f64),
    /// The same of a load, whose typical values are Hertz pressures, Pa.
    LoadTimes(f64, f64),
    /// From 0 to so many times the scene's value on a round number of the second, or at least so many of it.
    FromZero(f64, f64, f64),
}

/// Largest change per dimensionless time a/U: a part of the scene's value, and at least so much.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RampRate {
    part: f64,
    least: f64,
}

impl RampRate {
    /// The rate of a knob whose scene has that value, per a/U.
    pub fn rate(self, value: f64) -> f64 {
        (self.part * value).max(self.least)
    }
}

const AMPLITUDE: KnobLine = KnobLine {
    quantity: "",
    target: None,
    reach: Reach::FromZero(2.0, 1e-7, 6.0),
    steps: Steps::Equal(1e-8),
    big_step: 5,
    typical: &[
        (0.0, "smooth"),
        (0.05e-6, ""),
        (0.1e-6, ""),
        (0.15e-6, ""),
        (0.2e-6, ""),
        (0.3e-6, ""),
        (0.4e-6, ""),
        (0.5e-6, ""),
        (0.6e-6, ""),
    ],
    ramp: RampRate {
        part: 1.0,
        least: 1e-7,
    },
};

const LOAD: KnobLine = KnobLine {
    quantity: "load_n",
    target: Some("load_target_n"),
    reach: Reach::LoadTimes(9.0, 4.0),
    steps: Steps::Ratio(1.05),
    big_step: 5,
    typical: &[
        (0.75e9, ""),
        (1.0e9, ""),
        (1.25e9, ""),
        (1.5e9, ""),
        (1.75e9, ""),
        (2.0e9, ""),
        (2.25e9, ""),
        (2.5e9, ""),
        (3.0e9, ""),
    ],
    ramp: RampRate {
        part: 0.5,
        least: 0.0,
    },
};

const SLIDE_ROLL: KnobLine = KnobLine {
    quantity: "slide_roll",
    target: Some("slide_roll_target"),
    reach: Reach::Key,
    steps: Steps::Equal(0.05),
    big_step: 5,
    typical: &[
        (0.0, "fzg_pitch_point"),
        (0.05, ""),
        (0.1, "micropitting_rig"),
        (0.25, ""),
        (0.5, "twin_disc"),
        (0.75, ""),
        (1.0, ""),
        (1.3, "fzg_point_a"),
        (1.5, "cam_nose"),
    ],
    ramp: RampRate {
        part: 0.0,
        least: 1.0,
    },
};

const ENTRAINMENT: KnobLine = KnobLine {
    quantity: "entrainment_m_s",
    target: None,
    reach: Reach::Times(10.0, 10.0),
    steps: Steps::Ratio(1.1),
    big_step: 5,
    typical: &[
        (0.1, ""),
        (0.2, ""),
        (0.5, ""),
        (1.0, ""),
        (2.0, ""),
        (5.0, ""),
        (10.0, ""),
        (20.0, ""),
        (50.0, ""),
    ],
    ramp: RampRate {
        part: 0.5,
        least: 0.0,
    },
};

impl Knob {
    /// Amplitudes of body 1 and 2.
    pub const AMPLITUDES: [Self; 2] = [Self::Amplitude1M, Self::Amplitude2M];

    /// Knobs that the smooth contact does not depend on: a run may begin with the end of one that differs in these alone.
    pub const OF_ROUGHNESS_AND_SLIDING: [Self; 3] =
        [Self::Amplitude1M, Self::Amplitude2M, Self::SlideRoll];

    /// Its line of the table.
    pub const fn line(self) -> &'static KnobLine {
        match self {
            Self::SlideRoll => &SLIDE_ROLL,
            Self::ForceN | Self::ForceNPerM => &LOAD,
            Self::Amplitude1M => &KnobLine {
                quantity: "amplitude_1_m",
                ..AMPLITUDE
            },
            Self::Amplitude2M => &KnobLine {
                quantity: "amplitude_2_m",
                ..AMPLITUDE
            },
            Self::EntrainmentMS => &ENTRAINMENT,
        }
    }

    /// That key: unit, range, meaning.
    pub fn scene_key(self) -> Option<&'static Key> {
        keys::find(self.key())
    }

    /// Unit of its values in scenes.
    pub fn unit(self) -> &'static str {
        self.scene_key().map_or("", |key| key.unit)
    }

    /// Whether scenes may have that value.
    pub fn takes(self, value: f64) -> bool {
        self.scene_key().is_some_and(|key| key.kind.takes(value))
    }

    /// All keys, for messages.
    pub fn keys() -> String {
        Self::KEYS.join(", ")
    }

    /// The knob of the load.
    pub const fn of_load(kind: ContactKind) -> Self {
        match kind {
            ContactKind::Point => Self::ForceN,
            ContactKind::Line => Self::ForceNPerM,
        }
    }

    /// The kind of contact whose load it is; `None`: it is no load.
    pub const fn load_of(self) -> Option<ContactKind> {
        match self {
            Self::ForceN => Some(ContactKind::Point),
            Self::ForceNPerM => Some(ContactKind::Line),
            Self::SlideRoll | Self::Amplitude1M | Self::Amplitude2M | Self::EntrainmentMS => None,
        }
    }

    /// Whether it is a load, of either kind of contact.
    pub const fn is_load(self) -> bool {
        self.load_of().is_some()
    }

    /// The body (0 or 1) whose roughness it is.
    pub fn body(self) -> Option<usize> {
        Self::AMPLITUDES.into_iter().position(|knob| knob == self)
    }

    /// The surface whose roughness it is.
    pub fn surface(self, scene: &Scene) -> Option<&Surface> {
        Some(scene.surfaces()[self.body()?])
    }

    /// Its value in a scene; of a load that of the kind of contact that the scene has.
    pub fn of(self, scene: &Scene) -> f64 {
        match self {
            Self::SlideRoll => scene.motion.slide_roll,
            Self::ForceN | Self::ForceNPerM => scene.force_n(),
            Self::Amplitude1M => scene.body_1.surface.amplitude_m(),
            Self::Amplitude2M => scene.body_2.surface.amplitude_m(),
            Self::EntrainmentMS => scene.motion.entrainment_m_s,
        }
    }

    /// Writes a value into a scene.
    pub fn put(self, scene: &mut Scene, value: f64) {
        match self {
            Self::SlideRoll => scene.motion.slide_roll = value,
            Self::ForceN => scene.load = Load::of_force_n(value),
            Self::ForceNPerM => scene.load = Load::of_force_n_per_m(value),
            Self::Amplitude1M => scene.body_1.surface.set_amplitude_m(value),
            Self::Amplitude2M => scene.body_2.surface.set_amplitude_m(value),
            Self::EntrainmentMS => scene.motion.entrainment_m_s = value,
        }
    }

    /// The range of its key on that side of 0 where `home` is.
    fn range(self, home: f64) -> (f64, f64) {
        let range = self.scene_key().and_then(|key| key.kind.range(home));
        range.unwrap_or((f64::NEG_INFINITY, f64::INFINITY))
    }

    /// The values that a hand reaches where the scene has `home`, which is a load of `p_hertz_pa` in a contact of that kind,
    /// and the typical ones among them.
    pub fn reach(
        self,
        home: f64,
        (kind, p_hertz_pa): (ContactKind, f64),
    ) -> ([f64; 2], Vec<(f64, &'static str)>) {
        let line = self.line();
        let order = kind.order();
        let load_at = |p_pa: f64| home * (p_pa / p_hertz_pa).powi(order);
        let (least, most) = self.range(home);
        let (from, to) = match line.reach {
            Reach::Key => (least, most),
            Reach::Times(down, up) => {
                let (slow, fast) = (home / down, home * up);
                (slow.min(fast), slow.max(fast))
            }
            Reach::LoadTimes(down, up) => {
                let pressure = keys::find("load.hertz_pressure_pa");
                let range = pressure.and_then(|key| key.kind.range(p_hertz_pa));
                let most = range.map_or(f64::INFINITY, |(_, most_pa)| load_at(most_pa));
                (home / down, (home * up).min(most).max(home))
            }
            Reach::FromZero(times, unit, at_least) => {
                (0.0, (times * home / unit).ceil().max(at_least) * unit)
            }
        };
        let (from, to) = (from.max(least), to.min(most));
        let si = |value: f64| match line.reach {
            Reach::LoadTimes(..) => load_at(value),
            Reach::Times(..) => value * home.signum(),
            Reach::Key | Reach::FromZero(..) => value,
        };
        let typical = line.typical.iter().map(|(value, name)| (si(*value), *name));
        let typical = typical.filter(|(value, _)| (from..=to).contains(value));
        ([from, to], typical.collect())
    }

    /// All knobs in words, for the help.
    pub fn table() -> String {
        let mut text =
            "Knobs, which [[event]] of a scene may set too. A change is a ramp in time, no jump:\n"
                .to_owned();
        for knob in Self::ALL {
            let line = knob.line();
            let steps = match line.steps {
                Steps::Equal(step) => format!("steps of {}", keys::short(step)),
                Steps::Ratio(ratio) => format!("steps of {:.0} %", 100.0 * (ratio - 1.0)),
            };
            let reach = match line.reach {
                Reach::Key => String::new(),
                Reach::Times(down, up) | Reach::LoadTimes(down, up) => {
                    format!("; by hand 1/{down:.0} to {up:.0} times the scene's")
                }
                Reach::FromZero(times, unit, at_least) => format!(
                    "; by hand up to {times:.0} times the scene's or {}",
                    keys::short(at_least * unit)
                ),
            };
            let allowed = knob.scene_key().map(Key::allowed).unwrap_or_default();
            // Writing to a String cannot fail.
            let _ = writeln!(text, "  {:<28}{allowed}; {steps}{reach}", knob.key());
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::keys::Kind;
    use crate::scene::presets;

    #[test]
    fn knobs_turn_keys_that_scenes_have() {
        for knob in Knob::ALL {
            let key = knob.scene_key().expect("a key of scenes");
            assert!(matches!(key.kind, Kind::Number(..) | Kind::EitherSign(..)));
            assert!(knob.line().typical.len() <= 9, "one a digit key");
        }
    }

    #[test]
    fn a_preset_that_gives_a_typical_value_its_name_has_that_value() {
        let mut found = 0;
        for knob in Knob::ALL {
            for (value, name) in knob.line().typical {
                if presets::find(name).is_some() {
                    let scene = Scene::load(name).expect("a preset");
                    assert_eq!(knob.of(&scene), *value, "{name}");
                    found += 1;
                }
            }
        }
        assert!(found >= 5, "{found}");
    }

    #[test]
    fn what_is_put_into_a_scene_is_read_back() {
        for preset in ["demonstration", "fzg_point_b"] {
            let mut scene = Scene::load(preset).expect("a preset");
            let load = Knob::of_load(scene.kind());
            for knob in Knob::ALL {
                if knob.is_load() && knob != load
                    || knob.surface(&scene).is_some_and(Surface::is_smooth)
                {
                    continue;
                }
                let value = 1.25 * knob.of(&scene) + 1e-9;
                knob.put(&mut scene, value);
                assert_eq!(knob.of(&scene), value, "{knob:?}");
            }
        }
    }

    #[test]
    fn a_hand_reaches_nothing_that_scenes_may_not_have() {
        for knob in Knob::ALL {
            let homes = [1e-6, 1.0, 150.0, -150.0];
            for home in homes.into_iter().filter(|home| knob.takes(*home)) {
                let ([from, to], typical) = knob.reach(home, (ContactKind::Point, 9.0e9));
                let ends = knob.takes(from) && knob.takes(to) && from < to;
                assert!(
                    ends && typical.iter().all(|(value, _)| knob.takes(*value)),
                    "{knob:?} {home}"
                );
            }
        }
    }
}
