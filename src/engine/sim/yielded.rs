//! What has flowed for good: the depth that each body's surface has yielded by, material-fixed.
//!
//! ```text
//! z_i(x, t) = relief − w_i(x − X_i(t), y)        X_i: distance travelled by body i;  w_i ≥ 0 in columns of its own material
//! after a step   w_i += share_i w                the step's w (`solve/yielding.rs`) at the places of the columns
//! share          the softer body's 1; bodies of one hardness 1/2 each
//! ```
//! *Extent.* A body whose relief repeats along x (or is the same all along it) has a ring of so many whole waves as fill
//! the domain: what flowed leaves at the outlet and comes back one round later, as a tooth or a race comes back after a
//! revolution, so that the second round finds the crests that the first has left. A body without a repeat (smooth, a
//! map that stands once, waves that are oblique, or one longer than [`LONGEST`] domains) keeps what flowed while it is
//! in the domain; what enters is virgin.
//!
//! Columns and nodes are interpolated by cubics, not below zero; a column keeps its material, so nothing is worn down by
//! being moved. What the interpolation misses, some 1e-3 of the depth, flows in the steps that follow.
//!
//! *Amplitudes that are turned.* w belongs to the amplitude A_w at which it flowed. Below it the whole surface is scaled as
//! it has become, w by A/A_w: a ripple that is turned away takes its flattened crests along and leaves no dents behind.
//! Above it w stays, the crests are higher by what the relief has gained, and flow on by themselves. Where nothing flows
//! meanwhile the return finds the same surface. A smooth body, whose dents are the other's doing, has no amplitude and
//! keeps them. The volume that is told has flowed, whatever became of the amplitude since.

use serde::{Deserialize, Serialize};

use super::motion::BodyTravel;
use super::worn::{around, of_coarser};
use crate::math::grid::Grid;
use crate::physics::height_map::HeightMap;
use crate::saved::saved;

/// Longest ring, in domains.
const LONGEST: f64 = 8.0;

/// What both bodies have yielded; a body that is harder than the other has nothing.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Yielded {
    skins: [Option<Skin>; 2],
}

saved! {
    Yielded { parts: skins; }
}

/// One body's.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct Skin {
    /// Length of the ring, in a.
    length: f64,
    /// Whether material that has left comes back as it left; else what enters is virgin.
    returns: bool,
    columns: usize,
    /// w_i, film units, shape ny × columns.
    depth: Vec<f64>,
    /// Its share of what flows.
    share: f64,
    /// What has flowed since the start, ∬ w.
    volume: f64,
    /// Distance that the body had travelled when it was looked at last.
    #[serde(rename = "way")]
    distance: f64,
    /// A_w, film units; 0: the body is smooth, or nothing has flowed.
    amplitude: f64,
}

saved! {
    Skin {
        same: length, returns, columns, share;
        parts: depth;
        free: volume, distance, amplitude;
    }
    holds |_, saved| {
        saved.volume >= 0.0 && saved.amplitude >= 0.0 && saved.depth.iter().all(|w| *w >= 0.0)
    }
}

impl Yielded {
    /// Nothing yet; `softer`: which bodies yield; `repeats`: length after which a relief repeats, in a (infinite: it is
    /// the same all along; `None`: it does not).
    pub(super) fn new(grid: &Grid, softer: [bool; 2], repeats: [Option<f64>; 2]) -> Self {
        let share = if softer == [true; 2] { 0.5 } else { 1.0 };
        let skins =
            [0, 1].map(|body: usize| softer[body].then(|| Skin::new(grid, repeats[body], share)));
        Self { skins }
    }

    /// What body 1 and 2 have yielded since the start, ∬ w in film units times a².
    pub(super) fn volumes(&self) -> [f64; 2] {
        let volume = |skin: &Option<Skin>| skin.as_ref().map_or(0.0, |skin| skin.volume);
        [volume(&self.skins[0]), volume(&self.skins[1])]
    }

    /// Lowers the heights of body `body`, whose relief has an amplitude, by what has flowed.
    pub(super) fn lower(
        &self,
        grid: &Grid,
        body: usize,
        travel: BodyTravel,
        amplitude: f64,
        heights: &mut [f64],
    ) {
        if let Some(skin) = &self.skins[body]
            && skin.volume > 0.0
        {
            skin.lower(grid, travel.travelled, skin.scale(amplitude), heights);
        }
    }

