//! One measured setting of one part.

use std::time::Instant;

use asperity_engine::closed_set;

closed_set! {
    /// What is measured.
    #[derive(PartialOrd, Ord)]
    pub enum StudiedPart {
        /// Dry Hertz contact by conjugate gradients.
        DryHertz = "dry Hertz",
        /// Deflection by a transform pair, in both precisions.
        Deflection = "deflection",
        /// Smooth steady film.
        SmoothFilm = "smooth film",
        /// Moving waves, sliding.
        RoughFilm = "rough film",
        /// Stress in the plane y = 0.
        Slice = "stress slice",
        /// Stress in the volume: its greatest von Mises.
        Volume = "stress volume",
        /// Integral of a power of the stress.
        LifeIntegral = "life integral",
        /// Cycles that material points count.
        CountedCycles = "counted cycles",
        /// The default scene from start-up to life.
        Life = "passage to life",
    }
}

/// What an error is measured against.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Against {
    /// A closed form.
    ClosedForm,
    /// A published or independently computed value.
    Table,
    /// The finest case of the same series.
    Finest,
}

impl Against {
    /// Name.
    pub fn name(self) -> &'static str {
        match self {
            Self::ClosedForm => "closed form",
            Self::Table => "table",
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
    /// Samples a crest.
    Samples,
    /// Width of floating-point numbers.
    Precision,
}

impl Varied {
    /// Name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Nodes => "N",
            Self::Step => "step, nodes",
            Self::Tolerance => "tolerance",
            Self::Depths => "depths",
            Self::Decay => "epsilon",
            Self::Samples => "samples a crest",
            Self::Precision => "bits",
        }
    }

    /// The length that goes to 0 with it, up to a factor.
    fn spacing(self, setting: f64) -> f64 {
        match self {
            Self::Nodes => 1.0 / (setting - 1.0),
            Self::Depths | Self::Samples => 1.0 / setting,
            Self::Step | Self::Tolerance | Self::Decay => setting,
            Self::Precision => (-setting).exp2(),
        }
    }

    /// Whether an order of convergence means anything.
    fn has_order(self) -> bool {
        match self {
            Self::Nodes | Self::Step | Self::Samples => true,
            Self::Tolerance | Self::Depths | Self::Decay | Self::Precision => false,
        }
    }
}

/// One row.
#[derive(Debug, Clone, PartialEq)]
pub struct AccuracyRow {
    /// Part.
    pub part: StudiedPart,
    /// What the error is an error of.
    pub quantity: &'static str,
    /// What is varied.
    pub varied: Varied,
    /// Its setting.
    pub setting: f64,
    /// Other settings, in words.
    pub fixed: String,
    /// The value, where there is a single one.
    pub value: Option<f64>,
    /// Relative error; 0 for the finest case of a series that is measured against it.
    pub error: f64,
    /// Against what.
    pub against: Against,
    /// Order observed from the next coarser rows to this one.
    pub order: Option<f64>,
    /// Time of the best run, s.
    pub seconds: f64,
    /// Runs, beside a first one that is left out where it is short.
    pub runs: u32,
    /// Worker threads.
    pub threads: usize,
    /// Work done, in `work_unit`s.
    pub work: u64,
    /// What work is counted in.
    pub work_unit: &'static str,
    /// Memory by the plan's or the engine's own account, bytes.
    pub bytes: Option<u64>,
    /// Whether no other row of the part and quantity is as good in both error and time.
    pub front: bool,
}

/// Best time of several runs.
#[derive(Debug, Clone, Copy)]
pub(super) struct Timed {
    pub(super) seconds: f64,
    pub(super) runs: u32,
}

/// Runs, and again while that is cheap; the first run is left out where there are others.
pub(super) fn timed<T>(mut run: impl FnMut() -> T) -> (T, Timed) {
    /// Runs beside the first, and time up to which a run is repeated, s.
    const AGAIN: u32 = 3;
    const SHORT_S: f64 = 0.3;
    let clock = Instant::now();
    let mut out = run();
    let mut seconds = clock.elapsed().as_secs_f64();
    if seconds > SHORT_S {
        return (out, Timed { seconds, runs: 1 });
    }
    seconds = f64::INFINITY;
    for _ in 0..AGAIN {
        let clock = Instant::now();
        out = run();
        seconds = seconds.min(clock.elapsed().as_secs_f64());
    }
    (
        out,
        Timed {
            seconds,
            runs: AGAIN,
        },
    )
}

