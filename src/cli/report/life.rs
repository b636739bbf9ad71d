//! What the report says of the life.

use asperity_engine::math::number::{UM, sig};
use asperity_engine::scene::Scene;
use asperity_engine::sim::Summary;

use super::{Lines, known, load};

pub(super) fn add_life(lines: &mut Lines, scene: &Scene, s: &Summary) {
    let Some(life) = s.life_relative else {
        return;
    };
    let band = known(
        s.life_relative_low.zip(s.life_relative_high),
        |(low, high)| format!(" ({} to {})", sig(low, 3), sig(high, 3)),
    );
    let factors = s.cycle_factor.zip(s.peak_factor).zip(s.traction_factor);
    let factors = known(factors, |((cycles, peaks), traction)| {
        let basis = s.basis_factor.unwrap_or(1.0);
        let [cycles, peaks, traction] =
            [cycles / basis, peaks, traction].map(|factor| sig(factor, 3));
        let basis = if (basis - 1.0).abs() > 1e-6 {
            format!(" x basis {}", sig(basis, 3))
        } else {
            String::new()
        };
        format!(" = cycles {cycles} x peaks {peaks} x traction {traction}{basis}")
    });
    lines.add("relative life", format!("{}{band}{factors}", sig(life, 4)));
    lines.add(
        "",
        "relative to the smooth, frictionless contact at S = 0 under the present load and speed",
    );
    if let Some(factor) = s.load_factor.filter(|factor| *factor != 1.0) {
        lines.add(
            "",
            format!(
                "load x {} against the scene's {} and {} m/s; with it the life is {} of the smooth contact's there",
                sig(factor, 3),
                load(scene, scene.force_n()),
                sig(scene.motion.entrainment_m_s, 3),
                sig(life * factor, 3)
            ),
        );
    }
    add_models(lines, s);
    add_absolute(lines, s);
    add_pits(lines, s);
    if let Some(a_iso) = s.a_iso {
        let a_iso = sig(a_iso, 3);
        let what = format!("{a_iso} (for comparison: it contains a roughness penalty of its own)");
        lines.add("ISO 281 a_ISO", what);
    }
    if let Some(ratio) = s.survival_ratio.filter(|ratio| *ratio != 1.0) {
        let ratio = sig(ratio, 3);
        lines.add(
            "",
            format!("at the scene's survival every life is {ratio} of that at 50 %"),
        );
    }
}

/// Both bodies, and the choice of model.
fn add_models(lines: &mut Lines, s: &Summary) {
    let four = |life: f64| sig(life, 4);
    if let (Some(model), Some(body)) = (&s.life_model, s.life_body) {
        let unit = s.life_count.as_deref().unwrap_or_default();
        lines.add("", format!("{model}; body {body} governs; {unit}"));
    }
    if let (Some(global), Some(damage)) = (s.life_global, s.life_damage) {
        let what = format!("paper's count {}, by damage {}", four(global), four(damage));
        lines.add("counts", what);
    }
    if let (Some(one), Some(two)) = (s.life_body_1, s.life_body_2) {
        let system = known(s.life_system, |life| {
            format!("; both as one system, over time: {}", four(life))
        });
        lines.add(
            "bodies",
            format!("body 1 {}, body 2 {}{system}", four(one), four(two)),
        );
    }
    for (label, low, high, over) in [
        (
            "phases",
            s.life_phases_low,
            s.life_phases_high,
            "as the crests of both bodies happen to meet (phase_deg); the band holds it",
        ),
        (
            "oil law",
            s.life_oil_low,
            s.life_oil_high,
            "with the other law of flow of sheared oil (lubricant.eyring_flow), half and twice its Eyring stress",
        ),
    ] {
        if let Some((low, high)) = low.zip(high) {
            lines.add(label, format!("{} to {} {over}", four(low), four(high)));
        }
    }
    let spread = s.life_models_low.zip(s.life_models_high);
    if let (Some((low, high)), Some(count @ 2..)) = (spread, s.life_models) {
        let (low, high) = (four(low), four(high));
        let what = format!("{low} to {high} over {count} choices of cycle basis and model");
        lines.add("model spread", what);
    }
}

fn add_absolute(lines: &mut Lines, s: &Summary) {
    if let (Some(cycles), Some(low), Some(high)) =
        (s.life_cycles, s.life_cycles_low, s.life_cycles_high)
    {
        let what = format!(
            "{cycles:.3e} loading cycles ({low:.2e} to {high:.2e} by the mesh and the choice of count and model)"
        );
        lines.add("absolute life", what);
    } else if let Some((_, why)) = s
        .life_basis
        .as_deref()
        .and_then(|basis| basis.split_once(": "))
    {
        lines.add("absolute life", format!("none: {why}"));
    }
}

/// Where pits start.
fn add_pits(lines: &mut Lines, s: &Summary) {
    let depths = [s.cycles_end_depth_1_m, s.cycles_end_depth_2_m];
    for (body, (pit, depth)) in [s.pit_body_1, s.pit_body_2].iter().zip(depths).enumerate() {
        let Some(pit) = pit else { continue };
        let single = known(depth, |depth_m| {
            format!("; one cycle per passage below {}", UM.show(depth_m, 3))
        });
        let what = format!(
            "body {}: {} deep, {} from a crest, damage of one of its crossings {} times that of the smooth contact's worst point{single}",
            body + 1,
            UM.show(pit.depth_m, 3),
            UM.show(pit.place_m, 3),
            sig(pit.damage, 3)
        );
        lines.add("pit starts", what);
    }
}
