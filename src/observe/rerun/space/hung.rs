//! Body 1's damage map below the stress, to the same scale: one block of the surface, repeated over the length
//! of the cut (a place 0 of the block, a crest, at x = 0). Colours as in the map: log10 D.

use rerun::{Color, Mesh3D, Points3D, Radius};

use super::super::colour::{GREY, Ramp};
use super::super::damage::DECADES;
use super::super::mesh::triangles;
use super::super::slice::Rows;
use super::super::stream::Stream;
use super::{SPACE, Space};
use crate::observe::ObserveError;
use crate::observe::scales::MM;
use crate::sim::{DamageBlock, Frame};

/// Depth that is shown, in a: damage by crests lies near the surface.
const DEPTH: f64 = 0.6;
/// Columns of the sheet.
const COLUMNS: usize = 161;

/// What was drawn last: a map changes when a material point has crossed.
#[derive(Default)]
pub(super) struct Hung {
    rows: Option<Rows>,
    last: Vec<f32>,
}

impl Space {
    /// Logs body 1's map where it has changed.
    pub(super) fn log_damage(
        &mut self,
        stream: &Stream,
        frame: &Frame,
    ) -> Result<(), ObserveError> {
        let [Some(block), _] = &frame.damage else {
            return Ok(());
        };
        let depths = block.depths_m.len();
        let is_whole = block.columns > 0 && block.damage.len() == block.columns * depths;
        if block.filled == 0 || !is_whole || self.hung.last == block.damage {
            return Ok(());
        }
        self.hung.last.clone_from(&block.damage);
        let a = self.geometry.a;
        if !(self.hung.rows.as_ref()).is_some_and(|rows| rows.are_over(&block.depths_m)) {
            self.hung.rows = Rows::new(&block.depths_m, 0.025 * a, DEPTH * a);
            self.log_title(stream)?;
        }
        let Some(rows) = &self.hung.rows else {
            return Ok(());
        };
        let level = self.levels.damage;
        let x = |i: usize| 1.45 * a * (2.0 * i as f64 / (COLUMNS - 1) as f64 - 1.0);
        let positions = (0..rows.len()).flat_map(|row| {
            let z = (level - rows.depth_mm(row)) as f32;
            (0..COLUMNS).map(move |i| [x(i) as f32, 0.0, z])
        });
        let powers = powers(block);
        let colours = (0..rows.len()).flat_map(|row| {
            let powers = &powers;
            (0..COLUMNS).map(move |i| {
                let way = (x(i) / MM).rem_euclid(block.length_m) / block.length_m;
                let column = ((way * block.columns as f64) as usize).min(block.columns - 1);
                let power = f64::from(rows.value(powers, block.columns, row, column));
                Ramp::Magma.colour((0.5 + 0.5 * power / DECADES) as f32, 1.0)
            })
        });
        let mesh = Mesh3D::new(positions)
            .with_triangle_indices(triangles(COLUMNS, rows.len()))
            .with_vertex_colors(colours);
        stream.log(format!("{SPACE}/damage_body_1"), &mesh)
    }

    fn log_title(&self, stream: &Stream) -> Result<(), ObserveError> {
        let a = self.geometry.a;
        let at = [0.0, 0.0, (self.levels.damage - (DEPTH + 0.3) * a) as f32];
        let title = Points3D::new([at])
            .with_radii([Radius::new_scene_units(0.0)])
            .with_colors([Color::from(GREY)])
            .with_labels([format!(
                "damage of body 1, log10 D from -{DECADES} to {DECADES}; one wave, repeated"
            )])
            .with_show_labels(true);
        stream.log(format!("{SPACE}/damage_title"), &title)
    }
}

/// log10 D depth by depth; nothing below what colours tell apart.
fn powers(block: &DamageBlock) -> Vec<f32> {
    let (columns, depths) = (block.columns, block.depths_m.len());
    (0..columns * depths)
        .map(|at| block.damage[at % columns * depths + at / columns])
        .map(|value| value.log10().max(-DECADES as f32))
        .collect()
}
