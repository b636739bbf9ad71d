//! Every key of a scene in one table: unit, range, meaning. Check, errors, printed scenes and help all read it.

pub(super) use super::key::key;
pub use super::key::{Key, Kind, Need};

/// One table of a scene file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Section {
    /// Its path, such as `body_1.surface`; empty for the top of the file.
    pub path: &'static str,
    /// Whether it may be left out.
    pub need: Need,
    /// What it holds.
    pub doc: &'static str,
    /// Its keys in the order in which they are printed.
    pub keys: &'static [Key],
}

use Kind::{Choice, EitherSign, Integer, IntegerOf, Line, Number, NumberOrInf, Switch, Text};
use Need::{Defaulted, Optional, Required};

use super::lubricant::{Cavitation, DensityLaw, EyringFlow, Rheology, ViscosityLaw};
use super::model::{ContactKind, MapEdge, MapLevel, MapOutliers, StressMeasure, SurfaceKind};
use super::numerics::{ErrorSource, OrderAsked};
use crate::physics::random_surface::Autocorrelation;

#[rustfmt::skip]
const BODY: &[Key] = &[
    key("young_pa", "Pa", Number(1e6, 1e13), Defaulted, "Young's modulus"),
    key("poisson", "", Number(0.0, 0.5), Defaulted, "Poisson's ratio"),
    key("hardness_pa", "Pa", NumberOrInf(1e6, 1e12), Optional("it stays elastic"), "greatest pressure that its surface carries: what would exceed it flows for good (a surface whose amplitude is turned down later takes its flattened crests along); inf: elastic"),
];
#[rustfmt::skip]
const BODY_HEAT: &[Key] = &[
    key("thermal_conductivity_w_mk", "W/(m K)", Number(0.01, 5000.0), Defaulted, "conductivity"),
    key("density_kg_m3", "kg/m3", Number(10.0, 30000.0), Defaulted, "density"),
    key("heat_capacity_j_kgk", "J/(kg K)", Number(10.0, 10000.0), Defaulted, "heat capacity"),
];
#[rustfmt::skip]
const SURFACE: &[Key] = &[
    key("kind", "", Choice(SurfaceKind::KEYS), Required, "micro-geometry that moves with the body"),
    key("file", "", Text(4096), Required, "heights, .npy, .csv, .x3p or .sur, columns along x; path relative to this file; or builtin:NAME"),
    key("digest", "", Text(16), Optional("the file is taken as it is"), "digest of the file's numbers: a file of another is refused; written by the program"),
    key("pixel_m", "m", Number(1e-9, 1e-2), Optional("as the header of the file says"), "side of a pixel; a header that says otherwise is refused"),
    key("edge", "", Choice(MapEdge::KEYS), Defaulted, "repeated without end, or once (tapered to 0)"),
    key("level", "", Choice(MapLevel::KEYS), Optional("plane of a windowed map; mean of a periodic one, of which a tilt whose ends do not meet is refused"), "what is taken off by least squares: plane and quadratic with the mean (windowed: mean of the rim)"),
    key("outliers", "", Choice(MapOutliers::KEYS), Defaulted, "pixels that stand out of the 5 by 5 about them by six times the usual are kept, or become the median of those"),
    key("crop_m", "m", Number(0.0, 1.0), Optional("all of it"), "rim that is cut off on every side, first of all"),
    key("turn_deg", "degrees", Number(-360.0, 360.0), Optional("as it lies"), "angle by which the map is turned from x towards y, such as minus its lay (asperity surface says it): the largest rectangle within is left"),
    key("s_filter_m", "m", Number(1e-8, 1.0), Optional("none"), "cut-off of an areal Gaussian filter (ISO 16610-61) that takes away what is shorter, before the level; at least 2 pixels"),
    key("l_filter_m", "m", Number(1e-8, 1.0), Optional("none"), "cut-off of one that takes away what is longer, after the level; more than s_filter_m"),
    key("unit_m", "m", Number(1e-12, 1e3), Optional("as the header of the file says, else 1"), "height that a value of 1 stands for; a header that says otherwise is refused"),
    key("start_x_m", "m", Number(-1e3, 1e3), Optional("just upstream of the domain"), "where the middle of a windowed map is at t = 0"),
    key("seed", "", Integer(0, 1_000_000_000), Optional("1; on body 2 a million more than body 1's"), "which surface of that kind: equal seeds and keys make equal surfaces"),
    key("rq_m", "m", Number(0.0, 1e-4), Required, "root-mean-square height of the made surface, all its waves together"),
    key("autocorrelation", "", Choice(Autocorrelation::KEYS), Defaulted, "how heights a way r apart are related, r in correlation lengths: e^-r, e^-r^2, or by a power law of the spectrum between the cut-offs"),
    key("correlation_x_m", "m", NumberOrInf(1e-7, 1.0), Optional("self_affine alone, which has none"), "way along x over which the correlation falls to 1/e; inf: longitudinal ridges"),
    key("correlation_y_m", "m", NumberOrInf(1e-7, 1.0), Optional("as along x"), "the same along y, longer than along x: a transverse lay; inf: transverse ridges"),
    key("hurst", "", Number(0.0, 1.0), Optional("0.8"), "Hurst exponent H of self_affine: power by wavenumber q^-2(1+H), of ridges q^-(1+2H)"),
    key("cutoff_short_m", "m", Number(1e-7, 1.0), Optional("the shorter correlation length"), "shortest wave of the surface, at least 4 nodes; lives hang on it"),
    key("cutoff_long_m", "m", Number(1e-7, 1.0), Optional("the period"), "longest wave of the surface"),
    key("skewness", "", Number(-3.0, 3.0), Optional("0"), "Ssk of the heights; below 0: plateaus and valleys, as honed or worn surfaces have; the waves allow it only nearly, what came out is printed"),
    key("kurtosis", "", Number(1.8, 30.0), Optional("3"), "Sku of the heights, at least 1.774 + 1.641 Ssk^2"),
    key("period_x_m", "m", Number(1e-6, 10.0), Optional("64 correlation lengths, at least 8 of cutoff_long_m"), "way along x after which the surface comes again"),
    key("period_y_m", "m", Number(1e-6, 10.0), Optional("likewise"), "the same along y"),
    key("amplitude_m", "m", Number(0.0, 1e-4), Required, "sinusoid: A in A cos(2 pi x'/Wx + phase) cos(2 pi y'/Wy), peak to valley is 2 A; height map: greatest departure from its level; omitted: as in the file"),
    key("wavelength_x_m", "m", NumberOrInf(1e-7, 1.0), Defaulted, "Wx, at least 4 nodes; inf: longitudinal ridges"),
    key("wavelength_y_m", "m", NumberOrInf(1e-7, 1.0), Defaulted, "Wy, at least 4 nodes; inf: transverse ridges"),
    key("angle_deg", "degrees", Number(-360.0, 360.0), Defaulted, "angle of x' from the rolling direction x"),
    key("phase_deg", "degrees", Number(-360.0, 360.0), Defaulted, "phase of the wave along x' at t = 0, x = 0; where both bodies have 0 none is asked for, and a run at S = 0 bands its life over eight"),
];

