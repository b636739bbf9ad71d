//! The pictures of a recording, which the first frame sets up.

use super::cadence::Cadence;
use super::centre_line::CentreLine;
use super::damage::Damage;
use super::entities::{kymograph, maps as map_entities};
use super::geometry::Geometry;
use super::kymograph::{ExpectedRun, KymographEntity};
use super::layout;
use super::maps::{self, Maps};
use super::picture::top;
use super::profile::{ProfileEntity, TitleRoom};
use super::raster::RasterEntity;
use super::research::{self, ResearchEntity};
use super::scalars;
use super::series::Series;
use super::shown::ShownViews;
use super::size::TEXT;
use super::slice::Slice;
use super::space::{Space, Tops};
use super::stream::Stream;
use super::text::{self, AboveRange, WidenedRange};
use super::tooth::ToothEntity;
use super::trace::TraceEntity;
use super::view::View;
use asperity_engine::observe::ObserveError;
use asperity_engine::scene::{Record, Scene};
use asperity_engine::sim::Frame;
use asperity_picture::{Scope, Subject};

/// The maps of the second tab and of damage are recorded in every so-many-th picture: they cost as much as all
/// the others, and for looking at textures and at what collects slowly half the pace does.
const SELDOM: u64 = 2;

/// What runs that are shown side by side have in common.
#[derive(Debug, Clone)]
pub(crate) struct Common {
    /// Ranges that hold for all of them.
    pub(crate) scope: Scope,
    /// Times that heights are drawn too high.
    pub(crate) exaggeration: Option<f64>,
}

/// What is set up by the first frame.
pub(crate) struct RunViews {
    pub(crate) geometry: Geometry,
    scope: Scope,
    /// Whether its ranges are those of several runs, and stay.
    is_common: bool,
    pub(crate) cadence: Cadence,
    pub(crate) series: Series,
    all: Vec<Box<dyn View>>,
    /// Times that heights are drawn too high in the 3-D view, and words about them; `None`: there is no such view.
    pub(crate) exaggeration: Option<f64>,
    heights_note: String,
    /// What the layout has to know.
    pub(crate) shown: ShownViews,
    /// Frames whose fields were logged.
    pub(crate) pictures: u64,
}

impl RunViews {
    /// Sets up what a run is shown by; with what runs have in `common` where several stand beside each other.
    pub(crate) fn new(
        stream: &Stream,
        record: &Record,
        scene: Option<&Scene>,
        first: &Frame,
        series: Series,
        common: Option<Common>,
    ) -> Result<Self, ObserveError> {
        let is_common = common.is_some();
        let exaggeration = common.as_ref().and_then(|common| common.exaggeration);
        let scope = common.map_or_else(|| Scope::of(scene, first), |common| common.scope);
        scalars::log_grid(stream, first);
        let geometry = Geometry::of(first, scope.to_come.size);
        if !geometry.holds(first) {
            return Err(ObserveError::new(
                stream.output(),
                "the first frame's fields have not the sizes of its grid",
            ));
        }
        let mut shown = ShownViews::new(scene, first, &scope, maps::plot_box(geometry));
        shown.live = stream.is_live();
        let mut all = map_views(stream, geometry, first, &scope, &mut shown);
        let tops = Tops {
            pressure_pa: scope.ranges.pressure_pa,
            effective_pa: shown.slice.as_ref().map(|_| scope.ranges.effective_pa),
            rough: scope.ranges.rough,
            roughness_m: scope.to_come.amplitude_m.iter().sum(),
            exaggeration,
        };
        let space = Space::new(stream, geometry, first, tops);
        let parts = space.as_ref().map(Space::parts);
        let exaggeration = parts.map(|parts| parts.exaggeration);
        let heights_note = parts.map_or_else(String::new, crate::space::fixed::Parts::note);
        shown.camera = parts.map(crate::space::fixed::Parts::camera);
        shown.lecture = parts.map(crate::space::fixed::Parts::lecture_camera);
        all.extend(space.map(boxed));
        let room = if is_common {
            TitleRoom::Some
        } else {
            TitleRoom::All
        };
        all.extend(curve_views(
            stream, geometry, scene, first, &scope, room, &mut shown,
        ));
        let kymographs = kymographs(stream, geometry, record, scene, first, &scope);
        shown.kymograph = kymographs[0].plot().clone();
        // Both are written once more at the end.
        let last: usize = kymographs.iter().map(KymographEntity::full_bytes).sum();
        all.extend(kymographs.into_iter().map(boxed));
        all.push(boxed(Damage::default()));
        if let Some(scene) = scene.filter(|_| !is_common) {
            shown.research = research::shown(scene, first, shown.rough);
            let plots = ResearchEntity::new(scene, &shown.research, scope.ranges);
            all.push(boxed(plots));
        }
        let analysis = research::LAST_BYTES * shown.research.len() as f64;
        let spent = [stream.expected_bytes(), TEXT * last as f64 + analysis];
        let steps = expected_steps(scene, first);
        let cadence = Cadence::new(record, steps, frame_bytes(geometry), spent);
        let run_s = steps * step_s(scene, first);
        let moves = first.metrics.entrainment_m_s != 0.0;
        let speed = || layout::playback_speed(run_s, cadence.pictures());
        shown.playback_speed = moves.then(speed).flatten();
        let views = Self {
            geometry,
            scope,
            is_common,
            cadence,
            series,
            all,
            exaggeration,
            heights_note,
            shown,
            pictures: 0,
        };
        views.log_notes(stream);
        Ok(views)
    }

