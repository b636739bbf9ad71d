//! Whole runs: the film of moving waves, and the life that a passage gives.
//!
//! *Rough film*: the demonstration at 5 m/s with transverse waves of 0.35 mm (0.74 a) on the faster body, S = 1. Each
//! series is measured against its own finest case. *Life*: the default scene; besides the series, every run is
//! measured against what all of them tend to, which is what the recommendation goes by.

use super::row::{AccuracyRow, Against, StudiedPart, Varied, against_finest, timed};
use asperity_engine::plan::Plan;
use asperity_engine::scene::{Override, Scene};
use asperity_engine::sim::{Simulation, Summary};

/// Settings of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resolution {
    /// Nodes per side.
    pub nodes: usize,
    /// Time step, nodes.
    pub step: f64,
    /// Tolerance of a step.
    pub tolerance: f64,
    /// Depths.
    pub depths: usize,
}

impl Resolution {
    /// What the presets use, but for the default scene, which is finer.
    pub const USUAL: Self = Self {
        nodes: 129,
        step: 1.0,
        tolerance: 1e-3,
        depths: 32,
    };

    fn sets(self) -> Vec<String> {
        vec![
            format!("grid.nodes={}", self.nodes),
            format!("time.step_nodes={}", self.step),
            format!("numerics.tolerance={:e}", self.tolerance),
            "numerics.order=second".to_owned(),
            "numerics.error_estimate=none".to_owned(),
            "record=none".to_owned(),
        ]
    }

    fn value(self, varied: Varied) -> f64 {
        match varied {
            Varied::Nodes => self.nodes as f64,
            Varied::Step => self.step,
            Varied::Tolerance => self.tolerance,
            Varied::Depths | Varied::Decay | Varied::Samples | Varied::Precision => {
                self.depths as f64
            }
        }
    }

    /// In words, without what is varied.
    fn fixed(self, varied: Varied) -> String {
        let mut words = Vec::new();
        if varied != Varied::Nodes {
            words.push(format!("N {}", self.nodes));
        }
        if varied != Varied::Step {
            words.push(format!("step {}", self.step));
        }
        if varied != Varied::Tolerance {
            words.push(format!("tolerance {:e}", self.tolerance));
        }
        if varied != Varied::Depths {
            words.push(format!("{} depths", self.depths));
        }
        words.join(", ")
    }

    /// As overrides for a command line.
    pub fn command(self) -> String {
        format!(
            "--set grid.nodes={} --set time.step_nodes={} --set numerics.tolerance={:e} --set stress.depths={}",
            self.nodes, self.step, self.tolerance, self.depths
        )
    }
}

/// A finished run.
struct FinishedRun {
    summary: Summary,
    seconds: f64,
    runs: u32,
    bytes: u64,
}

fn run(sets: &[String], domain: Option<&Plan>, threads: usize) -> Result<FinishedRun, String> {
    let overrides = sets
        .iter()
        .map(|text| text.parse::<Override>())
        .collect::<Result<Vec<_>, _>>()
        .map_err(|error| error.to_string())?;
    let mut scene =
        Scene::load_with("demonstration", &overrides).map_err(|error| error.to_string())?;
    if let Some(plan) = domain {
        // The same rectangle whatever the nodes.
        scene.grid.x_min_a = Some(plan.domain.x_min_a);
        scene.grid.x_max_a = Some(plan.domain.x_max_a);
        scene.grid.y_half_a = Some(plan.domain.y_half_b);
    }
    let plan = Plan::new(&scene).map_err(|error| error.to_string())?;
    let bytes = plan.cost.memory_bytes;
    let (summary, time) = timed(|| {
        let mut sim = Simulation::new(&scene, plan.clone(), threads).map_err(|e| e.to_string())?;
        while !sim.is_done() {
            sim.step().map_err(|error| error.to_string())?;
        }
        Ok::<_, String>(sim.summary())
    });
    Ok(FinishedRun {
        summary: summary?,
        seconds: time.seconds,
        runs: time.runs,
        bytes,
    })
}

