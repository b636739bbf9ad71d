//! Where both bodies are, and what follows from their speeds.

use crate::physics::cycles::speed_ratios;
use serde::{Deserialize, Serialize};

use crate::math::grid::Grid;
use crate::saved::saved;

/// Distances travelled and the time since the last disturbance.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Travel {
    /// Distance of body 1 and 2, in a.
    pub(super) travelled: [f64; 2],
    /// Where both bodies were when the passage began; `None`: it has not begun.
    launched_at: Option<[f64; 2]>,
    /// Time (a/U) that must pass until a steady contact is steady again.
    unsettled: f64,
    /// Distances that the surfaces still have to be led beyond their own, in a, and over which time (a/U).
    lead: ([f64; 2], f64),
}

saved! {
    Travel { free: travelled, launched_at, unsettled, lead; }
    holds |_, saved| saved.unsettled >= 0.0 && saved.lead.1 >= 0.0
}

/// How far a body has come, in a.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct BodyTravel {
    /// Since the run began.
    pub(super) travelled: f64,
    /// Since the passage began; `None`: it has not.
    pub(super) in_passage: Option<f64>,
}

impl Travel {
    /// Bodies at their origin.
    pub(super) fn new() -> Self {
        Self {
            travelled: [0.0; 2],
            launched_at: None,
            unsettled: 0.0,
            lead: ([0.0; 2], 0.0),
        }
    }

    /// Moves both bodies by a step of `nodes` nodes at slide-to-roll ratio `s`.
    pub(super) fn travel(&mut self, grid: &Grid, nodes: f64, s: f64) {
        let dt = nodes * grid.dx;
        let [one, two] = speed_ratios(s);
        self.travelled[0] += one * dt;
        self.travelled[1] += two * dt;
        self.unsettled = (self.unsettled - dt).max(0.0);
        let (lead, over) = &mut self.lead;
        if *over > 0.0 {
            let share = (dt / *over).min(1.0);
            for (distance, lead) in self.travelled.iter_mut().zip(lead) {
                let moved = share * *lead;
                *distance += moved;
                *lead -= moved;
            }
            *over = (*over - dt).max(0.0);
        }
    }

    /// Leads the surfaces by so much (in a) beyond their own distances, evenly over a time `over` (a/U).
    pub(super) fn lead(&mut self, distances: [f64; 2], over: f64) {
        self.lead = (distances, over);
    }

    /// The passage begins: what stands on a body once is let go.
    pub(super) fn launch(&mut self) {
        self.launched_at = Some(self.travelled);
    }

    /// How far each body has come.
    pub(super) fn of_bodies(&self) -> [BodyTravel; 2] {
        [0, 1].map(|body: usize| BodyTravel {
            travelled: self.travelled[body],
            in_passage: self.launched_at.map(|at| self.travelled[body] - at[body]),
        })
    }

    /// Something changed: `time` (a/U) to be steady again.
    pub(super) fn disturb(&mut self, time: f64) {
        self.unsettled = time;
    }

    /// The contact is steady now.
    pub(super) fn flush(&mut self) {
        self.unsettled = 0.0;
    }

    /// Whether the contact has been flushed since the last disturbance; what rounding leaves is no time.
    pub(super) fn is_flushed(&self) -> bool {
        self.unsettled < 1e-9
    }
}
