//! What the counts of stress cycles are worth: n by formula beside the cycles that rainflow counts, in every preset.
//!
//! ```text
//! n = 1 + f δ              crests of the mate that pass while a point crosses Hertz's width 2a
//! n_z = 1 + f δ z/2a       the same over the zone z in which the greatest pressure passes the gate: crests that stand
//!                          apart make a contact longer than Hertz's
//! n − 1.5 ≤ counted ≤ n_z + 0.5               and               equivalent ≤ 1.02 n
//! ```
//! The count leaves out crests whose ripple is below the gate (at most one and a half at the edges, in these scenes: where Hertz's pressure ends, oil that flows along the sliding gives way to
//! ripples, and of two crests that a crossing meets at its ends one may be lost in some crossings and both in others) and takes in
//! small cycles of the oil's own: at the pitch point, in pure rolling, 1.4 are counted with oil and 1.0 without.
//! Cycles of the greatest range that do the same damage by Miner's rule are no more than n: that is the sense in which
//! n is an upper bound.

#![allow(clippy::unwrap_used, reason = "tests")]

use asperity_engine::physics::strength::HARDENED_STEEL;
use asperity_engine::plan::Plan;
use asperity_engine::scene::{ContactKind, Override, Scene, presets};
use asperity_engine::sim::{CautionCode, Frame, Simulation, Stage, Summary};
use asperity_engine::solve::material::{Line, MaterialTracker, TrackerSpec};

/// Gates on the pressure's ranges, p_h; the second is the program's.
const GATES: [f64; 4] = [0.02, TrackerSpec::PRESSURE_GATE, 0.1, 0.25];
const USUAL: usize = 1;

/// What a run counts on one body.
struct Count {
    n: f64,
    /// n over the loaded zone.
    zone: f64,
    /// By rainflow, one for each gate.
    counted: [f64; 4],
    /// Cycles of the greatest range that do the same damage.
    equivalent: f64,
    crossings: u64,
}

struct Run {
    body: [Option<Count>; 2],
    p_greatest_pa: f64,
    von_mises_pa: f64,
    summary: Summary,
}

fn scene(name: &str, sets: &[&str]) -> Scene {
    let sets: Vec<Override> = sets.iter().map(|set| set.parse().unwrap()).collect();
    Scene::load_with(name, &sets).unwrap()
}

/// Trackers of both bodies, one for each gate, on the row y = 0 of a run's frames.
struct Counting {
    trackers: Vec<MaterialTracker>,
    line: Vec<f32>,
    /// Greatest pressure that each node has seen, p_h.
    greatest: Vec<f32>,
    before_s: f64,
}

impl Counting {
    fn new(frame: &Frame) -> Self {
        let first = frame.x_min_m / frame.a_m;
        let last = first + (frame.nx - 1) as f64 * frame.dx_m / frame.a_m;
        let tracker = |gate: f64| {
            let mut spec = TrackerSpec::new((first, last), 0, 31.0 / 3.0);
            spec.pressure_gate = gate;
            MaterialTracker::new(spec)
        };
        Self {
            trackers: [GATES, GATES].concat().into_iter().map(tracker).collect(),
            line: vec![0.0; frame.nx],
            greatest: vec![0.0; frame.nx],
            before_s: 0.0,
        }
    }

    fn step(&mut self, frame: &Frame, speeds_m_s: [f64; 2]) {
        let axis = &frame.pressure_pa[frame.ny / 2 * frame.nx..][..frame.nx];
        for ((now, most), p) in self.line.iter_mut().zip(&mut self.greatest).zip(axis) {
            *now = p / frame.p_hertz_pa as f32;
            *most = most.max(*now);
        }
        let line = Line {
            x_first: frame.x_min_m / frame.a_m,
            dx: frame.dx_m / frame.a_m,
            pressure: &self.line,
            tau_xz: None,
            effective: None,
        };
        let dt_s = frame.time_s - self.before_s;
        self.before_s = frame.time_s;
        for (i, tracker) in self.trackers.iter_mut().enumerate() {
            tracker.step(speeds_m_s[i / GATES.len()] * dt_s / frame.a_m, 1.2, &line);
        }
    }

