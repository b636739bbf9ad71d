//! Independent cases on several workers; results in the order of the cases, news as they come.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::channel;

use super::StudyProgress;

/// Does `work` on every case, `workers` at a time. Each case is done by one worker alone, so that results do
/// not depend on their number.
pub(super) fn share_out<C: Sync, R: Send>(
    cases: &[C],
    workers: usize,
    name: impl Fn(&C) -> String + Sync,
    work: impl Fn(&C) -> R + Sync,
    progress: &mut StudyProgress,
) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let results: Mutex<Vec<(usize, R)>> = Mutex::new(Vec::with_capacity(cases.len()));
    let (tell, news) = channel();
    std::thread::scope(|scope| {
        for _ in 0..workers.max(1) {
            let tell = tell.clone();
            let (next, results, name, work) = (&next, &results, &name, &work);
            scope.spawn(move || {
                while let Some((index, case)) = take(next, cases) {
                    // Nobody listens any more only when the study is being torn down.
                    let _ = tell.send((name(case), index));
                    let result = work(case);
                    if let Ok(mut results) = results.lock() {
                        results.push((index, result));
                    }
                }
            });
        }
        drop(tell);
        for (done, (name, _)) in news.iter().enumerate() {
            progress(&name, done, cases.len());
        }
    });
    let mut results = results
        .into_inner()
        .unwrap_or_else(std::sync::PoisonError::into_inner);
    results.sort_by_key(|(index, _)| *index);
    results.into_iter().map(|(_, result)| result).collect()
}

fn take<'a, C>(next: &AtomicUsize, cases: &'a [C]) -> Option<(usize, &'a C)> {
    let index = next.fetch_add(1, Ordering::Relaxed);
    Some((index, cases.get(index)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_case_is_done_once_and_in_order() {
        let cases: Vec<usize> = (0..20).collect();
        let mut heard = 0;
        let squares = share_out(
            &cases,
            3,
            ToString::to_string,
            |n| n * n,
            &mut |_, _, all| {
                assert_eq!(all, 20);
                heard += 1;
            },
        );
        assert_eq!(squares, cases.iter().map(|n| n * n).collect::<Vec<_>>());
        assert_eq!(heard, 20);
    }
}
