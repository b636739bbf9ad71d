//! Who carries the load: oil, asperities, or both.

use serde::{Deserialize, Serialize};

/// Lubrication regime of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LubricationRegime {
    /// The film separates the surfaces.
    FullFilm,
    /// Film and asperities share the load.
    Mixed,
    /// Asperities carry it; what oil there is makes a boundary layer.
    Boundary,
    /// No oil flows.
    #[default]
    Dry,
}

impl LubricationRegime {
    /// Boundary from this share of the load on.
    const BOUNDARY_SHARE: f64 = 0.9;

    /// Regime of a step in which contacts carry `contact_load_ratio` of the load; `flows`: oil flows.
    pub fn of(flows: bool, contact_load_ratio: f64) -> Self {
        if !flows {
            Self::Dry
        } else if contact_load_ratio >= Self::BOUNDARY_SHARE {
            Self::Boundary
        } else if contact_load_ratio > 0.0 {
            Self::Mixed
        } else {
            Self::FullFilm
        }
    }

    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::FullFilm => "full film",
            Self::Mixed => "mixed",
            Self::Boundary => "boundary",
            Self::Dry => "dry",
        }
    }
}
