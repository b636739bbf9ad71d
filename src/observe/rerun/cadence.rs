//! How often a step is recorded, so that a recording keeps to its budget.
//!
//! Fields (maps, slice, 3-D view) are recorded in every n-th step. n starts from the scene's
//! `record.every_steps`, is raised before the run when the expected size is above the budget, and
//! is doubled while it runs when the file is heading beyond it. Scalars are recorded in every step
//! of the run that the scene asks for.
//!
//! A run that goes on after that (the explorer) has no end to plan for. Time is then cut into
//! octaves, each twice as long as the one before. The k-th may fill 1/(k + 1) of what is left of
//! the budget: the shares 1/(k(k + 1)) add up to one, so the budget is approached and never
//! passed, and the steps between two recorded frames grow about as the time that has passed. A
//! recording is thinned and says so; it never stops.

use crate::scene::Record;

/// Part of the raw bytes that reaches the disk after compression: 0.12 MB of 0.32 MB were measured in the
/// demonstration scene at 129 x 129 nodes, and roughness without a pattern compresses less. It only sets the
/// first cadence.
const COMPRESSED: f64 = 0.45;
/// Bytes of the scalars of a step, compressed.
const SCALARS: f64 = 1.5e3;
/// Part of an octave's share that scalars may take.
const SCALARS_SHARE: f64 = 0.2;

/// What of a step is recorded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Due {
    pub(super) fields: bool,
    pub(super) scalars: bool,
}

/// Every so-many-th step, beginning with the first.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Every {
    steps: u64,
    next: u64,
}

impl Every {
    fn takes(&mut self, step: u64) -> bool {
        let takes = step >= self.next;
        if takes {
            self.next = step.saturating_add(self.steps);
        }
        takes
    }
}

