//! The film as an optical rig shows it, in three lights: one implementation for the screen, for pictures and for
//! the recording.
//!
//! ```text
//! I(λ) = ½ [1 − cos(κ h) V],   κ = 4π n/λ
//! V    = exp(−(h/h_c)²) exp(−(κ Δ)²/24)
//! ```
//! h film, n = 1.5 of the oil. Light that steel reflects is turned by half a wave against that of the glass, so
//! contact is dark (Foord, Wedeven, Westlake and Cameron 1969). The first factor of V is the coherence of white
//! light through filters: fringes fade with their order. The second is the mean over a cell in which the film
//! rises by Δ from side to side: seen through a round spot of the cell's variance Δ²/12, fringes that are narrower
//! than the cell turn grey instead of into chance colours.

use std::f32::consts::PI;

/// Refractive index of the oil.
pub const REFRACTIVE_INDEX: f32 = 1.5;
/// Wavelengths of red, green and blue light, nm.
pub const LIGHTS_NM: [f32; 3] = [640.0, 540.0, 450.0];
/// Film at which the coherence has fallen to 1/e, m.
const COHERENCE_M: f32 = 0.7e-6;
/// Thickest film of its legend, m.
pub const TOP_M: f32 = 1e-6;
/// Film beyond which no fringe is left (V < 10⁻³), m.
const GREY_M: f32 = 1.9e-6;

/// Brightness, 0 to 1, in red, green and blue of a film (m) that rises by so much (m) over the cell.
fn brightness(film_m: f32, rise_m: f32) -> [f32; 3] {
    if film_m.is_nan() || film_m > GREY_M {
        return [0.5; 3];
    }
    let film_m = film_m.max(0.0);
    let coherence = (-(film_m / COHERENCE_M).powi(2)).exp();
    LIGHTS_NM.map(|wave_nm| {
        let wavenumber = 4.0 * PI * REFRACTIVE_INDEX / (wave_nm * 1e-9);
        let seen = coherence * (-(wavenumber * rise_m).powi(2) / 24.0).exp();
        0.5 * (1.0 - (wavenumber * film_m).cos() * seen)
    })
}

fn bytes(brightness: [f32; 3]) -> [u8; 3] {
    brightness.map(|part| (255.0 * part).round() as u8)
}

/// Colour of a film (m) that rises by so much (m) over the cell.
pub fn colour(film_m: f32, rise_m: f32) -> [u8; 3] {
    bytes(brightness(film_m, rise_m))
}

/// A film at the nodes of a grid, m.
#[derive(Debug, Clone, Copy)]
pub struct Film<'a> {
    nodes: &'a [f32],
    size: [usize; 2],
}

impl<'a> Film<'a> {
    /// Nodes row by row; `None` where they are not nx times ny, or none.
    pub fn new(nodes: &'a [f32], nx: usize, ny: usize) -> Option<Self> {
        let whole = nx > 0 && ny > 0 && nodes.len() == nx * ny;
        whole.then_some(Self {
            nodes,
            size: [nx, ny],
        })
    }

    /// Mean colour of a cell that reaches so far along x and y, in nodes: over parts no wider than a node, in each of
    /// which the film is a plane.
    pub fn cell(&self, x: [f64; 2], y: [f64; 2]) -> [u8; 3] {
        let parts = [x, y].map(|[from, to]| (to - from).abs().ceil().max(1.0));
        let width = [(x[1] - x[0]) / parts[0], (y[1] - y[0]) / parts[1]];
        let mut sum = [0.0_f32; 3];
        for j in 0..parts[1] as usize {
            for i in 0..parts[0] as usize {
                let at = [
                    x[0] + width[0] * (i as f64 + 0.5),
                    y[0] + width[1] * (j as f64 + 0.5),
                ];
                let (film_m, slope) = self.plane(at);
                let rise_m = (slope[0] * width[0] as f32).hypot(slope[1] * width[1] as f32);
                let part = brightness(film_m, rise_m);
                sum = [0, 1, 2].map(|k: usize| sum[k] + part[k]);
            }
        }
        let all = (parts[0] * parts[1]) as f32;
        bytes(sum.map(|part| part / all))
    }

