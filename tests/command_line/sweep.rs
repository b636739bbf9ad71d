//! Sweeps: the table does not depend on processes, threads and kills; what it shows has the right trends; hostile
//! files are refused by name.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::io::{BufRead as _, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};

use asperity_engine::plan::Plan;
use asperity_session::sweep::{
    CaseEnd, CaseStart, ColdComparison, Existing, Folder, Progress, Rows, Sweep, Work,
    against_cold, points, points_csv, presets, run,
};

/// A coarse scene that still has everything; 8 cases in 4 chains of 2.
pub(crate) const TINY: &str = "
title = \"tiny\"
scene = \"demonstration\"
[set]
grid.nodes = 33
body_1.surface.wavelength_x_m = 4e-4
body_2.surface.wavelength_x_m = 4e-4
body_2.surface.wavelength_y_m = 4e-4
stress.depths = 8
[vary]
motion.slide_roll = { from = 0.0, to = 0.6, n = 4 }
body_2.surface.amplitude_m = [1e-7, 2e-7]
[chain]
longest = 2
passages = 0.5
";

pub(crate) fn sweep(text: &str) -> Sweep {
    Sweep::parse(text, "test", Path::new("")).unwrap()
}

/// These chains of a sweep, or all.
pub(crate) fn planned(sweep: &Sweep, chains: Option<&str>) -> Work {
    let chains = chains.map(|chains| chains.parse().unwrap());
    let going_on = AtomicBool::new(false);
    let work = Work::plan(sweep, chains.as_ref(), &going_on);
    work.unwrap().unwrap()
}

/// Runs what is missing of these chains, or of all, and says how many cases that were.
pub(crate) fn fill(
    sweep: &Sweep,
    root: &Path,
    chains: Option<&str>,
    threads: usize,
) -> (Folder, usize) {
    let folder = Folder::create(root, sweep, Existing::Resume).unwrap();
    let work = planned(sweep, chains);
    let report = run(sweep, &folder, &work, threads, &Progress::default()).unwrap();
    (folder, report.computed)
}

pub(crate) fn table(sweep: &Sweep, folders: &[Folder]) -> String {
    Rows::gather(sweep, folders).unwrap().csv(sweep).unwrap()
}

fn whole(sweep: &Sweep) -> Rows {
    let folder = tempfile::tempdir().unwrap();
    let (folder, _) = fill(sweep, folder.path(), None, 2);
    Rows::gather(sweep, &[folder]).unwrap()
}

#[test]
fn the_table_is_the_same_for_any_chains_threads_and_order() {
    let sweep = sweep(TINY);
    assert_eq!(sweep.chains(), [0..2, 2..4, 4..6, 6..8]);
    let root = tempfile::tempdir().unwrap();
    let (one, computed) = fill(&sweep, &root.path().join("one"), None, 1);
    assert_eq!(computed, 8);
    let single = table(&sweep, &[one]);
    assert_eq!(single.lines().count(), 9);
    let (many, _) = fill(&sweep, &root.path().join("many"), None, 3);
    assert_eq!(table(&sweep, &[many]), single);
    // Three parts, the last first, one of them twice; merged in any order.
    let mut parts = Vec::new();
    for chains in ["2", "0,3", "1", "3-3,0"] {
        let place = root.path().join(format!("part-{}", parts.len()));
        parts.push(fill(&sweep, &place, Some(chains), 1).0);
    }
    assert_eq!(table(&sweep, &parts), single);
    parts.reverse();
    assert_eq!(table(&sweep, &parts), single);
    // A part that is missing is named.
    let error = Rows::gather(&sweep, &parts[3..]).unwrap_err().to_string();
    assert!(error.contains("6 of 8 cases are missing"), "{error}");
    assert!(error.contains("chain 0 (cases 0 to 1)"), "{error}");
}

#[test]
fn a_chain_goes_on_where_it_was_broken_off() {
    let text = TINY.replace("longest = 2", "longest = 4");
    let sweep = sweep(&text);
    let root = tempfile::tempdir().unwrap();
    let (one, _) = fill(&sweep, &root.path().join("one"), None, 2);
    let single = table(&sweep, &[one]);
    // Stopped as soon as two cases are there: in the middle of a chain. On a busy machine the rest may be made before this
    // thread sees them: then once more.
    let mut stopped = (0..20).map(|attempt| {
        let place = root.path().join(format!("broken-{attempt}"));
        let folder = Folder::create(&place, &sweep, Existing::Refuse).unwrap();
        let progress = Progress::default();
        std::thread::scope(|scope| {
            scope.spawn(|| run(&sweep, &folder, &planned(&sweep, None), 1, &progress).unwrap());
            while progress.done.load(Ordering::Relaxed) < 2 {
                std::thread::yield_now();
            }
            progress.stop.store(true, Ordering::Relaxed);
        });
        let kept = (0..8).filter(|k| folder.read_case(*k).is_some()).count();
        assert!(kept >= 2, "{kept}");
        (place, folder, kept)
    });
    let stopped = stopped.find(|(_, _, kept)| *kept < 8);
    let (place, folder, kept) = stopped.expect("a sweep that was stopped on its way");
    // What a kill in the middle of a write would leave: a temporary file, and on a bad disk half a record.
    std::fs::write(place.join("temporary-elsewhere-1-0"), "asperity case").unwrap();
    let last = place.join("cases").join(format!("{:07}.json", kept - 1));
    let half = std::fs::read(&last).unwrap();
    std::fs::write(&last, &half[..half.len() / 2]).unwrap();
    assert!(folder.read_case(kept - 1).is_none());
    let computed = fill(&sweep, &place, None, 1).1;
    assert!(computed > 8 - kept, "{computed} of {kept}");
    assert_eq!(table(&sweep, std::slice::from_ref(&folder)), single);
    // A state that was changed is no state: the chain begins again at its head, with the same result.
    let cases = place.join("cases");
    std::fs::remove_file(cases.join("0000003.json")).unwrap();
    std::fs::write(
        place.join("chains").join("0000000-0000002.state"),
        "asperity state 5 0\n{}",
    )
    .unwrap();
    assert_eq!(fill(&sweep, &place, None, 1).1, 4);
    assert_eq!(table(&sweep, std::slice::from_ref(&folder)), single);
    // Nothing is missing: nothing is computed.
    assert_eq!(fill(&sweep, &place, None, 1).1, 0);
    // Without being told to, nobody goes on in a folder with cases, nor in that of another sweep.
    let refused = Folder::create(&place, &sweep, Existing::Refuse).unwrap_err();
    assert!(
        refused.to_string().contains("--resume continues"),
        "{refused}"
    );
    let other = self::sweep(&text.replace("0.6", "0.5"));
    let refused = Folder::create(&place, &other, Existing::Resume).unwrap_err();
    assert!(refused.to_string().contains("another sweep"), "{refused}");
    assert!(Folder::open(&place, &other).is_err());
}

