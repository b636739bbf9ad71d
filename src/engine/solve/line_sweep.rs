//! Zebra relaxation by x-lines, sixteen lines at a time.
//!
//! ```text
//! (L + e) z = r:   for all rows of one parity   z_j ← tridiag(L + e)⁻¹ (r_j − L_S z_{j−1} − L_N z_{j+1})
//! ```
//! Elimination along a line is a chain of dependent steps; sixteen lines side by side keep the vector
//! unit busy. Rows of one parity are numbered 0.. m−1 and dealt out in `blocks` blocks of [`LANES`]: row
//! `h` sits in block `h mod blocks`, lane `h / blocks`. So the neighbouring row lies in the neighbouring
//! block in the *same* lane, but for the first and last block, whose neighbours are one lane on: those two
//! are kept as extra blocks (the halo). Single precision. Sources: Thomas' algorithm; zebra order as in
//! Trottenberg, Oosterlee and Schüller, Multigrid (2001), §2.1.

use rayon::prelude::*;

use super::jacobian::Jacobian;
use crate::math::grid::Grid;

/// Lines side by side.
const LANES: usize = 16;

type Lane = [f32; LANES];
const ZERO: Lane = [0.0; LANES];

/// Factors of sixteen lines at one node.
#[derive(Debug, Clone, Copy)]
struct Factor {
    lower: Lane,
    upper: Lane,
    inverse: Lane,
    south: Lane,
    north: Lane,
}

const NO_FACTOR: Factor = Factor {
    lower: ZERO,
    upper: ZERO,
    inverse: ZERO,
    south: ZERO,
    north: ZERO,
};

/// Rows of one parity.
struct ParityRows {
    /// Rows.
    rows: usize,
    /// `[block][i]`
    factors: Vec<Factor>,
    /// Right-hand side, `[block][i]`.
    r: Vec<Lane>,
    /// Solution, `[halo below, blocks, halo above][i]`.
    z: Vec<Lane>,
}

/// Factors and scratch of the sweeps.
pub(super) struct LineSweep {
    nx: usize,
    /// Blocks of either half.
    blocks: usize,
    halves: [ParityRows; 2],
}

impl LineSweep {
    /// Buffers for `grid`.
    pub(super) fn new(grid: &Grid) -> Self {
        // The last stored row lies on the boundary and has no equation: with it, rows that fill whole blocks would
        // need one more.
        let rows = grid.interior_rows().end;
        let blocks = rows.div_ceil(2).div_ceil(LANES);
        let half = |rows: usize| ParityRows {
            rows,
            factors: vec![NO_FACTOR; blocks * grid.nx],
            r: vec![ZERO; blocks * grid.nx],
            z: vec![ZERO; (blocks + 2) * grid.nx],
        };
        Self {
            nx: grid.nx,
            blocks,
            halves: [half(rows.div_ceil(2)), half(rows / 2)],
        }
    }

    /// Factors the lines of a new linearisation; `extra` is e.
    pub(super) fn factor(&mut self, jacobian: &Jacobian, extra: &[f32]) {
        let (nx, blocks) = (self.nx, self.blocks);
        for (parity, half) in self.halves.iter_mut().enumerate() {
            let rows = half.rows;
            half.factors
                .par_chunks_mut(nx)
                .enumerate()
                .for_each(|(block, factors)| {
                    for lane in 0..LANES {
                        let h = lane * blocks + block;
                        if h < rows {
                            let j = 2 * h + parity;
                            gather_row(jacobian, j, &extra[j * nx..(j + 1) * nx], lane, factors);
                        }
                    }
                    eliminate(factors);
                });
        }
    }

    /// Sweeps the parities in `order` from z = 0 and writes z. The first two in `order` are either parity.
    pub(super) fn solve(&mut self, r: &[f32], order: &[usize], z: &mut [f32]) {
        let (nx, blocks) = (self.nx, self.blocks);
        self.halves[1 - order[0]].z.fill(ZERO);
        // One line alone has no neighbour to wait for.
        let order = if self.halves[1].rows == 0 {
            &[0]
        } else {
            order
        };
        for (n, &parity) in order.iter().enumerate() {
            self.sweep(parity, (n < 2).then_some(r));
        }
        z.par_chunks_mut(nx)
            .enumerate()
            .with_min_len(8)
            .for_each(|(j, row)| {
                let half = &self.halves[j % 2];
                if j / 2 >= half.rows {
                    row.fill(0.0);
                    return;
                }
                let (block, lane) = ((j / 2) % blocks, (j / 2) / blocks);
                for (v, z) in row.iter_mut().zip(&half.z[(block + 1) * nx..]) {
                    *v = z[lane];
                }
            });
    }

