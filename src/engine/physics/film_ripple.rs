//! A low ripple of one surface inside a lubricated line contact: what is left of it, in closed form.
//!
//! ```text
//! film        h̃ = A + 4p̃/(E'k)        balance   −(ρh³/12η) k² p̃ = i (kU − ω)(ρ h̃ + h ρ' p̃)
//! bound       ω = ku:    a/A = (1 − iCQ)/(1 − iQ − iCQ),   p̃/p̃_dry = 1 − a/A,   p̃_dry = −E'kA/4
//!             Q = (12/π²)(η (u − U)/(E'h))(W/h)²,   C = (k E'h/4) d ln ρ/dp
//! convected   A = 0:     (κ − 1)(1 + C_c κ) = i b κ³,   k = κ k_c,   k_c = ω/U,   b = 1/Q_c = k_c² E'h³/(48 ηU)
//! ```
//! | symbol | meaning | unit |
//! |---|---|---|
//! | A, a | amplitude of the ripple, and of the film that moves with its body | m |
//! | W, k | wavelength, 2π/W | m, 1/m |
//! | u, U | speed of the body, mean speed of both | m/s |
//! | η | viscosity that the flow along x meets: under sliding, of Eyring oil, η/cosh(τ_m/τ0) | Pa s |
//! | h, E' | film, 2/E' = Σ (1 − ν²)/E | m, Pa |
//!
//! The film of a flat Hertz contact far from its edges, to first order in A/h, with a pressure that varies slowly against
//! the ripple. The *bound* ripple moves with its body; what the inlet makes of it besides moves with the oil, at U, with
//! the body's frequency ω: it has the wavelength WU/u and decays as e^{−αx}, α = Im k: to first order b k_c = k_c/Q_c,
//! which is too high where α is not small against k_c: at b = 0.1, 0.2 and 0.3 α = 0.090, 0.147 and 0.178 k_c.
//!
//! With the tangent of Eyring's law ησ/ζ → τ0 h/|U2 − U1|: Q goes to (6/π²)(τ0/E')(W/h)², and what is left of a ripple
//! depends neither on the pressure nor on the sliding. That is what Šperka, Křupka and Hartl (2016) measured.
//!
//! Sources: Hooke (2006), *Roughness in rolling-sliding elastohydrodynamically lubricated contacts*, Proc. IMechE J 220;
//! Greenwood and Morales-Espejel (1994), Proc. IMechE J 208, for the two parts. Test: `tests/engine/eyring.rs`.

use std::f64::consts::{PI, TAU};

use rustfft::num_complex::Complex;

/// A film between flat bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlatFilm {
    /// E', Pa.
    pub e_prime_pa: f64,
    /// h, m.
    pub film_m: f64,
    /// η, Pa s.
    pub viscosity_pa_s: f64,
    /// d ln ρ/dp, 1/Pa.
    pub compressibility_per_pa: f64,
    /// U, m/s.
    pub entrainment_m_s: f64,
}

impl FlatFilm {
    /// C at wavelength `wave_m`.
    fn yielding(&self, wave_m: f64) -> f64 {
        0.25 * TAU / wave_m * self.e_prime_pa * self.film_m * self.compressibility_per_pa
    }

    /// (12/π²)(η V/(E'h))(W/h)².
    fn stiffness(&self, wave_m: f64, speed_m_s: f64) -> f64 {
        let viscous = self.viscosity_pa_s * speed_m_s / (self.e_prime_pa * self.film_m);
        12.0 / (PI * PI) * viscous * (wave_m / self.film_m).powi(2)
    }

    /// a/A of a ripple on a body of speed `body_m_s`.
    pub fn left(&self, wave_m: f64, body_m_s: f64) -> Complex<f64> {
        let q = self.stiffness(wave_m, body_m_s - self.entrainment_m_s);
        let c = self.yielding(wave_m);
        Complex::new(1.0, -c * q) / Complex::new(1.0, -(1.0 + c) * q)
    }

    /// Amplitude of its pressure over that of dry contact in full.
    pub fn pressure_share(&self, wave_m: f64, body_m_s: f64) -> f64 {
        (Complex::new(1.0, 0.0) - self.left(wave_m, body_m_s)).norm()
    }

