//! A measured or made surface on a grid of pixels, between them by cubic convolution.
//!
//! ```text
//! z(x, y) = A Σ_kl s_kl W(u − k) W(v − l),   u = x/Δ + (n_x − 1)/2,   v = y/Δ + (n_y − 1)/2
//! W(t) = 1 − 5/2 t² + 3/2 |t|³  (|t| ≤ 1),   2 − 4|t| + 5/2 t² − ½ |t|³  (1 < |t| ≤ 2),   0 beyond
//! ```
//! | symbol | meaning | shape |
//! |---|---|---|
//! | s | heights over their maximum, level taken off | n_y × n_x, x along rows |
//! | Δ | pixel | m |
//! | A | maximum departure from the level, as asked; the file's own is [`HeightMap::peak_m`] | m |
//!
//! The level is what [`MapLevel`] takes off. The origin is the middle of the map. Order 3 in Δ, continuous slope (Keys 1981, IEEE Trans. ASSP 29,
//! 1153-1160); a test measures the order. *Periodic* maps repeat without end, the mean of what is left is zero.
//! *Windowed* maps stand once: the mean of the outermost pixels of what is left is zero, and a cosine takes the
//! outer tenth of each side down to zero, so that nothing jumps.

use std::f64::consts::PI;

use super::levelling::{Form, MapLevel, MapOutliers, Pixels};
use super::preparation::{carried, low_pass};
use crate::math::spectrum::mean_power;

crate::closed_set! {
    /// What lies beyond a height map.
    #[derive(Default)]
    pub enum MapEdge {
        /// The map again and again.
        #[default]
        Periodic = "periodic",
        /// Nothing: the map stands once and is tapered to zero at its edges.
        Windowed = "windowed",
    }
}

impl MapEdge {
    /// What is taken off where a scene does not say: the plane of a map that stands once. Of one that repeats the mean
    /// alone, because its waves have a plane of their own, which belongs to them.
    pub fn usual_level(self) -> MapLevel {
        match self {
            Self::Periodic => MapLevel::Mean,
            Self::Windowed => MapLevel::Plane,
        }
    }
}

/// What is done to the heights of a map, in this order: outliers, S-filter, level, L-filter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Treatment {
    /// What is taken off.
    pub level: MapLevel,
    /// What becomes of outliers.
    pub outliers: MapOutliers,
    /// Cut-offs of the S- and the L-filter, pixels.
    pub filters: [Option<f64>; 2],
}

/// Part of the variance of height that lies in waves longer than [`HeightMap::shortest`].
pub const SIGNIFICANT: f64 = 0.98;
/// Part of the variance that unevenness along ridges may have: one pixel of them that a median replaced, their noise.
const UNEVEN: f64 = 1e-3;
/// Part of each side of a windowed map that is taken down to zero.
const TAPER: f64 = 0.1;
/// Part of the mean square height that single precision does not tell from nothing.
const CARRIED: f64 = 1e-9;
/// Half-width, in Rq, of the band about the level that a crossing must leave.
const DEAD_BAND: f64 = 0.1;

/// Heights on pixels, over the maximum.
#[derive(Debug, Clone, PartialEq)]
pub struct HeightMap {
    nx: usize,
    ny: usize,
    shape: Vec<f32>,
    beyond: MapEdge,
    /// Maximum departure from the level in the file, m.
    pub peak_m: f64,
    /// Root-mean-square departure from the level over the maximum.
    pub rms: f64,
    /// Crests along x per pixel: upcrossings of the level, mean over the rows.
    pub crests: f64,
    /// Shortest significant wave along x and y, pixels: longer ones hold 98 % of the variance; ∞: no wave.
    pub shortest: [f64; 2],
    /// Whether the map is its own mirror image in y.
    pub is_even_in_y: bool,
    /// What was found in the heights as they came.
    pub facts: MapFacts,
}

