//! One picture floor: what a picture of a frame shows and in which colours, decided once and in SI. Those who paint it
//! know no physics.
//!
//! ```text
//! scene, first frame ──> Scope: ranges ──┐
//! frame, subject ────────────────────────┴──> Picture { look, values, x, y, contact }
//!                                                ├──> recorder         entities in mm
//!                                                ├──> export            PNG
//!                                                └──> tui               half blocks, pixels
//! ```
//! A [`Look`] says what a value's colour is: the map and its range ([`Ranges`]: what can come, not what came), what stands
//! for values above it, what marks contact, and how the legend is written; also of a picture over time.

#[cfg(not(target_arch = "wasm32"))]
pub mod chart;
#[cfg(not(target_arch = "wasm32"))]
mod draw;
#[cfg(not(target_arch = "wasm32"))]
pub mod export;
pub mod interferogram;
#[cfg(not(target_arch = "wasm32"))]
pub mod plot;
pub mod profile;
pub mod ramp;
#[cfg(not(target_arch = "wasm32"))]
mod research;
mod scope;
#[cfg(not(target_arch = "wasm32"))]
mod spectra;
#[cfg(not(target_arch = "wasm32"))]
pub mod tooth;
#[cfg(not(target_arch = "wasm32"))]
mod trace;
#[cfg(not(target_arch = "wasm32"))]
mod window;

use std::borrow::Cow;

pub use ramp::Ramp;
#[cfg(not(target_arch = "wasm32"))]
pub use research::{ResearchData, ResearchPlot};
pub use scope::{Ranges, Scope, ToCome};
#[cfg(not(target_arch = "wasm32"))]
pub use spectra::Spectra;
#[cfg(not(target_arch = "wasm32"))]
pub use trace::{PointTrace, TracePoint};
#[cfg(not(target_arch = "wasm32"))]
pub use window::Window;

use asperity_engine::math::number::{GPA, KELVIN, MPA, UM, Unit, divisions, tick};
use asperity_engine::scene::ContactKind;
use asperity_engine::sim::Frame;

/// Asperity contact, in every picture that marks it.
pub const CONTACT: [u8; 3] = [90, 255, 250];
/// Film above the range, in maps and over time: the bath around the contact is ten to a hundred times thicker, and would
/// drown the film within in the top colour.
pub const ABOVE: [u8; 3] = [30, 33, 40];

/// What a picture shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Subject {
    /// Pressure.
    Pressure,
    /// Film, with contact marked.
    Film,
    /// Film as an optical rig shows it.
    Interferogram,
    /// Contact over the pressure, which is dimmed.
    Contact,
    /// Shear traction on body 1.
    Traction,
    /// Rise of body 1's surface over the bulk's temperature.
    Surface1,
    /// Of body 2's.
    Surface2,
    /// Of the oil in the middle of the film.
    OilRise,
    /// Roughness of body 1.
    Roughness1,
    /// Roughness of body 2.
    Roughness2,
    /// Roughness of both bodies together.
    RoughnessOfBoth,
    /// Effective stress of body 1 at y = 0.
    EffectiveStress,
    /// Orthogonal shear of body 1 at y = 0.
    ShearStress,
}

impl Subject {
    /// What stands above a picture of it.
    pub fn title(self) -> &'static str {
        match self {
            Self::Pressure => "Pressure",
            Self::Film => "Film (cyan: contact, dark: above the range)",
            Self::Interferogram => "Film as an interferogram",
            Self::Contact => "Contact",
            Self::Traction => "Shear traction on body 1",
            Self::Surface1 => "Surface of body 1 over the bulk",
            Self::Surface2 => "Surface of body 2 over the bulk",
            Self::OilRise => "Middle of the film over the bulk",
            Self::Roughness1 => "Roughness of body 1",
            Self::Roughness2 => "Roughness of body 2",
            Self::RoughnessOfBoth => "Roughness of both bodies",
            Self::EffectiveStress => "Effective stress of body 1 at y = 0",
            Self::ShearStress => "Orthogonal shear of body 1 at y = 0",
        }
    }

    /// Whether it lies in the plane y = 0, depth downwards.
    pub fn is_below(self) -> bool {
        matches!(self, Self::EffectiveStress | Self::ShearStress)
    }

    /// Its field in a frame; `None` where the scene computes none.
    pub fn field(self, frame: &Frame) -> Option<Cow<'_, [f32]>> {
        let known = |field| Some(field).filter(|field: &&Vec<f32>| !field.is_empty());
        let field = match self {
            Self::Pressure | Self::Contact => &frame.pressure_pa,
            Self::Film | Self::Interferogram => &frame.film_m,
            Self::Traction => &frame.traction_pa,
            Self::Surface1 => known(&frame.surface_rise_k[0])?,
            Self::Surface2 => known(&frame.surface_rise_k[1])?,
            Self::OilRise => known(&frame.film_rise_k)?,
            Self::Roughness1 => &frame.roughness_1_m,
            Self::Roughness2 => &frame.roughness_2_m,
            Self::EffectiveStress => &frame.slice.as_ref()?.effective_pa,
            Self::ShearStress => &frame.slice.as_ref()?.tau_xz_pa,
            Self::RoughnessOfBoth => {
                let both = frame.roughness_1_m.iter().zip(&frame.roughness_2_m);
                return Some(both.map(|(one, two)| one + two).collect());
            }
        };
        Some(Cow::Borrowed(field))
    }
}

