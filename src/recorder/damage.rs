//! Damage maps: a block of each surface that moves with its body, way from a crest to the right, depth down.
//!
//! Damage spans many powers of ten, so its logarithm is shown, in a range that is the same in every frame and
//! every recording: thousandfold above and below the worst point of the smooth contact. A block exists once
//! material has crossed; what of it has not crossed yet is no number and is not drawn, and its share is told. Block
//! and picture are stretched to one size, whose axes carry the lengths; a row for each of the solver's depths.

use rerun::components::{ImageFormat, MagnificationFilter};
use rerun::{AnnotationContext, AsComponents, ChannelDatatype, DepthImage, Points2D, Radius};
use rerun::{Rgba32, Scalars, SegmentationImage};

use super::classes;
use super::colour::{BACKGROUND, GREEN, WHITE, faded};
use super::depths::Depths;
use super::entities::{DAMAGE, SUFFERED, damage_block};
use super::picture::{Field, PixelField};
use super::plot::{PlotBox, ticks_at};
use super::raster::{Height, RasterEntity};
use super::stream::Stream;
use super::view::View;
use asperity_engine::math::number::{UM, Unit, sig, ticks};
use asperity_engine::scene::Scene;
use asperity_engine::sim::{DamageBlock, Frame};
use asperity_picture::{Look, Ramp, Scope};

/// Powers of ten above and below the reference that colours tell apart.
pub(crate) const DECADES: f64 = 3.0;
const WIDTH: f64 = 2.0;
const HEIGHT: f64 = 1.5;
/// Depth that is shown, in a: twice that of the maximum shear stress. Below there is no damage to speak of.
const DEPTH: f64 = 1.5;

/// The damage maps of both bodies: of a crossing, and of all cycles.
#[derive(Default)]
pub(crate) struct Damage {
    blocks: [Option<Block>; 2],
    suffered: [Option<Block>; 2],
}

/// What a map tells.
#[derive(Debug, Clone, Copy)]
enum Mapped {
    /// The damage of a crossing over that of the smooth contact's worst point.
    Crossing,
    /// That of all cycles; 1 is a pit.
    AllCycles,
}

struct Block {
    mapped: Mapped,
    entity: &'static str,
    raster: RasterEntity,
    depths: Depths,
    columns: usize,
    length_m: f64,
    /// What was logged last: a map changes when a material point has crossed.
    last: Vec<f32>,
}

/// The frame of the pictures, which views show before there is a block.
pub(crate) fn plot_box() -> PlotBox {
    PlotBox {
        x: [0.0, WIDTH],
        y: [0.0, HEIGHT],
        ..PlotBox::default()
    }
}

impl View for Damage {
    /// Its range is the same in every recording.
    fn widen(&mut self, _stream: &Stream, _scene: Option<&Scene>, _scope: &Scope) {}

    /// What all cycles have left changes with each jump, and stands after the cycles that it is of.
    fn log(&mut self, stream: &Stream, frame: &Frame) {
        let now = stream.now();
        stream.set_time(now.after_cycles(frame.age.map(|age| age.cycles)));
        for (body, damage) in frame.suffered.iter().enumerate() {
            if let Some(damage) = damage {
                let block = &mut self.suffered[body];
                let of = (SUFFERED[body], Mapped::AllCycles);
                log_block(stream, block, of, damage, frame.a_m);
            }
        }
        stream.set_time(now);
    }

    /// The maps that have changed: what collects slowly does not need every picture.
    fn log_seldom(&mut self, stream: &Stream, frame: &Frame) {
        for (body, damage) in frame.damage.iter().enumerate() {
            let Some(damage) = damage.as_ref().filter(|damage| damage.filled > 0) else {
                continue;
            };
            let block = &mut self.blocks[body];
            let of = (DAMAGE[body], Mapped::Crossing);
            log_block(stream, block, of, damage, frame.a_m);
        }
    }
}

