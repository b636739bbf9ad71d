//! The recording: everything a run hands out, as a Rerun file that opens laid out.
//!
//! Fields are stored in half precision with colour ranges of what can come ([`raster`]), the 3-D view is cut open
//! at y = 0 ([`space`]), scalars are recorded in every step where they fit, fields as often as the budget allows
//! ([`cadence`]). The file holds the scene as TOML, the plan and the log of commands, so that it
//! tells how to repeat itself. It is readable up to the last second if the process is killed, and has a footer when it
//! is finished ([`bound`]).
//!
//! Logging may block on the disk: run the recorder behind a [`Queue`](asperity_session::Queue), which
//! also keeps all its calls on one thread, as the library's timelines want it.

/// Compiles a function for the wide vector units too, and picks one at run time.
macro_rules! dispatched {
    ($function:item) => {
        #[multiversion::multiversion(targets(
            "x86_64+avx512f+avx512vl+avx512dq+avx512bw+fma",
            "x86_64+avx2+fma"
        ))]
        $function
    };
}

mod beside;
mod bound;
mod cadence;
mod centre_line;
mod classes;
mod colour;
mod damage;
mod depths;
mod destination;
mod file;
mod frames;
mod gate;
mod gathered;
mod geometry;
mod interferogram;
mod kymograph;
mod layout;
mod legend;
mod live;
mod maps;
mod mesh;
mod message;
mod moment;
mod note;
mod over_log;
mod picture;
mod plot;
mod profile;
mod properties;
mod raster;
mod recorder;
mod reread;
mod scalars;
mod series;
mod slice;
mod space;
mod stream;
mod text;
mod tooth;
mod trace;
mod waiting;
mod weight;

pub use beside::{ComparedBy, RunBeside, RunsCompared, compare};
pub use frames::RecordedFrames;
pub use gate::Gate;
pub use live::Live;
pub use properties::note_summary;
pub use recorder::Recorder;
pub use reread::{Recorded, RecordedTurn, RereadError};
