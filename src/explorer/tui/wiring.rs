//! What the screen needs from the run: frames, a way to command, and a few words of state.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::sync::mpsc::{Receiver, Sender};

use thiserror::Error;

use crate::tui::lessons::Lesson;
use asperity_engine::plan::{LeftOut, Plan};
use asperity_engine::scene::Scene;
use asperity_engine::sim::Frame;
use asperity_session::Latest;
use asperity_session::run::{Command, Settled};
use asperity_session::sweep::{Background, CurveOrder};

/// How the run is.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum Health {
    /// It steps, or waits for a command.
    #[default]
    Running,
    /// It ended of itself: the scene's length is done.
    Finished,
    /// It failed; what went wrong, in words.
    Failed(String),
}

/// How the recording is.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct RecorderState {
    /// Which file.
    pub output: String,
    /// Whether it takes frames now.
    pub activity: RecorderActivity,
    /// Frames written.
    pub frames: u64,
    /// Frames skipped because it could not keep up.
    pub skipped: u64,
    /// Bytes written, where known.
    pub bytes: u64,
}

/// Whether a recorder takes frames.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum RecorderActivity {
    /// It does.
    #[default]
    Recording,
    /// It was told not to.
    Paused,
    /// It stopped: its budget is used up, or its output failed.
    Stopped,
}

/// What the screen asks the run about before each drawing.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RunStatus {
    /// How the run is.
    pub health: Health,
    /// How the recording is; `None`: there is none.
    pub recorder: Option<RecorderState>,
    /// Whether the run climbs several meshes.
    pub climbs: bool,
    /// The finer mesh that is under way, nodes per side, and how much of it is done, 0 to 1; `None`: the last is reached.
    pub finer: Option<(usize, f64)>,
}

/// Something that a key does outside of the screen; the answer is one line for the status bar.
pub type Errand = Box<dyn FnMut() -> Result<String, String>>;

/// Writes a scene (its TOML text) and says where.
pub type SaveScene = Box<dyn FnMut(&str) -> Result<PathBuf, String>>;

/// Starts a sweep beside the run, from where it has settled.
pub type StartSweep = Box<dyn FnMut(CurveOrder) -> Option<Background>>;

/// What is on the screen, to be written.
#[derive(Debug, Clone)]
pub struct Shown {
    /// The frame.
    pub frame: Arc<Frame>,
    /// The scene as it is now, as TOML.
    pub scene_toml: String,
    /// Tables: file name and comma-separated text.
    pub tables: Vec<(&'static str, String)>,
}

/// Writes what is shown on a thread of its own; the answer is one line for the status bar.
pub type WriteShown = Box<dyn FnMut(Shown) -> Receiver<Result<String, String>>>;

/// Ends the run and starts one of another scene, whose files get the name; what it gives replaces the whole wiring (but for
/// [`Wiring::rebuild`] itself, which stays).
pub type Rebuild = Box<dyn FnMut(&Scene, &str) -> Result<Wiring, String>>;

/// The run behind the screen, as far as it is known before its first frame; plain data, so that a test can make it.
#[derive(Debug, Clone)]
pub struct Setup {
    /// The scene that runs.
    pub scene: Arc<Scene>,
    /// Its name: that of its preset or file.
    pub name: String,
    /// The load, N, of a line N/m (the scene may give it as a Hertz pressure).
    pub load_n: f64,
    /// Hertz half-width along x at that load, m.
    pub half_width_m: f64,
    /// Hertz pressure at that load, Pa.
    pub p_hertz_pa: f64,
    /// The plan as text.
    pub plan_text: String,
    /// What it leaves out.
    pub left_out: Vec<LeftOut>,
}

impl Setup {
    /// A scene of that name by its plan.
    pub fn of(scene: Arc<Scene>, name: &str, plan: &Plan) -> Self {
        Self {
            scene,
            name: name.to_owned(),
            load_n: plan.force_n,
            half_width_m: plan.hertz.a_m,
            p_hertz_pa: plan.hertz.p_max_pa,
            plan_text: plan.to_string(),
            left_out: plan.left_out.clone(),
        }
    }
}

/// What the program itself fills in. An errand that is `None` has no key and no row in the help.
pub struct Wiring {
    /// The run that is shown.
    pub setup: Setup,
    /// The newest frame.
    pub frames: Latest,
    /// Where commands go. A run that has ended and hears nothing is no error.
    pub commands: Sender<Command>,
    /// Asked before each drawing; must not block.
    pub status: Box<dyn FnMut() -> RunStatus>,
    /// One period of the passage, once it repeats; asked before each drawing.
    pub settled: Box<dyn FnMut() -> Option<Arc<Settled>>>,
    /// Sweeps S or the speed beside the run.
    pub start_sweep: Option<StartSweep>,
    /// Raised when the process is asked to end (SIGTERM, SIGHUP): the screen closes.
    pub interrupt: Arc<AtomicBool>,
    /// Switches recording on and off.
    pub toggle_recording: Option<Errand>,
    /// Opens the recording in the viewer.
    pub open_viewer: Option<Errand>,
    /// Runs another scene.
    pub rebuild: Option<Rebuild>,
    /// Saves the scene as it now is.
    pub save_scene: Option<SaveScene>,
    /// Writes the frame on the screen as fields, pictures and tables.
    pub write_shown: Option<WriteShown>,
    /// A lesson to begin with.
    pub lesson: Option<Arc<Lesson>>,
}

/// Why the screen ended otherwise than by `q`.
#[derive(Debug, Error)]
pub enum TuiError {
    /// The terminal cannot place a cursor.
    #[error("the terminal {term:?} cannot show the explorer; `asperity run` needs no screen")]
    NoScreen {
        /// `TERM`.
        term: String,
    },
    /// The terminal failed or went away.
    #[error("the terminal is gone or failed: {0}")]
    Terminal(#[from] std::io::Error),
}
