//! The tour: lessons that stage scenes, turn their knobs and say what to look at. What a caption claims of
//! the numbers stands beside it and is tested (`tests/screen/lessons.rs`).

mod script;

use crate::scene::{Override, Scene, SceneError};
use crate::sim::{Frame, Knob, Quantity, named};
use crate::tui::app::MapKind;
use crate::tui::dial::Dial;
pub use script::LESSONS;

/// Where a beat puts a knob.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum KnobSetting {
    /// This value, SI.
    To(f64),
    /// So many times the scene's value.
    TimesHome(f64),
}

impl KnobSetting {
    /// The value for a dial.
    pub fn value(self, dial: &Dial) -> f64 {
        let value = match self {
            Self::To(value) => value,
            Self::TimesHome(factor) => factor * dial.home,
        };
        value.clamp(dial.min, dial.max)
    }
}

/// The scene of a beat: a preset with some keys set.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Staging {
    /// Preset.
    pub preset: &'static str,
    /// `key=value`, as on the command line.
    pub sets: &'static [&'static str],
}

impl Staging {
    /// The scene.
    ///
    /// # Errors
    /// When a key or value is not allowed (a test loads all of them).
    pub fn scene(&self) -> Result<Scene, SceneError> {
        let sets = self.sets.iter().map(|text| text.parse());
        let sets = sets.collect::<Result<Vec<Override>, _>>()?;
        Scene::load_with(self.preset, &sets)
    }
}

/// A number that a caption points at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LessonFigure {
    /// n of body 1 by formula.
    N1,
    /// n of body 2 by formula.
    N2,
    /// Cycles counted of body 1.
    Counted1,
    /// Cycles counted of body 2.
    Counted2,
    /// λ.
    Lambda,
    /// Part of the contact that touches, %.
    ContactPercent,
    /// Greatest pressure over Hertz.
    PeakPressure,
    /// Depth of the greatest effective stress, a.
    PeakDepth,
    /// Part of the roughness that is left in the film, %: root mean square along y = 0 within half the contact,
    /// ridges in, film out.
    LeftPercent,
    /// Relative life.
    Life,
    /// Same by the paper's count: every crest a whole cycle.
    PaperLife,
}

impl LessonFigure {
    /// Name on the screen.
    pub fn name(self) -> &'static str {
        match self {
            Self::N1 => "n₁",
            Self::N2 => "n₂",
            Self::Counted1 => "counted₁",
            Self::Counted2 => "counted₂",
            Self::Lambda => "λ",
            Self::ContactPercent => "contact %",
            Self::PeakPressure => "p max/p_h",
            Self::PeakDepth => "σ max at z/a",
            Self::LeftPercent => "ripple left %",
            Self::Life => "life",
            Self::PaperLife => "life by the paper's count",
        }
    }

    /// Its value in a frame, where it is known.
    pub fn of(self, frame: &Frame) -> Option<f64> {
        let known = |quantity: &Quantity| quantity.number(frame);
        match self {
            Self::N1 => known(const { named("n_body_1") }),
            Self::N2 => known(const { named("n_body_2") }),
            Self::Counted1 => known(const { named("n_counted_body_1") }),
            Self::Counted2 => known(const { named("n_counted_body_2") }),
            Self::Lambda => known(const { named("lambda_ratio") }),
            Self::ContactPercent if frame.nx == 0 => None,
            Self::ContactPercent => {
                known(const { named("contact_ratio") }).map(|part| 100.0 * part)
            }
            Self::PeakPressure => known(const { named("p_max_pa") }).map(|p| p / frame.p_hertz_pa),
            Self::PeakDepth => {
                known(const { named("sigma_eff_max_depth_m") }).map(|z| z / frame.a_m)
            }
            Self::LeftPercent => ripple_left(frame).map(|part| 100.0 * part),
            Self::Life => known(const { named("life_relative") }),
            Self::PaperLife => frame.metrics.life?.detail.life_global,
        }
    }
}

/// Ripple of the film over that of the roughness on y = 0, |x| < a/2. Straight lines are taken out.
fn ripple_left(frame: &Frame) -> Option<f64> {
    let row = frame.ny / 2 * frame.nx;
    let inside = |i: &usize| (frame.x_min_m + *i as f64 * frame.dx_m).abs() < 0.5 * frame.a_m;
    let places: Vec<usize> = (0..frame.nx).filter(inside).map(|i| row + i).collect();
    let ripple = |value: &dyn Fn(usize) -> f64| {
        let n = places.len() as f64;
        let middle = 0.5 * (n - 1.0);
        let (mut sum, mut slope, mut squares) = (0.0, 0.0, 0.0);
        for (k, &place) in places.iter().enumerate() {
            sum += value(place);
            slope += (k as f64 - middle) * value(place);
            squares += (k as f64 - middle).powi(2);
        }
        let rest = places.iter().enumerate().map(|(k, &place)| {
            (value(place) - sum / n - slope / squares * (k as f64 - middle)).powi(2)
        });
        (rest.sum::<f64>() / n).sqrt()
    };
    if places.len() < 8 || frame.film_m.len() < frame.nx * frame.ny {
        return None;
    }
    let rough = ripple(&|i| f64::from(frame.roughness_1_m[i]) + f64::from(frame.roughness_2_m[i]));
    let film = ripple(&|i| f64::from(frame.film_m[i]));
    (rough > 0.0).then(|| film / rough)
}

