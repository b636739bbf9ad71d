//! Reading: plain files only. A pipe may never end, or never begin. And what was given instead of a file: a page has none.

use std::cell::RefCell;
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

/// Files given at once: one for each body.
const GIVEN: usize = 2;

thread_local! {
    /// Name and bytes, the last one first.
    static GIVEN_FILES: RefCell<Vec<(String, Vec<u8>)>> = const { RefCell::new(Vec::new()) };
}

/// Gives this thread what a height map of that name holds: it is read in the file's place, whatever folder is asked for. The last
/// two stay.
pub fn give_file(name: &str, bytes: Vec<u8>) {
    GIVEN_FILES.with_borrow_mut(|files| {
        files.retain(|(own, _)| own != name);
        files.insert(0, (name.to_owned(), bytes));
        files.truncate(GIVEN);
    });
}

/// What was [given](give_file) by that name.
pub fn given_file(path: &Path) -> Option<Vec<u8>> {
    let name = path.file_name()?.to_str()?;
    GIVEN_FILES.with_borrow(|files| {
        let found = files.iter().find(|(own, _)| own == name);
        found.map(|(_, bytes)| bytes.clone())
    })
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
