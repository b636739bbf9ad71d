//! The plane y = 0 below body 1's surface: x to the right, depth down, a row for each of the solver's depths.
//!
//! To scale it is drawn in the 3-D view; here the rows that crowd below the surface, where pits start, have room
//! ([`Depths`]), and each holds what the solver computed.

use rerun::{LineStrips2D, Points2D, Radius};

use super::colour::{GREEN, faded};
use super::depths::Depths;
use super::geometry::Geometry;
use super::picture::{Field, PixelField};
use super::plot::{HertzCurve, PlotBox, dot};
use super::raster::{Height, RasterEntity};
use super::stream::Stream;
use super::text::Widened;
use asperity_engine::math::number::MM;
use asperity_engine::observe::ObserveError;
use asperity_engine::sim::Frame;
use asperity_picture::{Look, Ranges, Subject};

pub(super) const EFFECTIVE: &str = "slice_y0/effective_stress_GPa";
pub(super) const TAU_XZ: &str = "slice_y0/tau_xz_GPa";
/// The followed material point.
pub(super) const POINT: &str = "slice_y0/material_point";
const POINT_NOW: &str = "slice_y0/material_point/now";
/// Where the stress is greatest.
pub(super) const PEAK: &str = "slice_y0/greatest_stress";
/// Hertz's contact on the surface.
pub(super) const HERTZ: &str = "slice_y0/hertz_width";

/// The images of the slice.
pub(super) struct Slice {
    geometry: Geometry,
    depths: Depths,
    effective: RasterEntity,
    tau_xz: RasterEntity,
    plot: PlotBox,
    hertz: HertzCurve,
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
        let Some(depths) = Depths::down_to(&slice.depths_m, f64::INFINITY) else {
            return Ok(None);
        };
        let plot = PlotBox::below_surface(geometry, |height| depths.ticks(height));
        let row_height = plot.y[1] / depths.len() as f64;
        let pixels = PixelField {
            columns: geometry.nx,
            rows: depths.len(),
            first: [geometry.x_min, 0.5 * row_height],
            size: [geometry.dx, row_height],
        };
        stream.log_static(POINT_NOW, &dot(GREEN, 5.0))?;
        stream.log_static(PEAK, &dot([u8::MAX; 3], 3.5).with_draw_order(25.0))?;
        let image = |entity, subject| {
            let look = Look::of(subject, ranges);
            RasterEntity::new(stream, entity, look, pixels, &plot, Height::Fixed)
        };
        Ok(Some(Self {
            geometry,
            effective: image(EFFECTIVE, Subject::EffectiveStress)?,
            tau_xz: image(TAU_XZ, Subject::ShearStress)?,
            depths,
            plot,
            hertz: HertzCurve::default(),
            path_m: None,
        }))
    }

    pub(super) fn plot(&self) -> &PlotBox {
        &self.plot
    }

    /// Widens the ranges from now on, as [`Maps::reach`](super::maps::Maps::reach).
    pub(super) fn reach(
        &mut self,
        stream: &Stream,
        ranges: &Ranges,
    ) -> Result<Vec<Widened>, ObserveError> {
        let mut widened = Vec::new();
        for (entity, raster, subject) in [
            (EFFECTIVE, &mut self.effective, Subject::EffectiveStress),
            (TAU_XZ, &mut self.tau_xz, Subject::ShearStress),
        ] {
            let look = Look::of(subject, ranges);
            let tops = raster.reach(stream, look)?;
            widened.extend(tops.map(|tops| (entity, tops, look.unit.name)));
        }
        Ok(widened)
    }

    /// The images, for the notes in the recording and for what is told of them.
    pub(super) fn rasters(&self) -> [(&'static str, &RasterEntity); 2] {
        [(EFFECTIVE, &self.effective), (TAU_XZ, &self.tau_xz)]
    }

    /// Logs one frame's slice. A frame without a slice changes nothing.
    pub(super) fn log(&mut self, stream: &Stream, frame: &Frame) -> Result<(), ObserveError> {
        let nx = self.geometry.nx;
        let Some(slice) = frame.slice.as_ref().filter(|s| self.depths.hold(s, nx)) else {
            return Ok(());
        };
        self.hertz.log_width(stream, HERTZ, (&self.plot, frame))?;
        self.effective
            .log(stream, Field::TopDown(&slice.effective_pa))?;
        self.log_peak(stream, frame)?;
        self.log_point(stream, frame)
    }

    /// Same for the shear, which has a picture of its own in another tab.
    pub(super) fn log_shear(&self, stream: &Stream, frame: &Frame) -> Result<(), ObserveError> {
        let nx = self.geometry.nx;
        let Some(slice) = frame.slice.as_ref().filter(|s| self.depths.hold(s, nx)) else {
            return Ok(());
        };
        self.tau_xz.log(stream, Field::TopDown(&slice.tau_xz_pa))
    }

    /// Where a place lies in the view; `None` outside of the picture.
    fn place(&self, x_m: f64, depth_m: f64) -> Option<[f32; 2]> {
        self.plot.at_depth(x_m, self.depths.share(depth_m)?)
    }

    /// A dot where the effective stress is greatest.
    fn log_peak(&self, stream: &Stream, frame: &Frame) -> Result<(), ObserveError> {
        let metrics = &frame.metrics;
        let place = metrics.sigma_eff_max_x_m.zip(metrics.sigma_eff_max_depth_m);
        let at = place.and_then(|(x, depth)| self.place(x, depth));
        stream.log(PEAK, &Points2D::update_fields().with_positions(at))
    }

    /// The followed point and the depth on which it travels.
    fn log_point(&mut self, stream: &Stream, frame: &Frame) -> Result<(), ObserveError> {
        let Some(point) = frame.material_point.filter(|point| point.body == 1) else {
            return Ok(());
        };
        let ends = self.plot.x.map(|x| self.place(x / MM, point.depth_m));
        if let [Some(left), Some(right)] = ends
            && self.path_m != Some(point.depth_m)
        {
            self.path_m = Some(point.depth_m);
            let path = LineStrips2D::new([[left, right]])
                .with_colors([faded(GREEN, 130)])
                .with_radii([Radius::new_ui_points(0.5)])
                .with_draw_order(18.0);
            stream.log(&format!("{POINT}/path"), &path)?;
        }
        let here = self.place(point.x_m, point.depth_m);
        stream.log(POINT_NOW, &Points2D::update_fields().with_positions(here))
    }
}
