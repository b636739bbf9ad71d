//! `asperity sweep`: many cases, one table.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use asperity_session::sweep::{
    CaseEnd, ChainList, ColdComparison, Existing, Folder, Progress, Report, Rows, Status, Sweep,
    SweepError, Work, against_cold, manifest, points, points_csv, run,
};
use indicatif::{ProgressBar, ProgressStyle};

use super::args::{SweepArgs, SweepCommand, SweepShown, threads};
use super::failure::{Failure, tell};
use super::scenes::{print, print_lines};
use super::signals::stop_on_signals;

/// Exit code of a sweep that somebody stopped.
const STOPPED: u8 = 5;

/// Runs a sweep or a part of one, merges parts, or looks at one.
pub(crate) fn sweep(args: &SweepArgs) -> Result<u8, Failure> {
    match &args.command {
        None => {}
        Some(SweepCommand::Status { folder }) => return status(folder),
        Some(SweepCommand::Collect { folders, out }) => return collect(folders, out.as_deref()),
    }
    // clap has refused a line without one.
    let sweep = Sweep::load(args.sweep.as_deref().unwrap_or_default())?;
    if let Some(shown) = args.show {
        show_of(&sweep, shown)?;
        return Ok(0);
    }
    let root = args
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from(format!("{}.sweep", sweep.name)));
    let existing = match (args.resume, args.force) {
        (true, _) => Existing::Resume,
        (_, true) => Existing::Replace,
        // Those who were given chains of one sweep fill one folder side by side.
        _ if args.chain.is_some() || args.shard.is_some() => Existing::Resume,
        _ => Existing::Refuse,
    };
    let progress = Arc::new(Progress::default());
    watch_signals(&progress, sweep.len())?;
    let folder = Folder::create(&root, &sweep, existing)?;
    let threads = threads(args.threads);
    let only = (args.chain.clone()).or_else(|| args.shard.map(ChainList::from));
    let Some(work) = Work::plan(&sweep, only.as_ref(), &progress.stop)? else {
        return Ok(say_stopped(&progress, sweep.len()));
    };
    tell(&format!("{}, {}", counted(&work), estimated(&work)));
    let began = Instant::now();
    let report = with_bar(&progress, "", || {
        run(&sweep, &folder, &work, threads, &progress)
    })?;
    let sweep_s = began.elapsed().as_secs_f64();
    if report.stopped {
        return Ok(say_stopped(&progress, sweep.len()));
    }
    if args.chain.is_some() || report.held > 0 {
        print(&left_to_others(&report, &folder))?;
        return Ok(0);
    }
    let rows = match Rows::gather(&sweep, std::slice::from_ref(&folder)) {
        Ok(rows) => rows,
        Err(error @ SweepError::Incomplete { .. }) if args.shard.is_some() => {
            let done = report.computed;
            print(&format!("{done} cases computed; {error}\n"))?;
            return Ok(0);
        }
        Err(error) => return Err(error.into()),
    };
    let code = finish(&sweep, &rows, &folder)?;
    if !args.compare_cold {
        return Ok(code);
    }
    let began = Instant::now();
    let against = with_bar(&progress, "cold, ", || {
        against_cold(&sweep, &rows, threads, &progress)
    })?;
    let Some(against) = against else {
        return Ok(STOPPED);
    };
    print(&comparison(&sweep, &against))?;
    // Of a sweep that went on where it was broken off the clock tells nothing.
    if report.computed == sweep.len() {
        let cold_s = began.elapsed().as_secs_f64();
        print(&format!(
            "wall time on {threads} threads, writing included: sweep {sweep_s:.1} s, cold {cold_s:.1} s: {:.2} times \
             faster\n",
            cold_s / sweep_s
        ))?;
    }
    Ok(code)
}

/// How much work that is.
fn counted(work: &Work) -> String {
    format!("{} cases in {} chains", work.cases, work.chains())
}

/// How long it takes.
fn estimated(work: &Work) -> String {
    let some = if work.is_sampled {
        ", by a thousand of them"
    } else {
        ""
    };
    format!(
        "an estimated {} on one core from cold starts{some}",
        work.cost.time_text()
    )
}

/// What one says who has done what there was to do for him, and leaves the table to somebody else.
fn left_to_others(report: &Report, folder: &Folder) -> String {
    let held = match report.held {
        0 => String::new(),
        held => format!("; others work on {held} chains"),
    };
    format!(
        "{} cases computed{held}; asperity sweep collect {} makes the table when all are there\n",
        report.computed,
        folder.root().display()
    )
}

