//! A film that its own heat thins: stress and temperature of a node from the temperature of its walls.
//!
//! ```text
//! across   β θ'' = −B e^(βθ),   shear rate = A e^(βθ),   A = f(τ)/η_w         any law f of the stress, conduction alone
//! number   Y = β Q h/k_f = 8 ψ tanh ψ,   Q = τ |U2 − U1|                     e^(βθ): 1 at walls, cosh²ψ in the middle
//! mean     <e^(βθ)> = sinh 2ψ/(2ψ) = e^φ                                     the oil is thinner by φ than its walls have it
//! stress   τ = min(τ0 asinh(η_w e^−φ |U2−U1|/(h τ0)), γp)    or, Newtonian,   η_w e^−φ |U2−U1|/h
//! flow     θ_f = θ_w + (Q/20 + 3 Q_p/84) h/k_f,   Q_p = h³ g |∇p|²/(12 η0)    mean over the film by (2z/h − 1)²
//! oil      exponential   ln η/η(θ=0) = −βθ          Roelands   (ln η + 9.67) ~ ((T − 138)/(T0 − 138))^−S0
//! ```
//! | symbol | meaning | unit |
//! |---|---|---|
//! | θ, θ_w | rise of the oil, mean rise of both walls, over the bulk | K |
//! | η_w | viscosity at the walls' mean and the node's pressure | Pa s |
//! | β | −∂ ln η/∂T there | 1/K |
//!
//! Exact for walls of equal temperature; what they differ by counts with their mean. Heat that the oil itself carries along
//! is left out (h²U/(κ_oil a) is below .1 in contacts, above 1 in inlets of films of microns at 10 m/s). Where the pressure is
//! steep Y is that of the stress without slope.
//! Sources: Nahme (1940); Gavis and Laurence (1968) for the film of exponential oil, here for any law of the stress; Roelands
//! (1966). Ours: the weights of the flow, from parabolic dissipation and from even.

use crate::physics::fluid::ROELANDS_LN;

/// Roelands' zero of temperature, K.
const ROELANDS_ZERO_K: f64 = 138.0;
/// Newton iterations for a stress, and their relative change that is small enough.
const MOST: usize = 40;
const SMALL: f64 = 1e-10;
/// Y below which sums stand for the functions.
const FAINT: f64 = 1e-6;

/// How the oil thins as it warms.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Thinning {
    /// ln η falls by β a kelvin, whatever the pressure.
    Exponential {
        /// β, 1/K.
        per_k: f64,
    },
    /// Roelands': the more the higher the pressure.
    Roelands {
        /// ln η0 + 9.67.
        scale: f64,
        /// S0.
        exponent: f64,
        /// T0, K.
        bulk_k: f64,
    },
}

impl Thinning {
    /// Roelands' law of an oil of `viscosity_pa_s` at `bulk_k`.
    pub fn roelands(viscosity_pa_s: f64, exponent: f64, bulk_k: f64) -> Self {
        Self::Roelands {
            scale: viscosity_pa_s.ln() + ROELANDS_LN,
            exponent,
            bulk_k,
        }
    }

    /// The same from the slope −d ln η/dT at p = 0 and the bulk's temperature, 1/K.
    pub fn roelands_of_slope(viscosity_pa_s: f64, per_k: f64, bulk_k: f64) -> Self {
        let scale = viscosity_pa_s.ln() + ROELANDS_LN;
        Self::roelands(
            viscosity_pa_s,
            per_k * (bulk_k - ROELANDS_ZERO_K) / scale,
            bulk_k,
        )
    }

    /// −d ln η/dT at p = 0 and the bulk's temperature, 1/K.
    pub fn slope_per_k(&self) -> f64 {
        self.per_k(0.0, 0.0)
    }

    /// c = ln η/η(θ = 0) of a rise of θ, K, at p = 0. At a pressure where cold oil has η̄: ln η̄ → ln η̄ (1 + c/scale) + c.
    pub fn at_rest(&self, rise_k: f64) -> f64 {
        match *self {
            Self::Exponential { per_k } => -per_k * rise_k,
            Self::Roelands { scale, .. } => scale * (self.left(rise_k) - 1.0),
        }
    }

    /// 1/scale: 0 where the pressure does not matter.
    pub fn per_scale(&self) -> f64 {
        match *self {
            Self::Exponential { .. } => 0.0,
            Self::Roelands { scale, .. } => 1.0 / scale,
        }
    }

    /// −∂ ln η/∂T at a rise, where cold oil has ln η̄, 1/K.
    fn per_k(&self, rise_k: f64, ln_eta: f64) -> f64 {
        match *self {
            Self::Exponential { per_k } => per_k,
            Self::Roelands {
                scale,
                exponent,
                bulk_k,
            } => {
                let above = bulk_k - ROELANDS_ZERO_K + rise_k.max(0.0);
                (ln_eta + scale) * self.left(rise_k) * exponent / above
            }
        }
    }

