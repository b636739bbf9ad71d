//! Numbers that lessons speak of: a quantity of the catalogue, alone or over another, or over what it was before.
//!
//! ```text
//! alone          n_counted_body_1                               within bounds: how large
//! over another   n_counted_body_1 over n_counted_body_2         > 1: which is the greater
//! over before    p_hertz_pa over before                         the ratio to the end of the beat before
//! ```

use crate::tui::units::{Units, sig};
use asperity_engine::sim::{CATALOGUE, Frame, Quantity, Reading};

/// A number of a frame by its name in lessons.
#[derive(Debug, Clone, Copy)]
pub enum LessonFigure {
    /// A scalar that every output has.
    Of(&'static Quantity),
    /// Part of the roughness that is left in the film: amplitudes along y = 0 within half the contact, ridges in, film out.
    RippleLeft,
    /// Relative life by the paper's count: every crest a whole cycle.
    LifeByContacts,
    /// Minimum and maximum life over the choices of count and model.
    ChoicesApart,
}

/// What only lessons name.
const OWN: [LessonFigure; 3] = [
    LessonFigure::RippleLeft,
    LessonFigure::LifeByContacts,
    LessonFigure::ChoicesApart,
];

/// Names on the screen, where that of the catalogue is long.
const SHORT: [(&str, &str); 12] = [
    ("n_body_1", "n₁"),
    ("n_body_2", "n₂"),
    ("n_counted_body_1", "counted₁"),
    ("n_counted_body_2", "counted₂"),
    ("lambda_ratio", "λ"),
    ("contact_ratio", "contact"),
    ("life_relative", "life"),
    ("sigma_eff_max_depth_m", "z"),
    ("a_m", "a"),
    ("p_hertz_pa", "p_h"),
    ("friction_coefficient", "µ"),
    ("flash_temperature_k", "ΔT"),
];

impl PartialEq for LessonFigure {
    fn eq(&self, other: &Self) -> bool {
        self.name() == other.name()
    }
}

impl LessonFigure {
    /// The one of that name.
    pub fn named(name: &str) -> Option<Self> {
        Self::all().find(|figure| figure.name() == name)
    }

    /// All that lessons may name.
    pub fn all() -> impl Iterator<Item = Self> {
        let idle = Frame::default();
        let numbers = CATALOGUE
            .iter()
            .filter(move |one| !matches!(one.read(&idle), Reading::Word(_)));
        OWN.into_iter().chain(numbers.map(Self::Of))
    }

    /// Its name in lessons: that of the catalogue.
    pub fn name(self) -> &'static str {
        match self {
            Self::Of(quantity) => quantity.name,
            Self::RippleLeft => "ripple_left",
            Self::LifeByContacts => "life_by_contacts",
            Self::ChoicesApart => "choices_apart",
        }
    }

    /// Its name on the screen.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Of(quantity) => {
                let short = SHORT.iter().find(|(name, _)| *name == quantity.name);
                short.map_or(quantity.symbol, |(_, symbol)| symbol)
            }
            Self::RippleLeft => "ripple left",
            Self::LifeByContacts => "life by the paper's count",
            Self::ChoicesApart => "choices differ by",
        }
    }

    /// Its value in a frame (SI), where it is known.
    pub fn of(self, frame: &Frame) -> Option<f64> {
        if frame.nx == 0 {
            // Nothing has been computed.
            return None;
        }
        match self {
            Self::Of(quantity) => quantity.number(frame),
            Self::RippleLeft => ripple_left(frame),
            Self::LifeByContacts => frame.metrics.life?.detail.life_global,
            Self::ChoicesApart => {
                let detail = frame.metrics.life?.detail;
                (detail.spread_low > 0.0).then(|| detail.spread_high / detail.spread_low)
            }
        }
    }

    fn shown(self, value: f64, units: Units, frame: &Frame) -> String {
        match self {
            Self::Of(quantity) => {
                let unit = units.unit(quantity.dimension, frame.kind);
                unit.show(value, 3).trim_end().to_owned()
            }
            Self::RippleLeft => format!("{} %", sig(100.0 * value, 2)),
            Self::LifeByContacts => sig(value, 3),
            Self::ChoicesApart => format!("×{}", sig(value, 2)),
        }
    }
}

