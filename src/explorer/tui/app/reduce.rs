//! What an action does.

use super::data::{Effect, ErrandKind, Pinned};
use super::state::App;
use crate::tui::action::{Action, KEYS};
use crate::tui::choice::Form;
use crate::tui::dial::DialState;
use crate::tui::kinds::{MapKind, Overlay, RunPace, Zoom};
use asperity_engine::sim::Knob;
use asperity_session::run::Command;

impl App {
    /// Does what an action asks, and says what the loop has to do about it.
    pub fn apply(&mut self, action: Action) -> Vec<Effect> {
        let effects = self.applied(action);
        self.keep_frozen_alike();
        effects
    }

    fn applied(&mut self, action: Action) -> Vec<Effect> {
        if let Some(effects) = self.draft_takes(action) {
            return effects;
        }
        if let Some(effects) = self.typed(action).or_else(|| self.lessons_take(action)) {
            return effects;
        }
        match action {
            Action::Quit => vec![Effect::Quit],
            Action::Suspend => vec![Effect::Suspend],
            Action::ChooseNext | Action::ChoosePrevious if self.view.overlay != Overlay::None => {
                self.scroll(action);
                Vec::new()
            }
            Action::ChooseNext => self.choose(self.choice.chosen + 1),
            Action::ChoosePrevious => self.choose(self.choice.chosen + self.choice.dials.len() - 1),
            Action::Choose(place) => self.choose(place),
            Action::Turn(steps) => self.turn(steps),
            Action::TurnFar(steps) => self.turn(steps * self.choice.dials[self.choice.chosen].far),
            Action::Slide(place, fraction) => self.slide(place, fraction),
            Action::Type => self.begin_typing(),
            Action::GoTo(knob, value) => self.go_to(knob, value),
            Action::GoToCell(row, column) => self.go_to_cell(row, column),
            Action::Typical(n) => self.typical(n),
            Action::Home => self.set(
                self.choice.chosen,
                self.choice.dials[self.choice.chosen].home,
            ),
            Action::HomeAll => (0..self.choice.dials.len())
                .flat_map(|place| self.set(place, self.choice.dials[place].home))
                .collect(),
            Action::TogglePause => self.toggle_pause(),
            Action::StepForward => self.step_forward(),
            Action::StepBack => self.step_back(),
            Action::Record => self.errand(ErrandKind::Record),
            Action::View => self.errand(ErrandKind::View),
            Action::Save => self.errand(ErrandKind::Save),
            Action::Write => self.errand(ErrandKind::Write),
            Action::Curve => self.next_curve(),
            Action::OtherCount => self.other_count(),
            Action::Age => self.age(),
            Action::Replay => self.toggle_replay(),
            Action::ReplayFaster(times) => self.replay_faster(times),
            Action::PointBody => self.other_body(),
            Action::PointDepth(by) => self.point_depth(by),
            Action::MovePoint(quarters) => self.move_point(quarters),
            Action::PutPoint(x) => self.put_point(x),
            Action::EndTour => self.leave_tour(),
            Action::NextBeat => self.next_beat(),
            Action::PreviousBeat => self.previous_beat(),
            shown => {
                self.show(shown);
                Vec::new()
            }
        }
    }

