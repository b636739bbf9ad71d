//! An observer that keeps every bit of what a session shows, and the request of a session that it watches.

use std::sync::{Arc, Mutex};

use asperity::observe::{ObserveError, Observer, ObserverReport, RunContext, RunEvent};
use asperity::plan::Plan;
use asperity::run::{Ending, Request, Watcher};
use asperity::scene::Scene;
use asperity::sim::Frame;

/// Keeps every bit of every frame, and every event.
struct Keeper(Kept);

pub(crate) type Kept = Arc<Mutex<Vec<String>>>;

impl Observer for Keeper {
    fn begin(&mut self, _context: &RunContext) -> Result<(), ObserveError> {
        Ok(())
    }
    fn frame(&mut self, frame: &Arc<Frame>) -> Result<(), ObserveError> {
        // Debug prints floats with as many digits as tell them apart.
        self.0.lock().unwrap().push(format!("{frame:?}"));
        Ok(())
    }
    fn event(&mut self, event: &RunEvent) -> Result<(), ObserveError> {
        self.0.lock().unwrap().push(format!("{event:?}"));
        Ok(())
    }
    fn finish(&mut self) -> Result<ObserverReport, ObserveError> {
        Ok(ObserverReport::default())
    }
}

/// A session of this scene that a keeper watches beside `others`.
pub(crate) fn kept_request(
    scene: &Scene,
    threads: usize,
    others: impl IntoIterator<Item = Watcher>,
    ending: Ending,
) -> (Request, Kept) {
    let kept = Kept::default();
    let mut watchers = vec![Watcher::new("keeper", Box::new(Keeper(kept.clone())), 1)];
    watchers.extend(others);
    let request = Request {
        name: "test".to_owned(),
        scene: Arc::new(scene.clone()),
        plan: Plan::new(scene).unwrap(),
        threads,
        watchers,
        ending,
    };
    (request, kept)
}