    fn count(&self, body: usize, frame: &Frame) -> Option<Count> {
        let n = [frame.metrics.n_body_1, frame.metrics.n_body_2][body]?;
        let mine = &self.trackers[body * GATES.len()..][..GATES.len()];
        let usual = mine[USUAL].pressure_cycles()?;
        let loaded = self
            .greatest
            .iter()
            .filter(|p| f64::from(**p) > GATES[USUAL]);
        let zone = loaded.count() as f64 * frame.dx_m / (2.0 * frame.a_m);
        Some(Count {
            n,
            zone: 1.0 + (n - 1.0) * zone,
            counted: [0, 1, 2, 3].map(|i| mine[i].pressure_cycles().map_or(0.0, |t| t.count)),
            equivalent: usual.equivalent,
            crossings: mine[USUAL].crossings(),
        })
    }
}

fn run(name: &str, sets: &[&str], passages: f64) -> Run {
    let scene = scene(name, sets);
    let plan = Plan::new(&scene).unwrap();
    let mut sim = Simulation::new(&scene, plan, 1).unwrap();
    let mut frame = Frame::default();
    let mut counting: Option<Counting> = None;
    let (mut p_greatest_pa, mut von_mises_pa) = (0.0_f64, 0.0_f64);
    while sim.stage() == Stage::StartUp || frame.passages < passages {
        sim.step().unwrap();
        if sim.stage() == Stage::StartUp {
            continue;
        }
        sim.fill(&mut frame);
        let counting = counting.get_or_insert_with(|| Counting::new(&frame));
        counting.step(&frame, scene.speeds_m_s());
        p_greatest_pa = p_greatest_pa.max(frame.metrics.p_max_pa);
        von_mises_pa = von_mises_pa.max(frame.metrics.sigma_eff_max_pa.unwrap_or(0.0));
    }
    let counting = counting.unwrap();
    Run {
        body: [0, 1].map(|body| counting.count(body, &frame)),
        p_greatest_pa,
        von_mises_pa,
        summary: sim.summary(),
    }
}

/// Passages in which points of the slower body cross.
fn passages(scene: &Scene) -> f64 {
    let slowest = 1.0 - 0.5 * scene.motion.slide_roll.abs();
    1.25 / slowest + 0.75
}

#[test]
fn counts_and_pressures_of_every_preset() {
    for preset in presets::all() {
        let scene = Scene::load(preset.name).unwrap();
        // Points on few nodes: what is counted does not hang on the mesh by what is allowed here.
        let nodes = match scene.kind() {
            ContactKind::Point => "grid.nodes=65".to_owned(),
            ContactKind::Line => format!("grid.nodes={}", scene.grid.nodes),
        };
        let sets = ["life=none", "record=none", "stress.depths=16", &nodes];
        let run = run(preset.name, &sets, passages(&scene));
        println!(
            "{:18} greatest {:.2} GPa, von Mises {:.2} GPa",
            preset.name,
            1e-9 * run.p_greatest_pa,
            1e-9 * run.von_mises_pa
        );
        for (i, count) in run.body.iter().enumerate() {
            let count = count.as_ref().unwrap();
            let counted = count.counted[USUAL];
            println!(
                "{:18} body {}: n {:.2}, over the loaded zone {:.2}, counted {counted:.2}, equivalent {:.2} ({} crossings)",
                "",
                i + 1,
                count.n,
                count.zone,
                count.equivalent,
                count.crossings
            );
            assert!(count.crossings > 0 && counted >= 0.9, "{}", preset.name);
            assert!(counted >= count.n - 1.5, "{}", preset.name);
            assert!(counted <= count.zone + 0.5, "{}", preset.name);
            assert!(count.equivalent <= 1.02 * count.n, "{}", preset.name);
        }
        // Within what steel carries, or the run says otherwise.
        let steel = HARDENED_STEEL;
        assert!(run.p_greatest_pa < steel.hardness_pa, "{}", preset.name);
        let said = |code| run.summary.cautions.iter().any(|said| said.code == code);
        assert!(
            run.von_mises_pa <= steel.yield_pa || said(CautionCode::BeyondYield),
            "{}",
            preset.name
        );
    }
}
