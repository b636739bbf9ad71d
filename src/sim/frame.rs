//! What one time step looks like from outside: SI, plain data, `f32` fields.
//!
//! Fields are stored row by row: index `j * nx + i`, `i` along x (rolling direction), `j` along y.
//! Frames always hold the full domain, also where the solver worked on half of it. A line contact is shown
//! by [`crate::plan::LINE_ROWS`] equal rows: nothing varies along y.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::{Grounds, LubricationRegime};
use crate::scene::{ContactKind, LifeModel};

/// Which part of a run a frame belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Stage {
    /// From Hertz to the smooth reference and to the developed rough contact; not part of the results.
    #[default]
    StartUp,
    /// The passage: every number counts.
    Passage,
}

/// One frame.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Frame {
    /// Time step, counted from the first step of the passage (start-up: 0).
    pub step: u64,
    /// Simulated time since the start of the passage, s.
    pub time_s: f64,
    /// Part of the run.
    pub stage: Stage,
    /// How much of the start-up is done, 0 to 1.
    pub start_up: f64,
    /// Point or line; a line's rows are all alike and its `b_m` is its `a_m`, for the sake of the picture.
    pub kind: ContactKind,
    /// Lengths of 4 a travelled at U since the start of the passage.
    pub passages: f64,
    /// Nodes along x.
    pub nx: usize,
    /// Nodes along y.
    pub ny: usize,
    /// Inlet edge, m.
    pub x_min_m: f64,
    /// Node spacing along x, m.
    pub dx_m: f64,
    /// Edge of the domain across, m (the domain is symmetric: y from `y_min_m` to `-y_min_m`).
    pub y_min_m: f64,
    /// Node spacing along y, m.
    pub dy_m: f64,
    /// Hertz half-width along x at the load of this frame, m.
    pub a_m: f64,
    /// Hertz half-width along y, m.
    pub b_m: f64,
    /// Maximum Hertz pressure at the load of this frame, Pa.
    pub p_hertz_pa: f64,
    /// Pressure, Pa.
    pub pressure_pa: Vec<f32>,
    /// Film thickness, m.
    pub film_m: Vec<f32>,
    /// Roughness of body 1 in the place where it now is, m (height towards the mating body).
    pub roughness_1_m: Vec<f32>,
    /// Roughness of body 2, m.
    pub roughness_2_m: Vec<f32>,
    /// Shear traction on body 1 along +x, Pa (positive when body 2 is the faster).
    pub traction_pa: Vec<f32>,
    /// 1 where asperities touch (film at or below the scene's contact film), else 0.
    pub contact: Vec<u8>,
    /// Stress of body 1 in the plane y = 0; `None` where the scene asks for none.
    pub slice: Option<StressSlice>,
    /// Same of body 2, depths counted into it.
    pub slice_2: Option<StressSlice>,
    /// The material point that is followed through the contact.
    pub material_point: Option<MaterialPoint>,
    /// Risk by depth below y = 0 of body 1 and 2 (depths of the slice), Pa: half range of the orthogonal shear
    /// (Lundberg-Palmgren), Dang Van's or Findley's; empty for models that integrate over the volume.
    pub risk_pa: [Vec<f32>; 2],
    /// Planes x, y or z = const that the scene asks for.
    pub planes: Vec<StressPlane>,
    /// Damage collected by blocks of both surfaces; `None` where none is mapped or nothing has crossed.
    pub damage: [Option<DamageBlock>; 2],
    /// Scalars.
    pub metrics: Metrics,
    /// What [`Frame::cautions`] rest on beside them.
    pub grounds: Grounds,
}

