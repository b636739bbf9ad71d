//! What the layout has to know of the pictures.

use super::ages::{self, AgeCurves};
use super::entities::SUFFERED;
use super::maps::rises;
use super::plot::PlotBox;
use super::tooth::ShownTooth;
use asperity_engine::scene::{ContactKind, Life, Scene};
use asperity_engine::sim::Frame;
use asperity_picture::{ResearchPlot, Scope, Subject};

/// Whether S, speed or load change while a run is recorded: what rests is a number and no curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Knobs {
    Rest,
    /// By the script, or perhaps by hand.
    Turn,
}

impl Knobs {
    /// Of a run of that scene.
    pub(crate) fn of(scene: Option<&Scene>) -> Self {
        match scene {
            Some(scene) if scene.events.is_empty() => Self::Rest,
            _ => Self::Turn,
        }
    }
}

/// What the first frame tells the layout.
pub(crate) struct ShownViews {
    /// Whether the run goes on while it is shown.
    pub(crate) live: bool,
    /// Simulated time over the time in which it is played; `None` where nothing moves.
    pub(crate) playback_speed: Option<f64>,
    pub(crate) knobs: Knobs,
    /// S that the run begins at; `None`: its scene is not known.
    slide_roll: Option<f64>,
    pub(crate) kind: ContactKind,
    /// What is between the bodies, with a capital letter: film, or gap where no oil is.
    between: &'static str,
    pub(crate) map: PlotBox,
    pub(crate) interferogram: PlotBox,
    pub(crate) centre_line: PlotBox,
    pub(crate) slice: Option<PlotBox>,
    /// The same of a line contact over the logarithm of the depth, which is shown in its place.
    pub(crate) over_log: Option<PlotBox>,
    pub(crate) trace: Option<PlotBox>,
    /// Both surfaces, and below them the trace.
    pub(crate) profile: Option<[[f64; 2]; 2]>,
    pub(crate) kymograph: PlotBox,
    /// The tooth that the contact rides along.
    pub(crate) tooth: Option<ShownTooth>,
    /// Target and position of the camera, and of the one that looks down on the pressure.
    pub(crate) camera: Option<[[f64; 3]; 2]>,
    pub(crate) lecture: Option<[[f64; 3]; 2]>,
    pub(crate) rough: [bool; 2],
    /// Bodies whose damage is mapped.
    pub(crate) damaged: [bool; 2],
    pub(crate) life: bool,
    /// Whether a body has a hardness at which it flows.
    pub(crate) yields: bool,
    /// Maps of the damage of all cycles; none where it is not followed.
    pub(crate) suffered: &'static [&'static str],
    /// Curves of surfaces that age.
    pub(crate) ages: Vec<&'static AgeCurves>,
    /// Plots for researchers; none in runs side by side.
    pub(crate) research: Vec<ResearchPlot>,
    /// Maps of temperature; none where the scene asks for no heat.
    pub(crate) rises: &'static [(&'static str, Subject)],
}

/// A title's first word where oil is between the bodies.
const FILM: &str = "Film";
const GAP: &str = "Gap";

impl ShownViews {
    /// A title that is said of oil, of what is between the bodies here.
    pub(crate) fn said(&self, title: &str) -> String {
        title
            .replace(FILM, self.between)
            .replace("film", &self.between.to_lowercase())
    }

    /// Whether no oil is between the bodies.
    pub(crate) fn is_dry(&self) -> bool {
        self.between == GAP
    }

    /// Whether the bodies slide over each other, now or later: else nothing is sheared.
    pub(crate) fn slides(&self) -> bool {
        self.slide_roll != Some(0.0) || self.knobs == Knobs::Turn
    }

    /// Of a run with that first frame, before any of its other pictures is set up.
    pub(crate) fn new(scene: Option<&Scene>, first: &Frame, scope: &Scope, map: PlotBox) -> Self {
        let life = scene.and_then(|scene| scene.life.as_ref());
        Self {
            live: false,
            playback_speed: None,
            knobs: Knobs::of(scene),
            slide_roll: scene.map(|scene| scene.motion.slide_roll),
            kind: first.kind,
            between: match scene {
                Some(scene) if scene.lubricant.is_none() => GAP,
                _ => FILM,
            },
            map,
            interferogram: PlotBox::default(),
            centre_line: PlotBox::default(),
            slice: None,
            over_log: None,
            trace: None,
            profile: None,
            tooth: None,
            kymograph: PlotBox::default(),
            camera: None,
            lecture: None,
            rough: scope.ranges.rough,
            damaged: life.map_or([false; 2], Life::maps),
            life: first.metrics.life.is_some(),
            yields: first.metrics.yielded_m3.is_some(),
            suffered: if scene.is_some_and(ages::pits) {
                &SUFFERED
            } else {
                &[]
            },
            ages: scene.map_or_else(Vec::new, ages::of),
            research: Vec::new(),
            rises: rises(first),
        }
    }
}