    /// ((T − 138)/(T0 − 138))^−S0.
    fn left(&self, rise_k: f64) -> f64 {
        match *self {
            Self::Exponential { .. } => 1.0,
            Self::Roelands {
                exponent, bulk_k, ..
            } => (1.0 + rise_k.max(0.0) / (bulk_k - ROELANDS_ZERO_K)).powf(-exponent),
        }
    }
}

/// What shears a node of the film, stresses in units of the caller's.
#[derive(Debug, Clone, Copy)]
pub struct Sheared {
    /// Stress of Newtonian oil at the bulk's temperature.
    pub newtonian: f64,
    /// ln η̄ there.
    pub ln_eta: f64,
    /// τ0; `None`: Newtonian.
    pub eyring: Option<f64>,
    /// γp.
    pub limit: f64,
    /// |U2 − U1| h/k_f times the unit of stress: K a unit of stress.
    pub warms_k: f64,
    /// Mean rise of the walls for a stress of `of_stress`, and what it grows by with the stress, K a unit.
    pub walls_k: f64,
    pub of_stress: f64,
    pub walls_grow_k: f64,
}

/// What comes of it.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Thinned {
    /// τ.
    pub stress: f64,
    /// ln of the viscosity that stands for the film's over the cold one's.
    pub shift: f64,
    /// Rise in the middle of the film over its walls, K.
    pub middle_k: f64,
}

impl Sheared {
    /// Stress and temperature of oil whose viscosity falls as it warms.
    pub fn thinned(&self, thinning: &Thinning) -> Thinned {
        let walls_at = |stress: f64| self.walls_k + self.walls_grow_k * (stress - self.of_stress);
        let beta = thinning.per_k(self.walls_k, self.ln_eta);
        let walls_shift = {
            let c = thinning.at_rest(self.walls_k);
            self.ln_eta * c * thinning.per_scale() + c
        };
        let ln_at =
            |stress: f64, phi: f64| walls_shift - beta * (walls_at(stress) - self.walls_k) - phi;
        // The residual τ − f(τ) rises with τ: it is negative at 0 and positive where the film were as cold as its walls.
        let [mut low, mut high] = [0.0, self.law(ln_at(0.0, 0.0)).0];
        let mut stress = self.of_stress.clamp(low, high);
        if stress == 0.0 {
            stress = high;
        }
        let mut found = Self::film(beta * self.warms_k * stress);
        for _ in 0..MOST {
            let (law, slope) = self.law(ln_at(stress, found.phi));
            let residual = stress - law;
            if residual == 0.0 {
                break;
            }
            if residual > 0.0 {
                high = stress;
            } else {
                low = stress;
            }
            let falls = beta * (self.warms_k * found.phi_y + self.walls_grow_k);
            let mut next = stress - residual / (1.0 + slope * falls);
            if !(low < next && next < high) {
                next = 0.5 * (low + high);
            }
            let moved = (next - stress).abs();
            stress = next;
            found = Self::film(beta * self.warms_k * stress);
            if moved <= SMALL * high {
                break;
            }
        }
        Thinned {
            stress,
            shift: ln_at(stress, found.phi),
            middle_k: if beta > 0.0 {
                2.0 * found.psi.cosh().ln() / beta
            } else {
                self.warms_k * stress / 8.0
            },
        }
    }

    /// Rise in the middle over the walls of a film whose oil does not thin, K.
    pub fn middle_k(&self, stress: f64) -> f64 {
        self.warms_k * stress / 8.0
    }

    /// Stress where ln η is `shift` above the cold one, and its slope by that.
    fn law(&self, shift: f64) -> (f64, f64) {
        let newtonian = self.newtonian * shift.exp();
        let (stress, slope) = match self.eyring {
            Some(tau0) => {
                let zeta = newtonian / tau0;
                (
                    tau0 * zeta.asinh(),
                    tau0 * zeta / (1.0 + zeta * zeta).sqrt(),
                )
            }
            None => (newtonian, newtonian),
        };
        if stress < self.limit {
            (stress, slope)
        } else {
            (self.limit, 0.0)
        }
    }

    /// φ, its slope by Y, and ψ.
    fn film(y: f64) -> Film {
        if y < FAINT {
            return Film {
                phi: y / 12.0,
                phi_y: 1.0 / 12.0,
                psi: (y / 8.0).sqrt(),
            };
        }
        let goal = y / 8.0;
        // ψ tanh ψ lies below ψ² and above ψ − .28.
        let mut psi = goal.sqrt().max(goal);
        for _ in 0..MOST {
            let (t, excess) = (psi.tanh(), psi * psi.tanh() - goal);
            let slope = t + psi * (1.0 - t * t);
            let step = excess / slope;
            psi -= step;
            if step.abs() <= SMALL * psi {
                break;
            }
        }
        let t = psi.tanh();
        // ln(sinh 2ψ/2ψ), which must not overflow.
        let phi = 2.0 * psi + (-(-4.0 * psi).exp_m1() / (4.0 * psi)).ln();
        let phi_psi = 2.0 / (2.0 * psi).tanh() - 1.0 / psi;
        let y_psi = 8.0 * (t + psi * (1.0 - t * t));
        Film {
            phi,
            phi_y: phi_psi / y_psi,
            psi,
        }
    }
}

