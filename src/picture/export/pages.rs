//! Pictures of chosen steps: the maps of the contact, the stress below it and the classic figure of the
//! centre line. Each has its axes in mm, a colour bar with the unit, the scene's name and the state; colours have
//! the range of all that the scene's script can bring, and of what a knob was turned to so far.

use std::borrow::Cow;

use super::centre_line::centre_line;
use super::history::History;
use super::map::map;
use super::passage;
use super::plotted;
use super::profile::ProfilePage;
use super::sheet::{Heading, PrintSize, Sheet};
use super::tooth_page;
use crate::draw::Drawing;
use crate::plot::Plot;
use crate::{
    Look, NodeAxis, Picture, PointTrace, Ramp, Ranges, ResearchData, ResearchPlot, Scope, Spectra,
    Subject, Window,
};
use asperity_engine::math::number::{GPA, Unit, seconds, tick, trimmed};
use asperity_engine::scene::{ContactKind, Scene};
use asperity_engine::sim::{DamageBlock, Frame};

/// Draws the pictures of a run.
#[derive(Debug, Default)]
pub(super) struct Pictures {
    scene: Option<Scene>,
    scope: Option<Scope>,
    /// Whether its ranges hold for others too.
    is_shared: bool,
    window: Option<Window>,
    trace: PointTrace,
    spectra: Spectra,
    history: History,
    /// The last step, and the band of its life with what the mesh costs.
    last: Option<(u64, [f64; 2])>,
}

impl Pictures {
    /// Pictures of that scene.
    pub(super) fn new(scene: &Scene) -> Self {
        Self {
            scene: Some(scene.clone()),
            scope: None,
            is_shared: false,
            window: None,
            trace: PointTrace::default(),
            spectra: Spectra::default(),
            history: History::default(),
            last: None,
        }
    }

    /// What of the chosen all runs show at these frames of theirs: names and pages. Nothing chosen: all.
    pub(super) fn pages(
        runs: &[Self],
        frames: &[Frame],
        chosen: &[String],
    ) -> Vec<(&'static str, Page)> {
        let is_chosen = |name: &str| chosen.is_empty() || chosen.iter().any(|own| own == name);
        let is_in_all = |page: Page| {
            let mut pairs = runs.iter().zip(frames);
            pairs.all(|(run, frame)| page.is_in(frame) && run.has(page, frame))
        };
        let asked = PAGES.into_iter().filter(|(name, _)| is_chosen(name));
        asked.filter(|(_, page)| is_in_all(*page)).collect()
    }

    /// What an animation shows where nothing was chosen.
    pub(super) const MOVING: &str = "passage";

