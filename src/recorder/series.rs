//! Scalars against time, each with its unit in the name.
//!
//! Values that are known in the same steps share an entity (45 bytes in place of 223, and a chunk less a second); what is
//! not known yet is left out.

use rerun::components::InterpolationMode;
use rerun::{Color, SeriesLines};

use super::colour::curve::{BLUE, GREEN, GREY, OLIVE, ORANGE, PURPLE, SKY, VERMILION};
use super::entities::SCALARS;
use super::entities::series::{LIFE, POINT_CYCLES, YIELDED};
use super::moment::Moment;
use super::scalars;
use super::shown::Knobs;
use super::stream::Stream;
use asperity_engine::scene::ContactKind;
use asperity_engine::sim::{CATALOGUE, CautionCode, Frame, Quantity, named};

/// Smallest error that is drawn: errors are plotted as logarithms, and what is less is as good as none.
const LEAST_ERROR: f64 = 1e-12;

/// Lines: quantity, colour, and its name in the legend of a view whose title says the rest; empty: the quantity's own.
type Coloured = &'static [(&'static Quantity, [u8; 3], &'static str)];

/// Lines that share an entity; none of them has a value while one is not known.
#[derive(Clone, Copy)]
enum CurveGroup {
    /// Quantities in their units.
    Linear(Coloured),
    /// Logarithms of errors.
    Errors(Coloured),
    /// Logarithms of what is above 0.
    Logarithms(Coloured),
    /// One that the catalogue shows by itself.
    ByItself(&'static Quantity),
    /// Every scalar in SI, for programs.
    All,
    /// What is made for the recording: names and colours, and what adds a value for each, or none.
    Made(
        &'static [(&'static str, [u8; 3])],
        fn(&Frame, &mut Vec<f64>),
    ),
}

use CurveGroup::{Errors, Linear, Logarithms, Made};

