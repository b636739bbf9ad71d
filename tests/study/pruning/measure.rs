//! The same run twice: as planned, and with one stage forced in.

use super::force::Forced;
use asperity_engine::plan::Plan;
use asperity_engine::scene::Scene;
use asperity_engine::sim::{Frame, Simulation, Stage};
use asperity_engine::solve::stress::{StressEngine, StressSpec, Symmetry};

/// Film that counts as one, m: the solver's own least film.
const LEAST_FILM_M: f64 = 1e-9;

/// What a run left.
pub(super) struct Ran {
    frame: Frame,
    stress_factor: Option<f64>,
}

/// How a run's frames are filled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Frames {
    /// At the end only.
    Last,
    /// Every so many steps.
    Every(u64),
}

/// Differences of two runs, relative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Difference {
    /// Σ|Δp|/Σp of the last step.
    pub(super) pressure: f64,
    /// Σ|Δh|/Σh inside the Hertz ellipse, films counted as a nanometre at least (what is thinner is not resolved).
    pub(super) film: f64,
    /// |Δ ln| of life's stress factor, where there is one in both. The cycle factor is a formula of the scene: waves of
    /// no height have crests, too.
    pub(super) life: Option<f64>,
}

impl Difference {
    /// The greatest of them.
    pub(super) fn greatest(&self) -> f64 {
        self.pressure.max(self.film).max(self.life.unwrap_or(0.0))
    }
}

/// A stage of a scene: what leaving it out changes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PruningRow {
    /// Preset.
    pub(super) preset: String,
    /// Stage.
    pub(super) stage: Forced,
    /// What it changes, or why the run with it did not finish.
    pub(super) found: Result<Difference, String>,
}

impl PruningRow {
    /// Whether leaving it out changes no more than it may.
    pub(super) fn is_harmless(&self) -> bool {
        self.found
            .as_ref()
            .is_ok_and(|difference| difference.greatest() <= self.stage.allowed().0)
    }
}

/// The run as planned.
pub(super) fn plain(scene: &Scene, plan: &Plan) -> Result<Ran, String> {
    run(scene, plan, cadence(plan))
}

fn cadence(plan: &Plan) -> Frames {
    plan.record
        .map_or(Frames::Last, |record| Frames::Every(record.every_steps))
}

/// The run with a stage forced in, against the plain one; `None` where the scene does not leave it out.
pub(super) fn forced(
    preset: &str,
    stage: Forced,
    (scene, plan): (&Scene, &Plan),
    base: &Ran,
) -> Option<PruningRow> {
    let (other_scene, other_plan) = stage.apply(scene, plan)?;
    let least_m = match stage {
        // Against no film at all its own thickness tells nothing: against the Hertz contact's depth.
        Forced::Film => plan.hertz.a_m * plan.hertz.a_m / scene.contact.rx_m,
        _ => LEAST_FILM_M,
    };
    let found = if stage == Forced::DeepWaves {
        deep_waves(scene, plan, base)
    } else {
        let frames = if stage == Forced::EveryFrame {
            Frames::Every(1)
        } else {
            cadence(plan)
        };
        let mut other = run(&other_scene, &other_plan, frames);
        if let (Forced::Waves, Ok(other)) = (stage, &mut other) {
            // Crests of no height still count, and may make the other body the weaker one.
            other.stress_factor = None;
        }
        other.map(|other| difference(base, &other, least_m))
    };
    Some(PruningRow {
        preset: preset.to_owned(),
        stage,
        found,
    })
}

fn run(scene: &Scene, plan: &Plan, frames: Frames) -> Result<Ran, String> {
    let mut sim = Simulation::new(scene, plan.clone(), 1).map_err(|error| error.to_string())?;
    let mut frame = Frame::default();
    while !sim.is_done() {
        sim.step().map_err(|error| error.to_string())?;
        if let Frames::Every(every) = frames
            && sim.stage() == Stage::Passage
            && sim.passage_steps().is_multiple_of(every)
        {
            sim.fill(&mut frame);
        }
    }
    sim.fill(&mut frame);
    Ok(Ran {
        frame,
        stress_factor: sim.summary().stress_factor,
    })
}

fn difference(one: &Ran, two: &Ran, least_m: f64) -> Difference {
    let apart = |a: &[f32], b: &[f32], least: f64, counts: &dyn Fn(usize) -> bool| {
        let (mut off, mut all) = (0.0, 0.0);
        for (_, (a, b)) in a.iter().zip(b).enumerate().filter(|(n, _)| counts(*n)) {
            off += f64::from((a - b).abs());
            all += f64::from(a.abs()).max(least);
        }
        off / all.max(f64::MIN_POSITIVE)
    };
    let frame = &one.frame;
    let inside = |n: usize| {
        let x = (frame.x_min_m + (n % frame.nx) as f64 * frame.dx_m) / frame.a_m;
        let y = (frame.y_min_m + (n / frame.nx) as f64 * frame.dy_m) / frame.b_m;
        x * x + y * y < 1.0
    };
    Difference {
        pressure: apart(&frame.pressure_pa, &two.frame.pressure_pa, 0.0, &|_| true),
        film: apart(&frame.film_m, &two.frame.film_m, least_m, &inside),
        life: one
            .stress_factor
            .zip(two.stress_factor)
            .map(|(one, two)| (one / two).ln().abs()),
    }
}

/// The life integral of the last pressure with all waves in every layer against the truncated one.
fn deep_waves(scene: &Scene, plan: &Plan, base: &Ran) -> Result<Difference, String> {
    /// ε that keeps what single precision can hold.
    const ALL_WAVES: f64 = 1e-8;
    let frame = &base.frame;
    let (p_h, a_m) = (frame.p_hertz_pa as f32, frame.a_m);
    let p: Vec<f32> = frame.pressure_pa.iter().map(|p| p / p_h).collect();
    let stress = plan.stress.ok_or("no stress")?;
    let mut spec = StressSpec::new(
        (frame.nx, frame.ny),
        (frame.dx_m / a_m, frame.dy_m / a_m),
        scene.body_1.poisson,
        (stress.depths, stress.depth_max_m / a_m),
        Symmetry::General,
    );
    let exponent = scene
        .life
        .as_ref()
        .map_or(10.0, |life| life.stress_exponent * life.weibull_slope);
    let mut ln_integral = |decay: f64| {
        spec.decay = decay;
        let mut engine = StressEngine::new(&spec).map_err(|error| error.to_string())?;
        engine.load(&p, None);
        Ok::<f64, String>(engine.volume(exponent).normal.ln)
    };
    let (truncated, whole) = (ln_integral(StressSpec::DECAY)?, ln_integral(ALL_WAVES)?);
    Ok(Difference {
        pressure: 0.0,
        film: 0.0,
        life: Some((truncated - whole).abs()),
    })
}
