//! The messages of a recording's file, as bytes: every length is compared with what is there before it is believed.
//!
//! ```text
//! file     "RRF2", 8 bytes; messages
//! message  kind, length (u64 each, little-endian), that many bytes
//! data     protobuf: compression, length without it, the bytes (Arrow IPC)
//! end      a message of kind 0: the index; then 32 bytes: where it lies, "RRF2FOOT", how many there are (u32)
//! ```

use std::io::{BufReader, ErrorKind, Read};
use std::path::Path;

use re_protos::common::v1alpha1::Compression;
use re_protos::log_msg::v1alpha1::ArrowMsg;
use rerun::external::re_log_encoding::Decodable as _;
use rerun::external::re_log_encoding::external::lz4_flex;

const FOUR_CC: &[u8] = b"RRF2";
/// Bytes before the first message.
const FILE_HEAD: u64 = 12;
/// Bytes before a message's own.
const MESSAGE_HEAD: u64 = 16;
const END: u64 = 0;
/// What follows the index: its place (20 bytes), what the file is, and that there is one such place.
const FOOTER_BYTES: usize = 32;
const FOOTER_END: &[u8] = b"RRF2FOOT\x01\0\0\0";
const DATA: u64 = 2;
/// Last kind of a message.
const LAST_KIND: u64 = 3;
/// Longest message, bytes: sixteen times what the recorder lets wait.
const LONGEST: u64 = 1 << 28;
/// No byte of a compressed block stands for more.
const MOST_EXPANSION: u64 = 255;

/// Where the messages end.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Ends {
    /// As its recorder closed it, with the index that follows the last message and all that belongs to it.
    Closed,
    /// With the file, after a whole message.
    WithTheFile,
    /// Before it.
    Early {
        /// Bytes that were read.
        at: u64,
        reason: String,
    },
}

/// How a file could be read.
pub(crate) struct FileRead {
    pub(crate) ends: Ends,
    /// Its length, bytes.
    pub(crate) bytes: u64,
    /// Messages that could not be read.
    pub(crate) unreadable: u64,
}

/// Reads the messages of a recording. `take` gets the data of each.
pub(crate) fn read_file(path: &Path, take: impl FnMut(&[u8])) -> Result<FileRead, String> {
    let unread = |error: std::io::Error| format!("cannot be read: {error}");
    let file = asperity_engine::files::open_plain(path).map_err(unread)?;
    let bytes = file.metadata().map_err(unread)?.len();
    let (ends, unreadable) = read(BufReader::new(file), bytes, take)?;
    Ok(FileRead {
        ends,
        bytes,
        unreadable,
    })
}

/// Reads the messages of a file of so many bytes. `take` gets the data of each; it says whether they could be read.
/// Where they end, and how many could not be read.
fn read(
    mut file: impl Read,
    bytes: u64,
    mut take: impl FnMut(&[u8]),
) -> Result<(Ends, u64), String> {
    let mut head = [0; FILE_HEAD as usize];
    // Of a file that was cut in its header there is less.
    let there = bytes.min(FILE_HEAD) as usize;
    file.read_exact(&mut head[..there])
        .map_err(|error| format!("cannot be read: {error}"))?;
    if there == 0 {
        return Err("not a recording: it is empty".to_owned());
    }
    if head[..there.min(4)] != FOUR_CC[..there.min(4)] {
        return Err("not a Rerun recording".to_owned());
    }
    if there < FILE_HEAD as usize {
        return Err(format!("it ends after {bytes} bytes, within its header"));
    }
    let (mut at, mut unreadable) = (FILE_HEAD, 0);
    let mut message = Vec::new();
    while at < bytes {
        match next(&mut file, bytes - at, &mut message) {
            Ok(None) => return Ok((Ends::Closed, unreadable)),
            Ok(Some(kind)) => {
                at += MESSAGE_HEAD + message.len() as u64;
                if kind == DATA && data_of(&message, &mut take).is_none() {
                    unreadable += 1;
                }
            }
            Err(reason) => return Ok((Ends::Early { at, reason }, unreadable)),
        }
    }
    Ok((Ends::WithTheFile, unreadable))
}

/// Reads a message into `message`; its kind, or none after the last.
fn next(file: &mut impl Read, left: u64, message: &mut Vec<u8>) -> Result<Option<u64>, String> {
    let mut head = [0; MESSAGE_HEAD as usize];
    if left < MESSAGE_HEAD {
        return Err(format!("{left} trailing bytes are not a message"));
    }
    let broken = |error: std::io::Error| match error.kind() {
        ErrorKind::UnexpectedEof => "the file became shorter".to_owned(),
        _ => error.to_string(),
    };
    file.read_exact(&mut head).map_err(broken)?;
    let [kind, length] = [0, 8].map(|from| little_endian(&head[from..from + 8]));
    if kind > LAST_KIND {
        return Err(format!("a message of unknown kind {kind}"));
    }
    let there = left - MESSAGE_HEAD;
    if kind == END {
        return end(file, length, there).map(|()| None);
    }
    if length > there.min(LONGEST) {
        return Err(format!("a message of {length} bytes where {there} follow"));
    }
    message.clear();
    message.resize(length as usize, 0);
    file.read_exact(message).map_err(broken)?;
    Ok(Some(kind))
}

