//! STAND-IN, to be replaced by the solver: Hertz pressure with the scene's waves riding on it, so that the
//! loop, the command line and the screen can be built and tested. None of its numbers is a result.

use std::f64::consts::TAU;

use super::{Frame, Knob, Metrics, SimError, Stage, Stats, StepError, Summary};
use crate::plan::Plan;
use crate::scene::{Scene, Surface};

/// The simulation of one scene.
#[derive(Debug)]
pub struct Simulation {
    plan: Plan,
    surfaces: [Surface; 2],
    metrics: Metrics,
    stats: Stats,
    step: u64,
    start_up_left: u64,
    time_s: f64,
    /// Way that each body has moved, m.
    way_m: [f64; 2],
}

const START_UP_STEPS: u64 = 8;

impl Simulation {
    /// Makes all memory for `scene` by `plan`; `threads` workers of its own.
    ///
    /// # Errors
    /// [`SimError::Threads`] when the workers cannot be started.
    pub fn new(scene: &Scene, plan: Plan, threads: usize) -> Result<Self, SimError> {
        if threads == 0 {
            return Err(SimError::Threads {
                threads,
                reason: "at least one is needed".to_owned(),
            });
        }
        let film = plan.film;
        let metrics = Metrics {
            converged: true,
            slide_roll: scene.motion.slide_roll,
            slide_roll_target: scene.motion.slide_roll,
            entrainment_m_s: scene.motion.entrainment_m_s,
            load_n: plan.force_n,
            load_target_n: plan.force_n,
            amplitude_1_m: scene.body_1.surface.amplitude_m(),
            amplitude_2_m: scene.body_2.surface.amplitude_m(),
            p_max_pa: plan.hertz.p_max_pa,
            h_central_m: film.map_or(0.0, |film| film.central_m),
            h_min_m: film.map_or(0.0, |film| film.hamrock_dowson_minimum_m),
            ..Metrics::default()
        };
        Ok(Self {
            plan,
            surfaces: [scene.body_1.surface.clone(), scene.body_2.surface.clone()],
            metrics,
            stats: Stats::default(),
            step: 0,
            start_up_left: START_UP_STEPS,
            time_s: 0.0,
            way_m: [0.0; 2],
        })
    }

    /// One step, of the start-up first and then of the passage.
    ///
    /// # Errors
    /// [`StepError`] when the step failed; nothing of it was kept.
    pub fn step(&mut self) -> Result<(), StepError> {
        self.stats.steps += 1;
        if self.start_up_left > 0 {
            self.start_up_left -= 1;
            return Ok(());
        }
        let u = self.metrics.entrainment_m_s;
        let s = self.metrics.slide_roll;
        self.time_s += self.plan.dt_s;
        self.way_m[0] += u * (1.0 - 0.5 * s) * self.plan.dt_s;
        self.way_m[1] += u * (1.0 + 0.5 * s) * self.plan.dt_s;
        self.step += 1;
        Ok(())
    }

    /// Moves a knob's target.
    ///
    /// # Errors
    /// [`SimError::Knob`] when the value is out of range.
    pub fn set(&mut self, knob: Knob, value: f64) -> Result<(), SimError> {
        let allowed = crate::scene::keys::find(knob.key()).filter(|key| match key.kind {
            crate::scene::keys::Kind::Number(min, max) => !(min..=max).contains(&value),
            _ => false,
        });
        if let Some(key) = allowed {
            return Err(SimError::Knob {
                key: knob.key(),
                value,
                allowed: key.allowed(),
            });
        }
        match knob {
            Knob::SlideRoll => {
                self.metrics.slide_roll = value;
                self.metrics.slide_roll_target = value;
            }
            Knob::ForceN => {
                self.metrics.load_n = value;
                self.metrics.load_target_n = value;
            }
            Knob::Amplitude1M => self.metrics.amplitude_1_m = value,
            Knob::Amplitude2M => self.metrics.amplitude_2_m = value,
            Knob::EntrainmentMS => self.metrics.entrainment_m_s = value,
        }
        Ok(())
    }

