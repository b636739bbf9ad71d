//! What of the 3-D view never changes: where its parts are, triangles, smooth bodies, the cut, legends, labels.

use rerun::{AlbedoFactor, Color, LineStrips3D, Mesh3D, Points3D, Radius, Rgba32};

use crate::colour::{GREY, Ramp, WHITE, faded};
use crate::depths::Depths;
use crate::entities::space::{BODIES, FILM, LEGEND, POINT, SLICE, SPACE, SPOTS, UPPER_LABELS};
use crate::geometry::Geometry;
use crate::mesh::{COARSE, FINE, MeshWindow, triangles};
use crate::stream::{Holds, Stream};
use asperity_engine::math::number::{GPA, MM, fixed, plain, ticks};
use asperity_engine::sim::{Frame, StressSlice};
use asperity_picture::CONTACT;

/// Depth of the stress that is shown, in a.
const SLICE_DEPTH: f64 = 1.1;

/// Ranges that the 3-D view shares with the maps.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tops {
    pub(crate) pressure_pa: f64,
    pub(crate) effective_pa: Option<f64>,
    /// Which bodies are rough.
    pub(crate) rough: [bool; 2],
    /// Height of both together that can come, m.
    pub(crate) roughness_m: f64,
    /// Times that heights are drawn too high, where that is decided already.
    pub(crate) exaggeration: Option<f64>,
}

/// Where the sheets' zero heights are drawn, mm.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Levels {
    pub(crate) body_2: f64,
    pub(crate) body_1: f64,
    pub(crate) slice: f64,
    pub(crate) damage: f64,
    /// The film is cut off at this height.
    pub(crate) film_cap: f64,
}

/// The cut plane's nodes.
pub(crate) struct SliceSheet {
    pub(crate) depths: Depths,
    pub(crate) columns: Vec<usize>,
}

impl SliceSheet {
    /// Of fewer columns than the slice's image: the 3-D view is for looking, the image for reading.
    fn new(g: Geometry, slice: &StressSlice) -> Option<Self> {
        let columns: Vec<usize> = (0..g.nx).filter(|&i| g.x(i).abs() <= 1.45 * g.a).collect();
        let step = columns.len().div_ceil(64).max(1);
        let columns: Vec<usize> = columns.into_iter().step_by(step).collect();
        let depths = Depths::down_to(&slice.depths_m, SLICE_DEPTH * g.a / MM)?;
        (columns.len() > 1).then_some(Self { depths, columns })
    }

    fn deepest_mm(&self) -> f64 {
        self.depths
            .shown_m()
            .last()
            .map_or(0.0, |depth_m| depth_m * MM)
    }

    fn edges(&self, g: Geometry) -> (f64, f64) {
        let end = |i: Option<&usize>| i.map_or(0.0, |&i| g.x(i));
        (end(self.columns.first()), end(self.columns.last()))
    }
}

/// A colour bar.
struct ColourBar {
    name: &'static str,
    title: &'static str,
    ramp: Ramp,
    top_pa: f64,
    /// Its lower and upper end.
    ends: [f64; 2],
}

/// The parts of the view.
pub(crate) struct Parts {
    pub(crate) geometry: Geometry,
    pub(crate) film: MeshWindow,
    pub(crate) bodies: MeshWindow,
    pub(crate) slice: Option<SliceSheet>,
    pub(crate) tops: Tops,
    /// Times that heights are drawn too high.
    pub(crate) exaggeration: f64,
    pub(crate) levels: Levels,
}

impl Parts {
    /// Of a run with that first frame; `None` for grids too coarse to show.
    pub(crate) fn new(geometry: Geometry, first: &Frame, tops: Tops) -> Option<Self> {
        let reach = [1.45 * geometry.a, 1.25 * geometry.b];
        let a = geometry.a;
        let slice = first.slice.as_ref();
        let usual = || exaggeration(geometry, first, tops.roughness_m);
        Some(Self {
            geometry,
            film: MeshWindow::new(geometry, reach, FINE)?,
            bodies: MeshWindow::new(geometry, reach, COARSE)?,
            slice: slice.and_then(|slice| SliceSheet::new(geometry, slice)),
            tops,
            exaggeration: tops.exaggeration.unwrap_or_else(usual),
            levels: Levels {
                body_2: 0.95 * a,
                body_1: -0.32 * a,
                slice: -0.5 * a,
                damage: -(0.62 + SLICE_DEPTH) * a,
                film_cap: 0.6 * a,
            },
        })
    }

    /// Words about the heights.
    pub(crate) fn note(&self) -> String {
        format!(
            "In the 3-D view heights of film and roughness are drawn {} times too high against \
             lengths and depths, the film is cut off at {} µm, and the bodies are drawn apart. \
             The film is grey-blue where it carries less than 6 % of the colour range.",
            plain(self.exaggeration),
            fixed(1e3 * self.levels.film_cap / self.exaggeration, 2)
        )
    }

