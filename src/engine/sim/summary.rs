//! The result of a run in one flat record: the keys that scripts read.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{Cause, Caution, LubricationRegime, Rhythm, Stats};
use crate::scene::MapReport;

/// Summary of a run, SI. Means are over the last passage of 4 a, or the
/// whole periods that fit into it (one period where it is longer); what was not computed is `None`
/// (`null` in JSON). `life_relative = cycle_factor * stress_factor`,
/// `stress_factor = peak_factor * traction_factor`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Summary {
    /// Preset or file.
    pub scene: String,
    /// Whether every step converged, and the run came to its end.
    pub converged: bool,
    /// Whether somebody ended it before it had done all that was asked for.
    #[serde(default)]
    pub stopped: bool,
    /// Time steps after the start-up.
    pub steps: u64,
    /// How many the whole run has by its plan, or had once its life had settled; `None`: it has no end of its own (the
    /// explorer).
    #[serde(default)]
    pub steps_planned: Option<u64>,
    /// Those that did not converge.
    pub steps_not_converged: u64,
    /// Time taken, s.
    pub wall_s: f64,
    /// Steps a second in the passage, outputs included.
    pub steps_per_s: Option<f64>,
    /// Hertz half-width along x at the load of the last step, m.
    pub a_m: f64,
    /// Maximum Hertz pressure at that load, Pa.
    pub p_hertz_pa: f64,
    /// Film thickness at the origin, m.
    pub h_central_m: f64,
    /// Least film of a step under pressure, m: the mean over the steps.
    pub h_min_m: f64,
    /// Greatest pressure of a step, Pa: the mean over the steps.
    pub p_max_pa: f64,
    /// Greatest pressure of all those steps, Pa.
    #[serde(default)]
    pub p_max_greatest_pa: f64,
    /// Least film of all those steps under pressure, m.
    #[serde(default)]
    pub h_min_least_m: f64,
    /// λ of the last step: smooth central film by formula over the composite root-mean-square roughness.
    #[serde(default)]
    pub lambda_ratio: Option<f64>,
    /// Lubrication regime of the last step.
    #[serde(default)]
    pub regime: LubricationRegime,
    /// What to know before trusting the numbers, the weightiest first.
    #[serde(default)]
    pub cautions: Vec<Caution>,
    /// Part of the Hertz ellipse in contact.
    pub contact_ratio: f64,
    /// Part of the load that contacts carry.
    #[serde(default)]
    pub contact_load_ratio: f64,
    /// Load asked for, N; of a line per metre of length, N/m.
    pub load_n: f64,
    /// |carried - asked|/asked, the greatest of the mean's steps.
    pub load_error: f64,
    /// Mass residual, the greatest of the mean's steps.
    pub mass_error: f64,
    /// Friction force over load.
    pub friction_coefficient: f64,
    /// What body 1 has yielded since the roughness came up, m³ (of a line m³ per metre of length); `None`: both bodies are
    /// elastic.
    #[serde(default)]
    pub yielded_body_1_m3: Option<f64>,
    /// Same of body 2.
    #[serde(default)]
    pub yielded_body_2_m3: Option<f64>,
    /// Part of both that has flowed in the last passage (or period): near 0 where the bodies are run in; `None`: nothing has.
    #[serde(default)]
    pub yielded_last_share: Option<f64>,
    /// Contacts per loading cycle of body 1 by formula.
    pub n_body_1: Option<f64>,
    /// Same for body 2.
    pub n_body_2: Option<f64>,
    /// Cycles of body 1 counted by rainflow.
    pub n_counted_body_1: Option<f64>,
    /// Same for body 2.
    pub n_counted_body_2: Option<f64>,
    /// Volume integral of the smooth, frictionless reference.
    pub i_ref: Option<f64>,
    /// Same of this run.
    pub i_mean: Option<f64>,
    /// n_ref/n.
    pub cycle_factor: Option<f64>,
    /// Part of it that is a change of unit, from the governing body's own loading cycles to the faster body's.
    #[serde(default)]
    pub basis_factor: Option<f64>,
    /// (I_ref/I)^(1/e).
    pub stress_factor: Option<f64>,
    /// Part of the stress factor due to pressure peaks.
    pub peak_factor: Option<f64>,
    /// Part of the stress factor due to traction.
    pub traction_factor: Option<f64>,
    /// What the load and speed of now cost against those that the scene began with, on the smooth contact:
    /// `life_relative * load_factor` compares lives at different loads.
    #[serde(default)]
    pub load_factor: Option<f64>,
    /// Life relative to the smooth contact of the base: of what the run began with, of the scene that a sweep varies.
    /// It compares lives at different loads, speeds, radii and oils, and is `life_relative * load_factor` in one run.
    #[serde(default)]
    pub life_common: Option<f64>,
    /// Life of the smooth, frictionless contact at the load and speed of now but for the constant of the scene's model:
    /// its volume integral in GPa and mm, to the power of −1/e. The ratio of two is that of two smooth contacts' lives.
    #[serde(default)]
    pub life_smooth: Option<f64>,
    /// Relative life.
    pub life_relative: Option<f64>,
    /// Lower end of its band.
    pub life_relative_low: Option<f64>,
    /// Upper end of its band.
    pub life_relative_high: Option<f64>,
    /// Least life over the phases between both bodies' waves at S = 0, where the scene asks for none; the band holds it.
    #[serde(default)]
    pub life_phases_low: Option<f64>,
    /// Greatest.
    #[serde(default)]
    pub life_phases_high: Option<f64>,
    /// Least life with the other law of flow of sheared oil, and with half and twice its Eyring stress.
    #[serde(default)]
    pub life_oil_low: Option<f64>,
    /// Greatest.
    #[serde(default)]
    pub life_oil_high: Option<f64>,
    /// Life at the scene's probability of survival over that at 50 %.
    pub survival_ratio: Option<f64>,
    /// Greatest effective stress of the last passage, Pa.
    pub sigma_eff_max_pa: Option<f64>,
    /// Its depth, m.
    pub sigma_eff_max_depth_m: Option<f64>,
    /// Its x, m.
    pub sigma_eff_max_x_m: Option<f64>,
    /// Work counters.
    pub counters: Stats,
    /// Life model.
    pub life_model: Option<String>,
    /// How cycles were counted, and of whose loading cycles lives are.
    pub life_count: Option<String>,
    /// What lives are relative to, and why.
    pub life_basis: Option<String>,
    /// Body that gives `life_relative`, 1 or 2.
    pub life_body: Option<u8>,
    /// What takes most of the life.
    #[serde(default)]
    pub life_cause: Option<Cause>,
    /// Relative life of body 1 in own loading cycles; by damage in those of the faster body.
    pub life_body_1: Option<f64>,
    /// Same of body 2.
    pub life_body_2: Option<f64>,
    /// Both bodies together, in time, as equal discs, relative to both of the reference.
    pub life_system: Option<f64>,
    /// Relative life by the paper's count: n by formula times the mean of snapshots (`life.cycles = "global"`).
    pub life_global: Option<f64>,
    /// Relative life with every cycle by the damage it does (`life.cycles = "damage"`).
    pub life_damage: Option<f64>,
    /// Least relative life over the choice of model.
    pub life_models_low: Option<f64>,
    /// Greatest.
    pub life_models_high: Option<f64>,
    /// How many variants the choice has.
    pub life_models: Option<u32>,
    /// Loading cycles at the scene's survival, by the scene's calibration point.
    pub life_cycles: Option<f64>,
    /// Lower end of its band: numerical, and over the choice of count and model, which is most of it.
    pub life_cycles_low: Option<f64>,
    /// Upper end.
    pub life_cycles_high: Option<f64>,
    /// Where the pit of body 1 starts.
    pub pit_body_1: Option<PitStart>,
    /// Same of body 2.
    pub pit_body_2: Option<PitStart>,
    /// Depth below which a crossing of body 1 is one cycle of signed shear, m.
    pub cycles_end_depth_1_m: Option<f64>,
    /// Same of body 2, m.
    pub cycles_end_depth_2_m: Option<f64>,
    /// ISO 281's life factor, a side comparison: it holds a penalty of roughness of its own.
    pub a_iso: Option<f64>,
    /// What was looked at for repetition: `"steady"`, `"orbit"` (fields one period apart) or
    /// `"statistics"` (means over 4 a).
    pub rhythm: Option<Rhythm>,
    /// Period of both bodies' waves together, or the window of the means, s.
    pub period_s: Option<f64>,
    /// Relative difference one period apart at the end of the run.
    pub period_drift: Option<f64>,
    /// Whether the passage repeats: the drift is below 0.5 % (means: 1 %).
    pub periodic: Option<bool>,
    /// Estimated error by mesh and time step of `h_central_m`, m (a companion on half the nodes).
    pub error_h_central_m: Option<f64>,
    /// Same of `h_min_m`, m.
    pub error_h_min_m: Option<f64>,
    /// Same of `p_max_pa`, Pa.
    pub error_p_max_pa: Option<f64>,
    /// Same of `contact_ratio`.
    #[serde(default)]
    pub error_contact_ratio: Option<f64>,
    /// Same of `contact_load_ratio`.
    #[serde(default)]
    pub error_contact_load_ratio: Option<f64>,
    /// Same of `friction_coefficient`.
    #[serde(default)]
    pub error_friction_coefficient: Option<f64>,
    /// By how much of ln `life_relative` the mean over the phases may still be off.
    #[serde(default)]
    pub unsettled_ln_life: Option<f64>,
    /// Same of ln `life_relative`, and what its mean may still be off; the ends of life's band are `life_relative * exp(-+ error)`.
    pub error_ln_life: Option<f64>,
    /// `life_relative` extrapolated to no spacing and no time step from the run and its companion on half the
    /// nodes, at second order (Richardson); `None`: there was no companion.
    pub life_extrapolated: Option<f64>,
    /// Same of `h_central_m`, m.
    pub h_central_extrapolated_m: Option<f64>,
    /// The meshes that the run has climbed, the coarsest first and its own last; empty: there was one alone.
    #[serde(default)]
    pub rungs: Vec<Rung>,
    /// Seconds until the first mesh had a life; `None`: there is none.
    #[serde(default)]
    pub first_life_s: Option<f64>,
    /// Root-mean-square height of body 1 as its amplitude now is, m.
    #[serde(default)]
    pub rq_1_m: f64,
    /// Same of body 2, m.
    #[serde(default)]
    pub rq_2_m: f64,
    /// Shortest wave of the made surfaces, m, on which lives hang; `None`: there are none.
    #[serde(default)]
    pub cutoff_short_m: Option<f64>,
    /// Greatest rise of a surface over the bulk's temperature, K, of the steps that count; `None`: the scene asks for no heat.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub flash_temperature_max_k: Option<f64>,
    /// Rise of both surfaces over the bulk, K: the mean over the Hertz ellipse and over those steps.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub flash_temperature_mean_k: Option<f64>,
    /// Greatest temperature of a surface, K.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contact_temperature_max_k: Option<f64>,
    /// Greatest temperature of the oil, in the middle of the film, K; `None`: dry.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub film_temperature_max_k: Option<f64>,
    /// Part of the heat that enters body 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub heat_share_1: Option<f64>,
    /// Greatest part by which the heat that enters both bodies in a step differs from the work of friction and flow.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub heat_error: Option<f64>,
    /// Flash temperature after Blok with the friction found, K.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub flash_temperature_blok_k: Option<f64>,
    /// Film with the inlet's heating over the isothermal one after Wilson and Sheu, to compare with; `None`: dry, or nobody says
    /// how the viscosity falls.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inlet_heating_factor: Option<f64>,
    /// The same after Gupta et al.: formulas for it disagree.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inlet_heating_factor_gupta: Option<f64>,
    /// Film of a gear's flank after ISO/TS 6336-22, m, with the viscosity at Blok's flash temperature where the scene says how the
    /// oil thins; `None`: dry, or no line.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub h_gf_m: Option<f64>,
    /// λ_GF: it over the mean of both Ra as the scene has them; `None`: smooth, too.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lambda_gf: Option<f64>,
    /// Loading cycles that the surfaces have behind them; 1, that of the passages, where no ageing is asked for; `None`: nothing
    /// wears.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cycles: Option<f64>,
    /// Greatest depth that body 1 has lost in those cycles, m; `None`: it does not wear.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wear_depth_1_m: Option<f64>,
    /// Same of body 2.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wear_depth_2_m: Option<f64>,
    /// Part of body 1's surface, along the line y = 0, that has pits; `None`: surfaces do not age, or the scene gives no
    /// calibration point.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pitted_area_1: Option<f64>,
    /// Same of body 2.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pitted_area_2: Option<f64>,
    /// When and where body 1 has pits.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pits_body_1: Option<PitHistory>,
    /// Same of body 2.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pits_body_2: Option<PitHistory>,
    /// What the surfaces came to on the way; empty: they were not aged.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ages: Vec<AgePoint>,
    /// The height map of body 1; left out where it has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub map_body_1: Option<MapReport>,
    /// Same of body 2.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub map_body_2: Option<MapReport>,
    /// Quantities of the catalogue that are shown by themselves, summed up as it says, by their keys there.
    #[serde(flatten)]
    pub by_itself: BTreeMap<String, Option<f64>>,
}