    /// Actions that change only what is shown; the others have been done, or mean nothing here.
    fn show(&mut self, action: Action) {
        match action {
            Action::NextMap => self.show_map(self.map_beside(1)),
            Action::PreviousMap => self.show_map(self.map_beside(-1)),
            Action::Zoom => {
                self.view.zoom = match self.view.zoom {
                    Zoom::Contact => Zoom::Domain,
                    Zoom::Domain => Zoom::Contact,
                }
            }
            Action::Probe(x, y) => self.view.probe = Some((x, y)),
            Action::Pin => self.pin(),
            Action::PointQuantity => self.view.point_quantity = self.view.point_quantity.next(),
            Action::Units => self.view.units = self.view.units.next(),
            Action::Contrast => self.view.theme.next_contrast(),
            Action::Help => self.toggle(Overlay::Help),
            Action::Plan => self.toggle(Overlay::Plan),
            Action::Scene => self.toggle_draft(Form::Scene),
            Action::OperatingPoint => self.toggle_draft(self.next_form()),
            Action::Lessons => self.toggle_lessons(),
            Action::Focus(panel) => self.view.focus = panel,
            Action::NextPanel(by) => self.focus_next(by),
            Action::Enter => self.toggle_enlarged(),
            Action::Close => self.close(),
            Action::Quit
            | Action::Suspend
            | Action::ChooseNext
            | Action::ChoosePrevious
            | Action::Choose(_)
            | Action::Turn(_)
            | Action::TurnFar(_)
            | Action::Slide(_, _)
            | Action::Typical(_)
            | Action::GoTo(_, _)
            | Action::GoToCell(_, _)
            | Action::Type
            | Action::Letter(_)
            | Action::Erase
            | Action::Home
            | Action::HomeAll
            | Action::TogglePause
            | Action::StepForward
            | Action::StepBack
            | Action::PointBody
            | Action::PointDepth(_)
            | Action::MovePoint(_)
            | Action::PutPoint(_)
            | Action::Curve
            | Action::OtherCount
            | Action::Age
            | Action::Replay
            | Action::ReplayFaster(_)
            | Action::Record
            | Action::View
            | Action::Save
            | Action::Write
            | Action::EndTour
            | Action::NextBeat
            | Action::PreviousBeat => {}
        }
    }

    /// The next map that the run has something for.
    fn map_beside(&self, by: i32) -> MapKind {
        let mut map = self.view.map.shifted(by);
        let is_cold = (self.frame()).is_none_or(|frame| frame.film_rise_k.is_empty());
        if map == MapKind::Temperature && is_cold {
            map = map.shifted(by);
        }
        map
    }

    fn show_map(&mut self, map: MapKind) {
        // A place in the plane is none below it, or in the past.
        if !(map.is_plane() && self.view.map.is_plane()) {
            self.view.probe = None;
        }
        self.view.map = map;
    }

    /// Moves what lies over the screen, up to its last line.
    fn scroll(&mut self, action: Action) {
        let last = match self.view.overlay {
            // On narrow screens a line takes up to three rows.
            Overlay::Plan => {
                let all = self.run.setup.plan_text.lines().count() + self.run.setup.left_out.len();
                3 * (all + self.cautions().len())
            }
            Overlay::None | Overlay::Help | Overlay::Scene | Overlay::Lessons => KEYS.len(),
        };
        self.view.scroll = if action == Action::ChooseNext {
            (self.view.scroll + 1).min(last as u16)
        } else {
            self.view.scroll.saturating_sub(1)
        };
    }

    fn choose(&mut self, place: usize) -> Vec<Effect> {
        self.choice.chosen = place % self.choice.dials.len();
        Vec::new()
    }

    fn turn(&mut self, steps: i32) -> Vec<Effect> {
        let value = self.choice.dials[self.choice.chosen].turned(steps);
        self.set(self.choice.chosen, value)
    }

    fn slide(&mut self, place: usize, fraction: f64) -> Vec<Effect> {
        if place >= self.choice.dials.len() {
            return Vec::new();
        }
        self.choice.chosen = place;
        let value = self.choice.dials[place].at_fraction(fraction);
        self.set(place, value)
    }

    fn typical(&mut self, n: usize) -> Vec<Effect> {
        match self.choice.dials[self.choice.chosen]
            .typical
            .get(n)
            .copied()
        {
            Some((value, of)) => {
                let effects = self.set(self.choice.chosen, value);
                if !of.is_empty() {
                    let name = self.choice.dials[self.choice.chosen].name();
                    self.say(format!("{name} as of {of}"));
                }
                effects
            }
            None => Vec::new(),
        }
    }

    /// Moves a knob's target; the estimate follows at once, the run when it gets there.
    pub(super) fn set(&mut self, place: usize, value: f64) -> Vec<Effect> {
        let dial = &self.choice.dials[place];
        if let DialState::Dead(reason) = dial.state {
            let line = format!(
                "{}: the surface is {reason}, so there is nothing to turn",
                dial.label
            );
            self.say(line);
            return Vec::new();
        }
        if dial.target == value {
            return Vec::new();
        }
        let command = Command::Set(dial.knob, value);
        self.keep_before();
        self.choice.dials[place].target = value;
        self.choice.set_at[place] = Some(self.now);
        self.run.frames_back = 0;
        self.refresh_estimate();
        let mut effects = vec![Effect::Send(command)];
        effects.extend(self.unsettle());
        effects
    }

