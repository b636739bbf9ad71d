//! Sixteen single-precision numbers side by side, and the 16 × 16 transpose.
//!
//! Everything here is `inline(always)` so that it takes the instruction set of the dispatched
//! function that calls it. Fused multiply-add is used throughout: outside such a function it would
//! be a library call.

use std::ops::{Add, AddAssign, Mul, Neg, Sub};

/// Number of lanes.
pub(super) const LANES: usize = 16;

/// Sixteen numbers.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(super) struct V(pub(super) [f32; LANES]);

impl V {
    pub(super) const ZERO: Self = Self([0.0; LANES]);

    #[inline(always)]
    pub(super) fn splat(value: f32) -> Self {
        Self([value; LANES])
    }

    /// From a slice that may be shorter; the rest is zero.
    #[inline(always)]
    pub(super) fn from_part(part: &[f32]) -> Self {
        let mut v = Self::ZERO;
        let n = part.len().min(LANES);
        v.0[..n].copy_from_slice(&part[..n]);
        v
    }

    /// `self · b + c`.
    #[inline(always)]
    pub(super) fn fma(self, b: Self, c: Self) -> Self {
        let mut out = self;
        for l in 0..LANES {
            out.0[l] = self.0[l].mul_add(b.0[l], c.0[l]);
        }
        out
    }

    /// `c − self · b`.
    #[inline(always)]
    pub(super) fn fnma(self, b: Self, c: Self) -> Self {
        let mut out = self;
        for l in 0..LANES {
            out.0[l] = (-self.0[l]).mul_add(b.0[l], c.0[l]);
        }
        out
    }

    #[inline(always)]
    pub(super) fn max(self, b: Self) -> Self {
        let mut out = self;
        for l in 0..LANES {
            out.0[l] = if b.0[l] > self.0[l] {
                b.0[l]
            } else {
                self.0[l]
            };
        }
        out
    }

    /// Greatest lane.
    pub(super) fn greatest(self) -> f32 {
        self.0.into_iter().fold(f32::MIN, f32::max)
    }
}

impl Add for V {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        let mut out = self;
        for l in 0..LANES {
            out.0[l] += b.0[l];
        }
        out
    }
}

impl AddAssign for V {
    #[inline(always)]
    fn add_assign(&mut self, b: Self) {
        *self = *self + b;
    }
}

impl Sub for V {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        let mut out = self;
        for l in 0..LANES {
            out.0[l] -= b.0[l];
        }
        out
    }
}

impl Mul for V {
    type Output = Self;
    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        let mut out = self;
        for l in 0..LANES {
            out.0[l] *= b.0[l];
        }
        out
    }
}

impl Neg for V {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        let mut out = self;
        for l in 0..LANES {
            out.0[l] = -out.0[l];
        }
        out
    }
}

/// A complex lane value.
#[derive(Debug, Clone, Copy)]
pub(super) struct C {
    pub(super) re: V,
    pub(super) im: V,
}

impl C {
    pub(super) const ZERO: Self = Self {
        re: V::ZERO,
        im: V::ZERO,
    };

    /// Times a real.
    #[inline(always)]
    pub(super) fn scale(self, a: V) -> Self {
        Self {
            re: self.re * a,
            im: self.im * a,
        }
    }

    /// Times `i a`.
    #[inline(always)]
    pub(super) fn scale_i(self, a: V) -> Self {
        Self {
            re: -(self.im * a),
            im: self.re * a,
        }
    }

    /// `self a + c` with a real.
    #[inline(always)]
    pub(super) fn fma(self, a: V, c: Self) -> Self {
        Self {
            re: self.re.fma(a, c.re),
            im: self.im.fma(a, c.im),
        }
    }

    /// `i a self + c` with a real.
    #[inline(always)]
    pub(super) fn fma_i(self, a: V, c: Self) -> Self {
        Self {
            re: self.im.fnma(a, c.re),
            im: self.re.fma(a, c.im),
        }
    }

    #[inline(always)]
    pub(super) fn plus(self, b: Self) -> Self {
        Self {
            re: self.re + b.re,
            im: self.im + b.im,
        }
    }

    #[inline(always)]
    pub(super) fn minus(self, b: Self) -> Self {
        Self {
            re: self.re - b.re,
            im: self.im - b.im,
        }
    }
}

/// Rows become columns.
#[inline(always)]
pub(super) fn transpose(rows: &[V; LANES]) -> [V; LANES] {
    // Four rounds of interleaving a row with the row half a block below: a perfect shuffle of the
    // index bits (row, lane), after four of which row and lane have changed places.
    let mut a = *rows;
    for _ in 0..4 {
        let mut b = [V::ZERO; LANES];
        for r in 0..LANES / 2 {
            let (low, high) = interleave(a[r], a[r + LANES / 2]);
            b[2 * r] = low;
            b[2 * r + 1] = high;
        }
        a = b;
    }
    a
}

#[inline(always)]
fn interleave(a: V, b: V) -> (V, V) {
    let (mut low, mut high) = (V::ZERO, V::ZERO);
    for l in 0..LANES / 2 {
        low.0[2 * l] = a.0[l];
        low.0[2 * l + 1] = b.0[l];
        high.0[2 * l] = a.0[l + LANES / 2];
        high.0[2 * l + 1] = b.0[l + LANES / 2];
    }
    (low, high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transpose_exchanges_row_and_lane() {
        let mut rows = [V::ZERO; LANES];
        for r in 0..LANES {
            for l in 0..LANES {
                rows[r].0[l] = (100 * r + l) as f32;
            }
        }
        let turned = transpose(&rows);
        for r in 0..LANES {
            for l in 0..LANES {
                assert_eq!(turned[l].0[r], rows[r].0[l]);
            }
        }
    }
}
