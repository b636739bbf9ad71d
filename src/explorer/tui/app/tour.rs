//! The lessons: their list, their beats, what they ask and what is then told.

use std::sync::Arc;
use std::time::Duration;

use super::data::{Effect, ErrandKind};
use super::state::App;
use crate::tui::action::Action;
use crate::tui::dial::Dial;
use crate::tui::kinds::{CurveKind, Overlay, RunPace};
use crate::tui::lessons::{
    ComparedWith, FoundAnswer, Lesson, LessonQuestion, TourPhase, TourState,
};
use asperity_session::run::Command;

impl App {
    /// Begins a lecturer's own lesson, which then leads the list.
    pub fn teach(&mut self, own: Arc<Lesson>) -> Vec<Effect> {
        self.lesson.all = std::iter::once(own)
            .chain(self.lesson.all.iter().cloned())
            .collect();
        self.begin_beat(0, 0)
    }

    /// Opens or closes the list of lessons.
    pub(super) fn toggle_lessons(&mut self) {
        self.toggle(Overlay::Lessons);
        self.lesson.chosen = self
            .lesson
            .tour
            .as_ref()
            .map_or(self.lesson.chosen, |tour| tour.place);
    }

    /// Keys that mean something else in the list of lessons, or while a question waits; `None`: they do not.
    pub(super) fn lessons_take(&mut self, action: Action) -> Option<Vec<Effect>> {
        let all = self.lesson.all.len();
        if self.view.overlay == Overlay::Lessons {
            match action {
                Action::ChooseNext => self.lesson.chosen = (self.lesson.chosen + 1) % all.max(1),
                Action::ChoosePrevious => {
                    self.lesson.chosen = (self.lesson.chosen + all - 1) % all.max(1);
                }
                Action::Enter => return Some(self.begin_beat(self.lesson.chosen, 0)),
                Action::Typical(place) if place < all => return Some(self.begin_beat(place, 0)),
                _ => return None,
            }
            return Some(Vec::new());
        }
        match (self.lesson.tour.as_ref(), action) {
            (Some(tour), Action::Typical(_)) if tour.phase != TourPhase::Asks => {
                // An answer that comes late turns no knob.
                self.say("digits answer while a question is asked");
                Some(Vec::new())
            }
            (Some(tour), Action::Typical(place)) => {
                let answers = tour.beat().question.as_ref()?.answers.len();
                if place >= answers {
                    self.say(format!("answers are 1 to {answers}"));
                    return Some(Vec::new());
                }
                Some(self.answer(Some(place)))
            }
            _ => None,
        }
    }

    /// What the lesson shows when its question has been answered, or was passed over.
    fn answer(&mut self, said: Option<usize>) -> Vec<Effect> {
        let (passages, now) = (self.passages(), self.now);
        if let Some(tour) = &mut self.lesson.tour {
            tour.said = said;
            tour.show(passages, now);
        }
        self.play()
    }

    /// A key: to what is shown, to the answer, to the next beat, to the next lesson.
    pub(super) fn next_beat(&mut self) -> Vec<Effect> {
        let passages = self.passages();
        let Some(tour) = &self.lesson.tour else {
            self.say("no lesson: t lists them");
            return Vec::new();
        };
        let tells = tour.beat().question.is_some() && tour.is_shown(passages);
        match tour.phase {
            TourPhase::Shows if tour.beat().question.is_none() && self.is_awaited(tour) => {
                self.say("what comes next is compared with this: it has not settled yet");
                Vec::new()
            }
            TourPhase::Asks => self.answer(None),
            TourPhase::Shows if tells => match self.not_yet(tour) {
                Some(why) => {
                    self.say(why);
                    Vec::new()
                }
                None => self.tell(),
            },
            TourPhase::Shows | TourPhase::Tells(_) if tour.goes_on() => {
                self.begin_beat(tour.place, tour.beat + 1)
            }
            TourPhase::Shows | TourPhase::Tells(_) => self.begin_beat(tour.place + 1, 0),
        }
    }

    /// Back: to the question of this beat if it has been answered, else to the beat before.
    pub(super) fn previous_beat(&mut self) -> Vec<Effect> {
        let Some(tour) = &self.lesson.tour else {
            self.say("no lesson: t lists them");
            return Vec::new();
        };
        let answered = tour.beat().question.is_some() && tour.phase != TourPhase::Asks;
        let place = tour.place;
        let beat = if answered {
            tour.beat
        } else {
            tour.beat.saturating_sub(1)
        };
        // What a beat is compared with is the end of the one before it, as it was the first time.
        let mut befores = tour.befores.clone();
        befores.truncate(beat);
        self.lesson.restage = true;
        let mut effects = self.begin_beat(place, beat);
        if let Some(tour) = &mut self.lesson.tour {
            tour.before = befores.last().cloned().flatten();
            tour.befores = befores;
        }
        // A question is asked of the scene as the lesson begins it, and not of its answer.
        if self.is_asked() {
            effects.extend(self.staged());
        }
        effects
    }

