//! Making a simulation: everything is allocated here.

use std::sync::Arc;

use rayon::{ThreadPool, ThreadPoolBuilder};

use super::counting::Counting;
use super::counting_spec::counting_spec;
use super::door::Door;
use super::drive::Drive;
use super::fatigue_stage::LifeStage;
use super::measure::RowSums;
use super::motion::Motion;
use super::orbit::{LONGEST, Orbit};
use super::pace::{Pace, Stepping};
use super::regime::Regime;
use super::simulation::{Phase, Simulation};
use super::state::{State, Work};
use super::stepping::Attempted;
use super::stress_stage::StressStage;
use super::terrain::Terrain;
use super::totals::Totals;
use super::yielded::Yielded;
use super::{Grounds, Knob, Metrics, SimError, Stats};
use crate::math::grid::{Grid, Symmetry};
use crate::physics::fluid::ShearedFlow;
use crate::physics::strength::{self, Strength};
use crate::plan::Plan;
use crate::scene::{Cavitation, CycleBasis, Scene, Surface};
use crate::solve::march::{Flow, Shape, Solver};
use crate::solve::newton::Tolerance;
use crate::solve::stress::{Cut, Purpose};
use crate::solve::traction::{FilmShear, TractionLaw};

/// Nodes per side of the first grid.
pub(super) const COARSEST: usize = 65;

impl Simulation {
    /// Makes all memory for `scene` by `plan`; `threads` workers of its own.
    ///
    /// # Errors
    /// [`SimError`] when the workers cannot be started or the stress engine refuses the plan.
    pub fn new(scene: &Scene, plan: Plan, threads: usize) -> Result<Self, SimError> {
        let pool = thread_pool(threads)?;
        let door = Door::new(scene);
        let flow = flow_of(scene);
        let shape = shape_of(&plan, &door);
        let first = COARSEST.min(plan.domain.nodes);
        let grid = grid_of(&plan, first, door.b_over_a);
        let film = plan.film.map_or(0.0, |film| film.central);
        let nodes = scene.time.step_nodes;
        let mut solver = pool.install(|| Solver::new(grid, &shape, nodes, flow));
        let contact = pool.install(|| solver.hertz(&shape, film));
        let fine = grid_of(&plan, plan.domain.nodes, door.b_over_a);
        let stages = pool.install(|| Stages::new(scene, &plan, &fine, &door))?;
        let (wanted, drive) = drives(scene);
        let stepping = stepping_of(scene);
        let most_steps = LONGEST.max(plan.passage_a) / (stepping.least() * plan.domain.dx_a());
        let speed_m_s = scene.motion.entrainment_m_s.abs();
        let regime = Regime::new(&plan, flow, speed_m_s, |flow| {
            tolerance_of(scene, flow, &door)
        });
        let mut terrain = Terrain::new(&fine, scene.surfaces(), door.a_m, door.heading);
        let (hardness, yielded) = yielded_of(scene, &fine, &mut terrain);
        let state = State {
            nodes: first,
            contact,
            drive,
            wanted,
            motion: motion_of(scene, &door),
            yielded,
            watched: [0.0; 2],
            counting: stages.counting,
            life: stages.life,
            smooth: None,
            phase: Phase::Smooth { left: 0 },
            metrics: Metrics::default(),
            stats: Stats::default(),
            totals: Totals::default(),
            coarser: None,
            mesh_errors: None,
            orbit: Orbit::new(fine.len(), plan.passage_a),
            pace: Pace::new(stepping),
            way: 0.0,
            next_volume: 0.0,
            step: 0,
            time_s: 0.0,
            start_up_steps: (0, 1),
        };
        let work = Work {
            solver,
            terrain,
            stress: stages.stress,
            traction: vec![0.0; fine.len()],
            row_sums: vec![RowSums::default(); fine.ny],
            smooth: None,
        };
        let mut this = Self {
            work,
            cuts: cuts(scene),
            iso_load_ratio: scene.life.as_ref().and_then(|life| life.iso_load_ratio),
            stress_error: stress_error(&plan, [1.0; 2]),
            law: traction_law(scene, &door),
            composite: scene.surfaces().map(rms_share),
            hardness: hardness.map_or(f64::INFINITY, |pa| door.p_from_pa(pa)),
            grounds: grounds_of(scene),
            plan,
            door,
            shape,
            flow,
            regime,
            stepping,
            most_steps: most_steps.ceil() as usize,
            pool: Arc::new(pool),
            state,
        };
        this.begin(first);
        Ok(this)
    }

