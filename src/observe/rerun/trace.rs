//! What a material point has felt since it entered the contact, against where it was: one hump in
//! pure rolling, a comb when the mating roughness slides over it.

use rerun::{Points2D, Radius};

use super::centre_line::line;
use super::colour::{GREEN, GREY, ORANGE, PURPLE, WHITE, faded};
use super::geometry::Geometry;
use super::plot::{PlotBox, ticks_at};
use super::stream::Stream;
use super::waiting::Curves;
use crate::observe::ObserveError;
use crate::observe::scales::{GPA, MM, divisions, ticks};
use crate::sim::{Frame, MaterialPoint};

pub(super) const TRACE: &str = "material_point/trace";
/// Where the point is.
const NOW: &str = "material_point/trace/now";
/// Points kept of a crossing; when there are more every other one is dropped.
const MOST_POINTS: usize = 1024;

/// The trace of the crossing that goes on, and the one before it.
pub(super) struct Trace {
    plot: PlotBox,
    pressure_top_pa: f64,
    body: u8,
    last_x_m: f64,
    pressure: Vec<[f32; 2]>,
    effective: Vec<[f32; 2]>,
    before: Vec<[f32; 2]>,
    /// Whether `before` has been logged.
    shown: Shown,
    curves: TraceCurves,
}

/// The curves in the plot.
struct TraceCurves {
    pressure: Curves,
    effective: Curves,
    before: Curves,
}

impl TraceCurves {
    fn new(stream: &Stream) -> Result<Self, ObserveError> {
        let curves = |name: &str, colour, radius| {
            let entity = format!("{TRACE}/{name}");
            stream.log_static(entity.as_str(), &line(colour, radius))?;
            Ok(stream.curves(entity))
        };
        Ok(Self {
            pressure: curves("pressure_GPa", ORANGE, 1.5)?,
            effective: curves("effective_stress_GPa", PURPLE, 1.5)?,
            before: curves("crossing_before", GREY, 0.75)?,
        })
    }
}

/// What is known of a curve that stays.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Shown {
    NotYet,
    AsItIs,
}

impl Trace {
    /// Sets up the axes.
    pub(super) fn new(
        stream: &Stream,
        geometry: Geometry,
        pressure_top_pa: f64,
    ) -> Result<Self, ObserveError> {
        let x = [geometry.x_min, geometry.x_max()];
        let height = 0.45 * (x[1] - x[0]);
        let top = pressure_top_pa * GPA.1;
        let plot = PlotBox {
            x,
            y: [-height, 0.0],
            x_ticks: ticks_at(&ticks(x[0], x[1], 8), |x| x),
            left_ticks: ticks_at(&divisions(top), |p| -height * p / top),
            x_title: "where the point is: x, mm".into(),
            titles: vec![
                (0.02, "GPa".into(), WHITE),
                (0.22, "pressure above the point".into(), ORANGE),
                (0.48, "effective stress at it".into(), PURPLE),
                (0.76, "pressure, crossing before".into(), GREY),
            ],
            ..PlotBox::default()
        };
        plot.log(stream, &format!("{TRACE}/axes"))?;
        let style = Points2D::update_fields()
            .with_radii([Radius::new_ui_points(5.0), Radius::new_ui_points(0.0)])
            .with_colors([faded(GREEN, 255), faded(WHITE, 255)])
            .with_show_labels(true)
            .with_draw_order(30.0);
        stream.log_static(NOW, &style)?;
        Ok(Self {
            plot,
            pressure_top_pa,
            body: 0,
            last_x_m: f64::NEG_INFINITY,
            pressure: Vec::new(),
            effective: Vec::new(),
            before: Vec::new(),
            shown: Shown::NotYet,
            curves: TraceCurves::new(stream)?,
        })
    }

    pub(super) fn plot(&self) -> &PlotBox {
        &self.plot
    }

    /// Takes up a step; called for every step, also for those whose fields are not recorded.
    pub(super) fn follow(&mut self, frame: &Frame) {
        let Some(point) = &frame.material_point else {
            return;
        };
        if point.body != self.body || point.x_m < self.last_x_m {
            self.before = std::mem::take(&mut self.pressure);
            self.shown = Shown::NotYet;
            self.effective.clear();
        }
        (self.body, self.last_x_m) = (point.body, point.x_m);
        let [left, right] = self.plot.x;
        if (left..=right).contains(&(point.x_m * MM)) {
            let at = self.place(point, point.pressure_pa);
            self.pressure.push(at);
            let at = self.place(point, point.effective_pa);
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

    fn place(&self, point: &MaterialPoint, value_pa: f64) -> [f32; 2] {
        let share = (value_pa / self.pressure_top_pa).min(1.0);
        [(point.x_m * MM) as f32, (self.plot.y[0] * share) as f32]
    }

    /// Logs the trace up to this frame.
    pub(super) fn log(&mut self, stream: &Stream, frame: &Frame) -> Result<(), ObserveError> {
        let Some(point) = &frame.material_point else {
            return Ok(());
        };
        if self.shown == Shown::NotYet {
            stream.log_curves(self.curves.before, |pen| pen.draw(&self.before))?;
            self.shown = Shown::AsItIs;
        }
        stream.log_curves(self.curves.pressure, |pen| pen.draw(&self.pressure))?;
        stream.log_curves(self.curves.effective, |pen| pen.draw(&self.effective))?;
        let formula = match point.body {
            1 => frame.metrics.n_body_1,
            _ => frame.metrics.n_body_2,
        };
        let counted = format!(
            "body {}, cycles counted in this crossing: {}",
            point.body, point.cycles_counted
        );
        let label = match formula {
            Some(n) => format!("{counted}   (formula n = {n:.2})"),
            None => counted,
        };
        let [left, right] = self.plot.x;
        let label_at = [
            (0.5 * (left + right)) as f32,
            (0.97 * self.plot.y[0]) as f32,
        ];
        let now = Points2D::update_fields()
            .with_positions([self.place(point, point.pressure_pa), label_at])
            .with_labels([String::new(), label]);
        stream.log(NOW, &now)
    }
}
