//! `asperity explore`: the session behind the live screen, and what the screen's keys do outside of it.

use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use asperity_engine::observe::Overwrite;
use asperity_engine::scene::presets;
use asperity_explorer::tui::lessons::Lesson;
use asperity_explorer::tui::{
    Health, Rebuild, RecorderActivity, RecorderState, RunStatus, Setup, TuiError, Wiring,
};
use asperity_session::run::{Activity, Command, Ending, Request, RunError, Session, Status};
use asperity_session::sweep::{Background, Ground, Varied};
use miette::miette;

use super::Engine;
use super::args::RunArgs;
use super::failure::{Failure, tell};
use super::names::Names;
use super::outputs::{Outputs, RecorderPace, Recording};
use super::run::conclude;
use super::scenes::{self, Prepared};
use super::{report, shown, view};

/// A run behind the screen.
struct Running {
    prepared: Prepared,
    session: Session,
    outputs: Outputs,
}

/// The runs of one sitting.
#[derive(Default)]
struct Sitting {
    /// The last one goes; the others are coming to their end.
    runs: Vec<Running>,
    /// Worst exit code of those that have ended.
    worst: u8,
    /// What they had to say, for the terminal once it is given back; the first of them.
    complaints: Vec<String>,
    broken: Option<RunError>,
}

/// Complaints that are kept.
const MOST_COMPLAINTS: usize = 100;

type Runs = Rc<RefCell<Sitting>>;

impl Sitting {
    /// Closes the runs that have ended behind the one that goes: what each of them held is given back.
    fn reap(&mut self) {
        let behind = self.runs.len().saturating_sub(1);
        let ended = self.runs.drain(..behind);
        let (ended, going): (Vec<_>, Vec<_>) = ended.partition(|run| run.session.is_finished());
        self.runs.splice(..0, going);
        for run in ended {
            self.close(run);
        }
    }

    /// Waits for the end of a run, and keeps what it leaves of it.
    fn close(&mut self, run: Running) {
        match run.session.join() {
            Ok(outcome) => {
                self.worst = self.worst.max(outcome.exit_code());
                let complaints = report::complaints(&outcome).into_iter();
                let named = complaints.map(|words| format!("{}: {words}", run.prepared.name));
                let room = MOST_COMPLAINTS - self.complaints.len();
                self.complaints.extend(named.take(room));
            }
            Err(error) => self.broken = Some(error),
        }
    }
}

/// Opens the explorer and runs until the user quits.
pub(crate) fn explore(
    args: &RunArgs,
    lesson: Option<&Path>,
    engine: Engine,
) -> Result<u8, Failure> {
    let lesson = lesson.map(Lesson::load).transpose();
    let lesson = lesson.map_err(|error| Failure::input(miette!("{error}")))?;
    if args.hold {
        return Err(Failure::input(miette!(
            "--hold is for asperity run: the explorer does not wait for viewers"
        )));
    }
    let mut args = args.clone();
    let opening = presets::opening(&args.scene.name()).map(str::to_owned);
    args.scene.settings.splice(0..0, opening);
    let args = &args;
    let prepared = scenes::prepare(args)?;
    let path = match &args.out {
        Some(path) => path.clone(),
        None => free_name(&prepared)?,
    };
    Names::of(args, &prepared.scene, &path).check()?;
    let outputs = Outputs::open(args, &prepared.scene, &path, RecorderPace::Live)?;
    let interrupt = Arc::new(AtomicBool::new(false));
    let raised = Arc::clone(&interrupt);
    ctrlc::set_handler(move || raised.store(true, Ordering::Relaxed))
        .map_err(|error| Failure::stalled(miette!("signals cannot be watched: {error}")))?;
    let first = start(engine, args.threads(), prepared, outputs)?;
    let mut wiring = wiring(&first, args.threads(), interrupt.clone());
    let sitting = Sitting {
        runs: vec![first],
        ..Sitting::default()
    };
    let runs = Runs::new(RefCell::new(sitting));
    wiring.lesson = lesson.map(Arc::new);
    wiring.rebuild = Some(rebuild(engine, args, Rc::clone(&runs), interrupt));
    let shown = asperity_explorer::tui::explore(wiring);
    let code = end(&runs)?;
    match shown {
        Ok(()) => Ok(code),
        Err(error @ TuiError::NoScreen { .. }) => Err(Failure::input(miette!("{error}"))),
        Err(error) => Err(Failure::output(miette!("{error}"))),
    }
}

fn start(
    engine: Engine,
    threads: usize,
    prepared: Prepared,
    mut outputs: Outputs,
) -> Result<Running, Failure> {
    let session = engine(Request {
        name: prepared.name.clone(),
        scene: Arc::clone(&prepared.scene),
        plan: prepared.plan.clone(),
        threads,
        watchers: outputs.take_watchers(),
        ending: Ending::OnStop,
    })?;
    Ok(Running {
        prepared,
        session,
        outputs,
    })
}

/// Closes all runs in order; the summary is that of the last, the exit code the worst. A run that broke off
/// keeps none of the others from being closed.
fn end(runs: &Runs) -> Result<u8, Failure> {
    let mut sitting = runs.take();
    let last = sitting.runs.pop();
    for run in std::mem::take(&mut sitting.runs) {
        sitting.close(run);
    }
    for complaint in &sitting.complaints {
        tell(complaint);
    }
    if let Some(run) = last {
        run.session.handle.send(Command::Stop);
        match run.session.join() {
            Ok(outcome) => {
                let code = conclude(&run.prepared.scene, &outcome, None, run.outputs)?;
                sitting.worst = sitting.worst.max(code);
            }
            Err(error) => sitting.broken = Some(error),
        }
    }
    match sitting.broken {
        Some(error) => Err(error.into()),
        None => Ok(sitting.worst),
    }
}

