//! Round numbers for axes and colour ranges, and the ranges that every picture of a run shares.

use crate::physics::hertz::crest_pressure_pa;
use crate::scene::{ContactKind, Scene, Surface};
use crate::sim::{Frame, Knob, Metrics};

/// Metres to millimetres.
pub(crate) const MM: f64 = 1.0e3;
/// GPa, MPa, µm from SI.
pub(crate) const GPA: (&str, f64) = ("GPa", 1e-9);
/// See [`GPA`].
pub(crate) const MPA: (&str, f64) = ("MPa", 1e-6);
/// See [`GPA`].
pub(crate) const UM: (&str, f64) = ("µm", 1e6);

/// What ranges begin with: the first frame in figures.
#[derive(Debug, Clone)]
pub(crate) struct First {
    kind: ContactKind,
    p_hertz_pa: f64,
    metrics: Metrics,
    /// Greatest of either sign, SI: traction, roughness of both bodies, effective stress and shear of the slice.
    traction_pa: f64,
    roughness_m: [f64; 2],
    effective_pa: f64,
    shear_pa: f64,
}

impl First {
    /// Of that frame.
    pub(crate) fn of(frame: &Frame) -> Self {
        let slice = frame.slice.as_ref();
        Self {
            kind: frame.kind,
            p_hertz_pa: frame.p_hertz_pa,
            metrics: frame.metrics.clone(),
            traction_pa: greatest(&frame.traction_pa),
            roughness_m: [&frame.roughness_1_m, &frame.roughness_2_m].map(|field| greatest(field)),
            effective_pa: slice.map_or(0.0, |slice| greatest(&slice.effective_pa)),
            shear_pa: slice.map_or(0.0, |slice| greatest(&slice.tau_xz_pa)),
        }
    }
}

/// Knobs that ranges follow, each the greatest that was seen or is on its way.
#[derive(Debug, Clone, Copy, PartialEq)]
struct TurnedKnobs {
    load: f64,
    speed_m_s: f64,
    amplitude_m: [f64; 2],
}

impl TurnedKnobs {
    fn of(m: &Metrics) -> Self {
        Self {
            load: m.load_n.max(m.load_target_n),
            speed_m_s: m.entrainment_m_s.abs(),
            amplitude_m: [m.amplitude_1_m, m.amplitude_2_m].map(f64::abs),
        }
    }

    fn with(self, other: Self) -> Self {
        let both = |k: usize| self.amplitude_m[k].max(other.amplitude_m[k]);
        Self {
            load: self.load.max(other.load),
            speed_m_s: self.speed_m_s.max(other.speed_m_s),
            amplitude_m: [both(0), both(1)],
        }
    }
}

/// The ranges of a run as it goes on: those of its script, and wider ones from the frame on at which a knob is turned beyond it.
#[derive(Debug, Clone)]
pub(crate) struct Scope {
    first: First,
    turned: TurnedKnobs,
    /// What can come by the script and by what was turned so far.
    pub(crate) to_come: ToCome,
    /// The ranges that hold now.
    pub(crate) ranges: Ranges,
}

impl Scope {
    /// Of a run with that first frame.
    pub(crate) fn of(scene: Option<&Scene>, first: &Frame) -> Self {
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
    pub(crate) fn grows(&mut self, scene: Option<&Scene>, m: &Metrics) -> bool {
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

/// The greatest that a run's own script, and what was turned by hand, can bring of what its pictures scale with, and what
/// bounds its friction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ToCome {
    /// Half-width and Hertz pressure over those of the first frame.
    pub(crate) size: f64,
    /// Film over that of the first frame, by its dependence on the speed.
    film: f64,
    /// Amplitudes of body 1 and 2, m.
    pub(crate) amplitude_m: [f64; 2],
    /// Pressure of crests that are pressed flat, Pa. Where a film separates them and they grow no more, at most twice
    /// the ripple of the first frame: those of both bodies may meet there or not.
    crest_pa: f64,
    /// Greatest traction over pressure: limiting shear of the oil or boundary friction; 0: not known.
    friction: f64,
    /// Which bodies are rough, or may be made so.
    rough: [bool; 2],
}

impl ToCome {
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
        let size = first.kind.hertz_shape().size_ratio(load_ratio);
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
            rough: scene.map_or([false; 2], |scene| {
                scene
                    .surfaces()
                    .map(|surface| !matches!(surface, Surface::Smooth {}))
            }),
        }
    }
}

/// Exponent of the speed in the central film (Hamrock and Dowson 1977).
const FILM_BY_SPEED: f64 = 0.67;

/// Upper ends of the colour ranges, SI: what can come. They hold as long as no knob is turned beyond ([`Scope`]), so that
/// colours mean the same from frame to frame; values beyond take the top colour.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Ranges {
    /// Pressure, Pa.
    pub(crate) pressure_pa: f64,
    /// Film, m.
    pub(crate) film_m: f64,
    /// Traction of either sign, Pa.
    pub(crate) traction_pa: f64,
    /// Roughness of either sign, m.
    pub(crate) roughness_m: f64,
    /// Effective stress, Pa.
    pub(crate) effective_pa: f64,
    /// Orthogonal shear of either sign, Pa.
    pub(crate) shear_pa: f64,
    /// Which bodies are rough, or may be made so.
    pub(crate) rough: [bool; 2],
}

