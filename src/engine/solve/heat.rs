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
//! reaches the end of the padded domain would come round: every [`DAMP_EVERY`] steps, of slow bodies more often, the end of the padding is cleared of it.
//! Of a point contact whose Péclet number V a/κ is below 2 what is cleared counts, and goes on in [`far`].
//! Sources: Blok (1937); Jaeger (1942); Carslaw and Jaeger (1959).

mod exchange;
mod far;
mod history;
mod plane;
mod symbols;

use rayon::prelude::*;
use rustfft::num_complex::Complex;
use serde::{Deserialize, Serialize};

use crate::math::grid::Grid;
use crate::saved::{Saved, saved};
use far::Far;
use history::history;
use plane::{Plane, Spread};
use symbols::{EXPONENTIALS, Moving, Own, Symbols, exponentials};

/// Steps between two clearings of the padding; fewer, but not below the second, where heat would come round meanwhile.
const DAMP_EVERY: u32 = 16;
const DAMP_OFTEN: u32 = 4;
/// Decay over a step, as an exponent, beyond which a mode has nothing left to say after it.
const GONE: f64 = 16.0;
/// Péclet number below which heat spreads as fast as it is carried away.
const SPREADS: f64 = 2.0;
/// Over how many of the ways that heat spreads in a step it reaches: beyond is e^−9 of it.
const STEP_SPREADS: f64 = 3.0;
/// Waves of one task.
const BLOCK: usize = 64;

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
struct Waves(Vec<Complex<f32>>);

impl Serialize for Waves {
    fn serialize<S: serde::Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_seq(self.0.iter().flat_map(|c| [c.re, c.im]))
    }
}

impl<'de> Deserialize<'de> for Waves {
    fn deserialize<D: serde::Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let flat = Vec::<f32>::deserialize(from)?;
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
    /// Modes of the far planes of both; empty where there are none.
    far: [Waves; 2],
    /// d of the last step, W/m².
    exchange: Vec<f64>,
    /// Steps since the padding was cleared.
    since: u32,
    /// Step length that the exponentials are made for, s; 0: none yet.
    made_for_s: f64,
}

saved! {
    HeatState { parts: bodies, far, exchange; free: since, made_for_s; }
    holds |_, saved| saved.made_for_s >= 0.0
}

/// One body's.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Past {
    /// w_j u_j √κ/k_c, by blocks of waves, in each one exponential after another.
    modes: Waves,
    /// q of the last step and of the last but one.
    last: Waves,
    before: Waves,
}

saved! {
    Past { parts: modes, last, before; }
}

/// Of both bodies, for one step length and speed.
struct Tables {
    before: [Symbols; 2],
    own: Own,
}

/// Temperatures, and what they are computed with.
///
/// A step is begun ([`Heat::begin`]), its heat shared as often as another guess of it comes ([`Heat::share`]), and committed;
/// until then nothing of the state changes but its padding.
pub struct Heat {
    plane: Plane,
    far: Option<Far>,
    length_m: f64,
    bodies: [Thermal; 2],
    tables: Option<(Tables, [f64; 4])>,
    /// Of a step by itself: what its heat reaches in it is near by, so that a fraction of the padding does.
    brief: Plane,
    /// Rise over the bulk of both surfaces, K.
    pub rise: [Vec<f64>; 2],
    /// q_1, W/m².
    pub into_body_1: Vec<f64>,
    /// d, W/m².
    exchange: Vec<f64>,
    /// q_2, W/m².
    into_body_2: Vec<f64>,
    /// H_1 and H_2, K.
    past: [Vec<f64>; 2],
    /// Waves of a step by itself: of Q, of d (`crossing`; known once a step's heat has been shared), of what is added to it, and
    /// others.
    made: Vec<Complex<f32>>,
    crossing: Vec<Complex<f32>>,
    is_known: bool,
    added: Vec<Complex<f32>>,
    brief_waves: Vec<Complex<f32>>,
    /// Waves of all that came before.
    scratch: Vec<Complex<f32>>,
    /// Modes at the end of the step.
    next: [Waves; 2],
    fields: [Vec<f64>; 8],
}

