//! What a line of the [`CATALOGUE`] says of a quantity, and how it is looked up.
//!
//! Names are looked up where they are compiled: `const { named("p_max_pa") }` of a name that is not there is no program.

use super::{CATALOGUE, Frame, Metrics};
use crate::math::number::Unit;
use crate::scene::ContactKind;
use crate::sim::LifeEstimate;

/// A number that every output shows by the same name.
#[derive(Debug, Clone, Copy)]
pub struct Quantity {
    /// Name in files: the key of summaries, the column of tables, with its SI unit.
    pub name: &'static str,
    /// Symbol or short name, for legends and screens.
    pub symbol: &'static str,
    /// What it measures.
    pub dimension: Dimension,
    /// What it is, in words.
    pub meaning: &'static str,
    /// Numbers of a summary that it gives, and how each sums up a passage.
    pub over: &'static [(Over, &'static str)],
    /// Whether outputs show it by this line alone: a curve, a row, a word of its own. Others have their place in sentences and
    /// groups of curves.
    pub by_itself: bool,
    source: Source,
}

/// Where it is read.
#[derive(Debug, Clone, Copy)]
pub(super) enum Source {
    Frame(fn(&Frame) -> Reading),
    Metrics(fn(&Metrics) -> Reading),
    Life(fn(&LifeEstimate) -> Reading),
}

/// What is read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reading {
    /// Not known yet, or not in this scene.
    Unknown,
    /// SI; 1 for yes and 0 for no.
    Number(f64),
    /// A word.
    Word(&'static str),
}

/// What is measured, which decides the unit that people see.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dimension {
    /// No unit.
    Plain,
    /// A part of a whole.
    Share,
    /// s
    Time,
    /// Pa
    Pressure,
    /// m, of films.
    Film,
    /// m, of places and sizes.
    Length,
    /// m, of roughness.
    Height,
    /// m/s
    Speed,
    /// N, of a line N/m.
    Load,
    /// m³, of a line m³ per metre.
    Volume,
}

/// How a passage, or the period that is averaged over, is summed up in one number. Steps in which it is not known are left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Over {
    /// Mean, each step by its length.
    Mean,
    /// Greatest of the steps.
    Greatest,
    /// Least of the steps.
    Least,
    /// Last step.
    Last,
}

impl Dimension {
    /// Unit in recordings.
    pub fn unit(self, kind: ContactKind) -> Unit {
        let (name, per_si) = match self {
            Self::Plain => ("", 1.0),
            Self::Share => ("%", 100.0),
            Self::Time => ("s", 1.0),
            Self::Pressure => ("GPa", 1e-9),
            Self::Film | Self::Length | Self::Height => ("µm", 1e6),
            Self::Speed => ("m/s", 1.0),
            Self::Load if kind == ContactKind::Line => ("N/m", 1.0),
            Self::Load => ("N", 1.0),
            Self::Volume => ("µm³", 1e18),
        };
        Unit { name, per_si }
    }

    /// Unit in texts: films in nanometres.
    fn unit_in_words(self, kind: ContactKind) -> Unit {
        match self {
            Self::Film => Unit {
                name: "nm",
                per_si: 1e9,
            },
            other => other.unit(kind),
        }
    }
}

impl Over {
    /// In a word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Mean => "mean",
            Self::Greatest => "greatest",
            Self::Least => "least",
            Self::Last => "last",
        }
    }
}

impl Quantity {
    /// Of a frame.
    pub fn read(&self, frame: &Frame) -> Reading {
        match self.source {
            Source::Frame(of) => of(frame),
            Source::Metrics(_) | Source::Life(_) => self.read_metrics(&frame.metrics),
        }
    }

    /// Of the scalars alone; what only a frame has is not known.
    pub fn read_metrics(&self, metrics: &Metrics) -> Reading {
        match self.source {
            Source::Frame(_) => Reading::Unknown,
            Source::Metrics(of) => of(metrics),
            Source::Life(of) => metrics.life.as_ref().map_or(Reading::Unknown, of),
        }
    }

    /// Of a frame as a number, SI.
    pub fn number(&self, frame: &Frame) -> Option<f64> {
        self.read(frame).number()
    }

    /// A value (SI) with its unit, as texts have it.
    pub fn in_words(&self, value: f64, kind: ContactKind) -> String {
        let text = self.dimension.unit_in_words(kind).show(value, 4);
        text.trim_end().to_owned()
    }

    /// Symbol with its unit, as legends have it.
    pub fn label(&self, kind: ContactKind) -> String {
        match self.dimension.unit(kind).name {
            "" => self.symbol.to_owned(),
            unit => format!("{}, {unit}", self.symbol),
        }
    }

    pub(super) const fn new(
        [name, symbol]: [&'static str; 2],
        dimension: Dimension,
        meaning: &'static str,
        source: Source,
    ) -> Self {
        Self {
            name,
            symbol,
            dimension,
            meaning,
            over: &[],
            by_itself: false,
            source,
        }
    }

    pub(super) const fn over(self, over: &'static [(Over, &'static str)]) -> Self {
        Self { over, ..self }
    }

    /// The same, shown everywhere by its line alone.
    #[must_use]
    pub const fn by_itself(self) -> Self {
        Self {
            by_itself: true,
            ..self
        }
    }
}

impl Reading {
    /// As a number; a word is none.
    pub fn number(self) -> Option<f64> {
        match self {
            Self::Number(value) => Some(value),
            Self::Unknown | Self::Word(_) => None,
        }
    }
}

impl From<f64> for Reading {
    fn from(value: f64) -> Self {
        Self::Number(value)
    }
}

impl From<Option<f64>> for Reading {
    fn from(known: Option<f64>) -> Self {
        known.map_or(Self::Unknown, Self::Number)
    }
}

/// The quantity of that name.
///
/// # Panics
/// When there is none: where it is compiled.
pub const fn named(name: &str) -> &'static Quantity {
    let mut k = 0;
    while !is_same(CATALOGUE[k].name, name) {
        k += 1;
    }
    &CATALOGUE[k]
}

/// How many quantities are summed up over a passage.
pub(in crate::sim) const SUMMED: usize = summed_before(CATALOGUE.len());

/// Those quantities, in order.
pub(in crate::sim) fn summed() -> impl Iterator<Item = &'static Quantity> {
    let all = CATALOGUE.iter();
    all.filter(|quantity| !quantity.over.is_empty())
}

const fn summed_before(end: usize) -> usize {
    let (mut k, mut count) = (0, 0);
    while k < end {
        count += !CATALOGUE[k].over.is_empty() as usize;
        k += 1;
    }
    count
}

/// Place among [`summed`] of what gives the number of that name to a summary, and how.
///
/// # Panics
/// When nothing does: where it is compiled.
pub(in crate::sim) const fn total(key: &str) -> (usize, Over) {
    let (mut k, mut n) = (0, 0);
    while n == CATALOGUE[k].over.len() || !is_same(CATALOGUE[k].over[n].1, key) {
        (k, n) = if n < CATALOGUE[k].over.len() {
            (k, n + 1)
        } else {
            (k + 1, 0)
        };
    }
    (summed_before(k), CATALOGUE[k].over[n].0)
}

const fn is_same(one: &str, two: &str) -> bool {
    let (one, two) = (one.as_bytes(), two.as_bytes());
    if one.len() != two.len() {
        return false;
    }
    let mut k = 0;
    while k < one.len() {
        if one[k] != two[k] {
            return false;
        }
        k += 1;
    }
    true
}
