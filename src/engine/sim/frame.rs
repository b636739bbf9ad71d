//! What one time step looks like from outside: SI, plain data, `f32` fields, and the catalogue of its scalars.
//!
//! Fields are stored row by row: index `j * nx + i`, `i` along x (rolling direction), `j` along y.
//! Frames always hold the full domain, also where the solver worked on half of it. A line contact is shown
//! by [`crate::plan::LINE_ROWS`] equal rows: nothing varies along y.

mod quantity;

use serde::{Deserialize, Serialize};

use self::quantity::Source;
pub use self::quantity::{Dimension, Over, Quantity, Reading, named};
pub(super) use self::quantity::{SUMMED, summed, total};
use super::{
    DamageBlock, Grounds, LifeEstimate, LubricationRegime, MaterialPoint, MeshErrors, Repeat,
    StressPlane, StressSlice,
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

/// Every scalar of a step, in the order of a table's columns: the one place where it gets its name and symbol, what it
/// measures, what it is in words, where it is read, and how a summary sums it up. Tables, summaries, recordings, exported
/// fields, reports and the explorer look it up here. A new one comes last and is shown `by_itself`.
#[rustfmt::skip]
pub const CATALOGUE: &[Quantity] = {
    use Dimension::{Film, Height, Length, Load, Plain, Pressure, Share, Speed, Time, Volume};
    use Over::{Greatest, Least, Mean};
    use Source::{Frame as F, Life as L, Metrics as M};
    use Quantity as Q;
    &[
        Q::new(["step", "step"], Plain, "time step of the passage", F(|f| (f.step as f64).into())),
        Q::new(["time_s", "t"], Time, "time since the start of the passage", F(|f| f.time_s.into())),
        Q::new(["passages", "passages"], Plain, "lengths of 4 a travelled at U", F(|f| f.passages.into())),
        Q::new(["stage", "stage"], Plain, "part of the run", F(|f| Reading::Word(f.stage.name()))),
        Q::new(["a_m", "a (along x)"], Length, "Hertz half-width along x at the load of now", F(|f| f.a_m.into())),
        Q::new(["b_m", "b (across)"], Length, "Hertz half-width across", F(|f| f.b_m.into())),
        Q::new(["p_hertz_pa", "p_Hertz"], Pressure, "greatest Hertz pressure at the load of now", F(|f| f.p_hertz_pa.into())),
        Q::new(["converged", "converged (1/0)"], Plain, "whether the step converged", M(|m| f64::from(u8::from(m.converged)).into())),
        Q::new(["residual", "residual"], Plain, "relative change of pressure in the last iteration", M(|m| m.residual.into())),
        Q::new(["newton_iterations", "Newton iterations"], Plain, "Newton iterations of the step", M(|m| f64::from(m.newton_iterations).into())),
        Q::new(["linear_iterations", "linear iterations"], Plain, "Krylov iterations of the step", M(|m| f64::from(m.linear_iterations).into())),
        Q::new(["retries", "retries"], Plain, "times that the step was halved", M(|m| f64::from(m.retries).into())),
        Q::new(["slide_roll", "S"], Plain, "slide-to-roll ratio (U2 - U1)/U", M(|m| m.slide_roll.into())),
        Q::new(["slide_roll_target", "S target"], Plain, "where S is going", M(|m| m.slide_roll_target.into())),
        Q::new(["entrainment_m_s", "U"], Speed, "entrainment speed", M(|m| m.entrainment_m_s.into())),
        Q::new(["load_n", "load"], Load, "load asked for", M(|m| m.load_n.into())).over(&[(Mean, "load_n")]),
        Q::new(["load_target_n", "load target"], Load, "where the load is going", M(|m| m.load_target_n.into())),
        Q::new(["amplitude_1_m", "A1"], Height, "amplitude of body 1's roughness", M(|m| m.amplitude_1_m.into())),
        Q::new(["amplitude_2_m", "A2"], Height, "amplitude of body 2's roughness", M(|m| m.amplitude_2_m.into())),
        Q::new(["p_max_pa", "p_max"], Pressure, "greatest pressure", M(|m| m.p_max_pa.into())).over(&[(Mean, "p_max_pa"), (Greatest, "p_max_greatest_pa")]),
        Q::new(["h_central_m", "h_central"], Film, "film at the origin", M(|m| m.h_central_m.into())).over(&[(Mean, "h_central_m")]),
        Q::new(["h_min_m", "h_min"], Film, "least film under pressure", M(|m| m.h_min_m.into())).over(&[(Mean, "h_min_m"), (Least, "h_min_least_m")]),
        Q::new(["h_mean_m", "h_mean"], Film, "mean film of the central part", M(|m| m.h_mean_m.into())),
        Q::new(["lambda_ratio", "λ ratio"], Plain, "smooth central film by formula over composite roughness", M(|m| m.lambda_ratio.into())),
        Q::new(["film_to_roughness", "h_mean/Rq"], Plain, "mean film of the central part over composite roughness", M(|m| m.film_to_roughness.into())),
        Q::new(["contact_ratio", "area in contact"], Share, "part of the Hertz ellipse in contact", M(|m| m.contact_ratio.into())).over(&[(Mean, "contact_ratio")]),
        Q::new(["contact_load_ratio", "load on contacts"], Share, "part of the load that contacts carry", M(|m| m.contact_load_ratio.into())).over(&[(Mean, "contact_load_ratio")]),
        Q::new(["regime", "regime"], Plain, "lubrication regime", M(|m| Reading::Word(m.regime.name()))),
        Q::new(["load_error", "load error"], Plain, "|carried - asked|/asked", M(|m| m.load_error.into())).over(&[(Greatest, "load_error")]),
        Q::new(["film_error", "film error"], Plain, "residual of the film equation over the mass under pressure", M(|m| m.film_error.into())),
        Q::new(["mass_error", "mass error"], Plain, "the part of it that no step takes over", M(|m| m.mass_error.into())).over(&[(Greatest, "mass_error")]),
        Q::new(["overlap_m", "overlap"], Film, "deepest overlap of a step that did not converge", M(|m| m.overlap_m.into())),
        Q::new(["friction_coefficient", "friction coefficient"], Plain, "friction force over load", M(|m| m.friction_coefficient.into())).over(&[(Mean, "friction_coefficient")]),
        Q::new(["sigma_eff_max_pa", "σ_eff max"], Pressure, "greatest effective stress", M(|m| m.sigma_eff_max_pa.into())),
        Q::new(["sigma_eff_max_depth_m", "z of σ_eff max"], Length, "its depth", M(|m| m.sigma_eff_max_depth_m.into())),
        Q::new(["sigma_eff_max_x_m", "x of σ_eff max"], Length, "its place along x", M(|m| m.sigma_eff_max_x_m.into())),
        Q::new(["n_body_1", "n body 1, formula"], Plain, "contacts per loading cycle of body 1 by formula", M(|m| m.n_body_1.into())),
        Q::new(["n_body_2", "n body 2, formula"], Plain, "contacts per loading cycle of body 2 by formula", M(|m| m.n_body_2.into())),
        Q::new(["n_counted_body_1", "n body 1, counted"], Plain, "cycles of body 1 counted by rainflow", M(|m| m.n_counted_body_1.into())),
        Q::new(["n_counted_body_2", "n body 2, counted"], Plain, "cycles of body 2 counted by rainflow", M(|m| m.n_counted_body_2.into())),
        Q::new(["i_ref", "I of the reference"], Plain, "volume integral of the smooth, frictionless contact", L(|l| l.i_ref.into())),
        Q::new(["i_mean", "I"], Plain, "volume integral, mean over the phases", L(|l| l.i_mean.into())),
        Q::new(["phases", "phases"], Plain, "phases in that mean", L(|l| f64::from(l.phases).into())),
        Q::new(["cycle_factor", "cycle factor"], Plain, "n_ref/n", L(|l| l.cycle_factor.into())),
        Q::new(["stress_factor", "stress factor"], Plain, "(I_ref/I)^(1/e)", L(|l| l.stress_factor.into())),
        Q::new(["peak_factor", "peak factor"], Plain, "part of the stress factor due to pressure peaks", L(|l| l.peak_factor.into())),
        Q::new(["traction_factor", "traction factor"], Plain, "part of the stress factor due to traction", L(|l| l.traction_factor.into())),
        Q::new(["load_factor", "load factor"], Plain, "what the load and speed of now cost on the smooth contact", L(|l| l.load_factor.into())),
        Q::new(["life_relative", "relative life"], Plain, "life over that of the smooth, frictionless contact at S = 0", L(|l| l.life_relative.into())),
        Q::new(["life_relative_low", "life, low"], Plain, "lower end of its band", L(|l| l.life_relative_low.into())),
        Q::new(["life_relative_high", "life, high"], Plain, "upper end of its band", L(|l| l.life_relative_high.into())),
        Q::new(["settled", "settled (1/0)"], Plain, "whether the average has stopped moving", L(|l| f64::from(u8::from(l.settled)).into())),
        Q::new(["point_x_m", "x"], Length, "where the followed point is", F(|f| f.material_point.map(|point| point.x_m).into())),
        Q::new(["point_effective_pa", "effective stress"], Pressure, "effective stress at the followed point", F(|f| f.material_point.map(|point| point.effective_pa).into())),
        Q::new(["point_cycles_counted", "peaks so far in this crossing"], Plain, "peaks of the pressure on it in this crossing", F(|f| f.material_point.map(|point| point.cycles_counted).into())),
        Q::new(["yielded_body_1_m3", "body 1 has yielded"], Volume, "what body 1 has yielded since the roughness came up", M(|m| m.yielded_m3.map(|both| both[0]).into())),
        Q::new(["yielded_body_2_m3", "body 2 has yielded"], Volume, "what body 2 has yielded since the roughness came up", M(|m| m.yielded_m3.map(|both| both[1]).into())),
        Q::new(["traction_max_pa", "τ max"], Pressure, "greatest shear stress on the surfaces", M(|m| m.traction_max_pa.into())).over(&[(Mean, "traction_max_pa"), (Greatest, "traction_max_greatest_pa")]).by_itself(),
        Q::new(["load_centre_x_m", "x of the load"], Length, "where along x the load acts: its moment resists rolling", M(|m| m.load_centre_x_m.into())),
    ]
};

#[cfg(test)]
mod tests {
    use super::*;

    /// What is no scalar, or is told in parts.
    const OTHERS: [&str; 6] = ["asked", "yielded_m3", "life", "repeat", "errors", "detail"];

    #[test]
    fn every_scalar_is_in_the_catalogue_once() {
        let metrics = serde_json::to_value(Metrics::default()).expect("plain data");
        let life = serde_json::to_value(LifeEstimate::default()).expect("plain data");
        let fields = [metrics, life];
        let fields = fields.iter().filter_map(|value| value.as_object());
        let names: Vec<&str> = CATALOGUE.iter().map(|quantity| quantity.name).collect();
        let mut found = 0;
        for field in fields.flat_map(serde_json::Map::keys) {
            let times = names.iter().filter(|name| *name == field).count();
            assert_eq!(
                times,
                usize::from(!OTHERS.contains(&field.as_str())),
                "{field}"
            );
            found += times;
        }
        assert!(found > 40, "{found}");
    }

    #[test]
    fn names_and_keys_have_one_meaning() {
        let quantities = CATALOGUE.iter();
        let mut keys: Vec<&str> = quantities
            .clone()
            .flat_map(|q| q.over)
            .map(|(_, key)| *key)
            .collect();
        let mut names: Vec<&str> = quantities.map(|quantity| quantity.name).collect();
        for list in [&mut keys, &mut names] {
            let all = list.len();
            list.sort_unstable();
            list.dedup();
            assert_eq!(list.len(), all);
        }
        assert_eq!(summed().count(), SUMMED);
    }

    #[test]
    fn what_is_not_known_is_no_number() {
        let mut frame = Frame::default();
        let life = const { named("life_relative") };
        assert_eq!(life.number(&frame), None);
        frame.metrics.life = Some(LifeEstimate {
            life_relative: 0.5,
            ..LifeEstimate::default()
        });
        assert_eq!(life.number(&frame), Some(0.5));
        assert_eq!(
            const { named("stage") }.read(&frame),
            Reading::Word("start_up")
        );
        let film = const { named("h_central_m") };
        assert_eq!(film.label(ContactKind::Point), "h_central, µm");
    }
}
