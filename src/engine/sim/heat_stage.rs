//! Heat of each step, how warm it makes surfaces and oil, and how much thinner that makes the oil.
//!
//! ```text
//! begin     what the heat of all steps before does at the end of this one, and as much as then the heat of a step; the oil as thin
//!           as it was
//! find      stress of every node from its walls' temperature, heat from that, walls from the heat, until both agree
//! again     the step is solved with the oil as thin as it now is, as long as its film error says so (`stepping.rs`)
//! commit    with the step
//! ```
//! While a knob walks the bodies move at the speeds that it walks to: else each of its steps would need tables of its own.

mod node;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::scaling::Scaling;
use crate::math::grid::Grid;
use crate::physics::heat_estimate::{inlet_factor, inlet_factor_gupta};
use crate::physics::thinning::Thinning;
use crate::saved::saved;
use crate::scene::Scene;
use crate::solve::heat::{Heat, HeatState, Thermal};
use crate::solve::reynolds::Reynolds;
use crate::solve::traction::TractionLaw;
use node::{NodeLaw, Row};

/// m² K/W between surfaces that nothing joins.
const APART: f64 = 1e3;
/// Change of the greatest rise over a time a/U below which a steady contact is as warm as it gets, and most such times.
const STEADY: f64 = 2e-4;
const LONGEST: f64 = 120.0;
/// Relative change of the heat that is small enough, and most times that it is looked for.
const SAME: f64 = 1e-3;
const MOST_ROUNDS: usize = 12;
/// Workspace.
pub(super) struct HeatStage {
    heat: Heat,
    resistance: Vec<f64>,
    /// k_f; `None`: a dry scene.
    oil: Option<f64>,
    /// How the oil thins; `None`: nobody knows, or there is none, and nothing of the heat goes back.
    thinning: Option<Thinning>,
    /// q, and of each row the change of the heat and the heat.
    traction: Vec<f64>,
    changes: Vec<[f64; 2]>,
    /// Of each row, what its nodes are sheared by.
    nodes: Vec<[Vec<f64>; 5]>,
    now: Film,
    /// c and Q_p as the step has been solved with.
    solved: [Vec<f64>; 2],
    /// Rise in the middle of the film over the bulk, K.
    middle: Vec<f64>,
    /// What has entered both bodies in this step, ∬ of W/m² over the grid.
    entered: f64,
}

/// The oil at every node.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Film {
    /// Q, W/m².
    made: Vec<f64>,
    /// Q_p, the part of it that the pressure's flow makes, W/m².
    flowing: Vec<f64>,
    /// Mean rise of both walls, K; as it is remembered, by the heat of the step alone.
    walls_k: Vec<f64>,
    /// Rise in the middle of the film over the walls, K.
    middle_k: Vec<f64>,
    /// Shift of ln η̄ where the oil is sheared.
    shift: Vec<f64>,
    /// c of the flow ([`Thinning::at_rest`]).
    thinner: Vec<f64>,
}

saved! {
    Film { parts: made, flowing, walls_k, middle_k, shift, thinner; }
}

/// What is remembered.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Warmth {
    state: HeatState,
    film: Film,
    /// Greatest rise of surfaces and oil in the steps that count, K.
    greatest_k: [f64; 2],
    /// Greatest part of the heat of a step that has not entered the bodies.
    lost: f64,
    /// Sums over them: steps, the mean rise of both surfaces over the Hertz ellipse, the share of body 1.
    sums: [f64; 3],
}

saved! {
    Warmth { parts: state, film; free: greatest_k, lost, sums; }
    holds |_, saved| saved.greatest_k.iter().all(|k| *k >= 0.0) && saved.sums[0] >= 0.0
}

/// What the steps that count come to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Warmed {
    pub(super) greatest_k: f64,
    pub(super) film_k: f64,
    pub(super) mean_k: f64,
    pub(super) share_1: f64,
    pub(super) lost: f64,
}

/// A step that has been solved.
pub(super) struct SolvedStep<'a> {
    pub(super) grid: &'a Grid,
    pub(super) scaling: &'a Scaling,
    pub(super) law: &'a TractionLaw,
    /// P and H.
    pub(super) pressure: &'a [f64],
    pub(super) film: &'a [f64],
    /// What has flown; `None`: as in the last step.
    pub(super) flow: Option<&'a Reynolds>,
    /// U and |U2 − U1|.
    pub(super) entrainment_m_s: f64,
    pub(super) sliding_m_s: f64,
}

