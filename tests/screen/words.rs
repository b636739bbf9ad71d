//! What the explorer says: nothing that is not so, nothing that is cut, and nothing that is waited for in vain.
#![cfg(feature = "tui")]
#![expect(clippy::unwrap_used, reason = "tests")]

use std::sync::Arc;
use std::time::Duration;

use crate::common::tui_fixture::{
    self, State, app, buffer, frame, plain, play, running, scene, settled, setup_of, text, theme,
};
use asperity_engine::scene::CycleBasis;
use asperity_engine::sim::{Frame, LubricationRegime, Metrics, Repeat, Rhythm, Stage};
use asperity_explorer::tui::action::Action;
use asperity_explorer::tui::app::{App, ErrandKind};
use asperity_explorer::tui::theme::{ColorDepth, Contrast, Glyphs, Theme};
use ratatui::style::Color;

/// Lets the app take a frame of the fixture with other metrics.
fn take(app: &mut App, step: u64, change: impl FnOnce(&mut Metrics)) {
    let mut next = Frame::clone(&frame(step, &State::default()));
    change(&mut next.metrics);
    app.tick(Duration::from_millis(17 * step));
    app.take_frame(Arc::new(next));
}

#[test]
fn a_title_with_numbers_goes_when_a_knob_is_turned() {
    let mut app = running(plain());
    let top = |app: &App| text(app, 160, 48).lines().next().unwrap().to_owned();
    assert!(top(&app).contains(&scene().title), "{}", top(&app));
    app.apply(Action::Turn(1));
    assert!(!top(&app).contains(&scene().title), "{}", top(&app));
    assert!(
        top(&app).contains("demonstration, changed: S"),
        "{}",
        top(&app)
    );
}

#[test]
fn a_knob_that_the_scene_moves_is_not_said_to_be_turned() {
    let mut app = App::new(setup_of(scene()), Vec::new(), plain());
    take(&mut app, 1, |metrics| metrics.slide_roll_target = 1.0);
    let top = text(&app, 160, 48).lines().next().unwrap().to_owned();
    assert!(top.contains("demonstration, changed: S"), "{top}");
}

#[test]
fn a_long_message_is_whole_on_every_screen() {
    let advice = "no Rerun viewer (`rerun`) on the PATH to show recordings/demonstration-001.rrd; the viewer is a \
                  program of its own; get it by one of\n  pip install rerun-sdk==0.36.3\n  cargo install rerun-cli \
                  --locked --version 0.36.3\nand see that `rerun` is on the PATH";
    let mut app = running(plain());
    app.say(advice);
    for (width, height) in [(60, 20), (80, 24), (160, 48)] {
        let shown = text(&app, width, height);
        for word in advice.split_whitespace() {
            assert!(shown.contains(word), "{word} at {width}:\n{shown}");
        }
    }
    app.tick(Duration::from_mins(1));
    assert!(!text(&app, 80, 24).contains("cargo install"));
}

#[test]
fn the_light_contrast_brings_its_own_paper() {
    for depth in [ColorDepth::True, ColorDepth::Indexed] {
        let mut light = theme(depth, Glyphs::Unicode);
        light.contrast = Contrast::Light;
        for app in [app(light), running(light)] {
            let buffer = buffer(&app, 120, 36);
            for cell in buffer.content() {
                assert!(cell.bg != Color::Reset && cell.fg != Color::Reset);
            }
        }
        let own = buffer(&running(Theme::new(light.capabilities)), 120, 36);
        assert!(own.content().iter().any(|cell| cell.bg == Color::Reset));
    }
}

#[test]
fn a_scene_without_life_or_oil_says_so() {
    let mut bare = scene();
    bare.life = None;
    bare.lubricant = None;
    let mut app = App::new(setup_of(bare), vec![ErrandKind::Rebuild], plain());
    let started = text(&app, 80, 24);
    assert!(started.contains("starting: dry Hertz") && !started.contains("then film"));
    take(&mut app, 1, |metrics| {
        metrics.life = None;
        metrics.lambda_ratio = None;
        metrics.regime = LubricationRegime::Dry;
    });
    for (width, height) in [(80, 24), (160, 48)] {
        let shown = text(&app, width, height);
        assert!(shown.contains("no life in this scene"), "{shown}");
        assert!(shown.contains("dry"), "{shown}");
        for waited in ["settling", "not simulated yet", "no estimate"] {
            assert!(!shown.contains(waited), "{waited} in\n{shown}");
        }
    }
}

#[test]
fn a_body_that_stands_is_named() {
    for (slide_roll, body) in [(2.0, 1), (-2.0, 2)] {
        let mut app = running(plain());
        let state = State {
            slide_roll,
            slide_roll_target: slide_roll,
            ..State::default()
        };
        play(&mut app, 97..=98, &state);
        let shown = text(&app, 160, 48);
        assert!(shown.contains(&format!("body {body} stands")), "{shown}");
    }
}

/// By damage the standing body's cycles count as far as they come (`life.md`); by the paper's count it has no life.
#[test]
fn what_a_standing_body_means_follows_the_count() {
    let state = State {
        slide_roll: 2.0,
        slide_roll_target: 2.0,
        ..State::default()
    };
    for (cycles, said, not_said) in [
        (
            CycleBasis::Damage,
            "its cycles never end",
            ["not in the life", "not counted"],
        ),
        (
            CycleBasis::Global,
            "its life is not counted",
            ["never end", "never end"],
        ),
    ] {
        let mut scene = scene();
        scene.life = scene
            .life
            .map(|life| asperity_engine::scene::Life { cycles, ..life });
        let mut app = App::new(setup_of(scene), vec![ErrandKind::Rebuild], plain());
        play(&mut app, 97..=98, &state);
        for (width, height) in [(160, 48), (80, 24)] {
            let shown = text(&app, width, height);
            assert!(shown.contains(said), "{cycles:?}: {shown}");
            assert!(
                not_said.iter().all(|word| !shown.contains(word)),
                "{cycles:?}: {shown}"
            );
        }
    }
}

