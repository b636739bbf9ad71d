//! The tooth of a gear that a contact rides along.

use serde::{Deserialize, Serialize};

use crate::physics::gear::{GearTeeth, LineOfAction};

/// Turns a minute in rad/s.
const RPM: f64 = std::f64::consts::PI / 30.0;

/// `[tooth]`: the tooth of a gear along which events move the contact.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tooth {
    /// Teeth of the pinion, body 1, which drives.
    pub pinion_teeth: u32,
    /// Teeth of the wheel, body 2.
    pub wheel_teeth: u32,
    /// Module, m.
    pub module_m: f64,
    /// Pressure angle of the rack, degrees.
    pub pressure_angle_deg: f64,
    /// Centre distance, m.
    pub centre_distance_m: f64,
    /// Tip diameter of the pinion, m.
    pub pinion_tip_diameter_m: f64,
    /// Tip diameter of the wheel, m.
    pub wheel_tip_diameter_m: f64,
    /// Speed of the pinion, 1/min.
    pub speed_rpm: f64,
}

impl Tooth {
    /// That of a pair of gears whose pinion turns with that speed (rad/s).
    pub fn of(gears: &GearTeeth, speed_rad_s: f64) -> Self {
        let [pinion_teeth, wheel_teeth] = gears.teeth;
        let [pinion_tip_diameter_m, wheel_tip_diameter_m] = gears.tip_diameters_m;
        Self {
            pinion_teeth,
            wheel_teeth,
            module_m: gears.module_m,
            pressure_angle_deg: gears.pressure_angle_rad.to_degrees(),
            centre_distance_m: gears.centre_distance_m,
            pinion_tip_diameter_m,
            wheel_tip_diameter_m,
            speed_rpm: speed_rad_s / RPM,
        }
    }

    /// The gears.
    pub fn gears(&self) -> GearTeeth {
        GearTeeth {
            teeth: [self.pinion_teeth, self.wheel_teeth],
            module_m: self.module_m,
            pressure_angle_rad: self.pressure_angle_deg.to_radians(),
            centre_distance_m: self.centre_distance_m,
            tip_diameters_m: [self.pinion_tip_diameter_m, self.wheel_tip_diameter_m],
        }
    }

    /// Place of the contact on the line of action from T1 at a time after its beginning (s), m: it goes as fast as the
    /// pinion's base circle turns.
    pub fn place_m(&self, line: &LineOfAction, time_s: f64) -> f64 {
        line.a + self.gears().base_radii_m()[0] * RPM * self.speed_rpm * time_s
    }
}

#[cfg(test)]
#[expect(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn the_contact_is_where_the_paths_times_say() {
        let gears = GearTeeth::fzg_c();
        let tooth = Tooth::of(&gears, 1500.0 * RPM);
        let there = tooth.gears();
        assert_eq!((there.teeth, there.module_m), (gears.teeth, gears.module_m));
        let line = tooth.gears().line_of_action().unwrap();
        assert!((tooth.place_m(&line, 0.0) - line.a).abs() < 1e-15);
        // Rolling without sliding: the pitch point's speed is that of the base circles along the line of action.
        let way = tooth.place_m(&line, 1e-3) - line.a;
        let speed = 1500.0 * RPM * 0.5 * 16.0 * 4.5e-3 * 20_f64.to_radians().cos();
        assert!((way / (1e-3 * speed) - 1.0).abs() < 1e-12);
    }
}
