//! Line contacts: one row, logarithmic kernel, against closed forms and computed values.

use std::f64::consts::{PI, TAU};

use crate::common::contact::{DRY, Fluid, converged, steady};
use asperity_engine::math::grid::{Grid, Symmetry};
use asperity_engine::plan::{LINE_ROWS, Plan};
use asperity_engine::scene::{ContactKind, Order, Override, Scene, StressMeasure};
use asperity_engine::sim::{Frame, Knob, Simulation};
use asperity_engine::solve::march::{Conditions, Flow, Guess, March, Shape, Solver};
use asperity_engine::solve::newton::{NewtonReport, Tolerance, Verdict};
use asperity_engine::solve::reynolds::Medium;
use asperity_engine::solve::stress::{LineStress, SliceOut};

/// κ = 2 p_h R/(π E' b) with p_h = E' b/(4R).
const LINE: Shape = Shape {
    kappa: 1.0 / TAU,
    curvature_y: 0.0,
    b_over_a: 1.0,
    kappa_s: 0.0,
    order: Order::Second,
};

/// ∫ √(1 − X²) dX.
const LOAD: f64 = PI / 2.0;

fn conditions(medium: &Medium, tolerance: Tolerance) -> Conditions<'_> {
    Conditions {
        medium,
        law: None,
        shift: &[],
        load: LOAD,
        tolerance,
    }
}

#[test]
fn dry_hertz() {
    let tolerance = Tolerance {
        pressure: 1e-8,
        film: f64::INFINITY,
        mass: f64::INFINITY,
        least_film: 0.0,
        load: 1e-8,
        max_iterations: 40,
    };
    let mut errors = Vec::new();
    for nodes in [129, 257, 513] {
        let grid = Grid::new(nodes, -1.5, 1.5, 0.0, Symmetry::Line);
        let mut march = March::from_hertz(grid, &LINE, 0.0, 1.0, Flow::Dry);
        // Not from the answer: a parabola that carries the wrong load.
        let grid = &march.solver.grid;
        for (n, p) in march.state.history.pressure_1.iter_mut().enumerate() {
            *p = (0.8 - grid.x(n).powi(2)).max(0.0);
        }
        march.state.history.h0[0] -= 0.3;
        let report = march.attempt(&conditions(&DRY, tolerance), 1.0, Guess::Last);
        assert_eq!(report.verdict, Verdict::Converged, "{report:?}");
        march.commit(1.0);
        let (p, grid) = (&march.state.pressure, &march.solver.grid);
        let p_max = p.iter().copied().fold(0.0, f64::max);
        let moment = grid.integrate(|n| p[n] * grid.x(n).powi(2));
        // Hertz: the mean of x² over the pressure is b²/4.
        let half_width = (4.0 * moment / grid.integrate(|n| p[n])).sqrt();
        println!(
            "{nodes}: p_max {p_max:.6}, b {half_width:.6} (both 1 by Hertz), {} Newton, {} Krylov iterations",
            report.iterations, report.linear_iterations
        );
        let lowest = march
            .state
            .film
            .iter()
            .copied()
            .fold(f64::INFINITY, f64::min);
        assert!(lowest > -1e-7, "no penetration: {lowest}");
        errors.push((p_max - 1.0).abs().max((half_width - 1.0).abs()));
    }
    assert!(errors[0] < 1e-3 && errors[2] < 2e-4, "{errors:?}");
}

const TOLERANCE: Tolerance = Tolerance {
    pressure: 1e-4,
    film: 1e-4,
    mass: 1e-4,
    least_film: 0.0,
    load: 1e-6,
    max_iterations: 20,
};

/// A line contact given by Moes' groups: λ = 3π²/(8M²), α p_h = L √(M/2π).
struct Case {
    medium: Medium,
    domain: (f64, f64),
}