/// The keys that each kind of surface has.
const OF_SINUSOID: [&str; 5] = [
    "amplitude_m",
    "wavelength_x_m",
    "wavelength_y_m",
    "angle_deg",
    "phase_deg",
];
#[rustfmt::skip]
const OF_RANDOM: [&str; 12] = [
    "seed", "rq_m", "autocorrelation", "correlation_x_m", "correlation_y_m", "hurst", "cutoff_short_m", "cutoff_long_m",
    "skewness", "kurtosis", "period_x_m", "period_y_m",
];
#[rustfmt::skip]
const OF_MAP: [&str; 12] = [
    "file", "digest", "pixel_m", "edge", "level", "outliers", "crop_m", "turn_deg", "s_filter_m", "l_filter_m", "unit_m",
    "start_x_m",
];

/// Every table of a scene in the order in which it is printed.
#[rustfmt::skip] // one line a key
pub const SECTIONS: &[Section] = &[
    Section {
        path: "",
        need: Required,
        doc: "",
        keys: &[
            key("title", "", Line(200), Defaulted, "one line naming the scene"),
            key("about", "", Text(4000), Defaulted, "what is looked at, and where the numbers come from"),
        ],
    },
    Section {
        path: "contact",
        need: Required,
        doc: "Shape of the contact, as equivalent radii: 1/R = 1/R_1 + 1/R_2.",
        keys: &[
            key("kind", "", Choice(ContactKind::KEYS), Required, "ball or barrel on anything, or parallel cylinders"),
            key("rx_m", "m", Number(1e-6, 100.0), Required, "equivalent radius along the rolling direction x"),
            key("ry_m", "m", Number(1e-6, 100.0), Optional("a line contact"), "equivalent radius across; point contact only"),
        ],
    },
    Section {
        path: "body_1",
        need: Defaulted,
        doc: "The body below; z points into it. S > 0 makes it the slower one.",
        keys: BODY,
    },
    Section {
        path: "body_1.heat",
        need: Optional("bearing steel: 46 W/(m K), 7850 kg/m3, 470 J/(kg K)"),
        doc: "Thermal properties of the body; read with [heat].",
        keys: BODY_HEAT,
    },
    Section {
        path: "body_1.surface",
        need: Defaulted,
        doc: "",
        keys: SURFACE,
    },
    Section {
        path: "body_2",
        need: Defaulted,
        doc: "The body above.",
        keys: BODY,
    },
    Section {
        path: "body_2.heat",
        need: Optional("bearing steel: 46 W/(m K), 7850 kg/m3, 470 J/(kg K)"),
        doc: "Thermal properties of the body; read with [heat].",
        keys: BODY_HEAT,
    },
    Section {
        path: "body_2.surface",
        need: Defaulted,
        doc: "",
        keys: SURFACE,
    },
    Section {
        path: "lubricant",
        need: Optional("dry contact"),
        doc: "The oil. Omit the table for a dry scene.",
        keys: &[
            key("viscosity_pa_s", "Pa s", Number(1e-6, 1e4), Optional("that of vg"), "viscosity at ambient pressure"),
            key("pressure_viscosity_per_pa", "1/Pa", Number(0.0, 1e-7), Optional("by the viscosity, with vg"), "pressure-viscosity coefficient alpha"),
            key("vg", "", Number(2.0, 5000.0), Optional("the viscosity is given"), "ISO viscosity grade of a mineral oil, mm2/s at 40 degrees, in place of viscosity and pressure coefficient"),
            key("temperature_c", "degrees C", Number(-60.0, 250.0), Optional("only with vg, which needs it"), "temperature of the oil that enters"),
            key("viscosity_index", "", Number(0.0, 400.0), Optional("95; only with vg"), "how little the viscosity falls with temperature"),
            key("viscosity_law", "", Choice(ViscosityLaw::KEYS), Defaulted, "viscosity against pressure"),
            key("density_law", "", Choice(DensityLaw::KEYS), Defaulted, "density against pressure p in GPa: 1 + 0.6 p/(1 + 1.7 p), or the same law with other round numbers, (0.59 + 1.34 p)/(0.59 + p)"),
            key("rheology", "", Choice(Rheology::KEYS), Defaulted, "shear law of the film"),
            key("eyring_stress_pa", "Pa", Number(1e4, 1e9), Defaulted, "Eyring stress tau0; read when rheology = \"eyring\""),
            key("eyring_flow", "", Choice(EyringFlow::KEYS), Defaulted, "viscosity that the pressure's flow meets in sheared oil: along the sliding that of Eyring's law itself, across it its secant; or the secant in both directions, as in Zhu and Hu's codes and the paper; read when rheology = \"eyring\""),
            key("limiting_shear_ratio", "", Number(1e-3, 1.0), Defaulted, "limiting shear stress as a fraction of the pressure"),
            key("cavitation", "", Choice(Cavitation::KEYS), Defaulted, "how the film ruptures"),
        ],
    },
    Section {
        path: "friction",
        need: Defaulted,
        doc: "Where surfaces touch.",
        keys: &[
            key("boundary", "", Number(0.0, 1.0), Defaulted, "friction coefficient where surfaces touch"),
            key("contact_film_m", "m", Number(0.0, 1e-6), Defaulted, "film at or below which a node counts as asperity contact"),
        ],
    },
    Section {
        path: "motion",
        need: Required,
        doc: "U = (U1 + U2)/2 and S = (U2 - U1)/U, so U1 = U (1 - S/2), U2 = U (1 + S/2). U1 = -U2 is not allowed: no oil is entrained, and S is undefined.",
        keys: &[
            key("entrainment_m_s", "m/s", EitherSign(1e-6, 200.0), Required, "entrainment speed U along +x; below 0 the oil flows towards -x"),
            key("slide_roll", "", Number(-2.0, 2.0), Defaulted, "slide-to-roll ratio S; 0: pure rolling"),
        ],
    },
    Section {
        path: "load",
        need: Required,
        doc: "Exactly one of the three; force_n for a point contact, force_n_per_m for a line.",
        keys: &[
            key("force_n", "N", Number(1e-6, 1e8), Optional("the load is given as a Hertz pressure"), "normal load; its Hertz pressure at most 10 GPa"),
            key("force_n_per_m", "N/m", Number(1e-3, 1e10), Optional("a point contact, or a Hertz pressure"), "normal load of a line per length"),
            key("hertz_pressure_pa", "Pa", Number(1e6, 1e10), Optional("the load is given as a force"), "maximum Hertz pressure"),
        ],
    },
    Section {
        path: "grid",
        need: Defaulted,
        doc: "Nodes and domain, in Hertz half-widths along x and along y.",
        keys: &[
            key("nodes", "", IntegerOf(&[33, 65, 129, 257, 513, 1025]), Defaulted, "nodes per side, 2^k + 1"),
            key("x_min_a", "a", Number(-1000.0, -1.2), Optional("chosen by the plan"), "inlet edge, x along the flow"),
            key("x_max_a", "a", Number(1.1, 1000.0), Optional("chosen by the plan"), "outlet edge, x along the flow"),
            key("y_half_a", "b", Number(1.1, 1000.0), Optional("chosen by the plan"), "half-width across, in half-widths along y"),
        ],
    },
    Section {
        path: "time",
        need: Defaulted,
        doc: "Time step and length of the run.",
        keys: &[
            key("step_nodes", "", Number(0.05, 4.0), Defaulted, "time step in nodes travelled at U; 1 has no numerical diffusion; fixed steps are fitted to the period of both waves, by up to 1 %, where these have 12 nodes each"),
            key("passages", "", Number(0.01, 1e4), Optional("from 1 to 2, until the life of waves has settled, they repeat and damage maps are whole; else 2"), "length of the run in lengths of 4 a at U, after the start-up"),
            key("tolerance", "", Number(1e-5, 0.1), Optional("fixed steps of step_nodes"), "adaptive steps: error of the film that they may add over one crossing"),
        ],
    },
    Section {
        path: "numerics",
        need: Defaulted,
        doc: "Order of the discretisation, and when a time step counts as converged.",
        keys: &[
            key("tolerance", "", Number(1e-9, 0.1), Defaulted, "relative change of the pressure"),
            key("max_iterations", "", Integer(1, 1000), Defaulted, "most Newton iterations of one step"),
            key("order", "", Choice(OrderAsked::KEYS), Defaulted, "of steps, flow and deflection where they are smooth: 2, or 3 in time and up to 4 in space; by_mesh: high as long as the mesh carries the smooth film"),
            key("error_estimate", "", Choice(ErrorSource::KEYS), Defaulted, "headless runs: error of the mesh from a run on half the nodes, the last but one of the ladder or a second one; or none"),
            key("ladder", "", Switch, Defaulted, "meshes from the coarsest that carries the waves up to grid.nodes, each going on from the one before; false: that mesh alone"),
        ],
    },
    Section {
        path: "stress",
        need: Optional("no subsurface stress"),
        doc: "Subsurface stress of body 1. Omit the table to compute none; life needs it.",
        keys: &[
            key("depths", "", Integer(8, 256), Defaulted, "number of depths"),
            key("depth_max_a", "a", Number(0.5, 20.0), Defaulted, "deepest point, in the narrower Hertz half-width; life needs 2 or more"),
            key("measure", "", Choice(StressMeasure::KEYS), Defaulted, "effective stress that drives fatigue"),
            key("plane_x_a", "a", Number(-20.0, 20.0), Optional("no such plane"), "a plane x = const of body 1 in every frame that is shown, beside y = 0; some 10 ms each at 129 nodes"),
            key("plane_y_a", "a", Number(-20.0, 20.0), Optional("no such plane"), "a plane y = const, likewise"),
            key("plane_z_a", "a", Number(1e-3, 20.0), Optional("no such plane"), "a plane z = const, likewise"),
        ],
    },
    Section {
        path: "life",
        need: Optional("no fatigue life"),
        doc: "Relative fatigue life; zaretsky: ln(1/Ps) = C (n N)^e times the integral of sigma^(c e) over the volume.",
        keys: super::life_keys::LIFE,
    },
    Section {
        path: "heat",
        need: Optional("no temperatures"),
        doc: "Flash temperature of both surfaces by moving sources of heat. Where it is said how the oil thins (by coefficient, exponent or lubricant.vg), film and friction are those of the warm oil.",
        keys: &[
            key("bulk_k", "K", Number(150.0, 1000.0), Defaulted, "temperature of both bodies and of the oil that enters"),
            key("thermal_conductivity_w_mk", "W/(m K)", Number(0.001, 10.0), Defaulted, "conductivity of the oil, across which both surfaces exchange heat"),
            key("density_kg_m3", "kg/m3", Number(100.0, 3000.0), Defaulted, "density of the oil"),
            key("heat_capacity_j_kgk", "J/(kg K)", Number(100.0, 10000.0), Defaulted, "heat capacity of the oil"),
            key("viscosity_temperature_per_k", "1/K", Number(0.0, 0.5), Optional("by the exponent or lubricant.vg; else warm oil is as thick as cold"), "how fast the viscosity falls as the oil warms, -d ln(viscosity)/dT, at any pressure"),
            key("viscosity_temperature_exponent", "1", Number(0.0, 5.0), Optional("by the coefficient or lubricant.vg"), "S0 of Roelands' law, in place of the coefficient: the oil thins the faster the higher the pressure"),
        ],
    },
    Section {
        path: "wear",
        need: Optional("nothing wears"),
        doc: "Wear after Archard where asperities touch: depth a time = coefficient x pressure x |U2 - U1|; what the film carries does not wear, but by a stated share of thin films.",
        keys: &[
            key("coefficient_1_per_pa", "1/Pa", Number(0.0, 1e-9), Defaulted, "wear coefficient of body 1 over its hardness; mild wear of lubricated steel: 1e-19 to 1e-17"),
            key("coefficient_2_per_pa", "1/Pa", Number(0.0, 1e-9), Defaulted, "same of body 2"),
            key("thin_film_m", "m", Number(0.0, 1e-6), Defaulted, "thinner films wear, too, as roughness that the mesh does not carry touches through them: by a share of the pressure that grows from 0 at this thickness to 1 in contact"),
        ],
    },
    Section {
        path: "age",
        need: Optional("new surfaces: one loading cycle's wear is told, and none has been taken"),
        doc: "Loading cycles beyond those simulated: passages (time.passages each) alternate with jumps of many cycles, whose wear is taken off the heights. With life.calibration_cycles damage goes on in the material, and what of it is not worn off makes pits.",
        keys: &[
            key("cycles", "", Number(1.0, 1e12), Defaulted, "loading cycles of each body; asperity run --cycles N sets it"),
            key("tolerance", "", Number(1e-4, 0.1), Defaulted, "error in a jump of the heights, over the composite roughness (of smooth surfaces over what is worn), and of the mean damage"),
        ],
    },
    Section {
        path: "tooth",
        need: Optional("the contact rides on no tooth"),
        doc: "Where on a gear's tooth the contact is while events move it along: shown beside it, changes no result. Contact begins at t = 0.",
        keys: &[
            key("pinion_teeth", "", Integer(5, 1000), Required, "teeth of the pinion, which is body 1 and drives"),
            key("wheel_teeth", "", Integer(5, 1000), Required, "teeth of the wheel, which is body 2"),
            key("module_m", "m", Number(1e-5, 0.1), Required, "module"),
            key("pressure_angle_deg", "degrees", Number(10.0, 35.0), Required, "pressure angle of the rack"),
            key("centre_distance_m", "m", Number(1e-4, 10.0), Required, "centre distance"),
            key("pinion_tip_diameter_m", "m", Number(1e-4, 20.0), Required, "tip diameter of the pinion"),
            key("wheel_tip_diameter_m", "m", Number(1e-4, 20.0), Required, "tip diameter of the wheel"),
            key("speed_rpm", "1/min", Number(0.01, 1e6), Required, "speed of the pinion"),
        ],
    },
    Section {
        path: "record",
        need: Optional("no recording"),
        doc: "The recording (.rrd).",
        keys: &[
            key("every_steps", "", Integer(1, 1_000_000), Defaulted, "fields every so many time steps, scalars every step; both are spaced out to keep to the budget"),
            key("budget_mb", "MB", Number(0.1, 1e5), Defaulted, "largest size of the recording, of which layout and first frame take about 1 MB"),
        ],
    },
];