crate::closed_set! {
    /// What is wrong or odd about a map's file that could be read all the same.
    pub enum FileDefect {
        /// `.x3p`: not at the top of the archive.
        Folder = "folder" "main.xml lies in a folder",
        /// `.x3p`: the sum that the standard asks for is not there.
        NoChecksum = "no_checksum" "no md5checksum.hex",
        /// `.x3p`: the sum there is not that of main.xml, as of many programs.
        WrongChecksum = "wrong_checksum" "md5checksum.hex is not that of main.xml",
        /// `.x3p`: neither of the two that are published.
        Revision = "revision" "an unknown revision of the format",
        /// `.x3p`: the heights lie elsewhere in the archive than main.xml says.
        Link = "link" "a file does not lie where main.xml says",
        /// `.x3p`: missing points are those that are no numbers alone.
        NoValidity = "no_validity" "the file of valid points is not there",
        /// `.x3p`: a comma for a decimal mark.
        DecimalComma = "decimal_comma" "a decimal comma",
        /// More bytes than the heights need.
        LongData = "long_data" "more data than points",
        /// `.sur`: another number of points than lines times points of a line.
        PointCount = "point_count" "a wrong number of points",
        /// `.sur`: taken as stored.
        Inverted = "inverted" "marked as inverted, taken as stored",
        /// `.sur`: taken as stored.
        Replica = "replica" "marked as measured on a replica, taken as stored",
    }
}

/// A set of [`FileDefect`]s.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct FileDefects(u16);

impl FileDefects {
    /// Adds one.
    pub fn add(&mut self, defect: FileDefect) {
        self.0 |= 1 << defect as u16;
    }

    /// Those in it, in their order.
    pub fn list(self) -> Vec<FileDefect> {
        let is_in = |defect: &FileDefect| self.0 & (1 << *defect as u16) != 0;
        FileDefect::ALL.into_iter().filter(is_in).collect()
    }
}

/// What was found in heights as they came, and what was done about it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MapFacts {
    /// What was taken off.
    pub level: MapLevel,
    /// Least and greatest height of what is left, m.
    pub range_m: [f64; 2],
    /// Slopes of the best plane along x and y, m a pixel.
    pub plane_m: [f64; 2],
    /// Mean square height of that plane over that of the heights, both about the mean.
    pub plane_share: f64,
    /// Whether that plane stands as a step at the seams of a map that repeats ([`Pixels::is_open`]).
    pub is_open: bool,
    /// How many points the file lacked; they were filled from their neighbours.
    pub missing: usize,
    /// What is odd about the file.
    pub defects: FileDefects,
    /// How many outliers there were.
    pub outliers: usize,
    /// What became of them.
    pub outlying: MapOutliers,
    /// [`HeightMap::shortest`] without the outliers that were kept; `None`: none were.
    pub shortest_without_outliers: Option<[f64; 2]>,
    /// The same without the plane that was left in.
    pub shortest_without_plane: Option<[f64; 2]>,
}

