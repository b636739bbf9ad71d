//! `asperity study`: progress on stderr, the report on stdout and, where asked for, in files.

use std::path::Path;

use asperity_engine::files::write_whole;
use asperity_study::accuracy::{
    DEFAULT_PART, accuracy, accuracy_table, accuracy_text, default_scene, default_scene_text,
    life_plot, work_precision_plot,
};
use asperity_study::evidence::{
    agreement_plot, evidence, evidence_table, evidence_text, experiments_plot,
};
use asperity_study::stability::{stability, stability_table, stability_text};
use asperity_study::{Extent, StudyError, machine, scaling, scaling_text};
use indicatif::{ProgressBar, ProgressStyle};

use super::args::{StudyArgs, StudyKind};
use super::failure::Failure;
use super::scenes::print;

/// What a study leaves: files by name, the report first.
struct StudyFiles {
    files: Vec<(String, String)>,
    passes: bool,
}

/// Runs a study, prints its report and writes its files.
pub(crate) fn study(args: &StudyArgs) -> Result<u8, Failure> {
    refuse_what_is_not_read(args)?;
    let bar = Bar::new();
    let report = match args.kind {
        StudyKind::Accuracy => accurate(args, &bar),
        StudyKind::Stability => stable(args, &bar),
        StudyKind::Scaling => scales(args, &bar),
        StudyKind::Evidence => shows(args, &bar),
    };
    bar.0.finish_and_clear();
    let report = report.map_err(|error| Failure::input(miette::miette!("{error}")))?;
    if let Some((_, text)) = report.files.first() {
        print(text)?;
    }
    if let Some(folder) = &args.out {
        write(folder, &report.files)?;
    }
    Ok(if report.passes { 0 } else { 2 })
}

/// Options that a study has no use for.
fn refuse_what_is_not_read(args: &StudyArgs) -> Result<(), Failure> {
    let refused = match args.kind {
        StudyKind::Accuracy
            if args
                .only
                .as_deref()
                .is_some_and(|part| !DEFAULT_PART.contains(part)) =>
        {
            "--only: this study's parts belong together, but for --only default; stability, scaling and evidence take any"
        }
        StudyKind::Scaling if args.threads.is_some() => {
            "--threads: this study compares one thread with two; to have cases of one only: --only \"1 threads\""
        }
        _ => return Ok(()),
    };
    Err(Failure::input(miette::miette!("{refused}")))
}

fn accurate(args: &StudyArgs, bar: &Bar) -> Result<StudyFiles, StudyError> {
    if args.only.is_some() {
        return default_alone(args, bar);
    }
    let result = accuracy(extent(args), args.threads(), &mut |name, n, all| {
        bar.tell(name, n, all);
    })?;
    let text = headed("Accuracy", args, &accuracy_text(&result));
    let mut files = vec![
        ("accuracy.md".to_owned(), text),
        ("accuracy.csv".to_owned(), accuracy_table(&result).csv()),
    ];
    for (name, plot) in [
        ("work_precision.svg", work_precision_plot(&result)),
        ("life_error.svg", life_plot(&result)),
    ] {
        files.push((name.to_owned(), plot.map_err(StudyError::Plot)?));
    }
    Ok(StudyFiles {
        files,
        passes: result.passes(),
    })
}

/// The part of the accuracy that stands alone.
fn default_alone(args: &StudyArgs, bar: &Bar) -> Result<StudyFiles, StudyError> {
    let runs = default_scene(extent(args), args.threads(), &mut |name, n, all| {
        bar.tell(name, n, all);
    })?;
    let text = headed("Default scene", args, &default_scene_text(&runs));
    Ok(StudyFiles {
        files: vec![("default_scene.md".to_owned(), text)],
        passes: true,
    })
}

fn stable(args: &StudyArgs, bar: &Bar) -> Result<StudyFiles, StudyError> {
    let only = args.only.as_deref();
    let result = stability(extent(args), only, args.threads(), &mut |name, n, all| {
        bar.tell(name, n, all);
    })?;
    let text = stability_text(&result);
    Ok(StudyFiles {
        files: vec![
            ("stability.md".to_owned(), headed("Stability", args, &text)),
            ("stability.csv".to_owned(), stability_table(&result).csv()),
        ],
        passes: result.passes(),
    })
}

fn scales(args: &StudyArgs, bar: &Bar) -> Result<StudyFiles, StudyError> {
    let only = args.only.as_deref();
    let rows = scaling(extent(args), only, &mut |name, n, all| {
        bar.tell(name, n, all);
    })?;
    let text = headed("Scaling", args, &scaling_text(&rows));
    Ok(StudyFiles {
        files: vec![("scaling.md".to_owned(), text)],
        passes: rows.iter().all(|row| row.failed == 0),
    })
}

fn shows(args: &StudyArgs, bar: &Bar) -> Result<StudyFiles, StudyError> {
    let only = args.only.as_deref();
    let result = evidence(extent(args), only, args.threads(), &mut |name, n, all| {
        bar.tell(name, n, all);
    })?;
    let text = headed("Evidence", args, &evidence_text(&result));
    let mut files = vec![
        ("evidence.md".to_owned(), text),
        ("evidence.csv".to_owned(), evidence_table(&result).csv()),
        (
            "evidence.svg".to_owned(),
            agreement_plot(&result).map_err(StudyError::Plot)?,
        ),
    ];
    files.extend(experiments_plot(&result).map_err(StudyError::Plot)?);
    Ok(StudyFiles {
        files,
        passes: result.passes(),
    })
}

fn extent(args: &StudyArgs) -> Extent {
    match (args.quick, args.full) {
        (true, _) => Extent::Quick,
        (_, true) => Extent::Full,
        _ => Extent::Usual,
    }
}

/// The report under its title, with the command that makes it and the machine that made it.
fn headed(title: &str, args: &StudyArgs, text: &str) -> String {
    format!(
        "# {title}\n\n`{}`, asperity {}, on {}, {} threads.\n\n{text}",
        args.command(),
        asperity_session::program::VERSION,
        machine(),
        args.threads(),
    )
}

fn write(folder: &Path, files: &[(String, String)]) -> Result<(), Failure> {
    let failed = |path: &Path, error: &std::io::Error| {
        Failure::output(miette::miette!("{}: {error}", path.display()))
    };
    std::fs::create_dir_all(folder).map_err(|error| failed(folder, &error))?;
    for (name, text) in files {
        let path = folder.join(name);
        let written = write_whole(&path, true, |at| std::fs::write(at, text));
        written.map_err(|error| failed(&path, &error))?;
    }
    Ok(())
}

/// The progress bar; it draws on a terminal only.
struct Bar(ProgressBar);

impl Bar {
    fn new() -> Self {
        let bar = ProgressBar::new(0);
        if let Ok(style) = ProgressStyle::with_template("{bar:30} {pos}/{len} {msg} {elapsed}") {
            bar.set_style(style);
        }
        Self(bar)
    }

    fn tell(&self, name: &str, done: usize, all: usize) {
        self.0.set_length(all as u64);
        self.0.set_position(done as u64);
        self.0.set_message(name.to_owned());
    }
}
