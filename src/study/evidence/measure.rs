//! One case on one grid: the run, and the values that its rows compare.

use std::f64::consts::TAU;

use rustfft::num_complex::Complex;

use super::dent::dent;
use super::fit::{FittedWaves, read};
use super::set::{EvidenceCase, Measure, Values, planned};
use asperity_engine::physics::film_ripple::FlatFilm;
use asperity_engine::plan::Plan;
use asperity_engine::scene::{Order, Scene, Surface};
use asperity_engine::sim::{Simulation, Summary};

/// Reach of the rows that are read, a: waves alone, two waves (both of a length or longer), a low ripple.
const WAVE_REACH: f64 = 0.25;
const TWO_REACH: f64 = 0.5;
const RIPPLE_REACH: f64 = 0.6;

/// Name of 2^q − 1, by which the error of order q shrinks from grid to grid, less one.
pub(super) const SHRINKING: &str = "2^q - 1";

/// A case on `nodes` per side, in the domain of the grid of `finest` nodes.
pub(super) fn measure(case: &EvidenceCase, nodes: usize, finest: usize) -> Result<Values, String> {
    let (scene, plan) = on_grid(&case.scene, &case.set, nodes, finest)?;
    let shrinking = match plan.order {
        Order::Second => 3.0,
        Order::High => 7.0,
    };
    let mut values = match case.measure {
        Measure::Stress => stress(&scene, plan),
        Measure::Smooth => smooth(&scene, plan),
        Measure::Wave => wave(&scene, &plan),
        Measure::TwoWaves => two_waves(&scene, &plan),
        Measure::Hooke => hooke(&scene, &plan),
        Measure::Dent => dent(&scene, plan),
    }?;
    values.push((SHRINKING, shrinking));
    Ok(values)
}

/// A scene of evidence on `nodes`, in the domain that the plan chooses on `finest`.
pub(super) fn on_grid(
    scene: &str,
    set: &[String],
    nodes: usize,
    finest: usize,
) -> Result<(Scene, Plan), String> {
    let with = |nodes: usize| {
        let mut sets = set.to_vec();
        sets.push(format!("grid.nodes={nodes}"));
        sets.push("numerics.error_estimate=none".to_owned());
        planned(scene, &sets)
    };
    let domain = with(finest)?.1.domain;
    let (mut scene, _) = with(nodes)?;
    scene.grid.x_min_a = Some(domain.x_min_a);
    scene.grid.x_max_a = Some(domain.x_max_a);
    if scene.contact.ry_m.is_some() {
        scene.grid.y_half_a = Some(domain.y_half_b);
    }
    let plan = Plan::new(&scene).map_err(|error| error.to_string())?;
    Ok((scene, plan))
}

/// Runs to the end; every step must converge.
pub(super) fn run(scene: &Scene, plan: Plan) -> Result<Summary, String> {
    let mut sim = Simulation::new(scene, plan, 1).map_err(|error| error.to_string())?;
    while !sim.is_done() {
        sim.step().map_err(|error| error.to_string())?;
    }
    let summary = sim.summary();
    if summary.converged {
        Ok(summary)
    } else {
        let failed = summary.steps_not_converged;
        Err(format!("{failed} steps did not converge"))
    }
}

fn stress(scene: &Scene, plan: Plan) -> Result<Values, String> {
    let s = run(scene, plan)?;
    let over = |value: Option<f64>, unit: f64| value.map_or(f64::NAN, |value| value / unit);
    Ok(vec![
        ("p_max", s.p_max_pa / s.p_hertz_pa),
        ("von_mises", over(s.sigma_eff_max_pa, s.p_hertz_pa)),
        ("depth", over(s.sigma_eff_max_depth_m, s.a_m)),
    ])
}

fn smooth(scene: &Scene, plan: Plan) -> Result<Values, String> {
    let s = run(scene, plan)?;
    Ok(vec![
        ("h_central", 1e9 * s.h_central_m),
        ("h_min", 1e9 * s.h_min_m),
    ])
}

