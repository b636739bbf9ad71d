//! Drawing: curves on linear or logarithmic axes, and a map of coloured cells, as SVG.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::register_font;

const SIZE: (u32, u32) = (900, 600);
const COLOURS: [RGBColor; 8] = [
    RGBColor(31, 119, 180),
    RGBColor(214, 39, 40),
    RGBColor(44, 160, 44),
    RGBColor(255, 127, 14),
    RGBColor(148, 103, 189),
    RGBColor(140, 86, 75),
    RGBColor(90, 90, 90),
    RGBColor(23, 190, 207),
];
/// From dark to light, evenly lighter: read without colour, too.
const SHADES: [(f64, f64, f64); 6] = [
    (68.0, 1.0, 84.0),
    (65.0, 68.0, 135.0),
    (42.0, 120.0, 142.0),
    (34.0, 168.0, 132.0),
    (122.0, 209.0, 81.0),
    (253.0, 231.0, 37.0),
];

/// How numbers lie along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Scale {
    Linear,
    Log,
}

impl Scale {
    /// Place of a value; `None` where a logarithm has none.
    fn place(self, value: f64) -> Option<f64> {
        match self {
            Self::Linear => value.is_finite().then_some(value),
            Self::Log => (value > 0.0 && value.is_finite()).then(|| value.log10()),
        }
    }

    fn label(self, place: f64) -> String {
        let value = match self {
            Self::Linear => place,
            Self::Log => 10_f64.powf(place),
        };
        let size = value.abs();
        if value.abs() < 1e-12 {
            "0".to_owned()
        } else if (0.01..1e4).contains(&size) {
            let digits = (2 - size.log10().floor() as i32).clamp(0, 4) as usize;
            let text = format!("{value:.digits$}");
            if text.contains('.') {
                text.trim_end_matches('0').trim_end_matches('.').to_owned()
            } else {
                text
            }
        } else {
            format!("{value:.1e}")
        }
    }
}

/// What a curve is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mark {
    /// Line and dots: what was computed.
    Computed,
    /// A grey line: a formula.
    Formula,
}

/// A curve.
#[derive(Debug, Clone)]
pub(super) struct Curve {
    pub(super) name: String,
    pub(super) points: Vec<(f64, f64)>,
    pub(super) mark: Mark,
}

/// A figure of curves.
#[derive(Debug, Clone)]
pub(super) struct Figure {
    pub(super) title: String,
    pub(super) x: (String, Scale),
    pub(super) y: (String, Scale),
    pub(super) curves: Vec<Curve>,
}

/// A figure of cells: `cells[j][i]` at `xs[i]`, `ys[j]`.
#[derive(Debug, Clone)]
pub(super) struct Map {
    pub(super) title: String,
    pub(super) x: (String, Vec<f64>),
    pub(super) y: (String, Vec<f64>),
    pub(super) value: (String, Scale),
    pub(super) cells: Vec<Vec<f64>>,
}

fn told(error: &dyn std::fmt::Display) -> String {
    error.to_string()
}

