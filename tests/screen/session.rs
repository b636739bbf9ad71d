//! The explorer's session with the real simulation: mashed knobs, the log replayed, a sweep, lives at other S.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::common::keeper::{Kept, kept_request};
use asperity_engine::plan::Plan;
use asperity_engine::scene::{DamageMaps, Override, Scene, Spread, Surface};
use asperity_engine::sim::{Follow, Frame, Knob, Simulation, State, Summary};
use asperity_session::run::{
    AppliedCommand, Assumed, AssumedRange, Command, End, Ending, Request, Session, Settled,
};
use asperity_session::sweep::{Along, Background, CaseStart, CurveOrder, Found, Ground, Varied};

fn small() -> Scene {
    scene(&["grid.nodes=65", "stress.depths=8"])
}

/// Waves that 65 nodes carry well enough to see that the passage repeats.
fn repeating() -> Scene {
    scene(&[
        "grid.nodes=65",
        "numerics.order=second",
        "stress.depths=8",
        "body_1.surface.amplitude_m=3e-7",
        "body_2.surface.amplitude_m=3e-7",
        "body_1.surface.phase_deg=0",
        "body_1.surface.wavelength_x_m=4e-4",
        "body_2.surface.wavelength_x_m=4e-4",
        "body_2.surface.wavelength_y_m=4e-4",
    ])
}

fn scene(sets: &[&str]) -> Scene {
    let sets: Vec<Override> = sets.iter().map(|text| text.parse().unwrap()).collect();
    Scene::load_with("demonstration_quick", &sets).unwrap()
}

fn request(scene: &Scene, ending: Ending) -> (Request, Kept) {
    kept_request(scene, 1, [], ending)
}

fn wait_for(session: &Session, ready: impl Fn(&Session) -> bool) {
    while !ready(session) {
        assert!(!session.is_finished(), "the session ended");
        std::thread::sleep(Duration::from_millis(2));
    }
}

