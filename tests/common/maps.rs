//! Height maps written to files.

use std::fmt::Write as _;
use std::path::Path;

/// A matrix of heights, m.
pub(crate) struct Shape {
    pub(crate) columns: usize,
    pub(crate) rows: usize,
    pub(crate) heights_m: Vec<f64>,
}

impl Shape {
    pub(crate) fn new(columns: usize, rows: usize, z: impl Fn(usize, usize) -> f64) -> Self {
        Self {
            columns,
            rows,
            heights_m: (0..columns * rows)
                .map(|n| z(n % columns, n / columns))
                .collect(),
        }
    }
}

fn npy(path: &Path, descr: &str, shape: &Shape, data: &[u8]) {
    let mut header = format!(
        "{{'descr': '{descr}', 'fortran_order': False, 'shape': ({}, {}), }}",
        shape.rows, shape.columns
    );
    while (10 + header.len() + 1) % 64 != 0 {
        header.push(' ');
    }
    header.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend(data);
    std::fs::write(path, bytes).unwrap();
}

pub(crate) fn npy_f8(path: &Path, shape: &Shape) {
    let data: Vec<u8> = shape
        .heights_m
        .iter()
        .flat_map(|z| z.to_le_bytes())
        .collect();
    npy(path, "<f8", shape, &data);
}

pub(crate) fn npy_f4(path: &Path, shape: &Shape) {
    let data: Vec<u8> = shape
        .heights_m
        .iter()
        .flat_map(|&z| (z as f32).to_le_bytes())
        .collect();
    npy(path, "<f4", shape, &data);
}

pub(crate) fn csv(path: &Path, shape: &Shape, scale: f64) {
    let mut text = String::from("# heights\n");
    for row in shape.heights_m.chunks_exact(shape.columns) {
        let cells: Vec<String> = row.iter().map(|z| format!("{:e}", z * scale)).collect();
        writeln!(text, "{}", cells.join(", ")).unwrap();
    }
    std::fs::write(path, text).unwrap();
}
