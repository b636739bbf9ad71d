//! Height maps as instruments and other programs write them: separators, marks, headers, tilt, outliers. Right values
//! are worked out by hand.

#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::TAU;
use std::path::Path;

use asperity_engine::plan::Plan;
use asperity_engine::scene::{Scene, Surface};

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
        let cell = |i: u32| format!("{:e}", 2e-7 * (TAU * f64::from(i) / 8.0).cos());
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
            &[
                "pixel_m is missing",
                "1e-9 to 0.01 m",
                "a file that says it",
            ],
        ),
    ] {
        has_all(&refused(&format!("{header}{row}"), keys), parts);
    }
}

/// `nx` by `ny` heights in nm, by pixels from the middle.
fn map_nm(nx: usize, ny: usize, z: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    let place = |at: usize, n: usize| at as f64 - 0.5 * (n - 1) as f64;
    (0..nx * ny)
        .map(|n| z(place(n % nx, nx), place(n / nx, ny)))
        .collect()
}

fn text(nx: usize, z: &[f64]) -> String {
    let row = |row: &[f64]| {
        let cells: Vec<String> = row.iter().map(|z| format!("{z:e}")).collect();
        cells.join(",") + "\n"
    };
    z.chunks(nx).map(row).collect()
}

/// Waves of 200 nm, eight pixels long, that close on 40 pixels.
fn waves(u: f64) -> f64 {
    200.0 * (TAU * (u + 0.5) / 8.0).cos()
}

const AT_20_UM: &str = "unit_m = 1e-9\npixel_m = 20e-6\n";

#[test]
fn what_a_map_is_is_told() {
    let map = "100,0;120,0;140,0;120,0\n".repeat(4);
    let scene = read(&map, NM).unwrap();
    let [None, Some(report)] = scene.map_reports() else {
        panic!("one map");
    };
    // By hand: mean 120 nm, left -20, 0, 20, 0: Sq = √200 nm, greatest 20/√200 = √2 of it. Slope Σ u z/Σ u² =
    // (1.5·20 + 0.5·20 - 0.5·0)... = (−1.5·−20 + 0.5·20 + 1.5·0)/5 = 8 nm in 20 µm.
    for (found, told) in [
        (report.size_x_m, 80e-6),
        (report.size_y_m, 80e-6),
        (report.unit_m, 1e-9),
        (report.min_m, -20e-9),
        (report.max_m, 20e-9),
        (report.sq_m, 200.0_f64.sqrt() * 1e-9),
        (report.max_over_sq, 2.0_f64.sqrt()),
        (report.plane_slope_x, 8e-9 / 20e-6),
        // Mean square of a plane of 8 nm a pixel over four pixels: 64·5/4 = 80 of 200.
        (report.plane_share, 0.4),
        (report.amplitude_m, 20e-9),
    ] {
        assert!((found / told - 1.0).abs() < 1e-6, "{found:e} {told:e}");
    }
    assert_eq!((report.rows, report.columns), (4, 4));
    let plan = Plan::new(&scene).unwrap().to_string();
    has_all(
        &plan,
        &[
            "map.txt: 4 rows x 4 columns, 80.00 µm along x, 80.00 µm along y; a value of 1 is 1e-9 m",
            "taken off: the mean; best plane of the file: slopes 4.00e-4 along x and 0 along y, 40.0 % of the mean square",
            "minimum -20.0 nm, maximum 20.0 nm, Sq 14.1 nm, greatest departure 1.41 Sq",
        ],
    );
    assert!(!plan.contains("scaled"), "{plan}");
    let louder = read(&map, &format!("{NM}\namplitude_m = 1e-7")).unwrap();
    let plan = Plan::new(&louder).unwrap().to_string();
    has_all(&plan, &["then scaled to an amplitude of 100 nm"]);
}

