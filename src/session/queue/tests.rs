//! The queue under observers that block, fail and panic.

use std::sync::mpsc::{Receiver, Sender, channel};

use super::*;

/// An observer that is let through one frame at a time and tells what it saw.
struct Gated {
    gate: Receiver<()>,
    seen: Sender<u64>,
    fails_at: u64,
    panics_at: u64,
    frames: u64,
}

struct Remote {
    gate: Sender<()>,
    seen: Receiver<u64>,
}

fn gated(fails_at: u64, panics_at: u64) -> (Box<dyn Observer>, Remote) {
    let (gate_in, gate) = channel();
    let (seen, seen_out) = channel();
    let observer = Gated {
        gate,
        seen,
        fails_at,
        panics_at,
        frames: 0,
    };
    let remote = Remote {
        gate: gate_in,
        seen: seen_out,
    };
    (Box::new(observer), remote)
}

impl Observer for Gated {
    fn begin(&mut self, _context: &RunContext) -> Result<(), ObserveError> {
        Ok(())
    }
    fn frame(&mut self, frame: &Arc<Frame>) -> Result<(), ObserveError> {
        // A closed gate means that the test has let everything through.
        let _ = self.gate.recv();
        if frame.step == self.fails_at {
            return Err(ObserveError::new("disk", "full"));
        }
        assert_ne!(frame.step, self.panics_at, "planted");
        self.frames += 1;
        let _ = self.seen.send(frame.step);
        Ok(())
    }
    fn event(&mut self, event: &RunEvent) -> Result<(), ObserveError> {
        let _ = self.seen.send(1000 + event.step);
        Ok(())
    }
    fn finish(&mut self) -> Result<ObserverReport, ObserveError> {
        Ok(ObserverReport {
            output: "gated".into(),
            frames: self.frames,
            ..ObserverReport::default()
        })
    }
}

fn frame(step: u64) -> Arc<Frame> {
    Arc::new(Frame {
        step,
        ..Frame::default()
    })
}

fn event(step: u64) -> RunEvent {
    RunEvent {
        step,
        time_s: 0.0,
        kind: asperity_engine::observe::RunEventKind::Caption("look".into()),
    }
}

#[test]
fn waiting_keeps_every_frame_in_order() {
    let (observer, remote) = gated(u64::MAX, u64::MAX);
    let queue = Queue::spawn("record", 3, WhenFull::Wait, observer);
    let mut queue = queue.expect("thread starts");
    drop(remote.gate);
    for step in 0..50 {
        assert_eq!(queue.frame(&frame(step)), Ok(()));
    }
    assert_eq!(queue.event(&event(7)), Ok(()));
    let report = queue.finish().expect("finishes");
    assert_eq!((report.frames, report.skipped), (50, 0));
    let seen: Vec<u64> = remote.seen.iter().collect();
    let expected: Vec<u64> = (0..50).chain([1007]).collect();
    assert_eq!(seen, expected);
    assert!(queue.stats().max_depth <= 3, "{:?}", queue.stats());
    assert_eq!(queue.stats().frames, 50);
    let stats = report.queue.expect("a queue tells");
    assert_eq!((stats.done, stats.capacity), (50, 3));
    assert!(
        stats
            .to_string()
            .starts_with("50 frames offered, 50 taken, 0 skipped")
    );
}

/// What an observer is told.
#[derive(Debug, PartialEq, Eq)]
enum Call {
    Frame(u64),
    Idle,
}

/// Tells which calls come.
struct Idler(Sender<Call>);

impl Observer for Idler {
    fn begin(&mut self, _context: &RunContext) -> Result<(), ObserveError> {
        Ok(())
    }
    fn frame(&mut self, frame: &Arc<Frame>) -> Result<(), ObserveError> {
        let _ = self.0.send(Call::Frame(frame.step));
        Ok(())
    }
    fn event(&mut self, _event: &RunEvent) -> Result<(), ObserveError> {
        Ok(())
    }
    fn idle(&mut self) -> Result<(), ObserveError> {
        let _ = self.0.send(Call::Idle);
        Ok(())
    }
    fn finish(&mut self) -> Result<ObserverReport, ObserveError> {
        Ok(ObserverReport::default())
    }
}

