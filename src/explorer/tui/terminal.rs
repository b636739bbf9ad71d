//! The terminal itself: entered, left, and left again whatever happens. The only place that names crossterm.

mod show;

use std::cell::Cell;
use std::io::{self, BufWriter, Stdout, Write, stdout};
use std::panic;
use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

use crossterm::cursor::Show;
use crossterm::event::{
    self, DisableMouseCapture, EnableMouseCapture, KeyCode, KeyEvent, KeyEventKind, KeyModifiers,
    MouseButton, MouseEvent, MouseEventKind,
};
use crossterm::terminal::{
    BeginSynchronizedUpdate, Clear, ClearType, EndSynchronizedUpdate, EnterAlternateScreen,
    LeaveAlternateScreen, disable_raw_mode, enable_raw_mode, size,
};
use crossterm::{execute, queue};
use ratatui::backend::CrosstermBackend;
use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect, Size};
use ratatui::{Terminal, TerminalOptions, Viewport};

use crate::tui::app::App;
use crate::tui::event::{Chord, KeyName, Modifiers, Pointer, PointerAct, ScreenEvent};
use crate::tui::view;
pub use show::explore;

/// The terminal while the explorer has it; dropped, it is as it was.
pub(super) struct Screen {
    terminal: Terminal<CrosstermBackend<BufWriter<Stdout>>>,
    /// What it shows: nothing is written where nothing has changed.
    shown: Buffer,
}

impl Screen {
    /// Takes the terminal.
    ///
    /// # Errors
    /// When it cannot be switched.
    pub(super) fn enter() -> io::Result<Self> {
        take()?;
        let (terminal, shown) = blank().inspect_err(|_| give_back())?;
        Ok(Self { terminal, shown })
    }

    /// The cells of the terminal as large as it is now.
    ///
    /// # Errors
    /// When it does not say.
    pub(super) fn area() -> io::Result<Rect> {
        Ok(Rect::from((Position::ORIGIN, Size::from(size()?))))
    }

    /// Draws the screen, where anything of it has changed.
    ///
    /// # Errors
    /// When the terminal cannot be written to.
    pub(super) fn draw(&mut self, app: &App) -> io::Result<()> {
        if Self::area()? != self.shown.area {
            self.clear()?;
        }
        // By the time it was cleared it may have yet another size.
        let area = self.shown.area;
        let mut next = Buffer::empty(area);
        view::render(app, area, &mut next);
        if next == self.shown {
            return Ok(());
        }
        queue!(self.terminal.backend_mut(), BeginSynchronizedUpdate)?;
        self.terminal
            .draw(|frame| frame.buffer_mut().clone_from(&next))?;
        execute!(self.terminal.backend_mut(), EndSynchronizedUpdate)?;
        self.shown = next;
        Ok(())
    }

    /// Hands the terminal to the shell and stops this process and its group until `fg`.
    ///
    /// # Errors
    /// When the terminal cannot be taken again.
    pub(super) fn suspend(&mut self) -> io::Result<()> {
        give_back();
        // The whole group (0): a shell that started us through another program (`cargo run`) gets
        // its prompt back. It returns when the shell continues the group.
        let stopped = process::Command::new("kill").args(["-TSTP", "0"]).status();
        take()?;
        self.clear()?;
        stopped.map(|_| ())
    }

    /// Clears it: what comes next is drawn from nothing.
    ///
    /// # Errors
    /// When it fails.
    fn clear(&mut self) -> io::Result<()> {
        execute!(stdout(), Clear(ClearType::All))?;
        (self.terminal, self.shown) = blank()?;
        Ok(())
    }
}

/// A terminal of which nothing is shown yet. Its size is fixed: when ratatui follows a new size it asks where the cursor is,
/// and not every terminal answers.
fn blank() -> io::Result<(Terminal<CrosstermBackend<BufWriter<Stdout>>>, Buffer)> {
    /// Bytes of a large screen in true colour.
    const ONE_SCREEN: usize = 1 << 18;
    let area = Screen::area()?;
    let out = BufWriter::with_capacity(ONE_SCREEN, stdout());
    let options = TerminalOptions {
        viewport: Viewport::Fixed(area),
    };
    let terminal = Terminal::with_options(CrosstermBackend::new(out), options)?;
    Ok((terminal, Buffer::empty(area)))
}

