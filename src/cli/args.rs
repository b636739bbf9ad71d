//! The command line's words.

mod recordings;
mod study;
mod surface;
mod sweep_texts;

use std::borrow::Cow;
use std::ffi::OsString;
use std::path::PathBuf;

use asperity_engine::scene::{Knob, presets};
use asperity_picture::export::Format;
use asperity_session::sweep::{ChainList, Shard};
use clap::{Args, Parser, Subcommand};

use self::recordings::export_formats;
pub(crate) use self::recordings::{BesideValues, CompareArgs, CompareBy, ExportArgs};

pub(crate) use self::study::{StudyArgs, StudyKind};
pub(crate) use self::surface::{SurfaceArgs, Turn};
use self::sweep_texts::{SWEEP_ABOUT, SWEEP_EXAMPLES};

const ABOUT: &str =
    "Explorer of rolling-sliding contact fatigue: rough lubricated contacts, stress, life";

const LONG_ABOUT: &str = "\
Explorer of rolling-sliding contact fatigue.

Two rough bodies roll and slide on each other with oil between them. asperity steps pressure and film through
time while the roughness of both bodies moves through the contact, computes traction and subsurface stress, counts
stress cycles, and gives a fatigue life relative to the smooth, frictionless contact in pure rolling.

S = (U2 - U1)/U is the slide-to-roll ratio, U = (U1 + U2)/2 the entrainment speed; S > 0: body 1 is the slower.
All numbers are in SI units; the name of each key ends in its unit.";

const EXAMPLES: &str = "\
Without a command: on a terminal the explorer on the default scene, recording to ./recordings/; otherwise one
headless passage of it, written to ./asperity.rrd (replaced each time), with the summary on stdout.

Examples:
  asperity                                                 the explorer
  asperity run                                             one headless run of the default scene
  asperity run mtm_ball_on_disc --set motion.slide_roll=1  another scene, sliding at S = 1
  asperity run --no-record --summary -                     results as JSON on stdout
  asperity check twin_disc --set grid.nodes=257            what would be computed, and what it costs
  asperity scenes                                          the scenes that come with the program
  asperity scenes demonstration > mine.toml                a copy to edit, every key explained
  asperity view demonstration.rrd                          the recording in the Rerun viewer
  asperity compare one.rrd two.rrd                         two recordings side by side
  asperity export demonstration.rrd                        a moving picture of it (GIF); also PNG, SVG, PDF, npz, CSV

Exit codes: 0 converged; 1 bad input; 2 the run ended but some steps did not converge (they are named);
3 the run stalled; 4 an output failed; 5 it was stopped (Ctrl-C, SIGTERM, SIGHUP) before its end, or the recording that
it repeats breaks off.

Outputs: a file that is there is replaced (--force) only by one that is whole; until then the new one lies beside it,
as NAME.part-PID-N.ENDING, which is what a killed run leaves; that of a stopped run stays as NAME.stopped.ENDING.
Results are the same bit for bit on any number of threads and on every CPU with the same vector units; between kinds of
CPU they differ by rounding (about 1e-7).";

