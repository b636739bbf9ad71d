//! The tour: lessons that turn the knobs of the scene at hand and say what to look at.

use crate::sim::Knob;
use crate::tui::app::MapKind;
use crate::tui::dial::Dial;

/// Where a beat puts a knob.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Setting {
    /// This value, SI.
    To(f64),
    /// So many times the scene's value.
    TimesHome(f64),
}

impl Setting {
    /// The value for a dial.
    pub fn value(self, dial: &Dial) -> f64 {
        let value = match self {
            Self::To(value) => value,
            Self::TimesHome(factor) => factor * dial.home,
        };
        value.clamp(dial.min, dial.max)
    }
}

/// One beat: knobs, a map, words, and how long they stay.
#[derive(Debug)]
pub struct Beat {
    /// What to look at, and what the model leaves out.
    pub caption: &'static str,
    /// Knobs that are set when it begins.
    pub sets: &'static [(Knob, Setting)],
    /// The map that is shown.
    pub map: Option<MapKind>,
    /// How long, in passages.
    pub passages: f64,
}

/// A lesson.
#[derive(Debug)]
pub struct Lesson {
    /// Its name.
    pub title: &'static str,
    /// Its beats.
    pub beats: &'static [Beat],
}

const fn beat(
    caption: &'static str,
    sets: &'static [(Knob, Setting)],
    map: Option<MapKind>,
    passages: f64,
) -> Beat {
    Beat {
        caption,
        sets,
        map,
        passages,
    }
}

const S: Knob = Knob::SlideRoll;
const LOAD: Knob = Knob::ForceN;
const SPEED: Knob = Knob::EntrainmentMS;
const A1: Knob = Knob::Amplitude1M;
const A2: Knob = Knob::Amplitude2M;
use MapKind::{Contact, Film, Pressure, Roughness, Stress};
use Setting::{TimesHome, To};

/// The lessons, in order.
pub const LESSONS: &[Lesson] = &[
    Lesson {
        title: "One passage",
        beats: &[
            beat(
                "Pure rolling, S = 0. Follow the diamond: a point of the surface crosses the contact and is pressed once. n = 1.",
                &[(S, To(0.0))],
                Some(Pressure),
                1.5,
            ),
            beat(
                "The asperities it carries cross with it, in step with those of the mate. Peaks stand on it, but they stay the same peaks.",
                &[],
                Some(Pressure),
                1.0,
            ),
        ],
    },
    Lesson {
        title: "Rolling against sliding: why the count explodes",
        beats: &[
            beat(
                "S = 0: one cycle. Pin this (b) to compare.",
                &[(S, To(0.0))],
                Some(Pressure),
                1.2,
            ),
            beat(
                "S = 0.1: the mate's crests now overtake the point while it crosses. Each is a stress cycle of its own.",
                &[(S, To(0.1))],
                None,
                1.5,
            ),
            beat(
                "S = 0.5: the trace below has become a comb. Life falls by the count alone, before any peak has grown.",
                &[(S, To(0.5))],
                None,
                2.0,
            ),
            beat(
                "n is an upper bound on damage: it counts a small ripple like a full cycle. No wear here, and wear can reverse the trend with S.",
                &[],
                None,
                1.0,
            ),
        ],
    },
    Lesson {
        title: "Thin film: from full film to contact",
        beats: &[
            beat(
                "Fast: the film is thicker than the roughness. No spots touch; λ is in the line at the foot.",
                &[(SPEED, TimesHome(4.0))],
                Some(Film),
                1.5,
            ),
            beat(
                "At the scene's speed.",
                &[(SPEED, TimesHome(1.0))],
                Some(Film),
                1.5,
            ),
            beat(
                "Slow: the film collapses, spots touch, friction rises to the boundary value there. Isothermal: no heat thins the oil.",
                &[(SPEED, TimesHome(0.3))],
                Some(Contact),
                2.0,
            ),
        ],
    },
    Lesson {
        title: "Waves that flatten",
        beats: &[
            beat(
                "The heights as manufactured. In the contact pressure presses them flat: long waves and thin films most.",
                &[(S, To(0.0))],
                Some(Roughness),
                1.0,
            ),
            beat("The film shows what is left of them.", &[], Some(Film), 1.5),
            beat(
                "Twice the height on both bodies: the pressure ripple grows, and life goes with about its tenth power.",
                &[(A1, TimesHome(2.0)), (A2, TimesHome(2.0))],
                Some(Pressure),
                1.5,
            ),
        ],
    },
    Lesson {
        title: "Which surface does it",
        beats: &[
            beat(
                "Only body 2 is rough now: its crests load body 1, whose count is high. Body 2 meets a smooth mate: n₂ = 1.",
                &[(S, To(0.5)), (A1, To(0.0))],
                Some(Pressure),
                1.5,
            ),
            beat(
                "And the other way round: the rough surface imposes the micro-cycles on the other one.",
                &[(A1, TimesHome(1.0)), (A2, To(0.0))],
                None,
                1.5,
            ),
        ],
    },
    Lesson {
        title: "A gear tooth from dedendum to tip",
        beats: &[
            beat(
                "Driver's dedendum: S > 0, body 1 (the driver) is the slower and counts most.",
                &[(S, To(1.0)), (LOAD, TimesHome(0.8))],
                Some(Pressure),
                1.5,
            ),
            beat(
                "Pitch point: pure rolling under full load.",
                &[(S, To(0.0)), (LOAD, TimesHome(1.0))],
                None,
                1.5,
            ),
            beat(
                "Tip: S < 0. Now body 2 is the slower. A real tooth changes radius and load on the way; here only S and the load move.",
                &[(S, To(-0.8)), (LOAD, TimesHome(0.8))],
                None,
                1.5,
            ),
        ],
    },
    Lesson {
        title: "Where does the pit start?",
        beats: &[
            beat(
                "Stress below the surface. Smooth: the maximum lies at about half the contact's half-width, deep below.",
                &[(S, To(0.0)), (A1, To(0.0)), (A2, To(0.0))],
                Some(Stress),
                1.5,
            ),
            beat(
                "Rough: each pressure peak puts a stress peak just under the skin. Pits move from below to the surface.",
                &[(A1, TimesHome(1.5)), (A2, TimesHome(1.5))],
                Some(Stress),
                1.5,
            ),
            beat(
                "Heavier: both grow. Elastic body: no residual stress, no plastic shakedown of the asperities.",
                &[(LOAD, TimesHome(2.0))],
                Some(Stress),
                1.5,
            ),
        ],
    },
];

