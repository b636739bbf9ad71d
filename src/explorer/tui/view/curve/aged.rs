//! Surfaces that age: what they come to, over the loading cycles that lie behind them.

use super::along::{CurveFigure, CurvePoint, decades};
use crate::tui::app::{Aged, App};
use crate::tui::units::{nice_ceiling, sig};
use asperity_engine::sim::{AgePoint, Dimension};

/// Decades of cycles shown: new surfaces stand left of all.
const DECADES: f64 = 6.0;

/// The curve, logarithmic in the cycles; of what both bodies have, body 1 as points and body 2 as the others.
pub(super) fn figure(app: &App, aged: Aged) -> CurveFigure {
    let ages = &app.lives.ages;
    let most = app.run.setup.scene.age.map_or(1.0, |age| age.cycles);
    let end = most.log10();
    let x = [end - DECADES, end];
    let place = |age: &AgePoint| age.cycles.log10().clamp(x[0], x[1]);
    let kind = app.run.setup.scene.contact.kind;
    let unit = app.view.units.unit(dimension(aged), kind);
    let values = |age: &AgePoint| both(aged, age).map(|value| value.map(|value| unit.of(value)));
    let of_body = |body: usize| {
        ages.iter()
            .filter_map(move |age| Some((place(age), values(age)[body]?)))
    };
    let is_life = aged == Aged::Life;
    let shown = |y: f64| if is_life { y.log10() } else { y };
    let points = of_body(0).map(|(x, y)| CurvePoint {
        x,
        y: shown(y),
        band: None,
    });
    let points: Vec<_> = points.collect();
    let other: Vec<_> = of_body(1).map(|(x, y)| (x, shown(y))).collect();
    let all = points
        .iter()
        .map(|point| point.y)
        .chain(other.iter().map(|place| place.1));
    let (y, y_ends) = if is_life {
        let y = decades(all);
        (y, y.map(|decade| sig(10_f64.powf(decade), 1)))
    } else {
        let most = nice_ceiling(all.fold(f64::MIN_POSITIVE, f64::max));
        ([0.0, most], ["0".to_owned(), sig(most, 1)])
    };
    let last = ages.last();
    let now = last.map_or(String::new(), |age| {
        let found = values(age).into_iter().flatten().map(|value| sig(value, 2));
        let found: Vec<_> = found.collect();
        let value = format!("{} {}", found.join(", "), unit.name);
        format!("{} at {} cycles", value.trim_end(), sig(age.cycles, 2))
    });
    CurveFigure {
        name: aged.name(),
        points_name: if other.is_empty() {
            ["so far ", ""]
        } else {
            ["body 1 ", "1 "]
        },
        other_name: ["body 2", "2"],
        knob: last.map_or(x[0], place),
        now: points.last().map(|point| point.y),
        points,
        other,
        x,
        y,
        y_ends,
        foot: ["new".to_owned(), now, sig(most, 1)],
        ..CurveFigure::default()
    }
}

fn dimension(aged: Aged) -> Dimension {
    match aged {
        Aged::Life | Aged::Lambda | Aged::Friction => Dimension::Plain,
        Aged::Rq | Aged::Depth => Dimension::Height,
        Aged::Pressure => Dimension::Pressure,
        Aged::Pits => Dimension::Share,
    }
}

/// Of body 1, or of both together, and of body 2.
fn both(aged: Aged, age: &AgePoint) -> [Option<f64>; 2] {
    match aged {
        Aged::Life => [age.life_relative.filter(|life| *life > 0.0), None],
        Aged::Rq => [Some(age.rq_1_m), Some(age.rq_2_m)],
        Aged::Lambda => [age.lambda_ratio, None],
        Aged::Depth => [Some(age.wear_depth_1_m), Some(age.wear_depth_2_m)],
        Aged::Pressure => [Some(age.p_max_pa), None],
        Aged::Friction => [Some(age.friction_coefficient), None],
        Aged::Pits => [age.pitted_area_1, age.pitted_area_2],
    }
}
