//! Pictures of the evidence.

use super::tried::Tried;
use super::{Evidence, Grade};
use asperity_engine::scene::CycleBasis;
use asperity_picture::chart::{Chart as _, Curve, Figure, Mark, Scale};

/// Found against theirs, one colour a grade; the line is agreement.
///
/// # Errors
/// What the drawing library says.
pub fn agreement_plot(result: &Evidence) -> Result<String, String> {
    let mut curves = Vec::new();
    for grade in [Grade::A, Grade::B, Grade::C] {
        let of_grade = result.rows.iter().filter(|row| row.grade == grade);
        let mut points: Vec<(f64, f64)> = of_grade.map(|row| (row.theirs, row.limit)).collect();
        points.sort_by(|one, two| one.0.total_cmp(&two.0));
        curves.push(Curve {
            name: grade.name().to_owned(),
            points,
            mark: Mark::Computed,
        });
    }
    let ends = |ends: (f64, f64), row: &super::EvidenceRow| {
        (ends.0.min(row.theirs), ends.1.max(row.theirs))
    };
    let (low, high) = result.rows.iter().fold((f64::INFINITY, 0.0), ends);
    curves.push(Curve {
        name: "agreement".to_owned(),
        points: vec![(low, low), (high, high)],
        mark: Mark::Formula,
    });
    draw(&Figure {
        title: "Found against published".to_owned(),
        x: ("theirs (unit of each row)".to_owned(), Scale::Log),
        y: ("found, extrapolated".to_owned(), Scale::Log),
        curves,
        levels: Vec::new(),
    })
}

/// Damage by every counting along the axis of each experiment that has one, and what was measured, each over its greatest:
/// name of the file and picture.
///
/// # Errors
/// What the drawing library says.
pub fn experiments_plot(result: &Evidence) -> Result<Vec<(String, String)>, String> {
    let mut pictures = Vec::new();
    for tried in &result.experiments {
        let Some(axis) = &tried.experiment.axis else {
            continue;
        };
        let letters = tried.experiment.name.chars().map(|c| {
            if c.is_ascii_alphanumeric() {
                c.to_ascii_lowercase()
            } else {
                '_'
            }
        });
        let name: String = letters.collect();
        let parts: Vec<&str> = name.split('_').filter(|part| !part.is_empty()).collect();
        let figure = Figure {
            title: format!("{}: damage over its greatest", tried.experiment.name),
            x: (axis.clone(), Scale::Linear),
            y: (
                "damage (measured: as the source has it)".to_owned(),
                Scale::Log,
            ),
            curves: curves(tried),
            levels: Vec::new(),
        };
        pictures.push((format!("evidence_{}.svg", parts.join("_")), draw(&figure)?));
    }
    Ok(pictures)
}

fn curves(tried: &Tried) -> Vec<Curve> {
    let curve = |name: String, values: Vec<Option<f64>>| {
        let greatest = values.iter().flatten().copied().fold(0.0, f64::max);
        let places = tried.experiment.point.iter().map(|point| point.x);
        let points = places.zip(values);
        Curve {
            name,
            points: points
                .filter_map(|(x, value)| Some((x?, value? / greatest)))
                .collect(),
            mark: Mark::Computed,
        }
    };
    let points = &tried.experiment.point;
    let measured = points.iter().map(|point| point.measured).collect();
    let mut curves = vec![curve("source".to_owned(), measured)];
    for (k, basis) in CycleBasis::ALL.into_iter().enumerate() {
        let values = tried.damages.iter();
        let values = values.map(|found| found[k].as_ref().ok().map(|damage| damage.value));
        curves.push(curve(basis.key().to_owned(), values.collect()));
    }
    curves
}

fn draw(figure: &Figure) -> Result<String, String> {
    Ok(figure.svg()?.unwrap_or_default())
}