/// Length of a step, s, and the speeds of both bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Times {
    pub(super) dt_s: f64,
    pub(super) speeds_m_s: [f64; 2],
}

/// How the oil of a scene thins as it warms.
fn thinning(scene: &Scene) -> Option<Thinning> {
    let (heat, oil) = scene.heat.zip(scene.lubricant.as_ref())?;
    heat.thinning(oil)
}

impl HeatStage {
    /// `None`: the scene asks for no heat.
    pub(super) fn new(scene: &Scene, grid: &Grid, a_m: f64) -> Option<Self> {
        let asked = scene.heat?;
        let bodies = [&scene.body_1, &scene.body_2].map(|body| {
            let heat = body.heat.unwrap_or_default();
            Thermal {
                conductivity: heat.thermal_conductivity_w_mk,
                diffusivity: heat.diffusivity_m2_s(),
            }
        });
        let thinning = thinning(scene);
        Some(Self {
            heat: Heat::new(grid, a_m, bodies, scene.motion.entrainment_m_s),
            resistance: vec![0.0; grid.len()],
            oil: (scene.lubricant.as_ref()).map(|_| asked.thermal_conductivity_w_mk),
            now: Film::cold(grid.len()),
            solved: [vec![0.0; grid.len()], vec![0.0; grid.len()]],
            middle: vec![0.0; grid.len()],
            traction: vec![0.0; grid.len()],
            changes: vec![[0.0; 2]; grid.ny],
            nodes: vec![std::array::from_fn(|_| vec![0.0; grid.nx]); grid.ny],
            thinning,
            entered: 0.0,
        })
    }

    /// Before the first step.
    pub(super) fn cold(&self) -> Warmth {
        Warmth {
            state: self.heat.cold(),
            film: Film::cold(self.resistance.len()),
            greatest_k: [0.0; 2],
            lost: 0.0,
            sums: [0.0; 3],
        }
    }

    /// Whether warm oil changes film and friction.
    pub(super) fn feeds_back(&self) -> bool {
        self.thinning.is_some()
    }

    /// c of every node and 1/scale, for the flow.
    pub(super) fn thinner(&self) -> Option<(&[f64], f64)> {
        (self.thinning.as_ref()).map(|law| (&self.now.thinner[..], law.per_scale()))
    }

    /// Shift of ln η̄ for the traction.
    pub(super) fn shift(&self) -> &[f64] {
        &self.now.shift
    }

    /// Rise of both surfaces, K.
    pub(super) fn rises(&self) -> [&[f64]; 2] {
        [0, 1].map(|body: usize| &self.heat.rise[body][..])
    }

    /// Rise in the middle of the film, dry of both surfaces' mean, K.
    pub(super) fn film_rise(&self) -> &[f64] {
        &self.middle
    }

    /// A step begins; its film is as warm as the last one's.
    pub(super) fn begin(&mut self, warmth: &mut Warmth, times: Times) {
        self.now.copy(&warmth.film);
        self.heat
            .begin(&mut warmth.state, times.dt_s, times.speeds_m_s);
        let [one, two] = self.heat.before();
        for (walls, (one, two)) in self.now.walls_k.iter_mut().zip(one.iter().zip(two)) {
            *walls += 0.5 * (one + two);
        }
    }

    /// Heat and temperatures of the step that has begun, as it has been solved last.
    pub(super) fn find(&mut self, step: &SolvedStep) {
        self.resist(step);
        self.flow(step);
        let mut before = f64::INFINITY;
        for round in 0..MOST_ROUNDS {
            self.shear(step);
            let (change, all) = (self.changes.iter()).fold((0.0, 0.0), |(change, all), row| {
                (change + row[0], all + row[1])
            });
            // Heat that is what it was has warmed the walls already.
            if round > 0 && change <= SAME * all {
                break;
            }
            self.heat.share(&self.now.made, &self.resistance);
            self.entered = step.grid.integrate(|n| self.now.made[n]);
            let walls = self.now.walls_k.iter_mut().zip(&self.heat.rise[0]);
            for ((walls, one), two) in walls.zip(&self.heat.rise[1]) {
                *walls = 0.5 * (one + two);
            }
            // Nor need what would change as much less as it just did be looked for again.
            let falls = (change / before).min(1.0);
            if self.thinning.is_none() || round > 0 && falls * change <= SAME * all {
                break;
            }
            before = change;
        }
    }

