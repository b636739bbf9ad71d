//! Puts the parts of a recording together.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use rerun::TextLogLevel;

use super::cadence::Cadence;
use super::centre_line::CentreLine;
use super::damage::Damage;
use super::file::RecordingFile;
use super::geometry::Geometry;
use super::kymograph::{self, Kymograph};
use super::layout::{self, Shown};
use super::live::Live;
use super::maps::{self, Maps};
use super::series::Series;
use super::slice::Slice;
use super::space::{Space, Tops};
use super::stream::{Moment, Stream};
use super::text;
use super::trace::Trace;
use crate::observe::scales::Ranges;
use crate::observe::{
    ObserveError, Observer, ObserverReport, Overwrite, RunContext, RunEvent, RunEventKind,
};
use crate::scene::{Record, Scene};
use crate::sim::{Frame, Stage};

/// The maps of the second tab and of damage are recorded in every so-many-th picture: they cost as much as all
/// the others, and for looking at textures and at what collects slowly half the pace does.
const BESIDE_EVERY: u64 = 2;

/// Writes a recording.
pub struct Recorder {
    stream: Stream,
    record: Record,
    scene: Option<Arc<Scene>>,
    views: Option<Views>,
    caption: String,
    frames: u64,
    /// Where the last frame was: events come between frames.
    passages: f64,
    /// Frames that came after the viewer was closed.
    unsent: u64,
}

/// What is set up by the first frame.
struct Views {
    geometry: Geometry,
    cadence: Cadence,
    series: Series,
    maps: Maps,
    slice: Option<Slice>,
    space: Option<Space>,
    centre_line: CentreLine,
    trace: Option<Trace>,
    kymographs: [Kymograph; 2],
    damage: Damage,
    /// Bodies whose damage is mapped.
    damaged: [bool; 2],
    /// Frames whose fields were logged.
    pictures: u64,
}

impl Recorder {
    /// Opens the file. Ranges and layout follow with the first frame.
    ///
    /// # Errors
    /// When the file exists and may not be replaced, or cannot be written.
    pub fn create(
        path: &Path,
        overwrite: Overwrite,
        record: &Record,
    ) -> Result<Self, ObserveError> {
        Ok(Self::on(Stream::create(path, overwrite)?, record))
    }

    /// Opens a connection to a viewer, or for viewers. Put it behind
    /// [`Queue::spawn_live`](crate::observe::Queue::spawn_live): a viewer may stall.
    ///
    /// # Errors
    /// When no viewer listens, or the port is busy.
    pub fn live(live: Live, record: &Record) -> Result<Self, ObserveError> {
        Ok(Self::on(Stream::live(live)?, record))
    }

    /// The file that is written now: the recording's own, or beside it where it will replace another; `None`: a
    /// viewer's.
    pub fn path(&self) -> Option<PathBuf> {
        self.stream.to().file().map(RecordingFile::path)
    }

    fn on(stream: Stream, record: &Record) -> Self {
        Self {
            stream,
            record: record.clone(),
            scene: None,
            views: None,
            caption: String::new(),
            frames: 0,
            passages: 0.0,
            unsent: 0,
        }
    }

    /// Logs one frame.
    fn log_frame(&mut self, frame: &Frame) -> Result<(), ObserveError> {
        let now = Moment::new(frame.step, frame.time_s, frame.passages);
        self.stream.set_time(now);
        let views = match &mut self.views {
            Some(views) => views,
            empty => {
                let views = Views::new(&self.stream, &self.record, self.scene.as_deref(), frame)?;
                empty.insert(views)
            }
        };
        if !views.geometry.holds(frame) {
            return Err(ObserveError::new(
                self.stream.output(),
                format!(
                    "a frame of {} x {} nodes came into a recording of {} x {}; a new grid needs a \
                     new recording",
                    frame.nx, frame.ny, views.geometry.nx, views.geometry.ny
                ),
            ));
        }
        let stream = &self.stream;
        let due = views.cadence.due(frame.step);
        if due.scalars {
            views.series.follow(frame);
        }
        views.follow(frame);
        if due.fields {
            text::log_now(stream, frame, &self.caption)?;
            views.log(stream, frame)?;
        }
        Ok(())
    }
}

