//! Fluidity of the nodes: what sheared oil grants the pressure's flow, along the sliding and across it.
//!
//! ```text
//! secant         g = (1/η̄) ζ/asinh ζ                                  both ways
//! along, across  g_x = cosh σ/η̄,   g_y = sinh σ/(σ η̄),   σ = min(asinh ζ, ℓP)
//! ζ = Z η̄/H,     ∂ ln g/∂P = f' ∂σ/∂P − ∂ ln η̄/∂P,   ∂ ln g/∂H = f' ∂σ/∂H
//! ```
//! | symbol | meaning | shape |
//! |---|---|---|
//! | g | 1/η̄*, of which the faces take the logarithmic mean | ny × nx |
//! | Z, ζ, σ, ℓ | as in `physics/fluid.rs` | |
//!
//! Both bodies move along x, so x is the direction of the sliding everywhere and the flow has no cross terms. Sliding at
//! an angle φ to x would make of g a tensor, g_x cos²φ + g_y sin²φ on ∂P/∂x and (g_x − g_y) sin φ cos φ on ∂P/∂y in the
//! flow along x: the corners of the nine-point star, of which the stencil (`jacobian.rs`) has five.
//!
//! Where ℓP is the less the film shears at the limiting stress and the derivative is that branch's; the kink between the
//! two is one that Newton's iteration passes as it does that of P ≥ 0. Without sliding and of Newtonian oil both
//! fluidities are 1/η̄, and one is kept. Tests: `reynolds.rs` (the linearisation is the derivative), `tests/engine/eyring.rs`.

use rayon::prelude::*;

use super::faces::{Nodes, Slopes};
use super::reynolds::Medium;
use crate::math::elementary::{asinh, exp};
use crate::math::grid::{Grid, Symmetry};
use crate::physics::fluid::{
    ShearedFlow, Viscosity, eyring_across, eyring_along, eyring_ln_factor,
};

/// g of all nodes in one direction, its logarithm and the logarithm's derivatives by P and H.
struct Values {
    g: Vec<f64>,
    ln_g: Vec<f64>,
    ln_g_p: Vec<f64>,
    ln_g_h: Vec<f64>,
}

impl Values {
    fn new(n: usize) -> Self {
        let zero = vec![0.0; n];
        Self {
            g: zero.clone(),
            ln_g: zero.clone(),
            ln_g_p: zero.clone(),
            ln_g_h: zero,
        }
    }

    /// The values in blocks of `block` nodes.
    fn blocks(&mut self, block: usize) -> impl IndexedParallelIterator<Item = Rows<'_>> {
        self.g
            .par_chunks_mut(block)
            .zip(self.ln_g.par_chunks_mut(block))
            .zip(self.ln_g_p.par_chunks_mut(block))
            .zip(self.ln_g_h.par_chunks_mut(block))
            .map(|(((g, ln_g), ln_g_p), ln_g_h)| Rows {
                g,
                ln_g,
                ln_g_p,
                ln_g_h,
            })
    }
}

/// A run of nodes of [`Values`].
struct Rows<'a> {
    g: &'a mut [f64],
    ln_g: &'a mut [f64],
    ln_g_p: &'a mut [f64],
    ln_g_h: &'a mut [f64],
}

/// Way of a pressure flow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Way {
    /// Between neighbours along x.
    Along,
    /// Between neighbours along y.
    Across,
}

/// Fluidities of the current iterate.
pub(super) struct Fluidity {
    /// Along x; of oil that flows alike in both directions both.
    along: Values,
    /// Along y, where it differs; no room before it is asked for.
    across: Option<Values>,
    /// Whether `across` is meant.
    is_directed: bool,
}

impl Fluidity {
    /// Room for `n` nodes.
    pub(super) fn new(n: usize) -> Self {
        Self {
            along: Values::new(n),
            across: None,
            is_directed: false,
        }
    }

