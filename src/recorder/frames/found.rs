//! What is collected from a recording's chunks: rows of scalars, pictures by their steps, words; of one run of several by what
//! stands before its entities' names.

use std::collections::{BTreeSet, HashMap};
use std::path::Path;
use std::sync::Arc;

use rerun::external::arrow::ipc::reader::StreamReader;
use rerun::log::Chunk;
use rerun::{
    ComponentIdentifier, DepthImage, EncodedDepthImage, Scalars, SegmentationImage, SeriesLines,
    TextDocument,
};

use crate::entities::series::LIFE_BAND;
use crate::entities::{DAMAGE, GRID, SCALARS, damage_block, maps, slice, text};
use crate::messages::{self, Ends, FileRead};
use crate::moment::STEP;
use crate::note::Note;

/// What a picture holds.
#[derive(Debug, Clone)]
pub(super) enum Image {
    /// Values in half precision, or classes.
    Plain(Arc<[u8]>),
    /// In so many levels per unit.
    Levels(Arc<[u8]>, f32),
}

/// Images of an entity by their steps.
pub(super) type SteppedImages = Vec<(i64, Image)>;

/// What is collected from the chunks.
#[derive(Default)]
pub(super) struct FoundRows {
    /// What stands before the names of the run's entities.
    pub(super) under: String,
    /// Program and scene.
    pub(super) origin: Option<(String, String)>,
    pub(super) grid: Vec<f64>,
    pub(super) depths_m: Vec<f64>,
    pub(super) blocks: [Vec<f64>; 2],
    pub(super) names: Vec<String>,
    pub(super) rows: Vec<(i64, Vec<f64>)>,
    pub(super) pictures: HashMap<String, SteppedImages>,
    pub(super) texts: Vec<(i64, String)>,
    /// The same for an audience.
    pub(super) lectures: Vec<(i64, String)>,
    /// Entities whose looks are there: pictures of them follow.
    pub(super) announced: BTreeSet<String>,
    pub(super) band: Option<[f64; 2]>,
    /// Last step, and whether nothing comes after it.
    pub(super) reach: Option<(u64, bool)>,
    /// Where and why it breaks off, in words.
    pub(super) broken_off: Option<String>,
}

impl FoundRows {
    pub(super) fn read(path: &Path, under: &str) -> Result<Self, String> {
        let mut found = Self {
            under: under.to_owned(),
            ..Self::default()
        };
        let read = messages::read_file(path, |data| {
            Note::all_in(data, |note| found.take_note(note));
            // What is no chunk is none of the recording's own.
            if let Some(chunk) = chunk_of(data) {
                found.take(&chunk);
            }
        })?;
        if read.unreadable > 0 {
            let unreadable = read.unreadable;
            return Err(format!(
                "damaged: {unreadable} of its messages cannot be read"
            ));
        }
        found.end(&read);
        found.rows.sort_by_key(|(step, _)| *step);
        found.rows.dedup_by_key(|(step, _)| *step);
        found.texts.sort_by_key(|(step, _)| *step);
        found.lectures.sort_by_key(|(step, _)| *step);
        for pictures in found.pictures.values_mut() {
            pictures.sort_by_key(|(step, _)| *step);
        }
        Ok(found)
    }

    /// Where it breaks off, if it does. Steps after that are not whole: a picture may be there beside an older one of
    /// another kind.
    fn end(&mut self, read: &FileRead) {
        let place = match &read.ends {
            Ends::Closed => return,
            Ends::WithTheFile if matches!(self.reach, Some((_, true))) => return,
            Ends::WithTheFile => String::new(),
            Ends::Early { at, reason } => {
                let bytes = read.bytes;
                format!(" (it can be read up to byte {at} of {bytes}: {reason})")
            }
        };
        let last = match self.reach {
            Some((last, _)) => last.try_into().unwrap_or(i64::MAX),
            None => self.last_whole(),
        };
        let is_whole = |step: i64| step <= last;
        self.rows.retain(|(step, _)| is_whole(*step));
        self.texts.retain(|(step, _)| is_whole(*step));
        self.lectures.retain(|(step, _)| is_whole(*step));
        for pictures in self.pictures.values_mut() {
            pictures.retain(|(step, _)| is_whole(*step));
        }
        let after = if last > 0 {
            format!("breaks off after step {last}")
        } else {
            "breaks off before its first step is whole".to_owned()
        };
        self.broken_off = Some(format!("{after}{place}"));
    }

    /// The last step that all have which should have it: in a finished recording each quantity lies by itself, so that a
    /// cut leaves more of one than of another.
    fn last_whole(&self) -> i64 {
        let rows = self.rows.iter().map(|(step, _)| *step).max();
        let pictures = self.announced.iter().map(|entity| {
            let steps = self.pictures.get(entity).into_iter().flatten();
            steps.map(|(step, _)| *step).max()
        });
        let lasts = pictures.chain([rows]).map(Option::unwrap_or_default);
        lasts.min().unwrap_or_default()
    }

    fn take_note(&mut self, note: Note) {
        match note {
            Note::Origin {
                program,
                scene_toml,
                ..
            } => self.origin = Some((program, scene_toml)),
            Note::Reach {
                last_step, ended, ..
            } => self.reach = Some((last_step, ended)),
            Note::Turn { .. } => {}
        }
    }

