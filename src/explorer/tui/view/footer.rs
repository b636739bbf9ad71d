//! The keys of the last line: what can be done now.

use ratatui::layout::{Position, Rect};
use ratatui::text::Line;

use crate::tui::action::Action;
use crate::tui::app::{App, ErrandKind, Overlay, PanelKind, RunPace};
use crate::tui::choice::Form;
use crate::tui::theme::Role;
use crate::tui::units::bytes;
use crate::tui::view::areas::Areas;
use crate::tui::view::place::{columns, rows_from};
use crate::tui::wiring::RecorderActivity;

/// A key of the last line: what it is called, and what it asks for.
pub(super) struct FooterKey {
    pub(super) key: &'static str,
    pub(super) word: String,
    action: Action,
}

impl FooterKey {
    fn new(key: &'static str, word: &str, action: Action) -> Self {
        let word = word.to_owned();
        Self { key, word, action }
    }

    /// Columns of the key with its word and the gap after it.
    fn width(&self) -> usize {
        self.key.chars().count() + self.word.chars().count() + 3
    }
}

/// The keys that fit, whole.
pub(super) fn hints_shown(app: &App, room: Rect) -> Vec<FooterKey> {
    let mut hints = hints(app);
    let taken: usize = hints.iter().map(FooterKey::width).sum();
    if !app.run.setup.left_out.is_empty() && app.choice.typing.is_none() {
        let free = usize::from(room.width).saturating_sub(taken);
        hints.push(FooterKey::new("i", &left_out(app, free), Action::Plan));
    }
    let mut free = usize::from(room.width);
    // What does not fit whole is not begun, and nothing after it.
    let fits = |hint: &FooterKey| {
        let fits = hint.width() <= free;
        free = free.saturating_sub(hint.width());
        fits
    };
    hints.into_iter().take_while(fits).collect()
}

/// A press on a key of the last line is that key.
pub(super) fn pressed(app: &App, areas: &Areas, at: Position) -> Option<Action> {
    let recorder = recorder(app).width() as u16 + 1;
    let last = rows_from(areas.status, areas.status.height.saturating_sub(1));
    let room = columns(last, 0, last.width.saturating_sub(recorder));
    if app.message().is_some() || !room.contains(at) {
        return None;
    }
    let mut end = room.x + 1;
    let mut hints = hints_shown(app, room).into_iter();
    let under = hints.find(|hint| {
        end += hint.width() as u16;
        at.x < end
    })?;
    Some(under.action)
}

/// What the plan leaves out: all of it where it fits, else how much.
fn left_out(app: &App, room: usize) -> String {
    let left_out = &app.run.setup.left_out;
    let stages: Vec<&str> = left_out.iter().map(|left| left.stage).collect();
    let all = app
        .view
        .theme
        .words(format!("not computed: {}", stages.join(", ")));
    if all.chars().count() + 4 <= room {
        all
    } else {
        format!("{} not computed", left_out.len())
    }
}

/// What can be done now: by what is open, asked, typed or large, and then by the panel that the keys speak of.
fn hints(app: &App) -> Vec<FooterKey> {
    let key = FooterKey::new;
    let enter = app.view.theme.pick("⏎", "Enter");
    if app.is_typing() {
        let leave = key("Esc", "leave it", Action::Close);
        return vec![key(enter, "set", Action::Enter), leave];
    }
    match app.view.overlay {
        Overlay::Lessons => {
            let close = key("t", "close", Action::Lessons);
            return vec![key(enter, "begin", Action::Enter), close];
        }
        Overlay::Scene => {
            let form = app.choice.draft.as_ref().map(|draft| draft.form);
            let other = match form {
                Some(Form::Point) => key("E", "as on drawings", Action::OperatingPoint),
                Some(Form::Drawing) => key("e", "scene", Action::Scene),
                Some(Form::Scene) | None => key("E", "operating point", Action::OperatingPoint),
            };
            return vec![
                key(enter, "run it", Action::Enter),
                key("=", "type", Action::Type),
                other,
                key("Esc", "close", Action::Close),
            ];
        }
        Overlay::Help | Overlay::Plan => return vec![key("Esc", "close", Action::Close)],
        Overlay::None => {}
    }
    let mut hints = vec![key("?", "keys", Action::Help)];
    // A page is closed as pages are, and has buttons for the lessons.
    if !app.is_page() {
        hints.push(key("q", "quit", Action::Quit));
    }
    if app.lesson.tour.is_some() && !app.is_page() {
        hints.push(key("n", "go on", Action::NextBeat));
        hints.push(key("N", "back", Action::PreviousBeat));
        hints.push(key("T", "end lesson", Action::EndTour));
    }
    if app.view.enlarged.is_some() {
        hints.push(key("Esc", "all panels", Action::Close));
    }
    let pause = match (&app.replay.playing, app.run.pace) {
        (Some(_), _) => key("o", "live", Action::Replay),
        (None, RunPace::Paused) => key("space", "go on", Action::TogglePause),
        (None, RunPace::Running) => key("space", "pause", Action::TogglePause),
    };
    let pin = match app.view.pinned {
        Some(_) => "release",
        None => "freeze",
    };
    let own = match app.view.focus {
        PanelKind::Knobs => key("=", "type", Action::Type),
        PanelKind::Map => key("m", "map", Action::NextMap),
        PanelKind::CentreLine => key("z", "zoom", Action::Zoom),
        PanelKind::Life => key("y", "curve", Action::Curve),
        PanelKind::Point => key("p", "trace", Action::PointQuantity),
    };
    hints.extend([pause, key("b", pin, Action::Pin), own]);
    if app.lesson.tour.is_none() {
        hints.push(key("t", "lessons", Action::Lessons));
        hints.push(key("e", "scene", Action::Scene));
    }
    if app.offers(ErrandKind::Record) {
        hints.push(key("r", "record", Action::Record));
    }
    hints
}

pub(super) fn recorder(app: &App) -> Line<'static> {
    let theme = app.view.theme;
    let Some(recorder) = &app.run.status.recorder else {
        if app.is_page() {
            return Line::default();
        }
        return theme.line("not recording ", Role::Dim);
    };
    let (word, role) = match recorder.activity {
        RecorderActivity::Recording => (theme.pick("● rec ", "* rec "), Role::Pressure),
        RecorderActivity::Paused => (theme.pick("‖ rec paused ", "= rec paused "), Role::Warn),
        RecorderActivity::Stopped => (theme.pick("■ rec stopped ", "# rec stopped "), Role::Bad),
    };
    let skipped = match recorder.skipped {
        0 => String::new(),
        skipped => format!("{skipped} skipped "),
    };
    let written = bytes(recorder.bytes);
    let words = format!("{written} {} frames {skipped}", recorder.frames);
    Line::from(vec![theme.span(word, role), theme.span(words, Role::Dim)])
}
