//! A programming error in the engine, seen from a terminal: the same command line as the program's, with an
//! engine that panics in its 40th step. The screen says so and stays, the terminal is given back, what was
//! written is whole, the exit code is 3.
//!
//! Started with `explore` this is that program; started without, it is the test of it (`harness = false`).
#![cfg_attr(
    not(all(feature = "tui", unix)),
    expect(unused, reason = "nothing to test without the screen")
)]
#![expect(clippy::unwrap_used, reason = "tests")]

// A test program without a harness leaves the unit tests of these files out, and their lints with nothing to see.
#[allow(
    unused_imports,
    unfulfilled_lint_expectations,
    reason = "unit tests that are left out"
)]
#[path = "../src/cli/mod.rs"]
mod cli;
#[cfg(all(feature = "tui", unix))]
mod common;

use std::process::{ExitCode, Termination as _};

use asperity_engine::sim::Simulation;
use asperity_session::run::{Request, RunError, Session};

/// Steps of the passage that go well.
const GOOD: u64 = 39;

fn breaking(request: Request) -> Result<Session, RunError> {
    let (plan, threads) = (request.plan.clone(), request.threads);
    let make = move |scene: &_| Simulation::new(scene, plan, threads);
    Session::start_with(request, make, |sim| {
        assert!(sim.passage_steps() < GOOD, "a fault put in on purpose");
        sim.step()
    })
}

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let first = arguments.next();
    if first.as_deref() == Some("explore") {
        return cli::main(breaking);
    }
    // `--list` and `--ignored` are the test runner's questions; nothing here is ignored.
    if ["--list", "--ignored"]
        .iter()
        .any(|word| first.as_deref() == Some(word))
    {
        return ExitCode::SUCCESS;
    }
    #[cfg(all(feature = "tui", unix))]
    {
        test::a_panic_of_the_engine_is_shown_and_leaves_everything_whole();
        test::another_scene_runs_after_a_panic_and_the_exit_code_tells();
        println!("test result: ok. 2 passed");
    }
    ().report()
}

#[cfg(all(feature = "tui", unix))]
mod test {
    use super::GOOD;
    use super::common::pty::Terminal;

    const SMALL: &str = "--threads 1 --set grid.nodes=65 --set stress.depths=8";

    fn open() -> Terminal {
        let own = std::env::current_exe().unwrap();
        Terminal::open(own.to_str().unwrap(), &[])
    }

    fn start(terminal: &mut Terminal, more: &str) {
        terminal.explore(&format!(
            "\"$ASPERITY\" explore {SMALL} {more}; echo code=$?"
        ));
        terminal.see("the run failed");
        terminal.see("a fault put in on purpose");
    }

    /// Whole rows, one a step, up to the last good one.
    fn table_is_whole(terminal: &Terminal) {
        let text = std::fs::read_to_string(terminal.folder.path().join("table.csv")).unwrap();
        assert!(text.ends_with('\n'));
        let mut lines = text.lines();
        let columns = lines.next().unwrap().split(',').count();
        let rows: Vec<&str> = lines.collect();
        assert_eq!(rows.len() as u64, GOOD);
        assert!(rows.iter().all(|row| row.split(',').count() == columns));
    }

    /// Every recording decodes to its end and has the steps that were made.
    #[cfg(feature = "rerun")]
    fn recordings_are_whole(terminal: &Terminal, files: usize) {
        use re_log_encoding::DecoderApp;
        let folder = terminal.folder.path().join("recordings");
        let paths: Vec<_> = std::fs::read_dir(folder).unwrap().collect();
        assert_eq!(paths.len(), files);
        for path in paths {
            let file = std::fs::File::open(path.unwrap().path()).unwrap();
            let reader = std::io::BufReader::new(file);
            let messages = DecoderApp::decode_eager(reader).unwrap();
            let read = messages.inspect(|message| assert!(message.is_ok())).count();
            assert!(read > GOOD as usize / 8, "{read} messages");
        }
    }

    #[cfg(not(feature = "rerun"))]
    fn recordings_are_whole(_terminal: &Terminal, _files: usize) {}

    pub(crate) fn a_panic_of_the_engine_is_shown_and_leaves_everything_whole() {
        let mut terminal = open();
        start(&mut terminal, "--table table.csv");
        // The last frame can be looked at; keys are heard.
        terminal.press("\x1b");
        terminal.wait("closed panel", |screen| {
            !screen.contents().contains("the run failed")
        });
        terminal.press("?");
        terminal.see("choose a knob");
        terminal.press("?q");
        terminal.see("code=3");
        let text = terminal.text();
        assert!(text.contains("programming error"), "{text}");
        terminal.is_given_back("code=3");
        table_is_whole(&terminal);
        recordings_are_whole(&terminal, 1);
    }

    pub(crate) fn another_scene_runs_after_a_panic_and_the_exit_code_tells() {
        let mut terminal = open();
        start(&mut terminal, "");
        // The same scene again: a new run, whose fault is its own.
        // `e` alone would do; Escape at once before it would be Alt-e to any terminal.
        terminal.press("e");
        terminal.see("change the scene");
        terminal.press("\r");
        terminal.wait("new run", |screen| {
            let text = screen.contents();
            !text.contains("the run failed") && text.contains("start")
        });
        terminal.see("the run failed");
        terminal.press("q");
        terminal.see("code=3");
        terminal.is_given_back("code=3");
        recordings_are_whole(&terminal, 2);
    }
}
