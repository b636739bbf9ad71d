//! Whether bands hold what they are said to hold: presets, and scenes drawn around them, as a user runs them, against a mesh twice
//! as fine and a run four times as long.
//!
//! ```text
//! answer     what `asperity run` prints: up its ladder, or beside a companion on half the nodes, its band over phases where it hangs
//!            on them
//! life       inside: low ≤ life of the finer and longer run ≤ high, on every mesh of the ladder; width: ln (high/low)/2 over
//!            |ln life − ln that|
//! others     inside: |value − that of the finer run of the same length, at the same moment| ≤ its error; width: the one over the
//!            other
//! drawn      number k: S over 0 to 1.6, load, speed, amplitudes .5 to 1.5, .4 to 2.5 and .4 to 1.6 times the preset's, by the
//!            fractions of k α^i, 1/α = 1.1347 (Roberts 2018: the sequence that fills five dimensions evenly)
//! ```
//! The finer run is not the truth: what it is itself off counts against the band.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use asperity_engine::plan::Plan;
use asperity_engine::scene::{ContactKind, Knob, Scene, presets};
use asperity_engine::sim::{Rung, Summary};
use asperity_session::run::{Assumed, Companion, NoEstimate};

use super::{
    Extent, MarkdownTable, Report, StudyError, StudyProgress, climb, figure, planned,
    refuse_nothing, run_all, scene_with,
};

/// How much longer the run is that answers are compared with.
const LONGER: f64 = 4.0;
/// Of a hundred bands so many hold it.
const ASKED: f64 = 0.95;

/// A preset as it is (0), or a scene drawn around it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Case {
    preset: &'static str,
    draw: usize,
    nodes: usize,
}

/// A run of a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Way {
    /// On the ladder, as users run it.
    Answer,
    /// On a mesh twice as fine from its start.
    Finer,
    /// On that, and longer.
    Longer,
}

impl Way {
    const ALL: [Self; 3] = [Self::Answer, Self::Finer, Self::Longer];
}

impl Case {
    fn name(self) -> String {
        let Some(parts) = self.parts() else {
            return self.preset.to_owned();
        };
        let [slide_roll, load, speed, first, second] = parts.map(|part| figure(Some(part)));
        format!(
            "{}: S {slide_roll}, load × {load}, U × {speed}, A × {first}, {second}",
            self.preset
        )
    }

    /// S, and load, speed and amplitudes as parts of the preset's; `None`: it is the preset.
    fn parts(self) -> Option<[f64; 5]> {
        let fraction = |power: i32| (0.5 + self.draw as f64 * 1.1347_f64.powi(-power)).fract();
        let between = |power: i32, from: f64, to: f64| from * (to / from).powf(fraction(power));
        (self.draw > 0).then(|| {
            [
                1.6 * fraction(1),
                between(2, 0.5, 1.5),
                between(3, 0.4, 2.5),
                between(4, 0.4, 1.6),
                between(5, 0.4, 1.6),
            ]
        })
    }

    fn planned(self, way: Way) -> Result<(Scene, Plan), String> {
        let nodes = match way {
            Way::Answer => self.nodes,
            Way::Finer | Way::Longer => 2 * self.nodes - 1,
        };
        let mut sets = vec![format!("grid.nodes={nodes}"), "record=none".to_owned()];
        if way != Way::Answer {
            sets.extend(
                ["ladder=false", "error_estimate=none"].map(|set| format!("numerics.{set}")),
            );
        }
        let mut scene = scene_with(self.preset, &sets)?;
        if let Some([slide_roll, parts @ ..]) = self.parts() {
            Knob::SlideRoll.put(&mut scene, slide_roll);
            let knobs = [
                Knob::of_load(scene.kind()),
                Knob::EntrainmentMS,
                Knob::Amplitude1M,
                Knob::Amplitude2M,
            ];
            for (knob, part) in knobs.into_iter().zip(parts) {
                let value = part * knob.of(&scene);
                knob.put(&mut scene, value);
            }
        }
        let passages = match scene.kind() {
            ContactKind::Point => 1.0,
            ContactKind::Line => 3.0,
        };
        let longer = if way == Way::Longer { LONGER } else { 1.0 };
        scene.time.passages = Some(longer * passages);
        planned(scene)
    }

