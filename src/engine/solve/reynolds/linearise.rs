//! One grid row of the linearised equation: storage, then the flow through the faces around each node.
//!
//! Part of `reynolds.rs`.

use rayon::prelude::*;

use super::super::faces::Faces;
use super::super::fluidity::FlowDirection;
use super::super::jacobian::{STENCIL, localise};
use super::super::reynolds_rows::{flow_row, scale_row, storage_row};
use super::closing::{conductance_slopes, keep_rising};
use super::{ROWS, Reynolds, Scratch};
use crate::math::grid::Grid;

/// The point of linearisation and what of it is asked.
#[derive(Clone, Copy)]
pub struct Linearisation<'a> {
    /// P, shape ny × nx.
    pub p: &'a [f64],
    /// H.
    pub h: &'a [f64],
    /// C*.
    pub c_star: &'a [f64],
    /// s.
    pub s: &'a [f64],
    /// λ.
    pub lambda: f64,
    /// K00.
    pub k00: f64,
    /// Rows asked for; the others are zero.
    pub active: &'a [bool],
}

impl Reynolds {
    /// ∂q/∂P and ∂q/∂H of all nodes.
    pub(super) fn fill_slopes(&mut self, grid: &Grid, at: &Linearisation) {
        let block = ROWS * grid.nx;
        let (rho, rho_p, f) = (&self.rho, &self.rho_p, &self.residual);
        self.q_p
            .par_chunks_mut(block)
            .zip(self.q_h.par_chunks_mut(block))
            .enumerate()
            .for_each(|(b, (q_p, q_h))| {
                let here = b * block..b * block + q_p.len();
                conductance_slopes(
                    &rho[here.clone()],
                    &rho_p[here.clone()],
                    &at.h[here.clone()],
                    &f[here.clone()],
                    &at.c_star[here],
                    q_p,
                    q_h,
                );
            });
    }

    /// Fills `faces` between the runs of nodes that begin at `a` and `b`.
    fn fill_run(
        &self,
        direction: FlowDirection,
        (a, b): (usize, usize),
        len: usize,
        faces: &mut Faces,
    ) {
        let run = |start: usize| {
            let range = start..start + len;
            let nodes = self.fluidity.nodes(direction, &self.q, range.clone());
            let slopes = self
                .fluidity
                .slopes(direction, (&self.q_p, &self.q_h), range);
            (nodes, slopes)
        };
        let ((nodes_a, slopes_a), (nodes_b, slopes_b)) = (run(a), run(b));
        faces.fill(nodes_a, slopes_a, nodes_b, slopes_b);
    }

    /// The lines of grid row `j`.
    pub(super) fn linearise_row(
        &self,
        grid: &Grid,
        at: &Linearisation,
        j: usize,
        scratch: &mut Scratch,
        row: &mut [f32],
    ) {
        let nx = grid.nx;
        let (start, south, north) = (j * nx, grid.row_below(j) * nx, grid.row_above(j) * nx);
        let here = start..start + nx;
        self.fill_run(
            FlowDirection::Along,
            (start, start + 1),
            nx - 1,
            &mut scratch.east,
        );
        if let Some(steep) = self.fluidity.steep((at.p, at.h), start, nx - 1) {
            steep.lessen_faces(&mut scratch.east);
        }
        self.fill_run(
            FlowDirection::Across,
            (start, south),
            nx,
            &mut scratch.south,
        );
        self.fill_run(
            FlowDirection::Across,
            (start, north),
            nx,
            &mut scratch.north,
        );
        let (row, local) = row.split_at_mut(2 * STENCIL * nx);
        row.fill(0.0);
        {
            let mut lines = Lines::of(row, nx);
            let (own_p, own_h) = lines.next();
            storage_row(
                &self.rho[here.clone()],
                &self.rho_p[here.clone()],
                &at.h[here.clone()],
                own_p,
                own_h,
            );
            flow_along(
                grid,
                at,
                start,
                scratch,
                (&mut *own_p, &mut *own_h),
                &mut lines,
            );
            flow_across(
                grid,
                at,
                [start, south, north],
                scratch,
                (own_p, own_h),
                &mut lines,
            );
        }
        let (own_p, own_h) = row.split_at_mut(STENCIL * nx);
        keep_rising(
            &self.rho[here.clone()],
            at.k00,
            &own_p[..nx],
            &mut own_h[..nx],
        );
        for line in row.chunks_exact_mut(nx) {
            scale_row(
                &self.row_scale[here.clone()],
                &at.active[here.clone()],
                line,
            );
        }
        let (a_p, a_h) = row.split_at(STENCIL * nx);
        localise(a_p, a_h, at.k00, local);
    }
}

