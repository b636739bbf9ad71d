//! Body 1's damage map below the stress, to the same scale: one block of the surface, repeated over the length
//! of the cut (a place 0 of the block, a crest, at x = 0). Colours as in the map: log10 D.

use rerun::{Color, Mesh3D, Points3D, Radius};

use super::super::colour::{BACKGROUND, Ramp, Tints, WHITE, packed};
use super::super::damage::{DECADES, powers};
use super::super::depths::Depths;
use super::super::mesh::triangles;
use super::super::stream::Stream;
use super::super::waiting;
use super::{SPACE, Space};
use asperity_engine::math::number::MM;
use asperity_engine::observe::ObserveError;
use asperity_engine::sim::{DamageBlock, Frame};

/// Depth that is shown, in a: damage by crests lies near the surface.
const DEPTH: f64 = 0.6;
/// The sheet.
const DAMAGE: &str = "contact_3d/damage_body_1";
/// Columns of the sheet.
const COLUMNS: usize = 161;

/// What is drawn.
pub(super) struct Hung {
    mesh: waiting::Sheet,
    tints: Tints,
    sheet: Option<HungSheet>,
    /// The map of the last picture: it changes when a material point has crossed.
    last: Vec<f32>,
}

impl Hung {
    pub(super) fn new(stream: &Stream) -> Self {
        Self {
            mesh: stream.sheet(DAMAGE),
            tints: Tints::of(Ramp::Magma),
            sheet: None,
            last: Vec::new(),
        }
    }
}

/// The sheet's rows, and what of the block each of its columns shows.
struct HungSheet {
    depths: Depths,
    columns: Vec<usize>,
    /// Columns and length (m) of the block.
    block: (usize, f64),
}

impl HungSheet {
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
    fn colour(&self, block: &DamageBlock, tints: &Tints, colours: &mut Vec<u32>) {
        let powers = powers(block, self.depths.len(), -DECADES as f32);
        for row in powers.chunks_exact(block.columns) {
            colours.extend(self.columns.iter().map(|&column| match row[column] {
                power if power.is_nan() => packed(BACKGROUND),
                power => tints.colour(0.5 + 0.5 * power / DECADES as f32, 1.0),
            }));
        }
    }
}

/// Place of a column of the sheet, mm.
fn x(i: usize, a: f64) -> f64 {
    1.45 * a * (2.0 * i as f64 / (COLUMNS - 1) as f64 - 1.0)
}

impl Space {
    /// Logs body 1's map where it has changed.
    pub(in super::super) fn log_damage(
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
        let fits = |sheet: &HungSheet| sheet.fits(block);
        if !self.hung.sheet.as_ref().is_some_and(fits) {
            self.hung.sheet = HungSheet::new(block, self.geometry.a);
            self.log_sheet(stream)?;
        }
        let Hung {
            mesh, tints, sheet, ..
        } = &self.hung;
        let Some(sheet) = sheet else {
            return Ok(());
        };
        stream.log_sheet(*mesh, |_, colours| sheet.colour(block, tints, colours))
    }

    /// The sheet's shape and its title, which stay until the block is another.
    fn log_sheet(&self, stream: &Stream) -> Result<(), ObserveError> {
        let Some(sheet) = &self.hung.sheet else {
            return Ok(());
        };
        let (a, level) = (self.geometry.a, self.levels.damage);
        let positions = sheet.depths.shown_m().iter().flat_map(|depth_m| {
            let z = (level - depth_m * MM) as f32;
            (0..COLUMNS).map(move |i| [x(i, a) as f32, 0.0, z])
        });
        let shape = Mesh3D::update_fields()
            .with_vertex_positions(positions)
            .with_triangle_indices(triangles(COLUMNS, sheet.depths.len()));
        stream.log(DAMAGE, &shape)?;
        self.log_title(stream)
    }

    fn log_title(&self, stream: &Stream) -> Result<(), ObserveError> {
        let a = self.geometry.a;
        let at = [0.0, 0.0, (self.levels.damage - (DEPTH + 0.3) * a) as f32];
        let title = Points3D::new([at])
            .with_radii([Radius::new_scene_units(0.0)])
            .with_colors([Color::from(WHITE)])
            .with_labels([format!(
                "damage of body 1, log10 D from -{DECADES} to {DECADES}; one wave, repeated"
            )])
            .with_show_labels(true);
        stream.log(&format!("{SPACE}/damage_title"), &title)
    }
}
