//! Every number that a person reads, from every place where it stands, for the same state: summary, table,
//! recording, report and screen, over all presets and twenty settings of the knobs. Two numbers agree when they
//! differ by no more than the rounding of their last printed digits. Means of the summary are made again here
//! from the rows of the table.
#![cfg(all(feature = "tui", feature = "rerun"))]
#![expect(clippy::unwrap_used, reason = "tests")]

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;
use std::process::Command;
use std::sync::Arc;
use std::time::Duration;

use crate::common::tui_fixture::{plain, setup_planned};
use asperity_engine::plan::Plan;
use asperity_engine::scene::{ContactKind, Override, Scene, presets};
use asperity_explorer::tui::app::{App, Leading};
use asperity_explorer::tui::view;
use asperity_session::run::{Ending, Request, Session, share_out};
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use re_chunk::Chunk;
use re_log_encoding::DecoderApp;
use rerun::external::re_log_types::LogMsg;

const SIZE: (u16, u16) = (160, 48);

/// Keys that every case has: grids small enough for thirty runs, and the whole passage in the means.
const COMMON: [&str; 3] = ["stress.depths=8", "time.passages=1", "time.step_nodes=1"];

/// The default scene's few nodes and waves that they carry, for its settings.
const FEW: [&str; 4] = [
    "grid.nodes=33",
    "body_1.surface.wavelength_x_m=4e-4",
    "body_2.surface.wavelength_x_m=4e-4",
    "body_2.surface.wavelength_y_m=4e-4",
];

/// Settings of the default scene.
const SETTINGS: [&[&str]; 20] = [
    &["motion.slide_roll=-2"],
    &["motion.slide_roll=-0.5"],
    &["motion.slide_roll=0"],
    &["motion.slide_roll=0.05"],
    &["motion.slide_roll=1.3"],
    &["motion.slide_roll=2"],
    &["load.force_n=200"],
    &["load.force_n=2376"],
    &["body_1.surface.amplitude_m=0"],
    &["body_2.surface.amplitude_m=0"],
    &[
        "body_1.surface.amplitude_m=1e-9",
        "body_2.surface.amplitude_m=1e-9",
    ],
    &["body_1.surface.amplitude_m=5e-7"],
    &["motion.entrainment_m_s=0.05"],
    &["motion.entrainment_m_s=5"],
    &["motion.entrainment_m_s=-1"],
    &["lubricant.rheology=newtonian"],
    &["lubricant=none"],
    &["life=none"],
    &["life.cycles=peaks"],
    &["body_2.young_pa=7e10", "body_2.poisson=0.22"],
];

/// A number as it stands somewhere: its value in SI, and what its rounding may hide.
#[derive(Debug, Clone, Copy)]
struct Shown {
    value: f64,
    rounding: f64,
}

impl Shown {
    fn exact(value: f64) -> Self {
        let rounding = 1e-9 * value.abs();
        Self { value, rounding }
    }

    /// Reads `text`; `per_si`: how many of the printed unit make one SI unit.
    fn read(text: &str, per_si: f64) -> Option<Self> {
        let text = text.trim_matches(|c: char| !(c.is_ascii_digit() || "-.e".contains(c)));
        let value: f64 = text.parse().ok()?;
        let (mantissa, exponent) = text.split_once('e').unwrap_or((text, "0"));
        let decimals = mantissa.split_once('.').map_or(0, |(_, d)| d.len() as i32);
        let digit = 10_f64.powi(exponent.parse::<i32>().ok()? - decimals);
        Some(Self {
            value: value / per_si,
            rounding: 0.5000001 * digit / per_si,
        })
    }

    fn agrees(self, other: Self) -> bool {
        let slack = self.rounding + other.rounding;
        (self.value - other.value).abs() <= slack.max(1e-300)
    }
}

