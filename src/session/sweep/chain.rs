//! Chains: the unit of work and of resuming.
//!
//! ```text
//! line    cases along the last axis, where that allows warm starts; in a list, neighbours that differ only
//!         in keys that do
//! chain   a line cut into ⌈m/longest⌉ pieces as even as can be, the longer ones first
//! shard i of n   the chains c with c ≡ i − 1 (mod n)
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
    /// Of all chains those of a shard, in place of ranges.
    shard: Option<Shard>,
}

impl ChainList {
    /// Whether a chain is in it.
    pub(super) fn has(&self, chain: usize) -> bool {
        let is_named = self.ranges.iter().any(|range| range.contains(&chain));
        is_named || self.shard.is_some_and(|shard| shard.has(chain))
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
        let list = |ranges| Self {
            ranges,
            shard: None,
        };
        ranges.map(list).ok_or_else(|| {
            format!("{text:.40} is refused; allowed: numbers of chains from 0 and ranges of them, such as 3 or 0,4-7")
        })
    }
}

/// A part of a sweep: i of n, from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// Which, 1 to n.
    pub index: usize,
    /// Of how many.
    pub count: usize,
}

impl Shard {
    /// Whether a chain belongs to it.
    fn has(self, chain: usize) -> bool {
        chain % self.count == self.index - 1
    }
}

impl std::str::FromStr for Shard {
    type Err = String;

    /// Reads `i/n`.
    fn from_str(text: &str) -> Result<Self, String> {
        let refused =
            || format!("{text:.20} is refused; allowed: i/n with 1 <= i <= n, such as 3/8");
        let (index, count) = text.split_once('/').ok_or_else(refused)?;
        let parse = |part: &str| part.trim().parse::<usize>().ok();
        match (parse(index), parse(count)) {
            (Some(index), Some(count)) if (1..=count).contains(&index) => Ok(Self { index, count }),
            _ => Err(refused()),
        }
    }
}

impl From<Shard> for ChainList {
    fn from(shard: Shard) -> Self {
        Self {
            ranges: Vec::new(),
            shard: Some(shard),
        }
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
    fn a_shard_is_every_nth_chain() {
        let shard: Shard = "2/3".parse().expect("read");
        let list = ChainList::from(shard);
        let has: Vec<_> = (0..9).filter(|chain| list.has(*chain)).collect();
        assert_eq!(has, [1, 4, 7]);
        assert!(list.check(1).is_ok(), "more shards than chains");
        for text in ["", "1", "0/2", "3/2", "a/2", "1/0"] {
            assert!(text.parse::<Shard>().is_err(), "{text}");
        }
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
