//! Error against run time, part by part: what a digit costs.
//!
//! Each part is measured over its nodes, time steps, tolerance, depths and truncation, one at a time, against a closed form,
//! a computed table or the finest case of its own series, on one pool of threads. The default scene is run at other meshes,
//! orders, steps, tolerances and depths, and the cheapest settings for three errors in life follow.

mod hertz;
mod passage;
mod series;
mod smooth;
mod stress;

pub use passage::{COMPARED, DEFAULT_PART, Resolution, WholeRun};
pub use series::{Against, Row, Series, Varied};

use rayon::{ThreadPool, ThreadPoolBuilder};

use super::table::{MarkdownTable, figure};
use super::{Extent, Report, StudyError, StudyProgress, refuse_nothing};
use asperity_engine::scene::Order;
use asperity_picture::chart::{Chart as _, Curve, Figure, Mark, Scale};

/// The study's result.
#[derive(Debug, Clone, PartialEq)]
pub struct Accuracy {
    /// Series by part, coarse to fine.
    pub series: Vec<Series>,
    /// The default scene, the finest last.
    pub runs: Vec<WholeRun>,
    /// Length of those runs, in lengths of 4 a.
    pub passages: f64,
}

/// Errors in life for which settings are recommended.
pub const LEVELS: [f64; 3] = [0.05, 0.01, 0.002];

/// What each part is measured over.
struct Sizes {
    hertz: &'static [f64],
    smooth: &'static [f64],
    /// Intervals of the mesh under which stress is computed.
    stress: &'static [f64],
    /// Nodes of the rough film, and where its steps and tolerance are varied.
    rough: &'static [f64],
    rough_base: Resolution,
    steps: &'static [f64],
    /// Nodes of the default scene with either order, and where the rest is varied.
    second: &'static [usize],
    high: &'static [usize],
    high_base: usize,
    passages: f64,
}

impl Sizes {
    fn of(extent: Extent) -> Self {
        let rough_base = |nodes, step| Resolution {
            nodes,
            step,
            ..Resolution::USUAL
        };
        match extent {
            Extent::Quick => Self {
                hertz: &[33.0, 65.0, 129.0, 257.0],
                smooth: &[33.0, 65.0, 129.0],
                stress: &[32.0, 64.0, 128.0],
                rough: &[33.0, 65.0, 129.0],
                rough_base: rough_base(33, 1.0),
                steps: &[2.0, 1.0, 0.5],
                second: &[65],
                high: &[65, 129],
                high_base: 65,
                passages: 0.5,
            },
            Extent::Usual => Self {
                hertz: &[33.0, 65.0, 129.0, 257.0, 513.0],
                smooth: &[33.0, 65.0, 129.0],
                stress: &[32.0, 64.0, 128.0, 256.0],
                rough: &[33.0, 65.0, 129.0],
                rough_base: rough_base(65, 0.5),
                steps: &[4.0, 2.0, 1.0, 0.5, 0.25],
                second: &[65, 129, 257],
                high: &[65, 129, 257],
                high_base: 129,
                passages: 1.0,
            },
            Extent::Full => Self {
                smooth: &[33.0, 65.0, 129.0, 257.0],
                stress: &[32.0, 64.0, 128.0, 256.0, 512.0],
                rough: &[33.0, 65.0, 129.0, 257.0],
                second: &[65, 129, 257, 513],
                high: &[65, 129, 257, 513],
                ..Self::of(Extent::Usual)
            },
        }
    }

    /// Settings of the default scene, the finest last.
    fn whole(&self) -> Vec<Resolution> {
        let at = |nodes: usize, order| Resolution {
            nodes,
            order,
            ..Resolution::USUAL
        };
        let base = at(self.high_base, Order::High);
        let second = self.second.iter().map(|&nodes| at(nodes, Order::Second));
        let mut all: Vec<Resolution> = second.collect();
        all.extend([2.0, 0.5].map(|step| Resolution { step, ..base }));
        all.extend([1e-2, 1e-4].map(|tolerance| Resolution { tolerance, ..base }));
        all.extend([16, 64].map(|depths| Resolution { depths, ..base }));
        // From the second mesh on there is one to climb from.
        all.extend(self.high.iter().skip(1).map(|&nodes| Resolution {
            climbs: true,
            ..at(nodes, Order::High)
        }));
        all.extend(self.high.iter().map(|&nodes| at(nodes, Order::High)));
        all
    }
}

