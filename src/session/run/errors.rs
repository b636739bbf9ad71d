//! The discretisation error of a run, from one on half the nodes: the ladder's last but one ([`super::ladder`]), or a
//! companion ([`super::companion`]).
//!
//! ```text
//! central film     |h(dx) − h(2dx)|, of rough bodies twice that
//! life             |ln L(dx) − ln L(2dx)| + min(c (2π/n)²/48, |ln L|/10) + what its mean has not settled to
//! minimum film     2 |h(dx) − h(2dx)|
//! maximum p        2 |p(dx) − p(2dx)| + p_h (dx/a)²/8 + (p − p_h) (2π/n)²/8        n nodes of the shortest wave
//! ```
//! The companion runs the same scene, script and passage on half the intervals each way with twice the time
//! step (or four times the tolerance of adaptive steps), so that every part of the error shrinks together.
//! For a scheme of order q the error is `|f(dx) − f(2dx)|/(2^q − 1)`. Reported is three times that, Roache's grid
//! convergence index (1994) for two grids: all of the difference at q = 2. The extremes of a field lie at
//! spikes, constrictions and asperity contacts and were seen to converge with q = 1.3: twice the difference. The
//! maximum pressure at nodes also misses its crest by up to half a spacing, by the same share on both grids
//! when they are unlucky: a quadratic crest of Hertz and of the ripple. The central film of rough bodies is the film of the moment
//! at one place under passing crests, and no smoother than they.
//! `tests/engine/discretisation.rs` compares all of it with true errors on ten scenes.
//!
//! The same two runs give the limit f + (f(dx) − f(2dx))/(2^q − 1) (Richardson), q = 2, or 3 of [`Order::High`], whose
//! central film moves by 3.9 and 1.6 % from 65 to 129 to 257 nodes (default scene); its estimate, too, is all of the
//! difference. The limit is reported beside the value that was computed, never in its place: it is the better one where
//! the sequence is as regular as it is taken to be.
//!
//! The estimate covers mesh and time step. It does not cover the edges of the domain (the plan's own rule),
//! nor what the model leaves out.

use thiserror::Error;

use super::ladder::fewest_wave_nodes;
use super::session::RunError;
use asperity_engine::plan::{Plan, PlanError};
use asperity_engine::scene::{Life, Order, Scene, Warming};
use asperity_engine::sim::Summary;

/// Fewest nodes per side that a run on half the nodes makes sense on.
const FEWEST_NODES: usize = 33;

