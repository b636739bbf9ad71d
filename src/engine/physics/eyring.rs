//! Eyring's oil under sliding: what of its viscosity the pressure's flow meets, along the sliding and across it.
//!
//! ```text
//! law       γ̇ = (τ0/η) sinh(τ/τ0),   τ = τ_m + z ∂p/∂x over the film,   σ = τ_m/τ0,   ε = h ∂p/∂x/(2τ0)
//! sliding   ζ = η|U2 − U1|/(τ0 h) = sinh σ sinh ε/ε
//! flow      q = −(h³/12η) ∂p/∂x A(ε) cosh σ,            A = 3(ε cosh ε − sinh ε)/ε³
//!             = −(h³/12η) ∂p/∂x √(A² + ζ² Λ²),          Λ = A ε/sinh ε = 3(ε coth ε − 1)/ε²
//! ε → 0     along  1/η_x = cosh σ/η                      tangent: a small flow rides on a large shear
//!           across 1/η_y = sinh σ/(σ η)                  secant: the shear turns by a small angle
//! steep     Φ = √(A² r² + Λ² (1 − r²)) ≤ 1,   r = 1/cosh σ0     q over that of ε → 0 at the same sliding, σ0 = asinh ζ
//! traction  σ = asinh(sinh σ0 ε/sinh ε)
//! ```
//! The two integrals over the film, of the velocity and of the flow, are exact at any ε for sliding along ∂p/∂x. Steep
//! crests make the oil flow less than their slope over the tangent would have it (Λ: 0.94 at ε = 1, 0.27 at 10), and
//! the mean stress that the sliding needs is less, because the stress is greater at one wall by as much as it is less at
//! the other and the greater one shears more.
//!
//! Left out: what a pressure thins without any sliding, A > 1. Φ ends at 1, so that the flow is Newtonian where nothing
//! slides, alike in all directions, and continuous there; it ends so where sinh ε/ε > ζ, in gears at ε of 20 and more,
//! where the wall's stress is beyond any limit that is measured. Across, ε counts as small.
//!
//! Sources: Eyring (1936); Johnson and Tevaarwerk (1977), Proc. R. Soc. A 356, 215-236; Conry, Wang and Cusano (1987),
//! J. Tribol. 109, 648-654, for the factor at any ε (here derived anew); Ehret, Dowson and Taylor (1998), Proc. R.
//! Soc. A 454, 763-787, for both directions at small ε. Tests: below, against quadrature over the film.

use crate::math::elementary::{asinh, exp, ln};

/// |ε| below which closed forms cancel and series stand for them (next terms below 1e-15).
const GENTLE: f64 = 0.1;
/// |ε| beyond which Φ is no longer followed: hyperbolic functions would overflow.
const STEEPEST: f64 = 300.0;

/// `cosh σ`, its logarithm and the logarithm's derivative, from `grown` = e^σ.
#[inline(always)]
pub fn along(grown: f64) -> (f64, f64, f64) {
    let falls = 1.0 / grown;
    let twice = grown + falls;
    (0.5 * twice, ln(0.5 * twice), (grown - falls) / twice)
}

/// `sinh σ/σ`, its logarithm and the logarithm's derivative, from `grown` = e^σ.
#[inline(always)]
pub fn across(grown: f64) -> (f64, f64, f64) {
    let sigma = ln(grown);
    // Next terms below 1e-15 for σ < 0.01.
    let small = sigma.min(1e-2);
    let square = small * small;
    let series = (
        1.0 + square * (1.0 / 6.0 + square / 120.0),
        square * (1.0 / 6.0 - square / 180.0),
        small * (1.0 / 3.0 - square * (1.0 / 45.0 - square * 2.0 / 945.0)),
    );
    let large = sigma.max(1e-2);
    let falls = 1.0 / grown;
    let ratio = 0.5 * (grown - falls).max(f64::MIN_POSITIVE) / large;
    let closed = (
        ratio,
        ln(ratio),
        (grown + falls) / (2.0 * large * ratio) - 1.0 / large,
    );
    if sigma < 1e-2 { series } else { closed }
}

/// `ln(ζ/asinh ζ)` and its derivative with respect to ln ζ: 0 for ζ → 0, 1 for ζ → ∞.
#[inline(always)]
pub fn ln_secant(zeta: f64) -> (f64, f64) {
    // ζ/asinh ζ = 1 + ζ²/6 − 17 ζ⁴/360: next term below 1e-13 for ζ < 0.01.
    let z2 = zeta.min(1e-2).powi(2);
    let series = (
        z2 / 6.0 - 11.0 * z2 * z2 / 180.0,
        z2 / 3.0 - 11.0 * z2 * z2 / 45.0,
    );
    // asinh ζ = ln(ζ + √(1+ζ²)); beyond 1e8 the root is ζ to rounding and its square might overflow.
    let root = (1.0 + zeta.min(1e8).powi(2)).sqrt();
    let asinh = if zeta < 1e8 {
        ln(zeta + root)
    } else {
        ln(zeta) + std::f64::consts::LN_2
    };
    let asinh = asinh.max(f64::MIN_POSITIVE);
    let closed = (ln(zeta) - ln(asinh), 1.0 - zeta.min(1e8) / (asinh * root));
    if zeta < 1e-2 { series } else { closed }
}