    fn toggle_pause(&mut self) -> Vec<Effect> {
        if self.replay_stepped(0) {
            return Vec::new();
        }
        self.run.pace = match self.run.pace {
            RunPace::Running => RunPace::Paused,
            RunPace::Paused => RunPace::Running,
        };
        self.run.step_times.clear();
        self.run.frames_back = 0;
        vec![Effect::Send(Command::Pause)]
    }

    fn step_forward(&mut self) -> Vec<Effect> {
        if self.replay_stepped(1) {
            return Vec::new();
        }
        if self.run.frames_back > 0 {
            self.run.frames_back -= 1;
            return Vec::new();
        }
        let mut effects = self.paused_first();
        effects.push(Effect::Send(Command::StepOnce));
        effects
    }

    fn step_back(&mut self) -> Vec<Effect> {
        if self.replay_stepped(-1) {
            return Vec::new();
        }
        let effects = self.paused_first();
        self.run.frames_back =
            (self.run.frames_back + 1).min(self.run.frames.len().saturating_sub(1));
        effects
    }

    pub(super) fn paused_first(&mut self) -> Vec<Effect> {
        match self.run.pace {
            RunPace::Paused => Vec::new(),
            RunPace::Running => {
                self.run.pace = RunPace::Paused;
                self.run.step_times.clear();
                vec![Effect::Send(Command::Pause)]
            }
        }
    }

    fn errand(&mut self, errand: ErrandKind) -> Vec<Effect> {
        if self.offers(errand) {
            return vec![Effect::Errand(errand)];
        }
        self.say(match errand {
            ErrandKind::Record => "this run is not recorded",
            ErrandKind::View => {
                "no viewer is at hand; `asperity view FILE.rrd` says how to get one"
            }
            ErrandKind::Save => "scenes cannot be saved from here",
            ErrandKind::Write => "nothing can be exported from here",
            ErrandKind::Rebuild => "no other scene can be started from here",
        });
        Vec::new()
    }

    fn pin(&mut self) {
        if self.view.frozen.take().is_some() {
            self.view.pinned = None;
            return;
        }
        self.view.frozen = self.freeze();
        let lives = self.leading_life().zip(self.leading_factors());
        let Some((life_relative, factors)) = lives else {
            self.say("no life to compare with: there is no estimate");
            return;
        };
        self.view.pinned = Some(Pinned {
            life_relative,
            load_factor: factors.load,
            leading: self.leading(),
            slide_roll: self.target(Knob::SlideRoll),
            load_n: self.load_n(),
            p_hertz_pa: self.lives.estimate.p_hertz_pa,
        });
    }

    pub(super) fn toggle(&mut self, overlay: Overlay) {
        // What is asked for is seen, not hidden behind a fault.
        self.run.fault_read |= self.fault().is_some();
        self.view.scroll = 0;
        self.choice.draft = None;
        self.view.overlay = if self.view.overlay == overlay {
            Overlay::None
        } else {
            overlay
        };
    }

    /// The focused panel takes the screen, or gives it back.
    fn toggle_enlarged(&mut self) {
        self.view.enlarged = match self.view.enlarged {
            None => Some(self.view.focus),
            Some(_) => None,
        };
    }

    fn focus_next(&mut self, by: i32) {
        self.view.focus = self.view.focus.shifted(by);
        if self.view.enlarged.is_some() {
            self.view.enlarged = Some(self.view.focus);
        }
    }

    fn close(&mut self) {
        if self.fault().is_some() {
            self.run.fault_read = true;
        } else if self.view.overlay == Overlay::None && self.view.enlarged.is_some() {
            self.view.enlarged = None;
        } else if self.view.overlay == Overlay::None {
            self.view.probe = None;
            self.run.frames_back = 0;
        } else {
            self.view.overlay = Overlay::None;
            self.choice.draft = None;
        }
    }
}
