//! `asperity report`: one page for a browser and a printer, of a sweep or of a recorded run.

mod operating;
#[cfg(feature = "rerun")]
mod run;
mod sweep;

use std::path::Path;

use asperity_engine::observe::Overwrite;
use asperity_session::program::VERSION;
use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::args::ReportArgs;
use super::failure::Failure;

/// Of the page: what a printer takes, and light paper in every theme.
const STYLE: &str = "
@page { size: A4; margin: 14mm }
body { font: 11pt/1.4 system-ui, sans-serif; color: #16181d; background: #fff; max-width: 62rem; margin: 2rem auto; padding: 0 1rem }
h1 { font-size: 1.5rem; margin: 0 } h2 { font-size: 1.1rem; margin: 1.6rem 0 .4rem; border-bottom: 1px solid #c9ccd2 }
p.sub { color: #565b66; margin: .2rem 0 1rem } p.head { margin: .2rem 0 } p.head b { display: inline-block; min-width: 6.5rem }
table { border-collapse: collapse; font-size: .8rem; font-variant-numeric: tabular-nums; margin: .3rem 0 }
th, td { padding: .15rem .45rem; text-align: right; border-bottom: 1px solid #e3e5e9; vertical-align: bottom }
th:first-child, td:first-child, table.words td { text-align: left } table.words td { vertical-align: top }
td { white-space: nowrap } table.words td { white-space: normal } th small { font-weight: normal; color: #565b66 } tr.worst td { background: #fdecea }
div.wide { overflow-x: auto } div.figures { display: grid; grid-template-columns: 1fr 1fr; gap: .6rem }
div.figures figure { margin: 0 } svg { width: 100%; height: auto } pre { white-space: pre-wrap; font-size: .8rem }
li { margin: .15rem 0 } h2, figure, tr { break-inside: avoid } h2 { break-after: avoid }
@media print { body { margin: 0; max-width: none; font-size: 9pt } table { font-size: 6.6pt } th, td { padding: .1rem .22rem } div.wide { overflow: visible } }
";

/// Makes the page and says where it is.
pub(crate) fn report(args: &ReportArgs) -> Result<u8, Failure> {
    let (page, usual) = if args.of.is_dir() {
        (sweep::page(&args.of)?, args.of.join("report.html"))
    } else {
        (of_run(&args.of)?, args.of.with_extension("html"))
    };
    let out = args.out.clone().unwrap_or(usual);
    // A sweep's own report is its own to replace.
    let overwrite = Overwrite::from_force(args.force || (args.out.is_none() && args.of.is_dir()));
    overwrite
        .claim(&out)?
        .write(page.into_string().as_bytes())?;
    super::scenes::print(&format!("report    {}\n", out.display()))?;
    Ok(0)
}

#[cfg(feature = "rerun")]
fn of_run(file: &Path) -> Result<Markup, Failure> {
    run::page(file)
}

#[cfg(not(feature = "rerun"))]
fn of_run(_: &Path) -> Result<Markup, Failure> {
    Err(Failure::without_recorder("reads no recordings"))
}

/// A page of that title. `made`: by what, of what.
fn shell(title: &str, made: &str, body: &Markup) -> Markup {
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                h1 { (title) }
                p.sub { (made) " · asperity " (VERSION) }
                (body)
            }
        }
    }
}

/// Pairs of a name and what there is to say.
fn facts(rows: &[(String, String)]) -> Markup {
    html! {
        table.words {
            @for (name, what) in rows {
                tr { td { b { (name) } } td { (what) } }
            }
        }
    }
}

/// Pictures, SVG each.
fn figures(pictures: &[String]) -> Markup {
    html! {
        div.figures {
            @for svg in pictures {
                figure { (PreEscaped(in_html(svg))) }
            }
        }
    }
}

/// An SVG as a part of a page: without what only a file of its own has.
fn in_html(svg: &str) -> &str {
    svg.find("<svg").map_or("", |at| &svg[at..])
}
