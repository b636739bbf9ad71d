//! The whole stress field, all six components, of both bodies and both tractions: against Hertz with
//! sliding, against its mirror image, against equilibrium. Every test prints what it asserts.

use asperity_engine::physics::cycles::BodyId;
use asperity_engine::physics::stress_exact::hertz_sliding;
use asperity_engine::solve::stress::{
    Cut, Loading, Plane, SliceOut, StressEngine, StressLaw, StressSpec, Symmetry,
};

const NU: f64 = 0.3;
const ONE: Loading = Loading::Full(BodyId::One);
const TWO: Loading = Loading::Full(BodyId::Two);

fn spec(n: usize, symmetry: Symmetry, depths: &[f64]) -> StressSpec {
    let d = 4.0 / n as f64;
    let ny = match symmetry {
        Symmetry::MirrorY => n / 2 + 1,
        Symmetry::General | Symmetry::Line => n + 1,
    };
    let mut spec = StressSpec::new((n + 1, ny), (d, d), NU, (8, 3.0), symmetry);
    spec.x_first = -2.0;
    if !depths.is_empty() {
        spec.weights = vec![1.0; depths.len()];
        spec.depths = depths.to_vec();
    }
    spec
}

fn field(spec: &StressSpec, f: impl Fn(f64, f64) -> f64) -> Vec<f32> {
    let axis = match spec.symmetry {
        Symmetry::MirrorY => 0,
        Symmetry::General | Symmetry::Line => spec.ny / 2,
    };
    let y = |j: usize| spec.dy * (j as f64 - axis as f64);
    let x = |i: usize| spec.x_first + spec.dx * i as f64;
    (0..spec.nx * spec.ny)
        .map(|at| f(x(at % spec.nx), y(at / spec.nx)) as f32)
        .collect()
}

fn hertz(x: f64, y: f64) -> f64 {
    (1.0 - x * x - y * y).max(0.0).sqrt()
}

fn worst(a: &[f32], b: &[f32]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter()
        .zip(b)
        .fold(0.0, |w, (a, b)| w.max(f64::from((a - b).abs())))
}

fn worst_plane(a: &Plane, b: &Plane) -> f64 {
    let pairs = a.components.iter().zip(&b.components);
    pairs.fold(0.0, |w, (a, b)| w.max(worst(a, b)))
}

/// Greatest error of any component in the planes z = `depths`, within the contact's circle.
fn plane_errors(n: usize, friction: f64, depths: &[f64]) -> Vec<f64> {
    let spec = spec(n, Symmetry::MirrorY, depths);
    let p = field(&spec, hertz);
    let q: Vec<f32> = p.iter().map(|p| p * friction as f32).collect();
    let mut engine = StressEngine::new(&spec).expect("valid");
    engine.load(&p, (friction > 0.0).then_some(&q));
    let error = |z: f64, plane: &Plane| {
        let mut worst: f64 = 0.0;
        for j in (0..plane.rows).step_by(2) {
            let y = spec.dy * (j as f64 - (plane.rows / 2) as f64);
            for i in (0..plane.width).step_by(2) {
                let x = spec.x_first + spec.dx * i as f64;
                if x * x + y * y < 1.0 {
                    let exact = hertz_sliding(x, y, z, NU, friction);
                    worst = worst.max(exact.distance(plane.state(j, i)));
                }
            }
        }
        worst
    };
    depths
        .iter()
        .map(|&z| error(z, &engine.plane(ONE, Cut::Z(z))))
        .collect()
}

#[test]
fn whole_field_matches_hertz_with_sliding() {
    let depths = [0.1, 0.25, 0.5, 1.0, 3.0];
    for friction in [0.0, 0.1, 0.25] {
        println!(
            "greatest error of six components in r < a, p0, mu = {friction}, z = {depths:?} a"
        );
        for n in [64, 128, 256] {
            let errors = plane_errors(n, friction, &depths);
            let text: Vec<_> = errors.iter().map(|e| format!("{e:.1e}")).collect();
            println!("  N = {n:3}: {}", text.join("  "));
            if n == 256 {
                for (k, table) in [(0, 2.5e-3), (2, 1.2e-4), (4, 1e-5)] {
                    assert!(errors[k] < 1.2 * table, "z = {}", depths[k]);
                }
            }
        }
    }
}

