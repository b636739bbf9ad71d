//! The screen's state, and the reducer: (state, action) → state and effects. Nothing here draws,
//! waits or reads a clock, so every screen can be made in a test.

mod curve;
mod data;
mod ghost;
mod held;
mod ingest;
mod kinds;
mod lives;
mod reduce;
mod staged;
mod tour;
mod typed;
mod why;

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

use crate::tui::choice::Draft;
use crate::tui::dial::{Dial, dials};
use crate::tui::estimate::basis;
use crate::tui::kymograph::{Kymograph, Span};
use crate::tui::lessons::{Lesson, Staging, TourState, built_in};
use crate::tui::pixels::Pixels;
use crate::tui::replay::Replay;
use crate::tui::theme::Theme;
use crate::tui::trace::{Chosen, Trace};
use crate::tui::units::Units;
use crate::tui::wiring::{Health, RunStatus, Setup};
use asperity_engine::physics::estimate::{Anchor, Estimate, EstimateBasis, Loaded, OperatingPoint};
use asperity_engine::scene::Scene;
use asperity_engine::sim::{Frame, Knob, LifeEstimate};
use asperity_picture::{Ranges, Scope};
use asperity_session::run::Settled;
use asperity_session::sweep::{Along, Found};
use curve::MeanFriction;
pub use data::{Effect, ErrandKind, LifeSample, Pinned, Reached, Trouble, WhyUnconverged};
pub use held::PointNow;
pub use kinds::{
    AutoReplay, CurveKind, Leading, MapKind, Overlay, PanelKind, PointQuantity, RunPace, Zoom,
};
use why::MeanFilm;
pub use why::{LifeAccount, StateBefore, WhyLine};

/// The screen's state.
#[derive(Debug, Clone)]
pub struct App {
    pub(crate) setup: Setup,
    /// Errands that are offered.
    errands: Vec<ErrandKind>,
    pub(crate) theme: Theme,
    pub(crate) units: Units,
    pixels: Pixels,
    pub(crate) dials: Vec<Dial>,
    pub(crate) chosen: usize,
    pub(crate) map: MapKind,
    pub(crate) zoom: Zoom,
    pub(crate) quantity: PointQuantity,
    pub(crate) curve: CurveKind,
    pub(crate) overlay: Overlay,
    /// Rows that the plan has been moved up.
    pub(crate) scroll: u16,
    pub(crate) pace: RunPace,
    pub(crate) probe: Option<(f64, f64)>,
    pub(crate) pinned: Option<Pinned>,
    /// The screen as it was when it was frozen: map, trace and bars are drawn beside those of now.
    pub(crate) ghost: Option<Arc<Self>>,
    /// Whether this is such a one.
    pub(crate) is_frozen: bool,
    pub(crate) status: RunStatus,
    /// What the ranges of pictures come from.
    scope: Option<Scope>,
    pub(crate) reached: Reached,
    pub(crate) trace: Trace,
    pub(crate) history: VecDeque<LifeSample>,
    /// Pressure and film of the last steps along the centre line.
    waves: Kymograph,
    /// What was simulated, by the run and beside it.
    simulated: Vec<Found>,
    friction: MeanFriction,
    film: MeanFilm,
    /// The state that the knobs were turned away from.
    before: Option<StateBefore>,
    /// A value for the chosen knob, as far as it has been typed.
    pub(crate) typing: Option<String>,
    /// Values done and in all, while a sweep is under way.
    pub(crate) sweep: Option<(usize, usize)>,
    /// What it goes along.
    pub(crate) sweeping: Along,
    /// One period of the passage, once it repeats.
    held: Option<Arc<Settled>>,
    /// The one that turning a knob has ended.
    left: Option<Arc<Settled>>,
    pub(crate) replay: Option<Replay>,
    /// Whether a passage that repeats is replayed without being asked.
    auto_replay: AutoReplay,
    /// The material point that was chosen, or that a replay began with.
    pub(crate) point: Option<Chosen>,
    pub(crate) tour: Option<TourState>,
    /// Those of the program, and a lecturer's own.
    pub(crate) lessons: Arc<[Arc<Lesson>]>,
    /// The lesson that is chosen in their list.
    pub(crate) lesson: usize,
    /// The panel that the keys speak of.
    pub(crate) focus: PanelKind,
    /// The panel that takes the screen.
    pub(crate) enlarged: Option<PanelKind>,
    /// The lesson's scene that runs; `None`: the user's own.
    staged: Option<Staging>,
    /// The user's own scene and its name, for the end of the tour.
    own: (Arc<Scene>, String),
    /// A scene in the making.
    pub(crate) draft: Option<Draft>,
    pub(crate) estimate: Estimate,
    /// The simulated state from which lives are scaled.
    anchor: Option<Anchor>,
    basis: EstimateBasis,
    /// The contact where the knobs are going, by formula.
    loaded: Loaded,
    past: VecDeque<Arc<Frame>>,
    /// How many frames back from the newest the screen shows.
    back: usize,
    message: Option<(String, Duration)>,
    now: Duration,
    rate: VecDeque<(Duration, u64)>,
    /// The last step that did not converge, and until when it is told.
    trouble: Option<(Trouble, Duration)>,
    /// When each knob was last set from here.
    set_at: Vec<Option<Duration>>,
    /// A fault panel that was read and closed.
    fault_read: bool,
}

