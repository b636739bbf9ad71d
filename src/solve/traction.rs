//! Shear stress on the surfaces.
//!
//! ```text
//! film      q = τ0 asinh(η|U2−U1|/(τ0 h))  (Ree-Eyring)   or  η|U2−U1|/h  (Newtonian),  at most γ p
//! contact   q = μ_b p                                      where h is at or below the contact film
//! ```
//! | symbol | meaning | unit |
//! |---|---|---|
//! | q, p | traction on body 1 along +x, pressure | p_h |
//! | γ | limiting shear stress over pressure | 1 |
//! | μ_b | boundary friction | 1 |
//!
//! Positive on body 1 when body 2 is the faster: it drags the slower body forward. Without sliding
//! there is none. Sources: Eyring (1936); Bair and Winer (1979) for the limit.

use crate::math::elementary::{asinh, exp};
use crate::physics::fluid::Viscosity;

/// The law, dimensionless.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TractionLaw {
    /// Shear law of the film; `None`: dry.
    pub film: Option<FilmShear>,
    /// Viscosity law.
    pub viscosity: Viscosity,
    /// μ_b.
    pub boundary: f64,
    /// Film at or below which a spot is in contact.
    pub contact_film: f64,
    /// Sign of U2 − U1; 0: no traction.
    pub direction: f64,
}

/// Shear of the film.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmShear {
    /// η0 |U2−U1|/(p_h × film unit).
    pub rate: f64,
    /// τ0/p_h; `None`: Newtonian.
    pub eyring: Option<f64>,
    /// γ.
    pub limit: f64,
}

impl TractionLaw {
    /// The law of a contact without a film.
    #[must_use]
    pub fn without_film(mut self) -> Self {
        self.film = None;
        self
    }

    /// Whether a node is in contact.
    #[inline]
    pub fn is_contact(&self, p: f64, h: f64) -> bool {
        p > 0.0 && h <= self.contact_film
    }

    /// q of one node.
    #[inline]
    pub fn traction(&self, p: f64, h: f64) -> f64 {
        if self.direction == 0.0 || p <= 0.0 {
            return 0.0;
        }
        let Some(film) = self.film.filter(|_| !self.is_contact(p, h)) else {
            return self.direction * self.boundary * p;
        };
        let newtonian = film.rate / h * exp(self.viscosity.ln_eta(p).0);
        let shear = match film.eyring {
            Some(tau0) => tau0 * asinh(newtonian / tau0),
            None => newtonian,
        };
        self.direction * shear.min(film.limit * p)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regimes_and_signs() {
        let mut law = TractionLaw {
            film: Some(FilmShear {
                rate: 1e-6,
                eyring: Some(3e-3),
                limit: 0.08,
            }),
            viscosity: Viscosity::barus(0.0, 1e9),
            boundary: 0.1,
            contact_film: 1e-4,
            direction: 1.0,
        };
        // Slow shear is Newtonian.
        assert!((law.traction(0.5, 0.1) / 1e-5 - 1.0).abs() < 1e-4);
        // Contact is Coulomb.
        assert!((law.traction(0.5, 1e-4) - 0.05).abs() < 1e-15);
        // Limit.
        law.viscosity = Viscosity::barus(2e-8, 1e9 * 10.0);
        assert!((law.traction(1.0, 0.1) - 0.08).abs() < 1e-15);
        law.direction = -1.0;
        assert!((law.traction(1.0, 0.1) + 0.08).abs() < 1e-15);
        law.direction = 0.0;
        assert_eq!(law.traction(1.0, 0.1), 0.0);
    }
}
