//! The files that a run writes: looked at before it starts so that a bad path costs nothing, and after all that it
//! reads has been read, so that a bad input costs no file.

use std::path::{Path, PathBuf};

use asperity_engine::observe::{Claim, ObserveError, Overwrite};
use asperity_engine::scene::Scene;
use asperity_engine::sim::Summary;
use asperity_picture::export::{Export, Format};
use asperity_session::run::{Switch, Watcher};
use asperity_session::{Queue, Table, WhenFull};

use super::args::RunArgs;
use super::failure::Failure;
#[cfg(feature = "rerun")]
use super::live;
use super::scenes::print;

/// Who waits when the recorder is slower than the run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum RecorderPace {
    /// The run: the file is complete.
    Headless,
    /// Nobody: frames are skipped and counted.
    #[cfg_attr(not(feature = "tui"), expect(dead_code, reason = "the explorer's"))]
    Live,
}

impl RecorderPace {
    fn when_full(self) -> WhenFull {
        match self {
            Self::Headless => WhenFull::Wait,
            Self::Live => WhenFull::Skip,
        }
    }
}

/// Frames that may wait for a file: some MB, a few hundredths of a second.
const FILES_WAITING: usize = 8;

/// The outputs of one run.
pub(crate) struct Outputs {
    /// For the session.
    pub(crate) watchers: Vec<Watcher>,
    /// The recording.
    #[cfg_attr(not(feature = "tui"), expect(dead_code, reason = "the explorer's"))]
    pub(crate) recording: Option<Recording>,
    summary: SummaryTo,
    /// Serves viewers when the run has ended.
    #[cfg(feature = "rerun")]
    held: Option<asperity_recorder::Server>,
}

/// The recording of a run.
#[derive(Debug, Clone)]
#[cfg_attr(not(feature = "tui"), expect(dead_code, reason = "the explorer's"))]
pub(crate) struct Recording {
    /// Its name in messages: the path that it will have.
    pub(crate) name: String,
    /// The file that is written now: that path, or beside it where another file has it still.
    pub(crate) path: PathBuf,
    /// Turns it on and off.
    pub(crate) switch: Switch,
}

enum SummaryTo {
    People,
    Stdout,
    File(Claim),
}

impl Outputs {
    /// Opens everything that is written bit by bit and looks at the rest. `recording` is where the recording goes, if
    /// the plan has one.
    pub(crate) fn open(
        args: &RunArgs,
        scene: &Scene,
        recording: &Path,
        pace: RecorderPace,
    ) -> Result<Self, Failure> {
        let overwrite = Overwrite::from_force(args.force);
        let mut outputs = Self {
            watchers: Vec::new(),
            recording: None,
            summary: SummaryTo::claim(args.summary.as_deref(), overwrite)?,
            #[cfg(feature = "rerun")]
            held: None,
        };
        outputs.open_recording(scene, recording, overwrite, pace)?;
        outputs.open_live(args, scene)?;
        if let Some(path) = &args.table {
            let table = Table::create(path, overwrite)?;
            let name = path.display().to_string();
            outputs
                .watchers
                .push(Watcher::new(name, Box::new(table), 1));
        }
        if let Some(folder) = &args.export {
            if args.export_as.contains(&Format::Csv) {
                return Err(Failure::input(miette::miette!(
                    help = "--table FILE.csv writes every scalar of every step",
                    "--export-as csv: a run has its own table"
                )));
            }
            let export = Export::create(folder, overwrite, &args.export_as)?;
            let export = export.every(args.export_every);
            let name = folder.display().to_string();
            let queue = Queue::spawn("export", FILES_WAITING, pace.when_full(), Box::new(export))?;
            // Pictures show what the point has met in the steps between.
            let draws = args.export_as.iter().any(|format| format.is_drawn());
            let every = if draws { 1 } else { args.export_every };
            outputs
                .watchers
                .push(Watcher::new(name, Box::new(queue), every));
        }
        Ok(outputs)
    }

