//! Cells as bytes for the terminal, few of them: on a slow line bytes are what time is spent on.
//!
//! Only what differs is written. Of colours and weights only those are told that change, a half block is drawn by the
//! half that changes less, a blank in any ink, a short gap is written over, and a row that is mostly blank is erased
//! first where that takes fewer bytes.

use ratatui::buffer::{Cell, CellWidth};
use ratatui::layout::Position;
use ratatui::style::{Color, Modifier};

/// Upper and lower half of a cell in the colour of letters.
const HALVES: [&str; 2] = ["▀", "▄"];
/// Modifiers that show on a blank.
const ON_BLANK: Modifier = Modifier::REVERSED
    .union(Modifier::UNDERLINED)
    .union(Modifier::CROSSED_OUT);
/// Cells that are better written again than skipped: skipping them takes as many bytes.
const SHORT_GAP: u16 = 4;

/// Which cells of a row are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum RowPart {
    /// Every one that differs.
    Whole,
    /// All but half blocks.
    Letters,
    /// Half blocks: the pixels of maps.
    Blocks,
}

impl RowPart {
    /// Whether a cell belongs to it.
    pub(super) fn holds(self, cell: &Cell) -> bool {
        match self {
            Self::Whole => true,
            Self::Letters => !is_block(cell),
            Self::Blocks => is_block(cell),
        }
    }
}

/// Whether a cell holds two pixels.
pub(super) fn is_block(cell: &Cell) -> bool {
    HALVES.contains(&cell.symbol())
}

/// Colours and weight of what is written next.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct TypistPen {
    ink: Color,
    paper: Color,
    weight: Modifier,
}

impl TypistPen {
    const PLAIN: Self = Self {
        ink: Color::Reset,
        paper: Color::Reset,
        weight: Modifier::empty(),
    };
}

/// Writes cells from a place that is not known and with a plain pen.
#[derive(Debug)]
pub(super) struct Typist {
    bytes: Vec<u8>,
    pen: TypistPen,
    at: Option<Position>,
}

impl Typist {
    pub(super) fn new() -> Self {
        Self {
            bytes: Vec::new(),
            pen: TypistPen::PLAIN,
            at: None,
        }
    }

    /// How many bytes it has written.
    pub(super) fn len(&self) -> usize {
        self.bytes.len()
    }

    /// What it has written, with the pen put back.
    pub(super) fn finish(mut self) -> Vec<u8> {
        self.take(TypistPen::PLAIN);
        self.bytes
    }

    /// Writes what of a row differs from what is shown, and notes it there.
    pub(super) fn row(&mut self, y: u16, shown: &mut [Cell], goal: &[Cell], part: RowPart) {
        let cells = || goal.iter().zip(&*shown);
        let differ = cells().filter(|(goal, shown)| part.holds(goal) && goal != shown);
        let differ = differ.count();
        if differ == 0 {
            return;
        }
        let mut over = shown.to_vec();
        let mut typed = self.branch();
        typed.differences(y, &mut over, goal, part);
        let filled = goal.iter().filter(|cell| **cell != Cell::EMPTY).count();
        let erases = part == RowPart::Whole || !goal.iter().any(is_block);
        if filled < differ && erases {
            let mut blank = vec![Cell::EMPTY; shown.len()];
            let mut anew = self.branch();
            anew.go_to(0, y);
            anew.erase();
            anew.differences(y, &mut blank, goal, part);
            if anew.len() < typed.len() {
                (typed, over) = (anew, blank);
            }
        }
        self.bytes.extend_from_slice(&typed.bytes);
        (self.pen, self.at) = (typed.pen, typed.at);
        shown.clone_from_slice(&over);
    }

    /// One that goes on from here on a sheet of its own.
    fn branch(&self) -> Self {
        Self {
            bytes: Vec::new(),
            ..*self
        }
    }

