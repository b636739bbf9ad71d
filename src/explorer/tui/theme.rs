//! Colours and shapes: what a terminal can show, roles in place of colours, and colour maps.
//!
//! The role colours are the eight of Okabe & Ito (2008), which people of every colour vision tell
//! apart; the maps rise monotonically in lightness (diverging ones fall again), so that they also
//! read in grey. Without colour the same maps are drawn by characters of growing ink.

mod ramp;

use ratatui::style::{Color, Modifier, Style};
use ratatui::text::{Line, Span};

use asperity_picture::Ramp;
use ramp::{map_index, nearest_index};

/// How many colours the terminal shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColorDepth {
    /// 24 bits.
    True,
    /// 256 colours.
    Indexed,
    /// None: weight and shape only.
    Mono,
}

/// Which characters the terminal shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Glyphs {
    /// Blocks, Braille, arrows.
    Unicode,
    /// ASCII only.
    Ascii,
}

/// How strongly things stand out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Contrast {
    /// Secondary things are dimmed.
    #[default]
    Normal,
    /// Nothing is dimmed, borders are bright.
    High,
    /// Dark colours for a light background.
    Light,
}

impl Contrast {
    /// Reads the background from `COLORFGBG` (`foreground;background`), which some terminals set.
    pub fn detect(variable: impl Fn(&str) -> Option<String>) -> Self {
        let background =
            variable("COLORFGBG").and_then(|colors| colors.rsplit(';').next().map(str::to_owned));
        match background.as_deref() {
            Some("7" | "15") => Self::Light,
            _ => Self::Normal,
        }
    }
}

/// What a terminal can show.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Capabilities {
    /// Colours.
    pub depth: ColorDepth,
    /// Characters.
    pub glyphs: Glyphs,
}

impl Capabilities {
    /// Reads them from the environment's variables (`NO_COLOR`, `COLORTERM`, `TERM`, the locale).
    pub fn detect(variable: impl Fn(&str) -> Option<String>) -> Self {
        let filled = |name: &str| variable(name).filter(|value| !value.is_empty());
        let term = filled("TERM").unwrap_or_default();
        let locale = filled("LC_ALL")
            .or_else(|| filled("LC_CTYPE"))
            .or_else(|| filled("LANG"));
        let plain_locale = locale.is_some_and(|name| name == "C" || name == "POSIX");
        let glyphs = if plain_locale || term == "dumb" {
            Glyphs::Ascii
        } else {
            Glyphs::Unicode
        };
        let (colors, program) = (filled("COLORTERM"), filled("TERM_PROGRAM"));
        let depth = if filled("NO_COLOR").is_some() || term == "dumb" {
            ColorDepth::Mono
        } else {
            depth_of(&term, colors.as_deref(), program.as_deref())
        };
        Self { depth, glyphs }
    }
}

/// 24 bits where the terminal says so or is known for it; 256 colours are known to all others, which bring them to their own.
fn depth_of(term: &str, colorterm: Option<&str>, program: Option<&str>) -> ColorDepth {
    const NAMES: [&str; 6] = ["kitty", "alacritty", "ghostty", "wezterm", "foot", "direct"];
    const PROGRAMS: [&str; 4] = ["iTerm.app", "WezTerm", "ghostty", "vscode"];
    let is_declared = matches!(colorterm, Some("truecolor" | "24bit"));
    let is_known = NAMES.iter().any(|name| term.contains(name));
    let is_hosted = program.is_some_and(|program| PROGRAMS.contains(&program));
    if is_declared || is_known || is_hosted {
        ColorDepth::True
    } else {
        ColorDepth::Indexed
    }
}

/// What a thing on the screen is; the theme decides how it looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Plain text.
    Text,
    /// Values that lead.
    Strong,
    /// Secondary text.
    Dim,
    /// Lines around panels.
    Border,
    /// Names of panels.
    Title,
    /// Keys that may be pressed.
    Key,
    /// What is chosen.
    Chosen,
    /// Body 1.
    Body1,
    /// Body 2.
    Body2,
    /// Pressure.
    Pressure,
    /// Film.
    Film,
    /// Hertz pressure behind it.
    Hertz,
    /// Shear stress.
    Shear,
    /// The mechanism *cycles*.
    Cycles,
    /// The mechanism *peaks*.
    Peaks,
    /// The mechanism *traction*.
    Traction,
    /// What a formula says (in place of the simulation).
    Formula,
    /// All is well.
    Good,
    /// Look here.
    Warn,
    /// Something failed.
    Bad,
}

