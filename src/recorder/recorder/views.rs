//! The parts of a recording that the first frame sets up.

use super::super::cadence::Cadence;
use super::super::centre_line::CentreLine;
use super::super::damage::Damage;
use super::super::geometry::Geometry;
use super::super::kymograph::{self, KymographEntity};
use super::super::layout::{self, ShownViews};
use super::super::maps::{self, Maps};
use super::super::over_log::OverLog;
use super::super::picture::Beyond;
use super::super::profile::ProfileEntity;
use super::super::raster::RasterEntity;
use super::super::scalars;
use super::super::series::Series;
use super::super::slice::Slice;
use super::super::space::{Space, Tops};
use super::super::stream::Stream;
use super::super::text;
use super::super::tooth::ToothEntity;
use super::super::trace::TraceEntity;
use super::super::weight::TEXT;
use asperity_engine::math::number::sig;
use asperity_engine::observe::ObserveError;
use asperity_engine::scene::{Record, Scene};
use asperity_engine::sim::Frame;
use asperity_picture::{Scope, Subject};

/// The maps of the second tab and of damage are recorded in every so-many-th picture: they cost as much as all
/// the others, and for looking at textures and at what collects slowly half the pace does.
const BESIDE_EVERY: u64 = 2;

/// What is set up by the first frame.
pub(in super::super) struct ViewState {
    pub(super) geometry: Geometry,
    scope: Scope,
    /// Whether its ranges are those of several runs, and stay.
    is_common: bool,
    pub(super) cadence: Cadence,
    pub(in super::super) series: Series,
    maps: Maps,
    slice: Option<Slice>,
    over_log: Option<OverLog>,
    space: Option<Space>,
    centre_line: CentreLine,
    profile: Option<ProfileEntity>,
    trace: Option<TraceEntity>,
    tooth: Option<ToothEntity>,
    pub(in super::super) kymographs: [KymographEntity; 2],
    damage: Damage,
    /// Bodies whose damage is mapped.
    damaged: [bool; 2],
    /// Frames whose fields were logged.
    pub(super) pictures: u64,
}

/// What runs that are shown side by side have in common.
#[derive(Debug, Clone)]
pub(in super::super) struct Common {
    /// Ranges that hold for all of them.
    pub(in super::super) scope: Scope,
    /// Times that heights are drawn too high.
    pub(in super::super) exaggeration: Option<f64>,
}

impl ViewState {
    /// Sets up what a run is shown by, and how it is laid out.
    pub(super) fn new(
        stream: &Stream,
        record: &Record,
        scene: Option<&Scene>,
        first: &Frame,
    ) -> Result<Self, ObserveError> {
        let series = Series::new(stream, first.kind)?;
        let views = Self::of(stream, record, (scene, first), series, None)?;
        layout::send(stream, &views.shown(first, stream.is_live()))?;
        Ok(views)
    }

    /// Same without a layout; with what runs have in `common`.
    pub(in super::super) fn of(
        stream: &Stream,
        record: &Record,
        (scene, first): (Option<&Scene>, &Frame),
        series: Series,
        common: Option<Common>,
    ) -> Result<Self, ObserveError> {
        let is_common = common.is_some();
        let exaggeration = common.as_ref().and_then(|common| common.exaggeration);
        let scope = common.map_or_else(|| Scope::of(scene, first), |common| common.scope);
        scalars::log_grid(stream, first)?;
        let geometry = Geometry::of(first, scope.to_come.size);
        if !geometry.holds(first) {
            return Err(ObserveError::new(
                stream.output(),
                "the first frame's fields have not the sizes of its grid",
            ));
        }
        let ranges = scope.ranges;
        let maps = Maps::new(stream, geometry, &ranges)?;
        let slice = Slice::new(stream, geometry, first, &ranges)?;
        let over_log = OverLog::new(stream, geometry, first, &ranges)?;
        let tops = Tops {
            pressure_pa: ranges.pressure_pa,
            effective_pa: slice.as_ref().map(|_| ranges.effective_pa),
            rough: ranges.rough,
            roughness_m: scope.to_come.amplitude_m.iter().sum(),
            exaggeration,
        };
        let space = Space::new(stream, geometry, first, tops)?;
        let centre_line = CentreLine::new(stream, geometry, ranges.pressure_pa, ranges.film_m)?;
        let trace = first
            .material_point
            .map(|_| TraceEntity::new(stream, geometry, tops.pressure_pa))
            .transpose()?;
        let profile = scene
            .map(|scene| {
                let below = trace.as_ref().map(TraceEntity::plot);
                ProfileEntity::new(stream, geometry, (scene, first), &scope, below)
            })
            .transpose()?;
        let tooth = ToothEntity::new(stream, scene)?;
        let steps = expected_steps(scene, first);
        let budget = record.budget_mb * 1e6;
        let step_s = step_s(scene, first);
        let kymograph =
            |shown| KymographEntity::new(stream, geometry, shown, &ranges, steps, step_s, budget);
        let kymographs = [
            kymograph((kymograph::PRESSURE, Subject::Pressure))?,
            kymograph((kymograph::FILM, Subject::Film))?,
        ];
        // Both are written once more at the end.
        let last: usize = kymographs.iter().map(KymographEntity::full_bytes).sum();
        let spent = [stream.weight(), TEXT * last as f64];
        let cadence = Cadence::new(record, steps, frame_bytes(geometry), spent);
        let views = Self {
            geometry,
            scope,
            is_common,
            cadence,
            series,
            maps,
            slice,
            over_log,
            space,
            centre_line,
            profile,
            trace,
            tooth,
            kymographs,
            damage: Damage::default(),
            damaged: scene
                .and_then(|scene| scene.life.as_ref())
                .map_or([false; 2], asperity_engine::scene::Life::maps),
            pictures: 0,
        };
        views.log_notes(stream)?;
        Ok(views)
    }

