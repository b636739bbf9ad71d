//! What a scene must assume because nobody knows it of a machine: which crest meets which where surfaces roll, and by which law
//! oil flows that is sheared beyond its Eyring stress. The life over the other choices, on the coarsest mesh that carries the waves.
//!
//! ```text
//! r_k = life(choice k)/life(the scene's)          one mesh
//! range = life · min(1, r) … life · max(1, r)
//! band over phases = life_low · min(1, r)/ε … life_high · max(1, r)·ε     ε: what this mesh is off at the scene's own
//! ```
//! Phases: of body 1, k·45 degrees more; at S = 0 only where the scene asks for none: both `phase_deg` are 0. Who wants crest on
//! crest writes 360. Where S is so small that crests do not meet in all ways while the run lasts, whatever is asked for: a longer run
//! would come through all of them. Laws of the oil: the other law of flow, half and twice the Eyring stress. A factor of two either
//! way is an assumption: mineral oils are given 2 to 10 MPa.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::crew::share_out;
use super::ladder::{Ladder, Mesh};
use asperity_engine::plan::Plan;
use asperity_engine::scene::{EyringFlow, Lubricant, Rheology, Scene, Spread, Surface};
use asperity_engine::sim::{CautionCode, Rung, Summary};

/// Phases of body 1 beside the scene's, degrees.
const PHASES: [f64; 7] = [45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0];
/// Laws of the oil beside the scene's.
const LAWS: [fn(&mut Lubricant); 3] = [other_flow, half, twice];

/// What a run takes that may go on until its life has settled, in a: one that is asked to be shorter is short, its S not small.
const USUAL_A: f64 = 8.0;

/// A choice that a scene must make and nobody can.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Assumed {
    /// Where the crests of one body stand to those of the other, at S = 0 and where they hardly shift.
    Phase,
    /// How sheared oil flows.
    OilLaw,
}

impl Assumed {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Phase, Self::OilLaw];

    /// Whether the life of a run hangs on it. On the oil's law alone one does whose run is long beside the lives of these:
    /// it climbs to a finer mesh.
    pub fn moves(self, scene: &Arc<Scene>, plan: &Plan) -> bool {
        let rolls = scene.motion.slide_roll == 0.0;
        let has_one_life = scene.age.is_none() && scene.life.is_some() && scene.events.is_empty();
        has_one_life
            && match self {
                Self::Phase if rolls => scene.surfaces().into_iter().all(has_open_phase),
                Self::Phase => {
                    let length = plan.length_a.max(USUAL_A);
                    let waves = plan.meetings(scene.motion.slide_roll, length);
                    waves.is_some_and(|waves| waves < 1.0)
                        && scene.surfaces().into_iter().all(has_waves)
                }
                Self::OilLaw => {
                    let oil = scene.lubricant.as_ref();
                    !rolls
                        && oil.is_some_and(|oil| oil.rheology == Rheology::Eyring)
                        && plan.has_flow()
                        && Ladder::of(scene, plan).meshes().len() > 1
                }
            }
    }

    /// The caution that says so.
    pub fn caution(self) -> CautionCode {
        match self {
            Self::Phase => CautionCode::PhaseLocked,
            Self::OilLaw => CautionCode::OilLaw,
        }
    }

    /// How many choices there are with the scene's own.
    pub fn count(self) -> usize {
        1 + match self {
            Self::Phase => PHASES.len(),
            Self::OilLaw => LAWS.len(),
        }
    }

    /// Makes choice `k` in a scene; 0 is the scene's own.
    pub fn choose(self, k: usize, scene: &mut Scene) {
        let Some(k) = k.checked_sub(1) else { return };
        match self {
            Self::Phase => {
                if let Surface::Sinusoid { phase_deg, .. } = &mut scene.body_1.surface {
                    *phase_deg = (*phase_deg + PHASES[k]) % 360.0;
                }
            }
            Self::OilLaw => {
                if let Some(oil) = &mut scene.lubricant {
                    LAWS[k](oil);
                }
            }
        }
    }

    /// Gives a finished run's life its range over the choices; its band holds the phases. `None`: it hangs on none, not all of
    /// them get through, or somebody said stop.
    pub fn vary(
        self,
        scene: &Arc<Scene>,
        plan: &Plan,
        threads: usize,
        summary: &mut Summary,
        stop: &AtomicBool,
    ) -> Option<AssumedRange> {
        if !self.moves(scene, plan) {
            return None;
        }
        let ladder = Ladder::of(scene, plan);
        let first = &ladder.meshes()[0];
        // A run that has climbed knows the life of its own choice on that mesh.
        let of_first = |rung: &&Rung| rung.nodes == first.plan.domain.nodes;
        let own = summary.rungs.iter().find(of_first);
        let own = own
            .filter(|_| ladder.climbs())
            .map(|rung| rung.life_relative);
        let mut scenes = vec![(*first.scene).clone(); self.count()];
        for (k, scene) in scenes.iter_mut().enumerate() {
            self.choose(k, scene);
            if let Some(life) = &mut scene.life {
                life.spread = Spread::Off; // of their lives the scene's model is all that is read
            }
        }
        let others = &scenes[usize::from(own.is_some())..];
        let made = share_out(
            others,
            threads,
            |scene| life(&ladder, scene, stop),
            &mut |_, _| {},
        );
        let lives: Vec<_> = own.into_iter().chain(made).collect();
        let range = AssumedRange::of(&lives)?;
        let life = summary.life_relative?;
        let [low, high] = range.of_life(life).map(Some);
        match self {
            Self::Phase => {
                (summary.life_phases_low, summary.life_phases_high) = (low, high);
                let band = summary.life_relative_low.zip(summary.life_relative_high);
                let band = band.map(|(low, high)| range.of_band(life, [low, high]));
                summary.life_relative_low = band.map(|[low, _]| low);
                summary.life_relative_high = band.map(|[_, high]| high);
                *summary = std::mem::take(summary).with_cycles_band();
            }
            Self::OilLaw => (summary.life_oil_low, summary.life_oil_high) = (low, high),
        }
        Some(range)
    }
}

