//! Hertz contact of two elastic bodies, circular and elliptical.
//!
//! ```text
//! gap       x²/(2 Rx) + y²/(2 Ry)
//! pressure  p = p_h √(1 − (x/a)² − (y/b)²),      w = (2π/3) a b p_h
//! let s, l be the short and long half-widths (s ≤ l), κ = l/s, m = 1 − 1/κ²
//! shape     R_l/R_s = κ² B(m)/D(m)               (R_l, R_s: radii along l and s)
//! size      s = (p_h/E*) E(m)/(Σ/2),             Σ = 1/Rx + 1/Ry
//! approach  δ = (p_h/E*) s K(m),                 E* = E'/2
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | a, b | half-widths along x (rolling direction) and y | m |
//! | p_h | maximum pressure | Pa |
//! | E' | 2/E' = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂ | Pa |
//! | K, E, B, D | complete elliptic integrals ([`crate::math::elliptic`]) | |
//!
//! Source: Johnson, *Contact Mechanics* (1985), eqs 4.25-4.30; the quotients (K − E)/m and
//! (E − (1 − m)K)/m are taken as D and B, which stay exact where the contact is circular.
//! Test: tabulated dimensionless half-widths (Harris, *Rolling Bearing Analysis*, table 6.1).

use std::f64::consts::PI;

use crate::math::{elliptic, root};

/// Size, pressure and approach of a Hertz contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hertz {
    /// Half-width along x, the rolling direction, m.
    pub a_m: f64,
    /// Half-width along y, m.
    pub b_m: f64,
    /// Maximum pressure, Pa.
    pub p_max_pa: f64,
    /// Approach of distant points of the two bodies, m.
    pub approach_m: f64,
}

crate::closed_set! {
    /// Shape of the contact, which says how size and pressure follow the load.
    #[derive(Default)]
    pub enum ContactKind {
        /// Circle or ellipse: a, p_h ∝ w^{1/3}, stressed volume ∝ a³.
        #[default]
        Point = "point",
        /// Cylinders with parallel axes, nothing varies along y, loads per metre of length: a, p_h ∝ w^{1/2}, stressed
        /// volume per length ∝ a².
        Line = "line",
    }
}

impl ContactKind {
    /// The k of a, p_h ∝ w^{1/k} and volume ∝ a^k.
    pub fn order(self) -> i32 {
        match self {
            Self::Point => 3,
            Self::Line => 2,
        }
    }

    /// Mean pressure over p_h.
    pub fn mean_pressure(self) -> f64 {
        match self {
            Self::Point => 2.0 / 3.0,
            Self::Line => PI / 4.0,
        }
    }

    /// A mesh in words: nodes per side of a square of them, or along a line.
    pub fn mesh(self, nodes: usize) -> String {
        match self {
            Self::Point => format!("{nodes}²"),
            Self::Line => format!("{nodes} nodes"),
        }
    }

    /// a/a_0 = p_h/p_h0 for a ratio of loads.
    pub fn size_ratio(self, load_ratio: f64) -> f64 {
        match self {
            Self::Point => load_ratio.cbrt(),
            Self::Line => load_ratio.sqrt(),
        }
    }
}

/// The part that does not depend on the load.
struct UnitLoadShape {
    /// Long over short half-width.
    kappa: f64,
    integrals: elliptic::Complete,
    /// 1/Rx + 1/Ry, 1/m.
    curvature_sum_per_m: f64,
}

impl UnitLoadShape {
    fn new(rx_m: f64, ry_m: f64) -> Self {
        let ratio = (rx_m / ry_m).max(ry_m / rx_m);
        let mismatch = |ln_kappa: f64| {
            let ell = elliptic::complete((-ln_kappa).exp());
            2.0 * ln_kappa + (ell.b / ell.d).ln() - ratio.ln()
        };
        // κ = 1 is exact for equal radii and κ < ratio otherwise, so the root is always bracketed;
        // what is not bracketed is a radius that is no positive number.
        let kappa = if ratio == 1.0 {
            1.0
        } else {
            root::bracketed(mismatch, 0.0, ratio.ln(), 1e-15).map_or(f64::NAN, f64::exp)
        };
        Self {
            kappa,
            integrals: elliptic::complete(1.0 / kappa),
            curvature_sum_per_m: 1.0 / rx_m + 1.0 / ry_m,
        }
    }

    /// The contact whose short half-width is `short_m`.
    fn sized(&self, rx_m: f64, ry_m: f64, e_prime_pa: f64, short_m: f64) -> Hertz {
        let p_max_pa = 0.25 * e_prime_pa * short_m * self.curvature_sum_per_m / self.integrals.e;
        let long_m = self.kappa * short_m;
        let (a_m, b_m) = if rx_m > ry_m {
            (long_m, short_m)
        } else {
            (short_m, long_m)
        };
        Hertz {
            a_m,
            b_m,
            p_max_pa,
            approach_m: 2.0 * p_max_pa / e_prime_pa * short_m * self.integrals.k,
        }
    }
}

