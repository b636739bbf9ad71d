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
