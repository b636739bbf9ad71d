//! A scene in the units of its drawings: both radii, turns, Ra and the oil by its grade, and what they become in the scene.
//!
//! What is typed is kept by the form, as the scene holds what it becomes. Rows that say one thing together (both radii and both
//! turns; grade and temperature) are put together, so each may be typed first: until its mate is there the scene stays as it was
//! and the form says what is missing.

use super::{Choice, Draft, stepped, surface};
use crate::tui::units::{Units, sig};
use asperity_engine::math::number::{Unit, trimmed};
use asperity_engine::scene::{ContactKind, Override, Scene, SceneError, Surface, keys};

/// Step of a temperature, °C.
const TEMPERATURE_STEP_C: f64 = 5.0;

/// A number of a drawing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Drawn {
    /// Radius of a body along the rolling direction.
    Radius(usize),
    /// Across it.
    Across(usize),
    /// Turns of a body about its centre.
    Turns(usize),
    /// Ra of its surface.
    MeanHeight(usize),
    /// ISO viscosity grade of the oil.
    Grade,
    /// Its temperature in the inlet.
    Temperature,
    /// Its viscosity index.
    Index,
}

impl Drawn {
    /// In the order of the form.
    pub(super) const ALL: [Choice; 11] = [
        Choice::Drawn(Self::Radius(0)),
        Choice::Drawn(Self::Radius(1)),
        Choice::Drawn(Self::Across(0)),
        Choice::Drawn(Self::Across(1)),
        Choice::Drawn(Self::Turns(0)),
        Choice::Drawn(Self::Turns(1)),
        Choice::Drawn(Self::MeanHeight(0)),
        Choice::Drawn(Self::MeanHeight(1)),
        Choice::Drawn(Self::Grade),
        Choice::Drawn(Self::Temperature),
        Choice::Drawn(Self::Index),
    ];

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Radius(0) => "radius 1 along x",
            Self::Radius(_) => "radius 2 along x",
            Self::Across(0) => "radius 1 across",
            Self::Across(_) => "radius 2 across",
            Self::Turns(0) => "turns of body 1",
            Self::Turns(_) => "turns of body 2",
            Self::MeanHeight(0) => "Ra of body 1",
            Self::MeanHeight(_) => "Ra of body 2",
            Self::Grade => "oil grade ISO VG",
            Self::Temperature => "oil temperature",
            Self::Index => "viscosity index",
        }
    }

    /// Key of the scene's file; `None`: this scene has no such number.
    pub(super) fn key(self, scene: &Scene) -> Option<String> {
        let of_oil = |key: &str| scene.lubricant.as_ref().map(|_| format!("lubricant.{key}"));
        match self {
            Self::Radius(body) => Some(format!("contact.radius_{}_m", body + 1)),
            Self::Across(body) => (scene.kind() == ContactKind::Point)
                .then(|| format!("contact.radius_{}_y_m", body + 1)),
            Self::Turns(body) => Some(format!("motion.speed_{}_rpm", body + 1)),
            Self::MeanHeight(body) => match surface(scene, body) {
                Surface::Smooth {} | Surface::HeightMap { .. } => None,
                Surface::Sinusoid { .. } | Surface::Random(_) => {
                    Some(format!("body_{}.surface.ra_m", body + 1))
                }
            },
            Self::Grade => of_oil("vg"),
            Self::Temperature => of_oil("temperature_c"),
            Self::Index => of_oil("viscosity_index"),
        }
    }

    /// The rows that are put together with this one.
    fn together(self) -> &'static [Self] {
        match self {
            Self::Radius(_) | Self::Turns(_) => &[
                Self::Radius(0),
                Self::Radius(1),
                Self::Turns(0),
                Self::Turns(1),
            ],
            Self::Across(_) => &[Self::Across(0), Self::Across(1)],
            Self::MeanHeight(0) => &[Self::MeanHeight(0)],
            Self::MeanHeight(_) => &[Self::MeanHeight(1)],
            // The grade first: it takes the viscosity out.
            Self::Grade | Self::Temperature | Self::Index => {
                &[Self::Grade, Self::Temperature, Self::Index]
            }
        }
    }

    /// Whether another row sets what this one has become.
    fn is_undone_by(self, choice: Choice) -> bool {
        let of_body = |body: usize| self == Self::MeanHeight(body);
        match choice {
            Choice::Preset => true,
            Choice::Radius(0) => matches!(self, Self::Radius(_) | Self::Turns(_)),
            Choice::Radius(_) => matches!(self, Self::Across(_)),
            Choice::Speed | Choice::SlideRoll => matches!(self, Self::Turns(_)),
            Choice::Viscosity => matches!(self, Self::Grade | Self::Temperature | Self::Index),
            Choice::Lay(body) | Choice::Amplitude(body) => of_body(body),
            Choice::Young(_)
            | Choice::Load
            | Choice::HertzPressure
            | Choice::PressureViscosity
            | Choice::Wavelength(_)
            | Choice::Measure
            | Choice::Model
            | Choice::Nodes
            | Choice::Drawn(_) => false,
        }
    }

    pub(super) fn unit(self, units: Units) -> Unit {
        match self {
            Self::Radius(_) | Self::Across(_) => units.radius(),
            Self::Turns(_) => Unit::new("1/min", 1.0),
            Self::MeanHeight(_) => units.height(),
            Self::Temperature => Unit::new("°C", 1.0),
            Self::Grade | Self::Index => Unit::new("", 1.0),
        }
    }

    /// The number as it is kept, of the oil by the scene itself where it knows.
    fn value(self, draft: &Draft) -> Option<f64> {
        let oil = draft.scene.lubricant.as_ref();
        let of_scene = match self {
            Self::Grade => oil.and_then(|oil| oil.vg),
            Self::Temperature => oil.and_then(|oil| oil.temperature_c),
            Self::Index => oil.and_then(|oil| oil.viscosity_index),
            Self::Radius(_) | Self::Across(_) | Self::Turns(_) | Self::MeanHeight(_) => None,
        };
        let kept = draft.drawn.iter().find(|(own, _)| *own == self);
        kept.map(|(_, value)| *value).or(of_scene)
    }

    /// The number in words, and what it has become.
    pub(super) fn shown(self, draft: &Draft, units: Units) -> String {
        let scene = &draft.scene;
        let unit = self.unit(units);
        let value = match (self.key(scene), self.value(draft)) {
            (Some(_), Some(value)) => format!("{} {}", trimmed(unit.of(value), 5), unit.name),
            (Some(_), None) => "–".to_owned(),
            (None, _) => match self {
                Self::Across(_) => "a line contact",
                Self::MeanHeight(_) => "no wave, no made surface",
                Self::Grade | Self::Temperature | Self::Index => "dry",
                Self::Radius(_) | Self::Turns(_) => "",
            }
            .to_owned(),
        };
        let becomes = match self {
            Self::Radius(1) => format!("R {}", units.radius().show(scene.contact.rx_m, 4)),
            Self::Across(1) => scene.contact.ry_m.map_or_else(String::new, |ry_m| {
                format!("R {}", units.radius().show(ry_m, 4))
            }),
            Self::Turns(0) => format!("U {}", units.speed().show(scene.motion.entrainment_m_s, 4)),
            Self::Turns(_) => format!("S {}", sig(scene.motion.slide_roll, 3)),
            Self::MeanHeight(body) => match surface(scene, body) {
                Surface::Smooth {} | Surface::HeightMap { .. } => String::new(),
                Surface::Sinusoid { amplitude_m, .. } => {
                    format!("A {}", units.height().show(*amplitude_m, 3))
                }
                Surface::Random(random) => format!("Rq {}", units.height().show(random.rq_m, 3)),
            },
            Self::Grade => scene.lubricant.as_ref().map_or_else(String::new, |oil| {
                format!(
                    "η {}",
                    Unit::new("mPa s", 1e3).show(oil.viscosity_pa_s(), 3)
                )
            }),
            Self::Temperature => scene.lubricant.as_ref().map_or_else(String::new, |oil| {
                let alpha = oil.pressure_viscosity_per_pa();
                format!("α {}", Unit::new("1/GPa", 1e9).show(alpha, 3))
            }),
            Self::Radius(_) | Self::Across(_) | Self::Index => String::new(),
        };
        format!("{:<14}{becomes}", value.trim_end())
            .trim_end()
            .to_owned()
    }

    /// So many steps on: ten a decade, of a temperature by degrees.
    pub(super) fn turned(self, draft: &Draft, by: i32) -> Option<f64> {
        let value = self.value(draft)?;
        Some(match self {
            Self::Temperature => value + TEMPERATURE_STEP_C * f64::from(by),
            Self::Radius(_)
            | Self::Across(_)
            | Self::Turns(_)
            | Self::MeanHeight(_)
            | Self::Grade
            | Self::Index => stepped(value, by),
        })
    }
}

