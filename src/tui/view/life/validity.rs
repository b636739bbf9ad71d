//! Below the number, always: what to know before trusting it.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use crate::sim::{Caution, CautionCode};
use crate::tui::app::App;
use crate::tui::theme::Role;
use crate::tui::view::{ascii_text, put};

/// The weightiest caution, and how many more there are behind `i`: in its own words where they fit, else by its name.
pub(super) fn line(app: &App, row: Rect, buffer: &mut Buffer) {
    let theme = app.theme;
    let cautions = app.cautions();
    let Some(first) = cautions.first() else {
        return;
    };
    let more = match cautions.len() - 1 {
        0 => String::new(),
        more => format!(" +{more} i"),
    };
    let (mark, role) = match first.code {
        // What every scene leaves out is no alarm.
        CautionCode::ElasticOnly => ("", Role::Dim),
        _ => (theme.pick("⚠ ", "! "), Role::Warn),
    };
    let room = usize::from(row.width).saturating_sub(more.len() + 2);
    let text = ascii_text(theme, &first.text);
    let text = if text.chars().count() <= room {
        text
    } else {
        name(first).to_owned()
    };
    let line = Line::from(vec![
        Span::styled(format!("{mark}{text}"), theme.style(role)),
        Span::styled(more, theme.style(Role::Key)),
    ]);
    put(row, 0, &line, buffer);
}

/// A caution in a few letters.
fn name(caution: &Caution) -> &'static str {
    match caution.code {
        CautionCode::NotConverged => "not converged",
        CautionCode::BeyondYield => "beyond yield",
        CautionCode::StillYielding => "still yields",
        CautionCode::Dry => "dry",
        CautionCode::FilmBelowMolecule => "film < molecule",
        CautionCode::MeshFilm => "coarse mesh",
        CautionCode::ShortDomain => "short domain",
        CautionCode::StandingBody => "a body stands",
        CautionCode::ModelRange => "choices differ",
        CautionCode::AboveSmooth => "above smooth",
        CautionCode::NotSettled => "not settled",
        CautionCode::NoLife => "no life",
        CautionCode::StrengthUnknown => "yield unknown",
        CautionCode::ElasticOnly => "elastic, no wear",
    }
}