#[rustfmt::skip]
static GROUPS: [(&str, CurveGroup); 27] = [
    ("series/pressure_GPa", Linear(&[(named("p_max_pa"), ORANGE, "maximum"), (named("p_hertz_pa"), GREY, "Hertz")])),
    ("series/film_um", Linear(&[(named("h_central_m"), SKY, "centre"), (named("h_mean_m"), GREEN, "mean"), (named("h_min_m"), BLUE, "minimum")])),
    ("series/contact_percent", Linear(&[(named("contact_ratio"), SKY, "area"), (named("contact_load_ratio"), ORANGE, "load")])),
    ("series/friction", Linear(&[(named("friction_coefficient"), GREEN, "")])),
    ("series/motion", Linear(&[(named("slide_roll"), OLIVE, "S"), (named("slide_roll_target"), GREY, "its target"), (named("entrainment_m_s"), PURPLE, "U, m/s")])),
    ("series/load_N", Linear(&[(named("load_n"), SKY, "now"), (named("load_target_n"), GREY, "target")])),
    ("series/load_N_per_m", Linear(&[(named("load_n"), SKY, "now"), (named("load_target_n"), GREY, "target")])),
    ("series/half_width_um", Linear(&[(named("a_m"), GREEN, "along x"), (named("b_m"), GREY, "across")])),
    ("series/regime", Made(&[("0 dry, 1 boundary, 2 mixed, 3 full film", SKY)], |frame, out| out.push(scalars::code(frame.metrics.regime)))),
    ("series/cautions", Made(&CAUTIONS, cautions)),
    (YIELDED, Made(&[("body 1", SKY), ("body 2", ORANGE)], yielded)),
    ("convergence/log10_errors", Errors(&[(named("residual"), GREEN, "residual"), (named("load_error"), SKY, "load"), (named("film_error"), PURPLE, "film"), (named("mass_error"), ORANGE, "mass")])),
    ("convergence/iterations", Linear(&[(named("newton_iterations"), SKY, "Newton"), (named("linear_iterations"), ORANGE, "linear"), (named("retries"), VERMILION, "retries"), (named("converged"), GREEN, "converged (1)")])),
    ("series/stress_GPa", Linear(&[(named("sigma_eff_max_pa"), PURPLE, "")])),
    ("series/lambda_ratio", Linear(&[(named("lambda_ratio"), SKY, "")])),
    (LIFE, Logarithms(&[(named("life_relative_low"), GREY, "band, low"), (named("life_relative"), VERMILION, "life"), (named("life_relative_high"), GREY, "band, high")])),
    ("life/log10_factors", Logarithms(&[(named("cycle_factor"), SKY, "cycles"), (named("peak_factor"), ORANGE, "peaks"), (named("traction_factor"), GREEN, "traction")])),
    ("life/log10_factors/load", Logarithms(&[(named("load_factor"), PURPLE, "load")])),
    ("life/relative", Linear(&[(named("life_relative"), VERMILION, "life")])),
    ("life/contacts_per_cycle/n_1_formula", Linear(&[(named("n_body_1"), SKY, "formula")])),
    ("life/contacts_per_cycle/n_1_counted", Linear(&[(named("n_counted_body_1"), BLUE, "counted")])),
    ("life/contacts_per_cycle/n_2_formula", Linear(&[(named("n_body_2"), ORANGE, "formula")])),
    ("life/contacts_per_cycle/n_2_counted", Linear(&[(named("n_counted_body_2"), VERMILION, "counted")])),
    ("material_point/stress_GPa", Made(&[("p", ORANGE), ("σ_eff", PURPLE), ("τxz", SKY)], |frame, out| {
        let point = frame.material_point.map(|point| [point.pressure_pa, point.effective_pa, point.tau_xz_pa]);
        out.extend(point.into_iter().flatten().map(|stress| stress * 1e-9));
    })),
    (POINT_CYCLES, Linear(&[(named("point_cycles_counted"), VERMILION, "so far")])),
    ("material_point/cycles/formula", Made(&[("expected", GREY)], |frame, out| {
        let n = [frame.metrics.n_body_1, frame.metrics.n_body_2];
        out.extend(frame.material_point.and_then(|point| n[usize::from(point.body != 1)]));
    })),
    ("material_point/position_mm", Made(&[("x", GREEN), ("depth", GREY)], |frame, out| {
        let point = frame.material_point.map(|point| [point.x_m, point.depth_m]);
        out.extend(point.into_iter().flatten().map(|place| place * 1e3));
    })),
];

/// Cautions that begin and end while a run goes on.
const CAUTIONS: [(&str, [u8; 3]); 8] = [
    ("not converged", VERMILION),
    ("beyond yield", ORANGE),
    ("no oil flows", GREY),
    ("film below a molecule", BLUE),
    ("mesh error of the film", GREEN),
    ("a body stands", PURPLE),
    ("models differ", OLIVE),
    ("not settled", SKY),
];

fn cautions(frame: &Frame, out: &mut Vec<f64>) {
    let mut holds = [0.0; CAUTIONS.len()];
    let cautions = frame.cautions();
    for line in cautions.iter().filter_map(|caution| line(caution.code)) {
        holds[line] = 1.0;
    }
    out.extend(holds);
}

/// Nothing until something has flowed: most runs never do.
fn yielded(frame: &Frame, out: &mut Vec<f64>) {
    let flowed = frame.metrics.yielded_m3;
    let flowed = flowed.filter(|both| both.iter().any(|&volume| volume > 0.0));
    out.extend(flowed.into_iter().flatten().map(|volume| volume * 1e18));
}

impl CurveGroup {
    /// Names and colours of the lines.
    fn lines(self, kind: ContactKind) -> Vec<(String, [u8; 3])> {
        let named = |of: Coloured, before: &str| {
            let line = |(quantity, colour, short): &(&Quantity, _, &str)| {
                let long = || format!("{before}{}", quantity.label(kind));
                let name = Some(*short).filter(|short| !short.is_empty());
                (name.map_or_else(long, str::to_owned), *colour)
            };
            of.iter().map(line).collect()
        };
        match self {
            Linear(of) => named(of, ""),
            Errors(of) | Logarithms(of) => named(of, "log10 "),
            Self::ByItself(quantity) => vec![(quantity.label(kind), SKY)],
            Self::All => scalars::names()
                .map(|name| (name.to_owned(), SKY))
                .collect(),
            Made(lines, _) => lines
                .iter()
                .map(|(name, colour)| ((*name).to_owned(), *colour))
                .collect(),
        }
    }

