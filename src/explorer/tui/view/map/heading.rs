//! What a map is of, in the frame of its panel.

use ratatui::text::Line;

use super::profile;
use crate::tui::app::{App, MapKind, PanelKind, Zoom};
use crate::tui::theme::Role;
use crate::tui::units::sig;
use crate::tui::view::areas::Areas;
use crate::tui::view::panel::title;
use crate::tui::view::place::fitting;

/// The map's name, and as many words about it as there is room for.
pub(super) fn heading(app: &App, areas: &Areas) -> Line<'static> {
    let theme = app.view.theme;
    if app.view.is_frozen {
        let slide_roll = app.frame().map_or(0.0, |frame| frame.metrics.slide_roll);
        let text = format!(" frozen: {} at S {slide_roll:.2} ", app.view.map.name());
        return theme.line(&text, Role::Formula);
    }
    let mut line = title(theme, "m", app.view.map.name());
    if app.view.map == MapKind::Profile {
        let (area, _) = profile::rooms(areas.inside(PanelKind::Map));
        let times = profile::exaggeration(app, area);
        let note = format!("y = 0, heights × {} ", sig(times, 2));
        line.push_span(theme.span(note, Role::Dim));
        return line;
    }
    let notes: &[&str] = match (app.view.map, app.view.zoom) {
        (MapKind::Stress, _) => &["x–z plane, y = 0 ", "y = 0 "],
        (MapKind::PressureWaves | MapKind::FilmWaves, _) => &[
            "y = 0, last 2a of travel, now below ",
            "y = 0, now below ",
            "now below ",
        ],
        (_, Zoom::Domain) => &["whole domain ", "domain "],
        (_, Zoom::Contact) => &[],
    };
    // As many words as there is room for, beside the key at the right.
    let room = usize::from(areas.map.width).saturating_sub(line.width() + 5);
    let note = fitting(notes.iter().copied(), room).unwrap_or_default();
    line.push_span(theme.span(note, Role::Dim));
    line
}
