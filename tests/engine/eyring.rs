//! Eyring oil whose fluidity has a direction: low ripples on gears' line contacts against closed forms.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::TAU;

use asperity::physics::film_ripple::FlatFilm;
use asperity::physics::fluid::{Density, Viscosity, eyring_across, eyring_along};
use asperity::plan::Plan;
use asperity::scene::{Override, Scene};
use asperity::sim::{Frame, Simulation};
use rustfft::num_complex::Complex;

/// Ripple, m: so low against films of 140 nm and more that what is left is linear in it.
const AMPLITUDE_M: f64 = 4e-9;
/// Where the ripple is read, in a: the flat of the contact, the same on both sides of its centre.
const WINDOW: std::ops::RangeInclusive<f64> = -0.6..=0.6;
/// Periods of the ripple that are read.
const PERIODS: f64 = 4.0;

/// An operating point of the FZG gear C: radius, entrainment, S, load.
struct Gear {
    name: &'static str,
    rx_m: f64,
    entrainment_m_s: f64,
    slide_roll: f64,
    load_n_per_m: f64,
}

const B: Gear = Gear {
    name: "FZG B",
    rx_m: 0.00732,
    entrainment_m_s: 2.1,
    slide_roll: 0.44,
    load_n_per_m: 4.22e5,
};

const A: Gear = Gear {
    name: "FZG A",
    rx_m: 0.00377,
    entrainment_m_s: 1.94,
    slide_roll: 1.3,
    load_n_per_m: 2.11e5,
};

