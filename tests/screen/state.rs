//! What keys, mouse and news from the run do to the explorer's state, and what it asks for: also news that comes
//! late (an orbit that was left, a sweep of other knobs).
#![cfg(feature = "tui")]
#![expect(clippy::unwrap_used, reason = "tests")]

use std::sync::Arc;
use std::time::Duration;

use crate::common::tui_fixture::{
    self, State, buffer, found, mouse, plain, play, running, scene, sent, settled, setup_of, text,
};
use asperity_engine::math::number::sig;
use asperity_engine::scene::{CycleBasis, Event, Scene, Surface};
use asperity_engine::sim::{AgePoint, CautionCode, Knob};
use asperity_explorer::tui::action::Action;
use asperity_explorer::tui::app::{Across, App, Effect, ErrandKind, Leading};
use asperity_explorer::tui::event::PointerAct;
use asperity_explorer::tui::lessons::{ComparedWith, FILES, Lesson};
use asperity_explorer::tui::view;
use asperity_session::run::{Assumed, Command, Settled};
use asperity_session::sweep::{Along, CurvePoint, Found, Varied};
use ratatui::layout::Rect;

/// The run hears of a knob one step later than the screen, and until then it still tells of the orbit that the
/// knob has ended. Taken back, it would be replayed under the new knobs and the run would stand still.
#[test]
fn a_turned_knob_is_not_taken_back_into_the_orbit_that_it_left() {
    let mut app = running(plain());
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
    let mut app = running(plain());
    app.take_settled(Some(Arc::new(settled(&State::default()))));
    let effects = app.apply(Action::Turn(1));
    assert!(effects.contains(&Effect::EndSweep), "{effects:?}");
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
    assert_eq!(app.leading(), Leading::Scaled);
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
    assert_eq!(app.leading(), Leading::Scaled);
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
    let pinned = app.leading_factors().unwrap();
    assert!((app.against_pinned().unwrap() - 1.0).abs() < 1e-9);
    app.apply(Action::ChooseNext);
    app.apply(Action::TurnFar(1));
    // N ∝ p_h^−(c + 3/e), p_h ∝ F^(1/3); a also adds crests to the count; the same crests stand out less from a
    // greater pressure.
    let pressure = 1.05_f64.powi(5).cbrt();
    let count = |a: f64| 1.0 + 4.4 * a * 0.5 / 0.75;
    let load = pressure.powf(-(31.0 / 3.0 + 2.7));
    let now = app.leading_factors().unwrap();
    assert!((now.load / load - 1.0).abs() < 1e-9, "{now:?}");
    let peaks = now.peak / pinned.peak;
    assert!((1.0..2.0).contains(&peaks), "{peaks}");
    let expected = load * peaks * count(1.0) / count(pressure);
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
    assert!(app.message().unwrap().contains("nothing can be exported"));
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
    let mut app = App::new(setup_of(smooth), vec![ErrandKind::Rebuild], plain());
    app.apply(Action::Choose(2));
    assert_eq!(app.apply(Action::Turn(1)), []);
    assert!(app.message().unwrap().contains("smooth"));
}

/// The scene that effects ask for.
fn staged(effects: &[Effect]) -> Scene {
    let [Effect::Rebuild(staged, _)] = effects else {
        panic!("{effects:?}");
    };
    (**staged).clone()
}

