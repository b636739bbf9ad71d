//! Last lines: where the run is, how well it converges, what is left out, what is recorded.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Span;

use crate::tui::app::{App, Trouble, WhyUnconverged};
use crate::tui::theme::Role;
use crate::tui::units::{seconds, sig};
use crate::tui::view::areas::{Areas, PanelSpacing};
use crate::tui::view::footer::{hints_shown, recorder};
use crate::tui::view::panel::led;
use crate::tui::view::place::{columns, columns_from, fitted, put, put_right};
use crate::tui::view::{knobs, overlay};
use asperity_engine::scene::CycleBasis;
use asperity_engine::sim::{
    CATALOGUE, Frame, LubricationRegime, Metrics, Quantity, Reading, Rhythm, Stage, named,
};
use asperity_session::run::Assumed;
use asperity_session::sweep::{Along, Varied};

/// Words and their roles, in the order in which they are dropped from the right.
type StatusWords = Vec<(String, Role)>;

pub(super) fn render(app: &App, areas: &Areas, buffer: &mut Buffer) {
    let area = areas.status;
    let mut row = 0;
    if let Some(why) = app.why() {
        let text = why.in_columns(usize::from(area.width) - 2);
        let role = led(why.of, Role::Strong);
        let line = app.view.theme.line(format!(" {text}"), role);
        put(area, row, &line, buffer);
        row += 1;
    }
    if let Some(frame) = app.frame() {
        let mut words = progress(app, frame);
        if areas.density == PanelSpacing::Full || area.height > row + 2 {
            write(app, area, row, &words, buffer);
            row += 1;
            words = quality(app, frame);
        } else if app.trouble().is_none() {
            words.extend(quality(app, frame));
        } else {
            // What is wrong stands first: the rest may not fit.
            words = quality(app, frame).into_iter().chain(words).collect();
        }
        write(app, area, row, &words, buffer);
        row += 1;
    }
    let last = area.height - 1;
    if row <= last {
        last_line(app, area, last, buffer);
    }
}

fn write(app: &App, area: Rect, row: u16, words: &StatusWords, buffer: &mut Buffer) {
    let gap = Span::raw("  ");
    let words = words
        .iter()
        .flat_map(|(text, role)| [app.view.theme.span(text, *role), gap.clone()]);
    let room = columns_from(area, 1);
    put(room, row, &fitted(words, room.width), buffer);
}

fn progress(app: &App, frame: &Frame) -> StatusWords {
    if frame.stage == Stage::StartUp {
        let share = (100.0 * frame.start_up).floor();
        let what = match app.run.setup.scene.lubricant {
            Some(_) => "film",
            None => "contact",
        };
        let how = format!("smooth {what} on finer and finer grids, then roughness");
        let share = format!("start-up {share:.0} %");
        return vec![(share, Role::Warn), (how, Role::Text)];
    }
    let mut words = Vec::new();
    if let Some((nodes, done)) = app.run.status.finer {
        let percent = (100.0 * done).floor();
        let mesh = app.run.setup.scene.kind().mesh(nodes);
        words.push((format!("{mesh} {percent:.0} %"), Role::Warn));
    }
    words.extend([
        (format!("passage {:.2}", frame.passages), Role::Text),
        (format!("step {}", frame.step), Role::Text),
    ]);
    if let Some(body) = knobs::standing(frame.metrics.slide_roll) {
        let means = match app.run.setup.scene.life.as_ref().map(|life| life.cycles) {
            Some(CycleBasis::Damage) => ": its cycles never end",
            Some(CycleBasis::Global | CycleBasis::Peaks) => ": its life is not counted",
            None => "",
        };
        words.push((format!("body {body} stands{means}"), Role::Warn));
    }
    // While a finer mesh is on its way, no step is shown.
    let rate = app.steps_per_s();
    if let Some(rate) = rate.filter(|_| app.run.status.finer.is_none()) {
        words.push((format!("{} steps/s", sig(rate, 2)), Role::Text));
    }
    words.push((format!("t {}", seconds(frame.time_s)), Role::Text));
    if let Some(repeat) = frame.metrics.repeat.filter(|repeat| repeat.repeats) {
        let what = match repeat.rhythm {
            Rhythm::Steady => "steady".to_owned(),
            Rhythm::Orbit => format!("repeats every {}", seconds(repeat.period_s)),
            Rhythm::Statistics => "means settled".to_owned(),
        };
        words.push((what, Role::Good));
    }
    if let Some(replay) = &app.replay.playing {
        let speed = format!("replayed at 1/{} of its speed", sig(1.0 / replay.rate(), 2));
        words.push((speed, Role::Text));
    }
    if let Some((done, all)) = app.lives.sweep {
        let along = swept(app.lives.sweeping);
        words.push((format!("sweeping {along} {done}/{all}"), Role::Warn));
    }
    words
}

