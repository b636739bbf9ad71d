//! An operating point and its dimensionless groups.
//!
//! ```text
//! Ū = η₀U/(E'Rx)     G = αE'     W = w/(E'Rx²)
//! M = W/(2Ū)^{3/4}   L = G(2Ū)^{1/4}                   (Moes, point contact)
//! λ = 12 η₀ U Rx²/(a³ p_h)                             (Reynolds equation scaled by a, p_h, a²/Rx)
//! H = h Rx/a²;       film in Moes units (h/Rx)(2Ū)^{−1/2} = H √(6π/λ) for a circle
//! ```
//!
//! Source: Moes, *Lubrication and Beyond* (2000); Venner & Lubrecht, *Multilevel Methods in
//! Lubrication* (2000), for the scaling by Hertz.

use super::hertz::Hertz;

/// A smooth lubricated point contact in SI: all that the film regressions need.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointContact {
    /// Equivalent radius along the rolling direction, m.
    pub rx_m: f64,
    /// Equivalent radius across, m.
    pub ry_m: f64,
    /// E', 2/E' = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂, Pa.
    pub e_prime_pa: f64,
    /// Viscosity at ambient pressure, Pa s.
    pub viscosity_pa_s: f64,
    /// Pressure-viscosity coefficient α, 1/Pa.
    pub alpha_per_pa: f64,
    /// Entrainment speed U = (U₁ + U₂)/2, m/s.
    pub entrainment_m_s: f64,
    /// Normal load, N.
    pub force_n: f64,
}

/// The dimensionless groups of an [`PointContact`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Groups {
    /// Speed parameter Ū = η₀U/(E'Rx).
    pub speed: f64,
    /// Material parameter G = αE'.
    pub material: f64,
    /// Load parameter W = w/(E'Rx²).
    pub load: f64,
    /// Moes load parameter M.
    pub m: f64,
    /// Moes lubricant parameter L.
    pub l: f64,
    /// λ of the Reynolds equation scaled by Hertz.
    pub reynolds_lambda: f64,
    /// α p_h.
    pub alpha_p_hertz: f64,
}

impl PointContact {
    /// The Hertz contact under the load.
    pub fn hertz(&self) -> Hertz {
        Hertz::from_force(self.rx_m, self.ry_m, self.e_prime_pa, self.force_n)
    }

    /// The dimensionless groups.
    pub fn groups(&self) -> Groups {
        let hertz = self.hertz();
        let speed = self.viscosity_pa_s * self.entrainment_m_s / (self.e_prime_pa * self.rx_m);
        let material = self.alpha_per_pa * self.e_prime_pa;
        let load = self.force_n / (self.e_prime_pa * self.rx_m * self.rx_m);
        let eta_u = self.viscosity_pa_s * self.entrainment_m_s;
        Groups {
            speed,
            material,
            load,
            m: load / (2.0 * speed).powf(0.75),
            l: material * (2.0 * speed).powf(0.25),
            reynolds_lambda: 12.0 * eta_u * self.rx_m * self.rx_m
                / (hertz.a_m.powi(3) * hertz.p_max_pa),
            alpha_p_hertz: self.alpha_per_pa * hertz.p_max_pa,
        }
    }
}

impl Groups {
    /// Metres of film for one Moes unit on radius `rx_m`: h = Rx √(2Ū) H_moes.
    pub fn film_unit_m(&self, rx_m: f64) -> f64 {
        rx_m * (2.0 * self.speed).sqrt()
    }
}

#[cfg(test)]
impl PointContact {
    /// Crowned steel rollers of the reference's speed sweep.
    pub(super) fn of_the_speed_sweep(entrainment_m_s: f64) -> Self {
        Self {
            rx_m: 0.01905,
            ry_m: 0.01905,
            e_prime_pa: 219.78e9,
            viscosity_pa_s: 0.096,
            alpha_per_pa: 18.2e-9,
            entrainment_m_s,
            force_n: 800.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn reference_groups_of_the_speed_sweep() {
        for (u, m, l) in [(10.0, 101.0, 18.5), (1.0, 569.0, 10.4), (0.1, 3201.0, 5.85)] {
            let groups = PointContact::of_the_speed_sweep(u).groups();
            // Three printed digits.
            assert!((groups.m / m - 1.0).abs() < 5e-3, "{}", groups.m);
            assert!((groups.l / l - 1.0).abs() < 5e-3, "{}", groups.l);
        }
    }

    #[test]
    fn the_two_scalings_agree_for_a_circle() {
        let point = PointContact::of_the_speed_sweep(1.0);
        let groups = point.groups();
        // λ = (128π³/(3M⁴))^{1/3} and αp_h = (L/π)(3M/2)^{1/3}.
        let lambda = (128.0 * PI.powi(3) / (3.0 * groups.m.powi(4))).cbrt();
        let alpha_p = groups.l / PI * (1.5 * groups.m).cbrt();
        assert!((groups.reynolds_lambda / lambda - 1.0).abs() < 1e-12);
        assert!((groups.alpha_p_hertz / alpha_p - 1.0).abs() < 1e-12);
        // One Moes unit is H √(6π/λ) = 1.
        let h =
            (groups.reynolds_lambda / (6.0 * PI)).sqrt() * point.hertz().a_m.powi(2) / point.rx_m;
        assert!((groups.film_unit_m(point.rx_m) / h - 1.0).abs() < 1e-12);
    }
}