    /// Takes what a step has yielded, with the bodies where the step has brought them and their amplitudes; whether
    /// anything has.
    pub(super) fn take(
        &mut self,
        grid: &Grid,
        yielded: &[f64],
        travels: [BodyTravel; 2],
        amplitudes: [f64; 2],
    ) -> bool {
        let volume = grid.integrate(|n| yielded[n]);
        for ((skin, travel), amplitude) in self.skins.iter_mut().zip(travels).zip(amplitudes) {
            let Some(skin) = skin else { continue };
            skin.renew(grid, travel.travelled);
            if volume > 0.0 {
                skin.volume += skin.share * volume;
                skin.belong_to(amplitude);
                skin.deepen(grid, yielded);
            }
        }
        volume > 0.0
    }
}

impl Yielded {
    /// Takes over what has flowed on a coarser grid of the same domain.
    pub(super) fn take_over(&mut self, grid: &Grid, coarser: &Self, coarse: &Grid) {
        for pair in self.skins.iter_mut().zip(&coarser.skins) {
            if let (Some(own), Some(other)) = pair {
                own.take_over(grid, other, coarse);
            }
        }
    }
}

impl Skin {
    /// Column by column, between the coarser one's rows linear; what lies outside of the domain on a body whose relief
    /// does not come back is virgin.
    fn take_over(&mut self, grid: &Grid, coarser: &Self, coarse: &Grid) {
        (self.volume, self.distance) = (coarser.volume, coarser.distance);
        self.amplitude = coarser.amplitude;
        for c in 0..self.columns {
            let material = c as f64 * self.spacing();
            let round = (material + self.distance - grid.x_min).rem_euclid(self.length);
            let is_known = self.returns || round <= coarse.dx * (coarse.nx - 1) as f64;
            // By its place in the domain: rings that do not come back are of another length.
            let place = if self.returns {
                material
            } else {
                round + grid.x_min - self.distance
            };
            let place = around(place / coarser.spacing(), coarser.columns);
            for j in 0..grid.ny {
                let w = of_coarser(&coarser.depth, coarser.columns, place, (j, grid.ny));
                self.depth[j * self.columns + c] = if is_known { w.max(0.0) } else { 0.0 };
            }
        }
    }

    fn new(grid: &Grid, repeat: Option<f64>, share: f64) -> Self {
        let domain = grid.dx * (grid.nx - 1) as f64;
        let ring = match repeat {
            Some(wave) if wave.is_finite() => wave * (domain / wave).ceil(),
            _ => domain,
        };
        let returns = repeat.is_some() && ring <= LONGEST * domain;
        // What is virgin at the inlet must not be the outlet's last column.
        let length = if returns {
            ring
        } else {
            domain + 2.0 * grid.dx
        };
        let columns = (length / grid.dx).round().max(4.0) as usize;
        Self {
            length,
            returns,
            columns,
            depth: vec![0.0; grid.ny * columns],
            share,
            volume: 0.0,
            distance: 0.0,
            amplitude: 0.0,
        }
    }

    /// What is left of w at an amplitude.
    fn scale(&self, amplitude: f64) -> f64 {
        if amplitude < self.amplitude {
            amplitude / self.amplitude
        } else {
            1.0
        }
    }

    /// From now on w is that of this amplitude.
    fn belong_to(&mut self, amplitude: f64) {
        let scale = self.scale(amplitude);
        if scale < 1.0 {
            self.depth.iter_mut().for_each(|w| *w *= scale);
        }
        self.amplitude = amplitude;
    }

    fn spacing(&self) -> f64 {
        self.length / self.columns as f64
    }

    fn lower(&self, grid: &Grid, distance: f64, scale: f64, heights: &mut [f64]) {
        let n = self.columns;
        for i in 0..grid.nx {
            let (columns, weights) = around((grid.x(i) - distance) / self.spacing(), n);
            for (j, row) in heights.chunks_exact_mut(grid.nx).enumerate() {
                let depth = &self.depth[j * n..(j + 1) * n];
                let pairs = columns.iter().zip(weights);
                let w: f64 = pairs.map(|(&k, weight)| weight * depth[k]).sum();
                row[i] -= scale * w.max(0.0);
            }
        }
    }

    /// The body has come to `distance`: what has left the domain is forgotten where it does not come back.
    fn renew(&mut self, grid: &Grid, distance: f64) {
        let n = self.columns;
        let (before, spacing) = (self.distance, self.spacing());
        self.distance = distance;
        if self.returns {
            return;
        }
        let round = |c: usize, distance: f64| {
            ((c as f64 * spacing + distance - grid.x_min) / self.length).floor()
        };
        for c in (0..n).filter(|&c| round(c, distance) != round(c, before)) {
            self.depth
                .iter_mut()
                .skip(c)
                .step_by(n)
                .for_each(|w| *w = 0.0);
        }
    }

