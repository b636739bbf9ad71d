//! What lies under the roughness of a measured map, and pixels that do not belong to it.
//!
//! ```text
//! z ≈ z̄ + s_x u + s_y v + c_xy u v + c_xx (u² − ⟨u²⟩) + c_yy (v² − ⟨v²⟩),   u, v: pixels from the middle
//! ```
//! The terms are orthogonal on a whole rectangle of pixels, so each coefficient of the least squares is a quotient of two
//! sums, and the best plane is part of the best quadratic (the F-operation of ISO 25178-2:2021 by a plane or a polynomial).
//! Sums of odd terms go over mirrored pairs: a map that is its own mirror image has a slope of exactly 0.
//!
//! A pixel is an *outlier* where it departs from the median of the 5 by 5 about it by more than six times the larger of the
//! usual departure (1.4826 times the median of all departures: Hampel 1974, J. Am. Stat. Assoc. 69, 383-393) and half of
//! Sq of those medians, and fewer of the others come within half of that departure than a straight line through the 5 by 5
//! has: four, at the edge of a windowed map three or two. A scratch has as many, a corner of a step eight.

use super::height_map::MapEdge;

crate::closed_set! {
    /// What is taken off a map before it is used.
    pub enum MapLevel {
        /// Nothing.
        None = "none",
        /// The mean, of a windowed map that of its outermost pixels.
        Mean = "mean",
        /// The best plane.
        Plane = "plane",
        /// The best polynomial of second order.
        Quadratic = "quadratic",
    }
}

crate::closed_set! {
    /// What becomes of outlying pixels.
    #[derive(Default)]
    pub enum MapOutliers {
        /// They stay.
        #[default]
        Keep = "keep",
        /// The median of the 5 by 5 pixels about each takes its place.
        Median = "median",
    }
}

/// Pixels of a map, row after row.
#[derive(Debug, Clone, Copy)]
pub struct Pixels<'a> {
    nx: usize,
    ny: usize,
    z: &'a [f64],
}

/// The best polynomial of second order but for its mean, a pixel and a square pixel at a time, in the heights' unit.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Form {
    /// Slopes along x and y.
    pub slopes: [f64; 2],
    /// c_xy.
    twist: f64,
    /// c_xx, c_yy.
    curves: [f64; 2],
    sides: [usize; 2],
}

/// Places of `n` pixels from their middle, and the mean of their squares.
fn place(at: usize, n: usize) -> f64 {
    at as f64 - 0.5 * (n.max(1) - 1) as f64
}

/// ⟨u²⟩ over `n` pixels.
fn mean_square(n: usize) -> f64 {
    ((n * n).max(1) - 1) as f64 / 12.0
}

/// `sum/norm`, 0 where nothing varies.
fn share(sum: f64, norm: f64) -> f64 {
    if norm > 0.0 { sum / norm } else { 0.0 }
}

impl<'a> Pixels<'a> {
    /// Rows of `nx` pixels.
    pub fn new(nx: usize, z: &'a [f64]) -> Self {
        let ny = z.len() / nx.max(1);
        Self { nx, ny, z }
    }

    fn at(&self, i: usize, j: usize) -> f64 {
        self.z[j * self.nx + i]
    }

    /// The best polynomial of second order.
    pub fn form(&self) -> Form {
        let (nx, ny) = (self.nx, self.ny);
        let (mut x, mut y, mut twist, mut curves) = (0.0, 0.0, 0.0, [0.0; 2]);
        let [mean_x, mean_y] = [mean_square(nx), mean_square(ny)];
        for j in 0..ny {
            let v = place(j, ny);
            for i in 0..nx / 2 {
                let u = place(nx - 1 - i, nx);
                let step = self.at(nx - 1 - i, j) - self.at(i, j);
                x += u * step;
                twist += u * v * step;
            }
            for i in 0..nx {
                let z = self.at(i, j);
                curves[0] += (place(i, nx).powi(2) - mean_x) * z;
                curves[1] += (v * v - mean_y) * z;
            }
        }
        for j in 0..ny / 2 {
            let v = place(ny - 1 - j, ny);
            for i in 0..nx {
                y += v * (self.at(i, ny - 1 - j) - self.at(i, j));
            }
        }
        let all = (nx * ny) as f64;
        let spread = |n: usize| {
            let squares = (0..n).map(|k| (place(k, n).powi(2) - mean_square(n)).powi(2));
            squares.sum::<f64>() / n.max(1) as f64
        };
        Form {
            slopes: [share(x, all * mean_x), share(y, all * mean_y)],
            twist: share(twist, all * mean_x * mean_y),
            curves: [
                share(curves[0], all * spread(nx)),
                share(curves[1], all * spread(ny)),
            ],
            sides: [nx, ny],
        }
    }

