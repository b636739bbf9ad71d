//! Height maps from files: `.npy` and `.csv`, hostile until parsed.
//!
//! Columns run along x (the rolling direction), rows along y, the first row at −y. A value times `unit_m`
//! is a height in m, positive towards the mating body. `.npy`: two-dimensional, C order, little-endian
//! `f4` or `f8` (format versions 1 to 3, NumPy's `numpy.lib.format`). `.csv`, `.txt`: numbers and nothing
//! else, one row of the map a line, separated by commas, semicolons, tabs or spaces; empty lines and lines
//! that begin with `#` are skipped. `builtin:NAME` is a map that comes with the program (scenes of `evidence/`).

use std::hash::Hasher as _;
use std::path::Path;

use super::error::{SceneError, shortened};
use super::keys::{joined, short};
use super::presets;
use crate::files::{FnvHasher, read_up_to};
use crate::physics::height_map::{HeightMap, MapEdge};

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

/// Reads the map of the table `table` (such as `body_1.surface`) from `file`, relative to `base`, and the digest of its
/// numbers.
pub(super) fn read(
    table: &str,
    base: &Path,
    file: &str,
    unit_m: f64,
    beyond: MapEdge,
) -> Result<(HeightMap, String), SceneError> {
    let refused = |r: Refusal| {
        let found = format!("{} ({})", shortened(file), r.found);
        SceneError::map(joined(table, "file"), found, r.allowed)
    };
    let matrix = match file.strip_prefix(presets::BUILTIN) {
        Some(name) => builtin(name),
        None => matrix(&base.join(file)),
    };
    let matrix = matrix.map_err(refused)?;
    check(&matrix, unit_m).map_err(refused)?;
    let heights: Vec<f64> = matrix.values.iter().map(|v| v * unit_m).collect();
    let map = HeightMap::new(matrix.columns, &heights, beyond)
        .ok_or_else(|| refused(refusal("flat", "a map whose heights differ")))?;
    Ok((map, digest(&matrix)))
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
fn builtin(name: &str) -> Result<Matrix, Refusal> {
    let text = presets::map(name)
        .ok_or_else(|| refusal("no such map", "a map that comes with the program"))?;
    parse_csv(text.as_bytes())
}

fn matrix(path: &Path) -> Result<Matrix, Refusal> {
    let extension = path
        .extension()
        .and_then(std::ffi::OsStr::to_str)
        .map(str::to_ascii_lowercase);
    let parse: fn(&[u8]) -> Result<Matrix, Refusal> = match extension.as_deref() {
        Some("npy") => parse_npy,
        Some("csv" | "txt") => parse_csv,
        _ => {
            return Err(refusal(
                "unknown kind of file",
                "a file that ends in .npy, .csv or .txt",
            ));
        }
    };
    parse(&bytes(path)?)
}

/// The whole file, but never more than a map can be, and never from a pipe or a device.
fn bytes(path: &Path) -> Result<Vec<u8>, Refusal> {
    let failed = |error: std::io::Error| {
        refusal(
            error.to_string(),
            "a readable file, its path relative to the scene file",
        )
    };
    let bytes = read_up_to(path, LARGEST_FILE).map_err(failed)?;
    if bytes.len() as u64 > LARGEST_FILE {
        return Err(refusal("larger than 64 MiB", "a file of at most 64 MiB"));
    }
    Ok(bytes)
}

fn check(matrix: &Matrix, unit_m: f64) -> Result<(), Refusal> {
    let (nx, ny) = (matrix.columns, matrix.values.len() / matrix.columns.max(1));
    if !SIDE.contains(&nx) || !SIDE.contains(&ny) {
        return Err(refusal(
            format!("{ny} rows of {nx}"),
            format!("{} to {} rows and columns", SIDE.start(), SIDE.end()),
        ));
    }
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

fn parse_csv(bytes: &[u8]) -> Result<Matrix, Refusal> {
    let text = std::str::from_utf8(bytes).map_err(|_| refusal("not UTF-8", "numbers as text"))?;
    let mut matrix = Matrix {
        columns: 0,
        values: Vec::new(),
    };
    for (number, line) in text.lines().enumerate() {
        let line = line.trim().trim_start_matches('\u{feff}');
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let before = matrix.values.len();
        for (column, cell) in cells(line).enumerate() {
            if column >= *SIDE.end() {
                break;
            }
            let value = cell.parse::<f64>().map_err(|_| {
                refusal(
                    format!(
                        "{:?} in line {}, column {}",
                        shortened(cell),
                        number + 1,
                        column + 1
                    ),
                    "numbers only, such as -1.2e-7",
                )
            })?;
            matrix.values.push(value);
        }
        let width = matrix.values.len() - before;
        if matrix.columns == 0 {
            matrix.columns = width;
        } else if width != matrix.columns {
            return Err(refusal(
                format!("{width} numbers in line {}", number + 1),
                format!("{}, as in the first row", matrix.columns),
            ));
        }
    }
    Ok(matrix)
}

/// Cells of a line: between commas or semicolons each stands for itself, white space counts as one gap.
fn cells(line: &str) -> Box<dyn Iterator<Item = &str> + '_> {
    if line.contains([',', ';']) {
        Box::new(line.split([',', ';']).map(str::trim))
    } else {
        Box::new(line.split_whitespace())
    }
}

const NPY: &str = "a .npy of two dimensions, C order, little-endian float32 or float64";

fn parse_npy(bytes: &[u8]) -> Result<Matrix, Refusal> {
    let broken = || refusal("not a .npy or cut short", NPY);
    if bytes.get(..6) != Some(b"\x93NUMPY") {
        return Err(broken());
    }
    let major = *bytes.get(6).ok_or_else(broken)?;
    let (length, start) = match major {
        1 => {
            let at = bytes.get(8..10).ok_or_else(broken)?;
            (usize::from(u16::from_le_bytes([at[0], at[1]])), 10)
        }
        2 | 3 => {
            let at = bytes.get(8..12).ok_or_else(broken)?;
            (
                u32::from_le_bytes([at[0], at[1], at[2], at[3]]) as usize,
                12,
            )
        }
        other => return Err(refusal(format!("format version {other}"), NPY)),
    };
    let header = bytes.get(start..start + length).ok_or_else(broken)?;
    let header = std::str::from_utf8(header).map_err(|_| broken())?;
    let (rows, columns, width) = npy_header(header)?;
    let data = &bytes[start + length..];
    // Checked before anything is multiplied: both are at most 8192 here.
    if !SIDE.contains(&rows) || !SIDE.contains(&columns) {
        return Err(refusal(
            format!("shape ({rows}, {columns})"),
            format!("{} to {} rows and columns", SIDE.start(), SIDE.end()),
        ));
    }
    if data.len() != rows * columns * width {
        return Err(refusal(
            format!("{} bytes of data", data.len()),
            format!(
                "{} for its shape ({rows}, {columns})",
                rows * columns * width
            ),
        ));
    }
    let values = if width == 4 {
        data.chunks_exact(4)
            .map(|b| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]])))
            .collect()
    } else {
        data.chunks_exact(8)
            .map(|b| f64::from_le_bytes([b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7]]))
            .collect()
    };
    Ok(Matrix { columns, values })
}

