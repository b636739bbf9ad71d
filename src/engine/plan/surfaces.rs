//! What the grid and the time step make of the waves on each body.

use std::f64::consts::FRAC_PI_2;

use super::{Plan, PlanError, Warning};
use crate::math::number::{apart, fixed};
use crate::physics::cycles::speed_ratios;
use crate::physics::felt::felt;
use crate::scene::{Doubt, Scene, Surface};

/// The waves of one body on the grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WavePlan {
    /// A, m.
    pub amplitude_m: f64,
    /// Nodes of one wavelength along x and along y, of a height map the shortest significant one;
    /// infinite where the surface does not vary.
    pub nodes: [f64; 2],
    /// Crests per metre along x, f = 1/Wx, of a height map the upcrossings of its level, 1/m.
    pub crests_per_m: f64,
    /// Pressure per amplitude that flattens it, Pa/m.
    pub flattening_pa_per_m: f64,
    /// Crests (of a height map: shortest waves) that pass a fixed place in one time step.
    pub crests_per_step: f64,
}

impl WavePlan {
    /// How much a contact of that Hertz pressure feels of the crests at that amplitude, 0 to 1. What has no crests along x
    /// but varies is felt.
    pub fn felt(&self, amplitude_m: f64, p_hertz_pa: f64) -> f64 {
        if self.flattening_pa_per_m == 0.0 {
            return 1.0;
        }
        felt(self.flattening_pa_per_m * amplitude_m.abs() / p_hertz_pa)
    }

    /// Widest gap between the phases in which `n` looks at a fixed place, `every` steps apart, meet the wave, in
    /// waves; 0 for a wave that does not pass.
    pub(super) fn widest_gap(&self, every: u64, n: u64) -> f64 {
        if self.crests_per_step == 0.0 || n == 0 {
            return 0.0;
        }
        let mut phases: Vec<f64> = (0..n)
            .map(|look| (look as f64 * every as f64 * self.crests_per_step).fract())
            .collect();
        phases.sort_by(f64::total_cmp);
        let around = 1.0 - phases[phases.len() - 1] + phases[0];
        let gaps = phases.windows(2).map(|pair| pair[1] - pair[0]);
        gaps.fold(around, f64::max)
    }
}

/// What is doubtful of the surfaces of a scene whose contact has that half-width, the narrower one.
pub(super) fn doubts(scene: &Scene, half_width_m: f64) -> impl Iterator<Item = Warning> {
    let of = move |surface: &Surface, body: u8| {
        let amplitude = Doubt::of_amplitude(surface.amplitude_m(), half_width_m);
        let all = std::iter::once(amplitude).chain(surface.map_doubts());
        let warning = move |doubt| Warning::Surface { body, doubt };
        all.flatten().map(warning).collect::<Vec<_>>()
    };
    let [one, two] = scene.surfaces();
    of(one, 1).into_iter().chain(of(two, 2))
}

impl Plan {
    /// How far the waves of both bodies shift against each other over a distance of `length` (in a, at U) and along the
    /// contact, in waves: `|f_1 (1 − S/2) − f_2 (1 + S/2)| L + 2a |f_1 − f_2|`; from 1 on crests have met in all ways. `None`: a body
    /// has none along x. Ours: two waves beat.
    pub fn meetings(&self, slide_roll: f64, length: f64) -> Option<f64> {
        let [one, two] = self.waves.map(|wave| wave.map(|wave| wave.crests_per_m));
        let (one, two) = one.zip(two).filter(|(one, two)| *one > 0.0 && *two > 0.0)?;
        let [slower, faster] = speed_ratios(slide_roll);
        let passing = (one * slower - two * faster).abs() * length;
        Some((passing + 2.0 * (one - two).abs()) * self.hertz.a_m)
    }
}