#[test]
fn a_lesson_asks_shows_tells_moves_on_and_returns() {
    let mut app = running(plain());
    app.apply(Action::Turn(1));
    app.apply(Action::Lessons);
    assert!(text(&app, 80, 24).contains("One asperity, one passage"));
    let asked = sent(&app.apply(Action::Enter));
    // The words of the lesson go to the run, and so to the recording.
    assert!(matches!(&asked[..], [Command::Say(words)] if words.contains("How often")));
    let first = text(&app, 160, 48);
    assert!(
        first.contains("1/13 One asperity, one passage (1/2)") && first.contains("1 once"),
        "{first}"
    );
    assert!(
        !first.contains("counted₁"),
        "the answer is not shown yet: {first}"
    );
    // However late it gets, a question waits; a digit that is no answer is none.
    play(&mut app, 97..=900, &State::default());
    assert_eq!(app.apply(Action::Typical(6)), []);
    assert!(text(&app, 160, 48).contains("1 once"));
    let scene_1 = staged(&app.apply(Action::Typical(1)));
    assert_eq!(scene_1.motion.slide_roll, 0.0);
    assert_eq!(scene_1.body_2.surface, Surface::Smooth {});
    let shown = sent(&app.rebuilt(setup_of(scene_1)));
    assert!(matches!(&shown[0], Command::Say(words) if words.contains("Follow the diamond")));
    let rolling = State {
        slide_roll: 0.0,
        slide_roll_target: 0.0,
        ..State::default()
    };
    // A passage is 128 steps; the first beat lasts one and a half.
    play(&mut app, 1..=190, &rolling);
    assert!(!text(&app, 160, 48).contains("You said"));
    play(&mut app, 191..=200, &rolling);
    let told = text(&app, 160, 48);
    // The fixture counts n - 0.2.
    assert!(told.contains("You said “once by each ridge"), "{told}");
    assert!(told.contains("counted₁ 0.800, “once”"), "{told}");
    // Then time to read it, unless a key asks for more: on, and back to the question.
    play(&mut app, 201..=210, &rolling);
    assert!(text(&app, 160, 48).contains("(1/2)"));
    play(&mut app, 800..=810, &rolling);
    assert!(text(&app, 160, 48).contains("(2/2)"));
    app.apply(Action::PreviousBeat);
    assert!(text(&app, 160, 48).contains("1 once"));
    app.apply(Action::NextBeat);
    app.apply(Action::NextBeat);
    assert!(text(&app, 160, 48).contains("(2/2)"), "nothing to tell yet");
    // The next lesson has a scene of its own.
    let flanks = staged(&app.apply(Action::NextBeat));
    assert_eq!(flanks.motion.slide_roll, 0.0);
    app.rebuilt(setup_of(flanks));
    // Leaving it brings the scene back as it was turned to.
    let own = staged(&app.apply(Action::EndTour));
    assert_eq!(own.title, scene().title);
    assert!((own.motion.slide_roll - 0.55).abs() < 1e-9);
    app.rebuilt(setup_of(own));
    assert!(!text(&app, 160, 48).contains("One asperity"));
    assert_eq!(app.apply(Action::NextBeat), []);
}

/// What a press on the last place of `words` does, so many cells into them.
fn pressed(app: &App, (width, height): (u16, u16), words: &str, into: usize) -> Option<Action> {
    let screen = text(app, width, height);
    let rows = screen.lines().enumerate();
    let found =
        rows.filter_map(|(y, row)| Some((y, row.find(words).map(|at| row[..at].chars().count())?)));
    let (y, x) = found
        .last()
        .unwrap_or_else(|| panic!("{words} in\n{screen}"));
    let at = ((x + into) as u16, y as u16);
    let screen = Rect::new(0, 0, width, height);
    view::pointed(app, screen, mouse(PointerAct::Press, at.0, at.1))
}

const SCREENS: [(u16, u16); 3] = [(80, 24), (160, 48), (60, 20)];

#[test]
fn answers_and_what_a_lesson_offers_can_be_pressed() {
    for screen in SCREENS {
        let mut app = running(plain());
        app.apply(Action::Lessons);
        app.apply(Action::Typical(0));
        // The second answer, by its number and in its words.
        for (words, into) in [("2 once", 0), ("2 once", 4)] {
            assert_eq!(
                pressed(&app, screen, words, into),
                Some(Action::Typical(1)),
                "{screen:?}: {words}"
            );
        }
        assert_eq!(pressed(&app, screen, "How often", 2), None);
        assert_eq!(pressed(&app, screen, "n show", 2), Some(Action::NextBeat));
        let scene_1 = staged(&app.apply(Action::Typical(0)));
        app.rebuilt(setup_of(scene_1));
        for (words, action) in [
            ("n on", Action::NextBeat),
            ("N back", Action::PreviousBeat),
            ("T ends", Action::EndTour),
        ] {
            assert_eq!(
                pressed(&app, screen, words, 1),
                Some(action),
                "{screen:?}: {words}"
            );
        }
    }
}

