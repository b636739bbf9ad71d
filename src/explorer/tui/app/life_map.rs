//! Lives over S and the load, or over S and the amplitudes: each row a curve along S, swept as the curve is.
//!
//! Rows are times what the scene has, not the knob: turning S, or the knob that the rows are of, leaves the map as it is. Lives
//! at other loads are compared as in a sweep's table, with one smooth contact, that at the scene's load:
//!
//! ```text
//! life = life_relative N_smooth(load)/N_smooth(load of the scene)
//! ```

use super::curve::{SAME_S, close, same_contact};
use super::data::Effect;
use super::state::App;
use crate::tui::dial::{Dial, DialState};
use crate::tui::kinds::Across;
use asperity_engine::sim::Knob;
use asperity_session::sweep::{Along, CurvePoint, Found, Varied};

/// Values of S, of the sign that the scene's has.
const COLUMNS: [f64; 6] = [0.0, 0.1, 0.25, 0.5, 1.0, 1.5];
/// Times what the scene has, from above.
const TIMES: [f64; 5] = [2.0, 1.4, 1.0, 0.7, 0.5];

/// What the map shows.
#[derive(Debug, Clone, PartialEq)]
pub struct LifeMap {
    /// What its rows are of.
    pub across: Across,
    /// S of its columns.
    pub columns: Vec<f64>,
    /// Of each row the times and the load, N (of a line N/m); of amplitudes the load is the knob's.
    pub rows: Vec<(f64, f64)>,
    /// Lives, a row after another; `None`: not known (yet).
    pub lives: Vec<Option<f64>>,
    /// Row and column that are nearest to where the knobs are going.
    pub here: (usize, usize),
}

impl App {
    /// Whether the scene has such a map: a life, and something to turn.
    pub(super) fn has_map(&self, across: Across) -> bool {
        let scene = &self.run.setup.scene;
        scene.life.is_some() && scene.age.is_none() && self.dials_of(across).next().is_some()
    }

    /// The knobs that a row turns.
    fn dials_of(&self, across: Across) -> impl Iterator<Item = &Dial> {
        let is_of = move |dial: &&Dial| match across {
            Across::Load => dial.knob.is_load(),
            Across::Amplitude => Knob::AMPLITUDES.contains(&dial.knob),
        };
        let lives = |dial: &&Dial| !matches!(dial.state, DialState::Dead(_)) && dial.home != 0.0;
        self.choice.dials.iter().filter(is_of).filter(lives)
    }

    fn columns(&self) -> Vec<f64> {
        let dial = (self.choice.dials.iter()).find(|dial| dial.knob == Knob::SlideRoll);
        let sign = dial.map_or(1.0, |dial| 1.0_f64.copysign(dial.home));
        let columns = COLUMNS.map(|s| if s == 0.0 { s } else { sign * s });
        let fits = |s: &f64| dial.is_some_and(|dial| (dial.min..=dial.max).contains(s));
        columns.into_iter().filter(fits).collect()
    }

    fn times(&self, across: Across) -> Vec<f64> {
        let fits = |times: &f64| {
            let mut dials = self.dials_of(across);
            dials.all(|dial| (dial.min..=dial.max).contains(&(times * dial.home)))
        };
        TIMES.into_iter().filter(fits).collect()
    }

    /// Where a cell is: at the knobs, but for S and what the rows are of.
    fn place(&self, across: Across, times: f64, slide_roll: f64) -> CurvePoint {
        let mut place = CurvePoint {
            slide_roll,
            ..self.aim()
        };
        for dial in self.dials_of(across) {
            match dial.knob {
                Knob::ForceN | Knob::ForceNPerM => place.load_n = times * dial.home,
                Knob::Amplitude1M => place.amplitude_m[0] = times * dial.home,
                Knob::Amplitude2M => place.amplitude_m[1] = times * dial.home,
                Knob::SlideRoll | Knob::EntrainmentMS => {}
            }
        }
        place
    }

