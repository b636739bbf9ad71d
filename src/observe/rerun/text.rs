//! Words in the recording: what it is, how to repeat it, what happened, and the numbers of a frame.

use std::fmt::Write as _;

use rerun::components::MediaType;
use rerun::{TextDocument, TextLog, TextLogLevel};

use super::raster::Scale;
use super::reread::{CommandLine, Origin};
use super::stream::Stream;
use crate::observe::scales::number;
use crate::observe::{ObserveError, RunContext, RunEvent, RunEventKind};
use crate::scene::ContactKind;
use crate::sim::Frame;

pub(super) const ABOUT: &str = "text/about";
pub(super) const SCENE_TOML: &str = "text/scene_toml";
pub(super) const PLAN: &str = "text/plan";
pub(super) const NOTES: &str = "text/notes_on_the_data";
pub(super) const NOW: &str = "text/now";
pub(super) const LOG: &str = "log";
/// What the run began with, for programs.
pub(super) const ORIGIN: &str = "text/origin";
/// Knobs that were turned, for programs.
pub(super) const COMMANDS: &str = "commands";

/// What no reader of the numbers should forget.
pub(super) const CAUTION: &str =
    "relative life is an estimate under assumptions: isothermal, elastic, no wear, initiation only";

/// What is known before the first frame.
pub(super) fn log_context(stream: &Stream, context: &RunContext) -> Result<(), ObserveError> {
    let scene = &context.scene;
    let about = format!(
        "# {title}\n\n{about}\n\nRecorded by {program}.\n\n## To repeat it\n\n```\nasperity run --from \
         THIS_FILE.rrd --out again.rrd\n```\n\nturns the same knobs at the same steps and gives the same \
         numbers, bit for bit (same version of the program). Without the knobs: save the text under \
         *Scene* as `scene.toml`, then\n\n```\nasperity run scene.toml --out again.rrd\n```\n\n\
         The run is deterministic: no seed. Commands given while it ran are in the log, each with \
         its step.\n\n## Signs\n\nx is the rolling direction, z points into body 1 (the body \
         below). Pressure is positive in compression. S = (U2 - U1)/U with U = (U1 + U2)/2. \
         Traction on body 1 is positive along +x. Relative life compares with the smooth, \
         frictionless, S = 0 contact of the same load and geometry.\n",
        title = if scene.title.is_empty() {
            "A passage"
        } else {
            &scene.title
        },
        about = scene.about,
        program = context.program,
    );
    stream.log_static(ABOUT, &TextDocument::from_markdown(about))?;
    let toml = TextDocument::new(context.scene_toml.as_str());
    stream.log_static(SCENE_TOML, &toml)?;
    let origin = Origin {
        program: context.program.clone(),
        began: context.began,
    };
    stream.log_static(ORIGIN, &TextDocument::new(origin.to_text()))?;
    let plan = TextDocument::new(context.plan_text.as_str());
    stream.log_static(PLAN, &plan)
}

/// How numbers are stored.
pub(super) fn log_notes<'a>(
    stream: &Stream,
    scales: impl Iterator<Item = &'a (&'static str, Scale)>,
    cadence: &str,
    exaggeration: &str,
) -> Result<(), ObserveError> {
    let mut notes = format!(
        "# Notes on the data\n\n{cadence} Interferogram, traction, \
         roughness, shear stress and damage take every second of them.\n\n{exaggeration}\n\nMaps are stored in 16 bits: value = \
         stored number / `meter`, in the unit of the entity's name. Colours have the same range in \
         every frame; values above it take the top colour.\n\n| entity | colours up to | stored \
         range | smallest difference |\n|---|---|---|---|\n"
    );
    for (entity, scale) in scales {
        let [low, high] = scale.stored_range();
        let unit = scale.unit;
        // Writing to a string cannot fail.
        let _ = writeln!(
            notes,
            "| `{entity}` | {} {unit} | {} to {} {unit} | {:.1e} {unit} |",
            number(scale.top),
            number(low),
            number(high),
            scale.resolution(),
        );
    }
    stream.log_static(NOTES, &TextDocument::from_markdown(notes))?;
    let markdown = TextDocument::update_fields().with_media_type(MediaType::markdown());
    stream.log_static(NOW, &markdown)
}

/// The caption that holds and the numbers of a frame.
pub(super) fn log_now(stream: &Stream, frame: &Frame, caption: &str) -> Result<(), ObserveError> {
    let text = TextDocument::update_fields().with_text(now(frame, caption));
    stream.log(NOW, &text)
}

