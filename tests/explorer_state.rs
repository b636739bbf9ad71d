//! What the explorer's state does with news that come late: an orbit that was left, a sweep of other knobs.
#![cfg(feature = "tui")]
#![expect(clippy::unwrap_used, reason = "tests")]

mod tui_fixture;

use std::sync::Arc;
use std::time::Duration;

use asperity::run::Command;
use asperity::tui::action::Action;
use asperity::tui::app::{App, Effect};
use asperity::tui::theme::{ColorDepth, Glyphs};
use tui_fixture::{State, app, frame, settled, status, theme};

/// 96 steps of a synthetic run, a screen's frame apart.
fn running() -> App {
    let mut app = app(theme(ColorDepth::Mono, Glyphs::Unicode));
    for step in 1..=96 {
        app.tick(Duration::from_millis(17 * step));
        app.take_status(status(step));
        app.take_frame(Arc::new(frame(step, &State::default())));
    }
    app
}

/// The run hears of a knob one step later than the screen, and until then it still tells of the orbit that the
/// knob has ended. Taken back, it would be replayed under the new knobs and the run would stand still.
#[test]
fn a_turned_knob_is_not_taken_back_into_the_orbit_that_it_left() {
    let mut app = running();
    let orbit = Arc::new(settled(&State::default()));
    app.take_settled(Some(orbit.clone()));
    assert!(
        app.frame().unwrap().step >= 200,
        "the orbit is on the screen"
    );
    app.apply(Action::Turn(1));
    assert_eq!(app.frame().unwrap().step, 96, "the run is on the screen");
    for _ in 0..3 {
        assert_eq!(app.take_settled(Some(orbit.clone())), []);
        assert_eq!(app.frame().unwrap().step, 96);
    }
    // The run has heard, then it settles anew: that orbit is taken.
    assert_eq!(app.take_settled(None), []);
    let effects = app.take_settled(Some(Arc::new(settled(&State::default()))));
    assert_eq!(effects, [Effect::Send(Command::Pause)]);
    assert!(app.frame().unwrap().step >= 200);
}

/// A sweep that began in the same drawing is not known yet when a knob is turned; it must end all the same.
#[test]
fn a_knob_ends_a_sweep_that_the_screen_has_not_heard_of() {
    let mut app = running();
    app.take_settled(Some(Arc::new(settled(&State::default()))));
    let effects = app.apply(Action::Turn(1));
    assert!(effects.contains(&Effect::EndSweep), "{effects:?}");
}
