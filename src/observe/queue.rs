//! A bounded queue that runs an observer on a thread of its own.
//!
//! An observer that writes to a disk or a socket may block; the solver must not. The queue holds
//! at most `capacity` frames (references, no copies). When it is full, a headless run waits
//! ([`WhenFull::Wait`], so the file is complete) and a live run goes on ([`WhenFull::Skip`], and
//! what was skipped is counted). An error of the observer comes back on the next call and again
//! from `finish`; the observer is not called any more after it.

mod stats;

use std::collections::VecDeque;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

pub use self::stats::QueueStats;
use super::{ObserveError, Observer, ObserverReport, RunContext, RunEvent};
use crate::sim::Frame;

/// Events that may wait besides the frames before they are treated like frames.
const EVENT_CAPACITY: usize = 1024;

/// After so long without a message the observer is told that it is idle.
const IDLE: Duration = Duration::from_secs(1);

/// Frames that wait before the observer's thread is woken, and how long fewer of them wait at most. To be woken
/// for every frame costs it, and the solver whose processor it takes, more than most frames do.
const BATCH: usize = 4;
const LINGER: Duration = Duration::from_millis(50);

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
    Begin(Box<RunContext>),
    Frame(Arc<Frame>),
    Event(RunEvent),
    Finish,
}

#[derive(Default)]
struct QueueState {
    waiting: VecDeque<Message>,
    /// The observer's thread has nothing more to do and takes no more.
    closed: bool,
    /// The observer's thread waits for a message, however long that takes.
    asleep: bool,
    /// `begin` has been answered.
    begun: bool,
    error: Option<ObserveError>,
    report: Option<ObserverReport>,
    stats: QueueStats,
    /// What the observer says that it kept.
    kept: Option<u64>,
}

#[derive(Default)]
struct QueueShared {
    state: Mutex<QueueState>,
    filled: Condvar,
    emptied: Condvar,
}

