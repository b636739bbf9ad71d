//! A ball on its way round an inner race, and a cam on a flat-faced follower.
//!
//! ```text
//! race    1/R_x = 2/D + 2/(d_m − D)     1/R_y = 2/D − 1/(f D)     U = ω d_m (1 − γ²)/4,  γ = D/d_m
//!         Q(ψ)  = Q_0 cos^{3/2} ψ        Q_0 = F_r/(Z J_r),  J_r = 0.2288
//! cam     s(θ)  = h/2 (1 + cos(π θ/β)),  θ from the nose
//!         R = r_b + s + s''     U_cam = ω R     U_follower = ω s''     w = (F_0 + k s + m ω² s'')/b
//! ```
//! | symbol | meaning |
//! |---|---|
//! | D, d_m, f, Z | ball and pitch diameter, groove radius over D, balls |
//! | ψ, F_r, Q | angle from the load's line, radial load, ball load |
//! | r_b, h, β | base radius, lift, half angle of the lift |
//! | F_0, k, m | preload, stiffness and moving mass of the follower |
//!
//! Race: outer ring at rest, contact angle 0, no clearance, rigid rings (Stribeck 1901; J_r(1/2) of a ball
//! bearing by Sjövall's integral, as tabled by Harris). Cam: the contact moves along the follower at ω s'', so
//! both surfaces move the same way only where s'' > 0, on the flank; round the nose they move against each
//! other (|S| > 2), which this program's steady entrainment does not cover.

use std::f64::consts::PI;

/// J_r(1/2) of point contacts: ∫ cos^{5/2} ψ dψ/2π over half a turn.
const STRIBECK: f64 = 0.2288;

/// A radially loaded ball bearing without clearance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BallRace {
    /// D, m.
    pub ball_diameter_m: f64,
    /// d_m, m.
    pub pitch_diameter_m: f64,
    /// f: groove radius over ball diameter, above 0.5.
    pub conformity: f64,
    /// Z.
    pub balls: u32,
    /// F_r, N.
    pub radial_load_n: f64,
    /// ω of the inner ring, rad/s.
    pub speed_rad_s: f64,
}

impl BallRace {
    /// Equivalent radii along and across the inner race, m.
    pub fn radii_m(&self) -> [f64; 2] {
        let ball = 2.0 / self.ball_diameter_m;
        let race = 2.0 / (self.pitch_diameter_m - self.ball_diameter_m);
        let groove = 1.0 / (self.conformity * self.ball_diameter_m);
        [1.0 / (ball + race), 1.0 / (ball - groove)]
    }

    /// Entrainment speed, m/s.
    pub fn entrainment_m_s(&self) -> f64 {
        let gamma = self.ball_diameter_m / self.pitch_diameter_m;
        0.25 * self.speed_rad_s * self.pitch_diameter_m * (1.0 - gamma * gamma)
    }

    /// Balls that a point of the inner ring meets in a turn of it: Z (1 + γ)/2.
    pub fn balls_a_turn(&self) -> f64 {
        let gamma = self.ball_diameter_m / self.pitch_diameter_m;
        0.5 * f64::from(self.balls) * (1.0 + gamma)
    }

    /// Load of the ball at an angle from the load's line, N; 0 beyond a quarter turn.
    pub fn load_n(&self, angle_rad: f64) -> f64 {
        let most = self.radial_load_n / (f64::from(self.balls) * STRIBECK);
        most * angle_rad.cos().max(0.0).powf(1.5)
    }
}

/// A cam with a harmonic lift on a flat-faced follower.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlatFollower {
    /// r_b, m.
    pub base_radius_m: f64,
    /// h, m.
    pub lift_m: f64,
    /// β, rad.
    pub half_angle_rad: f64,
    /// ω, rad/s.
    pub speed_rad_s: f64,
    /// F_0, N.
    pub preload_n: f64,
    /// k, N/m.
    pub stiffness_n_per_m: f64,
    /// m, kg.
    pub mass_kg: f64,
    /// b, m.
    pub width_m: f64,
}

