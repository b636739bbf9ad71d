//! The command line. Exit codes: 0 converged; 1 bad input; 2 the run ended but some steps did not
//! converge; 3 it stalled; 4 an output failed; 5 it was stopped before its end.

mod args;
#[cfg(feature = "rerun")]
mod beside;
#[cfg(feature = "tui")]
mod explore;
#[cfg(feature = "rerun")]
mod export;
mod failure;
mod live;
mod names;
mod outputs;
mod page;
mod repeat;
mod report;
mod run;
mod scenes;
#[cfg(feature = "tui")]
mod shown;
mod signals;
mod study;
mod surface;
mod sweep;
mod view;

use std::io::IsTerminal as _;
use std::process::ExitCode;

use clap::Parser as _;

use args::{Cli, CliCommand, RunArgs};
use asperity_session::run::{Request, RunError, Session};
use failure::Failure;

/// What the explorer runs: [`Session::start`]. A test puts in an engine that breaks (`tests/broken_engine.rs`).
pub(crate) type Engine = fn(Request) -> Result<Session, RunError>;

/// Reads the command line and does what it says.
pub(crate) fn main(engine: Engine) -> ExitCode {
    failure::install();
    signals::let_limits_of_size_be_errors();
    start_tracing();
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => {
            // Help and version come this way too, with exit code 0.
            return failure::answer(&error);
        }
    };
    match dispatch(cli.command.unwrap_or_else(bare), engine) {
        Ok(code) => ExitCode::from(code),
        Err(failure) => failure.report(),
    }
}

fn dispatch(command: CliCommand, engine: Engine) -> Result<u8, Failure> {
    match command {
        CliCommand::Run(args) => run::run(&args),
        CliCommand::Explore { run, lesson } => explore(&run, lesson.as_deref(), engine),
        CliCommand::Check(args) => scenes::check(&args),
        CliCommand::Scenes { name } => scenes::scenes(name.as_deref()),
        CliCommand::Surface(args) => surface::surface(&args),
        CliCommand::Study(args) => study::study(&args),
        CliCommand::Sweep(args) => sweep::sweep(&args),
        #[cfg(feature = "rerun")]
        CliCommand::Compare(args) => beside::compare(&args),
        #[cfg(feature = "rerun")]
        CliCommand::Export(args) => export::export(&args),
        #[cfg(not(feature = "rerun"))]
        CliCommand::Compare(_) | CliCommand::Export(_) => {
            Err(Failure::without_recorder("reads no recordings"))
        }
        CliCommand::Report(args) => page::report(&args),
        CliCommand::View { file } => view::view(&file),
    }
}

/// Without a word: the explorer on a terminal; elsewhere one passage, recorded to a file that belongs to it.
fn bare() -> CliCommand {
    let on_a_terminal = std::io::stdout().is_terminal() && std::io::stdin().is_terminal();
    let line = if on_a_terminal && cfg!(feature = "tui") {
        "asperity explore"
    } else if cfg!(feature = "rerun") {
        "asperity run --passages=1 --force --out=asperity.rrd"
    } else {
        "asperity run --passages=1 --force"
    };
    let command = Cli::parse_from(line.split(' ')).command;
    command.expect("a line with a command")
}

#[cfg(feature = "tui")]
fn explore(
    args: &RunArgs,
    lesson: Option<&std::path::Path>,
    engine: Engine,
) -> Result<u8, Failure> {
    explore::explore(args, lesson, engine)
}

#[cfg(not(feature = "tui"))]
fn explore(_: &RunArgs, _: Option<&std::path::Path>, _: Engine) -> Result<u8, Failure> {
    Err(Failure::input(miette::miette!(
        help = "asperity run computes the same without a screen; a build with the default features has the explorer",
        "this program was built without the feature tui, so it has no explorer"
    )))
}

/// Messages for developers, off unless `ASPERITY_LOG` asks for them (such as `ASPERITY_LOG=debug`).
fn start_tracing() {
    use tracing_subscriber::EnvFilter;
    if std::env::var_os("ASPERITY_LOG").is_some() {
        tracing_subscriber::fmt()
            .with_env_filter(EnvFilter::from_env("ASPERITY_LOG"))
            .with_writer(std::io::stderr)
            .init();
    }
}
