//! What was simulated where: settled lives and frictions of the run and of the sweep beside it, and which of
//! them stand on a curve against S or against the speed.
//!
//! A point holds for one S, speed, load and pair of amplitudes. A curve along one of the first two takes the
//! points that agree with the knobs in all else, so that a knob that is turned empties it at once, and fills it
//! again when it is turned back.

use std::sync::Arc;

use super::data::Effect;
use super::state::App;
use crate::tui::kinds::{Across, CurveKind};
use asperity_engine::plan::Plan;
use asperity_engine::scene::Scene;
use asperity_engine::sim::{Knob, Metrics};
use asperity_session::run::{Assumed, AssumedRange};
use asperity_session::sweep::{Along, CurveOrder, CurvePoint, Found, Varied};

/// Values of S that a sweep visits, of either sign: close where life falls fastest.
const SWEPT: [f64; 10] = [0.0, 0.05, 0.1, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75];
/// Values of S that are as good as the same.
pub(super) const SAME_S: f64 = 0.02;
/// ln of the lives on both sides of a gap from which on its middle is visited too.
const BEND: f64 = 0.25;
/// Speeds that a sweep visits to either side of the scene's own, four to a decade.
const SPEEDS: i32 = 4;
/// Ratio of speeds that are as good as the same.
const SAME_SPEED: f64 = 0.05;
/// Points kept.
const KEPT: usize = 256;

/// Where a frame was computed.
pub(super) fn conditions(metrics: &Metrics) -> CurvePoint {
    CurvePoint {
        slide_roll: metrics.slide_roll,
        entrainment_m_s: metrics.entrainment_m_s,
        load_n: metrics.load_n,
        amplitude_m: [metrics.amplitude_1_m, metrics.amplitude_2_m],
    }
}

pub(super) fn close(one: f64, other: f64, within: f64) -> bool {
    (one - other).abs() <= within * one.abs().max(other.abs())
}

/// Load and both surfaces.
pub(super) fn same_contact(one: &CurvePoint, other: &CurvePoint) -> bool {
    const ROUNDED: f64 = 1e-3;
    let [a, b] = [one, other].map(|at| [at.load_n, at.amplitude_m[0], at.amplitude_m[1]]);
    a.into_iter().zip(b).all(|(a, b)| close(a, b, ROUNDED))
}

impl App {
    /// Where the knobs are going.
    pub(super) fn aim(&self) -> CurvePoint {
        CurvePoint {
            slide_roll: self.target(Knob::SlideRoll),
            entrainment_m_s: self.target(Knob::EntrainmentMS),
            // A scene has a dial for one of the two.
            load_n: self.target(Knob::ForceN) + self.target(Knob::ForceNPerM),
            amplitude_m: [Knob::Amplitude1M, Knob::Amplitude2M].map(|knob| self.target(knob)),
        }
    }

    /// What was simulated along one line through the knobs' targets.
    pub fn simulated(&self, along: Along) -> impl Iterator<Item = &Found> {
        let aim = self.aim();
        self.lives.simulated.iter().filter(move |found| {
            let on_the_line = match along {
                Along::SlideRoll => close(found.at.entrainment_m_s, aim.entrainment_m_s, 1e-3),
                Along::Entrainment => (found.at.slide_roll - aim.slide_roll).abs() < 1e-3,
            };
            on_the_line && same_contact(&found.at, &aim)
        })
    }

    /// All that was simulated in this sitting.
    pub(crate) fn all_simulated(&self) -> impl Iterator<Item = &Found> {
        self.lives.simulated.iter()
    }

    /// The newer of two points in the same place stays.
    pub(super) fn keep_point(&mut self, new: Found) {
        self.lives.simulated.retain(|old| {
            let (old, new) = (&old.at, &new.at);
            !same_contact(old, new)
                || (old.slide_roll - new.slide_roll).abs() > SAME_S
                || !close(old.entrainment_m_s, new.entrainment_m_s, SAME_SPEED)
        });
        if self.lives.simulated.len() == KEPT {
            self.lives.simulated.remove(0);
        }
        self.lives.simulated.push(new);
    }

