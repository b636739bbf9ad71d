//! The operating point in numbers: the keys of a scene that a row sets, what they hold, the unit they are shown in.

use super::{Choice, stepped, surface, wavelength};
use crate::tui::units::Units;
use asperity_engine::math::number::{GPA, Unit, trimmed};
use asperity_engine::scene::{ContactKind, Lubricant, Scene, Surface};

/// Step of the slide-to-roll ratio.
const S_STEP: f64 = 0.05;

impl Choice {
    /// Rows of the operating point, in the order of the form.
    pub const POINT: [Self; 15] = [
        Self::Preset,
        Self::Radius(0),
        Self::Radius(1),
        Self::Young(0),
        Self::Young(1),
        Self::Load,
        Self::HertzPressure,
        Self::Speed,
        Self::SlideRoll,
        Self::Viscosity,
        Self::PressureViscosity,
        Self::Amplitude(0),
        Self::Wavelength(0),
        Self::Amplitude(1),
        Self::Wavelength(1),
    ];

    /// Keys of the scene that a number of this row sets; empty where it takes none.
    pub(super) fn keys(self, scene: &Scene) -> Vec<String> {
        let of_oil = |key: &str| {
            let oil = scene.lubricant.iter();
            oil.map(|_| format!("lubricant.{key}")).collect()
        };
        let of_surface = |body: usize, key: &str| format!("body_{}.surface.{key}", body + 1);
        match self {
            Self::Radius(0) => vec!["contact.rx_m".to_owned()],
            Self::Radius(_) => match scene.kind() {
                ContactKind::Point => vec!["contact.ry_m".to_owned()],
                ContactKind::Line => Vec::new(),
            },
            Self::Young(body) => vec![format!("body_{}.young_pa", body + 1)],
            Self::Load => vec![match scene.kind() {
                ContactKind::Point => "load.force_n".to_owned(),
                ContactKind::Line => "load.force_n_per_m".to_owned(),
            }],
            Self::HertzPressure => vec!["load.hertz_pressure_pa".to_owned()],
            Self::Speed => vec!["motion.entrainment_m_s".to_owned()],
            Self::SlideRoll => vec!["motion.slide_roll".to_owned()],
            Self::Viscosity => of_oil("viscosity_pa_s"),
            Self::PressureViscosity => of_oil("pressure_viscosity_per_pa"),
            Self::Amplitude(body) => match surface(scene, body) {
                Surface::Smooth {} => Vec::new(),
                Surface::Sinusoid { .. } | Surface::HeightMap { .. } => {
                    vec![of_surface(body, "amplitude_m")]
                }
                Surface::Random(_) => vec![of_surface(body, "rq_m")],
            },
            Self::Wavelength(body) => match *surface(scene, body) {
                Surface::Sinusoid {
                    wavelength_x_m,
                    wavelength_y_m,
                    ..
                } => [
                    ("wavelength_x_m", wavelength_x_m),
                    ("wavelength_y_m", wavelength_y_m),
                ]
                .into_iter()
                .filter(|(_, wave_m)| wave_m.is_finite())
                .map(|(key, _)| of_surface(body, key))
                .collect(),
                Surface::Random(_) => vec![of_surface(body, "cutoff_short_m")],
                Surface::Smooth {} | Surface::HeightMap { .. } => Vec::new(),
            },
            Self::Drawn(drawn) => drawn.key(scene).into_iter().collect(),
            Self::Preset | Self::Lay(_) | Self::Measure | Self::Model | Self::Nodes => Vec::new(),
        }
    }

    /// The number that the scene has there, SI.
    pub(super) fn number(self, scene: &Scene) -> Option<f64> {
        let body = |body: usize| [&scene.body_1, &scene.body_2][body];
        match self {
            Self::Radius(0) => Some(scene.contact.rx_m),
            Self::Radius(_) => scene.contact.ry_m,
            Self::Young(of) => Some(body(of).young_pa),
            Self::Load => Some(scene.force_n()),
            Self::HertzPressure => Some(scene.hertz().p_max_pa),
            Self::Speed => Some(scene.motion.entrainment_m_s),
            Self::SlideRoll => Some(scene.motion.slide_roll),
            Self::Viscosity => scene.lubricant.as_ref().map(Lubricant::viscosity_pa_s),
            Self::PressureViscosity => {
                let oil = scene.lubricant.as_ref();
                oil.map(Lubricant::pressure_viscosity_per_pa)
            }
            Self::Amplitude(of) => Some(match surface(scene, of) {
                Surface::Random(random) => random.rq_m,
                other @ (Surface::Smooth {}
                | Surface::Sinusoid { .. }
                | Surface::HeightMap { .. }) => other.amplitude_m(),
            })
            .filter(|height_m| *height_m > 0.0),
            Self::Wavelength(of) => wavelength(surface(scene, of)),
            Self::Preset
            | Self::Lay(_)
            | Self::Measure
            | Self::Model
            | Self::Nodes
            | Self::Drawn(_) => None,
        }
    }

    /// The unit that its number is shown and typed in.
    pub(super) fn unit(self, scene: &Scene, units: Units) -> Unit {
        match self {
            Self::Radius(_) => units.radius(),
            // Of steel it is 200 in one and 30 000 in the other system.
            Self::Young(_) if units == Units::Shop => units.pressure(),
            Self::Young(_) => GPA,
            Self::Load => match scene.kind() {
                ContactKind::Point => units.force(),
                ContactKind::Line => units.force_per_length(),
            },
            Self::HertzPressure => units.pressure(),
            Self::Speed => units.speed(),
            Self::Viscosity => Unit::new("mPa s", 1e3),
            Self::PressureViscosity => Unit::new("1/GPa", 1e9),
            Self::Amplitude(_) => units.height(),
            Self::Wavelength(_) => units.length(),
            Self::Drawn(drawn) => drawn.unit(units),
            Self::SlideRoll
            | Self::Preset
            | Self::Lay(_)
            | Self::Measure
            | Self::Model
            | Self::Nodes => Unit::new("", 1.0),
        }
    }

    /// The number in words, and which of load and pressure follows from the other.
    pub(super) fn number_shown(self, scene: &Scene, units: Units) -> String {
        let Some(value) = self.number(scene) else {
            return match self {
                Self::Radius(_) => "a line contact",
                Self::Viscosity | Self::PressureViscosity => "dry",
                _ => "smooth",
            }
            .to_owned();
        };
        let unit = self.unit(scene, units);
        let shown = format!("{} {}", trimmed(unit.of(value), 5), unit.name);
        let given = scene.load.hertz_pressure_pa.is_some();
        let follows = match self {
            Self::Load if given => "  from the Hertz pressure",
            Self::HertzPressure if !given => "  from the load",
            Self::Amplitude(of) if surface(scene, of).cutoff_short_m().is_some() => "  Rq",
            _ => "",
        };
        format!("{}{follows}", shown.trim_end())
    }

    /// The number so many steps on: ten a decade, but of S.
    pub(super) fn number_turned(self, scene: &Scene, by: i32) -> Option<f64> {
        let value = self.number(scene)?;
        Some(match self {
            Self::SlideRoll => ((value / S_STEP).round() + f64::from(by)) * S_STEP,
            _ => stepped(value, by),
        })
    }
}
