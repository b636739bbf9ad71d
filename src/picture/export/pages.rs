//! Pictures of chosen steps: the maps of the contact, the stress below it and the classic figure of the
//! centre line. Each has its axes in mm, a colour bar with the unit, the scene's name and the state; colours have
//! the range of all that the scene's script can bring, and of what a knob was turned to so far.

use std::borrow::Cow;

use super::drawing::{Drawing, DrawnCurve, ExportedFigure, PictureTarget, Right};
use super::paper::{Paper, PrintSize};
use super::profile::ProfilePage;
use crate::{Look, NodeAxis, Picture, Ramp, Ranges, Scope, Subject};
use asperity_engine::math::number::{GPA, MM, UM, Unit, plain};
use asperity_engine::scene::{ContactKind, Scene};
use asperity_engine::sim::{DamageBlock, Frame};

/// Draws the pictures of a run.
#[derive(Debug, Default)]
pub(super) struct Pictures {
    scene: Option<Scene>,
    scope: Option<Scope>,
}

impl Pictures {
    /// Pictures of that scene.
    pub(super) fn new(scene: &Scene) -> Self {
        Self {
            scene: Some(scene.clone()),
            scope: None,
        }
    }

    /// What of the chosen a frame shows: names and pages. Nothing chosen: all.
    pub(super) fn pages(frame: &Frame, chosen: &[String]) -> Vec<(&'static str, Page)> {
        let is_chosen = |name: &str| chosen.is_empty() || chosen.iter().any(|own| own == name);
        let shown = PAGES.into_iter().filter(|(_, page)| page.is_in(frame));
        shown.filter(|(name, _)| is_chosen(name)).collect()
    }

    /// What an animation shows where nothing was chosen.
    pub(super) fn moving(frame: &Frame) -> &'static str {
        match frame.kind {
            ContactKind::Point => "pressure",
            ContactKind::Line => "centre_line",
        }
    }

    /// Names of all pages.
    pub(super) fn names() -> impl Iterator<Item = &'static str> {
        PAGES.into_iter().map(|(name, _)| name)
    }

    /// Whether `_pressure.png` and so on stands behind the number of a step.
    pub(super) fn are_named(what: &str) -> bool {
        let Some((name, ending)) = what.strip_prefix('_').and_then(|what| what.split_once('.'))
        else {
            return false;
        };
        ["png", "svg", "pdf"].contains(&ending) && Self::names().any(|page| page == name)
    }

    /// Whether it is `pressure.gif` and so on.
    pub(super) fn is_moving(name: &str) -> bool {
        let parts = name.split_once('.');
        parts.is_some_and(|(name, ending)| {
            ["gif", "apng"].contains(&ending) && Self::names().any(|page| page == name)
        })
    }

    /// The ranges that hold at a frame.
    fn ranges(&mut self, frame: &Frame) -> Ranges {
        let scene = self.scene.as_ref();
        let scope = self.scope.get_or_insert_with(|| Scope::of(scene, frame));
        scope.grows(scene, &frame.metrics);
        scope.ranges
    }

    /// The profile in the ranges that were asked for last.
    fn profile<'a>(&self, frame: &'a Frame) -> Option<ProfilePage<'a>> {
        ProfilePage::of(frame, self.scene.as_ref()?, self.scope.as_ref()?)
    }

    /// Draws one picture as papers print it; the bytes of an SVG or a PDF.
    ///
    /// # Errors
    /// What went wrong, in words.
    pub(super) fn print(
        &mut self,
        frame: &Frame,
        page: Page,
        (print, as_pdf): (&PrintSize, bool),
    ) -> Result<Vec<u8>, String> {
        let ranges = self.ranges(frame);
        let paper = match page {
            Page::CentreLine => Paper::figure(&centre_line(frame, ranges), print),
            Page::Profile => match self.profile(frame) {
                Some(profile) => profile.print(print, page.x_title()),
                None => return Err("the frame does not hold it".to_owned()),
            },
            _ => match page.picture(frame, &ranges) {
                Some(picture) => Paper::map(&picture, print, page.x_title()),
                None => return Err("the frame does not hold it".to_owned()),
            },
        };
        if as_pdf {
            paper.pdf()
        } else {
            paper.svg().map(String::into_bytes)
        }
    }

    /// Draws one picture.
    ///
    /// # Errors
    /// What went wrong, in words.
    pub(super) fn draw(
        &mut self,
        frame: &Frame,
        page: Page,
        canvas: PictureTarget,
    ) -> Result<(u32, u32), String> {
        let ranges = self.ranges(frame);
        let name = self.scene.as_ref().map_or("", |scene| scene.title.as_str());
        let drawing = Drawing {
            title: format!("{name}: {}", page.title()),
            state: match canvas {
                PictureTarget::Still(_) => state(frame),
                // Half as wide.
                PictureTarget::Moving(_) => moving_state(frame),
            },
            x_title: page.x_title(),
        };
        match page {
            Page::CentreLine => drawing.figure(&centre_line(frame, ranges), canvas),
            Page::Profile => match self.profile(frame) {
                Some(profile) => profile.draw(&drawing, canvas),
                None => Err("the frame does not hold it".to_owned()),
            },
            _ => match page.picture(frame, &ranges) {
                Some(picture) => drawing.map(&picture, canvas),
                None => Err("the frame does not hold it".to_owned()),
            },
        }
    }
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
    /// Damage collected by a block of body 1 (0) or 2 (1).
    Damage(usize),
}