/// The keys of an `[[event]]` beside its table `set`.
#[rustfmt::skip]
pub const EVENT_KEYS: &[Key] = &[
    key("at_s", "s", Number(0.0, 1e9), Required, "simulated time after the start-up"),
    key("caption", "", Text(1000), Defaulted, "text shown beside the run"),
];

impl Kind {
    /// Whether it takes that number.
    pub fn takes(&self, number: f64) -> bool {
        match *self {
            Number(min, max) => (min..=max).contains(&number),
            EitherSign(min, max) => (min..=max).contains(&number.abs()),
            NumberOrInf(min, max) => (min..=max).contains(&number) || number == f64::INFINITY,
            Text(_) | Line(_) | Integer(..) | IntegerOf(_) | Choice(_) | Switch => false,
        }
    }

    /// The finite numbers that it takes on that side of 0 where `home` is; `None`: it takes no numbers but whole ones.
    pub fn range(&self, home: f64) -> Option<(f64, f64)> {
        match *self {
            EitherSign(min, max) if home < 0.0 => Some((-max, -min)),
            Number(min, max) | EitherSign(min, max) | NumberOrInf(min, max) => Some((min, max)),
            Text(_) | Line(_) | Integer(..) | IntegerOf(_) | Choice(_) | Switch => None,
        }
    }

