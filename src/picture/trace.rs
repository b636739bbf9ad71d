//! What a followed material point has met since it entered the contact, and in the crossing before.

use asperity_engine::sim::Frame;

/// Points kept of a crossing; when there are more every other one is dropped.
const MOST_POINTS: usize = 1024;

/// Where it was, m, and a pressure or stress there, Pa.
pub type TracePoint = [f64; 2];

/// The trace of the crossing that goes on, and of the one before it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PointTrace {
    body: u8,
    last_x_m: f64,
    /// Crossings that have begun.
    pub crossings: u64,
    /// Pressure on the point.
    pub pressure: Vec<TracePoint>,
    /// Effective stress in it.
    pub effective: Vec<TracePoint>,
    /// Pressure in the crossing before.
    pub before: Vec<TracePoint>,
    /// Effective stress and orthogonal shear in it, Pa.
    pub path: Vec<[f64; 2]>,
    /// The same in the crossing before.
    pub path_before: Vec<[f64; 2]>,
    /// Peaks of the pressure that have passed in this crossing, each with its number: between two frames several may.
    pub peaks: Vec<(u32, TracePoint)>,
}

impl PointTrace {
    /// Takes up a frame, of every step or of some.
    pub fn follow(&mut self, frame: &Frame) {
        let Some(point) = &frame.material_point else {
            return;
        };
        // Bodies run towards +x or −x: the point that jumps has left and entered anew.
        let jumped = (point.x_m - self.last_x_m).abs() > frame.a_m;
        if point.body != self.body || jumped {
            self.before = std::mem::take(&mut self.pressure);
            self.path_before = std::mem::take(&mut self.path);
            self.effective.clear();
            self.peaks.clear();
            self.crossings += 1;
        }
        (self.body, self.last_x_m) = (point.body, point.x_m);
        let number = point.cycles_counted as u32;
        if let Some(peak) = point.last_peak
            && self.peaks.last().is_none_or(|(last, _)| number > *last)
        {
            self.peaks.push((number, [peak.x_m, peak.pressure_pa]));
        }
        self.pressure.push([point.x_m, point.pressure_pa]);
        self.effective.push([point.x_m, point.effective_pa]);
        self.path.push([point.effective_pa, point.tau_xz_pa]);
        for trace in [&mut self.pressure, &mut self.effective, &mut self.path] {
            if trace.len() > MOST_POINTS {
                let mut keep = false;
                trace.retain(|_| {
                    keep = !keep;
                    keep
                });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_engine::sim::{MaterialPoint, PassedPeak};

    fn frame(x_m: f64, pressure_pa: f64, counted: f64) -> Frame {
        Frame {
            a_m: 1e-3,
            material_point: Some(MaterialPoint {
                body: 2,
                x_m,
                pressure_pa,
                cycles_counted: counted,
                last_peak: (counted > 0.0).then_some(PassedPeak {
                    x_m: -2e-4,
                    pressure_pa: 2e9,
                }),
                ..MaterialPoint::default()
            }),
            ..Frame::default()
        }
    }

    #[test]
    fn a_trace_has_a_crossing_its_peaks_once_and_the_crossing_before() {
        let mut trace = PointTrace::default();
        // Two peaks pass between the first and the second frame.
        let steps = [(-4e-4, 1e9, 0.0), (-1e-4, 1.5e9, 2.0), (2e-4, 1e9, 2.0)];
        for (x_m, pressure_pa, counted) in steps {
            trace.follow(&frame(x_m, pressure_pa, counted));
        }
        assert_eq!(trace.pressure, [[-4e-4, 1e9], [-1e-4, 1.5e9], [2e-4, 1e9]]);
        assert_eq!(trace.peaks, [(2, [-2e-4, 2e9])]);
        let before = trace.crossings;
        // It begins anew.
        trace.follow(&frame(-1.2e-3, 0.0, 0.0));
        assert_eq!(trace.crossings, before + 1);
        let lengths = [&trace.pressure, &trace.effective, &trace.before].map(Vec::len);
        assert_eq!((lengths, trace.peaks.len()), ([1, 1, 3], 0));
        // A frame without a point changes nothing.
        let same = trace.clone();
        trace.follow(&Frame::default());
        assert_eq!(trace, same);
    }

    #[test]
    fn long_crossings_keep_every_other_point() {
        let mut trace = PointTrace::default();
        for step in 0..3000 {
            trace.follow(&frame(1e-7 * f64::from(step), 1e9, 0.0));
        }
        assert!((MOST_POINTS / 2..=MOST_POINTS).contains(&trace.pressure.len()));
        assert_eq!(trace.pressure[0][0], 0.0);
    }
}
