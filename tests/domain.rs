//! What truncating the domain costs: the measurement behind the plan's rule for inlet and width.
//!
//! Smooth circular contacts at one spacing, dx = 6/64, so that only the edges differ; the reference
//! has its inlet at −9 a and its sides at ±5 a. Printed by
//! `cargo test --release --test domain -- --ignored --nocapture`.

mod contact;

use asperity::math::grid::{Grid, Symmetry};
use asperity::solve::march::{Conditions, Flow, Guess, March};
use contact::{CIRCLE, Case, Fluid, LOAD, TOLERANCE, central, minimum};

const DX: f64 = 6.0 / 64.0;

/// Central and minimum film of a smooth contact with the inlet and half-width given, in nodes.
fn films(case: &Case, inlet: usize, half: usize) -> (f64, f64) {
    let outlet = 16;
    let grid = Grid {
        nx: inlet + outlet + 1,
        ny: half + 1,
        x_min: -(inlet as f64) * DX,
        dx: DX,
        y_first: 0.0,
        dy: DX,
        symmetry: Symmetry::MirrorY,
    };
    let steps = grid.nx;
    let guess = 1.2 * case.lambda.powf(0.67);
    let mut march = March::from_hertz(grid, &CIRCLE, guess, 1.0, Flow::Film);
    let conditions = Conditions {
        medium: &case.medium,
        law: None,
        load: LOAD,
        tolerance: TOLERANCE,
    };
    for _ in 0..steps {
        let _ = march.attempt(&conditions, 1.0, Guess::Extrapolated);
        march.commit(1.0);
    }
    (central(&march), minimum(&march))
}

#[test]
#[ignore = "a measurement of minutes, whose results stand in src/plan/domain.rs"]
fn errors_of_truncation() {
    for l in [2.0, 5.0, 10.0, 20.0] {
        for m in [5.0, 10.0, 20.0, 50.0, 100.0, 200.0] {
            let case = Case::moes(m, l, Fluid::BarusIncompressible, (-4.5, 1.5, 3.0));
            let far = films(&case, 96, 53);
            print!("M {m} L {l} H_c {:.4} h_min {:.4} inlet", far.0, far.1);
            for inlet in [20, 22, 24, 27, 32, 37, 43, 48, 64] {
                let near = films(&case, inlet, 53);
                let x = inlet as f64 * DX;
                print!(
                    " {x:.2}:{:.5}/{:.5}",
                    near.0 / far.0 - 1.0,
                    near.1 / far.1 - 1.0
                );
            }
            print!(" half");
            for half in [16, 18, 22, 27, 32, 43] {
                let near = films(&case, 96, half);
                let y = half as f64 * DX;
                print!(
                    " {y:.2}:{:.5}/{:.5}",
                    near.0 / far.0 - 1.0,
                    near.1 / far.1 - 1.0
                );
            }
            println!();
        }
    }
}
