//! What a scene's height map is, for people and for scripts, and what is doubtful of it.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::derived::side_m;
use super::keys::short;
use super::model::{MapEdge, MapLevel, MapOutliers, Scene, Surface};
use crate::math::number::{counted, length, sig};
use crate::physics::height_map::{FileDefect, HeightMap, MapFacts};

/// A height map as it was read and treated, SI.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MapReport {
    /// Its file.
    pub file: String,
    /// Pixels along y.
    pub rows: usize,
    /// Pixels along x.
    pub columns: usize,
    /// Length along x, m.
    pub size_x_m: f64,
    /// Length along y, m.
    pub size_y_m: f64,
    /// Height that a value of 1 stands for, m.
    pub unit_m: f64,
    /// What lies beyond it.
    pub edge: MapEdge,
    /// What was taken off.
    pub level: MapLevel,
    /// Slope along x of the best plane of the file's heights.
    pub plane_slope_x: f64,
    /// Slope along y.
    pub plane_slope_y: f64,
    /// Mean square height of that plane over that of the heights.
    pub plane_share: f64,
    /// Least height of what is left, m, before the scene's amplitude.
    pub min_m: f64,
    /// Greatest, m.
    pub max_m: f64,
    /// Root-mean-square height of it, m.
    pub sq_m: f64,
    /// Greatest departure from the level over `sq_m`.
    pub max_over_sq: f64,
    /// Points that the file lacks, filled from their neighbours.
    #[serde(default)]
    pub missing: usize,
    /// What is odd about the file.
    #[serde(default)]
    pub defects: Vec<FileDefect>,
    /// Outlying pixels that the file has.
    pub outliers: usize,
    /// What became of them.
    pub outliers_are: MapOutliers,
    /// Greatest departure that the scene asks for, m.
    pub amplitude_m: f64,
    /// Rim that was cut off, m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub crop_m: Option<f64>,
    /// Angle by which the map was turned from x towards y, degrees.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub turn_deg: Option<f64>,
    /// Cut-off of the S-filter, m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub s_filter_m: Option<f64>,
    /// Cut-off of the L-filter, m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub l_filter_m: Option<f64>,
}

/// A slope of the best plane that is rounding, over the share.
const NO_PLANE: f64 = 1e-12;

impl Scene {
    /// What the maps of body 1 and 2 are; `None`: the body has none.
    pub fn map_reports(&self) -> [Option<MapReport>; 2] {
        self.surfaces().map(Surface::map_report)
    }
}

impl Surface {
    fn map_report(&self) -> Option<MapReport> {
        let Self::HeightMap {
            file,
            pixel_m,
            edge,
            unit_m,
            crop_m,
            turn_deg,
            s_filter_m,
            l_filter_m,
            map: Some(map),
            ..
        } = self
        else {
            return None;
        };
        let side_m = side_m(*pixel_m);
        let facts = &map.facts;
        let [plane_slope_x, plane_slope_y] = facts.plane_m.map(|rise_m| rise_m / side_m);
        let [min_m, max_m] = facts.range_m;
        Some(MapReport {
            file: file.clone(),
            rows: map.ny(),
            columns: map.nx(),
            size_x_m: map.nx() as f64 * side_m,
            size_y_m: map.ny() as f64 * side_m,
            unit_m: unit_m.unwrap_or(1.0),
            edge: *edge,
            level: facts.level,
            plane_slope_x,
            plane_slope_y,
            plane_share: facts.plane_share,
            min_m,
            max_m,
            sq_m: map.rms * map.peak_m,
            max_over_sq: 1.0 / map.rms,
            missing: facts.missing,
            defects: facts.defects.list(),
            outliers: facts.outliers,
            outliers_are: facts.outlying,
            amplitude_m: self.amplitude_m(),
            crop_m: *crop_m,
            turn_deg: *turn_deg,
            s_filter_m: *s_filter_m,
            l_filter_m: *l_filter_m,
        })
    }

    /// What a surface made or read is, in words, some lines; none of others.
    pub fn relief_lines(&self) -> Vec<String> {
        match self {
            Self::Smooth {} | Self::Sinusoid { .. } => Vec::new(),
            Self::Random(random) => random.lines(),
            Self::HeightMap { .. } => self.map_report().map_or_else(Vec::new, |map| map.lines()),
        }
    }

