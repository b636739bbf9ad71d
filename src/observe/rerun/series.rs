//! Scalars against time, each with its unit in the name.
//!
//! Values that are known in the same steps share an entity (45 bytes in place of 223, and a chunk less a second); what is
//! not known yet is left out. Columns of a second are sent at once: row by row they would cost more than all pictures.

use rerun::{Color, EntityPath, SeriesLines};

use super::colour::curve::{BLUE, GREEN, GREY, OLIVE, ORANGE, PURPLE, SKY, VERMILION};
use super::moment::Moment;
use super::stream::Stream;
use crate::observe::ObserveError;
use crate::scene::ContactKind;
use crate::sim::{CautionCode, Frame, LifeEstimate, LubricationRegime};

/// Smallest error that is drawn: errors are plotted as logarithms, and what is less is as good as none.
const LEAST_ERROR: f64 = 1e-12;

/// Yielded for good.
pub(super) const YIELDED: &str = "series/yielded_um3";

/// Series that share an entity: path, then name and colour of each.
struct Group {
    entity: &'static str,
    lines: &'static [(&'static str, [u8; 3])],
    /// Adds a value for each line, or none while they are not known.
    values: fn(&Frame, &mut Vec<f64>),
}

static GROUPS: [Group; 27] = [
    Group {
        entity: "series/pressure_GPa",
        lines: &[("p_max, GPa", ORANGE), ("p_Hertz, GPa", GREY)],
        values: |frame, out| {
            out.extend([frame.metrics.p_max_pa * 1e-9, frame.p_hertz_pa * 1e-9]);
        },
    },
    Group {
        entity: "series/film_um",
        lines: &[
            ("h_central, µm", SKY),
            ("h_mean, µm", GREEN),
            ("h_min, µm", BLUE),
        ],
        values: |frame, out| {
            let m = &frame.metrics;
            out.extend([m.h_central_m, m.h_mean_m, m.h_min_m].map(|h| h * 1e6));
        },
    },
    Group {
        entity: "series/contact_percent",
        lines: &[("area in contact, %", SKY), ("load on contacts, %", ORANGE)],
        values: |frame, out| {
            let m = &frame.metrics;
            out.extend([m.contact_ratio, m.contact_load_ratio].map(|part| part * 100.0));
        },
    },
    Group {
        entity: "series/friction",
        lines: &[("friction coefficient", GREEN)],
        values: |frame, out| out.push(frame.metrics.friction_coefficient),
    },
    Group {
        entity: "series/motion",
        lines: &[("S", OLIVE), ("S target", GREY), ("U, m/s", PURPLE)],
        values: |frame, out| {
            let m = &frame.metrics;
            out.extend([m.slide_roll, m.slide_roll_target, m.entrainment_m_s]);
        },
    },
    Group {
        entity: "series/load_N",
        lines: &[("load, N", SKY), ("load target, N", GREY)],
        values: |frame, out| out.extend([frame.metrics.load_n, frame.metrics.load_target_n]),
    },
    Group {
        entity: "series/load_N_per_m",
        lines: &[("load, N/m", SKY), ("load target, N/m", GREY)],
        values: |frame, out| out.extend([frame.metrics.load_n, frame.metrics.load_target_n]),
    },
    Group {
        entity: "series/half_width_um",
        lines: &[("a (along x), µm", GREEN), ("b (across), µm", GREY)],
        values: |frame, out| out.extend([frame.a_m, frame.b_m].map(|width| width * 1e6)),
    },
    Group {
        entity: "series/regime",
        lines: &[("0 dry, 1 boundary, 2 mixed, 3 full film", SKY)],
        values: |frame, out| out.push(regime(frame.metrics.regime)),
    },
    Group {
        entity: "series/cautions",
        lines: &[
            ("not converged", VERMILION),
            ("beyond yield", ORANGE),
            ("no oil flows", GREY),
            ("film below a molecule", BLUE),
            ("mesh error of the film", GREEN),
            ("a body stands", PURPLE),
            ("models differ", OLIVE),
            ("not settled", SKY),
        ],
        values: |frame, out| {
            let from = out.len();
            out.resize(from + 8, 0.0);
            for line in frame
                .cautions()
                .iter()
                .filter_map(|caution| line(caution.code))
            {
                out[from + line] = 1.0;
            }
        },
    },
    Group {
        entity: YIELDED,
        lines: &[
            ("body 1 has yielded, µm³", SKY),
            ("body 2 has yielded, µm³", ORANGE),
        ],
        values: |frame, out| {
            // Nothing until something has flowed: most runs never do.
            let flowed = frame.metrics.yielded_m3;
            let flowed = flowed.filter(|both| both.iter().any(|&volume| volume > 0.0));
            out.extend(flowed.into_iter().flatten().map(|volume| volume * 1e18));
        },
    },
    Group {
        entity: "convergence/log10_errors",
        lines: &[
            ("log10 residual", GREEN),
            ("log10 load error", SKY),
            ("log10 film error", PURPLE),
            ("log10 mass error", ORANGE),
        ],
        values: |frame, out| {
            let m = &frame.metrics;
            let errors = [m.residual, m.load_error, m.film_error, m.mass_error];
            out.extend(errors.map(|error| error.abs().max(LEAST_ERROR).log10()));
        },
    },
    Group {
        entity: "convergence/iterations",
        lines: &[
            ("Newton iterations", SKY),
            ("linear iterations", ORANGE),
            ("retries", VERMILION),
            ("converged (1/0)", GREEN),
        ],
        values: |frame, out| {
            let m = &frame.metrics;
            out.extend([m.newton_iterations, m.linear_iterations, m.retries].map(f64::from));
            out.push(f64::from(u8::from(m.converged)));
        },
    },
    Group {
        entity: "series/stress_GPa",
        lines: &[("σ_eff max, GPa", PURPLE)],
        values: |frame, out| out.extend(frame.metrics.sigma_eff_max_pa.map(|stress| stress * 1e-9)),
    },
    Group {
        entity: "series/lambda_ratio",
        lines: &[("λ ratio", SKY)],
        values: |frame, out| out.extend(frame.metrics.lambda_ratio),
    },
    Group {
        entity: "life/log10_relative",
        lines: &[
            ("log10 life, low", GREY),
            ("log10 relative life", VERMILION),
            ("log10 life, high", GREY),
        ],
        values: |frame, out| {
            log_life(frame, out, |life| {
                [
                    life.life_relative_low,
                    life.life_relative,
                    life.life_relative_high,
                ]
            });
        },
    },
    Group {
        entity: "life/log10_factors",
        lines: &[
            ("log10 cycle factor", SKY),
            ("log10 peak factor", ORANGE),
            ("log10 traction factor", GREEN),
        ],
        values: |frame, out| {
            log_life(frame, out, |life| {
                [life.cycle_factor, life.peak_factor, life.traction_factor]
            });
        },
    },
    Group {
        entity: "life/log10_factors/load",
        lines: &[("log10 load factor", PURPLE)],
        values: |frame, out| {
            let factor = frame.metrics.life.as_ref().map(|life| life.load_factor);
            out.extend(factor.filter(|&factor| factor > 0.0).map(f64::log10));
        },
    },
    Group {
        entity: "life/relative",
        lines: &[("relative life", VERMILION)],
        values: |frame, out| out.extend(frame.metrics.life.map(|life| life.life_relative)),
    },
    Group {
        entity: "life/contacts_per_cycle/n_1_formula",
        lines: &[("n body 1, formula", SKY)],
        values: |frame, out| out.extend(frame.metrics.n_body_1),
    },
    Group {
        entity: "life/contacts_per_cycle/n_1_counted",
        lines: &[("n body 1, counted", BLUE)],
        values: |frame, out| out.extend(frame.metrics.n_counted_body_1),
    },
    Group {
        entity: "life/contacts_per_cycle/n_2_formula",
        lines: &[("n body 2, formula", ORANGE)],
        values: |frame, out| out.extend(frame.metrics.n_body_2),
    },
    Group {
        entity: "life/contacts_per_cycle/n_2_counted",
        lines: &[("n body 2, counted", VERMILION)],
        values: |frame, out| out.extend(frame.metrics.n_counted_body_2),
    },
    Group {
        entity: "material_point/stress_GPa",
        lines: &[
            ("pressure above the point, GPa", ORANGE),
            ("effective stress, GPa", PURPLE),
            ("τxz, GPa", SKY),
        ],
        values: |frame, out| {
            if let Some(point) = &frame.material_point {
                let stresses = [point.pressure_pa, point.effective_pa, point.tau_xz_pa];
                out.extend(stresses.map(|stress| stress * 1e-9));
            }
        },
    },
    Group {
        entity: "material_point/cycles/counted",
        lines: &[("peaks so far in this crossing", VERMILION)],
        values: |frame, out| out.extend(frame.material_point.map(|point| point.cycles_counted)),
    },
    Group {
        entity: "material_point/cycles/formula",
        lines: &[("expected on average, n", GREY)],
        values: |frame, out| {
            out.extend(frame.material_point.and_then(|point| match point.body {
                1 => frame.metrics.n_body_1,
                _ => frame.metrics.n_body_2,
            }));
        },
    },
    Group {
        entity: "material_point/position_mm",
        lines: &[("x, mm", GREEN), ("depth, mm", GREY)],
        values: |frame, out| {
            if let Some(point) = &frame.material_point {
                out.extend([point.x_m, point.depth_m].map(|place| place * 1e3));
            }
        },
    },
];

