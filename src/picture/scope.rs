//! The ranges that every picture of a run shares: what can come by its script and by the knobs, not what came first.

use asperity_engine::math::number::{GPA, MPA, UM, Unit, nice_ceiling};
use asperity_engine::physics::hertz::crest_pressure_pa;
use asperity_engine::scene::{ContactKind, Scene};
#[cfg(not(target_arch = "wasm32"))]
use asperity_engine::sim::StressSlice;
use asperity_engine::sim::{Frame, Knob, Metrics};

/// What ranges begin with: the first frame in figures.
#[derive(Debug, Clone)]
struct First {
    kind: ContactKind,
    a_m: f64,
    p_hertz_pa: f64,
    metrics: Metrics,
    /// Greatest of either sign, SI: traction, roughness of both bodies, effective stress and shear of the slice.
    traction_pa: f64,
    roughness_m: [f64; 2],
    effective_pa: f64,
    shear_pa: f64,
    /// Rise of surfaces and oil, K; 0: cold, or not known.
    rises_k: [f64; 2],
}

impl First {
    fn of(frame: &Frame) -> Self {
        let slice = frame.slice.as_ref();
        Self {
            kind: frame.kind,
            a_m: frame.a_m,
            p_hertz_pa: frame.p_hertz_pa,
            metrics: frame.metrics.clone(),
            traction_pa: greatest(&frame.traction_pa),
            roughness_m: [&frame.roughness_1_m, &frame.roughness_2_m].map(|field| greatest(field)),
            effective_pa: slice.map_or(0.0, |slice| greatest(&slice.effective_pa)),
            shear_pa: slice.map_or(0.0, |slice| greatest(&slice.tau_xz_pa)),
            rises_k: [
                frame.metrics.flash_temperature_k.unwrap_or(0.0),
                greatest(&frame.film_rise_k),
            ],
        }
    }
}

/// Knobs that ranges follow, each the greatest that was seen or is on its way.
#[derive(Debug, Clone, Copy, PartialEq)]
struct TurnedKnobs {
    load: f64,
    speed_m_s: f64,
    amplitude_m: [f64; 2],
    slide_roll: f64,
}

impl TurnedKnobs {
    fn of(m: &Metrics) -> Self {
        Self {
            load: m.load_n.max(m.load_target_n),
            speed_m_s: m.entrainment_m_s.abs(),
            amplitude_m: [m.amplitude_1_m, m.amplitude_2_m].map(f64::abs),
            slide_roll: m.slide_roll.abs().max(m.slide_roll_target.abs()),
        }
    }

    fn with(self, other: Self) -> Self {
        let both = |k: usize| self.amplitude_m[k].max(other.amplitude_m[k]);
        Self {
            load: self.load.max(other.load),
            speed_m_s: self.speed_m_s.max(other.speed_m_s),
            amplitude_m: [both(0), both(1)],
            slide_roll: self.slide_roll.max(other.slide_roll),
        }
    }
}

/// The ranges of a run as it goes on: those of its script, and wider ones from the frame on at which a knob is turned beyond it.
#[derive(Debug, Clone)]
pub struct Scope {
    first: First,
    turned: TurnedKnobs,
    /// What can come by the script and by what was turned so far.
    pub to_come: ToCome,
    /// The ranges that hold now.
    pub ranges: Ranges,
}

impl Scope {
    /// Of a run with that first frame.
    pub fn of(scene: Option<&Scene>, first: &Frame) -> Self {
        let (first, turned) = (First::of(first), TurnedKnobs::of(&first.metrics));
        let to_come = ToCome::of(scene, &first, turned);
        Self {
            ranges: Ranges::of(&first, &to_come),
            first,
            turned,
            to_come,
        }
    }

    /// Takes the knobs of a frame: whether the ranges have grown by them.
    pub fn grows(&mut self, scene: Option<&Scene>, m: &Metrics) -> bool {
        let turned = self.turned.with(TurnedKnobs::of(m));
        if turned == self.turned {
            return false;
        }
        self.turned = turned;
        let to_come = ToCome::of(scene, &self.first, turned);
        if to_come == self.to_come {
            return false;
        }
        let ranges = Ranges::of(&self.first, &to_come);
        self.to_come = to_come;
        std::mem::replace(&mut self.ranges, ranges) != ranges
    }
}

