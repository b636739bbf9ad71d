//! Pictures of a surface: its heights as a map, and its spectrum along x.

use std::path::Path;

use asperity_engine::math::spectrum::mean_power;
use asperity_engine::observe::ObserveError;
use asperity_picture::chart::{Chart, Curve, Figure, HeatMap, Mark, Scale};

/// Most cells of a map along a side: what a picture of 900 pixels shows.
const MOST_CELLS: usize = 300;

/// Draws both into `folder`, their names begun by `prefix`; a file that is there is not written over.
pub(super) fn draw(
    folder: &Path,
    prefix: &str,
    (nx, heights_m, pixel_m): &(usize, Vec<f64>, [f64; 2]),
) -> Result<Vec<String>, ObserveError> {
    std::fs::create_dir_all(folder)
        .map_err(|error| ObserveError::new(folder.display().to_string(), error.to_string()))?;
    let map = map(*nx, heights_m, *pixel_m);
    let spectrum = spectrum(*nx, heights_m, pixel_m[0]);
    let mut names = Vec::new();
    for (name, chart) in [("map", &map as &dyn Chart), ("spectrum", &spectrum)] {
        let path = folder.join(format!("{prefix}{name}.png"));
        let failed = |reason: String| ObserveError::new(path.display().to_string(), reason);
        if path.exists() {
            return Err(failed("a file of that name is there already".to_owned()));
        }
        if chart.png(&path).map_err(failed)? {
            names.push(path.display().to_string());
        }
    }
    Ok(names)
}

/// Every so many pixels, so that the cells can be seen.
fn map(nx: usize, heights_m: &[f64], [x_m, y_m]: [f64; 2]) -> HeatMap {
    let ny = heights_m.len() / nx.max(1);
    let every = nx.max(ny).div_ceil(MOST_CELLS).max(1);
    let places = |n: usize, side_m: f64| -> Vec<f64> {
        // What does not vary that way has pixels without end.
        let side_m = if side_m.is_finite() {
            side_m
        } else {
            x_m.min(y_m)
        };
        (0..n).step_by(every).map(|k| k as f64 * side_m).collect()
    };
    let row = |j: usize| {
        (0..nx)
            .step_by(every)
            .map(|i| heights_m[j * nx + i])
            .collect()
    };
    HeatMap {
        title: "Heights".to_owned(),
        x: ("x, m".to_owned(), places(nx, x_m)),
        y: ("y, m".to_owned(), places(ny, y_m)),
        value: ("height, m".to_owned(), Scale::Linear),
        rows: (0..ny).step_by(every).map(row).collect(),
    }
}

/// One-sided power density of the rows, C(q) = 2 ⟨|F_k|²⟩ L/n², so that Σ C/L is the mean square.
fn spectrum(nx: usize, heights_m: &[f64], pixel_m: f64) -> Figure {
    let rows = heights_m.len() / nx.max(1);
    let power = mean_power(nx, rows, |j| {
        heights_m[j * nx..(j + 1) * nx].iter().copied()
    });
    let length_m = nx as f64 * pixel_m;
    let n = nx as f64;
    let greatest = power.iter().skip(1).copied().fold(0.0, f64::max);
    // Below that it is rounding.
    let points = power
        .iter()
        .enumerate()
        .skip(1)
        .filter(|(_, p)| **p > 1e-9 * greatest);
    Figure {
        title: "Spectrum of the rows".to_owned(),
        x: ("wave along x, m".to_owned(), Scale::Log),
        y: ("power density, m³".to_owned(), Scale::Log),
        curves: vec![Curve {
            name: String::new(),
            points: points
                .map(|(k, p)| (length_m / k as f64, p * length_m / (n * n)))
                .collect(),
            mark: Mark::Computed,
        }],
        levels: Vec::new(),
    }
}
