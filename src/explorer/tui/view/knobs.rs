//! Left: the knobs as sliders.

mod speeds;

use ratatui::layout::{Position, Rect};
use ratatui::text::{Line, Span};

use crate::tui::action::Action;
use crate::tui::app::{App, PanelKind};
use crate::tui::dial::{Dial, DialState};
use crate::tui::theme::Role;
use crate::tui::units::{sig, tick};
use crate::tui::view::areas::{Areas, PanelSpacing};
use crate::tui::view::sheet::{Sheet, inside, panel, title, with_columns, with_rows};
use asperity_engine::scene::CycleBasis;
use asperity_engine::sim::Knob;
pub(super) use speeds::{SPECIFIC, SYMBOLS};

pub(super) fn render(app: &App, areas: &Areas, sheet: &mut Sheet<'_>) {
    let theme = app.view.theme;
    let heading = title(theme, theme.pick("↑↓←→", "hjkl"), "knobs");
    let inner = panel(app, areas, PanelKind::Knobs, heading, sheet);
    for (place, dial) in app.choice.dials.iter().enumerate() {
        let slot = slot(areas, place);
        if slot.is_empty() {
            break;
        }
        name_and_value(app, place, dial, slot, sheet);
        slider(app, place, dial, track(slot), sheet);
        if slot.height >= 3 {
            range(app, dial, slot, sheet);
        }
        if slot.height >= 4 && slot.width + 4 >= WIDE {
            typical(app, dial, slot, sheet);
        }
    }
    let used = app.choice.dials.len() as u16 * rows_each(areas);
    if inner.height > used + 3 {
        let rest = with_rows(inner, inner.y + used + 1, inner.height - used - 1);
        speeds::speeds(app, rest, sheet);
    }
}

/// The knob under a place.
pub(super) fn under(app: &App, areas: &Areas, at: Position) -> Option<usize> {
    (0..app.choice.dials.len()).find(|place| slot(areas, *place).contains(at))
}

/// A press: on the slider's row or below it moves the slider (a finger is wider than a row), on the name it chooses the
/// knob.
pub(super) fn pressed(app: &App, areas: &Areas, at: Position) -> Option<Action> {
    let place = under(app, areas, at)?;
    let track = track(slot(areas, place));
    if at.y >= track.y {
        return Some(Action::Slide(place, fraction(track, at.x)));
    }
    Some(Action::Choose(place))
}

/// A drag moves the chosen slider for as long as it stays within the panel's columns.
pub(super) fn dragged(app: &App, areas: &Areas, at: Position) -> Option<Action> {
    let inside = areas.knobs.contains(at);
    let track = track(slot(areas, app.choice.chosen));
    (inside && !track.is_empty()).then(|| Action::Slide(app.choice.chosen, fraction(track, at.x)))
}

fn fraction(track: Rect, column: u16) -> f64 {
    let last = track.width.saturating_sub(1).max(1);
    let from_left = column.saturating_sub(track.x).min(last);
    f64::from(from_left) / f64::from(last)
}

/// Columns from which typical values are named below a slider.
const WIDE: u16 = 60;

/// `3 0.10 micropitting_rig`: the digits, where they go, and what that is typical of.
fn typical(app: &App, dial: &Dial, slot: Rect, sheet: &mut Sheet<'_>) {
    let theme = app.view.theme;
    let unit = dial.unit(app.view.units);
    let mut spans = vec![Span::raw(" ")];
    let mut used = 1;
    for (n, (value, of)) in dial.typical.iter().enumerate() {
        let shown = figure(dial, unit.of(*value), 2);
        let words = if of.is_empty() {
            format!(" {shown}  ")
        } else {
            format!(" {shown} {of}  ")
        };
        used += 1 + words.chars().count();
        if used > usize::from(slot.width) {
            break;
        }
        spans.push(theme.span((n + 1).to_string(), Role::Key));
        spans.push(theme.span(words, Role::Dim));
    }
    sheet.line(slot, 3, &Line::from(spans));
}

fn rows_each(areas: &Areas) -> u16 {
    // Three rows are enough; the fourth is air, where there is plenty.
    let height = inside(areas, areas.knobs).height;
    let enlarged = areas.knobs.width >= WIDE;
    let most = if height >= 44 || enlarged { 4 } else { 3 };
    (height / 5).clamp(2, most)
}

/// The rows of a knob, inside the panel's frame.
fn slot(areas: &Areas, place: usize) -> Rect {
    let margin = match areas.density {
        PanelSpacing::Compact => 0,
        PanelSpacing::Full => 1,
    };
    let frame = inside(areas, areas.knobs);
    let inner = with_columns(
        frame,
        frame.x + margin,
        frame.width.saturating_sub(2 * margin),
    );
    let rows = rows_each(areas);
    with_rows(inner, inner.y + place as u16 * rows, rows).intersection(inner)
}

fn track(slot: Rect) -> Rect {
    with_rows(slot, slot.y + 1, slot.height.saturating_sub(1).min(1))
}

