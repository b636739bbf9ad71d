//! Lives over loads, speeds and radii: one reference for all, and the order that a calibration point gives.
#![expect(clippy::unwrap_used, reason = "tests")]

use super::sweep::{fill, sweep};
use asperity_session::sweep::Rows;

/// Presets, the key of their load in newtons, its values, and nodes that carry the waves. Another radius under one load is another
/// pressure, which both know; at one pressure a calibration point knows no size, while the stressed volume does.
const PRESETS: [(&str, &str, [f64; 3], u32); 5] = [
    (
        "demonstration_quick",
        "load.force_n",
        [400.0, 800.0, 1600.0],
        65,
    ),
    ("ball_bearing", "load.force_n", [1200.0, 2470.0, 5000.0], 65),
    ("twin_disc", "load.force_n", [700.0, 1410.0, 2800.0], 65),
    (
        "ball_bearing_worn",
        "load.force_n",
        [520.0, 1040.0, 2080.0],
        65,
    ),
    ("fzg_point_b", "load.force_n_per_m", [2e5, 4.22e5, 8e5], 129),
];

#[derive(Clone, Copy)]
struct Row {
    load_factor: f64,
    p_hertz_pa: f64,
    a_m: f64,
    common: f64,
    calibrated: f64,
    relative: f64,
}

fn rows(preset: &str, nodes: u32, key: &str, values: &[f64]) -> Vec<Row> {
    let text = format!(
        "scene = \"{preset}\"\n[set]\ngrid.nodes = {nodes}\nstress.depths = 8\nlife.spread = \"off\"\ntime.passages = 1.0\n\
         life.calibration_cycles = 1e8\nlife.calibration_pressure_pa = 2e9\n[vary]\n{key} = {values:?}\n"
    );
    let sweep = sweep(&text);
    let root = tempfile::tempdir().unwrap();
    let (folder, _) = fill(&sweep, root.path(), None, 2);
    let rows = Rows::gather(&sweep, &[folder]).unwrap();
    let column = |name| rows.column(&sweep, name).unwrap();
    let (common, calibrated, relative) = (
        column("life_common"),
        column("life_cycles"),
        column("life_relative"),
    );
    let (load_factor, p_hertz_pa, a_m) =
        (column("load_factor"), column("p_hertz_pa"), column("a_m"));
    let row = |k: usize| Row {
        load_factor: load_factor[k],
        p_hertz_pa: p_hertz_pa[k],
        a_m: a_m[k],
        common: common[k],
        calibrated: calibrated[k],
        relative: relative[k],
    };
    (0..values.len()).map(row).collect()
}

/// Pairs of cases of which the first lives longer by more than `room`.
fn order(rows: &[Row], of: fn(&Row) -> f64, room: f64) -> Vec<(usize, usize)> {
    let pairs = (0..rows.len()).flat_map(|one| (0..rows.len()).map(move |two| (one, two)));
    pairs
        .filter(|&(one, two)| of(&rows[one]) > (1.0 + room) * of(&rows[two]))
        .collect()
}

/// What a calibration point leaves out: it goes by the Hertz pressure alone, while the smooth contact's spike changes with the
/// speed (6 % of its life from .5 to 2 times the speed of the ball bearing).
const SPIKE: f64 = 0.08;

#[test]
fn lives_of_a_sweep_have_the_order_that_a_calibration_point_gives() {
    let mut misled = 0;
    for (preset, load, loads, nodes) in PRESETS {
        let scene = asperity_engine::scene::Scene::load(preset).unwrap();
        let around = |value: f64| [0.5, 1.0, 2.0].map(|factor| factor * value);
        let axes = [
            (load, loads),
            (
                "motion.entrainment_m_s",
                around(scene.motion.entrainment_m_s),
            ),
            ("contact.rx_m", around(scene.contact.rx_m)),
        ];
        let mut base = None;
        for (key, values) in axes {
            // The base scene is a case of each: made once, with the loads.
            let [low, _, high] = values;
            let rows = match base {
                None => rows(preset, nodes, key, &values),
                Some(base) => {
                    let ends = rows(preset, nodes, key, &[low, high]);
                    vec![ends[0], base, ends[1]]
                }
            };
            base = Some(rows[1]);
            for (value, row) in values.iter().zip(&rows) {
                println!(
                    "{preset} {key} {value:.4e}: relative {:.4e}, common {:.4e}, calibrated {:.4e} cycles, ratio {:.4e}",
                    row.relative,
                    row.common,
                    row.calibrated,
                    row.calibrated / row.common
                );
            }
            let by_calibration = order(&rows, |row| row.calibrated, 0.0);
            for pair in order(&rows, |row| row.common, SPIKE) {
                assert!(by_calibration.contains(&pair), "{preset} {key}: {pair:?}");
            }
            let own = order(&rows, |row| row.relative, SPIKE);
            misled += usize::from(!own.iter().all(|pair| by_calibration.contains(pair)));
            // The base scene is one of the cases: there both lives are one.
            let [_, base, _] = &rows[..] else { panic!() };
            assert!(
                (base.common / base.relative - 1.0).abs() < 1e-9,
                "{preset} {key}"
            );
            // Of one shape, as Hertz has it: pressure to the power of c, and the stressed volume.
            let is_line = scene.contact.ry_m.is_none();
            if is_line || key != "contact.rx_m" {
                let (lengths, weibull_slope) = if is_line {
                    (2.0, 9.0 / 8.0)
                } else {
                    (3.0, 10.0 / 9.0)
                };
                for row in &rows {
                    let stress = (row.p_hertz_pa / base.p_hertz_pa).powf(-31.0 / 3.0);
                    let hertz = stress * (row.a_m / base.a_m).powf(-lengths / weibull_slope);
                    println!(
                        "  load factor {:.4e}, by Hertz {hertz:.4e}",
                        row.load_factor
                    );
                    assert!(
                        (row.load_factor / hertz).ln().abs() < SPIKE,
                        "{preset} {key}"
                    );
                }
            }
        }
    }
    // What the pictures showed before: not the same.
    println!(
        "{misled} of 15 sweeps have pairs in the wrong order by the life relative to each one's own smooth contact"
    );
    assert!(misled >= 3);
}