/// Stress of body 1 in a plane: index `row * width + i`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StressPlane {
    /// Axis that the plane is normal to: `'x'`, `'y'` or `'z'`.
    pub normal: char,
    /// Where it cuts that axis, m.
    pub at_m: f64,
    /// Points along a row: along y for x = const, else along x.
    pub width: usize,
    /// Rows: depths as in the slice, but along y for z = const.
    pub rows: usize,
    /// First coordinate along a row, m.
    pub first_m: f64,
    /// Spacing along a row, m.
    pub step_m: f64,
    /// Effective stress, Pa.
    pub effective_pa: Vec<f32>,
    /// Principal stresses, greatest (most tensile) first, Pa.
    pub principal_pa: [Vec<f32>; 3],
}

/// Damage of a block of one surface that moves with its body: index `column * depths + k`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DamageBlock {
    /// Length of the block along the surface, m: one wavelength, or the whole track of a smooth body. Columns
    /// divide it evenly; place 0 is a crest.
    pub length_m: f64,
    /// Columns.
    pub columns: usize,
    /// Depths below the surface, m, increasing.
    pub depths_m: Arc<[f64]>,
    /// Damage of one crossing by Miner's rule over that of the worst point of the smooth contact; 0 where no
    /// material point has crossed yet.
    pub damage: Vec<f32>,
    /// Columns that have been crossed.
    pub filled: usize,
    /// Middle of the worst column, way from a crest, m.
    pub pit_place_m: f64,
    /// Depth of the worst point, m.
    pub pit_depth_m: f64,
    /// Its damage.
    pub pit_damage: f64,
}

/// Stress in the plane y = 0 below a body's surface: index `k * nx + i`, `k` over depths.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StressSlice {
    /// Depths below the surface, m, increasing.
    pub depths_m: Arc<[f64]>,
    /// Effective stress by the scene's measure (von Mises by default), Pa.
    pub effective_pa: Vec<f32>,
    /// Signed orthogonal shear, Pa.
    pub tau_xz_pa: Vec<f32>,
}

/// Which material point is shown. It changes no result.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Follow {
    /// Body: 1 or 2.
    pub body: u8,
    /// The nearest depth that is computed, m.
    pub depth_m: f64,
    /// The nearest of the points that are counted, m; `None`: the one that is shown.
    pub x_m: Option<f64>,
}

/// A point of body 1 or 2 that crosses the contact at its body's speed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MaterialPoint {
    /// Body: 1 or 2.
    pub body: u8,
    /// Where it is now, m.
    pub x_m: f64,
    /// Depth at which its stress is given, m.
    pub depth_m: f64,
    /// Pressure on the surface above it, Pa.
    pub pressure_pa: f64,
    /// Effective stress at the point, Pa.
    pub effective_pa: f64,
    /// Signed orthogonal shear at the point, Pa.
    pub tau_xz_pa: f64,
    /// Peaks of the pressure passed so far in this crossing, each of which closes one cycle (a peak has passed
    /// when the pressure has fallen from it by rainflow's gate, 5 % of p_h).
    pub cycles_counted: f64,
    /// The last of them.
    pub last_peak: Option<PassedPeak>,
    /// Cycles that rainflow closed in the point's last whole crossing.
    pub cycles_before: Option<f64>,
}

/// A peak of the pressure on a material point.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PassedPeak {
    /// Where, m.
    pub x_m: f64,
    /// How high, Pa.
    pub pressure_pa: f64,
}