    fn run(self, way: Way) -> Result<Summary, String> {
        let (scene, plan) = self.planned(way)?;
        let scene = Arc::new(scene);
        let mut summary = climb(Arc::clone(&scene), plan.clone(), 1)?.summary;
        if way == Way::Answer {
            if summary.error_h_central_m.is_none() {
                let companion = Companion::start(&scene, &plan, 1);
                match companion.and_then(|companion| companion.compare(&mut summary)) {
                    Ok(_) | Err(NoEstimate::TooCoarse(_) | NoEstimate::Unresolved(_)) => {}
                    Err(reason) => return Err(reason.to_string()),
                }
            }
            let goes_on = AtomicBool::new(false);
            Assumed::Phase.vary(&scene, &plan, 1, &mut summary, &goes_on);
        }
        Ok(summary)
    }
}

/// What a case came to, each way.
#[derive(Debug, Clone)]
pub struct Banded {
    case: Case,
    answer: Summary,
    finer: Summary,
    longer: Summary,
}

/// A band and what it was to hold.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Held {
    is_inside: bool,
    /// Half of the band over what the answer is off by.
    width: f64,
}

impl Held {
    fn new(off: f64, half: f64, is_inside: bool) -> Self {
        let width = if off > 0.0 { half / off } else { f64::INFINITY };
        Self { is_inside, width }
    }
}

/// A number with an error, of a summary.
type Number = (
    &'static str,
    fn(&Summary) -> f64,
    fn(&Summary) -> Option<f64>,
);

const NUMBERS: [Number; 4] = [
    ("central film", |s| s.h_central_m, |s| s.error_h_central_m),
    ("least film", |s| s.h_min_m, |s| s.error_h_min_m),
    ("greatest pressure", |s| s.p_max_pa, |s| s.error_p_max_pa),
    (
        "friction",
        |s| s.friction_coefficient,
        |s| s.error_friction_coefficient,
    ),
];

impl Banded {
    /// Every mesh of the answer; that of a scene with one alone too.
    fn rungs(&self) -> Vec<Rung> {
        let mut rungs = self.answer.rungs.clone();
        rungs.pop();
        // The last has what only the whole answer knows.
        rungs.push(Rung {
            nodes: self.case.nodes,
            life_relative: self.answer.life_relative,
            life_relative_low: self.answer.life_relative_low,
            life_relative_high: self.answer.life_relative_high,
            seconds: self.answer.wall_s,
        });
        rungs
    }

    /// Life of a mesh against the finer and longer run; `None`: it has none, or no band.
    fn life(&self, rung: &Rung) -> Option<Held> {
        let truth = self.longer.life_relative?;
        let (low, high) = rung.life_relative_low.zip(rung.life_relative_high)?;
        Some(Held::new(
            (rung.life_relative? / truth).ln().abs(),
            0.5 * (high / low).ln(),
            (low..=high).contains(&truth),
        ))
    }

    fn number(&self, (_, of, error): Number) -> Option<Held> {
        let (off, half) = (
            (of(&self.answer) - of(&self.finer)).abs(),
            error(&self.answer)?,
        );
        Some(Held::new(off, half, off <= half))
    }

    fn converged(&self) -> bool {
        [&self.answer, &self.finer, &self.longer]
            .iter()
            .all(|summary| summary.steps_not_converged == 0)
    }
}

/// How many are inside, of how many, and the median of their widths.
fn tally(held: impl Iterator<Item = Held>) -> (usize, usize, f64) {
    let held: Vec<Held> = held.collect();
    let mut widths: Vec<f64> = held.iter().map(|one| one.width).collect();
    widths.sort_by(f64::total_cmp);
    let inside = held.iter().filter(|one| one.is_inside).count();
    let median = widths.get(widths.len() / 2).copied().unwrap_or(f64::NAN);
    (inside, held.len(), median)
}

