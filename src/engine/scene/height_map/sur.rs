//! Digital Surf's `.sur`: a header of 512 bytes, comment, private data, then points row after row, little-endian.
//!
//! ```text
//! z = (value·dz + z_0)·unit of dz        a point is missing where special points are on and value = zmin − 2
//!  0 signature, 12 bytes    14 objects, i16          18 kind, i16      86 special points, i16    94 numbers a point, i32
//! 98 bits a point, i16     100 zmin, i32            108 points a line, lines, points in all, i32
//! 120 dx, dy, dz, f32      180 units of dx, dy, dz, 16 bytes each     288 replica, inverted, i16
//! 334 length of comment and private data, u16       474 z_0, f32
//! ```
//! After the signature `DSCOMPRESSED` the points are zlib streams behind a directory: their number, then the length of
//! each as it was and as it is, all u32. Layout and rules as in the public readers of the format: Gwyddion's module
//! `surffile`, RosettaSciIO's `digitalsurf` and surfalize. Those agree on spacings and steps in the units of dx, dy and
//! dz, not in the units of length for display, which are not read, nor are the ratios between both. RosettaSciIO takes
//! zmin off before dz: a constant that levelling takes off anyway. Only the first object is read.

use std::io::Read as _;

use flate2::bufread::ZlibDecoder;

use super::header::{Header, UNITS, unit};
use super::{Matrix, Parsed, Refusal, check_sides, missing, refusal};
use crate::physics::height_map::{FileDefect, FileDefects};
use crate::scene::error::shortened;

const HEADER: usize = 512;
const SUR: &str = "a .sur of one surface, with points of 16 or 32 bits";
/// Most streams of packed points; there is one in every file that is known.
const STREAMS: usize = 4096;

/// Numbers at places of the header.
struct Head<'a>(&'a [u8; HEADER]);

impl Head<'_> {
    fn u16(&self, at: usize) -> u16 {
        u16::from_le_bytes([self.0[at], self.0[at + 1]])
    }

    fn bytes(&self, at: usize) -> [u8; 4] {
        [self.0[at], self.0[at + 1], self.0[at + 2], self.0[at + 3]]
    }

    fn i32(&self, at: usize) -> i32 {
        i32::from_le_bytes(self.bytes(at))
    }

    /// A number that is one.
    fn f32(&self, at: usize, name: &str) -> Result<f64, Refusal> {
        let value = f64::from(f32::from_le_bytes(self.bytes(at)));
        if value.is_finite() {
            Ok(value)
        } else {
            Err(refusal(format!("{name} is {value}"), "a finite number"))
        }
    }

    /// The unit of a step, m, and as written: in UTF-8, or in Latin-1, which older programs write.
    fn unit(&self, at: usize, name: &str) -> Result<(f64, String), Refusal> {
        let bytes = &self.0[at..at + 16];
        let end = bytes.iter().position(|&b| b == 0).unwrap_or(bytes.len());
        let text = match std::str::from_utf8(&bytes[..end]) {
            Ok(text) => text.to_owned(),
            Err(_) => bytes[..end].iter().map(|&b| char::from(b)).collect(),
        };
        let words = shortened(text.trim());
        let value_m = unit(&words).ok_or_else(|| {
            refusal(
                format!("the unit of {name} is {words:?}"),
                format!("a unit of length: {UNITS}"),
            )
        })?;
        Ok((value_m, words))
    }
}

/// Reads the first surface of the file.
pub(super) fn parse(bytes: &[u8]) -> Result<Parsed, Refusal> {
    let broken = || refusal("not a .sur or cut short", SUR);
    let (header, rest) = bytes.split_first_chunk().ok_or_else(broken)?;
    let head = Head(header);
    let is_packed = match &header[..12] {
        b"DIGITAL SURF" => false,
        b"DSCOMPRESSED" => true,
        _ => return Err(broken()),
    };
    let (kind, width) = kind_and_width(&head)?;
    let mut defects = FileDefects::default();
    let side = |at: usize| usize::try_from(head.i32(at)).unwrap_or(0);
    let (columns, rows) = (side(108), side(112));
    // Checked before anything is multiplied or held.
    check_sides(rows, columns)?;
    if side(116) != rows * columns {
        defects.add(FileDefect::PointCount);
    }
    for (at, defect) in [(288, FileDefect::Replica), (290, FileDefect::Inverted)] {
        if head.u16(at) != 0 {
            defects.add(defect);
        }
    }
    let skipped = usize::from(head.u16(334)) + usize::from(head.u16(336));
    let data = rest.get(skipped..).ok_or_else(broken)?;
    let need = rows * columns * width;
    let unpacked;
    let points = if is_packed {
        unpacked = inflated(data, need)?;
        &unpacked[..]
    } else {
        // Further objects may follow.
        if data.len() > need && kind == SURFACE {
            defects.add(FileDefect::LongData);
        }
        data.get(..need).ok_or_else(|| short_of(data.len(), need))?
    };
    let mut matrix = heights(&head, points, columns, width)?;
    let missing = missing::fill(&mut matrix)?;
    Ok(Parsed {
        matrix,
        header: said(&head, columns, rows)?,
        missing,
        defects,
    })
}