/// By the mouse from beat to beat: every answer of every question stands on every screen and is its own button.
#[test]
fn every_lesson_is_played_by_the_mouse() {
    let stage = |app: &mut App, effects: Vec<Effect>| {
        for effect in effects {
            if let Effect::Rebuild(scene, _) = effect {
                app.rebuilt(setup_of(*scene));
            }
        }
    };
    let (mut asked, mut waited) = (0, 0);
    for (place, (name, file)) in FILES.into_iter().enumerate() {
        let lesson = Lesson::from_toml(file, name).unwrap();
        let mut app = running(plain());
        app.apply(Action::Lessons);
        for _ in 0..place {
            app.apply(Action::ChooseNext);
        }
        let begins = app.apply(Action::Enter);
        stage(&mut app, begins);
        for (beat, shown) in lesson.beats.iter().enumerate() {
            let of = format!("({}/{})", beat + 1, lesson.beats.len());
            assert!(text(&app, 160, 48).contains(&of), "{name}: {of}");
            if let Some(question) = &shown.question {
                for (k, answer) in question.answers.iter().enumerate() {
                    let words: Vec<_> = answer.split(' ').take(1).collect();
                    let words = format!("{} {}", k + 1, words[0]);
                    for screen in SCREENS {
                        assert_eq!(
                            pressed(&app, screen, &words, 0),
                            Some(Action::Typical(k)),
                            "{name}, {screen:?}: {answer}"
                        );
                    }
                }
                asked += 1;
                let shows = app.apply(Action::Typical(question.answers.len() - 1));
                stage(&mut app, shows);
                assert!(!text(&app, 160, 48).contains("n show"), "{name} {of}");
            }
            let on = pressed(&app, SCREENS[1], " n on ", 2);
            assert_eq!(on, Some(Action::NextBeat), "{name} {of}");
            if beat + 1 < lesson.beats.len() {
                let next = app.apply(Action::NextBeat);
                stage(&mut app, next);
            }
            if text(&app, 160, 48).contains(&of) && beat + 1 < lesson.beats.len() {
                // What is compared with this waits until this is known, or will not be.
                let asks = lesson.beats[beat + 1].question.as_ref();
                assert!(asks.is_some_and(|asks| asks.measure.over == ComparedWith::Before));
                waited += 1;
                let steps = (6.0 * shown.passages * 128.0) as u64;
                play(&mut app, 1..=steps + 1, &State::default());
                if text(&app, 160, 48).contains(&of) {
                    let next = app.apply(Action::NextBeat);
                    stage(&mut app, next);
                }
            }
        }
    }
    assert!(asked >= 15, "{asked}");
    assert!(waited >= 3, "{waited}");
}

#[test]
fn one_key_counts_the_other_way_and_back() {
    let mut app = running(plain());
    let cycles = |app: &mut App| {
        let scene = staged(&app.apply(Action::OtherCount));
        app.rebuilt(setup_of(scene.clone()));
        scene.life.unwrap().cycles
    };
    // The fixture's scene has the paper's.
    assert_eq!(cycles(&mut app), CycleBasis::Damage);
    assert_eq!(cycles(&mut app), CycleBasis::Global);
    app.apply(Action::Lessons);
    app.apply(Action::Typical(0));
    assert_eq!(
        app.apply(Action::OtherCount),
        [],
        "a lesson keeps its count"
    );
}

