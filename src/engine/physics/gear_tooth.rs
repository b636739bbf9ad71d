//! The outline of a spur gear's teeth while a pair of flanks is in contact.
//!
//! ```text
//! τ = (cos α_w, sin α_w)     T1 = −s_C τ     P(s) = T1 + s τ     O1 = (0, −r_w1)     O2 = (0, r_w2)
//! flank 1   O1 + D(−(s − ρ)/r_b1) (P(ρ) − O1)                    ρ from the base circle to √(r_a1² − r_b1²)
//! flank 2   O2 + D(+(s − s')/r_b2) (P(s') − O2),  s' = T1T2 − ρ  ρ from the base circle to √(r_a2² − r_b2²)
//! ```
//! Places are from the pitch point, the pinion (1) below, both going towards +x there; D turns counter-clockwise. Every
//! point of a flank is in contact once, at P(ρ), and turns with its gear: that is the involute. The other flank of a tooth
//! is its mirror image; a tooth is half a pitch thick on the working pitch circle and has a radial foot down to
//! 2.25 m below its tip, both for looking at alone: symbols as in [`super::gear`].

use super::gear::{GearTeeth, LineOfAction};

/// Points of a flank.
const POINTS: u32 = 14;
/// Depth of a tooth in modules.
const DEPTH: f64 = 2.25;

type GearPoint = [f64; 2];

impl GearTeeth {
    /// Direction in which the contact goes.
    fn along(&self) -> GearPoint {
        let angle = self.working_angle_rad();
        [angle.cos(), angle.sin()]
    }

    /// The contact at `place_m` from T1, from the pitch point, m.
    pub fn contact(&self, line: &LineOfAction, place_m: f64) -> GearPoint {
        self.along().map(|part| (place_m - line.c) * part)
    }

    /// Centre of gear 0 (pinion) or 1 (wheel), m.
    fn centre(&self, gear: usize) -> GearPoint {
        let pitch_m = self.base_radii_m()[gear] / self.working_angle_rad().cos();
        [0.0, if gear == 0 { -pitch_m } else { pitch_m }]
    }

    /// A point of the flank in contact with that radius of curvature, m.
    fn flank(&self, line: &LineOfAction, gear: usize, rho_m: f64, place_m: f64) -> GearPoint {
        let base_m = self.base_radii_m()[gear];
        // Where it is when it is in contact, and how far its gear has still to turn from there.
        let (met_m, turns) = if gear == 0 {
            (rho_m, -1.0)
        } else {
            (line.length - rho_m, 1.0)
        };
        let met = self.contact(line, met_m);
        turned(met, self.centre(gear), turns * (place_m - met_m) / base_m)
    }

    /// Outline of that many teeth of a gear to either side of the one in contact, m from the pitch point.
    pub fn outline(
        &self,
        line: &LineOfAction,
        gear: usize,
        place_m: f64,
        beside: i32,
    ) -> Vec<GearPoint> {
        let (centre, base_m) = (self.centre(gear), self.base_radii_m()[gear]);
        let tip_m = 0.5 * self.tip_diameters_m[gear];
        let root_m = (tip_m - DEPTH * self.module_m).max(0.2 * tip_m);
        let rho_of = |radius_m: f64| (radius_m * radius_m - base_m * base_m).max(0.0).sqrt();
        let (first, last) = (rho_of(root_m), rho_of(tip_m));
        let one: Vec<GearPoint> = (0..POINTS)
            .map(|k| first + (last - first) * f64::from(k) / f64::from(POINTS - 1))
            .map(|rho_m| self.flank(line, gear, rho_m, place_m))
            .collect();
        // The middle of the tooth at rest in the pitch point: a quarter of a pitch behind the pinion's flank, or before the
        // wheel's; from there it turns with the gear.
        let quarter = 0.5 * std::f64::consts::PI / f64::from(self.teeth[gear]);
        let up = if gear == 0 { 1.0 } else { -1.0 };
        let turn = -up * (place_m - line.c) / base_m;
        let axis = turned([0.0, up], [0.0; 2], quarter + turn);
        let mirrored = |at: &GearPoint| mirror(*at, centre, axis);
        let foot = |at: &GearPoint| {
            let [x, y] = [at[0] - centre[0], at[1] - centre[1]];
            let share = (root_m / x.hypot(y)).min(1.0);
            [centre[0] + share * x, centre[1] + share * y]
        };
        let mut tooth: Vec<GearPoint> = one.first().map(foot).into_iter().collect();
        tooth.extend(&one);
        tooth.extend(one.iter().rev().map(mirrored));
        tooth.extend(one.first().map(|at| foot(&mirrored(at))));
        let pitch = 4.0 * quarter;
        // From tooth to tooth in the sense in which a tooth itself is drawn: from its flank over its tip to its back.
        let teeth = -beside..=beside;
        teeth
            .flat_map(|k| {
                let turn = pitch * f64::from(k);
                tooth
                    .iter()
                    .map(move |at| turned(*at, centre, turn))
                    .collect::<Vec<_>>()
            })
            .collect()
    }
}

