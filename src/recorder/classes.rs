//! What lies over a picture of the film in colours of its own: contact, and film above the range.

use rerun::components::ImageBuffer;
use rerun::{AnnotationContext, Rgba32, SegmentationImage};

use super::stream::Stream;

use asperity_picture::{ABOVE, CONTACT, Look};

const FILM: u8 = 0;
pub(crate) const TOUCHES: u8 = 1;
const THICK: u8 = 2;

/// How an image of classes looks.
pub(crate) fn styled() -> SegmentationImage {
    SegmentationImage::update_fields()
        .with_opacity(1.0)
        .with_draw_order(5.0)
}

/// The classes' names and colours.
pub(crate) fn context() -> AnnotationContext {
    let colour = |[r, g, b]: [u8; 3]| Rgba32::from_rgb(r, g, b);
    AnnotationContext::new([
        (
            FILM.into(),
            "film",
            Rgba32::from_unmultiplied_rgba(0, 0, 0, 0),
        ),
        (TOUCHES.into(), "contact", colour(CONTACT)),
        (THICK.into(), "film above the colour range", colour(ABOVE)),
    ])
}

/// Logs an image of classes.
pub(crate) fn log(stream: &Stream, entity: &str, classes: Vec<u8>) {
    let image = SegmentationImage::update_fields().with_buffer(ImageBuffer::from(classes));
    stream.log(entity, &image);
}

/// Classes of a row of nodes.
pub(crate) fn of_row(look: &Look, touches: &[u8], film_m: &[f32], classes: &mut [u8]) {
    classify(touches, film_m, look.range[1] as f32, classes);
}

dispatched! {
    fn classify(touches: &[u8], film_m: &[f32], top: f32, classes: &mut [u8]) {
        for ((out, &touches), &film) in classes.iter_mut().zip(touches).zip(film_m) {
            let apart = if film > top { THICK } else { FILM };
            *out = if touches == 0 { apart } else { TOUCHES };
        }
    }
}
