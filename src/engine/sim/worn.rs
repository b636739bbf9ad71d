//! Wear, and the axis of loading cycles: heights that are worn are fixed to the material, and passages that are simulated
//! alternate with jumps of many cycles.
//!
//! ```text
//! depth a time       dw_i/dt = k_i s p |U2 − U1|,  s = 1 where asperities touch                         (Archard 1953)
//!                    s = 1 − (h − h_c)/(h_t − h_c)  of films between contact and h_t, if thin ones wear; else 0
//! a loading cycle    r_i(ξ, y) = (λ_i/D_i) Σ_steps Σ_waves dw_i        ξ along one period λ_i of the body, D_i what it travelled
//! jumps              w* = w + ΔN r,   r* the rate with w*,   w ← w + ΔN (r + r*)/2,   error = ΔN max|r* − r|/2
//! ```
//! | symbol | meaning | unit |
//! |---|---|---|
//! | k_i | wear coefficient over hardness | 1/Pa |
//! | h_c, h_t | film at which asperities touch, thinnest that does not wear | m |
//! | w_i | depth worn | m |
//! | λ_i | period of the surface along x; of a smooth body any length: it wears alike all along | m |
//! | ΔN | loading cycles of a jump | |
//!
//! What a node wears is shared among the four columns about it by the weights of cubic interpolation, so that the volume Σ w λ_i/n is ∬∫ k p |U2 − U1| dt as the steps
//! have it. All waves of a body in the domain wear the one that is kept: which crest meets which changes from cycle to cycle.
//! While passages are simulated the heights stay: what one cycle takes, some 1e-13 m, is nothing to them. Only passages that
//! nothing disturbs count, each about as long as the run without ageing (`time.passages`): whole periods of both bodies' waves where
//! there are short ones.
//!
//! The rate of the predicted heights is the first one of the next jump (PEC): one block of passages a jump. A jump is taken
//! again, shorter, where its error over the composite roughness of the new surfaces (of smooth ones the depth that is worn), or
//! that of the mean damage of the places that have no pit yet ([`super::pits`]), exceeds the
//! tolerance; one that wears less than the tolerance itself is always good enough. Over a depth that grows, what a jump
//! leaves would grow with it, and short waves, which wear the faster, swing.

use serde::{Deserialize, Serialize};

use super::motion::BodyTravel;
use super::pits::Pits;
use crate::math::grid::Grid;
use crate::physics::height_map::HeightMap;
use crate::saved::saved;
use crate::solve::traction::TractionLaw;

/// Depth of the first jump, over the composite roughness.
const FIRST: f64 = 0.05;
/// How much longer or shorter the next jump may be.
const GROWTH: [f64; 2] = [0.2, 4.0];
/// Aimed at, of the tolerance.
const SAFETY: f64 = 0.9;
/// Most jumps, those that were taken again too.
pub(super) const MOST_JUMPS: u32 = 2000;

/// What both bodies have lost, and on which cycle they are.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Worn {
    skins: [Option<WornSkin>; 2],
    /// What the material has suffered, where it can be told.
    pub(super) pits: [Option<Pits>; 2],
    /// Distances (a) of body 1, of body 2 and at U where the block of passages began; `None`: nothing is counted yet.
    block: Option<[f64; 3]>,
    age: Option<Ageing>,
}

saved! {
    Worn { parts: skins, pits, age; free: block; }
}

/// One body's.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct WornSkin {
    /// λ_i, in a.
    length: f64,
    columns: usize,
    /// Row of the grid that is y = 0, or next to it.
    middle: usize,
    /// k_i, film units for a pressure of 1 over a distance of a.
    coefficient: f64,
    /// w as the surface is now, film units, shape ny × columns.
    depth: Vec<f64>,
    /// Where the jump began.
    base: Vec<f64>,
    /// r there.
    rate: Vec<f64>,
    /// What the block has worn so far.
    sum: Vec<f64>,
    /// ∬ of all that was counted, film units times a².
    volume: f64,
}

saved! {
    WornSkin {
        same: length, columns, middle, coefficient;
        parts: depth, base, rate, sum;
        free: volume;
    }
    holds |_, saved| saved.volume >= 0.0
}