/// Where the tour is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TourState {
    /// Lesson.
    pub lesson: usize,
    /// Beat of that lesson.
    pub beat: usize,
    /// Passages when the beat began.
    since: f64,
}

impl TourState {
    /// The first beat of a lesson; `None` past the last lesson.
    pub fn begin(lesson: usize, passages: f64) -> Option<Self> {
        (lesson < LESSONS.len()).then_some(Self {
            lesson,
            beat: 0,
            since: passages,
        })
    }

    /// The lesson.
    pub fn lesson(&self) -> &'static Lesson {
        &LESSONS[self.lesson]
    }

    /// The beat.
    pub fn beat(&self) -> &'static Beat {
        &self.lesson().beats[self.beat]
    }

    /// The beat that is due at so many passages; `None` while this one, or the last of a lesson,
    /// stays.
    pub fn after(&self, passages: f64) -> Option<Self> {
        let due = passages - self.since >= self.beat().passages;
        let more = self.beat + 1 < self.lesson().beats.len();
        (due && more).then_some(Self {
            lesson: self.lesson,
            beat: self.beat + 1,
            since: passages,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lessons_have_words_and_time() {
        assert_eq!(LESSONS.len(), 7);
        for lesson in LESSONS {
            assert!(!lesson.title.is_empty() && !lesson.beats.is_empty());
            for beat in lesson.beats {
                assert!(beat.passages > 0.0);
                assert!((20..=180).contains(&beat.caption.len()), "{}", beat.caption);
            }
        }
    }

    #[test]
    fn beats_follow_each_other_by_passages_and_the_last_stays() {
        let Some(first) = TourState::begin(0, 10.0) else {
            panic!("there is a first lesson")
        };
        assert_eq!(first.after(11.4), None);
        let Some(second) = first.after(11.6) else {
            panic!("the second beat is due")
        };
        assert_eq!((second.lesson, second.beat), (0, 1));
        assert_eq!(second.after(1000.0), None);
        assert_eq!(TourState::begin(LESSONS.len(), 0.0), None);
    }
}