impl Scope {
    /// One that holds for both runs: every range is the wider of theirs.
    #[must_use]
    pub fn with(&self, other: &Self) -> Self {
        Self {
            to_come: self.to_come.with(other.to_come),
            ranges: self.ranges.with(other.ranges),
            ..self.clone()
        }
    }
}

/// The greatest that a run's own script, and what was turned by hand, can bring of what its pictures scale with, and what
/// bounds its friction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToCome {
    /// Half-width and Hertz pressure over those of the first frame.
    pub size: f64,
    /// Film over that of the first frame, by its dependence on the speed.
    film: f64,
    /// Amplitudes of body 1 and 2, m.
    pub amplitude_m: [f64; 2],
    /// Pressure of crests that are pressed flat, Pa. Where a film separates them and they grow no more, at most twice
    /// the ripple of the first frame: those of both bodies may meet there or not.
    crest_pa: f64,
    /// Greatest traction over pressure: limiting shear of the oil or boundary friction; 0: not known.
    friction: f64,
    /// Blok's flash temperature, K; 0: the scene asks for no heat.
    flash_k: f64,
    /// Which bodies are rough, or may be made so.
    rough: [bool; 2],
}

impl ToCome {
    fn with(self, other: Self) -> Self {
        let both = |k: usize| self.amplitude_m[k].max(other.amplitude_m[k]);
        Self {
            size: self.size.max(other.size),
            film: self.film.max(other.film),
            amplitude_m: [both(0), both(1)],
            crest_pa: self.crest_pa.max(other.crest_pa),
            friction: self.friction.max(other.friction),
            flash_k: self.flash_k.max(other.flash_k),
            rough: [0, 1].map(|k| self.rough[k] || other.rough[k]),
        }
    }

    /// From the scene's script, where the scene is known, the first frame and what was turned since.
    fn of(scene: Option<&Scene>, first: &First, turned: TurnedKnobs) -> Self {
        let m = &first.metrics;
        let greatest = |knobs: &[Knob], now: f64| {
            let set = scene.into_iter().flat_map(|scene| &scene.events);
            let set = set.flat_map(|event| &event.set);
            let set = set.filter(|(key, _)| knobs.iter().any(|knob| knob.key() == key.as_str()));
            set.fold(now.abs(), |top, (_, value)| top.max(value.abs()))
        };
        let ratio = |greatest: f64, now: f64| (greatest / now.abs()).max(1.0);
        let load = greatest(&[Knob::ForceN, Knob::ForceNPerM], turned.load);
        let load_ratio = if m.load_n > 0.0 {
            ratio(load, m.load_n)
        } else {
            1.0
        };
        let size = first.kind.size_ratio(load_ratio);
        let speed = greatest(&[Knob::EntrainmentMS], turned.speed_m_s);
        let speed_ratio = if m.entrainment_m_s == 0.0 {
            1.0
        } else {
            ratio(speed, m.entrainment_m_s)
        };
        let now_m = [m.amplitude_1_m, m.amplitude_2_m];
        let amplitude_m = [
            greatest(&[Knob::Amplitude1M], turned.amplitude_m[0]),
            greatest(&[Knob::Amplitude2M], turned.amplitude_m[1]),
        ];
        let grows = amplitude_m
            .iter()
            .zip(now_m)
            .any(|(&most, now)| most > 1.001 * now);
        let touch = m.contact_load_ratio > 0.0;
        let flat_pa = scene.map_or(0.0, |scene| {
            let surfaces = scene.surfaces().into_iter().zip(amplitude_m);
            let slope = surfaces.map(|(surface, amplitude_m)| {
                let [k_x, k_y] = surface.wavenumbers_per_m();
                amplitude_m * k_x.hypot(k_y)
            });
            crest_pressure_pa(size * first.p_hertz_pa, scene.e_prime_pa(), slope.sum())
        });
        let crest_pa = if grows || touch {
            flat_pa
        } else {
            flat_pa.min(size * (2.0 * m.p_max_pa - first.p_hertz_pa))
        };
        Self {
            size,
            film: speed_ratio.powf(FILM_BY_SPEED),
            amplitude_m,
            crest_pa,
            friction: scene.map_or(0.0, |scene| {
                let oil = scene
                    .lubricant
                    .as_ref()
                    .map_or(0.0, |oil| oil.limiting_shear_ratio);
                oil.max(scene.friction.boundary)
            }),
            flash_k: scene
                .filter(|scene| scene.heat.is_some())
                .map_or(0.0, |scene| {
                    let slide_roll = greatest(&[Knob::SlideRoll], turned.slide_roll);
                    // Only what slides faster than in the first frame is warmer than it tells.
                    if slide_roll <= 1.001 * m.slide_roll.abs() {
                        return 0.0;
                    }
                    let (a_m, p_pa) = (size * first.a_m, size * first.p_hertz_pa);
                    scene.flash_by_blok_k(slide_roll, USUAL_FRICTION, a_m, p_pa)
                }),
            rough: scene.map_or([false; 2], |scene| {
                scene.surfaces().map(|surface| !surface.is_smooth())
            }),
        }
    }
}

