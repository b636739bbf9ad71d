//! What ends the program early: a message, a hint and an exit code.

use std::io::IsTerminal as _;
use std::process::ExitCode;

use asperity::observe::ObserveError;
use asperity::plan::PlanError;
use asperity::run::{CheckpointError, RunError};
use asperity::scene::SceneError;
use asperity::study::sweep::SweepError;
use miette::{MietteHandlerOpts, Report, miette};

/// An error with its exit code.
#[derive(Debug)]
pub(crate) struct Failure {
    code: u8,
    report: Report,
}

impl Failure {
    /// Bad input: exit code 1.
    pub(crate) fn input(report: Report) -> Self {
        Self { code: 1, report }
    }

    /// A run that broke off: exit code 3.
    pub(crate) fn stalled(report: Report) -> Self {
        Self { code: 3, report }
    }

    /// An output that failed: exit code 4.
    pub(crate) fn output(report: Report) -> Self {
        Self { code: 4, report }
    }

    /// Prints it to stderr.
    pub(crate) fn report(&self) -> ExitCode {
        say(&self.report);
        ExitCode::from(self.code)
    }
}

impl std::fmt::Display for Failure {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.report.fmt(f)?;
        if let Some(help) = self.report.help() {
            write!(f, "; {help}")?;
        }
        Ok(())
    }
}

/// Prints a report to stderr; a closed pipe is nobody's loss.
pub(crate) fn say(report: &Report) {
    use std::io::Write as _;
    let _ = writeln!(std::io::stderr(), "{report:?}");
}

/// Chooses how reports look: drawn on a terminal, plain unbroken lines elsewhere, so that scripts can search
/// them.
pub(crate) fn install() {
    let on_a_terminal = std::io::stderr().is_terminal();
    // Fails only when set twice.
    let _ = miette::set_hook(Box::new(move |_| {
        let options = if on_a_terminal {
            MietteHandlerOpts::new()
        } else {
            MietteHandlerOpts::new()
                .unicode(false)
                .color(false)
                .width(10_000)
        };
        Box::new(options.build())
    }));
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        let help = match &error {
            SceneError::Value { .. }
            | SceneError::Missing { .. }
            | SceneError::UnknownKey { .. } => {
                "asperity scenes demonstration prints every key with its meaning, unit and range"
            }
            SceneError::Override { .. } => "repeat --set for each key",
            SceneError::Syntax { .. } => {
                "asperity scenes NAME > mine.toml gives a scene to start from"
            }
            SceneError::Read { .. } | SceneError::UnknownScene { .. } => {
                "asperity scenes lists the scenes that come with the program"
            }
        };
        Self::input(miette!(code = "scene", help = help, "{error}"))
    }
}

impl From<PlanError> for Failure {
    fn from(error: PlanError) -> Self {
        Self::input(miette!(
            code = "plan",
            help = "asperity check SCENE prints the grid and the nodes of each wave",
            "{error}"
        ))
    }
}

impl From<ObserveError> for Failure {
    fn from(error: ObserveError) -> Self {
        Self::output(miette!(code = "output", "{error}"))
    }
}

impl From<CheckpointError> for Failure {
    fn from(error: CheckpointError) -> Self {
        Self::input(miette!(
            code = "state",
            help = "a run continues with the scene and settings that it was saved with; only --passages and outputs may differ",
            "{error}"
        ))
    }
}

impl From<SweepError> for Failure {
    fn from(error: SweepError) -> Self {
        match &error {
            SweepError::File { .. } | SweepError::Read { .. } => Self::input(miette!(
                code = "sweep",
                help = "asperity sweep --help explains the file, asperity sweep slide_roll --show file prints one",
                "{error}"
            )),
            SweepError::Case { .. } | SweepError::Plan { .. } => Self::input(miette!(
                code = "sweep",
                help = "every case is checked before the first runs; asperity check SCENE prints the plan of one",
                "{error}"
            )),
            SweepError::Incomplete { .. } => Self::stalled(miette!(
                code = "sweep",
                help = "asperity sweep SWEEP --resume computes what is missing",
                "{error}"
            )),
            SweepError::Folder { .. } => Self::output(miette!(code = "output", "{error}")),
            SweepError::Threads(_) => Self::stalled(miette!(code = "run", "{error}")),
        }
    }
}

impl From<RunError> for Failure {
    fn from(error: RunError) -> Self {
        Self::stalled(miette!(code = "run", "{error}"))
    }
}
