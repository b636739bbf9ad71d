//! The picture: where each panel is, and the drawing of all of them.

mod areas;
mod caption;
mod centre_line;
mod chart;
mod curve;
mod digits;
mod footer;
mod header;
mod knobs;
mod life;
mod map;
mod overlay;
mod panel;
mod place;
mod point;
mod status;

use ratatui::Frame;
use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::style::{Color, Style};
use ratatui::widgets::{Paragraph, Widget, Wrap};

use crate::tui::action::Action;
use crate::tui::app::{App, Overlay, PanelKind};
use crate::tui::event::{Pointer, PointerAct};
use crate::tui::pixels::{Bitmap, PixelPlot};
use crate::tui::theme::Role;
pub use areas::{Areas, MIN_NARROW_SCREEN, MIN_SCREEN, PanelSpacing};
pub use caption::CaptionWords;
use place::rows;

/// The panels of the screen as it is now.
fn areas_of(app: &App, screen: Rect) -> Option<Areas> {
    let caption_rows = caption_of(app).map_or(0, |caption| caption.rows(screen.width));
    let mut areas = Areas::of(screen, caption_rows)?.with_picture(app.view.focus);
    if app.why().is_some() {
        areas = areas.with_a_line();
    }
    if let Some(panel) = app.view.enlarged {
        areas = areas.enlarged(panel);
    }
    if app.view.frozen.is_some() {
        areas = areas.with_two_maps();
    }
    Some(areas)
}

/// Draws the whole screen.
pub fn draw(app: &App, frame: &mut Frame<'_>) {
    let screen = frame.area();
    render(app, screen, frame.buffer_mut());
}

/// Draws the whole screen into a buffer; gives the curves that it leaves to a page, which draws them as lines.
pub fn render(app: &App, screen: Rect, buffer: &mut Buffer) -> Vec<PixelPlot> {
    let plots = draw_panels(app, screen, buffer);
    if let Some(page) = app.view.theme.page() {
        on_page(page, screen, buffer);
    }
    plots
}

/// Gives paper and ink to all that has no colour of its own.
fn on_page(page: Style, screen: Rect, buffer: &mut Buffer) {
    for at in screen.positions() {
        let cell = &mut buffer[at];
        if let (Color::Reset, Some(paper)) = (cell.bg, page.bg) {
            cell.bg = paper;
        }
        if let (Color::Reset, Some(ink)) = (cell.fg, page.fg) {
            cell.fg = ink;
        }
    }
}

fn draw_panels(app: &App, screen: Rect, buffer: &mut Buffer) -> Vec<PixelPlot> {
    let Some(areas) = areas_of(app, screen) else {
        too_small(app, screen, buffer);
        return Vec::new();
    };
    let mut plots = Vec::new();
    header::render(app, areas.header, buffer);
    for panel in PanelKind::ALL {
        if areas.of_panel(panel).is_empty() {
            continue;
        }
        match panel {
            PanelKind::Knobs => knobs::render(app, &areas, buffer),
            PanelKind::Map => plots.extend(map::render(app, &areas, buffer)),
            PanelKind::CentreLine => plots.extend(centre_line::render(app, &areas, buffer)),
            PanelKind::Life => plots.extend(life::render(app, &areas, buffer).1),
            PanelKind::Point => plots.extend(point::render(app, &areas, buffer)),
        }
    }
    if let Some(ghost) = app
        .view
        .frozen
        .as_ref()
        .filter(|_| !areas.frozen.is_empty())
    {
        let map = areas.frozen;
        map::render(ghost, &Areas { map, ..areas }, buffer);
    }
    status::render(app, &areas, buffer);
    if let Some(caption) = caption_of(app) {
        caption::render(app, &caption, areas.caption, buffer);
    }
    let body = rows(screen, 1, screen.height - areas.status.height - 1);
    match (app.fault(), app.view.overlay) {
        (Some(reason), _) => overlay::fault(app, reason, body, buffer),
        (None, Overlay::Help) => overlay::help(app, body, buffer),
        (None, Overlay::Plan) => overlay::plan(app, body, buffer),
        (None, Overlay::Scene) => overlay::scene(app, body, buffer),
        (None, Overlay::Lessons) => overlay::lessons(app, body, buffer),
        (None, Overlay::None) => {}
    }
    if let Some(over) = status::message(app, &areas, screen, buffer) {
        plots.retain(|plot| !plot.area.intersects(over));
    }
    plots
}

/// What a lesson or the scene says now, for a page that writes it itself; `None`: nothing.
pub fn caption_words(app: &App) -> Option<CaptionWords> {
    caption::in_words(app)
}

/// The caption, where it is the screen's to write.
fn caption_of(app: &App) -> Option<caption::Caption> {
    caption::of(app).filter(|_| !app.is_page())
}

/// The cells that the terminal's own pixels fill; `None`: none, or something lies over them.
pub fn picture_area(app: &App, screen: Rect) -> Option<Rect> {
    map::room(app, &picture_areas(app, screen)?)
}