impl HeightMap {
    /// A map as [`HeightMap::new`] makes it, of which `level` is taken off and outliers are treated; what was found is
    /// in its [`MapFacts`].
    pub fn treated(
        nx: usize,
        heights_m: &[f64],
        beyond: MapEdge,
        treatment: Treatment,
    ) -> Option<Self> {
        let Treatment {
            level,
            outliers: outlying,
            filters: [short, long],
        } = treatment;
        let raw = Pixels::new(nx, heights_m);
        let outliers = raw.outliers(&raw.form(), beyond);
        let mut sound_m = heights_m.to_vec();
        for &(n, median_m) in &outliers {
            sound_m[n] = median_m;
        }
        let kept_m = match outlying {
            MapOutliers::Keep => heights_m,
            MapOutliers::Median => &sound_m,
        };
        let smooth_m = short.map(|cut_off| low_pass(nx, kept_m, beyond, cut_off));
        let kept_m = smooth_m.as_deref().unwrap_or(kept_m);
        let kept = Pixels::new(nx, kept_m);
        let (form, variance) = (kept.form(), kept.variance());
        let mut map = match long {
            None => Self::levelled(nx, kept_m, beyond, (level, form))?,
            Some(cut_off) => {
                let flat = form.of(level);
                let flat: Vec<f64> = (0..kept_m.len()).map(|n| kept_m[n] - flat.at(n)).collect();
                let long = low_pass(nx, &flat, beyond, cut_off);
                let rough: Vec<f64> = flat.iter().zip(&long).map(|(z, long)| z - long).collect();
                let none = form.of(MapLevel::None);
                Self::levelled(nx, &rough, beyond, (MapLevel::Mean, none))?
            }
        };
        (map.facts.level, map.facts.plane_m) = (level, form.slopes);
        let shortest = |heights_m: &[f64], level: MapLevel| {
            let form = Pixels::new(nx, heights_m).form();
            Self::levelled(nx, heights_m, beyond, (level, form)).map(|map| map.shortest)
        };
        let (is_spiked, is_tilted) = match (outlying, level) {
            (MapOutliers::Keep, _) if !outliers.is_empty() => (true, false),
            (_, MapLevel::None | MapLevel::Mean) => (false, form.slopes != [0.0; 2]),
            (_, MapLevel::Plane | MapLevel::Quadratic) => (false, false),
        };
        map.facts = MapFacts {
            plane_share: if variance > 0.0 {
                form.plane_variance() / variance
            } else {
                0.0
            },
            is_open: beyond == MapEdge::Periodic && kept.is_open(&form),
            outliers: outliers.len(),
            outlying,
            shortest_without_outliers: is_spiked.then(|| shortest(&sound_m, level)).flatten(),
            shortest_without_plane: is_tilted
                .then(|| shortest(kept_m, MapLevel::Plane))
                .flatten(),
            ..map.facts
        };
        Some(map)
    }
    /// A map of `nx` columns along x, row after row towards +y; `None` where there is no height at all.
    /// Heights must be finite, in m.
    pub fn new(nx: usize, heights_m: &[f64], beyond: MapEdge) -> Option<Self> {
        let plain = Treatment {
            level: MapLevel::Mean,
            outliers: MapOutliers::Keep,
            filters: [None; 2],
        };
        Self::treated(nx, heights_m, beyond, plain)
    }

    /// A map that was made and not measured: periodic, less its mean, without outliers.
    pub(crate) fn made(nx: usize, heights_m: &[f64]) -> Option<Self> {
        let form = Pixels::new(nx, heights_m).form();
        Self::levelled(nx, heights_m, MapEdge::Periodic, (MapLevel::Mean, form))
    }

    /// Same, less what `level` says of the best polynomial.
    fn levelled(
        nx: usize,
        heights_m: &[f64],
        beyond: MapEdge,
        (level, best): (MapLevel, Form),
    ) -> Option<Self> {
        let ny = heights_m.len() / nx.max(1);
        if nx == 0 || ny == 0 {
            return None;
        }
        let form = best.of(level);
        let left = |n: usize| heights_m[n] - form.at(n);
        let mean = match level {
            MapLevel::None => 0.0,
            MapLevel::Mean | MapLevel::Plane | MapLevel::Quadratic => mean(nx, ny, left, beyond),
        };
        let window = |at: usize, n: usize| match beyond {
            MapEdge::Periodic => 1.0,
            MapEdge::Windowed => taper(at, n),
        };
        let height = |n: usize| {
            let (i, j) = (n % nx, n / nx);
            (left(n) - mean) * window(i, nx) * window(j, ny)
        };
        let peak_m = (0..nx * ny).map(|n| height(n).abs()).fold(0.0, f64::max);
        // Below this the "height" is rounding of the level.
        let largest = heights_m.iter().fold(0.0_f64, |a, z| a.max(z.abs()));
        if peak_m <= 1e-12 * largest || peak_m == 0.0 {
            return None;
        }
        let shape: Vec<f32> = (0..nx * ny).map(|n| (height(n) / peak_m) as f32).collect();
        let square: f64 = shape.iter().map(|&s| f64::from(s).powi(2)).sum();
        let mut map = Self {
            nx,
            ny,
            beyond,
            peak_m,
            rms: (square / (nx * ny) as f64).sqrt(),
            crests: 0.0,
            shortest: [f64::INFINITY; 2],
            is_even_in_y: false,
            facts: MapFacts {
                level,
                range_m: (0..nx * ny)
                    .map(height)
                    .fold([f64::MAX, f64::MIN], |[a, b], z| [a.min(z), b.max(z)]),
                plane_m: best.slopes,
                plane_share: 0.0,
                is_open: false,
                missing: 0,
                defects: FileDefects::default(),
                outliers: 0,
                outlying: MapOutliers::Keep,
                shortest_without_outliers: None,
                shortest_without_plane: None,
            },
            shape,
        };
        map.crests = map.crest_density();
        let at = |i: usize, j: usize| f64::from(map.shape[j * nx + i]);
        let along = mean_power(nx, ny, |j| (0..nx).map(move |i| at(i, j)));
        let across = mean_power(ny, nx, |i| (0..ny).map(move |j| at(i, j)));
        let of_all = shape_variance(&map.shape);
        map.shortest = [shortest(nx, &along, of_all), shortest(ny, &across, of_all)];
        map.is_even_in_y =
            (0..ny / 2).all(|j| (0..nx).all(|i| (at(i, j) - at(i, ny - 1 - j)).abs() <= 1e-6));
        Some(map)
    }

