//! Greatest effective stress that every material column of a body meets below the line y = 0 on its way through the
//! contact, by depth.
//!
//! ```text
//! s_X(z)  = max over the crossing of σ(x_X(t), z, t)            x_X(t) moves with the body
//! r(z)    = < law(s_X) >_X / law(max_X s_X)                     law(s) = <s − u>^m
//! ```
//! The numerator is what a cycle by cycle sum of damage starts from ([`crate::physics::life_models`]): each point of the
//! track counts by the greatest stress that *it* meets. The denominator is the swept bound, which takes every point for
//! the unluckiest. Their ratio turns the one into the other, at every depth; off the line y = 0 it is taken to be the same.
//!
//! Columns stand a node apart and move with the body, whatever it does in a step; between the nodes stress is read by
//! Lagrange's cubic. A crossing reaches from ahead of the contact's middle to behind it, `|x| < reach`: nothing stands out
//! further on (under Hertz 0.3 % of `s^m` at 0.8 of the half-width). A body that hardly moves finishes none: then every crest of the mate passes every point, and what two points of the same place in the body's own wave
//! meet is the same: `s_X` is the greatest over all columns of that place (without a wave of its own, over all).
//! What finished weighs by its distance over the distance that is needed, the guess by the remainder. Memory is made once.
//!
//! What columns meet repeats along the body after the distance that it moves in a common period of both bodies' waves, and
//! nearly so after a wave of its own. The mean is over as many of those as have finished (of waves three, or all columns), the last
//! column in part: a mean that ends anywhere sways by what of a wave is too many (2 % of the default scene's life).
//!
//! Source: Miner (1945), J. Appl. Mech. 12, A159-A164. Ours: the mean over points of the damage that each collects, over the damage at the swept bound; both
//! integrals are of the same law, so what it leaves out cancels.

use serde::{Deserialize, Serialize};

use super::axis::Line;
use super::damage::{BlockSpec, DamageMap};
use super::stress::StressLaw;
use crate::saved::{any, saved};

/// Places in the body's own wave that are told apart: of a cosine the highest lies within 1/32 of a wave of one of them, which is
/// 2 % of the amplitude.
const PLACES: usize = 16;
/// Waves of which whole ones alone make the mean: of fewer, what is left out is as much as what a wave in part does (one passage
/// over waves of 1.8 a, 13 values of S: lives off by 8 % either way). Untuned.
const FEWEST_WAVES: f64 = 3.0;
/// Relative difference of two lengths that are the same.
const SAME: f64 = 1e-9;

/// Whether a column has been followed from ahead of the contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
enum Followed {
    Whole,
    Part,
    /// Counted: it is behind the contact.
    Done,
}

any!(Followed);

/// Columns of one body; lengths in a, stress in p_h.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Columns {
    nx: usize,
    depths: usize,
    x_first: f64,
    dx: f64,
    /// Distance of the body in nodes, past the last whole one.
    part: f64,
    /// Whole nodes that the body has moved: column `j` stands in slot `(j − nodes) mod nx`.
    nodes: i64,
    /// `[k · nx + slot]`.
    greatest: Vec<f32>,
    followed: Vec<Followed>,
    /// One row between the nodes.
    row: Vec<f32>,
    /// Place of every slot in the body's own wave.
    places: Vec<u32>,
    /// Greatest of all by depth.
    tops: Vec<f32>,
    /// `Σ law(s_X)` of the finished, `[law · depths + k]`, and how many.
    sums: Vec<f64>,
    finished: u64,
    /// `sums` over the whole repeats that have finished, and how many columns these are.
    whole: Vec<f64>,
    in_whole: f64,
    /// Distances, a, after which what columns meet repeats: nearly, and exactly; 0: not known.
    repeats: [f64; 2],
    laws: Vec<StressLaw>,
    /// Distance of the body when counting began, a.
    origin: f64,
    /// The same by place on the body, where it is asked for.
    block: Option<Block>,
}

/// Damage of the greatest stress that each place of the body meets.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct Block {
    law: StressLaw,
    map: DamageMap,
}

saved! {
    Block { same: law; parts: map; }
}

