//! Factors and lives on logarithmic scales of fixed decades: bars that rescale cannot be compared.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use crate::tui::app::{App, Leading};
use crate::tui::theme::{Role, Theme};
use crate::tui::units::{sig, sig_or_dash};
use crate::tui::view::chart::{Plot, Symbol};
use crate::tui::view::panel::simulated;
use crate::tui::view::place::RowAllotment;
use crate::tui::view::place::{columns, columns_from, fitting, put, put_right};
use asperity_engine::scene::ContactKind;

/// A row of decades.
struct LogTrack {
    plot: Plot,
}

impl LogTrack {
    fn new(area: Rect, decades: [f64; 2]) -> Self {
        let (x, y) = (decades, [0.0, 1.0]);
        Self {
            plot: Plot { area, x, y },
        }
    }

    /// Column of a value from the left; what lies beyond the decades stays at their end.
    fn column(&self, value: f64) -> u16 {
        let [from, to] = self.plot.x;
        let column = self.plot.column(decade(value).clamp(from, to));
        column.map_or(0, |column| column - self.plot.area.x)
    }

    fn draw(&self, column: u16, symbol: Symbol, buffer: &mut Buffer) {
        let area = self.plot.area;
        if !area.is_empty() {
            symbol.draw((area.x + column, area.y), buffer);
        }
    }

    fn mark(&self, value: f64, symbol: Symbol, buffer: &mut Buffer) {
        self.draw(self.column(value), symbol, buffer);
    }
}

fn decade(value: f64) -> f64 {
    value.max(1e-300).log10()
}

/// The life from 1e-4 to 10, with its band, the formula's and the pinned one.
pub(super) fn scale(app: &App, rows: &mut RowAllotment, buffer: &mut Buffer) {
    let theme = app.view.theme;
    let symbol = |unicode, ascii, role| Symbol::new(theme, unicode, ascii, role);
    let track = LogTrack::new(rows.take(1), [-4.0, 1.0]);
    let rule = symbol("─", "-", Role::Border);
    (0..track.plot.area.width).for_each(|column| track.draw(column, rule, buffer));
    for power in -4..=1 {
        track.mark(10_f64.powi(power), symbol("┴", "+", Role::Border), buffer);
    }
    if let Some(life) = app.life() {
        let mut band = symbol("━", "=", Role::Good);
        let mut number = symbol("●", "O", Role::Good);
        band.style = simulated(app, band.style);
        number.style = simulated(app, number.style);
        let (low, high) = (life.life_relative_low, life.life_relative_high);
        let columns = track.column(low)..=track.column(high);
        columns.for_each(|column| track.draw(column, band, buffer));
        track.mark(life.life_relative, number, buffer);
    }
    if let Some(estimate) = app.lives.estimate.formula.life() {
        track.mark(estimate, symbol("◇", "f", Role::Formula), buffer);
    }
    if let Some(pinned) = &app.view.pinned {
        track.mark(pinned.life_relative, symbol("▼", "P", Role::Warn), buffer);
    }
    let names = rows.take(1);
    for value in [1e-4, 1e-2, 1.0] {
        let text = sig(value, 1);
        let start = track.column(value).saturating_sub(text.len() as u16 / 2);
        put(
            columns_from(names, start),
            0,
            &theme.line(text, Role::Dim),
            buffer,
        );
    }
    put_right(names, 0, &theme.line("10", Role::Dim), buffer);
}

