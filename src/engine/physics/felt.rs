//! Whether a contact feels the crests that the formula counts.
//!
//! ```text
//! p_A = (π/2) E' A/W          pressure that flattens a wave of amplitude A and length W
//! w   = log10(p_A/p_h / 1e-4), from 0 to 1
//! w_n = (n_c − 1)/(0.1 (n − 1)), from 0 to 1      n_c: what is counted in the pressure of material points, once it is
//! n_w = 1 + w w_n (n − 1)     crests that are felt
//! ```
//! The formula n = 1 + f δ (`cycles.rs`) asks how many crests pass and not how high they are: a wave of 1e-15 m counts like one
//! of 1e-6. A wave presses no more than what flattens it; below a thousandth of Hertz's pressure that is less than the
//! life's own error, and w says so without a jump. Higher waves may still be too low for a point to be unloaded between
//! them: then the count of its pressure stays at 1, whatever the formula says.
//! Source: Johnson, Contact Mechanics, 1985, 13.2 (p_A).

/// Share of Hertz's pressure from which crests are felt.
pub const FELT: f64 = 1e-3;
/// Share below which nothing of them is.
const UNFELT: f64 = 1e-4;

/// How much a contact feels of crests that press that share of Hertz's pressure: 0 nothing, 1 all.
pub fn felt(share: f64) -> f64 {
    if share >= FELT {
        return 1.0;
    }
    if share <= UNFELT {
        return 0.0;
    }
    (share / UNFELT).log10() / (FELT / UNFELT).log10()
}

/// Share of the crests beyond the first that must be counted for all to be felt.
const COUNTED: f64 = 0.1;

/// Contacts beyond the first that a count over some tens of points can tell.
const TOLD: f64 = 1.0 / 64.0;

/// How much is felt of the crests of `n` contacts by formula where that many are counted at material points, 0 to 1;
/// 1 where a tenth of them is fewer than a count can tell.
pub fn felt_where_counted(n: f64, counted: f64) -> f64 {
    let of_crests = COUNTED * (n - 1.0);
    if of_crests >= TOLD {
        ((counted - 1.0) / of_crests).clamp(0.0, 1.0)
    } else {
        1.0
    }
}

/// Contacts of which only crests are felt that press so much: `weight` of them.
pub fn felt_contacts(n: f64, weight: f64) -> f64 {
    // What is felt whole is the formula's to the bit.
    if weight >= 1.0 {
        n
    } else {
        1.0 + weight * (n - 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_felt_grows_without_a_jump() {
        let mut before = felt(0.0);
        assert_eq!(before, 0.0);
        for step in 0..=8000 {
            let now = felt(1e-8 * 10_f64.powf(f64::from(step) / 1000.0));
            assert!((before..before + 1.1e-3).contains(&now), "{step}: {now}");
            before = now;
        }
        assert_eq!(before, 1.0);
        assert_eq!(felt_contacts(14.33, felt(FELT)), 14.33);
        assert_eq!(felt_contacts(14.33, 0.0), 1.0);
        let counted = [1.0, 1.1, 1.2, 2.9].map(|counted| felt_where_counted(3.0, counted));
        for (found, right) in counted.into_iter().zip([0.0, 0.5, 1.0, 1.0]) {
            assert!((found - right).abs() < 1e-12, "{counted:?}");
        }
        assert_eq!(felt_where_counted(1.1, 1.0), 1.0);
        assert_eq!(felt_where_counted(1.0, 1.0), 1.0);
    }
}