#[test]
fn amplitudes_that_cannot_be_roughness_are_cautions() {
    let cautions = |z: f64, keys: &str| {
        let map = format!("0,{z:e},0,-{z:e}\n").repeat(4);
        let scene = read(&map, keys).unwrap();
        let plan = Plan::new(&scene).unwrap();
        let text = plan.to_string();
        assert!(
            !text.contains(" 0 nm;") && !text.contains("amplitude 0 "),
            "{text}"
        );
        let said = plan.warnings.iter().map(ToString::to_string);
        said.filter(|text| text.contains("its amplitude"))
            .collect::<Vec<_>>()
    };
    // Heights of 2e-7 m that are read as µm.
    let small = cautions(2e-7, "unit_m = 1e-6\npixel_m = 20e-6");
    has_all(&small[0], &["body 2", "2.00e-4 nm", "0.1 nm", "wrong unit"]);
    assert_eq!(small.len(), 1);
    assert!(cautions(99e-12, "pixel_m = 20e-6")[0].contains("0.0990 nm"));
    assert!(cautions(101e-12, "pixel_m = 20e-6").is_empty());
    // a = (3 F R'/(2 E'))^(1/3) with R' = Rx/2 = 6.25 mm as the mean of equal radii: half-width 160 µm here.
    let a_m = read("0,1,0,-1\n0,1,0,-1\n0,1,0,-1\n0,1,0,-1\n", NM)
        .unwrap()
        .hertz()
        .a_m;
    let large = cautions(0.101 * a_m, "pixel_m = 200e-6");
    has_all(
        &large[0],
        &["tenth", "half-width", &format!("{:.0}", a_m * 1e6)],
    );
    assert!(cautions(0.099 * a_m, "pixel_m = 200e-6").is_empty());
}

#[test]
fn a_tilt_is_taken_off_told_or_refused() {
    // 0.06 µm a pixel: left in it makes more than a µm of 200 nm.
    let tilted = map_nm(40, 40, |u, _| waves(u) + 60.0 * u);
    let map = text(40, &tilted);
    let with = |keys: &str| read(&map, &format!("{AT_20_UM}{keys}"));
    let amplitude = |keys: &str| with(keys).unwrap().body_2.surface.amplitude_m() * 1e9;
    has_all(
        &with("").unwrap_err(),
        &[
            "body_2.surface.level = left out",
            "\"plane\"",
            "\"mean\"",
            "do not meet",
            "0 nm along y",
        ],
    );
    // The waves' own share of the best plane goes with it: a few nm of 200, as without the tilt.
    let level = |keys: &str| format!("{AT_20_UM}{keys}");
    let untilted = text(40, &map_nm(40, 40, |u, _| waves(u)));
    let alone = |keys: &str| {
        read(&untilted, &level(keys))
            .unwrap()
            .body_2
            .surface
            .amplitude_m()
            * 1e9
    };
    let plane = "level = \"plane\"";
    assert!((amplitude(plane) / 200.0 - 1.0).abs() < 0.1);
    assert!((amplitude(plane) / alone(plane) - 1.0).abs() < 1e-9);
    // 19.5 pixels to either side.
    let left_in = amplitude("level = \"mean\"");
    assert!((1100.0..1370.0).contains(&left_in), "{left_in}");
    let kept = with("level = \"mean\"").unwrap();
    let [None, Some(report)] = kept.map_reports() else {
        panic!("one map");
    };
    // By hand: 60 nm in 20 µm and what the waves add, under a nm a pixel.
    assert!(
        (report.plane_slope_x / 3e-3 - 1.0).abs() < 0.02,
        "{}",
        report.plane_slope_x
    );
    assert_eq!(report.plane_slope_y, 0.0);
    // ⟨(60 u)²⟩ = 3600·(1600 − 1)/12 of that and 200²/2.
    let plane = 3600.0 * 1599.0 / 12.0;
    assert!((report.plane_share - plane / (plane + 2e4)).abs() < 0.01);
    let doubts: Vec<String> = kept
        .body_2
        .surface
        .map_doubts()
        .iter()
        .flatten()
        .map(ToString::to_string)
        .collect();
    has_all(&doubts[0], &["best plane", "level = \"plane\""]);

    // A windowed map loses its plane unasked, and says so.
    let window = with("edge = \"windowed\"").unwrap();
    let Surface::HeightMap {
        level,
        map: Some(_),
        ..
    } = &window.body_2.surface
    else {
        panic!("a map");
    };
    assert_eq!(*level, None);
    let window_nm = window.body_2.surface.amplitude_m() * 1e9;
    assert!(
        (window_nm / alone("edge = \"windowed\"") - 1.0).abs() < 1e-9,
        "{window_nm}"
    );
    let plan = Plan::new(&window).unwrap().to_string();
    has_all(
        &plan,
        &[
            "taken off: the best plane and the mean of the rim",
            "slopes 0.00296 along x",
        ],
    );
    let again = Scene::from_toml(&window.to_toml());
    // The copy looks for the file, which is gone; that it names it is enough here.
    has_all(&again.unwrap_err().to_string(), &["map.txt"]);
}