    /// What is doubtful of a map.
    pub fn map_doubts(&self) -> [Option<Doubt>; 2] {
        let Self::HeightMap { map: Some(map), .. } = self else {
            return [None; 2];
        };
        [Doubt::of_tilt(map), Doubt::of_outliers(map)]
    }
}

impl Surface {
    /// What makes the significant waves of a map as short as they are, with its cure; `is_fine`: what wavenumbers along
    /// x and y (1/m) would do. `None`: neither a tilt nor outliers.
    pub(crate) fn blame(&self, is_fine: impl Fn([f64; 2]) -> bool) -> Option<String> {
        let Self::HeightMap {
            pixel_m,
            map: Some(map),
            ..
        } = self
        else {
            return None;
        };
        let side_m = side_m(*pixel_m);
        let cures = |shortest: Option<[f64; 2]>| {
            shortest.is_some_and(|pixels| is_fine(pixels.map(|wave| 1.0 / (wave * side_m))))
        };
        if cures(map.facts.shortest_without_outliers) {
            let outliers = counted(map.facts.outliers as u64, "outlying pixel");
            return Some(format!(
                "{outliers} of the map to blame: surface.outliers = \"median\" takes such pixels off"
            ));
        }
        cures(map.facts.shortest_without_plane).then(|| {
            format!(
                "the tilt of the map to blame: surface.level = \"plane\" takes it off ({})",
                tilt(map, side_m)
            )
        })
    }
}

/// The tilt of a map in words: its rise from end to end and its share of the height.
pub(super) fn tilt(map: &HeightMap, pixel_m: f64) -> String {
    let [x, y] = map.facts.plane_m;
    let [across_x, across_y] = [x * map.nx() as f64, y * map.ny() as f64];
    let [slope_x, slope_y] = [x, y].map(|rise_m| sig(rise_m / pixel_m, 3));
    format!(
        "its best plane rises by {} along x and {} along y (slopes {slope_x} and {slope_y}), {} % of the mean square height",
        length(across_x),
        length(across_y),
        sig(100.0 * map.facts.plane_share, 3)
    )
}

impl MapReport {
    /// In words, some lines.
    pub fn lines(&self) -> Vec<String> {
        let Self { rows, columns, .. } = self;
        let [size_x, size_y] = [self.size_x_m, self.size_y_m].map(|side_m| sig(side_m * 1e6, 4));
        let mut lines = vec![
            format!(
                "{}: {rows} rows x {columns} columns, {size_x} µm along x, {size_y} µm along y; a value of 1 is {} m",
                self.file,
                short(self.unit_m)
            ),
            format!("taken off: {}{}", self.taken_off(), self.plane()),
            format!(
                "minimum {}, maximum {}, Sq {}, greatest departure {} Sq",
                length(self.min_m),
                length(self.max_m),
                length(self.sq_m),
                sig(self.max_over_sq, 3)
            ),
        ];
        lines.splice(1..1, self.prepared());
        let greatest_m = self.max_m.max(-self.min_m);
        if (self.amplitude_m / greatest_m - 1.0).abs() > 1e-9 {
            let amplitude = length(self.amplitude_m);
            lines.push(format!("then scaled to an amplitude of {amplitude}"));
        }
        if self.missing > 0 {
            let what = counted(self.missing as u64, "missing point");
            lines.push(format!("{what} filled from their neighbours"));
        }
        if !self.defects.is_empty() {
            let names: Vec<&str> = self.defects.iter().map(|defect| defect.name()).collect();
            lines.push(format!("odd about the file: {}", names.join("; ")));
        }
        if self.outliers > 0 {
            let what = counted(self.outliers as u64, "outlying pixel");
            lines.push(match self.outliers_are {
                MapOutliers::Keep => format!("{what} kept"),
                MapOutliers::Median => {
                    format!("{what} replaced by the median of the 5 by 5 about each")
                }
            });
        }
        lines
    }

    /// What was done to it before, in a line; `None`: nothing.
    fn prepared(&self) -> Option<String> {
        let filter = |name: &str, cut_off_m: Option<f64>| {
            Some(format!(
                "{name} {} (Gaussian, ISO 16610-61)",
                length(cut_off_m?)
            ))
        };
        let done = [
            self.crop_m
                .map(|rim_m| format!("{} cut off on every side", length(rim_m))),
            self.turn_deg
                .map(|degrees| format!("turned by {} degrees", sig(degrees, 4))),
            filter("S-filter", self.s_filter_m),
            filter("L-filter", self.l_filter_m),
        ];
        let done: Vec<String> = done.into_iter().flatten().collect();
        (!done.is_empty()).then(|| format!("prepared: {}", done.join(", ")))
    }

