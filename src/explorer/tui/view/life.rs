//! Right: relative life, large, with its band, and the mechanisms that make it.

mod counts;
mod mechanisms;
mod number;
mod scale;
mod validity;

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::style::{Modifier, Style};

use crate::tui::action::Action;
use crate::tui::app::{App, Leading, PanelKind};
use crate::tui::pixels::PixelPlot;
use crate::tui::theme::Role;
use crate::tui::view::areas::{Areas, PanelSpacing};
use crate::tui::view::curve;
use crate::tui::view::sheet::{Sheet, panel, title, with_columns, with_rows};

/// A press on the curve against S goes there.
pub(super) fn pressed(app: &App, areas: &Areas, screen: Rect, at: Position) -> Option<Action> {
    if !areas.life.contains(at) {
        return None;
    }
    // Where the curve is depends on all that stands above it: as it is drawn.
    let mut sheet = Sheet {
        theme: app.view.theme,
        buffer: &mut Buffer::empty(screen),
    };
    let (plot, _) = render(app, areas, &mut sheet);
    curve::pressed(app, plot?, at)
}

/// Draws it; says where the curve's plot is, and what it leaves to a page.
pub(super) fn render(
    app: &App,
    areas: &Areas,
    sheet: &mut Sheet<'_>,
) -> (Option<Rect>, Vec<PixelPlot>) {
    let theme = app.view.theme;
    let inner = panel(
        app,
        areas,
        PanelKind::Life,
        title(theme, "", number::name(app, areas)),
        sheet,
    );
    let inner = if areas.density == PanelSpacing::Full {
        with_columns(inner, inner.x + 1, inner.width.saturating_sub(2))
    } else {
        inner
    };
    let mut rows = RowAllotment {
        area: inner,
        next: 0,
    };
    if app.run.setup.scene.life.is_none() {
        return without_life(app, &mut rows, sheet);
    }
    let roomy = inner.height >= 20;
    if roomy {
        rows.skip();
    }
    number::figure(app, &mut rows, sheet);
    validity::line(app, rows.take(1), sheet);
    // Where rows are few the factors and counts say more than a scale.
    if inner.height >= 13 {
        scale::scale(app, &mut rows, sheet);
    }
    if roomy {
        number::model(app, rows.take(1), sheet);
    }
    mechanisms::mechanisms(app, &mut rows, sheet);
    if roomy {
        mechanisms::scale(rows.take(1), sheet);
    }
    counts::counts(app, &mut rows, sheet);
    counts::other_count(app, &mut rows, sheet);
    if app.view.pinned.is_some() {
        counts::comparison(app, &mut rows, sheet);
    }
    curve::render(app, rows.rest(), sheet)
}

/// A scene that asks for no life: it is not waited for.
fn without_life(
    app: &App,
    rows: &mut RowAllotment,
    sheet: &mut Sheet<'_>,
) -> (Option<Rect>, Vec<PixelPlot>) {
    let words = ["no life in this scene", "(no [life] table)"];
    for text in words {
        sheet.text(rows.take(1), 0, text, Role::Dim);
    }
    validity::line(app, rows.take(1), sheet);
    rows.skip();
    counts::counts(app, rows, sheet);
    curve::render(app, rows.rest(), sheet)
}

/// Rows handed out from above.
struct RowAllotment {
    area: Rect,
    next: u16,
}

impl RowAllotment {
    fn take(&mut self, rows: u16) -> Rect {
        let rest = self.rest();
        self.next += rows;
        Rect {
            height: rows.min(rest.height),
            ..rest
        }
    }

    fn skip(&mut self) {
        self.next += 1;
    }

    fn rest(&self) -> Rect {
        let used = self.next.min(self.area.height);
        with_rows(self.area, self.area.y + used, self.area.height - used)
    }
}

/// Dims what the simulation says while it is on its way.
fn simulated(app: &App, style: Style) -> Style {
    match app.leading() {
        Leading::Simulated => style,
        Leading::Scaled | Leading::Formula => style.add_modifier(Modifier::DIM),
    }
}
