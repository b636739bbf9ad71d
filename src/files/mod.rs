//! Files, safely: plain ones are read and never more of them than asked for; new ones are written whole or not at
//! all; digests; which program wrote them.

mod digest;
mod read;
mod write;

pub use digest::{FnvHasher, fnv};
pub use read::{open_plain, read_up_to};
pub(crate) use write::{folder_of, part_of, publish, sync_file, sync_folder};
pub use write::{identity, write_whole};

/// Identity of the engine that a program was built with: FNV-1a of its sources, dependencies, compiler and target
/// (`src/build.rs`). Two programs of the same one give the same numbers on the same kind of CPU.
pub const BUILD: &str = env!("ASPERITY_BUILD");
/// Version and build.
pub const VERSION: &str = concat!(
    env!("CARGO_PKG_VERSION"),
    " (build ",
    env!("ASPERITY_BUILD"),
    ")"
);
/// Name, version and build: what files say wrote them.
pub const PROGRAM: &str = concat!(
    "asperity ",
    env!("CARGO_PKG_VERSION"),
    " (build ",
    env!("ASPERITY_BUILD"),
    ")"
);
