//! The explorer's screens from fixed frames, at several sizes and with every kind of terminal; the
//! reducer behind the keys; storms of sizes and keys.
#![cfg(feature = "tui")]
#![expect(clippy::unwrap_used, reason = "tests")]

mod tui_fixture;

use std::sync::Arc;
use std::time::Duration;

use asperity::run::{Command, Settled};
use asperity::scene::{Event, Scene, Surface};
use asperity::sim::{Frame, Knob};
use asperity::study::sweep::{Along, Began, Conditions, Found};
use asperity::tui::action::{Action, KEYS};
use asperity::tui::app::{App, Effect, ErrandKind, Leading, MapKind, Setup};
use asperity::tui::pixels::Pixels;
use asperity::tui::theme::{ColorDepth, Glyphs, Theme};
use asperity::tui::{Health, RunStatus, view};
use crossterm::event::{KeyModifiers, MouseButton, MouseEvent, MouseEventKind};
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Color;
use tui_fixture::{State, app, frame, scene, settled, status, theme};

/// Unicode without colour: what is drawn shows in the characters.
fn plain() -> Theme {
    theme(ColorDepth::Mono, Glyphs::Unicode)
}

/// Plays so many steps of a synthetic run, a screen's frame apart.
fn play(app: &mut App, steps: std::ops::RangeInclusive<u64>, state: &State) {
    for step in steps {
        app.tick(Duration::from_millis(17 * step));
        app.take_status(status(step));
        app.take_frame(Arc::new(frame(step, state)));
    }
}

fn running(theme: Theme) -> App {
    let mut app = app(theme);
    play(&mut app, 1..=96, &State::default());
    app
}

fn buffer(app: &App, width: u16, height: u16) -> Buffer {
    let mut terminal = Terminal::new(TestBackend::new(width, height)).unwrap();
    terminal.draw(|frame| view::draw(app, frame)).unwrap();
    terminal.backend().buffer().clone()
}

fn text(app: &App, width: u16, height: u16) -> String {
    let buffer = buffer(app, width, height);
    let mut lines = Vec::new();
    for y in 0..height {
        let line: String = (0..width).map(|x| buffer[(x, y)].symbol()).collect();
        lines.push(line.trim_end().to_owned());
    }
    lines.join("\n")
}

#[test]
fn live_screens() {
    let app = running(plain());
    for (width, height) in [(60, 20), (80, 24), (120, 36), (160, 48)] {
        insta::assert_snapshot!(format!("live_{width}x{height}"), text(&app, width, height));
    }
}

#[test]
fn every_map() {
    let mut app = running(plain());
    for kind in MapKind::ALL {
        insta::assert_snapshot!(
            format!("map_{}", kind.name().replace(' ', "_")),
            text(&app, 80, 24)
        );
        app.apply(Action::NextMap);
    }
    app.apply(Action::Zoom);
    insta::assert_snapshot!("map_whole_domain", text(&app, 120, 36));
}

#[test]
fn ascii_screens() {
    let mut app = running(theme(ColorDepth::Mono, Glyphs::Ascii));
    insta::assert_snapshot!("ascii_100x30", text(&app, 100, 30));
    app.apply(Action::Help);
    insta::assert_snapshot!("ascii_help_100x40", text(&app, 100, 40));
}

#[test]
fn states_of_a_run() {
    let before = app(plain());
    insta::assert_snapshot!("before_the_first_frame", text(&before, 80, 24));

    let mut turning = running(plain());
    turning.apply(Action::Pin);
    turning.apply(Action::TurnFar(2));
    let on_the_way = State {
        slide_roll: 0.62,
        slide_roll_target: 1.0,
        settled: false,
        ..State::default()
    };
    play(&mut turning, 97..=100, &on_the_way);
    insta::assert_snapshot!("turning_80x24", text(&turning, 80, 24));
    insta::assert_snapshot!("turning_160x48", text(&turning, 160, 48));

    let mut failing = running(plain());
    let not_converged = State {
        converged: false,
        ..State::default()
    };
    play(&mut failing, 97..=97, &not_converged);
    insta::assert_snapshot!("not_converged", text(&failing, 80, 24));
    failing.take_status(RunStatus {
        health: Health::Failed("step at t = 1.2e-3 s stalled after 4 retries".into()),
        ..RunStatus::default()
    });
    insta::assert_snapshot!("failed", text(&failing, 80, 24));
    failing.apply(Action::Close);
    assert_eq!(failing.fault(), None, "a fault that was read stays closed");

    let mut past = running(plain());
    for _ in 0..3 {
        past.apply(Action::StepBack);
    }
    insta::assert_snapshot!("three_frames_back", text(&past, 80, 24));
}

