//! What is looked at after each step: traction, stress, counts, life, scalars.

use super::counting::contacts;
use super::fatigue_stage::Now;
use super::measure::{Fields, Measured, measure};
use super::simulation::{Phase, Simulation};
use super::stepping::Attempted;
use super::{Follow, Knob, LifeEstimate};
use crate::physics::cycles::BodyId;
use crate::solve::march::Flow;
use crate::solve::traction::TractionLaw;

impl Simulation {
    /// Traction, stress, life and scalars of the committed step.
    pub(super) fn watch(&mut self, attempted: &Attempted) {
        let before = self.watched;
        self.watched = self.motion.travelled;
        let on_fine = self.march.grid.nx == self.plan.domain.nodes;
        let measured = self.measure();
        if on_fine && self.stage_has_stress() {
            self.measure_stress(&measured);
        }
        if on_fine
            && self.phase == Phase::Passage
            && let Some(counting) = &mut self.counting
        {
            let travel = [0, 1].map(|body: usize| self.watched[body] - before[body]);
            let pressure = &self.march.state.pressure;
            counting.step(&self.march.grid, travel, pressure, self.stress.as_ref());
        }
        self.publish(attempted, &measured);
    }

    fn measure_stress(&mut self, measured: &Measured) {
        let Some(stress) = &mut self.stress else {
            return;
        };
        let (p, q) = (&self.march.state.pressure, &self.traction);
        let every = self.plan.life.map_or(f64::INFINITY, |life| {
            life.volume_every_steps as f64 * self.motion.nodes * self.march.grid.dx
        });
        // By the way at the step's beginning, so that the first step of a passage is looked at.
        let due = self.phase == Phase::Passage && self.way >= self.next_volume - 1e-9;
        self.pool.install(|| {
            stress.slice(p, q, measured.friction);
            if let Some(life) = &mut self.life
                && due
            {
                life.push(every, stress);
                self.stats.stress_volumes += u64::from(life.integrates());
                self.next_volume = next_due(self.next_volume, self.way, every);
            }
        });
    }

    /// Shows another material point; nothing that is computed changes.
    pub fn show_point(&mut self, follow: Follow) {
        let Some(counting) = &mut self.counting else {
            return;
        };
        let depths = self.stress.as_ref().map_or(&[][..], |s| s.depths());
        let away = |k: usize| (self.door.m_from_x(depths[k]) - follow.depth_m).abs();
        let nearest = (0..depths.len()).min_by(|&one, &two| away(one).total_cmp(&away(two)));
        let body = if follow.body == 2 {
            BodyId::Two
        } else {
            BodyId::One
        };
        let x = follow
            .x_m
            .map(|x_m| self.door.heading.sign() * x_m / self.door.a_m);
        counting.look_at(body, x, nearest.unwrap_or(0));
    }

    /// Whether the passage repeats, after a step that began at the way `before`.
    pub(super) fn look_for_orbit(&mut self, before: f64) {
        let s = self.drive.get(Knob::SlideRoll).now;
        let mut frequencies = [0.0; 4];
        for (body, speed) in [1.0 - 0.5 * s, 1.0 + 0.5 * s].into_iter().enumerate() {
            let amplitude = [Knob::Amplitude1M, Knob::Amplitude2M][body];
            if self.drive.get(amplitude).now != 0.0 {
                for (plane, k) in self.terrain.wavenumbers(body).into_iter().enumerate() {
                    frequencies[2 * body + plane] = k * speed / std::f64::consts::TAU;
                }
            }
        }
        let passage = self.plan.passage_a;
        if self.orbit.listen(frequencies, passage)
            && let Some(life) = &mut self.life
        {
            life.set_period(self.orbit.window(passage));
        }
        let state = &self.march.state;
        let fields = (&state.pressure[..], &state.film[..]);
        self.orbit
            .push(self.way, self.way - before, fields, &self.metrics);
        let second_per_a = self.door.a_m / self.drive.get(Knob::EntrainmentMS).now;
        self.metrics.repeat = Some(self.orbit.repeat(second_per_a));
    }

    /// The traction law at the knobs' present values: of the film, if there is one, and of contact.
    pub(super) fn law_now(&self) -> TractionLaw {
        let law = self.law_of_oil();
        match self.regime.flow_now(&self.door, &self.drive) {
            Flow::Dry => law.without_film(),
            Flow::Film | Flow::MassConserving => law,
        }
    }

