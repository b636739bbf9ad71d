//! The life of a bearing's inner ring from the lives of its contacts round the loaded zone.
//!
//! ```text
//! 1/R = Z (1 + γ)/2 ∫ dψ/(2π N(ψ)),   γ = D/d_m        over the zone, by trapezia; beyond it no ball carries
//! hours = R N_0/(60 n),   N_0 = life_cycles/life_common
//! ```
//! A point of the ring turns under a load that stands: it meets Z (1 + γ)/2 balls a turn, each anywhere (outer ring at rest).
//! N is `life_common`, relative to N_0, the smooth contact of the sweep's base scene, and so is R. Source: Miner (1945) for the
//! sum; kinematics of a ball bearing with contact angle 0 (Harris).

use super::path;
use super::spec::Sweep;
use super::table::Rows;

/// What turns under the balls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ring {
    /// Z (1 + γ)/2.
    pub(super) balls_a_turn: f64,
    /// n, 1/min.
    pub(super) speed_rpm: f64,
}

/// Its life.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RingLife {
    /// R over the loading cycles of the base scene's smooth contact.
    pub turns: f64,
    /// `None`: lives are relative.
    pub hours: Option<f64>,
}

impl Rows {
    /// The inner ring's life; `None`: the sweep goes round no race, or a case has no life.
    pub fn ring(&self, sweep: &Sweep) -> Option<RingLife> {
        let ring = sweep.ring?;
        let angles = path::column(&sweep.path, "path_deg")?;
        let lives = self.column(sweep, "life_common")?;
        let damage = |k: usize| 1.0 / lives[k];
        let pieces = (1..angles.len())
            .map(|k| 0.5 * (angles[k] - angles[k - 1]) / 360.0 * (damage(k - 1) + damage(k)));
        let turns = 1.0 / (ring.balls_a_turn * pieces.sum::<f64>());
        let smooth = (0..lives.len()).find_map(|case| self.smooth_cycles(case));
        turns.is_finite().then(|| RingLife {
            turns,
            hours: smooth.map(|cycles| turns * cycles / (60.0 * ring.speed_rpm)),
        })
    }
}
