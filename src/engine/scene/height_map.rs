//! Height maps from files: `.npy`, `.csv`, `.x3p` and `.sur`, hostile until parsed.
//!
//! Columns run along x (the rolling direction), rows along y, the first row at −y. A value times `unit_m`
//! is a height in m, positive towards the mating body. `.npy`: see [`npy`]. `.csv`, `.txt`: see [`text`];
//! what lines that begin with `#` say of unit and size counts ([`header`]). `.x3p`: see [`x3p`]. `.sur`: see [`sur`];
//! both say unit and size, and their missing points are filled ([`missing`]). No file's rows are turned over: the first
//! one stands at −y, whatever a viewer makes of it. `builtin:NAME` is a map that
//! comes with the program (scenes of `evidence/`).

mod header;
mod missing;
mod npy;
mod raster;
mod sur;
mod text;
mod x3p;

use std::hash::Hasher as _;
use std::path::Path;

use self::header::Header;
use super::error::{SceneError, shortened};
use super::keys::{self, joined, short};
use super::map_report::tilt;
use super::presets;
use crate::files::{FnvHasher, given_file, read_up_to};
use crate::physics::height_map::{FileDefects, HeightMap, MapEdge, Treatment};
use crate::physics::levelling::{MapLevel, MapOutliers};
use crate::physics::preparation::{cropped, turned};

/// Largest file, bytes.
const LARGEST_FILE: u64 = 64 << 20;
/// Fewest and most pixels a side: cubic interpolation wants four.
const SIDE: std::ops::RangeInclusive<usize> = 4..=8192;
/// Maximum height, m: that of a whole body, not of its roughness.
const GREATEST_M: f64 = 1e-3;

/// A matrix of numbers.
#[derive(Debug, Clone, PartialEq)]
struct Matrix {
    columns: usize,
    values: Vec<f64>,
}

/// A file that was read.
struct Parsed {
    matrix: Matrix,
    header: Header,
    /// Points that were filled.
    missing: usize,
    defects: FileDefects,
}

impl Parsed {
    /// A file without missing points.
    fn whole(matrix: Matrix, header: Header) -> Self {
        Self {
            matrix,
            header,
            missing: 0,
            defects: FileDefects::default(),
        }
    }
}

/// What a file is refused for; the caller adds the key.
struct Refusal {
    found: String,
    allowed: String,
}

fn refusal(found: impl Into<String>, allowed: impl Into<String>) -> Refusal {
    Refusal {
        found: found.into(),
        allowed: allowed.into(),
    }
}

/// What a scene asks of a map.
pub(super) struct Asked<'a> {
    /// Its table, such as `body_1.surface`.
    pub(super) table: &'a str,
    pub(super) file: &'a str,
    pub(super) pixel_m: Option<f64>,
    pub(super) unit_m: Option<f64>,
    pub(super) beyond: MapEdge,
    pub(super) level: Option<MapLevel>,
    pub(super) outliers: MapOutliers,
    pub(super) crop_m: Option<f64>,
    pub(super) turn_deg: Option<f64>,
    /// Cut-offs of the S- and the L-filter.
    pub(super) filters_m: [Option<f64>; 2],
}

/// A map that has been read, with what the scene left to its file.
pub(super) struct Found {
    pub(super) map: HeightMap,
    /// Of the file's numbers.
    pub(super) digest: String,
    pub(super) pixel_m: f64,
    pub(super) unit_m: f64,
}

