//! The profile: both surfaces along y = 0 with the oil between them, gap to scale, the followed point riding along, and
//! under it the trace that it leaves ([`super::trace`], in the same view and on the same x).
//!
//! Bodies are a coarse picture of the stress in them, which is smooth; the oil is drawn as a column for each place, as fine
//! as the surfaces are. Together a frame takes some 7 kB of the file.

use asperity_engine::physics::cycles::speed_ratios;
use rerun::components::LineStrip2D;
use rerun::{Color, LineStrips2D, Points2D, Radius};

use super::colour::{GREEN, WHITE};
use super::entities::profile::{MOTION, OIL, POINT, POINT_LINE, PROFILE, STRESS, SURFACES};
use super::geometry::Geometry;
use super::picture::{Field, PixelField};
use super::plot::{AxisTick, Labels, Margin, PlotBox, Strips, dot, line, ticks_at};
use super::raster::{Height, RasterEntity};
use super::stream::{Holds, Stream};
use super::view::View;
use asperity_engine::math::number::{MM, UM, plain, sig, ticks};
use asperity_engine::scene::Scene;
use asperity_engine::sim::Frame;
use asperity_picture::profile::{DEEP, Matter, ProfileColumn, ProfileScale, SurfaceProfile, oil};
use asperity_picture::{ABOVE, CONTACT, Look, Ranges, Scope, Subject};

/// How much is written above a profile: of several beside each other there is little room.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum TitleRoom {
    All,
    Some,
}

/// Height of the picture over its width.
const HEIGHT: f64 = 0.46;
/// Room between it and the trace, over its width: titles of the trace.
const BETWEEN: f64 = 0.1;
/// Pixels of the stress.
const PIXELS: [usize; 2] = [120, 54];
/// Columns of oil.
const COLUMNS: usize = 192;
/// Radius of a column over its width: they overlap, so that no seam is seen between them.
const ROUND: f64 = 0.8;

/// The picture of both surfaces.
pub(crate) struct ProfileEntity {
    scale: ProfileScale,
    ranges: Ranges,
    plot: PlotBox,
    /// The lower end of the line under the point: of the trace.
    foot: f64,
    room: TitleRoom,
    stress: Option<RasterEntity>,
    /// Speeds that the arrows tell, m/s.
    shown_m_s: Option<[f64; 2]>,
}

impl ProfileEntity {
    /// Sets up the picture above a trace, where there is one.
    pub(crate) fn new(
        stream: &Stream,
        geometry: Geometry,
        scene: &Scene,
        first: &Frame,
        scope: &Scope,
        trace: Option<&PlotBox>,
        room: TitleRoom,
    ) -> Self {
        let x = [geometry.x_min, geometry.x_max()];
        let w = x[1] - x[0];
        let lower = trace.map_or(0.0, |trace| trace.y[0] - BETWEEN * w);
        let height = HEIGHT * w;
        let plot = PlotBox {
            x,
            y: [lower - height, lower],
            ..PlotBox::default()
        };
        let pixel = [w / PIXELS[0] as f64, height / PIXELS[1] as f64];
        let pixels = PixelField {
            columns: PIXELS[0],
            rows: PIXELS[1],
            first: [x[0] + 0.5 * pixel[0], plot.y[0] + 0.5 * pixel[1]],
            size: pixel,
        };
        let look = Look::of(Subject::EffectiveStress, &scope.ranges);
        let stress = first.slice.as_ref().map(|_| {
            // Its axes change with its heights: here stands only its frame.
            RasterEntity::new(stream, STRESS, look, pixels, &plot, Height::Fixed)
        });
        log_looks(stream, ROUND * w / COLUMNS as f64);
        for surface in SURFACES {
            stream.log_static(surface, &line(WHITE, 1.0).with_draw_order(22.0));
        }
        stream.log_static(POINT_LINE, &line(GREEN, 0.75));
        let mut this = Self {
            scale: ProfileScale::of(scene, 0.0, 0.0),
            ranges: scope.ranges,
            foot: trace.map_or(plot.y[1], |trace| trace.y[1]),
            room,
            plot,
            stress,
            shown_m_s: None,
        };
        this.draw_to(stream, scene, scope);
        this
    }

