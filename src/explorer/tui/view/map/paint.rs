//! From values to colours or characters, and the bar that says which is which.

use ratatui::layout::Rect;
use ratatui::style::{Color, Style};
use ratatui::text::{Line, Span};

use super::raster::{MapWindow, Raster};
use crate::tui::app::{App, MapKind};
use crate::tui::pixels::Bitmap;
use crate::tui::theme::{Role, Theme};
use crate::tui::units::tick;
use crate::tui::view::sheet::{Sheet, with_columns};
use asperity_picture::interferogram::colour as fringe;
use asperity_picture::{AboveRange, CONTACT, Look, Palette, Tint};

/// Part of white in a line over a map.
const WHITE: f32 = 0.35;

/// What the map shows and how, in the units of the screen.
pub(super) fn look(app: &App) -> Look {
    let unit = match app.view.map {
        MapKind::Film | MapKind::Fringes | MapKind::FilmWaves => app.view.units.film(),
        MapKind::Roughness => app.view.units.height(),
        MapKind::Pressure
        | MapKind::Contact
        | MapKind::Stress
        | MapKind::PressureWaves
        | MapKind::Profile => app.view.units.pressure(),
    };
    Look::of(app.view.map.subject(), &app.ranges()).in_unit(unit)
}

/// A pixel, and whether a line lies over it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pixel {
    tint: Tint,
    is_lit: bool,
}

impl Pixel {
    pub(super) fn of(
        look: &Look,
        raster: &Raster,
        window: &MapWindow,
        kind: MapKind,
        column: usize,
        row: usize,
    ) -> Self {
        let value = f64::from(raster.at(column, row));
        let has_ring = kind.is_plane() && !matches!(kind, MapKind::Fringes | MapKind::Contact);
        Self {
            tint: match look.tint(value, raster.spot(column, row)) {
                Tint::Plain(_) if look.palette == Palette::Fringes => {
                    Tint::Plain(raster.fringe(column, row))
                }
                tint => tint,
            },
            is_lit: has_ring && on_ellipse(window, raster, column, row),
        }
    }

    /// In the terminal's colours.
    fn color(self, theme: Theme, look: &Look) -> Color {
        match self.tint {
            Tint::Share(share) if !self.is_lit => theme.map_color(look.ramp(), share),
            _ => self.rgb(look).map_or(Color::Reset, |rgb| theme.rgb(rgb)),
        }
    }

    fn rgb(self, look: &Look) -> Option<[u8; 3]> {
        let lit = |c: u8| (f32::from(c) + (255.0 - f32::from(c)) * WHITE) as u8;
        let rgb = look.paint(self.tint)?;
        Some(if self.is_lit { rgb.map(lit) } else { rgb })
    }

