//! Which pictures a sweep has: those whose axes it varies.
//!
//! | picture | drawn when |
//! |---|---|
//! | life, friction, least film, greatest pressure against the last axis (a path: the way) | it is made of numbers |
//! | film against speed with the regression line | the entrainment speed varies |
//! | Stribeck: friction against λ; lives by both counts against λ | speed, viscosity, load or roughness varies |
//! | life map | two axes of numbers make a grid |
//!
//! Each is written as SVG and as PNG. Several axes make one curve for each combination of the others, at most eight.

use super::axis::VariedKey;
use super::error::SweepError;
use super::folder::Folder;
use super::reader::shown;
use super::spec::{Combine, Sweep};
use super::table::Rows;
use asperity_engine::scene::Knob;
use asperity_picture::chart::{Chart, Corner, Curve, Figure, HeatMap, Mark, Scale};

/// Most curves of one picture.
const MOST_CURVES: usize = 8;

/// Draws what there is to draw into the folder, and names the files.
///
/// # Errors
/// [`SweepError::Folder`] when the disk or the drawing library says no.
pub fn draw(sweep: &Sweep, rows: &Rows, folder: &Folder) -> Result<Vec<String>, SweepError> {
    let mut names = Vec::new();
    for (name, figure) in figures(sweep, rows) {
        keep(folder, &name, &figure, &mut names)?;
    }
    if let Some(map) = life_map(sweep, rows) {
        keep(folder, "life_map", &map, &mut names)?;
    }
    Ok(names)
}

/// Writes a chart as SVG and as PNG, if there is something in it.
fn keep(
    folder: &Folder,
    name: &str,
    chart: &impl Chart,
    names: &mut Vec<String>,
) -> Result<(), SweepError> {
    let path = folder.root().join(format!("{name}.svg"));
    let svg = chart.svg();
    let Some(text) = svg.map_err(|reason| SweepError::folder(&path, reason))? else {
        return Ok(());
    };
    folder.write(&path, text.as_bytes())?;
    folder.write_by(&path.with_extension("png"), |path| chart.png(path))?;
    names.push(format!("{} and .png", path.display()));
    Ok(())
}

/// The axis along which curves run: column, label, scale.
struct CurveAxis {
    column: String,
    label: String,
    scale: Scale,
    short: String,
}

fn along(sweep: &Sweep) -> Option<CurveAxis> {
    if let Some(column) = super::path::columns(&sweep.path).next() {
        let label = match column {
            "path_m" => "distance along the line of action from A, m",
            _ => "angle, degrees",
        };
        return Some(CurveAxis {
            column: column.to_owned(),
            label: label.to_owned(),
            scale: Scale::Linear,
            short: "path".to_owned(),
        });
    }
    let axis = sweep.axes.last()?;
    let numbers = axis.numbers().filter(|list| list.len() > 1)?;
    Some(CurveAxis {
        column: axis.key.clone(),
        label: axis.label(),
        scale: scale_of(&numbers),
        short: axis.key.rsplit('.').next().unwrap_or("key").to_owned(),
    })
}

/// Logarithmic where the values span more than a decade and are above 0.
fn scale_of(values: &[f64]) -> Scale {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(0.0, f64::max);
    if low > 0.0 && high > 10.0 * low {
        Scale::Log
    } else {
        Scale::Linear
    }
}

/// What the upright axis shows.
type Upright<'a> = (&'a str, Scale);
/// A curve's name, its column, what it is made of.
type PlottedCurve<'a> = (&'a str, &'a str, Mark);

/// Pictures along the last axis, the first four of any sweep, all of a path: name, upright axis, curves.
#[rustfmt::skip]
const PICTURES: [(&str, Upright, &[PlottedCurve]); 7] = {
    use Mark::{Computed, Formula};
    use Scale::{Linear, Log};
    [
        ("life", ("relative life", Log), &[("", "life_relative", Computed)]),
        ("traction", ("friction coefficient", Linear), &[("", "friction_coefficient", Computed)]),
        ("pressure", ("pressure, Pa", Linear), &[("greatest", "p_max_greatest_pa", Computed), ("mean of the steps' greatest", "p_max_pa", Computed), ("Hertz", "p_hertz_pa", Formula)]),
        ("film", ("film, m", Log), &[("centre", "h_central_m", Computed), ("mean of the steps' least", "h_min_m", Computed), ("smooth, by regression", "h_regression_m", Formula)]),
        ("mechanisms", ("factor of life", Log), &[("cycles", "cycle_factor", Computed), ("peaks", "peak_factor", Computed), ("traction", "traction_factor", Computed)]),
        ("contacts", ("contacts a loading cycle n", Log), &[("body 1", "n_body_1", Computed), ("body 2", "n_body_2", Computed)]),
        ("lambda", ("lambda", Linear), &[("", "lambda_ratio", Computed)]),
    ]
};

fn figures(sweep: &Sweep, rows: &Rows) -> Vec<(String, Figure)> {
    let mut found = Vec::new();
    let Some(along) = along(sweep) else {
        return found;
    };
    let lines = lines(sweep);
    let more = if sweep.path.is_empty() {
        4
    } else {
        PICTURES.len()
    };
    for (name, y, columns) in &PICTURES[..more] {
        let figure = figure(sweep, rows, &along, &lines, (*y, columns));
        if !figure.curves.is_empty() {
            found.push((format!("{name}_against_{}", along.short), figure));
        }
    }
    found.extend(against_lambda(sweep, rows, &lines));
    found
}

