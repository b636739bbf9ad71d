//! Independent cases on several workers; results in the order of the cases, news as they come.
//!
//! Not `rayon`: a worker of its pools that waits for the pool of a case's own simulation begins another case meanwhile, and
//! one case's time would hold another's.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::channel;

/// Does `work` on every case, `workers` at a time; tells of each that is begun, after how many others. Each case is done by
/// one worker alone, so that results do not depend on their number.
pub fn share_out<C: Sync, R: Send>(
    cases: &[C],
    workers: usize,
    work: impl Fn(&C) -> R + Sync,
    begun: &mut dyn FnMut(&C, usize),
) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let mut results: Vec<Option<R>> = cases.iter().map(|_| None).collect();
    let (sender, news) = channel();
    std::thread::scope(|scope| {
        for _ in 0..workers.max(1) {
            let (sender, next, work) = (sender.clone(), &next, &work);
            scope.spawn(move || {
                loop {
                    let at = next.fetch_add(1, Ordering::Relaxed);
                    let Some(case) = cases.get(at) else { return };
                    // Nobody listens any more only when the caller is being torn down.
                    drop(sender.send((at, None)));
                    drop(sender.send((at, Some(work(case)))));
                }
            });
        }
        drop(sender);
        let mut n_begun = 0;
        for (at, result) in news {
            if result.is_some() {
                results[at] = result;
            } else {
                begun(&cases[at], n_begun);
                n_begun += 1;
            }
        }
    });
    results.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_case_is_done_once_and_in_order() {
        let cases: Vec<usize> = (0..20).collect();
        let mut heard = Vec::new();
        let squares = share_out(&cases, 3, |n| n * n, &mut |_, n_begun| heard.push(n_begun));
        assert_eq!(squares, cases.iter().map(|n| n * n).collect::<Vec<_>>());
        assert_eq!(heard, cases);
    }
}
