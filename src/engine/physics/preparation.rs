//! What is done to a measured map before its level is taken off: a rim cut, the lay turned to the machine's axes, and the
//! areal Gaussian filters.
//!
//! ```text
//! turned      z'(q) = z(R(−θ) q), by cubic convolution, on the largest rectangle of the map's own shape; by 90, 180, 270 degrees exactly
//! low-pass    F(z) = z ∗ s,  s(x) = e^(−π (x/αλ)²)/(αλ) along each side,  α = √(ln 2/π):  transmission 2^(−(λ/w)²) of a wave w
//! ends        of a map that stands once F(z)/F(1): the weights that lie within
//! on a mesh   C(z):  all of waves of w ≥ 3 nodes, nothing of w ≤ 2,  ½ + ½ cos 6π(1/w − 1/3) between, along each side
//! S-filter    z → F(z) with λ_S, before the level;      L-filter    z → z − F(z) with λ_L, after it
//! ```
//! Pixels are the unit of lengths. A wave along the diagonal of a map passes the filter by its own length, as along a side: the
//! weights of both sides multiply to those of a circle. Waves shorter than two pixels there are none.
//! Source: ISO 16610-61 (areal Gaussian filter), ISO 25178-2 and -3 (S-filter, F-operation, L-filter, in that order); cubic
//! convolution after Keys (1981). Ours: the rectangle, and the ends by the weights within (ISO 16610-28 has it as an option).

use std::f64::consts::PI;

use realfft::RealFftPlanner;

use super::height_map::{HeightMap, MapEdge};

/// A map with another number of columns.
pub type Turned = (usize, Vec<f64>);

/// Less so many pixels on each side; `None`: fewer than four are left.
pub fn cropped(nx: usize, z: &[f64], rim: usize) -> Option<Turned> {
    let ny = z.len() / nx.max(1);
    let [wide, high] = [nx, ny].map(|n| n.saturating_sub(2 * rim));
    let rows = z.chunks(nx).skip(rim).take(high);
    let left = rows.flat_map(|row| row[rim..rim + wide].iter().copied());
    (wide >= 4 && high >= 4).then(|| (wide, left.collect()))
}

/// Turned by `degrees` from x towards y; `None`: fewer than four pixels a side are left.
pub fn turned(nx: usize, z: &[f64], degrees: f64) -> Option<Turned> {
    let ny = z.len() / nx.max(1);
    let quarters = (degrees / 90.0).rem_euclid(4.0);
    if quarters.fract() == 0.0 {
        return Some(by_quarters(nx, ny, z, quarters as usize));
    }
    let (sin, cos) = degrees.to_radians().sin_cos();
    let [wide, high] = [nx, ny].map(|n| (n - 1) as f64);
    // A pixel on each side is for the interpolation.
    let share = |along: f64, across: f64| (along - 2.0) / (along * cos.abs() + across * sin.abs());
    let share = share(wide, high).min(share(high, wide));
    let sides = [wide, high].map(|side| (share * side).floor() as usize + 1);
    if sides.iter().any(|side| *side < 4) {
        return None;
    }
    let place = |k: usize, n: usize| k as f64 - 0.5 * (n - 1) as f64;
    let mut out = Vec::with_capacity(sides[0] * sides[1]);
    for j in 0..sides[1] {
        for i in 0..sides[0] {
            let (x, y) = (place(i, sides[0]), place(j, sides[1]));
            out.push(sampled(nx, ny, z, [cos * x + sin * y, cos * y - sin * x]));
        }
    }
    Some((sides[0], out))
}

fn by_quarters(nx: usize, ny: usize, z: &[f64], quarters: usize) -> Turned {
    let at = |i: usize, j: usize| z[j * nx + i];
    let sides = if quarters.is_multiple_of(2) {
        [nx, ny]
    } else {
        [ny, nx]
    };
    let mut out = Vec::with_capacity(z.len());
    for j in 0..sides[1] {
        for i in 0..sides[0] {
            out.push(match quarters {
                0 => at(i, j),
                1 => at(j, ny - 1 - i),
                2 => at(nx - 1 - i, ny - 1 - j),
                _ => at(nx - 1 - j, i),
            });
        }
    }
    (sides[0], out)
}

