//! Sheets of triangles over a window of the frame's grid: the parts of the 3-D view.

use std::sync::Arc;

use rerun::external::arrow::array::{FixedSizeListArray, Float32Array, UInt32Array};
use rerun::external::arrow::datatypes::{DataType, Field};
use rerun::{Mesh3D, SerializedComponentBatch};

use super::colour::hillshade;
use super::geometry::Geometry;

/// Most columns and rows of the film's sheet: what a screen shows, few enough to keep files small.
pub(super) const FINE: [usize; 2] = [96, 24];
/// Of the bodies' sheets, which only give the picture its frame.
pub(super) const COARSE: [usize; 2] = [48, 24];

/// Every so-many-th node of a window of the grid: from the plane y = 0 backwards (the front half is
/// cut away), around the contact in x.
#[derive(Debug, Clone)]
pub(super) struct Window {
    nodes: Vec<usize>,
    xy: Vec<[f32; 2]>,
    columns: usize,
    rows: usize,
    spacing: [f32; 2],
}

impl Window {
    /// The window |x| ≤ `reach_x`, 0 ≤ y ≤ `reach_y`; `None` if it holds no whole cell.
    pub(super) fn new(
        g: Geometry,
        [reach_x, reach_y]: [f64; 2],
        [most_columns, most_rows]: [usize; 2],
    ) -> Option<Self> {
        let inside_x: Vec<usize> = (0..g.nx).filter(|&i| g.x(i).abs() <= reach_x).collect();
        let inside_y: Vec<usize> = (g.centre_row()..g.ny)
            .filter(|&j| g.y(j) <= reach_y)
            .collect();
        let step_i = inside_x.len().div_ceil(most_columns).max(1);
        let step_j = inside_y.len().div_ceil(most_rows).max(1);
        let columns: Vec<usize> = inside_x.into_iter().step_by(step_i).collect();
        let rows: Vec<usize> = inside_y.into_iter().step_by(step_j).collect();
        if columns.len() < 2 || rows.len() < 2 {
            return None;
        }
        let mut nodes = Vec::with_capacity(columns.len() * rows.len());
        let mut xy = Vec::with_capacity(nodes.capacity());
        for &j in &rows {
            for &i in &columns {
                nodes.push(j * g.nx + i);
                xy.push([g.x(i) as f32, g.y(j) as f32]);
            }
        }
        Some(Self {
            nodes,
            xy,
            columns: columns.len(),
            rows: rows.len(),
            spacing: [(g.dx * step_i as f64) as f32, (g.dy * step_j as f64) as f32],
        })
    }

    /// Nodes of the frame's grid, row by row.
    pub(super) fn nodes(&self) -> &[usize] {
        &self.nodes
    }

    /// x and y of the nodes.
    pub(super) fn xy(&self) -> &[[f32; 2]] {
        &self.xy
    }

    /// The sheet's triangles.
    pub(super) fn triangles(&self) -> Vec<[u32; 3]> {
        triangles(self.columns, self.rows)
    }

    /// How bright each node of a sheet with these heights is lit.
    pub(super) fn shades(&self, heights: &[f32]) -> Vec<f32> {
        let slope = |low: usize, high: usize, nodes: usize, spacing: f32| {
            (heights[high] - heights[low]) / (spacing * nodes.max(1) as f32)
        };
        (0..heights.len())
            .map(|at| {
                let (i, j) = (at % self.columns, at / self.columns);
                let left = at - usize::from(i > 0);
                let right = at + usize::from(i + 1 < self.columns);
                let front = at - self.columns * usize::from(j > 0);
                let back = at + self.columns * usize::from(j + 1 < self.rows);
                hillshade(
                    slope(left, right, right - left, self.spacing[0]),
                    slope(front, back, (back - front) / self.columns, self.spacing[1]),
                )
            })
            .collect()
    }

    /// Positions and colours of a sheet with these heights.
    pub(super) fn sheet(&self, heights: &[f32], colours: &[[u8; 3]]) -> Mesh3D {
        let positions = self.xy.iter().zip(heights).map(|(&[x, y], &z)| [x, y, z]);
        Mesh3D {
            vertex_positions: Some(positions_of(positions)),
            ..coloured(colours.iter().copied())
        }
    }
}

