//! The table of a sweep: one row a case, one column a number.
//!
//! Keys that vary come first under their own names, then what came out. Names carry their units (`_m`, `_pa`,
//! `_m_s`); a second header line would break most readers. Cells that were not computed are empty. `scene` is
//! the digest of the whole scene of the row: `base.toml` beside the table with the row's keys set is that
//! scene. Nothing in the table depends on the machine's speed; seconds go to a file of their own.

use std::fmt::Write as _;

use toml::Value;

use super::case::{Began, CaseEnd, CaseRecord};
use super::error::SweepError;
use super::folder::Folder;
use super::spec::Sweep;
use crate::files::fnv;
use crate::observe::cells::Cells;

/// Columns after those of the path and the axes, in the order of [`numbers`].
pub const COLUMNS: [&str; 56] = [
    "h_regression_m",
    "h_min_regression_m",
    "lambda_ratio",
    "a_m",
    "p_hertz_pa",
    "load_n",
    "h_central_m",
    "h_min_m",
    "h_min_least_m",
    "p_max_pa",
    "p_max_greatest_pa",
    "contact_ratio",
    "contact_load_ratio",
    "friction_coefficient",
    "n_body_1",
    "n_body_2",
    "n_counted_body_1",
    "n_counted_body_2",
    "i_ref",
    "i_mean",
    "cycle_factor",
    "stress_factor",
    "peak_factor",
    "traction_factor",
    "load_factor",
    "life_relative",
    "life_relative_low",
    "life_relative_high",
    "life_body",
    "life_body_1",
    "life_body_2",
    "life_system",
    "life_global",
    "life_damage",
    "life_snapshot",
    "life_swept",
    "life_models_low",
    "life_models_high",
    "life_cycles",
    "survival_ratio",
    "sigma_eff_max_pa",
    "sigma_eff_max_depth_m",
    "sigma_eff_max_x_m",
    "cycles_end_depth_1_m",
    "cycles_end_depth_2_m",
    "pit_depth_1_m",
    "pit_depth_2_m",
    "period_s",
    "period_drift",
    "load_error",
    "mass_error",
    "steps",
    "steps_not_converged",
    "newton_iterations",
    "linear_iterations",
    "ffts",
];

/// A record's numbers in the order of [`COLUMNS`].
pub fn numbers(record: &CaseRecord) -> [Option<f64>; COLUMNS.len()] {
    let s = &record.summary;
    let got = s.steps > 0;
    let some = |value: f64| got.then_some(value);
    let count = |value: u64| got.then_some(value as f64);
    [
        record.h_regression_m,
        record.h_min_regression_m,
        record.lambda_ratio,
        some(s.a_m),
        some(s.p_hertz_pa),
        some(s.load_n),
        some(s.h_central_m),
        some(s.h_min_m),
        some(s.h_min_least_m),
        some(s.p_max_pa),
        some(s.p_max_greatest_pa),
        some(s.contact_ratio),
        some(s.contact_load_ratio),
        some(s.friction_coefficient),
        s.n_body_1,
        s.n_body_2,
        s.n_counted_body_1,
        s.n_counted_body_2,
        s.i_ref,
        s.i_mean,
        s.cycle_factor,
        s.stress_factor,
        s.peak_factor,
        s.traction_factor,
        s.load_factor,
        s.life_relative,
        s.life_relative_low,
        s.life_relative_high,
        s.life_body.map(f64::from),
        s.life_body_1,
        s.life_body_2,
        s.life_system,
        s.life_global,
        s.life_damage,
        s.life_snapshot,
        s.life_swept,
        s.life_models_low,
        s.life_models_high,
        s.life_cycles,
        s.survival_ratio,
        s.sigma_eff_max_pa,
        s.sigma_eff_max_depth_m,
        s.sigma_eff_max_x_m,
        s.cycles_end_depth_1_m,
        s.cycles_end_depth_2_m,
        s.pit_body_1.map(|pit| pit.depth_m),
        s.pit_body_2.map(|pit| pit.depth_m),
        s.period_s,
        s.period_drift,
        some(s.load_error),
        some(s.mass_error),
        count(s.steps),
        count(s.steps_not_converged),
        count(s.counters.newton_iterations),
        count(s.counters.linear_iterations),
        count(s.counters.ffts),
    ]
}

/// A sweep's rows, all there.
#[derive(Debug, Clone)]
pub struct Rows {
    /// One record a case, in order.
    pub records: Vec<CaseRecord>,
}

impl Rows {
    /// Gathers the cases of a sweep from the folders of its shards; a case that is in several is in all of them
    /// the same.
    ///
    /// # Errors
    /// [`SweepError::Incomplete`] that names the chains with missing cases; [`SweepError::Folder`] when not all
    /// folders were filled by one build of the program.
    pub fn gather(sweep: &Sweep, folders: &[Folder]) -> Result<Self, SweepError> {
        if let Some(pair) = folders
            .windows(2)
            .find(|pair| pair[0].build() != pair[1].build())
        {
            let reason = format!(
                "was filled by build {}, {} by build {}: one table would mix the numbers of both",
                pair[1].build(),
                pair[0].root().display(),
                pair[0].build()
            );
            return Err(SweepError::folder(pair[1].root(), reason));
        }
        let find = |case: usize| folders.iter().find_map(|folder| folder.read_case(case));
        let records: Vec<_> = (0..sweep.len()).map(find).collect();
        let missing = records.iter().filter(|record| record.is_none()).count();
        if missing > 0 {
            return Err(SweepError::Incomplete {
                missing,
                all: sweep.len(),
                list: missing_chains(sweep, &records),
            });
        }
        Ok(Self {
            records: records.into_iter().flatten().collect(),
        })
    }