    /// Draws it to what can come from now on.
    fn draw_to(&mut self, stream: &Stream, scene: &Scene, scope: &Scope) {
        let [one, two] = scope.to_come.amplitude_m;
        self.ranges = scope.ranges;
        self.scale = ProfileScale::of(scene, scope.ranges.film_m, one.max(two));
        if let Some(stress) = &mut self.stress {
            stress.widen(stream, Look::of(Subject::EffectiveStress, &scope.ranges));
        }
        let axes = format!("{PROFILE}/axes");
        self.axes().log(stream, &axes, Holds::FromNow);
    }

    /// What its view must show: the picture with its legend, and what comes under it.
    pub(crate) fn bounds(&self) -> [[f64; 2]; 2] {
        let [x, [top, _]] = self.plot.bounds(Margin::Legend);
        let width = self.plot.x[1] - self.plot.x[0];
        [x, [top, self.foot + 0.16 * width]]
    }

    /// How many times larger heights are drawn than lengths.
    fn exaggeration(&self) -> f64 {
        (self.plot.y[1] - self.plot.y[0]) / (2.0 * self.scale.half_m * MM)
    }

    fn axes(&self) -> PlotBox {
        let half_um = UM.of(self.scale.half_m);
        let place = |z_um: f64| (self.at(z_um / UM.per_si), plain(z_um));
        let left_ticks: Vec<AxisTick> = [-half_um, 0.0, half_um].map(place).into();
        let heights = format!("heights × {}", sig(self.exaggeration(), 3));
        let gap = if self.scale.is_dry {
            "dry"
        } else {
            "oil by its pressure"
        };
        let below = format!("{gap}, bodies by the stress to {DEEP} a below");
        let is_alone = self.foot == self.plot.y[1];
        PlotBox {
            left_ticks,
            x_ticks: if is_alone {
                ticks_at(&ticks(self.plot.x[0], self.plot.x[1], 8), |x| x)
            } else {
                Vec::new()
            },
            titles: match self.room {
                TitleRoom::All => vec![
                    (-0.05, "z, µm".into(), None),
                    (0.13, heights, None),
                    (0.6, below, None),
                ],
                TitleRoom::Some => vec![(-0.05, "z, µm".into(), None), (0.4, heights, None)],
            },
            ..self.plot.clone()
        }
    }

    /// Where a height lies in the view.
    fn at(&self, z_m: f64) -> f64 {
        let [top, bottom] = self.plot.y;
        let share = (z_m / self.scale.half_m).clamp(-1.0, 1.0);
        f64::midpoint(top, bottom) - 0.5 * share * (bottom - top)
    }

    /// A column of oil, or of contact, for each place.
    fn log_oil(&self, stream: &Stream, columns: &[ProfileColumn], a_mm: f64) {
        let round = ROUND * (self.plot.x[1] - self.plot.x[0]) / COLUMNS as f64;
        let strips = columns.iter().map(|column| {
            let x = (column.x * a_mm) as f32;
            let [lower, upper] = column.surfaces.map(|z| self.at(z));
            // Its round ends reach as far as the surfaces.
            let ends = round.min(0.5 * (lower - upper));
            LineStrip2D::from_iter([[x, (lower - ends) as f32], [x, (upper + ends) as f32]])
        });
        let colours = columns.iter().map(|column| match column.gap {
            Matter::Oil(share) => Color::from(oil(share)),
            Matter::Nothing => Color::from(ABOVE),
            Matter::Touching | Matter::Body(..) => Color::from(CONTACT),
        });
        let strips = LineStrips2D::update_fields()
            .with_strips(strips)
            .with_colors(colours);
        stream.log(OIL, &strips);
    }

    /// A body's surface, where it is in the picture.
    fn surface(&self, columns: &[ProfileColumn], body: usize, a_mm: f64) -> Strips {
        let mut strips = Strips::default();
        for column in columns {
            let z = column.surfaces[body];
            if z.abs() <= self.scale.half_m {
                strips.to([(column.x * a_mm) as f32, self.at(z) as f32]);
            } else {
                strips.lift();
            }
        }
        strips
    }