/// The whole command line.
#[derive(Debug, Parser)]
#[command(
    name = "asperity",
    version = asperity_session::program::VERSION,
    about = ABOUT,
    long_about = LONG_ABOUT,
    after_long_help = EXAMPLES,
    max_term_width = 110
)]
pub(crate) struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub(crate) command: Option<CliCommand>,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum CliCommand {
    /// Open the explorer: the contact live, with knobs to turn
    #[command(after_long_help = Knob::table())]
    Explore {
        #[command(flatten)]
        run: RunArgs,
        /// Begin with a lesson of your own
        #[arg(long, value_name = "FILE.toml")]
        lesson: Option<PathBuf>,
    },
    /// Run a scene without a screen
    #[command(after_long_help = "\
Examples:
  asperity run --out passage.rrd --table passage.csv
  asperity run --set load.hertz_pressure_pa=1.2e9 --set body_1.surface.kind=smooth
  asperity run --set lubricant=none --passages 1 --no-record --summary dry.json
  asperity run --passages 1 --save-state half.state
  asperity run --passages 2 --from-state half.state        continues as if it had never stopped
  asperity run --export fields --export-every 32           pressure, film, stress for numpy
  asperity run --export pictures --export-as png           the maps and the centre line as pictures
  asperity run --no-record --spawn                         starts a viewer and shows the run live
  asperity run --from lecture.rrd --out again.rrd          repeats what a recording shows, bit for bit
  asperity run --beside motion.slide_roll=0,0.5            both, side by side in one recording")]
    Run(HeadlessArgs),
    /// Print the plan: what is computed, what is not and why, memory, estimated time
    Check(SceneArgs),
    /// List the scenes that come with the program, or print one as TOML with every key explained
    Scenes {
        /// Preset to print
        name: Option<String>,
    },
    /// Say what a measured or made surface is: roughness parameters, what a cut-off keeps; write a scene with it
    #[command(after_long_help = "\
Examples:
  asperity surface flank.x3p                               best plane taken off, no other filter
  asperity surface scan.csv --pixel-m 1e-6 --unit-m 1e-9   where the file says neither
  asperity surface flank.sur --level quadratic --scene flank.toml
  asperity surface flank.sur --crop-m 5e-6 --turn-deg lay --s-filter-m 2.5e-6 --l-filter-m 8e-4 --scene flank.toml
  asperity surface random_rollers                          the surfaces of a scene")]
    Surface(SurfaceArgs),
    /// Measure accuracy, cost and limits of the program itself
    #[command(after_long_help = "\
Each study prints its table and, with --out, writes it as Markdown and CSV, with plots as SVG where there are any.

Examples:
  asperity study accuracy --out report      error against run time, part by part: CSV, Markdown, SVG
  asperity study stability --quick          some of the stiff and extreme cases, within a minute
  asperity study stability --only jump      only the cases with jump in their name or group
  asperity study accuracy --full --only default        the default scene against 513 nodes, its frames a second
  asperity study scaling                    cost of a step by grid, symmetry, threads and regime

Exit codes: 0 all as required; 2 something did not converge or exceeds its bound (the table says what).")]
    Study(StudyArgs),
    /// Run many cases of a scene: life maps, operating paths; one table, plots
    #[command(long_about = SWEEP_ABOUT, after_long_help = SWEEP_EXAMPLES)]
    Sweep(SweepArgs),
    /// Put two or three recordings side by side: common ranges and moments, one file
    #[command(after_long_help = "\
Examples:
  asperity compare rolling.rrd sliding.rrd --out both.rrd
  asperity compare fine.rrd coarse.rrd --by place          the same crest at the same place
  asperity run demonstration --beside motion.slide_roll=0,0.5    runs both first")]
    Compare(CompareArgs),
    /// Make pictures, animations and tables of a recording
    #[command(after_long_help = "\
Examples:
  asperity export passage.rrd                              the passage as an animation (GIF)
  asperity export rolling.rrd --beside sliding.rrd         two of them side by side
  asperity export passage.rrd --as png,npz --every 32      pictures and fields of every 32nd step
  asperity export passage.rrd --as npz-series,vti --every 1  fields with a time axis, for numpy and ParaView
  asperity export passage.rrd --as svg,pdf --show pressure,centre_line --width-mm 85
  asperity export passage.rrd --as csv                     every scalar of every step

Pictures: pressure, film, interferogram, traction, roughness_1, roughness_2, effective_stress, tau_xz, centre_line,
profile, damage_1, damage_2. Numbers are in SI; fields have the half precision (0.05 %) of the recording, scalars all
their digits. For Python: assets/asperity.py reads a recording into numpy.")]
    Export(ExportArgs),
    /// One page for a browser and a printer: what runs, life and why, tables with their formulas and sources
    #[command(after_long_help = "\
Examples:
  asperity sweep fzg_c                       a gear along its line of action, into ./fzg_c.sweep/
  asperity report fzg_c.sweep                ./fzg_c.sweep/report.html: radii, speeds, film, lambda_GF, life, cautions
  asperity run --out passage.rrd
  asperity report passage.rrd                ./passage.html

Every number is one of the sweep's table.csv, flank.csv or seeds.csv. Print it to PDF from the browser (A4).")]
    Report(ReportArgs),
    /// Open a recording in the Rerun viewer, or say how to get the viewer
    View {
        /// Recording, as written by run and explore
        #[arg(value_name = "FILE.rrd")]
        file: PathBuf,
    },
}

/// What to report on.
#[derive(Debug, Args)]
pub(crate) struct ReportArgs {
    /// Folder of a sweep, or a recording
    #[arg(value_name = "FOLDER|FILE.rrd")]
    pub(crate) of: PathBuf,
    /// Page to write [default: report.html in the sweep's folder, or beside the recording]
    #[arg(long, value_name = "FILE.html")]
    pub(crate) out: Option<PathBuf>,
    /// Replace the file if it exists
    #[arg(long)]
    pub(crate) force: bool,
}