#[test]
fn planes_agree_with_the_fast_slice_and_with_each_other() {
    let spec = spec(64, Symmetry::General, &[]);
    let p = field(&spec, |x, y| {
        hertz(x - 0.1, y - 0.2) * (1.0 + 0.5 * (9.0 * x + 5.0 * y).cos())
    });
    let qx = field(&spec, |x, y| 0.2 * hertz(x, y - 0.1) * (1.0 + y));
    let mut engine = StressEngine::new(&spec).expect("valid");
    engine.load(&p, Some(&qx));
    let mut slice = SliceOut::new(&spec);
    for loading in Loading::ALL {
        engine.slice_of(loading, &mut slice);
        let plane = engine.plane(loading, Cut::Y(0.0));
        let fast = [
            &slice.sxx, &slice.syy, &slice.szz, &slice.sxy, &slice.sxz, &slice.syz,
        ];
        let off = fast
            .iter()
            .zip(&plane.components)
            .fold(0.0, |w: f64, (a, b)| w.max(worst(a, b)));
        println!("{loading:?}: slice against plane y = 0: {off:.1e}");
        assert!(off < 5e-6);
    }
    // The three cuts meet in a point.
    let (i, j, k) = (38, 25, 4);
    let (x, y) = (
        spec.x_first + spec.dx * i as f64,
        spec.dy * (j as f64 - 32.0),
    );
    let by_x = engine.plane(TWO, Cut::X(x)).state(k, j);
    let by_y = engine.plane(TWO, Cut::Y(y)).state(k, i);
    let by_z = engine.plane(TWO, Cut::Z(spec.depths[k])).state(j, i);
    println!("{by_x:?}\n{by_y:?}\n{by_z:?}");
    assert!(by_x.distance(by_y) < 3e-6 && by_x.distance(by_z) < 3e-6);
}

#[test]
fn a_mirror_gives_what_the_whole_surface_gives() {
    let depths = [0.1, 0.3, 0.8, 2.0];
    let solve = |symmetry: Symmetry| {
        let spec = spec(64, symmetry, &depths);
        let p = field(&spec, |x, y| hertz(x - 0.2, y));
        let qx = field(&spec, |x, y| 0.2 * hertz(x, y));
        let mut engine = StressEngine::new(&spec).expect("valid");
        engine.load(&p, Some(&qx));
        let mut slice = SliceOut::new(&spec);
        engine.slice(&mut slice);
        (
            engine.plane(TWO, Cut::Z(0.3)),
            engine.plane(ONE, Cut::Y(0.4)),
            slice.sxx,
            engine.volume(11.0),
        )
    };
    let (mirror, general) = (solve(Symmetry::MirrorY), solve(Symmetry::General));
    let off = worst_plane(&mirror.0, &general.0)
        .max(worst_plane(&mirror.1, &general.1))
        .max(worst(&mirror.2, &general.2));
    let ln = mirror.3.mate.ln - general.3.mate.ln;
    println!("mirror against general: {off:.1e} p0, ln I {ln:.1e}");
    assert!(off < 3e-6 && ln.abs() < 1e-5);
}

#[test]
fn the_second_body_feels_the_opposite_traction_with_its_own_ratio() {
    let nu_2 = 0.22;
    let surface = |spec: &StressSpec| {
        let p = field(spec, |x, y| {
            hertz(x - 0.1, y) * (1.0 + 0.5 * (8.0 * x).cos())
        });
        let q: Vec<f32> = p.iter().map(|p| 0.3 * p).collect();
        (p, q)
    };
    for (ratio, symmetry) in [
        (NU, Symmetry::MirrorY),
        (nu_2, Symmetry::MirrorY),
        (nu_2, Symmetry::General),
    ] {
        let mut both = spec(64, symmetry, &[]);
        both.nu_2 = ratio;
        let mut alone = both.clone();
        (alone.nu, alone.nu_2) = (ratio, ratio);
        let (p, q) = surface(&both);
        let opposite: Vec<f32> = q.iter().map(|q| -q).collect();
        let mut engine = StressEngine::new(&both).expect("valid");
        let mut second = StressEngine::new(&alone).expect("valid");
        engine.load(&p, Some(&q));
        second.load(&p, Some(&opposite));
        let (mut a, mut b) = (SliceOut::new(&both), SliceOut::new(&alone));
        engine.slice_of(TWO, &mut a);
        second.slice(&mut b);
        let off = worst(&a.sxx, &b.sxx)
            .max(worst(&a.sxz, &b.sxz))
            .max(worst(&a.syy, &b.syy));
        let (v, w) = (engine.volume(10.0), second.volume(10.0));
        let normal = engine.sums().integral(Loading::Normal(BodyId::Two), 0).ln;
        println!(
            "nu 2 = {ratio}: slice {off:.1e}; ln I body 1 {:.6}, body 2 {:.6} (alone {:.6})",
            v.full.ln, v.mate.ln, w.full.ln
        );
        assert!(off < 2e-6 && (v.mate.ln - w.full.ln).abs() < 2e-6);
        assert!((normal - w.normal.ln).abs() < 2e-6);
        assert!(v.full.ln != v.mate.ln);
    }
}

