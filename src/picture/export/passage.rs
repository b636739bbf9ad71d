//! The page of the passage: both surfaces with the oil between them, under them the pressure that the followed point has
//! met, above them what the life comes to.

use super::centre_line::PRESSURE;
use super::profile::{HEIGHT, POINT, ProfilePage};
use super::sheet::Sheet;
use crate::draw::{Axis, Drawing, Rect, Rgb, Side, Text, TextAnchor, text_width};
use crate::{PointTrace, TracePoint};
use asperity_engine::math::number::{GPA, MM, counted, plain, sig};
use asperity_engine::sim::{Frame, MaterialPoint};

/// Room between the profile and the trace, and height of the trace, over the width.
const BETWEEN: f64 = 0.08;
const TRACE: f64 = 0.3;
/// The crossing before.
const BEFORE: Rgb = [150, 155, 165];

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
    let inside = |[at_m, _]: &TracePoint| (x.ends[0]..=x.ends[1]).contains(&(at_m * MM));
    let place = |[at_m, pa]: &TracePoint| {
        let (at, p) = (at_m * MM, GPA.of(*pa).min(y.ends[1]));
        plot.at(x.share(at), y.share(p))
    };
    let width = drawing.unit().curve();
    for (curve, colour, wide) in [
        (&trace.before, BEFORE, 0.7 * width),
        (&trace.pressure, PRESSURE, 1.5 * width),
    ] {
        let points = curve.iter().filter(|at| inside(at)).map(place);
        drawing.line(points.collect(), colour, wide);
    }
    let em = drawing.font();
    for (number, peak) in trace.peaks.iter().filter(|(_, at)| inside(at)) {
        let [at_x, at_y] = place(peak);
        drawing.dot([at_x, at_y], 0.25 * em, PRESSURE);
        let label = Text::new([at_x, at_y - 0.7 * em], number.to_string());
        drawing.text(label.anchored(TextAnchor::Middle));
    }
    let has_point = frame.material_point.is_some();
    let here = trace.pressure.last();
    let here = here.filter(|at| inside(at) && has_point);
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
        drawing.plate(text.anchored(TextAnchor::Middle));
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

/// The life in words, for the heading: what a picture without a word leaves open. The band is the step's own, or that of the
/// run's end.
pub(super) fn life(frame: &Frame, band: Option<[f64; 2]>) -> Option<String> {
    let life = frame.metrics.life.as_ref()?;
    let [low, high] = band.unwrap_or([life.life_relative_low, life.life_relative_high]);
    let [value, low, high] = [life.life_relative, low, high].map(|life| sig(life, 3));
    let slide_roll = sig(frame.metrics.slide_roll, 3);
    Some(format!("S = {slide_roll}: life {value} ({low} to {high})"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_point_has_met_is_said_at_length_and_shortly() {
        let mut point = MaterialPoint {
            body: 2,
            cycles_counted: 1.0,
            ..MaterialPoint::default()
        };
        assert_eq!(met(&point)[0], "a point of body 2: 1 contact so far");
        point.cycles_before = Some(3.0);
        assert_eq!(met(&point)[1], "body 2: 1 contact so far, 3 before (grey)");
        assert_eq!(met(&point)[2], "body 2: 1 contact");
    }
}