    /// Before the first step, on a grid of `first` nodes per side.
    fn begin(&mut self, first: usize) {
        self.make_room();
        self.state.phase = Phase::Smooth {
            left: self.smooth_steps(first, self.plan.has_flow()),
        };
        self.state.start_up_steps.1 = self.all_start_up_steps();
        let measured = self.measure();
        self.publish(&Attempted::default(), &measured);
    }
}

/// What looks at a step: stress, life, counts; `None`: not asked for.
struct Stages {
    stress: Option<StressStage>,
    life: Option<LifeStage>,
    counting: Option<Counting>,
}

impl Stages {
    fn new(scene: &Scene, plan: &Plan, grid: &Grid, door: &Door) -> Result<Self, SimError> {
        let stress = stress_stage(scene, plan, grid, door)?;
        let life = stress
            .as_ref()
            .and_then(|stress| LifeStage::new(scene, plan, stress));
        let counting = stress.as_ref().map(|stress| {
            let mut spec = counting_spec(scene, plan, door.heading, stress.depth_count());
            spec.laws = life.as_ref().map(|life| life.laws.clone());
            Counting::new(grid, stress.depths(), &spec)
        });
        Ok(Self {
            stress,
            life,
            counting,
        })
    }
}

fn shape_of(plan: &Plan, door: &Door) -> Shape {
    Shape {
        kappa: door.kappa,
        curvature_y: door.curvature_y,
        b_over_a: door.b_over_a,
        kappa_s: plan
            .traction_deflection
            .map_or(0.0, |t| door.kappa_s(t.mismatch_per_pa)),
        order: plan.order,
    }
}

/// Hardness of the softer body, Pa, and what has yielded so far: nothing. `None`: both bodies are elastic.
fn yielded_of(scene: &Scene, grid: &Grid, terrain: &mut Terrain) -> (Option<f64>, Option<Yielded>) {
    let Some(hardness) = scene.hardness_pa() else {
        return (None, None);
    };
    let repeats = [0, 1].map(|body: usize| terrain.repeat(body));
    let yielded = Yielded::new(grid, scene.softer(), repeats);
    for body in [0, 1] {
        if yielded.yields(body) {
            terrain.make_heights(grid, body);
        }
    }
    (Some(hardness), Some(yielded))
}

/// The knobs as the scene wants them, and as the start-up begins: smooth, and without sliding.
fn drives(scene: &Scene) -> (Drive, Drive) {
    let wanted = Drive::new(|knob| {
        let value = match knob {
            Knob::EntrainmentMS => knob.of(scene).abs(),
            _ => knob.of(scene),
        };
        (value, knob.line().ramp.rate(value))
    });
    let mut drive = wanted.clone();
    for knob in Knob::OF_ROUGHNESS_AND_SLIDING {
        drive.jump(knob, 0.0);
    }
    (wanted, drive)
}

fn motion_of(scene: &Scene, door: &Door) -> Motion {
    let mut motion = Motion::new();
    motion.shear_rate = scene.lubricant.as_ref().map_or(0.0, |oil| {
        oil.viscosity_pa_s / (door.p_hertz_pa * door.film_m)
    });
    motion
}

fn stepping_of(scene: &Scene) -> Stepping {
    let usual = scene.time.step_nodes;
    match scene.time.tolerance {
        None => Stepping::Fixed(usual),
        Some(tolerance) => Stepping::Adaptive { tolerance, usual },
    }
}

fn thread_pool(threads: usize) -> Result<ThreadPool, SimError> {
    ThreadPoolBuilder::new()
        .num_threads(threads)
        .thread_name(|i| format!("asperity-{i}"))
        .build()
        .map_err(|error| SimError::Threads {
            threads,
            reason: error.to_string(),
        })
}

fn flow_of(scene: &Scene) -> Flow {
    let oil = scene.lubricant.as_ref();
    oil.map_or(Flow::Dry, |oil| match oil.cavitation {
        Cavitation::Reynolds => Flow::Film,
        Cavitation::Jfo => Flow::MassConserving,
    })
}

/// Film, m, below which oil is no continuum: errors are judged against this film, not a thinner one.
const LEAST_FILM_M: f64 = 1e-9;

fn tolerance_of(scene: &Scene, flow: Flow, door: &Door) -> Tolerance {
    let asked = scene.numerics.tolerance;
    // A dry contact has no mass to balance; pressure and gap are judged by a tighter tolerance, which costs one
    // iteration and leaves less than a picometre of overlap.
    let by_flow = |wet: f64, dry: f64| if flow == Flow::Dry { dry } else { wet };
    Tolerance {
        pressure: by_flow(asked, 1e-3 * asked),
        // What a step leaves of its film equation the next one takes over, so it need not be small against
        // the pressure's tolerance: a hundredth of the film, at 1e-3. Films of one step are then within 5e-6
        // (`tests/engine/converged_step.rs`), lives of a passage the same to five digits from 1e-2 to 1e-4 (accuracy study).
        film: by_flow(10.0 * asked, 1e-3 * asked),
        mass: by_flow(0.1 * asked, f64::INFINITY),
        least_film: door.h_from_m(LEAST_FILM_M),
        load: 1e-5,
        max_iterations: scene.numerics.max_iterations,
    }
}