#[test]
fn the_field_is_in_equilibrium() {
    // div σ = 0 by central differences over one node and as much in depth: the error of the differences is
    // (k d)²/6 of the slopes, and the field holds no wave beyond ln(1/ε)/z.
    let d = 4.0 / 128.0;
    let z = 0.6;
    let spec = spec(128, Symmetry::General, &[z - d, z, z + d, 2.0]);
    let p = field(&spec, |x, y| {
        hertz(x, y - 0.1) * (1.0 + 0.3 * (6.0 * x).cos())
    });
    let qx = field(&spec, |x, y| 0.2 * hertz(x, y));
    let mut engine = StressEngine::new(&spec).expect("valid");
    engine.load(&p, Some(&qx));
    for loading in [ONE, TWO] {
        let [above, here, below] = [z - d, z, z + d].map(|z| engine.plane(loading, Cut::Z(z)));
        let (mut worst, mut slopes): (f64, f64) = (0.0, 0.0);
        for j in (20..108).step_by(3) {
            for i in (20..108).step_by(3) {
                let x = [here.state(j, i - 1), here.state(j, i + 1)];
                let y = [here.state(j - 1, i), here.state(j + 1, i)];
                let z = [above.state(j, i), below.state(j, i)];
                let slope = |pair: [f64; 2]| (pair[1] - pair[0]) / (2.0 * d);
                let terms = [
                    [
                        slope(x.map(|s| s.xx)),
                        slope(y.map(|s| s.xy)),
                        slope(z.map(|s| s.xz)),
                    ],
                    [
                        slope(x.map(|s| s.xy)),
                        slope(y.map(|s| s.yy)),
                        slope(z.map(|s| s.yz)),
                    ],
                    [
                        slope(x.map(|s| s.xz)),
                        slope(y.map(|s| s.yz)),
                        slope(z.map(|s| s.zz)),
                    ],
                ];
                for three in terms {
                    worst = worst.max(three.iter().sum::<f64>().abs());
                    slopes = three.iter().fold(slopes, |w, t| w.max(t.abs()));
                }
            }
        }
        println!("{loading:?}: out of balance {worst:.1e}, steepest slope {slopes:.2} p0/a");
        assert!(worst < 1e-2 * slopes);
    }
}

#[test]
fn swept_integral_takes_the_greatest_of_every_row() {
    let spec = spec(64, Symmetry::MirrorY, &[]);
    let p = field(&spec, hertz);
    let q: Vec<f32> = p.iter().map(|p| 0.2 * p).collect();
    let mut engine = StressEngine::new(&spec).expect("valid");
    engine.load(&p, Some(&q));
    let law = StressLaw::power(11.481);
    let mut layers = vec![0.0; spec.depths.len()];
    let sums = engine.volume_under(&[law], &BodyId::BOTH).clone();
    sums.swept_into(sums.row_tops(ONE), law, &mut layers);
    // By the exact field: rows 0.01 a apart, the greatest over x.
    for k in [4, 6] {
        let z = spec.depths[k];
        let mut sum = 0.0;
        for row in 0..150 {
            let y = 0.01 * (f64::from(row) + 0.5);
            let top = (-150..=150)
                .map(|i| hertz_sliding(0.01 * f64::from(i), y, z, NU, 0.2).von_mises())
                .fold(0.0, f64::max);
            sum += 2.0 * 0.01 * top.powf(law.exponent);
        }
        let exact = (sum * spec.weights[k]).ln();
        println!(
            "z = {z:.3}: ln of the swept share {:.5}, exact {exact:.5}",
            layers[k]
        );
        assert!(
            (layers[k] - exact).abs() < 0.04,
            "the greatest sample lies up to half a step of the layer's own grid beside the crest"
        );
    }
}

#[test]
fn a_stress_limit_counts_only_what_exceeds_it() {
    let spec = spec(64, Symmetry::MirrorY, &[]);
    let mut engine = StressEngine::new(&spec).expect("valid");
    engine.load(&field(&spec, hertz), None);
    let laws = |limit: f64| {
        [
            StressLaw::power(9.0),
            StressLaw {
                exponent: 9.0,
                limit,
            },
        ]
    };
    let ln = |engine: &mut StressEngine, limit: f64| {
        let sums = engine.volume_under(&laws(limit), &[BodyId::One]);
        [0, 1].map(|law| sums.integral(Loading::Normal(BodyId::One), law).ln)
    };
    let [all, none] = ln(&mut engine, 1e-9);
    let [_, some] = ln(&mut engine, 0.3);
    let [_, nothing] = ln(&mut engine, 0.7);
    println!("ln I without limit {all:.6}, limit 1e-9 {none:.6}, 0.3 {some:.4}, 0.7 {nothing}");
    assert!((all - none).abs() < 1e-5 && some < all - 4.0);
    assert_eq!(nothing, f64::NEG_INFINITY);
}
