//! What a run comes to, in three lines: the life with its band and the range of models; what takes it, of which body; how far
//! to trust it. Report, recording, summary and screen say it in these words.
//!
//! ```text
//! life_relative = cycle_factor · peak_factor · traction_factor       cycle_factor = basis_factor · own cycles
//! ```
//! What takes the life is the least of own cycles, peaks and traction. The basis takes none: it is the change of unit from
//! a body's own loading cycles to those of the faster one, in which damage is counted (`damage_count.rs`).

use std::fmt;

use serde::{Deserialize, Serialize};

use super::{Caution, CautionCode, Frame, LifeEstimate, Summary};
use crate::math::number::sig;

/// Mechanism that takes most of the life.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Cause {
    /// More stress cycles in a passage than one.
    Cycles,
    /// Pressure above the smooth contact's.
    Peaks,
    /// Friction.
    Traction,
    /// None of them takes as much as a hundredth.
    Nothing,
}

/// What a mechanism takes before it has a name.
const WORTH_A_WORD: f64 = 0.99;

impl Cause {
    /// Of the factors of own cycles, peaks and traction.
    fn of(factors: [f64; 3]) -> Self {
        let causes = [Self::Cycles, Self::Peaks, Self::Traction];
        let taking = causes.into_iter().zip(factors);
        let taking = taking.filter(|(_, factor)| *factor < WORTH_A_WORD);
        let most = taking.min_by(|one, two| one.1.total_cmp(&two.1));
        most.map_or(Self::Nothing, |(cause, _)| cause)
    }

    /// In a few words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Cycles => "cycles take it",
            Self::Peaks => "peaks take it",
            Self::Traction => "traction takes it",
            Self::Nothing => "nothing takes any of it",
        }
    }
}

impl LifeEstimate {
    /// Cycles of the governing body in its own loading cycles, as a factor of life.
    pub fn own_cycle_factor(&self) -> f64 {
        self.cycle_factor / self.basis()
    }

    /// The change of unit in the cycle factor; 1 where it is not known, as of what was read from a recording.
    pub fn basis(&self) -> f64 {
        match self.detail.basis_factor {
            basis if basis > 0.0 => basis,
            _ => 1.0,
        }
    }

    /// What takes most of the life.
    pub fn cause(&self) -> Cause {
        Cause::of([
            self.own_cycle_factor(),
            self.peak_factor,
            self.traction_factor,
        ])
    }
}

/// The numbers of it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Numbers {
    life: f64,
    band: [f64; 2],
    models: [f64; 2],
    /// Over laws of the oil; `None`: not known.
    oil: Option<[f64; 2]>,
    paper: Option<f64>,
    /// Own cycles, peaks, traction, basis.
    factors: [f64; 4],
    load_factor: f64,
    /// Whether the band holds the phases too.
    with_phases: bool,
    body: u8,
    is_calibrated: bool,
}

/// Three lines.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Headline {
    /// Life, band, range of models, the paper's count.
    pub life: String,
    /// What takes it, of which body.
    pub because: String,
    /// How far to trust it.
    pub trust: String,
}

impl Frame {
    /// What this frame's life comes to; `None`: there is none yet.
    pub fn headline(&self) -> Option<Headline> {
        let life = self.metrics.life.as_ref()?;
        let detail = &life.detail;
        let numbers = Numbers {
            life: life.life_relative,
            band: [life.life_relative_low, life.life_relative_high],
            models: [detail.spread_low, detail.spread_high],
            oil: None,
            paper: detail.life_global,
            factors: [
                life.own_cycle_factor(),
                life.peak_factor,
                life.traction_factor,
                life.basis(),
            ],
            load_factor: life.load_factor,
            with_phases: false,
            body: detail.body,
            is_calibrated: detail.cycles.is_some(),
        };
        Some(numbers.told(&self.cautions()))
    }
}

