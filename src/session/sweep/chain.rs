//! Chains: the unit of work and of resuming.
//!
//! ```text
//! line    cases along the last axis, where that allows warm starts; in a list, neighbours that differ only
//!         in keys that do
//! chain   a line cut into ⌈m/longest⌉ pieces as even as can be, the longer ones first
//! ```
//! A chain is fixed by the sweep file alone: its first case starts cold, the others from the end of the one
//! before, so the table does not depend on who runs which, on threads, or where a run was broken off.

use std::ops::{Range, RangeInclusive};

use super::axis::VariedKey;
use super::error::SweepError;
use super::spec::{Combine, Sweep};

/// Some chains of a sweep by their numbers, from 0.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ChainList {
    ranges: Vec<RangeInclusive<usize>>,
}

impl ChainList {
    /// Whether a chain is in it.
    pub(super) fn has(&self, chain: usize) -> bool {
        self.ranges.iter().any(|range| range.contains(&chain))
    }

    /// Refuses numbers that a sweep with so many chains does not have.
    pub(super) fn check(&self, chains: usize) -> Result<(), SweepError> {
        match self.ranges.iter().find(|range| *range.end() >= chains) {
            None => Ok(()),
            Some(range) => Err(SweepError::Chain {
                asked: *range.end(),
                last: chains - 1,
            }),
        }
    }
}

impl std::str::FromStr for ChainList {
    type Err = String;

    /// Reads `3`, `3-5` or `3,7-9`.
    fn from_str(text: &str) -> Result<Self, String> {
        let range = |part: &str| {
            let (first, last) = part.split_once('-').unwrap_or((part, part));
            let range = first.trim().parse().ok()?..=last.trim().parse().ok()?;
            (!range.is_empty()).then_some(range)
        };
        let ranges = text.split(',').map(range).collect::<Option<_>>();
        ranges.map(|ranges| Self { ranges }).ok_or_else(|| {
            format!("{text:.40} is refused; allowed: numbers of chains from 0 and ranges of them, such as 3 or 0,4-7")
        })
    }
}

impl Sweep {
    /// The chains, in the order of their cases.
    pub fn chains(&self) -> Vec<Range<usize>> {
        let mut chains = Vec::new();
        let mut from = 0;
        while from < self.len() {
            let to = self.line_end(from);
            cut(from..to, self.chain.longest, &mut chains);
            from = to;
        }
        chains
    }

    /// Where the line that begins with a case ends.
    fn line_end(&self, from: usize) -> usize {
        let Some(last) = self.axes.last() else {
            return self.len();
        };
        match self.combine {
            Combine::Grid if last.is_warm() => from + last.values.len(),
            Combine::Grid => from + 1,
            Combine::List => {
                let cold = || self.axes.iter().filter(|axis| !axis.is_warm());
                let same = |axis: &VariedKey, k: usize| axis.values[k] == axis.values[k - 1];
                (from + 1..self.len())
                    .find(|k| cold().any(|axis| !same(axis, *k)))
                    .unwrap_or(self.len())
            }
        }
    }
}

/// Cuts a line into pieces of at most `longest`, as even as can be. The longer ones come first: S near 2 costs more
/// than S near 0, and what begins last should not end last.
fn cut(line: Range<usize>, longest: usize, chains: &mut Vec<Range<usize>>) {
    let pieces = line.len().div_ceil(longest.max(1));
    let at = |k: usize| line.start + (line.len() * k).div_ceil(pieces);
    chains.extend((0..pieces).map(|k| at(k)..at(k + 1)));
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn sweep(vary: &str) -> Sweep {
        Sweep::parse(
            &format!("{vary}\n[chain]\nlongest = 7\n"),
            "test",
            Path::new(""),
        )
        .expect("read")
    }

    #[test]
    fn lines_are_cut_evenly_and_cold_axes_make_chains_of_one() {
        let chains = sweep("[vary]\nmotion.slide_roll = { from = 0, to = 2, n = 21 }").chains();
        assert_eq!(chains, [0..7, 7..14, 14..21]);
        let chains = sweep("[vary]\nmotion.slide_roll = { from = 0, to = 2, n = 8 }").chains();
        assert_eq!(chains, [0..4, 4..8]);
        let chains = sweep("[vary]\nmotion.slide_roll = { from = 0, to = 2, n = 9 }").chains();
        assert_eq!(chains, [0..5, 5..9]);
        let chains = sweep("[vary]\nmotion.slide_roll = [0.0, 1.0]\nload.force_n = [1.0, 2.0]");
        assert_eq!(chains.chains(), [0..2, 2..4]);
        assert_eq!(chains.at(1), "load.force_n = 1, motion.slide_roll = 1");
        let chains = sweep("[vary]\nload.force_n = [1.0, 2.0, 3.0]").chains();
        assert_eq!(chains, [0..1, 1..2, 2..3]);
        let list = "combine = \"list\"\n[vary]\nload.force_n = [1.0, 1.0, 2.0]\nmotion.slide_roll = [0.0, 1.0, 1.0]";
        assert_eq!(sweep(list).chains(), [0..2, 2..3]);
    }

    #[test]
    fn chains_are_asked_for_by_number() {
        let list: ChainList = "3,7-9".parse().expect("read");
        let has: Vec<_> = (0..12).filter(|chain| list.has(*chain)).collect();
        assert_eq!(has, [3, 7, 8, 9]);
        assert!(list.check(10).is_ok());
        let refused = list.check(9).expect_err("no chain 9").to_string();
        assert_eq!(refused, "--chain 9: the sweep has chains 0 to 8");
        for text in ["", "a", "-1", "4-3", "1,", "1-2-3", "1/8"] {
            assert!(text.parse::<ChainList>().is_err(), "{text}");
        }
    }
}
