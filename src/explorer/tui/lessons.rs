//! Lessons that ask: data (`assets/lessons`, or a lecturer's own file) of scenes, knobs, words, questions and claims.
//!
//! A lesson is a row of *beats*. Each stages a scene or goes on with that of the beat before, turns knobs, says what to
//! look at, and claims something of the numbers at its end. A beat may ask before it shows; the right answer is what
//! the simulation then finds. `tests/screen/lessons.rs` runs every lesson without a screen and asserts each claim.

mod figure;
mod read;
mod tour;

use std::sync::{Arc, LazyLock};

use crate::tui::dial::Dial;
use crate::tui::kinds::{MapKind, PanelKind, PointQuantity};
use asperity_engine::scene::{Override, Scene, SceneError};
use asperity_engine::sim::Knob;
pub use figure::{Claim, ComparedWith, LessonFigure, LessonMeasure, LessonQuestion};
pub use tour::{FoundAnswer, TourPhase, TourState};

/// A lesson.
#[derive(Debug, Clone, PartialEq)]
pub struct Lesson {
    /// Its name.
    pub title: String,
    /// Its beats, at least one.
    pub beats: Vec<Beat>,
}

/// One beat: scene, knobs, what is shown, words, and how long they stay.
#[derive(Debug, Clone, PartialEq)]
pub struct Beat {
    /// The scene; `None`: that of the beat before.
    pub staging: Option<Staging>,
    /// What to look at, and what the model leaves out.
    pub caption: String,
    /// Asked before it shows.
    pub question: Option<LessonQuestion>,
    /// Knobs that are set when it shows.
    pub sets: Vec<(Knob, KnobSetting)>,
    /// The map that is shown; `None`: as before.
    pub map: Option<MapKind>,
    /// What is shown of the material point; `None`: as before.
    pub point: Option<PointQuantity>,
    /// The panel that takes the screen.
    pub enlarge: Option<PanelKind>,
    /// How long, in passages.
    pub passages: f64,
    /// What is claimed of the numbers shown.
    pub claims: Vec<Claim>,
}

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
        match self {
            Self::To(value) => value,
            Self::TimesHome(factor) => factor * dial.home,
        }
    }
}

/// The scene of a beat: a preset or file with some keys set.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Staging {
    /// Preset, or a scene's file.
    pub scene: String,
    /// `key=value`, as on the command line.
    pub sets: Vec<String>,
}

impl Staging {
    /// The scene.
    ///
    /// # Errors
    /// When a key or value is not allowed.
    pub fn load(&self) -> Result<Scene, SceneError> {
        let sets = self.sets.iter().map(|text| text.parse());
        let sets = sets.collect::<Result<Vec<Override>, _>>()?;
        Scene::load_with(&self.scene, &sets)
    }
}

impl Lesson {
    /// The scene that a beat shows: its own, or the last one that was staged before.
    pub fn staging(&self, beat: usize) -> Option<&Staging> {
        let before = self.beats.get(..=beat)?;
        before.iter().rev().find_map(|beat| beat.staging.as_ref())
    }

    /// Where a beat has the knobs: what was set since its scene was staged, the last word counts.
    pub fn setting(&self, beat: usize, dial: &Dial) -> Option<KnobSetting> {
        let before = self.beats.get(..=beat)?;
        let staged = before.iter().rposition(|beat| beat.staging.is_some())?;
        let sets = before[staged..].iter().rev().flat_map(|beat| &beat.sets);
        let mut own = sets.filter(|(knob, _)| dial.answers(*knob));
        own.next().map(|(_, setting)| *setting)
    }
}

/// A file of `assets/lessons` with its name.
macro_rules! asset {
    ($name:literal) => {
        (
            $name,
            include_str!(concat!("../../../assets/lessons/", $name, ".toml")),
        )
    };
}

/// The files of the lessons that come with the program, in order.
pub const FILES: [(&str, &str); 13] = [
    asset!("one_passage"),
    asset!("rolling_and_sliding"),
    asset!("thin_film"),
    asset!("waves_flatten"),
    asset!("lay"),
    asset!("load"),
    asset!("gear_tooth"),
    asset!("which_flank"),
    asset!("pit_start"),
    asset!("real_roughness"),
    asset!("warm_oil"),
    asset!("a_little_wear"),
    asset!("doubt"),
];

/// The lessons that come with the program; a test reads each of [`FILES`].
pub fn built_in() -> Arc<[Arc<Lesson>]> {
    static ALL: LazyLock<Arc<[Arc<Lesson>]>> = LazyLock::new(|| {
        let lessons = FILES
            .iter()
            .map(|(name, text)| Lesson::from_toml(text, name));
        lessons.flatten().map(Arc::new).collect()
    });
    Arc::clone(&ALL)
}
