//! The 3-D view: the contact cut open along y = 0.
//!
//! From above: body 2's roughness (seen through), the film as a height field coloured by pressure,
//! body 1's roughness, and below it the stress in the cut plane with its depth to scale. Lengths are
//! mm; heights of film and roughness are multiplied by one factor, which the label states. The three
//! sheets are drawn apart: the gap between them is none of the model's. Lowest hangs body 1's damage map.

mod fixed;
mod hung;

use rerun::{Arrows3D, Color, Points3D, Radius};

use super::colour::{GREEN, ORANGE, Ramp, SKY, Tints, for_text, packed};
use super::depths::Depths;
use super::geometry::Geometry;
use super::mesh::{COARSE, FINE, MeshWindow};
use super::stream::Stream;
use super::waiting::Sheet;
use asperity_engine::math::number::{GPA, MM, plain, sig};
use asperity_engine::observe::ObserveError;
use asperity_engine::sim::{Frame, Metrics};

pub(super) const SPACE: &str = "contact_3d";
/// The sheets below it.
const FILM: &str = "film_coloured_by_pressure";
const BODIES: [&str; 2] = ["body_1_surface", UPPER_BODY];
/// The sheet of the body above, and what is written beside it.
pub(super) const UPPER_BODY: &str = "body_2_surface";
pub(super) const UPPER_LABELS: &str = "labels";
const SLICE: &str = "effective_stress_slice";
/// What stands in it.
const SPOTS: &str = "contact_3d/contact_spots";
const POINT: &str = "contact_3d/material_point";
/// Depth of the stress that is shown, in a.
const SLICE_DEPTH: f64 = 1.1;

/// Ranges that the 3-D view shares with the maps.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tops {
    pub(super) pressure_pa: f64,
    pub(super) effective_pa: Option<f64>,
    /// Which bodies are rough.
    pub(super) rough: [bool; 2],
    /// Height of both together that can come, m.
    pub(super) roughness_m: f64,
    /// Times that heights are drawn too high, where that is decided already.
    pub(super) exaggeration: Option<f64>,
}

/// The 3-D view.
pub(super) struct Space {
    geometry: Geometry,
    film: MeshWindow,
    bodies: MeshWindow,
    slice: Option<SliceSheet>,
    tops: Tops,
    exaggeration: f64,
    levels: Levels,
    speeds: Option<[f64; 3]>,
    hung: hung::Hung,
    sheets: SpaceSheets,
    pressure: Tints,
    stress: Tints,
    /// Scratch: heights and shades of a sheet.
    heights: Vec<f32>,
    shades: Vec<f32>,
}

/// What changes with every picture.
struct SpaceSheets {
    film: Sheet,
    bodies: [Sheet; 2],
    slice: Sheet,
}

impl SpaceSheets {
    fn new(stream: &Stream) -> Self {
        let sheet = |name: &str| stream.sheet(format!("{SPACE}/{name}"));
        Self {
            film: sheet(FILM),
            bodies: BODIES.map(sheet),
            slice: sheet(SLICE),
        }
    }
}

/// Where the sheets' zero heights are drawn, mm.
#[derive(Debug, Clone, Copy)]
struct Levels {
    body_2: f64,
    body_1: f64,
    slice: f64,
    damage: f64,
    /// The film is cut off at this height.
    film_cap: f64,
}

/// The cut plane's nodes.
struct SliceSheet {
    depths: Depths,
    columns: Vec<usize>,
}

impl Space {
    /// Sets up the view from the first frame; `None` for grids too coarse to show.
    pub(super) fn new(
        stream: &Stream,
        geometry: Geometry,
        first: &Frame,
        tops: Tops,
    ) -> Result<Option<Self>, ObserveError> {
        let reach = [1.45 * geometry.a, 1.25 * geometry.b];
        let window = |most| MeshWindow::new(geometry, reach, most);
        let (Some(film), Some(bodies)) = (window(FINE), window(COARSE)) else {
            return Ok(None);
        };
        let a = geometry.a;
        let levels = Levels {
            body_2: 0.95 * a,
            body_1: -0.32 * a,
            slice: -0.5 * a,
            damage: -(0.62 + SLICE_DEPTH) * a,
            film_cap: 0.6 * a,
        };
        let slice = first
            .slice
            .as_ref()
            .and_then(|slice| SliceSheet::new(geometry, slice));
        let mut space = Self {
            geometry,
            film,
            bodies,
            slice,
            tops,
            exaggeration: tops
                .exaggeration
                .unwrap_or_else(|| exaggeration(geometry, first, tops.roughness_m)),
            levels,
            speeds: None,
            hung: hung::Hung::new(stream),
            sheets: SpaceSheets::new(stream),
            pressure: Tints::new(pressure_colour),
            stress: Tints::of(Ramp::Magma),
            heights: Vec::new(),
            shades: Vec::new(),
        };
        space.log_static(stream)?;
        Ok(Some(space))
    }

