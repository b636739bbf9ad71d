//! Keys: one table from key to action, which is also the help screen.

use crossterm::event::{KeyCode, KeyEvent, KeyEventKind, KeyModifiers};

/// What a person asks for. The app turns it into a change of its own state and, where the run is
/// concerned, into a command.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Action {
    /// Leave.
    Quit,
    /// Hand the terminal back to the shell until `fg`.
    Suspend,
    /// Choose the knob after this one.
    ChooseNext,
    /// Choose the knob before this one.
    ChoosePrevious,
    /// Choose a knob by its place.
    Choose(usize),
    /// Turn the chosen knob by so many small steps.
    Turn(i32),
    /// Turn the chosen knob by so many big steps.
    TurnFar(i32),
    /// Put a knob at a part (0 to 1) of its slider.
    Slide(usize, f64),
    /// Put the chosen knob at its n-th typical value.
    Typical(usize),
    /// Put the chosen knob back where the scene has it.
    Home,
    /// Put all knobs back.
    HomeAll,
    /// Stop or go on stepping.
    TogglePause,
    /// One step (paused), or one frame forward (in the past).
    StepForward,
    /// One frame back.
    StepBack,
    /// Next map.
    NextMap,
    /// Previous map.
    PreviousMap,
    /// The contact, or the whole domain.
    Zoom,
    /// Read the map at a place given in parts of the picture (0 to 1 along and down).
    Probe(f64, f64),
    /// Keep this state to compare with.
    Pin,
    /// Forget the pinned state.
    Unpin,
    /// What the material point shows.
    PointQuantity,
    /// Start or stop recording.
    Record,
    /// Open the recording in the viewer.
    View,
    /// Write the scene as it now is.
    Save,
    /// Start, or end, the tour.
    Tour,
    /// Next lesson of the tour.
    NextLesson,
    /// Other units.
    Units,
    /// Other contrast.
    Contrast,
    /// The keys.
    Help,
    /// What is computed, what is left out, and why.
    Plan,
    /// Close what lies over the screen, forget the probe, return to the present.
    Close,
}

/// A key with its modifiers. Upper-case letters stand for themselves: no shift beside them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Chord {
    /// Key.
    pub code: KeyCode,
    /// Control and alt for characters; shift too for named keys.
    pub modifiers: KeyModifiers,
}

/// Part of the help screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Group {
    /// Turning knobs.
    Knobs,
    /// Time.
    Time,
    /// What is shown.
    Show,
    /// Outputs, and the program itself.
    Program,
}

impl Group {
    /// All groups, in the order of the help screen.
    pub const ALL: [Self; 4] = [Self::Knobs, Self::Time, Self::Show, Self::Program];

    /// Heading.
    pub fn name(self) -> &'static str {
        match self {
            Self::Knobs => "Knobs",
            Self::Time => "Time",
            Self::Show => "Show",
            Self::Program => "Program",
        }
    }
}

/// One row of the key table.
#[derive(Debug, Clone, Copy)]
pub struct Binding {
    /// Keys that do the same.
    pub chords: &'static [Chord],
    /// The keys as the help screen writes them.
    pub shown: &'static str,
    /// What they do.
    pub action: Action,
    /// What the help screen says.
    pub help: &'static str,
    /// Where in the help screen.
    pub group: Group,
}

const fn key(code: KeyCode) -> Chord {
    Chord {
        code,
        modifiers: KeyModifiers::NONE,
    }
}
const fn ch(letter: char) -> Chord {
    key(KeyCode::Char(letter))
}
const fn shift(code: KeyCode) -> Chord {
    Chord {
        code,
        modifiers: KeyModifiers::SHIFT,
    }
}
const fn ctrl(letter: char) -> Chord {
    Chord {
        code: KeyCode::Char(letter),
        modifiers: KeyModifiers::CONTROL,
    }
}
const fn row(
    chords: &'static [Chord],
    shown: &'static str,
    action: Action,
    help: &'static str,
    group: Group,
) -> Binding {
    Binding {
        chords,
        shown,
        action,
        help,
        group,
    }
}

