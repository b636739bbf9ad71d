//! The lessons run headless and keep what they say: each beat's claims at its end, and the answer to each question,
//! which the simulation gives. Files of lessons that are refused, in words.
#![cfg(feature = "tui")]
#![expect(clippy::unwrap_used, reason = "tests")]

use std::sync::OnceLock;

use asperity_engine::plan::Plan;
use asperity_engine::scene::{ContactKind, DamageMaps, Scene};
use asperity_engine::sim::{Frame, Simulation, Stage};
use asperity_explorer::tui::dial::dials;
use asperity_explorer::tui::lessons::{Claim, FILES, Lesson, LessonFigure};

/// Point contacts take half the nodes of the explorer, and all half the depths: the claims are no finer than that. No figure is
/// read off a map of damage.
fn coarse(mut scene: Scene) -> Scene {
    if let Some(stress) = &mut scene.stress {
        stress.depths = stress.depths.min(16);
    }
    if let Some(life) = &mut scene.life {
        life.damage_map = DamageMaps::Off;
    }
    if scene.kind() == ContactKind::Point {
        scene.grid.nodes = scene.grid.nodes.min(65);
    }
    scene
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
    fn play(&mut self, lesson: &Lesson, beat: usize) {
        for dial in dials(&self.scene, self.plan.force_n, self.plan.hertz.p_max_pa) {
            let setting = lesson.setting(beat, &dial);
            let before = lesson.beats[beat].staging.is_none();
            let before = before.then(|| lesson.setting(beat - 1, &dial)).flatten();
            // A knob that is where it was is not turned: the average goes on.
            if let Some(setting) = setting.filter(|_| setting != before) {
                self.sim.set(dial.knob, setting.value(&dial)).unwrap();
            }
        }
        self.sim.fill(&mut self.frame);
        let until = self.frame.passages + lesson.beats[beat].passages;
        let old = self.scene.age.map_or(0.0, |age| age.cycles * (1.0 - 1e-9));
        // Not a number of the way there: the verdict is of the age that the scene asks for, once it has settled.
        let is_young = |frame: &Frame| {
            let is_old = frame.age.is_some_and(|age| age.cycles >= old);
            let life = frame.metrics.life.as_ref();
            old > 0.0 && !(is_old && life.is_some_and(|life| life.settled))
        };
        while self.frame.stage == Stage::StartUp
            || self.frame.passages < until
            || is_young(&self.frame)
        {
            self.sim.step().unwrap();
            self.sim.fill(&mut self.frame);
        }
    }
}

/// The frames at the end of each beat, and of the one before it.
fn ends(lesson: &Lesson) -> Vec<(Frame, Option<Frame>)> {
    let (mut run, mut ends) = (None::<Run>, Vec::<(Frame, Option<Frame>)>::new());
    for (place, beat) in lesson.beats.iter().enumerate() {
        if let Some(staging) = &beat.staging {
            run = Some(Run::new(coarse(staging.load().unwrap())));
        }
        let run = run.as_mut().unwrap();
        run.play(lesson, place);
        let before = ends.last().map(|(frame, _)| frame.clone());
        ends.push((run.frame.clone(), before));
    }
    ends
}

/// Those of the first lesson, which two tests look at.
fn ends_of_one_passage() -> &'static [(Frame, Option<Frame>)] {
    static ENDS: OnceLock<Vec<(Frame, Option<Frame>)>> = OnceLock::new();
    ENDS.get_or_init(|| ends(&named("one_passage")))
}

