//! Each counted cycle is ticked: on the simulation's own traces, against peaks found in the whole crossing
//! afterwards by their prominence (how far one must go down from a peak to reach a higher one).
#![cfg(feature = "tui")]
#![expect(clippy::unwrap_used, reason = "tests")]

use asperity_engine::plan::Plan;
use asperity_engine::scene::{Override, Scene};
use asperity_engine::sim::{Follow, Frame, MaterialPoint, Simulation, Stage};
use asperity_explorer::tui::trace::Trace;

/// Rainflow's gate, p_h.
const GATE: f64 = 0.05;

/// Places of the peaks with a prominence of at least the gate, in the order of the crossing.
fn prominent(crossing: &[MaterialPoint], gate_pa: f64) -> Vec<f64> {
    let p: Vec<f64> = crossing.iter().map(|point| point.pressure_pa).collect();
    // Down to the least value on the way to a higher one, or to no pressure beyond the end.
    let way_down = |i: usize, side: &mut dyn Iterator<Item = &f64>| {
        let mut least = p[i];
        for value in side {
            if *value > p[i] {
                return p[i] - least;
            }
            least = least.min(*value);
        }
        p[i]
    };
    let is_peak = |i: &usize| {
        let before = way_down(*i, &mut p[..*i].iter().rev());
        // Of two equal ones the second is the peak.
        let equal_follows = p[i + 1..].iter().take_while(|v| p[*i] - **v < gate_pa);
        let later = equal_follows.into_iter().any(|v| *v == p[*i]);
        let after = way_down(*i, &mut p[i + 1..].iter());
        !later && before.min(after) >= gate_pa
    };
    let all = (0..p.len()).filter(is_peak);
    all.map(|i| crossing[i].x_m).collect()
}

/// What was seen of one crossing.
struct Crossing {
    points: Vec<MaterialPoint>,
    /// Ticks when its point left: places and numbers.
    ticks: Vec<(f64, u32)>,
    /// Closed cycles, told afterwards.
    closed: Option<f64>,
}

/// Whole crossings of a scene's shown point.
fn crossings(sets: &[&str], wanted: usize) -> (Vec<Crossing>, f64) {
    let common = ["grid.nodes=65", "stress.depths=8"];
    let sets: Vec<Override> = common
        .iter()
        .chain(sets)
        .map(|text| text.parse().unwrap())
        .collect();
    let scene = Scene::load_with("demonstration_quick", &sets).unwrap();
    let plan = Plan::new(&scene).unwrap();
    let gate_pa = GATE * plan.hertz.p_max_pa;
    let mut sim = Simulation::new(&scene, plan, 1).unwrap();
    let mut frame = Frame::default();
    let (mut trace, mut points, mut found) = (Trace::default(), Vec::new(), Vec::new());
    let mut last: Option<MaterialPoint> = None;
    while found.len() < wanted {
        sim.step().unwrap();
        sim.fill(&mut frame);
        if sim.passage_steps() == 1 {
            // Chosen: whoever governs, this one is followed.
            let depth_m = frame.material_point.map_or(0.0, |point| point.depth_m);
            sim.show_point(Follow {
                body: 1,
                depth_m,
                x_m: None,
            });
        }
        let Some(point) = frame
            .material_point
            .filter(|_| frame.stage == Stage::Passage)
        else {
            continue;
        };
        if last.is_some_and(|last| (point.x_m - last.x_m).abs() > frame.a_m) {
            let ticks = trace.ticks().iter().map(|tick| (tick.x_m, tick.number));
            found.push(Crossing {
                points: std::mem::take(&mut points),
                ticks: ticks.collect(),
                closed: point.cycles_before,
            });
        }
        trace.push(&point, frame.a_m);
        points.push(point);
        last = Some(point);
    }
    // The first may have begun inside the contact.
    found.remove(0);
    (found, gate_pa)
}

fn ticked(name: &str, sets: &[&str]) -> Vec<usize> {
    let (found, gate_pa) = crossings(sets, 4);
    let mut counts = Vec::new();
    for crossing in &found {
        let peaks = prominent(&crossing.points, gate_pa);
        let ticks: Vec<f64> = crossing.ticks.iter().map(|tick| tick.0).collect();
        let numbers: Vec<u32> = crossing.ticks.iter().map(|tick| tick.1).collect();
        println!("{name}: peaks {peaks:?}, closed {:?}", crossing.closed);
        assert_eq!(ticks, peaks, "{name}");
        let expected: Vec<u32> = (1..=peaks.len() as u32).collect();
        assert_eq!(numbers, expected, "{name}");
        assert_eq!(crossing.closed, Some(peaks.len() as f64), "{name}");
        counts.push(peaks.len());
    }
    counts
}

#[test]
fn a_smooth_crossing_has_one_tick() {
    let smooth = [
        "motion.slide_roll=0",
        "body_1.surface.amplitude_m=0",
        "body_2.surface.amplitude_m=0",
    ];
    assert_eq!(ticked("smooth", &smooth), [1, 1, 1]);
}

#[test]
fn every_peak_of_a_comb_is_ticked() {
    let waves = [
        "body_1.surface.wavelength_x_m=2e-4",
        "body_2.surface.wavelength_x_m=2e-4",
        "body_2.surface.wavelength_y_m=2e-4",
    ];
    for slide_roll in ["-0.5", "0.5", "1"] {
        let slide_roll = format!("motion.slide_roll={slide_roll}");
        let mut sets = vec![slide_roll.as_str()];
        sets.extend(waves);
        let counts = ticked(&slide_roll, &sets);
        assert!(counts.iter().all(|count| *count >= 2), "{counts:?}");
    }
}

#[test]
fn bodies_that_run_backwards_are_ticked_too() {
    let sets = [
        "motion.entrainment_m_s=-1",
        "motion.slide_roll=0.5",
        "body_1.surface.wavelength_x_m=2e-4",
        "body_2.surface.wavelength_x_m=2e-4",
        "body_2.surface.wavelength_y_m=2e-4",
    ];
    let counts = ticked("backwards", &sets);
    assert!(counts.iter().all(|count| *count >= 2), "{counts:?}");
}
