//! The screen's state and its parts.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

use super::data::{AxisEnds, ErrandKind, LifeSample, Pinned, SettledMean, StateBefore, Trouble};
use crate::tui::choice::Draft;
use crate::tui::dial::{Dial, dials};
use crate::tui::estimate::basis;
use crate::tui::kinds::{
    AutoReplay, CurveKind, MapKind, Overlay, PanelKind, PointQuantity, RunPace, Zoom,
};
use crate::tui::kymograph::{Kymograph, Span};
use crate::tui::lessons::{Lesson, Staging, TourState, built_in};
use crate::tui::pixels::Medium;
use crate::tui::replay::Replay;
use crate::tui::theme::Theme;
use crate::tui::trace::{Chosen, Trace};
use crate::tui::units::Units;
use crate::tui::wiring::{Health, RunStatus, Setup};
use asperity_engine::physics::estimate::{Anchor, Estimate, EstimateBasis, Loaded, OperatingPoint};
use asperity_engine::scene::Scene;
use asperity_engine::sim::{AgePoint, Frame, Knob, LifeEstimate};
use asperity_picture::{Ranges, Scope};
use asperity_session::run::{Assumed, AssumedRange, Settled};
use asperity_session::sweep::{Along, Found, Varied};

/// The screen's state.
#[derive(Debug, Clone)]
pub struct App {
    /// What the run has told.
    pub(crate) run: RunState,
    /// The knobs, and a scene in the making.
    pub(crate) choice: ChoiceState,
    /// Lives: estimated, simulated, swept.
    pub(crate) lives: LivesState,
    /// A passage that repeats, and the material point.
    pub(crate) replay: ReplayState,
    /// What is shown, and how.
    pub(crate) view: ViewState,
    /// The lessons.
    pub(crate) lesson: LessonState,
    /// Wall time since the start.
    pub(super) now: Duration,
}

/// What the run has told.
#[derive(Debug, Clone)]
pub(crate) struct RunState {
    pub(crate) setup: Setup,
    /// Errands that are offered.
    pub(super) errands: Vec<ErrandKind>,
    pub(crate) status: RunStatus,
    pub(crate) pace: RunPace,
    /// The last frames, the newest last.
    pub(super) frames: VecDeque<Arc<Frame>>,
    /// How many frames back from the newest the screen shows.
    pub(super) frames_back: usize,
    /// Passages that were made on other meshes, or before a knob sent the run back to the first.
    pub(super) passages_before: f64,
    /// What the ranges of pictures come from.
    pub(super) scope: Option<Scope>,
    pub(crate) axis_ends: AxisEnds,
    /// Pressure and film of the last steps along the centre line.
    pub(super) kymograph: Kymograph,
    /// When which steps came: the run's speed.
    pub(super) step_times: VecDeque<(Duration, u64)>,
    /// The last step that did not converge, and until when it is told.
    pub(super) trouble: Option<(Trouble, Duration)>,
    /// A fault panel that was read and closed.
    pub(super) fault_read: bool,
}

/// The knobs, and a scene in the making.
#[derive(Debug, Clone)]
pub(crate) struct ChoiceState {
    pub(crate) dials: Vec<Dial>,
    pub(crate) chosen: usize,
    /// When each knob was last set from here.
    pub(super) set_at: Vec<Option<Duration>>,
    /// A value for the chosen knob, as far as it has been typed.
    pub(crate) typing: Option<String>,
    /// The state that the knobs were turned away from.
    pub(super) before_turn: Option<StateBefore>,
    /// A scene in the making.
    pub(crate) draft: Option<Draft>,
}

/// Lives: estimated, simulated, swept.
#[derive(Debug, Clone)]
pub(crate) struct LivesState {
    pub(crate) estimate: Estimate,
    pub(super) basis: EstimateBasis,
    /// The simulated state from which lives are scaled.
    pub(super) anchor: Option<Anchor>,
    /// The contact where the knobs are going, by formula.
    pub(super) loaded: Loaded,
    pub(crate) history: VecDeque<LifeSample>,
    /// Surfaces that age, jump by jump.
    pub(crate) ages: Vec<AgePoint>,
    /// What was simulated, by the run and beside it.
    pub(super) simulated: Vec<Found>,
    pub(super) friction: SettledMean,
    pub(super) film: SettledMean,
    /// Values done and in all, while a sweep is under way.
    pub(crate) sweep: Option<(usize, usize)>,
    /// What it goes along.
    pub(crate) sweeping: Varied,
    /// Values that sweeps were asked for since a knob was turned; of a map with the times that its row is of, else with 1.
    pub(super) swept: Vec<[f64; 2]>,
    /// Lives with what is assumed assumed otherwise, as a sweep finds them.
    pub(super) otherwise: Vec<Option<f64>>,
    /// What they come to; `None`: under way, or not all of them got through.
    pub(super) assumed: Vec<(Assumed, Option<AssumedRange>)>,
}