impl Drop for Screen {
    fn drop(&mut self) {
        give_back();
    }
}

/// Whether the terminal is taken. It is given back once: leaving the alternate screen twice would
/// move the cursor back over what was printed in between (a panic's message).
static TAKEN: AtomicBool = AtomicBool::new(false);

fn take() -> io::Result<()> {
    enable_raw_mode()?;
    TAKEN.store(true, Ordering::SeqCst);
    let entered = execute!(stdout(), EnterAlternateScreen, EnableMouseCapture);
    if entered.is_err() {
        give_back();
    }
    entered
}

/// Errors are of no use here: either the terminal is gone, or there is nothing more to try.
fn give_back() {
    if !TAKEN.swap(false, Ordering::SeqCst) {
        return;
    }
    let _ = execute!(stdout(), DisableMouseCapture, LeaveAlternateScreen, Show);
    let _ = disable_raw_mode();
    let _ = stdout().flush();
}

thread_local! {
    /// Whether this thread draws: its panic ends the screen.
    static DRAWS: Cell<bool> = const { Cell::new(false) };
}

/// What panics of other threads said: shown on the screen while it is there.
#[derive(Debug, Clone, Default)]
pub(super) struct Panics {
    said: Arc<Mutex<Vec<Panic>>>,
}

#[derive(Debug)]
struct Panic {
    text: String,
    /// Whether it broke the run that is on the screen: not one beside it, nor a run before it.
    broke_the_run: bool,
}

/// Threads whose panic leaves the run as it is.
const BESIDE: [&str; 3] = ["sweep", "keys", "files"];

impl Panics {
    /// Watches panics from now on: one of this thread gives the terminal back before it is
    /// reported as before; one of another thread is kept, as its text would tear the screen.
    pub(super) fn watch() -> Self {
        let panics = Self::default();
        DRAWS.with(|draws| draws.set(true));
        let kept = panics.clone();
        let before = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            if DRAWS.with(Cell::get) {
                give_back();
                before(info);
            } else if Arc::strong_count(&kept.said) > 1 {
                let name = thread::current().name().map(str::to_owned);
                kept.lock().push(Panic {
                    text: in_one_line(info),
                    broke_the_run: !name.is_some_and(|name| BESIDE.contains(&name.as_str())),
                });
            } else {
                // The screen is gone, and the hook holds the last handle.
                before(info);
            }
        }));
        panics
    }

    /// What broke the run that is on the screen.
    pub(super) fn of_the_run(&self) -> Option<String> {
        let said = self.lock();
        let first = said.iter().find(|panic| panic.broke_the_run);
        first.map(|panic| panic.text.clone())
    }

    /// Another run is on the screen.
    pub(super) fn another_run(&self) {
        for panic in self.lock().iter_mut() {
            panic.broke_the_run = false;
        }
    }

    /// Says, on a screen that is no longer there, what was kept.
    pub(super) fn report(&self) {
        let mut errors = io::stderr().lock();
        for panic in self.lock().drain(..) {
            let _ = writeln!(errors, "{}", panic.text);
        }
    }

    fn lock(&self) -> MutexGuard<'_, Vec<Panic>> {
        self.said.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A panic in one line.
fn in_one_line(info: &panic::PanicHookInfo<'_>) -> String {
    let what = info.payload_as_str().unwrap_or("no message");
    match info.location() {
        Some(place) => format!(
            "a programming error: {what} ({}:{})",
            place.file(),
            place.line()
        ),
        None => format!("a programming error: {what}"),
    }
}

impl Drop for Panics {
    fn drop(&mut self) {
        DRAWS.with(|draws| draws.set(false));
    }
}

/// Keys, mouse and sizes from a thread of their own: reading a terminal that has vanished may never
/// return, and then it is this thread that hangs, not the screen.
pub(super) struct Input {
    /// What came.
    pub(super) events: Receiver<ScreenEvent>,
    ended: Arc<AtomicBool>,
}

