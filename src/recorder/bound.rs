//! Binds a finished recording: rows of an entity that were written bit by bit become chunks of about a megabyte, and a
//! footer says where each of them lies.
//!
//! How rows are divided then depends on the rows alone and not on the clock or on what else the machine did, and there
//! are so few chunks that their index has room in memory. The new file takes the place of the old one when it is whole.

use std::collections::HashMap;
use std::fs::File;
use std::io::{BufReader, BufWriter, Write as _};
use std::path::{Path, PathBuf};

use re_log_types::{LogMsg, StoreId};
use rerun::external::re_log_encoding::{CrateVersion, DecoderApp, Encoder, EncodingOptions};
use rerun::log::Chunk;
use rerun::{ComponentIdentifier, EntityPath, SizeBytes as _, TextDocument};

use super::moment::Moment;
use super::scalars::SCALARS;
use super::text::{LECTURE, NOW, REACH};

/// A chunk has so many bytes, by its entity's first row ...
const CHUNK_BYTES: u64 = 1024 * 1024;
/// ... and so many rows at most: the library's own bound.
const MOST_ROWS: usize = 4096;

/// What a recording ends with.
#[derive(Default)]
pub(super) struct RecordingEnd {
    /// First and last moment of its curves.
    pub(super) moments: Option<[Moment; 2]>,
    /// The last texts of these entities.
    pub(super) texts: Vec<(&'static str, String)>,
}

/// Binds the recording at `path` with more that is made of its ending; its length then.
///
/// # Errors
/// In words, when there is no room for a second file or it is no recording; the first is as it was.
pub(super) fn bind(
    path: &Path,
    more: impl FnOnce(&RecordingEnd) -> Result<Vec<Chunk>, String>,
) -> Result<u64, String> {
    // Behind a link lies the file itself, which alone may be replaced; and only a file.
    let path = path.canonicalize().map_err(|error| error.to_string())?;
    if !path.is_file() {
        return Err("it is not a regular file".to_owned());
    }
    let beside = beside(&path);
    let written = write(&path, &beside, more)
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

/// A name in the same folder, so that renaming moves no data.
fn beside(path: &Path) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{}.part", std::process::id()));
    path.with_file_name(name)
}

fn write(
    from: &Path,
    to: &Path,
    more: impl FnOnce(&RecordingEnd) -> Result<Vec<Chunk>, String>,
) -> Result<(), String> {
    let words = |error: &dyn std::fmt::Display| error.to_string();
    let reader = BufReader::new(File::open(from).map_err(|error| words(&error))?);
    let messages = DecoderApp::decode_eager(reader).map_err(|error| words(&error))?;
    let file = File::create_new(to).map_err(|error| words(&error))?;
    let options = EncodingOptions::PROTOBUF_COMPRESSED;
    let out = BufWriter::new(file);
    let encoder = Encoder::new_eager(CrateVersion::LOCAL, options, out);
    let mut binder = Binder {
        encoder: encoder.map_err(|error| words(&error))?,
        store: None,
        strands: Vec::new(),
        places: HashMap::new(),
        reach: None,
        ending: RecordingEnd::default(),
    };
    for message in messages {
        binder.take(&message.map_err(|error| words(&error))?)?;
    }
    binder.end()?;
    for chunk in more(&binder.ending)? {
        binder.append_chunk(&chunk, None)?;
    }
    let mut encoder = binder.encoder;
    encoder.finish().map_err(|error| words(&error))?;
    let mut out = encoder.into_inner().map_err(|error| words(&error))?;
    out.flush().map_err(|error| words(&error))
}

/// Rows of one entity that hold the same components.
struct Strand {
    store: StoreId,
    chunks: Vec<Chunk>,
    rows: usize,
    most_rows: usize,
}

/// What makes rows alike.
type RowKind = (StoreId, EntityPath, Vec<ComponentIdentifier>);

struct Binder {
    encoder: Encoder<BufWriter<File>>,
    /// The recording that the file holds.
    store: Option<StoreId>,
    /// In the order of their first rows, so that files are made alike.
    strands: Vec<Strand>,
    places: HashMap<RowKind, usize>,
    /// How far the recording goes, as it was told last.
    reach: Option<LogMsg>,
    ending: RecordingEnd,
}

impl RecordingEnd {
    /// Takes up rows that come in the order of time.
    fn see(&mut self, chunk: &Chunk) {
        let path = chunk.entity_path().to_string();
        let entity = path.trim_start_matches('/');
        if entity == SCALARS {
            let ends = [0, chunk.num_rows() - 1].map(|row| Moment::of(chunk, row));
            if let [Some(first), Some(last)] = ends {
                self.moments = Some([self.moments.map_or(first, |[first, _]| first), last]);
            }
        }
        for own in [NOW, LECTURE] {
            let component = TextDocument::descriptor_text().component;
            let last = (entity == own).then(|| chunk.iter_slices::<String>(component).last());
            if let Some(text) = last
                .flatten()
                .and_then(|row| row.first().map(ToString::to_string))
            {
                self.texts.retain(|(entity, _)| *entity != own);
                self.texts.push((own, text));
            }
        }
    }
}

impl Binder {
    fn append(&mut self, message: &LogMsg) -> Result<(), String> {
        let appended = self.encoder.append(message);
        appended.map(drop).map_err(|error| error.to_string())
    }