impl Recorder {
    /// Whether enough was sent to a viewer that has not answered.
    fn is_unheard(&self) -> bool {
        let frame = |views: &Views| frame_bytes(views.geometry);
        let sent = self
            .frames
            .saturating_mul(self.views.as_ref().map_or(0, frame));
        self.stream.to().is_deaf(sent)
    }

    /// Hands what waits on to the file or the viewer.
    fn send_on(&mut self) -> Result<(), ObserveError> {
        if let Some(views) = &mut self.views {
            views.series.send(&self.stream)?;
        }
        self.stream.send_on()
    }
}

impl Views {
    fn new(
        stream: &Stream,
        record: &Record,
        scene: Option<&Scene>,
        first: &Frame,
    ) -> Result<Self, ObserveError> {
        let geometry = Geometry::of(first);
        if !geometry.holds(first) {
            return Err(ObserveError::new(
                stream.output(),
                "the first frame's fields have not the sizes of its grid",
            ));
        }
        let ranges = Ranges::of(first);
        let maps = Maps::new(stream, geometry, &ranges)?;
        let slice = Slice::new(stream, geometry, first, &ranges)?;
        let tops = Tops {
            pressure_pa: maps.pressure_top_pa(),
            effective_pa: slice.as_ref().map(Slice::effective_top_pa),
            rough: maps.rough(),
        };
        let space = Space::new(stream, geometry, first, tops)?;
        let centre_line = CentreLine::new(stream, geometry, tops.pressure_pa, maps.film_top_m())?;
        let trace = first
            .material_point
            .map(|_| Trace::new(stream, geometry, tops.pressure_pa))
            .transpose()?;
        let steps = expected_steps(scene, first);
        let step_s = scene.map_or(0.0, |scene| {
            scene.time.step_nodes * first.dx_m / scene.motion.entrainment_m_s.abs().max(1e-12)
        });
        let kymograph = |shown| Kymograph::new(stream, geometry, shown, steps, step_s);
        let kymographs = [
            kymograph(kymograph::Shown::Pressure {
                top_pa: tops.pressure_pa,
            })?,
            kymograph(kymograph::Shown::Film {
                top_m: maps.film_top_m(),
            })?,
        ];
        let cadence = Cadence::new(record, steps, frame_bytes(geometry));
        let exaggeration = space.as_ref().map(Space::note).unwrap_or_default();
        let slice_scales = slice.as_ref().map(Slice::scales).unwrap_or_default();
        let scales = maps.scales().iter().chain(slice_scales);
        text::log_notes(stream, scales, &cadence.note(), &exaggeration)?;
        let views = Self {
            geometry,
            cadence,
            series: Series::new(stream)?,
            maps,
            slice,
            space,
            centre_line,
            trace,
            kymographs,
            damage: Damage::default(),
            damaged: scene
                .and_then(|scene| scene.life.as_ref())
                .map_or([false; 2], crate::scene::Life::maps),
            pictures: 0,
        };
        layout::send(stream, &views.shown(first))?;
        Ok(views)
    }

    fn shown(&self, first: &Frame) -> Shown {
        Shown {
            map: maps::plot_box(self.geometry),
            interferogram: self.maps.interferogram().plot().clone(),
            centre_line: self.centre_line.plot().clone(),
            slice: self.slice.as_ref().map(|slice| slice.plot().clone()),
            trace: self.trace.as_ref().map(|trace| trace.plot().clone()),
            kymograph: self.kymographs[0].plot().clone(),
            camera: self.space.as_ref().map(Space::camera),
            rough: self.maps.rough(),
            damaged: self.damaged,
            life: first.metrics.life.is_some(),
        }
    }

    /// What has to see every step.
    fn follow(&mut self, frame: &Frame) {
        if let Some(trace) = &mut self.trace {
            trace.follow(frame);
        }
        for kymograph in &mut self.kymographs {
            kymograph.follow(frame);
        }
    }

