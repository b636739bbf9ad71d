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
    trimmed(value, 3)
}

/// `value` to at most so many significant figures, without zeros that say nothing.
pub fn trimmed(value: f64, digits: i32) -> String {
    let text = sig(value, digits);
    let (digits, power) = text
        .find('e')
        .map_or((text.as_str(), ""), |at| text.split_at(at));
    if !digits.contains('.') {
        return text;
    }
    let digits = digits.trim_end_matches('0').trim_end_matches('.');
    format!("{digits}{power}")
}

/// A number that is known or not.
pub fn sig_or_dash(value: Option<f64>, digits: i32) -> String {
    value.map_or_else(|| "–".to_owned(), |v| sig(v, digits))
}

/// `value` with so many decimals; one that they would show as 0 to two significant figures instead.
pub fn fixed(value: f64, decimals: usize) -> String {
    if value != 0.0 && value.abs() < 0.5 * 10_f64.powi(-(decimals as i32)) {
        return sig(value, 2);
    }
    format!("{value:.decimals$}")
}

/// A length in the unit that suits it, to three significant figures; never 0 unless it is.
pub fn length(value_m: f64) -> String {
    let magnitude = value_m.abs();
    let unit = if magnitude < 1e-6 {
        NM
    } else if magnitude < 1e-3 {
        UM
    } else {
        Unit::new("mm", MM)
    };
    unit.show(value_m, 3)
}

/// `value`, which has passed a bound, with as many digits of `write`, `digits` at least, as show that it has: 10.0001 is
/// not written 10.0 beside "at most 10".
pub fn apart(
    value: f64,
    bound: f64,
    digits: usize,
    write: impl Fn(f64, usize) -> String,
) -> String {
    const MOST: usize = 20;
    let has_passed = value.partial_cmp(&bound);
    let texts = (digits..MOST).map(|digits| write(value, digits));
    let shows = |text: &String| {
        let read = text.parse::<f64>().ok();
        read.and_then(|read| read.partial_cmp(&bound)) == has_passed
    };
    let mut texts = texts.filter(shows);
    texts.next().unwrap_or_else(|| write(value, digits))
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

/// Of what [`nice_ceiling`] gives, the leading digits.
const NICE: [f64; 10] = [1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];

/// The least of 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten that is not below `value`.
pub fn nice_ceiling(value: f64) -> f64 {
    if !(value.is_finite() && value > 0.0) {
        return 1.0;
    }
    let decade = 10_f64.powf(value.log10().floor());
    // The slack lets a value that is nice up to rounding stay where it is.
    let step = NICE
        .into_iter()
        .find(|step| step * decade >= value * (1.0 - 1e-12));
    step.unwrap_or(10.0) * decade
}

/// Equal parts of [0, top], where top is one of [`nice_ceiling`]'s: three to five, ends included.
pub fn divisions(top: f64) -> Vec<f64> {
    let leading = top / 10_f64.powf((top.log10() + 1e-9).floor());
    let parts = match (leading * 10.0).round() as u32 {
        15 | 30 | 60 => 3,
        25 | 50 => 5,
        _ => 4,
    };
    (0..=parts)
        .map(|k| top * f64::from(k) / f64::from(parts))
        .collect()
}

/// Round positions in [low, high], about `about` of them.
pub fn ticks(low: f64, high: f64, about: usize) -> Vec<f64> {
    let raw = (high - low) / about.max(1) as f64;
    if !(raw.is_finite() && raw > 0.0) {
        return vec![low];
    }
    let decade = 10_f64.powf(raw.log10().floor());
    let step = [1.0, 2.0, 2.5, 5.0, 10.0]
        .into_iter()
        .map(|step| step * decade)
        .find(|&step| step >= raw * (1.0 - 1e-9))
        .unwrap_or(raw);
    let first = (low / step - 1e-9).ceil() as i64;
    let last = (high / step + 1e-9).floor() as i64;
    (first..=last).map(|k| k as f64 * step).collect()
}

/// A number to a millionth without needless digits: what is set, and places on an axis.
pub fn plain(value: f64) -> String {
    let rounded = (value * 1e6).round() / 1e6;
    // Minus zero reads badly on an axis.
    format!("{}", if rounded == 0.0 { 0.0 } else { rounded })
}

/// Metres to millimetres.
pub const MM: f64 = 1.0e3;
/// Of pressure and stress.
pub const GPA: Unit = Unit::new("GPa", 1e-9);
/// Of temperature.
pub const KELVIN: Unit = Unit::new("K", 1.0);
/// Of shear.
pub const MPA: Unit = Unit::new("MPa", 1e-6);
/// Of films.
pub const NM: Unit = Unit::new("nm", 1e9);
/// Of heights and places.
pub const UM: Unit = Unit::new("µm", 1e6);

/// A unit: its name, and how many of it make one SI unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// Name, as printed.
    pub name: &'static str,
    /// Units per SI unit.
    pub per_si: f64,
}

