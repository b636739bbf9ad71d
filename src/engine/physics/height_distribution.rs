//! Heights of given skewness and kurtosis: a cubic of a normal number.
//!
//! ```text
//! z = −c + b g + c g² + d g³,   ⟨z⟩ = 0
//! 1 = b² + 6bd + 2c² + 15d²
//! Ssk = 2c (b² + 24bd + 105d² + 2)
//! Sku − 3 = 24 (bd + c²(1 + b² + 28bd) + d²(12 + 48bd + 141c² + 225d²))
//! ```
//! Fleishman (1978), Psychometrika 43, 521-532, equations 11, 17 and 18. A cubic reaches `Sku ≥ 1.774 + 1.641 Ssk²`: less would
//! be heights in two heaps.

/// Coefficients of a cubic of a normal number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeightDistribution {
    b: f64,
    c: f64,
    d: f64,
}

/// Least kurtosis of heights of that skewness.
pub fn least_kurtosis(skewness: f64) -> f64 {
    1.774 + 1.641 * skewness * skewness
}

/// Steps from the normal distribution to the one asked for: Newton's iteration starts each from the one before.
const STEPS: usize = 40;
/// Reach of the normal numbers, and how finely they are tabled.
const REACH: f64 = 6.0;
const TABLED: usize = 6000;

impl HeightDistribution {
    /// Of that skewness and kurtosis; `None`: no cubic has them.
    pub fn new(skewness: f64, kurtosis: f64) -> Option<Self> {
        let mut x = [1.0, 0.0, 0.0];
        for step in 1..=STEPS {
            let part = step as f64 / STEPS as f64;
            for _ in 0..20 {
                x = newton(x, [1.0, part * skewness, part * (kurtosis - 3.0)])?;
            }
        }
        let miss = residual(x, [1.0, skewness, kurtosis - 3.0]);
        let [b, c, d] = x;
        miss.iter()
            .all(|r| r.abs() < 1e-9)
            .then_some(Self { b, c, d })
    }

    fn at(&self, g: f64) -> f64 {
        ((self.d * g + self.c) * g + self.b) * g - self.c
    }

    /// `n` heights in rising order, at the middles of equal parts of the probability.
    pub fn quantiles(&self, n: usize) -> Vec<f64> {
        let step = 2.0 * REACH / TABLED as f64;
        let place = |k: usize| -REACH + step * k as f64;
        let density = |g: f64| (-0.5 * g * g).exp();
        let mut below = vec![0.0];
        for k in 0..TABLED {
            let middle = place(k) + 0.5 * step;
            let part = density(place(k)) + 4.0 * density(middle) + density(place(k + 1));
            below.push(below[k] + part);
        }
        let all = below[TABLED];
        let mut k = 0;
        let mut heights: Vec<f64> = (0..n)
            .map(|i| {
                let share = (i as f64 + 0.5) / n as f64 * all;
                while k + 1 < TABLED && below[k + 1] < share {
                    k += 1;
                }
                let part = (share - below[k]) / (below[k + 1] - below[k]);
                self.at(place(k) + step * part)
            })
            .collect();
        heights.sort_by(f64::total_cmp);
        heights
    }
}

fn residual([b, c, d]: [f64; 3], [variance, skewness, excess]: [f64; 3]) -> [f64; 3] {
    [
        b * b + 6.0 * b * d + 2.0 * c * c + 15.0 * d * d - variance,
        2.0 * c * (b * b + 24.0 * b * d + 105.0 * d * d + 2.0) - skewness,
        24.0 * (b * d
            + c * c * (1.0 + b * b + 28.0 * b * d)
            + d * d * (12.0 + 48.0 * b * d + 141.0 * c * c + 225.0 * d * d))
            - excess,
    ]
}

/// One iteration with differences for the derivatives; `None`: it has no next step.
fn newton(x: [f64; 3], target: [f64; 3]) -> Option<[f64; 3]> {
    const BY: f64 = 1e-7;
    let here = residual(x, target);
    let column = |k: usize| {
        let mut there = x;
        there[k] += BY;
        let moved = residual(there, target);
        [0, 1, 2].map(|row| (moved[row] - here[row]) / BY)
    };
    let [u, v, w] = [0, 1, 2].map(column);
    let cross = |p: [f64; 3], q: [f64; 3]| {
        [
            p[1] * q[2] - p[2] * q[1],
            p[2] * q[0] - p[0] * q[2],
            p[0] * q[1] - p[1] * q[0],
        ]
    };
    let dot = |p: [f64; 3], q: [f64; 3]| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    let whole = dot(u, cross(v, w));
    let step = [
        dot(here, cross(v, w)),
        dot(u, cross(here, w)),
        dot(u, cross(v, here)),
    ];
    let next = [0, 1, 2].map(|k| x[k] - step[k] / whole);
    next.iter().all(|v| v.is_finite()).then_some(next)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Moments of the quantiles, summed: those that were asked for. What no cubic has is refused.
    #[test]
    fn quantiles_have_the_moments() {
        for (skewness, kurtosis) in [
            (0.0, 3.0),
            (-0.5, 3.5),
            (-1.0, 5.0),
            (1.2, 6.0),
            (0.0, 2.0),
            (-2.0, 9.5),
            (0.0, 6.0),
        ] {
            let found = HeightDistribution::new(skewness, kurtosis);
            let heights = found.map(|of| of.quantiles(200_000)).unwrap_or_default();
            let moment = |power: i32| {
                heights.iter().map(|z| z.powi(power)).sum::<f64>() / heights.len() as f64
            };
            let [mean, square, cube, fourth] = [1, 2, 3, 4].map(moment);
            println!("{skewness} {kurtosis}: {mean:.4} {square:.4} {cube:.3} {fourth:.3}");
            assert!(mean.abs() < 1e-3 && (square - 1.0).abs() < 2e-3);
            assert!((cube - skewness).abs() < 0.01 * (1.0 + skewness.abs()));
            assert!((fourth / kurtosis - 1.0).abs() < 0.02);
        }
        for (skewness, kurtosis) in [(0.0, 1.2), (2.0, 4.0), (-3.0, 9.0)] {
            assert!(kurtosis < least_kurtosis(skewness));
            assert_eq!(HeightDistribution::new(skewness, kurtosis), None);
        }
    }
}