impl Summary {
    /// What the run comes to; `None`: it has no life.
    pub fn headline(&self) -> Option<Headline> {
        let (cycle, basis) = self.cycle_factor.zip(self.basis_factor)?;
        let numbers = Numbers {
            life: self.life_relative?,
            band: [self.life_relative_low?, self.life_relative_high?],
            models: [self.life_models_low?, self.life_models_high?],
            oil: (self.life_oil_low.zip(self.life_oil_high)).map(|(low, high)| [low, high]),
            paper: self.life_global,
            factors: [
                cycle / basis,
                self.peak_factor?,
                self.traction_factor?,
                basis,
            ],
            load_factor: self.load_factor?,
            with_phases: self.life_phases_low.is_some(),
            body: self.life_body?,
            is_calibrated: self.life_cycles.is_some(),
        };
        Some(numbers.told(&self.cautions))
    }
}

fn range([low, high]: [f64; 2]) -> String {
    format!("{} to {}", sig(low, 3), sig(high, 3))
}

impl Numbers {
    fn told(&self, cautions: &[Caution]) -> Headline {
        Headline {
            life: self.life(),
            because: self.because(),
            trust: self.trust(cautions),
        }
    }

    fn life(&self) -> String {
        let paper = self.paper.map_or_else(String::new, |life| {
            format!("; by the count of Pu et al. (2016) {}", sig(life, 3))
        });
        let common = if self.load_factor.ln().abs() > 0.01 {
            format!(
                "; {} at the load and speed that the run began with",
                sig(self.life * self.load_factor, 3)
            )
        } else {
            String::new()
        };
        let band = if self.with_phases {
            "band over mesh and phases"
        } else {
            "numerical band"
        };
        let oil = (self.oil).map_or_else(String::new, |oil| {
            format!("; laws of the oil {}", range(oil))
        });
        format!(
            "{} of smooth rolling at its own load; {band} {}; choices of count and model {}{oil}{paper}{common}",
            sig(self.life, 3),
            range(self.band),
            range(self.models)
        )
    }

    fn because(&self) -> String {
        let [cycles, peaks, traction, basis] = self.factors;
        let unit = if (basis - 1.0).abs() > 1e-6 {
            format!(
                " x basis {} (its loading cycles are counted in the faster body's)",
                sig(basis, 3)
            )
        } else {
            String::new()
        };
        format!(
            "{}: peaks x {}, traction x {}, cycles x {}{unit}; body {} governs",
            Cause::of([cycles, peaks, traction]).words(),
            sig(peaks, 3),
            sig(traction, 3),
            sig(cycles, 3),
            self.body
        )
    }

    /// The widest of the doubts, and the weightiest caution that is none of them.
    fn trust(&self, cautions: &[Caution]) -> String {
        let doubt = |range| Doubt::of(self.life, range);
        let (mesh, models, oil) = (doubt(self.band), doubt(self.models), self.oil.map(doubt));
        let known = [Some(mesh), Some(models), oil].into_iter().flatten();
        let widest = known.map(Doubt::most).fold(1.0, f64::max);
        // What nobody has computed is no reason for trust.
        let says_oil = cautions.iter().any(|one| one.code == CautionCode::OilLaw);
        let is_open = says_oil && oil.is_none();
        let use_it = match widest {
            ..1.25 if !is_open => "to a quarter",
            ..2.0 if !is_open => "to a factor of two",
            ..10.0 => "as an order of magnitude; compare, do not predict",
            _ => "in its direction alone",
        };
        let what = if self.with_phases {
            "mesh, time step and phases"
        } else {
            "mesh and time step"
        };
        let absolute = if self.is_calibrated {
            ""
        } else {
            "; relative only, without a calibration point"
        };
        let other = |caution: &&Caution| {
            !matches!(
                caution.code,
                CautionCode::ModelRange | CautionCode::ElasticOnly
            )
        };
        let oil = match oil {
            Some(oil) => format!(", oil's law {oil}"),
            None if is_open => ", oil's law not varied here".to_owned(),
            None => String::new(),
        };
        let caution = cautions.iter().find(other);
        let caution = caution.map_or_else(String::new, |one| format!("; {}", one.text));
        format!("{use_it}: {what} {mesh}, count and model {models}{oil}{absolute}{caution}")
    }
}

