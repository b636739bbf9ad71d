//! Compacts a finished recording: rows of an entity that were written bit by bit become chunks of about a megabyte, and a
//! footer says where each of them lies.
//!
//! How rows are divided then depends on the rows alone and not on the clock or on what else the machine did, and there
//! are so few chunks that their index has room in memory: while a run goes on it would take 5.6 kB for every chunk that
//! is flushed. The library's own compaction (`re_chunk_store`) holds the whole recording in memory and divides rows as
//! they came. The new file takes the place of the old one when it is whole.

use std::collections::HashMap;
use std::fs::File;
use std::io::{BufReader, BufWriter, Write as _};
use std::path::Path;

use re_log_types::{LogMsg, StoreId};
use rerun::external::re_log_encoding::{CrateVersion, DecoderApp, Encoder, EncodingOptions};
use rerun::log::Chunk;
use rerun::{ComponentIdentifier, EntityPath, SizeBytes as _};

use asperity_engine::files::part_of;

use super::entities::text::REACH;

/// A chunk has so many bytes, by its entity's first row ...
const CHUNK_BYTES: u64 = 1024 * 1024;
/// ... and so many rows at most: the library's own bound.
const MOST_ROWS: usize = 4096;

/// What comes after the recording's own chunks, made of what is in them.
pub(crate) trait Epilogue {
    /// Whether the recording has been compacted: its chunks then stay as they are.
    const ON_COMPACTED: bool;
    /// Takes up a chunk; those of an entity come in the order of time.
    fn see(&mut self, chunk: &Chunk);
    /// What to add.
    fn chunks(self) -> Result<Vec<Chunk>, String>;
}

/// Nothing is added.
pub(crate) struct NoEpilogue;

impl Epilogue for NoEpilogue {
    const ON_COMPACTED: bool = false;

    fn see(&mut self, _chunk: &Chunk) {}

    fn chunks(self) -> Result<Vec<Chunk>, String> {
        Ok(Vec::new())
    }
}

/// Compacts the recording at `path`; its length then.
///
/// # Errors
/// In words, when there is no room for a second file or it is no recording; the first is as it was.
pub(crate) fn compact(path: &Path, epilogue: impl Epilogue) -> Result<u64, String> {
    // Behind a link lies the file itself, which alone may be replaced; and only a file.
    let path = path.canonicalize().map_err(|error| error.to_string())?;
    if !path.is_file() {
        return Err("it is not a regular file".to_owned());
    }
    // In the same folder, so that renaming moves no data.
    let beside = part_of(&path);
    let written = write(&path, &beside, epilogue)
        .and_then(|()| std::fs::rename(&beside, &path).map_err(|error| error.to_string()));
    if let Err(reason) = written {
        // What could not be made whole is of no use; if it cannot be removed either, the reason is the same.
        drop(std::fs::remove_file(&beside));
        return Err(reason);
    }
    std::fs::metadata(&path)
        .map(|data| data.len())
        .map_err(|error| error.to_string())
}

fn write(from: &Path, to: &Path, mut epilogue: impl Epilogue) -> Result<(), String> {
    let words = |error: &dyn std::fmt::Display| error.to_string();
    let reader = BufReader::new(File::open(from).map_err(|error| words(&error))?);
    let messages = DecoderApp::decode_eager(reader).map_err(|error| words(&error))?;
    let file = File::create_new(to).map_err(|error| words(&error))?;
    // As long as it is held nobody takes it for what a killed run left. Where the system knows no locks nobody looks.
    drop(file.lock());
    let options = EncodingOptions::PROTOBUF_COMPRESSED;
    let encoder = Encoder::new_eager(CrateVersion::LOCAL, options, BufWriter::new(file));
    let mut compactor = Compactor {
        encoder: encoder.map_err(|error| words(&error))?,
        store: None,
        waiting: Vec::new(),
        places: HashMap::new(),
        reach: None,
    };
    for message in messages {
        let message = message.map_err(|error| words(&error))?;
        compactor.take(&message, &mut epilogue)?;
    }
    compactor.end(epilogue)?;
    let mut encoder = compactor.encoder;
    encoder.finish().map_err(|error| words(&error))?;
    let mut out = encoder.into_inner().map_err(|error| words(&error))?;
    out.flush().map_err(|error| words(&error))
}

/// What makes rows alike.
type RowKind = (EntityPath, Vec<ComponentIdentifier>);

