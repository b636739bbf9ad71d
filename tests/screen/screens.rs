//! The explorer's screens from fixed frames, at several sizes and with every kind of terminal; storms of sizes
//! and keys.
#![cfg(feature = "tui")]
#![expect(clippy::unwrap_used, reason = "tests")]

use std::sync::Arc;
use std::time::Duration;

use super::session::scramble;
use crate::common::tui_fixture::{
    State, app, buffer, found, frame, plain, play, running, sent, settled, text, theme,
};
use asperity_engine::scene::Surface;
use asperity_engine::sim::Frame;
use asperity_explorer::tui::action::{Action, KEYS};
use asperity_explorer::tui::app::{App, Effect, MapKind, PanelKind};
use asperity_explorer::tui::pixels::Medium;
use asperity_explorer::tui::theme::{ColorDepth, Glyphs, Theme};
use asperity_explorer::tui::{Health, RunStatus, view};
use asperity_session::run::Command;
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use ratatui::layout::Rect;
use ratatui::style::Color;

#[test]
fn live_screens() {
    let app = running(plain());
    for (width, height) in [(60, 20), (80, 24), (120, 36), (160, 48), (200, 60)] {
        insta::assert_snapshot!(format!("live_{width}x{height}"), text(&app, width, height));
    }
}

/// Held upright: one picture, life and knobs; what the picture is goes by the panel that the keys speak of.
#[test]
fn narrow_screens() {
    let mut app = running(plain());
    for (width, height) in [(40, 30), (48, 43)] {
        insta::assert_snapshot!(
            format!("narrow_{width}x{height}"),
            text(&app, width, height)
        );
    }
    for kind in [PanelKind::CentreLine, PanelKind::Point] {
        app.apply(Action::Focus(kind));
        let name = kind.name().replace(' ', "_");
        insta::assert_snapshot!(format!("narrow_{name}_48x43"), text(&app, 48, 43));
    }
    app.apply(Action::Enter);
    insta::assert_snapshot!("narrow_enlarged_48x43", text(&app, 48, 43));
    app.apply(Action::Close);
    app.apply(Action::Help);
    insta::assert_snapshot!("narrow_help_48x43", text(&app, 48, 43));
}

/// Each panel in place of all.
#[test]
fn enlarged_panels() {
    let mut app = running(plain());
    for kind in PanelKind::ALL {
        app.apply(Action::Focus(kind));
        app.apply(Action::Enter);
        let name = kind.name().replace(' ', "_");
        insta::assert_snapshot!(format!("enlarged_{name}_80x24"), text(&app, 80, 24));
        app.apply(Action::Close);
        assert_eq!(text(&app, 80, 24).matches("Esc").count(), 0, "as before");
    }
}

/// What a map is of stands in its heading, whole, also on a narrow screen.
#[test]
fn headings_of_maps_are_not_cut() {
    let mut app = running(plain());
    for _ in 0..9 {
        app.apply(Action::NextMap);
        let words = match app.map() {
            MapKind::PressureWaves | MapKind::FilmWaves => "now below ",
            MapKind::Stress => "y = 0 ",
            _ => continue,
        };
        for (width, height) in [(80, 24), (100, 30), (120, 36), (160, 48)] {
            let text = text(&app, width, height);
            let name = app.map().name();
            let heading = text
                .lines()
                .find(|line| line.contains(&format!("m {name} ")));
            let heading = heading.unwrap_or_else(|| panic!("{name} at {width}:\n{text}"));
            assert!(heading.contains(words), "{name} at {width}: {heading}");
        }
    }
}

/// Both surfaces passing each other: in its panel and on the whole screen, sliding and rolling.
#[test]
fn profiles() {
    for (name, slide_roll) in [("sliding", 0.5), ("rolling", 0.0)] {
        let mut app = app(plain());
        let state = State {
            slide_roll,
            slide_roll_target: slide_roll,
            ..State::default()
        };
        play(&mut app, 1..=70, &state);
        app.apply(Action::NextMap);
        assert_eq!(app.map(), MapKind::Profile);
        insta::assert_snapshot!(format!("profile_{name}_160x48"), text(&app, 160, 48));
        app.apply(Action::Enter);
        insta::assert_snapshot!(format!("profile_{name}_80x24"), text(&app, 80, 24));
    }
}

