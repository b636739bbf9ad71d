//! What ratatui draws on: the line to the terminal.
//!
//! ```text
//! view ──cells that changed──> goal ──what differs from shown──> Typist ──bytes──> line
//!                                                  LinePace: how many
//! ```
//! On a line that is slow ([`LinePace`]) letters come before the pixels of maps, and a map that has begun to come is
//! finished before the next one begins: what is seen is one moment.

use std::io::{self, Write};
use std::time::Instant;

use crossterm::cursor::{Hide, MoveTo, Show, position};
use crossterm::terminal::{self, Clear};
use crossterm::{execute, queue};
use ratatui::backend::{Backend, ClearType, WindowSize};
use ratatui::buffer::{Buffer, Cell, CellWidth};
use ratatui::layout::{Position, Rect, Size};

use super::pace::LinePace;
use super::typist::{RowPart, Typist, is_block};

/// Bytes from which a terminal is told where a picture begins and ends, so that it is shown whole.
const TOLD: usize = 256;
const BEGIN: &[u8] = b"\x1b[?2026h";
const END: &[u8] = b"\x1b[?2026l";

/// The line to the terminal, and what is known to be shown at its end.
pub struct TerminalLine<W: Write> {
    out: W,
    pace: LinePace,
    /// What the terminal shows.
    shown: Buffer,
    /// What it should show.
    goal: Buffer,
    /// Of a slow line: the picture whose pixels are being written.
    still: Option<Buffer>,
    /// Rows that may differ.
    stale: Vec<bool>,
    /// The row that a slow line goes on with.
    next: usize,
    has_cursor: bool,
}

impl<W: Write> TerminalLine<W> {
    /// A line to a blank terminal of that size, of which no more is known.
    pub fn new(out: W, size: Size) -> Self {
        Self::at_pace(out, size, LinePace::of(None, Instant::now()))
    }

    pub(super) fn at_pace(out: W, size: Size, pace: LinePace) -> Self {
        let area = Rect::from((Position::ORIGIN, size));
        Self {
            out,
            pace,
            shown: Buffer::empty(area),
            goal: Buffer::empty(area),
            still: None,
            stale: vec![false; usize::from(area.height)],
            next: 0,
            has_cursor: true,
        }
    }

    /// Whether the line is known to be slow.
    pub(super) fn is_slow(&self) -> bool {
        self.pace.is_slow()
    }

    /// How fast it is.
    pub(super) fn pace(&self) -> &LinePace {
        &self.pace
    }

    /// Writes as much of what differs as the line takes now.
    ///
    /// # Errors
    /// When it cannot be written to.
    pub fn send(&mut self) -> io::Result<()> {
        let began = Instant::now();
        let mut typist = Typist::new();
        match self.pace.room(began) {
            None => {
                self.still = None;
                self.rows(&mut typist, RowPart::Whole, usize::MAX);
                self.stale.fill(false);
            }
            Some(0) => return Ok(()),
            Some(room) => {
                self.rows(&mut typist, RowPart::Letters, room);
                self.next_still();
                self.rows(&mut typist, RowPart::Blocks, room);
            }
        }
        let bytes = typist.finish();
        if bytes.is_empty() {
            return Ok(());
        }
        let is_told = bytes.len() > TOLD && !self.is_slow();
        if is_told {
            self.out.write_all(BEGIN)?;
        }
        self.out.write_all(&bytes)?;
        if is_told {
            self.out.write_all(END)?;
        }
        self.out.flush()?;
        self.pace.wrote(bytes.len(), began, Instant::now());
        Ok(())
    }

    /// Another map, when the last one has come.
    fn next_still(&mut self) {
        let has_come = |still: &Buffer| {
            let cells = self.goal.content.iter().zip(&still.content);
            let mut cells = cells.zip(&self.shown.content);
            cells
                .all(|((goal, still), shown)| !is_block(goal) || !is_block(still) || still == shown)
        };
        let is_of_size = |still: &&Buffer| still.area == self.goal.area;
        if self.still.as_ref().filter(is_of_size).is_none_or(has_come) {
            self.still = Some(self.goal.clone());
        }
    }

    /// Writes rows until there is no more room, from the one at which it ended the last time.
    fn rows(&mut self, typist: &mut Typist, part: RowPart, room: usize) {
        let (width, count) = (usize::from(self.goal.area.width), self.stale.len());
        for turn in 0..count {
            let row = (self.next + turn) % count;
            if typist.len() >= room {
                self.next = row;
                return;
            }
            if !self.stale[row] {
                continue;
            }
            let cells = row * width..(row + 1) * width;
            let mut goal = self.goal.content[cells.clone()].to_vec();
            if let (RowPart::Blocks, Some(still)) = (part, &self.still) {
                for (goal, still) in goal.iter_mut().zip(&still.content[cells.clone()]) {
                    if is_block(goal) && is_block(still) {
                        goal.clone_from(still);
                    }
                }
            }
            typist.row(row as u16, &mut self.shown.content[cells], &goal, part);
        }
    }

    /// The terminal has this size and is blank.
    fn forget(&mut self, area: Rect) {
        self.shown = Buffer::empty(area);
        self.goal = Buffer::empty(area);
        self.still = None;
        self.stale = vec![false; usize::from(area.height)];
        self.next = 0;
    }
}

impl<W: Write> Backend for TerminalLine<W> {
    type Error = io::Error;

    fn draw<'a, I>(&mut self, content: I) -> io::Result<()>
    where
        I: Iterator<Item = (u16, u16, &'a Cell)>,
    {
        for (x, y, cell) in content {
            let area = self.goal.area;
            // A terminal that has just grown is cleared before the next picture.
            if x >= area.width || y >= area.height {
                continue;
            }
            self.goal[(x, y)].clone_from(cell);
            self.stale[usize::from(y)] = true;
            for hidden in x + 1..x.saturating_add(cell.cell_width()).min(area.width) {
                self.goal[(hidden, y)].reset();
            }
        }
        Ok(())
    }

    fn hide_cursor(&mut self) -> io::Result<()> {
        if self.has_cursor {
            self.has_cursor = false;
            execute!(self.out, Hide)?;
        }
        Ok(())
    }

    fn show_cursor(&mut self) -> io::Result<()> {
        self.has_cursor = true;
        execute!(self.out, Show)
    }

    fn get_cursor_position(&mut self) -> io::Result<Position> {
        let (x, y) = position()?;
        Ok(Position { x, y })
    }

    fn set_cursor_position<P: Into<Position>>(&mut self, at: P) -> io::Result<()> {
        let at = at.into();
        execute!(self.out, MoveTo(at.x, at.y))
    }

    fn clear(&mut self) -> io::Result<()> {
        self.clear_region(ClearType::All)
    }

    /// All of it: nothing here asks for parts.
    fn clear_region(&mut self, _: ClearType) -> io::Result<()> {
        queue!(self.out, Clear(terminal::ClearType::All))?;
        self.forget(Rect::from((Position::ORIGIN, self.size()?)));
        Ok(())
    }

    fn size(&self) -> io::Result<Size> {
        terminal::size().map(Size::from)
    }

    fn window_size(&mut self) -> io::Result<WindowSize> {
        let size = terminal::window_size()?;
        Ok(WindowSize {
            columns_rows: Size::new(size.columns, size.rows),
            pixels: Size::new(size.width, size.height),
        })
    }

    fn flush(&mut self) -> io::Result<()> {
        self.send()
    }
}
