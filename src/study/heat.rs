//! What heat does to friction, film and life of the presets that slide: each run cold, and warm with Roelands' thermal exponent at
//! what mineral oils have and at what it may be, beside what closed forms say before anything is run.
//!
//! ```text
//! warm     S0 = 1.1;  0.8 and 1.4 tell what the assumption does          bulk, oil and steel as `[heat]` has them by itself
//! before   `asperity check`: flash temperature after Blok with warm friction, film after Wilson & Sheu (1983)
//! ```

use std::sync::Arc;

use super::{
    Extent, MarkdownTable, Report, StudyError, StudyProgress, climb, figure, planned,
    refuse_nothing, run_all, scene_with,
};
use asperity_engine::plan::LeftHeat;
use asperity_engine::sim::Summary;

/// Presets that slide, each with S where its own is 0, and nodes of a quick and of a usual run.
const PRESETS: [(&str, Option<f64>, [usize; 2]); 11] = [
    ("twin_disc", None, [65, 129]),
    ("fzg_point_a", None, [129, 257]),
    ("fzg_point_b", None, [129, 257]),
    ("fzg_point_e", None, [129, 257]),
    ("cam_nose", None, [129, 257]),
    ("micropitting_rig", None, [65, 129]),
    ("mtm_ball_on_disc", None, [65, 129]),
    ("ball_on_glass", Some(0.5), [65, 129]),
    ("ball_bearing", None, [65, 129]),
    ("demonstration", Some(0.5), [65, 129]),
    ("random_rollers", Some(0.5), [65, 129]),
];
/// S0: none, what is taken, and its ends.
const EXPONENTS: [Option<f64>; 4] = [None, Some(1.1), Some(0.8), Some(1.4)];

/// A preset, and one of those.
#[derive(Debug, Clone, Copy)]
struct Asked {
    preset: &'static str,
    slide_roll: Option<f64>,
    nodes: usize,
    exponent: Option<f64>,
}

impl Asked {
    fn name(&self) -> String {
        let how = self
            .exponent
            .map_or_else(|| "cold".to_owned(), |s0| format!("S0 = {s0}"));
        format!("{}, {how}", self.preset)
    }

    fn run(&self) -> Result<Found, String> {
        let mut sets = vec![
            format!("grid.nodes={}", self.nodes),
            "record=none".to_owned(),
            "numerics.error_estimate=none".to_owned(),
        ];
        sets.extend(self.slide_roll.map(|s| format!("motion.slide_roll={s}")));
        sets.extend((self.exponent).map(|s0| format!("heat.viscosity_temperature_exponent={s0}")));
        let (scene, plan) = planned(scene_with(self.preset, &sets)?)?;
        let (before, slide_roll) = (LeftHeat::new(&scene, &plan), scene.motion.slide_roll);
        let finished = climb(Arc::new(scene), plan, 1)?;
        Ok(Found {
            before,
            slide_roll,
            summary: finished.summary,
        })
    }
}

/// What a run of it tells.
struct Found {
    before: Option<LeftHeat>,
    slide_roll: f64,
    summary: Summary,
}

/// A preset, cold and warm.
#[derive(Debug, Clone)]
pub struct Warmed {
    preset: &'static str,
    slide_roll: f64,
    /// What closed forms say of it.
    before: Option<LeftHeat>,
    /// Cold.
    pub cold: Summary,
    /// Warm, at what is taken, less and more.
    pub warm: [Summary; 3],
}

