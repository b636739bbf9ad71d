//! A pair of involute spur gears along its line of action.
//!
//! ```text
//! r_b = m z cos α / 2          cos α_w = (r_b1 + r_b2)/a          T1T2 = a sin α_w          p_b = π m cos α
//! A     s_A = T1T2 − √(r_a2² − r_b2²)      the wheel's tip meets the pinion's root: contact begins
//! B     s_B = s_E − p_b                    the pair before parts: one pair carries all
//! C     s_C = r_b1 tan α_w                 pitch point: S = 0
//! D     s_D = s_A + p_b                    the next pair meets
//! E     s_E = √(r_a1² − r_b1²)             the pinion's tip leaves: contact ends
//! ρ_1 = s,   ρ_2 = T1T2 − s,   R = ρ_1 ρ_2/(ρ_1 + ρ_2),   U_i = ω_i ρ_i,   ω_2 = ω_1 z_1/z_2
//! w   = share(s) T_1/(r_b1 b)
//! ```
//! | symbol | meaning | unit |
//! |---|---|---|
//! | s | place on the line of action from the tangent point T1 | m |
//! | m, α, a | module, pressure angle of the rack, centre distance | m, rad, m |
//! | r_a, r_b | tip and base radius | m |
//! | ρ, R | radius of curvature of a flank, equivalent radius | m |
//! | T_1, b, w | torque of the pinion, face width, load per length | N m, m, N/m |
//!
//! The pinion (1) drives. S = (U_2 − U_1)/U is above 0 in its dedendum, below 0 in its addendum. Profile shifts
//! enter through the centre distance and the tip circles alone. Source: the involute's own geometry, as in any
//! text on gears; the symbols of the points are those of the FZG test (ISO 14635-1). How two pairs share the
//! load is an assumption that the user chooses ([`LoadSharing`]).

use std::f64::consts::PI;

/// How two pairs of teeth in contact share the load.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LoadSharing {
    /// Every pair carries all of it: the bound.
    Whole,
    /// Half where two pairs are in contact (A to B, D to E).
    Half,
    /// From 1/3 at A to 2/3 at B and back from D to E: linear, for equal stiffness and no relief.
    Trapezoid,
}

/// The teeth of a pair of spur gears.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GearTeeth {
    /// Teeth of pinion and wheel.
    pub teeth: [u32; 2],
    /// Module, m.
    pub module_m: f64,
    /// Pressure angle of the rack, rad.
    pub pressure_angle_rad: f64,
    /// Centre distance, m.
    pub centre_distance_m: f64,
    /// Tip diameters, m.
    pub tip_diameters_m: [f64; 2],
}

/// A pair of spur gears under load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GearPair {
    /// Their teeth.
    pub gears: GearTeeth,
    /// Face width, m.
    pub face_width_m: f64,
    /// Torque of the pinion, N m.
    pub torque_n_m: f64,
    /// Angular speed of the pinion, rad/s.
    pub speed_rad_s: f64,
    /// How two pairs share the load.
    pub load_sharing: LoadSharing,
}

/// Places of the line of action, from T1, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineOfAction {
    /// Contact begins.
    pub a: f64,
    /// One pair alone from here.
    pub b: f64,
    /// Pitch point.
    pub c: f64,
    /// One pair alone up to here.
    pub d: f64,
    /// Contact ends.
    pub e: f64,
    /// Length T1T2.
    pub length: f64,
}

/// The contact at a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mesh {
    /// Place on the line of action from T1, m.
    pub place_m: f64,
    /// Radii of curvature of both flanks, m.
    pub radii_m: [f64; 2],
    /// Surface speeds relative to the contact, m/s.
    pub speeds_m_s: [f64; 2],
    /// Part of the load that this pair carries.
    pub share: f64,
    /// Load per length, N/m.
    pub load_n_per_m: f64,
}

impl Mesh {
    /// R = ρ1 ρ2/(ρ1 + ρ2), m.
    pub fn radius_m(&self) -> f64 {
        let [one, two] = self.radii_m;
        one * two / (one + two)
    }

    /// U = (U1 + U2)/2, m/s.
    pub fn entrainment_m_s(&self) -> f64 {
        0.5 * (self.speeds_m_s[0] + self.speeds_m_s[1])
    }

    /// S = (U2 − U1)/U.
    pub fn slide_roll(&self) -> f64 {
        (self.speeds_m_s[1] - self.speeds_m_s[0]) / self.entrainment_m_s()
    }
}

