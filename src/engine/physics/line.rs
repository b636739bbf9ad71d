//! Line contact of two cylinders: Hertz, dimensionless groups, film regressions. Loads per metre of length.
//!
//! ```text
//! Hertz     b = √(8 w R/(π E')),   p_h = E' b/(4R),   w = (π/2) b p_h,   p = p_h √(1 − (x/b)²)
//! groups    Ū = η₀U/(E'R)   G = αE'   W = w/(E'R)   M = W (2Ū)^{−1/2}   L = G (2Ū)^{1/4}
//!           λ = 12 η₀ U R²/(b³ p_h) = 3π²/(8M²)     α p_h = L √(M/2π)
//! film      in units of R √(2Ū):  H_moes = (8M/π) h R/b²
//! Moes      H_c = {[H_RI^{7/3} + H_EI^{7/3}]^{3s/7} + [H_RP^{−7/2} + H_EP^{−7/2}]^{−2s/7}}^{1/s}
//!           H_RI = 3/M,  H_EI = 2.621 M^{−1/5},  H_RP = 1.287 L^{2/3},  H_EP = 1.311 M^{−1/8} L^{3/4}
//!           s = [7 + 8 e^{−2 H_EI/H_RI}]/5
//! Dowson    h_min/R = 2.65 Ū^0.7 G^0.54 W^−0.13,  that is  H_min = 2.65 2^{−0.7} M^−0.13 L^0.54
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | R | equivalent radius along x | m |
//! | w | load per length | N/m |
//! | b | half-width along x (written a where one name serves both kinds of contact) | m |
//!
//! Sources: Johnson, *Contact Mechanics* (1985), §4.2; Moes, *Optimum similarity analysis with applications
//! to elastohydrodynamic lubrication*, Wear 159 (1992), as used for the central film by Gelinck and
//! Schipper (2000); Dowson, *Elastohydrodynamics*, Proc. IMechE 182 (1968). Both are fits, some per cent off
//! computed films (`tests/engine/line.rs` prints by how much): first guess and sanity check, never a result.

use std::f64::consts::PI;

use super::groups::Groups;
use super::hertz::Hertz;

/// The Hertz contact of a line under `load_n_per_m`. Its half-width along y and its approach, which
/// depends on the bodies as a whole, are infinite.
pub fn hertz_from_load(rx_m: f64, e_prime_pa: f64, load_n_per_m: f64) -> Hertz {
    let half_m = (8.0 * load_n_per_m * rx_m / (PI * e_prime_pa)).sqrt();
    Hertz {
        a_m: half_m,
        b_m: f64::INFINITY,
        p_max_pa: 0.25 * e_prime_pa * half_m / rx_m,
        approach_m: f64::INFINITY,
    }
}

/// The line contact whose maximum pressure is `p_max_pa`, and its load, N/m.
pub fn hertz_from_pressure(rx_m: f64, e_prime_pa: f64, p_max_pa: f64) -> (Hertz, f64) {
    let half_m = 4.0 * p_max_pa * rx_m / e_prime_pa;
    let hertz = Hertz {
        a_m: half_m,
        b_m: f64::INFINITY,
        p_max_pa,
        approach_m: f64::INFINITY,
    };
    (hertz, 0.5 * PI * half_m * p_max_pa)
}

/// A smooth lubricated line contact in SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinePoint {
    /// Equivalent radius, m.
    pub rx_m: f64,
    /// E', Pa.
    pub e_prime_pa: f64,
    /// Viscosity at ambient pressure, Pa s.
    pub viscosity_pa_s: f64,
    /// Pressure-viscosity coefficient α, 1/Pa.
    pub alpha_per_pa: f64,
    /// Entrainment speed, m/s.
    pub entrainment_m_s: f64,
    /// Load per length, N/m.
    pub load_n_per_m: f64,
}

impl LinePoint {
    /// The Hertz contact under the load.
    pub fn hertz(&self) -> Hertz {
        hertz_from_load(self.rx_m, self.e_prime_pa, self.load_n_per_m)
    }

    /// The dimensionless groups of a line.
    pub fn groups(&self) -> Groups {
        let hertz = self.hertz();
        let eta_u = self.viscosity_pa_s * self.entrainment_m_s;
        let speed = eta_u / (self.e_prime_pa * self.rx_m);
        let material = self.alpha_per_pa * self.e_prime_pa;
        let load = self.load_n_per_m / (self.e_prime_pa * self.rx_m);
        Groups {
            speed,
            material,
            load,
            m: load / (2.0 * speed).sqrt(),
            l: material * (2.0 * speed).powf(0.25),
            reynolds_lambda: 12.0 * eta_u * self.rx_m * self.rx_m
                / (hertz.a_m.powi(3) * hertz.p_max_pa),
            alpha_p_hertz: self.alpha_per_pa * hertz.p_max_pa,
        }
    }