/// Where the jumps are.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct Ageing {
    /// N that is asked for, and the tolerance.
    target: f64,
    tolerance: f64,
    /// N of the base.
    from: f64,
    /// ΔN of the jump that is tried.
    jump: f64,
    stage: AgeStage,
    jumps: u32,
}

saved! {
    Ageing { same: target, tolerance; free: from, jump, stage, jumps; }
    holds |_, saved| saved.from >= 0.0 && saved.jump >= 0.0
}

/// What the block that is under way is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
enum AgeStage {
    /// The rate of the new surfaces.
    New,
    /// That at the end of the jump that is tried.
    Tried,
    /// Life and rate at the last cycle.
    Last,
    /// Nothing more.
    Done,
}

/// What a block has come to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct BlockEnd {
    /// Loading cycles at which its numbers hold; `None`: the jump before it is taken again.
    pub(super) cycles: Option<f64>,
    /// Whether the surfaces are others now.
    pub(super) moved: bool,
}

/// Fields of a step that wears.
pub(super) struct Rubbing<'a> {
    pub(super) grid: &'a Grid,
    pub(super) law: &'a TractionLaw,
    pub(super) pressure: &'a [f64],
    pub(super) film: &'a [f64],
    /// h_t, film units; 0: contacts alone wear.
    pub(super) thin: f64,
    /// |S| of now, and the step's length (a/U).
    pub(super) sliding: f64,
    pub(super) dt: f64,
    pub(super) travels: [BodyTravel; 2],
    /// What body 1 and 2 travelled in it, in a.
    pub(super) moved: [f64; 2],
}

impl Rubbing<'_> {
    /// s: the part of a pressure over a film that wears.
    fn share(&self, p: f64, h: f64) -> f64 {
        let touch = self.law.contact_film;
        if self.law.is_contact(p, h) {
            1.0
        } else if p > 0.0 && h < self.thin {
            (self.thin - h) / (self.thin - touch)
        } else {
            0.0
        }
    }
}

impl Worn {
    /// Nothing yet. `coefficients`: [`WornSkin::coefficient`] of both; `repeats`: periods in a (`None`: smooth, infinite: it does not
    /// vary along x); `age`: cycles and tolerance; `pits`: sound material, on the columns of [`ring`].
    pub(super) fn new(
        grid: &Grid,
        coefficients: [f64; 2],
        repeats: [Option<f64>; 2],
        age: Option<[f64; 2]>,
        pits: [Option<Pits>; 2],
    ) -> Self {
        let skin = |body: usize| {
            (coefficients[body] > 0.0)
                .then(|| WornSkin::new(grid, coefficients[body], repeats[body]))
        };
        Self {
            skins: [skin(0), skin(1)],
            pits,
            block: None,
            age: age.map(|[target, tolerance]| Ageing {
                target,
                tolerance,
                from: 0.0,
                jump: 0.0,
                stage: AgeStage::New,
                jumps: 0,
            }),
        }
    }

    /// The surfaces as they are on a coarser mesh of the same scene: from that cycle on they age here.
    pub(super) fn take_over(&mut self, coarser: &Self) {
        for pair in self.skins.iter_mut().zip(&coarser.skins) {
            if let (Some(own), Some(other)) = pair {
                own.take_over(other);
            }
        }
        for (pair, skin) in self.pits.iter_mut().zip(&coarser.pits).zip(&self.skins) {
            if let (Some(own), Some(other)) = pair {
                own.take_over(other, |column| base_of(skin.as_ref(), column));
            }
        }
        self.age.clone_from(&coarser.age);
        self.forget_block();
    }

    /// What the material of body `body` has suffered; `None`: nobody knows.
    pub(super) fn known_pits(&self, body: usize) -> Option<&Pits> {
        self.pits[body].as_ref().filter(|pits| pits.is_known())
    }

    /// Whether body `body` loses anything.
    pub(super) fn wears(&self, body: usize) -> bool {
        self.skins[body].is_some()
    }

