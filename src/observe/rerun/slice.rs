//! The plane y = 0 below body 1's surface: x to the right, depth down, both to the same scale.
//!
//! The solver's depths are not equally spaced; the images are linear interpolations between them on
//! rows of equal height, so that a millimetre of depth is as long as a millimetre of x.

use std::sync::Arc;

use rerun::components::Colormap;
use rerun::{LineStrips2D, Points2D, Radius};

use super::colour::{GREEN, WHITE, faded};
use super::geometry::Geometry;
use super::plot::{PlotBox, ticks_at};
use super::raster::{Field, Height, Pixels, Raster, Scale, Sign};
use super::stream::Stream;
use crate::observe::ObserveError;
use crate::observe::scales::{GPA, MM, Ranges, number, ticks};
use crate::sim::{Frame, StressSlice};

pub(super) const EFFECTIVE: &str = "slice_y0/effective_stress_GPa";
pub(super) const TAU_XZ: &str = "slice_y0/tau_xz_GPa";
/// The followed material point.
pub(super) const POINT: &str = "slice_y0/material_point";
const POINT_NOW: &str = "slice_y0/material_point/now";
/// Where the stress is greatest.
pub(super) const PEAK: &str = "slice_y0/greatest_stress";

/// A row of an image between two of the solver's depths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Between {
    above: usize,
    below: usize,
    weight: f32,
}

/// Rows of equal height from the first to the last depth.
#[derive(Debug, Clone)]
pub(super) struct Rows {
    depths: Arc<[f64]>,
    first_mm: f64,
    height_mm: f64,
    between: Vec<Between>,
}

impl Rows {
    /// Rows about `height_mm` high over the depths down to `to_mm`; `None` for fewer than two
    /// depths or depths that do not increase.
    pub(super) fn new(depths: &Arc<[f64]>, height_mm: f64, to_mm: f64) -> Option<Self> {
        let (first, last) = (depths.first()? * MM, (depths.last()? * MM).min(to_mm));
        let increasing = depths.windows(2).all(|pair| pair[0] < pair[1]);
        if !(increasing && last > first && height_mm > 0.0) {
            return None;
        }
        // A picture needs no more rows than a screen has.
        let n = (((last - first) / height_mm).round() as usize).clamp(1, 512);
        let height = (last - first) / n as f64;
        let between = (0..=n)
            .map(|row| between(depths, (first + height * row as f64) / MM))
            .collect();
        Some(Self {
            depths: Arc::clone(depths),
            first_mm: first,
            height_mm: height,
            between,
        })
    }

    pub(super) fn len(&self) -> usize {
        self.between.len()
    }

    /// Whether the rows were made over these depths.
    pub(super) fn are_over(&self, depths: &Arc<[f64]>) -> bool {
        self.depths == *depths
    }

    pub(super) fn depth_mm(&self, row: usize) -> f64 {
        self.first_mm + self.height_mm * row as f64
    }

    /// Whether a frame's slice has the depths that were set up.
    pub(super) fn hold(&self, slice: &StressSlice, nx: usize) -> bool {
        let n = nx * self.depths.len();
        slice.depths_m == self.depths && slice.effective_pa.len() == n && slice.tau_xz_pa.len() == n
    }

    /// All rows of a field that is stored depth by depth, `nx` values each.
    pub(super) fn image(&self, field: &[f32], nx: usize) -> Vec<f32> {
        let mut image = Vec::with_capacity(nx * self.len());
        for &Between {
            above,
            below,
            weight,
        } in &self.between
        {
            let depth = |k: usize| &field[k * nx..(k + 1) * nx];
            let pairs = depth(above).iter().zip(depth(below));
            image.extend(pairs.map(|(one, two)| one * (1.0 - weight) + two * weight));
        }
        image
    }

    /// The value in column `i` of a row, of a field that is stored depth by depth.
    pub(super) fn value(&self, field: &[f32], nx: usize, row: usize, i: usize) -> f32 {
        let Between {
            above,
            below,
            weight,
        } = self.between[row];
        field[above * nx + i] * (1.0 - weight) + field[below * nx + i] * weight
    }
}

