//! The key table itself.

use super::{Action, Group, Row};
use crate::tui::event::KeyName as Name;
use crate::tui::event::{Chord, Modifiers};

const fn key(key: Name) -> Chord {
    Chord::new(key, Modifiers::NONE)
}
const fn ch(letter: char) -> Chord {
    key(Name::Char(letter))
}
const fn shift(key: Name) -> Chord {
    Chord::new(key, Modifiers::SHIFT)
}
const fn ctrl(letter: char) -> Chord {
    Chord::new(Name::Char(letter), Modifiers::CONTROL)
}

/// Rows by their group: the keys as the help screen writes them, what it says, and what each key asks for.
macro_rules! rows {
    ($($group:ident { $($shown:literal, $help:literal: $($key:expr => $action:ident $(($by:expr))?),+;)+ })+) => {
        &[$($(Row {
            keys: &[$(($key, Action::$action $(($by))?)),+],
            shown: $shown,
            help: $help,
            group: Group::$group,
        }),+),+]
    };
}

/// The key table: what the keyboard does, and what `?` shows.
pub const KEYS: &[Row] = rows! {
    Knobs {
        "↑↓ kj", "choose a knob":
            key(Name::Up) => ChoosePrevious, ch('k') => ChoosePrevious, key(Name::Down) => ChooseNext,
            ch('j') => ChooseNext;
        "←→ hl", "turn it":
            key(Name::Left) => Turn(-1), ch('h') => Turn(-1), key(Name::Right) => Turn(1), ch('l') => Turn(1);
        "⇧←→ HL", "in big steps":
            shift(Name::Left) => TurnFar(-1), ch('H') => TurnFar(-1), key(Name::PageDown) => TurnFar(-1),
            shift(Name::Right) => TurnFar(1), ch('L') => TurnFar(1), key(Name::PageUp) => TurnFar(1);
        "1-9", "typical values":
            ch('1') => Typical(0), ch('2') => Typical(1), ch('3') => Typical(2), ch('4') => Typical(3),
            ch('5') => Typical(4), ch('6') => Typical(5), ch('7') => Typical(6), ch('8') => Typical(7),
            ch('9') => Typical(8);
        "=", "type a value, as in = 0.37 ⏎": ch('=') => Type;
        "x X", "reset the knob; all knobs": ch('x') => Home, key(Name::Home) => Home, ch('X') => HomeAll;
    }
    Time {
        "space", "pause, go on": ch(' ') => TogglePause;
        ". ,", "one step; one frame back": ch('.') => StepForward, ch(',') => StepBack;
        "o", "replay one period; live again": ch('o') => Replay;
        "- +", "replay, age: slower, faster": ch('-') => ReplayFaster(-1), ch('+') => ReplayFaster(1);
        "t T", "lessons; end the lesson": ch('t') => Lessons, ch('T') => EndTour;
        "n N", "lesson: go on; go back": ch('n') => NextBeat, ch('N') => PreviousBeat;
    }
    Show {
        "Tab", "another panel":
            key(Name::Tab) => NextPanel(1), key(Name::BackTab) => NextPanel(-1), shift(Name::BackTab) => NextPanel(-1);
        "⏎", "panel whole; run; start": key(Name::Enter) => Enter;
        "m M", "next map; map before": ch('m') => NextMap, ch('M') => PreviousMap;
        "z", "contact or whole domain": ch('z') => Zoom;
        "p", "point: p, p-Hertz, shear, σ": ch('p') => PointQuantity;
        "P [ ]", "point: body; its depth": ch('P') => PointBody, ch('[') => PointDepth(-1), ch(']') => PointDepth(1);
        "< >", "another point of the body": ch('<') => MovePoint(-1), ch('>') => MovePoint(1);
        "b", "freeze to compare; release": ch('b') => Pin;
        "y", "life, friction, life map": ch('y') => Curve;
        "a", "count: by damage, Pu et al.": ch('a') => OtherCount;
        "g", "age the surfaces; new ones": ch('g') => Age;
        "u", "other units": ch('u') => Units;
        "c", "contrast: high, light": ch('c') => Contrast;
        "i", "plan: what is computed, why": ch('i') => Plan;
    }
    Program {
        "e E", "change scene; operating point": ch('e') => Scene, ch('E') => OperatingPoint;
        "r", "recording on or off": ch('r') => Record;
        "v", "open the recording": ch('v') => View;
        "s", "save the scene as it is now": ch('s') => Save;
        "w", "export: npz, png, csv": ch('w') => Write;
        "?", "these keys": ch('?') => Help, key(Name::F(1)) => Help;
        "Esc", "close; back to the present": key(Name::Esc) => Close;
        "^Z", "to the shell; fg returns": ctrl('z') => Suspend;
        "q ^C", "quit": ch('q') => Quit, ctrl('c') => Quit;
    }
};

/// What the mouse does, for the help screen.
pub const MOUSE: &[(&str, &str)] = &[
    ("drag", "a slider"),
    ("wheel", "turns the knob under it"),
    ("click", "on the map: read values"),
    ("click", "on the trace: follow it"),
    ("click", "on life against S: go there"),
    ("click", "on a key below, on an answer"),
];
