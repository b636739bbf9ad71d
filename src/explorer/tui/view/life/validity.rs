//! Below the number, always: what to know before trusting it.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Line;

use crate::tui::app::{App, Leading};
use crate::tui::theme::Role;
use crate::tui::units::{sig, sig_or_dash};
use crate::tui::view::place::{fitting, put, put_right};
use asperity_engine::sim::{Caution, CautionCode};
use asperity_session::run::Assumed;

/// The weightiest caution, and how many more there are behind `i`: in its own words where they fit, else by its name.
pub(super) fn line(app: &App, row: Rect, buffer: &mut Buffer) {
    let theme = app.view.theme;
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
    let taken = if row.width < BESIDE { FORMULA } else { 0 };
    let room = usize::from(row.width).saturating_sub(more.len() + 2 + taken);
    let text = theme.words(&first.text);
    let range = range(app, first);
    let short = range.as_deref().unwrap_or(name(first));
    let text = fitting([text.as_str(), short], room).unwrap_or(name(first));
    let line = Line::from(vec![
        theme.span(format!("{mark}{text}"), role),
        theme.span(more, Role::Key),
    ]);
    put(row, 0, &line, buffer);
    // Where there was no room for the formula's number beside the simulation's, it stands here.
    if row.width < BESIDE && app.leading() == Leading::Simulated {
        let formula = format!(
            "formula {}",
            sig_or_dash(app.lives.estimate.formula.life(), 2)
        );
        let formula = theme.line(formula, Role::Formula);
        if line.width() + formula.width() < usize::from(row.width) {
            put_right(row, 0, &formula, buffer);
        }
    }
}

/// Columns of that number.
const FORMULA: usize = 13;
/// Columns in which the formula's number stands beside the simulation's band.
const BESIDE: u16 = 32;

/// The life over what a caution says is assumed, once it is known.
fn range(app: &App, caution: &Caution) -> Option<String> {
    let (what, [low, high]) = app.life_over(caution)?;
    let what = match what {
        Assumed::Phase => "phases",
        Assumed::OilLaw => "oil's law",
    };
    Some(format!("{what} {}–{}", sig(low, 2), sig(high, 2)))
}

/// A caution in a few letters.
fn name(caution: &Caution) -> &'static str {
    match caution.code {
        CautionCode::NotConverged => "not converged",
        CautionCode::BeyondYield => "beyond yield",
        CautionCode::StillYielding => "still yields",
        CautionCode::AmplitudeDoubtful => "odd amplitude",
        CautionCode::MapDoubtful => "odd map",
        CautionCode::Dry => "dry",
        CautionCode::FilmBelowMolecule => "film < molecule",
        CautionCode::MeshFilm => "coarse mesh",
        CautionCode::ShortDomain => "short domain",
        CautionCode::LongStep => "long step",
        CautionCode::CoarseWave => "coarse wave",
        CautionCode::CoarseConvectedWave => "coarse film wave",
        CautionCode::CoarseCounting => "coarse counting",
        CautionCode::CrestsAtEdge => "crests at edge",
        CautionCode::ShallowStress => "shallow stress",
        CautionCode::ThermalUnknown => "heat of steel",
        CautionCode::LateEvent => "late event",
        CautionCode::MapNotSeen => "map not seen",
        CautionCode::OneSample => "one sample",
        CautionCode::StandingBody => "a body stands",
        CautionCode::CrestsNotFelt => "crests not felt",
        CautionCode::OilLaw => "oil's law",
        CautionCode::NoReference => "no reference",
        CautionCode::PhaseLocked => "one phase only",
        CautionCode::ModelRange => "choices differ",
        CautionCode::AboveSmooth => "above smooth",
        CautionCode::NotSettled => "not settled",
        CautionCode::NoLife => "no life",
        CautionCode::StrengthUnknown => "yield unknown",
        CautionCode::ElasticOnly => "elastic, no wear",
    }
}
