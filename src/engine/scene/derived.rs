//! What follows from a scene by closed forms: moduli, Hertz contact, speeds, roughness.

use crate::physics::cycles::speed_ratios;
use std::f64::consts::{PI, SQRT_2};
use std::sync::Arc;

use super::model::{ContactKind, MapEdge, Scene, Surface, SurfaceKind};
use crate::physics::groups::PointContact;
use crate::physics::height_map::HeightMap;
use crate::physics::hertz::{self, Hertz};
use crate::physics::line::{self, LinePoint};

impl Scene {
    /// E', 2/E' = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂, Pa.
    pub fn e_prime_pa(&self) -> f64 {
        hertz::e_prime_pa(
            self.body_1.young_pa,
            self.body_1.poisson,
            self.body_2.young_pa,
            self.body_2.poisson,
        )
    }

    /// Hardness of the softer body, Pa; `None`: both stay elastic.
    pub fn hardness_pa(&self) -> Option<f64> {
        let given = [&self.body_1, &self.body_2].map(|body| body.hardness_pa);
        let finite = given.into_iter().flatten().filter(|pa| pa.is_finite());
        finite.reduce(f64::min)
    }

    /// Which bodies flow at that pressure: the softer one, or both.
    pub fn softer(&self) -> [bool; 2] {
        let hardness_pa = self.hardness_pa();
        let flows = |pa: Option<f64>| pa.is_some() && pa == hardness_pa;
        [&self.body_1, &self.body_2].map(|body| flows(body.hardness_pa))
    }

    /// Whether the contact is a point or a line.
    pub fn kind(&self) -> ContactKind {
        self.contact.kind
    }

    /// Radius across, m: infinite for a line. NaN would show a point contact without one, which does not
    /// validate.
    pub fn ry_m(&self) -> f64 {
        match self.contact.kind {
            ContactKind::Point => self.contact.ry_m.unwrap_or(f64::NAN),
            ContactKind::Line => f64::INFINITY,
        }
    }

    /// The Hertz contact at another load than the scene's, N (a line: N/m).
    pub fn hertz_at(&self, load: f64) -> Hertz {
        let (rx_m, e_prime_pa) = (self.contact.rx_m, self.e_prime_pa());
        match self.contact.kind {
            ContactKind::Point => Hertz::from_force(rx_m, self.ry_m(), e_prime_pa, load),
            ContactKind::Line => line::hertz_from_load(rx_m, e_prime_pa, load),
        }
    }

    /// The Hertz contact.
    pub fn hertz(&self) -> Hertz {
        self.hertz_and_force().0
    }

    /// The normal load, N; of a line per metre of length, N/m.
    pub fn force_n(&self) -> f64 {
        self.hertz_and_force().1
    }

    fn hertz_and_force(&self) -> (Hertz, f64) {
        let load = match self.contact.kind {
            ContactKind::Point => self.load.force_n,
            ContactKind::Line => self.load.force_n_per_m,
        };
        if let Some(load) = load {
            return (self.hertz_at(load), load);
        }
        // A scene without a load does not validate; NaN would show it.
        let pressure_pa = self.load.hertz_pressure_pa.unwrap_or(f64::NAN);
        let (rx_m, e_prime_pa) = (self.contact.rx_m, self.e_prime_pa());
        match self.contact.kind {
            ContactKind::Point => Hertz::from_pressure(rx_m, self.ry_m(), e_prime_pa, pressure_pa),
            ContactKind::Line => line::hertz_from_pressure(rx_m, e_prime_pa, pressure_pa),
        }
    }

    /// Speeds of body 1 and 2, U₁ = U(1 − S/2), U₂ = U(1 + S/2), m/s.
    pub fn speeds_m_s(&self) -> [f64; 2] {
        speed_ratios(self.motion.slide_roll).map(|ratio| self.motion.entrainment_m_s * ratio)
    }

    /// What the film regressions of a line need; `None` for a dry scene or a point contact.
    pub fn line_point(&self) -> Option<LinePoint> {
        let oil = self.lubricant.as_ref()?;
        (self.contact.kind == ContactKind::Line).then(|| LinePoint {
            rx_m: self.contact.rx_m,
            e_prime_pa: self.e_prime_pa(),
            viscosity_pa_s: oil.viscosity_pa_s(),
            alpha_per_pa: oil.pressure_viscosity_per_pa(),
            // Films do not know which way the oil flows.
            entrainment_m_s: self.motion.entrainment_m_s.abs(),
            load_n_per_m: self.force_n(),
        })
    }

