//! Right, below: life against S (logarithmic) with the operating point on it, and the history of
//! the estimate.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use crate::tui::app::{App, Curve};
use crate::tui::theme::Role;
use crate::tui::units::{nice_ceiling, sig};
use crate::tui::view::chart::{Chart, Pen};
use crate::tui::view::{ascii_text, put, put_right};

/// Rows from which a curve can be read, with its heading and its axis.
const CURVE_ROWS: u16 = 7;

pub(super) fn render(app: &App, area: Rect, buffer: &mut Buffer) {
    if (CURVE_ROWS + 1..CURVE_ROWS + 5).contains(&area.height) {
        let curve = Rect {
            y: area.y + 1,
            height: area.height - 1,
            ..area
        };
        against_slide_roll(app, curve, buffer);
    } else if area.height >= CURVE_ROWS + 5 {
        let history = (area.height / 3).clamp(4, 8);
        let curve = Rect {
            y: area.y + 1,
            height: area.height - history - 1,
            ..area
        };
        let below = Rect {
            y: curve.bottom(),
            height: history,
            ..area
        };
        against_slide_roll(app, curve, buffer);
        over_time(app, below, buffer);
    } else if area.height >= 2 {
        over_time(app, area, buffer);
    }
}

fn pen(app: &App, role: Role, letter: char) -> Pen {
    Pen {
        style: app.theme.style(role),
        letter,
    }
}

/// Formula over the whole range of S; dots where the simulation settled.
fn against_slide_roll(app: &App, area: Rect, buffer: &mut Buffer) {
    match app.curve {
        Curve::Life => life_against_slide_roll(app, area, buffer),
        Curve::Friction => friction_against_slide_roll(app, area, buffer),
    }
}

/// The traction curve: no formula, only what was simulated.
fn friction_against_slide_roll(app: &App, area: Rect, buffer: &mut Buffer) {
    let theme = app.theme;
    let heading = Line::from(vec![
        Span::styled("y ", theme.style(Role::Key)),
        Span::styled("friction against S ", theme.style(Role::Title)),
        Span::styled(theme.pick("• ", "o "), theme.style(Role::Good)),
        Span::styled("simulated ", theme.style(Role::Dim)),
    ]);
    put(area, 0, &heading, buffer);
    sweeping(app, area, &heading, buffer);
    let dial = &app.dials[0];
    let range = [dial.min, dial.max];
    let plot = plot_of(area);
    let most = app.settled.iter().map(|point| point.friction);
    let most = nice_ceiling(most.fold(0.01, f64::max));
    let mut chart = Chart::new(plot, range, [0.0, most]);
    chart.upright(dial.target, pen(app, Role::Dim, ':'));
    chart.render(theme.is_ascii(), buffer);
    for point in &app.settled {
        let along = (point.slide_roll - range[0]) / (range[1] - range[0]);
        let down = 1.0 - point.friction / most;
        if plot.is_empty() || !(0.0..=1.0).contains(&along) || !(0.0..=1.0).contains(&down) {
            continue;
        }
        let at = (
            plot.x + (along * f64::from(plot.width - 1)).round() as u16,
            plot.y + (down * f64::from(plot.height - 1)).round() as u16,
        );
        if let Some(cell) = buffer.cell_mut(at) {
            cell.set_symbol(theme.pick("•", "o"))
                .set_style(theme.style(Role::Good));
        }
    }
    foot(app, plot, range, buffer);
    let dim = theme.style(Role::Dim);
    let axis = Rect {
        y: plot.y,
        width: 4,
        height: plot.height,
        ..area
    };
    put_right(axis, 0, &Line::styled(sig(most, 1), dim), buffer);
    let last = plot.height.saturating_sub(1);
    put_right(axis, last, &Line::styled("0", dim), buffer);
}

/// How far a sweep is, in the corner or below it.
fn sweeping(app: &App, area: Rect, heading: &Line<'_>, buffer: &mut Buffer) {
    let theme = app.theme;
    if let Some((done, all)) = app.sweep {
        let text = format!("{}{done}/{all}", theme.pick("⟳ ", "@ "));
        let line = Line::styled(text, theme.style(Role::Warn));
        let room = (heading.width() + line.width()) as u16 <= area.width;
        let corner = Rect {
            y: area.y + u16::from(!room),
            ..area
        };
        put_right(corner, 0, &line, buffer);
    }
}

fn plot_of(area: Rect) -> Rect {
    Rect {
        x: area.x + 5,
        y: area.y + 1,
        width: area.width.saturating_sub(5),
        height: area.height.saturating_sub(2),
    }
}

