//! The top line: what runs, and the numbers that must be readable without help.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Line;

use crate::tui::app::{App, RunPace};
use crate::tui::dial::Dial;
use crate::tui::theme::Role;
use crate::tui::units::{sig, sig_or_dash};
use crate::tui::view::place::{columns, put, put_right, whole_words};
use crate::tui::wiring::Health;
use asperity_engine::physics::cycles::speed_ratios;
use asperity_engine::sim::{LubricationRegime, Stage, named};

pub(super) fn render(app: &App, area: Rect, buffer: &mut Buffer) {
    let theme = app.view.theme;
    let numbers = numbers(app, area.width);
    put_right(area, 0, &numbers, buffer);
    let room = area.width.saturating_sub(numbers.width() as u16 + 1);
    let (mark, word, role) = state(app);
    let mut left = Line::from(vec![
        theme.span(" asperity ", Role::Title),
        theme.span(format!("{mark}{word} "), role),
    ]);
    let free = usize::from(room).saturating_sub(left.width() + 1);
    let title = whole_words(&theme.words(title(app)), free);
    left.push_span(theme.span(title, Role::Dim));
    put(columns(area, 0, room), 0, &left, buffer);
}

/// The scene's title, which may hold numbers; where knobs are no longer what they were, by a key, the scene's script or in what
/// is replayed, its name, and which.
fn title(app: &App) -> String {
    let away = |dial: &&Dial| (dial.target - dial.home).abs() > 1e-6 * dial.home.abs();
    let changed = app
        .choice
        .dials
        .iter()
        .filter(|dial| away(dial) || dial.is_moving());
    let changed: Vec<&str> = changed.map(Dial::name).collect();
    if changed.is_empty() {
        return app.run.setup.scene.title.clone();
    }
    format!("{}, changed: {}", app.run.setup.name, changed.join(", "))
}

/// What the run does, as a shape, a word and a colour.
fn state(app: &App) -> (&'static str, String, Role) {
    let theme = app.view.theme;
    let (back, _) = app.rewound();
    if back > 0 {
        return (theme.pick("◀ ", "< "), format!("{back} back"), Role::Warn);
    }
    if app.replay.playing.is_some() && app.run.status.health == Health::Running {
        let word = if app.replay_stands() {
            "replay, held"
        } else {
            "replay"
        };
        return (theme.pick("↻ ", "@ "), word.into(), Role::Good);
    }
    match (&app.run.status.health, app.run.pace) {
        (Health::Failed(_), _) => (theme.pick("✖ ", "! "), "failed".into(), Role::Bad),
        (Health::Finished, _) => (theme.pick("■ ", "# "), "done".into(), Role::Good),
        (Health::Running, RunPace::Paused) => (theme.pick("‖ ", "= "), "paused".into(), Role::Warn),
        (Health::Running, RunPace::Running) => match app.frame().map(|frame| frame.stage) {
            Some(Stage::Passage) => (theme.pick("● ", "* "), "live".into(), Role::Good),
            Some(Stage::StartUp) | None => (theme.pick("○ ", "o "), "starting".into(), Role::Warn),
        },
    }
}

/// Columns from which specific sliding has room, too.
const ROOMY: u16 = 76;

fn numbers(app: &App, width: u16) -> Line<'static> {
    let theme = app.view.theme;
    let Some(frame) = app.frame() else {
        return Line::default();
    };
    let metrics = &frame.metrics;
    let p_hertz = app.view.units.show(const { named("p_hertz_pa") }, frame, 3);
    let n = match (metrics.n_body_1, metrics.n_body_2) {
        (Some(first), Some(second)) => sig(first.max(second), 3),
        _ => theme.pick("∞", "inf").to_owned(),
    };
    let lambda = if metrics.regime == LubricationRegime::Dry {
        "dry".to_owned()
    } else {
        sig_or_dash(app.lambda_ratio(frame), 2)
    };
    let mut pairs = vec![
        ("S", format!("{:.2}", metrics.slide_roll)),
        ("p_h", p_hertz),
        ("λ", lambda),
        ("n", n),
    ];
    if width >= ROOMY {
        let [u1, u2] = speed_ratios(metrics.slide_roll);
        let [first, second] = [u1, u2].map(|own| sig((u2 - u1).abs() / own.abs(), 2));
        pairs.splice(1..1, [("ζ₁", first), ("ζ₂", second)]);
    }
    let pairs = pairs.into_iter().flat_map(|(name, value)| {
        let name = theme.span(format!("{name} "), Role::Dim);
        [name, theme.span(format!("{value}  "), Role::Strong)]
    });
    pairs.collect()
}
