//! Both rough surfaces passing each other with the oil between them, along y = 0.
//!
//! ```text
//! z2 - z1 = h           the simulated gap, to scale
//! z1 = δ1 - c1 (h + δ1 + δ2)      c1 = C1/(C1 + C2),  C = (1 - ν²)/E of body 1 and 2
//! ```
//! Each body bends by its share c of what both bend together, so that its surface is its roughness δ, less that. Heights
//! are drawn many times larger than lengths, which whoever draws it says. Oil is drawn by its pressure, bodies by the
//! effective stress in them (to a depth of its own, as films are a thousand times thinner than what is stressed), contact
//! is filled.

use super::{ABOVE, CONTACT, Look, Ranges, Subject, Tint};
use asperity_engine::math::number::nice_ceiling;
use asperity_engine::scene::Scene;
use asperity_engine::sim::{Frame, StressSlice};

/// Depth to which a body is drawn at the edge of the picture, in half-widths.
pub const DEEP: f64 = 0.6;
/// Oil at the maximum pressure of the range and at none, bodies without stress.
pub(crate) const OIL: [[f32; 3]; 2] = [[255.0, 214.0, 102.0], [74.0, 50.0, 16.0]];
pub(crate) const STEEL: [[f32; 3]; 2] = [[116.0, 112.0, 92.0], [112.0, 96.0, 116.0]];

/// What stands at a place of the profile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Matter {
    /// Body 1 or 2, by its stress over the range's, and how near its surface is (1: on it).
    Body(u8, f32, f32),
    /// Oil, by its pressure over the range's.
    Oil(f32),
    /// The gap of a dry contact.
    Nothing,
    /// Asperity contact.
    Touching,
}

/// What stands at one x.
#[derive(Debug, Clone, Copy)]
pub struct ProfileColumn {
    /// x/a.
    pub x: f64,
    /// Heights of body 1 and 2, m.
    pub surfaces: [f64; 2],
    /// What is between them.
    pub gap: Matter,
}

/// What a profile is drawn to: the same in every frame.
#[derive(Debug, Clone, Copy)]
pub struct ProfileScale {
    /// Body 1's share of the bending.
    pub share_1: f64,
    /// Height from the middle to the upper and lower edge, m.
    pub half_m: f64,
    /// Whether there is no oil between them.
    pub is_dry: bool,
}

impl ProfileScale {
    /// Of a scene whose film and amplitudes of roughness reach so far (m).
    pub fn of(scene: &Scene, film_m: f64, amplitude_m: f64) -> Self {
        let compliance = |young_pa: f64, poisson: f64| (1.0 - poisson * poisson) / young_pa;
        let one = compliance(scene.body_1.young_pa, scene.body_1.poisson);
        let two = compliance(scene.body_2.young_pa, scene.body_2.poisson);
        Self {
            share_1: one / (one + two),
            half_m: nice_ceiling((0.55 * film_m + 0.8 * amplitude_m).max(1e-9)),
            is_dry: scene.lubricant.is_none(),
        }
    }
}

/// The surfaces of a frame along y = 0.
pub struct SurfaceProfile<'a> {
    frame: &'a Frame,
    scale: ProfileScale,
    /// x/a at the left and right edge.
    pub x: [f64; 2],
    pressure: Look,
    stress: Look,
}

impl<'a> SurfaceProfile<'a> {
    /// Of a frame between two x/a; `None` where the frame holds no film.
    pub fn new(
        frame: &'a Frame,
        scale: ProfileScale,
        x: [f64; 2],
        ranges: &Ranges,
    ) -> Option<Self> {
        let nodes = frame.nx * frame.ny;
        let holds = frame.nx >= 2 && frame.a_m > 0.0 && frame.film_m.len() >= nodes;
        holds.then(|| Self {
            frame,
            scale,
            x,
            pressure: Look::of(Subject::Pressure, ranges),
            stress: Look::of(Subject::EffectiveStress, ranges),
        })
    }

