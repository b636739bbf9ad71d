//! Runs the chains of a shard, several at a time, each on one thread.
//!
//! Chains are handed out in order to whoever is free. One thread a chain wastes none; only when there are fewer
//! chains than threads does a solver get more than one. Results depend on neither.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};

use super::case::{CaseEnd, Neighbour, may_follow};
use super::chain::Shard;
use super::error::SweepError;
use super::folder::Folder;
use super::spec::Sweep;
use crate::run::share_out;
use asperity_engine::plan::Cost;

/// Where a sweep is, for a progress bar, and how to stop it.
#[derive(Debug, Default)]
pub struct Progress {
    /// Cases of this shard.
    pub all: AtomicUsize,
    /// Cases that were there before.
    pub found: AtomicUsize,
    /// Cases that are done, those found included.
    pub done: AtomicUsize,
    /// Work of the cases under way, thousandths of a case.
    under_way: AtomicU64,
    /// Set it to stop after the present steps; cases under way are given up.
    pub stop: AtomicBool,
}

impl Progress {
    /// Cases done, those under way by their share.
    pub fn cases(&self) -> f64 {
        let done = self.done.load(Ordering::Relaxed) as f64;
        done + 1e-3 * self.under_way.load(Ordering::Relaxed) as f64
    }

    /// Notes how much of a case under way is done, thousandths, in place of `before`; false: stop.
    fn note(&self, now: u64, before: &mut u64) -> bool {
        self.under_way.fetch_add(now, Ordering::Relaxed);
        self.under_way.fetch_sub(*before, Ordering::Relaxed);
        *before = now;
        !self.stop.load(Ordering::Relaxed)
    }
}

/// How a shard ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Report {
    /// Cases computed now.
    pub computed: usize,
    /// Whether somebody stopped it.
    pub stopped: bool,
}

/// Computes what is missing of a shard.
///
/// # Errors
/// [`SweepError`] when a case is no scene or cannot be planned (all of the shard are checked before the first
/// runs), or when the disk says no.
pub fn run(
    sweep: &Sweep,
    folder: &Folder,
    shard: Shard,
    threads: usize,
    progress: &Progress,
) -> Result<Report, SweepError> {
    let mut own = own_chains(sweep, shard);
    for case in own.iter().flat_map(|chain| chain.cases.clone()) {
        sweep.case(case)?;
    }
    let is_there = |case: &usize| folder.read_case(*case).is_some();
    let all = own.iter().map(|chain| chain.cases.len()).sum();
    let mut found = 0;
    own.retain(|chain| {
        let there = chain.cases.clone().filter(is_there).count();
        found += there;
        there < chain.cases.len()
    });
    progress.all.store(all, Ordering::Relaxed);
    progress.found.store(found, Ordering::Relaxed);
    progress.done.store(found, Ordering::Relaxed);
    let workers = threads.min(own.len()).max(1);
    let crew = Crew {
        sweep,
        folder,
        progress,
        threads: (threads / workers).max(1),
    };
    let work = |chain: &Chain| {
        let ran = crew.run(chain);
        // What fails for one fails for all: a full disk.
        progress.stop.fetch_or(ran.is_err(), Ordering::Relaxed);
        ran
    };
    let ran = share_out(&own, workers, work, &mut |_, _| {});
    Ok(Report {
        computed: ran.into_iter().sum::<Result<_, _>>()?,
        stopped: progress.stop.load(Ordering::Relaxed),
    })
}

/// A chain with its cases.
struct Chain {
    index: usize,
    cases: Range<usize>,
}

/// The chains of a shard.
fn own_chains(sweep: &Sweep, shard: Shard) -> Vec<Chain> {
    let chains = sweep.chains().into_iter().enumerate();
    chains
        .filter(|(index, _)| shard.has(*index))
        .map(|(index, cases)| Chain { index, cases })
        .collect()
}

/// How many cases a shard has, and what they cost together, each from a cold start: an estimate, told before the first one
/// runs.
///
/// # Errors
/// [`SweepError`] as of [`run`].
pub fn cost(sweep: &Sweep, shard: Shard) -> Result<(usize, Cost), SweepError> {
    let mut cases = 0;
    let mut all = Cost {
        memory_bytes: 0,
        time_s: 0.0,
    };
    for index in own_chains(sweep, shard)
        .into_iter()
        .flat_map(|chain| chain.cases)
    {
        let cost = sweep.case(index)?.plan.cost;
        cases += 1;
        all.memory_bytes = all.memory_bytes.max(cost.memory_bytes);
        all.time_s += cost.time_s;
    }
    Ok((cases, all))
}

/// What the workers share.
struct Crew<'a> {
    sweep: &'a Sweep,
    folder: &'a Folder,
    progress: &'a Progress,
    /// Of the solver of each case.
    threads: usize,
}

impl Crew<'_> {
    /// Runs what is missing of a chain; how many cases that were.
    fn run(&self, chain: &Chain) -> Result<usize, SweepError> {
        if self.progress.stop.load(Ordering::Relaxed) {
            return Ok(0);
        }
        let mut computed = 0;
        let (from, mut neighbour) = self.take_up(chain)?;
        let cases = &chain.cases;
        for index in from..cases.end {
            let case = self.sweep.case(index)?;
            let was_there = self.folder.read_case(index).is_some();
            let mut share = 0;
            let ran = case.run(neighbour.as_ref(), self.threads, |done| {
                self.progress
                    .note((done.clamp(0.0, 1.0) * 1e3) as u64, &mut share)
            });
            self.progress.note(0, &mut share);
            let Some((record, state)) = ran else {
                break;
            };
            self.folder.write_case(&record)?;
            computed += 1;
            self.progress
                .done
                .fetch_add(usize::from(!was_there), Ordering::Relaxed);
            let scene = case.scene;
            neighbour = state.map(|state| Neighbour { scene, state });
            // The state after a case is for a run that takes the chain up; that before is not needed any more.
            if index + 1 < cases.end
                && let Some(neighbour) = &neighbour
            {
                self.folder.write_state(chain.index, index, neighbour)?;
            }
            if index > cases.start {
                self.folder.drop_state(chain.index, index - 1);
            }
        }
        Ok(computed)
    }

    /// Where a chain goes on: after its last case whose successor can begin as it would have begun in an
    /// undisturbed run.
    fn take_up(&self, chain: &Chain) -> Result<(usize, Option<Neighbour>), SweepError> {
        let cases = &chain.cases;
        let missing = cases.clone().find(|c| self.folder.read_case(*c).is_none());
        let missing = missing.unwrap_or(cases.end);
        for next in (cases.start + 1..=missing.min(cases.end - 1)).rev() {
            let scene = self.sweep.case(next - 1)?.scene;
            let record = self.folder.read_case(next - 1);
            let was_in_trouble = record.is_some_and(|record| record.end != CaseEnd::Converged);
            if was_in_trouble || !may_follow(&scene, &self.sweep.case(next)?.scene) {
                return Ok((next, None));
            }
            if let Some(state) = self.folder.read_state(chain.index, next - 1, &scene) {
                return Ok((next, Some(Neighbour { scene, state })));
            }
        }
        Ok((cases.start, None))
    }
}
