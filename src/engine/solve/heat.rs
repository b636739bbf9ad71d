//! Temperatures of both surfaces by moving sources of heat, transient, at any speed of the bodies.
//!
//! ```text
//! q_1 = Q/2 + d,   q_2 = Q/2 − d,   d = (k_f/h)(T_2 − T_1)          a film that conducts, its heat made evenly across it
//! T_i = H_i + A_i q_i                                           H_i: heat of the steps before, A_i: that of this one
//! (h/k_f + A_1 + A_2) d = H_2 − H_1 + (A_2 − A_1) Q/2            solved in every step: h → 0 gives equal temperatures
//! ```
//! | symbol | meaning | unit |
//! |---|---|---|
//! | Q | heat made, τ |U2 − U1| | W/m² |
//! | q_i | heat that enters body i | W/m² |
//! | T_i | rise of the surface's temperature over the bulk's | K |
//! | h, k_f | film, its conductivity | m, W/(m K) |
//!
//! [`symbols`] has the warming by waves. Lagging d by a step is unstable for films below some 50 nm; this is not. A wake that
//! reaches the end of the padded domain would come round: every [`DAMP_EVERY`] steps the padding is cleared of it.
//! Below a Péclet number V a/κ of about 1 what is cleared matters: a line at 1 is .8 % low, slower ones more.
//! Sources: Blok (1937); Jaeger (1942); Carslaw and Jaeger (1959).

mod plane;
mod symbols;

use rayon::prelude::*;
use rustfft::num_complex::Complex;
use serde::{Deserialize, Serialize};

use crate::math::grid::Grid;
use crate::saved::{Saved, saved};
use plane::Plane;
use symbols::{Symbols, exponentials, n_exponentials, weights_before};

/// Steps between two clearings of the padding.
const DAMP_EVERY: u32 = 16;
/// Decay over a step, as an exponent, beyond which a mode has nothing left to say after it.
const GONE: f64 = 16.0;
/// Relative residual of d, and most iterations.
const RESIDUAL: f64 = 1e-4;
const MOST_ITERATIONS: usize = 60;

/// Thermal properties of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thermal {
    /// k_c, W/(m K).
    pub conductivity: f64,
    /// κ, m²/s.
    pub diffusivity: f64,
}

/// A step of the sources.
#[derive(Debug, Clone, Copy)]
pub struct HeatStep<'a> {
    /// Its length, s.
    pub dt_s: f64,
    /// Of body 1 and 2, m/s.
    pub speeds_m_s: [f64; 2],
    /// Q, W/m², a value a node.
    pub made: &'a [f64],
    /// h/k_f, m² K/W.
    pub resistance: &'a [f64],
}

/// Waves of a field.
#[derive(Debug, Clone, PartialEq, Default)]
struct Waves(Vec<Complex<f64>>);

impl Serialize for Waves {
    fn serialize<S: serde::Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_seq(self.0.iter().flat_map(|c| [c.re, c.im]))
    }
}

impl<'de> Deserialize<'de> for Waves {
    fn deserialize<D: serde::Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let flat = Vec::<f64>::deserialize(from)?;
        let pairs = flat.chunks_exact(2).map(|c| Complex::new(c[0], c[1]));
        Ok(Self(pairs.collect()))
    }
}

impl Saved for Waves {
    fn check(&self, saved: &Self) -> Result<(), String> {
        if self.0.len() == saved.0.len() {
            Ok(())
        } else {
            Err(String::new())
        }
    }

    fn restore(&mut self, saved: &Self) {
        self.0.clone_from(&saved.0);
    }
}

/// What is remembered of the heat.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct HeatState {
    bodies: [Past; 2],
    /// d of the last step, W/m².
    exchange: Vec<f64>,
    /// Steps since the padding was cleared.
    since: u32,
    /// Step length that the exponentials are made for, s; 0: none yet.
    made_for_s: f64,
}

saved! {
    HeatState { parts: bodies, exchange; free: since, made_for_s; }
    holds |_, saved| saved.made_for_s >= 0.0
}

