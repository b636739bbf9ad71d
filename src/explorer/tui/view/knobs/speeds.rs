//! Below the knobs, where there is room: speeds, sizes, what only a new run changes, and what the letters mean.

use ratatui::layout::{Margin, Rect};
use ratatui::text::Line;

use crate::tui::app::App;
use crate::tui::choice::Choice;
use crate::tui::theme::Role;
use crate::tui::units::sig;
use crate::tui::view::sheet::Sheet;
use asperity_engine::physics::estimate::speed_ratios;
use asperity_engine::scene::ContactKind;
use asperity_engine::sim::{Quantity, named};

/// Where there is room: both bodies' speeds, the contact's size, and what the letters mean.
pub(super) fn speeds(app: &App, area: Rect, sheet: &mut Sheet<'_>) {
    let theme = app.view.theme;
    let Some(frame) = app.frame() else { return };
    let metrics = &frame.metrics;
    let speed = app.view.units.speed();
    let (u1, u2) = speed_ratios(metrics.slide_roll);
    let sliding = (u2 - u1).abs();
    let specific = |own: f64| {
        let ratio = sliding / own.abs();
        if ratio.is_finite() {
            sig(ratio, 2)
        } else {
            theme.pick("∞", "inf").to_owned()
        }
    };
    let shown = |quantity: &Quantity, digits: i32| app.view.units.show(quantity, frame, digits);
    let mean = metrics.entrainment_m_s;
    let lines = [
        ("U₁ body 1", speed.show(mean * u1, 3), Role::Body1),
        ("U₂ body 2", speed.show(mean * u2, 3), Role::Body2),
        ("ζ₁ = |U₂−U₁|/U₁", specific(u1), Role::Body1),
        ("ζ₂ = |U₂−U₁|/U₂", specific(u2), Role::Body2),
        (
            "a half-width x",
            shown(const { named("a_m") }, 3),
            Role::Text,
        ),
        match frame.kind {
            ContactKind::Point => (
                "b half-width y",
                shown(const { named("b_m") }, 3),
                Role::Text,
            ),
            ContactKind::Line => ("uniform along y", String::new(), Role::Dim),
        },
        (
            "µ friction",
            shown(const { named("friction_coefficient") }, 2),
            Role::Text,
        ),
    ];
    let area = area.inner(Margin::new(1, 0));
    for (row, (name, value, role)) in lines.iter().enumerate() {
        let row = row as u16;
        let room = usize::from(area.width).saturating_sub(value.chars().count() + 1);
        // Where the whole name would run into the value its letter is enough.
        let name = if name.chars().count() > room && !value.is_empty() {
            name.split(' ').next().unwrap_or(name)
        } else {
            name
        };
        let name = theme.text(name);
        sheet.text(area, row, name, Role::Dim);
        let value = theme.text(value);
        sheet.text_right(area, row, value, *role);
    }
    if area.width < WORDS {
        return;
    }
    let below = lines.len() as u16 + 1;
    let below = below + fixed(app, area, below, sheet);
    for (row, (name, meaning)) in SYMBOLS.iter().enumerate() {
        let line = Line::from(vec![
            theme.span(format!("{:<5}", theme.text(name)), Role::Strong),
            theme.span(meaning, Role::Dim),
        ]);
        sheet.line(area, below + row as u16, &line);
    }
}

/// Columns from which what the letters mean has room; the help screen says it too.
const WORDS: u16 = 22;

/// What only a new run changes (`e`); the rows used.
fn fixed(app: &App, area: Rect, from: u16, sheet: &mut Sheet<'_>) -> u16 {
    let theme = app.view.theme;
    let scene = &app.run.setup.scene;
    let shown = |choice: Choice| choice.of_scene(scene, app.view.units);
    let lines = [
        ("lay 1, W/a", lay(app, 0), Role::Body1),
        ("lay 2, W/a", lay(app, 1), Role::Body2),
        ("oil", shown(Choice::Viscosity), Role::Film),
    ];
    if area.height < from + lines.len() as u16 + SYMBOLS.len() as u16 {
        return 0;
    }
    for (row, (name, value, role)) in (from..).zip(&lines) {
        let name = Line::from(vec![
            theme.span("e ", Role::Key),
            theme.span(*name, Role::Dim),
        ]);
        sheet.line(area, row, &name);
        sheet.text_right(area, row, value, *role);
    }
    lines.len() as u16
}

/// `transverse 0.43`.
fn lay(app: &App, body: usize) -> String {
    let scene = &app.run.setup.scene;
    let lay = Choice::Lay(body).of_scene(scene, app.view.units);
    match Choice::wave_m(scene, body) {
        Some(wave_m) => format!("{lay} {}", sig(wave_m / app.run.setup.half_width_m, 2)),
        None => lay,
    }
}

/// Specific sliding: in the panel its rows are the definition.
pub(in crate::tui::view) const SPECIFIC: (&str, &str) = ("ζ", "|U₂−U₁|/U₁ and |U₂−U₁|/U₂");

/// What the letters on the screen mean; the help screen says it too.
pub(in crate::tui::view) const SYMBOLS: &[(&str, &str)] = &[
    ("S", "(U₂−U₁)/U, U mean"),
    ("p_h", "max. Hertz pressure"),
    ("λ", "smooth film/rms"),
    ("n", "1 + 2af|U₂−U₁|/|U|"),
    ("", "f: mate's crests/m"),
    ("life", "over smooth rolling"),
];
