//! Shear stress on the surfaces.
//!
//! ```text
//! film      q = τ0 asinh(η|U2−U1|/(τ0 h))  (Ree-Eyring)   or  η|U2−U1|/h  (Newtonian),  at most γ p
//! steep     q ← τ0 asinh(sinh(q/τ0) ε/sinh ε),   ε = h ∂p/∂x/(2τ0)       where the flow has a direction
//! contact   q = μ_b p                                      where h is at or below the contact film
//! ```
//! | symbol | meaning | unit |
//! |---|---|---|
//! | q, p | traction on body 1 along +x, pressure | p_h |
//! | γ | limiting shear stress over pressure | 1 |
//! | μ_b | boundary friction | 1 |
//!
//! Warm oil is thinner by a shift of ln η̄ at every node, which the heat knows (`physics/thinning.rs`).
//!
//! Positive on body 1 when body 2 is the faster: it drags the slower body forward. Without sliding
//! there is none. It is the mean over the film; the walls' own ± h ∂p/∂x/2 is left out. Where the pressure is steep the
//! sliding needs less of it: the flow and the traction follow one law (`physics/eyring.rs`). The slope is that between
//! both neighbours along x. Sources: Eyring (1936); Bair and Winer (1979) for the limit.

use crate::math::elementary::{asinh, exp};
use crate::physics::eyring::steep_stress;
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
    /// G = a p_h/(2 Rx τ0): ε of H ∂P/∂X = 1; 0: the stress knows no slope.
    pub steepness: f64,
}

impl FilmShear {
    /// Stress of a film where the pressure is steep, from that where it is not.
    #[inline(always)]
    fn on_slope(&self, tau0: f64, shear: f64, h: f64, slope: f64) -> f64 {
        tau0 * steep_stress(shear / tau0, self.steepness * h * slope)
    }
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

    /// q of a row of nodes a distance `dx` apart; `shift`: of ln η̄, empty where the oil is cold.
    pub fn traction_row(&self, dx: f64, p: &[f64], h: &[f64], shift: &[f64], q: &mut [f64]) {
        match (self.direction == 0.0, self.film) {
            (true, _) => q.fill(0.0),
            (false, None) => {
                for (q, &p) in q.iter_mut().zip(p) {
                    *q = self.direction * self.boundary * p.max(0.0);
                }
            }
            (false, Some(film)) => film_row(self, &film, dx, (p, h, shift), q),
        }
    }

    /// q of one node where the pressure has no slope.
    #[inline]
    pub fn traction(&self, p: f64, h: f64) -> f64 {
        self.traction_of(p, h, 0.0, 0.0, h <= self.contact_film)
    }

    /// The same with ∂P/∂X and a shift of ln η̄, where it is known whether the node is in contact.
    #[inline]
    pub fn traction_of(&self, p: f64, h: f64, slope: f64, shift: f64, touches: bool) -> f64 {
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
        let newtonian = film.rate / open * exp(self.viscosity.ln_eta(p).0 + shift);
        let shear = match film.eyring {
            Some(tau0) => tau0 * asinh(newtonian / tau0),
            None => newtonian,
        };
        let shear = shear.min(film.limit * p);
        let shear = match film.eyring {
            Some(tau0) if film.steepness > 0.0 => film.on_slope(tau0, shear, open, slope),
            _ => shear,
        };
        self.direction * shear
    }
}

dispatched! {
/// [`TractionLaw::traction`] of a row, without branches inside its loops.
fn film_row(
    law: &TractionLaw,
    film: &FilmShear,
    dx: f64,
    (p, h, shift): (&[f64], &[f64], &[f64]),
    q: &mut [f64],
) {
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
    for (q, shift) in q.iter_mut().zip(shift) {
        *q += shift;
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
        q[i] = if q[i] < most { q[i] } else { most };
    }
    if let Some(tau0) = film.eyring.filter(|_| film.steepness > 0.0) {
        for i in 1..n - 1 {
            let slope = 0.5 * (p[i + 1] - p[i - 1]) / dx;
            q[i] = film.on_slope(tau0, q[i], h[i].max(law.contact_film), slope);
        }
        for i in [0, n - 1] {
            q[i] = film.on_slope(tau0, q[i], 0.0, 0.0);
        }
    }
    for i in 0..n {
        let size = if h[i] <= law.contact_film { law.boundary * p[i] } else { q[i] };
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
        let dx = 0.05;
        let shift: Vec<f64> = (0..40).map(|n| -0.1 * f64::from(n % 7)).collect();
        for viscosity in [
            Viscosity::barus(2e-8, 1.5e9),
            Viscosity::roelands(0.08, 2e-8, 1.5e9),
        ] {
            for (eyring, steepness) in [(None, 0.0), (Some(3e-3), 0.0), (Some(3e-3), 40.0)] {
                let law = TractionLaw {
                    film: Some(FilmShear {
                        rate: 1e-6,
                        eyring,
                        limit: 0.08,
                        steepness,
                    }),
                    viscosity,
                    boundary: 0.1,
                    contact_film: 1e-4,
                    direction: -1.0,
                };
                let mut q = vec![f64::NAN; 40];
                for law in [law, TractionLaw { film: None, ..law }] {
                    law.traction_row(dx, &p, &h, &shift, &mut q);
                    for n in 0..40 {
                        let inside = (1..39).contains(&n);
                        let slope = if inside {
                            0.5 * (p[n + 1] - p[n - 1]) / dx
                        } else {
                            0.0
                        };
                        let node = law.traction_of(p[n], h[n], slope, shift[n], h[n] <= 1e-4);
                        assert_eq!(q[n], node, "node {n}");
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
                steepness: 2.0,
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
        // On a slope the sliding needs less; film and slope count, whatever the slope's sign.
        let [flat, up, down] =
            [0.0, 0.5, -0.5].map(|slope| law.traction_of(1.0, 0.1, slope, 0.0, false));
        assert!(
            up < flat && up == down && (flat / 0.08 - 1.0).abs() < 1e-12,
            "{flat} {up}"
        );
        law.direction = -1.0;
        assert!((law.traction(1.0, 0.1) + 0.08).abs() < 1e-15);
        law.direction = 0.0;
        assert_eq!(law.traction(1.0, 0.1), 0.0);
    }
}
