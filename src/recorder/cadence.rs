//! How often a step is recorded, so that a recording keeps to its budget.
//!
//! Fields (maps, slice, 3-D view) are recorded in every n-th step, scalars in every m-th, which is every one as long as
//! they fit into half of the budget. n starts from the scene's `record.every_steps`, is raised before the run when the
//! expected size is above the budget, and while it runs when what was recorded is heading beyond it. What is recorded
//! is [estimated](super::size) by what is in it, so that what is kept does not depend on the clock.
//!
//! A run that goes on after the scene's end (the explorer) has no end to plan for. Time is then cut into
//! octaves, each twice as long as the one before. The k-th may fill 1/(k + 1) of what is left of
//! the budget: the shares 1/(k(k + 1)) add up to one, so the budget is approached and never
//! passed, and the steps between two recorded frames grow about as the time that has passed. A
//! recording is thinned and says so; it never stops.

use asperity_engine::plan::recording::{
    ALWAYS_BYTES, OWN_SHARE, RecordingRhythm, SCALARS_BYTES, left_bytes,
};
use asperity_engine::scene::Record;

/// Part of the raw bytes that reaches the disk after compression: 0.12 MB of 0.32 MB were measured in the
/// demonstration scene at 129 x 129 nodes, and roughness without a pattern compresses less. It only sets the
/// first cadence.
const COMPRESSED: f64 = 0.45;
/// Part of what is left that scalars may take in an octave after the scene's own run.
const LATER_SCALARS_SHARE: f64 = 0.2;
/// Part of the budget that is never planned with: the log's lines come when they come.
const MARGIN: f64 = 0.02;

/// What a picture may take beyond its own bytes (a chunk of 2.4 kB of each of some hundred entities).
const UNSHARED: f64 = 2.5e5;

/// What of a step is recorded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Due {
    pub(crate) fields: bool,
    pub(crate) scalars: bool,
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

    /// At least so many steps apart.
    fn thin(&mut self, steps: f64) {
        self.steps = self.steps.max(steps.ceil() as u64);
    }
}

/// How often steps are recorded.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Cadence {
    fields: Every,
    scalars: Every,
    every_asked: u64,
    budget: f64,
    /// Bytes that come at the end whatever was recorded.
    last: f64,
    /// Steps that the scene asks for.
    expected: f64,
    /// Steps whose fields were recorded, and their bytes.
    recorded: u64,
    fields_bytes: f64,
    /// Bytes of all that was recorded so far, and what they may come to in this octave.
    bytes: f64,
    limit: f64,
    /// Octaves that have begun since the scene's end, and the step at which the next begins.
    octave: u32,
    octave_end: f64,
}

impl Cadence {
    /// Decides from the scene's wishes, the steps to expect and the raw bytes of one frame; `spent`: bytes that were
    /// logged before the first, and those that come last.
    pub(crate) fn new(
        record: &Record,
        expected_steps: f64,
        frame_bytes: u64,
        spent: [f64; 2],
    ) -> Self {
        let budget = record.budget_mb * 1e6;
        let asked = record.every_steps.max(1) as u64;
        let steps = expected_steps.max(1.0);
        let last = ALWAYS_BYTES + spent[1];
        let frame = COMPRESSED * frame_bytes.max(1) as f64;
        let rhythm =
            RecordingRhythm::new(record, steps, frame, left_bytes(record, spent[0] + last));
        let every = |steps| Every { steps, next: 0 };
        Self {
            fields: every(rhythm.fields),
            scalars: every(rhythm.scalars),
            every_asked: asked,
            budget,
            last,
            expected: steps,
            recorded: 0,
            fields_bytes: 0.0,
            bytes: spent[0],
            limit: OWN_SHARE * budget,
            octave: 0,
            octave_end: steps,
        }
    }

    /// Pictures of the scene's own run, as far as they are known before.
    pub(crate) fn pictures(&self) -> f64 {
        self.expected / self.fields.steps as f64
    }

    /// Bytes that may still come in this octave; never none, so that there is something to divide by.
    fn left(&self) -> f64 {
        (self.limit - self.bytes - self.last).max(1e-3 * self.budget)
    }