    /// x/a of a frame's first and last node.
    pub fn domain(frame: &Frame) -> [f64; 2] {
        let last = frame.nx.saturating_sub(1) as f64;
        [frame.x_min_m, frame.x_min_m + last * frame.dx_m].map(|x| x / frame.a_m)
    }

    /// Height from the middle to the upper and lower edge, m.
    pub fn half_m(&self) -> f64 {
        self.scale.half_m
    }

    /// A field along y = 0 at x/a, between its nodes.
    fn along(&self, field: &[f32], row: usize, x: f64) -> f64 {
        let frame = self.frame;
        let place =
            ((x * frame.a_m - frame.x_min_m) / frame.dx_m).clamp(0.0, (frame.nx - 2) as f64 + 1.0);
        let i = (place as usize).min(frame.nx - 2);
        let part = place - i as f64;
        let at = |i: usize| f64::from(field.get(row * frame.nx + i).copied().unwrap_or(0.0));
        at(i) * (1.0 - part) + at(i + 1) * part
    }

    /// Heights of body 1 and 2 at x/a, m.
    pub fn surfaces(&self, x: f64) -> [f64; 2] {
        let row = self.frame.ny / 2;
        let film = self.along(&self.frame.film_m, row, x);
        let one = self.along(&self.frame.roughness_1_m, row, x);
        let two = self.along(&self.frame.roughness_2_m, row, x);
        let lower = one - self.scale.share_1 * (film + one + two);
        [lower, lower + film]
    }

    fn touches(&self, x: f64) -> bool {
        let frame = self.frame;
        let place = ((x * frame.a_m - frame.x_min_m) / frame.dx_m)
            .round()
            .max(0.0) as usize;
        let at = frame.ny / 2 * frame.nx + place.min(frame.nx - 1);
        frame.contact.get(at).is_some_and(|touches| *touches != 0)
    }

    /// Effective stress of a body at x/a and a depth in half-widths, Pa: of the nearest depth that was computed below it.
    /// Where body 2's is not computed body 1's stands for it.
    pub fn stress_pa(&self, body: u8, x: f64, depth: f64) -> f64 {
        let one = self.frame.slice.as_ref();
        let slice = match body {
            2 => self.frame.slice_2.as_ref().or(one),
            _ => one,
        };
        slice.map_or(0.0, |slice| self.in_slice(slice, x, depth))
    }

    fn in_slice(&self, slice: &StressSlice, x: f64, depth: f64) -> f64 {
        let z_m = depth * self.frame.a_m;
        let below = slice.depths_m.partition_point(|z| *z < z_m);
        let row = below.min(slice.depths_m.len().saturating_sub(1));
        self.along(&slice.effective_pa, row, x)
    }

    /// What stands at x/a.
    pub fn column(&self, x: f64) -> ProfileColumn {
        let p = self.along(&self.frame.pressure_pa, self.frame.ny / 2, x);
        ProfileColumn {
            x,
            surfaces: self.surfaces(x),
            gap: if self.touches(x) {
                Matter::Touching
            } else if self.scale.is_dry {
                Matter::Nothing
            } else {
                Matter::Oil(self.pressure.share(p).clamp(0.0, 1.0))
            },
        }
    }

    /// So many columns of a picture, each of the middle of its place.
    pub fn columns(&self, columns: usize) -> impl Iterator<Item = ProfileColumn> {
        let across = self.x[1] - self.x[0];
        let x =
            move |column: usize| self.x[0] + across * (column as f64 + 0.5) / columns.max(1) as f64;
        (0..columns).map(move |column| self.column(x(column)))
    }

    /// Height of the middle of a row of so many, m.
    fn height_m(&self, row: usize, rows: usize) -> f64 {
        let pixel_m = 2.0 * self.scale.half_m / rows as f64;
        self.scale.half_m - (row as f64 + 0.5) * pixel_m
    }