    /// Colours up to these tops from now on.
    pub(super) fn reach(
        &mut self,
        stream: &Stream,
        pressure_pa: f64,
        effective_pa: Option<f64>,
    ) -> Result<(), ObserveError> {
        (self.tops.pressure_pa, self.tops.effective_pa) = (pressure_pa, effective_pa);
        self.log_tops(stream)
    }

    /// Words about the heights.
    pub(super) fn note(&self) -> String {
        format!(
            "In the 3-D view heights of film and roughness are drawn {} times too high against \
             lengths and depths, the film is cut off at {:.2} µm, and the bodies are drawn apart. \
             The film is grey-blue where it carries less than 6 % of the colour range.",
            plain(self.exaggeration),
            1e3 * self.levels.film_cap / self.exaggeration
        )
    }

    /// Times that heights are drawn too high.
    pub(super) fn exaggeration(&self) -> f64 {
        self.exaggeration
    }

    /// A point to look at and one to look from.
    pub(super) fn camera(&self) -> [[f64; 3]; 2] {
        let a = self.geometry.a;
        let target = [0.16 * a, 0.2 * a, -0.5 * a];
        [target, [-1.15 * a, -3.3 * a, 1.55 * a]]
    }

    /// Same for an audience: from above, so that the pressure on the film is seen and the stress below it, too.
    pub(super) fn lecture_camera(&self) -> [[f64; 3]; 2] {
        let a = self.geometry.a;
        let target = [0.3 * a, 0.25 * a, -0.6 * a];
        [target, [-0.1 * a, -2.83 * a, 2.48 * a]]
    }

    /// Logs one frame.
    pub(super) fn log(&mut self, stream: &Stream, frame: &Frame) -> Result<(), ObserveError> {
        self.log_film(stream, frame)?;
        let bodies = [
            (self.levels.body_1, 1.0, &frame.roughness_1_m),
            (self.levels.body_2, -1.0, &frame.roughness_2_m),
        ];
        for (body, (level, side, field)) in bodies.into_iter().enumerate() {
            // A smooth body's sheet is flat and was logged once.
            if self.tops.rough[body] {
                self.log_body(stream, body, level, side * self.exaggeration, field)?;
            }
        }
        self.log_slice(stream, frame)?;
        self.log_spots(stream, frame)?;
        self.log_point(stream, frame)?;
        self.log_speeds(stream, &frame.metrics)
    }

    fn log_film(&mut self, stream: &Stream, frame: &Frame) -> Result<(), ObserveError> {
        let factor = (MM * self.exaggeration) as f32;
        let cap = self.levels.film_cap as f32;
        let nodes = self.film.nodes();
        self.heights.clear();
        self.heights
            .extend(nodes.iter().map(|&at| (frame.film_m[at] * factor).min(cap)));
        self.film.shades(&self.heights, &mut self.shades);
        let per_top = 1.0 / self.tops.pressure_pa as f32;
        stream.log_sheet(self.sheets.film, |positions, colours| {
            self.film.place(&self.heights, positions);
            let lit = nodes.iter().zip(&self.shades);
            colours.extend(lit.map(|(&at, shade)| {
                // Only half of the shading, so that colours can still be read.
                let shade = (0.5 + 0.5 * shade).min(1.0);
                self.pressure.colour(frame.pressure_pa[at] * per_top, shade)
            }));
        })
    }

    fn log_body(
        &mut self,
        stream: &Stream,
        body: usize,
        level: f64,
        factor: f64,
        field: &[f32],
    ) -> Result<(), ObserveError> {
        let (level, factor) = (level as f32, (MM * factor) as f32);
        self.heights.clear();
        let nodes = self.bodies.nodes();
        self.heights
            .extend(nodes.iter().map(|&at| level + field[at] * factor));
        self.bodies.shades(&self.heights, &mut self.shades);
        stream.log_sheet(self.sheets.bodies[body], |positions, colours| {
            self.bodies.place(&self.heights, positions);
            colours.extend(self.shades.iter().map(|&shade| packed(steel(shade))));
        })
    }

    fn log_slice(&self, stream: &Stream, frame: &Frame) -> Result<(), ObserveError> {
        let (Some(sheet), Some(slice), Some(top)) =
            (&self.slice, &frame.slice, self.tops.effective_pa)
        else {
            return Ok(());
        };
        let nx = self.geometry.nx;
        if !sheet.depths.hold(slice, nx) {
            return Ok(());
        }
        let per_top = 1.0 / top as f32;
        let rows = slice.effective_pa.chunks_exact(nx).take(sheet.depths.len());
        stream.log_sheet(self.sheets.slice, |_, colours| {
            for row in rows {
                let stresses = sheet.columns.iter().map(|&i| row[i] * per_top);
                colours.extend(stresses.map(|share| self.stress.colour(share, 1.0)));
            }
        })
    }