/// The table of the binary in a folder, if it is there.
fn written(root: &Path) -> Option<String> {
    std::fs::read_to_string(root.join("table.csv")).ok()
}

#[test]
fn kills_leave_whole_cases_and_resuming_gives_the_same_table() {
    let root = tempfile::tempdir().unwrap();
    std::fs::write(root.path().join("tiny.toml"), TINY).unwrap();
    let start = |out: &str| {
        Command::new(env!("CARGO_BIN_EXE_asperity"))
            .args([
                "sweep",
                "tiny.toml",
                "--threads=2",
                "--resume",
                "--out",
                out,
            ])
            .current_dir(root.path())
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap()
    };
    assert_eq!(start("single").wait().unwrap().code(), Some(0));
    let single = written(&root.path().join("single")).unwrap();
    let out = root.path().join("killed");
    let there = || std::fs::read_dir(out.join("cases")).map_or(0, Iterator::count);
    // Killed (SIGKILL) when so many cases are there.
    for wanted in [0, 1, 3, 4, 6] {
        let mut child = start("killed");
        while there() < wanted && child.try_wait().unwrap().is_none() {
            std::thread::yield_now();
        }
        child.kill().unwrap();
        child.wait().unwrap();
    }
    assert_eq!(start("killed").wait().unwrap().code(), Some(0));
    assert_eq!(written(&out).unwrap(), single);
    let pictures = [
        "life_against_slide_roll.svg",
        "life_map.svg",
        "stribeck.svg",
    ];
    for name in pictures {
        let text = std::fs::read_to_string(out.join(name)).unwrap();
        assert!(text.contains("<svg") && text.contains("tiny"), "{name}");
    }
}

/// A line that wears over some cycles, with a calibration point: pits and wear over both keys.
const AGED: &str = "
title = \"aged\"
scene = \"fzg_point_b\"
[set]
grid.nodes = 65
numerics.ladder = false
numerics.error_estimate = \"none\"
time.passages = 0.3
body_1.surface = \"none\"
body_2.surface = \"none\"
age.cycles = 1e4
wear.coefficient_2_per_pa = 1e-18
wear.thin_film_m = 1e-6
life.calibration_cycles = 1e8
life.calibration_pressure_pa = 1.7e9
[vary]
wear.coefficient_1_per_pa = [1e-18, 1e-17]
motion.slide_roll = [0.2, 0.4]
";

/// What surfaces that age come to has its pictures, and `--force` takes them away again.
#[test]
fn pits_and_wear_have_curves_and_maps() {
    let root = tempfile::tempdir().unwrap();
    let place = root.path();
    std::fs::write(place.join("aged.toml"), AGED).unwrap();
    let run = |more: &[&'static str]| {
        let args = [&["sweep", "aged.toml", "--out=out"], more].concat();
        asperity(place, &args)
    };
    let made = run(&[]);
    assert_eq!(made.status.code(), Some(0), "{made:?}");
    for name in [
        "pits_against_slide_roll.svg",
        "worn_against_slide_roll.svg",
        "pits_map.svg",
        "worn_map.svg",
    ] {
        let text = std::fs::read_to_string(place.join("out").join(name)).unwrap();
        assert!(text.contains("<svg") && text.contains("aged"), "{name}");
    }
    let before = names(&place.join("out"));
    assert_eq!(run(&["--force"]).status.code(), Some(0));
    assert_eq!(names(&place.join("out")), before);
    // Without ageing there are none of them.
    let fresh = AGED
        .replace("age.cycles = 1e4", "")
        .replace("wear.", "# wear.");
    let fresh = fresh.replace("# wear.coefficient_1_per_pa = [", "load.force_n_per_m = [");
    let fresh = fresh.replace("[1e-18, 1e-17]", "[2e5, 4e5]");
    std::fs::write(place.join("aged.toml"), fresh).unwrap();
    let made = run(&["--force"]);
    assert_eq!(made.status.code(), Some(0), "{made:?}");
    let left = names(&place.join("out"));
    let aged = |name: &&String| name.starts_with("pits") || name.starts_with("worn");
    assert_eq!(left.iter().find(aged), None);
}

/// Both bodies alike and rough, on 65 nodes.
const TREND: &str = "
scene = \"demonstration\"
[set]
grid.nodes = 65
body_1.surface.wavelength_x_m = 3e-4
body_2.surface.wavelength_x_m = 3e-4
body_2.surface.wavelength_y_m = inf
body_1.surface.amplitude_m = 3e-7
body_2.surface.amplitude_m = 3e-7
body_1.surface.phase_deg = 0.0
stress.depths = 16
";

/// A scene that asks for wear and heat has columns for them, the last ones; all others are those of the scene that does not.
#[test]
fn what_is_asked_for_has_its_columns() {
    let more = "stress.depths = 8\nwear.coefficient_1_per_pa = 1e-18\nheat.bulk_k = 350.0";
    let tables = [TINY.to_owned(), TINY.replace("stress.depths = 8", more)].map(|text| {
        let sweep = sweep(&text);
        let csv = whole(&sweep).csv(&sweep).unwrap();
        let cells = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
        csv.lines().map(cells).collect::<Vec<_>>()
    });
    let [plain, asked] = tables;
    let n = plain[0].len();
    let names = [
        "cycles",
        "wear_depth_1_m",
        "flash_temperature_max_k",
        "flash_temperature_mean_k",
        "contact_temperature_max_k",
        "film_temperature_max_k",
        "heat_share_1",
        "flash_temperature_blok_k",
    ];
    assert_eq!(asked[0][n..], names);
    let digest = plain[0].iter().position(|name| name == "scene").unwrap();
    let sliding = plain[0]
        .iter()
        .position(|name| name == "motion.slide_roll")
        .unwrap();
    for (plain, asked) in plain.iter().zip(&asked) {
        for (k, (one, other)) in plain.iter().zip(asked).enumerate() {
            assert!(one == other || k == digest, "{one} {other}");
        }
    }
    for row in &asked[1..] {
        let value = |k: usize| row[n + k].parse::<f64>().unwrap();
        let slides = row[sliding].parse::<f64>().unwrap() > 0.0;
        assert_eq!(value(0), 1.0);
        assert_eq!(value(1) > 0.0 && value(2) > 0.0, slides, "{row:?}");
    }
}

