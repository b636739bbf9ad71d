//! What of the 3-D view never changes: triangles, smooth bodies, the cut, legends, labels.

use rerun::{AlbedoFactor, Color, LineStrips3D, Mesh3D, Points3D, Radius, Rgba32};

use super::super::colour::{GREY, Ramp, WHITE, faded};
use super::super::mesh::{MeshWindow, triangles};
use super::super::stream::Stream;
use super::{BODIES, FILM, POINT, SLICE, SPACE, SPOTS, Space, UPPER_LABELS, steel};
use asperity_engine::math::number::{GPA, MM, plain, ticks};
use asperity_engine::observe::ObserveError;
use asperity_picture::CONTACT;

impl Space {
    pub(super) fn log_static(&mut self, stream: &Stream) -> Result<(), ObserveError> {
        let sheet = |name: &str, window: &MeshWindow, colour: [u8; 4]| {
            let albedo = AlbedoFactor::from(Rgba32::from_unmultiplied_rgba(
                colour[0], colour[1], colour[2], colour[3],
            ));
            let mesh = Mesh3D::update_fields()
                .with_triangle_indices(window.triangles())
                .with_albedo_factor(albedo);
            stream.log_static(format!("{SPACE}/{name}"), &mesh)
        };
        sheet(FILM, &self.film, [255, 255, 255, 255])?;
        sheet(BODIES[0], &self.bodies, [200, 222, 245, 255])?;
        sheet(BODIES[1], &self.bodies, [250, 222, 190, 150])?;
        self.log_smooth_bodies(stream)?;
        self.log_dots(stream)?;
        self.log_cut(stream)?;
        for (name, ramp, _, place) in self.legends() {
            self.log_bar(stream, name, ramp, place)?;
        }
        self.log_tops(stream)?;
        self.log_labels(stream)
    }

    /// How contact spots and the followed point look.
    fn log_dots(&self, stream: &Stream) -> Result<(), ObserveError> {
        let spots = Points3D::update_fields()
            .with_radii([Radius::new_scene_units((0.55 * self.geometry.dx) as f32)])
            .with_colors([Color::from(CONTACT)]);
        stream.log_static(SPOTS, &spots)?;
        let point = Points3D::update_fields()
            .with_radii([0.075, 0.055, 0.0].map(|r| (r * self.geometry.a) as f32))
            .with_show_labels(true);
        stream.log_static(POINT, &point)
    }

    /// The sheets of smooth bodies never change.
    fn log_smooth_bodies(&self, stream: &Stream) -> Result<(), ObserveError> {
        for (body, level) in [self.levels.body_1, self.levels.body_2]
            .into_iter()
            .enumerate()
        {
            if !self.tops.rough[body] {
                let places = self.bodies.xy().iter();
                let sheet = Mesh3D::update_fields()
                    .with_vertex_positions(places.map(|&[x, y]| [x, y, level as f32]))
                    .with_vertex_colors(vec![steel(1.0); self.bodies.nodes().len()]);
                stream.log_static(format!("{SPACE}/{}", BODIES[body]), &sheet)?;
            }
        }
        Ok(())
    }

    /// The cut plane: its mesh, its outline and its depths.
    fn log_cut(&self, stream: &Stream) -> Result<(), ObserveError> {
        let Some(sheet) = &self.slice else {
            return Ok(());
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
        let entity = format!("{SPACE}/{SLICE}");
        stream.log_static(
            entity.as_str(),
            // Colours come with every frame: static ones would hide them.
            &Mesh3D {
                vertex_colors: None,
                ..mesh
            },
        )?;
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
        stream.log_static(format!("{SPACE}/cut/outline"), &outline)?;
        let mut depths = ticks(0.0, level - bottom, 3);
        // The surface needs no number, and its place is taken by the arrow.
        depths.retain(|&z| z > 0.0);
        let labels = Points3D::new(
            depths
                .iter()
                .map(|z| [(left - 0.1 * g.a) as f32, 0.0, (level - z) as f32]),
        )
        .with_radii([Radius::new_scene_units(0.0)])
        .with_colors([Color::from(WHITE)])
        .with_labels(depths.iter().map(|&z| format!("{} mm", plain(z))))
        .with_show_labels(true);
        stream.log_static(format!("{SPACE}/cut/depths"), &labels)
    }

    /// Colour bars of pressure and stress at the right of the bodies: name, colours, top and unit, lower and upper end.
    fn legends(&self) -> impl Iterator<Item = (&'static str, Ramp, (f64, &'static str), [f64; 2])> {
        let a = self.geometry.a;
        let bottom = self.levels.slice - 1.1 * a;
        let pressure = (self.tops.pressure_pa, "p, GPa");
        let stress = self.tops.effective_pa.map(|top| (top, "σ_eff, GPa"));
        let stress = stress.map(|stress| {
            let place = [bottom, bottom + 0.9 * a];
            ("effective_stress", Ramp::Magma, stress, place)
        });
        let place = [-0.1 * a, 0.85 * a];
        std::iter::once(("pressure", Ramp::Inferno, pressure, place)).chain(stress)
    }

