//! The page of the passage: both surfaces with the oil between them, under them the pressure that the followed point has
//! met, above them what the life comes to.

use super::centre_line::PRESSURE;
use super::profile::{HEIGHT, POINT, ProfilePage};
use super::sheet::Sheet;
use crate::draw::{Axis, Drawing, Rect, Rgb, Side, Text, TextAnchor, text_width};
use asperity_engine::math::number::{GPA, MM, counted, plain, sig};
use asperity_engine::sim::{Frame, MaterialPoint};

/// Room between the profile and the trace, and height of the trace, over the width.
const BETWEEN: f64 = 0.08;
const TRACE: f64 = 0.3;
/// The crossing before.
const BEFORE: Rgb = [150, 155, 165];

/// Pressures that the followed point has met in its crossing, and in the one before: x, mm, and GPa.
#[derive(Debug, Default)]
pub(super) struct PointTrace {
    body: u8,
    last_x_m: f64,
    now: Vec<(f64, f64)>,
    before: Vec<(f64, f64)>,
    peaks: Vec<(f64, f64)>,
}

impl PointTrace {
    /// Takes up a step. A point that begins anew is far from where it was.
    pub(super) fn follow(&mut self, frame: &Frame) {
        let Some(point) = &frame.material_point else {
            return;
        };
        if point.body != self.body || (point.x_m - self.last_x_m).abs() > frame.a_m {
            self.before = std::mem::take(&mut self.now);
            self.peaks.clear();
        }
        (self.body, self.last_x_m) = (point.body, point.x_m);
        let place = |x_m: f64, pressure_pa: f64| (x_m * MM, GPA.of(pressure_pa));
        self.now.push(place(point.x_m, point.pressure_pa));
        let peak = point
            .last_peak
            .map(|peak| place(peak.x_m, peak.pressure_pa));
        let counted = point.cycles_counted as usize;
        self.peaks
            .extend(peak.filter(|_| counted > self.peaks.len()));
    }
}

/// Draws it.
pub(super) fn draw(
    frame: &Frame,
    profile: &ProfilePage,
    trace: &PointTrace,
    pressure_pa: f64,
    sheet: &Sheet,
    x_title: &str,
) -> Drawing {
    let parts = [HEIGHT, BETWEEN, TRACE];
    let share = 1.0 / parts.iter().sum::<f64>();
    let (mut drawing, all) = sheet.begin(1.0, 1.0 / share);
    let part = |from: f64, high: f64| Rect {
        top: all.top + (from * share * all.high).round(),
        high: (high * share * all.high).round(),
        ..all
    };
    let upper = part(0.0, HEIGHT);
    profile.draw_on(&mut drawing, upper, sheet);
    say_speeds(&mut drawing, upper, frame);
    let plot = part(HEIGHT + BETWEEN, TRACE);
    let x = Axis::linear(profile.x_mm(), x_title);
    let y = Axis::linear([0.0, GPA.of(pressure_pa)], "p, GPa");
    drawing.grid(plot, &x, &y);
    let inside = |at: &(f64, f64)| (x.ends[0]..=x.ends[1]).contains(&at.0);
    let place = |at: &(f64, f64)| plot.at(x.share(at.0), y.share(at.1.min(y.ends[1])));
    let width = drawing.unit().curve();
    for (curve, colour, wide) in [
        (&trace.before, BEFORE, 0.7 * width),
        (&trace.now, PRESSURE, 1.5 * width),
    ] {
        let points = curve.iter().filter(|at| inside(at)).map(place);
        drawing.line(points.collect(), colour, wide);
    }
    let em = drawing.font();
    for (number, peak) in trace.peaks.iter().filter(|at| inside(at)).enumerate() {
        let [at_x, at_y] = place(peak);
        drawing.dot([at_x, at_y], 0.25 * em, PRESSURE);
        let label = Text::new([at_x, at_y - 0.5 * em], (number + 1).to_string());
        drawing.text(label.anchored(TextAnchor::Middle).coloured(PRESSURE));
    }
    let here = trace
        .now
        .last()
        .filter(|at| inside(at) && frame.material_point.is_some());
    if let Some(here) = here {
        let [at_x, at_y] = place(here);
        if let Some([along, down]) = profile.point() {
            let from = upper.at(along, 1.0 - down);
            drawing.line(vec![from, [at_x, at_y]], POINT, 0.6 * width);
        }
        drawing.dot([at_x, at_y], 0.35 * em, POINT);
    }
    if let Some(point) = &frame.material_point {
        let room = (plot.wide + em) / em;
        let fits = |words: &String| text_width(words) <= room;
        let words = met(point).into_iter().find(fits).unwrap_or_default();
        drawing.text(Text::new([plot.left, plot.top - 0.5 * em], words));
    }
    drawing.frame(plot);
    drawing.axis(plot, Side::Below, &x);
    drawing.axis(plot, Side::Left, &y);
    drawing
}

