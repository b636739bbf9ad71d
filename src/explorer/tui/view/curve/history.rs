//! The estimate over the passages seen: one curve, the present on the right.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::pen;
use crate::tui::app::App;
use crate::tui::pixels::PixelPlot;
use crate::tui::theme::Role;
use crate::tui::view::chart::CurvePanel;
use crate::tui::view::{ascii_text, put};

/// Half of the least range, decades: noise stays small.
const LEAST: f64 = 0.17;

pub(super) fn render(app: &App, area: Rect, buffer: &mut Buffer) -> Option<PixelPlot> {
    let theme = app.view.theme;
    let (Some(first), Some(last)) = (app.lives.history.front(), app.lives.history.back()) else {
        return None;
    };
    let plot = Rect {
        y: area.y + 1,
        height: area.height.saturating_sub(1),
        ..area
    };
    let span = last.passages - first.passages;
    let words = match area.width {
        27.. => format!("{span:.1} passages of 4a"),
        _ => format!("{span:.1} passages"),
    };
    let words = ascii_text(theme, &words);
    let heading = Line::from(vec![
        Span::styled("history ", theme.style(Role::Title)),
        Span::styled(words, theme.style(Role::Dim)),
    ]);
    put(area, 0, &heading, buffer);
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
    let half = (0.55 * (high - low)).max(LEAST);
    let passages = [first.passages, last.passages];
    let mut chart = CurvePanel::of(app, plot, passages, [middle - half, middle + half]);
    chart.line(points, pen(app, Role::Good, '*'));
    chart.render(theme.is_ascii(), buffer)
}
