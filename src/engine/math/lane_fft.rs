//! Sixteen complex Fourier transforms at once, one per lane.
//!
//! ```text
//! X_k = Σ_j x_j e^{+2πi jk/n},   n = 2^a or 3·2^a
//! ```
//! Stockham's self-sorting form: each pass reads one buffer and writes the other, so there is no
//! bit reversal, and the lanes never mix, so every operation is a whole vector. The forward
//! transform is the same one with the real and imaginary parts exchanged on the way in and out.
//!
//! Source: Van Loan (1992), *Computational Frameworks for the Fast Fourier Transform*, §1.7 (Stockham's form).

use std::f64::consts::TAU;

use super::fused::Fused as _;
use super::lanes::{LANES, TILE, V};

/// One buffer of lane transforms: real and imaginary parts apart.
#[derive(Debug, Clone)]
pub(crate) struct Lanes {
    pub(crate) re: Vec<V>,
    pub(crate) im: Vec<V>,
}

impl Lanes {
    pub(crate) fn new(n: usize) -> Self {
        Self {
            re: vec![V::ZERO; n],
            im: vec![V::ZERO; n],
        }
    }
}

#[derive(Debug, Clone)]
struct Pass {
    radix: usize,
    /// Length of the sub-transforms after this pass.
    m: usize,
    /// Stride.
    s: usize,
    /// Twiddles, (radix − 1) per p in 0..m: (cos, sin).
    twiddles: Vec<(f32, f32)>,
}

/// A planned transform.
#[derive(Debug, Clone)]
pub(crate) struct LaneFft {
    n: usize,
    passes: Vec<Pass>,
}

impl LaneFft {
    /// Least length of the form 2^a or 3·2^a that is at least `least` and 32.
    pub(crate) fn good_length(least: usize) -> usize {
        let mut n = 32;
        while n < least {
            n = if n.is_power_of_two() {
                n / 2 * 3
            } else {
                n / 3 * 4
            };
        }
        n
    }

    /// Plan for length `n`, which must be a [`Self::good_length`].
    pub(crate) fn new(n: usize) -> Self {
        let mut radices = Vec::new();
        let mut remaining = n;
        if remaining.is_multiple_of(3) {
            radices.push(3);
            remaining /= 3;
        }
        while remaining >= 4 {
            radices.push(4);
            remaining /= 4;
        }
        if remaining == 2 {
            radices.push(2);
        }
        let (mut length, mut s) = (n, 1);
        let mut passes = Vec::new();
        for radix in radices {
            let m = length / radix;
            let twiddles = (0..m)
                .flat_map(|p| (1..radix).map(move |r| (p * r) as f64 / length as f64))
                .map(|turn| ((TAU * turn).cos() as f32, (TAU * turn).sin() as f32))
                .collect();
            passes.push(Pass {
                radix,
                m,
                s,
                twiddles,
            });
            length = m;
            s *= radix;
        }
        Self { n, passes }
    }

    /// Length.
    pub(crate) fn len(&self) -> usize {
        self.n
    }

    /// Transforms `x`; `other` is scratch. Both hold at least `n`; they may exchange their memory.
    pub(crate) fn inverse(&self, x: &mut Lanes, other: &mut Lanes) {
        run(self, &mut x.re, &mut x.im, &mut other.re, &mut other.im);
        self.settle(x, other);
    }

    /// Same with `e^{−…}`.
    pub(crate) fn forward(&self, x: &mut Lanes, other: &mut Lanes) {
        run(self, &mut x.im, &mut x.re, &mut other.im, &mut other.re);
        self.settle(x, other);
    }

    /// An odd number of passes ends in the other buffer.
    fn settle(&self, x: &mut Lanes, other: &mut Lanes) {
        if !self.passes.len().is_multiple_of(2) {
            std::mem::swap(x, other);
        }
    }
}

