//! Damage maps: a block of each surface that moves with its body, way from a crest to the right, depth down.
//!
//! Damage spans many powers of ten, so its logarithm is shown, in a range that is the same in every frame and
//! every recording: thousandfold above and below the worst point of the smooth contact. A block exists once
//! material has crossed; until then its picture is empty. Block and picture are stretched to one size, whose
//! axes carry the lengths.

use rerun::components::Colormap;
use rerun::{Points2D, Radius};

use super::colour::{GREEN, WHITE, faded};
use super::plot::{PlotBox, ticks_at};
use super::raster::{Field, Height, Pixels, Raster, Scale, Sign};
use super::slice::Rows;
use super::stream::Stream;
use crate::observe::ObserveError;
use crate::observe::scales::{MM, ticks};
use crate::sim::{DamageBlock, Frame};

/// Entities of body 1 and 2.
pub(super) const DAMAGE: [&str; 2] = [
    "damage/body_1_log10_relative",
    "damage/body_2_log10_relative",
];
/// Powers of ten above and below the reference that colours tell apart.
pub(super) const DECADES: f64 = 3.0;
const WIDTH: f64 = 2.0;
const HEIGHT: f64 = 1.5;
/// Depth that is shown, in a: twice that of the greatest shear stress. Below there is no damage to speak of.
const DEPTH: f64 = 1.5;
/// Rows of the picture.
const ROWS: f64 = 96.0;
const UM: f64 = 1e6;

/// The damage maps of both bodies.
#[derive(Default)]
pub(super) struct Damage {
    blocks: [Option<Block>; 2],
}

struct Block {
    entity: &'static str,
    raster: Raster,
    rows: Rows,
    columns: usize,
    length_m: f64,
    /// Lower edge of the picture.
    deepest_m: f64,
    /// What was logged last: a map changes when a material point has crossed.
    last: Vec<f32>,
}

/// The frame of the pictures, which views show before there is a block.
pub(super) fn plot_box() -> PlotBox {
    PlotBox {
        x: [0.0, WIDTH],
        y: [0.0, HEIGHT],
        ..PlotBox::default()
    }
}

impl Damage {
    /// Logs the maps that have changed.
    pub(super) fn log(&mut self, stream: &Stream, frame: &Frame) -> Result<(), ObserveError> {
        for (body, damage) in frame.damage.iter().enumerate() {
            let Some(damage) = damage.as_ref().filter(|damage| damage.filled > 0) else {
                continue;
            };
            let fits = |block: &Block| block.fits(damage);
            if !self.blocks[body].as_ref().is_some_and(fits) {
                self.blocks[body] = Block::new(stream, DAMAGE[body], damage, frame.a_m)?;
            }
            if let Some(block) = &mut self.blocks[body] {
                block.log(stream, damage)?;
            }
        }
        Ok(())
    }
}

impl Block {
    /// Sets up the picture; `None` for a block that makes none.
    fn new(
        stream: &Stream,
        entity: &'static str,
        damage: &DamageBlock,
        a_m: f64,
    ) -> Result<Option<Self>, ObserveError> {
        let depths = &damage.depths_m;
        let (Some(first), Some(last)) = (depths.first(), depths.last()) else {
            return Ok(None);
        };
        let last = last.min(DEPTH * a_m);
        let Some(rows) = Rows::new(depths, (last - first) * MM / ROWS, last * MM) else {
            return Ok(None);
        };
        if damage.columns == 0 || damage.damage.len() != damage.columns * depths.len() {
            return Ok(None);
        }
        let (length, depth) = (damage.length_m * UM, last * UM);
        let plot = PlotBox {
            x_ticks: ticks_at(&ticks(0.0, length, 5), |x| WIDTH * x / length),
            left_ticks: ticks_at(&ticks(0.0, depth, 5), |z| HEIGHT * z / depth),
            x_title: "way along the surface from a crest, µm".into(),
            titles: vec![(0.13, "depth z, µm".into(), WHITE)],
            ..plot_box()
        };
        let row_height = HEIGHT * (last - first) / (last * (rows.len() - 1) as f64);
        let column_width = WIDTH / damage.columns as f64;
        let pixels = Pixels {
            columns: damage.columns,
            rows: rows.len(),
            first: [0.5 * column_width, HEIGHT * first / last],
            size: [column_width, row_height],
        };
        let scale = Scale {
            unit: "powers of ten",
            per_si: 1.0,
            top: DECADES,
            headroom: 4.0,
            sign: Sign::Both,
            colours: Colormap::Magma,
        };
        let style = Points2D::update_fields()
            .with_radii([Radius::new_ui_points(5.0), Radius::new_ui_points(0.0)])
            .with_colors([faded(GREEN, 255), faded(WHITE, 255)])
            .with_show_labels(true)
            .with_draw_order(26.0);
        stream.log_static(worst_point(entity), &style)?;
        Ok(Some(Self {
            entity,
            raster: Raster::new(
                stream,
                entity,
                scale,
                pixels,
                &plot,
                ("log10 D", Height::Fixed),
            )?,
            rows,
            columns: damage.columns,
            length_m: damage.length_m,
            deepest_m: last,
            last: Vec::new(),
        }))
    }

    fn fits(&self, damage: &DamageBlock) -> bool {
        self.columns == damage.columns
            && self.length_m == damage.length_m
            && self.rows.are_over(&damage.depths_m)
            && damage.damage.len() == damage.columns * damage.depths_m.len()
    }

    fn log(&mut self, stream: &Stream, damage: &DamageBlock) -> Result<(), ObserveError> {
        if self.last == damage.damage {
            return Ok(());
        }
        self.last.clone_from(&damage.damage);
        let (columns, depths) = (self.columns, damage.depths_m.len());
        // Depth by depth, as the rows want it; nowhere below what can be stored.
        let least = -4.0 * DECADES as f32;
        let powers: Vec<f32> = (0..columns * depths)
            .map(|at| damage.damage[at % columns * depths + at / columns])
            .map(|value| value.log10().max(least))
            .collect();
        let image = self.rows.image(&powers, columns);
        self.raster.log(stream, Field::TopDown(&image))?;
        self.log_pit(stream, damage)
    }

    /// Where the pit starts by this map: the worst point.
    fn log_pit(&self, stream: &Stream, damage: &DamageBlock) -> Result<(), ObserveError> {
        let way = damage.pit_place_m.rem_euclid(self.length_m) / self.length_m;
        let at = [WIDTH * way, HEIGHT * damage.pit_depth_m / self.deepest_m].map(|v| v as f32);
        let label = format!(
            "worst: D = {:.3}, {:.1} µm deep",
            damage.pit_damage,
            damage.pit_depth_m * UM
        );
        // In the middle below, where it hides little and is not cut off.
        let label_at = [0.5 * WIDTH, 0.86 * HEIGHT].map(|v| v as f32);
        let pit = Points2D::update_fields()
            .with_positions([at, label_at])
            .with_labels([String::new(), label]);
        stream.log(&worst_point(self.entity), &pit)
    }
}

fn worst_point(entity: &str) -> String {
    format!("{entity}/worst_point")
}
