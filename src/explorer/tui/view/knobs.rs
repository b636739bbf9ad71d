//! Left: the knobs as sliders.

pub(super) mod speeds;

use ratatui::buffer::Buffer;
use ratatui::layout::{Margin, Position, Rect};
use ratatui::text::{Line, Span};

use crate::tui::action::Action;
use crate::tui::app::{App, PanelKind};
use crate::tui::dial::{Dial, DialState};
use crate::tui::theme::Role;
use crate::tui::units::tick;
use crate::tui::view::areas::{Areas, PanelSpacing};
use crate::tui::view::chart::Symbol;
use crate::tui::view::panel::{panel, title};
use crate::tui::view::place::{
    columns, columns_from, fitting, put, put_middle, put_right, rows, rows_from,
};
use asperity_engine::scene::CycleBasis;
use asperity_engine::sim::Knob;

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
        speeds::speeds(app, rows_from(inner, used + 1), buffer);
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
    let room = columns_from(slot, 1);
    let mut line = Line::default();
    for (n, (value, of)) in dial.typical.iter().enumerate() {
        let digit = theme.span((n + 1).to_string(), Role::Key);
        let shown = dial.figure(unit.of(*value), 2);
        let of = if of.is_empty() { "" } else { &format!(" {of}") };
        let words = theme.span(format!(" {shown}{of}  "), Role::Dim);
        if line.width() + 1 + words.width() > usize::from(room.width) {
            break;
        }
        line.extend([digit, words]);
    }
    put(room, 3, &line, buffer);
}

fn rows_each(areas: &Areas) -> u16 {
    // Three rows are enough; the fourth is air, where there is plenty.
    let height = areas.inside(PanelKind::Knobs).height;
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
    let inner = areas.inside(PanelKind::Knobs).inner(Margin::new(margin, 0));
    let each = rows_each(areas);
    rows(inner, place as u16 * each, each)
}

fn track(slot: Rect) -> Rect {
    rows(slot, 1, 1)
}

fn name_and_value(app: &App, place: usize, dial: &Dial, slot: Rect, buffer: &mut Buffer) {
    let theme = app.view.theme;
    let value = value_line(app, dial);
    let chosen = place == app.choice.chosen;
    let room = slot.width.saturating_sub(value.width() as u16 + 1);
    let mark = if chosen { theme.pick("▸", ">") } else { " " };
    let role = if chosen { Role::Chosen } else { Role::Text };
    let name = fitting(
        [dial.label, dial.name()],
        usize::from(room).saturating_sub(1),
    );
    let name = Line::from(vec![
        theme.span(mark, Role::Chosen),
        theme.span(name.unwrap_or(dial.name()), role),
    ]);
    put(columns(slot, 0, room), 0, &name, buffer);
    put_right(slot, 0, &value, buffer);
}

/// `0.30 → 0.50` on the way, `0.50` there.
fn value_line(app: &App, dial: &Dial) -> Line<'static> {
    let theme = app.view.theme;
    if let DialState::Dead(reason) = dial.state {
        return theme.line(reason, Role::Dim);
    }
    let unit = dial.unit(app.view.units);
    let digits = if dial.knob == Knob::SlideRoll { 2 } else { 3 };
    let target = dial.figure(unit.of(dial.target), digits);
    let mut line = Line::default();
    if dial.is_moving() {
        let now = dial.figure(unit.of(dial.now), digits);
        let arrow = theme.pick("→", ">");
        line.push_span(Span::styled(
            format!("{now}{arrow}"),
            theme.style(Role::Warn),
        ));
    }
    line.push_span(theme.span(target, Role::Strong));
    if !unit.name.is_empty() {
        line.push_span(theme.span(format!(" {}", unit.name), Role::Dim));
    }
    line
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
    let dead = dial.state != DialState::Live;
    let filled = if place == app.choice.chosen {
        Role::Chosen
    } else {
        Role::Film
    };
    let mut paint = |column: u16, unicode, ascii, role| {
        Symbol::new(theme, unicode, ascii, role).draw((track.x + column, track.y), buffer);
    };
    for column in 0..track.width {
        if (root.min(now)..=root.max(now)).contains(&column) && !dead {
            paint(column, "━", "=", filled);
        } else {
            paint(column, "─", "-", Role::Border);
        }
    }
    if dead {
        return;
    }
    if root > 0 {
        paint(root, "┼", "+", Role::Border);
    }
    if now != target {
        paint(now, "◆", "|", filled);
    }
    paint(target, "●", "O", Role::Strong);
}

/// Range of the slider; for the load the Hertz pressure, as that is what one thinks in.
fn range(app: &App, dial: &Dial, slot: Rect, buffer: &mut Buffer) {
    let theme = app.view.theme;
    let unit = dial.unit(app.view.units);
    if dial.state != DialState::Live {
        return;
    }
    let is_load = dial.knob.is_load();
    let stands = standing(dial.target).filter(|_| dial.knob == Knob::SlideRoll);
    if let Some(body) = stands {
        let left_out = app.run.setup.scene.life.as_ref();
        let left_out = left_out.is_some_and(|life| life.cycles != CycleBasis::Damage);
        let more = match slot.width {
            28.. if left_out => ": not in the life",
            _ => "",
        };
        let text = format!("body {body} stands{more}");
        put(slot, 2, &theme.line(text, Role::Warn), buffer);
        return;
    }
    if !is_load || slot.width >= 24 {
        let [from, to] = [dial.min, dial.max].map(|end| theme.line(tick(unit.of(end)), Role::Dim));
        put(slot, 2, &from, buffer);
        put_right(slot, 2, &to, buffer);
    }
    if is_load {
        let p_hertz = app
            .view
            .units
            .pressure()
            .show(app.lives.estimate.p_hertz_pa, 3);
        let text = theme.line(format!("p_h {p_hertz}"), Role::Pressure);
        put_middle(slot, 2, &text, buffer);
    }
}

/// The body that stands at |S| = 2: it never crosses the contact, so none of its loading cycles ends.
pub(super) fn standing(slide_roll: f64) -> Option<u8> {
    let body = if slide_roll > 0.0 { 1 } else { 2 };
    (slide_roll.abs() >= 2.0).then_some(body)
}
