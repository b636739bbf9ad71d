//! The smooth film by formula at other speeds and loads than the scene's: one λ and one mesh rule for plan and run.
//!
//! ```text
//! Ū ∝ U,  W ∝ w,  M ∝ w U^(−3/4) (line: w U^(−1/2)),  L ∝ U^(1/4),  film unit Rx √(2Ū) ∝ U^(1/2)
//! ```
//! The formulas are evaluated again, not their exponents at one point: a run that has been turned to a speed and a load
//! has the same film, the same λ and the same mesh error as a scene that begins there.

use super::{FilmPlan, OtherFilms};
use crate::physics::film_regression::nijenbanning_central;
use crate::physics::groups::Groups;
use crate::physics::hertz::ContactKind;
use crate::physics::line::moes_central;

impl FilmPlan {
    /// The film at `speed` and `load` times the scene's.
    #[must_use]
    pub fn at(self, speed: f64, load: f64) -> Self {
        if (speed, load) == (1.0, 1.0) {
            return self;
        }
        let shape = self.shape();
        let size = shape.size_ratio(load);
        let groups = groups_at(shape, self.groups, speed, load);
        let moes = self.in_moes_units(groups) / self.in_moes_units(self.groups);
        let ratio = moes * speed.sqrt();
        Self {
            groups,
            central_m: self.central_m * ratio,
            others: match self.others {
                OtherFilms::HamrockDowson {
                    central_m,
                    minimum_m,
                } => OtherFilms::HamrockDowson {
                    central_m: central_m * speed.powf(0.67) * load.powf(-0.067),
                    minimum_m: minimum_m * speed.powf(0.68) * load.powf(-0.073),
                },
                OtherFilms::DowsonHigginson { minimum_m } => OtherFilms::DowsonHigginson {
                    minimum_m: minimum_m * speed.powf(0.7) * load.powf(-0.13),
                },
            },
            central: self.central * ratio / (size * size),
            ..self
        }
    }

    /// The smooth central film that λ is made of, m: by Hamrock and Dowson, of a line by Moes.
    pub fn smooth_m(&self) -> f64 {
        match self.others {
            OtherFilms::HamrockDowson { central_m, .. } => central_m,
            OtherFilms::DowsonHigginson { .. } => self.central_m,
        }
    }

    /// λ, the smooth central film by formula over the composite root-mean-square roughness `rq_m`; `None`: smooth.
    pub fn lambda(&self, rq_m: f64) -> Option<f64> {
        (rq_m > 0.0).then(|| self.smooth_m() / rq_m)
    }

    fn shape(&self) -> ContactKind {
        match self.others {
            OtherFilms::HamrockDowson { .. } => ContactKind::Point,
            OtherFilms::DowsonHigginson { .. } => ContactKind::Line,
        }
    }

    fn in_moes_units(&self, groups: Groups) -> f64 {
        match self.shape() {
            ContactKind::Point => nijenbanning_central(self.radii_ratio, groups.m, groups.l),
            ContactKind::Line => moes_central(groups.m, groups.l),
        }
    }
}

fn groups_at(shape: ContactKind, groups: Groups, speed: f64, load: f64) -> Groups {
    let size = shape.size_ratio(load);
    let by_speed = match shape {
        ContactKind::Point => -0.75,
        ContactKind::Line => -0.5,
    };
    Groups {
        speed: groups.speed * speed,
        material: groups.material,
        load: groups.load * load,
        m: groups.m * load * speed.powf(by_speed),
        l: groups.l * speed.powf(0.25),
        reynolds_lambda: groups.reynolds_lambda * speed / size.powi(4),
        alpha_p_hertz: groups.alpha_p_hertz * size,
    }
}

#[cfg(test)]
mod tests {
    use crate::plan::{OtherFilms, Plan};
    use crate::scene::{ContactKind, Scene};
    use approx::assert_relative_eq;

    #[test]
    fn a_turned_scene_has_the_film_of_one_that_begins_there() {
        for name in ["demonstration", "ball_bearing", "fzg_point_a"] {
            let own = Scene::load(name).expect("a preset");
            let own_plan = Plan::new(&own).expect("a plan");
            for (speed, load) in [(5.0, 1.0), (0.2, 1.0), (1.0, 3.0), (2.0, 0.4)] {
                let mut other = own.clone();
                other.motion.entrainment_m_s *= speed;
                let force = own_plan.force_n * load;
                other.load.hertz_pressure_pa = None;
                match own.kind() {
                    ContactKind::Point => other.load.force_n = Some(force),
                    ContactKind::Line => other.load.force_n_per_m = Some(force),
                }
                let cold = Plan::new(&other).expect("a plan").film.expect("a film");
                let turned = own_plan.film.expect("a film").at(speed, load);
                let close = |one: f64, two: f64| assert_relative_eq!(one, two, max_relative = 1e-9);
                close(turned.central_m, cold.central_m);
                close(turned.central, cold.central);
                close(turned.smooth_m(), cold.smooth_m());
                close(turned.groups.reynolds_lambda, cold.groups.reynolds_lambda);
                close(turned.groups.alpha_p_hertz, cold.groups.alpha_p_hertz);
                let minimum = |film: OtherFilms| match film {
                    OtherFilms::HamrockDowson { minimum_m, .. }
                    | OtherFilms::DowsonHigginson { minimum_m } => minimum_m,
                };
                close(minimum(turned.others), minimum(cold.others));
            }
        }
    }
}
