//! Adds the result of a run to its finished recording: in the place of what its last frame said, with what only its
//! companion tells (the extrapolated life), and the band that holds with what the mesh costs, which nobody knew while
//! the run went on.

use std::path::Path;

use rerun::log::{Chunk, PendingRow};
use rerun::time::TimePoint;
use rerun::{AsComponents, Color, EntityPath, Scalars, SeriesLines, TextDocument};

use super::colour::curve;
use super::compact::{self, Epilogue};
use super::entities::SCALARS;
use super::entities::series::LIFE_BAND;
use super::entities::text::{LECTURE, NOW};
use super::moment::Moment;
use super::{ages, properties, text};
use asperity_engine::math::number::sig;
use asperity_engine::observe::ObserveError;
use asperity_engine::sim::Summary;

/// Writes the result of a run into its finished recording.
///
/// # Errors
/// When the file is no recording, or there is no room for the new one beside it; it is then as it was.
pub fn note_summary(path: &Path, summary: &Summary) -> Result<(), ObserveError> {
    let result = SummaryEpilogue {
        summary,
        moments: None,
        texts: [NOW, LECTURE].map(|entity| (entity, None)),
    };
    compact::compact(path, result).map(drop).map_err(|reason| {
        let reason = format!(
            "its result could not be added to its properties: {reason}; its steps are all there"
        );
        ObserveError::new(path.display().to_string(), reason)
    })
}

struct SummaryEpilogue<'a> {
    summary: &'a Summary,
    /// First and last moment of the recording's curves.
    moments: Option<[Moment; 2]>,
    /// The last texts of these entities.
    texts: [(&'static str, Option<String>); 2],
}

impl Epilogue for SummaryEpilogue<'_> {
    const ON_COMPACTED: bool = true;

    fn see(&mut self, chunk: &Chunk) {
        let path = chunk.entity_path().to_string();
        let entity = path.trim_start_matches('/');
        if entity == SCALARS {
            let ends = [0, chunk.num_rows() - 1].map(|row| Moment::of(chunk, row));
            if let [Some(first), Some(last)] = ends {
                self.moments = Some([self.moments.map_or(first, |[first, _]| first), last]);
            }
        }
        for (own, text) in &mut self.texts {
            if entity == *own {
                let component = TextDocument::descriptor_text().component;
                let last = chunk.iter_slices::<String>(component).last();
                let last = last.and_then(|row| row.first().map(ToString::to_string));
                *text = last.or_else(|| text.take());
            }
        }
    }

    fn chunks(self) -> Result<Vec<Chunk>, String> {
        let values = properties::summary_values(self.summary);
        let mut chunks = vec![chunk(properties::result(), TimePoint::default(), &values)?];
        chunks.extend(ages::chunks(&self.summary.ages)?);
        let ends = self.summary.life_relative_low;
        let ends = ends.zip(self.summary.life_relative_high);
        let ends = ends.filter(|(low, high)| *low > 0.0 && high.is_finite());
        let (Some((low, high)), Some(moments)) = (ends, self.moments) else {
            return Ok(chunks);
        };
        let style = SeriesLines::new()
            .with_colors([curve::GREEN; 2].map(Color::from))
            .with_widths([1.2; 2])
            .with_names(["mesh, low", "mesh, high"]);
        chunks.push(chunk(LIFE_BAND, TimePoint::default(), &style)?);
        for moment in moments {
            let band = Scalars::new([low, high].map(f64::log10));
            chunks.push(chunk(LIFE_BAND, moment.timepoint(), &band)?);
        }
        let [low, high] = [low, high].map(|end| sig(end, 3));
        for (entity, text) in self.texts {
            if let Some(text) = text {
                let text = text::with_band(&text, &format!("{low} to {high}"));
                let text = TextDocument::update_fields().with_text(text);
                chunks.push(chunk(entity, moments[1].timepoint(), &text)?);
            }
        }
        Ok(chunks)
    }
}

/// A row as a chunk of its own.
pub(crate) fn chunk(
    entity: impl Into<EntityPath>,
    at: TimePoint,
    data: &dyn AsComponents,
) -> Result<Chunk, String> {
    let row = PendingRow::from_iter(at, data.as_serialized_batches());
    row.into_chunk(entity.into())
        .map_err(|error| error.to_string())
}