#[test]
fn overlays() {
    let mut app = running(plain());
    app.apply(Action::Help);
    insta::assert_snapshot!("help_60x20", text(&app, 60, 20));
    insta::assert_snapshot!("help_80x24", text(&app, 80, 24));
    insta::assert_snapshot!("help_160x48", text(&app, 160, 48));
    app.apply(Action::Plan);
    insta::assert_snapshot!("plan_80x24", text(&app, 80, 24));
    app.apply(Action::Close);
    app.apply(Action::Tour);
    app.apply(Action::NextLesson);
    insta::assert_snapshot!("lesson_80x24", text(&app, 80, 24));
    insta::assert_snapshot!("lesson_160x48", text(&app, 160, 48));
}

#[test]
fn other_readings() {
    let mut app = running(plain());
    app.apply(Action::PointQuantity);
    app.apply(Action::Units);
    app.apply(Action::Units);
    app.apply(Action::Probe(0.1, 0.2));
    insta::assert_snapshot!("shear_shop_units_and_probe", text(&app, 120, 36));
    insta::assert_snapshot!("too_small", text(&app, 40, 8));
}

/// Every state that the snapshots show, for checks that hold everywhere.
fn many(theme: Theme) -> Vec<App> {
    let live = running(theme);
    let with = |actions: &[Action]| {
        let mut app = live.clone();
        for action in actions {
            app.apply(*action);
        }
        app
    };
    vec![
        app(theme),
        with(&[]),
        with(&[Action::NextMap, Action::Pin, Action::TurnFar(1)]),
        with(&[Action::NextMap, Action::NextMap, Action::Zoom]),
        with(&[Action::PreviousMap, Action::PointQuantity]),
        with(&[Action::Help]),
        with(&[Action::Plan]),
        with(&[Action::Tour]),
        with(&[Action::StepBack, Action::Probe(0.0, 0.0)]),
    ]
}

#[test]
fn ascii_terminals_get_ascii_only() {
    for app in many(theme(ColorDepth::Basic, Glyphs::Ascii)) {
        for (width, height) in [(60, 20), (160, 48), (40, 5)] {
            let drawn = text(&app, width, height);
            let foreign = drawn.chars().find(|letter| !letter.is_ascii());
            assert_eq!(foreign, None, "in\n{drawn}");
        }
    }
}

#[test]
fn without_color_nothing_is_colored() {
    for app in many(plain()) {
        let buffer = buffer(&app, 160, 48);
        for cell in buffer.content() {
            assert_eq!((cell.fg, cell.bg), (Color::Reset, Color::Reset));
        }
    }
}

#[test]
fn maps_are_painted_in_the_depth_of_the_terminal() {
    let painted = |depth: ColorDepth| -> Vec<Color> {
        let buffer = buffer(&running(theme(depth, Glyphs::Unicode)), 120, 36);
        let blocks = buffer.content().iter().filter(|cell| cell.symbol() == "▀");
        blocks.flat_map(|cell| [cell.fg, cell.bg]).collect()
    };
    let exact = painted(ColorDepth::True);
    assert!(exact.len() > 500, "the map is there");
    assert!(
        exact
            .iter()
            .any(|color| matches!(color, Color::Rgb(r, ..) if *r > 200))
    );
    let indexed = painted(ColorDepth::Indexed);
    assert!(indexed.len() > 500);
    let is_true = |color: &Color| matches!(color, Color::Rgb(..));
    assert!(!indexed.iter().any(is_true), "no 24-bit colours on 256");
}

