//! What follows by closed forms from the knobs as they are now: size of the contact, film, λ, regime, mesh error, and the
//! grounds of cautions.

use super::Simulation;
use crate::plan::{Domain, FilmPlan};
use crate::sim::measure::Measured;
use crate::sim::{Grounds, Knob, LubricationRegime, MeshErrors};
use crate::solve::march::Flow;

impl Simulation {
    /// a and p_h of the present load over those of the scene's.
    pub(super) fn size_now(&self) -> f64 {
        self.plan.size_now(&self.state.drive)
    }

    /// Relative error of stress by the mesh, of the bodies that are rough now.
    pub(super) fn stress_error_now(&self) -> f64 {
        let amplitudes = Knob::AMPLITUDES;
        self.plan
            .stress_error(amplitudes.map(|knob| self.state.drive.get(knob).now))
    }

    /// What was measured of the committed step, its regime and mesh error.
    pub(super) fn publish_lubrication(&mut self, measured: &Measured) {
        let film = self.plan.film_now(&self.state.drive);
        let flows = self.plan.flow_now(&self.state.drive) != Flow::Dry;
        let errors = self.mesh_errors_now(film);
        let m = &mut self.state.metrics;
        measured.publish(&self.plan.scaling, m);
        m.amplitude_1_m = self.state.drive.get(Knob::Amplitude1M).now;
        m.amplitude_2_m = self.state.drive.get(Knob::Amplitude2M).now;
        let rq = (m.amplitude_1_m * self.plan.rms_shares[0])
            .hypot(m.amplitude_2_m * self.plan.rms_shares[1]);
        m.lambda_ratio = film.and_then(|film| film.lambda(rq));
        m.film_to_roughness = (rq > 0.0).then(|| m.h_mean_m / rq);
        m.regime = LubricationRegime::of(flows, m.lambda_ratio, m.contact_load_ratio);
        m.errors = errors;
    }

    /// Errors by the mesh that the start-up found, carried on to the present speed and load.
    fn mesh_errors_now(&self, film: Option<FilmPlan>) -> Option<MeshErrors> {
        let found = self.state.mesh_errors?;
        let own = self
            .plan
            .decided
            .film
            .map(|film| self.mesh_rule(&film, 1.0));
        let now = film.map(|film| self.mesh_rule(&film, self.size_now()));
        let films = own.zip(now).map_or(1.0, |(own, now)| now / own);
        Some(MeshErrors {
            h_central: found.h_central * films,
            h_min: found.h_min * films,
            p_max: found.p_max / self.size_now().powi(2),
        })
    }

    /// The plan's rule for a contact of `size` times the scene's.
    fn mesh_rule(&self, film: &FilmPlan, size: f64) -> f64 {
        let dx_a = self.plan.decided.domain.dx_a() / size;
        film.truncation().mesh_error(dx_a)
    }

    /// What cautions are drawn from beside the scalars.
    pub(super) fn grounds(&self) -> Grounds {
        let film = self.plan.film_now(&self.state.drive);
        let flows = self.plan.flow_now(&self.state.drive) != Flow::Dry;
        let size = self.size_now();
        let measured = self.state.metrics.errors.map(|errors| errors.h_central);
        let by_rule = film.map(|film| self.mesh_rule(&film, size));
        // Where the mesh cannot carry the film two grids may agree on anything, as on no film at all.
        let is_lost = by_rule.is_some_and(|rule| rule > 1.0);
        let mesh_film = if is_lost {
            by_rule
        } else {
            measured.or(by_rule)
        };
        let mut grounds = Grounds {
            steps: self.state.step,
            film_m: film.map(|film| film.central_m),
            flows,
            mesh_film: mesh_film.filter(|_| flows),
            short_domain: film.filter(|_| flows).map(|film| {
                let domain = &self.plan.decided.domain;
                let seen = Domain {
                    x_min_a: domain.x_min_a / size,
                    y_half_b: domain.y_half_b / size,
                    ..*domain
                };
                seen.edge_error(&film.truncation())
            }),
            ..self.plan.grounds
        };
        self.state.totals.ground(&mut grounds);
        grounds
    }
}
