//! What a scene needs: one option per stage, sizes, memory, cadence, and why a stage is left out.
//!
//! A plan holds no arrays. `Simulation::new` takes it as given; `asperity check` prints it. A stage that
//! is not needed is `None`, and [`Plan::left_out`] says why.

mod cost;
mod decide;
mod display;
mod domain;
mod film;
mod left_heat;
mod life;
mod range;
pub mod recording;
mod resolution;
mod surfaces;
mod truncation;
mod warning;
mod wear;

pub use cost::Cost;
pub use domain::{Crests, Domain};
pub use left_heat::LeftHeat;
pub use life::{LifeAsked, LifePlan};
pub use recording::RecordPlan;
pub use resolution::{KnobsAt, Resolution};
pub use surfaces::WavePlan;
pub use truncation::{Truncation, inlet_error, side_error, sizing_rule};
pub(crate) use warning::LOST;
pub use warning::{LeftOut, PlanError, Warning};
pub use wear::WearPlan;

pub use crate::math::grid::Symmetry;
use crate::physics::groups::Groups;
use crate::physics::hertz::Hertz;
use crate::scene::{
    ContactKind, EyringFlow, Lubricant, MINIMUM_HARDNESS, MapReport, Order, OrderAsked, Record,
    Scene, StressMeasure, Surface, Warming,
};

/// Everything that is decided before the first step.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// The scene's title.
    pub title: String,
    /// Point or line.
    pub kind: ContactKind,
    /// The Hertz contact.
    pub hertz: Hertz,
    /// Normal load, N; of a line per metre of length, N/m.
    pub force_n: f64,
    /// Speeds of body 1 and 2, m/s.
    pub speeds_m_s: [f64; 2],
    /// Slide-to-roll ratio S = (U2 - U1)/U.
    pub slide_roll: f64,
    /// How grade and temperature became viscosity and pressure coefficient, in words; `None`: the scene gives those.
    pub oil_line: Option<String>,
    /// The film; `None`: dry.
    pub film: Option<FilmPlan>,
    /// Nodes and edges.
    pub domain: Domain,
    /// Order of the discretisation at the scene's own speed and load.
    pub order: Order,
    /// Node spacing along x, m.
    pub dx_m: f64,
    /// Node spacing along y, m; of a line that of the rows which show it.
    pub dy_m: f64,
    /// Whether half of the rows is enough.
    pub symmetry: Symmetry,
    /// Whether time matters.
    pub time_dependence: TimeDependence,
    /// Time step, s.
    pub dt_s: f64,
    /// Time steps after the start-up; of adaptive ones, what as many of the usual length would be.
    pub steps: u64,
    /// Whether all that passes are waves that nothing changes for good, so that a passage may repeat and its life settle:
    /// a mesh below the scene's own needs no more.
    pub may_settle: bool,
    /// Whether the run ends once it has: the scene does not say how many passages it makes.
    pub until_settled: bool,
    /// Tolerance of adaptive steps; `None`: all have the usual length.
    pub step_tolerance: Option<f64>,
    /// Time steps of one length of 4 a at U.
    pub steps_per_passage: u64,
    /// One length of 4 a at U, in a: what means are taken over.
    pub passage_a: f64,
    /// Length of the run after the start-up, in a at U.
    pub length_a: f64,
    /// The waves of body 1 and 2; `None`: smooth.
    pub waves: [Option<WavePlan>; 2],
    /// What mesh and step make of them.
    pub resolution: Resolution,
    /// The height maps of body 1 and 2; `None`: it has none.
    pub maps: [Option<MapReport>; 2],
    /// What their heights are, made or read, in words.
    pub relief_lines: [Vec<String>; 2],
    /// Normal deflection by tangential traction, u^s; `None`: the bodies are alike.
    pub traction_deflection: Option<TractionDeflection>,
    /// Pressure at which the softer body flows, Pa, and which bodies do; `None`: both stay elastic.
    pub yielding: Option<(f64, [bool; 2])>,
    /// What of the heat is followed.
    pub warming: Warming,
    /// What wears; `None`: nothing.
    pub wear: Option<WearPlan>,
    /// Subsurface stress.
    pub stress: Option<StressPlan>,
    /// Fatigue life.
    pub life: Option<LifePlan>,
    /// Recording.
    pub record: Option<RecordPlan>,
    /// Stages that are left out, and why.
    pub left_out: Vec<LeftOut>,
    /// What the user should know before trusting the numbers.
    pub warnings: Vec<Warning>,
    /// Estimated cost.
    pub cost: Cost,
}