/// How the flow sees sheared oil: key, and function of σ for the closed form.
type Form = (&'static str, fn(f64) -> (f64, f64));
const ALONG: Form = ("along_across", eyring_along);
const SECANT: Form = ("secant", eyring_across);

impl Gear {
    /// A ripple on body 1, the slower one; body 2 smooth.
    fn scene(&self, wave_m: f64, flow: &str) -> Scene {
        let text = format!(
            r#"
[contact]
kind = "line"
rx_m = {}
[body_1]
young_pa = 2.0566e11
poisson = 0.3
[body_1.surface]
kind = "sinusoid"
amplitude_m = {AMPLITUDE_M}
wavelength_x_m = {wave_m}
wavelength_y_m = inf
[body_2]
young_pa = 2.0566e11
poisson = 0.3
[lubricant]
viscosity_pa_s = 0.0133
pressure_viscosity_per_pa = 2.05e-8
rheology = "eyring"
eyring_flow = "{flow}"
[motion]
entrainment_m_s = {}
slide_roll = {}
[load]
force_n_per_m = {}
[grid]
nodes = 1025
[numerics]
tolerance = 1e-6
"#,
            self.rx_m, self.entrainment_m_s, self.slide_roll, self.load_n_per_m
        );
        Scene::from_toml(&text).unwrap()
    }
}

/// What moves with one frequency at the nodes of the window, and the means over them.
struct Read {
    x_m: Vec<f64>,
    film: Vec<Complex<f64>>,
    pressure: Vec<Complex<f64>>,
    film_m: f64,
    pressure_pa: f64,
    newton_a_step: f64,
    krylov_a_step: f64,
}

/// Marches `scene` and takes the harmonic of frequency ω: f = Re z e^{−iωt}, by sums under a Hann window.
fn read(scene: &Scene, omega: f64) -> Read {
    let plan = Plan::new(scene).unwrap();
    let dt = plan.dt_s;
    let samples = (PERIODS * TAU / (omega * dt)).round() as usize;
    let mut sim = Simulation::new(scene, plan, 1).unwrap();
    let mut frame = Frame::default();
    sim.fill(&mut frame);
    let a_m = frame.a_m;
    let mut films: Vec<Vec<f64>> = Vec::new();
    let mut pressures: Vec<Vec<f64>> = Vec::new();
    let mut before = *sim.stats();
    while films.len() < samples {
        sim.step().unwrap();
        if sim.passage_steps() == 0 {
            before = *sim.stats();
            continue;
        }
        assert!(sim.metrics().converged);
        sim.fill(&mut frame);
        let row = |field: &[f32]| field[..frame.nx].iter().map(|&v| f64::from(v)).collect();
        films.push(row(&frame.film_m));
        pressures.push(row(&frame.pressure_pa));
    }
    let x = |i: usize| frame.x_min_m + frame.dx_m * i as f64;
    let inside: Vec<usize> = (0..frame.nx)
        .filter(|&i| WINDOW.contains(&(x(i) / a_m)))
        .collect();
    let window = |n: usize| 1.0 - (TAU * (n as f64 + 0.5) / samples as f64).cos();
    let mean = |rows: &[Vec<f64>], i: usize| {
        (0..samples).map(|n| window(n) * rows[n][i]).sum::<f64>() / samples as f64
    };
    let harmonic = |rows: &[Vec<f64>], i: usize| -> Complex<f64> {
        let mean = mean(rows, i);
        (0..samples)
            .map(|n| {
                let turned = Complex::from_polar(1.0, omega * dt * n as f64);
                turned * (2.0 * window(n) * (rows[n][i] - mean) / samples as f64)
            })
            .sum()
    };
    let over_window = |rows: &[Vec<f64>]| {
        let sum: f64 = inside.iter().map(|&i| mean(rows, i)).sum();
        sum / inside.len() as f64
    };
    let steps = (sim.stats().steps - before.steps) as f64;
    Read {
        x_m: inside.iter().map(|&i| x(i)).collect(),
        film: inside.iter().map(|&i| harmonic(&films, i)).collect(),
        pressure: inside.iter().map(|&i| harmonic(&pressures, i)).collect(),
        film_m: over_window(&films),
        pressure_pa: over_window(&pressures),
        newton_a_step: (sim.stats().newton_iterations - before.newton_iterations) as f64 / steps,
        krylov_a_step: (sim.stats().linear_iterations - before.linear_iterations) as f64 / steps,
    }
}

/// Waves of the fit: the bound one, x times it, the other one.
const WAVES: usize = 3;

/// `z = (α + α' x) e^{ikx} + β e^{ik'x}`: α and Σ|rest|², by least squares. The mean pressure's slope makes what is bound
/// grow along the contact by a term that is odd in x, and zero at the centre, where the closed form holds.
fn two_waves(
    x: &[f64],
    z: &[Complex<f64>],
    k: Complex<f64>,
    other: Complex<f64>,
) -> (Complex<f64>, f64) {
    let i = Complex::new(0.0, 1.0);
    let zero = Complex::new(0.0, 0.0);
    let length = x.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let waves = |x: f64| {
        let bound = (i * k * x).exp();
        [bound, bound * (x / length), (i * other * x).exp()]
    };
    let mut rows = [[zero; WAVES + 1]; WAVES];
    for (&x, &z) in x.iter().zip(z) {
        let waves = waves(x);
        for (row, wave) in rows.iter_mut().zip(waves) {
            for (sum, value) in row.iter_mut().zip(waves.into_iter().chain([z])) {
                *sum += wave.conj() * value;
            }
        }
    }
    // Gauss without a choice of pivots: the normal equations of three independent waves are positive definite.
    for n in 0..WAVES {
        let (above, below) = rows.split_at_mut(n + 1);
        let pivot = above[n];
        for row in below {
            let factor = row[n] / pivot[n];
            for (value, pivot) in row.iter_mut().zip(pivot) {
                *value -= factor * pivot;
            }
        }
    }
    let mut found = [zero; WAVES];
    for n in (0..WAVES).rev() {
        let known: Complex<f64> = (n + 1..WAVES).map(|m| rows[n][m] * found[m]).sum();
        found[n] = (rows[n][WAVES] - known) / rows[n][n];
    }
    let rest = |x: f64, z: Complex<f64>| {
        let sum: Complex<f64> = waves(x)
            .into_iter()
            .zip(found)
            .map(|(wave, a)| wave * a)
            .sum();
        (z - sum).norm_sqr()
    };
    (found[0], x.iter().zip(z).map(|(&x, &z)| rest(x, z)).sum())
}

/// The complex wavenumber of the other wave that leaves the least rest, from a first guess.
fn other_wave(x: &[f64], z: &[Complex<f64>], k: Complex<f64>, guess: Complex<f64>) -> Complex<f64> {
    let mut best = guess;
    let mut least = two_waves(x, z, k, best).1;
    let mut step = 0.2 * guess.norm();
    while step > 1e-5 * guess.norm() {
        let ways = [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)];
        let better = ways.iter().find_map(|&(re, im)| {
            let tried = best + Complex::new(re, im) * step;
            let rest = two_waves(x, z, k, tried).1;
            (rest < least).then_some((tried, rest))
        });
        match better {
            Some(found) => (best, least) = found,
            None => step *= 0.5,
        }
    }
    best
}

