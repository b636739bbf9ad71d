//! The key table itself.

use super::{Action, Group, Row};
use crate::tui::event::{Chord, KeyName, Modifiers};

const fn key(key: KeyName) -> Chord {
    Chord::new(key, Modifiers::NONE)
}
const fn ch(letter: char) -> Chord {
    key(KeyName::Char(letter))
}
const fn shift(key: KeyName) -> Chord {
    Chord::new(key, Modifiers::SHIFT)
}
const fn ctrl(letter: char) -> Chord {
    Chord::new(KeyName::Char(letter), Modifiers::CONTROL)
}
const fn row(
    keys: &'static [(Chord, Action)],
    shown: &'static str,
    help: &'static str,
    group: Group,
) -> Row {
    Row {
        keys,
        shown,
        help,
        group,
    }
}

/// The key table: what the keyboard does, and what `?` shows.
pub const KEYS: &[Row] = &[
    row(
        &[
            (key(KeyName::Up), Action::ChoosePrevious),
            (ch('k'), Action::ChoosePrevious),
            (key(KeyName::Down), Action::ChooseNext),
            (ch('j'), Action::ChooseNext),
        ],
        "↑↓ kj",
        "choose a knob",
        Group::Knobs,
    ),
    row(
        &[
            (key(KeyName::Left), Action::Turn(-1)),
            (ch('h'), Action::Turn(-1)),
            (key(KeyName::Right), Action::Turn(1)),
            (ch('l'), Action::Turn(1)),
        ],
        "←→ hl",
        "turn it",
        Group::Knobs,
    ),
    row(
        &[
            (shift(KeyName::Left), Action::TurnFar(-1)),
            (ch('H'), Action::TurnFar(-1)),
            (key(KeyName::PageDown), Action::TurnFar(-1)),
            (shift(KeyName::Right), Action::TurnFar(1)),
            (ch('L'), Action::TurnFar(1)),
            (key(KeyName::PageUp), Action::TurnFar(1)),
        ],
        "⇧←→ HL",
        "in big steps",
        Group::Knobs,
    ),
    row(
        &[
            (ch('1'), Action::Typical(0)),
            (ch('2'), Action::Typical(1)),
            (ch('3'), Action::Typical(2)),
            (ch('4'), Action::Typical(3)),
            (ch('5'), Action::Typical(4)),
            (ch('6'), Action::Typical(5)),
            (ch('7'), Action::Typical(6)),
            (ch('8'), Action::Typical(7)),
            (ch('9'), Action::Typical(8)),
        ],
        "1-9",
        "typical values",
        Group::Knobs,
    ),
    row(
        &[(ch('='), Action::Type)],
        "=",
        "type a value, as in = 0.37 ⏎",
        Group::Knobs,
    ),
    row(
        &[
            (ch('x'), Action::Home),
            (key(KeyName::Home), Action::Home),
            (ch('X'), Action::HomeAll),
        ],
        "x X",
        "reset the knob; all knobs",
        Group::Knobs,
    ),
    row(
        &[(ch(' '), Action::TogglePause)],
        "space",
        "pause, go on",
        Group::Time,
    ),
    row(
        &[(ch('.'), Action::StepForward), (ch(','), Action::StepBack)],
        ". ,",
        "one step; one frame back",
        Group::Time,
    ),
    row(
        &[(ch('o'), Action::Replay)],
        "o",
        "replay one period; live again",
        Group::Time,
    ),
    row(
        &[
            (ch('-'), Action::ReplayFaster(-1)),
            (ch('+'), Action::ReplayFaster(1)),
        ],
        "- +",
        "replay slower, faster",
        Group::Time,
    ),
    row(
        &[(ch('t'), Action::Lessons), (ch('T'), Action::EndTour)],
        "t T",
        "lessons; end the lesson",
        Group::Time,
    ),
    row(
        &[(ch('n'), Action::NextBeat), (ch('N'), Action::PreviousBeat)],
        "n N",
        "lesson: go on; go back",
        Group::Time,
    ),
    row(
        &[
            (key(KeyName::Tab), Action::NextPanel(1)),
            (key(KeyName::BackTab), Action::NextPanel(4)),
            (shift(KeyName::BackTab), Action::NextPanel(4)),
        ],
        "Tab",
        "another panel",
        Group::Show,
    ),
    row(
        &[(key(KeyName::Enter), Action::Enter)],
        "⏎",
        "panel whole; run; start",
        Group::Show,
    ),
    row(
        &[(ch('m'), Action::NextMap), (ch('M'), Action::PreviousMap)],
        "m M",
        "next map; map before",
        Group::Show,
    ),
    row(
        &[(ch('z'), Action::Zoom)],
        "z",
        "contact or whole domain",
        Group::Show,
    ),
    row(
        &[(ch('p'), Action::PointQuantity)],
        "p",
        "point: p, p-Hertz, shear, σ",
        Group::Show,
    ),
    row(
        &[
            (ch('P'), Action::PointBody),
            (ch('['), Action::PointDepth(-1)),
            (ch(']'), Action::PointDepth(1)),
        ],
        "P [ ]",
        "point: body; its depth",
        Group::Show,
    ),
    row(
        &[
            (ch('<'), Action::MovePoint(-1)),
            (ch('>'), Action::MovePoint(1)),
        ],
        "< >",
        "another point of the body",
        Group::Show,
    ),
    row(
        &[(ch('b'), Action::Pin)],
        "b",
        "freeze to compare; release",
        Group::Show,
    ),
    row(
        &[(ch('y'), Action::Curve)],
        "y",
        "life, friction, Stribeck",
        Group::Show,
    ),
    row(&[(ch('u'), Action::Units)], "u", "other units", Group::Show),
    row(
        &[(ch('c'), Action::Contrast)],
        "c",
        "contrast: high, light",
        Group::Show,
    ),
    row(
        &[(ch('g'), Action::Pixels)],
        "g",
        "map in blocks, sixels, kitty",
        Group::Show,
    ),
    row(
        &[(ch('i'), Action::Plan)],
        "i",
        "plan: what is computed, why",
        Group::Show,
    ),
    row(
        &[(ch('e'), Action::Scene), (ch('E'), Action::OperatingPoint)],
        "e E",
        "change scene; operating point",
        Group::Program,
    ),
    row(
        &[(ch('r'), Action::Record)],
        "r",
        "recording on or off",
        Group::Program,
    ),
    row(
        &[(ch('v'), Action::View)],
        "v",
        "open the recording",
        Group::Program,
    ),
    row(
        &[(ch('s'), Action::Save)],
        "s",
        "save the scene as it is now",
        Group::Program,
    ),
    row(
        &[(ch('w'), Action::Write)],
        "w",
        "export: npz, png, csv",
        Group::Program,
    ),
    row(
        &[(ch('?'), Action::Help), (key(KeyName::F(1)), Action::Help)],
        "?",
        "these keys",
        Group::Program,
    ),
    row(
        &[(key(KeyName::Esc), Action::Close)],
        "Esc",
        "close; back to the present",
        Group::Program,
    ),
    row(
        &[(ctrl('z'), Action::Suspend)],
        "^Z",
        "to the shell; fg returns",
        Group::Program,
    ),
    row(
        &[(ch('q'), Action::Quit), (ctrl('c'), Action::Quit)],
        "q ^C",
        "quit",
        Group::Program,
    ),
];

/// What the mouse does, for the help screen.
pub const MOUSE: &[(&str, &str)] = &[
    ("drag", "a slider"),
    ("wheel", "turns the knob under it"),
    ("click", "on the map: read values"),
    ("click", "on the trace: follow it"),
    ("click", "on life against S: go there"),
    ("click", "on a key in the last line"),
];