/// The film by regression formulas: first guess and scale.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmPlan {
    /// Dimensionless groups.
    pub groups: Groups,
    /// Central film by Nijenbanning, Venner and Moes, m; of a line by Moes.
    pub central_m: f64,
    /// What other formulas say.
    pub others: OtherFilms,
    /// Central film in a²/Rx.
    pub central: f64,
    /// λ of the scene ([`FilmPlan::lambda`]); `None`: smooth.
    pub lambda_ratio: Option<f64>,
    /// Rx/Ry; 0 for a line.
    pub radii_ratio: f64,
    /// Half-width along y over that along x; of a line 1.
    pub ellipticity: f64,
    /// Whether the oil between the bodies can leave.
    pub valleys: Valleys,
    /// What the pressure's flow meets in sheared oil; `None`: the oil is Newtonian.
    pub eyring_flow: Option<EyringFlow>,
    /// Order of the discretisation that the scene asks for.
    pub order: OrderAsked,
}

/// Whether oil between crests that touch can leave by the valleys of one of the surfaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Valleys {
    /// One of the bodies is smooth, or its ridges run one way (in a line contact: is smooth).
    Open,
    /// Both are wavy in all directions, or there is a height map, of which nothing is known.
    Closed,
}

/// One layer of oil molecules, m: the width of a hydrocarbon chain, which is the step in which films of n-alkanes
/// between smooth solids are pressed out (0.4 nm: Christenson, Gruen, Horn and Israelachvili 1987, J. Chem. Phys. 87,
/// 1834-1841). Where the central film of the smooth contact by formula is thinner there is no fluid that flows, and
/// Reynolds' equation says nothing. Such contacts are solved dry, if their valleys are open ([`Valleys`]).
///
/// With open valleys that is where the lubricated solver arrives by itself; shut-in oil goes on to carry load however
/// slowly the bodies move, and flow stays in. Dry against lubricated at the switch, p_h = 1 GPa, A = 0.3 µm, waves of
/// 0.73 a, half a passage (`asperity run` at 3.5e-5 and 2.5e-5 m/s, line 2e-5 and 1e-5 m/s; `tests/engine/dry_switch.rs`
/// repeats two on a coarser grid):
///
/// | body 1, body 2 | maximum pressure | relative life | valleys |
/// |---|---|---|---|
/// | ridges along x, smooth | −0.1 % | +0.2 % | open |
/// | ridges across, product of waves | −2.1 % | +3.7 % | open |
/// | ridges across, ridges across | −0.4 % | +3.5 % | open |
/// | ridges across, ridges along | +0.1 % | −5.5 % | open |
/// | ridges at −45° and 45° | −0.2 % | −7.8 % | open |
/// | smooth, product of waves | +0.1 % | −1.2 % | open |
/// | line: ridges, smooth | +0.1 % | −3.4 % | open |
/// | product of waves on both | −8.2 % | +46 % | closed |
/// | line: ridges on both | −9.5 % | +41 % | closed |
pub const MOLECULE_M: f64 = 4e-10;

impl FilmPlan {
    /// Whether it is at least one layer of molecules thick ([`MOLECULE_M`]).
    pub fn is_film(&self) -> bool {
        self.central_m >= MOLECULE_M
    }

    /// Whether flow is solved: there is a film, or oil that cannot leave. Else the contact is dry.
    pub fn flows(&self) -> bool {
        self.is_film() || self.valleys == Valleys::Closed
    }
}

/// Films by the classic formulas of each kind of contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum OtherFilms {
    /// Point contact.
    HamrockDowson {
        /// Central film, m.
        central_m: f64,
        /// Minimum film, m.
        minimum_m: f64,
    },
    /// Line contact.
    DowsonHigginson {
        /// Minimum film, m.
        minimum_m: f64,
    },
}

/// Whether time is marched.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TimeDependence {
    /// Nothing changes in time: one solution is all.
    Steady {
        /// Why.
        why: &'static str,
    },
    /// Time steps.
    Transient,
}

/// Normal deflection by tangential traction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TractionDeflection {
    /// (1 + ν₁)(1 − 2ν₁)/E₁ − (1 + ν₂)(1 − 2ν₂)/E₂, 1/Pa.
    pub mismatch_per_pa: f64,
}

/// Subsurface stress of body 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StressPlan {
    /// Depths of the slice and of the volume.
    pub depths: usize,
    /// Deepest point, m.
    pub depth_max_m: f64,
}

