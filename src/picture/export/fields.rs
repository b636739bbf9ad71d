//! The arrays of a step, for every format that holds arrays: named as the frame's fields, units in the names, SI.

use std::borrow::Cow;
use std::io::{Result, Write};

use super::npz::Npz;
use asperity_engine::sim::{CATALOGUE, Frame};

/// Numbers of an array.
pub(super) enum ArrayValues<'a> {
    F32(&'a [f32]),
    F64(Cow<'a, [f64]>),
    U8(&'a [u8]),
}

/// What kind of numbers an array has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum NumberKind {
    F32,
    F64,
    U8,
}

impl ArrayValues<'_> {
    pub(super) fn kind(&self) -> NumberKind {
        match self {
            Self::F32(_) => NumberKind::F32,
            Self::F64(_) => NumberKind::F64,
            Self::U8(_) => NumberKind::U8,
        }
    }

    pub(super) fn len(&self) -> usize {
        match self {
            Self::F32(all) => all.len(),
            Self::F64(all) => all.len(),
            Self::U8(all) => all.len(),
        }
    }

    /// Little-endian.
    pub(super) fn bytes(&self) -> Vec<u8> {
        match self {
            Self::F32(all) => all.iter().flat_map(|value| value.to_le_bytes()).collect(),
            Self::F64(all) => all.iter().flat_map(|value| value.to_le_bytes()).collect(),
            Self::U8(all) => all.to_vec(),
        }
    }
}

/// An array: its name, its axes from the slowest to the fastest, and its numbers.
pub(super) struct FieldArray<'a> {
    pub(super) name: &'static str,
    pub(super) axes: &'static [&'static str],
    pub(super) values: ArrayValues<'a>,
}

impl FieldArray<'_> {
    /// A single number.
    pub(super) fn number(name: &'static str, value: f64) -> Self {
        Self {
            name,
            axes: &[],
            values: ArrayValues::F64(vec![value].into()),
        }
    }
}

/// All arrays of a frame: every scalar that is known, the nodes, the fields, the slice.
pub(super) fn arrays(frame: &Frame) -> Vec<FieldArray<'_>> {
    let array = |name, axes, values| FieldArray { name, axes, values };
    let known = CATALOGUE.iter().filter_map(|quantity| {
        let value = quantity.number(frame)?;
        Some(FieldArray::number(quantity.name, value))
    });
    let mut all: Vec<FieldArray> = known.collect();
    let nodes = |n: usize, first: f64, step: f64| {
        let nodes: Vec<f64> = (0..n).map(|k| first + step * k as f64).collect();
        ArrayValues::F64(nodes.into())
    };
    all.push(array(
        "x_m",
        &["x"],
        nodes(frame.nx, frame.x_min_m, frame.dx_m),
    ));
    all.push(array(
        "y_m",
        &["y"],
        nodes(frame.ny, frame.y_min_m, frame.dy_m),
    ));
    for (name, field) in [
        ("pressure_pa", &frame.pressure_pa),
        ("film_m", &frame.film_m),
        ("roughness_1_m", &frame.roughness_1_m),
        ("roughness_2_m", &frame.roughness_2_m),
        ("traction_on_body_1_pa", &frame.traction_pa),
    ] {
        all.push(array(name, &["y", "x"], ArrayValues::F32(field)));
    }
    for (name, field) in [
        ("surface_rise_1_k", &frame.surface_rise_k[0]),
        ("surface_rise_2_k", &frame.surface_rise_k[1]),
        ("film_rise_k", &frame.film_rise_k),
    ] {
        if !field.is_empty() {
            all.push(array(name, &["y", "x"], ArrayValues::F32(field)));
        }
    }
    all.push(array(
        "contact",
        &["y", "x"],
        ArrayValues::U8(&frame.contact),
    ));
    if let Some(slice) = &frame.slice {
        let depths = ArrayValues::F64((&*slice.depths_m).into());
        all.push(array("slice_depths_m", &["depth"], depths));
        for (name, field) in [
            ("slice_effective_pa", &slice.effective_pa),
            ("slice_tau_xz_pa", &slice.tau_xz_pa),
        ] {
            all.push(array(name, &["depth", "x"], ArrayValues::F32(field)));
        }
    }
    all
}

/// Length of an axis in a frame.
pub(super) fn length(frame: &Frame, axis: &str) -> usize {
    match axis {
        "x" => frame.nx,
        "y" => frame.ny,
        _ => frame.slice.as_ref().map_or(0, |slice| slice.depths_m.len()),
    }
}

/// A frame as numpy's archive; its bytes.
pub(super) fn write_npz(out: impl Write, frame: &Frame) -> Result<u64> {
    let mut npz = Npz::new(out);
    for FieldArray { name, axes, values } in arrays(frame) {
        let shape: Vec<usize> = axes.iter().map(|axis| length(frame, axis)).collect();
        npz.array(name, &shape, &values)?;
    }
    npz.finish()
}
