//! Rows that wait to be sent, gathered by entity.
//!
//! The library would take every row over a channel to a thread that gathers them: some thirty times a frame a
//! thread is woken for a few hundred bytes. Gathered here, a second's rows of an entity go over as one chunk.

use std::collections::HashMap;

use rerun::external::arrow::array::Array as _;
use rerun::log::{Chunk, ChunkError, PendingRow};
use rerun::time::TimePoint;
use rerun::{AsComponents, EntityPath};

/// Rows of a chunk at most where times are out of order, as the library has it.
const MOST_UNSORTED: u64 = 256;
/// Bytes from which on nothing should wait any longer.
const MOST_BYTES: usize = 4 * 1024 * 1024;

/// What waits.
#[derive(Default)]
pub(super) struct Waiting {
    /// Entities in the order of their first rows, so that files are made alike.
    entities: Vec<(EntityPath, Vec<PendingRow>)>,
    places: HashMap<EntityPath, usize>,
    bytes: usize,
}

impl Waiting {
    /// Adds a row.
    pub(super) fn push(
        &mut self,
        entity: EntityPath,
        at: TimePoint,
        data: &(impl AsComponents + ?Sized),
    ) {
        let batches = data.as_serialized_batches();
        let bytes = batches
            .iter()
            .map(|batch| batch.array.get_buffer_memory_size());
        self.bytes += bytes.sum::<usize>();
        let place = *self.places.entry(entity).or_insert_with_key(|entity| {
            self.entities.push((entity.clone(), Vec::new()));
            self.entities.len() - 1
        });
        self.entities[place]
            .1
            .push(PendingRow::from_iter(at, batches));
    }

    /// Whether so much waits that it should be sent.
    pub(super) fn is_full(&self) -> bool {
        self.bytes >= MOST_BYTES
    }

    /// Takes what waits, as chunks.
    pub(super) fn take(&mut self) -> Result<Vec<Chunk>, ChunkError> {
        self.bytes = 0;
        let mut chunks = Vec::with_capacity(self.entities.len());
        for (entity, rows) in &mut self.entities {
            if rows.is_empty() {
                continue;
            }
            let rows = std::mem::take(rows);
            for chunk in PendingRow::many_into_chunks(entity.clone(), MOST_UNSORTED, rows) {
                chunks.push(chunk?);
            }
        }
        Ok(chunks)
    }
}
