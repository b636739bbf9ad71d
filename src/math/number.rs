//! How a number is written for people: significant figures everywhere, powers of ten only where plain digits
//! would be long. Screen, summary, recording and reports all write their numbers with these.

/// `value` to `digits` significant figures; powers of ten only where plain digits would be long.
pub fn sig(value: f64, digits: i32) -> String {
    if !value.is_finite() {
        return "–".to_owned();
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    let mut exponent = value.abs().log10().floor() as i32;
    // 9.996 to three figures is 10.0: the rounding may carry into the next decade.
    let scaled = value.abs() / 10_f64.powi(exponent - digits + 1);
    if scaled.round() >= 10_f64.powi(digits) {
        exponent += 1;
    }
    if !(-3..=5).contains(&exponent) {
        return format!("{value:.*e}", (digits - 1).max(0) as usize);
    }
    format!("{value:.*}", (digits - 1 - exponent).max(0) as usize)
}

/// A number on an axis: three figures at most, and no zeros that say nothing.
pub fn tick(value: f64) -> String {
    let text = sig(value, 3);
    if text.contains('.') && !text.contains('e') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// A number that is known or not.
pub fn sig_or_dash(value: Option<f64>, digits: i32) -> String {
    value.map_or_else(|| "–".to_owned(), |v| sig(v, digits))
}

/// A count with its noun, which takes an s unless there is one: "1 peak", "2 peaks".
pub fn counted(n: u64, what: &str) -> String {
    let plural = if n == 1 { "" } else { "s" };
    format!("{n} {what}{plural}")
}

/// A span of time with the unit that suits it.
pub fn seconds(value_s: f64) -> String {
    let magnitude = value_s.abs();
    if magnitude >= 1.0 || magnitude == 0.0 {
        format!("{} s", sig(value_s, 3))
    } else if magnitude >= 1e-3 {
        format!("{} ms", sig(value_s * 1e3, 3))
    } else {
        format!("{} µs", sig(value_s * 1e6, 3))
    }
}

/// A count of bytes.
pub fn bytes(count: u64) -> String {
    let value = count as f64;
    if value >= 1e9 {
        format!("{} GB", sig(value / 1e9, 3))
    } else if value >= 1e6 {
        format!("{} MB", sig(value / 1e6, 3))
    } else {
        format!("{} kB", sig(value / 1e3, 3))
    }
}

/// The least of 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten that is not below `value`.
pub fn nice_ceiling(value: f64) -> f64 {
    if !(value.is_finite() && value > 0.0) {
        return 1.0;
    }
    let decade = 10_f64.powf(value.log10().floor());
    let steps = [1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
    let chosen = steps
        .into_iter()
        .find(|step| step * decade >= value * (1.0 - 1e-9));
    chosen.unwrap_or(10.0) * decade
}

/// A unit: its name, and how many of it make one SI unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// Name, as printed.
    pub name: &'static str,
    /// Units per SI unit.
    pub per_si: f64,
}

impl Unit {
    /// `value` (SI) in this unit.
    pub fn of(self, value: f64) -> f64 {
        value * self.per_si
    }

    /// `value` (SI) with its unit, to `digits` significant figures.
    pub fn show(self, value: f64, digits: i32) -> String {
        format!("{} {}", sig(self.of(value), digits), self.name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn significant_figures() {
        let table = [
            (0.0, 3, "0"),
            (1.0, 3, "1.00"),
            (0.0432, 3, "0.0432"),
            (9.996, 3, "10.0"),
            (99.97, 3, "100"),
            (0.9999, 3, "1.00"),
            (14.333, 3, "14.3"),
            (123456.0, 3, "123456"),
            (1.234e-5, 3, "1.23e-5"),
            (-0.25, 2, "-0.25"),
            (f64::INFINITY, 3, "–"),
        ];
        for (value, digits, shown) in table {
            assert_eq!(sig(value, digits), shown, "{value} to {digits}");
        }
    }

    #[test]
    fn counts_take_an_s_unless_there_is_one() {
        let texts = [0, 1, 2].map(|n| counted(n, "peak"));
        assert_eq!(texts, ["0 peaks", "1 peak", "2 peaks"]);
    }

    #[test]
    fn ticks_are_short() {
        let table = [
            (2.5, "2.5"),
            (3.0, "3"),
            (1.25, "1.25"),
            (500.0, "500"),
            (0.0, "0"),
            (-0.3, "-0.3"),
        ];
        for (value, shown) in table {
            assert_eq!(tick(value), shown);
        }
    }

    #[test]
    fn ceilings_are_round_and_not_below() {
        assert_eq!(nice_ceiling(1.73), 2.0);
        assert_eq!(nice_ceiling(2.0), 2.0);
        assert!((nice_ceiling(8.2e-7) - 1e-6).abs() < 1e-15);
        assert_eq!(nice_ceiling(0.0), 1.0);
        assert_eq!(nice_ceiling(f64::NAN), 1.0);
    }

    #[test]
    fn times_and_sizes() {
        assert_eq!(seconds(2.5e-4), "250 µs");
        assert_eq!(seconds(0.0123), "12.3 ms");
        assert_eq!(bytes(12_300_000), "12.3 MB");
    }
}
