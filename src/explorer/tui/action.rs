//! Keys: one table from key to action, which is also the help screen.

mod table;

use crate::tui::event::{Chord, KeyName, Modifiers};
use crate::tui::kinds::PanelKind;
use asperity_engine::scene::Knob;

pub use table::{KEYS, MOUSE};

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
    /// Put a knob at the step that is nearest to a value, SI.
    GoTo(Knob, f64),
    /// Put the knobs where a cell of the map of lives is, by its row and column.
    GoToCell(usize, usize),
    /// Type a value for the chosen knob.
    Type,
    /// A letter of it.
    Letter(char),
    /// Take its last letter back.
    Erase,
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
    /// Count cycles the other way: by their damage, or every contact as one, as the paper does.
    OtherCount,
    /// Let the surfaces age, or begin again with new ones.
    Age,
    /// Freeze this state to compare with; let it go again.
    Pin,
    /// What the material point shows.
    PointQuantity,
    /// The point of the other body.
    PointBody,
    /// A shallower (−1) or deeper (1) point.
    PointDepth(i32),
    /// Another point: so many quarters of a further on.
    MovePoint(i32),
    /// The point that is now at x/a.
    PutPoint(f64),
    /// Life against S, friction against S, friction against speed; of surfaces that age, what they do over the cycles.
    Curve,
    /// Replay the period of a passage that repeats, or go on with the run.
    Replay,
    /// Replay twice as fast (1) or half as fast (−1).
    ReplayFaster(i32),
    /// Start or stop recording.
    Record,
    /// Open the recording in the viewer.
    View,
    /// Write the scene as it now is.
    Save,
    /// Write the shown frame as fields, pictures and tables.
    Write,
    /// The list of lessons.
    Lessons,
    /// End the lesson.
    EndTour,
    /// On with the lesson: to what is shown, to the answer, to the next beat.
    NextBeat,
    /// Back to the beat before.
    PreviousBeat,
    /// The keys speak of this panel.
    Focus(PanelKind),
    /// The keys speak of the panel so many places further on.
    NextPanel(i32),
    /// Other units.
    Units,
    /// Other contrast.
    Contrast,
    /// The keys.
    Help,
    /// What is computed, what is left out, and why.
    Plan,
    /// Another scene, lay, wave, oil, model.
    Scene,
    /// Radii, moduli, load, speeds, oil, roughness, in numbers.
    OperatingPoint,
    /// Run the scene that was put together, begin the chosen lesson, give the focused panel the screen.
    Enter,
    /// Close what lies over the screen, shrink the panel, forget the probe, return to the present.
    Close,
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

/// One row of the key table: keys that belong together.
#[derive(Debug, Clone, Copy)]
pub struct Row {
    /// Each key and what it asks for. Upper-case letters stand for themselves: no shift beside them.
    pub keys: &'static [(Chord, Action)],
    /// The keys as the help screen writes them.
    pub shown: &'static str,
    /// What the help screen says.
    pub help: &'static str,
    /// Where in the help screen.
    pub group: Group,
}

/// What a key asks for.
pub fn lookup(chord: Chord) -> Option<Action> {
    let chord = normal(chord);
    KEYS.iter()
        .flat_map(|row| row.keys)
        .find(|(own, _)| *own == chord)
        .map(|(_, action)| *action)
}

/// What a key asks for while a value is typed: letters are letters.
pub fn lookup_typed(chord: Chord) -> Option<Action> {
    let chord = normal(chord);
    match chord.key {
        KeyName::Char(letter) if chord.modifiers == Modifiers::NONE => Some(Action::Letter(letter)),
        KeyName::Backspace => Some(Action::Erase),
        KeyName::Enter => Some(Action::Enter),
        KeyName::Esc => Some(Action::Close),
        _ => lookup(chord).filter(|action| matches!(action, Action::Quit | Action::Suspend)),
    }
}

/// Shift is part of a character already; terminals disagree on whether they name it too.
fn normal(mut chord: Chord) -> Chord {
    if let KeyName::Char(letter) = &mut chord.key {
        chord.modifiers.shift = false;
        if chord.modifiers.control {
            *letter = letter.to_ascii_lowercase();
        }
    }
    chord
}

#[cfg(test)]
mod tests {
    use super::*;

    fn press(key: KeyName, held: Modifiers) -> Option<Action> {
        lookup(Chord::new(key, held))
    }

    #[test]
    fn every_key_of_every_row_is_reached() {
        for row in KEYS {
            assert!(!row.help.is_empty() && !row.shown.is_empty());
            // Two columns on a screen of 80.
            assert!(row.help.chars().count() <= 29, "{}", row.help);
            for (chord, action) in row.keys {
                assert_eq!(lookup(*chord), Some(*action), "{}", row.shown);
            }
        }
    }

    #[test]
    fn no_key_stands_twice() {
        let chords: Vec<Chord> = KEYS
            .iter()
            .flat_map(|row| row.keys)
            .map(|(chord, _)| *chord)
            .collect();
        for (i, chord) in chords.iter().enumerate() {
            assert!(!chords[..i].contains(chord), "{chord:?} stands twice");
        }
    }

    #[test]
    fn terminals_that_name_shift_with_capitals_are_understood() {
        let named = press(KeyName::Char('H'), Modifiers::SHIFT);
        assert_eq!(named, Some(Action::TurnFar(-1)));
        let question = press(KeyName::Char('?'), Modifiers::SHIFT);
        assert_eq!(question, Some(Action::Help));
        let control = press(KeyName::Char('C'), Modifiers::CONTROL);
        assert_eq!(control, Some(Action::Quit));
    }

    #[test]
    fn digits_are_typical_values() {
        assert_eq!(
            press(KeyName::Char('3'), Modifiers::NONE),
            Some(Action::Typical(2))
        );
        assert_eq!(press(KeyName::Char('0'), Modifiers::NONE), None);
        assert_eq!(press(KeyName::Char('q'), Modifiers::ALT), None);
    }
}
