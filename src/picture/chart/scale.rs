//! How numbers lie along an axis.

use asperity_engine::math::number::{tick, ticks};

/// Linear or logarithmic. A *place* is what is drawn: the value, or its decimal logarithm.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Equal differences.
    Linear,
    /// Equal ratios.
    Log,
}

impl Scale {
    /// Place of a value; `None` where it has none.
    pub fn place(self, value: f64) -> Option<f64> {
        match self {
            Self::Linear => value.is_finite().then_some(value),
            Self::Log => (value > 0.0 && value.is_finite()).then(|| value.log10()),
        }
    }

    /// The number at a place.
    pub fn label(self, place: f64) -> String {
        /// Beside an axis there is no room for six digits.
        const WIDE: f64 = 1e5;
        let value = match self {
            Self::Linear => place,
            Self::Log => 10_f64.powf(place),
        };
        if value.abs() < WIDE || !value.is_finite() {
            return tick(value);
        }
        let power = value.abs().log10().floor();
        format!("{}e{power:.0}", tick(value / 10_f64.powf(power)))
    }

    /// Places of round numbers within `low` and `high` (places): of a logarithmic axis the decades, with 2 and 5
    /// between them where they are few; one of less than half a decade is parted evenly.
    pub fn marks(self, low: f64, high: f64) -> Vec<f64> {
        const PARTS: usize = 6;
        match self {
            Self::Linear => ticks(low, high, PARTS),
            Self::Log if high - low < 0.5 => ticks(10_f64.powf(low), 10_f64.powf(high), PARTS)
                .into_iter()
                .filter_map(|value| self.place(value))
                .collect(),
            Self::Log => {
                let between: &[f64] = if high - low < 3.0 {
                    &[1.0, 2.0, 5.0]
                } else {
                    &[1.0]
                };
                let decades = low.floor() as i32..=high.ceil() as i32;
                let all = decades.flat_map(|decade| {
                    between
                        .iter()
                        .map(move |leading| f64::from(decade) + leading.log10())
                });
                all.filter(|place| (low..=high).contains(place)).collect()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_round_numbers_within_the_axis() {
        let numbers = |scale: Scale, low: f64, high: f64| -> Vec<String> {
            let marks = scale.marks(low, high);
            assert!(marks.iter().all(|at| (low..=high).contains(at)));
            marks.into_iter().map(|at| scale.label(at)).collect()
        };
        assert_eq!(
            numbers(Scale::Log, -2.1, 0.1),
            ["0.01", "0.02", "0.05", "0.1", "0.2", "0.5", "1"]
        );
        assert_eq!(numbers(Scale::Log, -6.2, -2.0).len(), 5);
        assert_eq!(
            numbers(Scale::Log, 0.0, 0.3),
            ["1", "1.2", "1.4", "1.6", "1.8"]
        );
        assert_eq!(numbers(Scale::Linear, -0.1, 2.1).len(), 5);
        assert_eq!(
            numbers(Scale::Linear, 1e5, 9e5),
            ["2e5", "4e5", "6e5", "8e5"]
        );
    }
}
