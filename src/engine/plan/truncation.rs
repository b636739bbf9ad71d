//! What the edges of the domain and its mesh cost the film.
//!
//! ```text
//! film       H_c = h_c Rx/a²                                            (h_c by regression)
//! mesh       relative error of the central film ≈ the greater of 0.1 (ΔX/H_c^{2/3})² (of high order half) and r ΔX²/(2.6 H_c)
//! inlet      relative error ≈ 0.05 L^0.35 H_c [g(2.5)/g(X)]^{1.5} + r (1 − (1 − 1.45/ξ)²),   ξ = |X|/√(2 H_c)
//! sides      0.14 of the first part, with |X| the half-width, + r (1 − (1 − 1.05/ξ)²),       ξ = |Y| √(D/(2 H_c))
//! Hertz gap  g(X) = [√(X² − 1) − (2 − X²) arccos(1/X)]/π                 (in a²/R, circular)
//! line       inlet 0.11 in place of 0.055, g(X) = [X √(X² − 1) − ln(X + √(X² − 1))]/2,
//!            + r 2.36/ξ²
//! ```
//!
//! *Mesh.* Smooth films of nine points and five lines on 33 to 257 nodes, against 257 and 1025: of second order 0.04 to 0.13
//! (ΔX/H_c^{2/3})² too thin up to 4, where half of the film is gone; of high order within 0.04 times it below 0.5, and 0.02 to 0.14 times it
//! too thick from 1 to 3. At αp_h = 69 (the others have 9 to 36) second errs by 0.02 to 0.04 and high by 0.2 times it. How far a domain
//! of points reaches is decided by a rule ten times as strict, whatever the order ([`Truncation::sizing_rule`]).
//!
//! *Contacts that deform.* The rules are fits to measured smooth contacts (`tests/engine/domain.rs`, ignored for its length): M
//! from 10 to 200 at L from 2 to 20, Barus, incompressible, edges from 1.9 to 6 a against a reference at −9 a and ±5 a.
//! Central film, per cent, lost to an inlet at −2.53 a, and by the rule:
//!
//! | L | M = 10 | 20 | 50 | 100 | 200 |
//! |---|---|---|---|---|---|
//! | 2 | 2.1 (2.2) | 1.4 (1.3) | 0.70 (0.69) | 0.41 (0.41) | 0.22 (0.23) |
//! | 5 | 3.7 (4.5) | 2.8 (2.8) | 1.5 (1.5) | 0.84 (0.89) | 0.46 (0.53) |
//! | 10 | 7.8 (8.4) | 5.3 (5.3) | | | |
//!
//! The scaling with the gap is what starvation theory says: a film is starved by the ratio of itself to the
//! gap where the oil begins. From −2.53 to −4.5 a the losses fall as the gap to the power 1.5 to 1.6.
//!
//! *Contacts that hardly do* (M below 10). There the load is carried by the whole wedge, whose length is √(2 Rx h), not a.
//! Between rigid paraboloids in an oil of one viscosity the pressure ahead falls as |x|⁻³, so the load that lies beyond an
//! edge falls as 1/ξ only (of a line as 1/ξ²), and a film of a given load as twice that (W ∝ h^{−1/2}; of a line W ∝ 1/h).
//! Reynolds' equation with P ≥ 0 on a grid that reaches to ξ = 3000 gives, per cent of the load lost to an edge at ξ:
//!
//! | ξ | 5 | 12 | 20 | 60 | 100 |
//! |---|---|---|---|---|---|
//! | inlet, D = 0.1 | 31 | 13 | 7.9 | 2.5 | 1.5 |
//! | inlet, D = 1 | 28 | 12 | 7.2 | 2.3 | 1.3 |
//! | inlet, D = 10 | 23 | 9.9 | 5.9 | 1.8 | 1.0 |
//! | sides, D = 0.1, 1, 10 | 16, 21, 24 | 6.7, 8.7, 10 | 4.0, 5.2, 5.9 | 1.3, 1.6, 1.8 | 0.8, 0.9, 1.0 |
//! | line, inlet | 9.0 | 1.7 | 0.6 | 0.06 | 0.01 |
//!
//! r, how much the film is that of rigid bodies, is ∂ ln H_c/∂ ln H_RI of the regression without piezoviscosity (which
//! moves load from the wedge to the middle only where there is a middle: at M = 5 the central film still moves by 15 % at
//! L = 10 between edges at −10 and −40 a, at M = 7 by 0.2 %); below 3 % the first part holds alone, which was fitted there.
//! The rules size the grid and warn; they never correct results.
//!
//! The line's factors are measured too (`tests/engine/line.rs`: at M = 20 and 100 the inlet rule holds within 1.3
//! from −2 to −3.5).

