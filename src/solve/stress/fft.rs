//! Sixteen complex Fourier transforms at once, one per lane.
//!
//! ```text
//! X_k = Σ_j x_j e^{+2πi jk/n},   n = 2^a or 3·2^a
//! ```
//! Stockham's self-sorting form: each pass reads one buffer and writes the other, so there is no
//! bit reversal, and the lanes never mix, so every operation is a whole vector. The forward
//! transform is the same one with the real and imaginary parts exchanged on the way in and out.

use std::f64::consts::TAU;

use super::lanes::{C, V};

/// One buffer of lane transforms: real and imaginary parts apart.
#[derive(Debug, Clone)]
pub(super) struct Lanes {
    pub(super) re: Vec<V>,
    pub(super) im: Vec<V>,
}

impl Lanes {
    pub(super) fn new(n: usize) -> Self {
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
pub(super) struct LaneFft {
    n: usize,
    passes: Vec<Pass>,
}

impl LaneFft {
    /// Least length of the form 2^a or 3·2^a that is at least `least` and 32.
    pub(super) fn good_length(least: usize) -> usize {
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
    pub(super) fn new(n: usize) -> Self {
        let mut radices = Vec::new();
        let mut rest = n;
        if rest.is_multiple_of(3) {
            radices.push(3);
            rest /= 3;
        }
        while rest >= 4 {
            radices.push(4);
            rest /= 4;
        }
        if rest == 2 {
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
    pub(super) fn len(&self) -> usize {
        self.n
    }

    /// Transforms `x`; `other` is scratch. Both hold at least `n`; they may exchange their memory.
    pub(super) fn inverse(&self, x: &mut Lanes, other: &mut Lanes) {
        run(self, &mut x.re, &mut x.im, &mut other.re, &mut other.im);
        self.settle(x, other);
    }

    /// Same with `e^{−…}`.
    pub(super) fn forward(&self, x: &mut Lanes, other: &mut Lanes) {
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
            4 => pass_4(pass, (a_re, a_im), (b_re, b_im)),
            3 => pass_3(pass, (a_re, a_im), (b_re, b_im)),
            _ => pass_2(pass, (a_re, a_im), (b_re, b_im)),
        }
        std::mem::swap(&mut a_re, &mut b_re);
        std::mem::swap(&mut a_im, &mut b_im);
    }
}
}

#[inline(always)]
fn get(from: (&[V], &[V]), i: usize) -> C {
    C {
        re: from.0[i],
        im: from.1[i],
    }
}

#[inline(always)]
fn put(to: &mut (&mut [V], &mut [V]), i: usize, c: C) {
    to.0[i] = c.re;
    to.1[i] = c.im;
}

#[inline(always)]
fn turned(c: C, twiddle: (f32, f32)) -> C {
    let (cos, sin) = (V::splat(twiddle.0), V::splat(twiddle.1));
    C {
        re: c.im.fnma(sin, c.re * cos),
        im: c.im.fma(cos, c.re * sin),
    }
}

#[inline(always)]
fn pass_4(pass: &Pass, from: (&mut [V], &mut [V]), mut to: (&mut [V], &mut [V])) {
    let from = (&*from.0, &*from.1);
    let (m, s) = (pass.m, pass.s);
    for (p, w) in pass.twiddles.chunks_exact(3).enumerate() {
        for q in 0..s {
            let i = q + s * p;
            let (a, b) = (get(from, i), get(from, i + s * m));
            let (c, d) = (get(from, i + 2 * s * m), get(from, i + 3 * s * m));
            let (ac, bd) = (a.plus(c), b.plus(d));
            let (a_c, b_d) = (a.minus(c), b.minus(d));
            // i (b − d)
            let i_bd = C {
                re: -b_d.im,
                im: b_d.re,
            };
            let o = q + 4 * s * p;
            put(&mut to, o, ac.plus(bd));
            put(&mut to, o + s, turned(a_c.plus(i_bd), w[0]));
            put(&mut to, o + 2 * s, turned(ac.minus(bd), w[1]));
            put(&mut to, o + 3 * s, turned(a_c.minus(i_bd), w[2]));
        }
    }
}

#[inline(always)]
fn pass_3(pass: &Pass, from: (&mut [V], &mut [V]), mut to: (&mut [V], &mut [V])) {
    let from = (&*from.0, &*from.1);
    let (m, s) = (pass.m, pass.s);
    let (minus_half, sin_60) = (V::splat(-0.5), V::splat(0.75_f32.sqrt()));
    for (p, w) in pass.twiddles.chunks_exact(2).enumerate() {
        for q in 0..s {
            let i = q + s * p;
            let a = get(from, i);
            let (b, c) = (get(from, i + s * m), get(from, i + 2 * s * m));
            let (sum, difference) = (b.plus(c), b.minus(c));
            let centre = sum.fma(minus_half, a);
            let o = q + 3 * s * p;
            put(&mut to, o, a.plus(sum));
            put(
                &mut to,
                o + s,
                turned(difference.fma_i(sin_60, centre), w[0]),
            );
            put(
                &mut to,
                o + 2 * s,
                turned(difference.fma_i(-sin_60, centre), w[1]),
            );
        }
    }
}

#[inline(always)]
fn pass_2(pass: &Pass, from: (&mut [V], &mut [V]), mut to: (&mut [V], &mut [V])) {
    let from = (&*from.0, &*from.1);
    let (m, s) = (pass.m, pass.s);
    for (p, w) in pass.twiddles.iter().enumerate() {
        for q in 0..s {
            let i = q + s * p;
            let (a, b) = (get(from, i), get(from, i + s * m));
            let o = q + 2 * s * p;
            put(&mut to, o, a.plus(b));
            put(&mut to, o + s, turned(a.minus(b), *w));
        }
    }
}

dispatched! {
/// Input `u + i v` of a transform of length `n` for two real fields u and v (`None`: 0), given by the
/// first `width` modes that start at those places of `fields`.
pub(super) fn pack_pair(
    n: usize,
    width: usize,
    (u, v): (usize, Option<usize>),
    fields: &Lanes,
    out: &mut Lanes,
) {
    let modes = width.min(n / 2);
    let line = |o: usize| (&fields.re[o..o + modes], &fields.im[o..o + modes]);
    let (u_re, u_im) = line(u);
    if let Some((v_re, v_im)) = v.map(line) {
        for k in 0..modes {
            out.re[k] = u_re[k] - v_im[k];
            out.im[k] = u_im[k] + v_re[k];
            out.re[(n - k) % n] = u_re[k] + v_im[k];
            out.im[(n - k) % n] = v_re[k] - u_im[k];
        }
        // A real field has a real mean: what rounding left in its imaginary part goes.
        (out.re[0], out.im[0]) = (u_re[0], v_re[0]);
    } else {
        for k in 0..modes {
            out.re[k] = u_re[k];
            out.im[k] = u_im[k];
            out.re[(n - k) % n] = u_re[k];
            out.im[(n - k) % n] = -u_im[k];
        }
        (out.re[0], out.im[0]) = (u_re[0], V::ZERO);
    }
    out.re[modes..=n - modes].fill(V::ZERO);
    out.im[modes..=n - modes].fill(V::ZERO);
}
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