/// Fewest nodes of a wave: below it the sampled wave is not the one that was asked for.
const NODES_MIN: f64 = 4.0;
/// The waves of both bodies; `spacing_m` along x and y, `step_m` the distance travelled at U in a time step.
pub(super) fn plan(
    scene: &Scene,
    spacing_m: [f64; 2],
    step_m: f64,
) -> Result<[Option<WavePlan>; 2], PlanError> {
    let mut waves = [None, None];
    for (index, surface) in scene.surfaces().into_iter().enumerate() {
        if surface.is_smooth() {
            continue;
        }
        check_resolved(index as u8 + 1, surface, spacing_m)?;
        let [k_x, k_y] = surface.wavenumbers_per_m();
        let nodes = [1.0 / (k_x * spacing_m[0]), 1.0 / (k_y * spacing_m[1])];
        let speed_ratio = (scene.speeds_m_s()[index] / scene.motion.entrainment_m_s).abs();
        waves[index] = Some(WavePlan {
            amplitude_m: surface.amplitude_m(),
            nodes,
            crests_per_m: surface.crests_per_m(),
            flattening_pa_per_m: FRAC_PI_2 * scene.e_prime_pa() * surface.crests_per_m(),
            crests_per_step: k_x * speed_ratio * step_m,
        });
    }
    Ok(waves)
}

fn check_resolved(body: u8, surface: &Surface, spacing_m: [f64; 2]) -> Result<(), PlanError> {
    let [k_x, k_y] = surface.wavenumbers_per_m();
    let nodes = (1.0 / (k_x * spacing_m[0])).min(1.0 / (k_y * spacing_m[1]));
    if nodes >= NODES_MIN {
        return Ok(());
    }
    let &Surface::Sinusoid {
        wavelength_x_m,
        wavelength_y_m,
        ..
    } = surface
    else {
        let wave_m = (1.0 / k_x).min(1.0 / k_y);
        let carries = |[k_x, k_y]: [f64; 2]| {
            (1.0 / (k_x * spacing_m[0])).min(1.0 / (k_y * spacing_m[1])) >= NODES_MIN
        };
        let (key, value, cure) = match surface {
            Surface::Random(random) => (
                "cutoff_short_m",
                format!("{:e} m: the", random.cutoff_short_m()),
                "a longer cut-off".to_owned(),
            ),
            Surface::Smooth {} | Surface::Sinusoid { .. } | Surface::HeightMap { .. } => {
                let cure = surface.blame(carries);
                let cure = cure.unwrap_or_else(|| "smooth the map".to_owned());
                ("file", "a map whose".to_owned(), cure)
            }
        };
        return Err(PlanError::Refused {
            key: format!("body_{body}.surface.{key}"),
            value: format!("{value} shortest significant wave is {wave_m:.3e} m"),
            allowed: format!(
                "waves of at least 4 nodes (now {} on a spacing of {} by {} µm): {cure}, or use more grid.nodes",
                fixed(nodes, 1),
                fixed(spacing_m[0] * 1e6, 2),
                fixed(spacing_m[1] * 1e6, 2),
            ),
        });
    };
    // The key to change is the wave that varies fastest in the coarse direction: without a turn, the
    // wave along that axis.
    let coarse_along_x = k_x * spacing_m[0] >= k_y * spacing_m[1];
    let alone = |wavelength_m: f64, axis: usize| wavelength_m / spacing_m[axis] < NODES_MIN;
    let (name, value_m) = if wavelength_y_m.is_infinite() {
        ("wavelength_x_m", wavelength_x_m)
    } else if wavelength_x_m.is_infinite() {
        ("wavelength_y_m", wavelength_y_m)
    } else if coarse_along_x && (alone(wavelength_x_m, 0) || !alone(wavelength_y_m, 0)) {
        ("wavelength_x_m", wavelength_x_m)
    } else {
        ("wavelength_y_m", wavelength_y_m)
    };
    let least_m = value_m * NODES_MIN / nodes;
    // Rounded down it might allow what is refused.
    let least = apart(least_m, value_m, 3, |m, digits| format!("{m:.digits$e}"));
    let nodes = apart(nodes, NODES_MIN, 1, |n, digits| format!("{n:.digits$}"));
    Err(PlanError::Refused {
        key: format!("body_{body}.surface.{name}"),
        value: format!("{value_m:e} m"),
        allowed: format!(
            "at least {least} m (4 nodes; now {nodes} on a spacing of {} by {} µm), or more grid.nodes",
            fixed(spacing_m[0] * 1e6, 2),
            fixed(spacing_m[1] * 1e6, 2),
        ),
    })
}