/// Error of the film by the edges of the domain above which the user is told: an inlet that the plan chooses costs less than
/// half of it, where the contact deforms.
pub const EDGES_WORTH_A_WORD: f64 = 0.01;

/// Rows by which frames show a line contact, all alike: enough for a map or a mesh.
pub const LINE_ROWS: usize = 9;
/// Half of the width that they span, in half-widths of the contact.
pub const LINE_HALF_WIDTH: f64 = 2.0;

/// A passage, in a.
const PASSAGE_A: f64 = 4.0;
/// The start-up costs as much as so many crossings of the domain (all grids) and so many lengths of 4 a (the development)
/// on the last grid; measured on the default scene, whose domain is 4 a long.
const START_UP_CROSSINGS: f64 = 1.5;
const START_UP_PASSAGES: f64 = 1.0;

/// Distance between rows, m; of a line between those of its stress.
fn row_spacing_m(kind: ContactKind, domain: &Domain, hertz: &Hertz) -> f64 {
    match kind {
        ContactKind::Point => domain.dy_b() * hertz.b_m,
        ContactKind::Line => 2.0 * LINE_HALF_WIDTH * hertz.a_m / (LINE_ROWS - 1) as f64,
    }
}

impl Plan {
    /// Decides what a validated scene needs.
    ///
    /// # Errors
    /// [`PlanError::Refused`] when a wavelength has fewer than 4 nodes, or when the equations do not hold for the bodies or
    /// the film.
    pub fn new(scene: &Scene) -> Result<Self, PlanError> {
        Self::of(scene).map_err(|error| error.beside_the_unusual(scene))
    }

    fn of(scene: &Scene) -> Result<Self, PlanError> {
        let hertz = scene.hertz();
        let film = decide::film_plan(scene, &hertz);
        range::check(scene, &hertz, film.as_ref())?;
        let kind = scene.kind();
        let crests_m = decide::crest_m(scene);
        let crests = decide::crests(scene, &hertz, crests_m);
        let domain = Domain::choose(
            kind,
            &scene.grid,
            film.map(|film| film.truncation()),
            crests,
        )
        .holding(decide::maximum_size(scene), &scene.grid);
        let dx_m = domain.dx_a() * hertz.a_m;
        let dy_m = row_spacing_m(kind, &domain, &hertz);
        let mut warnings = decide::domain_warnings(&domain, film.as_ref());
        if crests.meet_at_edge_of(kind, &domain) {
            warnings.push(Warning::CrestsAtEdge { crests_m });
        }
        let order = decide::order(scene, film.as_ref(), &domain);
        let step_m = scene.time.step_nodes * dx_m;
        let waves = surfaces::plan(scene, [dx_m, dy_m], step_m)?;
        let resolution = Resolution::new(&waves, scene, order);
        warnings.extend(resolution.warnings(&KnobsAt::of(scene, film.as_ref())));
        let time_dependence = decide::time_dependence(scene);
        let steps_per_passage = (4.0 * hertz.a_m / step_m).round().max(1.0) as u64;
        let may_settle = decide::may_settle(scene, time_dependence);
        let distance_m = scene.time.most_passages() * PASSAGE_A * hertz.a_m;
        let doubts = surfaces::doubts(scene, hertz.a_m.min(hertz.b_m));
        warnings.extend(doubts.chain(decide::late_events(scene, distance_m)));
        warnings.extend(decide::thermal_unknown(scene));
        let steps = match time_dependence {
            TimeDependence::Steady { .. } => 1,
            TimeDependence::Transient => (distance_m / step_m).ceil() as u64,
        };
        let plan = Self {
            title: scene.title.clone(),
            kind,
            hertz,
            force_n: scene.force_n(),
            speeds_m_s: scene.speeds_m_s(),
            slide_roll: scene.motion.slide_roll,
            oil_line: scene.lubricant.as_ref().and_then(Lubricant::conversion),
            film,
            domain,
            order,
            dx_m,
            dy_m,
            symmetry: decide::symmetry(scene),
            time_dependence,
            dt_s: step_m / scene.motion.entrainment_m_s.abs(),
            steps,
            may_settle,
            until_settled: may_settle && scene.time.passages.is_none(),
            step_tolerance: scene.time.tolerance,
            steps_per_passage,
            passage_a: PASSAGE_A,
            length_a: scene.time.most_passages() * PASSAGE_A,
            waves,
            resolution,
            maps: scene.map_reports(),
            relief_lines: scene.surfaces().map(Surface::relief_lines),
            traction_deflection: decide::traction_deflection(scene),
            yielding: scene.hardness_pa().map(|pa| (pa, scene.softer())),
            warming: scene.warming(),
            wear: WearPlan::new(scene, &hertz),
            stress: decide::stress_plan(scene, &hertz, &mut warnings),
            life: None,
            record: None,
            left_out: Vec::new(),
            warnings,
            cost: Cost {
                memory_bytes: 0,
                time_s: 0.0,
            },
        };
        plan.with_outputs(scene)
    }

