//! What follows from the scene and is the same at every step: its plan, scales, laws and tolerances.

use super::Beside;
use super::Grounds;
use super::orbit::LONGEST;
use super::pace::Stepping;
use super::scaling::Scaling;
use crate::math::grid::{Grid, refined_nodes};
use crate::physics::fluid::ShearedFlow;
use crate::physics::strength::{self, Strength};
use crate::plan::{Plan, TimeDependence, Warning};
use crate::scene::{Cavitation, CycleBasis, Order, Rheology, Scene, Surface};
use crate::solve::march::{Flow, Shape, Solver};
use crate::solve::newton::Tolerance;
use crate::solve::stress::Cut;
use crate::solve::traction::{FilmShear, TractionLaw};

/// Nodes per side of the first grid.
const COARSEST: usize = 65;

/// Time (a/U) to ramp sliding and roughness and to flush the contact once; also what a steady contact
/// takes to be steady again after a knob moved.
const DEVELOP: f64 = 4.0;
/// Same of a steady contact that is solved with high order, whose correction follows the film step by step: with ridges along the
/// motion (demonstration) the central film is after 4, 8 and 12 a still 2.0, 0.3 and 0.02 % from where it comes to rest on 65 nodes.
const DEVELOP_CORRECTED: f64 = 12.0;
/// Part of the domain along x over which a smooth contact moves on a grid to which it has been interpolated; 1.6 a of the default scene.
const REFLUSHED: f64 = 0.4;

/// The plan of a scene, and what else follows from it.
pub(super) struct SimPlan {
    pub(super) scene: Scene,
    pub(super) decided: Plan,
    pub(super) scaling: Scaling,
    pub(super) shape: Shape,
    /// Flow of the films that are films.
    pub(super) flow: Flow,
    /// Of steps with flow and of steps without.
    pub(super) tolerances: [Tolerance; 2],
    /// Traction law of the scene's oil; its speed is the step's.
    pub(super) law: TractionLaw,
    /// η0/(p_h × film unit), s/m: shear stress of a Newtonian film per sliding speed; 0: no oil.
    pub(super) shear_rate: f64,
    /// What cautions are drawn from, as far as the scene gives it.
    pub(super) grounds: Grounds,
    pub(super) stepping: Stepping,
    /// The planes that the scene asks for beside y = 0.
    pub(super) cuts: Vec<Cut>,
    /// Root-mean-square height over amplitude of both bodies.
    pub(super) rms_shares: [f64; 2],
    /// Mean height over amplitude of both bodies.
    pub(super) mean_shares: [f64; 2],
    /// Hardness of the softer body over p_h; infinite: both are elastic.
    pub(super) hardness: f64,
    /// Whether a finer mesh is to go on from this run: it keeps what that needs.
    pub(super) hands_on: bool,
}

impl SimPlan {
    /// What follows from `scene` by the plan that was made for it.
    pub(super) fn new(scene: &Scene, decided: Plan) -> Self {
        let scaling = Scaling::new(scene);
        let flow = flow_of(scene);
        let hardness = scene.hardness_pa();
        Self {
            scene: scene.clone(),
            shape: shape_of(&decided, &scaling),
            flow,
            tolerances: [flow, Flow::Dry].map(|flow| tolerance_of(scene, flow, &scaling)),
            shear_rate: scene.lubricant.as_ref().map_or(0.0, |oil| {
                oil.viscosity_pa_s() / (scaling.p_hertz_pa * scaling.film_m)
            }),
            law: traction_law(scene, &scaling),
            grounds: grounds_of(scene, &decided),
            stepping: stepping_of(scene),
            cuts: cuts(scene),
            rms_shares: scene.surfaces().map(|surface| unit(surface).rq_m()),
            mean_shares: scene.surfaces().map(|surface| unit(surface).ra_m()),
            hardness: hardness.map_or(f64::INFINITY, |pa| scaling.p_from_pa(pa)),
            hands_on: false,
            decided,
            scaling,
        }
    }

    /// The grid of so many nodes per side.
    pub(super) fn grid(&self, nodes: usize) -> Grid {
        let domain = &self.decided.domain;
        Grid::new(
            nodes,
            domain.x_min_a,
            domain.x_max_a,
            domain.y_half_b * self.scaling.b_over_a,
            self.decided.symmetry,
        )
    }

    /// The grid that the passage is solved on.
    pub(super) fn finest(&self) -> Grid {
        self.grid(self.decided.domain.nodes)
    }

    /// Nodes per side of the first grid of the start-up.
    pub(super) fn first_nodes(&self) -> usize {
        COARSEST.min(self.decided.domain.nodes)
    }

    /// Nodes per side of the grids that the start-up climbs through.
    pub(super) fn climb(&self) -> impl Iterator<Item = usize> {
        let finest = self.decided.domain.nodes;
        std::iter::successors(Some(self.first_nodes()), |n| Some(refined_nodes(*n)))
            .take_while(move |n| *n <= finest)
    }