/// A fixed scramble.
pub(super) fn scramble(seed: u64) -> u64 {
    let mut x = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// Any command, also ones that are refused; pauses come in pairs with steps so that the run goes on.
fn mashed(i: u64) -> Command {
    let x = scramble(i);
    let part = (x >> 11) as f64 / (1_u64 << 53) as f64;
    match x % 10 {
        0..=2 => Command::Set(Knob::SlideRoll, 4.4 * part - 2.2),
        3 => Command::Set(Knob::ForceN, 100.0 + 2000.0 * part),
        4 => Command::Set(Knob::Amplitude1M, 5e-7 * part),
        5 => Command::Set(Knob::Amplitude2M, 5e-7 * part),
        6 => Command::Set(Knob::EntrainmentMS, 0.05 + 2.0 * part),
        7 => Command::Follow(Follow {
            body: 1 + (x >> 8) as u8 % 2,
            depth_m: 1e-3 * part,
            x_m: Some(1e-3 * part - 5e-4),
        }),
        8 => Command::Set(Knob::ForceNPerM, 1e5),
        _ => Command::StepOnce,
    }
}

/// A thousand commands within seconds, in all parts of the run: none breaks it, and the log with the scene
/// gives every frame again, bit for bit.
#[test]
fn a_thousand_mashed_commands_never_break_the_run_and_the_log_replays_it() {
    let scene = small();
    let (request, kept) = self::request(&scene, Ending::OnStop);
    let session = Session::start(request).unwrap();
    for i in 0..1000 {
        session.handle.send(mashed(i));
        if i % 50 == 49 {
            let steps = session.handle.status().steps;
            session.handle.send(Command::Pause);
            session.handle.send(Command::Pause);
            // From the passage on each burst is answered by steps.
            if steps > 0 {
                wait_for(&session, |session| {
                    session.handle.status().steps > steps + 1
                });
            } else {
                std::thread::sleep(Duration::from_millis(50));
            }
        }
    }
    wait_for(&session, |session| session.handle.status().steps > 10);
    session.handle.send(Command::Stop);
    let outcome = session.join().unwrap();
    assert!(matches!(outcome.end, End::Stopped), "{:?}", outcome.end);
    println!(
        "{} steps, {} commands applied, {} steps not converged",
        outcome.steps,
        outcome.applied.len(),
        outcome.n_unconverged
    );
    assert!(outcome.applied.len() > 500);

    let (request, again) = self::request(&scene, Ending::Steps(outcome.steps));
    let turns = outcome.applied.iter().filter_map(AppliedCommand::to_repeat);
    let replayed = Session::repeat(request, turns.collect()).unwrap();
    assert_eq!(replayed.join().unwrap().steps, outcome.steps);
    let (one, two) = (kept.lock().unwrap(), again.lock().unwrap());
    assert_eq!(one.len(), two.len());
    let differs = one.iter().zip(two.iter()).position(|(one, two)| one != two);
    assert_eq!(differs, None, "entry that differs");
}

fn until_settled(session: &Session) -> Arc<Settled> {
    let is_last = |session: &Session| (session.handle.settled()).is_some_and(|one| one.is_last);
    wait_for(session, is_last);
    session.handle.settled().unwrap()
}

/// The period that is kept for the replay closes, and a knob empties it.
#[test]
fn a_passage_that_repeats_leaves_one_period() {
    let scene = repeating();
    let (request, _) = self::request(&scene, Ending::OnStop);
    let session = Session::start(request).unwrap();
    let settled = until_settled(&session);
    let (first, last) = (
        &settled.frames[0],
        &settled.frames[settled.frames.len() - 1],
    );
    let step_s = settled.frames[1].time_s - first.time_s;
    assert!((last.time_s + step_s - first.time_s - settled.period_s).abs() < step_s);
    let apart = |one: &Frame, other: &Frame| {
        let pairs = one.pressure_pa.iter().zip(&other.pressure_pa);
        let (moved, all) = pairs.fold((0.0, 0.0), |(moved, all), (p, q)| {
            (moved + f64::from((p - q).abs()), all + f64::from(p + q))
        });
        2.0 * moved / all
    };
    // The end leads to the beginning like any step to the next.
    let usual = apart(first, &settled.frames[1]);
    assert!(
        apart(last, first) < 1.5 * usual,
        "{} {usual}",
        apart(last, first)
    );
    // Other orbits are told from this one: half a period on the fields differ more.
    let middle = &settled.frames[settled.frames.len() / 2];
    assert!(apart(first, middle) > apart(last, first));
    session.handle.send(Command::Set(Knob::SlideRoll, 0.4));
    wait_for(&session, |session| session.handle.settled().is_none());
    session.handle.send(Command::Stop);
    session.join().unwrap();
}

/// A state of the passage of a live run, knobs turned.
fn state_of(scene: &Scene, turns: &[(Knob, f64)]) -> State {
    let (request, _) = self::request(scene, Ending::OnStop);
    let session = Session::start(request).unwrap();
    for (knob, value) in turns {
        session.handle.send(Command::Set(*knob, *value));
    }
    let state = until_settled(&session).state.clone();
    session.handle.send(Command::Stop);
    session.join().unwrap();
    state.unwrap()
}

fn swept(made: &Scene, state: State, order: CurveOrder) -> Vec<Found> {
    let all = order.values.len();
    let scene = Arc::new(made.clone());
    let sweep = Background::start(Ground { scene, state }, order, 2, None);
    while sweep.progress().is_some() {
        std::thread::sleep(Duration::from_millis(2));
    }
    let found = sweep.take();
    assert_eq!(found.len(), all);
    found
}

/// A run of its own.
fn own(scene: &Scene) -> Summary {
    let plan = Plan::new(scene).unwrap();
    let mut sim = Simulation::new(scene, plan, 1).unwrap();
    while !sim.metrics().life.is_some_and(|life| life.settled) || !sim.is_done() {
        sim.step().unwrap();
    }
    sim.summary()
}

fn compare(found: &[Found], scene_at: impl Fn(&Found) -> Scene) {
    for found in found {
        let own = own(&scene_at(found));
        let (life, friction) = (own.life_relative.unwrap(), own.friction_coefficient);
        let [low, swept, high] = found.life.unwrap();
        println!(
            "S = {}, U = {}: swept {swept:.4}, own {life:.4}; friction {:.4}, own {friction:.4}",
            found.at.slide_roll, found.at.entrainment_m_s, found.friction
        );
        assert!(low <= swept && swept <= high);
        // Both are means over whole periods of the same orbit.
        assert!((swept / life - 1.0).abs() < 0.005);
        assert!((found.friction - friction).abs() <= 0.005 * friction);
        // And the life at another load is compared by the same smooth contact.
        let smooth = found.smooth.unwrap() / own.life_smooth.unwrap();
        assert!((smooth - 1.0).abs() < 0.005, "{smooth}");
    }
}

/// A sweep from a settled run gives the life that a run of its own gives at that S: from the run's own state
/// where only S and the amplitudes differ from the scene, from Hertz where its load was turned.
#[test]
fn a_sweep_finds_the_lives_of_runs_of_their_own() {
    let scene = repeating();
    let amplitude_m = 0.8 * scene.body_1.surface.amplitude_m();
    let force_n = 1.1 * Plan::new(&scene).unwrap().force_n;
    for (turns, values, began) in [
        (
            vec![(Knob::Amplitude1M, amplitude_m)],
            vec![1.0, 0.25],
            CaseStart::Warm,
        ),
        (vec![(Knob::ForceN, force_n)], vec![0.25], CaseStart::Cold),
    ] {
        let mut now = scene.clone();
        for (knob, value) in &turns {
            match knob {
                Knob::ForceN => {
                    (now.load.force_n, now.load.hertz_pressure_pa) = (Some(*value), None);
                }
                _ => now.body_1.surface.set_amplitude_m(*value),
            }
        }
        let order = CurveOrder {
            varied: Varied::Along(Along::SlideRoll),
            values,
            scene: now.clone(),
        };
        let found = swept(&scene, state_of(&scene, &turns), order);
        assert!(found.iter().all(|found| found.began == began));
        compare(&found, |found| {
            let mut own = now.clone();
            own.motion.slide_roll = found.at.slide_roll;
            own
        });
    }
}

/// Who makes the turns makes no difference, bit for bit: a page, or one thread.
#[test]
fn a_sweep_in_turns_is_that_of_one_thread() {
    let scene = repeating();
    let order = CurveOrder {
        varied: Varied::Along(Along::SlideRoll),
        values: vec![0.25, 1.0, 0.0, 0.75],
        scene: scene.clone(),
    };
    let ground = Ground {
        state: state_of(&scene, &[]),
        scene: Arc::new(scene),
    };
    let one_thread = Background::start(ground.clone(), order.clone(), 1, None);
    let (in_turns, worker) = Background::cooperative(ground, order);
    let mut worker = worker.unwrap();
    let mut turns = 0;
    while worker.turn() {
        turns += 1;
    }
    assert_eq!(in_turns.progress(), Some((4, 4)));
    drop(worker);
    assert_eq!(in_turns.progress(), None);
    while one_thread.progress().is_some() {
        std::thread::sleep(Duration::from_millis(2));
    }
    let found = in_turns.take();
    assert!(found.len() == 4 && turns > 4 * 10, "{turns}");
    assert_eq!(found, one_thread.take());
}

/// The same along the speed, for Stribeck's curve: λ and friction go their ways.
#[test]
fn a_sweep_of_the_speed_goes_along_stribecks_curve() {
    let scene = repeating();
    let order = CurveOrder {
        varied: Varied::Along(Along::Entrainment),
        values: vec![0.05, 0.8],
        scene: scene.clone(),
    };
    let mut found = swept(&scene, state_of(&scene, &[]), order);
    compare(&found, |found| {
        let mut own = scene.clone();
        own.motion.entrainment_m_s = found.at.entrainment_m_s;
        own
    });
    found.sort_by(|one, two| one.at.entrainment_m_s.total_cmp(&two.at.entrainment_m_s));
    let [slow, fast] = found[..] else {
        panic!("{found:?}")
    };
    assert!(slow.lambda.unwrap() < 0.5 * fast.lambda.unwrap());
    assert!(
        slow.friction > fast.friction,
        "mixed friction falls with speed"
    );
}

/// And over what the scene assumes: each life is that of a run of its own with that choice.
#[test]
fn a_sweep_over_what_is_assumed_finds_the_lives_of_runs_of_their_own() {
    let mut sliding = repeating();
    // Twelve choices by two ways, each of them a life alone.
    let life = sliding.life.as_mut().unwrap();
    (life.spread, life.damage_map) = (Spread::Off, DamageMaps::Off);
    let mut rolling = sliding.clone();
    rolling.motion.slide_roll = 0.0;
    for body in [&mut rolling.body_1, &mut rolling.body_2] {
        if let Surface::Sinusoid { phase_deg, .. } = &mut body.surface {
            *phase_deg = 0.0;
        }
    }
    for (what, scene) in [(Assumed::OilLaw, sliding), (Assumed::Phase, rolling)] {
        let order = CurveOrder {
            varied: Varied::Assumed(what),
            values: (0..what.count()).map(|k| k as f64).collect(),
            scene: scene.clone(),
        };
        let mut found = swept(&scene, state_of(&scene, &[]), order);
        compare(&found, |found| {
            let mut own = scene.clone();
            what.choose(found.choice, &mut own);
            own
        });
        found.sort_by_key(|found| found.choice);
        let lives: Vec<_> = (found.iter())
            .map(|found| found.life.map(|life| life[1]))
            .collect();
        let [least, most] = AssumedRange::of(&lives).unwrap().of_life(1.0);
        println!("{what:?}: {least:.3} to {most:.3} times");
        // The choices are others: the friction of a thick film, the life of crests that meet.
        let moved = match what {
            Assumed::OilLaw => found[3].friction / found[2].friction,
            Assumed::Phase => most / least,
        };
        assert!(moved > 1.05, "{what:?}: {moved}");
    }
}

#[test]
fn a_sweep_that_is_called_off_ends() {
    let scene = repeating();
    let order = CurveOrder {
        varied: Varied::Along(Along::SlideRoll),
        values: (0..40).map(|k| 0.05 * f64::from(k)).collect(),
        scene: scene.clone(),
    };
    let state = state_of(&scene, &[]);
    let scene = Arc::new(scene);
    let sweep = Background::start(Ground { scene, state }, order, 2, None);
    assert!(sweep.progress().is_some());
    sweep.call_off();
    // A step is a matter of milliseconds, forty cases are not.
    while sweep.progress().is_some() {
        std::thread::sleep(Duration::from_millis(2));
    }
    assert!(sweep.take().len() < 20);
}

/// What drawing costs the simulation: steps of the default scene in four seconds on two threads with and
/// without a screen of 160 x 48 in true colour, in turn. Printed, for a quiet machine.
#[cfg(feature = "tui")]
#[test]
#[ignore = "prints a ratio of times"]
fn drawing_costs_the_simulation() {
    use crate::common::tui_fixture::setup_planned;
    use asperity_explorer::tui::app::App;
    use asperity_explorer::tui::theme::{Capabilities, ColorDepth, Glyphs, Theme};
    use asperity_explorer::tui::view;
    use ratatui::backend::CrosstermBackend;
    use ratatui::layout::Rect;
    use ratatui::{Terminal, TerminalOptions, Viewport};

    let scene = Arc::new(Scene::load("demonstration_quick").unwrap());
    let plan = Plan::new(&scene).unwrap();
    let request = Request {
        name: "test".to_owned(),
        scene: scene.clone(),
        plan: plan.clone(),
        threads: 2,
        watchers: Vec::new(),
        ending: Ending::OnStop,
    };
    let session = Session::start(request).unwrap();
    wait_for(&session, |session| session.handle.status().steps > 8);
    let setup = setup_planned(&scene, "demonstration_quick", &plan);
    let theme = Theme::new(Capabilities {
        depth: ColorDepth::True,
        glyphs: Glyphs::Unicode,
    });
    let mut app = App::new(setup, Vec::new(), theme);
    let options = TerminalOptions {
        viewport: Viewport::Fixed(Rect::new(0, 0, 160, 48)),
    };
    let backend = CrosstermBackend::new(std::io::sink());
    let mut terminal = Terminal::with_options(backend, options).unwrap();
    let latest = session.handle.latest();
    let (mut steps, mut drawing, mut frames) = ([0, 0], Duration::ZERO, 0_u32);
    let began = Instant::now();
    for turn in 0..16 {
        let watched = turn % 2;
        let (from, until) = (
            session.handle.status().steps,
            Instant::now() + Duration::from_millis(500),
        );
        while Instant::now() < until {
            if watched == 1 {
                let now = Instant::now();
                app.tick(began.elapsed());
                if let Some(frame) = latest.take() {
                    app.take_frame(frame);
                }
                terminal.draw(|frame| view::draw(&app, frame)).unwrap();
                drawing += now.elapsed();
                frames += 1;
            }
            std::thread::sleep(Duration::from_millis(22));
        }
        steps[watched] += session.handle.status().steps - from;
    }
    session.handle.send(Command::Stop);
    session.join().unwrap();
    println!(
        "steps in 4 s: {} unwatched, {} watched ({:+.1} %); {:.2} ms a frame, {frames} frames",
        steps[0],
        steps[1],
        100.0 * (steps[1] as f64 / steps[0] as f64 - 1.0),
        1e3 * drawing.as_secs_f64() / f64::from(frames)
    );
}