/// What of a lesson does not hold.
fn wrong(lesson: &Lesson, ends: &[(Frame, Option<Frame>)]) -> Vec<String> {
    /// A limit is no nearer to the value that was found than this ratio, so that a class is not told otherwise.
    const CLEAR: f64 = 1.05;
    let mut wrong = Vec::new();
    for (beat, (frame, before)) in lesson.beats.iter().zip(ends) {
        println!("{}", beat.caption);
        let before = before.as_ref();
        for claim in &beat.claims {
            let value = claim.measure.value(frame, before);
            let told = format!(
                "{} {:?} = {value:?}, claimed {} to {}",
                claim.measure.of.name(),
                claim.measure.over,
                claim.min,
                claim.max
            );
            println!("    {told}");
            if !claim.holds(frame, before) {
                wrong.push(told);
            }
        }
        let Some(question) = &beat.question else {
            continue;
        };
        let value = question.measure.value(frame, before);
        let answer = value.map(|value| &question.answers[question.right(value)]);
        let told = format!("{} {value:?}: {answer:?}", question.ask);
        println!("  ? {told}");
        let clear =
            |limit: &f64| value.is_some_and(|value| (value / limit).max(limit / value) >= CLEAR);
        if value.is_none() || !question.limits.iter().all(clear) {
            wrong.push(told);
        }
    }
    wrong
}

/// The same frames with their counts wiped: each claim of a count must fall.
fn nothing_counted_is_seen(lesson: &Lesson, ends: &[(Frame, Option<Frame>)]) {
    for (beat, (frame, before)) in lesson.beats.iter().zip(ends) {
        for nothing in [None, Some(0.0)] {
            let mut wiped = frame.clone();
            wiped.metrics.n_counted_body_1 = nothing;
            wiped.metrics.n_counted_body_2 = nothing;
            let counts = |claim: &&Claim| claim.measure.of.name().contains("counted");
            for claim in beat.claims.iter().filter(counts) {
                assert!(
                    !claim.holds(&wiped, before.as_ref()),
                    "{}: {claim:?} holds for {nothing:?}",
                    beat.caption
                );
            }
        }
    }
}

fn named(name: &str) -> Lesson {
    let (_, text) = FILES.iter().find(|(own, _)| *own == name).unwrap();
    Lesson::from_toml(text, name).unwrap()
}

fn check(name: &str) {
    let lesson = named(name);
    let own;
    let ends = if name == "one_passage" {
        ends_of_one_passage()
    } else {
        own = ends(&lesson);
        &own
    };
    let wrong = wrong(&lesson, ends);
    assert!(wrong.is_empty(), "{wrong:#?}");
    nothing_counted_is_seen(&lesson, ends);
}