    /// Pixels along x.
    pub fn nx(&self) -> usize {
        self.nx
    }

    /// Pixels along y.
    pub fn ny(&self) -> usize {
        self.ny
    }

    /// What lies beyond the map.
    pub fn beyond(&self) -> MapEdge {
        self.beyond
    }

    /// The map less what a mesh of nodes so many pixels apart along x and y can't carry ([`carried`]); `None`: it has no such waves.
    pub fn carried_by(&self, spacing: [f64; 2]) -> Option<Self> {
        if spacing.iter().all(|&apart| apart <= 1.0) {
            return None;
        }
        let shape: Vec<f64> = self.shape.iter().copied().map(f64::from).collect();
        let left = carried(self.nx, &shape, spacing);
        let square = |shape: &[f64]| shape.iter().map(|z| z * z).sum::<f64>();
        (square(&left) < square(&shape) * (1.0 - CARRIED)).then(|| Self {
            shape: left.iter().map(|&z| z as f32).collect(),
            ..self.clone()
        })
    }

    /// z/A at `x`, `y` in pixels from the middle.
    pub fn sample(&self, x: f64, y: f64) -> f64 {
        let (row, w_y) = Self::stencil(y, self.ny);
        let (column, w_x) = Self::stencil(x, self.nx);
        let mut z = 0.0;
        for (l, &w) in w_y.iter().enumerate() {
            let Some(j) = self.wrapped(row + l as i64, self.ny) else {
                continue;
            };
            let line = &self.shape[j * self.nx..(j + 1) * self.nx];
            for (k, &v) in w_x.iter().enumerate() {
                if let Some(i) = self.wrapped(column + k as i64, self.nx) {
                    z += w * v * f64::from(line[i]);
                }
            }
        }
        z
    }

    /// The row at `y` pixels from the middle: its heights over A at every pixel of x, into `out` of
    /// length [`HeightMap::nx`].
    pub fn row_into(&self, y: f64, out: &mut [f32]) {
        let (row, weights) = Self::stencil(y, self.ny);
        out.fill(0.0);
        for (l, &w) in weights.iter().enumerate() {
            if let Some(j) = self.wrapped(row + l as i64, self.ny) {
                let line = &self.shape[j * self.nx..(j + 1) * self.nx];
                for (o, &s) in out.iter_mut().zip(line) {
                    *o += (w * f64::from(s)) as f32;
                }
            }
        }
    }

    /// First of four pixels about `x` (pixels from the middle of `n`), and their weights.
    pub fn stencil(x: f64, n: usize) -> (i64, [f64; 4]) {
        let u = x + 0.5 * (n - 1) as f64;
        let base = u.floor();
        let t = u - base;
        let (t2, t3) = (t * t, t * t * t);
        let weights = [
            -0.5 * t3 + t2 - 0.5 * t,
            1.5 * t3 - 2.5 * t2 + 1.0,
            -1.5 * t3 + 2.0 * t2 + 0.5 * t,
            0.5 * t3 - 0.5 * t2,
        ];
        (base as i64 - 1, weights)
    }

    /// Index of pixel `k` of `n`; `None`: beyond a windowed map.
    #[inline]
    pub fn wrapped(&self, k: i64, n: usize) -> Option<usize> {
        match self.beyond {
            MapEdge::Periodic => Some(k.rem_euclid(n as i64) as usize),
            MapEdge::Windowed => (0..n as i64).contains(&k).then_some(k as usize),
        }
    }

