//! What the loop tells others: frames, events, status, failures.

use super::Driver;
use crate::run::clock::Clock;
use crate::run::outcome::End;
use crate::run::shared::{Ending, lock};
use crate::run::watcher::Watcher;
use asperity_engine::observe::{ObserveError, ObserverReport, RunContext, RunEvent, RunEventKind};
use asperity_engine::sim::{Simulation, Stage};

impl Driver {
    pub(in crate::run) fn begin_outputs(&mut self, context: &RunContext) {
        for index in 0..self.watchers.len() {
            let begun = self.watchers[index].begin(context);
            self.note_output(begun);
        }
    }

    /// Gives the step to the screen, and to the outputs if it belongs to the results.
    pub(super) fn hand_out(&mut self, sim: &Simulation) {
        let frame = self.pool.fill(|frame| sim.fill(frame));
        if sim.stage() == Stage::Passage {
            self.passage_began.get_or_insert_with(Clock::start);
            for index in 0..self.watchers.len() {
                let written = self.watchers[index].frame(&frame);
                self.note_output(written);
            }
        }
        if let Some(gather) = &mut self.gather
            && let Some(settled) = gather.take(&frame, || Some(sim.save()))
        {
            lock(&self.shared).settled = Some(settled);
        }
        self.latest.put(frame);
    }

    pub(super) fn announce(&mut self, sim: &Simulation, kind: RunEventKind) {
        let event = RunEvent {
            step: sim.passage_steps(),
            time_s: sim.time_s(),
            kind,
        };
        for index in 0..self.watchers.len() {
            let written = self.watchers[index].event(&event);
            self.note_output(written);
        }
    }

    pub(super) fn note_output(&mut self, result: Result<(), ObserveError>) {
        if let Err(error) = result {
            self.output_errors.push(error);
        }
    }

    pub(super) fn must_end_for_outputs(&self) -> bool {
        self.ending != Ending::OnStop && !self.output_errors.is_empty()
    }

    pub(super) fn tell_status(&self, sim: &Simulation) {
        let mut shared = lock(&self.shared);
        let status = &mut shared.status;
        status.stage = sim.stage();
        status.progress = sim.progress();
        status.steps = sim.passage_steps();
        status.n_unconverged = self.n_unconverged;
        status.outputs.clear();
        status
            .outputs
            .extend(self.watchers.iter().map(Watcher::status));
    }

    pub(in crate::run) fn tell_failure(&self, end: &End) {
        let failure = match end {
            End::Stalled(error) => error.to_string(),
            End::NotStarted(error) => error.to_string(),
            End::OutputFailed => "an output failed".to_owned(),
            End::Done | End::Stopped => return,
        };
        lock(&self.shared).status.failure = Some(failure);
    }

    pub(super) fn finish_outputs(&mut self) -> Vec<ObserverReport> {
        let mut reports = Vec::new();
        for watcher in &mut self.watchers {
            match watcher.finish() {
                Ok(report) => reports.extend(report),
                Err(error) => self.output_errors.push(error),
            }
        }
        reports
    }
}