impl Unit {
    /// A unit of that name, so many to one SI unit.
    pub const fn new(name: &'static str, per_si: f64) -> Self {
        Self { name, per_si }
    }

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
    fn a_length_is_0_only_where_it_is() {
        for (value_m, shown) in [
            (0.0, "0 nm"),
            (2e-7, "200 nm"),
            (-2e-7, "-200 nm"),
            (2e-13, "2.00e-4 nm"),
            (4e-10, "0.400 nm"),
            (1.5e-6, "1.50 µm"),
            (2.5e-3, "2.50 mm"),
            (1e-30, "1.00e-21 nm"),
        ] {
            assert_eq!(length(value_m), shown);
        }
        for (value, decimals, shown) in [
            (0.0, 1, "0.0"),
            (0.04, 1, "0.040"),
            (-0.004, 2, "-0.0040"),
            (0.05, 1, "0.1"),
            (12.34, 1, "12.3"),
            (0.3, 0, "0.30"),
            (3e-9, 2, "3.0e-9"),
        ] {
            assert_eq!(fixed(value, decimals), shown, "{value}");
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
            (2e-7, "2e-7"),
            (2.5e-7, "2.5e-7"),
        ];
        for (value, shown) in table {
            assert_eq!(tick(value), shown);
        }
    }

    #[test]
    fn ceilings_are_round_and_not_too_far() {
        assert_eq!(nice_ceiling(1.0), 1.0);
        assert_eq!(nice_ceiling(1.73), 2.0);
        assert!((nice_ceiling(0.39) - 0.4).abs() < 1e-12);
        assert_eq!(nice_ceiling(8.5e3), 1.0e4);
        assert_eq!(nice_ceiling(0.0), 1.0);
        assert_eq!(nice_ceiling(f64::NAN), 1.0);
        for k in 1..2000 {
            let value = 1.7e-9 * 1.02_f64.powi(k);
            let top = nice_ceiling(value);
            assert!(top >= value * (1.0 - 1e-9) && top <= 1.51 * value);
        }
    }

    #[test]
    fn divisions_are_round_and_hold_both_ends() {
        for top in NICE.into_iter().chain([0.5, 1500.0]) {
            let parts = divisions(top);
            assert_eq!((parts.first(), parts.last()), (Some(&0.0), Some(&top)));
            assert!((4..=6).contains(&parts.len()));
            assert!(
                parts.iter().all(|&value| plain(value).len() <= 5),
                "{parts:?}"
            );
        }
    }

    #[test]
    fn ticks_cover_the_axis() {
        let at = ticks(-1.18, 0.71, 4);
        assert_eq!(at, vec![-1.0, -0.5, 0.0, 0.5]);
        assert_eq!(ticks(0.0, 1.0, 4), vec![0.0, 0.25, 0.5, 0.75, 1.0]);
        assert_eq!(ticks(1.0, 1.0, 4), vec![1.0]);
        assert_eq!(plain(-0.0), "0");
        assert_eq!(plain(0.1 + 0.2), "0.3");
    }

    #[test]
    fn times_and_sizes() {
        assert_eq!(seconds(2.5e-4), "250 µs");
        assert_eq!(seconds(0.0123), "12.3 ms");
        assert_eq!(bytes(12_300_000), "12.3 MB");
    }
}
