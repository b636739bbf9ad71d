//! A part of the program at one setting after another, all else fixed: error, order, time and work of each.

use std::time::Instant;

use super::super::StudyError;

/// What an error is measured against.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Against {
    /// A closed form.
    ClosedForm,
    /// A published or independently computed value.
    Table,
    /// The same case solved to a far tighter tolerance.
    TighterTolerance,
    /// The finest case of the same series.
    Finest,
}

impl Against {
    /// Name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::ClosedForm => "closed form",
            Self::Table => "table",
            Self::TighterTolerance => "tighter tolerance",
            Self::Finest => "finest case",
        }
    }
}

/// What is varied in a series.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Varied {
    /// Nodes per side.
    Nodes,
    /// Time step, in nodes.
    Step,
    /// Tolerance of a step.
    Tolerance,
    /// Depths.
    Depths,
    /// ε of the depth truncation.
    Decay,
}

impl Varied {
    /// Name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Nodes => "N",
            Self::Step => "step, nodes",
            Self::Tolerance => "tolerance",
            Self::Depths => "depths",
            Self::Decay => "epsilon",
        }
    }

    /// The length in whose powers the error falls; `None`: no order of convergence is expected.
    fn spacing(self, setting: f64) -> Option<f64> {
        match self {
            Self::Nodes => Some(1.0 / (setting - 1.0)),
            Self::Step => Some(setting),
            Self::Tolerance | Self::Depths | Self::Decay => None,
        }
    }
}

/// One setting of a series.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// What is varied, at this value.
    pub setting: f64,
    /// The quantity itself in a series against its finest case, else the relative error.
    value: f64,
    /// Relative error; 0 for the finest case of a series that is measured against it.
    pub error: f64,
    /// Order observed from the next coarser rows to this one.
    pub order: Option<f64>,
    /// Best time, s.
    pub seconds: f64,
    /// Work done, in the series' unit.
    pub work: u64,
}

/// A quantity over settings, coarse to fine.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Part of the program.
    pub part: &'static str,
    /// What the error is an error of.
    pub quantity: &'static str,
    /// What is varied.
    pub varied: Varied,
    /// Other settings, in words.
    pub rest: String,
    /// What the error is measured against.
    pub against: Against,
    /// What work is counted in.
    pub work_unit: &'static str,
    /// The settings.
    pub rows: Vec<Row>,
}

/// Values of a part's quantities at one setting, and what they cost.
pub(super) struct Measured<const N: usize> {
    pub(super) values: [f64; N],
    pub(super) seconds: f64,
    pub(super) work: u64,
}

/// A part of the program, and how it is measured.
pub(super) struct Part<const N: usize> {
    pub(super) name: &'static str,
    pub(super) quantities: [&'static str; N],
    pub(super) against: Against,
    pub(super) work_unit: &'static str,
}

impl<const N: usize> Part<N> {
    /// One series of each quantity over `settings`, coarse to fine; `rest` says what else is set.
    pub(super) fn over(
        &self,
        varied: Varied,
        settings: &[f64],
        rest: &str,
        mut measure: impl FnMut(f64) -> Result<Measured<N>, String>,
    ) -> Result<Vec<Series>, StudyError> {
        let failed = |reason| StudyError::Run {
            case: self.name.to_owned(),
            reason,
        };
        let measured: Result<Vec<_>, _> = settings.iter().map(|at| measure(*at)).collect();
        let measured = measured.map_err(failed)?;
        let series = |k: usize| {
            let row = |(&setting, of): (&f64, &Measured<N>)| Row {
                setting,
                value: of.values[k],
                error: of.values[k],
                order: None,
                seconds: of.seconds,
                work: of.work,
            };
            let mut series = Series {
                part: self.name,
                quantity: self.quantities[k],
                varied,
                rest: rest.to_owned(),
                against: self.against,
                work_unit: self.work_unit,
                rows: settings.iter().zip(&measured).map(row).collect(),
            };
            series.observe();
            series
        };
        Ok((0..N).map(series).collect())
    }
}

impl Series {
    /// Errors and observed orders out of the values.
    ///
    /// ```text
    /// against a known value    q = ln(e_k/e_{k+1})/ln(s_k/s_{k+1})
    /// against the finest       q = ln(|f_{k−1} − f_k|/|f_k − f_{k+1}|)/ln(s_k/s_{k+1})        three rows in one ratio
    /// ```
    fn observe(&mut self) {
        let values: Vec<f64> = self.rows.iter().map(|row| row.value).collect();
        let is_relative = self.against == Against::Finest;
        if let (true, Some(finest)) = (is_relative, values.last()) {
            for row in &mut self.rows {
                row.error = (row.value / finest - 1.0).abs();
            }
        }
        for at in 1..self.rows.len() {
            let [coarse, fine] = [at - 1, at].map(|n| self.varied.spacing(self.rows[n].setting));
            let (Some(coarse), Some(fine)) = (coarse, fine) else {
                return;
            };
            let fall = match (is_relative, at) {
                (false, _) => values[at - 1] / values[at],
                (true, 1) => continue,
                (true, _) => {
                    ((values[at - 2] - values[at - 1]) / (values[at - 1] - values[at])).abs()
                }
            };
            let order = fall.ln() / (coarse / fine).ln();
            self.rows[at].order = order.is_finite().then_some(order);
        }
    }
}

/// Runs, and again while that is cheap; the best time, s. The first run is left out where there are others.
pub(super) fn timed<T>(mut run: impl FnMut() -> T) -> (T, f64) {
    /// Runs beside the first, and time up to which a run is repeated, s.
    const AGAIN: u32 = 3;
    const SHORT_S: f64 = 0.3;
    let clock = Instant::now();
    let mut out = run();
    let mut seconds = clock.elapsed().as_secs_f64();
    if seconds > SHORT_S {
        return (out, seconds);
    }
    seconds = f64::INFINITY;
    for _ in 0..AGAIN {
        let clock = Instant::now();
        out = run();
        seconds = seconds.min(clock.elapsed().as_secs_f64());
    }
    (out, seconds)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_second_order_series_shows_order_two() {
        for against in [Against::ClosedForm, Against::Finest] {
            let part = Part {
                name: "x",
                quantities: ["y"],
                against,
                work_unit: "",
            };
            let error = |n: f64| (1.0 / (n - 1.0)).powi(2);
            let series = part.over(Varied::Nodes, &[33.0, 65.0, 129.0], "", |n| {
                let of_finest = f64::from(against == Against::Finest);
                Ok(Measured {
                    values: [of_finest + error(n)],
                    seconds: 1.0,
                    work: 1,
                })
            });
            let order = series.expect("measured")[0].rows[2].order;
            assert!((order.expect("observed") - 2.0).abs() < 1e-9, "{against:?}");
        }
    }
}
