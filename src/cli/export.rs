//! `asperity export`: pictures, animations and numbers out of a recording.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
    time::Instant,
};

use asperity_engine::math::number::{bytes, counted, seconds};
use asperity_engine::observe::{Observer as _, Overwrite, RunContext};
use asperity_engine::sim::Frame;
use asperity_picture::export::{Export, Format, PrintSize, TakenAs};
use asperity_recorder::RecordedFrames;
use asperity_session::Table;

use super::args::ExportArgs;
use super::failure::Failure;

/// Writes what was asked for.
pub(crate) fn export(args: &ExportArgs) -> Result<u8, Failure> {
    refuse_unknown_pictures(&args.show)?;
    let started = Instant::now();
    let read = RecordedFrames::read_all(&args.file);
    let mut runs = read.map_err(|error| Failure::input(miette::miette!("{error}")))?;
    let frames = runs.remove(0);
    tell_where_it_breaks_off(&args.file, &frames);
    let read_s = started.elapsed().as_secs_f64();
    let stem = args.file.file_stem().unwrap_or_default().to_string_lossy();
    let usual = || PathBuf::from(format!("{stem}_export"));
    let folder = args.out.clone().unwrap_or_else(usual);
    let context = RunContext {
        scene: Arc::clone(&frames.scene),
        scene_toml: frames.scene_toml.clone(),
        plan_text: String::new(),
        program: frames.program.clone(),
        began: asperity_engine::observe::Began::FromScene,
    };
    let written = pictures(args, &frames, runs, &folder, &context)?
        + table(args, &frames, &folder, &context)?;
    let all_s = started.elapsed().as_secs_f64();
    let text = format!(
        "{}: {} of {} with pictures read in {}; {} written in {}\n",
        folder.display(),
        frames.shown().len(),
        counted(frames.n_steps() as u64, "step"),
        seconds(read_s),
        bytes(written),
        seconds(all_s - read_s),
    );
    super::scenes::print(&text)?;
    Ok(0)
}

/// What is read of a recording that breaks off is not all of its run.
pub(super) fn tell_where_it_breaks_off(path: &Path, frames: &RecordedFrames) {
    if let Some(words) = frames.broken_off() {
        let path = path.display();
        super::failure::tell(&format!("{path}: {words}; what was written before is read"));
    }
}

fn refuse_unknown_pictures(asked: &[String]) -> Result<(), Failure> {
    let names = asperity_picture::export::picture_names();
    match asked.iter().find(|name| !names.contains(&name.as_str())) {
        Some(unknown) => Err(Failure::input(miette::miette!(
            help = format!("there are {}", names.join(", ")),
            "--show {unknown}: no picture of that name"
        ))),
        None => Ok(()),
    }
}

/// Writes the pictures, animations and fields; bytes.
fn pictures(
    args: &ExportArgs,
    frames: &RecordedFrames,
    others: Vec<RecordedFrames>,
    folder: &Path,
    context: &RunContext,
) -> Result<u64, Failure> {
    let print = PrintSize {
        width_mm: args.width_mm,
        dpi: args.dpi,
        font_pt: args.font_pt,
    };
    let overwrite = Overwrite::from_force(args.force);
    let mut others: Vec<Other> = others.into_iter().map(Other::new).collect();
    for path in &args.beside {
        others.push(Other::read(path)?);
    }
    let export = Export::create(folder, overwrite, &args.formats)?
        .of(&args.show, print)
        .alone(args.every.is_none());
    let scenes = others.iter().map(|other| &*other.frames.scene);
    let mut export = export.beside(scenes);
    export.begin(context)?;
    let all = std::iter::once(frames).chain(others.iter().map(|other| &other.frames));
    for (k, run) in all.enumerate() {
        if let Some(last) = run.last_band() {
            export.end(k, last);
        }
    }
    let (whole, shown) = (frames.whole(), frames.shown());
    // A still has all that the run's own export has; the shear and the roughness are in every second picture.
    let one = match (args.step, args.at_s) {
        (Some(step), _) => whole.iter().min_by_key(|own| own.abs_diff(step)).copied(),
        (None, Some(at_s)) => nearest(&frames.shown_at(), &whole, at_s),
        (None, None) => whole.last().copied(),
    };
    let mut next = 0;
    for between in frames.steps() {
        let step = between.step;
        if shown.binary_search(&step).is_err() {
            export.pass(0, &between);
            continue;
        }
        let is_whole = whole.binary_search(&step).is_ok();
        let taken = match args.every {
            None if Some(step) == one => TakenAs::Still,
            None if args.step.is_none() && args.at_s.is_none() && is_whole => TakenAs::InSeries,
            Some(_) if is_whole && step >= next => TakenAs::Still,
            _ => TakenAs::Moving,
        };
        if let Some(every) = args.every.filter(|_| taken == TakenAs::Still) {
            next = step + every;
        }
        let Some(frame) = frames.frame(step) else {
            continue;
        };
        for (k, other) in others.iter_mut().enumerate() {
            while let Some(before) = other.next_before(frame.time_s) {
                export.pass(k + 1, &before);
            }
        }
        let others = others.iter().map(|other| other.nearest(frame.time_s));
        let Some(others) = others.collect::<Option<Vec<_>>>() else {
            continue;
        };
        let all: Vec<&Frame> = std::iter::once(&frame).chain(&others).collect();
        export.take_all(&all, taken)?;
    }
    let report = export.finish()?;
    if !report.note.is_empty() {
        super::failure::tell(&report.note);
    }
    Ok(report.bytes)
}