/// The factors one under the other on one logarithmic scale: each bar begins where the one above ended, so that the
/// third ends at the life; the fourth is what the load costs beside it.
pub(super) fn mechanisms(app: &App, rows: &mut RowAllotment, buffer: &mut Buffer) {
    let theme = app.view.theme;
    let now = app.leading_factors();
    let pinned = app.view.pinned.map_or(1.0, |pinned| pinned.load_factor);
    let basis = basis(app);
    let cycles = now.and_then(|now| now.cycle).map(|cycle| cycle / basis);
    let factors = [
        ("cycles", cycles, Role::Cycles),
        ("peaks", now.map(|now| now.peak), Role::Peaks),
        ("traction", now.map(|now| now.traction), Role::Traction),
        ("load", now.map(|now| now.load / pinned), Role::Strong),
    ];
    let ghost = app
        .view
        .frozen
        .as_ref()
        .and_then(|ghost| ghost.leading_factors());
    let frozen = ghost.map(|of| {
        [
            of.cycle.map(|cycle| cycle / basis),
            Some(of.peak),
            Some(of.traction),
            Some(of.load),
        ]
    });
    let (mut from, mut frozen_end) = (1.0, 1.0);
    for (n, (name, factor, role)) in factors.into_iter().enumerate() {
        let row = rows.take(1);
        put(row, 0, &theme.line(name, role), buffer);
        let value = format!("×{}", sig_or_dash(factor, 2));
        put_right(row, 0, &theme.line(value, Role::Strong), buffer);
        let to = from * factor.unwrap_or(1.0);
        if let Some(track) = waterfall_track(row) {
            waterfall_bar(theme, &track, [from, to], role, buffer);
            if let Some(frozen) = frozen {
                frozen_end *= frozen[n].unwrap_or(1.0);
                let end = Symbol::new(theme, "┃", "|", Role::Formula);
                track.mark(frozen_end, end, buffer);
            }
        }
        from = to;
    }
    if (basis - 1.0).abs() > 1e-6 {
        unit_of_cycles(theme, basis, rows.take(1), buffer);
    }
    let turned = factors[3].1.is_some_and(|load| load.ln().abs() > 0.01);
    if rows.rest.height >= 16 || turned {
        against(app, rows.take(1), turned, buffer);
    }
}

/// The change of unit in the cycles' factor of a simulated life; a formula counts in own cycles.
fn basis(app: &App) -> f64 {
    match (app.leading(), app.life()) {
        (Leading::Simulated | Leading::Settling, Some(life)) => life.basis(),
        _ => 1.0,
    }
}

/// The change of unit, which is in the life and in no bar.
fn unit_of_cycles(theme: Theme, basis: f64, row: Rect, buffer: &mut Buffer) {
    let basis = sig(basis, 3);
    let forms = [
        format!("  and ×{basis}: cycles of the faster body"),
        format!("  ×{basis}: the faster's cycles"),
        format!("  basis ×{basis}"),
    ];
    if let Some(words) = fitting(forms.iter().map(String::as_str), usize::from(row.width)) {
        put(row, 0, &theme.line(words, Role::Dim), buffer);
    }
}

/// What the load's factor is against, and the life with it where the load is another.
fn against(app: &App, row: Rect, is_turned: bool, buffer: &mut Buffer) {
    let unit = match app.run.setup.scene.kind() {
        ContactKind::Point => app.view.units.force(),
        ContactKind::Line => app.view.units.force_per_length(),
    };
    let (whose, load) = match app.view.pinned {
        Some(pinned) => ("pinned", pinned.load_n),
        None => ("the scene's", app.run.setup.load_n),
    };
    // A load that is cut is another load.
    let load = unit.show(load, 3);
    let now = app.leading_life().zip(app.leading_factors());
    let common = now
        .map(|(life, factors)| life * factors.load)
        .filter(|_| app.view.pinned.is_none() && is_turned);
    let common = common.map_or_else(String::new, |life| format!(": life {}", sig(life, 2)));
    let forms = [
        format!("  against {whose} {load}{common}"),
        format!("  against {load}{common}"),
        format!("  against {whose} {load}"),
        format!("  of {whose} {load}"),
        format!("  against {load}"),
    ];
    if let Some(words) = fitting(forms.iter().map(String::as_str), usize::from(row.width)) {
        put(row, 0, &app.view.theme.line(words, Role::Dim), buffer);
    }
}

/// Where the bars of a row stand, between their names and values: four decades. What goes beyond them has an arrow at that
/// end. `None`: there is no room.
fn waterfall_track(row: Rect) -> Option<LogTrack> {
    let (before, after) = (9, 7);
    let area = columns(row, before, row.width.saturating_sub(before + after));
    (!area.is_empty() && area.width >= 3).then(|| LogTrack::new(area, [-4.0, 0.0]))
}

