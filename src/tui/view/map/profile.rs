//! The map of the profile: both rough surfaces passing each other with the oil between them, along y = 0.
//!
//! ```text
//! z2 - z1 = h           the simulated gap, to scale
//! z1 = δ1 - c1 (h + δ1 + δ2)      c1 = C1/(C1 + C2),  C = (1 - ν²)/E of body 1 and 2
//! ```
//! Each body bends by its share c of what both bend together, so that its surface is its roughness δ, less that. Heights
//! are drawn many times larger than lengths, which the heading says. Oil is drawn by its pressure, bodies by the effective
//! stress in them (to a depth of its own, as films are a thousand times thinner than what is stressed), contact is filled.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Line;

use super::paint::MapMark;
use super::raster::MapWindow;
use crate::picture::{CONTACT, Look, Subject, Tint};
use crate::scene::Scene;
use crate::sim::{Frame, StressSlice};
use crate::tui::app::{App, Zoom};
use crate::tui::pixels::Bitmap;
use crate::tui::theme::Role;
use crate::tui::units::{nice_ceiling, sig, tick};
use crate::tui::view::{ascii_text, point, put, put_right};

/// Depth to which a body is drawn at the edge of the picture, in half-widths.
const DEEP: f64 = 0.6;
/// Oil at the greatest and at no pressure, bodies without stress.
const OIL: [[f32; 3]; 2] = [[255.0, 214.0, 102.0], [74.0, 50.0, 16.0]];
const STEEL: [[f32; 3]; 2] = [[116.0, 112.0, 92.0], [112.0, 96.0, 116.0]];
/// Rows of half blocks from which the trace has room below.
const ROWS_WITH_TRACE: u16 = 14;

/// What stands at a place of the profile.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Matter {
    /// Body 1 or 2, by its stress over the range's, and how near its surface is (1: on it).
    Body(u8, f32, f32),
    /// Oil, by its pressure over the range's.
    Oil(f32),
    /// The bodies touch.
    Touching,
}

/// What stands at one x.
#[derive(Debug, Clone, Copy)]
struct ProfileColumn {
    /// x/a.
    x: f64,
    /// Heights of body 1 and 2, m.
    surfaces: [f64; 2],
    /// What is between them.
    gap: Matter,
}

/// The surfaces of a frame along y = 0.
pub(super) struct SurfaceProfile<'a> {
    frame: &'a Frame,
    /// Body 1's share of the bending.
    share_1: f64,
    /// x/a at the left and right edge.
    pub(super) x: [f64; 2],
    /// Height from the middle to the upper and lower edge, m.
    pub(super) half_m: f64,
    pressure: Look,
    stress: Look,
}

/// Body 1's part of what both bend: its compliance over that of both.
fn share_1(scene: &Scene) -> f64 {
    let compliance = |young_pa: f64, poisson: f64| (1.0 - poisson * poisson) / young_pa;
    let one = compliance(scene.body_1.young_pa, scene.body_1.poisson);
    let two = compliance(scene.body_2.young_pa, scene.body_2.poisson);
    one / (one + two)
}

