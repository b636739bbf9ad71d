//! Fields as ParaView and other programs of VTK open them: the surface as an image (`.vti`), the plane below it, whose depths
//! are not evenly spaced, as a rectilinear grid (`.vtr`).
//!
//! ```text
//! XML that says which array lies where | _ | length of an array, u64 | values | length | values ...    little-endian
//! ```
//! Lengths are m; the plane below the surface lies at y = 0, and z points into the body. Scalars are data of the file.
//! Source: VTK file formats, XML with appended raw data.

use std::fmt::Write as _;
use std::io::{Result, Write};

use super::fields::{ArrayValues, FieldArray, arrays};
use asperity_engine::sim::{Frame, StressSlice};

/// A file's arrays: how they are announced, and their bytes.
#[derive(Default)]
struct Appended {
    announced: String,
    bytes: Vec<u8>,
}

impl Appended {
    /// Adds an array; what is counted stands in `count`.
    fn push(&mut self, name: &str, count: &str, values: &ArrayValues) {
        let kind = match values {
            ArrayValues::F32(_) => "Float32",
            ArrayValues::F64(_) => "Float64",
            ArrayValues::U8(_) => "UInt8",
        };
        let bytes = values.bytes();
        // Writing to a string cannot fail.
        let _ = writeln!(
            self.announced,
            "<DataArray type=\"{kind}\" Name=\"{name}\" {count} format=\"appended\" offset=\"{}\"/>",
            self.bytes.len()
        );
        self.bytes.extend((bytes.len() as u64).to_le_bytes());
        self.bytes.extend(bytes);
    }

    /// What was announced since the last time.
    fn take(&mut self) -> String {
        std::mem::take(&mut self.announced)
    }
}

/// The fields of the surface as an image; its bytes.
pub(super) fn write_surface(out: impl Write, frame: &Frame) -> Result<u64> {
    let extent = format!("0 {} 0 {} 0 0", frame.nx - 1, frame.ny - 1);
    let spread = format!(
        "WholeExtent=\"{extent}\" Origin=\"{} {} 0\" Spacing=\"{} {} 1\"",
        frame.x_min_m, frame.y_min_m, frame.dx_m, frame.dy_m
    );
    let mut data = Appended::default();
    let scalars = scalars(&mut data, frame);
    let fields = fields(&mut data, frame, &["y", "x"]);
    let grid = format!(
        "<ImageData {spread}>\n{scalars}<Piece Extent=\"{extent}\">\n{fields}</Piece>\n</ImageData>"
    );
    write_file(out, "ImageData", &grid, &data.bytes)
}

/// The fields of the plane below the surface; its bytes.
pub(super) fn write_slice(out: impl Write, frame: &Frame, slice: &StressSlice) -> Result<u64> {
    let depths = &slice.depths_m;
    let extent = format!("0 {} 0 0 0 {}", frame.nx - 1, depths.len().max(1) - 1);
    let mut data = Appended::default();
    let scalars = scalars(&mut data, frame);
    let fields = fields(&mut data, frame, &["depth", "x"]);
    let x = (0..frame.nx).map(|i| frame.x_min_m + frame.dx_m * i as f64);
    data.push("x_m", "", &ArrayValues::F64(x.collect()));
    data.push("y_m", "", &ArrayValues::F64(vec![0.0].into()));
    data.push("z_m", "", &ArrayValues::F64((&**depths).into()));
    let places = data.take();
    let grid = format!(
        "<RectilinearGrid WholeExtent=\"{extent}\">\n{scalars}<Piece Extent=\"{extent}\">\n{fields}\
         <Coordinates>\n{places}</Coordinates>\n</Piece>\n</RectilinearGrid>"
    );
    write_file(out, "RectilinearGrid", &grid, &data.bytes)
}

/// Every scalar that is known.
fn scalars(data: &mut Appended, frame: &Frame) -> String {
    for FieldArray { name, axes, values } in arrays(frame) {
        if axes.is_empty() {
            data.push(name, "NumberOfTuples=\"1\"", &values);
        }
    }
    format!("<FieldData>\n{}</FieldData>\n", data.take())
}

/// The fields over these axes.
fn fields(data: &mut Appended, frame: &Frame, over: &[&str]) -> String {
    for FieldArray { name, axes, values } in arrays(frame) {
        if axes == over {
            data.push(name, "", &values);
        }
    }
    format!("<PointData>\n{}</PointData>\n", data.take())
}

fn write_file(mut out: impl Write, kind: &str, grid: &str, data: &[u8]) -> Result<u64> {
    let head = format!(
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"{kind}\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n\
         {grid}\n<AppendedData encoding=\"raw\">\n_"
    );
    let tail = "\n</AppendedData>\n</VTKFile>\n";
    out.write_all(head.as_bytes())?;
    out.write_all(data)?;
    out.write_all(tail.as_bytes())?;
    out.flush()?;
    Ok((head.len() + data.len() + tail.len()) as u64)
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "tests")]
    use super::*;

    /// The values that a file announces under a name.
    fn values<const N: usize>(file: &[u8], name: &str) -> Vec<[u8; N]> {
        let text = String::from_utf8_lossy(file);
        let line = text
            .lines()
            .find(|line| line.contains(&format!("Name=\"{name}\"")));
        let offset = line.unwrap().split("offset=\"").nth(1).unwrap();
        let offset: usize = offset.split('"').next().unwrap().parse().unwrap();
        let mark = b"encoding=\"raw\">\n_";
        let start = file.windows(mark.len()).position(|window| window == mark);
        let data = &file[start.unwrap() + mark.len() + offset..];
        let length = u64::from_le_bytes(data[..8].try_into().unwrap()) as usize;
        let (chunks, rest) = data[8..8 + length].as_chunks::<N>();
        assert!(rest.is_empty());
        chunks.to_vec()
    }

    #[test]
    fn arrays_lie_where_the_head_says() {
        let frame = Frame {
            nx: 3,
            ny: 2,
            x_min_m: -1e-3,
            dx_m: 1e-3,
            dy_m: 5e-4,
            pressure_pa: vec![0.0, 1.0, 2.0, 3.0, 4.0, 5.5e9],
            contact: vec![0, 0, 0, 0, 1, 0],
            slice: Some(StressSlice {
                depths_m: vec![0.0, 1e-4].into(),
                effective_pa: vec![9.0; 6],
                tau_xz_pa: vec![-1.0; 6],
            }),
            ..Frame::default()
        };
        let (mut surface, mut slice) = (Vec::new(), Vec::new());
        let written = write_surface(&mut surface, &frame).unwrap();
        assert_eq!(written, surface.len() as u64);
        assert!(write_slice(&mut slice, &frame, frame.slice.as_ref().unwrap()).unwrap() > 0);
        let head = String::from_utf8_lossy(&surface);
        assert!(head.contains(
            "WholeExtent=\"0 2 0 1 0 0\" Origin=\"-0.001 0 0\" Spacing=\"0.001 0.0005 1\""
        ));
        assert_eq!(
            values::<4>(&surface, "pressure_pa")[5],
            5.5e9_f32.to_le_bytes()
        );
        assert_eq!(
            values::<1>(&surface, "contact"),
            [[0], [0], [0], [0], [1], [0]]
        );
        assert_eq!(values::<8>(&slice, "z_m")[1], 1e-4_f64.to_le_bytes());
        assert_eq!(
            values::<4>(&slice, "slice_tau_xz_pa"),
            [(-1.0_f32).to_le_bytes(); 6]
        );
        assert!(!head.contains("slice_"));
    }
}
