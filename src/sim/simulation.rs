//! The simulation of one scene: start-up from Hertz, development of the rough contact, passage.
//!
//! ```text
//! smooth    S = 0, frictionless, from Hertz on 65², marched to steady, refined to the scene's grid
//! reference the smooth pressure's life integral
//! develop   sliding and roughness ramp up, the contact is flushed once
//! passage   every number counts
//! ```

use rayon::{ThreadPool, ThreadPoolBuilder};

use super::door::Door;
use super::drive::Drive;
use super::life_stage::LifeStage;
use super::measure::{Measured, measure};
use super::motion::Motion;
use super::stepping::{Attempted, advance};
use super::stress_stage::StressStage;
use super::terrain::Terrain;
use super::{Frame, Knob, Metrics, SimError, Stage, Stats, StepError, Summary};
use crate::math::grid::{Grid, Symmetry};
use crate::plan::{March as Marching, Plan};
use crate::scene::Scene;
use crate::solve::march::{Flow, March, Shape};
use crate::solve::newton::Tolerance;
use crate::solve::traction::{FilmShear, TractionLaw};

/// Nodes per side of the first grid.
const COARSEST: usize = 65;
/// Time (a/U) to ramp sliding and roughness and to flush the contact once.
const DEVELOP: f64 = 4.0;

/// Where the run is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Phase {
    /// Smooth, with this many steps to go on the present grid.
    Smooth { left: u64 },
    /// Sliding and roughness come up.
    Develop { left: u64 },
    /// The passage.
    Passage,
}

/// The simulation of one scene.
pub struct Simulation {
    pub(super) plan: Plan,
    pub(super) door: Door,
    pub(super) march: March,
    pub(super) terrain: Terrain,
    pub(super) drive: Drive,
    pub(super) motion: Motion,
    pub(super) stress: Option<StressStage>,
    pub(super) traction: Vec<f64>,
    life: Option<LifeStage>,
    law: TractionLaw,
    shape: Shape,
    flow: Flow,
    tolerance: Tolerance,
    pool: ThreadPool,
    phase: Phase,
    wanted: Drive,
    pub(super) metrics: Metrics,
    stats: Stats,
    totals: super::totals::Totals,
    smooth_film: f64,
    composite: [f64; 2],
    pub(super) step: u64,
    pub(super) time_s: f64,
    start_up_steps: (u64, u64),
}

