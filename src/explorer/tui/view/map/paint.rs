//! From values to colours or characters, and the bar that says which is which.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Style};
use ratatui::text::{Line, Span};

use super::raster::{MapWindow, Raster};
use crate::tui::app::{App, MapKind};
use crate::tui::pixels::Bitmap;
use crate::tui::theme::{Role, Theme};
use crate::tui::units::tick;
use crate::tui::view::chart::Symbol;
use crate::tui::view::place::{columns, columns_from, put};
use asperity_engine::math::number::KELVIN;
use asperity_picture::interferogram::colour as fringe;
use asperity_picture::{AboveRange, CONTACT, Look, Palette, Tint};

/// What the map shows and how, in the units of the screen.
pub(super) fn look(app: &App) -> Look {
    let unit = match app.view.map {
        MapKind::Film | MapKind::Fringes | MapKind::FilmWaves => app.view.units.film(),
        MapKind::Roughness => app.view.units.height(),
        MapKind::Temperature => KELVIN,
        MapKind::Pressure
        | MapKind::Contact
        | MapKind::Stress
        | MapKind::PressureWaves
        | MapKind::Profile => app.view.units.pressure(),
    };
    Look::of(app.view.map.subject(), &app.ranges()).in_unit(unit)
}

/// A map with its colours.
pub(super) struct MapPainter<'a> {
    pub(super) kind: MapKind,
    pub(super) look: &'a Look,
    pub(super) window: &'a MapWindow,
    pub(super) raster: &'a Raster,
}

impl MapPainter<'_> {
    /// Paints it in the terminal's colours, two pixels a cell, or in characters of growing ink.
    pub(super) fn paint(&self, theme: Theme, image: Rect, buffer: &mut Buffer) {
        if theme.paints() {
            half_blocks(image, buffer, |column, row| self.color(theme, column, row));
        } else {
            letters(image, buffer, |column, row| self.ink(column, row));
        }
    }

    /// Red, green, blue and opacity of a pixel.
    pub(super) fn rgba(&self, column: usize, row: usize) -> [u8; 4] {
        let rgb = self.rgb(column, row);
        rgb.map_or([0; 4], |[r, g, b]| [r, g, b, 255])
    }

    fn color(&self, theme: Theme, column: usize, row: usize) -> Color {
        match self.tint(column, row) {
            tint @ Tint::Share(_) if !self.is_lit(column, row) => color(theme, self.look, tint),
            Tint::Blank | Tint::Plain(_) | Tint::Share(_) => self
                .rgb(column, row)
                .map_or(Color::Reset, |rgb| theme.rgb(rgb)),
        }
    }

    fn rgb(&self, column: usize, row: usize) -> Option<[u8; 3]> {
        /// Part of white in a line over a map.
        const WHITE: f32 = 0.35;
        let lit = |c: u8| (f32::from(c) + (255.0 - f32::from(c)) * WHITE) as u8;
        let rgb = self.look.paint(self.tint(column, row))?;
        Some(if self.is_lit(column, row) {
            rgb.map(lit)
        } else {
            rgb
        })
    }

    fn tint(&self, column: usize, row: usize) -> Tint {
        let value = f64::from(self.raster.at(column, row));
        match self.look.tint(value, self.raster.spot(column, row)) {
            Tint::Plain(_) if self.look.palette == Palette::Fringes => {
                Tint::Plain(self.raster.fringe(column, row))
            }
            tint => tint,
        }
    }

    /// Whether a line lies over a pixel.
    fn is_lit(&self, column: usize, row: usize) -> bool {
        !matches!(self.kind, MapKind::Fringes | MapKind::Contact) && self.is_edge(column, row)
    }

    /// Whether the edge of Hertz's contact passes through a pixel of the plane.
    fn is_edge(&self, column: usize, row: usize) -> bool {
        let Self { window, raster, .. } = self;
        let x = window.x_at((column as f64 + 0.5) / raster.columns as f64);
        let y = window.y_at((row as f64 + 0.5) / raster.rows as f64);
        let pixel = (window.x[1] - window.x[0]) / raster.columns as f64;
        self.kind.is_plane() && (raster.distance(x, y) - 1.0).abs() < 0.5 * pixel
    }

    fn ink(&self, column: usize, row: usize) -> &'static str {
        let share = self.look.share(f64::from(self.raster.at(column, row)));
        if share.is_nan() {
            return " ";
        }
        match self.kind {
            MapKind::Contact if self.raster.spot(column, row) => "#",
            MapKind::Contact if self.is_edge(column, row) => "o",
            MapKind::Contact => Theme::map_ink(0.3 * share),
            MapKind::Fringes => fringe_ink(self.raster.fringe(column, row)),
            MapKind::Pressure
            | MapKind::Film
            | MapKind::Roughness
            | MapKind::Temperature
            | MapKind::Stress
            | MapKind::PressureWaves
            | MapKind::FilmWaves
            | MapKind::Profile => Theme::map_ink(inked(self.look, share)),
        }
    }
}

/// A tint in the terminal's colours.
fn color(theme: Theme, look: &Look, tint: Tint) -> Color {
    match tint {
        Tint::Share(share) => theme.map_color(look.ramp(), share),
        tint => look.paint(tint).map_or(Color::Reset, |rgb| theme.rgb(rgb)),
    }
}

/// An interferogram's green stands for its brightness.
fn fringe_ink([_, green, _]: [u8; 3]) -> &'static str {
    Theme::map_ink(f32::from(green) / 255.0)
}

