//! The map of lives: numbers on colours, S to the right, load or amplitude upwards.

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::style::Style;
use ratatui::text::{Line, Span};

use super::along::decades;
use crate::tui::action::Action;
use crate::tui::app::{Across, App, CurveKind, LifeMap};
use crate::tui::theme::{Role, Theme};
use crate::tui::units::sig;
use crate::tui::view::place::{columns, columns_from, put, put_middle, put_right, rows, rows_from};
use asperity_engine::sim::Dimension;
use asperity_picture::Ramp;

/// Letters on dark and on bright colours.
const WHITE: [u8; 3] = [255; 3];
const BLACK: [u8; 3] = [0; 3];
/// Columns of the times left of it, and where there is room of the loads beside them.
const TIMES: u16 = 5;
const LOADS: u16 = 13;
/// Columns in which a life and the mark of the operating point can be read.
const LEAST: u16 = 5;

/// Draws it; says where its cells are, if there is room.
pub(super) fn draw(app: &App, area: Rect, buffer: &mut Buffer) -> Option<Rect> {
    let theme = app.view.theme;
    let map = app.life_map(app.view.curve.across()?);
    heading(app, &map, area, buffer);
    let below = rows_from(area, 1);
    let fits = |axis: u16| {
        let cells = columns_from(rows(below, 0, below.height.saturating_sub(1)), axis);
        Some((axis, cells, size(&map, cells)?))
    };
    let is_roomy = area.width >= LOADS + 2 * LEAST * map.columns.len() as u16;
    let Some((axis, cells, [wide, high])) = fits(if is_roomy { LOADS } else { TIMES }) else {
        let line = theme.line("Enter on the life draws it large", Role::Dim);
        put(below, 0, &line, buffer);
        return None;
    };
    for row in 0..map.rows.len() {
        let own = rows(below, row as u16 * high, high);
        let label = theme.line(label(app, &map, row, is_roomy), Role::Dim);
        put(columns(own, 0, axis), (high - 1) / 2, &label, buffer);
    }
    let decades = decades(map.lives.iter().flatten().map(|life| life.log10()));
    for (place, life) in map.lives.iter().enumerate() {
        let at = (place / map.columns.len(), place % map.columns.len());
        let row = rows(cells, at.0 as u16 * high, high);
        let cell = columns(row, at.1 as u16 * wide, wide);
        draw_cell(theme, cell, *life, decades, map.here == at, buffer);
    }
    let foot = rows_from(below, high * map.rows.len() as u16);
    put(foot, 0, &theme.line("S", Role::Dim), buffer);
    for (column, s) in map.columns.iter().enumerate() {
        let place = columns(columns_from(foot, axis), column as u16 * wide, wide);
        // As wide as a narrow cell, a number would touch its neighbour.
        let number = format!("{s}");
        let number = if number.len() < usize::from(wide) {
            number
        } else {
            number.replace("0.", ".")
        };
        put_middle(place, 0, &theme.line(number, Role::Dim), buffer);
    }
    Some(Rect {
        width: wide * map.columns.len() as u16,
        height: high * map.rows.len() as u16,
        ..cells
    })
}

/// What a row is of.
fn label(app: &App, map: &LifeMap, row: usize, is_roomy: bool) -> String {
    let (times, load_n) = map.rows[row];
    let times = format!("{}{times}", app.view.theme.pick("×", "x"));
    match map.across {
        Across::Load if is_roomy => {
            let unit = app
                .view
                .units
                .unit(Dimension::Load, app.run.setup.scene.kind());
            format!("{times} {}", unit.show(load_n, 3))
        }
        Across::Load | Across::Amplitude => times,
    }
}

/// What a press on a cell asks for.
pub(super) fn pressed(app: &App, cells: Rect, at: Position) -> Option<Action> {
    let map = app.life_map(app.view.curve.across()?);
    let [wide, high] = size(&map, cells).filter(|_| cells.contains(at))?;
    let (row, column) = ((at.y - cells.y) / high, (at.x - cells.x) / wide);
    Some(Action::GoToCell(row.into(), column.into()))
}

/// Columns and rows of a cell; `None`: there is no room.
fn size(map: &LifeMap, cells: Rect) -> Option<[u16; 2]> {
    let wide = cells.width.checked_div(map.columns.len() as u16)?;
    let high = cells.height.checked_div(map.rows.len() as u16)?;
    (wide >= LEAST && high >= 1).then(|| [wide.min(2 * LEAST), high.min(3)])
}

fn draw_cell(
    theme: Theme,
    cell: Rect,
    life: Option<f64>,
    [low, high]: [f64; 2],
    is_here: bool,
    buffer: &mut Buffer,
) {
    let mut style = theme.style(if is_here { Role::Strong } else { Role::Text });
    if let Some(life) = life.filter(|_| theme.paints()) {
        let share = ((life.log10() - low) / (high - low)).clamp(0.0, 1.0) as f32;
        let ink = if share > 0.55 { BLACK } else { WHITE };
        style = Style::new()
            .bg(theme.map_color(Ramp::Viridis, share))
            .fg(theme.rgb(ink));
        buffer.set_style(cell, style);
    }
    let number = life.map_or_else(|| theme.pick("·", ".").to_owned(), brief);
    let mark = if is_here { theme.pick("◉", "O") } else { " " };
    let line = Line::from(Span::styled(format!("{mark}{number:>4}"), style));
    put_middle(cell, cell.height.saturating_sub(1) / 2, &line, buffer);
}

/// A life in four characters.
fn brief(life: f64) -> String {
    match life {
        100.0.. => format!("{life:.0e}"),
        0.0995.. => sig(life, 2),
        0.00995.. => format!("{life:.3}").replacen('0', "", 1),
        _ => format!("{life:.0e}"),
    }
}

/// Its name, and how far it is.
fn heading(app: &App, map: &LifeMap, area: Rect, buffer: &mut Buffer) {
    let theme = app.view.theme;
    let name = CurveKind::Map(map.across).name();
    let words = [theme.span("y ", Role::Key), theme.span(name, Role::Title)];
    put(area, 0, &Line::from(words.to_vec()), buffer);
    if app.lives.sweep.is_some() {
        let known = map.lives.iter().flatten().count();
        let text = format!("{}{known}/{}", theme.pick("↻ ", "@ "), map.lives.len());
        put_right(area, 0, &theme.line(text, Role::Warn), buffer);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_life_has_four_characters() {
        let lives = [
            0.0, 2e-12, 4.4e-3, 9.96e-3, 0.0146, 0.0996, 0.57, 9.96, 47.2, 130.0,
        ];
        let shown = lives.map(brief);
        let expected = [
            "0e0", "2e-12", "4e-3", ".010", ".015", "0.10", "0.57", "10", "47", "1e2",
        ];
        assert_eq!(shown, expected);
    }
}
