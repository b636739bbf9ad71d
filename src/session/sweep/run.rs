//! Runs chains, several at a time, each on one thread.
//!
//! Whoever is free takes the next chain that is not done and that nobody else has: a thread here, or another process in the
//! same folder. One thread a chain wastes none; only when there are fewer chains than threads does a solver get more than
//! one. Results depend on neither.

use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};

use super::case::{CaseEnd, Neighbour, may_follow};
use super::error::SweepError;
use super::folder::Folder;
use super::spec::Sweep;
use super::work::{Chain, LOOKED_AT, Work};
use crate::run::share_out;

/// Where a sweep is, for a progress bar, and how to stop it.
#[derive(Debug, Default)]
pub struct Progress {
    /// Cases to run.
    pub all: AtomicUsize,
    /// Cases that were there before, or came from others.
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

    /// Notes that cases were there.
    fn note_found(&self, cases: usize) {
        self.found.fetch_add(cases, Ordering::Relaxed);
        self.done.fetch_add(cases, Ordering::Relaxed);
    }

    /// Notes how much of a case under way is done, thousandths, in place of `before`; false: stop.
    fn note(&self, now: u64, before: &mut u64) -> bool {
        self.under_way.fetch_add(now, Ordering::Relaxed);
        self.under_way.fetch_sub(*before, Ordering::Relaxed);
        *before = now;
        !self.stop.load(Ordering::Relaxed)
    }
}

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Report {
    /// Cases computed now.
    pub computed: usize,
    /// Chains that are left to others, who have them.
    pub held: usize,
    /// Whether somebody stopped it.
    pub stopped: bool,
}

/// Computes what is missing of some work, and leaves to others what they have claimed.
///
/// # Errors
/// [`SweepError`] when a case is no scene or cannot be planned, or when the disk says no.
pub fn run(
    sweep: &Sweep,
    folder: &Folder,
    work: &Work,
    threads: usize,
    progress: &Progress,
) -> Result<Report, SweepError> {
    progress.all.store(work.cases, Ordering::Relaxed);
    let mut chains = work.chains.clone();
    if chains.len() <= LOOKED_AT {
        chains.retain(|chain| !is_done(folder, progress, chain));
    }
    let workers = threads.min(chains.len()).max(1);
    let crew = Crew {
        sweep,
        folder,
        progress,
        threads: (threads / workers).max(1),
    };
    let take = |chain: &Chain| {
        let taken = crew.take(chain);
        // What fails for one fails for all: a full disk.
        progress.stop.fetch_or(taken.is_err(), Ordering::Relaxed);
        taken
    };
    let mut report = Report::default();
    // What others had may have been left by them since.
    loop {
        let mut held = Vec::new();
        let taken = share_out(&chains, workers, take, &mut |_, _| {});
        for (chain, taken) in chains.iter().zip(taken) {
            match taken? {
                Taken::Done(computed) => report.computed += computed,
                Taken::Held => held.push(chain.clone()),
            }
        }
        report.held = held.len();
        report.stopped = progress.stop.load(Ordering::Relaxed);
        if held.len() == chains.len() || report.stopped {
            return Ok(report);
        }
        chains = held;
    }
}

/// Whether all cases of a chain are there.
fn is_done(folder: &Folder, progress: &Progress, chain: &Chain) -> bool {
    let is_done = chain
        .cases
        .clone()
        .all(|case| folder.read_case(case).is_some());
    if is_done {
        progress.note_found(chain.cases.len());
    }
    is_done
}

/// What became of a chain.
enum Taken {
    /// It is done, so many cases of it now; or somebody said stop.
    Done(usize),
    /// Somebody else has it.
    Held,
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
    /// Runs what is missing of a chain if nobody else does.
    fn take(&self, chain: &Chain) -> Result<Taken, SweepError> {
        let is_stopped = || self.progress.stop.load(Ordering::Relaxed);
        if is_stopped() || is_done(self.folder, self.progress, chain) {
            return Ok(Taken::Done(0));
        }
        let Some(claim) = self.folder.claim(chain.index)? else {
            return Ok(Taken::Held);
        };
        // It may have been done just before.
        let computed = if is_done(self.folder, self.progress, chain) {
            0
        } else {
            self.run(chain)?
        };
        if !is_stopped() {
            claim.done();
        }
        Ok(Taken::Done(computed))
    }

    /// Runs what is missing of a chain; how many cases that were.
    fn run(&self, chain: &Chain) -> Result<usize, SweepError> {
        let mut computed = 0;
        let cases = &chain.cases;
        let is_there = |case: &usize| self.folder.read_case(*case).is_some();
        self.progress
            .note_found(cases.clone().filter(is_there).count());
        let (from, mut neighbour) = self.take_up(chain)?;
        for index in from..cases.end {
            let case = self.sweep.case(index)?;
            let was_there = self.folder.read_case(index).is_some();
            let mut share = 0;
            let ran = case.run(neighbour.as_ref(), self.threads, |done| {
                self.progress
                    .note((done.clamp(0.0, 1.0) * 1e3) as u64, &mut share)
            });
            self.progress.note(0, &mut share);
            let Some((mut record, state)) = ran else {
                break;
            };
            case.band_over_phases(&mut record, self.threads, &self.progress.stop);
            // A band that was broken off is none.
            if self.progress.stop.load(Ordering::Relaxed) {
                break;
            }
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