    /// A point to look at and one to look from.
    pub(crate) fn camera(&self) -> [[f64; 3]; 2] {
        let a = self.geometry.a;
        let target = [0.16 * a, 0.2 * a, -0.5 * a];
        [target, [-1.15 * a, -3.3 * a, 1.55 * a]]
    }

    /// Same for an audience: from above, so that the pressure on the film is seen and the stress below it, too.
    pub(crate) fn lecture_camera(&self) -> [[f64; 3]; 2] {
        let a = self.geometry.a;
        let target = [0.3 * a, 0.25 * a, -0.6 * a];
        [target, [-0.1 * a, -2.83 * a, 2.48 * a]]
    }

    pub(crate) fn log_static(&self, stream: &Stream) {
        let sheet = |name: &'static str, window: &MeshWindow, colour: [u8; 4]| {
            let albedo = AlbedoFactor::from(Rgba32::from_unmultiplied_rgba(
                colour[0], colour[1], colour[2], colour[3],
            ));
            let mesh = Mesh3D::update_fields()
                .with_triangle_indices(window.triangles())
                .with_albedo_factor(albedo);
            stream.log_static(name, &mesh);
        };
        sheet(FILM, &self.film, [255, 255, 255, 255]);
        sheet(BODIES[0], &self.bodies, [200, 222, 245, 255]);
        sheet(BODIES[1], &self.bodies, [250, 222, 190, 150]);
        self.log_smooth_bodies(stream);
        self.log_dots(stream);
        self.log_cut(stream);
        for bar in self.colour_bars() {
            self.log_bar(stream, &bar);
        }
        self.log_tops(stream);
        self.log_labels(stream);
    }

    /// How contact spots and the followed point look.
    fn log_dots(&self, stream: &Stream) {
        let spots = Points3D::update_fields()
            .with_radii([Radius::new_scene_units((0.55 * self.geometry.dx) as f32)])
            .with_colors([Color::from(CONTACT)]);
        stream.log_static(SPOTS, &spots);
        let point = Points3D::update_fields()
            .with_radii([0.075, 0.055, 0.0].map(|r| (r * self.geometry.a) as f32))
            .with_show_labels(true);
        stream.log_static(POINT, &point);
    }

    /// The sheets of smooth bodies never change.
    fn log_smooth_bodies(&self, stream: &Stream) {
        for (body, level) in [self.levels.body_1, self.levels.body_2]
            .into_iter()
            .enumerate()
        {
            if !self.tops.rough[body] {
                let places = self.bodies.xy().iter();
                let sheet = Mesh3D::update_fields()
                    .with_vertex_positions(places.map(|&[x, y]| [x, y, level as f32]))
                    .with_vertex_colors(vec![steel(1.0); self.bodies.nodes().len()]);
                stream.log_static(BODIES[body], &sheet);
            }
        }
    }

    /// The cut plane: its mesh, its outline and its depths.
    fn log_cut(&self, stream: &Stream) {
        let Some(sheet) = &self.slice else {
            return;
        };
        let g = self.geometry;
        let level = self.levels.slice;
        let positions = sheet.depths.shown_m().iter().flat_map(|depth_m| {
            let z = (level - depth_m * MM) as f32;
            let xs = sheet.columns.iter().map(move |&i| g.x(i) as f32);
            xs.map(move |x| [x, 0.0, z])
        });
        let mesh = Mesh3D::new(positions)
            .with_triangle_indices(triangles(sheet.columns.len(), sheet.depths.len()));
        stream.log_static(
            SLICE,
            // Colours come with every frame: static ones would hide them.
            &Mesh3D {
                vertex_colors: None,
                ..mesh
            },
        );
        let (left, right) = sheet.edges(g);
        let bottom = level - sheet.deepest_mm();
        let edge = [
            [left, level],
            [right, level],
            [right, bottom],
            [left, bottom],
            [left, level],
        ];
        let outline = LineStrips3D::new([edge.map(|[x, z]| [x as f32, 0.0, z as f32])])
            .with_radii([Radius::new_ui_points(0.75)])
            .with_colors([faded(GREY, 255)]);
        stream.log_static(format!("{SPACE}/cut/outline"), &outline);
        let mut depths = ticks(0.0, level - bottom, 3);
        // The surface needs no number, and its place is taken by the arrow.
        depths.retain(|&z| z > 0.0);
        let at = depths.iter().map(|z| [left - 0.1 * g.a, 0.0, level - z]);
        let labels = labels(at, depths.iter().map(|&z| format!("{} mm", plain(z))));
        stream.log_static(format!("{SPACE}/cut/depths"), &labels);
    }

    /// Colour bars of pressure and stress at the right of the bodies.
    fn colour_bars(&self) -> impl Iterator<Item = ColourBar> {
        let a = self.geometry.a;
        let bottom = self.levels.slice - 1.1 * a;
        let pressure = ColourBar {
            name: "pressure",
            title: "p, GPa",
            ramp: Ramp::Inferno,
            top_pa: self.tops.pressure_pa,
            ends: [-0.1 * a, 0.85 * a],
        };
        let stress = self.tops.effective_pa.map(|top_pa| ColourBar {
            name: "effective_stress",
            title: "σ_eff, GPa",
            ramp: Ramp::Magma,
            top_pa,
            ends: [bottom - 0.15 * a, bottom + 0.75 * a],
        });
        std::iter::once(pressure).chain(stress)
    }

    /// Left and right edge of the colour bars.
    fn bar_edges(&self) -> [f64; 2] {
        [1.9, 2.0].map(|x| x * self.geometry.a)
    }

    fn log_bar(&self, stream: &Stream, bar: &ColourBar) {
        const ROWS: usize = 33;
        let [low, high] = bar.ends;
        let share = |row: usize| row as f64 / (ROWS - 1) as f64;
        let positions = (0..ROWS).flat_map(|row| {
            let z = low + (high - low) * share(row);
            self.bar_edges().map(|x| [x as f32, 0.0, z as f32])
        });
        let colours = (0..ROWS).flat_map(|row| [bar.ramp.colour(share(row) as f32, 1.0); 2]);
        let mesh = Mesh3D::new(positions)
            .with_triangle_indices(triangles(2, ROWS))
            .with_vertex_colors(colours);
        stream.log_static(format!("{LEGEND}/{}", bar.name), &mesh);
    }

    /// The numbers beside the colour bars, from now on.
    pub(crate) fn log_tops(&self, stream: &Stream) {
        let (a, [_, right]) = (self.geometry.a, self.bar_edges());
        for bar in self.colour_bars() {
            let (top, [low, high]) = (GPA.of(bar.top_pa), bar.ends);
            // Over the numbers too, and clear of the slice's corner; in the smallest view beside the bar, not upon it.
            let mut at = vec![[right + 0.1 * a, 0.0, high + 0.4 * a]];
            let mut texts = vec![bar.title.to_owned()];
            for value in [0.0, 0.5 * top, top] {
                at.push([right + 0.28 * a, 0.0, low + (high - low) * value / top]);
                texts.push(plain(value));
            }
            let labels = labels(at, texts);
            let entity = format!("{LEGEND}/{}/labels", bar.name);
            stream.log_for(Holds::FromNow, &entity, &labels);
        }
    }

    /// What the sheets are, and how much their heights are exaggerated.
    fn log_labels(&self, stream: &Stream) {
        let g = self.geometry;
        let right = 1.0 * g.a;
        let factor = plain(self.exaggeration);
        let at = [
            [right, 1.2 * g.b, self.levels.body_2 + 0.1 * g.a],
            [0.0, 1.2 * g.b, self.levels.body_2 + 0.48 * g.a],
        ];
        let heights = format!("heights × {factor}; x, y and depth to scale");
        let labels = labels(at, ["body 2 (above)".to_owned(), heights]);
        stream.log_static(UPPER_LABELS, &labels);
    }
}