impl Summary {
    /// With the band of its absolute life as its relative life's and the models' range have it.
    #[must_use]
    pub fn with_cycles_band(mut self) -> Self {
        let end = |ends: [Option<f64>; 2], outer: fn(f64, f64) -> f64| {
            let end = ends.into_iter().flatten().reduce(outer)?;
            Some(self.life_cycles? * end / self.life_relative?)
        };
        let low = end([self.life_relative_low, self.life_models_low], f64::min);
        let high = end([self.life_relative_high, self.life_models_high], f64::max);
        (self.life_cycles_low, self.life_cycles_high) = (low, high);
        self
    }
}

/// The point of a surface whose damage is greatest.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct PitStart {
    /// Depth, m.
    pub depth_m: f64,
    /// Distance along the surface from a crest of the body, m.
    pub place_m: f64,
    /// Damage of a crossing over that of the worst point of the smooth contact.
    pub damage: f64,
}

/// Damage of a body that ages. Loading cycles are its own; `None`: not reached within the cycles of the run.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct PitHistory {
    /// Greatest damage that its material holds; 1: a pit.
    pub damage_max: f64,
    /// Where, below the new surface, m.
    pub depth_m: f64,
    /// Where along the period of the surface, as a part of it.
    pub place: f64,
    /// Loading cycles to the first pit.
    pub first_cycles: Option<f64>,
    /// Until 1 % of the surface has pits.
    pub one_percent_cycles: Option<f64>,
    /// Until 10 % has.
    pub ten_percent_cycles: Option<f64>,
    /// To the first pit of surfaces that stay new.
    pub unworn_first_cycles: Option<f64>,
    /// Until 1 % of such a surface has pits.
    pub unworn_one_percent_cycles: Option<f64>,
    /// Until 10 % has.
    pub unworn_ten_percent_cycles: Option<f64>,
}

