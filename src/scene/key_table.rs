//! Every key of a scene in one table, in the order in which it is printed.

use super::keys::Kind::{Choice, EitherSign, Integer, IntegerOf, Number, NumberOrInf, Text};
use super::keys::Need::{Defaulted, Optional, Required};
use super::keys::{Key, Section, key};

#[rustfmt::skip]
const BODY: &[Key] = &[
    key("young_pa", "Pa", Number(1e6, 1e13), Defaulted, "Young's modulus"),
    key("poisson", "", Number(0.0, 0.5), Defaulted, "Poisson's ratio"),
];

#[rustfmt::skip]
const SURFACE: &[Key] = &[
    key("kind", "", Choice(&["smooth", "sinusoid", "height_map"]), Required, "micro-geometry that moves with the body"),
    key("file", "", Text(4096), Required, "heights, .npy or .csv, columns along x; path relative to this file"),
    key("pixel_m", "m", Number(1e-9, 1e-2), Required, "side of a pixel"),
    key("edge", "", Choice(&["periodic", "windowed"]), Defaulted, "repeated without end (mean taken off), or once (mean of the rim taken off, tapered to 0)"),
    key("unit_m", "m", Number(1e-12, 1e3), Defaulted, "height that a value of 1 stands for"),
    key("start_x_m", "m", Number(-1e3, 1e3), Optional("just upstream of the domain"), "where the middle of a windowed map is at t = 0"),
    key("amplitude_m", "m", Number(0.0, 1e-4), Required, "sinusoid: A in A cos(2 pi x'/Wx + phase) cos(2 pi y'/Wy), peak to valley is 2 A; height map: greatest departure from its level, left out: as in the file"),
    key("wavelength_x_m", "m", NumberOrInf(1e-7, 1.0), Defaulted, "Wx, at least 4 nodes; inf: longitudinal ridges"),
    key("wavelength_y_m", "m", NumberOrInf(1e-7, 1.0), Defaulted, "Wy, at least 4 nodes; inf: transverse ridges"),
    key("angle_deg", "degrees", Number(-360.0, 360.0), Defaulted, "angle of x' from the rolling direction x"),
    key("phase_deg", "degrees", Number(-360.0, 360.0), Defaulted, "phase of the wave along x' at t = 0, x = 0"),
];

