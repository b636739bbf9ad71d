//! The scene behind the screen: as it now is, another of the user's choice, and the stages of the lessons.

use std::sync::Arc;

use super::data::{Effect, ErrandKind};
use super::state::{App, ViewState};
use super::typed::LONGEST;
use crate::tui::action::Action;
use crate::tui::choice::{Draft, Form};
use crate::tui::kinds::{Aged, CurveKind, Overlay};
use crate::tui::tables;
use crate::tui::wiring::{Setup, Shown};
use asperity_engine::plan::Plan;
use asperity_engine::scene::{Age, CycleBasis, Scene, Wear};
use asperity_engine::sim::Stage;

/// Archard's coefficient where a scene has none, 1/Pa: mild wear in boundary contact, K = 1e-8 over a hardness of 7 to 10 GPa.
const MILD_PER_PA: f64 = 1e-18;
/// Loading cycles that surfaces age over.
const CYCLES: f64 = 1e7;
/// What one press makes of the tolerance of a jump: about 2.2 times as many jumps, or as few.
const FASTER: f64 = 5.0;

impl App {
    /// The screen of a new run, which keeps how things are shown, the tour and the pinned life where it can
    /// still be compared with.
    pub fn rebuilt(&mut self, setup: Setup) -> Vec<Effect> {
        let same_contact = setup.scene.contact == self.run.setup.scene.contact
            && (setup.p_hertz_pa / self.run.setup.p_hertz_pa - 1.0).abs() < 1e-9;
        let errands = std::mem::take(&mut self.run.errands);
        let fresh = Self::new(setup, errands, self.view.theme);
        let old = std::mem::replace(self, fresh);
        self.now = old.now;
        // A frozen picture can be looked at beside any other.
        self.view = ViewState {
            overlay: Overlay::None,
            scroll: 0,
            probe: None,
            pinned: old.view.pinned.filter(|_| same_contact),
            ..old.view
        };
        self.lesson = old.lesson;
        self.show_beat()
    }

    /// The scene could not be run; the old run goes on.
    pub fn not_rebuilt(&mut self, reason: String) {
        self.lesson.tour = None;
        self.lesson.staged = None;
        self.say(reason);
    }

    /// The form of numbers that their key opens: the operating point, then the same as on drawings, which it closes.
    pub(super) fn next_form(&self) -> Form {
        match self.choice.draft.as_ref().map(|draft| draft.form) {
            Some(Form::Point | Form::Drawing) => Form::Drawing,
            Some(Form::Scene) | None => Form::Point,
        }
    }

    /// Opens or closes the choice of another scene or operating point; from one to the other the draft stays.
    pub(super) fn toggle_draft(&mut self, form: Form) {
        if let Some(draft) = self
            .choice
            .draft
            .as_mut()
            .filter(|draft| draft.form != form)
        {
            draft.turn_to(form);
        } else if self.view.overlay == Overlay::Scene {
            self.view.overlay = Overlay::None;
            self.choice.draft = None;
        } else if self.offers(ErrandKind::Rebuild) {
            self.run.fault_read |= self.fault().is_some();
            self.view.overlay = Overlay::Scene;
            self.choice.draft = Some(Draft::new(self.scene_now(), form));
        } else {
            self.say("no other scene can be started from here");
        }
    }

    /// Turns a draft's rows with the keys of the knobs; `None`: no draft is open, or it is no such key.
    pub(super) fn draft_takes(&mut self, action: Action) -> Option<Vec<Effect>> {
        let units = self.view.units;
        let draft = self.choice.draft.as_mut()?;
        if let Some(typed) = &mut draft.typed {
            match action {
                Action::Letter(letter) if typed.chars().count() < LONGEST => typed.push(letter),
                Action::Letter(_) => {}
                Action::Erase => drop(typed.pop()),
                Action::Enter => draft.set_typed(units),
                Action::Quit | Action::Suspend => return None,
                _ => draft.typed = None,
            }
            return Some(Vec::new());
        }
        match action {
            Action::ChooseNext => draft.choose(1),
            Action::ChoosePrevious => draft.choose(-1),
            Action::Turn(by) => draft.turn(by),
            Action::TurnFar(by) => draft.turn(3 * by),
            Action::Type => draft.begin_typing(),
            Action::Typical(place) => draft.take_digit(place),
            Action::Home => draft.undo(),
            Action::Enter => return Some(self.run_draft()),
            _ => return None,
        }
        Some(Vec::new())
    }

