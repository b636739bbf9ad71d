//! Surface parameters of a height map: areal ones, and those of its rows as profiles.
//!
//! ```text
//! Sq = √⟨z²⟩   Sa = ⟨|z|⟩   Sp = max z   Sv = −min z   Sz = Sp + Sv   Ssk = ⟨z³⟩/Sq³   Sku = ⟨z⁴⟩/Sq⁴   Sdq = √⟨z_x² + z_y²⟩
//! R(t) = ⟨z(r) z(r + t)⟩/Sq²,   Sal = min |t|,   Str = Sal/max |t|   over the edge R = 0.2 of the lobe about t = 0
//! ```
//! | symbol | meaning | unit |
//! |---|---|---|
//! | z | height over the mean of the map | m |
//! | ⟨ ⟩ | mean over the pixels; in R over those that have a partner at t | |
//! | t | shift along x and y | m |
//!
//! *Heights* and *Sdq*: ISO 25178-2:2021. Central differences (one-sided at the edges of the map) see the slope of a wave of
//! length λ smaller by sin(2πΔ/λ)/(2πΔ/λ), forward differences by sin(πΔ/λ)/(πΔ/λ), Δ the pixel: with ten pixels a wave
//! 6.5 % and 1.6 %. Programs use either, or the seven points of ISO 4287:1997; both are given. Forward differences are
//! averaged along x and along y over as many as there are.
//!
//! *Sal* and *Str*: ISO 25178-2:2021. A measured map does not go on beyond its edges, so R is linear (padded by zeros), not
//! circular; and unbiased, each shift over its own number of pairs, else R would fall with the shift by itself. `surfalize`
//! 0.19 and Gwyddion do the same. The lobe is what hangs together with t = 0 by steps of a pixel along x or y with R ≥ 0.2;
//! its edge lies where the lines of pixels cross it, by the cubic through four shifts. A lobe that reaches the largest shift
//! has no longest distance, hence no Str (ridges that cross the map); Sal stays if its edge comes closer to t = 0 than the
//! largest shifts that it reaches. Sal is the least of many uncertain distances, and Str their least over their greatest:
//! of a finite map an isotropic surface has Str below 1 (a test: 0.95 of 60 by 60 correlation lengths).
//!
//! *Lay*: the texture direction Std of ISO 25178-2:2021, but by power, where that has amplitude: |F|² of the map under a
//! Hann window, in sectors of 1° by the angle of the wave vector from x towards y (from row to row). From the middle of the
//! 15 neighbouring sectors of greatest sum on, the mean direction of the power within 15°, weighed by cos² down to nothing
//! there, about that again until it stands. Ridges along y have 0.
//!
//! *Profiles*: ISO 21920-2:2021 and ISO 4287:1997, each row less its own mean, without a further filter; means over the rows.
//! Ra, Rq: over the whole row. Rz: highest less lowest, mean over five sampling lengths, the fifths of a row. Rsm: the
//! portions of a row between crossings of its mean line (straight between pixels) count that are as high as 10 % of its Rz
//! and as long as 1 % of a sampling length (the discrimination of ISO 4287; instruments after ISO 21920-2 take 10 % of Rp and
//! of Rv, about half as much). Where one of the other sign follows, the profile crosses: half-way between the two if others
//! lie between, so that it does not matter from where a row is read. Profile elements are a peak and a valley or a valley and
//! a peak (ISO 21920-2): from each crossing to the next but one.

use std::f64::consts::PI;

use realfft::RealFftPlanner;
use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};

/// R at the edge of the lobe (ISO 25178-2).
const DECAY: f64 = 0.2;
/// Str above which there is no lay.
const ISOTROPIC: f64 = 0.5;
/// Sampling lengths of a profile (ISO 4288, ISO 21920-3).
const SAMPLING_LENGTHS: usize = 5;
/// Height over Rz that a portion of a profile must have.
const LEAST_HEIGHT: f64 = 0.1;
/// Length over the sampling length that a portion of a profile must have.
const LEAST_LENGTH: f64 = 0.01;
/// Pixels of a row: two of each sampling length.
const LEAST_ROW: usize = 2 * SAMPLING_LENGTHS;
/// Sectors of the half turn.
const SECTORS: usize = 180;
/// Sectors on each side of the middle that are summed.
const SECTOR_REACH: i64 = 7;
/// Half-width of the fan over which a direction is a mean, rad.
const FAN: f64 = 15.0 * PI / 180.0;

/// Times that a fan is set about its mean.
const MOST_TURNS: usize = 50;