impl Simulation {
    /// Makes all memory for `scene` by `plan`; `threads` workers of its own.
    ///
    /// # Errors
    /// [`SimError`] when the workers cannot be started or the stress engine refuses the plan.
    pub fn new(scene: &Scene, plan: Plan, threads: usize) -> Result<Self, SimError> {
        let pool = ThreadPoolBuilder::new()
            .num_threads(threads)
            .thread_name(|i| format!("asperity-{i}"))
            .build()
            .map_err(|error| SimError::Threads {
                threads,
                reason: error.to_string(),
            })?;
        let door = Door::new(scene);
        let flow = if scene.lubricant.is_some() {
            Flow::Film
        } else {
            Flow::Dry
        };
        let shape = Shape {
            kappa: door.kappa,
            curvature_y: door.curvature_y,
            b_over_a: door.b_over_a,
        };
        let first = COARSEST.min(plan.domain.nodes);
        let grid = grid_of(&plan, first, door.b_over_a);
        let film = plan.film.map_or(0.0, |film| film.central);
        let nodes = scene.time.step_nodes;
        let march = pool.install(|| March::from_hertz(grid, &shape, film, nodes, flow));
        let fine = grid_of(&plan, plan.domain.nodes, door.b_over_a);
        let stress = match &plan.stress {
            Some(stress) => Some(
                pool.install(|| {
                    let depths = (stress.depths, stress.depth_max_m / door.a_m);
                    let measure = scene
                        .stress
                        .as_ref()
                        .map_or(crate::scene::StressMeasure::VonMises, |s| s.measure);
                    StressStage::new(&fine, scene.body_1.poisson, depths, measure)
                })
                .map_err(|error| SimError::Stress(error.to_string()))?,
            ),
            None => None,
        };
        let life = scene.life.as_ref().zip(plan.life).map(|(life, plan)| {
            let phases = plan.phases_per_passage.max(1) as usize;
            LifeStage::new(life.stress_exponent, life.weibull_slope, phases)
        });
        let wanted = Drive::new(|knob| initial(scene, &plan, knob));
        let mut drive = wanted.clone();
        for knob in [Knob::SlideRoll, Knob::Amplitude1M, Knob::Amplitude2M] {
            drive.jump(knob, 0.0);
        }
        let tolerance = Tolerance {
            pressure: scene.numerics.tolerance,
            mass: if flow == Flow::Film {
                0.1 * scene.numerics.tolerance
            } else {
                f64::INFINITY
            },
            load: 1e-5,
            max_iterations: scene.numerics.max_iterations,
        };
        let terrain = Terrain::new(&fine, scene.surfaces(), door.a_m);
        let law = traction_law(scene, &door);
        let mut motion = Motion::new(nodes);
        motion.shear_rate = scene.lubricant.as_ref().map_or(0.0, |oil| {
            oil.viscosity_pa_s / (door.p_hertz_pa * door.film_m)
        });
        let composite = [0, 1].map(|body| {
            let surface = scene.surfaces()[body];
            if surface.amplitude_m() > 0.0 {
                surface.rq_m() / surface.amplitude_m()
            } else {
                0.0
            }
        });
        let mut this = Self {
            traction: vec![0.0; fine.len()],
            plan,
            door,
            march,
            terrain,
            drive,
            motion,
            stress,
            life,
            law,
            shape,
            flow,
            tolerance,
            pool,
            phase: Phase::Smooth { left: 0 },
            wanted,
            metrics: Metrics::default(),
            stats: Stats::default(),
            totals: super::totals::Totals::default(),
            smooth_film: 0.0,
            composite,
            step: 0,
            time_s: 0.0,
            start_up_steps: (0, 1),
        };
        this.phase = Phase::Smooth {
            left: this.smooth_steps(first),
        };
        this.start_up_steps.1 = this.all_start_up_steps(first);
        this.publish(&Attempted::default());
        Ok(this)
    }

    /// One step, of the start-up first and then of the passage.
    ///
    /// # Errors
    /// [`StepError`] when the step failed; nothing of it was kept.
    pub fn step(&mut self) -> Result<(), StepError> {
        self.stats.steps += 1;
        match self.phase {
            Phase::Smooth { left: 0 } => self.refine_or_develop(),
            Phase::Smooth { left } => {
                self.advance()?;
                self.phase = Phase::Smooth { left: left - 1 };
                self.start_up_steps.0 += 1;
                Ok(())
            }
            Phase::Develop { left: 0 } => {
                self.phase = Phase::Passage;
                self.time_s = 0.0;
                if let Some(life) = &mut self.life {
                    life.forget();
                }
                self.passage_step()
            }
            Phase::Develop { left } => {
                self.advance()?;
                self.phase = Phase::Develop { left: left - 1 };
                self.start_up_steps.0 += 1;
                Ok(())
            }
            Phase::Passage => self.passage_step(),
        }
    }

    fn passage_step(&mut self) -> Result<(), StepError> {
        let held = matches!(self.plan.march, Marching::Steady { .. }) && self.motion.is_flushed();
        if held {
            self.time_s += self.motion.dt_s(&self.march.grid, &self.door, &self.drive);
            self.watch(&Attempted::held(&self.metrics));
        } else {
            self.advance()?;
        }
        self.step += 1;
        self.totals.push(&self.metrics, self.plan.steps_per_passage);
        Ok(())
    }

    /// One time step: solved, committed, measured.
    fn advance(&mut self) -> Result<(), StepError> {
        let attempted = self.pool.install(|| {
            advance(
                &mut self.march,
                &mut self.terrain,
                &mut self.drive,
                &mut self.motion,
                &self.door,
                self.tolerance,
            )
        });
        self.stats.newton_iterations += u64::from(attempted.newton);
        self.stats.linear_iterations += u64::from(attempted.linear);
        self.stats.ffts += attempted.ffts;
        self.stats.retries += u64::from(attempted.retries);
        if let Some(error) = attempted.fatal(self.time_s, self.tolerance.pressure) {
            return Err(error);
        }
        self.time_s += attempted.dt_s;
        self.watch(&attempted);
        Ok(())
    }

