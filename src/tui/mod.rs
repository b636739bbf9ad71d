//! The live screen: the only folder that names ratatui and crossterm.
//!
//! ```text
//! Latest ──newest frame──> App ──view──> terminal
//! keys, mouse ──Action──>  App ──Effect──> Command ──> run
//! ```
//!
//! [`app`] holds the state and the reducer and does not draw, wait or read a clock; [`view`] draws
//! a state and changes nothing; this file is the loop between them. Frames are taken newest first:
//! a slow screen skips frames and never delays the run.

pub mod action;
pub mod app;
mod canvas;
pub mod choice;
pub mod dial;
pub mod estimate;
mod kymograph;
pub mod lessons;
pub mod pixels;
pub mod replay;
mod tables;
mod terminal;
pub mod theme;
pub mod trace;
pub mod units;
pub mod view;
pub mod wiring;

use std::env;
use std::io::{self, ErrorKind};
use std::sync::atomic::Ordering;
use std::sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError};
use std::time::{Duration, Instant};

use crossterm::event::Event;
use crossterm::terminal::{BeginSynchronizedUpdate, EndSynchronizedUpdate};
use crossterm::{execute, queue};
use ratatui::layout::Rect;

use crate::run::Command;
use crate::scene::Scene;
use crate::sweep::Background;
use action::{lookup, lookup_typed};
use app::{App, Effect, ErrandKind};
use canvas::Canvas;
use pixels::Pixels;
use terminal::{Input, Panics, Screen};
use theme::{Capabilities, Contrast, Theme};
pub use wiring::{
    Health, Rebuild, RecorderActivity, RecorderState, RunStatus, Setup, Shown, TuiError, Wiring,
    WriteShown,
};

/// Time from one drawing to the next.
const FRAME_TIME: Duration = Duration::from_millis(25);
/// Least pause between two drawings, for a terminal that is slower.
const LEAST_WAIT: Duration = Duration::from_millis(5);

/// Whether the loop goes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum LoopControl {
    Go,
    Stop,
}

/// Shows the explorer until the user quits, the process is asked to end, or the terminal fails.
///
/// On return the terminal is as it was, also after an error or a panic, and the run was sent
/// [`Command::Stop`]; the caller joins it.
///
/// # Errors
/// [`TuiError::NoScreen`] on a terminal that cannot place a cursor; [`TuiError::Terminal`] when it
/// fails or vanishes.
pub fn explore(mut wiring: Wiring) -> Result<(), TuiError> {
    let term = env::var("TERM").unwrap_or_default();
    if term == "dumb" {
        return Err(TuiError::NoScreen { term });
    }
    let variable = |name: &str| env::var(name).ok();
    let mut theme = Theme::new(Capabilities::detect(variable));
    theme.contrast = Contrast::detect(variable);
    let mut app = App::new(wiring.setup.clone(), errands_of(&wiring), theme);
    app.set_pixels(Pixels::detect(variable));
    let panics = Panics::watch();
    let result = Screen::enter().and_then(|stage| {
        let input = Input::listen()?;
        let mut show = Show {
            stage,
            app: &mut app,
            wiring: &mut wiring,
            panics: &panics,
            canvas: Canvas::default(),
            sweep: None,
            writing: Vec::new(),
        };
        let shown = show.teach().and_then(|()| show.go_on(&input));
        show.finish_writing();
        shown
    });
    panics.report();
    // A run that has ended hears nothing, which is what is wanted.
    let _ = wiring.commands.send(Command::Stop);
    Ok(result?)
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

/// The loop around the screen.
struct Show<'a> {
    stage: Screen,
    app: &'a mut App,
    wiring: &'a mut Wiring,
    panics: &'a Panics,
    canvas: Canvas,
    sweep: Option<Background>,
    /// Files in the making.
    writing: Vec<Receiver<Result<String, String>>>,
}

