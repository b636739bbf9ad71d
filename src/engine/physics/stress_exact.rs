//! Exact stress in the half-space under surface pressure p and traction q along x.
//!
//! Every such field is a sum of sixteen harmonics, `f` (operator `e^{−kz}`) and `g` (`kz e^{−kz}`),
//! each with a factor of the wave direction `n = (nx, ny)`:
//!
//! ```text
//!       normal p                             traction q_x (q_y: x and y exchanged)
//! σxx   −2ν f_1 − (1−2ν) f_nx² + g_nx²       2(1+ν) f_inx − 2ν f_inx³ − g_inx³
//! σyy   −2ν f_1 − (1−2ν) f_ny² + g_ny²       2ν (f_inx − f_inxny²) − g_inxny²
//! σzz   −f_1 − g_1                           g_inx
//! σxy   −(1−2ν) f_nxny + g_nxny              f_iny − 2ν f_inx²ny − g_inx²ny
//! σxz   g_inx                                −f_1 + g_nx²
//! σyz   g_iny                                g_nxny
//! ```
//! z points into the body, tension is positive, p > 0 presses, q acts on the body along +x.
//! Sources: Hertz with sliding agrees with Hamilton, G.M. (1983), Proc. IMechE C 197, 53-59;
//! plane wave: Westergaard, H.M. (1939), J. Appl. Mech. 6, A49-A53. Proved in
//! `tests/life/stress_closed_forms.rs`.

use std::f64::consts::PI;

use rustfft::num_complex::Complex;

use super::invariants::Stress6;

/// One family of direction harmonics at a point: `f` or `g` of the module's table.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Directions {
    /// 1.
    pub one: f64,
    /// `i nx`.
    pub inx: f64,
    /// `i ny`.
    pub iny: f64,
    /// `nx²`.
    pub nx2: f64,
    /// `nx ny`.
    pub nxny: f64,
    /// `i nx² ny`.
    pub inx2ny: f64,
    /// `i nx ny²`.
    pub inxny2: f64,
}

impl Directions {
    /// From the radial functions of orders 0 to 3 about the axis of the source.
    ///
    /// `radial[m]` belongs to `e^{imθ}`, where `(cos, sin)` is the direction from source to point.
    pub fn from_radial(radial: [f64; 4], cos: f64, sin: f64) -> Self {
        let [f0, f1, f2, f3] = radial;
        let cos_2 = cos * cos - sin * sin;
        let sin_2 = 2.0 * sin * cos;
        let cos_3 = cos * (4.0 * cos * cos - 3.0);
        let sin_3 = sin * (3.0 - 4.0 * sin * sin);
        Self {
            one: f0,
            inx: -cos * f1,
            iny: -sin * f1,
            nx2: (f0 - cos_2 * f2) / 2.0,
            nxny: -sin_2 * f2 / 2.0,
            inx2ny: (-sin * f1 + sin_3 * f3) / 4.0,
            inxny2: (-cos * f1 - cos_3 * f3) / 4.0,
        }
    }

    fn ny2(self) -> f64 {
        self.one - self.nx2
    }

    fn inx3(self) -> f64 {
        self.inx - self.inxny2
    }
}

/// Both families at a point.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Harmonics {
    /// Of `e^{−kz}`.
    pub f: Directions,
    /// Of `kz e^{−kz}`.
    pub g: Directions,
}

impl Harmonics {
    /// Stress due to the pressure whose harmonics these are.
    pub fn normal(self, poisson: f64) -> Stress6 {
        let (f, g, nu) = (self.f, self.g, poisson);
        Stress6 {
            xx: -2.0 * nu * f.one - (1.0 - 2.0 * nu) * f.nx2 + g.nx2,
            yy: -2.0 * nu * f.one - (1.0 - 2.0 * nu) * f.ny2() + g.ny2(),
            zz: -f.one - g.one,
            xy: -(1.0 - 2.0 * nu) * f.nxny + g.nxny,
            xz: g.inx,
            yz: g.iny,
        }
    }

    /// Stress due to the traction along x whose harmonics these are.
    pub fn tangential_x(self, poisson: f64) -> Stress6 {
        let (f, g, nu) = (self.f, self.g, poisson);
        Stress6 {
            xx: 2.0 * (1.0 + nu) * f.inx - 2.0 * nu * f.inx3() - g.inx3(),
            yy: 2.0 * nu * (f.inx - f.inxny2) - g.inxny2,
            zz: g.inx,
            xy: f.iny - 2.0 * nu * f.inx2ny - g.inx2ny,
            xz: -f.one + g.nx2,
            yz: g.nxny,
        }
    }
}

/// Harmonics of the Hertz pressure `p0 √(1 − r²)` on the unit circle, at depth `z > 0`.
///
/// Lengths in a, result in p0. The complex form cancels near the axis; there the harmonics of
/// order m, which vanish as r^m, are set to zero (r < 1e-7, 1e-4, 1e-3 for m = 1, 2, 3).
pub fn hertz_harmonics(x: f64, y: f64, z: f64) -> Harmonics {
    let r = x.hypot(y);
    let (cos, sin) = if r > 0.0 { (x / r, y / r) } else { (1.0, 0.0) };
    let (f, g) = hertz_radial(r, z);
    Harmonics {
        f: Directions::from_radial(f, cos, sin),
        g: Directions::from_radial(g, cos, sin),
    }
}