#[test]
fn a_step_that_did_not_converge_is_red_and_says_so() {
    let mut app = running(theme(ColorDepth::True, Glyphs::Unicode));
    let row = |app: &App| {
        let buffer = buffer(app, 80, 24);
        let line: String = (0..80).map(|x| buffer[(x, 22)].symbol()).collect();
        let red = (0..80).any(|x| buffer[(x, 22)].fg == Color::Rgb(255, 82, 82));
        (line.contains("NOT CONVERGED"), red)
    };
    assert_eq!(row(&app), (false, false));
    let state = State {
        converged: false,
        ..State::default()
    };
    play(&mut app, 97..=97, &state);
    assert_eq!(row(&app), (true, true));
}

#[test]
fn storms_of_sizes_never_break() {
    let apps = many(theme(ColorDepth::True, Glyphs::Unicode));
    let mut terminal = Terminal::new(TestBackend::new(80, 24)).unwrap();
    // Every width and height from nothing to 300 by 100 in some pairing, each with another state.
    for i in 0..700_u16 {
        let (width, height) = (i * 37 % 301, i * 53 % 101);
        let app = &apps[usize::from(i) % apps.len()];
        terminal.backend_mut().resize(width, height);
        terminal.draw(|frame| view::draw(app, frame)).unwrap();
    }
}

#[test]
fn frames_with_nothing_in_them_never_break() {
    let mut app = app(theme(ColorDepth::True, Glyphs::Unicode));
    let odd = [
        Frame::default(),
        Frame {
            nx: 1,
            ny: 1,
            pressure_pa: vec![f32::NAN],
            film_m: vec![f32::INFINITY],
            ..Frame::default()
        },
        // Lengths that do not match the fields.
        Frame {
            nx: 40,
            ny: 40,
            a_m: 1e-4,
            b_m: 1e-4,
            dx_m: 1e-5,
            dy_m: 1e-5,
            x_min_m: -2e-4,
            y_min_m: -2e-4,
            ..Frame::default()
        },
    ];
    for frame in odd {
        app.take_frame(Arc::new(frame));
        for _ in MapKind::ALL {
            app.apply(Action::NextMap);
            text(&app, 80, 24);
            text(&app, 160, 48);
        }
    }
}

#[test]
fn mashing_every_key_never_breaks() {
    let mut app = running(theme(ColorDepth::True, Glyphs::Unicode));
    let actions: Vec<Action> = KEYS
        .iter()
        .flat_map(|row| row.keys)
        .map(|(_, action)| *action)
        .collect();
    // A fixed scramble: each key after each other one.
    for i in 0..4000_usize {
        let action = actions[(i * i + 7 * i) / 3 % actions.len()];
        for effect in app.apply(action) {
            if let Effect::Send(Command::Set(knob, value)) = effect {
                assert!(value.is_finite(), "{knob:?} {value}");
            }
        }
        if i % 40 == 0 {
            app.take_frame(Arc::new(frame(97 + i as u64 / 40, &State::default())));
            text(&app, 80, 24);
        }
    }
}

fn sent(effects: &[Effect]) -> Vec<Command> {
    effects
        .iter()
        .filter_map(|effect| match effect {
            Effect::Send(command) => Some(command.clone()),
            _ => None,
        })
        .collect()
}

#[test]
fn turning_a_knob_sends_it_and_moves_the_formula_at_once() {
    let mut app = running(plain());
    assert_eq!(app.leading(), Leading::Simulated);
    let simulated = app.leading_life().unwrap();
    let commands = sent(&app.apply(Action::Turn(1)));
    let [Command::Set(Knob::SlideRoll, value)] = commands[..] else {
        panic!("{commands:?}");
    };
    assert!((value - 0.55).abs() < 1e-12);
    assert_eq!(app.leading(), Leading::Formula);
    // No frame came between, and yet the life that leads fell by the ratio of the counts.
    let count = |s: f64| 1.0 + 4.4 * s / (1.0 - 0.5 * s);
    let expected = simulated * count(0.5) / count(0.55);
    let formula = app.leading_life().unwrap();
    assert!(
        (formula / expected - 1.0).abs() < 1e-9,
        "{formula} {expected}"
    );
}

