//! What wears, and how much at most.
//!
//! ```text
//! depth a loading cycle of body i   ≤   k_i (|U2 − U1|/U_i) (π/2) p_h a        all load on contacts, on the centre line
//! ```
//! Of a line that is exact whatever the profile of the pressure, as w' = p_h π a/2 (Archard 1953 with Hertz 1882).

use crate::math::number::{length, sig};
use crate::physics::cycles::speed_ratios;
use crate::physics::hertz::Hertz;
use crate::scene::{Age, Life, Scene};

/// Wear as the plan has it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WearPlan {
    /// Greatest depth that a loading cycle can take from body 1 and 2 if all load is on contacts, m.
    pub most_a_cycle_m: [f64; 2],
    /// Thinnest film that does not wear, m; 0: contacts alone wear.
    pub thin_film_m: f64,
    /// Loading cycles that are asked for.
    pub age: Option<Age>,
    /// Whether it is followed where damage makes pits: surfaces age, and a calibration point makes damage absolute.
    pub pits: bool,
}

impl WearPlan {
    /// Of a scene with a table `[wear]`.
    pub(super) fn new(scene: &Scene, hertz: &Hertz) -> Option<Self> {
        let wear = scene.wear?;
        let calibration = scene.life.as_ref().and_then(Life::calibration);
        let slide_roll = scene.motion.slide_roll;
        let speeds = speed_ratios(slide_roll);
        let load = std::f64::consts::FRAC_PI_2 * hertz.p_max_pa * hertz.a_m;
        let most = |body: usize| match wear.coefficients_per_pa()[body] {
            0.0 => 0.0,
            k => k * load * slide_roll.abs() / speeds[body].abs(),
        };
        Some(Self {
            most_a_cycle_m: [most(0), most(1)],
            thin_film_m: wear.thin_film_m,
            age: scene.age,
            pits: scene.age.is_some() && calibration.is_some(),
        })
    }

    /// In words.
    pub(super) fn text(&self) -> String {
        let [one, two] = self.most_a_cycle_m.map(|depth_m| match depth_m {
            depth_m if depth_m > 0.0 && depth_m.is_finite() => {
                format!("{} m", sig(depth_m, 3))
            }
            _ => length(0.0),
        });
        let thin = match self.thin_film_m {
            0.0 => String::new(),
            thin_m => format!(" and, by a share, through films below {}", length(thin_m)),
        };
        let most = format!(
            "wear where asperities touch{thin}: at most {one} and {two} a loading cycle of body 1 and 2"
        );
        match self.age {
            Some(age) => {
                let pits = if self.pits {
                    "damage fixed to the material, and pits where it reaches 1 by the calibration point"
                } else {
                    "no pits: life.calibration_cycles does not make damage absolute"
                };
                format!("{most}; {} cycles by jumps; {pits}", sig(age.cycles, 3))
            }
            None => format!("{most}; one cycle is told, none is taken off"),
        }
    }
}