impl Heat {
    /// Of bodies on `grid`, whose unit of length is `length_m`, that move at about `speed_m_s`.
    pub fn new(grid: &Grid, length_m: f64, bodies: [Thermal; 2], speed_m_s: f64) -> Self {
        let peclet = bodies.map(|body| speed_m_s.abs() * length_m / body.diffusivity);
        let slowest = peclet[0].min(peclet[1]);
        if slowest < SPREADS {
            let mut plane = Plane::new(grid, true);
            let far = Far::new(grid, &plane);
            if far.is_some() {
                plane.keep_removed();
            }
            return Self::on(grid, length_m, bodies, (plane, far));
        }
        // Steps of an interval, at which both bodies move alike.
        let time = f64::from(DAMP_EVERY) * grid.dx;
        let heat = Spread {
            spreads: (4.0 * time / slowest).sqrt(),
            carried: time,
            upstream: slowest.recip(),
        };
        let plane = Plane::cleared_of(grid, heat);
        Self::on(grid, length_m, bodies, (plane, None))
    }

    fn on(
        grid: &Grid,
        length_m: f64,
        bodies: [Thermal; 2],
        (plane, far): (Plane, Option<Far>),
    ) -> Self {
        let field = || vec![0.0; grid.len()];
        let waves = || vec![Complex::default(); plane.len()];
        let modes = || Waves(vec![Complex::default(); plane.len() * EXPONENTIALS.len()]);
        Self {
            past: [field(), field()],
            into_body_2: field(),
            made: Vec::new(),
            crossing: Vec::new(),
            is_known: false,
            added: Vec::new(),
            brief_waves: Vec::new(),
            brief: Plane::reaching(&plane, 0.0, 0.0),
            scratch: waves(),
            next: [modes(), modes()],
            plane,
            far,
            length_m,
            bodies,
            tables: None,
            rise: [field(), field()],
            into_body_1: field(),
            exchange: field(),
            fields: std::array::from_fn(|_| field()),
        }
    }

    /// Bodies that are as warm as their bulk.
    pub fn cold(&self) -> HeatState {
        let waves = || Waves(vec![Complex::default(); self.plane.len()]);
        let past = || Past {
            modes: Waves(vec![
                Complex::default();
                self.plane.len() * EXPONENTIALS.len()
            ]),
            last: waves(),
            before: waves(),
        };
        let far = || (self.far.as_ref()).map_or_else(Waves::default, Far::cold);
        HeatState {
            bodies: [past(), past()],
            far: [far(), far()],
            exchange: vec![0.0; self.into_body_1.len()],
            since: 0,
            made_for_s: 0.0,
        }
    }

    /// One step: temperatures at its end in [`Heat::rise`].
    pub fn advance(&mut self, state: &mut HeatState, step: &HeatStep) {
        self.begin(state, step.dt_s, step.speeds_m_s);
        self.share(step.made, step.resistance);
        self.commit(state);
    }

    /// A step of that length and speeds: what the heat of all steps before does at its end.
    pub fn begin(&mut self, state: &mut HeatState, dt_s: f64, speeds_m_s: [f64; 2]) {
        if state.made_for_s == 0.0 {
            state.made_for_s = dt_s;
        }
        let [v1, v2] = speeds_m_s;
        let asked = [v1, v2, dt_s, state.made_for_s];
        if self.tables.as_ref().is_none_or(|(_, own)| *own != asked) {
            self.make_tables(dt_s, speeds_m_s, state.made_for_s);
        }
        if state.since >= self.damp_every(dt_s, speeds_m_s) {
            state.since = 0;
            let all = state.bodies.iter_mut().zip(&mut state.far);
            for ((past, far), speed) in all.zip(speeds_m_s) {
                self.damp(past, far, speed >= 0.0, [dt_s, state.made_for_s]);
            }
        }
        let Some((tables, _)) = &self.tables else {
            return;
        };
        for (body, own) in state.bodies.iter().enumerate() {
            let (table, next) = (&tables.before[body], &mut self.next[body].0);
            history(table, own, next, &mut self.scratch);
            let past = &mut self.past[body];
            self.plane.back(&self.scratch, past);
            if let Some(far) = &mut self.far {
                far.advance(body, &state.far[body]);
                for (past, far) in past.iter_mut().zip(&far.rise[body]) {
                    *past += far;
                }
            }
        }
        self.exchange.clone_from(&state.exchange);
        self.is_known = false;
    }

