//! What leaving heat out costs a scene, by closed forms: no simulation.
//!
//! ```text
//! friction    μ = ∫ τ dA/∫ p dA over Hertz's pressure p = p_h √(1 − r²), film by regression (Moes; Nijenbanning et al.)
//! cold        τ = min(τ0 asinh(η(p) |U2 − U1|/(h τ0)), γp)
//! warm        the same of a film that its own heat thins (`physics/thinning.rs`) between walls ⅔ of Blok's temperature warmer
//! film        Wilson & Sheu's factor: at S = 0, and with what it says of sliding
//! ```
//! An oil that does not say how it thins is taken for Roelands' with S0 = 1.1, bodies that say nothing for steel.
//! ⅔: mean over greatest rise of an even band at high Péclet numbers (Jaeger 1942).
//!
//! Sources: Blok (1937); Wilson and Sheu (1983); the laws of the film as in `solve/traction.rs`. Ours: their sum over Hertz's
//! pressure.

use crate::math::number::sig;
use crate::physics::fluid::Rheology;
use crate::physics::heat_estimate::inlet_factor;
use crate::physics::thinning::{Sheared, Thinning, thinned_row};
use crate::plan::Plan;
use crate::scene::{ContactKind, Scene, Warming};

/// S0 of an oil that says nothing.
const USUAL_EXPONENT: f64 = 1.1;
/// Mean over greatest rise.
const MEAN: f64 = 2.0 / 3.0;
/// Points of Hertz's pressure.
const POINTS: usize = 64;
/// Rounds between stress and walls, each half way.
const ROUNDS: usize = 60;
/// What friction and film may be off before it is told as a caution.
const FRICTION_OFF: f64 = 0.1;
const FILM_OFF: f64 = 0.05;

/// Of one scene without `[heat]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LeftHeat {
    /// Friction coefficient of cold oil and of warm; dry, twice the same.
    pub friction: [f64; 2],
    /// Blok's flash temperature with each, K.
    pub flash_k: [f64; 2],
    /// Rise in the middle of the film over its walls, where the pressure is greatest, K; 0: dry.
    pub middle_k: f64,
    /// Film over that of the isothermal formula by rolling alone, and with sliding; 1: dry.
    pub film: [f64; 2],
    /// Whether S0 is taken for granted.
    pub assumed: bool,
}

impl LeftHeat {
    /// `None`: the scene follows heat.
    pub fn new(scene: &Scene, plan: &Plan) -> Option<Self> {
        if scene.warming() != Warming::None {
            return None;
        }
        let hertz = &plan.hertz;
        let blok = |friction: f64| {
            scene.flash_by_blok_k(scene.motion.slide_roll, friction, hertz.a_m, hertz.p_max_pa)
        };
        let heat = scene.heat.unwrap_or_default();
        let film_m = plan.film.map_or(0.0, |film| film.central_m);
        let wet = (scene.lubricant.as_ref())
            .filter(|_| plan.has_flow() && film_m > scene.friction.contact_film_m);
        let Some(oil) = wet else {
            let friction =
                scene.friction.boundary * f64::from(u8::from(scene.motion.slide_roll != 0.0));
            return Some(Self {
                friction: [friction; 2],
                flash_k: [blok(friction); 2],
                middle_k: 0.0,
                film: [1.0; 2],
                assumed: false,
            });
        };
        let eta = oil.viscosity_pa_s();
        let own = heat.thinning(oil);
        let thinning = own.unwrap_or_else(|| Thinning::roelands(eta, USUAL_EXPONENT, heat.bulk_k));
        let film = Film::new(scene, plan, film_m)?;
        let cold = film.friction(&vec![0.0; POINTS]);
        let (warm, middle_k) = film.warm(&thinning, heat.thermal_conductivity_w_mk, |mu| {
            MEAN * blok(mu)
        });
        let u = scene.motion.entrainment_m_s;
        let loading = thinning.slope_per_k() * eta * u * u / heat.thermal_conductivity_w_mk;
        Some(Self {
            friction: [cold, warm],
            flash_k: [cold, warm].map(blok),
            middle_k,
            film: [0.0, scene.motion.slide_roll].map(|s| inlet_factor(s, loading)),
            assumed: own.is_none(),
        })
    }

    /// Whether friction or film are off by more than a plan lets pass without a caution.
    pub fn matters(&self) -> bool {
        let [cold, warm] = self.friction;
        cold - warm > FRICTION_OFF * cold || 1.0 - self.film[0] > FILM_OFF
    }

