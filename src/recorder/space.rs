//! The 3-D view: the contact cut open along y = 0.
//!
//! From above: body 2's roughness (seen through), the film as a height field coloured by pressure,
//! body 1's roughness, and below it the stress in the cut plane with its depth to scale. Lengths are
//! mm; heights of film and roughness are multiplied by one factor, which the label states. The three
//! sheets are drawn apart: the gap between them is none of the model's. Lowest hangs body 1's damage map.

mod damage_sheet;
pub(crate) mod fixed;

use asperity_engine::physics::cycles::speed_ratios;
use rerun::{Arrows3D, Color, Mesh3D, Points3D, Radius};

use self::damage_sheet::DamageSheet;
pub(crate) use self::fixed::Tops;
use self::fixed::{Parts, steel};
use super::colour::{GREEN, ORANGE, Ramp, SKY, Tints, WHITE};
use super::entities::space::{BODIES, FILM, POINT, SLICE, SPEEDS, SPOTS};
use super::geometry::Geometry;
use super::stream::{Holds, Stream};
use super::view::View;
use asperity_engine::math::number::{GPA, MM, sig};
use asperity_engine::scene::Scene;
use asperity_engine::sim::{Frame, Metrics};
use asperity_picture::Scope;

/// The 3-D view.
pub(crate) struct Space {
    parts: Parts,
    /// Speeds that the arrows show.
    speeds: Option<[f64; 3]>,
    damage: DamageSheet,
    pressure: Tints,
    stress: Tints,
}

impl Space {
    /// Sets up the view from the first frame; `None` for grids too coarse to show.
    pub(crate) fn new(
        stream: &Stream,
        geometry: Geometry,
        first: &Frame,
        tops: Tops,
    ) -> Option<Self> {
        let parts = Parts::new(geometry, first, tops)?;
        parts.log_static(stream);
        Some(Self {
            speeds: None,
            damage: DamageSheet::new(geometry.a, parts.levels.damage),
            parts,
            pressure: Tints::new(pressure_colour),
            stress: Tints::of(Ramp::Magma),
        })
    }

    pub(crate) fn parts(&self) -> &Parts {
        &self.parts
    }

    fn log_film(&self, stream: &Stream, frame: &Frame) {
        let parts = &self.parts;
        let factor = (MM * parts.exaggeration) as f32;
        let cap = parts.levels.film_cap as f32;
        let nodes = parts.film.nodes();
        let heights = nodes.iter().map(|&at| (frame.film_m[at] * factor).min(cap));
        let heights: Vec<f32> = heights.collect();
        let per_top = 1.0 / parts.tops.pressure_pa as f32;
        let shades = parts.film.shades(&heights);
        let colours = nodes.iter().zip(&shades).map(|(&at, shade)| {
            // Only half of the shading, so that colours can still be read.
            let shade = (0.5 + 0.5 * shade).min(1.0);
            let share = frame.pressure_pa[at] * per_top;
            Color::from_u32(self.pressure.colour(share, shade))
        });
        let mesh = Mesh3D::update_fields()
            .with_vertex_positions(parts.film.places(&heights))
            .with_vertex_colors(colours);
        stream.log(FILM, &mesh);
    }

    fn log_body(&self, stream: &Stream, body: usize, field: &[f32]) {
        let (level, side) = match body {
            0 => (self.parts.levels.body_1, 1.0),
            _ => (self.parts.levels.body_2, -1.0),
        };
        let (level, factor) = (level as f32, (MM * side * self.parts.exaggeration) as f32);
        let sheet = &self.parts.bodies;
        let heights = sheet.nodes().iter().map(|&at| level + field[at] * factor);
        let heights: Vec<f32> = heights.collect();
        let colours = sheet.shades(&heights).into_iter().map(steel);
        let mesh = Mesh3D::update_fields()
            .with_vertex_positions(sheet.places(&heights))
            .with_vertex_colors(colours);
        stream.log(BODIES[body], &mesh);
    }

    fn log_slice(&self, stream: &Stream, frame: &Frame) {
        let parts = &self.parts;
        let (Some(sheet), Some(slice), Some(top)) =
            (&parts.slice, &frame.slice, parts.tops.effective_pa)
        else {
            return;
        };
        let nx = parts.geometry.nx;
        if !sheet.depths.hold(slice, nx) {
            return;
        }
        let per_top = 1.0 / top as f32;
        let rows = slice.effective_pa.chunks_exact(nx).take(sheet.depths.len());
        let stresses = rows.flat_map(|row| sheet.columns.iter().map(|&i| row[i]));
        let colours =
            stresses.map(|stress| Color::from_u32(self.stress.colour(stress * per_top, 1.0)));
        stream.log(SLICE, &Mesh3D::update_fields().with_vertex_colors(colours));
    }