fn font() -> Result<(), String> {
    // Registering again is harmless.
    register_font("sans-serif", FontStyle::Normal, dejavu::sans::regular())
        .map_err(|_| "the font of the pictures cannot be read".to_owned())
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

impl Figure {
    /// The figure as SVG; `None`: there is nothing to draw.
    ///
    /// # Errors
    /// What the drawing library says.
    pub(super) fn svg(&self) -> Result<Option<String>, String> {
        font()?;
        let mut text = String::new();
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        let drawn = self.draw(&area)?;
        area.present().map_err(|error| told(&error))?;
        drop(area);
        Ok(drawn.then_some(text))
    }

    fn draw<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>) -> Result<bool, String> {
        let place = |&(x, y): &(f64, f64)| Some((self.x.1.place(x)?, self.y.1.place(y)?));
        let curves: Vec<Vec<(f64, f64)>> = self
            .curves
            .iter()
            .map(|curve| curve.points.iter().filter_map(place).collect())
            .collect();
        let all = || curves.iter().flatten();
        let (Some(x), Some(y)) = (span(all().map(|p| p.0)), span(all().map(|p| p.1))) else {
            return Ok(false);
        };
        area.fill(&WHITE).map_err(|error| told(&error))?;
        let mut chart = ChartBuilder::on(area)
            .caption(&self.title, ("sans-serif", 20))
            .margin(12)
            .x_label_area_size(48)
            .y_label_area_size(76)
            .build_cartesian_2d(x.0..x.1, y.0..y.1)
            .map_err(|error| told(&error))?;
        chart
            .configure_mesh()
            .x_desc(&self.x.0)
            .y_desc(&self.y.0)
            .label_style(("sans-serif", 14))
            .x_label_formatter(&|v| self.x.1.label(*v))
            .y_label_formatter(&|v| self.y.1.label(*v))
            .light_line_style(WHITE)
            .draw()
            .map_err(|error| told(&error))?;
        for (k, (curve, points)) in self.curves.iter().zip(curves).enumerate() {
            let style = match curve.mark {
                Mark::Computed => COLOURS[k % COLOURS.len()].stroke_width(2),
                Mark::Formula => RGBColor(130, 130, 130).stroke_width(1),
            };
            chart
                .draw_series(LineSeries::new(points.iter().copied(), style))
                .map_err(|error| told(&error))?
                .label(curve.name.as_str())
                .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], style));
            if curve.mark == Mark::Computed {
                let dots = points
                    .iter()
                    .map(|&p| Circle::new(p, 4, style.color.filled()));
                chart.draw_series(dots).map_err(|error| told(&error))?;
            }
        }
        if self.curves.len() > 1 {
            chart
                .configure_series_labels()
                .position(SeriesLabelPosition::UpperRight)
                .background_style(WHITE.mix(0.85))
                .border_style(BLACK.mix(0.3))
                .label_font(("sans-serif", 13))
                .draw()
                .map_err(|error| told(&error))?;
        }
        Ok(true)
    }
}

impl Map {
    /// The map as SVG; `None`: there is nothing to draw.
    ///
    /// # Errors
    /// What the drawing library says.
    pub(super) fn svg(&self) -> Result<Option<String>, String> {
        font()?;
        let places = || {
            self.cells
                .iter()
                .flatten()
                .filter_map(|v| self.value.1.place(*v))
        };
        let (low, high) = (
            places().fold(f64::INFINITY, f64::min),
            places().fold(f64::NEG_INFINITY, f64::max),
        );
        if low > high {
            return Ok(None);
        }
        let mut text = String::new();
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        area.fill(&WHITE).map_err(|error| told(&error))?;
        let (main, side) = area.split_horizontally(SIZE.0 - 150);
        self.draw_cells(&main, (low, high))?;
        self.draw_bar(&side, (low, high))?;
        area.present().map_err(|error| told(&error))?;
        drop((main, side));
        drop(area);
        Ok(Some(text))
    }

    fn draw_cells<DB: DrawingBackend>(
        &self,
        area: &DrawingArea<DB, Shift>,
        (low, high): (f64, f64),
    ) -> Result<(), String> {
        let (xs, ys) = (edges(&self.x.1), edges(&self.y.1));
        let ends = |edges: &[f64]| edges[0]..edges[edges.len() - 1];
        let mut chart = ChartBuilder::on(area)
            .caption(&self.title, ("sans-serif", 20))
            .margin(12)
            .x_label_area_size(48)
            .y_label_area_size(76)
            .build_cartesian_2d(ends(&xs), ends(&ys))
            .map_err(|error| told(&error))?;
        chart
            .configure_mesh()
            .disable_mesh()
            .x_desc(&self.x.0)
            .y_desc(&self.y.0)
            .label_style(("sans-serif", 14))
            .x_label_formatter(&|v| Scale::Linear.label(*v))
            .y_label_formatter(&|v| Scale::Linear.label(*v))
            .draw()
            .map_err(|error| told(&error))?;
        let mut cells = Vec::new();
        for (row, y) in self.cells.iter().zip(ys.windows(2)) {
            for (value, x) in row.iter().zip(xs.windows(2)) {
                let colour = match self.value.1.place(*value) {
                    Some(place) => shade((place - low) / (high - low).max(1e-300)),
                    None => RGBColor(230, 230, 230),
                };
                cells.push(Rectangle::new(
                    [(x[0], y[0]), (x[1], y[1])],
                    colour.filled(),
                ));
            }
        }
        chart.draw_series(cells).map_err(|error| told(&error))?;
        Ok(())
    }

