//! The life that leads, by its source: simulated, scaled from what was, or the formula alone.

use super::state::{App, point_of};
use crate::tui::dial::Dial;
use crate::tui::kinds::Leading;
use crate::tui::units::sig;
use asperity_engine::physics::estimate::{Anchor, Factors, OperatingPoint};
use asperity_engine::scene::CycleBasis;
use asperity_engine::sim::{Caution, Frame, LifeEstimate, Stage};
use asperity_session::run::Assumed;

impl App {
    /// Of the surfaces of now: as the last block found them where they age.
    pub fn lambda_ratio(&self, frame: &Frame) -> Option<f64> {
        let worn = self.lives.ages.last().and_then(|age| age.lambda_ratio);
        worn.or(frame.metrics.lambda_ratio)
    }

    /// What to know before trusting the frame's numbers, the weightiest first; of what the scene assumes the range, once it is
    /// known.
    pub fn cautions(&self) -> Vec<Caution> {
        let mut cautions = self
            .frame()
            .filter(|frame| frame.stage == Stage::Passage)
            .map_or_else(Vec::new, |frame| frame.cautions());
        for caution in &mut cautions {
            if let Some((what, [low, high])) = self.life_over(caution) {
                let over = match what {
                    Assumed::Phase => {
                        "as the crests of both bodies happen to meet (phase_deg); the band holds it"
                    }
                    Assumed::OilLaw => {
                        "with the other law of flow of sheared oil (lubricant.eyring_flow), half and twice its Eyring stress"
                    }
                };
                caution.text = format!("life {} to {} {over}", sig(low, 3), sig(high, 3));
            }
        }
        cautions
    }

    /// What the scene assumes as a caution says, and the simulated life over its choices, once they are known.
    pub(crate) fn life_over(&self, caution: &Caution) -> Option<(Assumed, [f64; 2])> {
        let what = (Assumed::ALL.into_iter()).find(|what| what.caution() == caution.code)?;
        let life = self.life()?.life_relative;
        Some((what, self.assumed(what)?.of_life(life)))
    }

    /// The band of the simulated life; it holds the phases once they are known.
    pub(crate) fn life_band(&self) -> Option<[f64; 2]> {
        let life = self.life()?;
        let band = [life.life_relative_low, life.life_relative_high];
        Some(match self.assumed(Assumed::Phase) {
            Some(range) => range.of_band(life.life_relative, band),
            None => band,
        })
    }

    /// Which number leads: what was simulated, where that holds for where the knobs are.
    pub fn leading(&self) -> Leading {
        let passes = (self.frame()).is_some_and(|frame| frame.stage == Stage::Passage);
        // A life under knobs that walk is of neither end.
        let walks = self.choice.dials.iter().any(Dial::is_moving);
        let life = self.life().filter(|_| !walks);
        if life.is_some_and(|life| life.settled) {
            Leading::Simulated
        } else if passes && life.is_some() {
            Leading::Settling
        } else if self.lives.anchor.is_some() {
            Leading::Scaled
        } else {
            Leading::Formula
        }
    }

    /// The factors of the life that leads; `None`: the scene computes no life.
    pub fn leading_factors(&self) -> Option<Factors> {
        self.run.setup.scene.life.as_ref()?;
        match (self.leading(), self.life()) {
            (Leading::Simulated | Leading::Settling, Some(life)) => Some(simulated(&life)),
            (Leading::Scaled | Leading::Formula, _) | (_, None) => Some(self.lives.estimate.best()),
        }
    }

    /// The relative life that leads.
    pub fn leading_life(&self) -> Option<f64> {
        match (self.leading(), self.life()) {
            (Leading::Simulated | Leading::Settling, Some(life)) => Some(life.life_relative),
            (Leading::Scaled | Leading::Formula, _) | (_, None) => self.leading_factors()?.life(),
        }
    }

    /// The life by the count that is not the headline's: the paper's, or that by damage.
    pub fn other_life(&self) -> Option<f64> {
        let detail = self.life()?.detail;
        match self.run.setup.scene.life.as_ref()?.cycles {
            CycleBasis::Damage => detail.life_global,
            CycleBasis::Global | CycleBasis::Peaks => detail.life_damage,
        }
    }

    /// Life now over life pinned, what the load costs included.
    pub fn against_pinned(&self) -> Option<f64> {
        let pinned = self.view.pinned?;
        let now = self.leading_life()? * self.leading_factors()?.load;
        Some(now / (pinned.life_relative * pinned.load_factor))
    }

    /// Life at another S by formula, all else as the knobs are.
    pub fn formula_at(&self, slide_roll: f64) -> Option<f64> {
        self.lives
            .loaded
            .factors(&self.lives.basis, slide_roll)
            .life()
    }

    pub(super) fn refresh_estimate(&mut self) {
        let point = point_of(&self.choice.dials);
        if !self.lives.loaded.holds_at(&point) {
            self.lives.loaded = self.lives.basis.loaded(&point);
        }
        self.lives.estimate =
            self.lives
                .basis
                .estimate(&self.lives.loaded, self.lives.anchor.as_ref(), &point);
    }

    /// Lives are scaled from this one from now on.
    pub(super) fn drop_anchor(&mut self, at: &OperatingPoint, life: &LifeEstimate) {
        let known = [
            Some(self.lives.loaded),
            self.lives.anchor.map(|anchor| anchor.loaded),
        ];
        let known = known.into_iter().flatten().find(|one| one.holds_at(at));
        let loaded = known.unwrap_or_else(|| self.lives.basis.loaded(at));
        self.lives.anchor = Some(Anchor::new(
            &self.lives.basis,
            loaded,
            at.slide_roll,
            simulated(life),
        ));
    }
}

fn simulated(life: &LifeEstimate) -> Factors {
    Factors {
        cycle: Some(life.cycle_factor),
        peak: life.peak_factor,
        traction: life.traction_factor,
        load: life.load_factor,
    }
}
