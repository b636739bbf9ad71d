//! What the loop needs of a simulation. One implementation runs; tests put in others that fail on purpose.

use crate::sim::{
    Follow, Frame, Knob, Metrics, SimError, Simulation, Stage, State, Stats, StepError, Summary,
};

/// A simulation as the loop sees it.
pub trait Stepper {
    /// Makes one time step, of the start-up first and then of the passage.
    ///
    /// # Errors
    /// When the step failed; nothing of it was kept.
    fn step(&mut self) -> Result<(), StepError>;
    /// Does many steps where making them costs least.
    fn inside<R: Send>(&mut self, work: impl FnOnce(&mut Self) -> R + Send) -> R
    where
        Self: Sized,
    {
        work(self)
    }
    /// Moves a knob's target.
    ///
    /// # Errors
    /// When the value is out of range.
    fn set(&mut self, knob: Knob, value: f64) -> Result<(), SimError>;
    /// Shows another material point.
    fn show_point(&mut self, _follow: Follow) {}
    /// Writes the last step into a frame.
    fn fill(&self, frame: &mut Frame);
    /// Scalars of the last step.
    fn metrics(&self) -> &Metrics;
    /// Part of the run that the last step belongs to.
    fn stage(&self) -> Stage;
    /// How much of the run is done, 0 to 1.
    fn progress(&self) -> f64;
    /// Time steps since the start-up.
    fn passage_steps(&self) -> u64;
    /// Simulated time since the start-up, s.
    fn time_s(&self) -> f64;
    /// Whether the passages asked for are done.
    fn is_done(&self) -> bool;
    /// Result so far.
    fn summary(&self) -> Summary;
    /// Work done so far.
    fn stats(&self) -> Stats {
        Stats::default()
    }
    /// What a restart needs; `None`: it cannot go on later.
    fn save(&self) -> Option<State> {
        None
    }
}

impl Stepper for Simulation {
    fn step(&mut self) -> Result<(), StepError> {
        self.step()
    }
    fn inside<R: Send>(&mut self, work: impl FnOnce(&mut Self) -> R + Send) -> R {
        self.inside(work)
    }
    fn set(&mut self, knob: Knob, value: f64) -> Result<(), SimError> {
        self.set(knob, value)
    }
    fn show_point(&mut self, follow: Follow) {
        self.show_point(follow);
    }
    fn fill(&self, frame: &mut Frame) {
        self.fill(frame);
    }
    fn metrics(&self) -> &Metrics {
        self.metrics()
    }
    fn stage(&self) -> Stage {
        self.stage()
    }
    fn progress(&self) -> f64 {
        self.progress()
    }
    fn passage_steps(&self) -> u64 {
        self.passage_steps()
    }
    fn time_s(&self) -> f64 {
        self.time_s()
    }
    fn is_done(&self) -> bool {
        self.is_done()
    }
    fn summary(&self) -> Summary {
        self.summary()
    }
    fn stats(&self) -> Stats {
        *self.stats()
    }
    fn save(&self) -> Option<State> {
        Some(self.save())
    }
}