/// Which sweep, and how to run it.
#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub(crate) struct SweepArgs {
    #[command(subcommand)]
    pub(crate) command: Option<SweepCommand>,
    /// Built-in sweep, or TOML file
    #[arg(required = true)]
    pub(crate) sweep: Option<String>,
    /// Part of the sweep to run: every n-th chain from the i-th on, i from 1 (one folder each, or one for all)
    #[arg(long, value_name = "I/N", conflicts_with = "chain")]
    pub(crate) shard: Option<Shard>,
    /// Run these chains only, such as 3 or 0,4-7, for an engine that shares them out; makes no table
    #[arg(long, value_name = "ID")]
    pub(crate) chain: Option<ChainList>,
    /// Folder for cases, table and plots [default: ./NAME.sweep]
    #[arg(long, value_name = "FOLDER")]
    pub(crate) out: Option<PathBuf>,
    /// Continue where the folder's cases end, or help whoever works in it
    #[arg(long, conflicts_with = "force")]
    pub(crate) resume: bool,
    /// Delete existing cases in the folder
    #[arg(long)]
    pub(crate) force: bool,
    /// Chains at a time, one thread each [default: all cores]; the table does not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub(crate) threads: Option<u16>,
    /// Also run every case cold, as asperity run would, and print what the chains save
    #[arg(long, conflicts_with_all = ["chain", "shard"])]
    pub(crate) compare_cold: bool,
    /// Print one of these about the sweep instead of running it
    #[arg(long, value_enum, value_name = "WHAT")]
    pub(crate) show: Option<SweepShown>,
}

/// What to print of a sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum SweepShown {
    /// The sweep file, as a start for your own
    File,
    /// What closed-form formulas give for every case, as CSV
    Points,
    /// The chains with their cases, estimated seconds on one core and memory, as CSV
    Manifest,
    /// A scene that follows a [gear] path in real time, for asperity run and its recording
    Ride,
}

/// What else there is to do with a sweep.
#[derive(Debug, Subcommand)]
pub(crate) enum SweepCommand {
    /// Say how far the sweep in a folder is, who works on it and what is left
    Status {
        /// The sweep's folder
        folder: PathBuf,
    },
    /// Merge the cases of folders into one table, and name what is missing
    Collect {
        /// Folders with cases of one sweep
        #[arg(required = true, value_name = "FOLDER")]
        folders: Vec<PathBuf>,
        /// Folder for table and plots [default: the first]
        #[arg(long, value_name = "FOLDER")]
        out: Option<PathBuf>,
    },
}

/// Which scene.
#[derive(Debug, Clone, Args)]
pub(crate) struct SceneArgs {
    /// Preset (see `asperity scenes`) or TOML file
    #[arg(default_value = presets::DEFAULT)]
    pub(crate) scene: OsString,
    /// Set a key of the scene, such as motion.slide_roll=0.5; KEY=none removes a key or table. Repeatable
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub(crate) settings: Vec<String>,
    /// Length of the run after the start-up, in passages of 4 a at speed U (sets time.passages); left out by scene and here: until the life has settled, 2 at most
    #[arg(long, value_name = "N")]
    pub(crate) passages: Option<f64>,
    /// Loading cycles that surfaces with a table [wear] have behind them at the end (sets age.cycles)
    #[arg(long, value_name = "N")]
    pub(crate) cycles: Option<f64>,
    /// Nodes per side of the last mesh, 2^k + 1 (sets grid.nodes): fewer for the impatient
    #[arg(long, value_name = "N")]
    pub(crate) nodes: Option<u16>,
}

impl SceneArgs {
    /// The scene's name, or its path as far as it is text.
    pub(crate) fn name(&self) -> Cow<'_, str> {
        self.scene.to_string_lossy()
    }
}