    /// Mean of |z| over the greatest |z|.
    pub fn mean_height(&self) -> f64 {
        let sum: f64 = self.shape.iter().map(|&s| f64::from(s).abs()).sum();
        sum / self.shape.len() as f64
    }

    /// Skewness and kurtosis of the heights, ⟨z³⟩/Sq³ and ⟨z⁴⟩/Sq⁴ (ISO 25178-2: Ssk, Sku).
    pub fn moments(&self) -> [f64; 2] {
        [3, 4].map(|power| {
            let sum: f64 = (self.shape.iter())
                .map(|&s| (f64::from(s) / self.rms).powi(power))
                .sum();
            sum / self.shape.len() as f64
        })
    }

    /// Upcrossings of the level per pixel along x. A crossing counts when the height leaves a band of
    /// ±Rq/10 about the level, so that noise on it does not.
    fn crest_density(&self) -> f64 {
        let band = (DEAD_BAND * self.rms) as f32;
        let mut crossings = 0_u64;
        for line in self.shape.chunks_exact(self.nx) {
            // Once round to know the side on which the row starts, once to count.
            let mut side = 0;
            let around = line.iter().chain(line);
            for (n, &z) in around.enumerate() {
                let now = i32::from(z > band) - i32::from(z < -band);
                if now != 0 {
                    let counted = n >= self.nx || self.beyond == MapEdge::Windowed;
                    crossings += u64::from(counted && side < 0 && now > 0);
                    side = now;
                }
                if self.beyond == MapEdge::Windowed && n + 1 == self.nx {
                    break;
                }
            }
        }
        crossings as f64 / (self.nx * self.ny) as f64
    }
}

/// Mean of all pixels, of a windowed map of the outermost.
fn mean(nx: usize, ny: usize, height: impl Fn(usize) -> f64, beyond: MapEdge) -> f64 {
    let is_rim = |n: usize| {
        let (i, j) = (n % nx, n / nx);
        i == 0 || j == 0 || i + 1 == nx || j + 1 == ny
    };
    let mut sum = 0.0;
    let mut count = 0.0;
    for n in 0..nx * ny {
        if beyond == MapEdge::Periodic || is_rim(n) {
            sum += height(n);
            count += 1.0;
        }
    }
    sum / count
}

/// 1 inside, down to 0 over the outer tenth.
fn taper(at: usize, n: usize) -> f64 {
    if n < 2 {
        return 1.0;
    }
    let from_edge = at.min(n - 1 - at) as f64 / (n - 1) as f64;
    if from_edge >= TAPER {
        1.0
    } else {
        0.5 - 0.5 * (PI * from_edge / TAPER).cos()
    }
}

fn shape_variance(shape: &[f32]) -> f64 {
    let n = shape.len().max(1) as f64;
    let mean = shape.iter().copied().map(f64::from).sum::<f64>() / n;
    let squares = shape.iter().map(|&s| (f64::from(s) - mean).powi(2));
    squares.sum::<f64>() / n
}

