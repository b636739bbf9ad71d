//! Name and properties of a recording: what a viewer lists of it beside others, and what scripts read without
//! reading its frames.

use std::sync::Arc;

use rerun::external::arrow::array::{ArrayRef, Float64Array, StringArray};
use rerun::{AnyValues, EntityPath, RecordingInfo};

use super::stream::Stream;
use asperity_engine::math::number::sig;
use asperity_engine::observe::RunContext;
use asperity_engine::scene::ContactKind;
use asperity_engine::sim::{Cause, Frame, Metrics, Summary};

/// What came out.
pub(crate) fn result() -> EntityPath {
    EntityPath::properties().join(&EntityPath::from("result"))
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
pub(crate) fn log_scene(stream: &Stream, context: &RunContext) {
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
    stream.log_static(EntityPath::properties(), &info);
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
    let entity = EntityPath::properties().join(&EntityPath::from("scene"));
    stream.log_static(entity, &values.0);
}

/// The scalars of the last frame; a frame itself goes back to where it is filled again.
pub(crate) struct Last {
    pub(crate) step: u64,
    p_hertz_pa: f64,
    metrics: Metrics,
}

impl Last {
    pub(crate) fn of(frame: &Frame) -> Self {
        Self {
            step: frame.step,
            p_hertz_pa: frame.p_hertz_pa,
            metrics: frame.metrics.clone(),
        }
    }
}

/// What the last frame says, at the end: also of a run that was stopped, or of the explorer's.
pub(crate) fn log_result(stream: &Stream, last: &Last) {
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
        .number("life_body", life.map(|life| f64::from(life.detail.body)))
        .text("life_cause", life.map_or("", |life| life.cause().words()));
    stream.log_static(result(), &values.0);
}

/// What the summary of a run says, with what only its companion tells (the extrapolated life).
pub(crate) fn summary_values(s: &Summary) -> AnyValues {
    NamedValues::default()
        .text("scene", &s.scene)
        .number("steps", s.steps as f64)
        .number("p_Hertz_GPa", s.p_hertz_pa * 1e-9)
        .number("p_max_GPa", s.p_max_pa * 1e-9)
        .number("h_central_um", s.h_central_m * 1e6)
        .text("regime", s.regime.name())
        .number("life_relative", s.life_relative)
        .number("life_relative_low", s.life_relative_low)
        .number("life_relative_high", s.life_relative_high)
        .number("life_oil_low", s.life_oil_low)
        .number("life_oil_high", s.life_oil_high)
        .number("life_phases_low", s.life_phases_low)
        .number("life_phases_high", s.life_phases_high)
        .number("load_factor", s.load_factor)
        .number("life_common", s.life_common)
        .number("life_body", s.life_body.map(f64::from))
        .text("life_cause", s.life_cause.map_or("", Cause::words))
        .number("life_extrapolated", s.life_extrapolated)
        .0
}
