//! Scalars against time, each with its unit in the name.
//!
//! Values that are known in every step share an entity (45 bytes in place of 223); values that may
//! be unknown have their own and are left out while they are. Steps are collected and sent as columns once a
//! second: row by row they would cost more than all the pictures.

use rerun::{Color, EntityPath, SeriesLines};

use super::colour::{BLUE, GREEN, GREY, ORANGE, PURPLE, SKY, VERMILION, WHITE, YELLOW};
use super::stream::{Moment, Stream};
use crate::observe::ObserveError;
use crate::sim::{Frame, Metrics};

/// Smallest error that is drawn: errors are plotted as logarithms.
const LEAST_ERROR: f64 = 1e-16;

/// Series that share an entity: path, then name and colour of each.
struct Group {
    entity: &'static str,
    lines: &'static [(&'static str, [u8; 3])],
    values: fn(&Frame, &mut Vec<f64>),
}

/// A series of its own, present when known.
struct Single {
    entity: &'static str,
    name: &'static str,
    colour: [u8; 3],
    value: fn(&Frame) -> Option<f64>,
}

const GROUPS: [Group; 8] = [
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
            ("h_mean, µm", WHITE),
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
        lines: &[("S", YELLOW), ("S target", GREY), ("U, m/s", PURPLE)],
        values: |frame, out| {
            let m = &frame.metrics;
            out.extend([m.slide_roll, m.slide_roll_target, m.entrainment_m_s]);
        },
    },
    Group {
        entity: "series/load_N",
        lines: &[("load, N", WHITE), ("load target, N", GREY)],
        values: |frame, out| out.extend([frame.metrics.load_n, frame.metrics.load_target_n]),
    },
    Group {
        entity: "convergence/log10_errors",
        lines: &[
            ("log10 residual", WHITE),
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
];

const SINGLES: [Single; 20] = [
    single(
        "series/stress_GPa/effective_max",
        "σ_eff max, GPa",
        PURPLE,
        |f| f.metrics.sigma_eff_max_pa.map(|stress| stress * 1e-9),
    ),
    single("series/lambda_ratio", "λ ratio", SKY, |f| {
        f.metrics.lambda_ratio
    }),
    single("life/log10_relative/low", "log10 life, low", GREY, |f| {
        log_life(&f.metrics, |life| life.life_relative_low)
    }),
    single(
        "life/log10_relative/value",
        "log10 relative life",
        WHITE,
        |f| log_life(&f.metrics, |life| life.life_relative),
    ),
    single("life/log10_relative/high", "log10 life, high", GREY, |f| {
        log_life(&f.metrics, |life| life.life_relative_high)
    }),
    single(
        "life/log10_factors/cycles",
        "log10 cycle factor",
        SKY,
        |f| log_life(&f.metrics, |life| life.cycle_factor),
    ),
    single(
        "life/log10_factors/peaks",
        "log10 peak factor",
        ORANGE,
        |f| log_life(&f.metrics, |life| life.peak_factor),
    ),
    single(
        "life/log10_factors/traction",
        "log10 traction factor",
        GREEN,
        |f| log_life(&f.metrics, |life| life.traction_factor),
    ),
    single("life/relative", "relative life", WHITE, |f| {
        f.metrics.life.map(|life| life.life_relative)
    }),
    single(
        "life/contacts_per_cycle/n_1_formula",
        "n body 1, formula",
        SKY,
        |f| f.metrics.n_body_1,
    ),
    single(
        "life/contacts_per_cycle/n_1_counted",
        "n body 1, counted",
        BLUE,
        |f| f.metrics.n_counted_body_1,
    ),
    single(
        "life/contacts_per_cycle/n_2_formula",
        "n body 2, formula",
        ORANGE,
        |f| f.metrics.n_body_2,
    ),
    single(
        "life/contacts_per_cycle/n_2_counted",
        "n body 2, counted",
        VERMILION,
        |f| f.metrics.n_counted_body_2,
    ),
    single(
        "material_point/stress_GPa/pressure",
        "pressure above the point, GPa",
        ORANGE,
        |f| f.material_point.map(|point| point.pressure_pa * 1e-9),
    ),
    single(
        "material_point/stress_GPa/effective",
        "effective stress, GPa",
        PURPLE,
        |f| f.material_point.map(|point| point.effective_pa * 1e-9),
    ),
    single("material_point/stress_GPa/tau_xz", "τxz, GPa", SKY, |f| {
        f.material_point.map(|point| point.tau_xz_pa * 1e-9)
    }),
    single(
        "material_point/cycles/counted",
        "cycles counted in this crossing",
        WHITE,
        |f| f.material_point.map(|point| point.cycles_counted),
    ),
    single(
        "material_point/cycles/formula",
        "contacts by formula, n",
        GREY,
        |f| {
            let point = f.material_point?;
            if point.body == 1 {
                f.metrics.n_body_1
            } else {
                f.metrics.n_body_2
            }
        },
    ),
    single("material_point/position_mm/x", "x, mm", GREEN, |f| {
        f.material_point.map(|point| point.x_m * 1e3)
    }),
    single("material_point/position_mm/depth", "depth, mm", GREY, |f| {
        f.material_point.map(|point| point.depth_m * 1e3)
    }),
];

const fn single(
    entity: &'static str,
    name: &'static str,
    colour: [u8; 3],
    value: fn(&Frame) -> Option<f64>,
) -> Single {
    Single {
        entity,
        name,
        colour,
        value,
    }
}

fn log_life(metrics: &Metrics, part: fn(&crate::sim::LifeEstimate) -> f64) -> Option<f64> {
    let value = metrics.life.as_ref().map(part)?;
    (value > 0.0).then(|| value.log10())
}

/// Names and colours, once for the whole recording.
fn log_styles(stream: &Stream) -> Result<(), ObserveError> {
    for Group { entity, lines, .. } in &GROUPS {
        let style = SeriesLines::new()
            .with_names(lines.iter().map(|(name, _)| *name))
            .with_colors(lines.iter().map(|(_, colour)| Color::from(*colour)))
            .with_widths(lines.iter().map(|_| 1.8));
        stream.log_static(*entity, &style)?;
    }
    for Single {
        entity,
        name,
        colour,
        ..
    } in &SINGLES
    {
        let style = SeriesLines::new()
            .with_names([*name])
            .with_colors([Color::from(*colour)])
            .with_widths([1.8]);
        stream.log_static(*entity, &style)?;
    }
    Ok(())
}

/// Steps that are collected at most before they are sent: a few hundred kilobytes.
const MOST_WAITING: usize = 1024;

/// The series of a recording, with what waits to be sent.
pub(super) struct Series {
    columns: Vec<Column>,
    waiting: usize,
    scratch: Vec<f64>,
}

struct Column {
    entity: EntityPath,
    width: usize,
    moments: Vec<Moment>,
    values: Vec<f64>,
}

impl Column {
    fn new(entity: &str, width: usize) -> Self {
        Self {
            entity: EntityPath::from(entity),
            width,
            moments: Vec::new(),
            values: Vec::new(),
        }
    }
}

impl Series {
    /// Logs names and colours and collects from there on.
    pub(super) fn new(stream: &Stream) -> Result<Self, ObserveError> {
        log_styles(stream)?;
        let groups = GROUPS
            .iter()
            .map(|group| Column::new(group.entity, group.lines.len()));
        let singles = SINGLES.iter().map(|single| Column::new(single.entity, 1));
        Ok(Self {
            columns: groups.chain(singles).collect(),
            waiting: 0,
            scratch: Vec::new(),
        })
    }

    /// Takes up a step's scalars.
    pub(super) fn follow(&mut self, frame: &Frame) {
        let now = Moment::new(frame.step, frame.time_s, frame.passages);
        let (groups, singles) = self.columns.split_at_mut(GROUPS.len());
        for (group, column) in GROUPS.iter().zip(groups) {
            self.scratch.clear();
            (group.values)(frame, &mut self.scratch);
            column.moments.push(now);
            column.values.extend_from_slice(&self.scratch);
        }
        for (single, column) in SINGLES.iter().zip(singles) {
            if let Some(value) = (single.value)(frame) {
                column.moments.push(now);
                column.values.push(value);
            }
        }
        self.waiting += 1;
    }

    /// Whether so many steps wait that they should not wait for the next tick.
    pub(super) fn is_full(&self) -> bool {
        self.waiting >= MOST_WAITING
    }

    /// Sends what waits.
    pub(super) fn send(&mut self, stream: &Stream) -> Result<(), ObserveError> {
        self.waiting = 0;
        for column in &mut self.columns {
            if column.moments.is_empty() {
                continue;
            }
            let entity = column.entity.clone();
            stream.log_columns(entity, &column.moments, &column.values, column.width)?;
            column.moments.clear();
            column.values.clear();
        }
        Ok(())
    }
}