/// Says how far the sweep in a folder is.
fn status(root: &Path) -> Result<u8, Failure> {
    let sweep = Folder::sweep_in(root)?;
    let folder = Folder::open(root, &sweep)?;
    let status = Status::of(&sweep, &folder)?;
    let left = &status.left;
    let mut text = format!(
        "done      {} of {} cases, {} of {} chains\n",
        status.cases,
        sweep.len(),
        status.chains,
        status.chains + left.chains()
    );
    for claim in &status.claimed {
        let how = if claim.is_alive {
            "under way"
        } else {
            "left by  "
        };
        let _ = writeln!(text, "{how} chain {} {}", claim.chain, claim.by);
    }
    if left.chains() > 0 {
        let _ = writeln!(text, "not done  {}, {}", counted(left), estimated(left));
    }
    let table = root.join("table.csv");
    let is_there = table.exists();
    let table = table.display().to_string();
    let shown = if is_there { &table } else { "none yet" };
    let _ = writeln!(text, "table     {shown}");
    print(&text)?;
    Ok(0)
}

/// Prints of a sweep what was asked for in place of running it.
fn show_of(sweep: &Sweep, shown: SweepShown) -> Result<(), Failure> {
    match shown {
        SweepShown::File => Ok(print(sweep.source())?),
        SweepShown::Points => {
            tell(&format!("{} cases", sweep.len()));
            print_lines(points(sweep))
        }
        SweepShown::Manifest => print_lines(manifest(sweep)),
        SweepShown::Ride => match sweep.ride()? {
            Some(scene) => Ok(print(&scene.to_toml())?),
            None => Err(Failure::input(miette::miette!(
                help = "asperity sweep fzg_c --show ride prints one",
                "only a [gear] path of one torque and speed has times to ride along"
            ))),
        },
    }
}

fn collect(folders: &[PathBuf], out: Option<&Path>) -> Result<u8, Failure> {
    let sweep = Folder::sweep_in(&folders[0])?;
    let opened = folders
        .iter()
        .map(|root| Folder::open(root, &sweep))
        .collect::<Result<Vec<_>, _>>()?;
    let rows = Rows::gather(&sweep, &opened)?;
    let target = match out {
        None => opened[0].clone(),
        Some(root) => Folder::create(root, &sweep, Existing::Resume)?,
    };
    finish(&sweep, &rows, &target)
}

/// Writes the table and what goes with it, and says what came out.
fn finish(sweep: &Sweep, rows: &Rows, folder: &Folder) -> Result<u8, Failure> {
    let root = folder.root();
    let table = root.join("table.csv");
    let csv = rows.csv(sweep)?;
    folder.write(&table, csv.as_bytes())?;
    folder.write(&root.join("seconds.csv"), rows.seconds_csv().as_bytes())?;
    if let Some(seeds) = rows.seeds_csv(sweep) {
        folder.write(&root.join("seeds.csv"), seeds.as_bytes())?;
    }
    if let Some(flank) = rows.flank_csv(sweep) {
        folder.write(&root.join("flank.csv"), flank.as_bytes())?;
    }
    if !sweep.path.is_empty() {
        folder.write(&root.join("path.csv"), points_csv(sweep)?.as_bytes())?;
    }
    let pictures = asperity_session::sweep::draw(sweep, rows, folder)?;
    print(&told(sweep, rows, &table, &pictures))?;
    Ok(match rows.worst() {
        CaseEnd::Converged => 0,
        CaseEnd::NotConverged => 2,
        CaseEnd::Stalled => 3,
    })
}

fn told(sweep: &Sweep, rows: &Rows, table: &Path, pictures: &[String]) -> String {
    let seconds: f64 = rows.records.iter().map(|record| record.seconds).sum();
    let n = rows.records.len();
    let mut text = format!(
        "{n} cases, {:.1} s each on one thread\n",
        seconds / n as f64
    );
    if let Some(lives) = rows.column(sweep, "life_relative") {
        let known = || lives.iter().copied().filter(|life| life.is_finite());
        let (low, high) = (
            known().fold(f64::INFINITY, f64::min),
            known().fold(0.0, f64::max),
        );
        if high > 0.0 {
            let _ = writeln!(text, "relative life from {low:.3e} to {high:.3e}");
        }
    }
    let _ = write!(text, "{}", flank_line(sweep, rows));
    for line in rows.seeds_lines(sweep) {
        let _ = writeln!(text, "{line}");
    }
    let _ = writeln!(text, "table     {}", table.display());
    for picture in pictures {
        let _ = writeln!(text, "picture   {picture}");
    }
    for record in rows.records.iter().filter(|r| r.end != CaseEnd::Converged) {
        let why = record
            .failure
            .as_deref()
            .unwrap_or("some steps did not converge");
        let _ = writeln!(
            text,
            "case {} ({}): {why}",
            record.index,
            sweep.at(record.index)
        );
    }
    text
}

/// The place of a tooth that lives shortest, or the life of a bearing's ring.
fn flank_line(sweep: &Sweep, rows: &Rows) -> String {
    let hours =
        |hours: Option<f64>| hours.map_or_else(String::new, |hours| format!(", {hours:.3e} hours"));
    if let Some(ring) = rows.ring(sweep) {
        return format!(
            "life of the inner ring: {:.3e} turns over the loading cycles of the base scene's smooth contact{}\n",
            ring.turns,
            hours(ring.hours)
        );
    }
    let places = rows.flank(sweep);
    let known = places
        .iter()
        .filter_map(|place| Some((place, place.weaker()?)));
    let Some((place, (flank, turns))) = known.min_by(|a, b| a.1.1.total_cmp(&b.1.1)) else {
        return String::new();
    };
    format!(
        "shortest life of the tooth: {} {:.2} mm from A, {turns:.3e} turns of the pinion over the loading cycles of the \
         base scene's smooth contact{}\n",
        ["pinion", "wheel"][flank],
        1e3 * place.path_m,
        hours(place.hours)
    )
}