#[test]
fn life_falls_with_sliding_and_more_for_the_slower_body() {
    let sweep = sweep(&format!(
        "{TREND}[vary]\nmotion.slide_roll = [-1.0, -0.5, 0.0, 0.5, 1.0]\n[chain]\nlongest = 5\n"
    ));
    let rows = whole(&sweep);
    assert_eq!(rows.records[0].began, CaseStart::Cold);
    assert!(
        rows.records[1..]
            .iter()
            .all(|record| record.began == CaseStart::Warm)
    );
    assert_eq!(rows.worst(), CaseEnd::Converged);
    let column = |name: &str| rows.column(&sweep, name).unwrap();
    let life = column("life_relative");
    // In own loading cycles; the table has those of the faster body.
    let own = |name: &str, sign: f64| -> Vec<f64> {
        let speeds =
            [-1.0, -0.5, 0.0, 0.5, 1.0].map(|s: f64| (1.0 + 0.5 * sign * s, 1.0 + 0.5 * s.abs()));
        let lives = column(name).into_iter().zip(speeds);
        lives
            .map(|(life, (own, fastest))| life * own / fastest)
            .collect()
    };
    let (slower, faster) = (own("life_body_1", -1.0), own("life_body_2", 1.0));
    println!("life {life:?}\nbody 1 {slower:?}\nbody 2 {faster:?}");
    assert!(life[2] > life[3] && life[3] > life[4], "S > 0: {life:?}");
    assert!(life[2] > life[1] && life[1] > life[0], "S < 0: {life:?}");
    // S > 0: body 1 is the slower one and meets more asperities a crossing.
    let n = (column("n_body_1"), column("n_body_2"));
    for k in [3, 4] {
        assert!(n.0[k] > n.1[k] && slower[k] < faster[k], "case {k}");
        assert!(
            n.0[4 - k] < n.1[4 - k] && slower[4 - k] > faster[4 - k],
            "case {}",
            4 - k
        );
    }
    // At S = 0 no asperity overtakes another.
    assert_eq!((n.0[2], n.1[2]), (1.0, 1.0));
}

#[test]
fn life_falls_with_amplitude_and_transverse_ridges_cost_more_than_longitudinal_ones() {
    let fixed = TREND.replace("body_2.surface.amplitude_m = 3e-7\n", "");
    let rougher = sweep(&format!(
        "{fixed}[vary]\nbody_2.surface.amplitude_m = [0.5e-7, 1.5e-7, 3e-7]\n"
    ));
    let rows = whole(&rougher);
    let life = rows.column(&rougher, "life_relative").unwrap();
    println!("amplitude: {life:?}");
    assert!(life[0] > life[1] && life[1] > life[2], "{life:?}");
    let lay = sweep(
        "combine = \"list\"\n[set]\ngrid.nodes = 65\nstress.depths = 16\nbody_1.surface.kind = \"smooth\"\n\
         [vary]\nbody_2.surface.wavelength_x_m = [3e-4, inf]\nbody_2.surface.wavelength_y_m = [inf, 3e-4]\n",
    );
    let rows = whole(&lay);
    let life = rows.column(&lay, "life_relative").unwrap();
    let n = rows.column(&lay, "n_body_1").unwrap();
    println!("transverse, longitudinal: {life:?}, n {n:?}");
    assert!(
        life[0] < life[1] && n[0] > 1.0 && n[1] == 1.0,
        "{life:?} {n:?}"
    );
}

#[test]
fn a_warm_case_is_what_a_cold_one_is() {
    let few = TREND
        .replace("nodes = 65", "nodes = 33")
        .replace("_x_m = 3e-4", "_x_m = 4e-4")
        .replace("depths = 16", "depths = 8");
    let text = format!(
        "{few}time.passages = 6.0\n[vary]\nmotion.slide_roll = [0.4, 0.5, 0.25, 0.0]\n[chain]\nlongest = 4\npassages = 6.0\n"
    );
    let sweep = sweep(&text);
    let rows = whole(&sweep);
    let against: ColdComparison = against_cold(&sweep, &rows, 2, &Progress::default())
        .unwrap()
        .unwrap();
    println!("life and film, warm over cold: {:?}", against.ratios);
    // They differ by what is left of the neighbour after 2 a, which the film shows, and at S = 0 by nothing
    // less than how the crests stand to each other, if they were not led back to their places. Life is a mean
    // over some 16 phases of stress to the power of 11.5; other phases of the same orbit move it by a per cent.
    // The film at one place, under crests, is an average over a window that both end elsewhere: after two passages a per cent
    // apart even where both begin cold, after six a third of one.
    for ratio in &against.ratios {
        assert!(
            (ratio[0] - 1.0).abs() < 0.015 && (ratio[1] - 1.0).abs() < 0.005,
            "{ratio:?}"
        );
    }
}