    fn log_notes(&self, stream: &Stream) {
        let looks = self
            .rasters()
            .map(|(entity, raster)| (entity, raster.look()));
        text::log_notes(stream, looks, &self.cadence.note(), &self.heights_note);
    }

    /// Widens the ranges where a knob was turned beyond what they were made for. All that is drawn to them changes with the
    /// same frame, so that pictures, axes and legends of any moment agree.
    fn widen(&mut self, stream: &Stream, scene: Option<&Scene>, frame: &Frame) {
        if self.is_common || !self.scope.grows(scene, &frame.metrics) {
            return;
        }
        let tops = |views: &Self| -> Vec<f64> {
            let rasters = views.rasters();
            rasters.map(|(_, raster)| top(raster.look())).collect()
        };
        let before = tops(self);
        for view in &mut self.all {
            view.widen(stream, scene, &self.scope);
        }
        let widened = self.rasters().zip(before).zip(tops(self));
        let widened = widened.filter(|((_, before), after)| before != after);
        for (((entity, raster), before), after) in widened {
            let unit = raster.look().unit.name;
            text::log_widened(
                stream,
                &WidenedRange {
                    entity,
                    before,
                    after,
                    unit,
                },
            );
        }
        self.log_notes(stream);
    }

    fn rasters(&self) -> impl Iterator<Item = (&'static str, &RasterEntity)> {
        self.all.iter().flat_map(|view| view.rasters())
    }

    /// What of the last pictures lay above their ranges. The bath around the contact is no news.
    pub(crate) fn above_ranges(&self) -> Vec<AboveRange> {
        let rasters = self
            .rasters()
            .filter(|(entity, _)| *entity != map_entities::FILM);
        let all = rasters.map(|(entity, raster)| AboveRange {
            entity,
            beyond: raster.beyond(),
            unit: raster.look().unit.name,
        });
        all.filter(|one| one.beyond.above > 0).collect()
    }

    /// Takes up a step with its fields.
    pub(crate) fn follow(&mut self, frame: &Frame) {
        for view in &mut self.all {
            view.follow_scalars(frame);
            view.follow_fields(frame);
        }
    }

    /// What has to see every step and needs no fields.
    pub(crate) fn follow_scalars(&mut self, frame: &Frame) {
        for view in &mut self.all {
            view.follow_scalars(frame);
        }
    }

    /// The fields of a frame.
    pub(crate) fn log(&mut self, stream: &Stream, scene: Option<&Scene>, frame: &Frame) {
        let is_seldom = self.pictures.is_multiple_of(SELDOM);
        self.log_as(stream, scene, frame, is_seldom);
    }

    /// The same with what stands in every second picture.
    pub(crate) fn log_whole(&mut self, stream: &Stream, scene: Option<&Scene>, frame: &Frame) {
        self.log_as(stream, scene, frame, true);
    }

    fn log_as(&mut self, stream: &Stream, scene: Option<&Scene>, frame: &Frame, is_whole: bool) {
        self.widen(stream, scene, frame);
        for view in &mut self.all {
            view.log(stream, frame);
            if is_whole {
                view.log_seldom(stream, frame);
            }
        }
        self.pictures += 1;
    }

    /// What is known at the end.
    pub(crate) fn finish(&mut self, stream: &Stream) {
        for view in &mut self.all {
            view.finish(stream);
        }
    }
}

fn boxed(view: impl View + 'static) -> Box<dyn View> {
    Box::new(view)
}

