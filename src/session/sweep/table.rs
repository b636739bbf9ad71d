//! The table of a sweep: one row a case, one column a number.
//!
//! Keys that vary come first under their own names, then what came out. Names carry their units (`_m`, `_pa`,
//! `_m_s`); a second header line would break most readers. Cells that were not computed are empty. `scene` is
//! the digest of the whole scene of the row: `base.toml` beside the table with the row's keys set is that
//! scene. Nothing in the table depends on the machine's speed; seconds go to a file of their own.

use std::fmt::Write as _;

use toml::Value;

use super::case::{CaseEnd, CaseRecord, CaseStart};
use super::error::SweepError;
use super::folder::Folder;
use super::spec::Sweep;
use crate::cells::{Cells, csv_line};
use asperity_engine::files::fnv;
use asperity_engine::sim::{CATALOGUE, Summary};

/// Where a column's number stands in a record.
type InRecord = fn(&CaseRecord) -> Option<f64>;

/// Without a step there are no means.
fn mean(record: &CaseRecord, number: fn(&Summary) -> f64) -> Option<f64> {
    (record.summary.steps > 0).then(|| number(&record.summary))
}

/// Columns of means, each of the name of its number in the summary.
macro_rules! means {
    ($($name:ident)*) => { &[$((stringify!($name), |r| mean(r, |s| s.$name))),*] };
}

/// Same of numbers that not every scene has.
macro_rules! optional {
    ($($name:ident)*) => { &[$((stringify!($name), |r| r.summary.$name.map(f64::from))),*] };
}

/// Columns after those of the path and the axes; what the catalogue shows by itself follows them.
const COLUMNS: [&[(&str, InRecord)]; 7] = [
    &[
        ("h_regression_m", |r| r.h_regression_m),
        ("h_min_regression_m", |r| r.h_min_regression_m),
        ("lambda_ratio", |r| r.lambda_ratio),
    ],
    means! {
        a_m p_hertz_pa load_n h_central_m h_min_m h_min_least_m p_max_pa p_max_greatest_pa
        contact_ratio contact_load_ratio friction_coefficient
    },
    optional! {
        n_body_1 n_body_2 n_counted_body_1 n_counted_body_2
        i_ref i_mean cycle_factor stress_factor peak_factor traction_factor load_factor
        life_common life_relative life_relative_low life_relative_high life_body life_body_1 life_body_2
        life_system life_global life_damage life_models_low life_models_high
        life_phases_low life_phases_high
        life_cycles survival_ratio
        sigma_eff_max_pa sigma_eff_max_depth_m sigma_eff_max_x_m
        cycles_end_depth_1_m cycles_end_depth_2_m
    },
    &[
        ("pit_depth_1_m", |r| Some(r.summary.pit_body_1?.depth_m)),
        ("pit_depth_2_m", |r| Some(r.summary.pit_body_2?.depth_m)),
    ],
    optional! { period_s period_drift },
    means! { load_error mass_error },
    &[
        ("steps", |r| mean(r, |s| s.steps as f64)),
        ("steps_not_converged", |r| {
            mean(r, |s| s.steps_not_converged as f64)
        }),
        ("newton_iterations", |r| {
            mean(r, |s| s.counters.newton_iterations as f64)
        }),
        ("linear_iterations", |r| {
            mean(r, |s| s.counters.linear_iterations as f64)
        }),
        ("ffts", |r| mean(r, |s| s.counters.ffts as f64)),
    ],
];

/// Last columns, each there where a case has its number: scenes that ask for no wear and no heat have none of them.
const ASKED: &[(&str, InRecord)] = optional! {
    a_iso h_gf_m lambda_gf
    cycles wear_depth_1_m wear_depth_2_m pitted_area_1 pitted_area_2
    flash_temperature_max_k flash_temperature_mean_k contact_temperature_max_k
    film_temperature_max_k heat_share_1
    flash_temperature_blok_k inlet_heating_factor inlet_heating_factor_gupta
};

fn own_columns() -> impl Iterator<Item = &'static (&'static str, InRecord)> {
    COLUMNS.into_iter().flatten()
}