macro_rules! lessons {
    ($($name:ident)*) => {
        $(#[test] fn $name() { check(stringify!($name)); })*

        #[test]
        fn every_lesson_is_run() {
            let run = [$(stringify!($name)),*];
            let all = FILES.map(|(name, _)| name);
            assert_eq!(all, run);
        }
    };
}

lessons! {
    one_passage rolling_and_sliding thin_film waves_flatten lay load gear_tooth which_flank pit_start real_roughness warm_oil a_little_wear doubt
}

#[test]
fn all_have_words_time_questions_and_scenes_that_load() {
    let mut asked = 0;
    for (name, text) in FILES {
        let lesson = Lesson::from_toml(text, name).unwrap_or_else(|error| panic!("{error}"));
        lesson
            .check()
            .unwrap_or_else(|error| panic!("{name}: {error}"));
        let questions = lesson.beats.iter().filter(|beat| beat.question.is_some());
        assert!(questions.clone().count() > 0, "{name}");
        asked += questions.count();
        let last = &lesson.beats[lesson.beats.len() - 1];
        let because = last.question.as_ref().map_or("", |asked| &asked.because);
        let words = format!("{} {because}", last.caption);
        assert!(words.contains("Not modelled:"), "{name}: {words}");
        for beat in &lesson.beats {
            assert!(!beat.claims.is_empty(), "{name}: {}", beat.caption);
            // A formula knows nothing of the simulation: beside each n stands what was counted.
            let claims = |figure: &str| {
                let mut names = beat.claims.iter().map(|claim| claim.measure.of.name());
                names.any(|name| name == figure)
            };
            for body in [1, 2] {
                let (n, counted) = (format!("n_body_{body}"), format!("n_counted_body_{body}"));
                assert!(!claims(&n) || claims(&counted), "{name}: {}", beat.caption);
            }
            for claim in &beat.claims {
                let idle = Frame::default();
                assert!(!claim.holds(&idle, Some(&idle)), "{name}: {claim:?}");
            }
        }
    }
    assert!(asked >= 15, "{asked}");
}

/// Claims and answers are found, not agreed with: bounds that are moved are seen, limits that are moved make another
/// answer right.
#[test]
fn a_planted_wrong_claim_fails() {
    let good = named("one_passage");
    let ends = ends_of_one_passage();
    assert!(wrong(&good, ends).is_empty());
    for place in 0..good.beats.len() {
        for claim in 0..good.beats[place].claims.len() {
            let mut planted = good.clone();
            let bounds = &mut planted.beats[place].claims[claim];
            (bounds.min, bounds.max) = (1.1 * bounds.max, 2.0 * bounds.max);
            assert_eq!(
                wrong(&planted, ends).len(),
                1,
                "{:?}",
                good.beats[place].claims[claim]
            );
        }
    }
    let mut planted = good.clone();
    let question = planted.beats[0].question.as_mut().unwrap();
    let value = question.measure.value(&ends[0].0, None).unwrap();
    assert_eq!(question.right(value), 0);
    question.limits = vec![0.2, 0.4];
    assert_eq!(question.right(value), 2);
    question.limits[1] = value;
    assert_eq!(wrong(&planted, ends).len(), 1, "too near to tell");
}

const LESSON: &str = r#"
title = "Mine"
set = ["motion.slide_roll=0"]
[[beat]]
caption = "Look at this."
passages = 1.0
claims = [{ of = "p_max_pa", over = "p_hertz_pa", from = 1.0 }]
[[beat]]
knobs = { "motion.slide_roll" = 0.5 }
caption = "And now?"
passages = 1.0
[beat.question]
ask = "How many?"
of = "n_body_1"
over = "before"
answers = ["fewer", "more"]
limits = [1.0]
because = "So it is."
"#;

#[test]
fn hostile_files_are_refused_in_words() {
    let read = |text: &str| Lesson::from_toml(text, "mine.toml").and_then(|mine| mine.check());
    assert_eq!(read(LESSON).err(), None);
    let long = format!("caption = \"{}\"", "x".repeat(5000));
    let table = [
        ("title = \"Mine\"", "", "missing field `title`"),
        (
            "title = \"Mine\"",
            "title = \"\"",
            "title =  is refused; allowed: 1 to 60 letters",
        ),
        (
            "title = \"Mine\"",
            "title = \"a\\u001b[2J\"",
            "none of them a control character",
        ),
        (
            "title = \"Mine\"",
            "titel = \"Mine\"",
            "unknown field `titel`",
        ),
        ("caption = \"And now?\"", &long, "beat 2: caption = xxx"),
        (
            "passages = 1.0",
            "passages = nan",
            "beat 1: passages = NaN is refused; allowed: above 0, to 50",
        ),
        (
            "passages = 1.0",
            "passages = 1e9",
            "beat 1: passages = 1000000000",
        ),
        ("passages = 1.0", "passages = \"long\"", "expected f64"),
        (
            "from = 1.0",
            "from = 2, to = 1",
            "beat 1: claims = from 2 to 1 is refused; allowed: from <= to",
        ),
        ("from = 1.0", "from = inf", "from <= to"),
        (
            "of = \"p_max_pa\"",
            "of = \"p_max\"",
            "beat 1: claims.of = p_max is refused; allowed: one of ripple_left",
        ),
        (
            "over = \"p_hertz_pa\"",
            "over = \"before\"",
            "beat 1: claims.over = before is refused",
        ),
        (
            "\"motion.slide_roll\" = 0.5",
            "\"motion.slide_roll\" = 3.0",
            "motion.slide_roll = 3 is refused; allowed: -2 to 2",
        ),
        (
            "\"motion.slide_roll\" = 0.5",
            "\"motion.slide_roll\" = nan",
            "motion.slide_roll = NaN is refused; allowed: a number",
        ),
        (
            "\"motion.slide_roll\" = 0.5",
            "\"grid.nodes\" = 3",
            "beat 2: knobs = grid.nodes is refused; allowed: one of motion.slide_roll",
        ),
        (
            "limits = [1.0]",
            "limits = [1.0, 2.0]",
            "beat 2: question.limits = [1.0, 2.0] is refused; allowed: 1 rising",
        ),
        (
            "limits = [1.0]",
            "limits = [inf]",
            "beat 2: question.limits = [inf]",
        ),
        (
            "answers = [\"fewer\", \"more\"]",
            "answers = []",
            "beat 2: question.answers = 0 is refused; allowed: 2 to 9",
        ),
        (
            "set = [\"motion",
            "scene = \"no_such\"\nset = [\"motion",
            "no_such is neither a preset nor a scene file",
        ),
        (
            "slide_roll=0\"",
            "slide_roll=7\"",
            "motion.slide_roll = 7 is refused; allowed: -2 to 2",
        ),
        (
            "slide_roll=0\"",
            "slide_roll=0\", \"grid.nodes=9\"",
            "is refused",
        ),
    ];
    for (old, new, words) in table {
        assert!(LESSON.contains(old), "{old}");
        let error = read(&LESSON.replacen(old, new, 1))
            .expect_err(new)
            .to_string();
        assert!(error.contains(words), "{new}: {error}");
        assert!(error.chars().count() < 2500, "{new}: {error}");
    }
    let beats = "[[beat]]\ncaption = \"x\"\npassages = 1\n".repeat(31);
    let error = read(&format!("title = \"x\"\n{beats}"))
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("[[beat]] = 31 is refused; allowed: 1 to 30"),
        "{error}"
    );
    // Depth is refused by the reader of TOML.
    assert!(read(&format!("title = {}", "[".repeat(100_000))).is_err());
}

