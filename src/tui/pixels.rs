//! The map in the terminal's own pixels, where it has them: sixel or kitty's protocol in place of half blocks.
//!
//! ```text
//! frame ──> view: cells, the map's room left blank ──> terminal
//!       └─> view: RGBA of that room ──> sixel | kitty ──> terminal, under or before the letters on it
//! ```
//! Which protocol a terminal has is known from its name; a terminal within another (tmux, ssh) is not asked for
//! pixels unless the key says so.

mod kitty;
mod sixel;

use std::io::{self, Write, stdout};
use std::time::{Duration, Instant};

use crossterm::cursor::MoveTo;
use crossterm::queue;
use crossterm::terminal::window_size;
use ratatui::backend::{Backend as _, CrosstermBackend};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use crate::tui::app::App;
use crate::tui::view;

/// How the map is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Pixels {
    /// In half blocks, or characters of growing ink.
    #[default]
    Blocks,
    /// In sixels.
    Sixel,
    /// By kitty's graphics protocol.
    Kitty,
}

impl Pixels {
    /// What a terminal is known to have, by the environment's variables.
    pub fn detect(variable: impl Fn(&str) -> Option<String>) -> Self {
        let filled = |name: &str| variable(name).filter(|value| !value.is_empty());
        let within = ["TMUX", "STY", "SSH_CONNECTION", "NO_COLOR"];
        if within.iter().any(|name| filled(name).is_some()) {
            return Self::Blocks;
        }
        let term = filled("TERM").unwrap_or_default();
        let program = filled("TERM_PROGRAM").unwrap_or_default();
        if filled("KITTY_WINDOW_ID").is_some() || term.contains("kitty") || term.contains("ghostty")
        {
            Self::Kitty
        } else if ["foot", "mlterm", "contour"]
            .iter()
            .any(|name| term.starts_with(name))
            || program == "WezTerm"
            || filled("KONSOLE_VERSION").is_some()
        {
            Self::Sixel
        } else {
            Self::Blocks
        }
    }

    /// The next way.
    #[must_use]
    pub fn next(self) -> Self {
        match self {
            Self::Blocks => Self::Sixel,
            Self::Sixel => Self::Kitty,
            Self::Kitty => Self::Blocks,
        }
    }

    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Blocks => "half blocks",
            Self::Sixel => "sixels",
            Self::Kitty => "kitty's pixels",
        }
    }
}

/// A picture for a part of the screen.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// The cells that it fills.
    pub area: Rect,
    /// Pixels along.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Red, green, blue, opacity; row by row.
    pub rgba: Vec<u8>,
}

/// Least time between two pictures: they are many bytes.
const PICTURE_TIME: Duration = Duration::from_millis(50);

/// What of the terminal holds a picture.
#[derive(Debug, Default)]
pub(super) struct Canvas {
    drawn: Option<(Pixels, Rect)>,
    last: Option<Instant>,
}

impl Canvas {
    /// Whether all cells must be written anew: a picture that goes, or moves, leaves its pixels behind.
    pub(super) fn must_clear(&mut self, app: &App, screen: Rect) -> bool {
        let wanted = view::picture_area(app, screen).map(|area| (app.pixels(), area));
        let moved = self.drawn.is_some() && self.drawn != wanted;
        if moved {
            self.forget();
        }
        moved
    }

    /// The screen was cleared.
    pub(super) fn forget(&mut self) {
        if let Some((Pixels::Kitty, _)) = self.drawn.take() {
            // The letters come anyway; a picture that stays is no harm.
            let _ = stdout().write_all(kitty::REMOVE);
        }
        self.last = None;
    }

    /// Draws the picture of a screen that has just been drawn, and the letters that lie on it again.
    pub(super) fn show(&mut self, app: &App, screen: &Buffer) -> io::Result<()> {
        if self.last.is_some_and(|last| last.elapsed() < PICTURE_TIME) {
            return Ok(());
        }
        let Some(picture) = view::picture(app, screen.area, cell_size()?) else {
            return Ok(());
        };
        let area = picture.area;
        let mut out = stdout().lock();
        queue!(out, MoveTo(area.x, area.y))?;
        match app.pixels() {
            Pixels::Sixel => out.write_all(&sixel::encode(&picture))?,
            Pixels::Kitty => out.write_all(&kitty::encode(&picture))?,
            Pixels::Blocks => {}
        }
        let letters = area.positions().filter_map(|at| {
            let cell = &screen[at];
            (cell.symbol() != " ").then_some((at.x, at.y, cell))
        });
        CrosstermBackend::new(&mut out).draw(letters)?;
        out.flush()?;
        self.drawn = Some((app.pixels(), area));
        self.last = Some(Instant::now());
        Ok(())
    }
}

/// Pixels of a cell; a terminal that does not say has cells of a usual size.
fn cell_size() -> io::Result<(u16, u16)> {
    const USUAL: (u16, u16) = (8, 16);
    let size = window_size()?;
    let each = |pixels: u16, cells: u16| pixels.checked_div(cells).filter(|each| *each > 0);
    Ok(each(size.width, size.columns)
        .zip(each(size.height, size.rows))
        .unwrap_or(USUAL))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_are_known_by_the_terminals_name() {
        let detect = |pairs: &[(&str, &str)]| {
            Pixels::detect(|name| {
                let found = pairs.iter().find(|(key, _)| *key == name);
                found.map(|(_, value)| (*value).to_owned())
            })
        };
        assert_eq!(detect(&[("TERM", "xterm-256color")]), Pixels::Blocks);
        assert_eq!(detect(&[("TERM", "xterm-kitty")]), Pixels::Kitty);
        assert_eq!(detect(&[("TERM", "foot")]), Pixels::Sixel);
        assert_eq!(
            detect(&[("TERM", "xterm-kitty"), ("TMUX", "/tmp/tmux-0/default,1,0")]),
            Pixels::Blocks
        );
        assert_eq!(
            detect(&[("TERM", "foot"), ("NO_COLOR", "1")]),
            Pixels::Blocks
        );
    }
}
