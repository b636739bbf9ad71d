//! Puts the parts of a recording together.

pub(super) mod views;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use rerun::TextLogLevel;

use self::views::ViewState;
use super::file::RecordingFile;
use super::gate::Gate;
use super::live::Live;
use super::moment::Moment;
use super::stream::Stream;
use super::{properties, text};
use asperity_engine::observe::{
    ObserveError, Observer, ObserverReport, Overwrite, RunContext, RunEvent, RunEventKind,
};
use asperity_engine::scene::{Record, Scene};
use asperity_engine::sim::{Frame, Stage};

/// Steps that did not converge that are listed one by one.
const MOST_UNCONVERGED: u64 = 200;

/// Writes a recording.
pub struct Recorder {
    stream: Stream,
    record: Record,
    scene: Option<Arc<Scene>>,
    views: Option<ViewState>,
    caption: String,
    /// What happened before the first frame: it is logged with it, so that the recording begins with a picture.
    early: Vec<RunEvent>,
    program: String,
    last: Option<properties::Last>,
    /// Knobs turned so far.
    turns: u64,
    /// Steps that did not converge so far.
    unconverged: u64,
    /// What the file was told last of how far it goes: steps and turns.
    told: (u64, u64),
    frames: u64,
    /// Where the last frame was: events come between frames.
    passages: f64,
    /// Frames that came after the viewer was closed.
    unsent: u64,
    /// The door that viewers came by, who are served until they have left.
    gate: Option<Gate>,
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

    /// Goes on serving those who came by this door until the last one has left.
    #[must_use]
    pub fn holding(mut self, gate: Gate) -> Self {
        self.gate = Some(gate);
        self
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
            early: Vec::new(),
            program: String::new(),
            last: None,
            turns: 0,
            unconverged: 0,
            told: (0, 0),
            frames: 0,
            passages: 0.0,
            unsent: 0,
            gate: None,
        }
    }

    /// Logs one frame.
    fn log_frame(&mut self, frame: &Frame) -> Result<(), ObserveError> {
        let now = Moment::new(frame.step, frame.time_s, frame.passages);
        self.stream.set_time(now);
        if self.views.is_none() {
            self.log_early()?;
        }
        let views = match &mut self.views {
            Some(views) => views,
            empty => {
                let views =
                    ViewState::new(&self.stream, &self.record, self.scene.as_deref(), frame)?;
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
        let before = stream.weight();
        if due.fields {
            views.log(stream, self.scene.as_deref(), frame)?;
            text::log_now(stream, frame, &self.caption, &views.beyond())?;
            views.cadence.took(stream.weight() - before);
        }
        let weight = stream.weight() + views.series.weight();
        if let Some(note) = views.cadence.watch(frame.step, weight) {
            text::log_line(stream, &note, TextLogLevel::WARN)?;
        }
        Ok(())
    }

    /// Logs what came before the first frame.
    fn log_early(&mut self) -> Result<(), ObserveError> {
        let first = format!("recorded by {}; {}", self.program, text::CAUTION);
        text::log_line(&self.stream, &first, TextLogLevel::INFO)?;
        for event in std::mem::take(&mut self.early) {
            self.log_event(&event)?;
        }
        Ok(())
    }

    fn log_event(&mut self, event: &RunEvent) -> Result<(), ObserveError> {
        if let RunEventKind::NotConverged { .. } = event.kind {
            self.unconverged += 1;
            if self.unconverged > MOST_UNCONVERGED {
                return Ok(());
            }
        }
        text::log_event(&self.stream, event, self.turns)?;
        self.turns += u64::from(matches!(event.kind, RunEventKind::Set { .. }));
        if self.unconverged == MOST_UNCONVERGED {
            let rest = "further steps that do not converge are in the series and not in this log";
            self.unconverged += 1;
            return text::log_line(&self.stream, rest, TextLogLevel::WARN);
        }
        Ok(())
    }

    /// Tells how far it goes, after what it goes through.
    fn log_reach(&mut self, ended: bool) -> Result<(), ObserveError> {
        let now = (self.last.as_ref().map_or(0, |last| last.step), self.turns);
        if self.stream.is_live() || (now == self.told && !ended) {
            return Ok(());
        }
        self.told = now;
        text::log_reach(&self.stream, now.0, now.1, ended)
    }
}

impl Recorder {
    /// Whether enough was sent to a viewer that has not answered.
    fn is_unheard(&self) -> bool {
        let frame = |views: &ViewState| views::frame_bytes(views.geometry);
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
        self.stream.send_on()?;
        self.log_reach(false)
    }
}

impl Observer for Recorder {
    fn begin(&mut self, context: &RunContext) -> Result<(), ObserveError> {
        self.scene = Some(Arc::clone(&context.scene));
        self.program.clone_from(&context.program);
        properties::log_scene(&self.stream, context)?;
        text::log_context(&self.stream, context)?;
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
        self.last = Some(properties::Last::of(frame));
        let full = |views: &ViewState| views.series.is_full();
        if self.stream.is_due() || self.views.as_ref().is_some_and(full) {
            self.send_on()?;
        }
        if let Some(file) = self.stream.to().file() {
            file.hold();
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
        if let RunEventKind::Caption(caption) = &event.kind {
            self.caption.clone_from(caption);
        }
        if self.views.is_none() {
            self.early.push(event.clone());
            return Ok(());
        }
        let now = Moment::new(event.step, event.time_s, self.passages);
        self.stream.set_time(now);
        self.log_event(event)
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
        let (clipped, clipped_words) = self
            .views
            .as_ref()
            .map(ViewState::clipped)
            .unwrap_or_default();
        if self.views.is_none() && !self.stream.is_gone() {
            // A run without a frame still tells what happened.
            self.stream.set_time(Moment::new(0, 0.0, 0.0));
            self.log_early()?;
        }
        if let Some(views) = &mut self.views
            && !self.stream.is_gone()
        {
            if let Some(last) = &self.last {
                properties::log_result(&self.stream, last, clipped)?;
            }
            for kymograph in &mut views.kymographs {
                kymograph.log(&self.stream)?;
            }
            views.series.send(&self.stream)?;
            let last = format!("the recording ends after {} steps", self.frames);
            text::log_line(&self.stream, &last, TextLogLevel::INFO)?;
            if clipped > 0 {
                let told = format!("values that could not be stored as they are: {clipped_words}");
                text::log_line(&self.stream, &told, TextLogLevel::WARN)?;
            }
        }
        if !self.stream.is_gone() {
            self.log_reach(true)?;
        }
        self.stream.close()?;
        if let Some(gate) = &self.gate {
            gate.wait_until_left();
        }
        let (stream, frames) = (&self.stream, self.frames);
        let mut report = stream.to().report(stream.output(), frames, self.unsent);
        for note in [
            (clipped > 0).then(|| format!("clipped: {clipped_words}")),
            stream
                .to()
                .file()
                .and_then(RecordingFile::unbound)
                .map(|reason| format!("without a footer, so viewers read all of it: {reason}")),
        ]
        .into_iter()
        .flatten()
        {
            if !report.note.is_empty() {
                report.note.push_str("; ");
            }
            report.note.push_str(&note);
        }
        Ok(report)
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
            drop(self.log_reach(false));
        }
    }
}
