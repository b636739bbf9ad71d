//! A gear's teeth while the contact rides along one: both gears turning, the line of action with its places, and Hertz
//! pressure, sliding and radius over the path of contact, each with the run's own value on it.

use rerun::{LineStrips2D, Points2D, Radius};

use super::colour::{GREEN, GREY, ORANGE, PURPLE, SKY, WHITE, faded};
use super::entities::tooth::{CONTACT, GEARS, OUTLINES, PATHS};
use super::plot::{Labels, PlotBox, Strips, dot, line, points, ticks_at};
use super::stream::{Holds, Stream};
use super::view::View;
use asperity_engine::math::number::{GPA, MM, nice_ceiling, sig, ticks};
use asperity_engine::physics::gear::{GearTeeth, LineOfAction};
use asperity_engine::scene::{Scene, Tooth};
use asperity_engine::sim::Frame;
use asperity_picture::Scope;
use asperity_picture::tooth::{PICTURE, PathLines};

/// Height of the curves over their width.
const HEIGHT: f64 = 0.26;
const CURVES: [[u8; 3]; 3] = [ORANGE, PURPLE, SKY];

/// The teeth and the path.
pub(crate) struct ToothEntity {
    tooth: Tooth,
    gears: GearTeeth,
    line: LineOfAction,
    paths: [PathCurve; 3],
}

/// A quantity over the path of contact.
struct PathCurve {
    plot: PlotBox,
    /// Value at the lower and the upper edge.
    range: [f64; 2],
    entity: &'static str,
}

impl ToothEntity {
    /// Sets up the picture of a scene that rides along a tooth; `None` of others.
    pub(crate) fn new(stream: &Stream, scene: Option<&Scene>) -> Option<Self> {
        let scene = scene?;
        let tooth = scene.tooth?;
        let gears = tooth.gears();
        let line_of_action = gears.line_of_action()?;
        log_line(stream, &gears, &line_of_action);
        for (outline, colour) in OUTLINES.into_iter().zip([SKY, WHITE]) {
            stream.log_static(outline, &line(colour, 1.25));
        }
        let path = |k: usize, lines: &PathLines| {
            PathCurve::new(stream, PATHS[k], lines, CURVES[k], &line_of_action)
        };
        let [pressure, sliding, radius] = PathLines::of(scene, &tooth, &line_of_action);
        Some(Self {
            paths: [path(0, &pressure), path(1, &sliding), path(2, &radius)],
            tooth,
            gears,
            line: line_of_action,
        })
    }

    /// The picture of the gears and those of the path.
    pub(crate) fn plots(&self) -> ShownTooth {
        ShownTooth {
            gears: gears_box(&self.gears),
            paths: self.paths.each_ref().map(|path| path.plot.clone()),
        }
    }
}

impl View for ToothEntity {
    /// Its ranges are those of the whole path.
    fn widen(&mut self, _stream: &Stream, _scene: Option<&Scene>, _scope: &Scope) {}

    /// Where the contact is now.
    fn log(&mut self, stream: &Stream, frame: &Frame) {
        let line = &self.line;
        let place_m = self.tooth.place_m(line, frame.time_s);
        // After E the run goes on as it was there.
        let clamped_m = place_m.clamp(line.a, line.e);
        let [across, high] = half_picture(&self.gears);
        for (gear, entity) in OUTLINES.into_iter().enumerate() {
            let mut strips = Strips::default();
            for at in self.gears.outline(line, gear, clamped_m, 2) {
                let [x, y] = [at[0] * MM, -at[1] * MM];
                if x.abs() <= across && y.abs() <= high {
                    strips.to([x as f32, y as f32]);
                } else {
                    strips.lift();
                }
            }
            strips.log(stream, entity);
        }
        let at = in_view(self.gears.contact(line, clamped_m));
        stream.log(CONTACT, &Points2D::update_fields().with_positions([at]));
        let m = &frame.metrics;
        let radius_mm = MM * clamped_m * (line.length - clamped_m) / line.length;
        let values = [GPA.of(frame.p_hertz_pa), m.slide_roll, radius_mm];
        for (path, value) in self.paths.iter().zip(values) {
            path.log(stream, (clamped_m - line.a) * MM, value);
        }
    }
}

/// What the layout has to know of a tooth.
pub(crate) struct ShownTooth {
    pub(crate) gears: PlotBox,
    pub(crate) paths: [PlotBox; 3],
}

