//! Height maps as instruments and other programs write them: separators, marks, headers, tilt, outliers. Right values
//! are worked out by hand.

#![allow(clippy::unwrap_used, reason = "tests")]

use std::path::Path;

use asperity_engine::scene::Scene;

/// The demonstration with one rough body, whose surface is `surface`.
fn scene_text(surface: &str) -> String {
    format!(
        "[contact]\nkind = \"point\"\nrx_m = 0.0125\nry_m = 0.0125\n\n[body_2.surface]\n{surface}\n\
         [motion]\nentrainment_m_s = 1.0\n\n[load]\nforce_n = 50.0\n\n\
         [lubricant]\nviscosity_pa_s = 0.1\npressure_viscosity_per_pa = 2e-8\n\n[grid]\nnodes = 129\n"
    )
}

/// Writes the map and reads a scene with it.
fn load(folder: &Path, name: &str, map: &[u8], keys: &str) -> Result<Scene, String> {
    std::fs::write(folder.join(name), map).unwrap();
    let surface = format!("kind = \"height_map\"\nfile = \"{name}\"\n{keys}\n");
    let path = folder.join("scene.toml");
    std::fs::write(&path, scene_text(&surface)).unwrap();
    Scene::load(path.to_str().unwrap()).map_err(|error| error.to_string())
}

/// The text of a map is read with these keys.
fn read(map: &str, keys: &str) -> Result<Scene, String> {
    let folder = tempfile::tempdir().unwrap();
    load(folder.path(), "map.txt", map.as_bytes(), keys)
}

fn refused(map: &str, keys: &str) -> String {
    read(map, keys).map_or_else(|error| error, |_| "accepted".to_owned())
}

fn has_all(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "{part}: {text}");
    }
}

const NM: &str = "unit_m = 1e-9\npixel_m = 20e-6";

#[test]
fn a_comma_between_semicolons_is_a_decimal_mark() {
    // 20 nm about a mean of 120 nm, and not the 80 nm that eight columns of 100, 0, 120, 0, ... make.
    for row in [
        "100,0;120,0;140,0;120,0",
        "100,0\t120,0\t140,0\t120,0",
        "100,0 120,0 140,0 120,0",
        "100;120;140,0;120",
        "1,0e2; 1,2e2; 1,4e2; 1,2e2",
        "100,120,140,120",
    ] {
        let scene = read(&format!("{row}\n").repeat(4), NM).unwrap();
        let surface = &scene.body_2.surface;
        assert!((surface.amplitude_m() / 20e-9 - 1.0).abs() < 1e-9, "{row}");
        // One wave of four pixels of 20 µm.
        assert!((surface.crests_per_m() * 80e-6 - 1.0).abs() < 1e-9, "{row}");
    }
}

#[test]
fn what_can_be_read_in_two_ways_is_refused_with_both() {
    for (row, parts) in [
        (
            "100,000;120,000;140,000;120,000",
            &["body_2.surface.file", "map.txt", "100.000,", "100000,"][..],
        ),
        ("1,100\t1,120\t1,140\t1,120", &["1.100,", "1100,", "tabs"]),
        ("980;1.020;1.040;1.020", &["1.020,", "1020,", "its point"]),
    ] {
        let text = refused(&format!("{row}\n").repeat(4), NM);
        has_all(&text, parts);
        has_all(&text, &["fits two readings", "allowed: numbers that"]);
    }
    for row in [
        "1.100,5;1.120,5;1.140,5;1.120,5",
        "1'100;1'120;1'140;1'120",
        "1 100;1 120;1 140;1 120",
        "1,100,000;1,120,000;1,140,000;1,120,000",
    ] {
        let text = refused(&format!("{row}\n").repeat(4), NM);
        has_all(&text, &["line 1, column 1", "thousands marks", "1234.5"]);
    }
}

/// A list of `n` by `n` points, x fast, with so many columns.
fn list(n: usize, columns: usize) -> String {
    let rows = (0..n * n).map(|k| {
        let cells = [k % n, k / n, k * 7 % 11, 255];
        let cells: Vec<String> = cells[..columns].iter().map(usize::to_string).collect();
        cells.join(",") + "\n"
    });
    rows.collect()
}

#[test]
fn lists_of_points_are_no_maps() {
    for (n, columns, parts) in [
        (
            32,
            3,
            &[
                "x y z",
                "first two of its 3 columns",
                "not a list of points",
            ][..],
        ),
        (
            32,
            4,
            &[
                "x y z",
                "first two of its 4 columns",
                "raster",
                "heights alone",
            ],
        ),
        (5, 4, &["x y z", "first two of its 4 columns", "raster"]),
        (300, 4, &["x y z", "first two of its 4 columns", "raster"]),
        (300, 3, &["x y z", "first two of its 3 columns"]),
    ] {
        has_all(&refused(&list(n, columns), NM), parts);
    }
    let scattered = "0.1;0.7;3\n0.9;0.2;4\n0.5;0.4;1\n0.3;0.8;2\n";
    has_all(
        &refused(scattered, NM),
        &["4 rows of 3", "x y z", "not a list of points"],
    );
}

