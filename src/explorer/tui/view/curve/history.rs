//! The estimate over the passages seen: one curve, the present on the right.

use ratatui::layout::Rect;
use ratatui::text::Line;

use super::pen;
use crate::tui::app::App;
use crate::tui::pixels::PixelPlot;
use crate::tui::theme::Role;
use crate::tui::view::chart::{CurvePanel, PlotFrame};
use crate::tui::view::sheet::{Sheet, below};

/// Half of the minimum range, decades: noise stays small.
const MIN_HALF_RANGE: f64 = 0.17;

pub(super) fn render(app: &App, area: Rect, sheet: &mut Sheet<'_>) -> Option<PixelPlot> {
    let theme = app.view.theme;
    let (Some(first), Some(last)) = (app.lives.history.front(), app.lives.history.back()) else {
        return None;
    };
    let plot = below(area, 1);
    let span = last.passages - first.passages;
    let words = match area.width {
        27.. => format!("{span:.1} passages of 4a"),
        _ => format!("{span:.1} passages"),
    };
    let words = theme.text(&words);
    let heading = Line::from(vec![
        theme.span("history ", Role::Title),
        theme.span(words, Role::Dim),
    ]);
    sheet.line(area, 0, &heading);
    if span <= 0.0 || plot.is_empty() {
        return None;
    }
    let samples = app.lives.history.iter();
    let points = samples.map(|sample| (sample.passages, sample.life_relative.log10()));
    let (low, high) = points
        .clone()
        .fold((f64::MAX, f64::MIN), |(low, high), (_, decade)| {
            (low.min(decade), high.max(decade))
        });
    let middle = 0.5 * (low + high);
    let half = (0.55 * (high - low)).max(MIN_HALF_RANGE);
    let plot = PlotFrame {
        area: plot,
        x: [first.passages, last.passages],
        y: [middle - half, middle + half],
    };
    let mut chart = CurvePanel::of(app, plot);
    chart.line(points, pen(app, Role::Good, '*'));
    chart.render(sheet)
}
