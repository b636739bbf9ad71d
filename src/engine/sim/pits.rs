//! Damage that loading cycles leave in the material of one body, what of it wear carries off, and where it makes pits.
//!
//! ```text
//! rate           d(ξ, z) = n(z) < law(s_X) >_ξ / (law(s_smooth) N_smooth)       a loading cycle of the body's own
//! in the material D(ξ, ζ) = ∫ d(ξ, ζ − w(ξ, N)) dN      ζ: depth below the new surface, w: what is worn; above w it is gone
//! a pit          where D ≥ 1 at any ζ ≥ w;  A_p: part of the places ξ that have had one
//! without wear   N_p(ξ) = 1/max_z d(ξ, z) of the new surfaces
//! ```
//! | symbol | meaning | unit |
//! |---|---|---|
//! | s_X | greatest effective stress that a point meets in a crossing; `law(s) = <s − u>^c` as in the scene's life | p_h |
//! | n(z) | cycles by their damage, as in the life by damage | |
//! | s_smooth | that of the worst point of the smooth contact in pure rolling, which fails after N_smooth cycles | p_h |
//!
//! N_smooth comes from the scene's calibration point; without one no damage is absolute. Places are those of the line
//! y = 0 along one period of the surface. A smooth body has one place: sooner or later all of it meets the same.
//! Of two rough bodies a place meets a part of the other in a block of passages, not all of it: longer blocks
//! (`time.passages`) bring the rates of single places nearer to their means, and A_p with them.
//!
//! Between depths ln d is read linearly: exact for the e^(−z/l) of a wave. The depths of D stay where they are in the material,
//! so nothing diffuses as the surface comes down on them. With d0 e^(−z/l) and a wear v a cycle D at the surface tends to
//! d0 l/v.
//!
//! Sources: Miner (1945), J. Appl. Mech. 12, A159-A164, for the sum; Morales-Espejel & Brizmer (2011), Tribol. Trans. 54,
//! 625-643, for damage that wear carries off. Ours: the rate from the life's own count and stresses.

use serde::{Deserialize, Serialize};

use super::worn::place_in;
use crate::saved::saved;

/// Rate of a place that nothing has crossed yet.
const UNKNOWN: f64 = -1.0;

/// Of one body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Pits {
    /// ζ, in a.
    depths: Vec<f64>,
    /// a of a unit of film.
    unit: f64,
    /// Of the period that the columns divide, a.
    length: f64,
    /// D at the base of the jump, `[column · depths + k]`.
    damage: Vec<f64>,
    /// d at the base.
    rate: Vec<f64>,
    /// d of the block that ended last.
    now: Vec<f64>,
    /// w at the base by column, a.
    worn: Vec<f64>,
    /// N at which each column had its pit; 0: it has none.
    pitted: Vec<f64>,
    /// N_p of each column without wear; 0: not known.
    unworn: Vec<f64>,
    /// Column and depth of the greatest damage that the material now holds.
    worst: (usize, usize),
    /// Greatest D that the surface now holds.
    greatest: f64,
}

saved! {
    Pits {
        same: depths, unit, length;
        parts: damage, rate, now, worn, pitted, unworn;
        free: worst, greatest;
    }
    holds |own, saved| saved.worst.0 < own.pitted.len() && saved.worst.1 < own.depths.len()
}

/// Cycles until a part of the surface has pits; `None`: not within what is known.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct PitCycles {
    pub(super) first: Option<f64>,
    pub(super) one_percent: Option<f64>,
    pub(super) ten_percent: Option<f64>,
}

impl Pits {
    /// Sound material of a period of `length` (in a) in so many columns; `unit`: a of a unit of film.
    pub(super) fn new((length, columns): (f64, usize), depths: &[f64], unit: f64) -> Self {
        let field = || vec![0.0; columns * depths.len()];
        let row = || vec![0.0; columns];
        Self {
            depths: depths.to_vec(),
            unit,
            length,
            damage: field(),
            rate: field(),
            now: vec![UNKNOWN; columns * depths.len()],
            worn: row(),
            pitted: row(),
            unworn: row(),
            worst: (0, 0),
            greatest: 0.0,
        }
    }

