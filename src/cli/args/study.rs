//! Words of studies.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

/// What to study.
#[derive(Debug, Args)]
pub(crate) struct StudyArgs {
    /// Which study
    #[arg(value_enum)]
    pub(crate) kind: StudyKind,
    /// The smallest set of cases
    #[arg(long, conflicts_with = "full")]
    pub(crate) quick: bool,
    /// The largest set of cases
    #[arg(long)]
    pub(crate) full: bool,
    /// Folder for the report's files; created if missing. Evidence, which takes hours, keeps there what it has found, and goes on from it
    #[arg(long, value_name = "FOLDER")]
    pub(crate) out: Option<PathBuf>,
    /// Only cases whose name or group contains this text
    #[arg(long, value_name = "TEXT")]
    pub(crate) only: Option<String>,
    /// A key set in every case of the stability study, such as heat.viscosity_temperature_exponent=1.1; repeatable
    #[arg(long, value_name = "KEY=VALUE")]
    pub(crate) set: Vec<String>,
    /// Cores to use [default: all]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub(crate) threads: Option<u16>,
}

impl StudyArgs {
    /// Cores to use.
    pub(crate) fn threads(&self) -> usize {
        super::threads(self.threads)
    }

    /// The command that prints this report again, less the folder it goes to.
    pub(crate) fn command(&self) -> String {
        let kind = self.kind.to_possible_value();
        let form = match (self.quick, self.full) {
            (true, _) => Some("--quick".to_owned()),
            (_, true) => Some("--full".to_owned()),
            _ => None,
        };
        let quoted =
            |word: &str, text: &String| format!("--{word} '{}'", text.replace('\'', r"'\''"));
        let sets = self.set.iter().map(|set| Some(quoted("set", set)));
        let words = [
            Some("asperity study".to_owned()),
            kind.map(|kind| kind.get_name().to_owned()),
            form,
            self.only.as_ref().map(|only| quoted("only", only)),
            self.threads.map(|threads| format!("--threads {threads}")),
        ];
        words
            .into_iter()
            .chain(sets)
            .flatten()
            .collect::<Vec<_>>()
            .join(" ")
    }
}

/// The studies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum StudyKind {
    /// Error against run time, part by part
    Accuracy,
    /// Whether bands hold a mesh twice as fine and a run four times as long, over presets and scenes drawn around them
    Bands,
    /// Stiff and extreme cases: each converges or is named
    Stability,
    /// Cost of a step by grid, symmetry, threads and regime
    Scaling,
    /// Published tables and experiments beside what is found here; each row is a scene: asperity run evidence/NAME
    Evidence,
    /// What heat does to friction, film and life of the presets that slide, beside closed forms
    Heat,
    /// Life of the first scene against S on every mesh, by both counts, with what takes it
    Story,
    /// Pits after ten million cycles without wear and with it, against S, lambda and along a tooth, beside what was published
    Wear,
}

#[cfg(test)]
#[expect(clippy::unwrap_used, reason = "tests")]
mod tests {
    use clap::Parser;

    use super::*;
    use crate::cli::args::{Cli, CliCommand};

    #[test]
    fn the_command_of_a_report_parses_back_to_the_study_that_made_it() {
        fn parsed(words: &[&str]) -> StudyArgs {
            match Cli::try_parse_from(words).unwrap().command {
                Some(CliCommand::Study(args)) => args,
                other => panic!("{other:?}"),
            }
        }

        /// What a shell makes of the line, words and single quotes only.
        fn split(line: &str) -> Vec<String> {
            let mut words = vec![String::new()];
            let mut is_quoted = false;
            let mut letters = line.chars();
            while let Some(letter) = letters.next() {
                match letter {
                    '\'' => is_quoted = !is_quoted,
                    '\\' if !is_quoted => words.last_mut().unwrap().extend(letters.next()),
                    ' ' if !is_quoted => words.push(String::new()),
                    _ => words.last_mut().unwrap().push(letter),
                }
            }
            words
        }

        for kind in StudyKind::value_variants() {
            let name = kind.to_possible_value().unwrap();
            for form in [None, Some("--quick"), Some("--full")] {
                for more in [
                    &[][..],
                    &["--only", "1 thread's"],
                    &["--threads", "2"],
                    &["--set", "a=1", "--set", "title='x'"],
                ] {
                    let mut words = vec!["asperity", "study", name.get_name()];
                    words.extend(form);
                    words.extend(more);
                    let args = parsed(&words);
                    let line = split(&args.command());
                    let again = parsed(&line.iter().map(String::as_str).collect::<Vec<_>>());
                    assert_eq!(format!("{args:?}"), format!("{again:?}"));
                }
            }
        }
    }
}
