//! Scalar measures in lanes, from the two differences and three shears of a stress.
//!
//! ```text
//! σ_v² = ½[d1² + d2² + (d1+d2)²] + 3(σxy² + σxz² + σyz²) = 3 J2
//! τ_o² = 2/9 σ_v²
//! τ_m² = J2 cos²(asin(c)/3),   c = (3√3/2) J3/J2^{3/2}
//! ```
//! asin by its square-root form with the eight-term polynomial of Abramowitz and Stegun (1964), 4.4.46 (2e-8). Sources: von Mises
//! (1913); Tresca (1864), by Lode's angle.

use crate::math::fused::Fused as _;
use crate::math::lanes::{LANES, V};
use crate::scene::StressMeasure;

/// The square of the measure of d1, d2, xy, xz, yz in every lane, times `factor`, and the greatest so
/// far of each lane.
#[inline(always)]
pub(super) fn squared(
    measure: StressMeasure,
    five: [V; 5],
    factor: &[f32; LANES],
    out: &mut V,
    top: &mut [f32; LANES],
) {
    let [d1, d2, xy, xz, yz] = five;
    match measure {
        StressMeasure::VonMises => {
            for l in 0..LANES {
                let s = factor[l] * mises(d1.0[l], d2.0[l], xy.0[l], xz.0[l], yz.0[l]);
                top[l] = if s > top[l] { s } else { top[l] };
                out.0[l] = s;
            }
        }
        StressMeasure::Octahedral => {
            for l in 0..LANES {
                let s = mises(d1.0[l], d2.0[l], xy.0[l], xz.0[l], yz.0[l]);
                let s = 2.0 / 9.0 * factor[l] * s;
                top[l] = if s > top[l] { s } else { top[l] };
                out.0[l] = s;
            }
        }
        StressMeasure::MaxShear => {
            for l in 0..LANES {
                let s = factor[l] * shear(d1.0[l], d2.0[l], xy.0[l], xz.0[l], yz.0[l]);
                top[l] = if s > top[l] { s } else { top[l] };
                out.0[l] = s;
            }
        }
    }
}

#[inline(always)]
fn mises(d1: f32, d2: f32, xy: f32, xz: f32, yz: f32) -> f32 {
    let d3 = d1 + d2;
    let differences = d3.fused(d3, d2.fused(d2, d1 * d1));
    let shears = yz.fused(yz, xz.fused(xz, xy * xy));
    shears.fused(3.0, 0.5 * differences)
}

/// In double precision: where two principal stresses meet (on the axis of a Hertz contact) the arc
/// cosine of a single-precision ratio would be off by 3e-4.
#[inline(always)]
fn shear(d1: f32, d2: f32, xy: f32, xz: f32, yz: f32) -> f32 {
    let [d1, d2, xy, xz, yz] = [d1, d2, xy, xz, yz].map(f64::from);
    let (x, y, z) = ((d1 + d1 + d2) / 3.0, (d2 - d1) / 3.0, -(d1 + d2 + d2) / 3.0);
    let j2 = 0.5 * (x * x + y * y + z * z) + xy * xy + xz * xz + yz * yz;
    let j3 = x * y * z + 2.0 * xy * xz * yz - x * yz * yz - y * xz * xz - z * xy * xy;
    let scale = j2 * j2.sqrt();
    // Where there is no shear the ratio is 0/0; J2 is 0 there and so is the result.
    let c = (2.598_076_211_353_316 * j3 / if scale > 0.0 { scale } else { 1.0 }).abs();
    let cos = cosine((std::f64::consts::FRAC_PI_2 - acos(if c < 1.0 { c } else { 1.0 })) / 3.0);
    (j2 * cos * cos) as f32
}

