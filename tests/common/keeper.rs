//! An observer that keeps every bit of what a session shows, and the request of a session that it watches.

use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::sync::{Arc, Mutex};

use asperity_engine::observe::{ObserveError, Observer, ObserverReport, RunContext, RunEvent};
use asperity_engine::plan::Plan;
use asperity_engine::scene::Scene;
use asperity_engine::sim::Frame;
use asperity_session::run::{Ending, Request, Watcher};

/// What tells frames apart to the bit, -0 from 0 too, and NaN equals itself: a hash of the large fields, all else as Debug
/// prints it, floats with as many digits as tell them apart. (Printing the large fields took a quarter of the longest tests.)
pub(crate) fn bits(frame: &Frame) -> String {
    let mut rest = frame.clone();
    let fields = [
        &mut rest.pressure_pa,
        &mut rest.film_m,
        &mut rest.roughness_1_m,
        &mut rest.roughness_2_m,
        &mut rest.traction_pa,
    ];
    let slices = [&mut rest.slice, &mut rest.slice_2].into_iter().flatten();
    let slices = slices.flat_map(|slice| [&mut slice.effective_pa, &mut slice.tau_xz_pa]);
    let damage = rest.damage.iter_mut().flatten();
    let damage = damage.map(|block| &mut block.damage);
    let mut hasher = DefaultHasher::new();
    for field in fields.into_iter().chain(slices).chain(damage) {
        let bits: Vec<u32> = std::mem::take(field)
            .into_iter()
            .map(f32::to_bits)
            .collect();
        bits.hash(&mut hasher);
    }
    std::mem::take(&mut rest.contact).hash(&mut hasher);
    format!("{rest:?} {:016x}", hasher.finish())
}

/// Keeps every bit of every frame, and every event.
struct Keeper(Kept);

pub(crate) type Kept = Arc<Mutex<Vec<String>>>;

impl Observer for Keeper {
    fn begin(&mut self, _context: &RunContext) -> Result<(), ObserveError> {
        Ok(())
    }
    fn frame(&mut self, frame: &Arc<Frame>) -> Result<(), ObserveError> {
        self.0.lock().unwrap().push(bits(frame));
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
