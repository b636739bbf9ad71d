//! Curves as bytes for the page.
//!
//! ```text
//! u32, little end first: n plots
//! each plot:             left, top, columns, rows of cells; n curves
//! each curve:            colour, whether its points are dots, n points
//! each point:            column, row from the plot's left upper corner, f32; NaN breaks the line
//! ```

use super::cells::colour;
use crate::tui::pixels::{PixelCurve, PixelPlot};

/// All plots.
pub(super) fn written(plots: &[PixelPlot]) -> Vec<u8> {
    let mut bytes = Vec::new();
    put(&mut bytes, [plots.len() as u32]);
    for plot in plots {
        let area = plot.area;
        put(
            &mut bytes,
            [area.x, area.y, area.width, area.height].map(u32::from),
        );
        put(&mut bytes, [plot.curves.len() as u32]);
        plot.curves
            .iter()
            .for_each(|curve| put_curve(&mut bytes, curve));
    }
    bytes
}

fn put_curve(bytes: &mut Vec<u8>, curve: &PixelCurve) {
    let is_dotted = u32::from(curve.is_dotted);
    put(
        bytes,
        [colour(curve.color), is_dotted, curve.points.len() as u32],
    );
    let places = curve.points.iter().flatten();
    bytes.extend(places.flat_map(|place| place.to_le_bytes()));
}

fn put<const N: usize>(bytes: &mut Vec<u8>, words: [u32; N]) {
    bytes.extend(words.into_iter().flat_map(u32::to_le_bytes));
}

#[cfg(test)]
mod tests {
    use super::*;
    use ratatui::layout::Rect;
    use ratatui::style::Color;

    #[test]
    fn plots_are_words_one_after_another() {
        let curve = |color, is_dotted, points: &[[f32; 2]]| PixelCurve {
            color,
            is_dotted,
            points: points.to_vec(),
        };
        let plots = [
            PixelPlot {
                area: Rect::new(1, 2, 3, 4),
                curves: vec![
                    curve(Color::Rgb(0, 1, 0), false, &[[0.5, -2.0], [f32::NAN; 2]]),
                    curve(Color::Reset, true, &[]),
                ],
            },
            PixelPlot {
                area: Rect::new(5, 6, 7, 8),
                curves: Vec::new(),
            },
        ];
        let nan = f32::NAN.to_bits();
        let first = [
            1,
            2,
            3,
            4,
            2,
            0x100,
            0,
            2,
            0.5_f32.to_bits(),
            0xc000_0000,
            nan,
            nan,
        ];
        let words: Vec<u32> = [2]
            .into_iter()
            .chain(first)
            .chain([u32::MAX, 1, 0, 5, 6, 7, 8, 0])
            .collect();
        let bytes: Vec<u8> = words.into_iter().flat_map(u32::to_le_bytes).collect();
        assert_eq!(written(&plots), bytes);
        assert_eq!(written(&[]), [0; 4]);
    }
}
