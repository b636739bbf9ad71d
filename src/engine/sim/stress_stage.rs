//! Subsurface stress of a step: the slices y = 0 of both bodies, and the volume integral at the plan's cadence.

use crate::math::grid::{Grid, Symmetry};
use crate::physics::cycles::BodyId;
use crate::physics::fatigue::LifeLaw;
use crate::physics::life_models::LifeEquation;
use crate::physics::multiaxial::StressPath;
use crate::scene::StressMeasure;
use crate::solve::critical::shares_of_slice;
use crate::solve::life::Shares;
use crate::solve::stress::{
    Cut, LineStress, Loading, Plane, Purpose, SliceOut, StressEngine, StressError, StressLaw,
    StressSpec, VolumeSums,
};

/// What computes: a volume below a point contact, a plane below a line.
enum StressBackend {
    Volume(Box<StressEngine>),
    Line(Box<LineStress>),
}

impl StressBackend {
    fn spec(&self) -> &StressSpec {
        match self {
            Self::Volume(engine) => engine.spec(),
            Self::Line(engine) => engine.spec(),
        }
    }

    fn load(&mut self, pressure: &[f32], traction: Option<&[f32]>) {
        match self {
            Self::Volume(engine) => engine.load(pressure, traction),
            Self::Line(engine) => engine.load(pressure, traction),
        }
    }

    fn slice_of(&mut self, loading: Loading, out: &mut SliceOut) {
        match self {
            Self::Volume(engine) => engine.slice_of(loading, out),
            Self::Line(engine) => engine.slice_of(loading, out),
        }
    }

    fn sums(&self) -> &VolumeSums {
        match self {
            Self::Volume(engine) => engine.sums(),
            Self::Line(engine) => engine.sums(),
        }
    }
}

/// Engine, its single-precision inputs and the last slices.
pub(super) struct StressStage {
    engine: StressBackend,
    pressure: Vec<f32>,
    traction: Vec<f32>,
    shear: TractionActs,
    /// The slice of the last step in body 1.
    pub(super) slice: SliceOut,
    /// Room for what a life model makes of the surface loaded last.
    pub(super) shares: Shares,
    /// What life looks at besides; `None` where no life is asked for.
    companions: Option<Companions>,
}

/// Whether a traction acts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum TractionActs {
    None,
    AlongX,
}

struct Companions {
    /// The slice of the last step in body 2.
    mate: SliceOut,
    /// The slice that a criterion reads, and its memory for a row of it.
    criterion: SliceOut,
    path: StressPath,
}

impl StressStage {
    /// Makes the engine for `grid` with Poisson's ratios of both bodies, and `depths` depths down to
    /// `depth_max` (in a).
    ///
    /// # Errors
    /// [`StressError`] names what the engine refuses.
    pub(super) fn new(
        grid: &Grid,
        poisson: [f64; 2],
        depths: (usize, f64),
        measure: StressMeasure,
        purpose: Purpose,
    ) -> Result<Self, StressError> {
        let volume = || {
            let (nodes, spacing) = ((grid.nx, grid.ny), (grid.dx, grid.dy));
            let mut spec = StressSpec::new(nodes, spacing, poisson[0], depths, grid.symmetry);
            spec.nu_2 = poisson[1];
            (spec.x_first, spec.measure) = (grid.x_min, measure);
            spec.purpose = purpose;
            StressEngine::new(&spec).map(|engine| StressBackend::Volume(Box::new(engine)))
        };
        let engine = match grid.symmetry {
            Symmetry::MirrorY | Symmetry::General => volume()?,
            Symmetry::Line => {
                let place = (grid.x_min, grid.dx);
                let engine = LineStress::new(grid.nx, place, poisson, depths, measure);
                StressBackend::Line(Box::new(engine))
            }
        };
        let slice = SliceOut::new(engine.spec());
        Ok(Self {
            engine,
            pressure: vec![0.0; grid.len()],
            traction: vec![0.0; grid.len()],
            shear: TractionActs::None,
            shares: Shares::new(depths.0),
            companions: (purpose == Purpose::Volumes).then(|| Companions {
                mate: slice.clone(),
                criterion: slice.clone(),
                path: StressPath::new(grid.nx),
            }),
            slice,
        })
    }

    /// Depths, in a.
    pub(super) fn depths(&self) -> &[f64] {
        &self.engine.spec().depths
    }

