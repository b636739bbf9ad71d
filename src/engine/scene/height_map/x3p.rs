//! `.x3p` (ISO 25178-72, before it ISO 5436-2): a zip archive of `main.xml` and, but for heights as text, a file of points.
//!
//! ```text
//! z = value·increment + offset, m     types I (i16) and L (i32)
//! z = value + offset, m               types F (f32) and D (f64), little-endian, x fastest; no number: missing
//! ```
//! The file of valid points has one bit a point, the lowest of a byte first, 1 for valid (openGPS's `ValidBuffer`). Lengths
//! are in m. Elements are known by their place below the root, whatever its name and their namespaces. In a `DataList`
//! a `Datum` is its text behind the last semicolon; an empty one is missing. Some programs multiply F and D by the
//! increment of z, others do not: one other than 1 is refused. An MD5 sum that is not that of main.xml is
//! named and no more, for many programs write wrong ones; the archive's own sums are checked. Dates are not read. The layout was checked against openGPS and surfalize.

use std::io::{BufReader, Cursor, Read};

use quick_xml::events::Event;
use zip::ZipArchive;

use super::header::Header;
use super::{Matrix, Parsed, Refusal, SIDE, check_sides, missing, refusal};
use crate::physics::height_map::{FileDefect, FileDefects};
use crate::scene::error::shortened;
use crate::scene::keys::short;

const X3P: &str = "a .x3p of one surface on a raster";
/// Most bytes that a part of the archive is unpacked to.
const LARGEST_PART: u64 = (*SIDE.end() * *SIDE.end() * 8) as u64;
/// Deepest nesting of main.xml: the standard's is 5.
const DEEPEST: usize = 32;
/// Longest text of an element that counts, bytes.
const LONGEST_TEXT: usize = 4096;

type Archive<'a> = ZipArchive<Cursor<&'a [u8]>>;

/// Elements that are read.
const REVISION: &str = "Record1/Revision";
const FEATURE: &str = "Record1/FeatureType";
const Z_TYPE: &str = "Record1/Axes/CZ/DataType";
const Z_STEP: &str = "Record1/Axes/CZ/Increment";
const Z_OFFSET: &str = "Record1/Axes/CZ/Offset";
const SIZES: [&str; 3] = [
    "Record3/MatrixDimension/SizeX",
    "Record3/MatrixDimension/SizeY",
    "Record3/MatrixDimension/SizeZ",
];
const POINTS: &str = "Record3/DataLink/PointDataLink";
const VALID: &str = "Record3/DataLink/ValidPointsLink";
const DATUM: &str = "Record3/DataList/Datum";
#[rustfmt::skip]
const READ: [&str; 14] = [
    REVISION, FEATURE, "Record1/Axes/CX/AxisType", "Record1/Axes/CY/AxisType", "Record1/Axes/CX/Increment",
    "Record1/Axes/CY/Increment", Z_TYPE, Z_STEP, Z_OFFSET, SIZES[0], SIZES[1], SIZES[2], POINTS, VALID,
];

/// What main.xml says.
#[derive(Default)]
struct Main {
    /// Texts of the elements [`READ`], by their order there; the first of each counts.
    texts: [Option<String>; READ.len()],
    /// Heights as text.
    data: Option<Vec<f64>>,
    defects: FileDefects,
}

/// How points are kept.
#[derive(Clone, Copy)]
enum Kind {
    Int16,
    Int32,
    Float32,
    Float64,
}

impl Kind {
    fn bytes(self) -> usize {
        match self {
            Self::Int16 => 2,
            Self::Int32 | Self::Float32 => 4,
            Self::Float64 => 8,
        }
    }

    fn is_integer(self) -> bool {
        match self {
            Self::Int16 | Self::Int32 => true,
            Self::Float32 | Self::Float64 => false,
        }
    }

    fn value(self, b: &[u8]) -> f64 {
        match self {
            Self::Int16 => f64::from(i16::from_le_bytes([b[0], b[1]])),
            Self::Int32 => f64::from(i32::from_le_bytes([b[0], b[1], b[2], b[3]])),
            Self::Float32 => f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]])),
            Self::Float64 => f64::from_le_bytes([b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7]]),
        }
    }
}

