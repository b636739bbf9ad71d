//! Colours and shapes: what a terminal can show, roles in place of colours, and colour maps.
//!
//! The role colours are the eight of Okabe & Ito (2008), which people of every colour vision tell
//! apart; the maps rise monotonically in lightness (diverging ones fall again), so that they also
//! read in grey. Without colour the same maps are drawn by characters of growing ink.

use ratatui::style::{Color, Modifier, Style};

/// How many colours the terminal shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColorDepth {
    /// 24 bits.
    True,
    /// 256 colours.
    Indexed,
    /// The 16 colours of the terminal's own palette.
    Basic,
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
        let depth = if filled("NO_COLOR").is_some() || term == "dumb" {
            ColorDepth::Mono
        } else {
            depth_of(
                &term,
                filled("COLORTERM").as_deref(),
                filled("TERM_PROGRAM").as_deref(),
            )
        };
        Self { depth, glyphs }
    }
}

fn depth_of(term: &str, colorterm: Option<&str>, program: Option<&str>) -> ColorDepth {
    let declared = matches!(colorterm, Some("truecolor" | "24bit"));
    let known = ["kitty", "alacritty", "ghostty", "wezterm", "foot", "direct"]
        .iter()
        .any(|name| term.contains(name));
    let hosted = matches!(
        program,
        Some("iTerm.app" | "WezTerm" | "ghostty" | "vscode")
    );
    if declared || known || hosted {
        ColorDepth::True
    } else if term.contains("256color") {
        ColorDepth::Indexed
    } else {
        ColorDepth::Basic
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

/// A colour map.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ramp {
    /// Black, red, yellow: pressure and stress.
    Heat,
    /// Dark blue to pale green: depth of film, reversed, as deep water is dark.
    Depth,
    /// Blue, grey, orange: heights.
    Diverging,
}

/// Colours, characters and contrast together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Theme {
    /// What the terminal can show.
    pub capabilities: Capabilities,
    /// Contrast.
    pub contrast: Contrast,
}

const HEAT: [[u8; 3]; 8] = [
    [12, 8, 38],
    [58, 12, 96],
    [119, 28, 109],
    [179, 46, 88],
    [229, 85, 48],
    [250, 141, 20],
    [247, 204, 70],
    [252, 252, 190],
];
const DEPTH: [[u8; 3]; 7] = [
    [14, 16, 60],
    [28, 52, 122],
    [30, 98, 150],
    [36, 146, 156],
    [74, 188, 140],
    [150, 222, 120],
    [232, 246, 168],
];
const DIVERGING: [[u8; 3]; 7] = [
    [20, 80, 160],
    [78, 140, 204],
    [150, 188, 222],
    [226, 226, 226],
    [240, 188, 130],
    [222, 132, 52],
    [164, 78, 10],
];
/// The same maps chosen from the 256 colours by hand: the nearest ones would mix in greys.
const HEAT_INDEXED: [u8; 13] = [17, 53, 54, 90, 126, 162, 168, 203, 208, 214, 220, 227, 230];
const DEPTH_INDEXED: [u8; 12] = [17, 18, 24, 25, 31, 37, 43, 79, 114, 150, 192, 229];
const DIVERGING_INDEXED: [u8; 13] = [25, 32, 74, 110, 152, 188, 254, 223, 216, 209, 173, 166, 130];
/// Characters of growing ink, one step each.
const INK: [&str; 10] = [" ", ".", ":", "-", "=", "+", "*", "#", "%", "@"];

impl Theme {
    /// A theme for those capabilities, of normal contrast.
    pub fn new(capabilities: Capabilities) -> Self {
        Self {
            capabilities,
            contrast: Contrast::Normal,
        }
    }

    /// Same theme, other contrast.
    pub fn toggle_contrast(&mut self) {
        self.contrast = match self.contrast {
            Contrast::Normal => Contrast::High,
            Contrast::High => Contrast::Normal,
        };
    }

    /// Whether only ASCII may be drawn.
    pub fn is_ascii(&self) -> bool {
        self.capabilities.glyphs == Glyphs::Ascii
    }

