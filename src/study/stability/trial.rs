//! One run of a case: every step judged, every field looked at, the work limited.

use std::time::Instant;

use super::case::{JUMP_AT, Ready};
use asperity_engine::math::number::fixed;
use asperity_engine::plan::{TimeDependence, sizing_rule};
use asperity_engine::scene::ContactKind;
use asperity_engine::sim::{Frame, Simulation, Stage, Stats};

/// Linear iterations and steps that a case may take.
const MOST_LINEAR: u64 = 400_000;
const MOST_STEPS: u64 = 20_000;
/// Deepest overlap of a converged contact, nm: `tests/engine/ladder.rs` says why.
const OVERLAP_NM: f64 = 0.5;
/// Central film of the smooth start-up over the regression, where the mesh carries it. The regression itself
/// lies 7 to 13 % below computed films for heavy loads, and knows neither Roelands' law nor compression.
const FILM_BAND: std::ops::RangeInclusive<f64> = 0.5..=1.6;
/// Error by the mesh or, where they are longer than a node, the steps, up to which the film is compared.
const MESH_GOOD: f64 = 0.25;
/// Greatest pressure of the smooth start-up over Hertz's, where the film is thin: the dry limit within a mesh.
const PEAK_BAND: std::ops::RangeInclusive<f64> = 0.85..=1.35;
/// H_c = h_c Rx/a² below which the pressure is nearly Hertz's.
const THIN_FILM: f64 = 0.1;

/// How a case ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TrialEnd {
    /// Every step converged and what came out is sane.
    Converged,
    /// It ran through, and so many steps did not converge; each is named by the run.
    Unconverged(u64),
    /// The run ended by name.
    Failed(String),
    /// The scene or its plan was refused by name.
    Refused(String),
    /// The work limit was reached.
    OutOfWork(String),
    /// Steps were called converged and what came out is wrong: a quiet failure, which must not be.
    Quiet(String),
}

impl TrialEnd {
    /// Whether all is well.
    pub fn is_converged(&self) -> bool {
        *self == Self::Converged
    }

    /// Whether it converged or says why not.
    pub fn is_converged_or_named(&self) -> bool {
        !matches!(self, Self::Quiet(_))
    }

    /// In words.
    pub fn text(&self) -> String {
        match self {
            Self::Converged => "converged".to_owned(),
            Self::Unconverged(steps) => format!("{steps} steps not converged"),
            Self::Failed(reason) => reason.clone(),
            Self::Refused(reason) => format!("refused: {reason}"),
            Self::OutOfWork(limit) => format!("work limit: {limit}"),
            Self::Quiet(what) => format!("QUIET FAILURE: {what}"),
        }
    }
}

/// What a run showed.
#[derive(Debug, Clone, PartialEq)]
pub struct Trial {
    /// How it ended.
    pub ending: TrialEnd,
    /// Steps of the passage.
    pub steps: u64,
    /// Worst relative change of pressure.
    pub residual: f64,
    /// Worst load error.
    pub load_error: f64,
    /// Worst mass error.
    pub mass_error: f64,
    /// Least pressure over Hertz's.
    pub p_min: f64,
    /// Greatest pressure over Hertz's, in the passage.
    pub p_max: f64,
    /// Least film, nm.
    pub h_min_nm: f64,
    /// Central film of the smooth start-up over the regression; `None`: dry.
    pub film_ratio: Option<f64>,
    /// Values that are no number.
    pub not_finite: u64,
    /// Work.
    pub stats: Stats,
    /// Time taken, s.
    pub seconds: f64,
}

impl Trial {
    /// A case that did not come to a run.
    pub(super) fn refused(reason: String) -> Self {
        Self {
            ending: TrialEnd::Refused(reason),
            steps: 0,
            residual: 0.0,
            load_error: 0.0,
            mass_error: 0.0,
            p_min: 0.0,
            p_max: 0.0,
            h_min_nm: f64::INFINITY,
            film_ratio: None,
            not_finite: 0,
            stats: Stats::default(),
            seconds: 0.0,
        }
    }
}

