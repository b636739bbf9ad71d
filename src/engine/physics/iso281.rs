//! Life modification factor a_ISO of ISO 281:2007 for radial ball bearings, as a side comparison.
//!
//! ```text
//! a_ISO = 0.1 [1 − (2.5671 − C/κ^p)^0.83 (e_C C_u/P)^{1/3}]^{−9.3},   at most 50
//! 0.1 ≤ κ < 0.4: C = 2.2649, p = 0.054381;  0.4 ≤ κ < 1: C = 1.9987, p = 0.19087;  1 ≤ κ ≤ 4: p = 0.071739
//! κ ≈ Λ^1.3                                                    viscosity ratio from the film parameter
//! ```
//! | symbol | meaning |
//! |---|---|
//! | κ | viscosity ratio, 0.1 to 4 |
//! | e_C | contamination factor |
//! | C_u/P | fatigue load limit over equivalent load |
//!
//! It is never multiplied with a life from the simulated pressure: κ already holds the penalty of
//! roughness. Source: ISO 281:2007, equations (31) to (33) and annex A.

/// a_ISO of a radial ball bearing; `None` outside 0.1 ≤ κ (κ above 4 counts as 4) and `e_C C_u/P ≥ 0`.
pub fn a_iso_radial_ball(kappa: f64, contamination_load_ratio: f64) -> Option<f64> {
    /// Maximum value that the standard allows.
    const MOST: f64 = 50.0;
    if !kappa.is_finite() || kappa < 0.1 || !(0.0..=1e3).contains(&contamination_load_ratio) {
        return None;
    }
    let kappa = kappa.min(4.0);
    let (c, p) = if kappa < 0.4 {
        (2.2649, 0.054381)
    } else if kappa < 1.0 {
        (1.9987, 0.19087)
    } else {
        (1.9987, 0.071739)
    };
    let bracket =
        1.0 - (2.5671_f64 - c / kappa.powf(p)).powf(0.83) * contamination_load_ratio.cbrt();
    if bracket <= 0.0 {
        return Some(MOST);
    }
    Some((0.1 * bracket.powf(-9.3)).min(MOST))
}

/// κ from the film parameter Λ.
pub fn kappa_from_lambda(lambda: f64) -> f64 {
    lambda.powf(1.3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn worked_values() {
        for (kappa, expected) in [(0.2, 0.188), (1.0, 2.43), (4.0, 7.20)] {
            let a = a_iso_radial_ball(kappa, 0.1).unwrap_or(f64::NAN);
            println!("kappa {kappa}, e_C C_u/P 0.1: a_ISO = {a:.4}");
            assert!((a / expected - 1.0).abs() < 5e-3, "three digits: {a}");
        }
    }

    #[test]
    fn limits_of_the_standard() {
        assert_eq!(a_iso_radial_ball(4.0, 5.0), Some(50.0));
        assert_eq!(a_iso_radial_ball(9.0, 0.1), a_iso_radial_ball(4.0, 0.1));
        assert_eq!(a_iso_radial_ball(0.05, 0.1), None);
        assert_eq!(a_iso_radial_ball(f64::NAN, 0.1), None);
        assert_eq!(a_iso_radial_ball(1.0, -0.1), None);
        // No load limit at all: a tenth.
        assert!((a_iso_radial_ball(1.0, 0.0).unwrap_or(0.0) - 0.1).abs() < 1e-12);
    }
}
