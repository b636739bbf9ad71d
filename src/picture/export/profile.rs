//! The page of the profile: both surfaces along y = 0 with the oil between them, in the colours of
//! [`SurfaceProfile`], and the followed point.

use super::sheet::Sheet;
use crate::Scope;
use crate::draw::{Axis, Drawing, Rect, Side};
use crate::profile::{ProfileColumn, ProfileScale, SurfaceProfile};
use asperity_engine::math::number::{MM, UM, sig};
use asperity_engine::scene::Scene;
use asperity_engine::sim::Frame;

/// Height of the picture over its width.
pub(super) const HEIGHT: f64 = 0.5;
/// The followed point.
pub(super) const POINT: [u8; 3] = [0, 158, 115];

/// A profile and what is drawn on it.
pub(super) struct ProfilePage<'a> {
    profile: SurfaceProfile<'a>,
    a_mm: f64,
    /// Where the followed point is: parts of the picture along and down.
    point: Option<[f64; 2]>,
}

impl<'a> ProfilePage<'a> {
    /// Of a frame in the ranges of its run, around the contact.
    pub(super) fn of(frame: &'a Frame, scene: &Scene, scope: &Scope) -> Option<Self> {
        let [first, last] = SurfaceProfile::domain(frame);
        let [one, two] = scope.to_come.amplitude_m;
        let scale = ProfileScale::of(scene, scope.ranges.film_m, one.max(two));
        let x = [first.max(-1.5), last.min(1.4)];
        let profile = SurfaceProfile::new(frame, scale, x, &scope.ranges)?;
        let point = frame.material_point.and_then(|point| {
            let at = point.x_m / frame.a_m;
            let z = profile.surfaces(at)[usize::from(point.body == 2)];
            let along = (at - x[0]) / (x[1] - x[0]);
            let down = 0.5 * (1.0 - z / profile.half_m());
            let inside = |part: &f64| (0.0..1.0).contains(part);
            Some([along, down]).filter(|at| at.iter().all(inside))
        });
        Some(Self {
            profile,
            a_mm: frame.a_m * MM,
            point,
        })
    }

    /// x at both edges, mm, and heights at the lower and upper one, µm.
    fn ends(&self) -> [[f64; 2]; 2] {
        let half_um = UM.of(self.profile.half_m());
        [self.profile.x.map(|x| x * self.a_mm), [-half_um, half_um]]
    }

    /// How many times larger heights are drawn than lengths.
    fn exaggeration(&self) -> String {
        let [[left, right], [low, high]] = self.ends();
        let times = HEIGHT * (right - left) * 1e3 / (high - low);
        format!("z, µm (heights × {})", sig(times, 2))
    }

    /// Pixels, three bytes each, from above.
    fn pixels(&self, [wide, tall]: [u32; 2]) -> Vec<u8> {
        let columns: Vec<ProfileColumn> = self.profile.columns(wide as usize).collect();
        let rows = tall as usize;
        let mut bytes = Vec::with_capacity(3 * columns.len() * rows);
        for row in 0..rows {
            for column in &columns {
                bytes.extend(self.profile.rgb(self.profile.at(column, row, rows)));
            }
        }
        let radius = f64::from(wide) / 90.0;
        for (k, pixel) in bytes.chunks_exact_mut(3).enumerate() {
            let Some([along, down]) = self.point else {
                break;
            };
            let (x, y) = ((k % wide as usize) as f64, (k / wide as usize) as f64);
            let off = (x - along * f64::from(wide)).hypot(y - down * f64::from(tall));
            if off < radius {
                pixel.copy_from_slice(if off < 0.7 * radius {
                    &POINT
                } else {
                    &[255; 3]
                });
            }
        }
        bytes
    }

    /// x at both edges, mm.
    pub(super) fn x_mm(&self) -> [f64; 2] {
        self.ends()[0]
    }

    /// Where the followed point is: parts of the picture along and down; `None`: not in it.
    pub(super) fn point(&self) -> Option<[f64; 2]> {
        self.point
    }

    /// Draws it.
    pub(super) fn draw(&self, sheet: &Sheet, x_title: &str) -> Drawing {
        let (mut drawing, plot) = sheet.begin(1.0, HEIGHT);
        self.draw_on(&mut drawing, plot, sheet);
        drawing.axis(plot, Side::Below, &Axis::linear(self.x_mm(), x_title));
        drawing
    }

    /// Draws it on a part of a sheet, without the axis below.
    pub(super) fn draw_on(&self, drawing: &mut Drawing, plot: Rect, sheet: &Sheet) {
        drawing.field(sheet.field(plot, |pixels| self.pixels(pixels)));
        let [_, z] = self.ends();
        let z_title = self.exaggeration();
        drawing.frame(plot);
        drawing.axis(plot, Side::Left, &Axis::linear(z, &z_title));
    }
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "tests")]
    use super::*;
    use crate::CONTACT;
    use asperity_engine::sim::{MaterialPoint, Metrics};

    #[test]
    fn gap_contact_and_point_are_where_they_belong() {
        let row = |values: [f32; 5]| values.repeat(3);
        let frame = Frame {
            nx: 5,
            ny: 3,
            x_min_m: -2e-3,
            dx_m: 1e-3,
            y_min_m: -1e-3,
            dy_m: 1e-3,
            a_m: 1e-3,
            b_m: 1e-3,
            p_hertz_pa: 1e9,
            film_m: row([2e-7, 2e-7, 0.0, 2e-7, 2e-7]),
            roughness_1_m: row([0.0; 5]),
            roughness_2_m: row([0.0; 5]),
            pressure_pa: row([0.0, 1e9, 1e9, 1e9, 0.0]),
            contact: [0, 0, 1, 0, 0].repeat(3),
            metrics: Metrics {
                h_mean_m: 4e-7,
                ..Metrics::default()
            },
            material_point: Some(MaterialPoint {
                body: 2,
                x_m: 1e-3,
                ..MaterialPoint::default()
            }),
            ..Frame::default()
        };
        let scene = Scene::load("demonstration").unwrap();
        let scope = Scope::of(Some(&scene), &frame);
        let page = ProfilePage::of(&frame, &scene, &scope).unwrap();
        let [wide, tall] = [290, 145];
        let bytes = page.pixels([wide, tall]);
        let pixel = |x: f64, z: f64| {
            let column = ((x + 1.5) / 2.9 * f64::from(wide)) as usize;
            let row = ((1.0 - z / page.profile.half_m()) * 0.5 * f64::from(tall)) as usize;
            let at = 3 * (row * wide as usize + column);
            [bytes[at], bytes[at + 1], bytes[at + 2]]
        };
        assert_eq!(pixel(0.0, 0.0), CONTACT);
        // The point rides on body 2, whose surface is half the film above the middle.
        assert_eq!(pixel(1.0, 1e-7), POINT);
        let oil = pixel(-1.0, 0.0);
        assert!(oil[0] > oil[2], "oil is warm: {oil:?}");
        assert_ne!(pixel(-1.0, 0.9 * page.profile.half_m()), oil);
    }
}
