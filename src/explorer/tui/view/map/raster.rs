//! From the nodes of a frame to the pixels of the picture: the mean of the nodes in a pixel, or,
//! where pixels are finer than nodes, linear interpolation between them.

use std::ops::RangeInclusive;

use crate::tui::kymograph::CentreValues;
use asperity_engine::scene::ContactKind;
use asperity_engine::sim::Frame;
use asperity_picture::{NodeAxis, Picture};

/// A part of the plane in half-widths: x/a and y/b, or x/a and z/a below the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct MapWindow {
    /// Left and right.
    pub(super) x: [f64; 2],
    /// Top and bottom.
    pub(super) y: [f64; 2],
}

impl MapWindow {
    /// x at a part (0 to 1) of the width.
    pub(super) fn x_at(&self, part: f64) -> f64 {
        self.x[0] + (self.x[1] - self.x[0]) * part
    }

    /// Parts of the width and of the height from the left upper corner; `None` outside.
    pub(super) fn part(&self, x: f64, y: f64) -> Option<[f64; 2]> {
        let part = |value: f64, [from, to]: [f64; 2]| (value - from) / (to - from);
        let parts = [part(x, self.x), part(y, self.y)];
        let inside = parts.iter().all(|part| (0.0..1.0).contains(part));
        inside.then_some(parts)
    }

    /// y (or depth) at a part of the height.
    pub(super) fn y_at(&self, part: f64) -> f64 {
        self.y[0] + (self.y[1] - self.y[0]) * part
    }
}

/// Values at pixels, row by row.
pub(super) struct Raster {
    pub(super) columns: usize,
    pub(super) rows: usize,
    values: Vec<f32>,
    spots: Vec<bool>,
    /// Of an interferogram.
    fringes: Vec<[u8; 3]>,
    kind: ContactKind,
}

impl Raster {
    /// Value of a pixel.
    pub(super) fn at(&self, column: usize, row: usize) -> f32 {
        let place = row * self.columns + column;
        self.values.get(place).copied().unwrap_or(0.0)
    }

    /// How far from the middle a place is, 1 on the edge of Hertz's contact: an ellipse, or two lines.
    pub(super) fn distance(&self, x: f64, y: f64) -> f64 {
        match self.kind {
            ContactKind::Point => x.hypot(y),
            ContactKind::Line => x.abs(),
        }
    }

    /// Colour of a pixel of an interferogram.
    pub(super) fn fringe(&self, column: usize, row: usize) -> [u8; 3] {
        let place = row * self.columns + column;
        self.fringes.get(place).copied().unwrap_or([0; 3])
    }

    /// Whether any node of a pixel is in contact.
    pub(super) fn spot(&self, column: usize, row: usize) -> bool {
        let place = row * self.columns + column;
        self.spots.get(place).copied().unwrap_or(false)
    }
}

/// Nodes that a pixel draws on along one axis, as places and weights of the outer two.
#[derive(Debug, Clone, Copy)]
struct PixelSpan {
    first: usize,
    last: usize,
    /// Weight of `last` where only two nodes count.
    part: f32,
    mean: bool,
}

/// Places of pixels in half-widths, among the nodes.
fn along(picture: &Picture, window: &MapWindow, columns: usize) -> Option<Vec<PixelSpan>> {
    let (_, [a_m, _]) = picture.hertz;
    spans(columns, window.x, picture.x.nodes(), &|x| {
        picture.x.place(x * a_m)
    })
}

impl PixelSpan {
    /// Nodes whose contact it shows: a single spot must not vanish between pixels, so any node in the pixel, or the
    /// nearest one.
    fn nodes(&self) -> RangeInclusive<usize> {
        if self.mean {
            self.first..=self.last
        } else if self.part < 0.5 {
            self.first..=self.first
        } else {
            self.last..=self.last
        }
    }
}

