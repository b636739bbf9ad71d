//! Lives of both bodies by each count and integral, and the one that governs.

use super::{LifeStage, Now};
use crate::physics::cycles::{BodyId, speed_ratios};
use crate::physics::fatigue::LifeFactors;
use crate::physics::life_models::CycleProfile;
use crate::scene::{BodyChoice, CycleBasis, Spread};
use crate::sim::counting::Counting;
use crate::sim::variant::{LifeIntegral, Variant};
use crate::solve::life::factors;

impl LifeStage {
    /// Factors of both bodies; `None` for a body that stands or is not counted yet, and for all where
    /// nothing was sampled, or the smooth contact lives for ever.
    pub(super) fn lives(
        &self,
        variant: &Variant,
        basis: CycleBasis,
        now: &Now,
        counting: Option<&Counting>,
    ) -> Option<[Option<LifeFactors>; 2]> {
        let integral = LifeIntegral::of(basis);
        let shares = variant.shares(integral)?;
        Some(BodyId::BOTH.map(|body| {
            let profile = cycle_profile(body, basis, now.n[body.index()], counting)?;
            let ln_reference = self.ln_reference(variant, body, integral, now.size);
            // Nothing is relative to what lives for ever.
            ln_reference.is_finite().then_some(())?;
            let f = factors(self.law, shares, body, ln_reference, profile);
            f.relative.is_finite().then_some(f)
        }))
    }

    /// The body that gives the life.
    pub(super) fn governing(
        &self,
        lives: [Option<LifeFactors>; 2],
    ) -> Option<(BodyId, LifeFactors)> {
        let of = |body: BodyId| lives[body.index()].map(|f| (body, f));
        match self.asked.body {
            BodyChoice::Body1 => of(BodyId::One),
            BodyChoice::Body2 => of(BodyId::Two),
            BodyChoice::Weaker => BodyId::BOTH
                .into_iter()
                .filter_map(of)
                .min_by(|a, b| a.1.relative.total_cmp(&b.1.relative)),
        }
    }

    /// Both bodies together, in time, relative to both bodies of the reference.
    pub(super) fn system(&self, lives: [Option<LifeFactors>; 2], s: f64) -> Option<f64> {
        let [one, two] = lives;
        let own = speed_ratios(s).map(f64::abs);
        let turns = match self.asked.cycles {
            CycleBasis::Damage => [own[0].max(own[1]); 2],
            CycleBasis::Global | CycleBasis::Peaks => own,
        };
        let time = |f: Option<LifeFactors>, turns: f64| Some(f?.relative / turns);
        let both = self
            .law
            .system_life(time(one, turns[0])?, time(two, turns[1])?);
        let life = both / self.law.system_life(1.0, 1.0);
        life.is_finite().then_some(life)
    }

    /// Minimum and maximum life over the variants and cycle bases, and how many. Crests that the contact does not feel are left
    /// out of the formula's count: no choice of model makes them press.
    pub(super) fn spread(
        &self,
        now: &Now,
        counting: Option<&Counting>,
        life: f64,
    ) -> (f64, f64, u32) {
        let (mut low, mut high, mut count) = (life, life, 0);
        if self.asked.spread == Spread::Off {
            return (low, high, 1);
        }
        let now = Now {
            n: now.n_felt,
            ..*now
        };
        for variant in &self.variants {
            for basis in CycleBasis::ALL {
                let lives = self.lives(variant, basis, &now, counting);
                if let Some((_, f)) = lives.and_then(|lives| self.governing(lives)) {
                    (low, high) = (low.min(f.relative), high.max(f.relative));
                    count += 1;
                }
            }
        }
        (low, high, count)
    }
}

/// How often a body is stressed by that count; `None`: not known yet.
fn cycle_profile(
    body: BodyId,
    basis: CycleBasis,
    n: Option<f64>,
    counting: Option<&Counting>,
) -> Option<CycleProfile<'_>> {
    match basis {
        // A body that stands has no cycles of its own, but those of the other.
        CycleBasis::Damage => counting?.profile(body, basis),
        CycleBasis::Global => Some(CycleProfile::Global(n?)),
        CycleBasis::Peaks => {
            n?;
            counting?.profile(body, basis)
        }
    }
}