/// What the chains save.
fn comparison(sweep: &Sweep, against: &ColdComparison) -> String {
    let mut text = String::from("case  life / cold life  film / cold film\n");
    for (index, [life, film]) in against.ratios.iter().enumerate() {
        let at = sweep.at(index);
        let _ = writeln!(text, "{index:4}  {life:16.5}  {film:16.5}  {at}");
    }
    let _ = writeln!(
        text,
        "all cases together, one thread each: sweep {:.1} s, cold {:.1} s: {:.2} times faster",
        against.sweep_s,
        against.cold_s,
        against.cold_s / against.sweep_s
    );
    let _ = writeln!(
        text,
        "work: {} transforms, cold {}: {:.2} times less",
        against.sweep_ffts,
        against.cold_ffts,
        against.cold_ffts as f64 / against.sweep_ffts as f64
    );
    let _ = writeln!(
        text,
        "greatest difference from cold: life {:.2} %, central film {:.2} %",
        100.0 * against.worst(0),
        100.0 * against.worst(1)
    );
    text
}

/// How long the present steps have to end by themselves.
const PATIENCE: Duration = Duration::from_millis(600);

/// Ctrl-C ends the sweep after the present steps; a second one ends the program. Whatever takes longer, a step on a fine mesh
/// or the table of a million cases, is given up: what is finished is on the disk, and no file is there by half.
fn watch_signals(progress: &Arc<Progress>, cases: usize) -> Result<(), Failure> {
    let asked = stop_on_signals()?;
    let progress = Arc::clone(progress);
    let watching = move || {
        while !asked.load(Ordering::Relaxed) {
            std::thread::sleep(Duration::from_millis(50));
        }
        progress.stop.store(true, Ordering::Relaxed);
        std::thread::sleep(PATIENCE);
        std::process::exit(i32::from(say_stopped(&progress, cases)));
    };
    std::thread::Builder::new()
        .name("signals".to_owned())
        .spawn(watching)
        .map(|_| ())
        .map_err(|error| Failure::stalled(miette::miette!("signals cannot be watched: {error}")))
}

/// Says once how far a sweep came that somebody stopped; its exit code.
fn say_stopped(progress: &Progress, cases: usize) -> u8 {
    static SAID: std::sync::Once = std::sync::Once::new();
    SAID.call_once(|| {
        let done = progress.done.load(Ordering::Relaxed);
        tell(&format!(
            "stopped with {done} of {cases} cases; they are kept, --resume continues"
        ));
    });
    STOPPED
}

/// Runs `work` under a bar with the time left on a terminal, elsewhere with lines that say the same, ever more rarely.
fn with_bar<T: Send>(
    progress: &Progress,
    what: &str,
    work: impl FnOnce() -> Result<T, SweepError> + Send,
) -> Result<T, Failure> {
    const FIRST_LINE: Duration = Duration::from_secs(1);
    const RAREST: Duration = Duration::from_mins(1);
    let bar = ProgressBar::new(1000);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {percent:>3} %  {msg}") {
        bar.set_style(style);
    }
    let started = Instant::now();
    let mut next = FIRST_LINE;
    let result = std::thread::scope(|scope| {
        let thread = scope.spawn(work);
        while !thread.is_finished() {
            let elapsed = started.elapsed();
            let message = format!("{what}{}", how_far(progress, elapsed));
            if !bar.is_hidden() {
                let all = progress.all.load(Ordering::Relaxed).max(1);
                bar.set_position((1000.0 * progress.cases() / all as f64) as u64);
                bar.set_message(message);
            } else if elapsed >= next {
                tell(&message);
                next = elapsed + elapsed.min(RAREST);
            }
            std::thread::sleep(Duration::from_millis(100));
        }
        thread.join()
    });
    bar.finish_and_clear();
    match result {
        Ok(result) => Ok(result?),
        Err(_) => Err(Failure::stalled(miette::miette!(
            "a worker failed; finished cases are kept, --resume continues"
        ))),
    }
}

/// How far the cases are, and the time left at their pace.
fn how_far(progress: &Progress, elapsed: Duration) -> String {
    let all = progress.all.load(Ordering::Relaxed);
    let found = progress.found.load(Ordering::Relaxed) as f64;
    let cases = progress.cases();
    let now = cases - found;
    let left = if now > 0.05 {
        let s = elapsed.as_secs_f64() * (all as f64 - cases).max(0.0) / now;
        format!(
            "{} left",
            indicatif::HumanDuration(Duration::from_secs_f64(s))
        )
    } else {
        "time left unknown yet".to_owned()
    };
    format!("case {} of {all}, {left}", cases.floor())
}
