//! The sweeps that come with the program.

/// A built-in sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SweepPreset {
    /// Name on the command line.
    pub name: &'static str,
    /// The file's text.
    pub toml: &'static str,
}

macro_rules! preset {
    ($name:literal) => {
        SweepPreset {
            name: $name,
            toml: include_str!(concat!("../../../assets/sweeps/", $name, ".toml")),
        }
    };
}

const PRESETS: &[SweepPreset] = &[
    preset!("slide_roll"),
    preset!("random_rollers"),
    preset!("two_rough_discs"),
    preset!("pits_and_wear"),
    preset!("life_map"),
    preset!("stribeck"),
    preset!("lambda"),
    preset!("fzg_c"),
    preset!("bearing_race"),
    preset!("cam_flank"),
];

/// All of them.
pub fn all() -> &'static [SweepPreset] {
    PRESETS
}

/// The sweep of that name.
pub(super) fn find(name: &str) -> Option<&'static SweepPreset> {
    PRESETS.iter().find(|preset| preset.name == name)
}

/// All names, for messages.
pub fn names() -> String {
    let names: Vec<_> = PRESETS.iter().map(|preset| preset.name).collect();
    names.join(", ")
}