#[test]
fn the_simulation_takes_over_when_it_has_settled_there() {
    let mut app = running(plain());
    app.apply(Action::TurnFar(1));
    let way = State {
        slide_roll: 0.6,
        slide_roll_target: 0.75,
        settled: false,
        ..State::default()
    };
    play(&mut app, 97..=99, &way);
    assert_eq!(app.leading(), Leading::Formula);
    let arrived = State {
        slide_roll: 0.75,
        slide_roll_target: 0.75,
        settled: true,
        ..State::default()
    };
    play(&mut app, 100..=101, &arrived);
    assert_eq!(app.leading(), Leading::Simulated);
}

#[test]
fn a_refused_or_scripted_target_is_taken_over_after_a_while() {
    let mut app = running(plain());
    app.apply(Action::TurnFar(1));
    // The run still says 0.5: first the key is believed, then the run.
    play(&mut app, 97..=98, &State::default());
    assert_eq!(app.target(Knob::SlideRoll), 0.75);
    play(&mut app, 200..=201, &State::default());
    assert_eq!(app.target(Knob::SlideRoll), 0.5);
}

#[test]
fn loads_are_compared_on_the_scale_of_the_scene() {
    let mut app = running(plain());
    app.apply(Action::Pin);
    assert!((app.against_pinned().unwrap() - 1.0).abs() < 1e-9);
    app.apply(Action::ChooseNext);
    app.apply(Action::TurnFar(1));
    // N ∝ p_h^−(c + 3/e), p_h ∝ F^(1/3); a also adds crests to the count.
    let pressure = 1.05_f64.powi(5).cbrt();
    let count = |a: f64| 1.0 + 4.4 * a * 0.5 / 0.75;
    let expected = pressure.powf(-(31.0 / 3.0 + 2.7)) * count(1.0) / count(pressure);
    let ratio = app.against_pinned().unwrap();
    assert!((ratio / expected - 1.0).abs() < 1e-9, "{ratio} {expected}");
}

#[test]
fn time_keys() {
    let mut app = running(plain());
    assert_eq!(sent(&app.apply(Action::TogglePause)), [Command::Pause]);
    assert_eq!(sent(&app.apply(Action::StepForward)), [Command::StepOnce]);
    assert_eq!(sent(&app.apply(Action::TogglePause)), [Command::Pause]);
    // Looking back stops the run, once; forward again returns to the present, then steps.
    assert_eq!(sent(&app.apply(Action::StepBack)), [Command::Pause]);
    assert_eq!(sent(&app.apply(Action::StepBack)), []);
    assert_eq!(app.rewound().0, 2);
    let newest = 96;
    assert_eq!(app.frame().unwrap().step, newest - 2);
    assert_eq!(sent(&app.apply(Action::StepForward)), []);
    assert_eq!(sent(&app.apply(Action::StepForward)), []);
    assert_eq!(app.frame().unwrap().step, newest);
    assert_eq!(sent(&app.apply(Action::StepForward)), [Command::StepOnce]);
    for _ in 0..10_000 {
        app.apply(Action::StepBack);
    }
    let (back, kept) = app.rewound();
    assert_eq!(back, kept, "the past has a beginning");
}

#[test]
fn errands_are_done_only_where_they_are_offered() {
    let mut app = running(plain());
    assert_eq!(app.apply(Action::Save), [Effect::Errand(ErrandKind::Save)]);
    assert_eq!(app.apply(Action::Write), []);
    assert!(app.message().unwrap().contains("no files"));
    assert_eq!(app.apply(Action::View), []);
    assert!(app.message().unwrap().contains("asperity view"));
    assert_eq!(app.apply(Action::Quit), [Effect::Quit]);
}

#[test]
fn the_saved_scene_is_the_one_on_the_screen() {
    let mut app = running(plain());
    app.apply(Action::Typical(6));
    app.apply(Action::Choose(2));
    app.apply(Action::Typical(0));
    let saved = app.scene_toml();
    let scene: Scene = toml::from_str(&saved).unwrap();
    assert_eq!(scene.motion.slide_roll, 1.0);
    assert_eq!(scene.load.force_n, Some(800.0));
    let Surface::Sinusoid { amplitude_m, .. } = scene.body_1.surface else {
        panic!("body 1 is a wave");
    };
    assert_eq!(amplitude_m, 0.0);
}

