//! How often a recording takes a step's fields and its scalars, so that it keeps to its budget: what the recorder begins
//! with, and what `asperity check` says before.

use super::PlanError;
use crate::scene::{ContactKind, Record};

/// Bytes of the scalars of a step, compressed: the curves and a row of the whole catalogue (1125 were measured).
pub const SCALARS_BYTES: f64 = 1.15e3;
/// Part of what is left that scalars may take in the scene's own run.
pub const SCALARS_SHARE: f64 = 0.5;
/// Layout, footer and the first chunk of every entity, bytes (some 800 kB were measured).
pub const ALWAYS_BYTES: f64 = 8.5e5;
/// What a recording takes at the least: all of that with the pictures that a run begins and ends with, and the least series.
/// Bytes always, and for every node of the grid, of a line for every node along it (with less than that, before it was refused:
/// 1.49 to 1.63 MB on 65², 1.60 to 1.67 on 129², 2.00 on 257²; lines of 257, 513 and 1025 nodes 1.73 to 1.93, 2.31 to 2.46 and
/// 3.46, by preset, depths and planes).
const LEAST_BYTES: f64 = 1.6e6;
const LEAST_PER_NODE: f64 = 9.0;
const LEAST_OF_LINE_BYTES: f64 = 1.4e6;
const LEAST_PER_NODE_OF_LINE: f64 = 2.4e3;
/// Part of the budget for the scene's own run; the rest is for what may come after it.
pub const OWN_SHARE: f64 = 0.9;

/// Recording, as far as it can be known before: the recorder keeps to the budget by what it measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RecordPlan {
    /// Time steps between two recordings of the fields: the scene's, or more to keep its budget.
    pub every_steps: u64,
    /// Time steps between two recordings of the scalars: every step, or fewer to keep the budget.
    pub scalars_every_steps: u64,
    /// Recordings of the fields in the whole run.
    pub frames: u64,
    /// Estimated size, bytes.
    pub bytes: u64,
    /// Most that the scene allows, bytes.
    pub budget_bytes: u64,
}

/// Steps between two recordings of the fields, and of the scalars.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RecordingRhythm {
    /// Of the fields.
    pub fields: u64,
    /// Of the scalars.
    pub scalars: u64,
}

impl RecordingRhythm {
    /// Of a run of `steps` whose fields take `frame_bytes` a time, with `left_bytes` for all of it.
    pub fn new(record: &Record, steps: f64, frame_bytes: f64, left_bytes: f64) -> Self {
        let scalars_bytes = steps * SCALARS_BYTES;
        let scalars = (scalars_bytes / (SCALARS_SHARE * left_bytes))
            .ceil()
            .max(1.0);
        let fields = (steps * frame_bytes / (left_bytes - scalars_bytes / scalars)).ceil();
        Self {
            fields: (fields as u64).max(record.every_steps.max(1) as u64),
            scalars: scalars as u64,
        }
    }
}

/// Bytes of a budget that the scene's own run may fill, where so many come whatever is recorded; never none, so that
/// there is something to divide by.
pub fn left_bytes(record: &Record, spent_bytes: f64) -> f64 {
    let budget = record.budget_mb * 1e6;
    (OWN_SHARE * budget - spent_bytes).max(1e-3 * budget)
}

/// Refuses a budget that not even a recording of the first and the last picture keeps.
pub(super) fn check(kind: ContactKind, nodes: usize, record: &Record) -> Result<(), PlanError> {
    let n = nodes as f64;
    let least_bytes = match kind {
        ContactKind::Point => LEAST_BYTES + LEAST_PER_NODE * n * n,
        ContactKind::Line => LEAST_OF_LINE_BYTES + LEAST_PER_NODE_OF_LINE * n,
    };
    // Rounded up: what is said to be allowed is.
    let least_mb = (least_bytes * 1e-5).ceil() / 10.0;
    if record.budget_mb >= least_mb {
        return Ok(());
    }
    Err(PlanError::Refused {
        key: "record.budget_mb".to_owned(),
        value: format!("{} MB", record.budget_mb),
        allowed: format!(
            "at least {least_mb:.1} MB on {nodes} nodes per side: layout, the first and the last pictures take that"
        ),
    })
}

impl RecordPlan {
    pub(super) fn new(record: &Record, steps: u64, frame_bytes: f64) -> Self {
        let left = left_bytes(record, ALWAYS_BYTES);
        let rhythm = RecordingRhythm::new(record, steps as f64, frame_bytes, left);
        let frames = steps.div_ceil(rhythm.fields);
        let scalars = steps.div_ceil(rhythm.scalars);
        let bytes = ALWAYS_BYTES + frames as f64 * frame_bytes + scalars as f64 * SCALARS_BYTES;
        Self {
            every_steps: rhythm.fields,
            scalars_every_steps: rhythm.scalars,
            frames,
            bytes: bytes as u64,
            budget_bytes: (record.budget_mb * 1e6) as u64,
        }
    }
}