/// One body's.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Past {
    /// u_j.
    modes: Vec<Waves>,
    /// q of the last step and of the last but one.
    last: Waves,
    before: Waves,
}

saved! {
    Past { parts: modes, last, before; }
}

/// Temperatures, and what they are computed with.
pub struct Heat {
    plane: Plane,
    length_m: f64,
    bodies: [Thermal; 2],
    tables: Option<([Symbols; 2], [f64; 3])>,
    exponentials: (f64, Vec<[f64; 2]>),
    /// Rise over the bulk of both surfaces, K.
    pub rise: [Vec<f64>; 2],
    /// q_1, W/m².
    pub into_body_1: Vec<f64>,
    /// Waves of H_1 and H_2, and of Q.
    past: [Vec<Complex<f64>>; 2],
    made: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
    fields: [Vec<f64>; 8],
}

impl Heat {
    /// Of bodies on `grid`, whose unit of length is `length_m`.
    pub fn new(grid: &Grid, length_m: f64, bodies: [Thermal; 2]) -> Self {
        let plane = Plane::new(grid);
        let field = || vec![0.0; grid.len()];
        let waves = || vec![Complex::default(); plane.len()];
        Self {
            past: [waves(), waves()],
            made: waves(),
            scratch: waves(),
            plane,
            length_m,
            bodies,
            tables: None,
            exponentials: (0.0, Vec::new()),
            rise: [field(), field()],
            into_body_1: field(),
            fields: std::array::from_fn(|_| field()),
        }
    }

    /// Bodies that are as warm as their bulk.
    pub fn cold(&self) -> HeatState {
        let waves = || Waves(vec![Complex::default(); self.plane.len()]);
        let past = || Past {
            modes: (0..n_exponentials()).map(|_| waves()).collect(),
            last: waves(),
            before: waves(),
        };
        HeatState {
            bodies: [past(), past()],
            exchange: vec![0.0; self.into_body_1.len()],
            since: 0,
            made_for_s: 0.0,
        }
    }

    /// One step: temperatures at its end in [`Heat::rise`].
    pub fn advance(&mut self, state: &mut HeatState, step: &HeatStep) {
        self.prepare(state, step);
        if state.since >= DAMP_EVERY {
            state.since = 0;
            for (past, speed) in state.bodies.iter_mut().zip(step.speeds_m_s) {
                for mode in &mut past.modes {
                    self.plane.damp(&mut mode.0, speed >= 0.0);
                }
            }
        }
        state.since += 1;
        let Some((tables, _)) = self.tables.take() else {
            return;
        };
        let mut past = std::mem::take(&mut self.past);
        for (body, waves) in past.iter_mut().enumerate() {
            let own = &mut state.bodies[body];
            history(&tables[body], &self.exponentials.1, step.dt_s, own, waves);
        }
        self.share(state, step, &tables, &past);
        // T_i = H_i + A_i (Q/2 ± d), of which the waves of Q and d are known.
        self.plane.forward(&state.exchange, &mut self.scratch);
        for (body, mut waves) in past.into_iter().enumerate() {
            let sign = if body == 0 { 1.0 } else { -1.0 };
            let own = &mut state.bodies[body];
            std::mem::swap(&mut own.last, &mut own.before);
            let entering = self.made.iter().zip(&self.scratch);
            let heat = waves.iter_mut().zip(&mut own.last.0);
            for (((made, d), symbol), (wave, q)) in entering.zip(&tables[body].own).zip(heat) {
                *q = made * 0.5 + d * sign;
                *wave += *q * symbol;
            }
            self.plane.back(&mut waves, &mut self.rise[body]);
            self.past[body] = waves;
        }
        for ((to, made), d) in (self.into_body_1.iter_mut())
            .zip(step.made)
            .zip(&state.exchange)
        {
            *to = 0.5 * made + d;
        }
        let [v1, v2] = step.speeds_m_s;
        self.tables = Some((tables, [v1, v2, step.dt_s]));
    }

