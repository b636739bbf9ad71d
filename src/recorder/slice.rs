//! The plane y = 0 below body 1's surface: x to the right, depth down.
//!
//! To scale it is drawn in the 3-D view; here the rows that crowd below the surface, where pits start, have room. There is
//! one for each of the solver's depths ([`Depths`]), which holds what was computed. Of a line contact the same is drawn over
//! the logarithm of the depth ([`LogDepths`]), resampled for looking at: the crests' micrometres and the half-width's
//! tenths of a millimetre in one picture. The viewer has no such axis, so the ticks say the depths.

use rerun::{LineStrips2D, Points2D, Radius};

use super::colour::{GREEN, faded};
use super::depths::{Depths, LogDepths};
use super::entities::{slice, slice_over_log_depth as over_log};
use super::geometry::Geometry;
use super::picture::{Field, PixelField};
use super::plot::{AxisTick, HertzCurve, PlotBox, dot};
use super::raster::{Height, RasterEntity};
use super::stream::{Holds, Stream};
use super::view::View;
use asperity_engine::math::number::MM;
use asperity_engine::scene::{ContactKind, Scene};
use asperity_engine::sim::{Frame, MaterialPoint, StressSlice};
use asperity_picture::{Look, Ranges, Scope, Subject};

/// Rows of the picture over the logarithm, and its columns at most.
const LOG_ROWS: usize = 48;
const LOG_COLUMNS: usize = 160;

/// The rows of the picture.
enum Rows {
    /// A row for each depth that was computed.
    Computed(Depths),
    /// Rows evenly over the logarithm, of every so-many-th column.
    OverLog { depths: LogDepths, every: usize },
}

impl Rows {
    fn share(&self, depth_m: f64) -> Option<f64> {
        match self {
            Self::Computed(depths) => depths.share(depth_m),
            Self::OverLog { depths, .. } => depths.share(depth_m),
        }
    }

    fn ticks(&self, height: f64) -> Vec<AxisTick> {
        match self {
            Self::Computed(depths) => depths.ticks(height),
            Self::OverLog { depths, .. } => depths.ticks(height),
        }
    }

    /// Columns and rows of a picture of so many nodes along x, and the nodes of a column.
    fn size(&self, nx: usize) -> (usize, usize, usize) {
        match self {
            Self::Computed(depths) => (nx, depths.len(), 1),
            Self::OverLog { every, .. } => (nx.div_ceil(*every), LOG_ROWS, *every),
        }
    }

    fn are_of(&self, slice: &StressSlice, nx: usize) -> bool {
        match self {
            Self::Computed(depths) => depths.hold(slice, nx),
            Self::OverLog { depths, .. } => depths.hold(slice, nx),
        }
    }
}

/// Its entities.
struct SliceEntities {
    effective: &'static str,
    tau_xz: &'static str,
    point: &'static str,
    peak: &'static str,
    hertz: &'static str,
}

const COMPUTED: SliceEntities = SliceEntities {
    effective: slice::EFFECTIVE,
    tau_xz: slice::TAU_XZ,
    point: slice::POINT_NOW,
    peak: slice::PEAK,
    hertz: slice::HERTZ,
};
const OVER_LOG: SliceEntities = SliceEntities {
    effective: over_log::EFFECTIVE,
    tau_xz: over_log::TAU_XZ,
    point: over_log::POINT,
    peak: over_log::PEAK,
    hertz: over_log::HERTZ,
};

/// The pictures of the plane.
pub(crate) struct Slice {
    geometry: Geometry,
    entities: SliceEntities,
    rows: Rows,
    effective: RasterEntity,
    tau_xz: RasterEntity,
    plot: PlotBox,
    hertz: HertzCurve,
    /// Depth of the followed point's path that was logged last.
    path_m: Option<f64>,
}

impl Slice {
    /// A row for each depth; `None` where the scene computes no stress.
    pub(crate) fn computed(
        stream: &Stream,
        geometry: Geometry,
        first: &Frame,
        ranges: &Ranges,
    ) -> Option<Self> {
        let depths = Depths::down_to(&first.slice.as_ref()?.depths_m, f64::INFINITY)?;
        let rows = Rows::Computed(depths);
        Some(Self::new(stream, geometry, COMPUTED, rows, ranges))
    }

    /// Over the logarithm of the depth; `None` of a point contact, and where no stress is computed.
    pub(crate) fn over_log(
        stream: &Stream,
        geometry: Geometry,
        first: &Frame,
        ranges: &Ranges,
    ) -> Option<Self> {
        let slice = first.slice.as_ref();
        let slice = slice.filter(|_| geometry.kind == ContactKind::Line)?;
        let depths = LogDepths::over(&slice.depths_m, LOG_ROWS)?;
        let every = geometry.nx.div_ceil(LOG_COLUMNS);
        let rows = Rows::OverLog { depths, every };
        Some(Self::new(stream, geometry, OVER_LOG, rows, ranges))
    }