/// Scalars of one step. NaN never appears: what is not known yet is `None`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Metrics {
    /// Whether the step converged.
    pub converged: bool,
    /// Relative change of pressure in the last iteration.
    pub residual: f64,
    /// Newton iterations of the step.
    pub newton_iterations: u32,
    /// Linear (Krylov) iterations of the step.
    pub linear_iterations: u32,
    /// Times that the step was halved and tried again.
    pub retries: u32,
    /// Slide-to-roll ratio S = (U2 - U1)/U of this step.
    pub slide_roll: f64,
    /// Where S is going.
    pub slide_roll_target: f64,
    /// Entrainment speed, m/s.
    pub entrainment_m_s: f64,
    /// Load asked for in this step, N; of a line per metre of length, N/m.
    pub load_n: f64,
    /// Where the load is going, N or N/m.
    pub load_target_n: f64,
    /// Amplitude of body 1's roughness in this step, m.
    pub amplitude_1_m: f64,
    /// Amplitude of body 2's roughness, m.
    pub amplitude_2_m: f64,
    /// Greatest pressure, Pa.
    pub p_max_pa: f64,
    /// Film thickness at the origin, m.
    pub h_central_m: f64,
    /// Least thickness of the film under pressure, the constriction at the exit and the sides included, m.
    pub h_min_m: f64,
    /// Mean film over the central part (r < 2a/3), m.
    pub h_mean_m: f64,
    /// λ: the smooth central film by formula at the speed and load of this step, over the composite root-mean-square
    /// roughness ([`crate::plan::FilmPlan::lambda`]); `None` for smooth surfaces and without oil.
    pub lambda_ratio: Option<f64>,
    /// Simulated mean film of the central part over the same roughness; `None` for smooth surfaces.
    #[serde(default)]
    pub film_to_roughness: Option<f64>,
    /// Part of the Hertz ellipse's area that is in contact; of a line part of its width.
    pub contact_ratio: f64,
    /// Part of the load that contacts carry.
    pub contact_load_ratio: f64,
    /// Lubrication regime.
    #[serde(default)]
    pub regime: LubricationRegime,
    /// |carried - asked|/asked.
    pub load_error: f64,
    /// Σ|film equation's residual| over the mass in the pressurised zone; the next step takes it over. Of a dry step the
    /// greatest gap or overlap of touching nodes, over the film that p_h on one node makes.
    pub film_error: f64,
    /// The part of that which no step takes over: mass lost or made.
    pub mass_error: f64,
    /// Deepest overlap of the surfaces in a step that did not converge, or at an edge of the domain, where
    /// contact is cut off (a step that is then not called converged), m; else 0.
    pub overlap_m: f64,
    /// What `residual` and `film_error` may be.
    #[serde(default)]
    pub asked: [f64; 2],
    /// Friction force over load, positive.
    pub friction_coefficient: f64,
    /// What body 1 and 2 have yielded since the roughness came up, m³ (of a line m³ per metre of length); `None`: both
    /// are elastic.
    #[serde(default)]
    pub yielded_m3: Option<[f64; 2]>,
    /// Greatest effective stress in the slice (or volume), Pa.
    pub sigma_eff_max_pa: Option<f64>,
    /// Its depth, m.
    pub sigma_eff_max_depth_m: Option<f64>,
    /// Its x, m.
    pub sigma_eff_max_x_m: Option<f64>,
    /// Life and its factors.
    pub life: Option<LifeEstimate>,
    /// Contacts per loading cycle by formula, body 1 (`None`: the body does not move).
    pub n_body_1: Option<f64>,
    /// Same for body 2.
    pub n_body_2: Option<f64>,
    /// Cycles counted by rainflow, mean over the crossings finished so far, body 1.
    pub n_counted_body_1: Option<f64>,
    /// Same for body 2.
    pub n_counted_body_2: Option<f64>,
    /// Whether the passage repeats; `None`: not in the passage yet.
    pub repeat: Option<Repeat>,
    /// Estimated relative errors by the mesh; `None`: one grid only, nothing to compare with.
    pub errors: Option<MeshErrors>,
}

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

/// What stands beside a life.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct LifeDetail {
    /// The model.
    pub model: Option<LifeModel>,
    /// Body that gives the life, 1 or 2.
    pub body: u8,
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
    /// Same life by the mean of snapshots.
    pub life_snapshot: Option<f64>,
    /// Same life by the swept integral.
    pub life_swept: Option<f64>,
    /// Least life over the choice of model (`life.spread`).
    pub spread_low: f64,
    /// Greatest.
    pub spread_high: f64,
    /// Variants in the spread.
    pub variants: u32,
    /// Loading cycles at the scene's survival; `None` without a calibration point.
    pub cycles: Option<f64>,
}