/// From the regime in which oil does nothing to that in which it does all.
fn regime(regime: LubricationRegime) -> f64 {
    match regime {
        LubricationRegime::Dry => 0.0,
        LubricationRegime::Boundary => 1.0,
        LubricationRegime::Mixed => 2.0,
        LubricationRegime::FullFilm => 3.0,
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
        CautionCode::ShortDomain
        | CautionCode::AboveSmooth
        | CautionCode::NoLife
        | CautionCode::StrengthUnknown
        | CautionCode::ElasticOnly => None,
    }
}

/// The groups of a contact of that kind: a load is a force or a force per length.
fn groups(kind: ContactKind) -> impl Iterator<Item = &'static Group> {
    let other = match kind {
        ContactKind::Point => "series/load_N_per_m",
        ContactKind::Line => "series/load_N",
    };
    GROUPS.iter().filter(move |group| group.entity != other)
}

/// Logarithms of parts of the life, where it has one.
fn log_life(frame: &Frame, out: &mut Vec<f64>, parts: fn(&LifeEstimate) -> [f64; 3]) {
    let parts = frame.metrics.life.as_ref().map(parts);
    if let Some(parts) = parts.filter(|parts| parts.iter().all(|&part| part > 0.0)) {
        out.extend(parts.map(f64::log10));
    }
}