/// Of a quick study the lines; of a full one the presets that are too fine for coarse meshes, too, and all on finer ones. A drawn
/// scene that is refused is left out.
fn cases(extent: Extent, only: Option<&str>) -> Result<Vec<Case>, StudyError> {
    let (draws, times, most) = match extent {
        Extent::Quick => (0, 1, presets::all().len()),
        Extent::Usual => (3, 1, presets::all().len()),
        Extent::Full => (1, 2, presets::listed().len()),
    };
    let mut cases = Vec::new();
    for (index, preset) in presets::listed().take(most).enumerate() {
        let scene = scene_with(preset.name, &[]).map_err(StudyError::Scene)?;
        let (kind, is_coarse) = (scene.kind(), index < presets::all().len());
        // A line's nodes cost little.
        let intervals = match kind {
            ContactKind::Point => 64,
            ContactKind::Line => 128,
        };
        if extent == Extent::Quick && kind == ContactKind::Point {
            continue;
        }
        let nodes = if is_coarse {
            times * intervals + 1
        } else {
            scene.grid.nodes
        };
        let draws = if is_coarse { draws } else { 0 };
        let drawn = (1..=draws).map(|draw| index * draws + draw);
        cases.extend(std::iter::once(0).chain(drawn).map(|draw| Case {
            preset: preset.name,
            draw,
            nodes,
        }));
    }
    cases.retain(|case| {
        let is_accepted = || Way::ALL.iter().all(|&way| case.planned(way).is_ok());
        only.is_none_or(|only| case.preset.contains(only)) && (case.draw == 0 || is_accepted())
    });
    Ok(cases)
}

/// Runs those presets whose name holds `only` if that is given, so many runs at a time.
///
/// # Errors
/// [`StudyError`] when a run fails, or when none has that in its name.
pub fn bands(
    extent: Extent,
    only: Option<&str>,
    threads: usize,
    progress: &mut StudyProgress,
) -> Result<Vec<Banded>, StudyError> {
    let cases = cases(extent, only)?;
    refuse_nothing(only, cases.is_empty())?;
    let asked: Vec<(Case, Way)> = (cases.iter())
        .flat_map(|&case| Way::ALL.map(|way| (case, way)))
        .collect();
    let name = |(case, way): &(Case, Way)| format!("{}, {way:?}", case.name());
    let run = |&(case, way): &(Case, Way)| case.run(way);
    let found = run_all(&asked, threads, name, run, progress)?;
    let found = found.chunks_exact(Way::ALL.len());
    let one = |(&case, found): (&Case, &[Summary])| Banded {
        case,
        answer: found[0].clone(),
        finer: found[1].clone(),
        longer: found[2].clone(),
    };
    Ok(cases.iter().zip(found).map(one).collect())
}

