//! The page of a ride along a gear's tooth: both gears with the contact on the line of action, below them Hertz pressure,
//! sliding and radius over the path of contact, each with the run's own value on it.

use super::centre_line::{FILM, PRESSURE};
use super::history::BAND;
use super::plotted::SECOND;
use super::profile::POINT;
use super::sheet::Sheet;
use crate::draw::{Axis, Drawing, INK, Rect, Rgb, Side, Text, TextAnchor};
use crate::tooth::{PICTURE, PathLines};
use asperity_engine::math::number::{GPA, MM, nice_ceiling, plain, sig};
use asperity_engine::physics::gear::{GearTeeth, LineOfAction};
use asperity_engine::scene::{Scene, Tooth};
use asperity_engine::sim::Frame;

/// Heights over the width: of the gears, of the room below them, of a curve and the room below it.
const PARTS: [f64; 4] = [0.5, 0.1, 0.2, 0.08];
/// What stands over the path.
const TITLES: [&str; 3] = ["p_h, GPa", "S", "R, mm"];
const COLOURS: [Rgb; 3] = [PRESSURE, SECOND, FILM];

/// Draws it; `None`: the scene rides along no tooth.
pub(super) fn draw(frame: &Frame, scene: &Scene, sheet: &Sheet, x_title: &str) -> Option<Drawing> {
    let tooth = scene.tooth?;
    let gears = tooth.gears();
    let line = gears.line_of_action()?;
    let [high, gap, curve, room] = PARTS;
    let whole = high + gap + 3.0 * curve + 2.0 * room;
    let (mut drawing, all) = sheet.begin(1.0, whole);
    let part = |from: f64, high: f64| Rect {
        top: all.top + (from / whole * all.high).round(),
        high: (high / whole * all.high).round(),
        ..all
    };
    // After E the run goes on as it was there.
    let place_m = tooth.place_m(&line, frame.time_s).clamp(line.a, line.e);
    draw_gears(&mut drawing, part(0.0, high), &gears, &line, place_m);
    let radius_mm = MM * place_m * (line.length - place_m) / line.length;
    let now = [
        GPA.of(frame.p_hertz_pa),
        frame.metrics.slide_roll,
        radius_mm,
    ];
    for (k, lines) in PathLines::of(scene, &tooth, &line).iter().enumerate() {
        let area = part(high + gap + k as f64 * (curve + room), curve);
        let path = Path {
            line: &line,
            title: TITLES[k],
            colour: COLOURS[k],
            now: [(place_m - line.a) * MM, now[k]],
        };
        path.draw(&mut drawing, area, lines, if k == 2 { x_title } else { "" });
    }
    Some(drawing)
}

/// Both outlines, the line of action with its places, and the contact.
fn draw_gears(
    drawing: &mut Drawing,
    area: Rect,
    gears: &GearTeeth,
    line: &LineOfAction,
    place_m: f64,
) {
    let [across, up] = PICTURE.map(|modules| 0.5 * modules * gears.module_m);
    let scale = (0.5 * area.wide / across).min(0.5 * area.high / up);
    let middle = area.at(0.5, 0.5);
    let place = |[x, y]: [f64; 2]| [middle[0] + scale * x, middle[1] - scale * y];
    let (em, width) = (drawing.font(), drawing.unit().curve());
    for (gear, colour) in [(0, FILM), (1, BAND)] {
        let outline = gears.outline(line, gear, place_m, 2);
        let inside = |[x, y]: &[f64; 2]| x.abs() <= across && y.abs() <= up;
        for part in outline.split(|at| !inside(at)) {
            drawing.line(part.iter().map(|at| place(*at)).collect(), colour, width);
        }
    }
    let at = |s: f64| place(gears.contact(line, s));
    drawing.line(vec![at(line.a), at(line.e)], INK, 0.5 * width);
    drawing.dot(at(place_m), 0.35 * em, POINT);
    for (s, name) in [
        (line.a, "A"),
        (line.b, "B"),
        (line.c, "C"),
        (line.d, "D"),
        (line.e, "E"),
    ] {
        let [x, y] = at(s);
        drawing.dot([x, y], 0.15 * em, INK);
        drawing.cleared(Text::new([x + 0.3 * em, y + 1.2 * em], name));
    }
    for (words, y) in [
        ("wheel (body 2)", area.top + em),
        ("pinion (body 1), drives", area.bottom()),
    ] {
        drawing.text(Text::new([area.left, y], words));
    }
}

/// A quantity over the path of contact.
struct Path<'a> {
    line: &'a LineOfAction,
    title: &'a str,
    colour: Rgb,
    /// Where the contact is, mm from A, and what it is there.
    now: [f64; 2],
}

impl Path<'_> {
    fn draw(&self, drawing: &mut Drawing, area: Rect, lines: &PathLines, x_title: &str) {
        let LineOfAction { a, b, c, d, e, .. } = *self.line;
        let all = || {
            lines
                .run
                .iter()
                .chain(&lines.tooth)
                .map(|at| at[1])
                .chain([self.now[1]])
        };
        let ceiling = |value: f64| {
            if value > 0.0 {
                nice_ceiling(value)
            } else {
                0.0
            }
        };
        let top = ceiling(all().fold(0.0, f64::max));
        let low = -ceiling(-all().fold(0.0, f64::min));
        let x = Axis::linear([0.0, (e - a) * MM], x_title);
        let mut y = Axis::linear([low, top], self.title);
        // There is little room.
        let mut values = vec![low, 0.0, top];
        values.dedup();
        y.labels = values
            .into_iter()
            .map(|value| (value, plain(value)))
            .collect();
        let place = |[at, value]: [f64; 2]| area.at(x.share(at), y.share(value));
        let (em, width) = (drawing.font(), drawing.unit().curve());
        for (at, name) in [(b, "B"), (c, "C"), (d, "D")] {
            let share = x.share((at - a) * MM);
            drawing.line(
                vec![area.at(share, 0.0), area.at(share, 1.0)],
                BAND,
                0.3 * width,
            );
            let [at_x, at_y] = area.at(share, 1.0);
            let label = Text::new([at_x, at_y - 0.4 * em], name);
            drawing.text(label.anchored(TextAnchor::Middle));
        }
        for (values, colour, wide) in [(&lines.tooth, BAND, 0.7), (&lines.run, self.colour, 1.3)] {
            let points = values.iter().map(|at| place(*at));
            drawing.line(points.collect(), colour, wide * width);
        }
        let here = place(self.now);
        drawing.dot(here, 0.35 * em, POINT);
        let (off, anchor) = if x.share(self.now[0]) > 0.5 {
            (-0.6, TextAnchor::End)
        } else {
            (0.6, TextAnchor::Start)
        };
        let up = if y.share(self.now[1]) > 0.7 {
            1.4
        } else {
            -0.5
        };
        let label = Text::new([here[0] + off * em, here[1] + up * em], sig(self.now[1], 3));
        drawing.cleared(label.anchored(anchor));
        drawing.frame(area);
        drawing.axis(area, Side::Left, &y.coloured(self.colour));
        if !x_title.is_empty() {
            drawing.axis(area, Side::Below, &x);
        }
    }
}

/// Whether a scene rides along a tooth.
pub(super) fn rides(tooth: Option<&Tooth>) -> bool {
    tooth.is_some_and(|tooth| tooth.gears().line_of_action().is_some())
}