impl App {
    /// A screen before the first frame, which offers those errands.
    pub fn new(setup: Setup, errands: Vec<ErrandKind>, theme: Theme) -> Self {
        let dials = dials(&setup.scene, setup.load_n, setup.p_hertz_pa);
        let basis = basis(&setup);
        let start = point_of(&dials);
        let loaded = basis.loaded(&start);
        let estimate = basis.estimate(&loaded, None, &start);
        Self {
            errands,
            theme,
            units: Units::default(),
            pixels: Pixels::default(),
            chosen: 0,
            map: MapKind::default(),
            zoom: Zoom::default(),
            quantity: PointQuantity::default(),
            curve: match setup.scene.life {
                Some(_) => CurveKind::Life,
                None => CurveKind::Friction,
            },
            overlay: Overlay::default(),
            scroll: 0,
            pace: RunPace::default(),
            probe: None,
            pinned: None,
            ghost: None,
            is_frozen: false,
            status: RunStatus::default(),
            scope: None,
            reached: Reached::default(),
            trace: Trace::default(),
            history: VecDeque::new(),
            waves: Kymograph::default(),
            simulated: Vec::new(),
            friction: MeanFriction::default(),
            film: MeanFilm::default(),
            before: None,
            typing: None,
            sweep: None,
            sweeping: Along::default(),
            held: None,
            left: None,
            replay: None,
            auto_replay: AutoReplay::default(),
            point: None,
            tour: None,
            lessons: built_in(),
            lesson: 0,
            focus: PanelKind::default(),
            enlarged: None,
            staged: None,
            own: (Arc::clone(&setup.scene), setup.name.clone()),
            draft: None,
            estimate,
            anchor: None,
            basis,
            loaded,
            past: VecDeque::new(),
            back: 0,
            message: None,
            now: Duration::ZERO,
            rate: VecDeque::new(),
            trouble: None,
            set_at: vec![None; dials.len()],
            fault_read: false,
            dials,
            setup,
        }
    }

    /// The ranges of pictures; none before the first frame.
    pub(crate) fn ranges(&self) -> Ranges {
        self.scope
            .as_ref()
            .map(|scope| scope.ranges)
            .unwrap_or_default()
    }

    /// Says how late it is, counted from the start.
    pub fn tick(&mut self, now: Duration) {
        self.now = now;
        if let Some((_, until)) = &self.message
            && *until < now
        {
            self.message = None;
        }
    }

