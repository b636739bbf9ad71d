//! Under the top line: what a lesson, or the scene's script, says now.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Paragraph, Widget, Wrap};

use crate::tui::app::App;
use crate::tui::lessons::{Beat, Claim, LESSONS};
use crate::tui::theme::Role;
use crate::tui::units::sig_or_dash;
use crate::tui::view::{ascii_text, put, put_right};

/// Words to show.
pub(super) struct Caption<'a> {
    title: String,
    text: &'a str,
    hint: &'static str,
    /// The numbers that the words speak of, as they are now.
    figures: String,
    /// Letters of the longest text of a lesson, so that the screen keeps its shape from beat to beat.
    longest: usize,
}

impl Caption<'_> {
    /// Rows that it takes on a screen of that width, title included.
    pub(super) fn rows(&self, screen_width: u16) -> u16 {
        // Lines break at words, which leaves up to some ten columns empty.
        let room = screen_width.saturating_sub(4 + 10).max(20);
        1 + (self.longest as u16).div_ceil(room)
    }
}

/// What is to be said, if anything.
pub(super) fn of(app: &App) -> Option<Caption<'_>> {
    if let Some(tour) = app.tour {
        return Some(Caption {
            title: format!(
                "{}/{} {} ({}/{})",
                tour.lesson + 1,
                LESSONS.len(),
                tour.lesson().title,
                tour.beat + 1,
                tour.lesson().beats.len()
            ),
            text: tour.beat().caption,
            hint: " n next  t ends ",
            figures: figures(app, tour.beat().claims),
            longest: longest(tour.lesson().beats),
        });
    }
    scripted(app).map(|text| Caption {
        title: "the scene says".to_owned(),
        text,
        hint: "",
        figures: String::new(),
        longest: text.chars().count(),
    })
}

/// `n₁ 14.0  counted₁ 13.1`.
fn figures(app: &App, claims: &[Claim]) -> String {
    let Some(frame) = app.frame() else {
        return String::new();
    };
    let shown = |claim: &Claim| {
        let value = claim.figure.of(frame);
        format!("   {} {}", claim.figure.name(), sig_or_dash(value, 3))
    };
    claims.iter().map(shown).collect()
}

fn longest(beats: &[Beat]) -> usize {
    let letters = beats.iter().map(|beat| beat.caption.chars().count());
    letters.max().unwrap_or(0)
}

/// The caption of the last scripted event, while it is fresh (half a passage).
fn scripted(app: &App) -> Option<&str> {
    let frame = app.frame()?;
    let fresh_s = 2.0 * frame.a_m / frame.metrics.entrainment_m_s.abs().max(1e-9);
    app.setup
        .scene
        .events
        .iter()
        .filter(|event| !event.caption.is_empty())
        .rfind(|event| (event.at_s..event.at_s + fresh_s).contains(&frame.time_s))
        .map(|event| event.caption.as_str())
}

pub(super) fn render(app: &App, caption: &Caption<'_>, area: Rect, buffer: &mut Buffer) {
    let theme = app.theme;
    for row in 0..area.height {
        put(
            area,
            row,
            &Line::styled(theme.pick("▌", "|"), theme.style(Role::Key)),
            buffer,
        );
    }
    let text = Rect {
        x: area.x + 2,
        width: area.width.saturating_sub(4),
        ..area
    };
    let hint = Line::styled(caption.hint, theme.style(Role::Dim));
    let title = Span::styled(ascii_text(theme, &caption.title), theme.style(Role::Key));
    let beside = Rect {
        width: text.width.saturating_sub(hint.width() as u16),
        ..text
    };
    let figures = Span::styled(
        ascii_text(theme, &caption.figures),
        theme.style(Role::Strong),
    );
    put(beside, 0, &Line::from(vec![title, figures]), buffer);
    put_right(text, 0, &hint, buffer);
    let below = Rect {
        y: text.y + 1,
        height: text.height.saturating_sub(1),
        ..text
    };
    Paragraph::new(ascii_text(theme, caption.text))
        .wrap(Wrap { trim: true })
        .render(below, buffer);
}
