//! What is looked at after each step: traction, stress, counts, life, scalars.

use super::Simulation;
use crate::physics::cycles::BodyId;
use crate::sim::counting::contacts;
use crate::sim::fatigue_stage::Now;
use crate::sim::measure::{Fields, Measured, measure};
use crate::sim::state::Phase;
use crate::sim::stepping::Attempted;
use crate::sim::yielded::Yielded;
use crate::sim::{Follow, Knob, LifeEstimate};

impl Simulation {
    /// Traction, stress, life and scalars of the committed step.
    pub(super) fn watch(&mut self, attempted: &Attempted) {
        let before = self.state.watched;
        self.state.watched = self.state.motion.travelled;
        let on_fine = self.work.solver.grid.nx == self.plan.decided.domain.nodes;
        let measured = self.measure();
        let size = self.size_now();
        let looks = on_fine && self.stage_has_stress();
        if looks && let Some(stress) = &mut self.work.stress {
            let (p, q) = (&self.state.contact.pressure, &self.work.traction);
            self.work
                .pool
                .install(|| stress.slice(p, q, measured.friction));
            if self.state.phase == Phase::Passage
                && let Some(counting) = &mut self.state.counting
            {
                let travel = [0, 1].map(|body: usize| self.state.watched[body] - before[body]);
                counting.step(&self.work.solver.grid, travel, stress, size);
            }
        }
        if looks {
            self.sample_life();
        }
        self.publish(attempted, &measured);
    }

    /// The volume under the slice's surface, with the counts up to it.
    fn sample_life(&mut self) {
        let stress_error = self.stress_error_now();
        let Some(stress) = &mut self.work.stress else {
            return;
        };
        let every = self.plan.decided.life.map_or(f64::INFINITY, |life| {
            life.volume_every_steps as f64 * self.plan.stepping.usual() * self.work.solver.grid.dx
        });
        // By the distance at the step's beginning, so that the first step of a passage is looked at.
        let due = self.state.phase == Phase::Passage
            && self.state.distance >= self.state.next_volume - 1e-9;
        let flushed = self.state.motion.is_flushed();
        let repeat = self.state.metrics.repeat;
        let counting = self.state.counting.as_ref();
        self.work.pool.install(|| {
            if let Some(life) = &mut self.state.life
                && due
            {
                life.push(every, stress, counting);
                if flushed {
                    life.test_settled(stress_error, repeat, counting);
                }
                self.stats.stress_volumes += u64::from(life.integrates());
                self.state.next_volume =
                    next_due(self.state.next_volume, self.state.distance, every);
            }
        });
    }

    /// Shows another material point; nothing that is computed changes.
    pub fn show_point(&mut self, follow: Follow) {
        let Some(counting) = &mut self.state.counting else {
            return;
        };
        let depths = self.work.stress.as_ref().map_or(&[][..], |s| s.depths());
        let away = |k: usize| (self.plan.scaling.m_from_x(depths[k]) - follow.depth_m).abs();
        let nearest = (0..depths.len()).min_by(|&one, &two| away(one).total_cmp(&away(two)));
        let body = if follow.body == 2 {
            BodyId::Two
        } else {
            BodyId::One
        };
        let x = follow
            .x_m
            .map(|x_m| self.plan.scaling.heading.sign() * x_m / self.plan.scaling.a_m);
        counting.look_at(body, x, nearest.unwrap_or(0));
    }

    /// Whether the passage repeats, after a step that began at the distance `before`.
    pub(super) fn look_for_orbit(&mut self, before: f64) {
        let s = self.state.drive.get(Knob::SlideRoll).now;
        let mut frequencies = [0.0; 4];
        for (body, speed) in [1.0 - 0.5 * s, 1.0 + 0.5 * s].into_iter().enumerate() {
            let amplitude = Knob::AMPLITUDES[body];
            if self.state.drive.get(amplitude).now != 0.0 {
                for (plane, k) in self
                    .work
                    .roughness
                    .wavenumbers(body)
                    .into_iter()
                    .enumerate()
                {
                    frequencies[2 * body + plane] = k * speed / std::f64::consts::TAU;
                }
            }
        }
        let passage = self.plan.decided.passage_a;
        if self.state.orbit.listen(frequencies, passage)
            && let Some(life) = &mut self.state.life
        {
            life.set_window(self.state.orbit.life_window(passage));
        }
        if self.state.motion.is_flushed() {
            let contact = &self.state.contact;
            let fields = (&contact.pressure[..], &contact.film[..]);
            self.state.orbit.push(
                self.state.distance,
                self.state.distance - before,
                fields,
                &self.state.metrics,
            );
        }
        let second_per_a = self.plan.scaling.a_m / self.state.drive.get(Knob::EntrainmentMS).now;
        self.state.metrics.repeat = Some(self.state.orbit.repeat(second_per_a));
    }

