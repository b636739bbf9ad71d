//! `kind = "random"`: a surface made by its statistics, from the table of a scene to its heights.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::error::SceneError;
use super::keys::{joined, short};
use crate::math::number::{length, sig};
use crate::physics::height_distribution::{HeightDistribution, least_kurtosis};
use crate::physics::height_map::HeightMap;
use crate::physics::random_surface::{Autocorrelation, RandomSpectrum};

/// A made surface: [`RandomSpectrum`] with the defaults that a scene leaves out.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RandomSurface {
    /// Which surface of that kind; `None`: [`RandomSurface::usual_seed`], filled in when it is made.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seed: Option<u64>,
    /// Root-mean-square height, m.
    pub rq_m: f64,
    /// Law of the spectrum.
    #[serde(default)]
    pub autocorrelation: Autocorrelation,
    /// Along x, m; `None`: of a power law alone, which has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub correlation_x_m: Option<f64>,
    /// Along y, m; `None`: as along x.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub correlation_y_m: Option<f64>,
    /// H of a power law.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hurst: Option<f64>,
    /// Shortest wave, m; `None`: the shorter correlation length.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cutoff_short_m: Option<f64>,
    /// Longest wave, m; `None`: the period.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cutoff_long_m: Option<f64>,
    /// Length along x after which it comes again, m; `None`: 64 correlation lengths, at least 8 of the longest wave.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub period_x_m: Option<f64>,
    /// The same along y.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub period_y_m: Option<f64>,
    /// Ssk; `None`: 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub skewness: Option<f64>,
    /// Sku; `None`: 3.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kurtosis: Option<f64>,
    /// The heights, once made.
    #[serde(skip)]
    made: Option<Arc<HeightMap>>,
}

/// Hurst exponent of most worn and machined surfaces.
const HURST: f64 = 0.8;
/// Correlation lengths in a period, and longest waves.
const LENGTHS: f64 = 64.0;
const LONGEST_WAVES: f64 = 8.0;
/// Most pixels of a made surface.
const MOST_PIXELS: usize = 1 << 22;
/// Same of one whose heights are not normal, which takes forty transforms and sorts.
const MOST_SHAPED_PIXELS: usize = 1 << 20;

impl RandomSurface {
    /// L_x and L_y, m. A power law has none, but may have a lay: what counts is their ratio.
    pub fn correlation_m(&self) -> [f64; 2] {
        let x_m = self.correlation_x_m.unwrap_or(1.0);
        [x_m, self.correlation_y_m.unwrap_or(x_m)]
    }

    /// Shortest wave, m; NaN where none is given and none follows, which does not validate.
    pub fn cutoff_short_m(&self) -> f64 {
        self.cutoff_short_m.unwrap_or_else(|| {
            let shorter = self
                .correlation_m()
                .into_iter()
                .fold(f64::INFINITY, f64::min);
            match self.autocorrelation {
                Autocorrelation::Exponential | Autocorrelation::Gaussian => shorter,
                Autocorrelation::SelfAffine => f64::NAN,
            }
        })
    }

    /// Lengths after which it repeats along x and y, m; ∞: it does not vary that way.
    pub fn period_m(&self) -> [f64; 2] {
        let longest_m = self
            .cutoff_long_m
            .map_or(0.0, |wave_m| LONGEST_WAVES * wave_m);
        let usual_m = |correlation_m: f64| match self.autocorrelation {
            Autocorrelation::SelfAffine => longest_m,
            Autocorrelation::Exponential | Autocorrelation::Gaussian => {
                longest_m.max(LENGTHS * correlation_m)
            }
        };
        let [x_m, y_m] = self.correlation_m();
        let of = |asked: Option<f64>, correlation_m: f64| match asked {
            Some(period_m) if correlation_m.is_finite() => period_m,
            None if correlation_m.is_finite() => usual_m(correlation_m),
            Some(_) | None => f64::INFINITY,
        };
        [of(self.period_x_m, x_m), of(self.period_y_m, y_m)]
    }

    fn spectrum(&self, seed: u64) -> RandomSpectrum {
        RandomSpectrum {
            seed: self.seed.unwrap_or(seed),
            autocorrelation: self.autocorrelation,
            correlation_m: self.correlation_m(),
            hurst: self.hurst.unwrap_or(HURST),
            cutoff_short_m: self.cutoff_short_m(),
            cutoff_long_m: self.cutoff_long_m.unwrap_or(f64::INFINITY),
            period_m: self.period_m(),
            skewness: self.skewness.unwrap_or(0.0),
            kurtosis: self.kurtosis.unwrap_or(3.0),
        }
    }

    /// The seed of a body that names none: 1 on body 1, on body 2 a million more than body 1's, so that one key, body 1's
    /// seed, draws another pair of surfaces.
    pub(super) fn usual_seed(of_body_1: Option<u64>) -> u64 {
        of_body_1.map_or(1, |seed| seed + 1_000_000)
    }