    /// Left and right edge of the colour bars.
    fn bar_edges(&self) -> [f64; 2] {
        [1.9, 2.0].map(|x| x * self.geometry.a)
    }

    fn log_bar(
        &self,
        stream: &Stream,
        name: &str,
        ramp: Ramp,
        [low, high]: [f64; 2],
    ) -> Result<(), ObserveError> {
        const ROWS: usize = 33;
        let share = |row: usize| row as f64 / (ROWS - 1) as f64;
        let positions = (0..ROWS).flat_map(|row| {
            let z = low + (high - low) * share(row);
            self.bar_edges().map(|x| [x as f32, 0.0, z as f32])
        });
        let colours = (0..ROWS).flat_map(|row| [ramp.colour(share(row) as f32, 1.0); 2]);
        let mesh = Mesh3D::new(positions)
            .with_triangle_indices(triangles(2, ROWS))
            .with_vertex_colors(colours);
        stream.log_static(format!("{SPACE}/legend/{name}"), &mesh)
    }

    /// The numbers beside the colour bars, from now on.
    pub(super) fn log_tops(&self, stream: &Stream) -> Result<(), ObserveError> {
        let (a, [_, right]) = (self.geometry.a, self.bar_edges());
        for (name, _, (top_pa, title), [low, high]) in self.legends() {
            let top = GPA.of(top_pa);
            // Over the numbers too, and clear of the slice's corner.
            let mut at = vec![[right + 0.05 * a, 0.0, high + 0.27 * a]];
            let mut texts = vec![title.to_owned()];
            for value in [0.0, 0.5 * top, top] {
                at.push([right + 0.14 * a, 0.0, low + (high - low) * value / top]);
                texts.push(plain(value));
            }
            let labels = Points3D::new(at.iter().map(|at| at.map(|v| v as f32)))
                .with_radii([Radius::new_scene_units(0.0)])
                .with_colors([Color::from(WHITE)])
                .with_labels(texts)
                .with_show_labels(true);
            stream.log(&format!("{SPACE}/legend/{name}/labels"), &labels)?;
        }
        Ok(())
    }

    /// What the sheets are, and how much their heights are exaggerated.
    fn log_labels(&self, stream: &Stream) -> Result<(), ObserveError> {
        let g = self.geometry;
        let right = 1.0 * g.a;
        let factor = plain(self.exaggeration);
        let texts = [
            (self.levels.body_2 + 0.2 * g.a, "body 2 (above)".to_owned()),
            (
                self.levels.body_2 + 0.48 * g.a,
                format!("heights × {factor}; x, y and depth to scale"),
            ),
        ];
        let labels = Points3D::new(texts.iter().enumerate().map(|(k, (z, _))| {
            let x = if k == 0 { right } else { 0.0 };
            [x as f32, (1.2 * g.b) as f32, *z as f32]
        }))
        .with_radii([Radius::new_scene_units(0.0)])
        .with_colors([Color::from(WHITE)])
        .with_labels(texts.iter().map(|(_, text)| text.as_str()))
        .with_show_labels(true);
        stream.log_static(format!("{SPACE}/{UPPER_LABELS}"), &labels)
    }
}
