//! Body 1's damage map below the stress, to the same scale: one block of the surface, repeated over the length
//! of the cut (a place 0 of the block, a crest, at x = 0). Colours as in the map: log10 D.

use rerun::{Color, Mesh3D};

use super::fixed::labels;
use crate::colour::{BACKGROUND, Ramp, Tints, packed};
use crate::damage::{DECADES, powers};
use crate::depths::Depths;
use crate::entities::space::{DAMAGE, DAMAGE_TITLE};
use crate::mesh::triangles;
use crate::stream::{Holds, Stream};
use asperity_engine::math::number::MM;
use asperity_engine::sim::{DamageBlock, Frame};

/// Depth that is shown, in a: damage by crests lies near the surface.
const DEPTH: f64 = 0.6;
/// Columns of the sheet.
const COLUMNS: usize = 161;

/// The sheet below the stress.
pub(crate) struct DamageSheet {
    /// Hertz half-width and where the surface of the sheet is drawn, mm.
    a: f64,
    level: f64,
    tints: Tints,
    shape: Option<SheetShape>,
    /// The map of the last picture: it changes when a material point has crossed.
    last: Vec<f32>,
}

/// The sheet's rows, and what of the block each of its columns shows.
struct SheetShape {
    depths: Depths,
    columns: Vec<usize>,
    /// Columns and length (m) of the block.
    block: (usize, f64),
}

impl SheetShape {
    fn new(block: &DamageBlock, a: f64) -> Option<Self> {
        let column = |i: usize| {
            let way = (x(i, a) / MM).rem_euclid(block.length_m) / block.length_m;
            ((way * block.columns as f64) as usize).min(block.columns - 1)
        };
        Some(Self {
            depths: Depths::down_to(&block.depths_m, DEPTH * a / MM)?,
            columns: (0..COLUMNS).map(column).collect(),
            block: (block.columns, block.length_m),
        })
    }

    fn fits(&self, block: &DamageBlock) -> bool {
        self.depths.are_of(&block.depths_m) && self.block == (block.columns, block.length_m)
    }

    /// Row by row; what has not crossed yet is of the colour behind it.
    fn colours(&self, block: &DamageBlock, tints: &Tints) -> Vec<Color> {
        let powers = powers(block, self.depths.len());
        let colour = |power: f32| match power {
            power if power.is_nan() => packed(BACKGROUND),
            power => tints.colour(0.5 + 0.5 * power / DECADES as f32, 1.0),
        };
        let rows = powers.chunks_exact(block.columns);
        let shown = rows.flat_map(|row| self.columns.iter().map(|&column| row[column]));
        shown.map(|power| Color::from_u32(colour(power))).collect()
    }
}

/// Place of a column of the sheet, mm.
fn x(i: usize, a: f64) -> f64 {
    1.45 * a * (2.0 * i as f64 / (COLUMNS - 1) as f64 - 1.0)
}

impl DamageSheet {
    pub(crate) fn new(a: f64, level: f64) -> Self {
        Self {
            a,
            level,
            tints: Tints::of(Ramp::Magma),
            shape: None,
            last: Vec::new(),
        }
    }

    /// Logs body 1's map where it has changed.
    pub(crate) fn log(&mut self, stream: &Stream, frame: &Frame) {
        let [Some(block), _] = &frame.damage else {
            return;
        };
        let depths = block.depths_m.len();
        let is_whole = block.columns > 0 && block.damage.len() == block.columns * depths;
        if block.filled == 0 || !is_whole || self.last == block.damage {
            return;
        }
        self.last.clone_from(&block.damage);
        if self.shape.as_ref().is_none_or(|shape| !shape.fits(block)) {
            self.shape = SheetShape::new(block, self.a);
            self.log_shape(stream);
        }
        if let Some(shape) = &self.shape {
            let colours = shape.colours(block, &self.tints);
            stream.log(DAMAGE, &Mesh3D::update_fields().with_vertex_colors(colours));
        }
    }

    /// The sheet's shape and its title, which stay until the block is another.
    fn log_shape(&self, stream: &Stream) {
        let Some(shape) = &self.shape else {
            return;
        };
        let (a, level) = (self.a, self.level);
        let positions = shape.depths.shown_m().iter().flat_map(|depth_m| {
            let z = (level - depth_m * MM) as f32;
            (0..COLUMNS).map(move |i| [x(i, a) as f32, 0.0, z])
        });
        let mesh = Mesh3D::update_fields()
            .with_vertex_positions(positions)
            .with_triangle_indices(triangles(COLUMNS, shape.depths.len()));
        stream.log_for(Holds::FromNow, DAMAGE, &mesh);
        let title =
            format!("damage of body 1, log10 D from -{DECADES} to {DECADES}; one wave, repeated");
        let title = labels([[0.0, 0.0, level - (DEPTH + 0.3) * a]], [title]);
        stream.log_for(Holds::FromNow, DAMAGE_TITLE, &title);
    }
}
