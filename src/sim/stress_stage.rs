//! Subsurface stress of a step: the slice y = 0, and the volume integral at the plan's cadence.

use crate::math::grid::{Grid, Symmetry};
use crate::scene::StressMeasure;
use crate::solve::stress::{SliceOut, StressEngine, StressError, StressSpec, VolumeOut};

/// Engine, its single-precision inputs and the last slice.
pub(super) struct StressStage {
    engine: StressEngine,
    pressure: Vec<f32>,
    traction: Vec<f32>,
    /// The slice of the last step.
    pub(super) slice: SliceOut,
}

impl StressStage {
    /// Makes the engine for `grid` with `depths` depths down to `depth_max` (in a).
    ///
    /// # Errors
    /// [`StressError`] names what the engine refuses.
    pub(super) fn new(
        grid: &Grid,
        poisson: f64,
        depths: (usize, f64),
        measure: StressMeasure,
    ) -> Result<Self, StressError> {
        use crate::solve::stress::Symmetry as Rows;
        let symmetry = match grid.symmetry {
            Symmetry::MirrorY => Rows::MirrorY,
            // The engine refuses a single row: a line has a stress of its own.
            Symmetry::General | Symmetry::Line => Rows::General,
        };
        let mut spec = StressSpec::new(
            (grid.nx, grid.ny),
            (grid.dx, grid.dy),
            poisson,
            depths,
            symmetry,
        );
        spec.x_first = grid.x_min;
        spec.measure = measure;
        let slice = SliceOut::new(&spec);
        Ok(Self {
            engine: StressEngine::new(&spec)?,
            pressure: vec![0.0; grid.len()],
            traction: vec![0.0; grid.len()],
            slice,
        })
    }

    /// Depths, in a.
    pub(super) fn depths(&self) -> &[f64] {
        &self.engine.spec().depths
    }

    /// Takes the surface of a step and computes the slice.
    pub(super) fn slice(&mut self, p: &[f64], q: &[f64], friction: f64) {
        narrow(p, &mut self.pressure);
        narrow(q, &mut self.traction);
        let traction = (friction != 0.0).then_some(&self.traction[..]);
        self.engine.load(&self.pressure, traction);
        self.engine.slice(&mut self.slice);
    }

    /// ln ∫ s^m dV of the surface loaded last, without and with traction.
    pub(super) fn volume(&mut self, exponent: f64) -> VolumeOut {
        self.engine.volume(exponent)
    }
}

fn narrow(from: &[f64], to: &mut [f32]) {
    for (to, &from) in to.iter_mut().zip(from) {
        *to = from as f32;
    }
}
