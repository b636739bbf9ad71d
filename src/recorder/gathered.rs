//! Numbers of many rows one after another, which become a chunk as they lie.
//!
//! Row by row the library makes an array of each, keeps it, and at last copies all of them into one. Maps and
//! sheets are what a recording is made of, so theirs are written to where the chunk takes them from.

use std::sync::Arc;

use rerun::external::arrow::array::{ArrayRef, FixedSizeListArray, Float32Array, ListArray};
use rerun::external::arrow::array::{UInt8Array, UInt32Array};
use rerun::external::arrow::buffer::{Buffer, OffsetBuffer, ScalarBuffer};
use rerun::external::arrow::datatypes::{ArrowNativeType, DataType, Field};
use rerun::log::{Chunk, ChunkError, ChunkId};
use rerun::{ComponentDescriptor, EntityPath, LineStrips2D, Mesh3D, SerializedComponentColumn};

use super::colour::packed;
use super::moment::{Moment, time_columns};
use super::weight::{Compression, TEXT};

/// What a row adds.
#[derive(Debug, Clone, Copy)]
pub(super) struct Added {
    /// Bytes in memory.
    pub(super) bytes: usize,
    /// What they will take of the finished file.
    pub(super) weight: f64,
}

/// Values, and where each row ends.
#[derive(Debug)]
struct GatheredColumn<T> {
    values: Vec<T>,
    ends: Vec<usize>,
    /// What was taken last: its memory is used again once nobody else holds it. New memory costs as much as
    /// filling it.
    taken: Option<Buffer>,
}

impl<T> Default for GatheredColumn<T> {
    fn default() -> Self {
        Self {
            values: Vec::new(),
            ends: Vec::new(),
            taken: None,
        }
    }
}

impl<T: ArrowNativeType> GatheredColumn<T> {
    /// The values to add a row to; `end_row` afterwards.
    fn values(&mut self) -> &mut Vec<T> {
        if let Some(mut values) = self.taken.take().and_then(|taken| taken.into_vec().ok()) {
            values.clear();
            self.values = values;
        }
        &mut self.values
    }

    fn end_row(&mut self) {
        self.ends.push(self.values.len());
    }

    /// The values' bytes and the ends of the rows.
    fn take(&mut self) -> (Buffer, Vec<usize>) {
        let values = Buffer::from_vec(std::mem::take(&mut self.values));
        self.taken = Some(values.clone());
        (values, std::mem::take(&mut self.ends))
    }
}

/// What is gathered for one entity.
#[derive(Debug)]
struct GatheredRows {
    entity: EntityPath,
    moments: Vec<Moment>,
}

impl GatheredRows {
    fn of(entity: EntityPath) -> Self {
        Self {
            entity,
            moments: Vec::new(),
        }
    }

    fn chunk(&mut self, columns: Vec<SerializedComponentColumn>) -> Result<Chunk, ChunkError> {
        let moments = std::mem::take(&mut self.moments);
        chunk_of(self.entity.clone(), &moments, columns)
    }
}

/// Rows of an entity as a chunk.
pub(super) fn chunk_of(
    entity: EntityPath,
    moments: &[Moment],
    columns: impl IntoIterator<Item = SerializedComponentColumn>,
) -> Result<Chunk, ChunkError> {
    let times = time_columns(moments).into_iter();
    let columns = columns.into_iter();
    Chunk::from_auto_row_ids(
        ChunkId::new(),
        entity,
        times.map(|time| (*time.timeline().name(), time)).collect(),
        columns
            .map(|column| (column.descriptor, column.list_array))
            .collect(),
    )
}

/// Pictures of one entity: pixels of one or two bytes.
#[derive(Debug)]
pub(super) struct Images<T> {
    rows: GatheredRows,
    buffer: ComponentDescriptor,
    pixels: GatheredColumn<T>,
    density: Compression,
}

impl<T: ArrowNativeType> Images<T> {
    /// Of an entity, in that component.
    pub(super) fn new(entity: EntityPath, buffer: ComponentDescriptor) -> Self {
        Self {
            rows: GatheredRows::of(entity),
            buffer,
            pixels: GatheredColumn::default(),
            density: Compression::default(),
        }
    }

