//! Which pictures a sweep has: those whose axes it varies.
//!
//! | picture | drawn when |
//! |---|---|
//! | life, friction, minimum film, maximum pressure against the last axis (a path: the way) | it is made of numbers |
//! | part of the surface with pits, depth worn | surfaces age, or wear |
//! | film against speed with the regression line | the entrainment speed varies |
//! | Stribeck: friction against λ; lives by both counts against λ | speed, viscosity, load or roughness varies |
//! | mean life over the seeds, and of pits, with its ends | seeds vary, and one key of numbers |
//! | maps of life, of pits and of wear | two axes of numbers make a grid, no seeds among them |
//!
//! Each is written as SVG and as PNG. Several axes make one curve for each combination of the others, at most eight.

use super::axis::VariedKey;
use super::error::SweepError;
use super::folder::Folder;
use super::over_seeds::Scatter;
use super::reader::shown;
use super::spec::{Combine, Sweep};
use super::table::Rows;
use asperity_engine::scene::Knob;
use asperity_picture::chart::{Chart, Curve, Figure, HeatMap, Mark, Scale};

/// Most curves of one picture.
const MOST_CURVES: usize = 8;

/// Draws what there is to draw into the folder, and names the files.
///
/// # Errors
/// [`SweepError::Folder`] when the disk or the drawing library says no.
pub fn draw(sweep: &Sweep, rows: &Rows, folder: &Folder) -> Result<Vec<String>, SweepError> {
    let mut names = Vec::new();
    for (name, chart) in charts(sweep, rows) {
        let path = folder.root().join(format!("{name}.svg"));
        let svg = chart.svg();
        let Some(text) = svg.map_err(|reason| SweepError::folder(&path, reason))? else {
            continue;
        };
        folder.write(&path, text.as_bytes())?;
        folder.write_by(&path.with_extension("png"), |path| chart.png(path))?;
        names.push(format!("{} and .png", path.display()));
    }
    Ok(names)
}

/// The same pictures as SVG, each with its name.
///
/// # Errors
/// [`SweepError::Folder`] when the drawing library says no.
pub fn pictures(sweep: &Sweep, rows: &Rows) -> Result<Vec<(String, String)>, SweepError> {
    let svg = |(name, chart): (String, Box<dyn Chart>)| {
        let svg = chart
            .svg()
            .map_err(|reason| SweepError::folder(name.as_ref(), reason));
        Some(svg.transpose()?.map(|svg| (name, svg)))
    };
    charts(sweep, rows).into_iter().filter_map(svg).collect()
}