/// A jump is added to the curve, one that comes again replaces the last, another mesh begins anew.
#[test]
fn one_key_ages_the_surfaces_and_makes_them_new() {
    let mut app = running(plain());
    let shown = |app: &App, words: &str| text(app, 160, 48).contains(words);
    assert!(!shown(&app, "over cycles"));
    let scene = staged(&app.apply(Action::Age));
    assert!(scene.wear.is_some() && scene.age.is_some());
    app.rebuilt(setup_of(scene));
    for (step, cycles, life) in [
        (1, 0.0, "0.10"),
        (2, 1e3, "0.20"),
        (3, 1e3, "0.21"),
        (4, 2e4, "0.40"),
        (5, 0.0, "0.15"),
    ] {
        let mut frame = tui_fixture::frame(step, &State::default());
        frame.age = Some(AgePoint {
            cycles,
            life_relative: Some(life.parse().unwrap()),
            lambda_ratio: Some(4.0 + life.parse::<f64>().unwrap()),
            ..AgePoint::default()
        });
        app.take_frame(frame.into());
        // Header and status have that of the worn surfaces.
        let lambda = format!("λ {}", sig(4.0 + life.parse::<f64>().unwrap(), 2));
        assert_eq!(text(&app, 160, 48).matches(&lambda).count(), 2, "{lambda}");
        assert!(shown(&app, "life over cycles"));
        let now = format!("{life} at {} cycles", sig(cycles, 2));
        assert!(shown(&app, &now), "{now}\n{}", text(&app, 160, 48));
    }
    app.apply(Action::Curve);
    assert!(shown(&app, "Rq over cycles"));
    let faster = staged(&app.apply(Action::ReplayFaster(1)));
    assert!((faster.age.unwrap().tolerance - 0.1).abs() < 1e-9);
    app.rebuilt(setup_of(faster));
    // A jump errs by a tenth at most.
    assert!(app.apply(Action::ReplayFaster(1)).is_empty());
    assert!(shown(&app, "age.tolerance"), "{}", text(&app, 160, 48));
    let slower = staged(&app.apply(Action::ReplayFaster(-2)));
    assert!((slower.age.unwrap().tolerance - 0.004).abs() < 1e-9);
    let scene = staged(&app.apply(Action::Age));
    assert!(scene.wear.is_none() && scene.age.is_none());
    app.rebuilt(setup_of(scene));
    assert!(shown(&app, "life against S"));
}

/// The knobs of the first lesson's scene.
fn of_lesson_1() -> State {
    State {
        speed_m_s: 0.2,
        amplitude_1_m: 5e-7,
        amplitude_2_m: 0.0,
        ..State::default()
    }
}

#[test]
fn what_was_answered_right_is_said() {
    let mut app = running(plain());
    app.apply(Action::Lessons);
    app.apply(Action::Typical(0));
    let scene_1 = staged(&app.apply(Action::Typical(0)));
    app.rebuilt(setup_of(scene_1));
    let state = |slide_roll: f64| State {
        slide_roll,
        slide_roll_target: slide_roll,
        ..of_lesson_1()
    };
    play(&mut app, 1..=200, &state(0.0));
    assert!(text(&app, 80, 24).contains("Right: counted₁ 0.800"));
    // The simulation says what is right, not the file: where it counts otherwise, another answer is.
    app.apply(Action::PreviousBeat);
    app.apply(Action::Typical(0));
    play(&mut app, 200..=500, &state(0.5));
    let told = text(&app, 160, 48);
    assert!(
        told.contains("You said “once”; it is counted₁ 3.73"),
        "{told}"
    );
}

/// A number of another experiment is no verdict, and neither is one that is taken while a knob is under way.
#[test]
fn a_verdict_waits_for_the_knobs_and_refuses_foreign_ones() {
    let mut app = running(plain());
    app.apply(Action::Lessons);
    app.apply(Action::Enter);
    let own = staged(&app.apply(Action::Typical(1)));
    app.rebuilt(setup_of(own));
    let at = |slide_roll, slide_roll_target| State {
        slide_roll,
        slide_roll_target,
        ..of_lesson_1()
    };
    // Still rolling to a stop, long after its passages.
    play(&mut app, 1..=400, &at(0.1, 0.0));
    assert!(!text(&app, 160, 48).contains("it is"), "on the way");
    app.apply(Action::NextBeat);
    assert!(text(&app, 160, 48).contains("still on their way"));
    // There, but the average is that of the way.
    let moving = State {
        settled: false,
        ..at(0.0, 0.0)
    };
    play(&mut app, 401..=450, &moving);
    assert!(!text(&app, 160, 48).contains("it is"), "still moving");
    // Somebody turns S.
    app.apply(Action::Turn(1));
    play(&mut app, 401..=500, &at(0.05, 0.05));
    let told = text(&app, 160, 48);
    assert!(
        told.contains("No verdict: S slide-to-roll was turned"),
        "{told}"
    );
    assert!(!told.contains("You said"), "{told}");
    // The question comes again, and its answer puts the knob back.
    app.apply(Action::PreviousBeat);
    app.apply(Action::Typical(1));
    play(&mut app, 551..=950, &at(0.0, 0.0));
    let told = text(&app, 160, 48);
    assert!(told.contains("You said"), "{told}");
}