    /// A chunk of that store, or of the recording that the file holds.
    fn append_chunk(&mut self, chunk: &Chunk, store: Option<StoreId>) -> Result<(), String> {
        let store = store
            .or_else(|| self.store.clone())
            .ok_or("it does not hold a recording")?;
        let message = chunk.to_arrow_msg().map_err(|error| error.to_string())?;
        self.append(&LogMsg::ArrowMsg(store, message))
    }

    /// A message of the old file. What holds for ever stays as it is, and where it is: before what it explains.
    fn take(&mut self, message: &LogMsg) -> Result<(), String> {
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
        self.ending.see(&chunk);
        self.take_rows(store.clone(), &chunk)
    }

    fn take_rows(&mut self, store: StoreId, chunk: &Chunk) -> Result<(), String> {
        let mut components: Vec<_> = chunk.components().keys().copied().collect();
        components.sort_unstable();
        let kind = (store.clone(), chunk.entity_path().clone(), components);
        let place = *self.places.entry(kind).or_insert_with(|| {
            let row = chunk.row_sliced_deep(0, 1).total_size_bytes().max(1);
            self.strands.push(Strand {
                store,
                chunks: Vec::new(),
                rows: 0,
                most_rows: ((CHUNK_BYTES / row) as usize).clamp(1, MOST_ROWS),
            });
            self.strands.len() - 1
        });
        let mut from = 0;
        while from < chunk.num_rows() {
            let strand = &mut self.strands[place];
            let rows = (strand.most_rows - strand.rows).min(chunk.num_rows() - from);
            strand.chunks.push(chunk.row_sliced_deep(from, rows));
            strand.rows += rows;
            from += rows;
            if strand.rows == strand.most_rows {
                self.send(place)?;
            }
        }
        Ok(())
    }

    /// Writes what a strand holds as one chunk.
    fn send(&mut self, place: usize) -> Result<(), String> {
        let strand = &mut self.strands[place];
        strand.rows = 0;
        let Some(chunk) = joined(std::mem::take(&mut strand.chunks))? else {
            return Ok(());
        };
        let store = strand.store.clone();
        self.append_chunk(&chunk, Some(store))
    }

    fn end(&mut self) -> Result<(), String> {
        (0..self.strands.len()).try_for_each(|place| self.send(place))?;
        self.reach
            .take()
            .map_or(Ok(()), |reach| self.append(&reach))
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
