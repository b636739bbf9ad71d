//! What creeps over many steps of a passage that should repeat itself.
//!
//! ```text
//! drift = slope of the windows' means × length / mean          least squares over windows of 4 a
//! ```
//! Of four sums that a scheme which loses or gains something shows: ∬p (the load), ∬p² (as the elastic energy
//! goes), the oil under the Hertz ellipse ∬h, and the power of friction μ w U|S|. The standard error of the slope
//! stands beside it: windows do not hold whole periods, so their means scatter.

use super::super::{planned, scene_with};
use asperity_engine::scene::presets;
use asperity_engine::sim::{Frame, Simulation, Stage};

/// Names of the sums.
const SUMS: [&str; 4] = ["load", "p²", "oil", "friction power"];

/// A long run.
#[derive(Debug, Clone, PartialEq)]
pub struct Drift {
    /// Nodes per side.
    pub nodes: usize,
    /// Steps.
    pub steps: u64,
    /// Steps that did not converge.
    pub unconverged: u64,
    /// Worst load error.
    pub load_error: f64,
    /// Worst mass error.
    pub mass_error: f64,
    /// Relative drift over the whole run, and its standard error.
    pub drifts: [(f64, f64); 4],
    /// Why it ended early.
    pub failure: Option<String>,
}

impl Drift {
    /// Whether all steps converged and no sum creeps: beyond 0.1 %, and beyond three standard errors, which must be small
    /// enough that a creep could be seen. Without a step there is nothing that could creep.
    pub fn is_steady(&self) -> bool {
        /// Three standard errors of this hide no more than 3 %.
        const SEEN: f64 = 1e-2;
        let creeps = |(drift, error): &(f64, f64)| {
            (drift.abs() > 1e-3 && drift.abs() > 3.0 * error) || error.is_nan() || *error > SEEN
        };
        let looked = self.steps > 0 || self.failure.is_some();
        self.failure.is_none()
            && self.unconverged == 0
            && !(looked && self.drifts.iter().any(creeps))
    }

    /// In a few lines.
    pub fn text(&self) -> String {
        let parts: Vec<String> = SUMS
            .iter()
            .zip(self.drifts)
            .map(|(name, (drift, error))| format!("{name} {drift:+.1e} ± {error:.0e}"))
            .collect();
        format!(
            "{} steps on {n}²: {}; {} steps not converged, worst load error {:.0e}, worst mass error {:.0e}{}",
            self.steps,
            parts.join(", "),
            self.unconverged,
            self.load_error,
            self.mass_error,
            self.failure
                .as_ref()
                .map_or(String::new(), |reason| format!("; ended early: {reason}")),
            n = self.nodes,
        )
    }
}

/// The default scene, both bodies rough and sliding, for `steps` steps.
///
/// # Errors
/// When the study's own scene is refused.
pub(super) fn long_run(
    nodes: usize,
    steps: u64,
    keys: &[String],
    heard: &mut dyn FnMut(u64),
) -> Result<Drift, String> {
    // 8 nodes a wave whatever the grid.
    let wavelength_m = 8.0 * SPAN_M / (nodes - 1) as f64;
    let mut sets = vec![
        format!("grid.nodes={nodes}"),
        "stress=none".to_owned(),
        "life=none".to_owned(),
        "record=none".to_owned(),
        format!("body_1.surface.wavelength_x_m={wavelength_m:e}"),
        format!("body_2.surface.wavelength_x_m={wavelength_m:e}"),
        format!("body_2.surface.wavelength_y_m={wavelength_m:e}"),
    ];
    sets.extend_from_slice(keys);
    let (scene, plan) = planned(scene_with(presets::QUICK, &sets)?)?;
    let window = plan.steps_per_passage;
    let mut sim = Simulation::new(&scene, plan, 1).map_err(|error| error.to_string())?;
    let mut frame = Frame::default();
    let mut drift = Drift {
        nodes,
        steps: 0,
        unconverged: 0,
        load_error: 0.0,
        mass_error: 0.0,
        drifts: [(0.0, 0.0); 4],
        failure: None,
    };
    let mut means: Vec<[f64; 4]> = Vec::new();
    let mut sums = [0.0; 4];
    // The first window still holds what is left of the start-up.
    let mut skipped = 0;
    while drift.steps < steps {
        if let Err(error) = sim.step() {
            drift.failure = Some(error.to_string());
            break;
        }
        if sim.stage() != Stage::Passage || skipped < window {
            skipped += u64::from(sim.stage() == Stage::Passage);
            continue;
        }
        sim.fill(&mut frame);
        drift.steps += 1;
        let metrics = sim.metrics();
        drift.unconverged += u64::from(!metrics.converged);
        drift.load_error = drift.load_error.max(metrics.load_error);
        drift.mass_error = drift.mass_error.max(metrics.mass_error);
        for (sum, now) in sums.iter_mut().zip(looked_at(&frame)) {
            *sum += now / window as f64;
        }
        if drift.steps.is_multiple_of(window) {
            means.push(std::mem::take(&mut sums));
            heard(drift.steps);
        }
    }
    drift.drifts = std::array::from_fn(|k| trend(&means.iter().map(|m| m[k]).collect::<Vec<_>>()));
    Ok(drift)
}