#[test]
fn what_is_taken_off_is_what_was_asked_for() {
    // A bowl, a twist and a tilt under waves of 100 nm along y, too.
    let rough = |u: f64, v: f64| waves(u) + 100.0 * (TAU * (v + 0.5) / 8.0).sin();
    let form = |u: f64, v: f64| 9.0 * u - 4.0 * v + 0.3 * u * v + 0.9 * u * u - 0.5 * v * v + 800.0;
    let z = map_nm(40, 32, |u, v| rough(u, v) + form(u, v));
    let range_nm = |z: &[f64], keys: &str| {
        let scene = read(
            &text(40, z),
            &format!("{AT_20_UM}amplitude_m = 1e-7\n{keys}"),
        )
        .unwrap();
        let [None, Some(report)] = scene.map_reports() else {
            panic!("one map");
        };
        [report.min_m * 1e9, report.max_m * 1e9]
    };
    let peak = |keys: &str| range_nm(&z, keys);
    let greatest = z.iter().copied().fold(f64::MIN, f64::max);
    let mean = z.iter().sum::<f64>() / z.len() as f64;
    let lowest = z.iter().copied().fold(f64::MAX, f64::min);
    for (keys, off) in [("level = \"none\"", 0.0), ("level = \"mean\"", mean)] {
        let [low, high] = peak(keys);
        assert!((low - (lowest - off)).abs() < 1e-6 && (high - (greatest - off)).abs() < 1e-6);
    }
    // The best polynomial of a sum is the sum of both: of the form nothing is left.
    let quadratic = "level = \"quadratic\"";
    let [both, alone] = [peak(quadratic), range_nm(&map_nm(40, 32, rough), quadratic)];
    for (one, other) in both.into_iter().zip(alone) {
        assert!((one - other).abs() < 1e-6, "{both:?} {alone:?}");
        assert!((250.0..350.0).contains(&one.abs()));
    }
    let [low, high] = peak("level = \"plane\"");
    assert!(high - low > 700.0, "the bowl stays: {low} {high}");
    has_all(
        &refused(&text(40, &z), &format!("{AT_20_UM}level = \"cubic\"")),
        &[
            "body_2.surface.level = \"cubic\"",
            "\"none\" or \"mean\" or \"plane\" or \"quadratic\"",
        ],
    );
}

#[test]
fn waves_that_close_keep_their_own_plane() {
    // One wave in the map: its best plane makes three fifths of it, and nothing is wrong.
    let z = map_nm(40, 8, |u, _| 200.0 * (TAU * u / 40.0).sin());
    let scene = read(&text(40, &z), AT_20_UM).unwrap();
    let [None, Some(report)] = scene.map_reports() else {
        panic!("one map");
    };
    assert!(
        (report.plane_share - 0.608).abs() < 0.01,
        "6/π² = {}",
        report.plane_share
    );
    assert!((report.max_m / 2e-7 - 1.0).abs() < 0.01);
    assert_eq!(scene.body_2.surface.map_doubts(), [None, None]);
}