#[test]
fn hostile_files_are_refused_by_key_value_and_range() {
    let huge = format!("[vary]\nload.force_n = [{}]", "1.0,".repeat(1_000_001));
    for (text, words) in [
        ("", &["[vary] is missing"][..]),
        ("[vary]", &["vary is missing", "at least one key"]),
        (
            "[vary]\nmotion.slide_rol = [1.0]",
            &["did you mean motion.slide_roll?"],
        ),
        (
            "[vary]\nstress = [1.0]",
            &["vary.stress", "one of its keys"],
        ),
        (
            "bogus = 1\n[vary]\nmotion.slide_roll = [1.0]",
            &["bogus", "only the keys title"],
        ),
        (
            "scene = 3\n[vary]\nmotion.slide_roll = [1.0]",
            &["scene = 3", "a preset"],
        ),
        (
            "scene = \"nowhere.toml\"\n[vary]\nmotion.slide_roll = [1.0]",
            &["cannot read", "nowhere.toml"],
        ),
        (
            "combine = \"sum\"\n[vary]\nmotion.slide_roll = [1.0]",
            &["combine = \"sum\"", "\"grid\" or \"list\""],
        ),
        (
            "combine = \"list\"\n[vary]\nmotion.slide_roll = [1.0]\nload.force_n = [1.0, 2.0]",
            &["lists of one length", "load.force_n: 2"],
        ),
        (
            "[vary]\nmotion.slide_roll = { from = 0, to = 1, n = 5000 }\nload.force_n = { from = 1, to = 2, n = 5000 }",
            &["25000000 cases", "at most 1000000"],
        ),
        (
            "[set]\nmotion.slide_roll = 1.0\n[vary]\nmotion.slide_roll = [1.0]",
            &["set.motion.slide_roll"],
        ),
        (
            "[set]\nnothing = 1.0\n[vary]\nmotion.slide_roll = [1.0]",
            &["nothing is not a key"],
        ),
        (
            "[vary]\n\"motion.slide_roll\" = [1.0]\nmotion.slide_roll = [2.0]",
            &["vary.motion.slide_roll", "twice"],
        ),
        (
            "[chain]\nlongest = 0\n[vary]\nmotion.slide_roll = [1.0]",
            &["chain.longest = 0", "1 to 1000"],
        ),
        (
            "[chain]\npassages = nan\n[vary]\nmotion.slide_roll = [1.0]",
            &["chain.passages", "0.25 to 10000"],
        ),
        (
            "[gear]\nteeth = [16, 24]\n[vary]\nmotion.slide_roll = [1.0]",
            &["exactly one of"],
        ),
        (
            "[gear]\nteeth = [16, 24]",
            &["contact.kind", "\"line\" on a [gear]"],
        ),
        (
            "scene = \"fzg_pitch_point\"\n[gear]\nteeth = [16, 2.5]",
            &["gear.teeth", "two"],
        ),
        (
            "scene = \"fzg_pitch_point\"\n[gear]\nteeth = [16, 24]\nmodule_m = -1",
            &["gear.module_m = -1", "0.00001 to 0.1 m"],
        ),
        (
            "scene = \"fzg_pitch_point\"\n[gear]\nteeth = [16, 24]\nmodule_m = 0.0045\nface_width_m = 0.01\n\
             torque_n_m = 10\nspeed_rpm = 10\ntip_diameters_m = [0.06, 0.1]",
            &["gear.tip_diameters_m", "teeth that mesh"],
        ),
        (
            "scene = \"cam_nose\"\n[cam]\nbase_radius_m = 0.015\nlift_m = 0.003\nhalf_angle_deg = 60.0\nspeed_rpm = 400\n\
             preload_n = 250\nstiffness_n_per_m = 3e4\nmass_kg = 0.15\nwidth_m = 0.004\nangles_deg = [0.0, 60.0]",
            &[
                "cam.angles_deg",
                "30.0 to 60.0 degrees",
                "against each other",
                "-2 to 2",
            ],
        ),
        ("[[vary]]", &["vary", "a table"]),
        ("[vary\n", &["not valid TOML"]),
        (huge.as_str(), &["1 to 1000000 values"]),
    ] {
        let error = Sweep::parse(text, "hostile", Path::new(""))
            .unwrap_err()
            .to_string();
        for word in words {
            assert!(error.contains(word), "{word:?} is missing in {error:.300}");
        }
    }
    // A value that its key refuses is found before anything runs, with the case that has it.
    let sweep = sweep("[vary]\nmotion.slide_roll = [0.0, 3.0]");
    let root = tempfile::tempdir().unwrap();
    let folder = Folder::create(root.path(), &sweep, Existing::Refuse).unwrap();
    let error = Work::plan(&sweep, None, &AtomicBool::new(false)).unwrap_err();
    let error = error.to_string();
    assert!(error.contains("case 1 (motion.slide_roll = 3)"), "{error}");
    assert!(error.contains("-2 to 2"), "{error}");
    assert!(folder.read_case(0).is_none());
}

#[test]
fn built_in_sweeps_are_whole_and_a_folder_keeps_one_that_is_the_same() {
    for preset in presets() {
        let sweep = Sweep::load(preset.name).unwrap();
        let again = Sweep::parse(sweep.to_toml(), "again", Path::new("/nowhere")).unwrap();
        assert_eq!(sweep.digest(), again.digest(), "{}", preset.name);
        let points = points_csv(&sweep).unwrap();
        assert_eq!(points.lines().count(), sweep.len() + 1);
        for case in 0..sweep.len() {
            sweep.scene(case).unwrap();
        }
    }
}

#[test]
fn points_come_one_by_one() {
    // On the second, soft body the contact would be too wide for a half-space.
    let sweep = sweep(
        "scene = \"demonstration\"\n[set]\ncontact.rx_m = 1e-3\ncontact.ry_m = 1e-3\nload.force_n = 100.0\nbody_1.surface.kind = \"smooth\"\n\
         body_2.surface.kind = \"smooth\"\n[vary]\nbody_1.young_pa = [2e11, 1e8]\n",
    );
    let ends: Vec<bool> = points(&sweep).map(|line| line.is_ok()).collect();
    assert_eq!(ends, [true, true, false]);
    assert!(points_csv(&sweep).is_err());
}

