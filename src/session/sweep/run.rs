//! Runs the chains of a shard, several at a time, each on one thread.
//!
//! Chains are handed out in order to whoever is free. One thread a chain wastes none; only when there are fewer
//! chains than threads does a solver get more than one. Results depend on neither.

use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};

use super::case::{self, CaseEnd, CaseRecord, Length, Watch, may_follow, shortened};
use super::chain::Shard;
use super::error::SweepError;
use super::folder::Folder;
use super::spec::{ChainKeys, Sweep};
use super::window::window;
use asperity_engine::plan::{Cost, Plan, PlanError, TimeDependence};
use asperity_engine::scene::Scene;
use asperity_engine::sim::State;

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
}

/// One case's share of the progress.
struct Share<'a> {
    progress: &'a Progress,
    told: u64,
}

impl Watch for Share<'_> {
    fn step(&mut self, done: f64) -> bool {
        let now = (done.clamp(0.0, 1.0) * 1e3) as u64;
        if now > self.told {
            let more = now - self.told;
            self.progress.under_way.fetch_add(more, Ordering::Relaxed);
            self.told = now;
        }
        !self.progress.stop.load(Ordering::Relaxed)
    }
}

impl Drop for Share<'_> {
    fn drop(&mut self) {
        self.progress
            .under_way
            .fetch_sub(self.told, Ordering::Relaxed);
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
    let chains: Vec<_> = sweep.chains().into_iter().enumerate().collect();
    let own: Vec<_> = chains.into_iter().filter(|(c, _)| shard.has(*c)).collect();
    for case in own.iter().flat_map(|(_, cases)| cases.clone()) {
        prepare(sweep, case)?;
    }
    let all = own.iter().map(|(_, cases)| cases.len()).sum();
    progress.all.store(all, Ordering::Relaxed);
    let mut waiting = Vec::new();
    let mut found = 0;
    for (chain, cases) in own {
        let there = cases.clone().filter(|c| folder.read_case(*c).is_some());
        let there = there.count();
        if there < cases.len() {
            waiting.push((chain, cases));
        }
        found += there;
    }
    progress.found.store(found, Ordering::Relaxed);
    progress.done.store(found, Ordering::Relaxed);
    let workers = threads.min(waiting.len()).max(1);
    let crew = Crew {
        sweep,
        folder,
        progress,
        waiting,
        next: AtomicUsize::new(0),
        computed: AtomicUsize::new(0),
        failure: Mutex::new(None),
        threads: (threads / workers).max(1),
    };
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| crew.work());
        }
    });
    let failure = crew.failure.into_inner();
    if let Some(error) = failure.unwrap_or_else(std::sync::PoisonError::into_inner) {
        return Err(error);
    }
    Ok(Report {
        computed: crew.computed.into_inner(),
        stopped: progress.stop.load(Ordering::Relaxed),
    })
}

/// How many cases a shard has, and what they cost together, each from a cold start: an estimate, told before the first one
/// runs.
///
/// # Errors
/// [`SweepError`] as of [`run`].
pub fn cost(sweep: &Sweep, shard: Shard) -> Result<(usize, Cost), SweepError> {
    let chains = sweep.chains().into_iter().enumerate();
    let own = chains.filter(|(chain, _)| shard.has(*chain));
    let mut cases = 0;
    let mut all = Cost {
        memory_bytes: 0,
        time_s: 0.0,
    };
    for case in own.flat_map(|(_, cases)| cases) {
        let (_, plan) = prepare(sweep, case)?;
        cases += 1;
        all.memory_bytes = all.memory_bytes.max(plan.cost.memory_bytes);
        all.time_s += plan.cost.time_s;
    }
    Ok((cases, all))
}

/// Scene and plan of a case.
pub(super) fn prepare(sweep: &Sweep, index: usize) -> Result<(Scene, Plan), SweepError> {
    case_of(sweep.scene(index)?, sweep.chain).map_err(|source| SweepError::Plan {
        index,
        at: sweep.at(index),
        source,
    })
}

/// A scene as a case, with its plan.
pub(super) fn case_of(scene: Scene, chain: ChainKeys) -> Result<(Scene, Plan), PlanError> {
    let (scene, length) = shortened(scene, chain);
    let mut plan = Plan::new(&scene)?;
    if length == Length::Windowed {
        fit_window(&mut plan);
    }
    Ok((scene, plan))
}

