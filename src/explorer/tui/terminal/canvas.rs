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
use crate::tui::pixels::{Bitmap, Pixels, kitty, sixel};
use crate::tui::view;

/// Least time between two pictures: they are many bytes.
const PICTURE_TIME: Duration = Duration::from_millis(50);

/// The picture that the terminal shows under its letters.
#[derive(Debug, Default)]
pub(super) struct Canvas {
    drawn: Option<(Pixels, Bitmap)>,
    last: Option<Instant>,
    /// Letters were written since, perhaps over it.
    is_stale: bool,
}

impl Canvas {
    /// Whether all cells must be written anew: a picture that goes, or moves, leaves its pixels behind.
    pub(super) fn must_clear(&mut self, app: &App, screen: Rect) -> bool {
        let wanted = view::picture_area(app, screen).map(|area| (app.pixels(), area));
        let drawn = self
            .drawn
            .as_ref()
            .map(|(pixels, bitmap)| (*pixels, bitmap.area));
        let moved = drawn.is_some() && drawn != wanted;
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
    pub(super) fn show(&mut self, app: &App, screen: &Buffer, has_changed: bool) -> io::Result<()> {
        self.is_stale |= has_changed;
        if self.last.is_some_and(|last| last.elapsed() < PICTURE_TIME) {
            return Ok(());
        }
        let Some(picture) = view::picture(app, screen.area, cell_size()?) else {
            return Ok(());
        };
        let next = (app.pixels(), picture);
        if !self.is_stale && self.drawn.as_ref() == Some(&next) {
            return Ok(());
        }
        let (pixels, picture) = &next;
        let mut out = stdout().lock();
        queue!(
            out,
            BeginSynchronizedUpdate,
            MoveTo(picture.area.x, picture.area.y)
        )?;
        match pixels {
            Pixels::Sixel => out.write_all(&sixel::encode(picture))?,
            Pixels::Kitty => out.write_all(&kitty::encode(picture))?,
            Pixels::Blocks | Pixels::Page => {}
        }
        let letters = picture.area.positions().filter_map(|at| {
            let cell = &screen[at];
            (cell.symbol() != " ").then_some((at.x, at.y, cell))
        });
        CrosstermBackend::new(&mut out).draw(letters)?;
        execute!(out, EndSynchronizedUpdate)?;
        self.drawn = Some(next);
        self.last = Some(Instant::now());
        self.is_stale = false;
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
