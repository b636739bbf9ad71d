//! What material points of a scene count.

use super::counting::CountingSpec;
use super::scaling::Heading;
use crate::plan::Plan;
use crate::scene::Scene;

/// What material points count.
pub(super) fn counting_spec(
    scene: &Scene,
    plan: &Plan,
    heading: Heading,
    depths: usize,
) -> CountingSpec {
    let life = scene.life.as_ref();
    let equation = life.map(|life| (life.equation(life.model, plan.hertz.p_max_pa), life.law()));
    let limit = equation.and_then(|(equation, law)| equation.stress_law(law));
    let maps = life.map_or([false; 2], crate::scene::Life::maps);
    let a_m = plan.hertz.a_m;
    let track = plan.domain.x_max_a - plan.domain.x_min_a;
    let surfaces = scene.surfaces();
    let block = |body: usize| {
        let repeated = surfaces[body].block_m();
        repeated.map_or((track, 0.0), |(length_m, offset_m)| {
            (length_m / a_m, heading.sign() * offset_m / a_m)
        })
    };
    CountingSpec {
        depths,
        exponent: equation.map_or(9.0, |(equation, law)| equation.life_exponent(law)),
        blocks: [0, 1]
            .map(|body: usize| (maps[body] && surfaces[body].has_block()).then(|| block(body))),
        laws: None,
        pits: [None; 2],
        limit: limit.map_or(0.0, |(_, limit)| limit),
        waves: plan.waves.map(|wave| {
            let crests = wave?.crests_per_m;
            (crests > 0.0).then(|| 1.0 / (crests * a_m))
        }),
    }
}