/// The cam's contact at an angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CamContact {
    /// Lift, m.
    pub lift_m: f64,
    /// R, m: the cam's radius of curvature.
    pub radius_m: f64,
    /// Speeds of follower and cam relative to the contact, m/s.
    pub speeds_m_s: [f64; 2],
    /// Load per length, N/m.
    pub load_n_per_m: f64,
}

impl FlatFollower {
    /// The contact at an angle from the nose, rad, 0 to β.
    pub fn at(&self, angle_rad: f64) -> CamContact {
        let k = PI / self.half_angle_rad;
        let half = 0.5 * self.lift_m;
        let lift_m = half * (1.0 + (k * angle_rad).cos());
        let curve = -half * k * k * (k * angle_rad).cos();
        let radius_m = self.base_radius_m + lift_m + curve;
        let inertia = self.mass_kg * self.speed_rad_s * self.speed_rad_s * curve;
        let force = self.preload_n + self.stiffness_n_per_m * lift_m + inertia;
        CamContact {
            lift_m,
            radius_m,
            speeds_m_s: [self.speed_rad_s * curve, self.speed_rad_s * radius_m],
            load_n_per_m: force / self.width_m,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_6309_has_the_presets_numbers() {
        let race = BallRace {
            ball_diameter_m: 17.462e-3,
            pitch_diameter_m: 72.5e-3,
            conformity: 0.515,
            balls: 8,
            radial_load_n: 4521.0,
            speed_rad_s: 100.0 * PI,
        };
        let [rx, ry] = race.radii_m();
        assert!((rx - 6.63e-3).abs() < 0.01e-3 && (ry - 0.3).abs() < 0.002);
        assert!((race.entrainment_m_s() - 5.36).abs() < 0.01);
        assert!((race.load_n(0.0) - 2470.0).abs() < 1.0);
    }

    #[test]
    fn the_balls_carry_the_radial_load() {
        // Σ Q cos ψ over many balls is the load: the integral that J_r stands for, to its four digits.
        let race = BallRace {
            ball_diameter_m: 0.01,
            pitch_diameter_m: 0.05,
            conformity: 0.52,
            balls: 720,
            radial_load_n: 1000.0,
            speed_rad_s: 1.0,
        };
        let sum: f64 = (0..720)
            .map(|k| f64::from(k) * PI / 360.0)
            .map(|angle| race.load_n(angle) * angle.cos())
            .sum();
        assert!((sum - 1000.0).abs() < 0.5, "{sum}");
    }

    #[test]
    fn entrainment_and_curvature_of_a_cam_follow_its_lift() {
        let cam = FlatFollower {
            base_radius_m: 15e-3,
            lift_m: 8e-3,
            half_angle_rad: PI / 3.0,
            speed_rad_s: 100.0,
            preload_n: 200.0,
            stiffness_n_per_m: 3e4,
            mass_kg: 0.1,
            width_m: 12e-3,
        };
        // U = ω/2 (r_b + s + 2 s''), with s'' from differences of the lift.
        for k in 1..20 {
            let (angle, d) = (f64::from(k) * PI / 60.0, 1e-4);
            let lift = |a: f64| cam.at(a).lift_m;
            let curve = (lift(angle + d) - 2.0 * lift(angle) + lift(angle - d)) / (d * d);
            let at = cam.at(angle);
            let entrainment = 0.5 * (at.speeds_m_s[0] + at.speeds_m_s[1]);
            let known = 50.0 * (15e-3 + at.lift_m + 2.0 * curve);
            assert!(
                (entrainment - known).abs() < 1e-6 * 3.0,
                "{entrainment} {known}"
            );
            // Sliding is ω (r_b + s), whatever the curvature.
            let sliding = at.speeds_m_s[1] - at.speeds_m_s[0];
            assert!((sliding - 100.0 * (15e-3 + at.lift_m)).abs() < 1e-12);
        }
        // Round the nose both surfaces move against each other.
        assert!(cam.at(0.0).speeds_m_s[0] < 0.0);
    }
}
