//! Normal deflection by traction, u^s: zero for bodies of equal elastic constants.
//!
//! ```text
//! u^s_ij = Σ_kl S_(i−k)(j−l) q_kl,   S = κ_s [½ y ln(x² + y²) + x atan(y/x)] at the four corners of a cell
//! κ_s = (Rx p_h/a) [(1+ν1)(1−2ν1)/E1 − (1+ν2)(1−2ν2)/E2]/(2π)
//! ```
//! | symbol | meaning | shape |
//! |---|---|---|
//! | q | traction on body 1 along +x (body 2 carries −q) | ny × nx |
//! | S | odd in x, even in y | |
//!
//! A line is the limit of strips of infinite length: S = κ_s π dx ahead of the cell, 0 below its middle.
//!
//! The gap opens ahead of and closes behind a loaded patch. Sources: Johnson, Contact Mechanics (1985),
//! eq. 3.71 ff. (Cerruti); the frequency response is −2βQ/(E*k), β Dundurs' constant.

use crate::math::filter::{Filter, Padding};
use crate::math::grid::{Grid, Symmetry};
use crate::solve::traction::TractionLaw;

/// The filter q → u^s.
pub struct Tangential {
    filter: Filter<f64>,
}

/// `∬ x/(x² + y²) dx dy` over a cell `dx` x `dy` seen from distance (x, y): the bracket at the corners.
fn cell(x: f64, y: f64, dx: f64, dy: f64) -> f64 {
    let corner = |u: f64, v: f64| {
        let r2 = u * u + v * v;
        let log = if v == 0.0 { 0.0 } else { 0.5 * v * r2.ln() };
        let turn = if u == 0.0 { 0.0 } else { u * (v / u).atan() };
        log + turn
    };
    let (xp, xm, yp, ym) = (x + dx / 2.0, x - dx / 2.0, y + dy / 2.0, y - dy / 2.0);
    corner(xp, yp) + corner(xm, ym) - corner(xp, ym) - corner(xm, yp)
}

impl Tangential {
    /// Plans the filter with stiffness `kappa_s`.
    pub fn new(grid: &Grid, kappa_s: f64) -> Self {
        let mut filter = Filter::new(grid, Padding::Doubled, 1).odd_in_x();
        let (dx, dy) = (grid.dx, grid.dy);
        let kernel = filter.transform_kernel(|i, j| {
            kappa_s
                * match grid.symmetry {
                    Symmetry::Line => std::f64::consts::PI * dx,
                    Symmetry::MirrorY | Symmetry::General => {
                        cell(i as f64 * dx, j as f64 * dy, dx, dy)
                    }
                }
        });
        filter.set_kernel(0, &kernel);
        Self { filter }
    }

    /// `out = S q`, the opening of the gap.
    pub fn deflect(&mut self, q: &[f64], out: &mut [f64]) {
        self.filter.apply(q, out);
    }
}

/// Deflection by traction and its fields.
///
/// ```text
/// in iterations of Newton's     H = H_e + u^s,  u^s held          H_e: gap and deflection by pressure
/// once they have converged      u^s ← u^s + ω r,  r = S q(P, H) − u^s,   and on, until |r| is a part of the film below the tolerance
///                               ω ← ω r'·(r' − r)/|r' − r|²       r': what u^s lacked when it last followed
/// ```
/// u^s belongs to the iterate (of a step that begins it is the last step's, which the state holds), so that what a step
/// gives does not depend on what was evaluated before it. A first guess that is extrapolated brings its own; the last
/// step's pressure keeps the last step's, which is in balance with it.
///
/// Why its derivative is not part of the linearisation. Where the flow holds the film, what a change of u^s meets is the
/// pressure, which yields by βμ of it, and the traction by as much: r falls by a factor of 15 to 60 each time it is
/// followed, and a derivative could save no more than the solutions in between (unlike contacts beside like ones:
/// `random_scenes::unlike_scenes_beside_like_ones`). Where films are all but nothing, the traction's answer to the film,
/// S ∂q/∂H, is greater than 1 and has kinks at every node that comes to touch or to its limiting stress. Newton's method for
/// P and u^s at once was built (Krylov vectors of both, block-triangular preconditioner, r in the merit): the mixed
/// case of `work_counters` took 582 instead of 589 Newton iterations and 11 % more transforms; of the thirteen thin scenes of
/// that test it solved two, where what stands here solves seven, because the kinks of both laws met in one search.
///
/// Nor does u^s follow before the iterations have converged: of films that are far from solved it follows what they will not
/// be (three of the thirteen fewer). Sources: Irons and Tuck (1969), Int. J. Numer. Methods Eng. 1, 275-277, for ω of one
/// unknown; Küttler and Wall (2008), Comput. Mech. 43, 61-72, eq. 44, of many.
pub struct Shear {
    tangential: Tangential,
    traction: Vec<f64>,
    /// S q.
    next: Vec<f64>,
    /// u^s of the iterate.
    deflection: Vec<f64>,
    /// ω.
    share: f64,
    /// r when it last followed.
    lacked: Vec<f64>,
    /// Whether it has followed in this step.
    has_followed: bool,
    /// Nodes of a row and the distance between them.
    nx: usize,
    dx: f64,
}

