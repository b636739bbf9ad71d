//! The page of a sweep: a tooth, a race, a cam, or cases of any keys.

use std::path::Path;

use asperity_engine::math::number::{sig, sig_or_dash};
use asperity_engine::sim::{CautionCode, Summary};
use asperity_session::sweep::{CaseEnd, FlankLife, Folder, Rows, Sweep, pictures};
use maud::{Markup, html};

use super::super::failure::Failure;
use super::{facts, figures, operating, shell};

/// A column of the sweep's table as the page shows it: name there, heading, unit, how many of it make one of the table's.
type Shown = (&'static str, &'static str, &'static str, f64);

/// What is known of each case before it is simulated. What no case has is left out.
const POINTS: [Shown; 16] = [
    ("path_m", "from A", "mm", 1e3),
    ("path_deg", "angle", "°", 1.0),
    ("torque_n_m", "torque", "N m", 1.0),
    ("speed_rpm", "speed", "1/min", 1.0),
    ("time_share", "time", "%", 100.0),
    ("rho_1_m", "ρ₁", "mm", 1e3),
    ("rho_2_m", "ρ₂", "mm", 1e3),
    ("contact.rx_m", "R", "mm", 1e3),
    ("u_1_m_s", "U₁", "m/s", 1.0),
    ("u_2_m_s", "U₂", "m/s", 1.0),
    ("motion.slide_roll", "S", "", 1.0),
    ("load_share", "share", "", 1.0),
    ("load.force_n_per_m", "load", "N/mm", 1e-3),
    ("load.force_n", "load", "N", 1.0),
    ("p_hertz_pa", "Hertz", "GPa", 1e-9),
    ("a_m", "half-width", "µm", 1e6),
];

/// What came of it.
const RESULTS: [Shown; 15] = [
    ("path_m", "from A", "mm", 1e3),
    ("path_deg", "angle", "°", 1.0),
    ("p_max_greatest_pa", "p max", "GPa", 1e-9),
    ("h_regression_m", "film by formula", "µm", 1e6),
    ("h_central_m", "film, centre", "µm", 1e6),
    ("h_min_least_m", "film, least", "µm", 1e6),
    ("lambda_ratio", "λ", "", 1.0),
    ("h_gf_m", "film GF", "µm", 1e6),
    ("lambda_gf", "λ GF", "", 1.0),
    ("contact_load_ratio", "on contacts", "%", 100.0),
    ("friction_coefficient", "friction", "", 1.0),
    ("flash_temperature_max_k", "flash", "K", 1.0),
    ("flash_temperature_blok_k", "flash, Blok", "K", 1.0),
    ("n_counted_body_1", "contacts counted, 1", "", 1.0),
    ("n_counted_body_2", "and 2", "", 1.0),
];

/// And what that costs.
const LIVES: [Shown; 20] = [
    ("path_m", "from A", "mm", 1e3),
    ("path_deg", "angle", "°", 1.0),
    ("life_relative", "life", "", 1.0),
    ("life_relative_low", "from", "", 1.0),
    ("life_relative_high", "to", "", 1.0),
    ("life_models_low", "models from", "", 1.0),
    ("life_models_high", "to", "", 1.0),
    ("life_global", "paper's count", "", 1.0),
    ("cycle_factor", "cycles × basis", "", 1.0),
    ("peak_factor", "peaks", "", 1.0),
    ("traction_factor", "traction", "", 1.0),
    ("life_body", "body", "", 1.0),
    ("load_factor", "load factor", "", 1.0),
    ("life_common", "life, common", "", 1.0),
    ("life_cycles", "cycles", "", 1.0),
    ("a_iso", "a_ISO", "", 1.0),
    ("wear_depth_1_m", "worn, 1", "nm", 1e9),
    ("wear_depth_2_m", "worn, 2", "nm", 1e9),
    ("pitted_area_1", "pitted, 1", "%", 100.0),
    ("pitted_area_2", "pitted, 2", "%", 100.0),
];

/// The page of the sweep in a folder.
pub(super) fn page(root: &Path) -> Result<Markup, Failure> {
    let sweep = Folder::sweep_in(root)?;
    let folder = Folder::open(root, &sweep)?;
    let rows = Rows::gather(&sweep, std::slice::from_ref(&folder))?;
    let drawn: Vec<String> = pictures(&sweep, &rows)?
        .into_iter()
        .map(|(_, svg)| svg)
        .collect();
    let (flank, seeds) = (rows.flank(&sweep), rows.seeds_lines(&sweep));
    let scene = sweep.base_scene()?;
    let worst = worst(&sweep, &rows);
    let body = html! {
        (in_short(&sweep, &rows, &flank, worst))
        (figures(&drawn))
        h2 { "What runs" }
        (facts(&sweep.path_keys()))
        p.sub { "The base scene. Its smooth contact is what “life, common” is relative to; what a case varies is in the table below." }
        (facts(&operating::rows(&scene)))
        h2 { "Where and how" }
        (table(&sweep, &rows, &POINTS, worst))
        h2 { "Pressure, film, friction" }
        (table(&sweep, &rows, &RESULTS, worst))
        h2 { "Life" }
        (table(&sweep, &rows, &LIVES, worst))
        @if !flank.is_empty() { (flanks(&sweep, &flank)) }
        @if !seeds.is_empty() {
            h2 { "Over the seeds" }
            ul { @for line in &seeds { li { (line) } } }
        }
        (cautions(&rows))
        (sources(&sweep, &rows))
    };
    let title = if sweep.title.is_empty() {
        &sweep.name
    } else {
        &sweep.title
    };
    let made = format!(
        "{} cases; numbers of table.csv in {}",
        sweep.len(),
        root.display()
    );
    Ok(shell(title, &made, &body))
}

/// The case with the shortest life by one reference.
fn worst(sweep: &Sweep, rows: &Rows) -> Option<usize> {
    let lives = rows.column(sweep, "life_common")?;
    let known = lives
        .iter()
        .enumerate()
        .filter(|(_, life)| life.is_finite());
    known
        .min_by(|a, b| a.1.total_cmp(b.1))
        .map(|(case, _)| case)
}

/// Where a case is, in words.
fn place(sweep: &Sweep, rows: &Rows, case: usize) -> String {
    let at = |name| rows.column(sweep, name).map(|list| list[case]);
    match (at("path_m"), at("path_deg")) {
        (Some(way_m), _) => format!("{} mm from A", sig(1e3 * way_m, 3)),
        (None, Some(angle)) => format!("at {}°", sig(angle, 3)),
        (None, None) => sweep.at(case),
    }
}

fn in_short(sweep: &Sweep, rows: &Rows, flank: &[FlankLife], worst: Option<usize>) -> Markup {
    let told = worst.and_then(|case| {
        let summary = &rows.records[case].summary;
        // What the base scene's smooth contact has to do with it is said in the words of a sweep.
        let at_its_own = Summary {
            load_factor: Some(1.0),
            ..summary.clone()
        };
        Some((case, at_its_own.headline()?, summary.life_common?))
    });
    let least = |name: &str| {
        let list = rows.column(sweep, name)?;
        let known = list
            .into_iter()
            .enumerate()
            .filter(|(_, value)| value.is_finite());
        let (case, value) = known.min_by(|a, b| a.1.total_cmp(&b.1))?;
        Some((sig(value, 3), place(sweep, rows, case)))
    };
    let weakest = flank.iter().filter_map(|at| Some((at, at.weaker()?)));
    let weakest = weakest.min_by(|a, b| a.1.1.total_cmp(&b.1.1));
    let hours = flank.iter().filter_map(|at| Some((at.hours?, at)));
    let hours = hours.min_by(|a, b| a.0.total_cmp(&b.0));
    let unfinished = rows
        .records
        .iter()
        .filter(|r| r.end != CaseEnd::Converged)
        .count();
    html! {
        @if let Some((at, (flank, turns))) = weakest {
            p.head {
                b { "shortest" } "the " (["pinion", "wheel"][flank]) ", " (sig(1e3 * at.path_m, 3)) " mm from A: "
                (sig(turns, 3)) " turns of the pinion over the loading cycles of the base scene's smooth contact"
            }
        }
        @if let Some((case, told, common)) = &told {
            p.head {
                b { @if weakest.is_some() { "contact" } @else { "shortest" } } (place(sweep, rows, *case)) ": " (told.life)
                "; " (sig(*common, 3)) " over the base scene's smooth contact"
            }
            p.head {
                b { "because" } (told.because)
                @if weakest.is_some() { " by that; but a flank meets its mate once a turn, however fast it rolls" }
            }
            p.head { b { "trust" } (told.trust) }
        }
        @if let Some(ring) = rows.ring(sweep) {
            p.head {
                b { "inner ring" } (sig(ring.turns, 3)) " turns over the loading cycles of the base scene's smooth contact"
                @if let Some(hours) = ring.hours { ", " (sig(hours, 3)) " hours" }
                ", by Miner's sum round the loaded zone: 1/R = Z(1 + D/d)/2 ∫dψ/2πN"
            }
        }
        @if let Some((hours, at)) = hours {
            p.head { b { "in time" } (sig(hours, 3)) " hours, " (sig(1e3 * at.path_m, 3)) " mm from A, at the calibration's survival" }
        }
        @for (name, words) in [("lambda_ratio", "least λ"), ("lambda_gf", "least λ GF")] {
            @if let Some((value, place)) = least(name) {
                p.head { b { (words) } (value) ", " (place) }
            }
        }
        @if unfinished > 0 {
            p.head { b { "mind" } (unfinished) " of " (rows.records.len()) " cases did not converge: see below" }
        }
    }
}

/// Some columns of the sweep's table, a row a case.
fn table(sweep: &Sweep, rows: &Rows, shown: &[Shown], worst: Option<usize>) -> Markup {
    let found = shown.iter().filter_map(|&(name, head, unit, per)| {
        let list = rows.column(sweep, name)?;
        let is_known = list.iter().any(|value| value.is_finite());
        is_known.then_some((name, head, unit, per, list))
    });
    let found: Vec<_> = found.collect();
    // A path says by its own columns where a case is.
    let axes: Vec<usize> = if sweep.path.is_empty() {
        (0..sweep.axes.len()).collect()
    } else {
        Vec::new()
    };
    let said = |name: &str| axes.iter().any(|&axis| sweep.axes[axis].key == name);
    html! {
        div.wide { table {
            thead { tr {
                th { "case" }
                @for &axis in &axes { th { (sweep.axes[axis].key) br; small { (sweep.axes[axis].unit()) } } }
                @for (name, head, unit, ..) in &found { @if !said(name) { th { (head) br; small { (unit) } } } }
            } }
            @for case in 0..sweep.len() {
                tr.worst[worst == Some(case)] {
                    td { (case) }
                    @for &axis in &axes { td { (sweep.values(case)[axis]) } }
                    @for (name, _, _, per, list) in &found {
                        @if !said(name) { td data-column=(name) data-case=(case) { (cell(name, list[case] * per)) } }
                    }
                }
            }
        } }
    }
}

/// A number as its cell has it: three figures, or the name of a body.
fn cell(name: &str, value: f64) -> String {
    if name == "life_body" && value.is_finite() {
        format!("{value:.0}")
    } else {
        sig(value, 3)
    }
}

/// The life of both flanks.
fn flanks(sweep: &Sweep, places: &[FlankLife]) -> Markup {
    let loads = sweep.loads();
    html! {
        h2 { "Both flanks" }
        p.sub {
            "Turns of the pinion over the loading cycles of the base scene's smooth contact; of several loads by Miner's sum, "
            "and what each takes of the shorter life."
        }
        div.wide { table {
            thead { tr {
                th { "from A" br; small { "mm" } }
                th { "pinion" } th { "wheel" } th { "hours" }
                @if loads.len() > 1 { @for k in 1..=loads.len() { th { "load " (k) br; small { "%" } } } }
            } }
            @for at in places {
                tr {
                    td { (sig(1e3 * at.path_m, 3)) }
                    @for turns in at.turns { td { (sig_or_dash(turns, 3)) } }
                    td { (sig_or_dash(at.hours, 3)) }
                    @if loads.len() > 1 { @for share in &at.shares { td { (sig(100.0 * share, 3)) } } }
                }
            }
        } }
    }
}

/// What to know before trusting the numbers: each kind once, in the words of its first case.
fn cautions(rows: &Rows) -> Markup {
    let mut found: Vec<Kind> = Vec::new();
    for record in &rows.records {
        let failed = (record.end != CaseEnd::Converged).then(|| {
            record
                .failure
                .as_deref()
                .unwrap_or("some steps did not converge")
        });
        let own = record
            .summary
            .cautions
            .iter()
            .map(|caution| (Some(caution.code), &*caution.text));
        for (code, text) in failed.map(|why| (None, why)).into_iter().chain(own) {
            match found.iter_mut().find(|kind| kind.code == code) {
                Some(kind) => {
                    kind.is_one_text &= kind.text == text;
                    if kind.cases.last() != Some(&record.index) {
                        kind.cases.push(record.index);
                    }
                }
                None => found.push(Kind {
                    code,
                    text,
                    is_one_text: true,
                    cases: vec![record.index],
                }),
            }
        }
    }
    html! {
        h2 { "Cautions" }
        @if found.is_empty() { p { "none" } }
        ul {
            @for kind in &found { li { (kind.text) " (" (kind.of_cases(rows.records.len())) ")" } }
        }
    }
}

/// A kind of caution, in the words of the first of its cases.
struct Kind<'a> {
    code: Option<CautionCode>,
    text: &'a str,
    is_one_text: bool,
    cases: Vec<usize>,
}