fn row(
    part: StudiedPart,
    quantity: &'static str,
    varied: Varied,
    setting: Resolution,
    ran: &FinishedRun,
    threads: usize,
) -> AccuracyRow {
    AccuracyRow {
        part,
        quantity,
        varied,
        setting: setting.value(varied),
        fixed: setting.fixed(varied),
        value: None,
        error: 0.0,
        against: Against::Finest,
        order: None,
        seconds: ran.seconds,
        runs: ran.runs,
        threads,
        work: ran.summary.counters.linear_iterations,
        work_unit: "Krylov",
        bytes: Some(ran.bytes),
        front: false,
    }
}

/// A series: what is varied, and the settings from coarse to fine.
pub(super) type StudySeries = (Varied, Vec<Resolution>);

/// Central film and greatest pressure of moving waves, by series.
pub(super) fn rough(series: &[StudySeries], threads: usize) -> Result<Vec<AccuracyRow>, String> {
    let common = [
        "stress=none",
        "life=none",
        "motion.slide_roll=1",
        "motion.entrainment_m_s=5",
        "body_1.surface.kind=smooth",
        "body_2.surface.wavelength_x_m=3.5e-4",
        "body_2.surface.wavelength_y_m=inf",
        "body_2.surface.amplitude_m=1e-7",
        "time.passages=0.5",
    ];
    let mut rows = Vec::new();
    for (varied, settings) in series {
        let mut by_quantity = [Vec::new(), Vec::new()];
        for setting in settings {
            let mut sets: Vec<String> = common.iter().map(|&text| text.to_owned()).collect();
            sets.extend(setting.sets());
            let ran = run(&sets, None, threads)?;
            let values = [ran.summary.h_central_m, ran.summary.p_max_pa];
            for (k, quantity) in ["mean central film", "mean greatest pressure"]
                .into_iter()
                .enumerate()
            {
                let mut row = row(
                    StudiedPart::RoughFilm,
                    quantity,
                    *varied,
                    *setting,
                    &ran,
                    threads,
                );
                row.value = Some(values[k]);
                by_quantity[k].push(row);
            }
        }
        for mut of_one in by_quantity {
            against_finest(&mut of_one);
            rows.extend(of_one);
        }
    }
    Ok(rows)
}

/// How a life was had.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LifeValue {
    /// As computed.
    Computed,
    /// Extrapolated from the run and its companion on half the nodes (`life_extrapolated` of a summary).
    Extrapolated,
}

impl LifeValue {
    /// Name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Computed => "computed",
            Self::Extrapolated => "extrapolated",
        }
    }
}

/// A whole run, what it cost, and its error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LifeRun {
    /// Settings.
    pub setting: Resolution,
    /// How its life was had.
    pub value: LifeValue,
    /// Relative life.
    pub life: f64,
    /// |ln| of it over the limit of all runs.
    pub error: f64,
    /// Time, s.
    pub seconds: f64,
}

/// What the runs tend to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LifeLimit {
    /// Relative life, extrapolated with the order of the scheme.
    pub life: f64,
    /// |ln| of the finest run's life over it: what the extrapolation adds, and no error below it is known.
    pub uncertainty: f64,
}

/// Lives by series, all runs against their limit.
///
/// ```text
/// ln L* = ln L(h) + [ln L(h) − ln L(2h)]/3        the last two of the first series: half the mesh, half the step
/// ```
pub(super) fn life(
    series: &[StudySeries],
    passages: f64,
    threads: usize,
    mut heard: impl FnMut(&str),
) -> Result<(Vec<AccuracyRow>, Vec<LifeRun>, LifeLimit), String> {
    let mut rows: Vec<AccuracyRow> = Vec::new();
    let mut runs: Vec<LifeRun> = Vec::new();
    for (varied, settings) in series {
        let mut of_one: Vec<AccuracyRow> = Vec::new();
        for setting in settings {
            if let Some(known) = rows.iter().find(|row| is_of(row, *setting)) {
                let mut row = known.clone();
                (row.varied, row.setting) = (*varied, setting.value(*varied));
                row.fixed = setting.fixed(*varied);
                of_one.push(row);
                continue;
            }
            heard(&format!("life, {}", setting.command()));
            let mut sets = setting.sets();
            sets.push(format!("stress.depths={}", setting.depths));
            sets.push(format!("time.passages={passages}"));
            let ran = run(&sets, None, threads)?;
            let life = ran.summary.life_relative.unwrap_or(f64::NAN);
            let mut row = row(
                StudiedPart::Life,
                "relative life",
                *varied,
                *setting,
                &ran,
                threads,
            );
            row.value = Some(life);
            runs.push(LifeRun {
                setting: *setting,
                value: LifeValue::Computed,
                life,
                error: 0.0,
                seconds: ran.seconds,
            });
            of_one.push(row);
        }
        against_finest(&mut of_one);
        rows.extend(of_one);
    }
    let limit = limit(series, &runs);
    let with_companions = extrapolated(&runs);
    runs.extend(with_companions);
    for run in &mut runs {
        run.error = (run.life / limit.life).ln().abs();
    }
    Ok((rows, runs, limit))
}