/// Makes the last passage of a plan as long as its window.
fn fit_window(plan: &mut Plan) {
    if plan.time_dependence != TimeDependence::Transient {
        return;
    }
    let run_in = (plan.length_a - plan.passage_a).max(0.0);
    let asked = plan.length_a - run_in;
    let averaged = window(plan, asked);
    (plan.passage_a, plan.length_a) = (averaged, run_in + averaged);
    let step_a = 4.0 / plan.steps_per_passage as f64;
    plan.steps = (plan.length_a / step_a).ceil() as u64;
}

/// Workers and what they share.
struct Crew<'a> {
    sweep: &'a Sweep,
    folder: &'a Folder,
    progress: &'a Progress,
    waiting: Vec<(usize, Range<usize>)>,
    next: AtomicUsize,
    computed: AtomicUsize,
    failure: Mutex<Option<SweepError>>,
    threads: usize,
}

impl Crew<'_> {
    fn work(&self) {
        loop {
            let k = self.next.fetch_add(1, Ordering::Relaxed);
            let Some((chain, cases)) = self.waiting.get(k) else {
                return;
            };
            if self.progress.stop.load(Ordering::Relaxed) {
                return;
            }
            if let Err(error) = self.chain(*chain, cases.clone()) {
                self.progress.stop.store(true, Ordering::Relaxed);
                let slot = self.failure.lock();
                let mut slot = slot.unwrap_or_else(std::sync::PoisonError::into_inner);
                slot.get_or_insert(error);
                return;
            }
        }
    }

    fn chain(&self, chain: usize, cases: Range<usize>) -> Result<(), SweepError> {
        let (from, mut neighbour) = self.take_up(chain, &cases)?;
        for index in from..cases.end {
            let (scene, plan) = prepare(self.sweep, index)?;
            let was_there = self.folder.read_case(index).is_some();
            let mut share = Share {
                progress: self.progress,
                told: 0,
            };
            let before = neighbour.as_ref();
            let until = case::Until::Passages;
            let ran = case::after(
                before,
                index,
                &scene,
                &plan,
                until,
                self.threads,
                &mut share,
            );
            drop(share);
            let Some((record, state)) = ran else {
                return Ok(());
            };
            self.folder.write_case(&record)?;
            self.computed.fetch_add(1, Ordering::Relaxed);
            if !was_there {
                self.progress.done.fetch_add(1, Ordering::Relaxed);
            }
            neighbour = state.map(|state| (scene, state));
            self.leave(chain, &cases, index, neighbour.as_ref())?;
        }
        Ok(())
    }

    /// Leaves the state after a case for a run that takes the chain up, and drops the one before.
    fn leave(
        &self,
        chain: usize,
        cases: &Range<usize>,
        index: usize,
        neighbour: Option<&(Scene, State)>,
    ) -> Result<(), SweepError> {
        if index + 1 < cases.end
            && let Some((scene, state)) = neighbour
        {
            self.folder.write_state((chain, index), scene, state)?;
        }
        if index > cases.start {
            self.folder.drop_state(chain, index - 1);
        }
        Ok(())
    }

    /// Where a chain goes on: after its last case whose successor can begin as it would have begun in an
    /// undisturbed run.
    fn take_up(
        &self,
        chain: usize,
        cases: &Range<usize>,
    ) -> Result<(usize, Option<(Scene, State)>), SweepError> {
        let missing = cases.clone().find(|c| self.folder.read_case(*c).is_none());
        let missing = missing.unwrap_or(cases.end);
        for next in (cases.start + 1..=missing.min(cases.end - 1)).rev() {
            let before = prepare(self.sweep, next - 1)?.0;
            let starts_cold = self
                .folder
                .read_case(next - 1)
                .is_some_and(|record: CaseRecord| record.end != CaseEnd::Converged)
                || !may_follow(&before, &prepare(self.sweep, next)?.0);
            if starts_cold {
                return Ok((next, None));
            }
            if let Some(state) = self.folder.read_state((chain, next - 1), &before) {
                return Ok((next, Some((before, state))));
            }
        }
        Ok((cases.start, None))
    }
}