/// What values are coloured by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Palette {
    /// A colour map over the range.
    Ramp(Ramp),
    /// Interference: the range is the legend's only.
    Fringes,
}

/// What stands for values above the range.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AboveRange {
    /// The top colour; the legend's last number says "≥".
    Top,
    /// [`ABOVE`]; the legend says so.
    Dark,
}

/// What a pixel is made of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tint {
    /// Nothing: there is no value.
    Blank,
    /// A colour of its own.
    Plain([u8; 3]),
    /// A share of the ramp.
    Share(f32),
}

/// How a field looks: its colours, its range, its legend.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look {
    /// What the legend calls it.
    pub symbol: &'static str,
    /// Unit of the legend's numbers.
    pub unit: Unit,
    /// Lower and upper end of the colour range, SI.
    pub range: [f64; 2],
    /// The colours.
    pub palette: Palette,
    /// What stands for values above.
    pub above: AboveRange,
    /// Whether contact is marked in [`CONTACT`].
    pub marks_contact: bool,
    /// Part of the ramp that the range takes: less than 1 for what lies behind something.
    pub strength: f32,
}

impl Look {
    /// A look from zero, or for what has either sign from its negative, to `top` (SI).
    pub fn up_to(symbol: &'static str, unit: Unit, top: f64, ramp: Ramp) -> Self {
        let low = if ramp == Ramp::Diverging { -top } else { 0.0 };
        Self {
            symbol,
            unit,
            range: [low, top],
            palette: Palette::Ramp(ramp),
            above: AboveRange::Top,
            marks_contact: false,
            strength: 1.0,
        }
    }

    /// The look of a subject in a run with those ranges.
    pub fn of(subject: Subject, ranges: &Ranges) -> Self {
        let pressure = Self::up_to("p", GPA, ranges.pressure_pa, Ramp::Inferno);
        let film = Self::up_to("h", UM, ranges.film_m, Ramp::Viridis);
        match subject {
            Subject::Pressure => pressure,
            Subject::Contact => Self {
                marks_contact: true,
                strength: 0.45,
                ..pressure
            },
            Subject::Film => Self {
                above: AboveRange::Dark,
                marks_contact: true,
                ..film
            },
            Subject::Interferogram => Self {
                range: [0.0, f64::from(interferogram::TOP_M)],
                palette: Palette::Fringes,
                ..film
            },
            Subject::Traction => Self::up_to("shear", MPA, ranges.traction_pa, Ramp::Diverging),
            Subject::Surface1 | Subject::Surface2 => {
                Self::up_to("rise", KELVIN, ranges.surface_rise_k, Ramp::Inferno)
            }
            Subject::OilRise => Self::up_to("rise", KELVIN, ranges.film_rise_k, Ramp::Inferno),
            Subject::Roughness1 | Subject::Roughness2 => {
                Self::up_to("height", UM, ranges.roughness_m, Ramp::Diverging)
            }
            Subject::RoughnessOfBoth => {
                Self::up_to("height", UM, ranges.roughness_of_both_m, Ramp::Diverging)
            }
            Subject::EffectiveStress => Self::up_to("σ_eff", GPA, ranges.effective_pa, Ramp::Magma),
            Subject::ShearStress => Self::up_to("τxz", GPA, ranges.shear_pa, Ramp::Diverging),
        }
    }