/// What is left of a ripple, its pressure over that of dry contact, the decay of the convected wave in 1/a, and that
/// to first order.
#[derive(Debug, Clone, Copy)]
struct Ripple {
    left: f64,
    pressure: f64,
    decay: f64,
    first_order: f64,
}

/// Closed form and solver.
fn compare(gear: &Gear, wave_m: f64, (flow, law): Form) -> (Ripple, Ripple) {
    let scene = gear.scene(wave_m, flow);
    let hertz = scene.hertz();
    let body_m_s = scene.speeds_m_s()[0];
    let k = TAU / wave_m;
    let read = read(&scene, k * body_m_s);
    let oil = scene.lubricant.as_ref().unwrap();
    let share = read.pressure_pa / hertz.p_max_pa;
    let (eta_0, alpha) = (oil.viscosity_pa_s, oil.pressure_viscosity_per_pa);
    let viscosity = eta_0
        * Viscosity::roelands(eta_0, alpha, hertz.p_max_pa)
            .ln_eta(share)
            .0
            .exp();
    let sliding_m_s = (gear.slide_roll * gear.entrainment_m_s).abs();
    let sigma = (viscosity * sliding_m_s / (oil.eyring_stress_pa * read.film_m)).asinh();
    let p_hertz_gpa = 1e-9 * hertz.p_max_pa;
    let (rho, slope) = Density::DowsonHigginson { p_hertz_gpa }.rho(share);
    let flat = FlatFilm {
        e_prime_pa: scene.e_prime_pa(),
        film_m: read.film_m,
        viscosity_pa_s: viscosity * (-law(sigma).0).exp(),
        compressibility_per_pa: slope / rho / hertz.p_max_pa,
        entrainment_m_s: gear.entrainment_m_s,
    };
    let convected = flat.convected(wave_m, body_m_s);
    let closed = Ripple {
        left: flat.left(wave_m, body_m_s).norm(),
        pressure: flat.pressure_share(wave_m, body_m_s),
        decay: convected.im * hertz.a_m,
        first_order: flat.first_order_decay_per_m(wave_m, body_m_s) * hertz.a_m,
    };
    let bound = Complex::new(k, 0.0);
    let other = other_wave(&read.x_m, &read.film, bound, convected);
    let (film, _) = two_waves(&read.x_m, &read.film, bound, other);
    let (pressure, _) = two_waves(&read.x_m, &read.pressure, bound, other);
    let solver = Ripple {
        left: film.norm() / AMPLITUDE_M,
        pressure: pressure.norm() / (0.25 * scene.e_prime_pa() * k * AMPLITUDE_M),
        decay: other.im * hertz.a_m,
        first_order: f64::NAN,
    };
    println!(
        "| {} | {:.0} | {flow} | {:.1} | {sigma:.1} | {:.3} | {:.3} | {:.3} | {:.3} | {:.2} | {:.2} | {:.2} | {:.2} | {:.1} |",
        gear.name,
        1e6 * wave_m,
        1e9 * read.film_m,
        closed.left,
        solver.left,
        closed.pressure,
        solver.pressure,
        closed.first_order,
        closed.decay,
        solver.decay,
        read.newton_a_step,
        read.krylov_a_step,
    );
    (closed, solver)
}

#[test]
fn what_is_left_of_a_ripple_is_what_the_closed_form_says() {
    println!(
        "| point | W, um | eyring_flow | film, nm | tau_m/tau0 | left: closed | solver | pressure: closed | solver | decay, 1/a: first order | closed | solver | Newton a step | Krylov |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|");
    for form in [ALONG, SECANT] {
        let points = [(&B, 30e-6, 0.92), (&B, 60e-6, 0.52), (&A, 30e-6, 0.82)];
        let asked = if form.0 == ALONG.0 { 3 } else { 2 };
        for &(gear, wave_m, published) in &points[..asked] {
            let (closed, solver) = compare(gear, wave_m, form);
            let within = |tolerance: f64, ours: f64, theirs: f64| {
                assert!(
                    (ours / theirs - 1.0).abs() < tolerance,
                    "{closed:?} {solver:?}"
                );
            };
            if form.0 == ALONG.0 {
                // Two digits.
                within(0.015, closed.left, published);
                within(0.03, solver.left, closed.left);
                within(0.03, solver.pressure, closed.pressure);
                // A decay beside a bound wave that itself grows along x: from window to window it differs by a tenth.
                // In FZG B at 30 um the wave is gone before the window begins, by a factor of ten.
                within(0.15, solver.decay, closed.decay);
            } else {
                // Beside a convected wave as high as the ripple that does not decay: a hundredth of the ripple.
                assert!(
                    (solver.left - closed.left).abs() < 0.015,
                    "{closed:?} {solver:?}"
                );
                within(0.03, solver.pressure, closed.pressure);
            }
        }
    }
}

