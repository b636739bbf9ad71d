//! Couette flow and squeeze together, along characteristics.
//!
//! ```text
//! U ∂x(ρh) + ∂t(ρh) = d(ρh)/dt along the mean speed
//! C* = (18 c1 − 9 c2 + 2 c3)/11,  s = 6ΔT/11        (BDF3; for unequal steps by Lagrange's polynomial)
//! c1 = c(X−ΔT, T−ΔT),  c2 = c(X−ΔT−ΔT', T−ΔT−ΔT'),  c3 one step further back
//! ```
//! With `c = ρ̄H` stored at each step, ΔT = dX shifts by exactly one node: no numerical diffusion. Fractions
//! of a node use ten-point interpolation, not below 0: with four points half-node steps wore the ripples down,
//! and life came out 8 % too long (129 nodes, default scene; now 0.1 %). Where the two differ by more than a
//! fifth, at the edge of a spot that touches, it is four points still.
//!
//! The third order is worth its one more field: oil that enters a contact sees its pressure rise within some
//! nodes, so even a steady film has a time error. Of the default scene's central film at one node a step
//! BDF2 missed 7 %, BDF3 misses 1 %. Where fewer steps are known, steps grow fast, or the orders differ by more than
//! a fifth of c1, this is BDF2,
//! ```text
//! C* = c1 + θ_s ω²/(1+2ω) (c1 − c2),   s = ΔT (1+ω)/(1+2ω) for θ_s = 1,   ω = ΔT/ΔT'
//! ```
//! whose weight θ_s goes down, and the formula towards backward Euler, until c1 is no more than halved: node
//! by node, each with its own s, nothing is clipped. Local error, of the second-order formula (the third
//! order is better; steps chosen by it are on the safe side):
//! ```text
//! e = ΔT³ (1+ω)²/(ω(1+2ω)) |c[T, T−ΔT, T−ΔT−ΔT', ...]|        (third divided difference along the path)
//! ```
//! Tests: below, `tests/ehl_transient.rs`, `tests/stepping.rs`.

use serde::{Deserialize, Serialize};

use rayon::prelude::*;

use crate::math::grid::Grid;

/// Pressure below which ripples count as absolute, not relative.
const FLOOR: f64 = 0.02;
/// Nodes travelled in which the slow part of the pressure forgets.
const SLOW_NODES: f64 = 32.0;

/// Convected mass of two past steps, and the ripple of two past pressures for the predictor.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct History {
    /// ρ̄H one step back, shape ny × nx.
    pub mass_1: Vec<f64>,
    /// ρ̄H two steps back.
    pub mass_2: Vec<f64>,
    /// ρ̄H three steps back.
    pub mass_3: Vec<f64>,
    /// Pressure one step back.
    pub pressure_1: Vec<f64>,
    /// Pressure two steps back.
    pub pressure_2: Vec<f64>,
    /// Slowly varying part of the pressure, which does not travel.
    pub pressure_slow: Vec<f64>,
    /// H0 one and two steps back.
    pub h0: [f64; 2],
    /// Last step in nodes; 0: no second step is known.
    pub last_nodes: f64,
    /// The step before it; 0: no third step is known.
    pub earlier_nodes: f64,
}

/// Part of c1 below which C* is not extrapolated.
const LEAST_SHARE: f64 = 0.5;
/// Share of a value by which a higher order may correct a lower one: more says that a spot's edge lies between,
/// where polynomials overshoot; near dry that shut oil in where none was (`tests/dry_limit.rs`).
const SMOOTH: f64 = 0.2;
/// Growth from step to step up to which the third order is stable (1.534 for ever; Calvo, Grande and Grigorieff
/// 1990).
const MOST_GROWTH: f64 = 1.5;

/// Weights of c1, c2, c3 in C*, and s over ΔT.
struct ThirdOrder {
    weights: [f64; 3],
    implicit: f64,
}

/// Nodes of the interpolation on either side.
const HALF: usize = 5;

/// Shift of a row downstream by some nodes: whole ones, and interpolation between `2 HALF` nodes for the rest.
#[derive(Debug, Clone, Copy)]
struct Shift {
    whole: isize,
    /// Lagrange's weights of the nodes around, upstream first, and of the four in their midst; `None`: the shift
    /// is whole.
    weights: Option<([f64; 2 * HALF], [f64; 4])>,
}

impl Shift {
    fn new(nodes: f64) -> Self {
        let t = nodes.ceil() - nodes;
        Self {
            whole: nodes.ceil() as isize,
            weights: (t >= 1e-9).then(|| (lagrange(t), lagrange(t))),
        }
    }

