//! From values to colours or characters, and the bar that says which is which.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Color;
use ratatui::text::{Line, Span};

use super::raster::{Raster, Window};
use crate::observe::interferogram::colour as fringe;
use crate::tui::app::{App, MapKind};
use crate::tui::pixels::Picture;
use crate::tui::theme::{Ramp, Role, Theme};
use crate::tui::units::{Unit, tick};
use crate::tui::view::{ascii_text, put};

/// What a map shows: scale, unit and colours.
pub(super) struct Look {
    ramp: Ramp,
    low: f64,
    high: f64,
    unit: Unit,
}

pub(super) fn look(app: &App) -> Look {
    let ranges = &app.ranges;
    let (ramp, low, high, unit) = match app.map {
        MapKind::Pressure | MapKind::Contact | MapKind::PressureWaves => {
            (Ramp::Heat, 0.0, ranges.pressure_pa, app.units.pressure())
        }
        MapKind::Film | MapKind::Fringes | MapKind::FilmWaves => {
            (Ramp::Depth, 0.0, ranges.film_m, app.units.film())
        }
        MapKind::Roughness => (
            Ramp::Diverging,
            -ranges.height_m,
            ranges.height_m,
            app.units.height(),
        ),
        MapKind::Stress => (Ramp::Heat, 0.0, ranges.stress_pa, app.units.pressure()),
    };
    Look {
        ramp,
        low,
        high: if high > low { high } else { low + 1.0 },
        unit,
    }
}

impl Look {
    /// Place of a value on the colour map. Deep film is dark, so that where it collapses shines.
    fn part(&self, value: f64) -> f32 {
        let part = ((value - self.low) / (self.high - self.low)) as f32;
        match self.ramp {
            Ramp::Depth => 1.0 - part,
            Ramp::Heat | Ramp::Diverging => part,
        }
    }
}

/// What a pixel shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Tint {
    /// Nothing: there is no value.
    Blank,
    /// A colour of its own.
    Plain([u8; 3]),
    /// A place on the map's ramp.
    Ramp(f32),
    /// Same, under a line.
    Lit(f32),
}

impl Tint {
    /// The white of a line.
    const WHITE: f32 = 0.35;

    pub(super) fn of(
        look: &Look,
        raster: &Raster,
        window: &Window,
        kind: MapKind,
        (column, row): (usize, usize),
    ) -> Self {
        let value = f64::from(raster.at(column, row));
        let t = look.part(value);
        if t.is_nan() {
            Self::Blank
        } else if kind == MapKind::Fringes {
            Self::Plain(raster.fringe(column, row))
        } else if kind == MapKind::Contact && raster.spot(column, row) {
            Self::Plain([120, 214, 255])
        } else if kind == MapKind::Contact {
            Self::Ramp(0.45 * t)
        } else if kind.is_plane() && on_ellipse(window, raster, column, row) {
            Self::Lit(t)
        } else {
            Self::Ramp(t)
        }
    }

    /// In the terminal's colours.
    fn color(self, theme: Theme, ramp: Ramp) -> Color {
        match self {
            Self::Blank => Color::Reset,
            Self::Plain(rgb) => theme.rgb(rgb),
            Self::Ramp(t) => theme.map_color(ramp, t),
            Self::Lit(t) => theme.map_color_lit(ramp, t, Self::WHITE),
        }
    }

    /// Red, green, blue and opacity.
    pub(super) fn rgba(self, look: &Look) -> [u8; 4] {
        let [r, g, b] = match self {
            Self::Blank => return [0; 4],
            Self::Plain(rgb) => rgb,
            Self::Ramp(t) => look.ramp.rgb(t),
            Self::Lit(t) => look.ramp.lit(t, Self::WHITE),
        };
        [r, g, b, 255]
    }
}

/// A mark on a picture, white on black.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mark {
    /// The material point.
    Diamond,
    /// The probe.
    Cross,
}