    fn in_cell(&self, across: Across, times: f64, slide_roll: f64) -> Option<&Found> {
        let place = self.place(across, times, slide_roll);
        self.all_simulated().find(|found| {
            (found.at.slide_roll - slide_roll).abs() <= SAME_S
                && close(found.at.entrainment_m_s, place.entrainment_m_s, 1e-3)
                && same_contact(&found.at, &place)
        })
    }

    /// The map as far as it is known; nothing of it while a lesson asks what it would show.
    pub fn life_map(&self, across: Across) -> LifeMap {
        let (columns, times) = (self.columns(), self.times(across));
        let smooth = |times: f64| {
            let mut row = columns
                .iter()
                .filter_map(|s| self.in_cell(across, times, *s));
            row.find_map(|found| found.smooth)
        };
        let base = smooth(1.0);
        let life = |times: f64, s: f64| {
            let found = self.in_cell(across, times, s)?;
            let life = found.life.filter(|_| !self.is_asked())?[1];
            match across {
                Across::Load => Some(life * found.smooth? / base?),
                Across::Amplitude => Some(life),
            }
        };
        let cells = times
            .iter()
            .flat_map(|times| columns.iter().map(|s| life(*times, *s)));
        let at = self.dials_of(across).next();
        let now = at.map_or(1.0, |dial| dial.target / dial.home);
        let slide_roll = self.aim().slide_roll;
        LifeMap {
            lives: cells.collect(),
            here: (
                nearest(&times, |times| (times / now).ln()),
                nearest(&columns, |s| s - slide_roll),
            ),
            rows: (times.iter())
                .map(|times| (*times, self.place(across, *times, 0.0).load_n))
                .collect(),
            across,
            columns,
        }
    }

    /// Asks for the first row that lacks something, that of the scene first: what the others are compared with.
    pub(super) fn begin_row(&mut self, across: Across) -> Vec<Effect> {
        let mut rows = self.times(across);
        rows.sort_by(|one, two| one.ln().abs().total_cmp(&two.ln().abs()));
        for times in rows {
            let open = |s: &f64| {
                let known = self.in_cell(across, times, *s).is_some();
                !known && !self.lives.swept.contains(&[*s, times])
            };
            let values: Vec<f64> = self.columns().into_iter().filter(open).collect();
            if values.is_empty() {
                continue;
            }
            self.lives.swept.extend(values.iter().map(|s| [*s, times]));
            let mut scene = self.scene_now();
            for dial in self.dials_of(across) {
                // A knob where the scene has it leaves the scene's own words.
                let value = times * dial.home;
                if value != dial.target {
                    dial.knob.put(&mut scene, value);
                }
            }
            return self.order(Varied::Along(Along::SlideRoll), values, scene);
        }
        self.begin_otherwise()
    }

    /// Turns the knobs to a cell.
    pub(super) fn go_to_cell(&mut self, row: usize, column: usize) -> Vec<Effect> {
        let Some(across) = self.view.curve.across() else {
            return Vec::new();
        };
        let (columns, times) = (self.columns(), self.times(across));
        let (Some(s), Some(times)) = (columns.get(column), times.get(row)) else {
            return Vec::new();
        };
        let turns = self
            .dials_of(across)
            .map(|dial| (dial.knob, times * dial.home));
        let mut turns: Vec<_> = turns.collect();
        turns.push((Knob::SlideRoll, *s));
        let mut effects = Vec::new();
        for (knob, value) in turns {
            let dials = self.choice.dials.iter();
            let open = dials
                .enumerate()
                .find(|(_, dial)| dial.knob == knob && dial.target != value);
            if let Some((place, _)) = open {
                self.choice.chosen = place;
                effects.extend(self.set(place, value));
            }
        }
        effects
    }
}

/// The place of the value that is the least off.
fn nearest(values: &[f64], off: impl Fn(f64) -> f64) -> usize {
    let offs = values.iter().map(|value| off(*value).abs()).enumerate();
    offs.min_by(|one, two| one.1.total_cmp(&two.1))
        .map_or(0, |(place, _)| place)
}
