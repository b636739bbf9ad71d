//! A tooth's flank under all that a pair of gears carries: the life of each place of both flanks, in turns of the pinion and in
//! hours.
//!
//! ```text
//! own      N_i  = life_i load_factor (U_i/U_fast where lives are in loading cycles of the faster body)
//! turns    R_1  = N_1,   R_2 = N_2 z_2/z_1                     a point of a flank meets its mate once a turn of its gear
//! Miner    1/R  = Σ f_k/R_k,   f_k = t_k n_k/Σ t_k n_k         t_k: part of the time at n_k turns a minute
//! hours    R N_0/(60 Σ t_k n_k),   N_0 = life_cycles/life_common, that of the calibration point
//! ```
//! Lives are relative to N_0, that of the smooth contact of the sweep's base scene, and so are R; N_0 needs a calibration
//! point. Source: Palmgren (1924) and Miner (1945) for the sum.

use std::ops::Range;

use super::path;
use super::spec::Sweep;
use super::table::Rows;
use crate::cells::{Cells, csv_line};
use asperity_engine::scene::CycleBasis;

/// A place of both flanks.
#[derive(Debug, Clone, PartialEq)]
pub struct FlankLife {
    /// Distance along the line of action from A, m.
    pub path_m: f64,
    /// R of pinion and wheel over the loading cycles of the base scene's smooth contact; `None`: a case has no life.
    pub turns: [Option<f64>; 2],
    /// The lesser one's; `None`: lives are relative.
    pub hours: Option<f64>,
    /// What each load takes of the shorter life; they make 1.
    pub shares: Vec<f64>,
}

impl FlankLife {
    /// The flank with the shorter life, 0 the pinion's, and its R.
    pub fn weaker(&self) -> Option<(usize, f64)> {
        let known = [0, 1].map(|flank| Some((flank, self.turns[flank]?)));
        known
            .into_iter()
            .flatten()
            .min_by(|a, b| a.1.total_cmp(&b.1))
    }
}

impl Sweep {
    /// The cases of each load along a tooth; all of them where there is one.
    pub fn loads(&self) -> Vec<Range<usize>> {
        let way = path::column(&self.path, "path_m").unwrap_or_default();
        let begins = |case: &usize| {
            case.checked_sub(1)
                .is_none_or(|last| way[*case] < way[last])
        };
        let mut starts: Vec<usize> = (0..way.len()).filter(begins).collect();
        if starts.is_empty() {
            starts.push(0);
        }
        let ends = starts.iter().skip(1).copied().chain([self.len()]);
        let ends: Vec<usize> = ends.collect();
        starts
            .into_iter()
            .zip(ends)
            .map(|(from, to)| from..to)
            .collect()
    }
}

impl Rows {
    /// The life of every place of both flanks; empty: the sweep goes along no tooth, or its scene asks for no life.
    pub fn flank(&self, sweep: &Sweep) -> Vec<FlankLife> {
        let Some(tooth) = sweep.tooth else {
            return Vec::new();
        };
        let column = |name: &str| self.column(sweep, name).unwrap_or_default();
        let loads = sweep.loads();
        let [way, speed, share] = ["path_m", "speed_rpm", "time_share"].map(column);
        let speeds_m_s = ["u_1_m_s", "u_2_m_s"].map(column);
        let life = sweep.base_scene().ok().and_then(|scene| scene.life);
        let Some(life) = life else {
            return Vec::new();
        };
        let lives = ["life_body_1", "life_body_2"].map(column);
        let load_factor = column("load_factor");
        // A body's own loading cycles over those in which its life is counted.
        let own = |case: usize, body: usize| match life.cycles {
            CycleBasis::Damage => {
                let [one, two] = [speeds_m_s[0][case], speeds_m_s[1][case]];
                [one, two][body] / one.max(two)
            }
            CycleBasis::Global | CycleBasis::Peaks => 1.0,
        };
        // Of one load, whatever its own columns are called.
        let at = |list: &[f64], case: usize, usual: f64| list.get(case).copied().unwrap_or(usual);
        let pace = |case: usize| at(&share, case, 1.0) * at(&speed, case, tooth.speed_rpm);
        let pace_of_all: f64 = loads.iter().map(|load| pace(load.start)).sum();
        let ratio = f64::from(tooth.wheel_teeth) / f64::from(tooth.pinion_teeth);
        let of_place = |k: usize| {
            let cases: Vec<usize> = loads.iter().map(|load| load.start + k).collect();
            // What a turn of the pinion takes, by each load.
            let taken = [0, 1].map(|flank: usize| -> Vec<f64> {
                let turns = |case: usize| {
                    let cycles = lives[flank][case] * load_factor[case] * own(case, flank);
                    [1.0, ratio][flank] * cycles
                };
                let part = |&case: &usize| pace(case) / pace_of_all / turns(case);
                cases.iter().map(part).collect()
            });
            let turns = |list: &Vec<f64>| Some(1.0 / list.iter().sum::<f64>());
            let mut life = FlankLife {
                path_m: way[cases[0]],
                turns: taken
                    .each_ref()
                    .map(|list| turns(list).filter(|turns| !turns.is_nan())),
                hours: None,
                shares: Vec::new(),
            };
            if let Some((flank, turns)) = life.weaker() {
                life.shares = taken[flank].iter().map(|part| part * turns).collect();
                let smooth = cases.iter().find_map(|&case| self.smooth_cycles(case));
                life.hours = smooth.map(|cycles| turns * cycles / (60.0 * pace_of_all));
            }
            life
        };
        let found: Vec<FlankLife> = (0..loads[0].len()).map(of_place).collect();
        let is_known = found.iter().any(|place| place.weaker().is_some());
        if is_known { found } else { Vec::new() }
    }

    /// N_0.
    pub(super) fn smooth_cycles(&self, case: usize) -> Option<f64> {
        let found = &self.records[case].summary;
        Some(found.life_cycles? / found.life_common?)
    }

    /// A table of it, one row a place: relative turns of the pinion that both flanks stand, hours, and what each load takes;
    /// `None` as [`Rows::flank`] is empty.
    pub fn flank_csv(&self, sweep: &Sweep) -> Option<String> {
        let places = self.flank(sweep);
        let loads = sweep.loads().len();
        places.first()?;
        let own = ["path_m", "turns_pinion", "turns_wheel", "hours"].map(str::to_owned);
        let head = own
            .into_iter()
            .chain((1..=loads).map(|k| format!("damage_share_{k}")));
        let mut text = csv_line(head);
        let mut row = Cells::default();
        for place in places {
            row.clear();
            row.number(place.path_m);
            for turns in place.turns {
                row.optional(turns);
            }
            row.optional(place.hours);
            for k in 0..loads {
                row.optional(place.shares.get(k).copied());
            }
            text.push_str(&csv_line(row.iter()));
        }
        Some(text)
    }
}
