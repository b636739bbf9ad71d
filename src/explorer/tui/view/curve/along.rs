//! The three curves: life against S, friction against S, friction against the speed (Stribeck).

use ratatui::layout::Rect;

use crate::tui::action::Action;
use crate::tui::app::{App, CurveKind, Leading};
use crate::tui::units::{nice_ceiling, sig};
use crate::tui::view::chart::Plot;
use asperity_engine::scene::CycleBasis;
use asperity_engine::sim::Knob;
use asperity_session::sweep::{Along, Found};

/// What was simulated.
pub(super) struct CurvePoint {
    pub(super) x: f64,
    pub(super) y: f64,
    /// Between which y it may lie.
    pub(super) band: Option<[f64; 2]>,
}

/// A curve with its axes; places in the units of the axes.
pub(super) struct CurveFigure {
    pub(super) name: &'static str,
    /// What a formula says; empty: there is none.
    pub(super) formula: Vec<(f64, f64)>,
    /// What was simulated, with the ends of its band, and its name, in full and short.
    pub(super) points: Vec<CurvePoint>,
    pub(super) points_name: [&'static str; 2],
    /// The same by the other count, and whose that is, in full and short.
    pub(super) other: Vec<(f64, f64)>,
    pub(super) other_name: [&'static str; 2],
    /// Where the knob is.
    pub(super) knob: f64,
    /// The number that leads now.
    pub(super) now: Option<f64>,
    pub(super) x: [f64; 2],
    pub(super) y: [f64; 2],
    /// Numbers at the lower and upper end of y.
    pub(super) y_ends: [String; 2],
    /// Words left, in the middle and right below the axis.
    pub(super) foot: [String; 3],
}

impl Default for CurveFigure {
    fn default() -> Self {
        Self {
            name: "",
            formula: Vec::new(),
            points: Vec::new(),
            points_name: ["simulated ", "sim. "],
            other: Vec::new(),
            other_name: [""; 2],
            knob: 0.0,
            now: None,
            x: [0.0; 2],
            y: [0.0; 2],
            y_ends: Default::default(),
            foot: Default::default(),
        }
    }
}

impl CurveFigure {
    pub(super) fn plot(&self, area: Rect) -> Plot {
        let (x, y) = (self.x, self.y);
        Plot { area, x, y }
    }
}

/// Places of a formula over the range of S.
const FINE: usize = 120;
/// |S| up to which the formula sets the axis.
const MOVES: f64 = 1.9;

/// `None`: it is a map.
pub(super) fn figure(app: &App) -> Option<CurveFigure> {
    Some(match app.view.curve {
        CurveKind::Life => life(app),
        CurveKind::Friction => friction(app),
        CurveKind::Stribeck => stribeck(app),
        CurveKind::Aged(aged) => super::aged::figure(app, aged),
        CurveKind::Map(_) => return None,
    })
}

/// What a press at a place of the present curve's axis asks for.
pub(super) fn goes_to(app: &App, x: f64) -> Option<Action> {
    match app.view.curve {
        CurveKind::Life | CurveKind::Friction => Some(Action::GoTo(Knob::SlideRoll, x)),
        CurveKind::Stribeck => {
            let [sign, _] = axis(app, Knob::EntrainmentMS).0;
            let speed = 10_f64.powf(x).copysign(sign);
            Some(Action::GoTo(Knob::EntrainmentMS, speed))
        }
        CurveKind::Aged(_) | CurveKind::Map(_) => None,
    }
}

/// What was simulated along a line; nothing while a lesson asks what it would show.
fn seen(app: &App, along: Along) -> impl Iterator<Item = &Found> {
    let is_asked = app.is_asked();
    app.simulated(along).filter(move |_| !is_asked)
}

/// Range and target of a knob.
fn axis(app: &App, knob: Knob) -> ([f64; 2], f64) {
    let dial = app.choice.dials.iter().find(|dial| dial.knob == knob);
    dial.map_or(([0.0, 1.0], 0.0), |dial| {
        ([dial.min, dial.max], dial.target)
    })
}

/// Life over whole decades, logarithmic: the formula over the whole range of S, dots where it was simulated.
fn life(app: &App) -> CurveFigure {
    let (x, knob) = axis(app, Knob::SlideRoll);
    let formula: Vec<(f64, f64)> = (0..=FINE)
        .map(|i| x[0] + (x[1] - x[0]) * i as f64 / FINE as f64)
        .map(|s| (s, app.formula_at(s).unwrap_or(f64::NAN).log10()))
        .collect();
    let point = |found: &Found| {
        let [low, y, high] = found.life?.map(f64::log10);
        Some(CurvePoint {
            x: found.at.slide_roll,
            y,
            band: Some([low, high]),
        })
    };
    let points: Vec<_> = seen(app, Along::SlideRoll).filter_map(point).collect();
    let other = |found: &Found| Some((found.at.slide_roll, found.other?.log10()));
    let other: Vec<_> = seen(app, Along::SlideRoll).filter_map(other).collect();
    // At ±2 a body stands and the life falls without end: the axis is not for that.
    let known = formula.iter().filter(|place| place.0.abs() < MOVES);
    let known = known.map(|place| place.1);
    let now = app.leading_life().map(f64::log10);
    let simulated = points
        .iter()
        .map(|point| point.y)
        .chain(other.iter().map(|place| place.1));
    let y = decades(known.chain(simulated).chain(now));
    let cycles = app.run.setup.scene.life.as_ref().map(|life| life.cycles);
    CurveFigure {
        name: CurveKind::Life.name(),
        formula,
        points,
        other,
        other_name: match cycles {
            Some(CycleBasis::Damage) | None => ["Pu et al. 2016", "Pu"],
            Some(CycleBasis::Global | CycleBasis::Peaks) => ["by damage", "D"],
        },
        knob,
        now,
        x,
        y,
        y_ends: y.map(|decade| sig(10_f64.powf(decade), 1)),
        foot: slide_roll_foot(x),
        ..CurveFigure::default()
    }
}

fn slide_roll_foot([from, to]: [f64; 2]) -> [String; 3] {
    [format!("S {from:.0}"), "0".to_owned(), format!("{to:.0}")]
}

/// What was simulated of the friction along a knob, and the friction now, once it holds for where the knobs are. No formula.
fn simulated_friction(app: &App, along: Along, x: impl Fn(&Found) -> f64) -> CurveFigure {
    let point = |found: &Found| CurvePoint {
        x: x(found),
        y: found.friction,
        band: None,
    };
    let points: Vec<_> = seen(app, along).map(point).collect();
    let most = points.iter().map(|point| point.y).fold(0.01, f64::max);
    let most = nice_ceiling(most);
    let settled = app.leading() == Leading::Simulated;
    let frame = app.frame().filter(|_| settled);
    CurveFigure {
        points,
        now: frame.map(|frame| frame.metrics.friction_coefficient),
        y: [0.0, most],
        y_ends: ["0".to_owned(), sig(most, 1)],
        ..CurveFigure::default()
    }
}

/// The traction curve.
fn friction(app: &App) -> CurveFigure {
    let (x, knob) = axis(app, Knob::SlideRoll);
    CurveFigure {
        name: CurveKind::Friction.name(),
        knob,
        x,
        foot: slide_roll_foot(x),
        ..simulated_friction(app, Along::SlideRoll, |found| found.at.slide_roll)
    }
}

/// Friction against the entrainment speed, logarithmic; the λ that belong to the points below it.
fn stribeck(app: &App) -> CurveFigure {
    let place = |speed_m_s: f64| speed_m_s.abs().max(1e-12).log10();
    let (ends, knob) = axis(app, Knob::EntrainmentMS);
    // Bodies that run towards −x have negative speeds: the slow end stands left.
    let slow_and_fast = if ends[0].abs() < ends[1].abs() {
        ends
    } else {
        [ends[1], ends[0]]
    };
    let lambdas = app
        .simulated(Along::Entrainment)
        .filter_map(|found| found.lambda);
    let (low, high) = lambdas.fold((f64::MAX, 0.0_f64), |(low, high), one| {
        (low.min(one), high.max(one))
    });
    let middle = if low < high {
        format!("λ {}–{}", sig(low, 2), sig(high, 2))
    } else {
        String::new()
    };
    let unit = app.view.units.speed();
    CurveFigure {
        name: CurveKind::Stribeck.name(),
        knob: place(knob),
        x: slow_and_fast.map(place),
        foot: [
            format!("U {}", sig(unit.of(slow_and_fast[0]), 1)),
            middle,
            unit.show(slow_and_fast[1], 1),
        ],
        ..simulated_friction(app, Along::Entrainment, |found| {
            place(found.at.entrainment_m_s)
        })
    }
}

/// Whole decades that hold all values, at least one.
pub(super) fn decades(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let (mut low, mut high) = (0.0_f64, 0.0_f64);
    for value in values.filter(|value| value.is_finite()) {
        low = low.min(value);
        high = high.max(value);
    }
    let low = low.floor().max(-12.0);
    [low.min(high.ceil() - 1.0), high.ceil().min(12.0)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decades_are_whole_and_hold_all() {
        assert_eq!(decades([-0.2, -2.7].into_iter()), [-3.0, 0.0]);
        assert_eq!(decades([0.4].into_iter()), [0.0, 1.0]);
        assert_eq!(decades(std::iter::empty()), [-1.0, 0.0]);
        assert_eq!(
            decades([f64::NAN, f64::NEG_INFINITY].into_iter()),
            [-1.0, 0.0]
        );
    }
}
