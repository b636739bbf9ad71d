//! Cycles that material points count in a rippled Hertz pressure, against kinematics.
//!
//! ```text
//! p = √(1 − x²) (1 + cos 2π(x − U₂ t)/W)      f δ = 2 |U₂ − U₁|/(W U₁)  crests pass a point of body 1
//! ```
//! Full ripples, so that every crest counts; the crest that the edge of the contact cuts counts in 0.6 of all
//! phases (`tests/life/integrals.rs`), so that the count lies between f δ and 1 + f δ. The error is that against the finest sampling.

use std::f64::consts::TAU;

use super::row::{AccuracyRow, Against, StudiedPart, Varied, against_finest, timed};
use asperity_engine::solve::material::{Line, MaterialTracker, TrackerSpec};

const SPEEDS: (f64, f64) = (1.0, 2.0);
const WAVELENGTH: f64 = 0.1;
const NODES: usize = 1025;

/// Counts by samples a crest, the most last.
pub(super) fn counted(samples: &[usize]) -> Vec<AccuracyRow> {
    let mut rows: Vec<AccuracyRow> = samples
        .iter()
        .map(|&samples| {
            let ((count, steps), time) = timed(|| count(samples));
            AccuracyRow {
                part: StudiedPart::CountedCycles,
                quantity: "cycles a crossing",
                varied: Varied::Samples,
                setting: samples as f64,
                fixed: format!("f delta {:.0}", crests()),
                value: Some(count),
                error: 0.0,
                against: Against::Finest,
                order: None,
                seconds: time.seconds,
                runs: time.runs,
                threads: 1,
                work: steps,
                work_unit: "steps",
                bytes: None,
                front: false,
            }
        })
        .collect();
    against_finest(&mut rows);
    rows
}

/// f δ.
pub(super) fn crests() -> f64 {
    2.0 * (SPEEDS.1 - SPEEDS.0) / (WAVELENGTH * SPEEDS.0)
}

fn count(samples: usize) -> (f64, u64) {
    let dt = WAVELENGTH / (samples as f64 * (SPEEDS.1 - SPEEDS.0));
    let dx = 4.0 / (NODES - 1) as f64;
    let mut spec = TrackerSpec::new((-2.0, 2.0), 0, 9.3);
    spec.points = 64;
    let mut tracker = MaterialTracker::new(spec);
    let mut pressure = vec![0.0_f32; NODES];
    let steps = (2.2 * 4.0 / (SPEEDS.0 * dt)) as u64;
    for step in 0..steps {
        let travelled = SPEEDS.1 * step as f64 * dt;
        for (i, p) in pressure.iter_mut().enumerate() {
            let x = dx * i as f64 - 2.0;
            let ripple = 1.0 + (TAU * (x - travelled) / WAVELENGTH).cos();
            *p = ((1.0 - x * x).max(0.0).sqrt() * ripple) as f32;
        }
        let line = Line {
            x_first: -2.0,
            dx,
            pressure: &pressure,
            tau_xz: None,
            effective: None,
        };
        tracker.step(SPEEDS.0 * dt, &line);
    }
    (
        tracker.pressure_cycles().map_or(0.0, |cycles| cycles.count),
        steps,
    )
}
