//! `asperity run`: a scene without a screen.

use std::io::Write as _;
use std::path::PathBuf;
use std::time::Duration;

use asperity::run::{Command, End, Ending, Outcome, Request, Session};
use asperity::scene::Scene;
use indicatif::{ProgressBar, ProgressStyle};

use super::args::RunArgs;
use super::failure::Failure;
use super::outputs::{Outputs, Pace};
use super::{report, scenes};

/// Estimated time from which a progress bar is worth its line, s.
const WORTH_A_BAR_S: f64 = 2.0;
/// How often the bar looks.
const LOOK: Duration = Duration::from_millis(50);

/// Runs a scene and writes what was asked for.
pub(crate) fn run(args: &RunArgs) -> Result<u8, Failure> {
    refuse_recording_without_recorder(args)?;
    let prepared = scenes::prepare(args)?;
    let path = args
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from(format!("{}.rrd", prepared.name)));
    let mut outputs = Outputs::open(args, &prepared, &path, Pace::Headless)?;
    let estimate_s = prepared.plan.cost.time_s;
    let session = Session::start(Request {
        name: prepared.name.clone(),
        scene: prepared.scene.clone(),
        plan: prepared.plan,
        threads: args.threads(),
        watchers: outputs.take_watchers(),
        ending: Ending::Passages,
    })?;
    stop_on_signals(&session)?;
    wait(&session, estimate_s);
    let outcome = session.join()?;
    if matches!(outcome.end, End::Stopped) {
        let note = "stopped by the user; what was recorded is complete";
        let _ = writeln!(std::io::stderr(), "{note}");
    }
    conclude(&prepared.scene, &outcome, outputs)
}

/// Says what came out and what went wrong.
pub(crate) fn conclude(scene: &Scene, outcome: &Outcome, outputs: Outputs) -> Result<u8, Failure> {
    let written = outputs.write_summary(outcome.summary.as_ref(), &report::text(scene, outcome));
    let mut stderr = std::io::stderr().lock();
    for complaint in report::complaints(outcome) {
        let _ = writeln!(stderr, "{complaint}");
    }
    drop(stderr);
    written?;
    Ok(outcome.exit_code())
}

fn refuse_recording_without_recorder(args: &RunArgs) -> Result<(), Failure> {
    if args.out.is_some() && !cfg!(feature = "rerun") {
        return Err(Failure::input(miette::miette!(
            help = "leave --out away, or take a build with the default features",
            "this program was built without the feature rerun, so it writes no recordings"
        )));
    }
    Ok(())
}

/// Ctrl-C or a request to end stops the run after its step; a second one ends the program at once.
fn stop_on_signals(session: &Session) -> Result<(), Failure> {
    let commands = session.commands();
    let mut asked = false;
    ctrlc::set_handler(move || {
        if asked {
            std::process::exit(130);
        }
        asked = true;
        // A run that has ended hears nothing; the program is about to end anyway.
        let _ = commands.send(Command::Stop);
    })
    .map_err(|error| Failure::stalled(miette::miette!("signals cannot be watched: {error}")))
}

fn wait(session: &Session, estimate_s: f64) {
    const TICKS: f64 = 1000.0;
    let bar = if estimate_s > WORTH_A_BAR_S {
        // Draws on a terminal only.
        ProgressBar::new(TICKS as u64).with_style(style())
    } else {
        ProgressBar::hidden()
    };
    while !session.is_finished() {
        let status = session.status();
        bar.set_position((status.progress * TICKS) as u64);
        if bar.message().is_empty() || status.steps > 0 {
            bar.set_message(if status.steps == 0 {
                "start-up".to_owned()
            } else {
                format!("step {}", status.steps)
            });
        }
        std::thread::sleep(LOOK);
    }
    bar.finish_and_clear();
}

fn style() -> ProgressStyle {
    ProgressStyle::with_template("{bar:40} {percent:>3} %  {msg}  {elapsed} of about {duration}")
        .unwrap_or_else(|_| ProgressStyle::default_bar())
}