    /// A solver on the grid of so many nodes per side.
    pub(super) fn solver(&self, nodes: usize) -> Solver {
        let usual = self.stepping.usual();
        Solver::new(self.grid(nodes), &self.shape, usual, self.flow)
    }

    /// Steps that the summary may have to average over, at most.
    pub(super) fn most_steps(&self) -> usize {
        let longest = LONGEST.max(self.decided.passage_a);
        (longest / (self.stepping.least() * self.decided.domain.dx_a())).ceil() as usize
    }

    /// Smooth steps on a grid of `nodes` per side: the first grid is flushed from inlet to outlet, on the finer ones the
    /// error of interpolation leaves all but the end of the contact: central and least film of the default scene on 257 nodes are then within
    /// 5e-4 of what they are after nearly twice as many. Without flow one solve is enough.
    pub(super) fn smooth_steps(&self, nodes: usize, flows: bool) -> u64 {
        if !flows {
            return 2;
        }
        let share = if nodes == self.first_nodes() {
            1.0
        } else {
            REFLUSHED
        };
        (share * self.length() / self.usual_step(nodes)).ceil() as u64
    }

    /// Distance of both bodies, in a, in the smooth part of the start-up.
    pub(super) fn smooth_distance(&self) -> f64 {
        let flows = self.decided.has_flow();
        self.climb()
            .map(|nodes| {
                let dx = self.length() / (nodes - 1) as f64;
                self.smooth_steps(nodes, flows) as f64 * self.stepping.usual() * dx
            })
            .sum()
    }

    /// Steps of the start-up in all, where sliding or roughness come up.
    pub(super) fn start_up_steps(&self) -> u64 {
        let flows = self.decided.has_flow();
        let smooth: u64 = self
            .climb()
            .map(|nodes| self.smooth_steps(nodes, flows))
            .sum();
        smooth + self.steps_of(self.develop())
    }

    /// Time (a/U) that a contact takes to come up to its sliding and roughness, or to be steady again.
    pub(super) fn develop(&self) -> f64 {
        match (self.decided.time_dependence, self.decided.order) {
            (TimeDependence::Steady { .. }, Order::High) => DEVELOP_CORRECTED,
            (TimeDependence::Steady { .. } | TimeDependence::Transient, _) => DEVELOP,
        }
    }

    /// Steps of the usual length in so much time (a/U) on the finest grid.
    pub(super) fn steps_of(&self, time: f64) -> u64 {
        (time / self.usual_step(self.decided.domain.nodes)).ceil() as u64
    }

    /// Length of the usual step on the finest grid, in a.
    pub(super) fn usual_dt(&self) -> f64 {
        self.stepping.usual() * self.decided.domain.dx_a()
    }

    /// The same where steps may be fitted to the period of the waves; `None`: they go by their error, or the surfaces age:
    /// columns that meet the nodes in ever other places even out in the heights what a mesh errs by. So do crests of few
    /// nodes, which a fitted period has at few places: by phase, 65 nodes (6.8 a wave) say .057 to .086 of the default scene
    /// with fitted steps and .075 to .097 without, 129 nodes .093 to .101 with them and without.
    pub(super) fn fitted_dt(&self) -> Option<f64> {
        let fits = self.scene.age.is_none() && self.decided.resolution.resolves_waves();
        match self.stepping {
            Stepping::Fixed(_) => fits.then(|| self.usual_dt()),
            Stepping::Adaptive { .. } => None,
        }
    }

    /// Length of the usual step on a grid of `nodes` per side, in a.
    fn usual_step(&self, nodes: usize) -> f64 {
        self.stepping.usual() * (self.length() / (nodes - 1) as f64)
    }

    /// Length of the domain along x, in a.
    fn length(&self) -> f64 {
        self.decided.domain.x_max_a - self.decided.domain.x_min_a
    }

    /// Relative error of stress by sampling: that of Hertz's edge, measured at 64 nodes a half-width (4e-4 of
    /// the integral, a tenth of it in stress), and of the shortest wave, (2π/nodes)²/12 of a ripple as high as
    /// the mean; of waves that the contact does not feel none. An estimate, not a bound. `size`: Hertz half-width over the
    /// scene's.
    pub(super) fn stress_error(&self, amplitudes_m: [f64; 2], size: f64) -> f64 {
        let wave = |nodes: f64| (std::f64::consts::TAU / nodes).powi(2) / 12.0;
        let rough = self.decided.waves.iter().zip(amplitudes_m);
        let p_hertz_pa = self.decided.hertz.p_max_pa * size;
        let worst = rough.filter_map(|(plan, amplitude_m)| {
            let plan = plan.filter(|_| amplitude_m > 0.0)?;
            let nodes = plan.nodes.into_iter().filter(|nodes| nodes.is_finite());
            Some(nodes.map(wave).fold(0.0, f64::max) * plan.felt(amplitude_m, p_hertz_pa))
        });
        let worst = worst.fold(0.0, f64::max);
        4e-5 + 0.5 * worst
    }
}

