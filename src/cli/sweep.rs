//! `asperity sweep`: many cases, one table.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use asperity_session::sweep::{
    CaseEnd, ColdComparison, Existing, Folder, Progress, Rows, Shard, Sweep, SweepError,
    against_cold, cost, points, points_csv, run,
};
use indicatif::{ProgressBar, ProgressStyle};

use super::args::{SweepArgs, SweepCommand, SweepShown, threads};
use super::failure::{Failure, tell};
use super::scenes::{print, print_lines};
use super::signals::stop_on_signals;

/// Exit code of a sweep that somebody stopped.
const STOPPED: u8 = 5;

/// Runs a sweep or a part of one, or merges parts.
pub(crate) fn sweep(args: &SweepArgs) -> Result<u8, Failure> {
    if let Some(SweepCommand::Collect { folders, out }) = &args.command {
        return collect(folders, out.as_deref());
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
        // Shards of one sweep fill one folder side by side.
        _ if args.shard != Shard::WHOLE => Existing::Resume,
        _ => Existing::Refuse,
    };
    let progress = Arc::new(Progress::default());
    watch_signals(&progress)?;
    let folder = Folder::create(&root, &sweep, existing)?;
    let threads = threads(args.threads);
    let (cases, cost) = cost(&sweep, args.shard)?;
    tell(&format!(
        "{cases} cases, an estimated {} on one core from cold starts",
        cost.time_text()
    ));
    let began = Instant::now();
    let report = with_bar(&progress, "", || {
        run(&sweep, &folder, args.shard, threads, &progress)
    })?;
    let sweep_s = began.elapsed().as_secs_f64();
    if report.stopped {
        let (done, all) = (progress.done.load(Ordering::Relaxed), sweep.len());
        tell(&format!(
            "stopped with {done} of {all} cases; they are kept, --resume continues"
        ));
        return Ok(STOPPED);
    }
    let rows = match Rows::gather(&sweep, std::slice::from_ref(&folder)) {
        Ok(rows) => rows,
        Err(error @ SweepError::Incomplete { .. }) if args.shard != Shard::WHOLE => {
            print(&format!(
                "shard {}/{}: {} cases computed; {error}\n",
                args.shard.index, args.shard.count, report.computed
            ))?;
            return Ok(0);
        }
        Err(error) => return Err(error.into()),
    };
    let code = finish(&sweep, &rows, &folder)?;
    if args.compare_cold {
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
    }
    Ok(code)
}

/// Prints of a sweep what was asked for in place of running it.
fn show_of(sweep: &Sweep, shown: SweepShown) -> Result<(), Failure> {
    match shown {
        SweepShown::File => Ok(print(sweep.source())?),
        SweepShown::Points => {
            tell(&format!("{} cases", sweep.len()));
            print_lines(points(sweep))
        }
        SweepShown::Ride => match sweep.ride()? {
            Some(scene) => Ok(print(&scene.to_toml())?),
            None => Err(Failure::input(miette::miette!(
                help = "asperity sweep fzg_c --show ride prints one",
                "only a [gear] path has times to ride along"
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

/// Ctrl-C ends the sweep after the present steps; a second one ends the program.
fn watch_signals(progress: &Arc<Progress>) -> Result<(), Failure> {
    let asked = stop_on_signals()?;
    let progress = Arc::clone(progress);
    let watching = move || {
        while !asked.load(Ordering::Relaxed) {
            std::thread::sleep(Duration::from_millis(50));
        }
        progress.stop.store(true, Ordering::Relaxed);
    };
    std::thread::Builder::new()
        .name("signals".to_owned())
        .spawn(watching)
        .map(|_| ())
        .map_err(|error| Failure::stalled(miette::miette!("signals cannot be watched: {error}")))
}

/// Runs `work` under a bar with the time left, which draws on a terminal only.
fn with_bar<T: Send>(
    progress: &Progress,
    what: &str,
    work: impl FnOnce() -> Result<T, SweepError> + Send,
) -> Result<T, Failure> {
    let bar = ProgressBar::new(1000);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {percent:>3} %  {msg}") {
        bar.set_style(style);
    }
    let started = Instant::now();
    let result = std::thread::scope(|scope| {
        let thread = scope.spawn(work);
        while !thread.is_finished() {
            show(&bar, progress, what, started.elapsed());
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

fn show(bar: &ProgressBar, progress: &Progress, what: &str, elapsed: Duration) {
    let all = progress.all.load(Ordering::Relaxed);
    let found = progress.found.load(Ordering::Relaxed) as f64;
    let cases = progress.cases();
    if all == 0 {
        return;
    }
    bar.set_position((1000.0 * cases / all as f64) as u64);
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
    bar.set_message(format!("{what}case {} of {all}, {left}", cases.floor()));
}
