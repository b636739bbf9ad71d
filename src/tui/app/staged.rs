//! The scene behind the screen: as it now is, another of the user's choice, and the stages of the lessons.

use std::sync::Arc;

use crate::run::Command;
use crate::scene::Scene;
use crate::sim::Stage;
use crate::tui::action::Action;
use crate::tui::app::{App, Effect, ErrandKind, Overlay};
use crate::tui::choice::Draft;
use crate::tui::lessons::TourState;
use crate::tui::tables;
use crate::tui::wiring::{Setup, Shown};

impl App {
    /// The screen of a new run, which keeps how things are shown, the tour and the pinned life where it can
    /// still be compared with.
    pub fn rebuilt(&mut self, setup: Setup) -> Vec<Effect> {
        let same_contact = setup.scene.contact == self.setup.scene.contact
            && (setup.p_hertz_pa / self.setup.p_hertz_pa - 1.0).abs() < 1e-9;
        let fresh = Self::new(setup, std::mem::take(&mut self.errands), self.theme);
        let old = std::mem::replace(self, fresh);
        self.units = old.units;
        (self.now, self.message) = (old.now, old.message);
        (self.map, self.zoom, self.quantity) = (old.map, old.zoom, old.quantity);
        (self.curve, self.pixels) = (old.curve, old.pixels);
        self.pinned = old.pinned.filter(|_| same_contact);
        (self.staged, self.own) = (old.staged, old.own);
        self.tour = old.tour.map(|tour| tour.anew(0.0));
        match self.tour {
            Some(tour) => self.set_beat(tour),
            None => Vec::new(),
        }
    }

    /// The scene could not be run; the old run goes on.
    pub fn not_rebuilt(&mut self, reason: String) {
        self.tour = None;
        self.staged = None;
        self.say(reason);
    }

    /// Opens or closes the choice of another scene.
    pub(super) fn toggle_draft(&mut self) {
        if self.overlay == Overlay::Scene {
            self.overlay = Overlay::None;
            self.draft = None;
        } else if self.offers(ErrandKind::Rebuild) {
            self.fault_read |= self.fault().is_some();
            self.overlay = Overlay::Scene;
            self.draft = Some(Draft::new(self.scene_now()));
        } else {
            self.say("no other scene can be started from here");
        }
    }

    /// Turns a draft's rows with the keys of the knobs; `None`: no draft is open, or it is no such key.
    pub(super) fn draft_takes(&mut self, action: Action) -> Option<Vec<Effect>> {
        let draft = self.draft.as_mut()?;
        match action {
            Action::ChooseNext => draft.choose(1),
            Action::ChoosePrevious => draft.choose(-1),
            Action::Turn(by) => draft.turn(by),
            Action::TurnFar(by) => draft.turn(3 * by),
            Action::Run => return Some(self.run_draft()),
            _ => return None,
        }
        Some(Vec::new())
    }

    fn run_draft(&mut self) -> Vec<Effect> {
        let Some(draft) = self.draft.take_if(|draft| draft.verdict.is_ok()) else {
            return Vec::new();
        };
        self.overlay = Overlay::None;
        self.tour = None;
        self.staged = None;
        let name = draft
            .preset
            .map_or_else(|| self.own.1.clone(), str::to_owned);
        self.own = (draft.scene.clone().into(), name.clone());
        vec![Effect::Rebuild(Box::new(draft.scene), name)]
    }

    pub(super) fn toggle_tour(&mut self) -> Vec<Effect> {
        if self.tour.take().is_some() {
            return self.end_tour();
        }
        self.overlay = Overlay::None;
        self.draft = None;
        if self.staged.is_none() {
            // What the knobs were turned to is kept for the time after the tour.
            self.own = (self.scene_now().into(), self.setup.name.clone());
        }
        self.begin_lesson(0)
    }

    pub(super) fn next_lesson(&mut self) -> Vec<Effect> {
        self.tour
            .map_or_else(Vec::new, |tour| self.begin_lesson(tour.lesson + 1))
    }

    fn begin_lesson(&mut self, lesson: usize) -> Vec<Effect> {
        self.tour = TourState::begin(lesson, self.passages());
        if let Some(tour) = self.tour {
            self.play(tour)
        } else {
            self.say("that was the last lesson");
            self.end_tour()
        }
    }

    /// Back to the user's own scene.
    fn end_tour(&mut self) -> Vec<Effect> {
        match self.staged.take() {
            Some(_) if self.offers(ErrandKind::Rebuild) => {
                let (scene, name) = &self.own;
                vec![Effect::Rebuild(Box::new((**scene).clone()), name.clone())]
            }
            _ => self.apply(Action::HomeAll),
        }
    }

    /// Plays a beat: its scene first, where it has one that does not run yet; its words go to the recording.
    pub(super) fn play(&mut self, tour: TourState) -> Vec<Effect> {
        let wanted = tour
            .beat()
            .staging
            .filter(|_| self.offers(ErrandKind::Rebuild));
        if let Some(staging) = wanted.filter(|staging| self.staged != Some(*staging)) {
            return match staging.scene() {
                Ok(scene) => {
                    self.staged = Some(staging);
                    vec![Effect::Rebuild(Box::new(scene), staging.preset.to_owned())]
                }
                Err(error) => {
                    self.not_rebuilt(error.to_string());
                    Vec::new()
                }
            };
        }
        let mut effects = Vec::new();
        if tour.beat().staging.is_some() {
            // The same scene again: as it was.
            effects = self.apply(Action::HomeAll);
        }
        effects.extend(self.set_beat(tour));
        effects
    }

    /// What a beat sets, shows and says.
    fn set_beat(&mut self, tour: TourState) -> Vec<Effect> {
        let beat = tour.beat();
        if let Some(map) = beat.map {
            self.map = map;
        }
        let words = format!("{}: {}", tour.lesson().title, beat.caption);
        let mut effects = vec![Effect::Send(Command::Say(words))];
        for (knob, setting) in beat.sets {
            if let Some(place) = self.dials.iter().position(|dial| dial.answers(*knob)) {
                let value = setting.value(&self.dials[place]);
                effects.extend(self.set(place, value));
            }
        }
        effects
    }

    /// What is on the screen, for files; `None` before the passage.
    pub fn shown(&self) -> Option<Shown> {
        let frame = self.frame().filter(|frame| frame.stage == Stage::Passage)?;
        Some(Shown {
            frame: Arc::clone(frame),
            scene_toml: self.scene_toml(),
            tables: tables::of(self, frame),
        })
    }

    /// The scene with the knobs where they are going, as TOML.
    pub fn scene_toml(&self) -> String {
        self.scene_now().to_toml()
    }

    /// The scene with the knobs where they are going.
    pub(super) fn scene_now(&self) -> Scene {
        let mut scene = (*self.setup.scene).clone();
        // A knob where the scene has it leaves the scene's own words (a load given as a Hertz pressure).
        for dial in self.dials.iter().filter(|dial| dial.target != dial.home) {
            dial.knob.put(&mut scene, dial.target);
        }
        scene
    }
}
