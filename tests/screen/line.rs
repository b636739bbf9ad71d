//! What a screen costs on the line to the terminal, and that the terminal shows it.
#![cfg(feature = "tui")]
#![expect(clippy::unwrap_used, reason = "tests")]

use std::io::{self, Write};
use std::sync::{Arc, Mutex};
use std::time::Instant;

use crate::common::pty::Terminal as Shell;
use crate::common::tui_fixture::{State, app, play, theme};
use asperity_explorer::tui::TerminalLine;
use asperity_explorer::tui::action::Action;
use asperity_explorer::tui::app::App;
use asperity_explorer::tui::theme::{ColorDepth, Glyphs};
use asperity_explorer::tui::view;
use ratatui::backend::CrosstermBackend;
use ratatui::buffer::{Buffer, Cell};
use ratatui::layout::{Rect, Size};
use ratatui::style::{Color, Modifier};
use ratatui::{Terminal, TerminalOptions, Viewport};

/// Keeps what is written.
#[derive(Clone, Default)]
struct Wire(Arc<Mutex<Vec<u8>>>);

impl Write for Wire {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.lock().unwrap().extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// A terminal that counts what it is sent, and shows it.
struct Counted {
    app: App,
    size: (u16, u16),
    terminal: Terminal<TerminalLine<Wire>>,
    wire: Wire,
    parser: vt100::Parser,
    /// By ratatui's own writer, to compare with.
    plain: (Terminal<CrosstermBackend<Wire>>, Wire),
}

impl Counted {
    fn new(app: App, (cols, rows): (u16, u16)) -> Self {
        let wire = Wire::default();
        let line = TerminalLine::new(wire.clone(), Size::new(cols, rows));
        let viewport = Viewport::Fixed(Rect::new(0, 0, cols, rows));
        let options = TerminalOptions { viewport };
        let other = Wire::default();
        let backend = CrosstermBackend::new(other.clone());
        Self {
            app,
            size: (cols, rows),
            terminal: Terminal::with_options(line, options.clone()).unwrap(),
            wire,
            parser: vt100::Parser::new(rows, cols, 0),
            plain: (Terminal::with_options(backend, options).unwrap(), other),
        }
    }

    /// Bytes of the next picture, which the terminal then shows; and those of ratatui's own writer.
    fn bytes(&mut self) -> [usize; 2] {
        let app = &self.app;
        let drawn = self.terminal.draw(|frame| view::draw(app, frame)).unwrap();
        let bytes = std::mem::take(&mut *self.wire.0.lock().unwrap());
        self.parser.process(&bytes);
        let (cols, rows) = self.size;
        for y in 0..rows {
            let mut hidden = false;
            for x in 0..cols {
                let seen = self.parser.screen().cell(y, x).unwrap();
                if !hidden {
                    let cell = &drawn.buffer[(x, y)];
                    let (mut shown, goal) = (look_of(seen), look(cell));
                    if cell.modifier.contains(Modifier::BOLD | Modifier::DIM) {
                        // The test's terminal knows one of the two at a time.
                        shown.2[0] = goal.2[0];
                    }
                    assert_eq!(shown, goal, "{x}, {y}");
                }
                hidden = seen.is_wide();
            }
        }
        let (terminal, wire) = &mut self.plain;
        terminal.draw(|frame| view::draw(app, frame)).unwrap();
        let plain = std::mem::take(&mut *wire.0.lock().unwrap());
        [bytes.len(), plain.len()]
    }