    /// Whether that word is one of its choices.
    pub fn is_choice(&self, word: &str) -> bool {
        match *self {
            Choice(words) => words.contains(&word),
            Text(_) | Line(_) | Number(..) | EitherSign(..) | NumberOrInf(..) | Integer(..)
            | IntegerOf(_) | Switch => false,
        }
    }
}

impl Key {
    /// What the key takes, in words, with its unit.
    pub fn allowed(&self) -> String {
        let unit = if self.unit.is_empty() {
            String::new()
        } else {
            format!(" {}", self.unit)
        };
        match self.kind {
            Text(longest) => format!("a text of at most {longest} characters"),
            Line(longest) => format!(
                "one line of at most {longest} characters, none of which controls a terminal or turns the direction of writing"
            ),
            Number(min, max) => format!("{} to {}{unit}", short(min), short(max)),
            EitherSign(min, max) => format!(
                "{} to {}{unit}, or {} to {}{unit}; never 0",
                short(min),
                short(max),
                short(-max),
                short(-min)
            ),
            NumberOrInf(min, max) => format!("{} to {}{unit}, or inf", short(min), short(max)),
            Integer(min, max) => format!("a whole number, {min} to {max}{unit}"),
            IntegerOf(values) => {
                let list: Vec<_> = values.iter().map(i64::to_string).collect();
                format!("one of {}", list.join(", "))
            }
            Choice(words) => quoted(words),
            Switch => "true or false".to_owned(),
        }
    }
}