#[test]
fn outliers_are_told_and_taken_off_where_the_scene_asks() {
    let sound = map_nm(40, 40, |u, v| {
        waves(u) + 50.0 * (TAU * (v + 0.5) / 10.0).cos()
    });
    let mut spiked = sound.clone();
    spiked[20 * 40 + 17] = 6000.0;
    let keep = read(&text(40, &spiked), AT_20_UM).unwrap();
    assert!((keep.body_2.surface.amplitude_m() * 1e9 - 6000.0).abs() < 10.0);
    let doubts = keep.body_2.surface.map_doubts();
    has_all(
        &doubts[1].unwrap().to_string(),
        &["1 outlying pixel", "outliers = \"median\""],
    );
    let outliers = format!("{AT_20_UM}outliers = \"median\"\n");
    let taken = read(&text(40, &spiked), &outliers).unwrap();
    let amplitude_nm = taken.body_2.surface.amplitude_m() * 1e9;
    assert!((amplitude_nm - 250.0).abs() < 15.0, "{amplitude_nm}");
    assert_eq!(taken.body_2.surface.map_doubts(), [None, None]);
    let plan = Plan::new(&taken).unwrap().to_string();
    has_all(
        &plan,
        &["1 outlying pixel replaced by the median of the 5 by 5"],
    );
    // Sound, it is the same with either word, to the last bit.
    let one = read(&text(40, &sound), AT_20_UM).unwrap();
    let two = read(&text(40, &sound), &outliers).unwrap();
    assert_eq!(
        one.body_2.surface.amplitude_m(),
        two.body_2.surface.amplitude_m()
    );
    // A hole, a pair, and a pixel on the edge.
    for places in [&[845][..], &[845, 846], &[39], &[0, 1599]] {
        let mut z = sound.clone();
        for &at in places {
            z[at] -= 3000.0;
        }
        let scene = read(&text(40, &z), AT_20_UM).unwrap();
        let [None, Some(report)] = scene.map_reports() else {
            panic!("one map");
        };
        assert_eq!(report.outliers, places.len());
    }
}

#[test]
fn the_refusal_of_short_waves_names_what_makes_them_short() {
    // 40 pixels of 4 µm: waves of 160 µm... that the mesh carries; a spike or a step at the seam that it does not.
    let keys = |more: &str| format!("unit_m = 1e-9\npixel_m = 4e-6\n{more}\n");
    let refusal = |z: &[f64], more: &str| match read(&text(80, z), &keys(more)) {
        Ok(scene) => {
            Plan::new(&scene).map_or_else(|error| error.to_string(), |_| "accepted".to_owned())
        }
        Err(error) => error,
    };
    let smooth = map_nm(80, 80, |u, _| 200.0 * (TAU * (u + 0.5) / 40.0).cos());
    assert_eq!(refusal(&smooth, ""), "accepted");
    let mut spiked = smooth.clone();
    spiked[40 * 80 + 33] = 6000.0;
    has_all(
        &refusal(&spiked, ""),
        &[
            "shortest significant wave",
            "1 outlying pixel",
            "surface.outliers = \"median\"",
        ],
    );
    assert_eq!(refusal(&spiked, "outliers = \"median\""), "accepted");
    let tilted = |nm: f64| {
        map_nm(80, 80, |u, _| {
            200.0 * (TAU * (u + 0.5) / 40.0).cos() + nm * u
        })
    };
    // 80 pixels of 20 nm, and what the waves' own plane adds.
    has_all(
        &refusal(&tilted(20.0), "level = \"mean\""),
        &[
            "shortest significant wave",
            "tilt",
            "surface.level = \"plane\"",
            "1.62 µm along x",
        ],
    );
    assert_eq!(refusal(&tilted(20.0), "level = \"plane\""), "accepted");
    has_all(
        &refusal(&tilted(60.0), "level = \"mean\""),
        &["slope 2 pi Rq/W", "the tilt", "surface.level = \"plane\""],
    );
    // Short waves: what the median leaves of the pixel is no wave along the ridges.
    let mut short = map_nm(80, 80, |u, _| 200.0 * (TAU * (u + 0.5) / 20.0).cos());
    short[40 * 80 + 39] = 6000.0;
    has_all(
        &refusal(&short, ""),
        &["1 outlying pixel", "surface.outliers = \"median\""],
    );
    assert_eq!(refusal(&short, "outliers = \"median\""), "accepted");
    let rough = map_nm(80, 80, |u, _| 100.0 * (TAU * (u + 0.5) / 4.0).cos());
    let text = refusal(&rough, "");
    has_all(&text, &["shortest significant wave", "smooth the map"]);
    assert!(
        !text.contains("tilt") && !text.contains("outlying"),
        "{text}"
    );
}