/// Names of all those columns.
fn columns() -> impl Iterator<Item = &'static str> {
    let more = CATALOGUE.iter().filter(|quantity| quantity.by_itself);
    let more = more.flat_map(|quantity| quantity.over).map(|(_, key)| *key);
    own_columns().map(|(name, _)| *name).chain(more)
}

/// A record's number in the column of that name.
fn number(record: &CaseRecord, name: &str) -> Option<f64> {
    match own_columns()
        .chain(ASKED)
        .find(|(column, _)| *column == name)
    {
        Some((_, of)) => of(record),
        None => *record.summary.by_itself.get(name)?,
    }
}

/// A sweep's rows, all there.
#[derive(Debug, Clone)]
pub struct Rows {
    /// One record a case, in order; `load_factor` and `life_common` of their summaries are relative to the base scene's smooth
    /// contact.
    pub records: Vec<CaseRecord>,
}

impl Rows {
    /// Gathers the cases of a sweep from its folders; a case that is in several is in all of them
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
        let mut records: Vec<CaseRecord> = records.into_iter().flatten().collect();
        sweep.to_common(&mut records);
        Ok(Self { records })
    }

    /// The column of that name, an axis or a number of the records; empty cells are NaN.
    pub fn column(&self, sweep: &Sweep, name: &str) -> Option<Vec<f64>> {
        if let Some(axis) = sweep.axes.iter().position(|axis| axis.key == name) {
            let numbers = sweep.axes[axis].numbers()?;
            let cases = 0..sweep.len();
            return Some(cases.map(|case| numbers[sweep.place(case)[axis]]).collect());
        }
        if let Some(values) = super::path::column(&sweep.path, name) {
            return Some(values);
        }
        let asked = ASKED.iter().map(|(name, _)| *name);
        let column = columns().chain(asked).find(|column| *column == name)?;
        let cell = |record: &CaseRecord| number(record, column).unwrap_or(f64::NAN);
        Some(self.records.iter().map(cell).collect())
    }

    /// Names of all columns of numbers that this table has.
    fn found_columns(&self) -> impl Iterator<Item = &'static str> + '_ {
        let asked = ASKED
            .iter()
            .filter(|(_, of)| self.records.iter().any(|r| of(r).is_some()));
        columns().chain(asked.map(|(name, _)| *name))
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
            .chain(
                self.found_columns()
                    .map(|column| sweep.header(column).to_owned()),
            );
        let mut text = csv_line(head);
        let mut row = Cells::default();
        for record in &self.records {
            self.row(sweep, record, &mut row)?;
            text.push_str(&csv_line(row.iter()));
        }
        Ok(text)
    }

    fn row(&self, sweep: &Sweep, record: &CaseRecord, row: &mut Cells) -> Result<(), SweepError> {
        let scene = sweep.scene(record.index)?;
        let scene = toml::to_string(&scene).unwrap_or_default();
        begin_row(row, sweep, record.index);
        write_values(row, sweep, record.index);
        row.text(format_args!("{:016x}", fnv(scene.as_bytes())));
        row.text(match record.began {
            CaseStart::Cold => "cold",
            CaseStart::Warm => "warm",
        });
        row.text(match record.end {
            CaseEnd::Converged => "converged",
            CaseEnd::NotConverged => "not_converged",
            CaseEnd::Stalled => "stalled",
        });
        for column in self.found_columns() {
            row.optional(number(record, column));
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
        let ends = self.records.iter().map(|record| record.end);
        ends.max().unwrap_or(CaseEnd::Converged)
    }
}

/// Begins the row of a case: its number, and where it is on its path.
pub(super) fn begin_row(row: &mut Cells, sweep: &Sweep, case: usize) {
    row.clear();
    row.text(case);
    for (_, value) in sweep.path.get(case).into_iter().flat_map(|p| &p.values) {
        row.number(*value);
    }
}

/// Writes the values of a case, one an axis, as the sweep file has them.
pub(super) fn write_values(row: &mut Cells, sweep: &Sweep, case: usize) {
    for value in sweep.values(case) {
        write_value(row, value);
    }
}

/// Writes a value as the sweep file has it.
pub(super) fn write_value(row: &mut Cells, value: &Value) {
    match value {
        Value::Float(number) if !number.is_infinite() => row.number(*number),
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
