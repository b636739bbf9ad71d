//! What follows by closed forms from the knobs as they are now: size of the contact, film, λ, regime, mesh error, and the
//! grounds of cautions.

use crate::plan::{FilmPlan, LOST};
use crate::sim::counting::felt_at_points;
use crate::sim::fatigue_stage::LifeStage;
use crate::sim::grounds::ReferenceLife;
use crate::sim::measure::Measured;
use crate::sim::sim_plan::SimPlan;
use crate::sim::smooth::LoadAndSpeed;
use crate::sim::{Grounds, Knob, LubricationRegime, MeshErrors, Metrics, State};
use crate::solve::march::Flow;

/// Load and speed that the knobs go to.
pub(super) fn conditions(plan: &SimPlan, state: &State) -> LoadAndSpeed {
    let target = |knob| state.drive.get(knob).target;
    LoadAndSpeed {
        load: target(plan.scaling.load_knob()),
        speed_m_s: target(Knob::EntrainmentMS),
    }
}

/// Whether the reference is that of the load and speed that the knobs go to.
pub(super) fn has_reference_of_now(plan: &SimPlan, state: &State) -> bool {
    let life = state.life.as_ref();
    life.is_none_or(|life| life.reference_at == conditions(plan, state))
}

/// Relative error of stress by the mesh, of the bodies that are rough now.
pub(super) fn stress_error_now(plan: &SimPlan, state: &State) -> f64 {
    let amplitudes = Knob::AMPLITUDES;
    let size = plan.size_now(&state.drive);
    plan.stress_error(amplitudes.map(|knob| state.drive.get(knob).now), size)
}

/// What was measured of the committed step, its regime and mesh error.
pub(super) fn publish_lubrication(plan: &SimPlan, state: &mut State, measured: &Measured) {
    let film = plan.film_now(&state.drive);
    let flows = plan.flow_now(&state.drive) != Flow::Dry;
    let errors = mesh_errors_now(plan, state, film);
    let m = &mut state.metrics;
    measured.publish(&plan.scaling, m);
    m.amplitude_1_m = state.drive.get(Knob::Amplitude1M).now;
    m.amplitude_2_m = state.drive.get(Knob::Amplitude2M).now;
    let rq = (m.amplitude_1_m * plan.rms_shares[0]).hypot(m.amplitude_2_m * plan.rms_shares[1]);
    m.lambda_ratio = film.and_then(|film| film.lambda(rq));
    m.film_to_roughness = (rq > 0.0).then(|| m.h_mean_m / rq);
    m.regime = LubricationRegime::of(flows, m.lambda_ratio, m.contact_load_ratio);
    m.errors = errors;
}

/// Errors by the mesh that the start-up found, carried on to the present speed and load.
fn mesh_errors_now(plan: &SimPlan, state: &State, film: Option<FilmPlan>) -> Option<MeshErrors> {
    let found = state.mesh_errors?;
    let own = plan.decided.film.map(|film| mesh_rule(plan, &film, 1.0));
    let now = film.map(|film| mesh_rule(plan, &film, plan.size_now(&state.drive)));
    let films = own.zip(now).map_or(1.0, |(own, now)| now / own);
    Some(MeshErrors {
        h_central: found.h_central * films,
        h_min: found.h_min * films,
        p_max: found.p_max / plan.size_now(&state.drive).powi(2),
    })
}

/// The plan's rule for a contact of `size` times the scene's.
fn mesh_rule(plan: &SimPlan, film: &FilmPlan, size: f64) -> f64 {
    let dx_a = plan.decided.domain.dx_a() / size;
    film.truncation().mesh_error(dx_a)
}

/// What cautions are drawn from beside the scalars.
pub(super) fn grounds(plan: &SimPlan, state: &State) -> Grounds {
    let film = plan.film_now(&state.drive);
    let flows = plan.flow_now(&state.drive) != Flow::Dry;
    let size = plan.size_now(&state.drive);
    let measured = state.metrics.errors.map(|errors| errors.h_central);
    let by_rule = film.map(|film| mesh_rule(plan, &film, size));
    // Where the mesh cannot carry the film two grids may agree on anything, as on no film at all.
    let is_lost = by_rule.is_some_and(|rule| rule > LOST);
    let mesh_film = if is_lost {
        by_rule
    } else {
        measured.or(by_rule)
    };
    let (hertz, domain) = (&plan.decided.hertz, &plan.decided.domain);
    let mut grounds = Grounds {
        steps: state.step,
        half_width_m: size * hertz.a_m.min(hertz.b_m),
        p_mean_pa: size * hertz.p_max_pa * plan.decided.kind.mean_pressure(),
        film_m: film.map(|film| film.central_m),
        flows,
        felt: felt_at_points(&plan.decided, size, &state.metrics),
        reference: (state.life.as_ref()).map_or(ReferenceLife::Ends, LifeStage::reference_ends),
        mesh_film: mesh_film.filter(|_| flows),
        short_domain: film
            .filter(|_| flows)
            .map(|film| domain.seen_by(size).edge_error(&film.truncation())),
        crests_at_edge_m: crests_at_edge_m(plan, &state.metrics, size),
        map_seen_m: map_seen_m(plan, state),
        meetings: (plan.decided).meetings(state.drive.get(Knob::SlideRoll).now, state.distance),
        ..plan.grounds
    };
    state.totals.ground(&mut grounds);
    grounds
}

/// Heights of both surfaces' crests together, m, where they can meet at an edge of the domain; `None`: they cannot.
fn crests_at_edge_m(plan: &SimPlan, m: &Metrics, size: f64) -> Option<f64> {
    let crests_m = m.amplitude_1_m.abs() + m.amplitude_2_m.abs();
    let meet = plan.decided.crests_meet(&plan.scene, crests_m, size);
    meet.then_some(crests_m)
}

/// How much of the height maps of body 1 and 2 has passed since the start-up, and how long they are, m; `None`: it has none, it
/// stands, or all of it has passed.
fn map_seen_m(plan: &SimPlan, state: &State) -> [Option<[f64; 2]>; 2] {
    let slide_roll = state.drive.get(Knob::SlideRoll).now;
    let distance_m = state.distance * plan.decided.hertz.a_m;
    [-0.5, 0.5].map(|side| {
        let body = usize::from(side > 0.0);
        let length_m = plan.scene.surfaces()[body].relief_length_m()?;
        let ratio = (1.0 + side * slide_roll).abs();
        let seen_m = distance_m * ratio;
        (ratio > 0.0 && seen_m < (1.0 - SEEN_WHOLE) * length_m).then_some([seen_m, length_m])
    })
}

/// Share of a map that a last step may leave out.
const SEEN_WHOLE: f64 = 1e-6;