/// Every table of a scene in the order in which it is printed.
#[rustfmt::skip] // one line a key
pub const SECTIONS: &[Section] = &[
    Section {
        path: "",
        need: Required,
        doc: "",
        keys: &[
            key("title", "", Text(200), Defaulted, "one line naming the scene"),
            key("about", "", Text(4000), Defaulted, "what is looked at, and where the numbers come from"),
        ],
    },
    Section {
        path: "contact",
        need: Required,
        doc: "Shape of the contact, as equivalent radii: 1/R = 1/R_1 + 1/R_2.",
        keys: &[
            key("kind", "", Choice(&["point", "line"]), Required, "ball or barrel on anything, or parallel cylinders"),
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
        path: "body_2.surface",
        need: Defaulted,
        doc: "",
        keys: SURFACE,
    },
    Section {
        path: "lubricant",
        need: Optional("dry contact"),
        doc: "The oil. Leave the table out for a dry scene.",
        keys: &[
            key("viscosity_pa_s", "Pa s", Number(1e-6, 1e4), Required, "viscosity at ambient pressure"),
            key("pressure_viscosity_per_pa", "1/Pa", Number(0.0, 1e-7), Required, "pressure-viscosity coefficient alpha"),
            key("viscosity_law", "", Choice(&["barus", "roelands"]), Defaulted, "viscosity against pressure"),
            key("density_law", "", Choice(&["incompressible", "dowson_higginson"]), Defaulted, "density against pressure"),
            key("rheology", "", Choice(&["newtonian", "eyring"]), Defaulted, "shear law of the film"),
            key("eyring_stress_pa", "Pa", Number(1e4, 1e9), Defaulted, "Eyring stress tau0; read when rheology = \"eyring\""),
            key("limiting_shear_ratio", "", Number(1e-3, 1.0), Defaulted, "limiting shear stress as a fraction of the pressure"),
            key("cavitation", "", Choice(&["reynolds", "jfo"]), Defaulted, "how the film ruptures"),
        ],
    },
    Section {
        path: "friction",
        need: Defaulted,
        doc: "Where the film is gone.",
        keys: &[
            key("boundary", "", Number(0.0, 1.0), Defaulted, "friction coefficient where surfaces touch"),
            key("contact_film_m", "m", Number(0.0, 1e-6), Defaulted, "film at or below which a spot counts as touching"),
        ],
    },
    Section {
        path: "motion",
        need: Required,
        doc: "U = (U1 + U2)/2 and S = (U2 - U1)/U, so U1 = U (1 - S/2), U2 = U (1 + S/2). U1 = -U2 is no scene: it entrains no oil, and S has no value.",
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
            key("x_min_a", "a", Number(-20.0, -1.2), Optional("chosen by the plan"), "inlet edge, x along the flow"),
            key("x_max_a", "a", Number(1.1, 10.0), Optional("chosen by the plan"), "outlet edge, x along the flow"),
            key("y_half_a", "b", Number(1.1, 10.0), Optional("chosen by the plan"), "half-width across, in half-widths along y"),
        ],
    },
    Section {
        path: "time",
        need: Defaulted,
        doc: "Time step and length of the run.",
        keys: &[
            key("step_nodes", "", Number(0.05, 4.0), Defaulted, "time step in nodes travelled at U; 1 has no numerical diffusion"),
            key("passages", "", Number(0.01, 1e4), Defaulted, "length of the run in lengths of 4 a at U, after the start-up"),
            key("tolerance", "", Number(1e-5, 0.1), Optional("fixed steps of step_nodes"), "adaptive steps: error of the film that they may add over one crossing"),
        ],
    },
    Section {
        path: "numerics",
        need: Defaulted,
        doc: "When a time step counts as converged.",
        keys: &[
            key("tolerance", "", Number(1e-9, 0.1), Defaulted, "relative change of the pressure"),
            key("max_iterations", "", Integer(1, 1000), Defaulted, "most Newton iterations of one step"),
            key("error_estimate", "", Choice(&["companion", "none"]), Defaulted, "headless runs: error of the mesh from a second run on half the nodes, or none"),
        ],
    },
    Section {
        path: "stress",
        need: Optional("no subsurface stress"),
        doc: "Subsurface stress of body 1. Leave the table out to compute none; life needs it.",
        keys: &[
            key("depths", "", Integer(8, 256), Defaulted, "number of depths"),
            key("depth_max_a", "a", Number(0.5, 20.0), Defaulted, "deepest point, in the narrower Hertz half-width; life wants 2 or more"),
            key("measure", "", Choice(&["von_mises", "max_shear", "octahedral"]), Defaulted, "effective stress that drives fatigue"),
        ],
    },
    Section {
        path: "life",
        need: Optional("no fatigue life"),
        doc: "Relative fatigue life: ln(1/Ps) = C (n N)^e times the integral of sigma^(c e) over the volume.",
        keys: &[
            key("model", "", Choice(&["zaretsky"]), Defaulted, "life model"),
            key("stress_exponent", "", Number(1.0, 40.0), Defaulted, "c: assumption, not from the paper"),
            key("weibull_slope", "", Number(0.3, 10.0), Defaulted, "e: assumption, not from the paper"),
            key("survival", "", Number(0.001, 0.999), Defaulted, "probability of survival Ps; drops out of relative lives"),
            key("cycles", "", Choice(&["global"]), Defaulted, "how cycles enter: one n for the volume, an upper bound on damage"),
            key("volume", "", Choice(&["snapshot"]), Defaulted, "which integral: mean over the phases of a passage"),
        ],
    },
    Section {
        path: "record",
        need: Optional("no recording"),
        doc: "The recording (.rrd).",
        keys: &[
            key("every_steps", "", Integer(1, 1_000_000), Defaulted, "a frame every so many time steps; the plan takes more to keep the budget"),
            key("budget_mb", "MB", Number(0.1, 1e5), Defaulted, "most that the recording may take"),
        ],
    },
];

/// The keys of an `[[event]]` beside its table `set`.
#[rustfmt::skip]
pub const EVENT_KEYS: &[Key] = &[
    key("at_s", "s", Number(0.0, 1e9), Required, "simulated time after the start-up"),
    key("caption", "", Text(1000), Defaulted, "text shown beside the run"),
];

/// The keys that an `[[event]]` may set and a live run may turn, in the order of `Knob::ALL`.
pub const KNOB_KEYS: &[&str] = &[
    "motion.slide_roll",
    "load.force_n",
    "body_1.surface.amplitude_m",
    "body_2.surface.amplitude_m",
    "motion.entrainment_m_s",
    "load.force_n_per_m",
];