    /// What the film regressions need; `None` for a dry scene or a line.
    pub fn operating_point(&self) -> Option<PointContact> {
        let lubricant = self.lubricant.as_ref()?;
        (self.contact.kind == ContactKind::Point).then(|| PointContact {
            rx_m: self.contact.rx_m,
            ry_m: self.ry_m(),
            e_prime_pa: self.e_prime_pa(),
            viscosity_pa_s: lubricant.viscosity_pa_s(),
            alpha_per_pa: lubricant.pressure_viscosity_per_pa(),
            entrainment_m_s: self.motion.entrainment_m_s.abs(),
            force_n: self.force_n(),
        })
    }

    /// Both surfaces, body 1 first.
    pub fn surfaces(&self) -> [&Surface; 2] {
        [&self.body_1.surface, &self.body_2.surface]
    }

    /// Shortest wave of the made surfaces, m; `None`: there are none.
    pub fn cutoff_short_m(&self) -> Option<f64> {
        let made = self
            .surfaces()
            .into_iter()
            .filter_map(Surface::cutoff_short_m);
        made.reduce(f64::min)
    }

    /// Composite root-mean-square roughness √(Rq₁² + Rq₂²), m.
    pub fn composite_rq_m(&self) -> f64 {
        let [one, two] = self.surfaces();
        one.rq_m().hypot(two.rq_m())
    }
}

impl Surface {
    /// A stretch along x that repeats itself, m, and the way from a crest (of a map: from its first column) to
    /// the body's origin, m: one wavelength of a sinusoid, one period of a map; `None`: nothing repeats.
    pub fn block_m(&self) -> Option<(f64, f64)> {
        match self {
            Self::Smooth {} => None,
            Self::Sinusoid { phase_deg, .. } => {
                let k = self.wavenumbers_per_m()[0];
                (k > 0.0).then(|| (1.0 / k, phase_deg / 360.0 / k))
            }
            Self::Random(_) | Self::HeightMap { .. } => {
                let (map, [side_m, _]) = self.relief()?;
                let length_m = map.nx() as f64 * side_m;
                match map.beyond() {
                    MapEdge::Periodic => length_m.is_finite().then_some((length_m, 0.0)),
                    MapEdge::Windowed => None,
                }
            }
        }
    }

    /// Its heights over their maximum, made or read, and the sides of their pixels along x and y, m (∞: it does not vary that
    /// way); `None`: it has no such heights.
    pub(crate) fn relief(&self) -> Option<(&Arc<HeightMap>, [f64; 2])> {
        match self {
            Self::Smooth {} | Self::Sinusoid { .. } => None,
            Self::Random(random) => random.relief(),
            Self::HeightMap { pixel_m, map, .. } => Some((map.as_ref()?, [side_m(*pixel_m); 2])),
        }
    }

    /// Its heights made or read, m, row after row: pixels of a row, heights, sides of a pixel along x and y, m.
    pub fn relief_heights_m(&self) -> Option<(usize, Vec<f64>, [f64; 2])> {
        let (map, sides_m) = self.relief()?;
        let (nx, ny) = (map.nx(), map.ny());
        let mut row = vec![0.0_f32; nx];
        let mut heights_m = Vec::with_capacity(nx * ny);
        for j in 0..ny {
            map.row_into(j as f64 - 0.5 * (ny - 1) as f64, &mut row);
            heights_m.extend(row.iter().map(|&z| self.amplitude_m() * f64::from(z)));
        }
        Some((nx, heights_m, sides_m))
    }

    /// Its shortest wave, m, if it is made.
    pub fn cutoff_short_m(&self) -> Option<f64> {
        match self {
            Self::Random(random) => Some(random.cutoff_short_m()),
            Self::Smooth {} | Self::Sinusoid { .. } | Self::HeightMap { .. } => None,
        }
    }

    /// Length along x of heights made or read, m; `None`: there are none, or they do not vary along x.
    pub fn relief_length_m(&self) -> Option<f64> {
        let (map, [side_m, _]) = self.relief()?;
        Some(map.nx() as f64 * side_m).filter(|length_m| length_m.is_finite())
    }

    /// Whether damage can be gathered in a block: a map that stands once never comes back.
    pub fn has_block(&self) -> bool {
        match self {
            Self::Smooth {} | Self::Sinusoid { .. } | Self::Random(_) => true,
            Self::HeightMap { edge, .. } => match edge {
                MapEdge::Periodic => true,
                MapEdge::Windowed => false,
            },
        }
    }

    /// A, m; 0 for a smooth surface.
    pub fn amplitude_m(&self) -> f64 {
        match *self {
            Self::Smooth {} => 0.0,
            Self::Sinusoid { amplitude_m, .. } => amplitude_m,
            Self::Random(ref random) => random.amplitude_m(),
            Self::HeightMap {
                amplitude_m,
                ref map,
                ..
            } => amplitude_m.unwrap_or_else(|| map.as_ref().map_or(0.0, |map| map.peak_m)),
        }
    }