dispatched! {
fn run(fft: &LaneFft, re: &mut [V], im: &mut [V], other_re: &mut [V], other_im: &mut [V]) {
    let n = fft.n;
    let (mut a_re, mut a_im) = (&mut re[..n], &mut im[..n]);
    let (mut b_re, mut b_im) = (&mut other_re[..n], &mut other_im[..n]);
    for pass in &fft.passes {
        match pass.radix {
            4 => pass_4(pass, [a_re, a_im], b_re, b_im),
            3 => pass_3(pass, [a_re, a_im], b_re, b_im),
            _ => pass_2(pass, [a_re, a_im], b_re, b_im),
        }
        std::mem::swap(&mut a_re, &mut b_re);
        std::mem::swap(&mut a_im, &mut b_im);
    }
}
}

#[inline(always)]
fn pass_4(pass: &Pass, from: [&[V]; 2], to_re: &mut [V], to_im: &mut [V]) {
    let (m, s) = (pass.m, pass.s);
    let quarter = s * m;
    for (p, w) in pass.twiddles.chunks_exact(3).enumerate() {
        for q in 0..s {
            let i = q + s * p;
            let (re, im) = butterfly_4(four(from[0], i, quarter), four(from[1], i, quarter), w);
            let o = q + 4 * s * p;
            for r in 0..4 {
                to_re[o + r * s] = re[r];
                to_im[o + r * s] = im[r];
            }
        }
    }
}

#[inline(always)]
fn four(x: &[V], i: usize, step: usize) -> [V; 4] {
    [x[i], x[i + step], x[i + 2 * step], x[i + 3 * step]]
}

#[inline(always)]
fn three(x: &[V], i: usize, step: usize) -> [V; 3] {
    [x[i], x[i + step], x[i + 2 * step]]
}

/// One radix-4 step. The loop over lanes is the outer one and its body is long, because only then does
/// the compiler turn it into vectors: chains of whole-vector operations are unrolled into scalars first.
#[inline(always)]
fn butterfly_4(re: [V; 4], im: [V; 4], w: &[(f32, f32)]) -> ([V; 4], [V; 4]) {
    let [V(ar), V(br), V(cr), V(dr)] = re;
    let [V(ai), V(bi), V(ci), V(di)] = im;
    let [(c1, s1), (c2, s2), (c3, s3)] = [w[0], w[1], w[2]];
    let (mut r0, mut r1, mut r2, mut r3) = ([0.0; LANES], [0.0; LANES], [0.0; LANES], [0.0; LANES]);
    let (mut i0, mut i1, mut i2, mut i3) = ([0.0; LANES], [0.0; LANES], [0.0; LANES], [0.0; LANES]);
    for l in 0..LANES {
        let (ac_r, ac_i) = (ar[l] + cr[l], ai[l] + ci[l]);
        let (bd_r, bd_i) = (br[l] + dr[l], bi[l] + di[l]);
        let (a_c_r, a_c_i) = (ar[l] - cr[l], ai[l] - ci[l]);
        let (b_d_r, b_d_i) = (br[l] - dr[l], bi[l] - di[l]);
        r0[l] = ac_r + bd_r;
        i0[l] = ac_i + bd_i;
        let (xr, xi) = (a_c_r - b_d_i, a_c_i + b_d_r);
        r1[l] = xr.fused(c1, -(xi * s1));
        i1[l] = xr.fused(s1, xi * c1);
        let (xr, xi) = (ac_r - bd_r, ac_i - bd_i);
        r2[l] = xr.fused(c2, -(xi * s2));
        i2[l] = xr.fused(s2, xi * c2);
        let (xr, xi) = (a_c_r + b_d_i, a_c_i - b_d_r);
        r3[l] = xr.fused(c3, -(xi * s3));
        i3[l] = xr.fused(s3, xi * c3);
    }
    ([V(r0), V(r1), V(r2), V(r3)], [V(i0), V(i1), V(i2), V(i3)])
}