/// Every run whose companion on half the nodes is there too; the companion's time counts.
fn extrapolated(runs: &[LifeRun]) -> Vec<LifeRun> {
    let companion = |of: &LifeRun| {
        let setting = Resolution {
            nodes: (of.setting.nodes - 1) / 2 + 1,
            ..of.setting
        };
        runs.iter().find(|run| run.setting == setting)
    };
    let pairs = runs.iter().filter_map(|run| Some((run, companion(run)?)));
    pairs
        .map(|(fine, coarse)| LifeRun {
            value: LifeValue::Extrapolated,
            life: fine.life * (fine.life / coarse.life).cbrt(),
            seconds: fine.seconds + coarse.seconds,
            ..*fine
        })
        .collect()
}

fn is_of(row: &AccuracyRow, setting: Resolution) -> bool {
    (row.setting, &row.fixed) == (setting.value(row.varied), &setting.fixed(row.varied))
}

fn limit(series: &[StudySeries], runs: &[LifeRun]) -> LifeLimit {
    let ln_life = |setting: &Resolution| {
        let run = runs.iter().find(|run| run.setting == *setting);
        run.map_or(f64::NAN, |run| run.life.ln())
    };
    let lives: Vec<f64> = series.first().map_or(Vec::new(), |(_, settings)| {
        settings.iter().map(ln_life).collect()
    });
    let uncertainty = match lives[..] {
        [.., coarse, fine] => (fine - coarse) / 3.0,
        _ => f64::NAN,
    };
    let fine = lives.last().copied().unwrap_or(f64::NAN);
    LifeLimit {
        life: (fine + uncertainty).exp(),
        uncertainty: uncertainty.abs(),
    }
}

impl Resolution {
    /// Whether nothing is coarser than in `other`.
    fn is_as_fine_as(self, other: Self) -> bool {
        self.nodes >= other.nodes
            && self.step <= other.step
            && self.tolerance <= other.tolerance
            && self.depths >= other.depths
    }
}

/// The cheapest run whose life is within `error` of the limit, and that of every run that is as fine in all respects
/// too: an error that is small because two errors cancel recommends nothing.
pub(super) fn cheapest(runs: &[LifeRun], error: f64) -> Option<&LifeRun> {
    let robust = |run: &&LifeRun| {
        let mut finer = runs
            .iter()
            .filter(|other| other.value == run.value && other.setting.is_as_fine_as(run.setting));
        finer.all(|other| other.error <= error)
    };
    let good = runs.iter().filter(robust);
    good.min_by(|one, two| one.seconds.total_cmp(&two.seconds))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_that_cancel_recommend_nothing() {
        let run = |nodes, step, error, seconds| LifeRun {
            setting: Resolution {
                nodes,
                step,
                ..Resolution::USUAL
            },
            value: LifeValue::Computed,
            life: 1.0,
            error,
            seconds,
        };
        // The coarsest is right by accident: a finer one is not.
        let runs = [
            run(65, 1.0, 0.001, 1.0),
            run(65, 0.5, 0.03, 2.0),
            run(129, 0.5, 0.008, 9.0),
            run(257, 0.5, 0.002, 90.0),
        ];
        assert_eq!(cheapest(&runs, 0.05).map(|run| run.seconds), Some(1.0));
        assert_eq!(cheapest(&runs, 0.01).map(|run| run.seconds), Some(9.0));
        assert_eq!(cheapest(&runs, 0.001), None);
    }
}
