//! A bounded queue that runs an observer on a thread of its own.
//!
//! An observer that writes to a disk or a socket may block; the solver must not. The queue holds
//! at most `capacity` frames (references, no copies). When it is full, a headless run waits
//! ([`WhenFull::Wait`], so the file is complete) and a live run goes on ([`WhenFull::Skip`], and
//! what was skipped is counted). An error of the observer comes back on the next call and again
//! from `finish`; the observer is not called any more after it.
//!
//! Of the standard library's channels, which are `crossbeam`'s: one of messages, closed to end the thread, and one whose places
//! stand for the frames that wait.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, TrySendError, sync_channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use asperity_engine::observe::QueueStats;
use asperity_engine::observe::{ObserveError, Observer, ObserverReport, RunContext, RunEvent};
use asperity_engine::sim::Frame;

/// Events that may wait besides the frames before they are treated like frames.
const EVENT_CAPACITY: usize = 1024;

/// After so long without a message the observer is told that it is idle.
const IDLE: Duration = Duration::from_secs(1);

/// How long the end of a run waits for an observer that may stall.
const LAST_WAIT: Duration = Duration::from_secs(5);

/// What to do with a frame when the queue is full.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WhenFull {
    /// Wait for room: nothing is lost, a slow observer slows the run.
    Wait,
    /// Drop it and count it: the run never waits.
    Skip,
}

enum Message {
    /// Answered when the observer has begun.
    Begin(Box<RunContext>, SyncSender<()>),
    Frame(Arc<Frame>),
    Event(RunEvent),
}

#[derive(Default)]
struct QueueState {
    error: Option<ObserveError>,
    report: Option<ObserverReport>,
    stats: QueueStats,
    /// Frames that wait no longer.
    n_delivered: u64,
    /// What the observer says that it kept.
    kept: Option<u64>,
}

/// The state stays consistent between statements, so a panic elsewhere does not spoil it.
fn lock(state: &Mutex<QueueState>) -> MutexGuard<'_, QueueState> {
    state.lock().unwrap_or_else(PoisonError::into_inner)
}

/// What the observer's thread takes from.
struct Inlet {
    messages: Receiver<Message>,
    /// A place for every frame that waits.
    room: Receiver<()>,
    /// Closed when the thread has nothing more to do.
    _ended: SyncSender<()>,
}

/// Runs an observer on its own thread behind a bounded queue.
pub struct Queue {
    state: Arc<Mutex<QueueState>>,
    /// `None`: no more will come.
    messages: Option<SyncSender<Message>>,
    room: SyncSender<()>,
    ended: Receiver<()>,
    thread: Option<JoinHandle<()>>,
    name: String,
    when_full: WhenFull,
    /// How long the end waits for the observer; `None`: for ever.
    patience: Option<Duration>,
}

impl Queue {
    /// Starts the thread `name`, on which `observer` will be called.
    ///
    /// # Errors
    /// When the thread cannot be started.
    pub fn spawn(
        name: &str,
        capacity: usize,
        when_full: WhenFull,
        mut observer: Box<dyn Observer>,
    ) -> Result<Self, ObserveError> {
        let state = Arc::new(Mutex::new(QueueState::default()));
        let capacity = capacity.max(1);
        lock(&state).stats.capacity = capacity;
        let (messages, to_deliver) = sync_channel(capacity + EVENT_CAPACITY);
        let (room, places) = sync_channel(capacity);
        let (end, ended) = sync_channel(1);
        let inlet = Inlet {
            messages: to_deliver,
            room: places,
            _ended: end,
        };
        let on_thread = Arc::clone(&state);
        let label = name.to_owned();
        let thread = std::thread::Builder::new()
            .name(name.to_owned())
            .spawn(move || {
                serve(&on_thread, &inlet, observer.as_mut(), &label);
                // Before the observer, which may stall even while it goes.
                drop(inlet);
            })
            .map_err(|error| {
                ObserveError::new(name, format!("its thread did not start: {error}"))
            })?;
        Ok(Self {
            state,
            messages: Some(messages),
            room,
            ended,
            thread: Some(thread),
            name: name.to_owned(),
            when_full,
            patience: None,
        })
    }

    /// Same for an observer that may stall for as long as somebody else likes (a viewer): frames are skipped
    /// and counted when the queue is full, and at the end it is left alone after a few seconds.
    ///
    /// # Errors
    /// When the thread cannot be started.
    pub fn spawn_live(
        name: &str,
        capacity: usize,
        observer: Box<dyn Observer>,
    ) -> Result<Self, ObserveError> {
        let mut queue = Self::spawn(name, capacity, WhenFull::Skip, observer)?;
        queue.patience = Some(LAST_WAIT);
        Ok(queue)
    }

    /// How the queue was used so far.
    pub fn stats(&self) -> QueueStats {
        lock(&self.state).stats
    }

    /// Why nothing is taken any more.
    fn failure(&self) -> ObserveError {
        let error = lock(&self.state).error.clone();
        error.unwrap_or_else(|| ObserveError::new(&self.name, "was finished already"))
    }

    /// Puts `value` into a channel, waiting or not; whether it is in.
    fn put<T>(&self, channel: &SyncSender<T>, value: T) -> Result<bool, ObserveError> {
        match channel.try_send(value) {
            Ok(()) => Ok(true),
            Err(TrySendError::Full(_)) if self.when_full == WhenFull::Skip => Ok(false),
            Err(TrySendError::Full(value)) => {
                let since = Instant::now();
                let sent = channel.send(value);
                let mut state = lock(&self.state);
                state.stats.waits += 1;
                state.stats.waited += since.elapsed();
                drop(state);
                sent.map(|()| true).map_err(|_| self.failure())
            }
            Err(TrySendError::Disconnected(_)) => Err(self.failure()),
        }
    }

