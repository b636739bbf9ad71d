//! What a frame says of itself: errors by the mesh, whether it repeats, life.

use serde::{Deserialize, Serialize};

use crate::scene::LifeModel;

/// Relative errors by the mesh as far as the start-up shows them: what the smooth contact changed from the
/// last but one grid to the last (all of it, as in a run's own estimate), and for the pressure what ripples
/// of few nodes lose, (2π/n)²/12 of a ripple as high as the mean. Where knobs have left the scene's speed or load the
/// films' errors follow the plan's mesh rule, the pressure's (ΔX/a)².
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct MeshErrors {
    /// Of the central film.
    pub h_central: f64,
    /// Of the least film.
    pub h_min: f64,
    /// Of the greatest pressure.
    pub p_max: f64,
}

/// What can repeat.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Rhythm {
    /// No crest passes: every step should be like the last.
    Steady,
    /// Both bodies' crests are in the same places again after a period.
    Orbit,
    /// No common period: only means can settle.
    Statistics,
}

/// Whether the passage repeats.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Repeat {
    /// What is compared.
    pub rhythm: Rhythm,
    /// After which time, s: the period of both bodies' waves, or the window of the means.
    pub period_s: f64,
    /// Relative difference of the fields one period apart (of the means); `None`: not seen yet.
    pub drift: Option<f64>,
    /// Whether the drift is below 0.5 % (means: 1 %).
    pub repeats: bool,
}

/// Relative life (reference: smooth, frictionless, S = 0, load, speed and geometry of now) and its factors:
/// `life_relative = cycle_factor * stress_factor`, `stress_factor = peak_factor * traction_factor`.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct LifeEstimate {
    /// Volume integral of the reference, in Pa^(c e) m^3 scaled by p_h^(c e) a^3 at the load of now; of a line per
    /// length, a^2.
    pub i_ref: f64,
    /// Same integral, mean over the phases seen so far (last full passage period).
    pub i_mean: f64,
    /// Phases in the mean.
    pub phases: u32,
    /// n_ref/n, least of the two bodies.
    pub cycle_factor: f64,
    /// (I_ref/I)^(1/e).
    pub stress_factor: f64,
    /// Part of the stress factor due to pressure peaks.
    pub peak_factor: f64,
    /// Part of the stress factor due to traction.
    pub traction_factor: f64,
    /// What the load itself costs: life of the smooth contact at the load, speed and radii of now over its life at
    /// those that the scene began with. `life_relative * load_factor` compares lives at different loads.
    #[serde(default)]
    pub load_factor: f64,
    /// Life of the smooth contact at the load and speed of now, but for the constant of the model ([`super::Summary::life_smooth`]);
    /// 0: not known.
    #[serde(default)]
    pub life_smooth: f64,
    /// Relative life.
    pub life_relative: f64,
    /// Lower end of the band: of the discretisation error, and of what a mean without a common period still wanders.
    pub life_relative_low: f64,
    /// Upper end of the band.
    pub life_relative_high: f64,
    /// Whether no step of a ramp, or of what the ramp left in the film, is in the average, and the average has stopped
    /// moving within its own band.
    pub settled: bool,
    /// Both bodies, other forms, other models.
    pub detail: LifeDetail,
}

impl LifeEstimate {
    /// Life relative to the smooth contact at the load and speed that the scene began with: it compares lives at
    /// different loads, as `life_relative`, which is relative to that at the load of now, does not.
    pub fn life_common(&self) -> f64 {
        self.life_relative * self.load_factor
    }
}

/// What stands beside a life.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct LifeDetail {
    /// The model.
    pub model: Option<LifeModel>,
    /// Body that gives the life, 1 or 2.
    pub body: u8,
    /// Part of the cycle factor that is a change of unit: from that body's own loading cycles to those in which its life is,
    /// by damage the faster body's, `U_fast/|U_i|`; else 1.
    #[serde(default)]
    pub basis_factor: f64,
    /// By how much of ln L the mean over the phases may still be off: part of the band on every mesh.
    #[serde(default)]
    pub unsettled: f64,
    /// Relative life of body 1 and 2 in own loading cycles (by damage: of the faster body); `None`: the body stands, or is
    /// not counted yet.
    pub life_body: [Option<f64>; 2],
    /// Both together in time, as equal discs, relative to both of the reference.
    pub life_system: Option<f64>,
    /// Life by the paper's count, one n by formula times the mean of snapshots; `None`: the body stands.
    #[serde(default)]
    pub life_global: Option<f64>,
    /// Life with every cycle by the damage it does.
    #[serde(default)]
    pub life_damage: Option<f64>,
    /// Least life over the choice of model (`life.spread`).
    pub spread_low: f64,
    /// Greatest.
    pub spread_high: f64,
    /// Variants in the spread.
    pub variants: u32,
    /// Loading cycles at the scene's survival; `None` without a calibration point.
    pub cycles: Option<f64>,
}
