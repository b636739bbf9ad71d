//! What the report says of the life.

use asperity_engine::math::number::sig;
use asperity_engine::scene::Scene;
use asperity_engine::sim::Summary;

use super::{four, line, load};

pub(super) fn push_life(text: &mut String, scene: &Scene, s: &Summary) {
    let Some(life) = s.life_relative else {
        return;
    };
    let band = match (s.life_relative_low, s.life_relative_high) {
        (Some(low), Some(high)) => format!(" ({} to {})", sig(low, 3), sig(high, 3)),
        _ => String::new(),
    };
    let factors = match (s.cycle_factor, s.peak_factor, s.traction_factor) {
        (Some(cycles), Some(peaks), Some(traction)) => {
            format!(
                " = cycles {} x peaks {} x traction {}",
                sig(cycles, 3),
                sig(peaks, 3),
                sig(traction, 3)
            )
        }
        _ => String::new(),
    };
    line(
        text,
        "relative life",
        &format!("{}{band}{factors}", sig(life, 4)),
    );
    line(
        text,
        "",
        "relative to the smooth, frictionless contact at S = 0 under the present load and speed",
    );
    if let Some(factor) = s.load_factor.filter(|factor| *factor != 1.0) {
        let what = format!(
            "load x {} against the scene's {} and {} m/s; with it the life is {} of the smooth contact's there",
            sig(factor, 3),
            load(scene, scene.force_n()),
            sig(scene.motion.entrainment_m_s, 3),
            sig(life * factor, 3)
        );
        line(text, "", &what);
    }
    push_life_beside(text, s);
    if let Some(ratio) = s.survival_ratio.filter(|ratio| *ratio != 1.0) {
        let ratio = sig(ratio, 3);
        let what = format!("at the scene's survival every life is {ratio} of that at 50 %");
        line(text, "", &what);
    }
}

/// Both bodies, the choice of model, absolute cycles, and where pits start.
fn push_life_beside(text: &mut String, s: &Summary) {
    if let (Some(model), Some(body)) = (&s.life_model, s.life_body) {
        let unit = s.life_count.as_deref().unwrap_or_default();
        let what = format!("{model}; body {body} governs; {unit}");
        line(text, "", &what);
    }
    if let (Some(global), Some(damage)) = (s.life_global, s.life_damage) {
        let what = format!("paper's count {}, by damage {}", four(global), four(damage));
        line(text, "counts", &what);
    }
    if let (Some(one), Some(two)) = (s.life_body_1, s.life_body_2) {
        let system = s
            .life_system
            .map(|life| format!("; both as one system, over time: {}", four(life)))
            .unwrap_or_default();
        let (one, two) = (four(one), four(two));
        let what = format!("body 1 {one}, body 2 {two}{system}");
        line(text, "bodies", &what);
    }
    if let (Some(low), Some(high), Some(count)) =
        (s.life_models_low, s.life_models_high, s.life_models)
        && count > 1
    {
        let (low, high) = (four(low), four(high));
        let what = format!("{low} to {high} over {count} choices of cycle basis and model");
        line(text, "model spread", &what);
    }
    if let (Some(cycles), Some(low), Some(high)) =
        (s.life_cycles, s.life_cycles_low, s.life_cycles_high)
    {
        let what = format!("{cycles:.3e} loading cycles ({low:.2e} to {high:.2e})");
        line(text, "absolute life", &what);
    } else if let Some((_, why)) = s
        .life_basis
        .as_deref()
        .and_then(|basis| basis.split_once(": "))
    {
        line(text, "absolute life", &format!("none: {why}"));
    }
    let depths = [s.cycles_end_depth_1_m, s.cycles_end_depth_2_m];
    for (body, (pit, depth)) in [s.pit_body_1, s.pit_body_2].iter().zip(depths).enumerate() {
        let Some(pit) = pit else { continue };
        let single = depth
            .map(|depth| format!("; one cycle per passage below {} µm", sig(depth * 1e6, 3)))
            .unwrap_or_default();
        let what = format!(
            "body {}: {} µm deep, {} µm from a crest, damage {} times the smooth contact's{single}",
            body + 1,
            sig(pit.depth_m * 1e6, 3),
            sig(pit.place_m * 1e6, 3),
            sig(pit.damage, 3)
        );
        line(text, "pit starts", &what);
    }
    if let Some(a_iso) = s.a_iso {
        let a_iso = sig(a_iso, 3);
        let what = format!("{a_iso} (for comparison: it contains a roughness penalty of its own)");
        line(text, "ISO 281 a_ISO", &what);
    }
}
