//! From the nodes of a frame to the pixels of the picture: the mean of the nodes in a pixel, or,
//! where pixels are finer than nodes, linear interpolation between them.

use crate::observe::interferogram::Film;
use crate::scene::ContactKind;
use crate::sim::Frame;
use crate::tui::app::MapKind;

/// A part of the plane in half-widths: x/a and y/b, or x/a and z/a below the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Window {
    /// Left and right.
    pub(super) x: [f64; 2],
    /// Top and bottom.
    pub(super) y: [f64; 2],
}

impl Window {
    /// x at a part (0 to 1) of the width.
    pub(super) fn x_at(&self, part: f64) -> f64 {
        self.x[0] + (self.x[1] - self.x[0]) * part
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

/// Rasterises a map; `None` where the frame does not hold it.
pub(super) fn rasterize(
    frame: &Frame,
    kind: MapKind,
    window: &Window,
    columns: usize,
    rows: usize,
) -> Option<Raster> {
    let x = axis_of(frame.x_min_m / frame.a_m, frame.dx_m / frame.a_m, frame.nx);
    let along = spans(columns, window.x, frame.nx, &x)?;
    if kind == MapKind::Stress {
        let slice = frame.slice.as_ref()?;
        let depths = &slice.depths_m;
        let place = |z: f64| place_among(depths, z * frame.a_m);
        let down = spans(rows, window.y, depths.len(), &place)?;
        let values = values(&slice.effective_pa, frame.nx, &along, &down);
        return Some(Raster {
            columns,
            rows,
            values,
            spots: Vec::new(),
            fringes: Vec::new(),
            kind: frame.kind,
        });
    }
    let y = axis_of(frame.y_min_m / frame.b_m, frame.dy_m / frame.b_m, frame.ny);
    let down = spans(rows, window.y, frame.ny, &y)?;
    let take = |field: &[f32]| values(field, frame.nx, &along, &down);
    let (mut spots, mut fringes) = (Vec::new(), Vec::new());
    let values = match kind {
        MapKind::Pressure | MapKind::Stress | MapKind::PressureWaves => take(&frame.pressure_pa),
        MapKind::Film | MapKind::FilmWaves => take(&frame.film_m),
        MapKind::Fringes => {
            let film = Film::new(&frame.film_m, frame.nx, frame.ny)?;
            let along = cells(columns, window.x, &x);
            for y in cells(rows, window.y, &y) {
                fringes.extend(along.iter().map(|x| film.cell(*x, y)));
            }
            take(&frame.film_m)
        }
        MapKind::Roughness => take(&frame.roughness_1_m)
            .into_iter()
            .zip(take(&frame.roughness_2_m))
            .map(|(first, second)| first + second)
            .collect(),
        MapKind::Contact => {
            spots = touching(frame, &along, &down);
            take(&frame.pressure_pa)
        }
    };
    Some(Raster {
        columns,
        rows,
        values,
        spots,
        fringes,
        kind: frame.kind,
    })
}

/// Rasterises lines along x, one a row of pixels; a row without a line is blank (no number).
pub(super) fn rasterize_lines<'a>(
    frame: &Frame,
    window: &Window,
    (columns, rows): (usize, usize),
    line: impl Fn(f64) -> Option<&'a [f32]>,
) -> Option<Raster> {
    let x = axis_of(frame.x_min_m / frame.a_m, frame.dx_m / frame.a_m, frame.nx);
    let along = spans(columns, window.x, frame.nx, &x)?;
    let mut values = Vec::with_capacity(columns * rows);
    for row in 0..rows {
        let line = line(window.y_at((row as f64 + 0.5) / rows as f64));
        values.extend(along.iter().map(|span| {
            line.map_or(f32::NAN, |line| {
                over(span, |i| line.get(i).copied().unwrap_or(f32::NAN))
            })
        }));
    }
    Some(Raster {
        columns,
        rows,
        values,
        spots: Vec::new(),
        fringes: Vec::new(),
        kind: frame.kind,
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
    let place = place_among(&slice.depths_m, z * frame.a_m);
    let k = nearest(place, slice.depths_m.len())?;
    slice.effective_pa.get(k * frame.nx + i).copied()
}

fn nearest(place: f64, nodes: usize) -> Option<usize> {
    let place = place.round();
    (place >= 0.0 && place < nodes as f64).then_some(place as usize)
}

/// Place of a coordinate among evenly spaced nodes.
fn axis_of(start: f64, spacing: f64, nodes: usize) -> impl Fn(f64) -> f64 {
    move |x| ((x - start) / spacing).clamp(0.0, nodes.saturating_sub(1) as f64)
}

/// Place of a depth among depths that grow unevenly.
fn place_among(depths: &[f64], z: f64) -> f64 {
    let above = depths.partition_point(|depth| *depth <= z);
    match (
        above.checked_sub(1).and_then(|k| depths.get(k)),
        depths.get(above),
    ) {
        (Some(upper), Some(lower)) => (above - 1) as f64 + (z - upper) / (lower - upper),
        (None, _) => 0.0,
        (Some(_), None) => depths.len() as f64 - 1.0,
    }
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
    let spans = cells.into_iter().map(|[from, to]| {
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

fn values(field: &[f32], nx: usize, along: &[PixelSpan], down: &[PixelSpan]) -> Vec<f32> {
    let mut values = Vec::with_capacity(along.len() * down.len());
    for vertical in down {
        for horizontal in along {
            values.push(over(vertical, |j| {
                let row = field.get(j * nx..(j + 1) * nx).unwrap_or(&[]);
                over(horizontal, |i| row.get(i).copied().unwrap_or(0.0))
            }));
        }
    }
    values
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

/// A single spot must not vanish between pixels: any node in the pixel, or the nearest one.
fn touching(frame: &Frame, along: &[PixelSpan], down: &[PixelSpan]) -> Vec<bool> {
    let reach = |span: &PixelSpan| {
        if span.mean {
            span.first..=span.last
        } else {
            let node = if span.part < 0.5 {
                span.first
            } else {
                span.last
            };
            node..=node
        }
    };
    let mut spots = Vec::with_capacity(along.len() * down.len());
    for vertical in down {
        for horizontal in along {
            spots.push(reach(vertical).any(|j| {
                reach(horizontal).any(|i| frame.contact.get(j * frame.nx + i) == Some(&1))
            }));
        }
    }
    spots
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "tests")]
    use super::*;

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

    const ALL: Window = Window {
        x: [-1.0, 1.0],
        y: [-1.0, 1.0],
    };

    #[test]
    fn a_linear_field_stays_linear_at_any_resolution() {
        for columns in [3, 8, 9, 40] {
            let raster = rasterize(&ramp(), MapKind::Pressure, &ALL, columns, 4).unwrap();
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
            let raster = rasterize(&frame, MapKind::Contact, &ALL, columns, 3).unwrap();
            let seen = (0..columns).any(|column| (0..3).any(|row| raster.spot(column, row)));
            assert!(seen, "{columns}");
        }
    }

    #[test]
    fn a_frame_without_a_slice_has_no_stress_map() {
        assert!(rasterize(&ramp(), MapKind::Stress, &ALL, 4, 4).is_none());
        assert!(rasterize(&Frame::default(), MapKind::Film, &ALL, 4, 4).is_none());
    }

    #[test]
    fn uneven_depths() {
        let depths = [0.0, 0.1, 0.4, 1.0];
        assert_eq!(place_among(&depths, 0.0), 0.0);
        assert!((place_among(&depths, 0.25) - 1.5).abs() < 1e-12);
        assert_eq!(place_among(&depths, 5.0), 3.0);
        assert_eq!(place_among(&[], 1.0), 0.0);
    }
}
