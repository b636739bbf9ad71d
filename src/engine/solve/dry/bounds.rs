//! A pressure of the right load between zero and the hardness.
//!
//! ```text
//! P ← min(c P, P_H) with the c of ∬P = load;  where nothing can grow, the load that is missing is spread over the others
//! ```
//! Between two bounds a step that is cut may lead uphill, and few free nodes can then go to and fro for ever. So what
//! would leave its bound to the wrong side stays, and a step that is cut is halved until ½ PᵀKP + GᵀP has not grown.
//!
//! Ours: every round holds at least one node more, so the rounds end; the energy is convex (`dry.rs`), so a step that is halved
//! often enough lowers it along any feasible direction of descent.

use super::{Dry, DryProblem};
use crate::math::grid::Grid;
use crate::solve::film::Elastic;
use crate::solve::newton::{Iterate, NewtonReport};

/// Halvings at most of a step that is cut; untuned.
const MAX_HALVINGS: u32 = 8;
/// Share of the energy that rounding may add: some 50 units in the last place of a sum.
const ROUNDING: f64 = 1e-14;

/// Rounds at most: each holds at least one node more at its bound, and two or three are usual.
const ROUNDS: usize = 60;

/// What a pressure carries and where.
#[derive(Default)]
struct Carried {
    /// By nodes at the hardness.
    held: f64,
    /// By nodes between the bounds.
    free: f64,
    /// Area of the nodes without pressure.
    empty: f64,
}

impl Dry {
    /// No pressure above `hardness` from now on; infinite: elastic.
    pub fn yield_at(&mut self, hardness: f64) {
        self.hardness = hardness;
        if hardness.is_finite() {
            let n = self.deflection.len();
            self.before
                .iter_mut()
                .for_each(|field| field.resize(n, 0.0));
        }
    }

    /// Brings a pressure back between its bounds and to its load; of elastic bodies it is there already.
    pub(super) fn bring_back(&self, problem: &DryProblem, p: &mut [f64]) {
        if self.hardness.is_infinite() {
            return;
        }
        let grid = problem.grid;
        for _ in 0..ROUNDS {
            for p in p.iter_mut() {
                *p = p.min(self.hardness);
            }
            let carried = self.carried(grid, p);
            let missing = problem.load - carried.held;
            if missing > 0.0 && carried.free > 0.0 {
                let scale = missing / carried.free;
                let free = p.iter_mut().filter(|p| **p < self.hardness);
                free.for_each(|p| *p *= scale);
                if p.iter().all(|p| *p <= self.hardness) {
                    return;
                }
            } else if missing > 0.0 {
                let spread = missing / carried.empty;
                for j in self.rows(grid) {
                    let row = &mut p[j * grid.nx..][self.columns(grid)];
                    let empty = row.iter_mut().filter(|p| **p == 0.0);
                    empty.for_each(|p| *p = spread);
                }
            } else {
                let scale = problem.load / (carried.held + carried.free);
                for p in p.iter_mut() {
                    *p *= scale;
                }
                return;
            }
        }
    }

    /// Leaves nodes at their bound that the preconditioned step would push beyond it.
    pub(super) fn turn_from_bounds(&mut self, grid: &Grid, p: &[f64]) {
        if self.hardness.is_infinite() {
            return;
        }
        let mut stays = false;
        for (n, &p) in p.iter().enumerate() {
            let outward = (p <= 0.0 && self.z[n] > 0.0) || (p >= self.hardness && self.z[n] < 0.0);
            if self.in_contact[n] && outward {
                self.in_contact[n] = false;
                stays = true;
            }
        }
        if stays {
            self.take_mean_off(grid);
        }
    }

    /// A step, K P made anew if it was cut; whether it was.
    pub(super) fn walk_down(
        &mut self,
        elastic: &mut Elastic,
        problem: &DryProblem,
        iterate: &mut Iterate,
        mut tau: f64,
        report: &mut NewtonReport,
    ) -> bool {
        let bounded = self.hardness.is_finite();
        let energy = if bounded {
            self.keep(iterate.p);
            self.energy(problem, iterate.p)
        } else {
            0.0
        };
        for halving in 0.. {
            let cut = self.walk(problem, iterate, tau);
            if !cut {
                return false;
            }
            self.bring_back(problem, iterate.p);
            self.refresh(elastic, iterate.p, report);
            let down = |now: f64| now <= energy + ROUNDING * energy.abs();
            if !bounded || halving == MAX_HALVINGS || down(self.energy(problem, iterate.p)) {
                return true;
            }
            iterate.p.copy_from_slice(&self.before[0]);
            self.deflection.copy_from_slice(&self.before[1]);
            tau *= 0.5;
        }
        unreachable!("the last halving returns")
    }

    fn keep(&mut self, p: &[f64]) {
        let [old, deflection] = &mut self.before;
        old.copy_from_slice(p);
        deflection.copy_from_slice(&self.deflection);
    }

    /// ½ PᵀKP + GᵀP.
    fn energy(&self, problem: &DryProblem, p: &[f64]) -> f64 {
        let grid = problem.grid;
        grid.integrate(|n| p[n] * (0.5 * self.deflection[n] + problem.gap[n]))
    }

    fn carried(&self, grid: &Grid, p: &[f64]) -> Carried {
        let mut all = Carried::default();
        for j in self.rows(grid) {
            let weight = grid.weight(j);
            for &p in &p[j * grid.nx..][self.columns(grid)] {
                if p <= 0.0 {
                    all.empty += weight;
                } else if p < self.hardness {
                    all.free += weight * p;
                } else {
                    all.held += weight * p;
                }
            }
        }
        all
    }

    /// The widest gap (without H0) under a node that carries load: where nothing but nodes at the hardness does, the one
    /// that is next to let go.
    pub(super) fn least_pressed(&self, problem: &DryProblem, p: &[f64]) -> f64 {
        let loaded = (0..p.len()).filter(|&n| p[n] > 0.0);
        let gaps = loaded.map(|n| problem.gap[n] + self.deflection[n]);
        gaps.reduce(f64::max).unwrap_or_default()
    }
}