saved! {
    Columns {
        same: nx, depths, x_first, dx, laws;
        parts: greatest, followed, row, places, tops, sums, whole, block;
        free: part, nodes, finished, in_whole, repeats, origin;
    }
    holds |_, saved| (0.0..=1.0).contains(&saved.part) && saved.nodes.unsigned_abs() < 1 << 53 && saved.in_whole >= 0.0
}

impl Columns {
    /// Columns on `nx` nodes from `x_first`, `dx` apart, at so many `depths`; sums of `laws`.
    pub fn new((x_first, dx): (f64, f64), nx: usize, depths: usize, laws: &[StressLaw]) -> Self {
        Self {
            nx,
            depths,
            x_first,
            dx,
            part: 0.0,
            nodes: 0,
            greatest: vec![0.0; nx * depths],
            followed: vec![Followed::Part; nx],
            row: vec![0.0; nx],
            places: vec![0; nx],
            tops: vec![0.0; depths],
            sums: vec![0.0; laws.len() * depths],
            finished: 0,
            whole: vec![0.0; laws.len() * depths],
            in_whole: 0.0,
            repeats: [0.0; 2],
            laws: laws.to_vec(),
            origin: 0.0,
            block: None,
        }
    }

    /// Sums up the greatest stress of every crossing by `law` over the places of a block of the surface, too.
    #[must_use]
    pub fn with_block(mut self, spec: BlockSpec, law: StressLaw) -> Self {
        let map = DamageMap::new(spec);
        self.block = Some(Block { law, map });
        self
    }

    /// Law of those sums.
    pub fn block_law(&self) -> Option<StressLaw> {
        self.block.as_ref().map(|block| block.law)
    }

    /// Mean damage of a crossing at a place of the block by depth; `None`: nothing has crossed there. As long as nothing has
    /// crossed at all, every place meets the greatest stress there is.
    pub fn block_damage(&self, column: usize, depth: usize) -> Option<f64> {
        let block = self.block.as_ref()?;
        if self.finished == 0 {
            return Some(block.law.of(self.tops[depth]));
        }
        block.map.mean(column, depth)
    }

    /// Forgets all that was met; the body has moved by `distance` (in a).
    pub fn restart(&mut self, distance: f64) {
        self.origin = distance;
        if let Some(block) = &mut self.block {
            block.map.clear();
        }
        self.greatest.fill(0.0);
        self.tops.fill(0.0);
        self.sums.fill(0.0);
        self.followed.fill(Followed::Part);
        (self.finished, self.part, self.nodes) = (0, 0.0, 0);
        self.in_whole = 0.0;
    }

    fn slot(&self, column: usize) -> usize {
        (column as i64 - self.nodes).rem_euclid(self.nx as i64) as usize
    }

    fn x(&self, column: usize) -> f64 {
        self.x_first + (column as f64 + self.part) * self.dx
    }

    /// Moves by `travel = U_i Δt` (in a, signed) and looks at the `line`; columns begin their crossing ahead of `reach` and
    /// end it behind.
    pub fn step(&mut self, travel: f64, reach: f64, line: &Line) {
        let Some(field) = line.effective else {
            return;
        };
        self.part += travel / self.dx;
        while self.part >= 1.0 {
            self.leave(self.nx - 1);
            self.nodes += 1;
            self.part -= 1.0;
        }
        while self.part < 0.0 {
            self.leave(0);
            self.nodes -= 1;
            self.part += 1.0;
        }
        let first = self.slot(0);
        for k in 0..self.depths {
            let nodes = &field[k * self.nx..(k + 1) * self.nx];
            between(nodes, self.part as f32, &mut self.row);
            let rows = &mut self.greatest[k * self.nx..(k + 1) * self.nx];
            let (tail, head) = rows.split_at_mut(first);
            let mut top = self.tops[k];
            for (most, &now) in head.iter_mut().chain(tail).zip(&self.row) {
                *most = most.max(now);
                top = top.max(now);
            }
            self.tops[k] = top;
        }
        self.follow(travel, reach);
    }

