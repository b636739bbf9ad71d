//! The nearest setting that works: back from the extreme towards the usual, by bisection.

use super::case::{Case, CaseSet, pushed};
use super::trial;

/// Runs that a search takes; one more where all of them fail: the usual value itself.
const RUNS: u32 = 4;

/// Searches on the way from usual (t = 0) to extreme (t = 1), which fails. Each run halves the interval; the
/// answer has been run. `None`: nothing on the way that was tried works.
pub(super) fn search(set: &CaseSet, case: &Case, nodes: usize) -> Option<String> {
    if case.push.is_empty() {
        return None;
    }
    let works = |t: f64| {
        set.ready(case, nodes, t)
            .is_ok_and(|ready| trial::run(&ready).ending.is_converged())
    };
    let t = bisect(works)?;
    let at = |(name, range): (&String, &[f64; 2])| format!("{name} = {:.3e}", pushed(*range, t));
    let settings: Vec<String> = case.push.iter().map(at).collect();
    Some(format!("{} works", settings.join(", ")))
}

fn bisect(works: impl Fn(f64) -> bool) -> Option<f64> {
    let (mut good, mut bad) = (None, 1.0);
    for _ in 0..RUNS {
        let t = 0.5 * (good.unwrap_or(0.0) + bad);
        if works(t) {
            good = Some(t);
        } else {
            bad = t;
        }
    }
    good.or_else(|| works(0.0).then_some(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_that_works_is_found() {
        let found = bisect(|t| t < 0.8).expect("something works");
        assert!((0.7..0.8).contains(&found), "{found}");
        assert_eq!(bisect(|t| t == 0.0), Some(0.0));
        assert_eq!(bisect(|_| false), None);
    }
}