/// Maps of the contact plane and of the plane below.
fn map_views(
    stream: &Stream,
    geometry: Geometry,
    first: &Frame,
    scope: &Scope,
    shown: &mut ShownViews,
) -> Vec<Box<dyn View>> {
    let maps = Maps::new(stream, geometry, &scope.ranges, shown.rises);
    shown.interferogram = maps.interferogram().plot().clone();
    let slice = Slice::computed(stream, geometry, first, &scope.ranges);
    shown.slice = slice.as_ref().map(|slice| slice.plot().clone());
    let over_log = Slice::over_log(stream, geometry, first, &scope.ranges);
    shown.over_log = over_log.as_ref().map(|slice| slice.plot().clone());
    let mut all = vec![boxed(maps)];
    all.extend(slice.into_iter().chain(over_log).map(boxed));
    all
}

/// Curves along y = 0, what a point feels, and where on a tooth the contact is.
fn curve_views(
    stream: &Stream,
    geometry: Geometry,
    scene: Option<&Scene>,
    first: &Frame,
    scope: &Scope,
    room: TitleRoom,
    shown: &mut ShownViews,
) -> Vec<Box<dyn View>> {
    let centre_line = CentreLine::new(stream, geometry, &scope.ranges);
    shown.centre_line = centre_line.plot().clone();
    let has_point = first.material_point.is_some();
    let trace = has_point.then(|| TraceEntity::new(stream, geometry, scope.ranges.pressure_pa));
    shown.trace = trace.as_ref().map(|trace| trace.plot().clone());
    let profile = scene.map(|scene| {
        let trace = shown.trace.as_ref();
        ProfileEntity::new(stream, geometry, scene, first, scope, trace, room)
    });
    shown.profile = profile.as_ref().map(ProfileEntity::bounds);
    let tooth = ToothEntity::new(stream, scene);
    shown.tooth = tooth.as_ref().map(ToothEntity::plots);
    let mut all = vec![boxed(centre_line)];
    all.extend(trace.map(boxed));
    all.extend(profile.map(boxed));
    all.extend(tooth.map(boxed));
    all
}

/// Pressure, film and, where there is heat, temperatures along y = 0 against time.
fn kymographs(
    stream: &Stream,
    geometry: Geometry,
    record: &Record,
    scene: Option<&Scene>,
    first: &Frame,
    scope: &Scope,
) -> Vec<KymographEntity> {
    let run = ExpectedRun {
        steps: expected_steps(scene, first),
        step_s: step_s(scene, first),
        budget_bytes: record.budget_mb * 1e6,
    };
    let warm = [
        (kymograph::SURFACE_1, Subject::Surface1),
        (kymograph::SURFACE_2, Subject::Surface2),
        (kymograph::OIL_RISE, Subject::OilRise),
    ];
    let warm = warm
        .into_iter()
        .filter(|(_, subject)| subject.field(first).is_some());
    let all = [
        (kymograph::PRESSURE, Subject::Pressure),
        (kymograph::FILM, Subject::Film),
    ];
    let all = all.into_iter().chain(warm);
    all.map(|(entity, subject)| {
        KymographEntity::new(stream, geometry, entity, subject, &scope.ranges, &run)
    })
    .collect()
}

/// Time of a step by the scene, s.
fn step_s(scene: Option<&Scene>, first: &Frame) -> f64 {
    scene.map_or(0.0, |scene| {
        scene.time.step_nodes * first.dx_m / scene.motion.entrainment_m_s.abs().max(1e-12)
    })
}

/// Steps that the scene asks for.
fn expected_steps(scene: Option<&Scene>, first: &Frame) -> f64 {
    let Some(time) = scene.map(|scene| &scene.time) else {
        return 1.0;
    };
    let steps = time.most_passages() * 4.0 * first.a_m / (first.dx_m * time.step_nodes);
    if steps.is_finite() {
        steps.max(1.0)
    } else {
        1.0
    }
}

/// Bytes of one frame's fields before they are compressed, roughly: what the first cadence is decided from. (75, 154 and
/// 48 kB of a frame reach the disk at 129², 257² and on a line of 257 nodes.)
pub(crate) fn frame_bytes(g: Geometry) -> u64 {
    let nodes = (g.nx * g.ny) as u64;
    // Two maps in levels, which are compressed already, and one of a byte; of every second frame twice four: three maps,
    // the interferogram and another slice; the sheets of the 3-D view.
    (3 + 1 + 4) * nodes + 100_000
}