impl Kind<'_> {
    fn of_cases(&self, all: usize) -> String {
        let list: Vec<String> = self.cases.iter().map(usize::to_string).collect();
        let which = match &list[..] {
            [one] => return format!("case {one}"),
            _ if list.len() == all => "all cases".to_owned(),
            _ => format!("cases {}", list.join(", ")),
        };
        if self.is_one_text {
            return which;
        }
        format!("in the words of case {}; {which}", self.cases[0])
    }
}

/// Every number with its formula and its source.
fn sources(sweep: &Sweep, rows: &Rows) -> Markup {
    let has = |name: &str| {
        let list = rows.column(sweep, name).unwrap_or_default();
        list.iter().any(|value| value.is_finite())
    };
    let told = SOURCES
        .iter()
        .filter(|(name, ..)| name.is_empty() || has(name));
    // Of the scene's own model: several have each its own source.
    let life = rows.records.iter().find_map(|record| {
        let s = &record.summary;
        Some([
            s.life_model.as_ref()?,
            s.life_count.as_ref()?,
            s.life_basis.as_ref()?,
        ])
    });
    html! {
        h2 { "Formulas and sources" }
        table.words {
            @for (_, what, formula, source) in told { tr { td { b { (what) } } td { (formula) } td { (source) } } }
            @if let Some([model, count, basis]) = life { tr { td { b { "life" } } td { (model) ", " (count) } td { (basis) } } }
        }
    }
}