/// Colours, characters and contrast together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Theme {
    /// What the terminal can show.
    pub capabilities: Capabilities,
    /// Contrast.
    pub contrast: Contrast,
}

impl Theme {
    /// A theme for those capabilities, of normal contrast.
    pub fn new(capabilities: Capabilities) -> Self {
        Self {
            capabilities,
            contrast: Contrast::Normal,
        }
    }

    /// Same theme, next contrast.
    pub fn next_contrast(&mut self) {
        self.contrast = match self.contrast {
            Contrast::Normal => Contrast::High,
            Contrast::High => Contrast::Light,
            Contrast::Light => Contrast::Normal,
        };
    }

    /// Whether only ASCII may be drawn.
    pub fn is_ascii(self) -> bool {
        self.capabilities.glyphs == Glyphs::Ascii
    }

    /// Whether there are no colours at all.
    pub fn is_mono(self) -> bool {
        self.capabilities.depth == ColorDepth::Mono
    }

    /// Paper and ink of the whole screen, where they are not the terminal's own: dark colours on a dark background
    /// would not be read.
    pub fn page(self) -> Option<Style> {
        let light = self.contrast == Contrast::Light && !self.is_mono();
        light.then(|| Style::new().bg(self.rgb(PAPER)).fg(self.rgb(INK)))
    }

    /// `unicode`, or `ascii` where only that may be drawn.
    pub fn pick(self, unicode: &'static str, ascii: &'static str) -> &'static str {
        if self.is_ascii() { ascii } else { unicode }
    }

    /// Words as they are, in ASCII where only that may be drawn.
    pub(crate) fn words(self, text: impl AsRef<str>) -> String {
        let text = text.as_ref();
        if self.is_ascii() {
            in_ascii(text)
        } else {
            text.to_owned()
        }
    }

    /// Words in the look of a role, as a part of a line.
    pub(crate) fn span(self, text: impl AsRef<str>, role: Role) -> Span<'static> {
        Span::styled(self.words(text), self.style(role))
    }

    /// Words in the look of a role, as a line.
    pub(crate) fn line(self, text: impl AsRef<str>, role: Role) -> Line<'static> {
        Line::styled(self.words(text), self.style(role))
    }

    /// Whether maps are drawn in half blocks of colour (else in characters of growing ink).
    pub fn paints(self) -> bool {
        !self.is_ascii()
            && matches!(
                self.capabilities.depth,
                ColorDepth::True | ColorDepth::Indexed
            )
    }

    /// How a thing looks.
    pub fn style(self, role: Role) -> Style {
        let mut style = Style::new().add_modifier(weight(role));
        match self.role_color(role) {
            Some(color) => style = style.fg(color),
            None if role == Role::Dim && self.contrast != Contrast::High => {
                style = style.add_modifier(Modifier::DIM);
            }
            None => {}
        }
        if self.capabilities.depth == ColorDepth::Mono && role == Role::Bad {
            style = style.add_modifier(Modifier::REVERSED);
        }
        style
    }

    /// A colour of a map, `t` from 0 to 1.
    pub fn map_color(self, ramp: Ramp, t: f32) -> Color {
        if self.capabilities.depth == ColorDepth::Indexed {
            return Color::Indexed(map_index(ramp, t));
        }
        self.rgb(ramp.colour(t, 1.0))
    }

    /// A character of a map, `t` from 0 to 1.
    pub fn map_ink(t: f32) -> &'static str {
        ramp::ink(t)
    }

    /// A colour in the terminal's depth (no colour where it shows none).
    pub fn rgb(self, [r, g, b]: [u8; 3]) -> Color {
        match self.capabilities.depth {
            ColorDepth::True => Color::Rgb(r, g, b),
            ColorDepth::Indexed => Color::Indexed(nearest_index([r, g, b])),
            ColorDepth::Mono => Color::Reset,
        }
    }

    fn role_color(self, role: Role) -> Option<Color> {
        match self.capabilities.depth {
            ColorDepth::Mono => None,
            ColorDepth::True | ColorDepth::Indexed => {
                let rgb = match (role, self.contrast) {
                    (Role::Text | Role::Strong | Role::Title, Contrast::Light) => INK,
                    (Role::Text | Role::Strong, _) => return Some(Color::Reset),
                    (Role::Dim, Contrast::Normal) => [140, 146, 162],
                    (Role::Border, Contrast::Normal) => [84, 92, 112],
                    (Role::Dim, Contrast::Light) => [92, 96, 108],
                    (Role::Border | Role::Hertz, Contrast::Light) => [150, 154, 166],
                    (Role::Title, _) | (Role::Dim | Role::Border, Contrast::High) => {
                        return Some(Color::Reset);
                    }
                    // The same hue for a light background.
                    (_, Contrast::Light) => okabe_ito(role).map(|c| (f32::from(c) * 0.55) as u8),
                    _ => okabe_ito(role),
                };
                Some(self.rgb(rgb))
            }
        }
    }
}