/// Which body is which and how fast, on the profile.
fn say_speeds(drawing: &mut Drawing, upper: Rect, frame: &Frame) {
    let m = &frame.metrics;
    let em = drawing.font();
    let middle = upper.left + 0.5 * upper.wide;
    for (body, sign, y) in [
        (2, 0.5, upper.top + 1.5 * em),
        (1, -0.5, upper.bottom() - 0.8 * em),
    ] {
        let speed = m.entrainment_m_s * (1.0 + sign * m.slide_roll);
        let arrow = match speed {
            0.0 => "",
            u if u > 0.0 => " →",
            _ => " ←",
        };
        let words = format!("body {body}: {} m/s{arrow}", sig(speed, 3));
        let text = Text::new([middle, y], words);
        drawing.text(text.anchored(TextAnchor::Middle).coloured([255; 3]));
    }
}

/// What the followed point has met, in words: at length and where there is less room.
fn met(point: &MaterialPoint) -> [String; 3] {
    let (body, now) = (point.body, counted(point.cycles_counted as u64, "contact"));
    let long = |before| format!(", {} in the crossing before (grey)", plain(before));
    let short = |before| format!(", {} before (grey)", plain(before));
    let before =
        |words: &dyn Fn(f64) -> String| point.cycles_before.map_or_else(String::new, words);
    [
        format!("a point of body {body}: {now} so far{}", before(&long)),
        format!("body {body}: {now} so far{}", before(&short)),
        format!("body {body}: {now}"),
    ]
}

/// The life in words, for the heading: what a picture without a word leaves open.
pub(super) fn life(frame: &Frame) -> Option<String> {
    let life = frame.metrics.life.as_ref()?;
    let [value, low, high] = [
        life.life_relative,
        life.life_relative_low,
        life.life_relative_high,
    ]
    .map(|life| sig(life, 3));
    let slide_roll = sig(frame.metrics.slide_roll, 3);
    Some(format!("S = {slide_roll}: life {value} ({low} to {high})"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_engine::sim::PassedPeak;

    fn frame(x_m: f64, pressure_pa: f64, counted: f64) -> Frame {
        Frame {
            a_m: 1e-3,
            material_point: Some(MaterialPoint {
                body: 2,
                x_m,
                pressure_pa,
                cycles_counted: counted,
                last_peak: (counted > 0.0).then_some(PassedPeak {
                    x_m: -2e-4,
                    pressure_pa: 2e9,
                }),
                ..MaterialPoint::default()
            }),
            ..Frame::default()
        }
    }

    #[test]
    fn a_trace_has_a_crossing_its_peaks_once_and_the_crossing_before() {
        let mut trace = PointTrace::default();
        for (x_m, pressure_pa, counted) in
            [(-4e-4, 1e9, 0.0), (-1e-4, 1.5e9, 1.0), (2e-4, 1e9, 1.0)]
        {
            trace.follow(&frame(x_m, pressure_pa, counted));
        }
        assert_eq!(trace.now, [(-0.4, 1.0), (-0.1, 1.5), (0.2, 1.0)]);
        assert_eq!(trace.peaks, [(-0.2, 2.0)]);
        assert!(trace.before.is_empty());
        // It begins anew.
        trace.follow(&frame(-1.2e-3, 0.0, 0.0));
        assert_eq!(
            (trace.now.len(), trace.before.len(), trace.peaks.len()),
            (1, 3, 0)
        );
        let words = met(&frame(0.0, 1e9, 1.0).material_point.unwrap_or_default());
        assert_eq!(words[0], "a point of body 2: 1 contact so far");
    }
}