/// How many times shorter and longer than it is said a life may be.
#[derive(Debug, Clone, Copy)]
struct Doubt {
    shorter: f64,
    longer: f64,
}

impl Doubt {
    fn of(life: f64, [low, high]: [f64; 2]) -> Self {
        Self {
            shorter: (life / low).max(1.0),
            longer: (high / life).max(1.0),
        }
    }

    fn most(self) -> f64 {
        self.shorter.max(self.longer)
    }
}

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [shorter, longer] = [self.shorter, self.longer].map(|times| sig(times, 3));
        if shorter == longer {
            write!(f, "x {longer} either way")
        } else {
            write!(f, "{shorter} times less to {longer} times more")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::LifeDetail;

    fn frame(factors: [f64; 4]) -> Frame {
        let [cycles, peaks, traction, basis] = factors;
        let mut frame = Frame::default();
        frame.metrics.life = Some(LifeEstimate {
            cycle_factor: cycles * basis,
            peak_factor: peaks,
            traction_factor: traction,
            life_relative: cycles * basis * peaks * traction,
            life_relative_low: 0.09,
            life_relative_high: 0.11,
            load_factor: 1.0,
            settled: true,
            detail: LifeDetail {
                body: 2,
                basis_factor: basis,
                spread_low: 0.05,
                spread_high: 0.2,
                variants: 3,
                ..LifeDetail::default()
            },
            ..LifeEstimate::default()
        });
        frame
    }

    #[test]
    fn the_least_factor_is_the_cause_and_the_basis_is_none() {
        let table = [
            ([1.0, 0.11, 0.95, 1.0], Cause::Peaks),
            ([0.2, 0.7, 0.95, 1.67], Cause::Cycles),
            ([0.999, 0.98, 0.7, 1.0], Cause::Traction),
            // A unit is no mechanism, however small.
            ([1.0, 1.02, 0.995, 0.1], Cause::Nothing),
        ];
        for (factors, cause) in table {
            let frame = frame(factors);
            let life = frame.metrics.life.expect("given");
            assert_eq!(life.cause(), cause, "{factors:?}");
            let told = frame.headline().expect("a life");
            assert!(told.because.starts_with(cause.words()), "{}", told.because);
            assert!(told.because.ends_with("body 2 governs"), "{}", told.because);
            let [_, _, _, basis] = factors;
            assert_eq!(told.because.contains("basis"), basis.ln().abs() > 1e-6);
        }
    }

    #[test]
    fn doubts_are_told_with_their_factors() {
        let mut frame = frame([1.0, 0.1, 1.0, 1.0]);
        let told = frame.headline().expect("a life");
        assert!(
            told.life.starts_with("0.100 of smooth rolling"),
            "{}",
            told.life
        );
        assert!(told.life.contains("0.0900 to 0.110"), "{}", told.life);
        assert!(told.life.contains("0.0500 to 0.200"), "{}", told.life);
        assert!(
            told.trust.contains("count and model x 2.00 either way"),
            "{}",
            told.trust
        );
        frame
            .metrics
            .life
            .as_mut()
            .expect("given")
            .detail
            .spread_low = 0.1;
        let told = frame.headline().expect("a life");
        let words = "count and model 1.00 times less to 2.00 times more";
        assert!(told.trust.contains(words), "{}", told.trust);
        assert!(
            told.trust.starts_with("as an order of magnitude"),
            "{}",
            told.trust
        );
        frame.metrics.life.as_mut().expect("given").load_factor = 0.05;
        let told = frame.headline().expect("a life");
        assert!(
            told.life
                .ends_with("; 0.00500 at the load and speed that the run began with"),
            "{}",
            told.life
        );
        assert_eq!(Frame::default().headline(), None);
    }
}