impl Case {
    fn moes(m: f64, l: f64, fluid: Fluid, domain: (f64, f64)) -> Self {
        Self {
            medium: fluid.medium(l * (m / TAU).sqrt(), 3.0 * PI * PI / (8.0 * m * m)),
            domain,
        }
    }

    fn grid(&self, nodes: usize) -> Grid {
        Grid::new(nodes, self.domain.0, self.domain.1, 0.0, Symmetry::Line)
    }

    /// The steady smooth contact on `nodes`, through 65, 129 ...; `each` sees every grid's.
    fn steady(&self, nodes: usize, each: impl FnMut(&March)) -> March {
        let guess = 0.7 * self.medium.lambda.powf(0.67);
        let step = |march: &mut March| {
            self.step(march, 1.0);
        };
        steady(|nodes| self.grid(nodes), &LINE, guess, nodes, step, each)
    }

    /// One committed step that must converge.
    fn step(&self, march: &mut March, nodes: f64) -> NewtonReport {
        converged(march, &conditions(&self.medium, TOLERANCE), nodes)
    }
}

/// H at the origin, which is a node of the domains used here.
fn central(march: &March) -> f64 {
    let grid = &march.solver.grid;
    let i = (-grid.x_min / grid.dx).round() as usize;
    assert!(grid.x(i).abs() < 1e-12, "the origin is a node");
    march.state.film[i]
}

/// Least H for |X| < 1.1, by a parabola through the lowest node.
fn minimum(march: &March) -> f64 {
    let (grid, h) = (&march.solver.grid, &march.state.film);
    let i = (1..grid.nx - 1)
        .filter(|&i| grid.x(i).abs() < 1.1)
        .min_by(|&i, &k| h[i].total_cmp(&h[k]))
        .expect("the contact has nodes");
    let curvature = h[i - 1] - 2.0 * h[i] + h[i + 1];
    h[i] - (h[i - 1] - h[i + 1]).powi(2) / (8.0 * curvature)
}

/// Inlet, outlet.
const DOMAIN: (f64, f64) = (-5.5, 2.5);

/// A row of `assets/reference/line.csv`.
struct Reference {
    m: f64,
    l: f64,
    fluid: Fluid,
    /// h R/b².
    h_central: f64,
    /// W/b and the ratio of deformed to initial amplitude.
    waves: &'static [(f64, f64)],
}

const REFERENCE: [Reference; 3] = [
    Reference {
        m: 20.0,
        l: 10.0,
        fluid: Fluid::BarusIncompressible,
        h_central: 0.10264,
        waves: &[(0.5, 0.991), (1.0, 0.700), (2.0, 0.366)],
    },
    Reference {
        m: 20.0,
        l: 10.0,
        fluid: Fluid::RoelandsDowsonHigginson,
        h_central: 0.08495,
        waves: &[(1.0, 0.615)],
    },
    Reference {
        m: 100.0,
        l: 10.0,
        fluid: Fluid::BarusIncompressible,
        h_central: 0.01591,
        waves: &[(1.0, 0.2275)],
    },
];

/// Mean over |X| ≤ `reach` of the film's first harmonic in time, over the amplitude of the waves.
fn ripple(case: &Case, smooth: &March, w: f64, reach: f64) -> (f64, u32, usize) {
    let nodes = smooth.solver.grid.nx;
    let mut march = March {
        state: smooth.state.clone(),
        solver: Solver::new(case.grid(nodes), &LINE, 1.0, Flow::Film),
    };
    let dx = march.solver.grid.dx;
    let amplitude = 0.1 * central(&march);
    let steps = (w / dx).round() as usize;
    let start = (5.0 / dx).ceil() as usize;
    let columns: Vec<usize> = (1..nodes - 1)
        .filter(|&i| march.solver.grid.x(i).abs() <= reach + 1e-12)
        .collect();
    let mut sums = vec![[0.0; 2]; columns.len()];
    let mut newtons = 0;
    for step in 1..=start + steps {
        let t = step as f64 * dx;
        for (n, gap) in march.solver.gap.iter_mut().enumerate() {
            let x = march.solver.grid.x(n);
            *gap = march.solver.macroscopic[n] - amplitude * t.min(1.0) * (TAU * (x - t) / w).cos();
        }
        newtons += case.step(&mut march, 1.0).iterations;
        if step > start {
            let (s, c) = (TAU * t / w).sin_cos();
            for (sum, &i) in sums.iter_mut().zip(&columns) {
                let h = march.state.film[i] * 2.0 / steps as f64;
                *sum = [sum[0] + h * c, sum[1] + h * s];
            }
        }
    }
    let mean: f64 = sums.iter().map(|s| s[0].hypot(s[1])).sum::<f64>() / sums.len() as f64;
    (mean / amplitude, newtons, start + steps)
}

