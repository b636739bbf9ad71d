//! The line y = 0 and the stress below it over the last round of what passes.
//!
//! ```text
//! line(w + round) = line(w)        within the drift of orbit.rs; a round is a whole number of fixed steps
//! ```
//! A material point crosses the contact in more than a round (the default scene's slower body in two), and a mean over points
//! waits for as many as a round has to end their crossings. But where the fields come back, what a point meets in the rounds to
//! come is what others met in this one: points move on through it, and nothing is solved for that.
//!
//! Ours. Memory is made with the first step of a round; steps after it allocate nothing.

use serde::{Deserialize, Serialize};

use crate::physics::cycles::BodyId;
use crate::saved::Saved;
use crate::solve::material::Line;

/// Numbers that are kept at most; of longer rounds none are.
const MOST: usize = 8 << 20;
/// Longest step, in a.
const LONGEST_STEP: f64 = 1.0;
/// Steps that no run makes.
const MOST_TAKEN: u64 = 1 << 52;

/// The steps of a round, the oldest overwritten first.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(super) struct LastRound {
    /// Nodes of the line, and depths: the scene's.
    size: (usize, usize),
    /// Steps of a round; 0: it is not kept.
    kept: usize,
    taken: u64,
    /// Distances of both bodies, a.
    travels: Vec<[f64; 2]>,
    /// A step's pressure, and each body's shear and effective stress.
    numbers: Vec<f32>,
}

impl LastRound {
    /// Of lines of so many nodes at so many depths.
    pub(super) fn new(nx: usize, depths: usize) -> Self {
        Self {
            size: (nx, depths),
            ..Self::default()
        }
    }

    /// Begins anew.
    pub(super) fn restart(&mut self) {
        self.taken = 0;
        self.travels.clear();
        self.numbers.clear();
    }

    /// Numbers of a step.
    fn width(&self) -> usize {
        let (nx, depths) = self.size;
        nx * (1 + 4 * depths)
    }

    /// Takes what lies below both bodies' line after a step over `travel`; `steps` make a round, `None`: no whole number does.
    pub(super) fn push(&mut self, steps: Option<usize>, travel: [f64; 2], lines: &[Line; 2]) {
        let width = self.width();
        let fits = |steps: &usize| steps * width <= MOST;
        let is_short = travel.iter().all(|travel| travel.abs() <= LONGEST_STEP);
        let steps = steps.filter(fits).filter(|_| is_short).unwrap_or(0);
        if steps != self.kept || self.taken == 0 {
            self.restart();
            self.kept = steps;
            self.travels.reserve_exact(steps);
            self.numbers.reserve_exact(steps * width);
        }
        if steps == 0 {
            return;
        }
        let [one, two] =
            lines.map(|line| [line.tau_xz, line.effective].map(Option::unwrap_or_default));
        let parts = std::iter::once(lines[0].pressure).chain(one).chain(two);
        if self.travels.len() < steps {
            self.travels.push(travel);
            for part in parts {
                self.numbers.extend_from_slice(part);
            }
        } else {
            let slot = self.slot(self.taken);
            self.travels[slot] = travel;
            let mut room = &mut self.numbers[slot * width..(slot + 1) * width];
            for part in parts {
                let (here, rest) = room.split_at_mut(part.len());
                here.copy_from_slice(part);
                room = rest;
            }
        }
        self.taken += 1;
    }

    fn slot(&self, n: u64) -> usize {
        (n % self.kept as u64) as usize
    }

    /// Its steps.
    pub(super) fn len(&self) -> usize {
        self.travels.len()
    }

    /// Whether a whole round has been seen.
    pub(super) fn is_whole(&self) -> bool {
        self.kept > 0 && self.taken >= self.kept as u64
    }

