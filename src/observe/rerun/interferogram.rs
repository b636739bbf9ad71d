//! The film as an optical rig shows it: three lights reflected from both sides of the film.
//!
//! Fringes are narrower than the solver's nodes where the film is steep, so the film is interpolated
//! (bilinearly) to [`FINER`] pixels per node before it is coloured; only the surroundings of the
//! contact are drawn. One byte per pixel: the class of a colour table of 5 nm steps, whose labels are
//! the thickness.

use rerun::components::{ImageBuffer, ImageFormat};
use rerun::{AnnotationContext, AnnotationInfo, ChannelDatatype, Rgba32, SegmentationImage};

use super::colour::{GREY, LIGHTS_NM, REFRACTIVE_INDEX, WHITE, interference};
use super::geometry::Geometry;
use super::plot::{Labels, PlotBox, ticks_at};
use super::raster::{Pixels, log_styled};
use super::stream::Stream;
use super::waiting::ClassImage;
use crate::observe::ObserveError;
use crate::observe::scales::{number, ticks};
use crate::sim::Frame;

pub(super) const INTERFEROGRAM: &str = "maps/film_interferogram";
/// Pixels per node and direction.
const FINER: usize = 2;
/// Most nodes per direction that are drawn so fine; larger windows get one pixel per node.
const MOST_NODES: usize = 110;
/// Thickness of one colour, um.
const STEP_UM: f64 = 0.005;
/// Drawn: this many half-widths from the middle.
const REACH: f64 = 1.3;

/// The interferogram.
pub(super) struct Interferogram {
    geometry: Geometry,
    /// First node and number of nodes along x and y.
    from: [usize; 2],
    nodes: [usize; 2],
    finer: usize,
    plot: PlotBox,
    image: ClassImage,
}

impl Interferogram {
    pub(super) fn new(stream: &Stream, geometry: Geometry) -> Result<Self, ObserveError> {
        let g = geometry;
        let window = |n: usize, place: &dyn Fn(usize) -> f64, reach: f64| {
            let from = (0..n).find(|&k| place(k) >= -reach).unwrap_or(0);
            let count = (from..n).take_while(|&k| place(k) <= reach).count();
            (from, count.max(1))
        };
        let (from_x, nodes_x) = window(g.nx, &|i| g.x(i), REACH * g.a);
        let (from_y, nodes_y) = window(g.ny, &|j| g.y(j), REACH * g.b);
        let finer = if nodes_x.max(nodes_y) <= MOST_NODES {
            FINER
        } else {
            1
        };
        let mut picture = Self {
            geometry,
            from: [from_x, from_y],
            nodes: [nodes_x, nodes_y],
            finer,
            plot: PlotBox::default(),
            image: stream.class_image(entity()),
        };
        picture.plot = picture.plot_box();
        picture.log_static(stream)?;
        Ok(picture)
    }

    pub(super) fn plot(&self) -> &PlotBox {
        &self.plot
    }

    /// Logs one frame.
    pub(super) fn log(&self, stream: &Stream, frame: &Frame) -> Result<(), ObserveError> {
        let pixels = self.pixels();
        let mut nodes = Vec::with_capacity(self.nodes[0]);
        let mut parts = vec![0; self.nodes[0] - 1];
        stream.log_classes(self.image, |classes| {
            classes.reserve(pixels.columns * pixels.rows);
            for row in (0..pixels.rows).rev() {
                self.nodes_of(&frame.film_m, row, &mut nodes);
                let from = classes.len();
                // The last pixel lies on a node.
                classes.resize(
                    from + pixels.columns,
                    nodes.last().map_or(0, |&last| class(last)),
                );
                for part in 0..self.finer {
                    classify(&nodes, part as f32 / self.finer as f32, &mut parts);
                    let out = classes[from + part..].iter_mut().step_by(self.finer);
                    out.zip(&parts).for_each(|(out, &class)| *out = class);
                }
            }
        })
    }

    /// The film at the nodes' x on a row of pixels, m; rows count from the least y.
    fn nodes_of(&self, film_m: &[f32], row: usize, nodes: &mut Vec<f32>) {
        let (j, part) = (self.from[1] + row / self.finer, row % self.finer);
        let at = j * self.geometry.nx + self.from[0];
        let low = &film_m[at..at + self.nodes[0]];
        nodes.clear();
        if part == 0 {
            // Also of the last row, beyond which nothing may be read.
            nodes.extend_from_slice(low);
            return;
        }
        let high = &film_m[at + self.geometry.nx..][..self.nodes[0]];
        let weight = part as f32 / self.finer as f32;
        let pairs = low.iter().zip(high);
        nodes.extend(pairs.map(|(low, high)| low + (high - low) * weight));
    }

