//! A dent that rides through once: films of the smooth contact, and round the dent where the paper shows it.

use super::set::Values;
use asperity_engine::plan::Plan;
use asperity_engine::scene::{Scene, Surface};
use asperity_engine::sim::{Frame, Simulation, Stage};

/// Place of the dent's centre in the paper's figure, m.
const SHOWN_AT_M: f64 = -48e-6;
/// Half-width round the centre in which the dent's film is greatest, and the way downstream to the dip, m.
const DENT_M: f64 = 30e-6;
const DIP_M: f64 = 80e-6;

pub(super) fn dent(scene: &Scene, plan: Plan) -> Result<Values, String> {
    let Surface::HeightMap {
        crop_m: None,
        turn_deg: None,
        s_filter_m: None,
        l_filter_m: None,
        start_x_m: Some(start_m),
        ..
    } = scene.body_1.surface
    else {
        return Err("body 1 has no dent with a start".to_owned());
    };
    let (a_m, dx_m) = (plan.hertz.a_m, plan.dx_m);
    let speed_m_s = scene.speeds_m_s()[0];
    let mut sim = Simulation::new(scene, plan, 1).map_err(|error| error.to_string())?;
    let mut frame = Frame::default();
    let mut values: Values = Vec::new();
    let mut found = None;
    let mut nearest = f64::INFINITY;
    loop {
        sim.step().map_err(|error| error.to_string())?;
        if sim.stage() != Stage::Passage {
            continue;
        }
        if !sim.metrics().converged {
            return Err(format!("step {} did not converge", sim.passage_steps()));
        }
        let centre = start_m + sim.time_s() * speed_m_s;
        if centre > SHOWN_AT_M + dx_m {
            break;
        }
        let is_first = sim.passage_steps() == 1;
        let off = (centre - SHOWN_AT_M).abs();
        if !is_first && off > nearest.min(2.0 * dx_m) {
            continue;
        }
        sim.fill(&mut frame);
        let start = frame.ny / 2 * frame.nx;
        let row = &frame.film_m[start..start + frame.nx];
        let x = |i: usize| frame.x_min_m + i as f64 * frame.dx_m;
        if is_first {
            let exit = greatest(row, -1.0, |i| x(i) > 0.0 && x(i) < 1.1 * a_m);
            values.push(("central", 1e9 * frame.metrics.h_central_m));
            values.push(("exit", -1e9 * exit));
        } else {
            nearest = off;
            let dip = greatest(row, -1.0, |i| x(i) > centre && x(i) < centre + DIP_M);
            let dent = greatest(row, 1.0, |i| (x(i) - centre).abs() < DENT_M);
            found = Some([("dent", 1e9 * dent), ("dip", -1e9 * dip)]);
        }
    }
    values.extend(found.ok_or("the dent was never where it is shown")?);
    Ok(values)
}

/// Greatest of `sign` times the row over chosen nodes, by a parabola.
fn greatest(row: &[f32], sign: f64, chosen: impl Fn(usize) -> bool) -> f64 {
    let at = |i: usize| sign * f64::from(row[i]);
    let highest = (1..row.len().saturating_sub(1))
        .filter(|&i| chosen(i))
        .max_by(|&i, &j| at(i).total_cmp(&at(j)));
    let Some(i) = highest else {
        return f64::NAN;
    };
    let [a, b, c] = [at(i - 1), at(i), at(i + 1)];
    let curvature = a - 2.0 * b + c;
    if curvature < 0.0 {
        b - (c - a).powi(2) / (8.0 * curvature)
    } else {
        b
    }
}