    /// Makes the heights, unless they are there; `seed` is that of a body that names none, `table` its table for messages.
    ///
    /// # Errors
    /// [`SceneError::Value`] or [`SceneError::Missing`] that names the key that does not fit the others.
    pub(super) fn make(&mut self, table: &str, seed: u64) -> Result<(), SceneError> {
        if self.made.is_some() {
            return Ok(());
        }
        self.check(table)?;
        let spectrum = self.spectrum(seed);
        let [nx, ny] = spectrum.pixels();
        let most = if spectrum.is_shaped() {
            MOST_SHAPED_PIXELS
        } else {
            MOST_PIXELS
        };
        if nx.saturating_mul(ny) > most {
            let [x_m, y_m] = self.period_m().map(short);
            return Err(SceneError::value(
                joined(table, "cutoff_short_m"),
                format!(
                    "{} m, {nx} by {ny} pixels on a period of {x_m} m by {y_m} m",
                    short(self.cutoff_short_m())
                ),
                format!(
                    "at most {most} pixels: a longer cutoff_short_m, or a shorter period_x_m or period_y_m"
                ),
            ));
        }
        let map = spectrum.make().ok_or_else(|| {
            SceneError::value(
                joined(table, "cutoff_short_m"),
                format!("{} m, which leaves no wave", short(self.cutoff_short_m())),
                "a cut-off below the period and below cutoff_long_m",
            )
        })?;
        self.seed = Some(spectrum.seed);
        self.made = Some(Arc::new(map));
        Ok(())
    }

    /// The rules that tie its keys together.
    fn check(&self, table: &str) -> Result<(), SceneError> {
        let missing = |key: &str, allowed: &str| SceneError::Missing {
            key: joined(table, key),
            allowed: allowed.to_owned(),
        };
        match self.autocorrelation {
            Autocorrelation::Exponential | Autocorrelation::Gaussian => {
                if self.correlation_x_m.is_none() {
                    return Err(missing(
                        "correlation_x_m",
                        "a length in m, or inf (ridges along x)",
                    ));
                }
            }
            Autocorrelation::SelfAffine => {
                let allowed = "a length in m: a power law has no end of its own";
                for (key, value) in [
                    ("cutoff_short_m", self.cutoff_short_m),
                    ("cutoff_long_m", self.cutoff_long_m),
                ] {
                    if value.is_none() {
                        return Err(missing(key, allowed));
                    }
                }
            }
        }
        if self
            .correlation_m()
            .iter()
            .all(|length| length.is_infinite())
        {
            return Err(SceneError::value(
                joined(table, "correlation_x_m"),
                "inf",
                "a length in m, when correlation_y_m is inf too (or kind = \"smooth\")",
            ));
        }
        if let (Some(_), Autocorrelation::Exponential | Autocorrelation::Gaussian) =
            (self.hurst, self.autocorrelation)
        {
            return Err(SceneError::value(
                joined(table, "hurst"),
                "a setting",
                "only with autocorrelation = \"self_affine\"",
            ));
        }
        let (skewness, kurtosis) = (self.skewness.unwrap_or(0.0), self.kurtosis.unwrap_or(3.0));
        if HeightDistribution::new(skewness, kurtosis).is_none() {
            return Err(SceneError::value(
                joined(table, "kurtosis"),
                short(kurtosis),
                format!(
                    "at least {} with a skewness of {}",
                    sig(least_kurtosis(skewness), 3),
                    short(skewness)
                ),
            ));
        }
        let (short_m, long_m) = (self.cutoff_short_m(), self.cutoff_long_m);
        match long_m.filter(|long_m| *long_m <= short_m) {
            Some(long_m) => Err(SceneError::value(
                joined(table, "cutoff_long_m"),
                format!("{} m", short(long_m)),
                format!("more than cutoff_short_m, {} m", short(short_m)),
            )),
            None => Ok(()),
        }
    }

    /// The heights over their maximum, and the sides of their pixels, m; `None`: not made yet.
    pub(super) fn relief(&self) -> Option<(&Arc<HeightMap>, [f64; 2])> {
        let map = self.made.as_ref()?;
        let [x_m, y_m] = self.period_m();
        Some((map, [x_m / map.nx() as f64, y_m / map.ny() as f64]))
    }

    /// Greatest departure from the mean, m.
    pub(super) fn amplitude_m(&self) -> f64 {
        (self.made.as_ref()).map_or(0.0, |map| self.rq_m / map.rms)
    }

    /// Scales the heights so that this is their greatest departure from the mean.
    pub(super) fn set_amplitude_m(&mut self, value_m: f64) {
        if let Some(map) = &self.made {
            self.rq_m = value_m * map.rms;
        }
    }

    /// What it is, in words.
    pub(super) fn lines(&self) -> Vec<String> {
        let Some((map, _)) = self.relief() else {
            return Vec::new();
        };
        let [x, y] = self.correlation_m().map(length);
        let law = match self.autocorrelation {
            Autocorrelation::SelfAffine => {
                format!("Hurst exponent {}", short(self.hurst.unwrap_or(HURST)))
            }
            Autocorrelation::Exponential | Autocorrelation::Gaussian => {
                format!("correlation lengths {x} along x, {y} along y")
            }
        };
        let [period_x, period_y] = self.period_m();
        let longest = self.cutoff_long_m.unwrap_or(period_x.max(period_y));
        let [skewness, kurtosis] = map.moments();
        vec![
            format!(
                "random, seed {}, {}, {law}",
                self.seed.unwrap_or_default(),
                self.autocorrelation.key()
            ),
            format!(
                "waves from {} (cut-off) to {}; comes again after {} along x, {} along y",
                length(self.cutoff_short_m()),
                length(longest),
                length(period_x),
                length(period_y)
            ),
            format!(
                "Sq {}, Ssk {}, Sku {}, greatest departure {} Sq",
                length(self.rq_m),
                sig(skewness, 2),
                sig(kurtosis, 3),
                sig(1.0 / map.rms, 3)
            ),
        ]
    }
}