    /// Sets A; a smooth surface has none.
    pub fn set_amplitude_m(&mut self, value_m: f64) {
        match self {
            Self::Smooth {} => {}
            Self::Sinusoid { amplitude_m, .. } => *amplitude_m = value_m,
            Self::Random(random) => random.set_amplitude_m(value_m),
            Self::HeightMap { amplitude_m, .. } => *amplitude_m = Some(value_m),
        }
    }

    /// Root-mean-square height: A/√2 for ridges, A/2 for the product of two waves, m; of a height map by
    /// its pixels.
    pub fn rq_m(&self) -> f64 {
        match *self {
            Self::Smooth {} => 0.0,
            Self::Sinusoid {
                amplitude_m,
                wavelength_x_m,
                wavelength_y_m,
                ..
            } if wavelength_x_m.is_finite() && wavelength_y_m.is_finite() => 0.5 * amplitude_m,
            Self::Sinusoid { amplitude_m, .. } => amplitude_m / SQRT_2,
            Self::Random(ref random) => random.rq_m,
            Self::HeightMap { ref map, .. } => {
                self.amplitude_m() * map.as_ref().map_or(0.0, |map| map.rms)
            }
        }
    }

    /// Mean of |z|: 2A/π for ridges, 4A/π² for the product of two waves, m; of maps and made surfaces by their heights.
    pub fn ra_m(&self) -> f64 {
        match self {
            Self::Smooth {} => 0.0,
            Self::Sinusoid {
                amplitude_m,
                wavelength_x_m,
                wavelength_y_m,
                ..
            } => {
                let waves = [wavelength_x_m, wavelength_y_m];
                let waves = waves.into_iter().filter(|wave| wave.is_finite()).count();
                (2.0 / PI).powi(waves.max(1) as i32) * amplitude_m.abs()
            }
            Self::Random(_) | Self::HeightMap { .. } => {
                let share = self.relief().map_or(0.0, |(map, _)| map.mean_height());
                self.amplitude_m().abs() * share
            }
        }
    }

    /// Whether there is no micro-geometry at all (an amplitude of 0 may still be turned up).
    pub fn is_smooth(&self) -> bool {
        self.kind() == SurfaceKind::Smooth
    }

    /// Its kind.
    pub fn kind(&self) -> SurfaceKind {
        match self {
            Self::Smooth {} => SurfaceKind::Smooth,
            Self::Sinusoid { .. } => SurfaceKind::Sinusoid,
            Self::Random(_) => SurfaceKind::Random,
            Self::HeightMap { .. } => SurfaceKind::HeightMap,
        }
    }

    /// Crests per metre along x, f: one a wave; of a height map the upcrossings of its level.
    pub fn crests_per_m(&self) -> f64 {
        match self.relief() {
            Some((map, [side_m, _])) => map.crests / side_m,
            None => self.wavenumbers_per_m()[0],
        }
    }

    /// Wavenumbers of the surface along x and y, 1/m: the largest that the turned product holds; of a
    /// height map that of its shortest significant waves.
    pub fn wavenumbers_per_m(&self) -> [f64; 2] {
        match *self {
            Self::Smooth {} => [0.0; 2],
            Self::Sinusoid {
                wavelength_x_m,
                wavelength_y_m,
                angle_deg,
                ..
            } => {
                let (sin, cos) = exact_sin_cos(angle_deg);
                let (k_x, k_y) = (1.0 / wavelength_x_m, 1.0 / wavelength_y_m);
                [
                    (k_x * cos).abs() + (k_y * sin).abs(),
                    (k_x * sin).abs() + (k_y * cos).abs(),
                ]
            }
            // Nothing before it is made or read.
            Self::Random(_) | Self::HeightMap { .. } => {
                self.relief().map_or([0.0; 2], |(map, sides_m)| {
                    [0, 1].map(|k| 1.0 / (map.shortest[k] * sides_m[k]))
                })
            }
        }
    }

    /// Whether the surface changes along the rolling direction, so that its motion shows.
    pub fn varies_along_x(&self) -> bool {
        self.wavenumbers_per_m()[0] > 0.0
    }

    /// Whether the surface is its own mirror image in y = 0, wherever it has moved along x.
    pub fn is_even_in_y(&self) -> bool {
        match *self {
            Self::Smooth {} => true,
            Self::Sinusoid {
                wavelength_x_m,
                angle_deg,
                phase_deg,
                ..
            } => match exact_sin_cos(angle_deg) {
                (0.0, _) => true,
                // x' runs along y: its wave is even only without a phase.
                (_, 0.0) => wavelength_x_m.is_infinite() || phase_deg.rem_euclid(180.0) == 0.0,
                (_, _) => false,
            },
            Self::Random(_) | Self::HeightMap { .. } => {
                self.relief().is_none_or(|(map, _)| map.is_even_in_y)
            }
        }
    }
}

