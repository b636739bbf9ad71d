//! Names of what is logged often, given once.

use rerun::EntityPath;

use super::super::gathered::LineStyle;
use super::super::waiting::{ClassImage, Curves, LevelImage, Sheet};
use super::Stream;
use asperity_engine::observe::ObserveError;

impl Stream {
    /// An image of classes that will be logged.
    pub(in super::super) fn class_image(&self, entity: impl Into<EntityPath>) -> ClassImage {
        let entity = self.path(entity);
        self.waiting.borrow_mut().class_image(entity)
    }

    /// An image of levels that will be logged.
    pub(in super::super) fn level_image(&self, entity: impl Into<EntityPath>) -> LevelImage {
        let entity = self.path(entity);
        self.waiting.borrow_mut().level_image(entity)
    }

    /// A mesh whose colours will be logged and, in all updates or in none, its positions.
    pub(in super::super) fn sheet(&self, entity: impl Into<EntityPath>) -> Sheet {
        let entity = self.path(entity);
        self.waiting.borrow_mut().sheet(entity)
    }

    /// Curves that will be logged.
    pub(in super::super) fn curves(&self, entity: impl Into<EntityPath>) -> Curves {
        let entity = self.path(entity);
        self.waiting.borrow_mut().curves(entity)
    }

    /// Logs curves: `fill` draws them.
    pub(in super::super) fn log_curves(
        &self,
        curves: Curves,
        fill: impl FnOnce(&mut LineStyle),
    ) -> Result<(), ObserveError> {
        let now = self.now.get();
        self.waiting.borrow_mut().push_curves(curves, now, fill);
        self.send_if_full()
    }

    /// Logs an image: `fill` adds its pixels.
    pub(in super::super) fn log_classes(
        &self,
        image: ClassImage,
        fill: impl FnOnce(&mut Vec<u8>),
    ) -> Result<(), ObserveError> {
        let now = self.now.get();
        self.waiting.borrow_mut().push_classes(image, now, fill);
        self.send_if_full()
    }

    /// Logs an image: `fill` adds its pixels, little-endian.
    pub(in super::super) fn log_levels(
        &self,
        image: LevelImage,
        fill: impl FnOnce(&mut Vec<u16>),
    ) -> Result<(), ObserveError> {
        let now = self.now.get();
        self.waiting.borrow_mut().push_levels(image, now, fill);
        self.send_if_full()
    }

    /// Logs an update of a mesh: `fill` adds x, y and z of its vertices and their colours.
    pub(in super::super) fn log_sheet(
        &self,
        sheet: Sheet,
        fill: impl FnOnce(&mut Vec<f32>, &mut Vec<u32>),
    ) -> Result<(), ObserveError> {
        let now = self.now.get();
        self.waiting.borrow_mut().push_sheet(sheet, now, fill);
        self.send_if_full()
    }
}