#[test]
fn a_smooth_surface_has_nothing_to_turn() {
    let mut smooth = scene();
    smooth.body_1.surface = Surface::Smooth {};
    let mut app = App::new(Setup {
        scene: Arc::new(smooth),
        load_n: 800.0,
        half_width_m: tui_fixture::A_M,
        p_hertz_pa: tui_fixture::P_HERTZ_PA,
        plan_text: String::new(),
        left_out: Vec::new(),
        errands: Vec::new(),
        theme: plain(),
    });
    app.apply(Action::Choose(2));
    assert_eq!(app.apply(Action::Turn(1)), []);
    assert!(app.message().unwrap().contains("smooth"));
}

fn setup_of(scene: Scene) -> Setup {
    Setup {
        scene: Arc::new(scene),
        load_n: 800.0,
        half_width_m: tui_fixture::A_M,
        p_hertz_pa: tui_fixture::P_HERTZ_PA,
        plan_text: String::new(),
        left_out: Vec::new(),
        errands: vec![ErrandKind::Rebuild],
        theme: plain(),
    }
}

#[test]
fn the_tour_stages_scenes_moves_on_by_itself_and_returns() {
    let mut app = running(plain());
    app.apply(Action::Turn(1));
    let effects = app.apply(Action::Tour);
    let [Effect::Rebuild(staged)] = &effects[..] else {
        panic!("{effects:?}");
    };
    assert_eq!(staged.motion.slide_roll, 0.0);
    assert_eq!(staged.body_2.surface, Surface::Smooth {});
    // The words of the lesson go to the run, and so to the recording.
    let commands = sent(&app.rebuilt(setup_of((**staged).clone())));
    assert!(matches!(&commands[..], [Command::Say(words)] if words.contains("n = 1")));
    let first = text(&app, 160, 48);
    assert!(
        first.contains("1/7 One asperity, one passage (1/2)"),
        "{first}"
    );
    let rolling = State {
        slide_roll: 0.0,
        slide_roll_target: 0.0,
        ..State::default()
    };
    // A passage is 128 steps; the first beat lasts one and a half.
    play(&mut app, 1..=200, &rolling);
    let second = text(&app, 160, 48);
    assert!(
        second.contains("(2/2)") && second.contains("counted₁"),
        "{second}"
    );
    let effects = app.apply(Action::NextLesson);
    assert!(matches!(&effects[..], [Effect::Rebuild(_)]), "{effects:?}");
    // Leaving it brings the scene back as it was turned to.
    let effects = app.apply(Action::Tour);
    let [Effect::Rebuild(own)] = &effects[..] else {
        panic!("{effects:?}");
    };
    assert_eq!(own.title, scene().title);
    assert!((own.motion.slide_roll - 0.55).abs() < 1e-9);
    app.rebuilt(setup_of((**own).clone()));
    assert!(!text(&app, 160, 48).contains("One asperity"));
}

#[test]
fn another_scene_is_put_together_judged_and_run() {
    let mut app = running(plain());
    app.apply(Action::Scene);
    insta::assert_snapshot!("scene_80x24", text(&app, 80, 24));
    // Lay of body 1, then its wavelength down to what no grid carries.
    app.apply(Action::ChooseNext);
    app.apply(Action::Turn(1));
    app.apply(Action::ChooseNext);
    for _ in 0..12 {
        app.apply(Action::Turn(-1));
    }
    assert_eq!(app.apply(Action::Run), [], "what has no plan is not run");
    insta::assert_snapshot!("scene_refused_80x24", text(&app, 80, 24));
    for _ in 0..12 {
        app.apply(Action::Turn(1));
    }
    let effects = app.apply(Action::Run);
    let [Effect::Rebuild(next)] = &effects[..] else {
        panic!("{effects:?}");
    };
    let Surface::Sinusoid { wavelength_x_m, .. } = next.body_1.surface else {
        panic!("body 1 is a wave");
    };
    assert!(wavelength_x_m.is_infinite(), "ridges along the motion");
}