impl PathCurve {
    fn new(
        stream: &Stream,
        entity: &'static str,
        lines: &PathLines,
        colour: [u8; 3],
        line_of_action: &LineOfAction,
    ) -> Self {
        let PathLines { run, tooth } = lines;
        let all = || run.iter().chain(tooth).map(|[_, y]| *y);
        let (minimum, maximum) = (all().fold(0.0, f64::min), all().fold(0.0, f64::max));
        let top = nice_ceiling(maximum.max(1e-9));
        let range = [
            if minimum < 0.0 {
                -nice_ceiling(-minimum)
            } else {
                0.0
            },
            top,
        ];
        let long = (line_of_action.e - line_of_action.a) * MM;
        let plot = PlotBox {
            x: [0.0, long],
            y: [-HEIGHT * long, 0.0],
            x_ticks: ticks_at(&ticks(0.0, long, 6), |x| x),
            left_ticks: ticks_at(&ticks(range[0], range[1], 3), |y| height(y, range, long)),
            x_title: "path of contact from A, mm".into(),
            ..PlotBox::default()
        };
        plot.log(stream, &format!("{entity}/axes"), Holds::Always);
        for (part, values, colour, radius) in
            [("tooth", tooth, GREY, 0.75), ("curve", run, colour, 1.5)]
        {
            let strip = values.iter().map(|[x, y]| [*x, height(*y, range, long)]);
            let strip = points(&strip.collect::<Vec<_>>());
            let curve = line(colour, radius).with_strips([strip]);
            stream.log_static(format!("{entity}/{part}"), &curve);
        }
        log_places(stream, entity, &plot, line_of_action);
        let now = dot(GREEN, 5.0);
        stream.log_static(format!("{entity}/now"), &now);
        stream.log_static(format!("{entity}/line_at_now"), &line(GREEN, 1.0));
        Self {
            plot,
            range,
            entity,
        }
    }

    /// A line at the contact's place and the run's own value on it.
    fn log(&self, stream: &Stream, place_mm: f64, value: f64) {
        let [x, [top, bottom]] = [self.plot.x, self.plot.y];
        let place = place_mm.clamp(x[0], x[1]) as f32;
        let mut strip = Strips::default();
        strip.to([place, top as f32]);
        strip.to([place, bottom as f32]);
        strip.log(stream, &format!("{}/line_at_now", self.entity));
        let y = height(value, self.range, x[1]).clamp(top, bottom) as f32;
        let now = Points2D::update_fields().with_positions([[place, y]]);
        stream.log(&format!("{}/now", self.entity), &now);
        let mut label = Labels::default();
        // Within the plot, so that no edge cuts it off.
        let aside = 0.05 * (x[1] - x[0]);
        let at = place_mm.clamp(x[0] + aside, x[1] - aside);
        label.add([at, f64::from(y)], &sig(value, 3));
        let entity = format!("{}/now/value", self.entity);
        label.log(stream, &entity, Holds::FromNow);
    }
}

/// Where a value lies in the view of a path of that length.
fn height(value: f64, [low, top]: [f64; 2], long: f64) -> f64 {
    -HEIGHT * long * (value - low) / (top - low)
}

/// B, C and D in a curve of the path.
fn log_places(stream: &Stream, entity: &str, plot: &PlotBox, line_of_action: &LineOfAction) {
    let LineOfAction { a, b, c, d, .. } = *line_of_action;
    let [top, bottom] = plot.y;
    let at = [b, c, d].map(|place| (place - a) * MM);
    let lines = at.map(|x| points(&[[x, top], [x, bottom]]));
    let colours = [GREY, WHITE, GREY].map(|colour| faded(colour, 150));
    let lines = LineStrips2D::new(lines)
        .with_colors(colours)
        .with_radii([Radius::new_ui_points(0.5)])
        .with_draw_order(8.0);
    stream.log_static(format!("{entity}/places"), &lines);
    let mut labels = Labels::default();
    for (x, text) in at.into_iter().zip(["B", "C", "D"]) {
        labels.add([x, bottom - 0.2 * (bottom - top)], text);
    }
    labels.log(stream, &format!("{entity}/names"), Holds::Always);
}

/// Half the picture's width and height, mm.
fn half_picture(gears: &GearTeeth) -> [f64; 2] {
    PICTURE.map(|modules| 0.5 * modules * gears.module_m * MM)
}

fn gears_box(gears: &GearTeeth) -> PlotBox {
    let [across, high] = half_picture(gears);
    PlotBox {
        x: [-across, across],
        y: [-high, high],
        ..PlotBox::default()
    }
}

/// From the pitch point upwards to the viewer's view.
fn in_view([x, y]: [f64; 2]) -> [f32; 2] {
    [(x * MM) as f32, (-y * MM) as f32]
}

/// The line of action with its places, and what is what.
fn log_line(stream: &Stream, gears: &GearTeeth, line_of_action: &LineOfAction) {
    let LineOfAction { a, b, c, d, e, .. } = *line_of_action;
    let place = |s: f64| in_view(gears.contact(line_of_action, s));
    let way = line(GREY, 1.0).with_strips([[place(a), place(e)]]);
    stream.log_static(format!("{GEARS}/line_of_action"), &way);
    let places = [a, b, c, d, e].map(place);
    let marks = Points2D::new(places)
        .with_radii([2.5, 2.5, 4.0, 2.5, 2.5].map(Radius::new_ui_points))
        .with_colors([faded(WHITE, u8::MAX)])
        .with_draw_order(24.0);
    stream.log_static(format!("{GEARS}/places"), &marks);
    let [across, high] = half_picture(gears);
    let mut labels = Labels::default();
    let below = 0.05 * high;
    for ([x, y], text) in places
        .into_iter()
        .zip(["A", "B", "C: pitch point", "D", "E"])
    {
        labels.add([f64::from(x), f64::from(y) + below], text);
    }
    labels.add([-0.62 * across, 0.86 * high], "pinion (body 1), drives →");
    labels.add([0.66 * across, -0.97 * high], "wheel (body 2) →");
    labels.log(stream, &format!("{GEARS}/names"), Holds::Always);
    let contact = dot(ORANGE, 7.0).with_draw_order(28.0);
    stream.log_static(CONTACT, &contact);
}