impl Key {
    /// Whether the key may be left out of a `table` of that `kind` (its key `kind`); `None`: it has no
    /// place there.
    pub fn need_in(&self, table: &str, kind: Option<&str>) -> Option<Need> {
        if (table, kind, self.name) == ("contact", Some("point"), "ry_m") {
            return Some(Required);
        }
        if !table.ends_with(".surface") || self.name == "kind" {
            return Some(self.need);
        }
        let own: &[&str] = match kind.and_then(SurfaceKind::from_key) {
            Some(SurfaceKind::Smooth) => &[],
            Some(SurfaceKind::HeightMap) if self.name == "amplitude_m" => {
                return Some(Optional("as in the file"));
            }
            Some(SurfaceKind::HeightMap) => &OF_MAP,
            Some(SurfaceKind::Random) => &OF_RANDOM,
            Some(SurfaceKind::Sinusoid) | None => &OF_SINUSOID,
        };
        own.contains(&self.name).then_some(self.need)
    }

    /// The kinds of surface that take the key, for messages.
    pub(super) fn kinds(&self) -> String {
        let takes = |kind: &&&str| self.need_in(".surface", Some(kind)).is_some();
        quoted(SurfaceKind::KEYS.iter().filter(takes))
    }
}

impl Section {
    /// A key's path in full.
    pub fn path_of(&self, name: &str) -> String {
        joined(self.path, name)
    }

