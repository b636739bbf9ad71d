//! The greatest effective stress of a slice, between its nodes and depths.
//!
//! The greatest sample can be 1 % low. Below each of three neighbouring nodes the *components* are
//! interpolated in depth by a polynomial through six depths (they are smooth in `ln(1 + z/z0)`, the
//! coordinate in which the depths lie evenly; the effective stress has kinks), and the maximum over
//! depth is found by golden section; a parabola through the three maxima gives x.
//!
//! Source: Kiefer (1953), Proc. Am. Math. Soc. 4, 502-506, for the golden section. Ours: what is interpolated.

use super::depth::{stretched, unstretched};
use super::slice_out::{Peak, SliceOut};
use super::spec::StressSpec;
use crate::physics::invariants::Stress6;
use crate::scene::StressMeasure;

/// Depths in an interpolation: of order six, between Gauss's nodes.
const POINTS: usize = 6;

/// The measure of a state.
pub(super) fn measure_of(measure: StressMeasure, s: Stress6) -> f64 {
    match measure {
        StressMeasure::VonMises => s.von_mises(),
        StressMeasure::MaxShear => s.max_shear(),
        StressMeasure::Octahedral => s.octahedral_shear(),
    }
}

/// Refined maximum of a slice.
pub(super) fn refine(spec: &StressSpec, out: &SliceOut) -> Peak {
    let (mut best, mut top) = (0, 0.0);
    for (i, value) in out.effective.iter().enumerate() {
        if *value > top {
            (best, top) = (i, *value);
        }
    }
    let (k, i) = (best / spec.nx, best % spec.nx);
    let x_of = |i: f64| spec.x_first + spec.dx * i;
    let (z, value) = column_maximum(spec, out, k, i);
    if i == 0 || i + 1 == spec.nx {
        return Peak {
            value,
            x: x_of(i as f64),
            y: 0.0,
            z,
        };
    }
    let (before, after) = (
        column_maximum(spec, out, k, i - 1),
        column_maximum(spec, out, k, i + 1),
    );
    let curve = before.1 - 2.0 * value + after.1;
    let slope = 0.5 * (after.1 - before.1);
    let shift = if curve < 0.0 {
        (-slope / curve).clamp(-0.5, 0.5)
    } else {
        0.0
    };
    let parabola =
        |a: f64, b: f64, c: f64| b + shift * (0.5 * (c - a) + shift * 0.5 * (a - 2.0 * b + c));
    Peak {
        value: parabola(before.1, value, after.1),
        x: x_of(i as f64 + shift),
        y: 0.0,
        z: parabola(before.0, z, after.0),
    }
}

/// Depth and value of the maximum below node `i` between the depths next to `k`.
fn column_maximum(spec: &StressSpec, out: &SliceOut, k: usize, i: usize) -> (f64, f64) {
    let count = spec.depths.len();
    let points = POINTS.min(count);
    let first = (k + 1).saturating_sub(points / 2).min(count - points);
    let mut nodes = [0.0; POINTS];
    let mut states = [Stress6::default(); POINTS];
    for j in 0..points {
        nodes[j] = stretched(spec.depths[first + j]);
        states[j] = out.state((first + j) * spec.nx + i);
    }
    let value = |t: f64| {
        let s = interpolated(&nodes[..points], &states[..points], t);
        measure_of(spec.measure, s)
    };
    let low = stretched(spec.depths[k.saturating_sub(1)]);
    let high = stretched(spec.depths[(k + 1).min(count - 1)]);
    let t = golden(low, high, value);
    (unstretched(t), value(t))
}

/// Lagrange's polynomial.
fn interpolated(nodes: &[f64], states: &[Stress6], t: f64) -> Stress6 {
    let mut sum = Stress6::default();
    for (j, state) in states.iter().enumerate() {
        let mut weight = 1.0;
        for (m, node) in nodes.iter().enumerate() {
            if m != j {
                weight *= (t - node) / (nodes[j] - node);
            }
        }
        sum = sum.plus(state.times(weight));
    }
    sum
}

fn golden(low: f64, high: f64, value: impl Fn(f64) -> f64) -> f64 {
    let ratio = 0.618_033_988_749_894_9;
    let (mut low, mut high) = (low, high);
    for _ in 0..36 {
        let step = ratio * (high - low);
        if value(high - step) > value(low + step) {
            high = low + step;
        } else {
            low = high - step;
        }
    }
    0.5 * (low + high)
}
