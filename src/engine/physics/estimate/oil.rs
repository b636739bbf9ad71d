//! The oil's part of the estimate: film by regression, and the friction of the film.

use crate::physics::film_regression::nijenbanning_central_m;
use crate::physics::fluid::{Rheology, ViscosityLaw};
use crate::physics::groups;
use crate::physics::hertz::ContactKind;
use crate::physics::line::LinePoint;

/// The oil's part: what the film regressions need, at any load and speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FilmBasis {
    /// Of a point contact.
    Point(groups::PointContact),
    /// Of a line.
    Line(LinePoint),
}

/// Oil and its shear.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OilBasis {
    /// For film, M and L.
    pub film: FilmBasis,
    /// Viscosity law.
    pub viscosity_law: ViscosityLaw,
    /// Shear law.
    pub rheology: Rheology,
    /// Eyring stress, Pa.
    pub eyring_pa: f64,
    /// Limiting shear stress over pressure.
    pub limit: f64,
    /// Film at or below which a spot is in contact, m.
    pub contact_film_m: f64,
}

impl FilmBasis {
    /// η0, Pa s, and α, 1/Pa.
    fn viscosity(&self) -> (f64, f64) {
        match self {
            Self::Point(point) => (point.viscosity_pa_s, point.alpha_per_pa),
            Self::Line(line) => (line.viscosity_pa_s, line.alpha_per_pa),
        }
    }

    /// Central film, m, M and L at a load and a speed.
    pub(super) fn at(self, load_n: f64, speed_m_s: f64) -> (f64, f64, f64) {
        match self {
            Self::Point(mut point) => {
                (point.force_n, point.entrainment_m_s) = (load_n, speed_m_s);
                let groups = point.groups();
                (nijenbanning_central_m(&point), groups.m, groups.l)
            }
            Self::Line(mut line) => {
                (line.load_n_per_m, line.entrainment_m_s) = (load_n, speed_m_s);
                let groups = line.groups();
                (line.moes_central_m(), groups.m, groups.l)
            }
        }
    }
}

impl OilBasis {
    /// Friction coefficient of a film at the mean Hertz pressure.
    pub(super) fn friction(
        &self,
        shape: ContactKind,
        p_hertz_pa: f64,
        film_m: f64,
        sliding_m_s: f64,
    ) -> f64 {
        let mean = match shape {
            ContactKind::Point => 2.0 / 3.0,
            ContactKind::Line => std::f64::consts::FRAC_PI_4,
        };
        let (viscosity_pa_s, alpha_per_pa) = self.film.viscosity();
        let law = (self.viscosity_law).scaled(viscosity_pa_s, alpha_per_pa, p_hertz_pa);
        let newtonian_pa = viscosity_pa_s * law.ln_eta(mean).0.exp() * sliding_m_s / film_m;
        let shear_pa = self.rheology.shear_pa(newtonian_pa, self.eyring_pa);
        (shear_pa / (mean * p_hertz_pa)).min(self.limit)
    }
}