/// How often steps are recorded.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Cadence {
    fields: Every,
    scalars: Every,
    asked: u64,
    budget: f64,
    /// Steps that the scene asks for.
    expected: f64,
    /// Steps whose fields were recorded.
    recorded: u64,
    /// Octaves that have begun since the scene's end, and the step at which the next begins.
    octave: u32,
    octave_end: f64,
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
            fields: Every {
                steps: asked.max(needed),
                next: 0,
            },
            scalars: Every { steps: 1, next: 0 },
            asked,
            budget,
            expected: expected_steps.max(1.0),
            recorded: 0,
            octave: 0,
            octave_end: expected_steps.max(1.0),
        }
    }

    /// What of a step is recorded. Asked once for each step.
    pub(super) fn due(&mut self, step: u64) -> Due {
        let fields = self.fields.takes(step);
        self.recorded += u64::from(fields);
        // A frame without its scalars would be a picture without numbers.
        let scalars = self.scalars.takes(step) || fields;
        Due { fields, scalars }
    }

    /// What was decided, in words.
    pub(super) fn note(&self) -> String {
        let every = match self.fields.steps {
            1 => "every step".to_owned(),
            n => format!("one step in {n}"),
        };
        let why = if self.fields.steps > self.asked {
            format!(
                ", more seldom than asked for (one in {}) to stay within",
                self.asked
            )
        } else {
            ", within".to_owned()
        };
        format!(
            "Scalars are recorded in every step that was handed to the recording; maps, slice and \
             3-D view in {every}{why} the budget of {:.0} MB. If that changed on the way, the log \
             says so.",
            self.budget * 1e-6
        )
    }

    /// Looks at the file's size after a step; a text when recording becomes rarer from here on.
    pub(super) fn watch(&mut self, step: u64, bytes: u64) -> Option<String> {
        let (now, bytes) = (step as f64, bytes as f64);
        let before = (self.fields.steps, self.scalars.steps);
        if now >= self.octave_end {
            self.begin_octave(bytes);
        } else if self.octave == 0 && self.heads_beyond(now, bytes) {
            self.fields.steps = self.fields.steps.saturating_mul(2);
        }
        if (self.fields.steps, self.scalars.steps) == before {
            return None;
        }
        Some(format!(
            "step {step}: the recording holds {:.1} of {:.0} MB; from here on fields are recorded in \
             one step in {}, scalars in one in {}",
            bytes * 1e-6,
            self.budget * 1e-6,
            self.fields.steps,
            self.scalars.steps
        ))
    }

    /// Whether the scene's own run would pass the budget at its present rate. Early sizes tell
    /// little: what is set up weighs more than what is recorded.
    fn heads_beyond(&self, now: f64, bytes: f64) -> bool {
        let remaining = (self.expected - now) / self.fields.steps as f64;
        let per_frame = bytes / self.recorded.max(1) as f64;
        bytes > 0.25 * self.budget && bytes + remaining * per_frame > 1.1 * self.budget
    }

    fn begin_octave(&mut self, bytes: f64) {
        let steps = self.expected * 2.0_f64.powi(self.octave as i32);
        self.octave += 1;
        self.octave_end += steps;
        // Something is always left, so that a file above its budget is thinned and not stopped.
        let left = (self.budget - bytes).max(1e-3 * self.budget);
        let share = left / f64::from(self.octave + 1);
        let per_frame = bytes / self.recorded.max(1) as f64;
        let fields = steps * per_frame / ((1.0 - SCALARS_SHARE) * share);
        let scalars = steps * SCALARS / (SCALARS_SHARE * share);
        self.fields.steps = self.fields.steps.max(fields.ceil() as u64);
        self.scalars.steps = self.scalars.steps.max(scalars.ceil() as u64);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: u64 = 50_000;

    fn record(every_steps: usize, budget_mb: f64) -> Record {
        Record {
            every_steps,
            budget_mb,
        }
    }

    /// Bytes after so many steps, the steps whose fields were recorded, and the notes given.
    fn run(cadence: &mut Cadence, steps: u64) -> (u64, Vec<u64>, usize) {
        let (mut bytes, mut taken, mut notes) = (0, Vec::new(), 0);
        for step in 1..=steps {
            let due = cadence.due(step);
            if due.fields {
                taken.push(step);
            }
            bytes += FRAME * u64::from(due.fields) + SCALARS as u64 * u64::from(due.scalars);
            notes += usize::from(cadence.watch(step, bytes).is_some());
        }
        (bytes, taken, notes)
    }

    #[test]
    fn the_budget_sets_the_cadence_and_the_user_may_ask_for_less() {
        let every = |asked, budget| {
            Cadence::new(&record(asked, budget), 1000.0, 400_000)
                .fields
                .steps
        };
        assert_eq!(every(1, 200.0), 1);
        assert_eq!(every(3, 200.0), 3);
        assert_eq!(every(1, 70.0), 3);
        assert!(every(1, 1.0) > 100);
        let note = Cadence::new(&record(1, 70.0), 1000.0, 400_000).note();
        assert!(note.contains("one step in 3"), "{note}");
        assert!(note.contains("70 MB"), "{note}");
    }

    #[test]
    fn an_endless_run_is_thinned_never_stopped_and_keeps_its_budget() {
        let mut cadence = Cadence::new(&record(1, 10.0), 100.0, FRAME);
        let (bytes, taken, notes) = run(&mut cadence, 200_000);
        assert!(bytes < 10_000_000, "{bytes}");
        assert!((5..20).contains(&notes), "{notes}");
        // The last half still holds frames.
        assert!(
            taken.last().is_some_and(|&step| step > 100_000),
            "{taken:?}"
        );
    }

    #[test]
    fn a_run_that_fits_is_left_alone() {
        let mut cadence = Cadence::new(&record(1, 60.0), 256.0, FRAME);
        let (_, taken, notes) = run(&mut cadence, 255);
        assert_eq!((taken.len(), notes), (255, 0));
    }

    #[test]
    fn frames_that_are_larger_than_expected_thin_the_rest() {
        // A tenth of the true size was expected.
        let mut cadence = Cadence::new(&record(1, 5.0), 1000.0, FRAME / 10);
        let (bytes, taken, notes) = run(&mut cadence, 999);
        assert!(notes > 0 && taken.len() < 200, "{notes} {}", taken.len());
        assert!(bytes < 8_000_000, "{bytes}");
    }
}