/// Reads the surface of the archive.
pub(super) fn parse(bytes: &[u8]) -> Result<Parsed, Refusal> {
    let mut archive = ZipArchive::new(Cursor::new(bytes))
        .map_err(|_| refusal("not a .x3p (a zip archive) or cut short", X3P))?;
    let place = main_place(&archive)?;
    let folder = place.rsplit_once('/').map_or("", |(folder, _)| folder);
    let mut main = Main::read(&mut archive, &place)?;
    if !folder.is_empty() {
        main.defects.add(FileDefect::Folder);
    }
    match find(&archive, folder, "md5checksum.hex") {
        None => main.defects.add(FileDefect::NoChecksum),
        Some((sum, _)) if is_sum_of(&mut archive, &sum, &place)? => {}
        Some(_) => main.defects.add(FileDefect::WrongChecksum),
    }
    main.check()?;
    let [columns, rows] = main.sides()?;
    let kind = main.kind()?;
    let mut values = match main.data.take() {
        Some(values) if main.text(POINTS).is_none() => {
            if values.len() != rows * columns {
                let found = format!("{} heights as text", values.len());
                return Err(refusal(found, format!("{} for its sizes", rows * columns)));
            }
            values
        }
        Some(_) | None => main.points(&mut archive, folder, kind, rows * columns)?,
    };
    main.scale(&mut values, kind)?;
    main.drop_invalid(&mut archive, folder, kind, &mut values)?;
    let mut matrix = Matrix { columns, values };
    let missing = missing::fill(&mut matrix)?;
    Ok(Parsed {
        header: main.header(columns, rows)?,
        matrix,
        missing,
        defects: main.defects,
    })
}

/// Whether an entry is what some systems put beside each file.
fn is_stray(name: &str) -> bool {
    name.split('/')
        .any(|part| part.eq_ignore_ascii_case("__MACOSX") || part.starts_with("._"))
}

/// Where main.xml is: at the top, else in the folder next to it.
fn main_place(archive: &Archive) -> Result<String, Refusal> {
    let is_main = |name: &&str| {
        let last = name.rsplit('/').next();
        last.is_some_and(|last| last.eq_ignore_ascii_case("main.xml")) && !is_stray(name)
    };
    let depth = |name: &&str| (name.matches('/').count(), name.len());
    let place = archive.file_names().filter(is_main).min_by_key(depth);
    place
        .map(str::to_owned)
        .ok_or_else(|| refusal("no main.xml in the archive", X3P))
}

/// The entry that a link from main.xml means, and whether it lies there: beside it, from the top, or the only one of that
/// name. Case does not count, as in openGPS.
fn find(archive: &Archive, folder: &str, link: &str) -> Option<(String, bool)> {
    let link = link.trim().replace('\\', "/");
    let link = link.trim_start_matches(['.', '/']);
    let beside = format!("{folder}/{link}");
    let beside = beside.trim_start_matches('/');
    let names = || archive.file_names().filter(|name| !is_stray(name));
    for place in [beside, link] {
        if let Some(name) = names().find(|name| name.eq_ignore_ascii_case(place)) {
            return Some((name.to_owned(), true));
        }
    }
    let last = link.rsplit('/').next().filter(|last| !last.is_empty())?;
    let mut like = names().filter(|name| {
        let own = name.rsplit('/').next();
        own.is_some_and(|own| own.eq_ignore_ascii_case(last))
    });
    let name = like.next()?;
    like.next().is_none().then(|| (name.to_owned(), false))
}

/// A part of the archive, at most `most` bytes and one.
fn part(archive: &mut Archive, name: &str, most: u64) -> Result<Vec<u8>, Refusal> {
    let broken =
        |words: String| refusal(format!("{}: {}", shortened(name), shortened(&words)), X3P);
    let entry = archive
        .by_name(name)
        .map_err(|error| broken(error.to_string()))?;
    let mut bytes = Vec::new();
    entry
        .take(most.min(LARGEST_PART) + 1)
        .read_to_end(&mut bytes)
        .map_err(|error| broken(error.to_string()))?;
    Ok(bytes)
}

/// Whether a file of the archive begins with the MD5 sum of another, as `md5sum` writes it.
fn is_sum_of(archive: &mut Archive, sum: &str, of: &str) -> Result<bool, Refusal> {
    let said = part(archive, sum, LONGEST_TEXT as u64)?;
    let said = String::from_utf8_lossy(&said).to_ascii_lowercase();
    let said = said.split_whitespace().next().unwrap_or_default();
    let bytes = part(archive, of, LARGEST_PART)?;
    Ok(format!("{:x}", md5::compute(bytes)) == said.trim_start_matches('\\'))
}

/// Text whose signs beyond ASCII are question marks: none stands in an element that counts, and comments come in
/// any encoding, whatever the first line says.
struct Plain<R>(R);

impl<R: Read> Read for Plain<R> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let length = self.0.read(buffer)?;
        for byte in &mut buffer[..length] {
            if !byte.is_ascii() {
                *byte = b'?';
            }
        }
        Ok(length)
    }
}