/// Φ, ∂Φ/∂ε and ∂Φ/∂r² from ε and r².
#[inline(always)]
pub fn steep(epsilon: f64, sech2: f64) -> (f64, f64, f64) {
    let size = epsilon.abs();
    let ([slid, slid_slope], [grows, grows_by]) = hyperbolic(size);
    let own = slid * grows;
    let own_slope = slid_slope * grows + own * grows_by;
    let square = slid * slid * (1.0 - sech2) + own * own * sech2;
    let phi = square.sqrt();
    let slope = (slid * slid_slope * (1.0 - sech2) + own * own_slope * sech2) / phi;
    let slope = if size < STEEPEST { slope } else { 0.0 };
    let by_sech2 = 0.5 * (own * own - slid * slid) / phi;
    if square < 1.0 {
        (phi, slope * 1.0_f64.copysign(epsilon), by_sech2)
    } else {
        (1.0, 0.0, 0.0)
    }
}

/// Λ(ε) and its derivative; sinh ε/ε and the derivative of its logarithm. ε ≥ 0, cut at [`STEEPEST`].
#[inline(always)]
fn hyperbolic(size: f64) -> ([f64; 2], [f64; 2]) {
    let x = size.min(GENTLE);
    let q = x * x;
    let slid_series = [
        1.0 - q * (1.0 / 15.0 - q * (2.0 / 315.0 - q * (1.0 / 1575.0 - q * 2.0 / 31185.0))),
        -x * (2.0 / 15.0 - q * (8.0 / 315.0 - q * (6.0 / 1575.0 - q * 16.0 / 31185.0))),
    ];
    let grows_series = [
        1.0 + q * (1.0 / 6.0 + q * (1.0 / 120.0 + q * (1.0 / 5040.0 + q / 362_880.0))),
        x * (1.0 / 3.0 - q * (1.0 / 45.0 - q * (2.0 / 945.0 - q / 4725.0))),
    ];
    let x = size.clamp(GENTLE, STEEPEST);
    let grown = exp(x);
    let falls = 1.0 / grown;
    let (over, twice) = (1.0 / x, grown - falls);
    // Langevin's function coth ε − 1/ε; d coth/dε = −1/sinh².
    let langevin = (grown + falls) / twice - over;
    let slid = 3.0 * langevin * over;
    let slid_slope = 3.0 * (over * over - 4.0 / (twice * twice)) * over - slid * over;
    if size < GENTLE {
        (slid_series, grows_series)
    } else {
        ([slid, slid_slope], [0.5 * twice * over, langevin])
    }
}

