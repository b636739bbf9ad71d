//! What several test programs share.
#![allow(dead_code, clippy::unwrap_used, reason = "each program uses its part")]

pub(crate) mod contact;
pub(crate) mod keeper;
pub(crate) mod maps;
#[cfg(unix)]
pub(crate) mod pty;
pub(crate) mod stiff;
pub(crate) mod synthetic;
#[cfg(feature = "tui")]
pub(crate) mod tui_fixture;
pub(crate) mod workers;