/// What [`parameters`] finds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArealParameters {
    /// Root mean square height, m.
    pub sq_m: f64,
    /// Arithmetic mean height, m.
    pub sa_m: f64,
    /// Maximum peak height, m.
    pub sp_m: f64,
    /// Maximum pit depth, m.
    pub sv_m: f64,
    /// Maximum height, m.
    pub sz_m: f64,
    /// Skewness.
    pub ssk: f64,
    /// Kurtosis, 3 of Gaussian heights.
    pub sku: f64,
    /// Root mean square slope by central differences.
    pub sdq: f64,
    /// Root mean square slope by forward differences.
    pub sdq_forward: f64,
    /// Autocorrelation length, m; `None`: the map is too small for it.
    pub sal_m: Option<f64>,
    /// Texture aspect ratio; `None`: the map is too small for it.
    pub str_ratio: Option<f64>,
    /// Angle from x, in (−90, 90]°, of the wave vectors that have most power; `None` where Str is or may be above 0.5.
    pub lay_deg: Option<f64>,
    /// Arithmetic mean deviation of profiles along x, m.
    pub ra_m: f64,
    /// Root mean square deviation of profiles along x, m.
    pub rq_m: f64,
    /// Maximum height of profiles along x, m.
    pub rz_m: f64,
    /// Mean spacing of profile elements along x, m; `None`: no row has one.
    pub rsm_m: Option<f64>,
}

/// Parameters of rows of `nx` heights, whose level, the mean apart, has been taken off, on pixels of `pixel_m` along x and y.
/// `None`: no whole rows, fewer than ten pixels in a row, a height that is no number, no height at all, or no pixel.
pub fn parameters(nx: usize, heights_m: &[f64], pixel_m: [f64; 2]) -> Option<ArealParameters> {
    let map = Map::new(nx, heights_m, pixel_m)?;
    let moment = |of: &dyn Fn(f64) -> f64| mean(map.z.iter().map(|&z| of(z)));
    let sq = moment(&|z| z * z).sqrt();
    let [least, most] = extremes(&map.z);
    let lobe = Lobe::of(&Correlation::of(&map));
    let rows: Vec<Profile> = map.rows().map(Profile::of).collect();
    let spacings: Vec<f64> = rows.iter().filter_map(Profile::spacing).collect();
    Some(ArealParameters {
        sq_m: sq,
        sa_m: moment(&f64::abs),
        sp_m: most,
        sv_m: -least,
        sz_m: most - least,
        ssk: moment(&|z| (z / sq).powi(3)),
        sku: moment(&|z| (z / sq).powi(4)),
        sdq: map.slope_central(),
        sdq_forward: map.slope_forward(),
        sal_m: lobe.sal(),
        str_ratio: lobe.aspect(),
        lay_deg: lobe.is_directed().then(|| map.lay()).flatten(),
        ra_m: mean(rows.iter().map(|row| mean(row.z.iter().map(|z| z.abs())))),
        rq_m: mean(rows.iter().map(Profile::rq)),
        rz_m: mean(rows.iter().map(|row| row.rz)),
        rsm_m: (!spacings.is_empty()).then(|| mean(spacings.iter().copied()) * pixel_m[0]),
    })
}

/// Mean; 0 of none.
fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0_usize), |(sum, count), v| (sum + v, count + 1));
    sum / count.max(1) as f64
}

/// Least and greatest.
fn extremes(values: &[f64]) -> [f64; 2] {
    let start = [f64::INFINITY, f64::NEG_INFINITY];
    let step = |[low, high]: [f64; 2], &v: &f64| [low.min(v), high.max(v)];
    values.iter().fold(start, step)
}

/// Heights over their mean.
struct Map {
    nx: usize,
    ny: usize,
    z: Vec<f64>,
    pixel: [f64; 2],
}

impl Map {
    fn new(nx: usize, heights_m: &[f64], pixel: [f64; 2]) -> Option<Self> {
        let is_whole = nx >= LEAST_ROW && heights_m.len().is_multiple_of(nx);
        let has_pixels = pixel.iter().all(|side| side.is_finite() && *side > 0.0);
        let is_measured = heights_m.iter().all(|z| z.is_finite());
        let [least, most] = extremes(heights_m);
        if !(is_whole && has_pixels && is_measured && least < most) {
            return None;
        }
        let level = mean(heights_m.iter().copied());
        Some(Self {
            nx,
            ny: heights_m.len() / nx,
            z: heights_m.iter().map(|z| z - level).collect(),
            pixel,
        })
    }

