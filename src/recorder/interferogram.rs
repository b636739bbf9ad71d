//! The film as an optical rig shows it ([`asperity_picture::interferogram`] has the colours).
//!
//! Fringes are narrower than the solver's nodes where the film is steep, so the film is interpolated
//! (bilinearly) to [`FINER`] pixels per node before it is coloured; only the surroundings of the
//! contact are drawn. One byte per pixel: a class of a colour table, whose labels are the thickness.
//!
//! ```text
//! class   1 to 200    h in steps of 5 nm, where it rises by less than 80 nm over a pixel
//!       201 to 250    in steps of 20 nm, up to 165 nm: half of the contrast is left
//!             251     grey: above 1 µm, or steeper
//! ```

use rerun::components::{ImageBuffer, ImageFormat};
use rerun::{AnnotationContext, AnnotationInfo, ChannelDatatype, Rgba32, SegmentationImage};

use super::classes;
use super::entities::maps::INTERFEROGRAM;
use super::geometry::Geometry;
use super::picture::{PixelField, log_styled};
use super::plot::{HALF_LABEL, Labels, PlotBox, TITLES, ticks_at};
use super::stream::{Holds, Stream};
use asperity_engine::math::number::{plain, ticks};
use asperity_engine::sim::Frame;
use asperity_picture::interferogram::{LIGHTS_NM, REFRACTIVE_INDEX, TOP_M, colour};

/// Pixels per node and direction.
const FINER: usize = 2;
/// Most nodes per direction that are drawn so fine; larger windows get one pixel per node.
const MOST_NODES: usize = 110;
/// Classes of films that rise little over a pixel; the first is no film. Class 0 is left out because viewers may
/// draw it transparent.
const SHARP: u8 = 200;
/// Classes of those that rise more, after them.
const BLURRED: u8 = 50;
/// The one that shows no fringe.
const FLAT: u8 = SHARP + BLURRED + 1;
/// Rise over a pixel up to which classes are sharp, that of the blurred ones, and that from which nothing is left, m.
const RISES_M: [f32; 3] = [80e-9, 120e-9, 165e-9];
/// Drawn: this many half-widths from the middle.
const REACH: f64 = 1.3;

/// The interferogram.
pub(crate) struct Interferogram {
    geometry: Geometry,
    /// First node and number of nodes along x and y.
    from: [usize; 2],
    nodes: [usize; 2],
    finer: usize,
    plot: PlotBox,
}

impl Interferogram {
    pub(crate) fn new(stream: &Stream, geometry: Geometry) -> Self {
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
        };
        picture.plot = picture.plot_box();
        picture.log_static(stream);
        picture
    }

    pub(crate) fn plot(&self) -> &PlotBox {
        &self.plot
    }

    /// Logs one frame.
    pub(crate) fn log(&self, stream: &Stream, frame: &Frame) {
        let pixels = self.pixels();
        let (mut nodes, mut across) = (Vec::new(), Vec::new());
        let mut parts = vec![0; self.nodes[0] - 1];
        let mut image = Vec::with_capacity(pixels.columns * pixels.rows);
        for row in (0..pixels.rows).rev() {
            self.nodes_of(&frame.film_m, row, &mut nodes, &mut across);
            let from = image.len();
            // The last pixel lies on a node.
            let last = nodes.last().zip(across.last());
            let last = last.map_or(FLAT, |(film, rise)| class(*film, *rise));
            image.resize(from + pixels.columns, last);
            for part in 0..self.finer {
                classify(&nodes, &across, [part, self.finer], &mut parts);
                let out = image[from + part..].iter_mut().step_by(self.finer);
                out.zip(&parts).for_each(|(out, &class)| *out = class);
            }
        }
        classes::log(stream, &entity(), image);
    }

    /// The film at the nodes' x on a row of pixels, m, and its rise across a pixel along y; rows count from the
    /// smallest y.
    fn nodes_of(&self, film_m: &[f32], row: usize, nodes: &mut Vec<f32>, across: &mut Vec<f32>) {
        let (j, part) = (self.from[1] + row / self.finer, row % self.finer);
        let row_of = |j: usize| &film_m[j * self.geometry.nx + self.from[0]..][..self.nodes[0]];
        // From the last row, beyond which nothing may be read, one looks back.
        let is_last = row / self.finer + 1 >= self.nodes[1];
        let low = row_of(j);
        let other = if is_last {
            row_of(j.saturating_sub(1))
        } else {
            row_of(j + 1)
        };
        let pixel = 1.0 / self.finer as f32;
        let weight = if is_last { 0.0 } else { part as f32 * pixel };
        nodes.clear();
        across.clear();
        let pairs = low.iter().zip(other);
        nodes.extend(
            pairs
                .clone()
                .map(|(low, other)| low + (other - low) * weight),
        );
        across.extend(pairs.map(|(low, other)| (other - low) * pixel));
    }

    fn pixels(&self) -> PixelField {
        let g = self.geometry;
        let finer = self.finer as f64;
        let last_y = g.y(self.from[1] + self.nodes[1] - 1);
        PixelField {
            columns: (self.nodes[0] - 1) * self.finer + 1,
            rows: (self.nodes[1] - 1) * self.finer + 1,
            first: [g.x(self.from[0]), -last_y],
            size: [g.dx / finer, g.dy / finer],
        }
    }

    fn plot_box(&self) -> PlotBox {
        let PixelField {
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
        let lights = format!("{lights} nm, n = {REFRACTIVE_INDEX}");
        // Beside a narrow picture there is no room above it.
        let is_narrow = x[1] - x[0] < 0.4 * (y[1] - y[0]);
        let (x_title, above) = if is_narrow {
            (format!("x, mm; {lights}"), None)
        } else {
            (
                "x, mm  (rolling direction →)".into(),
                Some((0.55, lights, None)),
            )
        };
        PlotBox {
            x,
            y,
            x_ticks: ticks_at(&ticks(x[0], x[1], if is_narrow { 2 } else { 4 }), |x| x),
            left_ticks: ticks_at(&ticks(-y[1], -y[0], 4), |y| -y),
            x_title,
            titles: std::iter::once((0.1, "y, mm".into(), None))
                .chain(above)
                .collect(),
            ..PlotBox::default()
        }
    }

    fn log_static(&self, stream: &Stream) {
        let pixels = self.pixels();
        log_styled(stream, &entity(), &styled(&pixels), &pixels);
        let context = AnnotationContext::new((1..=FLAT).map(|class| {
            let (film_m, rise_m) = film_of(class);
            let [r, g, b] = colour(film_m, rise_m);
            let label = if class == FLAT {
                "no fringe: h above 1 µm, or too steep".to_owned()
            } else {
                format!("h = {:.3} µm", film_m * 1e6)
            };
            AnnotationInfo {
                id: u16::from(class),
                label: Some(label.into()),
                color: Some(Rgba32::from_rgb(r, g, b)),
            }
        }));
        stream.log_static(INTERFEROGRAM, &context);
        self.plot
            .log(stream, &format!("{INTERFEROGRAM}/axes"), Holds::Always);
        self.log_legend(stream);
    }

    /// The colours against thickness, upwards as in the other maps' legends.
    fn log_legend(&self, stream: &Stream) {
        let plot = &self.plot;
        let (w, h) = (plot.beside(), plot.y[1] - plot.y[0]);
        let (left, wide) = (plot.x[1] + 0.04 * w, 0.035 * w);
        let bar = PixelField {
            columns: 1,
            rows: usize::from(SHARP),
            first: [left + 0.5 * wide, plot.y[0] + 0.5 * h / f64::from(SHARP)],
            size: [wide, h / f64::from(SHARP)],
        };
        let entity = format!("{INTERFEROGRAM}/legend/bar");
        let ramp: Vec<u8> = (1..=SHARP).rev().collect();
        let image = styled(&bar).with_buffer(ImageBuffer::from(ramp));
        log_styled(stream, &entity, &image, &bar);
        let mut labels = Labels::default();
        let top = f64::from(TOP_M) * 1e6;
        for value in ticks(0.0, top, 5) {
            let y = plot.y[1] - h * value / top;
            labels.add([left + 0.115 * w, y - HALF_LABEL * h], &plain(value));
        }
        labels.add([left + 0.05 * w, plot.y[0] - TITLES * h], "h, µm");
        labels.log(
            stream,
            &format!("{INTERFEROGRAM}/legend/labels"),
            Holds::Always,
        );
    }
}

