//! The rows as a table, the orders and the recommended settings as text.

use std::fmt::Write as _;

use super::super::table::{MarkdownTable, figure};
use super::default_scene::push_default_scene;
use super::{Accuracy, LEVELS, StudiedPart, Varied};

/// Every row.
pub fn accuracy_table(result: &Accuracy) -> MarkdownTable {
    let mut table = MarkdownTable::new(&[
        "part", "error of", "varied", "setting", "rest", "error", "against", "order", "ms", "runs",
        "threads", "work", "unit", "MB", "front",
    ]);
    for row in &result.rows {
        table.rows.push(vec![
            row.part.name().to_owned(),
            row.quantity.to_owned(),
            row.varied.name().to_owned(),
            setting(row.varied, row.setting),
            row.fixed.clone(),
            format!("{:.1e}", row.error),
            row.against.name().to_owned(),
            row.order
                .map_or(String::new(), |order| format!("{order:.2}")),
            figure(Some(1e3 * row.seconds)),
            row.runs.to_string(),
            row.threads.to_string(),
            row.work.to_string(),
            row.work_unit.to_owned(),
            row.bytes
                .map_or(String::new(), |bytes| format!("{:.1}", bytes as f64 * 1e-6)),
            if row.front {
                "*".to_owned()
            } else {
                String::new()
            },
        ]);
    }
    table
}

fn setting(varied: Varied, value: f64) -> String {
    match varied {
        Varied::Tolerance | Varied::Decay => format!("{value:e}"),
        _ => format!("{value}"),
    }
}

/// The whole report as Markdown.
pub fn accuracy_text(result: &Accuracy) -> String {
    let mut text =
        String::from("`*`: no other row of that part is as good in both error and time.\n\n");
    text.push_str(&accuracy_table(result).markdown());
    push_orders(&mut text, result);
    push_lives(&mut text, result);
    push_default_scene(&mut text, &result.default_scene);
    text
}

/// The order between the two finest rows of every series that has one.
fn push_orders(text: &mut String, result: &Accuracy) {
    text.push_str(
        "\n## Observed orders\n\n| part | error of | varied | order |\n|---|---|---|---|\n",
    );
    for part in StudiedPart::ALL {
        let rows: Vec<_> = result.rows.iter().filter(|row| row.part == part).collect();
        for (at, row) in rows.iter().enumerate() {
            let next = rows.get(at + 1);
            let last =
                next.is_none_or(|next| (next.quantity, next.varied) != (row.quantity, row.varied));
            if let Some(order) = row.order.filter(|_| last) {
                let (name, quantity, varied) = (part.name(), row.quantity, row.varied.name());
                let _ = writeln!(text, "| {name} | {quantity} | {varied} | {order:.2} |");
            }
        }
    }
}

fn push_lives(text: &mut String, result: &Accuracy) {
    let _ = writeln!(
        text,
        "\n## Life of the default scene, {} passages\n\n\
         Limit {:.5}, extrapolated from the two finest with order 2; it lies {:.2} % from the finest, and no error below \
         that is known.\n\n\
         *Extrapolated*: with a companion on half the nodes, which a run has by default, as `life_extrapolated`; its time \
         is in.\n\n\
         | N | step | tolerance | depths | value | relative life | error | s |\n|---|---|---|---|---|---|---|---|",
        result.passages,
        result.limit.life,
        100.0 * result.limit.uncertainty
    );
    for run in &result.lives {
        let s = run.setting;
        let _ = writeln!(
            text,
            "| {} | {} | {:e} | {} | {} | {:.5} | {:.2} % | {:.2} |",
            s.nodes,
            s.step,
            s.tolerance,
            s.depths,
            run.value.name(),
            run.life,
            100.0 * run.error,
            run.seconds
        );
    }
    text.push_str(
        "\n## Recommended settings\n\n\
         The cheapest whose error stays within the level at every finer setting too.\n\n",
    );
    for level in LEVELS {
        let _ = match result.recommended(level) {
            Some(run) => writeln!(
                text,
                "- {} % in life, {}: `{}` ({:.2} %, {:.1} s)",
                100.0 * level,
                run.value.name(),
                run.setting.command(),
                100.0 * run.error,
                run.seconds
            ),
            None => writeln!(text, "- {} % in life: none of these", 100.0 * level),
        };
    }
}