    /// Solves the lines of one parity; `r` is the right-hand side when it has not been dealt out yet.
    fn sweep(&mut self, parity: usize, r: Option<&[f32]>) {
        let (nx, blocks) = (self.nx, self.blocks);
        let [even, odd] = &mut self.halves;
        let (mine, other) = if parity == 0 {
            (even, odd)
        } else {
            (odd, even)
        };
        other.fill_halo(nx, blocks);
        // Row h of the even half lies between rows h−1 and h of the odd half, row h of the odd half
        // between h and h+1 of the even half; block b of z is number b + 1, after the halo.
        let (factors, neighbours) = (&mine.factors, &other.z[parity * nx..]);
        let rows = mine.rows;
        mine.z[nx..(blocks + 1) * nx]
            .par_chunks_mut(nx)
            .zip(mine.r.par_chunks_mut(nx))
            .enumerate()
            // A block takes a microsecond: two make a task worth handing over. With one, no thread falls asleep
            // meanwhile, and a mirrored step on 129² nodes and two threads takes 4 % less; but then nothing is left
            // for the thread that records, which costs more than that.
            .with_min_len(2)
            .for_each(|(block, (z, own))| {
                if let Some(r) = r {
                    for lane in 0..LANES {
                        let h = lane * blocks + block;
                        if h < rows {
                            deal(&r[(2 * h + parity) * nx..][..nx], lane, own);
                        }
                    }
                }
                let range = block * nx..(block + 1) * nx;
                let south = &neighbours[range.clone()];
                let north = &neighbours[range.start + nx..range.end + nx];
                sweep_block(&factors[range], own, south, north, z);
            });
    }
}

/// Puts a row of the right-hand side into its lane.
fn deal(row: &[f32], lane: usize, out: &mut [Lane]) {
    for (o, &v) in out.iter_mut().zip(row) {
        o[lane] = v;
    }
}

impl ParityRows {
    /// Fills the halo: the first block's rows below and the last block's rows above, one lane on. Row −1
    /// is row 0 of the odd half mirrored; where nothing is mirrored it belongs to the boundary, whose
    /// coefficients are zero.
    fn fill_halo(&mut self, nx: usize, blocks: usize) {
        let (below, others) = self.z.split_at_mut(nx);
        let (rows, above) = others.split_at_mut(blocks * nx);
        let (first, last) = (&rows[..nx], &rows[(blocks - 1) * nx..]);
        for i in 0..nx {
            below[i][0] = first[i][0];
            above[i][LANES - 1] = 0.0;
            for lane in 1..LANES {
                below[i][lane] = last[i][lane - 1];
                above[i][lane - 1] = first[i][lane];
            }
        }
    }
}

/// Puts grid row `j` of the Jacobian into `lane`: coefficients first, elimination follows.
fn gather_row(jacobian: &Jacobian, j: usize, extra: &[f32], lane: usize, factors: &mut [Factor]) {
    let [own, west, east, south, north] = jacobian.local(j);
    for (i, f) in factors.iter_mut().enumerate() {
        // A row of zeros is not active: its pivot stays 0 and so does its correction.
        f.inverse[lane] = if own[i] == 0.0 {
            0.0
        } else {
            own[i] + extra[i]
        };
        f.lower[lane] = west[i];
        f.upper[lane] = east[i];
        f.south[lane] = south[i];
        f.north[lane] = north[i];
    }
}

dispatched! {
/// From coefficients (the diagonal in `inverse`) to factors. The upper ones are over their pivots, so that one
/// multiplication and addition a node is all that waits for the node before.
fn eliminate(factors: &mut [Factor]) {
    let (mut upper, mut inverse) = (ZERO, ZERO);
    for f in factors {
        for k in 0..LANES {
            let lower = f.lower[k] * inverse[k];
            let pivot = f.inverse[k] - lower * upper[k];
            let safe = if f.inverse[k] == 0.0 { 1.0 } else { pivot };
            f.inverse[k] = if f.inverse[k] == 0.0 { 0.0 } else { 1.0 / safe };
            f.lower[k] = lower;
        }
        upper = f.upper;
        inverse = f.inverse;
        for (upper, inverse) in f.upper.iter_mut().zip(&inverse) {
            *upper *= inverse;
        }
    }
}
}

dispatched! {
fn sweep_block(factors: &[Factor], r: &[Lane], south: &[Lane], north: &[Lane], z: &mut [Lane]) {
    let nx = z.len();
    let (factors, r, south, north) = (&factors[..nx], &r[..nx], &south[..nx], &north[..nx]);
    let mut carry = ZERO;
    for i in 1..nx - 1 {
        let f = &factors[i];
        for k in 0..LANES {
            let free = r[i][k] - f.south[k] * south[i][k] - f.north[k] * north[i][k];
            carry[k] = free - f.lower[k] * carry[k];
            z[i][k] = carry[k] * f.inverse[k];
        }
    }
    carry = ZERO;
    for i in (1..nx - 1).rev() {
        let f = &factors[i];
        for k in 0..LANES {
            carry[k] = z[i][k] - f.upper[k] * carry[k];
        }
        z[i] = carry;
    }
}
}