/// The picture for them, with cells of so many pixels.
pub fn picture(app: &App, screen: Rect, cell: (u16, u16)) -> Option<Bitmap> {
    map::pixels(app, &picture_areas(app, screen)?, cell)
}

fn picture_areas(app: &App, screen: Rect) -> Option<Areas> {
    let areas = areas_of(app, screen)?;
    (app.is_in_pixels() && !areas.map.is_empty()).then_some(areas)
}

/// What the pointer asks for on a screen of that size.
pub fn pointed(app: &App, screen: Rect, pointer: Pointer) -> Option<Action> {
    let areas = areas_of(app, screen)?;
    let at = Position::new(pointer.column, pointer.row);
    if app.view.overlay != Overlay::None {
        let closes = matches!(pointer.act, PointerAct::Press | PointerAct::SecondPress);
        return closes.then_some(Action::Close);
    }
    match pointer.act {
        PointerAct::Press => footer::pressed(app, &areas, at)
            .or_else(|| caption::pressed(app, &areas, at))
            .or_else(|| knobs::pressed(app, &areas, at))
            .or_else(|| life::pressed(app, &areas, screen, at))
            .or_else(|| map::pressed(app, &areas, at))
            .or_else(|| point::pressed(&areas, at))
            .or_else(|| areas.panel_at(at).map(Action::Focus)),
        PointerAct::Drag => knobs::dragged(app, &areas, at)
            .or_else(|| map::pressed(app, &areas, at))
            .or_else(|| point::dragged(&areas, at)),
        PointerAct::SecondPress => Some(Action::Close),
        PointerAct::WheelUp => wheel(app, &areas, at, 1),
        PointerAct::WheelDown => wheel(app, &areas, at, -1),
    }
}

/// The wheel turns the knob under the mouse (choosing it first), and changes the map.
fn wheel(app: &App, areas: &Areas, at: Position, by: i32) -> Option<Action> {
    if areas.map.contains(at) {
        return Some(if by > 0 {
            Action::NextMap
        } else {
            Action::PreviousMap
        });
    }
    let place = knobs::under(app, areas, at)?;
    Some(if place == app.choice.chosen {
        Action::Turn(by)
    } else {
        Action::Choose(place)
    })
}

fn too_small(app: &App, screen: Rect, buffer: &mut Buffer) {
    let text = format!(
        "{} x {} is too small: {} x {} shows the explorer, {} x {} a part of it. q quits.",
        screen.width,
        screen.height,
        MIN_SCREEN.0,
        MIN_SCREEN.1,
        MIN_NARROW_SCREEN.0,
        MIN_NARROW_SCREEN.1
    );
    Paragraph::new(text)
        .style(app.view.theme.style(Role::Warn))
        .wrap(Wrap { trim: true })
        .render(screen, buffer);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panels_fill_the_screen_and_never_overlap() {
        for width in (60..=300).step_by(7) {
            for height in 20..=100 {
                let screen = Rect::new(0, 0, width, height);
                panels_at(screen, 0);
                panels_at(screen, 5);
            }
        }
        for (width, height) in [(59, 29), (60, 19), (39, 100)] {
            assert_eq!(Areas::of(Rect::new(0, 0, width, height), 0), None);
        }
    }

    #[test]
    fn a_narrow_screen_has_one_picture_life_and_knobs() {
        for (width, height) in [(40, 30), (59, 30), (48, 44), (40, 100)] {
            for caption_rows in [0, 6] {
                let Some(areas) = Areas::of(Rect::new(0, 0, width, height), caption_rows) else {
                    panic!("{width} x {height} is large enough")
                };
                for picture in [PanelKind::Map, PanelKind::CentreLine, PanelKind::Point] {
                    let areas = areas.with_picture(picture);
                    let mut next = areas.caption.bottom();
                    for panel in [
                        areas.of_panel(picture),
                        areas.life,
                        areas.knobs,
                        areas.status,
                    ] {
                        assert_eq!((panel.y, panel.width), (next, width));
                        assert!(panel.height >= 3, "{width} x {height}: {panel}");
                        next = panel.bottom();
                    }
                    assert_eq!(next, height);
                    let drawn = PanelKind::ALL
                        .iter()
                        .filter(|kind| !areas.of_panel(**kind).is_empty());
                    assert_eq!(drawn.count(), 3);
                }
            }
        }
    }

    fn panels_at(screen: Rect, caption_rows: u16) {
        let Some(areas) = Areas::of(screen, caption_rows) else {
            panic!("{screen} is large enough")
        };
        let all = [
            areas.header,
            areas.knobs,
            areas.map,
            areas.centre_line,
            areas.life,
            areas.point,
            areas.status,
        ];
        for (i, one) in all.iter().enumerate() {
            assert!(one.width > 0 && one.height > 0, "{screen}: {i}");
            assert_eq!(one.intersection(screen), *one);
            assert!(one.intersection(areas.caption).is_empty(), "{screen}: {i}");
            for other in &all[..i] {
                assert!(one.intersection(*other).is_empty(), "{screen}: {i}");
            }
        }
        assert_eq!(areas.status.bottom(), screen.height);
    }
}
