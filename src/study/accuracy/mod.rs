//! Error against run time, part by part: what a digit costs.
//!
//! Each part is measured over its nodes, time steps, tolerance, depths, truncation and precision, one at a time,
//! against a closed form, a computed table or the finest case of its own series, on one pool of threads. Whole
//! runs are measured against the finest run of all, and the cheapest settings for three errors in life follow.

mod counted;
mod default_scene;
mod hertz;
mod passage;
mod plot;
mod report;
mod row;
mod smooth;
mod stress;

pub use default_scene::{COMPARED, DefaultRun, DefaultSetting};
pub use passage::{LifeLimit, LifeRun, LifeValue, Resolution};
pub use plot::{life_plot, work_precision_plot};
pub use report::{accuracy_table, accuracy_text};
pub use row::{AccuracyRow, Against, StudiedPart, Varied};

use super::{Extent, StudyError, StudyProgress};
use passage::StudySeries;

/// The study's result.
#[derive(Debug, Clone, PartialEq)]
pub struct Accuracy {
    /// Rows by part and series, coarse to fine.
    pub rows: Vec<AccuracyRow>,
    /// Whole runs against what they tend to.
    pub lives: Vec<LifeRun>,
    /// What they tend to.
    pub limit: LifeLimit,
    /// Length of those runs, in lengths of 4 a.
    pub passages: f64,
    /// The default scene as it comes and otherwise, the finest last.
    pub default_scene: Vec<DefaultRun>,
}

/// Errors in life for which settings are recommended.
pub const LEVELS: [f64; 3] = [0.05, 0.01, 0.002];

impl Accuracy {
    /// The cheapest run whose life is within `error` of the limit, and so is that of every finer one.
    pub fn recommended(&self, error: f64) -> Option<&LifeRun> {
        passage::cheapest(&self.lives, error)
    }

    /// Whether every error is a number.
    pub fn passes(&self) -> bool {
        self.rows.iter().all(|row| row.error.is_finite())
            && self.lives.iter().all(|run| run.error.is_finite())
            && self
                .default_scene
                .iter()
                .flat_map(|run| run.values)
                .all(f64::is_finite)
    }
}

/// What each part is measured over.
struct Sizes {
    hertz: &'static [usize],
    smooth: &'static [usize],
    stress: &'static [usize],
    samples: &'static [usize],
    /// Nodes of whole runs, the finest last; nodes and step at which the rest is varied; steps.
    whole: &'static [usize],
    whole_base: (usize, f64),
    steps: &'static [f64],
    /// Same of the rough film.
    rough: &'static [usize],
    rough_base: (usize, f64),
    passages: f64,
}

impl Sizes {
    fn of(extent: Extent) -> Self {
        match extent {
            Extent::Quick => Self {
                hertz: &[33, 65, 129, 257],
                smooth: &[33, 65, 129],
                stress: &[32, 64, 128],
                samples: &[4, 8, 16, 32],
                whole: &[65, 129],
                whole_base: (65, 1.0),
                steps: &[2.0, 1.0, 0.5],
                rough: &[33, 65, 129],
                rough_base: (33, 1.0),
                passages: 0.5,
            },
            Extent::Usual => Self {
                hertz: &[33, 65, 129, 257, 513],
                smooth: &[33, 65, 129],
                stress: &[32, 64, 128, 256],
                samples: &[2, 4, 8, 16, 32, 64],
                whole: &[65, 129, 257],
                whole_base: (129, 1.0),
                steps: &[4.0, 2.0, 1.0, 0.5, 0.25],
                rough: &[33, 65, 129],
                rough_base: (65, 0.5),
                passages: 1.0,
            },
            Extent::Full => Self {
                hertz: &[33, 65, 129, 257, 513],
                smooth: &[33, 65, 129, 257],
                stress: &[32, 64, 128, 256, 512],
                samples: &[2, 4, 8, 16, 32, 64, 128],
                whole: &[65, 129, 257, 513],
                whole_base: (129, 1.0),
                steps: &[4.0, 2.0, 1.0, 0.5, 0.25],
                rough: &[33, 65, 129, 257],
                rough_base: (65, 0.5),
                passages: 1.0,
            },
        }
    }
}