/// Reads the index and what follows it, of a message of that length where so many bytes are there. A cut leaves less.
fn end(file: &mut impl Read, length: u64, there: u64) -> Result<(), String> {
    if length.checked_add(FOOTER_BYTES as u64) != Some(there) {
        return Err(format!("an index of {length} bytes where {there} follow"));
    }
    let mut footer = [0; FOOTER_BYTES];
    std::io::copy(&mut file.take(length), &mut std::io::sink())
        .and_then(|_| file.read_exact(&mut footer))
        .map_err(|error| error.to_string())?;
    let is_whole = footer.ends_with(FOOTER_END);
    is_whole
        .then_some(())
        .ok_or_else(|| "no end of an index".to_owned())
}

fn little_endian(bytes: &[u8]) -> u64 {
    bytes
        .iter()
        .rev()
        .fold(0, |value, byte| value << 8 | u64::from(*byte))
}

/// Hands on the data of a message; `None` where they cannot be read.
fn data_of(message: &[u8], take: &mut impl FnMut(&[u8])) -> Option<()> {
    let data = ArrowMsg::from_rrd_bytes(message).ok()?;
    if data.compression() != Compression::Lz4 {
        take(&data.payload);
        return Some(());
    }
    let length = data.uncompressed_size;
    if length > MOST_EXPANSION * data.payload.len() as u64 || length > LONGEST {
        return None;
    }
    take(&lz4_flex::block::decompress(&data.payload, length as usize).ok()?);
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(kind: u64, length: u64, bytes: &[u8]) -> Vec<u8> {
        let head = kind.to_le_bytes().into_iter().chain(length.to_le_bytes());
        head.chain(bytes.iter().copied()).collect()
    }

    fn file(messages: &[Vec<u8>]) -> Vec<u8> {
        let head = b"RRF2\0\x24\x03\0\x01\x02\0\0".to_vec();
        messages
            .iter()
            .fold(head, |file, message| [&file[..], message].concat())
    }

    fn found(file: &[u8]) -> (Vec<Vec<u8>>, Ends, u64) {
        let mut found = Vec::new();
        let (ends, unreadable) =
            read(file, file.len() as u64, |data| found.push(data.to_vec())).expect("a file");
        (found, ends, unreadable)
    }

    /// Field 3: length, field 5: payload, compressed.
    fn compressed(text: &[u8], length: u64) -> Vec<u8> {
        let payload = lz4_flex::block::compress(text);
        let mut bytes = vec![2 << 3, Compression::Lz4 as u8, 3 << 3];
        let mut left = length;
        while left >= 0x80 {
            bytes.push(left as u8 | 0x80);
            left >>= 7;
        }
        bytes.extend([left as u8, 5 << 3 | 2, payload.len() as u8]);
        bytes.extend(payload);
        bytes
    }

    #[test]
    fn lengths_are_compared_with_the_file_before_they_are_believed() {
        let text = b"stress stress stress stress";
        let good = compressed(text, text.len() as u64);
        let good = message(DATA, good.len() as u64, &good);
        let whole = file(&[good.clone(), message(1, 2, b"??"), good.clone()]);
        assert_eq!(
            found(&whole),
            (vec![text.to_vec(); 2], Ends::WithTheFile, 0)
        );
        for length in [3, 1 << 40, u64::MAX] {
            let (data, ends, _) = found(&file(&[good.clone(), message(DATA, length, b"..")]));
            assert_eq!(data.len(), 1);
            assert!(matches!(ends, Ends::Early { .. }), "{ends:?}");
        }
        let footer = [&[7; 20][..], FOOTER_END].concat();
        let end = |length| [message(END, length, b"index"), footer.clone()].concat();
        let closed = |length| file(&[good.clone(), end(length)]);
        assert_eq!(found(&closed(5)).1, Ends::Closed);
        for length in [4, 6, u64::MAX] {
            assert!(matches!(found(&closed(length)).1, Ends::Early { .. }));
        }
        let whole_file = closed(5);
        let end_at = whole_file.len() - end(5).len();
        for cut in end_at + 1..whole_file.len() {
            assert!(
                matches!(found(&whole_file[..cut]).1, Ends::Early { .. }),
                "{cut}"
            );
        }
        // What cannot be that long, or is not, is not asked for.
        for length in [1_u64 << 62, 1 << 20, 5] {
            let forged = compressed(text, length);
            let forged = message(DATA, forged.len() as u64, &forged);
            let (data, _, unreadable) = found(&file(&[forged, good.clone()]));
            assert_eq!((data.len(), unreadable), (1, 1), "{length}");
        }
        for cut in 13..whole.len() {
            let (data, ends, _) = found(&whole[..cut]);
            let at_an_end = [12 + good.len(), 12 + good.len() + 18].contains(&cut);
            assert_eq!(ends == Ends::WithTheFile, at_an_end, "{cut}");
            assert!(data.len() < 2);
        }
    }
}