    /// Loading cycles that the heights of now are of, those of a jump that is tried with them.
    pub(super) fn cycles_now(&self) -> Option<f64> {
        let age = self.age.as_ref()?;
        Some(match age.stage {
            AgeStage::Tried => age.from + age.jump,
            AgeStage::New | AgeStage::Last | AgeStage::Done => age.from,
        })
    }

    /// Whether all cycles that are asked for are done.
    pub(super) fn is_done(&self) -> bool {
        (self.age.as_ref()).is_none_or(|age| age.stage == AgeStage::Done)
    }

    /// Part of the cycles that is done, 0 to 1, by their logarithm.
    pub(super) fn progress(&self) -> f64 {
        self.age.as_ref().map_or(1.0, |age| match age.stage {
            AgeStage::Done => 1.0,
            AgeStage::New | AgeStage::Tried | AgeStage::Last => {
                (1.0 + age.from).ln() / (1.0 + age.target).ln()
            }
        })
    }

    /// Loading cycles that the surfaces have behind them, 1 where no ageing is asked for; and whether jumps ran out.
    pub(super) fn cycles(&self) -> (f64, bool) {
        match &self.age {
            None => (1.0, false),
            Some(age) => match age.stage {
                AgeStage::New => (0.0, false),
                AgeStage::Tried => (age.from + age.jump, false),
                AgeStage::Last | AgeStage::Done => (age.from, age.from < age.target),
            },
        }
    }

    /// Greatest depth that body 1 and 2 have lost, film units: by what is taken off, else by one loading cycle as it is counted
    /// so far.
    pub(super) fn depths(&self, travelled: [f64; 2]) -> [Option<f64>; 2] {
        [0, 1].map(|body: usize| {
            let skin = self.skins[body].as_ref()?;
            let greatest = |field: &[f64]| field.iter().copied().fold(0.0, f64::max);
            Some(match (&self.age, self.block) {
                (Some(_), _) => greatest(&skin.depth),
                (None, None) => 0.0,
                (None, Some(begun)) => {
                    let distance = travelled[body] - begun[body];
                    if distance == 0.0 {
                        return None;
                    }
                    greatest(&skin.sum) * skin.share(distance)
                }
            })
        })
    }

    /// What has been worn off body 1 and 2 in all passages counted, ∬ in film units times a².
    #[cfg(test)]
    fn volumes(&self) -> [f64; 2] {
        [0, 1].map(|body: usize| self.skins[body].as_ref().map_or(0.0, |skin| skin.volume))
    }

    /// Lowers the heights of body `body` by what it has lost.
    pub(super) fn lower(&self, grid: &Grid, body: usize, travel: BodyTravel, heights: &mut [f64]) {
        let begun = (self.age.as_ref()).is_some_and(|age| age.stage != AgeStage::New);
        if let Some(skin) = self.skins[body].as_ref().filter(|_| begun) {
            skin.lower(grid, travel.travelled, heights);
        }
    }

    /// What has been counted of this block is of other conditions.
    pub(super) fn forget_block(&mut self) {
        self.block = None;
        for skin in self.skins.iter_mut().flatten() {
            skin.sum.fill(0.0);
        }
    }

    /// Counts a step that ends at the distance `distance` at U.
    pub(super) fn count(&mut self, step: &Rubbing, distance: f64) {
        let begun = [0, 1].map(|body: usize| step.travels[body].travelled - step.moved[body]);
        self.block
            .get_or_insert([begun[0], begun[1], distance - step.dt]);
        for (skin, travel) in self.skins.iter_mut().zip(step.travels) {
            if let Some(skin) = skin {
                skin.count(step, travel.travelled);
            }
        }
    }

    /// Whether the block of passages is as long as `length` at U.
    pub(super) fn is_block_over(&self, length: f64, distance: f64) -> bool {
        let begun = self.block.map(|begun| begun[2]);
        !self.is_done() && begun.is_some_and(|begun| distance - begun >= length * (1.0 - 1e-9))
    }

