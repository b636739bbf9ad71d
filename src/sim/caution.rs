//! What a reader must know before trusting a result: a code for scripts, a sentence with numbers for people.

use serde::{Deserialize, Serialize};

use super::Frame;

/// Kind of caution, as scripts read it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CautionCode {
    /// Pressure or stress beyond what the material carries elastically.
    BeyondYield,
    /// The mesh costs a good part of the film.
    MeshFilm,
    /// Models and cycle bases differ by a large factor.
    ModelRange,
    /// The average still moves, or does not cover a period of the present conditions yet.
    NotSettled,
    /// The film is thinner than a layer of oil molecules.
    FilmBelowMolecule,
    /// A body stands (|S| = 2) and is left out of the life.
    StandingBody,
}

/// A caution: its code, and a sentence with numbers.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Caution {
    /// Kind.
    pub code: CautionCode,
    /// In words.
    pub text: String,
}

impl Frame {
    /// What to know before trusting this frame's numbers, the weightiest first.
    pub fn cautions(&self) -> Vec<Caution> {
        Vec::new()
    }
}
