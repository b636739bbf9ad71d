//! The scaling between SI and the dimensionless solver: the one place where it is done.
//!
//! ```text
//! X = x/a, Y = y/a, P = p/p_h, H = h Rx/a², T = t U/a      a, b, p_h: Hertz at the scene's load
//! λ = 12 η0 U Rx²/(a³ p_h)   κ = 2 p_h Rx/(π E' a)   load = w/(p_h a²)   Z = η0 |U2−U1| Rx/(τ0 a²)
//! line: a is its half-width, w a load per length, load = w/(p_h a)
//! ```
//! The scaling is fixed for a whole run: when a knob changes the load or the speed, λ, Z and the load
//! integral change, not a or p_h.

use crate::physics::fluid::{Density, ShearedFlow, Viscosity};
use crate::physics::hertz::Hertz;
use crate::scene::Knob;
use crate::scene::{ContactKind, EyringFlow, Rheology, Scene};
use crate::solve::reynolds::Medium;

/// The direction in which the oil flows. Everything dimensionless is solved with the flow along +x; a scene that flows
/// towards −x is solved as its mirror image, ξ = −x, and mirrored back where numbers leave: places, fields,
/// and the sign of shear along x.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Heading {
    /// Towards +x.
    Forward,
    /// Towards −x.
    Backward,
}

impl Heading {
    /// +1 or −1.
    pub(super) fn sign(self) -> f64 {
        match self {
            Self::Forward => 1.0,
            Self::Backward => -1.0,
        }
    }
}

/// Scales and constants of one scene.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Scaling {
    /// Point or line.
    pub(super) kind: ContactKind,
    /// The direction in which the oil flows.
    pub(super) heading: Heading,
    /// Half-width along x, m.
    pub(super) a_m: f64,
    /// Maximum Hertz pressure, Pa.
    pub(super) p_hertz_pa: f64,
    /// Film unit a²/Rx, m.
    pub(super) film_m: f64,
    /// κ.
    pub(super) kappa: f64,
    /// Rx/Ry.
    pub(super) curvature_y: f64,
    /// Ellipse half-widths over a; 1 for a line, which has none along y.
    pub(super) b_over_a: f64,
    /// λ per m/s of entrainment; 0 in a dry scene.
    lambda_s_m: f64,
    /// Z per m/s of sliding.
    sliding_s_m: f64,
    sheared: ShearedFlow,
    viscosity: Viscosity,
    density: Density,
}

impl Scaling {
    /// The scaling of `scene`.
    pub(super) fn new(scene: &Scene) -> Self {
        let hertz: Hertz = scene.hertz();
        let (a, p) = (hertz.a_m, hertz.p_max_pa);
        let rx = scene.contact.rx_m;
        let mut scaling = Self {
            kind: scene.kind(),
            heading: if scene.motion.entrainment_m_s < 0.0 {
                Heading::Backward
            } else {
                Heading::Forward
            },
            a_m: a,
            p_hertz_pa: p,
            film_m: a * a / rx,
            kappa: 2.0 * p * rx / (std::f64::consts::PI * scene.e_prime_pa() * a),
            curvature_y: rx / scene.ry_m(),
            b_over_a: match scene.kind() {
                ContactKind::Point => hertz.b_m / a,
                ContactKind::Line => 1.0,
            },
            lambda_s_m: 0.0,
            sliding_s_m: 0.0,
            sheared: ShearedFlow::Secant,
            viscosity: Viscosity::barus(0.0, p),
            density: Density::Incompressible,
        };
        if let Some(oil) = &scene.lubricant {
            let (eta, alpha) = (oil.viscosity_pa_s(), oil.pressure_viscosity_per_pa());
            scaling.lambda_s_m = 12.0 * eta * rx * rx / (a.powi(3) * p);
            scaling.viscosity = oil.viscosity_law.scaled(eta, alpha, p);
            scaling.density = oil.density_law.scaled(p);
            match oil.rheology {
                Rheology::Newtonian => {}
                Rheology::Eyring => {
                    scaling.sliding_s_m = eta * rx / (oil.eyring_stress_pa * a * a);
                    scaling.sheared = match oil.eyring_flow {
                        EyringFlow::Secant => ShearedFlow::Secant,
                        EyringFlow::AlongAcross => ShearedFlow::AlongAcross {
                            limit: oil.limiting_shear_ratio * p / oil.eyring_stress_pa,
                            steepness: 0.5 * a * p / (rx * oil.eyring_stress_pa),
                        },
                    };
                }
            }
        }
        scaling
    }