    /// Ends the block of passages, and jumps; `roughness`: composite, film units.
    pub(super) fn end_block(&mut self, travelled: [f64; 2], roughness: f64) -> Option<BlockEnd> {
        let begun = self.block?;
        let age = self.age.as_mut()?;
        for (body, skin) in self.skins.iter_mut().enumerate() {
            if let Some(skin) = skin {
                let share = skin.share(travelled[body] - begun[body]);
                skin.sum.iter_mut().for_each(|sum| *sum *= share);
            }
        }
        let end = age.decide(&mut self.skins, &mut self.pits, roughness);
        self.forget_block();
        Some(end)
    }
}

impl Ageing {
    /// What the rates in `sum` mean for the jump.
    fn decide(
        &mut self,
        skins: &mut [Option<WornSkin>; 2],
        pits: &mut [Option<Pits>; 2],
        roughness: f64,
    ) -> BlockEnd {
        let at_base = BlockEnd {
            cycles: Some(self.from),
            moved: false,
        };
        match self.stage {
            AgeStage::Done => at_base,
            AgeStage::Last => {
                self.stage = AgeStage::Done;
                at_base
            }
            AgeStage::New => {
                let fastest = greatest(all(skins).flat_map(|skin| &skin.sum).copied());
                let jump = if fastest > 0.0 && roughness > 0.0 {
                    FIRST * roughness / fastest
                } else {
                    self.target
                };
                for skin in skins.iter_mut().flatten() {
                    skin.begin();
                }
                pits.iter_mut().flatten().for_each(Pits::begin);
                self.stage = AgeStage::Tried;
                self.jump_on(jump, skins);
                BlockEnd {
                    moved: true,
                    ..at_base
                }
            }
            AgeStage::Tried => self.judge(skins, pits, roughness),
        }
    }

    /// Whether the jump was good, and the next one.
    fn judge(
        &mut self,
        skins: &mut [Option<WornSkin>; 2],
        pits: &mut [Option<Pits>; 2],
        roughness: f64,
    ) -> BlockEnd {
        self.jumps += 1;
        let scale = if roughness > 0.0 {
            roughness
        } else {
            let worn = greatest(all(skins).flat_map(|skin| &skin.depth).copied());
            worn.max(f64::MIN_POSITIVE)
        };
        let pairs = || all(skins).flat_map(|skin| skin.sum.iter().zip(&skin.rate));
        let apart = greatest(pairs().map(|(now, then)| (now - then).abs()));
        let fastest = greatest(pairs().map(|(now, then)| now.max(*then)));
        let heights = 0.5 * self.jump * apart / scale;
        let worn_little = self.jump * fastest / scale <= self.tolerance;
        let damage = pits.iter().zip(&*skins).filter_map(|(pits, skin)| {
            Some((pits.as_ref()?).error(self.jump, |column| depth_of(skin.as_ref(), column)))
        });
        let damage = greatest(damage);
        let is_good = (heights <= self.tolerance || worn_little) && damage <= self.tolerance;
        let error = if worn_little {
            damage
        } else {
            heights.max(damage)
        };
        let factor = SAFETY * (self.tolerance / error.max(1e-12)).sqrt();
        let next = self.jump * factor.clamp(GROWTH[0], GROWTH[1]);
        if !is_good && self.jumps < MOST_JUMPS {
            self.jump_on(next, skins);
            return BlockEnd {
                cycles: None,
                moved: true,
            };
        }
        for skin in skins.iter_mut().flatten() {
            skin.accept(self.jump);
        }
        for (pits, skin) in pits.iter_mut().zip(&*skins) {
            if let Some(pits) = pits {
                pits.accept(self.from, self.jump, |column| {
                    depth_of(skin.as_ref(), column)
                });
            }
        }
        self.from += self.jump;
        if self.from >= self.target * (1.0 - 1e-12) || self.jumps >= MOST_JUMPS {
            self.stage = AgeStage::Last;
        } else {
            self.jump_on(next, skins);
        }
        BlockEnd {
            cycles: Some(self.from),
            moved: true,
        }
    }

    /// Heights after a jump of `cycles`, none beyond the last, as the rate at the base foretells them.
    fn jump_on(&mut self, cycles: f64, skins: &mut [Option<WornSkin>; 2]) {
        self.jump = cycles.min(self.target - self.from);
        for skin in skins.iter_mut().flatten() {
            skin.advance(self.jump);
        }
    }
}