/// One quantity of a case and what every place says of it.
struct Row {
    quantity: &'static str,
    places: Vec<(&'static str, Shown)>,
}

impl Row {
    fn agrees(&self) -> bool {
        let all = &self.places;
        all.iter().all(|a| all.iter().all(|b| a.1.agrees(b.1)))
    }
}

struct Case {
    name: String,
    scene: String,
    sets: Vec<String>,
}

fn cases() -> Vec<Case> {
    let presets = asperity_engine::scene::presets::all();
    let mut cases: Vec<Case> = presets
        .iter()
        .map(|preset| {
            let scene = Scene::load_with(preset.name, &[]).unwrap();
            let nodes = match scene.kind() {
                ContactKind::Line => "grid.nodes=129",
                ContactKind::Point => "grid.nodes=65",
            };
            Case {
                name: preset.name.to_owned(),
                scene: preset.name.to_owned(),
                sets: vec![nodes.to_owned()],
            }
        })
        .collect();
    cases.extend(SETTINGS.map(|sets| Case {
        name: sets.join(" "),
        scene: presets::QUICK.to_owned(),
        sets: sets.iter().chain(&FEW).map(|&set| set.to_owned()).collect(),
    }));
    for case in &mut cases {
        case.sets.extend(COMMON.map(str::to_owned));
    }
    cases
}

/// What a run of the program wrote.
struct Written {
    summary: serde_json::Value,
    table: Vec<BTreeMap<String, String>>,
    recording: BTreeMap<String, Vec<f64>>,
    report: String,
    /// Labels that were looked for in a line of the report that does not have them.
    unsaid: RefCell<Vec<String>>,
}

impl Written {
    fn of(case: &Case, folder: &Path) -> Self {
        let at = |name: &str| folder.join(name).display().to_string();
        let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
        command.args([
            "run",
            &case.scene,
            "--force",
            "--threads=1",
            "--out",
            &at("r.rrd"),
        ]);
        command.args(["--table", &at("t.csv"), "--summary", &at("s.json")]);
        for set in &case.sets {
            command.args(["--set", set]);
        }
        let output = command.output().unwrap();
        let code = output.status.code();
        assert!(
            matches!(code, Some(0 | 2)),
            "{}: {code:?} {}",
            case.name,
            String::from_utf8_lossy(&output.stderr)
        );
        let mut reader = csv::Reader::from_path(at("t.csv")).unwrap();
        Self {
            summary: serde_json::from_slice(&std::fs::read(at("s.json")).unwrap()).unwrap(),
            table: reader.deserialize().map(Result::unwrap).collect(),
            recording: last_scalars(Path::new(&at("r.rrd"))),
            report: String::from_utf8(output.stdout).unwrap(),
            unsaid: RefCell::default(),
        }
    }

    fn summary(&self, key: &str) -> Option<Shown> {
        Some(Shown::exact(self.summary[key].as_f64()?))
    }

    /// The change of unit, which is told where there is one.
    fn said_basis(&self) -> Option<Shown> {
        match self.summary["basis_factor"].as_f64()? {
            1.0 => None,
            _ => self.said("relative life", "basis ", 1.0),
        }
    }

    /// A cycle factor without the change of unit that is in it.
    fn own_cycles(&self, cycles: Option<Shown>) -> Option<Shown> {
        let basis = self.summary["basis_factor"].as_f64()?;
        Some(Shown::exact(cycles?.value / basis))
    }

    fn cell(&self, row: usize, column: &str) -> Option<f64> {
        self.table[row][column].parse().ok()
    }

    fn last(&self, column: &str) -> Option<Shown> {
        self.cell(self.table.len() - 1, column).map(Shown::exact)
    }

    fn recorded(&self, entity: &str, place: usize, per_si: f64) -> Option<Shown> {
        let value = self.recording.get(entity)?.get(place)? / per_si;
        Some(Shown::exact(value))
    }

    /// Rows that the summary averages, with the way that each stands for, in a.
    fn window(&self) -> Vec<(usize, f64)> {
        let way = |row: usize| 4.0 * self.cell(row, "passages").unwrap();
        let last = self.table.len() - 1;
        let period_a = self.summary["period_s"].as_f64().map(|period_s| {
            let speed = self.cell(last, "entrainment_m_s").unwrap().abs();
            period_s * speed / self.summary["a_m"].as_f64().unwrap()
        });
        let window = match (self.summary["rhythm"].as_str(), period_a) {
            (Some("orbit"), Some(period)) if period <= 4.0 => {
                period * (4.0 / period * (1.0 + 1e-9)).floor()
            }
            (Some("orbit"), Some(period)) => period,
            _ => 4.0,
        };
        let start = way(last) - window;
        let rows = 0..=last;
        rows.map(|row| {
            let before = if row == 0 { 0.0 } else { way(row - 1) };
            (row, way(row) - before.max(start))
        })
        .filter(|(_, weight)| *weight > 1e-9)
        .collect()
    }

