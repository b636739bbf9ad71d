//! The scenes that come with the program, each a TOML file that is built in: typical operating points, and those of
//! published computations and experiments (`evidence/NAME`).

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
/// The same on a coarse mesh: for tests, lessons and sweeps.
pub const QUICK: &str = "demonstration_quick";

macro_rules! preset {
    ($name:literal) => {
        Preset {
            name: $name,
            toml: include_str!(concat!("../assets/scenes/", $name, ".toml")),
        }
    };
}

const PRESETS: &[Preset] = &[
    preset!("demonstration"),
    preset!("demonstration_quick"),
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

/// Presets whose surfaces are too fine for meshes below their own: what tries all presets on coarse meshes leaves them out.
const FINE: &[Preset] = &[preset!("random_rollers")];

#[cfg(not(target_arch = "wasm32"))]
macro_rules! evidence {
    ($name:literal) => {
        Preset {
            name: concat!("evidence/", $name),
            toml: include_str!(concat!("../assets/evidence/", $name, ".toml")),
        }
    };
}

/// A page is loaded over a line: it opens the presets, and no more.
#[cfg(target_arch = "wasm32")]
const EVIDENCE: &[Preset] = &[];

#[cfg(not(target_arch = "wasm32"))]
const EVIDENCE: &[Preset] = &[
    evidence!("hertz_circle"),
    evidence!("hertz_line"),
    evidence!("reference_point_m200"),
    evidence!("reference_sweep_u1"),
    evidence!("reference_line_m20"),
    evidence!("venner_lubrecht_2000_circle"),
    evidence!("venner_lubrecht_2000_ellipse"),
    evidence!("venner_lubrecht_2000_wave"),
    evidence!("venner_1997_line"),
    evidence!("hooke_2006_fzg_b"),
    evidence!("hooke_2006_fzg_a"),
    evidence!("mourier_2006_dent"),
    evidence!("kim_olver_1998"),
    evidence!("webster_norbart_1995"),
    evidence!("morales_rycerz_kadiric_2018_rig"),
    evidence!("morales_rycerz_kadiric_2018_gear"),
    evidence!("morales_brizmer_2011"),
    evidence!("two_rough_discs"),
    evidence!("nasa_spur_gears"),
];

/// Height maps that those scenes name as `builtin:NAME`.
#[cfg(target_arch = "wasm32")]
const MAPS: &[(&str, &str)] = &[];
#[cfg(not(target_arch = "wasm32"))]
const MAPS: &[(&str, &str)] = &[(
    "mourier_dent.csv",
    include_str!("../assets/evidence/mourier_dent.csv"),
)];

/// What the name of a height map that comes with the program begins with.
pub const BUILTIN: &str = "builtin:";

/// The text of a height map that comes with the program.
pub(super) fn map(name: &str) -> Option<&'static str> {
    let found = MAPS.iter().find(|(known, _)| *known == name);
    found.map(|(_, text)| *text)
}

/// The scenes of published computations and experiments.
pub fn evidence() -> &'static [Preset] {
    EVIDENCE
}

/// The presets that coarse meshes carry, the default first.
pub fn all() -> &'static [Preset] {
    PRESETS
}

/// All presets, as people are shown them.
pub fn listed() -> impl ExactSizeIterator<Item = &'static Preset> + Clone {
    (0..PRESETS.len() + FINE.len())
        .map(|k| PRESETS.get(k).unwrap_or_else(|| &FINE[k - PRESETS.len()]))
}

/// The preset or scene of evidence of that name.
pub fn find(name: &str) -> Option<&'static Preset> {
    let mut all = listed().chain(EVIDENCE);
    all.find(|preset| preset.name == name)
}

/// What the explorer sets before it opens a scene by that name, unless it is told otherwise: the first scene's story begins
/// with rolling.
pub fn opening(name: &str) -> Option<&'static str> {
    matches!(name, DEFAULT | QUICK).then_some("motion.slide_roll=0")
}

/// All names, for messages.
pub(super) fn names() -> String {
    let names: Vec<_> = listed().map(|preset| preset.name).collect();
    names.join(", ")
}