/// Rasterises a picture; `None` where it is too small.
pub(super) fn rasterize(
    picture: &Picture,
    window: &MapWindow,
    (columns, rows): (usize, usize),
) -> Option<Raster> {
    let (kind, [a_m, b_m]) = picture.hertz;
    let half_m = if picture.is_below { a_m } else { b_m };
    let x = |x: f64| picture.x.place(x * a_m);
    let y = |y: f64| picture.y.place(y * half_m);
    let along = along(picture, window, columns)?;
    let down = spans(rows, window.y, picture.y.nodes(), &y)?;
    let mut fringes = Vec::new();
    if let Some(film) = picture.film() {
        let along = cells(columns, window.x, &x);
        for y in cells(rows, window.y, &y) {
            fringes.extend(along.iter().map(|x| film.cell(*x, y)));
        }
    }
    let spots = if picture.look.marks_contact {
        contacts(picture, &along, &down)
    } else {
        Vec::new()
    };
    Some(Raster {
        columns,
        rows,
        values: values(picture, &along, &down),
        spots,
        fringes,
        kind,
    })
}

/// Rasterises lines along x, one a row of pixels; a row without a line is blank (no number).
pub(super) fn rasterize_lines<'a>(
    picture: &Picture,
    window: &MapWindow,
    (columns, rows): (usize, usize),
    line: impl Fn(f64) -> Option<CentreValues<'a>>,
) -> Option<Raster> {
    let along = along(picture, window, columns)?;
    let mut values = Vec::with_capacity(columns * rows);
    let mut spots = Vec::with_capacity(columns * rows);
    for row in 0..rows {
        let (line, contact) =
            line(window.y_at((row as f64 + 0.5) / rows as f64)).unwrap_or_default();
        values.extend(
            along
                .iter()
                .map(|span| over(span, |i| line.get(i).copied().unwrap_or(f32::NAN))),
        );
        spots.extend(
            along
                .iter()
                .map(|span| span.nodes().any(|i| contact.get(i) == Some(&1))),
        );
    }
    Some(Raster {
        columns,
        rows,
        values,
        spots,
        fringes: Vec::new(),
        kind: picture.hertz.0,
    })
}

/// Pressure and film at a place in half-widths.
pub(super) fn plane_at(frame: &Frame, x: f64, y: f64) -> Option<(f32, f32)> {
    let i = node_at(frame, x)?;
    let j = nearest((y * frame.b_m - frame.y_min_m) / frame.dy_m, frame.ny)?;
    let place = j * frame.nx + i;
    Some((*frame.pressure_pa.get(place)?, *frame.film_m.get(place)?))
}

/// The node along x nearest to a place in half-widths.
pub(super) fn node_at(frame: &Frame, x: f64) -> Option<usize> {
    nearest((x * frame.a_m - frame.x_min_m) / frame.dx_m, frame.nx)
}

/// Stress at a place in half-widths.
pub(super) fn stress_at(frame: &Frame, x: f64, z: f64) -> Option<f32> {
    let slice = frame.slice.as_ref()?;
    let i = nearest((x * frame.a_m - frame.x_min_m) / frame.dx_m, frame.nx)?;
    let place = NodeAxis::Uneven(&slice.depths_m).place(z * frame.a_m);
    let k = nearest(place, slice.depths_m.len())?;
    slice.effective_pa.get(k * frame.nx + i).copied()
}

fn nearest(place: f64, nodes: usize) -> Option<usize> {
    let place = place.round();
    (place >= 0.0 && place < nodes as f64).then_some(place as usize)
}

/// From where to where each pixel reaches, in nodes.
fn cells(pixels: usize, window: [f64; 2], place: &dyn Fn(f64) -> f64) -> Vec<[f64; 2]> {
    let at = |pixel: usize| {
        let part = pixel as f64 / pixels as f64;
        place(window[0] + (window[1] - window[0]) * part)
    };
    (0..pixels)
        .map(|pixel| [at(pixel), at(pixel + 1)])
        .collect()
}