#[inline(always)]
fn pass_3(pass: &Pass, from: [&[V]; 2], to_re: &mut [V], to_im: &mut [V]) {
    let (m, s) = (pass.m, pass.s);
    let third = s * m;
    for (p, w) in pass.twiddles.chunks_exact(2).enumerate() {
        for q in 0..s {
            let i = q + s * p;
            let (re, im) = butterfly_3(three(from[0], i, third), three(from[1], i, third), w);
            let o = q + 3 * s * p;
            for r in 0..3 {
                to_re[o + r * s] = re[r];
                to_im[o + r * s] = im[r];
            }
        }
    }
}

#[inline(always)]
fn butterfly_3(re: [V; 3], im: [V; 3], w: &[(f32, f32)]) -> ([V; 3], [V; 3]) {
    // √3/2.
    const SIN_60: f32 = 0.866_025_4;
    let [V(ar), V(br), V(cr)] = re;
    let [V(ai), V(bi), V(ci)] = im;
    let [(c1, s1), (c2, s2)] = [w[0], w[1]];
    let (mut r0, mut r1, mut r2) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
    let (mut i0, mut i1, mut i2) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
    for l in 0..LANES {
        let (sum_r, sum_i) = (br[l] + cr[l], bi[l] + ci[l]);
        let (turn_r, turn_i) = ((ci[l] - bi[l]) * SIN_60, (br[l] - cr[l]) * SIN_60);
        let (mid_r, mid_i) = (sum_r.fused(-0.5, ar[l]), sum_i.fused(-0.5, ai[l]));
        r0[l] = ar[l] + sum_r;
        i0[l] = ai[l] + sum_i;
        let (xr, xi) = (mid_r + turn_r, mid_i + turn_i);
        r1[l] = xr.fused(c1, -(xi * s1));
        i1[l] = xr.fused(s1, xi * c1);
        let (xr, xi) = (mid_r - turn_r, mid_i - turn_i);
        r2[l] = xr.fused(c2, -(xi * s2));
        i2[l] = xr.fused(s2, xi * c2);
    }
    ([V(r0), V(r1), V(r2)], [V(i0), V(i1), V(i2)])
}

#[inline(always)]
fn pass_2(pass: &Pass, from: [&[V]; 2], to_re: &mut [V], to_im: &mut [V]) {
    // Always the last pass, whose twiddle is 1.
    let (m, s) = (pass.m, pass.s);
    for p in 0..m {
        for q in 0..s {
            let (i, o) = (q + s * p, q + 2 * s * p);
            let (re, im) = (
                [from[0][i], from[0][i + s * m]],
                [from[1][i], from[1][i + s * m]],
            );
            to_re[o] = re[0] + re[1];
            to_im[o] = im[0] + im[1];
            to_re[o + s] = re[0] - re[1];
            to_im[o + s] = im[0] - im[1];
        }
    }
}

dispatched! {
/// Input `u + i v` of a transform of length `n` for two real fields u and v (`None`: 0), given by the
/// first `width` modes (a multiple of 16) that start at those places of `fields`.
pub(crate) fn pack_pair(
    n: usize,
    width: usize,
    (u, v): (usize, Option<usize>),
    fields: &Lanes,
    out: &mut Lanes,
) {
    let modes = width.min(n / 2);
    for first in (0..modes).step_by(LANES) {
        let [u_re, u_im] = [flat(&fields.re, u + first), flat(&fields.im, u + first)];
        let [v_re, v_im] = match v {
            Some(v) => [flat(&fields.re, v + first), flat(&fields.im, v + first)],
            None => [[0.0; TILE]; 2],
        };
        let (mut re, mut im) = ([0.0; TILE], [0.0; TILE]);
        let (mut mirror_re, mut mirror_im) = ([0.0; TILE], [0.0; TILE]);
        for i in 0..TILE {
            re[i] = u_re[i] - v_im[i];
            im[i] = u_im[i] + v_re[i];
            mirror_re[i] = u_re[i] + v_im[i];
            mirror_im[i] = v_re[i] - u_im[i];
        }
        for l in 0..LANES.min(modes - first) {
            let k = first + l;
            out.re[k] = row(&re, l);
            out.im[k] = row(&im, l);
            out.re[(n - k) % n] = row(&mirror_re, l);
            out.im[(n - k) % n] = row(&mirror_im, l);
        }
    }
    // A real field has a real mean: what rounding left in its imaginary part goes.
    out.re[0] = fields.re[u];
    out.im[0] = v.map_or(V::ZERO, |v| fields.re[v]);
    out.re[modes..=n - modes].fill(V::ZERO);
    out.im[modes..=n - modes].fill(V::ZERO);
}
}