/// Between the pixels, from the middle of the map.
fn sampled(nx: usize, ny: usize, z: &[f64], [x, y]: [f64; 2]) -> f64 {
    let ((i, along), (j, across)) = (HeightMap::stencil(x, nx), HeightMap::stencil(y, ny));
    let held = |k: i64, n: usize| k.clamp(0, n as i64 - 1) as usize;
    let mut sum = 0.0;
    for (b, v) in (0..).zip(across) {
        let row = &z[held(j + b, ny) * nx..][..nx];
        let of_row: f64 = (0..)
            .zip(along)
            .map(|(a, u)| u * row[held(i + a, nx)])
            .sum();
        sum += v * of_row;
    }
    sum
}

/// F(z) with a cut-off of so many pixels.
pub fn low_pass(nx: usize, z: &[f64], beyond: MapEdge, cut_off: f64) -> Vec<f64> {
    let ny = z.len() / nx.max(1);
    let mut once = z.to_vec();
    smooth_rows(&mut once, nx, beyond, cut_off);
    let mut across = transposed(&once, nx, ny);
    smooth_rows(&mut across, ny, beyond, cut_off);
    transposed(&across, ny, nx)
}

/// The transpose of rows of `nx`.
fn transposed(z: &[f64], nx: usize, ny: usize) -> Vec<f64> {
    let columns = (0..nx).flat_map(|i| (0..ny).map(move |j| z[j * nx + i]));
    columns.collect()
}

/// The Gaussian of one side: of a map that stands once by the weights that lie within.
fn smooth_rows(z: &mut [f64], n: usize, beyond: MapEdge, cut_off: f64) {
    // Beyond λ the weights are 1e-6 of the greatest and below.
    let padded = match beyond {
        MapEdge::Periodic => n,
        MapEdge::Windowed => n + cut_off.ceil().min(n as f64) as usize + 1,
    };
    let passes = |waves: f64| 2.0_f64.powf(-(cut_off * waves).powi(2));
    let mut within = vec![1.0; n];
    filter_rows(&mut within, n, padded, passes);
    filter_rows(z, n, padded, passes);
    for row in z.chunks_mut(n) {
        for (z, within) in row.iter_mut().zip(&within) {
            *z /= within;
        }
    }
}

/// Less what nodes so many pixels apart along x and y can't carry, and would take for longer waves: C(z) along each side, of waves
/// as wide as w nodes.
pub fn carried(nx: usize, z: &[f64], [along, across]: [f64; 2]) -> Vec<f64> {
    let passes = |apart: f64| {
        move |waves: f64| {
            let of_node = (waves * apart).clamp(1.0 / 3.0, 0.5);
            0.5 + 0.5 * (6.0 * PI * (of_node - 1.0 / 3.0)).cos()
        }
    };
    let mut z = z.to_vec();
    if along > 1.0 {
        filter_rows(&mut z, nx, nx, passes(along));
    }
    if across > 1.0 {
        let ny = z.len() / nx.max(1);
        let mut columns = transposed(&z, nx, ny);
        filter_rows(&mut columns, ny, ny, passes(across));
        z = transposed(&columns, ny, nx);
    }
    z
}