impl Asked<'_> {
    /// Reads the map, a relative path from `base`.
    pub(super) fn read(&self, base: &Path) -> Result<Found, SceneError> {
        let refused = |r| self.refused(r);
        let read = match self.file.strip_prefix(presets::BUILTIN) {
            Some(name) => builtin(name),
            None => parsed(&base.join(self.file)),
        };
        let Parsed {
            matrix,
            header,
            missing,
            defects,
        } = read.map_err(refused)?;
        let unit_m = self.unit_m(&header)?;
        check(&matrix, unit_m).map_err(refused)?;
        let pixel_m = self.pixel_m(&matrix, &header)?;
        let heights: Vec<f64> = matrix.values.iter().map(|v| v * unit_m).collect();
        let (columns, heights) = self.cut_and_turned(matrix.columns, heights, pixel_m)?;
        let treatment = Treatment {
            level: self.level.unwrap_or(self.beyond.usual_level()),
            outliers: self.outliers,
            filters: self.filters(pixel_m)?,
        };
        let mut map = HeightMap::treated(columns, &heights, self.beyond, treatment)
            .ok_or_else(|| refused(refusal("flat", "a map whose heights differ")))?;
        (map.facts.missing, map.facts.defects) = (missing, defects);
        if self.level.is_none() && map.facts.is_open {
            return Err(SceneError::map(
                joined(self.table, "level"),
                "left out, of a periodic map that is tilted".to_owned(),
                format!(
                    "\"plane\", which takes the tilt off, or \"mean\", which keeps it: {}, and the ends of the map do not meet",
                    tilt(&map, pixel_m)
                ),
            ));
        }
        Ok(Found {
            map,
            digest: digest(&matrix),
            pixel_m,
            unit_m,
        })
    }

    /// The map without its rim, turned.
    fn cut_and_turned(
        &self,
        columns: usize,
        heights: Vec<f64>,
        pixel_m: f64,
    ) -> Result<(usize, Vec<f64>), SceneError> {
        let too_little = |key: &str, value: f64, unit: &str| {
            let value = format!("{} {unit}", short(value));
            let allowed = format!("what leaves {} pixels a side", SIDE.start());
            SceneError::map(joined(self.table, key), value, allowed)
        };
        let (mut columns, mut heights) = (columns, heights);
        if let Some(rim_m) = self.crop_m {
            let rim = (rim_m / pixel_m).round() as usize;
            (columns, heights) =
                cropped(columns, &heights, rim).ok_or_else(|| too_little("crop_m", rim_m, "m"))?;
        }
        if let Some(degrees) = self.turn_deg {
            (columns, heights) = turned(columns, &heights, degrees)
                .ok_or_else(|| too_little("turn_deg", degrees, "degrees"))?;
        }
        Ok((columns, heights))
    }

    /// Cut-offs in pixels.
    fn filters(&self, pixel_m: f64) -> Result<[Option<f64>; 2], SceneError> {
        let [short_m, long_m] = self.filters_m;
        let refused = |key: &str, value_m: f64, least_m: f64, what: &str| {
            let allowed = format!("more than {} m: {what}", short(rounded(least_m)));
            SceneError::map(
                joined(self.table, key),
                format!("{} m", short(value_m)),
                allowed,
            )
        };
        let least_m = 2.0 * pixel_m;
        if let Some(short_m) = short_m.filter(|short_m| *short_m < least_m) {
            return Err(refused("s_filter_m", short_m, least_m, "two pixels"));
        }
        let least_m = short_m.unwrap_or(least_m);
        if let Some(long_m) = long_m.filter(|long_m| *long_m <= least_m) {
            let what = if short_m.is_some() {
                "s_filter_m"
            } else {
                "two pixels"
            };
            return Err(refused("l_filter_m", long_m, least_m, what));
        }
        Ok(self.filters_m.map(|cut_off_m| Some(cut_off_m? / pixel_m)))
    }

    fn refused(&self, r: Refusal) -> SceneError {
        let found = format!("{} ({})", shortened(self.file), r.found);
        SceneError::map(joined(self.table, "file"), found, r.allowed)
    }

    /// A key that says otherwise than the file.
    fn contradicted(&self, key: &str, value_m: f64, said_m: f64, words: &str) -> SceneError {
        SceneError::map(
            joined(self.table, key),
            format!("{} m", short(value_m)),
            format!(
                "{} m, which {} says ({words}); leave {key} out, or correct the file",
                short(rounded(said_m)),
                shortened(self.file)
            ),
        )
    }

    /// Height of a value of 1: the file's word; without one, the scene's.
    fn unit_m(&self, header: &Header) -> Result<f64, SceneError> {
        match (self.unit_m, &header.unit) {
            (Some(key_m), Some(said)) if (key_m / said.value_m - 1.0).abs() > 1e-6 => {
                Err(self.contradicted("unit_m", key_m, said.value_m, &said.words))
            }
            (Some(key_m), _) => Ok(key_m),
            (None, Some(said)) => Ok(said.value_m),
            (None, None) => Ok(1.0),
        }
    }

    /// Side of a pixel: the scene's, which must be the file's where that says one.
    fn pixel_m(&self, matrix: &Matrix, header: &Header) -> Result<f64, SceneError> {
        let rows = matrix.values.len() / matrix.columns;
        let said = [(&header.width, matrix.columns), (&header.height, rows)];
        let mut sides = said
            .into_iter()
            .filter_map(|(said, pixels)| Some((said.as_ref()?, pixels as f64)))
            .map(|(said, pixels)| (said.value_m / pixels, said));
        let key = keys::find("body_1.surface.pixel_m");
        let allowed = key.map_or_else(String::new, keys::Key::allowed);
        let (first, second) = (sides.next(), sides.next());
        if let (Some((x_m, x)), Some((y_m, y))) = (first, second)
            && (x_m / y_m - 1.0).abs() > x.slack + y.slack
        {
            let [x_m, y_m] = [x_m, y_m].map(|side_m| short(rounded(side_m)));
            return Err(self.refused(refusal(
                format!("pixels of {x_m} m by {y_m} m: {} and {}", x.words, y.words),
                "pixels as wide as high",
            )));
        }
        let Some(key_m) = self.pixel_m else {
            let Some((side_m, said)) = first else {
                return Err(SceneError::Missing {
                    key: joined(self.table, "pixel_m"),
                    allowed: format!("{allowed}, or a file that says it"),
                });
            };
            return match key {
                Some(key) if !key.kind.takes(side_m) => Err(self.refused(refusal(
                    format!("pixels of {} m: {}", short(rounded(side_m)), said.words),
                    format!("pixels of {allowed}"),
                ))),
                Some(_) | None => Ok(side_m),
            };
        };
        for (side_m, said) in [first, second].into_iter().flatten() {
            if (key_m / side_m - 1.0).abs() > said.slack {
                return Err(self.contradicted("pixel_m", key_m, side_m, &said.words));
            }
        }
        Ok(key_m)
    }
}