struct Film {
    phi: f64,
    phi_y: f64,
    psi: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Newtonian oil between walls at the bulk's temperature, Na = β η0 Δu²/k_f; units in which η0 Δu/h = 1.
    fn couette(na: f64) -> Sheared {
        Sheared {
            newtonian: 1.0,
            ln_eta: 0.0,
            eyring: None,
            limit: f64::INFINITY,
            warms_k: na,
            walls_k: 0.0,
            of_stress: 0.0,
            walls_grow_k: 0.0,
        }
    }

    /// The closed form of `assets/reference`: τ h/(η0 Δu) = asinh √s/√(s(1+s)), s = Na/8, βθ = ln(1+s); its greatest stress.
    #[test]
    fn a_film_of_exponential_oil_is_the_closed_form() {
        let law = Thinning::Exponential { per_k: 1.0 };
        for na in [1e-7, 1e-3, 0.1, 1.0, 10.0, 18.21374, 100.0, 1e3, 1e5] {
            let s: f64 = na / 8.0;
            let stress = s.sqrt().asinh() / (s * (1.0 + s)).sqrt();
            let found = couette(na).thinned(&law);
            assert!(
                (found.stress / stress - 1.0).abs() < 1e-6,
                "{na}: {} {stress}",
                found.stress
            );
            assert!((found.middle_k / s.ln_1p() - 1.0).abs() < 1e-5, "{na}");
        }
        // √Na τ is the stress as the speed grows.
        let at = |na: f64| na.sqrt() * couette(na).thinned(&law).stress;
        let most = at(18.21374);
        assert!(
            (most / (0.662743 * 8.0_f64.sqrt()) - 1.0).abs() < 1e-5,
            "{most}"
        );
        assert!(at(17.5) < most && at(19.0) < most);
    }

    /// Between walls that warm with the stress, with Eyring's law and its limit, the residual is nothing and what is found
    /// hangs on no guess.
    #[test]
    fn the_stress_is_where_the_law_and_the_temperature_meet() {
        let roelands = Thinning::roelands_of_slope(0.08, 0.04, 350.0);
        assert!((roelands.slope_per_k() - 0.04).abs() < 1e-15);
        for thinning in [Thinning::Exponential { per_k: 0.04 }, roelands] {
            for (newtonian, limit) in [(1e-3, 1e9), (1.0, 1e9), (1e6, 1e9), (1e6, 2.0)] {
                for guess in [0.0, 0.3, 5.0] {
                    let node = Sheared {
                        newtonian,
                        ln_eta: 9.0,
                        eyring: Some(0.3),
                        limit,
                        warms_k: 50.0,
                        walls_k: 20.0 + 10.0 * guess,
                        of_stress: guess,
                        walls_grow_k: 10.0,
                    };
                    let found = node.thinned(&thinning);
                    let law = node.law(found.shift).0;
                    assert!((found.stress / law - 1.0).abs() < 1e-7, "{found:?} {law}");
                    if let Thinning::Exponential { .. } = thinning {
                        let plain = Sheared {
                            walls_k: 20.0,
                            of_stress: 0.0,
                            ..node
                        };
                        let again = plain.thinned(&thinning).stress;
                        assert!((found.stress / again - 1.0).abs() < 1e-7);
                    }
                }
            }
        }
    }

    /// Roelands' law at a pressure: (ln η + 9.67) is what falls.
    #[test]
    fn roelands_oil_thins_the_more_the_higher_the_pressure() {
        let (eta, exponent, bulk): (f64, f64, f64) = (0.08, 1.1, 350.0);
        let law = Thinning::roelands(eta, exponent, bulk);
        for (ln_eta, rise) in [(0.0, 0.0), (0.0, 30.0), (9.0, 30.0), (9.0, 120.0)] {
            let c = law.at_rest(rise);
            let ours = ln_eta * (1.0 + c * law.per_scale()) + c;
            let scale = eta.ln() + 9.67;
            let left = ((bulk + rise - 138.0) / (bulk - 138.0)).powf(-exponent);
            let exact = (ln_eta + scale) * left - scale;
            assert!((ours - exact).abs() < 1e-12);
            let slope = |rise: f64| {
                (ln_eta + scale) * ((bulk + rise - 138.0) / (bulk - 138.0)).powf(-exponent)
            };
            let by_difference = (slope(rise) - slope(rise + 1e-5)) / 1e-5;
            assert!((law.per_k(rise, ln_eta) / by_difference - 1.0).abs() < 1e-5);
        }
    }
}
