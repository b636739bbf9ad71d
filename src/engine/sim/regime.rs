//! Which equation a step is solved by: flow in a film, or contact without one.
//!
//! ```text
//! h_c(U, w)                          central film of the smooth contact by formula (plan::FilmPlan::at)
//! flow  where h_c ≥ one layer of oil molecules (plan::MOLECULE_M) or oil cannot leave,  else  none: P ≥ 0, H ≥ 0, P H = 0
//! ```
//! Asked at every step with the knobs as they are, so that a speed that is turned down ends in the dry contact and
//! one that is turned up leaves it again: pressure, film and history are the same fields in both.

use super::drive::Drive;
use super::sim_plan::SimPlan;
use super::smooth::LoadAndSpeed;
use crate::plan::FilmPlan;
use crate::scene::Knob;
use crate::scene::Order;
use crate::solve::march::Flow;
use crate::solve::newton::Tolerance;
use crate::solve::traction::TractionLaw;

impl SimPlan {
    /// a and p_h of the load of now over those of the scene's.
    pub(super) fn size_now(&self, drive: &Drive) -> f64 {
        let load = drive.get(self.scaling.load_knob()).now / self.decided.force_n;
        self.scaling.size_ratio(load)
    }

    /// The smooth film by formula at the knobs' present values; `None`: the scene has no oil.
    pub(super) fn film_now(&self, drive: &Drive) -> Option<FilmPlan> {
        let now = |knob| drive.get(knob).now;
        self.film_at(LoadAndSpeed {
            load: now(self.scaling.load_knob()),
            speed_m_s: now(Knob::EntrainmentMS),
        })
    }

    /// The same at a load and a speed.
    pub(super) fn film_at(&self, at: LoadAndSpeed) -> Option<FilmPlan> {
        let base = self.base();
        let (speed, load) = (at.speed_m_s / base.speed_m_s, at.load / base.load);
        self.decided.film.map(|film| film.at(speed, load))
    }

    /// Order of the discretisation at the knobs' present values.
    pub(super) fn order_now(&self, drive: &Drive) -> Order {
        let dx_a = self.decided.domain.dx_a() / self.size_now(drive);
        let film = self.film_now(drive);
        film.map_or(self.decided.order, |film| film.truncation().order(dx_a))
    }

    /// The scene's own load and speed.
    pub(super) fn base(&self) -> LoadAndSpeed {
        LoadAndSpeed {
            load: self.decided.force_n,
            speed_m_s: self.scene.motion.entrainment_m_s.abs(),
        }
    }

    /// Flow at the knobs' present values.
    pub(super) fn flow_now(&self, drive: &Drive) -> Flow {
        match self.film_now(drive) {
            Some(film) if film.flows() => self.flow,
            _ => Flow::Dry,
        }
    }

    /// The traction law at the knobs' present values: of the film, if there is one, and of contact.
    pub(super) fn law_now(&self, drive: &Drive) -> TractionLaw {
        let now = |knob| drive.get(knob).now;
        let (s, u) = (now(Knob::SlideRoll), now(Knob::EntrainmentMS));
        let mut law = self.law;
        law.direction = if s == 0.0 { 0.0 } else { s.signum() };
        if let Some(film) = &mut law.film {
            film.rate = self.shear_rate * (s * u).abs();
        }
        match self.flow_now(drive) {
            Flow::Dry => law.without_film(),
            Flow::Film | Flow::MassConserving => law,
        }
    }

    /// Tolerance of a step.
    pub(super) fn tolerance(&self, flow: Flow) -> Tolerance {
        self.tolerances[usize::from(flow == Flow::Dry)]
    }
}
