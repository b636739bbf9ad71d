//! What a researcher looks for: the stress path of the followed point, where the contact is on its S-N line, spectra of surfaces
//! and film, and what is left of the waves against their length.

use asperity_engine::math::number::{GPA, UM, sig};
use asperity_engine::physics::rainflow::{Cycle, HistoryEnds, Rainflow};
use asperity_engine::physics::ripple::amplitude_ratio;
use asperity_engine::scene::{ContactKind, Life, Scene};
use asperity_engine::sim::Frame;

use crate::chart::Scale;
use crate::plot::{Plot, PlotAxis, PlotCurve, PlotMark, Tone};
use crate::spectra::{Heights, Spectra};
use crate::{PointTrace, Ranges};

/// Ranges of effective stress that are counted, over the Hertz pressure: the program's own gate.
const GATE: f64 = 0.03;
/// Most pairs that are marked.
const PAIRS: usize = 9;

/// The plots.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ResearchPlot {
    /// Orthogonal shear against effective stress of the followed point, with rainflow's pairs.
    StressPath,
    /// Life against stress.
    SnPoint,
    /// Amplitude of surfaces and film against the length of waves.
    Spectra,
    /// Film's over surfaces' amplitude, beside theory.
    AmplitudeRatio,
}

impl ResearchPlot {
    /// All of them.
    pub const ALL: [Self; 4] = [
        Self::StressPath,
        Self::SnPoint,
        Self::Spectra,
        Self::AmplitudeRatio,
    ];

    /// What stands above it.
    pub fn title(self) -> &'static str {
        match self {
            Self::StressPath => "Stress path of the followed point",
            Self::SnPoint => "Life against stress, relative to the smooth contact",
            Self::Spectra => "Spectra along y = 0, mean over the steps",
            Self::AmplitudeRatio => "What the film keeps of the waves along y = 0",
        }
    }

    /// Name of its file.
    pub fn name(self) -> &'static str {
        match self {
            Self::StressPath => "stress_path",
            Self::SnPoint => "sn_point",
            Self::Spectra => "spectra",
            Self::AmplitudeRatio => "amplitude_ratio",
        }
    }
}

/// What plots are made of.
#[derive(Debug, Clone, Copy)]
pub struct ResearchData<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The followed point's trace.
    pub trace: &'a PointTrace,
    /// Spectra so far.
    pub spectra: &'a Spectra,
    /// Ranges of the run.
    pub ranges: &'a Ranges,
    /// Whether others stand beside it, so that logarithmic axes are long.
    pub is_shared: bool,
}

