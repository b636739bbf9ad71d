//! The same run twice: as planned, and with one stage forced in.

use std::time::Instant;

use super::force::Forced;
use asperity_engine::plan::Plan;
use asperity_engine::scene::Scene;
use asperity_engine::sim::{Frame, Simulation, Stage, Stats};
use asperity_engine::solve::stress::{StressEngine, StressSpec, Symmetry};

/// Film that counts as one, m: the solver's own least film.
const LEAST_FILM_M: f64 = 1e-9;

/// What a run left.
pub(super) struct Ran {
    frame: Frame,
    stress_factor: Option<f64>,
    stats: Stats,
    pub(super) seconds: f64,
    timing: Timing,
}

/// How a run is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Timing {
    pub(super) threads: usize,
    /// Whether its time is told: then a short run is made twice, and the faster counts. They are alike in all but time.
    pub(super) is_timed: bool,
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

/// A stage of a preset: what leaving it out saves.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PruningRow {
    /// Preset.
    pub(super) preset: String,
    /// Stage.
    pub(super) stage: Forced,
    /// What it changes and costs, or why the run with it did not finish.
    pub(super) found: Result<Gain, String>,
}

/// What a stage that is left out would change and cost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Gain {
    /// What it changes.
    pub(super) difference: Difference,
    /// Time with the stage over time without.
    pub(super) time_ratio: f64,
    /// Linear iterations with over without.
    pub(super) work_ratio: f64,
    /// Transforms with over without.
    pub(super) transform_ratio: f64,
}

impl PruningRow {
    /// Whether leaving it out changes no more than it may.
    pub(super) fn is_harmless(&self) -> bool {
        self.found
            .as_ref()
            .is_ok_and(|gain| gain.difference.greatest() <= self.stage.allowed().0)
    }
}

/// The run as planned.
pub(super) fn plain(scene: &Scene, plan: &Plan, timing: Timing) -> Result<Ran, String> {
    run(scene, plan, timing, cadence(plan))
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
        let mut other = run(&other_scene, &other_plan, base.timing, frames);
        if let (Forced::Waves, Ok(other)) = (stage, &mut other) {
            // Crests of no height still count, and may make the other body the weaker one.
            other.stress_factor = None;
        }
        other.map(|other| gain(base, &other, least_m))
    };
    Some(PruningRow {
        preset: preset.to_owned(),
        stage,
        found,
    })
}

fn gain(base: &Ran, other: &Ran, least_m: f64) -> Gain {
    let ratio = |with: u64, without: u64| with as f64 / without.max(1) as f64;
    Gain {
        difference: difference(base, other, least_m),
        time_ratio: other.seconds / base.seconds,
        work_ratio: ratio(other.stats.linear_iterations, base.stats.linear_iterations),
        transform_ratio: ratio(other.stats.ffts, base.stats.ffts),
    }
}

fn run(scene: &Scene, plan: &Plan, timing: Timing, frames: Frames) -> Result<Ran, String> {
    /// s.
    const SHORT: f64 = 0.5;
    let one = run_once(scene, plan, timing, frames)?;
    if !timing.is_timed || one.seconds > SHORT {
        return Ok(one);
    }
    let two = run_once(scene, plan, timing, frames)?;
    Ok(if two.seconds < one.seconds { two } else { one })
}

fn run_once(scene: &Scene, plan: &Plan, timing: Timing, frames: Frames) -> Result<Ran, String> {
    let mut sim =
        Simulation::new(scene, plan.clone(), timing.threads).map_err(|error| error.to_string())?;
    let mut frame = Frame::default();
    let clock = Instant::now();
    while !sim.is_done() {
        sim.step().map_err(|error| error.to_string())?;
        if let Frames::Every(every) = frames
            && sim.stage() == Stage::Passage
            && sim.passage_steps().is_multiple_of(every)
        {
            sim.fill(&mut frame);
        }
    }
    let seconds = clock.elapsed().as_secs_f64();
    sim.fill(&mut frame);
    Ok(Ran {
        frame,
        stress_factor: sim.summary().stress_factor,
        stats: *sim.stats(),
        seconds,
        timing,
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

/// The life integral of the last pressure with all waves in every layer against the truncated one: relative
/// difference in the integral, and time of the one over the other.
fn deep_waves(scene: &Scene, plan: &Plan, base: &Ran) -> Result<Gain, String> {
    /// ε that keeps what single precision can hold.
    const ALL_WAVES: f64 = 1e-8;
    const REPEATS: u32 = 4;
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
    let mut measured = [(0.0, f64::INFINITY); 2];
    for (slot, decay) in measured.iter_mut().zip([StressSpec::DECAY, ALL_WAVES]) {
        spec.decay = decay;
        let mut engine = StressEngine::new(&spec).map_err(|error| error.to_string())?;
        engine.load(&p, None);
        for _ in 0..REPEATS {
            let clock = Instant::now();
            let ln = engine.volume(exponent).normal.ln;
            *slot = (ln, slot.1.min(clock.elapsed().as_secs_f64()));
        }
    }
    let [(truncated, quick), (whole, slow)] = measured;
    Ok(Gain {
        difference: Difference {
            pressure: 0.0,
            film: 0.0,
            life: Some((truncated - whole).abs()),
        },
        time_ratio: slow / quick,
        work_ratio: 1.0,
        transform_ratio: 1.0,
    })
}
