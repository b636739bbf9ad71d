//! The page of a report: no number in it that the sweep's tables do not hold, and what they hold by another way.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::collections::HashMap;
use std::path::Path;

use super::sweep::{FEW, asperity, refused};

/// A tooth under two loads, on a mesh that carries its waves barely: what is tested is arithmetic.
const TOOTH: &str = r#"
title = "<script>alert(1)</script> tooth"
scene = "fzg_pitch_point"
[set]
grid.nodes = 65
stress.depths = 12
life.calibration_cycles = 1e8
life.calibration_pressure_pa = 1.7e9
[gear]
teeth = [16, 24]
module_m = 0.0045
centre_distance_m = 0.0915
tip_diameters_m = [0.08246, 0.11836]
face_width_m = 0.014
points = 2
"#;
const TWO: &str = "spectrum = [{ torque_n_m = 150.0, speed_rpm = 1500.0, time_share = 0.8 }, \
                   { torque_n_m = 200.0, speed_rpm = 1000.0, time_share = 0.2 }]\n";
/// One load, and the same said twice.
const ONE: &str = "torque_n_m = 200.0\nspeed_rpm = 1000.0\n";
const SAME: &str = "spectrum = [{ torque_n_m = 200.0, speed_rpm = 1000.0, time_share = 0.3 }, \
                    { torque_n_m = 200.0, speed_rpm = 1000.0, time_share = 0.7 }]\n";

type Rows = Vec<HashMap<String, String>>;

fn rows(file: &Path) -> Rows {
    let mut reader = csv::Reader::from_path(file).unwrap();
    reader.deserialize().map(Result::unwrap).collect()
}

fn number(row: &HashMap<String, String>, name: &str) -> f64 {
    row[name].parse().unwrap()
}

/// Runs a sweep of that text there.
fn swept(root: &Path, name: &str, text: &str) {
    std::fs::write(root.join(format!("{name}.toml")), text).unwrap();
    let done = asperity(root, &["sweep", &format!("{name}.toml"), "--out", name]);
    assert!(matches!(done.status.code(), Some(0 | 2)), "{done:?}");
}

#[test]
fn a_page_has_the_numbers_of_its_tables_and_no_others() {
    let root = tempfile::tempdir().unwrap();
    let root = root.path();
    swept(root, "two", &format!("{TOOTH}{TWO}"));
    assert_eq!(asperity(root, &["report", "two"]).status.code(), Some(0));
    let page = std::fs::read_to_string(root.join("two/report.html")).unwrap();
    assert!(!page.contains("<script") && page.contains("&lt;script"));
    let table = rows(&root.join("two/table.csv"));
    let mut seen = 0;
    for cell in page.split("<td data-column=\"").skip(1) {
        let (column, rest) = cell.split_once('"').unwrap();
        let case = rest.split('"').nth(1).unwrap();
        let shown = rest.split_once('>').unwrap().1.split('<').next().unwrap();
        let held = &table[case.parse::<usize>().unwrap()][column];
        if held.is_empty() {
            assert_eq!(shown, "–", "{column} of case {case}");
            continue;
        }
        let (shown, held): (f64, f64) = (shown.parse().unwrap(), held.parse().unwrap());
        // Three figures in another unit: the ratio is a power of ten, or 100 for shares.
        let unit = if held == 0.0 {
            1.0
        } else {
            10_f64.powf((shown / held).abs().log10().round())
        };
        assert!(
            (shown - held * unit).abs() <= 5.1e-3 * shown.abs(),
            "{column} {shown} {held}"
        );
        seen += 1;
    }
    assert!(seen > 200, "{seen} cells");
    assert!(
        page.contains("ISO/TS 6336-22")
            && page.contains("Miner")
            && page.matches("<svg").count() >= 5
    );
    // A sweep's own page is written again, another's is not.
    assert_eq!(asperity(root, &["report", "two"]).status.code(), Some(0));
    std::fs::write(root.join("mine.html"), "mine").unwrap();
    refused(
        &asperity(root, &["report", "two", "--out", "mine.html"]),
        4,
        &["mine.html"],
    );
}