impl GearTeeth {
    /// FZG type C, ISO 14635-1.
    #[cfg(test)]
    pub fn fzg_c() -> Self {
        Self {
            teeth: [16, 24],
            module_m: 4.5e-3,
            pressure_angle_rad: 20_f64.to_radians(),
            centre_distance_m: 91.5e-3,
            tip_diameters_m: [82.46e-3, 118.36e-3],
        }
    }

    /// What [`GearTeeth::line_of_action`] asks for, in words.
    pub const MESHING: &'static str = "teeth that mesh: base circles apart, tips between them and the tangent points, contact ratio 1 to 2";

    /// Base radii, m.
    pub fn base_radii_m(&self) -> [f64; 2] {
        let per_tooth = 0.5 * self.module_m * self.pressure_angle_rad.cos();
        self.teeth.map(|z| per_tooth * f64::from(z))
    }

    /// Working pressure angle, rad; NaN where the base circles overlap.
    pub fn working_angle_rad(&self) -> f64 {
        let [one, two] = self.base_radii_m();
        ((one + two) / self.centre_distance_m).acos()
    }

    /// p_b, m.
    pub fn base_pitch_m(&self) -> f64 {
        PI * self.module_m * self.pressure_angle_rad.cos()
    }

    /// The line of action; `None` where the teeth do not mesh: base circles that overlap, tips inside them or
    /// beyond the tangent points (interference), or a contact ratio outside of 1 to 2.
    pub fn line_of_action(&self) -> Option<LineOfAction> {
        let angle = self.working_angle_rad();
        let base = self.base_radii_m();
        let reach = |i: usize| (0.25 * self.tip_diameters_m[i].powi(2) - base[i].powi(2)).sqrt();
        let length = self.centre_distance_m * angle.sin();
        let pitch = self.base_pitch_m();
        let (a, e) = (length - reach(1), reach(0));
        let meshes = a > 0.0 && e < length && (1.0..2.0).contains(&((e - a) / pitch));
        meshes.then(|| LineOfAction {
            a,
            b: e - pitch,
            c: base[0] * angle.tan(),
            d: a + pitch,
            e,
            length,
        })
    }

    /// Contact ratio; `None` as [`GearTeeth::line_of_action`].
    pub fn contact_ratio(&self) -> Option<f64> {
        let line = self.line_of_action()?;
        Some((line.e - line.a) / self.base_pitch_m())
    }
}

impl GearPair {
    /// The contact at `place_m` from T1, between A and E.
    pub fn at(&self, line: &LineOfAction, place_m: f64) -> Mesh {
        let radii_m = [place_m, line.length - place_m];
        let [z_1, z_2] = self.gears.teeth.map(f64::from);
        let speeds = [self.speed_rad_s, self.speed_rad_s * z_1 / z_2];
        let share = self.share(line, place_m);
        let force = self.torque_n_m / self.gears.base_radii_m()[0];
        Mesh {
            place_m,
            radii_m,
            speeds_m_s: [speeds[0] * radii_m[0], speeds[1] * radii_m[1]],
            share,
            load_n_per_m: share * force / self.face_width_m,
        }
    }

    /// Part of the load that the pair in contact at a place carries. At B and D itself it carries all.
    fn share(&self, line: &LineOfAction, place_m: f64) -> f64 {
        let alone = (line.b..=line.d).contains(&place_m);
        let ramp = |from: f64, to: f64| (1.0 + (place_m - from) / (to - from)) / 3.0;
        match self.load_sharing {
            LoadSharing::Whole => 1.0,
            _ if alone => 1.0,
            LoadSharing::Half => 0.5,
            LoadSharing::Trapezoid if place_m < line.b => ramp(line.a, line.b),
            LoadSharing::Trapezoid => ramp(line.e, line.d),
        }
    }
}