/// Radial functions `f_m`, `g_m`, m = 0..3, of a unit point force (Boussinesq, Cerruti), at distance r and depth z > 0:
/// `f_m = w^m (z + mR)/(2πR³)`, `g_m = z w^m [(m²−1)R² + 3z² + 3mzR]/(2πR⁵)`, R = √(r² + z²), w = r/(R + z).
pub fn point_radial(r: f64, z: f64) -> ([f64; 4], [f64; 4]) {
    let big_r = r.hypot(z);
    let w = r / (big_r + z);
    let r2 = big_r * big_r;
    let (by_r3, by_r5) = (
        1.0 / (2.0 * PI * r2 * big_r),
        1.0 / (2.0 * PI * r2 * r2 * big_r),
    );
    let (mut f, mut g) = ([0.0; 4], [0.0; 4]);
    let mut power = 1.0;
    for m in 0..4 {
        let order = m as f64;
        f[m] = power * (z + order * big_r) * by_r3;
        g[m] = z
            * power
            * ((order * order - 1.0) * r2 + 3.0 * z * z + 3.0 * order * z * big_r)
            * by_r5;
        power *= w;
    }
    (f, g)
}

/// Stress under a circular Hertz pressure that slides with `q = friction · p`; lengths in a,
/// stress in p0, `z > 0`.
pub fn hertz_sliding(x: f64, y: f64, z: f64, poisson: f64, friction: f64) -> Stress6 {
    let harmonics = hertz_harmonics(x, y, z);
    harmonics
        .normal(poisson)
        .plus(harmonics.tangential_x(poisson).times(friction))
}

/// Radial functions F_m, G_m, m = 0..3, of the Hertz pressure.
fn hertz_radial(r: f64, z: f64) -> ([f64; 4], [f64; 4]) {
    type C = Complex<f64>;
    let zeta = C::new(z, -1.0);
    let root = (zeta * zeta + r * r).sqrt();
    let log = (zeta + root).ln();
    let w = C::from(r) / (root + zeta);
    let mut b = [root.inv(); 4];
    let mut c = [log; 4];
    let mut power = C::from(1.0);
    for m in 1..4 {
        power *= w;
        b[m] = power / root;
        c[m] = -power / m as f64;
    }
    let d = hertz_integrals(r, zeta, root, log);
    let vanishes_below = [0.0, 1e-7, 1e-4, 1e-3];
    let (mut f, mut g) = ([0.0; 4], [0.0; 4]);
    for m in 0..4 {
        if r < vanishes_below[m] {
            continue;
        }
        let rise = zeta - z;
        f[m] = -(rise * c[m] - d[m]).im;
        g[m] = z * (rise * b[m] - c[m]).im;
    }
    (f, g)
}

/// D_m = ∫ C_m dζ, m = 0..3.
fn hertz_integrals(
    r: f64,
    zeta: Complex<f64>,
    root: Complex<f64>,
    log: Complex<f64>,
) -> [Complex<f64>; 4] {
    let zero = Complex::new(0.0, 0.0);
    let d0 = zeta * log - root;
    if r < 1e-7 {
        return [d0, zero, zero, zero];
    }
    let (r2, z2, root3) = (r * r, zeta * zeta, root * root * root);
    let d1 = -((zeta * root + log * r2) / 2.0 - z2 / 2.0) / r;
    let d2 = -(zeta * z2 * (2.0 / 3.0) + zeta * r2 - root3 * (2.0 / 3.0)) / (2.0 * r2);
    let d3 = -(zeta * root3 - z2 * z2 - z2 * (1.5 * r2)) / (3.0 * r2 * r);
    [d0, d1, d2, d3]
}

/// Stress under the plane pressure wave `p = cos(k x)`, plane strain.
pub fn westergaard(x: f64, z: f64, k: f64, poisson: f64) -> Stress6 {
    let e = (-k * z).exp();
    let (sin, cos) = (k * x).sin_cos();
    Stress6 {
        xx: -(1.0 - k * z) * e * cos,
        yy: -2.0 * poisson * e * cos,
        zz: -(1.0 + k * z) * e * cos,
        xz: -k * z * e * sin,
        ..Stress6::default()
    }
}

/// Depth and value of the maximum von Mises stress on the axis of a frictionless Hertz contact.
///
/// Used to print and test; `(z/a, σ_v/p0)`, found by golden section to 1e-10 in depth.
pub fn hertz_axis_maximum(poisson: f64) -> (f64, f64) {
    let value = |z: f64| hertz_sliding(0.0, 0.0, z, poisson, 0.0).von_mises();
    let ratio = (5.0_f64.sqrt() - 1.0) / 2.0;
    let (mut low, mut high) = (0.1, 1.5);
    while high - low > 1e-10 {
        let (a, b) = (high - ratio * (high - low), low + ratio * (high - low));
        if value(a) > value(b) {
            high = b;
        } else {
            low = a;
        }
    }
    let z = 0.5 * (low + high);
    (z, value(z))
}