fn shape_of(plan: &Plan, scaling: &Scaling) -> Shape {
    Shape {
        kappa: scaling.kappa,
        curvature_y: scaling.curvature_y,
        b_over_a: scaling.b_over_a,
        kappa_s: plan
            .traction_deflection
            .map_or(0.0, |t| scaling.kappa_s(t.mismatch_per_pa)),
        order: plan.order,
    }
}

fn stepping_of(scene: &Scene) -> Stepping {
    let usual = scene.time.step_nodes;
    match scene.time.tolerance {
        None => Stepping::Fixed(usual),
        Some(tolerance) => Stepping::Adaptive { tolerance, usual },
    }
}

fn flow_of(scene: &Scene) -> Flow {
    let oil = scene.lubricant.as_ref();
    oil.map_or(Flow::Dry, |oil| match oil.cavitation {
        Cavitation::Reynolds => Flow::Film,
        Cavitation::Jfo => Flow::MassConserving,
    })
}

/// Film, m, below which oil is no continuum: errors are taken relative to this film, not a thinner one.
const LEAST_FILM_M: f64 = 1e-9;

fn tolerance_of(scene: &Scene, flow: Flow, scaling: &Scaling) -> Tolerance {
    let asked = scene.numerics.tolerance;
    // A dry contact has no mass to balance; pressure and gap are held to a tighter tolerance, which costs one
    // iteration and leaves less than a picometre of overlap.
    let by_flow = |wet: f64, dry: f64| if flow == Flow::Dry { dry } else { wet };
    Tolerance {
        pressure: by_flow(asked, 1e-3 * asked),
        // What a step leaves of its film equation the next one takes over, so it need not be small against
        // the pressure's tolerance: a hundredth of the film, at 1e-3. Films of one step are then within 5e-6
        // (`tests/engine/converged_step.rs`), lives of a passage the same to five digits from 1e-2 to 1e-4 (accuracy study).
        film: by_flow(10.0 * asked, 1e-3 * asked),
        mass: by_flow(0.1 * asked, f64::INFINITY),
        least_film: scaling.h_from_m(LEAST_FILM_M),
        load: 1e-5,
        max_iterations: scene.numerics.max_iterations,
    }
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
fn grounds_of(scene: &Scene, decided: &Plan) -> Grounds {
    Grounds {
        eyring_stress_pa: (scene.lubricant.as_ref())
            .filter(|oil| oil.rheology == Rheology::Eyring)
            .map(|oil| oil.eyring_stress_pa),
        resolution: Some(decided.resolution),
        shallow_stress_a: decided.warnings.iter().find_map(|warning| match warning {
            Warning::ShallowStress { depth_max_a } => Some(*depth_max_a),
            _ => None,
        }),
        thermal_unknown_pa: [1, 2].map(|of| {
            decided.warnings.iter().find_map(|warning| match *warning {
                Warning::ThermalUnknown { body, young_pa } if body == of => Some(young_pa),
                _ => None,
            })
        }),
        measure: scene.stress.as_ref().map(|stress| stress.measure),
        strength: [&scene.body_1, &scene.body_2].map(|body| match body.hardness_pa {
            Some(hardness_pa) if hardness_pa.is_finite() => Some(Strength::of(hardness_pa)),
            _ => strength::by_young(body.young_pa),
        }),
        beside: Beside {
            warming: scene.warming(),
            wears: scene.wear.is_some(),
        },
        hardness_pa: scene.hardness_pa(),
        cutoffs_m: scene.surfaces().map(Surface::cutoff_short_m),
        maps: scene.surfaces().map(Surface::map_doubts),
        has_life: scene.life.is_some(),
        by_damage: (scene.life.as_ref()).is_some_and(|life| life.cycles == CycleBasis::Damage),
        ..Grounds::default()
    }
}

/// Root-mean-square height over amplitude; 0 for a surface without height.
/// A surface of amplitude 1, also where a hand may still turn it up.
fn unit(surface: &Surface) -> Surface {
    let mut unit = surface.clone();
    unit.set_amplitude_m(1.0);
    unit
}

fn traction_law(scene: &Scene, scaling: &Scaling) -> TractionLaw {
    let film = scene.lubricant.as_ref().map(|oil| FilmShear {
        rate: 0.0,
        eyring: match oil.rheology {
            Rheology::Newtonian => None,
            Rheology::Eyring => Some(oil.eyring_stress_pa / scaling.p_hertz_pa),
        },
        limit: oil.limiting_shear_ratio,
        steepness: match scaling.medium(1.0, 0.0).sheared {
            ShearedFlow::AlongAcross { steepness, .. } => steepness,
            ShearedFlow::Secant => 0.0,
        },
    });
    TractionLaw {
        film,
        viscosity: scaling.medium(1.0, 0.0).viscosity,
        boundary: scene.friction.boundary,
        contact_film: scaling.h_from_m(scene.friction.contact_film_m),
        direction: 0.0,
    }
}
