//! What a cut-off leaves of a surface's height and of its slope.
//!
//! ```text
//! Sq(W)² = Σ_{λ_k ≥ W} P_k,   Sdq_x(W)² = Σ_{λ_k ≥ W} (2π/λ_k)² P_k,   λ_k = n Δ/k
//! ```
//! P_k is the mean power of the rows ([`crate::math::spectrum`]), the map taken as it is (rows whose ends do not meet have power at
//! short waves, as 1/k²). Height sits in long waves, slope in short ones: a mesh that keeps all of Sq may keep half of Sdq.

use std::f64::consts::TAU;

use crate::math::spectrum::mean_power;

/// A cut-off and what it leaves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kept {
    /// W, m.
    pub wave_m: f64,
    /// Sq over that of the whole.
    pub height: f64,
    /// Root-mean-square slope along x over that of the whole.
    pub slope: f64,
}

/// Of rows of `nx` heights `pixel_m` apart, by cut-offs of a half, a quarter and so on of the length, as long as two pixels hold
/// them. Empty: nothing varies along x.
pub fn kept(nx: usize, heights: &[f64], pixel_m: f64) -> Vec<Kept> {
    let rows = heights.len() / nx.max(1);
    let power = mean_power(nx, rows, |j| heights[j * nx..(j + 1) * nx].iter().copied());
    let length_m = nx as f64 * pixel_m;
    let sums = |most: usize| {
        let waves = power.iter().enumerate().skip(1).take(most);
        waves.fold([0.0; 2], |[height, slope], (k, p)| {
            let wave = TAU * k as f64 / length_m;
            [height + p, slope + wave * wave * p]
        })
    };
    let [height, slope] = sums(power.len());
    let halvings = (1..).map(|n| 1_usize << n).take_while(|k| 2 * k <= nx);
    let of = |k: usize| {
        let [own_height, own_slope] = sums(k);
        Kept {
            wave_m: length_m / k as f64,
            height: (own_height / height).sqrt(),
            slope: (own_slope / slope).sqrt(),
        }
    };
    if height > 0.0 {
        halvings.map(of).collect()
    } else {
        Vec::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two waves, by hand: a long one of twice the height has 4/5 of the variance; the short one, sixteen times as steep a wave
    /// number, has all but 1/65 of the square of the slope.
    #[test]
    fn two_waves_share_height_and_slope() {
        let n = 256;
        let wave = |k: usize, i: usize| (TAU * (k * i) as f64 / n as f64).cos();
        let heights: Vec<f64> = (0..n).map(|i| 2.0 * wave(4, i) + wave(64, i)).collect();
        let all = kept(n, &heights, 1e-6);
        let at = |wave_m: f64| {
            all.iter()
                .find(|one| (one.wave_m / wave_m - 1.0).abs() < 1e-9)
        };
        let half = at(32e-6).expect("256/8");
        assert!((half.height.powi(2) - 0.8).abs() < 1e-12);
        assert!((half.slope.powi(2) - 1.0 / 65.0).abs() < 1e-12);
        let whole = at(4e-6).expect("256/64");
        assert!((whole.height - 1.0).abs() < 1e-12 && (whole.slope - 1.0).abs() < 1e-12);
        assert!(kept(4, &[1.0; 8], 1.0).is_empty());
    }
}