use super::{FilmPlan, OtherFilms};
use crate::physics::film_regression::nijenbanning_rigid_share;
use crate::physics::line::moes_rigid_share;
use crate::scene::{ContactKind, Order, OrderAsked};

/// Share of a film that is that of rigid bodies, below which edges cost what they cost contacts that deform.
const RIGID: f64 = 0.03;

/// Greatest measure of a mesh on which high order errs less ([`Truncation::order`]).
const HIGH: f64 = 4.0;

/// What the errors of a domain depend on, beside the domain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Truncation {
    /// Point or line.
    pub kind: ContactKind,
    /// H_c.
    pub film: f64,
    /// Moes' L.
    pub l: f64,
    /// r, how much the film is that of rigid bodies, as far as it matters.
    pub rigid: f64,
    /// √D b/a: ξ of a side one half-width b away, over that of an inlet one a away.
    pub side: f64,
    /// Order of the discretisation that is asked for.
    pub asked: OrderAsked,
}

impl FilmPlan {
    /// What the errors of a domain depend on.
    pub fn truncation(&self) -> Truncation {
        let (d, m) = (self.radii_ratio, self.groups.m);
        let (kind, share) = match self.others {
            OtherFilms::HamrockDowson { .. } => {
                (ContactKind::Point, nijenbanning_rigid_share(d, m))
            }
            OtherFilms::DowsonHigginson { .. } => (ContactKind::Line, moes_rigid_share(m)),
        };
        Truncation {
            kind,
            film: self.central,
            l: self.groups.l,
            rigid: ((share - RIGID) / (1.0 - RIGID)).max(0.0),
            side: self.ellipticity * d.sqrt(),
            asked: self.order,
        }
    }
}

impl Truncation {
    /// Relative error of the central film by an inlet that begins at `x_min_a` (below −1).
    pub fn inlet_error(&self, x_min_a: f64) -> f64 {
        let elastic = inlet_error(self.kind, self.film, self.l, x_min_a);
        let xi = -x_min_a / (2.0 * self.film).sqrt();
        let lost = match self.kind {
            ContactKind::Point => film_lost(1.45 / xi),
            ContactKind::Line => (2.36 / (xi * xi)).min(1.0),
        };
        elastic + self.rigid * lost
    }

    /// Relative error of the central film by sides at ±`y_half_b` (above 1); a line has none.
    pub fn side_error(&self, y_half_b: f64) -> f64 {
        if self.kind == ContactKind::Line {
            return 0.0;
        }
        let xi = y_half_b * self.side / (2.0 * self.film).sqrt();
        side_error(self.film, self.l, y_half_b) + self.rigid * film_lost(1.05 / xi)
    }

    /// Relative error of the central film by a mesh of spacing `dx_a`.
    pub fn mesh_error(&self, dx_a: f64) -> f64 {
        let share = match self.order(dx_a) {
            Order::Second => 0.1,
            Order::High => 0.05,
        };
        (share * mesh_measure(self.film, dx_a)).max(self.wedge(dx_a))
    }