#[test]
fn smooth_and_wavy_against_independent_codes() {
    for row in REFERENCE {
        let Reference {
            m,
            l,
            fluid,
            h_central,
            waves,
        } = row;
        let case = Case::moes(m, l, fluid, DOMAIN);
        let mut films = Vec::new();
        let march = case.steady(513, |march| films.push(central(march)));
        let [_, coarse, middle, fine] = films[..] else {
            panic!("four grids");
        };
        let order = ((middle - coarse) / (fine - middle)).abs().log2();
        let extrapolated = fine + (fine - middle) / 3.0;
        println!(
            "M {m} L {l} {fluid:?}: central {films:.5?} -> {extrapolated:.5}, order {order:.2}; \
             reference {h_central} (64 nodes per half-width)"
        );
        // The reference is one grid of 64 nodes per half-width. At M = 20 the codes differ by 0.7 %. At M = 100 the
        // reference lies 8 % below this code, and 6 % below the Moes formula; a second independent code
        // (`steady_films_of_a_second_code`) confirms the higher value. The bound says no more than that.
        let tolerance = if m < 50.0 { 0.01 } else { 0.09 };
        assert!((fine / h_central - 1.0).abs() < tolerance, "{fine}");
        assert!(order >= 1.4, "{order}");
        for &(w, reference) in waves {
            let (ratio, newtons, steps) = ripple(&case, &march, w, 0.25);
            println!(
                "  W {w}: {ratio:.4} reference {reference}; {:.2} Newton a step",
                f64::from(newtons) / steps as f64
            );
            let tolerance = if m < 50.0 { 0.02 } else { 0.12 };
            assert!((ratio / reference - 1.0).abs() < tolerance, "{ratio}");
        }
    }
}

#[test]
fn steady_films_of_a_second_code() {
    // `assets/reference/line_steady.csv`: another discretisation of the steady equation, extrapolated. 0.5 % at M = 20;
    // 1.5 % at M = 100, where its last two grids are 0.9 % apart.
    for (m, h_central, tolerance) in [(20.0, 0.1035, 0.005), (100.0, 0.0172, 0.015)] {
        let case = Case::moes(m, 10.0, Fluid::BarusIncompressible, (-5.0, 3.0));
        let mut films = Vec::new();
        let march = case.steady(513, |march| films.push(central(march)));
        let [.., middle, fine] = films[..] else {
            panic!("four grids");
        };
        let extrapolated = fine + (fine - middle) / 3.0;
        println!(
            "M {m} L 10: central {films:.5?} -> {extrapolated:.5}, second code {h_central}; minimum {:.5}",
            minimum(&march)
        );
        assert!(
            (extrapolated / h_central - 1.0).abs() < tolerance,
            "{extrapolated}"
        );
    }
}

