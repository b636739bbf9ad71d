//! The sentence after a turn of a knob: against numbers worked out by hand, and against two cold runs of the engine.
#![cfg(feature = "tui")]
#![expect(clippy::unwrap_used, reason = "tests")]

use asperity_engine::plan::Plan;
use asperity_engine::scene::{Override, Scene};
use asperity_engine::sim::Knob;
use asperity_explorer::tui::action::Action;
use asperity_explorer::tui::app::{App, Leading};
use ratatui::layout::Rect;

use super::numbers::Bench;
use crate::common::tui_fixture::{State, mouse, plain, play, running, text};
use asperity_explorer::tui::event::PointerAct;
use asperity_explorer::tui::view;

/// The fixture by hand: n = 1 + 2 · 2.2 · |S|/(1 − S/2), cycles 1/n; peaks and traction stay.
#[test]
fn the_sentence_is_what_a_hand_works_out() {
    let mut app = running(plain());
    assert_eq!(app.why(), None, "nothing was turned");
    app.apply(Action::TurnFar(2));
    // At once, by the formula.
    let formula = app.why().unwrap();
    assert_eq!(
        (formula.of, formula.turned.as_str()),
        (Leading::Formula, "S 0.50→1.00")
    );
    let n = |s: f64| 1.0 + 4.4 * s / (1.0 - 0.5 * s);
    assert_eq!(formula.changes[0], format!("n {:.1}→{:.1}", n(0.5), n(1.0)));
    for (width, height) in [(60, 20), (80, 24), (160, 48), (200, 60)] {
        let shown = text(&app, width, height);
        assert!(shown.contains("formula: S 0.50→1.00: n 3.9→9.8"), "{shown}");
    }
    let there = State {
        slide_roll: 1.0,
        slide_roll_target: 1.0,
        ..State::default()
    };
    // The fixture's peaks come and go with the step: the same one as before.
    let step = (96.0 + std::f64::consts::TAU / 0.11).round() as u64;
    play(&mut app, step..=step, &there);
    let line = app.why().unwrap();
    assert_eq!(line.of, Leading::Simulated);
    // (1/9.8)/(1/3.933) = 0.40, of which the life follows.
    assert_eq!(line.changes, ["n 3.9→9.8", "cycles ×0.40", "life ×0.40"]);
    assert_eq!(line.governs, "body 1 governs");
    let shown = text(&app, 80, 24);
    assert!(
        shown.contains(" S 0.50→1.00: n 3.9→9.8, cycles ×0.40, life ×0.40; body 1 governs"),
        "{shown}"
    );
    // The next turn is told from where this one ended; turned back there is nothing to tell.
    app.apply(Action::TurnFar(-1));
    assert_eq!(app.why().unwrap().turned, "S 1.00→0.75");
    app.apply(Action::TurnFar(1));
    assert_eq!(app.why(), None);
}

fn coarse(preset: &str, sets: &[&str]) -> Scene {
    let sets: Vec<Override> = sets.iter().map(|text| text.parse().unwrap()).collect();
    Scene::load_with(preset, &sets).unwrap()
}

