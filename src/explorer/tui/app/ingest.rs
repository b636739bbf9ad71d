//! What a new frame changes: dials, ranges, traces, history, the anchor of the estimate, the tour.

use std::sync::Arc;
use std::time::Duration;

use super::curve::conditions;
use super::data::{AxisEnds, Effect, LifeSample, SettledMean, Trouble};
use super::state::App;
use crate::tui::dial::Dial;
use crate::tui::kinds::RunPace;
use crate::tui::units::nice_ceiling;
use asperity_engine::physics::estimate::OperatingPoint;
use asperity_engine::sim::{Frame, MaterialPoint, Stage};
use asperity_picture::Scope;
use asperity_session::sweep::{CaseStart, Found};

/// Memory that past frames may take, bytes.
const PAST_BYTES: usize = 48 << 20;
/// Past frames kept at most, whatever their size.
const PAST_FRAMES: usize = 96;
/// Points of the life's history.
const HISTORY: usize = 1024;
/// Wall time over which the speed of the run is averaged.
const RATE_WINDOW: Duration = Duration::from_secs(2);
/// How long a step that did not converge is told: single ones would flicker.
const TROUBLE_SHOWN: Duration = Duration::from_secs(3);
/// How long a knob that was set here is not overruled by what a frame says of its target.
const GRACE: Duration = Duration::from_millis(1500);

impl App {
    /// Takes a newer frame.
    pub fn take_frame(&mut self, frame: Arc<Frame>) -> Vec<Effect> {
        if self
            .run
            .frames
            .back()
            .is_some_and(|last| last.stage != frame.stage)
        {
            // What the start-up reached is no measure of the passage.
            self.run.axis_ends = AxisEnds::default();
            self.run.step_times.clear();
        }
        if let Some(last) = self.run.frames.back()
            && frame.passages < last.passages
        {
            self.run.passages_before += last.passages;
        }
        self.take_knobs(&frame);
        self.take_ranges(&frame);
        grow(&mut self.run.axis_ends, &frame);
        if let Some(point) = &frame.material_point
            && self.replay.playing.is_none()
        {
            self.replay.trace.push(point, frame.a_m);
        }
        self.take_rate(&frame);
        if !frame.metrics.converged {
            let trouble = Trouble::of(&frame, self.run.setup.scene.numerics.tolerance);
            self.run.trouble = Some((trouble, self.now + TROUBLE_SHOWN));
        }
        self.take_life(&frame);
        self.take_age(&frame);
        self.take_film(&frame);
        self.run.kymograph.push(&frame);
        self.keep(frame);
        self.refresh_estimate();
        self.keep_frozen_alike();
        self.tour_on()
    }

    /// Takes the material points of all steps since the last frame: the screen is slower than the run, and a
    /// crossing that is sampled by the screen would lose its teeth.
    pub fn take_points(&mut self, points: &[MaterialPoint], a_m: f64) {
        if self.replay.playing.is_none() {
            for point in points {
                self.replay.trace.push(point, a_m);
            }
        }
    }

    /// What went wrong with a step of the last seconds, or with the one that is looked at.
    pub fn trouble(&self) -> Option<Trouble> {
        let tolerance = self.run.setup.scene.numerics.tolerance;
        let shown = self.frame().filter(|frame| !frame.metrics.converged);
        let shown = shown.map(|frame| Trouble::of(frame, tolerance));
        let recent = self.run.trouble.filter(|(_, until)| self.now < *until);
        shown.or_else(|| {
            recent
                .filter(|_| self.run.frames_back == 0)
                .map(|(trouble, _)| trouble)
        })
    }

    fn take_knobs(&mut self, frame: &Frame) {
        for (dial, set_at) in self.choice.dials.iter_mut().zip(&self.choice.set_at) {
            let quantity = dial.knob.quantity();
            dial.now = quantity.number(frame).unwrap_or(dial.now);
            let ours = set_at.is_some_and(|at| self.now < at + GRACE);
            let target = dial.knob.target_quantity();
            match target.and_then(|target| target.number(frame)) {
                // A scripted event moved it, or the run refused what was asked.
                Some(target) if !ours => dial.target = target,
                None if set_at.is_none() => dial.target = dial.now,
                _ => {}
            }
        }
    }