    /// Complex wavenumber k of the convected wave that a ripple on a body of speed `body_m_s` makes, 1/m: its imaginary
    /// part is the decay along x.
    pub fn convected(&self, wave_m: f64, body_m_s: f64) -> Complex<f64> {
        /// Steps from a wave that does not decay to this one, and Newton iterations of each.
        const STEPS: u32 = 32;
        const ITERATIONS: u32 = 8;
        let convected_m = wave_m * self.entrainment_m_s / body_m_s;
        let c = self.yielding(convected_m);
        let b = 1.0 / self.stiffness(convected_m, self.entrainment_m_s);
        let one = Complex::new(1.0, 0.0);
        let mut kappa = one;
        for step in 1..=STEPS {
            let ib = Complex::new(0.0, b * f64::from(step) / f64::from(STEPS));
            for _ in 0..ITERATIONS {
                let square = kappa * kappa;
                let value = (kappa - one) * (one + kappa * c) - ib * square * kappa;
                let slope = one + (kappa * 2.0 - one) * c - ib * square * 3.0;
                kappa -= value / slope;
            }
        }
        kappa * (TAU / convected_m)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILM: FlatFilm = FlatFilm {
        e_prime_pa: 226e9,
        film_m: 180e-9,
        viscosity_pa_s: 0.05,
        compressibility_per_pa: 4e-11,
        entrainment_m_s: 2.0,
    };

    #[test]
    fn the_balance_holds() {
        let (wave, body) = (40e-6, 1.6);
        let FlatFilm {
            e_prime_pa,
            film_m,
            viscosity_pa_s,
            compressibility_per_pa,
            entrainment_m_s,
        } = FILM;
        let i = Complex::new(0.0, 1.0);
        let residual = |k: Complex<f64>, omega: f64, film: Complex<f64>, pressure: Complex<f64>| {
            let flow = -k * k * pressure * (film_m.powi(3) / (12.0 * viscosity_pa_s));
            let carried = (k * entrainment_m_s - omega)
                * i
                * (film + pressure * (film_m * compressibility_per_pa));
            (flow - carried).norm() / flow.norm()
        };
        let k = Complex::new(TAU / wave, 0.0);
        let left = FILM.left(wave, body);
        let pressure = (left - 1.0) * k * (0.25 * e_prime_pa);
        assert!(residual(k, k.re * body, left, pressure) < 1e-12);
        assert!(
            (pressure.norm() / (0.25 * e_prime_pa * k.re) - FILM.pressure_share(wave, body)).abs()
                < 1e-12
        );
        let convected = FILM.convected(wave, body);
        let own = Complex::new(1.0, 0.0);
        let pressure = convected * (0.25 * e_prime_pa);
        assert!(residual(convected, k.re * body, own, pressure) < 1e-12);
        assert!(convected.im > 0.0 && convected.re > 0.0);
    }

    #[test]
    fn limits() {
        // Rolling, or oil that flows freely: all of it is left; stiff oil flattens but for what its own volume gives.
        assert!((FILM.left(40e-6, 2.0).norm() - 1.0).abs() < 1e-15);
        let stiff = FlatFilm {
            viscosity_pa_s: 1e9,
            ..FILM
        };
        let c = stiff.yielding(40e-6);
        assert!((stiff.left(40e-6, 1.0).norm() - c / (1.0 + c)).abs() < 1e-6);
        assert!((stiff.convected(40e-6, 1.0).im).abs() < 1e-3);
        // Where the decay is slow the first order, but for the yielding of the oil, is it.
        let slow = FlatFilm {
            viscosity_pa_s: 50.0,
            compressibility_per_pa: 0.0,
            ..FILM
        };
        let convected_m = 40e-6 * slow.entrainment_m_s / 1.6;
        let first_order = TAU / convected_m / slow.stiffness(convected_m, slow.entrainment_m_s);
        let ratio = slow.convected(40e-6, 1.6).im / first_order;
        assert!((ratio - 1.0).abs() < 1e-3, "{ratio}");
    }
}
