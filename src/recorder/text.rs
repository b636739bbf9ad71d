//! Words in the recording: what it is, how to repeat it, what happened, and the numbers of a frame.

use std::fmt::Write as _;

use rerun::components::MediaType;
use rerun::{TextDocument, TextLog, TextLogLevel};

use super::entities::text::{ABOUT, COMMANDS, LECTURE, LOG, NOTES, NOW, ORIGIN, PLAN, SCENE_TOML};
use super::note::Note;
use super::picture::{Beyond, top};
use super::series::by_itself;
use super::stream::Stream;
use asperity_engine::math::number::{counted, plain, seconds, sig, sig_or_dash};
use asperity_engine::observe::{RunContext, RunEvent, RunEventKind};
use asperity_engine::scene::ContactKind;
use asperity_engine::sim::{Caution, CautionCode, Frame, LifeEstimate};
use asperity_picture::Look;

/// What no reader of the numbers should forget.
pub(crate) const CAUTION: &str = "relative life is an estimate under assumptions: those of its cautions, elastic below the surface, initiation only";

/// What is known before the first frame.
pub(crate) fn log_context(stream: &Stream, context: &RunContext) {
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
    stream.log_static(ABOUT, &TextDocument::from_markdown(about));
    let toml = TextDocument::new(context.scene_toml.as_str());
    stream.log_static(SCENE_TOML, &toml);
    let origin = Note::Origin {
        program: context.program.clone(),
        began: context.began,
        scene_toml: context.scene_toml.clone(),
    };
    stream.log_static(ORIGIN, &TextDocument::new(origin.to_text()));
    let plan = TextDocument::new(context.plan_text.as_str());
    stream.log_static(PLAN, &plan);
}

/// How numbers are stored.
pub(crate) fn log_notes<'a>(
    stream: &Stream,
    looks: impl Iterator<Item = (&'static str, &'a Look)>,
    cadence: &str,
    exaggeration: &str,
) {
    let mut notes = format!(
        "# Notes on the data\n\n{cadence} Interferogram, traction, \
         roughness, shear stress and damage take every second of them.\n\n{exaggeration}\n\nPictures show the contact and what is near it. \
         Pressure, film, effective stress and temperature are stored in levels, powers of two of the unit of the entity's name: \
         at least 4096 of the colour range (film: 8192, and no more than twice its range); what has a sign in half precision \
         (0.05 %). Colours have one range: what can come by the scene's \
         script. A knob turned by hand beyond the script widens it from then on: the legends change, the log tells, and \
         below stand the widest. Values above the range take the top colour and are told under *Now*, but film takes a dark one of its own, in the map and over time; none but film is cut \
         off in the file below 65 504 units. The slice below body 1 and the damage maps have a row for each depth \
         that was computed; the depths are in the axis. Entities under `slice_over_log_depth` and `profile_y0` are resampled \
         for looking at. Damage that has not been counted yet is no number (NaN).\n\n\
         | entity | colours up to |\n|---|---|\n"
    );
    for (entity, look) in looks {
        // Writing to a string cannot fail.
        let _ = writeln!(
            notes,
            "| `{entity}` | {} {} |",
            plain(top(look)),
            look.unit.name
        );
    }
    stream.log_static(NOTES, &TextDocument::from_markdown(notes));
    let markdown = TextDocument::update_fields().with_media_type(MediaType::markdown());
    stream.log_static(NOW, &markdown);
    stream.log_static(LECTURE, &markdown);
}

/// A map whose range was widened.
pub(crate) struct WidenedRange {
    pub(crate) entity: &'static str,
    /// The tops of the range, in the unit.
    pub(crate) before: f64,
    pub(crate) after: f64,
    pub(crate) unit: &'static str,
}

