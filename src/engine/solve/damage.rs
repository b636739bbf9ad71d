//! Damage of a block of one surface that moves with its body: depth by place along the surface.
//!
//! ```text
//! ξ = x − U t         place on the body, taken modulo the block's length (a wavelength, or the whole track)
//! D(ξ, z) = mean over crossings of Σ_cycles count · (s/p_h)^c      Miner, s: peak of effective stress of the cycle
//! ```
//! Every material point of the line y = 0 that ends a whole crossing adds the damage of its own rainflow
//! spectrum to the column of its place. A pit starts where D is highest. Given relative to the maximum of
//! the smooth contact in pure rolling, D says how many times sooner that place fails.
//!
//! Source: Miner (1945), J. Appl. Mech. 12, A159-A164. Ours: the sum by place on the body.

use serde::{Deserialize, Serialize};

use crate::saved::saved;

/// Shape of a map.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct BlockSpec {
    /// Columns along the surface.
    pub columns: usize,
    /// Depths.
    pub depths: usize,
    /// Length of the block, a.
    pub length: f64,
    /// Place of ξ = 0 in the block, a: the distance from a crest.
    pub offset: f64,
}

/// Damage collected so far.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DamageMap {
    spec: BlockSpec,
    /// Σ damage, `[column · depths + k]`.
    sums: Vec<f64>,
    /// Crossings of each column.
    crossings: Vec<u32>,
}

saved! {
    DamageMap { same: spec; parts: sums, crossings; }
}

/// Where a pit starts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pit {
    /// Middle of the column, distance from a crest (from the start of the track where the body is smooth), a.
    pub place: f64,
    /// Index of the depth.
    pub depth: usize,
    /// D there.
    pub damage: f64,
}

impl DamageMap {
    /// Empty map; at least one column.
    pub fn new(spec: BlockSpec) -> Self {
        let spec = BlockSpec {
            columns: spec.columns.max(1),
            ..spec
        };
        Self {
            sums: vec![0.0; spec.columns * spec.depths],
            crossings: vec![0; spec.columns],
            spec,
        }
    }

    /// Shape.
    pub fn spec(&self) -> &BlockSpec {
        &self.spec
    }

    /// Forgets all.
    pub fn clear(&mut self) {
        self.sums.fill(0.0);
        self.crossings.fill(0);
    }

    /// A crossing of the point at `place` (ξ, a) with the damage of every depth.
    pub fn add(&mut self, place: f64, damage: impl Iterator<Item = f64>) {
        let part = ((place + self.spec.offset) / self.spec.length).rem_euclid(1.0);
        let column = ((part * self.spec.columns as f64) as usize).min(self.spec.columns - 1);
        self.crossings[column] += 1;
        let from = column * self.spec.depths;
        for (sum, damage) in self.sums[from..][..self.spec.depths].iter_mut().zip(damage) {
            *sum += damage;
        }
    }

    /// Mean damage of a crossing; `None` for a column that no point has crossed yet.
    pub fn mean(&self, column: usize, depth: usize) -> Option<f64> {
        let crossings = *self.crossings.get(column)?;
        (crossings > 0).then(|| self.sums[column * self.spec.depths + depth] / f64::from(crossings))
    }

    /// Columns with at least one crossing.
    pub fn filled(&self) -> usize {
        self.crossings.iter().filter(|c| **c > 0).count()
    }

    /// The place of maximum damage; `None` before the first crossing.
    pub fn pit(&self) -> Option<Pit> {
        let width = self.spec.length / self.spec.columns as f64;
        let mut worst: Option<Pit> = None;
        for column in 0..self.spec.columns {
            for depth in 0..self.spec.depths {
                let Some(damage) = self.mean(column, depth) else {
                    continue;
                };
                if damage > worst.map_or(0.0, |pit| pit.damage) {
                    worst = Some(Pit {
                        place: (column as f64 + 0.5) * width,
                        depth,
                        damage,
                    });
                }
            }
        }
        worst
    }

    /// Mean damage over `unit`, `[column · depths + k]`, into `out`; 0 where nothing has crossed.
    pub fn relative_into(&self, unit: f64, out: &mut Vec<f32>) {
        out.resize(self.sums.len(), 0.0);
        for (at, out) in out.iter_mut().enumerate() {
            let mean = self.mean(at / self.spec.depths, at % self.spec.depths);
            *out = mean.map_or(0.0, |damage| (damage / unit) as f32);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_follow_the_body_round_and_round() {
        let mut map = DamageMap::new(BlockSpec {
            columns: 4,
            depths: 2,
            length: 0.8,
            offset: 0.1,
        });
        assert!(map.pit().is_none());
        // ξ = −0.05 + 0.1 = 0.05: column 0; the same place five blocks on; ξ = 0.15: column 1.
        map.add(-0.05, [1.0, 2.0].into_iter());
        map.add(-0.05 + 5.0 * 0.8, [3.0, 2.0].into_iter());
        map.add(0.15, [0.5, 7.0].into_iter());
        assert_eq!(map.mean(0, 0), Some(2.0));
        assert_eq!(map.mean(1, 1), Some(7.0));
        assert_eq!((map.mean(2, 0), map.filled()), (None, 2));
        let pit = map.pit().expect("filled");
        assert!((pit.place - 0.3).abs() < 1e-12 && pit.depth == 1 && pit.damage == 7.0);
        let mut relative = Vec::new();
        map.relative_into(2.0, &mut relative);
        assert_eq!(relative, [1.0, 1.0, 0.25, 3.5, 0.0, 0.0, 0.0, 0.0]);
        map.clear();
        assert!(map.pit().is_none() && map.filled() == 0);
    }
}