/// Sixteen rows in a line.
#[inline(always)]
fn flat(x: &[V], o: usize) -> [f32; TILE] {
    let mut out = [0.0; TILE];
    for (row, v) in out.chunks_exact_mut(LANES).zip(&x[o..o + LANES]) {
        row.copy_from_slice(&v.0);
    }
    out
}

#[inline(always)]
fn row(x: &[f32; TILE], l: usize) -> V {
    let mut v = V::ZERO;
    v.0.copy_from_slice(&x[l * LANES..(l + 1) * LANES]);
    v
}

/// Index of the plan of length `n`, made if it is not there.
pub(crate) fn plan_of(plans: &mut Vec<LaneFft>, n: usize) -> usize {
    plans
        .iter()
        .position(|plan| plan.len() == n)
        .unwrap_or_else(|| {
            plans.push(LaneFft::new(n));
            plans.len() - 1
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Deterministic numbers in [−1, 1).
    fn noise(i: usize) -> f32 {
        ((i * 7919 + 104_729) % 10_007) as f32 / 5_003.5 - 1.0
    }

    fn fill(n: usize) -> Lanes {
        let mut x = Lanes::new(n);
        for j in 0..n {
            for l in 0..16 {
                x.re[j].0[l] = noise(16 * j + l);
                x.im[j].0[l] = noise(31 * j + 7 * l + 3);
            }
        }
        x
    }

    #[test]
    fn transforms_equal_the_sum() {
        for n in [32, 48, 64, 96, 128, 192] {
            let (x, mut a, mut b) = (fill(n), fill(n), Lanes::new(n));
            LaneFft::new(n).inverse(&mut a, &mut b);
            let y = a;
            let mut worst: f64 = 0.0;
            for (k, lane) in [(0, 0), (1, 5), (n / 3, 7), (n / 2, 15), (n - 1, 2)] {
                let (mut re, mut im) = (0.0, 0.0);
                for j in 0..n {
                    let (sin, cos) = (TAU * ((j * k) % n) as f64 / n as f64).sin_cos();
                    let (u, v) = (f64::from(x.re[j].0[lane]), f64::from(x.im[j].0[lane]));
                    re += u * cos - v * sin;
                    im += u * sin + v * cos;
                }
                worst = worst.max((re - f64::from(y.re[k].0[lane])).abs());
                worst = worst.max((im - f64::from(y.im[k].0[lane])).abs());
            }
            println!("n = {n}: {worst:.1e}");
            assert!(worst < 2e-5, "n = {n}: {worst}");
        }
    }

    #[test]
    fn forward_undoes_inverse() {
        let n = 96;
        let fft = LaneFft::new(n);
        let (x, mut a, mut b) = (fill(n), fill(n), Lanes::new(n));
        fft.inverse(&mut a, &mut b);
        fft.forward(&mut a, &mut b);
        let z = a;
        for j in 0..n {
            assert!((z.re[j].0[3] / n as f32 - x.re[j].0[3]).abs() < 1e-6);
            assert!((z.im[j].0[3] / n as f32 - x.im[j].0[3]).abs() < 1e-6);
        }
    }

    #[test]
    fn good_lengths_climb_in_small_steps() {
        let lengths: Vec<_> = [1, 33, 49, 65, 97, 129, 192, 193, 385]
            .into_iter()
            .map(LaneFft::good_length)
            .collect();
        assert_eq!(lengths, [32, 48, 64, 96, 128, 192, 192, 256, 512]);
    }
}
