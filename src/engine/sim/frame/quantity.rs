//! What a line of the [`CATALOGUE`] says of a quantity, and how it is looked up.
//!
//! Names are looked up where they are compiled: `const { named("p_max_pa") }` of a name that is not there is no program.

use super::{Frame, Metrics};
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
    /// K
    Temperature,
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
            Self::Temperature => ("K", 1.0),
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

    /// # Panics
    /// Of what only a frame has, of which a summary knows nothing: where it is compiled.
    pub(super) const fn over(self, over: &'static [(Over, &'static str)]) -> Self {
        assert!(!matches!(self.source, Source::Frame(_)));
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

/// Every scalar of a step, in the order of a table's columns: the one place where it gets its name and symbol, what it
/// measures, what it is in words, where it is read, and how a summary sums it up. Tables, summaries, recordings, exported
/// fields, reports and the explorer look it up here. A new one comes last and is shown `by_itself`.
#[rustfmt::skip]
pub const CATALOGUE: &[Quantity] = {
    use Dimension::{Film, Height, Length, Load, Plain, Pressure, Share, Speed, Temperature, Time, Volume};
    use Over::{Greatest, Least, Mean};
    use Source::{Frame as F, Life as L, Metrics as M};
    use Quantity as Q;
    &[
        Q::new(["step", "step"], Plain, "time step of the passage", F(|f| (f.step as f64).into())),
        Q::new(["time_s", "t"], Time, "time since the start of the passage", F(|f| f.time_s.into())),
        Q::new(["passages", "passages"], Plain, "lengths of 4 a travelled at U", F(|f| f.passages.into())),
        Q::new(["stage", "stage"], Plain, "part of the run", F(|f| Reading::Word(f.stage.name()))),
        Q::new(["a_m", "a (along x)"], Length, "Hertz half-width along x at the load of now", F(|f| f.a_m.into())),
        Q::new(["b_m", "b (across)"], Length, "Hertz half-width across", F(|f| f.b_m.into())),
        Q::new(["p_hertz_pa", "p_Hertz"], Pressure, "greatest Hertz pressure at the load of now", F(|f| f.p_hertz_pa.into())),
        Q::new(["converged", "converged (1/0)"], Plain, "whether the step converged", M(|m| f64::from(u8::from(m.converged)).into())),
        Q::new(["residual", "residual"], Plain, "relative change of pressure in the last iteration", M(|m| m.residual.into())),
        Q::new(["newton_iterations", "Newton iterations"], Plain, "Newton iterations of the step", M(|m| f64::from(m.newton_iterations).into())),
        Q::new(["linear_iterations", "linear iterations"], Plain, "Krylov iterations of the step", M(|m| f64::from(m.linear_iterations).into())),
        Q::new(["retries", "retries"], Plain, "times that the step was halved", M(|m| f64::from(m.retries).into())),
        Q::new(["slide_roll", "S"], Plain, "slide-to-roll ratio (U2 - U1)/U", M(|m| m.slide_roll.into())),
        Q::new(["slide_roll_target", "S target"], Plain, "where S is going", M(|m| m.slide_roll_target.into())),
        Q::new(["entrainment_m_s", "U"], Speed, "entrainment speed", M(|m| m.entrainment_m_s.into())),
        Q::new(["load_n", "load"], Load, "load asked for", M(|m| m.load_n.into())).over(&[(Mean, "load_n")]),
        Q::new(["load_target_n", "load target"], Load, "where the load is going", M(|m| m.load_target_n.into())),
        Q::new(["amplitude_1_m", "A1"], Height, "amplitude of body 1's roughness", M(|m| m.amplitude_1_m.into())),
        Q::new(["amplitude_2_m", "A2"], Height, "amplitude of body 2's roughness", M(|m| m.amplitude_2_m.into())),
        Q::new(["p_max_pa", "p_max"], Pressure, "greatest pressure", M(|m| m.p_max_pa.into())).over(&[(Mean, "p_max_pa"), (Greatest, "p_max_greatest_pa")]),
        Q::new(["h_central_m", "h_central"], Film, "film at the origin", M(|m| m.h_central_m.into())).over(&[(Mean, "h_central_m")]),
        Q::new(["h_min_m", "h_min"], Film, "least film under pressure", M(|m| m.h_min_m.into())).over(&[(Mean, "h_min_m"), (Least, "h_min_least_m")]),
        Q::new(["h_mean_m", "h_mean"], Film, "mean film of the central part", M(|m| m.h_mean_m.into())),
        Q::new(["lambda_ratio", "λ ratio"], Plain, "smooth central film by formula over composite roughness", M(|m| m.lambda_ratio.into())),
        Q::new(["film_to_roughness", "h_mean/Rq"], Plain, "mean film of the central part over composite roughness", M(|m| m.film_to_roughness.into())),
        Q::new(["contact_ratio", "area in contact"], Share, "part of the Hertz ellipse in contact", M(|m| m.contact_ratio.into())).over(&[(Mean, "contact_ratio")]),
        Q::new(["contact_load_ratio", "load on contacts"], Share, "part of the load that contacts carry", M(|m| m.contact_load_ratio.into())).over(&[(Mean, "contact_load_ratio")]),
        Q::new(["regime", "regime"], Plain, "lubrication regime", M(|m| Reading::Word(m.regime.name()))),
        Q::new(["load_error", "load error"], Plain, "|carried - asked|/asked", M(|m| m.load_error.into())).over(&[(Greatest, "load_error")]),
        Q::new(["film_error", "film error"], Plain, "residual of the film equation over the mass under pressure", M(|m| m.film_error.into())),
        Q::new(["mass_error", "mass error"], Plain, "the part of it that no step takes over", M(|m| m.mass_error.into())).over(&[(Greatest, "mass_error")]),
        Q::new(["overlap_m", "overlap"], Film, "deepest overlap of a step that did not converge", M(|m| m.overlap_m.into())),
        Q::new(["friction_coefficient", "friction coefficient"], Plain, "friction force over load", M(|m| m.friction_coefficient.into())).over(&[(Mean, "friction_coefficient")]),
        Q::new(["sigma_eff_max_pa", "σ_eff max"], Pressure, "greatest effective stress", M(|m| m.sigma_eff_max_pa.into())),
        Q::new(["sigma_eff_max_depth_m", "z of σ_eff max"], Length, "its depth", M(|m| m.sigma_eff_max_depth_m.into())),
        Q::new(["sigma_eff_max_x_m", "x of σ_eff max"], Length, "its place along x", M(|m| m.sigma_eff_max_x_m.into())),
        Q::new(["n_body_1", "n body 1, formula"], Plain, "contacts per loading cycle of body 1 by formula", M(|m| m.n_body_1.into())),
        Q::new(["n_body_2", "n body 2, formula"], Plain, "contacts per loading cycle of body 2 by formula", M(|m| m.n_body_2.into())),
        Q::new(["n_counted_body_1", "n body 1, counted"], Plain, "cycles of body 1 counted by rainflow", M(|m| m.n_counted_body_1.into())),
        Q::new(["n_counted_body_2", "n body 2, counted"], Plain, "cycles of body 2 counted by rainflow", M(|m| m.n_counted_body_2.into())),
        Q::new(["i_ref", "I of the reference"], Plain, "volume integral of the smooth, frictionless contact", L(|l| l.i_ref.into())),
        Q::new(["i_mean", "I"], Plain, "volume integral, mean over the phases", L(|l| l.i_mean.into())),
        Q::new(["phases", "phases"], Plain, "phases in that mean", L(|l| f64::from(l.phases).into())),
        Q::new(["cycle_factor", "cycle factor"], Plain, "n_ref/n", L(|l| l.cycle_factor.into())),
        Q::new(["stress_factor", "stress factor"], Plain, "(I_ref/I)^(1/e)", L(|l| l.stress_factor.into())),
        Q::new(["peak_factor", "peak factor"], Plain, "part of the stress factor due to pressure peaks", L(|l| l.peak_factor.into())),
        Q::new(["traction_factor", "traction factor"], Plain, "part of the stress factor due to traction", L(|l| l.traction_factor.into())),
        Q::new(["load_factor", "load factor"], Plain, "what the load and speed of now cost on the smooth contact", L(|l| l.load_factor.into())),
        Q::new(["life_relative", "relative life"], Plain, "life over that of the smooth, frictionless contact at S = 0", L(|l| l.life_relative.into())),
        Q::new(["life_relative_low", "life, low"], Plain, "lower end of its band", L(|l| l.life_relative_low.into())),
        Q::new(["life_relative_high", "life, high"], Plain, "upper end of its band", L(|l| l.life_relative_high.into())),
        Q::new(["settled", "settled (1/0)"], Plain, "whether the average has stopped moving", L(|l| f64::from(u8::from(l.settled)).into())),
        Q::new(["point_x_m", "x"], Length, "where the followed point is", F(|f| f.material_point.map(|point| point.x_m).into())),
        Q::new(["point_effective_pa", "effective stress"], Pressure, "effective stress at the followed point", F(|f| f.material_point.map(|point| point.effective_pa).into())),
        Q::new(["point_cycles_counted", "peaks so far in this crossing"], Plain, "peaks of the pressure on it in this crossing", F(|f| f.material_point.map(|point| point.cycles_counted).into())),
        Q::new(["yielded_body_1_m3", "body 1 has yielded"], Volume, "what body 1 has yielded since the roughness came up", M(|m| m.yielded_m3.map(|both| both[0]).into())),
        Q::new(["yielded_body_2_m3", "body 2 has yielded"], Volume, "what body 2 has yielded since the roughness came up", M(|m| m.yielded_m3.map(|both| both[1]).into())),
        Q::new(["traction_max_pa", "τ max"], Pressure, "greatest shear stress on the surfaces", M(|m| m.traction_max_pa.into())).over(&[(Mean, "traction_max_pa"), (Greatest, "traction_max_greatest_pa")]).by_itself(),
        Q::new(["load_centre_x_m", "x of the load"], Length, "where along x the load acts: its moment resists rolling", M(|m| m.load_centre_x_m.into())),
        Q::new(["life_common", "life at the first load"], Plain, "life over that of the smooth, frictionless contact at S = 0 at the load and speed that the scene began with", L(|l| l.life_common().into())),
        Q::new(["life_smooth", "life of the smooth contact"], Plain, "life of the smooth, frictionless contact at S = 0 at the load and speed of now, but for the constant of the model; the ratio of two is that of their lives", L(|l| l.life_smooth.into())),
        Q::new(["flash_temperature_k", "flash temperature"], Temperature, "greatest rise of a surface over the bulk's temperature", M(|m| m.flash_temperature_k.into())).by_itself(),
    ]
};

#[cfg(test)]
mod tests {
    use super::*;

    /// What is no scalar, or is told in parts.
    const OTHERS: [&str; 6] = ["asked", "yielded_m3", "life", "repeat", "errors", "detail"];

    /// What is summed of a step, in its order.
    const PLACES: [&str; 10] = [
        "load_n",
        "p_max_pa",
        "h_central_m",
        "h_min_m",
        "contact_ratio",
        "contact_load_ratio",
        "load_error",
        "mass_error",
        "friction_coefficient",
        "traction_max_pa",
    ];

    #[test]
    fn every_scalar_is_in_the_catalogue_once() {
        let metrics = serde_json::to_value(Metrics::default()).expect("plain data");
        let life = serde_json::to_value(LifeEstimate::default()).expect("plain data");
        let fields = [metrics, life];
        let fields = fields.iter().filter_map(|value| value.as_object());
        let names: Vec<&str> = CATALOGUE.iter().map(|quantity| quantity.name).collect();
        let mut found = 0;
        for field in fields.flat_map(serde_json::Map::keys) {
            let times = names.iter().filter(|name| *name == field).count();
            assert_eq!(
                times,
                usize::from(!OTHERS.contains(&field.as_str())),
                "{field}"
            );
            found += times;
        }
        assert!(found > 40, "{found}");
    }

    #[test]
    fn names_and_keys_have_one_meaning() {
        let quantities = CATALOGUE.iter();
        let mut keys: Vec<&str> = quantities
            .clone()
            .flat_map(|q| q.over)
            .map(|(_, key)| *key)
            .collect();
        let mut names: Vec<&str> = quantities.map(|quantity| quantity.name).collect();
        for list in [&mut keys, &mut names] {
            let all = list.len();
            list.sort_unstable();
            list.dedup();
            assert_eq!(list.len(), all);
        }
        assert_eq!(summed().count(), SUMMED);
    }

    /// Saved steps have no names, only this order: a line that is new goes to the end, here as in the catalogue.
    #[test]
    fn what_is_summed_keeps_its_place() {
        let names: Vec<&str> = summed().map(|quantity| quantity.name).collect();
        assert_eq!(names, PLACES);
    }

    #[test]
    fn what_is_not_known_is_no_number() {
        let mut frame = Frame::default();
        let life = const { named("life_relative") };
        assert_eq!(life.number(&frame), None);
        frame.metrics.life = Some(LifeEstimate {
            life_relative: 0.5,
            ..LifeEstimate::default()
        });
        assert_eq!(life.number(&frame), Some(0.5));
        assert_eq!(
            const { named("stage") }.read(&frame),
            Reading::Word("start_up")
        );
        let film = const { named("h_central_m") };
        assert_eq!(film.label(ContactKind::Point), "h_central, µm");
    }
}