    /// Tables for this step's length and speeds.
    fn prepare(&mut self, state: &mut HeatState, step: &HeatStep) {
        let [v1, v2] = step.speeds_m_s;
        let asked = [v1, v2, step.dt_s];
        if self.tables.as_ref().is_none_or(|(_, own)| *own != asked) {
            let mean = 0.5 * (v1 + v2);
            let table = |body: usize| {
                let thermal = self.bodies[body];
                Symbols::new(
                    &self.plane,
                    self.length_m,
                    [thermal.conductivity, thermal.diffusivity],
                    [step.speeds_m_s[body], mean],
                    step.dt_s,
                )
            };
            self.tables = Some(([table(0), table(1)], asked));
        }
        if state.made_for_s == 0.0 {
            state.made_for_s = step.dt_s;
        }
        if self.exponentials.0 != state.made_for_s {
            self.exponentials = (state.made_for_s, exponentials(state.made_for_s));
        }
    }

    /// (A_1 + A_2) x.
    fn both(&mut self, tables: &[Symbols; 2], x: usize, to: usize) {
        self.plane.forward(&self.fields[x], &mut self.scratch);
        let pairs = tables[0].own.iter().zip(&tables[1].own);
        for (wave, (one, two)) in self.scratch.iter_mut().zip(pairs) {
            *wave *= one + two;
        }
        self.plane.back(&mut self.scratch, &mut self.fields[to]);
    }

    /// d of this step into the state, by BiCGStab preconditioned by the diagonal.
    fn share(
        &mut self,
        state: &mut HeatState,
        step: &HeatStep,
        tables: &[Symbols; 2],
        past: &[Vec<Complex<f64>>; 2],
    ) {
        // Fields: 0 x, 2 r, 3 r0, 4 p, 5 v, 6 s or its preconditioned one, 7 t.
        let diagonal = {
            let sums = tables.iter().map(|table| {
                let n = table.own.len() as f64;
                table.own.iter().map(|own| own.re).sum::<f64>() / n
            });
            sums.sum::<f64>()
        };
        // Right-hand side less the operator on the first guess: H2 − H1 + (A2 − A1) Q/2 − (A1 + A2 + h/k) d.
        self.plane.forward(step.made, &mut self.made);
        self.plane.forward(&state.exchange, &mut self.scratch);
        let symbols = tables[0].own.iter().zip(&tables[1].own);
        let heat = self.scratch.iter_mut().zip(&self.made);
        let histories = past[0].iter().zip(&past[1]);
        for (((d, made), (one, two)), (first, second)) in heat.zip(symbols).zip(histories) {
            *d = second - first + made * 0.5 * (two - one) - *d * (one + two);
        }
        self.plane.back(&mut self.scratch, &mut self.fields[2]);
        let goal = RESIDUAL * dot(step.made, step.made).sqrt() * diagonal;
        self.fields[0].clone_from(&state.exchange);
        for n in 0..self.fields[2].len() {
            self.fields[2][n] -= step.resistance[n] * self.fields[0][n];
        }
        let (low, high) = self.fields.split_at_mut(3);
        high[0].clone_from(&low[2]);
        self.fields[4].fill(0.0);
        self.fields[5].fill(0.0);
        let (mut rho, mut alpha, mut omega) = (1.0, 1.0, 1.0);
        for _ in 0..MOST_ITERATIONS {
            if dot(&self.fields[2], &self.fields[2]).sqrt() <= goal {
                break;
            }
            let next = dot(&self.fields[3], &self.fields[2]);
            let beta = next / rho * (alpha / omega);
            rho = next;
            for n in 0..self.fields[4].len() {
                self.fields[4][n] =
                    self.fields[2][n] + beta * (self.fields[4][n] - omega * self.fields[5][n]);
            }
            self.apply(tables, step, diagonal, 4, 5);
            alpha = rho / dot(&self.fields[3], &self.fields[5]);
            for n in 0..self.fields[2].len() {
                self.fields[0][n] += alpha * self.fields[4][n] / (step.resistance[n] + diagonal);
                self.fields[2][n] -= alpha * self.fields[5][n];
            }
            if dot(&self.fields[2], &self.fields[2]).sqrt() <= goal {
                break;
            }
            self.apply(tables, step, diagonal, 2, 7);
            omega = dot(&self.fields[7], &self.fields[2])
                / dot(&self.fields[7], &self.fields[7]).max(f64::MIN_POSITIVE);
            for n in 0..self.fields[2].len() {
                self.fields[0][n] += omega * self.fields[2][n] / (step.resistance[n] + diagonal);
                self.fields[2][n] -= omega * self.fields[7][n];
            }
        }
        state.exchange.clone_from(&self.fields[0]);
    }