fn entity() -> String {
    format!("{INTERFEROGRAM}/image")
}

fn styled(pixels: &PixelField) -> SegmentationImage {
    let format = ImageFormat::segmentation(pixels.resolution(), ChannelDatatype::U8);
    SegmentationImage::update_fields()
        .with_format(format)
        .with_opacity(1.0)
}

dispatched! {
    /// Classes of the film at that part of the way from each node to the next: `part` of so many pixels.
    fn classify(nodes: &[f32], across: &[f32], part: [usize; 2], out: &mut [u8]) {
        let pixel = 1.0 / part[1] as f32;
        let at = part[0] as f32 * pixel;
        let pairs = nodes.iter().zip(&nodes[1..]).zip(across);
        for (out, ((low, high), across)) in out.iter_mut().zip(pairs) {
            let along = (high - low) * pixel;
            let rise = (along * along + across * across).sqrt();
            *out = class(low + (high - low) * at, rise);
        }
    }
}

/// The class of a film that rises by so much over a pixel, m.
#[inline]
fn class(film_m: f32, rise_m: f32) -> u8 {
    let rise_m = rise_m.abs();
    let share = film_m.max(0.0) / TOP_M;
    if share >= 1.0 || rise_m >= RISES_M[2] {
        FLAT
    } else if rise_m < RISES_M[0] {
        1 + (share * f32::from(SHARP)) as u8
    } else {
        1 + SHARP + (share * f32::from(BLURRED)) as u8
    }
}

/// The film in the middle of a class, and its rise over a pixel, m.
fn film_of(class: u8) -> (f32, f32) {
    let middle = |place: u8, of: u8| TOP_M * (f32::from(place) + 0.5) / f32::from(of);
    match class {
        0 | 1 => (0.0, 0.0),
        2..=SHARP => (middle(class - 1, SHARP), 0.0),
        FLAT.. => (f32::INFINITY, 0.0),
        _ => (middle(class - 1 - SHARP, BLURRED), RISES_M[1]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_class_holds_the_films_of_its_step() {
        assert_eq!((class(0.0, 0.0), class(1.0, 0.0)), (1, FLAT));
        assert_eq!(class(0.3e-6, -1e-6), FLAT);
        for k in 2..FLAT {
            let (film_m, rise_m) = film_of(k);
            assert_eq!(class(film_m, rise_m), k, "{film_m} {rise_m}");
        }
        // Half of the contrast of green is left in the blurred ones.
        let [_, dark, _] = colour(0.0, RISES_M[1]);
        assert!((50..90).contains(&dark), "{dark}");
    }
}