impl QueueShared {
    /// The state stays consistent between statements, so a panic elsewhere does not spoil it.
    fn lock(&self) -> MutexGuard<'_, QueueState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Runs an observer on its own thread behind a bounded queue.
pub struct Queue {
    shared: Arc<QueueShared>,
    thread: Option<JoinHandle<()>>,
    name: String,
    capacity: usize,
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
        let shared = Arc::new(QueueShared::default());
        let capacity = capacity.max(1);
        let mut state = shared.lock();
        state.waiting.reserve(capacity + 1);
        state.stats.capacity = capacity;
        drop(state);
        let on_thread = Arc::clone(&shared);
        let label = name.to_owned();
        let thread = std::thread::Builder::new()
            .name(name.to_owned())
            .spawn(move || serve(&on_thread, observer.as_mut(), &label))
            .map_err(|error| {
                ObserveError::new(name, format!("its thread did not start: {error}"))
            })?;
        Ok(Self {
            shared,
            thread: Some(thread),
            name: name.to_owned(),
            capacity,
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
        self.shared.lock().stats
    }

    /// Puts a message in, or says why not. `limit` is the number of waiting messages from which
    /// the queue counts as full for it.
    fn put(&self, message: Message, limit: usize, when_full: WhenFull) -> Result<(), ObserveError> {
        let mut state = self.shared.lock();
        let mut waits_since = None;
        while state.error.is_none() && !state.closed && state.waiting.len() >= limit {
            if when_full == WhenFull::Skip {
                state.stats.skipped += u64::from(matches!(message, Message::Frame(_)));
                return Ok(());
            }
            if waits_since.is_none() {
                state.stats.waits += 1;
                waits_since = Some(Instant::now());
            }
            state = self
                .shared
                .emptied
                .wait(state)
                .unwrap_or_else(PoisonError::into_inner);
        }
        if let Some(since) = waits_since {
            state.stats.waited += since.elapsed();
        }
        if let Some(error) = &state.error {
            return Err(error.clone());
        }
        if state.closed {
            return Err(ObserveError::new(&self.name, "was finished already"));
        }
        if matches!(message, Message::Frame(_)) {
            state.stats.frames += 1;
            state.stats.max_depth = state.stats.max_depth.max(state.waiting.len() + 1);
        }
        let batch = BATCH.min(self.capacity.div_ceil(2));
        let wakes = !matches!(message, Message::Frame(_));
        state.waiting.push_back(message);
        let wakes = wakes || state.asleep || state.waiting.len() >= batch;
        drop(state);
        if wakes {
            self.shared.filled.notify_one();
        }
        Ok(())
    }

    /// Waits for an observer that may stall; a report in its place when it does not come to an end.
    fn give_up(&self) -> Option<ObserverReport> {
        let patience = self.patience?;
        let state = self.shared.lock();
        let (state, _) = self
            .shared
            .emptied
            .wait_timeout_while(state, patience, |state| !state.closed)
            .unwrap_or_else(PoisonError::into_inner);
        (!state.closed).then(|| {
            let waiting = state
                .waiting
                .iter()
                .filter(|message| matches!(message, Message::Frame(_)));
            let waiting = waiting.count() as u64;
            ObserverReport {
                output: self.name.clone(),
                frames: state.stats.frames - waiting,
                skipped: state.stats.skipped + waiting,
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
        self.put(
            Message::Begin(Box::new(context.clone())),
            usize::MAX,
            WhenFull::Wait,
        )?;
        let mut state = self.shared.lock();
        while !state.begun && state.error.is_none() && !state.closed {
            state = self
                .shared
                .emptied
                .wait(state)
                .unwrap_or_else(PoisonError::into_inner);
        }
        state.error.clone().map_or(Ok(()), Err)
    }

    fn frame(&mut self, frame: &Arc<Frame>) -> Result<(), ObserveError> {
        self.put(
            Message::Frame(Arc::clone(frame)),
            self.capacity,
            self.when_full,
        )
    }

    fn skipped(&self) -> u64 {
        self.stats().skipped
    }

    fn kept(&self) -> Option<u64> {
        self.shared.lock().kept
    }

    fn event(&mut self, event: &RunEvent) -> Result<(), ObserveError> {
        self.put(
            Message::Event(event.clone()),
            self.capacity + EVENT_CAPACITY,
            self.when_full,
        )
    }

    fn finish(&mut self) -> Result<ObserverReport, ObserveError> {
        let asked = self.put(Message::Finish, usize::MAX, WhenFull::Wait);
        if let Some(report) = self.give_up() {
            return Ok(report);
        }
        self.join();
        let state = self.shared.lock();
        let mut report = state.report.clone().ok_or_else(|| {
            state.error.clone().unwrap_or_else(|| {
                asked
                    .err()
                    .unwrap_or_else(|| ObserveError::new(&self.name, "ended without a report"))
            })
        })?;
        report.skipped += state.stats.skipped;
        report.queue = Some(state.stats);
        Ok(report)
    }
}

impl Drop for Queue {
    /// Lets the observer work off what is waiting, so that a dropped queue leaves whole outputs.
    fn drop(&mut self) {
        if self.thread.is_some() {
            drop(self.put(Message::Finish, usize::MAX, WhenFull::Wait));
            drop(self.give_up());
            self.join();
        }
    }
}

/// The observer's thread: works off messages until it finishes, fails or panics.
fn serve(shared: &QueueShared, observer: &mut dyn Observer, name: &str) {
    let mut patience = Some(IDLE);
    loop {
        let message = next(shared, &mut patience);
        let last = matches!(message, Some(Message::Finish));
        let outcome = catch_unwind(AssertUnwindSafe(|| match message {
            Some(message) => deliver(shared, observer, message),
            None => observer.idle(),
        }));
        let result = outcome.unwrap_or_else(|_| {
            Err(ObserveError::new(
                name,
                "stopped by a programming error (panic); what was written before is kept",
            ))
        });
        let mut state = shared.lock();
        let failed = result.is_err();
        if let Err(error) = result {
            state.error = Some(error);
        }
        if last || failed {
            state.closed = true;
            state.waiting.clear();
            drop(state);
            shared.emptied.notify_all();
            return;
        }
    }
}

/// The next message, or `None` when none has come for so long. A pause is told once: then there is no patience
/// to lose until the next message.
fn next(shared: &QueueShared, patience: &mut Option<Duration>) -> Option<Message> {
    let began = Instant::now();
    let mut state = shared.lock();
    loop {
        if let Some(message) = state.waiting.pop_front() {
            state.asleep = false;
            drop(state);
            shared.emptied.notify_all();
            *patience = Some(IDLE);
            return Some(message);
        }
        state = match *patience {
            Some(most) if began.elapsed() >= most => {
                *patience = None;
                return None;
            }
            Some(_) => {
                let waited = shared.filled.wait_timeout(state, LINGER);
                waited.unwrap_or_else(PoisonError::into_inner).0
            }
            None => {
                state.asleep = true;
                let waited = shared.filled.wait(state);
                waited.unwrap_or_else(PoisonError::into_inner)
            }
        };
    }
}

fn deliver(
    shared: &QueueShared,
    observer: &mut dyn Observer,
    message: Message,
) -> Result<(), ObserveError> {
    match message {
        Message::Begin(context) => {
            observer.begin(&context)?;
            shared.lock().begun = true;
            shared.emptied.notify_all();
            Ok(())
        }
        Message::Frame(frame) => {
            let since = Instant::now();
            let written = observer.frame(&frame);
            let mut state = shared.lock();
            state.kept = observer.kept();
            state.stats.busy += since.elapsed();
            state.stats.done += 1;
            written
        }
        Message::Event(event) => observer.event(&event),
        Message::Finish => {
            let report = observer.finish()?;
            shared.lock().report = Some(report);
            Ok(())
        }
    }
}

#[cfg(test)]
mod tests;
