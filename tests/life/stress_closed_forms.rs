//! The closed forms of subsurface stress against each other, against published maxima, and against
//! the equations of equilibrium. Every test prints the number that it asserts.

use super::patch::{point_harmonics, rectangle_harmonics};
use asperity_engine::physics::invariants::Stress6;
use asperity_engine::physics::stress_exact::{hertz_axis_maximum, hertz_sliding, westergaard};

const NU: f64 = 0.3;

/// Greatest of a function on [a, b] by golden section.
fn golden(a: f64, b: f64, f: impl Fn(f64) -> f64) -> (f64, f64) {
    let ratio = (5.0_f64.sqrt() - 1.0) / 2.0;
    let (mut a, mut b) = (a, b);
    while b - a > 1e-9 {
        let (c, d) = (b - ratio * (b - a), a + ratio * (b - a));
        if f(c) > f(d) {
            b = d;
        } else {
            a = c;
        }
    }
    (0.5 * (a + b), f(0.5 * (a + b)))
}

#[test]
fn hertz_maxima_are_the_published_ones() {
    let (z, value) = hertz_axis_maximum(0.3);
    println!("nu 0.30, mu 0:   {value:.6} p0 at z = {z:.4} a");
    assert!((value - 0.620041).abs() < 1e-6 && (z - 0.4809).abs() < 1e-4);

    let (z, value) = hertz_axis_maximum(0.25);
    println!("nu 0.25, mu 0:   {value:.6} p0 at z = {z:.4} a");
    assert!((value - 0.643357).abs() < 1e-6 && (z - 0.4643).abs() < 1e-4);

    let at = |x: f64, z: f64| hertz_sliding(x, 0.0, z, NU, 0.1).von_mises();
    let best_z = |x: f64| golden(0.3, 0.7, |z| at(x, z));
    let (x, value) = golden(0.0, 0.4, |x| best_z(x).1);
    let z = best_z(x).0;
    println!("nu 0.30, mu 0.1: {value:.6} p0 at x = {x:.4} a, z = {z:.4} a");
    assert!((value - 0.624444).abs() < 1e-5);
    assert!((x - 0.1116).abs() < 2e-4 && (z - 0.4749).abs() < 2e-4);
}

#[test]
fn hertz_meets_its_surface() {
    // σzz = −p and σxz = −μp inside the circle, 0 outside; z = 1e-7 stands for the surface.
    let mut worst: f64 = 0.0;
    for i in 0..40 {
        let r = 0.05 * i as f64 + 0.013;
        let p = (1.0 - r * r).max(0.0).sqrt();
        let s = hertz_sliding(r * 0.6, r * 0.8, 1e-7, NU, 0.2);
        worst = worst.max((s.zz + p).abs()).max((s.xz + 0.2 * p).abs());
    }
    println!("surface traction error {worst:.1e}");
    assert!(worst < 1e-6);
}

#[test]
fn hertz_is_in_equilibrium() {
    // div σ = 0 by central differences, second order in the step of 1e-3.
    let s = |x: f64, y: f64, z: f64| hertz_sliding(x, y, z, NU, 0.3);
    let d = 1e-3;
    let slope = |a: f64, b: f64| (a - b) / (2.0 * d);
    let mut worst: f64 = 0.0;
    for (x, y, z) in [
        (0.3, 0.2, 0.4),
        (-0.7, 0.9, 0.25),
        (1.4, -0.3, 1.1),
        (0.05, 0.0, 2.0),
    ] {
        let (xp, xm) = (s(x + d, y, z), s(x - d, y, z));
        let (yp, ym) = (s(x, y + d, z), s(x, y - d, z));
        let (zp, zm) = (s(x, y, z + d), s(x, y, z - d));
        let force_x = slope(xp.xx, xm.xx) + slope(yp.xy, ym.xy) + slope(zp.xz, zm.xz);
        let force_y = slope(xp.xy, xm.xy) + slope(yp.yy, ym.yy) + slope(zp.yz, zm.yz);
        let force_z = slope(xp.xz, xm.xz) + slope(yp.yz, ym.yz) + slope(zp.zz, zm.zz);
        worst = worst
            .max(force_x.abs())
            .max(force_y.abs())
            .max(force_z.abs());
    }
    println!("largest out-of-balance force {worst:.1e} p0/a");
    assert!(worst < 2e-5);
}

