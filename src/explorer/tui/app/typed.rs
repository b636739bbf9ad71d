//! A value that is typed for the chosen knob, in the unit that the screen shows.

use super::data::Effect;
use super::state::App;
use crate::tui::action::Action;
use crate::tui::dial::DialState;
use crate::tui::units::{read_number, sig, tick};
use asperity_engine::scene::Knob;

/// Letters of a number, at most.
pub(super) const LONGEST: usize = 12;

impl App {
    /// Whether keys are letters of a value.
    pub fn is_typing(&self) -> bool {
        let in_form = self
            .choice
            .draft
            .as_ref()
            .is_some_and(|draft| draft.typed.is_some());
        self.choice.typing.is_some() || in_form
    }

    /// Begins a value for the chosen knob, unless there is nothing to turn.
    pub(super) fn begin_typing(&mut self) -> Vec<Effect> {
        let dial = &self.choice.dials[self.choice.chosen];
        if let DialState::Dead(reason) = dial.state {
            let line = format!(
                "{}: the surface is {reason}, so there is nothing to turn",
                dial.label
            );
            self.say(line);
        } else {
            self.choice.typing = Some(String::new());
        }
        Vec::new()
    }

    /// What keys do while a value is typed; `None`: none is, or it is no such key.
    pub(super) fn typed(&mut self, action: Action) -> Option<Vec<Effect>> {
        let text = self.choice.typing.as_mut()?;
        match action {
            Action::Letter(letter) if text.chars().count() < LONGEST => text.push(letter),
            Action::Letter(_) => {}
            Action::Erase => drop(text.pop()),
            Action::Close => self.choice.typing = None,
            Action::Enter => return Some(self.set_typed()),
            Action::Quit | Action::Suspend => return None,
            // A click elsewhere leaves it, and does what it does.
            _ => {
                self.choice.typing = None;
                return None;
            }
        }
        Some(Vec::new())
    }

    /// Puts the knob where it was typed, or says in words what is wrong: knob, value, range.
    fn set_typed(&mut self) -> Vec<Effect> {
        let Some(text) = self.choice.typing.take() else {
            return Vec::new();
        };
        let dial = &self.choice.dials[self.choice.chosen];
        let unit = dial.unit(self.view.units);
        let value = read_number(&text).map(|shown| shown / unit.per_si);
        let range = dial.min..=dial.max;
        if let Some(value) = value.filter(|value| range.contains(value)) {
            return self.set(self.choice.chosen, value);
        }
        let [from, to] = [dial.min, dial.max].map(|end| sig(unit.of(end), 3));
        let name = dial.name();
        let said = format!("{name} = {text} is refused: {from} to {to} {}", unit.name);
        self.say(said.trim_end().to_owned());
        Vec::new()
    }

    /// The last line while a value is typed.
    pub fn typing_line(&self) -> Option<String> {
        let text = self.choice.typing.as_ref()?;
        let dial = &self.choice.dials[self.choice.chosen];
        let unit = dial.unit(self.view.units);
        let [from, to] = [dial.min, dial.max].map(|end| tick(unit.of(end)));
        Some(format!(
            "{} = {text}_  ({from} to {to} {}; Enter sets, Esc leaves)",
            dial.name(),
            unit.name
        ))
    }

    /// Puts a knob at the step that is nearest to a value, and chooses it.
    pub(super) fn go_to(&mut self, knob: Knob, value: f64) -> Vec<Effect> {
        let Some(place) = self.choice.dials.iter().position(|dial| dial.answers(knob)) else {
            return Vec::new();
        };
        self.choice.chosen = place;
        let value = self.choice.dials[place].nearest(value);
        self.set(place, value)
    }
}
