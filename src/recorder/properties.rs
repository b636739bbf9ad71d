//! Name and properties of a recording: what a viewer lists of it beside others, and what scripts read without
//! reading its frames.

use std::path::Path;
use std::sync::Arc;

use rerun::external::arrow::array::{ArrayRef, Float64Array, StringArray};
use rerun::log::{Chunk, PendingRow};
use rerun::time::TimePoint;
use rerun::{
    AnyValues, AsComponents as _, Color, EntityPath, RecordingInfo, Scalars, SeriesLines,
    TextDocument,
};

use super::bound::{self, RecordingEnd};
use super::colour::curve;
use super::gathered::chunk_of;
use super::stream::Stream;
use super::text;
use asperity_engine::math::number::sig;
use asperity_engine::observe::{ObserveError, RunContext};
use asperity_engine::scene::ContactKind;
use asperity_engine::sim::{Frame, Metrics, Summary};

/// What is asked for.
const SCENE: &str = "scene";
/// What came out.
const RESULT: &str = "result";

fn entity(name: &str) -> EntityPath {
    EntityPath::properties().join(&EntityPath::from(name))
}

/// Values under names; those that are not known are left out.
#[derive(Default)]
struct NamedValues(AnyValues);

impl NamedValues {
    fn array(self, name: &'static str, array: ArrayRef) -> Self {
        Self(self.0.with_component_from_data(name, array))
    }

    fn text(self, name: &'static str, text: &str) -> Self {
        self.array(name, Arc::new(StringArray::from(vec![text.to_owned()])))
    }

    fn number(self, name: &'static str, value: impl Into<Option<f64>>) -> Self {
        match value.into().filter(|value| value.is_finite()) {
            Some(value) => self.array(name, Arc::new(Float64Array::from(vec![value]))),
            None => self,
        }
    }
}

/// Name and scene, before the first frame.
pub(super) fn log_scene(stream: &Stream, context: &RunContext) -> Result<(), ObserveError> {
    let scene = &context.scene;
    let title = if scene.title.is_empty() {
        "A passage"
    } else {
        &scene.title
    };
    let (slide_roll, p_hertz_gpa) = (scene.motion.slide_roll, scene.hertz().p_max_pa * 1e-9);
    let name = format!(
        "{title}: S = {}, p_Hertz = {} GPa",
        sig(slide_roll, 3),
        sig(p_hertz_gpa, 3)
    );
    let info = RecordingInfo::update_fields().with_name(name);
    stream.log_static(EntityPath::properties(), &info)?;
    let load = match scene.kind() {
        ContactKind::Point => "load_N",
        ContactKind::Line => "load_N_per_m",
    };
    let values = NamedValues::default()
        .text("title", title)
        .text("program", &context.program)
        .number("S", slide_roll)
        .number("U_m_s", scene.motion.entrainment_m_s)
        .number(load, scene.force_n())
        .number("p_Hertz_GPa", p_hertz_gpa)
        .number("nodes", scene.grid.nodes as f64);
    stream.log_static(entity(SCENE), &values.0)
}

/// The scalars of the last frame; a frame itself goes back to where it is filled again.
pub(super) struct Last {
    pub(super) step: u64,
    p_hertz_pa: f64,
    metrics: Metrics,
}

impl Last {
    pub(super) fn of(frame: &Frame) -> Self {
        Self {
            step: frame.step,
            p_hertz_pa: frame.p_hertz_pa,
            metrics: frame.metrics.clone(),
        }
    }
}