    /// Part of the run that the last step belongs to.
    pub fn stage(&self) -> Stage {
        if self.start_up_left > 0 || self.step == 0 {
            Stage::StartUp
        } else {
            Stage::Passage
        }
    }

    /// How much of the run is done, 0 to 1, start-up included.
    pub fn progress(&self) -> f64 {
        let all = (START_UP_STEPS + self.plan.steps) as f64;
        ((START_UP_STEPS - self.start_up_left + self.step) as f64 / all).min(1.0)
    }

    /// Time steps since the start-up.
    pub fn passage_steps(&self) -> u64 {
        self.step
    }

    /// Simulated time since the start-up, s.
    pub fn time_s(&self) -> f64 {
        self.time_s
    }

    /// Whether the passages that the scene asks for are done.
    pub fn is_done(&self) -> bool {
        self.step >= self.plan.steps
    }

    /// Scalars of the last step.
    pub fn metrics(&self) -> &Metrics {
        &self.metrics
    }

    /// Work done so far.
    pub fn stats(&self) -> &Stats {
        &self.stats
    }

    /// Result so far.
    pub fn summary(&self) -> Summary {
        Summary {
            converged: true,
            steps: self.step,
            a_m: self.plan.hertz.a_m,
            p_hertz_pa: self.plan.hertz.p_max_pa,
            h_central_m: self.metrics.h_central_m,
            h_min_m: self.metrics.h_min_m,
            p_max_pa: self.metrics.p_max_pa,
            load_n: self.metrics.load_n,
            counters: self.stats,
            ..Summary::default()
        }
    }

    /// Writes the last step's fields and scalars into `frame`.
    pub fn fill(&self, frame: &mut Frame) {
        let plan = &self.plan;
        let n = plan.domain.nodes;
        frame.step = self.step;
        frame.time_s = self.time_s;
        frame.stage = self.stage();
        frame.passages = self.step as f64 / plan.steps_per_passage as f64;
        (frame.nx, frame.ny) = (n, n);
        frame.x_min_m = plan.domain.x_min_a * plan.hertz.a_m;
        frame.dx_m = plan.dx_m;
        frame.y_min_m = -plan.domain.y_half_b * plan.hertz.b_m;
        frame.dy_m = plan.dy_m;
        frame.a_m = plan.hertz.a_m;
        frame.b_m = plan.hertz.b_m;
        frame.p_hertz_pa = plan.hertz.p_max_pa;
        for field in [
            &mut frame.pressure_pa,
            &mut frame.film_m,
            &mut frame.roughness_1_m,
            &mut frame.roughness_2_m,
            &mut frame.traction_pa,
        ] {
            field.resize(n * n, 0.0);
        }
        frame.contact.resize(n * n, 0);
        for j in 0..n {
            let y = frame.y_min_m + j as f64 * plan.dy_m;
            for i in 0..n {
                let x = frame.x_min_m + i as f64 * plan.dx_m;
                let at = j * n + i;
                let waves = [self.height(0, x, y), self.height(1, x, y)];
                let ripple = 1.0 + 0.3 * (waves[0] + waves[1]) * 1e6;
                let pressure = plan.hertz.pressure_pa(x, y) * ripple;
                frame.pressure_pa[at] = pressure as f32;
                frame.film_m[at] = (self.metrics.h_central_m - waves[0] - waves[1]).max(0.0) as f32;
                frame.roughness_1_m[at] = waves[0] as f32;
                frame.roughness_2_m[at] = waves[1] as f32;
                frame.traction_pa[at] = (0.05 * pressure) as f32;
            }
        }
        frame.metrics.clone_from(&self.metrics);
    }

    fn height(&self, body: usize, x: f64, y: f64) -> f64 {
        let Surface::Sinusoid {
            wavelength_x_m,
            wavelength_y_m,
            ..
        } = self.surfaces[body]
        else {
            return 0.0;
        };
        let amplitude = [self.metrics.amplitude_1_m, self.metrics.amplitude_2_m][body];
        amplitude
            * (TAU * (x - self.way_m[body]) / wavelength_x_m).cos()
            * (TAU * y / wavelength_y_m).cos()
    }
}