/// Runs those presets whose name holds `only` if that is given, so many runs at a time.
///
/// # Errors
/// [`StudyError`] when a run fails, or when none has that in its name.
pub fn heat(
    extent: Extent,
    only: Option<&str>,
    threads: usize,
    progress: &mut StudyProgress,
) -> Result<Vec<Warmed>, StudyError> {
    let mesh = usize::from(extent != Extent::Quick);
    let chosen = PRESETS
        .iter()
        .filter(|(preset, ..)| only.is_none_or(|only| preset.contains(only)));
    let asked = chosen.flat_map(|&(preset, slide_roll, nodes)| {
        EXPONENTS.map(|exponent| Asked {
            preset,
            slide_roll,
            nodes: nodes[mesh],
            exponent,
        })
    });
    let asked: Vec<Asked> = asked.collect();
    refuse_nothing(only, asked.is_empty())?;
    let found = run_all(&asked, threads, Asked::name, Asked::run, progress)?;
    let warmed = found
        .chunks_exact(EXPONENTS.len())
        .zip(asked.chunks_exact(EXPONENTS.len()));
    let one = |(found, asked): (&[Found], &[Asked])| Warmed {
        preset: asked[0].preset,
        slide_roll: found[0].slide_roll,
        before: found[0].before,
        cold: found[0].summary.clone(),
        warm: [1, 2, 3].map(|k| found[k].summary.clone()),
    };
    Ok(warmed.map(one).collect())
}

impl Warmed {
    /// A number cold, warm, and warm by the ends of S0.
    fn beside(&self, of: impl Fn(&Summary) -> Option<f64>) -> String {
        let [cold, warm, less, more] = [
            of(&self.cold),
            of(&self.warm[0]),
            of(&self.warm[1]),
            of(&self.warm[2]),
        ];
        let change = cold.zip(warm).filter(|(cold, _)| *cold != 0.0);
        let change = change.map_or_else(String::new, |(cold, warm)| {
            format!(" ({:+.0} %)", 100.0 * (warm / cold - 1.0))
        });
        format!(
            "{}, {}{change}; {} and {}",
            figure(cold),
            figure(warm),
            figure(less),
            figure(more)
        )
    }
}

/// The report.
pub fn heat_report(warmed: &[Warmed]) -> Report {
    type Cell = fn(&Warmed) -> String;
    let columns: [(&'static str, Cell); 11] = [
        ("preset", |w| w.preset.to_owned()),
        ("S", |w| figure(Some(w.slide_roll))),
        ("flash by check, K", |w| {
            figure(w.before.map(|b| b.flash_k[1]))
        }),
        ("Blok with the friction found, K", |w| {
            figure(w.warm[0].flash_temperature_blok_k)
        }),
        ("greatest found, K", |w| {
            figure(w.warm[0].flash_temperature_max_k)
        }),
        ("on average, K", |w| {
            figure(w.warm[0].flash_temperature_mean_k)
        }),
        ("oil at most, °C", |w| {
            figure(w.warm[0].film_temperature_max_k.map(|k| k - 273.15))
        }),
        ("film by Wilson & Sheu, Gupta et al., found", |w| {
            let warm = &w.warm[0];
            let found = Some(warm.h_central_m / w.cold.h_central_m);
            let said = [warm.inlet_heating_factor, warm.inlet_heating_factor_gupta];
            [said[0], said[1], found].map(figure).join(", ")
        }),
        ("friction", |w| w.beside(|s| Some(s.friction_coefficient))),
        ("life", |w| w.beside(|s| s.life_relative)),
        ("seconds", |w| {
            format!(
                "{}, {}",
                figure(Some(w.cold.wall_s)),
                figure(Some(w.warm[0].wall_s))
            )
        }),
    ];
    let table = MarkdownTable::of(warmed, &columns);
    let runs = || {
        warmed
            .iter()
            .flat_map(|w| std::iter::once(&w.cold).chain(&w.warm))
    };
    let unconverged = runs().filter(|s| !s.converged).count();
    let text = format!(
        "{}\nFriction and life: cold, warm with S0 = 1.1 and the change; with S0 = 0.8 and 1.4. Greatest temperatures are those of \
         asperities, formulas those of smooth surfaces. The bulk is at 80 °C; oil 0.14 W/(m K), 870 kg/m³, 2000 J/(kg K); \
         steel 46 W/(m K), 7850 kg/m³, 470 J/(kg K): values as handbooks have them (ball_on_glass: its disc is of glass, by its own values). {unconverged} of {} runs have steps that did \
         not converge.\n",
        table.markdown(),
        runs().count()
    );
    Report {
        title: "Heat",
        text,
        table,
        plots: Vec::new(),
        passes: unconverged == 0,
    }
}
