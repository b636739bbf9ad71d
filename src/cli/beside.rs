//! Runs side by side: `asperity compare` of recordings, and `asperity run --beside` of a scene at two or three values of a
//! key.

use std::path::{Path, PathBuf};

use asperity_engine::math::number::{GPA, counted, sig};
use asperity_engine::observe::Overwrite;
use asperity_recorder::{ComparedBy, RecordedFrames, RunBeside, compare as side_by_side};

use super::args::{BesideValues, CompareArgs, CompareBy, HeadlessArgs};
use super::failure::Failure;

/// Runs a scene once for each value and puts the recordings side by side.
pub(crate) fn run(
    args: &HeadlessArgs,
    beside: &BesideValues,
    run: impl Fn(&HeadlessArgs) -> Result<u8, Failure>,
) -> Result<u8, Failure> {
    let stem = Path::new(&args.run.scene.scene).file_stem();
    let stem = stem.map_or("scene".into(), |stem| stem.to_string_lossy());
    let usual = || PathBuf::from(format!("{stem}_beside.rrd"));
    let out = args.run.out.clone().unwrap_or_else(usual);
    let name = Overwrite::from_force(args.run.force).claim(&out)?;
    let parts = parts_of(&out, beside.values.len());
    let mut code = 0;
    let mut outcome = Ok(());
    for (value, part) in beside.values.iter().zip(&parts) {
        super::scenes::print(&format!("{} = {value}\n\n", beside.key))?;
        match run(&args.with(&beside.key, value, part)) {
            Ok(own) => code = code.max(own),
            Err(failure) => outcome = Err(failure),
        }
        if outcome.is_err() || code > 2 {
            break;
        }
        super::scenes::print("\n")?;
    }
    // The recording claims it for itself.
    drop(name);
    if outcome.is_ok() && code <= 2 {
        let name = |value: &String| format!("{} = {value}", beside.key);
        let named = beside.values.iter().map(name).zip(parts.iter().cloned());
        outcome = put_together(&named.collect::<Vec<_>>(), &out, args.run.force, args.by);
    }
    for part in parts {
        // What never came need not go.
        drop(std::fs::remove_file(part));
    }
    outcome.map(|()| code)
}

/// Names of recordings that are there only until they are one.
fn parts_of(out: &Path, count: usize) -> Vec<PathBuf> {
    let name = |k| format!(".asperity-beside-{}-{k}.rrd", std::process::id());
    (0..count).map(|k| out.with_file_name(name(k))).collect()
}

/// Puts recordings side by side.
pub(crate) fn compare(args: &CompareArgs) -> Result<u8, Failure> {
    let stem = |path: &PathBuf| {
        path.file_stem()
            .map(|stem| stem.to_string_lossy().into_owned())
    };
    let names = args.files.iter().map(|path| stem(path).unwrap_or_default());
    let mut named: Vec<(String, PathBuf)> = names.zip(args.files.iter().cloned()).collect();
    // Files of one name in several folders.
    for k in 1..named.len() {
        if named[..k].iter().any(|(name, _)| *name == named[k].0) {
            named[k].0 = format!("{} ({})", named[k].0, k + 1);
        }
    }
    let clash = args.files.iter().any(|file| {
        asperity_engine::files::identity(file) == asperity_engine::files::identity(&args.out)
    });
    if clash {
        return Err(Failure::input(miette::miette!(
            "--out {} is one of the recordings that are read",
            args.out.display()
        )));
    }
    put_together(&named, &args.out, args.force, args.by)?;
    Ok(0)
}

fn put_together(
    named: &[(String, PathBuf)],
    out: &Path,
    force: bool,
    by: CompareBy,
) -> Result<(), Failure> {
    let mut runs = Vec::with_capacity(named.len());
    for (name, path) in named {
        let frames = RecordedFrames::read(path)
            .map_err(|error| Failure::input(miette::miette!("{error}")))?;
        super::export::tell_where_it_breaks_off(path, &frames);
        runs.push(RunBeside {
            name: name.clone(),
            frames,
        });
    }
    let by = match by {
        CompareBy::Time => ComparedBy::Time,
        CompareBy::Place => ComparedBy::Place,
    };
    let beside = side_by_side(&runs, out, Overwrite::from_force(force), by)?;
    let text = format!(
        "{}: {} side by side at {}, pictures at most {} of a step apart; pressures differ by {} GPa at most\n",
        out.display(),
        counted(runs.len() as u64, "run"),
        counted(beside.pictures, "moment"),
        sig(beside.apart_steps, 2),
        sig(GPA.of(beside.difference_pa), 3),
    );
    let lives = beside.lives.iter().map(|life| format!("{life}\n"));
    super::scenes::print(&lives.fold(text, |text, life| text + &life))?;
    Ok(())
}