impl Main {
    /// Reads main.xml as it is unpacked.
    fn read(archive: &mut Archive, place: &str) -> Result<Self, Refusal> {
        let broken = |words: String| refusal(format!("main.xml: {}", shortened(&words)), X3P);
        let entry = archive
            .by_name(place)
            .map_err(|error| broken(error.to_string()))?;
        let text = BufReader::new(Plain(entry.take(LARGEST_PART)));
        let mut reader = quick_xml::Reader::from_reader(text);
        let (mut main, mut path, mut buffer) = (Self::default(), Vec::new(), Vec::new());
        let mut text = String::new();
        loop {
            buffer.clear();
            let event = reader.read_event_into(&mut buffer);
            match event.map_err(|error| broken(error.to_string()))? {
                Event::Start(element) => {
                    text.clear();
                    path.push(element.local_name().as_ref().to_owned());
                    if path.len() > DEEPEST {
                        return Err(broken(format!("nested more than {DEEPEST} deep")));
                    }
                }
                Event::Empty(element) => {
                    path.push(element.local_name().as_ref().to_owned());
                    main.note(&path, "")?;
                    path.pop();
                }
                Event::Text(piece) if text.len() < LONGEST_TEXT => {
                    text.push_str(&piece);
                }
                Event::CData(piece) if text.len() < LONGEST_TEXT => {
                    text.push_str(&piece);
                }
                Event::End(_) => {
                    main.note(&path, text.trim())?;
                    text.clear();
                    path.pop();
                }
                Event::Eof if path.is_empty() => return Ok(main),
                Event::Eof => return Err(broken("cut short".to_owned())),
                // Another library's set of kinds: comments, declarations, references to entities say nothing here.
                _ => {}
            }
        }
    }

    /// Takes note of an element that ends.
    fn note(&mut self, path: &[String], text: &str) -> Result<(), Refusal> {
        let is_at = |place: &str| {
            let below = path.iter().skip(1).map(String::as_str);
            place.split('/').eq(below)
        };
        if is_at(DATUM) {
            let data = self.data.get_or_insert_default();
            if data.len() >= SIDE.end() * SIDE.end() {
                return Err(refusal("too many heights as text", super::sides_allowed()));
            }
            let cell = text.rsplit(';').next().unwrap_or("").trim();
            let value = if cell.is_empty() {
                f64::NAN
            } else {
                number(cell, DATUM, &mut self.defects)?
            };
            data.push(value);
        } else if let Some(at) = READ.iter().position(|place| is_at(place)) {
            self.texts[at].get_or_insert_with(|| text.to_owned());
        }
        Ok(())
    }

    fn text(&self, place: &str) -> Option<&str> {
        let at = READ.iter().position(|name| *name == place)?;
        self.texts[at].as_deref().filter(|text| !text.is_empty())
    }

    fn needed(&self, place: &str) -> Result<&str, Refusal> {
        let missing = || refusal(format!("no {place} in main.xml"), X3P);
        self.text(place).ok_or_else(missing)
    }

    /// A number of the element, if there is one.
    fn number(&mut self, place: &str) -> Result<Option<f64>, Refusal> {
        let text = self.text(place).map(str::to_owned);
        let value = text
            .map(|text| number(&text, place, &mut self.defects))
            .transpose()?;
        match value {
            Some(value) if !value.is_finite() => {
                Err(refusal(format!("{place} is {value}"), "a finite number"))
            }
            Some(_) | None => Ok(value),
        }
    }

    /// Refuses what is no surface on a raster.
    fn check(&mut self) -> Result<(), Refusal> {
        const SURFACE: &str = "SUR";
        if let Some(feature) = self.text(FEATURE).filter(|feature| *feature != SURFACE) {
            return Err(refusal(
                format!("a feature of type {:?}", shortened(feature)),
                X3P,
            ));
        }
        for axis in ["Record1/Axes/CX/AxisType", "Record1/Axes/CY/AxisType"] {
            if let Some(other) = self.text(axis).filter(|kind| *kind != "I") {
                let found = format!("{axis} is {:?}", shortened(other));
                return Err(refusal(found, "I, places at equal steps"));
            }
        }
        let squeezed: String = self
            .text(REVISION)
            .unwrap_or("")
            .split_whitespace()
            .collect();
        if !["ISO5436-2000", "ISO25178-72:2017/DAM1"].contains(&squeezed.as_str()) {
            self.defects.add(FileDefect::Revision);
        }
        Ok(())
    }

    /// Columns and rows.
    fn sides(&self) -> Result<[usize; 2], Refusal> {
        let size = |place: &str| {
            let text = self.needed(place)?;
            let broken = || {
                refusal(
                    format!("{place} is {:?}", shortened(text)),
                    "a whole number",
                )
            };
            text.parse::<usize>().map_err(|_| broken())
        };
        let [columns, rows] = [size(SIZES[0])?, size(SIZES[1])?];
        let layers = self.text(SIZES[2]).map_or(Ok(1), |_| size(SIZES[2]))?;
        if layers != 1 {
            return Err(refusal(format!("{layers} layers"), X3P));
        }
        // Before anything is multiplied or held.
        check_sides(rows, columns)?;
        Ok([columns, rows])
    }

