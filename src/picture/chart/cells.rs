//! A map of coloured cells with its bar.

use plotters::coord::Shift;
use plotters::prelude::*;

use super::{BELOW, BESIDE, Chart, Drawn, FONT, SIZE, Scale, told};
use crate::Ramp;

/// Width of the bar with its numbers, pixels.
const BAR: u32 = 150;
/// A cell without a value.
const EMPTY: RGBColor = RGBColor(230, 230, 230);

/// A figure of cells: `rows[j][i]` at the i-th x, the j-th y.
#[derive(Debug, Clone)]
pub struct HeatMap {
    /// Above it.
    pub title: String,
    /// Label and values, rising.
    pub x: (String, Vec<f64>),
    /// Same upwards.
    pub y: (String, Vec<f64>),
    /// What the colours mean, and how.
    pub value: (String, Scale),
    /// Row by row from below.
    pub rows: Vec<Vec<f64>>,
}

impl Chart for HeatMap {
    fn draw<DB: DrawingBackend>(&self, area: &DrawingArea<DB, Shift>) -> Result<Drawn, String> {
        let values = self.rows.iter().flatten();
        let places = values.filter_map(|v| self.value.1.place(*v));
        let ends = places.fold(None, |ends: Option<(f64, f64)>, at| {
            let (low, high) = ends.unwrap_or((at, at));
            Some((low.min(at), high.max(at)))
        });
        let Some(ends) = ends else {
            return Ok(Drawn::Nothing);
        };
        let (main, side) = area.split_horizontally(SIZE.0 - BAR);
        self.draw_cells(&main, ends)?;
        self.draw_bar(&side, ends)?;
        Ok(Drawn::Something)
    }
}

impl HeatMap {
    fn draw_cells<DB: DrawingBackend>(
        &self,
        area: &DrawingArea<DB, Shift>,
        (low, high): (f64, f64),
    ) -> Result<(), String> {
        let (xs, ys) = (edges(&self.x.1), edges(&self.y.1));
        let ends = |edges: &[f64]| edges[0]..edges[edges.len() - 1];
        let mut chart = ChartBuilder::on(area)
            .caption(&self.title, (FONT, 20))
            .margin(12)
            .x_label_area_size(BELOW)
            .y_label_area_size(BESIDE)
            .build_cartesian_2d(ends(&xs), ends(&ys))
            .map_err(told)?;
        chart
            .configure_mesh()
            .disable_mesh()
            .x_desc(&self.x.0)
            .y_desc(&self.y.0)
            .axis_desc_style((FONT, 15))
            .label_style((FONT, 14))
            .x_label_formatter(&|v| Scale::Linear.label(*v))
            .y_label_formatter(&|v| Scale::Linear.label(*v))
            .draw()
            .map_err(told)?;
        let mut cells = Vec::new();
        for (row, y) in self.rows.iter().zip(ys.windows(2)) {
            for (value, x) in row.iter().zip(xs.windows(2)) {
                let colour = match self.value.1.place(*value) {
                    Some(place) => shade((place - low) / (high - low).max(1e-300)),
                    None => EMPTY,
                };
                let corners = [(x[0], y[0]), (x[1], y[1])];
                cells.push(Rectangle::new(corners, colour.filled()));
            }
        }
        chart.draw_series(cells).map_err(told)?;
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
            .caption(&self.value.0, (FONT, 14))
            .margin(12)
            .margin_top(24)
            .margin_bottom(BELOW + 12)
            .y_label_area_size(64)
            .build_cartesian_2d(0.0..1.0, low..high)
            .map_err(told)?;
        chart
            .configure_mesh()
            .disable_mesh()
            .disable_x_axis()
            .label_style((FONT, 13))
            .y_label_formatter(&|v| self.value.1.label(*v))
            .draw()
            .map_err(told)?;
        let at = |k: usize| low + (high - low) * k as f64 / STEPS as f64;
        let steps = (0..STEPS).map(|k| {
            let colour = shade((k as f64 + 0.5) / STEPS as f64);
            Rectangle::new([(0.0, at(k)), (1.0, at(k + 1))], colour.filled())
        });
        chart.draw_series(steps).map_err(told)?;
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
    let [r, g, b] = Ramp::Viridis.colour(share as f32, 1.0);
    RGBColor(r, g, b)
}

#[cfg(test)]
#[expect(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn cells_meet_half_way() {
        assert_eq!(edges(&[0.0, 1.0, 3.0]), [-0.5, 0.5, 2.0, 4.0]);
        assert_eq!(edges(&[2.0]), [1.0, 3.0]);
    }

    #[test]
    fn the_least_is_dark_the_greatest_light_and_what_is_missing_grey() {
        let map = HeatMap {
            title: "Map".to_owned(),
            x: ("S".to_owned(), vec![0.0, 1.0]),
            y: ("A, m".to_owned(), vec![1e-7]),
            value: ("relative life".to_owned(), Scale::Log),
            rows: vec![vec![0.1, f64::NAN]],
        };
        let text = map.svg().unwrap().unwrap();
        assert!(
            text.contains("#E6E6E6") && text.contains("#470155"),
            "{text:.2000}"
        );
        let none = HeatMap {
            rows: vec![vec![0.0, f64::NAN]],
            ..map
        };
        assert_eq!(none.svg(), Ok(None));
    }
}
