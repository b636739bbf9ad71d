//! Why the life changed: one sentence after each turn of a knob, what changed and by how much.
//!
//! ```text
//! S 0.50→1.00: n 3.9→10, cycles ×0.42, peaks ×1.1, film +8 %, life ×0.46; body 1 governs
//! ```
//! The state before is the last that was simulated and had settled; the state now is the simulation's once it has
//! settled there, and the formula's on both sides until then, which the sentence says.

use super::data::{LifeAccount, SettledMean, StateBefore};
use super::state::App;
use crate::tui::dial::Dial;
use crate::tui::kinds::Leading;
use crate::tui::units::sig;
use asperity_engine::physics::estimate::Factors;
use asperity_engine::sim::Frame;

/// The sentence in parts, of which the last ones give way where there is no room.
#[derive(Debug, Clone, PartialEq)]
pub struct WhyLine {
    /// What was turned.
    pub turned: String,
    /// What it changed, the weightiest first.
    pub changes: Vec<String>,
    /// Who governs.
    pub governs: String,
    /// Whose numbers these are.
    pub of: Leading,
}

/// The larger of two numbers of contacts, and whose it is.
fn most(n: [Option<f64>; 2]) -> (Option<f64>, u8) {
    let [Some(one), Some(two)] = n else {
        return (None, 0);
    };
    let body = match one / two {
        ratio if ratio > 1.01 => 1,
        ratio if ratio < 0.99 => 2,
        _ => 0,
    };
    (Some(one.max(two)), body)
}

impl App {
    /// What the formula says where the knobs are going.
    fn formula_account(&self) -> LifeAccount {
        let (n, body) = most([self.lives.estimate.n_body_1, self.lives.estimate.n_body_2]);
        LifeAccount {
            n,
            factors: self.lives.estimate.formula,
            film_m: self.lives.loaded.film_m,
            body,
        }
    }

    /// What was simulated, once it has settled where the knobs are.
    pub fn account(&self) -> Option<LifeAccount> {
        let frame = self
            .frame()
            .filter(|_| self.leading() == Leading::Simulated)?;
        let life = self.life()?;
        let settled = self.replay.settled.as_ref();
        let settled = settled.filter(|settled| settled.frames.len() > 1);
        let mut film = self.lives.film;
        if let Some(settled) = settled {
            film = SettledMean::default();
            for frame in &settled.frames {
                film.add(frame.metrics.h_mean_m);
            }
        }
        let (n, body) = most([frame.metrics.n_body_1, frame.metrics.n_body_2]);
        Some(LifeAccount {
            n,
            factors: self.leading_factors()?,
            film_m: film.value().unwrap_or(frame.metrics.h_mean_m),
            body: match life.detail.body {
                0 => body,
                governs => governs,
            },
        })
    }

    /// Keeps the state that a knob is turned away from; one that has not settled is none to compare with.
    pub(super) fn keep_before(&mut self) {
        let simulated = self.account();
        if simulated.is_some() || self.choice.before_turn.is_none() {
            self.choice.before_turn = Some(StateBefore {
                targets: self.choice.dials.iter().map(|dial| dial.target).collect(),
                formula: self.formula_account(),
                simulated,
            });
        }
    }

    /// Whether a knob has been turned.
    pub fn was_turned(&self) -> bool {
        self.choice.before_turn.is_some()
    }

    /// The accounts of the state before and of now, of one source.
    pub fn accounts(&self) -> Option<(LifeAccount, LifeAccount, Leading)> {
        self.run.setup.scene.life.as_ref()?;
        let before = self.choice.before_turn.as_ref()?;
        match (before.simulated, self.account()) {
            (Some(then), Some(now)) => Some((then, now, Leading::Simulated)),
            _ => Some((before.formula, self.formula_account(), Leading::Formula)),
        }
    }

    /// What the last turn of a knob changed; `None`: none was turned.
    pub fn why(&self) -> Option<WhyLine> {
        let (then, now, of) = self.accounts()?;
        // A lesson tells what was simulated; the formula may say the contrary of it.
        if of == Leading::Formula && self.lesson.tour.is_some() {
            return None;
        }
        let before = self.choice.before_turn.as_ref()?;
        let places = self.choice.dials.iter().zip(&before.targets);
        let away = places.filter(|(dial, then)| (dial.target - **then).abs() > 1e-9 * then.abs());
        let turned: Vec<String> = away.map(|(dial, then)| self.turned(dial, *then)).collect();
        if turned.is_empty() {
            return None;
        }
        Some(WhyLine {
            turned: turned.join(", "),
            changes: changes(&then, &now),
            governs: match now.body {
                0 => "both bodies alike".to_owned(),
                body => format!("body {body} governs"),
            },
            of,
        })
    }

    /// `S 0.50→1.00`, `load 800→1600 N`.
    fn turned(&self, dial: &Dial, then: f64) -> String {
        let unit = dial.unit(self.view.units);
        let shown = |value: f64| dial.figure(unit.of(value), 3);
        let text = format!(
            "{} {}→{} {}",
            dial.name(),
            shown(then),
            shown(dial.target),
            unit.name
        );
        text.trim_end().to_owned()
    }

    /// What a frame adds to the mean of the settled state.
    pub(super) fn take_film(&mut self, frame: &Frame) {
        let moving = self.choice.dials.iter().any(Dial::is_moving);
        let settled = frame.metrics.life.is_some_and(|life| life.settled);
        if settled && !moving {
            self.lives.film.add(frame.metrics.h_mean_m);
        } else {
            self.lives.film = SettledMean::default();
        }
    }
}