    /// What the same material has suffered by the columns and depths of a coarser mesh: that of the nearest column.
    /// `depth`: what is worn where the jump began, film units.
    pub(super) fn take_over(&mut self, coarser: &Self, depth: impl Fn(usize) -> f64) {
        let (all, n, other) = (self.depths.len(), self.pitted.len(), coarser.pitted.len());
        let nearest = |column: usize, n: usize, other: usize| {
            let place = place_in(column, n, other) + 0.5 * (other - 1) as f64;
            (place.round() as i64).rem_euclid(other as i64) as usize
        };
        for column in 0..n {
            let near = nearest(column, n, other);
            let theirs = near * coarser.depths.len()..(near + 1) * coarser.depths.len();
            let fields = [
                (&mut self.damage, &coarser.damage),
                (&mut self.rate, &coarser.rate),
                (&mut self.now, &coarser.now),
            ];
            for (own, other) in fields {
                for (k, own) in own[column * all..][..all].iter_mut().enumerate() {
                    *own = coarser.read(&other[theirs.clone()], self.depths[k]);
                }
            }
            self.worn[column] = depth(column) * self.unit;
            self.pitted[column] = coarser.pitted[near];
            self.unworn[column] = coarser.unworn[near];
        }
        let same = |depth: &f64| *depth < coarser.depths[coarser.worst.1];
        self.worst = (
            nearest(coarser.worst.0, other, n),
            self.depths.partition_point(same).min(all - 1),
        );
        self.greatest = coarser.greatest;
    }

    /// Takes the rates of a block from `count`, which fills in damage over that of the smooth contact's worst point by place
    /// and depth where it is known, and says whether it is; that contact fails after `cycles`.
    /// A place that nothing has crossed yet has the mean of the others.
    pub(super) fn take(&mut self, cycles: f64, count: impl FnOnce(&mut [f64]) -> bool) {
        self.now.iter_mut().for_each(|rate| *rate *= cycles);
        let is_counted = count(&mut self.now);
        self.now.iter_mut().for_each(|rate| *rate /= cycles);
        if !is_counted {
            return;
        }
        let all = self.depths.len();
        for k in 0..all {
            let known = self
                .now
                .iter()
                .skip(k)
                .step_by(all)
                .filter(|rate| **rate >= 0.0);
            let (sum, n) = known.fold((0.0, 0.0), |(sum, n), rate| (sum + rate, n + 1.0));
            let mean = sum / f64::max(n, 1.0);
            for rate in self
                .now
                .iter_mut()
                .skip(k)
                .step_by(all)
                .filter(|rate| **rate < 0.0)
            {
                *rate = mean;
            }
        }
    }

    /// Whether a block has told any rate: none does where the smooth contact of the calibration point lives for ever.
    pub(super) fn is_known(&self) -> bool {
        self.now.iter().all(|rate| *rate >= 0.0)
    }

    /// The rates that were counted are those of new surfaces.
    pub(super) fn begin(&mut self) {
        self.rate.clone_from(&self.now);
        for (cycles, rates) in self
            .unworn
            .iter_mut()
            .zip(self.now.chunks_exact(self.depths.len()))
        {
            let most = rates.iter().copied().fold(0.0, f64::max);
            *cycles = if most > 0.0 { most.recip() } else { 0.0 };
        }
    }

    /// By how much both rates tell the mean damage of the columns apart after a jump of `cycles`; what is beyond a pit does
    /// not matter. `depth`: what is worn by then, film units.
    pub(super) fn error(&self, cycles: f64, depth: impl Fn(usize) -> f64) -> f64 {
        let all = self.depths.len();
        let mut apart = 0.0;
        for column in 0..self.pitted.len() {
            let worn = depth(column) * self.unit;
            let (mut euler, mut heun) = (0.0_f64, 0.0_f64);
            for (k, &zeta) in self
                .depths
                .iter()
                .enumerate()
                .filter(|(_, zeta)| **zeta >= worn)
            {
                let before = self.damage[column * all + k];
                let [then, now] = self.rates(column, zeta, worn);
                euler = euler.max(before + cycles * then);
                heun = heun.max(before + 0.5 * cycles * (then + now));
            }
            apart += euler.min(1.0) - heun.min(1.0);
        }
        f64::abs(apart) / self.pitted.len() as f64
    }

