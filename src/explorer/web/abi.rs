//! What the page calls. Text and bytes come through `inbox` and leave through `outbox`; numbers are arguments.
#![expect(
    unsafe_code,
    reason = "names that the page calls by; the code itself is safe"
)]

use std::cell::RefCell;
use std::sync::{Mutex, PoisonError};

use super::link::{PageLink, with_map};
use super::page::{WebPage, measured};
use crate::tui::event::{Chord, KeyName, Modifiers, Pointer, PointerAct, ScreenEvent};

thread_local! {
    static PAGE: RefCell<Option<WebPage>> = const { RefCell::new(None) };
    static INBOX: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static OUTBOX: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// What a programming error said, for the page once the module has broken off.
static PANIC: Mutex<String> = Mutex::new(String::new());

/// Makes room for so many bytes and says where.
#[unsafe(no_mangle)]
pub extern "C" fn inbox(len: usize) -> *mut u8 {
    INBOX.with_borrow_mut(|inbox| {
        inbox.clear();
        inbox.resize(len, 0);
        inbox.as_mut_ptr()
    })
}

/// Where what was given lies.
#[unsafe(no_mangle)]
pub extern "C" fn outbox() -> *const u8 {
    OUTBOX.with_borrow(Vec::as_ptr)
}

/// How long it is.
#[unsafe(no_mangle)]
pub extern "C" fn outbox_len() -> usize {
    OUTBOX.with_borrow(Vec::len)
}

/// What a programming error said.
#[unsafe(no_mangle)]
pub extern "C" fn panic_words() {
    let said = PANIC.lock().unwrap_or_else(PoisonError::into_inner);
    give(said.clone().into_bytes());
}

/// Opens the explorer by a link (lines `key=value` in the inbox) on a screen of that size, with cells of so many pixels.
/// Gives 1, or 0 and why not in the outbox.
#[unsafe(no_mangle)]
pub extern "C" fn open(columns: u32, rows: u32, cell_width: u32, cell_height: u32) -> u32 {
    std::panic::set_hook(Box::new(|info| {
        *PANIC.lock().unwrap_or_else(PoisonError::into_inner) = info.to_string();
    }));
    let opened = PageLink::read(&text()).and_then(WebPage::open);
    take(opened, columns, rows, cell_width, cell_height)
}

/// Same from a file's text that was dropped onto the page: a scene, or a lesson.
#[unsafe(no_mangle)]
pub extern "C" fn drop_file(columns: u32, rows: u32, cell_width: u32, cell_height: u32) -> u32 {
    let opened = PageLink::from_file(&text()).and_then(WebPage::open);
    take(opened, columns, rows, cell_width, cell_height)
}

/// Same with a measured surface that was dropped: the file's name, a line end, its bytes.
#[unsafe(no_mangle)]
pub extern "C" fn drop_map(columns: u32, rows: u32, cell_width: u32, cell_height: u32) -> u32 {
    let shown = on_page(|page| (page.scene(), page.nodes())).unwrap_or_default();
    let opened = INBOX.with_borrow(|inbox| with_map(shown, inbox));
    take(
        opened.and_then(WebPage::open),
        columns,
        rows,
        cell_width,
        cell_height,
    )
}

fn take(
    opened: Result<WebPage, String>,
    columns: u32,
    rows: u32,
    cell_width: u32,
    cell_height: u32,
) -> u32 {
    match opened {
        Ok(page) => {
            PAGE.set(Some(page));
            resize(columns, rows, cell_width, cell_height);
            1
        }
        Err(reason) => {
            give(reason.into_bytes());
            0
        }
    }
}

/// The screen has another size.
#[unsafe(no_mangle)]
pub extern "C" fn resize(columns: u32, rows: u32, cell_width: u32, cell_height: u32) {
    let small = |value: u32| value.min(1000) as u16;
    on_page(|page| {
        let cell = (small(cell_width).max(1), small(cell_height).max(1));
        page.resize(small(columns), small(rows), cell);
    });
}

/// A key: its character, or [`NAMED`] and a place in the list of named ones; held: 1 shift, 2 control, 4 alt.
#[unsafe(no_mangle)]
pub extern "C" fn key(code: u32, held: u32) {
    if let Some(key) = key_of(code) {
        let held = Modifiers {
            shift: held & 1 != 0,
            control: held & 2 != 0,
            alt: held & 4 != 0,
        };
        on_page(|page| page.take(ScreenEvent::Key(Chord::new(key, held))));
    }
}

/// Codes of named keys begin here, beyond all characters.
const NAMED: u32 = 0x11_0000;

fn key_of(code: u32) -> Option<KeyName> {
    const KEYS: [KeyName; 13] = [
        KeyName::Up,
        KeyName::Down,
        KeyName::Left,
        KeyName::Right,
        KeyName::PageUp,
        KeyName::PageDown,
        KeyName::Home,
        KeyName::Tab,
        KeyName::BackTab,
        KeyName::Enter,
        KeyName::Esc,
        KeyName::Backspace,
        KeyName::F(1),
    ];
    match code.checked_sub(NAMED) {
        Some(place) => KEYS.get(place as usize).copied(),
        None => char::from_u32(code).map(KeyName::Char),
    }
}

/// The pointer: 0 presses, 1 drags, 2 presses the second button, 3 and 4 turn the wheel away and near.
#[unsafe(no_mangle)]
pub extern "C" fn pointer(act: u32, column: u32, row: u32) {
    let acts = [
        PointerAct::Press,
        PointerAct::Drag,
        PointerAct::SecondPress,
        PointerAct::WheelUp,
        PointerAct::WheelDown,
    ];
    if let Some(&act) = acts.get(act as usize) {
        let small = |value: u32| value.min(u32::from(u16::MAX)) as u16;
        let (column, row) = (small(column), small(row));
        on_page(|page| page.take(ScreenEvent::Pointer(Pointer { act, column, row })));
    }
}

/// One time step: 1 of the run, 2 of the sweep beside it, 3 of both. Gives 0 when there is none to make: paused or ended,
/// and nothing to sweep.
#[unsafe(no_mangle)]
pub extern "C" fn step() -> u32 {
    let [stepped, swept] = on_page(WebPage::step).unwrap_or_default();
    u32::from(stepped) | u32::from(swept) << 1
}

/// Takes the news of the run and gives the cells that changed (see `cells.rs`), so many ms after the start.
/// Gives 0 once the user has quit.
#[unsafe(no_mangle)]
pub extern "C" fn draw(now_ms: f64) -> u32 {
    let drawn = on_page(|page| page.draw(now_ms));
    let Some((goes_on, bytes)) = drawn else {
        return 0;
    };
    give(bytes);
    u32::from(goes_on)
}

/// The curves (see `curves.rs`), where they have changed; else nothing.
#[unsafe(no_mangle)]
pub extern "C" fn curves() {
    give(on_page(WebPage::curves).unwrap_or_default());
}

/// The map's pixels: six numbers (left, top, columns, rows of cells; width, height), then the colours; or nothing.
#[unsafe(no_mangle)]
pub extern "C" fn picture() {
    give(on_page(|page| page.picture()).unwrap_or_default());
}

/// The screen in one sentence, for who hears it.
#[unsafe(no_mangle)]
pub extern "C" fn spoken() {
    give(on_page(|page| page.spoken().into_bytes()).unwrap_or_default());
}

/// What a lesson or the scene says now, in lines: who, its title, its words, its numbers, the answers it waits for; or nothing.
#[unsafe(no_mangle)]
pub extern "C" fn caption() {
    give(on_page(|page| page.caption().into_bytes()).unwrap_or_default());
}

/// The link to what is shown now.
#[unsafe(no_mangle)]
pub extern "C" fn link() {
    give(on_page(|page| page.link().into_bytes()).unwrap_or_default());
}

/// Every scalar of every step kept, as comma-separated values.
#[unsafe(no_mangle)]
pub extern "C" fn table() {
    give(on_page(|page| page.table().into_bytes()).unwrap_or_default());
}

/// The scene as it now is, as TOML.
#[unsafe(no_mangle)]
pub extern "C" fn scene() {
    give(on_page(|page| page.scene().into_bytes()).unwrap_or_default());
}

/// A file that a key has asked to save: its name, a line end, its text; or nothing.
#[unsafe(no_mangle)]
pub extern "C" fn saved() {
    give(on_page(WebPage::saved).unwrap_or_default());
}

/// Runs a link's scene (the inbox) for so many steps of its passage without a screen. Gives 1 and the table with a last
/// line of counters, or 0 and why not.
#[unsafe(no_mangle)]
pub extern "C" fn measure(steps: u32) -> u32 {
    let table = PageLink::read(&text()).and_then(|link| measured(&link, u64::from(steps)));
    let is_made = table.is_ok();
    give(table.unwrap_or_else(|reason| reason).into_bytes());
    u32::from(is_made)
}

fn on_page<R>(work: impl FnOnce(&mut WebPage) -> R) -> Option<R> {
    PAGE.with_borrow_mut(|page| page.as_mut().map(work))
}

fn text() -> String {
    INBOX.with_borrow(|inbox| String::from_utf8_lossy(inbox).into_owned())
}

fn give(bytes: Vec<u8>) {
    OUTBOX.set(bytes);
}
