//! Who carries the load: oil, asperities, or both.
//!
//! ```text
//! dry        no oil flows
//! boundary   λ < 0.01, or contacts carry 90 % of the load or more
//! full film  λ ≥ 1.2, and contacts carry 1 % of the load or less
//! mixed      between them
//! ```
//! Zhu and Wang (2012, Proc. IMechE J 226, 1010-1022), from deterministic simulations like this one and from
//! experiments: little or no asperity contact above λ of 0.6 to 1.2, mixed lubrication down to λ of 0.01 to 0.05. Of both
//! ranges the end is taken that never calls a film full, or a contact boundary, too early; the older limit of λ = 3
//! (Tallian 1967, ASLE Trans. 10, 418-439) comes from surfaces that do not give way. λ alone does not see which
//! asperities meet, and the load that contacts carry does not see what the mesh misses between them: a film counts as
//! full where both say so. Of smooth surfaces, which have no λ, the load alone decides.

use serde::{Deserialize, Serialize};

/// Lubrication regime of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LubricationRegime {
    /// The film separates the surfaces.
    FullFilm,
    /// Film and asperities share the load, or the film is too thin for the roughness to be called full.
    Mixed,
    /// Asperities carry it; what oil there is makes a boundary layer.
    Boundary,
    /// No oil flows.
    #[default]
    Dry,
}

impl LubricationRegime {
    /// Full film from this λ on.
    const FULL_LAMBDA: f64 = 1.2;
    /// Boundary below this λ.
    const BOUNDARY_LAMBDA: f64 = 0.01;
    /// Full film up to this share of the load on contacts.
    const FULL_SHARE: f64 = 0.01;
    /// Boundary from this share on.
    const BOUNDARY_SHARE: f64 = 0.9;

    /// Regime of a step with film parameter `lambda` (`None`: smooth) in which contacts carry `share` of the load;
    /// `flows`: oil flows.
    pub fn of(flows: bool, lambda: Option<f64>, share: f64) -> Self {
        let lambda = lambda.unwrap_or(f64::INFINITY);
        if !flows {
            Self::Dry
        } else if share >= Self::BOUNDARY_SHARE || lambda < Self::BOUNDARY_LAMBDA {
            Self::Boundary
        } else if share <= Self::FULL_SHARE && lambda >= Self::FULL_LAMBDA {
            Self::FullFilm
        } else {
            Self::Mixed
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thin_film_is_never_called_full() {
        use LubricationRegime::{Boundary, Dry, FullFilm, Mixed};
        for (flows, lambda, share, expected) in [
            (true, Some(3.0), 0.0, FullFilm),
            (true, Some(1.2), 0.005, FullFilm),
            // What the screen called a full film: no spot touches by the mesh, but λ says otherwise.
            (true, Some(0.34), 0.0, Mixed),
            (true, Some(0.28), 0.0, Mixed),
            (true, Some(0.14), 0.0, Mixed),
            (true, Some(3.0), 0.1, Mixed),
            (true, Some(0.3), 0.95, Boundary),
            (true, Some(0.005), 0.2, Boundary),
            (true, None, 0.0, FullFilm),
            (true, None, 0.95, Boundary),
            (false, Some(2.0), 1.0, Dry),
        ] {
            let got = LubricationRegime::of(flows, lambda, share);
            assert_eq!(got, expected, "{flows} {lambda:?} {share}");
        }
    }
}