/// A passage that repeats, and the material point.
#[derive(Debug, Clone, Default)]
pub(crate) struct ReplayState {
    /// One period of the passage, once it repeats.
    pub(super) settled: Option<Arc<Settled>>,
    /// The period that turning a knob has ended.
    pub(super) settled_before: Option<Arc<Settled>>,
    pub(crate) playing: Option<Replay>,
    /// Whether a passage that repeats is replayed without being asked.
    pub(super) auto: AutoReplay,
    pub(crate) trace: Trace,
    /// The material point that was chosen, or that a replay began with.
    pub(super) point: Option<Chosen>,
}

/// What is shown, and how.
#[derive(Debug, Clone)]
pub(crate) struct ViewState {
    pub(crate) theme: Theme,
    pub(crate) units: Units,
    pub(super) medium: Medium,
    pub(crate) map: MapKind,
    pub(crate) zoom: Zoom,
    pub(crate) point_quantity: PointQuantity,
    pub(crate) curve: CurveKind,
    pub(crate) overlay: Overlay,
    /// Rows that the plan has been moved up.
    pub(crate) scroll: u16,
    /// Where the map is read: x and y in half-widths.
    pub(crate) probe: Option<(f64, f64)>,
    /// The panel that the keys speak of.
    pub(crate) focus: PanelKind,
    /// The panel that takes the screen.
    pub(crate) enlarged: Option<PanelKind>,
    /// The life to compare with.
    pub(crate) pinned: Option<Pinned>,
    /// The screen as it was when it was frozen: map, trace and bars are drawn beside those of now.
    pub(crate) frozen: Option<Arc<App>>,
    /// Whether this is such a one.
    pub(crate) is_frozen: bool,
    /// A line that is being said, and until when.
    pub(super) message: Option<(String, Duration)>,
}

/// The lessons.
#[derive(Debug, Clone)]
pub(crate) struct LessonState {
    /// Those of the program, and a lecturer's own.
    pub(crate) all: Arc<[Arc<Lesson>]>,
    /// The lesson that is chosen in their list.
    pub(crate) chosen: usize,
    pub(crate) tour: Option<TourState>,
    /// The lesson's scene that runs; `None`: the user's own.
    pub(super) staged: Option<Staging>,
    /// Whether it is begun anew although it runs: its crests stand where the lesson's beats have left them.
    pub(super) restage: bool,
    /// The user's own scene and its name, for the end of the tour.
    pub(super) own_scene: (Arc<Scene>, String),
}

impl App {
    /// A screen before the first frame, which offers those errands.
    pub fn new(setup: Setup, errands: Vec<ErrandKind>, theme: Theme) -> Self {
        let dials = dials(&setup.scene, setup.load_n, setup.p_hertz_pa);
        let curve = match setup.scene.life {
            Some(_) => CurveKind::Life,
            None => CurveKind::Friction,
        };
        Self {
            lives: LivesState::new(&setup, &dials),
            choice: ChoiceState {
                chosen: 0,
                set_at: vec![None; dials.len()],
                typing: None,
                before_turn: None,
                draft: None,
                dials,
            },
            replay: ReplayState::default(),
            view: ViewState::new(theme, curve),
            lesson: LessonState {
                all: built_in(),
                chosen: 0,
                tour: None,
                staged: None,
                restage: false,
                own_scene: (Arc::clone(&setup.scene), setup.name.clone()),
            },
            run: RunState {
                setup,
                errands,
                status: RunStatus::default(),
                pace: RunPace::default(),
                frames: VecDeque::new(),
                frames_back: 0,
                passages_before: 0.0,
                scope: None,
                axis_ends: AxisEnds::default(),
                kymograph: Kymograph::default(),
                step_times: VecDeque::new(),
                trouble: None,
                fault_read: false,
            },
            now: Duration::ZERO,
        }
    }

    /// The ranges of pictures; none before the first frame.
    pub(crate) fn ranges(&self) -> Ranges {
        self.run
            .scope
            .as_ref()
            .map(|scope| scope.ranges)
            .unwrap_or_default()
    }

    /// Says how late it is, counted from the start.
    pub fn tick(&mut self, now: Duration) {
        self.now = now;
        if let Some((_, until)) = &self.view.message
            && *until < now
        {
            self.view.message = None;
        }
    }

    /// Takes what the run says of itself.
    pub fn take_status(&mut self, status: RunStatus) {
        self.run.status = status;
    }

    /// Shows a line for some seconds, a long one for longer.
    pub fn say(&mut self, text: impl Into<String>) {
        /// Letters read in a second, by one who must look for them first.
        const LETTERS: u64 = 15;
        let text = text.into();
        let seconds = 4 + text.chars().count() as u64 / LETTERS;
        self.view.message = Some((text, self.now + Duration::from_secs(seconds)));
    }

    /// The frame on the screen: the newest, one of the past, or one of the orbit that is replayed.
    pub fn frame(&self) -> Option<&Arc<Frame>> {
        if let Some(replay) = &self.replay.playing {
            return Some(replay.frame());
        }
        let place = self
            .run
            .frames
            .len()
            .checked_sub(1 + self.run.frames_back)?;
        self.run.frames.get(place)
    }

