//! The explorer in a terminal of its own: a shell in a pseudo-terminal starts the binary, as a person would.
//! Whatever ends it, the shell has its terminal back.
#![cfg(all(feature = "tui", unix))]
#![expect(clippy::unwrap_used, reason = "tests")]

use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use crate::common::pty::{PATIENCE, Terminal};
use vt100::Screen;

/// A contact that starts within a second or so.
const SMALL: &str = "--no-record --threads 1 --set grid.nodes=65 --set stress.depths=8";

fn open(variables: &[(&str, &str)]) -> Terminal {
    Terminal::open(env!("CARGO_BIN_EXE_asperity"), variables)
}

fn run(arguments: &str) -> String {
    format!("\"$ASPERITY\" explore {arguments}; echo code=$?")
}

#[test]
fn it_starts_hears_keys_fits_every_size_and_quits() {
    let mut terminal = open(&[("COLORTERM", "truecolor")]);
    let began = Instant::now();
    terminal.explore(&run(SMALL));
    println!(
        "first frame after {:.0?} (a shell included)",
        began.elapsed()
    );
    terminal.see("S slide-to-roll");
    terminal.press("?");
    terminal.see("choose a knob");
    terminal.press("?");
    terminal.wait("knob", |screen| screen.contents().contains("0.50"));
    terminal.press("\x1b[C");
    terminal.wait("turned knob", |screen| screen.contents().contains("0.55"));
    for (cols, rows) in [(300, 100), (60, 20), (59, 20), (10, 3), (160, 48), (80, 24)] {
        terminal.resize(cols, rows);
        if cols < 60 {
            terminal.wait("refusal", |screen| screen.contents().contains("too"));
        } else {
            terminal.wait("right edge", |screen| {
                screen.size() == (rows, cols) && screen.contents().contains("smooth rolling")
            });
        }
    }
    terminal.press("q");
    terminal.see("code=0");
    terminal.is_given_back("code=0");
}

#[test]
fn control_c_and_a_request_to_end_are_ways_to_quit() {
    let mut terminal = open(&[]);
    terminal.explore(&run(SMALL));
    terminal.press("\x03");
    terminal.see("code=0");
    terminal.is_given_back("code=0");
    for signal in ["TERM", "INT"] {
        // Another shell sends it, from the background.
        terminal.explore(&format!(
            "(sleep 2; kill -{signal} $(cat pid)) & sh -c 'echo $$ > pid; exec \"$ASPERITY\" explore {SMALL}'; echo code=$?"
        ));
        terminal.see("code=0");
        terminal.is_given_back("code=0");
    }
}

#[test]
fn control_z_hands_the_terminal_over_and_fg_brings_it_back() {
    let mut terminal = open(&[]);
    terminal.explore(&format!("\"$ASPERITY\" explore {SMALL}"));
    terminal.press("\x1a");
    terminal.prompt();
    terminal.press("echo at the shell | tr a-z A-Z\n");
    terminal.see("AT THE SHELL");
    terminal.press("fg\n");
    terminal.wait("explorer again", |screen| {
        screen.alternate_screen() && screen.contents().contains("smooth rolling")
    });
    terminal.press("q");
    terminal.is_given_back("READY>");
}

#[test]
fn plain_terminals_are_served_and_dumb_ones_told() {
    let mut terminal = open(&[("NO_COLOR", "1"), ("TERM", "vt100"), ("LANG", "C")]);
    terminal.explore(&run(SMALL));
    let text = terminal.text();
    assert!(text.is_ascii(), "{text}");
    terminal.press("q");
    terminal.see("code=0");
    let colored = |screen: &Screen| {
        let (rows, cols) = screen.size();
        let cells = (0..rows).flat_map(|row| (0..cols).map(move |col| (row, col)));
        cells
            .filter_map(|(row, col)| screen.cell(row, col))
            .any(|cell| cell.fgcolor() != vt100::Color::Default)
    };
    assert!(!colored(terminal.parser.lock().unwrap().screen()));
    let dumb = format!("TERM=dumb {}", run(SMALL));
    terminal.press(&format!("clear; {dumb}\n"));
    terminal.see("code=1");
    let text = terminal.text();
    assert!(text.contains("asperity run"), "{text}");
}

/// A key pressed in the moment in which the window changes its size is heard: an edge-triggered wait, told of both,
/// answers with the size and leaves the key unread until the next one.
#[test]
fn a_key_beside_a_new_size_is_heard() {
    let mut terminal = open(&[]);
    terminal.explore(&run(SMALL));
    terminal.see("S slide-to-roll");
    for turn in 0..200_u16 {
        terminal.resize(80 + turn % 2, 24);
        terminal.press("?");
        let help = turn % 2 == 0;
        terminal.wait("help turned", |screen| {
            screen.contents().contains("choose a knob") == help
        });
    }
    terminal.press("q");
    terminal.is_given_back("code=0");
}