#[test]
fn every_map() {
    let mut app = running(plain());
    let show = |app: &App| {
        let name = format!("map_{}", app.map().name().replace(' ', "_"));
        insta::assert_snapshot!(name, text(app, 80, 24));
    };
    // Where nobody asks for heat there is no temperature.
    for _ in 1..MapKind::ALL.len() {
        show(&app);
        app.apply(Action::NextMap);
    }
    assert_eq!(app.map(), MapKind::default());
    app.apply(Action::Zoom);
    insta::assert_snapshot!("map_whole_domain", text(&app, 120, 36));
    app.apply(Action::Zoom);
    let mut warm = Frame::clone(app.frame().unwrap());
    warm.film_rise_k = warm.pressure_pa.iter().map(|p| p * 1e-8).collect();
    warm.metrics.flash_temperature_k = Some(17.5);
    app.take_frame(Arc::new(warm));
    while app.map() != MapKind::Temperature {
        app.apply(Action::NextMap);
    }
    show(&app);
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
    app.apply(Action::Lessons);
    insta::assert_snapshot!("lessons_80x24", text(&app, 80, 24));
    app.apply(Action::Typical(0));
    insta::assert_snapshot!("lesson_asks_80x24", text(&app, 80, 24));
    app.apply(Action::NextBeat);
    insta::assert_snapshot!("lesson_80x24", text(&app, 80, 24));
    insta::assert_snapshot!("lesson_160x48", text(&app, 160, 48));
}

#[test]
fn other_readings() {
    let mut app = running(plain());
    app.apply(Action::PointQuantity);
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
        with(&[Action::Scene]),
        with(&[Action::OperatingPoint]),
        with(&[Action::OperatingPoint, Action::ChooseNext, Action::Type]),
        with(&[Action::OperatingPoint, Action::OperatingPoint]),
        with(&[Action::Lessons]),
        with(&[Action::Lessons, Action::Enter]),
        with(&[Action::Lessons, Action::Enter, Action::NextBeat]),
        with(&[Action::Enter]),
        with(&[Action::Focus(PanelKind::Life), Action::Enter]),
        with(&[Action::Focus(PanelKind::Knobs), Action::Enter]),
        with(&[Action::Focus(PanelKind::CentreLine), Action::Enter]),
        with(&[
            Action::Focus(PanelKind::Point),
            Action::Enter,
            Action::PointQuantity,
        ]),
        with(&[Action::StepBack, Action::Probe(0.0, 0.0)]),
    ]
}