    fn mean(&self, column: &str) -> Option<Shown> {
        let (mut sum, mut length) = (0.0, 0.0);
        for (row, weight) in self.window() {
            sum += weight * self.cell(row, column)?;
            length += weight;
        }
        Some(Shown::exact(sum / length))
    }

    fn extreme(&self, column: &str, pick: fn(f64, f64) -> f64) -> Option<Shown> {
        let rows = self.window();
        let values = rows.iter().map(|(row, _)| self.cell(*row, column));
        values
            .collect::<Option<Vec<f64>>>()?
            .into_iter()
            .reduce(pick)
            .map(Shown::exact)
    }

    /// The number behind `label` in the line of the report that begins with `line`; `None`: there is none.
    fn said(&self, line: &str, label: &str, per_si: f64) -> Option<Shown> {
        let line = self.report.lines().find(|text| text.starts_with(line))?;
        let Some(at) = line.find(label) else {
            self.unsaid.borrow_mut().push(label.to_owned());
            return None;
        };
        Shown::read(line[at + label.len()..].split_whitespace().next()?, per_si)
    }
}

/// The last scalars of every entity of a recording.
fn last_scalars(path: &Path) -> BTreeMap<String, Vec<f64>> {
    let reader = std::io::BufReader::new(std::fs::File::open(path).unwrap());
    let component = rerun::Scalars::descriptor_scalars().component;
    let mut found: BTreeMap<String, (i64, Vec<f64>)> = BTreeMap::new();
    for message in DecoderApp::decode_eager(reader).unwrap() {
        let LogMsg::ArrowMsg(store, message) = message.unwrap() else {
            continue;
        };
        if store.is_blueprint() {
            continue;
        }
        let chunk = Chunk::from_arrow_msg(&message).unwrap();
        let entity = chunk.entity_path().to_string();
        let Some(steps) = chunk.timelines().get(&"step".into()) else {
            continue;
        };
        let rows = chunk.iter_slices::<f64>(component);
        for (&step, values) in steps.times_raw().iter().zip(rows) {
            let held = found
                .entry(entity.clone())
                .or_insert((i64::MIN, Vec::new()));
            if step >= held.0 {
                *held = (step, values.to_vec());
            }
        }
    }
    let strip = |(entity, (_, values)): (String, (i64, Vec<f64>))| {
        (entity.trim_start_matches('/').to_owned(), values)
    };
    found.into_iter().map(strip).collect()
}

/// The explorer with the last frame of a run, made in this process.
pub(crate) fn explorer_after(scene: Scene, name: &str) -> App {
    let plan = Plan::new(&scene).unwrap();
    let mut app = App::new(setup_planned(&scene, name, &plan), Vec::new(), plain());
    let session = Session::start(Request {
        name: String::new(),
        scene: Arc::new(scene),
        plan,
        threads: 1,
        watchers: Vec::new(),
        ending: Ending::Passages,
    });
    let session = session.unwrap();
    let handle = session.handle.clone();
    session.join().unwrap();
    app.tick(Duration::from_millis(25));
    app.take_frame(handle.latest().take().unwrap());
    app
}

/// The explorer's screen with the last frame of the same run, made in this process.
struct Screen {
    kind: ContactKind,
    /// Whether its life is the simulated one; before it has settled the formula leads, and says so.
    is_simulated: bool,
    rows: Vec<String>,
}

impl Screen {
    fn of(case: &Case) -> Self {
        let sets: Vec<Override> = case.sets.iter().map(|text| text.parse().unwrap()).collect();
        let scene = Scene::load_with(&case.scene, &sets).unwrap();
        let (kind, app) = (scene.kind(), explorer_after(scene, &case.scene));
        let mut terminal = Terminal::new(TestBackend::new(SIZE.0, SIZE.1)).unwrap();
        terminal.draw(|frame| view::draw(&app, frame)).unwrap();
        let buffer = terminal.backend().buffer();
        let row = |y| (0..SIZE.0).map(|x| buffer[(x, y)].symbol()).collect();
        let rows: Vec<String> = (0..SIZE.1).map(row).collect();
        let is_simulated = app.leading() == Leading::Simulated;
        let word = rows
            .iter()
            .any(|row| row.contains("formula") || row.contains("scaled"));
        assert!(
            is_simulated || app.leading_life().is_none() || word,
            "{}",
            case.name
        );
        Self {
            kind,
            is_simulated,
            rows,
        }
    }

