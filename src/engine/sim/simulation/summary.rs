//! The summary of a run so far.

use super::ageing::depths_m;
use super::fill::place_m;
use super::present::grounds;
use super::view::View;
use super::watching::life_estimate;
use crate::physics::cycles::BodyId;
use crate::physics::gear_film::gear_film_m;
use crate::physics::iso281::{a_iso_radial_ball, kappa_from_lambda};
use crate::physics::line::LinePoint;
use crate::scene::Knob;
use crate::sim::caution;
use crate::sim::fatigue_stage::LifeStage;
use crate::sim::heat_stage::{self, Warmth};
use crate::sim::pits::Pits;
use crate::sim::summary::{PitHistory, PitStart};
use crate::sim::{LifeEstimate, Stats, Summary};

/// Result so far. What only its run knows (name, clock, steps planned, discretisation error) is left out.
pub(super) fn summary(sim: View, stats: &Stats) -> Summary {
    let m = &sim.state.metrics;
    let size = sim.plan.size_now(&sim.state.drive);
    let hertz = &sim.plan.decided.hertz;
    let life = with_life(
        life_estimate(sim.plan, sim.state).as_ref(),
        sim.state.life.as_ref(),
    );
    let worn = sim.state.worn.as_ref();
    let travelled = sim.state.motion.travelled;
    let depths_m = worn.map_or([None; 2], |worn| depths_m(sim.plan, worn, travelled));
    let pits = [0, 1].map(|body: usize| worn?.known_pits(body));
    let known = Summary {
        steps: sim.state.step,
        a_m: hertz.a_m * size,
        p_hertz_pa: hertz.p_max_pa * size,
        life_smooth: life_smooth(sim),
        cautions: caution::of_run(m, &grounds(sim.plan, sim.state), &sim.plan.decided),
        counters: *stats,
        rq_1_m: m.amplitude_1_m.abs() * sim.plan.rms_shares[0],
        rq_2_m: m.amplitude_2_m.abs() * sim.plan.rms_shares[1],
        cutoff_short_m: sim.plan.scene.cutoff_short_m(),
        map_body_1: sim.plan.decided.maps[0].clone(),
        map_body_2: sim.plan.decided.maps[1].clone(),
        pit_body_1: pit(sim, BodyId::One),
        pit_body_2: pit(sim, BodyId::Two),
        cycles_end_depth_1_m: cycles_end(sim, BodyId::One),
        cycles_end_depth_2_m: cycles_end(sim, BodyId::Two),
        a_iso: a_iso(sim),
        cycles: worn.map(|worn| worn.cycles().0),
        wear_depth_1_m: depths_m[0],
        wear_depth_2_m: depths_m[1],
        pitted_area_1: pits[0].map(Pits::area),
        pitted_area_2: pits[1].map(Pits::area),
        pits_body_1: pits[0].map(|pits| pit_history(sim, pits)),
        pits_body_2: pits[1].map(|pits| pit_history(sim, pits)),
        ages: sim.state.ages.clone(),
        ..life
    };
    let summary = with_heat(sim, sim.state.totals.summary(m, known));
    with_gear_film(sim, summary)
}

/// With the film of a gear's flank by its standard's formula, at the load, speed and amplitudes of now.
fn with_gear_film(sim: View, summary: Summary) -> Summary {
    let (scene, drive) = (&sim.plan.scene, &sim.state.drive);
    let Some(line) = scene.line_point() else {
        return summary;
    };
    let line = LinePoint {
        load_n_per_m: drive.get(Knob::ForceNPerM).now,
        entrainment_m_s: drive.get(Knob::EntrainmentMS).now.abs(),
        ..line
    };
    let flash = summary.flash_temperature_blok_k;
    let thinner = flash.and_then(|flash| scene.thinner(flash)).unwrap_or(1.0);
    let film = gear_film_m(&line, thinner);
    let amplitudes = Knob::AMPLITUDES.map(|knob| drive.get(knob).now.abs());
    let ra = [0, 1].map(|body| amplitudes[body] * sim.plan.mean_shares[body]);
    let ra = 0.5 * (ra[0] + ra[1]);
    Summary {
        h_gf_m: Some(film),
        lambda_gf: (ra > 0.0).then(|| film / ra),
        ..summary
    }
}

/// With what is known of temperatures.
fn with_heat(sim: View, summary: Summary) -> Summary {
    let scene = &sim.plan.scene;
    let warmed = sim.state.warmth.as_ref().and_then(Warmth::warmed);
    let (Some(heat), Some(warmed)) = (&scene.heat, warmed) else {
        return summary;
    };
    let friction = summary.friction_coefficient;
    let blok = heat_stage::blok(scene, friction, summary.a_m, summary.p_hertz_pa);
    let inlet = heat_stage::inlet(scene, summary.p_hertz_pa);
    Summary {
        flash_temperature_max_k: Some(warmed.greatest_k),
        flash_temperature_mean_k: Some(warmed.mean_k),
        contact_temperature_max_k: Some(heat.bulk_k + warmed.greatest_k),
        film_temperature_max_k: Some(heat.bulk_k + warmed.film_k)
            .filter(|_| scene.lubricant.is_some()),
        heat_share_1: Some(warmed.share_1),
        heat_error: Some(warmed.lost),
        flash_temperature_blok_k: Some(blok).filter(|blok| blok.is_finite()),
        inlet_heating_factor: inlet.map(|factors| factors[0]),
        inlet_heating_factor_gupta: inlet.map(|factors| factors[1]),
        ..summary
    }
}