    /// Takes what a sweep has found; `progress`: values done and in all, `None` when there is no sweep. One that is done is
    /// gone on with where the curve bends, once the last mesh has settled.
    pub fn take_swept(
        &mut self,
        found: Vec<Found>,
        progress: Option<(usize, usize)>,
    ) -> Vec<Effect> {
        let under_way = progress.filter(|(done, all)| done < all);
        let was_under_way = std::mem::replace(&mut self.lives.sweep, under_way).is_some();
        for point in found {
            match self.lives.sweeping {
                Varied::Along(_) => self.keep_point(point),
                Varied::Assumed(_) => self.keep_otherwise(&point),
            }
        }
        if was_under_way && under_way.is_none() {
            self.conclude_otherwise();
            self.begin_sweep()
        } else {
            Vec::new()
        }
    }

    /// Asks for what is missing on the curve that is shown.
    pub(super) fn begin_sweep(&mut self) -> Vec<Effect> {
        let settled = self.replay.settled.as_ref();
        // Cases beside surfaces that age would have to age, too.
        let ages = self.run.setup.scene.age.is_some();
        if ages || settled.is_none_or(|settled| settled.state.is_none()) {
            return Vec::new();
        }
        if let Some(across) = self.view.curve.across() {
            return self.begin_row(across);
        }
        let along = self.view.curve.along();
        let known = |value: f64| {
            self.simulated(along).any(|found| match along {
                Along::SlideRoll => (found.at.slide_roll - value).abs() <= SAME_S,
                Along::Entrainment => close(found.at.entrainment_m_s, value, SAME_SPEED),
            })
        };
        // What was tried and gave nothing is not tried again.
        let is_new = |value: &f64| !known(*value) && !self.lives.swept.contains(&[*value, 1.0]);
        let mut values: Vec<f64> = self.candidates(along).filter(is_new).collect();
        // What bends waits for the last mesh, whose climb it would make twice as long.
        let is_last = settled.is_some_and(|settled| settled.is_last);
        if values.is_empty() && along == Along::SlideRoll && is_last {
            values = self.bends().into_iter().filter(is_new).collect();
        }
        if values.is_empty() {
            return self.begin_otherwise();
        }
        (self.lives.swept).extend(values.iter().map(|value| [*value, 1.0]));
        // What this one ends is asked for again after it.
        self.lives.assumed.retain(|(_, range)| range.is_some());
        let scene = self.scene_now();
        self.order(Varied::Along(along), values, scene)
    }

    pub(super) fn order(&mut self, varied: Varied, values: Vec<f64>, scene: Scene) -> Vec<Effect> {
        self.lives.sweeping = varied;
        vec![Effect::Sweep(Box::new(CurveOrder {
            varied,
            values,
            scene,
        }))]
    }

    /// Once the curve and the last mesh are done: the lives with the next thing assumed otherwise of which a caution says that the
    /// scene assumes it.
    pub(super) fn begin_otherwise(&mut self) -> Vec<Effect> {
        let is_last = (self.replay.settled.as_ref()).is_some_and(|settled| settled.is_last);
        if !is_last || self.lives.sweep.is_some() {
            return Vec::new();
        }
        let scene = Arc::new(self.scene_now());
        let Ok(plan) = Plan::new(&scene) else {
            return Vec::new();
        };
        let asked = |what: &Assumed| self.lives.assumed.iter().any(|(old, _)| old == what);
        let cautions = self.cautions();
        let is_said = |what: &Assumed| cautions.iter().any(|one| one.code == what.caution());
        let mut open = (Assumed::ALL.into_iter()).filter(|what| is_said(what) && !asked(what));
        let Some(what) = open.find(|what| what.moves(&scene, &plan)) else {
            return Vec::new();
        };
        self.lives.assumed.push((what, None));
        self.lives.otherwise = vec![None; what.count()];
        let values = (0..what.count()).map(|k| k as f64).collect();
        self.order(Varied::Assumed(what), values, Arc::unwrap_or_clone(scene))
    }