    /// Adds a picture.
    pub(super) fn push(&mut self, at: Moment, fill: impl FnOnce(&mut Vec<T>)) -> Added {
        self.rows.moments.push(at);
        let pixels = self.pixels.values();
        let before = pixels.len();
        fill(pixels);
        self.pixels.end_row();
        let row = &self.pixels.values[before..];
        Added {
            bytes: size_of_val(row),
            weight: self.density.weigh(row),
        }
    }

    /// Takes what is there as a chunk.
    pub(super) fn take(&mut self) -> Option<Result<Chunk, ChunkError>> {
        let rows = self.rows.moments.len();
        if rows == 0 {
            return None;
        }
        let (bytes, ends) = self.pixels.take();
        let ends: Vec<usize> = ends.into_iter().map(|end| end * size_of::<T>()).collect();
        let length = bytes.len();
        let bytes = UInt8Array::new(ScalarBuffer::new(bytes, 0, length), None);
        // A list of one blob for each row.
        let blobs = list(Arc::new(bytes), &ends, Nullable::No);
        let each: Vec<usize> = (1..=rows).collect();
        let blobs = list(Arc::new(blobs), &each, Nullable::Yes);
        let column = SerializedComponentColumn::new(blobs, self.buffer.clone());
        Some(self.rows.chunk(vec![column]))
    }
}

/// Updates of a mesh: colours, and positions where they change too.
#[derive(Debug)]
pub(super) struct Sheets {
    rows: GatheredRows,
    /// x, y and z of each vertex; none for a mesh that stays where it is.
    positions: GatheredColumn<f32>,
    colours: GatheredColumn<u32>,
    densities: [Compression; 2],
}

impl Sheets {
    /// Of an entity.
    pub(super) fn new(entity: EntityPath) -> Self {
        Self {
            rows: GatheredRows::of(entity),
            positions: GatheredColumn::default(),
            colours: GatheredColumn::default(),
            densities: Default::default(),
        }
    }

    /// Adds an update. All of an entity's either have positions or have none.
    pub(super) fn push(
        &mut self,
        at: Moment,
        fill: impl FnOnce(&mut Vec<f32>, &mut Vec<u32>),
    ) -> Added {
        self.rows.moments.push(at);
        let (positions, colours) = (self.positions.values(), self.colours.values());
        let before = (positions.len(), colours.len());
        fill(positions, colours);
        self.positions.end_row();
        self.colours.end_row();
        let positions = &self.positions.values[before.0..];
        let colours = &self.colours.values[before.1..];
        let [of_positions, of_colours] = &mut self.densities;
        Added {
            bytes: size_of_val(positions) + size_of_val(colours),
            weight: of_positions.weigh(positions) + of_colours.weigh(colours),
        }
    }

    /// Takes what is there as a chunk.
    pub(super) fn take(&mut self) -> Option<Result<Chunk, ChunkError>> {
        if self.rows.moments.is_empty() {
            return None;
        }
        let (numbers, ends) = self.colours.take();
        let mut columns = vec![SerializedComponentColumn::new(
            list(colours(numbers), &ends, Nullable::Yes),
            Mesh3D::descriptor_vertex_colors(),
        )];
        let (numbers, ends) = self.positions.take();
        if !numbers.is_empty() {
            let ends: Vec<usize> = ends.into_iter().map(|end| end / 3).collect();
            columns.push(SerializedComponentColumn::new(
                list(points(numbers, 3), &ends, Nullable::Yes),
                Mesh3D::descriptor_vertex_positions(),
            ));
        }
        Some(self.rows.chunk(columns))
    }
}

/// Curves of one entity in a plot.
#[derive(Debug)]
pub(super) struct Strips {
    rows: GatheredRows,
    pen: LineStyle,
    /// Curves up to the end of each row.
    ends: Vec<usize>,
    density: Compression,
}

/// Draws curves.
#[derive(Debug)]
pub(super) struct LineStyle {
    /// x and y of each point; a row for each curve.
    points: GatheredColumn<f32>,
    /// Of each curve, where they change; a row for each moment.
    colours: GatheredColumn<u32>,
}

impl LineStyle {
    /// Goes on to a point.
    pub(super) fn to(&mut self, at: [f32; 2]) {
        self.points.values.extend_from_slice(&at);
    }