/// Another scene in place of the present one. Recordings bear its name and a number; tables, exports and viewers
/// belong to the first scene.
fn rebuild(engine: Engine, args: &RunArgs, runs: Runs, interrupt: Arc<AtomicBool>) -> Rebuild {
    let (threads, no_record) = (args.threads(), args.no_record);
    Box::new(move |scene, name| {
        let words = |failure: Failure| failure.to_string();
        let mut next = RunArgs::bare();
        next.no_record = no_record;
        let mut sitting = runs.borrow_mut();
        sitting.reap();
        let runs = &mut sitting.runs;
        let mut scene = scene.clone();
        scene.record = runs
            .last()
            .and_then(|run| run.prepared.scene.record.clone());
        let prepared = scenes::finish(&next, scene, name.to_owned()).map_err(words)?;
        let path = free_name(&prepared).map_err(words)?;
        let outputs =
            Outputs::open(&next, &prepared.scene, &path, RecorderPace::Live).map_err(words)?;
        let run = start(engine, threads, prepared, outputs).map_err(words)?;
        // It ends by itself while the new one starts; what it holds goes when the next one comes.
        if let Some(old) = runs.last_mut() {
            old.session.handle.send(Command::Stop);
        }
        let mut wiring = wiring(&run, threads, Arc::clone(&interrupt));
        wiring.rebuild = None;
        // Where the summary goes was asked for once.
        let mut run = run;
        if let Some(old) = runs.last_mut() {
            std::mem::swap(&mut old.outputs, &mut run.outputs);
        }
        runs.push(run);
        Ok(wiring)
    })
}

fn wiring(run: &Running, threads: usize, interrupt: Arc<AtomicBool>) -> Wiring {
    let Running {
        prepared,
        session,
        outputs,
    } = run;
    let recording = outputs.recording.clone();
    let [status, settled, ground] = [(); 3].map(|()| session.handle.clone());
    let scene = prepared.scene.clone();
    let recorded = recording.clone();
    let shown = recording.clone();
    let name = prepared.name.clone();
    Wiring {
        setup: Setup::of(prepared.scene.clone(), &prepared.name, &prepared.plan),
        frames: session.handle.latest(),
        commands: session.handle.commands(),
        status: Box::new(move || run_status(&status.status(), recorded.as_ref())),
        settled: Box::new(move || settled.settled()),
        start_sweep: Some(Box::new(move |order| {
            // A curve is a shorter wait than a third mesh.
            let hold = matches!(order.varied, Varied::Along(_)).then(|| ground.hold());
            let ground = Ground::of(&scene, &*ground.settled()?)?;
            Some(Background::start(ground, order, threads, hold.as_ref()))
        })),
        interrupt,
        toggle_recording: recording.map(|recording| {
            Box::new(move || {
                Ok(if recording.switch.toggle() {
                    "recording".to_owned()
                } else {
                    "recording paused".to_owned()
                })
            }) as _
        }),
        open_viewer: shown.map(|shown| Box::new(move || open_viewer(&shown)) as _),
        save_scene: Some(Box::new(move |toml| save(&name, toml))),
        write_shown: Some(shown::writer(prepared)),
        rebuild: None,
        lesson: None,
    }
}

fn run_status(status: &Status, recorded: Option<&Recording>) -> RunStatus {
    let find = |recording: &Recording| {
        let mut outputs = status.outputs.iter();
        let output = outputs.find(|output| output.output == recording.name)?;
        // Once it has taken its own name it is there.
        let file =
            std::fs::metadata(&recording.path).or_else(|_| std::fs::metadata(&output.output));
        Some((output, file.map_or(0, |file| file.len())))
    };
    let recorder = recorded
        .and_then(find)
        .map(|(output, bytes)| RecorderState {
            output: output.output.clone(),
            activity: match output.activity {
                Activity::On => RecorderActivity::Recording,
                Activity::Off => RecorderActivity::Paused,
                Activity::Failed => RecorderActivity::Stopped,
            },
            frames: output.frames,
            skipped: output.skipped,
            bytes,
        });
    RunStatus {
        health: match &status.failure {
            Some(failure) => Health::Failed(failure.clone()),
            None => Health::Running,
        },
        recorder,
        climbs: status.climbs,
        finer: status.finer,
    }
}

fn open_viewer(recording: &Recording) -> Result<String, String> {
    // Once there is a step it has its own name.
    let own = Path::new(&recording.name);
    let path = if recording.path.exists() {
        &recording.path
    } else {
        own
    };
    let mut command = view::command(path).map_err(|failure| failure.to_string())?;
    command
        .spawn()
        .map(|_| format!("the viewer opens {}", path.display()))
        .map_err(|error| format!("the viewer could not be started: {error}"))
}

/// Saves a scene beside the working directory's others, never over one.
fn save(name: &str, toml: &str) -> Result<PathBuf, String> {
    let path = shown::numbered(Path::new("."), name, "toml").ok_or("no free file name")?;
    let written = Overwrite::Refuse.write(&path, toml.as_bytes());
    written.map_err(|error| error.to_string())?;
    Ok(path)
}

/// A name in ./recordings/ that is not taken.
fn free_name(prepared: &Prepared) -> Result<PathBuf, Failure> {
    let folder = Path::new("recordings");
    if prepared.plan.record.is_some() {
        std::fs::create_dir_all(folder).map_err(|error| {
            Failure::output(miette!(
                help = "--out FILE.rrd records elsewhere, --no-record not at all",
                "the folder ./recordings cannot be made: {error}"
            ))
        })?;
    }
    shown::numbered(folder, &prepared.name, "rrd")
        .ok_or_else(|| Failure::output(miette!("no free file name in ./recordings")))
}