/// The key table: what the keyboard does, and what `?` shows. Digits are in [`lookup`]: they are
/// nine rows of one kind.
pub const KEYS: &[Binding] = &[
    row(
        &[key(KeyCode::Up), ch('k')],
        "↑ k",
        Action::ChoosePrevious,
        "choose the knob above",
        Group::Knobs,
    ),
    row(
        &[key(KeyCode::Down), ch('j'), key(KeyCode::Tab)],
        "↓ j",
        Action::ChooseNext,
        "choose the knob below",
        Group::Knobs,
    ),
    row(
        &[key(KeyCode::Left), ch('h')],
        "← h",
        Action::Turn(-1),
        "turn it down",
        Group::Knobs,
    ),
    row(
        &[key(KeyCode::Right), ch('l')],
        "→ l",
        Action::Turn(1),
        "turn it up",
        Group::Knobs,
    ),
    row(
        &[shift(KeyCode::Left), ch('H'), key(KeyCode::PageDown)],
        "⇧← H",
        Action::TurnFar(-1),
        "down by a big step",
        Group::Knobs,
    ),
    row(
        &[shift(KeyCode::Right), ch('L'), key(KeyCode::PageUp)],
        "⇧→ L",
        Action::TurnFar(1),
        "up by a big step",
        Group::Knobs,
    ),
    row(
        &[ch('x'), key(KeyCode::Home)],
        "x",
        Action::Home,
        "back to the scene's value",
        Group::Knobs,
    ),
    row(
        &[ch('X')],
        "X",
        Action::HomeAll,
        "all knobs back",
        Group::Knobs,
    ),
    row(
        &[ch(' ')],
        "space",
        Action::TogglePause,
        "pause, go on",
        Group::Time,
    ),
    row(
        &[ch('.')],
        ".",
        Action::StepForward,
        "one step",
        Group::Time,
    ),
    row(
        &[ch(',')],
        ",",
        Action::StepBack,
        "one frame back",
        Group::Time,
    ),
    row(
        &[ch('t')],
        "t",
        Action::Tour,
        "start or end the tour",
        Group::Time,
    ),
    row(
        &[ch('n')],
        "n",
        Action::NextLesson,
        "next lesson of the tour",
        Group::Time,
    ),
    row(&[ch('m')], "m", Action::NextMap, "next map", Group::Show),
    row(
        &[ch('M')],
        "M",
        Action::PreviousMap,
        "map before",
        Group::Show,
    ),
    row(
        &[ch('z')],
        "z",
        Action::Zoom,
        "the contact, or the whole domain",
        Group::Show,
    ),
    row(
        &[ch('p')],
        "p",
        Action::PointQuantity,
        "material point: pressure or shear",
        Group::Show,
    ),
    row(
        &[ch('b')],
        "b",
        Action::Pin,
        "pin this state to compare with",
        Group::Show,
    ),
    row(
        &[ch('B')],
        "B",
        Action::Unpin,
        "forget the pinned state",
        Group::Show,
    ),
    row(&[ch('u')], "u", Action::Units, "other units", Group::Show),
    row(
        &[ch('c')],
        "c",
        Action::Contrast,
        "high contrast",
        Group::Show,
    ),
    row(
        &[ch('i')],
        "i",
        Action::Plan,
        "what is computed and what is left out",
        Group::Show,
    ),
    row(
        &[ch('r')],
        "r",
        Action::Record,
        "recording on or off",
        Group::Program,
    ),
    row(
        &[ch('v')],
        "v",
        Action::View,
        "open the recording in the viewer",
        Group::Program,
    ),
    row(
        &[ch('s')],
        "s",
        Action::Save,
        "save the scene as it now is",
        Group::Program,
    ),
    row(
        &[ch('?'), key(KeyCode::F(1))],
        "?",
        Action::Help,
        "these keys",
        Group::Program,
    ),
    row(
        &[key(KeyCode::Esc)],
        "Esc",
        Action::Close,
        "close this; back to the present",
        Group::Program,
    ),
    row(
        &[ctrl('z')],
        "^Z",
        Action::Suspend,
        "to the shell; fg returns",
        Group::Program,
    ),
    row(
        &[ch('q'), ctrl('c')],
        "q ^C",
        Action::Quit,
        "quit",
        Group::Program,
    ),
];