    /// Names of all pages.
    pub(super) fn names() -> impl Iterator<Item = &'static str> {
        PAGES.into_iter().map(|(name, _)| name)
    }

    /// The ranges that hold at a frame.
    fn ranges(&mut self, frame: &Frame) -> Ranges {
        let scene = self.scene.as_ref();
        let scope = self.scope.get_or_insert_with(|| Scope::of(scene, frame));
        scope.grows(scene, &frame.metrics);
        scope.ranges
    }

    /// The ranges of the run with round ends just above what these frames show.
    pub(super) fn ranges_around(&mut self, shown: &[Frame]) -> Option<Ranges> {
        let ranges = self.ranges(shown.first()?);
        Some(ranges.around(shown))
    }

    /// Takes ranges that hold for others too.
    pub(super) fn share(&mut self, scope: &Scope) {
        self.scope = Some(scope.clone());
        self.is_shared = true;
    }

    /// Ranges of a run that begins with that frame.
    pub(super) fn scope(&self, frame: &Frame) -> Scope {
        Scope::of(self.scene.as_ref(), frame)
    }

    /// Tells the band of the last step.
    pub(super) fn end(&mut self, last: (u64, [f64; 2])) {
        self.last = Some(last);
    }

    /// Takes up a step without fields.
    pub(super) fn pass(&mut self, frame: &Frame) {
        self.trace.follow(frame);
    }

    /// What of a frame pictures show. Every frame comes by here once, in its order.
    pub(super) fn shown(&mut self, frame: &Frame) -> Frame {
        let scene = self.scene.as_ref();
        let around = || Window::around(frame, Scope::of(scene, frame).to_come.size);
        let window = self.window.get_or_insert_with(around);
        self.trace.follow(frame);
        let shown = if window.is_of(frame) {
            window.cut(frame)
        } else {
            frame.clone()
        };
        self.spectra.follow(&shown);
        self.history.follow(&shown);
        shown
    }

    /// A plot with axes around what it holds; two that stand beside each other have those of the run.
    fn research(&self, what: ResearchPlot, frame: &Frame, ranges: &Ranges) -> Option<Plot> {
        let data = ResearchData {
            scene: self.scene.as_ref()?,
            trace: &self.trace,
            spectra: &self.spectra,
            ranges,
            is_shared: self.is_shared,
        };
        let plot = data.plot(what, frame)?;
        Some(if self.is_shared { plot } else { plot.fitted() })
    }

    /// Whether there is something to plot.
    fn has(&self, page: Page, frame: &Frame) -> bool {
        let what = match page {
            Page::Research(what) => what,
            Page::Tooth => {
                let scene = self.scene.as_ref();
                return tooth_page::rides(scene.and_then(|scene| scene.tooth.as_ref()));
            }
            Page::Map(_)
            | Page::CentreLine
            | Page::Profile
            | Page::Passage
            | Page::OverTime(_)
            | Page::LifeOverTime
            | Page::Damage(_) => return true,
        };
        let ranges = match &self.scope {
            Some(scope) => scope.ranges,
            None => self.scope(frame).ranges,
        };
        self.research(what, frame, &ranges).is_some()
    }

    /// The profile in the ranges that were asked for last.
    fn profile<'a>(&self, frame: &'a Frame) -> Option<ProfilePage<'a>> {
        ProfilePage::of(frame, self.scene.as_ref()?, self.scope.as_ref()?)
    }

    /// Draws one picture of what is [shown](Self::shown).
    ///
    /// # Errors
    /// In words, where the frame does not hold it.
    pub(super) fn draw(
        &mut self,
        frame: &Frame,
        page: Page,
        kind: SheetKind,
    ) -> Result<Drawing, String> {
        let ranges = self.ranges(frame);
        let name = self.scene.as_ref().map_or("", |scene| scene.title.as_str());
        let usual = || format!("{name}: {}", page.title());
        let last = self.last.filter(|(step, _)| *step == frame.step);
        let life = passage::life(frame, last.map(|(_, band)| band));
        let life = life.filter(|_| page == Page::Passage);
        let title = life.unwrap_or_else(usual);
        let heading = |state: String| Heading { title, state };
        let sheet = match kind {
            SheetKind::Still => Sheet::still(heading(state(frame))),
            SheetKind::Moving { shared } => Sheet::moving(heading(moving_state(frame)), shared),
            SheetKind::Printed(print, _) => Sheet::printed(&print),
        };
        let own = match kind {
            SheetKind::Printed(_, own) => own.unwrap_or(ranges),
            SheetKind::Still | SheetKind::Moving { .. } => ranges,
        };
        let x_title = page.x_title();
        let drawing = match page {
            Page::CentreLine => Some(centre_line(frame, &own, &sheet, x_title)),
            Page::Profile => {
                let profile = self.profile(frame);
                profile.map(|profile| profile.draw(&sheet, x_title))
            }
            Page::Passage => {
                let profile = self.profile(frame);
                let (trace, top) = (&self.trace, ranges.pressure_pa);
                profile.map(|profile| passage::draw(frame, &profile, trace, top, &sheet, x_title))
            }
            Page::Map(subject) => {
                let picture = Picture::of(frame, subject, &own);
                picture.map(|picture| map(&picture, &sheet, x_title))
            }
            Page::OverTime(subject) => {
                let history = &self.history;
                history.over_time(subject, frame, &ranges, &sheet, x_title)
            }
            Page::LifeOverTime => self.history.life(&sheet),
            Page::Tooth => {
                let scene = self.scene.as_ref();
                scene.and_then(|scene| tooth_page::draw(frame, scene, &sheet, x_title))
            }
            Page::Research(what) => {
                let plot = self.research(what, frame, &ranges);
                plot.map(|plot| plotted::draw(&plot, &sheet))
            }
            Page::Damage(body) => {
                let block = frame.damage[body].as_ref();
                let picture = block.and_then(|block| damage(frame, block));
                picture.map(|picture| map(&picture, &sheet, x_title))
            }
        };
        drawing.ok_or_else(|| "the frame does not hold it".to_owned())
    }
}

/// What a picture is drawn for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum SheetKind {
    /// A screen.
    Still,
    /// A screen, as one of many; whether runs share it.
    Moving { shared: bool },
    /// A paper; the ranges of what stands by itself, where they are not those of the run.
    Printed(PrintSize, Option<Ranges>),
}

/// What is drawn into a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Page {
    /// A picture.
    Map(Subject),
    /// Curves along y = 0.
    CentreLine,
    /// Both surfaces along y = 0 and the oil between them.
    Profile,
    /// The same with what the followed point meets, and the life.
    Passage,
    /// A field along y = 0 against time, up to the step.
    OverTime(Subject),
    /// The life with its band, up to the step.
    LifeOverTime,
    /// What a researcher looks for.
    Research(ResearchPlot),
    /// Where on a gear's tooth the contact is.
    Tooth,
    /// Damage collected by a block of body 1 (0) or 2 (1).
    Damage(usize),
}