fn spans(
    pixels: usize,
    window: [f64; 2],
    nodes: usize,
    place: &dyn Fn(f64) -> f64,
) -> Option<Vec<PixelSpan>> {
    if nodes < 2 || pixels == 0 {
        return None;
    }
    let cells = cells(pixels, window, place);
    let spans = cells.into_iter().map(|[one, two]| {
        let (from, to) = (one.min(two), one.max(two));
        let (first, last) = (from.ceil() as usize, to.floor() as usize);
        if last > first {
            return PixelSpan {
                first,
                last: last.min(nodes - 1),
                part: 0.0,
                mean: true,
            };
        }
        let middle = 0.5 * (from + to);
        let first = (middle as usize).min(nodes - 2);
        PixelSpan {
            first,
            last: first + 1,
            part: (middle - first as f64) as f32,
            mean: false,
        }
    });
    Some(spans.collect())
}

fn values(picture: &Picture, along: &[PixelSpan], down: &[PixelSpan]) -> Vec<f32> {
    let rows = down.iter().flat_map(|vertical| {
        along
            .iter()
            .map(move |horizontal| over(vertical, |j| over(horizontal, |i| picture.at(i, j))))
    });
    rows.collect()
}

fn over(span: &PixelSpan, at: impl Fn(usize) -> f32) -> f32 {
    if span.mean {
        let sum: f32 = (span.first..=span.last).map(at).sum();
        sum / (span.last - span.first + 1) as f32
    } else {
        let (first, last) = (at(span.first), at(span.last));
        first + (last - first) * span.part
    }
}

/// Which pixels hold asperity contact.
fn contacts(picture: &Picture, along: &[PixelSpan], down: &[PixelSpan]) -> Vec<bool> {
    let rows = down.iter().flat_map(|vertical| {
        along.iter().map(move |horizontal| {
            vertical
                .nodes()
                .any(|j| horizontal.nodes().any(|i| picture.touches(i, j)))
        })
    });
    rows.collect()
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "tests")]
    use super::*;
    use asperity_picture::{Ranges, Subject};

    /// A field that is x on a 9 by 5 grid, x/a and y/b from −1 to 1.
    fn ramp() -> Frame {
        let (nx, ny) = (9, 5);
        let mut frame = Frame {
            nx,
            ny,
            a_m: 1.0,
            b_m: 1.0,
            x_min_m: -1.0,
            dx_m: 0.25,
            y_min_m: -1.0,
            dy_m: 0.5,
            contact: vec![0; nx * ny],
            ..Frame::default()
        };
        frame.pressure_pa = (0..nx * ny)
            .map(|place| (place % nx) as f32 * 0.25 - 1.0)
            .collect();
        frame
    }

    const ALL: MapWindow = MapWindow {
        x: [-1.0, 1.0],
        y: [-1.0, 1.0],
    };

    #[test]
    fn a_linear_field_stays_linear_at_any_resolution() {
        let frame = ramp();
        let picture = Picture::of(&frame, Subject::Pressure, &Ranges::default()).unwrap();
        for columns in [3, 8, 9, 40] {
            let raster = rasterize(&picture, &ALL, (columns, 4)).unwrap();
            for column in 0..columns {
                let centre = ALL.x_at((column as f64 + 0.5) / columns as f64) as f32;
                // Means over nodes are off by at most half a node.
                let off = (raster.at(column, 2) - centre).abs();
                assert!(off < 0.126, "{columns}: {column}: {off}");
            }
        }
    }

    #[test]
    fn a_single_spot_is_never_lost() {
        let mut frame = ramp();
        frame.contact[2 * 9 + 4] = 1;
        for columns in [2, 3, 5, 9, 30] {
            let picture = Picture::of(&frame, Subject::Contact, &Ranges::default()).unwrap();
            let raster = rasterize(&picture, &ALL, (columns, 3)).unwrap();
            let seen = (0..columns).any(|column| (0..3).any(|row| raster.spot(column, row)));
            assert!(seen, "{columns}");
        }
    }

    #[test]
    fn a_frame_without_a_slice_has_no_stress_map() {
        let of = |frame: &Frame, subject| Picture::of(frame, subject, &Ranges::default()).is_some();
        assert!(!of(&ramp(), Subject::EffectiveStress));
        assert!(!of(&Frame::default(), Subject::Film));
    }
}