    fn act(&mut self, action: Action) -> [usize; 2] {
        self.app.apply(action);
        self.bytes()
    }
}

/// What is seen of a cell: its letter, ink and weight, or the colours of its two halves.
type Looks = (String, [vt100::Color; 2], [bool; 3]);

fn seen(symbol: &str, ink: vt100::Color, paper: vt100::Color, weight: [bool; 3]) -> Looks {
    match symbol {
        "" | " " if !weight[2] => ("▀".into(), [paper; 2], [false; 3]),
        "▀" if !weight[2] => ("▀".into(), [ink, paper], [false; 3]),
        "▄" if !weight[2] => ("▀".into(), [paper, ink], [false; 3]),
        letter => (letter.into(), [ink, paper], weight),
    }
}

fn look_of(cell: &vt100::Cell) -> Looks {
    let weight = [cell.bold(), cell.italic(), cell.inverse()];
    seen(cell.contents(), cell.fgcolor(), cell.bgcolor(), weight)
}

fn look(cell: &Cell) -> Looks {
    let has = |modifier| cell.modifier.contains(modifier);
    let weight = [
        has(Modifier::BOLD),
        has(Modifier::ITALIC),
        has(Modifier::REVERSED),
    ];
    seen(cell.symbol(), color(cell.fg), color(cell.bg), weight)
}

fn color(color: Color) -> vt100::Color {
    /// In the order of their numbers.
    const SIXTEEN: [Color; 16] = [
        Color::Black,
        Color::Red,
        Color::Green,
        Color::Yellow,
        Color::Blue,
        Color::Magenta,
        Color::Cyan,
        Color::Gray,
        Color::DarkGray,
        Color::LightRed,
        Color::LightGreen,
        Color::LightYellow,
        Color::LightBlue,
        Color::LightMagenta,
        Color::LightCyan,
        Color::White,
    ];
    match color {
        Color::Reset => vt100::Color::Default,
        Color::Indexed(index) => vt100::Color::Idx(index),
        Color::Rgb(r, g, b) => vt100::Color::Rgb(r, g, b),
        named => {
            let place = SIXTEEN.iter().position(|known| *known == named);
            vt100::Color::Idx(place.unwrap() as u8)
        }
    }
}

/// Each screen in each depth: the terminal shows what was drawn, and the bytes are bounded. The bounds are a tenth above
/// what was counted; 960 bytes are a second of a line of 9600 baud.
#[test]
fn bytes_of_each_screen() {
    const DEPTHS: [(ColorDepth, [usize; 5]); 4] = [
        (ColorDepth::True, [8000, 2500, 1200, 2650, 7500]),
        (ColorDepth::Indexed, [5650, 680, 1050, 2350, 5250]),
        (ColorDepth::Basic, [3700, 410, 930, 2100, 3400]),
        (ColorDepth::Mono, [3060, 290, 850, 2000, 2770]),
    ];
    let mut beyond = Vec::new();
    for (depth, bounds) in DEPTHS {
        let mut counted = Counted::new(app(theme(depth, Glyphs::Unicode)), (80, 24));
        play(&mut counted.app, 1..=96, &State::default());
        let start = counted.bytes();
        let mut step = 96;
        let mut live = [0; 2];
        for _ in 0..20 {
            step += 1;
            play(&mut counted.app, step..=step, &State::default());
            let bytes = counted.bytes();
            live = [live[0] + bytes[0], live[1] + bytes[1]];
        }
        let knob = counted.act(Action::Turn(1));
        let help = counted.act(Action::Help);
        let closed = counted.act(Action::Help);
        let found = [start, live.map(|sum| sum / 20), knob, help, closed];
        println!(
            "{depth:?}: start, step, knob, help, help closed: {found:?} bytes, and by ratatui's own writer"
        );
        let others = [
            ("plan", Action::Plan),
            ("scene", Action::Scene),
            ("lessons", Action::Lessons),
        ];
        for (name, action) in others {
            let open = counted.act(action);
            println!("  {name} {open:?}, closed {:?}", counted.act(Action::Close));
        }
        for _ in 0..8 {
            let bytes = counted.act(Action::NextMap);
            println!("  {} {bytes:?}", counted.app.map().name());
        }
        counted.act(Action::Contrast);
        counted.act(Action::Contrast);
        if found
            .iter()
            .zip(bounds)
            .any(|([found, _], bound)| *found > bound)
        {
            beyond.push((depth, found, bounds));
        }
        counted.bytes();
        assert_eq!(counted.bytes()[0], 0, "nothing has changed");
    }
    assert!(beyond.is_empty(), "{beyond:#?}");
}

/// Letters two columns wide, and what they hid, come and go.
#[test]
fn wide_letters_leave_nothing_behind() {
    let wire = Wire::default();
    let size = Size::new(12, 2);
    let area = Rect::from((ratatui::layout::Position::ORIGIN, size));
    let line = TerminalLine::new(wire.clone(), size);
    let viewport = Viewport::Fixed(area);
    let mut terminal = Terminal::with_options(line, TerminalOptions { viewport }).unwrap();
    let mut parser = vt100::Parser::new(2, 12, 0);
    for text in [
        "abcdefghij",
        "ab齿轮ghij",
        "x",
        "齿轮齿轮齿轮",
        "abcdefghijkl",
        "  c   g  j",
        "",
    ] {
        terminal
            .draw(|frame| {
                let buffer: &mut Buffer = frame.buffer_mut();
                buffer.set_string(0, 0, text, Color::Red);
                buffer.set_string(0, 1, text, Color::Reset);
            })
            .unwrap();
        parser.process(&std::mem::take(&mut *wire.0.lock().unwrap()));
        let contents = parser.screen().contents();
        let lines: Vec<&str> = contents.lines().map(str::trim_end).collect();
        let expected = if text.is_empty() {
            vec![]
        } else {
            vec![text; 2]
        };
        assert_eq!(lines, expected);
    }
}

/// A line of 9600 baud in 256 colours, which is set to that: a key's answer comes soon, whatever the map does.
#[test]
fn a_line_of_9600_baud_answers_soon() {
    let program = env!("CARGO_BIN_EXE_asperity");
    let mut shell = Shell::open(program, &[]);
    shell.resize(80, 24);
    shell.press("stty 9600\n");
    // 960 bytes a second.
    shell
        .lag_ms
        .store(4267, std::sync::atomic::Ordering::Relaxed);
    let began = Instant::now();
    shell.explore(
        "\"$ASPERITY\" explore --no-record --threads 1 --set grid.nodes=65 --set stress.depths=8",
    );
    println!("start after {:.1?}", began.elapsed());
    shell.see("residual");
    let mut longest = [0.0_f64; 3];
    for turn in 0..3 {
        std::thread::sleep(std::time::Duration::from_millis(2700));
        let mut time = |keys: &str, ready: &dyn Fn(&str) -> bool| {
            let pressed = Instant::now();
            shell.press(keys);
            shell.wait(keys, |screen| ready(&screen.contents()));
            pressed.elapsed().as_secs_f64()
        };
        let target = format!("{:.2}", 0.55 + 0.05 * f64::from(turn));
        let knob = time("l", &|text| text.contains(&target));
        let help = time("?", &|text| {
            text.contains("choose a knob") && text.contains("? closes")
        });
        let closed = time("?", &|text| {
            text.contains("smooth rolling") && !text.contains("choose a knob")
        });
        for (longest, found) in longest.iter_mut().zip([knob, help, closed]) {
            *longest = longest.max(found);
        }
    }
    println!(
        "longest of three: knob {:.1} s, help {:.1} s, help closed {:.1} s",
        longest[0], longest[1], longest[2]
    );
    shell.lag_ms.store(0, std::sync::atomic::Ordering::Relaxed);
    shell.press("q");
    shell.is_given_back("READY>");
    // It was 13 s for the help, when a map's colours and marks of empty frames filled the line.
    let bounds = [3.0, 4.5, 7.0];
    let within = longest
        .iter()
        .zip(bounds)
        .all(|(found, bound)| *found < bound);
    assert!(within, "{longest:?}");
}