fn name_and_value(app: &App, place: usize, dial: &Dial, slot: Rect, sheet: &mut Sheet<'_>) {
    let theme = app.view.theme;
    let value = value_line(app, dial);
    let chosen = place == app.choice.chosen;
    let room = slot.width.saturating_sub(value.width() as u16 + 1);
    let mark = if chosen { theme.pick("▸", ">") } else { " " };
    let role = if chosen { Role::Chosen } else { Role::Text };
    let whole = dial.label.chars().count() < usize::from(room);
    let label = if whole { dial.label } else { dial.name() };
    let name = Line::from(vec![
        theme.span(mark, Role::Chosen),
        theme.span(label, role),
    ]);
    sheet.line(with_columns(slot, slot.x, room), 0, &name);
    sheet.line_right(slot, 0, &value);
}

/// `0.30 → 0.50` on the way, `0.50` there.
fn value_line(app: &App, dial: &Dial) -> Line<'static> {
    let theme = app.view.theme;
    if let DialState::Dead(reason) = dial.state {
        return theme.line(reason, Role::Dim);
    }
    let unit = dial.unit(app.view.units);
    let digits = if dial.knob == Knob::SlideRoll { 2 } else { 3 };
    let target = figure(dial, unit.of(dial.target), digits);
    let mut spans = Vec::new();
    if dial.is_moving() {
        let now = figure(dial, unit.of(dial.now), digits);
        spans.push(theme.span(format!("{now}{}", theme.pick("→", ">")), Role::Warn));
    }
    spans.push(theme.span(target, Role::Strong));
    if !unit.name.is_empty() {
        spans.push(theme.span(format!(" {}", theme.text(unit.name)), Role::Dim));
    }
    Line::from(spans)
}

/// S and the heights keep their two decimals, so that they do not jump about.
fn figure(dial: &Dial, value: f64, digits: i32) -> String {
    match dial.knob {
        Knob::SlideRoll => format!("{value:.2}"),
        _ => sig(value, digits),
    }
}

fn slider(app: &App, place: usize, dial: &Dial, track: Rect, sheet: &mut Sheet<'_>) {
    if track.is_empty() {
        return;
    }
    let theme = app.view.theme;
    let last = f64::from(track.width - 1);
    let column = |value: f64| (dial.fraction(value) * last).round() as u16;
    let (now, target) = (column(dial.now), column(dial.target));
    // S has its zero in the middle; other sliders fill from the left.
    let root = if dial.min < 0.0 { column(0.0) } else { 0 };
    let dead = dial.state != DialState::Live;
    let filled = if place == app.choice.chosen {
        Role::Chosen
    } else {
        Role::Film
    };
    for offset in 0..track.width {
        let within = offset >= root.min(now) && offset <= root.max(now) && !dead;
        let (symbol, role) = if within {
            (theme.pick("━", "="), filled)
        } else {
            (theme.pick("─", "-"), Role::Border)
        };
        paint(track, offset, symbol, theme.style(role), sheet);
    }
    if dead {
        return;
    }
    if root > 0 {
        paint(
            track,
            root,
            theme.pick("┼", "+"),
            theme.style(Role::Border),
            sheet,
        );
    }
    if now != target {
        paint(track, now, theme.pick("◆", "|"), theme.style(filled), sheet);
    }
    paint(
        track,
        target,
        theme.pick("●", "O"),
        theme.style(Role::Strong),
        sheet,
    );
}

fn paint(
    track: Rect,
    offset: u16,
    symbol: &str,
    style: ratatui::style::Style,
    sheet: &mut Sheet<'_>,
) {
    sheet.cell(track.x + offset, track.y, symbol, style);
}

/// Range of the slider; for the load the Hertz pressure, as that is what one thinks in.
fn range(app: &App, dial: &Dial, slot: Rect, sheet: &mut Sheet<'_>) {
    let unit = dial.unit(app.view.units);
    if dial.state != DialState::Live {
        return;
    }
    let is_load = dial.knob.is_load();
    let stands = standing(dial.target).filter(|_| dial.knob == Knob::SlideRoll);
    if let Some(body) = stands {
        let left_out = app.run.setup.scene.life.as_ref();
        let left_out = left_out.is_some_and(|life| life.cycles != CycleBasis::Damage);
        let more = if left_out && slot.width >= 28 {
            ": not in the life"
        } else {
            ""
        };
        let text = format!("body {body} stands{more}");
        sheet.text(slot, 2, text, Role::Warn);
        return;
    }
    if !is_load || slot.width >= 24 {
        sheet.text(slot, 2, tick(unit.of(dial.min)), Role::Dim);
        sheet.text_right(slot, 2, tick(unit.of(dial.max)), Role::Dim);
    }
    if is_load {
        let text = format!(
            "p_h {}",
            app.view
                .units
                .pressure()
                .show(app.lives.estimate.p_hertz_pa, 3)
        );
        let width = text.len() as u16;
        let middle = with_columns(
            slot,
            slot.x + slot.width.saturating_sub(width) / 2,
            width.min(slot.width),
        );
        sheet.text(middle, 2, text, Role::Pressure);
    }
}

/// The body that stands at |S| = 2: it never crosses the contact, so none of its loading cycles ends.
pub(super) fn standing(slide_roll: f64) -> Option<u8> {
    let body = if slide_roll > 0.0 { 1 } else { 2 };
    (slide_roll.abs() >= 2.0).then_some(body)
}