impl Input {
    /// Starts to listen.
    ///
    /// # Errors
    /// When no thread can be started.
    pub(super) fn listen() -> io::Result<Self> {
        let (sender, events) = channel();
        let ended = Arc::new(AtomicBool::new(false));
        let flag = Arc::clone(&ended);
        thread::Builder::new()
            .name("keys".to_owned())
            .spawn(move || forward(&sender, &flag))?;
        Ok(Self { events, ended })
    }
}

impl Drop for Input {
    fn drop(&mut self) {
        self.ended.store(true, Ordering::Relaxed);
    }
}

/// Ends (and with it the channel) when nobody listens any more or the terminal fails.
fn forward(sender: &Sender<ScreenEvent>, ended: &AtomicBool) {
    while !ended.load(Ordering::Relaxed) {
        match event::poll(Duration::from_millis(50)) {
            Ok(false) => {}
            Ok(true) => {
                let Ok(event) = event::read() else { return };
                if understood(&event).is_some_and(|event| sender.send(event).is_err()) {
                    return;
                }
            }
            Err(_) => return,
        }
    }
}

/// The event in the screen's own words; `None`: it has none for it.
fn understood(event: &event::Event) -> Option<ScreenEvent> {
    match event {
        event::Event::Key(key) => chord(key).map(ScreenEvent::Key),
        event::Event::Mouse(mouse) => pointer(*mouse).map(ScreenEvent::Pointer),
        event::Event::Resize(..) => Some(ScreenEvent::Resize),
        _ => None,
    }
}

fn chord(event: &KeyEvent) -> Option<Chord> {
    if event.kind == KeyEventKind::Release {
        return None;
    }
    let key = match event.code {
        KeyCode::Char(letter) => KeyName::Char(letter),
        KeyCode::Up => KeyName::Up,
        KeyCode::Down => KeyName::Down,
        KeyCode::Left => KeyName::Left,
        KeyCode::Right => KeyName::Right,
        KeyCode::PageUp => KeyName::PageUp,
        KeyCode::PageDown => KeyName::PageDown,
        KeyCode::Home => KeyName::Home,
        KeyCode::Tab => KeyName::Tab,
        KeyCode::BackTab => KeyName::BackTab,
        KeyCode::Enter => KeyName::Enter,
        KeyCode::Esc => KeyName::Esc,
        KeyCode::Backspace => KeyName::Backspace,
        KeyCode::F(number) => KeyName::F(number),
        _ => return None,
    };
    let is_held = |modifier| event.modifiers.contains(modifier);
    Some(Chord {
        key,
        modifiers: Modifiers {
            shift: is_held(KeyModifiers::SHIFT),
            control: is_held(KeyModifiers::CONTROL),
            alt: is_held(KeyModifiers::ALT),
        },
    })
}

fn pointer(event: MouseEvent) -> Option<Pointer> {
    let act = match event.kind {
        MouseEventKind::Down(MouseButton::Left) => PointerAct::Press,
        MouseEventKind::Drag(MouseButton::Left) => PointerAct::Drag,
        MouseEventKind::Down(MouseButton::Right) => PointerAct::SecondPress,
        MouseEventKind::ScrollUp => PointerAct::WheelUp,
        MouseEventKind::ScrollDown => PointerAct::WheelDown,
        _ => return None,
    };
    Some(Pointer {
        act,
        column: event.column,
        row: event.row,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn releases_and_middle_buttons_say_nothing() {
        let mut key = KeyEvent::new(KeyCode::Char('q'), KeyModifiers::ALT);
        let held = Chord::new(KeyName::Char('q'), Modifiers::ALT);
        assert_eq!(chord(&key), Some(held));
        key.kind = KeyEventKind::Release;
        assert_eq!(chord(&key), None);
        let mouse = |kind| {
            let mouse = MouseEvent {
                kind,
                column: 3,
                row: 4,
                modifiers: KeyModifiers::NONE,
            };
            pointer(mouse).map(|pointer| pointer.act)
        };
        let down = mouse(MouseEventKind::Down(MouseButton::Left));
        assert_eq!(down, Some(PointerAct::Press));
        assert_eq!(mouse(MouseEventKind::Down(MouseButton::Middle)), None);
        assert_eq!(mouse(MouseEventKind::Moved), None);
    }
}