fn stress_stage(
    scene: &Scene,
    plan: &Plan,
    grid: &Grid,
    door: &Door,
) -> Result<Option<StressStage>, SimError> {
    let Some((asked, planned)) = scene.stress.as_ref().zip(plan.stress.as_ref()) else {
        return Ok(None);
    };
    let depths = (planned.depths, planned.depth_max_m / door.a_m);
    let poisson = [scene.body_1.poisson, scene.body_2.poisson];
    let purpose = if scene.life.is_some() {
        Purpose::Volumes
    } else {
        Purpose::Slices
    };
    StressStage::new(grid, poisson, depths, asked.measure, purpose)
        .map(Some)
        .map_err(|error| SimError::Stress(error.to_string()))
}

/// The planes that the scene asks for beside y = 0.
fn cuts(scene: &Scene) -> Vec<Cut> {
    let Some(stress) = &scene.stress else {
        return Vec::new();
    };
    [
        stress.plane_x_a.map(Cut::X),
        stress.plane_y_a.map(Cut::Y),
        stress.plane_z_a.map(Cut::Z),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// What the scene says of the grounds of cautions.
fn grounds_of(scene: &Scene) -> Grounds {
    Grounds {
        measure: scene.stress.as_ref().map(|stress| stress.measure),
        strength: [&scene.body_1, &scene.body_2].map(|body| match body.hardness_pa {
            Some(hardness_pa) if hardness_pa.is_finite() => Some(Strength::of(hardness_pa)),
            _ => strength::by_young(body.young_pa),
        }),
        hardness_pa: scene.hardness_pa(),
        has_life: scene.life.is_some(),
        by_damage: (scene.life.as_ref()).is_some_and(|life| life.cycles == CycleBasis::Damage),
        ..Grounds::default()
    }
}

/// Root-mean-square height over amplitude; 0 for a surface without height.
fn rms_share(surface: &Surface) -> f64 {
    if surface.amplitude_m() > 0.0 {
        surface.rq_m() / surface.amplitude_m()
    } else {
        0.0
    }
}

pub(super) fn grid_of(plan: &Plan, nodes: usize, b_over_a: f64) -> Grid {
    let symmetry = match plan.symmetry {
        crate::plan::Symmetry::MirrorY => Symmetry::MirrorY,
        crate::plan::Symmetry::General => Symmetry::General,
        crate::plan::Symmetry::Line => Symmetry::Line,
    };
    let domain = &plan.domain;
    Grid::new(
        nodes,
        domain.x_min_a,
        domain.x_max_a,
        domain.y_half_b * b_over_a,
        symmetry,
    )
}

fn traction_law(scene: &Scene, door: &Door) -> TractionLaw {
    let film = scene.lubricant.as_ref().map(|oil| FilmShear {
        rate: 0.0,
        eyring: (oil.rheology == crate::scene::Rheology::Eyring)
            .then_some(oil.eyring_stress_pa / door.p_hertz_pa),
        limit: oil.limiting_shear_ratio,
        steepness: match door.medium(1.0, 0.0).sheared {
            ShearedFlow::AlongAcross { steepness, .. } => steepness,
            ShearedFlow::Secant => 0.0,
        },
    });
    TractionLaw {
        film,
        viscosity: door.medium(1.0, 0.0).viscosity,
        boundary: scene.friction.boundary,
        contact_film: door.h_from_m(scene.friction.contact_film_m),
        direction: 0.0,
    }
}

/// Relative error of stress by sampling: that of Hertz's edge, measured at 64 nodes a half-width (4e-4 of
/// the integral, a tenth of it in stress), and of the shortest wave, (2π/nodes)²/12 of a ripple as high as
/// the mean; of bodies without amplitude none. An estimate, not a bound.
pub(super) fn stress_error(plan: &Plan, amplitudes_m: [f64; 2]) -> f64 {
    let wave = |nodes: f64| (std::f64::consts::TAU / nodes).powi(2) / 12.0;
    let rough = plan.waves.iter().zip(amplitudes_m);
    let waves = rough.filter_map(|(wave, amplitude_m)| wave.filter(|_| amplitude_m > 0.0));
    let worst = waves
        .flat_map(|w| w.nodes)
        .filter(|nodes| nodes.is_finite())
        .map(wave)
        .fold(0.0, f64::max);
    4e-5 + 0.5 * worst
}
