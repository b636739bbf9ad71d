//! The page of a recorded run.

use std::path::Path;
use std::sync::Arc;

use asperity_engine::observe::{Began, Observer as _, Overwrite, RunContext};
use asperity_picture::export::{Export, Format, PrintSize, TakenAs};
use asperity_recorder::RecordedFrames;
use maud::{Markup, PreEscaped, html};
use pulldown_cmark::html::push_html;
use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};

use super::super::failure::Failure;
use super::{facts, figures, operating, shell};

/// Pictures of the last step, in their order on the page.
const PICTURES: [&str; 6] = [
    "profile",
    "centre_line",
    "pressure",
    "film",
    "damage_1",
    "damage_2",
];

/// The page of a recording, of its last picture.
pub(super) fn page(file: &Path) -> Result<Markup, Failure> {
    let read = RecordedFrames::read_all(file);
    let mut runs = read.map_err(|error| Failure::input(miette::miette!("{error}")))?;
    let frames = runs.remove(0);
    super::super::export::tell_where_it_breaks_off(file, &frames);
    let step = frames.steps().last().map_or(0, |frame| frame.step);
    let drawn = pictures(&frames)?;
    let body = html! {
        (markdown(frames.text(step)))
        (figures(&drawn))
        h2 { "What runs" }
        (facts(&operating::rows(&frames.scene)))
    };
    let title = if frames.scene.title.is_empty() {
        "A run"
    } else {
        &frames.scene.title
    };
    let made = format!("{} steps of {}", frames.n_steps(), file.display());
    Ok(shell(title, &made, &body))
}

/// What stood beside a step, as HTML. It comes of a file: what it has of HTML itself is shown as it is written,
/// and its links lead nowhere.
fn markdown(text: &str) -> Markup {
    let parts = Parser::new_ext(text, Options::ENABLE_TABLES).filter_map(|part| match part {
        Event::Html(own) | Event::InlineHtml(own) => Some(Event::Text(own)),
        Event::Start(Tag::Link { .. } | Tag::Image { .. })
        | Event::End(TagEnd::Link | TagEnd::Image) => None,
        other => Some(other),
    });
    let mut page = String::new();
    push_html(&mut page, parts);
    PreEscaped(page)
}

/// The last picture of each kind that the recording has, as SVG.
fn pictures(frames: &RecordedFrames) -> Result<Vec<String>, Failure> {
    let Some(frame) = frames.whole().last().and_then(|step| frames.frame(*step)) else {
        return Ok(Vec::new());
    };
    let failed =
        |error: std::io::Error| Failure::input(miette::miette!("no room for pictures: {error}"));
    let folder = std::env::temp_dir().join(format!("asperity_report_{}", std::process::id()));
    let print = PrintSize {
        width_mm: 120.0,
        dpi: 150.0,
        font_pt: 7.0,
    };
    let names = PICTURES.map(str::to_owned);
    let context = RunContext {
        scene: Arc::clone(&frames.scene),
        scene_toml: frames.scene_toml.clone(),
        plan_text: String::new(),
        program: frames.program.clone(),
        began: Began::FromScene,
    };
    let export = Export::create(&folder, Overwrite::Replace, &[Format::Svg])?;
    let mut export = export.of(&names, print).alone(true);
    export.begin(&context)?;
    for before in frames.steps().take_while(|before| before.step < frame.step) {
        export.pass(0, &before);
    }
    export.take(&frame, TakenAs::Still)?;
    drop(export.finish()?);
    let mut drawn = Vec::new();
    for name in PICTURES {
        let path = folder.join(format!("step_{:06}_{name}.svg", frame.step));
        if path.exists() {
            drawn.push(std::fs::read_to_string(path).map_err(failed)?);
        }
    }
    std::fs::remove_dir_all(&folder).map_err(failed)?;
    Ok(drawn)
}