    /// Tables and the plane of a step of that length and speeds.
    fn make_tables(&mut self, dt_s: f64, speeds_m_s: [f64; 2], made_for_s: f64) {
        let steps = f64::from(self.damp_every(dt_s, speeds_m_s));
        let spread = self.spread(steps * dt_s, speeds_m_s);
        self.plane.clear_for(spread);
        let exponentials = exponentials(made_for_s);
        if let Some(far) = &mut self.far {
            let moving = (self.bodies, speeds_m_s);
            far.make_tables(spread, (self.length_m, dt_s), moving, &exponentials);
        }
        let u_m_s = 0.5 * (speeds_m_s[0] + speeds_m_s[1]);
        let moving = speeds_m_s.map(|v_m_s| Moving {
            speeds_m_s: [v_m_s, u_m_s],
            dt_s,
        });
        let apart = 0.5 * (speeds_m_s[0] - speeds_m_s[1]).abs() * dt_s;
        let spreads = (4.0 * self.fastest_diffusivity() * dt_s).sqrt();
        let reach = (STEP_SPREADS * spreads + apart) / self.length_m;
        self.brief = Plane::reaching(&self.plane, reach, reach);
        let n = self.brief.len();
        for waves in [
            &mut self.made,
            &mut self.crossing,
            &mut self.added,
            &mut self.brief_waves,
        ] {
            waves.clear();
            waves.resize(n, Complex::default());
        }
        let before = [0, 1].map(|body: usize| {
            let (thermal, moving) = (self.bodies[body], moving[body]);
            Symbols::new(&self.plane, self.length_m, thermal, moving, &exponentials)
        });
        let own = Own::new(&self.brief, self.length_m, self.bodies, moving);
        let asked = [speeds_m_s[0], speeds_m_s[1], dt_s, made_for_s];
        self.tables = Some((Tables { before, own }, asked));
    }

    /// Steps between two clearings: as many as the padding has room for.
    fn damp_every(&self, dt_s: f64, speeds_m_s: [f64; 2]) -> u32 {
        let padding = self.plane.padding();
        let has_room = |steps: &u32| {
            let spread = self.spread(f64::from(*steps) * dt_s, speeds_m_s);
            if self.far.is_some() {
                // Heat spreads as fast as it is carried: over a quarter of it.
                spread.spreads <= 0.25 * padding
            } else {
                spread.along() <= padding
            }
        };
        (DAMP_OFTEN..=DAMP_EVERY)
            .rev()
            .find(has_room)
            .unwrap_or(DAMP_OFTEN)
    }

    fn fastest_diffusivity(&self) -> f64 {
        f64::max(self.bodies[0].diffusivity, self.bodies[1].diffusivity)
    }

    /// How heat goes in a time.
    fn spread(&self, time_s: f64, speeds_m_s: [f64; 2]) -> Spread {
        let [fast, slow] =
            [f64::max, f64::min].map(|of| of(speeds_m_s[0].abs(), speeds_m_s[1].abs()));
        let diffusivity = self.fastest_diffusivity();
        Spread {
            spreads: (4.0 * diffusivity * time_s).sqrt() / self.length_m,
            carried: fast * time_s / self.length_m,
            upstream: diffusivity / slow.max(f64::MIN_POSITIVE) / self.length_m,
        }
    }

    /// Clears the padding of every mode that lives long enough to come round; `beyond`: where it goes on.
    fn damp(
        &mut self,
        past: &mut Past,
        beyond: &mut Waves,
        forward: bool,
        [dt_s, made_for_s]: [f64; 2],
    ) {
        let across = self.plane.shape()[0] as f64;
        let n = EXPONENTIALS.len();
        for (mode, [rate, _]) in exponentials(made_for_s).iter().enumerate() {
            if rate * dt_s * across > GONE {
                continue;
            }
            for (waves, block) in self
                .scratch
                .chunks_mut(BLOCK)
                .zip(past.modes.0.chunks(BLOCK * n))
            {
                let own = &block[mode * waves.len()..];
                let width = waves.len();
                waves.copy_from_slice(&own[..width]);
            }
            self.plane.damp(&mut self.scratch, forward);
            if let Some(far) = &mut self.far {
                far.take(&self.plane, mode, beyond, forward);
            }
            for (waves, block) in self
                .scratch
                .chunks(BLOCK)
                .zip(past.modes.0.chunks_mut(BLOCK * n))
            {
                let own = &mut block[mode * waves.len()..];
                own[..waves.len()].copy_from_slice(waves);
            }
        }
    }