    /// Fluidities at P and H, in blocks of `block` nodes.
    pub(super) fn evaluate(
        &mut self,
        grid: &Grid,
        medium: &Medium,
        p: &[f64],
        h: &[f64],
        block: usize,
    ) {
        let limit = match medium.sheared {
            ShearedFlow::AlongAcross { limit } => Some(limit),
            ShearedFlow::Secant => None,
        };
        let two = limit.is_some() && grid.symmetry != Symmetry::Line;
        if two && self.across.is_none() {
            // Made with the first evaluation, sliding or not: a knob that starts the sliding finds it.
            self.across = Some(Values::new(grid.len()));
        }
        self.is_directed = two && medium.sliding > 0.0;
        let states = || p.par_chunks(block).zip(h.par_chunks(block));
        let along = self.along.blocks(block).zip(states());
        match (limit.filter(|_| medium.sliding > 0.0), &mut self.across) {
            (None, _) => along.for_each(|(along, (p, h))| one_values(medium, p, h, along)),
            (Some(limit), Some(across)) if two => {
                let both = along.zip(across.blocks(block));
                both.for_each(|((along, (p, h)), across)| {
                    directed_values(medium, limit, p, h, along, across);
                });
            }
            (Some(limit), _) => {
                along.for_each(|(along, (p, h))| along_values(medium, limit, p, h, along));
            }
        }
    }

    fn of(&self, way: Way) -> &Values {
        match (way, &self.across) {
            (Way::Across, Some(across)) if self.is_directed => across,
            _ => &self.along,
        }
    }

    /// What faces need of the nodes in `range`; `q` is ρ̄H³ of all nodes.
    pub(super) fn nodes<'a>(
        &'a self,
        way: Way,
        q: &'a [f64],
        range: std::ops::Range<usize>,
    ) -> Nodes<'a> {
        let Values { g, ln_g, .. } = self.of(way);
        Nodes {
            q: &q[range.clone()],
            g: &g[range.clone()],
            ln_g: &ln_g[range],
        }
    }

    /// What their derivatives need; `q_p` and `q_h` are those of ρ̄H³ of all nodes.
    pub(super) fn slopes<'a>(
        &'a self,
        way: Way,
        (q_p, q_h): (&'a [f64], &'a [f64]),
        range: std::ops::Range<usize>,
    ) -> Slopes<'a> {
        let Values { ln_g_p, ln_g_h, .. } = self.of(way);
        Slopes {
            q_p: &q_p[range.clone()],
            q_h: &q_h[range.clone()],
            ln_g_p: &ln_g_p[range.clone()],
            ln_g_h: &ln_g_h[range],
        }
    }
}

/// `ln η̄` and its slope of a run of nodes; one loop a law, so that the law is no branch inside of it.
#[inline(always)]
fn viscosities(law: Viscosity, p: &[f64], ln_eta: &mut [f64], slope: &mut [f64]) {
    let n = p.len();
    let (ln_eta, slope) = (&mut ln_eta[..n], &mut slope[..n]);
    if let law @ Viscosity::Barus { .. } = law {
        for i in 0..n {
            (ln_eta[i], slope[i]) = law.ln_eta(p[i]);
        }
    } else {
        for i in 0..n {
            (ln_eta[i], slope[i]) = law.ln_eta(p[i]);
        }
    }
}

dispatched! {
/// One fluidity for both directions: the secant of Eyring's law, or Newtonian.
fn one_values(medium: &Medium, p: &[f64], h: &[f64], out: Rows) {
    let n = p.len();
    let (h, g, ln_g) = (&h[..n], &mut out.g[..n], &mut out.ln_g[..n]);
    let (ln_g_p, ln_g_h) = (&mut out.ln_g_p[..n], &mut out.ln_g_h[..n]);
    viscosities(medium.viscosity, p, ln_g, ln_g_p);
    if medium.sliding > 0.0 {
        for i in 0..n {
            let (ln_eta, slope) = (ln_g[i], ln_g_p[i]);
            // A closed gap conducts nothing, whatever its viscosity.
            let open = if h[i] > 0.0 { h[i] } else { 1.0 };
            let (factor, by_zeta) = eyring_ln_factor(medium.sliding / open * exp(ln_eta));
            ln_g[i] = factor - ln_eta;
            ln_g_p[i] = slope * (by_zeta - 1.0);
            ln_g_h[i] = if h[i] > 0.0 { -by_zeta / open } else { 0.0 };
            g[i] = exp(ln_g[i]);
        }
    } else {
        for i in 0..n {
            ln_g[i] = -ln_g[i];
            ln_g_p[i] = -ln_g_p[i];
            ln_g_h[i] = 0.0;
            g[i] = exp(ln_g[i]);
        }
    }
}
}