/// What the digits do, for the help screen.
pub const DIGITS: (&str, &str) = ("1-9", "a typical value of the knob");

/// What the mouse does, for the help screen.
pub const MOUSE: &[(&str, &str)] = &[
    ("drag", "a slider"),
    ("wheel", "turns the knob under it"),
    ("click", "on the map: read it there"),
];

/// What a key event asks for.
pub fn lookup(event: &KeyEvent) -> Option<Action> {
    if event.kind == KeyEventKind::Release {
        return None;
    }
    let chord = normal(event);
    if let KeyCode::Char(digit @ '1'..='9') = chord.code
        && chord.modifiers.is_empty()
    {
        return Some(Action::Typical(digit as usize - '1' as usize));
    }
    KEYS.iter()
        .find(|binding| binding.chords.contains(&chord))
        .map(|binding| binding.action)
}

/// Shift is part of a character already; terminals disagree on whether they name it too.
fn normal(event: &KeyEvent) -> Chord {
    let mut modifiers =
        event.modifiers & (KeyModifiers::SHIFT | KeyModifiers::CONTROL | KeyModifiers::ALT);
    let mut code = event.code;
    if let KeyCode::Char(letter) = code {
        modifiers -= KeyModifiers::SHIFT;
        if modifiers.contains(KeyModifiers::CONTROL) {
            code = KeyCode::Char(letter.to_ascii_lowercase());
        }
    }
    Chord { code, modifiers }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn press(code: KeyCode, modifiers: KeyModifiers) -> Option<Action> {
        lookup(&KeyEvent::new(code, modifiers))
    }

    #[test]
    fn every_row_is_reached_by_each_of_its_keys() {
        for binding in KEYS {
            assert!(!binding.help.is_empty() && !binding.shown.is_empty());
            for chord in binding.chords {
                assert_eq!(
                    press(chord.code, chord.modifiers),
                    Some(binding.action),
                    "{} is taken by a row above",
                    binding.shown
                );
            }
        }
    }

    #[test]
    fn no_key_stands_twice() {
        let chords: Vec<Chord> = KEYS.iter().flat_map(|b| b.chords).copied().collect();
        for (i, chord) in chords.iter().enumerate() {
            assert!(!chords[..i].contains(chord), "{chord:?} stands twice");
        }
    }

    #[test]
    fn terminals_that_name_shift_with_capitals_are_understood() {
        let named = press(KeyCode::Char('H'), KeyModifiers::SHIFT);
        assert_eq!(named, Some(Action::TurnFar(-1)));
        let question = press(KeyCode::Char('?'), KeyModifiers::SHIFT);
        assert_eq!(question, Some(Action::Help));
        let control = press(KeyCode::Char('C'), KeyModifiers::CONTROL);
        assert_eq!(control, Some(Action::Quit));
    }

    #[test]
    fn digits_are_typical_values_and_releases_are_nothing() {
        assert_eq!(
            press(KeyCode::Char('3'), KeyModifiers::NONE),
            Some(Action::Typical(2))
        );
        assert_eq!(press(KeyCode::Char('0'), KeyModifiers::NONE), None);
        let mut release = KeyEvent::new(KeyCode::Char('q'), KeyModifiers::NONE);
        release.kind = KeyEventKind::Release;
        assert_eq!(lookup(&release), None);
        assert_eq!(press(KeyCode::Char('q'), KeyModifiers::ALT), None);
    }
}
