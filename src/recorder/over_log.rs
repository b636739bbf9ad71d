//! The stress below a line contact over the logarithm of the depth: the crests' micrometres and the half-width's tenths of
//! a millimetre in one picture.
//!
//! The viewer has no such axis, so rows are resampled ([`LogDepths`]) and the ticks say the depths. What was computed is in
//! the file beside it ([`super::slice`]).

use rerun::Points2D;

use super::colour::GREEN;
use super::depths::LogDepths;
use super::geometry::Geometry;
use super::picture::{Field, PixelField};
use super::plot::{HertzCurve, PlotBox, dot};
use super::raster::{Height, RasterEntity};
use super::stream::Stream;
use asperity_engine::observe::ObserveError;
use asperity_engine::scene::ContactKind;
use asperity_engine::sim::{Frame, StressSlice};
use asperity_picture::{Look, Ranges, Subject};

pub(super) const EFFECTIVE: &str = "slice_over_log_depth/effective_stress_GPa";
pub(super) const TAU_XZ: &str = "slice_over_log_depth/tau_xz_GPa";
/// The followed point, and where the stress is greatest.
pub(super) const MARKS: &str = "slice_over_log_depth/marks";
const MARKED: [&str; 2] = [
    "slice_over_log_depth/marks/followed_point",
    "slice_over_log_depth/marks/greatest_stress",
];
pub(super) const HERTZ: &str = "slice_over_log_depth/hertz_width";
/// Rows of the picture, and its columns at most.
const ROWS: usize = 48;
const COLUMNS: usize = 160;

/// Both images.
pub(super) struct OverLog {
    geometry: Geometry,
    depths: LogDepths,
    /// Nodes of a column.
    every: usize,
    images: [(Subject, RasterEntity); 2],
    plot: PlotBox,
    hertz: HertzCurve,
    rows: Vec<f32>,
}

impl OverLog {
    /// Sets up the pictures of a line contact; `None` of others, and where no stress is computed.
    pub(super) fn new(
        stream: &Stream,
        geometry: Geometry,
        first: &Frame,
        ranges: &Ranges,
    ) -> Result<Option<Self>, ObserveError> {
        let slice = first.slice.as_ref();
        let slice = slice.filter(|_| geometry.kind == ContactKind::Line);
        let Some(depths) = slice.and_then(|slice| LogDepths::over(&slice.depths_m, ROWS)) else {
            return Ok(None);
        };
        let every = geometry.nx.div_ceil(COLUMNS);
        let pixels = |plot: &PlotBox| PixelField {
            columns: geometry.nx.div_ceil(every),
            rows: ROWS,
            first: [geometry.x_min, plot.y[1] / ROWS as f64 * 0.5],
            size: [geometry.dx * every as f64, plot.y[1] / ROWS as f64],
        };
        let plot = PlotBox::below_surface(geometry, |height| depths.ticks(height));
        let image = |entity, subject| {
            let look = Look::of(subject, ranges);
            let place = pixels(&plot);
            let raster = RasterEntity::new(stream, entity, look, place, &plot, Height::Fixed)?;
            Ok((subject, raster))
        };
        for (entity, (colour, radius)) in
            MARKED.into_iter().zip([(GREEN, 5.0), ([u8::MAX; 3], 3.5)])
        {
            stream.log_static(entity, &dot(colour, radius))?;
        }
        Ok(Some(Self {
            geometry,
            every,
            images: [
                image(EFFECTIVE, Subject::EffectiveStress)?,
                image(TAU_XZ, Subject::ShearStress)?,
            ],
            depths,
            plot,
            hertz: HertzCurve::default(),
            rows: Vec::new(),
        }))
    }

    pub(super) fn plot(&self) -> &PlotBox {
        &self.plot
    }

    /// Widens the ranges from now on.
    pub(super) fn reach(&mut self, stream: &Stream, ranges: &Ranges) -> Result<(), ObserveError> {
        for (subject, raster) in &mut self.images {
            raster.reach(stream, Look::of(*subject, ranges))?;
        }
        Ok(())
    }

    /// Logs one frame's effective stress, the followed point and where it is greatest.
    pub(super) fn log(&mut self, stream: &Stream, frame: &Frame) -> Result<(), ObserveError> {
        let Some(slice) = self.slice(frame) else {
            return Ok(());
        };
        self.hertz.log_width(stream, HERTZ, (&self.plot, frame))?;
        self.draw(stream, 0, &slice.effective_pa)?;
        let m = &frame.metrics;
        let point = frame.material_point.filter(|point| point.body == 1);
        let greatest = m.sigma_eff_max_x_m.zip(m.sigma_eff_max_depth_m);
        let marks = [point.map(|point| (point.x_m, point.depth_m)), greatest];
        for (entity, at) in MARKED.into_iter().zip(marks) {
            let at = at.and_then(|(x_m, z_m)| self.plot.at_depth(x_m, self.depths.share(z_m)?));
            stream.log(entity, &Points2D::update_fields().with_positions(at))?;
        }
        Ok(())
    }

    /// Same for the shear.
    pub(super) fn log_shear(&mut self, stream: &Stream, frame: &Frame) -> Result<(), ObserveError> {
        match self.slice(frame) {
            Some(slice) => self.draw(stream, 1, &slice.tau_xz_pa),
            None => Ok(()),
        }
    }

    fn slice<'a>(&self, frame: &'a Frame) -> Option<&'a StressSlice> {
        let slice = frame.slice.as_ref();
        slice.filter(|slice| self.depths.hold(slice, self.geometry.nx))
    }

    fn draw(&mut self, stream: &Stream, image: usize, field: &[f32]) -> Result<(), ObserveError> {
        let (nx, every) = (self.geometry.nx, self.every);
        self.depths.resample(field, nx, every, &mut self.rows);
        self.images[image].1.log(stream, Field::TopDown(&self.rows))
    }
}