    /// Traction, stress, life and scalars of the committed step.
    fn watch(&mut self, attempted: &Attempted) {
        let on_fine = self.march.grid.nx == self.plan.domain.nodes;
        if on_fine && !matches!(self.phase, Phase::Smooth { .. }) {
            self.measure_stress();
        }
        self.publish(attempted);
    }

    fn measure_stress(&mut self) {
        let measured = self.measure();
        let Some(stress) = &mut self.stress else {
            return;
        };
        let (p, q) = (&self.march.state.pressure, &self.traction);
        let every = self
            .plan
            .life
            .map_or(u64::MAX, |life| life.volume_every_steps);
        self.pool.install(|| {
            stress.slice(p, q, measured.friction);
            if let Some(life) = &mut self.life
                && self.phase == Phase::Passage
                && self.step.is_multiple_of(every)
            {
                life.push(&stress.volume(life.exponent));
                self.stats.stress_volumes += 1;
            }
        });
    }

    fn measure(&mut self) -> Measured {
        let s = self.drive.get(Knob::SlideRoll).now;
        let u = self.drive.get(Knob::EntrainmentMS).now;
        let scale = (self.drive.get(Knob::ForceN).now / self.plan.force_n).cbrt();
        self.law.direction = if s == 0.0 { 0.0 } else { s.signum() };
        if let Some(film) = &mut self.law.film {
            film.rate = self.motion.shear_rate * (s * u).abs();
        }
        let state = &self.march.state;
        self.traction.resize(self.march.grid.len(), 0.0);
        measure(
            &self.march.grid,
            &self.law,
            &state.pressure,
            &state.film,
            (scale, scale * self.door.b_over_a),
            &mut self.traction,
        )
    }

    /// The next finer grid, or the reference and the development.
    fn refine_or_develop(&mut self) -> Result<(), StepError> {
        let nx = self.march.grid.nx;
        if nx < self.plan.domain.nodes {
            let next = 2 * (nx - 1) + 1;
            let grid = grid_of(&self.plan, next, self.door.b_over_a);
            let nodes = self.motion.nodes;
            self.march = self
                .pool
                .install(|| March::refined(&self.march, grid, &self.shape, nodes, self.flow));
            self.phase = Phase::Smooth {
                left: self.smooth_steps(next),
            };
            return self.step_within();
        }
        let measured = self.measure();
        self.smooth_film = measured.h_central;
        if let (Some(stress), Some(life)) = (&mut self.stress, &mut self.life) {
            let (p, q) = (&self.march.state.pressure, &self.traction);
            self.pool.install(|| {
                stress.slice(p, q, 0.0);
                life.set_reference(&stress.volume(life.exponent));
            });
        }
        for knob in Knob::ALL {
            self.drive.aim(knob, self.wanted.get(knob).target);
        }
        let developing = self.terrain.is_rough(0)
            || self.terrain.is_rough(1)
            || self.wanted.get(Knob::SlideRoll).target != 0.0;
        let left = if developing {
            self.steps_of(DEVELOP)
        } else {
            0
        };
        self.motion.flush();
        if developing {
            self.motion.disturb(DEVELOP);
        }
        self.phase = Phase::Develop { left };
        self.step_within()
    }

    fn step_within(&mut self) -> Result<(), StepError> {
        self.stats.steps -= 1;
        self.step()
    }

    fn steps_of(&self, time: f64) -> u64 {
        (time / (self.motion.nodes * self.march.grid.dx)).ceil() as u64
    }

    /// Smooth steps on a grid of `nodes` per side: the first grid is flushed from inlet to outlet, the
    /// finer ones lose the error of interpolation. Without a film one solve is enough.
    fn smooth_steps(&self, nodes: usize) -> u64 {
        if self.flow == Flow::Dry {
            return 2;
        }
        let length = self.plan.domain.x_max_a - self.plan.domain.x_min_a;
        let share = if nodes == COARSEST.min(self.plan.domain.nodes) {
            1.0
        } else {
            0.75
        };
        let dx = length / (nodes - 1) as f64;
        (share * length / (self.motion.nodes * dx)).ceil() as u64
    }

