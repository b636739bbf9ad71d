//! Reading: plain files only. A pipe may never end, or never begin.

use std::fs::File;
use std::io::{Error, ErrorKind, Read as _, Result};
use std::path::Path;

/// Opens a plain file, or a link to one.
///
/// # Errors
/// When it cannot be read, or is a folder, a pipe or a device.
pub fn open_plain(path: &Path) -> Result<File> {
    // Looked at before it is opened: to open a pipe is to wait for somebody who writes into it.
    if !std::fs::metadata(path)?.is_file() {
        let reason = "not a plain file (a folder, a pipe or a device)";
        return Err(Error::new(ErrorKind::InvalidInput, reason));
    }
    File::open(path)
}

/// What a plain file holds, but at most `most` bytes and one: more than `most` says that it is longer.
///
/// # Errors
/// As [`open_plain`].
pub fn read_up_to(path: &Path, most: u64) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    open_plain(path)?
        .take(most.saturating_add(1))
        .read_to_end(&mut bytes)?;
    Ok(bytes)
}