    /// Where the bodies touch, on the film's sheet.
    fn log_spots(&self, stream: &Stream, frame: &Frame) -> Result<(), ObserveError> {
        let factor = MM * self.exaggeration;
        let spots = self.film.nodes().iter().zip(self.film.xy());
        let spots = spots
            .filter(|(at, _)| frame.contact[**at] > 0)
            .map(|(&at, &[x, y])| [x, y, (f64::from(frame.film_m[at]) * factor) as f32]);
        stream.log(SPOTS, &Points3D::update_fields().with_positions(spots))
    }

    /// The followed point of body 1, coloured by its stress.
    fn log_point(&self, stream: &Stream, frame: &Frame) -> Result<(), ObserveError> {
        let (Some(point), Some(top)) = (frame.material_point, self.tops.effective_pa) else {
            return Ok(());
        };
        let x = point.x_m * MM;
        let (mut places, mut colours, mut labels) = (Vec::new(), Vec::new(), Vec::new());
        if point.body == 1 && x.abs() <= 1.45 * self.geometry.a {
            let z = self.levels.slice - point.depth_m * MM;
            // A little in front of the cut, or the slice would hide half of it.
            places = vec![[x as f32, (-0.03 * self.geometry.a) as f32, z as f32]; 3];
            let stress = Ramp::Magma.colour((point.effective_pa / top) as f32, 1.0);
            // Rim, dot, and what carries the label in a colour that can be read.
            colours = [GREEN, stress, for_text(GREEN)].map(Color::from).to_vec();
            let label = format!("{} GPa", sig(GPA.of(point.effective_pa), 3));
            labels = vec![String::new(), String::new(), label];
        }
        let dot = Points3D::update_fields()
            .with_positions(places)
            .with_colors(colours)
            .with_labels(labels);
        stream.log(POINT, &dot)
    }

    /// Arrows as long as the surfaces are fast, logged when a speed has changed.
    fn log_speeds(&mut self, stream: &Stream, m: &Metrics) -> Result<(), ObserveError> {
        let u = m.entrainment_m_s;
        let speeds = [
            u * (1.0 - 0.5 * m.slide_roll),
            u * (1.0 + 0.5 * m.slide_roll),
        ];
        let now = Some([speeds[0], speeds[1], u]);
        if self.speeds == now || u == 0.0 {
            return Ok(());
        }
        self.speeds = now;
        let a = self.geometry.a;
        let [x, y] = [-1.45 * a, -0.15 * a];
        let levels = [self.levels.body_1, self.levels.body_2];
        let lengths = speeds.map(|speed| 0.7 * a * speed / u.abs());
        let arrows = Arrows3D::from_vectors(lengths.map(|length| [length as f32, 0.0, 0.0]))
            .with_origins(levels.map(|z| [x as f32, y as f32, z as f32]))
            .with_radii([(0.022 * a) as f32])
            .with_colors([Color::from(SKY), Color::from(ORANGE)]);
        stream.log(&format!("{SPACE}/surface_speeds"), &arrows)?;
        let places = lengths.into_iter().zip(levels);
        let labels = Points3D::new(places.map(|(length, z)| {
            let middle = x + 0.5 * length;
            [middle as f32, y as f32, z as f32]
        }))
        .with_radii([Radius::new_scene_units(0.0)])
        .with_colors([SKY, ORANGE].map(|colour| Color::from(for_text(colour))))
        .with_labels([1, 2].map(|body| format!("U{body} = {} m/s", sig(speeds[body - 1], 3))))
        .with_show_labels(true);
        stream.log(&format!("{SPACE}/surface_speeds/labels"), &labels)
    }
}

impl SliceSheet {
    /// Of fewer columns than the slice's image: the 3-D view is for looking, the image for reading.
    fn new(g: Geometry, slice: &asperity_engine::sim::StressSlice) -> Option<Self> {
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

/// The pressure's colour; where there is hardly any, the grey-blue of oil, because the dark end of
/// the map would hide the sheet's shape.
fn pressure_colour(share: f32) -> [f32; 3] {
    const OIL: [f32; 3] = [88.0, 104.0, 128.0];
    let weight = (share / 0.06).clamp(0.0, 1.0);
    let map = Ramp::Inferno.colour(share, 1.0);
    std::array::from_fn(|c| weight * f32::from(map[c]) + (1.0 - weight) * OIL[c])
}

/// Steel under a light.
fn steel(shade: f32) -> [u8; 3] {
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
