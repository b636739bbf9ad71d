//! The scene's types: one field per key of the scene file, SI units in the names.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::heat::{BodyHeat, Heat};
use super::life::Life;
use super::lubricant::{Friction, Lubricant};
use super::numerics::{Numerics, Time};
use super::random::RandomSurface;
use super::tooth::Tooth;
use super::wear::{Age, Wear};
use crate::closed_set;
use crate::physics::height_map::HeightMap;
pub use crate::physics::height_map::MapEdge;
pub use crate::physics::hertz::ContactKind;
pub use crate::physics::levelling::{MapLevel, MapOutliers};

/// A whole scene: what the user asks for.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// One line naming the scene.
    #[serde(default)]
    pub title: String,
    /// A sentence or two: what is looked at, and where the numbers come from.
    #[serde(default)]
    pub about: String,
    /// Shape of the contact.
    pub contact: Contact,
    /// The body below; z points into it.
    #[serde(default)]
    pub body_1: Body,
    /// The body above.
    #[serde(default)]
    pub body_2: Body,
    /// The oil; `None` (table left out): a dry scene.
    pub lubricant: Option<Lubricant>,
    /// Friction where the film is gone.
    #[serde(default)]
    pub friction: Friction,
    /// Entrainment and sliding.
    pub motion: Motion,
    /// Load, by force or by Hertz pressure.
    pub load: Load,
    /// Nodes and domain.
    #[serde(default)]
    pub grid: GridAsked,
    /// Time step and length of the run.
    #[serde(default)]
    pub time: Time,
    /// Tolerances.
    #[serde(default)]
    pub numerics: Numerics,
    /// Subsurface stress; `None`: not computed.
    pub stress: Option<Stress>,
    /// Fatigue life; `None`: not computed.
    pub life: Option<Life>,
    /// What says how warm the surfaces become; `None`: nobody asks.
    pub heat: Option<Heat>,
    /// What both bodies lose by wear; `None`: nothing.
    pub wear: Option<Wear>,
    /// Loading cycles beyond the passages that are simulated; `None`: none.
    pub age: Option<Age>,
    /// Where on a gear's tooth the contact is; `None`: on none. It changes no result.
    pub tooth: Option<Tooth>,
    /// Recording; `None`: no recording.
    pub record: Option<Record>,
    /// Scripted knob changes and captions, the path that keys take too.
    #[serde(default, rename = "event", skip_serializing_if = "Vec::is_empty")]
    pub events: Vec<Event>,
}

/// `[contact]`
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Contact {
    /// Kind of contact.
    pub kind: ContactKind,
    /// Equivalent radius along the rolling direction x, m.
    pub rx_m: f64,
    /// Equivalent radius across, m; a point contact has one, a line has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ry_m: Option<f64>,
}

/// `[body_1]`, `[body_2]`: elastic constants and surface.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Body {
    /// Young's modulus, Pa.
    pub young_pa: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Maximum pressure that its surface carries before it flows for good, Pa; `None` or infinite: it stays elastic.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hardness_pa: Option<f64>,
    /// Its thermal properties; `None`: steel's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub heat: Option<BodyHeat>,
    /// Surface roughness.
    pub surface: Surface,
}

impl Default for Body {
    fn default() -> Self {
        Self {
            young_pa: 2.1e11,
            poisson: 0.3,
            hardness_pa: None,
            heat: None,
            surface: Surface::Smooth {},
        }
    }
}

closed_set! {
    /// What a surface's micro-geometry is: its key `kind`, the tag of [`Surface`].
    pub enum SurfaceKind {
        /// No roughness.
        Smooth = "smooth",
        /// One wave, or the product of two.
        Sinusoid = "sinusoid",
        /// Made by its statistics.
        Random = "random",
        /// Heights from a file.
        HeightMap = "height_map",
    }
}

/// `[body_i.surface]`: the micro-geometry that moves with the body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Surface {
    /// No roughness.
    Smooth {},
    /// `A cos(2 pi x'/Wx + phase) cos(2 pi y'/Wy)`, x', y' turned by `angle_deg`.
    Sinusoid {
        /// A, m; peak to valley is 2 A.
        amplitude_m: f64,
        /// Wx, m; `inf`: longitudinal ridges.
        #[serde(default = "infinite")]
        wavelength_x_m: f64,
        /// Wy, m; `inf`: transverse ridges.
        #[serde(default = "infinite")]
        wavelength_y_m: f64,
        /// Angle of x' from x, degrees.
        #[serde(default)]
        angle_deg: f64,
        /// Phase of the x' wave at t = 0, x = 0, degrees.
        #[serde(default)]
        phase_deg: f64,
    },
    /// Made by its statistics.
    Random(RandomSurface),
    /// Heights from a file, by cubic interpolation.
    HeightMap {
        /// `.npy`, `.csv`, `.x3p` or `.sur`; relative paths are relative to the scene file, and become absolute when the
        /// scene is read.
        file: String,
        /// Side of a pixel, m; `None`: as the file's header says, and filled in when the file is read.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pixel_m: Option<f64>,
        /// What lies beyond the map.
        #[serde(default)]
        edge: MapEdge,
        /// Height that a value of 1 stands for, m; `None`: as the file's header says, else 1; filled in likewise.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        unit_m: Option<f64>,
        /// What is taken off; `None`: as the edge says ([`MapEdge::usual_level`]), and a periodic map must then close.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        level: Option<MapLevel>,
        /// What becomes of outlying pixels.
        #[serde(default)]
        outliers: MapOutliers,
        /// Rim that is cut off, m.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        crop_m: Option<f64>,
        /// Angle by which the map is turned from x towards y, degrees.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        turn_deg: Option<f64>,
        /// Cut-off of the S-filter, m.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        s_filter_m: Option<f64>,
        /// Cut-off of the L-filter, m.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        l_filter_m: Option<f64>,
        /// Maximum departure from the map's level, m; `None`: as in the file.
        #[serde(skip_serializing_if = "Option::is_none")]
        amplitude_m: Option<f64>,
        /// Where the middle of a windowed map is at t = 0, m; `None`: just upstream of the domain.
        #[serde(skip_serializing_if = "Option::is_none")]
        start_x_m: Option<f64>,
        /// Digest of the file's numbers, FNV-1a, as 16 hexadecimal digits: filled in when the file is read, so that
        /// whatever keeps the scene knows the surface and not its file's name alone; a file of another is refused.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        digest: Option<String>,
        /// The heights, once read.
        #[serde(skip)]
        map: Option<Arc<HeightMap>>,
    },
}

