//! The bands of a run against truth: a mesh twice as fine and a run four times as long.
//!
//! `cargo test --release -p asperity-session --test session bands:: -- --ignored --nocapture` prints every quantity of every
//! case and, of each quantity, how often the band covers the truth and how wide it is over the true error at the median.
//! `-- stalls --ignored` counts what ends otherwise than it should on the ladder and on its last mesh alone, over 500 such
//! points from twice as wide ranges.
//! `ASPERITY_CASES=n` runs the first n cases, `m..n` those after m: the presets with a life, then random operating points of theirs.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::sync::Arc;

use asperity_engine::plan::Plan;
use asperity_engine::scene::{ContactKind, Override, Scene, presets};
use asperity_engine::sim::Summary;
use asperity_session::run::{End, Ending, Outcome, Request, Session, share_out};

/// Cases in all.
const CASES: usize = 40;

/// A scene, its meshes and passages.
struct Case {
    name: String,
    sets: Vec<String>,
}

/// Numbers of a sequence that is the same everywhere (Knuth's linear congruential generator), 0 to 1.
struct Sequence(u64, f64);

impl Sequence {
    fn next(&mut self) -> f64 {
        self.0 = (self.0.wrapping_mul(6_364_136_223_846_793_005))
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Between two factors to the power `self.1`, even in the logarithm.
    fn factor(&mut self, from: f64, to: f64) -> f64 {
        let [from, to] = [from, to].map(|factor| factor.powf(self.1));
        from * (to / from).powf(self.next())
    }
}

fn load(name: &str, sets: &[String]) -> Option<Scene> {
    let sets: Vec<Override> = sets.iter().map(|set| set.parse().unwrap()).collect();
    Scene::load_with(name, &sets).ok()
}

/// Presets, then operating points; `wide`: by which power of the usual factors.
fn cases(n: usize, wide: f64) -> Vec<Case> {
    let named = |name: &str, sets: Vec<String>| Case {
        name: name.to_owned(),
        sets,
    };
    let names: Vec<&str> = presets::all().iter().map(|preset| preset.name).collect();
    let with_life = |name: &&str| load(name, &[]).unwrap().life.is_some();
    let names: Vec<&str> = names.into_iter().filter(with_life).collect();
    let mut cases: Vec<Case> = names.iter().map(|name| named(name, Vec::new())).collect();
    let mut sequence = Sequence(33, wide);
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

/// Values of a summary with their bands; of lives the logarithm.
fn values(s: &Summary) -> [(&'static str, f64, f64); 4] {
    let nan = f64::NAN;
    let ln = s.life_relative.map_or(nan, f64::ln);
    [
        (
            "central film",
            s.h_central_m,
            s.error_h_central_m.unwrap_or(nan),
        ),
        ("least film", s.h_min_m, s.error_h_min_m.unwrap_or(nan)),
        ("max pressure", s.p_max_pa, s.error_p_max_pa.unwrap_or(nan)),
        ("ln life", ln, s.error_ln_life.unwrap_or(nan)),
    ]
}

fn run(case: &Case, nodes: usize, passages: f64) -> Option<Summary> {
    let outcome = outcome(case, nodes, passages, true)?;
    matches!(outcome.end, End::Done).then_some(outcome.summary)?
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

/// Of one quantity of one case: value, band, truth, and what the meshes below had.
type Row = (String, &'static str, f64, f64, f64);

fn rows(case: &Case) -> Vec<Row> {
    let kind = load(&case.name, &case.sets).unwrap().kind();
    let (nodes, passages) = match kind {
        ContactKind::Point => (129, 1.0),
        ContactKind::Line => (257, 3.0),
    };
    let both = run(case, nodes, passages).zip(run(case, 2 * nodes - 1, 4.0 * passages));
    let Some((one, truth)) = both else {
        return Vec::new();
    };
    let label = format!("{} {}", case.name, case.sets.join(" "));
    let mut rows: Vec<Row> = (values(&one).into_iter().zip(values(&truth)))
        .map(|((name, value, band), (_, truth, _))| (label.clone(), name, value, band, truth))
        .collect();
    // What the first mesh said, against the truth.
    if let (Some(first), Some(true_life)) = (one.rungs.first(), truth.life_relative)
        && let (Some(life), Some(high)) = (first.life_relative, first.life_relative_high)
    {
        let band = (high / life).ln();
        rows.push((label, "first ln life", life.ln(), band, true_life.ln()));
    }
    rows
}

#[test]
#[ignore = "an hour of a processor"]
fn how_often_they_cover_the_truth() {
    let asked = std::env::var("ASPERITY_CASES").unwrap_or_default();
    let (from, to) = asked.split_once("..").unwrap_or(("0", &asked));
    let (from, to) = (from.parse().unwrap_or(0), to.parse().unwrap_or(CASES));
    let cases: Vec<Case> = cases(CASES, 1.0).into_iter().take(to).skip(from).collect();
    let tell = |case: &Case| {
        let rows = rows(case);
        for (case, name, value, band, truth) in &rows {
            let off = (value - truth).abs();
            let ratio = band / off;
            println!("{name:14} {value:+.4e} band {band:.2e} off {off:.2e} {ratio:6.2}  {case}");
        }
        rows
    };
    let found = share_out(&cases, 2, tell, &mut |_, _| {});
    let all: Vec<Row> = found.into_iter().flatten().collect();
    println!("\n| quantity | cases | covered | band over error, median |\n|---|---|---|---|");
    for name in [
        "central film",
        "least film",
        "max pressure",
        "ln life",
        "first ln life",
    ] {
        let of = all.iter().filter(|row| row.1 == name && row.3.is_finite());
        let mut ratios: Vec<f64> = of
            .map(|row| row.3 / (row.2 - row.4).abs().max(1e-300))
            .collect();
        ratios.sort_by(f64::total_cmp);
        let covered = ratios.iter().filter(|ratio| **ratio >= 1.0).count();
        let median = ratios.get(ratios.len() / 2).copied().unwrap_or(f64::NAN);
        println!("| {name} | {} | {covered} | {median:.1} |", ratios.len());
    }
    assert!(!all.is_empty());
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
    let found = share_out(&cases(n, 2.0), 2, tell, &mut |_, _| {});
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