impl ResearchData<'_> {
    /// A plot; `None`: there is nothing of it yet, or never will be.
    pub fn plot(&self, what: ResearchPlot, frame: &Frame) -> Option<Plot> {
        match what {
            ResearchPlot::StressPath => self.stress_path(frame),
            ResearchPlot::SnPoint => sn_point(self.scene, frame, self.is_shared),
            ResearchPlot::Spectra => self.spectra(),
            ResearchPlot::AmplitudeRatio => self.amplitude_ratio(frame),
        }
    }

    fn stress_path(&self, frame: &Frame) -> Option<Plot> {
        let point = frame.material_point?;
        let in_gpa = |path: &[[f64; 2]]| path.iter().map(|at| at.map(|pa| GPA.of(pa))).collect();
        let [now, before]: [Vec<[f64; 2]>; 2] =
            [&self.trace.path, &self.trace.path_before].map(|path| in_gpa(path));
        let whole = if before.is_empty() { &now } else { &before };
        let mut curves = vec![
            curve("crossing before", Tone::Faint, before.clone()),
            curve("this crossing", Tone::Stress, now.clone()),
        ];
        let mut marks = Vec::new();
        for (k, [low, high]) in pairs(whole, GATE * GPA.of(frame.p_hertz_pa))
            .into_iter()
            .enumerate()
        {
            curves.push(curve("", Tone::Second, vec![low, high]));
            marks.push(PlotMark {
                at: high,
                tone: Tone::Second,
                label: (k + 1).to_string(),
                is_below: false,
            });
        }
        marks.push(PlotMark {
            at: [point.effective_pa, point.tau_xz_pa].map(|pa| GPA.of(pa)),
            tone: Tone::Now,
            label: String::new(),
            is_below: false,
        });
        let [across, up] = [self.ranges.effective_pa, self.ranges.shear_pa].map(|pa| GPA.of(pa));
        let depth = sig(UM.of(point.depth_m), 3);
        let title = format!(
            "σ_eff of body {} in {depth} µm, GPa (numbers: rainflow's cycles)",
            point.body
        );
        Some(Plot {
            x: linear(title, [0.0, across]),
            y: linear("τ_xz, GPa".to_owned(), [-up, up]),
            curves,
            marks,
        })
        .filter(|_| !whole.is_empty() && across > 0.0 && up > 0.0)
    }

    fn spectra(&self) -> Option<Plot> {
        let all = [
            ("body 1", Tone::Stress, Heights::Body1),
            ("body 2", Tone::Second, Heights::Body2),
            ("film", Tone::Film, Heights::Film),
        ];
        let curves = all.map(|(name, tone, heights)| {
            let points = self.spectra.of(heights).into_iter();
            curve(name, tone, points.map(|at| at.map(|m| UM.of(m))).collect())
        });
        let greatest = curves[..2].iter().flat_map(|curve| &curve.points);
        let greatest = greatest.fold(0.0, |top: f64, at| top.max(at[1]));
        let top = 10_f64.powf((1.2 * greatest).log10().ceil());
        let rough = |curve: &PlotCurve| curve.points.iter().any(|at| at[1] > 1e-4 * top);
        Some(Plot {
            x: self.lengths()?,
            y: PlotAxis {
                title: "amplitude, µm".to_owned(),
                scale: Scale::Log,
                ends: [1e-3 * top, top],
            },
            curves: curves.into_iter().filter(rough).collect(),
            marks: Vec::new(),
        })
        .filter(|_| greatest > 1e-6)
    }

    fn amplitude_ratio(&self, frame: &Frame) -> Option<Plot> {
        let x = self.lengths()?;
        let found = self.spectra.ratios().into_iter();
        let found: Vec<[f64; 2]> = found.map(|[m, ratio]| [UM.of(m), ratio]).collect();
        let mut curves = Vec::new();
        if let Some([m, l]) = moes(self.scene) {
            let of = |um: f64| {
                let wave = um / UM.per_si / frame.a_m;
                amplitude_ratio(self.scene.kind(), wave, m, l)
            };
            let [from, to] = x.ends;
            let lengths = (0..=60).map(|k| from * (to / from).powf(f64::from(k) / 60.0));
            let name = "rolling, full film (Venner & Lubrecht 2000)";
            curves.push(curve(
                name,
                Tone::Faint,
                lengths.map(|um| [um, of(um)]).collect(),
            ));
        }
        let marks = found.iter().map(|at| PlotMark {
            at: *at,
            tone: Tone::Film,
            label: String::new(),
            is_below: false,
        });
        let marks: Vec<PlotMark> = marks.collect();
        let top = found.iter().fold(1.0, |top: f64, at| top.max(at[1]));
        Some(Plot {
            x,
            y: linear(
                "film's amplitude over both surfaces'".to_owned(),
                [0.0, 1.2 * top],
            ),
            curves,
            marks,
        })
        .filter(|_| !found.is_empty())
    }

    /// The axis of the lengths.
    fn lengths(&self) -> Option<PlotAxis> {
        let all = self.spectra.of(Heights::Film);
        let ends = [all.first()?, all.last()?].map(|at| UM.of(at[0]));
        Some(PlotAxis {
            title: "length of the wave, µm".to_owned(),
            scale: Scale::Log,
            ends,
        })
    }
}