impl Show<'_> {
    /// Begins the lesson that was asked for.
    fn teach(&mut self) -> io::Result<()> {
        let own = self.wiring.lesson.take();
        let effects = own.map_or_else(Vec::new, |lesson| self.app.teach(lesson));
        self.carry_out(effects).map(|_| ())
    }

    /// Draws, waits for an event but not longer than a frame's time, takes all that came; again.
    fn go_on(&mut self, input: &Input) -> io::Result<()> {
        let start = Instant::now();
        let mut last = start.elapsed();
        loop {
            let now = start.elapsed();
            self.app.tick(now);
            self.take_news(now.saturating_sub(last))?;
            last = now;
            let began = Instant::now();
            self.draw()?;
            let drawn = Instant::now();
            // Drawing counts: frames come every FRAME_TIME, not so long after each other.
            let mut wait = FRAME_TIME.saturating_sub(drawn - began).max(LEAST_WAIT);
            loop {
                if self.wiring.interrupt.load(Ordering::Relaxed) {
                    return Ok(());
                }
                match input.events.recv_timeout(wait) {
                    Ok(event) => {
                        self.app.tick(start.elapsed());
                        if self.take_event(&event)? == LoopControl::Stop {
                            return Ok(());
                        }
                    }
                    Err(RecvTimeoutError::Timeout) => break,
                    Err(RecvTimeoutError::Disconnected) => {
                        return Err(io::Error::new(
                            ErrorKind::UnexpectedEof,
                            "no more keys come",
                        ));
                    }
                }
                // What has come already is taken before the next drawing, but a flood of events (a
                // held key, a dragged mouse) does not keep the screen from being drawn.
                wait = Duration::ZERO;
                if drawn.elapsed() > FRAME_TIME {
                    break;
                }
            }
        }
    }

    /// One picture, shown whole: the terminal is told when it begins and when it ends.
    fn draw(&mut self) -> io::Result<()> {
        queue!(io::stdout(), BeginSynchronizedUpdate)?;
        let drawn = self.draw_all();
        execute!(io::stdout(), EndSynchronizedUpdate)?;
        drawn
    }

    fn draw_all(&mut self) -> io::Result<()> {
        let app = &*self.app;
        let size = self.stage.terminal.size()?;
        let screen = Rect::new(0, 0, size.width, size.height);
        if self.canvas.must_clear(app, screen) {
            self.stage.clear()?;
        }
        let drawn = self.stage.terminal.draw(|frame| view::draw(app, frame))?;
        self.canvas.show(app, drawn.buffer)
    }

    fn take_news(&mut self, wall: Duration) -> io::Result<()> {
        let mut status = (self.wiring.status)();
        if let Some(text) = self.panics.of_the_run() {
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
        self.app.take_swept(found, progress);
        // Nothing that comes from the run asks for the end.
        self.carry_out(effects).map(|_| ())
    }

    fn take_event(&mut self, event: &Event) -> io::Result<LoopControl> {
        if let Event::Resize(..) = event {
            self.canvas.forget();
        }
        let action = match event {
            Event::Key(key) if self.app.is_typing() => lookup_typed(key),
            Event::Key(key) => lookup(key),
            Event::Mouse(mouse) => {
                let size = self.stage.terminal.size()?;
                view::pointed(self.app, Rect::new(0, 0, size.width, size.height), mouse)
            }
            _ => None,
        };
        match action {
            Some(action) => {
                let effects = self.app.apply(action);
                self.carry_out(effects)
            }
            None => Ok(LoopControl::Go),
        }
    }

    fn carry_out(&mut self, effects: Vec<Effect>) -> io::Result<LoopControl> {
        for effect in effects {
            match effect {
                // A run that has ended hears nothing; its last frame can still be looked at.
                Effect::Send(command) => drop(self.wiring.commands.send(command)),
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
                Effect::Rebuild(scene, name) => self.rebuild(&scene, &name),
                Effect::Suspend => {
                    self.canvas.forget();
                    self.stage.suspend()?;
                }
                Effect::Quit => return Ok(LoopControl::Stop),
            }
        }
        Ok(LoopControl::Go)
    }

    /// Another scene: another run behind the same screen.
    fn rebuild(&mut self, scene: &Scene, name: &str) {
        let Some(mut rebuild) = self.wiring.rebuild.take() else {
            return;
        };
        let made = rebuild(scene, name);
        match made {
            Ok(next) => {
                self.sweep = None;
                self.panics.another_run();
                *self.wiring = next;
                for effect in self.app.rebuilt(self.wiring.setup.clone()) {
                    if let Effect::Send(command) = effect {
                        let _ = self.wiring.commands.send(command);
                    }
                }
            }
            Err(reason) => self.app.not_rebuilt(reason),
        }
        self.wiring.rebuild = Some(rebuild);
    }

    fn run_errand(&mut self, errand: ErrandKind) -> Result<String, String> {
        let missing = || Err("not wired".to_owned());
        let wiring = &mut *self.wiring;
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
        let app = &mut *self.app;
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
    fn finish_writing(&mut self) {
        for answer in self.writing.drain(..) {
            drop(answer.recv());
        }
    }
}