    /// Same in another unit.
    #[must_use]
    pub fn in_unit(self, unit: Unit) -> Self {
        Self { unit, ..self }
    }

    /// Share of a value (SI) of the range, not cut off.
    pub fn share(&self, value: f64) -> f32 {
        let [low, high] = self.range;
        ((value - low) / (high - low).max(f64::MIN_POSITIVE)) as f32
    }

    /// What a pixel of that value (SI) is made of.
    pub fn tint(&self, value: f64, touches: bool) -> Tint {
        if value.is_nan() {
            return Tint::Blank;
        }
        if touches && self.marks_contact {
            return Tint::Plain(CONTACT);
        }
        if self.palette == Palette::Fringes {
            return Tint::Plain(interferogram::colour(value as f32, 0.0));
        }
        if self.above == AboveRange::Dark && value > self.range[1] {
            return Tint::Plain(ABOVE);
        }
        Tint::Share(self.strength * self.share(value).clamp(0.0, 1.0))
    }

    /// The map of its colours; fringes have none of their own.
    pub fn ramp(&self) -> Ramp {
        match self.palette {
            Palette::Ramp(ramp) => ramp,
            Palette::Fringes => Ramp::Viridis,
        }
    }

    /// A tint's colour; `None` where there is no value.
    pub fn paint(&self, tint: Tint) -> Option<[u8; 3]> {
        match tint {
            Tint::Blank => None,
            Tint::Plain(colour) => Some(colour),
            Tint::Share(share) => Some(self.ramp().colour(share, 1.0)),
        }
    }

    /// What the legend is called: symbol and unit.
    pub fn title(&self) -> String {
        format!("{}, {}", self.symbol, self.unit.name)
    }

    /// Values of the legend's numbers, SI.
    pub fn divisions(&self) -> Vec<f64> {
        let [low, high] = self.range;
        if low < 0.0 {
            return [-1.0, -0.5, 0.0, 0.5, 1.0].map(|t| t * high).to_vec();
        }
        let parts = divisions(self.unit.of(high)).into_iter();
        parts.map(|value| value / self.unit.per_si).collect()
    }

    /// A number of the legend: it says at an end of the range that its colour holds beyond, too. Fringes go on.
    pub fn number(&self, value: f64) -> String {
        let [low, high] = self.range;
        let holds = self.palette != Palette::Fringes;
        let is_at = |end: f64| holds && (value - end).abs() < 1e-9 * (high - low);
        let sign = match self.above {
            AboveRange::Top if is_at(high) => "≥",
            AboveRange::Top if is_at(low) && low < 0.0 => "≤",
            AboveRange::Top | AboveRange::Dark => "",
        };
        format!("{sign}{}", tick(self.unit.of(value)))
    }

    /// What the legend says of values above the range, where they have a colour of their own.
    pub fn note(&self) -> Option<String> {
        (self.above == AboveRange::Dark)
            .then(|| format!("dark: >{}", tick(self.unit.of(self.range[1]))))
    }
}

/// Where nodes lie along an axis, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NodeAxis<'a> {
    /// Evenly.
    Even {
        /// The first, m.
        first_m: f64,
        /// From one to the next, m.
        step_m: f64,
        /// How many.
        nodes: usize,
    },
    /// At these places, rising.
    Uneven(&'a [f64]),
}

impl NodeAxis<'_> {
    /// How many nodes.
    pub fn nodes(self) -> usize {
        match self {
            Self::Even { nodes, .. } => nodes,
            Self::Uneven(places) => places.len(),
        }
    }

    /// First and last, m.
    pub fn ends(self) -> [f64; 2] {
        match self {
            Self::Even {
                first_m,
                step_m,
                nodes,
            } => [first_m, first_m + step_m * nodes.saturating_sub(1) as f64],
            Self::Uneven(places) => {
                let first = places.first().copied().unwrap_or(0.0);
                [first, places.last().copied().unwrap_or(first)]
            }
        }
    }

    /// Place of a coordinate among the nodes, counted from the first and cut off at both ends.
    pub fn place(self, at_m: f64) -> f64 {
        let last = self.nodes().saturating_sub(1) as f64;
        match self {
            Self::Even {
                first_m, step_m, ..
            } => ((at_m - first_m) / step_m).clamp(0.0, last),
            Self::Uneven(places) => {
                let above = places.partition_point(|place| *place <= at_m);
                match (above.checked_sub(1), places.get(above)) {
                    (Some(k), Some(next)) => k as f64 + (at_m - places[k]) / (next - places[k]),
                    (None, _) => 0.0,
                    (Some(_), None) => last,
                }
            }
        }
    }
}