    /// Shares the heat of the step that has begun, Q in W/m², across a film of h/k_f in m² K/W: temperatures at its end in
    /// [`Heat::rise`].
    pub fn share(&mut self, made: &[f64], resistance: &[f64]) {
        let Some((tables, asked)) = self.tables.take() else {
            return;
        };
        self.solve(made, resistance, &tables.own);
        // T_1 + T_2 from the waves, T_2 − T_1 from what d leaves of its equation.
        self.enter(&tables.own);
        let [one, two] = &mut self.rise;
        self.brief.back(&self.brief_waves, one);
        let [first, second] = &self.past;
        for (sum, (first, second)) in one.iter_mut().zip(first.iter().zip(second)) {
            *sum += first + second;
        }
        let across = resistance.iter().zip(&self.exchange).zip(&self.fields[2]);
        for ((one, two), ((across, d), rest)) in one.iter_mut().zip(two).zip(across) {
            let (sum, step) = (*one, across * d + rest);
            (*one, *two) = (0.5 * (sum - step), 0.5 * (sum + step));
        }
        let into = self.into_body_1.iter_mut().zip(&mut self.into_body_2);
        for ((one, two), (made, d)) in into.zip(made.iter().zip(&self.exchange)) {
            (*one, *two) = (0.5 * made + d, 0.5 * made - d);
        }
        self.tables = Some((tables, asked));
    }

    /// The step has been made.
    pub fn commit(&mut self, state: &mut HeatState) {
        state.since += 1;
        state.exchange.clone_from(&self.exchange);
        let entering = [&self.into_body_1, &self.into_body_2];
        for (body, own) in state.bodies.iter_mut().enumerate() {
            std::mem::swap(&mut own.last, &mut own.before);
            self.plane.forward(entering[body], &mut own.last.0);
            std::mem::swap(&mut own.modes, &mut self.next[body]);
            if let Some(far) = &mut self.far {
                std::mem::swap(&mut state.far[body], &mut far.next[body]);
            }
        }
    }

    /// What the heat of all steps before makes of both surfaces at the end of the step that has begun, K.
    pub fn before(&self) -> [&[f64]; 2] {
        [&self.past[0], &self.past[1]]
    }

    /// Mean over waves of what heat of now does to both surfaces: what a node's own heat does to it, m² K/W.
    pub fn own_of_both(&self) -> f64 {
        self.tables
            .as_ref()
            .map_or(0.0, |(tables, _)| tables.own.mean)
    }