impl<'a> SurfaceProfile<'a> {
    pub(super) fn of(app: &App, frame: &'a Frame) -> Option<Self> {
        let nodes = frame.nx * frame.ny;
        if frame.nx < 2 || frame.a_m <= 0.0 || frame.film_m.len() < nodes {
            return None;
        }
        let last = (frame.nx - 1) as f64;
        let domain = [frame.x_min_m, frame.x_min_m + last * frame.dx_m].map(|x| x / frame.a_m);
        let x = match app.zoom {
            Zoom::Contact => [domain[0].max(-1.5), domain[1].min(1.4)],
            Zoom::Domain => domain,
        };
        let heights = frame.metrics.amplitude_1_m.max(frame.metrics.amplitude_2_m);
        let ranges = app.ranges();
        Some(Self {
            frame,
            share_1: share_1(&app.setup.scene),
            x,
            half_m: nice_ceiling((0.55 * app.reached.film_m + 0.8 * heights).max(1e-9)),
            pressure: Look::of(Subject::Pressure, &ranges),
            stress: Look::of(Subject::EffectiveStress, &ranges),
        })
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
    pub(super) fn surfaces(&self, x: f64) -> [f64; 2] {
        let row = self.frame.ny / 2;
        let film = self.along(&self.frame.film_m, row, x);
        let one = self.along(&self.frame.roughness_1_m, row, x);
        let two = self.along(&self.frame.roughness_2_m, row, x);
        let lower = one - self.share_1 * (film + one + two);
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

    /// Stress of a body at x/a and a depth in half-widths, over the range's.
    fn stress(&self, slice: Option<&StressSlice>, x: f64, depth: f64) -> f32 {
        let Some(slice) = slice else { return 0.0 };
        let z_m = depth * self.frame.a_m;
        let below = slice.depths_m.partition_point(|z| *z < z_m);
        let row = below.min(slice.depths_m.len().saturating_sub(1));
        self.stress
            .share(self.along(&slice.effective_pa, row, x))
            .clamp(0.0, 1.0)
    }

    /// What stands at x/a.
    fn column(&self, x: f64) -> ProfileColumn {
        let p = self.along(&self.frame.pressure_pa, self.frame.ny / 2, x);
        ProfileColumn {
            x,
            surfaces: self.surfaces(x),
            gap: if self.touches(x) {
                Matter::Touching
            } else {
                Matter::Oil(self.pressure.share(p).clamp(0.0, 1.0))
            },
        }
    }

    /// All columns of a picture.
    fn columns(&self, columns: usize) -> Vec<ProfileColumn> {
        let x = |column: usize| {
            let part = (column as f64 + 0.5) / columns as f64;
            self.x[0] + (self.x[1] - self.x[0]) * part
        };
        (0..columns).map(|column| self.column(x(column))).collect()
    }

    /// What is in a column at a row of so many.
    fn at(&self, column: &ProfileColumn, row: usize, rows: usize) -> Matter {
        let pixel_m = 2.0 * self.half_m / rows as f64;
        let z = self.half_m - (row as f64 + 0.5) * pixel_m;
        let [lower, upper] = column.surfaces;
        let middle = f64::midpoint(lower, upper);
        // Where the film is thinner than a pixel it still has one.
        if (lower < z && z <= upper) || (z - middle).abs() <= 0.5 * pixel_m {
            return column.gap;
        }
        let (body, into, slice) = if z < middle {
            (1, lower - z, self.frame.slice.as_ref())
        } else {
            let second = self.frame.slice_2.as_ref().or(self.frame.slice.as_ref());
            (2, z - upper, second)
        };
        let depth = DEEP * into / self.half_m;
        let edge = (1.0 - into / (1.5 * pixel_m)).clamp(0.0, 1.0);
        Matter::Body(body, self.stress(slice, column.x, depth), edge as f32)
    }

    fn rgb(&self, matter: Matter) -> [u8; 3] {
        let mixed =
            |a: [f32; 3], b: [f32; 3], part: f32| [0, 1, 2].map(|k| a[k] + (b[k] - a[k]) * part);
        let rgb = match matter {
            Matter::Touching => return CONTACT,
            Matter::Oil(share) => mixed(OIL[1], OIL[0], share.sqrt()),
            Matter::Body(body, share, edge) => {
                let own = STEEL[usize::from(body == 2)];
                let hot = self.stress.paint(Tint::Share(share)).unwrap_or([0; 3]);
                let filled = mixed(own.map(|c| 0.62 * c), hot.map(f32::from), share.sqrt());
                mixed(filled, own.map(|c| (1.9 * c).min(255.0)), 0.75 * edge)
            }
        };
        rgb.map(|c| c.clamp(0.0, 255.0) as u8)
    }

    /// How many times larger heights are drawn than lengths.
    pub(super) fn exaggeration(&self, area: Rect) -> f64 {
        let length_m = (self.x[1] - self.x[0]) * self.frame.a_m / f64::from(area.width.max(1));
        // A cell is twice as high as it is wide.
        let height_m = 2.0 * self.half_m / (2.0 * f64::from(area.height.max(1)));
        length_m / height_m
    }
}

impl Matter {
    /// A character, for screens without colours.
    fn letter(self) -> &'static str {
        match self {
            Self::Touching => "#",
            Self::Oil(_) => " ",
            Self::Body(1, ..) => ":",
            Self::Body(..) => "+",
        }
    }
}

/// Where the profile is drawn, where numbers stand at its left, and where the trace below it.
pub(super) fn rooms(inner: Rect) -> (Rect, Option<Rect>) {
    const LEFT: u16 = 6;
    let rows = inner.height.saturating_sub(1);
    let above = if inner.height >= ROWS_WITH_TRACE {
        rows * 3 / 5
    } else {
        rows
    };
    let profile = Rect {
        x: inner.x + LEFT,
        width: inner.width.saturating_sub(LEFT),
        height: above,
        ..inner
    };
    let below = Rect {
        y: profile.bottom() + 1,
        height: rows.saturating_sub(above + 2),
        ..profile
    };
    let trace = (below.height >= 3).then_some(below);
    (profile, trace)
}

/// Both surfaces with the oil between them, and below them the trace of the point that rides on one.
pub(super) fn side_view(app: &App, frame: &Frame, inner: Rect, buffer: &mut Buffer) {
    let Some(profile) = SurfaceProfile::of(app, frame) else {
        return;
    };
    let (area, below) = rooms(inner);
    draw(app, &profile, area, inner, buffer);
    if let Some(below) = below {
        point::under_profile(app, frame, (below, profile.x), buffer);
    }
}

/// Draws the profile, where it is not left to the terminal's own pixels, and its numbers.
fn draw(app: &App, profile: &SurfaceProfile, area: Rect, inner: Rect, buffer: &mut Buffer) {
    let theme = app.theme;
    let rows = usize::from(area.height) * if theme.paints() { 2 } else { 1 };
    let columns = if app.is_in_pixels() {
        Vec::new()
    } else {
        profile.columns(usize::from(area.width))
    };
    for (x, column) in (area.x..).zip(&columns) {
        for row in 0..area.height {
            let Some(cell) = buffer.cell_mut((x, area.y + row)) else {
                continue;
            };
            let row = usize::from(row);
            if theme.paints() {
                let color = |row: usize| theme.rgb(profile.rgb(profile.at(column, row, rows)));
                cell.set_symbol("▀")
                    .set_fg(color(2 * row))
                    .set_bg(color(2 * row + 1));
            } else {
                cell.set_symbol(profile.at(column, row, rows).letter());
            }
        }
    }
    numbers(app, profile, area, inner, buffer);
    let cell = |part: f64, cells: u16| (part * f64::from(cells)) as u16;
    if !app.is_in_pixels()
        && let Some([along, down]) = point_part(app, profile)
        && let (column, row) = (cell(along, area.width), cell(down, area.height))
        && let Some(cell) = buffer.cell_mut((area.x + column, area.y + row))
    {
        cell.set_symbol(theme.pick("◆", "X"));
        if theme.paints() {
            cell.set_fg(theme.rgb([255, 255, 255]));
        } else {
            cell.set_style(theme.style(Role::Strong));
        }
    }
}

/// The followed point, riding on its body: parts of the picture along and down.
fn point_part(app: &App, profile: &SurfaceProfile) -> Option<[f64; 2]> {
    let point = app.point_now()?;
    let x = point.sample.x_m / profile.frame.a_m;
    let [lower, upper] = profile.surfaces(x);
    let z = if point.body == 2 { upper } else { lower };
    let along = (x - profile.x[0]) / (profile.x[1] - profile.x[0]);
    let down = 0.5 * (1.0 - z / profile.half_m);
    let inside = |part: f64| (0.0..1.0).contains(&part);
    (inside(along) && inside(down)).then_some([along, down])
}

/// Heights at the left, x/a and what is what below.
fn numbers(app: &App, profile: &SurfaceProfile, area: Rect, inner: Rect, buffer: &mut Buffer) {
    let theme = app.theme;
    let dim = theme.style(Role::Dim);
    let unit = app.units.film();
    let left = Rect {
        x: inner.x,
        width: area.x - inner.x - 1,
        ..area
    };
    let last = area.height.saturating_sub(1);
    let height = |value: f64| Line::styled(tick(unit.of(value)), dim);
    put_right(left, 0, &height(profile.half_m), buffer);
    put_right(left, last, &height(-profile.half_m), buffer);
    if area.height >= 5 {
        put_right(
            left,
            1,
            &Line::styled(ascii_text(theme, unit.name), dim),
            buffer,
        );
        put_right(left, area.height / 2, &Line::styled("0", dim), buffer);
    }
    let foot = Rect {
        y: area.bottom(),
        height: 1,
        ..area
    };
    let [from, to] = profile.x.map(|x| format!("{} a", sig(x, 2)));
    put(
        foot,
        0,
        &Line::styled(ascii_text(theme, &from), dim),
        buffer,
    );
    put_right(foot, 0, &Line::styled(to, dim), buffer);
    let words = [
        "body 2 above, body 1 below, lit by their stress; oil by its pressure; cyan touches",
        "bodies by stress, oil by pressure; cyan touches",
        "cyan touches",
    ];
    let room = usize::from(foot.width).saturating_sub(16);
    if let Some(words) = words.iter().find(|words| words.len() <= room) {
        let start = (usize::from(foot.width) - words.len()) / 2;
        let middle = Rect {
            x: foot.x + start as u16,
            width: words.len() as u16,
            ..foot
        };
        put(middle, 0, &Line::styled(*words, dim), buffer);
    }
}

/// The profile in the terminal's own pixels, so many for a cell.
fn pixels(profile: &SurfaceProfile, area: Rect, cell: (u16, u16)) -> Bitmap {
    let side = |cells: u16, each: u16| usize::from(cells) * usize::from(each);
    let (width, height) = (side(area.width, cell.0), side(area.height, cell.1));
    let columns = profile.columns(width);
    let places = (0..height).flat_map(|row| columns.iter().map(move |column| (column, row)));
    let rgba = places
        .flat_map(|(column, row)| {
            let [r, g, b] = profile.rgb(profile.at(column, row, height));
            [r, g, b, 255]
        })
        .collect();
    Bitmap {
        area,
        width,
        height,
        rgba,
    }
}

/// The same with the followed point.
pub(super) fn in_pixels(app: &App, frame: &Frame, area: Rect, cell: (u16, u16)) -> Option<Bitmap> {
    let profile = SurfaceProfile::of(app, frame)?;
    let mut picture = pixels(&profile, area, cell);
    if let Some([x, y]) = point_part(app, &profile) {
        let whole = MapWindow {
            x: [0.0, 1.0],
            y: [0.0, 1.0],
        };
        MapMark::Diamond.draw(&mut picture, &whole, (x, y), 0.6 * f64::from(cell.0));
    }
    Some(picture)
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
        let ranges = crate::picture::Ranges::default();
        SurfaceProfile {
            frame,
            share_1,
            x: [-2.0, 2.0],
            half_m: 5e-7,
            pressure: Look::of(Subject::Pressure, &ranges),
            stress: Look::of(Subject::EffectiveStress, &ranges),
        }
    }

    #[test]
    fn the_gap_is_to_scale_and_bodies_bend_by_their_share() {
        let frame = frame();
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
        let share = share_1(&Scene::load("ball_on_glass").unwrap());
        assert!((share - 0.5).abs() > 0.1, "steel on glass: {share}");
        assert_relative_eq!(share_1(&Scene::load("demonstration").unwrap()), 0.5);
    }
}