impl Ranges {
    /// The ranges of a run with that first frame, in which that can come.
    fn of(first: &First, to_come: &ToCome) -> Self {
        let metrics = &first.metrics;
        let round = |value: f64, (_, per_si): (&str, f64)| nice_up(value * per_si) / per_si;
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
        let rough = first.roughness_m;
        let [rough_1, rough_2] = [0, 1].map(|body| rough[body].max(to_come.amplitude_m[body]));
        Self {
            pressure_pa,
            film_m: round(film, UM),
            traction_pa: round(traction, MPA),
            roughness_m: round(rough_1.max(rough_2), UM),
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
            rough: [0, 1].map(|body| rough[body] > 0.0 || to_come.rough[body]),
        }
    }
}

fn greatest(field: &[f32]) -> f64 {
    field.iter().fold(0.0_f32, |top, v| top.max(v.abs())).into()
}

/// The least number of the form {1, 1.5, 2, 2.5, 3, 4, 5, 6, 8} 10^k that is not below `value`.
pub(crate) fn nice_up(value: f64) -> f64 {
    const STEPS: [f64; 10] = [1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
    if !(value.is_finite() && value > 0.0) {
        return 1.0;
    }
    let decade = 10_f64.powf(value.log10().floor());
    // The slack lets a value that is nice up to rounding stay where it is.
    let step = STEPS
        .into_iter()
        .find(|step| step * decade >= value * (1.0 - 1e-12));
    step.unwrap_or(10.0) * decade
}

/// Equal parts of [0, top], where top is one of [`nice_up`]'s: three to five, ends included.
pub(crate) fn divisions(top: f64) -> Vec<f64> {
    let leading = top / 10_f64.powf((top.log10() + 1e-9).floor());
    let parts = match (leading * 10.0).round() as u32 {
        15 | 30 | 60 => 3,
        25 | 50 => 5,
        _ => 4,
    };
    (0..=parts)
        .map(|k| top * f64::from(k) / f64::from(parts))
        .collect()
}

/// Round positions in [low, high], about `about` of them.
pub(crate) fn ticks(low: f64, high: f64, about: usize) -> Vec<f64> {
    let raw = (high - low) / about.max(1) as f64;
    if !(raw.is_finite() && raw > 0.0) {
        return vec![low];
    }
    let decade = 10_f64.powf(raw.log10().floor());
    let step = [1.0, 2.0, 2.5, 5.0, 10.0]
        .into_iter()
        .map(|step| step * decade)
        .find(|&step| step >= raw * (1.0 - 1e-9))
        .unwrap_or(raw);
    let first = (low / step - 1e-9).ceil() as i64;
    let last = (high / step + 1e-9).floor() as i64;
    (first..=last).map(|k| k as f64 * step).collect()
}

/// A tick's number without needless digits.
pub(crate) fn number(value: f64) -> String {
    let rounded = (value * 1e6).round() / 1e6;
    // Minus zero reads badly on an axis.
    format!("{}", if rounded == 0.0 { 0.0 } else { rounded })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tops_of_scales_are_round_and_not_too_far() {
        assert_eq!(nice_up(1.0), 1.0);
        assert_eq!(nice_up(1.01), 1.5);
        assert!((nice_up(0.39) - 0.4).abs() < 1e-12);
        assert_eq!(nice_up(8.5e3), 1.0e4);
        assert_eq!(nice_up(0.0), 1.0);
        assert_eq!(nice_up(f64::NAN), 1.0);
        for k in 1..2000 {
            let value = 1.7e-9 * 1.02_f64.powi(k);
            let top = nice_up(value);
            assert!(top >= value * (1.0 - 1e-9) && top <= 1.51 * value);
        }
    }

    #[test]
    fn divisions_are_round_and_hold_both_ends() {
        for top in [
            1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 0.5, 1500.0,
        ] {
            let parts = divisions(top);
            assert_eq!((parts.first(), parts.last()), (Some(&0.0), Some(&top)));
            assert!((4..=6).contains(&parts.len()));
            assert!(
                parts.iter().all(|&value| number(value).len() <= 5),
                "{parts:?}"
            );
        }
    }

    #[test]
    fn ticks_cover_the_axis() {
        let at = ticks(-1.18, 0.71, 4);
        assert_eq!(at, vec![-1.0, -0.5, 0.0, 0.5]);
        assert_eq!(ticks(0.0, 1.0, 4), vec![0.0, 0.25, 0.5, 0.75, 1.0]);
        assert_eq!(ticks(1.0, 1.0, 4), vec![1.0]);
        assert_eq!(number(-0.0), "0");
        assert_eq!(number(0.1 + 0.2), "0.3");
    }
}