#[test]
fn a_recording_s_page_has_its_pictures_and_says_what_it_said() {
    let root = tempfile::tempdir().unwrap();
    let root = root.path();
    let line = "run demonstration_quick --nodes 65 --passages 0.25 --set numerics.ladder=false --set time.step_nodes=2 \
                --out run.rrd";
    let mut line: Vec<&str> = line.split(' ').filter(|word| !word.is_empty()).collect();
    line.extend(["--set", "title=<script>alert(1)</script>"]);
    let done = asperity(root, &line);
    assert!(matches!(done.status.code(), Some(0 | 2)), "{done:?}");
    let done = asperity(root, &["report", "run.rrd"]);
    assert_eq!(done.status.code(), Some(0), "{done:?}");
    let page = std::fs::read_to_string(root.join("run.html")).unwrap();
    assert!(!page.contains("<script") && page.contains("&lt;script"));
    assert!(
        page.matches("<svg").count() >= 4
            && page.contains("p_max")
            && page.contains("Relative life")
    );
    refused(&asperity(root, &["report", "run.rrd"]), 4, &["run.html"]);
}

#[test]
fn both_flanks_live_by_miner_s_sum() {
    let root = tempfile::tempdir().unwrap();
    let root = root.path();
    swept(root, "two", &format!("{TOOTH}{TWO}"));
    let (table, flank) = (
        rows(&root.join("two/table.csv")),
        rows(&root.join("two/flank.csv")),
    );
    // A to E and B, C, D beside: five places for each load.
    assert_eq!((table.len(), flank.len()), (10, 5));
    let turns = [0.8 * 1500.0, 0.2 * 1000.0];
    let all = turns[0] + turns[1];
    for (k, place) in flank.iter().enumerate() {
        let mut least = f64::INFINITY;
        for (body, name, cycles_a_turn) in
            [(1, "turns_pinion", 1.0), (2, "turns_wheel", 16.0 / 24.0)]
        {
            let mut damage = 0.0;
            for (load, turns) in turns.iter().enumerate() {
                let row = &table[k + 5 * load];
                let speeds = [number(row, "u_1_m_s"), number(row, "u_2_m_s")];
                let own = speeds[body - 1] / speeds[0].max(speeds[1]);
                let life =
                    number(row, &format!("life_body_{body}")) * number(row, "load_factor") * own;
                damage += turns / all * cycles_a_turn / life;
            }
            assert!(
                (number(place, name) * damage - 1.0).abs() < 1e-9,
                "{name} {k}"
            );
            least = least.min(1.0 / damage);
        }
        let smooth = number(&table[0], "life_cycles") / number(&table[0], "life_common");
        let hours = least * smooth / (60.0 * all);
        assert!(
            (number(place, "hours") / hours - 1.0).abs() < 1e-9,
            "hours {k}"
        );
        let shares = number(place, "damage_share_1") + number(place, "damage_share_2");
        assert!((shares - 1.0).abs() < 1e-9);
    }
    // One calibration point for all: cycles have the order of the lives by one reference, whatever the radii.
    for row in &table {
        let smooth = number(row, "life_cycles") / number(row, "life_common");
        let first = number(&table[0], "life_cycles") / number(&table[0], "life_common");
        assert!((smooth / first - 1.0).abs() < 1e-9);
    }
}