    pub(super) fn measure(&mut self) -> Measured {
        let law = self.plan.law_now(&self.state.drive);
        let scale = self.size_now();
        let state = &self.state.contact;
        self.work.traction.resize(self.work.solver.grid.len(), 0.0);
        let fields = Fields {
            grid: &self.work.solver.grid,
            law: &law,
            p: &state.pressure,
            h: &state.film,
            ellipse: (scale, scale * self.plan.scaling.b_over_a),
        };
        let (traction, rows) = (&mut self.work.traction, &mut self.work.row_sums);
        self.work.pool.install(|| measure(&fields, traction, rows))
    }

    pub(super) fn publish(&mut self, attempted: &Attempted, measured: &Measured) {
        self.publish_lubrication(measured);
        let has_stress = self.stage_has_stress();
        let a_m = self.plan.decided.hertz.a_m * self.size_now();
        let scaling = &self.plan.scaling;
        let m = &mut self.state.metrics;
        m.converged = attempted.converged;
        m.residual = attempted.residual;
        m.newton_iterations = attempted.newton;
        m.linear_iterations = attempted.linear;
        m.retries = attempted.retries;
        m.film_error = attempted.film_error;
        m.mass_error = attempted.mass_error;
        m.load_error = attempted.load_error;
        m.overlap_m = scaling.m_from_h(attempted.overlap);
        let flow = self.plan.flow_now(&self.state.drive);
        let tolerance = self.plan.tolerance(flow);
        m.asked = [tolerance.pressure, tolerance.film];
        let load = scaling.load_knob();
        let (s, force) = (
            self.state.drive.get(Knob::SlideRoll),
            self.state.drive.get(load),
        );
        (m.slide_roll, m.slide_roll_target) =
            (s.now, self.state.targets.get(Knob::SlideRoll).target);
        (m.load_n, m.load_target_n) = (force.now, self.state.targets.get(load).target);
        m.entrainment_m_s = scaling.heading.sign() * self.state.drive.get(Knob::EntrainmentMS).now;
        let volumes = self.state.yielded.as_ref().map(Yielded::volumes);
        m.yielded_m3 = volumes.map(|both| both.map(|volume| scaling.m3_from_volume(volume)));
        if let Some(stress) = self.work.stress.as_ref().filter(|_| has_stress) {
            let peak = stress.slice.peak;
            m.sigma_eff_max_pa = Some(scaling.pa_from_p(peak.value));
            m.sigma_eff_max_depth_m = Some(scaling.m_from_x(peak.z));
            m.sigma_eff_max_x_m = Some(scaling.place_m(peak.x));
        }
        let n = contacts(
            &self.plan.decided,
            a_m,
            (m.entrainment_m_s, m.slide_roll),
            [m.amplitude_1_m, m.amplitude_2_m],
        );
        (m.n_body_1, m.n_body_2) = (n[0], n[1]);
        if let Some(counting) = &self.state.counting {
            let counted = counting.counted();
            (m.n_counted_body_1, m.n_counted_body_2) = (counted[0], counted[1]);
        }
        self.state.metrics.life = self.life_estimate();
    }

    /// Whether the slice belongs to the present step: the smooth contact's is taken once, and while a contact
    /// settles in the wake of a neighbour nobody looks.
    pub(super) fn stage_has_stress(&self) -> bool {
        !matches!(
            self.state.phase,
            Phase::Smooth { .. } | Phase::Settle { .. }
        )
    }

    pub(super) fn life_estimate(&self) -> Option<LifeEstimate> {
        let now = Now {
            n: [self.state.metrics.n_body_1, self.state.metrics.n_body_2],
            slide_roll: self.state.metrics.slide_roll,
            size: self.size_now(),
            stress_error: self.stress_error_now(),
            has_reference: self.has_reference_of_now(),
        };
        self.state
            .life
            .as_ref()?
            .estimate(&now, self.state.counting.as_ref())
    }
}

/// The first multiple of `every` after `due` that lies beyond `distance`.
fn next_due(due: f64, distance: f64, every: f64) -> f64 {
    due + every * ((distance - due + 1e-9) / every).floor().max(0.0) + every
}