/// What a caption says of a number, at the end of its beat.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Claim {
    /// Which number: it is shown beside the caption.
    pub figure: LessonFigure,
    /// Least value.
    pub least: f64,
    /// Greatest value.
    pub most: f64,
}

impl Claim {
    /// Whether a frame bears it out; what a frame does not know bears nothing out.
    pub fn holds(&self, frame: &Frame) -> bool {
        let value = self.figure.of(frame);
        value.is_some_and(|value| (self.least..=self.most).contains(&value))
    }
}

/// One beat: scene, knobs, a map, words, and how long they stay.
#[derive(Debug)]
pub struct Beat {
    /// The scene; `None`: that of the beat before.
    pub staging: Option<Staging>,
    /// What to look at, and what the model leaves out.
    pub caption: &'static str,
    /// Knobs that are set when it begins.
    pub sets: &'static [(Knob, KnobSetting)],
    /// The map that is shown.
    pub map: Option<MapKind>,
    /// How long, in passages.
    pub passages: f64,
    /// What is claimed of the numbers shown.
    pub claims: &'static [Claim],
}

impl Beat {
    /// The scene, knobs and map of the beat before, nothing claimed.
    const PLAIN: Self = Self {
        staging: None,
        caption: "",
        sets: &[],
        map: None,
        passages: 1.0,
        claims: &[],
    };
}

/// A lesson.
#[derive(Debug)]
pub struct Lesson {
    /// Its name.
    pub title: &'static str,
    /// Its beats.
    pub beats: &'static [Beat],
}

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

    /// Same beat, which begins anew at so many passages.
    #[must_use]
    pub fn anew(&self, passages: f64) -> Self {
        Self {
            since: passages,
            ..*self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lessons_have_words_time_and_scenes_that_load() {
        assert_eq!(LESSONS.len(), 7);
        for lesson in LESSONS {
            assert!(!lesson.title.is_empty() && !lesson.beats.is_empty());
            assert!(lesson.beats[0].staging.is_some(), "{}", lesson.title);
            for beat in lesson.beats {
                assert!(beat.passages > 0.0);
                assert!(
                    (20..=190).contains(&beat.caption.chars().count()),
                    "{}",
                    beat.caption
                );
                assert!(beat.claims.iter().all(|claim| claim.least <= claim.most));
                if let Some(staging) = beat.staging {
                    let scene = staging.scene().map_err(|error| error.to_string());
                    assert_eq!(scene.err(), None, "{staging:?}");
                }
            }
        }
    }

    /// Nothing computed, nothing counted, or no cycle in what was counted: no claim of a count survives it, and no
    /// claim at all the first.
    #[test]
    fn no_claim_holds_where_nothing_is_counted() {
        let counts = [LessonFigure::Counted1, LessonFigure::Counted2];
        let mut idle = Frame::default();
        (idle.nx, idle.p_hertz_pa) = (3, 1.0);
        (idle.metrics.n_body_1, idle.metrics.n_body_2) = (Some(14.0), Some(9.0));
        let mut zero = idle.clone();
        (zero.metrics.n_counted_body_1, zero.metrics.n_counted_body_2) = (Some(0.0), Some(0.0));
        for beat in LESSONS.iter().flat_map(|lesson| lesson.beats) {
            for claim in beat.claims {
                assert!(
                    !claim.holds(&Frame::default()),
                    "{}: {claim:?}",
                    beat.caption
                );
                if counts.contains(&claim.figure) {
                    assert!(
                        !claim.holds(&idle) && !claim.holds(&zero),
                        "{}: {claim:?}",
                        beat.caption
                    );
                }
            }
        }
    }

    /// A formula knows nothing of the simulation: beside each n stands what was counted.
    #[test]
    fn beside_each_n_stands_its_count() {
        for beat in LESSONS.iter().flat_map(|lesson| lesson.beats) {
            let claims = |figure| beat.claims.iter().any(|claim| claim.figure == figure);
            let lonely = |n, counted| claims(n) && !claims(counted);
            assert!(
                !lonely(LessonFigure::N1, LessonFigure::Counted1),
                "{}",
                beat.caption
            );
            assert!(
                !lonely(LessonFigure::N2, LessonFigure::Counted2),
                "{}",
                beat.caption
            );
            assert!(!beat.claims.is_empty(), "{}", beat.caption);
        }
    }

    #[test]
    fn the_last_beats_say_what_the_model_leaves_out() {
        for lesson in LESSONS {
            let last = lesson.beats.last().map(|beat| beat.caption);
            assert!(
                last.is_some_and(|words| words.contains("Not modelled:")),
                "{}",
                lesson.title
            );
        }
    }

    #[test]
    fn a_beat_ends_with_its_time_and_the_last_stays() {
        let tour = TourState::begin(0, 10.0).expect("there is a lesson");
        let length = tour.beat().passages;
        assert_eq!(tour.after(10.0 + 0.9 * length), None);
        let next = tour.after(10.0 + length).expect("a second beat");
        assert_eq!(next.beat, 1);
        let mut last = next;
        while let Some(later) = last.after(1e6) {
            last = later;
        }
        assert_eq!(last.beat + 1, last.lesson().beats.len());
        assert_eq!(TourState::begin(LESSONS.len(), 0.0), None);
    }
}