/// A ring turns under its balls: by hand from the table. Z = 8, D/d = 17.462/72.5, so 4.9634 balls a turn.
#[test]
fn a_ring_lives_by_miner_s_sum_round_its_zone() {
    let root = tempfile::tempdir().unwrap();
    let root = root.path();
    let race = asperity(root, &["sweep", "bearing_race", "--show", "file"]);
    let text = String::from_utf8(race.stdout).unwrap();
    let points = text.lines().filter(|line| !line.starts_with("points"));
    let text = points.collect::<Vec<_>>().join("\n");
    let set = "\n[set]\ngrid.nodes = 65\nlife.calibration_cycles = 1e8\nlife.calibration_pressure_pa = 2e9\n\
               life.iso_load_ratio = 1.0\n";
    let text = text.replacen("[race]", "[race]\npoints = 3", 1);
    std::fs::write(root.join("race.toml"), format!("{text}{set}")).unwrap();
    let done = asperity(root, &["sweep", "race.toml", "--out", "race"]);
    assert!(matches!(done.status.code(), Some(0 | 2)), "{done:?}");
    let table = rows(&root.join("race/table.csv"));
    let damage: Vec<f64> = table
        .iter()
        .map(|row| 1.0 / number(row, "life_common"))
        .collect();
    let way = number(&table[1], "path_deg") - number(&table[0], "path_deg");
    let sum = way / 360.0 * (0.5 * damage[0] + damage[1] + 0.5 * damage[2]);
    let turns = 1.0 / (4.9634 * sum);
    let hours = turns * number(&table[0], "life_cycles")
        / number(&table[0], "life_common")
        / (60.0 * 3000.0);
    let told = String::from_utf8_lossy(&done.stdout).into_owned();
    let line = told
        .lines()
        .find(|line| line.contains("inner ring"))
        .unwrap();
    let found: Vec<f64> = line
        .split([' ', ','])
        .filter_map(|word| word.parse().ok())
        .collect();
    assert!((found[0] / turns - 1.0).abs() < 1e-3, "{line}: {turns}");
    assert!((found[1] / hours - 1.0).abs() < 1e-3, "{line}: {hours}");
    assert_eq!(asperity(root, &["report", "race"]).status.code(), Some(0));
    let page = std::fs::read_to_string(root.join("race/report.html")).unwrap();
    assert!(page.contains("inner ring") && page.contains("ISO 281"));
}

#[test]
fn a_load_said_twice_is_one_load() {
    let root = tempfile::tempdir().unwrap();
    let root = root.path();
    for (name, load) in [("one", ONE), ("same", SAME)] {
        swept(root, name, &format!("{TOOTH}{load}"));
    }
    let [one, same] = ["one", "same"].map(|name| rows(&root.join(name).join("flank.csv")));
    assert_eq!(one.len(), same.len());
    for (one, same) in one.iter().zip(&same) {
        for name in ["path_m", "turns_pinion", "turns_wheel", "hours"] {
            assert!(
                (number(one, name) - number(same, name)).abs() <= 1e-9 * number(one, name),
                "{name}"
            );
        }
        assert!((number(same, "damage_share_1") - 0.3).abs() < 1e-9);
    }
}

#[test]
fn what_is_no_spectrum_and_no_report_is_refused_in_words() {
    let root = tempfile::tempdir().unwrap();
    let root = root.path();
    for (spectrum, words) in [
        ("spectrum = []\n", "1 to 100"),
        ("spectrum = [1.0]\n", "gear.spectrum.0"),
        (
            "spectrum = [{ torque_n_m = 1.0, speed_rpm = 10.0, time_share = 0.5 }]\n",
            "make 1 together",
        ),
        (
            "spectrum = [{ torque_n_m = 1.0, speed_rpm = 10.0 }]\n",
            "gear.spectrum.0.time_share",
        ),
        (
            "spectrum = [{ torque_n_m = -1.0, speed_rpm = 10.0, time_share = 1.0 }]\n",
            "gear.spectrum.0.torque_n_m",
        ),
        (
            "torque_n_m = 1.0\nspeed_rpm = 10.0\nspectrum = [{ torque_n_m = 1.0, speed_rpm = 10.0, time_share = 1.0 }]\n",
            "gear.",
        ),
    ] {
        std::fs::write(root.join("bad.toml"), format!("{TOOTH}{spectrum}")).unwrap();
        refused(
            &asperity(root, &["sweep", "bad.toml", "--show", "points"]),
            1,
            &[words],
        );
    }
    std::fs::write(root.join("few.toml"), FEW).unwrap();
    refused(
        &asperity(root, &["report", "nothing.rrd"]),
        1,
        &["nothing.rrd"],
    );
    refused(&asperity(root, &["report", "."]), 1, &["sweep.toml"]);
    let done = asperity(root, &["sweep", "few.toml", "--chain", "0", "--out", "few"]);
    assert_eq!(done.status.code(), Some(0));
    // Neither life nor oil's λ: a page of what there is.
    assert_eq!(asperity(root, &["report", "few"]).status.code(), Some(0));
}
