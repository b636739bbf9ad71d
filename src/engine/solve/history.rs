//! Couette flow and squeeze together, along characteristics.
//!
//! ```text
//! U ∂x(ρh) + ∂t(ρh) = d(ρh)/dt along the mean speed
//! C* = c1 + θ_s (v1 c1 + v2 c2 + v3 c3 − c1),   c_k = ρ̄H of the k-th last step, as far upstream as oil came since
//! s  = ΔT [1 + θ_s (v0 − 1)]
//! BDF2  v1 = 1 + w, v2 = −w, v3 = 0, v0 = (1+ω)/(1+2ω),   w = ω²/(1+2ω),  ω = ΔT/ΔT';   BDF3  [`formula`]
//! ```
//! With `c = ρ̄H` stored at each step, ΔT = dX shifts by exactly one node: no numerical diffusion.
//! Local error of the step, from one more past mass:
//! ```text
//! e = ΔT³ (1+ω)²/(ω(1+2ω)) |c[T, T−ΔT, T−ΔT−ΔT', ...]|        (third divided difference along the path)
//! ```
//! Fractions of a node are interpolated (`shift.rs`), not below 0. For equal steps BDF2 is
//! `C* = (4 c1 − c2)/3, s = 2ΔT/3` and BDF3 `C* = (18 c1 − 9 c2 + 2 c3)/11, s = 6ΔT/11`. Where extrapolation would more than halve c1 the weight θ_s
//! goes down and the formula towards backward Euler, node by node, each with its own s: nothing is
//! clipped. Order 2 or 3 in time ([`Past`]). Test: `tests/engine/ehl_transient.rs`.
//!
//! BDF3 takes the time error of the central film at one node a step from 7 % to 1 % (default scene, 129 nodes). By itself
//! it is no gain: what the flow errs by on the mesh, in the other sign, then stands alone. It goes with the flow of higher
//! order (`reynolds/deferred.rs`).
//!
//! Sources: Hairer, Nørsett and Wanner (1993), *Solving Ordinary Differential Equations I*, §III.5, for BDF2 and BDF3 with steps of several lengths.
//! Ours: the weight θ_s, which takes BDF2 to backward Euler where two past masses extrapolate below half of the last.

use serde::{Deserialize, Serialize};

use rayon::prelude::*;

use super::shift::Shift;
use crate::math::grid::Grid;
use crate::saved::saved;
use crate::scene::Order;

/// Pressure below which ripples count as absolute, not relative. Enters the first guess of a step, and which
/// nodes the error in time is a mean of; not what a step converges to. Untuned: a fiftieth of p_h.
const FLOOR: f64 = 0.02;
/// Nodes travelled in which the slow part of the pressure forgets. Enters the first guess of a step alone;
/// untuned.
const SLOW_NODES: f64 = 32.0;

/// Past steps, in nodes, that a step's formula makes use of, the last one first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Past {
    /// Backward Euler, whose C* is never extrapolated.
    One,
    /// BDF2.
    Two(f64),
    /// BDF3.
    Three(f64, f64),
}

/// Convected mass of three past steps, and the ripple of two past pressures for the predictor.
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