    /// Effective stress in a column at a row of so many, Pa; in the gap that of the nearer surface.
    pub fn stress_at(&self, column: &ProfileColumn, row: usize, rows: usize) -> f64 {
        let (body, into) = into(column.surfaces, self.height_m(row, rows));
        self.stress_pa(body, column.x, DEEP * into.max(0.0) / self.scale.half_m)
    }

    /// What is in a column at a row of so many.
    pub fn at(&self, column: &ProfileColumn, row: usize, rows: usize) -> Matter {
        let pixel_m = 2.0 * self.scale.half_m / rows as f64;
        let z = self.height_m(row, rows);
        let [lower, upper] = column.surfaces;
        let middle = f64::midpoint(lower, upper);
        // Where the film is thinner than a pixel it still has one.
        if (lower < z && z <= upper) || (z - middle).abs() <= 0.5 * pixel_m {
            return column.gap;
        }
        let (body, into) = into(column.surfaces, z);
        let depth = DEEP * into / self.scale.half_m;
        let share = self.stress.share(self.stress_pa(body, column.x, depth));
        let edge = (1.0 - into / (1.5 * pixel_m)).clamp(0.0, 1.0);
        Matter::Body(body, share.clamp(0.0, 1.0), edge as f32)
    }

    /// The colour of what stands there.
    pub fn rgb(&self, matter: Matter) -> [u8; 3] {
        let rgb = match matter {
            Matter::Touching => return CONTACT,
            Matter::Nothing => return ABOVE,
            Matter::Oil(share) => return oil(share),
            Matter::Body(body, share, edge) => {
                let own = STEEL[usize::from(body == 2)];
                let hot = self.stress.paint(Tint::Share(share)).unwrap_or([0; 3]);
                let filled = mixed(own.map(|c| 0.62 * c), hot.map(f32::from), share.sqrt());
                mixed(filled, own.map(|c| (1.9 * c).min(255.0)), 0.75 * edge)
            }
        };
        rgb.map(|c| c.clamp(0.0, 255.0) as u8)
    }
}

/// The body at a height and how far it is inside of it, m; in the gap the nearer one, and less than 0.
fn into([lower, upper]: [f64; 2], z: f64) -> (u8, f64) {
    if z < f64::midpoint(lower, upper) {
        (1, lower - z)
    } else {
        (2, z - upper)
    }
}

fn mixed(a: [f32; 3], b: [f32; 3], part: f32) -> [f32; 3] {
    [0, 1, 2].map(|k| a[k] + (b[k] - a[k]) * part)
}