    /// The column of that name, an axis or one of [`COLUMNS`]; empty cells are NaN.
    pub fn column(&self, sweep: &Sweep, name: &str) -> Option<Vec<f64>> {
        if let Some(axis) = sweep.axes.iter().position(|axis| axis.key == name) {
            let numbers = sweep.axes[axis].numbers()?;
            let cases = 0..sweep.len();
            return Some(cases.map(|case| numbers[sweep.place(case)[axis]]).collect());
        }
        if let Some(values) = super::path::column(&sweep.path, name) {
            return Some(values);
        }
        let column = COLUMNS.iter().position(|column| *column == name)?;
        let cell = |record: &CaseRecord| numbers(record)[column].unwrap_or(f64::NAN);
        Some(self.records.iter().map(cell).collect())
    }

    /// The table.
    ///
    /// # Errors
    /// [`SweepError::Case`] when a case is no scene any more (its height map has gone).
    pub fn csv(&self, sweep: &Sweep) -> Result<String, SweepError> {
        let head = ["case".to_owned()]
            .into_iter()
            .chain(super::path::columns(&sweep.path).map(str::to_owned))
            .chain(sweep.axes.iter().map(|axis| axis.key.clone()))
            .chain(["scene", "began", "end"].map(str::to_owned))
            .chain(COLUMNS.map(|column| sweep.header(column).to_owned()));
        let mut text = Text::begin(head);
        let mut row = Cells::default();
        for record in &self.records {
            Self::row(sweep, record, &mut row)?;
            text.row(&row);
        }
        Ok(text.end())
    }

    fn row(sweep: &Sweep, record: &CaseRecord, row: &mut Cells) -> Result<(), SweepError> {
        let scene = sweep.scene(record.index)?;
        let scene = toml::to_string(&scene).unwrap_or_default();
        row.clear();
        row.text(record.index);
        if let Some(point) = sweep.path.get(record.index) {
            for (_, value) in &point.values {
                row.number(*value);
            }
        }
        for value in sweep.values(record.index) {
            write_value(row, value);
        }
        row.text(format_args!("{:016x}", fnv(scene.as_bytes())));
        row.text(match record.began {
            Began::Cold => "cold",
            Began::Warm => "warm",
        });
        row.text(match record.end {
            CaseEnd::Converged => "converged",
            CaseEnd::NotConverged => "not_converged",
            CaseEnd::Stalled => "stalled",
        });
        for value in numbers(record) {
            row.optional(value);
        }
        Ok(())
    }

    /// Seconds of every case, beside the table because they are another number in every run.
    pub fn seconds_csv(&self) -> String {
        let mut text = "case,seconds_s\n".to_owned();
        for record in &self.records {
            let _ = writeln!(text, "{},{:.3}", record.index, record.seconds);
        }
        text
    }

    /// The worst end of all cases.
    pub fn worst(&self) -> CaseEnd {
        let has = |end| self.records.iter().any(|record| record.end == end);
        if has(CaseEnd::Stalled) {
            CaseEnd::Stalled
        } else if has(CaseEnd::NotConverged) {
            CaseEnd::NotConverged
        } else {
            CaseEnd::Converged
        }
    }
}

/// A table in memory.
pub(super) struct Text(csv::Writer<Vec<u8>>);

impl Text {
    /// With its header.
    pub(super) fn begin(head: impl IntoIterator<Item = impl AsRef<[u8]>>) -> Self {
        let mut text = Self(csv::Writer::from_writer(Vec::new()));
        text.put(head);
        text
    }

    /// One row more.
    pub(super) fn row(&mut self, row: &Cells) {
        self.put(row.iter());
    }

    fn put(&mut self, cells: impl IntoIterator<Item = impl AsRef<[u8]>>) {
        // Text into memory, every row as long as the header: this cannot fail.
        drop(self.0.write_record(cells));
    }

    /// The whole of it.
    pub(super) fn end(self) -> String {
        let bytes = self.0.into_inner().ok().unwrap_or_default();
        String::from_utf8(bytes).unwrap_or_default()
    }
}

/// A value as the sweep file has it.
pub(super) fn write_value(row: &mut Cells, value: &Value) {
    match value {
        Value::Float(number) if number.is_infinite() => row.text(number),
        Value::Float(number) => row.number(*number),
        Value::String(text) => row.text(text),
        other => row.text(other),
    }
}

/// Chains with missing cases, at most a dozen of them by name.
fn missing_chains(sweep: &Sweep, records: &[Option<CaseRecord>]) -> String {
    const NAMED: usize = 12;
    let lacking: Vec<_> = sweep
        .chains()
        .into_iter()
        .enumerate()
        .filter(|(_, cases)| records[cases.clone()].iter().any(Option::is_none))
        .collect();
    let names: Vec<_> = lacking
        .iter()
        .take(NAMED)
        .map(|(chain, cases)| format!("chain {chain} (cases {} to {})", cases.start, cases.end - 1))
        .collect();
    let more = lacking.len().saturating_sub(NAMED);
    if more > 0 {
        format!("{} and {more} more", names.join(", "))
    } else {
        names.join(", ")
    }
}