/// Measures the parts, those whose name holds `only` if that is given, on `threads` threads.
///
/// # Errors
/// [`StudyError`] when a case of the study fails, or when no part has that name.
pub fn accuracy(
    extent: Extent,
    only: Option<&str>,
    threads: usize,
    progress: &mut StudyProgress,
) -> Result<Accuracy, StudyError> {
    type MeasurePart = fn(&Sizes, &ThreadPool) -> Result<Vec<Series>, StudyError>;
    let sizes = Sizes::of(extent);
    let pool = ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|error| StudyError::Scene(error.to_string()))?;
    let mut parts: Vec<(&str, MeasurePart)> = vec![
        ("dry Hertz", |sizes, pool| {
            pool.install(|| hertz::hertz(sizes.hertz))
        }),
        ("smooth film", |sizes, pool| {
            pool.install(|| smooth::smooth(sizes.smooth))
        }),
        ("stress", |sizes, pool| {
            pool.install(|| stress::stress(sizes.stress))
        }),
        ("rough film", |sizes, pool| {
            passage::rough(sizes, pool.current_num_threads())
        }),
    ];
    let is_wanted = |name: &str| only.is_none_or(|text| name.contains(text));
    parts.retain(|(name, _)| is_wanted(name));
    let runs_whole = is_wanted(DEFAULT_PART);
    refuse_nothing(only, parts.is_empty() && !runs_whole)?;
    let all = parts.len() + usize::from(runs_whole);
    let mut series = Vec::new();
    for (done, (name, measure)) in parts.iter().enumerate() {
        progress(name, done, all);
        series.extend(measure(&sizes, &pool)?);
    }
    let runs = if runs_whole {
        passage::whole_runs(&sizes, threads, |name| progress(name, all - 1, all))?
    } else {
        Vec::new()
    };
    Ok(Accuracy {
        series,
        runs,
        passages: sizes.passages,
    })
}

impl Accuracy {
    /// The cheapest run whose life is within `error` of the finest, and so is that of every finer one.
    pub fn recommended(&self, error: f64) -> Option<&WholeRun> {
        passage::cheapest(&self.runs, error)
    }

    /// Every row of every series.
    pub fn table(&self) -> MarkdownTable {
        type Column<'a> = (&'static str, fn(&(&'a Series, &'a Row)) -> String);
        let columns: [Column; 11] = [
            ("part", |(of, _)| of.part.to_owned()),
            ("error of", |(of, _)| of.quantity.to_owned()),
            ("varied", |(of, _)| of.varied.name().to_owned()),
            ("setting", |(of, row)| match of.varied {
                Varied::Tolerance | Varied::Decay => format!("{:e}", row.setting),
                Varied::Nodes | Varied::Step | Varied::Depths => row.setting.to_string(),
            }),
            ("rest", |(of, _)| of.rest.clone()),
            ("error", |(_, row)| format!("{:.1e}", row.error)),
            ("against", |(of, _)| of.against.name().to_owned()),
            ("order", |(_, row)| {
                row.order
                    .map_or(String::new(), |order| format!("{order:.2}"))
            }),
            ("ms", |(_, row)| figure(Some(1e3 * row.seconds))),
            ("work", |(_, row)| row.work.to_string()),
            ("unit", |(of, _)| of.work_unit.to_owned()),
        ];
        let mut rows = Vec::new();
        for series in &self.series {
            rows.extend(series.rows.iter().map(|row| (series, row)));
        }
        MarkdownTable::of(&rows, &columns)
    }

    /// All of it.
    ///
    /// # Errors
    /// What the drawing library says.
    pub fn report(&self) -> Result<Report, StudyError> {
        let mut text = String::new();
        let mut plots = Vec::new();
        if !self.series.is_empty() {
            text.push_str(&self.table().markdown());
            let title = "Error against time, over the nodes";
            let curves = self.series.iter().filter_map(over_nodes).collect();
            plots.push(("work_precision.svg".to_owned(), plot(title, curves, &[])?));
        }
        if !self.runs.is_empty() {
            text.push_str(&passage::whole_text(&self.runs, self.passages));
            let title = "Error in life of the default scene against time";
            let curves = passage::life_curves(&self.runs);
            plots.push(("life_error.svg".to_owned(), plot(title, curves, &LEVELS)?));
        }
        let rows = self.series.iter().flat_map(|series| &series.rows);
        Ok(Report {
            title: "Accuracy",
            text,
            table: self.table(),
            plots,
            passes: rows.map(|row| row.error).all(f64::is_finite)
                && self
                    .runs
                    .iter()
                    .flat_map(|run| run.values)
                    .all(f64::is_finite),
        })
    }
}

/// The error of a series over nodes against its time.
fn over_nodes(series: &Series) -> Option<Curve> {
    let rows = series.rows.iter().filter(|row| row.error > 0.0);
    (series.varied == Varied::Nodes).then(|| Curve {
        name: format!("{}: {}", series.part, series.quantity),
        points: rows.map(|row| (row.seconds, row.error)).collect(),
        mark: Mark::Computed,
    })
}

/// Curves on logarithmic axes, with level lines.
fn plot(title: &str, curves: Vec<Curve>, levels: &[f64]) -> Result<String, StudyError> {
    let figure = Figure {
        title: title.to_owned(),
        x: ("time, s".to_owned(), Scale::Log),
        y: ("relative error".to_owned(), Scale::Log),
        curves,
        levels: levels.to_vec(),
    };
    Ok(figure.svg().map_err(StudyError::Plot)?.unwrap_or_default())
}
