//! Work-precision diagrams.

use super::{Accuracy, LEVELS, LifeRun, StudiedPart, Varied};
use asperity_picture::chart::{Chart as _, Corner, Curve, Figure, Mark, Scale};

/// Error against time over the nodes (cycles: the samples), one curve a part.
///
/// # Errors
/// What the drawing library says.
pub fn work_precision_plot(result: &Accuracy) -> Result<String, String> {
    let mut curves = Vec::new();
    for part in StudiedPart::ALL {
        let first = result.rows.iter().find(|row| row.part == part);
        let Some(quantity) = first.map(|row| row.quantity) else {
            continue;
        };
        let points: Vec<(f64, f64)> = result
            .rows
            .iter()
            .filter(|row| (row.part, row.quantity) == (part, quantity) && row.error > 0.0)
            .filter(|row| {
                matches!(row.varied, Varied::Nodes | Varied::Samples)
                    || part == StudiedPart::Deflection
            })
            .map(|row| (row.seconds, row.error))
            .collect();
        if points.len() > 1 {
            curves.push(Curve {
                name: format!("{}: {quantity}", part.name()),
                points,
                mark: Mark::Computed,
            });
        }
    }
    draw("Error against time, over the nodes", curves, &[])
}

/// Error in life against time of whole runs; the levels of the recommendations as lines.
///
/// # Errors
/// What the drawing library says.
pub fn life_plot(result: &Accuracy) -> Result<String, String> {
    let all = result.lives.iter().filter(|run| run.error > 0.0);
    let kind = |run: &LifeRun| (run.value.name(), run.setting.nodes);
    let mut kinds: Vec<_> = all.clone().map(kind).collect();
    kinds.sort_unstable();
    kinds.dedup();
    let curves: Vec<Curve> = kinds
        .iter()
        .map(|&(value, nodes)| {
            let of_size = all.clone().filter(|run| kind(run) == (value, nodes));
            let mut points: Vec<(f64, f64)> = of_size.map(|run| (run.seconds, run.error)).collect();
            points.sort_by(|one, two| one.0.total_cmp(&two.0));
            Curve {
                name: format!("{nodes}², {value}"),
                points,
                mark: Mark::Computed,
            }
        })
        .collect();
    draw(
        "Error in life of the default scene against time",
        curves,
        &LEVELS,
    )
}

/// Curves on logarithmic axes, with level lines.
fn draw(title: &str, curves: Vec<Curve>, levels: &[f64]) -> Result<String, String> {
    let figure = Figure {
        title: title.to_owned(),
        x: ("time, s".to_owned(), Scale::Log),
        y: ("relative error".to_owned(), Scale::Log),
        curves,
        levels: levels.to_vec(),
        legend: Corner::LowerLeft,
    };
    Ok(figure.svg()?.unwrap_or_default())
}
