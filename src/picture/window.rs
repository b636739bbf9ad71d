//! What of a frame is worth a picture: the contact with its inlet, and not the oil far outside of it.
//!
//! A domain reaches so far that its edges do not disturb the film; that far out there is no pressure left to be seen.
//! Shown is the contact with [`REACH`] half-widths around its middle, and beyond them what carries more than [`CARRIES`] of
//! the greatest pressure of the first frame: lightly loaded films begin far out. A point contact keeps about half of its
//! nodes so.

use std::ops::Range;

use asperity_engine::scene::ContactKind;
use asperity_engine::sim::{Frame, StressSlice};

/// Shown at the inlet, at the outlet and across, in half-widths of the largest contact to come.
const REACH: [f64; 3] = [1.6, 1.4, 1.4];
/// Part of the greatest pressure that is shown wherever it is.
const CARRIES: f32 = 0.01;

/// The nodes that pictures show.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Window {
    /// Nodes of the frames that it is of.
    nodes: [usize; 2],
    x: Range<usize>,
    y: Range<usize>,
}

impl Window {
    /// Of a run with that first frame, whose half-widths grow to `size` of its own. It is symmetric across, and of what it
    /// has cut it is the whole.
    pub fn around(first: &Frame, size: f64) -> Self {
        let [nx, ny] = [first.nx, first.ny];
        let mut x = between(nx, |i| {
            let x = (first.x_min_m + first.dx_m * i as f64) / (size * first.a_m);
            (-REACH[0]..=REACH[1]).contains(&x)
        });
        let is_line = first.kind == ContactKind::Line;
        let mut y = between(ny, |j| {
            let y = (first.y_min_m + first.dy_m * j as f64) / (size * first.b_m);
            is_line || y.abs() <= REACH[2]
        });
        let top = first.pressure_pa.iter().fold(0.0_f32, |top, &p| top.max(p));
        for (j, row) in first.pressure_pa.chunks_exact(nx.max(1)).enumerate() {
            let carries = between(nx, |i| row[i] > CARRIES * top);
            if !carries.is_empty() {
                x = x.start.min(carries.start)..x.end.max(carries.end);
                let (low, high) = (j.min(ny - 1 - j), j.max(ny - 1 - j));
                y = y.start.min(low)..y.end.max(high + 1);
            }
        }
        Self {
            nodes: [nx, ny],
            x,
            y,
        }
    }

    /// Whether it is of frames with the sizes of that one.
    pub fn is_of(&self, frame: &Frame) -> bool {
        self.nodes == [frame.nx, frame.ny]
    }

    /// A frame of what it shows; fields that do not have the frame's sizes come out empty, lengths and scalars as they are.
    #[must_use]
    pub fn cut(&self, frame: &Frame) -> Frame {
        let field = |values: &[f32]| self.part(values);
        Frame {
            nx: self.x.len(),
            ny: self.y.len(),
            x_min_m: frame.x_min_m + frame.dx_m * self.x.start as f64,
            y_min_m: frame.y_min_m + frame.dy_m * self.y.start as f64,
            pressure_pa: field(&frame.pressure_pa),
            film_m: field(&frame.film_m),
            roughness_1_m: field(&frame.roughness_1_m),
            roughness_2_m: field(&frame.roughness_2_m),
            traction_pa: field(&frame.traction_pa),
            surface_rise_k: [0, 1].map(|body| field(&frame.surface_rise_k[body])),
            film_rise_k: field(&frame.film_rise_k),
            contact: self.part(&frame.contact),
            slice: frame.slice.as_ref().map(|slice| self.below(slice)),
            slice_2: frame.slice_2.as_ref().map(|slice| self.below(slice)),
            // Nothing of these lies on the nodes of the surface.
            material_point: frame.material_point,
            risk_pa: frame.risk_pa.clone(),
            planes: frame.planes.clone(),
            damage: frame.damage.clone(),
            suffered: frame.suffered.clone(),
            metrics: frame.metrics.clone(),
            grounds: frame.grounds,
            ..*frame
        }
    }

