//! Scalar measures of a stress state.
//!
//! ```text
//! von Mises    σ_v² = ½[(σxx−σyy)² + (σyy−σzz)² + (σzz−σxx)²] + 3(σxy² + σxz² + σyz²) = 3 J2
//! octahedral   τ_o  = (√2/3) σ_v
//! principal    σ_i  = σ_m + 2 √(J2/3) cos(θ − 2πi/3),   cos 3θ = (3√3/2) J3/J2^{3/2},  i = 0, 1, 2
//! max shear    τ_m  = (σ_0 − σ_2)/2 = √J2 cos(asin(cos 3θ)/3)
//! ```
//! Tension is positive. All are independent of the axes; any unit of stress.

/// A symmetric stress tensor, tension positive.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Stress6 {
    /// Normal stress along x.
    pub xx: f64,
    /// Normal stress along y.
    pub yy: f64,
    /// Normal stress along z (into the body).
    pub zz: f64,
    /// Shear in the plane x y.
    pub xy: f64,
    /// Shear in the plane x z (the orthogonal shear of rolling contacts).
    pub xz: f64,
    /// Shear in the plane y z.
    pub yz: f64,
}

impl Stress6 {
    /// The state of components xx, yy, zz, xy, xz, yz.
    pub fn of([xx, yy, zz, xy, xz, yz]: [f64; 6]) -> Self {
        Self {
            xx,
            yy,
            zz,
            xy,
            xz,
            yz,
        }
    }

    fn components(self) -> [f64; 6] {
        [self.xx, self.yy, self.zz, self.xy, self.xz, self.yz]
    }

    /// Sum of two states.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        let (one, other) = (self.components(), other.components());
        Self::of(std::array::from_fn(|c| one[c] + other[c]))
    }

    /// State times a number.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        Self::of(self.components().map(|c| c * factor))
    }

    /// Maximum difference between two components of the same name.
    pub fn distance(self, other: Self) -> f64 {
        let apart = self.plus(other.times(-1.0)).components();
        apart.into_iter().fold(0.0, |worst, c| worst.max(c.abs()))
    }

    /// Mean normal stress, a third of the trace.
    pub fn mean(self) -> f64 {
        (self.xx + self.yy + self.zz) / 3.0
    }

    /// Second invariant of the deviator.
    pub fn j2(self) -> f64 {
        let (a, b, c) = (self.xx - self.yy, self.yy - self.zz, self.zz - self.xx);
        (a * a + b * b + c * c) / 6.0 + self.xy * self.xy + self.xz * self.xz + self.yz * self.yz
    }

    /// Third invariant of the deviator (its determinant).
    pub fn j3(self) -> f64 {
        let m = self.mean();
        let (x, y, z) = (self.xx - m, self.yy - m, self.zz - m);
        x * y * z + 2.0 * self.xy * self.xz * self.yz
            - x * self.yz * self.yz
            - y * self.xz * self.xz
            - z * self.xy * self.xy
    }

    /// Von Mises stress.
    pub fn von_mises(self) -> f64 {
        (3.0 * self.j2()).sqrt()
    }

    /// Octahedral shear stress.
    pub fn octahedral_shear(self) -> f64 {
        (2.0 / 3.0 * self.j2()).sqrt()
    }

    /// Principal stresses, most tensile first.
    pub fn principal(self) -> [f64; 3] {
        let (m, j2) = (self.mean(), self.j2());
        let theta = self.lode_cosine().acos() / 3.0;
        let r = 2.0 * (j2 / 3.0).sqrt();
        let third = 2.0 * std::f64::consts::PI / 3.0;
        [0.0, 1.0, 2.0]
            .map(|i| m + r * (theta - third * i).cos())
            .sorted_down()
    }

    /// Maximum shear stress, half the difference of the outer principal stresses.
    pub fn max_shear(self) -> f64 {
        self.j2().sqrt() * (self.lode_cosine().asin() / 3.0).cos()
    }

    /// cos 3θ of the Lode angle, kept inside [−1, 1]; 0 where there is no shear.
    fn lode_cosine(self) -> f64 {
        let j2 = self.j2();
        let scale = j2 * j2.sqrt();
        if scale <= f64::MIN_POSITIVE {
            return 0.0;
        }
        (1.5 * 3.0_f64.sqrt() * self.j3() / scale).clamp(-1.0, 1.0)
    }
}

/// Sorts three numbers, largest first.
trait SortedDown {
    fn sorted_down(self) -> Self;
}

impl SortedDown for [f64; 3] {
    fn sorted_down(mut self) -> Self {
        self.sort_by(|a, b| b.total_cmp(a));
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn uniaxial_tension_and_pure_shear() {
        let pull = Stress6 {
            xx: 3.0,
            ..Stress6::default()
        };
        assert_relative_eq!(pull.von_mises(), 3.0, max_relative = 1e-14);
        assert_relative_eq!(pull.max_shear(), 1.5, max_relative = 1e-7);
        assert_relative_eq!(
            pull.octahedral_shear(),
            2.0_f64.sqrt(),
            max_relative = 1e-14
        );
        let shear = Stress6 {
            yz: 2.0,
            ..Stress6::default()
        };
        assert_relative_eq!(shear.von_mises(), 12.0_f64.sqrt(), max_relative = 1e-14);
        assert_relative_eq!(shear.max_shear(), 2.0, max_relative = 1e-14);
        assert_eq!(Stress6::default().max_shear(), 0.0);
    }

    #[test]
    fn principal_stresses_keep_the_invariants() {
        let s = Stress6::of([1.0, -2.0, 0.5, 0.7, -1.1, 0.3]);
        let [a, b, c] = s.principal();
        assert!(a >= b && b >= c);
        let diagonal = Stress6::of([a, b, c, 0.0, 0.0, 0.0]);
        assert_relative_eq!(diagonal.mean(), s.mean(), max_relative = 1e-12);
        assert_relative_eq!(diagonal.j2(), s.j2(), max_relative = 1e-12);
        assert_relative_eq!(diagonal.j3(), s.j3(), max_relative = 1e-12);
        assert_relative_eq!(s.max_shear(), (a - c) / 2.0, max_relative = 1e-12);
    }
}