/// A picture of a frame.
#[derive(Debug, Clone)]
pub struct Picture<'a> {
    /// Its colours and legend.
    pub look: Look,
    /// Values row by row, SI: x along a row, rows by y or by depth.
    pub values: Cow<'a, [f32]>,
    /// Nodes along a row.
    pub x: NodeAxis<'a>,
    /// Rows: y upwards, or depth downwards.
    pub y: NodeAxis<'a>,
    /// Whether rows are depths.
    pub is_below: bool,
    /// 1 in asperity contact, node by node; empty: below the surface.
    pub contact: &'a [u8],
    /// Kind and half-widths (m) of Hertz's contact.
    pub hertz: (ContactKind, [f64; 2]),
}

impl<'a> Picture<'a> {
    /// A frame's picture; `None` where the frame does not hold it.
    pub fn of(frame: &'a Frame, subject: Subject, ranges: &Ranges) -> Option<Self> {
        let even = |first_m, step_m, nodes| NodeAxis::Even {
            first_m,
            step_m,
            nodes,
        };
        let (y, contact) = if subject.is_below() {
            let depths = &frame.slice.as_ref()?.depths_m;
            (NodeAxis::Uneven(depths), &[][..])
        } else {
            let y = even(frame.y_min_m, frame.dy_m, frame.ny);
            (y, frame.contact.as_slice())
        };
        let values = subject.field(frame)?;
        let is_whole = frame.nx > 0 && y.nodes() > 0 && values.len() == frame.nx * y.nodes();
        is_whole.then(|| Self {
            look: Look::of(subject, ranges),
            values,
            x: even(frame.x_min_m, frame.dx_m, frame.nx),
            y,
            is_below: subject.is_below(),
            contact,
            hertz: (frame.kind, [frame.a_m, frame.b_m]),
        })
    }

    /// Value of a node, SI.
    pub fn at(&self, i: usize, j: usize) -> f32 {
        self.values[j * self.x.nodes() + i]
    }

    /// Whether a node is in asperity contact.
    pub fn touches(&self, i: usize, j: usize) -> bool {
        self.contact.get(j * self.x.nodes() + i) == Some(&1)
    }

    /// The film for an interferogram's cells; `None` of another subject.
    pub fn film(&self) -> Option<interferogram::Film<'_>> {
        (self.look.palette == Palette::Fringes)
            .then(|| interferogram::Film::new(&self.values, self.x.nodes(), self.y.nodes()))
            .flatten()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ranges() -> Ranges {
        Ranges {
            pressure_pa: 2e9,
            film_m: 1e-6,
            ..Ranges::default()
        }
    }

    #[test]
    fn what_is_above_the_range_is_told_by_the_legend() {
        let pressure = Look::of(Subject::Pressure, &ranges());
        assert_eq!(pressure.tint(9e9, false), Tint::Share(1.0));
        assert_eq!(
            (pressure.number(2e9).as_str(), pressure.note()),
            ("≥2", None)
        );
        let film = Look::of(Subject::Film, &ranges());
        assert_eq!(film.tint(1.1e-6, false), Tint::Plain(ABOVE));
        assert_eq!(film.number(1e-6), "1");
        assert_eq!(film.note().as_deref(), Some("dark: >1"));
        assert_eq!(film.tint(1.1e-6, true), Tint::Plain(CONTACT));
        assert_eq!(film.tint(f64::NAN, false), Tint::Blank);
        assert_eq!(
            Look::of(Subject::Interferogram, &ranges()).number(1e-6),
            "1"
        );
    }

    #[test]
    fn places_lie_between_the_nodes() {
        let depths = [0.0, 0.1, 0.4, 1.0];
        let uneven = NodeAxis::Uneven(&depths);
        assert_eq!(uneven.place(0.0), 0.0);
        assert!((uneven.place(0.25) - 1.5).abs() < 1e-12);
        assert_eq!(uneven.place(5.0), 3.0);
        assert_eq!(NodeAxis::Uneven(&[]).place(1.0), 0.0);
        let even = NodeAxis::Even {
            first_m: -1.0,
            step_m: 0.5,
            nodes: 5,
        };
        assert_eq!([-2.0, 0.25, 7.0].map(|x| even.place(x)), [0.0, 2.5, 4.0]);
    }
}
