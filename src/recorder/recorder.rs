//! Puts the parts of a recording together.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use rerun::{RecordingStream, TextLogLevel};

use super::entities::text::REACH;
use super::file::RecordingFile;
use super::layout;
use super::live::Live;
use super::moment::Moment;
use super::note::Note;
use super::run_views::{self, RunViews};
use super::series::Series;
use super::shown::Knobs;
use super::stream::Stream;
use super::{properties, text};
use asperity_engine::observe::{
    ObserveError, Observer, ObserverReport, Overwrite, RunContext, RunEvent, RunEventKind,
};
use asperity_engine::scene::{Record, Scene};
use asperity_engine::sim::{Frame, Stage};
use asperity_picture::{Scope, Window};

/// Steps that did not converge that are listed one by one.
const MOST_UNCONVERGED: u64 = 200;

/// Serves viewers for as long as it is kept.
pub struct Server {
    _recording: RecordingStream,
}

/// Writes a recording.
pub struct Recorder {
    stream: Stream,
    record: Record,
    scene: Option<Arc<Scene>>,
    /// Whether somebody may turn knobs while it runs.
    by_hand: bool,
    /// What of its frames is recorded.
    window: Option<Window>,
    views: Option<RunViews>,
    caption: String,
    /// What happened before the first frame: it is logged with it, so that the recording begins with a picture.
    early: Vec<RunEvent>,
    program: String,
    last: Option<properties::Last>,
    /// The last frame, where its fields were not recorded.
    left_out: Option<Arc<Frame>>,
    /// Knobs turned so far.
    turns: u64,
    /// Steps that did not converge so far.
    unconverged: u64,
    frames: u64,
    /// Frames that were logged.
    taken: u64,
    /// Where the last frame was: events come between frames.
    passages: f64,
    /// Frames that came after the viewer was closed.
    unsent: u64,
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
    /// [`Queue::spawn_live`](asperity_session::Queue::spawn_live): a viewer may stall.
    ///
    /// # Errors
    /// When no viewer listens, or the port is busy.
    pub fn live(live: Live, record: &Record) -> Result<Self, ObserveError> {
        Ok(Self::on(Stream::live(live)?, record))
    }

    /// The same of a run whose knobs somebody may turn: it has curves of them.
    #[must_use]
    pub fn by_hand(mut self) -> Self {
        self.by_hand = true;
        self
    }

    /// What goes on serving viewers when the recorder has finished, for as long as it is kept.
    pub fn server(&self) -> Server {
        Server {
            _recording: self.stream.recording().clone(),
        }
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
            by_hand: false,
            window: None,
            views: None,
            caption: String::new(),
            early: Vec::new(),
            program: String::new(),
            last: None,
            left_out: None,
            turns: 0,
            unconverged: 0,
            frames: 0,
            taken: 0,
            passages: 0.0,
            unsent: 0,
        }
    }

    /// Logs one frame; whether its fields were due.
    fn log_frame(&mut self, frame: &Frame) -> Result<bool, ObserveError> {
        let now = Moment::of_frame(frame);
        self.stream.set_time(now);
        let scene = self.scene.as_deref();
        let around = || Window::around(frame, Scope::of(scene, frame).to_come.size);
        let window = self.window.get_or_insert_with(around);
        // A frame of another grid is refused below.
        let cut = window.is_of(frame).then(|| window.cut(frame));
        let frame = cut.as_ref().unwrap_or(frame);
        if self.views.is_none() {
            self.log_early();
            let scene = self.scene.as_deref();
            let knobs = if self.by_hand {
                Knobs::Turn
            } else {
                Knobs::of(scene)
            };
            let series = Series::new(&self.stream, frame.kind, knobs);
            let mut views = RunViews::new(&self.stream, &self.record, scene, frame, series, None)?;
            views.shown.knobs = knobs;
            layout::send(&self.stream, &views.shown)?;
            self.views = Some(views);
        }
        let Some(views) = &mut self.views else {
            return Ok(false);
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
            views.series.follow(stream, frame);
        }
        views.follow(frame);
        if due.fields {
            let before = stream.expected_bytes();
            views.log(stream, self.scene.as_deref(), frame);
            text::log_now(stream, frame, &self.caption, &views.above_ranges());
            views.cadence.note_fields(stream.expected_bytes() - before);
        }
        if let Some(note) = views.cadence.watch(frame.step, stream.expected_bytes()) {
            text::log_line(stream, &note, TextLogLevel::WARN);
        }
        Ok(due.fields)
    }

    /// Logs the last step whole where its fields were not due, so that a run's end is seen; not where the budget is spent.
    fn log_left_out(&mut self) {
        let (Some(frame), Some(window)) = (self.left_out.take(), &self.window) else {
            return;
        };
        if let Some(views) = self.views.as_mut().filter(|views| views.cadence.has_room()) {
            let now = Moment::of_frame(&frame);
            self.stream.set_time(now);
            let (scene, frame) = (self.scene.as_deref(), window.cut(&frame));
            views.log_whole(&self.stream, scene, &frame);
            text::log_now(&self.stream, &frame, &self.caption, &views.above_ranges());
        }
    }

    /// Logs what came before the first frame.
    fn log_early(&mut self) {
        let first = format!("recorded by {}; {}", self.program, text::CAUTION);
        text::log_line(&self.stream, &first, TextLogLevel::INFO);
        for event in std::mem::take(&mut self.early) {
            self.log_event(&event);
        }
    }

    fn log_event(&mut self, event: &RunEvent) {
        if let RunEventKind::NotConverged { .. } = event.kind {
            self.unconverged += 1;
            if self.unconverged > MOST_UNCONVERGED {
                return;
            }
        }
        text::log_event(&self.stream, event, self.turns);
        self.turns += u64::from(matches!(event.kind, RunEventKind::Set { .. }));
        if self.unconverged == MOST_UNCONVERGED {
            let rest = "further steps that do not converge are in the series and not in this log";
            self.unconverged += 1;
            text::log_line(&self.stream, rest, TextLogLevel::WARN);
        }
    }

    /// Writes what waits, and how far the recording then goes; `ended`: nothing comes after.
    fn flush(&mut self, ended: bool) -> Result<(), ObserveError> {
        let reach = Note::Reach {
            last_step: self.last.as_ref().map_or(0, |last| last.step),
            turns: self.turns,
            ended,
        };
        if let Some(views) = &mut self.views {
            views.series.send(&self.stream);
        }
        self.stream.flush(Some((REACH, reach)))?;
        if let Some(last) = &self.last {
            self.stream.note_safe(self.taken, last.step);
        }
        Ok(())
    }

    /// Whether enough was sent to a viewer that has not answered.
    fn is_unheard(&self) -> bool {
        let frame = |views: &RunViews| run_views::frame_bytes(views.geometry);
        let sent = self
            .frames
            .saturating_mul(self.views.as_ref().map_or(0, frame));
        self.stream.to().is_deaf(sent)
    }
}

