//! Curves over an axis.

use super::{Layout, Scale, TYPE, axis, titled};
use crate::draw::{Drawing, Rect, Rgb, Side, Text, text_width};

/// Dark enough on white; named in the legend in this order, too.
const COLOURS: [Rgb; 9] = [
    [31, 119, 180],
    [214, 39, 40],
    [44, 160, 44],
    [255, 127, 14],
    [148, 103, 189],
    [140, 86, 75],
    [90, 90, 90],
    [23, 190, 207],
    [227, 119, 194],
];

/// Formulas, told apart.
const GREYS: [Rgb; 3] = [[130; 3], [70; 3], [180; 3]];

/// Lines at values of y.
const LEVEL: Rgb = [153; 3];

/// Radius of a dot, pixels.
const DOT: f64 = 4.0;

/// What a curve is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// Line and dots: what was computed.
    Computed,
    /// A grey line: a formula.
    Formula,
}

/// A curve.
#[derive(Debug, Clone)]
pub struct Curve {
    /// For the legend.
    pub name: String,
    /// x, y; what has no place on the axes is left out.
    pub points: Vec<(f64, f64)>,
    /// What it is made of.
    pub mark: Mark,
}

/// A figure of curves.
#[derive(Debug, Clone)]
pub struct Figure {
    /// Above it.
    pub title: String,
    /// Label and scale.
    pub x: (String, Scale),
    /// Same upwards.
    pub y: (String, Scale),
    /// The curves, in the order of the colours.
    pub curves: Vec<Curve>,
    /// Values of y with a line all along.
    pub levels: Vec<f64>,
}

/// Minimum and maximum with a margin; a single value gets room on both sides.
fn span(places: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for place in places {
        (low, high) = (low.min(place), high.max(place));
    }
    let room = if high > low {
        0.05 * (high - low)
    } else {
        0.5 * low.abs().max(1e-9)
    };
    (low <= high).then_some([low - room, high + room])
}

/// Whether a line or one of its dots lies in an area; pieces are looked at in sixteenths.
fn within(line: &[[f64; 2]], area: &Rect) -> bool {
    const PARTS: i32 = 16;
    let is_in = |[x, y]: [f64; 2]| {
        (area.left - DOT..=area.left + area.wide + DOT).contains(&x)
            && (area.top - DOT..=area.top + area.high + DOT).contains(&y)
    };
    let pieces = line.windows(2).flat_map(|ends| {
        let along = |part: i32| f64::from(part) / f64::from(PARTS);
        let between =
            move |axis: usize, t: f64| ends[0][axis] + t * (ends[1][axis] - ends[0][axis]);
        (0..=PARTS).map(move |part| [0, 1].map(|axis| between(axis, along(part))))
    });
    line.iter().copied().chain(pieces).any(is_in)
}

impl Figure {
    /// Where the points of a curve lie; what has no place is left out.
    fn places(&self, curve: &Curve) -> Vec<[f64; 2]> {
        let place = |&(x, y): &(f64, f64)| Some([self.x.1.place(x)?, self.y.1.place(y)?]);
        curve.points.iter().filter_map(place).collect()
    }

    /// Width and height of the names of the curves, sizes of type.
    fn legend_size(&self) -> [f64; 2] {
        let names = self.curves.iter().map(|curve| text_width(&curve.name));
        [
            names.fold(0.0, f64::max) + 3.2,
            1.4 * self.curves.len() as f64 + 0.6,
        ]
    }

    /// The corner of the plot where a legend hides nothing of what `drawn` has, the upper right one first; `None`: there is none.
    fn free_corner(&self, plot: Rect, drawn: &[Vec<[f64; 2]>]) -> Option<Rect> {
        let [wide, high] = self.legend_size().map(|size| size * TYPE);
        let far = 0.5 * TYPE;
        let lefts = [plot.right() - wide - far, plot.left + far];
        let tops = [plot.top + far, plot.bottom() - high - far];
        let corners = tops.into_iter().flat_map(|top| {
            lefts.map(|left| Rect {
                left,
                top,
                wide,
                high,
            })
        });
        let is_free = |area: &Rect| !drawn.iter().any(|line| within(line, area));
        corners.into_iter().find(is_free)
    }

    fn draw_legend(&self, drawing: &mut Drawing, area: Rect) {
        let em = drawing.font();
        drawing.fill_rect(area, [255; 3]);
        for (k, curve) in self.curves.iter().enumerate() {
            let y = area.top + (1.4 * k as f64 + 1.4) * em;
            let (from, to) = (area.left + 0.4 * em, area.left + 2.2 * em);
            let (colour, line_y) = (curve.colour(k), y - 0.35 * em);
            drawing.line(vec![[from, line_y], [to, line_y]], colour, curve.width());
            drawing.text(Text::new([to + 0.5 * em, y], &*curve.name));
        }
    }
}