/// Cases of each curve, and what sets it apart.
fn lines(sweep: &Sweep) -> Vec<(String, Vec<usize>)> {
    let all: Vec<usize> = (0..sweep.len()).collect();
    let width = match (sweep.combine, sweep.axes.last()) {
        (Combine::Grid, Some(axis)) => axis.values.len(),
        _ => all.len(),
    };
    let others = &sweep.axes[..sweep.axes.len().saturating_sub(1)];
    all.chunks(width.max(1))
        .take(MOST_CURVES)
        .map(|cases| {
            let place = sweep.place(cases[0]);
            let words: Vec<_> = match sweep.combine {
                Combine::List => Vec::new(),
                Combine::Grid => others
                    .iter()
                    .zip(place)
                    .map(|(axis, k)| format!("{} = {}", axis.key, shown(&axis.values[k])))
                    .collect(),
            };
            (words.join(", "), cases.to_vec())
        })
        .collect()
}

fn figure(
    sweep: &Sweep,
    rows: &Rows,
    along: &CurveAxis,
    lines: &[(String, Vec<usize>)],
    ((label, scale), columns): (Upright, &[PlottedCurve]),
) -> Figure {
    let mut curves = Vec::new();
    let xs = rows.column(sweep, &along.column).unwrap_or_default();
    for (what, column, mark) in columns {
        let Some(ys) = rows.column(sweep, column) else {
            continue;
        };
        if !ys.iter().any(|y| y.is_finite()) {
            continue;
        }
        for (line, cases) in lines {
            let name = [*what, line.as_str()];
            let name: Vec<_> = name.into_iter().filter(|part| !part.is_empty()).collect();
            curves.push(Curve {
                name: name.join(", "),
                points: cases.iter().map(|&k| (xs[k], ys[k])).collect(),
                mark: *mark,
            });
        }
    }
    Figure {
        title: title(sweep),
        x: (along.label.clone(), along.scale),
        y: (label.to_owned(), scale),
        curves,
        levels: Vec::new(),
        legend: Corner::UpperRight,
    }
}

fn title(sweep: &Sweep) -> String {
    if sweep.title.is_empty() {
        sweep.name.clone()
    } else {
        sweep.title.clone()
    }
}

/// Friction and lives against λ, where something varies that moves λ.
fn against_lambda(
    sweep: &Sweep,
    rows: &Rows,
    lines: &[(String, Vec<usize>)],
) -> Vec<(String, Figure)> {
    // Every knob but the sliding, and the oil.
    let moves = |axis: &VariedKey| match Knob::from_key(&axis.key) {
        Some(knob) => knob != Knob::SlideRoll,
        None => axis.key == "lubricant.viscosity_pa_s",
    };
    if !sweep.axes.iter().any(moves) || !sweep.path.is_empty() {
        return Vec::new();
    }
    let xs = rows.column(sweep, "lambda_ratio").unwrap_or_default();
    let lambda = CurveAxis {
        column: "lambda_ratio".to_owned(),
        label: "lambda: smooth film by formula over composite roughness".to_owned(),
        scale: scale_of(&xs),
        short: String::new(),
    };
    let friction: PlottedCurve = ("", "friction_coefficient", Mark::Computed);
    let lives: [PlottedCurve; 2] = [
        ("by damage", "life_damage", Mark::Computed),
        ("the paper's count", "life_global", Mark::Computed),
    ];
    let draw = |name: &str, y: Upright, columns: &[PlottedCurve]| {
        let mut figure = figure(sweep, rows, &lambda, lines, (y, columns));
        for curve in &mut figure.curves {
            curve.points.retain(|(x, y)| x.is_finite() && y.is_finite());
            curve.points.sort_by(|one, two| one.0.total_cmp(&two.0));
        }
        figure.curves.retain(|curve| curve.points.len() > 1);
        // Friction falls and life rises with the film.
        if name != "stribeck" {
            figure.legend = Corner::UpperLeft;
        }
        let is_drawn = !figure.curves.is_empty();
        is_drawn.then(|| (name.to_owned(), figure))
    };
    let stribeck = draw(
        "stribeck",
        ("friction coefficient", Scale::Linear),
        &[friction],
    );
    let lives = draw("life_against_lambda", ("relative life", Scale::Log), &lives);
    stribeck.into_iter().chain(lives).collect()
}

/// Life over the last two axes of a grid; of more axes, at the first values of the others.
fn life_map(sweep: &Sweep, rows: &Rows) -> Option<HeatMap> {
    let [.., y, x] = sweep.axes.as_slice() else {
        return None;
    };
    let (xs, ys) = (x.numbers()?, y.numbers()?);
    if sweep.combine != Combine::Grid || xs.len() < 2 || ys.len() < 2 {
        return None;
    }
    let lives = rows.column(sweep, "life_relative")?;
    let rising = |list: &[f64]| list.windows(2).all(|pair| pair[1] > pair[0]);
    if !rising(&xs) || !rising(&ys) {
        return None;
    }
    Some(HeatMap {
        title: title(sweep),
        rows: lives
            .chunks(xs.len())
            .take(ys.len())
            .map(<[f64]>::to_vec)
            .collect(),
        x: (x.label(), xs),
        y: (y.label(), ys),
        value: ("relative life".to_owned(), Scale::Log),
    })
}
