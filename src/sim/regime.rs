//! Which equation a step is solved by: flow in a film, or contact without one.
//!
//! ```text
//! h_c(U, w)                          central film of the smooth contact by formula (plan::FilmPlan::at)
//! flow  where h_c ≥ one layer of oil molecules (plan::MOLECULE_M) or oil cannot leave,  else  none: P ≥ 0, H ≥ 0, P H = 0
//! ```
//! Asked at every step with the knobs as they are, so that a speed that is turned down ends in the dry contact and
//! one that is turned up leaves it again: pressure, film and history are the same fields in both.

use super::door::Door;
use super::drive::Drive;
use super::motion::Motion;
use super::smooth::Conditions;
use crate::plan::{FilmPlan, Plan};
use crate::scene::Knob;
use crate::scene::Order;
use crate::solve::march::Flow;
use crate::solve::newton::Tolerance;
use crate::solve::traction::TractionLaw;

/// The rule, and the tolerances on both sides of it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Regime {
    /// Flow of the films that are films.
    wet: Flow,
    /// Film by formula at `speed_m_s` and `force`, the scene's; `None`: the scene has no oil.
    film: Option<FilmPlan>,
    speed_m_s: f64,
    force: f64,
    /// Node spacing, in a of the scene's load; order of the discretisation without a film.
    dx_a: f64,
    order: Order,
    /// Of steps with flow and of steps without.
    tolerances: [Tolerance; 2],
}

impl Regime {
    /// The rule for a planned scene.
    pub(super) fn new(
        plan: &Plan,
        wet: Flow,
        speed_m_s: f64,
        tolerance: impl Fn(Flow) -> Tolerance,
    ) -> Self {
        Self {
            wet,
            film: plan.film,
            speed_m_s,
            force: plan.force_n,
            dx_a: plan.domain.dx_a(),
            order: plan.order,
            tolerances: [tolerance(wet), tolerance(Flow::Dry)],
        }
    }

    /// The smooth film by formula at the knobs' present values; `None`: the scene has no oil.
    pub(super) fn film_now(&self, door: &Door, drive: &Drive) -> Option<FilmPlan> {
        let now = |knob| drive.get(knob).now;
        self.film_at(Conditions {
            load: now(door.load_knob()),
            speed_m_s: now(Knob::EntrainmentMS),
        })
    }

    /// The same at a load and a speed.
    pub(super) fn film_at(&self, at: Conditions) -> Option<FilmPlan> {
        let base = self.base();
        let (speed, load) = (at.speed_m_s / base.speed_m_s, at.load / base.load);
        self.film.map(|film| film.at(speed, load))
    }

    /// Order of the discretisation at the knobs' present values.
    pub(super) fn order_now(&self, door: &Door, drive: &Drive) -> Order {
        let size = door.size_ratio(drive.get(door.load_knob()).now / self.force);
        self.film_now(door, drive)
            .map_or(self.order, |film| film.truncation().order(self.dx_a / size))
    }

    /// The scene's own load and speed.
    pub(super) fn base(&self) -> Conditions {
        Conditions {
            load: self.force,
            speed_m_s: self.speed_m_s,
        }
    }

    /// Flow at the knobs' present values.
    pub(super) fn flow_now(&self, door: &Door, drive: &Drive) -> Flow {
        match self.film_now(door, drive) {
            Some(film) if film.flows() => self.wet,
            _ => Flow::Dry,
        }
    }

    /// The traction law at the knobs' present values: of the film, if there is one, and of contact. `law` is that of the
    /// scene's oil.
    pub(super) fn law_now(
        &self,
        law: &TractionLaw,
        door: &Door,
        drive: &Drive,
        motion: &Motion,
    ) -> TractionLaw {
        let now = |knob| drive.get(knob).now;
        let (s, u) = (now(Knob::SlideRoll), now(Knob::EntrainmentMS));
        let mut law = *law;
        law.direction = if s == 0.0 { 0.0 } else { s.signum() };
        if let Some(film) = &mut law.film {
            film.rate = motion.shear_rate * (s * u).abs();
        }
        match self.flow_now(door, drive) {
            Flow::Dry => law.without_film(),
            Flow::Film | Flow::MassConserving => law,
        }
    }

    /// Tolerance of a step.
    pub(super) fn tolerance(&self, flow: Flow) -> Tolerance {
        self.tolerances[usize::from(flow == Flow::Dry)]
    }
}