/// Logs a map that has changed, in a picture that is set up where there is none that fits.
fn log_block(
    stream: &Stream,
    block: &mut Option<Block>,
    of: (&'static str, Mapped),
    damage: &DamageBlock,
    a_m: f64,
) {
    if !block.as_ref().is_some_and(|block| block.fits(damage)) {
        *block = Block::new(stream, of, damage, a_m);
    }
    if let Some(block) = block {
        block.log(stream, damage);
    }
}

impl Block {
    /// Sets up the picture; `None` for a block that makes none.
    fn new(
        stream: &Stream,
        (entity, mapped): (&'static str, Mapped),
        damage: &DamageBlock,
        a_m: f64,
    ) -> Option<Self> {
        let depths = Depths::down_to(&damage.depths_m, DEPTH * a_m)?;
        if damage.columns == 0 || damage.damage.len() != damage.columns * damage.depths_m.len() {
            return None;
        }
        let length = UM.of(damage.length_m);
        let plot = PlotBox {
            x_ticks: ticks_at(&ticks(0.0, length, 5), |x| WIDTH * x / length),
            left_ticks: depths.ticks(HEIGHT),
            x_title: "distance along the surface from a crest, µm".into(),
            titles: vec![(0.13, "depth z, µm".into(), None)],
            ..plot_box()
        };
        let size = [WIDTH / damage.columns as f64, HEIGHT / depths.len() as f64];
        let pixels = PixelField {
            columns: damage.columns,
            rows: depths.len(),
            first: size.map(|side| 0.5 * side),
            size,
        };
        let look = Look {
            range: [-DECADES, DECADES],
            ..Look::up_to("D", Unit::new("log10", 1.0), DECADES, Ramp::Magma)
        };
        let style = Points2D::update_fields()
            .with_radii([Radius::new_ui_points(0.0), Radius::new_ui_points(5.0)])
            .with_colors([faded(WHITE, 255), faded(GREEN, 255)])
            .with_show_labels(true)
            .with_draw_order(26.0);
        stream.log_static(worst_point(entity), &style);
        let raster = RasterEntity::new(stream, entity, look, pixels, &plot, Height::Fixed);
        // What is no number must not colour its neighbours.
        let sharp =
            DepthImage::update_fields().with_magnification_filter(MagnificationFilter::Nearest);
        stream.log_static(format!("{entity}/image"), &sharp);
        log_cover(stream, &cover(entity), &pixels);
        // For programs: length of the block, its columns, and the depths that are shown.
        let sides = [damage.length_m, damage.columns as f64];
        let shown = depths.shown_m().iter().copied();
        stream.log_static(
            damage_block(entity),
            &Scalars::new(sides.into_iter().chain(shown)),
        );
        Some(Self {
            mapped,
            entity,
            raster,
            depths,
            columns: damage.columns,
            length_m: damage.length_m,
            last: Vec::new(),
        })
    }

    fn fits(&self, damage: &DamageBlock) -> bool {
        self.columns == damage.columns
            && self.length_m == damage.length_m
            && self.depths.are_of(&damage.depths_m)
            && damage.damage.len() == damage.columns * damage.depths_m.len()
    }

    fn log(&mut self, stream: &Stream, damage: &DamageBlock) {
        if self.last == damage.damage {
            return;
        }
        self.last.clone_from(&damage.damage);
        let powers = powers(damage, self.depths.len());
        self.raster.log(stream, Field::TopDown(&powers));
        let not_crossed = powers.iter().map(|power| u8::from(power.is_nan()));
        classes::log(stream, &cover(self.entity), not_crossed.collect());
        self.log_pit(stream, damage);
    }

    /// Where the pit starts by this map: the worst point.
    fn log_pit(&self, stream: &Stream, damage: &DamageBlock) {
        let way = damage.pit_place_m.rem_euclid(self.length_m) / self.length_m;
        let share = self.depths.share(damage.pit_depth_m);
        let at = share.map(|share| [WIDTH * way, HEIGHT * share].map(|v| v as f32));
        let crossed = 100.0 * damage.filled as f64 / self.columns as f64;
        let not_yet = if damage.filled < self.columns {
            format!(
                "\n{} % of it has crossed; the rest is not drawn",
                sig(crossed, 2)
            )
        } else {
            String::new()
        };
        let what = match self.mapped {
            Mapped::Crossing => "the pit starts here (dot)",
            Mapped::AllCycles => "most (dot)",
        };
        let label = format!(
            "{what}: D = {}, {} µm deep{not_yet}",
            sig(damage.pit_damage, 3),
            sig(UM.of(damage.pit_depth_m), 3),
        );
        // In the middle below, where it hides little and is not cut off. A worst point below the picture has no dot.
        let label_at = [0.5 * WIDTH, 0.84 * HEIGHT].map(|v| v as f32);
        let pit = Points2D::update_fields()
            .with_positions(std::iter::once(label_at).chain(at))
            .with_labels([label, String::new()]);
        stream.log(&worst_point(self.entity), &pit);
    }
}

/// log10 D depth by depth down to so many depths, at least the lower end of the colours (the viewer in a browser paints what lies
/// below its range as far above the range's end); NaN in columns that have not crossed.
pub(crate) fn powers(block: &DamageBlock, shown: usize) -> Vec<f32> {
    let floor = -DECADES as f32;
    let (columns, depths) = (block.columns, block.depths_m.len());
    let mut powers = vec![f32::NAN; columns * shown];
    for (column, damage) in block.damage.chunks_exact(depths.max(1)).enumerate() {
        if damage.iter().any(|&damage| damage > 0.0) {
            for (row, damage) in damage.iter().take(shown).enumerate() {
                powers[row * columns + column] = damage.log10().max(floor);
            }
        }
    }
    powers
}

/// What covers the picture is of the colour behind it: as if nothing were drawn.
fn log_cover(stream: &Stream, entity: &str, pixels: &PixelField) {
    let format = ImageFormat::segmentation(pixels.resolution(), ChannelDatatype::U8);
    let image = SegmentationImage::update_fields()
        .with_format(format)
        .with_opacity(1.0)
        .with_draw_order(5.0);
    let [r, g, b] = BACKGROUND;
    let context = AnnotationContext::new([
        (0, "crossed", Rgba32::from_unmultiplied_rgba(0, 0, 0, 0)),
        (1, "not crossed yet", Rgba32::from_rgb(r, g, b)),
    ]);
    let parts: [&dyn AsComponents; 3] = [&image, &pixels.transform(), &context];
    stream.log_static(entity, &parts);
}

fn cover(entity: &str) -> String {
    format!("{entity}/not_crossed")
}

fn worst_point(entity: &str) -> String {
    format!("{entity}/worst_point")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is stored never lies below the range of the colours, however little damage there is; what has not crossed is no number.
    #[test]
    fn nothing_is_stored_below_the_colours() {
        let block = DamageBlock {
            columns: 2,
            depths_m: [0.0, 1e-5, 2e-5].into(),
            damage: vec![1e-30, 1e-2, 1e2, 0.0, 0.0, 0.0],
            ..DamageBlock::default()
        };
        let found = powers(&block, 3);
        assert_eq!([found[0], found[2], found[4]], [-3.0, -2.0, 2.0]);
        assert!([found[1], found[3], found[5]].iter().all(|v| v.is_nan()));
    }
}
