//! What was tried and what became of it.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::child::Ended;

/// One kind of attack.
#[derive(Debug)]
pub(crate) struct Tally {
    pub(crate) kind: String,
    /// By how they ended: exit code, or what was observed.
    pub(crate) ends: BTreeMap<String, u64>,
    /// With the command that repeats each.
    pub(crate) failures: Vec<String>,
    pub(crate) slowest_s: f64,
    pub(crate) peak_mb: f64,
}

impl Tally {
    pub(crate) fn new(kind: &str) -> Self {
        Self {
            kind: kind.to_owned(),
            ends: BTreeMap::new(),
            failures: Vec::new(),
            slowest_s: 0.0,
            peak_mb: 0.0,
        }
    }

    pub(crate) fn tried(&self) -> u64 {
        self.ends.values().sum()
    }

    /// By its exit code.
    pub(crate) fn take(&mut self, ended: &Ended) {
        self.peak_mb = self.peak_mb.max(ended.peak_mb);
        let code = ended.code();
        self.count(code.map_or("no exit code".to_owned(), |code| {
            format!("exit code {code}")
        }));
    }

    pub(crate) fn count(&mut self, end: impl Into<String>) {
        *self.ends.entry(end.into()).or_insert(0) += 1;
    }
}

/// As Markdown.
pub(crate) fn table(tallies: &[Tally]) -> String {
    let mut text = String::from(
        "| attack | tried | survived | failed | how they ended | slowest, s | most memory, MB |\n|---|---|---|---|---|---|---|\n",
    );
    for tally in tallies.iter().filter(|tally| tally.tried() > 0) {
        let ends = tally.ends.iter().map(|(end, n)| format!("{end}: {n}"));
        let failed = tally.failures.len() as u64;
        writeln!(
            text,
            "| {} | {} | {} | {failed} | {} | {:.1} | {:.0} |",
            tally.kind,
            tally.tried(),
            tally.tried().saturating_sub(failed),
            ends.collect::<Vec<_>>().join(", "),
            tally.slowest_s,
            tally.peak_mb
        )
        .unwrap();
    }
    let tried: u64 = tallies.iter().map(Tally::tried).sum();
    let failed: usize = tallies.iter().map(|tally| tally.failures.len()).sum();
    writeln!(text, "\n{tried} tried, {failed} failed.").unwrap();
    for failure in tallies.iter().flat_map(|tally| &tally.failures) {
        writeln!(text, "* {failure}").unwrap();
    }
    text
}