    fn draw_bar<DB: DrawingBackend>(
        &self,
        area: &DrawingArea<DB, Shift>,
        (low, high): (f64, f64),
    ) -> Result<(), String> {
        const STEPS: usize = 64;
        let high = if high > low { high } else { low + 1e-9 };
        let mut chart = ChartBuilder::on(area)
            .caption(&self.value.0, ("sans-serif", 14))
            .margin(12)
            .margin_top(24)
            .margin_bottom(60)
            .y_label_area_size(64)
            .build_cartesian_2d(0.0..1.0, low..high)
            .map_err(|error| told(&error))?;
        chart
            .configure_mesh()
            .disable_mesh()
            .disable_x_axis()
            .label_style(("sans-serif", 13))
            .y_label_formatter(&|v| self.value.1.label(*v))
            .draw()
            .map_err(|error| told(&error))?;
        let at = |k: usize| low + (high - low) * k as f64 / STEPS as f64;
        let steps = (0..STEPS).map(|k| {
            let colour = shade((k as f64 + 0.5) / STEPS as f64);
            Rectangle::new([(0.0, at(k)), (1.0, at(k + 1))], colour.filled())
        });
        chart.draw_series(steps).map_err(|error| told(&error))?;
        Ok(())
    }
}

/// Edges of cells around the values, half-way between neighbours.
fn edges(values: &[f64]) -> Vec<f64> {
    let n = values.len();
    if n == 1 {
        let room = 0.5 * values[0].abs().max(1e-9);
        return vec![values[0] - room, values[0] + room];
    }
    let mut edges = vec![1.5 * values[0] - 0.5 * values[1]];
    edges.extend(values.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])));
    edges.push(1.5 * values[n - 1] - 0.5 * values[n - 2]);
    edges
}

/// Colour of a share, 0 to 1.
fn shade(share: f64) -> RGBColor {
    let at = share.clamp(0.0, 1.0) * (SHADES.len() - 1) as f64;
    let k = (at as usize).min(SHADES.len() - 2);
    let (t, one, two) = (at - k as f64, SHADES[k], SHADES[k + 1]);
    let mix = |a: f64, b: f64| (a + (b - a) * t).round() as u8;
    RGBColor(mix(one.0, two.0), mix(one.1, two.1), mix(one.2, two.2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_are_short_and_shades_grow_lighter() {
        let label = |v: f64| Scale::Linear.label(v);
        assert_eq!(label(0.3), "0.3");
        assert_eq!(label(1500.0), "1500");
        assert_eq!(label(2.5e-7), "2.5e-7");
        assert_eq!(Scale::Log.label(-1.0), "0.1");
        let light = |share: f64| {
            let RGBColor(r, g, b) = shade(share);
            0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b)
        };
        for k in 0..10 {
            assert!(light(f64::from(k + 1) / 10.0) > light(f64::from(k) / 10.0));
        }
    }

    #[test]
    fn cells_meet_half_way() {
        assert_eq!(edges(&[0.0, 1.0, 3.0]), [-0.5, 0.5, 2.0, 4.0]);
        assert_eq!(edges(&[2.0]), [1.0, 3.0]);
    }
}