impl Mark {
    /// Draws it at a place, with so many pixels to each side.
    pub(super) fn draw(
        self,
        picture: &mut Picture,
        window: &Window,
        (x, y): (f64, f64),
        half: f64,
    ) {
        /// How far the black around it goes.
        const EDGE: f64 = 1.35;
        let part = |value: f64, [from, to]: [f64; 2]| (value - from) / (to - from);
        let (along, down) = (part(x, window.x), part(y, window.y));
        if !(0.0..1.0).contains(&along) || !(0.0..1.0).contains(&down) {
            return;
        }
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
    theme: Theme,
    raster: &Raster,
    look: &Look,
    window: &Window,
    kind: MapKind,
    image: Rect,
    buffer: &mut Buffer,
) {
    let pixel = |column: usize, row: usize| {
        Tint::of(look, raster, window, kind, (column, row)).color(theme, look.ramp)
    };
    for row in 0..usize::from(image.height) {
        for column in 0..usize::from(image.width) {
            let at = (image.x + column as u16, image.y + row as u16);
            let Some(cell) = buffer.cell_mut(at) else {
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
    let t = look.part(f64::from(raster.at(column, row)));
    if t.is_nan() {
        return " ";
    }
    match kind {
        MapKind::Contact if raster.spot(column, row) => "#",
        MapKind::Contact if ring => "o",
        MapKind::Contact => Theme::map_ink(0.3 * t),
        MapKind::Fringes => {
            let [_, green, _] = raster.fringe(column, row);
            Theme::map_ink(f32::from(green) / 255.0)
        }
        _ => Theme::map_ink(t),
    }
}

/// Whether the edge of Hertz's contact passes through a pixel.
fn on_ellipse(window: &Window, raster: &Raster, column: usize, row: usize) -> bool {
    let x = window.x_at((column as f64 + 0.5) / raster.columns as f64);
    let y = window.y_at((row as f64 + 0.5) / raster.rows as f64);
    let pixel = (window.x[1] - window.x[0]) / raster.columns as f64;
    (raster.distance(x, y) - 1.0).abs() < 0.5 * pixel
}

pub(super) fn color_bar(theme: Theme, look: &Look, kind: MapKind, bar: Rect, buffer: &mut Buffer) {
    if bar.width < 4 || bar.height < 3 {
        return;
    }
    let pixels = f64::from(2 * bar.height - 1);
    for row in 0..bar.height {
        let value = |half: u16| {
            let down = f64::from(2 * row + half) / pixels;
            look.high - (look.high - look.low) * down
        };
        let dim = if kind == MapKind::Contact { 0.45 } else { 1.0 };
        let color = |half: u16| match kind {
            MapKind::Fringes => theme.rgb(fringe(value(half) as f32, 0.0)),
            _ => theme.map_color(look.ramp, dim * look.part(value(half))),
        };
        if let Some(cell) = buffer.cell_mut((bar.x + 1, bar.y + row)) {
            if theme.paints() {
                cell.set_symbol("▀").set_fg(color(0)).set_bg(color(1));
            } else if kind == MapKind::Fringes {
                let [_, green, _] = fringe(value(0) as f32, 0.0);
                cell.set_symbol(Theme::map_ink(f32::from(green) / 255.0));
            } else {
                cell.set_symbol(Theme::map_ink(look.part(value(0))));
            }
        }
    }
    let text = Rect {
        x: bar.x + 3,
        width: bar.width - 3,
        ..bar
    };
    let dim = theme.style(Role::Dim);
    let number = |value: f64| Line::styled(tick(look.unit.of(value)), dim);
    put(text, 0, &number(look.high), buffer);
    put(
        text,
        1,
        &Line::styled(ascii_text(theme, look.unit.name), dim),
        buffer,
    );
    if bar.height >= 7 {
        put(
            text,
            bar.height / 2,
            &number(0.5 * (look.low + look.high)),
            buffer,
        );
    }
    put(text, bar.height - 1, &number(look.low), buffer);
    if kind == MapKind::Contact && bar.height >= 9 {
        let spot = Line::from(vec![
            Span::styled(theme.pick("█", "#"), theme.style(Role::Film)),
            Span::styled("touch", dim),
        ]);
        put(text, bar.height - 3, &spot, buffer);
    }
}
