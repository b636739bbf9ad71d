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

    /// q of a row of nodes.
    pub fn traction_row(&self, p: &[f64], h: &[f64], q: &mut [f64]) {
        match (self.direction == 0.0, self.film) {
            (true, _) => q.fill(0.0),
            (false, None) => {
                for (q, &p) in q.iter_mut().zip(p) {
                    *q = self.direction * self.boundary * p.max(0.0);
                }
            }
            (false, Some(film)) => film_row(self, &film, p, h, q),
        }
    }

    /// q of one node.
    #[inline]
    pub fn traction(&self, p: f64, h: f64) -> f64 {
        self.traction_of(p, h, h <= self.contact_film)
    }

    /// The same where it is known whether the node is in contact.
    #[inline]
    pub fn traction_of(&self, p: f64, h: f64, touches: bool) -> f64 {
        if self.direction == 0.0 || p <= 0.0 {
            return 0.0;
        }
        let Some(film) = self.film.filter(|_| !touches) else {
            return self.direction * self.boundary * p;
        };
        let open = if h > self.contact_film {
            h
        } else {
            self.contact_film
        };
        let newtonian = film.rate / open * exp(self.viscosity.ln_eta(p).0);
        let shear = match film.eyring {
            Some(tau0) => tau0 * asinh(newtonian / tau0),
            None => newtonian,
        };
        self.direction * shear.min(film.limit * p)
    }
}

dispatched! {
/// [`TractionLaw::traction`] of a row, without branches inside its loops.
fn film_row(law: &TractionLaw, film: &FilmShear, p: &[f64], h: &[f64], q: &mut [f64]) {
    let n = q.len();
    let (p, h) = (&p[..n], &h[..n]);
    // One loop a law, so that the law is no branch inside of it.
    if let viscosity @ Viscosity::Barus { .. } = law.viscosity {
        for i in 0..n {
            q[i] = viscosity.ln_eta(p[i]).0;
        }
    } else {
        let viscosity = law.viscosity;
        for i in 0..n {
            q[i] = viscosity.ln_eta(p[i]).0;
        }
    }
    for i in 0..n {
        let open = if h[i] > law.contact_film { h[i] } else { law.contact_film };
        q[i] = film.rate / open * exp(q[i]);
    }
    if let Some(tau0) = film.eyring {
        for q in &mut *q {
            *q = tau0 * asinh(*q / tau0);
        }
    }
    for i in 0..n {
        let most = film.limit * p[i];
        let sheared = if q[i] < most { q[i] } else { most };
        let size = if h[i] <= law.contact_film { law.boundary * p[i] } else { sheared };
        q[i] = if p[i] > 0.0 { law.direction * size } else { 0.0 };
    }
}
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_is_its_nodes() {
        let p: Vec<f64> = (0..40)
            .map(|n| (0.07 * f64::from(n) - 0.2).max(0.0))
            .collect();
        let h: Vec<f64> = (0..40).map(|n| 0.02 * (0.5 * f64::from(n)).sin()).collect();
        for viscosity in [
            Viscosity::barus(2e-8, 1.5e9),
            Viscosity::roelands(0.08, 2e-8, 1.5e9),
        ] {
            for eyring in [None, Some(3e-3)] {
                let law = TractionLaw {
                    film: Some(FilmShear {
                        rate: 1e-6,
                        eyring,
                        limit: 0.08,
                    }),
                    viscosity,
                    boundary: 0.1,
                    contact_film: 1e-4,
                    direction: -1.0,
                };
                let mut q = vec![f64::NAN; 40];
                for law in [law, TractionLaw { film: None, ..law }] {
                    law.traction_row(&p, &h, &mut q);
                    for n in 0..40 {
                        assert_eq!(q[n], law.traction(p[n], h[n]), "node {n}");
                    }
                }
            }
        }
    }

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
