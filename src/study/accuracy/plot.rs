//! Work-precision diagrams as SVG.

use plotters::prelude::*;
use plotters::style::register_font;

use super::{Accuracy, LEVELS, Part, Varied};

const SIZE: (u32, u32) = (900, 600);
/// Dark enough on white, told apart without colour by the marks' sizes and the labels.
const COLOURS: [RGBColor; 9] = [
    RGBColor(31, 119, 180),
    RGBColor(255, 127, 14),
    RGBColor(44, 160, 44),
    RGBColor(214, 39, 40),
    RGBColor(148, 103, 189),
    RGBColor(140, 86, 75),
    RGBColor(227, 119, 194),
    RGBColor(90, 90, 90),
    RGBColor(23, 190, 207),
];

/// A line of points with its name.
struct Curve {
    name: String,
    points: Vec<(f64, f64)>,
    colour: RGBColor,
}

/// Error against time over the nodes (cycles: the samples), one curve a part.
///
/// # Errors
/// What the drawing library says.
pub fn work_precision_plot(result: &Accuracy) -> Result<String, String> {
    let mut curves = Vec::new();
    for (k, part) in Part::ALL.into_iter().enumerate() {
        let first = result.rows.iter().find(|row| row.part == part);
        let Some(quantity) = first.map(|row| row.quantity) else {
            continue;
        };
        let points: Vec<(f64, f64)> = result
            .rows
            .iter()
            .filter(|row| (row.part, row.quantity) == (part, quantity) && row.error > 0.0)
            .filter(|row| {
                matches!(row.varied, Varied::Nodes | Varied::Samples) || part == Part::Deflection
            })
            .map(|row| (row.seconds, row.error))
            .collect();
        if points.len() > 1 {
            curves.push(Curve {
                name: format!("{}: {quantity}", part.name()),
                points,
                colour: COLOURS[k],
            });
        }
    }
    draw("Error against time, over the nodes", &curves, &[])
}

/// Error in life against time of whole runs; the levels of the recommendations as lines.
///
/// # Errors
/// What the drawing library says.
pub fn life_plot(result: &Accuracy) -> Result<String, String> {
    let all = result.lives.iter().filter(|run| run.error > 0.0);
    let mut sizes: Vec<usize> = all.clone().map(|run| run.setting.nodes).collect();
    sizes.sort_unstable();
    sizes.dedup();
    let curves: Vec<Curve> = sizes
        .iter()
        .enumerate()
        .map(|(k, &nodes)| {
            let of_size = all.clone().filter(|run| run.setting.nodes == nodes);
            let mut points: Vec<(f64, f64)> = of_size.map(|run| (run.seconds, run.error)).collect();
            points.sort_by(|one, two| one.0.total_cmp(&two.0));
            Curve {
                name: format!("{nodes}²"),
                points,
                colour: COLOURS[k],
            }
        })
        .collect();
    draw(
        "Error in life of the default scene against time",
        &curves,
        &LEVELS,
    )
}

/// Curves on logarithmic axes, with level lines.
fn draw(title: &str, curves: &[Curve], levels: &[f64]) -> Result<String, String> {
    // Registering again is harmless.
    register_font("sans-serif", FontStyle::Normal, dejavu::sans::regular())
        .map_err(|_| "the font of the pictures cannot be read".to_owned())?;
    let points = || curves.iter().flat_map(|curve| &curve.points);
    let (x, y) = (
        decades(points().map(|p| p.0)),
        decades(points().map(|p| p.1).chain(levels.iter().copied())),
    );
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        let told = |error: &dyn std::fmt::Display| error.to_string();
        area.fill(&WHITE).map_err(|error| told(&error))?;
        let mut chart = ChartBuilder::on(&area)
            .caption(title, ("sans-serif", 20))
            .margin(12)
            .x_label_area_size(44)
            .y_label_area_size(64)
            .build_cartesian_2d((x.0..x.1).log_scale(), (y.0..y.1).log_scale())
            .map_err(|error| told(&error))?;
        chart
            .configure_mesh()
            .x_desc("time, s")
            .y_desc("relative error")
            .label_style(("sans-serif", 14))
            .x_label_formatter(&|v| format!("{v:.0e}"))
            .y_label_formatter(&|v| format!("{v:.0e}"))
            .light_line_style(WHITE)
            .draw()
            .map_err(|error| told(&error))?;
        for &level in levels {
            let line = LineSeries::new([(x.0, level), (x.1, level)], BLACK.mix(0.4));
            chart.draw_series(line).map_err(|error| told(&error))?;
        }
        for curve in curves {
            let style = curve.colour.stroke_width(2);
            chart
                .draw_series(LineSeries::new(curve.points.iter().copied(), style))
                .map_err(|error| told(&error))?
                .label(curve.name.as_str())
                .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], style));
            let dots = curve
                .points
                .iter()
                .map(|&p| Circle::new(p, 4, curve.colour.filled()));
            chart.draw_series(dots).map_err(|error| told(&error))?;
        }
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::LowerLeft)
            .background_style(WHITE.mix(0.85))
            .border_style(BLACK.mix(0.3))
            .label_font(("sans-serif", 13))
            .draw()
            .map_err(|error| told(&error))?;
        area.present().map_err(|error| told(&error))?;
    }
    Ok(text)
}

/// Whole decades around the values.
fn decades(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = values
        .filter(|value| *value > 0.0 && value.is_finite())
        .fold((f64::INFINITY, 0.0_f64), |(low, high), v| {
            (low.min(v), high.max(v))
        });
    if high == 0.0 {
        return (0.1, 10.0);
    }
    let (low, high) = (low.log10().floor(), high.log10().ceil());
    (
        10f64.powf(low),
        10f64.powf(if high > low { high } else { low + 1.0 }),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plot_is_drawn_with_its_names() {
        let curves = [Curve {
            name: "some part".to_owned(),
            points: vec![(0.1, 1e-2), (1.0, 2e-3)],
            colour: BLACK,
        }];
        let text = draw("Title", &curves, &[1e-2]).expect("drawn");
        assert!(text.starts_with("<svg") && text.contains("some part") && text.contains("Title"));
        assert_eq!(decades([0.02, 3.0].into_iter()), (0.01, 10.0));
    }
}