    /// Time and passages: what is due is told, what was read gives way to the next beat. The run's or the replay's pause
    /// is the lesson's.
    pub(super) fn tour_on(&mut self) -> Vec<Effect> {
        let (passages, now) = (self.passages(), self.now);
        let Some(tour) = &self.lesson.tour else {
            return Vec::new();
        };
        let shown = tour.is_shown(passages) && self.not_yet(tour).is_none();
        match tour.phase {
            TourPhase::Shows if shown && tour.beat().question.is_some() => self.tell(),
            TourPhase::Shows if !shown => Vec::new(),
            TourPhase::Shows | TourPhase::Tells(_)
                if tour.goes_on() && tour.is_read(now) && !self.stands() =>
            {
                self.begin_beat(tour.place, tour.beat + 1)
            }
            TourPhase::Asks | TourPhase::Shows | TourPhase::Tells(_) => Vec::new(),
        }
    }

    /// Why what was found cannot be told yet: it would be of another state.
    fn not_yet(&self, tour: &TourState) -> Option<&'static str> {
        if self.is_turning() {
            return Some("the knobs are still on their way");
        }
        if self.is_ageing() {
            return Some("the surfaces are not that old yet");
        }
        let moves = self.life().is_some_and(|life| !life.settled);
        (moves && !tour.is_overdue(self.passages())).then_some("the average still moves")
    }

    /// Whether a question waits for its answer.
    pub fn is_asked(&self) -> bool {
        let tour = self.lesson.tour.as_ref();
        tour.is_some_and(|tour| tour.phase == TourPhase::Asks)
    }

    /// Whether a knob is under way to where it was set.
    fn is_turning(&self) -> bool {
        let far = |dial: &Dial| (dial.now - dial.target).abs() > 1e-6 * dial.target.abs();
        self.choice.dials.iter().any(far)
    }

    /// Whether the next question compares with what this beat shows, which has not come to a number yet.
    fn is_awaited(&self, tour: &TourState) -> bool {
        let next = tour.lesson.beats.get(tour.beat + 1);
        let asked = next.and_then(|beat| beat.question.as_ref());
        let base = asked.filter(|asked| asked.measure.over == ComparedWith::Before);
        let is_known = |of: &LessonQuestion| {
            let value = self.frame().and_then(|frame| of.measure.of.of(frame));
            value.is_some() && self.not_yet(tour).is_none()
        };
        !tour.is_overdue(self.passages()) && base.is_some_and(|of| !is_known(of))
    }

    /// Whether the surfaces have not come to the age that the scene asks for.
    fn is_ageing(&self) -> bool {
        let aged = self.frame().and_then(|frame| frame.age);
        let cycles = aged.map_or(0.0, |age| age.cycles);
        let asked = self.run.setup.scene.age;
        asked.is_some_and(|asked| cycles < asked.cycles * (1.0 - 1e-9))
    }

    /// A knob that does not stand where the beat has put it.
    fn turned_away(&self) -> Option<&'static str> {
        let tour = self.lesson.tour.as_ref()?;
        let dials = self.choice.dials.iter().zip(&tour.set_to);
        let by_hand = |at: &Option<Duration>| at.is_some_and(|at| at > tour.set_at);
        let away = |(dial, set): &(&Dial, &f64)| (dial.target - **set).abs() > 1e-6 * set.abs();
        let mut turned = dials.zip(&self.choice.set_at);
        let turned = turned.find(|(dial, at)| by_hand(at) && away(dial));
        turned.map(|((dial, _), _)| dial.label)
    }

    /// Whether run and replay stand.
    fn stands(&self) -> bool {
        match &self.replay.playing {
            Some(_) => self.replay_stands(),
            None => self.run.pace == RunPace::Paused,
        }
    }

    /// Tells what the simulation found.
    fn tell(&mut self) -> Vec<Effect> {
        let frame = self.frame().map(Arc::clone);
        let (now, turned) = (self.now, self.turned_away());
        let Some(tour) = &mut self.lesson.tour else {
            return Vec::new();
        };
        let Some(question) = &tour.beat().question else {
            return Vec::new();
        };
        let before = tour.before.as_deref();
        let value = frame.and_then(|frame| question.measure.value(&frame, before));
        let right = value.map(|value| question.right(value));
        let found = FoundAnswer {
            turned,
            value,
            right,
        };
        let words = question.because.clone();
        tour.tell(found, now);
        match turned {
            Some(_) => Vec::new(),
            None => vec![Effect::Send(Command::Say(words))],
        }
    }

    /// A beat as it begins: its question, or what it shows.
    fn begin_beat(&mut self, place: usize, beat: usize) -> Vec<Effect> {
        let Some(lesson) = self.lesson.all.get(place) else {
            self.say("that was the last lesson");
            return self.leave_tour();
        };
        if self.view.overlay == Overlay::Lessons {
            self.view.overlay = Overlay::None;
        }
        let mut next = TourState::begin(Arc::clone(lesson), place, beat);
        if self.lesson.tour.is_none() && self.lesson.staged.is_none() {
            // What the knobs were turned to is kept for the time after the lessons.
            self.lesson.own_scene = (self.scene_now().into(), self.run.setup.name.clone());
        }
        // The end of the beat before, which the numbers of this one may be compared with.
        next.before = self.frame().filter(|_| beat > 0).map(Arc::clone);
        if beat > 0 {
            let befores = self.lesson.tour.as_ref().map(|tour| tour.befores.clone());
            next.befores = befores.unwrap_or_default();
            next.befores.push(next.before.clone());
        } else {
            self.lesson.restage = true;
            self.view.curve = CurveKind::default();
            (self.view.pinned, self.view.frozen) = (None, None);
        }
        next.show(self.passages(), self.now);
        if next.beat().question.is_some() {
            next.phase = TourPhase::Asks;
        }
        let asked = next.beat().question.as_ref().map(|asked| asked.ask.clone());
        self.lesson.tour = Some(next);
        match asked {
            Some(words) => vec![Effect::Send(Command::Say(words))],
            None => self.play(),
        }
    }

    /// Ends the lesson: back to the user's own scene.
    pub(super) fn leave_tour(&mut self) -> Vec<Effect> {
        if self.lesson.tour.take().is_none() {
            return Vec::new();
        }
        self.view.enlarged = None;
        match self.lesson.staged.take() {
            Some(_) if self.offers(ErrandKind::Rebuild) => {
                let (scene, name) = &self.lesson.own_scene;
                vec![Effect::Rebuild(Box::new((**scene).clone()), name.clone())]
            }
            _ => self.apply(Action::HomeAll),
        }
    }

    /// Plays a beat: its scene first, where another one runs; its words go to the recording.
    fn play(&mut self) -> Vec<Effect> {
        match self.staged() {
            Some(effect) => vec![effect],
            None => self.show_beat(),
        }
    }

    /// Begins the scene of a beat, where another one runs, or this one from another place than the lesson's own.
    fn staged(&mut self) -> Option<Effect> {
        let tour = self.lesson.tour.as_ref()?;
        let staging = tour.lesson.staging(tour.beat);
        let staging = staging.filter(|_| self.offers(ErrandKind::Rebuild))?;
        let again = std::mem::take(&mut self.lesson.restage);
        if !again && self.lesson.staged.as_ref() == Some(staging) {
            return None;
        }
        match staging.load() {
            Ok(scene) => {
                let name = file_stem(&staging.scene);
                self.lesson.staged = Some(staging.clone());
                Some(Effect::Rebuild(Box::new(scene), name))
            }
            Err(error) => {
                self.not_rebuilt(error.to_string());
                None
            }
        }
    }

    /// What a beat sets, shows and says; nothing while it asks.
    pub(super) fn show_beat(&mut self) -> Vec<Effect> {
        let (passages, now) = (self.passages(), self.now);
        let Some(tour) = self
            .lesson
            .tour
            .as_mut()
            .filter(|tour| tour.phase == TourPhase::Shows)
        else {
            return Vec::new();
        };
        tour.show(passages, now);
        let (lesson, at) = (Arc::clone(&tour.lesson), tour.beat);
        let beat = &lesson.beats[at];
        self.view.map = beat.map.unwrap_or(self.view.map);
        self.view.point_quantity = beat.point.unwrap_or(self.view.point_quantity);
        self.view.enlarged = beat.enlarge;
        let words = format!("{}: {}", lesson.title, beat.caption);
        let mut effects = vec![Effect::Send(Command::Say(words))];
        for place in 0..self.choice.dials.len() {
            let dial = &self.choice.dials[place];
            let setting = lesson.setting(at, dial);
            let value = setting.map_or(dial.home, |setting| setting.value(dial));
            // A run without another scene may not go there; a surface that is smooth has nothing to set.
            if dial.checked(value).is_ok() {
                effects.extend(self.set(place, value));
            }
        }
        let set_to = self.choice.dials.iter().map(|dial| dial.target).collect();
        if let Some(tour) = &mut self.lesson.tour {
            (tour.set_to, tour.set_at) = (set_to, now);
        }
        effects
    }
}

/// The name of a preset, or of a file without its folder and ending.
fn file_stem(scene: &str) -> String {
    let stem = std::path::Path::new(scene).file_stem();
    stem.map_or_else(
        || scene.to_owned(),
        |stem| stem.to_string_lossy().into_owned(),
    )
}
