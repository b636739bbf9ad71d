//! How long a case is averaged over.
//!
//! ```text
//! leak(w) = Σ_i |sin π f_i w|/(π f_i w)          what a mean over a way w keeps of ripples f_1, f_2, |f_2 − f_1|
//! ```
//! A ripple is averaged out by a whole number of its waves, whatever the others do. Where both bodies' waves have
//! a short common period a multiple of it has leak 0; elsewhere the way between 1/2 and 5/4 of the one asked for
//! that leaks least is nearly as good, and far shorter than the common period. Of ways that leak about as little
//! the shortest is taken: it costs least. A body that hardly moves (S near ±2) passes one crest in a long way; the
//! window grows to it, to 9/4 of the way asked for at most.

use asperity_engine::physics::cycles::speed_ratios;
use asperity_engine::plan::Plan;

/// Shortest and longest window, of what is asked for.
const SHORTEST: f64 = 0.5;
const LONGEST: f64 = 1.25;
/// Longest window for the sake of a slow crest.
const SLOW: f64 = 2.25;
/// Leak that is as good as none.
const CLOSED: f64 = 4e-3;
/// Leak over the least one that is about as little.
const ABOUT: f64 = 1.1;

/// The way to average over, in a: near `wanted`, where the ripples of both bodies cancel best.
pub(super) fn window(plan: &Plan, wanted: f64) -> f64 {
    let speeds = speed_ratios(plan.slide_roll);
    let of = |body: usize| {
        plan.waves[body].map_or(0.0, |wave| {
            wave.crests_per_m * plan.hertz.a_m * speeds[body].abs()
        })
    };
    let (one, two) = (of(0), of(1));
    best([one, two, (one - two).abs()], wanted, plan.domain.dx_a())
}

/// The best of the windows that are whole steps.
fn best(frequencies: [f64; 3], wanted: f64, step: f64) -> f64 {
    let moving = || frequencies.into_iter().filter(|f| *f > 1e-9);
    let slowest = moving().fold(f64::INFINITY, f64::min);
    let Some(crest) = Some(1.0 / slowest).filter(|crest| *crest > 0.0) else {
        return wanted;
    };
    let longest = crest.clamp(LONGEST * wanted, SLOW * wanted);
    let leak = |w: f64| -> f64 {
        moving()
            .map(|f| {
                let waves = std::f64::consts::PI * f * w;
                waves.sin().abs() / waves
            })
            .sum()
    };
    let first = (SHORTEST * wanted / step).ceil() as u64;
    let last = (longest / step).ceil() as u64;
    let windows = || (first..=last.max(first)).map(|n| n as f64 * step);
    let least = windows().map(leak).fold(f64::INFINITY, f64::min);
    windows()
        .find(|w| leak(*w) <= (ABOUT * least).max(CLOSED))
        .unwrap_or(wanted)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn windows_are_whole_periods_where_there_are_short_ones() {
        let step = 1.0 / 32.0;
        // 3 and 5 crests in a period of 1: 2 periods are the first that are long enough.
        assert_eq!(best([3.0, 5.0, 2.0], 4.0, step), 2.0);
        // Nothing moves: what was asked for.
        assert_eq!(best([0.0; 3], 4.0, step), 4.0);
        // A slow crest is waited for, but not for ever.
        assert_eq!(best([0.125, 4.0, 3.875], 4.0, step), 8.0);
        assert!(best([0.01, 4.0, 3.99], 4.0, step) <= 9.0 + step);
    }

    #[test]
    fn a_mean_over_the_window_is_the_mean_over_many_periods() {
        for (f_1, f_2) in [(2.21, 2.44), (1.74, 2.91), (0.35, 4.3), (0.116, 4.53)] {
            let w = best([f_1, f_2, f64::abs(f_1 - f_2)], 4.0, 1.0 / 32.0);
            let n = 20_000;
            let ripple = |x: f64| {
                let wave = |f: f64| (std::f64::consts::TAU * f * x).cos();
                // With the product that a non-linear contact makes.
                wave(f_1) + wave(f_2) + wave(f_1) * wave(f_2)
            };
            let worst = [0.0, 1.3, 2.9].map(|from| {
                let at = |k: i32| ripple(from + w * (f64::from(k) + 0.5) / f64::from(n));
                (0..n).map(at).sum::<f64>().abs() / f64::from(n)
            });
            println!("{f_1} {f_2}: window {w}, remains {worst:?}");
            assert!(worst.iter().all(|mean| *mean < 0.06), "{w} {worst:?}");
            assert!((2.0..=9.04).contains(&w));
        }
    }
}
