//! What is to be run, and what it will cost.
//!
//! A scene takes a third of a millisecond to read and plan. Of a large sweep a thousand cases, spread over all of it,
//! are planned before the first one runs; every case is planned when its chain is taken.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

use super::chain::ChainList;
use super::error::SweepError;
use super::spec::Sweep;
use asperity_engine::plan::Cost;

/// Most cases that are planned, and most chains that are looked for, before the first case runs.
pub(super) const LOOKED_AT: usize = 1000;

const NOTHING: Cost = Cost {
    memory_bytes: 0,
    time_s: 0.0,
};

/// The cost of two things one after the other.
fn both(one: Cost, other: Cost) -> Cost {
    Cost {
        memory_bytes: one.memory_bytes.max(other.memory_bytes),
        time_s: one.time_s + other.time_s,
    }
}

/// A chain with its cases.
#[derive(Debug, Clone)]
pub(super) struct Chain {
    pub(super) index: usize,
    pub(super) cases: Range<usize>,
}

impl Chain {
    /// What its cases cost, each from a cold start.
    pub(super) fn cost(&self, sweep: &Sweep) -> Result<Cost, SweepError> {
        self.cases.clone().try_fold(NOTHING, |cost, case| {
            Ok(both(cost, sweep.case(case)?.plan.cost))
        })
    }
}

/// The chains of a sweep.
pub(super) fn chains_of(sweep: &Sweep) -> Vec<Chain> {
    let chains = sweep.chains().into_iter().enumerate();
    chains
        .map(|(index, cases)| Chain { index, cases })
        .collect()
}

/// The chains to run, in the order in which they are begun.
#[derive(Debug, Clone)]
pub struct Work {
    pub(super) chains: Vec<Chain>,
    /// Number of their cases.
    pub cases: usize,
    /// What they cost together, each case from a cold start; the memory is that of the largest.
    pub cost: Cost,
    /// Whether the cost was estimated from some of the cases.
    pub is_sampled: bool,
}

impl Default for Work {
    fn default() -> Self {
        Self {
            chains: Vec::new(),
            cases: 0,
            cost: NOTHING,
            is_sampled: false,
        }
    }
}

impl Work {
    /// All chains of a sweep or some. `None`: somebody said stop.
    ///
    /// # Errors
    /// [`SweepError`] when a case that is looked at is no scene or cannot be planned, or there is no such chain.
    pub fn plan(
        sweep: &Sweep,
        only: Option<&ChainList>,
        stop: &AtomicBool,
    ) -> Result<Option<Self>, SweepError> {
        let mut chains = chains_of(sweep);
        if let Some(only) = only {
            only.check(chains.len())?;
            chains.retain(|chain| only.has(chain.index));
        }
        Self::of(sweep, chains, stop)
    }

    /// These chains. Where all of them are planned, those that take longest come first: what begins last should not end last.
    pub(super) fn of(
        sweep: &Sweep,
        chains: Vec<Chain>,
        stop: &AtomicBool,
    ) -> Result<Option<Self>, SweepError> {
        let cases = chains.iter().map(|chain| chain.cases.len()).sum();
        let is_sampled = cases > LOOKED_AT;
        let mut timed = Vec::new();
        let mut cost = NOTHING;
        let looked_at = if is_sampled {
            sample(&chains, cases)
        } else {
            chains.clone()
        };
        let mut planned = 0;
        for chain in looked_at {
            if stop.load(Ordering::Relaxed) {
                return Ok(None);
            }
            let own = chain.cost(sweep)?;
            cost = both(cost, own);
            planned += chain.cases.len();
            timed.push((own.time_s, chain));
        }
        let chains = if is_sampled {
            cost.time_s *= cases as f64 / planned as f64;
            chains
        } else {
            timed.sort_by(|(one, _), (other, _)| other.total_cmp(one));
            timed.into_iter().map(|(_, chain)| chain).collect()
        };
        Ok(Some(Self {
            chains,
            cases,
            cost,
            is_sampled,
        }))
    }

    /// How many chains there are.
    pub fn chains(&self) -> usize {
        self.chains.len()
    }
}

/// Single cases of some chains: the first, the last, and between them steps of the golden ratio, which no axis is in step
/// with.
fn sample(chains: &[Chain], cases: usize) -> Vec<Chain> {
    const GOLDEN: f64 = 0.618_033_988_749_895;
    let ends: Vec<usize> = chains
        .iter()
        .scan(0, |end, chain| {
            *end += chain.cases.len();
            Some(*end)
        })
        .collect();
    let place = |k: usize| ((k as f64 * GOLDEN).fract() * cases as f64) as usize;
    (0..LOOKED_AT - 1)
        .map(place)
        .chain([cases - 1])
        .map(|place| {
            let at = ends.partition_point(|end| *end <= place);
            let case = chains[at].cases.end - (ends[at] - place);
            Chain {
                index: chains[at].index,
                cases: case..case + 1,
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn sweep(vary: &str) -> Sweep {
        Sweep::parse(&format!("[vary]\n{vary}"), "test", Path::new("")).expect("read")
    }

    fn planned(sweep: &Sweep) -> Result<Work, SweepError> {
        let work = Work::plan(sweep, None, &AtomicBool::new(false))?;
        Ok(work.expect("not stopped"))
    }

    #[test]
    fn chains_that_take_longest_come_first() {
        let work = planned(&sweep("grid.nodes = [65, 257, 129]")).expect("planned");
        let order: Vec<_> = work.chains.iter().map(|chain| chain.index).collect();
        assert_eq!(order, [1, 2, 0]);
    }

    #[test]
    fn of_many_cases_some_are_planned_and_they_meet_every_value() {
        let grid = sweep(
            "grid.nodes = [65, 129]\nload.force_n = { from = 100, to = 900, n = 200 }\n\
             motion.slide_roll = { from = 0, to = 1, n = 100 }",
        );
        let chains = chains_of(&grid);
        let sample = sample(&chains, grid.len());
        let cases: Vec<_> = sample.iter().map(|chain| chain.cases.start).collect();
        assert_eq!(
            (cases.len(), cases[0], cases[999]),
            (1000, 0, grid.len() - 1)
        );
        let loads: std::collections::HashSet<_> =
            cases.iter().map(|case| case / 100 % 200).collect();
        assert_eq!(loads.len(), 200);
        for chain in &sample {
            assert!(chains[chain.index].cases.contains(&chain.cases.start));
        }
        let work = planned(&grid).expect("planned");
        assert!(work.is_sampled && work.chains() == chains.len());
        // By half of the cases on each mesh.
        let per_case = |nodes: &str| {
            let one = sweep(&format!(
                "grid.nodes = [{nodes}]\nmotion.slide_roll = [0.5]"
            ));
            planned(&one).expect("planned").cost.time_s
        };
        let mean = 0.5 * (per_case("65") + per_case("129"));
        let found = work.cost.time_s / work.cases as f64;
        assert!((found / mean - 1.0).abs() < 0.3, "{found} {mean}");
    }
}
