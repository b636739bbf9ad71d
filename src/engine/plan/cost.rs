//! What a run will cost: memory, time, size of a recorded frame. Estimates to one digit, for `asperity check`
//! and for deciding on a progress bar; nothing in the results depends on them.

use super::display::duration;
use crate::scene::{ContactKind, Warming};

/// Memory and time of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cost {
    /// Memory of the solver's arrays, bytes.
    pub memory_bytes: u64,
    /// Time of the whole run on one core of a laptop, s.
    pub time_s: f64,
}

/// What decides the cost.
#[derive(Debug, Clone, Copy)]
pub(super) struct CostInput {
    pub(super) kind: ContactKind,
    pub(super) nodes: usize,
    /// Part of the rows that is computed: 1/2 with a mirror.
    pub(super) rows: f64,
    pub(super) depths: usize,
    pub(super) steps: u64,
    pub(super) start_up_steps: u64,
    pub(super) volumes: u64,
}

/// Fields of one f64 per node that the solver keeps, Krylov basis and padded transforms (4 nodes each)
/// included.
const FIELDS: f64 = 160.0;
/// Complex f32 values per node and depth for the stress: transforms of the frequency response.
const STRESS_BYTES_PER_NODE: f64 = 8.0 * 4.0;
/// Seconds of one converged rough step at 129², one thread, and the exponent of its growth with the nodes
/// per side (4.2, 14.2 and 92 ms were measured at 65², 129² and 257²; `asperity study scaling`), and what half of
/// the rows save: a third.
const STEP_129_S: f64 = 0.0142;
const STEP_GROWTH: f64 = 2.2;
const ALL_ROWS: f64 = 0.7;
/// Seconds of one volume integral per depth at 129² (2.1 ms with 24 depths, and the counting beside it).
const DEPTH_129_S: f64 = 1e-4;
/// Seconds of one rough step of a line, of each of its nodes, and of the stress of a node at one depth
/// (1.5 ms at 65 nodes and 4 ms at 513 with 32 depths were measured, one busy thread).
const LINE_STEP_S: f64 = 1.0e-3;
const LINE_NODE_S: f64 = 4.0e-6;
const LINE_DEPTH_NODE_S: f64 = 5.0e-8;
/// Tables and slice of a line's stress, bytes a node and depth.
const LINE_DEPTH_BYTES: f64 = 56.0;
/// Bytes of the pictures of one recorded frame as they reach the disk: those that grow with the nodes and the
/// sheets of the 3-D view (59, 75 and 154 kB were measured at 65², 129² and 257²). The recorder keeps to what it
/// measures.
const FIELD_BYTES_PER_NODE: f64 = 1.7;
const SHEET_BYTES: f64 = 5e4;

/// Waves of a padded domain over nodes, of a point and of a line; bytes that both bodies' heat takes of each; seconds of a step of
/// each, of surfaces alone and with warm oil (at 129², mirrored: 1.1 and 3.6 ms a step were measured).
const HEAT_WAVES: [f64; 2] = [2.0, 4.0];
const HEAT_BYTES: f64 = 2.0 * 41.0 * 16.0;
const HEAT_WAVE_S: [f64; 2] = [7e-8, 2.2e-7];

/// Bytes of the fields of one recorded frame.
pub(super) fn frame_bytes(nodes: usize, rows: usize) -> f64 {
    FIELD_BYTES_PER_NODE * (nodes * rows) as f64 + SHEET_BYTES
}

impl Cost {
    /// The time in words.
    pub fn time_text(&self) -> String {
        duration(self.time_s)
    }

    pub(super) fn new(load: CostInput) -> Self {
        let nodes = load.nodes as f64;
        if load.kind == ContactKind::Line {
            return Self::of_a_line(nodes, &load);
        }
        let all = nodes * nodes;
        let scale = nodes / 129.0;
        let step_s = STEP_129_S * scale.powf(STEP_GROWTH) * (1.0 - ALL_ROWS + ALL_ROWS * load.rows);
        let volume_s = DEPTH_129_S * scale * scale * load.depths as f64;
        let memory =
            8.0 * FIELDS * all * load.rows + STRESS_BYTES_PER_NODE * all * load.depths as f64;
        Self {
            memory_bytes: memory as u64,
            time_s: step_s * (load.steps + load.start_up_steps) as f64
                + volume_s * load.volumes as f64,
        }
    }

    /// With the heat of both bodies in each of so many steps, on `rows` of all rows.
    pub(super) fn with_heat(
        mut self,
        warming: Warming,
        (kind, nodes, rows): (ContactKind, usize, f64),
        steps: u64,
    ) -> Self {
        let wave_s = match warming {
            Warming::None => return self,
            Warming::Surfaces => HEAT_WAVE_S[0],
            Warming::SurfacesAndOil => HEAT_WAVE_S[1],
        };
        let nodes = nodes as f64;
        let waves = match kind {
            ContactKind::Point => HEAT_WAVES[0] * nodes * nodes * rows,
            ContactKind::Line => HEAT_WAVES[1] * nodes,
        };
        self.memory_bytes += (HEAT_BYTES * waves) as u64;
        self.time_s += wave_s * waves * steps as f64;
        self
    }

    /// One row, with stress at every step; the volume integrals cost as much as two slices more.
    fn of_a_line(nodes: f64, load: &CostInput) -> Self {
        let depths = load.depths as f64;
        let step_s = LINE_STEP_S + nodes * (LINE_NODE_S + depths * LINE_DEPTH_NODE_S);
        let steps = (load.steps + load.start_up_steps) as f64;
        let volume_s = 2.0 * nodes * depths * LINE_DEPTH_NODE_S;
        Self {
            memory_bytes: (nodes * (8.0 * FIELDS + LINE_DEPTH_BYTES * depths)) as u64,
            time_s: step_s * steps + volume_s * load.volumes as f64,
        }
    }
}