    /// The factor of heights in the 3-D view; `None`: there is none.
    pub(in super::super) fn exaggeration(&self) -> Option<f64> {
        self.space.as_ref().map(Space::exaggeration)
    }

    fn log_notes(&self, stream: &Stream) -> Result<(), ObserveError> {
        let exaggeration = self.space.as_ref().map(Space::note).unwrap_or_default();
        let looks = self
            .rasters()
            .map(|(entity, raster)| (entity, raster.look()));
        text::log_notes(stream, looks, &self.cadence.note(), &exaggeration)
    }

    /// Widens the ranges where a knob was turned beyond what they were made for. All that is drawn to them changes with the
    /// same frame, so that pictures, axes and legends of any moment agree.
    fn reach(
        &mut self,
        stream: &Stream,
        scene: Option<&Scene>,
        frame: &Frame,
    ) -> Result<(), ObserveError> {
        if self.is_common || !self.scope.grows(scene, &frame.metrics) {
            return Ok(());
        }
        let ranges = &self.scope.ranges;
        let (pressure_pa, film_m) = (ranges.pressure_pa, ranges.film_m);
        let mut widened = self.maps.reach(stream, ranges)?;
        if let Some(slice) = &mut self.slice {
            widened.extend(slice.reach(stream, ranges)?);
        }
        if let Some(over_log) = &mut self.over_log {
            over_log.reach(stream, ranges)?;
        }
        let effective_pa = self.slice.as_ref().map(|_| ranges.effective_pa);
        self.centre_line.reach(stream, pressure_pa, film_m)?;
        if let Some((profile, scene)) = self.profile.as_mut().zip(scene) {
            profile.reach(stream, scene, &self.scope)?;
        }
        if let Some(space) = &mut self.space {
            space.reach(stream, pressure_pa, effective_pa)?;
        }
        if let Some(trace) = &mut self.trace {
            trace.reach(stream, pressure_pa)?;
        }
        for kymograph in &mut self.kymographs {
            kymograph.reach(stream, ranges)?;
        }
        text::log_widened(stream, &widened)?;
        self.log_notes(stream)
    }

    /// What the layout has to know.
    pub(in super::super) fn shown(&self, first: &Frame, live: bool) -> ShownViews {
        let speed = first.metrics.entrainment_m_s.abs();
        ShownViews {
            live,
            passage_s: (speed > 0.0).then(|| 4.0 * first.a_m / speed),
            kind: first.kind,
            map: maps::plot_box(self.geometry),
            interferogram: self.maps.interferogram().plot().clone(),
            centre_line: self.centre_line.plot().clone(),
            slice: self.slice.as_ref().map(|slice| slice.plot().clone()),
            over_log: self.over_log.as_ref().map(|slice| slice.plot().clone()),
            trace: self.trace.as_ref().map(|trace| trace.plot().clone()),
            profile: self.profile.as_ref().map(ProfileEntity::bounds),
            tooth: self.tooth.as_ref().map(ToothEntity::plots),
            kymograph: self.kymographs[0].plot().clone(),
            camera: self.space.as_ref().map(Space::camera),
            lecture: self.space.as_ref().map(Space::lecture_camera),
            rough: self.scope.ranges.rough,
            damaged: self.damaged,
            life: first.metrics.life.is_some(),
            yields: first.metrics.yielded_m3.is_some(),
        }
    }