    /// Mean square departure from the mean.
    pub fn variance(&self) -> f64 {
        let n = self.z.len().max(1) as f64;
        let mean = self.z.iter().sum::<f64>() / n;
        self.z.iter().map(|z| (z - mean).powi(2)).sum::<f64>() / n
    }

    /// Whether the plane of `form` stands as a step between the last pixels and the first ones of a map that repeats:
    /// the step there is more than twice the greatest other one, both of the mean profile, worth a word beside the
    /// heights, and for more than half the plane's doing.
    pub fn is_open(&self, form: &Form) -> bool {
        let (nx, ny) = (self.nx, self.ny);
        let mean =
            |n: usize, of: &dyn Fn(usize) -> f64| (0..n).map(of).sum::<f64>() / n.max(1) as f64;
        let along: Vec<f64> = (0..nx).map(|i| mean(ny, &|j| self.at(i, j))).collect();
        let across: Vec<f64> = (0..ny).map(|j| mean(nx, &|i| self.at(i, j))).collect();
        let worth = SEAM_WORTH_A_WORD * self.variance().sqrt();
        [along, across]
            .iter()
            .zip(form.slopes)
            .any(|(profile, slope)| {
                let (Some(first), Some(last)) = (profile.first(), profile.last()) else {
                    return false;
                };
                let seam = first - last;
                let inner = profile.windows(2).map(|pair| (pair[1] - pair[0]).abs());
                let rest = seam + slope * profile.len() as f64;
                seam.abs() > 2.0 * inner.fold(0.0, f64::max)
                    && seam.abs() > worth
                    && rest.abs() < 0.5 * seam.abs()
            })
    }

    /// Outliers of the heights over the plane of `form`, and what takes their places.
    pub fn outliers(&self, form: &Form, beyond: MapEdge) -> Vec<(usize, f64)> {
        let plane = form.of(MapLevel::Plane);
        let flat: Vec<f64> = (0..self.z.len()).map(|n| self.z[n] - plane.at(n)).collect();
        let flat = Pixels::new(self.nx, &flat);
        let least = OUTLYING * flat.usual(beyond);
        let mut found = Vec::new();
        for n in 0..flat.z.len() {
            let z = flat.z[n];
            // Most pixels have such neighbours, and need no median.
            if flat.fellows(n, 1, beyond, 0.5 * least) >= LINE {
                continue;
            }
            let median = flat.median(n, beyond);
            let departure = (z - median).abs();
            if departure > least
                && flat.fellows(n, 2, beyond, 0.5 * departure) < flat.line(n, beyond)
            {
                found.push((n, median + plane.at(n)));
            }
        }
        found
    }

    /// The larger of the usual departure from the median and half of Sq of the medians; of a large map by a sample.
    fn usual(&self, beyond: MapEdge) -> f64 {
        const SAMPLE: usize = 1 << 16;
        // Odd, so that it does not stay in one column of the usual maps.
        let stride = (self.z.len() / SAMPLE) | 1;
        let sample = (0..self.z.len()).step_by(stride);
        let medians: Vec<f64> = sample.clone().map(|n| self.median(n, beyond)).collect();
        let mut departures: Vec<f64> = sample
            .zip(&medians)
            .map(|(n, median)| (self.z[n] - median).abs())
            .collect();
        let usual = 1.4826 * middle(&mut departures);
        usual.max(0.5 * Pixels::new(medians.len(), &medians).variance().sqrt())
    }

    /// The pixels within `reach` of pixel `n`, itself among them.
    fn around(&self, n: usize, reach: i64, beyond: MapEdge) -> impl Iterator<Item = usize> {
        let (nx, ny) = (self.nx, self.ny);
        let (i, j) = ((n % nx) as i64, (n / nx) as i64);
        let within = move |k: i64, n: usize| match beyond {
            MapEdge::Periodic => Some(k.rem_euclid(n as i64) as usize),
            MapEdge::Windowed => (0..n as i64).contains(&k).then_some(k as usize),
        };
        let side = -reach..=reach;
        side.clone()
            .filter_map(move |l| within(j + l, ny))
            .flat_map(move |row| {
                side.clone()
                    .filter_map(move |k| Some(row * nx + within(i + k, nx)?))
            })
    }