/// A run that waits changes nothing on its screen, and nothing is written; a key is still heard.
#[test]
fn a_screen_that_does_not_change_is_not_written() {
    let mut terminal = open(&[("COLORTERM", "truecolor")]);
    terminal.explore(&run(SMALL));
    terminal.wait("passage", |screen| screen.contents().contains("passage "));
    terminal.press(" ");
    terminal.wait("pause", |screen| !screen.contents().contains("steps/s"));
    let received = |terminal: &Terminal| terminal.received.load(Ordering::Relaxed);
    // The step that was under way, and messages, end within seconds.
    let until = Instant::now() + PATIENCE;
    loop {
        let before = received(&terminal);
        std::thread::sleep(Duration::from_secs(1));
        if received(&terminal) == before {
            break;
        }
        assert!(Instant::now() < until, "{}", terminal.text());
    }
    terminal.press("?");
    terminal.see("choose a knob");
    terminal.press("?q");
    terminal.is_given_back("code=0");
}

/// A slow line, 100 kB/s: frames are skipped, not queued, so that what is pressed is seen soon, and the end comes.
#[test]
fn a_slow_line_is_no_hang() {
    let mut terminal = open(&[("COLORTERM", "truecolor")]);
    terminal.resize(160, 48);
    terminal.explore(&run(SMALL));
    terminal.lag_ms.store(40, Ordering::Relaxed);
    for _ in 0..10 {
        terminal.press("l");
    }
    terminal.see("1.00");
    terminal.press("?");
    terminal.see("choose a knob");
    terminal.press("?q");
    terminal.see("code=0");
    terminal.is_given_back("code=0");
}

/// The window is closed: nobody reads or writes any more. The program ends by itself.
#[test]
fn a_terminal_that_vanishes_ends_it() {
    let mut terminal = open(&[]);
    terminal.explore(&format!(
        "sh -c 'echo $$ > pid; exec \"$ASPERITY\" explore {SMALL}'"
    ));
    let pid = std::fs::read_to_string(terminal.folder.path().join("pid")).unwrap();
    let alive = || {
        let mut kill = std::process::Command::new("kill");
        kill.args(["-0", pid.trim()])
            .stderr(std::process::Stdio::null());
        kill.status().unwrap().success()
    };
    assert!(alive());
    drop(terminal.keys.take());
    drop(terminal.master.take());
    // The reader thread holds a copy of the terminal: the shell's end is what hangs it up.
    drop(terminal.shell.kill());
    drop(terminal.shell.wait());
    let until = Instant::now() + PATIENCE;
    while alive() {
        assert!(Instant::now() < until, "it still runs");
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// Printed for a quiet machine: frames a second of the screen at 80 x 24 and 160 x 48 with the default scene on all cores, and
/// how long a key takes to the screen. A frame is a burst of bytes with a pause before it.
#[test]
#[ignore = "prints times"]
fn frames_a_second_and_input_to_screen() {
    for (cols, rows) in [(80, 24), (160, 48)] {
        println!("{cols} x {rows}");
        print_times_at(cols, rows);
    }
}

fn print_times_at(cols: u16, rows: u16) {
    let mut terminal = open(&[("COLORTERM", "truecolor")]);
    terminal.resize(cols, rows);
    let began = Instant::now();
    terminal.explore("\"$ASPERITY\" explore --no-record");
    println!(
        "first frame after {:.0?} (a shell included)",
        began.elapsed()
    );
    // No replay: the run keeps all cores busy.
    terminal.wait("passage", |screen| screen.contents().contains("passage 0."));
    let (mut frames, mut last, began) = (0, String::new(), Instant::now());
    let mut longest = Duration::ZERO;
    let mut since = Instant::now();
    while began.elapsed() < Duration::from_secs(3) {
        let now = terminal.text();
        if now != last {
            frames += 1;
            longest = longest.max(since.elapsed());
            since = Instant::now();
            last = now;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    println!(
        "frames that changed: {:.1} a second, longest pause {longest:.0?}",
        f64::from(frames) / began.elapsed().as_secs_f64()
    );
    let mut waits: Vec<Duration> = Vec::new();
    for press in 0..200 {
        // The speed's dial, up and down, so that nothing is far from home.
        let (key, shown) = if press % 2 == 0 {
            ("l", "0.55")
        } else {
            ("h", "0.50")
        };
        let pressed = Instant::now();
        terminal.press(key);
        terminal.wait("value", |screen| {
            let text = screen.contents();
            let mut lines = text.lines();
            lines.any(|line| line.contains("▸S") && line.contains(shown))
        });
        waits.push(pressed.elapsed());
        std::thread::sleep(Duration::from_millis(7 + press % 13));
    }
    waits.sort_unstable();
    println!(
        "key to screen: median {:.1?}, p99 {:.1?}, longest {:.1?}",
        waits[100], waits[197], waits[199]
    );
    terminal.press("q");
}
