//! numpy's archive: a zip file, nothing compressed, of `.npy` arrays (format 1.0, little-endian, C order).
//!
//! ```text
//! .npy   \x93NUMPY 1 0 | length of header, u16 | {'descr': '<f4', 'fortran_order': False, 'shape': (n, m), }
//!        padded with spaces to a multiple of 64 and a newline | values
//! .zip   local header, array, ... | central directory | end record        (PKWARE APPNOTE 6.3, sizes below 4 GB)
//! ```
//! The crate `npyz` was measured in its place: it would save 110 lines, and its archives bring 65 crates, 31 of them
//! new to this program (bzip2 and zstd in C among them), 55 CPU seconds of the first build.

use std::io::{Error, ErrorKind, Read, Result, Write};

use crc32fast::Hasher;

use super::fields::{ArrayValues, NumberKind};

/// An archive under construction.
pub(super) struct Npz<W> {
    out: W,
    at: u64,
    directory: Vec<u8>,
    members: u16,
}

impl<W: Write> Npz<W> {
    pub(super) fn new(out: W) -> Self {
        Self {
            out,
            at: 0,
            directory: Vec::new(),
            members: 0,
        }
    }

    /// Writes an array as a member. A shape that does not hold the values would be read as something else.
    pub(super) fn array(
        &mut self,
        name: &str,
        shape: &[usize],
        values: &ArrayValues,
    ) -> Result<()> {
        if shape.iter().product::<usize>() != values.len() {
            let count = values.len();
            let what = format!("{count} values do not fill an array of shape {shape:?}");
            return Err(Error::new(ErrorKind::InvalidInput, what));
        }
        let bytes = values.bytes();
        let mut checksum = Hasher::new();
        checksum.update(&bytes);
        let (length, mut bytes) = (bytes.len() as u64, &bytes[..]);
        self.array_of_file(name, shape, values.kind(), length, &checksum, &mut bytes)
    }

    /// The same of values that lie in a file, whose length and checksum are known.
    pub(super) fn array_of_file(
        &mut self,
        name: &str,
        shape: &[usize],
        kind: NumberKind,
        length: u64,
        checksum: &Hasher,
        values: &mut impl Read,
    ) -> Result<()> {
        let head = array_head(shape, kind);
        let mut whole = Hasher::new();
        whole.update(&head);
        whole.combine(checksum);
        let size = head.len() as u64 + length;
        self.member_head(&format!("{name}.npy"), size, whole.finalize())?;
        self.put(&head)?;
        let copied = std::io::copy(values, &mut self.out)?;
        self.at += copied;
        if copied == length {
            Ok(())
        } else {
            Err(Error::from(ErrorKind::UnexpectedEof))
        }
    }

    /// Writes what comes before a member, and takes it up into the directory.
    fn member_head(&mut self, name: &str, size: u64, checksum: u32) -> Result<()> {
        let too_long = |_| Error::new(ErrorKind::InvalidInput, "an archive of 4 GB and more");
        let size = u32::try_from(size).map_err(too_long)?;
        let offset = u32::try_from(self.at).map_err(too_long)?;
        let mut common = Vec::with_capacity(26);
        // Version 2.0, no flags, stored, 1980-01-01 (files are reproducible), checksum, sizes, lengths.
        for field in [20_u16, 0, 0, 0, 0x21] {
            common.extend(field.to_le_bytes());
        }
        for field in [checksum, size, size] {
            common.extend(field.to_le_bytes());
        }
        for field in [name.len() as u16, 0] {
            common.extend(field.to_le_bytes());
        }
        self.put(b"PK\x03\x04")?;
        self.put(&common)?;
        self.put(name.as_bytes())?;
        self.directory.extend_from_slice(b"PK\x01\x02\x14\x00");
        self.directory.extend_from_slice(&common);
        // No comment, first disk, no attributes.
        self.directory.extend_from_slice(&[0; 10]);
        self.directory.extend(offset.to_le_bytes());
        self.directory.extend_from_slice(name.as_bytes());
        self.members += 1;
        Ok(())
    }

    fn put(&mut self, bytes: &[u8]) -> Result<()> {
        self.at += bytes.len() as u64;
        self.out.write_all(bytes)
    }

    /// Writes the directory; the bytes of the whole archive.
    pub(super) fn finish(mut self) -> Result<u64> {
        let (start, length) = (self.at as u32, self.directory.len() as u32);
        let directory = std::mem::take(&mut self.directory);
        self.put(&directory)?;
        let mut end = b"PK\x05\x06\0\0\0\0".to_vec();
        for count in [self.members, self.members] {
            end.extend(count.to_le_bytes());
        }
        for field in [length, start] {
            end.extend(field.to_le_bytes());
        }
        end.extend_from_slice(&[0, 0]);
        self.put(&end)?;
        self.out.flush()?;
        Ok(self.at)
    }
}

/// What stands before an array's values.
fn array_head(shape: &[usize], kind: NumberKind) -> Vec<u8> {
    let kind = match kind {
        NumberKind::F32 => "<f4",
        NumberKind::F64 => "<f8",
        NumberKind::U8 => "|u1",
    };
    let shape = shape
        .iter()
        .fold(String::new(), |text, n| text + &n.to_string() + ", ");
    let mut header = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({shape}), }}");
    // Magic, version and length take ten bytes, the newline one.
    while !(header.len() + 11).is_multiple_of(64) {
        header.push(' ');
    }
    header.push('\n');
    let mut head = b"\x93NUMPY\x01\x00".to_vec();
    head.extend_from_slice(&(header.len() as u16).to_le_bytes());
    head.extend_from_slice(header.as_bytes());
    head
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrays_lie_where_their_headers_say() {
        let mut bytes = Vec::new();
        let mut npz = Npz::new(&mut bytes);
        let p = ArrayValues::F32(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.5]);
        assert!(npz.array("p", &[2, 3], &p).is_ok());
        let t = ArrayValues::F64(vec![0.25].into());
        assert!(npz.array("t", &[], &t).is_ok());
        let c = npz.array("c", &[2], &ArrayValues::U8(&[7]));
        assert!(c.is_err(), "one value is missing");
        let length = npz.finish().unwrap_or(0);
        assert_eq!(length, bytes.len() as u64);
        let header = 30 + "p.npy".len();
        assert_eq!(&bytes[..4], b"PK\x03\x04");
        assert_eq!(&bytes[header..header + 6], b"\x93NUMPY");
        let text = String::from_utf8_lossy(&bytes[header + 10..header + 128]).into_owned();
        assert!(
            text.contains("'descr': '<f4'") && text.contains("'shape': (2, 3, )"),
            "{text}"
        );
        let values = header + 128;
        assert_eq!(&bytes[values + 20..values + 24], &5.5_f32.to_le_bytes());
        assert_eq!(&bytes[values + 24..values + 28], b"PK\x03\x04");
        // The end record: two members, and the directory where it says.
        let end = &bytes[bytes.len() - 22..];
        assert_eq!((&end[..4], end[10]), (&b"PK\x05\x06"[..], 2));
        let start = u32::from_le_bytes([end[16], end[17], end[18], end[19]]) as usize;
        assert_eq!(&bytes[start..start + 4], b"PK\x01\x02");
    }
}
