//! A run that is repeated: the scene, and the knobs that were turned by hand while it ran.

use asperity_engine::sim::Knob;

/// A knob turned by hand in the run that is repeated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HandTurn {
    /// Steps that the run had made, those of the start-up too.
    pub steps_made: u64,
    /// Knob.
    pub knob: Knob,
    /// Where to, SI.
    pub value: f64,
}
