//! # asperity-engine
//!
//! Transient mixed elastohydrodynamic lubrication of rough rolling-sliding contacts, subsurface
//! stress, stress-cycle counting and relative fatigue life.
//!
//! From a scene to a life:
//!
//! ```
//! use asperity_engine::plan::Plan;
//! use asperity_engine::scene::{Override, Scene};
//! use asperity_engine::sim::{Frame, Simulation};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! // What the user asks: a preset or a TOML file, with keys set.
//! let sets: [Override; 2] = ["grid.nodes=65".parse()?, "time.passages=0.1".parse()?];
//! let scene = Scene::load_with("demonstration_quick", &sets)?;
//! // What is computed, what is left out and why.
//! let plan = Plan::new(&scene)?;
//! let mut simulation = Simulation::new(&scene, plan, 2)?;
//! while !simulation.is_done() {
//!     simulation.step()?;
//! }
//! // Fields of the last step, row by row: [y, x], Pa and m.
//! let mut frame = Frame::default();
//! simulation.fill(&mut frame);
//! assert_eq!(frame.pressure_pa.len(), frame.nx * frame.ny);
//! // Means over the passage, and the life relative to the smooth contact.
//! let summary = simulation.summary();
//! let life = summary.life_relative.ok_or("the scene asks for no life")?;
//! println!("h_min {:.3e} m, life {life:.3}", summary.h_min_m);
//! # assert!(summary.converged && life > 0.0);
//! # Ok(())
//! # }
//! ```
//!
//! | step | type | takes | gives | errors |
//! |---|---|---|---|---|
//! | asked | [`scene::Scene`] | a preset's name or a TOML file, SI, units in the key's names | the scene, validated | [`scene::SceneError`]: key, value, what is allowed |
//! | decided | [`plan::Plan`] | a scene | sizes, stages and why each other one is left out; no arrays | [`plan::PlanError`] |
//! | solved | [`sim::Simulation`] | scene, plan, number of threads; [`step`](sim::Simulation::step), [`set`](sim::Simulation::set) between steps | one time step a call; a warm one allocates nothing | [`sim::StepError`]: where and with what residual; nothing of that step is kept |
//! | seen | [`sim::Frame`] | [`fill`](sim::Simulation::fill) | fields of one step as `f32`, `[y, x]`, index `j * nx + i`; [`sim::Metrics`] | |
//! | summed up | [`sim::Summary`] | [`summary`](sim::Simulation::summary) | means over the passage, life, counts, cautions | |
//! | kept | [`sim::State`] | [`save`](sim::Simulation::save), [`restore`](sim::Simulation::restore) | all that a restart needs, bit for bit | [`sim::SimError`] |
//!
//! The equations: Reynolds with the film's squeeze along characteristics and unified contact (`solve::reynolds`), elastic
//! deflection by zero-padded convolution (`solve::film`), Newton with an active set (`solve::newton`), stress by windowed
//! frequency responses (`solve::stress`), rainflow (ASTM E1049, `physics::rainflow`), life after Zaretsky (1987) and others
//! (`physics::life_models`). Each file opens with its equation, its symbols with shapes, and its source. Results do not
//! depend on the number of threads. The same examples as programs: `passage`, `life_against_s`, `stress_field`.
//!
//! ## Floors
//! Imports go downward only: `files < math < physics < scene < plan < solve < sim < observe`.
//!
//! * [`files`]: plain files read, whole files written, digests.
//! * [`math`]: grids, fixed-order sums, planned FFTs, convolution. No contact words.
//! * [`physics`]: closed forms: Hertz, fluid laws, waviness, film regressions, stress, fatigue.
//! * [`scene`]: what the user asked, in SI, validated.
//! * [`plan`]: what that scene needs, and why each stage that is left out is left out.
//! * [`solve`]: one equation per file, dimensionless.
//! * [`sim`]: the simulation loop: `step`, `set`, `fill`.
//! * [`observe`]: what an observer of a run implements, and where the files that it writes lie meanwhile.

/// Compiles a function for the wide vector units too, and picks one at run time.
macro_rules! dispatched {
    ($function:item) => {
        #[multiversion::multiversion(targets(
            "x86_64+avx512f+avx512vl+avx512dq+avx512bw+fma",
            "x86_64+avx2+fma"
        ))]
        $function
    };
}

mod closed_set;
pub mod files;
pub mod math;
pub mod observe;
pub mod physics;
pub mod plan;
mod saved;
pub mod scene;
pub mod sim;
pub mod solve;