/// Ink of a share: thin film has most, so that where it collapses it stands out from the bath, which has none.
fn inked(look: &Look, share: f32) -> f32 {
    if look.above == AboveRange::Dark {
        1.0 - share
    } else {
        share
    }
}

/// Writes a character a cell, by its column and row.
pub(super) fn letters(
    area: Rect,
    buffer: &mut Buffer,
    letter: impl Fn(usize, usize) -> &'static str,
) {
    for at in area.positions() {
        let (column, row) = (usize::from(at.x - area.x), usize::from(at.y - area.y));
        if let Some(cell) = buffer.cell_mut(at) {
            cell.set_symbol(letter(column, row));
        }
    }
}

/// A mark at parts of a picture along and down.
pub(super) fn mark(
    theme: Theme,
    image: Rect,
    part: [f64; 2],
    symbol: &'static str,
    buffer: &mut Buffer,
) {
    let cells = |part: f64, cells: u16| (part * f64::from(cells)) as u16;
    let at = (
        image.x + cells(part[0], image.width),
        image.y + cells(part[1], image.height),
    );
    let mut mark = Symbol::new(theme, symbol, "X", Role::Strong);
    if theme.paints() {
        mark.style = Style::new().fg(theme.rgb([255, 255, 255]));
    }
    mark.draw(at, buffer);
}

/// A mark on a picture, white on black.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum MapMark {
    /// The material point.
    Diamond,
    /// The probe.
    Cross,
}

impl MapMark {
    /// Draws it at parts of the picture along and down, with so many pixels to each side.
    pub(super) fn draw(self, picture: &mut Bitmap, [along, down]: [f64; 2], half: f64) {
        /// How far the black around it goes.
        const EDGE: f64 = 1.35;
        let middle = [along * picture.width as f64, down * picture.height as f64].map(f64::floor);
        for row in 0..picture.height {
            for column in 0..picture.width {
                let (dx, dy) = (column as f64 - middle[0], row as f64 - middle[1]);
                let away = match self {
                    Self::Diamond => dx.abs() + dy.abs(),
                    Self::Cross => dx.abs().max(dy.abs()) + 2.0 * dx.abs().min(dy.abs()),
                };
                if away <= EDGE * half {
                    let ink = if away <= half { 255 } else { 0 };
                    let place = 4 * (row * picture.width + column);
                    picture.rgba[place..place + 4].copy_from_slice(&[ink, ink, ink, 255]);
                }
            }
        }
    }
}

/// Paints two pixels a cell, by their column and row.
pub(super) fn half_blocks(area: Rect, buffer: &mut Buffer, pixel: impl Fn(usize, usize) -> Color) {
    for at in area.positions() {
        let (column, row) = (usize::from(at.x - area.x), usize::from(at.y - area.y));
        let (upper, lower) = (pixel(column, 2 * row), pixel(column, 2 * row + 1));
        // A blank upper half would be painted in the colour of letters.
        let (symbol, ink, back) = match (upper, lower) {
            (Color::Reset, Color::Reset) => (" ", upper, lower),
            (Color::Reset, _) => ("▄", lower, upper),
            _ => ("▀", upper, lower),
        };
        if let Some(cell) = buffer.cell_mut(at) {
            cell.set_symbol(symbol).set_fg(ink).set_bg(back);
        }
    }
}

/// The bar that says which colour is which value.
pub(super) fn color_bar(theme: Theme, look: &Look, kind: MapKind, bar: Rect, buffer: &mut Buffer) {
    if bar.width < 4 || bar.height < 3 {
        return;
    }
    let last = f64::from(2 * bar.height - 1);
    let [low, high] = look.range;
    let value = |row: usize| high - (high - low) * row as f64 / last;
    let strip = columns(bar, 1, 1);
    if theme.paints() {
        half_blocks(strip, buffer, |_, row| {
            // Its upper edge has the colour of what is above.
            let above = f64::from(u8::from(row == 0)) * 1e-6 * (high - low);
            color(theme, look, look.tint(value(row) + above, false))
        });
    } else {
        letters(strip, buffer, |_, row| {
            let value = value(2 * row);
            if kind == MapKind::Fringes {
                fringe_ink(fringe(value as f32, 0.0))
            } else {
                Theme::map_ink(inked(look, look.share(value)))
            }
        });
    }
    let text = columns_from(bar, 3);
    let number = |value: f64| theme.line(number(look, value, text.width), Role::Dim);
    put(text, 0, &number(high), buffer);
    put(text, 1, &theme.line(look.unit.name, Role::Dim), buffer);
    if bar.height >= 7 {
        put(text, bar.height / 2, &number(0.5 * (low + high)), buffer);
    }
    put(text, bar.height - 1, &number(low), buffer);
    if kind == MapKind::Contact && bar.height >= 9 {
        let contact = Style::new().fg(theme.rgb(CONTACT));
        let spot = Span::styled(theme.pick("█", "#"), contact);
        let line = Line::from(vec![spot, theme.span("spot", Role::Dim)]);
        put(text, bar.height - 3, &line, buffer);
    }
}

/// A number of the legend, which says what of the range's ends holds beyond, where there is room.
fn number(look: &Look, value: f64, room: u16) -> String {
    let text = if look.above == AboveRange::Dark && value == look.range[1] {
        format!(">{}", tick(look.unit.of(value)))
    } else {
        look.number(value)
    };
    if text.chars().count() <= usize::from(room) {
        text
    } else {
        tick(look.unit.of(value))
    }
}
