//! The explorer in a terminal: the loop between state, screen and keys.

use std::env;
use std::io::{self, ErrorKind};
use std::sync::mpsc::RecvTimeoutError;
use std::time::{Duration, Instant};

use super::{Input, Panics, Screen};
use crate::tui::event::ScreenEvent;
use crate::tui::explorer::{Control, Explorer};
use crate::tui::theme::{Capabilities, Contrast, Theme};
use crate::tui::wiring::{TuiError, Wiring};
use asperity_session::run::Command;

/// Time from one drawing to the next.
const FRAME_TIME: Duration = Duration::from_millis(25);
/// Least pause between two drawings, for a terminal that is slower.
const LEAST_WAIT: Duration = Duration::from_millis(5);

/// Shows the explorer until the user quits, the process is asked to end, or the terminal fails.
///
/// On return the terminal is as it was, also after an error or a panic, and the run was sent
/// [`Command::Stop`]; the caller joins it.
///
/// # Errors
/// [`TuiError::NoScreen`] on a terminal that cannot place a cursor; [`TuiError::Terminal`] when it
/// fails or vanishes.
pub fn explore(wiring: Wiring) -> Result<(), TuiError> {
    let term = env::var("TERM").unwrap_or_default();
    if term == "dumb" {
        return Err(TuiError::NoScreen { term });
    }
    let variable = |name: &str| env::var(name).ok();
    let mut theme = Theme::new(Capabilities::detect(variable));
    theme.contrast = Contrast::detect(variable);
    let mut explorer = Explorer::new(wiring, theme);
    let panics = Panics::watch();
    let result = Screen::enter().and_then(|stage| {
        let input = Input::listen()?;
        let mut show = Show {
            stage,
            explorer: &mut explorer,
            panics: &panics,
        };
        let control = show.explorer.teach_asked();
        let shown = show.follow(control).and_then(|_| show.go_on(&input));
        show.explorer.finish_writing();
        shown
    });
    panics.report();
    explorer.send(Command::Stop);
    Ok(result?)
}

/// The loop around the screen.
struct Show<'a> {
    stage: Screen,
    explorer: &'a mut Explorer,
    panics: &'a Panics,
}

impl Show<'_> {
    /// Draws, waits for an event but not longer than a frame's time, takes all that came; again.
    fn go_on(&mut self, input: &Input) -> io::Result<()> {
        let start = Instant::now();
        let mut last = start.elapsed();
        loop {
            let now = start.elapsed();
            self.explorer.app.tick(now);
            let broke = self.panics.of_the_run();
            let control = self.explorer.take_news(now.saturating_sub(last), broke);
            // Nothing that comes from the run asks for the end.
            self.follow(control)?;
            last = now;
            let began = Instant::now();
            self.stage.draw(&self.explorer.app)?;
            let drawn = Instant::now();
            // Drawing counts: frames come every FRAME_TIME, not so long after each other.
            let mut wait = FRAME_TIME.saturating_sub(drawn - began).max(LEAST_WAIT);
            loop {
                if self.explorer.is_interrupted() {
                    return Ok(());
                }
                match input.events.recv_timeout(wait) {
                    Ok(event) => {
                        self.explorer.app.tick(start.elapsed());
                        if self.take_event(event)? == Control::Stop {
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

    fn take_event(&mut self, event: ScreenEvent) -> io::Result<Control> {
        let control = self.explorer.take_event(event, Screen::area()?);
        self.follow(control)
    }

    /// Does what the terminal and its process have to do.
    fn follow(&mut self, control: Control) -> io::Result<Control> {
        match control {
            Control::Go | Control::Stop => {}
            Control::Anew => self.panics.another_run(),
            Control::Suspend => self.stage.suspend()?,
        }
        Ok(control)
    }
}