    #[cfg(feature = "rerun")]
    fn open_recording(
        &mut self,
        scene: &Scene,
        path: &Path,
        overwrite: Overwrite,
        pace: RecorderPace,
    ) -> Result<(), ObserveError> {
        use asperity_recorder::Recorder;
        let Some(record) = &scene.record else {
            return Ok(());
        };
        let recorder = Recorder::create(path, overwrite, record)?;
        let recorder = match pace {
            RecorderPace::Live => recorder.by_hand(),
            RecorderPace::Headless => recorder,
        };
        let written = recorder.path().unwrap_or_else(|| path.to_owned());
        let queue = Queue::spawn(
            "record",
            FILES_WAITING,
            pace.when_full(),
            Box::new(recorder),
        )?;
        let name = path.display().to_string();
        // Every step goes to it: it thins fields itself, by what the file has grown to.
        let watcher = Watcher::new(name.clone(), Box::new(queue), 1);
        self.recording = Some(Recording {
            name,
            path: written,
            switch: watcher.switch(),
        });
        self.watchers.push(watcher);
        Ok(())
    }

    /// One stream, one thread and one queue for each viewer: a slow one delays nobody.
    #[cfg(feature = "rerun")]
    fn open_live(&mut self, args: &RunArgs, scene: &Scene) -> Result<(), Failure> {
        use asperity_recorder::{Live, Recorder};
        /// Frames that may wait: about half a second of the screen's pace.
        const WAITING: usize = 16;
        let mut viewers = Vec::new();
        if let Some(address) = &args.connect {
            viewers.push(Live::Connect(live::address(address)?));
        }
        if args.spawn {
            viewers.push(Live::Connect(live::spawn()?));
        }
        if let Some(port) = args.serve {
            // Port 0 asks for any that is free; viewers must be told which.
            let port = if port == 0 { live::free_port()? } else { port };
            viewers.push(Live::Serve(port));
        }
        let record = scene.record.clone().unwrap_or_default();
        for viewer in viewers {
            let recorder = Recorder::live(viewer, &record)?;
            if let Live::Serve(port) = viewer {
                live::announce(port);
                self.held = args.hold.then(|| recorder.server());
            }
            let name = viewer.to_string();
            let queue = Queue::spawn_live(&name, WAITING, Box::new(recorder))?;
            self.watchers.push(Watcher::new(name, Box::new(queue), 1));
        }
        Ok(())
    }

    #[cfg(not(feature = "rerun"))]
    #[expect(clippy::unused_self, reason = "same form as with the feature rerun")]
    fn open_live(&mut self, args: &RunArgs, _scene: &Scene) -> Result<(), Failure> {
        if args.connect.is_some() || args.spawn || args.serve.is_some() {
            return Err(Failure::without_recorder("shows nothing to viewers"));
        }
        Ok(())
    }

    #[cfg(not(feature = "rerun"))]
    #[expect(
        clippy::unused_self,
        clippy::unnecessary_wraps,
        reason = "same form as with the feature rerun"
    )]
    fn open_recording(
        &mut self,
        _scene: &Scene,
        _path: &Path,
        _overwrite: Overwrite,
        _pace: RecorderPace,
    ) -> Result<(), ObserveError> {
        Ok(())
    }

    /// Writes the summary where it was asked for; then a server that is held serves on. `people` is the text for a reader.
    pub(crate) fn write_summary(
        self,
        summary: Option<&Summary>,
        people: &str,
    ) -> Result<(), ObserveError> {
        self.summary.write(summary, people)?;
        #[cfg(feature = "rerun")]
        if self.held.is_some() {
            live::wait_for_enter();
        }
        Ok(())
    }

    /// Splits the watchers, which go to the session, from the rest.
    pub(crate) fn take_watchers(&mut self) -> Vec<Watcher> {
        std::mem::take(&mut self.watchers)
    }
}

impl SummaryTo {
    fn claim(path: Option<&Path>, overwrite: Overwrite) -> Result<Self, ObserveError> {
        match path {
            None => Ok(Self::People),
            Some(path) if path.as_os_str() == "-" => Ok(Self::Stdout),
            Some(path) => Ok(Self::File(overwrite.claim(path)?)),
        }
    }

    fn write(self, summary: Option<&Summary>, people: &str) -> Result<(), ObserveError> {
        let json = |summary: &Summary| {
            serde_json::to_string_pretty(summary)
                .map(|text| text + "\n")
                .map_err(|error| ObserveError::new("summary", error.to_string()))
        };
        match (self, summary) {
            (Self::Stdout, Some(summary)) => print(&json(summary)?),
            (Self::Stdout, None) => Ok(()),
            (Self::File(mut claim), Some(summary)) => {
                if summary.stopped {
                    claim.cut_short();
                }
                // The file first: what cannot be told is no reason to lose it.
                let written = claim.write(json(summary)?.as_bytes());
                print(people).and(written)
            }
            (Self::People | Self::File(_), _) => print(people),
        }
    }
}