/// Rows, columns and bytes of a number from `{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }`.
fn npy_header(header: &str) -> Result<(usize, usize, usize), Refusal> {
    let after = |key: &str| {
        let quoted = [format!("'{key}'"), format!("\"{key}\"")];
        quoted
            .iter()
            .find_map(|q| header.find(q.as_str()).map(|at| &header[at + q.len()..]))
            .and_then(|rest| rest.trim_start().strip_prefix(':'))
            .map(str::trim_start)
            .ok_or_else(|| refusal(format!("no {key} in the header"), NPY))
    };
    let descr = after("descr")?;
    let width = match descr.get(1..4) {
        Some("<f4") => 4,
        Some("<f8") => 8,
        _ => {
            // In quotes, and not what follows; of a record a list.
            let kind: String = descr.split([',', '}']).next().unwrap_or_default().into();
            let kind = shortened(kind.trim());
            return Err(refusal(format!("numbers of kind {kind}"), NPY));
        }
    };
    if !after("fortran_order")?.starts_with("False") {
        return Err(refusal("Fortran order", NPY));
    }
    let shape = after("shape")?;
    let inside = shape
        .strip_prefix('(')
        .and_then(|rest| rest.split_once(')'))
        .map(|(inside, _)| inside)
        .ok_or_else(|| refusal("no shape", NPY))?;
    let sides: Vec<usize> = inside
        .split(',')
        .map(str::trim)
        .filter(|side| !side.is_empty())
        .map(|side| side.parse().map_err(|_| refusal("a broken shape", NPY)))
        .collect::<Result<_, _>>()?;
    match sides[..] {
        [rows, columns] => Ok((rows, columns, width)),
        _ => Err(refusal(format!("{} dimensions", sides.len()), NPY)),
    }
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "tests")]

    use super::*;

    fn npy(header: &str, data: &[u8]) -> Vec<u8> {
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend((header.len() as u16).to_le_bytes());
        bytes.extend(header.as_bytes());
        bytes.extend(data);
        bytes
    }

    fn header(descr: &str, order: &str, shape: &str) -> String {
        format!("{{'descr': '{descr}', 'fortran_order': {order}, 'shape': {shape}, }}   \n")
    }

    fn found(result: Result<Matrix, Refusal>) -> String {
        match result {
            Ok(_) => "accepted".to_owned(),
            Err(refusal) => refusal.found,
        }
    }

    #[test]
    fn npy_of_both_widths() {
        let values: Vec<f64> = (0..20).map(|n| 1e-9 * f64::from(n)).collect();
        let eight: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
        let four: Vec<u8> = values
            .iter()
            .flat_map(|&v| (v as f32).to_le_bytes())
            .collect();
        let read = |descr: &str, data: &[u8]| {
            let matrix = parse_npy(&npy(&header(descr, "False", "(4, 5)"), data));
            matrix.map_err(|r| r.found).unwrap()
        };
        let matrix = read("<f8", &eight);
        assert_eq!(matrix.columns, 5);
        assert_eq!(matrix.values, values);
        let matrix = read("<f4", &four);
        for (one, two) in matrix.values.iter().zip(&values) {
            assert!((one - two).abs() < 1e-15);
        }
    }

    #[test]
    fn broken_npy_is_refused_and_never_panics() {
        let good = npy(&header("<f8", "False", "(4, 4)"), &[0; 128]);
        assert_eq!(found(parse_npy(&good)), "accepted");
        for cut in 0..good.len() {
            assert_ne!(found(parse_npy(&good[..cut])), "accepted", "{cut}");
        }
        for (descr, order, shape, why) in [
            (">f8", "False", "(4, 4)", "kind"),
            ("<i4", "False", "(4, 4)", "kind"),
            ("<f8", "True", "(4, 4)", "Fortran"),
            ("<f8", "False", "(16,)", "1 dimensions"),
            ("<f8", "False", "(4, 4, 1)", "3 dimensions"),
            ("<f8", "False", "(4, 5)", "128 bytes"),
            ("<f8", "False", "(99999999999999999999, 4)", "broken shape"),
            ("<f8", "False", "(9223372036854775807, 2)", "shape"),
            ("<f8", "False", "(-4, 4)", "broken shape"),
        ] {
            let text = found(parse_npy(&npy(&header(descr, order, shape), &[0; 128])));
            assert!(text.contains(why), "{text}: {why}");
            assert!(!text.ends_with(','), "{text}");
        }
        let mut version = good.clone();
        version[6] = 9;
        assert!(found(parse_npy(&version)).contains("version 9"));
    }

    #[test]
    fn csv_with_any_separator() {
        for text in [
            "1,2,3,4\n5,6,7,8\n",
            "# heights\n1;2;3;4\n\n5; 6;7;8",
            "1 2\t3  4\r\n5 6 7 8\r\n",
        ] {
            let matrix = parse_csv(text.as_bytes()).map_err(|r| r.found).unwrap();
            assert_eq!(matrix.columns, 4);
            assert_eq!(matrix.values, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]);
        }
        assert!(found(parse_csv(b"1,2\n3,x\n")).contains("\"x\" in line 2, column 2"));
        assert!(found(parse_csv(b"1,2\n3\n")).contains("1 numbers in line 2"));
        assert!(found(parse_csv(b"1,,2\n")).contains("column 2"));
        assert!(found(parse_csv(&[0xff, 0xfe])).contains("UTF-8"));
    }

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