/// The pages and the names of their files.
const PAGES: [(&str, Page); 12] = [
    ("pressure", Page::Map(Subject::Pressure)),
    ("film", Page::Map(Subject::Film)),
    ("interferogram", Page::Map(Subject::Interferogram)),
    ("traction", Page::Map(Subject::Traction)),
    ("roughness_1", Page::Map(Subject::Roughness1)),
    ("roughness_2", Page::Map(Subject::Roughness2)),
    ("effective_stress", Page::Map(Subject::EffectiveStress)),
    ("tau_xz", Page::Map(Subject::ShearStress)),
    ("centre_line", Page::CentreLine),
    ("profile", Page::Profile),
    ("damage_1", Page::Damage(0)),
    ("damage_2", Page::Damage(1)),
];

impl Page {
    fn title(self) -> &'static str {
        match self {
            Self::Map(subject) => subject.title(),
            Self::CentreLine => "Pressure and film at y = 0",
            Self::Profile => "Surfaces and oil at y = 0",
            Self::Damage(0) => "Damage of body 1, log10 of the smooth contact's worst",
            Self::Damage(_) => "Damage of body 2, log10 of the smooth contact's worst",
        }
    }

    fn x_title(self) -> &'static str {
        match self {
            Self::Damage(_) => "distance along the surface from a crest, mm",
            Self::Map(_) | Self::CentreLine | Self::Profile => {
                "x, mm (rolling direction to the right)"
            }
        }
    }

    /// Its field; `None`: it has none, or the frame does not hold it.
    fn picture<'a>(self, frame: &'a Frame, ranges: &Ranges) -> Option<Picture<'a>> {
        match self {
            Self::Map(subject) => Picture::of(frame, subject, ranges),
            Self::Damage(body) => damage(frame, frame.damage[body].as_ref()?),
            Self::CentreLine | Self::Profile => None,
        }
    }

    /// Whether there is something to show. The rows of a line contact are all alike: its centre line tells all.
    fn is_in(self, frame: &Frame) -> bool {
        let subject = match self {
            Self::Map(subject) => subject,
            Self::CentreLine | Self::Profile => return true,
            Self::Damage(body) => {
                let block = frame.damage[body].as_ref();
                return block.is_some_and(|block| block.filled > 0);
            }
        };
        let rough = |field: &[f32]| field.iter().any(|&height| height != 0.0);
        let is_seen = match subject {
            Subject::Roughness1 => rough(&frame.roughness_1_m),
            Subject::Roughness2 => rough(&frame.roughness_2_m),
            subject => !subject.is_below() || frame.slice.is_some(),
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
        "step {}, t = {:.3} ms, S = {}, U = {} m/s, load {} {unit}, Hertz {:.3} GPa",
        frame.step,
        frame.time_s * 1e3,
        plain(m.slide_roll),
        plain(m.entrainment_m_s),
        plain(m.load_n),
        GPA.of(frame.p_hertz_pa),
    )
}

/// The same where there is less room.
fn moving_state(frame: &Frame) -> String {
    format!(
        "t = {:.3} ms, S = {}",
        frame.time_s * 1e3,
        plain(frame.metrics.slide_roll),
    )
}

/// Pressure with Hertz's behind it, and the film, along y = 0.
fn centre_line(frame: &Frame, ranges: Ranges) -> ExportedFigure {
    let nx = frame.nx;
    let row = (frame.ny / 2) * nx..(frame.ny / 2 + 1) * nx;
    let x = |i: usize| (frame.x_min_m + frame.dx_m * i as f64) * MM;
    let along = |field: &[f32], per_si: f64| -> Vec<(f64, f64)> {
        let values = field[row.clone()].iter().enumerate();
        values
            .map(|(i, &value)| (x(i), f64::from(value) * per_si))
            .collect()
    };
    let hertz = (0..=200).map(|k| {
        let t = -1.0 + f64::from(k) / 100.0;
        let share = (1.0 - t * t).max(0.0).sqrt();
        (t * frame.a_m * MM, share * GPA.of(frame.p_hertz_pa))
    });
    ExportedFigure {
        x: [x(0), x(nx - 1)],
        left_top: GPA.of(ranges.pressure_pa),
        left_title: "pressure, GPa".to_owned(),
        left: vec![
            DrawnCurve {
                name: "Hertz pressure",
                colour: [150, 155, 165],
                points: hertz.collect(),
            },
            DrawnCurve {
                name: "pressure",
                colour: [213, 94, 0],
                points: along(&frame.pressure_pa, GPA.per_si),
            },
        ],
        right: Right {
            top: UM.of(ranges.film_m),
            title: "film, µm".to_owned(),
            curve: DrawnCurve {
                name: "film (right axis)",
                colour: [0, 114, 178],
                points: along(&frame.film_m, UM.per_si),
            },
        },
    }
}