    fn rows(&self) -> std::slice::ChunksExact<'_, f64> {
        self.z.chunks_exact(self.nx)
    }

    /// Slope per pixel at pixel `i` of `n` whose heights are `at`, between the neighbours that it has.
    fn difference(n: usize, i: usize, at: impl Fn(usize) -> f64) -> f64 {
        let (before, after) = (i.saturating_sub(1), (i + 1).min(n - 1));
        (at(after) - at(before)) / (after - before).max(1) as f64
    }

    /// Sdq by central differences.
    fn slope_central(&self) -> f64 {
        let Self { nx, ny, z, pixel } = self;
        let square = |place: usize| {
            let (i, j) = (place % nx, place / nx);
            let along = Self::difference(*nx, i, |i| z[j * nx + i]) / pixel[0];
            let across = Self::difference(*ny, j, |j| z[j * nx + i]) / pixel[1];
            along * along + across * across
        };
        mean((0..z.len()).map(square)).sqrt()
    }

    /// Sdq by forward differences.
    fn slope_forward(&self) -> f64 {
        let square = |from: f64, to: f64, pixel: f64| ((to - from) / pixel).powi(2);
        let along = (self.rows()).flat_map(|row| row.windows(2).map(|z| [z[0], z[1]]));
        let across = self.z.iter().zip(self.z.iter().skip(self.nx));
        let [dx, dy] = self.pixel;
        let x = mean(along.map(|[from, to]| square(from, to, dx)));
        let y = mean(across.map(|(&from, &to)| square(from, to, dy)));
        (x + y).sqrt()
    }

    /// The waves of the map under a Hann window that leaves no mean.
    fn windowed_waves(&self) -> Waves {
        let hann = |i: usize, n: usize| (PI * (i as f64 + 0.5) / n as f64).sin().powi(2);
        let along: Vec<f64> = (0..self.nx).map(|i| hann(i, self.nx)).collect();
        let weight = |place: usize| along[place % self.nx] * hann(place / self.nx, self.ny);
        let weights: Vec<f64> = (0..self.z.len()).map(weight).collect();
        let sum: f64 = weights.iter().zip(&self.z).map(|(w, z)| w * z).sum();
        let level = sum / weights.iter().sum::<f64>();
        let seen: Vec<f64> = (weights.iter().zip(&self.z))
            .map(|(w, z)| w * (z - level))
            .collect();
        Waves::of(&seen, self.nx, [self.nx, self.ny])
    }

    /// Angle and power of the waves, in [−π/2, π/2]. A wave of two pixels runs either way: it is left out.
    fn directions(&self) -> Vec<[f64; 2]> {
        let waves = self.windowed_waves();
        let ny = self.ny as i64;
        let [x, y] = [0, 1].map(|k| 1.0 / (self.pixel[k] * waves.sides[k] as f64));
        let direction = |(place, value): (usize, &Complex<f64>)| {
            let (m, n) = (place % waves.half, (place / waves.half) as i64);
            let n = if 2 * n > ny { n - ny } else { n };
            let runs_either_way = 2 * m == self.nx || 2 * n == ny;
            let is_known = !runs_either_way && (m > 0 || n > 0);
            is_known.then(|| [(n as f64 * y).atan2(m as f64 * x), value.norm_sqr()])
        };
        (waves.values.iter().enumerate())
            .filter_map(direction)
            .collect()
    }

    /// Direction of most power, degrees in (−90, 90].
    fn lay(&self) -> Option<f64> {
        let directions = self.directions();
        let mut sectors = [0.0; SECTORS];
        for [angle, power] in &directions {
            let sector = ((angle / PI + 0.5) * SECTORS as f64) as usize;
            sectors[sector % SECTORS] += power;
        }
        let about = |middle: usize| -> f64 {
            let sector = |k: i64| (middle as i64 + k).rem_euclid(SECTORS as i64) as usize;
            (-SECTOR_REACH..=SECTOR_REACH)
                .map(|k| sectors[sector(k)])
                .sum()
        };
        let best = (0..SECTORS).max_by(|&a, &b| about(a).total_cmp(&about(b)))?;
        let middle = ((best as f64 + 0.5) / SECTORS as f64 - 0.5) * PI;
        let lay = centre(&directions, middle)?.to_degrees();
        Some(90.0 - (90.0 - lay).rem_euclid(180.0))
    }
}

