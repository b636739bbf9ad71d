//! The oil at a node: its stress from the temperature of its walls, the heat of that, and how thin it is. Part of `heat_stage.rs`.

use super::{HeatStage, SolvedStep};
use crate::math::elementary::{exp, ln};
use crate::physics::thinning::{BLOCK, Sheared, Thinning, block, put, thinned_row};
use crate::solve::traction::{FilmShear, TractionLaw};

/// Parts of Q h/k_f by which the flow sees the oil warmer than its walls: heat of the sliding, of the flow itself; and the
/// middle of the film, of the latter.
const FLOW_OF_SLIDING: f64 = 1.0 / 20.0;
const FLOW_OF_FLOW: f64 = 3.0 / 84.0;
const MIDDLE_OF_FLOW: f64 = 1.0 / 16.0;

/// The K of all nodes of a block below which c = base − K, to its square; and below which one step of Newton does, to 1e-5.
const FAINT: f64 = 1e-5;
const WARM: f64 = 0.1;

/// A row of nodes.
pub(super) struct Row<'a> {
    pub(super) j: usize,
    pub(super) walls: &'a [f64],
    /// c and Q_p as the step has been solved with.
    pub(super) solved: (&'a [f64], &'a [f64]),
    pub(super) made: &'a mut [f64],
    pub(super) flowing: &'a mut [f64],
    pub(super) middle: &'a mut [f64],
    pub(super) q: &'a mut [f64],
    pub(super) nodes: &'a mut [Vec<f64>; 5],
    pub(super) shift: &'a mut [f64],
    pub(super) thinner: &'a mut [f64],
}

/// What is the same at all nodes of a step.
pub(super) struct NodeLaw {
    thinning: Option<Thinning>,
    /// W/m² of a stress of p_h.
    unit: f64,
    /// h/k_f of H = 1, m² K/W.
    resistance: f64,
    /// K a W/m² by which walls warm with the heat of a node.
    walls_grow: f64,
}

impl NodeLaw {
    pub(super) fn new(stage: &HeatStage, step: &SolvedStep) -> Self {
        let scaling = step.scaling;
        Self {
            thinning: stage.thinning,
            unit: scaling.pa_from_p(1.0) * step.sliding_m_s,
            resistance: stage.oil.map_or(0.0, |k| scaling.m_from_h(1.0) / k),
            walls_grow: 0.25 * stage.heat.own_of_both(),
        }
    }

    /// Of a row; how much its heat changes, and how much it is.
    pub(super) fn row(&self, step: &SolvedStep, mut row: Row) -> [f64; 2] {
        let (nx, dx) = (step.grid.nx, step.grid.dx);
        let here = row.j * nx..(row.j + 1) * nx;
        let (p, h) = (&step.pressure[here.clone()], &step.film[here]);
        let film = step.law.film.filter(|_| step.law.direction != 0.0);
        if let Some((thinning, film)) = self.thinning.as_ref().zip(film) {
            self.thin(thinning, step.law, &film, (p, h), &mut row);
        } else {
            row.shift.fill(0.0);
        }
        step.law.traction_row(dx, p, h, row.shift, row.q);
        let Row {
            walls,
            solved,
            made,
            flowing,
            middle,
            q,
            nodes,
            thinner,
            ..
        } = row;
        let [sliding, resistance, ..] = nodes;
        for i in 0..nx {
            sliding[i] = q[i].abs() * self.unit;
            resistance[i] = self.resistance * h[i].max(0.0);
            flowing[i] = solved.1[i];
        }
        if let Some(thinning) = &self.thinning {
            thinner_row(
                thinning,
                [walls, sliding, resistance],
                solved,
                flowing,
                thinner,
            );
        }
        let mut sums = [0.0; 2];
        for i in 0..nx {
            if self.thinning.is_none() || film.is_none() {
                middle[i] = sliding[i] * resistance[i] / 8.0;
            }
            middle[i] += MIDDLE_OF_FLOW * flowing[i] * resistance[i];
            let now = sliding[i] + flowing[i];
            sums[0] += (now - made[i]).abs();
            sums[1] += now;
            made[i] = now;
        }
        sums
    }

