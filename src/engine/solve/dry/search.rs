//! One search of the conjugate gradients: where to, how far, and the step.
//!
//! ```text
//! t = z + β t_old on C,   β = max(∬ z (r − r_old) / ∬ t_old r_old, 0)       anew: β = 0
//! τ = ∬ t r / ∬ t Kt,     P ← min(max(P − τ t, 0), P_H),   K P ← K P − τ Kt,  both brought to the load
//! ```
//!
//! Part of `dry.rs`. Source of β: Polak and Ribière (1969), Rev. Fr. Inform. Rech. Oper. 3, 35-43.

use super::{Dry, DryProblem};
use crate::math::grid::Grid;
use crate::solve::film::Elastic;
use crate::solve::newton::Iterate;

impl Dry {
    /// The next direction; `anew`: steepest descent.
    pub(super) fn turn(&mut self, grid: &Grid, anew: bool) {
        let beta = if anew {
            0.0
        } else {
            // Not Fletcher and Reeves: the preconditioner is not exactly the same from set to set.
            let (r, old, z) = (&self.residual, &self.residual_old, &self.z);
            let new = grid.integrate(|n| f64::from(z[n]) * f64::from(r[n] - old[n]));
            let t = &self.direction;
            let before = grid.integrate(|n| f64::from(t[n]) * f64::from(old[n]));
            (new / before).max(0.0)
        };
        let beta = if beta.is_finite() { beta as f32 } else { 0.0 };
        for ((t, &z), &inside) in self.direction.iter_mut().zip(&self.z).zip(&self.in_contact) {
            // What is left of another solution may be anything, and no factor makes it nothing.
            let old = if beta == 0.0 { 0.0 } else { beta * *t };
            *t = if inside { z + old } else { 0.0 };
        }
    }

    /// K t, and the length of the step to the lowest energy along t.
    pub(super) fn line(&mut self, elastic: &mut Elastic, grid: &Grid) -> f64 {
        elastic.deflect_single(&self.direction, &mut self.image);
        let (t, r, image) = (&self.direction, &self.residual, &self.image);
        let slope = grid.integrate(|n| f64::from(t[n]) * f64::from(r[n]));
        let curvature = grid.integrate(|n| f64::from(t[n]) * f64::from(image[n]));
        slope / curvature
    }

    /// P − τ t, cut at its bounds and brought to the load; whether anything was cut.
    pub(super) fn walk(&mut self, problem: &DryProblem, iterate: &mut Iterate, tau: f64) -> bool {
        let (mut cut, hardness) = (false, self.hardness);
        for ((p, u), (&t, &image)) in iterate
            .p
            .iter_mut()
            .zip(&mut self.deflection)
            .zip(self.direction.iter().zip(&self.image))
        {
            if t != 0.0 {
                *p -= tau * f64::from(t);
                if *p < 0.0 {
                    *p = 0.0;
                    cut = true;
                } else if *p > hardness {
                    *p = hardness;
                    cut = true;
                }
            }
            *u -= tau * f64::from(image);
        }
        if hardness.is_finite() {
            // What is at the bound cannot be scaled, so K P is not scaled with it.
            return cut;
        }
        let scale = problem.load / self.total(problem.grid, iterate.p);
        for (p, u) in iterate.p.iter_mut().zip(&mut self.deflection) {
            *p *= scale;
            *u *= scale;
        }
        cut
    }
}
