//! A scene that moves along a tooth: the path's knobs as scripted events, to be run and recorded.
//!
//! ```text
//! R fixed at the pitch point      U(t), S(t), w(t) = w_path R_C/R(s)   so that p_h(t) is the path's
//! ```
//! The radius is no knob, so it stays; the load is scaled so that the Hertz pressure is the path's own, and the
//! half-width is off by R_C/R (up to 2.2 at the very root of an FZG C pinion, within a quarter over most of the
//! tooth), which each caption says. Times are those of the mesh: one ride is one mesh of one pair of teeth.

use std::collections::BTreeMap;

use super::error::SweepError;
use super::path;
use super::spec::Sweep;
use asperity_engine::math::number::fixed;
use asperity_engine::scene::{Event, Record, Scene};

/// Pictures of a ride, about: fifteen a second of the twenty in which a long recording is played.
const PICTURES: f64 = 300.0;

impl Sweep {
    /// The ride along a `[gear]` path; `None` for other sweeps, and for a spectrum.
    ///
    /// # Errors
    /// [`SweepError::Case`] when a point of the path is no scene.
    pub fn ride(&self) -> Result<Option<Scene>, SweepError> {
        // Of a spectrum each step would be a ride.
        let times = path::column(&self.path, "time_s").filter(|_| self.loads().len() == 1);
        let Some(times) = times else {
            return Ok(None);
        };
        let scenes = (0..self.len())
            .map(|case| self.scene(case))
            .collect::<Result<Vec<_>, _>>()?;
        let pitch = scenes
            .iter()
            .min_by(|one, two| sliding(one).total_cmp(&sliding(two)));
        let Some(pitch) = pitch else {
            return Ok(None);
        };
        let radius_m = pitch.contact.rx_m;
        let load = |scene: &Scene| scene.force_n() * radius_m / scene.contact.rx_m;
        let mut ride = scenes[0].clone();
        ride.title = format!("{}: a ride on the contact", self.title);
        ride.about = format!(
            "One mesh of one pair of teeth in its own time. R stays at the pitch point's {radius_m:.3e} m, because no \
             knob turns a radius; loads are such that the Hertz pressure is that of the path. The half-width shown is \
             that of the tooth times the factor in each caption; film and life of a point of the tooth with its own R \
             are in the table of the sweep."
        );
        ride.contact.rx_m = radius_m;
        ride.load.force_n_per_m = Some(load(&scenes[0]));
        let half_m = ride.hertz().a_m;
        let mut way_m = 0.0;
        ride.events = Vec::new();
        for (k, (scene, &time_s)) in scenes.iter().zip(&times).enumerate() {
            if k > 0 {
                way_m += (time_s - times[k - 1]) * scenes[k - 1].motion.entrainment_m_s;
            }
            let share = self.path[k]
                .values
                .iter()
                .find(|(name, _)| *name == "load_share");
            let share = share.map_or(1.0, |(_, share)| *share);
            ride.events.push(Event {
                at_s: time_s,
                set: BTreeMap::from([
                    ("load.force_n_per_m".to_owned(), load(scene)),
                    ("motion.entrainment_m_s".to_owned(), scene.motion.entrainment_m_s),
                    ("motion.slide_roll".to_owned(), scene.motion.slide_roll),
                ]),
                caption: format!(
                    "{} mm from A: S = {:.2}, U = {:.2} m/s, {:.2} GPa, {} the load on this pair; half-width {:.2} \
                     times the tooth's",
                    fixed(self.path[k].values[0].1 * 1e3, 1),
                    scene.motion.slide_roll,
                    scene.motion.entrainment_m_s,
                    scene.hertz().p_max_pa * 1e-9,
                    if share == 1.0 { "all" } else { "part of" },
                    radius_m / scene.contact.rx_m
                ),
            });
        }
        let passages = way_m / (4.0 * half_m) + 1.0;
        ride.time.passages = Some(passages);
        // A domain is about 4 a long.
        let steps = passages * ride.grid.nodes as f64 / ride.time.step_nodes;
        ride.record = Some(Record {
            every_steps: (steps / PICTURES).ceil().max(1.0) as usize,
            ..Record::default()
        });
        ride.tooth = self.tooth;
        Ok(Some(ride))
    }
}

fn sliding(scene: &Scene) -> f64 {
    scene.motion.slide_roll.abs()
}
