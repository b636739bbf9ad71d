//! The lessons run headless and keep what they say: each beat's claims at its end.
#![cfg(feature = "tui")]
#![expect(clippy::unwrap_used, reason = "tests")]

use asperity::plan::Plan;
use asperity::scene::{ContactKind, Scene};
use asperity::sim::{Frame, Knob, Simulation, Stage};
use asperity::tui::dial::dials;
use asperity::tui::lessons::{Beat, Claim, LESSONS, LessonFigure};

/// The scene of a beat. Point contacts take half the nodes of the explorer: the claims are no finer than that.
fn staged(beat: &Beat) -> Option<Scene> {
    let mut scene = beat.staging?.scene().unwrap();
    if scene.kind() == ContactKind::Point {
        scene.grid.nodes = 65;
    }
    Some(scene)
}

struct Run {
    sim: Simulation,
    scene: Scene,
    plan: Plan,
    frame: Frame,
}

impl Run {
    fn new(scene: Scene) -> Self {
        let plan = Plan::new(&scene).unwrap();
        let sim = Simulation::new(&scene, plan.clone(), 1).unwrap();
        Self {
            sim,
            scene,
            plan,
            frame: Frame::default(),
        }
    }

    /// Plays a beat from where the last one ended, as the explorer does.
    fn play(&mut self, beat: &Beat) {
        let home = dials(&self.scene, self.plan.force_n, self.plan.hertz.p_max_pa);
        for (knob, setting) in beat.sets {
            let dial = home.iter().find(|dial| dial.answers(*knob)).unwrap();
            self.sim.set(dial.knob, setting.value(dial)).unwrap();
        }
        self.sim.fill(&mut self.frame);
        let until = self.frame.passages + beat.passages;
        while self.frame.stage == Stage::StartUp || self.frame.passages < until {
            self.sim.step().unwrap();
            self.sim.fill(&mut self.frame);
        }
    }
}

/// The same frame with its counts wiped: each claim of a count must fall.
fn nothing_counted_is_seen(beat: &Beat, frame: &Frame) {
    for nothing in [None, Some(0.0)] {
        let mut wiped = frame.clone();
        wiped.metrics.n_counted_body_1 = nothing;
        wiped.metrics.n_counted_body_2 = nothing;
        let counts = |claim: &&Claim| {
            matches!(
                claim.figure,
                LessonFigure::Counted1 | LessonFigure::Counted2
            )
        };
        for claim in beat.claims.iter().filter(counts) {
            assert!(
                !claim.holds(&wiped),
                "{}: {claim:?} holds for {nothing:?}",
                beat.caption
            );
        }
    }
}

fn check(lesson: usize) {
    let (mut run, mut wrong) = (None, Vec::<&Claim>::new());
    for beat in LESSONS[lesson].beats {
        if let Some(scene) = staged(beat) {
            run = Some(Run::new(scene));
        }
        let run = run.as_mut().unwrap();
        run.play(beat);
        println!("{}", beat.caption);
        for claim in beat.claims {
            println!(
                "    {} = {:?}, claimed {} to {}",
                claim.figure.name(),
                claim.figure.of(&run.frame),
                claim.least,
                claim.most
            );
        }
        let fails = |claim: &&Claim| !claim.holds(&run.frame);
        wrong.extend(beat.claims.iter().filter(fails));
        nothing_counted_is_seen(beat, &run.frame);
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}

#[test]
fn one_asperity_one_passage() {
    check(0);
}

#[test]
fn rolling_against_sliding() {
    check(1);
}

#[test]
fn thin_film() {
    check(2);
}

#[test]
fn waves_that_flatten() {
    check(3);
}

#[test]
fn lays() {
    check(4);
}

#[test]
fn a_gear_tooth() {
    check(5);
}

#[test]
fn where_the_pit_starts() {
    check(6);
}

/// A claim that does not hold is seen: the figures do not agree with everything.
#[test]
fn figures_are_read_from_the_frame() {
    let mut run = Run::new(staged(&LESSONS[0].beats[0]).unwrap());
    run.sim.set(Knob::SlideRoll, 1.0).unwrap();
    while run.frame.stage == Stage::StartUp || run.frame.passages < 0.1 {
        run.sim.step().unwrap();
        run.sim.fill(&mut run.frame);
    }
    let n_2 = LessonFigure::N2.of(&run.frame).unwrap();
    assert!(n_2 > 3.0, "{n_2}");
    assert_eq!(
        LessonFigure::N1.of(&run.frame),
        Some(1.0),
        "body 2 is smooth"
    );
}
