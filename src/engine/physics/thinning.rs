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

use crate::math::elementary::{asinh, exp, ln};
use crate::physics::fluid::ROELANDS_LN;

/// Roelands' zero of temperature, K.
const ROELANDS_ZERO_K: f64 = 138.0;
/// Most Newton iterations for a stress, from the last one known (who asks looks whether it still changes), and the part of ψ
/// below which a change of all nodes of a block is the last: the next would be its square.
const ITERATIONS: usize = 3;
const SMALL: f64 = 1e-3;
/// Nodes that are worked on together.
pub(crate) const BLOCK: usize = 16;
/// ψ below which the first terms stand for the functions, to 1e-6 of them.
const FAINT: f64 = 1e-3;
/// In place of a stress and of a Y of nothing, and the least ψ.
const NOTHING: f64 = 1e-100;
const LEAST: f64 = 1e-100;

/// The greatest ψ: no oil of ours is thicker than e^300, and thinner by e^680 there is none.
const MOST: f64 = 340.0;

/// How the oil thins as it warms: one of both laws, the terms of the other are 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thinning {
    /// β of exponential oil, 1/K.
    per_k: f64,
    /// ln η0 + 9.67, and 1 over it.
    scale: f64,
    per_scale: f64,
    /// S0.
    exponent: f64,
    /// T0 − 138, K.
    above_k: f64,
}

impl Thinning {
    /// ln η falls by `per_k` a kelvin, whatever the pressure.
    pub fn exponential(per_k: f64) -> Self {
        Self {
            per_k,
            scale: 0.0,
            per_scale: 0.0,
            exponent: 0.0,
            above_k: 1.0,
        }
    }

    /// Roelands' law of an oil of `viscosity_pa_s` at `bulk_k`: the more the higher the pressure.
    pub fn roelands(viscosity_pa_s: f64, exponent: f64, bulk_k: f64) -> Self {
        let scale = viscosity_pa_s.ln() + ROELANDS_LN;
        Self {
            per_k: 0.0,
            scale,
            per_scale: 1.0 / scale,
            exponent,
            above_k: bulk_k - ROELANDS_ZERO_K,
        }
    }

    /// The same from the slope −d ln η/dT at p = 0 and the bulk's temperature, 1/K.
    pub fn roelands_of_slope(viscosity_pa_s: f64, per_k: f64, bulk_k: f64) -> Self {
        let above = bulk_k - ROELANDS_ZERO_K;
        let scale = viscosity_pa_s.ln() + ROELANDS_LN;
        Self::roelands(viscosity_pa_s, per_k * above / scale, bulk_k)
    }

    /// −d ln η/dT at p = 0 and the bulk's temperature, 1/K.
    pub fn slope_per_k(&self) -> f64 {
        self.per_k(0.0, 0.0)
    }

    /// c = ln η/η(θ = 0) of a rise of θ, K, at p = 0. At a pressure where cold oil has η̄: ln η̄ → ln η̄ (1 + c/scale) + c.
    #[inline(always)]
    pub fn at_rest(&self, rise_k: f64) -> f64 {
        self.scale * (self.left(rise_k) - 1.0) - self.per_k * rise_k
    }

    /// −dc/dθ at a rise, 1/K.
    #[inline(always)]
    pub fn falls_at_rest(&self, rise_k: f64) -> f64 {
        self.per_k(rise_k, 0.0)
    }

    /// 1/scale: 0 where the pressure does not matter.
    pub fn per_scale(&self) -> f64 {
        self.per_scale
    }

    /// −∂ ln η/∂T at a rise, where cold oil has ln η̄, 1/K.
    #[inline(always)]
    fn per_k(&self, rise_k: f64, ln_eta: f64) -> f64 {
        let roelands = (ln_eta + self.scale) * self.left(rise_k) * self.exponent;
        self.per_k + roelands / (self.above_k + rise_k.max(0.0))
    }

    /// ((T − 138)/(T0 − 138))^−S0.
    #[inline(always)]
    fn left(&self, rise_k: f64) -> f64 {
        exp(-self.exponent * ln(1.0 + rise_k.max(0.0) / self.above_k))
    }
}