/// Column without which the line is left out, what it is, formula, source.
const SOURCES: [(&str, &str, &str, &str); 14] = [
    (
        "rho_1_m",
        "tooth",
        "ρ₁ = s, ρ₂ = T₁T₂ − s, U = ωρ, w = share T₁/(r_b b)",
        "involute geometry; letters of ISO 14635-1; how two pairs share is assumed",
    ),
    (
        "",
        "R, S, U",
        "1/R = 1/ρ₁ + 1/ρ₂, U = (U₁ + U₂)/2, S = (U₂ − U₁)/U",
        "definitions",
    ),
    (
        "",
        "Hertz pressure",
        "of a line √(wE'/2πR), of a point 3F/2πab",
        "Hertz 1881",
    ),
    (
        "h_regression_m",
        "film by formula",
        "smooth, isothermal, fully flooded",
        "of a line Moes, of a point Nijenbanning, Venner & Moes 1994",
    ),
    (
        "h_central_m",
        "film, pressure, friction",
        "simulated: transient mixed lubrication with the roughness of both bodies",
        "this program, means over the last passage; p max and film, least: the greatest and the least of it",
    ),
    (
        "lambda_ratio",
        "λ",
        "film by formula over √(Rq₁² + Rq₂²)",
        "definition",
    ),
    (
        "lambda_gf",
        "λ GF",
        "h/Ra, h = 1600 ρ G^0.6 U^0.7 W^−0.13 S^0.22 µm with ρ = R in mm, Ra = (Ra₁ + Ra₂)/2; with [heat] at the viscosity of Blok's flash temperature; without factors of dynamics and application",
        "ISO/TS 6336-22 as quoted in Procedia Struct. Integrity 57 (2024) 199",
    ),
    (
        "flash_temperature_blok_k",
        "flash, Blok",
        "1.1115 Q/(√2a Σ√(kρcU))",
        "Blok 1937, with the friction that was simulated",
    ),
    (
        "life_common",
        "life, common",
        "life × load factor: over that of the smooth contact of the base scene, so that cases can be compared",
        "this program",
    ),
    (
        "cycle_factor",
        "life",
        "cycles × basis × peaks × traction; basis: from a body's own loading cycles to those of the faster one, in which damage is counted",
        "this program",
    ),
    (
        "life_global",
        "paper's count",
        "one n by formula for the whole volume",
        "Pu, Zhu, Wang & Wang, Int. J. Fatigue 90 (2016)",
    ),
    (
        "life_cycles",
        "cycles",
        "life, common × the smooth contact's cycles by life.calibration_cycles and _pressure_pa",
        "the scene's calibration point",
    ),
    (
        "time_share",
        "several loads",
        "1/R = Σ f_k/R_k",
        "Palmgren 1924, Miner 1945",
    ),
    (
        "a_iso",
        "a_ISO",
        "life factor of rolling bearings, to stand beside: it holds a penalty of roughness of its own",
        "ISO 281:2007",
    ),
];
