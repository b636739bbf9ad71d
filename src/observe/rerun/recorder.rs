//! Puts the parts of a recording together.

use std::path::Path;
use std::sync::Arc;

use rerun::TextLogLevel;

use super::cadence::Cadence;
use super::centre_line::CentreLine;
use super::damage::Damage;
use super::geometry::Geometry;
use super::kymograph::{self, Kymograph};
use super::layout::{self, Shown};
use super::live::Live;
use super::maps::{self, Maps};
use super::slice::Slice;
use super::space::{Space, Tops};
use super::stream::Stream;
use super::trace::Trace;
use super::{series, text};
use crate::observe::{
    ObserveError, Observer, ObserverReport, Overwrite, RunContext, RunEvent, RunEventKind,
};
use crate::scene::{Record, Scene};
use crate::sim::{Frame, Stage};

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
    maps: Maps,
    slice: Option<Slice>,
    space: Option<Space>,
    centre_line: CentreLine,
    trace: Option<Trace>,
    kymographs: [Kymograph; 2],
    damage: Damage,
    /// Bodies whose damage is mapped.
    damaged: [bool; 2],
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
        self.stream
            .set_time(frame.step, frame.time_s, frame.passages);
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
            series::log(stream, frame)?;
        }
        views.follow(frame);
        if due.fields {
            text::log_now(stream, frame, &self.caption)?;
            views.log(stream, frame)?;
        }
        Ok(())
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
        let maps = Maps::new(stream, geometry, first)?;
        let slice = Slice::new(stream, geometry, first, maps.pressure_top_pa())?;
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
        series::log_styles(stream)?;
        let cadence = Cadence::new(record, steps, frame_bytes(geometry));
        let exaggeration = space.as_ref().map(Space::note).unwrap_or_default();
        let slice_scales = slice.as_ref().map(Slice::scales).unwrap_or_default();
        let scales = maps.scales().iter().chain(slice_scales);
        text::log_notes(stream, scales, &cadence.note(), &exaggeration)?;
        let views = Self {
            geometry,
            cadence,
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
        if let Some(slice) = &self.slice {
            slice.log(stream, frame)?;
        }
        if let Some(space) = &mut self.space {
            space.log(stream, frame)?;
        }
        if let Some(trace) = &self.trace {
            trace.log(stream, frame)?;
        }
        self.damage.log(stream, frame)?;
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
        // What repeats the run is on the disk before it starts.
        self.stream.send_on();
        Ok(())
    }

    /// Records a frame of the passage; the start-up is not part of the results.
    fn frame(&mut self, frame: &Arc<Frame>) -> Result<(), ObserveError> {
        if frame.stage == Stage::StartUp {
            return Ok(());
        }
        if self.stream.is_gone() {
            self.unsent += 1;
            return Ok(());
        }
        self.passages = frame.passages;
        self.log_frame(frame)?;
        self.stream.send_on_if_due();
        self.stream.check()?;
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
        self.stream
            .set_time(event.step, event.time_s, self.passages);
        if let RunEventKind::Caption(caption) = &event.kind {
            self.caption.clone_from(caption);
        }
        text::log_event(&self.stream, event)
    }

    fn finish(&mut self) -> Result<ObserverReport, ObserveError> {
        if let Some(views) = &mut self.views
            && !self.stream.is_gone()
        {
            for kymograph in &mut views.kymographs {
                kymograph.log(&self.stream)?;
            }
        }
        self.stream.close()?;
        Ok(ObserverReport {
            output: self.stream.output(),
            frames: self.frames,
            skipped: self.unsent,
            bytes: self.stream.bytes(),
            note: if self.unsent > 0 {
                "the viewer was closed".to_owned()
            } else {
                String::new()
            },
        })
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
    // Five maps of two bytes and one of one; the interferogram of four; the slice's two images; the
    // sheets of the 3-D view.
    (11 + 4 + 3) * nodes + 130_000
}
