//! What a material point has felt since it entered the contact, against where it was: one hump in
//! pure rolling, a comb when the mating roughness slides over it, each peak numbered as it passes.

use rerun::{Points2D, Radius};

use super::colour::{GREEN, GREY, ORANGE, PURPLE, WHITE, YELLOW, faded};
use super::entities::trace::{BEFORE, EFFECTIVE, NOW, PEAKS, PRESSURE, TRACE};
use super::geometry::Geometry;
use super::plot::{PlotBox, Strips, line, ticks_at};
use super::stream::{Holds, Stream};
use super::view::View;
use asperity_engine::math::number::{GPA, MM, counted, divisions, plain, sig, ticks};
use asperity_engine::scene::Scene;
use asperity_engine::sim::{Frame, MaterialPoint};
use asperity_picture::Scope;

/// Points kept of a crossing; when there are more every other one is dropped.
const MOST_POINTS: usize = 1024;

/// The trace of the crossing that goes on, and the one before it.
pub(crate) struct TraceEntity {
    plot: PlotBox,
    pressure_top_pa: f64,
    body: u8,
    last_x_m: f64,
    pressure: Vec<[f32; 2]>,
    effective: Vec<[f32; 2]>,
    before: Vec<[f32; 2]>,
    /// Whether `before` is in the recording as it is.
    has_logged_before: bool,
    peaks: CrossingPeaks,
}

/// The peaks of this crossing that have passed.
#[derive(Debug, Default)]
struct CrossingPeaks {
    at: Vec<[f32; 2]>,
    numbers: Vec<u32>,
    /// How many are in the recording as they are.
    logged: Option<usize>,
}

impl CrossingPeaks {
    fn clear(&mut self) {
        self.at.clear();
        self.numbers.clear();
        self.logged = None;
    }

    fn log(&mut self, stream: &Stream) {
        if self.logged == Some(self.at.len()) {
            return;
        }
        self.logged = Some(self.at.len());
        let labels = self.numbers.iter().map(u32::to_string);
        let points = Points2D::update_fields()
            .with_positions(self.at.iter().copied())
            .with_labels(labels);
        stream.log(PEAKS, &points);
    }
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
                (-0.05, "GPa".into(), WHITE),
                (0.16, "pressure".into(), ORANGE),
                (0.45, "effective stress".into(), PURPLE),
                (0.8, "crossing before".into(), GREY),
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
            .with_show_labels(true)
            .with_draw_order(20.0);
        stream.log_static(PEAKS, &style);
        let mut this = Self {
            plot,
            pressure_top_pa,
            body: 0,
            last_x_m: f64::NEG_INFINITY,
            pressure: Vec::new(),
            effective: Vec::new(),
            before: Vec::new(),
            has_logged_before: false,
            peaks: CrossingPeaks::default(),
        };
        this.draw_to(stream, pressure_top_pa);
        this
    }

    /// Draws the axes up to this top from now on, and to them what was drawn before.
    fn draw_to(&mut self, stream: &Stream, pressure_top_pa: f64) {
        let share = (self.pressure_top_pa / pressure_top_pa) as f32;
        self.pressure_top_pa = pressure_top_pa;
        let curves = [&mut self.pressure, &mut self.effective, &mut self.before];
        for [_, y] in curves.into_iter().flatten().chain(&mut self.peaks.at) {
            *y *= share;
        }
        (self.has_logged_before, self.peaks.logged) = (false, None);
        let (top, lower) = (GPA.of(pressure_top_pa), self.plot.y[0]);
        self.plot.left_ticks = ticks_at(&divisions(top), |p| lower * p / top);
        let axes = format!("{TRACE}/axes");
        self.plot.log(stream, &axes, Holds::FromNow);
    }

    pub(crate) fn plot(&self) -> &PlotBox {
        &self.plot
    }

    fn place(&self, x_m: f64, value_pa: f64) -> [f32; 2] {
        let share = (value_pa / self.pressure_top_pa).min(1.0);
        [(x_m * MM) as f32, (self.plot.y[0] * share) as f32]
    }
}

impl View for TraceEntity {
    fn widen(&mut self, stream: &Stream, _scene: Option<&Scene>, scope: &Scope) {
        self.draw_to(stream, scope.ranges.pressure_pa);
    }

    fn follow_scalars(&mut self, frame: &Frame) {
        let Some(point) = &frame.material_point else {
            return;
        };
        // Bodies run towards +x or −x: the point that jumps has left and entered anew.
        let jumped = (point.x_m - self.last_x_m).abs() > frame.a_m;
        if point.body != self.body || jumped {
            self.before = std::mem::take(&mut self.pressure);
            self.has_logged_before = false;
            self.effective.clear();
            self.peaks.clear();
        }
        (self.body, self.last_x_m) = (point.body, point.x_m);
        let number = point.cycles_counted as u32;
        if let Some(peak) = point.last_peak
            && self.peaks.numbers.last().is_none_or(|last| number > *last)
        {
            let at = self.place(peak.x_m, peak.pressure_pa);
            self.peaks.at.push(at);
            self.peaks.numbers.push(number);
        }
        let [left, right] = self.plot.x;
        if (left..=right).contains(&(point.x_m * MM)) {
            let at = self.place(point.x_m, point.pressure_pa);
            self.pressure.push(at);
            let at = self.place(point.x_m, point.effective_pa);
            self.effective.push(at);
        }
        for trace in [&mut self.pressure, &mut self.effective] {
            if trace.len() > MOST_POINTS {
                let mut keep = false;
                trace.retain(|_| {
                    keep = !keep;
                    keep
                });
            }
        }
    }

    /// Logs the trace up to this frame.
    fn log(&mut self, stream: &Stream, frame: &Frame) {
        let Some(point) = &frame.material_point else {
            return;
        };
        if !std::mem::replace(&mut self.has_logged_before, true) {
            Strips::of(&self.before).log(stream, BEFORE);
        }
        Strips::of(&self.pressure).log(stream, PRESSURE);
        Strips::of(&self.effective).log(stream, EFFECTIVE);
        self.peaks.log(stream);
        let label = counts(point, frame);
        let [left, right] = self.plot.x;
        let label_at = [
            (0.5 * (left + right)) as f32,
            (0.97 * self.plot.y[0]) as f32,
        ];
        // Away from the contact it is not in the picture.
        let is_inside = (left..=right).contains(&(point.x_m * MM));
        let here = is_inside.then(|| self.place(point.x_m, point.pressure_pa));
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