/// The sixth lesson's first beat asks nothing: it moves on by time, but not while the run stands.
#[test]
fn a_paused_run_stops_the_lesson() {
    for pauses in [false, true] {
        let mut app = running(plain());
        app.apply(Action::Lessons);
        let load = staged(&app.apply(Action::Typical(5)));
        app.rebuilt(setup_of(load));
        play(&mut app, 1..=300, &State::default());
        assert!(text(&app, 80, 24).contains("(1/4)"), "it is still read");
        if pauses {
            app.apply(Action::TogglePause);
        }
        play(&mut app, 900..=901, &State::default());
        let shown = text(&app, 80, 24);
        assert_eq!(shown.contains("(2/4)"), !pauses, "{shown}");
    }
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
    let areas = view::Areas::of(screen, 0).unwrap();
    let down = PointerAct::Press;
    let (column, row) = (areas.point.x + areas.point.width / 2, areas.point.y + 3);
    let action = view::pointed(&app, screen, mouse(down, column, row));
    assert!(matches!(action, Some(Action::PutPoint(_))), "{action:?}");
}

/// A state to go on from: the explorer only hands it on.
fn state() -> asperity_engine::sim::State {
    use asperity_engine::plan::Plan;
    let sets = ["grid.nodes=65", "stress.depths=8"].map(|set| set.parse().unwrap());
    let scene = Scene::load_with("demonstration_quick", &sets).unwrap();
    let plan = Plan::new(&scene).unwrap();
    asperity_engine::sim::Simulation::new(&scene, plan, 1)
        .unwrap()
        .save()
}

/// A curve asks for what it lacks: S along life, then the speed along Stribeck's.
#[test]
fn a_curve_is_filled_in_when_it_is_shown() {
    let mut app = running(plain());
    let ordered = |effects: &[Effect]| {
        let orders = effects.iter().filter_map(|effect| match effect {
            Effect::Sweep(order) => Some((order.varied, order.values.clone())),
            _ => None,
        });
        orders.collect::<Vec<_>>()
    };
    let orbit = Arc::new(Settled {
        state: Some(state()),
        ..settled(&State::default())
    });
    let [(Varied::Along(Along::SlideRoll), values)] = &ordered(&app.take_settled(Some(orbit)))[..]
    else {
        panic!("no order");
    };
    assert!(values.contains(&0.0) && values.contains(&-1.75) && !values.contains(&0.5));
    app.take_swept(vec![found(0.0, 1.0, 0.6)], Some((1, values.len())));
    assert_eq!(
        ordered(&app.apply(Action::Curve)),
        [],
        "friction comes with it"
    );
    let [(Varied::Along(Along::Entrainment), speeds)] = &ordered(&app.apply(Action::Curve))[..]
    else {
        panic!("no order");
    };
    // Four to a decade around the scene's own speed, which the run has.
    assert_eq!(speeds.len(), 8);
    assert!(speeds.contains(&0.1) && speeds.contains(&10.0));
    app.apply(Action::Curve);
    app.apply(Action::Curve);
    let [(Varied::Along(Along::SlideRoll), rest)] = &ordered(&app.apply(Action::Curve))[..] else {
        panic!("no order");
    };
    assert_eq!(rest.len(), values.len() - 1, "what is there is kept");
}

