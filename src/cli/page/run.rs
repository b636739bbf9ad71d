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

/// The page of a recording: what each of its runs came to, with its last pictures.
pub(super) fn page(file: &Path) -> Result<Markup, Failure> {
    let read = RecordedFrames::read_all(file);
    let runs = read.map_err(|error| Failure::input(miette::miette!("{error}")))?;
    let titles: Vec<&str> = runs.iter().map(title).collect();
    let title = titles.join("; ");
    let steps: usize = runs.iter().map(RecordedFrames::n_steps).sum();
    let made = format!("{steps} steps of {}", file.display());
    let mut parts = Vec::new();
    for frames in &runs {
        super::super::export::tell_where_it_breaks_off(file, frames);
        parts.push(one(frames)?);
    }
    Ok(shell(
        &title,
        &made,
        &html! { @for part in &parts { (part) } },
    ))
}

fn title(run: &RecordedFrames) -> &str {
    match run.scene.title.as_str() {
        "" => "A run",
        title => title,
    }
}

/// One run; what stood beside it begins with what sets it apart from the others.
fn one(frames: &RecordedFrames) -> Result<Markup, Failure> {
    let step = frames.steps().last().map_or(0, |frame| frame.step);
    let drawn = pictures(frames)?;
    Ok(html! {
        (markdown(frames.text(step)))
        (figures(&drawn))
        h2 { "What runs" }
        (facts(&operating::rows(&frames.scene)))
    })
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
    // A name that nobody can have taken before; it goes with its files, however this ends.
    let folder = tempfile::tempdir().map_err(failed)?;
    let folder = folder.path();
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
    let export = Export::create(folder, Overwrite::Replace, &[Format::Svg])?;
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
    Ok(drawn)
}