    fn keep_otherwise(&mut self, found: &Found) {
        if let Some(place) = self.lives.otherwise.get_mut(found.choice) {
            *place = found.life.map(|[_, life, _]| life);
        }
    }

    /// What a sweep over a choice has come to, once it has ended.
    fn conclude_otherwise(&mut self) {
        let Varied::Assumed(what) = self.lives.sweeping else {
            return;
        };
        let range = AssumedRange::of(&std::mem::take(&mut self.lives.otherwise));
        if let Some(place) = (self.lives.assumed.iter_mut()).find(|(one, _)| *one == what) {
            place.1 = range;
        }
    }

    /// What is known of the life over the choices of what the scene assumes.
    pub(super) fn assumed(&self, what: Assumed) -> Option<AssumedRange> {
        let mut known = self.lives.assumed.iter();
        known.find(|(one, _)| *one == what)?.1
    }

    /// Values within the knob's range.
    fn candidates(&self, along: Along) -> impl Iterator<Item = f64> {
        let knob = match along {
            Along::SlideRoll => Knob::SlideRoll,
            Along::Entrainment => Knob::EntrainmentMS,
        };
        let dial = self.choice.dials.iter().find(|dial| dial.knob == knob);
        let mut values: Vec<f64> = match along {
            Along::SlideRoll => SWEPT.iter().flat_map(|s| [*s, -*s]).collect(),
            Along::Entrainment => {
                let home = dial.map_or(1.0, |dial| dial.home);
                let ratio = |k: i32| 10.0_f64.powf(f64::from(k) / f64::from(SPEEDS));
                (-SPEEDS..=SPEEDS).map(|k| home * ratio(k)).collect()
            }
        };
        values.dedup();
        let range = dial.map_or([0.0, 0.0], |dial| [dial.min, dial.max]);
        values
            .into_iter()
            .filter(move |value| (range[0]..=range[1]).contains(value))
    }

    /// Values of S in the middle of gaps that the life changes much across.
    fn bends(&self) -> Vec<f64> {
        let place = |found: &Found| Some((found.at.slide_roll, found.life?[1].ln()));
        let mut known: Vec<_> = (self.simulated(Along::SlideRoll).filter_map(place)).collect();
        known.sort_by(|one, two| one.0.total_cmp(&two.0));
        let gaps = known.windows(2).map(|sides| (sides[0], sides[1]));
        let bends = gaps.filter(|(left, right)| {
            (right.1 - left.1).abs() > BEND && right.0 - left.0 > 3.0 * SAME_S
        });
        bends
            .map(|(left, right)| 0.5 * (left.0 + right.0))
            .collect()
    }

    /// The next curve; what it lacks is computed.
    pub(super) fn next_curve(&mut self) -> Vec<Effect> {
        let swept = |curve: CurveKind| (curve.along(), curve.across());
        let before = swept(self.view.curve);
        let ages = self.run.setup.scene.age.is_some();
        self.view.curve = self.view.curve.next(ages);
        while (self.view.curve.across()).is_some_and(|across| !self.has_map(across)) {
            self.view.curve = self.view.curve.next(ages);
        }
        // A screen without room for curves draws them in the enlarged panel alone.
        self.say(format!(
            "{} (Enter on the life draws it large)",
            self.view.curve.name()
        ));
        if swept(self.view.curve) == before {
            return Vec::new();
        }
        self.lives.swept.clear();
        self.begin_sweep()
    }
}

impl CurveKind {
    /// What a sweep for it, or beside it, goes along.
    pub fn along(self) -> Along {
        match self {
            Self::Life | Self::Friction | Self::Map(_) | Self::Aged(_) => Along::SlideRoll,
            Self::Stribeck => Along::Entrainment,
        }
    }

    /// What a map has upwards; `None`: it is a curve.
    pub fn across(self) -> Option<Across> {
        match self {
            Self::Map(across) => Some(across),
            Self::Life | Self::Friction | Self::Stribeck | Self::Aged(_) => None,
        }
    }
}
