//! What went wrong with a run, in words.

use asperity_engine::math::number::{counted, fixed};
use asperity_session::run::{End, Outcome};

/// What went wrong, for stderr; empty when nothing did.
pub(crate) fn complaints(outcome: &Outcome) -> Vec<String> {
    const NAMED: usize = 5;
    let mut list = Vec::new();
    match &outcome.end {
        End::Stalled(error) => list.push(format!("stalled: {error}")),
        End::NotStarted(error) => list.push(error.to_string()),
        End::Stopped | End::Done | End::OutputFailed => {}
    }
    if outcome.summary.is_none() {
        list.push("it ended before the passage began, so there are no results".to_owned());
    }
    for step in outcome.unconverged.iter().take(NAMED) {
        list.push(format!(
            "step {} at t = {:.4e} s did not converge: {}{}",
            step.step,
            step.time_s,
            step.unsolved,
            match 1e9 * step.overlap_m {
                nm if nm > 0.0 => format!(", surfaces overlap by {} nm", fixed(nm, 2)),
                _ => String::new(),
            }
        ));
    }
    if outcome.n_unconverged > NAMED as u64 {
        list.push(format!(
            "and {} did not converge",
            counted(outcome.n_unconverged - NAMED as u64, "more step")
        ));
    }
    for error in &outcome.output_errors {
        list.push(format!("output failed: {error}"));
    }
    list
}