    /// The point on its body's surface, and a line from it to its trace.
    fn log_point(&self, stream: &Stream, profile: &SurfaceProfile, frame: &Frame) {
        let Some(point) = &frame.material_point else {
            return;
        };
        let x = point.x_m * MM;
        let [left, right] = self.plot.x;
        let inside = (left..=right).contains(&x);
        let surfaces = profile.surfaces(point.x_m / frame.a_m);
        let at = [x, self.at(surfaces[usize::from(point.body == 2)])].map(|v| v as f32);
        let mut line = Strips::default();
        if inside {
            line.to(at);
            line.to([at[0], self.foot as f32]);
        }
        line.log(stream, POINT_LINE);
        let here = Points2D::update_fields().with_positions(inside.then_some(at));
        stream.log(POINT, &here);
    }

    /// Which way the bodies go and how fast, where that has changed.
    fn log_motion(&mut self, stream: &Stream, frame: &Frame) {
        let m = &frame.metrics;
        let now = speed_ratios(m.slide_roll).map(|ratio| m.entrainment_m_s * ratio);
        if self.shown_m_s == Some(now) {
            return;
        }
        self.shown_m_s = Some(now);
        // In the middle of the contact bodies fill the picture to its edges.
        let x = 0.0;
        let [top, bottom] = self.plot.y;
        let mut labels = Labels::default();
        for (body, y) in [
            (2, top + 0.03 * (bottom - top)),
            (1, bottom - 0.11 * (bottom - top)),
        ] {
            labels.add([x, y], &moves(body, now[body - 1]));
        }
        labels.log(stream, MOTION, Holds::FromNow);
    }
}

impl View for ProfileEntity {
    fn widen(&mut self, stream: &Stream, scene: Option<&Scene>, scope: &Scope) {
        if let Some(scene) = scene {
            self.draw_to(stream, scene, scope);
        }
    }

    fn log(&mut self, stream: &Stream, frame: &Frame) {
        let a_mm = frame.a_m * MM;
        let x = self.plot.x.map(|x| x / a_mm);
        let Some(profile) = SurfaceProfile::new(frame, self.scale, x, &self.ranges) else {
            return;
        };
        if let Some(stress) = &self.stress {
            stress.log(stream, Field::TopDown(&stresses(&profile)));
        }
        let columns: Vec<ProfileColumn> = profile.columns(COLUMNS).collect();
        self.log_oil(stream, &columns, a_mm);
        for (body, entity) in SURFACES.into_iter().enumerate() {
            self.surface(&columns, body, a_mm).log(stream, entity);
        }
        self.log_point(stream, &profile, frame);
        self.log_motion(stream, frame);
    }
}

/// A body's name and its speed in words.
fn moves(body: usize, speed_m_s: f64) -> String {
    let size = sig(speed_m_s.abs(), 3);
    match speed_m_s {
        v if v > 0.0 => format!("body {body}: {size} m/s →"),
        v if v < 0.0 => format!("← body {body}: {size} m/s"),
        _ => format!("body {body} stands"),
    }
}

/// Effective stress at every pixel, from above.
fn stresses(profile: &SurfaceProfile) -> Vec<f32> {
    let [across, rows] = PIXELS;
    let columns: Vec<ProfileColumn> = profile.columns(across).collect();
    let at = |row| move |column| profile.stress_at(column, row, rows) as f32;
    (0..rows)
        .flat_map(|row| columns.iter().map(at(row)).collect::<Vec<f32>>())
        .collect()
}

/// What stays: how oil and the point look.
fn log_looks(stream: &Stream, radius_mm: f64) {
    let oil = LineStrips2D::update_fields()
        .with_radii([Radius::new_scene_units(radius_mm as f32)])
        .with_draw_order(15.0);
    stream.log_static(OIL, &oil);
    stream.log_static(POINT, &dot(GREEN, 6.0));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bodies_say_where_they_go() {
        assert_eq!(moves(1, 1.5), "body 1: 1.50 m/s →");
        assert_eq!(moves(2, -0.25), "← body 2: 0.250 m/s");
        assert_eq!(moves(2, 0.0), "body 2 stands");
    }
}