/// What changed, the weightiest first; what did not is left out.
fn changes(then: &LifeAccount, now: &LifeAccount) -> Vec<String> {
    let mut list = Vec::new();
    let mut factor = |name: &str, then: f64, now: f64| {
        let ratio = now / then;
        if ratio.is_finite() && (ratio - 1.0).abs() >= 0.005 {
            list.push(format!("{name} ×{}", sig(ratio, 2)));
        }
    };
    let (old, new) = (&then.factors, &now.factors);
    if let (Some(old), Some(new)) = (old.cycle, new.cycle) {
        factor("cycles", old, new);
    }
    factor("peaks", old.peak, new.peak);
    factor("traction", old.traction, new.traction);
    factor("load", old.load, new.load);
    let film = (then.film_m > 0.0).then(|| now.film_m / then.film_m);
    if let Some(film) = film.filter(|film| (film - 1.0).abs() >= 0.005) {
        let percent = 100.0 * (film - 1.0);
        list.push(if (0.5..2.0).contains(&film) {
            format!("film {percent:+.0} %")
        } else {
            format!("film ×{}", sig(film, 2))
        });
    }
    let n = match (then.n, now.n) {
        (Some(old), Some(new)) if (new / old - 1.0).abs() >= 0.005 => {
            Some(format!("n {}→{}", sig(old, 2), sig(new, 2)))
        }
        (Some(_), None) => Some("a body stands".to_owned()),
        _ => None,
    };
    list.splice(0..0, n);
    let whole = |of: &Factors| of.life().map(|life| life * of.load);
    let [old_load, new_load] = [old.load, new.load];
    match whole(old).zip(whole(new)) {
        Some((old, new)) if (new / old - 1.0).abs() >= 0.005 => {
            let with_load = if (new_load / old_load - 1.0).abs() >= 0.005 {
                "life with the load"
            } else {
                "life"
            };
            list.push(format!("{with_load} ×{}", sig(new / old, 2)));
        }
        Some(_) => list.push("life as before".to_owned()),
        None => {}
    }
    list
}

impl WhyLine {
    /// In so many columns: changes give way from the last but one, the life stays, then who governs.
    pub fn in_columns(&self, columns: usize) -> String {
        let mark = match self.of {
            Leading::Simulated | Leading::Settling => "",
            Leading::Scaled | Leading::Formula => "formula: ",
        };
        let mut changes: Vec<&str> = self.changes.iter().map(String::as_str).collect();
        loop {
            let all = changes.join(", ");
            let whole = format!("{mark}{}: {all}; {}", self.turned, self.governs);
            if whole.chars().count() <= columns {
                return whole;
            }
            let short = format!("{mark}{}: {all}", self.turned);
            if short.chars().count() <= columns || changes.len() <= 1 {
                return short;
            }
            changes.remove(changes.len() - 2);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn account(n: f64, cycle: f64, peak: f64, film_m: f64) -> LifeAccount {
        LifeAccount {
            n: Some(n),
            factors: Factors {
                cycle: Some(cycle),
                peak,
                traction: 0.9,
                load: 1.0,
            },
            film_m,
            body: 1,
        }
    }

    #[test]
    fn what_changed_is_said_by_how_much() {
        let then = account(4.0, 0.25, 0.8, 1.0e-7);
        let now = account(10.0, 0.105, 0.88, 1.08e-7);
        // 0.105/0.25, 0.88/0.8, 0.42 times 1.1.
        assert_eq!(
            changes(&then, &now),
            [
                "n 4.0→10",
                "cycles ×0.42",
                "peaks ×1.1",
                "film +8 %",
                "life ×0.46"
            ]
        );
        assert_eq!(changes(&then, &then), ["life as before"]);
        let mut stands = now;
        (stands.n, stands.factors.cycle) = (None, None);
        assert_eq!(
            changes(&then, &stands),
            ["a body stands", "peaks ×1.1", "film +8 %"]
        );
        let mut thick = then;
        (thick.film_m, thick.factors.load) = (3.0e-7, 0.05);
        assert_eq!(
            changes(&then, &thick),
            ["load ×0.050", "film ×3.0", "life with the load ×0.050"]
        );
        let dry = LifeAccount {
            film_m: 0.0,
            ..then
        };
        assert_eq!(changes(&dry, &dry), ["life as before"]);
    }

    #[test]
    fn where_there_is_no_room_the_life_stays() {
        let line = WhyLine {
            turned: "S 0.50→1.00".to_owned(),
            changes: ["n 4.0→10", "cycles ×0.42", "peaks ×1.1", "life ×0.46"]
                .map(str::to_owned)
                .to_vec(),
            governs: "body 1 governs".to_owned(),
            of: Leading::Simulated,
        };
        let whole = "S 0.50→1.00: n 4.0→10, cycles ×0.42, peaks ×1.1, life ×0.46; body 1 governs";
        assert_eq!(line.in_columns(80), whole);
        assert_eq!(
            line.in_columns(62),
            "S 0.50→1.00: n 4.0→10, cycles ×0.42, peaks ×1.1, life ×0.46"
        );
        assert_eq!(line.in_columns(40), "S 0.50→1.00: n 4.0→10, life ×0.46");
        assert_eq!(line.in_columns(5), "S 0.50→1.00: life ×0.46");
        let formula = WhyLine {
            of: Leading::Formula,
            ..line
        };
        assert!(
            formula
                .in_columns(120)
                .starts_with("formula: S 0.50→1.00: n")
        );
    }
}