    /// The key of that name.
    pub fn key(&self, name: &str) -> Option<&'static Key> {
        self.keys.iter().find(|key| key.name == name)
    }
}

/// The table at that path.
pub fn section(path: &str) -> Option<&'static Section> {
    SECTIONS.iter().find(|section| section.path == path)
}

/// The key with that full path, such as `motion.slide_roll`; those of drawings are keys, too.
pub fn find(path: &str) -> Option<&'static Key> {
    let (table, name) = path.rsplit_once('.').unwrap_or(("", path));
    let own = section(table).and_then(|section| section.key(name));
    own.or_else(|| super::drawing::find(path))
}

/// Every key in full, in printed order.
pub fn all_paths() -> impl Iterator<Item = String> {
    SECTIONS
        .iter()
        .flat_map(|section| section.keys.iter().map(|key| section.path_of(key.name)))
}

/// `table.name`, or the name alone at the top of a file.
pub fn joined(table: &str, name: &str) -> String {
    if table.is_empty() {
        name.to_owned()
    } else {
        format!("{table}.{name}")
    }
}

/// Words as scenes write them: `"point" or "line"`.
fn quoted<'a>(words: impl IntoIterator<Item = &'a &'a str>) -> String {
    let list: Vec<_> = words
        .into_iter()
        .map(|word| format!("\"{word}\""))
        .collect();
    list.join(" or ")
}

