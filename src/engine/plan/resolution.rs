//! What the mesh and the time step make of the waves, at any slide-to-roll ratio and amplitude: for the plan at the scene's,
//! for the cautions at those of now.

use super::{FilmPlan, Warning, WavePlan};
use crate::physics::cycles::speed_ratios;
use crate::scene::{Order, Scene, Surface};

/// Mesh, step and waves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resolution {
    /// Nodes of one wavelength of body 1 and 2 along x and along y; `None`: it has no waves.
    pub nodes: [Option<[f64; 2]>; 2],
    /// Time step, in nodes at U.
    pub step_nodes: f64,
    /// Whether steps find their length by their error.
    pub is_adaptive: bool,
    /// Order of the discretisation.
    pub order: Order,
}

/// Where the knobs stand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KnobsAt {
    /// S.
    pub slide_roll: f64,
    /// Amplitudes of body 1 and 2, m.
    pub amplitudes_m: [f64; 2],
    /// Whether there is oil.
    pub has_oil: bool,
    /// Whether it flows.
    pub flows: bool,
}

/// Nodes of a wave below which its deformation is inaccurate.
const NODES_GOOD: f64 = 12.0;
/// Nodes of the convected film wave below which it decays numerically, by order of the discretisation.
const NODES_CONVECTED: [f64; 2] = [16.0, 10.0];
/// Time steps per passing crest that rainflow counting wants.
const SAMPLES_GOOD: f64 = 16.0;
/// Time steps of a wave that passes a fixed place, by order.
const SAMPLES_PASSING: [f64; 2] = [16.0, 12.0];

impl KnobsAt {
    /// Where the scene puts them.
    pub(super) fn of(scene: &Scene, film: Option<&FilmPlan>) -> Self {
        Self {
            slide_roll: scene.motion.slide_roll,
            amplitudes_m: scene.surfaces().map(Surface::amplitude_m),
            has_oil: scene.lubricant.is_some(),
            flows: film.is_some_and(FilmPlan::flows),
        }
    }
}

impl Resolution {
    /// Of the waves of a plan.
    pub(super) fn new(waves: &[Option<WavePlan>; 2], scene: &Scene, order: Order) -> Self {
        Self {
            nodes: waves.map(|wave| wave.map(|wave| wave.nodes)),
            step_nodes: scene.time.step_nodes,
            is_adaptive: scene.time.tolerance.is_some(),
            order,
        }
    }

    /// What is too coarse there, body by body, the time step last.
    pub fn warnings(&self, at: &KnobsAt) -> Vec<Warning> {
        let waves = [1, 2].into_iter().flat_map(|body| self.of_body(body, at));
        waves.chain(self.long_step(at)).collect()
    }

    /// Whether every wave along x has the nodes that resolve its deformation.
    pub(crate) fn resolves_waves(&self) -> bool {
        let mut waves = self.nodes.iter().flatten();
        waves.all(|[along, _]| *along >= NODES_GOOD)
    }

    /// Nodes of the waves of a body that is rough.
    fn rough(&self, body: u8, at: &KnobsAt) -> Option<[f64; 2]> {
        let index = usize::from(body - 1);
        self.nodes[index].filter(|_| at.amplitudes_m[index] != 0.0)
    }

    fn by_order(&self, [second, high]: [f64; 2]) -> f64 {
        match self.order {
            Order::Second => second,
            Order::High => high,
        }
    }

    fn of_body(&self, body: u8, at: &KnobsAt) -> Vec<Warning> {
        let Some([along, across]) = self.rough(body, at) else {
            return Vec::new();
        };
        let fewest = along.min(across);
        let convected = along / speed_ratio(body, at.slide_roll);
        let advised = self.by_order(NODES_CONVECTED);
        let samples = along / (self.step_nodes * at.slide_roll.abs());
        [
            (fewest < NODES_GOOD).then_some(Warning::CoarseWave {
                body,
                nodes: fewest,
            }),
            (at.has_oil && convected < advised).then_some(Warning::CoarseConvectedWave {
                body,
                nodes: convected,
                advised,
            }),
            (samples < SAMPLES_GOOD).then_some(Warning::CoarseCounting { body, samples }),
        ]
        .into_iter()
        .flatten()
        .collect()
    }

    /// A time step that costs film: longer than a node, or than a sixteenth of a wave that passes (a twelfth where time is of
    /// order 3).
    ///
    /// At 8 nodes a wave the mean central film errs by 41, 13, 3.6 and 0.7 % with steps of 4, 2, 1 and half a node
    /// (`asperity study accuracy`); a smooth film loses by long steps, too, where it is steep.
    fn long_step(&self, at: &KnobsAt) -> Option<Warning> {
        let passing = |body: &u8| speed_ratio(*body, at.slide_roll) > 0.0;
        let waves = [1, 2].into_iter().filter(passing);
        let along = waves.filter_map(|body| self.rough(body, at).map(|[along, _]| along));
        let wave_nodes = along.fold(f64::INFINITY, f64::min);
        // Adaptive steps find their length themselves; the start-up keeps to the usual one.
        let by_wave = if self.is_adaptive {
            f64::INFINITY
        } else {
            wave_nodes / self.by_order(SAMPLES_PASSING)
        };
        let advised = by_wave.min(1.0);
        let nodes = self.step_nodes;
        (at.flows && nodes > advised).then_some(Warning::LongStep {
            nodes,
            wave_nodes,
            advised,
        })
    }
}

/// Speed of a body over U, without sign.
fn speed_ratio(body: u8, slide_roll: f64) -> f64 {
    speed_ratios(slide_roll)[usize::from(body) - 1].abs()
}