fn all(skins: &[Option<WornSkin>; 2]) -> impl Iterator<Item = &WornSkin> {
    skins.iter().flatten()
}

/// What column `column` of a body has lost on the line y = 0, film units.
fn depth_of(skin: Option<&WornSkin>, column: usize) -> f64 {
    skin.map_or(0.0, |skin| skin.depth[skin.middle * skin.columns + column])
}

/// The same where the jump began.
fn base_of(skin: Option<&WornSkin>, column: usize) -> f64 {
    skin.map_or(0.0, |skin| skin.base[skin.middle * skin.columns + column])
}

fn greatest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, f64::max)
}

impl WornSkin {
    fn new(grid: &Grid, coefficient: f64, repeat: Option<f64>) -> Self {
        let (length, columns) = ring(grid, repeat);
        let off = |j: &usize| grid.y(*j).abs();
        let middle = (0..grid.ny).min_by(|one, two| off(one).total_cmp(&off(two)));
        let field = || vec![0.0; grid.ny * columns];
        Self {
            length,
            columns,
            middle: middle.unwrap_or(0),
            coefficient,
            depth: field(),
            base: field(),
            rate: field(),
            sum: field(),
            volume: 0.0,
        }
    }

    /// Column by column as heights are read, between the coarser one's rows linear.
    fn take_over(&mut self, coarser: &Self) {
        let rows = self.depth.len() / self.columns;
        let fields = [
            (&mut self.depth, &coarser.depth),
            (&mut self.base, &coarser.base),
            (&mut self.rate, &coarser.rate),
        ];
        for (own, other) in fields {
            for c in 0..self.columns {
                let n = coarser.columns;
                let place = around(place_in(c, self.columns, n), n);
                for j in 0..rows {
                    own[j * self.columns + c] = of_coarser(other, n, place, (j, rows)).max(0.0);
                }
            }
        }
        self.volume = coarser.volume;
    }

    /// What one loading cycle takes over what `distance` has taken.
    fn share(&self, distance: f64) -> f64 {
        if distance == 0.0 {
            0.0
        } else {
            self.length / distance.abs()
        }
    }

    fn count(&mut self, step: &Rubbing, travelled: f64) {
        let (grid, n) = (step.grid, self.columns);
        let spacing = self.length / n as f64;
        let worn = self.coefficient * step.sliding * step.dt * grid.dx / spacing;
        for j in 0..grid.ny {
            let nodes = j * grid.nx..(j + 1) * grid.nx;
            let (p, h) = (&step.pressure[nodes.clone()], &step.film[nodes]);
            let row = &mut self.sum[j * n..(j + 1) * n];
            for i in 0..grid.nx {
                let share = step.share(p[i], h[i]);
                if share == 0.0 {
                    continue;
                }
                let depth = worn * share * p[i];
                self.volume += depth * spacing * grid.weight(j) / grid.dx;
                let (columns, weights) = around((grid.x(i) - travelled) / spacing, n);
                for (column, weight) in columns.into_iter().zip(weights) {
                    row[column] += weight * depth;
                }
            }
        }
    }

    /// The rate that was counted is that of the base.
    fn begin(&mut self) {
        self.base.clone_from(&self.depth);
        self.rate.clone_from(&self.sum);
    }

    /// Heights as the rate at the base foretells them.
    fn advance(&mut self, cycles: f64) {
        for ((w, base), rate) in self.depth.iter_mut().zip(&self.base).zip(&self.rate) {
            *w = base + cycles * rate;
        }
    }

    /// Heights by both rates, and the next jump's base.
    fn accept(&mut self, cycles: f64) {
        let rates = self.rate.iter().zip(&self.sum);
        for (base, (then, now)) in self.base.iter_mut().zip(rates) {
            *base += 0.5 * cycles * (then + now);
        }
        self.depth.clone_from(&self.base);
        self.rate.clone_from(&self.sum);
    }