/// The pages and the names of their files.
const PAGES: [(&str, Page); 27] = [
    ("pressure", Page::Map(Subject::Pressure)),
    ("film", Page::Map(Subject::Film)),
    ("interferogram", Page::Map(Subject::Interferogram)),
    ("traction", Page::Map(Subject::Traction)),
    ("surface_rise_1", Page::Map(Subject::Surface1)),
    ("surface_rise_2", Page::Map(Subject::Surface2)),
    ("film_rise", Page::Map(Subject::OilRise)),
    ("roughness_1", Page::Map(Subject::Roughness1)),
    ("roughness_2", Page::Map(Subject::Roughness2)),
    ("effective_stress", Page::Map(Subject::EffectiveStress)),
    ("tau_xz", Page::Map(Subject::ShearStress)),
    ("centre_line", Page::CentreLine),
    ("profile", Page::Profile),
    ("passage", Page::Passage),
    ("pressure_over_time", Page::OverTime(Subject::Pressure)),
    ("film_over_time", Page::OverTime(Subject::Film)),
    (
        "surface_rise_1_over_time",
        Page::OverTime(Subject::Surface1),
    ),
    (
        "surface_rise_2_over_time",
        Page::OverTime(Subject::Surface2),
    ),
    ("film_rise_over_time", Page::OverTime(Subject::OilRise)),
    ("life_over_time", Page::LifeOverTime),
    ("tooth", Page::Tooth),
    ("stress_path", Page::Research(ResearchPlot::StressPath)),
    ("sn_point", Page::Research(ResearchPlot::SnPoint)),
    ("spectra", Page::Research(ResearchPlot::Spectra)),
    (
        "amplitude_ratio",
        Page::Research(ResearchPlot::AmplitudeRatio),
    ),
    ("damage_1", Page::Damage(0)),
    ("damage_2", Page::Damage(1)),
];

impl Page {
    fn title(self) -> &'static str {
        match self {
            Self::LifeOverTime => "Relative life, log10, with its band",
            Self::Research(what) => what.title(),
            Self::Tooth => "Where on the tooth the contact is",
            Self::Map(subject) | Self::OverTime(subject) => subject.title(),
            Self::CentreLine => "Pressure and film at y = 0",
            Self::Profile => "Surfaces and what is between them at y = 0",
            Self::Passage => "A point that passes",
            Self::Damage(0) => "Damage of body 1, log10 of the smooth contact's worst",
            Self::Damage(_) => "Damage of body 2, log10 of the smooth contact's worst",
        }
    }

    fn x_title(self) -> &'static str {
        match self {
            Self::Damage(_) => "distance along the surface from a crest, mm",
            Self::LifeOverTime => "time, ms",
            Self::Tooth => "path of contact from A, mm",
            // They have their own.
            Self::Research(_) => "",
            Self::Map(_) | Self::CentreLine | Self::Profile | Self::Passage | Self::OverTime(_) => {
                "x, mm (rolling direction to the right)"
            }
        }
    }

    /// Whether there is something to show. The rows of a line contact are all alike: its centre line tells all.
    fn is_in(self, frame: &Frame) -> bool {
        let subject = match self {
            Self::Map(subject) => subject,
            // Of some what has been, or the scene tells more.
            Self::CentreLine | Self::Profile | Self::Passage | Self::Research(_) | Self::Tooth => {
                return true;
            }
            Self::OverTime(subject) => return subject.field(frame).is_some(),
            Self::LifeOverTime => {
                let life = frame.metrics.life.as_ref();
                return life.is_some_and(|life| life.life_relative_low > 0.0);
            }
            Self::Damage(body) => {
                let block = frame.damage[body].as_ref();
                return block.is_some_and(|block| block.filled > 0);
            }
        };
        let rough = |field: &[f32]| field.iter().any(|&height| height != 0.0);
        let is_seen = match subject {
            Subject::Roughness1 => rough(&frame.roughness_1_m),
            Subject::Roughness2 => rough(&frame.roughness_2_m),
            subject => subject.field(frame).is_some(),
        };
        is_seen && (subject.is_below() || frame.kind == ContactKind::Point)
    }
}

/// Powers of ten of damage above and below the smooth contact's worst point that colours tell apart.
const DECADES: f64 = 3.0;