impl Observer for Recorder {
    fn begin(&mut self, context: &RunContext) -> Result<(), ObserveError> {
        self.scene = Some(Arc::clone(&context.scene));
        self.program.clone_from(&context.program);
        properties::log_scene(&self.stream, context);
        text::log_context(&self.stream, context);
        // Whoever looks on reads what runs until there is a picture.
        if self.stream.is_live() {
            layout::send_early(&self.stream)?;
        }
        // What repeats the run is on the disk before it starts, and that nothing of it is there yet.
        self.flush(false)
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
        let is_whole = self.log_frame(frame)?;
        self.left_out = (!is_whole).then(|| Arc::clone(frame));
        self.last = Some(properties::Last::of(frame));
        self.taken += 1;
        // The first at once: a recording that breaks off early has a picture.
        if self.taken == 1 || self.stream.is_flush_due() {
            self.flush(false)?;
        }
        if let Some(file) = self.stream.to().file() {
            file.mark_worth_keeping();
        }
        self.stream.check()?;
        self.frames += 1;
        Ok(())
    }

    fn kept(&self) -> Option<u64> {
        self.views.as_ref().map(|views| views.pictures)
    }

    fn event(&mut self, event: &RunEvent) -> Result<(), ObserveError> {
        if self.stream.is_gone() {
            return Ok(());
        }
        match &event.kind {
            RunEventKind::Caption(caption) => self.caption.clone_from(caption),
            RunEventKind::CutShort => {
                if let Some(file) = self.stream.to().file() {
                    file.cut_short();
                }
            }
            RunEventKind::Set { .. } | RunEventKind::NotConverged { .. } => {}
        }
        if self.views.is_none() {
            self.early.push(event.clone());
            return Ok(());
        }
        let now = Moment::new(event.step, event.time_s, self.passages);
        self.stream.set_time(now);
        self.log_event(event);
        Ok(())
    }

    /// A run that pauses keeps nothing back.
    fn idle(&mut self) -> Result<(), ObserveError> {
        if self.stream.is_gone() {
            return Ok(());
        }
        self.flush(false)
    }

    fn finish(&mut self) -> Result<ObserverReport, ObserveError> {
        if self.views.is_none() && !self.stream.is_gone() {
            // A run without a frame still tells what happened.
            self.stream.set_time(Moment::new(0, 0.0, 0.0));
            self.log_early();
        }
        if !self.stream.is_gone() {
            self.log_left_out();
        }
        if let Some(views) = &mut self.views
            && !self.stream.is_gone()
        {
            if let Some(last) = &self.last {
                properties::log_result(&self.stream, last);
            }
            views.finish(&self.stream);
            let last = format!("the recording ends after {} steps", self.frames);
            text::log_line(&self.stream, &last, TextLogLevel::INFO);
        }
        if !self.stream.is_gone() {
            self.flush(true)?;
        }
        self.stream.close()?;
        let (stream, frames) = (&self.stream, self.frames);
        let aside = stream.to().file().and_then(RecordingFile::set_aside);
        let output = aside.map_or_else(|| stream.output(), |at| at.display().to_string());
        let mut report = stream.to().report(output, frames, self.unsent);
        let not_compacted = stream.to().file().and_then(RecordingFile::not_compacted);
        if let Some(reason) = not_compacted {
            report.note = format!("without a footer, so viewers read all of it: {reason}");
        }
        Ok(report)
    }
}

impl Drop for Recorder {
    /// A recording that nobody finished holds what it was given.
    fn drop(&mut self) {
        if !self.stream.is_gone() {
            // Nobody is left to tell; `finish` was the place to see errors.
            drop(self.flush(false));
        }
    }
}
