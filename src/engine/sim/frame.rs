//! What one time step looks like from outside: SI, plain data, `f32` fields, and the catalogue of its scalars.
//!
//! Fields are stored row by row: index `j * nx + i`, `i` along x (rolling direction), `j` along y.
//! Frames always hold the full domain, also where the solver worked on half of it. A line contact is shown
//! by [`crate::plan::LINE_ROWS`] equal rows: nothing varies along y.

mod quantity;

use serde::{Deserialize, Serialize};

pub use self::quantity::{CATALOGUE, Dimension, Over, Quantity, Reading, named};
pub(super) use self::quantity::{SUMMED, summed, total};
use super::{
    AgePoint, DamageBlock, Grounds, LifeEstimate, LubricationRegime, MaterialPoint, MeshErrors,
    Repeat, StressPlane, StressSlice,
};
use crate::scene::ContactKind;

/// Which part of a run a frame belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Stage {
    /// From Hertz to the smooth reference and to the developed rough contact; not part of the results.
    #[default]
    StartUp,
    /// The passage: every number counts.
    Passage,
}

impl Stage {
    /// Name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::StartUp => "start_up",
            Self::Passage => "passage",
        }
    }
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
    /// Rise of the surfaces of body 1 and 2 over the bulk's temperature, K; empty where the scene asks for no heat.
    pub surface_rise_k: [Vec<f32>; 2],
    /// The same in the middle of the film; dry the mean of both surfaces.
    pub film_rise_k: Vec<f32>,
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
    /// The surfaces at the last loading cycles that a jump has come to; `None` where they stay new.
    pub age: Option<AgePoint>,
    /// Loading cycles that the heights of this frame are of, those of a jump that is only tried with them; `None` where
    /// they stay new.
    pub cycles: Option<f64>,
    /// Damage that the material of both bodies holds after the cycles of [`Frame::age`], a pit where it is 1 (by a calibration
    /// point); `None`: it is not followed.
    pub suffered: [Option<DamageBlock>; 2],
    /// Scalars.
    pub metrics: Metrics,
    /// What [`Frame::cautions`] are drawn from beside them.
    pub grounds: Grounds,
}

impl Frame {
    /// The values of a field along y = 0; none where it does not hold them.
    pub fn centre_line<'a, T>(&self, field: &'a [T]) -> &'a [T] {
        let start = self.ny / 2 * self.nx;
        field.get(start..start + self.nx).unwrap_or(&[])
    }

    /// x/a of a node.
    pub fn x_over_a(&self, i: usize) -> f64 {
        (self.x_min_m + i as f64 * self.dx_m) / self.a_m
    }
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
    /// Greatest shear stress on the surfaces, of sheared oil and of touching spots, Pa.
    #[serde(default)]
    pub traction_max_pa: f64,
    /// Where along x the load acts, m: the load times it is the moment about the line of centres that rolling has to overcome.
    #[serde(default)]
    pub load_centre_x_m: f64,
    /// Greatest rise of a surface over the bulk's temperature, K; `None`: the scene asks for no heat.
    #[serde(default)]
    pub flash_temperature_k: Option<f64>,
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