/// A number in the fewest characters that read well: 0.3, 1e-6, 2.1e11.
pub fn short(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 || (1e-3..1e5).contains(&size) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_unique_and_documented() {
        let mut paths: Vec<_> = all_paths().collect();
        let n_all = paths.len();
        paths.sort();
        paths.dedup();
        assert_eq!(paths.len(), n_all);
        for section in SECTIONS {
            for key in section.keys {
                assert!(!key.doc.is_empty(), "{}", key.name);
                assert!(find(&section.path_of(key.name)).is_some());
            }
        }
    }

    #[test]
    fn units_agree_with_the_names() {
        for section in SECTIONS {
            for key in section.keys {
                for (suffix, unit) in [
                    ("_m_s", "m/s"),
                    ("_pa_s", "Pa s"),
                    ("_per_pa", "1/Pa"),
                    ("_deg", "degrees"),
                    ("_mb", "MB"),
                ] {
                    assert!(
                        !key.name.ends_with(suffix) || key.unit == unit,
                        "{} is in {unit}",
                        key.name
                    );
                }
            }
        }
    }

    #[test]
    fn what_is_allowed_reads_well() {
        let allowed = |path| find(path).map(Key::allowed);
        assert_eq!(
            allowed("load.hertz_pressure_pa").as_deref(),
            Some("1e6 to 1e10 Pa")
        );
        assert_eq!(
            allowed("lubricant.rheology").as_deref(),
            Some("\"newtonian\" or \"eyring\"")
        );
        assert_eq!(
            allowed("body_2.surface.wavelength_x_m").as_deref(),
            Some("1e-7 to 1 m, or inf")
        );
    }
}