/// A number for people: six figures.
fn rounded(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// FNV-1a of the number of columns and of the numbers: how they are written does not matter.
fn digest(matrix: &Matrix) -> String {
    let mut digest = FnvHasher::default();
    digest.write(&(matrix.columns as u64).to_le_bytes());
    for value in &matrix.values {
        digest.write(&value.to_bits().to_le_bytes());
    }
    format!("{:016x}", digest.finish())
}

/// A map that is not the one that the scene was run with.
pub(super) fn changed(table: &str, file: &str, found: &str) -> SceneError {
    SceneError::map(
        joined(table, "file"),
        format!("{} (its numbers have changed)", shortened(file)),
        format!(
            "the map that the scene was run with; to use the new one, omit {} (it would be {found})",
            joined(table, "digest")
        ),
    )
}

/// A map that comes with the program.
fn builtin(name: &str) -> Result<Parsed, Refusal> {
    let text = presets::map(name)
        .ok_or_else(|| refusal("no such map", "a map that comes with the program"))?;
    let (matrix, header) = text::parse(text.as_bytes())?;
    Ok(Parsed::whole(matrix, header))
}

fn parsed(path: &Path) -> Result<Parsed, Refusal> {
    let extension = path
        .extension()
        .and_then(std::ffi::OsStr::to_str)
        .map(str::to_ascii_lowercase);
    match extension.as_deref() {
        Some("npy") => Ok(Parsed::whole(npy::parse(&bytes(path)?)?, Header::default())),
        Some("csv" | "txt") => {
            let (matrix, header) = text::parse(&bytes(path)?)?;
            Ok(Parsed::whole(matrix, header))
        }
        Some("x3p") => x3p::parse(&bytes(path)?),
        Some("sur") => sur::parse(&bytes(path)?),
        _ => Err(refusal(
            "unknown kind of file",
            "a file that ends in .npy, .csv, .txt, .x3p or .sur",
        )),
    }
}

/// The whole file, but never more than a map can be, and never from a pipe or a device.
fn bytes(path: &Path) -> Result<Vec<u8>, Refusal> {
    let failed = |error: std::io::Error| {
        refusal(
            error.to_string(),
            "a readable file, its path relative to the scene file",
        )
    };
    let read = || read_up_to(path, LARGEST_FILE);
    let bytes = given_file(path).map_or_else(read, Ok).map_err(failed)?;
    if bytes.len() as u64 > LARGEST_FILE {
        return Err(refusal("larger than 64 MiB", "a file of at most 64 MiB"));
    }
    Ok(bytes)
}

/// Refuses sides that no map has.
fn check_sides(rows: usize, columns: usize) -> Result<(), Refusal> {
    if SIDE.contains(&columns) && SIDE.contains(&rows) {
        return Ok(());
    }
    // Longer text is not read to its end.
    let count = |n: usize| {
        if n > *SIDE.end() {
            format!("more than {}", SIDE.end())
        } else {
            n.to_string()
        }
    };
    let (found, allowed) = (
        format!("{} rows of {}", count(rows), count(columns)),
        sides_allowed(),
    );
    Err(if columns == 3 {
        refusal(
            format!("{found}, which look like x y z"),
            format!("{allowed}; {LIST}"),
        )
    } else {
        refusal(found, allowed)
    })
}

fn sides_allowed() -> String {
    format!("{} to {} rows and columns", SIDE.start(), SIDE.end())
}

/// What to do with a list of points.
const LIST: &str = "heights alone, one row of the map a line, and not a list of points";

fn check(matrix: &Matrix, unit_m: f64) -> Result<(), Refusal> {
    let (nx, ny) = (matrix.columns, matrix.values.len() / matrix.columns.max(1));
    if raster::leads(matrix) {
        return Err(refusal(
            format!("a list x y z: the first two of its {nx} columns are the places of a raster"),
            LIST,
        ));
    }
    check_sides(ny, nx)?;
    let bad = |v: f64| !v.is_finite() || (v * unit_m).abs() > GREATEST_M;
    match matrix.values.iter().position(|&v| bad(v)) {
        None => Ok(()),
        Some(n) => Err(refusal(
            format!(
                "{} in row {}, column {}",
                short(matrix.values[n]),
                n / nx + 1,
                n % nx + 1
            ),
            format!(
                "finite heights of at most {} m; a value counts {} m (unit_m)",
                short(GREATEST_M),
                short(unit_m)
            ),
        )),
    }
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "tests")]

    use super::*;

    #[test]
    fn sizes_and_values_are_bounded() {
        let matrix = |columns: usize, values: Vec<f64>| Matrix { columns, values };
        let why = |m: &Matrix, unit: f64| check(m, unit).err().map(|r| r.found);
        assert_eq!(why(&matrix(4, vec![0.0; 16]), 1.0), None);
        assert!(
            why(&matrix(3, vec![0.0; 12]), 1.0)
                .unwrap()
                .contains("4 rows of 3")
        );
        assert!(why(&matrix(0, vec![]), 1.0).is_some());
        let mut values = vec![0.0; 16];
        values[6] = f64::NAN;
        assert!(
            why(&matrix(4, values.clone()), 1.0)
                .unwrap()
                .contains("row 2, column 3")
        );
        values[6] = 5.0;
        assert!(why(&matrix(4, values.clone()), 1.0).is_some(), "5 m");
        for (cell, short) in [(1e300, "1e300 in"), (-1e-300, ""), (f64::MAX, "1.797")] {
            values[6] = cell;
            let words = why(&matrix(4, values.clone()), 1.0).unwrap_or_default();
            assert!(words.starts_with(short) && words.len() < 60, "{words}");
        }
        values[6] = 5.0;
        assert_eq!(why(&matrix(4, values), 1e-6), None);
    }
}