/// Stress under Hertz with sliding as a sum of point forces on rings; the radius is the sine of an
/// evenly divided angle, which removes the square-root edge.
fn hertz_by_points(x: f64, y: f64, z: f64, friction: f64) -> Stress6 {
    let (rings, spokes) = (600, 200);
    let ring_angle = std::f64::consts::FRAC_PI_2 / rings as f64;
    let spoke_angle = std::f64::consts::TAU / spokes as f64;
    let mut sum = Stress6::default();
    for i in 0..rings {
        let (r, p) = ((i as f64 + 0.5) * ring_angle).sin_cos();
        let area = r * p * ring_angle * spoke_angle;
        for j in 0..spokes {
            let (sin, cos) = ((j as f64 + 0.5) * spoke_angle).sin_cos();
            let h = point_harmonics(x - r * cos, y - r * sin, z);
            let s = h.normal(NU).plus(h.tangential_x(NU).times(friction));
            sum = sum.plus(s.times(p * area));
        }
    }
    sum
}

#[test]
fn hertz_is_the_sum_of_point_forces() {
    let mut worst: f64 = 0.0;
    for (x, y, z) in [
        (0.2, 0.1, 0.5),
        (-0.9, 0.7, 0.3),
        (1.5, 0.4, 1.0),
        (0.0, 0.0, 0.4),
    ] {
        let exact = hertz_sliding(x, y, z, NU, 0.25);
        worst = worst.max(exact.distance(hertz_by_points(x, y, z, 0.25)));
    }
    println!("Hertz against summed point forces {worst:.1e} p0");
    assert!(
        worst < 1e-5,
        "midpoint rule with 600 rings, second order: 5e-6"
    );
}

#[test]
fn rectangle_is_the_sum_of_point_forces() {
    let (hx, hy, n) = (0.3, 0.5, 60);
    let middle = |i: usize| 2.0 * (i as f64 + 0.5) / n as f64 - 1.0;
    let mut worst: f64 = 0.0;
    for (x, y, z) in [(0.1, 0.2, 0.4), (-0.6, 0.4, 0.3), (1.0, -0.9, 0.7)] {
        let mut sum = Stress6::default();
        for i in 0..n {
            for j in 0..n {
                let h = point_harmonics(x - hx * middle(i), y - hy * middle(j), z);
                let s = h.normal(NU).plus(h.tangential_x(NU).times(0.4));
                sum = sum.plus(s.times(4.0 * hx * hy / (n * n) as f64));
            }
        }
        let h = rectangle_harmonics(x, y, z, hx, hy);
        let exact = h.normal(NU).plus(h.tangential_x(NU).times(0.4));
        worst = worst.max(exact.distance(sum));
    }
    println!("rectangle against summed point forces {worst:.1e}");
    assert!(worst < 1e-4, "midpoint rule, 60 x 60, second order");
}

#[test]
fn strips_make_a_plane_wave() {
    // Rectangles of half-length 400 along y that carry p = cos kx at their middles: Westergaard, up
    // to the staircase (a sinc factor of 1 − (π/64)²/6 = 4e-4) and the ends 40 waves away.
    let k = std::f64::consts::TAU;
    let (strips, waves) = (64_i32, 40_i32);
    let width = 1.0 / f64::from(strips);
    let last = waves * strips;
    let mut worst: f64 = 0.0;
    for (x, z) in [(0.0, 0.1), (0.2, 0.3), (0.37, 0.05)] {
        let mut sum = Stress6::default();
        for i in -last..=last {
            let centre = f64::from(i) * width;
            let end = if i.abs() == last { 0.5 } else { 1.0 };
            let h = rectangle_harmonics(x - centre, 0.0, z, width / 2.0, 400.0);
            sum = sum.plus(h.normal(NU).times(end * (k * centre).cos()));
        }
        worst = worst.max(sum.distance(westergaard(x, z, k, NU)));
    }
    println!("strips against Westergaard {worst:.1e}");
    assert!(worst < 1e-3);
}