/// The report.
pub fn bands_report(all: &[Banded]) -> Report {
    type Cell = fn(&Banded) -> String;
    let columns: [(&'static str, Cell); 6] = [
        ("case", |one| one.case.name()),
        ("life and band by mesh", |one| {
            let rung = |rung: &Rung| {
                let [life, low, high] = [
                    rung.life_relative,
                    rung.life_relative_low,
                    rung.life_relative_high,
                ]
                .map(figure);
                let missed = one.life(rung).is_some_and(|held| !held.is_inside);
                let mark = if missed { " missed" } else { "" };
                format!("{}: {life} ({low} to {high}){mark}", rung.nodes)
            };
            one.rungs().iter().map(rung).collect::<Vec<_>>().join("; ")
        }),
        ("finer", |one| figure(one.finer.life_relative)),
        ("finer and longer", |one| figure(one.longer.life_relative)),
        ("off over error: films, pressure, friction", |one| {
            let cell = |number| one.number(number).map(|held| 1.0 / held.width);
            NUMBERS.map(|number| figure(cell(number))).join(", ")
        }),
        ("seconds", |one| {
            let seconds = [&one.answer, &one.longer].map(|s| figure(Some(s.wall_s)));
            seconds.join(", ")
        }),
    ];
    let table = MarkdownTable::of(all, &columns);
    let first = || all.iter().filter_map(|one| one.life(one.rungs().first()?));
    let last = || all.iter().filter_map(|one| one.life(one.rungs().last()?));
    let mut lines = vec![
        ("life, first mesh", tally(first())),
        ("life, last mesh", tally(last())),
    ];
    lines.extend(NUMBERS.map(|number| {
        let held = all.iter().filter_map(|one| one.number(number));
        (number.0, tally(held))
    }));
    let passes = (lines.iter()).all(|(_, (inside, n, _))| *inside as f64 >= ASKED * *n as f64);
    let lines = lines.iter().map(|(name, (inside, n, width))| {
        format!(
            "- {name}: {inside} of {n} inside; half a band is {} times what the answer is off, at the median\n",
            figure(Some(*width))
        )
    });
    let lines: String = lines.collect();
    let unconverged = all.iter().filter(|one| !one.converged()).count();
    let text = format!(
        "{lines}\nAsked: 95 of 100 inside, 3 times at the median. {unconverged} of {} cases have steps that did not converge.\n\n{}",
        all.len(),
        table.markdown()
    );
    Report {
        title: "Bands",
        text,
        table,
        plots: Vec::new(),
        passes,
    }
}

#[cfg(test)]
#[expect(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn a_band_holds_what_lies_in_it() {
        let held = [(0.1, 0.2, true), (0.3, 0.1, false), (0.0, 0.1, true)]
            .map(|(off, half, is_inside)| Held::new(off, half, is_inside));
        let (inside, n, median) = tally(held.into_iter());
        assert_eq!((inside, n, median), (2, 3, 2.0));
        let one = |life: [f64; 3], truth: f64, film: [f64; 2]| Banded {
            case: Case {
                preset: "demonstration",
                draw: 0,
                nodes: 65,
            },
            answer: Summary {
                life_relative: Some(life[0]),
                life_relative_low: Some(life[1]),
                life_relative_high: Some(life[2]),
                h_central_m: film[0],
                error_h_central_m: Some(0.5),
                ..Summary::default()
            },
            finer: Summary {
                h_central_m: film[1],
                ..Summary::default()
            },
            longer: Summary {
                life_relative: Some(truth),
                ..Summary::default()
            },
        };
        // Off by a factor of 2 in a band of a factor of 4 either way; films off by .25 and 1 of .5.
        let good = one([1.0, 0.25, 4.0], 2.0, [1.0, 1.25]);
        let bad = one([1.0, 0.25, 4.0], 8.0, [1.0, 2.0]);
        let life = |one: &Banded| one.life(&one.rungs()[0]).unwrap();
        assert!(life(&good).is_inside && (life(&good).width - 2.0).abs() < 1e-12);
        assert!(!life(&bad).is_inside);
        let film = |one: &Banded| one.number(NUMBERS[0]).unwrap();
        assert!(film(&good).is_inside && (film(&good).width - 2.0).abs() < 1e-12);
        assert!(!film(&bad).is_inside);
        let report = bands_report(&[good, bad]);
        assert!(!report.passes);
        assert!(report.text.contains("life, last mesh: 1 of 2 inside"));
        assert!(report.table.rows[1][1].ends_with("missed"));
    }

    #[test]
    fn drawn_scenes_are_around_their_presets_and_every_preset_is_accepted() {
        let presets = [presets::all().len(), presets::listed().len()];
        let [usual, full] =
            [Extent::Usual, Extent::Full].map(|extent| cases(extent, None).unwrap());
        // Three scenes and one around each preset that coarse meshes carry.
        assert_eq!(usual.len(), 4 * presets[0]);
        assert_eq!(full.len(), presets[0] + presets[1]);
        for case in usual.iter().chain(&full) {
            let (scene, _) = case.planned(Way::Longer).unwrap();
            let (answer, _) = case.planned(Way::Answer).unwrap();
            assert_eq!(scene.grid.nodes, 2 * answer.grid.nodes - 1);
            assert_eq!(
                scene.time.most_passages(),
                LONGER * answer.time.most_passages()
            );
            let home = scene_with(case.preset, &[]).unwrap();
            let load = scene.force_n() / home.force_n();
            assert!((0.5..=1.5).contains(&load), "{}: {load}", case.name());
            assert_eq!(load == 1.0, case.draw == 0, "{}", case.name());
        }
    }
}