/// Mean direction of the power within [`FAN`] of itself, the less weighed the farther off (cos²), from `middle` on.
fn centre(directions: &[[f64; 2]], mut middle: f64) -> Option<f64> {
    for _ in 0..MOST_TURNS {
        let (mut turn, mut sum) = (0.0, 0.0);
        for [angle, power] in directions {
            let off = (angle - middle + 0.5 * PI).rem_euclid(PI) - 0.5 * PI;
            if off.abs() <= FAN {
                let weighed = power * (0.5 * PI * off / FAN).cos().powi(2);
                turn += weighed * off;
                sum += weighed;
            }
        }
        if sum <= 0.0 {
            return None;
        }
        middle += turn / sum;
        if (turn / sum).abs() < 1e-9 {
            break;
        }
    }
    Some(middle)
}

/// Fourier transform of real heights, `half` = n_x/2 + 1 waves a row.
struct Waves {
    sides: [usize; 2],
    half: usize,
    values: Vec<Complex<f64>>,
}

impl Waves {
    /// Of rows of `nx` heights, padded by zeros to `sides`.
    fn of(z: &[f64], nx: usize, sides: [usize; 2]) -> Self {
        let plan = RealFftPlanner::<f64>::new().plan_fft_forward(sides[0]);
        let half = sides[0] / 2 + 1;
        let mut values = vec![Complex::default(); half * sides[1]];
        let mut line = plan.make_input_vec();
        for (row, out) in z.chunks_exact(nx).zip(values.chunks_exact_mut(half)) {
            line.fill(0.0);
            line[..nx].copy_from_slice(row);
            plan.process(&mut line, out)
                .expect("lengths are those of the plan");
        }
        let mut waves = Self {
            sides,
            half,
            values,
        };
        waves.columns(&*FftPlanner::new().plan_fft_forward(sides[1]));
        waves
    }

    /// Transforms each column.
    fn columns(&mut self, plan: &dyn Fft<f64>) {
        let mut column = vec![Complex::default(); self.sides[1]];
        for m in 0..self.half {
            for (to, from) in column.iter_mut().zip(self.values[m..].chunks(self.half)) {
                *to = from[0];
            }
            plan.process(&mut column);
            for (from, to) in column.iter().zip(self.values[m..].chunks_mut(self.half)) {
                to[0] = *from;
            }
        }
    }

    /// Back to values, `n_x n_y` times what they were.
    fn back(mut self) -> Vec<f64> {
        let [nx, ny] = self.sides;
        self.columns(&*FftPlanner::new().plan_fft_inverse(ny));
        let plan = RealFftPlanner::<f64>::new().plan_fft_inverse(nx);
        let mut heights = vec![0.0; nx * ny];
        for (row, out) in
            (self.values.chunks_exact_mut(self.half)).zip(heights.chunks_exact_mut(nx))
        {
            // Both are real but for rounding, and the plan insists.
            row[0].im = 0.0;
            if nx.is_multiple_of(2) {
                row[nx / 2].im = 0.0;
            }
            plan.process(row, out)
                .expect("lengths are those of the plan");
        }
        heights
    }
}

/// R by shift.
struct Correlation {
    /// Largest shift along x and y, pixels.
    reach: [i64; 2],
    pixel: [f64; 2],
    sides: [usize; 2],
    /// Sums of products over that at no shift and the pixels of the map, negative shifts from the end.
    sums: Vec<f64>,
}

/// Least length from `least` on that has no factor but 2 and 3.
fn padded(least: usize) -> usize {
    let powers = std::iter::successors(Some(1_usize), |t| Some(3 * t));
    let threes = powers.take_while(|t| *t < 3 * least);
    let lengths = threes.map(|t| t * least.div_ceil(t).next_power_of_two());
    lengths.min().unwrap_or(least)
}

impl Correlation {
    fn of(map: &Map) -> Self {
        let sides = [map.nx, map.ny].map(|n| padded(2 * n - 1));
        let mut waves = Waves::of(&map.z, map.nx, sides);
        for value in &mut waves.values {
            *value = Complex::new(value.norm_sqr(), 0.0);
        }
        let mut sums = waves.back();
        let norm = sums[0] / map.z.len() as f64;
        for sum in &mut sums {
            *sum /= norm;
        }
        Self {
            reach: [map.nx, map.ny].map(|n| n as i64 - 1),
            pixel: map.pixel,
            sides,
            sums,
        }
    }

    fn is_inside(&self, t: [i64; 2]) -> bool {
        t[0].abs() <= self.reach[0] && t[1].abs() <= self.reach[1]
    }

    /// R at a shift of pixels inside.
    fn at(&self, t: [i64; 2]) -> f64 {
        let [i, j] = [0, 1].map(|k| t[k].rem_euclid(self.sides[k] as i64) as usize);
        let [pairs_x, pairs_y] = [0, 1].map(|k| self.reach[k] + 1 - t[k].abs());
        self.sums[j * self.sides[0] + i] / (pairs_x * pairs_y) as f64
    }