/// Length and amplitude of the wave of body 1, m.
fn wave_of(scene: &Scene) -> Result<(f64, f64), String> {
    match scene.body_1.surface {
        Surface::Sinusoid {
            amplitude_m,
            wavelength_x_m,
            ..
        } => Ok((wavelength_x_m, amplitude_m)),
        Surface::Smooth {} | Surface::Random(_) | Surface::HeightMap { .. } => {
            Err("body 1 has no wave".to_owned())
        }
    }
}

fn wave(scene: &Scene, plan: &Plan) -> Result<Values, String> {
    let (wave_m, amplitude_m) = wave_of(scene)?;
    let omega = TAU / wave_m * scene.speeds_m_s()[0];
    let read = read(scene, plan, omega, WAVE_REACH)?;
    let sum: f64 = read.film.iter().map(|z| z.norm()).sum();
    Ok(vec![("left", sum / read.film.len() as f64 / amplitude_m)])
}

fn two_waves(scene: &Scene, plan: &Plan) -> Result<Values, String> {
    let (wave_m, amplitude_m) = wave_of(scene)?;
    let body_m_s = scene.speeds_m_s()[0];
    let k = TAU / wave_m;
    let read = read(scene, plan, k * body_m_s, TWO_REACH)?;
    let bound = k * plan.hertz.a_m;
    let waves = FittedWaves {
        bound,
        other: Complex::new(bound * body_m_s / scene.motion.entrainment_m_s, 0.0),
        grows: false,
    };
    let [left, convected] = waves.fit(&read.x_a, &read.film).0;
    Ok(vec![
        ("left", left.norm() / amplitude_m),
        ("convected", convected.norm() / amplitude_m),
    ])
}

/// The low ripple of the slower body and its pressure, and the closed form with the mean film found and the viscosity that
/// the flow along x meets at the mean pressure and stress found.
fn hooke(scene: &Scene, plan: &Plan) -> Result<Values, String> {
    let (wave_m, amplitude_m) = wave_of(scene)?;
    let oil = scene.lubricant.as_ref().ok_or("no oil")?;
    let body_m_s = scene.speeds_m_s()[0];
    let k = TAU / wave_m;
    let read = read(scene, plan, k * body_m_s, RIPPLE_REACH)?;
    let (a_m, p_h) = (plan.hertz.a_m, plan.hertz.p_max_pa);
    let share = read.pressure_pa / p_h;
    let (eta_0, alpha) = (oil.viscosity_pa_s(), oil.pressure_viscosity_per_pa());
    let viscosity = eta_0
        * oil
            .viscosity_law
            .scaled(eta_0, alpha, p_h)
            .ln_eta(share)
            .0
            .exp();
    let sliding_m_s = (scene.motion.slide_roll * scene.motion.entrainment_m_s).abs();
    let sigma = (viscosity * sliding_m_s / (oil.eyring_stress_pa * read.film_m)).asinh();
    let (rho, slope) = oil.density_law.scaled(p_h).rho(share);
    let flat = FlatFilm {
        e_prime_pa: scene.e_prime_pa(),
        film_m: read.film_m,
        viscosity_pa_s: viscosity / sigma.cosh(),
        compressibility_per_pa: slope / rho / p_h,
        entrainment_m_s: scene.motion.entrainment_m_s,
    };
    let waves = FittedWaves {
        bound: k * a_m,
        other: flat.convected(wave_m, body_m_s) * a_m,
        grows: true,
    }
    .best(&read.x_a, &read.film);
    let film = waves.fit(&read.x_a, &read.film).0[0];
    let pressure = waves.fit(&read.x_a, &read.pressure).0[0];
    let dry_pa = 0.25 * scene.e_prime_pa() * k * amplitude_m;
    Ok(vec![
        ("left", film.norm() / amplitude_m),
        ("pressure", pressure.norm() / dry_pa),
        ("closed left", flat.left(wave_m, body_m_s).norm()),
        ("closed pressure", flat.pressure_share(wave_m, body_m_s)),
    ])
}
