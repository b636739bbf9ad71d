//! What was frozen to compare with: the screen's own state at that moment, drawn beside what goes on.

use std::collections::VecDeque;
use std::sync::Arc;

use super::state::App;
use crate::tui::kinds::Overlay;
use crate::tui::pixels::Medium;

impl App {
    /// This state, frozen: its frame, trace and factors, without what goes on; `None` before the first frame.
    pub(super) fn freeze(&self) -> Option<Arc<Self>> {
        let frame = Arc::clone(self.frame()?);
        let mut frozen = self.clone();
        frozen.run.frames = VecDeque::from([frame]);
        frozen.run.frames_back = 0;
        frozen.replay.playing = None;
        frozen.replay.settled = None;
        frozen.replay.settled_before = None;
        frozen.lesson.tour = None;
        frozen.choice.draft = None;
        frozen.lives.simulated.clear();
        frozen.lives.history.clear();
        let view = &mut frozen.view;
        view.is_frozen = true;
        view.frozen = None;
        view.pinned = None;
        view.probe = None;
        view.message = None;
        view.overlay = Overlay::None;
        view.medium = Medium::Terminal;
        Some(Arc::new(frozen))
    }

    /// Shows the frozen state as the present one: the same map, ranges, units and colours.
    pub(super) fn keep_frozen_alike(&mut self) {
        let Some(mut frozen) = self.view.frozen.take() else {
            return;
        };
        let own = Arc::make_mut(&mut frozen);
        own.view.map = self.view.map;
        own.view.zoom = self.view.zoom;
        own.view.point_quantity = self.view.point_quantity;
        own.view.theme = self.view.theme;
        own.view.units = self.view.units;
        own.run.axis_ends = self.run.axis_ends;
        own.run.scope.clone_from(&self.run.scope);
        self.view.frozen = Some(frozen);
    }
}