    /// |t| of `step` times `part` beyond the shift `t`, m.
    fn distance(&self, t: [i64; 2], step: [i64; 2], part: f64) -> f64 {
        let side = |k: usize| (t[k] as f64 + part * step[k] as f64) * self.pixel[k];
        side(0).hypot(side(1))
    }

    /// Part of `step` from the shift `t`, within the lobe, at which R = [`DECAY`].
    fn crossing(&self, t: [i64; 2], step: [i64; 2]) -> f64 {
        let place = |k: i64| [t[0] + k * step[0], t[1] + k * step[1]];
        let [here, next] = [self.at(t), self.at(place(1))];
        if !(self.is_inside(place(-1)) && self.is_inside(place(2))) {
            return (here - DECAY) / (here - next);
        }
        let [before, after] = [self.at(place(-1)), self.at(place(2))];
        let cubic = |u: f64| {
            (u + 1.0) * (u - 2.0) * ((u - 1.0) * here - u * next) / 2.0
                + u * (u - 1.0) * ((u + 1.0) * after - (u - 2.0) * before) / 6.0
        };
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..30 {
            let middle = 0.5 * (low + high);
            if cubic(middle) >= DECAY {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }
}

/// The region about no shift in which R ≥ [`DECAY`].
struct Lobe {
    /// Least and greatest distance of its edge, m.
    edge: [f64; 2],
    /// Least and greatest distance at which it reaches the largest shift, m; (∞, 0): it does not.
    open: [f64; 2],
}

impl Lobe {
    fn of(r: &Correlation) -> Self {
        let nothing = [f64::INFINITY, 0.0];
        let mut lobe = Self {
            edge: nothing,
            open: nothing,
        };
        let width = 2 * r.reach[0] + 1;
        let place = |t: [i64; 2]| ((t[1] + r.reach[1]) * width + t[0] + r.reach[0]) as usize;
        let mut is_seen = vec![false; place(r.reach) + 1];
        let mut open = vec![[0, 0]];
        is_seen[place([0, 0])] = true;
        while let Some(t) = open.pop() {
            for step in [[1, 0], [-1, 0], [0, 1], [0, -1]] {
                let next = [t[0] + step[0], t[1] + step[1]];
                if !r.is_inside(next) {
                    Self::widen(&mut lobe.open, r.distance(t, step, 0.0));
                } else if r.at(next) < DECAY {
                    let part = r.crossing(t, step);
                    Self::widen(&mut lobe.edge, r.distance(t, step, part));
                } else if !is_seen[place(next)] {
                    is_seen[place(next)] = true;
                    open.push(next);
                }
            }
        }
        lobe
    }

    fn widen(range: &mut [f64; 2], distance: f64) {
        *range = [range[0].min(distance), range[1].max(distance)];
    }

    /// Sal, m.
    fn sal(&self) -> Option<f64> {
        let [least, _] = self.edge;
        (least.is_finite() && least <= self.open[0]).then_some(least)
    }

    /// Str.
    fn aspect(&self) -> Option<f64> {
        let is_closed = self.open[0].is_infinite();
        Some(self.sal()? / self.edge[1]).filter(|_| is_closed)
    }

    /// Whether Str is at most [`ISOTROPIC`], as far as the lobe can be seen.
    fn is_directed(&self) -> bool {
        let longest = self.edge[1].max(self.open[1]);
        self.sal().is_some_and(|sal| sal <= ISOTROPIC * longest)
    }
}

/// A row over its mean.
struct Profile {
    z: Vec<f64>,
    rz: f64,
}

/// A portion of a profile on one side of its mean line, from and to in pixels.
struct Portion {
    is_peak: bool,
    from: f64,
    to: f64,
    height: f64,
}

impl Profile {
    fn of(row: &[f64]) -> Self {
        let level = mean(row.iter().copied());
        let z: Vec<f64> = row.iter().map(|z| z - level).collect();
        let n = z.len();
        let section = |k: usize| &z[k * n / SAMPLING_LENGTHS..(k + 1) * n / SAMPLING_LENGTHS];
        let height = |k: usize| {
            let [least, most] = extremes(section(k));
            most - least
        };
        let rz = mean((0..SAMPLING_LENGTHS).map(height));
        Self { z, rz }
    }

    fn rq(&self) -> f64 {
        mean(self.z.iter().map(|z| z * z)).sqrt()
    }

    /// The portions between the crossings of the mean line.
    fn portions(&self) -> Vec<Portion> {
        let mut portions: Vec<Portion> = Vec::new();
        for (i, &z) in self.z.iter().enumerate() {
            let is_peak = z >= 0.0;
            match portions.last_mut() {
                Some(last) if last.is_peak == is_peak => {
                    last.to = i as f64;
                    last.height = last.height.max(z.abs());
                }
                last => {
                    let before = self.z[i.saturating_sub(1)];
                    let from = last.map_or(0.0, |last| {
                        last.to = i as f64 - z / (z - before);
                        last.to
                    });
                    portions.push(Portion {
                        is_peak,
                        from,
                        to: i as f64,
                        height: z.abs(),
                    });
                }
            }
        }
        portions
    }

    /// Where the profile crosses its mean line between portions that count, pixels.
    fn crossings(&self) -> Vec<f64> {
        let least_length = LEAST_LENGTH * self.z.len() as f64 / SAMPLING_LENGTHS as f64;
        let least_height = LEAST_HEIGHT * self.rz;
        let counts = |p: &Portion| p.height >= least_height && p.to - p.from >= least_length;
        let counted: Vec<Portion> = self.portions().into_iter().filter(counts).collect();
        (counted.windows(2))
            .filter(|pair| pair[0].is_peak != pair[1].is_peak)
            .map(|pair| 0.5 * (pair[0].to + pair[1].from))
            .collect()
    }

    /// Rsm, pixels.
    fn spacing(&self) -> Option<f64> {
        let crossings = self.crossings();
        let elements = crossings.windows(3).map(|c| c[2] - c[0]);
        (crossings.len() >= 3).then(|| mean(elements))
    }
}

#[cfg(test)]
#[expect(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::super::random_surface::{Autocorrelation, RandomSpectrum};
    use super::*;
    use approx::assert_relative_eq;
    use std::f64::consts::TAU;

    const A: f64 = 2e-7;
    const PIXEL: [f64; 2] = [1e-6, 1e-6];

    fn surface(nx: usize, ny: usize, z: impl Fn(f64, f64) -> f64) -> Vec<f64> {
        let height = |place: usize| z((place % nx) as f64, (place / nx) as f64);
        (0..nx * ny).map(height).collect()
    }

    /// A surface of Gaussian autocorrelation, correlation lengths `length` over periods of `period`, 8 pixels a unit.
    fn gaussian(seed: u64, length: [f64; 2], period: f64) -> (usize, Vec<f64>) {
        let spectrum = RandomSpectrum {
            skewness: 0.0,
            kurtosis: 3.0,
            seed,
            autocorrelation: Autocorrelation::Gaussian,
            correlation_m: length,
            hurst: 0.8,
            cutoff_short_m: 1.0,
            cutoff_long_m: f64::INFINITY,
            period_m: [period; 2],
        };
        let map = spectrum.make().unwrap();
        let (nx, ny) = (map.nx(), map.ny());
        let mut row = vec![0.0_f32; nx];
        let mut heights = Vec::new();
        for j in 0..ny {
            map.row_into(j as f64 - 0.5 * (ny - 1) as f64, &mut row);
            heights.extend(row.iter().map(|&z| f64::from(z)));
        }
        (nx, heights)
    }

    #[test]
    fn a_ridge_has_its_closed_forms() {
        let (n, waves, wave) = (800, 20, 40.0);
        let heights = surface(n, 60, |x, _| 3.0 + A * (TAU * x / wave).cos());
        let found = parameters(n, &heights, PIXEL).unwrap();
        assert_relative_eq!(found.sq_m, A / 2f64.sqrt(), max_relative = 1e-8);
        assert_relative_eq!(found.rq_m, found.sq_m, max_relative = 1e-8);
        // The mean of |cos| over 40 points is π/40/tan(π/40) of 2/π.
        let sa = A * 2.0 / PI * (PI / wave) / (PI / wave).tan();
        assert_relative_eq!(found.sa_m, sa, max_relative = 1e-7);
        assert_relative_eq!(found.ra_m, found.sa_m, max_relative = 1e-8);
        assert_relative_eq!(found.sz_m, 2.0 * A, max_relative = 1e-8);
        assert_relative_eq!(found.sp_m, A, max_relative = 1e-8);
        assert_relative_eq!(found.sv_m, A, max_relative = 1e-8);
        assert_relative_eq!(found.rz_m, 2.0 * A, max_relative = 1e-8);
        assert!(found.ssk.abs() < 1e-6);
        assert_relative_eq!(found.sku, 1.5, max_relative = 1e-7);
        assert_relative_eq!(found.rsm_m.unwrap(), wave * PIXEL[0], max_relative = 1e-7);
        assert_relative_eq!(found.lay_deg.unwrap(), 0.0, epsilon = 1e-6);
        assert_eq!(found.str_ratio, None);
        let sal = found.sal_m.unwrap() / (wave * PIXEL[0]);
        // Pairs over no whole number of waves: R departs from the cosine by less than a wave in 2π waves of the map.
        assert_relative_eq!(sal, 0.2_f64.acos() / TAU, max_relative = 1e-2);
        assert_eq!(n, waves * wave as usize);
    }

    #[test]
    fn slopes_are_those_of_the_differences() {
        let (n, wave) = (800_usize, 10.0);
        let heights = surface(n, 12, |x, _| A * (TAU * x / wave).cos());
        let found = parameters(n, &heights, PIXEL).unwrap();
        let (turn, nx) = (TAU / wave, n as f64);
        let slope = A / PIXEL[0];
        // Of the inner pixels, at one of which the sine is sin(−turn), at the left edge 0; and of the edges.
        let inner = (slope * turn.sin()).powi(2) * (0.5 * nx - turn.sin().powi(2));
        let left = (slope * (1.0 - turn.cos())).powi(2);
        let right = (slope * (turn.cos() - (2.0 * turn).cos())).powi(2);
        let central = ((inner + left + right) / nx).sqrt();
        assert_relative_eq!(found.sdq, central, max_relative = 1e-10);
        // z_{i+1} − z_i = −2 A sin(turn/2) sin((i + 1/2) turn); the last one is missing.
        let squares = 0.5 * nx - (0.5 * turn).sin().powi(2);
        let forward = slope * 2.0 * (0.5 * turn).sin() * (squares / (nx - 1.0)).sqrt();
        assert_relative_eq!(found.sdq_forward, forward, max_relative = 1e-10);
        let exact = slope * turn / 2f64.sqrt();
        assert_relative_eq!(found.sdq / exact, turn.sin() / turn, max_relative = 2e-3);
        let half = 0.5 * turn;
        assert_relative_eq!(
            found.sdq_forward / exact,
            half.sin() / half,
            max_relative = 2e-3
        );
        // Along y the same, on other pixels.
        let turned = surface(12, n, |_, y| A * (TAU * y / wave).cos());
        let along_y = parameters(12, &turned, [3e-6, PIXEL[1]]).unwrap();
        assert_relative_eq!(along_y.sdq, found.sdq, max_relative = 1e-10);
        assert_relative_eq!(along_y.lay_deg.unwrap(), 90.0, epsilon = 1e-6);
        assert_eq!(along_y.rsm_m, None);
    }

    #[test]
    fn a_product_of_waves_has_its_closed_forms() {
        let z = |x: f64, y: f64| A * (TAU * x / 20.0).cos() * (TAU * y / 30.0).cos();
        let heights = surface(200, 240, z);
        let found = parameters(200, &heights, [1e-6, 2e-6]).unwrap();
        assert_relative_eq!(found.sq_m, 0.5 * A, max_relative = 1e-10);
        assert_relative_eq!(found.sku, 2.25, max_relative = 1e-9);
        assert!(found.ssk.abs() < 1e-9);
        assert_relative_eq!(found.rsm_m.unwrap(), 20e-6, max_relative = 1e-9);
        let sa = |n: f64| 2.0 / n / (PI / n).tan();
        assert_relative_eq!(
            found.sa_m,
            A * sa(20.0) * 2.0 / 30.0 / (PI / 30.0).sin(),
            max_relative = 1e-9
        );
    }

    #[test]
    fn the_lay_of_a_turned_ridge_is_its_angle() {
        for turned in [30.0_f64, -30.0, 75.0, -89.0, 3.0] {
            let (sine, cosine) = turned.to_radians().sin_cos();
            let pixel = [1e-6, 1.5e-6];
            let along = |x: f64, y: f64| x * pixel[0] * cosine + y * pixel[1] * sine;
            let heights = surface(230, 190, |x, y| A * (TAU * along(x, y) / 23.7e-6).cos());
            let found = parameters(230, &heights, pixel).unwrap();
            let lay = found.lay_deg.unwrap();
            assert!((lay - turned).abs() < 0.2, "{turned}: {lay}");
        }
    }

    /// Sal and Str, means over six made surfaces.
    fn lengths(length: [f64; 2], period: f64, has_lay: bool) -> [f64; 2] {
        let seeds = [0, 1, 2, 3, 4, 5];
        let found = seeds.map(|seed| {
            let (nx, heights) = gaussian(seed, length, period);
            parameters(nx, &heights, [0.125; 2]).unwrap()
        });
        for one in &found {
            assert_eq!(
                one.lay_deg.map(|lay| lay.abs() < 6.0),
                has_lay.then_some(true)
            );
        }
        let sal = found.iter().map(|one| one.sal_m.unwrap());
        [
            mean(sal),
            mean(found.iter().map(|one| one.str_ratio.unwrap())),
        ]
    }

    #[test]
    fn sal_of_a_gaussian_surface_is_that_of_its_autocorrelation() {
        let [sal, aspect] = lengths([1.0, 1.0], 60.0, false);
        assert_relative_eq!(sal, 5f64.ln().sqrt(), max_relative = 0.05);
        assert!((0.9..1.0).contains(&aspect), "{aspect}");
    }

    #[test]
    fn str_of_a_stretched_surface_is_its_stretch() {
        let [sal, aspect] = lengths([1.0, 4.0], 80.0, true);
        assert_relative_eq!(sal, 5f64.ln().sqrt(), max_relative = 0.05);
        assert_relative_eq!(aspect, 0.25, max_relative = 0.08);
    }

    #[test]
    fn a_spacing_is_not_broken_by_small_portions() {
        // Noise on the mean line: portions of less than a tenth of Rz, at each crossing.
        let z = |x: f64, _: f64| (TAU * x / 50.0).cos() + 0.12 * (TAU * x / 5.0).sin();
        let heights = surface(1000, 2, z);
        let raw = Profile::of(&heights[..1000]);
        let found = parameters(1000, &heights, [1.0, 1.0]).unwrap();
        assert!(raw.portions().len() > 45, "{}", raw.portions().len());
        assert_relative_eq!(found.rsm_m.unwrap(), 50.0, max_relative = 1e-3);
        let back: Vec<f64> = heights.iter().rev().copied().collect();
        let turned = parameters(1000, &back, [1.0, 1.0]).unwrap();
        assert_relative_eq!(
            turned.rsm_m.unwrap(),
            found.rsm_m.unwrap(),
            max_relative = 1e-12
        );
    }

    #[test]
    fn what_is_no_map_has_no_parameters() {
        let ramp: Vec<f64> = (0..200).map(f64::from).collect();
        assert_eq!(parameters(0, &ramp, PIXEL), None);
        assert_eq!(parameters(9, &ramp[..90], PIXEL), None);
        assert_eq!(parameters(30, &ramp, PIXEL), None);
        assert_eq!(parameters(20, &[], PIXEL), None);
        assert_eq!(parameters(20, &[0.1; 200], PIXEL), None);
        assert_eq!(parameters(20, &ramp, [1.0, 0.0]), None);
        let mut holed = ramp.clone();
        holed[7] = f64::NAN;
        assert_eq!(parameters(20, &holed, PIXEL), None);
        // One row has profile parameters, and no areal length.
        let row = parameters(200, &ramp, PIXEL).unwrap();
        assert_eq!([row.sal_m, row.str_ratio, row.lay_deg], [None; 3]);
    }

    #[test]
    fn the_correlation_is_the_mean_over_pairs() {
        let (nx, ny) = (13, 7);
        let heights = surface(nx, ny, |x, y| (3.1 * x + 0.7 * y * y).sin() + 0.1 * x);
        let map = Map::new(nx, &heights, PIXEL).unwrap();
        let r = Correlation::of(&map);
        let variance = mean(map.z.iter().map(|z| z * z));
        for (i, j) in (0..nx).flat_map(|i| (0..ny).map(move |j| (i, j))) {
            let pairs = (0..nx - i).flat_map(|x| (j..ny).map(move |y| (x, y)));
            let product = |(x, y): (usize, usize)| map.z[y * nx + x] * map.z[(y - j) * nx + x + i];
            let direct = mean(pairs.map(product)) / variance;
            let t = [i as i64, -(j as i64)];
            assert_relative_eq!(r.at(t), direct, epsilon = 1e-12);
            assert_relative_eq!(r.at([-t[0], -t[1]]), direct, epsilon = 1e-12);
        }
    }

    #[test]
    fn padded_lengths_are_at_most_a_third_too_long() {
        assert_eq!([1, 2, 3, 5, 19, 1023].map(padded), [1, 2, 3, 6, 24, 1024]);
        assert!((1..5000).all(|n| (n..=n + n / 3).contains(&padded(n))));
    }
}