impl Hertz {
    /// The contact of equivalent radii `rx_m`, `ry_m` under `force_n`.
    ///
    /// All arguments must be positive; every field is NaN otherwise.
    pub fn from_force(rx_m: f64, ry_m: f64, e_prime_pa: f64, force_n: f64) -> Self {
        let shape = UnitLoadShape::new(rx_m, ry_m);
        // p_h from w = (2π/3) κ s² p_h, put into the size equation.
        let short_m = (6.0 * force_n * shape.integrals.e
            / (PI * shape.kappa * e_prime_pa * shape.curvature_sum_per_m))
            .cbrt();
        shape.sized(rx_m, ry_m, e_prime_pa, short_m)
    }

    /// The contact whose maximum pressure is `p_max_pa`, and the force that makes it, N.
    ///
    /// All arguments must be positive; every field is NaN otherwise.
    pub fn from_pressure(rx_m: f64, ry_m: f64, e_prime_pa: f64, p_max_pa: f64) -> (Self, f64) {
        let shape = UnitLoadShape::new(rx_m, ry_m);
        let short_m = 4.0 * p_max_pa * shape.integrals.e / (e_prime_pa * shape.curvature_sum_per_m);
        let hertz = Self {
            p_max_pa,
            ..shape.sized(rx_m, ry_m, e_prime_pa, short_m)
        };
        (hertz, hertz.force_n())
    }

    /// The force, w = (2π/3) a b p_h, N.
    pub fn force_n(&self) -> f64 {
        2.0 * PI / 3.0 * self.a_m * self.b_m * self.p_max_pa
    }

    /// Ellipticity b/a: 1 for a circle, above 1 for a contact that is wide across the rolling direction.
    pub fn ellipticity(&self) -> f64 {
        self.b_m / self.a_m
    }

    /// Pressure at (x, y), Pa; 0 outside of the ellipse.
    pub fn pressure_pa(&self, x_m: f64, y_m: f64) -> f64 {
        let inside = 1.0 - (x_m / self.a_m).powi(2) - (y_m / self.b_m).powi(2);
        self.p_max_pa * inside.max(0.0).sqrt()
    }
}

/// Maximum pressure where a wavy elastic surface is pressed by a mean pressure p̄, Pa.
///
/// ```text
/// p* = π E* (A/λ)        flattens the wave;  p̄ < p*:  2 √(p̄ p*)  in the middle of a touching strip,  else  p̄ + p*
/// ```
/// Westergaard (1939), J. Appl. Mech. 6, A49; Johnson, Contact Mechanics (1985), §13.2. E* = E'/2. `slope`: A/λ of all
/// waves together. Ridges; of waves that change along both axes λ is that of their own direction.
pub fn crest_pressure_pa(mean_pa: f64, e_prime_pa: f64, slope: f64) -> f64 {
    let flat_pa = 0.5 * std::f64::consts::PI * e_prime_pa * slope;
    if mean_pa < flat_pa {
        2.0 * (mean_pa * flat_pa).sqrt()
    } else {
        mean_pa + flat_pa
    }
}

/// Equivalent modulus E' of a pair, 2/E' = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂, Pa.
///
/// This is twice the contact modulus E* of Johnson.
pub fn e_prime_pa(young_1_pa: f64, poisson_1: f64, young_2_pa: f64, poisson_2: f64) -> f64 {
    2.0 / ((1.0 - poisson_1 * poisson_1) / young_1_pa + (1.0 - poisson_2 * poisson_2) / young_2_pa)
}

#[cfg(test)]
mod tests {
    use super::*;

    const E_PRIME_PA: f64 = 2.2e11;

    #[test]
    fn a_circle_follows_the_closed_form() {
        let (r, w) = (0.01905, 800.0);
        let e_prime = e_prime_pa(2.0e11, 0.3, 2.0e11, 0.3);
        assert!((e_prime / (2.0e11 / 0.91) - 1.0).abs() < 1e-15);
        let hertz = Hertz::from_force(r, r, e_prime, w);
        let a = (1.5 * w * r / e_prime).cbrt();
        assert!((hertz.a_m / a - 1.0).abs() < 1e-14);
        assert!((hertz.b_m / a - 1.0).abs() < 1e-14);
        assert!((hertz.p_max_pa / (1.5 * w / (PI * a * a)) - 1.0).abs() < 1e-14);
        assert!((hertz.approach_m / (a * a / r) - 1.0).abs() < 1e-14);
    }

    #[test]
    fn published_circular_case() {
        // Steel on steel, E 210 GPa, ν 0.3, R 10 mm, p_h 1 GPa: a 136.136 µm, F 38.815 N.
        let (hertz, force_n) =
            Hertz::from_pressure(0.01, 0.01, e_prime_pa(2.1e11, 0.3, 2.1e11, 0.3), 1.0e9);
        assert!((hertz.a_m - 136.136e-6).abs() < 5e-10, "{}", hertz.a_m);
        assert!((force_n - 38.815).abs() < 5e-4, "{force_n}");
    }