/// The two depths around a depth.
fn between(depths: &[f64], depth_m: f64) -> Between {
    let below = depths
        .partition_point(|&depth| depth < depth_m)
        .clamp(1, depths.len() - 1);
    let (z0, z1) = (depths[below - 1], depths[below]);
    Between {
        above: below - 1,
        below,
        weight: ((depth_m - z0) / (z1 - z0)).clamp(0.0, 1.0) as f32,
    }
}

/// The images of the slice.
pub(super) struct Slice {
    geometry: Geometry,
    rows: Rows,
    effective: Raster,
    tau_xz: Raster,
    plot: PlotBox,
    scales: [(&'static str, Scale); 2],
    /// Depth of the path that was logged last.
    path_m: Option<f64>,
}

impl Slice {
    /// Sets up the slice from the first frame; `None` where the scene computes none.
    pub(super) fn new(
        stream: &Stream,
        geometry: Geometry,
        first: &Frame,
        ranges: &Ranges,
    ) -> Result<Option<Self>, ObserveError> {
        let Some(slice) = &first.slice else {
            return Ok(None);
        };
        let Some(rows) = Rows::new(&slice.depths_m, geometry.dx, f64::INFINITY) else {
            return Ok(None);
        };
        let effective = Scale::up_to(
            ranges.effective_pa,
            GPA,
            Sign::Positive,
            Colormap::Magma,
            8.0,
        );
        let tau_xz = Scale::up_to(
            ranges.shear_pa,
            GPA,
            Sign::Both,
            Colormap::CyanToYellow,
            4.0,
        );
        let scales = [(EFFECTIVE, effective.clone()), (TAU_XZ, tau_xz.clone())];
        let pixels = Pixels {
            columns: geometry.nx,
            rows: rows.len(),
            first: [geometry.x_min, rows.first_mm],
            size: [geometry.dx, rows.height_mm],
        };
        let plot = plot_box(geometry, &rows);
        log_dots(stream)?;
        let image = |entity, scale, title| {
            Raster::new(stream, entity, scale, pixels, &plot, (title, Height::Fixed))
        };
        Ok(Some(Self {
            geometry,
            effective: image(EFFECTIVE, effective, "σ, GPa")?,
            tau_xz: image(TAU_XZ, tau_xz, "τxz, GPa")?,
            rows,
            plot,
            scales,
            path_m: None,
        }))
    }

    pub(super) fn plot(&self) -> &PlotBox {
        &self.plot
    }

    /// Upper end of the colour range of the effective stress, Pa.
    pub(super) fn effective_top_pa(&self) -> f64 {
        self.scales[0].1.top / GPA.1
    }

    /// Scales of the images, for the notes in the recording.
    pub(super) fn scales(&self) -> &[(&'static str, Scale)] {
        &self.scales
    }

    /// Logs one frame's slice. A frame without a slice changes nothing.
    pub(super) fn log(&mut self, stream: &Stream, frame: &Frame) -> Result<(), ObserveError> {
        let nx = self.geometry.nx;
        let Some(slice) = frame.slice.as_ref().filter(|s| self.rows.hold(s, nx)) else {
            return Ok(());
        };
        let effective = self.rows.image(&slice.effective_pa, nx);
        self.effective.log(stream, Field::TopDown(&effective))?;
        log_peak(stream, frame)?;
        self.log_point(stream, frame)
    }

    /// Same for the shear, which has a picture of its own in another tab.
    pub(super) fn log_shear(&self, stream: &Stream, frame: &Frame) -> Result<(), ObserveError> {
        let nx = self.geometry.nx;
        let Some(slice) = frame.slice.as_ref().filter(|s| self.rows.hold(s, nx)) else {
            return Ok(());
        };
        let shear = self.rows.image(&slice.tau_xz_pa, nx);
        self.tau_xz.log(stream, Field::TopDown(&shear))
    }

    /// The followed point and the depth on which it travels.
    fn log_point(&mut self, stream: &Stream, frame: &Frame) -> Result<(), ObserveError> {
        let Some(point) = frame.material_point.filter(|point| point.body == 1) else {
            return Ok(());
        };
        let (x, z) = ((point.x_m * MM) as f32, (point.depth_m * MM) as f32);
        let [left, right] = self.plot.x.map(|x| x as f32);
        if self.path_m != Some(point.depth_m) {
            self.path_m = Some(point.depth_m);
            let path = LineStrips2D::new([[[left, z], [right, z]]])
                .with_colors([faded(GREEN, 130)])
                .with_radii([Radius::new_ui_points(0.5)])
                .with_draw_order(18.0);
            stream.log(&format!("{POINT}/path"), &path)?;
        }
        // Outside of the picture there is none.
        let here = (left..=right).contains(&x).then_some([x, z]);
        stream.log(POINT_NOW, &Points2D::update_fields().with_positions(here))
    }
}

/// How the dots look: the followed point and the greatest stress.
fn log_dots(stream: &Stream) -> Result<(), ObserveError> {
    let dot = |colour, radius, order| {
        Points2D::update_fields()
            .with_radii([Radius::new_ui_points(radius)])
            .with_colors([faded(colour, 255)])
            .with_draw_order(order)
    };
    stream.log_static(POINT_NOW, &dot(GREEN, 5.0, 26.0))?;
    stream.log_static(PEAK, &dot([255, 255, 255], 3.5, 25.0))
}

/// A dot where the effective stress is greatest.
fn log_peak(stream: &Stream, frame: &Frame) -> Result<(), ObserveError> {
    let metrics = &frame.metrics;
    let (Some(depth), Some(x)) = (metrics.sigma_eff_max_depth_m, metrics.sigma_eff_max_x_m) else {
        return Ok(());
    };
    let at = [(x * MM) as f32, (depth * MM) as f32];
    stream.log(PEAK, &Points2D::update_fields().with_positions([at]))
}

fn plot_box(g: Geometry, rows: &Rows) -> PlotBox {
    let x = [g.x_min - 0.5 * g.dx, g.x_max() + 0.5 * g.dx];
    let half = 0.5 * rows.height_mm;
    let y = [rows.first_mm - half, rows.depth_mm(rows.len() - 1) + half];
    PlotBox {
        x,
        y,
        x_ticks: ticks_at(&ticks(x[0], x[1], 5), |x| x),
        left_ticks: ticks_at(&ticks(y[0].max(0.0), y[1], 5), |z| z),
        x_title: format!("x, mm   (a = {} mm)", number((g.a * 1e4).round() / 1e4)),
        titles: vec![(0.13, "depth z, mm".into(), WHITE)],
        ..PlotBox::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uneven_depths_become_an_even_scale() {
        let depths: Arc<[f64]> = [0.0, 0.1e-3, 0.3e-3, 0.7e-3, 1.5e-3].into();
        let rows = Rows::new(&depths, 0.05, f64::INFINITY).expect("rows");
        assert_eq!(rows.len(), 31);
        // A field that is linear in depth is reproduced on every row.
        let field: Vec<f32> = depths
            .iter()
            .flat_map(|&z| [z as f32, 2.0 * z as f32])
            .collect();
        for row in 0..rows.len() {
            let z = (rows.depth_mm(row) / MM) as f32;
            assert!((rows.value(&field, 2, row, 0) - z).abs() < 1e-9);
            assert!((rows.value(&field, 2, row, 1) - 2.0 * z).abs() < 2e-9);
            let image = rows.image(&field, 2);
            assert_eq!(image[2 * row + 1], rows.value(&field, 2, row, 1));
        }
        assert!((rows.depth_mm(30) - 1.5).abs() < 1e-12);
    }

    #[test]
    fn depths_that_make_no_picture_are_refused() {
        let rows = |depths: &[f64]| Rows::new(&depths.into(), 0.05, f64::INFINITY);
        assert!(rows(&[]).is_none());
        assert!(rows(&[1e-4]).is_none());
        assert!(rows(&[1e-4, 1e-4]).is_none());
        assert!(rows(&[2e-4, 1e-4]).is_none());
    }
}
