//! What was frozen to compare with: the screen's own state at that moment, drawn beside what goes on.

use std::collections::VecDeque;
use std::sync::Arc;

use super::{App, Overlay};
use crate::tui::pixels::Pixels;

impl App {
    /// This state, frozen: its frame, trace and factors, without what goes on; `None` before the first frame.
    pub(super) fn frozen(&self) -> Option<Arc<Self>> {
        let frame = Arc::clone(self.frame()?);
        let mut ghost = self.clone();
        ghost.past = VecDeque::from([frame]);
        ghost.back = 0;
        ghost.is_frozen = true;
        (ghost.replay, ghost.held, ghost.left) = (None, None, None);
        (ghost.tour, ghost.draft, ghost.message) = (None, None, None);
        (ghost.ghost, ghost.pinned, ghost.probe) = (None, None, None);
        ghost.overlay = Overlay::None;
        ghost.pixels = Pixels::Blocks;
        ghost.simulated.clear();
        ghost.history.clear();
        Some(Arc::new(ghost))
    }

    /// Shows the frozen state as the present one: the same map, ranges, units and colours.
    pub(super) fn keep_ghost_alike(&mut self) {
        let Some(mut ghost) = self.ghost.take() else {
            return;
        };
        let own = Arc::make_mut(&mut ghost);
        (own.map, own.zoom, own.quantity) = (self.map, self.zoom, self.quantity);
        (own.theme, own.units) = (self.theme, self.units);
        own.reached = self.reached;
        own.scope.clone_from(&self.scope);
        self.ghost = Some(ghost);
    }
}