    /// How many frames back the screen is, and how many there are.
    pub fn rewound(&self) -> (usize, usize) {
        (
            self.run.frames_back,
            self.run.frames.len().saturating_sub(1),
        )
    }

    /// Time steps per second of wall time, over the last two seconds; `None` while the run waits.
    pub fn steps_per_s(&self) -> Option<f64> {
        if self.run.pace == RunPace::Paused {
            return None;
        }
        let (first, last) = (self.run.step_times.front()?, self.run.step_times.back()?);
        let seconds = last.0.checked_sub(first.0)?.as_secs_f64();
        (seconds > 0.0).then(|| last.1.saturating_sub(first.1) as f64 / seconds)
    }

    /// Where a knob is going, as the screen has it.
    pub fn target(&self, knob: Knob) -> f64 {
        target_of(&self.choice.dials, knob)
    }

    /// The load that the knob is going to, N; of a line N/m.
    pub fn load_n(&self) -> f64 {
        // A scene has a dial for one of the two.
        self.target(Knob::ForceN) + self.target(Knob::ForceNPerM)
    }

    /// What shows the screen.
    pub fn set_medium(&mut self, medium: Medium) {
        self.view.medium = medium;
    }

    /// Whether a page shows the screen: what it has buttons and letters of its own for is not drawn.
    pub(crate) fn is_page(&self) -> bool {
        self.view.medium == Medium::Page
    }

    /// Whether map and curves are left to a page's own pixels, and nothing lies over them.
    pub(crate) fn is_in_pixels(&self) -> bool {
        let covered = self.view.overlay != Overlay::None || self.fault().is_some();
        self.is_page() && self.view.theme.paints() && !covered
    }

    /// The map that is shown.
    pub fn map(&self) -> MapKind {
        self.view.map
    }

    /// The line that is being said.
    pub fn message(&self) -> Option<&str> {
        self.view.message.as_ref().map(|(text, _)| text.as_str())
    }

    /// The fault to show over the screen, unless it was closed.
    pub fn fault(&self) -> Option<&str> {
        match &self.run.status.health {
            Health::Failed(reason) => (!self.run.fault_read).then_some(reason.as_str()),
            Health::Running | Health::Finished => None,
        }
    }

    /// The life that the frame carries; of a period that is replayed that of the whole, whose mean its frames lead up to.
    pub fn life(&self) -> Option<LifeEstimate> {
        let whole = self.replay.playing.as_ref();
        let whole = whole.and_then(|replay| replay.settled().frames.last());
        let frame = whole.or_else(|| self.frame());
        frame.and_then(|frame| frame.metrics.life)
    }

    /// The centre line over the way that led to the frame on the screen.
    pub(crate) fn waves(&self) -> Option<Span<'_>> {
        match &self.replay.playing {
            Some(replay) => Some(Span::Orbit(replay)),
            None => self.frame().map(|frame| Span::Run {
                kept: &self.run.kymograph,
                passages: frame.passages,
            }),
        }
    }

    /// Whether the program offers an errand.
    pub fn offers(&self, errand: ErrandKind) -> bool {
        self.run.errands.contains(&errand)
    }
}

/// The operating point that the knobs are going to.
pub(super) fn point_of(dials: &[Dial]) -> OperatingPoint {
    OperatingPoint {
        slide_roll: target_of(dials, Knob::SlideRoll),
        // A scene has a dial for one of the two.
        load_n: target_of(dials, Knob::ForceN) + target_of(dials, Knob::ForceNPerM),
        amplitude_1_m: target_of(dials, Knob::Amplitude1M),
        amplitude_2_m: target_of(dials, Knob::Amplitude2M),
        entrainment_m_s: target_of(dials, Knob::EntrainmentMS),
    }
}

fn target_of(dials: &[Dial], knob: Knob) -> f64 {
    dials
        .iter()
        .find(|dial| dial.knob == knob)
        .map_or(0.0, |dial| dial.target)
}

impl LivesState {
    fn new(setup: &Setup, dials: &[Dial]) -> Self {
        let basis = basis(setup);
        let start = point_of(dials);
        let loaded = basis.loaded(&start);
        Self {
            estimate: basis.estimate(&loaded, None, &start),
            basis,
            anchor: None,
            loaded,
            history: VecDeque::new(),
            ages: Vec::new(),
            simulated: Vec::new(),
            friction: SettledMean::default(),
            film: SettledMean::default(),
            sweep: None,
            sweeping: Varied::Along(Along::default()),
            swept: Vec::new(),
            otherwise: Vec::new(),
            assumed: Vec::new(),
        }
    }
}

impl ViewState {
    fn new(theme: Theme, curve: CurveKind) -> Self {
        Self {
            theme,
            curve,
            units: Units::default(),
            medium: Medium::default(),
            map: MapKind::default(),
            zoom: Zoom::default(),
            point_quantity: PointQuantity::default(),
            overlay: Overlay::default(),
            scroll: 0,
            probe: None,
            focus: PanelKind::default(),
            enlarged: None,
            pinned: None,
            frozen: None,
            is_frozen: false,
            message: None,
        }
    }
}