fn curve(name: &str, tone: Tone, points: Vec<[f64; 2]>) -> PlotCurve {
    PlotCurve {
        name: name.to_owned(),
        tone,
        points,
    }
}

fn linear(title: String, ends: [f64; 2]) -> PlotAxis {
    PlotAxis {
        title,
        scale: Scale::Linear,
        ends,
    }
}

/// Lower and upper end on the path of each cycle that rainflow closes in its first coordinate, the widest first.
fn pairs(path: &[[f64; 2]], gate: f64) -> Vec<[[f64; 2]; 2]> {
    let mut cycles: Vec<Cycle> = Vec::new();
    let mut flow = Rainflow::new(HistoryEnds::Repeating, gate, 64);
    for [stress, _] in path {
        flow.push(*stress, &mut |cycle| cycles.push(cycle));
    }
    flow.finish(&mut |cycle| cycles.push(cycle));
    cycles.sort_by(|one, two| two.range.total_cmp(&one.range));
    let nearest = |stress: f64| {
        let off = |at: &&[f64; 2]| (at[0] - stress).abs();
        path.iter()
            .min_by(|one, two| off(one).total_cmp(&off(two)))
            .copied()
    };
    let ends = cycles.iter().take(PAIRS).filter_map(|cycle| {
        let half = 0.5 * cycle.range;
        Some([nearest(cycle.mean - half)?, nearest(cycle.mean + half)?])
    });
    ends.collect()
}

/// Moes' M and L of the scene.
fn moes(scene: &Scene) -> Option<[f64; 2]> {
    let groups = match scene.kind() {
        ContactKind::Point => scene.operating_point()?.groups(),
        ContactKind::Line => scene.line_point()?.groups(),
    };
    (groups.m.is_finite() && groups.l > 0.0).then_some([groups.m, groups.l])
}

/// Exponent s of N ∝ σ^−s; `None`: a fatigue limit leaves no such law.
fn stress_exponent(life: &Life) -> Option<f64> {
    let law = life.equation(life.model, 1.0).stress_law(life.law());
    let is_limited = law.is_some_and(|(_, limit)| limit > 0.0);
    (!is_limited).then(|| life.exponent())
}

