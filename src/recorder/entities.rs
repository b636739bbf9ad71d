//! Names of the entities, each with its unit. They are what the writer, the layout and the readers have in common.

/// Maps of the contact plane.
pub(crate) mod maps {
    pub(crate) const PRESSURE: &str = "maps/pressure_GPa";
    pub(crate) const FILM: &str = "maps/film_um";
    pub(crate) const TRACTION: &str = "maps/traction_on_body_1_MPa";
    pub(crate) const SURFACE_1: &str = "maps/surface_1_rise_K";
    pub(crate) const SURFACE_2: &str = "maps/surface_2_rise_K";
    pub(crate) const OIL_RISE: &str = "maps/film_rise_K";
    pub(crate) const ROUGHNESS_1: &str = "maps/roughness_body_1_um";
    pub(crate) const ROUGHNESS_2: &str = "maps/roughness_body_2_um";
    /// Drawn over the film.
    pub(crate) const CONTACT: &str = "maps/contact_spots";
    /// Hertz's contact, drawn over every map.
    pub(crate) const HERTZ: &str = "maps/hertz_contact";
    pub(crate) const INTERFEROGRAM: &str = "maps/film_interferogram";
}

/// The stress below y = 0, a row for each depth that was computed.
pub(crate) mod slice {
    pub(crate) const EFFECTIVE: &str = "slice_y0/effective_stress_GPa";
    pub(crate) const TAU_XZ: &str = "slice_y0/tau_xz_GPa";
    /// The followed material point, and its path.
    pub(crate) const POINT: &str = "slice_y0/material_point";
    pub(crate) const POINT_NOW: &str = "slice_y0/material_point/now";
    /// Where the stress has its maximum.
    pub(crate) const PEAK: &str = "slice_y0/greatest_stress";
    /// Hertz's contact on the surface.
    pub(crate) const HERTZ: &str = "slice_y0/hertz_width";
    /// The depths, once, m.
    pub(crate) const DEPTHS: &str = "slice_y0/depths_m";
}

/// The same of a line contact over the logarithm of the depth, resampled for looking at.
pub(crate) mod slice_over_log_depth {
    pub(crate) const EFFECTIVE: &str = "slice_over_log_depth/effective_stress_GPa";
    pub(crate) const TAU_XZ: &str = "slice_over_log_depth/tau_xz_GPa";
    /// The followed point, and where the stress has its maximum.
    pub(crate) const MARKS: &str = "slice_over_log_depth/marks";
    pub(crate) const POINT: &str = "slice_over_log_depth/marks/followed_point";
    pub(crate) const PEAK: &str = "slice_over_log_depth/marks/greatest_stress";
    pub(crate) const HERTZ: &str = "slice_over_log_depth/hertz_width";
}

/// Pressure, film and temperatures along y = 0 against time.
pub(crate) mod kymograph {
    pub(crate) const PRESSURE: &str = "kymograph/pressure_y0_GPa";
    pub(crate) const FILM: &str = "kymograph/film_y0_um";
    pub(crate) const SURFACE_1: &str = "kymograph/surface_1_rise_y0_K";
    pub(crate) const SURFACE_2: &str = "kymograph/surface_2_rise_y0_K";
    pub(crate) const OIL_RISE: &str = "kymograph/film_rise_y0_K";
}

/// The contact cut open.
pub(crate) mod space {
    pub(crate) const SPACE: &str = "contact_3d";
    pub(crate) const FILM: &str = "contact_3d/film_coloured_by_pressure";
    pub(crate) const BODIES: [&str; 2] = ["contact_3d/body_1_surface", UPPER_BODY];
    /// The sheet of the body above, and what is written beside it.
    pub(crate) const UPPER_BODY: &str = "contact_3d/body_2_surface";
    pub(crate) const UPPER_LABELS: &str = "contact_3d/labels";
    pub(crate) const SLICE: &str = "contact_3d/effective_stress_slice";
    pub(crate) const SPOTS: &str = "contact_3d/contact_spots";
    pub(crate) const POINT: &str = "contact_3d/material_point";
    pub(crate) const SPEEDS: &str = "contact_3d/surface_speeds";
    pub(crate) const LEGEND: &str = "contact_3d/legend";
    pub(crate) const DAMAGE: &str = "contact_3d/damage_body_1";
    pub(crate) const DAMAGE_TITLE: &str = "contact_3d/damage_title";
}