    fn differences(&mut self, y: u16, shown: &mut [Cell], goal: &[Cell], part: RowPart) {
        let blank_from = goal.iter().rposition(|cell| *cell != Cell::EMPTY);
        let blank_from = blank_from.map_or(0, |last| last + 1);
        let mut x = 0;
        while x < goal.len() {
            let cell = &goal[x];
            let width = usize::from(cell.cell_width().max(1));
            if part.holds(cell) && shown[x] != *cell {
                self.pass_over(x as u16, y, goal, shown);
                let rest = &mut shown[x..];
                let others = rest.iter().filter(|cell| **cell != Cell::EMPTY).count();
                if x >= blank_from && others > 3 && part != RowPart::Blocks {
                    self.erase();
                    rest.fill(Cell::EMPTY);
                    return;
                }
                self.put(cell, width as u16);
                shown[x] = cell.clone();
                if let Some(hidden) = shown.get_mut(x + 1..x + width) {
                    hidden.fill(Cell::EMPTY);
                }
                if x + width >= goal.len() {
                    // Terminals differ in where the cursor is behind the last column.
                    self.at = None;
                }
            }
            x += width;
        }
    }

    /// Goes on to a cell, over those between that are shown as they should be.
    fn pass_over(&mut self, x: u16, y: u16, goal: &[Cell], shown: &[Cell]) {
        if let Some(at) = self
            .at
            .filter(|at| at.y == y && at.x < x && x - at.x <= SHORT_GAP)
        {
            let between = usize::from(at.x)..usize::from(x);
            let pen = self.pen;
            let same = |(goal, shown): (&Cell, &Cell)| {
                let own = TypistPen {
                    ink: goal.fg,
                    paper: goal.bg,
                    weight: goal.modifier,
                };
                goal == shown && own == pen && goal.symbol().len() == 1
            };
            if goal[between.clone()]
                .iter()
                .zip(&shown[between.clone()])
                .all(same)
            {
                for cell in &goal[between] {
                    self.bytes.extend_from_slice(cell.symbol().as_bytes());
                }
                self.at = Some(Position { x, y });
            }
        }
        self.go_to(x, y);
    }

    fn go_to(&mut self, x: u16, y: u16) {
        match self.at {
            Some(at) if at.x == x && at.y == y => return,
            Some(at) if at.y == y && at.x < x => {
                self.bytes.extend_from_slice(b"\x1b[");
                if x - at.x > 1 {
                    self.number(x - at.x);
                }
                self.bytes.push(b'C');
            }
            _ => {
                self.bytes.extend_from_slice(b"\x1b[");
                self.number(y + 1);
                if x > 0 {
                    self.bytes.push(b';');
                    self.number(x + 1);
                }
                self.bytes.push(b'H');
            }
        }
        self.at = Some(Position { x, y });
    }

    /// Blanks the rest of the row.
    fn erase(&mut self) {
        self.take(TypistPen::PLAIN);
        self.bytes.extend_from_slice(b"\x1b[K");
    }

    fn put(&mut self, cell: &Cell, width: u16) {
        let (symbol, pen) = self.drawn(cell);
        self.take(pen);
        self.bytes.extend_from_slice(symbol.as_bytes());
        if let Some(at) = &mut self.at {
            at.x += width;
        }
    }