/// Friction coefficient of sheared oil, for the range of what it warms.
const USUAL_FRICTION: f64 = 0.05;
/// The least range of a rise of temperature, K.
const COOLEST_K: f64 = 2.0;
/// Exponent of the speed in the central film (Hamrock and Dowson 1977).
const FILM_BY_SPEED: f64 = 0.67;

/// Upper ends of the colour ranges, SI: what can come. They hold as long as no knob is turned beyond ([`Scope`]), so that
/// colours mean the same from frame to frame; values beyond take the top colour.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Ranges {
    /// Pressure, Pa.
    pub pressure_pa: f64,
    /// Film, m.
    pub film_m: f64,
    /// Traction of either sign, Pa.
    pub traction_pa: f64,
    /// Roughness of one body, of either sign, m.
    pub roughness_m: f64,
    /// Same of both bodies together, m.
    pub roughness_of_both_m: f64,
    /// Effective stress, Pa.
    pub effective_pa: f64,
    /// Orthogonal shear of either sign, Pa.
    pub shear_pa: f64,
    /// Rise of a surface over the bulk, K.
    pub surface_rise_k: f64,
    /// Same in the middle of the film.
    pub film_rise_k: f64,
    /// Which bodies are rough, or may be made so.
    pub rough: [bool; 2],
}

impl Ranges {
    fn with(self, other: Self) -> Self {
        Self {
            pressure_pa: self.pressure_pa.max(other.pressure_pa),
            film_m: self.film_m.max(other.film_m),
            traction_pa: self.traction_pa.max(other.traction_pa),
            roughness_m: self.roughness_m.max(other.roughness_m),
            roughness_of_both_m: self.roughness_of_both_m.max(other.roughness_of_both_m),
            effective_pa: self.effective_pa.max(other.effective_pa),
            shear_pa: self.shear_pa.max(other.shear_pa),
            surface_rise_k: self.surface_rise_k.max(other.surface_rise_k),
            film_rise_k: self.film_rise_k.max(other.film_rise_k),
            rough: [0, 1].map(|k| self.rough[k] || other.rough[k]),
        }
    }

    /// These ranges with round ends just above what the frames hold: pictures that stand alone need no room for what may
    /// come. Film: what is within 0.9 of Hertz's contact.
    #[cfg(not(target_arch = "wasm32"))]
    #[must_use]
    pub(crate) fn around(&self, frames: &[Frame]) -> Self {
        let top = |unit: Unit, of: &dyn Fn(&Frame) -> f64, usual: f64| {
            let greatest = frames.iter().map(of).fold(0.0, f64::max);
            if greatest > 0.0 {
                nice_ceiling(unit.of(greatest)) / unit.per_si
            } else {
                usual
            }
        };
        let si = Unit::new("", 1.0);
        let slice = |frame: &Frame, of: fn(&StressSlice) -> &[f32]| {
            let slice = frame.slice.as_ref();
            slice.map_or(0.0, |slice| greatest(of(slice)))
        };
        let rough = |frame: &Frame| {
            let both = [&frame.roughness_1_m, &frame.roughness_2_m];
            both.map(|field| greatest(field))
                .into_iter()
                .fold(0.0, f64::max)
        };
        let rise = |frame: &Frame| {
            let both = frame.surface_rise_k.iter();
            both.map(|field| greatest(field)).fold(0.0, f64::max)
        };
        Self {
            pressure_pa: top(GPA, &|frame| greatest(&frame.pressure_pa), self.pressure_pa),
            film_m: top(UM, &film_within, self.film_m),
            traction_pa: top(MPA, &|frame| greatest(&frame.traction_pa), self.traction_pa),
            roughness_m: top(UM, &rough, self.roughness_m),
            effective_pa: top(
                GPA,
                &|frame| slice(frame, |own| &own.effective_pa),
                self.effective_pa,
            ),
            shear_pa: top(
                GPA,
                &|frame| slice(frame, |own| &own.tau_xz_pa),
                self.shear_pa,
            ),
            surface_rise_k: top(si, &rise, self.surface_rise_k),
            film_rise_k: top(si, &|frame| greatest(&frame.film_rise_k), self.film_rise_k),
            ..*self
        }
    }