/// Of these steps, of which the times (s) are known, the one nearest to a time.
fn nearest(times_s: &[(u64, f64)], steps: &[u64], at_s: f64) -> Option<u64> {
    let known = times_s.iter().filter(|(step, _)| steps.contains(step));
    let off = |(_, own): &&(u64, f64)| (own - at_s).abs();
    let nearest = known.min_by(|one, two| off(one).total_cmp(&off(two)));
    nearest.map(|(step, _)| *step)
}

/// A recording that is drawn beside another.
struct Other {
    frames: RecordedFrames,
    /// Steps with pictures and their times, s.
    times_s: Vec<(u64, f64)>,
    /// Its steps, of which so many have passed.
    steps: Vec<Frame>,
    passed: usize,
}

impl Other {
    fn read(path: &Path) -> Result<Self, Failure> {
        let read = RecordedFrames::read(path);
        let frames = read.map_err(|error| Failure::input(miette::miette!("{error}")))?;
        tell_where_it_breaks_off(path, &frames);
        Ok(Self::new(frames))
    }

    fn new(frames: RecordedFrames) -> Self {
        Self {
            times_s: frames.shown_at(),
            steps: frames.steps().collect(),
            passed: 0,
            frames,
        }
    }

    /// The next of its steps before a time.
    fn next_before(&mut self, time_s: f64) -> Option<Frame> {
        let next = self.steps.get(self.passed);
        let next = next.filter(|frame| frame.time_s < time_s).cloned();
        self.passed += usize::from(next.is_some());
        next
    }

    /// The picture nearest to a time; `None` before its first and after its last by more than they are apart.
    fn nearest(&self, time_s: f64) -> Option<Frame> {
        let off = |(_, own): &&(u64, f64)| (own - time_s).abs();
        let nearest = self
            .times_s
            .iter()
            .min_by(|one, two| off(one).total_cmp(&off(two)))?;
        let gaps = self.times_s.windows(2).map(|two| two[1].1 - two[0].1);
        let apart = gaps.fold(0.0, f64::max);
        (off(&nearest) <= apart).then(|| self.frames.frame(nearest.0))?
    }
}

/// Writes the scalars of every step where a table is asked for; bytes.
fn table(
    args: &ExportArgs,
    frames: &RecordedFrames,
    folder: &Path,
    context: &RunContext,
) -> Result<u64, Failure> {
    if !args.formats.contains(&Format::Csv) {
        return Ok(0);
    }
    let overwrite = Overwrite::from_force(args.force);
    let mut table = Table::create(&folder.join("table.csv"), overwrite)?;
    table.begin(context)?;
    for frame in frames.steps() {
        table.frame(&Arc::new(frame))?;
    }
    Ok(table.finish()?.bytes)
}
