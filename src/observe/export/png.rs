//! Pictures of chosen steps as PNG: the maps of the contact, the stress below it and the classic figure of the
//! centre line. Each has its axes in mm, a colour bar with the unit, the scene's name and the state; colours have
//! the range of all that the scene's script can bring, and of what a knob was turned to so far.

use std::path::{Path, PathBuf};

use super::drawing::{Curve, Drawing, Figure, Map, Right};
use crate::observe::ramp::Ramp;
use crate::observe::scales::{GPA, MM, MPA, Ranges, Scope, UM, number};
use crate::scene::{ContactKind, Scene};
use crate::sim::{Frame, StressSlice};

/// Rows of a slice's picture.
const SLICE_ROWS: usize = 192;

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
    pub(super) fn files(frame: &Frame, folder: &Path) -> Vec<(Subject, PathBuf)> {
        let file = |subject: Subject| {
            let name = format!("step_{:06}_{}.png", frame.step, subject.name());
            (subject, folder.join(name))
        };
        let shown = Subject::ALL
            .into_iter()
            .filter(|subject| subject.is_in(frame));
        shown.map(file).collect()
    }

    /// Whether `_pressure.png` and so on stands behind the number of a step.
    pub(super) fn are_named(what: &str) -> bool {
        let name = what
            .strip_prefix('_')
            .and_then(|what| what.strip_suffix(".png"));
        name.is_some_and(|name| Subject::ALL.iter().any(|subject| subject.name() == name))
    }

    /// Draws one picture.
    ///
    /// # Errors
    /// What went wrong, in words.
    pub(super) fn draw(
        &mut self,
        frame: &Frame,
        subject: Subject,
        file: &Path,
    ) -> Result<(), String> {
        let scene = self.scene.as_ref();
        let scope = self.scope.get_or_insert_with(|| Scope::of(scene, frame));
        scope.grows(scene, &frame.metrics);
        let ranges = scope.ranges;
        let name = scene.map_or("", |scene| scene.title.as_str());
        let drawing = Drawing {
            file,
            title: format!("{name}: {}", subject.title()),
            state: state(frame),
        };
        match subject {
            Subject::CentreLine => drawing.figure(&centre_line(frame, ranges)),
            Subject::EffectiveStress | Subject::ShearStress => match &frame.slice {
                Some(slice) => drawing.map(&slice_map(frame, slice, subject, ranges)),
                None => Ok(()),
            },
            _ => drawing.map(&surface_map(frame, subject, ranges)),
        }
    }
}

/// What a picture shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Subject {
    Pressure,
    Film,
    Traction,
    /// Of body 1 or 2.
    Roughness(u8),
    EffectiveStress,
    ShearStress,
    CentreLine,
}

impl Subject {
    const ALL: [Self; 8] = [
        Self::Pressure,
        Self::Film,
        Self::Traction,
        Self::Roughness(1),
        Self::Roughness(2),
        Self::EffectiveStress,
        Self::ShearStress,
        Self::CentreLine,
    ];

    fn name(self) -> &'static str {
        match self {
            Self::Pressure => "pressure",
            Self::Film => "film",
            Self::Traction => "traction",
            Self::Roughness(1) => "roughness_1",
            Self::Roughness(_) => "roughness_2",
            Self::EffectiveStress => "effective_stress",
            Self::ShearStress => "tau_xz",
            Self::CentreLine => "centre_line",
        }
    }

    fn title(self) -> &'static str {
        match self {
            Self::Pressure => "pressure",
            Self::Film => "film (cyan: contact, grey: above the range)",
            Self::Traction => "shear traction on body 1",
            Self::Roughness(1) => "roughness of body 1",
            Self::Roughness(_) => "roughness of body 2",
            Self::EffectiveStress => "effective stress of body 1 at y = 0",
            Self::ShearStress => "orthogonal shear of body 1 at y = 0",
            Self::CentreLine => "pressure and film at y = 0",
        }
    }

    /// Whether there is something to show. The rows of a line contact are all alike: its centre line tells all.
    fn is_in(self, frame: &Frame) -> bool {
        let is_point = frame.kind == ContactKind::Point;
        let rough = |field: &[f32]| field.iter().any(|&height| height != 0.0);
        match self {
            Self::CentreLine => true,
            Self::EffectiveStress | Self::ShearStress => frame.slice.is_some(),
            Self::Roughness(1) => is_point && rough(&frame.roughness_1_m),
            Self::Roughness(_) => is_point && rough(&frame.roughness_2_m),
            Self::Pressure | Self::Film | Self::Traction => is_point,
        }
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
        number(m.slide_roll),
        number(m.entrainment_m_s),
        number(m.load_n),
        frame.p_hertz_pa * GPA.1,
    )
}