#[cfg(test)]
#[expect(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::physics::line::hertz_from_load;

    fn fzg(tip_diameters_m: [f64; 2]) -> GearPair {
        GearPair {
            gears: GearTeeth {
                tip_diameters_m,
                ..GearTeeth::fzg_c()
            },
            face_width_m: 14e-3,
            torque_n_m: 200.0,
            speed_rad_s: 1500.0 * PI / 30.0,
            load_sharing: LoadSharing::Half,
        }
    }

    #[test]
    fn fzg_type_c_has_its_published_geometry() {
        let gear = fzg([82.46e-3, 118.36e-3]);
        assert!((gear.gears.working_angle_rad().to_degrees() - 22.44).abs() < 0.005);
        // Working pitch diameters 73.2 and 109.8 mm.
        let pitch = gear
            .gears
            .base_radii_m()
            .map(|r| 2.0 * r / gear.gears.working_angle_rad().cos());
        assert!((pitch[0] - 73.2e-3).abs() < 1e-8 && (pitch[1] - 109.8e-3).abs() < 1e-8);
        // The centre distance is that of profile shifts 0.1817 and 0.1715: inv α_w = inv α + 2 tan α Σx/Σz.
        let inv = |angle: f64| angle.tan() - angle;
        let shift = (inv(gear.gears.working_angle_rad()) - inv(gear.gears.pressure_angle_rad))
            * 40.0
            / (2.0 * gear.gears.pressure_angle_rad.tan());
        assert!((shift - (0.1817 + 0.1715)).abs() < 2e-4, "{shift}");
        // Contact ratio 1.44 with tips of 82.46 and 118.36 mm; 1.46 without their shortening.
        assert!((gear.gears.contact_ratio().unwrap() - 1.44).abs() < 0.01);
    }

    #[test]
    fn full_length_teeth_give_the_lengths_of_the_literature() {
        // Tips m(z + 2 + 2x): AB/AC/AD/AE = 6.14/9.68/13.28/19.43 mm, T1T2 = 34.93 mm.
        let line = fzg([82.635e-3, 118.544e-3]).gears.line_of_action().unwrap();
        for (got, mm) in [
            (line.b - line.a, 6.14),
            (line.c - line.a, 9.68),
            (line.d - line.a, 13.28),
            (line.e - line.a, 19.43),
            (line.length, 34.93),
        ] {
            assert!((got * 1e3 - mm).abs() < 0.01, "{} {mm}", got * 1e3);
        }
    }

    #[test]
    fn the_pitch_point_rolls_at_1347_mpa() {
        let gear = fzg([82.46e-3, 118.36e-3]);
        let line = gear.gears.line_of_action().unwrap();
        let mesh = gear.at(&line, line.c);
        assert!(mesh.slide_roll().abs() < 1e-12);
        assert!((mesh.radius_m() - 8.38e-3).abs() < 0.01e-3);
        assert!((mesh.entrainment_m_s() - 2.19).abs() < 0.01);
        assert!((mesh.load_n_per_m - 4.22e5).abs() < 0.005e5);
        // E' = 226 GPa; 1 MPa is what the rounding of E' and of the torque leaves.
        let p = hertz_from_load(mesh.radius_m(), 226e9, mesh.load_n_per_m).p_max_pa;
        assert!((p - 1347e6).abs() < 1.5e6, "{p}");
    }

    #[test]
    fn curvatures_and_speeds_are_those_of_the_involute() {
        let gear = fzg([82.46e-3, 118.36e-3]);
        let line = gear.gears.line_of_action().unwrap();
        for k in 0..=10 {
            let place = line.a + (line.e - line.a) * f64::from(k) / 10.0;
            let mesh = gear.at(&line, place);
            let [one, two] = mesh.radii_m;
            assert!((one + two - line.length).abs() < 1e-15);
            // Specific sliding in closed form: S = 2 (u ρ2 − ρ1)/(u ρ2 + ρ1), u = z1/z2.
            let u = 16.0 / 24.0;
            let s = 2.0 * (u * two - one) / (u * two + one);
            assert!((mesh.slide_roll() - s).abs() < 1e-12);
            assert_eq!(mesh.slide_roll() > 0.0, place < line.c);
        }
    }

    #[test]
    fn two_pairs_carry_what_one_carries() {
        for load_sharing in [LoadSharing::Half, LoadSharing::Trapezoid] {
            let gear = GearPair {
                load_sharing,
                ..fzg([82.46e-3, 118.36e-3])
            };
            let line = gear.gears.line_of_action().unwrap();
            let pitch = gear.gears.base_pitch_m();
            for k in 1..10 {
                let place = line.a + (line.b - line.a) * f64::from(k) / 10.0;
                let both = gear.at(&line, place).share + gear.at(&line, place + pitch).share;
                assert!((both - 1.0).abs() < 1e-12, "{load_sharing:?} {place}");
            }
            assert_eq!(gear.at(&line, line.c).share, 1.0);
        }
    }

    #[test]
    fn teeth_that_do_not_mesh_are_refused() {
        let good = fzg([82.46e-3, 118.36e-3]).gears;
        for bad in [
            GearTeeth {
                centre_distance_m: 80e-3,
                ..good
            },
            GearTeeth {
                tip_diameters_m: [60e-3, 118.36e-3],
                ..good
            },
            GearTeeth {
                tip_diameters_m: [82.46e-3, 150e-3],
                ..good
            },
            GearTeeth {
                tip_diameters_m: [75e-3, 110e-3],
                ..good
            },
        ] {
            assert!(bad.line_of_action().is_none(), "{bad:?}");
        }
    }
}