/// A range that holds from now on.
pub(crate) fn log_widened(stream: &Stream, range: &WidenedRange) {
    let [before, after] = [range.before, range.after].map(plain);
    let (entity, unit) = (range.entity, range.unit);
    let line = format!(
        "a knob was turned beyond the scene's script: the colours of {entity} reach {after} {unit} from here on, before {before}"
    );
    log_line(stream, &line, TextLogLevel::INFO);
}

/// A map of which something is above the colours.
pub(crate) struct AboveRange {
    pub(crate) entity: &'static str,
    pub(crate) beyond: Beyond,
    pub(crate) unit: &'static str,
}

/// The caption that holds and the numbers of a frame.
pub(crate) fn log_now(stream: &Stream, frame: &Frame, caption: &str, above: &[AboveRange]) {
    let text = TextDocument::update_fields().with_text(now(frame, caption, above));
    stream.log(NOW, &text);
    let text = TextDocument::update_fields().with_text(lecture(frame, caption));
    stream.log(LECTURE, &text);
}

/// A text with the band that came out of the run's companion, below the life.
pub(crate) fn with_band(text: &str, band: &str) -> String {
    let Some(life) = text
        .lines()
        .find(|line| line.starts_with(HEADING) || line.starts_with(LIFE_NOW))
    else {
        return text.to_owned();
    };
    let with = match life.split_once(" (") {
        Some((number, _)) if life.starts_with(HEADING) => format!("{number} ({band})"),
        _ => format!("{life}\n\n**{band} with what the mesh costs**"),
    };
    text.replacen(life, &with, 1)
}

/// Cautions that an audience reads.
const READ: usize = 2;

/// What moves and what that costs, each a heading; what takes the life, where, how often, and what to think of it.
fn lecture(frame: &Frame, caption: &str) -> String {
    let m = &frame.metrics;
    let mut text = String::with_capacity(512);
    let speeds = [-0.5, 0.5].map(|half| sig(m.entrainment_m_s * (1.0 + half * m.slide_roll), 3));
    // Writing to a string cannot fail.
    let _ = match caption {
        "" => {
            let (slide_roll, [one, two]) = (sig(m.slide_roll, 3), speeds);
            writeln!(
                text,
                "## S = {slide_roll}: body 1 {one}, body 2 {two} m/s\n"
            )
        }
        caption => writeln!(text, "## {caption}\n"),
    };
    if let Some(life) = &m.life {
        let [value, low, high] = [
            life.life_relative,
            life.life_relative_low,
            life.life_relative_high,
        ]
        .map(|v| sig(v, 3));
        let _ = writeln!(text, "{HEADING} {value} ({low} to {high})\n");
        let _ = writeln!(text, "### of the smooth contact's\n");
        let _ = writeln!(text, "{}\n", choices(life));
        let _ = writeln!(text, "{}", suffers(frame, life.detail.body));
    } else {
        let _ = writeln!(
            text,
            "# {} GPa\n\n### maximum pressure\n",
            sig(m.p_max_pa * 1e-9, 3)
        );
    }
    for caution in frame.cautions().iter().take(READ) {
        let _ = writeln!(text, "- {}", caution.text);
    }
    text
}

/// How often a point of the governing body is touched in a crossing, and where it suffers most.
fn suffers(frame: &Frame, body: u8) -> String {
    let m = &frame.metrics;
    let [formula, counted] = match body {
        1 => [m.n_body_1, m.n_counted_body_1],
        _ => [m.n_body_2, m.n_counted_body_2],
    };
    let mut text = String::new();
    if let Some(contacts) = counted.or(formula) {
        let by = if counted.is_some() {
            "counted"
        } else {
            "by the waves"
        };
        let contacts = sig(contacts, 3);
        let _ = writeln!(
            text,
            "- {contacts} contacts a crossing of its points ({by})"
        );
    }
    let damage = frame.damage[usize::from(body == 2)].as_ref();
    if let Some(damage) = damage.filter(|damage| damage.filled > 0) {
        let depth = sig(damage.pit_depth_m * 1e6, 3);
        let _ = writeln!(text, "- damage is greatest {depth} µm below its surface");
    }
    text
}

