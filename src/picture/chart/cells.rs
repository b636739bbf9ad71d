//! A map of coloured cells with its bar.

use super::{Layout, Scale, axis, titled};
use crate::Ramp;
use crate::draw::{Axis, ColourBar, Drawing, PixelField, Rgb, Side};

/// A cell without a value.
const EMPTY: Rgb = [230; 3];

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

/// Logarithmic where rising values span a decade or more.
fn scale_of(values: &[f64]) -> Scale {
    match (values.first(), values.last()) {
        (Some(&first), Some(&last)) if first > 0.0 && last >= 10.0 * first => Scale::Log,
        _ => Scale::Linear,
    }
}

impl Layout for HeatMap {
    fn drawing(&self) -> Option<Drawing> {
        let scale = self.value.1;
        let places = self.rows.iter().flatten().filter_map(|v| scale.place(*v));
        let ends = places.fold(None, |ends: Option<[f64; 2]>, at| {
            let [low, high] = ends.unwrap_or([at, at]);
            Some([low.min(at), high.max(at)])
        });
        let [low, high] = ends?;
        let range = axis(scale, [low, high.max(low + 1e-9)], &self.value.0);
        let scales = [&self.x.1, &self.y.1].map(|values| scale_of(values));
        let placed = |values: &[f64], scale: Scale| {
            let places = values.iter().filter_map(|value| scale.place(*value));
            edges(&places.collect::<Vec<_>>())
        };
        let (xs, ys) = (placed(&self.x.1, scales[0]), placed(&self.y.1, scales[1]));
        let outer = |edges: &[f64]| [edges[0], edges[edges.len() - 1]];
        let x = axis(scales[0], outer(&xs), &self.x.0);
        let y = axis(scales[1], outer(&ys), &self.y.0);
        let (mut drawing, plot) = titled(&self.title, &y, 8.5);
        let [columns, rows] = [plot.wide, plot.high].map(|side| side as u32);
        // A pixel's cell: the last whose edge lies before its middle.
        let cells = |axis: &Axis, edges: &[f64], pixels: u32| -> Vec<usize> {
            let inner: Vec<f64> = edges[1..edges.len() - 1]
                .iter()
                .map(|at| axis.share(*at))
                .collect();
            let middles = (0..pixels).map(|k| (f64::from(k) + 0.5) / f64::from(pixels));
            middles
                .map(|middle| inner.partition_point(|edge| *edge <= middle))
                .collect()
        };
        let (across, up) = (cells(&x, &xs, columns), cells(&y, &ys, rows));
        let colour = |i: usize, j: usize| match scale.place(self.rows[j][i]) {
            Some(place) => shade(range.share(place)),
            None => EMPTY,
        };
        let pixels = up
            .iter()
            .rev()
            .flat_map(|j| across.iter().map(move |i| (*i, *j)));
        drawing.field(PixelField {
            area: plot,
            pixels: [columns, rows],
            rgb: pixels.flat_map(|(i, j)| colour(i, j)).collect(),
        });
        drawing.frame(plot);
        drawing.axis(plot, Side::Below, &x);
        drawing.axis(plot, Side::Left, &y);
        let labels = range.labels.iter();
        let labels = labels.map(|(at, label)| (range.share(*at), label.clone()));
        drawing.colour_bar(
            plot,
            ColourBar {
                title: range.title,
                colour: &shade,
                labels: labels.collect(),
                note: None,
            },
        );
        Some(drawing)
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
fn shade(share: f64) -> Rgb {
    Ramp::Viridis.colour(share as f32, 1.0)
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
    fn the_minimum_is_dark_and_what_is_missing_grey() {
        let map = HeatMap {
            title: "Map".to_owned(),
            x: ("S".to_owned(), vec![0.0, 1.0]),
            y: ("A, m".to_owned(), vec![1e-7]),
            value: ("relative life".to_owned(), Scale::Log),
            rows: vec![vec![0.1, f64::NAN]],
        };
        let pixels = map.drawing().unwrap().pixels().unwrap();
        let row = 3 * (300 * pixels.wide as usize);
        let colour = |x: usize| [0, 1, 2].map(|k| pixels.rgb[row + 3 * x + k]);
        assert_eq!([colour(200), colour(600)], [shade(0.0), EMPTY]);
        let none = HeatMap {
            rows: vec![vec![0.0, f64::NAN]],
            ..map
        };
        assert!(none.drawing().is_none());
    }
}
