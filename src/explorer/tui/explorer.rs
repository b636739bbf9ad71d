//! What stands between the screen and the run, whoever draws the one and steps the other.

use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::sync::mpsc::{Receiver, TryRecvError};
use std::time::Duration;

use ratatui::layout::Rect;

use super::action::{lookup, lookup_typed};
use super::app::{App, Effect, ErrandKind};
use super::event::ScreenEvent;
use super::lessons::Lesson;
use super::theme::Theme;
use super::view;
use super::wiring::{Health, Wiring};
use asperity_engine::scene::Scene;
use asperity_session::run::Command;
use asperity_session::sweep::Background;

/// What follows for who shows the screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Control {
    /// It goes on.
    Go,
    /// It goes on behind another run.
    Anew,
    /// It gives the terminal back for a while.
    Suspend,
    /// It ends.
    Stop,
}

/// The state of the screen, wired to a run.
pub struct Explorer {
    /// The state.
    pub app: App,
    wiring: Wiring,
    sweep: Option<Background>,
    /// Files in the making.
    writing: Vec<Receiver<Result<String, String>>>,
}

/// The errands that are wired.
fn errands_of(wiring: &Wiring) -> Vec<ErrandKind> {
    let errands = [
        (wiring.toggle_recording.is_some(), ErrandKind::Record),
        (wiring.open_viewer.is_some(), ErrandKind::View),
        (wiring.save_scene.is_some(), ErrandKind::Save),
        (wiring.rebuild.is_some(), ErrandKind::Rebuild),
        (wiring.write_shown.is_some(), ErrandKind::Write),
    ];
    let wired = errands.into_iter().filter(|(wired, _)| *wired);
    wired.map(|(_, errand)| errand).collect()
}

impl Explorer {
    /// The screen of a run before its first frame.
    pub fn new(wiring: Wiring, theme: Theme) -> Self {
        Self {
            app: App::new(wiring.setup.clone(), errands_of(&wiring), theme),
            wiring,
            sweep: None,
            writing: Vec::new(),
        }
    }

    /// Begins the lesson that was asked for.
    pub fn teach_asked(&mut self) -> Control {
        match self.wiring.lesson.take() {
            Some(lesson) => self.teach(lesson),
            None => Control::Go,
        }
    }

    /// Begins a lesson.
    pub fn teach(&mut self, lesson: Arc<Lesson>) -> Control {
        let effects = self.app.teach(lesson);
        self.carry_out(effects)
    }

    /// Takes what the run has to tell, `wall` after the last time; `broke`: a programming error that ended it.
    pub fn take_news(&mut self, wall: Duration, broke: Option<String>) -> Control {
        let mut status = (self.wiring.status)();
        if let Some(text) = broke {
            status.health = Health::Failed(text);
        }
        self.app.take_status(status);
        self.hear_of_files();
        let mut effects = Vec::new();
        if let Some(frame) = self.wiring.frames.take() {
            let mut points = Vec::new();
            self.wiring.frames.take_points(&mut points);
            self.app.take_points(&points, frame.a_m);
            effects = self.app.take_frame(frame);
        }
        effects.extend(self.app.take_settled((self.wiring.settled)()));
        effects.extend(self.app.advance(wall));
        let found = self.sweep.as_ref().map_or_else(Vec::new, Background::take);
        let progress = self.sweep.as_ref().and_then(Background::progress);
        effects.extend(self.app.take_swept(found, progress));
        self.carry_out(effects)
    }

    /// Takes what a person does on a screen of that size.
    pub fn take_event(&mut self, event: ScreenEvent, screen: Rect) -> Control {
        let action = match event {
            ScreenEvent::Key(chord) if self.app.is_typing() => lookup_typed(chord),
            ScreenEvent::Key(chord) => lookup(chord),
            ScreenEvent::Pointer(pointer) => view::pointed(&self.app, screen, pointer),
            ScreenEvent::Resize => None,
        };
        match action {
            Some(action) => {
                let effects = self.app.apply(action);
                self.carry_out(effects)
            }
            None => Control::Go,
        }
    }

    /// Whether the process was asked to end.
    pub fn is_interrupted(&self) -> bool {
        self.wiring.interrupt.load(Ordering::Relaxed)
    }

    /// Sends the run a command. A run that has ended hears nothing; its last frame can still be looked at.
    pub fn send(&self, command: Command) {
        let _ = self.wiring.commands.send(command);
    }

    fn carry_out(&mut self, effects: Vec<Effect>) -> Control {
        let mut control = Control::Go;
        for effect in effects {
            match effect {
                Effect::Send(command) => self.send(command),
                Effect::Errand(errand) => {
                    let said = self.run_errand(errand).unwrap_or_else(|reason| reason);
                    self.app.say(said);
                }
                Effect::Sweep(order) => {
                    // The old one ends first: its cores are wanted.
                    self.sweep = None;
                    let start = self.wiring.start_sweep.as_mut();
                    self.sweep = start.and_then(|start| start(*order));
                }
                Effect::EndSweep => self.sweep = None,
                Effect::Rebuild(scene, name) => {
                    if self.rebuild(&scene, &name) {
                        control = Control::Anew;
                    }
                }
                Effect::Suspend => control = Control::Suspend,
                Effect::Quit => return Control::Stop,
            }
        }
        control
    }

    /// Another scene: another run behind the same screen. Says whether there is one.
    fn rebuild(&mut self, scene: &Scene, name: &str) -> bool {
        let Some(mut rebuild) = self.wiring.rebuild.take() else {
            return false;
        };
        let made = rebuild(scene, name);
        let is_made = made.is_ok();
        match made {
            Ok(next) => {
                self.sweep = None;
                self.wiring = next;
                for effect in self.app.rebuilt(self.wiring.setup.clone()) {
                    if let Effect::Send(command) = effect {
                        self.send(command);
                    }
                }
            }
            Err(reason) => self.app.not_rebuilt(reason),
        }
        self.wiring.rebuild = Some(rebuild);
        is_made
    }

    fn run_errand(&mut self, errand: ErrandKind) -> Result<String, String> {
        let missing = || Err("not wired".to_owned());
        let wiring = &mut self.wiring;
        match errand {
            ErrandKind::Record => wiring
                .toggle_recording
                .as_mut()
                .map_or_else(missing, |run| run()),
            ErrandKind::View => wiring
                .open_viewer
                .as_mut()
                .map_or_else(missing, |run| run()),
            ErrandKind::Save => {
                let text = self.app.scene_toml();
                match &mut wiring.save_scene {
                    Some(save) => save(&text).map(|path| format!("saved {}", path.display())),
                    None => missing(),
                }
            }
            ErrandKind::Write => {
                let (Some(write), Some(shown)) = (&mut wiring.write_shown, self.app.shown()) else {
                    return Err("nothing to write before the passage".to_owned());
                };
                self.writing.push(write(shown));
                Ok("writing fields, pictures and tables".to_owned())
            }
            ErrandKind::Rebuild => missing(),
        }
    }

    /// Says which files are there.
    fn hear_of_files(&mut self) {
        let app = &mut self.app;
        self.writing.retain(|answer| match answer.try_recv() {
            Ok(said) => {
                app.say(said.unwrap_or_else(|reason| reason));
                false
            }
            Err(TryRecvError::Empty) => true,
            Err(TryRecvError::Disconnected) => false,
        });
    }

    /// What was begun is written whole.
    pub fn finish_writing(&mut self) {
        for answer in self.writing.drain(..) {
            drop(answer.recv());
        }
    }
}