    /// The same where oil flows; a step decides that for itself, because its knobs have moved on.
    pub(super) fn law_of_oil(&self) -> TractionLaw {
        let s = self.drive.get(Knob::SlideRoll).now;
        let u = self.drive.get(Knob::EntrainmentMS).now;
        let mut law = self.law;
        law.direction = if s == 0.0 { 0.0 } else { s.signum() };
        if let Some(film) = &mut law.film {
            film.rate = self.motion.shear_rate * (s * u).abs();
        }
        law
    }

    pub(super) fn measure(&mut self) -> Measured {
        let law = self.law_now();
        let scale = self.size_now();
        let state = &self.march.state;
        self.traction.resize(self.march.grid.len(), 0.0);
        let fields = Fields {
            grid: &self.march.grid,
            law: &law,
            p: &state.pressure,
            h: &state.film,
            ellipse: (scale, scale * self.door.b_over_a),
        };
        let (traction, rows) = (&mut self.traction, &mut self.row_sums);
        self.pool.install(|| measure(&fields, traction, rows))
    }

    pub(super) fn publish(&mut self, attempted: &Attempted, measured: &Measured) {
        self.publish_lubrication(measured);
        let has_stress = self.stage_has_stress();
        let a_m = self.plan.hertz.a_m * self.size_now();
        let door = &self.door;
        let m = &mut self.metrics;
        m.converged = attempted.converged;
        m.residual = attempted.residual;
        m.newton_iterations = attempted.newton;
        m.linear_iterations = attempted.linear;
        m.retries = attempted.retries;
        m.film_error = attempted.film_error;
        m.mass_error = attempted.mass_error;
        m.load_error = attempted.load_error;
        m.overlap_m = door.m_from_h(attempted.overlap);
        let load = door.load_knob();
        let (s, force) = (self.drive.get(Knob::SlideRoll), self.drive.get(load));
        (m.slide_roll, m.slide_roll_target) = (s.now, self.wanted.get(Knob::SlideRoll).target);
        (m.load_n, m.load_target_n) = (force.now, self.wanted.get(load).target);
        m.entrainment_m_s = door.heading.sign() * self.drive.get(Knob::EntrainmentMS).now;
        m.p_max_pa = door.pa_from_p(measured.p_max);
        m.friction_coefficient = measured.friction.abs();
        if let Some(stress) = self.stress.as_ref().filter(|_| has_stress) {
            let peak = stress.slice.peak;
            m.sigma_eff_max_pa = Some(door.pa_from_p(peak.value));
            m.sigma_eff_max_depth_m = Some(door.m_from_x(peak.z));
            m.sigma_eff_max_x_m = Some(door.place_m(peak.x));
        }
        let n = contacts(
            &self.plan,
            a_m,
            (m.entrainment_m_s, m.slide_roll),
            [m.amplitude_1_m, m.amplitude_2_m],
        );
        (m.n_body_1, m.n_body_2) = (n[0], n[1]);
        if let Some(counting) = &self.counting {
            let counted = counting.counted();
            (m.n_counted_body_1, m.n_counted_body_2) = (counted[0], counted[1]);
        }
        self.metrics.life = self.life_estimate();
    }

    /// Whether the slice belongs to the present step: the smooth contact's is taken once, and while a contact
    /// settles in the wake of a neighbour nobody looks.
    pub(super) fn stage_has_stress(&self) -> bool {
        !matches!(self.phase, Phase::Smooth { .. } | Phase::Settle { .. })
    }

    pub(super) fn life_estimate(&self) -> Option<LifeEstimate> {
        let now = Now {
            n: [self.metrics.n_body_1, self.metrics.n_body_2],
            slide_roll: self.metrics.slide_roll,
            size: self.size_now(),
            stress_error: self.stress_error,
            has_reference: self.has_reference_of_now(),
        };
        self.life.as_ref()?.estimate(&now, self.counting.as_ref())
    }
}

/// The first multiple of `every` after `due` that lies beyond `way`.
fn next_due(due: f64, way: f64, every: f64) -> f64 {
    due + every * ((way - due + 1e-9) / every).floor().max(0.0) + every
}
