//! A plot of curves, decided once: what stands along the axes, which curves, which marks. Painters: pages of an export, views of
//! a recording.

use asperity_engine::math::number::nice_ceiling;

use crate::chart::Scale;

/// What a curve or a mark stands for: painters have a colour for each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tone {
    /// Pressure and stress, body 1.
    Stress,
    /// Film.
    Film,
    /// The followed point, and what is now.
    Now,
    /// What was before, and what is expected.
    Faint,
    /// Body 2.
    Second,
}

/// An axis.
#[derive(Debug, Clone, PartialEq)]
pub struct PlotAxis {
    /// Quantity and unit.
    pub title: String,
    /// Linear or logarithmic.
    pub scale: Scale,
    /// Values at its left and right, or lower and upper end.
    pub ends: [f64; 2],
}

impl PlotAxis {
    /// Part of its length at which a value lies; `None` beside it.
    pub fn share(&self, value: f64) -> Option<f64> {
        let place = |value| self.scale.place(value);
        let (low, high) = (place(self.ends[0])?, place(self.ends[1])?);
        let share = (place(value)? - low) / (high - low);
        (0.0..=1.0).contains(&share).then_some(share)
    }

    /// Parts of its length with a number, and the numbers.
    pub fn marks(&self) -> Vec<(f64, String)> {
        let [Some(low), Some(high)] = self.ends.map(|end| self.scale.place(end)) else {
            return Vec::new();
        };
        let marks = self.scale.marks(low, high).into_iter();
        let share = |place: f64| (place - low) / (high - low);
        marks
            .map(|place| (share(place), self.scale.label(place)))
            .collect()
    }
}

/// A curve.
#[derive(Debug, Clone, PartialEq)]
pub struct PlotCurve {
    /// For the legend; empty: not in it.
    pub name: String,
    /// Its colour.
    pub tone: Tone,
    /// x and y; what lies beside the axes is left out.
    pub points: Vec<[f64; 2]>,
}

/// A mark with a word.
#[derive(Debug, Clone, PartialEq)]
pub struct PlotMark {
    /// x and y.
    pub at: [f64; 2],
    /// Its colour.
    pub tone: Tone,
    /// Beside it.
    pub label: String,
    /// Whether that stands below it.
    pub is_below: bool,
}

/// A plot.
#[derive(Debug, Clone, PartialEq)]
pub struct Plot {
    /// To the right.
    pub x: PlotAxis,
    /// Upwards.
    pub y: PlotAxis,
    /// In the order in which they are drawn.
    pub curves: Vec<PlotCurve>,
    /// Above them.
    pub marks: Vec<PlotMark>,
}

impl Plot {
    /// The parts of a curve that lie within the axes: shares of both.
    pub fn parts(&self, curve: &PlotCurve) -> Vec<Vec<[f64; 2]>> {
        let mut parts = vec![Vec::new()];
        for [x, y] in &curve.points {
            match self.x.share(*x).zip(self.y.share(*y)) {
                Some((x, y)) => parts
                    .last_mut()
                    .into_iter()
                    .for_each(|part| part.push([x, y])),
                None => parts.push(Vec::new()),
            }
        }
        parts.retain(|part| part.len() > 1);
        parts
    }

    /// The same with ends around what it holds; a logarithmic axis stays.
    #[must_use]
    pub fn fitted(mut self) -> Self {
        let all = |k: usize| {
            let curves = self.curves.iter().flat_map(|curve| &curve.points);
            let marks = self.marks.iter().map(|mark| &mark.at);
            curves.chain(marks).map(move |at| at[k])
        };
        let greatest = [0, 1].map(|k| all(k).fold(0.0, |top: f64, value| top.max(value.abs())));
        for (axis, greatest) in [&mut self.x, &mut self.y].into_iter().zip(greatest) {
            if axis.scale == Scale::Linear && greatest > 0.0 {
                let top = nice_ceiling(greatest);
                let low = if axis.ends[0] < 0.0 { -top } else { 0.0 };
                axis.ends = [low, top];
            }
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(scale: Scale, ends: [f64; 2]) -> PlotAxis {
        PlotAxis {
            title: String::new(),
            scale,
            ends,
        }
    }

    #[test]
    fn curves_end_where_the_axes_do_and_axes_fit() {
        let curve = PlotCurve {
            name: String::new(),
            tone: Tone::Now,
            points: vec![
                [1.0, -3.0],
                [2.0, 0.0],
                [4.0, 2.0],
                [4.0, 9.0],
                [5.0, 1.0],
                [6.0, 1.0],
            ],
        };
        let plot = Plot {
            x: axis(Scale::Linear, [0.0, 10.0]),
            y: axis(Scale::Linear, [-4.0, 4.0]),
            curves: vec![curve.clone()],
            marks: Vec::new(),
        };
        let parts = plot.parts(&curve);
        assert_eq!(parts.len(), 2);
        assert_eq!(parts[0], [[0.1, 0.125], [0.2, 0.5], [0.4, 0.75]]);
        let fitted = plot.fitted();
        assert_eq!((fitted.x.ends, fitted.y.ends), ([0.0, 6.0], [-10.0, 10.0]));
        assert_eq!(axis(Scale::Log, [0.1, 10.0]).share(1.0), Some(0.5));
        assert_eq!(axis(Scale::Log, [0.1, 10.0]).marks().len(), 7);
    }
}