    fn kind(&self) -> Result<Kind, Refusal> {
        Ok(match self.needed(Z_TYPE)? {
            "I" => Kind::Int16,
            "L" => Kind::Int32,
            "F" => Kind::Float32,
            "D" => Kind::Float64,
            other => {
                let found = format!("heights of type {:?}", shortened(other));
                return Err(refusal(found, "I, L, F or D"));
            }
        })
    }

    /// The values in the file of points.
    fn points(
        &mut self,
        archive: &mut Archive,
        folder: &str,
        kind: Kind,
        count: usize,
    ) -> Result<Vec<f64>, Refusal> {
        let link = self.needed(POINTS)?;
        let absent = || refusal(format!("no {:?} in the archive", shortened(link)), X3P);
        let (name, is_there) = find(archive, folder, link).ok_or_else(absent)?;
        if !is_there {
            self.defects.add(FileDefect::Link);
        }
        let need = count * kind.bytes();
        let bytes = part(archive, &name, need as u64)?;
        if bytes.len() < need {
            let found = format!("{} bytes of points", bytes.len());
            return Err(refusal(found, format!("{need} for its sizes and type")));
        }
        if bytes.len() > need {
            self.defects.add(FileDefect::LongData);
        }
        let values = bytes[..need].chunks_exact(kind.bytes());
        Ok(values.map(|bytes| kind.value(bytes)).collect())
    }

    /// Makes heights in m of the values.
    fn scale(&mut self, values: &mut [f64], kind: Kind) -> Result<(), Refusal> {
        let step = self.number(Z_STEP)?;
        let offset = self.number(Z_OFFSET)?.unwrap_or(0.0);
        let step = match step {
            Some(step) if kind.is_integer() => step,
            // A step of 0 is that of a writer that has none.
            Some(step) if step != 0.0 && step != 1.0 => {
                return Err(refusal(
                    format!(
                        "heights of a type with a decimal mark and an increment of z of {step}: two readings"
                    ),
                    "an increment of 1, or none",
                ));
            }
            Some(_) | None => 1.0,
        };
        for value in values {
            *value = *value * step + offset;
        }
        Ok(())
    }

    /// Makes points that are not valid no numbers.
    fn drop_invalid(
        &mut self,
        archive: &mut Archive,
        folder: &str,
        kind: Kind,
        values: &mut [f64],
    ) -> Result<(), Refusal> {
        let Some(link) = self.text(VALID) else {
            return Ok(());
        };
        let Some((name, is_there)) = find(archive, folder, link) else {
            // Whole numbers have no other way to be missing: what stands in their places is no height.
            if kind.is_integer() {
                let found = format!("no {:?} in the archive", shortened(link));
                return Err(refusal(found, "the valid points that main.xml names"));
            }
            self.defects.add(FileDefect::NoValidity);
            return Ok(());
        };
        if !is_there {
            self.defects.add(FileDefect::Link);
        }
        let need = values.len().div_ceil(8);
        let bits = part(archive, &name, need as u64)?;
        if bits.len() < need {
            let found = format!("{} bytes of valid points", bits.len());
            return Err(refusal(found, format!("{need}, a bit a point")));
        }
        for (n, value) in values.iter_mut().enumerate() {
            if bits[n / 8] >> (n % 8) & 1 == 0 {
                *value = f64::NAN;
            }
        }
        Ok(())
    }

    /// What the file says of unit and pixel.
    fn header(&mut self, columns: usize, rows: usize) -> Result<Header, Refusal> {
        let mut step = |place: &str| {
            let absent = || refusal(format!("no {place} in main.xml"), X3P);
            let step_m = self.number(place)?.ok_or_else(absent)?;
            Ok((
                step_m,
                format!("{place} of {} m in main.xml", short(step_m)),
            ))
        };
        Ok(Header::of_instrument(
            (1.0, "metres by the standard".to_owned()),
            [
                step("Record1/Axes/CX/Increment")?,
                step("Record1/Axes/CY/Increment")?,
            ],
            [columns, rows],
        ))
    }
}

/// A number as text; a comma may stand for the point.
fn number(text: &str, place: &str, defects: &mut FileDefects) -> Result<f64, Refusal> {
    if let Ok(value) = text.parse() {
        return Ok(value);
    }
    let value = text.replacen(',', ".", 1).parse();
    if value.is_ok() {
        defects.add(FileDefect::DecimalComma);
    }
    value.map_err(|_| refusal(format!("{place} is {:?}", shortened(text)), "a number"))
}
