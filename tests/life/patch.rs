//! Exact stress under a uniform traction on a rectangle (Love 1929) and under point forces
//! (Boussinesq, Cerruti), as harmonics of [`asperity_engine::physics::stress_exact`].
//!
//! ```text
//! rectangle  value = [C(++) + C(−−) − C(+−) − C(−+)]/2π at the corners (x ± hx, y ± hy)
//!  f: 1 atan2(xy, zR)   nx² atan2(xy(R−z), x²R + y²z)   inx asinh(y/√(x²+z²))   iny asinh(x/√(y²+z²))
//!     nxny ln(R+z)      inx²ny x/(R+z)                  inxny² y/(R+z)
//!  g: nx² zxy/(R(x²+z²))   ny² zxy/(R(y²+z²))   1 their sum   inx z²y/(R(x²+z²))   iny z²x/(R(y²+z²))
//!     nxny −z/R            inx²ny zx/(R(R+z))   inxny² zy/(R(R+z))
//! ```
//! Valid for z > 0.

use std::f64::consts::PI;

use asperity_engine::physics::stress_exact::{Directions, Harmonics, point_radial};

/// Harmonics of a unit point force at the origin, z > 0.
pub(crate) fn point_harmonics(x: f64, y: f64, z: f64) -> Harmonics {
    let r = x.hypot(y);
    let (cos, sin) = if r > 0.0 { (x / r, y / r) } else { (1.0, 0.0) };
    let (f, g) = point_radial(r, z);
    Harmonics {
        f: Directions::from_radial(f, cos, sin),
        g: Directions::from_radial(g, cos, sin),
    }
}

/// Harmonics of a unit traction on the rectangle |x| < hx, |y| < hy, z > 0.
pub(crate) fn rectangle_harmonics(x: f64, y: f64, z: f64, hx: f64, hy: f64) -> Harmonics {
    let corners = [
        (x + hx, y + hy, 1.0),
        (x - hx, y - hy, 1.0),
        (x + hx, y - hy, -1.0),
        (x - hx, y + hy, -1.0),
    ];
    let mut sum = Harmonics::default();
    for (cx, cy, sign) in corners {
        let corner = rectangle_corner(cx, cy, z);
        add(&mut sum.f, corner.f, sign / (2.0 * PI));
        add(&mut sum.g, corner.g, sign / (2.0 * PI));
    }
    sum
}

fn add(sum: &mut Directions, term: Directions, factor: f64) {
    sum.one += factor * term.one;
    sum.inx += factor * term.inx;
    sum.iny += factor * term.iny;
    sum.nx2 += factor * term.nx2;
    sum.nxny += factor * term.nxny;
    sum.inx2ny += factor * term.inx2ny;
    sum.inxny2 += factor * term.inxny2;
}

fn rectangle_corner(x: f64, y: f64, z: f64) -> Harmonics {
    let r = (x * x + y * y + z * z).sqrt();
    let (xz, yz) = (x * x + z * z, y * y + z * z);
    let f = Directions {
        one: (x * y).atan2(z * r),
        inx: (y / xz.sqrt()).asinh(),
        iny: (x / yz.sqrt()).asinh(),
        nx2: (x * y * (r - z)).atan2(x * x * r + y * y * z),
        nxny: (r + z).ln(),
        inx2ny: x / (r + z),
        inxny2: y / (r + z),
    };
    let g_nx2 = z * x * y / (r * xz);
    let g = Directions {
        one: g_nx2 + z * x * y / (r * yz),
        inx: z * z * y / (r * xz),
        iny: z * z * x / (r * yz),
        nx2: g_nx2,
        nxny: -z / r,
        inx2ny: z * x / (r * (r + z)),
        inxny2: z * y / (r * (r + z)),
    };
    Harmonics { f, g }
}