    fn taken_off(&self) -> String {
        let mean = match self.edge {
            MapEdge::Periodic => "mean",
            MapEdge::Windowed => "mean of the rim",
        };
        match self.level {
            MapLevel::None => "nothing".to_owned(),
            MapLevel::Mean => format!("the {mean}"),
            MapLevel::Plane => format!("the best plane and the {mean}"),
            MapLevel::Quadratic => format!("the best quadratic and the {mean}"),
        }
    }

    fn plane(&self) -> String {
        if self.plane_share < NO_PLANE {
            return "; the file has no tilt".to_owned();
        }
        format!(
            "; best plane of the file: slopes {} along x and {} along y, {} % of the mean square height",
            sig(self.plane_slope_x, 3),
            sig(self.plane_slope_y, 3),
            sig(100.0 * self.plane_share, 3)
        )
    }
}

/// Less than an atom, m: a wrong unit, or nothing.
const ATOM_M: f64 = 1e-10;
/// Amplitude over the contact's half-width beyond which it is form and not roughness.
const ROUGHNESS: f64 = 0.1;
/// Share of a plane that is left in that is worth a word.
const TILT_WORTH_A_WORD: f64 = 0.1;

/// What is doubtful of a surface.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum Doubt {
    /// Lower than an atom.
    #[error(
        "its amplitude of {} is less than an atom's size (0.1 nm): a wrong unit, or a smooth surface",
        length(*amplitude_m)
    )]
    Low {
        /// A, m.
        amplitude_m: f64,
    },
    /// As high as the contact is wide.
    #[error(
        "its amplitude of {} is more than a tenth of the contact's half-width of {}: a wrong unit, or form and not roughness",
        length(*amplitude_m),
        length(*half_width_m)
    )]
    High {
        /// A, m.
        amplitude_m: f64,
        /// The narrower half-width, m.
        half_width_m: f64,
    },
    /// A plane that was left in.
    #[error(
        "its best plane, {} % of the mean square height, is left in; surface.level = \"plane\" takes it off",
        sig(100.0 * share, 3)
    )]
    Tilt {
        /// Its share of the mean square height.
        share: f64,
    },
    /// Outliers that were left in.
    #[error(
        "{} left in: the greatest departure is {} Sq; surface.outliers = \"median\" takes such pixels off",
        counted(*count, "outlying pixel"),
        sig(*max_over_sq, 3)
    )]
    Outliers {
        /// How many.
        count: u64,
        /// Greatest departure over Sq.
        max_over_sq: f64,
    },
}

impl Doubt {
    /// Of an amplitude in a contact of that half-width, the narrower one.
    pub fn of_amplitude(amplitude_m: f64, half_width_m: f64) -> Option<Self> {
        if 0.0 < amplitude_m && amplitude_m < ATOM_M {
            Some(Self::Low { amplitude_m })
        } else if half_width_m > 0.0 && amplitude_m > ROUGHNESS * half_width_m {
            Some(Self::High {
                amplitude_m,
                half_width_m,
            })
        } else {
            None
        }
    }

    fn of_tilt(map: &HeightMap) -> Option<Self> {
        let MapFacts {
            level,
            plane_share: share,
            is_open,
            ..
        } = map.facts;
        let stays = match level {
            MapLevel::None | MapLevel::Mean => true,
            MapLevel::Plane | MapLevel::Quadratic => false,
        };
        // Waves that close have a plane of their own.
        let is_tilt = match map.beyond() {
            MapEdge::Periodic => is_open,
            MapEdge::Windowed => share > TILT_WORTH_A_WORD,
        };
        (stays && is_tilt).then_some(Self::Tilt { share })
    }

    fn of_outliers(map: &HeightMap) -> Option<Self> {
        let count = map.facts.outliers as u64;
        match map.facts.outlying {
            MapOutliers::Keep if count > 0 => Some(Self::Outliers {
                count,
                max_over_sq: 1.0 / map.rms,
            }),
            MapOutliers::Keep | MapOutliers::Median => None,
        }
    }
}