    /// Life, recording, what is left out, cost: by the rest of the plan.
    fn with_outputs(mut self, scene: &Scene) -> Result<Self, PlanError> {
        self.life = scene.life.as_ref().map(|life| {
            let measure = scene
                .stress
                .as_ref()
                .map_or(StressMeasure::VonMises, |s| s.measure);
            self.life_plan(life, measure)
        });
        if let Some(record) = &scene.record {
            recording::check(self.kind, self.domain.nodes, record)?;
            self.record = Some(self.record_plan(record));
        }
        self.left_out = decide::left_out(scene, &self);
        self.cost = self.estimate();
        Ok(self)
    }

    /// Whether oil flows at the scene's own speed and load; else every step is that of a dry contact.
    pub fn has_flow(&self) -> bool {
        self.film.is_some_and(|film| film.flows())
    }

    /// Maximum load whose Hertz pressure is no more than the softer body carries as a whole; infinite: both are elastic.
    pub fn carried_force_n(&self) -> f64 {
        self.yielding.map_or(f64::INFINITY, |(hardness_pa, _)| {
            let ratio = hardness_pa / (MINIMUM_HARDNESS * self.hertz.p_max_pa);
            self.force_n * ratio.powi(self.kind.order())
        })
    }

    /// Maximum load, N (a line: N/m), that the bodies carry and whose Hertz contact ends inside of the domain: two nodes
    /// before its edge, where the pressure must be zero.
    pub fn maximum_force_n(&self) -> f64 {
        let domain = &self.domain;
        let along = domain.x_max_a.min(-domain.x_min_a) - 2.0 * domain.dx_a();
        let size = match self.kind {
            ContactKind::Point => along.min(domain.y_half_b - 2.0 * domain.dy_b()),
            ContactKind::Line => along,
        };
        let held = size.max(1.0).powi(self.kind.order());
        (self.force_n * held).min(self.carried_force_n())
    }

    /// Whether crests of the scene's bodies that are so high together, m, can meet at an edge of the domain, in a contact `size`
    /// times the scene's.
    pub fn crests_meet(&self, scene: &Scene, crests_m: f64, size: f64) -> bool {
        let crests = decide::crests(scene, &self.hertz, crests_m / size.powi(2));
        crests.meet_at_edge_of(self.kind, &self.domain.seen_by(size))
    }

    fn depths(&self) -> usize {
        self.stress.map_or(0, |stress| stress.depths)
    }

    fn record_plan(&self, record: &Record) -> RecordPlan {
        let frame = cost::frame_bytes(self.domain.nodes, self.shown_rows());
        RecordPlan::new(record, self.steps, frame)
    }

    /// Rows of a frame.
    fn shown_rows(&self) -> usize {
        match self.kind {
            ContactKind::Point => self.domain.nodes,
            ContactKind::Line => LINE_ROWS,
        }
    }

    fn estimate(&self) -> Cost {
        let volumes = self
            .life
            .map_or(0, |life| self.steps / life.volume_every_steps + 1);
        let domain = &self.domain;
        let step_a = self.dt_s * self.speeds_m_s.iter().sum::<f64>().abs() / 2.0 / self.hertz.a_m;
        let crossing = (domain.x_max_a - domain.x_min_a) / step_a;
        let rows = match self.symmetry {
            Symmetry::MirrorY => 0.5,
            Symmetry::General | Symmetry::Line => 1.0,
        };
        let cost = Cost::new(cost::CostInput {
            kind: self.kind,
            nodes: self.domain.nodes,
            rows,
            depths: self.depths(),
            steps: self.steps,
            start_up_steps: (START_UP_CROSSINGS * crossing
                + START_UP_PASSAGES * self.steps_per_passage as f64)
                as u64,
            volumes,
        });
        let size = (self.kind, self.domain.nodes, rows);
        cost.with_heat(self.warming, size, self.steps)
    }
}
