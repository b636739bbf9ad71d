//! How far a sweep's folder is, and what its chains will cost.

use std::sync::atomic::AtomicBool;

use super::error::SweepError;
use super::folder::{Claimed, Folder};
use super::spec::Sweep;
use super::work::{Work, chains_of};
use crate::cells::csv_line;

/// How far a folder is, by the names of its files: whether each holds what it should is seen when the table is made.
#[derive(Debug, Clone)]
pub struct Status {
    /// Cases that are there.
    pub cases: usize,
    /// Chains that are done.
    pub chains: usize,
    /// Chains that somebody has begun and not ended.
    pub claimed: Vec<Claimed>,
    /// Chains that are not done.
    pub left: Work,
}

impl Status {
    /// Looks into the folder of a sweep.
    ///
    /// # Errors
    /// [`SweepError`] when a case that is left cannot be planned.
    pub fn of(sweep: &Sweep, folder: &Folder) -> Result<Self, SweepError> {
        let claimed = folder.claimed();
        let there = folder.cases_by_name(sweep.len());
        let mut left = chains_of(sweep);
        let all = left.len();
        left.retain(|chain| there[chain.cases.clone()].contains(&false));
        let left_over = |claim: &Claimed| left.iter().any(|chain| chain.index == claim.chain);
        Ok(Self {
            cases: there.iter().filter(|there| **there).count(),
            chains: all - left.len(),
            claimed: claimed.into_iter().filter(left_over).collect(),
            left: Work::of(sweep, left, &AtomicBool::new(false))?.unwrap_or_default(),
        })
    }
}

/// The chains of a sweep with their cases and estimated costs from cold starts: the lines of a table, header first, each made
/// when it is asked for.
///
/// # Errors
/// [`SweepError`] when a case is no scene or cannot be planned.
pub fn manifest(sweep: &Sweep) -> impl Iterator<Item = Result<String, SweepError>> {
    let head = [
        "chain",
        "first_case",
        "last_case",
        "estimated_s",
        "memory_bytes",
    ];
    let lines = chains_of(sweep).into_iter().map(|chain| {
        let cost = chain.cost(sweep)?;
        Ok(csv_line([
            chain.index.to_string(),
            chain.cases.start.to_string(),
            (chain.cases.end - 1).to_string(),
            format!("{:.3}", cost.time_s),
            cost.memory_bytes.to_string(),
        ]))
    });
    std::iter::once(Ok(csv_line(head))).chain(lines)
}