    /// The number behind `label`, in the last of the rows that have it among those from `first` on.
    fn shown(&self, first: usize, label: &str, per_si: f64) -> Option<Shown> {
        let row = self.rows[first..].iter().find(|row| row.contains(label))?;
        let rest = &row[row.rfind(label)? + label.len()..];
        Shown::read(rest.split_whitespace().next()?, per_si)
    }

    /// The factor behind the bar of that name.
    /// The body that governs, beside what takes the life.
    fn governs(&self) -> Option<Shown> {
        let of = |row: &&String| row.contains("take") && row.contains("; body ");
        let row = self.rows.iter().find(of).filter(|_| self.is_simulated)?;
        Shown::read(row.split_once("; body ")?.1.split_whitespace().next()?, 1.0)
    }

    fn factor(&self, name: &str) -> Option<Shown> {
        if !self.is_simulated {
            return None;
        }
        let row = self
            .rows
            .iter()
            .find(|row| row.contains(name) && row.contains('×'))?;
        Shown::read(row.rsplit('×').next()?.split_whitespace().next()?, 1.0)
    }
}

fn row(quantity: &'static str, places: &[(&'static str, Option<Shown>)]) -> Option<Row> {
    let places: Vec<_> = places
        .iter()
        .filter_map(|(place, shown)| Some((*place, (*shown)?)))
        .collect();
    (places.len() > 1).then_some(Row { quantity, places })
}

/// Means and totals over the passage: summary, the same from the table's rows, report.
fn of_the_passage(w: &Written) -> Vec<Row> {
    let mean = |name: &'static str, report: Option<Shown>| {
        row(
            name,
            &[
                ("summary", w.summary(name)),
                ("table's mean", w.mean(name)),
                ("report", report),
            ],
        )
    };
    let last = |name: &'static str, report: Option<Shown>| {
        row(
            name,
            &[
                ("summary", w.summary(name)),
                ("table's last", w.last(name)),
                ("report", report),
            ],
        )
    };
    let rows = [
        mean("h_central_m", w.said("film", "central ", 1e9)),
        mean("h_min_m", w.said("film", "mean of the steps' minima ", 1e9)),
        mean(
            "p_max_pa",
            w.said("pressure", "mean of the steps' maxima ", 1e-9),
        ),
        mean("contact_ratio", None),
        mean(
            "friction_coefficient",
            w.said("friction", "coefficient ", 1.0),
        ),
        mean("load_n", None),
        mean(
            "traction_max_pa",
            w.said("τ max", "mean of the steps ", 1e-9),
        ),
        row(
            "p_max_greatest_pa",
            &[
                ("summary", w.summary("p_max_greatest_pa")),
                ("table's greatest", w.extreme("p_max_pa", f64::max)),
                ("report", w.said("pressure", "maximum ", 1e-9)),
            ],
        ),
        row(
            "h_min_least_m",
            &[
                ("summary", w.summary("h_min_least_m")),
                ("table's least", w.extreme("h_min_m", f64::min)),
                ("report", w.said("film", ", minimum ", 1e9)),
            ],
        ),
        row(
            "sigma_eff_max_pa",
            &[
                ("summary", w.summary("sigma_eff_max_pa")),
                ("table's greatest", w.extreme("sigma_eff_max_pa", f64::max)),
                ("report", w.said("stress", "effective stress ", 1e-9)),
            ],
        ),
        last("n_body_1", w.said("cycles", "body 1: ", 1.0)),
        last("n_body_2", w.said("cycles", "body 2: ", 1.0)),
        last("n_counted_body_1", w.said("cycles", "counted ", 1.0)),
        last("n_counted_body_2", None),
        last(
            "life_relative",
            w.said("relative life", "relative life", 1.0),
        ),
        last("cycle_factor", None),
        row(
            "own cycles",
            &[
                ("summary", w.own_cycles(w.summary("cycle_factor"))),
                ("report", w.said("relative life", "cycles ", 1.0)),
                ("report's headline", w.said("because", "cycles x ", 1.0)),
            ],
        ),
        row(
            "basis_factor",
            &[
                ("summary", w.summary("basis_factor")),
                ("report", w.said_basis()),
            ],
        ),
        row(
            "life_body",
            &[
                ("summary", w.summary("life_body")),
                ("report", w.said("because", "body ", 1.0)),
            ],
        ),
        last("peak_factor", w.said("relative life", "peaks ", 1.0)),
        last("traction_factor", w.said("relative life", "traction ", 1.0)),
        last("load_factor", None),
        last("i_ref", None),
    ];
    rows.into_iter().flatten().collect()
}