#[test]
fn films_against_the_formulas() {
    use asperity_engine::physics::line::{dowson_higginson_minimum, moes_central};
    println!("M L: central, Moes, ratio; minimum, Dowson-Higginson, ratio (Moes units)");
    let (mut worst_c, mut worst_n) = (0.0_f64, 0.0_f64);
    for l in [5.0, 10.0] {
        for m in [10.0, 20.0, 50.0, 100.0] {
            let case = Case::moes(m, l, Fluid::BarusIncompressible, (-6.5, 1.5));
            let march = case.steady(513, |_| {});
            let unit = 8.0 * m / PI;
            let (c, n) = (unit * central(&march), unit * minimum(&march));
            let (moes, dowson) = (moes_central(m, l), dowson_higginson_minimum(m, l));
            println!(
                "{m:5} {l:3}: {c:.3} {moes:.3} {:.3}; {n:.3} {dowson:.3} {:.3}",
                c / moes,
                n / dowson
            );
            worst_c = worst_c.max((c / moes - 1.0).abs());
            worst_n = worst_n.max((n / dowson - 1.0).abs());
        }
    }
    println!(
        "scatter: central against Moes {worst_c:.3}, minimum against Dowson-Higginson {worst_n:.3}"
    );
    // Fits of films between isoviscous and piezoviscous, rigid and elastic: 10 % is what such fits promise; the minimum
    // by Dowson and Higginson was fitted at higher loads.
    assert!(worst_c < 0.1 && worst_n < 0.25, "{worst_c} {worst_n}");
}

#[test]
fn a_short_inlet_starves_the_film_as_the_plan_says() {
    use asperity_engine::plan::inlet_error;
    for m in [20.0, 100.0] {
        let film = |x_min: f64| {
            // The same spacing, 1/32.
            let nodes = 257;
            let case = Case::moes(m, 10.0, Fluid::BarusIncompressible, (x_min, x_min + 8.0));
            central(&case.steady(nodes, |_| {}))
        };
        let long = film(-6.5);
        for x_min in [-2.0, -2.5, -3.5, -4.5] {
            let lost = 1.0 - film(x_min) / long;
            let rule = inlet_error(ContactKind::Line, long, 10.0, x_min);
            println!(
                "M {m}: inlet {x_min}: {:.2} % of the film, rule {:.2} %",
                100.0 * lost,
                100.0 * rule
            );
            // A rule of thumb, which must not be far too low.
            assert!(lost < 1.3 * rule + 0.001, "{lost} {rule}");
        }
    }
}

/// Hertz's pressure on `nodes` of [−2.5, 2.5], and the engine.
fn hertz_engine(nodes: usize, measure: StressMeasure) -> (LineStress, Vec<f32>) {
    let dx = 5.0 / (nodes - 1) as f64;
    let pressure = (0..nodes)
        .map(|i| {
            let x = -2.5 + dx * i as f64;
            (1.0 - x * x).max(0.0).sqrt() as f32
        })
        .collect();
    (
        LineStress::new(nodes, (-2.5, dx), [0.3; 2], (48, 4.0), measure),
        pressure,
    )
}

