//! What every picture of the recording does, so that a list of them is all that there is to go through.

use super::raster::RasterEntity;
use super::stream::Stream;
use asperity_engine::scene::Scene;
use asperity_engine::sim::Frame;
use asperity_picture::Scope;

/// A picture, set up with the first frame.
pub(crate) trait View: Send {
    /// Draws to what can come from now on. All views are widened in one moment, so that pictures, axes and legends agree.
    fn widen(&mut self, stream: &Stream, scene: Option<&Scene>, scope: &Scope);

    /// Takes up the scalars of every step, also of those whose fields are not recorded.
    fn follow_scalars(&mut self, _frame: &Frame) {}

    /// Takes up the fields of every step.
    fn follow_fields(&mut self, _frame: &Frame) {}

    /// Logs a frame.
    fn log(&mut self, stream: &Stream, frame: &Frame);

    /// Logs what every second picture has.
    fn log_seldom(&mut self, _stream: &Stream, _frame: &Frame) {}

    /// Logs what is known at the end.
    fn finish(&mut self, _stream: &Stream) {}

    /// Maps whose ranges are told.
    fn rasters(&self) -> Vec<(&'static str, &RasterEntity)> {
        Vec::new()
    }
}
