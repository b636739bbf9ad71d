//! How each stage that a plan may leave out is forced in, and which of them a scene leaves out.
//!
//! A plan is data that the simulation takes as given, so most stages are forced by changing the plan; the others by a
//! scene that means the same and that the plan does not see through (waves of no height, an Eyring stress that no film
//! reaches, oil too thin to carry anything). The rectangle stays the same.

use asperity_engine::plan::{Plan, Symmetry, TimeDependence, TractionDeflection};
use asperity_engine::scene::{Lubricant, Rheology, Scene, Spread, Surface};

/// A stage that may be left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Forced {
    /// Rows y < 0 of a contact that is even in y.
    WholeGrid,
    /// Deflection by traction between bodies of the same constants.
    TractionDeflection,
    /// Time steps of a contact in which nothing changes.
    TimeSteps,
    /// Waves of a smooth body.
    Waves,
    /// Shear thinning of a Newtonian oil.
    Rheology,
    /// Film and flow of a dry contact.
    Film,
    /// Stress and life that the scene does not ask for.
    Stress,
    /// Both life models and all variants, where one is asked for.
    Spread,
    /// Volume integrals at every step instead of in every phase.
    EveryVolume,
    /// A frame filled at every step instead of by the recording's cadence.
    EveryFrame,
    /// Waves in deep layers that have decayed there (the stress engine's own truncation).
    DeepWaves,
}

impl Forced {
    /// Every stage.
    pub(super) const ALL: [Self; 11] = [
        Self::WholeGrid,
        Self::TractionDeflection,
        Self::TimeSteps,
        Self::Waves,
        Self::Rheology,
        Self::Film,
        Self::Stress,
        Self::Spread,
        Self::EveryVolume,
        Self::EveryFrame,
        Self::DeepWaves,
    ];