impl Draft {
    /// Keeps a number of a drawing, and puts it into the scene with those that belong to it.
    pub(super) fn put_drawn(&mut self, drawn: Drawn, value: f64) {
        let Some(key) = drawn.key(&self.scene) else {
            return;
        };
        let of = |one: &Drawn| {
            let value = if *one == drawn {
                value
            } else {
                one.value(self)?
            };
            Some(Override::number(&one.key(&self.scene)?, value))
        };
        let sets: Result<Vec<_>, SceneError> = drawn.together().iter().filter_map(of).collect();
        let made =
            sets.and_then(|sets| Scene::from_toml_with(&self.scene.to_toml(), "the scene", &sets));
        let in_range = keys::find(&key).is_none_or(|known| known.kind.takes(value));
        if made.is_ok() || in_range && self.waits_for_a_mate(drawn) {
            self.keep();
            self.drawn.retain(|(own, _)| *own != drawn);
            self.drawn.push((drawn, value));
        }
        match made {
            Ok(scene) => {
                self.scene = scene;
                self.judge();
            }
            Err(error) => self.verdict = Err(error.to_string()),
        }
    }

    /// Whether a row is not there yet that may make good what a number alone is refused for; an index has its usual value.
    fn waits_for_a_mate(&self, drawn: Drawn) -> bool {
        let others = drawn.together().iter().copied();
        let mut mates = others.filter(|one| *one != drawn && *one != Drawn::Index);
        mates.any(|one| one.value(self).is_none())
    }

    /// Numbers of drawings that another row has made untrue are gone.
    pub(super) fn forget_drawn(&mut self, choice: Choice) {
        self.drawn.retain(|(own, _)| !own.is_undone_by(choice));
    }
}