    /// Film at a place between nodes, and its rise per node along x and y.
    fn plane(&self, at: [f64; 2]) -> (f32, [f32; 2]) {
        let near = |axis: usize| {
            let last = self.size[axis] - 1;
            let place = at[axis].clamp(0.0, last as f64);
            let low = (place as usize).min(last.saturating_sub(1));
            (low, (low + 1).min(last), (place - low as f64) as f32)
        };
        let ((i0, i1, u), (j0, j1, v)) = (near(0), near(1));
        let node = |i: usize, j: usize| self.nodes[j * self.size[0] + i];
        let (a, b, c, d) = (node(i0, j0), node(i1, j0), node(i0, j1), node(i1, j1));
        let (low, high) = (a + (b - a) * u, c + (d - c) * u);
        let along = (b - a) * (1.0 - v) + (d - c) * v;
        (low + (high - low) * v, [along, high - low])
    }
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "tests")]
    use super::*;

    #[test]
    fn contact_is_dark_and_the_first_green_fringe_is_at_a_quarter_wave() {
        assert_eq!(colour(0.0, 0.0), [0, 0, 0]);
        let quarter_m = LIGHTS_NM[1] * 1e-9 / (4.0 * REFRACTIVE_INDEX);
        assert!(colour(quarter_m, 0.0)[1] > 250);
        // Far out all three lights are equally bright: white light shows no fringe.
        for film_m in [1.85e-6, 5e-6] {
            assert!(colour(film_m, 0.0).iter().all(|&c| c.abs_diff(128) <= 1));
        }
    }

    #[test]
    fn a_cell_has_the_mean_colour_of_its_film() {
        // A wedge of 30 nm a node: six nodes to a fringe.
        let (nx, ny) = (41, 5);
        let nodes: Vec<f32> = (0..nx * ny).map(|at| 30e-9 * (at % nx) as f32).collect();
        let film = Film::new(&nodes, nx, ny).unwrap();
        for (from, to) in [(3.0, 3.5), (3.0, 5.0), (8.0, 17.0)] {
            let fine = 4000;
            let mut mean = [0.0_f32; 3];
            for k in 0..fine {
                let x = from + (to - from) * (k as f64 + 0.5) / f64::from(fine);
                let point = brightness(30e-9 * x as f32, 0.0);
                mean = [0, 1, 2].map(|c: usize| mean[c] + point[c] / fine as f32);
            }
            let cell = film.cell([from, to], [1.0, 2.0]);
            for (seen, exact) in cell.iter().zip(bytes(mean)) {
                assert!(seen.abs_diff(exact) <= 3, "{from}..{to}: {cell:?}, {exact}");
            }
        }
    }

    #[test]
    fn outside_the_contact_is_no_confetti() {
        // A gap that grows by two fringes a node and more: chance colours if it were sampled.
        let (nx, ny) = (64, 64);
        let gap = |at: usize| 3e-9 * ((at % nx) as f32 - 80.0).powi(2);
        let nodes: Vec<f32> = (0..nx * ny).map(gap).collect();
        let film = Film::new(&nodes, nx, ny).unwrap();
        for i in 0..50 {
            let x = f64::from(i);
            let cell = film.cell([x, x + 1.0], [8.0, 9.0]);
            assert!(cell.iter().all(|c| c.abs_diff(128) <= 12), "{x}: {cell:?}");
        }
    }

    #[test]
    fn a_grid_that_is_none_has_no_colour() {
        assert!(Film::new(&[], 0, 0).is_none());
        assert!(Film::new(&[1.0; 5], 2, 2).is_none());
        // One row, as a line contact may have.
        let film = Film::new(&[0.0, 0.0], 2, 1).unwrap();
        assert_eq!(film.cell([0.0, 1.0], [0.0, 1.0]), [0, 0, 0]);
    }
}