/// acos on [0, 1], 2e-8.
#[inline(always)]
fn acos(x: f64) -> f64 {
    const A: [f64; 8] = [
        1.570_796_305_0,
        -0.214_598_801_6,
        0.088_978_987_4,
        -0.050_174_304_6,
        0.030_891_881_0,
        -0.017_088_125_6,
        0.006_670_090_1,
        -0.001_262_491_1,
    ];
    let mut sum = A[7];
    for a in A[..7].iter().rev() {
        sum = sum * x + a;
    }
    (1.0 - x).sqrt() * sum
}

/// Cosine on [0, π/6], 1e-9.
#[inline(always)]
fn cosine(x: f64) -> f64 {
    let x2 = x * x;
    1.0 - x2 * (0.5 - x2 * (1.0 / 24.0 - x2 * (1.0 / 720.0 - x2 / 40320.0)))
}

dispatched! {
/// `<√v − limit>²` of every square v, and the greatest; `top` is the greatest v.
pub(super) fn excess(squares: &[V], top: f32, limit: f32, out: &mut [V]) -> f32 {
    for (out, v) in out.iter_mut().zip(squares) {
        for l in 0..LANES {
            let beyond = v.0[l].sqrt() - limit;
            let beyond = if beyond > 0.0 { beyond } else { 0.0 };
            out.0[l] = beyond * beyond;
        }
    }
    let beyond = (top.sqrt() - limit).max(0.0);
    beyond * beyond
}
}

/// `Σ (v²/top²)^{h}`, `top² > 0`, over the lanes' whole length, into one lane sum.
#[inline(always)]
pub(super) fn power_sum(squares: &[V], top: f32, h: f32) -> V {
    let inverse = 1.0 / top;
    let mut sum = V::ZERO;
    for v in squares {
        for l in 0..LANES {
            sum.0[l] += power(v.0[l] * inverse, h);
        }
    }
    sum
}

/// `x^h` for 0 ≤ x ≤ 1 and h > 0; below 2^−126 it is 2^−126 at most.
#[inline(always)]
fn power(x: f32, h: f32) -> f32 {
    exp2(h * log2(x))
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
    // Adding 1.5 · 2^23 rounds to the nearest integer and leaves it in the lowest bits (a cast of a float
    // to an integer saturates, which does not vectorise).
    const ROUND: f32 = 12_582_912.0;
    let t = if t < -126.0 { -126.0 } else { t };
    let rounded = t + ROUND;
    let f = (t - (rounded - ROUND)) * std::f32::consts::LN_2;
    let series = 1.0
        + f * (1.0
            + f * (0.5
                + f * (1.0 / 6.0
                    + f * (1.0 / 24.0 + f * (1.0 / 120.0 + f * (1.0 / 720.0 + f / 5040.0))))));
    series * f32::from_bits(rounded.to_bits().wrapping_add(127) << 23)
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
                let got = f64::from(power(x, h));
                if exact > 1e-30 {
                    worst = worst.max((got / exact - 1.0).abs());
                }
            }
        }
        println!("power: relative error {worst:.1e}");
        assert!(worst < 1e-5);
        assert!(power(0.0, 5.0) < 1e-37);
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
            let s = Stress6::of([xx, yy, zz, xy, xz, yz]);
            let v = |a: f64| V::splat(a as f32);
            for (measure, exact) in [
                (StressMeasure::VonMises, s.von_mises()),
                (StressMeasure::Octahedral, s.octahedral_shear()),
                (StressMeasure::MaxShear, s.max_shear()),
            ] {
                let five = [v(xx - yy), v(yy - zz), v(xy), v(xz), v(yz)];
                let (mut square, mut top) = (V::ZERO, [0.0; LANES]);
                squared(measure, five, &[1.0; LANES], &mut square, &mut top);
                assert_eq!(square.0, top);
                let got = f64::from(square.0[5]).sqrt();
                assert!(
                    (got - exact).abs() < 3e-7 * (1.0 + exact),
                    "{measure:?}: {got} {exact}"
                );
            }
        }
    }
}