/// A map of the surface, y upwards.
fn surface_map(frame: &Frame, subject: Subject, ranges: Ranges) -> Map {
    let (field, unit, top, ramp, symbol) = match subject {
        Subject::Pressure => (
            &frame.pressure_pa,
            GPA,
            ranges.pressure_pa,
            Ramp::Inferno,
            "p",
        ),
        Subject::Film => (&frame.film_m, UM, ranges.film_m, Ramp::Viridis, "h"),
        Subject::Traction => (
            &frame.traction_pa,
            MPA,
            ranges.traction_pa,
            Ramp::Diverging,
            "shear",
        ),
        Subject::Roughness(1) => (
            &frame.roughness_1_m,
            UM,
            ranges.roughness_m,
            Ramp::Diverging,
            "height",
        ),
        _ => (
            &frame.roughness_2_m,
            UM,
            ranges.roughness_m,
            Ramp::Diverging,
            "height",
        ),
    };
    let (nx, ny) = (frame.nx, frame.ny);
    // From the greatest y down.
    let rows = (0..ny).rev();
    let values = rows
        .clone()
        .flat_map(|j| field[j * nx..(j + 1) * nx].iter())
        .map(|value| value * unit.1 as f32)
        .collect();
    let marks = if subject == Subject::Film {
        let contact = &frame.contact;
        rows.flat_map(|j| contact[j * nx..(j + 1) * nx].iter().map(|&at| at > 0))
            .collect()
    } else {
        Vec::new()
    };
    let (x, y) = (frame.x_min_m * MM, frame.y_min_m * MM);
    Map {
        columns: nx,
        values,
        marks,
        x: [x, x + frame.dx_m * MM * (nx - 1) as f64],
        y: [y, y + frame.dy_m * MM * (ny - 1) as f64],
        top: top * unit.1,
        ramp,
        bar: format!("{symbol}, {}", unit.0),
        y_title: "y, mm".to_owned(),
        ellipse: Some([frame.a_m * MM, frame.b_m * MM]),
        grey_above: subject == Subject::Film,
    }
}

/// A map of the plane y = 0, depth downwards, on rows of equal height.
fn slice_map(frame: &Frame, slice: &StressSlice, subject: Subject, ranges: Ranges) -> Map {
    let (field, top, ramp, symbol) = if subject == Subject::EffectiveStress {
        (
            &slice.effective_pa,
            ranges.effective_pa,
            Ramp::Magma,
            "σ_eff",
        )
    } else {
        (&slice.tau_xz_pa, ranges.shear_pa, Ramp::Diverging, "τxz")
    };
    let depths = &slice.depths_m;
    let (first, last) = (
        depths.first().copied().unwrap_or(0.0),
        depths.last().copied().unwrap_or(1.0),
    );
    let nx = frame.nx;
    let values = (0..SLICE_ROWS)
        .flat_map(|row| {
            let depth = first + (last - first) * row as f64 / (SLICE_ROWS - 1) as f64;
            let below = depths
                .partition_point(|&z| z < depth)
                .clamp(1, depths.len().max(2) - 1);
            let (above, span) = (below - 1, depths[below] - depths[below - 1]);
            let weight = ((depth - depths[above]) / span).clamp(0.0, 1.0) as f32;
            let at = move |k: usize, i: usize| field[k * nx + i];
            (0..nx).map(move |i| at(above, i) * (1.0 - weight) + at(below, i) * weight)
        })
        .map(|value| value * GPA.1 as f32)
        .collect();
    let x = frame.x_min_m * MM;
    Map {
        columns: nx,
        values,
        marks: Vec::new(),
        x: [x, x + frame.dx_m * MM * (nx - 1) as f64],
        y: [-last * MM, -first * MM],
        top: top * GPA.1,
        ramp,
        bar: format!("{symbol}, GPa"),
        y_title: "depth z, mm".to_owned(),
        ellipse: None,
        grey_above: false,
    }
}

/// Pressure with Hertz's behind it, and the film, along y = 0.
fn centre_line(frame: &Frame, ranges: Ranges) -> Figure {
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
        (t * frame.a_m * MM, share * frame.p_hertz_pa * GPA.1)
    });
    Figure {
        x: [x(0), x(nx - 1)],
        left_top: ranges.pressure_pa * GPA.1,
        left_title: "pressure, GPa".to_owned(),
        left: vec![
            Curve {
                name: "Hertz pressure",
                colour: [150, 155, 165],
                points: hertz.collect(),
            },
            Curve {
                name: "pressure",
                colour: [213, 94, 0],
                points: along(&frame.pressure_pa, GPA.1),
            },
        ],
        right: Right {
            top: ranges.film_m * UM.1,
            title: "film, µm".to_owned(),
            curve: Curve {
                name: "film (right axis)",
                colour: [0, 114, 178],
                points: along(&frame.film_m, UM.1),
            },
        },
    }
}