/// σ of the traction where the pressure is steep: σ0 at ε → 0, less at any other.
#[inline(always)]
pub fn steep_stress(sigma: f64, epsilon: f64) -> f64 {
    let grown = exp(sigma);
    let sinh = 0.5 * (grown - 1.0 / grown);
    let ([..], [grows, _]) = hyperbolic(epsilon.abs());
    asinh((sinh / grows).max(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn along_is_the_tangent_and_across_the_secant_of_the_law() {
        for zeta in [
            0.0_f64, 1e-9, 1e-3, 0.9e-2, 1.1e-2, 0.5, 3.0, 1e3, 1e6, 1e30,
        ] {
            let sigma = zeta.asinh();
            let grown = sigma.exp();
            // Tangent of σ = asinh ζ: dζ/dσ = √(1 + ζ²).
            let tangent = if zeta > 1e9 {
                zeta.ln()
            } else {
                0.5 * (zeta * zeta).ln_1p()
            };
            let (value, log, _) = along(grown);
            assert!((log - tangent).abs() < 1e-13 * (1.0 + tangent), "{zeta}");
            assert!((value.ln() - log).abs() < 1e-13 * (1.0 + log));
            let secant = if zeta > 0.0 { ln_secant(zeta).0 } else { 0.0 };
            let (value, log, _) = across(grown);
            assert!(
                (log - secant).abs() < 3e-13 * (1.0 + secant),
                "{zeta}: {log} {secant}"
            );
            assert!((value.ln() - log).abs() < 1e-13 * (1.0 + log));
        }
        for sigma in [1e-3_f64, 0.99e-2, 1.01e-2, 0.5, 10.0, 50.0] {
            for law in [along, across] {
                let h = 1e-5;
                let d = (law((sigma + h).exp()).1 - law((sigma - h).exp()).1) / (2.0 * h);
                let slope = law(sigma.exp()).2;
                assert!((d - slope).abs() < 2e-9, "{sigma}: {d} {slope}");
            }
        }
        for zeta in [1e-3, 0.9e-2, 1.1e-2, 0.5, 30.0, 1e6] {
            let h: f64 = 1e-6;
            let d = (ln_secant(zeta * h.exp()).0 - ln_secant(zeta * (-h).exp()).0) / (2.0 * h);
            assert!((d - ln_secant(zeta).1).abs() < 1e-8, "{zeta}");
        }
        // Far beyond any stress: finite.
        let most = exp(1e6);
        assert!(along(most).0.is_finite() && across(most).0.is_finite());
    }

    /// Mean stress over τ0 and flow over the Newtonian of an Eyring film at sliding ζ and slope ε, by Simpson's rule over
    /// the film and bisection: the two integrals as they stand, nothing of the closed forms.
    fn film(zeta: f64, epsilon: f64) -> (f64, f64) {
        const N: usize = 4000;
        let over_film = |f: &dyn Fn(f64) -> f64| -> f64 {
            let h = 2.0 / N as f64;
            let weight = |n: usize| match n {
                0 | N => 1.0,
                n if n % 2 == 1 => 4.0,
                _ => 2.0,
            };
            let sum: f64 = (0..=N).map(|n| weight(n) * f(h * n as f64 - 1.0)).sum();
            sum * h / 3.0
        };
        let slid = |sigma: f64| 0.5 * over_film(&|t| (sigma + epsilon * t).sinh());
        let (mut low, mut high) = (0.0, 60.0);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if slid(middle) < zeta {
                low = middle;
            } else {
                high = middle;
            }
        }
        let sigma = 0.5 * (low + high);
        // q = −∫ z γ̇ dz; of Newtonian oil −(2/3) ε in the same units.
        let flow = over_film(&|t| t * (sigma + epsilon * t).sinh());
        (sigma, 1.5 * flow / epsilon)
    }

    #[test]
    fn steep_flow_and_its_traction_are_the_integrals_over_the_film() {
        for (zeta, epsilon) in [
            (1e-3, 0.02),
            (0.5, 0.3),
            (3.0, 0.09),
            (3.0, 0.11),
            (50.0, 1.0),
            (4e3, 5.0),
            (4e6, 1.0),
            (4e6, 10.0),
            (4e6, 19.0_f64),
        ] {
            let (sigma, flow) = film(zeta, epsilon);
            let free = f64::asinh(zeta);
            let sech2 = 1.0 / free.cosh().powi(2);
            let exact = flow / free.cosh();
            let (phi, ..) = steep(-epsilon, sech2);
            println!(
                "zeta {zeta:e}, epsilon {epsilon}: flow {exact:.6} of the tangent's, {phi:.6}"
            );
            assert!(
                (phi / exact.min(1.0) - 1.0).abs() < 1e-7,
                "{zeta} {epsilon}"
            );
            let stress = steep_stress(free, epsilon);
            assert!((stress - sigma).abs() < 1e-6 * sigma, "{stress} {sigma}");
        }
    }

    #[test]
    fn slopes_of_the_steep_flow_are_its_derivatives() {
        for epsilon in [-7.0, -0.4, 0.03, 0.0999, 0.1001, 0.7, 3.0, 12.0, 250.0] {
            for sech2 in [1e-13, 1e-6, 1e-3, 0.05] {
                let h = 1e-5 * f64::abs(epsilon);
                let (phi, by_epsilon, by_sech2) = steep(epsilon, sech2);
                if phi >= 1.0 {
                    continue;
                }
                let d = (steep(epsilon + h, sech2).0 - steep(epsilon - h, sech2).0) / (2.0 * h);
                assert!(
                    (d - by_epsilon).abs() < 1e-7 * (1.0 + d.abs()),
                    "{epsilon} {sech2}: {d} {by_epsilon}"
                );
                let r = 1e-3 * sech2;
                let d = (steep(epsilon, sech2 + r).0 - steep(epsilon, sech2 - r).0) / (2.0 * r);
                // What sech² itself changes: 1e-3 of it moves Φ by little more than rounding where it is small.
                let off = (d - by_sech2).abs() * sech2;
                assert!(off < 1e-6 * phi, "{epsilon} {sech2}: {d} {by_sech2}");
            }
        }
        // A flow grows with its pressure, and what is not slid is Newtonian.
        for sech2 in [1e-14, 1e-4, 0.5] {
            let flow = |n: u32| 0.01 * f64::from(n) * steep(0.01 * f64::from(n), sech2).0;
            assert!((1..40_000).all(|n| flow(n) > flow(n - 1)));
        }
        assert_eq!(steep(5.0, 1.0), (1.0, 0.0, 0.0));
        assert_eq!(steep(0.0, 0.3).0, 1.0);
        assert!(steep(1e300, 1e-200).0.is_finite() && steep_stress(1e6, 1e300).is_finite());
    }
}
