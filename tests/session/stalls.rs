//! Whether the ladder ends otherwise than it should where its last mesh alone does not.
//!
//! `cargo test --release -p asperity-session --test session stalls:: -- --ignored --nocapture` counts both over 500 operating points
//! of the presets; `ASPERITY_CASES=n` over the first n.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::sync::Arc;

use asperity_engine::plan::Plan;
use asperity_engine::scene::{ContactKind, Override, Scene, presets};
use asperity_session::run::{End, Ending, Outcome, Request, Session, share_out};

/// A scene, its meshes and passages.
struct Case {
    name: String,
    sets: Vec<String>,
}

/// Numbers of a sequence that is the same everywhere (Knuth's linear congruential generator), 0 to 1.
struct Sequence(u64);

impl Sequence {
    fn next(&mut self) -> f64 {
        self.0 = (self.0.wrapping_mul(6_364_136_223_846_793_005))
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Between two factors squared, even in the logarithm.
    fn factor(&mut self, from: f64, to: f64) -> f64 {
        let [from, to] = [from, to].map(|factor| factor.powi(2));
        from * (to / from).powf(self.next())
    }
}

fn load(name: &str, sets: &[String]) -> Option<Scene> {
    let sets: Vec<Override> = sets.iter().map(|set| set.parse().unwrap()).collect();
    Scene::load_with(name, &sets).ok()
}

/// Presets, then operating points.
fn cases(n: usize) -> Vec<Case> {
    let named = |name: &str, sets: Vec<String>| Case {
        name: name.to_owned(),
        sets,
    };
    let names: Vec<&str> = presets::all().iter().map(|preset| preset.name).collect();
    let with_life = |name: &&str| load(name, &[]).unwrap().life.is_some();
    let names: Vec<&str> = names.into_iter().filter(with_life).collect();
    let mut cases: Vec<Case> = names.iter().map(|name| named(name, Vec::new())).collect();
    let mut sequence = Sequence(33);
    while cases.len() < n {
        let name = names[(sequence.next() * names.len() as f64) as usize];
        let scene = load(name, &[]).unwrap();
        let load_n = scene.force_n() * sequence.factor(0.5, 1.5);
        let kind = match scene.kind() {
            ContactKind::Point => "force_n",
            ContactKind::Line => "force_n_per_m",
        };
        let speed = scene.motion.entrainment_m_s * sequence.factor(0.4, 2.5);
        let mut sets = vec![
            format!("load.{kind}={load_n:.6e}"),
            "load.hertz_pressure_pa=none".to_owned(),
            format!("motion.entrainment_m_s={speed:.6e}"),
            format!("motion.slide_roll={:.2}", 1.6 * sequence.next()),
        ];
        for (body, surface) in scene.surfaces().into_iter().enumerate() {
            let amplitude_m = surface.amplitude_m() * sequence.factor(0.4, 1.6);
            if !surface.is_smooth() {
                let key = format!("body_{}.surface.amplitude_m", body + 1);
                sets.push(format!("{key}={amplitude_m:.4e}"));
            }
        }
        if scene.load.hertz_pressure_pa.is_none() {
            sets.remove(1);
        }
        if load(name, &sets).is_some_and(|scene| Plan::new(&scene).is_ok()) {
            cases.push(named(name, sets));
        }
    }
    cases
}

fn outcome(case: &Case, nodes: usize, passages: f64, ladder: bool) -> Option<Outcome> {
    let mut sets = case.sets.clone();
    sets.push(format!("numerics.ladder={ladder}"));
    sets.push(format!("grid.nodes={nodes}"));
    sets.push(format!("time.passages={passages}"));
    let mut scene = load(&case.name, &sets)?;
    scene.record = None;
    let request = Request {
        name: String::new(),
        plan: Plan::new(&scene).ok()?,
        scene: Arc::new(scene),
        threads: 1,
        watchers: Vec::new(),
        ending: Ending::Passages,
    };
    Some(Session::start(request).unwrap().join().unwrap())
}

/// Cases that are counted for stalls, unless `ASPERITY_CASES` says how many.
const STALLS: usize = 500;

#[test]
#[ignore = "half an hour of a processor"]
fn a_ladder_stalls_no_more_often_than_its_last_mesh_alone() {
    let n = std::env::var("ASPERITY_CASES").ok();
    let n = n.and_then(|n| n.parse().ok()).unwrap_or(STALLS);
    let tell = |case: &Case| {
        let ways = [true, false].map(|ladder| {
            let ended = outcome(case, 129, 0.1, ladder)?;
            let unsolved = ended.summary.map(|s| s.steps_not_converged);
            Some((matches!(ended.end, End::Done), unsolved.unwrap_or(0)))
        });
        if ways
            .iter()
            .flatten()
            .any(|(done, unsolved)| !done || *unsolved > 0)
        {
            println!("{ways:?} {} {}", case.name, case.sets.join(" "));
        }
        ways
    };
    let found = share_out(&cases(n), 2, tell, &mut |_, _| {});
    let count = |way: usize, is: &dyn Fn(&(bool, u64)) -> bool| {
        found
            .iter()
            .filter(|ways| ways[way].as_ref().is_some_and(is))
            .count()
    };
    let table = [0, 1].map(|way| {
        [
            count(way, &|_| true),
            count(way, &|(done, _)| !done),
            count(way, &|(_, unsolved)| *unsolved > 0),
        ]
    });
    println!(
        "ran, ended early, with steps unsolved: ladder {:?}, alone {:?}",
        table[0], table[1]
    );
    assert!(table[0][1] <= table[1][1] && table[0][2] <= table[1][2]);
}
