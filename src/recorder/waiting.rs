//! Rows that wait to be sent, gathered by entity.
//!
//! The library would take every row over a channel to a thread that gathers them: some thirty times a frame a
//! thread is woken for a few hundred bytes. Gathered here, a second's rows of an entity go over as one chunk.

use std::collections::HashMap;

use rerun::external::arrow::array::Array as _;
use rerun::log::{Chunk, ChunkError, PendingRow};
use rerun::time::TimePoint;
use rerun::{AsComponents, DepthImage, EntityPath, SegmentationImage};

use super::gathered::{Added, Images, LineStyle, Sheets, Strips};
use super::moment::Moment;
use super::weight::{ROW, TEXT};

/// Rows of a chunk at most where times are out of order, as the library has it.
const MOST_UNSORTED: u64 = 256;
/// Bytes from which on nothing should wait any longer: more than a second of the default scene, for every chunk
/// costs as much as a picture.
const MOST_BYTES: usize = 16 * 1024 * 1024;

/// An image of classes, one byte each.
#[derive(Debug, Clone, Copy)]
pub(super) struct ClassImage(usize);

/// An image of levels, two bytes each.
#[derive(Debug, Clone, Copy)]
pub(super) struct LevelImage(usize);

/// A mesh whose colours change, and perhaps its positions.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sheet(usize);

/// Curves in a plot.
#[derive(Debug, Clone, Copy)]
pub(super) struct Curves(usize);

/// What waits.
#[derive(Default)]
pub(super) struct Waiting {
    /// Entities in the order of their first rows, so that files are made alike.
    entities: Vec<(EntityPath, Vec<PendingRow>)>,
    /// By their names as they are logged, which are read as paths only once.
    places: HashMap<String, usize>,
    classes: Vec<Images<u8>>,
    levels: Vec<Images<u16>>,
    sheets: Vec<Sheets>,
    curves: Vec<Strips>,
    bytes: usize,
    /// Of all rows so far in the finished file.
    weight: f64,
}

impl Waiting {
    /// Adds a row.
    pub(super) fn push(
        &mut self,
        entity: &str,
        at: TimePoint,
        data: &(impl AsComponents + ?Sized),
    ) {
        let batches = data.as_serialized_batches();
        let bytes = batches
            .iter()
            .map(|batch| batch.array.get_buffer_memory_size());
        let bytes = bytes.sum();
        let weight = ROW + TEXT * bytes as f64;
        self.add(Added { bytes, weight });
        let place = self.places.get(entity).copied().unwrap_or_else(|| {
            let place = self.entities.len();
            self.entities.push((EntityPath::from(entity), Vec::new()));
            self.places.insert(entity.to_owned(), place);
            place
        });
        self.entities[place]
            .1
            .push(PendingRow::from_iter(at, batches));
    }

    fn add(&mut self, added: Added) {
        self.bytes += added.bytes;
        self.weight += added.weight;
    }

    /// What all rows so far will take of the finished file, bytes.
    pub(super) fn weight(&self) -> f64 {
        self.weight
    }

    pub(super) fn class_image(&mut self, entity: EntityPath) -> ClassImage {
        let buffer = SegmentationImage::descriptor_buffer();
        self.classes.push(Images::new(entity, buffer));
        ClassImage(self.classes.len() - 1)
    }

    pub(super) fn level_image(&mut self, entity: EntityPath) -> LevelImage {
        let buffer = DepthImage::descriptor_buffer();
        self.levels.push(Images::new(entity, buffer));
        LevelImage(self.levels.len() - 1)
    }

    pub(super) fn sheet(&mut self, entity: EntityPath) -> Sheet {
        self.sheets.push(Sheets::new(entity));
        Sheet(self.sheets.len() - 1)
    }

    pub(super) fn curves(&mut self, entity: EntityPath) -> Curves {
        self.curves.push(Strips::new(entity));
        Curves(self.curves.len() - 1)
    }

    pub(super) fn push_curves(
        &mut self,
        curves: Curves,
        at: Moment,
        fill: impl FnOnce(&mut LineStyle),
    ) {
        let added = self.curves[curves.0].push(at, fill);
        self.add(added);
    }

    pub(super) fn push_classes(
        &mut self,
        image: ClassImage,
        at: Moment,
        fill: impl FnOnce(&mut Vec<u8>),
    ) {
        let added = self.classes[image.0].push(at, fill);
        self.add(added);
    }

    pub(super) fn push_levels(
        &mut self,
        image: LevelImage,
        at: Moment,
        fill: impl FnOnce(&mut Vec<u16>),
    ) {
        let added = self.levels[image.0].push(at, fill);
        self.add(added);
    }

    pub(super) fn push_sheet(
        &mut self,
        sheet: Sheet,
        at: Moment,
        fill: impl FnOnce(&mut Vec<f32>, &mut Vec<u32>),
    ) {
        let added = self.sheets[sheet.0].push(at, fill);
        self.add(added);
    }

    /// Whether so much waits that it should be sent.
    pub(super) fn is_full(&self) -> bool {
        self.bytes >= MOST_BYTES
    }

    /// Takes what waits, a chunk at a time.
    pub(super) fn take(&mut self, mut send: impl FnMut(Result<Chunk, ChunkError>)) {
        self.bytes = 0;
        self.classes
            .iter_mut()
            .filter_map(Images::take)
            .for_each(&mut send);
        self.levels
            .iter_mut()
            .filter_map(Images::take)
            .for_each(&mut send);
        self.sheets
            .iter_mut()
            .filter_map(Sheets::take)
            .for_each(&mut send);
        self.curves
            .iter_mut()
            .filter_map(Strips::take)
            .for_each(&mut send);
        for (entity, rows) in &mut self.entities {
            if !rows.is_empty() {
                let rows = std::mem::take(rows);
                PendingRow::many_into_chunks(entity.clone(), MOST_UNSORTED, rows)
                    .for_each(&mut send);
            }
        }
    }
}