/// What takes the life of whom, and what other choices of count and model make of it.
fn choices(life: &LifeEstimate) -> String {
    let detail = &life.detail;
    let [low, high] = [detail.spread_low, detail.spread_high].map(|life| sig(life, 2));
    format!(
        "{}; body {} governs; choices of count and model {low} to {high}",
        life.cause().words(),
        detail.body
    )
}

/// Before the life in the lecture, and among the numbers.
const HEADING: &str = "# Life";
const LIFE_NOW: &str = "### Relative life";

fn now(frame: &Frame, caption: &str, above: &[AboveRange]) -> String {
    let m = &frame.metrics;
    let mut text = String::with_capacity(1024);
    if !caption.is_empty() {
        let _ = writeln!(text, "> {caption}\n");
    }
    if let Some(life) = &m.life {
        push_life(&mut text, life);
    }
    // The weightiest first; the last one holds for every run, and the numbers come before it.
    let cautions = frame.cautions();
    let always = |caution: &&Caution| caution.code == CautionCode::ElasticOnly;
    for caution in cautions.iter().filter(|caution| !always(caution)) {
        let _ = writeln!(text, "- {}", caution.text);
    }
    text.push('\n');
    push_table(&mut text, frame);
    for map in above {
        let maximum = sig(f64::from(map.beyond.maximum), 3);
        let _ = writeln!(
            text,
            "| above the colours | {}: {nodes}, up to {maximum} {} |",
            map.entity,
            map.unit,
            nodes = counted(map.beyond.above, "node")
        );
    }
    for caution in cautions.iter().filter(always) {
        let _ = writeln!(text, "\n{}", caution.text);
    }
    text
}

fn push_life(text: &mut String, life: &LifeEstimate) {
    let settled = if life.settled { "" } else { " *(not settled)*" };
    let [value, low, high, cycles, peaks, traction] = [
        life.life_relative,
        life.life_relative_low,
        life.life_relative_high,
        life.cycle_factor,
        life.peak_factor,
        life.traction_factor,
    ]
    .map(|value| sig(value, 3));
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "{LIFE_NOW} {value}{settled}\n\n{low} to {high}; cycles {cycles} × peaks {peaks} × traction {traction}\n"
    );
    let _ = writeln!(text, "{}\n", choices(life));
    if let (Some(global), Some(damage)) = (life.detail.life_global, life.detail.life_damage) {
        let [global, damage] = [global, damage].map(|life| sig(life, 3));
        let _ = writeln!(
            text,
            "by the count of Pu et al. (2016) {global}; counted by damage {damage}\n"
        );
    }
    if life.load_factor > 0.0 {
        let [factor, common] = [life.load_factor, life.life_common()].map(|value| sig(value, 3));
        let _ = writeln!(
            text,
            "× load {factor}, against the scene's load and speed: {common}\n"
        );
    }
}