/// Length of the default scene's domain, m: 4 a.
const SPAN_M: f64 = 1.89e-3;

fn looked_at(frame: &Frame) -> [f64; 4] {
    let mut sums = [0.0; 4];
    let metrics = &frame.metrics;
    for (n, (&p, &h)) in frame.pressure_pa.iter().zip(&frame.film_m).enumerate() {
        let (p, h) = (f64::from(p), f64::from(h));
        let x = (frame.x_min_m + (n % frame.nx) as f64 * frame.dx_m) / frame.a_m;
        let y = (frame.y_min_m + (n / frame.nx) as f64 * frame.dy_m) / frame.b_m;
        sums[0] += p;
        sums[1] += p * p;
        if x * x + y * y < 1.0 {
            sums[2] += h;
        }
    }
    let slip_m_s = metrics.entrainment_m_s * metrics.slide_roll.abs();
    sums[3] = metrics.friction_coefficient * metrics.load_n * slip_m_s;
    sums
}

/// Slope times length over mean, and its standard error.
fn trend(means: &[f64]) -> (f64, f64) {
    let n = means.len() as f64;
    if means.len() < 3 {
        return (0.0, f64::INFINITY);
    }
    let mean = means.iter().sum::<f64>() / n;
    let middle = 0.5 * (n - 1.0);
    let spread: f64 = (0..means.len()).map(|i| (i as f64 - middle).powi(2)).sum();
    let moment = |i: usize| (i as f64 - middle) * (means[i] - mean);
    let slope = (0..means.len()).map(moment).sum::<f64>() / spread;
    let rest = |i: usize| (means[i] - mean - slope * (i as f64 - middle)).powi(2);
    let scatter = (0..means.len()).map(rest).sum::<f64>() / (n - 2.0);
    let length = n - 1.0;
    let scale = length / mean.abs().max(f64::MIN_POSITIVE);
    (slope * scale, (scatter / spread).sqrt() * scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_creep_is_seen_and_noise_is_not() {
        let noise = |i: usize| 0.01 * ((i * 7919 % 13) as f64 - 6.0) / 6.0;
        let level: Vec<f64> = (0..100).map(|i| 5.0 * (1.0 + noise(i))).collect();
        let (drift, error) = trend(&level);
        assert!(drift.abs() < 3.0 * error, "{drift} {error}");
        let creeping: Vec<f64> = (0..100)
            .map(|i| 5.0 * (1.0 + noise(i) + 0.02 * i as f64 / 99.0))
            .collect();
        let (drift, error) = trend(&creeping);
        assert!(
            (drift - 0.02).abs() < 3.0 * error && error < 0.005,
            "{drift} {error}"
        );
        let steady = |drifts| Drift {
            nodes: 33,
            steps: 100,
            unconverged: 0,
            load_error: 0.0,
            mass_error: 0.0,
            drifts,
            failure: None,
        };
        assert!(steady([(2e-2, 9e-3); 4]).is_steady());
        // A run too short, or too noisy, to show a creep is no proof that there is none.
        assert!(!steady([(0.0, f64::INFINITY); 4]).is_steady());
        assert!(!steady([(0.0, 0.1); 4]).is_steady());
        assert!(!steady([(1e-2, 1e-3); 4]).is_steady());
    }
}