/// A knob that is turned in a run, against two runs that begin cold on either side: factors, film, and the number of
/// contacts.
#[test]
fn what_a_knob_changes_is_what_two_cold_runs_differ_by() {
    let waves = [
        "grid.nodes=65",
        "stress.depths=8",
        "body_1.surface.wavelength_x_m=4e-4",
        "body_2.surface.wavelength_x_m=4e-4",
        "body_2.surface.wavelength_y_m=4e-4",
    ];
    let point = coarse("demonstration", &waves);
    let line = coarse("fzg_point_e", &["stress.depths=8"]);
    let cases = [
        ("demonstration", &point, Knob::SlideRoll, 1.0),
        ("demonstration", &point, Knob::Amplitude1M, 1.5e-7),
        ("demonstration", &point, Knob::EntrainmentMS, 0.4),
        ("demonstration", &point, Knob::ForceN, 1000.0),
        ("fzg_point_e", &line, Knob::SlideRoll, -0.5),
    ];
    let settled = |scene: &Scene| {
        let mut bench = Bench::new(scene);
        bench.settle_and_go_on();
        bench
    };
    // The first run of a pair is the one that the knob is turned in, up to there; and that of each knob of a scene.
    let (of_point, of_line) = (settled(&point), settled(&line));
    for (name, scene, knob, value) in cases {
        let cold_then = if std::ptr::eq(scene, &raw const line) {
            &of_line
        } else {
            &of_point
        };
        let mut live = cold_then.again(scene);
        live.press(&[Action::GoTo(knob, value)]);
        let value = live.app.target(knob);
        live.settle_and_go_on();
        let (then, now, of) = live.app.accounts().unwrap();
        assert_eq!(of, Leading::Simulated);
        let mut turned = scene.clone();
        knob.put(&mut turned, value);
        if knob.is_load() {
            // A live run keeps the rectangle that it began with; in half-widths of the other load, which goes with W^(1/3).
            let domain = Plan::new(scene).unwrap().domain;
            let ratio = (knob.of(scene) / value).cbrt();
            turned.grid.x_min_a = Some(domain.x_min_a * ratio);
            turned.grid.x_max_a = Some(domain.x_max_a * ratio);
            turned.grid.y_half_a = Some(domain.y_half_b * ratio);
        }
        let [cold_then, cold_now] =
            [cold_then, &settled(&turned)].map(|cold| cold.app.account().unwrap());
        println!(
            "{name}, {knob:?} to {value}: {}",
            live.app.why().unwrap().in_columns(120)
        );
        let pairs = [
            (
                "n",
                then.n.unwrap() / now.n.unwrap(),
                cold_then.n.unwrap() / cold_now.n.unwrap(),
                0.002,
            ),
            (
                "cycles",
                then.factors.cycle.unwrap() / now.factors.cycle.unwrap(),
                cold_then.factors.cycle.unwrap() / cold_now.factors.cycle.unwrap(),
                0.04,
            ),
            (
                "peaks",
                then.factors.peak / now.factors.peak,
                cold_then.factors.peak / cold_now.factors.peak,
                0.04,
            ),
            (
                "traction",
                then.factors.traction / now.factors.traction,
                cold_then.factors.traction / cold_now.factors.traction,
                0.03,
            ),
            (
                "film",
                then.film_m / now.film_m,
                cold_then.film_m / cold_now.film_m,
                0.03,
            ),
        ];
        for (what, live, cold, within) in pairs {
            println!("    {what}: {live:.4} live, {cold:.4} by two cold runs");
            assert!(
                (live / cold - 1.0).abs() < within,
                "{name} {knob:?} {what}: {live} {cold}"
            );
        }
        assert_eq!(now.body, cold_now.body);
    }
}

fn type_in(app: &mut App, letters: &str) -> Vec<asperity_explorer::tui::app::Effect> {
    app.apply(Action::Type);
    for letter in letters.chars() {
        assert_eq!(app.apply(Action::Letter(letter)), []);
    }
    app.apply(Action::Enter)
}

#[test]
fn values_are_typed_in_the_unit_of_the_screen() {
    let mut app = running(plain());
    assert!(!type_in(&mut app, "0.37").is_empty());
    assert_eq!(app.target(Knob::SlideRoll), 0.37);
    app.apply(Action::Choose(2));
    type_in(&mut app, "0,15");
    assert!(
        (app.target(Knob::Amplitude1M) - 1.5e-7).abs() < 1e-18,
        "µm, and a comma"
    );
    // What is not allowed is named: knob, value, range.
    app.apply(Action::Choose(0));
    for wrong in ["3", "-2.01", "nan", "inf", "x", "", "1e999", "--1"] {
        assert_eq!(type_in(&mut app, wrong), [], "{wrong}");
        let said = app.message().unwrap();
        assert_eq!(said, format!("S = {wrong} is refused: -2.00 to 2.00"));
        assert_eq!(app.target(Knob::SlideRoll), 0.37);
    }
    app.apply(Action::Type);
    (0..40).for_each(|_| drop(app.apply(Action::Letter('1'))));
    app.apply(Action::Erase);
    assert!(text(&app, 80, 24).contains("S = 11111111111_  (-2 to 2"));
    app.apply(Action::Close);
    assert!(!app.is_typing());
    assert_eq!(app.target(Knob::SlideRoll), 0.37, "left as it was");
    // A digit without = is a typical value as ever.
    app.apply(Action::Typical(4));
    assert_eq!(app.target(Knob::SlideRoll), 0.5);
}

