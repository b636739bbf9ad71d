//! A key of a scene: what it takes, whether it may be left out, what it means.

/// What a key takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    /// Text of at most so many characters.
    Text(usize),
    /// The same in one line, without characters that control a terminal or turn the direction of writing.
    Line(usize),
    /// A finite number between two bounds, both included.
    Number(f64, f64),
    /// A finite number of either sign whose size lies between two bounds, both included and above 0.
    EitherSign(f64, f64),
    /// A finite number between two bounds, or `inf`.
    NumberOrInf(f64, f64),
    /// A whole number between two bounds, both included.
    Integer(i64, i64),
    /// One of a few whole numbers.
    IntegerOf(&'static [i64]),
    /// One of a few words.
    Choice(&'static [&'static str]),
    /// `true` or `false`.
    Switch,
}

/// Whether a key or a table may be left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Need {
    /// It must be there.
    Required,
    /// Left out, it takes its default, which printed scenes show.
    Defaulted,
    /// Left out means something of its own; the text says what.
    Optional(&'static str),
}

/// One key.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Key {
    /// Name within its table.
    pub name: &'static str,
    /// Unit, empty for pure numbers and words.
    pub unit: &'static str,
    /// What it takes.
    pub kind: Kind,
    /// Whether it may be left out.
    pub need: Need,
    /// What it means.
    pub doc: &'static str,
}

pub(super) const fn key(
    name: &'static str,
    unit: &'static str,
    kind: Kind,
    need: Need,
    doc: &'static str,
) -> Key {
    Key {
        name,
        unit,
        kind,
        need,
        doc,
    }
}
