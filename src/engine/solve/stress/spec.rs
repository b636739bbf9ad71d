//! What the stress engine is asked for.
//!
//! Part of `stress/mod.rs`.

use super::depth::depth_rule;
pub use crate::math::grid::Symmetry;
use crate::physics::cycles::BodyId;
use crate::scene::StressMeasure;

/// Which body is looked at, and what acts on it. Body 2 has its own inward z and the same x and y; the
/// traction on it is opposite.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Loading {
    /// Pressure alone.
    Normal(BodyId),
    /// Pressure and traction.
    Full(BodyId),
}

impl Loading {
    /// Every loading, in the order in which results are kept.
    pub const ALL: [Self; 4] = [
        Self::Normal(BodyId::One),
        Self::Full(BodyId::One),
        Self::Normal(BodyId::Two),
        Self::Full(BodyId::Two),
    ];

    /// Place in [`Self::ALL`].
    pub fn index(self) -> usize {
        match self {
            Self::Normal(body) => 2 * body.index(),
            Self::Full(body) => 2 * body.index() + 1,
        }
    }

    /// The body that is looked at.
    pub fn body(self) -> BodyId {
        match self {
            Self::Normal(body) | Self::Full(body) => body,
        }
    }

    /// Factor of the loaded traction.
    pub(super) fn traction_sign(self) -> f32 {
        match self {
            Self::Normal(_) => 0.0,
            Self::Full(BodyId::One) => 1.0,
            Self::Full(BodyId::Two) => -1.0,
        }
    }
}

/// What an engine is used for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// Slices and planes: no memory for volumes is made.
    Slices,
    /// Volumes too.
    Volumes,
}

/// What the engine is asked for. Lengths in a, stress in p_h.
#[derive(Debug, Clone)]
pub struct StressSpec {
    /// Nodes along x.
    pub nx: usize,
    /// Rows given (see [`Symmetry`]).
    pub ny: usize,
    /// Coordinate of the first node along x, a. Only places the results.
    pub x_first: f64,
    /// Node spacing along x, a.
    pub dx: f64,
    /// Node spacing along y, a.
    pub dy: f64,
    /// Poisson's ratio of body 1.
    pub nu: f64,
    /// Poisson's ratio of body 2.
    pub nu_2: f64,
    /// Depths, ascending, > 0, a.
    pub depths: Vec<f64>,
    /// Weights of the depths in an integral over z, a.
    pub weights: Vec<f64>,
    /// Which rows are given: of all of them (`ny` odd) the middle one is y = 0.
    pub symmetry: Symmetry,
    /// What it is used for.
    pub purpose: Purpose,
    /// Scalar measure of stress.
    pub measure: StressMeasure,
    /// Least period of the transform over the size of the domain.
    pub pad: f64,
    /// δ: width of the window's edge over the period ([`super::window`]).
    pub window: f64,
    /// ε: modes with e^{−kz} below it are left out.
    pub decay: f64,
}

impl StressSpec {
    /// Default padding: errors from the images stay below 1e-5 of p_h.
    pub const PAD: f64 = 1.5;
    /// Default δ: the window's spectrum is e^{−(16 πδ)²} = 6e-5 at the first mode that is not tabulated (`window.rs`).
    pub const WINDOW: f64 = 0.062;
    /// Default ε: of the order of what δ leaves.
    pub const DECAY: f64 = 1e-4;

    /// `n_depths` depths down to `depth_max` (in a) by [`depth_rule`], von Mises, default constants.
    pub fn new(
        (nx, ny): (usize, usize),
        (dx, dy): (f64, f64),
        nu: f64,
        (n_depths, depth_max): (usize, f64),
        symmetry: Symmetry,
    ) -> Self {
        let (depths, weights) = depth_rule(n_depths, depth_max);
        Self {
            nx,
            ny,
            x_first: 0.0,
            dx,
            dy,
            nu,
            nu_2: nu,
            depths,
            weights,
            symmetry,
            purpose: Purpose::Volumes,
            measure: StressMeasure::VonMises,
            pad: Self::PAD,
            window: Self::WINDOW,
            decay: Self::DECAY,
        }
    }

    /// # Errors
    /// [`StressError`] names the entry that is out of range.
    pub(super) fn check(&self) -> Result<(), StressError> {
        let bad = |key: &'static str, value: f64, allowed: &'static str| {
            Err(StressError {
                key,
                value,
                allowed,
            })
        };
        let positive = |v: f64| v.is_finite() && v > 0.0;
        if self.nx < 9 || self.nx > 4097 {
            return bad("nx", self.nx as f64, "9 to 4097");
        }
        if self.ny < 5 || self.ny > 4097 {
            return bad("ny", self.ny as f64, "5 to 4097");
        }
        if self.symmetry == Symmetry::General && self.ny.is_multiple_of(2) {
            return bad("ny", self.ny as f64, "odd, so that one row is y = 0");
        }
        if !positive(self.dx) {
            return bad("dx", self.dx, "finite, above 0");
        }
        if !positive(self.dy) {
            return bad("dy", self.dy, "finite, above 0");
        }
        for (key, nu) in [("nu", self.nu), ("nu_2", self.nu_2)] {
            if !(0.0..=0.5).contains(&nu) {
                return bad(key, nu, "0 to 0.5");
            }
        }
        if !(1.2..=4.0).contains(&self.pad) {
            return bad("pad", self.pad, "1.2 to 4");
        }
        if !(0.05..=0.12).contains(&self.window) {
            return bad("window", self.window, "0.05 to 0.12");
        }
        if !(1e-8..=1e-2).contains(&self.decay) {
            return bad("decay", self.decay, "1e-8 to 1e-2");
        }
        self.check_depths()
    }

    fn check_depths(&self) -> Result<(), StressError> {
        let bad = |value: f64, allowed: &'static str| {
            Err(StressError {
                key: "depths",
                value,
                allowed,
            })
        };
        let count = self.depths.len();
        if !(4..=256).contains(&count) || self.weights.len() != count {
            return bad(count as f64, "4 to 256, as many as weights");
        }
        let ascending = self.depths.windows(2).all(|pair| pair[0] < pair[1]);
        let inside = |z: &f64| z.is_finite() && *z > 0.0 && *z <= 100.0;
        match self.depths.iter().find(|z| !inside(z)) {
            Some(z) => bad(*z, "above 0, at most 100"),
            None if !ascending => bad(self.depths[0], "ascending"),
            None => Ok(()),
        }
    }

    /// Poisson's ratio of a body.
    pub fn poisson(&self, body: BodyId) -> f64 {
        match body {
            BodyId::One => self.nu,
            BodyId::Two => self.nu_2,
        }
    }

    /// Tables that are needed: one where both bodies have the same Poisson's ratio.
    pub(super) fn materials(&self) -> usize {
        if self.nu == self.nu_2 { 1 } else { 2 }
    }

    /// The table of a body.
    pub(super) fn material(&self, body: BodyId) -> usize {
        body.index().min(self.materials() - 1)
    }

    /// Rows of the whole domain.
    pub(super) fn full_rows(&self) -> usize {
        match self.symmetry {
            Symmetry::MirrorY => 2 * self.ny - 1,
            Symmetry::General | Symmetry::Line => self.ny,
        }
    }
}

/// A specification that the engine refuses.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("stress engine: {key} = {value}; allowed: {allowed}")]
pub struct StressError {
    /// Which entry.
    pub key: &'static str,
    /// Its value.
    pub value: f64,
    /// What is allowed.
    pub allowed: &'static str,
}
