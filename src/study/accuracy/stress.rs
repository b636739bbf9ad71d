//! Stress under a Hertz pressure: slice, volume, life integral.
//!
//! Closed forms: the whole field under a sliding Hertz pressure ([`hertz_sliding`]), the maximum von Mises stress on
//! the axis ([`hertz_axis_maximum`]), and ∫ σ^10 dV = 2.878184e-3 p_h^10 a³ (ν = 0.3, by quadrature of the closed
//! field). The stress engine works in single precision.

use super::super::StudyError;
use super::series::{Against, Measured, Part, Series, Varied, timed};
use asperity_engine::physics::stress_exact::{hertz_axis_maximum, hertz_sliding};
use asperity_engine::solve::stress::{SliceOut, StressEngine, StressSpec, Symmetry};

const POISSON: f64 = 0.3;
const FRICTION: f64 = 0.1;
const EXPONENT: f64 = 10.0;
const INTEGRAL: f64 = 2.878184e-3;
/// Half of the domain, a.
const HALF: f64 = 2.0;
/// Depths from which the slice is compared: above them the edge of the sampled pressure rules.
const FROM_DEPTH: f64 = 0.25;

/// What an engine is made for.
#[derive(Debug, Clone, Copy)]
struct EngineSetting {
    intervals: usize,
    depths: usize,
    decay: f64,
}

const USUAL: EngineSetting = EngineSetting {
    intervals: 128,
    depths: 32,
    decay: StressSpec::DECAY,
};

impl EngineSetting {
    fn measured<const N: usize>(self, values: [f64; N], seconds: f64) -> Measured<N> {
        Measured {
            values,
            seconds,
            work: (self.depths * self.intervals * self.intervals) as u64,
        }
    }
}

struct LoadedCase {
    engine: StressEngine,
    p: Vec<f32>,
    q: Vec<f32>,
}

fn loaded(setting: EngineSetting) -> Result<LoadedCase, String> {
    let d = 2.0 * HALF / setting.intervals as f64;
    let shape = (setting.intervals + 1, setting.intervals / 2 + 1);
    let mut spec = StressSpec::new(
        shape,
        (d, d),
        POISSON,
        (setting.depths, 3.0),
        Symmetry::MirrorY,
    );
    (spec.x_first, spec.decay) = (-HALF, setting.decay);
    let p: Vec<f32> = (0..spec.nx * spec.ny)
        .map(|at| {
            let x = spec.x_first + d * (at % spec.nx) as f64;
            let y = d * (at / spec.nx) as f64;
            (1.0 - x * x - y * y).max(0.0).sqrt() as f32
        })
        .collect();
    let q = p.iter().map(|p| p * FRICTION as f32).collect();
    let engine = StressEngine::new(&spec).map_err(|error| error.to_string())?;
    Ok(LoadedCase { engine, p, q })
}

/// Worst error of any component in the plane y = 0 from a quarter of a half-width down.
fn slice(setting: EngineSetting) -> Result<Measured<1>, String> {
    let LoadedCase { mut engine, p, q } = loaded(setting)?;
    let mut out = SliceOut::new(engine.spec());
    let ((), seconds) = timed(|| {
        engine.load(&p, Some(&q));
        engine.slice(&mut out);
    });
    let spec = engine.spec();
    let mut worst: f64 = 0.0;
    for (k, &z) in spec.depths.iter().enumerate() {
        for i in 0..spec.nx {
            let x = spec.x_first + spec.dx * i as f64;
            if x.abs() <= 1.5 && z >= FROM_DEPTH {
                let exact = hertz_sliding(x, 0.0, z, POISSON, FRICTION);
                worst = worst.max(exact.distance(out.state(k * spec.nx + i)));
            }
        }
    }
    Ok(setting.measured([worst], seconds))
}

/// The maximum von Mises stress and the life integral, from one volume.
fn volume(setting: EngineSetting) -> Result<Measured<2>, String> {
    let LoadedCase { mut engine, p, .. } = loaded(setting)?;
    let (out, seconds) = timed(|| {
        engine.load(&p, None);
        engine.volume(EXPONENT)
    });
    // The maximum of a volume is that of its samples, which no sum looks at; the refined one is the slice's.
    let mut slice = SliceOut::new(engine.spec());
    engine.slice(&mut slice);
    let (_, maximum) = hertz_axis_maximum(POISSON);
    let errors = [
        slice.peak.value / maximum - 1.0,
        out.normal.ln.exp() / INTEGRAL - 1.0,
    ];
    Ok(setting.measured(errors.map(f64::abs), seconds))
}

/// All three over nodes, depths and ε.
pub(super) fn stress(intervals: &[f64]) -> Result<Vec<Series>, StudyError> {
    let of_slice = Part {
        name: "stress slice",
        quantities: ["worst component, z > a/4"],
        against: Against::ClosedForm,
        work_unit: "node depths",
    };
    let of_volume = Part {
        name: "stress volume",
        quantities: ["maximum von Mises", "life integral, m = 10"],
        against: Against::ClosedForm,
        work_unit: "node depths",
    };
    let nodes: Vec<f64> = intervals.iter().map(|n| n + 1.0).collect();
    let at_nodes = |nodes: f64| EngineSetting {
        intervals: nodes as usize - 1,
        ..USUAL
    };
    let at_depths = |depths: f64| EngineSetting {
        depths: depths as usize,
        ..USUAL
    };
    let at_decay = |decay: f64| EngineSetting { decay, ..USUAL };
    let [n, depths, decay] = [
        format!("N {}", USUAL.intervals + 1),
        format!("{} depths", USUAL.depths),
        format!("epsilon {:e}", USUAL.decay),
    ];
    let decays = [1e-2, 1e-3, 1e-4, 1e-6, 1e-8];
    let layers = [8.0, 12.0, 16.0, 24.0, 32.0, 48.0];
    let rests = [
        format!("{depths}, {decay}"),
        format!("{n}, {decay}"),
        format!("{n}, {depths}"),
    ];
    let mut series = of_slice.over(Varied::Nodes, &nodes, &rests[0], |n| slice(at_nodes(n)))?;
    series.extend(of_slice.over(Varied::Decay, &decays, &rests[2], |e| slice(at_decay(e)))?);
    series.extend(of_volume.over(Varied::Nodes, &nodes, &rests[0], |n| volume(at_nodes(n)))?);
    series.extend(of_volume.over(Varied::Depths, &layers, &rests[1], |d| volume(at_depths(d)))?);
    series.extend(of_volume.over(Varied::Decay, &decays, &rests[2], |e| volume(at_decay(e)))?);
    Ok(series)
}