    /// The step has been made.
    pub(super) fn commit(&mut self, warmth: &mut Warmth) {
        let parts = self.now.walls_k.iter().zip(&self.now.middle_k);
        for (whole, (walls, middle)) in self.middle.iter_mut().zip(parts) {
            *whole = walls + middle;
        }
        warmth.film.copy(&self.now);
        let [one, two] = self.heat.before();
        for (walls, (one, two)) in warmth.film.walls_k.iter_mut().zip(one.iter().zip(two)) {
            *walls -= 0.5 * (one + two);
        }
        self.heat.commit(&mut warmth.state);
    }

    /// h/k_f of every node.
    fn resist(&mut self, step: &SolvedStep) {
        for (n, resistance) in self.resistance.iter_mut().enumerate() {
            *resistance = match self.oil {
                Some(conductivity) => step.scaling.m_from_h(step.film[n].max(0.0)) / conductivity,
                None if step.pressure[n] > 0.0 => 0.0,
                None => APART,
            };
        }
    }

    /// c and Q_p as the step has been solved: Q_p = h³ g |∇p|²/(12 η0).
    fn flow(&mut self, step: &SolvedStep) {
        let [thinner, flowing] = &mut self.solved;
        thinner.copy_from_slice(&self.now.thinner);
        let Some(flow) = step.flow else {
            flowing.copy_from_slice(&self.now.flowing);
            return;
        };
        flow.power(step.grid, step.pressure, flowing);
        let unit = step.scaling.flow_heat_w_m2(step.entrainment_m_s);
        for flowing in flowing.iter_mut() {
            *flowing *= unit;
        }
    }

    /// Stress, heat and thinning of every node from the temperature of its walls.
    fn shear(&mut self, step: &SolvedStep) {
        let nx = step.grid.nx;
        let node = NodeLaw::new(self, step);
        let Film {
            made,
            flowing,
            walls_k,
            middle_k,
            shift,
            thinner,
        } = &mut self.now;
        let [solved, flowed] = &self.solved;
        (made.par_chunks_mut(nx).zip(flowing.par_chunks_mut(nx)))
            .zip(shift.par_chunks_mut(nx).zip(thinner.par_chunks_mut(nx)))
            .zip(
                middle_k
                    .par_chunks_mut(nx)
                    .zip(self.traction.par_chunks_mut(nx)),
            )
            .zip(
                walls_k
                    .par_chunks(nx)
                    .zip(solved.par_chunks(nx).zip(flowed.par_chunks(nx))),
            )
            .zip(self.nodes.par_iter_mut().zip(&mut self.changes))
            .enumerate()
            .for_each(
                |(j, ((((heat, oil), (middle, q)), (walls, solved)), (nodes, change)))| {
                    let row = Row {
                        j,
                        walls,
                        solved,
                        made: heat.0,
                        flowing: heat.1,
                        middle,
                        q,
                        nodes,
                        shift: oil.0,
                        thinner: oil.1,
                    };
                    *change = node.row(step, row);
                },
            );
    }

    /// Heats a contact that stands still until it is as warm as it gets; the step has been committed.
    pub(super) fn soak(&mut self, warmth: &mut Warmth, times: Times, step: &SolvedStep) {
        let a_unit = (1.0 / step.grid.dx).ceil() as usize;
        let mut now = self.greatest_k();
        for _ in 0..LONGEST as usize {
            let before = now;
            for _ in 0..a_unit {
                self.step(warmth, times, step);
            }
            now = self.greatest_k();
            if (now - before).abs() <= STEADY * now {
                break;
            }
        }
    }

    /// A step of the heat alone.
    pub(super) fn step(&mut self, warmth: &mut Warmth, times: Times, step: &SolvedStep) {
        self.begin(warmth, times);
        self.find(step);
        self.commit(warmth);
    }

    /// Greatest rise of a surface, K.
    pub(super) fn greatest_k(&self) -> f64 {
        let both = self.heat.rise[0].iter().chain(&self.heat.rise[1]);
        both.copied().fold(0.0, f64::max)
    }