    /// The preconditioned operator on field `x`.
    fn apply(
        &mut self,
        tables: &[Symbols; 2],
        step: &HeatStep,
        diagonal: f64,
        x: usize,
        to: usize,
    ) {
        for n in 0..self.fields[6].len() {
            self.fields[6][n] = self.fields[x][n] / (step.resistance[n] + diagonal);
        }
        self.both(tables, 6, to);
        for n in 0..self.fields[6].len() {
            self.fields[to][n] += step.resistance[n] * self.fields[6][n];
        }
    }
}

fn dot(one: &[f64], two: &[f64]) -> f64 {
    one.iter().zip(two).map(|(a, b)| a * b).sum()
}

/// Moves the modes on by a step, and writes the waves of what all heat before this step's end does now.
fn history(
    table: &Symbols,
    exponentials: &[[f64; 2]],
    dt_s: f64,
    past: &mut Past,
    out: &mut [Complex<f64>],
) {
    let Past {
        modes,
        last,
        before,
    } = past;
    modes
        .par_iter_mut()
        .zip(exponentials)
        .for_each(|(mode, [rate, _])| {
            let slow = rate * dt_s;
            let fade = (-slow).exp();
            for (n, u) in mode.0.iter_mut().enumerate() {
                let [decay, turn, nu] = table.decay[n];
                if nu.re + slow > GONE {
                    *u = Complex::default();
                    continue;
                }
                // e^{−ν} = e^{−μ} e^{i k U Δt}.
                let [here, there] = weights_before(nu + slow, decay * turn.conj() * fade);
                let turned = before.0[n] * turn;
                *u = (*u + (here * last.0[n] + there * turned) * dt_s) * (decay * fade);
            }
        });
    for (n, out) in out.iter_mut().enumerate() {
        let sum: Complex<f64> = (modes.iter().zip(exponentials))
            .map(|(mode, [_, weight])| mode.0[n] * *weight)
            .sum();
        let [_, turn, _] = table.decay[n];
        *out = sum * table.scale + table.last[n] * last.0[n] * turn;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::grid::Symmetry;

    /// Heat of shape `q` (W/m² = 1 at its middle) on one body alone, with unit properties: conductivity 1, κ = 1/Pe, speed 1, half-width 1.
    /// Greatest and mean rise where it is heated, after `steps`.
    fn rise(grid: &Grid, pe: f64, steps: usize, dt: f64, q: impl Fn(f64, f64) -> f64) -> [f64; 2] {
        let kappa = 1.0 / pe.abs();
        let body = Thermal {
            conductivity: 1.0,
            diffusivity: kappa,
        };
        let mut heat = Heat::new(grid, 1.0, [body; 2]);
        let mut state = heat.cold();
        let made: Vec<f64> = (0..grid.len())
            .map(|n| 2.0 * q(grid.x(n % grid.nx), grid.y(n / grid.nx)))
            .collect();
        // Nothing goes across: half of the heat, q, enters each.
        let resistance = vec![1e12; grid.len()];
        let step = HeatStep {
            dt_s: dt,
            speeds_m_s: [1.0; 2],
            made: &made,
            resistance: &resistance,
        };
        for _ in 0..steps {
            heat.advance(&mut state, &step);
        }
        let heated = |n: usize| f64::from(u8::from(made[n] > 0.0));
        let rise = &heat.rise[0];
        let mean = grid.integrate(|n| heated(n) * rise[n]) / grid.integrate(heated);
        [rise.iter().copied().fold(0.0, f64::max), mean]
    }

    /// `assets/reference`, computed by quadrature: an elliptic band (line) and a Hertz circle, steady.
    #[test]
    fn steady_sources_have_the_temperatures_of_the_integrals() {
        let line = Grid::new(257, -2.5, 1.5, 0.0, Symmetry::Line);
        let band = |x: f64, _: f64| (1.0 - x * x).max(0.0).sqrt();
        for (pe, max, mean, room) in [
            (1.0, 1.085832, 0.901362, 0.01),
            (5.0, 0.543512, 0.397636, 0.01),
            (100.0, 0.123458, 0.085368, 0.01),
            (1000.0, 0.039042, 0.026922, 0.01),
        ] {
            let found = rise(&line, pe, 1200, line.dx, band);
            println!("band, Pe {pe}: {found:?}, {max} {mean}");
            assert!((found[0] / max - 1.0).abs() < room, "{pe}");
            assert!((found[1] / mean - 1.0).abs() < room, "{pe}");
        }
        let point = Grid::new(65, -2.5, 1.5, 2.0, Symmetry::MirrorY);
        let circle = |x: f64, y: f64| (1.0 - x * x - y * y).max(0.0).sqrt();
        for (pe, max, mean) in [
            (1.0, 0.661462, 0.46371),
            (5.0, 0.455558, 0.27881),
            (10.0, 0.353496, 0.20567),
            (100.0, 0.122257, 0.06740),
        ] {
            let found = rise(&point, pe, 300, point.dx, circle);
            println!("circle, Pe {pe}: {found:?}, {max} {mean}");
            assert!((found[0] / max - 1.0).abs() < 0.02, "{pe}");
        }
    }

    /// Two bodies with equal temperatures: the share of body 1 and the greatest rise of an elliptic band.
    #[test]
    fn two_bodies_share_the_heat_at_equal_temperatures() {
        let line = Grid::new(257, -2.5, 1.5, 0.0, Symmetry::Line);
        let body = Thermal {
            conductivity: 1.0,
            diffusivity: 0.1,
        };
        for ([v1, v2], share, max) in [([1.0, 1.0], 0.5, 0.19442), ([1.0, 0.5], 0.58528, 0.22673)] {
            let mut heat = Heat::new(&line, 1.0, [body; 2]);
            let mut state = heat.cold();
            let made: Vec<f64> = (0..line.nx)
                .map(|i| (1.0 - line.x(i).powi(2)).max(0.0).sqrt())
                .collect();
            let resistance: Vec<f64> = made
                .iter()
                .map(|q| if *q > 0.0 { 0.0 } else { 1e6 })
                .collect();
            let step = HeatStep {
                dt_s: line.dx,
                speeds_m_s: [v1, v2],
                made: &made,
                resistance: &resistance,
            };
            for _ in 0..1000 {
                heat.advance(&mut state, &step);
            }
            let sum = |field: &[f64]| field.iter().sum::<f64>();
            let found = sum(&heat.into_body_1) / sum(&made);
            let rise = heat.rise[0].iter().copied().fold(0.0, f64::max);
            let apart = (0..line.nx).filter(|&i| made[i] > 0.0);
            let apart = apart.map(|i| (heat.rise[0][i] - heat.rise[1][i]).abs());
            let apart = apart.fold(0.0, f64::max) / rise;
            println!("{v1} {v2}: share {found}, {share}; {rise}, {max}; apart {apart:.1e}");
            assert!((found / share - 1.0).abs() < 0.01 && (rise / max - 1.0).abs() < 0.01);
            assert!(apart < 1e-3);
        }
    }
}