    /// Shift of ln η̄ and rise in the middle of every node of a row.
    fn thin(
        &self,
        thinning: &Thinning,
        law: &TractionLaw,
        film: &FilmShear,
        (p, h): (&[f64], &[f64]),
        row: &mut Row,
    ) {
        let [newtonian, ln_eta, limit, warms_k, of_stress] = &mut *row.nodes;
        newtonian_row(law, film, (p, h), newtonian, ln_eta);
        for i in 0..p.len() {
            limit[i] = film.limit * p[i].max(0.0);
            warms_k[i] = self.unit * self.resistance * h[i].max(0.0);
            of_stress[i] = row.made[i] / self.unit;
        }
        let sheared = Sheared {
            newtonian,
            ln_eta,
            limit,
            eyring: film.eyring.unwrap_or(f64::INFINITY),
            warms_k,
            walls_k: row.walls,
            of_stress,
            walls_grow_k: self.walls_grow * self.unit,
        };
        thinned_row(thinning, &sheared, row.shift, row.middle);
    }
}

dispatched! {
/// Stress of cold Newtonian oil and its ln η̄ of every node of a row; no stress where no film is sheared.
fn newtonian_row(
    law: &TractionLaw,
    film: &FilmShear,
    (p, h): (&[f64], &[f64]),
    newtonian: &mut [f64],
    ln_eta: &mut [f64],
) {
    let n = p.len();
    let (h, newtonian, ln_eta) = (&h[..n], &mut newtonian[..n], &mut ln_eta[..n]);
    let viscosity = law.viscosity;
    for i in 0..n {
        ln_eta[i] = viscosity.ln_eta(p[i]).0;
    }
    for i in 0..n {
        let is_film = p[i] > 0.0 && h[i] > law.contact_film;
        let open = if is_film { h[i] } else { 1.0 };
        let stress = film.rate / open * exp(ln_eta[i]);
        newtonian[i] = if is_film { stress } else { 0.0 };
    }
}
}

dispatched! {
/// c of the flow and Q_p of every node of a row, from the rise of its walls, the heat of the sliding and h/k_f.
///
/// What flows stays what it was when the oil was as thin as it has been solved with: thinner oil makes less heat,
/// Q_p ~ e^(c − c_solved), and c = c(θ_w + (Q/20 + 3 Q_p/84) h/k_f). Held with the slope of the pressure in place of the
/// flow, the heat would swing where much of it is made.
fn thinner_row(
    thinning: &Thinning,
    [walls, sliding, resistance]: [&[f64]; 3],
    (solved, flowed): (&[f64], &[f64]),
    flowing: &mut [f64],
    thinner: &mut [f64],
) {
    let zero = [0.0; BLOCK];
    let (mut rest, mut warms, mut base, mut k) = (zero, zero, zero, zero);
    let (mut c, mut flows) = (zero, zero);
    for start in (0..thinner.len()).step_by(BLOCK) {
        let [walls, sliding, resistance, solved, flowed] =
            [walls, sliding, resistance, solved, flowed].map(|field| block(field, start));
        let mut warmed = [0, 0];
        for i in 0..BLOCK {
            rest[i] = walls[i] + FLOW_OF_SLIDING * sliding[i] * resistance[i];
            warms[i] = FLOW_OF_FLOW * flowed[i] * resistance[i];
            base[i] = thinning.at_rest(rest[i]);
        }
        if flowed.iter().all(|flowed| *flowed == 0.0) {
            put(&base, thinner, start);
            put(&zero, flowing, start);
            continue;
        }
        for i in 0..BLOCK {
            k[i] = thinning.falls_at_rest(rest[i]) * warms[i] * exp(base[i] - solved[i]);
            warmed[0] |= u64::from(k[i] > FAINT);
            warmed[1] |= u64::from(k[i] > WARM);
            c[i] = base[i] - k[i];
        }
        // Of exponential oil exactly base − W(K), Lambert's; the guess is good to a few per cent for any K.
        if warmed[0] != 0 {
            for i in 0..BLOCK {
                let k = ln(1.0 + k[i]);
                c[i] = base[i] - k * (1.0 - ln(1.0 + k) / (2.0 + k));
            }
            for _ in 0..=warmed[1] {
                for i in 0..BLOCK {
                    let of_flow = warms[i] * exp(c[i] - solved[i]);
                    let residual = c[i] - thinning.at_rest(rest[i] + of_flow);
                    c[i] -= residual / (1.0 + thinning.falls_at_rest(rest[i] + of_flow) * of_flow);
                }
            }
        }
        for i in 0..BLOCK {
            flows[i] = flowed[i] * exp(c[i] - solved[i]);
        }
        put(&c, thinner, start);
        put(&flows, flowing, start);
    }
}
}