    /// Ends a curve; a single point is none.
    pub(super) fn lift(&mut self) {
        let from = self.points.ends.last().copied().unwrap_or(0);
        if self.points.values.len() > from + 2 {
            self.points.end_row();
        } else {
            self.points.values.truncate(from);
        }
    }

    /// Gives a curve its colour: all of an entity's have one, or none.
    pub(super) fn tint(&mut self, rgb: [u8; 3]) {
        self.colours.values.push(packed(rgb));
    }

    /// A whole curve.
    pub(super) fn draw(&mut self, curve: &[[f32; 2]]) {
        self.points.values.extend(curve.iter().flatten());
        self.lift();
    }
}

impl Strips {
    /// Of an entity.
    pub(super) fn new(entity: EntityPath) -> Self {
        Self {
            rows: GatheredRows::of(entity),
            pen: LineStyle {
                points: GatheredColumn::default(),
                colours: GatheredColumn::default(),
            },
            ends: Vec::new(),
            density: Compression::default(),
        }
    }

    /// Adds the curves of a moment.
    pub(super) fn push(&mut self, at: Moment, fill: impl FnOnce(&mut LineStyle)) -> Added {
        let before = (
            self.pen.points.values().len(),
            self.pen.colours.values().len(),
        );
        self.rows.moments.push(at);
        fill(&mut self.pen);
        self.pen.lift();
        self.ends.push(self.pen.points.ends.len());
        self.pen.colours.end_row();
        let row = &self.pen.points.values[before.0..];
        let colours = size_of_val(&self.pen.colours.values[before.1..]);
        Added {
            bytes: size_of_val(row) + colours,
            weight: self.density.weigh(row) + TEXT * colours as f64,
        }
    }

    /// Takes what is there as a chunk.
    pub(super) fn take(&mut self) -> Option<Result<Chunk, ChunkError>> {
        if self.rows.moments.is_empty() {
            return None;
        }
        let (numbers, ends) = self.pen.points.take();
        let ends: Vec<usize> = ends.into_iter().map(|end| end / 2).collect();
        let curves = list(points(numbers, 2), &ends, Nullable::No);
        let rows = std::mem::take(&mut self.ends);
        let mut columns = vec![SerializedComponentColumn::new(
            list(Arc::new(curves), &rows, Nullable::Yes),
            LineStrips2D::descriptor_strips(),
        )];
        let (numbers, ends) = self.pen.colours.take();
        if !numbers.is_empty() {
            columns.push(SerializedComponentColumn::new(
                list(colours(numbers), &ends, Nullable::Yes),
                LineStrips2D::descriptor_colors(),
            ));
        }
        Some(self.rows.chunk(columns))
    }
}

/// Colours as the library has them.
fn colours(numbers: Buffer) -> ArrayRef {
    let length = numbers.len() / size_of::<u32>();
    Arc::new(UInt32Array::new(
        ScalarBuffer::new(numbers, 0, length),
        None,
    ))
}

/// Points of two or three numbers.
fn points(numbers: Buffer, dimensions: i32) -> ArrayRef {
    let length = numbers.len() / size_of::<f32>();
    let numbers = Float32Array::new(ScalarBuffer::new(numbers, 0, length), None);
    let item = Arc::new(Field::new("item", DataType::Float32, false));
    Arc::new(FixedSizeListArray::new(
        item,
        dimensions,
        Arc::new(numbers),
        None,
    ))
}

/// Whether a list may leave out items, as the library's outer lists may and its blobs may not.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Nullable {
    Yes,
    No,
}

/// Lists of values that end there.
fn list(values: ArrayRef, ends: &[usize], nullable: Nullable) -> ListArray {
    let starts = std::iter::once(0).chain(ends.iter().copied());
    let lengths = ends.iter().zip(starts).map(|(end, start)| end - start);
    let offsets = OffsetBuffer::<i32>::from_lengths(lengths);
    let kind = values.data_type().clone();
    let item = Arc::new(Field::new("item", kind, nullable == Nullable::Yes));
    ListArray::new(item, offsets, values, None)
}

#[cfg(test)]
mod tests {
    use rerun::{AsComponents as _, Color, SegmentationImage};

    use super::*;

    fn entity() -> EntityPath {
        EntityPath::from("there")
    }