    fn run_draft(&mut self) -> Vec<Effect> {
        let Some(draft) = self.choice.draft.take_if(|draft| draft.verdict.is_ok()) else {
            // A number that was refused is read; what the scene itself lacks is told again.
            self.choice.draft.iter_mut().for_each(Draft::judge);
            return Vec::new();
        };
        self.view.overlay = Overlay::None;
        self.lesson.tour = None;
        self.lesson.staged = None;
        let name = draft
            .preset
            .map_or_else(|| self.lesson.own_scene.1.clone(), str::to_owned);
        self.lesson.own_scene = (draft.scene.clone().into(), name.clone());
        vec![Effect::Rebuild(Box::new(draft.scene), name)]
    }

    /// The same scene with its cycles counted the other way.
    pub(super) fn other_count(&mut self) -> Vec<Effect> {
        let mut scene = self.scene_now();
        let Some(life) = &mut scene.life else {
            self.say("no life in this scene, and so no count");
            return Vec::new();
        };
        life.cycles = match life.cycles {
            CycleBasis::Damage => CycleBasis::Global,
            CycleBasis::Global | CycleBasis::Peaks => CycleBasis::Damage,
        };
        self.begin_again(scene)
    }

    /// The same scene with surfaces that age, by mild wear where it says nothing else; with new ones.
    pub(super) fn age(&mut self) -> Vec<Effect> {
        let mut scene = self.scene_now();
        let (curve, words) = if scene.age.is_some() {
            scene = scene.with_new_surfaces();
            (CurveKind::Life, "new surfaces".to_owned())
        } else {
            let mild = Wear {
                coefficient_1_per_pa: MILD_PER_PA,
                coefficient_2_per_pa: MILD_PER_PA,
                thin_film_m: 0.0,
            };
            let [one, two] = scene.wear.get_or_insert(mild).coefficients_per_pa();
            scene.age = Some(Age {
                cycles: CYCLES,
                ..Age::default()
            });
            if scene.motion.slide_roll == 0.0 {
                self.say("at S = 0 nothing slides and nothing wears: turn S, then g");
                return Vec::new();
            }
            let words = format!(
                "the surfaces age over {CYCLES:.0e} cycles, by {one:e} and {two:e} 1/Pa where they touch; y: by what"
            );
            (CurveKind::Aged(Aged::Life), words)
        };
        if let Err(error) = scene.validate() {
            self.say(error.to_string());
            return Vec::new();
        }
        let begins = self.begin_again(scene);
        if !begins.is_empty() {
            self.view.curve = curve;
            self.say(words);
        }
        begins
    }

    /// The surfaces age from new again, by fewer and longer jumps, or by more.
    pub(super) fn age_faster(&mut self, times: i32) -> Vec<Effect> {
        let mut scene = self.scene_now();
        let Some(age) = &mut scene.age else {
            self.say("a live run has no speed to choose; o replays a passage that repeats");
            return Vec::new();
        };
        age.tolerance *= FASTER.powi(times);
        let percent = 100.0 * age.tolerance;
        if let Err(error) = scene.validate() {
            self.say(error.to_string());
            return Vec::new();
        }
        let begins = self.begin_again(scene);
        if !begins.is_empty() {
            self.say(format!(
                "from new again: a jump in cycles may err by {percent:.1} % of the roughness"
            ));
        }
        begins
    }

    /// The run of a scene in place of the present one, if it may be.
    fn begin_again(&mut self, scene: Scene) -> Vec<Effect> {
        if self.lesson.tour.is_some() {
            self.say("a lesson keeps its scene; T ends it");
            return Vec::new();
        }
        if !self.offers(ErrandKind::Rebuild) {
            self.say("no other scene can be started from here");
            return Vec::new();
        }
        let name = self.lesson.own_scene.1.clone();
        self.lesson.own_scene = (scene.clone().into(), name.clone());
        vec![Effect::Rebuild(Box::new(scene), name)]
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

    /// What is known of the scene as the knobs have made it; `None`: none is turned.
    pub fn turned_setup(&self) -> Option<Setup> {
        let mut dials = self.choice.dials.iter();
        let is_turned = dials.any(|dial| dial.target != dial.home);
        let scene = is_turned.then(|| self.scene_now())?;
        let plan = Plan::new(&scene).ok()?;
        Some(Setup::of(Arc::new(scene), &self.run.setup.name, &plan))
    }

    /// The scene with the knobs where they are going.
    pub(super) fn scene_now(&self) -> Scene {
        let mut scene = (*self.run.setup.scene).clone();
        // A knob where the scene has it leaves the scene's own words (a load given as a Hertz pressure).
        for dial in self
            .choice
            .dials
            .iter()
            .filter(|dial| dial.target != dial.home)
        {
            dial.knob.put(&mut scene, dial.target);
        }
        scene
    }
}