    /// Contact of the bodies, on the film's sheet.
    fn log_spots(&self, stream: &Stream, frame: &Frame) {
        let factor = MM * self.parts.exaggeration;
        let spots = self.parts.film.nodes().iter().zip(self.parts.film.xy());
        let spots = spots
            .filter(|(at, _)| frame.contact[**at] > 0)
            .map(|(&at, &[x, y])| [x, y, (f64::from(frame.film_m[at]) * factor) as f32]);
        stream.log(SPOTS, &Points3D::update_fields().with_positions(spots));
    }

    /// The followed point of body 1, coloured by its stress.
    fn log_point(&self, stream: &Stream, frame: &Frame) {
        let (Some(point), Some(top)) = (frame.material_point, self.parts.tops.effective_pa) else {
            return;
        };
        let x = point.x_m * MM;
        let (mut places, mut colours, mut labels) = (Vec::new(), Vec::new(), Vec::new());
        if point.body == 1 && x.abs() <= 1.45 * self.parts.geometry.a {
            let z = self.parts.levels.slice - point.depth_m * MM;
            // A little in front of the cut, or the slice would hide half of it.
            places = vec![[x as f32, (-0.03 * self.parts.geometry.a) as f32, z as f32]; 3];
            let stress = Ramp::Magma.colour((point.effective_pa / top) as f32, 1.0);
            // Rim, dot, and what carries the label in a colour that can be read.
            colours = [GREEN, stress, WHITE].map(Color::from).to_vec();
            let label = format!("{} GPa", sig(GPA.of(point.effective_pa), 3));
            labels = vec![String::new(), String::new(), label];
        }
        let dot = Points3D::update_fields()
            .with_positions(places)
            .with_colors(colours)
            .with_labels(labels);
        stream.log(POINT, &dot);
    }

    /// Arrows as long as the surfaces are fast, logged when a speed has changed.
    fn log_speeds(&mut self, stream: &Stream, m: &Metrics) {
        let u = m.entrainment_m_s;
        let speeds = speed_ratios(m.slide_roll).map(|ratio| u * ratio);
        let now = Some([speeds[0], speeds[1], u]);
        if self.speeds == now || u == 0.0 {
            return;
        }
        self.speeds = now;
        let a = self.parts.geometry.a;
        let [x, y] = [-1.45 * a, -0.15 * a];
        let levels = [self.parts.levels.body_1, self.parts.levels.body_2];
        let lengths = speeds.map(|speed| 0.7 * a * speed / u.abs());
        let arrows = Arrows3D::from_vectors(lengths.map(|length| [length as f32, 0.0, 0.0]))
            .with_origins(levels.map(|z| [x as f32, y as f32, z as f32]))
            .with_radii([(0.022 * a) as f32])
            .with_colors([Color::from(SKY), Color::from(ORANGE)]);
        stream.log_for(Holds::FromNow, SPEEDS, &arrows);
        let places = lengths.into_iter().zip(levels);
        let labels = Points3D::new(places.map(|(length, z)| {
            let middle = x + 0.5 * length;
            [middle as f32, y as f32, z as f32]
        }))
        .with_radii([Radius::new_scene_units(0.0)])
        .with_colors([Color::from(WHITE)])
        .with_labels([1, 2].map(|body| format!("U{body} = {} m/s", sig(speeds[body - 1], 3))))
        .with_show_labels(true);
        stream.log_for(Holds::FromNow, &format!("{SPEEDS}/labels"), &labels);
    }
}

impl View for Space {
    fn widen(&mut self, stream: &Stream, _scene: Option<&Scene>, scope: &Scope) {
        let tops = &mut self.parts.tops;
        tops.pressure_pa = scope.ranges.pressure_pa;
        tops.effective_pa = tops.effective_pa.map(|_| scope.ranges.effective_pa);
        self.parts.log_tops(stream);
    }

    fn log(&mut self, stream: &Stream, frame: &Frame) {
        self.log_film(stream, frame);
        let fields = [&frame.roughness_1_m, &frame.roughness_2_m];
        for (body, field) in fields.into_iter().enumerate() {
            // A smooth body's sheet is flat and was logged once.
            if self.parts.tops.rough[body] {
                self.log_body(stream, body, field);
            }
        }
        self.log_slice(stream, frame);
        self.log_spots(stream, frame);
        self.log_point(stream, frame);
        self.log_speeds(stream, &frame.metrics);
    }

    fn log_seldom(&mut self, stream: &Stream, frame: &Frame) {
        self.damage.log(stream, frame);
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