    /// Adds a value for each line, or none while they are not known.
    fn add(self, frame: &Frame, out: &mut Vec<f64>) {
        let shown = |quantity: &Quantity| {
            let unit = quantity.dimension.unit(frame.kind);
            quantity.number(frame).map(|value| unit.of(value))
        };
        let error = |quantity: &Quantity| {
            let error = quantity.number(frame);
            error.map(|error| error.abs().max(LEAST_ERROR).log10())
        };
        let logarithm = |quantity: &Quantity| {
            let value = quantity.number(frame).filter(|&value| value > 0.0);
            value.map(f64::log10)
        };
        match self {
            Linear(of) => add_all(of, shown, out),
            Errors(of) => add_all(of, error, out),
            Logarithms(of) => add_all(of, logarithm, out),
            Self::ByItself(quantity) => out.extend(shown(quantity)),
            Self::All => scalars::add(frame, out),
            Made(_, add) => add(frame, out),
        }
    }
}

fn add_all(of: Coloured, value: impl Fn(&Quantity) -> Option<f64>, out: &mut Vec<f64>) {
    let before = out.len();
    out.extend(of.iter().map_while(|(quantity, ..)| value(quantity)));
    if out.len() < before + of.len() {
        out.truncate(before);
    }
}

/// Line of a caution in its group; none for what holds for the whole run.
fn line(code: CautionCode) -> Option<usize> {
    match code {
        CautionCode::NotConverged => Some(0),
        CautionCode::BeyondYield | CautionCode::StillYielding => Some(1),
        CautionCode::Dry => Some(2),
        CautionCode::FilmBelowMolecule => Some(3),
        CautionCode::MeshFilm => Some(4),
        CautionCode::StandingBody => Some(5),
        CautionCode::ModelRange => Some(6),
        CautionCode::NotSettled => Some(7),
        // The list of cautions has it; the group of lines stays as viewers know it.
        CautionCode::AmplitudeDoubtful
        | CautionCode::MapDoubtful
        | CautionCode::ShortDomain
        | CautionCode::LongStep
        | CautionCode::CoarseWave
        | CautionCode::CoarseConvectedWave
        | CautionCode::CoarseCounting
        | CautionCode::CrestsAtEdge
        | CautionCode::ShallowStress
        | CautionCode::ThermalUnknown
        | CautionCode::LateEvent
        | CautionCode::MapNotSeen
        | CautionCode::OneSample
        | CautionCode::CrestsNotFelt
        | CautionCode::OilLaw
        | CautionCode::NoReference
        | CautionCode::PhaseLocked
        | CautionCode::AboveSmooth
        | CautionCode::NoLife
        | CautionCode::StrengthUnknown
        | CautionCode::ElasticOnly => None,
    }
}

/// What rests where no knob is turned.
const OF_KNOBS: [&str; 5] = [
    "series/motion",
    "series/load_N",
    "series/load_N_per_m",
    "series/half_width_um",
    "series/lambda_ratio",
];

/// What is the same until it is another: a knob that a script or a hand turns, a count, a state.
fn goes_in_steps(entity: &str) -> bool {
    const KINDS: [&str; 6] = [
        "series/motion",
        "series/load_N",
        "series/load_N_per_m",
        "series/regime",
        "series/cautions",
        "convergence/iterations",
    ];
    KINDS.contains(&entity) || entity.starts_with("material_point/cycles/")
}

