//! `asperity run`: a scene without a screen.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use asperity_engine::observe::{Claim, ObserveError, Overwrite, leftovers, stopped_of};
use asperity_engine::plan::Plan;
use asperity_engine::scene::{ContactKind, Scene};
use asperity_session::run::{
    Assumed, Checkpoint, Command, Companion, End, Ending, Outcome, Request, Session,
};
use indicatif::{ProgressBar, ProgressStyle};

use super::args::{HeadlessArgs, RunArgs};
use super::failure::{Failure, tell};
use super::names::Names;
use super::outputs::{Outputs, RecorderPace};
use super::repeat::{self, Repetition};
use super::signals::stop_on_signals;
use super::{report, scenes};

/// Estimated time from which a progress bar is worth its line, s.
const WORTH_A_BAR_S: f64 = 2.0;
/// How often the bar looks.
const LOOK: Duration = Duration::from_millis(50);

/// Runs a scene and writes what was asked for.
pub(crate) fn run(headless: &HeadlessArgs) -> Result<u8, Failure> {
    let args = &headless.run;
    #[cfg(feature = "rerun")]
    if let Some(values) = &headless.beside {
        return super::beside::run(headless, values, run);
    }
    #[cfg(not(feature = "rerun"))]
    if args.out.is_some() || headless.beside.is_some() {
        return Err(Failure::without_recorder("writes no recordings"));
    }
    let repetition = headless
        .from
        .as_deref()
        .map(|path| repeat::read(path, args))
        .transpose()?;
    let is_plain = repetition.as_ref().is_none_or(Repetition::is_plain);
    let broken_off = repetition.as_ref().is_some_and(|run| run.broken_off);
    let (prepared, turns, last_step) = match repetition {
        None => (scenes::prepare(args)?, Vec::new(), 0),
        Some(repeated) => (repeated.prepared, repeated.turns, repeated.last_step),
    };
    let is_of_scene = turns.is_empty() && !broken_off;
    let usual = || PathBuf::from(format!("{}.rrd", prepared.name));
    let path = args.out.clone().unwrap_or_else(usual);
    let recorded = prepared.scene.record.is_some();
    let plan = prepared.plan;
    // All that is read is read before anything is written.
    let state = headless.from_state.as_deref();
    let saved = state.map(|path| Checkpoint::read_for(path, &prepared.scene));
    let saved = saved.transpose()?.inspect(tell_of_the_past);
    let names = Names::of(args, &prepared.scene, &path);
    names.with_states(headless).check()?;
    let overwrite = Overwrite::from_force(args.force);
    // Two runs would otherwise both compute what one of them can save.
    let to_save = headless.save_state.as_deref();
    let to_save = to_save.map(|path| overwrite.claim(path)).transpose()?;
    // From the first file on a signal ends the run in order.
    let interrupt = stop_on_signals()?;
    tell_of_leftovers(args, headless, recorded.then_some(path.as_path()));
    let mut outputs = Outputs::open(args, &prepared.scene, &path, RecorderPace::Headless)?;
    let request = Request {
        name: prepared.name.clone(),
        scene: prepared.scene.clone(),
        plan: plan.clone(),
        threads: args.threads(),
        watchers: outputs.take_watchers(),
        ending: if is_plain {
            Ending::Passages
        } else {
            Ending::Steps(last_step)
        },
    };
    let kind = prepared.scene.kind();
    let session = match saved {
        None if is_plain => Session::start(request),
        None => Session::repeat(request, turns),
        Some(saved) => Session::resume(request, saved),
    }?;
    wait(&session, kind, plan.cost.time_s, &interrupt, "");
    let mut outcome = session.join()?;
    if broken_off {
        outcome.cut_short();
    }
    let errors = if is_plain || is_of_scene && outcome.settled {
        let (scene, threads) = (&prepared.scene, args.threads());
        let errors = estimate_errors(scene, &plan, threads, &mut outcome, &interrupt);
        vary_what_nobody_knows(scene, &plan, threads, &mut outcome, &interrupt);
        errors
    } else {
        "not estimated: knobs were turned by hand, or the recording ends early".to_owned()
    };
    let recording = recorded.then(|| lies_at(&outcome, &path));
    note_in_recording(&mut outcome, recording.as_deref());
    tell_where_stopped(&outcome);
    // The state first: it is what a run that cannot tell its results is taken up from.
    let saved = to_save.map_or(Ok(()), |claim| save_state(&outcome, claim));
    let code = conclude(&prepared.scene, &outcome, Some(&errors), outputs)?;
    saved?;
    Ok(code)
}

/// Names what runs that were killed left beside the outputs: nobody else will take it away.
fn tell_of_leftovers(args: &RunArgs, headless: &HeadlessArgs, recording: Option<&Path>) {
    let named = [&args.table, &args.summary, &headless.save_state];
    let named = named.into_iter().filter_map(Option::as_deref);
    for path in named.chain(recording).flat_map(leftovers) {
        let path = path.display();
        tell(&format!(
            "{path}: left by a run that was killed; export and run --from read a recording up to its last whole step"
        ));
    }
}

fn tell_where_stopped(outcome: &Outcome) {
    if matches!(outcome.end, End::Stopped) {
        let note = report::stopped(outcome);
        tell(&format!("{note}; what was recorded is complete"));
    }
}

/// Writes what came out into the finished recording's properties. Without it the recording is as good, but it is not what
/// was asked for.
fn note_in_recording(outcome: &mut Outcome, recording: Option<&Path>) {
    #[cfg(feature = "rerun")]
    if let (Some(summary), Some(path)) = (&outcome.summary, recording)
        && outcome.output_errors.is_empty()
        && let Err(error) = asperity_recorder::note_summary(path, summary)
    {
        outcome.output_errors.push(error);
    }
    #[cfg(not(feature = "rerun"))]
    let _ = (outcome, recording);
}