    /// Which columns are ahead of the contact, and which have passed it.
    fn follow(&mut self, travel: f64, reach: f64) {
        for column in 0..self.nx {
            let (x, slot) = (self.x(column), self.slot(column));
            let ahead = -x * travel.signum();
            match self.followed[slot] {
                _ if travel == 0.0 => {}
                Followed::Part if ahead >= reach => self.followed[slot] = Followed::Whole,
                Followed::Whole if ahead <= -reach => {
                    self.followed[slot] = Followed::Done;
                    self.finish(slot, column);
                }
                Followed::Part | Followed::Whole | Followed::Done => {}
            }
        }
    }

    /// Along the body what columns meet repeats nearly after `own` (its own wave, in a), and exactly after `common`; `None`:
    /// nothing is known.
    pub fn repeat_after(&mut self, own: Option<f64>, common: Option<f64>) {
        self.repeats = [own, common].map(|distance| distance.unwrap_or(0.0));
    }

    /// Whole repeats that end in the column that finishes now, in columns; exact ones once there is one.
    fn whole_columns(&self) -> Option<f64> {
        let now = self.finished as f64;
        let [near, exact] = self.repeats.map(|distance| distance / self.dx);
        let is_exact = exact > 0.0 && now >= exact * (1.0 - SAME);
        let (repeat, fewest) = if is_exact {
            (exact, 1.0)
        } else {
            (near, FEWEST_WAVES)
        };
        let repeats = (now / repeat * (1.0 + SAME)).floor();
        let whole = (repeats * repeat).min(now);
        let is_new = whole > now - 1.0 && whole > self.in_whole;
        (repeat > 0.0 && repeats >= fewest && is_new).then_some(whole)
    }

    fn finish(&mut self, slot: usize, column: usize) {
        self.finished += 1;
        let whole = self.whole_columns();
        if let Some(columns) = whole {
            self.in_whole = columns;
        }
        if let Some(Block { law, map }) = &mut self.block {
            let place = self.x_first + (column as i64 - self.nodes) as f64 * self.dx - self.origin;
            let greatest = self.greatest.iter().skip(slot).step_by(self.nx);
            map.add(place, greatest.map(|&stress| law.of(stress)));
        }
        for k in 0..self.depths {
            let greatest = self.greatest[k * self.nx + slot];
            let sums = self.sums.chunks_exact_mut(self.depths);
            let wholes = self.whole.chunks_exact_mut(self.depths);
            for ((law, sums), wholes) in self.laws.iter().zip(sums).zip(wholes) {
                let damage = law.of(greatest);
                if let Some(columns) = whole {
                    wholes[k] = sums[k] + (columns - (self.finished - 1) as f64) * damage;
                }
                sums[k] += damage;
            }
        }
    }

    /// Distance of the body whose points have finished their crossing, a.
    pub fn finished(&self) -> f64 {
        self.finished as f64 * self.dx
    }

    /// The column at `at` leaves the domain, and a new one comes in at the other end, in its slot.
    fn leave(&mut self, at: usize) {
        let slot = self.slot(at);
        for k in 0..self.depths {
            self.greatest[k * self.nx + slot] = 0.0;
        }
        self.followed[slot] = Followed::Part;
    }

    /// ln r by every law of every depth into `out`, `[law · depths + k]`: over the finished crossings as far as they reach
    /// over `needed` (in a), over places in the body's own wave of length `own` (`None`: it has none) for the remainder.
    pub fn ln_ratios(&mut self, own: Option<f64>, needed: f64, out: &mut [f64]) {
        let share = (self.finished as f64 * self.dx / needed.max(self.dx)).min(1.0);
        if let (true, Some(own)) = (share < 1.0, own) {
            self.find_places(own);
        }
        for (at, ln) in out.iter_mut().enumerate() {
            let (law, k) = (at / self.depths, at % self.depths);
            let top = self.laws[law].of(self.tops[k]);
            if top <= 0.0 {
                *ln = 0.0;
                continue;
            }
            let mut mean = 0.0;
            if share > 0.0 {
                let (sum, columns) = if self.in_whole > 0.0 {
                    (self.whole[at], self.in_whole)
                } else {
                    (self.sums[at], self.finished as f64)
                };
                mean += share * sum / columns;
            }
            if share < 1.0 {
                mean += (1.0 - share) * self.by_place(law, k, own);
            }
            *ln = (mean / top).ln();
        }
    }