    fn moment(step: u64) -> Moment {
        Moment::new(step, 1e-3 * step as f64, 0.1 * step as f64)
    }

    #[test]
    fn pictures_are_those_that_the_library_would_make() {
        let pictures: [&[u16]; 3] = [&[1, 0x203, 65535], &[7], &[0, 9]];
        let component = SegmentationImage::descriptor_buffer();
        let mut images = Images::new(entity(), component.clone());
        for (step, picture) in (1..).zip(pictures) {
            let added = images.push(moment(step), |pixels| {
                pixels.extend(picture.iter().map(|pixel| pixel.to_le()));
            });
            assert_eq!(added.bytes, 2 * picture.len());
        }
        let chunk = images.take().expect("pictures").expect("a chunk");
        assert_eq!((chunk.num_rows(), chunk.timelines().len()), (3, 3));
        for (row, picture) in pictures.iter().enumerate() {
            let bytes: Vec<u8> = picture.iter().flat_map(|p| p.to_le_bytes()).collect();
            let theirs = SegmentationImage::update_fields()
                .with_buffer(rerun::components::ImageBuffer::from(bytes))
                .as_serialized_batches();
            let ours = chunk.component_batch_raw(component.component, row);
            let ours = ours.expect("a row").expect("a value");
            assert_eq!(*ours, *theirs[0].array);
        }
        assert!(images.take().is_none());
        // The next chunk is made in other memory as long as somebody holds the first, then in the same.
        let mut held = Some(chunk);
        for same in [false, true] {
            let room = images.pixels.taken.as_ref().map(Buffer::as_ptr);
            images.push(moment(4), |pixels| pixels.extend([5, 6]));
            assert_eq!(Some(images.pixels.values.as_ptr().cast()) == room, same);
            held = None;
            drop(images.take());
        }
        assert!(held.is_none());
    }

    #[test]
    fn curves_are_those_that_the_library_would_make() {
        const RGB: [[u8; 3]; 2] = [[1, 2, 3], [250, 128, 0]];
        let curve = [[0.0, 1.0], [0.5, -1.0], [2.0, 0.25]];
        let rows: [&[&[[f32; 2]]]; 3] = [&[&curve, &curve[1..]], &[], &[&curve[..2]]];
        let mut strips = Strips::new(entity());
        for (step, row) in (1..).zip(rows) {
            strips.push(moment(step), |pen| {
                for (curve, rgb) in row.iter().zip(RGB) {
                    pen.draw(curve);
                    pen.tint(rgb);
                    // No curve.
                    pen.draw(&curve[..1]);
                }
            });
        }
        let chunk = strips.take().expect("curves").expect("a chunk");
        for (row, curves) in rows.into_iter().enumerate() {
            let theirs = LineStrips2D::update_fields()
                .with_strips(curves.iter().map(|curve| curve.to_vec()))
                .with_colors(RGB.into_iter().take(curves.len()).map(Color::from));
            for batch in theirs.as_serialized_batches() {
                let ours = chunk.component_batch_raw(batch.descriptor.component, row);
                let ours = ours.expect("a row").expect("a value");
                assert_eq!(*ours, *batch.array, "{}", batch.descriptor);
            }
        }
        assert!(strips.take().is_none());
    }

    #[test]
    fn sheets_are_those_that_the_library_would_make() {
        let points = [[0.0, -1.5, 2.25], [3.0, 4.0, f32::MIN_POSITIVE]];
        let colours = [[1, 2, 3], [250, 128, 0]];
        let theirs = Mesh3D::update_fields()
            .with_vertex_positions(points)
            .with_vertex_colors(colours);
        let mut sheets = Sheets::new(entity());
        for step in 1..=2 {
            sheets.push(moment(step), |out, tints| {
                out.extend(points.iter().flatten());
                tints.extend(colours.iter().map(|&rgb| super::super::colour::packed(rgb)));
            });
        }
        let chunk = sheets.take().expect("sheets").expect("a chunk");
        for row in 0..2 {
            for batch in theirs.as_serialized_batches() {
                let ours = chunk.component_batch_raw(batch.descriptor.component, row);
                let ours = ours.expect("a row").expect("a value");
                assert_eq!(*ours, *batch.array, "{}", batch.descriptor);
            }
        }
    }
}