/// Runs a case on one thread.
pub(super) fn run(ready: &Ready) -> Trial {
    let clock = Instant::now();
    let mut trial = Trial::refused(String::new());
    let sim = Simulation::new(&ready.scene, ready.plan.clone(), 1);
    match sim {
        Ok(mut sim) => {
            let mut watch = TrialWatch::default();
            let end = drive(&mut sim, ready, &mut trial, &mut watch);
            trial.steps = sim.passage_steps();
            trial.stats = *sim.stats();
            trial.ending = watch.judge(end, &mut trial, ready);
        }
        Err(error) => trial.ending = TrialEnd::Refused(error.to_string()),
    }
    trial.seconds = clock.elapsed().as_secs_f64();
    trial
}

/// Where surfaces run into each other.
#[derive(Debug, Clone, Copy)]
struct Overlap {
    depth_nm: f64,
    /// Place in half-widths of the contact.
    at: [f64; 2],
    at_edge: bool,
}

impl Overlap {
    fn of(frame: &Frame) -> Option<Self> {
        let films = frame.film_m.iter().enumerate();
        let (node, h) = films.min_by(|(_, one), (_, two)| one.total_cmp(two))?;
        let (i, j) = (node % frame.nx, node / frame.nx);
        let x = (frame.x_min_m + i as f64 * frame.dx_m) / frame.a_m;
        let y = (frame.y_min_m + j as f64 * frame.dy_m) / frame.b_m;
        let edge_x = i == 0 || i + 1 == frame.nx;
        // A line's rows are all alike: none of them is an edge.
        let edge_y = frame.kind == ContactKind::Point && (j == 0 || j + 1 == frame.ny);
        Some(Self {
            depth_nm: -1e9 * f64::from(*h),
            at: [x, y],
            at_edge: edge_x || edge_y,
        })
    }
}

/// What is seen on the way.
#[derive(Debug, Default)]
struct TrialWatch {
    frame: Frame,
    unconverged: u64,
    negative: u64,
    /// Deepest overlap of a converged step.
    overlap: Option<Overlap>,
    /// Central film, m, and greatest pressure over Hertz's of the smooth start-up.
    smooth: Option<(f64, f64)>,
    /// The first thing that a converged step should not have.
    wrong: Option<String>,
}

/// Steps to the end of the passage; the reason where there is none.
fn drive(
    sim: &mut Simulation,
    ready: &Ready,
    trial: &mut Trial,
    watch: &mut TrialWatch,
) -> Result<(), TrialEnd> {
    let wanted = steps_wanted(ready);
    let jump_at = (JUMP_AT * wanted as f64) as u64;
    let mut jumps = ready.jumps.clone();
    let adaptive = ready.plan.step_tolerance.is_some();
    loop {
        let done = sim.passage_steps();
        let finished = if adaptive {
            sim.is_done()
        } else {
            done >= wanted
        };
        if finished {
            return Ok(());
        }
        if sim.stage() == Stage::Passage && done >= jump_at {
            for (knob, value) in jumps.drain(..) {
                let turned = sim.set(knob, value);
                turned.map_err(|error| TrialEnd::Refused(error.to_string()))?;
            }
        }
        let stats = sim.stats();
        if stats.linear_iterations > MOST_LINEAR || stats.steps > MOST_STEPS {
            return Err(TrialEnd::OutOfWork(format!(
                "{} steps and {} linear iterations",
                stats.steps, stats.linear_iterations
            )));
        }
        if let Err(error) = sim.step() {
            return Err(TrialEnd::Failed(error.to_string()));
        }
        watch.see(sim, ready, trial);
    }
}

/// Steps of the passage: a steady scene that nobody disturbs needs one.
fn steps_wanted(ready: &Ready) -> u64 {
    let steady = matches!(ready.plan.time_dependence, TimeDependence::Steady { .. });
    if steady && ready.jumps.is_empty() {
        1
    } else {
        let passages = ready.scene.time.most_passages();
        (passages * ready.plan.steps_per_passage as f64).ceil() as u64
    }
}