    /// Waves of Σ A_i q_i, q_i = Q/2 ± d.
    fn enter(&mut self, own: &Own) {
        let [one, two] = &own.of;
        (self.brief_waves.par_iter_mut())
            .zip(self.made.par_iter().zip(&self.crossing))
            .zip(one.par_iter().zip(two))
            .with_min_len(BLOCK)
            .for_each(|((both, (made, d)), (a1, a2))| {
                let half = made * 0.5;
                *both = (half + d) * a1 + (half - d) * a2;
            });
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
        let mut heat = Heat::new(grid, 1.0, [body; 2], 1.0);
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

    /// `assets/reference`, computed by quadrature: an elliptic band (line) and a Hertz circle, steady, on two meshes; `a_to_go`: way
    /// after which they are.
    #[test]
    fn steady_sources_have_the_temperatures_of_the_integrals() {
        let band = |x: f64, _: f64| (1.0 - x * x).max(0.0).sqrt();
        for (pe, max, mean, a_to_go) in [
            (0.1, 2.156752, 1.987601, 300),
            (1.0, 1.085832, 0.901362, 60),
            (5.0, 0.543512, 0.397636, 20),
            (100.0, 0.123458, 0.085368, 20),
            (1000.0, 0.039042, 0.026922, 20),
        ] {
            let meshes = [65, 129, 257].into_iter();
            for nodes in meshes.filter(|nodes| pe >= 1.0 || *nodes < 257) {
                let line = Grid::new(nodes, -2.5, 1.5, 0.0, Symmetry::Line);
                let found = rise(&line, pe, a_to_go * (nodes - 1) / 4, line.dx, band);
                let off = [found[0] / max - 1.0, found[1] / mean - 1.0].map(|off| 100.0 * off);
                println!("band, Pe {pe}, {nodes} nodes: greatest, mean off by {off:.2?} %");
                assert!(off[0].abs() < 1.0 && (nodes < 257 || off[1].abs() < 1.0));
            }
        }
        let circle = |x: f64, y: f64| (1.0 - x * x - y * y).max(0.0).sqrt();
        for (pe, max, mean, a_to_go) in [
            (0.1, 0.769319, 0.57290, 60),
            (1.0, 0.661462, 0.46371, 10),
            (5.0, 0.455558, 0.27881, 10),
            (10.0, 0.353496, 0.20567, 10),
            (100.0, 0.122257, 0.06740, 10),
        ] {
            let meshes = [65, 129].into_iter();
            for nodes in meshes.filter(|nodes| pe >= 1.0 || *nodes < 129) {
                let point = Grid::new(nodes, -2.5, 1.5, 2.0, Symmetry::MirrorY);
                let found = rise(&point, pe, a_to_go * (nodes - 1) / 4, point.dx, circle);
                let off = [found[0] / max - 1.0, found[1] / mean - 1.0].map(|off| 100.0 * off);
                println!("circle, Pe {pe}, {nodes} nodes: greatest, mean off by {off:.2?} %");
                assert!(off[0].abs() < 1.0 && (nodes < 129 || off[1].abs() < 1.0));
            }
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
            let mut heat = Heat::new(&line, 1.0, [body; 2], 1.0);
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

    /// A disc that is heated for a while and left alone: all of its heat is still there, at its middle over time
    /// ∫ q (1 − e^{−1/4s})/√(π s) ds over the times s since it entered (Carslaw & Jaeger 1959, 10.3; in units of a, κ and k).
    #[test]
    fn the_heat_of_a_pulse_stays_in_the_body() {
        let grid = Grid::new(65, -2.0, 2.0, 2.0, Symmetry::MirrorY);
        let made: Vec<f64> = (0..grid.len())
            .map(|n| 2.0 * edge(grid.x(n % grid.nx).hypot(grid.y(n / grid.nx))))
            .collect();
        let (none, apart) = (vec![0.0; grid.len()], vec![1e12; grid.len()]);
        let middle = (0..grid.ny)
            .find(|&j| grid.y(j).abs() < 1e-9)
            .expect("a row");
        let body = Thermal {
            conductivity: 1.0,
            diffusivity: 1.0,
        };
        let mut heat = Heat::new(&grid, 1.0, [body; 2], 0.0);
        let (mut state, dt_s) = (heat.cold(), 0.0025);
        for steps in 1..=400_u32 {
            let step = HeatStep {
                dt_s,
                speeds_m_s: [0.0; 2],
                made: if steps <= 40 { &made } else { &none },
                resistance: &apart,
            };
            heat.advance(&mut state, &step);
            if [80, 160, 400].contains(&steps) {
                let now = f64::from(steps) * dt_s;
                let n = 20_000;
                let ds = 0.1 / f64::from(n);
                let since = (0..n).map(|k| now - 0.1 + (f64::from(k) + 0.5) * ds);
                let rise = |s: f64| (1.0 - (-0.25 / s).exp()) / (std::f64::consts::PI * s).sqrt();
                let theirs: f64 = since.map(|s| rise(s) * ds).sum();
                let found = heat.rise[0][middle * grid.nx + (grid.nx - 1) / 2];
                println!("{now:.2} after its start: {found:.6}, {theirs:.6}");
                assert!((found / theirs - 1.0).abs() < 0.01, "{found} {theirs}");
            }
        }
    }

    type Shape<'a> = (&'a str, Symmetry, &'a dyn Fn(f64, f64) -> f64, [f64; 3]);

    /// Heat that is switched on over a body at rest, at its middle after κ t/a² = .01, .1 and 1 (`assets/reference`): a uniform
    /// circle, a Hertz circle, a band; on two meshes and by three steps. Within a step heat rises in proportion: half a step late.
    #[test]
    fn heat_switched_on_at_rest_spreads_as_the_integrals_say() {
        let disc = |x: f64, y: f64| edge(x.hypot(y));
        let circle = |x: f64, y: f64| (1.0 - x * x - y * y).max(0.0).sqrt();
        let band = |x: f64, _: f64| edge(x.abs());
        let shapes: [Shape; 3] = [
            (
                "disc",
                Symmetry::MirrorY,
                &disc,
                [0.112838, 0.352882, 0.729097],
            ),
            (
                "circle",
                Symmetry::MirrorY,
                &circle,
                [0.112076, 0.328673, 0.603345],
            ),
            (
                "band",
                Symmetry::Line,
                &band,
                [0.112838, 0.355711, 0.919727],
            ),
        ];
        let body = Thermal {
            conductivity: 1.0,
            diffusivity: 1.0,
        };
        for (name, symmetry, q, theirs) in shapes {
            for (nodes, parts) in [(65, 40), (65, 80), (129, 160)] {
                let y_half = if symmetry == Symmetry::Line { 0.0 } else { 2.0 };
                let grid = Grid::new(nodes, -2.0, 2.0, y_half, symmetry);
                let made: Vec<f64> = (0..grid.len())
                    .map(|n| 2.0 * q(grid.x(n % grid.nx), grid.y(n / grid.nx)))
                    .collect();
                let resistance = vec![1e12; grid.len()];
                let middle = (0..grid.ny)
                    .find(|&j| grid.y(j).abs() < 1e-9)
                    .expect("a row");
                let found = [0.01, 0.1, 1.0].map(|fo| {
                    let mut heat = Heat::new(&grid, 1.0, [body; 2], 0.0);
                    let mut state = heat.cold();
                    let step = HeatStep {
                        dt_s: fo / f64::from(parts),
                        speeds_m_s: [0.0; 2],
                        made: &made,
                        resistance: &resistance,
                    };
                    for _ in 0..parts {
                        heat.advance(&mut state, &step);
                    }
                    heat.rise[0][middle * grid.nx + (grid.nx - 1) / 2]
                });
                println!("{name}, {nodes} nodes, {parts} steps: {found:.5?}, {theirs:?}");
                for (found, theirs) in found.into_iter().zip(theirs) {
                    assert!((found / theirs - 1.0).abs() < 0.01, "{found} {theirs}");
                }
            }
        }
    }

    type Profile<'a> = (Symmetry, &'a dyn Fn(f64) -> f64, [f64; 2]);

    /// Heat that is switched on at rest and goes on until it has spread far beyond the domain, κ t/a² = 10 and 100, and has gone
    /// through some 20 clearings, mirrored and not (`assets/reference`): a uniform and a Hertz circle at their middle.
    #[test]
    fn heat_that_has_left_the_domain_still_warms_it() {
        let disc = |r: f64| edge(r);
        let circle = |r: f64| (1.0 - r * r).max(0.0).sqrt();
        let body = Thermal {
            conductivity: 1.0,
            diffusivity: 1.0,
        };
        let shapes: [Profile; 2] = [
            (Symmetry::General, &disc, [0.911164, 0.971802]),
            (Symmetry::MirrorY, &circle, [0.726125, 0.766598]),
        ];
        for (symmetry, q, theirs) in shapes {
            let grid = Grid::new(65, -2.0, 2.0, 2.0, symmetry);
            let made: Vec<f64> = (0..grid.len())
                .map(|n| 2.0 * q(grid.x(n % grid.nx).hypot(grid.y(n / grid.nx))))
                .collect();
            let resistance = vec![1e12; grid.len()];
            let middle = (0..grid.ny)
                .find(|&j| grid.y(j).abs() < 1e-9)
                .expect("a row");
            let found = [10.0, 100.0].map(|fo| {
                let mut heat = Heat::new(&grid, 1.0, [body; 2], 0.0);
                let mut state = heat.cold();
                let step = HeatStep {
                    dt_s: fo / 320.0,
                    speeds_m_s: [0.0; 2],
                    made: &made,
                    resistance: &resistance,
                };
                for _ in 0..320 {
                    heat.advance(&mut state, &step);
                }
                heat.rise[0][middle * grid.nx + (grid.nx - 1) / 2]
            });
            println!("{symmetry:?}: {found:.5?}, {theirs:?}");
            for (found, theirs) in found.into_iter().zip(theirs) {
                assert!((found / theirs - 1.0).abs() < 0.01, "{found} {theirs}");
            }
        }
    }

    /// 1 inside, half at the edge, 0 beyond.
    fn edge(r: f64) -> f64 {
        if (r - 1.0).abs() < 1e-9 {
            0.5
        } else {
            f64::from(u8::from(r < 1.0))
        }
    }

    /// The padding that heat needs is as good as one as wide as the domain, and than one thrice as wide: mirrored and not, of bodies of
    /// like and unlike speeds, with steps of half a node, one and two.
    #[test]
    fn more_padding_changes_nothing() {
        for (symmetry, n) in [(Symmetry::MirrorY, 129), (Symmetry::General, 65)] {
            let grid = Grid::new(n, -2.5, 1.5, 2.0, symmetry);
            let made: Vec<f64> = (0..grid.len())
                .map(|n| [grid.x(n % grid.nx), grid.y(n / grid.nx)])
                .map(|[x, y]| (1.0 - x * x - y * y).max(0.0).sqrt())
                .collect();
            let resistance = vec![1e-3; grid.len()];
            for (pe, speeds_m_s, nodes) in [
                (5.0, [1.0, 1.0], 1.0),
                (5.0, [0.75, 1.25], 1.0),
                (50.0, [1.25, 0.75], 0.5),
                (50.0, [0.1, 1.9], 2.0),
                (500.0, [0.75, 1.25], 1.0),
                (500.0, [2.0, 0.0], 1.0),
            ] {
                let body = Thermal {
                    conductivity: 1.0,
                    diffusivity: 1.0 / pe,
                };
                let step = HeatStep {
                    dt_s: nodes * grid.dx,
                    speeds_m_s,
                    made: &made,
                    resistance: &resistance,
                };
                let run = |mut heat: Heat| {
                    let mut state = heat.cold();
                    for _ in 0..(8.0 / step.dt_s) as usize {
                        heat.advance(&mut state, &step);
                    }
                    (heat.plane.padded(), heat.rise)
                };
                let wide = |spreads| (Plane::new(&grid, spreads), None);
                let (narrow, rise) = run(Heat::new(&grid, 1.0, [body; 2], 1.0));
                let greatest = rise.iter().flatten().copied().fold(0.0, f64::max);
                let off = [false, true].map(|spreads| {
                    let (_, other) = run(Heat::on(&grid, 1.0, [body; 2], wide(spreads)));
                    let both = rise.iter().flatten().zip(other.iter().flatten());
                    both.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / greatest
                });
                println!(
                    "{symmetry:?} Pe {pe} {speeds_m_s:?} {nodes}: {narrow:?}, off by {:.1e} and {:.1e}",
                    off[0], off[1]
                );
                // Heat that spreads as far as it is carried, or stays with a body that all but stands, is lost at the rim.
                let alike = speeds_m_s.iter().all(|speed| *speed > 0.5);
                let room = match (alike, pe < 50.0) {
                    (true, false) => [1e-4, 1e-4],
                    (true, true) => [1e-3, 1e-2],
                    (false, _) => [1e-2, 1e-2],
                };
                assert!(off[0] < room[0] && off[1] < room[1]);
            }
        }
    }

    /// Surfaces that run against each other at equal temperatures, a uniform band (`assets/reference`): half of the heat enters
    /// each, where Blok's formula is 10 % low; and both the same way.
    #[test]
    fn opposed_surfaces_share_a_band() {
        let body = Thermal {
            conductivity: 1.0,
            diffusivity: 0.1,
        };
        for ([v1, v2], max, mean) in [
            ([1.0, -1.0], 0.24413, 0.21364),
            ([1.0, 1.0], 0.24232, 0.17251),
        ] {
            let off = [129, 257, 513].map(|nodes| {
                let line = Grid::new(nodes, -2.0, 2.0, 0.0, Symmetry::Line);
                let mut heat = Heat::new(&line, 1.0, [body; 2], 1.0);
                let mut state = heat.cold();
                let made: Vec<f64> = (0..line.nx).map(|i| edge(line.x(i).abs())).collect();
                let apart = |q: &f64| if *q > 0.0 { 0.0 } else { 1e6 };
                let resistance: Vec<f64> = made.iter().map(apart).collect();
                let step = HeatStep {
                    dt_s: 1.0 / 64.0,
                    speeds_m_s: [v1, v2],
                    made: &made,
                    resistance: &resistance,
                };
                for _ in 0..1000 {
                    heat.advance(&mut state, &step);
                }
                let rise = &heat.rise[0];
                let greatest = rise.iter().copied().fold(0.0, f64::max);
                let inside = line.integrate(|n| made[n] * rise[n]) / line.integrate(|n| made[n]);
                let share = heat.into_body_1.iter().sum::<f64>() / made.iter().sum::<f64>();
                println!("{v1} {v2}, {nodes} nodes: share {share:.4}, {greatest:.5} {inside:.5}, {max} {mean}");
                assert!((share - 0.5).abs() < 1e-3);
                (greatest / max - 1.0).abs().max((inside / mean - 1.0).abs())
            });
            assert!(off[1] < 0.02 && off[2] < 0.01, "{off:?}");
        }
    }

    /// Heat that rides as a wave over a body, as roughness bound to the other body makes it: amplitude and lag
    /// (closed form, `assets/reference`: T = q/(k_c m), m² = k² + i k (V − c)/κ) at (V − c) λ/(2πκ) = −1, 0 and 3, with 8, 16 and
    /// 32 nodes a wave. What is even in it is taken off by a run of its own.
    #[test]
    fn a_wave_of_heat_has_its_amplitude_and_lag() {
        use std::f64::consts::TAU;
        for ([v, c], ratio, amplitude, lag) in [
            ([1.0, 1.5], 1.0, 0.84090, -22.5),
            ([1.0, 1.0], 0.0, 1.0, 0.0),
            ([1.5, 0.5], 3.0, 0.56234, 35.78),
        ] {
            let off = [8.0, 16.0, 32.0].map(|per_wave| {
                let line = Grid::new(257, -2.0, 2.0, 0.0, Symmetry::Line);
                let wave = per_wave * line.dx;
                let kappa = match ratio {
                    0.0 => 0.05,
                    ratio => f64::abs(v - c) * wave / (TAU * ratio),
                };
                let body = Thermal {
                    conductivity: 1.0,
                    diffusivity: kappa,
                };
                let run = |rides: f64| {
                    let mut heat = Heat::new(&line, 1.0, [body; 2], 1.0);
                    let mut state = heat.cold();
                    let resistance = vec![1e12; line.len()];
                    let (dt, steps) = (0.5 * line.dx, 1024);
                    for step in 1..=steps {
                        let t = dt * f64::from(step);
                        let made: Vec<f64> = (0..line.nx)
                            .map(|i| 2.0 * (1.0 + rides * (TAU * (line.x(i) - c * t) / wave).cos()))
                            .collect();
                        heat.advance(
                            &mut state,
                            &HeatStep {
                                dt_s: dt,
                                speeds_m_s: [v, c],
                                made: &made,
                                resistance: &resistance,
                            },
                        );
                    }
                    (heat.rise[0].clone(), dt * f64::from(steps))
                };
                let ((with, t), (without, _)) = (run(1.0), run(0.0));
                // Over whole waves in the middle.
                let n = 64;
                let first = (line.nx - n) / 2;
                let mut sums = [0.0; 2];
                for i in first..first + n {
                    let phase = TAU * (line.x(i) - c * t) / wave;
                    let rise = (with[i] - without[i]) * 2.0 / n as f64;
                    sums[0] += rise * phase.cos();
                    sums[1] += rise * phase.sin();
                }
                let unit = wave / TAU;
                let found = sums[0].hypot(sums[1]) / unit;
                let behind = sums[1].atan2(sums[0]).to_degrees();
                println!("{v} {c}, {per_wave} nodes a wave: {found:.5}, {amplitude}; {behind:.2} degrees, {lag}");
                ((found / amplitude - 1.0).abs(), (behind - lag).abs())
            });
            assert!(off[2].0 < 0.01 && off[2].1 < 1.0, "{off:?}");
            assert!(off[2].0 < off[0].0 + 1e-3);
        }
    }
}
