//! Right: relative life, large, with its band, and the mechanisms that make it.

mod bars;
mod counts;
mod number;
mod validity;

use ratatui::buffer::Buffer;
use ratatui::layout::{Margin, Position, Rect};

use crate::tui::action::Action;
use crate::tui::app::{App, PanelKind};
use crate::tui::pixels::PixelPlot;
use crate::tui::theme::Role;
use crate::tui::view::areas::{Areas, PanelSpacing};
use crate::tui::view::curve;
use crate::tui::view::panel::{panel, title};
use crate::tui::view::place::{RowAllotment, put};

/// Rows from which factors and a curve have room below each other.
const BOTH_ROWS: u16 = 26;

/// A press on the curve against S goes there.
pub(super) fn pressed(app: &App, areas: &Areas, screen: Rect, at: Position) -> Option<Action> {
    if !areas.life.contains(at) {
        return None;
    }
    // Where the curve is depends on all that stands above it: as it is drawn.
    let (plot, _) = render(app, areas, &mut Buffer::empty(screen));
    curve::pressed(app, plot?, at)
}

/// Draws it; says where the curve's plot is, and what it leaves to a page.
pub(super) fn render(
    app: &App,
    areas: &Areas,
    buffer: &mut Buffer,
) -> (Option<Rect>, Vec<PixelPlot>) {
    let heading = title(app.view.theme, "", number::name(app, areas));
    let mut inner = panel(app, areas, PanelKind::Life, heading, buffer);
    if areas.density == PanelSpacing::Full {
        inner = inner.inner(Margin::new(1, 0));
    }
    let mut rows = RowAllotment { rest: inner };
    if app.run.setup.scene.life.is_none() {
        return without_life(app, &mut rows, buffer);
    }
    let roomy = inner.height >= 20;
    // The panel beside the others has the factors: one that is enlarged gives their rows to the curve where not both fit.
    let to_curve = app.view.enlarged == Some(PanelKind::Life) && inner.height < BOTH_ROWS;
    if roomy {
        rows.take(1);
    }
    number::figure(app, &mut rows, buffer);
    validity::line(app, rows.take(1), buffer);
    // Where rows are few the factors and counts say more than a scale.
    if inner.height >= 13 && !to_curve {
        bars::scale(app, &mut rows, buffer);
    }
    if roomy {
        number::model(app, rows.take(1), buffer);
    }
    if roomy {
        number::cause(app, rows.take(1), buffer);
    }
    if !to_curve {
        bars::mechanisms(app, &mut rows, buffer);
    }
    if roomy && !to_curve {
        bars::waterfall_ends(app.view.theme, rows.take(1), buffer);
    }
    counts::counts(app, &mut rows, buffer);
    if !to_curve {
        counts::other_count(app, &mut rows, buffer);
    }
    if app.view.pinned.is_some() {
        counts::comparison(app, &mut rows, buffer);
    }
    curve::render(app, rows.rest, buffer)
}

/// A scene that asks for no life: it is not waited for.
fn without_life(
    app: &App,
    rows: &mut RowAllotment,
    buffer: &mut Buffer,
) -> (Option<Rect>, Vec<PixelPlot>) {
    for text in ["no life in this scene", "(no [life] table)"] {
        put(
            rows.take(1),
            0,
            &app.view.theme.line(text, Role::Dim),
            buffer,
        );
    }
    validity::line(app, rows.take(1), buffer);
    rows.take(1);
    counts::counts(app, rows, buffer);
    curve::render(app, rows.rest, buffer)
}
