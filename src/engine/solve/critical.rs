//! Models that look at one depth: Lundberg-Palmgren, Dang Van and Findley below the line y = 0.
//!
//! The history of a point is the line at its depth, read from one end to the other: the pressure is taken as
//! frozen while the point crosses (exact without ripples; micro-cycles enter by the cycle factor). The result
//! stands at the depth that governs, the others are left empty, so that cycles are taken at that depth.
//!
//! Sources: Lundberg and Palmgren (1947); Dang Van et al. (1989); Findley (1959), as in `physics/life_models.rs`.

use super::stress::{DEPTH_SCALE_A, SliceOut};
use crate::physics::fatigue::LifeLaw;
use crate::physics::life_models::LifeEquation;
use crate::physics::multiaxial::StressPath;

/// ln J of `model` from a slice of `nx` nodes below each of `depths`, into `shares`, one per depth; and the
/// stress of every depth (half range of τ_xz, or risk, p_h) into `by_depth`; `path` is working memory.
pub fn shares_of_slice(
    model: LifeEquation,
    law: LifeLaw,
    (nx, depths): (usize, &[f64]),
    slice: &SliceOut,
    path: &mut StressPath,
    by_depth: &mut [f32],
    shares: &mut [f64],
) {
    shares.fill(f64::NEG_INFINITY);
    for (k, value) in by_depth.iter_mut().enumerate().take(depths.len()) {
        *value = stress_at(model, slice, path, nx, k) as f32;
    }
    let Some(k) = (0..by_depth.len()).max_by(|a, b| by_depth[*a].total_cmp(&by_depth[*b])) else {
        return;
    };
    let (z, stress) = refined(depths, by_depth, k);
    if stress > 0.0 {
        shares[k] = model.ln_at_depth(law, stress, z);
    }
}

fn stress_at(
    model: LifeEquation,
    slice: &SliceOut,
    path: &mut StressPath,
    nx: usize,
    k: usize,
) -> f64 {
    let mut take = || path.take((0..nx).map(|i| slice.state(k * nx + i)));
    match model {
        LifeEquation::DangVan { hydrostatic } => {
            take();
            path.dang_van(hydrostatic)
        }
        LifeEquation::Findley { normal } => {
            take();
            path.findley(normal).0
        }
        LifeEquation::LundbergPalmgren { .. }
        | LifeEquation::Zaretsky
        | LifeEquation::IoannidesHarris { .. } => {
            let row = &slice.sxz[k * nx..(k + 1) * nx];
            let low = row.iter().fold(0.0_f32, |low, v| low.min(*v));
            let high = row.iter().fold(0.0_f32, |high, v| high.max(*v));
            f64::from(0.5 * (high - low))
        }
    }
}

/// The maximum and its depth, by a parabola through three depths in the coordinate in which they lie evenly.
fn refined(depths: &[f64], values: &[f32], k: usize) -> (f64, f64) {
    let here = f64::from(values[k]);
    if k == 0 || k + 1 == values.len() {
        return (depths[k], here);
    }
    let s = |k: usize| (1.0 + depths[k] / DEPTH_SCALE_A).ln();
    let (a, b) = (s(k - 1) - s(k), s(k + 1) - s(k));
    let (fa, fb) = (
        f64::from(values[k - 1]) - here,
        f64::from(values[k + 1]) - here,
    );
    let curve = (fa / a - fb / b) / (a - b);
    let slope = fa / a - curve * a;
    if curve >= 0.0 {
        return (depths[k], here);
    }
    let shift = (-0.5 * slope / curve).clamp(a, b);
    let z = DEPTH_SCALE_A * ((s(k) + shift).exp() - 1.0);
    (z, here + shift * (slope + curve * shift))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_in_stretched_depth_is_found() {
        let depths = [0.1, 0.2, 0.35, 0.6];
        let s = |z: f64| (1.0 + z / DEPTH_SCALE_A).ln();
        let top = s(0.27);
        let values = depths.map(|z| (1.0 - 0.3 * (s(z) - top).powi(2)) as f32);
        let (z, value) = refined(&depths, &values, 2);
        assert!((z - 0.27).abs() < 1e-4 && (value - 1.0).abs() < 1e-6);
        assert_eq!(refined(&depths, &values, 3).0, 0.6);
    }
}
