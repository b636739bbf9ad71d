//! Pictures of chosen steps as PNG: the maps of the contact, the stress below it and the classic figure of the
//! centre line. Each has its axes in mm, a colour bar with the unit, the scene's name and the state; colours have
//! the range of all that the scene's script can bring, and of what a knob was turned to so far.

use std::path::{Path, PathBuf};

use super::drawing::{Drawing, DrawnCurve, ExportedFigure, Right};
use crate::math::number::{GPA, MM, UM, plain};
use crate::picture::{Picture, Ranges, Scope, Subject};
use crate::scene::{ContactKind, Scene};
use crate::sim::Frame;

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

    /// A frame's pictures and their files.
    pub(super) fn files(frame: &Frame, folder: &Path) -> Vec<(Page, PathBuf)> {
        let shown = PAGES.into_iter().filter(|(_, page)| page.is_in(frame));
        let file = |name: &str| folder.join(format!("step_{:06}_{name}.png", frame.step));
        shown.map(|(name, page)| (page, file(name))).collect()
    }

    /// Whether `_pressure.png` and so on stands behind the number of a step.
    pub(super) fn are_named(what: &str) -> bool {
        let name = what
            .strip_prefix('_')
            .and_then(|what| what.strip_suffix(".png"));
        name.is_some_and(|name| PAGES.iter().any(|(page, _)| *page == name))
    }

    /// Draws one picture.
    ///
    /// # Errors
    /// What went wrong, in words.
    pub(super) fn draw(&mut self, frame: &Frame, page: Page, file: &Path) -> Result<(), String> {
        let scene = self.scene.as_ref();
        let scope = self.scope.get_or_insert_with(|| Scope::of(scene, frame));
        scope.grows(scene, &frame.metrics);
        let name = scene.map_or("", |scene| scene.title.as_str());
        let drawing = Drawing {
            file,
            title: format!("{name}: {}", page.title()),
            state: state(frame),
        };
        match page {
            Page::CentreLine => drawing.figure(&centre_line(frame, scope.ranges)),
            Page::Map(subject) => match Picture::of(frame, subject, &scope.ranges) {
                Some(picture) => drawing.map(&picture),
                None => Ok(()),
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
}

/// The pages and the names of their files.
const PAGES: [(&str, Page); 9] = [
    ("pressure", Page::Map(Subject::Pressure)),
    ("film", Page::Map(Subject::Film)),
    ("interferogram", Page::Map(Subject::Interferogram)),
    ("traction", Page::Map(Subject::Traction)),
    ("roughness_1", Page::Map(Subject::Roughness1)),
    ("roughness_2", Page::Map(Subject::Roughness2)),
    ("effective_stress", Page::Map(Subject::EffectiveStress)),
    ("tau_xz", Page::Map(Subject::ShearStress)),
    ("centre_line", Page::CentreLine),
];

impl Page {
    fn title(self) -> &'static str {
        match self {
            Self::Map(subject) => subject.title(),
            Self::CentreLine => "Pressure and film at y = 0",
        }
    }

    /// Whether there is something to show. The rows of a line contact are all alike: its centre line tells all.
    fn is_in(self, frame: &Frame) -> bool {
        let Self::Map(subject) = self else {
            return true;
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
