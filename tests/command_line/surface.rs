//! `asperity surface`: a file whose parameters are known in closed form.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::{PI, TAU};
use std::process::{Command, Output};

fn asked(folder: &std::path::Path, args: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    command.current_dir(folder).arg("surface").args(args);
    command.output().unwrap()
}

/// The number behind a parameter's name.
fn number(text: &str, name: &str) -> f64 {
    let begin = format!("{name:<6} ");
    let line = text.lines().find(|line| line.starts_with(&begin));
    let value = line.and_then(|line| line.split_whitespace().nth(1));
    value
        .and_then(|value| value.parse().ok())
        .unwrap_or(f64::NAN)
}

/// Ridges of A = 200 nm and W = 16 pixels, and the same on a tilted plane: Sq = A/√2, Sa = 2A/π (64 points a row: of 16 points a
/// wave, their mean |cos|), Sku = 3/2, RSm = W, across the ridges along x. The scene that is written runs by its plan.
#[test]
fn ridges_have_their_parameters() {
    let folder = tempfile::tempdir().unwrap();
    let n = 64;
    for (name, tilt) in [("flat.csv", 0.0), ("tilted.csv", 5.0)] {
        let row = |_: usize| {
            let cells = (0..n)
                .map(|i| 200.0 * (TAU * (f64::from(i) + 0.5) / 16.0).sin() + tilt * f64::from(i));
            cells
                .map(|z| format!("{z:.9}"))
                .collect::<Vec<_>>()
                .join(",")
        };
        let text = (0..n as usize).map(row).collect::<Vec<_>>().join("\n");
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let units = ["--pixel-m", "1e-5", "--unit-m", "1e-9"];
    let output = asked(
        folder.path(),
        &[
            &["flat.csv", "--level", "mean", "--scene", "it.toml"],
            &units[..],
        ]
        .concat(),
    );
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(
        output.status.success(),
        "{text}{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let mean = (0..16)
        .map(|i| (TAU * (f64::from(i) + 0.5) / 16.0).sin().abs())
        .sum::<f64>()
        / 16.0;
    assert!((mean / (2.0 / PI) - 1.0).abs() < 0.01);
    let slope = 0.2e-6 / 2_f64.sqrt() * (TAU / 16.0).sin() / 1e-5;
    for (name, expected, room) in [
        ("Sq", 0.2 / 2_f64.sqrt(), 1e-4),
        ("Sa", 0.2 * mean, 1e-4),
        ("Sku", 1.5, 1e-4),
        ("RSm", 160.0, 1e-3),
        ("Sdq", slope, 0.01),
        ("Rq/Sq", 1.0, 1e-4),
    ] {
        let found = number(&text, name);
        assert!(
            (found / expected - 1.0).abs() < room,
            "{name} {found}, not {expected}"
        );
    }
    assert!(
        number(&text, "lay").abs() < 0.5 && number(&text, "Ssk").abs() < 1e-3,
        "{text}"
    );
    // The plane is taken off unless it is told otherwise; ridges have a small plane of their own, which goes, too.
    let output = asked(folder.path(), &[&["tilted.csv"], &units[..]].concat());
    let tilted = number(&String::from_utf8(output.stdout).unwrap(), "Sq");
    assert!((tilted / 0.1414 - 1.0).abs() < 0.06, "{tilted}");
    let check = Command::new(env!("CARGO_BIN_EXE_asperity"))
        .current_dir(folder.path())
        .args(["check", "it.toml"])
        .output()
        .unwrap();
    assert!(
        check.status.success(),
        "{}",
        String::from_utf8_lossy(&check.stderr)
    );
    // What is there is not written over, and what is no file is named.
    let again = asked(
        folder.path(),
        &[&["flat.csv", "--scene", "it.toml"], &units[..]].concat(),
    );
    assert_eq!(again.status.code(), Some(4));
    let none = asked(folder.path(), &["none.x3p"]);
    assert!(!none.status.success() && String::from_utf8_lossy(&none.stderr).contains("none.x3p"));
}

/// A made surface is what it was asked to be by the same parameters.
#[test]
fn made_surfaces_have_what_they_were_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let output = asked(folder.path(), &["random_rollers"]);
    let text = String::from_utf8(output.stdout).unwrap();
    // Correlation length 40 µm: 0.2 at 40 µm √ln 5, up to what chance does to the shortest of all directions.
    assert!((number(&text, "Sq") / 0.2 - 1.0).abs() < 1e-4, "{text}");
    assert!(
        (number(&text, "Sal") / (40.0 * 5_f64.ln().sqrt()) - 1.0).abs() < 0.12,
        "{text}"
    );
    assert!(number(&text, "Str") > 0.8, "{text}");
    assert_eq!(text.matches("Body ").count(), 2);
}

/// A scene with made surfaces: as many crests as their spectrum says, and from S = 0.5 on the highest that a point meets is that
/// of extreme values within 15 % (what one surface leaves to chance), and higher the farther it slides.
#[test]
fn who_slides_farther_meets_a_higher_crest() {
    let folder = tempfile::tempdir().unwrap();
    let output = asked(folder.path(), &["random_rollers"]);
    let text = String::from_utf8(output.stdout).unwrap();
    println!("{text}");
    let numbers = |line: &str| -> Vec<f64> {
        let words = line.split(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-'));
        words.filter_map(|word| word.parse().ok()).collect()
    };
    let counts: Vec<&str> = text
        .lines()
        .filter(|l| l.starts_with("Crests of body"))
        .collect();
    assert_eq!(counts.len(), 2);
    for line in counts {
        let found = numbers(line);
        assert!((found[1] / found[2] - 1.0).abs() < 0.03, "{line}");
        assert!((found[4] / found[5] - 1.0).abs() < 0.05, "{line}");
    }
    for body in [1, 2] {
        let begin = format!("The highest that a point of body {body} meets");
        let table = text.split(&begin).nth(1).unwrap();
        let rows = table
            .lines()
            .skip(2)
            .take(6)
            .map(|row| numbers(&row.replace('*', " ")));
        let rows: Vec<Vec<f64>> = rows.collect();
        let sliding: Vec<f64> = rows.iter().map(|row| row[0]).collect();
        assert_eq!(sliding, [0.0, 0.1, 0.25, 0.5, 1.0, 1.5]);
        for pair in rows.windows(2) {
            assert!(pair[1][2] > pair[0][2], "{table}");
        }
        for row in &rows[3..] {
            assert!((row[2] / row[5] - 1.0).abs() < 0.15, "{row:?}");
        }
    }
}

/// A table of heights in µm, pixels of 1 µm, `z` of column and row.
fn file(folder: &std::path::Path, name: &str, [nx, ny]: [usize; 2], z: impl Fn(f64, f64) -> f64) {
    let row = |j: usize| {
        let cells = (0..nx).map(|i| format!("{:.9}", z(i as f64, j as f64)));
        cells.collect::<Vec<_>>().join(",")
    };
    let text = (0..ny).map(row).collect::<Vec<_>>().join("\n");
    std::fs::write(folder.join(name), text).unwrap();
}

/// Waves of 400, 40 and 4 µm through an S-filter of 10 and an L-filter of 150 µm: each passes by 2^(−(λ/w)²), so Sq is known; the
/// scene that is written has the same surface.
#[test]
fn filters_pass_what_their_standard_says() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let waves = [(2.0, 400.0), (0.5, 40.0), (0.1, 4.0)];
    file(folder, "three.csv", [400, 80], |x, _| {
        waves.iter().map(|(a, w)| a * (TAU * x / w).cos()).sum()
    });
    let units = [
        "three.csv",
        "--pixel-m",
        "1e-6",
        "--unit-m",
        "1e-6",
        "--level",
        "mean",
    ];
    let filters = ["--s-filter-m", "1e-5", "--l-filter-m", "1.5e-4"];
    let line = [&units[..], &filters, &["--scene", "three.toml"]].concat();
    let text = String::from_utf8(asked(folder, &line).stdout).unwrap();
    assert!(
        text.contains("S-filter 10.0 µm") && text.contains("L-filter 150 µm"),
        "{text}"
    );
    let low = |cut_off: f64, w: f64| 2_f64.powf(-(cut_off / w).powi(2));
    let passed = |s: f64, l: f64| {
        let squares = waves
            .iter()
            .map(|(a, w)| (a * low(s, *w) * (1.0 - low(l, *w))).powi(2));
        (0.5 * squares.sum::<f64>()).sqrt()
    };
    let sq = passed(10.0, 150.0);
    assert!(
        (number(&text, "Sq") / sq - 1.0).abs() < 1e-4,
        "{sq}\n{text}"
    );
    let again = String::from_utf8(asked(folder, &["three.toml"]).stdout).unwrap();
    assert_eq!(number(&again, "Sq"), number(&text, "Sq"));
    // One alone, and none.
    for (line, s, l) in [
        (&filters[..2], 10.0, 1e9),
        (&filters[2..], 0.0, 150.0),
        (&[][..], 0.0, 1e9),
    ] {
        let text = String::from_utf8(asked(folder, &[&units[..], line].concat()).stdout).unwrap();
        assert!(
            (number(&text, "Sq") / passed(s, l) - 1.0).abs() < 1e-4,
            "{text}"
        );
    }
}

/// Ridges across a direction of 30 degrees are found, and turned to stand across x; the rim that is cut is gone.
#[test]
fn a_lay_is_turned_to_the_rolling_direction() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let (sin, cos) = 30_f64.to_radians().sin_cos();
    file(folder, "lay.csv", [240, 200], |x, y| {
        0.2 * (TAU * (x * cos + y * sin) / 20.0).cos()
    });
    let units = ["lay.csv", "--pixel-m", "1e-6", "--unit-m", "1e-6"];
    let told = |line: &[&str]| {
        String::from_utf8(asked(folder, &[&units[..], line].concat()).stdout).unwrap()
    };
    let as_it_lies = told(&[]);
    assert!(
        (number(&as_it_lies, "lay") - 30.0).abs() < 0.6,
        "{as_it_lies}"
    );
    let turned = told(&["--turn-deg", "lay", "--crop-m", "1e-5"]);
    assert!(number(&turned, "lay").abs() < 0.6, "{turned}");
    assert!(
        (number(&turned, "Rq") / number(&turned, "Sq") - 1.0).abs() < 0.02,
        "{turned}"
    );
    assert!(turned.contains("10.0 µm cut off on every side"), "{turned}");
    let by_hand = told(&["--turn-deg", "-30"]);
    assert!(number(&by_hand, "lay").abs() < 0.6, "{by_hand}");
}

#[test]
fn what_no_map_can_be_made_of_is_refused_by_its_key() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    file(folder, "small.csv", [8, 8], |x, y| 0.1 * (x - y).sin());
    for (line, words) in [
        (&["--crop-m", "3e-6"][..], "crop_m"),
        (&["--s-filter-m", "1e-6"], "s_filter_m"),
        (
            &["--s-filter-m", "4e-6", "--l-filter-m", "3e-6"],
            "more than 4e-6 m: s_filter_m",
        ),
        (&["--turn-deg", "45", "--crop-m", "2e-6"], "turn_deg"),
        (&["--turn-deg", "400"], "-360 to 360"),
    ] {
        let units = ["small.csv", "--pixel-m", "1e-6", "--unit-m", "1e-6"];
        let output = asked(folder, &[&units[..], line].concat());
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(
            output.status.code() == Some(1) || output.status.code() == Some(2),
            "{line:?} {text}"
        );
        assert!(text.contains(words), "{line:?} {text}");
    }
}