    /// Takes what the run says of itself.
    pub fn take_status(&mut self, status: RunStatus) {
        self.status = status;
    }

    /// Shows a line for some seconds, a long one for longer.
    pub fn say(&mut self, text: impl Into<String>) {
        /// Letters read in a second, by one who must look for them first.
        const LETTERS: u64 = 15;
        let text = text.into();
        let seconds = 4 + text.chars().count() as u64 / LETTERS;
        self.message = Some((text, self.now + Duration::from_secs(seconds)));
    }

    /// The frame on the screen: the newest, one of the past, or one of the orbit that is replayed.
    pub fn frame(&self) -> Option<&Arc<Frame>> {
        if let Some(replay) = &self.replay {
            return Some(replay.frame());
        }
        let place = self.past.len().checked_sub(1 + self.back)?;
        self.past.get(place)
    }

    /// How many frames back the screen is, and how many there are.
    pub fn rewound(&self) -> (usize, usize) {
        (self.back, self.past.len().saturating_sub(1))
    }

    /// Time steps per second of wall time, over the last two seconds; `None` while the run waits.
    pub fn steps_per_s(&self) -> Option<f64> {
        if self.pace == RunPace::Paused {
            return None;
        }
        let (first, last) = (self.rate.front()?, self.rate.back()?);
        let seconds = last.0.checked_sub(first.0)?.as_secs_f64();
        (seconds > 0.0).then(|| last.1.saturating_sub(first.1) as f64 / seconds)
    }

    /// Where a knob is going, as the screen has it.
    pub fn target(&self, knob: Knob) -> f64 {
        target_of(&self.dials, knob)
    }

    /// The load that the knob is going to, N; of a line N/m.
    pub fn load_n(&self) -> f64 {
        // A scene has a dial for one of the two.
        self.target(Knob::ForceN) + self.target(Knob::ForceNPerM)
    }

    /// How the map is drawn.
    pub fn pixels(&self) -> Pixels {
        self.pixels
    }

    /// Draws the map in another way.
    pub fn set_pixels(&mut self, pixels: Pixels) {
        self.pixels = pixels;
    }

    /// Whether the map is left to the terminal's own pixels: nothing lies over it, and it is in colour.
    pub(crate) fn is_in_pixels(&self) -> bool {
        let covered = self.overlay != Overlay::None || self.fault().is_some();
        self.pixels != Pixels::Blocks && self.theme.paints() && !covered
    }

    /// Whether curves are left to a page, which draws them as lines.
    pub(crate) fn is_in_lines(&self) -> bool {
        self.pixels == Pixels::Page && self.is_in_pixels()
    }

    /// The map that is shown.
    pub fn map(&self) -> MapKind {
        self.map
    }

    /// The line that is being said.
    pub fn message(&self) -> Option<&str> {
        self.message.as_ref().map(|(text, _)| text.as_str())
    }

    /// The fault to show over the screen, unless it was closed.
    pub fn fault(&self) -> Option<&str> {
        match &self.status.health {
            Health::Failed(reason) if !self.fault_read => Some(reason),
            _ => None,
        }
    }

    /// The life that the frame carries.
    pub fn life(&self) -> Option<LifeEstimate> {
        self.frame().and_then(|frame| frame.metrics.life)
    }

    /// The centre line over the way that led to the frame on the screen.
    pub(crate) fn waves(&self) -> Option<Span<'_>> {
        match &self.replay {
            Some(replay) => Some(Span::Orbit(replay)),
            None => self.frame().map(|frame| Span::Run {
                kept: &self.waves,
                passages: frame.passages,
            }),
        }
    }

    /// Whether the program offers an errand.
    pub fn offers(&self, errand: ErrandKind) -> bool {
        self.errands.contains(&errand)
    }
}

/// The operating point that the knobs are going to.
fn point_of(dials: &[Dial]) -> OperatingPoint {
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