fn now(frame: &Frame, caption: &str) -> String {
    let m = &frame.metrics;
    let mut text = String::with_capacity(1024);
    if !caption.is_empty() {
        let _ = writeln!(text, "> {caption}\n");
    }
    if let Some(life) = &m.life {
        let settled = if life.settled { "" } else { " *(settling)*" };
        let _ = writeln!(
            text,
            "### Relative life {:.3}{settled}\n\n{:.3} to {:.3}; cycles {:.3} × peaks {:.3} × \
             traction {:.3}\n",
            life.life_relative,
            life.life_relative_low,
            life.life_relative_high,
            life.cycle_factor,
            life.peak_factor,
            life.traction_factor
        );
    }
    if !m.converged {
        let _ = writeln!(
            text,
            "**This step did not converge: residual {:.1e}.**\n",
            m.residual
        );
    }
    let unit = match frame.kind {
        ContactKind::Point => "N",
        ContactKind::Line => "N/m",
    };
    let _ = writeln!(
        text,
        "| time | {:.3} ms, passage {:.2} |\n|---|---|\n| S | {:.3}, going to {:.3} |\n\
         | U1, U2 | {:.3}, {:.3} m/s |\n| load, p_Hertz | {:.1} {unit}, {:.3} GPa |\n| p_max | {:.3} GPa |\n\
         | h central, min | {:.1}, {:.1} nm |\n| contact | {:.2} % of area, {:.2} % of load |",
        frame.time_s * 1e3,
        frame.passages,
        m.slide_roll,
        m.slide_roll_target,
        m.entrainment_m_s * (1.0 - 0.5 * m.slide_roll),
        m.entrainment_m_s * (1.0 + 0.5 * m.slide_roll),
        m.load_n,
        frame.p_hertz_pa * 1e-9,
        m.p_max_pa * 1e-9,
        m.h_central_m * 1e9,
        m.h_min_m * 1e9,
        m.contact_ratio * 100.0,
        m.contact_load_ratio * 100.0,
    );
    let friction = m.friction_coefficient;
    let _ = match m.lambda_ratio {
        Some(lambda) => writeln!(text, "| friction, λ | {friction:.4}, {lambda:.2} |"),
        None => writeln!(text, "| friction | {friction:.4} |"),
    };
    if let (Some(stress), Some(depth)) = (m.sigma_eff_max_pa, m.sigma_eff_max_depth_m) {
        let (stress, depth) = (stress * 1e-9, depth * 1e6);
        let _ = writeln!(text, "| σ_eff max | {stress:.3} GPa, {depth:.0} µm deep |");
    }
    let formula = [m.n_body_1, m.n_body_2];
    if formula.iter().any(Option::is_some) {
        let pair = |n: [Option<f64>; 2]| {
            n.map(|n| n.map_or("-".to_owned(), |n| format!("{n:.2}")))
                .join(", ")
        };
        let counted = pair([m.n_counted_body_1, m.n_counted_body_2]);
        let _ = writeln!(text, "| n of 1, 2 | {}; counted {counted} |", pair(formula));
    }
    text
}

/// Something that happened.
pub(super) fn log_event(stream: &Stream, event: &RunEvent) -> Result<(), ObserveError> {
    let (text, level) = match &event.kind {
        RunEventKind::Set { key, value, .. } => (
            format!("step {}: {key} set to {value}", event.step),
            TextLogLevel::INFO,
        ),
        RunEventKind::Caption(caption) => (caption.clone(), TextLogLevel::INFO),
        RunEventKind::NotConverged { residual } => (
            format!(
                "step {} did not converge: residual {residual:.2e}",
                event.step
            ),
            TextLogLevel::WARN,
        ),
    };
    if let RunEventKind::Set {
        key,
        value,
        by,
        steps_made,
    } = &event.kind
    {
        let line = CommandLine {
            steps_made: *steps_made,
            key: key.clone(),
            value: *value,
            by: *by,
        };
        stream.log(COMMANDS, &TextLog::new(line.to_text()))?;
    }
    log_line(stream, &text, level)
}

/// A line of the log.
pub(super) fn log_line(stream: &Stream, text: &str, level: &str) -> Result<(), ObserveError> {
    stream.log(LOG, &TextLog::new(text).with_level(level))
}
