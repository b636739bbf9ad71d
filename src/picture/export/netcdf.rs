//! NetCDF in its classic form with 64-bit offsets (CDF-2), which every tool for it reads.
//!
//! ```text
//! "CDF" 2 | 0 records | dimensions | no attributes of the file | variables | values, one variable after another
//! dimension  name, length            variable  name, dimensions, units, type, bytes, offset
//! ```
//! Numbers are big-endian; names and values are filled up to 4 bytes. Source: the NetCDF user's guide, appendix B, file format
//! specifications. The crate `netcdf3` was read in its place: it calls itself experimental, and the 90 lines below are all
//! that fields need.

use std::borrow::Cow;
use std::io::{Error, ErrorKind, Result};

const DIMENSIONS: u32 = 0x0a;
const VARIABLES: u32 = 0x0b;
const ATTRIBUTES: u32 = 0x0c;
const BYTE: u32 = 1;
const CHAR: u32 = 2;
const FLOAT: u32 = 5;
const DOUBLE: u32 = 6;
const FILL: u8 = 0x81;

/// Numbers of an array.
pub(super) enum ArrayValues<'a> {
    F32(&'a [f32]),
    F64(Cow<'a, [f64]>),
    U8(&'a [u8]),
}

/// An array: its name, its axes from the slowest to the fastest, and its numbers.
pub(super) struct FieldArray<'a> {
    pub(super) name: &'static str,
    pub(super) axes: &'static [&'static str],
    pub(super) values: ArrayValues<'a>,
}

/// A file in the making.
#[derive(Debug, Default)]
pub(super) struct NetCdf {
    axes: Vec<(&'static str, usize)>,
    /// Of every variable what stands before its offset, and its values.
    variables: Vec<(Vec<u8>, Vec<u8>)>,
}

impl NetCdf {
    /// Names an axis.
    pub(super) fn axis(&mut self, name: &'static str, length: usize) {
        self.axes.push((name, length));
    }

    /// Adds an array over axes that were named.
    pub(super) fn array(&mut self, array: &FieldArray) -> Result<()> {
        let wrong = |what: String| Error::new(ErrorKind::InvalidInput, what);
        let mut head = Vec::new();
        put_name(&mut head, array.name);
        put(&mut head, array.axes.len() as u32);
        let mut expected = 1;
        for axis in array.axes {
            let at = self.axes.iter().position(|(name, _)| name == axis);
            let at = at.ok_or_else(|| wrong(format!("{}: no axis {axis}", array.name)))?;
            expected *= self.axes[at].1;
            put(&mut head, at as u32);
        }
        match units(array.name) {
            Some(units) => {
                put(&mut head, ATTRIBUTES);
                put(&mut head, 1);
                put_name(&mut head, "units");
                put(&mut head, CHAR);
                put_name(&mut head, units);
            }
            None => head.extend([0; 8]),
        }
        let (kind, count, mut values): (u32, usize, Vec<u8>) = match &array.values {
            ArrayValues::F32(all) => (FLOAT, all.len(), big_endian(all, f32::to_be_bytes)),
            ArrayValues::F64(all) => (DOUBLE, all.len(), big_endian(all, f64::to_be_bytes)),
            ArrayValues::U8(all) => (BYTE, all.len(), all.to_vec()),
        };
        if count != expected {
            let what = format!("{}: {count} values on {expected} nodes", array.name);
            return Err(wrong(what));
        }
        // What fills a variable up is what stands for missing bytes.
        values.resize(values.len().next_multiple_of(4), FILL);
        put(&mut head, kind);
        let bytes = u32::try_from(values.len()).map_err(|_| wrong("more than 4 GB".to_owned()))?;
        put(&mut head, bytes);
        self.variables.push((head, values));
        Ok(())
    }

    /// The whole file.
    pub(super) fn finish(self) -> Vec<u8> {
        let mut file = b"CDF\x02\0\0\0\0".to_vec();
        put(&mut file, DIMENSIONS);
        put(&mut file, self.axes.len() as u32);
        for (name, length) in self.axes {
            put_name(&mut file, name);
            put(&mut file, length as u32);
        }
        file.extend([0; 8]);
        put(&mut file, VARIABLES);
        put(&mut file, self.variables.len() as u32);
        let heads: usize = self.variables.iter().map(|(head, _)| head.len() + 8).sum();
        let mut offset = (file.len() + heads) as u64;
        for (head, values) in &self.variables {
            file.extend_from_slice(head);
            file.extend(offset.to_be_bytes());
            offset += values.len() as u64;
        }
        file.extend(self.variables.into_iter().flat_map(|(_, values)| values));
        file
    }
}

fn big_endian<T: Copy, const N: usize>(values: &[T], bytes: impl Fn(T) -> [u8; N]) -> Vec<u8> {
    values.iter().flat_map(|value| bytes(*value)).collect()
}

fn put(out: &mut Vec<u8>, number: u32) {
    out.extend(number.to_be_bytes());
}

/// A text with its length before it.
fn put_name(out: &mut Vec<u8>, name: &str) {
    put(out, name.len() as u32);
    out.extend(name.as_bytes());
    pad(out);
}

fn pad(out: &mut Vec<u8>) {
    out.resize(out.len().next_multiple_of(4), 0);
}

/// The unit that a name ends in, as other programs write it.
fn units(name: &str) -> Option<&'static str> {
    let ends = [
        ("_m_s", "m s-1"),
        ("_pa", "Pa"),
        ("_m3", "m3"),
        ("_m", "m"),
        ("_n", "N"),
        ("_s", "s"),
    ];
    let end = ends.iter().find(|(end, _)| name.ends_with(end));
    end.map(|(_, unit)| *unit)
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "tests")]
    use super::*;

    /// What scipy 1.x writes of the same: `netcdf_file(name, "w", version=2)`, a dimension x of 3, `p_pa(x)` of 1, 2, 3 in
    /// single precision with units Pa, `touch(x)` of 0, 1, 0 and the scalar `t_s` of 0.5 with units s.
    const EXPECTED: &[u8] = include_bytes!("netcdf_by_scipy.nc");

    #[test]
    fn files_are_those_of_another_writer() {
        let mut file = NetCdf::default();
        file.axis("x", 3);
        let add =
            |file: &mut NetCdf, name, axes, values| file.array(&FieldArray { name, axes, values });
        let x: &[&str] = &["x"];
        add(&mut file, "p_pa", x, ArrayValues::F32(&[1.0, 2.0, 3.0])).unwrap();
        add(&mut file, "touch", x, ArrayValues::U8(&[0, 1, 0])).unwrap();
        let half = ArrayValues::F64(vec![0.5].into());
        add(&mut file, "t_s", &[], half).unwrap();
        assert!(add(&mut file, "q", x, ArrayValues::U8(&[0])).is_err());
        assert!(add(&mut file, "q", &["z"], ArrayValues::U8(&[0])).is_err());
        assert_eq!(file.finish(), EXPECTED);
    }
}