/// Texts at places.
pub(crate) fn labels(
    at: impl IntoIterator<Item = [f64; 3]>,
    texts: impl IntoIterator<Item = String>,
) -> Points3D {
    let at = at.into_iter().map(|at| at.map(|v| v as f32));
    Points3D::new(at)
        .with_radii([Radius::new_scene_units(0.0)])
        .with_colors([Color::from(WHITE)])
        .with_labels(texts)
        .with_show_labels(true)
}

/// Steel under a light.
pub(crate) fn steel(shade: f32) -> [u8; 3] {
    let value = (215.0 * shade).clamp(0.0, 255.0) as u8;
    [value; 3]
}

/// A round factor (1, 2 or 5 times a power of ten) that makes the roughness, or in smooth contacts
/// the film, as high as about a tenth of the contact's half-width.
fn exaggeration(g: Geometry, first: &Frame, rough: f64) -> f64 {
    let height = if rough > 0.0 {
        rough
    } else {
        first.metrics.h_central_m
    };
    let wanted = 0.2 * g.a / (height * MM).max(1e-12);
    let decade = 10_f64.powf(wanted.log10().floor());
    let step = match wanted / decade {
        share if share < 2.0 => 1.0,
        share if share < 5.0 => 2.0,
        _ => 5.0,
    };
    (step * decade).max(1.0)
}
