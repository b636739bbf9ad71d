//! Crests that press nothing: the formula counts them, the contact does not feel them, and nothing jumps on the way from no
//! amplitude to one that is felt.
#![allow(clippy::unwrap_used, reason = "tests")]

use asperity_engine::plan::Plan;
use asperity_engine::scene::{Override, Scene, presets};
use asperity_engine::sim::{CautionCode, Simulation, Summary};

/// A run of a small scene in which only `rough` has crests, of that amplitude.
/// With how much of them is felt.
fn run(kind: &str, rough: usize, amplitude_m: f64) -> (Summary, f64) {
    run_until(kind, rough, amplitude_m, |sim| sim.passage_steps() >= 12)
}

fn run_until(
    kind: &str,
    rough: usize,
    amplitude_m: f64,
    is_enough: impl Fn(&Simulation) -> bool,
) -> (Summary, f64) {
    let mut sets = vec![
        "grid.nodes=33".to_owned(),
        "stress.depths=8".to_owned(),
        "motion.slide_roll=0.5".to_owned(),
        format!("body_{}.surface.kind=smooth", 3 - rough),
        format!("body_{rough}.surface.wavelength_x_m=4e-4"),
        format!("body_{rough}.surface.wavelength_y_m=inf"),
        format!("body_{rough}.surface.amplitude_m={amplitude_m:e}"),
    ];
    if kind == "line" {
        sets.extend(["contact.kind=line", "load.hertz_pressure_pa=1.7e9"].map(str::to_owned));
    }
    let sets: Vec<Override> = sets.iter().map(|set| set.parse().unwrap()).collect();
    let scene = Scene::load_with(presets::DEFAULT, &sets).unwrap();
    let plan = Plan::new(&scene).unwrap();
    let wave = plan.waves[rough - 1].unwrap();
    let felt = wave.felt(amplitude_m, plan.hertz.p_max_pa);
    let mut sim = Simulation::new(&scene, plan, 1).unwrap();
    while !is_enough(&sim) {
        sim.step().unwrap();
    }
    (sim.summary(), felt)
}

/// What must not jump: the spread over the choices, and the band.
fn curve(summary: &Summary) -> [f64; 4] {
    [
        summary.life_models_low,
        summary.life_models_high,
        summary.life_relative_low,
        summary.life_relative_high,
    ]
    .map(|value| value.unwrap().ln())
}

fn says(summary: &Summary) -> Option<&str> {
    let mut all = summary.cautions.iter();
    let found = all.find(|caution| caution.code == CautionCode::CrestsNotFelt);
    found.map(|caution| caution.text.as_str())
}

#[test]
fn nothing_jumps_from_no_amplitude_to_one_that_is_felt() {
    for kind in ["point", "line"] {
        for rough in [1, 2] {
            let (none, _) = run(kind, rough, 0.0);
            let smooth = curve(&none);
            let mut before = smooth;
            assert_eq!(says(&none), None, "{kind}, body {rough}");
            for power in [
                -15.0, -13.0, -11.0, -10.5, -10.0, -9.75, -9.5, -9.25, -9.0, -8.5, -8.0, -7.0,
            ] {
                let amplitude_m = 10_f64.powf(power);
                let (summary, felt) = run(kind, rough, amplitude_m);
                let now = curve(&summary);
                println!(
                    "{kind}, body {rough}, {amplitude_m:.1e} m: {now:.3?}, {:?}",
                    says(&summary)
                );
                if power <= -8.0 {
                    for (one, other) in now.iter().zip(before) {
                        assert!(
                            (one - other).abs() < 0.5,
                            "{kind}, body {rough}, {power}: {now:?}, {before:?}"
                        );
                    }
                }
                // The formula stays the paper's, whatever is felt.
                let n = [summary.n_body_1, summary.n_body_2];
                assert!(n[2 - rough].unwrap() > 1.2, "{kind}, body {rough}: {n:?}");
                let words = says(&summary);
                assert_eq!(
                    words.is_some(),
                    felt < 1.0,
                    "{kind}, body {rough}, {power}: {words:?}"
                );
                if power < -11.0 {
                    let paper = summary.life_global.unwrap();
                    assert!(paper < 0.9, "{paper}");
                    assert!(
                        now.iter()
                            .zip(smooth)
                            .all(|(now, smooth)| (now - smooth).abs() < 0.01),
                        "{kind}, body {rough}: {now:?}"
                    );
                    let words = words.unwrap();
                    assert!(
                        words.contains(&format!("crests of body {rough}")),
                        "{words}"
                    );
                    assert!(words.contains("0.1 %"), "{words}");
                }
                before = now;
            }
        }
    }
}

/// Crests that press, but not enough for a point to be unloaded between them: nothing but the formula counts them.
#[test]
fn crests_that_no_point_counts_are_left_out() {
    for kind in ["point", "line"] {
        for rough in [1, 2] {
            let mut seen = [0, 0];
            let mut before = 0.0;
            let finely = (0..=36).map(|step| -6.9 + 0.025 * f64::from(step));
            for power in [-15.0, -9.0, -8.0, -7.5, -7.0].into_iter().chain(finely) {
                let amplitude_m = 10_f64.powf(power);
                let (summary, _) = run_until(kind, rough, amplitude_m, |sim| {
                    let m = sim.summary();
                    let counted = [m.n_counted_body_1, m.n_counted_body_2];
                    counted[2 - rough].is_some() && sim.passage_steps() >= 60
                });
                let counted = [summary.n_counted_body_1, summary.n_counted_body_2];
                let (n, counted) = (
                    [summary.n_body_1, summary.n_body_2][2 - rough].unwrap(),
                    counted[2 - rough].unwrap(),
                );
                let now = curve(&summary);
                println!(
                    "{kind}, body {rough}, {amplitude_m:.1e} m: {n:.3}, {counted:.3}, {now:.3?}"
                );
                // Left out: the spread is that of the models alone, all of which know the same crests.
                let (says, low, life) = (says(&summary), now[0], summary.life_relative.unwrap());
                if counted == 1.0 {
                    assert!(says.unwrap().contains("count 1.00"), "{says:?}");
                    assert!(low > life.ln() - 0.1, "{low}, {}", life.ln());
                    seen[0] += 1;
                } else if counted > 1.0 + 0.1 * (n - 1.0) {
                    assert_eq!(says, None);
                    seen[1] += 1;
                }
                // The life falls by itself; what is left out comes in step by step.
                let below = low - life.ln();
                assert!((below - before).abs() < 0.8, "{below}, {before}");
                before = below;
            }
            assert!(
                seen.iter().all(|n| *n > 0),
                "{kind}, body {rough}: {seen:?}"
            );
        }
    }
}

/// What comes with the program is felt, so that nothing of it has changed.
#[test]
fn the_presets_are_felt() {
    for preset in presets::all() {
        let scene = Scene::load(preset.name).unwrap();
        let plan = Plan::new(&scene).unwrap();
        for wave in plan.waves.into_iter().flatten() {
            assert_eq!(
                wave.felt(wave.amplitude_m, plan.hertz.p_max_pa),
                1.0,
                "{}",
                preset.name
            );
        }
    }
}