    /// Harris, table 6.1: F(ρ), a*, b*, δ*, where F(ρ) = |1/Rx − 1/Ry|/(1/Rx + 1/Ry); a*, b* and δ* are
    /// the long and short half-width and the approach over those of the circle with the same Σ.
    const HARRIS: [[f64; 4]; 9] = [
        [0.1075, 1.0760, 0.9318, 0.9974],
        [0.3204, 1.2623, 0.8114, 0.9761],
        [0.5916, 1.6440, 0.6687, 0.9077],
        [0.7332, 2.011, 0.5881, 0.8394],
        [0.83495, 2.494, 0.5186, 0.7602],
        [0.90999, 3.233, 0.4499, 0.6636],
        [0.95738, 4.395, 0.3830, 0.5551],
        [0.97290, 5.267, 0.3490, 0.4960],
        [0.983797, 6.448, 0.3150, 0.4352],
    ];

    #[test]
    fn tabulated_ellipses() {
        for [difference, long, short, approach] in HARRIS {
            // Σ = 2/R with R = 10 mm, split in the tabulated ratio.
            let sum = 2.0 / 0.01;
            let rx = 2.0 / (sum * (1.0 + difference));
            let ry = 2.0 / (sum * (1.0 - difference));
            let ellipse = Hertz::from_force(rx, ry, E_PRIME_PA, 100.0);
            let circle = Hertz::from_force(0.01, 0.01, E_PRIME_PA, 100.0);
            // Half a unit of the fourth printed digit (2.011: 2.5e-4), and F(ρ) itself is rounded.
            let off = |got: f64, table: f64| (got / table - 1.0).abs();
            assert!(off(ellipse.b_m / circle.a_m, long) < 3e-4, "{difference}");
            assert!(off(ellipse.a_m / circle.a_m, short) < 3e-4, "{difference}");
            let delta = ellipse.approach_m / circle.approach_m;
            assert!(off(delta, approach) < 3e-4, "{difference}: {delta}");
        }
    }

    #[test]
    fn turning_the_contact_swaps_a_and_b() {
        let wide = Hertz::from_force(0.0066, 0.3, E_PRIME_PA, 1000.0);
        let long = Hertz::from_force(0.3, 0.0066, E_PRIME_PA, 1000.0);
        assert!(wide.b_m > wide.a_m);
        assert_eq!((wide.a_m, wide.b_m), (long.b_m, long.a_m));
        assert_eq!(wide.p_max_pa, long.p_max_pa);
    }

    #[test]
    fn force_and_pressure_are_inverse() {
        for ry in [0.002, 0.0099999, 0.01, 0.3, 100.0] {
            let hertz = Hertz::from_force(0.01, ry, E_PRIME_PA, 123.0);
            assert!((hertz.force_n() / 123.0 - 1.0).abs() < 1e-13);
            let (back, force_n) = Hertz::from_pressure(0.01, ry, E_PRIME_PA, hertz.p_max_pa);
            assert!((force_n / 123.0 - 1.0).abs() < 1e-13, "{ry}");
            assert!((back.approach_m / hertz.approach_m - 1.0).abs() < 1e-13);
        }
    }

    #[test]
    fn the_pressure_balances_the_gap() {
        // The deflection of the centre minus that of the edge is the gap there: for the ellipse this
        // is the size equation along each axis, checked by integrating p/r over the ellipse.
        let hertz = Hertz::from_force(0.01, 0.05, E_PRIME_PA, 200.0);
        let deflection = |x0: f64, y0: f64| {
            // Polar rays about (x0, y0): ∬ p/r dA = ∫∫ p dr dθ; midpoint rule.
            let (n_angle, n_radius) = (720, 4000);
            let reach = 2.0 * hertz.b_m;
            let mut sum = 0.0;
            for i in 0..n_angle {
                let (sin, cos) = ((i as f64 + 0.5) * 2.0 * PI / n_angle as f64).sin_cos();
                for j in 0..n_radius {
                    let r = (j as f64 + 0.5) / n_radius as f64 * reach;
                    sum += hertz.pressure_pa(x0 + r * cos, y0 + r * sin);
                }
            }
            let area = 2.0 * PI / n_angle as f64 * reach / n_radius as f64;
            2.0 / (PI * E_PRIME_PA) * sum * area
        };
        let centre = deflection(0.0, 0.0);
        assert!((centre / hertz.approach_m - 1.0).abs() < 1e-4);
        let along_x = centre - deflection(hertz.a_m, 0.0);
        let along_y = centre - deflection(0.0, hertz.b_m);
        let (x_gap, y_gap) = (hertz.a_m.powi(2) / 0.02, hertz.b_m.powi(2) / 0.1);
        assert!((along_x / x_gap - 1.0).abs() < 2e-3, "{along_x} {x_gap}");
        assert!((along_y / y_gap - 1.0).abs() < 2e-3, "{along_y} {y_gap}");
    }

    #[test]
    fn nonsense_is_nan_and_not_a_panic() {
        assert!(Hertz::from_force(-1.0, 0.01, E_PRIME_PA, 1.0).a_m.is_nan());
        assert!(
            Hertz::from_force(0.01, f64::NAN, E_PRIME_PA, 1.0)
                .a_m
                .is_nan()
        );
    }
}
