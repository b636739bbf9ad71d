//! What a plan says in words: stages left out, warnings with numbers, and what it refuses.

use thiserror::Error;

use super::Valleys;
use crate::math::number::{fixed, sig};
use crate::scene::{ContactKind, Doubt, Scene, unusual};

/// Error by the mesh beyond which what is left of a film says nothing of it: of second order half is gone then.
pub(crate) const LOST: f64 = 0.4;

/// A stage that is left out.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LeftOut {
    /// Stage, in a word or two.
    pub stage: &'static str,
    /// Why.
    pub why: String,
}

/// What the user should know before trusting the numbers.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum Warning {
    /// The mesh is too coarse for the film.
    #[error(
        "the mesh costs the smooth central film about {:.0} %; more grid.nodes help{}",
        100.0 * error.min(9.99), if *error > LOST { ", and here the film may vanish" } else { "" }
    )]
    CoarseForTheFilm {
        /// Estimated relative error.
        error: f64,
    },
    /// The inlet is too short, or the sides are too near.
    #[error(
        "the edges of the domain, the inlet at {x_min_a:.4} a, starve the film by about {:.1} %; {} move them out, for which more grid.nodes make room",
        100.0 * error, match kind { ContactKind::Point => "grid.x_min_a and grid.y_half_a", ContactKind::Line => "grid.x_min_a" }
    )]
    ShortDomain {
        /// Estimated relative error.
        error: f64,
        /// Inlet edge, in a.
        x_min_a: f64,
        /// Point or line.
        kind: ContactKind,
    },
    /// A surface is not what it should be.
    #[error("body {body}: {doubt}")]
    Surface {
        /// Body, 1 or 2.
        body: u8,
        /// What is doubtful.
        doubt: Doubt,
    },
    /// Crests can touch at the edge of the domain.
    #[error(
        "crests, {} µm high together, can touch at the edge of the domain, where contact is cut off; use a higher load or a wider grid (grid.x_min_a, grid.x_max_a, grid.y_half_a)",
        fixed(1e6 * crests_m, 3)
    )]
    CrestsAtEdge {
        /// Heights of both surfaces' crests together, m.
        crests_m: f64,
    },
    /// A wave has few nodes.
    #[error("body {body}: {nodes:.1} nodes per wave; 12 or more resolve its deformation")]
    CoarseWave {
        /// Body, 1 or 2.
        body: u8,
        /// Nodes of the shorter wavelength.
        nodes: f64,
    },
    /// The film wave that travels at U has few nodes.
    #[error(
        "body {body}: {nodes:.1} nodes in its convected film wave (W U/U_{body}); {advised:.0} are advised"
    )]
    CoarseConvectedWave {
        /// Body, 1 or 2.
        body: u8,
        /// Nodes.
        nodes: f64,
        /// Nodes that are advised.
        advised: f64,
    },
    /// Crests pass a material point in few time steps.
    #[error(
        "a crest of body {body} passes in {samples:.1} steps; cycle counting needs 16: reduce time.step_nodes"
    )]
    CoarseCounting {
        /// Body whose crests pass, 1 or 2.
        body: u8,
        /// Time steps in which one crest of it slides past a point of the other body.
        samples: f64,
    },
    /// The time step is too long for the film or for a wave.
    #[error(
        "time.step_nodes = {nodes} {}; {} or less is advised: long steps thin the film",
        if wave_nodes.is_finite() {
            format!("leaves a wave of {wave_nodes:.1} nodes {:.1} steps", wave_nodes / nodes)
        } else {
            "is more than a node".to_owned()
        },
        (100.0 * advised).floor() / 100.0
    )]
    LongStep {
        /// Step, in nodes at U.
        nodes: f64,
        /// Nodes of the shortest wave that passes; infinite: none does.
        wave_nodes: f64,
        /// Longest step that is advised, in nodes.
        advised: f64,
    },
    /// The film by formula is no film.
    #[error(
        "film by formula {} nm, less than one layer of molecules ({:.1} nm): {}",
        fixed(1e9 * film_m, 2),
        1e9 * super::MOLECULE_M,
        match valleys {
            Valleys::Open => "solved dry",
            Valleys::Closed => "solved with flow all the same, because both surfaces trap oil, which carries load",
        }
    )]
    NoFilm {
        /// Central film by formula, m.
        film_m: f64,
        /// Whether the oil can leave.
        valleys: Valleys,
    },
    /// An event after the end of the run.
    #[error(
        "a run of {} ms ends before the event at {} ms; a longer one (time.passages) reaches it",
        sig(1e3 * end_s, 3),
        sig(1e3 * at_s, 3)
    )]
    LateEvent {
        /// When, s.
        at_s: f64,
        /// End of the run, s.
        end_s: f64,
    },
    /// A body that is not steel warms as steel does.
    #[error(
        "body {body} is not steel (body_{body}.young_pa = {young_pa:e}) and warms as bearing steel does, for want of its own conductivity, density and heat capacity (body_{body}.heat)"
    )]
    ThermalUnknown {
        /// Body, 1 or 2.
        body: u8,
        /// Its modulus, Pa.
        young_pa: f64,
    },
    /// The stress integral is cut off.
    #[error("stress.depth_max_a = {depth_max_a} cuts the life integral short; use 2 or more")]
    ShallowStress {
        /// Deepest point, in a.
        depth_max_a: f64,
    },
}

/// A scene that cannot be computed as asked.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum PlanError {
    /// A wavelength is not resolved by the grid, or the equations do not hold for the bodies or the film.
    #[error("{key} = {value} is refused; allowed: {allowed}")]
    Refused {
        /// Key in full.
        key: String,
        /// The value.
        value: String,
        /// What is allowed.
        allowed: String,
    },
}

impl PlanError {
    /// The same with the key of the scene that is far from what is usual, if there is one: it may be the cause.
    pub(super) fn beside_the_unusual(self, scene: &Scene) -> Self {
        let Self::Refused {
            key,
            value,
            mut allowed,
        } = self;
        if let Some(words) = unusual(scene) {
            allowed = format!("{allowed}; {words}");
        }
        Self::Refused {
            key,
            value,
            allowed,
        }
    }
}
