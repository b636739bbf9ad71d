//! The mechanisms that make the life, as a waterfall of factors.

use ratatui::layout::Rect;

use super::RowAllotment;
use crate::tui::app::App;
use crate::tui::theme::Role;
use crate::tui::units::sig_or_dash;
use crate::tui::view::sheet::{Sheet, with_columns};
use asperity_engine::math::number::sig;
use asperity_engine::scene::ContactKind;

/// The factors one under the other on one logarithmic scale: each bar begins where the one above ended, so that the
/// third ends at the life; the fourth is what the load costs beside it.
pub(super) fn mechanisms(app: &App, rows: &mut RowAllotment, sheet: &mut Sheet<'_>) {
    let now = app.leading_factors();
    let pinned = app.view.pinned.map_or(1.0, |pinned| pinned.load_factor);
    let factors = [
        ("cycles", now.and_then(|now| now.cycle), Role::Cycles),
        ("peaks", now.map(|now| now.peak), Role::Peaks),
        ("traction", now.map(|now| now.traction), Role::Traction),
        ("load", now.map(|now| now.load / pinned), Role::Strong),
    ];
    let frozen = app.view.frozen.as_ref();
    let frozen = frozen.and_then(|frozen| frozen.leading_factors());
    let frozen = |n: usize| {
        let of = frozen?;
        let row = [of.cycle, Some(of.peak), Some(of.traction), Some(of.load)];
        let row = row.into_iter().take(n + 1);
        Some(row.map(|factor| factor.unwrap_or(1.0)).product::<f64>())
    };
    let mut from = 1.0;
    for (n, (name, factor, role)) in factors.into_iter().enumerate() {
        let row = rows.take(1);
        let to = from * factor.unwrap_or(1.0);
        sheet.text(row, 0, name, role);
        let value = format!("×{}", sig_or_dash(factor, 2));
        sheet.text_right(row, 0, value, Role::Strong);
        waterfall_bar(row, [from, to], role, sheet);
        if let Some(end) = frozen(n) {
            waterfall_mark(row, end, sheet);
        }
        from = to;
    }
    let turned = factors[3].1.is_some_and(|load| load.ln().abs() > 0.01);
    if rows.rest().height >= 16 || turned {
        against(app, rows.take(1), sheet);
    }
}

/// What the load's factor is against.
fn against(app: &App, row: Rect, sheet: &mut Sheet<'_>) {
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
    let forms = [
        format!("  against {whose} {load}"),
        format!("  of {whose} {load}"),
        format!("  against {load}"),
    ];
    let fits = |words: &&String| words.chars().count() <= usize::from(row.width);
    let Some(words) = forms.iter().find(fits) else {
        return;
    };
    sheet.text(row, 0, words, Role::Dim);
}

/// Decades of every bar: bars that rescale cannot be compared. What goes beyond them has an arrow at that end.
const DECADES: [f64; 2] = [-4.0, 0.0];

/// Where the bars of a row stand, between their names and values; `None`: there is no room.
fn track(row: Rect) -> Option<Rect> {
    let (before, after) = (9, 7);
    (!row.is_empty() && row.width >= before + after + 3)
        .then(|| with_columns(row, row.x + before, row.width - before - after))
}

/// The ends of the decades that every bar has.
pub(super) fn scale(row: Rect, sheet: &mut Sheet<'_>) {
    let Some(track) = track(row) else { return };
    let [min, max] = DECADES.map(|decade| sig(10_f64.powf(decade), 1));
    if usize::from(track.width) <= min.len() + max.len() {
        return;
    }
    sheet.text(track, 0, min, Role::Dim);
    sheet.text_right(track, 0, max, Role::Dim);
}

/// Where on a track a factor is: 0 to 1 over the decades, less or more beyond them.
fn part(value: f64) -> f64 {
    (value.max(1e-300).log10() - DECADES[0]) / (DECADES[1] - DECADES[0])
}

/// The column of a track in which a factor is.
fn column(value: f64, track: Rect) -> u16 {
    (part(value).clamp(0.0, 1.0) * f64::from(track.width - 1)).round() as u16
}

fn waterfall_bar(row: Rect, [from, to]: [f64; 2], role: Role, sheet: &mut Sheet<'_>) {
    let Some(track) = track(row) else { return };
    let theme = sheet.theme;
    let last = track.width - 1;
    let (a, b) = (column(from, track), column(to, track));
    // Half a cell beyond the last decade is drawn there as it is.
    let slack = 0.5 / f64::from(last);
    let (min, max) = (part(from.min(to)), part(from.max(to)));
    for offset in 0..track.width {
        let (symbol, role) = if offset == 0 && min < -slack {
            (theme.pick("◂", "<"), role)
        } else if offset == last && max > 1.0 + slack {
            (theme.pick("▸", ">"), role)
        } else if offset >= a.min(b) && offset <= a.max(b) {
            (theme.pick("█", "#"), role)
        } else {
            (theme.pick("·", "."), Role::Border)
        };
        sheet.cell(track.x + offset, track.y, symbol, theme.style(role));
    }
}

/// Where the frozen bar ended.
fn waterfall_mark(row: Rect, end: f64, sheet: &mut Sheet<'_>) {
    let Some(track) = track(row) else { return };
    let symbol = sheet.theme.pick("┃", "|");
    let style = sheet.theme.style(Role::Formula);
    sheet.cell(track.x + column(end, track), track.y, symbol, style);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tui::theme::{Capabilities, ColorDepth, Glyphs, Theme};
    use ratatui::buffer::Buffer;

    /// A bar on a track of 21 columns: five to a decade.
    fn bar(from: f64, to: f64) -> String {
        drawn(|row, sheet| waterfall_bar(row, [from, to], Role::Cycles, sheet))
    }

    fn ascii() -> Theme {
        Theme::new(Capabilities {
            depth: ColorDepth::Mono,
            glyphs: Glyphs::Ascii,
        })
    }

    /// What stands on a row of 37 columns.
    fn drawn(draw: impl Fn(Rect, &mut Sheet<'_>)) -> String {
        let row = Rect::new(0, 0, 37, 1);
        let mut buffer = Buffer::empty(row);
        let theme = ascii();
        draw(
            row,
            &mut Sheet {
                theme,
                buffer: &mut buffer,
            },
        );
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
        let ends = drawn(|row, sheet| scale(row, sheet));
        assert_eq!(ends, "1e-4                1");
        let narrow = Rect::new(0, 0, 18, 1);
        drawn(|_, sheet| scale(narrow, sheet));
    }
}