    /// The fields of a frame.
    fn log(&mut self, stream: &Stream, frame: &Frame) -> Result<(), ObserveError> {
        self.maps.log(stream, frame)?;
        self.centre_line.log(stream, frame)?;
        if let Some(slice) = &mut self.slice {
            slice.log(stream, frame)?;
        }
        if let Some(space) = &mut self.space {
            space.log(stream, frame)?;
        }
        if let Some(trace) = &mut self.trace {
            trace.log(stream, frame)?;
        }
        if self.pictures.is_multiple_of(BESIDE_EVERY) {
            self.maps.log_beside(stream, frame)?;
            if let Some(slice) = &self.slice {
                slice.log_shear(stream, frame)?;
            }
            if let Some(space) = &mut self.space {
                space.log_damage(stream, frame)?;
            }
            self.damage.log(stream, frame)?;
        }
        self.pictures += 1;
        for kymograph in &mut self.kymographs {
            kymograph.log_if_due(stream)?;
        }
        Ok(())
    }
}

impl Observer for Recorder {
    fn begin(&mut self, context: &RunContext) -> Result<(), ObserveError> {
        self.scene = Some(Arc::clone(&context.scene));
        text::log_context(&self.stream, context)?;
        self.stream.set_time(Moment::new(0, 0.0, 0.0));
        let first = format!("recorded by {}; {}", context.program, text::CAUTION);
        text::log_line(&self.stream, &first, TextLogLevel::INFO)?;
        // What repeats the run is on the disk before it starts.
        self.stream.send_on()
    }

    /// Records a frame of the passage; the start-up is not part of the results.
    fn frame(&mut self, frame: &Arc<Frame>) -> Result<(), ObserveError> {
        if frame.stage == Stage::StartUp {
            return Ok(());
        }
        if self.stream.is_gone() || self.is_unheard() {
            self.unsent += 1;
            return Ok(());
        }
        self.passages = frame.passages;
        self.log_frame(frame)?;
        let full = |views: &Views| views.series.is_full();
        if self.stream.is_due() || self.views.as_ref().is_some_and(full) {
            self.send_on()?;
        }
        self.stream.check()?;
        if let Some(file) = self.stream.to().file() {
            file.hold();
        }
        self.frames += 1;
        let on_disk = self.stream.bytes();
        let thinned = self
            .views
            .as_mut()
            .and_then(|views| views.cadence.watch(frame.step, on_disk));
        if let Some(note) = thinned {
            text::log_line(&self.stream, &note, TextLogLevel::WARN)?;
        }
        Ok(())
    }

    fn event(&mut self, event: &RunEvent) -> Result<(), ObserveError> {
        if self.stream.is_gone() {
            return Ok(());
        }
        let now = Moment::new(event.step, event.time_s, self.passages);
        self.stream.set_time(now);
        if let RunEventKind::Caption(caption) = &event.kind {
            self.caption.clone_from(caption);
        }
        text::log_event(&self.stream, event)
    }

    /// A run that pauses keeps nothing back.
    fn idle(&mut self) -> Result<(), ObserveError> {
        if self.stream.is_gone() {
            return Ok(());
        }
        self.send_on()?;
        self.stream.check()
    }

    fn finish(&mut self) -> Result<ObserverReport, ObserveError> {
        if let Some(views) = &mut self.views
            && !self.stream.is_gone()
        {
            for kymograph in &mut views.kymographs {
                kymograph.log(&self.stream)?;
            }
            views.series.send(&self.stream)?;
            let last = format!("the recording ends after {} steps", self.frames);
            text::log_line(&self.stream, &last, TextLogLevel::INFO)?;
        }
        self.stream.close()?;
        let (stream, frames) = (&self.stream, self.frames);
        Ok(stream.to().report(stream.output(), frames, self.unsent))
    }
}

impl Drop for Recorder {
    /// A recording that nobody finished holds what it was given.
    fn drop(&mut self) {
        if let Some(views) = &mut self.views
            && !self.stream.is_gone()
        {
            // Nobody is left to tell; `finish` was the place to see errors.
            drop(views.series.send(&self.stream));
        }
    }
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
fn frame_bytes(g: Geometry) -> u64 {
    let nodes = (g.nx * g.ny) as u64;
    // Two maps of two bytes and one of one, the slice; of every second frame three maps more, the
    // interferogram and another slice; the sheets of the 3-D view.
    (5 + 2 + (6 + 4 + 2) / 2) * nodes + 100_000
}