#[test]
fn stress_below_a_hertzian_line() {
    // McEwen (1949), Johnson (1985), §4.2 and §7.1: pressure, and traction in proportion to it.
    let nodes = 513;
    let (mut engine, p) = hertz_engine(nodes, StressMeasure::VonMises);
    let mut out = SliceOut::new(engine.spec());
    let zero = vec![0.0_f32; nodes];
    let mut worst = 0.0_f64;
    for traction in [0.0, 0.1] {
        let q: Vec<f32> = p.iter().map(|p| traction as f32 * p).collect();
        engine.load(&p, Some(if traction == 0.0 { &zero } else { &q }));
        engine.slice(&mut out);
        for (k, &z) in engine.spec().depths.iter().enumerate() {
            if z < 0.1 {
                continue;
            }
            for i in (0..nodes).step_by(7) {
                let x = -2.5 + 5.0 / (nodes - 1) as f64 * i as f64;
                let root = ((1.0 - x * x + z * z).powi(2) + 4.0 * x * x * z * z).sqrt();
                let m = (0.5 * (root + (1.0 - x * x + z * z))).sqrt();
                let n = (0.5 * (root - (1.0 - x * x + z * z))).max(0.0).sqrt() * x.signum();
                let sum = m * m + n * n;
                let xx = -(m * (1.0 + (z * z + n * n) / sum) - 2.0 * z);
                let zz = -m * (1.0 - (z * z + n * n) / sum);
                let xz = -n * (m * m - z * z) / sum;
                let by_traction = n * (2.0 - (z * z - m * m) / sum) - 2.0 * x;
                let at = k * nodes + i;
                for (got, exact) in [
                    (out.sxx[at], xx + traction * by_traction),
                    (out.szz[at], zz + traction * xz),
                    (out.sxz[at], xz + traction * xx),
                ] {
                    worst = worst.max((f64::from(got) - exact).abs());
                }
            }
        }
    }
    println!(
        "greatest difference to the closed form from 0.1 b down, 102 nodes per half-width: {worst:.1e} p_h"
    );
    assert!(worst < 1e-3, "{worst}");
    engine.load(&p, None);
    engine.slice(&mut out);
    let mises = out.peak;
    let (mut shear, mut at) = (0.0_f32, (0.0, 0.0));
    for (k, &z) in engine.spec().depths.iter().enumerate() {
        for i in 0..nodes {
            if out.sxz[k * nodes + i].abs() > shear {
                shear = out.sxz[k * nodes + i].abs();
                at = (-2.5 + 5.0 / (nodes - 1) as f64 * i as f64, z);
            }
        }
    }
    let (mut engine, _) = hertz_engine(nodes, StressMeasure::MaxShear);
    engine.load(&p, None);
    engine.slice(&mut out);
    println!(
        "von Mises {:.4} at {:.3} b, greatest shear {:.4} at {:.3} b, orthogonal {shear:.4} at {:.3}, {:.3} b",
        mises.value, mises.z, out.peak.value, out.peak.z, at.0, at.1
    );
    let near = |got: f64, value: f64, by: f64| assert!((got - value).abs() < by, "{got} {value}");
    near(mises.value, 0.5575, 3e-4);
    near(mises.z, 0.704, 5e-3);
    near(out.peak.value, 0.3003, 3e-4);
    near(out.peak.z, 0.786, 5e-3);
    // Not refined between nodes and depths: the maximum is flat.
    near(f64::from(shear), 0.25, 1e-3);
    near(at.0.abs(), 0.866, 0.03);
    near(at.1, 0.5, 0.05);
}

#[test]
fn life_integrals_of_a_hertzian_line() {
    for (m, exact) in [
        (31.0 / 3.0, 2.190e-3),
        (31.0 / 3.0 * 10.0 / 9.0, 1.007e-3),
        (13.5, 2.638e-4),
    ] {
        let (mut engine, p) = hertz_engine(257, StressMeasure::VonMises);
        engine.load(&p, None);
        let got = engine.volume(m).normal.ln.exp();
        println!("m = {m:.3}: J = {got:.4e}, reference {exact:.4e} (1 %)");
        assert!((got / exact - 1.0).abs() < 0.01, "{got}");
    }
}

fn scene(sets: &[&str]) -> Result<Scene, asperity_engine::scene::SceneError> {
    let sets: Vec<Override> = sets
        .iter()
        .map(|s| s.parse().expect("an override"))
        .collect();
    Scene::load_with("fzg_point_b", &sets)
}