    fn all_start_up_steps(&self, first: usize) -> u64 {
        let (mut nodes, mut total) = (first, 0);
        while nodes <= self.plan.domain.nodes {
            total += self.smooth_steps(nodes);
            nodes = 2 * (nodes - 1) + 1;
        }
        let dx = self.plan.domain.dx_a();
        total + (DEVELOP / (self.motion.nodes * dx)).ceil() as u64
    }

    /// Moves a knob's target.
    ///
    /// # Errors
    /// [`SimError::Knob`] when the value is out of range or the scene has nothing for that knob to turn.
    pub fn set(&mut self, knob: Knob, value: f64) -> Result<(), SimError> {
        let refuse = |allowed: String| SimError::Knob {
            key: knob.key(),
            value,
            allowed,
        };
        if let Some(key) = crate::scene::keys::find(knob.key())
            && let crate::scene::keys::Kind::Number(min, max) = key.kind
            && !(min..=max).contains(&value)
        {
            return Err(refuse(key.allowed()));
        }
        let body = match knob {
            Knob::Amplitude1M => Some(0),
            Knob::Amplitude2M => Some(1),
            _ => None,
        };
        if body.is_some_and(|body| !self.terrain.is_rough(body)) {
            return Err(refuse(
                "this body is smooth: give it a surface in the scene".to_owned(),
            ));
        }
        self.wanted.aim(knob, value);
        if !matches!(self.phase, Phase::Smooth { .. }) {
            self.drive.aim(knob, value);
            self.motion.disturb(DEVELOP);
            if let Some(life) = &mut self.life {
                life.unsettle();
            }
        }
        Ok(())
    }

    /// Part of the run that the last step belongs to.
    pub fn stage(&self) -> Stage {
        if self.phase == Phase::Passage && self.step > 0 {
            Stage::Passage
        } else {
            Stage::StartUp
        }
    }

    /// How much of the run is done, 0 to 1, start-up included.
    pub fn progress(&self) -> f64 {
        let (done, all) = self.start_up_steps;
        ((done + self.step) as f64 / (all + self.plan.steps).max(1) as f64).min(1.0)
    }

    /// Time steps since the start-up.
    pub fn passage_steps(&self) -> u64 {
        self.step
    }

    /// Simulated time since the start-up, s.
    pub fn time_s(&self) -> f64 {
        if self.phase == Phase::Passage {
            self.time_s
        } else {
            0.0
        }
    }

    /// Whether the passages that the scene asks for are done.
    pub fn is_done(&self) -> bool {
        self.phase == Phase::Passage && self.step >= self.plan.steps
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
        super::totals::summary(self, &self.totals, self.life_estimate(), self.stats)
    }

    pub(super) fn contact_film_m(&self) -> f64 {
        self.door.m_from_h(self.law.contact_film)
    }

    fn life_estimate(&self) -> Option<super::LifeEstimate> {
        self.life
            .as_ref()?
            .estimate([self.metrics.n_body_1, self.metrics.n_body_2])
    }

    /// Writes the last step's fields and scalars into `frame`.
    pub fn fill(&self, frame: &mut Frame) {
        super::fill::fill(self, frame);
    }