/// Errors of a series against its finest row, which must come last.
pub(super) fn against_finest(rows: &mut [AccuracyRow]) {
    let Some(finest) = rows.last().and_then(|row| row.value) else {
        return;
    };
    for row in rows {
        let value = row.value.unwrap_or(f64::NAN);
        row.error = (value / finest - 1.0).abs();
    }
}

/// Observed orders within each series (same part, quantity, what is varied and what is fixed).
///
/// ```text
/// against a known value    q = ln(e_k/e_{k+1})/ln(s_k/s_{k+1})
/// against the finest       q = ln(|f_{k−1} − f_k|/|f_k − f_{k+1}|)/ln(s_k/s_{k+1})        three rows in one ratio
/// ```
pub(super) fn observe_orders(rows: &mut [AccuracyRow]) {
    for at in 1..rows.len() {
        if !rows[at].varied.has_order() || !same_series(&rows[at - 1], &rows[at]) {
            continue;
        }
        let spacing = |row: &AccuracyRow| row.varied.spacing(row.setting);
        let ratio = spacing(&rows[at - 1]) / spacing(&rows[at]);
        let by = |coarse: f64, fine: f64| {
            let order = (coarse / fine).ln() / ratio.ln();
            order.is_finite().then_some(order)
        };
        let order = if rows[at].against == Against::Finest {
            let before = at
                .checked_sub(2)
                .filter(|&b| same_series(&rows[b], &rows[at]));
            before.and_then(|before| {
                let values = [before, at - 1, at].map(|n| rows[n].value);
                let [Some(one), Some(two), Some(three)] = values else {
                    return None;
                };
                by((one - two).abs(), (two - three).abs())
            })
        } else {
            by(rows[at - 1].error, rows[at].error)
        };
        rows[at].order = order;
    }
}

fn same_series(one: &AccuracyRow, two: &AccuracyRow) -> bool {
    (one.part, one.quantity, one.varied, &one.fixed)
        == (two.part, two.quantity, two.varied, &two.fixed)
}

/// Marks the rows that no other row of the same part and quantity beats in both error and time; errors against the
/// finest case are compared within their own series only. Rows that are their own reference stand aside.
pub(super) fn mark_front(rows: &mut [AccuracyRow]) {
    let is_reference = |row: &AccuracyRow| row.against == Against::Finest && row.error == 0.0;
    let kept: Vec<AccuracyRow> = rows
        .iter()
        .filter(|row| !is_reference(row))
        .cloned()
        .collect();
    for row in rows {
        let beaten = kept.iter().any(|other| {
            (other.part, other.quantity, other.against) == (row.part, row.quantity, row.against)
                && (row.against != Against::Finest || same_series(other, row))
                && other.error <= row.error
                && other.seconds <= row.seconds
                && (other.error < row.error || other.seconds < row.seconds)
        });
        row.front = !beaten && !is_reference(row);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(setting: f64, value: f64, error: f64, seconds: f64, against: Against) -> AccuracyRow {
        AccuracyRow {
            part: StudiedPart::Slice,
            quantity: "x",
            varied: Varied::Nodes,
            setting,
            fixed: String::new(),
            value: Some(value),
            error,
            against,
            order: None,
            seconds,
            runs: 1,
            threads: 1,
            work: 0,
            work_unit: "",
            bytes: None,
            front: false,
        }
    }

    #[test]
    fn a_second_order_series_shows_order_two() {
        for against in [Against::ClosedForm, Against::Finest] {
            let value = |n: f64| 1.0 + (1.0 / (n - 1.0)).powi(2);
            let mut rows: Vec<_> = [33.0, 65.0, 129.0]
                .iter()
                .map(|&n| row(n, value(n), value(n) - 1.0, n, against))
                .collect();
            observe_orders(&mut rows);
            let order = rows[2].order.expect("observed");
            assert!((order - 2.0).abs() < 1e-9, "{against:?} {order}");
        }
    }

    #[test]
    fn the_front_holds_what_nothing_beats() {
        let closed = Against::ClosedForm;
        let mut rows = vec![
            row(33.0, 1.0, 0.1, 1.0, closed),
            row(65.0, 1.0, 0.2, 2.0, closed),
            row(129.0, 1.0, 0.01, 4.0, closed),
        ];
        mark_front(&mut rows);
        let front: Vec<bool> = rows.iter().map(|row| row.front).collect();
        assert_eq!(front, [true, false, true]);
    }
}