/// Surfaces after so many loading cycles: means over one block of passages.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct AgePoint {
    /// Loading cycles.
    pub cycles: f64,
    /// Greatest depth that body 1 has lost, m.
    pub wear_depth_1_m: f64,
    /// Same of body 2.
    pub wear_depth_2_m: f64,
    /// Part of body 1's surface with pits; `None`: not known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pitted_area_1: Option<f64>,
    /// Same of body 2.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pitted_area_2: Option<f64>,
    /// Root-mean-square height of body 1 in the domain, m, what has flowed and worn taken off.
    pub rq_1_m: f64,
    /// Same of body 2.
    pub rq_2_m: f64,
    /// Central film of a published formula over the composite Rq of now; `None`: smooth or dry.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lambda_ratio: Option<f64>,
    /// Life of surfaces that would stay as they are now.
    pub life_relative: Option<f64>,
    /// Greatest pressure of a step, Pa: the mean over the steps.
    pub p_max_pa: f64,
    /// Film thickness at the origin, m.
    pub h_central_m: f64,
    /// Part of the load that contacts carry.
    pub contact_load_ratio: f64,
    /// Friction force over load.
    pub friction_coefficient: f64,
}

/// What one mesh of a ladder came to.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Rung {
    /// Nodes per side.
    pub nodes: usize,
    /// Life on it.
    pub life_relative: Option<f64>,
    /// Lower end of its band.
    pub life_relative_low: Option<f64>,
    /// Upper end.
    pub life_relative_high: Option<f64>,
    /// Seconds from the start of the run to its end.
    pub seconds: f64,
}
