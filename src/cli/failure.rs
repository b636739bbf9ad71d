//! What ends the program early: a message, a hint and an exit code.

use std::borrow::Cow;
use std::io::IsTerminal as _;
use std::process::ExitCode;

use asperity_engine::observe::ObserveError;
use asperity_engine::plan::PlanError;
use asperity_engine::scene::SceneError;
use asperity_engine::scene::drives_a_terminal;
use asperity_session::run::{CheckpointError, RunError};
use asperity_session::sweep::SweepError;
use miette::{MietteDiagnostic, MietteHandlerOpts, Report, miette};

/// An error with its exit code.
#[derive(Debug)]
pub(crate) struct Failure {
    code: u8,
    report: Report,
}

impl Failure {
    /// Bad input: exit code 1.
    pub(crate) fn input(report: impl Into<Report>) -> Self {
        Self::new(1, &report.into())
    }

    /// What a build without the recorder does not do.
    #[cfg(not(feature = "rerun"))]
    pub(crate) fn without_recorder(what: &str) -> Self {
        Self::input(miette::miette!(
            help = "use a build with the default features",
            "this program was built without the feature rerun, so it {what}"
        ))
    }

    /// A run that broke off: exit code 3.
    pub(crate) fn stalled(report: impl Into<Report>) -> Self {
        Self::new(3, &report.into())
    }

    /// An output that failed: exit code 4.
    pub(crate) fn output(report: impl Into<Report>) -> Self {
        Self::new(4, &report.into())
    }

    /// The words may hold what a hostile file holds.
    fn new(code: u8, report: &Report) -> Self {
        let mut plain = MietteDiagnostic::new(legible(&report.to_string()));
        plain.code = report.code().map(|code| code.to_string());
        plain.help = report.help().map(|help| legible(&help.to_string()));
        let report = plain.into();
        Self { code, report }
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

/// Prints a line to stderr, such that no terminal takes it for more than text.
pub(crate) fn tell(line: &str) {
    use std::io::Write as _;
    let _ = writeln!(std::io::stderr(), "{}", legible(line));
}

/// What the command line's own reader answers: help and version to stdout, what is wrong to stderr.
pub(crate) fn answer(error: &clap::Error) -> ExitCode {
    if error.use_stderr() {
        let text = error.to_string();
        if text == legible(&text) {
            let _ = error.print();
        } else {
            tell(&text);
        }
        return ExitCode::from(1);
    }
    match error.print() {
        Err(failed) if failed.kind() != std::io::ErrorKind::BrokenPipe => {
            Failure::output(miette!("stdout: {failed}")).report()
        }
        _ => ExitCode::SUCCESS,
    }
}

/// Longest line that anybody reads, and most of them.
const LONGEST_LINE: usize = 1000;
const MOST_LINES: usize = 40;

/// Text from outside as a message may show it: no control characters, no endless lines, not too many of them.
pub(crate) fn legible(text: &str) -> String {
    let mut lines: Vec<String> = text.lines().take(MOST_LINES).map(cut).collect();
    let more = text.lines().count() - lines.len();
    if more > 0 {
        lines.push(format!("... and {more} more lines"));
    }
    let mut whole = visible(&lines.join("\n")).into_owned();
    if text.ends_with('\n') {
        whole.push('\n');
    }
    whole
}

/// The beginning of a line that is too long.
fn cut(line: &str) -> String {
    match line.char_indices().nth(LONGEST_LINE) {
        None => line.to_owned(),
        Some((at, _)) => format!("{}... ({} characters)", &line[..at], line.chars().count()),
    }
}

/// Control characters as they would be written, but ends of lines and tabs: a terminal must not obey a text.
pub(crate) fn visible(text: &str) -> Cow<'_, str> {
    let is_control = |c: char| drives_a_terminal(c) && c != '\n' && c != '\t';
    if !text.contains(is_control) {
        return Cow::Borrowed(text);
    }
    let shown = |c: char| {
        if is_control(c) {
            c.escape_default().to_string()
        } else {
            c.to_string()
        }
    };
    Cow::Owned(text.chars().map(shown).collect())
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
                help = "a thousand cases are checked before the first runs, the others when their turn comes; finished ones are kept",
                "{error}"
            )),
            SweepError::Chain { .. } => Self::input(miette!(
                code = "sweep",
                help = "asperity sweep SWEEP --show manifest lists the chains",
                "{error}"
            )),
            SweepError::Incomplete { .. } => Self::stalled(miette!(
                code = "sweep",
                help = "asperity sweep SWEEP --resume computes what is missing",
                "{error}"
            )),
            SweepError::Folder { .. } => Self::output(miette!(code = "output", "{error}")),
        }
    }
}

impl From<RunError> for Failure {
    fn from(error: RunError) -> Self {
        Self::stalled(miette!(code = "run", "{error}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_would_obey_or_choke_on_becomes_text() {
        assert_eq!(
            visible("a\x1b[31mb\u{9b}2J\r\n\tc"),
            "a\\u{1b}[31mb\\u{9b}2J\\r\n\tc"
        );
        assert!(matches!(visible("film 12 µm\n"), Cow::Borrowed(_)));
        let long = legible(&"x".repeat(100_000));
        assert!(
            long.len() < 1100 && long.ends_with("(100000 characters)"),
            "{long}"
        );
        let many = legible(&"line\n".repeat(1000));
        assert!(many.ends_with("... and 960 more lines\n"), "{many}");
    }

    #[test]
    fn code_help_and_words_of_a_failure_are_kept() {
        let failure = Failure::input(miette!(code = "scene", help = "do this", "bad \x1b[2J"));
        assert_eq!(failure.to_string(), "bad \\u{1b}[2J; do this");
        assert_eq!(
            failure
                .report
                .code()
                .map(|code| code.to_string())
                .as_deref(),
            Some("scene")
        );
    }
}
