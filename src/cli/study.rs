//! `asperity study`: progress on stderr, the table on stdout.

use asperity::study::{Extent, scaling, scaling_text};
use indicatif::{ProgressBar, ProgressStyle};

use super::args::{StudyArgs, StudyKind};
use super::failure::Failure;
use super::scenes::print;

/// Runs a study and prints its report.
pub(crate) fn study(args: &StudyArgs) -> Result<u8, Failure> {
    match args.kind {
        StudyKind::Scaling => {
            let extent = match (args.quick, args.full) {
                (true, _) => Extent::Quick,
                (_, true) => Extent::Full,
                _ => Extent::Usual,
            };
            let bar = ProgressBar::new(0);
            if let Ok(style) = ProgressStyle::with_template("{bar:30} {pos}/{len} {msg} {elapsed}")
            {
                bar.set_style(style);
            }
            let rows = scaling(extent, &mut |name, n, all| {
                bar.set_length(all as u64);
                bar.set_position(n as u64);
                bar.set_message(name.to_owned());
            });
            bar.finish_and_clear();
            let rows = rows.map_err(|error| Failure::input(miette::miette!("{error}")))?;
            print(&scaling_text(&rows));
            Ok(if rows.iter().any(|row| row.failed > 0) {
                2
            } else {
                0
            })
        }
    }
}