/// On the last mesh, once the curve is done: the life at other phases of surfaces that roll, until a knob is turned.
#[test]
fn what_the_scene_assumes_is_varied_after_the_last_mesh() {
    let rolls = State {
        slide_roll: 0.0,
        slide_roll_target: 0.0,
        ..State::default()
    };
    let mut rolling = scene();
    rolling.motion.slide_roll = 0.0;
    let mut app = App::new(setup_of(rolling), vec![ErrandKind::Rebuild], plain());
    play(&mut app, 1..=96, &rolls);
    let orders = |effects: &[Effect]| {
        let orders = effects.iter().filter_map(|effect| match effect {
            Effect::Sweep(order) => Some((order.varied, order.values.len())),
            _ => None,
        });
        orders.collect::<Vec<_>>()
    };
    let on_mesh = |is_last| {
        let mut settled = settled(&rolls);
        for frame in &mut settled.frames {
            Arc::make_mut(frame).grounds.has_life = true;
        }
        Some(Arc::new(Settled {
            state: Some(state()),
            is_last,
            ..settled
        }))
    };
    let [(Varied::Along(Along::SlideRoll), all)] = orders(&app.take_settled(on_mesh(false)))[..]
    else {
        panic!("no curve");
    };
    let done = |all| Some((all, all));
    app.take_swept(Vec::new(), Some((0, all)));
    let swept = app.take_swept(Vec::new(), done(all));
    assert_eq!(orders(&swept), [], "the mesh is not the last");
    let phases = (Varied::Assumed(Assumed::Phase), 8);
    assert_eq!(orders(&app.take_settled(on_mesh(true))), [phases]);
    app.take_swept(Vec::new(), Some((0, 8)));
    assert!(text(&app, 200, 48).contains("sweeping phases 0/8"));
    let frame = Arc::clone(app.frame().unwrap());
    let own = frame.metrics.life.unwrap();
    let life = own.life_relative;
    // This mesh is a tenth off, which the band holds beside the phases.
    let lives = [1.0, 0.9, 0.8, 0.7, 0.5, 0.7, 1.5, 1.1].map(|times| 1.1 * life * times);
    let lives = lives.into_iter().enumerate().map(|(choice, life)| Found {
        choice,
        ..found(0.0, 1.0, life)
    });
    let points = app.simulated(Along::SlideRoll).count();
    let then = app.take_swept(lives.collect(), done(8));
    assert_eq!(orders(&then), [], "nothing else is assumed here");
    assert_eq!(app.simulated(Along::SlideRoll).count(), points);
    let told = |app: &App| {
        let cautions = app.cautions();
        let mut phases = cautions
            .iter()
            .filter(|one| one.code == CautionCode::PhaseLocked);
        phases.next().unwrap().text.clone()
    };
    let words = format!("life {} to {} as", sig(0.5 * life, 3), sig(1.5 * life, 3));
    assert!(told(&app).starts_with(&words), "{}", told(&app));
    let band = format!(
        "{}–{}",
        sig(0.5 / 1.1 * own.life_relative_low, 2),
        sig(1.5 * 1.1 * own.life_relative_high, 2)
    );
    let screen = text(&app, 160, 48);
    assert!(screen.contains(&band), "{band}: {screen}");
    app.apply(Action::Turn(1));
    app.apply(Action::Turn(-1));
    let mut again = settled(&rolls);
    Arc::make_mut(&mut again.frames[0]).grounds.has_life = true;
    app.take_frame(Arc::clone(&again.frames[0]));
    assert!(told(&app).starts_with("S = 0"), "{}", told(&app));
}

#[test]
fn captions_of_a_scripted_scene_are_shown() {
    let mut scripted = scene();
    scripted.events.push(Event {
        at_s: 0.0,
        set: std::collections::BTreeMap::new(),
        caption: "Now S = 1.".into(),
    });
    let mut app = App::new(setup_of(scripted), vec![ErrandKind::Rebuild], plain());
    play(&mut app, 1..=5, &State::default());
    assert!(text(&app, 80, 24).contains("Now S = 1."));
    // Half a passage later it has been read.
    play(&mut app, 6..=80, &State::default());
    assert!(!text(&app, 80, 24).contains("Now S = 1."));
}