    fn publish(&mut self, attempted: &Attempted) {
        let measured = self.measure();
        let has_stress = self.stage_has_stress();
        let door = &self.door;
        let m = &mut self.metrics;
        m.converged = attempted.converged;
        m.residual = attempted.residual;
        m.newton_iterations = attempted.newton;
        m.linear_iterations = attempted.linear;
        m.retries = attempted.retries;
        m.mass_error = attempted.mass_error;
        m.load_error = attempted.load_error;
        let (s, force) = (
            self.drive.get(Knob::SlideRoll),
            self.drive.get(Knob::ForceN),
        );
        (m.slide_roll, m.slide_roll_target) = (s.now, self.wanted.get(Knob::SlideRoll).target);
        (m.load_n, m.load_target_n) = (force.now, self.wanted.get(Knob::ForceN).target);
        m.entrainment_m_s = self.drive.get(Knob::EntrainmentMS).now;
        m.amplitude_1_m = self.drive.get(Knob::Amplitude1M).now;
        m.amplitude_2_m = self.drive.get(Knob::Amplitude2M).now;
        m.p_max_pa = door.pa_from_p(measured.p_max);
        m.h_central_m = door.m_from_h(measured.h_central);
        m.h_min_m = door.m_from_h(measured.h_min);
        m.h_mean_m = door.m_from_h(measured.h_mean);
        m.contact_ratio = measured.contact_ratio;
        m.contact_load_ratio = measured.contact_load_ratio;
        m.friction_coefficient = measured.friction.abs();
        let rq = (m.amplitude_1_m * self.composite[0]).hypot(m.amplitude_2_m * self.composite[1]);
        // Smooth film at the knobs' present values by the exponents of Hamrock and Dowson (1977).
        let speed = m.entrainment_m_s / (0.5 * (self.plan.speeds_m_s[0] + self.plan.speeds_m_s[1]));
        let film = door.m_from_h(self.smooth_film)
            * speed.powf(0.67)
            * (m.load_n / self.plan.force_n).powf(-0.067);
        m.lambda_ratio = (rq > 0.0 && film > 0.0).then(|| film / rq);
        if let Some(stress) = self.stress.as_ref().filter(|_| has_stress) {
            let peak = stress.slice.peak;
            m.sigma_eff_max_pa = Some(door.pa_from_p(peak.value));
            m.sigma_eff_max_depth_m = Some(door.m_from_x(peak.z));
            m.sigma_eff_max_x_m = Some(door.m_from_x(peak.x));
        }
        let n = self
            .motion
            .contacts_per_cycle(&self.plan, m.entrainment_m_s, m.slide_roll);
        (m.n_body_1, m.n_body_2) = (n[0], n[1]);
        self.metrics.life = self.life_estimate();
    }

    /// Whether the slice belongs to the present step.
    pub(super) fn stage_has_stress(&self) -> bool {
        !matches!(self.phase, Phase::Smooth { .. })
    }
}

fn initial(scene: &Scene, plan: &Plan, knob: Knob) -> (f64, f64) {
    let amplitude = |m: f64| (m, m.max(1e-7));
    match knob {
        Knob::SlideRoll => (scene.motion.slide_roll, 1.0),
        Knob::ForceN => (plan.force_n, 0.5 * plan.force_n),
        Knob::Amplitude1M => amplitude(scene.body_1.surface.amplitude_m()),
        Knob::Amplitude2M => amplitude(scene.body_2.surface.amplitude_m()),
        Knob::EntrainmentMS => (
            scene.motion.entrainment_m_s,
            0.5 * scene.motion.entrainment_m_s,
        ),
    }
}

fn grid_of(plan: &Plan, nodes: usize, b_over_a: f64) -> Grid {
    let symmetry = match plan.symmetry {
        crate::plan::Symmetry::MirrorY => Symmetry::MirrorY,
        crate::plan::Symmetry::General => Symmetry::General,
    };
    let domain = &plan.domain;
    Grid::new(
        nodes,
        domain.x_min_a,
        domain.x_max_a,
        domain.y_half_b * b_over_a,
        symmetry,
    )
}

fn traction_law(scene: &Scene, door: &Door) -> TractionLaw {
    let film = scene.lubricant.as_ref().map(|oil| FilmShear {
        rate: 0.0,
        eyring: (oil.rheology == crate::scene::Rheology::Eyring)
            .then_some(oil.eyring_stress_pa / door.p_hertz_pa),
        limit: oil.limiting_shear_ratio,
    });
    TractionLaw {
        film,
        viscosity: door.medium(1.0, 0.0).viscosity,
        boundary: scene.friction.boundary,
        contact_film: door.h_from_m(scene.friction.contact_film_m),
        direction: 0.0,
    }
}