    /// Value of `row` that arrives at node `i`.
    #[inline(always)]
    fn of(self, row: &[f64], i: usize) -> f64 {
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

impl History {
    /// A steady past: the film `mass` and pressure `p` as they are.
    pub fn steady(mass: &[f64], p: &[f64], h0: f64) -> Self {
        Self {
            mass_1: mass.to_vec(),
            mass_2: mass.to_vec(),
            mass_3: mass.to_vec(),
            pressure_1: p.to_vec(),
            pressure_2: p.to_vec(),
            pressure_slow: p.to_vec(),
            h0: [h0; 2],
            last_nodes: 0.0,
            earlier_nodes: 0.0,
        }
    }

    /// Whether every field has `len` nodes.
    pub fn fits(&self, len: usize) -> bool {
        let Self {
            mass_1,
            mass_2,
            mass_3,
            pressure_1,
            pressure_2,
            pressure_slow,
            h0: _,
            last_nodes: _,
            earlier_nodes: _,
        } = self;
        [
            mass_1,
            mass_2,
            mass_3,
            pressure_1,
            pressure_2,
            pressure_slow,
        ]
        .iter()
        .all(|field| field.len() == len)
    }

    /// C* and s for a step of `nodes` nodes.
    pub fn convect(&self, grid: &Grid, nodes: f64, c_star: &mut [f64], s: &mut [f64]) {
        let dt = nodes * grid.dx;
        let second = self.second_order(nodes);
        let third = self.third_order(nodes);
        let backs = [
            nodes,
            nodes + self.last_nodes,
            nodes + self.last_nodes + self.earlier_nodes,
        ]
        .map(Shift::new);
        let nx = grid.nx;
        let rows = c_star.par_chunks_mut(nx).zip(s.par_chunks_mut(nx));
        rows.enumerate()
            .with_min_len(8)
            .for_each(|(j, (c_star, s))| {
                let [row_1, row_2, row_3] = [&self.mass_1, &self.mass_2, &self.mass_3]
                    .map(|mass| &mass[j * nx..(j + 1) * nx]);
                for i in 0..nx {
                    let c1 = backs[0].of(row_1, i).max(0.0);
                    let c2 = backs[1].of(row_2, i).max(0.0);
                    let extra = second.0 * (c1 - c2);
                    let least = (LEAST_SHARE - 1.0) * c1;
                    let theta = if extra < least { least / extra } else { 1.0 };
                    c_star[i] = c1 + theta * extra;
                    s[i] = dt * (1.0 + theta * (second.1 - 1.0));
                    if let Some(third) = &third {
                        let c3 = backs[2].of(row_3, i).max(0.0);
                        let [w1, w2, w3] = third.weights;
                        let c = w1 * c1 + w2 * c2 + w3 * c3;
                        if (c - c_star[i]).abs() <= SMOOTH * c1 {
                            (c_star[i], s[i]) = (c, dt * third.implicit);
                        }
                    }
                }
            });
    }

    /// ω²/(1+2ω) and (1+ω)/(1+2ω); of a first step those of backward Euler.
    fn second_order(&self, nodes: f64) -> (f64, f64) {
        if self.last_nodes <= 0.0 {
            return (0.0, 1.0);
        }
        let omega = nodes / self.last_nodes;
        (
            omega * omega / (1.0 + 2.0 * omega),
            (1.0 + omega) / (1.0 + 2.0 * omega),
        )
    }

    /// The formula with three past masses: `None` where they are not known, or steps grow too fast for it.
    fn third_order(&self, nodes: f64) -> Option<ThirdOrder> {
        let (b, c) = (self.last_nodes, self.earlier_nodes);
        if b <= 0.0 || c <= 0.0 || nodes > MOST_GROWTH * b || b > MOST_GROWTH * c {
            return None;
        }
        // Lagrange's polynomial through now and the three past times, differentiated now.
        let back = [nodes, nodes + b, nodes + b + c];
        let own: f64 = back.iter().map(|t| 1.0 / t).sum();
        let weight = |i: usize| {
            let others = (0..3).filter(|&k| k != i);
            others
                .map(|k| back[k] / (back[k] - back[i]))
                .product::<f64>()
                / back[i]
                / own
        };
        Some(ThirdOrder {
            weights: std::array::from_fn(weight),
            implicit: 1.0 / (own * nodes),
        })
    }

    /// First guess of the next pressure: the slow part stays, the *relative* ripple is extrapolated
    /// linearly in the frame that moves at the mean speed, and nodes without pressure stay so.
    ///
    /// Relative, because the envelope does not travel: with absolute ripples the steep outlet flank
    /// starts far too high, where viscosity makes Newton crawl (6.3 iterations a step, against 5.3).
    pub fn predict(&self, grid: &Grid, nodes: f64, p: &mut [f64]) {
        let nx = grid.nx;
        let omega = if self.last_nodes > 0.0 {
            nodes / self.last_nodes
        } else {
            0.0
        };
        let (back_1, back_2) = (Shift::new(nodes), Shift::new(nodes + self.last_nodes));
        let interior = grid.interior_rows();
        let rows = p.par_chunks_mut(nx).enumerate().with_min_len(8);
        rows.filter(|(j, _)| interior.contains(j))
            .for_each(|(j, p)| {
                let range = j * nx..(j + 1) * nx;
                let (one, two, slow) = (
                    &self.pressure_1[range.clone()],
                    &self.pressure_2[range.clone()],
                    &self.pressure_slow[range],
                );
                for i in 1..nx - 1 {
                    let r1 = (back_1.of(one, i) + FLOOR) / (back_1.of(slow, i) + FLOOR);
                    let r2 = (back_2.of(two, i) + FLOOR) / (back_2.of(slow, i) + FLOOR);
                    p[i] = if one[i] == 0.0 {
                        0.0
                    } else {
                        ((slow[i] + FLOOR) * (r1 + omega * (r1 - r2)) - FLOOR).max(0.0)
                    };
                }
            });
    }

    /// Error that steps of `nodes` nodes add to the film while oil crosses the contact, over the film, judged
    /// from the step that gave `mass` and `p`: the local errors summed with their signs along x, mean size over
    /// the nodes under pressure. `None` until three steps are known.
    ///
    /// A steady film has one too: its inlet is steep for oil that comes in. Summed with signs because a kink
    /// of the film that lies between nodes gives a large error and its opposite next to each other, which a sum
    /// of sizes would take for time's.
    pub fn path_error(&self, grid: &Grid, (mass, p): (&[f64], &[f64]), nodes: f64) -> Option<f64> {
        if self.earlier_nodes <= 0.0 {
            return None;
        }
        let (b, c, d) = (
            nodes,
            nodes + self.last_nodes,
            nodes + self.last_nodes + self.earlier_nodes,
        );
        let omega = nodes / self.last_nodes;
        let factor = nodes.powi(3) * (1.0 + omega).powi(2) / (omega * (1.0 + 2.0 * omega));
        // Newton's divided difference at 0, −b, −c, −d is Σ w c.
        let weights = [
            1.0 / (b * c * d),
            -1.0 / (b * (c - b) * (d - b)),
            1.0 / (c * (c - b) * (d - c)),
            -1.0 / (d * (d - b) * (d - c)),
        ];
        let backs = [b, c, d].map(Shift::new);
        let nx = grid.nx;
        let (mut sum, mut count) = (0.0, 0.0);
        for j in grid.interior_rows() {
            let rows =
                [&self.mass_1, &self.mass_2, &self.mass_3].map(|mass| &mass[j * nx..(j + 1) * nx]);
            let (mut gathered, mut row_sum, mut row_count) = (0.0, 0.0, 0.0);
            for i in 1..nx - 1 {
                let n = j * nx + i;
                if p[n] < FLOOR {
                    continue;
                }
                let now = mass[n];
                let difference = weights[0] * now
                    + weights[1] * backs[0].of(rows[0], i)
                    + weights[2] * backs[1].of(rows[1], i)
                    + weights[3] * backs[2].of(rows[2], i);
                // 1/nodes steps are made from node to node.
                gathered += factor * difference / nodes;
                row_sum += gathered.abs() / now.max(f64::MIN_POSITIVE);
                row_count += 1.0;
            }
            sum += row_sum * grid.weight(j);
            count += row_count * grid.weight(j);
        }
        (count > 0.0).then(|| sum / count)
    }

    /// Commits a converged step of `nodes` nodes.
    pub fn commit(&mut self, mass: &[f64], p: &[f64], h0: f64, nodes: f64) {
        std::mem::swap(&mut self.mass_2, &mut self.mass_3);
        std::mem::swap(&mut self.mass_1, &mut self.mass_2);
        std::mem::swap(&mut self.pressure_1, &mut self.pressure_2);
        self.mass_1.copy_from_slice(mass);
        self.pressure_1.copy_from_slice(p);
        self.h0 = [h0, self.h0[0]];
        self.earlier_nodes = self.last_nodes;
        self.last_nodes = nodes;
        let rate = (nodes / SLOW_NODES).min(1.0);
        for (slow, &p) in self.pressure_slow.iter_mut().zip(p) {
            *slow += rate * (p - *slow);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::grid::Symmetry;

    #[test]
    fn equal_steps_are_bdf_and_cubics_shift_exactly() {
        let grid = Grid::new(33, 0.0, 3.2, 1.0, Symmetry::MirrorY);
        let cubic = |x: f64| 2.0 + x + 0.3 * x * x * x;
        let row = |back: f64| -> Vec<f64> {
            (0..grid.len())
                .map(|n| cubic(grid.x(n % 33) + back * grid.dx))
                .collect()
        };
        // c moves at speed 1 without change: c1 shifted is c now, so is c2 shifted.
        let mut history = History::steady(&row(0.5), &row(0.0), 0.0);
        history.mass_2 = row(1.0);
        history.last_nodes = 0.5;
        let (mut c, mut s) = (vec![0.0; grid.len()], vec![0.0; grid.len()]);
        history.convect(&grid, 0.5, &mut c, &mut s);
        for n in 8..27 {
            assert!((c[n] - cubic(grid.x(n))).abs() < 1e-10);
            assert!((s[n] - 0.5 * grid.dx * 2.0 / 3.0).abs() < 1e-12);
        }
        history.mass_3 = row(1.5);
        history.earlier_nodes = 0.5;
        history.convect(&grid, 0.5, &mut c, &mut s);
        for n in 8..27 {
            assert!((c[n] - cubic(grid.x(n))).abs() < 1e-10);
            assert!((s[n] - 0.5 * grid.dx * 6.0 / 11.0).abs() < 1e-12);
        }
    }

    #[test]
    fn cubics_in_time_are_exact_for_unequal_steps() {
        let grid = Grid::new(17, 0.0, 1.6, 1.0, Symmetry::MirrorY);
        let g = 1e-4;
        let field = |t: f64| vec![1.0 + g * t * t * t; grid.len()];
        for (nodes, last, earlier) in [(1.0, 1.0, 1.0), (1.5, 1.1, 0.9), (0.4, 0.8, 1.3)] {
            let mut history = History::steady(&field(0.0), &field(0.0), 0.0);
            (history.last_nodes, history.earlier_nodes) = (last, earlier);
            history.mass_2 = field(-last);
            history.mass_3 = field(-last - earlier);
            let (mut c, mut s) = (vec![0.0; grid.len()], vec![0.0; grid.len()]);
            history.convect(&grid, nodes, &mut c, &mut s);
            let slope = 3.0 * g * nodes * nodes / grid.dx;
            let now = field(nodes)[8];
            assert!((c[8] + s[8] * slope - now).abs() < 1e-13, "{nodes}");
        }
    }

    #[test]
    fn the_local_error_is_that_of_variable_bdf2() {
        // Uniform in x, c = 1 + g t³: the third derivative is 6 g everywhere, and the formula's error is
        // known in closed form for any three steps.
        let grid = Grid::new(17, 0.0, 1.6, 1.0, Symmetry::MirrorY);
        let g = 1e-4;
        for (nodes, last, earlier) in [(1.0, 1.0, 1.0), (1.5, 1.0, 0.7), (0.4, 0.8, 1.3)] {
            let field = |t: f64| vec![1.0 + g * t * t * t; grid.len()];
            let mut history = History::steady(&field(0.0), &field(0.0), 0.0);
            (history.last_nodes, history.earlier_nodes) = (last, earlier);
            history.mass_2 = field(-last);
            history.mass_3 = field(-last - earlier);
            let now = field(nodes);
            // Pressure at one node of a row: nothing is gathered from others.
            let pressed: Vec<f64> = (0..grid.len()).map(|n| f64::from(n % 17 == 8)).collect();
            let error = history.path_error(&grid, (&now, &pressed), nodes);
            // BDF2 with the exact slope 3 g t² at the new time.
            history.earlier_nodes = 0.0;
            let (mut c, mut s) = (vec![0.0; grid.len()], vec![0.0; grid.len()]);
            history.convect(&grid, nodes, &mut c, &mut s);
            let slope = 3.0 * g * nodes * nodes / grid.dx;
            let true_error = (c[8] + s[8] * slope - now[8]).abs() / now[8] / nodes;
            let ratio = error.expect("three steps") / true_error;
            assert!((ratio - 1.0).abs() < 1e-6, "{ratio}");
        }
    }
}