    /// Adds a jump of `cycles` from `from` by both rates. `depth`: what is worn at its end, film units.
    pub(super) fn accept(&mut self, from: f64, cycles: f64, depth: impl Fn(usize) -> f64) {
        let all = self.depths.len();
        let (mut worst, mut greatest) = (self.worst, 0.0);
        for column in 0..self.pitted.len() {
            let worn = depth(column) * self.unit;
            let before = self.most(column, self.worn[column]).1;
            // The last depth that is worn off goes on as the surface does, so that damage there can be read in between.
            let gone = self.depths.partition_point(|zeta| *zeta < worn);
            for k in gone.saturating_sub(1)..all {
                let [then, now] = self.rates(column, self.depths[k], worn);
                self.damage[column * all + k] += 0.5 * cycles * (then + now);
            }
            self.worn[column] = worn;
            let (k, most) = self.most(column, worn);
            if most >= 1.0 && self.pitted[column] == 0.0 {
                let part = if most > before {
                    ((1.0 - before) / (most - before)).clamp(0.0, 1.0)
                } else {
                    1.0
                };
                self.pitted[column] = (from + part * cycles).max(f64::MIN_POSITIVE);
            }
            if most > greatest {
                (worst, greatest) = ((column, k), most);
            }
        }
        (self.worst, self.greatest) = (worst, greatest);
        self.rate.clone_from(&self.now);
    }

    /// d at the base and of the last block of the material at `zeta`, of which `worn` is gone by then.
    fn rates(&self, column: usize, zeta: f64, worn: f64) -> [f64; 2] {
        let all = self.depths.len();
        let rows = [&self.rate, &self.now].map(|rate| &rate[column * all..][..all]);
        [
            self.read(rows[0], zeta - self.worn[column]),
            self.read(rows[1], zeta - worn),
        ]
        // What nobody knows counts for nothing.
        .map(|rate| rate.max(0.0))
    }

    /// A rate by depth at `z`: its logarithm is linear in between.
    fn read(&self, rates: &[f64], z: f64) -> f64 {
        let last = self.depths.len() - 1;
        let above = self.depths.partition_point(|depth| *depth <= z);
        if above == 0 || above > last {
            return rates[above.min(last)];
        }
        let (low, high) = (self.depths[above - 1], self.depths[above]);
        let part = (z - low) / (high - low);
        between(rates[above - 1], rates[above], part)
    }

    /// Greatest damage of a column of which `worn` is gone, and its depth; at the surface it is read between the depths.
    fn most(&self, column: usize, worn: f64) -> (usize, f64) {
        let all = self.depths.len();
        let damage = &self.damage[column * all..][..all];
        let first = self.depths.partition_point(|zeta| *zeta < worn);
        let at_surface = if first > 0 && first < all {
            let (low, high) = (self.depths[first - 1], self.depths[first]);
            between(
                damage[first - 1],
                damage[first],
                (worn - low) / (high - low),
            )
        } else {
            0.0
        };
        let kept = damage.iter().enumerate().skip(first);
        kept.fold((first.min(all - 1), at_surface), |most, (k, &d)| {
            if d > most.1 { (k, d) } else { most }
        })
    }

    /// A_p.
    pub(super) fn area(&self) -> f64 {
        let pitted = self.pitted.iter().filter(|cycles| **cycles > 0.0).count();
        pitted as f64 / self.pitted.len() as f64
    }

    /// Cycles until there were pits.
    pub(super) fn cycles(&self) -> PitCycles {
        cycles_of(&self.pitted)
    }

    /// The same of surfaces that stay as they were when new.
    pub(super) fn unworn_cycles(&self) -> PitCycles {
        cycles_of(&self.unworn)
    }

    /// Depths ζ, in a.
    pub(super) fn depths(&self) -> &[f64] {
        &self.depths
    }

    /// The period, in a, and its columns.
    pub(super) fn period(&self) -> (f64, usize) {
        (self.length, self.pitted.len())
    }