/// A frame on its own is delivered: while the thread waits, and when
/// it sleeps after a pause.
#[test]
fn a_pause_is_told_once_and_frames_on_their_own_are_delivered() {
    let (told, calls) = channel();
    let queue = Queue::spawn("record", 8, WhenFull::Wait, Box::new(Idler(told)));
    let mut queue = queue.expect("thread starts");
    for step in 1..=2 {
        assert_eq!(queue.frame(&frame(step)), Ok(()));
        assert_eq!(calls.recv(), Ok(Call::Frame(step)));
        assert_eq!(calls.recv(), Ok(Call::Idle));
    }
    assert!(queue.finish().is_ok());
    assert!(calls.try_recv().is_err());
}

#[test]
fn skipping_never_waits_and_counts() {
    let (observer, remote) = gated(u64::MAX, u64::MAX);
    let queue = Queue::spawn("record", 2, WhenFull::Skip, observer);
    let mut queue = queue.expect("thread starts");
    // The observer is held at its first frame: at most one in work and two waiting.
    for step in 0..10 {
        assert_eq!(queue.frame(&frame(step)), Ok(()));
    }
    let skipped = queue.stats().skipped;
    assert!((7..=8).contains(&skipped), "skipped {skipped}");
    assert_eq!(queue.stats().waits, 0);
    drop(remote.gate);
    let report = queue.finish().expect("finishes");
    assert_eq!(report.skipped, skipped);
    assert_eq!(report.frames, 10 - skipped);
}

#[test]
fn an_error_comes_back_on_the_next_call_and_at_the_end() {
    let (observer, remote) = gated(2, u64::MAX);
    let queue = Queue::spawn("record", 2, WhenFull::Wait, observer);
    let mut queue = queue.expect("thread starts");
    drop(remote.gate);
    let full = ObserveError::new("disk", "full");
    // Frame 2 fails at some time after it was sent; the calls must start to fail and never hang.
    let first = (0..1000).find_map(|step| queue.frame(&frame(step)).err());
    assert_eq!(first, Some(full.clone()));
    assert_eq!(queue.frame(&frame(9)), Err(full.clone()));
    assert_eq!(queue.finish().err(), Some(full));
    assert_eq!(remote.seen.iter().collect::<Vec<_>>(), vec![0, 1]);
}

#[test]
fn a_panic_of_the_observer_is_an_error_of_the_output() {
    let (observer, remote) = gated(u64::MAX, 1);
    let queue = Queue::spawn("record", 2, WhenFull::Wait, observer);
    let mut queue = queue.expect("thread starts");
    drop(remote.gate);
    let first = (0..1000).find_map(|step| queue.frame(&frame(step)).err());
    let error = first.expect("the panic is reported");
    assert_eq!(error.output, "record");
    assert!(error.reason.contains("panic"), "{error}");
}

#[test]
fn a_dropped_queue_delivers_what_waits() {
    let (observer, remote) = gated(u64::MAX, u64::MAX);
    let queue = Queue::spawn("record", 8, WhenFull::Wait, observer);
    let mut queue = queue.expect("thread starts");
    for step in 0..5 {
        assert_eq!(queue.frame(&frame(step)), Ok(()));
    }
    drop(remote.gate);
    drop(queue);
    assert_eq!(remote.seen.iter().count(), 5);
}

#[test]
fn finishing_twice_gives_the_same_report() {
    let (observer, remote) = gated(u64::MAX, u64::MAX);
    let queue = Queue::spawn("record", 8, WhenFull::Wait, observer);
    let mut queue = queue.expect("thread starts");
    drop(remote.gate);
    let frames = queue.finish().expect("finishes").frames;
    assert_eq!(frames, 0);
    assert_eq!(queue.finish().map(|report| report.frames), Ok(0));
    assert!(queue.frame(&frame(1)).is_err());
}