/// How to run it and what to write.
#[derive(Debug, Clone, Args)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "flags of a command line, each of its own"
)]
pub(crate) struct RunArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// Recording to write [default: ./SCENE.rrd, or ./recordings/ in the explorer]
    #[arg(long, value_name = "FILE.rrd", conflicts_with = "no_record")]
    pub(crate) out: Option<PathBuf>,
    /// Table to write: every scalar of every step, as CSV
    #[arg(long, value_name = "FILE.csv")]
    pub(crate) table: Option<PathBuf>,
    /// Folder for the fields of selected steps (step_000016.npz, ... or pictures), together with the scene
    #[arg(long, value_name = "FOLDER")]
    pub(crate) export: Option<PathBuf>,
    /// What to export of a step: fields as numpy archives, maps and centre line as pictures, or both
    #[arg(
        long,
        value_name = "FORMATS",
        value_parser = export_formats(),
        value_delimiter = ',',
        default_value = "npz",
        requires = "export"
    )]
    pub(crate) export_as: Vec<Format>,
    /// Export every N-th step
    #[arg(long, value_name = "N", default_value_t = 16, requires = "export",
        value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) export_every: u64,
    /// Summary to write as JSON; - writes it to stdout instead of the text
    #[arg(long, value_name = "FILE.json|-")]
    pub(crate) summary: Option<PathBuf>,
    /// Worker threads [default: all cores]; results do not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub(crate) threads: Option<u16>,
    /// Also show the run in a Rerun viewer that is open [default address: 127.0.0.1:9876]
    #[arg(long, value_name = "ADDRESS", num_args = 0..=1, require_equals = true,
        default_missing_value = "127.0.0.1:9876")]
    pub(crate) connect: Option<String>,
    /// Also start a Rerun viewer and show the run in it
    #[arg(long)]
    pub(crate) spawn: bool,
    /// Let viewers on this machine connect, such as one in a browser [default port: 9876]
    #[arg(long, value_name = "PORT", num_args = 0..=1, require_equals = true,
        default_missing_value = "9876")]
    pub(crate) serve: Option<u16>,
    /// With --serve: go on serving when the run has ended, until Enter or Ctrl-C
    #[arg(long, requires = "serve")]
    pub(crate) hold: bool,
    /// Write no recording
    #[arg(long)]
    pub(crate) no_record: bool,
    /// Replace output files that exist
    #[arg(long)]
    pub(crate) force: bool,
}

/// A run without a screen, which may be saved and taken up again.
#[derive(Debug, Clone, Args)]
pub(crate) struct HeadlessArgs {
    #[command(flatten)]
    pub(crate) run: RunArgs,
    /// Save the state to this file when the run ends, for --from-state
    #[arg(long, value_name = "FILE")]
    pub(crate) save_state: Option<PathBuf>,
    /// Continue from the saved state of a run of the same scene; the result equals one whole run, bit for bit
    #[arg(long, value_name = "FILE")]
    pub(crate) from_state: Option<PathBuf>,
    /// Repeat a recording: its scene, every knob turned at the same step as then; a damaged one exactly or not at all, that
    /// of a killed run as far as it goes
    #[arg(long, value_name = "FILE.rrd", conflicts_with_all = ["scene", "settings", "passages", "nodes", "from_state"])]
    pub(crate) from: Option<PathBuf>,
    /// Run at two or three values of a key and record the runs side by side, such as motion.slide_roll=0,0.5
    #[arg(long, value_name = "KEY=A,B", conflicts_with_all = ["from", "from_state", "save_state", "table", "summary",
        "export", "connect", "spawn", "serve", "no_record"])]
    pub(crate) beside: Option<BesideValues>,
    /// What is equal where these are shown together
    #[arg(
        long,
        value_enum,
        value_name = "WHAT",
        default_value = "time",
        requires = "beside"
    )]
    pub(crate) by: CompareBy,
}

impl HeadlessArgs {
    /// The same run with a key set, recorded to that file.
    #[cfg(feature = "rerun")]
    pub(crate) fn with(&self, key: &str, value: &str, out: &std::path::Path) -> Self {
        let mut args = self.clone();
        args.beside = None;
        args.run.out = Some(out.to_owned());
        let settings = &mut args.run.scene.settings;
        settings.push(format!("{key}={value}"));
        if self.by == CompareBy::Place {
            // Crests pass a place between two pictures: with all of them the nearest is within a step.
            settings.push("record.every_steps=1".to_owned());
        }
        args
    }
}

impl RunArgs {
    /// What a line without an option means.
    #[cfg(feature = "tui")]
    pub(crate) fn bare() -> Self {
        #[derive(Parser)]
        struct Line {
            #[command(flatten)]
            run: RunArgs,
        }
        Line::parse_from(["asperity"]).run
    }

    /// Worker threads.
    pub(crate) fn threads(&self) -> usize {
        threads(self.threads)
    }
}

/// As many as asked for, or one for each core.
pub(crate) fn threads(asked: Option<u16>) -> usize {
    let all = || std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    asked.map_or_else(all, usize::from)
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory as _;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }
}