/// Names and colours, once for the whole recording.
fn log_styles(stream: &Stream, kind: ContactKind) -> Result<(), ObserveError> {
    for Group { entity, lines, .. } in groups(kind) {
        let style = SeriesLines::new()
            .with_names(lines.iter().map(|(name, _)| *name))
            .with_colors(lines.iter().map(|(_, colour)| Color::from(*colour)))
            .with_widths(lines.iter().map(|_| 1.8));
        stream.log_static(*entity, &style)?;
    }
    Ok(())
}

/// A row of a group in the finished file and each of its values, bytes: times and names are compressed (19 to 25 were
/// measured, the footer included), digits are not.
const ROW: f64 = 27.0;
const VALUE: f64 = 8.0;

/// Steps that are collected at most before they are sent: a few hundred kilobytes.
const MOST_WAITING: usize = 1024;

/// The series of a recording, with what waits to be sent.
pub(super) struct Series {
    columns: Vec<(&'static Group, Column)>,
    waiting: usize,
    /// What all of them so far will take of the finished file, bytes.
    weight: f64,
}

#[derive(Default)]
struct Column {
    moments: Vec<Moment>,
    values: Vec<f64>,
}

impl Series {
    /// Logs names and colours and collects from there on.
    pub(super) fn new(stream: &Stream, kind: ContactKind) -> Result<Self, ObserveError> {
        log_styles(stream, kind)?;
        Ok(Self {
            columns: groups(kind)
                .map(|group| (group, Column::default()))
                .collect(),
            waiting: 0,
            weight: 0.0,
        })
    }

    /// Takes up a step's scalars.
    pub(super) fn follow(&mut self, frame: &Frame) {
        let now = Moment::new(frame.step, frame.time_s, frame.passages);
        for (group, column) in &mut self.columns {
            let before = column.values.len();
            (group.values)(frame, &mut column.values);
            if column.values.len() > before {
                column.moments.push(now);
                self.weight += ROW + VALUE * group.lines.len() as f64;
            }
        }
        self.waiting += 1;
    }

    /// What the scalars so far will take of the finished file, bytes.
    pub(super) fn weight(&self) -> f64 {
        self.weight
    }

    /// Whether so many steps wait that they should not wait for the next tick.
    pub(super) fn is_full(&self) -> bool {
        self.waiting >= MOST_WAITING
    }

    /// Sends what waits.
    pub(super) fn send(&mut self, stream: &Stream) -> Result<(), ObserveError> {
        self.waiting = 0;
        for (group, column) in &mut self.columns {
            if column.moments.is_empty() {
                continue;
            }
            let entity = EntityPath::from(group.entity);
            stream.log_columns(entity, &column.moments, &column.values, group.lines.len())?;
            column.moments.clear();
            column.values.clear();
        }
        Ok(())
    }
}