/// The lines of a contact of that kind by their entities: a load is a force or a force per length.
fn groups(kind: ContactKind) -> impl Iterator<Item = (String, CurveGroup)> {
    let other = match kind {
        ContactKind::Point => "series/load_N_per_m",
        ContactKind::Line => "series/load_N",
    };
    let groups = GROUPS.iter().filter(move |(entity, _)| *entity != other);
    let groups = groups.map(|(entity, curves)| ((*entity).to_owned(), *curves));
    let all = (SCALARS.to_owned(), CurveGroup::All);
    groups
        .chain(
            by_itself()
                .map(move |quantity| (entity(quantity, kind), CurveGroup::ByItself(quantity))),
        )
        .chain(std::iter::once(all))
}

/// What has a view of its own.
pub(crate) fn by_itself() -> impl Iterator<Item = &'static Quantity> {
    CATALOGUE.iter().filter(|quantity| quantity.by_itself)
}

/// `series/traction_max_GPa` of `traction_max_pa`.
pub(crate) fn entity(quantity: &Quantity, kind: ContactKind) -> String {
    let unit = match quantity.dimension.unit(kind).name {
        "" => return format!("series/{}", quantity.name),
        "%" => "percent".to_owned(),
        "N/m" => "N_per_m".to_owned(),
        unit => unit.replace('µ', "u").replace('³', "3").replace('/', "_"),
    };
    let si = ["_m_s", "_pa", "_m3", "_m", "_n", "_s"];
    let stem = si
        .iter()
        .find_map(|suffix| quantity.name.strip_suffix(suffix));
    format!("series/{}_{unit}", stem.unwrap_or(quantity.name))
}

/// The series of a recording, with what waits to be sent: row by row it would cost more than all pictures.
pub(crate) struct Series(Vec<SeriesColumn>);

struct SeriesColumn {
    entity: String,
    curves: CurveGroup,
    lines: usize,
    moments: Vec<Moment>,
    values: Vec<f64>,
}

impl Series {
    /// Logs names and colours, once for the whole recording, and collects from there on: not what rests with its knobs, which
    /// no view shows and [`SCALARS`] has.
    pub(crate) fn new(stream: &Stream, kind: ContactKind, knobs: Knobs) -> Self {
        Self::chosen(stream, kind, |entity| match knobs {
            Knobs::Turn => true,
            Knobs::Rest => !OF_KNOBS.contains(&entity),
        })
    }

    /// Same for the entities that `keep` says.
    pub(crate) fn chosen(stream: &Stream, kind: ContactKind, keep: impl Fn(&str) -> bool) -> Self {
        let kept = groups(kind).filter(|(entity, _)| keep(entity));
        let columns = kept.map(|(entity, curves)| {
            let lines = curves.lines(kind);
            let column = SeriesColumn {
                entity,
                curves,
                lines: lines.len(),
                moments: Vec::new(),
                values: Vec::new(),
            };
            let colours = lines.iter().map(|(_, colour)| Color::from(*colour));
            let style = SeriesLines::new()
                .with_colors(colours)
                .with_widths(lines.iter().map(|_| 1.8));
            let mut style = style.with_names(lines.into_iter().map(|(name, _)| name));
            if goes_in_steps(&column.entity) {
                style = style.with_interpolation_mode(InterpolationMode::StepAfter);
            }
            stream.log_static(column.entity.as_str(), &style);
            column
        });
        Self(columns.collect())
    }

    /// Takes up a step's scalars, at the time that was set last.
    pub(crate) fn follow(&mut self, stream: &Stream, frame: &Frame) {
        for column in &mut self.0 {
            let before = column.values.len();
            column.curves.add(frame, &mut column.values);
            if column.values.len() > before {
                column.moments.push(stream.now());
                stream.count_scalars(column.lines);
            }
        }
    }

    /// Sends what waits.
    pub(crate) fn send(&mut self, stream: &Stream) {
        for column in &mut self.0 {
            if !column.moments.is_empty() {
                let (moments, values) = (&column.moments, &column.values);
                stream.log_columns(&column.entity, moments, values, column.lines);
                column.moments.clear();
                column.values.clear();
            }
        }
    }
}