    /// Central film by Moes, m.
    pub fn moes_central_m(&self) -> f64 {
        let groups = self.groups();
        moes_central(groups.m, groups.l) * groups.film_unit_m(self.rx_m)
    }

    /// Minimum film by Dowson and Higginson, m.
    pub fn dowson_higginson_minimum_m(&self) -> f64 {
        let groups = self.groups();
        dowson_higginson_minimum(groups.m, groups.l) * groups.film_unit_m(self.rx_m)
    }
}

/// Central film by Moes, in Moes units.
pub fn moes_central(m: f64, l: f64) -> f64 {
    let [_, iso, piezo, s] = moes_parts(m, l);
    (iso.powf(3.0 * s / 7.0) + piezo.powf(-2.0 * s / 7.0)).powf(1.0 / s)
}

/// How much of the film without piezoviscosity is that of rigid bodies, ∂ ln H_c/∂ ln H_RI of that formula at L = 0: 0 to 1.
pub fn moes_rigid_share(m: f64) -> f64 {
    let [rigid_iso, iso, ..] = moes_parts(m, 0.0);
    rigid_iso.powf(7.0 / 3.0) / iso
}

/// H_RI, H_RI^{7/3} + H_EI^{7/3}, H_RP^{−7/2} + H_EP^{−7/2}, s.
fn moes_parts(m: f64, l: f64) -> [f64; 4] {
    let (rigid_iso, elastic_iso) = (3.0 / m, 2.621 * m.powf(-0.2));
    let (rigid_piezo, elastic_piezo) = (
        1.287 * l.powf(2.0 / 3.0),
        1.311 * m.powf(-0.125) * l.powf(0.75),
    );
    let s = 0.2 * (7.0 + 8.0 * (-2.0 * elastic_iso / rigid_iso).exp());
    let iso = rigid_iso.powf(7.0 / 3.0) + elastic_iso.powf(7.0 / 3.0);
    let piezo = rigid_piezo.powf(-3.5) + elastic_piezo.powf(-3.5);
    [rigid_iso, iso, piezo, s]
}

/// Minimum film by Dowson and Higginson, in Moes units.
pub fn dowson_higginson_minimum(m: f64, l: f64) -> f64 {
    2.65 * 2.0_f64.powf(-0.7) * m.powf(-0.13) * l.powf(0.54)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn gear() -> LinePoint {
        LinePoint {
            rx_m: 8.38e-3,
            e_prime_pa: 226e9,
            viscosity_pa_s: 0.0133,
            alpha_per_pa: 20.5e-9,
            entrainment_m_s: 2.19,
            load_n_per_m: 4.22e5,
        }
    }

    #[test]
    fn published_gear_pressures() {
        // FZG C: pitch point, B, A, E; R in mm, w in N/m, p_h in GPa to the printed digits.
        for (r, w, p) in [
            (8.38, 4.22e5, 1.347),
            (7.32, 4.22e5, 1.442),
            (3.77, 2.11e5, 1.42),
            (7.61, 2.11e5, 1.00),
            (12.0, 1.6e5, 0.7),
        ] {
            let got = hertz_from_load(r * 1e-3, 226e9, w).p_max_pa * 1e-9;
            assert!((got / p - 1.0).abs() < 0.02, "{got} {p}");
        }
        let hertz = gear().hertz();
        let (same, w) = hertz_from_pressure(gear().rx_m, gear().e_prime_pa, hertz.p_max_pa);
        assert!((w / 4.22e5 - 1.0).abs() < 1e-12 && (same.a_m / hertz.a_m - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_two_scalings_agree() {
        let (point, groups) = (gear(), gear().groups());
        let lambda = 3.0 * PI * PI / (8.0 * groups.m * groups.m);
        assert!((groups.reynolds_lambda / lambda - 1.0).abs() < 1e-12);
        let alpha_p = groups.l * (groups.m / TAU).sqrt();
        assert!((groups.alpha_p_hertz / alpha_p - 1.0).abs() < 1e-12);
        let unit = point.hertz().a_m.powi(2) / point.rx_m * PI / (8.0 * groups.m);
        assert!((groups.film_unit_m(point.rx_m) / unit - 1.0).abs() < 1e-12);
        let direct = 2.65
            * point.rx_m
            * groups.speed.powf(0.7)
            * groups.material.powf(0.54)
            * groups.load.powf(-0.13);
        assert!((point.dowson_higginson_minimum_m() / direct - 1.0).abs() < 1e-12);
    }

    #[test]
    fn moes_reaches_its_limits() {
        let near = |got: f64, limit: f64| (got / limit - 1.0).abs() < 0.03;
        assert!(near(moes_central(0.01, 1e-9), 300.0));
        assert!(near(moes_central(1e4, 1e-9), 2.621 * 1e4_f64.powf(-0.2)));
        assert!(near(
            moes_central(1e5, 40.0),
            1.311 * 1e5_f64.powf(-0.125) * 40.0_f64.powf(0.75)
        ));
    }
}