    /// `unicode`, or `ascii` where only that may be drawn.
    pub fn pick(&self, unicode: &'static str, ascii: &'static str) -> &'static str {
        if self.is_ascii() { ascii } else { unicode }
    }

    /// Whether maps are drawn in half blocks of colour (else in characters of growing ink).
    pub fn paints(&self) -> bool {
        !self.is_ascii()
            && matches!(
                self.capabilities.depth,
                ColorDepth::True | ColorDepth::Indexed
            )
    }

    /// How a thing looks.
    pub fn style(&self, role: Role) -> Style {
        let mut style = Style::new().add_modifier(weight(role));
        match self.role_color(role) {
            Some(color) => style = style.fg(color),
            None if role == Role::Dim && self.contrast == Contrast::Normal => {
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
    pub fn map_color(&self, ramp: Ramp, t: f32) -> Color {
        if self.capabilities.depth == ColorDepth::Indexed {
            return Color::Indexed(map_index(ramp, t));
        }
        self.rgb(map_rgb(ramp, t))
    }

    /// A colour of a map with white mixed in: lines drawn over it.
    pub fn map_color_lit(&self, ramp: Ramp, t: f32, white: f32) -> Color {
        let base = map_rgb(ramp, t);
        self.rgb(base.map(|c| (f32::from(c) + (255.0 - f32::from(c)) * white) as u8))
    }

    /// A character of a map, `t` from 0 to 1.
    pub fn map_ink(t: f32) -> &'static str {
        let last = INK.len() - 1;
        INK[((t.clamp(0.0, 1.0) * last as f32).round() as usize).min(last)]
    }

    /// A colour in the terminal's depth (no colour where it shows none).
    pub fn rgb(&self, [r, g, b]: [u8; 3]) -> Color {
        match self.capabilities.depth {
            ColorDepth::True => Color::Rgb(r, g, b),
            ColorDepth::Indexed => Color::Indexed(nearest_index([r, g, b])),
            ColorDepth::Basic | ColorDepth::Mono => Color::Reset,
        }
    }

    fn role_color(&self, role: Role) -> Option<Color> {
        match self.capabilities.depth {
            ColorDepth::Mono => None,
            ColorDepth::Basic => basic(role),
            ColorDepth::True | ColorDepth::Indexed => {
                let rgb = match (role, self.contrast) {
                    (Role::Text | Role::Strong, _) => return Some(Color::Reset),
                    (Role::Dim, Contrast::Normal) => [140, 146, 162],
                    (Role::Border, Contrast::Normal) => [84, 92, 112],
                    (Role::Dim | Role::Border | Role::Title, Contrast::High) => {
                        return Some(Color::Reset);
                    }
                    (other, _) => okabe_ito(other),
                };
                Some(self.rgb(rgb))
            }
        }
    }
}

fn weight(role: Role) -> Modifier {
    match role {
        Role::Strong | Role::Key | Role::Chosen | Role::Bad | Role::Title => Modifier::BOLD,
        Role::Formula => Modifier::ITALIC,
        _ => Modifier::empty(),
    }
}

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

fn basic(role: Role) -> Option<Color> {
    match role {
        Role::Text | Role::Strong | Role::Title => Some(Color::Reset),
        Role::Dim | Role::Border | Role::Hertz => Some(Color::DarkGray),
        Role::Key | Role::Chosen | Role::Warn | Role::Body1 | Role::Cycles => Some(Color::Yellow),
        Role::Body2 | Role::Shear => Some(Color::Magenta),
        Role::Pressure | Role::Peaks => Some(Color::LightRed),
        Role::Film | Role::Formula => Some(Color::Cyan),
        Role::Traction | Role::Good => Some(Color::Green),
        Role::Bad => Some(Color::Red),
    }
}

fn map_rgb(ramp: Ramp, t: f32) -> [u8; 3] {
    match ramp {
        Ramp::Heat => interpolate(&HEAT, t),
        Ramp::Depth => interpolate(&DEPTH, t),
        Ramp::Diverging => interpolate(&DIVERGING, t),
    }
}

fn map_index(ramp: Ramp, t: f32) -> u8 {
    let steps: &[u8] = match ramp {
        Ramp::Heat => &HEAT_INDEXED,
        Ramp::Depth => &DEPTH_INDEXED,
        Ramp::Diverging => &DIVERGING_INDEXED,
    };
    let last = steps.len() - 1;
    // A NaN becomes the first step.
    let place = (t.clamp(0.0, 1.0) * last as f32).round() as usize;
    steps[place.min(last)]
}

fn interpolate(stops: &[[u8; 3]], t: f32) -> [u8; 3] {
    let last = stops.len() - 1;
    // A NaN would land on the first stop, as `max` returns the other operand.
    let place = t.max(0.0).min(1.0) * last as f32;
    let lower = (place as usize).min(last - 1);
    let part = place - lower as f32;
    let mix = |a: u8, b: u8| (f32::from(a) + (f32::from(b) - f32::from(a)) * part).round() as u8;
    let (low, high) = (stops[lower], stops[lower + 1]);
    [
        mix(low[0], high[0]),
        mix(low[1], high[1]),
        mix(low[2], high[2]),
    ]
}

/// The nearest of the 6x6x6 cube and the 24 greys of the 256-colour palette.
fn nearest_index([r, g, b]: [u8; 3]) -> u8 {
    const LEVELS: [i32; 6] = [0, 95, 135, 175, 215, 255];
    let nearest = |value: u8| -> usize {
        let value = i32::from(value);
        (0..6)
            .min_by_key(|&i| (LEVELS[i] - value).abs())
            .unwrap_or(0)
    };
    let distance = |candidate: [i32; 3]| -> i32 {
        let want = [i32::from(r), i32::from(g), i32::from(b)];
        (0..3).map(|k| (candidate[k] - want[k]).pow(2)).sum()
    };
    let (i, j, k) = (nearest(r), nearest(g), nearest(b));
    let cube = distance([LEVELS[i], LEVELS[j], LEVELS[k]]);
    let mean = (i32::from(r) + i32::from(g) + i32::from(b)) / 3;
    let step = ((mean - 3) / 10).clamp(0, 23);
    let grey = 8 + 10 * step;
    if distance([grey, grey, grey]) < cube {
        (232 + step) as u8
    } else {
        (16 + 36 * i + 6 * j + k) as u8
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
        assert_eq!(from(&[("TERM", "linux")]).depth, ColorDepth::Basic);
        let none = from(&[("TERM", "xterm-256color"), ("NO_COLOR", "1")]);
        assert_eq!(none.depth, ColorDepth::Mono);
        // An empty NO_COLOR counts as unset (no-color.org).
        let empty = from(&[("TERM", "xterm-256color"), ("NO_COLOR", "")]);
        assert_eq!(empty.depth, ColorDepth::Indexed);
        assert_eq!(from(&[("LC_ALL", "C")]).glyphs, Glyphs::Ascii);
        assert_eq!(from(&[("LANG", "C.UTF-8")]).glyphs, Glyphs::Unicode);
    }

    #[test]
    fn maps_that_rise_rise_in_lightness() {
        let lightness = |[r, g, b]: [u8; 3]| {
            0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b)
        };
        for ramp in [Ramp::Heat, Ramp::Depth] {
            let shades: Vec<f64> = (0..=64)
                .map(|i| lightness(map_rgb(ramp, i as f32 / 64.0)))
                .collect();
            assert!(
                shades.windows(2).all(|pair| pair[1] > pair[0] - 0.5),
                "{ramp:?}: {shades:?}"
            );
        }
    }

    #[test]
    fn out_of_range_and_nan_stay_in_the_map() {
        assert_eq!(map_rgb(Ramp::Heat, -3.0), HEAT[0]);
        assert_eq!(map_rgb(Ramp::Heat, 9.0), HEAT[7]);
        assert_eq!(map_rgb(Ramp::Heat, f32::NAN), HEAT[0]);
        assert_eq!(Theme::map_ink(f32::NAN), " ");
        assert_eq!(Theme::map_ink(2.0), "@");
    }

    #[test]
    fn palette_indices() {
        assert_eq!(nearest_index([255, 0, 0]), 196);
        assert_eq!(nearest_index([128, 128, 128]), 244);
        assert_eq!(nearest_index([0, 0, 0]), 16);
    }
}