/// The last step: table, recording, screen.
fn of_the_last_step(w: &Written, screen: &Screen, line: bool) -> Vec<Row> {
    let status = SIZE.1 as usize - 2;
    let three = |name: &'static str, recorded: Option<Shown>, shown: Option<Shown>| {
        row(
            name,
            &[
                ("table", w.last(name)),
                ("recording", recorded),
                ("screen", shown),
            ],
        )
    };
    let load_entity = if line {
        "series/load_N_per_m"
    } else {
        "series/load_N"
    };
    let rows = [
        three(
            "yielded_body_1_m3",
            w.recorded("series/yielded_um3", 0, 1e18),
            None,
        ),
        three(
            "p_max_pa",
            w.recorded("series/pressure_GPa", 0, 1e-9),
            screen.shown(status, "p max ", 1e-9),
        ),
        three(
            "p_hertz_pa",
            w.recorded("series/pressure_GPa", 1, 1e-9),
            screen.shown(0, "p_h ", 1e-9),
        ),
        three("h_central_m", w.recorded("series/film_um", 0, 1e6), None),
        three("h_mean_m", w.recorded("series/film_um", 1, 1e6), None),
        three(
            "h_min_m",
            w.recorded("series/film_um", 2, 1e6),
            screen.shown(status, "h min ", 1e9),
        ),
        three(
            "contact_ratio",
            w.recorded("series/contact_percent", 0, 100.0),
            screen.shown(status, "contact ", 100.0),
        ),
        three(
            "contact_load_ratio",
            w.recorded("series/contact_percent", 1, 100.0),
            None,
        ),
        three(
            "friction_coefficient",
            w.recorded("series/friction", 0, 1.0),
            screen.shown(status, " µ ", 1.0),
        ),
        three(
            "traction_max_pa",
            w.recorded("series/traction_max_GPa", 0, 1e-9),
            screen.shown(status, "τ max ", 1e-9),
        ),
        three(
            "slide_roll",
            w.recorded("series/motion", 0, 1.0),
            screen.shown(0, " S ", 1.0),
        ),
        three("entrainment_m_s", w.recorded("series/motion", 2, 1.0), None),
        three("load_n", w.recorded(load_entity, 0, 1.0), None),
        three(
            "lambda_ratio",
            w.recorded("series/lambda_ratio", 0, 1.0),
            screen.shown(status, "λ ", 1.0),
        ),
        three(
            "sigma_eff_max_pa",
            w.recorded("series/stress_GPa", 0, 1e-9),
            None,
        ),
        three(
            "n_body_1",
            w.recorded("life/contacts_per_cycle/n_1_formula", 0, 1.0),
            screen.shown(1, "n₁ ", 1.0),
        ),
        three(
            "n_body_2",
            w.recorded("life/contacts_per_cycle/n_2_formula", 0, 1.0),
            screen.shown(1, "n₂ ", 1.0),
        ),
        three(
            "n_counted_body_1",
            w.recorded("life/contacts_per_cycle/n_1_counted", 0, 1.0),
            None,
        ),
        three(
            "n_counted_body_2",
            w.recorded("life/contacts_per_cycle/n_2_counted", 0, 1.0),
            None,
        ),
        three("life_relative", w.recorded("life/relative", 0, 1.0), None),
        row(
            "own cycles",
            &[
                ("table", w.own_cycles(w.last("cycle_factor"))),
                ("screen", screen.factor("cycles")),
            ],
        ),
        row(
            "life_body",
            &[
                ("summary", w.summary("life_body")),
                ("screen", screen.governs()),
            ],
        ),
        three("peak_factor", None, screen.factor("peaks")),
        three("traction_factor", None, screen.factor("traction")),
        three("load_factor", None, screen.factor("load")),
    ];
    rows.into_iter().flatten().collect()
}