/// What a summary says of the life.
fn with_life(life: Option<&LifeEstimate>, stage: Option<&LifeStage>) -> Summary {
    /// Numbers of the estimate and of its detail, by their names.
    macro_rules! numbers {
        ($($known:ident)*; $($detail:ident)*) => {
            Summary {
                $($known: life.map(|l| l.$known),)*
                $($detail: life.and_then(|l| l.detail.$detail),)*
                ..Summary::default()
            }
        };
    }
    let numbers = numbers!(
        i_ref i_mean cycle_factor stress_factor peak_factor traction_factor load_factor
        life_relative life_relative_low life_relative_high;
        life_system life_global life_damage
    );
    Summary {
        life_common: life.map(LifeEstimate::life_common),
        survival_ratio: stage.map(LifeStage::survival_ratio),
        unsettled_ln_life: life.map(|l| l.detail.unsettled),
        life_model: life.and_then(|l| Some(l.detail.model?.name().to_owned())),
        life_count: stage.map(LifeStage::count_text),
        life_basis: stage.map(LifeStage::basis_text),
        life_body: life.map(|l| l.detail.body),
        life_cause: life.map(LifeEstimate::cause),
        basis_factor: life.map(|l| l.detail.basis_factor),
        life_body_1: life.and_then(|l| l.detail.life_body[0]),
        life_body_2: life.and_then(|l| l.detail.life_body[1]),
        life_models_low: life.map(|l| l.detail.spread_low),
        life_models_high: life.map(|l| l.detail.spread_high),
        life_models: life.map(|l| l.detail.variants),
        life_cycles: life.and_then(|l| l.detail.cycles),
        ..numbers
    }
    .with_cycles_band()
}

/// Life of the smooth contact at the load and speed of now, as [`Summary::life_smooth`] has it; `None`: not known yet.
pub(super) fn life_smooth(sim: View) -> Option<f64> {
    let size = sim.plan.size_now(&sim.state.drive);
    let stage = sim.state.life.as_ref()?;
    stage.smooth_life(&sim.plan.decided.hertz, size)
}

/// Where the pit of a body starts.
fn pit(sim: View, body: BodyId) -> Option<PitStart> {
    let counting = sim.state.counting.as_ref()?;
    let size = sim.plan.size_now(&sim.state.drive);
    let pit = counting.pit(body, size)?;
    let depth = *sim.work.stress.as_ref()?.depths().get(pit.depth)?;
    let length = counting.map(body, size)?.0.spec().length;
    Some(PitStart {
        depth_m: sim.plan.scaling.m_from_x(depth),
        place_m: place_m(sim, pit.place, length),
        damage: pit.damage,
    })
}

/// What a body has suffered in all its cycles.
fn pit_history(sim: View, pits: &Pits) -> PitHistory {
    let (place, depth, damage_max) = pits.worst();
    let (worn, unworn) = (pits.cycles(), pits.unworn_cycles());
    PitHistory {
        damage_max,
        depth_m: sim.plan.scaling.m_from_x(depth),
        place,
        first_cycles: worn.first,
        one_percent_cycles: worn.one_percent,
        ten_percent_cycles: worn.ten_percent,
        unworn_first_cycles: unworn.first,
        unworn_one_percent_cycles: unworn.one_percent,
        unworn_ten_percent_cycles: unworn.ten_percent,
    }
}

/// Depth from which on a crossing counts less than 1.5 cycles of signed shear.
fn cycles_end(sim: View, body: BodyId) -> Option<f64> {
    let counts = sim.state.counting.as_ref()?.shear_counts(body)?;
    let depths = sim.work.stress.as_ref()?.depths();
    let last = counts.iter().rposition(|count| *count >= 1.5);
    let k = last.map_or(0, |k| (k + 1).min(depths.len() - 1));
    Some(sim.plan.scaling.m_from_x(depths[k]))
}

/// a_ISO beside the result, from λ and e_C C_u/P at the load P of now.
fn a_iso(sim: View) -> Option<f64> {
    let m = &sim.state.metrics;
    let load_ratio =
        sim.plan.scene.life.as_ref()?.iso_load_ratio? * sim.plan.decided.force_n / m.load_n;
    a_iso_radial_ball(kappa_from_lambda(m.lambda_ratio?), load_ratio)
}
