//! The binary: reads the command line, runs, says what happened.

mod cli;
#[cfg(doc)]
pub mod guide;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::main(asperity_session::run::Session::start)
}
