//! Sheets of triangles over a window of the frame's grid: the parts of the 3-D view.

use super::colour::hillshade;
use super::geometry::Geometry;

/// Most columns and rows of the film's sheet: what a screen shows, few enough to keep files small.
pub(crate) const FINE: [usize; 2] = [80, 20];
/// Of the bodies' sheets, which only give the picture its frame.
pub(crate) const COARSE: [usize; 2] = [40, 16];

/// Every so-many-th node of a window of the grid: from the plane y = 0 backwards (the front half is
/// cut away), around the contact in x.
#[derive(Debug, Clone)]
pub(crate) struct MeshWindow {
    nodes: Vec<usize>,
    xy: Vec<[f32; 2]>,
    columns: usize,
    rows: usize,
    spacing: [f32; 2],
}

impl MeshWindow {
    /// The window |x| ≤ `reach_x`, 0 ≤ y ≤ `reach_y`; `None` if it holds no whole cell.
    pub(crate) fn new(
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
    pub(crate) fn nodes(&self) -> &[usize] {
        &self.nodes
    }

    /// x and y of the nodes.
    pub(crate) fn xy(&self) -> &[[f32; 2]] {
        &self.xy
    }

    /// The sheet's triangles.
    pub(crate) fn triangles(&self) -> Vec<[u32; 3]> {
        triangles(self.columns, self.rows)
    }

    /// How bright each node of a sheet with these heights is lit.
    pub(crate) fn shades(&self, heights: &[f32]) -> Vec<f32> {
        let mut shades = vec![0.0; heights.len()];
        let row = |j: usize| &heights[j * self.columns..(j + 1) * self.columns];
        for (j, out) in shades.chunks_exact_mut(self.columns).enumerate() {
            let (front, back) = (j.saturating_sub(1), (j + 1).min(self.rows - 1));
            let per = [
                1.0 / self.spacing[0],
                1.0 / (self.spacing[1] * (back - front) as f32),
            ];
            shade_row(row(j), [row(front), row(back)], per, out);
        }
        shades
    }

    /// x, y and z of a sheet with these heights.
    pub(crate) fn places(&self, heights: &[f32]) -> impl Iterator<Item = [f32; 3]> {
        let places = self.xy.iter().zip(heights);
        places.map(|(&[x, y], &z)| [x, y, z])
    }
}

dispatched! {
    /// Of a row between two others: slopes are differences over two cells, at the ends over one.
    fn shade_row(row: &[f32], [front, back]: [&[f32]; 2], [per_x, per_y]: [f32; 2], shades: &mut [f32]) {
        let last = row.len() - 1;
        let rise = |i: usize| (back[i] - front[i]) * per_y;
        shades[0] = hillshade((row[1] - row[0]) * per_x, rise(0));
        shades[last] = hillshade((row[last] - row[last - 1]) * per_x, rise(last));
        let inner = shades[1..last].iter_mut().zip(row.windows(3));
        let inner = inner.zip(front[1..last].iter().zip(&back[1..last]));
        for ((out, x), (front, back)) in inner {
            *out = hillshade((x[2] - x[0]) * (0.5 * per_x), (back - front) * per_y);
        }
    }
}

/// Two triangles for each cell of a sheet of `columns` by `rows` nodes.
pub(crate) fn triangles(columns: usize, rows: usize) -> Vec<[u32; 3]> {
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
    fn the_front_half_is_cut_away_and_sheets_stay_small() {
        for n in [33, 129, 257, 513] {
            let step = 4.0 / (n - 1) as f64;
            let g = Geometry {
                kind: asperity_engine::scene::ContactKind::Point,
                nx: n,
                ny: n,
                x_min: -2.5,
                dx: step,
                y_min: -2.0,
                dy: step,
                a: 1.0,
                b: 1.0,
            };
            let window = MeshWindow::new(g, [1.4, 1.2], FINE).expect("a window");
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
            let places: Vec<[f32; 3]> = window.places(&plane).collect();
            assert_eq!(places.len(), plane.len());
            let of_nodes = places.iter().zip(window.xy());
            assert!(of_nodes.into_iter().all(|(at, xy)| at[..2] == *xy));
            assert!(places.iter().all(|at| at[2] == 0.5 * at[0]));
            let lit = window.shades(&plane);
            assert!(
                lit.iter()
                    .all(|shade| (shade - lit[0]).abs() < 1e-4 && *shade < flat[0])
            );
        }
    }
}
