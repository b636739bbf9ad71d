//! What frames and summaries are made from.

use crate::sim::State;
use crate::sim::sim_plan::SimPlan;
use crate::sim::work::Work;

/// A simulation to be read.
#[derive(Clone, Copy)]
pub(super) struct View<'a> {
    pub(super) plan: &'a SimPlan,
    pub(super) state: &'a State,
    pub(super) work: &'a Work,
}
