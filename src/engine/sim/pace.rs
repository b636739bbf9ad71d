//! How long the next time step is.
//!
//! ```text
//! E_n     = 3 e_n                        what steps like this one add to the film while oil crosses
//! Δt_n+1  = Δt_n · 0.9 (tol/E_n)^0.35 (E_n−1/tol)^0.2           PI controller of an error of order 2
//! ```
//! e_n gathers the local error of BDF2 along the paths of the oil (`solve::history`), so E falls as Δt² and
//! the error that a run gathers is proportional to the tolerance. The factor 3 joins the mean over the nodes
//! under pressure to the error of the film in the centre; measured, true error over e_n, at 0.5, 1, 2 and 4
//! nodes: 2.0, 3.4, 3.8 and 4.9 for a thick smooth film, 1.9, 2.8, 3.1 and 3.5 for waves of 1 a that slide at
//! S = 1.
//!
//! A step whose E is above 1.2 tol is made again, smaller. Steps stay between 1/20 of a node and 4 nodes, grow
//! by at most 2 (variable BDF2 is stable up to 1 + √2), and never outrun the counting of cycles: 16 steps a
//! passing crest, or the scene's own `time.step_nodes` where that is longer. Source of the controller:
//! Gustafsson (1991), with the usual 0.7/k and 0.4/k, k = 2.

use serde::{Deserialize, Serialize};

use crate::saved::saved;

/// Error of the film in the centre over the mean that the formula gives.
const CENTRE: f64 = 3.0;
/// Shortest step, in nodes.
const LEAST: f64 = 0.05;
/// Longest step, in nodes.
const MOST: f64 = 4.0;
/// Excess over the tolerance that is not worth a second solution.
const SLACK: f64 = 1.2;
/// Most times that one step is made again.
const MOST_REJECTIONS: u32 = 4;

/// What the user asked of the time steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Stepping {
    /// Steps of so many nodes.
    Fixed(f64),
    /// Steps by the local error.
    Adaptive {
        /// Relative error of the film that time stepping may add over one crossing.
        tolerance: f64,
        /// First step, and shortest step that counting may enforce, in nodes.
        usual: f64,
    },
}

/// The controller's state.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Pace {
    /// Next step, in nodes.
    nodes: f64,
    /// E of the last step over the tolerance.
    last: Option<f64>,
}

saved! {
    Pace { free: nodes, last; }
    holds |_, saved| saved.nodes > 0.0 && saved.last.is_none_or(|last| last > 0.0)
}

/// What a step's error says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum StepTest {
    /// Keep it.
    Accepted,
    /// Make it again with so many nodes.
    Repeat(f64),
}

impl Stepping {
    /// Length of the first step, in nodes.
    pub(super) fn usual(self) -> f64 {
        match self {
            Self::Fixed(nodes) | Self::Adaptive { usual: nodes, .. } => nodes,
        }
    }

    /// Shortest step, in nodes.
    pub(super) fn least(self) -> f64 {
        match self {
            Self::Fixed(nodes) => nodes,
            Self::Adaptive { .. } => LEAST,
        }
    }

    /// E over the tolerance.
    fn excess(self, path_error: f64) -> Option<f64> {
        match self {
            Self::Fixed(_) => None,
            Self::Adaptive { tolerance, .. } => Some(CENTRE * path_error / tolerance),
        }
    }

    /// Whether a solved step is kept.
    pub(super) fn test_error(
        self,
        path_error: Option<f64>,
        nodes: f64,
        rejections: u32,
    ) -> StepTest {
        let excess = path_error.and_then(|error| self.excess(error));
        match excess {
            Some(excess) if excess > SLACK && nodes > LEAST && rejections < MOST_REJECTIONS => {
                let factor = (0.9 / excess.sqrt()).clamp(0.2, 0.9);
                StepTest::Repeat((nodes * factor).max(LEAST))
            }
            _ => StepTest::Accepted,
        }
    }
}

impl Pace {
    /// Before the first step.
    pub(super) fn new(stepping: Stepping) -> Self {
        Self {
            nodes: stepping.usual(),
            last: None,
        }
    }

    /// The next step, in nodes; `crest` is how many nodes of travel at U bring one crest past a material
    /// point.
    pub(super) fn next(&self, stepping: Stepping, crest: f64) -> f64 {
        match stepping {
            Stepping::Fixed(nodes) => nodes,
            Stepping::Adaptive { usual, .. } => self.nodes.min((crest / 16.0).max(usual)).min(MOST),
        }
    }

    /// Learns from a step that was kept.
    pub(super) fn learn(&mut self, stepping: Stepping, path_error: Option<f64>, nodes: f64) {
        let Some(excess) = path_error.and_then(|error| stepping.excess(error)) else {
            return;
        };
        let excess = excess.max(1e-6);
        let before = self.last.unwrap_or(excess);
        let factor = 0.9 * excess.powf(-0.35) * before.powf(0.2);
        self.nodes = (nodes * factor.clamp(0.2, 2.0)).clamp(LEAST, MOST);
        self.last = Some(excess);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ASKED: Stepping = Stepping::Adaptive {
        tolerance: 1e-3,
        usual: 1.0,
    };

    /// A problem whose error is `c nodes²`.
    fn settle(c: f64, steps: usize) -> (f64, u32) {
        let (mut pace, mut rejected) = (Pace::new(ASKED), 0);
        for _ in 0..steps {
            let mut nodes = pace.next(ASKED, f64::INFINITY);
            let mut again = 0;
            while let StepTest::Repeat(smaller) =
                ASKED.test_error(Some(c * nodes * nodes), nodes, again)
            {
                (nodes, again) = (smaller, again + 1);
            }
            rejected += again;
            pace.learn(ASKED, Some(c * nodes * nodes), nodes);
        }
        (pace.next(ASKED, f64::INFINITY), rejected)
    }

    #[test]
    fn the_step_settles_where_the_error_meets_the_tolerance() {
        for c in [1e-5, 1e-4, 1e-3, 1e-2] {
            let (nodes, rejected) = settle(c, 60);
            let excess = CENTRE * c * nodes * nodes / 1e-3;
            println!("c {c:e}: {nodes:.3} nodes, E/tol {excess:.2}, {rejected} rejected");
            assert!((0.4..1.05).contains(&excess) || nodes >= MOST, "{excess}");
            assert!(rejected <= 4);
        }
    }

    #[test]
    fn counting_bounds_the_step_and_fixed_steps_never_change() {
        let pace = Pace {
            nodes: 3.0,
            last: None,
        };
        assert_eq!(pace.next(ASKED, 32.0), 2.0);
        assert_eq!(pace.next(ASKED, 8.0), 1.0);
        let mut fixed = Pace::new(Stepping::Fixed(0.7));
        fixed.learn(Stepping::Fixed(0.7), Some(1.0), 0.7);
        assert_eq!(fixed.next(Stepping::Fixed(0.7), 1.0), 0.7);
        assert_eq!(
            Stepping::Fixed(0.7).test_error(Some(1.0), 0.7, 0),
            StepTest::Accepted
        );
    }
}