    fn take(&mut self, chunk: &Chunk) {
        let path = chunk.entity_path().to_string();
        let Some(entity) = path.trim_start_matches('/').strip_prefix(&self.under) else {
            return;
        };
        let entity = entity.to_owned();
        let entity = entity.as_str();
        let steps = chunk.timelines().get(&STEP.into());
        let steps = steps.map_or(&[][..], |column| column.times_raw());
        if let Some(image) = entity.strip_suffix("/image") {
            self.take_pictures(
                chunk,
                image,
                steps,
                DepthImage::descriptor_buffer().component,
            );
            self.take_levels(chunk, image, steps);
        } else if entity == maps::CONTACT {
            self.take_pictures(
                chunk,
                entity,
                steps,
                SegmentationImage::descriptor_buffer().component,
            );
        } else if entity == SCALARS {
            self.names
                .extend(strings(chunk, SeriesLines::descriptor_names().component));
            self.rows.extend(steps.iter().copied().zip(numbers(chunk)));
        } else if entity == text::NOW || entity == text::LECTURE {
            let texts = strings(chunk, TextDocument::descriptor_text().component);
            let all = if entity == text::NOW {
                &mut self.texts
            } else {
                &mut self.lectures
            };
            all.extend(steps.iter().copied().zip(texts));
        } else if entity == LIFE_BAND {
            let logs = numbers(chunk).next_back();
            let ends = logs.and_then(|logs| <[f64; 2]>::try_from(logs).ok());
            self.band = ends
                .map(|logs| logs.map(|log| 10_f64.powf(log)))
                .or(self.band);
        } else if entity == text::SCENE_TOML && !self.under.is_empty() {
            // Runs side by side are not repeated from there, so that they have no note of it.
            let scene = strings(chunk, TextDocument::descriptor_text().component);
            let scene = scene.into_iter().next();
            self.origin = scene.map(|scene| ("a recording side by side".to_owned(), scene));
        } else {
            let of_body = |body: usize| damage_block(DAMAGE[body]) == entity;
            let place = match entity {
                GRID => &mut self.grid,
                slice::DEPTHS => &mut self.depths_m,
                _ if of_body(0) => &mut self.blocks[0],
                _ if of_body(1) => &mut self.blocks[1],
                _ => return,
            };
            if let Some(values) = numbers(chunk).next_back() {
                *place = values;
            }
        }
    }

    fn take_pictures(
        &mut self,
        chunk: &Chunk,
        entity: &str,
        steps: &[i64],
        buffer: ComponentIdentifier,
    ) {
        if !READ.contains(&entity) {
            return;
        }
        if chunk.is_static() {
            self.announced.insert(entity.to_owned());
            return;
        }
        let rows = chunk.iter_slices::<&[u8]>(buffer);
        let pictures = steps.iter().copied().zip(rows);
        let pictures = pictures.filter_map(|(step, row)| {
            let bytes = row.first()?.as_slice();
            Some((step, Image::Plain(Arc::from(bytes))))
        });
        self.add(entity, pictures);
    }

    /// Pictures in levels, which come with how many of them are one unit.
    fn take_levels(&mut self, chunk: &Chunk, entity: &str, steps: &[i64]) {
        if !READ.contains(&entity) || chunk.is_static() {
            return;
        }
        let [blob, meter] = [
            EncodedDepthImage::descriptor_blob().component,
            EncodedDepthImage::descriptor_meter().component,
        ];
        let blobs = chunk.iter_slices::<&[u8]>(blob);
        let rows = blobs.zip(chunk.iter_slices::<f32>(meter));
        let pictures = steps.iter().copied().zip(rows);
        let pictures = pictures.filter_map(|(step, (blob, per_unit))| {
            let (bytes, per_unit) = (blob.first()?.as_slice(), *per_unit.first()?);
            Some((step, Image::Levels(Arc::from(bytes), per_unit)))
        });
        self.add(entity, pictures);
    }

    fn add(&mut self, entity: &str, pictures: impl Iterator<Item = (i64, Image)>) {
        let all = self.pictures.entry(entity.to_owned()).or_default();
        all.extend(pictures);
    }
}

/// Entities whose pictures make a frame.
const READ: [&str; 13] = [
    maps::PRESSURE,
    maps::FILM,
    maps::CONTACT,
    maps::TRACTION,
    maps::ROUGHNESS_1,
    maps::ROUGHNESS_2,
    maps::SURFACE_1,
    maps::SURFACE_2,
    maps::OIL_RISE,
    slice::EFFECTIVE,
    slice::TAU_XZ,
    DAMAGE[0],
    DAMAGE[1],
];

/// The chunk that a message holds.
fn chunk_of(data: &[u8]) -> Option<Chunk> {
    let batch = StreamReader::try_new(data, None).ok()?.next()?.ok()?;
    Chunk::from_chunk_record_batch(&batch).ok()
}

/// Numbers of every row.
fn numbers(chunk: &Chunk) -> impl DoubleEndedIterator<Item = Vec<f64>> {
    let component = Scalars::descriptor_scalars().component;
    let rows: Vec<_> = chunk
        .iter_slices::<f64>(component)
        .map(<[f64]>::to_vec)
        .collect();
    rows.into_iter()
}

/// Texts of every row, one after another.
fn strings(chunk: &Chunk, component: ComponentIdentifier) -> Vec<String> {
    let rows = chunk.iter_slices::<String>(component);
    rows.flat_map(|row| row.iter().map(ToString::to_string).collect::<Vec<_>>())
        .collect()
}