/// What a case says in all places, of the passage and of its last step.
fn compared(case: &Case) -> [(&'static str, Vec<Row>); 2] {
    let folder = tempfile::tempdir().unwrap();
    let written = Written::of(case, folder.path());
    let screen = Screen::of(case);
    let line = screen.kind == ContactKind::Line;
    let compared = [
        ("passage", of_the_passage(&written)),
        ("last step", of_the_last_step(&written, &screen, line)),
    ];
    for (kind, rows) in &compared {
        // A place that is no longer found would make the comparison empty.
        let (name, n) = (&case.name, rows.len());
        assert!(n >= 8, "{name}: {kind}: {n} rows");
    }
    // Once the report's words have changed nothing would be compared with them.
    if case.name == "demonstration" {
        assert!(written.unsaid.borrow().is_empty(), "{:?}", written.unsaid);
    }
    compared
}

/// The rows of a case as Markdown, and how many numbers disagree.
fn told(case: &Case, kind: &str, rows: &[Row], report: &mut String) -> usize {
    for row in rows {
        let names: Vec<&str> = row.places.iter().map(|(place, _)| *place).collect();
        let (value, verdict) = if row.agrees() {
            (format!("{:.6e}", row.places[0].1.value), "")
        } else {
            let each = row
                .places
                .iter()
                .map(|(_, shown)| format!("{:.6e}", shown.value));
            (each.collect::<Vec<_>>().join(", "), "**disagree**")
        };
        let _ = writeln!(
            report,
            "| `{}` | {kind} | {} | {value} | {} | {verdict} |",
            case.name,
            row.quantity,
            names.join(", ")
        );
    }
    rows.iter().filter(|row| !row.agrees()).count()
}

#[test]
fn every_number_is_the_same_in_every_place() {
    let mut report =
        String::from("| case | of | quantity | SI | in | |\n|---|---|---|---|---|---|\n");
    let cases = cases();
    let all = share_out(&cases, 2, compared, &mut |_, _| {});
    let (mut disagreements, mut n_compared) = (0, 0);
    for (case, of_case) in cases.iter().zip(all) {
        for (kind, rows) in of_case {
            n_compared += rows.iter().map(|row| row.places.len()).sum::<usize>();
            disagreements += told(case, kind, &rows, &mut report);
        }
    }
    let total = format!(
        "{n_compared} numbers of {} cases compared, {disagreements} disagreements",
        cases.len()
    );
    println!("{report}\n{total}");
    assert_eq!(disagreements, 0, "{total}\n{report}");
}

/// The comparison sees a number that is off by a digit.
#[test]
fn a_planted_fault_is_seen() {
    let shown = |text: &str| Shown::read(text, 1.0).unwrap();
    assert!(shown("0.158").agrees(Shown::exact(0.15772)));
    assert!(!shown("0.157").agrees(Shown::exact(0.15772)));
    assert!(shown("1.58e-8").agrees(Shown::exact(1.5772e-8)));
    assert!(!shown("0.000").agrees(Shown::exact(8e-3)));
    assert!(shown("26,").agrees(Shown::exact(26.4)));
}
