//! What the screen can be switched to.

use asperity_picture::Subject;

/// The one so many places further on in a list, round and round.
pub(crate) fn shifted<T: Copy + PartialEq>(all: &[T], now: T, by: i32) -> T {
    let place = all.iter().position(|one| *one == now).unwrap_or(0) as i32;
    all[(place + by).rem_euclid(all.len() as i32) as usize]
}

/// What is drawn over the plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum MapKind {
    /// Pressure.
    #[default]
    Pressure,
    /// Film thickness.
    Film,
    /// Film thickness as white light shows it between glass and steel.
    Fringes,
    /// Contact spots over the pressure.
    Contact,
    /// Sum of both roughnesses.
    Roughness,
    /// Rise of temperature in the middle of the film.
    Temperature,
    /// Effective stress in the plane y = 0.
    Stress,
    /// Pressure on the centre line over time.
    PressureWaves,
    /// Film on the centre line over time.
    FilmWaves,
    /// Both surfaces along the centre line, with the oil between them.
    Profile,
}

impl MapKind {
    /// All maps in the order of the key.
    pub const ALL: [Self; 10] = [
        Self::Pressure,
        Self::Profile,
        Self::Film,
        Self::Fringes,
        Self::Contact,
        Self::Roughness,
        Self::Temperature,
        Self::Stress,
        Self::PressureWaves,
        Self::FilmWaves,
    ];

    /// Name on the screen.
    pub fn name(self) -> &'static str {
        match self {
            Self::Pressure => "pressure",
            Self::Film => "film",
            Self::Fringes => "interferogram",
            Self::Contact => "asperity contact",
            Self::Roughness => "roughness",
            Self::Temperature => "temperature",
            Self::Stress => "stress below",
            Self::PressureWaves => "pressure x-t",
            Self::FilmWaves => "film x-t",
            Self::Profile => "profile",
        }
    }

    /// What it shows.
    pub fn subject(self) -> Subject {
        match self {
            Self::Pressure | Self::PressureWaves => Subject::Pressure,
            Self::Film | Self::FilmWaves | Self::Profile => Subject::Film,
            Self::Fringes => Subject::Interferogram,
            Self::Contact => Subject::Contact,
            Self::Roughness => Subject::RoughnessOfBoth,
            Self::Temperature => Subject::OilRise,
            Self::Stress => Subject::EffectiveStress,
        }
    }

    /// Whether rows are moments of the centre line.
    pub(crate) fn is_over_time(self) -> bool {
        matches!(self, Self::PressureWaves | Self::FilmWaves)
    }

    /// What runs down it.
    pub(crate) fn downwards(self) -> Downwards {
        match self {
            Self::Stress => Downwards::Depth,
            Self::PressureWaves | Self::FilmWaves => Downwards::Time,
            Self::Pressure
            | Self::Film
            | Self::Fringes
            | Self::Contact
            | Self::Roughness
            | Self::Temperature
            | Self::Profile => Downwards::Across,
        }
    }

    /// Whether it shows the plane of the contact: x and y.
    pub(crate) fn is_plane(self) -> bool {
        !matches!(
            self,
            Self::Stress | Self::PressureWaves | Self::FilmWaves | Self::Profile
        )
    }

    pub(crate) fn shifted(self, by: i32) -> Self {
        shifted(&Self::ALL, self, by)
    }
}

/// What runs down a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Downwards {
    /// y.
    Across,
    /// z.
    Depth,
    /// Passages.
    Time,
}

/// How much of the plane the map and the centre-line figure show.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Zoom {
    /// The Hertz ellipse and a little around it.
    #[default]
    Contact,
    /// The whole domain.
    Domain,
}

/// A panel, which may take the screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PanelKind {
    /// The knobs.
    Knobs,
    /// The map.
    #[default]
    Map,
    /// Pressure and film along y = 0.
    CentreLine,
    /// Relative life.
    Life,
    /// The material point.
    Point,
}

impl PanelKind {
    /// All panels in the order of the key.
    pub const ALL: [Self; 5] = [
        Self::Map,
        Self::CentreLine,
        Self::Life,
        Self::Point,
        Self::Knobs,
    ];

    /// Name in lessons and on the screen.
    pub fn name(self) -> &'static str {
        match self {
            Self::Knobs => "knobs",
            Self::Map => "map",
            Self::CentreLine => "centre line",
            Self::Life => "life",
            Self::Point => "point",
        }
    }

    pub(crate) fn shifted(self, by: i32) -> Self {
        shifted(&Self::ALL, self, by)
    }
}

