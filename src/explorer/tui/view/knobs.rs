//! Left: the knobs as sliders.

mod speeds;

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::text::{Line, Span};

use crate::tui::action::Action;
use crate::tui::app::{App, PanelKind};
use crate::tui::dial::{Dial, DialState};
use crate::tui::theme::Role;
use crate::tui::units::{sig, tick};
use crate::tui::view::{Areas, PanelSpacing, ascii_text, inside, panel, put, put_right, title};
use asperity_engine::scene::CycleBasis;
use asperity_engine::sim::Knob;
pub(super) use speeds::{SPECIFIC, SYMBOLS};

pub(super) fn render(app: &App, areas: &Areas, buffer: &mut Buffer) {
    let theme = app.view.theme;
    let heading = title(theme, theme.pick("↑↓←→", "hjkl"), "knobs");
    let inner = panel(app, areas, PanelKind::Knobs, heading, buffer);
    for (place, dial) in app.choice.dials.iter().enumerate() {
        let slot = slot(areas, place);
        if slot.is_empty() {
            break;
        }
        name_and_value(app, place, dial, slot, buffer);
        slider(app, place, dial, track(slot), buffer);
        if slot.height >= 3 {
            range(app, dial, slot, buffer);
        }
        if slot.height >= 4 && slot.width + 4 >= WIDE {
            typical(app, dial, slot, buffer);
        }
    }
    let used = app.choice.dials.len() as u16 * rows_each(areas);
    if inner.height > used + 3 {
        let rest = Rect {
            y: inner.y + used + 1,
            height: inner.height - used - 1,
            ..inner
        };
        speeds::speeds(app, rest, buffer);
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
fn typical(app: &App, dial: &Dial, slot: Rect, buffer: &mut Buffer) {
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
        spans.push(Span::styled((n + 1).to_string(), theme.style(Role::Key)));
        spans.push(Span::styled(words, theme.style(Role::Dim)));
    }
    put(slot, 3, &Line::from(spans), buffer);
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
    let inner = Rect {
        x: frame.x + margin,
        width: frame.width.saturating_sub(2 * margin),
        ..frame
    };
    let rows = rows_each(areas);
    Rect {
        y: inner.y + place as u16 * rows,
        height: rows,
        ..inner
    }
    .intersection(inner)
}

fn track(slot: Rect) -> Rect {
    Rect {
        y: slot.y + 1,
        height: slot.height.saturating_sub(1).min(1),
        ..slot
    }
}

fn name_and_value(app: &App, place: usize, dial: &Dial, slot: Rect, buffer: &mut Buffer) {
    let theme = app.view.theme;
    let value = value_line(app, dial);
    let chosen = place == app.choice.chosen;
    let room = slot.width.saturating_sub(value.width() as u16 + 1);
    let mark = if chosen { theme.pick("▸", ">") } else { " " };
    let role = if chosen { Role::Chosen } else { Role::Text };
    let whole = dial.label.chars().count() < usize::from(room);
    let label = if whole { dial.label } else { dial.name() };
    let name = Line::from(vec![
        Span::styled(mark, theme.style(Role::Chosen)),
        Span::styled(ascii_text(theme, label), theme.style(role)),
    ]);
    put(
        Rect {
            width: room,
            ..slot
        },
        0,
        &name,
        buffer,
    );
    put_right(slot, 0, &value, buffer);
}

/// `0.30 → 0.50` on the way, `0.50` there.
fn value_line(app: &App, dial: &Dial) -> Line<'static> {
    let theme = app.view.theme;
    if let DialState::Dead(reason) = dial.life {
        return Line::styled(reason, theme.style(Role::Dim));
    }
    let unit = dial.unit(app.view.units);
    let digits = if dial.knob == Knob::SlideRoll { 2 } else { 3 };
    let target = figure(dial, unit.of(dial.target), digits);
    let mut spans = Vec::new();
    if dial.is_moving() {
        let now = figure(dial, unit.of(dial.now), digits);
        spans.push(Span::styled(
            format!("{now}{}", theme.pick("→", ">")),
            theme.style(Role::Warn),
        ));
    }
    spans.push(Span::styled(target, theme.style(Role::Strong)));
    if !unit.name.is_empty() {
        spans.push(Span::styled(
            format!(" {}", ascii_text(theme, unit.name)),
            theme.style(Role::Dim),
        ));
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

fn slider(app: &App, place: usize, dial: &Dial, track: Rect, buffer: &mut Buffer) {
    if track.is_empty() {
        return;
    }
    let theme = app.view.theme;
    let last = f64::from(track.width - 1);
    let column = |value: f64| (dial.fraction(value) * last).round() as u16;
    let (now, target) = (column(dial.now), column(dial.target));
    // S has its zero in the middle; other sliders fill from the left.
    let root = if dial.min < 0.0 { column(0.0) } else { 0 };
    let dead = dial.life != DialState::Live;
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
        paint(track, offset, symbol, theme.style(role), buffer);
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
            buffer,
        );
    }
    if now != target {
        paint(
            track,
            now,
            theme.pick("◆", "|"),
            theme.style(filled),
            buffer,
        );
    }
    paint(
        track,
        target,
        theme.pick("●", "O"),
        theme.style(Role::Strong),
        buffer,
    );
}

fn paint(
    track: Rect,
    offset: u16,
    symbol: &str,
    style: ratatui::style::Style,
    buffer: &mut Buffer,
) {
    if let Some(cell) = buffer.cell_mut((track.x + offset, track.y)) {
        cell.set_symbol(symbol).set_style(style);
    }
}

/// Range of the slider; for the load the Hertz pressure, as that is what one thinks in.
fn range(app: &App, dial: &Dial, slot: Rect, buffer: &mut Buffer) {
    let theme = app.view.theme;
    let unit = dial.unit(app.view.units);
    if dial.life != DialState::Live {
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
        put(
            slot,
            2,
            &Line::styled(text, theme.style(Role::Warn)),
            buffer,
        );
        return;
    }
    if !is_load || slot.width >= 24 {
        let ends = Line::styled(tick(unit.of(dial.min)), theme.style(Role::Dim));
        put(slot, 2, &ends, buffer);
        let end = Line::styled(tick(unit.of(dial.max)), theme.style(Role::Dim));
        put_right(slot, 2, &end, buffer);
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
        let middle = Rect {
            x: slot.x + slot.width.saturating_sub(width) / 2,
            width: width.min(slot.width),
            ..slot
        };
        put(
            middle,
            2,
            &Line::styled(text, theme.style(Role::Pressure)),
            buffer,
        );
    }
}

/// The body that stands at |S| = 2: it never crosses the contact, so none of its loading cycles ends.
pub(super) fn standing(slide_roll: f64) -> Option<u8> {
    let body = if slide_roll > 0.0 { 1 } else { 2 };
    (slide_roll.abs() >= 2.0).then_some(body)
}