    /// Whether one more picture keeps the budget: where so few were recorded that their entities' first chunks are not
    /// shared yet, it may take much more than the mean.
    pub(crate) fn has_room(&self) -> bool {
        let more = 2.0 * self.frame() + UNSHARED;
        self.bytes + self.last + more <= (1.0 - MARGIN) * self.budget
    }

    /// Bytes of a frame's fields, on average.
    fn frame(&self) -> f64 {
        self.fields_bytes / self.recorded.max(1) as f64
    }

    /// What of a step is recorded. Asked once for each step.
    pub(crate) fn due(&mut self, step: u64) -> Due {
        let first = self.recorded == 0;
        let holds = |more: f64| first || self.bytes + self.last + more <= self.limit;
        let (frame, scalars) = (holds(self.frame() + SCALARS_BYTES), holds(SCALARS_BYTES));
        let fields = frame && self.fields.takes(step);
        // A frame without its scalars would be a picture without numbers.
        let scalars = fields || (scalars && self.scalars.takes(step));
        Due { fields, scalars }
    }

    /// The fields of a step were recorded: so many bytes.
    pub(crate) fn note_fields(&mut self, bytes: f64) {
        self.recorded += 1;
        self.fields_bytes += bytes;
    }

    /// What was decided, in words.
    pub(crate) fn note(&self) -> String {
        let every = |steps| match steps {
            1 => "every step".to_owned(),
            n => format!("one step in {n}"),
        };
        let why = if self.fields.steps > self.every_asked {
            format!(
                ", more seldom than asked for (one in {}) to stay within",
                self.every_asked
            )
        } else {
            ", within".to_owned()
        };
        format!(
            "Scalars are recorded in {} handed to the recording; maps, slice and \
             3-D view in {}{why} the budget of {:.1} MB. If this changed during the run, the log \
             says so.",
            every(self.scalars.steps),
            every(self.fields.steps),
            self.budget * 1e-6
        )
    }

    /// Takes up what all that was recorded by this step weighs, bytes; a text when recording becomes rarer from here on.
    pub(crate) fn watch(&mut self, step: u64, bytes: f64) -> Option<String> {
        let now = step as f64;
        self.bytes = bytes;
        let before = (self.fields.steps, self.scalars.steps);
        if now >= self.octave_end {
            self.begin_octave();
        } else if self.octave == 0 {
            self.keep_to_limit(now);
        }
        if (self.fields.steps, self.scalars.steps) == before {
            return None;
        }
        Some(format!(
            "step {step}: the recording holds about {:.1} of {:.1} MB; from here on fields are recorded in \
             one step in {}, scalars in one in {}",
            (bytes + self.last) * 1e-6,
            self.budget * 1e-6,
            self.fields.steps,
            self.scalars.steps
        ))
    }

    /// Thins the fields of the scene's own run when it would pass its limit at its present rate. The first frame has
    /// more in it than those after it.
    fn keep_to_limit(&mut self, now: f64) {
        if self.recorded < 2 || self.fields.next as f64 >= self.expected {
            return;
        }
        let steps = self.expected - now;
        let scalars = steps * SCALARS_BYTES / self.scalars.steps as f64;
        let fields = self.left() - scalars;
        if steps * self.frame() / self.fields.steps as f64 > fields {
            // Twice as far apart at least: not every frame is worth a word.
            let needed = steps * self.frame() / fields.max(1e-3 * self.budget);
            let needed = needed.max(2.0 * self.fields.steps as f64);
            self.fields.thin(needed.min(self.expected));
            self.fields.next = (now as u64).saturating_add(self.fields.steps);
        }
    }