fn push_table(text: &mut String, frame: &Frame) {
    let m = &frame.metrics;
    let unit = match frame.kind {
        ContactKind::Point => "N",
        ContactKind::Line => "N/m",
    };
    let mut row = |name: &str, value: String| {
        let _ = writeln!(text, "| {name} | {value} |");
    };
    let digits = |value: f64| sig(value, 4);
    let u = m.entrainment_m_s;
    let speeds = [-0.5, 0.5].map(|half| digits(u * (1.0 + half * m.slide_roll)));
    row(
        "time",
        format!("{}, passage {:.2}", seconds(frame.time_s), frame.passages),
    );
    row("---", "---".to_owned());
    row("S", towards(m.slide_roll, m.slide_roll_target, ""));
    row("U1, U2", format!("{} m/s", speeds.join(", ")));
    row("load", towards(m.load_n, m.load_target_n, unit));
    row(
        "p_Hertz, a",
        format!(
            "{} GPa, {} µm",
            digits(frame.p_hertz_pa * 1e-9),
            digits(frame.a_m * 1e6)
        ),
    );
    row("p_max", format!("{} GPa", digits(m.p_max_pa * 1e-9)));
    row(
        "h central, min",
        format!(
            "{}, {} nm",
            digits(m.h_central_m * 1e9),
            digits(m.h_min_m * 1e9)
        ),
    );
    let [area, load] = [m.contact_ratio, m.contact_load_ratio].map(|part| sig(100.0 * part, 3));
    row("contact", format!("{area} % of area, {load} % of load"));
    row("regime", m.regime.name().to_owned());
    let friction = sig(m.friction_coefficient, 3);
    // What is worn has a curve of its own (`ages.rs`).
    let lambda_of = frame.cycles.map_or("λ", |_| "λ when new");
    match m.lambda_ratio {
        Some(lambda) => row(
            &format!("friction, {lambda_of}"),
            format!("{friction}, {}", sig(lambda, 3)),
        ),
        None => row("friction", friction),
    }
    if let (Some(stress), Some(depth)) = (m.sigma_eff_max_pa, m.sigma_eff_max_depth_m) {
        let (stress, depth) = (digits(stress * 1e-9), sig(depth * 1e6, 3));
        row("σ_eff max", format!("{stress} GPa, {depth} µm deep"));
    }
    let formula = [m.n_body_1, m.n_body_2];
    if formula.iter().any(Option::is_some) {
        let pair = |n: [Option<f64>; 2]| n.map(|n| sig_or_dash(n, 3)).join(", ");
        let counted = pair([m.n_counted_body_1, m.n_counted_body_2]);
        row("n of 1, 2", format!("{}; counted {counted}", pair(formula)));
    }
    for quantity in by_itself() {
        if let Some(value) = quantity.number(frame) {
            row(quantity.symbol, quantity.in_words(value, frame.kind));
        }
    }
}

/// A knob's value, and where it goes while it moves.
fn towards(value: f64, target: f64, unit: &str) -> String {
    let [now, then] = [value, target].map(|value| sig(value, 4));
    let text = if now == then {
        format!("{now} {unit}")
    } else {
        format!("{now}, going to {then} {unit}")
    };
    text.trim_end().to_owned()
}

/// Something that happened, after so many knobs had been turned.
pub(crate) fn log_event(stream: &Stream, event: &RunEvent, turns: u64) {
    let (text, level) = match &event.kind {
        RunEventKind::Set { key, value, .. } => (
            format!("step {}: {key} set to {value}", event.step),
            TextLogLevel::INFO,
        ),
        RunEventKind::Caption(caption) => (caption.clone(), TextLogLevel::INFO),
        RunEventKind::NotConverged { residual } => (
            format!(
                "step {} did not converge: residual {}",
                event.step,
                sig(*residual, 3)
            ),
            TextLogLevel::WARN,
        ),
        RunEventKind::CutShort => (
            "the run was stopped before its end".to_owned(),
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
        let line = Note::Turn {
            n: turns,
            steps_made: *steps_made,
            key: key.clone(),
            value: *value,
            by: *by,
        };
        stream.log(COMMANDS, &TextLog::new(line.to_text()));
    }
    log_line(stream, &text, level);
}

/// A line of the log.
pub(crate) fn log_line(stream: &Stream, text: &str, level: &str) {
    stream.log(LOG, &TextLog::new(text).with_level(level));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_knob_that_rests_goes_nowhere() {
        assert_eq!(towards(0.5, 0.5, ""), "0.5000");
        assert_eq!(towards(0.5, 1.0, ""), "0.5000, going to 1.000");
        assert_eq!(towards(800.0, 800.0, "N"), "800.0 N");
        assert_eq!(towards(800.0, 900.0, "N"), "800.0, going to 900.0 N");
    }
}