/// What the other choices do to a life.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AssumedRange {
    /// The life with the scene's own choice, on the mesh of all of them.
    own: f64,
    /// Least and greatest r.
    ratios: [f64; 2],
}

impl AssumedRange {
    /// Of the lives by choice, the scene's own first; `None`: one is missing, or there is nothing to compare with: the own life is
    /// 0 or has no end.
    pub fn of(lives: &[Option<f64>]) -> Option<Self> {
        let own = lives.first()?.filter(|own| own.is_normal())?;
        let mut ratios = [1.0, 1.0];
        for life in lives {
            let ratio = (*life)? / own;
            ratios = [f64::min(ratios[0], ratio), f64::max(ratios[1], ratio)];
        }
        Some(Self { own, ratios })
    }

    /// Of a life with the scene's own choice, on whatever mesh.
    pub fn of_life(self, life: f64) -> [f64; 2] {
        self.ratios.map(|ratio| life * ratio)
    }

    /// Of such a life's band, which is to hold all choices.
    pub fn of_band(self, life: f64, [low, high]: [f64; 2]) -> [f64; 2] {
        let off = (life / self.own).ln().abs().exp();
        let [least, most] = self.ratios;
        [low * least / off, high * most * off]
    }
}

fn has_open_phase(surface: &Surface) -> bool {
    has_waves(surface) && matches!(surface, Surface::Sinusoid { phase_deg: 0.0, .. })
}

fn has_waves(surface: &Surface) -> bool {
    match surface {
        Surface::Sinusoid { amplitude_m, .. } => *amplitude_m > 0.0 && surface.varies_along_x(),
        Surface::Smooth {} | Surface::Random(_) | Surface::HeightMap { .. } => false,
    }
}

fn other_flow(oil: &mut Lubricant) {
    oil.eyring_flow = match oil.eyring_flow {
        EyringFlow::Secant => EyringFlow::AlongAcross,
        EyringFlow::AlongAcross => EyringFlow::Secant,
    };
}

fn half(oil: &mut Lubricant) {
    oil.eyring_stress_pa /= 2.0;
}

fn twice(oil: &mut Lubricant) {
    oil.eyring_stress_pa *= 2.0;
}

/// That of a run which begins and ends as one of the `ladder` does on its first mesh. `None`: it does not get through, or somebody
/// said stop.
fn life(ladder: &Ladder, scene: &Scene, stop: &AtomicBool) -> Option<f64> {
    let mesh = Mesh {
        scene: Arc::new(scene.clone()),
        plan: Plan::new(scene).ok()?,
    };
    let mut sim = ladder.simulation(&mesh, None, 1).ok()?;
    while !sim.is_done() && !sim.has_settled() {
        sim.step().ok()?;
        if stop.load(Ordering::Relaxed) {
            return None;
        }
    }
    sim.summary().life_relative
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_is_that_of_the_ratios_and_holds_what_the_mesh_is_off() {
        let range = AssumedRange::of(&[Some(0.5), Some(0.25), Some(0.75)]).expect("all there");
        let [low, high] = range.of_life(0.4);
        assert!((low - 0.2).abs() < 1e-12 && (high - 0.6).abs() < 1e-12);
        // The mesh is off by 0.5/0.4.
        let [low, high] = range.of_band(0.4, [0.36, 0.44]);
        assert!(
            (low - 0.36 * 0.5 / 1.25).abs() < 1e-12 && (high - 0.44 * 1.5 * 1.25).abs() < 1e-12
        );
        // Its own choice is one of them.
        let above = AssumedRange::of(&[Some(0.5), Some(0.75)]).expect("all there");
        assert_eq!(above.of_life(1.0), [1.0, 1.5]);
    }

    #[test]
    fn what_cannot_be_compared_has_no_range() {
        let none: [&[Option<f64>]; 5] = [
            &[],
            &[None, Some(1.0)],
            &[Some(1.0), None],
            &[Some(0.0), Some(1.0)],
            &[Some(f64::INFINITY), Some(1.0)],
        ];
        for lives in none {
            assert_eq!(AssumedRange::of(lives), None, "{lives:?}");
        }
    }
}