fn charts(sweep: &Sweep, rows: &Rows) -> Vec<(String, Box<dyn Chart>)> {
    let boxed = |(name, figure)| (name, Box::new(figure) as Box<dyn Chart>);
    let mut all: Vec<_> = figures(sweep, rows).into_iter().map(boxed).collect();
    for map in MAPS {
        if let Some(drawn) = heat_map(sweep, rows, &map) {
            all.push((map.name.to_owned(), Box::new(drawn)));
        }
    }
    all
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

/// A curve of a picture.
struct PlottedCurve {
    name: &'static str,
    column: &'static str,
    mark: Mark,
}

const fn computed(name: &'static str, column: &'static str) -> PlottedCurve {
    let mark = Mark::Computed;
    PlottedCurve { name, column, mark }
}

const fn formula(name: &'static str, column: &'static str) -> PlottedCurve {
    let mark = Mark::Formula;
    PlottedCurve { name, column, mark }
}

/// A picture of some columns.
struct Plot {
    name: &'static str,
    /// Of the upright axis.
    label: &'static str,
    scale: Scale,
    curves: &'static [PlottedCurve],
}

/// What lives are relative to where no load varies, nor anything else that the smooth contact depends on.
const OWN_LIFE: &str = "relative life";
/// And where something does: their own smooth contacts are other ones, so lives are brought to that of the base scene.
const COMMON_LIFE: &str = "life over that of the base scene's smooth contact";

/// A column as pictures show it, and whether lives in it were brought to the smooth contact of the base scene.
fn drawn(sweep: &Sweep, rows: &Rows, column: &str) -> (Vec<f64>, bool) {
    let mut values = rows.column(sweep, column).unwrap_or_default();
    let factors = rows.column(sweep, "load_factor").unwrap_or_default();
    let is_common = column.starts_with("life_")
        && sweep.varies_the_smooth_contact()
        && factors.iter().any(|factor| factor.is_finite());
    if is_common {
        for (life, factor) in values.iter_mut().zip(factors) {
            *life *= factor;
        }
    }
    (values, is_common)
}

/// What surfaces that age come to.
const PITTED: &str = "part of the surface with pits";
const WORN: &str = "depth worn, m";

/// Pictures along the last axis, the first six of any sweep, all of a path.
#[rustfmt::skip]
const PLOTS: [Plot; 9] = [
    Plot { name: "life", label: OWN_LIFE, scale: Scale::Log, curves: &[computed("", "life_relative")] },
    Plot { name: "traction", label: "friction coefficient", scale: Scale::Linear, curves: &[computed("", "friction_coefficient")] },
    Plot { name: "pressure", label: "pressure, Pa", scale: Scale::Linear, curves: &[computed("maximum", "p_max_greatest_pa"), computed("mean of the steps' maxima", "p_max_pa"), formula("Hertz", "p_hertz_pa")] },
    Plot { name: "film", label: "film, m", scale: Scale::Log, curves: &[computed("centre", "h_central_m"), computed("mean of the steps' minima", "h_min_m"), formula("smooth, by regression", "h_regression_m")] },
    Plot { name: "pits", label: PITTED, scale: Scale::Linear, curves: &[computed("body 1", "pitted_area_1"), computed("body 2", "pitted_area_2")] },
    Plot { name: "worn", label: WORN, scale: Scale::Linear, curves: &[computed("body 1", "wear_depth_1_m"), computed("body 2", "wear_depth_2_m")] },
    Plot { name: "mechanisms", label: "factor of life", scale: Scale::Log, curves: &[computed("cycles", "cycle_factor"), computed("peaks", "peak_factor"), computed("traction", "traction_factor"), computed("load", "load_factor")] },
    Plot { name: "contacts", label: "contacts a loading cycle n", scale: Scale::Log, curves: &[computed("body 1", "n_body_1"), computed("body 2", "n_body_2")] },
    Plot { name: "lambda", label: "lambda", scale: Scale::Linear, curves: &[computed("", "lambda_ratio")] },
];

/// Pictures against λ.
#[rustfmt::skip]
const AGAINST_LAMBDA: [Plot; 2] = [
    Plot { name: "stribeck", label: "friction coefficient", scale: Scale::Linear, curves: &[computed("", "friction_coefficient")] },
    Plot { name: "life_against_lambda", label: OWN_LIFE, scale: Scale::Log, curves: &[computed("by damage", "life_damage"), computed("the paper's count", "life_global")] },
];

fn figures(sweep: &Sweep, rows: &Rows) -> Vec<(String, Figure)> {
    let Some(along) = along(sweep) else {
        return Vec::new();
    };
    let lines = lines(sweep);
    let plots = if sweep.path.is_empty() {
        &PLOTS[..6]
    } else {
        &PLOTS[..]
    };
    let mut found = Vec::new();
    for plot in plots {
        let name = format!("{}_against_{}", plot.name, along.short);
        found.push((name, figure(sweep, rows, &along, &lines, plot)));
    }
    found.extend(over_seeds(sweep, rows));
    found.extend(against_lambda(sweep, rows, &lines));
    found.retain(|(_, figure)| !figure.curves.is_empty());
    found
}

/// Some cases of a sweep, one curve, and what sets it apart.
struct Line {
    name: String,
    cases: std::ops::Range<usize>,
}

fn lines(sweep: &Sweep) -> Vec<Line> {
    let loads = sweep.loads();
    if loads.len() > 1 {
        let line = |cases: std::ops::Range<usize>| Line {
            name: load_words(sweep, cases.start),
            cases,
        };
        return loads.into_iter().take(MOST_CURVES).map(line).collect();
    }
    let width = match (sweep.combine, sweep.axes.last()) {
        (Combine::Grid, Some(axis)) => axis.values.len(),
        (Combine::List, _) | (Combine::Grid, None) => sweep.len(),
    };
    let others = match sweep.combine {
        Combine::Grid => &sweep.axes[..sweep.axes.len().saturating_sub(1)],
        Combine::List => &[],
    };
    let starts = (0..sweep.len()).step_by(width.max(1)).take(MOST_CURVES);
    let line = |from: usize| {
        let values = others.iter().zip(sweep.values(from));
        let words = values.map(|(axis, value)| format!("{} = {}", axis.key, shown(value)));
        Line {
            name: words.collect::<Vec<_>>().join(", "),
            cases: from..from + width,
        }
    };
    starts.map(line).collect()
}

/// What sets the load of a case apart from the others of its spectrum, in words; empty: there is one.
fn load_words(sweep: &Sweep, case: usize) -> String {
    let of = |name| Some(super::path::column(&sweep.path, name)?[case]);
    match [of("torque_n_m"), of("speed_rpm"), of("time_share")] {
        [Some(torque), Some(speed), Some(share)] => {
            format!("{torque} N m, {speed} rpm, {} % of the time", 100.0 * share)
        }
        _ => String::new(),
    }
}

fn figure(sweep: &Sweep, rows: &Rows, along: &CurveAxis, lines: &[Line], plot: &Plot) -> Figure {
    let mut curves = Vec::new();
    let mut label = plot.label;
    let xs = rows.column(sweep, &along.column).unwrap_or_default();
    for curve in plot.curves {
        let (ys, is_common) = drawn(sweep, rows, curve.column);
        if is_common {
            label = COMMON_LIFE;
        }
        if !ys.iter().any(|y| y.is_finite()) {
            continue;
        }
        for line in lines {
            let name = [curve.name, line.name.as_str()];
            let name: Vec<_> = name.into_iter().filter(|part| !part.is_empty()).collect();
            curves.push(Curve {
                name: name.join(", "),
                points: line.cases.clone().map(|k| (xs[k], ys[k])).collect(),
                mark: curve.mark,
            });
        }
    }
    Figure {
        title: title(sweep),
        x: (along.label.clone(), along.scale),
        y: (label.to_owned(), plot.scale),
        curves,
        levels: Vec::new(),
    }
}

fn title(sweep: &Sweep) -> String {
    if sweep.title.is_empty() {
        sweep.name.clone()
    } else {
        sweep.title.clone()
    }
}

/// Mean over the seeds and its ends, of life and of pits, where seeds vary and one key of numbers beside them.
fn over_seeds(sweep: &Sweep, rows: &Rows) -> Vec<(String, Figure)> {
    let (lives, is_common) = drawn(sweep, rows, "life_relative");
    let scatter = |values: Vec<f64>| {
        let found = Scatter::of(values)?;
        Some([found.mean, found.ends[0], found.ends[1]])
    };
    let life = if is_common { COMMON_LIFE } else { OWN_LIFE };
    let mean = "mean over the seeds (of the logarithms)";
    let of_life = seeds_figure(sweep, &lives, (life, Scale::Log), mean, scatter);
    // None has pits on most maps: no logarithms.
    let plain = |values: Vec<f64>| {
        let known: Vec<f64> = values.into_iter().filter(|v| v.is_finite()).collect();
        let least = known.iter().copied().reduce(f64::min)?;
        let most = known.iter().copied().reduce(f64::max)?;
        Some([known.iter().sum::<f64>() / known.len() as f64, least, most])
    };
    let pits = of_worse_body(sweep, rows, ["pitted_area_1", "pitted_area_2"]);
    let mean = "mean over the seeds, worse body";
    let of_pits = seeds_figure(sweep, &pits, (PITTED, Scale::Linear), mean, plain);
    let named = |name: &str, figure: Option<Figure>| Some((name.to_owned(), figure?));
    let both = [
        named("life_over_seeds", of_life),
        named("pits_over_seeds", of_pits),
    ];
    both.into_iter().flatten().collect()
}

/// Mean, least and greatest of a value a case over the seeds, as `scatter` has them, against the other key.
fn seeds_figure(
    sweep: &Sweep,
    values: &[f64],
    (label, scale): (&str, Scale),
    mean: &str,
    scatter: impl Fn(Vec<f64>) -> Option<[f64; 3]>,
) -> Option<Figure> {
    let (seeds, others) = sweep.seed_axes();
    let ([_, ..], [other]) = (&seeds[..], &others[..]) else {
        return None;
    };
    let axis = &sweep.axes[*other];
    let xs = axis.numbers()?;
    let of = |group: Vec<usize>| {
        let x = xs[sweep.place(group[0])[*other]];
        let values = group.iter().filter_map(|&case| values.get(case).copied());
        scatter(values.collect()).map(|found| (x, found))
    };
    let found: Vec<(f64, [f64; 3])> = sweep.over_seeds().into_iter().filter_map(of).collect();
    let names = [
        (mean, Mark::Computed),
        ("least", Mark::Formula),
        ("greatest", Mark::Formula),
    ];
    let curve = |(which, (name, mark)): (usize, (&str, Mark))| Curve {
        name: name.to_owned(),
        points: found.iter().map(|(x, found)| (*x, found[which])).collect(),
        mark,
    };
    (!found.is_empty()).then(|| Figure {
        title: title(sweep),
        x: (axis.label(), scale_of(&xs)),
        y: (label.to_owned(), scale),
        curves: names.into_iter().enumerate().map(curve).collect(),
        levels: Vec::new(),
    })
}

/// The greater of both bodies' values, case by case.
fn of_worse_body(sweep: &Sweep, rows: &Rows, columns: [&str; 2]) -> Vec<f64> {
    let [one, two] = columns.map(|column| rows.column(sweep, column).unwrap_or_default());
    one.into_iter().zip(two).map(|(a, b)| a.max(b)).collect()
}

/// Friction and lives against λ, where something varies that moves λ.
fn against_lambda(sweep: &Sweep, rows: &Rows, lines: &[Line]) -> Vec<(String, Figure)> {
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
    let draw = |plot: &Plot| {
        let mut figure = figure(sweep, rows, &lambda, lines, plot);
        for curve in &mut figure.curves {
            curve.points.retain(|(x, y)| x.is_finite() && y.is_finite());
            curve.points.sort_by(|one, two| one.0.total_cmp(&two.0));
        }
        figure.curves.retain(|curve| curve.points.len() > 1);
        (plot.name.to_owned(), figure)
    };
    AGAINST_LAMBDA.iter().map(draw).collect()
}

/// A picture over two axes.
struct MapPlot {
    name: &'static str,
    /// Over the colours, where there is room for a word.
    value: &'static str,
    of: MapOf,
}

/// What it shows.
enum MapOf {
    Life,
    /// The greater of both bodies' columns, and what it is.
    WorseBody([&'static str; 2], &'static str),
}

#[rustfmt::skip]
const MAPS: [MapPlot; 3] = [
    MapPlot { name: "life_map", value: "life", of: MapOf::Life },
    MapPlot { name: "pits_map", value: "pits", of: MapOf::WorseBody(["pitted_area_1", "pitted_area_2"], PITTED) },
    MapPlot { name: "worn_map", value: "worn", of: MapOf::WorseBody(["wear_depth_1_m", "wear_depth_2_m"], WORN) },
];

/// A value over the last two axes of a grid; of more axes, at the first values of the others.
fn heat_map(sweep: &Sweep, rows: &Rows, map: &MapPlot) -> Option<HeatMap> {
    let [.., y, x] = sweep.axes.as_slice() else {
        return None;
    };
    let (xs, ys) = (x.numbers()?, y.numbers()?);
    // A seed is a name and no number.
    let has_seeds = !sweep.seed_axes().0.is_empty();
    if has_seeds || sweep.combine != Combine::Grid || xs.len() < 2 || ys.len() < 2 {
        return None;
    }
    let rising = |list: &[f64]| list.windows(2).all(|pair| pair[1] > pair[0]);
    if !rising(&xs) || !rising(&ys) {
        return None;
    }
    let (values, what, scale) = match map.of {
        MapOf::Life => {
            let (lives, is_common) = drawn(sweep, rows, "life_relative");
            let what = if is_common { COMMON_LIFE } else { OWN_LIFE };
            (lives, what, Scale::Log)
        }
        MapOf::WorseBody(columns, what) => {
            (of_worse_body(sweep, rows, columns), what, Scale::Linear)
        }
    };
    values
        .iter()
        .any(|value| value.is_finite())
        .then(|| HeatMap {
            title: format!("{}: {what}", title(sweep)),
            rows: values
                .chunks(xs.len())
                .take(ys.len())
                .map(<[f64]>::to_vec)
                .collect(),
            x: (x.label(), xs),
            y: (y.label(), ys),
            value: (map.value.to_owned(), scale),
        })
}