    fn begin_octave(&mut self) {
        let steps = self.expected * 2.0_f64.powi(self.octave as i32);
        self.octave += 1;
        self.octave_end += steps;
        self.limit = (1.0 - MARGIN) * self.budget;
        let share = self.left() / f64::from(self.octave + 1);
        self.limit = self.bytes + self.last + share;
        let scalars = LATER_SCALARS_SHARE * share;
        self.scalars.thin(steps * SCALARS_BYTES / scalars);
        self.fields.thin(steps * self.frame() / (share - scalars));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: f64 = 50_000.0;
    const STEP: f64 = 800.0;

    fn record(every_steps: usize, budget_mb: f64) -> Record {
        Record {
            every_steps,
            budget_mb,
        }
    }

    fn cadence(every_steps: usize, budget_mb: f64, steps: f64) -> Cadence {
        Cadence::new(
            &record(every_steps, budget_mb),
            steps,
            FRAME as u64,
            [1e5, 0.0],
        )
    }

    /// Bytes after so many steps, the steps whose fields and the number whose scalars were recorded, and the notes
    /// given.
    fn run(cadence: &mut Cadence, steps: u64, frame: f64) -> (f64, Vec<u64>, usize, usize) {
        let (mut bytes, mut taken, mut scalars, mut notes) = (1e5, Vec::new(), 0, 0);
        for step in 1..=steps {
            let due = cadence.due(step);
            if due.fields {
                taken.push(step);
                bytes += frame;
                cadence.note_fields(frame);
            }
            scalars += usize::from(due.scalars);
            bytes += STEP * f64::from(u8::from(due.scalars));
            notes += usize::from(cadence.watch(step, bytes).is_some());
        }
        (bytes + ALWAYS_BYTES, taken, scalars, notes)
    }

    #[test]
    fn the_budget_sets_the_cadence_and_the_user_may_ask_for_less() {
        let every = |asked, budget| {
            Cadence::new(&record(asked, budget), 1000.0, 400_000, [0.0; 2])
                .fields
                .steps
        };
        assert_eq!(every(1, 220.0), 1);
        assert_eq!(every(3, 220.0), 3);
        assert_eq!(every(1, 80.0), 3);
        assert!(every(1, 2.0) > 100);
        let note = Cadence::new(&record(1, 80.0), 1000.0, 400_000, [0.0; 2]).note();
        assert!(note.contains("one step in 3"), "{note}");
        assert!(note.contains("80.0 MB"), "{note}");
    }

    #[test]
    fn a_budget_is_a_budget_however_long_the_run_and_however_large_the_frames() {
        for budget in [2.0, 5.0, 20.0] {
            for expected in [100.0, 1000.0, 20_000.0, 100_000.0] {
                for frame in [0.1 * FRAME, FRAME, 10.0 * FRAME] {
                    for steps in [expected as u64, 200_000] {
                        let mut cadence = cadence(1, budget, expected);
                        let (bytes, taken, scalars, notes) = run(&mut cadence, steps, frame);
                        let case = format!("{budget} MB, {expected} of {steps}, {frame}: {bytes}");
                        let first = ALWAYS_BYTES + 1e5 + frame + STEP;
                        assert!(bytes <= (budget * 1e6).max(first), "{case}");
                        assert!(scalars > 100.min(steps as usize - 1) / 10, "{case}");
                        assert!(notes < 40, "{case}: {notes} notes");
                        let most = expected.min(steps as f64) * (frame + STEP);
                        let fair = (0.4 * (budget * 1e6 - first)).min(0.4 * most);
                        assert!(bytes >= fair, "{case} of {fair}, {} frames", taken.len());
                    }
                }
            }
        }
    }

    #[test]
    fn an_endless_run_is_thinned_never_stopped() {
        let mut cadence = cadence(1, 10.0, 100.0);
        let (_, taken, _, notes) = run(&mut cadence, 200_000, FRAME);
        assert!((5..20).contains(&notes), "{notes}");
        // What lies between two frames at least doubles with every thinning, so the last may lie anywhere in the last three
        // quarters.
        assert!(taken.last().is_some_and(|&step| step > 50_000), "{taken:?}");
    }

    #[test]
    fn a_run_that_fits_is_left_alone() {
        let mut cadence = cadence(1, 60.0, 256.0);
        let (_, taken, scalars, notes) = run(&mut cadence, 255, FRAME);
        assert_eq!((taken.len(), scalars, notes), (255, 255, 0));
    }
}