    /// Red, green, blue and opacity.
    pub(super) fn rgba(self, look: &Look) -> [u8; 4] {
        self.rgb(look).map_or([0; 4], |[r, g, b]| [r, g, b, 255])
    }
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
    /// Draws it at a part (0 to 1 along and down) of a picture, with so many pixels to each side.
    pub(super) fn draw(self, picture: &mut Bitmap, part: [f64; 2], half: f64) {
        /// How far the black around it goes.
        const EDGE: f64 = 1.35;
        let [along, down] = part;
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

pub(super) fn paint(
    raster: &Raster,
    look: &Look,
    window: &MapWindow,
    kind: MapKind,
    image: Rect,
    sheet: &mut Sheet<'_>,
) {
    let theme = sheet.theme;
    let pixel = |column: usize, row: usize| {
        Pixel::of(look, raster, window, kind, column, row).color(theme, look)
    };
    for row in 0..usize::from(image.height) {
        for column in 0..usize::from(image.width) {
            let at = (image.x + column as u16, image.y + row as u16);
            let Some(cell) = sheet.buffer.cell_mut(at) else {
                continue;
            };
            if theme.paints() {
                let (upper, lower) = (pixel(column, 2 * row), pixel(column, 2 * row + 1));
                // A blank upper half would be painted in the colour of letters.
                let symbol = if upper == Color::Reset { "▄" } else { "▀" };
                let (ink, back) = if upper == Color::Reset {
                    (lower, upper)
                } else {
                    (upper, lower)
                };
                cell.set_symbol(if ink == Color::Reset { " " } else { symbol })
                    .set_fg(ink)
                    .set_bg(back);
            } else {
                let ring = kind.is_plane() && on_ellipse(window, raster, column, row);
                cell.set_symbol(ink(look, raster, kind, ring, column, row));
            }
        }
    }
}

fn ink(
    look: &Look,
    raster: &Raster,
    kind: MapKind,
    ring: bool,
    column: usize,
    row: usize,
) -> &'static str {
    let share = look.share(f64::from(raster.at(column, row)));
    if share.is_nan() {
        return " ";
    }
    match kind {
        MapKind::Contact if raster.spot(column, row) => "#",
        MapKind::Contact if ring => "o",
        MapKind::Contact => Theme::map_ink(0.3 * share),
        MapKind::Fringes => {
            let [_, green, _] = raster.fringe(column, row);
            Theme::map_ink(f32::from(green) / 255.0)
        }
        _ => Theme::map_ink(inked(look, share)),
    }
}

/// Ink of a share: thin film has most, so that where it collapses it stands out from the bath, which has none.
fn inked(look: &Look, share: f32) -> f32 {
    if look.above == AboveRange::Dark {
        1.0 - share
    } else {
        share
    }
}

/// Whether the edge of Hertz's contact passes through a pixel.
fn on_ellipse(window: &MapWindow, raster: &Raster, column: usize, row: usize) -> bool {
    let x = window.x_at((column as f64 + 0.5) / raster.columns as f64);
    let y = window.y_at((row as f64 + 0.5) / raster.rows as f64);
    let pixel = (window.x[1] - window.x[0]) / raster.columns as f64;
    (raster.distance(x, y) - 1.0).abs() < 0.5 * pixel
}

pub(super) fn color_bar(look: &Look, kind: MapKind, bar: Rect, sheet: &mut Sheet<'_>) {
    let theme = sheet.theme;
    if bar.width < 4 || bar.height < 3 {
        return;
    }
    let pixels = f64::from(2 * bar.height - 1);
    let [low, high] = look.range;
    for row in 0..bar.height {
        let value = |half: u16| high - (high - low) * f64::from(2 * row + half) / pixels;
        // Its upper edge has the colour of what is above.
        let above = |half: u16| f64::from(u8::from(row + half == 0)) * 1e-6 * (high - low);
        let color = |half: u16| {
            let pixel = Pixel {
                tint: look.tint(value(half) + above(half), false),
                is_lit: false,
            };
            pixel.color(theme, look)
        };
        if let Some(cell) = sheet.buffer.cell_mut((bar.x + 1, bar.y + row)) {
            if theme.paints() {
                cell.set_symbol("▀").set_fg(color(0)).set_bg(color(1));
            } else if kind == MapKind::Fringes {
                let [_, green, _] = fringe(value(0) as f32, 0.0);
                cell.set_symbol(Theme::map_ink(f32::from(green) / 255.0));
            } else {
                cell.set_symbol(Theme::map_ink(inked(look, look.share(value(0)))));
            }
        }
    }
    let text = with_columns(bar, bar.x + 3, bar.width - 3);
    let number = |value: f64| theme.line(number(theme, look, value, text.width), Role::Dim);
    sheet.line(text, 0, &number(high));
    sheet.text(text, 1, look.unit.name, Role::Dim);
    if bar.height >= 7 {
        sheet.line(text, bar.height / 2, &number(0.5 * (low + high)));
    }
    sheet.line(text, bar.height - 1, &number(low));
    if kind == MapKind::Contact && bar.height >= 9 {
        let spot = Line::from(vec![
            Span::styled(theme.pick("█", "#"), Style::new().fg(theme.rgb(CONTACT))),
            theme.span("spot", Role::Dim),
        ]);
        sheet.line(text, bar.height - 3, &spot);
    }
}

/// A number of the legend, which says what of the range's ends holds beyond, where there is room.
fn number(theme: Theme, look: &Look, value: f64, room: u16) -> String {
    let text = if look.above == AboveRange::Dark && value == look.range[1] {
        format!(">{}", tick(look.unit.of(value)))
    } else {
        theme.text(&look.number(value))
    };
    if text.chars().count() <= usize::from(room) {
        text
    } else {
        tick(look.unit.of(value))
    }
}