saved! {
    History {
        parts: mass_1, mass_2, mass_3, pressure_1, pressure_2, pressure_slow;
        free: h0, last_nodes, earlier_nodes;
    }
    holds |_, saved| {
        let pressures = [&saved.pressure_1, &saved.pressure_2, &saved.pressure_slow];
        pressures.into_iter().flatten().all(|p| *p >= 0.0)
            && saved.last_nodes >= 0.0
            && saved.earlier_nodes >= 0.0
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

    /// Past of which a step of `nodes` nodes makes use for this order: of order 3 where the steps do not grow so fast that
    /// the formula is unstable (by 1.534 each: Calvo, Grande & Grigorieff 1990).
    pub fn past(&self, order: Order, nodes: f64) -> Past {
        /// Growth of steps up to which BDF3 is used.
        const MOST_GROWTH: f64 = 1.5;
        let (last, earlier) = (self.last_nodes, self.earlier_nodes);
        let grows = nodes > MOST_GROWTH * last || last > MOST_GROWTH * earlier;
        match order {
            Order::High if earlier > 0.0 && !grows => Past::Three(last, earlier),
            Order::Second | Order::High if last > 0.0 => Past::Two(last),
            Order::Second | Order::High => Past::One,
        }
    }

    /// C* and s for a step of `nodes` nodes after such a past.
    pub fn convect(&self, grid: &Grid, nodes: f64, past: Past, c_star: &mut [f64], s: &mut [f64]) {
        let dt = nodes * grid.dx;
        let ([_, v2, v3], implicit) = formula(nodes, past);
        let (before, earlier) = match past {
            Past::One => (0.0, 0.0),
            Past::Two(last) => (last, 0.0),
            Past::Three(last, earlier) => (last, earlier),
        };
        let (back_1, back_2) = (Shift::new(nodes), Shift::new(nodes + before));
        let back_3 = Shift::new(nodes + before + earlier);
        let is_third = matches!(past, Past::Three(..));
        let nx = grid.nx;
        let rows = c_star.par_chunks_mut(nx).zip(s.par_chunks_mut(nx));
        rows.enumerate()
            .with_min_len(8)
            .for_each(|(j, (c_star, s))| {
                let row_1 = &self.mass_1[j * nx..(j + 1) * nx];
                let row_2 = &self.mass_2[j * nx..(j + 1) * nx];
                let row_3 = &self.mass_3[j * nx..(j + 1) * nx];
                for i in 0..nx {
                    let c1 = back_1.of(row_1, i).max(0.0);
                    let c2 = back_2.of(row_2, i).max(0.0);
                    // The weights add up to 1.
                    let mut extra = -v2 * (c1 - c2);
                    if is_third {
                        extra -= v3 * (c1 - back_3.of(row_3, i).max(0.0));
                    }
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

    /// Error that steps of `nodes` nodes add to the film while oil crosses the contact, over the film, estimated
    /// from the step that gave `mass` and `p`: the local errors summed with their signs along x, mean size over
    /// the nodes under pressure. `None` until three steps are known.
    ///
    /// A steady film has one too: its inlet is steep for oil that comes in. Summed with signs because a kink
    /// of the film that lies between nodes gives a large error and its opposite next to each other, which a sum
    /// of sizes would take for time's.
    pub fn path_error(&self, grid: &Grid, mass: &[f64], p: &[f64], nodes: f64) -> Option<f64> {
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

/// Weights of c1, c2, c3 and s/ΔT of the backward differentiation formula for a step of `nodes` nodes.
fn formula(nodes: f64, past: Past) -> ([f64; 3], f64) {
    match past {
        Past::One => ([1.0, 0.0, 0.0], 1.0),
        Past::Two(last) => {
            let omega = nodes / last;
            let weight = omega * omega / (1.0 + 2.0 * omega);
            let implicit = (1.0 + omega) / (1.0 + 2.0 * omega);
            ([1.0 + weight, -weight, 0.0], implicit)
        }
        Past::Three(last, earlier) => {
            // Slope at 0 of the cubic through its values at 0, −a, −b, −c.
            let (a, b) = (nodes, nodes + last);
            let c = b + earlier;
            let own = 1.0 / a + 1.0 / b + 1.0 / c;
            let v1 = b * c / (a * (b - a) * (c - a));
            let v2 = -a * c / (b * (b - a) * (c - b));
            let v3 = a * b / (c * (c - a) * (c - b));
            ([v1 / own, v2 / own, v3 / own], 1.0 / (own * a))
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
        history.convect(&grid, 0.5, Past::Two(history.last_nodes), &mut c, &mut s);
        for n in 5..30 {
            assert!((c[n] - cubic(grid.x(n))).abs() < 1e-10);
            assert!((s[n] - 0.5 * grid.dx * 2.0 / 3.0).abs() < 1e-12);
        }
    }

    #[test]
    fn the_third_order_formula_is_exact_for_cubics_in_time() {
        let ([v1, v2, v3], implicit) = formula(1.0, Past::Three(1.0, 1.0));
        for (got, exact) in [(v1, 18.0), (v2, -9.0), (v3, 2.0), (implicit, 6.0)] {
            assert!((got - exact / 11.0).abs() < 1e-14);
        }
        // Uneven steps: c = t³ at t = 0 after c at −a, −b, −c.
        let (a, b, c) = (0.7_f64, 0.7 + 0.5, 0.7 + 0.5 + 0.9);
        let ([v1, v2, v3], implicit) = formula(0.7, Past::Three(0.5, 0.9));
        for power in 0..4 {
            let value = |t: f64| t.powi(power);
            let slope = if power == 1 { 1.0 } else { 0.0 };
            let past = v1 * value(-a) + v2 * value(-b) + v3 * value(-c);
            let left = past + implicit * a * slope - value(0.0);
            assert!(left.abs() < 1e-14, "{power}: {left}");
        }
    }

    #[test]
    fn fast_growing_steps_are_second_order() {
        let mut history = History::steady(&[1.0], &[0.0], 0.0);
        assert_eq!(history.past(Order::High, 1.0), Past::One);
        history.last_nodes = 1.0;
        assert_eq!(history.past(Order::High, 1.0), Past::Two(1.0));
        history.earlier_nodes = 1.0;
        assert_eq!(history.past(Order::High, 1.0), Past::Three(1.0, 1.0));
        assert_eq!(history.past(Order::High, 1.6), Past::Two(1.0));
        assert_eq!(history.past(Order::Second, 1.0), Past::Two(1.0));
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
            let error = history.path_error(&grid, &now, &pressed, nodes);
            // BDF2 with the exact slope 3 g t² at the new time.
            let (mut c, mut s) = (vec![0.0; grid.len()], vec![0.0; grid.len()]);
            history.convect(&grid, nodes, Past::Two(last), &mut c, &mut s);
            let slope = 3.0 * g * nodes * nodes / grid.dx;
            let true_error = (c[8] + s[8] * slope - now[8]).abs() / now[8] / nodes;
            let ratio = error.expect("three steps") / true_error;
            assert!((ratio - 1.0).abs() < 1e-6, "{ratio}");
        }
    }
}