    /// The shown nodes of a field.
    fn part<T: Copy>(&self, values: &[T]) -> Vec<T> {
        let [nx, ny] = self.nodes;
        if values.len() != nx * ny || nx == 0 {
            return Vec::new();
        }
        let rows = values.chunks_exact(nx);
        let rows = rows.skip(self.y.start).take(self.y.len());
        rows.flat_map(|row| &row[self.x.clone()]).copied().collect()
    }

    /// The shown columns of a slice.
    fn below(&self, slice: &StressSlice) -> StressSlice {
        let columns = |values: &[f32]| {
            let rows = values.chunks_exact(self.nodes[0].max(1));
            rows.flat_map(|row| &row[self.x.clone()]).copied().collect()
        };
        StressSlice {
            depths_m: slice.depths_m.clone(),
            effective_pa: columns(&slice.effective_pa),
            tau_xz_pa: columns(&slice.tau_xz_pa),
        }
    }
}

/// From the first to the last of so many nodes that are shown.
fn between(nodes: usize, is_shown: impl Fn(usize) -> bool) -> Range<usize> {
    let first = (0..nodes).find(|&node| is_shown(node)).unwrap_or_default();
    let end = (first..nodes).rev().find(|&node| is_shown(node));
    first..end.map_or(first, |last| last + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A frame of 41 by 31 nodes from -3 to 1 by -2 to 2 half-widths, with pressure where `carries` says so.
    fn frame(carries: impl Fn(f64, f64) -> bool) -> Frame {
        let (nx, ny, dx_m, dy_m) = (41, 31, 0.1, 4.0 / 30.0);
        let place = |k: usize| (-3.0 + dx_m * (k % nx) as f64, -2.0 + dy_m * (k / nx) as f64);
        let pressure = (0..nx * ny).map(|k| {
            let (x, y) = place(k);
            f32::from(u8::from(carries(x, y)))
        });
        Frame {
            nx,
            ny,
            x_min_m: -3.0,
            dx_m,
            y_min_m: -2.0,
            dy_m,
            a_m: 1.0,
            b_m: 1.0,
            pressure_pa: pressure.collect(),
            film_m: (0..nx * ny).map(|k| k as f32).collect(),
            contact: vec![0; nx * ny],
            slice: Some(StressSlice {
                depths_m: [0.0, 1.0].into(),
                effective_pa: (0..2 * nx).map(|k| k as f32).collect(),
                tau_xz_pa: vec![0.0; 2 * nx],
            }),
            ..Frame::default()
        }
    }

    #[test]
    fn the_contact_is_kept_and_what_carries_outside_of_it() {
        let whole = frame(|x, y| x.hypot(y) < 1.0);
        let cut = Window::around(&whole, 1.0).cut(&whole);
        assert_eq!((cut.nx, cut.ny), (27, 21));
        assert!((cut.x_min_m + 1.6).abs() < 1e-9 && (cut.y_min_m + 4.0 / 3.0).abs() < 1e-9);
        // Every value stands where it stood, and y = 0 is the middle row.
        assert_eq!(cut.film_m[0], (5 * 41 + 14) as f32);
        let middle = cut.centre_line(&cut.film_m);
        assert_eq!(middle, &whole.centre_line(&whole.film_m)[14..41]);
        let slice = cut.slice.as_ref().expect("a slice");
        assert_eq!(slice.effective_pa[27], (41 + 14) as f32);
        // Of what is cut it is the whole.
        let again = Window::around(&cut, 1.0);
        assert!(again.is_of(&cut) && !again.is_of(&whole));
        assert_eq!(again.cut(&cut), cut);
        // A contact that grows, a crest far out and an inlet that begins far out are in the picture.
        assert_eq!(Window::around(&whole, 1.25).cut(&whole).ny, 27);
        let far =
            frame(|x, y| x.hypot(y) < 1.0 || ((1.7..1.8).contains(&y) && x < -2.45 && x > -2.55));
        let far = Window::around(&far, 1.0).cut(&far);
        assert_eq!((far.nx, far.ny), (36, 27));
    }
}
