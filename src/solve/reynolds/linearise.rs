//! One grid row of the linearised equation: storage, then the flow through the faces around each node.

use super::super::jacobian::STENCIL;
use super::super::reynolds_rows::{conductance_slopes, flow_row, scale_row, storage_row};
use super::{Reynolds, Scratch};
use crate::math::grid::Grid;

impl Reynolds {
    pub(super) fn linearise_row(
        &self,
        grid: &Grid,
        lambda: f64,
        p: &[f64],
        h: &[f64],
        s: &[f64],
        active: &[bool],
        j: usize,
        scratch: &mut Scratch,
        row: &mut [f32],
    ) {
        let nx = grid.nx;
        let range = |j: usize| j * nx..(j + 1) * nx;
        let here = range(j);
        let [q_p, other_q_p] = &mut scratch.q_p;
        let [q_h, other_q_h] = &mut scratch.q_h;
        let slopes = |range: std::ops::Range<usize>, q_p: &mut [f64], q_h: &mut [f64]| {
            conductance_slopes(
                &self.rho[range.clone()],
                &self.rho_p[range.clone()],
                &h[range],
                q_p,
                q_h,
            );
        };
        slopes(here.clone(), q_p, q_h);
        let (start, end) = (here.start, here.end);
        scratch.east.fill(
            self.nodes(start..end - 1),
            self.slopes(start..end - 1, &q_p[..nx - 1], &q_h[..nx - 1]),
            self.nodes(start + 1..end),
            self.slopes(start + 1..end, &q_p[1..], &q_h[1..]),
        );
        for (faces, neighbour) in [
            (&mut scratch.south, grid.row_below(j)),
            (&mut scratch.north, grid.row_above(j)),
        ] {
            let there = range(neighbour);
            slopes(there.clone(), other_q_p, other_q_h);
            faces.fill(
                self.nodes(here.clone()),
                self.slopes(here.clone(), q_p, q_h),
                self.nodes(there.clone()),
                self.slopes(there, other_q_p, other_q_h),
            );
        }
        let (wx, wy) = grid.flow_weights();
        let (south, north) = (range(grid.row_below(j)), range(grid.row_above(j)));
        let s = &s[here.clone()];
        let row_scale = &self.row_scale[here.clone()];
        let active = &active[here.clone()];
        let p_here = &p[here.clone()];
        row.fill(0.0);
        let (a_p, a_h) = row.split_at_mut(STENCIL * nx);
        let mut lines_p = a_p.chunks_exact_mut(nx);
        let mut lines_h = a_h.chunks_exact_mut(nx);
        let mut next = || {
            let p = lines_p.next().expect("ten lines a row");
            let h = lines_h.next().expect("ten lines a row");
            (p, h)
        };
        let (own_p, own_h) = next();
        storage_row(
            &self.rho[here.clone()],
            &self.rho_p[here.clone()],
            &h[here],
            own_p,
            own_h,
        );
        let (west_p, west_h) = next();
        let (east_p, east_h) = next();
        let x = &scratch.east;
        // The western face is the eastern one of the node before, seen from its other side.
        flow_row(
            &x.tau,
            &x.p_b,
            &x.h_b,
            &x.p_a,
            &x.h_a,
            &p_here[1..],
            &p_here[..nx - 1],
            &s[1..],
            wx / lambda,
            &mut own_p[1..],
            &mut own_h[1..],
            &mut west_p[1..],
            &mut west_h[1..],
        );
        flow_row(
            &x.tau,
            &x.p_a,
            &x.h_a,
            &x.p_b,
            &x.h_b,
            p_here,
            &p_here[1..],
            s,
            wx / lambda,
            &mut own_p[..nx - 1],
            &mut own_h[..nx - 1],
            &mut east_p[..nx - 1],
            &mut east_h[..nx - 1],
        );
        for (y, neighbour) in [(&scratch.south, south), (&scratch.north, north)] {
            let (other_p, other_h) = next();
            flow_row(
                &y.tau,
                &y.p_a,
                &y.h_a,
                &y.p_b,
                &y.h_b,
                p_here,
                &p[neighbour],
                s,
                wy / lambda,
                own_p,
                own_h,
                other_p,
                other_h,
            );
        }
        for line in row.chunks_exact_mut(nx) {
            scale_row(row_scale, active, line);
        }
    }
}
