//! Which program wrote a file.

/// Identity of the engine that a program was built with: FNV-1a of its sources, dependencies, compiler and target
/// (`src/session/build.rs`). Two programs of the same one give the same numbers on the same kind of CPU.
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