    fn lower(&self, grid: &Grid, travelled: f64, heights: &mut [f64]) {
        let n = self.columns;
        for i in 0..grid.nx {
            let place = (grid.x(i) - travelled) * n as f64 / self.length;
            let (columns, weights) = around(place, n);
            for (j, row) in heights.chunks_exact_mut(grid.nx).enumerate() {
                let depth = &self.depth[j * n..(j + 1) * n];
                let pairs = columns.iter().zip(weights);
                let w: f64 = pairs.map(|(&k, weight)| weight * depth[k]).sum();
                row[i] -= w.max(0.0);
            }
        }
    }
}

/// Length (in a) and columns of the ring that stands for a surface which comes again after `repeat` (in a).
pub(super) fn ring(grid: &Grid, repeat: Option<f64>) -> (f64, usize) {
    match repeat {
        Some(wave) if wave.is_finite() => (wave, (wave / grid.dx).round().max(4.0) as usize),
        // The same all along: one column.
        Some(_) | None => (1.0, 1),
    }
}

/// Where column `column` of `n` lies in a ring of `other` columns, in their spacing from its middle.
pub(super) fn place_in(column: usize, n: usize, other: usize) -> f64 {
    (column as f64 - 0.5 * (n - 1) as f64) * other as f64 / n as f64
}

/// Four columns of a ring, and their weights.
pub(super) type Around = ([usize; 4], [f64; 4]);

/// The four of `n` columns in a ring around a place.
pub(super) fn around(place: f64, n: usize) -> Around {
    let middle = 0.5 * (n - 1) as f64;
    let (first, weights) = HeightMap::stencil(place - middle, n);
    let columns = [0, 1, 2, 3].map(|k| (first + k).rem_euclid(n as i64) as usize);
    (columns, weights)
}