    /// Adds its share of what a step has yielded, at the places of its columns.
    fn deepen(&mut self, grid: &Grid, yielded: &[f64]) {
        let (n, nx) = (self.columns, grid.nx);
        let middle = 0.5 * (nx - 1) as f64;
        for c in 0..n {
            let place = c as f64 * self.spacing() + self.distance - grid.x_min;
            let node = place.rem_euclid(self.length) / grid.dx;
            let (first, weights) = HeightMap::stencil(node - middle, nx);
            let Some(first) = usize::try_from(first).ok().filter(|first| first + 4 <= nx) else {
                continue;
            };
            for (j, row) in yielded.chunks_exact(nx).enumerate() {
                let near = row[first..first + 4].iter().zip(weights);
                let w: f64 = near.map(|(w, weight)| weight * w).sum();
                self.depth[j * n + c] += self.share * w.max(0.0);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::grid::Symmetry;

    fn travel(travelled: f64) -> BodyTravel {
        BodyTravel {
            travelled,
            in_passage: None,
        }
    }

    /// A smooth spot at `x`.
    fn spot(grid: &Grid, x: f64) -> Vec<f64> {
        let depth = |n: usize| {
            let r2 = (grid.x(n % grid.nx) - x).powi(2) + grid.y(n / grid.nx).powi(2);
            1e-3 * (1.0 - 4.0 * r2).max(0.0).powi(2)
        };
        (0..grid.len()).map(depth).collect()
    }

    #[test]
    fn what_flows_moves_with_its_body() {
        let grid = Grid::new(65, -3.0, 2.0, 2.0, Symmetry::MirrorY);
        for (repeats, back) in [(Some(0.7), true), (None, false)] {
            let mut yielded = Yielded::new(&grid, [true, false], [repeats; 2]);
            yielded.take(&grid, &spot(&grid, -1.0), [travel(0.33); 2], [0.0; 2]);
            let round = yielded.skins[0].as_ref().map_or(0.0, |skin| skin.length);
            let seen = |yielded: &Yielded, travelled: f64, x: f64| {
                let mut heights = vec![0.0; grid.len()];
                yielded.lower(&grid, 0, travel(travelled), 0.0, &mut heights);
                let there = spot(&grid, x);
                let off = heights.iter().zip(&there).map(|(z, w)| (z + w).abs());
                off.fold(0.0, f64::max) / 1e-3
            };
            // Interpolated twice: 2 % of the spot, whose half-width is six nodes.
            assert!(seen(&yielded, 0.33, -1.0) < 0.02);
            assert!(seen(&yielded, 1.07, -0.26) < 0.02);
            // Out of the domain, and round again.
            let nothing = vec![0.0; grid.len()];
            for k in 1..=40 {
                let travelled = 0.33 + round * f64::from(k) / 40.0;
                yielded.take(&grid, &nothing, [travel(travelled); 2], [0.0; 2]);
            }
            let off = seen(&yielded, 0.33 + round, -1.0);
            assert_eq!(off < 0.02, back, "{off}");
            let [one, two] = yielded.volumes();
            let whole = grid.integrate(|n| spot(&grid, -1.0)[n]);
            assert!((one / whole - 1.0).abs() < 1e-12 && two == 0.0);
        }
    }

    #[test]
    fn a_surface_that_is_turned_down_takes_along_what_has_flowed() {
        let grid = Grid::new(33, -3.0, 2.0, 2.0, Symmetry::MirrorY);
        let mut yielded = Yielded::new(&grid, [true, true], [Some(0.7); 2]);
        let deepest = |yielded: &Yielded, body: usize, amplitude: f64| {
            let mut heights = vec![0.0; grid.len()];
            yielded.lower(&grid, body, travel(0.0), amplitude, &mut heights);
            heights.into_iter().fold(0.0, f64::min)
        };
        // Body 2 is smooth.
        let (spot, at_rest) = (spot(&grid, 0.0), [travel(0.0); 2]);
        yielded.take(&grid, &spot, at_rest, [2.0, 0.0]);
        let whole = deepest(&yielded, 0, 2.0);
        assert!(whole < 0.0);
        for (amplitude, left) in [(3.0, 1.0), (2.0, 1.0), (1.0, 0.5), (0.0, 0.0)] {
            let off = deepest(&yielded, 0, amplitude) - left * whole;
            assert!(off.abs() < 1e-15, "{amplitude}");
            assert_eq!(deepest(&yielded, 1, 0.0), whole);
        }
        // What flows at half the amplitude comes to what is left at that amplitude, and stays as it rises.
        yielded.take(&grid, &spot, at_rest, [1.0, 0.0]);
        for amplitude in [1.0, 2.0] {
            let off = deepest(&yielded, 0, amplitude) - 1.5 * whole;
            assert!(off.abs() < 1e-12 * whole.abs(), "{off:e}");
        }
        assert_eq!(deepest(&yielded, 1, 0.0), 2.0 * whole);
    }
}