/// Series of whole runs: over nodes at step `fine`, then over the rest at `base` nodes, coarse to fine.
fn series(
    sizes: &[usize],
    (base, step): (usize, f64),
    steps: &[f64],
    depths: &[usize],
) -> Vec<StudySeries> {
    let at = Resolution {
        nodes: base,
        step,
        ..Resolution::USUAL
    };
    let over = |varied, settings: Vec<Resolution>| (varied, settings);
    let mut all = vec![
        over(
            Varied::Nodes,
            sizes
                .iter()
                .map(|&nodes| Resolution { nodes, ..at })
                .collect(),
        ),
        over(
            Varied::Step,
            steps
                .iter()
                .map(|&step| Resolution { step, ..at })
                .collect(),
        ),
        over(
            Varied::Tolerance,
            [1e-2, 1e-3, 1e-4]
                .iter()
                .map(|&tolerance| Resolution { tolerance, ..at })
                .collect(),
        ),
    ];
    if !depths.is_empty() {
        let settings = depths.iter().map(|&depths| Resolution { depths, ..at });
        all.push(over(Varied::Depths, settings.collect()));
    }
    all
}

/// Measures; everything but counted cycles works on `threads` threads.
///
/// # Errors
/// [`StudyError`] when a case of the study fails.
pub fn accuracy(
    extent: Extent,
    threads: usize,
    progress: &mut StudyProgress,
) -> Result<Accuracy, StudyError> {
    let sizes = Sizes::of(extent);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|error| StudyError::Scene(error.to_string()))?;
    let failed = |part: StudiedPart| {
        move |reason: String| StudyError::Run {
            case: part.name().to_owned(),
            reason,
        }
    };
    let mut done = 0;
    let all = StudiedPart::ALL.len();
    let mut tell = |part: StudiedPart| {
        progress(part.name(), done, all);
        done += 1;
    };
    let mut rows = Vec::new();
    tell(StudiedPart::DryHertz);
    let tolerances = [1e-2, 1e-3, 1e-4, 1e-6, 1e-8];
    rows.extend(
        pool.install(|| hertz::hertz(sizes.hertz, &tolerances))
            .map_err(failed(StudiedPart::DryHertz))?,
    );
    tell(StudiedPart::Deflection);
    rows.extend(pool.install(|| hertz::deflection(sizes.hertz)));
    tell(StudiedPart::SmoothFilm);
    let tolerances = [1e-1, 1e-2, 1e-3, 1e-4, 1e-6];
    rows.extend(
        pool.install(|| smooth::smooth(sizes.smooth, &tolerances))
            .map_err(failed(StudiedPart::SmoothFilm))?,
    );
    tell(StudiedPart::Slice);
    let decays = [1e-2, 1e-3, 1e-4, 1e-6, 1e-8];
    rows.extend(
        pool.install(|| stress::stress(sizes.stress, &[8, 12, 16, 24, 32, 48], &decays))
            .map_err(failed(StudiedPart::Volume))?,
    );
    tell(StudiedPart::CountedCycles);
    rows.extend(counted::counted(sizes.samples));
    tell(StudiedPart::RoughFilm);
    let of_film = series(sizes.rough, sizes.rough_base, sizes.steps, &[]);
    rows.extend(passage::rough(&of_film, threads).map_err(failed(StudiedPart::RoughFilm))?);
    let of_life = series(sizes.whole, sizes.whole_base, sizes.steps, &[8, 16, 32, 64]);
    let (more, lives, limit) = passage::life(&of_life, sizes.passages, threads, |name| {
        progress(name, all - 1, all);
    })
    .map_err(failed(StudiedPart::Life))?;
    rows.extend(more);
    let default_scene = default_scene::default_scene(extent, threads, |name| {
        progress(name, all - 1, all);
    })
    .map_err(failed(StudiedPart::Life))?;
    row::observe_orders(&mut rows);
    row::mark_front(&mut rows);
    Ok(Accuracy {
        rows,
        lives,
        limit,
        passages: sizes.passages,
        default_scene,
    })
}
