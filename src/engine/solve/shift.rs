//! What a row carries, some nodes further downstream.
//!
//! ```text
//! f(x_i − n dx) = Σ_m w_m f(x_k+m),   Lagrange's weights of ten nodes around
//! ```
//! A whole number of nodes is exact. With four points, fractional steps wore the ripples of a film down: at half-node
//! steps life came out 8 % too long (default scene, 129 nodes; with ten points they differ from whole nodes by 0.8 %).
//! Where ten points correct four by more than [`SMOOTH`] a spot's edge lies between, which polynomials overshoot: there
//! it is four.
//!
//! Source: Abramowitz and Stegun (1964), 25.2, for Lagrange's formula. Ours: where four points stand in for ten.

/// Nodes of the interpolation on either side: with two, ripples wore down (above).
const HALF: usize = 5;
/// Share of a value by which ten points may correct four; a wave of eight nodes is corrected by 1 % of its
/// amplitude.
const SMOOTH: f64 = 0.2;

/// Shift of a row downstream by some nodes: whole ones, and interpolation between `2 HALF` nodes for the remainder.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shift {
    whole: isize,
    /// Lagrange's weights of the nodes around, upstream first, and of the four in their midst; `None`: the shift
    /// is whole.
    weights: Option<([f64; 2 * HALF], [f64; 4])>,
}

impl Shift {
    pub(super) fn new(nodes: f64) -> Self {
        let t = nodes.ceil() - nodes;
        Self {
            whole: nodes.ceil() as isize,
            weights: (t >= 1e-9).then(|| (lagrange(t), lagrange(t))),
        }
    }

    /// Value of `row` that arrives at node `i`.
    #[inline(always)]
    pub(super) fn of(self, row: &[f64], i: usize) -> f64 {
        let k = i as isize - self.whole;
        let Some((weights, few)) = self.weights else {
            return sample(row, k);
        };
        let first = k + 1 - HALF as isize;
        let inside = usize::try_from(first)
            .ok()
            .and_then(|first| row.get(first..)?.first_chunk::<{ 2 * HALF }>());
        let plain = (0..4)
            .map(|m| few[m] * sample(row, k - 1 + m as isize))
            .sum();
        let Some(near) = inside else { return plain };
        let fine: f64 = (0..2 * HALF).map(|m| weights[m] * near[m]).sum();
        if (fine - plain).abs() <= SMOOTH * plain {
            fine
        } else {
            plain
        }
    }
}

/// Lagrange's weights of `N` nodes a unit apart at `t` beyond the node before their middle.
fn lagrange<const N: usize>(t: f64) -> [f64; N] {
    let at = |m: usize| 1.0 - (N / 2) as f64 + m as f64;
    std::array::from_fn(|m| {
        let others = (0..N).filter(|&k| k != m);
        others.map(|k| (t - at(k)) / (at(m) - at(k))).product()
    })
}

/// Node `k`, continued quadratically upstream of the inlet and constantly downstream.
#[inline(always)]
fn sample(row: &[f64], k: isize) -> f64 {
    let last = row.len() as isize - 1;
    if k >= 0 {
        row[k.min(last) as usize]
    } else {
        let t = k as f64;
        row[0] * (t - 1.0) * (t - 2.0) / 2.0 - row[1] * t * (t - 2.0) + row[2] * t * (t - 1.0) / 2.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn waves_keep_their_height() {
        // Eight nodes a wave, carried 64 nodes by half-node steps: four points would leave a third of it.
        let wave = |x: f64| 1.0 + 0.2 * (std::f64::consts::TAU * x / 8.0).sin();
        let mut row: Vec<f64> = (0..257).map(|i| wave(f64::from(i))).collect();
        let shift = Shift::new(0.5);
        for _ in 0..128 {
            row = (0..257).map(|i| shift.of(&row, i)).collect();
        }
        for (i, &v) in row.iter().enumerate().take(240).skip(160) {
            assert!((v - wave(i as f64 - 64.0)).abs() < 0.01 * 0.2, "{i}: {v}");
        }
    }

    #[test]
    fn an_edge_is_not_overshot() {
        let row: Vec<f64> = (0..33).map(|i| if i < 16 { 1e-3 } else { 1.0 }).collect();
        let shift = Shift::new(0.5);
        let four = |i: usize| (9.0 * (row[i - 1] + row[i]) - row[i - 2] - row[i + 1]) / 16.0;
        for i in 12..22 {
            assert!((shift.of(&row, i) - four(i)).abs() <= SMOOTH * four(i).abs() + 1e-12);
        }
    }
}