impl Layout for Figure {
    fn drawing(&self) -> Option<Drawing> {
        let curves: Vec<Vec<[f64; 2]>> =
            self.curves.iter().map(|curve| self.places(curve)).collect();
        let levels = self.levels.iter();
        let levels: Vec<f64> = levels.filter_map(|level| self.y.1.place(*level)).collect();
        let all = || curves.iter().flatten();
        let x_ends = span(all().map(|at| at[0]))?;
        let y_ends = span(all().map(|at| at[1]).chain(levels.clone()))?;
        let x = axis(self.x.1, x_ends, &self.x.0);
        let y = axis(self.y.1, y_ends, &self.y.0);
        let on_paper = |plot: Rect| -> Vec<Vec<[f64; 2]>> {
            let at = |at: &[f64; 2]| plot.at(x.share(at[0]), y.share(at[1]));
            let lines = curves.iter();
            lines
                .map(|points| points.iter().map(at).collect())
                .collect()
        };
        let (mut drawing, mut plot) = titled(&self.title, &y, 1.5);
        let mut drawn = on_paper(plot);
        let mut legend = self.free_corner(plot, &drawn);
        if self.curves.len() > 1 && legend.is_none() {
            // Beside the plot it hides nothing.
            let [wide, high] = self.legend_size();
            (drawing, plot) = titled(&self.title, &y, wide + 1.5);
            drawn = on_paper(plot);
            legend = Some(Rect {
                left: plot.right() + 0.5 * TYPE,
                top: plot.top,
                wide: wide * TYPE,
                high: high * TYPE,
            });
        }
        drawing.grid(plot, &x, &y);
        for level in levels {
            let at = y.share(level);
            drawing.line(vec![plot.at(0.0, at), plot.at(1.0, at)], LEVEL, 1.0);
        }
        for (k, (curve, points)) in self.curves.iter().zip(&drawn).enumerate() {
            if curve.mark == Mark::Computed {
                for at in points {
                    drawing.dot(*at, DOT, curve.colour(k));
                }
            }
            drawing.line(points.clone(), curve.colour(k), curve.width());
        }
        drawing.frame(plot);
        drawing.axis(plot, Side::Below, &x);
        drawing.axis(plot, Side::Left, &y);
        if let Some(area) = legend.filter(|_| self.curves.len() > 1) {
            self.draw_legend(&mut drawing, area);
        }
        Some(drawing)
    }
}

impl Curve {
    fn colour(&self, k: usize) -> Rgb {
        match self.mark {
            Mark::Computed => COLOURS[k % COLOURS.len()],
            Mark::Formula => GREYS[k % GREYS.len()],
        }
    }

    fn width(&self) -> f64 {
        match self.mark {
            Mark::Computed => 2.0,
            Mark::Formula => 1.0,
        }
    }
}

#[cfg(test)]
#[expect(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::super::Chart as _;
    use super::*;

    fn figure(points: &[(f64, f64)]) -> Figure {
        Figure {
            title: "Title".to_owned(),
            x: ("S".to_owned(), Scale::Linear),
            y: ("life".to_owned(), Scale::Log),
            curves: vec![Curve {
                name: "one".to_owned(),
                points: points.to_vec(),
                mark: Mark::Computed,
            }],
            levels: vec![0.1],
        }
    }

    #[test]
    fn a_figure_is_drawn_as_svg_and_as_png() {
        let figure = figure(&[(0.0, 1.0), (1.0, 0.02), (2.0, f64::NAN)]);
        let text = figure.svg().unwrap().unwrap();
        assert!(text.starts_with("<svg") && text.contains("Title") && text.contains("life"));
        // The two points that have a place.
        assert_eq!(text.matches("<polygon").count(), 2);
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("figure.png");
        assert_eq!(figure.png(&path), Ok(true));
        let bytes = std::fs::read(&path).unwrap();
        // Signature, then width and height of the header.
        assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n");
        assert_eq!(&bytes[16..24], [0, 0, 3, 132, 0, 0, 2, 88]);
        assert!(figure.png(&folder.path().join("no/figure.png")).is_err());
    }

    /// A curve through every corner leaves none for the names: they stand beside the plot, and each point is seen.
    #[test]
    fn the_names_of_curves_hide_none_of_them() {
        let mut crossed = figure(&[(0.0, 1.0), (1.0, 0.01), (0.0, 0.01), (1.0, 1.0)]);
        let second = Curve {
            name: "another".to_owned(),
            ..crossed.curves[0].clone()
        };
        let name_at = |figure: &Figure| -> f64 {
            let text = figure.svg().unwrap().unwrap();
            let place = text.split("another").next().unwrap();
            let x = place.rsplit(" x=\"").next().unwrap();
            x.split('"').next().unwrap().parse().unwrap()
        };
        crossed.curves.push(second.clone());
        let beside = name_at(&crossed);
        let mut calm = figure(&[(0.0, 0.01), (1.0, 0.01), (1.0, 0.02)]);
        calm.curves.push(Curve {
            points: vec![(0.0, 1.0)],
            ..second
        });
        let within = name_at(&calm);
        let ends = |figure: &Figure| {
            let text = figure.svg().unwrap().unwrap();
            let dots = text.split("<polygon ").skip(1);
            let points = dots.filter_map(|dot| dot.split(" points=\"").nth(1));
            let first = points.filter_map(|points| points.split(',').next()?.parse().ok());
            first.fold(0.0, f64::max)
        };
        assert!(beside > ends(&crossed), "{beside} {}", ends(&crossed));
        assert!(within < ends(&calm), "{within} {}", ends(&calm));
    }

    #[test]
    fn nothing_is_drawn_of_nothing() {
        let mut empty = figure(&[(0.0, 0.0), (1.0, -1.0)]);
        empty.levels.clear();
        assert_eq!(empty.svg(), Ok(None));
    }
}