    /// The ranges of a run with that first frame, in which that can come.
    fn of(first: &First, to_come: &ToCome) -> Self {
        let metrics = &first.metrics;
        let round = |value: f64, unit: Unit| nice_ceiling(unit.of(value)) / unit.per_si;
        let greatest_pa = (1.1 * metrics.p_max_pa).max(1.3 * first.p_hertz_pa);
        let pressure_pa = round((to_come.size * greatest_pa).max(to_come.crest_pa), GPA);
        // The film range starts from what the middle of the contact is like in the mean (the film at the
        // origin goes up and down with every crest); the bath around the contact is ten to a hundred times
        // thicker.
        let mean = if metrics.h_mean_m > 0.0 {
            metrics.h_mean_m
        } else {
            metrics.h_central_m
        };
        let mean = to_come.film * mean;
        let valley = mean + 0.5 * to_come.amplitude_m.iter().sum::<f64>();
        let film = (2.5 * mean).max(valley).max(1e-9);
        // A scene that starts at S = 0 has no traction yet: what bounds it is known.
        let traction = (first.traction_pa)
            .max(0.01 * first.p_hertz_pa)
            .max(to_come.friction * pressure_pa);
        let warm = |seen: f64, times: f64| {
            nice_ceiling((1.3 * seen).max(times * to_come.flash_k).max(COOLEST_K))
        };
        let rough = first.roughness_m;
        let [rough_1, rough_2] = [0, 1].map(|body| rough[body].max(to_come.amplitude_m[body]));
        Self {
            pressure_pa,
            film_m: round(film, UM),
            traction_pa: round(traction, MPA),
            roughness_m: round(rough_1.max(rough_2), UM),
            roughness_of_both_m: round(rough_1 + rough_2, UM),
            // One frame does not tell what others hold. Below a spike of pressure the effective stress
            // reaches about 0.56 of it and the shear 0.2 of it (a line contact's, in its own size), and
            // the spikes' range is known, with room where it is that of the first frame.
            effective_pa: round(
                (1.05 * first.effective_pa)
                    .max(0.38 * pressure_pa)
                    .max(0.56 * to_come.crest_pa),
                GPA,
            ),
            shear_pa: round((1.05 * first.shear_pa).max(0.15 * pressure_pa), GPA),
            // Crests are warmer than Blok's smooth contact, and the oil between them is by more.
            surface_rise_k: warm(first.rises_k[0], 1.0),
            film_rise_k: warm(first.rises_k[1], 2.0),
            rough: [0, 1].map(|body| rough[body] > 0.0 || to_come.rough[body]),
        }
    }
}

/// Greatest film within 0.9 of Hertz's half-widths, m.
#[cfg(not(target_arch = "wasm32"))]
fn film_within(frame: &Frame) -> f64 {
    let inside = |at: usize| {
        let x_m = frame.x_min_m + frame.dx_m * (at % frame.nx) as f64;
        let y_m = frame.y_min_m + frame.dy_m * (at / frame.nx) as f64;
        let y = match frame.kind {
            ContactKind::Point => y_m / frame.b_m,
            ContactKind::Line => 0.0,
        };
        (x_m / frame.a_m).hypot(y) < 0.9
    };
    let film = frame.film_m.iter().enumerate();
    let within = film.filter(|(at, _)| inside(*at)).map(|(_, film)| *film);
    within.fold(0.0, f32::max).into()
}

fn greatest(field: &[f32]) -> f64 {
    field.iter().fold(0.0_f32, |top, v| top.max(v.abs())).into()
}
