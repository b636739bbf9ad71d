//! Where the tour is: which lesson, which beat, and whether it asks, shows or tells.
//!
//! ```text
//! a question:  asks ──a digit, n──> shows ──its passages──> tells ──n, reading time──> next beat
//! none:                             shows ──n, or its passages and reading time──────> next beat
//! ```
//! A question waits for its answer; the last beat stays.

use std::sync::Arc;
use std::time::Duration;

use super::{Beat, Lesson};
use asperity_engine::sim::Frame;

/// Letters that a class reads in a second.
const LETTERS_PER_S: f64 = 14.0;

/// What a beat does now.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TourPhase {
    /// It waits for an answer; what it will show is not shown yet.
    Asks,
    /// It shows.
    Shows,
    /// It tells what the answer is, as it was found.
    Tells(FoundAnswer),
}

/// What was found of a question.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FoundAnswer {
    /// A knob that somebody has turned meanwhile: the number is of another experiment.
    pub turned: Option<&'static str>,
    /// The number; `None`: this scene does not know it.
    pub value: Option<f64>,
    /// The right answer, from 0.
    pub right: Option<usize>,
}

/// Where the tour is.
#[derive(Debug, Clone)]
pub struct TourState {
    /// The lesson.
    pub lesson: Arc<Lesson>,
    /// Its place among the lessons.
    pub place: usize,
    /// Beat of that lesson.
    pub beat: usize,
    /// What the beat does.
    pub phase: TourPhase,
    /// What was answered, from 0.
    pub said: Option<usize>,
    /// The frame at the end of the beat before.
    pub before: Option<Arc<Frame>>,
    /// That of each beat from the second on, for who goes back.
    pub befores: Vec<Option<Arc<Frame>>>,
    /// Passages when it began to show.
    since: f64,
    /// When its words were begun to be read.
    read_from: Duration,
    /// Where it has set the dials; empty: it has not shown yet.
    pub set_to: Vec<f64>,
    /// When.
    pub set_at: Duration,
}

impl TourState {
    /// A beat of a lesson, as it begins: with its question, if it has one.
    pub fn begin(lesson: Arc<Lesson>, place: usize, beat: usize) -> Self {
        let asks = lesson.beats[beat].question.is_some();
        Self {
            lesson,
            place,
            beat,
            phase: if asks {
                TourPhase::Asks
            } else {
                TourPhase::Shows
            },
            said: None,
            before: None,
            befores: Vec::new(),
            since: 0.0,
            read_from: Duration::ZERO,
            set_to: Vec::new(),
            set_at: Duration::ZERO,
        }
    }

    /// The beat.
    pub fn beat(&self) -> &Beat {
        &self.lesson.beats[self.beat]
    }

    /// It shows from now on: after so many passages, at that time.
    pub fn show(&mut self, passages: f64, now: Duration) {
        self.phase = TourPhase::Shows;
        self.since = passages;
        self.read_from = now;
    }

    /// It tells what was found, from that time on.
    pub fn tell(&mut self, found: FoundAnswer, now: Duration) {
        self.phase = TourPhase::Tells(found);
        self.read_from = now;
    }

    /// Whether all of it was shown at so many passages.
    pub fn is_shown(&self, passages: f64) -> bool {
        passages - self.since >= self.beat().passages
    }

    /// Whether so many passages are far more than it takes.
    pub fn is_overdue(&self, passages: f64) -> bool {
        /// Times its own: averages that have not settled by then are not waited for.
        const PATIENCE: f64 = 6.0;
        passages - self.since >= PATIENCE * self.beat().passages
    }

    /// Whether its words have been read.
    pub fn is_read(&self, now: Duration) -> bool {
        let beat = self.beat();
        let text = match (self.phase, &beat.question) {
            (TourPhase::Tells(_), Some(question)) => &question.because,
            _ => &beat.caption,
        };
        let seconds = 2.0 + text.chars().count() as f64 / LETTERS_PER_S;
        now >= self.read_from + Duration::from_secs_f64(seconds)
    }

    /// Whether another beat follows.
    pub fn goes_on(&self) -> bool {
        self.beat + 1 < self.lesson.beats.len()
    }
}