    /// In words, a line each.
    pub fn lines(&self) -> Vec<String> {
        let mut lines = vec![match self.flash_k.map(|k| sig(k, 2)) {
            [_, warm] if warm == "0" => "nothing slides: no heat is made in the contact".to_owned(),
            [cold, warm] if cold == warm => format!("surfaces up to {cold} K warmer (Blok)"),
            [cold, warm] => {
                format!("surfaces up to {warm} K warmer (Blok; {cold} with cold oil's friction)")
            }
        }];
        if self.film == [1.0; 2] {
            lines.push("heat changes nothing else in the model of a dry contact".to_owned());
            return lines;
        }
        let [cold, warm] = self.friction;
        if cold > 0.0 {
            lines.push(format!(
                "friction of a smooth film {} in place of {} ({} %), its middle {} K above the walls",
                sig(warm, 3),
                sig(cold, 3),
                sig(100.0 * (warm / cold - 1.0), 2),
                sig(self.middle_k, 2)
            ));
        }
        let with_sliding = if self.film[1] < self.film[0] {
            format!(", {} with what it says of sliding", sig(self.film[1], 3))
        } else {
            String::new()
        };
        lines.push(format!(
            "film {} of the cold one by rolling (Wilson & Sheu){with_sliding}",
            sig(self.film[0], 3)
        ));
        if self.assumed {
            lines.push("taken for granted: the oil thins by Roelands with S0 = 1.1".to_owned());
        }
        if self.matters() {
            lines.push(
                "it matters here: friction by over 10 % or film by over 5 %; a table [heat] follows it"
                    .to_owned(),
            );
        }
        lines
    }
}

/// A smooth film under Hertz's pressure: stresses in Pa at [`POINTS`] places, and what area each stands for.
struct Film {
    newtonian: Vec<f64>,
    ln_eta: Vec<f64>,
    limit: Vec<f64>,
    eyring: f64,
    area: Vec<f64>,
    load: f64,
    /// |U2 − U1| h, m²/s.
    sliding: f64,
}

impl Film {
    fn new(scene: &Scene, plan: &Plan, film_m: f64) -> Option<Self> {
        let oil = scene.lubricant.as_ref()?;
        let (eta, p_h) = (oil.viscosity_pa_s(), plan.hertz.p_max_pa);
        let law = oil
            .viscosity_law
            .scaled(eta, oil.pressure_viscosity_per_pa(), p_h);
        let [one, two] = scene.speeds_m_s();
        let sliding = (two - one).abs();
        let radii = (0..POINTS).map(|k| (k as f64 + 0.5) / POINTS as f64);
        let pressures: Vec<f64> = radii.clone().map(|r| (1.0 - r * r).sqrt()).collect();
        let area: Vec<f64> = match plan.kind {
            ContactKind::Point => radii.collect(),
            ContactKind::Line => vec![1.0; POINTS],
        };
        let ln_eta: Vec<f64> = pressures.iter().map(|p| law.ln_eta(*p).0).collect();
        Some(Self {
            newtonian: ln_eta
                .iter()
                .map(|ln| eta * ln.exp() * sliding / film_m)
                .collect(),
            limit: pressures
                .iter()
                .map(|p| oil.limiting_shear_ratio * p * p_h)
                .collect(),
            eyring: match oil.rheology {
                Rheology::Newtonian => f64::INFINITY,
                Rheology::Eyring => oil.eyring_stress_pa,
            },
            load: pressures
                .iter()
                .zip(&area)
                .map(|(p, area)| p * p_h * area)
                .sum(),
            ln_eta,
            area,
            sliding: sliding * film_m,
        })
    }

    /// Stress where ln η̄ is shifted by `shift`.
    fn stress(&self, k: usize, shift: f64) -> f64 {
        let newtonian = self.newtonian[k] * shift.exp();
        let free = if self.eyring.is_finite() {
            self.eyring * (newtonian / self.eyring).asinh()
        } else {
            newtonian
        };
        free.min(self.limit[k])
    }

    fn friction(&self, shift: &[f64]) -> f64 {
        let force = shift
            .iter()
            .enumerate()
            .map(|(k, shift)| self.stress(k, *shift) * self.area[k]);
        force.sum::<f64>() / self.load
    }

    /// Friction, and the rise in the middle of the film over its walls, between walls that `walls` tells from the friction.
    fn warm(
        &self,
        thinning: &Thinning,
        conductivity: f64,
        walls: impl Fn(f64) -> f64,
    ) -> (f64, f64) {
        let mut shift = vec![0.0; POINTS];
        let mut middle_k = vec![0.0; POINTS];
        let warms = vec![self.sliding / conductivity; POINTS];
        let mut friction = self.friction(&shift);
        for _ in 0..ROUNDS {
            let of_stress: Vec<f64> = (0..POINTS).map(|k| self.stress(k, shift[k])).collect();
            let row = Sheared {
                newtonian: &self.newtonian,
                ln_eta: &self.ln_eta,
                limit: &self.limit,
                eyring: self.eyring,
                warms_k: &warms,
                walls_k: &vec![walls(friction); POINTS],
                of_stress: &of_stress,
                walls_grow_k: 0.0,
            };
            thinned_row(thinning, &row, &mut shift, &mut middle_k);
            friction = 0.5 * (friction + self.friction(&shift));
        }
        (friction, middle_k[0])
    }
}