    /// The steps of the round, the oldest first: distances of both bodies, and the line below each; nodes `dx` apart, from
    /// `x_first` on.
    pub(super) fn steps(
        &self,
        (x_first, dx): (f64, f64),
    ) -> impl Iterator<Item = ([f64; 2], [Line<'_>; 2])> {
        let (nx, depths) = self.size;
        let width = self.width();
        (self.taken - self.travels.len() as u64..self.taken).map(move |n| {
            let slot = self.slot(n);
            let numbers = &self.numbers[slot * width..(slot + 1) * width];
            let (pressure, below) = numbers.split_at(nx);
            let lines = BodyId::BOTH.map(|body| {
                let own = &below[2 * body.index() * nx * depths..][..2 * nx * depths];
                let (tau_xz, effective) = own.split_at(nx * depths);
                Line {
                    x_first,
                    dx,
                    pressure,
                    tau_xz: Some(tau_xz),
                    effective: Some(effective),
                }
            });
            (self.travels[slot], lines)
        })
    }
}

impl Saved for LastRound {
    fn check(&self, saved: &Self) -> Result<(), String> {
        let travels = || saved.travels.iter().flatten();
        let fits = |all: usize| all <= MOST;
        let holds = (saved.size == self.size || saved.travels.is_empty())
            && saved.kept.checked_mul(self.width()).is_some_and(fits)
            && saved.taken <= MOST_TAKEN
            && saved.travels.len() as u64 == saved.taken.min(saved.kept as u64)
            && saved.numbers.len() == saved.travels.len() * self.width()
            && travels().all(|travel| travel.abs() <= LONGEST_STEP);
        if holds { Ok(()) } else { Err(String::new()) }
    }

    fn restore(&mut self, saved: &Self) {
        (self.kept, self.taken) = (saved.kept, saved.taken);
        self.travels.clone_from(&saved.travels);
        self.numbers.clone_from(&saved.numbers);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Shear and effective stress below body 1 and body 2.
    const BELOW: [[f32; 2]; 2] = [[0.1, 0.2], [0.3, 0.4]];

    /// Steps 0, 1, ... of a round of three, on two nodes at one depth; every number tells its step, what it is, and of which body.
    fn kept(count: u32) -> LastRound {
        let mut round = LastRound::new(2, 1);
        for n in 0..count {
            let pressure = [n as f32; 2];
            let below = BELOW.map(|parts| parts.map(|part| [n as f32 + part; 2]));
            let lines = [0, 1].map(|body: usize| Line {
                x_first: -1.0,
                dx: 2.0,
                pressure: &pressure,
                tau_xz: Some(&below[body][0]),
                effective: Some(&below[body][1]),
            });
            round.push(Some(3), [0.01 * f64::from(n), 0.0], &lines);
        }
        round
    }

    #[test]
    fn a_round_is_its_last_steps_in_their_order() {
        assert!(!kept(2).is_whole());
        for count in 3..8 {
            let round = kept(count);
            assert!(round.is_whole() && round.len() == 3);
            let steps: Vec<_> = round.steps((-1.0, 2.0)).collect();
            for (n, (travel, lines)) in (count - 3..count).zip(steps) {
                assert_eq!(travel, [0.01 * f64::from(n), 0.0]);
                for (line, parts) in lines.iter().zip(BELOW) {
                    let below = [line.tau_xz, line.effective].map(Option::unwrap_or_default);
                    assert_eq!(line.pressure, [n as f32; 2]);
                    assert_eq!(below, parts.map(|part| [n as f32 + part; 2]));
                }
            }
        }
    }

    #[test]
    fn what_has_no_whole_number_of_steps_or_too_many_is_not_kept() {
        let line = Line {
            x_first: 0.0,
            dx: 1.0,
            pressure: &[1.0, 1.0],
            tau_xz: None,
            effective: None,
        };
        for (steps, travel) in [(None, 0.1), (Some(MOST), 0.1), (Some(3), 2.0)] {
            let mut round = kept(3);
            round.push(steps, [travel, 0.0], &[line; 2]);
            assert!(!round.is_whole() && round.numbers.is_empty());
        }
    }

    #[test]
    fn a_state_that_no_run_leaves_is_refused() {
        let (own, good) = (LastRound::new(2, 1), kept(4));
        assert!(own.check(&good).is_ok() && own.check(&LastRound::default()).is_ok());
        let spoil = |spoil: fn(&mut LastRound)| {
            let mut saved = good.clone();
            spoil(&mut saved);
            saved
        };
        for saved in [
            spoil(|saved| saved.size = (1, 1)),
            spoil(|saved| saved.kept = usize::MAX),
            spoil(|saved| saved.kept = 0),
            spoil(|saved| saved.taken = u64::MAX),
            spoil(|saved| saved.travels[1] = [0.0, 1e300]),
            spoil(|saved| saved.numbers.truncate(7)),
        ] {
            assert!(own.check(&saved).is_err());
        }
    }
}