#[test]
fn a_million_points_end_with_their_reader() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("million.toml");
    let vary = "scene = \"demonstration\"\n[vary]\nmotion.slide_roll = { from = 0.0, to = 1.0, n = 1000 }\n\
                load.force_n = { from = 100.0, to = 900.0, n = 1000 }\n";
    std::fs::write(&file, vary).unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_asperity"))
        .args(["sweep", file.to_str().unwrap(), "--show", "points"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
    let head: Vec<String> = lines.by_ref().take(3).map(Result::unwrap).collect();
    assert!(
        head[0].starts_with("case,load.force_n,motion.slide_roll"),
        "{head:?}"
    );
    assert!(
        head[1].starts_with("0,100,0,") && head[2].starts_with("1,100,"),
        "{head:?}"
    );
    drop(lines);
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(String::from_utf8_lossy(&output.stderr), "1000000 cases\n");
}

/// A table of points by name.
struct Points(Vec<Vec<String>>);

impl Points {
    fn of(sweep: &Sweep) -> Self {
        let text = points_csv(sweep).unwrap();
        let cells = |line: &str| line.split(',').map(str::to_owned).collect();
        Self(text.lines().map(cells).collect())
    }

    fn column(&self, name: &str) -> Vec<f64> {
        let at = self.0[0].iter().position(|n| n == name).unwrap();
        self.0[1..]
            .iter()
            .map(|row| row[at].parse().unwrap())
            .collect()
    }
}

#[test]
fn a_ball_meets_its_greatest_load_in_the_middle_of_the_zone() {
    let sweep = Sweep::load("bearing_race").unwrap();
    let points = Points::of(&sweep);
    let (angle, load) = (points.column("path_deg"), points.column("load_n"));
    let middle = load.len() / 2;
    assert!(angle[middle].abs() < 1e-12 && angle[0] == -angle[load.len() - 1]);
    // A 6309-like bearing: 4521 N radial are 2470 N on the ball in the middle, whose pressure the preset has.
    assert!((load[middle] - 2470.0).abs() < 1.0, "{load:?}");
    let preset = asperity_engine::scene::Scene::load("ball_bearing").unwrap();
    let pressure = points.column("p_hertz_pa");
    let preset_pa = preset.hertz().p_max_pa;
    assert!(
        (pressure[middle] / preset_pa - 1.0).abs() < 2e-3,
        "{pressure:?} {preset_pa}"
    );
    for k in 0..load.len() {
        let known = load[middle] * angle[k].to_radians().cos().powf(1.5);
        assert!((load[k] / known - 1.0).abs() < 1e-12, "case {k}");
        // Hertz's point contact: the third power of pressure goes with the load.
        let cubed = (pressure[k] / pressure[middle]).powi(3);
        assert!(
            (cubed / (load[k] / load[middle]) - 1.0).abs() < 1e-9,
            "case {k}"
        );
    }
    // γ = 17.462/72.5: U = ω d_m (1 − γ²)/4 at 3000 rpm, the same all round; pure rolling.
    let u = points.column("entrainment_m_s");
    assert!(u.iter().all(|u| (u - 5.364).abs() < 1e-3), "{u:?}");
}

#[test]
fn a_cam_s_flank_has_the_curvature_and_the_speeds_of_its_lift() {
    let sweep = Sweep::load("cam_flank").unwrap();
    let points = Points::of(&sweep);
    let column = |name: &str| points.column(name);
    let (angle, lift, radius) = (column("path_deg"), column("lift_m"), column("rx_m"));
    let (u_1, u_2, s) = (column("u_1_m_s"), column("u_2_m_s"), column("slide_roll"));
    let omega = 400.0 * std::f64::consts::TAU / 60.0;
    // The follower stands on the tangent at distance r_b + s from the axis: the envelope of these has R = r_b + s + s''.
    let at = |degrees: f64| 0.5 * 0.003 * (1.0 + (std::f64::consts::PI * degrees / 60.0).cos());
    for k in 0..angle.len() {
        let step = 0.01;
        let curve = (at(angle[k] + step) - 2.0 * at(angle[k]) + at(angle[k] - step))
            / step.to_radians().powi(2);
        assert!((lift[k] - at(angle[k])).abs() < 1e-15);
        assert!(
            (radius[k] - (0.015 + lift[k] + curve)).abs() < 1e-8,
            "case {k}"
        );
        assert!((u_1[k] - omega * curve).abs() < 1e-6 && u_1[k] > 0.0);
        // Both speeds differ by ω times the distance of the contact from the axis.
        assert!((u_2[k] - u_1[k] - omega * (0.015 + lift[k])).abs() < 1e-12);
    }
    // From the end of the lift towards the nose, never beyond the place where the follower's surface stands.
    assert!(angle.windows(2).all(|pair| pair[1] < pair[0]) && angle.iter().all(|a| *a > 30.0));
    assert!(s.windows(2).all(|pair| pair[1] > pair[0]) && s.iter().all(|s| *s < 2.0));
}

#[test]
fn the_fzg_tooth_has_the_published_pressure_at_its_pitch_point() {
    let sweep = Sweep::load("fzg_c").unwrap();
    let points = points_csv(&sweep).unwrap();
    let rows: Vec<Vec<&str>> = points
        .lines()
        .map(|line| line.split(',').collect())
        .collect();
    let at = |name: &str| rows[0].iter().position(|n| *n == name).unwrap();
    let number = |row: &[&str], name: &str| row[at(name)].parse::<f64>().unwrap();
    let pitch = rows[1..]
        .iter()
        .find(|row| number(row, "slide_roll") == 0.0)
        .unwrap();
    let pressure = number(pitch, "p_hertz_pa");
    println!("pitch point {pressure:e} Pa");
    assert!((pressure - 1347e6).abs() < 1.5e6, "{pressure}");
    // ISO 14635-1: T1T2 = 34.93 mm, contact ratio 1.44 with these tips, R 8.38 mm and 2.19 m/s at the pitch point.
    let length = number(pitch, "rho_1_m") + number(pitch, "rho_2_m");
    assert!((length - 34.93e-3).abs() < 1e-5, "{length}");
    let way = number(&rows[rows.len() - 1], "path_m");
    let base_pitch = std::f64::consts::PI * 4.5e-3 * 20_f64.to_radians().cos();
    assert!((way / base_pitch - 1.44).abs() < 5e-3, "{way}");
    assert!((number(pitch, "rx_m") - 8.38e-3).abs() < 1e-5);
    assert!((number(pitch, "entrainment_m_s") - 2.19).abs() < 0.01);
    // The pinion's root is slower than the wheel's tip by the ratio of their radii of curvature and of the teeth.
    let first = &rows[1];
    let ratio = number(first, "u_1_m_s") / number(first, "u_2_m_s");
    let known = 24.0 / 16.0 * number(first, "rho_1_m") / number(first, "rho_2_m");
    assert!((ratio / known - 1.0).abs() < 1e-12, "{ratio} {known}");
    // S falls all along the line of action: dedendum above 0, tip below.
    assert!(rows[0].contains(&"load_n_per_m"));
    let s: Vec<f64> = rows[1..]
        .iter()
        .map(|row| number(row, "slide_roll"))
        .collect();
    assert!(s.windows(2).all(|pair| pair[1] < pair[0]), "{s:?}");
    assert!(s[0] > 1.0 && s[s.len() - 1] < -0.9);
    // The ride keeps speeds, sliding and Hertz pressure, and is a scene.
    let ride = sweep.ride().unwrap().unwrap();
    ride.validate().unwrap();
    assert_eq!(ride.events.len(), sweep.len());
    let last = &ride.events[sweep.len() - 1];
    let scene = sweep.scene(sweep.len() - 1).unwrap();
    let pressure = ride.hertz_at(last.set["load.force_n_per_m"]).p_max_pa;
    assert!((pressure / scene.hertz().p_max_pa - 1.0).abs() < 1e-12);
    assert_eq!(last.set["motion.slide_roll"], scene.motion.slide_roll);
    assert!(Sweep::load("slide_roll").unwrap().ride().unwrap().is_none());
}

/// The names in a folder, those of its folders too.
fn names(folder: &Path) -> Vec<String> {
    let mut names = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let entry = entry.unwrap();
        let name = entry.file_name().into_string().unwrap();
        if entry.path().is_dir() {
            let inner = self::names(&entry.path());
            names.extend(inner.iter().map(|inner| format!("{name}/{inner}")));
        }
        names.push(name);
    }
    names.sort();
    names
}

