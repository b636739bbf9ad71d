//! Shows the map's pixels on the terminal, and takes them away.

use std::io::{self, Write, stdout};
use std::time::{Duration, Instant};

use crossterm::cursor::MoveTo;
use crossterm::terminal::{BeginSynchronizedUpdate, EndSynchronizedUpdate, window_size};
use crossterm::{execute, queue};
use ratatui::backend::{Backend as _, CrosstermBackend};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use crate::tui::app::App;
use crate::tui::pixels::{Pixels, kitty, sixel};
use crate::tui::view;

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
        queue!(out, BeginSynchronizedUpdate, MoveTo(area.x, area.y))?;
        match app.pixels() {
            Pixels::Sixel => out.write_all(&sixel::encode(&picture))?,
            Pixels::Kitty => out.write_all(&kitty::encode(&picture))?,
            Pixels::Blocks | Pixels::Page => {}
        }
        let letters = area.positions().filter_map(|at| {
            let cell = &screen[at];
            (cell.symbol() != " ").then_some((at.x, at.y, cell))
        });
        CrosstermBackend::new(&mut out).draw(letters)?;
        execute!(out, EndSynchronizedUpdate)?;
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