/// What shears every node of a row, stresses in units of the caller's.
#[derive(Debug, Clone, Copy)]
pub struct Sheared<'a> {
    /// Stress of Newtonian oil at the bulk's temperature; 0: nothing is sheared.
    pub newtonian: &'a [f64],
    /// ln η̄ there.
    pub ln_eta: &'a [f64],
    /// γp.
    pub limit: &'a [f64],
    /// τ0; infinite: Newtonian.
    pub eyring: f64,
    /// |U2 − U1| h/k_f times the unit of stress: K a unit of stress.
    pub warms_k: &'a [f64],
    /// Mean rise of the walls at the stress `of_stress`, K.
    pub walls_k: &'a [f64],
    /// That stress.
    pub of_stress: &'a [f64],
    /// What the walls' rise grows by with the stress, K a unit.
    pub walls_grow_k: f64,
}

dispatched! {
/// Of a row: shift of ln η̄ that stands for what the film's warmth does to its stress, and the rise in the middle of the film
/// over its walls, K.
///
/// The unknown is ψ: Y and with it the stress follow from it, and what is left is one equation whose residual rises.
pub fn thinned_row(thinning: &Thinning, row: &Sheared, shift: &mut [f64], middle_k: &mut [f64]) {
    let zero = [0.0; BLOCK];
    let (mut at_walls, mut grow, mut per_y, mut high, mut psi) = (zero, zero, zero, zero, zero);
    let (mut new_shift, mut phi, mut y) = (zero, zero, zero);
    for start in (0..shift.len()).step_by(BLOCK) {
        let newtonian = block(row.newtonian, start);
        if newtonian.iter().all(|stress| *stress <= 0.0) {
            put(&zero, shift, start);
            put(&zero, middle_k, start);
            continue;
        }
        let [ln_eta, limit, warms, walls, of] =
            [row.ln_eta, row.limit, row.warms_k, row.walls_k, row.of_stress].map(|field| block(field, start));
        for k in 0..BLOCK {
            let beta = thinning.per_k(walls[k], ln_eta[k]);
            let c = thinning.at_rest(walls[k]);
            at_walls[k] = ln_eta[k] * c * thinning.per_scale + c;
            grow[k] = beta * row.walls_grow_k;
            per_y[k] = (beta * warms[k]).max(LEAST);
            let coldest = newtonian[k].max(NOTHING) * exp(at_walls[k] + grow[k] * of[k]);
            let most = law(coldest, row.eyring, limit[k].max(NOTHING)).0;
            high[k] = psi_above(per_y[k] * most / 8.0).min(MOST);
            let about = psi_about(per_y[k] * of[k] / 8.0);
            psi[k] = if of[k] > 0.0 && about < high[k] { about } else { high[k] }.max(LEAST);
        }
        for _ in 0..ITERATIONS {
            let mut moves = 0;
            for k in 0..BLOCK {
                let film = Film::at(psi[k]);
                let stress = film.y / per_y[k];
                let thinner = at_walls[k] - grow[k] * (stress - of[k]) - film.phi;
                let newtonian = newtonian[k].max(NOTHING) * exp(thinner);
                let (law, slope) = law(newtonian, row.eyring, limit[k].max(NOTHING));
                // In logarithms the residual is all but straight where much thins.
                let of_walls = film.y_psi / per_y[k] * grow[k];
                let rises = film.y_psi / film.y + slope / law * (of_walls + film.phi_psi);
                let next = psi[k] - ln(stress / law) / rises;
                // Never beyond where the film were as cold as its walls, nor to nothing at once.
                let next = next.max(0.25 * psi[k]).min(high[k]).max(LEAST);
                moves |= u64::from((next - psi[k]).abs() > SMALL * psi[k]);
                // What is a small step further on is what the slopes say.
                let step = next - psi[k];
                let stress = stress + film.y_psi / per_y[k] * step;
                new_shift[k] = at_walls[k] - grow[k] * (stress - of[k]) - film.phi - film.phi_psi * step;
                (phi[k], y[k]) = (film.phi + film.phi_psi * step, film.y + film.y_psi * step);
                psi[k] = next;
            }
            if moves == 0 {
                break;
            }
        }
        let mut new_middle = zero;
        for k in 0..BLOCK {
            // ln cosh²ψ = φ + ln(ψ/tanh ψ).
            new_middle[k] = (phi[k] + ln(8.0 * psi[k] * psi[k] / y[k])) / per_y[k] * warms[k];
        }
        put(&new_shift, shift, start);
        put(&new_middle, middle_k, start);
    }
}
}

