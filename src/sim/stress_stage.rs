//! Subsurface stress of a step: the slice y = 0, and the volume integral at the plan's cadence.

use crate::math::grid::{Grid, Symmetry};
use crate::scene::StressMeasure;
use crate::solve::stress::{
    LineStress, SliceOut, StressEngine, StressError, StressSpec, VolumeOut,
};

/// What computes: a volume below a point contact, a plane below a line.
enum Engine {
    Volume(Box<StressEngine>),
    Line(Box<LineStress>),
}

impl Engine {
    fn spec(&self) -> &StressSpec {
        match self {
            Self::Volume(engine) => engine.spec(),
            Self::Line(engine) => engine.spec(),
        }
    }
}

/// Engine, its single-precision inputs and the last slice.
pub(super) struct StressStage {
    engine: Engine,
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
        let volume = |rows: Rows| {
            let (nodes, spacing) = ((grid.nx, grid.ny), (grid.dx, grid.dy));
            let mut spec = StressSpec::new(nodes, spacing, poisson, depths, rows);
            (spec.x_first, spec.measure) = (grid.x_min, measure);
            StressEngine::new(&spec).map(|engine| Engine::Volume(Box::new(engine)))
        };
        let engine = match grid.symmetry {
            Symmetry::MirrorY => volume(Rows::MirrorY)?,
            Symmetry::General => volume(Rows::General)?,
            Symmetry::Line => {
                let place = (grid.x_min, grid.dx);
                let engine = LineStress::new(grid.nx, place, poisson, depths, measure);
                Engine::Line(Box::new(engine))
            }
        };
        let slice = SliceOut::new(engine.spec());
        Ok(Self {
            engine,
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
        match &mut self.engine {
            Engine::Volume(engine) => {
                engine.load(&self.pressure, traction);
                engine.slice(&mut self.slice);
            }
            Engine::Line(engine) => {
                engine.load(&self.pressure, traction);
                engine.slice(&mut self.slice);
            }
        }
    }

    /// ln ∫ s^m dV of the surface loaded last, without and with traction.
    pub(super) fn volume(&mut self, exponent: f64) -> VolumeOut {
        match &mut self.engine {
            Engine::Volume(engine) => engine.volume(exponent),
            Engine::Line(engine) => engine.volume(exponent),
        }
    }
}

fn narrow(from: &[f64], to: &mut [f32]) {
    for (to, &from) in to.iter_mut().zip(from) {
        *to = from as f32;
    }
}