/// Both surfaces along y = 0 with the oil between them.
pub(crate) mod profile {
    pub(crate) const PROFILE: &str = "profile_y0";
    pub(crate) const STRESS: &str = "profile_y0/effective_stress_GPa";
    pub(crate) const OIL: &str = "profile_y0/oil";
    pub(crate) const POINT: &str = "profile_y0/material_point";
    pub(crate) const POINT_LINE: &str = "profile_y0/material_point/under";
    pub(crate) const MOTION: &str = "profile_y0/motion";
    pub(crate) const SURFACES: [&str; 2] = ["profile_y0/surface_1", "profile_y0/surface_2"];
}

/// Pressure and film along y = 0.
pub(crate) mod centre_line {
    pub(crate) const CENTRE_LINE: &str = "centre_line_y0";
    pub(crate) const PRESSURE: &str = "centre_line_y0/pressure_GPa";
    pub(crate) const FILM: &str = "centre_line_y0/film_um";
    pub(crate) const HERTZ: &str = "centre_line_y0/hertz_pressure_GPa";
}

/// What a material point has felt in its crossing.
pub(crate) mod trace {
    pub(crate) const TRACE: &str = "material_point/trace";
    pub(crate) const PRESSURE: &str = "material_point/trace/pressure_GPa";
    pub(crate) const EFFECTIVE: &str = "material_point/trace/effective_stress_GPa";
    pub(crate) const BEFORE: &str = "material_point/trace/crossing_before";
    /// Where the point is.
    pub(crate) const NOW: &str = "material_point/trace/now";
    /// Peaks that have passed.
    pub(crate) const PEAKS: &str = "material_point/trace/peaks";
}

/// A ride along a gear's tooth.
pub(crate) mod tooth {
    pub(crate) const GEARS: &str = "tooth/gears";
    pub(crate) const CONTACT: &str = "tooth/gears/contact";
    /// Of pinion and wheel.
    pub(crate) const OUTLINES: [&str; 2] = ["tooth/gears/pinion", "tooth/gears/wheel"];
    /// Pressure, sliding, radius over the path of contact.
    pub(crate) const PATHS: [&str; 3] = [
        "tooth/path/hertz_pressure_GPa",
        "tooth/path/slide_roll",
        "tooth/path/radius_mm",
    ];
}

/// What a researcher looks for.
pub(crate) mod research {
    use asperity_picture::ResearchPlot;

    pub(crate) fn entity(what: ResearchPlot) -> String {
        format!("research/{}", what.name())
    }
}

/// Damage maps of body 1 and 2.
pub(crate) const DAMAGE: [&str; 2] = [
    "damage/body_1_log10_relative",
    "damage/body_2_log10_relative",
];

/// What all cycles have left in the material.
pub(crate) const SUFFERED: [&str; 2] = ["ages/damage_body_1_log10", "ages/damage_body_2_log10"];

/// Where the lengths of a damage map are, m.
pub(crate) fn damage_block(entity: &str) -> String {
    format!("{entity}/block")
}

/// Words.
pub(crate) mod text {
    pub(crate) const ABOUT: &str = "text/about";
    pub(crate) const SCENE_TOML: &str = "text/scene_toml";
    pub(crate) const PLAN: &str = "text/plan";
    pub(crate) const NOTES: &str = "text/notes_on_the_data";
    pub(crate) const NOW: &str = "text/now";
    /// The same for an audience, in large type.
    pub(crate) const LECTURE: &str = "text/lecture";
    /// What runs side by side have in common.
    pub(crate) const COMPARISON: &str = "text/comparison";
    pub(crate) const LOG: &str = "log";
    /// What the run began with, for programs.
    pub(crate) const ORIGIN: &str = "text/origin";
    /// Knobs that were turned, for programs.
    pub(crate) const COMMANDS: &str = "commands";
    /// How far the recording goes, for programs: the last one holds.
    pub(crate) const REACH: &str = "text/reach";
}

/// Curves against time that are named elsewhere too.
pub(crate) mod series {
    pub(crate) const YIELDED: &str = "series/yielded_um3";
    pub(crate) const LIFE: &str = "life/log10_relative";
    /// The life's band with what the mesh costs.
    pub(crate) const LIFE_BAND: &str = "life/log10_relative/with_the_meshs_error";
    pub(crate) const POINT_CYCLES: &str = "material_point/cycles/counted";
}

/// Every scalar of a step in SI, for programs.
pub(crate) const SCALARS: &str = "scalars_si";
/// Nodes and lengths, once.
pub(crate) const GRID: &str = "grid_si";
/// Pressure of a run less that of the first one beside it.
pub(crate) const DIFFERENCE: &str = "difference/pressure_GPa";
