//! The one smooth contact with which all lives of a sweep are compared: that of its base scene.
//!
//! ```text
//! load_factor = N_smooth(case)/N_smooth(base)          N_smooth: Summary::life_smooth
//! life_common = life_relative load_factor
//! ```
//! A case's `life_relative` is relative to its own smooth contact, which has another life wherever load, speed, radius or
//! oil are another's: of two cases the one with the higher load may well have the higher relative life.

use super::case::CaseRecord;
use super::spec::Sweep;
use asperity_engine::plan::Plan;
use asperity_engine::scene::Scene;
use asperity_engine::sim::Simulation;

impl Sweep {
    /// Whether something varies that the smooth contact depends on.
    pub(super) fn varies_the_smooth_contact(&self) -> bool {
        let is_of_roughness = |key: &str| {
            key == "motion.slide_roll"
                || ["body_1.surface.", "body_2.surface."]
                    .iter()
                    .any(|of| key.starts_with(of))
        };
        !self.axes.iter().all(|axis| is_of_roughness(&axis.key))
    }

    /// Whether something varies that a calibration point takes for its own: radii or elastic constants.
    fn varies_the_calibrated_contact(&self) -> bool {
        let is_of_it = |key: &str| {
            key.starts_with("contact.")
                || [".young_pa", ".poisson"]
                    .iter()
                    .any(|end| key.ends_with(end))
        };
        self.axes.iter().any(|axis| is_of_it(&axis.key))
    }

    /// Compares all lives of these cases with the smooth contact of the base scene. Where radii or materials vary the cycles are
    /// those of a calibration point of the base scene's, one for all: each case's own would say nothing of its size.
    pub(super) fn to_common(&self, records: &mut [CaseRecord]) {
        let base = self.smooth_base(records);
        for CaseRecord { summary, .. } in records {
            let own = summary.life_smooth;
            summary.load_factor = own.zip(base.life).map(|(own, base)| own / base);
            let lives = summary.life_relative.zip(summary.load_factor);
            summary.life_common = lives.map(|(life, load)| life * load);
            let cycles = summary
                .life_common
                .zip(base.cycles)
                .map(|(life, base)| life * base);
            if let Some((cycles, before)) = cycles.zip(summary.life_cycles) {
                let band = [&mut summary.life_cycles_low, &mut summary.life_cycles_high];
                for end in band.into_iter().flatten() {
                    *end *= cycles / before;
                }
                summary.life_cycles = Some(cycles);
            }
        }
    }

    /// The smooth contact of the base scene.
    fn smooth_base(&self, records: &[CaseRecord]) -> SmoothBase {
        let known = records.iter().find_map(|record| record.summary.life_smooth);
        if known.is_none() || !self.varies_the_smooth_contact() {
            let (life, cycles) = (known, None);
            return SmoothBase { life, cycles };
        }
        let Some(sim) = self.base_scene().ok().and_then(|scene| started(&scene)) else {
            return SmoothBase::default();
        };
        SmoothBase {
            life: sim.life_smooth(),
            cycles: sim
                .smooth_cycles()
                .filter(|_| self.varies_the_calibrated_contact()),
        }
    }
}

/// What is known of the smooth contact of the base scene.
#[derive(Debug, Clone, Copy, Default)]
struct SmoothBase {
    /// As [`asperity_engine::sim::Summary::life_smooth`] has it.
    life: Option<f64>,
    /// Loading cycles by its calibration point; `None`: each case's own is the same, or there is none.
    cycles: Option<f64>,
}

/// A scene's start-up up to its smooth reference; `None`: it fails.
fn started(scene: &Scene) -> Option<Simulation> {
    let mut sim = Simulation::new(scene, Plan::new(scene).ok()?, 1).ok()?;
    while sim.life_smooth().is_none() && sim.passage_steps() == 0 {
        sim.step().ok()?;
    }
    Some(sim)
}
