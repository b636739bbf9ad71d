//! How often fields are recorded, so that a recording keeps to its budget.
//!
//! Scalars are recorded in every step. Fields (maps, slice, 3-D view) are recorded in every n-th:
//! n starts from the scene's `record.every_steps`, is raised before the run when the expected size
//! is above the budget, and is doubled while it runs whenever the file is heading beyond it. A
//! recording is thinned and says so; it never stops.

use crate::scene::Record;
use crate::sim::Frame;

/// Part of the raw bytes that reaches the disk after compression, measured on rough passages with
/// `tests/recording.rs`; an estimate that only sets the first cadence.
const COMPRESSED: f64 = 0.75;
/// Bytes of the scalars and texts of a step, compressed.
const SCALARS: f64 = 1.5e3;

/// How often fields are recorded.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Cadence {
    /// Fields are recorded in every so-many-th step.
    every: u64,
    asked: u64,
    budget: f64,
    /// Steps that the scene asks for.
    expected_steps: f64,
    /// The next step whose fields are recorded: the first one always is.
    next_step: u64,
    /// Next share of the budget at which a run without a known end is thinned.
    next_share: f64,
}

impl Cadence {
    /// Decides from the scene's wishes, the steps to expect and the raw bytes of one frame.
    pub(super) fn new(record: &Record, expected_steps: f64, frame_bytes: u64) -> Self {
        let budget = record.budget_mb.max(0.1) * 1e6;
        let asked = record.every_steps.max(1) as u64;
        let for_fields = (budget - expected_steps * SCALARS).max(0.1 * budget);
        let frames = (for_fields / (COMPRESSED * frame_bytes.max(1) as f64)).max(1.0);
        let needed = (expected_steps / frames).ceil() as u64;
        Self {
            every: asked.max(needed),
            asked,
            budget,
            expected_steps,
            next_step: 0,
            next_share: 0.5,
        }
    }

    /// Whether a step's fields are recorded. Asked once for each step.
    pub(super) fn takes(&mut self, step: u64) -> bool {
        let takes = step >= self.next_step;
        if takes {
            self.next_step = step + self.every;
        }
        takes
    }

    /// What was decided, in words.
    pub(super) fn note(&self) -> String {
        let every = match self.every {
            1 => "every step".to_owned(),
            n => format!("one step in {n}"),
        };
        let why = if self.every > self.asked {
            format!(
                ", more seldom than asked for (every {}) to stay within",
                self.asked
            )
        } else {
            ", within".to_owned()
        };
        format!(
            "Scalars are recorded in every step that was handed to the recording; maps, slice and 3-D view in {every}{why} the budget \
             of {:.0} MB.",
            self.budget * 1e-6
        )
    }

    /// Looks at the file's size after a step; a text when fields become rarer from here on.
    pub(super) fn watch(&mut self, frame: &Frame, bytes: u64) -> Option<String> {
        let (bytes, step) = (bytes as f64, frame.step as f64);
        let over = if step < self.expected_steps {
            // Early sizes tell little: what is set up weighs more than what is recorded.
            step > 0.1 * self.expected_steps
                && bytes / step * self.expected_steps > 1.1 * self.budget
                && bytes > 0.25 * self.budget
        } else {
            bytes > self.next_share * self.budget
        };
        if !over {
            return None;
        }
        self.every *= 2;
        self.next_share = 0.5 * (1.0 + self.next_share.max(bytes / self.budget).min(1.0));
        Some(format!(
            "step {}: the recording holds {:.1} of {:.0} MB; from here on fields are recorded in \
             one step in {} only (scalars still in every step)",
            frame.step,
            bytes * 1e-6,
            self.budget * 1e-6,
            self.every
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(every_steps: usize, budget_mb: f64) -> Record {
        Record {
            every_steps,
            budget_mb,
        }
    }

    fn at(step: u64) -> Frame {
        Frame {
            step,
            ..Frame::default()
        }
    }

    #[test]
    fn the_budget_sets_the_cadence_and_the_user_may_ask_for_less() {
        let every = |asked, budget| Cadence::new(&record(asked, budget), 1000.0, 200_000).every;
        assert_eq!(every(1, 200.0), 1);
        assert_eq!(every(3, 200.0), 3);
        assert_eq!(every(1, 60.0), 3);
        assert!(every(1, 1.0) > 100);
        let note = Cadence::new(&record(1, 60.0), 1000.0, 200_000).note();
        assert!(
            note.contains("one step in 3") && note.contains("60 MB"),
            "{note}"
        );
    }

    #[test]
    fn an_endless_run_is_thinned_and_never_passes_its_budget() {
        let mut cadence = Cadence::new(&record(1, 10.0), 100.0, 50_000);
        let (mut bytes, mut notes) = (0_u64, 0);
        for step in 0..100_000 {
            if cadence.takes(step) {
                bytes += 50_000;
            }
            notes += usize::from(cadence.watch(&at(step), bytes).is_some());
        }
        assert!(bytes < 10_000_000, "{bytes}");
        assert!((3..40).contains(&notes), "{notes}");
        assert!(cadence.every > 100);
    }

    #[test]
    fn a_run_that_fits_is_left_alone() {
        let mut cadence = Cadence::new(&record(1, 60.0), 256.0, 200_000);
        for step in 0..256 {
            assert_eq!(cadence.watch(&at(step), 200_000 * step), None);
        }
    }
}