/// What the trace of the material point shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PointQuantity {
    /// Pressure above it.
    #[default]
    Pressure,
    /// What of that the roughness adds to Hertz's.
    Excess,
    /// Orthogonal shear at its depth.
    Shear,
    /// Effective stress at its depth.
    Effective,
}

impl PointQuantity {
    /// All in the order of the key.
    pub const ALL: [Self; 4] = [Self::Pressure, Self::Excess, Self::Shear, Self::Effective];

    /// Name in lessons.
    pub fn name(self) -> &'static str {
        match self {
            Self::Pressure => "pressure",
            Self::Excess => "over Hertz",
            Self::Shear => "shear",
            Self::Effective => "effective",
        }
    }

    pub(crate) fn next(self) -> Self {
        shifted(&Self::ALL, self, 1)
    }
}

/// What is drawn against S, against the speed, or of surfaces that age against the loading cycles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum CurveKind {
    /// Relative life, logarithmic.
    #[default]
    Life,
    /// Friction coefficient.
    Friction,
    /// Friction coefficient against the speed.
    Stribeck,
    /// Relative life over S and another knob.
    Map(Across),
    /// Of surfaces that age, against the loading cycles.
    Aged(Aged),
}

/// What a map of lives over S has upwards.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Across {
    /// The load.
    Load,
    /// The amplitudes of both bodies, in their ratio.
    Amplitude,
}

/// What ageing surfaces are followed by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Aged {
    /// Life of surfaces that would stay as they are.
    Life,
    /// Root-mean-square heights.
    Rq,
    /// Lambda ratio of the film of a formula.
    Lambda,
    /// Greatest depths worn.
    Depth,
    /// Greatest pressure.
    Pressure,
    /// Friction coefficient.
    Friction,
    /// Shares of the surfaces with pits.
    Pits,
}

impl Aged {
    /// Its name on the screen.
    pub fn name(self) -> &'static str {
        match self {
            Self::Life => "life over cycles",
            Self::Rq => "Rq over cycles",
            Self::Lambda => "λ over cycles",
            Self::Depth => "wear over cycles",
            Self::Pressure => "greatest pressure",
            Self::Friction => "friction",
            Self::Pits => "pitted area",
        }
    }
}

impl CurveKind {
    const NEW: [Self; 5] = [
        Self::Life,
        Self::Friction,
        Self::Stribeck,
        Self::Map(Across::Load),
        Self::Map(Across::Amplitude),
    ];
    const AGED: [Self; 10] = [
        Self::Life,
        Self::Aged(Aged::Life),
        Self::Aged(Aged::Rq),
        Self::Aged(Aged::Lambda),
        Self::Aged(Aged::Depth),
        Self::Aged(Aged::Pressure),
        Self::Aged(Aged::Friction),
        Self::Aged(Aged::Pits),
        Self::Friction,
        Self::Stribeck,
    ];

    /// Its name on the screen.
    pub fn name(self) -> &'static str {
        match self {
            Self::Life => "life against S",
            Self::Friction => "friction against S",
            Self::Stribeck => "Stribeck",
            Self::Map(Across::Load) => "life over S and load",
            Self::Map(Across::Amplitude) => "life over S and amplitude",
            Self::Aged(aged) => aged.name(),
        }
    }

    /// The next one of a scene whose surfaces age, or stay new.
    pub(crate) fn next(self, ages: bool) -> Self {
        let all: &[Self] = if ages { &Self::AGED } else { &Self::NEW };
        shifted(all, self, 1)
    }
}

/// Whether a passage that repeats is replayed of itself, which leaves the cores to the sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum AutoReplay {
    /// It is.
    #[default]
    On,
    /// The user went back to the live run; until a knob is turned.
    Off,
}

/// What lies over the screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Overlay {
    /// Nothing.
    #[default]
    None,
    /// The keys.
    Help,
    /// The plan.
    Plan,
    /// Another scene, and what of it only a new run can change.
    Scene,
    /// The lessons.
    Lessons,
}

/// Whether the run steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum RunPace {
    /// It does.
    #[default]
    Running,
    /// It waits.
    Paused,
}

/// Which number leads on the life panel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Leading {
    /// The simulation's: it has settled where the knobs are.
    Simulated,
    /// The simulation's, on its way there.
    Settling,
    /// The last one that was simulated, brought to where the knobs are by the formula.
    Scaled,
    /// The formula's alone: nothing has settled yet.
    Formula,
}

impl Leading {
    /// In one word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Simulated => "simulated",
            Self::Settling => "settling",
            Self::Scaled => "scaled",
            Self::Formula => "formula",
        }
    }
}
