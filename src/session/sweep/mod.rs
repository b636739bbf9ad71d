//! Sweeps: life maps and operating paths, from one machine to a cluster.
//!
//! ```text
//! SWEEP.toml ─> Sweep ─> cases ─> chains                  fixed by the file alone
//!                          │         └ first case cold, the others from the end of the one before; taken by whoever is free
//!                          └ one file each, whole or not at all ─> table.csv, plots
//! ```
//! What a case is, in [`Sweep`]; what is to be run, in [`Work`]; what is kept, in [`Folder`]; what comes out, in
//! [`Rows`]. The table is the same byte for byte whatever the processes, the threads and the interruptions. The
//! explorer runs the same cases beside a live run: [`Background`].

mod axis;
mod background;
mod case;
mod chain;
mod cold;
mod common;
mod error;
mod flank;
mod folder;
mod maps;
mod over_seeds;
mod path;
#[cfg(not(target_arch = "wasm32"))]
mod plots;
mod points;
mod presets;
mod read;
mod reader;
mod ride;
mod ring;
mod run;
mod spec;
mod status;
mod table;
mod window;
mod work;

pub use axis::{MOST_CASES, VariedKey, WARM};
pub use background::{
    Along, Background, CurveOrder, CurvePoint, Found, Ground, SweepWorker, Varied,
};
pub use case::{CaseEnd, CaseRecord, CaseStart};
pub use chain::{ChainList, Shard};
pub use cold::{ColdComparison, against_cold};
pub use error::SweepError;
pub use flank::FlankLife;
pub use folder::{Claimed, Existing, Folder};
pub use over_seeds::Scatter;
pub use path::PathPoint;
#[cfg(not(target_arch = "wasm32"))]
pub use plots::{draw, pictures};
pub use points::{points, points_csv};
pub use presets::{SweepPreset, all as presets, names as preset_names};
pub use ring::RingLife;
pub use run::{Progress, Report, run};
pub use spec::{ChainKeys, Combine, Sweep};
pub use status::{Status, manifest};
pub use table::Rows;
pub use work::Work;