/// Why there is no estimate.
#[derive(Debug, Clone, Error)]
pub enum NoEstimate {
    /// The scene asks for none.
    #[error("numerics.error_estimate is \"none\"")]
    NotAsked,
    /// The grid cannot be halved.
    #[error("a grid of {0} nodes per side has no coarser one to compare with")]
    TooCoarse(usize),
    /// The coarser grid does not carry the scene's waves.
    #[error("on half the nodes {0}")]
    Unresolved(#[from] PlanError),
    /// The companion came to no end.
    #[error("the companion on half the nodes did not finish")]
    Unfinished,
    /// The companion's thread failed.
    #[error(transparent)]
    Run(#[from] RunError),
}

/// What the maximum pressure at nodes may miss of a crest, as shares.
#[derive(Debug, Clone, Copy)]
struct Crest {
    /// Of the Hertz pressure.
    hertz: f64,
    /// Of what stands out above it.
    ripple: f64,
}

impl Crest {
    fn of(plan: &Plan) -> Self {
        let fewest = fewest_wave_nodes(plan);
        Self {
            hertz: plan.domain.dx_a().powi(2) / 8.0,
            ripple: (std::f64::consts::TAU / fewest).powi(2) / 8.0,
        }
    }
}

/// The companion's scene: the same, on half the intervals of the same rectangle.
pub(super) fn coarser(scene: &Scene, plan: &Plan) -> Result<Scene, NoEstimate> {
    let nodes = (plan.domain.nodes - 1) / 2 + 1;
    if nodes < FEWEST_NODES {
        return Err(NoEstimate::TooCoarse(plan.domain.nodes));
    }
    let mut coarse = scene.clone();
    coarse.grid.nodes = nodes;
    coarse.grid.x_min_a = Some(plan.domain.x_min_a);
    coarse.grid.x_max_a = Some(plan.domain.x_max_a);
    coarse.grid.y_half_a = Some(plan.domain.y_half_b);
    coarse.time.tolerance = scene.time.tolerance.map(|tolerance| 4.0 * tolerance);
    // Two orders would be no sequence.
    coarse.numerics.order = plan.order.into();
    coarse.record = None;
    // Surfaces that age do so on every mesh, and warm oil is warm there; what the mechanics do not hang on is left out.
    if coarse.age.is_none() {
        coarse.wear = None;
    }
    match coarse.warming() {
        Warming::None | Warming::SurfacesAndOil => {}
        Warming::Surfaces => coarse.heat = None,
    }
    Ok(coarse)
}

/// Of the extremes, for an observed order of 1.3: 3/(2^1.3 − 1).
const EXTREMES: f64 = 2.0;

/// Writes the errors into the summary of a run by `plan`, from that of a run on half the nodes; the band of life becomes
/// theirs.
pub(super) fn set_errors(fine: &mut Summary, coarse: &Summary, scene: &Scene, plan: &Plan) {
    let life = |(life, below)| life_error(life, below, scene, plan);
    set_by(fine, coarse, (Crest::of(plan), plan.order), life);
    // Where crests pass, it is one place of a rippled field.
    if scene.surfaces().iter().any(|surface| !surface.is_smooth()) {
        fine.error_h_central_m = fine.error_h_central_m.map(|error| EXTREMES * error);
    }
}

fn set_by(
    fine: &mut Summary,
    coarse: &Summary,
    (crest, order): (Crest, Order),
    life_error: impl Fn((f64, f64)) -> f64,
) {
    let limit = |fine: f64, coarse: f64| limit(fine, coarse, order);
    let apart = |one: f64, two: f64| (one - two).abs();
    fine.error_h_central_m = Some(apart(fine.h_central_m, coarse.h_central_m));
    // Both grids may meet the same minimum film by chance; what the inlet lets in too much or too little is in it all the same.
    let inlet =
        apart(fine.h_central_m, coarse.h_central_m) / fine.h_central_m.max(f64::MIN_POSITIVE);
    let minimum = EXTREMES * apart(fine.h_min_m, coarse.h_min_m);
    fine.error_h_min_m = Some(minimum.max(fine.h_min_m * inlet.min(1.0)));
    let ripple = (fine.p_max_pa - fine.p_hertz_pa).max(0.0);
    let missed = crest.hertz * fine.p_hertz_pa + crest.ripple * ripple;
    fine.error_p_max_pa = Some(EXTREMES * apart(fine.p_max_pa, coarse.p_max_pa) + missed);
    fine.error_contact_ratio = Some(EXTREMES * apart(fine.contact_ratio, coarse.contact_ratio));
    let loads = apart(fine.contact_load_ratio, coarse.contact_load_ratio);
    fine.error_contact_load_ratio = Some(EXTREMES * loads);
    let frictions = apart(fine.friction_coefficient, coarse.friction_coefficient);
    fine.error_friction_coefficient = Some(EXTREMES * frictions);
    let lives = fine.life_relative.zip(coarse.life_relative);
    let unsettled = fine.unsettled_ln_life.unwrap_or(0.0);
    fine.error_ln_life = lives.map(|lives| life_error(lives) + unsettled);
    fine.h_central_extrapolated_m = Some(limit(fine.h_central_m, coarse.h_central_m));
    fine.life_extrapolated = lives.map(|(one, two)| limit(one.ln(), two.ln()).exp());
    if let (Some(life), Some(error)) = (fine.life_relative, fine.error_ln_life) {
        fine.life_relative_low = Some(life * (-error).exp());
        fine.life_relative_high = Some(life * error.exp());
    }
    *fine = std::mem::take(fine).with_cycles_band();
}

/// Part of ln L that the stress of one mesh may miss beside what two meshes are apart: they may agree by chance.
const SAMPLED: f64 = 0.1;

/// Error of ln `life` on a mesh by `plan`, from that on the mesh `below`.
pub(super) fn life_error(life: f64, below: f64, scene: &Scene, plan: &Plan) -> f64 {
    let apart = (life / below).ln().abs();
    let exponent = scene.life.as_ref().map_or(0.0, Life::exponent);
    let ripple = (std::f64::consts::TAU / fewest_wave_nodes(plan)).powi(2) / 48.0;
    apart + (exponent * ripple).min(SAMPLED * life.ln().abs())
}

/// Where a sequence of this order ends.
fn limit(fine: f64, coarse: f64, order: Order) -> f64 {
    let share = match order {
        Order::Second => 3.0,
        Order::High => 7.0,
    };
    fine + (fine - coarse) / share
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_companion_has_the_same_rectangle_and_half_the_nodes() {
        let mut scene = Scene::load(asperity_engine::scene::presets::QUICK).expect("a preset");
        scene.time.tolerance = Some(1e-3);
        let plan = Plan::new(&scene).expect("a plan");
        let coarse = coarser(&scene, &plan).expect("a coarser grid");
        let other = Plan::new(&coarse).expect("a plan");
        assert_eq!(coarse.grid.nodes, 65);
        assert!((other.dx_m / plan.dx_m - 2.0).abs() < 1e-12);
        assert!((other.dy_m / plan.dy_m - 2.0).abs() < 1e-12);
        assert_eq!(other.domain.x_min_a, plan.domain.x_min_a);
        assert_eq!(coarse.time.tolerance, Some(4e-3));
        scene.grid.nodes = 33;
        let plan = Plan {
            domain: asperity_engine::plan::Domain {
                nodes: 33,
                ..plan.domain
            },
            ..plan
        };
        assert!(matches!(
            coarser(&scene, &plan),
            Err(NoEstimate::TooCoarse(33))
        ));
    }

    #[test]
    fn the_band_of_life_is_that_of_the_difference() {
        let mut fine = Summary {
            h_central_m: 1.1,
            life_relative: Some(0.5),
            unsettled_ln_life: Some(0.0),
            ..Summary::default()
        };
        let coarse = Summary {
            h_central_m: 1.0,
            life_relative: Some(0.4),
            ..Summary::default()
        };
        let crest = Crest {
            hertz: 0.0,
            ripple: 0.0,
        };
        let apart = |(one, two): (f64, f64)| (one / two).ln().abs();
        set_by(&mut fine, &coarse, (crest, Order::Second), apart);
        assert!((fine.error_h_central_m.expect("set") - 0.1).abs() < 1e-12);
        assert!((fine.life_relative_low.expect("set") - 0.4).abs() < 1e-12);
        assert!((fine.life_relative_high.expect("set") - 0.625).abs() < 1e-12);
        let limit = (0.5_f64.ln() + (0.5_f64 / 0.4).ln() / 3.0).exp();
        assert!((fine.life_extrapolated.expect("set") - limit).abs() < 1e-12);
        // Both meshes may agree on a mean that is off.
        fine.unsettled_ln_life = Some(2_f64.ln());
        set_by(&mut fine, &coarse, (crest, Order::Second), apart);
        assert!((fine.life_relative_low.expect("set") - 0.2).abs() < 1e-12);
        assert!((fine.life_relative_high.expect("set") - 1.25).abs() < 1e-12);
    }
}