    fn rasters(&self) -> impl Iterator<Item = (&'static str, &RasterEntity)> {
        self.maps
            .rasters()
            .chain(self.slice.iter().flat_map(Slice::rasters))
    }

    /// What of the last pictures lay beyond their ranges. The bath around the contact is no news.
    pub(super) fn beyond(&self) -> Vec<text::Above> {
        let rasters = self.rasters().filter(|(entity, _)| *entity != maps::FILM);
        let above =
            rasters.map(|(entity, raster)| (entity, raster.beyond(), raster.look().unit.name));
        above.filter(|(_, beyond, _)| beyond.above > 0).collect()
    }

    /// Samples that could not be stored as they are, and words about them.
    pub(super) fn clipped(&self) -> (u64, String) {
        let clipped = |(entity, raster): (&'static str, &RasterEntity)| {
            let Beyond {
                clipped,
                clipped_by,
                ..
            } = raster.beyond_in_all();
            let unit = raster.look().unit.name;
            let by = sig(clipped_by.into(), 3);
            (clipped > 0).then(|| {
                (
                    clipped,
                    format!("{clipped} of {entity} by up to {by} {unit}"),
                )
            })
        };
        let (counts, words): (Vec<u64>, Vec<String>) = self.rasters().filter_map(clipped).unzip();
        (counts.iter().sum(), words.join(", "))
    }

    /// What has to see every step.
    pub(in super::super) fn follow(&mut self, frame: &Frame) {
        self.follow_point(frame);
        for kymograph in &mut self.kymographs {
            kymograph.follow(frame);
        }
    }

    /// What has to see every step and needs no fields.
    pub(in super::super) fn follow_point(&mut self, frame: &Frame) {
        if let Some(trace) = &mut self.trace {
            trace.follow(frame);
        }
    }

    /// The fields of a frame.
    pub(in super::super) fn log(
        &mut self,
        stream: &Stream,
        scene: Option<&Scene>,
        frame: &Frame,
    ) -> Result<(), ObserveError> {
        self.reach(stream, scene, frame)?;
        self.maps.log(stream, frame)?;
        self.centre_line.log(stream, frame)?;
        if let Some(profile) = &mut self.profile {
            profile.log(stream, frame)?;
        }
        if let Some(slice) = &mut self.slice {
            slice.log(stream, frame)?;
        }
        if let Some(over_log) = &mut self.over_log {
            over_log.log(stream, frame)?;
        }
        if let Some(space) = &mut self.space {
            space.log(stream, frame)?;
        }
        if let Some(trace) = &mut self.trace {
            trace.log(stream, frame)?;
        }
        if let Some(tooth) = &self.tooth {
            tooth.log(stream, frame)?;
        }
        if self.pictures.is_multiple_of(BESIDE_EVERY) {
            self.maps.log_beside(stream, frame)?;
            if let Some(slice) = &self.slice {
                slice.log_shear(stream, frame)?;
            }
            if let Some(over_log) = &mut self.over_log {
                over_log.log_shear(stream, frame)?;
            }
            if let Some(space) = &mut self.space {
                space.log_damage(stream, frame)?;
            }
            self.damage.log(stream, frame)?;
        }
        self.pictures += 1;
        for kymograph in &mut self.kymographs {
            kymograph.log_if_due(stream)?;
            kymograph.log_now(stream, frame.step)?;
        }
        Ok(())
    }
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
    let steps = time.passages * 4.0 * first.a_m / (first.dx_m * time.step_nodes);
    if steps.is_finite() {
        steps.max(1.0)
    } else {
        1.0
    }
}

/// Raw bytes of one frame's fields, roughly: what the first cadence is decided from.
pub(super) fn frame_bytes(g: Geometry) -> u64 {
    let nodes = (g.nx * g.ny) as u64;
    // Two maps of two bytes and one of one, the slice; of every second frame three maps more, the
    // interferogram and another slice; the sheets of the 3-D view.
    (5 + 2 + (6 + 4 + 2) / 2) * nodes + 100_000
}