#[test]
fn lines_beyond_the_longest_are_refused_and_not_cut() {
    let row = vec!["1"; 9000].join(" ");
    let text = refused(&format!("{row}\n{}\n", row.replace('1', "2")).repeat(2), NM);
    has_all(&text, &["more than 8192 numbers in line 1", "4 to 8192"]);
}

/// Four waves of 0.2 µm, 32 by 32, in m.
fn gwyddion(header: &str) -> String {
    let row = |_| {
        let cell = |i: u32| {
            format!(
                "{:e}",
                2e-7 * (std::f64::consts::TAU * f64::from(i) / 8.0).cos()
            )
        };
        (0..32).map(cell).collect::<Vec<_>>().join("\t") + "\n"
    };
    format!("{header}{}", (0..32).map(row).collect::<String>())
}

const HEADER: &str = "# Channel: Topography\n# Width: 400 µm\n# Height: 400 µm\n# Value units: m\n";

#[test]
fn what_a_header_says_is_used() {
    // Eight pixels of 12.5 µm a wave.
    for (header, keys) in [
        (HEADER, ""),
        (HEADER, "unit_m = 1.0\npixel_m = 12.5e-6"),
        (HEADER, "pixel_m = 12.51e-6"),
        ("# Value units: m\n", "pixel_m = 12.5e-6"),
        ("# Width: 0.4 mm\n", ""),
        ("# Height: 400.0 um\n", "unit_m = 1.0"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let scene = load(folder.path(), "map.txt", gwyddion(header).as_bytes(), keys).unwrap();
        let surface = &scene.body_2.surface;
        assert!(
            (surface.amplitude_m() / 2e-7 - 1.0).abs() < 1e-9,
            "{header}"
        );
        assert!(
            (surface.crests_per_m() * 1e-4 - 1.0).abs() < 1e-3,
            "{header}"
        );
        // A copy keeps unit and pixel: a header that is changed afterwards is refused.
        let copy = scene.to_toml();
        assert_eq!(Scene::from_toml(&copy).unwrap(), scene);
        let other = gwyddion("# Value units: nm\n# Width: 200 µm\n");
        std::fs::write(folder.path().join("map.txt"), other).unwrap();
        let text = Scene::from_toml(&copy).unwrap_err().to_string();
        has_all(&text, &["body_2.surface.unit_m = 1 m", "1e-9 m"]);
    }
    // In nm with a decimal comma, as in a German Windows.
    let row = "100,0\t120,0\t140,0\t120,0\n";
    let header = "# Width: 0,080 mm\n# Value units: nm\n";
    let scene = read(&format!("{header}{}", row.repeat(4)), "").unwrap();
    let surface = &scene.body_2.surface;
    assert!((surface.amplitude_m() / 20e-9 - 1.0).abs() < 1e-9);
    assert!((surface.crests_per_m() * 80e-6 - 1.0).abs() < 1e-9);
}

#[test]
fn a_key_that_says_otherwise_than_the_header_is_refused_with_both() {
    let row = "1e-7\t2e-7\t1e-7\t0\n".repeat(4);
    for (header, keys, parts) in [
        (
            HEADER,
            "unit_m = 1e-6",
            &[
                "body_2.surface.unit_m = 1e-6 m",
                "allowed: 1 m",
                "Value units: m",
                "line 4",
            ][..],
        ),
        (
            HEADER,
            "pixel_m = 1e-6",
            &[
                "body_2.surface.pixel_m = 1e-6 m",
                "allowed: 1e-4 m",
                "width: 400 µm",
                "line 2",
            ],
        ),
        (
            "# Value units: nm\n",
            "pixel_m = 1e-6\nunit_m = 1e-6",
            &["unit_m = 1e-6 m", "allowed: 1e-9 m", "Value units: nm"],
        ),
        (
            "# Height: 200 µm\n",
            "pixel_m = 1e-6",
            &["pixel_m = 1e-6 m", "allowed: 5e-5 m", "height: 200 µm"],
        ),
        (
            "# Width: 400 µm\n# Height: 200 µm\n",
            "",
            &["surface.file", "1e-4 m by 5e-5 m", "as wide as high"],
        ),
        (
            "# Value units: V\n",
            "pixel_m = 1e-6",
            &["Value units: V", "a unit of length", "µm"],
        ),
        (
            "# Width: 400 px\n",
            "",
            &["width: 400 px", "line 1", "such as 100.5 µm"],
        ),
        (
            "# Width: 4e9 m\n",
            "",
            &["pixels of 1e9 m", "1e-9 to 0.01 m"],
        ),
        (
            "# Value units: m\n",
            "",
            &["pixel_m is missing", "1e-9 to 0.01 m", "header"],
        ),
    ] {
        has_all(&refused(&format!("{header}{row}"), keys), parts);
    }
}
