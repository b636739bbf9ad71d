//! What recording costs the simulation: the same steps with and without it in turns, in one process.
//!
//! ```text
//! cargo bench --bench recording_cost            with and without, on one thread and on two
//! cargo bench --bench recording_cost -- alone   the recorder alone, at the pace of the solver: for profiles
//! ```
//!
//! Two simulations of the default scene go through the same passage, one of them recorded. Blocks of steps of
//! the one and the other take turns, so that both do the same work under the same load of the machine. A block
//! with recording ends when the record thread is done with it. Times are no test's business on a machine that
//! others use, which is why this is a bench, run by hand on a machine at rest.
#![expect(clippy::unwrap_used, reason = "a bench, which may end in a panic")]

use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use asperity_engine::observe::{Began, Observer, Overwrite, RunContext, RunEvent, RunEventKind};
use asperity_engine::plan::Plan;
use asperity_engine::scene::{Scene, presets};
use asperity_engine::sim::{Frame, Simulation, Stage};
use asperity_recorder::Recorder;
use asperity_session::{FramePool, Queue, WhenFull};

/// Steps of a block: an eighth of a passage.
const BLOCK: usize = 16;
const BLOCKS: usize = 24;
/// Of the recorder alone.
const ROUNDS: usize = 4;
/// From frame to frame of the recorder alone, as long as a step takes.
const PACE: Duration = Duration::from_millis(9);

struct Run {
    sim: Simulation,
    pool: FramePool,
    queue: Option<Queue>,
}

impl Run {
    fn new(scene: &Scene, threads: usize, queue: Option<Queue>) -> Self {
        let mut sim = Simulation::new(scene, Plan::new(scene).unwrap(), threads).unwrap();
        while sim.stage() == Stage::StartUp {
            sim.step().unwrap();
        }
        Self {
            sim,
            pool: FramePool::new(6, &Frame::default()),
            queue,
        }
    }

    fn block(&mut self) -> Duration {
        let began = Instant::now();
        let (mut step, mut time_s) = (0, 0.0);
        for _ in 0..BLOCK {
            self.sim.step().unwrap();
            let frame = self.pool.fill(|frame| self.sim.fill(frame));
            (step, time_s) = (frame.step, frame.time_s);
            if let Some(queue) = &mut self.queue {
                queue.frame(&frame).unwrap();
            }
        }
        if let Some(queue) = &mut self.queue {
            // Frames may wait a little for others; an event is told at once, after them.
            let kind = RunEventKind::Caption(String::new());
            let event = RunEvent { step, time_s, kind };
            queue.event(&event).unwrap();
            while queue.stats().done < queue.stats().frames {
                std::thread::sleep(Duration::from_micros(200));
            }
        }
        began.elapsed()
    }
}

/// Names of the threads that record, as the system cuts them.
const RECORDING: [&str; 3] = ["record", "ChunkBatcher::c", "RecordingStream"];

/// Processor seconds of the threads of those names, which the system cuts at 15 bytes.
fn seconds_of(names: &[&str]) -> f64 {
    let Ok(tasks) = std::fs::read_dir("/proc/self/task") else {
        return 0.0;
    };
    let of = |path: std::path::PathBuf| -> Option<f64> {
        let name = std::fs::read_to_string(path.join("comm")).ok()?;
        let used = std::fs::read_to_string(path.join("schedstat")).ok()?;
        let ours = names.contains(&name.trim_end());
        let nanos: f64 = used.split(' ').next()?.parse().ok()?;
        ours.then_some(nanos * 1e-9)
    };
    tasks.flatten().filter_map(|task| of(task.path())).sum()
}

fn scene() -> Scene {
    let mut scene = Scene::load(presets::QUICK).unwrap();
    scene.time.passages = Some(2.0 + (BLOCKS * BLOCK) as f64 / 128.0);
    scene
}

