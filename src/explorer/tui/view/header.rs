//! The top line: what runs, and the numbers that must be readable without help.

use ratatui::layout::Rect;
use ratatui::text::Line;

use crate::tui::app::{App, RunPace};
use crate::tui::dial::Dial;
use crate::tui::theme::Role;
use crate::tui::units::{sig, sig_or_dash};
use crate::tui::view::sheet::{Sheet, with_columns};
use crate::tui::wiring::Health;
use asperity_engine::physics::estimate::speed_ratios;
use asperity_engine::sim::{LubricationRegime, Stage, named};

pub(super) fn render(app: &App, area: Rect, sheet: &mut Sheet<'_>) {
    let theme = app.view.theme;
    let numbers = numbers(app, area.width);
    sheet.line_right(area, 0, &numbers);
    let room = area.width.saturating_sub(numbers.width() as u16 + 1);
    let (mark, word, role) = state(app);
    let mut left = Line::from(vec![
        theme.span(" asperity ", Role::Title),
        theme.span(format!("{mark}{word} "), role),
    ]);
    let title = theme.text(&title(app));
    let title = whole_words(&title, usize::from(room).saturating_sub(left.width() + 1));
    left.push_span(theme.span(&title, Role::Dim));
    sheet.line(with_columns(area, area.x, room), 0, &left);
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

/// As many whole words as fit, and a sign that there are more.
fn whole_words(text: &str, room: usize) -> String {
    if text.chars().count() <= room {
        return text.to_owned();
    }
    let mut kept = String::new();
    for word in text.split_inclusive(' ') {
        // Three columns for the dots where there are no others.
        if kept.chars().count() + word.trim_end().chars().count() + 3 > room {
            break;
        }
        kept.push_str(word);
    }
    let kept = kept.trim_end_matches([' ', ',', ':']);
    if kept.is_empty() {
        String::new()
    } else {
        format!("{kept}…")
    }
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
            "replay, paused"
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
            _ => (theme.pick("○ ", "o "), "starting".into(), Role::Warn),
        },
    }
}

/// Columns from which specific sliding has room, too.
const ROOMY: u16 = 76;

fn numbers(app: &App, columns: u16) -> Line<'static> {
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
        sig_or_dash(metrics.lambda_ratio, 2)
    };
    let mut pairs = vec![
        ("S", format!("{:.2}", metrics.slide_roll), Role::Strong),
        ("p_h", p_hertz, Role::Strong),
        ("λ", lambda, Role::Strong),
        ("n", n, Role::Strong),
    ];
    if columns >= ROOMY {
        let (u1, u2) = speed_ratios(metrics.slide_roll);
        let specific = [u1, u2].map(|own| sig((u2 - u1).abs() / own.abs(), 2));
        pairs.insert(1, ("ζ", specific.join(" "), Role::Strong));
    }
    let mut spans = Vec::new();
    for (name, value, role) in pairs {
        spans.push(theme.span(format!("{} ", theme.text(name)), Role::Dim));
        spans.push(theme.span(format!("{}  ", theme.text(&value)), role));
    }
    Line::from(spans)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn titles_are_cut_between_words() {
        let title = "Two rough rollers, sliding";
        let table = [
            (26, title),
            (25, "Two rough rollers…"),
            (14, "Two rough…"),
            (6, "Two…"),
            (4, ""),
        ];
        for (room, cut) in table {
            assert_eq!(whole_words(title, room), cut, "{room}");
        }
    }
}