    /// Waits for an observer that may stall; a report in its place when it does not come to an end.
    fn give_up(&self) -> Option<ObserverReport> {
        let waited = self.ended.recv_timeout(self.patience?);
        (waited == Err(RecvTimeoutError::Timeout)).then(|| {
            let state = lock(&self.state);
            ObserverReport {
                output: self.name.clone(),
                frames: state.n_delivered,
                skipped: state.stats.skipped + state.stats.frames - state.n_delivered,
                bytes: 0,
                note: "it no longer took anything and was left alone".to_owned(),
                queue: Some(state.stats),
            }
        })
    }

    /// Waits until the thread has ended.
    fn join(&mut self) {
        if let Some(thread) = self.thread.take() {
            if self.patience.is_some() {
                // It may stall even while it drops its connection; it ends with the program.
                return;
            }
            // A panic of the observer was caught on the thread and is in `error`.
            drop(thread.join());
        }
    }
}

impl Observer for Queue {
    fn begin(&mut self, context: &RunContext) -> Result<(), ObserveError> {
        let (answer, begun) = sync_channel(1);
        let messages = self.messages.as_ref().ok_or_else(|| self.failure())?;
        self.put(messages, Message::Begin(Box::new(context.clone()), answer))?;
        begun.recv().map_err(|_| {
            // The error is there when the thread has ended.
            let _ = self.ended.recv();
            self.failure()
        })
    }

    fn frame(&mut self, frame: &Arc<Frame>) -> Result<(), ObserveError> {
        let messages = self.messages.as_ref().ok_or_else(|| self.failure())?;
        let has_place = self.put(&self.room, ())?;
        let mut state = lock(&self.state);
        if !has_place {
            state.stats.skipped += 1;
            return Ok(());
        }
        state.stats.frames += 1;
        let depth = (state.stats.frames - state.n_delivered) as usize;
        state.stats.max_depth = state.stats.max_depth.max(depth);
        drop(state);
        self.put(messages, Message::Frame(Arc::clone(frame)))?;
        Ok(())
    }

    fn skipped(&self) -> u64 {
        self.stats().skipped
    }

    fn kept(&self) -> Option<u64> {
        lock(&self.state).kept
    }

    fn event(&mut self, event: &RunEvent) -> Result<(), ObserveError> {
        let messages = self.messages.as_ref().ok_or_else(|| self.failure())?;
        self.put(messages, Message::Event(event.clone()))?;
        Ok(())
    }

    fn finish(&mut self) -> Result<ObserverReport, ObserveError> {
        self.messages = None;
        if let Some(report) = self.give_up() {
            return Ok(report);
        }
        self.join();
        let state = lock(&self.state);
        let none = || ObserveError::new(&self.name, "ended without a report");
        let error = || state.error.clone().unwrap_or_else(none);
        let mut report = state.report.clone().ok_or_else(error)?;
        report.skipped += state.stats.skipped;
        report.queue = Some(state.stats);
        Ok(report)
    }
}

impl Drop for Queue {
    /// Lets the observer work off what is waiting, so that a dropped queue leaves whole outputs.
    fn drop(&mut self) {
        if self.thread.is_some() {
            self.messages = None;
            drop(self.give_up());
            self.join();
        }
    }
}

/// The observer's thread: works off messages until no more will come, or the observer fails or panics.
fn serve(state: &Mutex<QueueState>, inlet: &Inlet, observer: &mut dyn Observer, name: &str) {
    // A pause is told once, until the next message.
    let mut is_idle = false;
    loop {
        let next = if is_idle {
            let next = inlet.messages.recv();
            next.map_err(|_| RecvTimeoutError::Disconnected)
        } else {
            inlet.messages.recv_timeout(IDLE)
        };
        is_idle = next.is_err();
        if let Ok(Message::Frame(_)) = &next {
            lock(state).n_delivered += 1;
            // Its place was taken before it was sent.
            let _ = inlet.room.try_recv();
        }
        let is_last = matches!(next, Err(RecvTimeoutError::Disconnected));
        let outcome = catch_unwind(AssertUnwindSafe(|| match next {
            Ok(message) => deliver(state, observer, message),
            Err(RecvTimeoutError::Timeout) => observer.idle(),
            Err(RecvTimeoutError::Disconnected) => {
                let report = observer.finish()?;
                lock(state).report = Some(report);
                Ok(())
            }
        }));
        let result = outcome.unwrap_or_else(|_| {
            Err(ObserveError::new(
                name,
                "stopped by a programming error (panic); what was written before is kept",
            ))
        });
        let failed = result.is_err();
        lock(state).error = result.err();
        if is_last || failed {
            return;
        }
    }
}

fn deliver(
    state: &Mutex<QueueState>,
    observer: &mut dyn Observer,
    message: Message,
) -> Result<(), ObserveError> {
    match message {
        Message::Begin(context, answer) => {
            observer.begin(&context)?;
            // Who asked may have gone.
            let _ = answer.send(());
            Ok(())
        }
        Message::Frame(frame) => {
            let since = Instant::now();
            let written = observer.frame(&frame);
            let mut state = lock(state);
            state.kept = observer.kept();
            state.stats.busy += since.elapsed();
            state.stats.done += 1;
            written
        }
        Message::Event(event) => observer.event(&event),
    }
}

#[cfg(test)]
mod tests;
