//! Curves over an axis.

use plotters::coord::Shift;
use plotters::prelude::*;

use super::scale::Axis;
use super::{BELOW, BESIDE, Chart, Drawn, FONT, Scale, told};

/// Dark enough on white; named in the legend in this order, too.
const COLOURS: [RGBColor; 9] = [
    RGBColor(31, 119, 180),
    RGBColor(214, 39, 40),
    RGBColor(44, 160, 44),
    RGBColor(255, 127, 14),
    RGBColor(148, 103, 189),
    RGBColor(140, 86, 75),
    RGBColor(90, 90, 90),
    RGBColor(23, 190, 207),
    RGBColor(227, 119, 194),
];

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

/// Where the legend stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Corner {
    /// Curves that fall leave it free.
    UpperRight,
    /// Curves that rise leave it free.
    UpperLeft,
    /// Curves that start high leave it free.
    LowerLeft,
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
    /// Where the legend stands, if there is more than one curve.
    pub legend: Corner,
}

/// Least and greatest with a margin; a single value gets room on both sides.
fn span(places: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for place in places {
        (low, high) = (low.min(place), high.max(place));
    }
    let room = if high > low {
        0.05 * (high - low)
    } else {
        0.5 * low.abs().max(1e-9)
    };
    (low <= high).then_some((low - room, high + room))
}

impl Chart for Figure {
    fn draw<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>) -> Result<Drawn, String> {
        let place = |&(x, y): &(f64, f64)| Some((self.x.1.place(x)?, self.y.1.place(y)?));
        let curves: Vec<Vec<(f64, f64)>> = self
            .curves
            .iter()
            .map(|curve| curve.points.iter().filter_map(place).collect())
            .collect();
        let levels: Vec<f64> = self
            .levels
            .iter()
            .filter_map(|level| self.y.1.place(*level))
            .collect();
        let all = || curves.iter().flatten();
        let ys = all().map(|p| p.1);
        let (Some(x), Some(y)) = (span(all().map(|p| p.0)), span(ys.chain(levels.clone()))) else {
            return Ok(Drawn::Nothing);
        };
        let mut chart = ChartBuilder::on(area)
            .caption(&self.title, (FONT, 20))
            .margin(12)
            .margin_right(20)
            .x_label_area_size(BELOW)
            .y_label_area_size(BESIDE)
            .build_cartesian_2d(Axis::new(self.x.1, x), Axis::new(self.y.1, y))
            .map_err(told)?;
        chart
            .configure_mesh()
            .x_desc(&self.x.0)
            .y_desc(&self.y.0)
            .axis_desc_style((FONT, 15))
            .label_style((FONT, 14))
            .x_label_formatter(&|v| self.x.1.label(*v))
            .y_label_formatter(&|v| self.y.1.label(*v))
            .bold_line_style(RGBColor(225, 227, 230))
            .light_line_style(TRANSPARENT)
            .draw()
            .map_err(told)?;
        for level in levels {
            let line = LineSeries::new([(x.0, level), (x.1, level)], BLACK.mix(0.4));
            chart.draw_series(line).map_err(told)?;
        }
        for (k, (curve, points)) in self.curves.iter().zip(curves).enumerate() {
            let style = curve.style(k);
            chart
                .draw_series(LineSeries::new(points.iter().copied(), style))
                .map_err(told)?
                .label(curve.name.as_str())
                .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], style));
            if curve.mark == Mark::Computed {
                let dot = |&at: &(f64, f64)| Circle::new(at, 4, style.color.filled());
                chart.draw_series(points.iter().map(dot)).map_err(told)?;
            }
        }
        if self.curves.len() > 1 {
            chart
                .configure_series_labels()
                .position(match self.legend {
                    Corner::UpperRight => SeriesLabelPosition::UpperRight,
                    Corner::UpperLeft => SeriesLabelPosition::UpperLeft,
                    Corner::LowerLeft => SeriesLabelPosition::LowerLeft,
                })
                .background_style(WHITE.mix(0.85))
                .border_style(BLACK.mix(0.3))
                .label_font((FONT, 13))
                .draw()
                .map_err(told)?;
        }
        Ok(Drawn::Something)
    }
}

impl Curve {
    fn style(&self, k: usize) -> ShapeStyle {
        match self.mark {
            Mark::Computed => COLOURS[k % COLOURS.len()].stroke_width(2),
            Mark::Formula => RGBColor(130, 130, 130).stroke_width(1),
        }
    }
}

#[cfg(test)]
#[expect(clippy::unwrap_used, reason = "tests")]
mod tests {
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
            legend: Corner::UpperRight,
        }
    }

    #[test]
    fn a_figure_is_drawn_as_svg_and_as_png() {
        let figure = figure(&[(0.0, 1.0), (1.0, 0.02), (2.0, f64::NAN)]);
        let text = figure.svg().unwrap().unwrap();
        assert!(text.starts_with("<svg") && text.contains("Title") && text.contains("life"));
        // The two points that have a place.
        assert_eq!(text.matches("<circle").count(), 2);
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("figure.png");
        assert_eq!(figure.png(&path), Ok(Drawn::Something));
        let bytes = std::fs::read(&path).unwrap();
        // Signature, then width and height of the header.
        assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n");
        assert_eq!(&bytes[16..24], [0, 0, 3, 132, 0, 0, 2, 88]);
        assert!(figure.png(&folder.path().join("no/figure.png")).is_err());
    }

    #[test]
    fn nothing_is_drawn_of_nothing() {
        let mut empty = figure(&[(0.0, 0.0), (1.0, -1.0)]);
        empty.levels.clear();
        assert_eq!(empty.svg(), Ok(None));
    }
}
