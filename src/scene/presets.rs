//! The scenes that come with the program: typical operating points, each a TOML file that is built in.

/// A built-in scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Preset {
    /// Name on the command line.
    pub name: &'static str,
    /// The file's text.
    pub toml: &'static str,
}

/// Name of the scene that runs when none is named.
pub const DEFAULT: &str = "demonstration";

macro_rules! preset {
    ($name:literal) => {
        Preset {
            name: $name,
            toml: include_str!(concat!("../../assets/scenes/", $name, ".toml")),
        }
    };
}

const PRESETS: &[Preset] = &[
    preset!("demonstration"),
    preset!("ball_bearing"),
    preset!("ball_bearing_worn"),
    preset!("twin_disc"),
    preset!("micropitting_rig"),
    preset!("mtm_ball_on_disc"),
    preset!("ball_on_glass"),
    preset!("fzg_pitch_point"),
    preset!("fzg_point_b"),
    preset!("fzg_point_a"),
    preset!("fzg_point_e"),
    preset!("cam_nose"),
];

/// All presets, the default first.
pub fn all() -> &'static [Preset] {
    PRESETS
}

/// The preset of that name.
pub fn find(name: &str) -> Option<&'static Preset> {
    PRESETS.iter().find(|preset| preset.name == name)
}

/// All names, for messages.
pub(super) fn names() -> String {
    let names: Vec<_> = PRESETS.iter().map(|preset| preset.name).collect();
    names.join(", ")
}