/// Turned about a centre, counter-clockwise.
fn turned(at: GearPoint, centre: GearPoint, angle: f64) -> GearPoint {
    let [x, y] = [at[0] - centre[0], at[1] - centre[1]];
    let (sin, cos) = angle.sin_cos();
    [centre[0] + cos * x - sin * y, centre[1] + sin * x + cos * y]
}

/// Mirrored in the line through a centre along a unit vector.
fn mirror(at: GearPoint, centre: GearPoint, axis: GearPoint) -> GearPoint {
    let [x, y] = [at[0] - centre[0], at[1] - centre[1]];
    let along = 2.0 * (x * axis[0] + y * axis[1]);
    [
        centre[0] + along * axis[0] - x,
        centre[1] + along * axis[1] - y,
    ]
}

#[cfg(test)]
#[expect(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    fn fzg() -> (GearTeeth, LineOfAction) {
        let gear = GearTeeth::fzg_c();
        (gear, gear.line_of_action().unwrap())
    }

    fn distance(a: GearPoint, b: GearPoint) -> f64 {
        (a[0] - b[0]).hypot(a[1] - b[1])
    }

    #[test]
    fn both_flanks_go_through_the_contact_and_touch_there() {
        let (gear, line) = fzg();
        for k in 0..=8 {
            let s = line.a + (line.e - line.a) * f64::from(k) / 8.0;
            let contact = gear.contact(&line, s);
            for (body, rho) in [(0, s), (1, line.length - s)] {
                assert!(distance(gear.flank(&line, body, rho, s), contact) < 1e-12);
                // The flank's tangent is across the line of action, whatever the place: they touch and do not cut.
                let step = 1e-7;
                let [one, two] = [-step, step].map(|d| gear.flank(&line, body, rho + d, s));
                let tangent = [two[0] - one[0], two[1] - one[1]];
                let along = gear.along();
                let cosine =
                    (tangent[0] * along[0] + tangent[1] * along[1]) / tangent[0].hypot(tangent[1]);
                assert!(cosine.abs() < 1e-4, "{k} {body}: {cosine}");
            }
        }
    }

    #[test]
    fn flanks_are_involutes_of_their_base_circles() {
        let (gear, line) = fzg();
        let inv = |angle: f64| angle.tan() - angle;
        for body in [0, 1] {
            let (centre, base) = (gear.centre(body), gear.base_radii_m()[body]);
            let polar = |rho: f64| {
                let at = gear.flank(&line, body, rho, line.c);
                let [x, y] = [at[0] - centre[0], at[1] - centre[1]];
                (x.hypot(y), y.atan2(x))
            };
            let (_, foot) = polar(0.0);
            for rho in [2e-3, 9e-3, 18e-3] {
                let (radius, angle) = polar(rho);
                assert!((radius - rho.hypot(base)).abs() < 1e-12);
                let expected = inv((base / radius).acos());
                assert!(
                    ((angle - foot).abs() - expected).abs() < 1e-9,
                    "{body} {rho}"
                );
            }
        }
    }

    #[test]
    fn teeth_are_half_a_pitch_thick_and_do_not_run_into_each_other() {
        let (gear, line) = fzg();
        for k in 0..=6 {
            let s = line.a + (line.e - line.a) * f64::from(k) / 6.0;
            for body in [0, 1] {
                let outline = gear.outline(&line, body, s, 0);
                let n = outline.len();
                let centre = gear.centre(body);
                let angle = |at: GearPoint| (at[1] - centre[1]).atan2(at[0] - centre[0]);
                // At equal radii, flank and back, all within the tip circle.
                for i in 0..n / 2 {
                    let [one, two] = [outline[i], outline[n - 1 - i]];
                    assert!((distance(one, centre) - distance(two, centre)).abs() < 1e-12);
                    assert!(distance(one, centre) < 0.5 * gear.tip_diameters_m[body] + 1e-12);
                }
                let pitch_m = centre[1].abs();
                let at = (0..n / 2).min_by(|a, b| {
                    let off = |i: &usize| (distance(outline[*i], centre) - pitch_m).abs();
                    off(a).total_cmp(&off(b))
                });
                let at = at.unwrap();
                let thick = (angle(outline[at]) - angle(outline[n - 1 - at])).abs();
                let half = std::f64::consts::PI / f64::from(gear.teeth[body]);
                assert!((thick / half - 1.0).abs() < 0.15, "{body}: {thick} {half}");
            }
            // The pinion's tooth pushes from behind.
            let middle = |body| {
                let outline = gear.outline(&line, body, s, 0);
                outline.iter().map(|at| at[0]).sum::<f64>() / outline.len() as f64
            };
            assert!(middle(0) + 3e-3 < middle(1), "{k}");
        }
        assert_eq!(
            gear.outline(&line, 0, line.c, 1).len(),
            3 * gear.outline(&line, 0, line.c, 0).len()
        );
    }
}