/// A queue with a recorder behind it that has begun.
fn recorder(scene: &Scene, folder: &Path) -> Queue {
    let path = folder.join("cost.rrd");
    let record = scene.record.clone().unwrap();
    let recorder = Recorder::create(&path, Overwrite::Refuse, &record).unwrap();
    let mut queue = Queue::spawn("record", 8, WhenFull::Wait, Box::new(recorder)).unwrap();
    let context = RunContext {
        scene: Arc::new(scene.clone()),
        scene_toml: scene.to_toml(),
        plan_text: String::new(),
        program: "cost".into(),
        began: Began::FromScene,
    };
    queue.begin(&context).unwrap();
    queue
}

fn measure(threads: usize) {
    let scene = scene();
    let folder = tempfile::tempdir().unwrap();
    let queue = recorder(&scene, folder.path());
    let mut plain = Run::new(&scene, threads, None);
    let mut recorded = Run::new(&scene, threads, Some(queue));
    let (mut without, mut with) = (Vec::new(), Vec::new());
    for block in 0..BLOCKS {
        if block % 2 == 0 {
            without.push(plain.block());
            with.push(recorded.block());
        } else {
            with.push(recorded.block());
            without.push(plain.block());
        }
    }
    let used = seconds_of(&RECORDING);
    let mut queue = recorded.queue.take().unwrap();
    let stats = queue.stats();
    let ended = Instant::now();
    let bytes = queue.finish().unwrap().bytes;
    let compacting = ended.elapsed();
    let mut ratios: Vec<f64> = with
        .iter()
        .zip(&without)
        .map(|(with, without)| with.as_secs_f64() / without.as_secs_f64())
        .collect();
    ratios.sort_by(f64::total_cmp);
    let sum = |times: &[Duration]| times.iter().sum::<Duration>().as_secs_f64();
    // Whatever else the machine does only adds: the fastest blocks tell most.
    let fastest = |times: &[Duration]| {
        let mut times = times.to_vec();
        times.sort();
        sum(&times[..BLOCKS / 4])
    };
    let steps = (BLOCKS * BLOCK) as f64;
    println!(
        "{threads} threads: {:.2} ms a step without, {:.2} with: {:+.1} % in all, {:+.1} % in the median block, \
         {:+.1} % in the fastest quarter",
        1e3 * sum(&without) / steps,
        1e3 * sum(&with) / steps,
        100.0 * (sum(&with) / sum(&without) - 1.0),
        100.0 * (ratios[BLOCKS / 2] - 1.0),
        100.0 * (fastest(&with) / fastest(&without) - 1.0),
    );
    println!(
        "  {:.2} ms of processor a frame in the threads that record; {:.1} MB, compacted at the end in {:.2} s; {stats}",
        1e3 * used / steps,
        bytes as f64 * 1e-6,
        compacting.as_secs_f64()
    );
}

fn main() {
    let asked = |word: &str| std::env::args().any(|argument| argument == word);
    if !asked("--bench") {
        // Not by `cargo bench`: nothing to test.
    } else if asked("alone") {
        recorder_alone();
    } else {
        measure(1);
        measure(2);
    }
}

/// The recorder alone, at the pace of the solver: for profiles, in which the solver would hide it.
fn recorder_alone() {
    let scene = scene();
    let mut run = Run::new(&scene, 2, None);
    let frames: Vec<Frame> = (0..BLOCKS * BLOCK)
        .map(|_| {
            run.sim.step().unwrap();
            let mut frame = Frame::default();
            run.sim.fill(&mut frame);
            frame
        })
        .collect();
    let mut pool = FramePool::new(6, &Frame::default());
    for _ in 0..ROUNDS {
        let folder = tempfile::tempdir().unwrap();
        let mut queue = recorder(&scene, folder.path());
        for frame in &frames {
            // Into a frame that is in use already, as the solver does: its memory is not far away.
            let frame = pool.fill(|filled| filled.clone_from(frame));
            queue.frame(&frame).unwrap();
            std::thread::sleep(PACE);
        }
        let used = RECORDING.map(|name| 1e3 * seconds_of(&[name]) / frames.len() as f64);
        let bytes = queue.finish().unwrap().bytes;
        println!(
            "{:.3} ms of processor a frame ({used:.3?} in {RECORDING:?}); {:.1} MB",
            used.iter().sum::<f64>(),
            bytes as f64 * 1e-6
        );
    }
}