fn quality(app: &App, frame: &Frame) -> StatusWords {
    let metrics = &frame.metrics;
    let trouble = app.trouble();
    let residual = match trouble {
        None => (format!("residual {:.0e}", metrics.residual), Role::Text),
        Some(trouble) => (not_converged(app, trouble), Role::Bad),
    };
    let (regime, role) = regime(metrics);
    let lambda = app
        .lambda_ratio(frame)
        .map_or_else(String::new, |lambda| format!(" λ {}", sig(lambda, 2)));
    let shown = |word: &str, quantity: &Quantity, digits: i32, role: Role| {
        let value = app.view.units.show(quantity, frame, digits);
        (format!("{word} {value}"), role)
    };
    let mut words = vec![
        residual,
        (format!("{regime}{lambda}"), role),
        shown("contact", const { named("contact_ratio") }, 2, Role::Text),
        (format!("load err {}", tiny(metrics.load_error)), Role::Dim),
        (format!("mass err {}", tiny(metrics.mass_error)), Role::Dim),
        shown("µ", const { named("friction_coefficient") }, 2, Role::Text),
        shown("p max", const { named("p_max_pa") }, 3, Role::Pressure),
        shown("h min", const { named("h_min_m") }, 2, Role::Film),
    ];
    let by_itself = (CATALOGUE.iter())
        .filter(|quantity| quantity.by_itself && quantity.read(frame) != Reading::Unknown);
    words.extend(by_itself.map(|quantity| shown(quantity.symbol, quantity, 2, Role::Text)));
    if let Some(errors) = metrics.errors {
        let share = sig(100.0 * errors.h_central, 2);
        words.push((format!("mesh ±{share} % of h"), Role::Dim));
    }
    if trouble.is_some() {
        // A failure stands first.
        words.truncate(4);
    }
    words
}

/// Which step did not converge, and why.
fn not_converged(app: &App, trouble: Trouble) -> String {
    let why = match trouble.what {
        WhyUnconverged::Pressure(residual, retries) => {
            format!("residual {residual:.1e} after {retries} retries")
        }
        WhyUnconverged::Film(part) => format!("{part:.1e} of the film not balanced"),
        WhyUnconverged::Overlap(overlap_m) => {
            let overlap = app.view.units.film().show(overlap_m, 2);
            // A load turned by hand keeps the domain of the run's start; started anew the scene has one of its own.
            format!("surfaces overlap by {overlap}; e, Enter: wider domain")
        }
    };
    format!(" STEP {} NOT CONVERGED: {why} ", trouble.step)
}

/// The letter of what a sweep goes along.
fn swept(varied: Varied) -> &'static str {
    match varied {
        Varied::Along(Along::SlideRoll) => "S",
        Varied::Along(Along::Entrainment) => "U",
        Varied::Assumed(Assumed::Phase) => "phases",
        Varied::Assumed(Assumed::OilLaw) => "laws of the oil",
    }
}

/// A small number by its power of ten.
fn tiny(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    format!("{value:.0e}")
}

/// Who carries the load, and how good that is.
fn regime(metrics: &Metrics) -> (&'static str, Role) {
    let role = match metrics.regime {
        LubricationRegime::FullFilm => Role::Good,
        LubricationRegime::Mixed => Role::Warn,
        LubricationRegime::Boundary | LubricationRegime::Dry => Role::Bad,
    };
    (metrics.regime.name(), role)
}

fn last_line(app: &App, area: Rect, row: u16, buffer: &mut Buffer) {
    let theme = app.view.theme;
    let recorder = recorder(app);
    let room = columns(
        area,
        0,
        area.width.saturating_sub(recorder.width() as u16 + 1),
    );
    put_right(area, row, &recorder, buffer);
    if let Some(typed) = app.typing_line() {
        put(
            room,
            row,
            &theme.line(format!(" {typed}"), Role::Chosen),
            buffer,
        );
        return;
    }
    if let Some(message) = app.message() {
        // A longer one is laid over the panels above.
        if one_line(message, room.width) {
            put(
                room,
                row,
                &theme.line(format!(" {message}"), Role::Warn),
                buffer,
            );
        }
        return;
    }
    let hints = hints_shown(app, room).into_iter();
    let spans = hints.flat_map(|hint| {
        let word = theme.span(format!(" {}  ", hint.word), Role::Dim);
        [theme.span(hint.key, Role::Key), word]
    });
    let line = spans.collect();
    put(columns_from(room, 1), row, &line, buffer);
}

fn one_line(message: &str, columns: u16) -> bool {
    !message.contains('\n') && message.chars().count() < usize::from(columns)
}

/// A message that the last line cannot hold, whole, above it; gives the rows that it lies over.
pub(super) fn message(app: &App, areas: &Areas, screen: Rect, buffer: &mut Buffer) -> Option<Rect> {
    let message = app.message()?;
    let recorder = recorder(app).width() as u16 + 1;
    if one_line(message, areas.status.width.saturating_sub(recorder)) {
        return None;
    }
    Some(overlay::message(app, message, screen, buffer))
}