/// σ, ∂σ/∂P and ∂σ/∂H of a node.
#[inline(always)]
fn shear(
    (sliding, limit): (f64, f64),
    (ln_eta, slope): (f64, f64),
    p: f64,
    h: f64,
) -> (f64, f64, f64) {
    // A closed gap conducts nothing, whatever its viscosity.
    let open = if h > 0.0 { h } else { 1.0 };
    let zeta = sliding / open * exp(ln_eta);
    let free = asinh(zeta);
    let most = limit * p.max(0.0);
    // dσ/d ln ζ = ζ/√(1 + ζ²), which is 1 to rounding beyond 1e8.
    let cut = zeta.min(1e8);
    let by_ln_zeta = cut / (1.0 + cut * cut).sqrt();
    let by_h = if h > 0.0 { -by_ln_zeta / open } else { 0.0 };
    if free < most {
        (free, by_ln_zeta * slope, by_h)
    } else {
        (most, limit, 0.0)
    }
}

dispatched! {
/// The fluidity along the sliding alone: of a line.
fn along_values(medium: &Medium, limit: f64, p: &[f64], h: &[f64], out: Rows) {
    let n = p.len();
    let (h, g, ln_g) = (&h[..n], &mut out.g[..n], &mut out.ln_g[..n]);
    let (ln_g_p, ln_g_h) = (&mut out.ln_g_p[..n], &mut out.ln_g_h[..n]);
    viscosities(medium.viscosity, p, ln_g, ln_g_p);
    for i in 0..n {
        let (ln_eta, slope) = (ln_g[i], ln_g_p[i]);
        let (sigma, by_p, by_h) = shear((medium.sliding, limit), (ln_eta, slope), p[i], h[i]);
        let (factor, by_sigma) = eyring_along(sigma);
        ln_g[i] = factor - ln_eta;
        ln_g_p[i] = by_sigma * by_p - slope;
        ln_g_h[i] = by_sigma * by_h;
        g[i] = exp(ln_g[i]);
    }
}
}

dispatched! {
/// Both fluidities.
fn directed_values(medium: &Medium, limit: f64, p: &[f64], h: &[f64], along: Rows, across: Rows) {
    let n = p.len();
    let (h, x, y) = (&h[..n], along, across);
    let (x_g, x_ln, y_g, y_ln) = (&mut x.g[..n], &mut x.ln_g[..n], &mut y.g[..n], &mut y.ln_g[..n]);
    let (x_p, x_h, y_p, y_h) = (&mut x.ln_g_p[..n], &mut x.ln_g_h[..n], &mut y.ln_g_p[..n], &mut y.ln_g_h[..n]);
    viscosities(medium.viscosity, p, x_ln, x_p);
    for i in 0..n {
        let (ln_eta, slope) = (x_ln[i], x_p[i]);
        let (sigma, by_p, by_h) = shear((medium.sliding, limit), (ln_eta, slope), p[i], h[i]);
        let (x_factor, x_slope) = eyring_along(sigma);
        let (y_factor, y_slope) = eyring_across(sigma);
        x_ln[i] = x_factor - ln_eta;
        x_p[i] = x_slope * by_p - slope;
        x_h[i] = x_slope * by_h;
        x_g[i] = exp(x_ln[i]);
        y_ln[i] = y_factor - ln_eta;
        y_p[i] = y_slope * by_p - slope;
        y_h[i] = y_slope * by_h;
        y_g[i] = exp(y_ln[i]);
    }
}
}
