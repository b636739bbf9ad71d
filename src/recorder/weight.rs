//! What rows will take of a finished recording, by what is in them alone.
//!
//! The file itself cannot be asked: how much of it is written when depends on the clock, and in what pieces. A row's
//! weight is its bytes times the share that compression leaves of such rows, measured at some of them, and what the file
//! holds besides of every row. It is an upper estimate: in the finished file rows are compressed many together.

use rerun::external::arrow::datatypes::{ArrowNativeType, ToByteSlice};
use rerun::external::re_log_encoding::external::lz4_flex;

/// Of a row besides its numbers: its name, three times, its part of a chunk and of the footer (19 to 25 were measured,
/// and a chunk's 2.4 kB over the fewest rows that share one).
pub(super) const ROW: f64 = 45.0;
/// What holds always, each: a message and its place in the footer.
pub(super) const MESSAGE: f64 = 2.6e3;
/// Share that compression leaves of texts and of what changes seldom.
pub(super) const TEXT: f64 = 0.65;
/// The first rows, each of which is measured, and from then on rows from one measurement to the next.
const FIRST: u64 = 8;
const SELDOM: u64 = 32;

/// How well rows of one kind are compressed.
#[derive(Debug, Default)]
pub(super) struct Compression {
    rows: u64,
    share: f64,
}

impl Compression {
    /// The weight of a row with these values, bytes.
    pub(super) fn weigh<T: ArrowNativeType>(&mut self, values: &[T]) -> f64 {
        let bytes = size_of_val(values) as f64;
        if values.is_empty() {
            return ROW;
        }
        if self.rows < FIRST || self.rows.is_multiple_of(SELDOM) {
            let left = lz4_flex::block::compress(values.to_byte_slice()).len() as f64;
            self.share = left / bytes;
        }
        self.rows += 1;
        ROW + self.share * bytes
    }
}