/// What a field of `n` columns on half as many rows has around a place and at row `j` of `rows`, linear between its own.
pub(super) fn of_coarser(
    field: &[f64],
    n: usize,
    (columns, weights): Around,
    (j, rows): (usize, usize),
) -> f64 {
    let at = |row: usize| -> f64 {
        let pairs = columns.iter().zip(weights);
        pairs.map(|(&k, weight)| weight * field[row * n + k]).sum()
    };
    if rows == 1 {
        at(0)
    } else {
        0.5 * (at(j / 2) + at(j.div_ceil(2)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::grid::Symmetry;
    use crate::physics::fluid::Viscosity;

    fn dry() -> TractionLaw {
        TractionLaw {
            film: None,
            viscosity: Viscosity::barus(0.0, 1e9),
            boundary: 0.1,
            contact_film: 0.0,
            direction: 1.0,
        }
    }

    fn travel(travelled: f64) -> BodyTravel {
        BodyTravel {
            travelled,
            in_passage: None,
        }
    }

    /// Passes a pressure over both bodies, at U1 = .75 and U2 = 1.25, and hands each step to `worn`.
    fn pass(worn: &mut Worn, grid: &Grid, steps: usize, pressure: impl Fn(&Worn, f64, f64) -> f64) {
        let dt = 0.7 * grid.dx;
        let film = vec![0.0; grid.len()];
        for k in 1..=steps {
            let t = dt * k as f64;
            let travels = [0.75 * t, 1.25 * t];
            let field: Vec<f64> = (0..grid.len())
                .map(|n| pressure(worn, grid.x(n % grid.nx), t))
                .collect();
            let step = Rubbing {
                grid,
                law: &dry(),
                pressure: &field,
                film: &film,
                thin: 0.0,
                sliding: 0.5,
                dt,
                travels: travels.map(travel),
                moved: [0.75 * dt, 1.25 * dt],
            };
            worn.count(&step, t);
        }
    }

    /// A smooth line: k (|Δu|/U_i) times the load a length, whatever the pressure's profile, the slower body by U2/U1 more.
    #[test]
    fn a_smooth_line_loses_what_archard_says() {
        let grid = Grid::new(129, -2.0, 2.0, 0.0, Symmetry::Line);
        for profile in [
            |x: f64| (1.0 - x * x).max(0.0).sqrt(),
            |x: f64| f64::from(u8::from(x.abs() < 0.7)),
        ] {
            let mut worn = Worn::new(
                &grid,
                [1e-3, 2e-3],
                [None, Some(f64::INFINITY)],
                None,
                [None, None],
            );
            pass(&mut worn, &grid, 400, |_, x, _| profile(x));
            let load: f64 = (0..grid.nx).map(|i| profile(grid.x(i)) * grid.dx).sum();
            let t = 0.7 * grid.dx * 400.0;
            let found = worn.depths([0.75 * t, 1.25 * t]);
            for (found, (k, speed)) in found.into_iter().zip([(1e-3, 0.75), (2e-3, 1.25)]) {
                let theirs = k * 0.5 / speed * load;
                assert!((found.unwrap_or(0.0) / theirs - 1.0).abs() < 1e-12);
            }
        }
    }

    const WAVE: f64 = 0.25;
    const K: f64 = 1e-3;

    /// The amplitude of the first harmonic that is left of 1.
    fn amplitude(worn: &Worn) -> f64 {
        use std::f64::consts::TAU;
        let skin = worn.skins[0].as_ref().expect("it wears");
        let n = skin.columns as f64;
        let harmonic = |(c, w): (usize, &f64)| w * (TAU * c as f64 / n).cos();
        1.0 - 2.0 / n * skin.depth.iter().enumerate().map(harmonic).sum::<f64>()
    }

    /// A crest in full contact, p = 1 + c (A cos) at the crests of body 1, over so many e-folds of its height: what is left of it
    /// at a composite roughness of .7, and blocks. The volume of the columns is that of the steps.
    fn aged_crest(e_folds: f64, tolerance: f64) -> (f64, u32) {
        use std::f64::consts::TAU;
        let grid = Grid::new(257, -2.0, 2.0, 0.0, Symmetry::Line);
        let (stiffness, domain) = (0.5, 4.0);
        // The share of its height that a cycle takes.
        let rate = K * 0.5 / 0.75 * domain * stiffness;
        let cycles = e_folds / rate;
        let repeats = [Some(WAVE), None];
        let age = Some([cycles, tolerance]);
        let mut worn = Worn::new(&grid, [K, 0.0], repeats, age, [None, None]);
        let mut blocks = 0;
        while !worn.is_done() {
            pass(&mut worn, &grid, 300, |worn, x, t| {
                let age = worn.age.as_ref();
                let begun = age.is_some_and(|age| age.stage != AgeStage::New);
                let a = if begun { amplitude(worn) } else { 1.0 };
                1.0 + stiffness * a * (TAU * (x - 0.75 * t) / WAVE).cos()
            });
            let t = 0.7 * grid.dx * 300.0;
            let [volume, none] = worn.volumes();
            let skin = worn.skins[0].as_ref().expect("it wears");
            let held = skin.sum.iter().sum::<f64>() * WAVE / skin.columns as f64;
            assert!(blocks > 0 || (volume / held - 1.0).abs() < 1e-12 && none == 0.0);
            assert!(worn.end_block([0.75 * t, 1.25 * t], 0.7).is_some());
            blocks += 1;
        }
        assert_eq!(worn.cycles(), (cycles, false));
        (amplitude(&worn), blocks)
    }

    /// Jumps over an e-fold end within their tolerance.
    #[test]
    fn a_crest_in_full_contact_decays() {
        for (tolerance, allowed) in [(0.02, 0.03), (0.002, 0.003)] {
            let (left, blocks) = aged_crest(1.0, tolerance);
            let left = left / (-1.0_f64).exp();
            println!("tolerance {tolerance}: {blocks} blocks, {left:.5} of what is left");
            assert!((left - 1.0).abs() < allowed);
        }
    }

    /// A crest that is long gone stays gone, however deep the track about it: measured over that depth, jumps would grow until
    /// it swings.
    #[test]
    fn a_crest_that_is_gone_does_not_swing() {
        for tolerance in [0.02, 0.1] {
            let (left, blocks) = aged_crest(40.0, tolerance);
            println!("tolerance {tolerance}: {blocks} blocks, {left:.1e} left");
            assert!(left.abs() < 0.7 * tolerance, "{left}");
        }
    }
}