#[test]
fn a_passage_that_repeats_is_replayed_and_a_knob_ends_it() {
    let mut app = running(plain());
    let state = State::default();
    let effects = app.take_settled(Some(Arc::new(settled(&state))));
    assert_eq!(sent(&effects), [Command::Pause], "the cores are free");
    for _ in 0..40 {
        app.advance(Duration::from_millis(25));
    }
    insta::assert_snapshot!("replay_160x48", text(&app, 160, 48));
    // Slower, held, frame by frame; the run is not asked for anything.
    let before = app.frame().unwrap().step;
    assert_eq!(app.apply(Action::StepForward), []);
    assert_eq!(app.frame().unwrap().step, before + 1);
    app.advance(Duration::from_secs(5));
    assert_eq!(app.frame().unwrap().step, before + 1, "it stands");
    assert_eq!(app.apply(Action::TogglePause), []);
    app.apply(Action::ReplayFaster(1));
    app.advance(Duration::from_millis(500));
    assert_ne!(app.frame().unwrap().step, before + 1);
    // A knob brings the run back.
    let commands = sent(&app.apply(Action::Turn(1)));
    assert!(
        matches!(&commands[..], [Command::Set(..), Command::Pause]),
        "{commands:?}"
    );
    assert_eq!(app.frame().unwrap().step, 96);
    // And so does its key, which keeps it so.
    app.take_settled(None);
    app.take_settled(Some(Arc::new(settled(&state))));
    assert_eq!(sent(&app.apply(Action::Replay)), [Command::Pause]);
    assert_eq!(sent(&app.take_settled(None)), []);
    assert_eq!(sent(&app.take_settled(Some(Arc::new(settled(&state))))), []);
}

#[test]
fn the_material_point_is_chosen_by_body_depth_and_place() {
    let mut app = running(plain());
    let follow = |effects: &[Effect]| match sent(effects)[..] {
        [Command::Follow(follow)] => follow,
        ref other => panic!("{other:?}"),
    };
    assert_eq!(follow(&app.apply(Action::PointBody)).body, 2);
    let one = follow(&app.apply(Action::PointDepth(1)));
    let two = follow(&app.apply(Action::PointDepth(1)));
    assert!(two.depth_m > one.depth_m && two.x_m.is_none());
    let there = follow(&app.apply(Action::PutPoint(-0.5)));
    assert!((there.x_m.unwrap() / tui_fixture::A_M + 0.5).abs() < 1e-9);
    // The same in a replay, where it answers at once.
    app.take_settled(Some(Arc::new(settled(&State::default()))));
    app.advance(Duration::from_millis(1500));
    app.apply(Action::PutPoint(0.25));
    let point = app.point_now().unwrap();
    let x = point.sample.x_m / app.frame().unwrap().a_m;
    assert!((x - 0.25).abs() < 0.06, "{x}");
    let screen = Rect::new(0, 0, 160, 48);
    let areas = view::Areas::of(screen, view::Banner::None).unwrap();
    let down = MouseEventKind::Down(MouseButton::Left);
    let (column, row) = (areas.point.x + areas.point.width / 2, areas.point.y + 3);
    let action = view::pointed(&app, screen, &mouse(down, column, row));
    assert!(matches!(action, Some(Action::PutPoint(_))), "{action:?}");
}

/// What a sweep would find at an S and a speed, all else as in the fixture.
fn found(slide_roll: f64, entrainment_m_s: f64, life: f64) -> Found {
    Found {
        at: Conditions {
            slide_roll,
            entrainment_m_s,
            load_n: 800.0,
            amplitude_m: [2.0e-7; 2],
        },
        began: Began::Warm,
        life: Some([0.5 * life, life, 2.0 * life]),
        friction: 0.03 + 0.01 / entrainment_m_s,
        lambda: Some(1.08 * entrainment_m_s.powf(0.67)),
    }
}

#[test]
fn swept_lives_fill_the_curve_with_their_bands() {
    let mut app = running(plain());
    let dots = |app: &App| text(app, 160, 48).matches('•').count();
    let before = dots(&app);
    app.take_swept(
        vec![
            found(0.0, 1.0, 0.6),
            found(-1.0, 1.0, 0.02),
            found(1.0, 1.0, 0.02),
        ],
        Some((3, 18)),
    );
    assert_eq!(dots(&app), before + 3);
    insta::assert_snapshot!("swept_160x48", text(&app, 160, 48));
    app.apply(Action::Curve);
    insta::assert_snapshot!("friction_160x48", text(&app, 160, 48));
    app.apply(Action::Curve);
    app.take_swept(vec![found(0.5, 0.2, 0.05), found(0.5, 5.0, 0.3)], None);
    insta::assert_snapshot!("stribeck_160x48", text(&app, 160, 48));
    app.apply(Action::Curve);
    // Another load is another curve, from the key press on; back again it is the old one.
    assert_eq!(dots(&app), before + 3);
    app.apply(Action::Choose(1));
    app.apply(Action::Turn(1));
    assert_eq!(dots(&app), 1, "the legend's own");
    app.apply(Action::Turn(-1));
    assert_eq!(dots(&app), before + 3);
}

