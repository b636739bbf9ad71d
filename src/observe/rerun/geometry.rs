//! Where things are, in millimetres: the unit of every picture in the recording.

use crate::scene::ContactKind;
use crate::sim::Frame;

/// Metres to millimetres.
pub(super) const MM: f64 = 1.0e3;

/// Nodes and lengths of a run's frames; they do not change while it runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Geometry {
    pub(super) kind: ContactKind,
    pub(super) nx: usize,
    pub(super) ny: usize,
    pub(super) x_min: f64,
    pub(super) dx: f64,
    pub(super) y_min: f64,
    pub(super) dy: f64,
    /// Hertz half-widths at the load of the first frame.
    pub(super) a: f64,
    pub(super) b: f64,
}

impl Geometry {
    pub(super) fn of(frame: &Frame) -> Self {
        Self {
            kind: frame.kind,
            nx: frame.nx,
            ny: frame.ny,
            x_min: frame.x_min_m * MM,
            dx: frame.dx_m * MM,
            y_min: frame.y_min_m * MM,
            dy: frame.dy_m * MM,
            a: frame.a_m * MM,
            b: frame.b_m * MM,
        }
    }

    /// Whether the fields of a frame have the sizes that were set up at the first one.
    pub(super) fn holds(&self, frame: &Frame) -> bool {
        let nodes = self.nx * self.ny;
        let sized = |len: usize| len == nodes;
        self.nx == frame.nx
            && self.ny == frame.ny
            && nodes > 0
            && sized(frame.pressure_pa.len())
            && sized(frame.film_m.len())
            && sized(frame.roughness_1_m.len())
            && sized(frame.roughness_2_m.len())
            && sized(frame.traction_pa.len())
            && sized(frame.contact.len())
    }

    pub(super) fn x(&self, i: usize) -> f64 {
        self.x_min + self.dx * i as f64
    }

    pub(super) fn y(&self, j: usize) -> f64 {
        self.y_min + self.dy * j as f64
    }

    pub(super) fn x_max(&self) -> f64 {
        self.x(self.nx.saturating_sub(1))
    }

    pub(super) fn y_max(&self) -> f64 {
        self.y(self.ny.saturating_sub(1))
    }

    /// The row at y = 0.
    pub(super) fn centre_row(&self) -> usize {
        self.ny / 2
    }
}

/// The least number of the form {1, 1.5, 2, 2.5, 3, 4, 5, 6, 8} 10^k that is not below `value`.
pub(super) fn nice_up(value: f64) -> f64 {
    const STEPS: [f64; 10] = [1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
    if !(value.is_finite() && value > 0.0) {
        return 1.0;
    }
    let decade = 10_f64.powf(value.log10().floor());
    // The slack lets a value that is nice up to rounding stay where it is.
    let step = STEPS
        .into_iter()
        .find(|step| step * decade >= value * (1.0 - 1e-12));
    step.unwrap_or(10.0) * decade
}

/// Equal parts of [0, top], where top is one of [`nice_up`]'s: three to five, ends included.
pub(super) fn divisions(top: f64) -> Vec<f64> {
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
pub(super) fn ticks(low: f64, high: f64, about: usize) -> Vec<f64> {
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

/// A tick's number without needless digits.
pub(super) fn number(value: f64) -> String {
    let rounded = (value * 1e6).round() / 1e6;
    // Minus zero reads badly on an axis.
    format!("{}", if rounded == 0.0 { 0.0 } else { rounded })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tops_of_scales_are_round_and_not_too_far() {
        assert_eq!(nice_up(1.0), 1.0);
        assert_eq!(nice_up(1.01), 1.5);
        assert!((nice_up(0.39) - 0.4).abs() < 1e-12);
        assert_eq!(nice_up(8.5e3), 1.0e4);
        assert_eq!(nice_up(0.0), 1.0);
        assert_eq!(nice_up(f64::NAN), 1.0);
        for k in 1..2000 {
            let value = 1.7e-9 * 1.02_f64.powi(k);
            let top = nice_up(value);
            assert!(top >= value * (1.0 - 1e-9) && top <= 1.51 * value);
        }
    }

    #[test]
    fn divisions_are_round_and_hold_both_ends() {
        for top in [
            1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 0.5, 1500.0,
        ] {
            let parts = divisions(top);
            assert_eq!((parts.first(), parts.last()), (Some(&0.0), Some(&top)));
            assert!((4..=6).contains(&parts.len()));
            assert!(
                parts.iter().all(|&value| number(value).len() <= 5),
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
        assert_eq!(number(-0.0), "0");
        assert_eq!(number(0.1 + 0.2), "0.3");
    }
}