    /// Order of the discretisation with a mesh of spacing `dx_a`: by the mesh high where (ΔX/H_c^{2/3})² is at most [`HIGH`] and no
    /// wedge of rigid bodies is lost on it.
    ///
    /// Smooth central film on 65 nodes, per cent off that of 257 nodes, of second and high order (demonstration at 0.2, 0.1, 0.07,
    /// 0.05, 0.04, 0.03, 0.02 m/s; the lines fzg_point_b at 0.1, cam_nose and fzg_point_b at 0.02):
    ///
    /// | measure | 1.2 | 2.3 | 3.2 | 4.4 | 5.5 | 7.2 | 9.8 | line 4.3 | 5.2 | 20 |
    /// |---|---|---|---|---|---|---|---|---|---|---|
    /// | second | −13 | −25 | −35 | −49 | −48 | −43 | −34 | −37 | −57 | −20 |
    /// | high | 6 | 18 | 22 | 26 | 36 | 67 | 122 | 41 | 34 | 219 |
    ///
    /// It is a rule for contacts such as these. On meshes of 1 and more second errs less where both M and L are large: ball_bearing
    /// (33 nodes, 1.2) −6 and 12, micropitting_rig (33, 2.3) −13 and 33, demonstration with α = 4e-8 1/Pa (65, 0.7) −1 and 14.
    pub fn order(&self, dx_a: f64) -> Order {
        let is_carried = mesh_measure(self.film, dx_a) <= HIGH && self.wedge(dx_a) <= 1.0;
        self.asked.order(is_carried)
    }

    fn wedge(&self, dx_a: f64) -> f64 {
        self.rigid * dx_a * dx_a / (2.6 * self.film)
    }

    /// What the mesh weighs beside the edges where a domain is chosen.
    pub fn sizing_rule(&self, dx_a: f64) -> f64 {
        sizing_rule(self.kind, self.film, dx_a).max(self.wedge(dx_a))
    }
}

/// Share of the film of a given load that goes with a share of the load, W ∝ h^{−1/2}.
fn film_lost(load: f64) -> f64 {
    1.0 - (1.0 - load.min(1.0)).powi(2)
}

/// (ΔX/H_c^{2/3})²
fn mesh_measure(film: f64, dx_a: f64) -> f64 {
    (dx_a / film.powf(2.0 / 3.0)).powi(2)
}

/// What the mesh weighs where a domain is chosen, of contacts that deform; `film` = h_c Rx/a².
pub fn sizing_rule(kind: ContactKind, film: f64, dx_a: f64) -> f64 {
    let rule = mesh_measure(film, dx_a);
    match kind {
        ContactKind::Point => rule,
        ContactKind::Line => 0.1 * rule,
    }
}

/// Relative error of the central film by an inlet that begins at `x_min_a` (below −1), of contacts that deform; `film` =
/// h_c Rx/a², `l` Moes' L (point contact; the line's rule joins two measured points at L = 10).
pub fn inlet_error(kind: ContactKind, film: f64, l: f64, x_min_a: f64) -> f64 {
    match kind {
        ContactKind::Point => {
            let gaps = hertz_gap(2.5) / hertz_gap(-x_min_a);
            0.05 * l.powf(0.35) * film * gaps.powf(1.5)
        }
        ContactKind::Line => {
            let gaps = line_gap(2.5) / line_gap(-x_min_a);
            0.11 * (film / 0.497 * gaps).powf(1.2)
        }
    }
}

/// Relative error of the central film by sides at ±`y_half_b` (above 1), point contact that deforms.
pub fn side_error(film: f64, l: f64, y_half_b: f64) -> f64 {
    0.14 * inlet_error(ContactKind::Point, film, l, -y_half_b)
}

/// Gap outside of a smooth contact, in a²/Rx (of the long side of an ellipse a guide).
pub(super) fn gap(kind: ContactKind, x: f64) -> f64 {
    match kind {
        ContactKind::Point => hertz_gap(x),
        ContactKind::Line => line_gap(x),
    }
}

/// Gap outside of a Hertz line contact at |X| = `x`, in b²/R (Johnson 1985, §4.2).
fn line_gap(x: f64) -> f64 {
    let root = (x * x - 1.0).max(0.0).sqrt();
    0.5 * (x * root - (x + root).ln())
}

/// Gap outside of a circular Hertz contact at |X| = `x`, in a²/R.
pub(super) fn hertz_gap(x: f64) -> f64 {
    let square = x * x;
    ((square - 1.0).max(0.0).sqrt() - (2.0 - square) * (1.0 / x).min(1.0).acos())
        / std::f64::consts::PI
}