/// A curve asks for what it lacks: S along life, then the speed along Stribeck's.
#[test]
fn a_curve_is_filled_in_when_it_is_shown() {
    let mut app = running(plain());
    let ordered = |effects: &[Effect]| {
        let orders = effects.iter().filter_map(|effect| match effect {
            Effect::Sweep(order) => Some((order.along, order.values.clone())),
            _ => None,
        });
        orders.collect::<Vec<_>>()
    };
    let orbit = Arc::new(Settled {
        state: Some(state()),
        ..settled(&State::default())
    });
    let [(Along::SlideRoll, values)] = &ordered(&app.take_settled(Some(orbit)))[..] else {
        panic!("no order");
    };
    assert!(values.contains(&0.0) && values.contains(&-1.75) && !values.contains(&0.5));
    app.take_swept(vec![found(0.0, 1.0, 0.6)], Some((1, values.len())));
    assert_eq!(
        ordered(&app.apply(Action::Curve)),
        [],
        "friction comes with it"
    );
    let [(Along::Entrainment, speeds)] = &ordered(&app.apply(Action::Curve))[..] else {
        panic!("no order");
    };
    // Four to a decade around the scene's own speed, which the run has.
    assert_eq!(speeds.len(), 8);
    assert!(speeds.contains(&0.1) && speeds.contains(&10.0));
    let [(Along::SlideRoll, rest)] = &ordered(&app.apply(Action::Curve))[..] else {
        panic!("no order");
    };
    assert_eq!(rest.len(), values.len() - 1, "what is there is kept");
}

/// The terminal's own pixels show what half blocks show: with one by two of them to a cell it is the same, colour
/// by colour. Letters on the map stay, and what lies over it brings the blocks back.
#[test]
fn maps_in_pixels_are_the_maps_in_blocks() {
    let screen = Rect::new(0, 0, 120, 36);
    let mut app = running(theme(ColorDepth::True, Glyphs::Unicode));
    for _ in MapKind::ALL {
        app.set_pixels(Pixels::Blocks);
        let blocks = buffer(&app, 120, 36);
        assert_eq!(view::picture_area(&app, screen), None);
        app.set_pixels(Pixels::Kitty);
        let bare = buffer(&app, 120, 36);
        let picture = view::picture(&app, screen, (1, 2)).unwrap();
        assert_eq!(Some(picture.area), view::picture_area(&app, screen));
        let mut letters = 0;
        for at in picture.area.positions() {
            let (x, y) = (at.x - picture.area.x, at.y - picture.area.y);
            let pixel = |row: u16| {
                let place = usize::from(row) * picture.width + usize::from(x);
                let [r, g, b, a] = picture.rgba[4 * place..4 * place + 4] else {
                    panic!("four bytes")
                };
                if a == 0 {
                    Color::Reset
                } else {
                    Color::Rgb(r, g, b)
                }
            };
            let cell = &blocks[at];
            let colors = match cell.symbol() {
                "▀" => (cell.fg, cell.bg),
                "▄" => (cell.bg, cell.fg),
                " " => (Color::Reset, Color::Reset),
                letter => {
                    assert_eq!(bare[at].symbol(), letter);
                    letters += 1;
                    continue;
                }
            };
            assert_eq!((pixel(2 * y), pixel(2 * y + 1)), colors, "{at}");
            assert_eq!(bare[at].symbol(), " ", "{at}");
        }
        assert!(letters <= 1, "the material point");
        app.apply(Action::NextMap);
    }
    app.apply(Action::Help);
    assert_eq!(view::picture_area(&app, screen), None);
}

