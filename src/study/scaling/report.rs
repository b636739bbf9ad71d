//! The rows as text.

use std::fmt::Write as _;

use super::super::table::figure;
use super::{HALF_TOUCHES, ScalingRow};

/// The rows as a Markdown table, with the ratios that the rows give.
pub fn scaling_text(rows: &[ScalingRow]) -> String {
    let mut text = String::from(
        "| grid | case | threads | pair, ms | step, ms | units (pairs) | transforms, % | steps/s | Newton | Krylov | MB | not converged |\n\
         |---|---|---|---|---|---|---|---|---|---|---|---|\n",
    );
    for row in rows {
        let _ = writeln!(
            text,
            "| {n}² | {} | {} | {:.3} | {:.2} | {:.0} | {} | {:.1} | {:.1} | {:.1} | {:.0} | {} |",
            row.case,
            row.threads,
            row.pair_s * 1e3,
            row.step_s * 1e3,
            row.units(),
            figure(row.transforms_s.map(|s| 100.0 * s / row.step_s)),
            1.0 / row.step_s,
            row.newton,
            row.krylov,
            row.memory_bytes as f64 * 1e-6,
            row.failed,
            n = row.nodes,
        );
    }
    text.push('\n');
    push_ratios(&mut text, rows);
    push_splits(&mut text, rows);
    text
}

/// What each stage takes, in pairs.
fn push_splits(text: &mut String, rows: &[ScalingRow]) {
    text.push_str(
        "\n| grid | case | threads | solution, pairs | stress, counting and life, pairs | frame, pairs | whole frame, pairs | whole frames/s | MB with them |\n\
         |---|---|---|---|---|---|---|---|---|\n",
    );
    for (row, split) in rows
        .iter()
        .filter_map(|row| row.split.map(|split| (row, split)))
    {
        let _ = writeln!(
            text,
            "| {n}² | {} | {} | {:.1} | {:.1} | {:.1} | {:.1} | {:.1} | {:.0} |",
            row.case,
            row.threads,
            row.units(),
            split.stress_and_life_s / row.pair_s,
            split.frame_s / row.pair_s,
            (split.whole_s + split.frame_s) / row.pair_s,
            1.0 / (split.whole_s + split.frame_s),
            split.memory_bytes as f64 * 1e-6,
            n = row.nodes,
        );
    }
}

fn push_ratios(text: &mut String, rows: &[ScalingRow]) {
    let find = |case: &str, nodes: usize, threads: usize| {
        rows.iter()
            .find(|row| row.case == case && row.nodes == nodes && row.threads == threads)
    };
    let mut sizes: Vec<usize> = rows.iter().map(|row| row.nodes).collect();
    sizes.sort_unstable();
    sizes.dedup();
    for &n in &sizes {
        let whole = [find("whole grid", n, 1), find("whole grid", n, 2)];
        let mirrored = find("mirrored in y", n, 2);
        if let ([Some(one), Some(two)], Some(mirrored)) = (whole, mirrored) {
            let _ = writeln!(
                text,
                "{n}²: two threads {:.2} times one; mirrored {:.2} times as fast as the whole grid",
                one.step_s / two.step_s,
                two.step_s / mirrored.step_s
            );
        }
    }
    // From each size to the next, then from the least to the largest.
    let ends = [sizes.first(), sizes.last()].map(|n| *n.unwrap_or(&0));
    let pairs = sizes.windows(2).map(|pair| [pair[0], pair[1]]);
    for [from, to] in pairs.chain((sizes.len() > 2).then_some(ends)) {
        let work = |n: usize| (n * n) as f64 * (n as f64).log2();
        let growth = |case: &str| {
            let (small, large) = (find(case, from, 1)?, find(case, to, 1)?);
            Some(large.step_s / small.step_s)
        };
        if let (Some(whole), Some(mirrored)) = (growth("whole grid"), growth("mirrored in y")) {
            let _ = writeln!(
                text,
                "{from}² to {to}², one thread: cost x {whole:.2}, mirrored x {mirrored:.2}; N² log N x {:.2}",
                work(to) / work(from)
            );
        }
    }
    if let Some(mixed) = find("mirrored in y", 129, 2) {
        for row in rows.iter().filter(|row| row.case.contains("near dry")) {
            let _ = writeln!(
                text,
                "{}: {:.2} times the cost of the mixed regime",
                row.case,
                row.step_s / mixed.step_s
            );
            if let Some(half) = find(HALF_TOUCHES, 129, 2) {
                let _ = writeln!(
                    text,
                    "  and {:.2} times that at its dry end, {}",
                    row.step_s / half.step_s,
                    half.case
                );
            }
        }
    }
}