/// The smooth contact and this one on the line N ∝ σ^−s, and what cycles make of it.
fn sn_point(scene: &Scene, frame: &Frame, is_shared: bool) -> Option<Plot> {
    /// Least life on an axis that others have too.
    const SHARED: f64 = 1e-4;
    let life = frame.metrics.life.as_ref()?;
    let usual = Life::default();
    let exponent = stress_exponent(scene.life.as_ref().unwrap_or(&usual))?;
    let stress_of = |life: f64| life.powf(-1.0 / exponent);
    let stress = stress_of(life.stress_factor);
    let [low, high] = [life.life_relative_low, life.life_relative_high];
    let all = [life.life_relative, life.stress_factor, low, high, 1.0];
    if all.iter().any(|life| !(life.is_finite() && *life > 0.0)) {
        return None;
    }
    let decade = |life: f64, up: bool| {
        let power = life.log10();
        10_f64.powf(if up { power.ceil() } else { power.floor() })
    };
    let least = all.iter().fold(1.0, |least: f64, life| least.min(*life));
    let most = all.iter().fold(1.0, |most: f64, life| most.max(*life));
    let least = if is_shared { least.min(SHARED) } else { least };
    let x = [decade(0.5 * least, false), decade(2.0 * most, true)];
    let shown = [x[1], x[0]].map(stress_of);
    // Words of marks that lie upon each other cannot be read.
    let is_near = (life.stress_factor.ln() / (x[1] / x[0]).ln()).abs() < 0.12;
    let smooth = if is_near { "" } else { "smooth" };
    let mark = |at, tone, label: String| PlotMark {
        at,
        tone,
        label,
        is_below: tone == Tone::Now,
    };
    Some(Plot {
        x: PlotAxis {
            title: "life N, relative".to_owned(),
            scale: Scale::Log,
            ends: x,
        },
        y: PlotAxis {
            title: "equivalent stress, relative".to_owned(),
            scale: Scale::Log,
            ends: [0.98 * shown[0].min(stress), 1.02 * shown[1].max(stress)],
        },
        curves: vec![
            curve(
                &format!("N as stress to the power of −{}", sig(exponent, 3)),
                Tone::Faint,
                x.map(|life| [life, stress_of(life)]).to_vec(),
            ),
            curve(
                "band of the life",
                Tone::Stress,
                vec![[low, stress], [high, stress]],
            ),
        ],
        marks: vec![
            mark([1.0, 1.0], Tone::Film, smooth.to_owned()),
            mark(
                [life.stress_factor, stress],
                Tone::Second,
                "peaks and traction".to_owned(),
            ),
            mark(
                [life.life_relative, stress],
                Tone::Now,
                format!("with cycles × {}", sig(life.cycle_factor, 3)),
            ),
        ],
    })
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "tests")]
    use super::*;
    use asperity_engine::scene::LifeModel;

    #[test]
    fn pairs_are_rainflows_and_lie_on_the_path() {
        // ASTM E1049-85's example as a history: its widest cycle spans -4 to 5 in our sign.
        let stress = [0.0, 2.0, 1.0, 5.0, 0.0, 3.0, 1.5, 4.0, 0.0];
        let path: Vec<[f64; 2]> = stress
            .iter()
            .enumerate()
            .map(|(k, s)| [*s, k as f64])
            .collect();
        let found = pairs(&path, 0.1);
        // 0 to 5, then 0 to 4; within them 1.5 to 3 and 1 to 2.
        let ranges: Vec<f64> = found.iter().map(|[low, high]| high[0] - low[0]).collect();
        assert_eq!(ranges, [5.0, 4.0, 1.5, 1.0]);
        assert_eq!(found[0][1], [5.0, 3.0]);
        assert!(
            pairs(&path, 1.2).len() == 3,
            "smaller ones do not pass the gate"
        );
        assert!(pairs(&[], 0.1).is_empty());
    }

    #[test]
    fn the_exponent_is_the_models() {
        let life = |model| Life {
            model,
            stress_exponent: 10.0,
            weibull_slope: 2.0,
            ..Life::default()
        };
        assert_eq!(stress_exponent(&life(LifeModel::Zaretsky)), Some(10.0));
        assert_eq!(
            stress_exponent(&life(LifeModel::LundbergPalmgren)),
            Some(5.0)
        );
        let limited = Life {
            limit_pa: 4e8,
            ..life(LifeModel::IoannidesHarris)
        };
        assert_eq!(stress_exponent(&limited), None);
    }

    #[test]
    fn a_smooth_contact_lies_on_its_line() {
        let scene = Scene::load("demonstration").unwrap();
        let mut frame = Frame::default();
        frame.metrics.life = Some(asperity_engine::sim::LifeEstimate {
            life_relative: 0.08,
            life_relative_low: 0.07,
            life_relative_high: 0.09,
            stress_factor: 0.1,
            cycle_factor: 0.8,
            ..Default::default()
        });
        let plot = sn_point(&scene, &frame, false).unwrap();
        let exponent = stress_exponent(&Life::default()).unwrap();
        let [smooth, stressed, counted] = [0, 1, 2].map(|k| plot.marks[k].at);
        assert_eq!(smooth, [1.0, 1.0]);
        assert!((stressed[1].powf(-exponent) - 0.1).abs() < 1e-12);
        assert_eq!(counted, [0.08, stressed[1]]);
        for mark in &plot.marks {
            assert!(plot.x.share(mark.at[0]).is_some() && plot.y.share(mark.at[1]).is_some());
        }
    }
}
