//! What a recording was made of.

use std::io::BufReader;
use std::path::Path;

use super::super::message::{self, Ends};
use super::super::note::Note;

/// Program and scene of a recording. Its messages are counted before anything of them is believed.
pub(super) fn origin(path: &Path) -> Result<(String, String), String> {
    let unread = |error: std::io::Error| format!("cannot be read: {error}");
    let file = asperity_engine::files::open_plain(path).map_err(unread)?;
    let bytes = file.metadata().map_err(unread)?.len();
    let mut origin = None;
    let (ends, unreadable) = message::read(BufReader::new(file), bytes, |data| {
        Note::all_in(data, |note| {
            if let Note::Origin {
                program,
                scene_toml,
                ..
            } = note
            {
                origin = Some((program, scene_toml));
            }
        });
    })?;
    match ends {
        Ends::Early { at, reason } => Err(format!("damaged at byte {at} of {bytes} ({reason})")),
        _ if unreadable > 0 => Err(format!(
            "damaged: {unreadable} of its messages cannot be read"
        )),
        _ => origin.ok_or_else(|| {
            "holds no run: not recorded by this version of asperity, or several side by side"
                .to_owned()
        }),
    }
}