/// Stripes over time move with their bodies: body 1's ridges by (1 − S/2) of the way, the same in a replay.
#[test]
fn maps_over_time() {
    let mut app = running(plain());
    while app.map() != MapKind::PressureWaves {
        app.apply(Action::NextMap);
    }
    insta::assert_snapshot!("map_pressure_x-t_120x36", text(&app, 120, 36));
    app.take_settled(Some(Arc::new(settled(&State::default()))));
    app.apply(Action::NextMap);
    app.apply(Action::Probe(0.1, -0.25));
    assert!(text(&app, 120, 36).contains("1.00 a ago"));
    insta::assert_snapshot!("map_film_x-t_120x36", text(&app, 120, 36));
    app.apply(Action::NextMap);
    assert!(
        !text(&app, 120, 36).contains("ago"),
        "no place in the plane"
    );
}

/// A state to go on from: the explorer only hands it on.
fn state() -> asperity::sim::State {
    use asperity::plan::Plan;
    let sets = ["grid.nodes=65", "stress.depths=8"].map(|set| set.parse().unwrap());
    let scene = Scene::load_with("demonstration", &sets).unwrap();
    let plan = Plan::new(&scene).unwrap();
    asperity::sim::Simulation::new(&scene, plan, 1)
        .unwrap()
        .save()
}

#[test]
fn captions_of_a_scripted_scene_are_shown() {
    let mut scripted = scene();
    scripted.events.push(Event {
        at_s: 0.0,
        set: std::collections::BTreeMap::new(),
        caption: "Now S = 1.".into(),
    });
    let mut app = App::new(Setup {
        scene: Arc::new(scripted),
        load_n: 800.0,
        half_width_m: tui_fixture::A_M,
        p_hertz_pa: tui_fixture::P_HERTZ_PA,
        plan_text: String::new(),
        left_out: Vec::new(),
        errands: Vec::new(),
        theme: plain(),
    });
    play(&mut app, 1..=5, &State::default());
    assert!(text(&app, 80, 24).contains("Now S = 1."));
    // Half a passage later it has been read.
    play(&mut app, 6..=80, &State::default());
    assert!(!text(&app, 80, 24).contains("Now S = 1."));
}

fn mouse(kind: MouseEventKind, column: u16, row: u16) -> MouseEvent {
    MouseEvent {
        kind,
        column,
        row,
        modifiers: KeyModifiers::NONE,
    }
}

#[test]
fn the_mouse_moves_sliders_and_reads_the_map() {
    let mut app = running(plain());
    let screen = Rect::new(0, 0, 160, 48);
    let drawn = buffer(&app, 160, 48);
    let handle = |(x, y): &(u16, u16)| *y > 0 && drawn[(*x, *y)].symbol() == "●";
    let mut places = (0..48).flat_map(|y| (0..160).map(move |x| (x, y)));
    let (x, y) = places.find(handle).unwrap();
    let down = MouseEventKind::Down(MouseButton::Left);
    let action = view::pointed(&app, screen, &mouse(down, 2, y)).unwrap();
    let Action::Slide(0, fraction) = action else {
        panic!("{action:?}, handle at {x}, {y}");
    };
    assert!(fraction < 0.05);
    let commands = sent(&app.apply(action));
    let [Command::Set(Knob::SlideRoll, value)] = commands[..] else {
        panic!("{commands:?}");
    };
    assert!(value <= -1.95, "{value}");
    // Dragging goes on with the same slider.
    let drag = MouseEventKind::Drag(MouseButton::Left);
    let action = view::pointed(&app, screen, &mouse(drag, 16, y + 3)).unwrap();
    assert!(matches!(action, Action::Slide(0, part) if part > 0.3));
    // The middle of the map is the middle of the contact.
    let areas = view::Areas::of(screen, view::Banner::None).unwrap();
    let (column, row) = (
        areas.map.x + (areas.map.width - 8) / 2,
        areas.map.y + areas.map.height / 2,
    );
    let action = view::pointed(&app, screen, &mouse(down, column, row)).unwrap();
    let Action::Probe(x, y) = action else {
        panic!("{action:?}");
    };
    assert!(x.abs() < 0.15 && y.abs() < 0.15, "{x} {y}");
    app.apply(action);
    assert!(
        text(&app, 160, 48).contains("GPa  h "),
        "the probe reads the pressure"
    );
}
