//! Under the top line: what a lesson, or the scene's script, says now.

use ratatui::buffer::Buffer;
use ratatui::layout::{Margin, Position, Rect};
use ratatui::style::{Color, Style};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Paragraph, Widget, Wrap};

use asperity_engine::scene::Knob;

use crate::tui::action::Action;
use crate::tui::app::App;
use crate::tui::lessons::{Beat, Claim, FoundAnswer, LessonQuestion, TourPhase, TourState};
use crate::tui::theme::Role;
use crate::tui::view::areas::Areas;
use crate::tui::view::chart::Symbol;
use crate::tui::view::place::{columns, put, put_right, rows_from};

/// What the title's line offers: words, and what a press on them does.
type Hint = (&'static str, Option<Action>);

const ASKS: [Hint; 2] = [(" 1-9 answer ", None), (" n show ", Some(Action::NextBeat))];
const GOES_ON: [Hint; 3] = [
    (" n on ", Some(Action::NextBeat)),
    (" N back ", Some(Action::PreviousBeat)),
    (" T ends ", Some(Action::EndTour)),
];

/// Between an answer and its number, where no line breaks.
const TIE: char = '\u{a0}';

/// Before each of the figures.
const GAP: &str = "   ";

/// After a question, until what it asks for has been simulated.
const WAITS: &str = "The verdict comes as soon as that is simulated.";

/// Words to show.
pub(super) struct Caption {
    title: String,
    /// The title where the figures leave no room for it.
    brief: String,
    /// Words with their roles, one after the other.
    words: Vec<(String, Role)>,
    hints: &'static [Hint],
    /// The numbers that the words speak of, as they are now.
    figures: String,
    /// Letters of the longest text of a lesson, so that the screen keeps its shape from beat to beat.
    longest: usize,
}

impl Caption {
    /// Rows that it takes on a screen of that width, title included.
    pub(super) fn rows(&self, screen_width: u16) -> u16 {
        // Lines break at words, which leaves up to some ten columns empty.
        let room = screen_width.saturating_sub(4 + 10).max(20);
        1 + (self.longest as u16).div_ceil(room)
    }
}

/// What is to be said, if anything.
pub(super) fn of(app: &App) -> Option<Caption> {
    if let Some(tour) = &app.lesson.tour {
        let lesson = &tour.lesson;
        let figures = match tour.phase {
            TourPhase::Asks => String::new(),
            TourPhase::Shows | TourPhase::Tells(_) => figures(app, tour),
        };
        let place = format!("{}/{}", tour.place + 1, app.lesson.all.len());
        let beat = format!("({}/{})", tour.beat + 1, lesson.beats.len());
        return Some(Caption {
            title: format!("{place} {} {beat}", lesson.title),
            brief: format!("{place} {beat}"),
            words: words(app, tour),
            hints: match tour.phase {
                TourPhase::Asks => &ASKS,
                TourPhase::Shows | TourPhase::Tells(_) => &GOES_ON,
            },
            figures,
            longest: lesson.beats.iter().map(letters).max().unwrap_or(0),
        });
    }
    let (title, text) = match scripted(app) {
        Some(text) => ("the scene says", text),
        None if is_to_begin(app) => ("to begin", BEGIN),
        None => return None,
    };
    Some(Caption {
        title: title.to_owned(),
        brief: title.to_owned(),
        words: vec![(text.to_owned(), Role::Text)],
        hints: &[],
        figures: String::new(),
        longest: text.chars().count(),
    })
}

/// What a page writes in its own letters in place of the caption's lines.
pub struct CaptionWords {
    /// Whether a lesson says it, which goes on and back.
    pub is_lesson: bool,
    /// Lesson and beat, or who says it.
    pub title: String,
    /// The question, or what is shown or told.
    pub words: String,
    /// The numbers that the words speak of, as they are now.
    pub figures: String,
    /// What answers the question; empty: nothing is asked.
    pub answers: Vec<String>,
}

/// The same; `None`: there is nothing to say.
pub(super) fn in_words(app: &App) -> Option<CaptionWords> {
    let caption = of(app)?;
    let tour = app.lesson.tour.as_ref();
    let asked = tour.filter(|tour| tour.phase == TourPhase::Asks);
    let asked = asked.and_then(|tour| tour.beat().question.as_ref());
    let all = caption.words.iter().map(|(text, _)| text.as_str());
    let words = asked.map_or_else(
        || all.collect::<Vec<_>>().join(" "),
        |question| question.ask.clone(),
    );
    Some(CaptionWords {
        is_lesson: tour.is_some(),
        title: caption.title,
        words,
        figures: caption.figures.trim().to_owned(),
        answers: asked.map_or_else(Vec::new, |question| question.answers.clone()),
    })
}

/// What one turns first.
const BEGIN: &str = "S = 0: both surfaces roll, in step. Press \u{2192}, which turns S, to let them slide past each other, and watch the life.";

/// Whether a scene begins with rolling, and nobody has turned anything yet.
fn is_to_begin(app: &App) -> bool {
    let scene = &app.run.setup.scene;
    scene.life.is_some()
        && scene.motion.slide_roll == 0.0
        && app.target(Knob::SlideRoll) == 0.0
        && !app.was_turned()
}

/// The question with its answers, what to look at, or what was found.
fn words(app: &App, tour: &TourState) -> Vec<(String, Role)> {
    let beat = tour.beat();
    let caption = || vec![(beat.caption.clone(), Role::Text)];
    let Some(question) = &beat.question else {
        return caption();
    };
    match tour.phase {
        TourPhase::Shows => {
            let mut words = caption();
            words.push((WAITS.to_owned(), Role::Warn));
            words
        }
        TourPhase::Asks => {
            let mut words = vec![(question.ask.clone(), Role::Strong)];
            for (place, answer) in question.answers.iter().enumerate() {
                words.push((format!(" {}{TIE}", place + 1), Role::Key));
                words.push((answer.clone(), Role::Text));
            }
            words
        }
        TourPhase::Tells(FoundAnswer {
            turned: Some(knob), ..
        }) => vec![(
            format!(
                "No verdict: {knob} was turned meanwhile, and this is another experiment. N asks again."
            ),
            Role::Warn,
        )],
        TourPhase::Tells(found) => {
            let (verdict, role) = verdict(app, tour, question, found);
            let because = (question.because.clone(), Role::Text);
            vec![(verdict, role), because]
        }
    }
}

/// `You said "once"; it is 9.8: "some ten times".`
fn verdict(
    app: &App,
    tour: &TourState,
    question: &LessonQuestion,
    found: FoundAnswer,
) -> (String, Role) {
    let (Some(frame), Some(right)) = (app.frame(), found.right) else {
        return ("This scene does not know it.".to_owned(), Role::Warn);
    };
    let value = question.measure.shown(found.value, app.view.units, frame);
    let name = question.measure.symbol();
    let answer = |place: usize| question.answers.get(place).map_or("", String::as_str);
    let is = format!("{name} {value}, \u{201c}{}\u{201d}.", answer(right));
    match tour.said {
        Some(said) if said == right => (format!("Right: {is}"), Role::Good),
        Some(said) => {
            let said = answer(said);
            let text = format!("You said \u{201c}{said}\u{201d}; it is {is}");
            (text, Role::Warn)
        }
        None => (format!("It is {is}"), Role::Strong),
    }
}

/// `n₁ 14.0  counted₁ 13.1`.
fn figures(app: &App, tour: &TourState) -> String {
    let Some(frame) = app.frame() else {
        return String::new();
    };
    let shown = |claim: &Claim| {
        let value = claim.measure.value(frame, tour.before.as_deref());
        let value = claim.measure.shown(value, app.view.units, frame);
        format!("{GAP}{} {value}", claim.measure.symbol())
    };
    tour.beat().claims.iter().map(shown).collect()
}

/// Letters of the longest that a beat says.
fn letters(beat: &Beat) -> usize {
    let waits = beat.question.as_ref().map_or(0, |_| WAITS.len() + 1);
    let caption = beat.caption.chars().count() + waits;
    let asked = beat.question.as_ref().map_or(0, |question| {
        let answers = question.answers.iter();
        let answers = answers.map(|answer| answer.chars().count() + 4);
        question.ask.chars().count() + answers.sum::<usize>()
    });
    let told = beat.question.as_ref().map_or(0, |question| {
        /// Two answers and a number at most.
        const VERDICT: usize = 90;
        question.because.chars().count() + VERDICT
    });
    caption.max(asked).max(told)
}

/// The caption of the last scripted event, while it is fresh (half a passage).
fn scripted(app: &App) -> Option<&str> {
    let frame = app.frame()?;
    let fresh_s = 2.0 * frame.a_m / frame.metrics.entrainment_m_s.abs().max(1e-9);
    app.run
        .setup
        .scene
        .events
        .iter()
        .filter(|event| !event.caption.is_empty())
        .rfind(|event| (event.at_s..event.at_s + fresh_s).contains(&frame.time_s))
        .map(|event| event.caption.as_str())
}

pub(super) fn render(app: &App, caption: &Caption, area: Rect, buffer: &mut Buffer) {
    let theme = app.view.theme;
    let edge = Symbol::new(theme, "▌", "|", Role::Key);
    area.rows()
        .for_each(|row| edge.draw(row.as_position(), buffer));
    let text = area.inner(Margin::new(2, 0));
    let hint = theme.line(hint(caption), Role::Dim);
    let beside = columns(text, 0, text.width.saturating_sub(hint.width() as u16));
    let titled = |title: &str, figures: &str| {
        let figures = theme.span(figures, Role::Strong);
        Line::from(vec![theme.span(title, Role::Key), figures])
    };
    let is_wide = |line: &Line| line.width() > usize::from(beside.width);
    let mut figures = &caption.figures[..];
    let mut line = titled(&caption.title, figures);
    while is_wide(&line) && !figures.is_empty() {
        line = titled(&caption.brief, figures);
        // A number that is cut is another number.
        if is_wide(&line) {
            figures = figures.rfind(GAP).map_or("", |at| &figures[..at]);
        }
    }
    put(beside, 0, &line, buffer);
    put_right(text, 0, &hint, buffer);
    let words = caption.words.iter().map(|(text, role)| match role {
        Role::Text => Span::raw(theme.words(text)),
        role => theme.span(text, *role),
    });
    wrapped(words, rows_from(text, 1), buffer);
}

fn hint(caption: &Caption) -> String {
    caption.hints.iter().map(|(words, _)| *words).collect()
}

/// Draws words one after the other, broken between words.
fn wrapped<'a>(words: impl Iterator<Item = Span<'a>>, area: Rect, buffer: &mut Buffer) {
    let words = words.flat_map(|span| {
        let gap = if span.content.ends_with(TIE) { "" } else { " " };
        [span, Span::raw(gap)]
    });
    let words = Paragraph::new(words.collect::<Line<'_>>()).wrap(Wrap { trim: true });
    words.render(area, buffer);
    for at in area.positions() {
        if buffer[at].symbol().starts_with(TIE) {
            buffer[at].set_symbol(" ");
        }
    }
}

/// A press on what the title's line offers, or on an answer.
pub(super) fn pressed(app: &App, areas: &Areas, at: Position) -> Option<Action> {
    let area = areas.caption.inner(Margin::new(2, 0));
    let caption = of(app).filter(|_| area.contains(at))?;
    if at.y == area.y {
        let from_end = area.right() - at.x;
        let mut left = hint(&caption).chars().count() as u16;
        let mut hints = caption.hints.iter();
        let under = hints.find(|(words, _)| {
            let end = left;
            left = left.saturating_sub(words.chars().count() as u16);
            (left + 1..=end).contains(&from_end)
        });
        return under?.1;
    }
    let tour = app.lesson.tour.as_ref()?;
    (tour.phase == TourPhase::Asks).then_some(())?;
    // As it is drawn, each word with the number of its answer for a colour: the first is the question.
    let numbered = caption.words.iter().enumerate().map(|(place, (text, _))| {
        let answer = Color::Indexed(place.div_ceil(2) as u8);
        Span::styled(app.view.theme.words(text), Style::new().fg(answer))
    });
    let mut drawn = Buffer::empty(area);
    wrapped(numbered, rows_from(area, 1), &mut drawn);
    match drawn[at].fg {
        Color::Indexed(answer @ 1..) => Some(Action::Typical(usize::from(answer) - 1)),
        _ => None,
    }
}