    /// The fluid at entrainment speed `u_m_s` and slide-to-roll ratio `s`; a dry scene has λ = ∞: no flow.
    pub(super) fn medium(&self, u_m_s: f64, s: f64) -> Medium {
        Medium {
            viscosity: self.viscosity,
            density: self.density,
            lambda: if self.lambda_s_m > 0.0 {
                self.lambda_s_m * u_m_s
            } else {
                f64::INFINITY
            },
            sliding: self.sliding_s_m * (s * u_m_s).abs(),
            sheared: self.sheared,
        }
    }

    /// The fluid of a step without flow: λ = ∞.
    pub(super) fn medium_at_rest(&self) -> Medium {
        Medium::newtonian(self.viscosity, self.density, f64::INFINITY)
    }

    /// Load integral of a force, N (a line: N/m).
    pub(super) fn load(&self, force: f64) -> f64 {
        let width_m = match self.kind {
            ContactKind::Point => self.a_m,
            ContactKind::Line => 1.0,
        };
        force / (self.p_hertz_pa * self.a_m * width_m)
    }

    /// The knob of the load.
    pub(super) fn load_knob(&self) -> Knob {
        Knob::of_load(self.kind)
    }

    /// a and p_h when the load is `ratio` times the scene's, over those at the scene's: Hertz.
    pub(super) fn size_ratio(&self, ratio: f64) -> f64 {
        self.kind.size_ratio(ratio)
    }

    /// Pressure, Pa.
    pub(super) fn pa_from_p(&self, p: f64) -> f64 {
        p * self.p_hertz_pa
    }

    /// Dimensionless pressure.
    pub(super) fn p_from_pa(&self, pa: f64) -> f64 {
        pa / self.p_hertz_pa
    }

    /// Volume of ∬ h, m³; of a line m³ per metre of length.
    pub(super) fn m3_from_volume(&self, volume: f64) -> f64 {
        let width_m = match self.kind {
            ContactKind::Point => self.a_m,
            ContactKind::Line => 1.0,
        };
        volume * self.film_m * self.a_m * width_m
    }

    /// Film, m.
    pub(super) fn m_from_h(&self, h: f64) -> f64 {
        h * self.film_m
    }

    /// Dimensionless film.
    pub(super) fn h_from_m(&self, h_m: f64) -> f64 {
        h_m / self.film_m
    }

    /// Place along x, m.
    pub(super) fn place_m(&self, x: f64) -> f64 {
        self.heading.sign() * self.m_from_x(x)
    }

    /// Length along the surface, m.
    pub(super) fn m_from_x(&self, x: f64) -> f64 {
        x * self.a_m
    }

    /// Heat of a pressure flow of power τ |∇P|² = 1 (`reynolds.rs`) at entrainment speed `u_m_s`, W/m².
    pub(super) fn flow_heat_w_m2(&self, u_m_s: f64) -> f64 {
        self.film_m * self.p_hertz_pa * u_m_s / self.a_m
    }

    /// κ_s of the deflection by traction, from the mismatch of the materials, 1/Pa.
    pub(super) fn kappa_s(&self, mismatch_per_pa: f64) -> f64 {
        self.p_hertz_pa * self.a_m / self.film_m * mismatch_per_pa / std::f64::consts::TAU
    }
}