pub(crate) fn asperity(folder: &Path, args: &[&str]) -> std::process::Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    command.args(args).current_dir(folder).stdin(Stdio::null());
    command.output().unwrap()
}

/// The command fails with that code and says the words on stderr.
pub(crate) fn refused(output: &std::process::Output, code: i32, words: &[&str]) {
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{told}");
    for word in words {
        assert!(told.contains(word), "{word:?} is missing in {told}");
    }
}

/// Two cases, each of one step or so.
pub(crate) const FEW: &str = "
scene = \"demonstration\"
[set]
grid.nodes = 33
body_1.surface.kind = \"smooth\"
body_2.surface.kind = \"smooth\"
stress = \"none\"
life = \"none\"
[vary]
motion.slide_roll = [0.0, 0.5]
[chain]
longest = 2
passages = 0.25
";

#[test]
fn a_folder_that_no_sweep_has_marked_is_somebody_else_s() {
    let root = tempfile::tempdir().unwrap();
    let place = root.path();
    for name in ["few.toml", "sweep.toml"] {
        std::fs::write(place.join(name), FEW).unwrap();
    }
    let theirs = place.join("theirs");
    std::fs::create_dir_all(theirs.join("cases")).unwrap();
    std::fs::create_dir_all(theirs.join("chains")).unwrap();
    for name in [
        "table.csv",
        "base.toml",
        "sweep.toml",
        "cases/thesis.txt",
        "chains/0000000-0000001.state",
    ] {
        std::fs::write(theirs.join(name), "mine").unwrap();
    }
    let (before, here) = (names(&theirs), names(place));
    for how in [&[][..], &["--force"], &["--resume"], &["--chain=0"]] {
        for (sweep, out) in [
            ("few.toml", "theirs"),
            ("sweep.toml", "."),
            ("few.toml", "."),
        ] {
            let args = [&["sweep", sweep, "--out", out], how].concat();
            refused(&asperity(place, &args), 4, &["somebody else's", "--out"]);
        }
    }
    assert_eq!((names(&theirs), names(place)), (before, here));
    for name in ["table.csv", "base.toml", "sweep.toml", "cases/thesis.txt"] {
        assert_eq!(std::fs::read_to_string(theirs.join(name)).unwrap(), "mine");
    }
    assert_eq!(
        std::fs::read_to_string(place.join("sweep.toml")).unwrap(),
        FEW
    );
}