/// A block of a row from `start` on; 0 beyond its end. Whole blocks are worked on: a rest would be worked on one by one.
#[inline(always)]
pub(crate) fn block(row: &[f64], start: usize) -> [f64; BLOCK] {
    let mut block = [0.0; BLOCK];
    let width = BLOCK.min(row.len() - start);
    block[..width].copy_from_slice(&row[start..start + width]);
    block
}

/// Back into the row.
#[inline(always)]
pub(crate) fn put(block: &[f64; BLOCK], row: &mut [f64], start: usize) {
    let width = BLOCK.min(row.len() - start);
    row[start..start + width].copy_from_slice(&block[..width]);
}

/// Stress where Newtonian oil would have `newtonian`, and its slope by ln η.
#[inline(always)]
fn law(newtonian: f64, tau0: f64, limit: f64) -> (f64, f64) {
    let zeta = newtonian / tau0;
    let sheared = tau0 * asinh(zeta);
    let free = if tau0 < f64::INFINITY {
        sheared
    } else {
        newtonian
    };
    let slope = newtonian / (1.0 + zeta * zeta).sqrt();
    if free < limit {
        (free, slope)
    } else {
        (limit, 0.0)
    }
}

/// Above the ψ of which ψ tanh ψ is `goal`, by a fifth at most.
#[inline(always)]
fn psi_above(goal: f64) -> f64 {
    (goal + goal * goal).sqrt()
}

/// The ψ of which ψ tanh ψ is `goal`, to 3e-4, fitted: of faint films ψ² = goal + goal²/3, of hot ones ψ = goal.
#[inline(always)]
fn psi_about(goal: f64) -> f64 {
    let most = 0.063114 * goal;
    let over = 1.0 / 3.0 + goal * (0.167332 + goal * (0.0254226 + most));
    let under = 1.0 + goal * (0.188885 + goal * (0.0914082 + most));
    (goal + over / under * goal * goal).sqrt()
}

/// A film of some ψ.
struct Film {
    y: f64,
    y_psi: f64,
    phi: f64,
    phi_psi: f64,
}