    /// Ranges are those of the passage as it begins, as in recordings; a start-up has no measure of its own.
    fn take_ranges(&mut self, frame: &Frame) {
        let scene = Some(self.run.setup.scene.as_ref());
        let began = self.run.frames.back().map(|last| last.stage);
        let scope = match &mut self.run.scope {
            Some(scope) if began == Some(Stage::Passage) && frame.stage == Stage::Passage => scope,
            scope => scope.insert(Scope::of(scene, frame)),
        };
        scope.grows(scene, &frame.metrics);
    }

    fn take_rate(&mut self, frame: &Frame) {
        if self.run.pace == RunPace::Paused {
            // A pause is no part of the run's pace.
            self.run.step_times.clear();
            return;
        }
        self.run.step_times.push_back((self.now, frame.step));
        while self.run.step_times.len() > 2
            && self
                .run
                .step_times
                .get(1)
                .is_some_and(|(at, _)| *at + RATE_WINDOW < self.now)
        {
            self.run.step_times.pop_front();
        }
    }

    fn take_life(&mut self, frame: &Frame) {
        let metrics = &frame.metrics;
        let Some(life) = metrics.life else { return };
        let is_number = life.life_relative.is_finite() && life.life_relative > 0.0;
        if frame.stage == Stage::StartUp || !is_number {
            return;
        }
        if self.lives.history.len() == HISTORY {
            self.lives.history.pop_front();
        }
        self.lives.history.push_back(LifeSample {
            passages: frame.passages,
            life_relative: life.life_relative,
        });
        if !life.settled || self.choice.dials.iter().any(Dial::is_moving) {
            self.lives.friction = SettledMean::default();
            return;
        }
        let friction = self.lives.friction.add(metrics.friction_coefficient);
        self.keep_point(Found {
            at: conditions(metrics),
            choice: 0,
            began: CaseStart::Warm,
            life: Some([
                life.life_relative_low,
                life.life_relative,
                life.life_relative_high,
            ]),
            other: self.other_life(),
            friction,
            smooth: Some(life.life_smooth).filter(|smooth| *smooth > 0.0),
            lambda: metrics.lambda_ratio,
        });
        let at = OperatingPoint {
            slide_roll: metrics.slide_roll,
            load_n: metrics.load_n,
            amplitude_1_m: metrics.amplitude_1_m,
            amplitude_2_m: metrics.amplitude_2_m,
            entrainment_m_s: metrics.entrainment_m_s,
        };
        self.drop_anchor(&at, &life);
    }

    /// A jump that is new, or the last one again with better heights; fewer cycles are those of another mesh, from the start.
    fn take_age(&mut self, frame: &Frame) {
        let Some(age) = frame.age else { return };
        let ages = &mut self.lives.ages;
        ages.retain(|known| known.cycles < age.cycles * (1.0 - 1e-9));
        ages.push(age);
    }

    fn keep(&mut self, frame: Arc<Frame>) {
        let fields = 5 * 4 + 1;
        let bytes = (frame.nx * frame.ny * fields).max(1);
        let most = (PAST_BYTES / bytes).clamp(2, PAST_FRAMES);
        self.run.frames.push_back(frame);
        while self.run.frames.len() > most {
            self.run.frames.pop_front();
        }
        // The past stays where it is while one looks at it.
        if self.run.frames_back > 0 {
            self.run.frames_back = (self.run.frames_back + 1).min(self.run.frames.len() - 1);
        }
    }
}

fn grow(ends: &mut AxisEnds, frame: &Frame) {
    let grow = |old: &mut f64, value: f64| {
        if value.is_finite() && value > *old {
            *old = nice_ceiling(value);
        }
    };
    let maximum = |field: &[f32]| {
        let most = field
            .iter()
            .fold(0.0_f32, |most, value| most.max(value.abs()));
        f64::from(most)
    };
    grow(&mut ends.pressure_pa, frame.p_hertz_pa);
    grow(&mut ends.pressure_pa, maximum(&frame.pressure_pa));
    grow(&mut ends.film_m, film_inside(frame));
}

/// The maximum film on the centre line inside the contact: outside it the gap grows without end.
fn film_inside(frame: &Frame) -> f64 {
    let row = frame.ny / 2 * frame.nx;
    let Some(line) = frame.film_m.get(row..row + frame.nx) else {
        return 0.0;
    };
    let inside = |i: usize| (frame.x_min_m + i as f64 * frame.dx_m).abs() <= 0.9 * frame.a_m;
    let most = line
        .iter()
        .enumerate()
        .filter(|(i, _)| inside(*i))
        .fold(0.0_f32, |most, (_, h)| most.max(*h));
    1.1 * f64::from(most)
}