/// Two loads side by side: the second life against the first one's smooth contact, as Hertz has it (p_h ∝ W^(1/3), I ∝ p_h^(c e) a³).
#[test]
fn lives_beside_each_other_have_one_reference() {
    let folder = tempfile::tempdir().unwrap();
    let run = |sets: &[&str]| {
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_asperity"))
            .args([
                "run",
                "demonstration_quick",
                "--force",
                "--threads=1",
                "--out=both.rrd",
            ])
            .args([
                "--set=grid.nodes=65",
                "--set=stress.depths=16",
                "--passages=0.5",
            ])
            .args(sets)
            .current_dir(folder.path())
            .output()
            .unwrap();
        assert!(output.status.success());
        String::from_utf8(output.stdout).unwrap()
    };
    let after = |text: &str, label: &str| -> f64 {
        let at = text.find(label).unwrap() + label.len();
        let word = text[at..].split_whitespace().next().unwrap();
        word.parse().unwrap()
    };
    let told = run(&["--beside=load.force_n=400,800"]);
    let told = &told[told.find("side by side").unwrap()..];
    let lines: Vec<&str> = told
        .lines()
        .filter(|line| line.contains(": life "))
        .collect();
    let [one, two] = lines.as_slice() else {
        panic!("{told}")
    };
    // The first one's reference is its own.
    assert_eq!(after(one, ": life "), after(one, "contact, "), "{one}");
    let ratio = after(two, "contact, ") / after(two, ": life ");
    let hertz = 2_f64.powf(-(31.0 / 3.0 + 2.7) / 3.0);
    println!("{one}\n{two}\nratio {ratio:.4}, by Hertz {hertz:.4}");
    assert!((ratio / hertz).ln().abs() < SPIKE, "{ratio} {hertz}");
    // Lives by two models have none.
    std::fs::rename(folder.path().join("both.rrd"), folder.path().join("x.rrd")).unwrap();
    let told = run(&["--beside=life.survival=0.5,0.9"]);
    assert!(told.contains("not comparable"), "{told}");
}

/// At S = 0 the crests of both bodies meet as they happen to stand: where nobody has asked how, a case's band holds them all.
#[test]
fn a_case_that_rolls_has_a_band_over_phases() {
    let lives = |phase: &str, slides: &str| {
        let sweep = sweep(&format!(
            "scene = \"fzg_point_b\"\n[set]\ngrid.nodes = 129\nstress.depths = 8\n{phase}\n[vary]\nmotion.slide_roll = [{slides}]\n"
        ));
        let root = tempfile::tempdir().unwrap();
        let (folder, _) = fill(&sweep, root.path(), None, 2);
        let rows = Rows::gather(&sweep, &[folder]).unwrap();
        [
            "life_relative",
            "life_relative_low",
            "life_relative_high",
            "life_phases_high",
        ]
        .map(|name| rows.column(&sweep, name).unwrap())
    };
    let [life, low, high, phases] = lives("", "0.0, 0.44");
    let [other, _, _, none] = lives("body_1.surface.phase_deg = 180.0", "0.0");
    println!(
        "S = 0: {} ({} to {}), half a wave on {}",
        life[0], low[0], high[0], other[0]
    );
    assert!(other[0] / life[0] > 1.2, "{} {}", life[0], other[0]);
    assert!(low[0] <= other[0] && other[0] <= high[0]);
    assert!(phases[0] <= high[0] && phases[1].is_nan());
    // Who asks for a phase gets it.
    assert!(none[0].is_nan());
}