/// Where the recording of that name lies: beside the name where the run was stopped and a whole file has it.
fn lies_at(outcome: &Outcome, path: &Path) -> PathBuf {
    let aside = stopped_of(path);
    let mut outputs = outcome
        .reports
        .iter()
        .map(|report| Path::new(&report.output));
    let aside = outputs.find(|output| output.file_name() == aside.file_name());
    aside.unwrap_or(path).to_owned()
}

fn save_state(outcome: &Outcome, claim: Claim) -> Result<(), ObserveError> {
    let Some(checkpoint) = &outcome.checkpoint else {
        let reason = "the run never began, so there is no state";
        return Err(ObserveError::new(claim.name(), reason));
    };
    claim.write_by(|at| {
        let mut file = std::fs::File::create(at)?;
        checkpoint.write(&mut file)
    })
}

/// A state fits whatever program wrote it; the numbers after it are those of one run only if it was this one, and of
/// the scene's run only if nobody turned a knob.
fn tell_of_the_past(saved: &Checkpoint) {
    let (program, now) = (&saved.program, asperity_session::program::PROGRAM);
    if program != now {
        let note = format!("saved by {program}; this is {now}, so numbers may differ");
        tell(&note);
    }
    if saved.n_turned_by_hand > 0 {
        let n = saved.n_turned_by_hand;
        tell(&format!(
            "{} been turned by hand before it was saved; the run continues from where they stand, so it is not the \
             scene's own run",
            if n == 1 {
                "1 knob had".to_owned()
            } else {
                format!("{n} knobs had")
            }
        ));
    }
}

/// The discretisation error, from a companion on half the nodes where the scene asks for it; in words.
fn estimate_errors(
    scene: &Scene,
    plan: &Plan,
    threads: usize,
    outcome: &mut Outcome,
    interrupt: &AtomicBool,
) -> String {
    let finished = matches!(outcome.end, End::Done);
    let Some(summary) = outcome.summary.as_mut().filter(|_| finished) else {
        return "not estimated: the run did not finish".to_owned();
    };
    if let [.., below, _] = summary.rungs[..]
        && summary.error_h_central_m.is_some()
    {
        return report::errors(summary, below.nodes, None);
    }
    let compared = Companion::start(scene, plan, threads).and_then(|companion| {
        let share = plan.cost.time_s / 7.0;
        wait(
            &companion.session,
            scene.kind(),
            share,
            interrupt,
            "error estimate, ",
        );
        let nodes = companion.nodes;
        Ok((nodes, companion.compare(summary)?.wall_s))
    });
    match compared {
        Ok((nodes, wall_s)) => report::errors(summary, nodes, Some(wall_s)),
        Err(reason) => format!("not estimated: {reason}"),
    }
}

/// What a life hangs on that nobody can choose: the phase of surfaces that roll, the law of sheared oil.
fn vary_what_nobody_knows(
    scene: &Arc<Scene>,
    plan: &Plan,
    threads: usize,
    outcome: &mut Outcome,
    interrupt: &AtomicBool,
) {
    let (End::Done, Some(summary)) = (&outcome.end, &mut outcome.summary) else {
        return;
    };
    for what in Assumed::ALL {
        if what.moves(scene, plan) {
            tell(match what {
                Assumed::Phase => {
                    "crests of both bodies do not meet in all ways: seven more phases on the first mesh, for the band"
                }
                Assumed::OilLaw => {
                    "the oil is sheared: three other laws on the first mesh, for the range of the life"
                }
            });
            what.vary(scene, plan, threads, summary, interrupt);
        }
    }
}

/// Says what came out and what went wrong. `errors`: the discretisation error in words.
pub(crate) fn conclude(
    scene: &Scene,
    outcome: &Outcome,
    errors: Option<&str>,
    outputs: Outputs,
) -> Result<u8, Failure> {
    let text = report::text(scene, outcome, errors);
    let written = outputs.write_summary(outcome.summary.as_ref(), &text);
    for complaint in report::complaints(outcome) {
        tell(&complaint);
    }
    written?;
    Ok(outcome.exit_code())
}

fn wait(session: &Session, kind: ContactKind, estimate_s: f64, interrupt: &AtomicBool, what: &str) {
    const TICKS: f64 = 1000.0;
    let bar = if estimate_s > WORTH_A_BAR_S {
        // Draws on a terminal only.
        ProgressBar::new(TICKS as u64).with_style(style())
    } else {
        ProgressBar::hidden()
    };
    let mut n_told = 0;
    while !session.is_finished() {
        if interrupt.load(Ordering::Relaxed) {
            // A run that has ended hears nothing.
            session.handle.send(Command::Stop);
        }
        let status = session.handle.status();
        for rung in status.rungs.iter().skip(n_told) {
            bar.suspend(|| {
                tell(&format!(
                    "{}: {}",
                    kind.mesh(rung.nodes),
                    report::rung(rung)
                ));
            });
        }
        n_told = n_told.max(status.rungs.len());
        bar.set_position((status.progress * TICKS) as u64);
        if bar.message().is_empty() || status.steps > 0 {
            bar.set_message(if status.steps == 0 && status.nodes > 0 {
                format!("{what}{}", kind.mesh(status.nodes))
            } else if status.steps == 0 {
                format!("{what}start-up")
            } else {
                format!("{what}step {}", status.steps)
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
