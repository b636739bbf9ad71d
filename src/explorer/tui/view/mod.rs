//! The picture: where each panel is, and the drawing of all of them.

mod areas;
mod caption;
mod centre_line;
mod chart;
mod curve;
mod digits;
mod footer;
mod forms;
mod header;
mod knobs;
mod lesson_list;
mod life;
mod map;
mod overlay;
mod point;
mod sheet;
mod status;

use ratatui::Frame;
use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect, Size};
use ratatui::style::{Color, Style};

use crate::tui::action::Action;
use crate::tui::app::{App, Overlay, PanelKind};
use crate::tui::event::{Pointer, PointerAct};
use crate::tui::pixels::{Bitmap, PixelPlot};
use crate::tui::theme::Role;
use sheet::{Sheet, with_rows};

pub use areas::{Areas, Banner, MIN_NARROW_SIZE, MIN_SIZE, PanelSpacing};

/// The panels of the screen as it is now.
fn areas_of(app: &App, screen: Rect) -> Option<Areas> {
    let areas = Areas::of(screen, banner(caption::of(app).as_ref(), screen))?;
    let areas = areas.with_picture(app.view.focus);
    let areas = if app.why().is_some() {
        areas.with_a_line()
    } else {
        areas
    };
    let areas = match app.view.enlarged {
        Some(panel) => areas.enlarged(panel),
        None => areas,
    };
    Some(match &app.view.frozen {
        Some(_) => areas.with_two_maps(),
        None => areas,
    })
}

/// Draws the whole screen.
pub fn draw(app: &App, frame: &mut Frame<'_>) {
    let screen = frame.area();
    render(app, screen, frame.buffer_mut());
}

/// Draws the whole screen into a buffer; gives the curves that it leaves to a page, which draws them as lines.
pub fn render(app: &App, screen: Rect, buffer: &mut Buffer) -> Vec<PixelPlot> {
    let theme = app.view.theme;
    let plots = draw_panels(app, screen, &mut Sheet { theme, buffer });
    if let Some(page) = theme.page() {
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

fn draw_panels(app: &App, screen: Rect, sheet: &mut Sheet<'_>) -> Vec<PixelPlot> {
    let Some(areas) = areas_of(app, screen) else {
        too_small(screen, sheet);
        return Vec::new();
    };
    let mut plots = Vec::new();
    header::render(app, areas.header, sheet);
    for panel in PanelKind::ALL {
        if areas.of_panel(panel).is_empty() {
            continue;
        }
        match panel {
            PanelKind::Knobs => knobs::render(app, &areas, sheet),
            PanelKind::Map => plots.extend(map::render(app, &areas, sheet)),
            PanelKind::CentreLine => plots.extend(centre_line::render(app, &areas, sheet)),
            PanelKind::Life => plots.extend(life::render(app, &areas, sheet).1),
            PanelKind::Point => plots.extend(point::render(app, &areas, sheet)),
        }
    }
    if let Some(frozen) = &app.view.frozen
        && !areas.frozen.is_empty()
    {
        let map = areas.frozen;
        map::render(frozen, &Areas { map, ..areas }, sheet);
    }
    status::render(app, &areas, sheet);
    if let Some(caption) = caption::of(app) {
        caption::render(app, &caption, areas.caption, sheet);
    }
    let height = screen.height - areas.status.height - 1;
    let body = with_rows(screen, screen.y + 1, height);
    match (app.fault(), app.view.overlay) {
        (Some(reason), _) => overlay::fault(app, reason, body, sheet),
        (None, Overlay::Help) => overlay::help(app, body, sheet),
        (None, Overlay::Plan) => overlay::plan(app, body, sheet),
        (None, Overlay::Scene) => forms::scene(app, body, sheet),
        (None, Overlay::Lessons) => lesson_list::lessons(app, body, sheet),
        (None, Overlay::None) => {}
    }
    if let Some(over) = status::message(app, &areas, screen, sheet) {
        plots.retain(|plot| !plot.area.intersects(over));
    }
    plots
}

/// The cells that a page's pixels fill; `None`: none, or something lies over them.
pub fn picture_area(app: &App, screen: Rect) -> Option<Rect> {
    map::room(app, &picture_areas(app, screen)?)
}

/// The picture for them, with cells of so many pixels.
pub fn picture(app: &App, screen: Rect, cell: Size) -> Option<Bitmap> {
    map::pixels(app, &picture_areas(app, screen)?, cell)
}

fn picture_areas(app: &App, screen: Rect) -> Option<Areas> {
    let areas = areas_of(app, screen)?;
    (app.is_in_pixels() && !areas.map.is_empty()).then_some(areas)
}

fn banner(caption: Option<&caption::Caption>, screen: Rect) -> Banner {
    caption.map_or(Banner::None, |caption| {
        Banner::Caption(caption.rows(screen.width))
    })
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

fn too_small(screen: Rect, sheet: &mut Sheet<'_>) {
    let text = format!(
        "{} x {} is too small: {} x {} shows the explorer, {} x {} a part of it. q quits.",
        screen.width, screen.height, MIN_SIZE.0, MIN_SIZE.1, MIN_NARROW_SIZE.0, MIN_NARROW_SIZE.1
    );
    let line = sheet.theme.line(text, Role::Warn);
    sheet.paragraph(screen, line);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panels_fill_the_screen_and_never_overlap() {
        for width in 60..=300 {
            for height in 20..=100 {
                let screen = Rect::new(0, 0, width, height);
                panels_at(screen, Banner::None);
                panels_at(screen, Banner::Caption(5));
            }
        }
        for (width, height) in [(59, 29), (60, 19), (39, 100)] {
            assert_eq!(
                Areas::of(Rect::new(0, 0, width, height), Banner::None),
                None
            );
        }
    }

    #[test]
    fn a_narrow_screen_has_one_picture_life_and_knobs() {
        for (width, height) in [(40, 30), (59, 30), (48, 44), (40, 100)] {
            for banner in [Banner::None, Banner::Caption(6)] {
                let Some(areas) = Areas::of(Rect::new(0, 0, width, height), banner) else {
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

    fn panels_at(screen: Rect, banner: Banner) {
        let Some(areas) = Areas::of(screen, banner) else {
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