#[test]
fn ascii_terminals_get_ascii_only() {
    for app in many(theme(ColorDepth::Indexed, Glyphs::Ascii)) {
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
    // A fixed scramble that does not come round again.
    for i in 0..4000_usize {
        let action = actions[scramble(i as u64) as usize % actions.len()];
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
    assert_eq!(app.apply(Action::Enter), [], "what has no plan is not run");
    insta::assert_snapshot!("scene_refused_80x24", text(&app, 80, 24));
    for _ in 0..12 {
        app.apply(Action::Turn(1));
    }
    let effects = app.apply(Action::Enter);
    let [Effect::Rebuild(next, name)] = &effects[..] else {
        panic!("{effects:?}");
    };
    let Surface::Sinusoid { wavelength_x_m, .. } = next.body_1.surface else {
        panic!("body 1 is a wave");
    };
    assert!(wavelength_x_m.is_infinite(), "ridges along the motion");
    assert_eq!(name, "demonstration", "its files bear its name");
}

/// The operating point as numbers: typed in the units that are shown, refused by key, value and range, run by Enter.
#[test]
fn an_operating_point_is_typed_judged_and_run() {
    let mut app = running(plain());
    app.apply(Action::OperatingPoint);
    for (width, height) in [(60, 20), (80, 24), (120, 36), (160, 48), (200, 60)] {
        let name = format!("operating_point_{width}x{height}");
        insta::assert_snapshot!(name, text(&app, width, height));
    }
    let type_in = |app: &mut App, number: &str| {
        assert_eq!(app.apply(Action::Type), []);
        assert!(app.is_typing(), "digits are letters now");
        for letter in number.chars() {
            app.apply(Action::Letter(letter));
        }
    };
    app.apply(Action::OperatingPoint);
    for (width, height) in [(60, 20), (80, 24), (160, 48)] {
        let name = format!("as_on_drawings_{width}x{height}");
        insta::assert_snapshot!(name, text(&app, width, height));
    }
    app.apply(Action::OperatingPoint);
    assert!(!text(&app, 80, 24).contains("as on drawings"), "closed");
    app.apply(Action::OperatingPoint);
    // The radius along the motion, in mm.
    app.apply(Action::ChooseNext);
    type_in(&mut app, "12.5");
    insta::assert_snapshot!("operating_point_typed_60x20", text(&app, 60, 20));
    assert_eq!(
        app.apply(Action::Enter),
        [],
        "the number is set, nothing runs"
    );
    // One below the range of its key.
    app.apply(Action::ChooseNext);
    type_in(&mut app, "1e-9");
    app.apply(Action::Enter);
    let refused = text(&app, 60, 20);
    for part in ["contact.ry_m", "1e-12", "1e-6 to 100 m"] {
        assert!(refused.contains(part), "{part} in\n{refused}");
    }
    insta::assert_snapshot!("operating_point_refused_80x24", text(&app, 80, 24));
    assert_eq!(app.apply(Action::Enter), [], "read, and not run");
    // The last row is seen where not all fit, and a form that is left forgets the number, not the draft.
    app.apply(Action::ChoosePrevious);
    app.apply(Action::ChoosePrevious);
    app.apply(Action::ChoosePrevious);
    assert!(text(&app, 60, 20).contains("wavelength 2"));
    type_in(&mut app, "9");
    app.apply(Action::Close);
    assert!(!app.is_typing());
    app.apply(Action::Scene);
    app.apply(Action::OperatingPoint);
    let effects = app.apply(Action::Enter);
    let [Effect::Rebuild(next, _)] = &effects[..] else {
        panic!("{effects:?}");
    };
    assert_eq!(next.contact.rx_m, 0.0125);
    assert_ne!(next.contact.ry_m, Some(1e-12));
    // A preset by its digit, and Escape drops all.
    app.apply(Action::Scene);
    app.apply(Action::Typical(2));
    assert!(text(&app, 80, 24).contains("ball_bearing"));
    assert_eq!(app.apply(Action::Close), []);
    assert!(!text(&app, 80, 24).contains("ball_bearing"));
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
fn the_life_of_a_replay_is_that_of_its_whole_period() {
    let mut app = running(plain());
    let mut period = settled(&State::default());
    let last = Arc::get_mut(period.frames.last_mut().unwrap()).unwrap();
    last.metrics.life.as_mut().unwrap().life_relative = 0.123;
    app.take_settled(Some(Arc::new(period)));
    app.advance(Duration::from_millis(100));
    let on_screen = app.frame().unwrap().metrics.life.unwrap();
    assert_ne!(on_screen.life_relative, 0.123, "not its last frame");
    assert_eq!(app.life().unwrap().life_relative, 0.123);
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
    // Where rows are few the enlarged life gives those of its factors to what the key chose.
    app.apply(Action::Focus(PanelKind::Life));
    app.apply(Action::Enter);
    insta::assert_snapshot!("enlarged_map_of_lives_80x24", text(&app, 80, 24));
    app.apply(Action::Enter);
    app.apply(Action::Curve);
    app.apply(Action::Curve);
    // Another load is another curve, from the key press on; back again it is the old one.
    assert_eq!(dots(&app), before + 3);
    app.apply(Action::Choose(1));
    app.apply(Action::Turn(1));
    assert_eq!(dots(&app), 1, "the legend's own");
    app.apply(Action::Turn(-1));
    assert_eq!(dots(&app), before + 3);
}

/// The terminal's own pixels show what half blocks show: with one by two of them to a cell it is the same, colour
/// by colour, and the mark of the material point. What lies over it brings the blocks back.
#[test]
fn maps_in_pixels_are_the_maps_in_blocks() {
    let screen = Rect::new(0, 0, 120, 36);
    let mut app = running(theme(ColorDepth::True, Glyphs::Unicode));
    for _ in MapKind::ALL {
        app.set_medium(Medium::Terminal);
        let blocks = buffer(&app, 120, 36);
        assert_eq!(view::picture_area(&app, screen), None);
        app.set_medium(Medium::Page);
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
                _ => {
                    // White on the picture, too.
                    let white = Color::Rgb(255, 255, 255);
                    assert!(pixel(2 * y) == white || pixel(2 * y + 1) == white);
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
