//! Slopes of films that close or are about to open: where Newton's tangent misleads.
//!
//! ```text
//! own film of a node, the others frozen:  ρ̄H + N (x³) − C* = 0,   x = H_new/H,   N = F − ρ̄H + C* (net outflow)
//! closing (F > 0, N > 0)   ∂q/∂H ← ρ̄H²(1 + x + x²): the secant of q = ρ̄H³ between H and xH, not the tangent 3ρ̄H²
//! opening (N < 0)          pivot ∂F/∂P + K00 ∂F/∂H ≥ θ ρ̄K00, by raising ∂F/∂H
//! ```
//! *Closing.* A film that flows off like H³ has a triple root: the tangent takes a third of it at a time. The secant
//! to where the node alone would balance takes it at once, and since the flow through a face is changed for
//! both of its nodes no oil is lost (a factor on the residual instead, which each node has for itself, loses it and
//! diverges). At the solution x = 1 and the secant is the tangent, so the order of convergence stays.
//!
//! *Opening.* Oil that comes in through a node's own thin film makes F fall with H: the pivot changes sign, and
//! Newton walks away from the root or stands still before the hill between. Behind the hill the pressure stops the
//! inflow. With a pivot kept positive the node climbs over.
//!
//! Newton and Krylov iterations a step of the default scene on 129² nodes, tangent → secant → both (first passage):
//! U = 0.5 m/s 2.6 14.6 → 2.7 14.6 → 2.7 14.6; 0.01 m/s 4.9 34.9 → 4.3 32.5 → 4.3 32.2; 1e-3 m/s 7.7 49.9 → 6.1 43.4
//! → 6.1 43.6; 1e-4 m/s 12.7 116.8 → 10.7 102.4 → 8.3 71.5, and 40 → 47 → 4 steps taken twice. With both, a first guess by
//! dry contact of the oil-filled gap, which all this did before, saves a twentieth of the iterations and costs more.
//!
//! Tried and left: the root with the node's own change of pressure in it (a quartic; the same), the face's conductance
//! too at the balanced film (the inlet, where pressure gives way and not the film, then takes twice the iterations).
//!
//! Ours: derived above, from the balance of one node with its neighbours frozen.

/// Newton iterations for x, from 1 downwards: each value lies between the root and the one before.
const ITERATIONS: usize = 5;
/// θ: 0.2, 0.3 and 0.5 do as well (69.2, 70.8 and 69.4 Krylov iterations at U = 1e-4 m/s).
const LEAST_PIVOT: f32 = 0.3;

dispatched! {
/// ∂q/∂P and ∂q/∂H of a run of nodes, the latter secant where the film closes.
pub(super) fn conductance_slopes(
    rho: &[f64],
    rho_p: &[f64],
    h: &[f64],
    f: &[f64],
    c_star: &[f64],
    q_p: &mut [f64],
    q_h: &mut [f64],
) {
    let n = rho.len();
    let (rho_p, h, f, c_star) = (&rho_p[..n], &h[..n], &f[..n], &c_star[..n]);
    let (q_p, q_h) = (&mut q_p[..n], &mut q_h[..n]);
    for i in 0..n {
        let open = h[i].max(0.0);
        let square = open * open;
        let stored = rho[i] * open;
        let out = f[i] - rho[i] * h[i] + c_star[i];
        let closes = f[i] > 0.0 && out > 0.0;
        let (stored, out, left) = if closes { (stored, out, c_star[i]) } else { (1.0, 0.0, 1.0) };
        let x = balanced_film(stored, out, left);
        q_p[i] = rho_p[i] * square * open;
        q_h[i] = rho[i] * square * (1.0 + x + x * x);
    }
}
}

/// Root of `stored x + out x³ = left`, for `stored + out ≥ left ≥ 0`: at least the root and at most 1.
#[inline(always)]
fn balanced_film(stored: f64, out: f64, left: f64) -> f64 {
    let mut x = 1.0;
    for _ in 0..ITERATIONS {
        let cubic = out * x * x;
        x = (2.0 * cubic * x + left) / (stored + 3.0 * cubic);
    }
    x
}

dispatched! {
/// Raises ∂F/∂H of a row until the pivots are positive.
pub(super) fn keep_rising(rho: &[f64], k00: f64, own_p: &[f32], own_h: &mut [f32]) {
    let n = rho.len();
    let (own_p, own_h) = (&own_p[..n], &mut own_h[..n]);
    let k00 = k00 as f32;
    for i in 0..n {
        let least = LEAST_PIVOT * rho[i] as f32 - own_p[i] / k00;
        own_h[i] = if own_h[i] < least { least } else { own_h[i] };
    }
}
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_balanced_film_lies_between_the_root_and_one() {
        for (stored, out, left) in [
            (1.0, 0.0, 0.3),
            (1.0, 5.0, 0.1),
            (0.01, 9.0, 0.0),
            (1.0, 0.1, 1.1),
        ] {
            let x = balanced_film(stored, out, left);
            assert!((0.0..=1.0 + 1e-12).contains(&x), "{x}");
            assert!(
                stored * x + out * x * x * x >= left - 1e-12,
                "{stored} {out} {left}: {x}"
            );
        }
        // Without flow in one go; at the solution not at all.
        assert!((balanced_film(2.0, 0.0, 0.5) - 0.25).abs() < 1e-15);
        assert!((balanced_film(2.0, 3.0, 5.0) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn slopes_are_tangents_but_where_films_close() {
        let (rho, h, c) = ([1.2; 3], [0.5; 3], [0.1; 3]);
        // Opens; closes by flow; closes against an inflow.
        let f = [-0.2, 4.0, 0.3];
        let (mut q_p, mut q_h) = ([0.0; 3], [0.0; 3]);
        conductance_slopes(&rho, &[0.1; 3], &h, &f, &c, &mut q_p, &mut q_h);
        let tangent = 3.0 * 1.2 * 0.25;
        assert!((q_h[0] - tangent).abs() < 1e-15 && (q_h[2] - tangent).abs() < 1e-15);
        assert!(q_h[1] < 0.6 * tangent && q_h[1] > tangent / 3.0, "{q_h:?}");
        assert!((q_p[1] - 0.1 * 0.125).abs() < 1e-15);
    }

    #[test]
    fn pivots_are_kept_positive() {
        let (k00, own_p) = (0.05, [0.01_f32, 0.01, 0.2]);
        let mut own_h = [1.0_f32, -3.0, -3.0];
        keep_rising(&[1.0; 3], k00, &own_p, &mut own_h);
        assert!((own_h[0] - 1.0).abs() < 1e-7 && (own_h[2] + 3.0).abs() < 1e-6);
        let pivot = own_p[1] + own_h[1] * k00 as f32;
        assert!((pivot - LEAST_PIVOT * 0.05).abs() < 1e-7, "{pivot}");
    }
}