/// The kind of a surface.
const SURFACE: u16 = 2;

/// The kind of the object and the bytes of a point, of files that hold one surface.
fn kind_and_width(head: &Head) -> Result<(u16, usize), Refusal> {
    const BIG_ENDIAN: u16 = 257;
    if head.u16(12) == BIG_ENDIAN {
        return Err(refusal("a file of the old Macintosh", SUR));
    }
    let kind = head.u16(18);
    // 1, a profile, is what Gwyddion writes for surfaces; of 11 and 16 the surface comes first and pictures follow.
    if !matches!(kind, 1 | SURFACE | 11 | 16) {
        return Err(refusal(format!("an object of kind {kind}"), SUR));
    }
    let objects = head.u16(14);
    if objects > 1 {
        return Err(refusal(format!("{objects} objects"), SUR));
    }
    let numbers = head.i32(94);
    if numbers > 1 {
        return Err(refusal(format!("{numbers} numbers a point"), SUR));
    }
    match head.u16(98) {
        16 => Ok((kind, 2)),
        32 => Ok((kind, 4)),
        bits => Err(refusal(format!("points of {bits} bits"), SUR)),
    }
}

fn short_of(found: usize, need: usize) -> Refusal {
    refusal(
        format!("{found} bytes of points"),
        format!("{need} for its lines and points of a line"),
    )
}

/// What the header says of unit and pixel.
fn said(head: &Head, columns: usize, rows: usize) -> Result<Header, Refusal> {
    let pixel = |name: &str, at: usize, unit_at: usize| {
        let (unit_m, unit) = head.unit(unit_at, name)?;
        let step = head.f32(at, name)?;
        // As many figures as a number of 32 bits has.
        let written = format!("{step:.6e}").parse::<f64>().unwrap_or(step);
        Ok((
            written * unit_m,
            format!("{name} of {written} {unit} in the header"),
        ))
    };
    let (unit_m, words) = head.unit(212, "dz")?;
    Ok(Header::of_instrument(
        (unit_m, format!("dz in {words:?} in the header")),
        [pixel("dx", 120, 180)?, pixel("dy", 124, 196)?],
        [columns, rows],
    ))
}

/// Heights in the unit of dz; missing ones are no numbers.
fn heights(head: &Head, points: &[u8], columns: usize, width: usize) -> Result<Matrix, Refusal> {
    let (step, offset) = (head.f32(128, "dz")?, head.f32(474, "the offset of z")?);
    let absent = (head.u16(86) == 1).then(|| i64::from(head.i32(100)) - 2);
    let height = |value: i32| {
        if Some(i64::from(value)) == absent {
            f64::NAN
        } else {
            f64::from(value) * step + offset
        }
    };
    let values = if width == 2 {
        let values = points.chunks_exact(2);
        values
            .map(|b| height(i32::from(i16::from_le_bytes([b[0], b[1]]))))
            .collect()
    } else {
        let values = points.chunks_exact(4);
        values
            .map(|b| height(i32::from_le_bytes([b[0], b[1], b[2], b[3]])))
            .collect()
    };
    Ok(Matrix { columns, values })
}

/// The packed points, never more than `need` bytes of them.
fn inflated(data: &[u8], need: usize) -> Result<Vec<u8>, Refusal> {
    let broken = || refusal("packed points that are broken or cut short", SUR);
    let number = |at: usize| {
        let bytes = data.get(at..at + 4)?;
        Some(u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]) as usize)
    };
    let streams = number(0).ok_or_else(broken)?;
    if streams > STREAMS {
        return Err(refusal(format!("{streams} streams of points"), SUR));
    }
    let mut rest = data.get(4 + 8 * streams..).ok_or_else(broken)?;
    let mut points = Vec::new();
    for stream in 0..streams {
        let length = number(4 + 8 * stream + 4).ok_or_else(broken)?;
        let (packed, after) = rest.split_at_checked(length).ok_or_else(broken)?;
        let most = (need - points.len()) as u64 + 1;
        let mut stream = ZlibDecoder::new(packed).take(most);
        stream.read_to_end(&mut points).map_err(|_| broken())?;
        if points.len() > need {
            return Err(short_of(points.len(), need));
        }
        rest = after;
    }
    if points.len() == need {
        Ok(points)
    } else {
        Err(short_of(points.len(), need))
    }
}