/// Least ω: where r turns round rather than falls; a safeguard, untuned.
const LEAST_SHARE: f64 = 0.125;

/// What the deflection by traction follows from, beside the iterate.
#[derive(Clone, Copy)]
pub struct Sheared<'a> {
    /// Traction law.
    pub law: &'a TractionLaw,
    /// u^s of the last step.
    pub deflection: &'a [f64],
    /// Its film.
    pub film: &'a [f64],
    /// By how much ln η̄ of warm oil is shifted; empty: it is cold.
    pub shift: &'a [f64],
    /// Whether the first guess keeps that u^s, or brings its own.
    pub keeps: bool,
}

impl Shear {
    /// Buffers for `grid`.
    pub fn new(grid: &Grid, tangential: Tangential) -> Self {
        let zero = vec![0.0; grid.len()];
        Self {
            tangential,
            traction: zero.clone(),
            next: zero.clone(),
            deflection: zero.clone(),
            share: 1.0,
            lacked: zero,
            has_followed: false,
            nx: grid.nx,
            dx: grid.dx,
        }
    }

    /// u^s of the iterate.
    pub(super) fn deflection(&self) -> &[f64] {
        &self.deflection
    }

    /// Transforms made so far.
    pub(super) fn transforms(&self) -> u64 {
        self.tangential.filter.transforms()
    }

    /// A step begins at the last one's u^s.
    pub(super) fn begin(&mut self, before: &[f64]) {
        self.deflection.copy_from_slice(before);
        self.share = 1.0;
        self.has_followed = false;
    }

    /// ω of the traction that was found last.
    pub(super) fn set_share(&mut self) {
        let (mut along, mut square) = (0.0, 0.0);
        let fields = self.next.iter().zip(&self.deflection);
        for ((next, u), lacked) in fields.zip(&mut self.lacked) {
            let lacks = next - u;
            let less = *lacked - lacks;
            along += *lacked * less;
            square += less * less;
            *lacked = lacks;
        }
        if self.has_followed && square > 0.0 {
            self.share = (self.share * along / square).clamp(LEAST_SHARE, 1.0);
        }
        self.has_followed = true;
    }

    /// Adds u^s to the gap of a dry contact, where the traction follows from the pressure alone.
    pub(super) fn add_to_dry(&mut self, law: &TractionLaw, p: &[f64], gap: &mut [f64]) {
        for (q, &p) in self.traction.iter_mut().zip(p) {
            *q = law.traction(p, 0.0);
        }
        self.tangential
            .deflect(&self.traction, &mut self.deflection);
        self.add_to(gap);
    }

    /// Adds the u^s that is held.
    pub(super) fn add_to(&self, h: &mut [f64]) {
        for (h, &u) in h.iter_mut().zip(&self.deflection) {
            *h += u;
        }
    }

    /// Finds u^s of the traction that pressure and film make; the residual: what the iterate lacks of it, over the film where there is
    /// pressure (`least`: of films below it).
    pub(super) fn aim(&mut self, sheared: &Sheared, p: &[f64], h: &[f64], least: f64) -> f64 {
        let law = sheared.law;
        for (n, q) in self.traction.iter_mut().enumerate() {
            let inside = (1..self.nx - 1).contains(&(n % self.nx));
            let rise = if inside { p[n + 1] - p[n - 1] } else { 0.0 };
            let touches = sheared.film[n] <= law.contact_film;
            let shift = sheared.shift.get(n).copied().unwrap_or(0.0);
            *q = law.traction_of(p[n], h[n], 0.5 * rise / self.dx, shift, touches);
        }
        self.tangential.deflect(&self.traction, &mut self.next);
        let (mut residual, mut film) = (0.0, f64::MIN_POSITIVE);
        for n in (0..p.len()).filter(|&n| p[n] > 0.0) {
            residual += (self.next[n] - self.deflection[n]).abs();
            film += h[n].max(least);
        }
        residual / film
    }

    /// Follows it, ω of the residual, and takes the film along.
    pub(super) fn follow(&mut self, h: &mut [f64]) {
        for ((h, u), &next) in h.iter_mut().zip(&mut self.deflection).zip(&self.next) {
            let step = self.share * (next - *u);
            *u += step;
            *h += step;
        }
    }

    /// What is left of the residual.
    pub(super) fn lacking(&self, residual: f64) -> f64 {
        (1.0 - self.share) * residual
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cell_integral_is_the_integral() {
        let (x, y, dx, dy) = (0.3, -0.2, 0.15, 0.11);
        let n = 400;
        let mut sum = 0.0;
        for i in 0..n {
            for j in 0..n {
                let u = x - dx / 2.0 + dx * (i as f64 + 0.5) / n as f64;
                let v = y - dy / 2.0 + dy * (j as f64 + 0.5) / n as f64;
                sum += u / (u * u + v * v);
            }
        }
        let numeric = sum * dx * dy / (n * n) as f64;
        assert!((cell(x, y, dx, dy) / numeric - 1.0).abs() < 1e-5);
    }
}