/// The wave beyond which only 2 % of the variance is left, pixels; ∞ where nothing varies. `variance`: of the whole map.
/// Where less than [`UNEVEN`] of it runs this way, that is no wave that a mesh must carry, but it is not nothing.
fn shortest(n: usize, power: &[f64], variance: f64) -> f64 {
    let total: f64 = power.iter().skip(1).sum();
    let constant = power.first().copied().unwrap_or(0.0);
    if total <= 1e-12 * constant || total == 0.0 {
        return f64::INFINITY;
    }
    // Parseval: the sum is n² times the mean variance of the lines.
    if total < UNEVEN * variance * (n * n) as f64 {
        return n as f64;
    }
    let mut sum = 0.0;
    for (k, p) in power.iter().enumerate().skip(1) {
        sum += p;
        if sum >= SIGNIFICANT * total {
            return n as f64 / k as f64;
        }
    }
    2.0
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "tests")]

    use super::*;
    use std::f64::consts::TAU;

    /// Two waves a side, mean 3.
    fn waves(n: usize) -> HeightMap {
        let heights: Vec<f64> = (0..n * n)
            .map(|m| {
                let (x, y) = ((m % n) as f64 / n as f64, (m / n) as f64 / n as f64);
                3.0 + 2e-7 * (TAU * 2.0 * x).cos() * (TAU * y).sin()
            })
            .collect();
        HeightMap::new(n, &heights, MapEdge::Periodic).unwrap()
    }

    #[test]
    fn order_of_the_interpolation() {
        let error = |n: usize| {
            let map = waves(n);
            let mut worst = 0.0_f64;
            for m in 0..400 {
                let (u, v) = (0.37 + 0.0719 * m as f64, 0.11 + 0.0313 * m as f64);
                let exact = (TAU * 2.0 * u).cos() * (TAU * v).sin();
                // Pixels from the middle.
                let at = |w: f64| w * n as f64 - 0.5 * (n - 1) as f64;
                worst = worst.max((map.sample(at(u), at(v)) - exact).abs());
            }
            worst
        };
        let errors = [32, 64, 128].map(error);
        let orders = [errors[0] / errors[1], errors[1] / errors[2]].map(f64::log2);
        println!("errors {errors:?}, orders {orders:?}");
        assert!(orders.iter().all(|&order| order > 2.8));
    }

    #[test]
    fn what_a_map_is_reduced_to() {
        let map = waves(64);
        assert!((map.peak_m / 2e-7 - 1.0).abs() < 1e-3);
        assert!((map.rms - 0.5).abs() < 1e-3);
        // Two waves in 64 pixels along x, seen in every row but those on the nodes of the sine.
        assert!((map.crests * 64.0 - 2.0).abs() < 0.1, "{}", map.crests);
        assert!((map.shortest[0] - 32.0).abs() < 1e-9 && (map.shortest[1] - 64.0).abs() < 1e-9);
        assert!(!map.is_even_in_y);
        assert!(HeightMap::new(4, &[1.7; 16], MapEdge::Periodic).is_none());
        assert!(HeightMap::new(0, &[], MapEdge::Periodic).is_none());
    }

    #[test]
    fn a_pixel_that_is_mended_makes_no_wave_along_ridges() {
        let ridges = |off: f64| {
            let mut z: Vec<f64> = (0..32 * 32)
                .map(|m| 2e-7 * (TAU * (m % 32) as f64 / 8.0).cos())
                .collect();
            z[20 * 32 + 17] += off;
            HeightMap::new(32, &z, MapEdge::Periodic).unwrap().shortest
        };
        assert_eq!(ridges(0.0), [8.0, f64::INFINITY]);
        // A share of 1/32² of (50/141)², along y 31/32 of it: 1.2e-4 of the variance.
        assert_eq!(ridges(5e-8), [8.0, 32.0]);
        // (200/141)²/32² = 2e-3 is more than a thousandth: white along y.
        assert_eq!(ridges(2e-7)[1], 2.0);
    }

    #[test]
    fn a_windowed_map_ends_in_nothing() {
        let n = 41;
        let bump = |m: usize| {
            let (x, y) = ((m % n) as f64 - 20.0, (m / n) as f64 - 20.0);
            5.0 - 1e-7 * (-(x * x + y * y) / 30.0).exp()
        };
        let heights: Vec<f64> = (0..n * n).map(bump).collect();
        let map = HeightMap::new(n, &heights, MapEdge::Windowed).unwrap();
        assert!(map.is_even_in_y);
        assert!((map.sample(0.0, 0.0) + 1.0).abs() < 1e-6, "a dent");
        let exact = -(-(2.5_f64.powi(2) + 1.2_f64.powi(2)) / 30.0).exp();
        assert!((map.sample(2.5, -1.2) - exact).abs() < 1e-3);
        assert_eq!(map.sample(20.0, 3.0), 0.0);
        assert_eq!(map.sample(-25.0, 3.0), 0.0);
        // A single dent has no crests.
        assert_eq!(map.crests, 0.0);
    }

    #[test]
    fn rows_and_points_agree() {
        let map = waves(32);
        let mut row = vec![0.0; 32];
        map.row_into(4.3, &mut row);
        for (i, &z) in row.iter().enumerate() {
            let x = i as f64 - 15.5;
            assert!((f64::from(z) - map.sample(x, 4.3)).abs() < 1e-6);
        }
    }
}