/// Positions as the library stores them. Its own way there takes every number through an optional value and three
/// vectors: half of what recording a sheet would cost.
fn positions_of(positions: impl Iterator<Item = [f32; 3]>) -> SerializedComponentBatch {
    let numbers: Vec<f32> = positions.flatten().collect();
    let item = Arc::new(Field::new("item", DataType::Float32, false));
    let numbers = Arc::new(Float32Array::from(numbers));
    SerializedComponentBatch {
        descriptor: Mesh3D::descriptor_vertex_positions(),
        array: Arc::new(FixedSizeListArray::new(item, 3, numbers, None)),
    }
}

/// An update of a mesh's colours alone, stored in the same way.
pub(super) fn coloured(colours: impl Iterator<Item = [u8; 3]>) -> Mesh3D {
    let numbers: Vec<u32> = colours
        .map(|[r, g, b]| u32::from_be_bytes([r, g, b, u8::MAX]))
        .collect();
    Mesh3D {
        vertex_colors: Some(SerializedComponentBatch {
            descriptor: Mesh3D::descriptor_vertex_colors(),
            array: Arc::new(UInt32Array::from(numbers)),
        }),
        ..Mesh3D::update_fields()
    }
}

/// Two triangles for each cell of a sheet of `columns` by `rows` nodes.
pub(super) fn triangles(columns: usize, rows: usize) -> Vec<[u32; 3]> {
    let mut triangles = Vec::with_capacity(2 * (columns - 1) * (rows - 1));
    for j in 0..rows - 1 {
        for i in 0..columns - 1 {
            let corner = (j * columns + i) as u32;
            let (right, up) = (corner + 1, corner + columns as u32);
            triangles.push([corner, right, up + 1]);
            triangles.push([corner, up + 1, up]);
        }
    }
    triangles
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrays_are_those_that_the_library_would_make() {
        let points = [[0.0, -1.5, 2.25], [3.0, 4.0, f32::MIN_POSITIVE]];
        let colours = [[1, 2, 3], [250, 128, 0]];
        let theirs = Mesh3D::update_fields()
            .with_vertex_positions(points)
            .with_vertex_colors(colours);
        let ours = Mesh3D {
            vertex_positions: Some(positions_of(points.into_iter())),
            ..coloured(colours.into_iter())
        };
        assert_eq!(ours, theirs);
    }

    #[test]
    fn the_front_half_is_cut_away_and_sheets_stay_small() {
        for n in [33, 129, 257, 513] {
            let step = 4.0 / (n - 1) as f64;
            let g = Geometry {
                kind: crate::scene::ContactKind::Point,
                nx: n,
                ny: n,
                x_min: -2.5,
                dx: step,
                y_min: -2.0,
                dy: step,
                a: 1.0,
                b: 1.0,
            };
            let window = Window::new(g, [1.4, 1.2], FINE).expect("a window");
            assert!(window.columns <= FINE[0] && window.rows <= FINE[1]);
            assert!(
                window
                    .xy()
                    .iter()
                    .all(|&[x, y]| x.abs() <= 1.401 && (0.0..=1.201).contains(&y))
            );
            assert!(window.xy()[0][1].abs() < 1e-6, "starts at the cut");
            assert_eq!(window.nodes().len(), window.columns * window.rows);
            let most = window.triangles().into_iter().flatten().max();
            assert_eq!(most, Some((window.nodes().len() - 1) as u32));
            // A plane that rises with x is lit evenly, and less than the flat.
            let flat = window.shades(&vec![0.0; window.nodes().len()]);
            let plane: Vec<f32> = window.xy().iter().map(|[x, _]| 0.5 * x).collect();
            let lit = window.shades(&plane);
            assert!(
                lit.iter()
                    .all(|shade| (shade - lit[0]).abs() < 1e-4 && *shade < flat[0])
            );
        }
    }
}
