//! What a material point has felt since it entered the contact, against where it was: one hump in
//! pure rolling, a comb when the mating roughness slides over it, each peak numbered as it passes.

use rerun::{Points2D, Radius};

use super::colour::{GREEN, GREY, ORANGE, PURPLE, WHITE, YELLOW, faded};
use super::entities::trace::{BEFORE, EFFECTIVE, NOW, PEAKS, PRESSURE, TRACE};
use super::geometry::Geometry;
use super::plot::{Labels, PlotBox, Strips, line, ticks_at};
use super::stream::{Holds, Stream};
use super::view::View;
use asperity_engine::math::number::{GPA, MM, counted, divisions, plain, sig, ticks};
use asperity_engine::scene::Scene;
use asperity_engine::sim::{Frame, MaterialPoint};
use asperity_picture::{PointTrace, Scope, TracePoint};

/// The trace of the crossing that goes on, and the one before it.
pub(crate) struct TraceEntity {
    plot: PlotBox,
    pressure_top_pa: f64,
    trace: PointTrace,
    /// The crossing, and how many of its peaks, that are in the recording as they are.
    logged: Option<(u64, usize)>,
}

impl TraceEntity {
    /// Sets up the axes.
    pub(crate) fn new(stream: &Stream, geometry: Geometry, pressure_top_pa: f64) -> Self {
        let x = [geometry.x_min, geometry.x_max()];
        let height = 0.45 * (x[1] - x[0]);
        let plot = PlotBox {
            x,
            y: [-height, 0.0],
            x_ticks: ticks_at(&ticks(x[0], x[1], 8), |x| x),
            x_title: "where the point is: x, mm".into(),
            titles: vec![
                (0.0, "GPa".into(), None),
                (0.16, "pressure".into(), Some(ORANGE)),
                (0.45, "effective stress".into(), Some(PURPLE)),
                (0.8, "crossing before".into(), Some(GREY)),
            ],
            ..PlotBox::default()
        };
        let style = Points2D::update_fields()
            .with_radii([Radius::new_ui_points(0.0), Radius::new_ui_points(5.0)])
            .with_colors([faded(WHITE, 255), faded(GREEN, 255)])
            .with_show_labels(true)
            .with_draw_order(30.0);
        stream.log_static(NOW, &style);
        for (entity, colour, radius) in [
            (PRESSURE, ORANGE, 1.5),
            (EFFECTIVE, PURPLE, 1.5),
            (BEFORE, GREY, 0.75),
        ] {
            stream.log_static(entity, &line(colour, radius));
        }
        let style = Points2D::update_fields()
            .with_radii([Radius::new_ui_points(3.0)])
            .with_colors([faded(YELLOW, 255)])
            .with_draw_order(20.0);
        stream.log_static(PEAKS, &style);
        let mut this = Self {
            plot,
            pressure_top_pa,
            trace: PointTrace::default(),
            logged: None,
        };
        this.draw_to(stream, pressure_top_pa);
        this
    }

    /// Draws the axes up to this top from now on, and to them what is drawn.
    fn draw_to(&mut self, stream: &Stream, pressure_top_pa: f64) {
        (self.pressure_top_pa, self.logged) = (pressure_top_pa, None);
        let (top, lower) = (GPA.of(pressure_top_pa), self.plot.y[0]);
        self.plot.left_ticks = ticks_at(&divisions(top), |p| lower * p / top);
        let axes = format!("{TRACE}/axes");
        self.plot.log(stream, &axes, Holds::FromNow);
    }

    pub(crate) fn plot(&self) -> &PlotBox {
        &self.plot
    }

    /// Logs what of a curve is in the picture.
    fn log_curve(&self, stream: &Stream, entity: &str, curve: &[TracePoint]) {
        let inside = curve.iter().filter(|[x_m, _]| self.shows(*x_m));
        let places: Vec<[f32; 2]> = inside.map(|at| self.place(*at)).collect();
        Strips::of(&places).log(stream, entity);
    }

    fn log_peaks(&self, stream: &Stream) {
        let peaks = self.trace.peaks.iter();
        let places = peaks.clone().map(|(_, at)| self.place(*at));
        let points = Points2D::update_fields().with_positions(places);
        stream.log(PEAKS, &points);
        let mut numbers = Labels::default();
        for (number, at) in peaks {
            let [x, y] = self.place(*at).map(f64::from);
            numbers.add([x, y], &number.to_string());
        }
        numbers.log(stream, &format!("{PEAKS}/numbers"), Holds::FromNow);
    }

    /// Whether the picture reaches so far.
    fn shows(&self, x_m: f64) -> bool {
        let [left, right] = self.plot.x;
        (left..=right).contains(&(x_m * MM))
    }

    fn place(&self, [x_m, value_pa]: TracePoint) -> [f32; 2] {
        let share = (value_pa / self.pressure_top_pa).min(1.0);
        [(x_m * MM) as f32, (self.plot.y[0] * share) as f32]
    }
}

impl View for TraceEntity {
    fn widen(&mut self, stream: &Stream, _scene: Option<&Scene>, scope: &Scope) {
        self.draw_to(stream, scope.ranges.pressure_pa);
    }

    fn follow_scalars(&mut self, frame: &Frame) {
        self.trace.follow(frame);
    }

    /// Logs the trace up to this frame.
    fn log(&mut self, stream: &Stream, frame: &Frame) {
        let Some(point) = &frame.material_point else {
            return;
        };
        let now = (self.trace.crossings, self.trace.peaks.len());
        let before = self.logged.replace(now);
        if before.map(|(crossings, _)| crossings) != Some(now.0) {
            self.log_curve(stream, BEFORE, &self.trace.before);
        }
        if before != Some(now) {
            self.log_peaks(stream);
        }
        self.log_curve(stream, PRESSURE, &self.trace.pressure);
        self.log_curve(stream, EFFECTIVE, &self.trace.effective);
        let label = counts(point, frame);
        let [left, right] = self.plot.x;
        let label_at = [
            (0.5 * (left + right)) as f32,
            (0.97 * self.plot.y[0]) as f32,
        ];
        // Away from the contact it is not in the picture.
        let here = self
            .shows(point.x_m)
            .then(|| self.place([point.x_m, point.pressure_pa]));
        let now = Points2D::update_fields()
            .with_positions(std::iter::once(label_at).chain(here))
            .with_labels([label, String::new()]);
        stream.log(NOW, &now);
    }
}

/// Peaks so far, cycles of the crossing before, and what the formula expects.
fn counts(point: &MaterialPoint, frame: &Frame) -> String {
    let expected = match point.body {
        1 => frame.metrics.n_body_1,
        _ => frame.metrics.n_body_2,
    };
    let peaks = counted(point.cycles_counted as u64, "peak");
    let mut parts = vec![format!("body {}: {peaks} so far", point.body)];
    let before = point.cycles_before;
    parts.extend(before.map(|closed| format!("{} before", plain(closed))));
    parts.extend(expected.map(|n| format!("{} expected", sig(n, 3))));
    parts.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_peak_is_one_peak() {
        let frame = Frame::default();
        let point = |cycles_counted, cycles_before| MaterialPoint {
            body: 1,
            cycles_counted,
            cycles_before,
            ..MaterialPoint::default()
        };
        assert_eq!(counts(&point(1.0, None), &frame), "body 1: 1 peak so far");
        let text = counts(&point(2.0, Some(1.0)), &frame);
        assert_eq!(text, "body 1: 2 peaks so far, 1 before");
    }
}
