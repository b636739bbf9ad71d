//! Heat of each step that is looked at, and how warm it makes the surfaces. Nothing of it goes back into film or friction.

use serde::{Deserialize, Serialize};

use super::sim_plan::SimPlan;
use crate::math::grid::Grid;
use crate::physics::heat_estimate::{blok_k, inlet_factor};
use crate::saved::saved;
use crate::scene::Scene;
use crate::solve::heat::{Heat, HeatState, HeatStep, Thermal};

/// m² K/W between surfaces that nothing joins.
const APART: f64 = 1e3;
/// Change of the greatest rise over a time a/U below which a steady contact is as warm as it gets, and most such times.
const STEADY: f64 = 2e-4;
const LONGEST: f64 = 60.0;

/// Workspace.
pub(super) struct HeatStage {
    heat: Heat,
    made: Vec<f64>,
    resistance: Vec<f64>,
    /// k_f; `None`: a dry scene.
    oil: Option<f64>,
}

/// What is remembered.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Warmth {
    state: HeatState,
    /// Greatest rise of the steps that count, K.
    greatest_k: f64,
    /// Sums over them: steps, the mean rise of both surfaces over the Hertz ellipse, the share of body 1.
    sums: [f64; 3],
}

saved! {
    Warmth { parts: state; free: greatest_k, sums; }
    holds |_, saved| saved.greatest_k >= 0.0 && saved.sums[0] >= 0.0
}

/// What the steps that count come to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Warmed {
    pub(super) greatest_k: f64,
    pub(super) mean_k: f64,
    pub(super) share_1: f64,
}

/// A step to be heated.
pub(super) struct Heating<'a> {
    pub(super) grid: &'a Grid,
    /// P, H and Q.
    pub(super) pressure: &'a [f64],
    pub(super) film: &'a [f64],
    pub(super) traction: &'a [f64],
    pub(super) dt_s: f64,
    pub(super) speeds_m_s: [f64; 2],
    /// Hertz half-widths of now, in a.
    pub(super) ellipse: (f64, f64),
    /// Whether the contact stands still: then it is heated until it is as warm as it gets.
    pub(super) steady: bool,
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
        Some(Self {
            heat: Heat::new(grid, a_m, bodies),
            made: vec![0.0; grid.len()],
            resistance: vec![0.0; grid.len()],
            oil: (scene.lubricant.as_ref()).map(|_| asked.thermal_conductivity_w_mk),
        })
    }

    /// Before the first step.
    pub(super) fn cold(&self) -> Warmth {
        Warmth {
            state: self.heat.cold(),
            greatest_k: 0.0,
            sums: [0.0; 3],
        }
    }

    /// Heats a step, and counts it.
    pub(super) fn advance(&mut self, plan: &SimPlan, warmth: &mut Warmth, step: &Heating) {
        let scaling = &plan.scaling;
        let sliding = (step.speeds_m_s[1] - step.speeds_m_s[0]).abs();
        for n in 0..self.made.len() {
            let (p, h) = (step.pressure[n], step.film[n].max(0.0));
            self.made[n] = scaling.pa_from_p(step.traction[n].abs()) * sliding;
            self.resistance[n] = match self.oil {
                Some(conductivity) => scaling.m_from_h(h) / conductivity,
                None if p > 0.0 => 0.0,
                None => APART,
            };
        }
        let heated = HeatStep {
            dt_s: step.dt_s,
            speeds_m_s: step.speeds_m_s,
            made: &self.made,
            resistance: &self.resistance,
        };
        self.heat.advance(&mut warmth.state, &heated);
        let greatest = |heat: &Heat| {
            let both = heat.rise[0].iter().chain(&heat.rise[1]);
            both.copied().fold(0.0, f64::max)
        };
        let mut now = greatest(&self.heat);
        if step.steady {
            let a_unit = (1.0 / step.grid.dx).ceil() as usize;
            for _ in 0..LONGEST as usize {
                let before = now;
                for _ in 0..a_unit {
                    self.heat.advance(&mut warmth.state, &heated);
                }
                now = greatest(&self.heat);
                if now - before <= STEADY * now {
                    break;
                }
            }
        }
        warmth.greatest_k = warmth.greatest_k.max(now);
        let (mean, share) = self.means(step);
        for (sum, value) in warmth.sums.iter_mut().zip([1.0, mean, share]) {
            *sum += value;
        }
    }

    /// Mean rise of both surfaces over the Hertz ellipse, and the share of body 1.
    fn means(&self, step: &Heating) -> (f64, f64) {
        let (grid, (a, b)) = (step.grid, step.ellipse);
        let inside = |n: usize| {
            let (x, y) = (grid.x(n % grid.nx) / a, grid.y(n / grid.nx) / b);
            f64::from(u8::from(x * x + y * y <= 1.0))
        };
        let [one, two] = &self.heat.rise;
        let warm = grid.integrate(|n| inside(n) * 0.5 * (one[n] + two[n]));
        let mean = warm / grid.integrate(inside).max(f64::MIN_POSITIVE);
        let made = grid.integrate(|n| self.made[n]);
        let share = grid.integrate(|n| self.heat.into_body_1[n]) / made.max(f64::MIN_POSITIVE);
        (mean, share)
    }
}

impl Warmth {
    /// What has been counted is of other conditions; how warm the bodies are stays.
    pub(super) fn forget(&mut self) {
        self.greatest_k = 0.0;
        self.sums = [0.0; 3];
    }

    /// What the steps that count come to; `None`: there are none.
    pub(super) fn warmed(&self) -> Option<Warmed> {
        let [n, mean, share] = self.sums;
        (n > 0.0).then(|| Warmed {
            greatest_k: self.greatest_k,
            mean_k: mean / n,
            share_1: share / n,
        })
    }
}

/// Blok's flash temperature for a coefficient of friction, K.
pub(super) fn blok(scene: &Scene, friction: f64, half_width_m: f64, p_hertz_pa: f64) -> f64 {
    let effusivities = [&scene.body_1, &scene.body_2].map(|body| {
        let heat = body.heat.unwrap_or_default();
        let capacity = heat.density_kg_m3 * heat.heat_capacity_j_kgk;
        (heat.thermal_conductivity_w_mk * capacity).sqrt()
    });
    let speeds = scene.speeds_m_s();
    let sliding = (speeds[1] - speeds[0]).abs();
    let heat = friction * std::f64::consts::FRAC_PI_2 * p_hertz_pa * half_width_m * sliding;
    blok_k(heat, half_width_m, effusivities, speeds)
}

/// Wilson and Sheu's factor of the film; `None`: dry, or nobody knows how the viscosity falls.
pub(super) fn inlet(scene: &Scene) -> Option<f64> {
    let (heat, oil) = scene.heat.zip(scene.lubricant.as_ref())?;
    let u = scene.motion.entrainment_m_s;
    let beta = heat.beta_per_k(oil)?;
    let loading = beta * oil.viscosity_pa_s() * u * u / heat.thermal_conductivity_w_mk;
    Some(inlet_factor(scene.motion.slide_roll, loading))
}