    /// How many depths.
    pub(super) fn depth_count(&self) -> usize {
        self.engine.spec().depths.len()
    }

    /// Rows that a volume pass reports.
    pub(super) fn row_count(&self) -> usize {
        let one = Loading::Normal(BodyId::One);
        self.engine.sums().row_tops(one).len()
    }

    /// Pressure of the surface loaded last on the line y = 0.
    pub(super) fn pressure_on_axis(&self, grid: &Grid) -> &[f32] {
        &self.pressure[grid.axis_row() * grid.nx..][..grid.nx]
    }

    /// Takes the surface of a step and computes the slices.
    pub(super) fn slice(&mut self, p: &[f64], q: &[f64], friction: f64) {
        narrow(p, &mut self.pressure);
        narrow(q, &mut self.traction);
        self.shear = if friction == 0.0 {
            TractionActs::None
        } else {
            TractionActs::AlongX
        };
        let traction = (self.shear == TractionActs::AlongX).then_some(&self.traction[..]);
        self.engine.load(&self.pressure, traction);
        self.engine
            .slice_of(Loading::Full(BodyId::One), &mut self.slice);
        let two = Loading::Full(BodyId::Two);
        let alike = self.equal_loading(two).is_some();
        if let Some(companions) = self.companions.as_mut().filter(|_| !alike) {
            self.engine.slice_of(two, &mut companions.mate);
        }
    }

    /// The slice of the last step in a body; body 2 has one of its own where life is asked for.
    pub(super) fn slice_in(&self, body: BodyId) -> &SliceOut {
        match (body, &self.companions) {
            (BodyId::Two, Some(companions))
                if self.equal_loading(Loading::Full(BodyId::Two)).is_none() =>
            {
                &companions.mate
            }
            (BodyId::One | BodyId::Two, _) => &self.slice,
        }
    }

    /// A loading earlier in [`Loading::ALL`] with the same stress: without traction, and with the same
    /// Poisson's ratio, both bodies are alike.
    pub(super) fn equal_loading(&self, loading: Loading) -> Option<Loading> {
        let spec = self.engine.spec();
        let alike = spec.nu == spec.nu_2;
        match (loading, self.shear) {
            (Loading::Normal(BodyId::Two), _)
            | (Loading::Full(BodyId::Two), TractionActs::None)
                if alike =>
            {
                Some(Loading::Normal(BodyId::One))
            }
            (Loading::Full(body), TractionActs::None) => Some(Loading::Normal(body)),
            (Loading::Normal(_) | Loading::Full(_), _) => None,
        }
    }

    /// Stress of body 1 in a plane under the surface loaded last; `None` below a line, where y does not matter.
    pub(super) fn plane(&self, cut: Cut) -> Option<Plane> {
        match &self.engine {
            StressBackend::Volume(engine) => Some(engine.plane(Loading::Full(BodyId::One), cut)),
            StressBackend::Line(_) => None,
        }
    }

    /// Volume pass under the surface loaded last, both bodies.
    pub(super) fn volume(&mut self, laws: &[StressLaw]) {
        match &mut self.engine {
            StressBackend::Volume(engine) => engine.volume_under(laws, &BodyId::BOTH),
            StressBackend::Line(engine) => engine.volume_under(laws, &BodyId::BOTH),
        };
    }

    /// Sums of the last volume pass.
    pub(super) fn sums(&self) -> &VolumeSums {
        self.engine.sums()
    }

    /// Computes the slice that a criterion reads.
    pub(super) fn criterion_slice(&mut self, loading: Loading) {
        if let Some(companions) = &mut self.companions {
            self.engine.slice_of(loading, &mut companions.criterion);
        }
    }

    /// ln of the damage and risk by depth below the line y = 0, of the slice that was computed last, by a model of one depth.
    pub(super) fn criterion(
        &mut self,
        (model, law): (LifeEquation, LifeLaw),
        by_depth: &mut [f32],
        shares: &mut [f64],
    ) {
        let Some(Companions {
            criterion, path, ..
        }) = &mut self.companions
        else {
            return;
        };
        let spec = self.engine.spec();
        let place = (spec.nx, &spec.depths[..]);
        shares_of_slice(model, law, place, criterion, path, by_depth, shares);
    }
}

fn narrow(from: &[f64], to: &mut [f32]) {
    for (to, &from) in to.iter_mut().zip(from) {
        *to = from as f32;
    }
}
