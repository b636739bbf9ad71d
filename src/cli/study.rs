//! `asperity study`: progress on stderr, the report on stdout and, where asked for, in files.

use std::path::Path;
use std::time::{Duration, Instant};

use asperity_engine::files::write_whole;
use asperity_study::accuracy::accuracy;
use asperity_study::bands::{bands, bands_report};
use asperity_study::evidence::{
    agreement_plot, evidence, evidence_table, evidence_text, experiments_plot, kept_in,
};
use asperity_study::heat::{heat, heat_report};
use asperity_study::scaling::{scaling, scaling_report};
use asperity_study::stability::{stability, stability_report};
use asperity_study::story::{story, story_report};
use asperity_study::wear::{wear, wear_report};
use asperity_study::{Extent, Report, StudyError, StudyProgress, machine};
use indicatif::{ProgressBar, ProgressStyle};

use super::args::{StudyArgs, StudyKind};
use super::failure::{Failure, tell};
use super::scenes::print;

/// After which a study without a terminal tells where it is.
const SILENCE: Duration = Duration::from_mins(1);

/// Title of the study that keeps what it has found.
const EVIDENCE: &str = "Evidence";

/// Runs a study, prints its report and writes its files.
pub(crate) fn study(args: &StudyArgs) -> Result<u8, Failure> {
    if args.kind == StudyKind::Scaling && args.threads.is_some() {
        return Err(Failure::input(miette::miette!(
            "--threads: this study compares one thread with two; to have cases of one only: --only \"1 threads\""
        )));
    }
    if args.kind != StudyKind::Stability && !args.set.is_empty() {
        return Err(Failure::input(miette::miette!(
            "--set: goes with `asperity study stability`; the scenes of the other studies are what they are compared for"
        )));
    }
    let bar = ProgressBar::new(0);
    if let Ok(style) = ProgressStyle::with_template("{bar:30} {pos}/{len} {msg} {elapsed}") {
        bar.set_style(style);
    }
    let mut heard = Instant::now();
    let report = measured(args, &mut |name, done, all| {
        if bar.is_hidden() && heard.elapsed() > SILENCE {
            heard = Instant::now();
            tell(&format!("{done} of {all}: {name}"));
        }
        bar.set_length(all as u64);
        bar.set_position(done as u64);
        bar.set_message(name.to_owned());
    });
    bar.finish_and_clear();
    let report = report.map_err(|error| Failure::input(miette::miette!("{error}")))?;
    // The command that makes it and the machine that made it stand under the title.
    let text = format!(
        "# {}\n\n`{}`, asperity {}, on {}, {} threads.\n\n{}",
        report.title,
        args.command(),
        asperity_session::program::VERSION,
        machine(),
        args.threads(),
        report.text,
    );
    print(&text)?;
    if let Some(folder) = &args.out {
        write(folder, text, &report)?;
    }
    Ok(if report.passes { 0 } else { 2 })
}

fn measured(args: &StudyArgs, progress: &mut StudyProgress) -> Result<Report, StudyError> {
    let extent = match (args.quick, args.full) {
        (true, _) => Extent::Quick,
        (_, true) => Extent::Full,
        _ => Extent::Usual,
    };
    let (only, threads) = (args.only.as_deref(), args.threads());
    match args.kind {
        StudyKind::Accuracy => accuracy(extent, only, threads, progress)?.report(),
        StudyKind::Stability => Ok(stability_report(&stability(
            extent, only, &args.set, threads, progress,
        )?)),
        StudyKind::Scaling => Ok(scaling_report(&scaling(extent, only, progress)?)),
        StudyKind::Bands => Ok(bands_report(&bands(extent, only, threads, progress)?)),
        StudyKind::Heat => Ok(heat_report(&heat(extent, only, threads, progress)?)),
        StudyKind::Story => Ok(story_report(&story(extent, only, threads, progress)?)),
        StudyKind::Wear => Ok(wear_report(&wear(extent, only, threads, progress)?)),
        StudyKind::Evidence => {
            let result = evidence(extent, only, threads, args.out.as_deref(), progress)?;
            let agreement = agreement_plot(&result).map_err(StudyError::Plot)?;
            let mut plots = vec![("evidence.svg".to_owned(), agreement)];
            plots.extend(experiments_plot(&result).map_err(StudyError::Plot)?);
            Ok(Report {
                title: EVIDENCE,
                text: evidence_text(&result),
                table: evidence_table(&result),
                plots,
                passes: result.passes(),
            })
        }
    }
}

/// Writes the report, its rows and its plots to the folder.
fn write(folder: &Path, text: String, report: &Report) -> Result<(), Failure> {
    let name = report.title.to_lowercase();
    let mut files = vec![
        (format!("{name}.md"), text),
        (format!("{name}.csv"), report.table.csv()),
    ];
    files.extend(report.plots.iter().cloned());
    let failed = |path: &Path, error: &std::io::Error| {
        Failure::output(miette::miette!("{}: {error}", path.display()))
    };
    std::fs::create_dir_all(folder).map_err(|error| failed(folder, &error))?;
    for (name, text) in files {
        let path = folder.join(name);
        let written = write_whole(&path, true, |at| std::fs::write(at, text));
        written.map_err(|error| failed(&path, &error))?;
    }
    // The report holds it all now.
    if report.title == EVIDENCE {
        drop(std::fs::remove_file(kept_in(folder)));
    }
    Ok(())
}
