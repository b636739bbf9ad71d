//! What rows will take of a finished recording, by what is in them alone: how much of the file is written when depends on
//! the clock, and what is kept within a budget must not.
//!
//! A row's size is its bytes times the share that compression leaves of such rows, measured at some of them, and what the
//! file holds besides of every row. It is an upper estimate: in the finished file rows are compressed many together.

use std::collections::HashMap;

use rerun::SerializedComponentBatch;
use rerun::external::arrow::array::{Array as _, ArrayData};
use rerun::external::re_log_encoding::external::lz4_flex;

/// Of a row besides its numbers: its name, three times, its part of a chunk and of the footer (19 to 25 were measured,
/// and a chunk's 2.4 kB over the fewest rows that share one).
const ROW: f64 = 45.0;
/// The same of a row of scalars, of which a chunk has many more, and each of its numbers: digits are not compressed.
const SCALARS_ROW: f64 = 27.0;
const SCALAR: f64 = 8.0;
/// What holds always, or until it is logged again, each: a message and its place in the footer.
const MESSAGE: f64 = 2.6e3;
/// Share that compression leaves of texts and of what changes seldom.
pub(crate) const TEXT: f64 = 0.65;
/// Rows of fewer bytes are not measured.
const SMALL: usize = 256;
/// The first rows of an entity are measured, and from then on one in so many.
const FIRST: u64 = 8;
const SELDOM: u64 = 32;

/// How well an entity's rows are compressed.
#[derive(Default)]
struct CompressedShare {
    rows: u64,
    share: f64,
}

/// The bytes of all rows so far.
#[derive(Default)]
pub(crate) struct SizeEstimate {
    bytes: f64,
    shares: HashMap<String, CompressedShare>,
}

impl SizeEstimate {
    pub(crate) fn bytes(&self) -> f64 {
        self.bytes
    }

    /// Adds a row of an entity.
    pub(crate) fn add_row(&mut self, entity: &str, batches: &[SerializedComponentBatch]) {
        let bytes = raw_bytes(batches);
        self.bytes += ROW + self.share(entity, bytes, batches) * bytes as f64;
    }

    fn share(&mut self, entity: &str, bytes: usize, batches: &[SerializedComponentBatch]) -> f64 {
        if bytes < SMALL {
            return TEXT;
        }
        let own = match self.shares.get_mut(entity) {
            Some(own) => own,
            None => self.shares.entry(entity.to_owned()).or_default(),
        };
        if own.rows < FIRST || own.rows.is_multiple_of(SELDOM) {
            let compressed = batches
                .iter()
                .map(|batch| compressed(&batch.array.to_data()));
            own.share = compressed.sum::<usize>() as f64 / bytes as f64;
        }
        own.rows += 1;
        own.share
    }

    /// Adds a row of numbers.
    pub(crate) fn add_scalars(&mut self, count: usize) {
        self.bytes += SCALARS_ROW + SCALAR * count as f64;
    }

    /// Adds what is logged once, or seldom.
    pub(crate) fn add_message(&mut self, batches: &[SerializedComponentBatch]) {
        self.bytes += MESSAGE + TEXT * raw_bytes(batches) as f64;
    }
}

fn raw_bytes(batches: &[SerializedComponentBatch]) -> usize {
    let bytes = batches
        .iter()
        .map(|batch| batch.array.get_buffer_memory_size());
    bytes.sum()
}

/// Bytes of an array's buffers when they are compressed.
fn compressed(array: &ArrayData) -> usize {
    let own = array.buffers().iter();
    let own: usize = own
        .map(|buffer| lz4_flex::block::compress(buffer).len())
        .sum();
    own + array.child_data().iter().map(compressed).sum::<usize>()
}