fn life_against_slide_roll(app: &App, area: Rect, buffer: &mut Buffer) {
    let theme = app.theme;
    let heading = Line::from(vec![
        Span::styled("y ", theme.style(Role::Key)),
        Span::styled("life against S ", theme.style(Role::Title)),
        Span::styled(theme.pick("┄ ", ". "), theme.style(Role::Formula)),
        Span::styled("formula ", theme.style(Role::Dim)),
        Span::styled(theme.pick("• ", "o "), theme.style(Role::Good)),
        Span::styled("simulated ", theme.style(Role::Dim)),
    ]);
    put(area, 0, &heading, buffer);
    sweeping(app, area, &heading, buffer);
    let dial = &app.dials[0];
    let range = [dial.min, dial.max];
    let plot = plot_of(area);
    let fine = usize::from(plot.width) * 2;
    let at = |i: usize| range[0] + (range[1] - range[0]) * i as f64 / fine.max(1) as f64;
    let formula: Vec<(f64, f64)> = (0..=fine)
        .map(|i| {
            let slide_roll = at(i);
            let life = app.formula_at(slide_roll).unwrap_or(f64::NAN);
            (slide_roll, life.log10())
        })
        .collect();
    let settled: Vec<(f64, f64)> = app
        .settled
        .iter()
        .map(|point| (point.slide_roll, point.life_relative.log10()))
        .collect();
    let known = formula.iter().chain(&settled).map(|(_, decade)| *decade);
    let decades = decades(known);
    let mut chart = Chart::new(plot, range, decades);
    chart.upright(dial.target, pen(app, Role::Dim, ':'));
    chart.line(formula, pen(app, Role::Formula, '.'));
    for point in &app.settled {
        // The band: an upright bar through the point.
        let ends = point.band.map(|life| (point.slide_roll, life.log10()));
        chart.line(ends, pen(app, Role::Good, '|'));
    }
    chart.render(theme.is_ascii(), buffer);
    let spot =
        |(slide_roll, decade): (f64, f64), symbol: &'static str, role, buffer: &mut Buffer| {
            let along = (slide_roll - range[0]) / (range[1] - range[0]);
            let down = 1.0 - (decade - decades[0]) / (decades[1] - decades[0]);
            if plot.is_empty() || !(0.0..=1.0).contains(&along) || !(0.0..=1.0).contains(&down) {
                return;
            }
            let at = (
                plot.x + (along * f64::from(plot.width - 1)).round() as u16,
                plot.y + (down * f64::from(plot.height - 1)).round() as u16,
            );
            if let Some(cell) = buffer.cell_mut(at) {
                cell.set_symbol(symbol).set_style(theme.style(role));
            }
        };
    for point in settled {
        spot(point, theme.pick("•", "o"), Role::Good, buffer);
    }
    if let Some(life) = app.leading_life() {
        let here = (dial.target, life.log10());
        spot(here, theme.pick("◉", "O"), Role::Strong, buffer);
    }
    labels(app, area, plot, decades, range, buffer);
}

fn labels(
    app: &App,
    area: Rect,
    plot: Rect,
    decades: [f64; 2],
    range: [f64; 2],
    buffer: &mut Buffer,
) {
    let theme = app.theme;
    let dim = theme.style(Role::Dim);
    let axis = Rect {
        y: plot.y,
        width: 4,
        height: plot.height,
        ..area
    };
    let power = |decade: f64| match decade as i32 {
        0 => "1".to_owned(),
        1 => "10".to_owned(),
        other => format!("1e{other}"),
    };
    put_right(axis, 0, &Line::styled(power(decades[1]), dim), buffer);
    put_right(
        axis,
        plot.height.saturating_sub(1),
        &Line::styled(power(decades[0]), dim),
        buffer,
    );
    foot(app, plot, range, buffer);
}

/// Ends and middle of the axis of S.
fn foot(app: &App, plot: Rect, range: [f64; 2], buffer: &mut Buffer) {
    let dim = app.theme.style(Role::Dim);
    let foot = Rect {
        y: plot.bottom(),
        height: 1,
        ..plot
    };
    put(
        foot,
        0,
        &Line::styled(format!("S {:.0}", range[0]), dim),
        buffer,
    );
    put_right(
        foot,
        0,
        &Line::styled(format!("{:.0}", range[1]), dim),
        buffer,
    );
    let middle = Rect {
        x: foot.x + foot.width / 2,
        width: foot.width.div_ceil(2),
        ..foot
    };
    put(middle, 0, &Line::styled("0", dim), buffer);
}

/// Whole decades that hold all values, at least one.
fn decades(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let (mut low, mut high) = (0.0_f64, 0.0_f64);
    for value in values.filter(|value| value.is_finite()) {
        low = low.min(value);
        high = high.max(value);
    }
    let low = low.floor().max(-12.0);
    [low.min(high.ceil() - 1.0), high.ceil().min(12.0)]
}

/// The estimate over the passages seen: one curve, the present on the right.
fn over_time(app: &App, area: Rect, buffer: &mut Buffer) {
    let theme = app.theme;
    let dim = theme.style(Role::Dim);
    let (Some(first), Some(last)) = (app.history.front(), app.history.back()) else {
        return;
    };
    let plot = Rect {
        y: area.y + 1,
        height: area.height.saturating_sub(1),
        ..area
    };
    let span = last.passages - first.passages;
    let heading = Line::from(vec![
        Span::styled("history ", theme.style(Role::Title)),
        Span::styled(ascii_text(theme, &format!("{span:.1} passages of 4a")), dim),
    ]);
    put(area, 0, &heading, buffer);
    if span <= 0.0 || plot.is_empty() {
        return;
    }
    let logarithm = |life: f64| life.log10();
    let values = app
        .history
        .iter()
        .map(|sample| logarithm(sample.life_relative));
    let (low, high) = values.fold((f64::MAX, f64::MIN), |(low, high), value| {
        (low.min(value), high.max(value))
    });
    // At least a third of a decade, so that noise stays small.
    let middle = 0.5 * (low + high);
    let half = (0.55 * (high - low)).max(0.17);
    let mut chart = Chart::new(
        plot,
        [first.passages, last.passages],
        [middle - half, middle + half],
    );
    let points = app
        .history
        .iter()
        .map(|sample| (sample.passages, logarithm(sample.life_relative)));
    chart.line(points, pen(app, Role::Good, '*'));
    chart.render(theme.is_ascii(), buffer);
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