    /// D of all columns, `[column · depths + k]`; 0 where the material is gone.
    pub(super) fn suffered_into(&self, out: &mut Vec<f32>) {
        out.clear();
        let columns = self.damage.chunks_exact(self.depths.len());
        for (damage, worn) in columns.zip(&self.worn) {
            let kept = |(&d, &zeta): (&f64, &f64)| if zeta < *worn { 0.0 } else { d as f32 };
            out.extend(damage.iter().zip(&self.depths).map(kept));
        }
    }

    /// Where the damage is greatest: place over the period, ζ in a, and D.
    pub(super) fn worst(&self) -> (f64, f64, f64) {
        let place = (self.worst.0 as f64 + 0.5) / self.pitted.len() as f64;
        (place, self.depths[self.worst.1], self.greatest)
    }
}

/// At `part` of the way from one depth to the next: the logarithm is linear.
fn between(one: f64, two: f64, part: f64) -> f64 {
    if one > 0.0 && two > 0.0 {
        one * (two / one).powf(part)
    } else {
        one + part * (two - one)
    }
}

/// Of columns that pit at those cycles; 0: they do not.
fn cycles_of(columns: &[f64]) -> PitCycles {
    let mut cycles: Vec<f64> = columns.iter().copied().filter(|n| *n > 0.0).collect();
    cycles.sort_by(f64::total_cmp);
    let part = |part: f64| {
        let rank = (part * columns.len() as f64).ceil().max(1.0) as usize;
        cycles.get(rank - 1).copied()
    };
    PitCycles {
        first: part(0.0),
        one_percent: part(0.01),
        ten_percent: part(0.1),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rates d0 e^(−z/l) on depths so far apart.
    fn sound(d0: f64, l: f64, spacing: f64) -> Pits {
        let last = (10.0 * l / spacing) as u32;
        let depths: Vec<f64> = (0..=last).map(|k| spacing * f64::from(k)).collect();
        let mut pits = Pits::new((1.0, 1), &depths, 1.0);
        pits.now = depths.iter().map(|z| d0 * (-z / l).exp()).collect();
        pits.begin();
        pits
    }

    /// Without wear a column has its pit after 1/d0 cycles, whatever the jumps.
    #[test]
    fn without_wear_a_pit_comes_after_the_rate_says() {
        for jumps in [1, 7, 100] {
            let mut pits = sound(1e-6, 0.05, 0.02);
            for k in 0..jumps {
                let jump = 3e6 / f64::from(jumps);
                assert!(pits.error(jump, |_| 0.0) < 1e-12);
                pits.accept(f64::from(k) * jump, jump, |_| 0.0);
            }
            let found = pits.cycles().first.expect("it pits");
            assert!((found / 1e6 - 1.0).abs() < 1e-9, "{found}");
            assert_eq!(pits.unworn_cycles().ten_percent, Some(1e6));
            assert_eq!((pits.area(), pits.worst().1), (1.0, 0.0));
        }
    }

    /// Worn by v a cycle, damage at the surface tends to d0 l/v: below 1 there is no pit, above it there is one. Depths l/2, l/4
    /// and l/8 apart are off by less and less.
    #[test]
    fn damage_that_is_carried_off_tends_to_d0_l_over_v() {
        let (d0, l) = (1e-6, 0.05);
        for (ratio, pitted) in [(0.5, 0.0), (0.9, 0.0), (1.2, 1.0), (3.0, 1.0)] {
            let v = d0 * l / ratio;
            let off = [2, 4, 8].map(|parts| {
                let mut pits = sound(d0, l, l / f64::from(parts));
                let jump = l / v / 40.0;
                let mut worst = 0.0_f64;
                for k in 0..6 * 40 {
                    let depth = v * jump * f64::from(k + 1);
                    pits.accept(f64::from(k) * jump, jump, |_| depth);
                    // Five times l is worn: the start is forgotten to e^(−5).
                    if k >= 5 * 40 {
                        worst = worst.max((pits.most(0, depth).1 / ratio - 1.0).abs());
                    }
                }
                assert_eq!(pits.area(), pitted, "{ratio}");
                worst
            });
            println!("d0 l/v = {ratio}, depths l/2, l/4, l/8 apart: off {off:.4?}");
            assert!(off[0] < 0.03 && off[1] < 0.015 && off[2] < 0.01, "{off:?}");
        }
    }
}