    /// Counts the step that has been committed; `ellipse`: Hertz half-widths of now, in a.
    pub(super) fn count(&self, warmth: &mut Warmth, grid: &Grid, ellipse: (f64, f64)) {
        let oil = self.now.walls_k.iter().zip(&self.now.middle_k);
        let warmest = oil
            .map(|(walls, middle)| walls + middle)
            .fold(0.0, f64::max);
        for (greatest, now) in warmth
            .greatest_k
            .iter_mut()
            .zip([self.greatest_k(), warmest])
        {
            *greatest = greatest.max(now);
        }
        let (mean, share) = self.means(grid, ellipse);
        for (sum, value) in warmth.sums.iter_mut().zip([1.0, mean, share]) {
            *sum += value;
        }
    }

    /// Holds what has entered the bodies against the work of friction (∬ of W/m² over the grid), which is measured apart from
    /// the heat, and of the flow.
    pub(super) fn balance(&self, warmth: &mut Warmth, grid: &Grid, friction: f64) {
        let work = friction + grid.integrate(|n| self.now.flowing[n]);
        if work > 0.0 {
            warmth.lost = warmth.lost.max((self.entered / work - 1.0).abs());
        }
    }

    /// Mean rise of both surfaces over the Hertz ellipse, and the share of body 1.
    fn means(&self, grid: &Grid, (a, b): (f64, f64)) -> (f64, f64) {
        let inside = |n: usize| {
            let (x, y) = (grid.x(n % grid.nx) / a, grid.y(n / grid.nx) / b);
            f64::from(u8::from(x * x + y * y <= 1.0))
        };
        let [one, two] = &self.heat.rise;
        let warm = grid.integrate(|n| inside(n) * 0.5 * (one[n] + two[n]));
        let mean = warm / grid.integrate(inside).max(f64::MIN_POSITIVE);
        let made = grid.integrate(|n| self.now.made[n]);
        let share = grid.integrate(|n| self.heat.into_body_1[n]) / made.max(f64::MIN_POSITIVE);
        (mean, share)
    }
}

impl Film {
    /// As cold as the bulk.
    fn cold(n: usize) -> Self {
        let field = vec![0.0; n];
        Self {
            made: field.clone(),
            flowing: field.clone(),
            walls_k: field.clone(),
            middle_k: field.clone(),
            shift: field.clone(),
            thinner: field,
        }
    }

    fn copy(&mut self, from: &Self) {
        self.made.copy_from_slice(&from.made);
        self.flowing.copy_from_slice(&from.flowing);
        self.walls_k.copy_from_slice(&from.walls_k);
        self.middle_k.copy_from_slice(&from.middle_k);
        self.shift.copy_from_slice(&from.shift);
        self.thinner.copy_from_slice(&from.thinner);
    }
}

impl Warmth {
    /// Shift of ln η̄ of warm oil where it is sheared.
    pub(super) fn shift(&self) -> &[f64] {
        &self.film.shift
    }

    /// What has been counted is of other conditions; how warm the bodies are stays.
    pub(super) fn forget(&mut self) {
        self.greatest_k = [0.0; 2];
        self.lost = 0.0;
        self.sums = [0.0; 3];
    }

    /// What the steps that count come to; `None`: there are none.
    pub(super) fn warmed(&self) -> Option<Warmed> {
        let [n, mean, share] = self.sums;
        (n > 0.0).then(|| Warmed {
            greatest_k: self.greatest_k[0],
            film_k: self.greatest_k[1],
            mean_k: mean / n,
            share_1: share / n,
            lost: self.lost,
        })
    }
}

/// Blok's flash temperature for a coefficient of friction, K.
pub(super) fn blok(scene: &Scene, friction: f64, half_width_m: f64, p_hertz_pa: f64) -> f64 {
    scene.flash_by_blok_k(scene.motion.slide_roll, friction, half_width_m, p_hertz_pa)
}

/// Factors of the film after Wilson and Sheu, and after Gupta et al.; `None`: dry, or nobody knows how the viscosity falls.
pub(super) fn inlet(scene: &Scene, p_hertz_pa: f64) -> Option<[f64; 2]> {
    let (heat, oil) = scene.heat.zip(scene.lubricant.as_ref())?;
    let u = scene.motion.entrainment_m_s;
    let beta = heat.thinning(oil)?.slope_per_k();
    let loading = beta * oil.viscosity_pa_s() * u * u / heat.thermal_conductivity_w_mk;
    let slide_roll = scene.motion.slide_roll;
    let strain = p_hertz_pa / scene.e_prime_pa();
    Some([
        inlet_factor(slide_roll, loading),
        inlet_factor_gupta(slide_roll, loading, strain),
    ])
}
