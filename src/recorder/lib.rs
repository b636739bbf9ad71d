//! The recording: everything a run hands out, as a Rerun file that opens laid out.
//!
//! Fields are stored in half precision with colour ranges of what can come ([`raster`]), the 3-D view is cut open
//! at y = 0 ([`space`]), scalars are recorded in every step where they fit, fields as often as the budget allows
//! ([`cadence`]). The file holds the scene as TOML, the plan and the log of commands, so that it
//! tells how to repeat itself. It is readable up to the last second if the process is killed, and has a footer when it
//! is finished ([`compact`]).
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

mod ages;
mod beside;
mod cadence;
mod centre_line;
mod classes;
mod colour;
mod compact;
mod damage;
mod depths;
mod destination;
mod entities;
mod file;
mod frames;
mod geometry;
mod interferogram;
mod kymograph;
mod layout;
mod legend;
mod levels;
mod live;
mod maps;
mod mesh;
mod messages;
mod moment;
mod note;
mod picture;
mod plot;
mod profile;
mod properties;
mod raster;
mod recorder;
mod repeat;
mod research;
mod run_views;
mod scalars;
mod series;
mod shown;
mod size;
mod slice;
mod space;
mod stream;
mod summary;
mod text;
mod tooth;
mod trace;
mod view;

pub use beside::{ComparedBy, LifeBeside, RunBeside, RunsCompared, compare};
pub use frames::RecordedFrames;
pub use live::Live;
pub use recorder::{Recorder, Server};
pub use repeat::{Recorded, RecordedTurn, RereadError};
pub use summary::note_summary;