    fn median(&self, n: usize, beyond: MapEdge) -> f64 {
        let mut near = [0.0; 25];
        let mut count = 0;
        for (place, at) in near.iter_mut().zip(self.around(n, 2, beyond)) {
            *place = self.z[at];
            count += 1;
        }
        middle(&mut near[..count])
    }

    /// Other pixels of a straight line through those about pixel `n`.
    fn line(&self, n: usize, beyond: MapEdge) -> usize {
        let side = |at: usize, n: usize| match beyond {
            MapEdge::Periodic => LINE,
            MapEdge::Windowed => at.min(2) + (n - 1 - at).min(2),
        };
        side(n % self.nx, self.nx).min(side(n / self.nx, self.ny))
    }

    /// Others within `reach` whose height is no further than `far`.
    fn fellows(&self, n: usize, reach: i64, beyond: MapEdge, far: f64) -> usize {
        let z = self.z[n];
        let others = self.around(n, reach, beyond).filter(|&at| at != n);
        others.filter(|&at| (self.z[at] - z).abs() <= far).count()
    }
}

/// Departures that make an outlier, over the usual one.
const OUTLYING: f64 = 6.0;
/// Other pixels of a straight line through 5 by 5 pixels.
const LINE: usize = 4;
/// Step at the seam of a map that repeats, over its Sq.
const SEAM_WORTH_A_WORD: f64 = 0.1;

/// The median; of an even count the upper one; 0 of nothing.
fn middle(values: &mut [f64]) -> f64 {
    let half = values.len() / 2;
    if values.is_empty() {
        return 0.0;
    }
    *values.select_nth_unstable_by(half, f64::total_cmp).1
}

impl Form {
    /// What of it `level` takes off, the mean apart.
    #[must_use]
    pub fn of(self, level: MapLevel) -> Self {
        let none = Self {
            sides: self.sides,
            ..Self::default()
        };
        match level {
            MapLevel::None | MapLevel::Mean => none,
            MapLevel::Plane => Self {
                slopes: self.slopes,
                ..none
            },
            MapLevel::Quadratic => self,
        }
    }

    /// Its height at pixel `n`.
    pub fn at(&self, n: usize) -> f64 {
        let [nx, ny] = self.sides;
        let (u, v) = (place(n % nx, nx), place(n / nx, ny));
        self.slopes[0] * u
            + self.slopes[1] * v
            + self.twist * u * v
            + self.curves[0] * (u * u - mean_square(nx))
            + self.curves[1] * (v * v - mean_square(ny))
    }

