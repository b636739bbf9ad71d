//! How cycles enter the estimate.

use super::{EstimateBasis, OperatingPoint};
use crate::physics::cycles::{BodyId, Kinematics, miner_part};

/// How cycles enter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Count {
    /// Each contact as one, in own loading cycles.
    Contacts,
    /// Each by its damage, in loading cycles of the faster body.
    Damage,
}

impl EstimateBasis {
    /// Cycles of both bodies by their damage, in loading cycles of the faster, with pressure waves of these heights.
    pub(super) fn by_damage(&self, point: &OperatingPoint, waves: [f64; 2]) -> [f64; 2] {
        let zone_m = 2.0 * self.half_width_m * self.size_ratio(point.load_n);
        let kinematics = Kinematics::from_slide_roll(1.0, point.slide_roll, zone_m);
        let fastest = kinematics.u_1.abs().max(kinematics.u_2.abs());
        let c = self.law.stress_exponent;
        BodyId::BOTH.map(|body| {
            let mate = body.mate().index();
            let crests = [self.crests_1_per_m, self.crests_2_per_m][mate];
            let range = (2.0 * waves[mate] / (1.0 + waves[0] + waves[1])).min(1.0);
            let passing = crests * zone_m * kinematics.sliding() / fastest;
            kinematics.speed(body).abs() / fastest + passing * miner_part(c) * range.powf(c)
        })
    }
}