#[test]
fn in_a_marked_folder_a_sweep_takes_away_its_own_files_only() {
    let root = tempfile::tempdir().unwrap();
    let place = root.path();
    std::fs::write(place.join("few.toml"), FEW).unwrap();
    let args =
        |more: &[&'static str]| [&["sweep", "few.toml", "--out=out", "--threads=1"], more].concat();
    assert_eq!(asperity(place, &args(&[])).status.code(), Some(0));
    let own = names(&place.join("out"));
    assert!(own.contains(&"cases/0000001.json".to_owned()), "{own:?}");
    let strangers = [
        "cases/thesis.txt",
        "chains/notes",
        "notes.md",
        "mine.svg",
        "life_map.svg",
    ];
    for name in strangers {
        std::fs::write(place.join("out").join(name), "mine").unwrap();
    }
    // What a kill left: nobody else is there, so it goes at once.
    std::fs::write(place.join("out/temporary-elsewhere-1-0.csv"), "half").unwrap();
    refused(&asperity(place, &args(&[])), 4, &["--resume continues"]);
    assert_eq!(asperity(place, &args(&["--force"])).status.code(), Some(0));
    let mut all = own.clone();
    // A picture of a sweep's name is a sweep's; this one makes none.
    all.extend(strangers[..4].iter().map(|name| (*name).to_owned()));
    all.sort();
    assert_eq!(names(&place.join("out")), all);
    // The folder's own file is a sweep like any other, and stays as it is.
    let kept = std::fs::read(place.join("out/sweep.toml")).unwrap();
    let own = ["sweep", "out/sweep.toml", "--out=out", "--resume"];
    assert_eq!(asperity(place, &own).status.code(), Some(0));
    assert_eq!(std::fs::read(place.join("out/sweep.toml")).unwrap(), kept);
    // Edited, it is another sweep, which would be written over the words that were edited.
    let edited = String::from_utf8(kept)
        .unwrap()
        .replace("0.5]", "0.6] # mine");
    std::fs::write(place.join("out/sweep.toml"), &edited).unwrap();
    let over = ["sweep", "out/sweep.toml", "--out=out", "--force"];
    refused(&asperity(place, &over), 4, &["which it reads"]);
    assert_eq!(
        std::fs::read_to_string(place.join("out/sweep.toml")).unwrap(),
        edited
    );
}

#[test]
fn nobody_begins_in_a_folder_that_is_in_use() {
    let root = tempfile::tempdir().unwrap();
    let sweep = sweep(FEW);
    let place = root.path().join("out");
    let held = Folder::create(&place, &sweep, Existing::Refuse).unwrap();
    let refused = Folder::create(&place, &sweep, Existing::Replace).unwrap_err();
    assert!(refused.to_string().contains("working in it"), "{refused}");
    // Who goes on joins.
    let joined = Folder::create(&place, &sweep, Existing::Resume).unwrap();
    drop(held);
    assert!(Folder::create(&place, &sweep, Existing::Replace).is_err());
    drop(joined);
    assert!(Folder::create(&place, &sweep, Existing::Replace).is_ok());
}

/// Who joins cannot know whose clock is right.
#[test]
fn what_others_are_writing_stays_however_old_it_seems() {
    let root = tempfile::tempdir().unwrap();
    let sweep = sweep(FEW);
    let place = root.path().join("out");
    let held = Folder::create(&place, &sweep, Existing::Refuse).unwrap();
    let writing = place.join("temporary-elsewhere-1-0");
    let file = std::fs::File::create(&writing).unwrap();
    file.set_modified(std::time::SystemTime::UNIX_EPOCH)
        .unwrap();
    drop(Folder::create(&place, &sweep, Existing::Resume).unwrap());
    assert!(writing.exists());
    drop(held);
    drop(Folder::create(&place, &sweep, Existing::Resume).unwrap());
    assert!(!writing.exists());
}

/// Of what it will run, before it runs.
#[test]
fn a_sweep_tells_what_it_will_cost() {
    let root = tempfile::tempdir().unwrap();
    let few = FEW.replace("longest = 2", "longest = 1");
    let sweep = sweep(&few);
    std::fs::write(root.path().join("few.toml"), &few).unwrap();
    for (chains, cases) in [("0-1", vec![0, 1]), ("1", vec![1])] {
        let chosen = format!("--chain={chains}");
        let out = format!("--out=of-{chains}");
        let ended = asperity(root.path(), &["sweep", "few.toml", &chosen, &out]);
        let work = planned(&sweep, Some(chains));
        let whole = work.cost;
        assert_eq!((work.cases, work.chains()), (cases.len(), cases.len()));
        // A case is as long as the scene's own run or shorter, and started cold.
        let longest = |case| Plan::new(&sweep.scene(case).unwrap()).unwrap().cost.time_s;
        let most: f64 = cases.iter().map(|case| longest(*case)).sum();
        assert!(
            whole.time_s > 0.05 * most && whole.time_s <= most,
            "{whole:?} {most}"
        );
        let words = format!(
            "{0} cases in {0} chains, an estimated {1} on one core from cold starts",
            cases.len(),
            whole.time_text()
        );
        let said = String::from_utf8_lossy(&ended.stderr).into_owned();
        assert!(said.starts_with(&words), "{said}");
    }
}

#[test]
fn a_state_that_cannot_be_written_leaves_no_temporary() {
    let root = tempfile::tempdir().unwrap();
    let sweep = sweep(FEW);
    let folder = Folder::create(root.path(), &sweep, Existing::Refuse).unwrap();
    // Something that cannot be replaced has the state's name.
    let taken = root.path().join("chains/0000000-0000000.state/full");
    std::fs::create_dir_all(taken).unwrap();
    let failed = run(
        &sweep,
        &folder,
        &planned(&sweep, None),
        1,
        &Progress::default(),
    )
    .unwrap_err();
    assert!(
        failed.to_string().contains("0000000-0000000.state"),
        "{failed}"
    );
    let left = names(root.path());
    assert!(
        !left.iter().any(|name| name.contains("temporary")),
        "{left:?}"
    );
}

#[test]
fn another_surface_under_the_same_name_is_another_sweep() {
    let root = tempfile::tempdir().unwrap();
    let place = root.path();
    let write_map = |height: u32| {
        let row = (0..16)
            .map(|i| (height * (i % 8)).to_string())
            .collect::<Vec<_>>();
        let text = format!("{}\n", row.join(",")).repeat(16);
        std::fs::write(place.join("map.csv"), text).unwrap();
    };
    let map = place.join("map.csv");
    let surface = "kind = \"height_map\"\npixel_m = 5e-5\nunit_m = 1e-9";
    let scene = asperity_engine::scene::Scene::load("demonstration").unwrap();
    let scene = toml::to_string(&scene).unwrap();
    let (head, tail) = scene.split_once("[body_2.surface]").unwrap();
    let (_, tail) = tail.split_once("\n[").unwrap();
    let file = format!("file = \"{}\"", map.display());
    let with_map = format!("{head}[body_2.surface]\n{surface}\n{file}\n\n[{tail}");
    std::fs::write(place.join("scene.toml"), with_map).unwrap();
    let vary = "[vary]\nmotion.slide_roll = [0.0, 0.5]\n[chain]\npassages = 0.25\n";
    let plain = format!("scene = \"scene.toml\"\n{vary}");
    // By the scene, by [set], by [vary].
    let set = format!("[set.body_2.surface]\n{surface}\n{file}\n{vary}");
    let varied = format!(
        "[set.body_2.surface]\n{surface}\n[vary]\nbody_2.surface.file = [\"{}\"]\n",
        map.display()
    );
    write_map(10);
    let read = |text: &str| Sweep::parse(text, "map", place).unwrap();
    let before = [&plain, &set, &varied].map(|text| read(text).digest());
    assert_eq!(
        [&plain, &set, &varied].map(|text| read(text).digest()),
        before
    );
    let folder = Folder::create(&place.join("out"), &read(&plain), Existing::Refuse);
    drop(folder.unwrap());
    write_map(11);
    let after = [&plain, &set, &varied].map(|text| read(text).digest());
    for (one, other) in before.iter().zip(&after) {
        assert_ne!(one, other);
    }
    let refused = Folder::create(&place.join("out"), &read(&plain), Existing::Resume);
    let refused = refused.unwrap_err().to_string();
    assert!(refused.contains("another height map"), "{refused}");
    let refused = Folder::sweep_in(&place.join("out"))
        .unwrap_err()
        .to_string();
    assert!(refused.contains("have changed"), "{refused}");
    // Whatever the order of the keys, and relative to the sweep's file.
    let beside = [&set, &varied].map(|text| text.replace(&map.display().to_string(), "map.csv"));
    for text in [&set, &varied, &beside[0], &beside[1]] {
        let scene = read(text).scene(1).unwrap().to_toml();
        assert!(scene.contains(&map.display().to_string()), "{scene}");
    }
}

#[test]
fn cases_of_two_builds_make_no_table() {
    let root = tempfile::tempdir().unwrap();
    let sweep = sweep(FEW);
    let (one, two) = (root.path().join("one"), root.path().join("two"));
    for place in [&one, &two] {
        drop(Folder::create(place, &sweep, Existing::Refuse).unwrap());
    }
    let mark = std::fs::read_to_string(two.join("sweep.digest")).unwrap();
    let other = mark.replace(asperity_session::program::BUILD, "0123456789abcdef");
    assert_ne!(mark, other);
    std::fs::write(two.join("sweep.digest"), other).unwrap();
    let refused = Folder::create(&two, &sweep, Existing::Resume).unwrap_err();
    assert!(
        refused.to_string().contains("build 0123456789abcdef"),
        "{refused}"
    );
    let folders = [&one, &two].map(|place| Folder::open(place, &sweep).unwrap());
    let refused = Rows::gather(&sweep, &folders).unwrap_err();
    assert!(refused.to_string().contains("mix the numbers"), "{refused}");
}

#[cfg(unix)]
#[test]
fn a_stopped_sweep_says_so() {
    let root = tempfile::tempdir().unwrap();
    std::fs::write(root.path().join("tiny.toml"), TINY.replace("0.5\n", "50\n")).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    let args = ["sweep", "tiny.toml", "--out=out", "--threads=1"];
    command
        .args(args)
        .current_dir(root.path())
        .stdin(Stdio::null());
    let child = command
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    while !root.path().join("out/base.toml").exists() {
        std::thread::yield_now();
    }
    std::thread::sleep(std::time::Duration::from_millis(500));
    let pid = child.id().to_string();
    assert!(
        Command::new("kill")
            .args(["-TERM", &pid])
            .status()
            .unwrap()
            .success()
    );
    let output = child.wait_with_output().unwrap();
    refused(
        &output,
        5,
        &["stopped with", "of 8 cases", "--resume continues"],
    );
}

#[test]
fn of_two_sweeps_that_begin_together_in_one_folder_one_does() {
    let sweep = sweep(FEW);
    for existing in [Existing::Refuse, Existing::Replace] {
        let root = tempfile::tempdir().unwrap();
        let gate = std::sync::Barrier::new(2);
        for round in 0..100 {
            let place = root.path().join(format!("sweep-{round}"));
            let begin = || {
                gate.wait();
                let folder = Folder::create(&place, &sweep, existing);
                // Whoever has it stays until the other has been refused.
                gate.wait();
                folder.map(drop)
            };
            let ends = std::thread::scope(|scope| {
                let both = [scope.spawn(begin), scope.spawn(begin)];
                both.map(|one| one.join().unwrap())
            });
            let refused: Vec<_> = ends.into_iter().filter_map(Result::err).collect();
            assert_eq!(refused.len(), 1, "{round}: {refused:?}");
            let told = refused[0].to_string();
            assert!(told.contains("another sweep is working in it"), "{told}");
        }
    }
}

/// Seeds of made surfaces are summed up beside the table: the mean is that of the table's own logarithms, each S by itself, and one
/// key, body 1's seed, draws both surfaces.
#[test]
fn seeds_are_averaged_where_they_vary() {
    let surface = |body: u8| {
        format!(
            "body_{body}.surface.kind = \"random\"\nbody_{body}.surface.rq_m = 1e-7\nbody_{body}.surface.correlation_x_m = 6e-5\n\
             body_{body}.surface.correlation_y_m = inf\n"
        )
    };
    let text = format!(
        "scene = \"fzg_point_b\"\n[set]\n{}{}grid.nodes = 129\n[vary]\nmotion.slide_roll = [0.0, 0.4]\nbody_1.surface.seed = [1, 2, 3]\n\
         [chain]\npassages = 0.5\n",
        surface(1),
        surface(2)
    );
    let sweep = sweep(&text);
    let root = tempfile::tempdir().unwrap();
    let (folder, _) = fill(&sweep, root.path(), None, 2);
    let rows = Rows::gather(&sweep, &[folder]).unwrap();
    let column = |name| rows.column(&sweep, name).unwrap();
    let (lives, slides) = (column("life_common"), column("motion.slide_roll"));
    assert_eq!(lives.len(), 6);
    let csv = rows.seeds_csv(&sweep).unwrap();
    println!("{}", rows.seeds_lines(&sweep).join("\n"));
    let mut lines = csv.lines();
    let head: Vec<&str> = lines.next().unwrap().split(',').collect();
    let place = |name: &str| head.iter().position(|of| *of == name).unwrap();
    let mut means = Vec::new();
    for (line, s) in lines.zip([0.0, 0.4]) {
        let cells: Vec<f64> = line
            .split(',')
            .map(|cell| cell.parse().unwrap_or(f64::NAN))
            .collect();
        let own: Vec<f64> = (0..6)
            .filter(|&k| slides[k] == s)
            .map(|k| lives[k])
            .collect();
        let product: f64 = own.iter().product();
        assert_eq!((cells[0], cells[1], own.len()), (s, 3.0, 3));
        assert!((cells[place("life_common_mean")] / product.cbrt() - 1.0).abs() < 1e-12);
        let least = own.iter().copied().fold(f64::INFINITY, f64::min);
        assert_eq!(cells[place("life_common_least")], least);
        assert!(
            own.iter().any(|life| (life / least - 1.0).abs() > 0.01),
            "pairs differ"
        );
        means.push(product.cbrt());
    }
    assert!(means[1] < means[0], "{means:?}");
}