/// A run of the default scene on 65², by overrides: what it computed and the work of it.
fn run(sets: &[&str], steps: u64) -> (Frame, asperity::sim::Stats) {
    let common = ["grid.nodes=65", "stress=none", "life=none", "record=none"];
    let sets: Vec<Override> = common
        .iter()
        .chain(sets)
        .map(|s| s.parse().unwrap())
        .collect();
    let scene = Scene::load_with("demonstration", &sets).unwrap();
    let mut sim = Simulation::new(&scene, Plan::new(&scene).unwrap(), 2).unwrap();
    while sim.passage_steps() < steps {
        sim.step().unwrap();
        assert!(sim.metrics().converged);
    }
    let mut frame = Frame::default();
    sim.fill(&mut frame);
    (frame, *sim.stats())
}

#[test]
fn without_sliding_the_flow_has_no_direction() {
    let at = |flow: &str| {
        run(
            &[
                "motion.slide_roll=0",
                &format!("lubricant.eyring_flow={flow}"),
            ],
            8,
        )
    };
    let ((one, work), (other, other_work)) = (at("secant"), at("along_across"));
    assert_eq!(one.pressure_pa, other.pressure_pa);
    assert_eq!(one.film_m, other.film_m);
    assert_eq!(work, other_work);
}

#[test]
fn the_mirrored_half_is_the_whole() {
    // Half of the rows by symmetry, and all of them because a phase shift along y has taken the symmetry away.
    let sets = [
        "lubricant.eyring_flow=along_across",
        "numerics.tolerance=1e-6",
    ];
    let (half, _) = run(&sets, 4);
    let turned = "body_2.surface.angle_deg=180.00000001";
    let (whole, _) = run(&[sets[0], sets[1], turned], 4);
    let worst = half
        .film_m
        .iter()
        .zip(&whole.film_m)
        .map(|(a, b)| (a - b).abs() / (a + 1e-9))
        .fold(0.0_f32, f32::max);
    println!("films of both differ by {worst:.1e} at most");
    assert!(worst < 1e-4, "{worst}");
}

/// `cargo test --release --test engine eyring:: -- --ignored --nocapture`
#[test]
#[ignore = "timing: on a quiet machine"]
fn cost_of_a_step_with_either_form() {
    println!(
        "| scene, nodes | eyring_flow | ms a step | Newton a step | Krylov a step | h_c, nm | h_min, nm | friction |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    for (preset, nodes, steps) in [("demonstration", 129, 48), ("fzg_point_b", 513, 200)] {
        let mut taken = [0.0; 2];
        for (flow, taken) in ["secant", "along_across"].into_iter().zip(&mut taken) {
            let sets = [
                format!("grid.nodes={nodes}"),
                format!("lubricant.eyring_flow={flow}"),
                "stress=none".to_owned(),
                "life=none".to_owned(),
                "record=none".to_owned(),
            ];
            let sets: Vec<Override> = sets.iter().map(|s| s.parse().unwrap()).collect();
            let scene = Scene::load_with(preset, &sets).unwrap();
            let mut sim = Simulation::new(&scene, Plan::new(&scene).unwrap(), 1).unwrap();
            while sim.passage_steps() == 0 {
                sim.step().unwrap();
            }
            let (before, clock) = (*sim.stats(), std::time::Instant::now());
            for _ in 0..steps {
                sim.step().unwrap();
            }
            *taken = 1e3 * clock.elapsed().as_secs_f64() / f64::from(steps);
            let (work, metrics) = (sim.stats(), sim.metrics());
            println!(
                "| {preset}, {nodes} | {flow} | {taken:.1} | {:.2} | {:.1} | {:.1} | {:.1} | {:.4} |",
                (work.newton_iterations - before.newton_iterations) as f64 / f64::from(steps),
                (work.linear_iterations - before.linear_iterations) as f64 / f64::from(steps),
                1e9 * metrics.h_central_m,
                1e9 * metrics.h_min_m,
                metrics.friction_coefficient,
            );
        }
        println!("ratio {:.2}", taken[1] / taken[0]);
    }
}