    /// Name.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::WholeGrid => "rows y < 0",
            Self::TractionDeflection => "deflection by traction",
            Self::TimeSteps => "time steps",
            Self::Waves => "waves of a smooth body",
            Self::Rheology => "shear thinning",
            Self::Film => "film and flow",
            Self::Stress => "stress and life",
            Self::Spread => "other life models",
            Self::EveryVolume => "volume integral at every step",
            Self::EveryFrame => "frame at every step",
            Self::DeepWaves => "decayed waves in deep layers",
        }
    }

    /// Relative difference that leaving it out may make, and why.
    pub(super) fn allowed(self) -> (f64, &'static str) {
        match self {
            Self::WholeGrid | Self::TractionDeflection | Self::Waves => (
                2e-3,
                "twice the usual tolerance of a step: sums run in another order",
            ),
            Self::TimeSteps => (5e-3, "what the start-up had not settled"),
            Self::Rheology => (5e-3, "asinh at a large finite stress"),
            Self::Film => (
                2e-2,
                "the thin oil still carries a little; film against a²/R",
            ),
            Self::Stress | Self::Spread | Self::EveryFrame => {
                (0.0, "it is not looked at by the solver")
            }
            Self::EveryVolume => (0.05, "fewer phases in place of all, in life"),
            Self::DeepWaves => (
                1e-3,
                "ε = 1e-4 of the longest wave left out, in the integral",
            ),
        }
    }

    /// The same contact with the stage in; `None` where the scene does not leave it out. Stages of the study's own
    /// making ([`Self::EveryFrame`], [`Self::DeepWaves`]) come back unchanged.
    pub(super) fn apply(self, scene: &Scene, plan: &Plan) -> Option<(Scene, Plan)> {
        let mut scene = scene.clone();
        let mut plan = plan.clone();
        match self {
            Self::WholeGrid => {
                if plan.symmetry != Symmetry::MirrorY {
                    return None;
                }
                plan.symmetry = Symmetry::General;
            }
            Self::TractionDeflection => {
                if plan.traction_deflection.is_some() {
                    return None;
                }
                // Not 0, which the solver would leave out in its turn.
                let mismatch_per_pa = 1e-12 / scene.body_1.young_pa;
                plan.traction_deflection = Some(TractionDeflection { mismatch_per_pa });
            }
            Self::TimeSteps => {
                if !matches!(plan.time_dependence, TimeDependence::Steady { .. }) {
                    return None;
                }
                plan.time_dependence = TimeDependence::Transient;
                // Its start-up is shorter than that of a contact that is known to be steady: passages make up for it.
                let steps = 3.0 * plan.steps_per_passage as f64;
                plan.steps = steps.ceil() as u64;
            }
            Self::EveryVolume => {
                plan.life.as_mut()?.volume_every_steps = 1;
            }
            Self::EveryFrame => {
                plan.record.filter(|record| record.every_steps > 1)?;
            }
            Self::DeepWaves => {
                plan.stress?;
            }
            Self::Waves | Self::Rheology | Self::Film | Self::Stress | Self::Spread => {
                self.change(&mut scene)?;
                scene.grid.x_min_a = Some(plan.domain.x_min_a);
                scene.grid.x_max_a = Some(plan.domain.x_max_a);
                scene.grid.y_half_a = Some(plan.domain.y_half_b);
                let asked = Plan::new(&scene).ok()?;
                // What nobody forces stays left out.
                plan = Plan {
                    time_dependence: plan.time_dependence,
                    steps: plan.steps,
                    symmetry: plan.symmetry,
                    ..asked
                };
            }
        }
        Some((scene, plan))
    }

    /// Changes a scene that leaves the stage out.
    fn change(self, scene: &mut Scene) -> Option<()> {
        match self {
            Self::Waves => {
                let flat = |length_m: f64| Surface::Sinusoid {
                    amplitude_m: 0.0,
                    wavelength_x_m: length_m,
                    wavelength_y_m: f64::INFINITY,
                    angle_deg: 0.0,
                    phase_deg: 0.0,
                };
                let length_m = scene.hertz().a_m;
                let bodies = [&mut scene.body_1, &mut scene.body_2];
                let mut smooth = bodies.into_iter().filter(|body| body.surface.is_smooth());
                smooth.next()?.surface = flat(length_m);
            }
            Self::Rheology => {
                let oil = scene.lubricant.as_mut()?;
                if oil.rheology != Rheology::Newtonian {
                    return None;
                }
                oil.rheology = Rheology::Eyring;
                oil.eyring_stress_pa = 1e9;
            }
            Self::Film => {
                if scene.lubricant.is_some() {
                    return None;
                }
                scene.lubricant = Some(thinnest());
            }
            Self::Stress => {
                if scene.stress.is_some() {
                    return None;
                }
                scene.stress = Some(asperity_engine::scene::Stress::default());
                scene.life = Some(asperity_engine::scene::Life::default());
            }
            Self::Spread => {
                let life = scene.life.as_mut()?;
                if life.spread == Spread::Models {
                    return None;
                }
                life.spread = Spread::Models;
            }
            _ => return None,
        }
        Some(())
    }
}

/// An oil whose film is some nanometres where the contact is some micrometres deep. A thinner one would be no
/// continuum, and its steps do not converge.
fn thinnest() -> Lubricant {
    Lubricant {
        viscosity_pa_s: Some(1e-3),
        pressure_viscosity_per_pa: Some(0.0),
        vg: None,
        temperature_c: None,
        viscosity_index: None,
        viscosity_law: asperity_engine::scene::ViscosityLaw::Barus,
        density_law: asperity_engine::scene::DensityLaw::Incompressible,
        rheology: Rheology::Newtonian,
        eyring_stress_pa: 5e6,
        eyring_flow: asperity_engine::scene::EyringFlow::Secant,
        limiting_shear_ratio: 1.0,
        cavitation: asperity_engine::scene::Cavitation::Reynolds,
    }
}