#[test]
fn the_mouse_moves_sliders_and_reads_the_map() {
    let mut app = running(plain());
    let screen = Rect::new(0, 0, 160, 48);
    let drawn = buffer(&app, 160, 48);
    let handle = |(x, y): &(u16, u16)| *y > 0 && drawn[(*x, *y)].symbol() == "●";
    let mut places = (0..48).flat_map(|y| (0..160).map(move |x| (x, y)));
    let (x, y) = places.find(handle).unwrap();
    let down = PointerAct::Press;
    let action = view::pointed(&app, screen, mouse(down, 2, y)).unwrap();
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
    let drag = PointerAct::Drag;
    let action = view::pointed(&app, screen, mouse(drag, 16, y + 3)).unwrap();
    assert!(matches!(action, Action::Slide(0, part) if part > 0.3));
    // The middle of the map, right of and above its scales, is the middle of the contact.
    let areas = view::Areas::of(screen, 0).unwrap();
    let (column, row) = (
        areas.map.x + (areas.map.width - 8) / 2 + 2,
        areas.map.y + areas.map.height / 2 - 1,
    );
    let action = view::pointed(&app, screen, mouse(down, column, row)).unwrap();
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

/// Where the number comes from, what it is against, and the weightiest caution are read on every screen.
#[test]
fn the_source_of_the_life_and_its_weightiest_caution_fit_small_screens() {
    let new = App::new(setup_of(scene()), vec![ErrandKind::Rebuild], plain());
    let mut live = running(plain());
    let first = live.cautions().first().unwrap().clone();
    for (width, height) in [(80, 24), (100, 30), (160, 48)] {
        let screen = text(&new, width, height);
        assert!(screen.contains("formula"), "{screen}");
        let screen = text(&live, width, height);
        assert!(screen.contains("simulated"), "{screen}");
        assert!(screen.contains("smooth rolling"), "{screen}");
        assert!(screen.contains("load"), "{screen}");
        let more = format!(" +{} i", live.cautions().len() - 1);
        assert!(screen.contains(&more), "{screen}");
    }
    live.apply(Action::Turn(1));
    for (width, height) in [(80, 24), (160, 48)] {
        assert!(text(&live, width, height).contains("scaled"));
    }
    live.apply(Action::Plan);
    assert!(text(&live, 160, 48).contains(&first.text));
}

/// On the first mesh already; once the last has settled in the middle of what bends; what gave nothing is not asked for twice.
#[test]
fn a_curve_is_swept_from_the_first_mesh_on_and_refined_where_it_bends() {
    let mut app = running(plain());
    let ordered = |effects: &[Effect]| {
        let orders = effects.iter().filter_map(|effect| match effect {
            Effect::Sweep(order) => Some(order.values.clone()),
            _ => None,
        });
        orders.flatten().collect::<Vec<_>>()
    };
    let on_mesh = |is_last| {
        let state = Some(state());
        let settled = settled(&State::default());
        Some(Arc::new(Settled {
            state,
            is_last,
            ..settled
        }))
    };
    let values = ordered(&app.take_settled(on_mesh(false)));
    let none = app.take_swept(Vec::new(), Some((0, values.len())));
    assert!(ordered(&none).is_empty());
    assert!(
        ordered(&app.take_settled(on_mesh(false))).is_empty(),
        "under way"
    );
    // All but one of the values: the life falls between S = 0.25 and the run's own 0.5, and nowhere else.
    let own = app.leading_life().unwrap();
    let all = values.iter().filter(|s| **s != -1.75);
    let lives = all.map(|s| found(*s, 1.0, if *s > 0.3 { own } else { 5.0 * own }));
    let done = app.take_swept(lives.collect(), Some((values.len(), values.len())));
    assert!(ordered(&done).is_empty(), "the run still climbs");
    let refined = ordered(&app.take_settled(on_mesh(true)));
    assert_eq!(refined, [0.375]);
    app.take_swept(Vec::new(), Some((0, 1)));
    let then = app.take_swept(vec![found(0.375, 1.0, own)], None);
    assert_eq!(ordered(&then), [0.3125]);
}

/// Row by row, that of the scene first: S along each, another load or other amplitudes for each; a press on a cell turns the knobs there.
#[test]
fn a_map_of_lives_is_swept_row_by_row() {
    let mut app = running(plain());
    let orders = |effects: Vec<Effect>| {
        let orders = effects.into_iter().filter_map(|effect| match effect {
            Effect::Sweep(order) => Some(*order),
            _ => None,
        });
        orders.collect::<Vec<_>>()
    };
    let orbit = Arc::new(Settled {
        state: Some(state()),
        ..settled(&State::default())
    });
    app.take_settled(Some(orbit));
    app.apply(Action::Curve);
    app.apply(Action::Curve);
    for across in [Across::Load, Across::Amplitude] {
        let mut next = orders(app.apply(Action::Curve));
        let (mut rows, mut all) = (Vec::new(), 0);
        while let [order] = &next[..] {
            assert_eq!(order.varied, Varied::Along(Along::SlideRoll));
            let heights =
                [&order.scene.body_1, &order.scene.body_2].map(|body| body.surface.amplitude_m());
            let load_n = order.scene.force_n();
            let times = [load_n / 800.0, heights[0] / 2e-7, heights[1] / 2e-7];
            match across {
                Across::Load => assert_eq!(times[1..], [1.0, 1.0]),
                Across::Amplitude => assert!((times[0] - 1.0).abs() < 1e-9 && times[1] == times[2]),
            }
            let times = if across == Across::Load {
                times[0]
            } else {
                times[1]
            };
            // Lives fall with the load's square, their smooth contact's with its cube.
            let at = |s: &f64| Found {
                at: CurvePoint {
                    load_n,
                    amplitude_m: heights,
                    ..found(*s, 1.0, 1.0).at
                },
                smooth: Some(4.0 * times.powi(-3)),
                ..found(*s, 1.0, (1.0 - 0.4 * s) * times.powi(-2))
            };
            rows.push((times * 100.0).round() / 100.0);
            all += order.values.len();
            let found: Vec<_> = order.values.iter().map(at).collect();
            app.take_swept(Vec::new(), Some((0, found.len())));
            next = orders(app.take_swept(found, None));
        }
        // The run itself is one cell of the scene's row; what the first map has of that row the second one has, too.
        let (expected, n): (&[f64], _) = match across {
            Across::Load => (&[1.0, 1.4, 0.7, 2.0, 0.5], 6 * 5 - 1),
            Across::Amplitude => (&[1.4, 0.7, 2.0, 0.5], 6 * 4),
        };
        assert_eq!((&rows[..], all), (expected, n));
        let map = app.life_map(across);
        assert_eq!((map.columns.len(), map.rows.len()), (6, 5));
        assert_eq!(map.here, (2, 3));
        let power = if across == Across::Load { -5 } else { -2 };
        for (row, (times, _)) in map.rows.iter().enumerate() {
            for (column, s) in map.columns.iter().enumerate().filter(|at| *at.1 != 0.5) {
                let expected = (1.0 - 0.4 * s) * times.powi(power);
                let life = map.lives[row * 6 + column].unwrap();
                assert!(
                    (life / expected - 1.0).abs() < 1e-9,
                    "{times} {s}: {life}, {expected}"
                );
            }
        }
        let name = format!("map_of_{across:?}_160x48").to_lowercase();
        insta::assert_snapshot!(name, text(&app, 160, 48));
    }
    let turned = app.apply(Action::GoToCell(0, 4));
    let turned: Vec<_> = turned
        .into_iter()
        .filter_map(|effect| match effect {
            Effect::Send(Command::Set(knob, value)) => Some((knob, value)),
            _ => None,
        })
        .collect();
    let amplitude_m = 2.0 * 2.0e-7;
    assert_eq!(
        turned,
        [
            (Knob::Amplitude1M, amplitude_m),
            (Knob::Amplitude2M, amplitude_m),
            (Knob::SlideRoll, 1.0)
        ]
    );
    // What is known stays known.
    let map = app.life_map(Across::Amplitude);
    assert_eq!((map.here, map.lives.iter().flatten().count()), ((0, 4), 30));
}