/// Every place of a screen can be pressed; on the curve it goes there, on a key of the last line it is that key.
#[test]
fn the_curve_and_the_last_line_can_be_pressed() {
    let mut app = running(plain());
    let down = PointerAct::Press;
    let (mut went, mut keys) = (Vec::new(), Vec::new());
    let screen = Rect::new(0, 0, 160, 48);
    for (column, row) in (0..48).flat_map(|row| (0..160).map(move |column| (column, row))) {
        match view::pointed(&app, screen, mouse(down, column, row)) {
            Some(Action::GoTo(Knob::SlideRoll, value)) => went.push(value),
            Some(action) if row == 47 => keys.push(action),
            _ => {}
        }
    }
    let (least, most) = went
        .iter()
        .fold((9.0_f64, -9.0_f64), |(a, b), s| (a.min(*s), b.max(*s)));
    assert_eq!((least, most), (-2.0, 2.0));
    keys.dedup();
    for key in [
        Action::Help,
        Action::Quit,
        Action::TogglePause,
        Action::Pin,
        Action::Lessons,
    ] {
        assert!(keys.contains(&key), "{key:?} in {keys:?}");
    }
    app.apply(Action::GoTo(Knob::SlideRoll, 0.813));
    assert!(
        (app.target(Knob::SlideRoll) - 0.8).abs() < 1e-9,
        "the nearest step"
    );
    // What is open decides which keys there are.
    let last = |app: &App| text(app, 160, 48).lines().last().unwrap().to_owned();
    assert!(last(&app).contains("b freeze") && last(&app).contains("m map"));
    app.apply(Action::Pin);
    app.apply(Action::NextPanel(2));
    assert!(last(&app).contains("b release") && last(&app).contains("y curve"));
    app.apply(Action::Lessons);
    assert!(last(&app).contains("begin") && !last(&app).contains("release"));
    app.apply(Action::Enter);
    assert!(last(&app).contains("N back") && last(&app).contains("T end lesson"));
}

/// At 80 x 24 it stays said whose number it is, and against what.
#[test]
fn a_small_screen_still_says_where_the_number_comes_from() {
    let mut app = running(plain());
    let shown = text(&app, 80, 24);
    for words in ["simulated", "formula", "against smooth rolling"] {
        assert!(shown.contains(words), "{words} in\n{shown}");
    }
    app.apply(Action::Turn(1));
    let shown = text(&app, 80, 24);
    for words in ["scaled", "formula", "against smooth rolling"] {
        assert!(shown.contains(words), "{words} in\n{shown}");
    }
}

#[test]
fn what_is_frozen_stays_beside_what_goes_on() {
    let mut app = running(plain());
    app.apply(Action::Pin);
    let there = State {
        slide_roll: 1.0,
        slide_roll_target: 1.0,
        ..State::default()
    };
    app.apply(Action::TurnFar(2));
    play(&mut app, 97..=160, &there);
    for (width, height) in [(80, 24), (160, 48)] {
        insta::assert_snapshot!(
            format!("frozen_{width}x{height}"),
            text(&app, width, height)
        );
    }
    // The frozen map shows what the live one does, and goes when it is let go.
    app.apply(Action::NextMap);
    assert!(text(&app, 160, 48).contains("frozen: profile at S 0.50"));
    app.apply(Action::Pin);
    let shown = text(&app, 160, 48);
    assert!(!shown.contains("frozen") && !shown.contains('┃'), "{shown}");
}