#[test]
fn files_that_are_no_lessons_are_refused() {
    let folder = tempfile_folder();
    let said = |path: &std::path::Path| Lesson::load(path).unwrap_err().to_string();
    assert!(said(&folder).contains("not a plain file"));
    assert!(said(&folder.join("none.toml")).contains("--lesson"));
    let path = folder.join("long.toml");
    std::fs::write(&path, vec![b' '; 300_000]).unwrap();
    assert!(said(&path).contains("at most 256 KiB"));
    std::fs::write(&path, [0xff, 0xfe]).unwrap();
    assert!(said(&path).contains("UTF-8"));
    // Scenes are sought beside the lesson.
    let scene = Scene::load("demonstration").unwrap().to_toml();
    std::fs::write(folder.join("own.toml"), scene).unwrap();
    let lesson = LESSON.replace("set = [\"motion", "scene = \"own.toml\"\nset = [\"motion");
    std::fs::write(&path, lesson).unwrap();
    assert_eq!(Lesson::load(&path).unwrap().title, "Mine");
    std::fs::remove_dir_all(folder).unwrap();
}

fn tempfile_folder() -> std::path::PathBuf {
    let folder = std::env::temp_dir().join(format!("asperity-lessons-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// The example of the guide is a whole lesson, which runs and holds.
#[test]
fn the_guides_example_holds() {
    let page = include_str!("../../assets/guide/lessons.md");
    let example = page
        .split("```toml\n")
        .nth(1)
        .unwrap()
        .split("```")
        .next()
        .unwrap();
    let lesson = Lesson::from_toml(example, "the guide").unwrap();
    lesson.check().unwrap();
    let wrong = wrong(&lesson, &ends(&lesson));
    assert!(wrong.is_empty(), "{wrong:#?}");
    for figure in [
        LessonFigure::RippleLeft,
        LessonFigure::LifeByContacts,
        LessonFigure::ChoicesApart,
    ] {
        assert!(
            page.contains(&format!("`{}`", figure.name())),
            "{}",
            figure.name()
        );
    }
}
