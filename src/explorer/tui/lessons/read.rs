//! A lesson from its file, which may be anybody's: every refusal names key, value and what is allowed.

use std::collections::BTreeMap;
use std::fmt::Display;
use std::path::Path;

use serde::Deserialize;

use super::figure::{Claim, ComparedWith, LessonFigure, LessonMeasure, LessonQuestion};
use super::{Beat, KnobSetting, Lesson, Staging};
use crate::tui::dial::{Dial, dials};
use crate::tui::kinds::{MapKind, PanelKind, PointQuantity};
use asperity_engine::files::read_up_to;
use asperity_engine::plan::Plan;
use asperity_engine::scene::drives_a_terminal;
use asperity_engine::scene::{Knob, SceneError, presets};

/// Longest file, bytes.
const LONGEST_LESSON: u64 = 1 << 18;
/// Beats, and claims of one.
const MOST: usize = 30;
/// Letters of a title or an answer, and of the words of a beat.
const LETTERS: [usize; 2] = [60, 240];
/// Passages that a beat may last.
const LONGEST_BEAT: f64 = 50.0;
/// Answers have digits.
const ANSWERS: std::ops::RangeInclusive<usize> = 2..=9;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LessonFile {
    title: String,
    #[serde(default = "default_scene")]
    scene: String,
    #[serde(default)]
    set: Vec<String>,
    beat: Vec<BeatFile>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct BeatFile {
    scene: Option<String>,
    set: Option<Vec<String>>,
    caption: String,
    #[serde(default)]
    knobs: BTreeMap<String, f64>,
    #[serde(default)]
    times: BTreeMap<String, f64>,
    map: Option<String>,
    point: Option<String>,
    enlarge: Option<String>,
    passages: f64,
    #[serde(default)]
    claims: Vec<ClaimFile>,
    question: Option<QuestionFile>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ClaimFile {
    of: String,
    over: Option<String>,
    from: Option<f64>,
    to: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct QuestionFile {
    ask: String,
    of: String,
    over: Option<String>,
    answers: Vec<String>,
    limits: Vec<f64>,
    because: String,
}

/// The quick one: ten minutes of lessons wait for no mesh, and what they claim holds on it.
fn default_scene() -> String {
    presets::QUICK.to_owned()
}

type LessonRead<T> = Result<T, SceneError>;

fn refused<T>(
    key: impl Into<String>,
    value: impl Display,
    allowed: impl Into<String>,
) -> LessonRead<T> {
    Err(SceneError::value(key, value, allowed))
}

impl Lesson {
    /// A lesson from a file, with its scenes checked.
    ///
    /// # Errors
    /// Key, value and what is allowed; of a text that is no TOML line and column.
    pub fn load(path: &Path) -> Result<Self, SceneError> {
        let name = path.display().to_string();
        let refusal = |reason: String| SceneError::value("--lesson", &name, reason);
        let bytes = read_up_to(path, LONGEST_LESSON)
            .map_err(|error| refusal(format!("a lesson's file ({error})")))?;
        if bytes.len() as u64 > LONGEST_LESSON {
            return Err(refusal("a file of at most 256 KiB".to_owned()));
        }
        let text = String::from_utf8(bytes).map_err(|_| refusal("UTF-8 text".to_owned()))?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let mut lesson = Self::from_toml(&text, &name)?;
        for staging in lesson
            .beats
            .iter_mut()
            .filter_map(|beat| beat.staging.as_mut())
        {
            if presets::find(&staging.scene).is_none() {
                // Scenes are sought beside the lesson.
                staging.scene = folder.join(&staging.scene).display().to_string();
            }
        }
        lesson.check()?;
        Ok(lesson)
    }

    /// A lesson from its text; scenes are not loaded yet.
    ///
    /// # Errors
    /// As [`Lesson::load`].
    pub fn from_toml(text: &str, origin: &str) -> Result<Self, SceneError> {
        let file: LessonFile = toml::from_str(text).map_err(|error| SceneError::Syntax {
            origin: origin.to_owned(),
            reason: error.to_string(),
        })?;
        let title = words("title", &file.title, LETTERS[0])?;
        if !(1..=MOST).contains(&file.beat.len()) {
            return refused("[[beat]]", file.beat.len(), format!("1 to {MOST} of them"));
        }
        let mut beats = Vec::with_capacity(file.beat.len());
        for (place, beat) in file.beat.into_iter().enumerate() {
            let stages = place == 0 || beat.scene.is_some() || beat.set.is_some();
            // Another scene than the lesson's begins with none of its settings.
            let common = file.set.iter().filter(|_| beat.scene.is_none());
            let staging = stages.then(|| Staging {
                scene: beat.scene.clone().unwrap_or_else(|| file.scene.clone()),
                sets: common.chain(beat.set.iter().flatten()).cloned().collect(),
            });
            beats.push(BeatReader(place + 1).beat(beat, staging)?);
        }
        Ok(Self { title, beats })
    }

    /// Whether every scene loads, has a plan, and takes the knobs where they are put.
    ///
    /// # Errors
    /// What a scene or plan is refused for; a knob with its value and range.
    pub fn check(&self) -> Result<(), SceneError> {
        let mut here: Vec<Dial> = Vec::new();
        for (place, beat) in self.beats.iter().enumerate() {
            let at = |name: &str| format!("beat {}: {name}", place + 1);
            if let Some(staging) = &beat.staging {
                let scene = staging.load()?;
                let plan = Plan::new(&scene).map_err(|error| {
                    SceneError::value(at("scene"), &staging.scene, error.to_string())
                })?;
                here = dials(&scene, plan.force_n, plan.hertz.p_max_pa);
            }
            for (knob, setting) in &beat.sets {
                let Some(dial) = here.iter().find(|dial| dial.answers(*knob)) else {
                    return refused(at("knobs"), knob.key(), "a knob of the scene");
                };
                dial.checked(setting.value(dial))?;
            }
        }
        Ok(())
    }
}

/// Letters that can be shown, on one line.
fn words(key: impl Into<String>, text: &str, most: usize) -> LessonRead<String> {
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let fits = (1..=most).contains(&line.chars().count());
    if fits && !line.chars().any(drives_a_terminal) {
        return Ok(line);
    }
    refused(
        key,
        line,
        format!("1 to {most} letters, none of them a control character"),
    )
}

/// One of some names.
fn one_of<T: Copy>(
    key: String,
    name: &str,
    all: &[T],
    of: impl Fn(T) -> &'static str,
) -> LessonRead<T> {
    let found = all.iter().find(|one| of(**one) == name);
    let names = || {
        all.iter()
            .map(|one| of(*one))
            .collect::<Vec<_>>()
            .join(", ")
    };
    found
        .copied()
        .map_or_else(|| refused(key, name, names()), Ok)
}

fn figure(key: String, name: &str) -> LessonRead<LessonFigure> {
    let names = || {
        let names: Vec<&str> = LessonFigure::all().map(LessonFigure::name).collect();
        format!("one of {}", names.join(", "))
    };
    LessonFigure::named(name).map_or_else(|| refused(key, name, names()), Ok)
}

/// Reads the beat of that number.
struct BeatReader(usize);

impl BeatReader {
    fn key(&self, name: &str) -> String {
        format!("beat {}: {name}", self.0)
    }

    fn beat(&self, file: BeatFile, staging: Option<Staging>) -> LessonRead<Beat> {
        if !(file.passages > 0.0 && file.passages <= LONGEST_BEAT) {
            let range = format!("above 0, to {LONGEST_BEAT}");
            return refused(self.key("passages"), file.passages, range);
        }
        if file.claims.len() > MOST {
            return refused(
                self.key("claims"),
                file.claims.len(),
                format!("at most {MOST}"),
            );
        }
        let map = file.map.as_deref();
        let point = file.point.as_deref();
        let enlarge = file.enlarge.as_deref();
        let claims = file.claims.iter().map(|claim| self.claim(claim));
        Ok(Beat {
            staging,
            caption: words(self.key("caption"), &file.caption, LETTERS[1])?,
            sets: self.sets(&file)?,
            map: map
                .map(|name| one_of(self.key("map"), name, &MapKind::ALL, MapKind::name))
                .transpose()?,
            point: point
                .map(|name| {
                    one_of(
                        self.key("point"),
                        name,
                        &PointQuantity::ALL,
                        PointQuantity::name,
                    )
                })
                .transpose()?,
            enlarge: enlarge
                .map(|name| one_of(self.key("enlarge"), name, &PanelKind::ALL, PanelKind::name))
                .transpose()?,
            passages: file.passages,
            claims: claims.collect::<LessonRead<_>>()?,
            question: file
                .question
                .map(|asked| self.question(asked))
                .transpose()?,
        })
    }

    /// Knobs by their scene keys: to a value, or so many times the scene's.
    fn sets(&self, file: &BeatFile) -> LessonRead<Vec<(Knob, KnobSetting)>> {
        let to = file.knobs.iter();
        let to = to.map(|(key, value)| ("knobs", key, KnobSetting::To(*value)));
        let times = file.times.iter();
        let times = times.map(|(key, value)| ("times", key, KnobSetting::TimesHome(*value)));
        let mut sets = Vec::new();
        for (table, key, setting) in to.chain(times) {
            let Some(knob) = Knob::from_key(key) else {
                return refused(self.key(table), key, format!("one of {}", Knob::keys()));
            };
            let (KnobSetting::To(value) | KnobSetting::TimesHome(value)) = setting;
            if !value.is_finite() {
                return refused(self.key(key), value, "a number");
            }
            sets.push((knob, setting));
        }
        Ok(sets)
    }

    fn measure(&self, table: &str, of: &str, over: Option<&str>) -> LessonRead<LessonMeasure> {
        let key = |name: &str| self.key(&format!("{table}.{name}"));
        Ok(LessonMeasure {
            of: figure(key("of"), of)?,
            over: match over {
                None => ComparedWith::Nothing,
                // The first beat has none before it.
                Some("before") if self.0 > 1 => ComparedWith::Before,
                Some(name) => ComparedWith::Figure(figure(key("over"), name)?),
            },
        })
    }

    fn claim(&self, file: &ClaimFile) -> LessonRead<Claim> {
        let measure = self.measure("claims", &file.of, file.over.as_deref())?;
        let min = file.from.unwrap_or(f64::NEG_INFINITY);
        let max = file.to.unwrap_or(f64::INFINITY);
        let is_bounded = min.is_finite() || max.is_finite();
        if !(is_bounded && min <= max) {
            let found = format!("from {min} to {max}");
            let allowed = "from <= to, at least one of them";
            return refused(self.key("claims"), found, allowed);
        }
        Ok(Claim { measure, min, max })
    }

    fn question(&self, file: QuestionFile) -> LessonRead<LessonQuestion> {
        let key = |name: &str| self.key(&format!("question.{name}"));
        if !ANSWERS.contains(&file.answers.len()) {
            let range = format!("{} to {} of them", ANSWERS.start(), ANSWERS.end());
            return refused(key("answers"), file.answers.len(), range);
        }
        let rising = file.limits.is_sorted_by(|one, next| one < next);
        let finite = file.limits.iter().all(|limit| limit.is_finite());
        if file.limits.len() + 1 != file.answers.len() || !rising || !finite {
            let range = format!(
                "{} rising numbers, one fewer than answers",
                file.answers.len() - 1
            );
            return refused(key("limits"), format!("{:?}", file.limits), range);
        }
        let answers = file.answers.iter();
        let answers = answers.map(|answer| words(key("answers"), answer, LETTERS[0]));
        Ok(LessonQuestion {
            ask: words(key("ask"), &file.ask, LETTERS[1])?,
            measure: self.measure("question", &file.of, file.over.as_deref())?,
            answers: answers.collect::<LessonRead<_>>()?,
            limits: file.limits,
            because: words(key("because"), &file.because, LETTERS[1])?,
        })
    }
}