/// The lines of a grid row, pair after pair: ∂F/∂P and ∂F/∂H of one neighbour.
struct Lines<'a> {
    p: std::slice::ChunksExactMut<'a, f32>,
    h: std::slice::ChunksExactMut<'a, f32>,
}

impl<'a> Lines<'a> {
    fn of(row: &'a mut [f32], nx: usize) -> Self {
        let (a_p, a_h) = row.split_at_mut(STENCIL * nx);
        Self {
            p: a_p.chunks_exact_mut(nx),
            h: a_h.chunks_exact_mut(nx),
        }
    }

    fn next(&mut self) -> (&'a mut [f32], &'a mut [f32]) {
        let p = self.p.next().expect("ten lines a row");
        let h = self.h.next().expect("ten lines a row");
        (p, h)
    }
}

/// Flow through the western and the eastern faces.
fn flow_along(
    grid: &Grid,
    at: &Linearisation,
    start: usize,
    scratch: &Scratch,
    (own_p, own_h): (&mut [f32], &mut [f32]),
    lines: &mut Lines,
) {
    let nx = grid.nx;
    let weight = grid.flow_weights().0 / at.lambda;
    let (p, s) = (&at.p[start..start + nx], &at.s[start..start + nx]);
    let x = &scratch.east;
    let (west_p, west_h) = lines.next();
    // The western face is the eastern one of the node before, seen from its other side.
    flow_row(
        &x.tau,
        &x.p_b,
        &x.h_b,
        &x.p_a,
        &x.h_a,
        &p[1..],
        &p[..nx - 1],
        &s[1..],
        weight,
        &mut own_p[1..],
        &mut own_h[1..],
        &mut west_p[1..],
        &mut west_h[1..],
    );
    let (east_p, east_h) = lines.next();
    flow_row(
        &x.tau,
        &x.p_a,
        &x.h_a,
        &x.p_b,
        &x.h_b,
        p,
        &p[1..],
        s,
        weight,
        &mut own_p[..nx - 1],
        &mut own_h[..nx - 1],
        &mut east_p[..nx - 1],
        &mut east_h[..nx - 1],
    );
}

/// Flow through the faces with the rows below and above; `rows` are the starts of the row itself and of those two.
fn flow_across(
    grid: &Grid,
    at: &Linearisation,
    rows: [usize; 3],
    scratch: &Scratch,
    (own_p, own_h): (&mut [f32], &mut [f32]),
    lines: &mut Lines,
) {
    let nx = grid.nx;
    let weight = grid.flow_weights().1 / at.lambda;
    let [start, south, north] = rows;
    for (y, neighbour) in [(&scratch.south, south), (&scratch.north, north)] {
        let (other_p, other_h) = lines.next();
        flow_row(
            &y.tau,
            &y.p_a,
            &y.h_a,
            &y.p_b,
            &y.h_b,
            &at.p[start..start + nx],
            &at.p[neighbour..neighbour + nx],
            &at.s[start..start + nx],
            weight,
            own_p,
            own_h,
            other_p,
            other_h,
        );
    }
}
