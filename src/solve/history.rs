//! Couette flow and squeeze together, along characteristics.
//!
//! ```text
//! U ∂x(ρh) + ∂t(ρh) = d(ρh)/dt along the mean speed
//! C* = c1 + θ_s ω²/(1+2ω) (c1 − c2),   c1 = c(X−ΔT, T−ΔT),  c2 = c(X−ΔT−ΔT', T−ΔT−ΔT')
//! s  = ΔT (1+ω)/(1+2ω) for θ_s = 1,   ω = ΔT/ΔT'
//! ```
//! With `c = ρ̄H` stored at each step, ΔT = dX shifts by exactly one node: no numerical diffusion.
//! Local error of the step, from one more past mass:
//! ```text
//! e = ΔT³ (1+ω)²/(ω(1+2ω)) |c[T, T−ΔT, T−ΔT−ΔT', ...]|        (third divided difference along the path)
//! ```
//! Fractions of a node are interpolated (`shift.rs`), not below 0. For equal steps this is BDF2:
//! `C* = (4 c1 − c2)/3, s = 2ΔT/3`. Where extrapolation would more than halve c1 the weight θ_s
//! goes down and the formula towards backward Euler, node by node, each with its own s: nothing is
//! clipped. Order 2 in time. Test: `tests/engine/ehl_transient.rs`.
//!
//! BDF3 was tried: it takes the time error of the central film at one node a step from 7 % to 1 % (default scene, 129
//! nodes). But what the mesh errs by, in the other sign, then stands alone: with BDF2 the two shrink together at
//! second order, and thin films on coarse grids come out within a tenth; with BDF3 (as with BDF2 at quarter steps) they
//! come out up to 80 % too thick. So second order stays.
//!
//! Sources: Hairer, Nørsett and Wanner (1993), *Solving Ordinary Differential Equations I*, §III.5, for BDF2 with steps of two lengths.
//! Ours: the weight θ_s, which takes BDF2 to backward Euler where two past masses extrapolate below half of the last.

use serde::{Deserialize, Serialize};

use rayon::prelude::*;

use super::shift::Shift;
use crate::math::grid::Grid;

/// Pressure below which ripples count as absolute, not relative. Enters the first guess of a step, and which
/// nodes the error in time is a mean of; not what a step converges to. Untuned: a fiftieth of p_h.
const FLOOR: f64 = 0.02;
/// Nodes travelled in which the slow part of the pressure forgets. Enters the first guess of a step alone;
/// untuned.
const SLOW_NODES: f64 = 32.0;

/// Convected mass of two past steps, and the ripple of two past pressures for the predictor.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct History {
    /// ρ̄H one step back, shape ny × nx.
    pub mass_1: Vec<f64>,
    /// ρ̄H two steps back.
    pub mass_2: Vec<f64>,
    /// ρ̄H three steps back, for the local error alone.
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

    /// C* and s for a step of `nodes` nodes after one of `before` nodes: the last one, or 0 for backward Euler.
    pub fn convect(
        &self,
        grid: &Grid,
        (nodes, before): (f64, f64),
        c_star: &mut [f64],
        s: &mut [f64],
    ) {
        let dt = nodes * grid.dx;
        let (weight, implicit) = if before > 0.0 {
            let omega = nodes / before;
            (
                omega * omega / (1.0 + 2.0 * omega),
                (1.0 + omega) / (1.0 + 2.0 * omega),
            )
        } else {
            (0.0, 1.0)
        };
        let (back_1, back_2) = (Shift::new(nodes), Shift::new(nodes + before));
        let nx = grid.nx;
        let rows = c_star.par_chunks_mut(nx).zip(s.par_chunks_mut(nx));
        rows.enumerate()
            .with_min_len(8)
            .for_each(|(j, (c_star, s))| {
                let row_1 = &self.mass_1[j * nx..(j + 1) * nx];
                let row_2 = &self.mass_2[j * nx..(j + 1) * nx];
                for i in 0..nx {
                    let c1 = back_1.of(row_1, i).max(0.0);
                    let c2 = back_2.of(row_2, i).max(0.0);
                    let extra = weight * (c1 - c2);
                    let theta = if extra < -0.5 * c1 {
                        -0.5 * c1 / extra
                    } else {
                        1.0
                    };
                    c_star[i] = c1 + theta * extra;
                    s[i] = dt * (1.0 + theta * (implicit - 1.0));
                }
            });
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
    fn equal_steps_are_bdf2_and_cubics_shift_exactly() {
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
        history.convect(&grid, (0.5, history.last_nodes), &mut c, &mut s);
        for n in 5..30 {
            assert!((c[n] - cubic(grid.x(n))).abs() < 1e-10);
            assert!((s[n] - 0.5 * grid.dx * 2.0 / 3.0).abs() < 1e-12);
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
            let (mut c, mut s) = (vec![0.0; grid.len()], vec![0.0; grid.len()]);
            history.convect(&grid, (nodes, last), &mut c, &mut s);
            let slope = 3.0 * g * nodes * nodes / grid.dx;
            let true_error = (c[8] + s[8] * slope - now[8]).abs() / now[8] / nodes;
            let ratio = error.expect("three steps") / true_error;
            assert!((ratio - 1.0).abs() < 1e-6, "{ratio}");
        }
    }
}