/// Amplitude of the film's waves over that of the roughness' on y = 0, |x| < a/2, whatever crest is where: least squares of
/// `h = c + d x + β z + γ z'` by Gram and Schmidt, √(β² + γ² Σ z'²/Σ z²) with both sums along the whole line.
fn ripple_left(frame: &Frame) -> Option<f64> {
    let row = frame.ny / 2 * frame.nx;
    let rough = |i: usize| f64::from(frame.roughness_1_m[i] + frame.roughness_2_m[i]);
    if frame.film_m.len() < row + frame.nx || frame.nx < 3 {
        return None;
    }
    let mut columns: [Vec<f64>; 5] = Default::default();
    let (mut heights, mut slopes) = (0.0, 0.0);
    for i in 1..frame.nx - 1 {
        let (z, slope) = (rough(row + i), rough(row + i + 1) - rough(row + i - 1));
        heights += z * z;
        slopes += slope * slope;
        let x = frame.x_min_m + i as f64 * frame.dx_m;
        if x.abs() < 0.5 * frame.a_m {
            let values = [1.0, x, z, slope, f64::from(frame.film_m[row + i])];
            columns
                .iter_mut()
                .zip(values)
                .for_each(|(column, value)| column.push(value));
        }
    }
    let mut parts = [[0.0; 5]; 5];
    for (k, parts) in parts.iter_mut().enumerate() {
        let (done, own) = columns.split_at_mut(k);
        for (column, part) in done.iter().zip(parts) {
            let dot = |other: &[f64]| column.iter().zip(other).map(|(a, b)| a * b).sum::<f64>();
            *part = dot(&own[0]) / dot(column);
            own[0]
                .iter_mut()
                .zip(column)
                .for_each(|(own, other)| *own -= *part * other);
        }
    }
    let across = parts[4][3];
    let in_phase = parts[4][2] - across * parts[3][2];
    let left = (in_phase.powi(2) + across.powi(2) * slopes / heights).sqrt();
    (columns[0].len() >= 8 && left.is_finite()).then_some(left)
}

/// What a number is compared with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ComparedWith {
    /// Nothing: it stands alone.
    Nothing,
    /// Another number of the same frame.
    Figure(LessonFigure),
    /// Itself, at the end of the beat before.
    Before,
}

/// A number, or the ratio of two.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LessonMeasure {
    /// The number.
    pub of: LessonFigure,
    /// What it is divided by.
    pub over: ComparedWith,
}

impl LessonMeasure {
    /// Its value in a frame, `before` that at the end of the beat before; `None`: not known, or over nothing.
    pub fn value(&self, frame: &Frame, before: Option<&Frame>) -> Option<f64> {
        let base = match self.over {
            ComparedWith::Nothing => 1.0,
            ComparedWith::Figure(other) => other.of(frame)?,
            ComparedWith::Before => self.of.of(before?)?,
        };
        let value = self.of.of(frame)? / base;
        value.is_finite().then_some(value)
    }

    /// Its name on the screen.
    pub fn symbol(&self) -> String {
        match self.over {
            ComparedWith::Nothing | ComparedWith::Before => self.of.symbol().to_owned(),
            ComparedWith::Figure(other) => format!("{}/{}", self.of.symbol(), other.symbol()),
        }
    }

    /// A value of it as the screen has it: `1.73 GPa`, `0.48`, `×1.26`.
    pub fn shown(&self, value: Option<f64>, units: Units, frame: &Frame) -> String {
        match (value, self.over) {
            (None, _) => "–".to_owned(),
            (Some(value), ComparedWith::Nothing) => self.of.shown(value, units, frame),
            (Some(value), ComparedWith::Figure(_)) => sig(value, 3),
            (Some(value), ComparedWith::Before) => format!("×{}", sig(value, 3)),
        }
    }
}

/// What a beat says of a number, at its end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Claim {
    /// Which number: it is shown beside the caption.
    pub measure: LessonMeasure,
    /// Minimum value.
    pub min: f64,
    /// Maximum value.
    pub max: f64,
}

impl Claim {
    /// Whether a frame bears it out; what a frame does not know bears nothing out.
    pub fn holds(&self, frame: &Frame, before: Option<&Frame>) -> bool {
        let value = self.measure.value(frame, before);
        value.is_some_and(|value| (self.min..=self.max).contains(&value))
    }
}

/// What is asked before it shows. Limits part all values among the answers, so that exactly one is right, which the
/// simulation says.
#[derive(Debug, Clone, PartialEq)]
pub struct LessonQuestion {
    /// The question.
    pub ask: String,
    /// The number that answers it.
    pub measure: LessonMeasure,
    /// Answers, those of lesser values first.
    pub answers: Vec<String>,
    /// From which value on the next answer is the right one, rising.
    pub limits: Vec<f64>,
    /// Why it is so: said when the answer is there.
    pub because: String,
}

impl LessonQuestion {
    /// Which answer a value makes the right one, from 0.
    pub fn right(&self, value: f64) -> usize {
        self.limits.iter().filter(|limit| value >= **limit).count()
    }
}
