//! What the test programs of the engine share: nothing that names more than the engine.
#![allow(dead_code, clippy::unwrap_used, reason = "each program uses its part")]

#[path = "contact.rs"]
pub(crate) mod contact;
#[path = "maps.rs"]
pub(crate) mod maps;
#[path = "stiff.rs"]
pub(crate) mod stiff;
#[path = "workers.rs"]
pub(crate) mod workers;