/// What the last frame says, at the end: also of a run that was stopped, or of the explorer's.
pub(super) fn log_result(stream: &Stream, last: &Last, clipped: u64) -> Result<(), ObserveError> {
    let m = &last.metrics;
    let life = m.life.as_ref();
    let values = NamedValues::default()
        .number("steps", last.step as f64)
        .number("S", m.slide_roll)
        .number("p_Hertz_GPa", last.p_hertz_pa * 1e-9)
        .number("p_max_GPa", m.p_max_pa * 1e-9)
        .number("h_central_um", m.h_central_m * 1e6)
        .text("regime", m.regime.name())
        .number("life_relative", life.map(|life| life.life_relative))
        .number("life_relative_low", life.map(|life| life.life_relative_low))
        .number(
            "life_relative_high",
            life.map(|life| life.life_relative_high),
        )
        .number("load_factor", life.map(|life| life.load_factor))
        .number("clipped_samples", clipped as f64);
    stream.log_static(entity(RESULT), &values.0)
}

/// Writes the result of a run, with what only its companion tells (the extrapolated life), into its finished recording
/// in the place of what its last frame said.
///
/// # Errors
/// When the file is no recording, or there is no room for the new one beside it; it is then as it was.
pub fn note_summary(path: &Path, summary: &Summary) -> Result<(), ObserveError> {
    let s = summary;
    let values = NamedValues::default()
        .text("scene", &s.scene)
        .number("steps", s.steps as f64)
        .number("p_Hertz_GPa", s.p_hertz_pa * 1e-9)
        .number("p_max_GPa", s.p_max_pa * 1e-9)
        .number("h_central_um", s.h_central_m * 1e6)
        .text("regime", s.regime.name())
        .number("life_relative", s.life_relative)
        .number("life_relative_low", s.life_relative_low)
        .number("life_relative_high", s.life_relative_high)
        .number("load_factor", s.load_factor)
        .number("life_extrapolated", s.life_extrapolated);
    let failed = |reason: String| {
        let reason = format!("its result could not be added to its properties: {reason}");
        ObserveError::new(path.display().to_string(), reason)
    };
    let row = PendingRow::from_iter(TimePoint::default(), values.0.as_serialized_batches());
    let chunk: Chunk = row
        .into_chunk(entity(RESULT))
        .map_err(|error| failed(error.to_string()))?;
    let more = |ending: &RecordingEnd| {
        let mut chunks = vec![chunk];
        chunks.extend(band(summary, ending)?);
        Ok(chunks)
    };
    bound::bind(path, more).map(drop).map_err(failed)
}

/// Lines of the band that holds with what the mesh costs, which nobody knew while the run went on.
const BAND: &str = "life/log10_relative/with_the_meshs_error";

/// The life's band with the mesh's error: as lines over the whole run, and in the last texts.
fn band(summary: &Summary, ending: &RecordingEnd) -> Result<Vec<Chunk>, String> {
    let ends = summary.life_relative_low.zip(summary.life_relative_high);
    let ends = ends.filter(|(low, high)| *low > 0.0 && high.is_finite());
    let (Some((low, high)), Some(moments)) = (ends, ending.moments) else {
        return Ok(Vec::new());
    };
    let words = |error: &dyn std::fmt::Display| error.to_string();
    let style = SeriesLines::new()
        .with_colors([curve::GREEN; 2].map(Color::from))
        .with_widths([1.2; 2])
        .with_names(["low, with the mesh's error", "high, with the mesh's error"]);
    let style = PendingRow::from_iter(TimePoint::default(), style.as_serialized_batches());
    let mut chunks = vec![
        style
            .into_chunk(BAND.into())
            .map_err(|error| words(&error))?,
    ];
    let values = [low, high, low, high].map(f64::log10);
    let columns = Scalars::new(values)
        .columns([2, 2])
        .map_err(|error| words(&error))?;
    chunks.push(chunk_of(BAND.into(), &moments, columns).map_err(|error| words(&error))?);
    let [low, high] = [low, high].map(|end| sig(end, 3));
    for (entity, text) in &ending.texts {
        let text = text::with_band(text, &format!("{low} to {high}"));
        let text = TextDocument::update_fields().with_text(text);
        let columns = text
            .columns_of_unit_batches()
            .map_err(|error| words(&error))?;
        let chunk = chunk_of((*entity).into(), &moments[1..], columns);
        chunks.push(chunk.map_err(|error| words(&error))?);
    }
    Ok(chunks)
}
