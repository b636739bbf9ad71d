//! Below the knobs, where there is room: speeds, sizes, what only a new run changes, and what the letters mean.

use ratatui::buffer::Buffer;
use ratatui::layout::{Margin, Rect};
use ratatui::text::Line;

use crate::tui::app::App;
use crate::tui::choice::Choice;
use crate::tui::theme::Role;
use crate::tui::units::sig;
use crate::tui::view::place::{Entry, columns_from, put, rows_from, table};
use asperity_engine::physics::cycles::speed_ratios;
use asperity_engine::scene::ContactKind;
use asperity_engine::sim::{Quantity, named};

/// Where there is room: both bodies' speeds, the contact's size, and what the letters mean.
pub(super) fn speeds(app: &App, area: Rect, buffer: &mut Buffer) {
    let theme = app.view.theme;
    let Some(frame) = app.frame() else { return };
    let metrics = &frame.metrics;
    let speed = app.view.units.speed();
    let [u1, u2] = speed_ratios(metrics.slide_roll);
    let sliding = (u2 - u1).abs();
    let specific = |own: f64| match sliding / own.abs() {
        ratio if ratio.is_finite() => sig(ratio, 2),
        _ => "∞".to_owned(),
    };
    let shown = |quantity: &Quantity, digits: i32| app.view.units.show(quantity, frame, digits);
    let mean = metrics.entrainment_m_s;
    let a = shown(const { named("a_m") }, 3);
    let across = match frame.kind {
        ContactKind::Point => {
            let b = shown(const { named("b_m") }, 3);
            Entry::new("b half-width y", b, Role::Text)
        }
        ContactKind::Line => Entry::new("uniform along y", String::new(), Role::Dim),
    };
    let friction = shown(const { named("friction_coefficient") }, 2);
    let lines = [
        Entry::new("U₁ body 1", speed.show(mean * u1, 3), Role::Body1),
        Entry::new("U₂ body 2", speed.show(mean * u2, 3), Role::Body2),
        Entry::new("ζ₁ = |U₂−U₁|/U₁", specific(u1), Role::Body1),
        Entry::new("ζ₂ = |U₂−U₁|/U₂", specific(u2), Role::Body2),
        Entry::new("a half-width x", a, Role::Text),
        across,
        Entry::new("µ friction", friction, Role::Text),
    ];
    let area = area.inner(Margin::new(1, 0));
    table(theme, area, &lines, buffer);
    if area.width < WORDS {
        return;
    }
    let below = rows_from(area, lines.len() as u16 + 1);
    let below = rows_from(below, fixed(app, below, buffer));
    for (row, (name, meaning)) in (0..).zip(SYMBOLS) {
        let name = theme.span(format!("{:<5}", theme.words(name)), Role::Strong);
        let line = Line::from(vec![name, theme.span(meaning, Role::Dim)]);
        put(below, row, &line, buffer);
    }
}

/// Columns from which what the letters mean has room; the help screen says it too.
const WORDS: u16 = 22;

/// What only a new run changes (`e`); the rows used.
fn fixed(app: &App, area: Rect, buffer: &mut Buffer) -> u16 {
    let oil = Choice::Viscosity.of_scene(&app.run.setup.scene, app.view.units);
    let lines = [
        Entry::new("lay₁ W/a", lay(app, 0), Role::Body1),
        Entry::new("lay₂ W/a", lay(app, 1), Role::Body2),
        Entry::new("oil", oil, Role::Film),
    ];
    let count = lines.len() as u16;
    if area.height < count + SYMBOLS.len() as u16 {
        return 0;
    }
    table(app.view.theme, columns_from(area, 2), &lines, buffer);
    for row in 0..count {
        put(area, row, &app.view.theme.line("e", Role::Key), buffer);
    }
    count
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
    ("n", "1 + 2af|U₂−U₁|/|Uᵢ|"),
    ("", "f: mate's crests/m"),
    ("life", "over smooth rolling"),
];