/// Multiplies every wave of rows of `n`, with zeros up to `padded`, by what `passes` of so many waves a pixel.
fn filter_rows(z: &mut [f64], n: usize, padded: usize, passes: impl Fn(f64) -> f64) {
    let mut planner = RealFftPlanner::new();
    let (forth, back) = (
        planner.plan_fft_forward(padded),
        planner.plan_fft_inverse(padded),
    );
    let (mut line, mut bins) = (forth.make_input_vec(), forth.make_output_vec());
    let passes: Vec<f64> = (0..bins.len())
        .map(|k| passes(k as f64 / padded as f64) / padded as f64)
        .collect();
    for row in z.chunks_mut(n) {
        line[..n].copy_from_slice(row);
        line[n..].fill(0.0);
        // Lengths are those of the plan: neither can fail.
        let _ = forth.process(&mut line, &mut bins);
        for (bin, passes) in bins.iter_mut().zip(&passes) {
            *bin *= *passes;
        }
        let _ = back.process(&mut bins, &mut line);
        row.copy_from_slice(&line[..n]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use std::f64::consts::{LN_2, TAU};

    fn wave(nx: usize, ny: usize, [along, across]: [f64; 2]) -> Vec<f64> {
        let phase = |n: usize| along * (n % nx) as f64 + across * (n / nx) as f64;
        (0..nx * ny).map(|n| (TAU * phase(n)).cos()).collect()
    }

    /// Half of a wave as long as the cut-off passes, along a side and along the diagonal; of one twice as long 2^(−1/4), of one
    /// half as long 2^(−4).
    #[test]
    fn a_wave_passes_by_its_length() {
        let (nx, ny) = (64, 48);
        for waves in [
            [4.0 / 64.0, 0.0],
            [0.0, 3.0 / 48.0],
            [8.0 / 64.0, 6.0 / 48.0],
        ] {
            let z = wave(nx, ny, waves);
            let length = 1.0 / waves[0].hypot(waves[1]);
            for (cut_off, passes) in [
                (length, 0.5),
                (0.5 * length, 0.5_f64.powf(0.25)),
                (2.0 * length, 0.0625),
            ] {
                let found = low_pass(nx, &z, MapEdge::Periodic, cut_off);
                for (found, z) in found.iter().zip(&z) {
                    assert!((found - passes * z).abs() < 1e-12, "{waves:?} {cut_off}");
                }
            }
        }
    }

    /// All of a wave of four nodes, half of one of 2.4 and nothing of two and fewer, along a side by the nodes of that side.
    #[test]
    fn a_mesh_carries_waves_of_three_nodes() {
        let (nx, ny) = (96, 48);
        for (nodes, left) in [(4.0, 1.0), (2.4, 0.5), (2.0, 0.0), (1.5, 0.0)] {
            for (waves, apart) in [
                ([0.25, 0.0], [4.0 / nodes, 1.0]),
                ([0.0, 0.25], [1.0, 4.0 / nodes]),
            ] {
                let z = wave(nx, ny, waves);
                let found = carried(nx, &z, apart);
                for (found, z) in found.iter().zip(&z) {
                    assert!((found - left * z).abs() < 1e-12, "{nodes} {waves:?}");
                }
            }
        }
    }

    /// By the sum of the weights as the standard has them, ends too, and a plane's middle as it was.
    #[test]
    fn the_weights_are_those_of_the_standard() {
        let (nx, cut_off) = (41, 8.0);
        let z: Vec<f64> = (0..nx * nx).map(|n| ((n * 7919) % 101) as f64).collect();
        let found = low_pass(nx, &z, MapEdge::Windowed, cut_off);
        let alpha = (LN_2 / PI).sqrt();
        let weight = |d: f64| (-PI * (d / (alpha * cut_off)).powi(2)).exp();
        for (i, j) in [(0, 0), (20, 20), (40, 3), (11, 39)] {
            let (mut sum, mut norm) = (0.0, 0.0);
            for l in 0..nx {
                for k in 0..nx {
                    let w = weight(k as f64 - i as f64) * weight(l as f64 - j as f64);
                    sum += w * z[l * nx + k];
                    norm += w;
                }
            }
            assert_relative_eq!(found[j * nx + i], sum / norm, max_relative = 1e-6);
        }
    }

    /// Ridges across a direction of 30 degrees stand across x once they are turned back; by quarters nothing is interpolated.
    #[test]
    fn ridges_turn_with_the_map() {
        let (nx, ny) = (161, 121);
        let (sin, cos) = 30_f64.to_radians().sin_cos();
        let length = 24.0;
        let middle = [0.5 * (nx - 1) as f64, 0.5 * (ny - 1) as f64];
        let way =
            |n: usize| ((n % nx) as f64 - middle[0]) * cos + ((n / nx) as f64 - middle[1]) * sin;
        let z: Vec<f64> = (0..nx * ny)
            .map(|n| (TAU * way(n) / length).cos())
            .collect();
        let Some((wide, found)) = turned(nx, &z, -30.0) else {
            panic!("nothing left")
        };
        let high = found.len() / wide;
        assert!(wide > 80 && high > 60, "{wide} x {high}");
        for (n, found) in found.iter().enumerate() {
            let x = (n % wide) as f64 - 0.5 * (wide - 1) as f64;
            assert!((found - (TAU * x / length).cos()).abs() < 2e-3, "{n}");
        }
        let small: Vec<f64> = (0..20).map(f64::from).collect();
        let quarter = turned(5, &small, 90.0).unwrap_or_default();
        // The first column, its end at +y first, is the first row: x goes to y.
        assert_eq!(
            (quarter.0, &quarter.1[..4]),
            (4, &[15.0, 10.0, 5.0, 0.0][..])
        );
        let (mut nx, mut whole) = (5, small.clone());
        for _ in 0..4 {
            (nx, whole) = turned(nx, &whole, -90.0).unwrap_or_default();
        }
        assert_eq!((nx, whole), (5, small.clone()));
        assert_eq!(cropped(5, &small, 1), None);
        assert_eq!(cropped(5, &small, 0), Some((5, small)));
    }
}
