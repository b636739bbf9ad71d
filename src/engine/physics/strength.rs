//! What hardened steel carries before it flows.
//!
//! ```text
//! H = 697 HV · 9.80665 MPa/HV = 6.84 GPa      hardness of 60 HRC
//! Y = H/3 = 2.28 GPa                          yield strength (von Mises)
//! ```
//! | symbol | meaning |
//! |---|---|
//! | H | mean pressure under a spot that flows freely: no asperity of the body carries more |
//! | Y | von Mises stress at which the body begins to flow |
//!
//! Rolling bearings and the flanks of case-hardened gears have 58 to 64 HRC (ISO 683-17; ISO 6336-5), 653 to 800 HV
//! by ASTM E140, table 1; 60 HRC is 697 HV (there, and in the table that ASTM A370 takes from it). H = 3Y: Tabor
//! (1951), *The Hardness of Metals*, Oxford; Tabor (1970, Rev. Phys. Technol. 1, 145) says about three for many
//! metals, less where a body gives way elastically, as hard steel does: Y = H/3 is then low, and the limit strict. A
//! smooth Hertz contact begins to flow at p_h = 1.6 Y = 3.6 GPa (Johnson 1985, §6.1), below the 4.2 GPa that ISO 76
//! allows a ball at rest, which leaves a dent of 1e-4 of its diameter. Work hardening, size effects and shakedown are
//! left out. Bodies that a scene gives a `hardness_pa` flow at their surface there (`solve/yielding.rs`); else H is a
//! limit of the elastic model, as Y always is.

/// Most that a body carries elastically.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strength {
    /// H, Pa.
    pub hardness_pa: f64,
    /// Y, Pa.
    pub yield_pa: f64,
}

/// Pa in one HV (kgf/mm²).
const PA_PER_HV: f64 = 9.806_65e6;
/// Young's moduli of steels, Pa.
const STEEL_PA: std::ops::RangeInclusive<f64> = 180e9..=230e9;

impl Strength {
    /// Of a body of that hardness.
    pub const fn of(hardness_pa: f64) -> Self {
        Self {
            hardness_pa,
            yield_pa: hardness_pa / 3.0,
        }
    }
}

/// Steel of 60 HRC.
pub const HARDENED_STEEL: Strength = Strength::of(697.0 * PA_PER_HV);

/// Strength of a body by its Young's modulus: that of hardened steel where it is a steel's. `None`: not steel, and a
/// modulus alone tells no strength (glass and aluminium have the same).
pub fn by_young(young_pa: f64) -> Option<Strength> {
    is_steel(young_pa).then_some(HARDENED_STEEL)
}

/// Whether a Young's modulus is that of a steel.
pub fn is_steel(young_pa: f64) -> bool {
    STEEL_PA.contains(&young_pa)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steel_is_known_and_glass_is_not() {
        let steel = by_young(206e9).expect("steel");
        assert!((steel.hardness_pa * 1e-9 - 6.84).abs() < 0.01);
        // Between the onset of yield below a smooth contact and ISO 76's 4.2 GPa there is little room.
        assert!((1.6 * steel.yield_pa * 1e-9 - 3.65).abs() < 0.01);
        assert_eq!(by_young(75e9), None);
    }
}
