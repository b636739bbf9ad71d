//! The same cases one by one: what a chain saves, and what it costs in accuracy.
//!
//! Every case is run as `asperity run` would run it: from Hertz, with the passages that its scene asks for. One
//! thread a case and as many cases at a time as the sweep had, in the same process and after it, so that the
//! ratio of the times means something.

use std::sync::atomic::Ordering;

use super::case::{Case, CaseRecord};
use super::error::SweepError;
use super::run::Progress;
use super::spec::Sweep;
use super::table::Rows;
use crate::run::share_out;

/// A sweep against its cases run cold.
#[derive(Debug, Clone)]
pub struct ColdComparison {
    /// Seconds of all cases of the sweep, added.
    pub sweep_s: f64,
    /// Same of the cold cases.
    pub cold_s: f64,
    /// Transforms of all cases of the sweep: work that does not depend on the machine.
    pub sweep_ffts: u64,
    /// Same of the cold cases.
    pub cold_ffts: u64,
    /// Case by case: life of the sweep over cold life, central film over cold film; NaN where there is none.
    pub ratios: Vec<[f64; 2]>,
}

impl ColdComparison {
    /// Greatest departure of a ratio from 1; 0 where there is none.
    pub fn worst(&self, k: usize) -> f64 {
        let off = |ratio: &[f64; 2]| (ratio[k] - 1.0).abs();
        self.ratios
            .iter()
            .map(off)
            .filter(|v| v.is_finite())
            .fold(0.0, f64::max)
    }
}

fn transforms(records: &[CaseRecord]) -> u64 {
    records
        .iter()
        .map(|record| record.summary.counters.ffts)
        .sum()
}

/// Runs every case cold on `threads` threads; `None`: stopped.
///
/// # Errors
/// [`SweepError`] when a case is no scene or cannot be planned.
pub fn against_cold(
    sweep: &Sweep,
    rows: &Rows,
    threads: usize,
    progress: &Progress,
) -> Result<Option<ColdComparison>, SweepError> {
    let case = |index: usize| {
        let case = Case::as_asked(index, sweep.scene(index)?);
        case.map_err(|source| sweep.not_planned(index, source))
    };
    let cases = (0..sweep.len()).map(case).collect::<Result<Vec<_>, _>>()?;
    progress.all.store(cases.len(), Ordering::Relaxed);
    progress.found.store(0, Ordering::Relaxed);
    progress.done.store(0, Ordering::Relaxed);
    let run = |case: &Case| {
        let (record, _) = case.run(None, 1, |_| !progress.stop.load(Ordering::Relaxed))?;
        progress.done.fetch_add(1, Ordering::Relaxed);
        Some(record)
    };
    let ran = share_out(&cases, threads.min(cases.len()), run, &mut |_, _| {});
    let Some(cold) = ran.into_iter().collect::<Option<Vec<CaseRecord>>>() else {
        return Ok(None);
    };
    let ratio = |warm: Option<f64>, cold: Option<f64>| {
        warm.zip(cold).map_or(f64::NAN, |(warm, cold)| warm / cold)
    };
    let pairs = rows.records.iter().zip(&cold);
    Ok(Some(ColdComparison {
        sweep_s: rows.records.iter().map(|record| record.seconds).sum(),
        cold_s: cold.iter().map(|record| record.seconds).sum(),
        sweep_ffts: transforms(&rows.records),
        cold_ffts: transforms(&cold),
        ratios: pairs
            .map(|(one, two)| {
                let (warm, cold) = (&one.summary, &two.summary);
                [
                    ratio(warm.life_relative, cold.life_relative),
                    warm.h_central_m / cold.h_central_m,
                ]
            })
            .collect(),
    }))
}