fn infinite() -> f64 {
    f64::INFINITY
}

/// `[motion]`
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Motion {
    /// Entrainment speed U = (U1 + U2)/2, m/s.
    pub entrainment_m_s: f64,
    /// Slide-to-roll ratio S = (U2 - U1)/U; S > 0: body 1 is the slower.
    #[serde(default)]
    pub slide_roll: f64,
}

/// `[load]`: exactly one of `hertz_pressure_pa` and the force that the kind of contact takes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Load {
    /// Normal load of a point contact, N.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_n: Option<f64>,
    /// Normal load of a line contact per metre of length, N/m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_n_per_m: Option<f64>,
    /// Maximum Hertz pressure, Pa.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hertz_pressure_pa: Option<f64>,
}

impl Load {
    /// That of a point contact, N.
    pub fn of_force_n(force_n: f64) -> Self {
        Self {
            force_n: Some(force_n),
            force_n_per_m: None,
            hertz_pressure_pa: None,
        }
    }

    /// That of a line contact per metre of length, N/m.
    pub fn of_force_n_per_m(force_n_per_m: f64) -> Self {
        Self {
            force_n: None,
            force_n_per_m: Some(force_n_per_m),
            hertz_pressure_pa: None,
        }
    }
}

/// `[grid]`
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct GridAsked {
    /// Nodes per side, 2^k + 1.
    pub nodes: usize,
    /// Inlet edge in Hertz half-widths along x; left out: chosen by the plan.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub x_min_a: Option<f64>,
    /// Outlet edge in Hertz half-widths along x; left out: chosen by the plan.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub x_max_a: Option<f64>,
    /// Half-width of the domain across, in Hertz half-widths along y; left out: chosen by the plan.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub y_half_a: Option<f64>,
}

impl Default for GridAsked {
    fn default() -> Self {
        Self {
            nodes: 129,
            x_min_a: None,
            x_max_a: None,
            y_half_a: None,
        }
    }
}

closed_set! {
    /// Scalar measure of stress that drives fatigue.
    pub enum StressMeasure {
        /// Von Mises.
        VonMises = "von_mises" "von Mises",
        /// Maximum shear (half of Tresca).
        MaxShear = "max_shear" "max. shear",
        /// Octahedral shear, sqrt(2)/3 of von Mises.
        Octahedral = "octahedral",
    }
}

/// `[stress]`
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Stress {
    /// Number of depths.
    pub depths: usize,
    /// Deepest point, in Hertz half-widths.
    pub depth_max_a: f64,
    /// Scalar measure.
    pub measure: StressMeasure,
    /// A plane x = const of body 1 beside y = 0, in a.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plane_x_a: Option<f64>,
    /// A plane y = const, in a.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plane_y_a: Option<f64>,
    /// A plane z = const, in a.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plane_z_a: Option<f64>,
}

impl Default for Stress {
    fn default() -> Self {
        Self {
            depths: 32,
            depth_max_a: 3.0,
            measure: StressMeasure::VonMises,
            plane_x_a: None,
            plane_y_a: None,
            plane_z_a: None,
        }
    }
}

/// `[record]`
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Record {
    /// A frame every so many time steps.
    pub every_steps: usize,
    /// Most megabytes that the recording may take.
    pub budget_mb: f64,
}

impl Default for Record {
    fn default() -> Self {
        Self {
            every_steps: 3,
            budget_mb: 200.0,
        }
    }
}

/// `[[event]]`: a scripted knob change or caption.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Event {
    /// Simulated time after the start-up, s.
    pub at_s: f64,
    /// Knobs to set: `motion.slide_roll`, `load.force_n` (a line: `load.force_n_per_m`), `body_i.surface.amplitude_m`,
    /// `motion.entrainment_m_s`.
    #[serde(default)]
    pub set: BTreeMap<String, f64>,
    /// Text shown beside the run.
    #[serde(default)]
    pub caption: String,
}