/// log10 D of a block, depth by depth; what has not crossed yet is no number.
fn damage<'a>(frame: &Frame, block: &'a DamageBlock) -> Option<Picture<'a>> {
    let depths = block.depths_m.len();
    let is_whole = block.columns > 1 && depths > 1 && block.damage.len() == block.columns * depths;
    let mut values = vec![f32::NAN; block.damage.len()];
    for (column, damage) in block.damage.chunks_exact(depths.max(1)).enumerate() {
        if damage.iter().any(|&damage| damage > 0.0) {
            for (row, damage) in damage.iter().enumerate() {
                values[row * block.columns + column] = damage.log10().max(-12.0);
            }
        }
    }
    let look = Look::up_to("D", Unit::new("log10", 1.0), DECADES, Ramp::Magma);
    let step_m = block.length_m / block.columns as f64;
    is_whole.then(|| Picture {
        look: Look {
            range: [-DECADES, DECADES],
            ..look
        },
        values: Cow::Owned(values),
        x: NodeAxis::Even {
            first_m: 0.5 * step_m,
            step_m,
            nodes: block.columns,
        },
        y: NodeAxis::Uneven(&block.depths_m),
        is_below: true,
        contact: &[],
        hertz: (frame.kind, [frame.a_m, frame.b_m]),
    })
}

/// The line below a title.
fn state(frame: &Frame) -> String {
    let unit = match frame.kind {
        ContactKind::Point => "N",
        ContactKind::Line => "N/m",
    };
    let m = &frame.metrics;
    format!(
        "step {}, t = {}, S = {}, U = {} m/s, load {} {unit}, Hertz {}",
        frame.step,
        seconds(frame.time_s),
        tick(m.slide_roll),
        tick(m.entrainment_m_s),
        trimmed(m.load_n, 4),
        GPA.show(frame.p_hertz_pa, 4),
    )
}

/// The same where there is less room.
fn moving_state(frame: &Frame) -> String {
    format!(
        "t = {}, S = {}",
        seconds(frame.time_s),
        tick(frame.metrics.slide_roll),
    )
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "tests")]
    use super::*;
    use asperity_engine::physics::gear::GearTeeth;
    use asperity_engine::plan::Plan;
    use asperity_engine::scene::{Override, Tooth};
    use asperity_engine::sim::Simulation;

    /// A run's first steps and its pictures.
    fn run(preset: &str) -> (Pictures, Frame) {
        let sets = [
            "grid.nodes=65",
            "heat.bulk_k=360",
            "heat.thermal_conductivity_w_mk=0.14",
        ];
        let sets: Vec<Override> = sets.iter().map(|set| set.parse().unwrap()).collect();
        let mut scene = Scene::load_with(preset, &sets).unwrap();
        if scene.kind() == ContactKind::Line {
            // With the page of a ride along it.
            let gears = GearTeeth {
                teeth: [16, 24],
                module_m: 4.5e-3,
                pressure_angle_rad: 20_f64.to_radians(),
                centre_distance_m: 91.5e-3,
                tip_diameters_m: [82.46e-3, 118.36e-3],
            };
            scene.tooth = Some(Tooth::of(&gears, 100.0));
        }
        let mut simulation = Simulation::new(&scene, Plan::new(&scene).unwrap(), 1).unwrap();
        let (mut pictures, mut frame) = (Pictures::new(&scene), Frame::default());
        let mut shown = Frame::default();
        while simulation.passage_steps() < 40 {
            simulation.step().unwrap();
            simulation.fill(&mut frame);
            if simulation.passage_steps() > 0 {
                shown = pictures.shown(&frame);
            }
        }
        (pictures, shown)
    }

    #[test]
    fn no_word_is_cut_off_or_faint_or_upon_another() {
        let print = |width_mm| {
            let size = PrintSize {
                width_mm,
                ..PrintSize::default()
            };
            SheetKind::Printed(size, None)
        };
        let kinds = [
            SheetKind::Still,
            SheetKind::Moving { shared: false },
            print(85.0),
            print(170.0),
        ];
        let mut drawn = 0;
        for preset in ["demonstration", "fzg_point_a"] {
            let (mut pictures, shown) = run(preset);
            let runs = std::slice::from_ref(&pictures);
            let pages = Pictures::pages(runs, std::slice::from_ref(&shown), &[]);
            for (name, page) in pages {
                for kind in kinds {
                    let drawing = pictures.draw(&shown, page, kind).unwrap();
                    let cut = drawing.cut_off();
                    assert!(cut.is_empty(), "{preset}, {name}, {kind:?}: {cut:?}");
                    let upon = drawing.upon_each_other();
                    assert!(upon.is_empty(), "{preset}, {name}, {kind:?}: {upon:?}");
                    let faint = drawing.faint(4.5);
                    assert!(faint.is_empty(), "{preset}, {name}, {kind:?}: {faint:?}");
                    drawn += 1;
                }
            }
        }
        assert!(drawn > 100, "{drawn}");
    }
}