    fn new(
        stream: &Stream,
        geometry: Geometry,
        entities: SliceEntities,
        rows: Rows,
        ranges: &Ranges,
    ) -> Self {
        let plot = PlotBox::below_surface(geometry, |height| rows.ticks(height));
        let (columns, n_rows, every) = rows.size(geometry.nx);
        let row_height = plot.y[1] / n_rows as f64;
        let pixels = PixelField {
            columns,
            rows: n_rows,
            first: [geometry.x_min, 0.5 * row_height],
            size: [geometry.dx * every as f64, row_height],
        };
        stream.log_static(entities.point, &dot(GREEN, 5.0));
        let peak = dot([u8::MAX; 3], 3.5).with_draw_order(25.0);
        stream.log_static(entities.peak, &peak);
        let image = |entity, subject| {
            let look = Look::of(subject, ranges);
            RasterEntity::new(stream, entity, look, pixels, &plot, Height::Fixed)
        };
        Self {
            geometry,
            effective: image(entities.effective, Subject::EffectiveStress),
            tau_xz: image(entities.tau_xz, Subject::ShearStress),
            entities,
            rows,
            plot,
            hertz: HertzCurve::default(),
            path_m: None,
        }
    }

    pub(crate) fn plot(&self) -> &PlotBox {
        &self.plot
    }

    /// The slice of a frame, if it has the depths that were set up.
    fn slice<'a>(&self, frame: &'a Frame) -> Option<&'a StressSlice> {
        let slice = frame.slice.as_ref();
        slice.filter(|slice| self.rows.are_of(slice, self.geometry.nx))
    }

    fn log_field(&self, stream: &Stream, image: &RasterEntity, field: &[f32]) {
        match &self.rows {
            Rows::Computed(_) => image.log(stream, Field::TopDown(field)),
            Rows::OverLog { depths, every } => {
                let rows = depths.resample(field, self.geometry.nx, *every);
                image.log(stream, Field::TopDown(&rows));
            }
        }
    }

    /// Where a place lies in the view; `None` outside of the picture.
    fn place(&self, x_m: f64, depth_m: f64) -> Option<[f32; 2]> {
        self.plot.at_depth(x_m, self.rows.share(depth_m)?)
    }

    fn log_dot(&self, stream: &Stream, entity: &str, at: Option<(f64, f64)>) {
        let at = at.and_then(|(x_m, depth_m)| self.place(x_m, depth_m));
        stream.log(entity, &Points2D::update_fields().with_positions(at));
    }

    /// The depth on which the followed point travels, where it has changed.
    fn log_path(&mut self, stream: &Stream, point: MaterialPoint) {
        let ends = self.plot.x.map(|x| self.place(x / MM, point.depth_m));
        if let [Some(left), Some(right)] = ends
            && self.path_m != Some(point.depth_m)
        {
            self.path_m = Some(point.depth_m);
            let path = LineStrips2D::new([[left, right]])
                .with_colors([faded(GREEN, 130)])
                .with_radii([Radius::new_ui_points(0.5)])
                .with_draw_order(18.0);
            stream.log_for(Holds::FromNow, &format!("{}/path", slice::POINT), &path);
        }
    }
}

impl View for Slice {
    fn widen(&mut self, stream: &Stream, _scene: Option<&Scene>, scope: &Scope) {
        let look = |subject| Look::of(subject, &scope.ranges);
        self.effective.widen(stream, look(Subject::EffectiveStress));
        self.tau_xz.widen(stream, look(Subject::ShearStress));
    }

    /// Effective stress, where it has its maximum, and the followed point. A frame without a slice changes nothing.
    fn log(&mut self, stream: &Stream, frame: &Frame) {
        let Some(slice) = self.slice(frame) else {
            return;
        };
        self.hertz
            .log_width(stream, self.entities.hertz, &self.plot, frame);
        self.log_field(stream, &self.effective, &slice.effective_pa);
        let m = &frame.metrics;
        let peak = m.sigma_eff_max_x_m.zip(m.sigma_eff_max_depth_m);
        self.log_dot(stream, self.entities.peak, peak);
        let point = frame.material_point.filter(|point| point.body == 1);
        if let (Some(point), Rows::Computed(_)) = (point, &self.rows) {
            self.log_path(stream, point);
        }
        let here = point.map(|point| (point.x_m, point.depth_m));
        self.log_dot(stream, self.entities.point, here);
    }

    /// Shear has a picture of its own in another tab.
    fn log_seldom(&mut self, stream: &Stream, frame: &Frame) {
        if let Some(slice) = self.slice(frame) {
            self.log_field(stream, &self.tau_xz, &slice.tau_xz_pa);
        }
    }

    fn rasters(&self) -> Vec<(&'static str, &RasterEntity)> {
        match self.rows {
            Rows::Computed(_) => vec![
                (self.entities.effective, &self.effective),
                (self.entities.tau_xz, &self.tau_xz),
            ],
            // Those beside it have the same ranges.
            Rows::OverLog { .. } => Vec::new(),
        }
    }
}