    /// What shows a cell with the least change of the pen.
    fn drawn<'a>(&self, cell: &'a Cell) -> (&'a str, TypistPen) {
        let pen = TypistPen {
            ink: cell.fg,
            paper: cell.bg,
            weight: cell.modifier,
        };
        let as_blank = |paper| {
            let weight = self.pen.weight.difference(ON_BLANK);
            let ink = self.pen.ink;
            (" ", TypistPen { ink, paper, weight })
        };
        match cell.symbol() {
            " " if !cell.modifier.intersects(ON_BLANK) => as_blank(cell.bg),
            symbol if is_block(cell) && cell.modifier.is_empty() => {
                if pen.ink == pen.paper && pen.ink != Color::Reset {
                    return as_blank(pen.paper);
                }
                let turned = TypistPen {
                    ink: pen.paper,
                    paper: pen.ink,
                    ..pen
                };
                let changes = |pen: TypistPen| {
                    u8::from(pen.ink != self.pen.ink) + u8::from(pen.paper != self.pen.paper)
                };
                // The terminal's own paper and ink are two colours of one name.
                let turns = pen.ink != Color::Reset && pen.paper != Color::Reset;
                if turns && changes(turned) < changes(pen) {
                    let other = usize::from(symbol == HALVES[0]);
                    return (HALVES[other], turned);
                }
                (symbol, pen)
            }
            symbol => (symbol, pen),
        }
    }

    /// Takes another pen: by what changes, or from a plain one, whichever is shorter.
    fn take(&mut self, pen: TypistPen) {
        if pen == self.pen {
            return;
        }
        if pen == TypistPen::PLAIN {
            self.bytes.extend_from_slice(b"\x1b[m");
            self.pen = pen;
            return;
        }
        let start = self.bytes.len();
        self.bytes.extend_from_slice(b"\x1b[");
        self.changes(self.pen, pen);
        let (middle, changed) = (self.bytes.len(), self.bytes.len() - start);
        self.bytes.extend_from_slice(b"\x1b[0;");
        self.changes(TypistPen::PLAIN, pen);
        if self.bytes.len() - middle < changed {
            self.bytes.drain(start..middle);
        } else {
            self.bytes.truncate(middle);
        }
        // Each code ends in a semicolon, the last one in this.
        if let Some(last) = self.bytes.last_mut() {
            *last = b'm';
        }
        self.pen = pen;
    }

    fn changes(&mut self, from: TypistPen, to: TypistPen) {
        /// Modifiers, and the codes that begin and end them.
        const WEIGHTS: [(Modifier, u16, u16); 8] = [
            (Modifier::BOLD, 1, 22),
            (Modifier::DIM, 2, 22),
            (Modifier::ITALIC, 3, 23),
            (Modifier::UNDERLINED, 4, 24),
            (Modifier::SLOW_BLINK, 5, 25),
            (Modifier::REVERSED, 7, 27),
            (Modifier::HIDDEN, 8, 28),
            (Modifier::CROSSED_OUT, 9, 29),
        ];
        let mut ended = Modifier::empty();
        for (weight, _, off) in WEIGHTS {
            if from.weight.contains(weight) && !to.weight.contains(weight) {
                // 22 ends both, bold and dim.
                let both = Modifier::BOLD.union(Modifier::DIM);
                ended |= if off == 22 { both } else { weight };
                self.number(off);
                self.bytes.push(b';');
            }
        }
        for (weight, on, _) in WEIGHTS {
            let is_there = from.weight.contains(weight) && !ended.contains(weight);
            if to.weight.contains(weight) && !is_there {
                self.number(on);
                self.bytes.push(b';');
            }
        }
        if from.ink != to.ink {
            self.color(to.ink, 30);
        }
        if from.paper != to.paper {
            self.color(to.paper, 40);
        }
    }

    /// A colour's codes; those of letters begin at 30, those of paper at 40.
    fn color(&mut self, color: Color, base: u16) {
        let mut codes = |codes: &[u16]| {
            for code in codes {
                self.number(*code);
                self.bytes.push(b';');
            }
        };
        match color {
            Color::Reset => codes(&[base + 9]),
            Color::Black => codes(&[base]),
            Color::Red => codes(&[base + 1]),
            Color::Green => codes(&[base + 2]),
            Color::Yellow => codes(&[base + 3]),
            Color::Blue => codes(&[base + 4]),
            Color::Magenta => codes(&[base + 5]),
            Color::Cyan => codes(&[base + 6]),
            Color::Gray => codes(&[base + 7]),
            Color::DarkGray => codes(&[base + 60]),
            Color::LightRed => codes(&[base + 61]),
            Color::LightGreen => codes(&[base + 62]),
            Color::LightYellow => codes(&[base + 63]),
            Color::LightBlue => codes(&[base + 64]),
            Color::LightMagenta => codes(&[base + 65]),
            Color::LightCyan => codes(&[base + 66]),
            Color::White => codes(&[base + 67]),
            Color::Indexed(index) => codes(&[base + 8, 5, u16::from(index)]),
            Color::Rgb(r, g, b) => {
                codes(&[base + 8, 2, u16::from(r), u16::from(g), u16::from(b)]);
            }
        }
    }

    fn number(&mut self, number: u16) {
        for unit in [10_000, 1000, 100, 10, 1] {
            if number >= unit || unit == 1 {
                self.bytes.push(b'0' + (number / unit % 10) as u8);
            }
        }
    }
}