impl TrialWatch {
    fn see(&mut self, sim: &Simulation, ready: &Ready, trial: &mut Trial) {
        sim.fill(&mut self.frame);
        let (frame, metrics) = (&self.frame, sim.metrics());
        trial.residual = trial.residual.max(metrics.residual);
        trial.load_error = trial.load_error.max(metrics.load_error);
        trial.mass_error = trial.mass_error.max(metrics.mass_error);
        let fields = [&frame.pressure_pa, &frame.film_m, &frame.traction_pa];
        let bad = fields.map(|field| field.iter().filter(|v| !v.is_finite()).count());
        trial.not_finite += bad.iter().sum::<usize>() as u64;
        self.negative += frame.pressure_pa.iter().filter(|p| **p < 0.0).count() as u64;
        let scale = frame.p_hertz_pa;
        let least = |field: &[f32]| field.iter().copied().fold(f32::INFINITY, f32::min);
        trial.p_min = trial
            .p_min
            .min(f64::from(least(&frame.pressure_pa)) / scale);
        let h_min_nm = 1e9 * f64::from(least(&frame.film_m));
        trial.h_min_nm = trial.h_min_nm.min(h_min_nm);
        if metrics.converged {
            let deepest = self.overlap.map_or(OVERLAP_NM, |overlap| overlap.depth_nm);
            if -h_min_nm > deepest {
                self.overlap = Overlap::of(frame);
            }
            let tolerance = ready.scene.numerics.tolerance;
            if self.wrong.is_none() && metrics.residual > tolerance {
                let residual = metrics.residual;
                self.wrong = Some(format!("a converged step of residual {residual:.1e}"));
            }
        } else {
            self.unconverged += 1;
        }
        let p_max = metrics.p_max_pa / scale;
        let resting = [
            metrics.amplitude_1_m,
            metrics.amplitude_2_m,
            metrics.slide_roll,
        ];
        if sim.stage() == Stage::Passage {
            trial.p_max = trial.p_max.max(p_max);
        }
        let at_rest = resting.iter().all(|value| *value == 0.0);
        if sim.stage() == Stage::StartUp && at_rest && frame.nx == ready.plan.domain.nodes {
            self.smooth = Some((metrics.h_central_m, p_max));
        }
    }

    /// The ending: sane results only are called converged.
    fn judge(self, end: Result<(), TrialEnd>, trial: &mut Trial, ready: &Ready) -> TrialEnd {
        let film = ready.plan.film.as_ref();
        trial.film_ratio = film
            .zip(self.smooth)
            .map(|(film, (h, _))| h / film.central_m);
        if trial.not_finite > 0 {
            return TrialEnd::Quiet(format!("{} values are not numbers", trial.not_finite));
        }
        if self.negative > 0 {
            return TrialEnd::Quiet(format!("{} negative pressures", self.negative));
        }
        if let Some(overlap) = self.overlap {
            return TrialEnd::Quiet(format!(
                "surfaces overlap by {} nm at x = {:.2} a, y = {:.2} b{}",
                fixed(overlap.depth_nm, 2),
                overlap.at[0],
                overlap.at[1],
                if overlap.at_edge {
                    ", the edge of the domain"
                } else {
                    ""
                }
            ));
        }
        if let Some(wrong) = self.wrong {
            return TrialEnd::Quiet(wrong);
        }
        if let Err(ending) = end {
            return ending;
        }
        if self.unconverged > 0 {
            return TrialEnd::Unconverged(self.unconverged);
        }
        insane(ready, self.smooth, trial.film_ratio).map_or(TrialEnd::Converged, TrialEnd::Quiet)
    }
}

/// The smooth start-up against the regression film and the dry limit.
fn insane(ready: &Ready, smooth: Option<(f64, f64)>, film_ratio: Option<f64>) -> Option<String> {
    let (_, peak) = smooth?;
    let plan = &ready.plan;
    let film = plan.film.as_ref();
    let length = plan.domain.dx_a() * ready.scene.time.step_nodes.max(1.0);
    let mesh = film.map(|film| sizing_rule(plan.kind, film.central, length));
    if let Some(ratio) = film_ratio.filter(|_| mesh.is_some_and(|mesh| mesh < MESH_GOOD))
        && !FILM_BAND.contains(&ratio)
    {
        return Some(format!("smooth film {ratio:.2} of the regression"));
    }
    let thin = film.is_none_or(|film| film.central < THIN_FILM);
    if thin && !PEAK_BAND.contains(&peak) {
        return Some(format!("smooth pressure {peak:.2} of Hertz's"));
    }
    None
}