/// A factor of 28 between the choices of count is no small print.
#[test]
fn the_range_of_the_choices_is_on_the_screen() {
    let mut app = running(plain());
    take(&mut app, 97, |metrics| {
        let life = metrics.life.as_mut().unwrap();
        (life.detail.spread_low, life.detail.spread_high) = (0.025, 0.7);
        life.detail.variants = 9;
    });
    let shown = text(&app, 160, 48);
    assert!(shown.contains("choices 0.025–0.70"), "{shown}");
}

/// On a narrow screen what does not fit is left away whole: neither half a load nor two ends of a scale in one.
#[test]
fn no_number_is_cut_on_a_narrow_screen() {
    let app = running(plain());
    let shown = text(&app, 70, 60);
    assert!(shown.contains("against 800 N"), "{shown}");
    assert!(!shown.contains("the scene's 80"), "{shown}");
    assert!(!shown.contains("1e1"), "{shown}");
}

/// A plan that is longer than the screen can be read to its end.
#[test]
fn a_long_plan_is_scrolled() {
    let mut setup = setup_of(scene());
    let lines = (1..=40).map(|n| format!("  stage {n}: {}", "because of this and that ".repeat(5)));
    setup.plan_text = lines.collect::<Vec<_>>().join("\n");
    for (width, height) in [(60, 20), (160, 48)] {
        let mut app = App::new(setup.clone(), vec![ErrandKind::Rebuild], plain());
        app.apply(Action::Plan);
        let shown = text(&app, width, height);
        assert!(
            shown.contains("for more") && !shown.contains("stage 40:"),
            "{shown}"
        );
        (0..200).for_each(|_| drop(app.apply(Action::ChooseNext)));
        let shown = text(&app, width, height);
        assert!(shown.contains("stage 40:"), "{shown}");
    }
}

#[test]
fn what_is_written_of_a_point_holds_a_whole_crossing() {
    let mut app = running(plain());
    play(&mut app, 97..=260, &State::default());
    let shown = app.shown().unwrap();
    let (_, table) = shown
        .tables
        .iter()
        .find(|(name, _)| *name == "material_point.csv")
        .unwrap();
    let rows: Vec<Vec<f64>> = table
        .lines()
        .skip(1)
        .map(|row| row.split(',').map(|cell| cell.parse().unwrap()).collect())
        .collect();
    let of = |crossing: f64| {
        rows.iter()
            .filter(move |row| row[0] == crossing)
            .map(|row| row[3])
    };
    assert!(table.starts_with("crossing,body,depth_m,x_m,"), "{table}");
    let whole: Vec<f64> = of(0.0).collect();
    let a_m = tui_fixture::A_M;
    assert!(whole[0] < -a_m && *whole.last().unwrap() > a_m, "{whole:?}");
    assert!(of(1.0).count() > 0, "the present one, too");
}

#[test]
fn a_single_step_that_did_not_converge_can_be_read_with_its_reason() {
    let mut app = running(plain());
    take(&mut app, 97, |metrics| {
        metrics.converged = false;
        metrics.residual = 1e-5;
        metrics.overlap_m = 3e-10;
    });
    // Solved within the tolerance: it is the overlap that is wrong, and two frames later it is still told.
    play(&mut app, 98..=99, &State::default());
    for (width, height) in [(80, 24), (160, 48)] {
        let shown = text(&app, width, height);
        let told = "STEP 97 NOT CONVERGED: surfaces overlap by 0.30 nm; e, Enter: wider domain";
        assert!(shown.contains(told), "{shown}");
    }
    play(&mut app, 100..=300, &State::default());
    assert!(!text(&app, 160, 48).contains("NOT CONVERGED"));
}

#[test]
fn a_replay_is_no_part_of_the_runs_pace() {
    let mut app = running(plain());
    let pace = app.steps_per_s().unwrap();
    assert!((pace / 59.0 - 1.0).abs() < 0.1, "{pace}");
    app.take_settled(Some(Arc::new(settled(&State::default()))));
    app.tick(Duration::from_secs(100));
    assert!(app.steps_per_s().is_none(), "it stands");
    app.apply(Action::Turn(1));
    for step in 0..20 {
        app.tick(Duration::from_secs(100) + Duration::from_millis(17 * step));
        app.take_frame(Arc::new(Frame {
            stage: Stage::Passage,
            step: 97 + step,
            ..Frame::clone(&frame(97 + step, &State::default()))
        }));
    }
    let pace = app.steps_per_s().unwrap();
    assert!((pace / 59.0 - 1.0).abs() < 0.1, "{pace}");
}

#[test]
fn a_replay_that_is_not_there_yet_is_told_from_one_that_never_comes() {
    let asked = |rhythm: Option<Rhythm>| {
        let mut app = running(plain());
        take(&mut app, 97, |metrics| {
            metrics.repeat = rhythm.map(|rhythm| Repeat {
                rhythm,
                period_s: 4e-3,
                drift: Some(1e-3),
                repeats: true,
            });
        });
        app.apply(Action::Replay);
        app.message().unwrap().to_owned()
    };
    assert!(asked(None).contains("does not repeat"));
    assert!(asked(Some(Rhythm::Orbit)).contains("one whole period is gathered"));
    assert!(asked(Some(Rhythm::Steady)).contains("nothing changes"));
    assert!(asked(Some(Rhythm::Statistics)).contains("means"));
}
