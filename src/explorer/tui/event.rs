//! What comes from a person: keys and the pointer, whoever brings them (a terminal, a page).

/// A key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum KeyName {
    /// One that writes a character.
    Char(char),
    /// Up.
    Up,
    /// Down.
    Down,
    /// Left.
    Left,
    /// Right.
    Right,
    /// A page up.
    PageUp,
    /// A page down.
    PageDown,
    /// To the start.
    Home,
    /// Tabulator.
    Tab,
    /// Tabulator with shift.
    BackTab,
    /// Enter.
    Enter,
    /// Escape.
    Esc,
    /// Backspace.
    Backspace,
    /// A function key.
    F(u8),
}

/// Keys that are held down beside another.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Modifiers {
    /// Shift.
    pub shift: bool,
    /// Control.
    pub control: bool,
    /// Alt.
    pub alt: bool,
}

impl Modifiers {
    /// None.
    pub const NONE: Self = Self {
        shift: false,
        control: false,
        alt: false,
    };
    /// Shift alone.
    pub const SHIFT: Self = Self {
        shift: true,
        ..Self::NONE
    };
    /// Control alone.
    pub const CONTROL: Self = Self {
        control: true,
        ..Self::NONE
    };
    /// Alt alone.
    pub const ALT: Self = Self {
        alt: true,
        ..Self::NONE
    };
}

/// A key with those held beside it, pressed or repeated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Chord {
    /// Key.
    pub key: KeyName,
    /// Held beside it.
    pub modifiers: Modifiers,
}

impl Chord {
    /// A key with those held beside it.
    pub const fn new(key: KeyName, modifiers: Modifiers) -> Self {
        Self { key, modifiers }
    }
}

/// What the pointer does: a mouse, a pen, a finger.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PointerAct {
    /// The first button goes down, a finger touches.
    Press,
    /// It moves while it is down.
    Drag,
    /// The second button goes down.
    SecondPress,
    /// The wheel turns away from the hand.
    WheelUp,
    /// The wheel turns towards the hand.
    WheelDown,
}

/// What the pointer does, and on which cell of the screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pointer {
    /// What.
    pub act: PointerAct,
    /// Column of the cell.
    pub column: u16,
    /// Row of the cell.
    pub row: u16,
}

/// What a person does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ScreenEvent {
    /// Presses a key.
    Key(Chord),
    /// Points.
    Pointer(Pointer),
    /// Changes the size of the screen.
    Resize,
}
