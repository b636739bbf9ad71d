//! Scalar measures in lanes, from the two differences and three shears of a stress.
//!
//! ```text
//! σ_v² = ½[d1² + d2² + (d1+d2)²] + 3(σxy² + σxz² + σyz²) = 3 J2
//! τ_o² = 2/9 σ_v²
//! τ_m² = J2 cos²(asin(c)/3),   c = (3√3/2) J3/J2^{3/2}
//! ```
//! asin by its square-root form with the eight-term polynomial of Abramowitz & Stegun 4.4.46 (2e-8).

use super::lanes::{LANES, V};
use crate::scene::StressMeasure;

/// The square of the measure.
#[inline(always)]
pub(super) fn squared(measure: StressMeasure, d1: V, d2: V, xy: V, xz: V, yz: V) -> V {
    let d3 = d1 + d2;
    let differences = d3.fma(d3, d2.fma(d2, d1 * d1));
    let shears = yz.fma(yz, xz.fma(xz, xy * xy));
    let mises = shears.fma(V::splat(3.0), differences * V::splat(0.5));
    match measure {
        StressMeasure::VonMises => mises,
        StressMeasure::Octahedral => mises * V::splat(2.0 / 9.0),
        StressMeasure::MaxShear => shear_squared(mises * V::splat(1.0 / 3.0), d1, d2, [xy, xz, yz]),
    }
}

#[inline(always)]
fn shear_squared(j2: V, d1: V, d2: V, [xy, xz, yz]: [V; 3]) -> V {
    let third = V::splat(1.0 / 3.0);
    let x = (d1 + d1 + d2) * third;
    let y = (d2 - d1) * third;
    let z = -(d1 + d2 + d2) * third;
    let two = V::splat(2.0);
    let j3 = (x * y * z) + (two * xy * xz * yz) - (x * yz * yz) - (y * xz * xz) - (z * xy * xy);
    let mut out = V::ZERO;
    for l in 0..LANES {
        let j2 = j2.0[l];
        let scale = j2 * j2.sqrt();
        // Where there is no shear the ratio is 0/0; J2 is 0 there and so is the result.
        let c = 2.598_076_2 * j3.0[l] / if scale > 0.0 { scale } else { 1.0 };
        let c = c.abs().min(1.0);
        let cos = cosine((std::f32::consts::FRAC_PI_2 - acos(c)) / 3.0);
        out.0[l] = j2 * cos * cos;
    }
    out
}

/// acos on [0, 1], 2e-8.
#[inline(always)]
fn acos(x: f32) -> f32 {
    const A: [f32; 8] = [
        1.570_796_3,
        -0.214_598_8,
        0.088_978_99,
        -0.050_174_305,
        0.030_891_88,
        -0.017_088_126,
        0.006_670_09,
        -0.001_262_491_1,
    ];
    let mut sum = A[7];
    for a in A[..7].iter().rev() {
        sum = sum * x + a;
    }
    (1.0 - x).sqrt() * sum
}

/// Cosine on [0, π/6].
#[inline(always)]
fn cosine(x: f32) -> f32 {
    let x2 = x * x;
    1.0 - x2 * (0.5 - x2 * (1.0 / 24.0 - x2 * (1.0 / 720.0 - x2 / 40320.0)))
}

/// `Σ (v²/top²)^{h}`, `top² > 0`, over the lanes' whole length, into one lane sum.
#[inline(always)]
pub(super) fn power_sum(squares: &[V], top: f32, h: f32) -> V {
    let inverse = V::splat(1.0 / top);
    let mut sum = V::ZERO;
    for v in squares {
        sum += power(*v * inverse, h);
    }
    sum
}

/// `x^h` for 0 ≤ x ≤ 1 and h > 0; below 2^−126 it is 2^−126 at most.
#[inline(always)]
fn power(x: V, h: f32) -> V {
    let mut out = V::ZERO;
    for l in 0..LANES {
        out.0[l] = exp2(h * log2(x.0[l]));
    }
    out
}

/// Base-2 logarithm, 1e-7 absolute near 1; −127 at 0.
#[inline(always)]
fn log2(x: f32) -> f32 {
    // x = 2^e m with m in [2/3, 4/3): 0x3f2aaaab is the pattern of 2/3.
    let bits = x.to_bits() as i32;
    let e = bits.wrapping_sub(0x3f2a_aaab) >> 23;
    let m = f32::from_bits(bits.wrapping_sub(e << 23) as u32);
    let s = (m - 1.0) / (m + 1.0);
    let s2 = s * s;
    let series = 1.0 + s2 * (1.0 / 3.0 + s2 * (0.2 + s2 * (1.0 / 7.0 + s2 * (1.0 / 9.0))));
    e as f32 + 2.0 * std::f32::consts::LOG2_E * s * series
}

/// 2^t for t ≤ 0.
#[inline(always)]
fn exp2(t: f32) -> f32 {
    // Adding 1.5 · 2^23 rounds to the nearest integer.
    const ROUND: f32 = 12_582_912.0;
    let t = if t < -126.0 { -126.0 } else { t };
    let n = (t + ROUND) - ROUND;
    let f = (t - n) * std::f32::consts::LN_2;
    let series = 1.0
        + f * (1.0
            + f * (0.5
                + f * (1.0 / 6.0
                    + f * (1.0 / 24.0 + f * (1.0 / 120.0 + f * (1.0 / 720.0 + f / 5040.0))))));
    series * f32::from_bits(((n as i32 + 127) << 23) as u32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::invariants::Stress6;

    #[test]
    fn power_agrees_with_the_library() {
        let mut worst: f64 = 0.0;
        for i in 1..2000 {
            let x = i as f32 / 2000.0;
            for h in [1.0_f32, 5.17, 6.75] {
                let exact = f64::from(x).powf(f64::from(h));
                let got = f64::from(power(V::splat(x), h).0[0]);
                if exact > 1e-30 {
                    worst = worst.max((got / exact - 1.0).abs());
                }
            }
        }
        println!("power: relative error {worst:.1e}");
        assert!(worst < 1e-5);
        assert!(power(V::ZERO, 5.0).0[0] < 1e-37);
    }

    #[test]
    fn measures_agree_with_the_invariants() {
        let states = [
            [1.0, -2.0, 0.5, 0.7, -1.1, 0.3],
            [-0.3, -0.2, -1.0, 0.0, 0.2, 0.0],
            [0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            [-1.0, -1.0, -0.4, 0.0, 0.0, 0.0],
        ];
        for [xx, yy, zz, xy, xz, yz] in states {
            let s = Stress6 {
                xx,
                yy,
                zz,
                xy,
                xz,
                yz,
            };
            let v = |a: f64| V::splat(a as f32);
            for (measure, exact) in [
                (StressMeasure::VonMises, s.von_mises()),
                (StressMeasure::Octahedral, s.octahedral_shear()),
                (StressMeasure::MaxShear, s.max_shear()),
            ] {
                let square = squared(measure, v(xx - yy), v(yy - zz), v(xy), v(xz), v(yz));
                let got = f64::from(square.0[5]).sqrt();
                assert!(
                    (got - exact).abs() < 3e-7 * (1.0 + exact),
                    "{measure:?}: {got} {exact}"
                );
            }
        }
    }
}
