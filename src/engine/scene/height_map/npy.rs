//! NumPy's `.npy`: two-dimensional, C order, little-endian `f4` or `f8`, format versions 1 to 3 (`numpy.lib.format`).

use super::{Matrix, Refusal, check_sides, refusal};
use crate::scene::error::shortened;

const NPY: &str = "a .npy of two dimensions, C order, little-endian float32 or float64";

pub(super) fn parse(bytes: &[u8]) -> Result<Matrix, Refusal> {
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
    check_sides(rows, columns)?;
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
    let width = match kind(descr) {
        Some("<f4") => 4,
        Some("<f8") => 8,
        Some(other) => {
            let other = shortened(other);
            return Err(refusal(format!("numbers of kind '{other}'"), NPY));
        }
        None => return Err(refusal("records of several numbers", NPY)),
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

/// The text in quotes with which `descr` begins; records have a list there.
fn kind(descr: &str) -> Option<&str> {
    let quote = descr.chars().next().filter(|c| matches!(c, '\'' | '"'))?;
    descr[1..].split(quote).next()
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
            let matrix = parse(&npy(&header(descr, "False", "(4, 5)"), data));
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
        assert_eq!(found(parse(&good)), "accepted");
        for cut in 0..good.len() {
            assert_ne!(found(parse(&good[..cut])), "accepted", "{cut}");
        }
        for (descr, order, shape, why) in [
            (">f8", "False", "(4, 4)", "numbers of kind '>f8'"),
            ("<i4", "False", "(4, 4)", "numbers of kind '<i4'"),
            ("|b1", "False", "(4, 4)", "numbers of kind '|b1'"),
            ("<c16", "False", "(4, 4)", "numbers of kind '<c16'"),
            ("<f8", "False", "(16, 3)", "look like x y z"),
            ("<f8", "True", "(4, 4)", "Fortran"),
            ("<f8", "False", "(16,)", "1 dimensions"),
            ("<f8", "False", "(4, 4, 1)", "3 dimensions"),
            ("<f8", "False", "(4, 5)", "128 bytes"),
            ("<f8", "False", "(99999999999999999999, 4)", "broken shape"),
            (
                "<f8",
                "False",
                "(9223372036854775807, 2)",
                "more than 8192 rows of 2",
            ),
            ("<f8", "False", "(-4, 4)", "broken shape"),
        ] {
            let text = found(parse(&npy(&header(descr, order, shape), &[0; 128])));
            assert!(text.contains(why), "{text}: {why}");
            assert!(!text.contains("',"), "a stray comma: {text}");
        }
        let records = "{'descr': [('x', '<f8')], 'fortran_order': False, 'shape': (4, 4), }\n";
        let text = found(parse(&npy(records, &[0; 128])));
        assert_eq!(text, "records of several numbers");
        let mut version = good.clone();
        version[6] = 9;
        assert!(found(parse(&version)).contains("version 9"));
    }
}