    /// Mean square of its plane.
    pub fn plane_variance(&self) -> f64 {
        let squares = self.sides.map(mean_square);
        self.slopes[0].powi(2) * squares[0] + self.slopes[1].powi(2) * squares[1]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn map(nx: usize, ny: usize, z: impl Fn(f64, f64) -> f64) -> Vec<f64> {
        (0..nx * ny)
            .map(|n| z(place(n % nx, nx), place(n / nx, ny)))
            .collect()
    }

    #[test]
    fn a_quadratic_is_found_exactly() {
        for (nx, ny) in [(9, 6), (4, 4), (31, 17)] {
            let z = map(nx, ny, |u, v| {
                7.0 + 0.3 * u - 0.2 * v + 0.05 * u * v + 0.01 * u * u - 0.04 * v * v
            });
            let form = Pixels::new(nx, &z).form();
            for (found, told) in [
                (form.slopes[0], 0.3),
                (form.slopes[1], -0.2),
                (form.twist, 0.05),
                (form.curves[0], 0.01),
                (form.curves[1], -0.04),
            ] {
                assert!((found - told).abs() < 1e-12, "{form:?}");
            }
            let mean = z.iter().sum::<f64>() / z.len() as f64;
            for (n, z) in z.iter().enumerate() {
                assert!((z - mean - form.at(n)).abs() < 1e-12);
            }
            assert_eq!(form.of(MapLevel::Mean).at(nx), 0.0);
        }
    }

    /// By hand: z = 1, 2, 3, 4 in each row. s = Σ u z/Σ u² = (-1.5 - 1 + 1.5 + 6)/5 = 1; ⟨(z - z̄)²⟩ = 5/4, all of it the
    /// plane's.
    #[test]
    fn a_plane_by_hand() {
        let z = map(4, 5, |u, _| u + 2.5);
        let pixels = Pixels::new(4, &z);
        let form = pixels.form();
        assert_eq!((form.slopes, form.plane_variance()), ([1.0, 0.0], 1.25));
        assert_eq!(pixels.variance(), 1.25);
    }

    #[test]
    fn a_mirror_image_has_no_slope_to_the_last_bit() {
        let z = map(81, 80, |u, v| -(-(u * u + v * v) / 90.0).exp());
        assert_eq!(Pixels::new(81, &z).form().slopes, [0.0, 0.0]);
    }

    #[test]
    fn tilts_are_open_and_waves_are_not() {
        let wave = |u: f64, n: f64| (TAU * u / n + 0.4).sin();
        let open = |nx: usize, ny: usize, z: &dyn Fn(f64, f64) -> f64| {
            let z = map(nx, ny, z);
            let pixels = Pixels::new(nx, &z);
            pixels.is_open(&pixels.form())
        };
        for (nx, ny) in [(32, 32), (64, 5), (4, 64)] {
            assert!(open(nx, ny, &|u, _| u), "{nx} {ny}");
            assert!(open(nx, ny, &|_, v| -v), "{nx} {ny}");
        }
        assert!(open(40, 40, &|u, _| wave(u, 8.0) + 0.3 * u));
        assert!(open(40, 40, &|u, v| wave(u, 10.0) + 0.2 * v));
        // One whole wave has a best plane that makes three fifths of its height, and closes.
        assert!(!open(40, 40, &|u, _| (TAU * u / 40.0).sin()));
        assert!(!open(40, 40, &|u, v| wave(u, 40.0) + wave(v, 20.0)));
        // Teeth of a saw: the seam is one step of several.
        assert!(!open(16, 16, &|u, _| (u + 7.5) % 8.0));
        assert!(!open(16, 16, &|_, _| 3.0));
        // A tilt that is lost in the roughness.
        assert!(!open(40, 40, &|u, _| wave(u, 8.0) + 0.01 * u));
    }

    fn found(nx: usize, z: &[f64], beyond: MapEdge) -> Vec<(usize, f64)> {
        let pixels = Pixels::new(nx, z);
        pixels.outliers(&pixels.form(), beyond)
    }

    #[test]
    fn spikes_are_found_and_features_are_not() {
        let rough = |u: f64, v: f64| (0.7 * u).sin() + (0.5 * v + 0.2 * u).cos();
        for beyond in MapEdge::ALL {
            let mut z = map(40, 30, |u, v| rough(u, v) + 0.5 * u);
            assert_eq!(found(40, &z, beyond), []);
            let places = [0, 45, 39, 700, 701, 1199];
            for at in places {
                z[at] += if at % 2 == 0 { 60.0 } else { -60.0 };
            }
            let outliers = found(40, &z, beyond);
            let at: Vec<usize> = outliers.iter().map(|one| one.0).collect();
            let mut sorted = places;
            sorted.sort_unstable();
            assert_eq!(at, sorted, "{beyond:?}");
            for (n, median) in outliers {
                let sound = if z[n] > 30.0 {
                    z[n] - 60.0
                } else {
                    z[n] + 60.0
                };
                assert!((median - sound).abs() < 3.0, "{n}: {median} {sound}");
            }
        }
        let dent = map(81, 81, |u, v| -175.0 * (-(u * u + v * v) / 170.0).exp());
        let dimples = map(64, 64, |u, v| {
            let is_in = |w: f64| w.rem_euclid(16.0) < 4.0;
            if is_in(u) && is_in(v) { -5.0 } else { 0.0 }
        });
        let scratch = map(64, 64, |u, v| if u == 4.5 { -900.0 } else { rough(u, v) });
        let ridges = map(64, 8, |u, _| (TAU * u / 4.0).cos());
        for z in [&dent, &dimples, &scratch, &ridges] {
            let nx = if z.len() == 81 * 81 { 81 } else { 64 };
            for beyond in MapEdge::ALL {
                assert_eq!(found(nx, z, beyond), []);
            }
        }
        let mut flat = vec![0.0; 100];
        flat[55] = 6.0;
        assert_eq!(found(10, &flat, MapEdge::Periodic).len(), 1);
    }
}