/// What only Unicode terminals show, in letters for those that do not.
fn in_ascii(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '∞' => plain.push_str("inf"),
            'λ' => plain.push_str("lambda"),
            'ζ' => plain.push_str("zeta"),
            'µ' | 'μ' => plain.push('u'),
            'σ' => plain.push_str("sigma"),
            'τ' => plain.push_str("tau"),
            '₁' => plain.push('1'),
            'ᵢ' => plain.push('i'),
            '₂' => plain.push('2'),
            '×' => plain.push('x'),
            '→' => plain.push_str("->"),
            '–' | '−' => plain.push('-'),
            '≈' => plain.push('~'),
            '≥' => plain.push_str(">="),
            '≤' => plain.push_str("<="),
            '±' => plain.push_str("+-"),
            '·' => plain.push('.'),
            '…' => plain.push_str("..."),
            '⏎' => plain.push_str("CR"),
            '◂' => plain.push('<'),
            '▸' => plain.push('>'),
            other if other.is_ascii() => plain.push(other),
            _ => plain.push('?'),
        }
    }
    plain
}

/// Of the light contrast.
const PAPER: [u8; 3] = [250, 250, 247];
const INK: [u8; 3] = [24, 26, 32];

fn weight(role: Role) -> Modifier {
    match role {
        Role::Strong | Role::Key | Role::Chosen | Role::Bad | Role::Title => Modifier::BOLD,
        Role::Formula => Modifier::ITALIC,
        _ => Modifier::empty(),
    }
}

/// Of Okabe & Ito, made lighter for a dark background.
fn okabe_ito(role: Role) -> [u8; 3] {
    match role {
        Role::Text | Role::Strong | Role::Title | Role::Dim | Role::Border => [222, 226, 235],
        Role::Key | Role::Chosen | Role::Warn | Role::Body1 => [240, 228, 66],
        Role::Body2 | Role::Shear => [214, 140, 184],
        Role::Pressure | Role::Peaks => [232, 106, 30],
        Role::Film | Role::Formula => [86, 180, 233],
        Role::Hertz => [122, 128, 142],
        Role::Cycles => [230, 170, 20],
        Role::Traction | Role::Good => [20, 176, 130],
        Role::Bad => [255, 82, 82],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn from(pairs: &[(&str, &str)]) -> Capabilities {
        Capabilities::detect(|name| {
            pairs
                .iter()
                .find(|(key, _)| *key == name)
                .map(|(_, value)| (*value).to_owned())
        })
    }

    #[test]
    fn capabilities_follow_the_environment() {
        let true_color = from(&[("TERM", "xterm-256color"), ("COLORTERM", "truecolor")]);
        assert_eq!(true_color.depth, ColorDepth::True);
        assert_eq!(
            from(&[("TERM", "tmux-256color")]).depth,
            ColorDepth::Indexed
        );
        assert_eq!(from(&[("TERM", "linux")]).depth, ColorDepth::Indexed);
        let none = from(&[("TERM", "xterm-256color"), ("NO_COLOR", "1")]);
        assert_eq!(none.depth, ColorDepth::Mono);
        // An empty NO_COLOR counts as unset (no-color.org).
        let empty = from(&[("TERM", "xterm-256color"), ("NO_COLOR", "")]);
        assert_eq!(empty.depth, ColorDepth::Indexed);
        assert_eq!(from(&[("LC_ALL", "C")]).glyphs, Glyphs::Ascii);
        assert_eq!(from(&[("LANG", "C.UTF-8")]).glyphs, Glyphs::Unicode);
    }
}