/// Side of a pixel. NaN would show a map that has not been read, which does not validate.
pub(super) fn side_m(pixel_m: Option<f64>) -> f64 {
    pixel_m.unwrap_or(f64::NAN)
}

/// Sine and cosine that are exactly 0 at the multiples of 90 degrees.
fn exact_sin_cos(angle_deg: f64) -> (f64, f64) {
    let turned = angle_deg.rem_euclid(180.0);
    if turned == 0.0 {
        (0.0, 1.0)
    } else if turned == 90.0 {
        (1.0, 0.0)
    } else {
        turned.to_radians().sin_cos()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::waviness::Waviness;

    fn sinusoid(
        wavelength_x_m: f64,
        wavelength_y_m: f64,
        angle_deg: f64,
        phase_deg: f64,
    ) -> Surface {
        Surface::Sinusoid {
            amplitude_m: 2e-7,
            wavelength_x_m,
            wavelength_y_m,
            angle_deg,
            phase_deg,
        }
    }

    #[test]
    fn root_mean_square_of_ridges_and_of_a_product() {
        for (surface, expected) in [
            (sinusoid(1e-4, f64::INFINITY, 0.0, 20.0), 2e-7 / SQRT_2),
            (sinusoid(1e-4, 3e-4, 0.0, 0.0), 1e-7),
        ] {
            let Surface::Sinusoid {
                wavelength_x_m,
                wavelength_y_m,
                phase_deg,
                ..
            } = surface
            else {
                unreachable!("made above")
            };
            let n = 64;
            let mut sum = 0.0;
            for i in 0..n {
                for j in 0..n {
                    let x = i as f64 / n as f64 * std::f64::consts::TAU + phase_deg.to_radians();
                    let y = if wavelength_y_m.is_finite() {
                        j as f64 / n as f64 * std::f64::consts::TAU
                    } else {
                        0.0
                    };
                    assert!(wavelength_x_m.is_finite());
                    sum += (2e-7 * x.cos() * y.cos()).powi(2);
                }
            }
            let rq = (sum / (n * n) as f64).sqrt();
            assert!((rq / expected - 1.0).abs() < 1e-12);
            assert!((surface.rq_m() / expected - 1.0).abs() < 1e-15);
        }
    }

    /// Crests along x as they are met: upcrossings of the level on a streamline, counted.
    #[test]
    fn crests_are_upcrossings_along_x() {
        let inf = f64::INFINITY;
        for (wx, wy, angle) in [
            (1e-4, inf, 0.0),
            (1e-4, inf, 60.0),
            (inf, 1e-4, 90.0),
            (1e-4, 2e-4, 0.0),
            (1e-4, 2e-4, 30.0),
            (1e-4, 1e-4, 45.0),
            (1e-4, 3e-4, 60.0),
        ] {
            let wave = Waviness::new(wx, wy, f64::to_radians(angle), 0.0);
            let (length_m, step_m) = (0.02, 5e-7);
            let heights: Vec<f64> = (0..(length_m / step_m) as usize)
                .map(|i| wave.shape(step_m * i as f64, 1.3e-5))
                .collect();
            let pairs = heights.windows(2);
            let met = pairs.filter(|pair| pair[0] < 0.0 && pair[1] >= 0.0).count() as f64;
            let told = sinusoid(wx, wy, angle, 0.0).crests_per_m() * length_m;
            assert!((met - told).abs() < 2.0, "{wx} {wy} {angle}: {met} {told}");
        }
        assert_eq!(sinusoid(inf, 1e-4, 0.0, 0.0).crests_per_m(), 0.0);
        assert_eq!(sinusoid(1e-4, inf, 90.0, 0.0).crests_per_m(), 0.0);
    }

    #[test]
    fn lay_decides_what_moves_and_what_is_mirrored() {
        let inf = f64::INFINITY;
        // Wx, Wy, angle, phase: varies along x, even in y.
        for (wx, wy, angle, phase, moves, even) in [
            (1e-4, inf, 0.0, 30.0, true, true),
            (inf, 1e-4, 0.0, 0.0, false, true),
            (1e-4, 1e-4, 0.0, 30.0, true, true),
            (1e-4, inf, 90.0, 0.0, false, true),
            (1e-4, inf, 90.0, 30.0, false, false),
            (inf, 1e-4, 90.0, 30.0, true, true),
            (1e-4, inf, 30.0, 0.0, true, false),
            (1e-4, inf, -180.0, 0.0, true, true),
        ] {
            let surface = sinusoid(wx, wy, angle, phase);
            assert_eq!(surface.varies_along_x(), moves, "{surface:?}");
            assert_eq!(surface.is_even_in_y(), even, "{surface:?}");
        }
        assert!(Surface::Smooth {}.is_even_in_y());
    }
}
