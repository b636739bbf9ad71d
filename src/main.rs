//! The binary: reads the command line, runs, says what happened.

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::main(asperity::run::Session::start)
}