impl Film {
    #[inline(always)]
    fn at(psi: f64) -> Self {
        let square = psi * psi;
        let is_faint = psi < FAINT;
        let full = if is_faint { FAINT } else { psi };
        let e = exp(-2.0 * full);
        let t = (1.0 - e) / (1.0 + e);
        let two = 1.0 - e * e;
        let y = 8.0 * full * t;
        let of = |faint: f64, full: f64| if is_faint { faint } else { full };
        Self {
            y: of(8.0 * square * (1.0 - square / 3.0), y),
            y_psi: of(16.0 * psi, 8.0 * (t + full * (1.0 - t * t))),
            phi: of(2.0 / 3.0 * square, 2.0 * full + ln(two / (4.0 * full))),
            phi_psi: of(4.0 / 3.0 * psi, 2.0 * (1.0 + e * e) / two - 1.0 / full),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_psi_is_near() {
        for i in -60..=60 {
            let psi = 10.0_f64.powf(f64::from(i) / 20.0);
            let off = psi_about(psi * psi.tanh()) / psi - 1.0;
            assert!(off.abs() < 3e-4, "{psi}: {off}");
        }
    }

    /// One node: of a stress known before, and walls that are `walls_k` warm there.
    #[derive(Clone, Copy)]
    struct Node {
        newtonian: f64,
        ln_eta: f64,
        eyring: f64,
        limit: f64,
        warms_k: f64,
        walls_k: f64,
        of_stress: f64,
        walls_grow_k: f64,
    }

    impl Node {
        /// Stress, shift and rise in the middle.
        fn thinned(self, thinning: &Thinning) -> [f64; 3] {
            let row = Sheared {
                newtonian: &[self.newtonian],
                ln_eta: &[self.ln_eta],
                limit: &[self.limit],
                eyring: self.eyring,
                warms_k: &[self.warms_k],
                walls_k: &[self.walls_k],
                of_stress: &[self.of_stress],
                walls_grow_k: self.walls_grow_k,
            };
            let (mut shift, mut middle) = ([0.0], [0.0]);
            thinned_row(thinning, &row, &mut shift, &mut middle);
            let stress = law(self.newtonian * shift[0].exp(), self.eyring, self.limit).0;
            [stress, shift[0], middle[0]]
        }

        /// After the rounds that who asks would make; the walls stay those of the first guess's law.
        fn settled(mut self, thinning: &Thinning) -> [f64; 3] {
            for _ in 0..10 {
                let [stress, ..] = self.thinned(thinning);
                self.walls_k += self.walls_grow_k * (stress - self.of_stress);
                self.of_stress = stress;
            }
            self.thinned(thinning)
        }
    }

    /// Newtonian oil between walls at the bulk's temperature, Na = β η0 Δu²/k_f; units in which η0 Δu/h = 1.
    fn couette(na: f64) -> Node {
        Node {
            newtonian: 1.0,
            ln_eta: 0.0,
            eyring: f64::INFINITY,
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
        let law = Thinning::exponential(1.0);
        for na in [1e-7, 1e-3, 0.1, 1.0, 10.0, 18.21374, 100.0, 1e3, 1e5] {
            let s: f64 = na / 8.0;
            let stress = s.sqrt().asinh() / (s * (1.0 + s)).sqrt();
            let [found, _, middle] = couette(na).settled(&law);
            println!("Na {na}: {found} {stress}, {middle}");
            assert!(
                (found / stress - 1.0).abs() < 1e-6,
                "{na}: {found} {stress}"
            );
            assert!((middle / s.ln_1p() - 1.0).abs() < 1e-5, "{na}");
        }
        // √Na τ is the stress as the speed grows.
        let at = |na: f64| na.sqrt() * couette(na).settled(&law)[0];
        let most = at(18.21374);
        assert!(
            (most / (0.662743 * 8.0_f64.sqrt()) - 1.0).abs() < 1e-5,
            "{most}"
        );
        assert!(at(17.5) < most && at(19.0) < most);
    }

    /// Between walls that warm with the stress, with Eyring's law and its limit: the law holds at the temperature that its
    /// heat makes, and what is found hangs on no guess.
    #[test]
    fn the_stress_is_where_the_law_and_the_temperature_meet() {
        for (thinning, room) in [
            (Thinning::exponential(0.04), 1e-6),
            (Thinning::roelands_of_slope(0.08, 0.04, 350.0), 1e-6),
        ] {
            assert!((thinning.slope_per_k() - 0.04).abs() < 1e-15);
            for (newtonian, limit) in [(1e-3, 1e9), (1.0, 1e9), (1e6, 1e9), (1e6, 2.0)] {
                let node = |guess: f64| Node {
                    newtonian,
                    ln_eta: 9.0,
                    eyring: 0.3,
                    limit,
                    warms_k: 50.0,
                    walls_k: 20.0 + 10.0 * guess,
                    of_stress: guess,
                    walls_grow_k: 10.0,
                };
                let [cold, ..] = node(0.0).settled(&thinning);
                for guess in [0.3, 5.0] {
                    let [stress, shift, middle] = node(guess).settled(&thinning);
                    assert!(
                        (stress / cold - 1.0).abs() < room,
                        "{guess}: {stress} {cold}"
                    );
                    // By hand: the walls' own rise, and from the middle's the mean of e^βθ over the film.
                    let walls = 20.0 + 10.0 * stress;
                    let beta = thinning.per_k(walls, 9.0);
                    let psi = (0.5 * beta * middle).exp().acosh();
                    let c = thinning.at_rest(walls);
                    let of_walls = 9.0 * c * thinning.per_scale() + c;
                    let by_hand = of_walls - ((2.0 * psi).sinh() / (2.0 * psi)).ln();
                    assert!((shift - by_hand).abs() < 1e-4, "{shift} {by_hand}");
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
            let exact = |rise: f64| {
                (ln_eta + scale) * ((bulk + rise - 138.0) / (bulk - 138.0)).powf(-exponent) - scale
            };
            assert!((ours - exact(rise)).abs() < 1e-12);
            let by_difference = (exact(rise) - exact(rise + 1e-5)) / 1e-5;
            assert!((law.per_k(rise, ln_eta) / by_difference - 1.0).abs() < 1e-5);
        }
    }
}
