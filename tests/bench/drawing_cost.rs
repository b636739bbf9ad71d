//! What the explorer's drawing costs the simulation: steps a second with it and without it in turns, in one process.
//!
//! ```text
//! cargo bench --bench drawing_cost            a terminal of 80 × 24 and one of 160 × 48
//! ```
//!
//! The explorer's session of the default scene on all cores, its screen drawn every 25 ms as the explorer does it, in
//! 24-bit colours, into a terminal that throws the bytes away. Short slices with and without drawing take turns, each from
//! one step's end to another's, so that both see the same load of the machine and the same part of the passage. Told are the
//! median of the pairs' ratios and the two ratios between which the true median lies with 95 %. Times are no test's
//! business on a machine that others use, which is why this is a bench.
#![expect(clippy::unwrap_used, reason = "a bench, which may end in a panic")]

use std::io::{BufWriter, Write};
use std::num::NonZero;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use asperity_engine::plan::Plan;
use asperity_engine::scene::{Scene, presets};
use asperity_engine::sim::Stage;
use asperity_explorer::tui::app::App;
use asperity_explorer::tui::theme::{Capabilities, ColorDepth, Glyphs, Theme};
use asperity_explorer::tui::{RunStatus, Setup, view};
use asperity_session::run::{Command, Ending, Request, Session};
use ratatui::backend::CrosstermBackend;
use ratatui::layout::Rect;
use ratatui::{Terminal, TerminalOptions, Viewport};

/// From drawing to drawing, as the explorer has it.
const FRAME_TIME: Duration = Duration::from_millis(25);
const SLICE: Duration = Duration::from_millis(500);
const PAIRS: usize = 40;
/// Of 40 sorted ratios the 14th and the 27th hold the median between them with 96 % (binomial, p = 1/2).
const BETWEEN: [usize; 2] = [13, 26];
/// How closely a step's end is looked for.
const LOOK: Duration = Duration::from_micros(300);

/// Takes bytes and counts them.
struct Sink(Arc<AtomicUsize>);

impl Write for Sink {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.fetch_add(bytes.len(), Ordering::Relaxed);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

struct Show {
    session: Session,
    app: App,
    terminal: Terminal<CrosstermBackend<BufWriter<Sink>>>,
    bytes: Arc<AtomicUsize>,
    start: Instant,
    drawings: u32,
    /// Time that drawing took.
    drawn: Duration,
}

impl Show {
    fn new(screen: Rect) -> Self {
        let scene = Arc::new(Scene::load(presets::DEFAULT).unwrap());
        let plan = Plan::new(&scene).unwrap();
        let setup = Setup {
            name: presets::DEFAULT.into(),
            load_n: plan.force_n,
            half_width_m: plan.hertz.a_m,
            p_hertz_pa: plan.hertz.p_max_pa,
            plan_text: plan.to_string(),
            left_out: plan.left_out.clone(),
            scene: Arc::clone(&scene),
        };
        let request = Request {
            name: presets::DEFAULT.into(),
            scene,
            plan,
            threads: std::thread::available_parallelism().map_or(1, NonZero::get),
            watchers: Vec::new(),
            ending: Ending::OnStop,
        };
        let theme = Theme::new(Capabilities {
            depth: ColorDepth::True,
            glyphs: Glyphs::Unicode,
        });
        let options = TerminalOptions {
            viewport: Viewport::Fixed(screen),
        };
        let bytes = Arc::default();
        let out = BufWriter::with_capacity(1 << 18, Sink(Arc::clone(&bytes)));
        Self {
            session: Session::start(request).unwrap(),
            app: App::new(setup, Vec::new(), theme),
            terminal: Terminal::with_options(CrosstermBackend::new(out), options).unwrap(),
            bytes,
            start: Instant::now(),
            drawings: 0,
            drawn: Duration::ZERO,
        }
    }

    /// One picture, as the explorer's loop makes it.
    fn draw(&mut self) {
        let began = Instant::now();
        self.app.tick(self.start.elapsed());
        self.app.take_status(RunStatus::default());
        let frames = self.session.handle.latest();
        if let Some(frame) = frames.take() {
            let mut points = Vec::new();
            frames.take_points(&mut points);
            self.app.take_points(&points, frame.a_m);
            // Nobody carries its effects out: they belong to tours and replays.
            drop(self.app.take_frame(frame));
        }
        drop(self.app.advance(FRAME_TIME));
        let app = &self.app;
        self.terminal.draw(|frame| view::draw(app, frame)).unwrap();
        self.drawings += 1;
        self.drawn += began.elapsed();
    }

    /// Waits for a step to end: when, and how many there are.
    fn step_end(&self) -> (Instant, u64) {
        let before = self.session.handle.status().steps;
        loop {
            let steps = self.session.handle.status().steps;
            if steps > before {
                return (Instant::now(), steps);
            }
            std::thread::sleep(LOOK);
        }
    }

    /// Steps a second over a slice of time.
    fn slice(&mut self, draws: bool) -> f64 {
        let (began, before) = self.step_end();
        while began.elapsed() < SLICE {
            let next = Instant::now() + FRAME_TIME;
            if draws {
                self.draw();
            }
            std::thread::sleep(next.saturating_duration_since(Instant::now()));
        }
        let (ended, after) = self.step_end();
        (after - before) as f64 / (ended - began).as_secs_f64()
    }
}

fn measure(screen: Rect) {
    let mut show = Show::new(screen);
    while show.session.handle.status().stage == Stage::StartUp {
        std::thread::sleep(FRAME_TIME);
    }
    let mut ratios = Vec::new();
    let mut sums = [0.0; 2];
    for pair in 0..PAIRS {
        let first = pair % 2 == 0;
        let (one, two) = (show.slice(first), show.slice(!first));
        let (with, without) = if first { (one, two) } else { (two, one) };
        sums = [sums[0] + with, sums[1] + without];
        ratios.push(with / without);
    }
    show.session.handle.send(Command::Stop);
    ratios.sort_by(f64::total_cmp);
    let Rect { width, height, .. } = screen;
    let drawings = f64::from(show.drawings.max(1));
    println!(
        "{width} x {height}: {:.1} steps a second with drawing, {:.1} without; ratio {:.3} (median of {PAIRS} pairs; with 95 % between {:.3} and {:.3})",
        sums[0] / PAIRS as f64,
        sums[1] / PAIRS as f64,
        ratios[PAIRS / 2],
        ratios[BETWEEN[0]],
        ratios[BETWEEN[1]],
    );
    println!(
        "  a drawing takes {:.2} ms and {:.1} kB",
        1e3 * show.drawn.as_secs_f64() / drawings,
        1e-3 * show.bytes.load(Ordering::Relaxed) as f64 / drawings,
    );
    show.session.join().unwrap();
}

fn main() {
    for (width, height) in [(80, 24), (160, 48)] {
        measure(Rect::new(0, 0, width, height));
    }
}