    fn pixels(&self) -> Pixels {
        let g = self.geometry;
        let finer = self.finer as f64;
        let last_y = g.y(self.from[1] + self.nodes[1] - 1);
        Pixels {
            columns: (self.nodes[0] - 1) * self.finer + 1,
            rows: (self.nodes[1] - 1) * self.finer + 1,
            first: [g.x(self.from[0]), -last_y],
            size: [g.dx / finer, g.dy / finer],
        }
    }

    fn plot_box(&self) -> PlotBox {
        let Pixels {
            columns,
            rows,
            first,
            size,
        } = self.pixels();
        let edges = |first: f64, size: f64, n: usize| {
            let low = first - 0.5 * size;
            [low, low + size * n as f64]
        };
        let (x, y) = (
            edges(first[0], size[0], columns),
            edges(first[1], size[1], rows),
        );
        let lights = LIGHTS_NM.map(|nm| format!("{nm}")).join(", ");
        PlotBox {
            x,
            y,
            x_ticks: ticks_at(&ticks(x[0], x[1], 4), |x| x),
            left_ticks: ticks_at(&ticks(-y[1], -y[0], 4), |y| -y),
            x_title: "x, mm  (rolling direction →)".into(),
            titles: vec![
                (0.1, "y, mm".into(), WHITE),
                (0.55, format!("{lights} nm, n = {REFRACTIVE_INDEX}"), GREY),
            ],
            ..PlotBox::default()
        }
    }

    fn log_static(&self, stream: &Stream) -> Result<(), ObserveError> {
        let pixels = self.pixels();
        log_styled(stream, &entity(), &styled(&pixels), &pixels)?;
        let context = AnnotationContext::new((0..256_u16).map(|class| {
            let [r, g, b] = interference(thickness_um(class));
            AnnotationInfo {
                id: class,
                label: Some(format!("h = {:.3} um", thickness_um(class)).into()),
                color: Some(Rgba32::from_rgb(r, g, b)),
            }
        }));
        stream.log_static(INTERFEROGRAM, &context)?;
        self.plot.log(stream, &format!("{INTERFEROGRAM}/axes"))?;
        self.log_legend(stream)
    }

    /// The colours against thickness, upwards as in the other maps' legends.
    fn log_legend(&self, stream: &Stream) -> Result<(), ObserveError> {
        let plot = &self.plot;
        let (w, h) = (plot.x[1] - plot.x[0], plot.y[1] - plot.y[0]);
        let (left, wide) = (plot.x[1] + 0.04 * w, 0.035 * w);
        let bar = Pixels {
            columns: 1,
            rows: 255,
            first: [left + 0.5 * wide, plot.y[0] + 0.5 * h / 255.0],
            size: [wide, h / 255.0],
        };
        let entity = format!("{INTERFEROGRAM}/legend/bar");
        let ramp: Vec<u8> = (1..=255).rev().collect();
        let image = styled(&bar).with_buffer(ImageBuffer::from(ramp));
        log_styled(stream, &entity, &image, &bar)?;
        let mut labels = Labels::default();
        let top = 255.0 * STEP_UM;
        for value in ticks(0.0, top, 5) {
            let y = plot.y[1] - h * value / top;
            labels.add([left + 0.12 * w, y - 0.022 * h], &number(value), WHITE);
        }
        labels.add([left + 0.06 * w, plot.y[0] - 0.085 * h], "h, µm", WHITE);
        labels.log(stream, &format!("{INTERFEROGRAM}/legend/labels"))
    }
}

fn entity() -> String {
    format!("{INTERFEROGRAM}/image")
}

fn styled(pixels: &Pixels) -> SegmentationImage {
    let format = ImageFormat::segmentation(pixels.resolution(), ChannelDatatype::U8);
    SegmentationImage::update_fields()
        .with_format(format)
        .with_opacity(1.0)
}

dispatched! {
    /// Classes of the film at that part of the way from each node to the next.
    fn classify(nodes: &[f32], part: f32, out: &mut [u8]) {
        for (out, (low, high)) in out.iter_mut().zip(nodes.iter().zip(&nodes[1..])) {
            *out = class(low + (high - low) * part);
        }
    }
}

/// The colour of a film: class 1 is no film, 255 the thickest. Class 0 is left out because viewers
/// may draw it transparent.
#[inline]
fn class(film_m: f32) -> u8 {
    (film_m * (1e6 / STEP_UM) as f32 + 1.0).clamp(1.0, 255.0) as u8
}

fn thickness_um(class: u16) -> f64 {
    STEP_UM * (f64::from(class) - 0.5).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_class_holds_the_films_of_its_step() {
        assert_eq!(class(0.0), 1);
        assert_eq!(class(1.0), 255);
        for k in 2..254 {
            let film_um = thickness_um(k);
            assert_eq!(u16::from(class((film_um * 1e-6) as f32)), k);
        }
    }
}