    fn find_places(&mut self, own: f64) {
        for column in 0..self.nx {
            let slot = self.slot(column);
            let wave = (column as i64 - self.nodes) as f64 * self.dx / own;
            let place = (wave.rem_euclid(1.0) * PLACES as f64) as usize;
            self.places[slot] = place.min(PLACES - 1) as u32;
        }
    }

    /// Mean over places in the body's own wave of the law at the greatest that any column of that place has met.
    fn by_place(&self, law: usize, k: usize, own: Option<f64>) -> f64 {
        let law = self.laws[law];
        if own.is_none() {
            return law.of(self.tops[k]);
        }
        let mut most = [None::<f32>; PLACES];
        let row = &self.greatest[k * self.nx..(k + 1) * self.nx];
        for (value, place) in row.iter().zip(&self.places) {
            let most = &mut most[*place as usize % PLACES];
            *most = Some(most.map_or(*value, |most| most.max(*value)));
        }
        let (sum, count) = most
            .iter()
            .flatten()
            .fold((0.0, 0.0), |(sum, n), &s| (sum + law.of(s), n + 1.0));
        sum / f64::max(count, 1.0)
    }
}

/// Lagrange's cubic at `part` of the way from each node to the next; near the ends the nearer node.
fn between(nodes: &[f32], part: f32, out: &mut [f32]) {
    let f = part;
    let weights = [
        -f * (f - 1.0) * (f - 2.0) / 6.0,
        (f + 1.0) * (f - 1.0) * (f - 2.0) / 2.0,
        -(f + 1.0) * f * (f - 2.0) / 2.0,
        (f + 1.0) * f * (f - 1.0) / 6.0,
    ];
    let n = nodes.len();
    for (j, out) in out.iter_mut().enumerate() {
        *out = nodes[if f < 0.5 { j } else { (j + 1).min(n - 1) }];
    }
    if n < 4 {
        return;
    }
    for (four, out) in nodes.windows(4).zip(&mut out[1..n - 2]) {
        let value: f32 = four.iter().zip(&weights).map(|(v, w)| v * w).sum();
        *out = value;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NX: usize = 161;
    const DX: f64 = 0.025;
    const X_FIRST: f64 = -2.5;

    /// Stress of a ripple of body 2 (`own`: of body 1) under a parabola at one depth.
    fn field(travelled: [f64; 2], depth_of: [f64; 2], out: &mut [f32]) {
        for (i, value) in out.iter_mut().enumerate() {
            let x = X_FIRST + DX * i as f64;
            let wave = |body: usize| {
                depth_of[body] * (std::f64::consts::TAU * (x - travelled[body]) / 0.4).cos()
            };
            *value = ((1.0 - x * x).max(0.0).sqrt() * (1.0 + wave(0) + wave(1))) as f32;
        }
    }

    fn run(speeds: [f64; 2], depth_of: [f64; 2], distance: f64) -> Columns {
        run_with(speeds, depth_of, distance, (None, None))
    }

    fn run_with(
        speeds: [f64; 2],
        depth_of: [f64; 2],
        distance: f64,
        (own, common): (Option<f64>, Option<f64>),
    ) -> Columns {
        let law = StressLaw::power(10.0);
        let mut columns = Columns::new((X_FIRST, DX), NX, 1, &[law]);
        columns.repeat_after(own, common);
        let mut row = vec![0.0_f32; NX];
        let step = 0.01;
        for n in 0..(distance / step) as usize {
            let travelled = speeds.map(|u| u * step * n as f64);
            field(travelled, depth_of, &mut row);
            let line = Line {
                x_first: X_FIRST,
                dx: DX,
                pressure: &row,
                tau_xz: None,
                effective: Some(&row),
            };
            columns.step(speeds[0] * step, 0.8, &line);
        }
        columns
    }

    fn ratio(columns: &mut Columns) -> f64 {
        let mut out = [0.0];
        columns.ln_ratios(Some(0.4), 0.4, &mut out);
        out[0].exp()
    }

    /// The same by brute force: points at any place, followed alone.
    fn brute(speeds: [f64; 2], depth_of: [f64; 2]) -> f64 {
        // 15 waves of the body, which are whole numbers of the mate's at these speeds.
        let greatest: Vec<f64> = (0..600)
            .map(|i| {
                let entry = 6.0 * f64::from(i) / 600.0;
                (0..2000)
                    .map(|n| {
                        let t = 4.0 / speeds[0].abs() * f64::from(n) / 2000.0;
                        let x = -2.0 + speeds[0].abs() * t;
                        let wave = |body: usize, moved: f64| {
                            depth_of[body] * (std::f64::consts::TAU * (x - moved) / 0.4).cos()
                        };
                        let start = entry / speeds[0].abs();
                        (1.0 - x * x).max(0.0).sqrt()
                            * (1.0
                                + wave(0, speeds[0] * (t + start))
                                + wave(1, speeds[1] * (t + start)))
                    })
                    .fold(0.0, f64::max)
            })
            .collect();
        let top = greatest.iter().copied().fold(0.0, f64::max);
        greatest.iter().map(|s| (s / top).powi(10)).sum::<f64>() / 600.0
    }

    #[test]
    fn smooth_columns_all_meet_the_same() {
        for speeds in [[1.0, 1.0], [0.75, 1.25], [0.0, 2.0], [-0.2, 2.2]] {
            let r = ratio(&mut run(speeds, [0.0, 0.0], 8.0));
            // Columns of one place in a wave stand up to W/2 from the middle of the contact: the parabola to the tenth
            // power loses 6 % in their mean.
            let error = if speeds[0] == 0.0 { 0.07 } else { 2e-3 };
            assert!((r - 1.0).abs() < error, "{speeds:?}: {r}");
        }
    }

    #[test]
    fn points_meet_their_own_greatest_and_not_the_greatest_of_all() {
        for speeds in [[1.0, 1.0], [0.75, 1.25], [1.25, 0.75]] {
            for depth_of in [[0.2, 0.0], [0.0, 0.2], [0.1, 0.1]] {
                let (r, brute) = (
                    ratio(&mut run(speeds, depth_of, 40.0)),
                    brute(speeds, depth_of),
                );
                println!("{speeds:?} {depth_of:?}: {r:.4}, point by point {brute:.4}");
                assert!((r / brute - 1.0).abs() < 0.05, "{r} {brute}");
            }
        }
    }

    #[test]
    fn a_mean_over_whole_repeats_does_not_hang_on_where_it_ends() {
        let (speeds, depth_of) = ([0.75, 1.25], [0.1, 0.1]);
        let spread = |repeats| {
            let at = |n: u32| {
                ratio(&mut run_with(
                    speeds,
                    depth_of,
                    8.0 + 0.08 * f64::from(n),
                    repeats,
                ))
            };
            let all: Vec<f64> = (0..20).map(at).collect();
            let (low, high) = (all.iter()).fold((1.0_f64, 0.0_f64), |(low, high), r| {
                (low.min(*r), high.max(*r))
            });
            (low, high)
        };
        // Three crests of body 1 and five of body 2 in 1.6 a at U.
        let [anywhere, waves, repeats] =
            [(None, None), (Some(0.4), None), (Some(0.4), Some(1.2))].map(spread);
        let brute = brute(speeds, depth_of);
        println!("{anywhere:?}, {waves:?}, {repeats:?}: {brute}");
        for (low, high) in [waves, repeats] {
            assert!((low / brute - 1.0).abs() < 0.01 && (high / brute - 1.0).abs() < 0.01);
        }
        assert!(repeats.1 / repeats.0 < 1.0 + 1e-6 && waves.1 / waves.0 < 1.01);
        assert!(anywhere.1 / anywhere.0 > 1.02);
    }

    #[test]
    fn a_body_that_hardly_moves_goes_over_into_one_that_stands() {
        // Every crest of body 2 passes every point: what is left is the body's own wave.
        let standing = ratio(&mut run([0.0, 2.0], [0.15, 0.15], 20.0));
        let creeping = ratio(&mut run([0.02, 1.98], [0.15, 0.15], 20.0));
        let slow = ratio(&mut run([0.1, 1.9], [0.15, 0.15], 120.0));
        println!("standing {standing:.4}, creeping {creeping:.4}, slow {slow:.4}");
        // As above.
        assert!((creeping / standing - 1.0).abs() < 0.07);
        assert!((slow / standing - 1.0).abs() < 0.07);
    }
}
