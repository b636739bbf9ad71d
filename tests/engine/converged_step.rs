//! A step that says it converged to 1e-3 is within 1e-3 of the step solved all but to rounding.
//!
//! ```text
//! Σ|P − P*| / ΣP* ≤ tolerance,    Σ|H − H*| / ΣH* ≤ 10 × tolerance over the pressurised nodes
//! ```
//! Both steps start from the same saved state, so only the iteration differs.

#![expect(clippy::unwrap_used, clippy::print_stdout, reason = "tests")]

use asperity_engine::plan::Plan;
use asperity_engine::scene::{Override, Scene, presets};
use asperity_engine::sim::{Frame, Simulation, Stage};

const TOLERANCE: f64 = 1e-3;
const STEPS: usize = 8;

fn simulation(keys: &[&str], tolerance: f64) -> Simulation {
    let tolerance = format!("numerics.tolerance={tolerance:e}");
    let common = [
        "grid.nodes=65",
        "record=none",
        "stress=none",
        "life=none",
        "time.passages=1",
        "numerics.max_iterations=60",
        &tolerance,
    ];
    let overrides: Vec<Override> = common
        .iter()
        .chain(keys)
        .map(|text| text.parse().unwrap())
        .collect();
    let scene = Scene::load_with(presets::QUICK, &overrides).unwrap();
    let plan = Plan::new(&scene).unwrap();
    Simulation::new(&scene, plan, 1).unwrap()
}

/// Errors of pressure and film over the nodes pressed in `exact`.
fn errors(one: &Frame, exact: &Frame) -> (f64, f64) {
    let mut sums = [0.0; 4];
    for n in 0..exact.pressure_pa.len() {
        let (p, p0) = (
            f64::from(one.pressure_pa[n]),
            f64::from(exact.pressure_pa[n]),
        );
        sums[0] += (p - p0).abs();
        sums[1] += p0;
        if p0 > 0.0 {
            sums[2] += f64::from((one.film_m[n] - exact.film_m[n]).abs());
            sums[3] += f64::from(exact.film_m[n].max(1e-9));
        }
    }
    (sums[0] / sums[1], sums[2] / sums[3])
}

#[test]
fn converged_means_converged() {
    let cases: [&[&str]; 6] = [
        &[],
        &["body_2.surface.angle_deg=5"],
        &["motion.slide_roll=1.5"],
        &["motion.slide_roll=0", "motion.entrainment_m_s=0.05"],
        &["motion.entrainment_m_s=1e-2"],
        &["load.force_n=2000"],
    ];
    for keys in cases {
        let mut loose = simulation(keys, TOLERANCE);
        let mut tight = simulation(keys, 1e-6);
        while loose.stage() != Stage::Passage {
            loose.step().unwrap();
        }
        let (mut one, mut exact) = (Frame::default(), Frame::default());
        let (mut worst_p, mut worst_h) = (0.0_f64, 0.0_f64);
        for _ in 0..STEPS {
            tight.restore(&loose.save()).unwrap();
            loose.step().unwrap();
            tight.step().unwrap();
            assert!(
                loose.metrics().converged && tight.metrics().converged,
                "{keys:?}"
            );
            loose.fill(&mut one);
            tight.fill(&mut exact);
            let (p, h) = errors(&one, &exact);
            (worst_p, worst_h) = (worst_p.max(p), worst_h.max(h));
        }
        println!("{keys:?}: pressure {worst_p:.1e}, film {worst_h:.1e}");
        assert!(worst_p <= TOLERANCE, "{keys:?}: pressure {worst_p:e}");
        assert!(worst_h <= 10.0 * TOLERANCE, "{keys:?}: film {worst_h:e}");
    }
}