/// The colour of oil at a share of the range of pressure.
pub fn oil(share: f32) -> [u8; 3] {
    mixed(OIL[1], OIL[0], share.max(0.0).sqrt()).map(|c| c.clamp(0.0, 255.0) as u8)
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "tests")]
    use super::*;
    use approx::assert_relative_eq;

    /// Two like bodies, a gap of 2 with a ridge of 1 on body 1 and a valley of 0.5 in body 2, in units of 1e-7 m.
    fn frame() -> Frame {
        let row = |values: [f32; 5]| values.repeat(3);
        Frame {
            nx: 5,
            ny: 3,
            x_min_m: -2.0,
            dx_m: 1.0,
            y_min_m: -1.0,
            dy_m: 1.0,
            a_m: 1.0,
            b_m: 1.0,
            p_hertz_pa: 1e9,
            film_m: row([9e-7, 2e-7, 2e-7, 0.0, 9e-7]),
            roughness_1_m: row([0.0, 0.0, 1e-7, 0.0, 0.0]),
            roughness_2_m: row([0.0, 0.0, -0.5e-7, 0.0, 0.0]),
            pressure_pa: row([0.0, 5e8, 1e9, 5e8, 0.0]),
            contact: [0, 0, 0, 1, 0].repeat(3),
            ..Frame::default()
        }
    }

    fn profile(frame: &Frame, share_1: f64) -> SurfaceProfile<'_> {
        let scale = ProfileScale {
            share_1,
            half_m: 5e-7,
            is_dry: false,
        };
        SurfaceProfile::new(frame, scale, [-2.0, 2.0], &Ranges::default()).unwrap()
    }

    #[test]
    fn the_gap_is_to_scale_and_bodies_bend_by_their_share() {
        let frame = frame();
        assert_eq!(SurfaceProfile::domain(&frame), [-2.0, 2.0]);
        for share in [0.5, 0.2, 0.9] {
            let profile = profile(&frame, share);
            for x in [-1.5, -1.0, 0.0, 0.3, 1.0] {
                let [lower, upper] = profile.surfaces(x);
                let film = profile.along(&frame.film_m, 1, x);
                assert_relative_eq!(upper - lower, film, epsilon = 1e-18);
            }
            // h + δ1 + δ2 = 2.5e-7 at x = 0.
            assert_relative_eq!(
                profile.surfaces(0.0)[0],
                1e-7 - share * 2.5e-7,
                epsilon = 1e-13
            );
        }
        // A stiff body 1 keeps its ridge, body 2 goes round it.
        assert_relative_eq!(profile(&frame, 0.0).surfaces(0.0)[0], 1e-7, epsilon = 1e-13);
    }

    #[test]
    fn what_is_where() {
        let frame = frame();
        let profile = profile(&frame, 0.5);
        // 125 rows of 8 nm, from 500 nm downwards: no pixel's middle lies on a surface.
        let at = |x: f64, row: usize| profile.at(&profile.column(x), row, 125);
        assert!(matches!(at(0.0, 62), Matter::Oil(_)));
        assert!(matches!(at(0.0, 12), Matter::Body(2, ..)));
        assert!(matches!(at(0.0, 112), Matter::Body(1, ..)));
        let oil = (0..125).filter(|row| matches!(at(0.0, *row), Matter::Oil(_)));
        assert_eq!(oil.count(), 25, "200 nm");
        let touching = (0..125).filter(|row| at(1.0, *row) == Matter::Touching);
        assert_eq!(touching.count(), 1, "a film of no height has a pixel");
        // Where there is no oil none is drawn.
        let mut dry = profile;
        dry.scale.is_dry = true;
        assert_eq!(dry.column(0.0).gap, Matter::Nothing);
        assert_eq!(dry.rgb(dry.at(&dry.column(0.0), 62, 125)), ABOVE);
        assert_eq!(dry.column(1.0).gap, Matter::Touching);
    }

    #[test]
    fn bodies_bend_by_their_compliance() {
        let share = |name| ProfileScale::of(&Scene::load(name).unwrap(), 1e-6, 0.0).share_1;
        let glass = share("ball_on_glass");
        assert!((glass - 0.5).abs() > 0.1, "steel on glass: {glass}");
        assert_relative_eq!(share("demonstration"), 0.5);
    }

    #[test]
    fn stress_is_of_the_depth_below_its_own_surface() {
        let mut frame = frame();
        let rows = |values: [f32; 3]| values.iter().flat_map(|v| [*v; 5]).collect();
        frame.slice = Some(StressSlice {
            depths_m: [0.1, 0.3, 0.6].into(),
            effective_pa: rows([1e9, 2e9, 3e9]),
            ..StressSlice::default()
        });
        let profile = profile(&frame, 0.5);
        let column = profile.column(0.0);
        let at = |row: usize| profile.stress_at(&column, row, 125);
        // The gap's own rows hold the surface's stress, so that nothing bleeds into it.
        assert_eq!(at(62), 1e9);
        assert_eq!((at(0), at(124)), (3e9, 3e9));
        // 250 of 500 nm below a surface are half of the depth of the edge.
        let row = |z_m: f64| ((5e-7 - z_m) / 8e-9) as usize;
        assert_eq!(at(row(column.surfaces[0] - 2.4e-7)), 2e9);
    }
}