#[test]
fn a_rough_line_converges_at_every_step() {
    let scene = scene(&["grid.nodes=257", "time.passages=1"]).expect("a preset");
    let plan = Plan::new(&scene).expect("it can be planned");
    let mut sim = Simulation::new(&scene, plan, 1).expect("it can be made");
    let mut frame = Frame::default();
    while !sim.is_done() {
        sim.step().expect("no step fails");
        let m = sim.metrics();
        assert!(m.converged && m.load_error < 1e-5 && m.mass_error < 1e-4);
    }
    sim.fill(&mut frame);
    assert_eq!(
        (frame.nx, frame.ny, frame.kind),
        (257, LINE_ROWS, ContactKind::Line)
    );
    for row in frame.film_m.chunks_exact(257) {
        assert_eq!(row, &frame.film_m[..257], "uniform along y");
    }
    let summary = sim.summary();
    let life = summary.life_relative.expect("the preset asks for life");
    println!(
        "p_max {:.2} GPa, film {:.0} nm, touching {:.2} %, n {:.2?}/{:.2?}, counted {:.2?}/{:.2?}, life {life:.2e}",
        summary.p_max_pa * 1e-9,
        summary.h_central_m * 1e9,
        100.0 * summary.contact_ratio,
        summary.n_body_1,
        summary.n_body_2,
        summary.n_counted_body_1,
        summary.n_counted_body_2
    );
    assert!(summary.converged && life > 0.0 && life < 1.0);
    assert!(
        (summary.load_n / 4.22e5 - 1.0).abs() < 1e-9,
        "load per metre"
    );
    let refused = sim.set(Knob::ForceN, 800.0);
    assert!(refused.is_err_and(|error| error.to_string().contains("load.force_n_per_m")));
    assert!(sim.set(Knob::ForceNPerM, 4e5).is_ok());
}

#[test]
fn a_smooth_line_is_its_own_reference_and_twice_the_load_is_hertz() {
    let smooth = [
        "body_1.surface.kind=smooth",
        "body_2.surface.kind=smooth",
        "motion.slide_roll=0",
        "lubricant=none",
        "grid.nodes=257",
    ];
    let scene = scene(&smooth).expect("a dry, smooth line");
    let plan = Plan::new(&scene).expect("it can be planned");
    let hertz = plan.hertz.p_max_pa;
    let mut sim = Simulation::new(&scene, plan, 1).expect("it can be made");
    while !sim.is_done() {
        sim.step().expect("no step fails");
    }
    let m = sim.metrics();
    println!(
        "dry: p_max {:.5} of Hertz, life {:?}",
        m.p_max_pa / hertz,
        m.life.map(|l| l.life_relative)
    );
    assert!((m.p_max_pa / hertz - 1.0).abs() < 2e-3);
    let life = m.life.expect("the preset asks for life");
    assert!(
        (life.stress_factor - 1.0).abs() < 1e-6,
        "{}",
        life.stress_factor
    );
}

#[test]
fn what_a_line_refuses_it_names() {
    for (sets, key, allowed) in [
        (
            &["contact.ry_m=0.1"][..],
            "contact.ry_m",
            "only with contact.kind",
        ),
        (
            &["load.force_n=800"],
            "load.force_n ",
            "contact.kind = \"point\"",
        ),
        (
            &["body_1.surface.wavelength_y_m=1e-4"],
            "body_1.surface.wavelength_y_m",
            "inf: a line",
        ),
        (
            &["body_2.surface.angle_deg=30"],
            "body_2.surface.angle_deg",
            "0 with wavelength_y_m = inf",
        ),
        (
            &[
                "body_2.surface.wavelength_x_m=inf",
                "body_2.surface.wavelength_y_m=1e-4",
            ],
            "body_2.surface.wavelength_x_m",
            "a length in m",
        ),
        (&["contact.kind=point"], "contact.ry_m", "1e-6 to 100 m"),
        (
            &["contact.kind=point", "contact.ry_m=0.01"],
            "load.force_n_per_m",
            "contact.kind = \"line\"",
        ),
    ] {
        let error = scene(sets).expect_err("it is refused").to_string();
        println!("{error}");
        assert!(
            error.contains(key) && error.contains(allowed),
            "{sets:?}: {error}"
        );
    }
}
