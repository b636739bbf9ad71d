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

    /// Life of the smooth contact of the base scene. `None`: no case has any, or the base scene's own start-up fails.
    pub(super) fn smooth_life(&self, records: &[CaseRecord]) -> Option<f64> {
        let known = records
            .iter()
            .find_map(|record| record.summary.life_smooth)?;
        if !self.varies_the_smooth_contact() {
            return Some(known);
        }
        let scene = self.base_scene().ok()?;
        let mut sim = Simulation::new(&scene, Plan::new(&scene).ok()?, 1).ok()?;
        while sim.life_smooth().is_none() && sim.passage_steps() == 0 {
            sim.step().ok()?;
        }
        sim.life_smooth()
    }
}
