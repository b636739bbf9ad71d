//! Files, safely: plain ones are read and never more of them than asked for; new ones are written whole or not at
//! all; digests.

mod digest;
mod read;
mod write;

pub use digest::{FnvHasher, fnv};
pub use read::{give_file, given_file, open_plain, read_up_to};
pub use write::{
    beside, folder_of, identity, part_of, publish, stem_beside, sync_file, sync_folder, write_whole,
};
