//! Sixteen single-precision numbers side by side, and the 16 × 16 transpose.
//!
//! Everything here is `inline(always)` so that it takes the instruction set of the dispatched
//! function that calls it. Fused multiply-add is used throughout: outside such a function it would
//! be a library call.
//!
//! Ours: no equation. The transpose exchanges blocks of 8, 4, 2 and 1.

use std::ops::{Add, AddAssign, Mul, Neg, Sub};

use super::fused::Fused as _;

/// Number of lanes.
pub(crate) const LANES: usize = 16;

/// Numbers of sixteen rows.
pub(crate) const TILE: usize = LANES * LANES;

/// Sixteen numbers.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(crate) struct V(pub(crate) [f32; LANES]);

impl V {
    pub(crate) const ZERO: Self = Self([0.0; LANES]);

    #[inline(always)]
    pub(crate) fn splat(value: f32) -> Self {
        Self([value; LANES])
    }

    /// From a slice that may be shorter; the rest is zero.
    #[inline(always)]
    pub(crate) fn from_part(part: &[f32]) -> Self {
        let mut v = Self::ZERO;
        let n = part.len().min(LANES);
        v.0[..n].copy_from_slice(&part[..n]);
        v
    }

    /// `self · b + c`.
    #[inline(always)]
    pub(crate) fn fma(self, b: Self, c: Self) -> Self {
        let mut out = self;
        for l in 0..LANES {
            out.0[l] = self.0[l].fused(b.0[l], c.0[l]);
        }
        out
    }

    /// `c − self · b`.
    #[inline(always)]
    pub(crate) fn fnma(self, b: Self, c: Self) -> Self {
        let mut out = self;
        for l in 0..LANES {
            out.0[l] = (-self.0[l]).fused(b.0[l], c.0[l]);
        }
        out
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
pub(crate) struct C {
    pub(crate) re: V,
    pub(crate) im: V,
}

impl C {
    pub(crate) const ZERO: Self = Self {
        re: V::ZERO,
        im: V::ZERO,
    };

    /// Times a real.
    #[inline(always)]
    pub(crate) fn scale(self, a: V) -> Self {
        Self {
            re: self.re * a,
            im: self.im * a,
        }
    }

    /// Times `i a`.
    #[inline(always)]
    pub(crate) fn scale_i(self, a: V) -> Self {
        Self {
            re: -(self.im * a),
            im: self.re * a,
        }
    }

    /// `self a + c` with a real.
    #[inline(always)]
    pub(crate) fn fma(self, a: V, c: Self) -> Self {
        Self {
            re: self.re.fma(a, c.re),
            im: self.im.fma(a, c.im),
        }
    }

    /// `i a self + c` with a real.
    #[inline(always)]
    pub(crate) fn fma_i(self, a: V, c: Self) -> Self {
        Self {
            re: self.im.fnma(a, c.re),
            im: self.re.fma(a, c.im),
        }
    }

    #[inline(always)]
    pub(crate) fn plus(self, b: Self) -> Self {
        Self {
            re: self.re + b.re,
            im: self.im + b.im,
        }
    }

    #[inline(always)]
    pub(crate) fn minus(self, b: Self) -> Self {
        Self {
            re: self.re - b.re,
            im: self.im - b.im,
        }
    }
}

/// Rows become columns.
#[inline(always)]
pub(crate) fn transpose(rows: &[V; LANES]) -> [V; LANES] {
    let mut tile = [0.0; TILE];
    for (r, row) in rows.iter().enumerate() {
        tile[r * LANES..(r + 1) * LANES].copy_from_slice(&row.0);
    }
    transpose_tile(&mut tile);
    let mut out = [V::ZERO; LANES];
    for (r, row) in out.iter_mut().enumerate() {
        row.0.copy_from_slice(&tile[r * LANES..(r + 1) * LANES]);
    }
    out
}

/// Rows become columns, in place.
#[inline(always)]
pub(crate) fn transpose_tile(a: &mut [f32; TILE]) {
    // A perfect shuffle of the 256 numbers turns the bits of (row, lane) by one place; after four of
    // them row and lane have changed places. Long plain loops become vector permutations; moves of
    // single rows would become 256 scalar ones.
    let mut b = [0.0; TILE];
    shuffle(a, &mut b);
    shuffle(&b, a);
    shuffle(a, &mut b);
    shuffle(&b, a);
}

#[inline(always)]
fn shuffle(from: &[f32; TILE], to: &mut [f32; TILE]) {
    let (low, high) = from.split_at(TILE / 2);
    for i in 0..TILE / 2 {
        to[2 * i] = low[i];
        to[2 * i + 1] = high[i];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transpose_exchanges_row_and_lane() {
        let mut rows = [V::ZERO; LANES];
        for (r, row) in rows.iter_mut().enumerate() {
            for (l, number) in row.0.iter_mut().enumerate() {
                *number = (100 * r + l) as f32;
            }
        }
        for (l, column) in transpose(&rows).iter().enumerate() {
            for (r, number) in column.0.iter().enumerate() {
                assert_eq!(*number, (100 * r + l) as f32);
            }
        }
    }
}
