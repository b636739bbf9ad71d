//! What cautions are drawn from beside the scalars of a step.

use crate::physics::strength::Strength;
use crate::plan::Resolution;
use crate::scene::{Doubt, StressMeasure, Warming};

/// Life of the smooth contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ReferenceLife {
    /// It ends, or is not known yet.
    #[default]
    Ends,
    /// It stays below the fatigue limit and lives for ever: nothing is relative to it.
    ForEver,
}

/// What a scene may ask for beside contact, film and stress.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Beside {
    /// What of the heat is followed.
    pub warming: Warming,
    /// Whether a surface wears.
    pub wears: bool,
}

/// What cautions are drawn from beside the scalars of a step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Grounds {
    /// Steps of the passage so far.
    pub steps: u64,
    /// Those that did not converge.
    pub steps_not_converged: u64,
    /// Greatest pressure of the last passage (or period), Pa.
    pub p_max_greatest_pa: f64,
    /// Greatest effective stress of it, Pa.
    pub sigma_eff_greatest_pa: Option<f64>,
    /// Measure of the effective stress; `None`: no stress is computed.
    pub measure: Option<StressMeasure>,
    /// What body 1 and 2 carry; `None`: not known.
    pub strength: [Option<Strength>; 2],
    /// Smooth central film by formula at the knobs' present values, m; `None`: no oil.
    pub film_m: Option<f64>,
    /// Its Eyring stress, Pa; `None`: no oil, or a Newtonian one.
    pub eyring_stress_pa: Option<f64>,
    /// Mean Hertz pressure at the load of now, Pa.
    pub p_mean_pa: f64,
    /// Whether oil flows.
    pub flows: bool,
    /// Relative error of the smooth central film by the mesh at those values; `None`: no flow.
    pub mesh_film: Option<f64>,
    /// The same by the edges of the domain.
    pub short_domain: Option<f64>,
    /// Mesh, step and waves; `None`: not known.
    pub resolution: Option<Resolution>,
    /// Heights of both surfaces' crests together, m, where they can meet at an edge of the domain.
    pub crests_at_edge_m: Option<f64>,
    /// Deepest point of the stress, in a, where it cuts the life integral short.
    pub shallow_stress_a: Option<f64>,
    /// Young's modulus of body 1 and 2, Pa, where it is not steel and warms as steel does.
    pub thermal_unknown_pa: [Option<f64>; 2],
    /// How much of the map of body 1 and 2 has passed, and how long it is, m; `None`: it has none, or all of it has.
    pub map_seen_m: [Option<[f64; 2]>; 2],
    /// How much body 1 and 2 feel of the crests of the other, 0 to 1.
    pub felt: [f64; 2],
    /// Whether the scene computes a life.
    pub has_life: bool,
    /// What lives are relative to.
    pub reference: ReferenceLife,
    /// Whether cycles count by their damage.
    pub by_damage: bool,
    /// What the scene asks for beside contact, film and stress.
    pub beside: Beside,
    /// Hardness of the softer body at which it flows, Pa; `None`: both are elastic.
    pub hardness_pa: Option<f64>,
    /// Part of all that has flowed that did so in the last passage (or period); `None`: nothing has.
    pub yielded_last_share: Option<f64>,
    /// The narrower half-width of the contact at the load of now, m.
    pub half_width_m: f64,
    /// In how many waves crests of both bodies have met so far ([`crate::plan::Plan::meetings`]); `None`: of a body none do.
    pub meetings: Option<f64>,
    /// Shortest waves of the made surfaces of body 1 and 2, m; `None`: it is not made.
    pub cutoffs_m: [Option<f64>; 2],
    /// What is doubtful of the maps of body 1 and 2.
    pub maps: [[Option<Doubt>; 2]; 2],
}