/// The ends of the decades that every bar has.
pub(super) fn waterfall_ends(theme: Theme, row: Rect, buffer: &mut Buffer) {
    let Some(track) = waterfall_track(row) else {
        return;
    };
    let (area, [low, high]) = (
        track.plot.area,
        track.plot.x.map(|end| sig(10_f64.powf(end), 1)),
    );
    if usize::from(area.width) > low.len() + high.len() {
        put(area, 0, &theme.line(low, Role::Dim), buffer);
        put_right(area, 0, &theme.line(high, Role::Dim), buffer);
    }
}

fn waterfall_bar(
    theme: Theme,
    track: &LogTrack,
    [from, to]: [f64; 2],
    role: Role,
    buffer: &mut Buffer,
) {
    let last = track.plot.area.width - 1;
    let filled = [from.min(to), from.max(to)].map(|end| track.column(end));
    // Half a cell beyond the last decade is drawn there as it is.
    let [low, high] = track.plot.x;
    let slack = 0.5 / f64::from(last) * (high - low);
    let is_below = decade(from.min(to)) < low - slack;
    let is_above = decade(from.max(to)) > high + slack;
    for column in 0..=last {
        let symbol = if column == 0 && is_below {
            Symbol::new(theme, "◂", "<", role)
        } else if column == last && is_above {
            Symbol::new(theme, "▸", ">", role)
        } else if (filled[0]..=filled[1]).contains(&column) {
            Symbol::new(theme, "█", "#", role)
        } else {
            Symbol::new(theme, "·", ".", Role::Border)
        };
        track.draw(column, symbol, buffer);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tui::theme::{Capabilities, ColorDepth, Glyphs};

    /// A bar on a track of 21 columns: five to a decade.
    fn bar(from: f64, to: f64) -> String {
        let row = Rect::new(0, 0, 37, 1);
        let mut buffer = Buffer::empty(row);
        let track = waterfall_track(row).expect("room");
        waterfall_bar(ascii(), &track, [from, to], Role::Cycles, &mut buffer);
        drawn(&buffer, row)
    }

    fn ascii() -> Theme {
        Theme::new(Capabilities {
            depth: ColorDepth::Mono,
            glyphs: Glyphs::Ascii,
        })
    }

    fn drawn(buffer: &Buffer, row: Rect) -> String {
        let cells = (0..row.width).filter_map(|x| buffer.cell((x, row.y)));
        let text: String = cells.map(ratatui::buffer::Cell::symbol).collect();
        text.trim().to_owned()
    }

    #[test]
    fn bars_keep_their_decades_and_have_arrows_beyond_them() {
        assert_eq!(bar(1.0, 1.0), "....................#");
        assert_eq!(bar(1.0, 0.1), "...............######");
        assert_eq!(
            bar(0.1, 1e-4),
            "################.....",
            "the end itself is no arrow"
        );
        assert_eq!(bar(0.1, 1e-8), "<###############.....");
        assert_eq!(bar(1e-6, 1e-8), "<....................", "all of it beyond");
        assert_eq!(bar(1.0, 30.0), "....................>");
        assert_eq!(bar(1e-5, 30.0), "<###################>");
        let nan = bar(1.0, f64::NAN);
        assert!(!nan.contains(['<', '>']), "{nan}");
    }

    #[test]
    fn the_ends_of_the_bars_are_told() {
        let row = Rect::new(0, 0, 37, 1);
        let mut buffer = Buffer::empty(row);
        waterfall_ends(ascii(), row, &mut buffer);
        assert_eq!(drawn(&buffer, row), "1e-4                1");
        waterfall_ends(ascii(), Rect::new(0, 0, 18, 1), &mut buffer);
    }

    #[test]
    fn the_scale_ends_at_its_decades() {
        let track = LogTrack::new(Rect::new(7, 0, 51, 1), [-4.0, 1.0]);
        assert_eq!(
            [0.0, 1e-4, 1.0, 10.0, 1e9].map(|life| track.column(life)),
            [0, 0, 40, 50, 50]
        );
    }
}