/// Rows of one kind that are not written yet.
struct WaitingRows {
    chunks: Vec<Chunk>,
    rows: usize,
    most_rows: usize,
}

struct Compactor {
    encoder: Encoder<BufWriter<File>>,
    /// The recording that the file holds.
    store: Option<StoreId>,
    /// In the order of their first rows, so that files are made alike.
    waiting: Vec<WaitingRows>,
    places: HashMap<RowKind, usize>,
    /// How far the recording goes, as it was noted last.
    reach: Option<LogMsg>,
}

impl Compactor {
    fn append(&mut self, message: &LogMsg) -> Result<(), String> {
        let appended = self.encoder.append(message);
        appended.map(drop).map_err(|error| error.to_string())
    }

    fn append_chunk(&mut self, chunk: &Chunk) -> Result<(), String> {
        let store = self.store.clone().ok_or("it does not hold a recording")?;
        let message = chunk.to_arrow_msg().map_err(|error| error.to_string())?;
        self.append(&LogMsg::ArrowMsg(store, message))
    }

    /// A message of the old file. What holds always stays as it is, and where it is: before what it explains.
    fn take<E: Epilogue>(&mut self, message: &LogMsg, epilogue: &mut E) -> Result<(), String> {
        let LogMsg::ArrowMsg(store, arrow) = message else {
            return self.append(message);
        };
        if store.is_blueprint() {
            return self.append(message);
        }
        self.store.get_or_insert_with(|| store.clone());
        let chunk = Chunk::from_arrow_msg(arrow).map_err(|error| error.to_string())?;
        if chunk.entity_path().to_string().trim_start_matches('/') == REACH {
            self.reach = Some(message.clone());
            return Ok(());
        }
        if chunk.is_static() || chunk.num_rows() == 0 {
            return self.append(message);
        }
        epilogue.see(&chunk);
        if E::ON_COMPACTED {
            return self.append(message);
        }
        self.take_rows(&chunk)
    }

    fn take_rows(&mut self, chunk: &Chunk) -> Result<(), String> {
        let mut components: Vec<_> = chunk.components().keys().copied().collect();
        components.sort_unstable();
        let kind = (chunk.entity_path().clone(), components);
        let place = *self.places.entry(kind).or_insert_with(|| {
            let row = chunk.row_sliced_deep(0, 1).total_size_bytes().max(1);
            self.waiting.push(WaitingRows {
                chunks: Vec::new(),
                rows: 0,
                most_rows: ((CHUNK_BYTES / row) as usize).clamp(1, MOST_ROWS),
            });
            self.waiting.len() - 1
        });
        let mut from = 0;
        while from < chunk.num_rows() {
            let waiting = &mut self.waiting[place];
            let rows = (waiting.most_rows - waiting.rows).min(chunk.num_rows() - from);
            waiting.chunks.push(chunk.row_sliced_deep(from, rows));
            waiting.rows += rows;
            from += rows;
            if waiting.rows == waiting.most_rows {
                self.write_rows(place)?;
            }
        }
        Ok(())
    }

    /// Writes what waits as one chunk.
    fn write_rows(&mut self, place: usize) -> Result<(), String> {
        let waiting = &mut self.waiting[place];
        waiting.rows = 0;
        match joined(std::mem::take(&mut waiting.chunks))? {
            Some(chunk) => self.append_chunk(&chunk),
            None => Ok(()),
        }
    }

    fn end(&mut self, epilogue: impl Epilogue) -> Result<(), String> {
        (0..self.waiting.len()).try_for_each(|place| self.write_rows(place))?;
        if let Some(reach) = self.reach.take() {
            self.append(&reach)?;
        }
        let chunks = epilogue.chunks()?;
        chunks.iter().try_for_each(|chunk| self.append_chunk(chunk))
    }
}

/// Chunks one after another as one: neighbours first, so that a row is copied as often as the number has digits in
/// base two.
fn joined(mut chunks: Vec<Chunk>) -> Result<Option<Chunk>, String> {
    while chunks.len() > 1 {
        let pairs = chunks.chunks(2).map(|pair| match pair {
            [one, two] => Chunk::concat_and_sort(one, two).map_err(|error| error.to_string()),
            rest => Ok(rest[0].clone()),
        });
        chunks = pairs.collect::<Result<_, _>>()?;
    }
    Ok(chunks.pop())
}
