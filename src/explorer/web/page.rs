//! The page's state: the explorer and the run behind it.

use std::cell::RefCell;
use std::path::PathBuf;
use std::rc::Rc;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::sync::mpsc::channel;
use std::time::Duration;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::cells::changed;
use super::curves::written as written_curves;
use super::link::{PageLink, on_nodes, written};
use super::rows::KeptRows;
use crate::tui::event::ScreenEvent;
use crate::tui::pixels::Medium;
use crate::tui::theme::{Capabilities, ColorDepth, Glyphs, Theme};
use crate::tui::{Control, Explorer, Health, RunStatus, Setup, Shown, Wiring, view};
use asperity_engine::math::number::sig;
use asperity_engine::scene::{Knob, Scene};
use asperity_session::run::{Cooperative, Ending, LoopTurn, Request, RunHandle, Watcher};
use asperity_session::sweep::{Background, Ground, SweepWorker};

/// Maximum number of pixels of a picture: each is a colour computed anew.
const MAX_PIXELS: usize = 160_000;

/// A run and its rows.
struct PageRun {
    session: Cooperative,
    rows: KeptRows,
}

/// The sweep beside the run, where there is one.
type PageSweep = Rc<RefCell<Option<SweepWorker>>>;

/// Files to save: name and text.
type Files = Rc<RefCell<Vec<(String, String)>>>;

/// The page's state.
pub(super) struct WebPage {
    explorer: Explorer,
    run: Rc<RefCell<PageRun>>,
    beside: PageSweep,
    files: Files,
    /// Keys of the link, until another scene is run.
    keys: Rc<RefCell<String>>,
    shown: Buffer,
    cell: (u16, u16),
    /// Curves as they were given last, and those that are new.
    curves: Vec<u8>,
    new_curves: Vec<u8>,
    last: Duration,
    has_quit: bool,
}

impl WebPage {
    /// Opens what a link asks for.
    pub(super) fn open(link: PageLink) -> Result<Self, String> {
        let nodes = link.nodes;
        let files = Files::default();
        let (run, setup) = start(&link.scene, &link.name, nodes, Ending::OnStop)?;
        let run = Rc::new(RefCell::new(run));
        let beside = PageSweep::default();
        let mut wiring = wiring(&run.borrow().session.handle, setup, &beside, &files);
        wiring.lesson = link.lesson;
        let keys = Rc::new(RefCell::new(link.keys));
        let (place, sweep, kept) = (Rc::clone(&run), Rc::clone(&beside), Rc::clone(&files));
        let left = Rc::clone(&keys);
        wiring.rebuild = Some(Box::new(move |scene, name| {
            let (next, setup) = start(scene, name, nodes, Ending::OnStop)?;
            let wiring = self::wiring(&next.session.handle, setup, &sweep, &kept);
            place.replace(next);
            left.borrow_mut().clear();
            Ok(wiring)
        }));
        let mut theme = Theme::new(Capabilities {
            depth: ColorDepth::True,
            glyphs: Glyphs::Unicode,
        });
        theme.contrast = link.contrast;
        let mut explorer = Explorer::new(wiring, theme);
        explorer.app.set_medium(Medium::Page);
        // Nothing comes of it that a page would have to do.
        let _ = explorer.teach_asked();
        Ok(Self {
            explorer,
            run,
            beside,
            files,
            keys,
            shown: Buffer::default(),
            cell: (8, 16),
            curves: Vec::new(),
            new_curves: Vec::new(),
            last: Duration::ZERO,
            has_quit: false,
        })
    }

    /// Another size: all cells are drawn anew.
    pub(super) fn resize(&mut self, columns: u16, rows: u16, cell: (u16, u16)) {
        self.shown = Buffer::empty(Rect::new(0, 0, columns, rows));
        self.cell = cell;
        self.curves.clear();
    }

    /// Takes what a person does.
    pub(super) fn take(&mut self, event: ScreenEvent) {
        let control = self.explorer.take_event(event, self.shown.area);
        self.has_quit |= control == Control::Stop;
    }

    /// One step of the run and one of the sweep beside it; whether there were such.
    pub(super) fn step(&mut self) -> [bool; 2] {
        let stepped = matches!(self.run.borrow_mut().session.turn(), LoopTurn::Stepped);
        let mut beside = self.beside.borrow_mut();
        let swept = beside.as_mut().is_some_and(SweepWorker::turn);
        if !swept {
            *beside = None;
        }
        [stepped, swept]
    }

    /// The news of the run, and the cells that changed; whether it goes on.
    pub(super) fn draw(&mut self, now_ms: f64) -> (bool, Vec<u8>) {
        let seconds = (1e-3 * now_ms).clamp(0.0, 1e9);
        // A time that is no number is none.
        let now = Duration::try_from_secs_f64(seconds).unwrap_or(self.last);
        self.explorer.app.tick(now);
        let wall = now.saturating_sub(self.last);
        self.last = now;
        let control = self.explorer.take_news(wall, None);
        self.has_quit |= control == Control::Stop;
        let area = self.shown.area;
        let mut next = Buffer::empty(area);
        let curves = written_curves(&view::render(&self.explorer.app, area, &mut next));
        if curves != self.curves {
            self.curves.clone_from(&curves);
            self.new_curves = curves;
        }
        let picture = view::picture_area(&self.explorer.app, area).unwrap_or_default();
        let bytes = changed(&self.shown, &next, picture);
        self.shown = next;
        (!self.has_quit, bytes)
    }

    /// The curves, where they have changed.
    pub(super) fn curves(&mut self) -> Vec<u8> {
        std::mem::take(&mut self.new_curves)
    }

    /// The map's pixels.
    pub(super) fn picture(&self) -> Vec<u8> {
        let app = &self.explorer.app;
        let Some(room) = view::picture_area(app, self.shown.area) else {
            return Vec::new();
        };
        let (mut width, mut height) = self.cell;
        let cells = usize::from(room.width) * usize::from(room.height);
        while cells * usize::from(width) * usize::from(height) > MAX_PIXELS && width > 2 {
            (width, height) = (width / 2, height / 2);
        }
        let cell = (width.max(1), height.max(1));
        let Some(picture) = view::picture(app, self.shown.area, cell) else {
            return Vec::new();
        };
        let area = picture.area;
        let places = [area.x, area.y, area.width, area.height].map(u32::from);
        let sizes = [picture.width as u32, picture.height as u32];
        let head = places.into_iter().chain(sizes);
        let mut bytes: Vec<u8> = head.flat_map(u32::to_le_bytes).collect();
        bytes.extend(picture.rgba);
        bytes
    }

    /// Life, where the knobs are, and what to know before trusting it, in words.
    pub(super) fn spoken(&self) -> String {
        let app = &self.explorer.app;
        let life = match app.life() {
            Some(life) => format!(
                "Relative life {}, band {} to {}, {}.",
                sig(life.life_relative, 3),
                sig(life.life_relative_low, 2),
                sig(life.life_relative_high, 2),
                if life.settled {
                    "settled"
                } else {
                    "still moving"
                }
            ),
            None => "No simulated life yet.".to_owned(),
        };
        let slide_roll = sig(app.target(Knob::SlideRoll), 3);
        let mut words = format!("{life} S {slide_roll}, load {}.", sig(app.load_n(), 3));
        words.extend(
            app.cautions()
                .iter()
                .map(|caution| format!(" {}.", caution.text)),
        );
        words
    }

    /// What a lesson or the scene says: lines of `lesson` or `scene`, its title, its words, its numbers, and the answers that
    /// it waits for; nothing where nothing is said.
    pub(super) fn caption(&self) -> String {
        let Some(says) = view::caption_words(&self.explorer.app) else {
            return String::new();
        };
        let who = if says.is_lesson { "lesson" } else { "scene" };
        let lines = [who.to_owned(), says.title, says.words, says.figures].into_iter();
        let lines = lines.chain(says.answers);
        let lines: Vec<String> = lines.map(|line| line.replace('\n', " ")).collect();
        lines.join("\n")
    }

    /// The link to what is shown now.
    pub(super) fn link(&self) -> String {
        written(&self.explorer.app, self.nodes(), &self.keys.borrow())
    }

    /// The table of the run's last steps.
    pub(super) fn table(&self) -> String {
        self.run.borrow().rows.csv()
    }

    /// Of its finest mesh.
    pub(super) fn nodes(&self) -> usize {
        self.explorer.app.run.setup.scene.grid.nodes
    }

    /// The scene as it now is.
    pub(super) fn scene(&self) -> String {
        self.explorer.app.scene_toml()
    }

    /// A file to save.
    pub(super) fn saved(&mut self) -> Vec<u8> {
        let file = self.files.borrow_mut().pop();
        file.map_or_else(Vec::new, |(name, text)| {
            format!("{name}\n{text}").into_bytes()
        })
    }
}

/// A run of so many steps without a screen: its table, and a last line with the counters of its work.
pub(super) fn measured(link: &PageLink, steps: u64) -> Result<String, String> {
    let (mut run, _) = start(&link.scene, &link.name, link.nodes, Ending::Steps(steps))?;
    while matches!(run.session.turn(), LoopTurn::Stepped) {}
    let counters = run.session.stats();
    let counters = serde_json::to_string(&counters).map_err(|e| e.to_string())?;
    Ok(format!("{}{counters}", run.rows.csv()))
}

fn start(
    scene: &Scene,
    name: &str,
    nodes: Option<usize>,
    ending: Ending,
) -> Result<(PageRun, Setup), String> {
    let (scene, plan) = on_nodes(scene, nodes)?;
    let scene = Arc::new(scene);
    let setup = Setup::of(Arc::clone(&scene), name, &plan);
    let rows = KeptRows::default();
    let request = Request {
        name: name.to_owned(),
        scene,
        plan,
        threads: 1,
        watchers: vec![Watcher::new("table", Box::new(rows.clone()), 1)],
        ending,
    };
    let session = Cooperative::start(request).map_err(|error| error.to_string())?;
    Ok((PageRun { session, rows }, setup))
}

fn wiring(handle: &RunHandle, setup: Setup, beside: &PageSweep, files: &Files) -> Wiring {
    let [status, settled, ground] = [(); 3].map(|()| handle.clone());
    let scene = Arc::clone(&setup.scene);
    let place = Rc::clone(beside);
    let (saves, writes) = (Rc::clone(files), Rc::clone(files));
    let name = setup.name.replace('/', "-");
    let file = format!("{name}.toml");
    Wiring {
        setup,
        frames: handle.latest(),
        commands: handle.commands(),
        status: Box::new(move || {
            let status = status.status();
            RunStatus {
                health: status.failure.map_or(Health::Running, Health::Failed),
                recorder: None,
                climbs: status.climbs,
                finer: status.finer,
            }
        }),
        settled: Box::new(move || settled.settled()),
        start_sweep: Some(Box::new(move |order| {
            let ground = Ground::of(&scene, &*ground.settled()?)?;
            let (sweep, worker) = Background::cooperative(ground, order);
            place.replace(worker);
            Some(sweep)
        })),
        interrupt: Arc::new(AtomicBool::new(false)),
        toggle_recording: None,
        open_viewer: None,
        rebuild: None,
        save_scene: Some(Box::new(move |toml| {
            saves.borrow_mut().push((file.clone(), toml.to_owned()));
            Ok(PathBuf::from(&file))
        })),
        write_shown: Some(Box::new(move |shown: Shown| {
            let mut files = writes.borrow_mut();
            files.push((format!("{name}.toml"), shown.scene_toml));
            let tables = shown.tables.into_iter();
            files.extend(tables.map(|(file, text)| (format!("{name}-{file}"), text)));
            let (answer, heard) = channel();
            // Who asked has gone away only if the page has.
            let _ = answer.send(Ok("tables and scene go to the downloads".to_owned()));
            heard
        })),
        lesson: None,
    }
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "tests")]
    use super::*;
    use crate::tui::event::{Chord, KeyName, Modifiers, Pointer, PointerAct};
    use asperity_engine::sim::CautionCode;

    fn page(link: &str) -> WebPage {
        let mut page = WebPage::open(PageLink::read(link).unwrap()).unwrap();
        page.resize(120, 40, (8, 16));
        page
    }

    fn press(page: &mut WebPage, key: KeyName) {
        page.take(ScreenEvent::Key(Chord::new(key, Modifiers::default())));
    }

    /// Draws until something holds, stepping in between.
    fn until(page: &mut WebPage, what: &str, holds: impl Fn(&WebPage) -> bool) {
        for turn in 0..4000 {
            if holds(page) {
                return;
            }
            page.step();
            page.draw(20.0 * f64::from(turn));
        }
        panic!("{what}: {}", page.spoken());
    }

    #[test]
    fn a_link_is_written_as_it_is_read() {
        let key = "body_1.surface.wavelength_x_m";
        let mut page = page(&format!("scene=twin_disc\nnodes=33\n{key} = 4e-4"));
        assert_eq!(page.link(), format!("scene=twin_disc&nodes=33&{key}=4e-4"));
        press(&mut page, KeyName::Right);
        let link = page.link();
        let turned = PageLink::read(&link.replace('&', "\n")).unwrap();
        let aim = page.explorer.app.target(Knob::SlideRoll);
        assert_eq!(turned.scene.motion.slide_roll, aim, "{link}");
        let scene = PageLink::from_file(&page.scene()).unwrap().scene;
        assert_eq!(scene.motion.slide_roll, aim);
        assert_eq!(
            page.spoken().split(" S ").next(),
            Some("No simulated life yet.")
        );
    }

    #[test]
    fn what_a_lesson_says_and_takes_is_given_to_the_page() {
        let mut page = page("nodes=33");
        let begins = page.caption();
        assert!(begins.starts_with("scene\nto begin\n"), "{begins}");
        press(&mut page, KeyName::Char('t'));
        press(&mut page, KeyName::Enter);
        let asked = page.caption();
        let lines: Vec<&str> = asked.split('\n').collect();
        assert!(
            lines[0] == "lesson" && lines[1].starts_with("1/13") && lines[2].contains("How often"),
            "{asked}"
        );
        // What gives the answer away is not told before.
        assert_eq!(lines[3], "");
        assert!(lines.len() >= 6, "{asked}");
        // What is answered is not asked any more.
        press(&mut page, KeyName::Char('1'));
        assert_eq!(page.caption().split('\n').count(), 4, "{}", page.caption());
        press(&mut page, KeyName::Char('T'));
        assert!(!page.caption().starts_with("lesson"), "{}", page.caption());
    }

    #[test]
    fn cautions_are_spoken() {
        let mut page = page("nodes=65\nstress.depths=8\ntime.step_nodes=2\nstress.depth_max_a=1.2");
        let said = |page: &WebPage| page.explorer.app.cautions();
        until(&mut page, "roughness", |page| {
            said(page)
                .iter()
                .any(|caution| caution.code == CautionCode::CoarseWave)
        });
        let cautions = said(&page);
        let spoken = page.spoken();
        for code in [CautionCode::LongStep, CautionCode::ShallowStress] {
            assert!(
                cautions.iter().any(|caution| caution.code == code),
                "{code:?}"
            );
        }
        for caution in cautions {
            assert!(spoken.contains(&caution.text), "{}: {spoken}", caution.text);
        }
    }

    #[test]
    fn a_run_without_a_screen_leaves_its_table_and_counters() {
        let text = measured(&PageLink::read("nodes=33").unwrap(), 3).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        let passage = lines.iter().filter(|line| line.contains("passage")).count();
        assert!(passage >= 3 && lines[0].contains("h_central_m"), "{text}");
        let counters: serde_json::Value = serde_json::from_str(lines.last().unwrap()).unwrap();
        assert!(counters["steps"].as_u64() >= Some(3), "{counters}");
    }

    /// Any size, key and pointer, on the panels and on what lies over them.
    #[test]
    fn no_event_breaks_it() {
        let mut page = page("nodes=33");
        until(&mut page, "a frame", |page| {
            page.explorer.app.frame().is_some()
        });
        let sizes = [
            (0, 0),
            (1, 1),
            (40, 30),
            (48, 44),
            (59, 20),
            (60, 20),
            (300, 4),
            (200, 60),
        ];
        let acts = [
            PointerAct::Press,
            PointerAct::Drag,
            PointerAct::WheelUp,
            PointerAct::WheelDown,
            PointerAct::SecondPress,
        ];
        let keys = "?tei\u{1b}mzpPycug1=5\r+-bxo s\tw";
        let mut time = 1e5;
        for (n, key) in keys.chars().enumerate() {
            press(&mut page, KeyName::Char(key));
            let (columns, rows) = sizes[n % sizes.len()];
            page.resize(columns, rows, (1 + n as u16 % 9, 1 + n as u16 % 19));
            for (k, act) in acts.into_iter().enumerate() {
                let at = |side: u16| (side / 5 * k as u16).saturating_add(n as u16 % 7);
                let (column, row) = (at(columns), at(rows));
                page.take(ScreenEvent::Pointer(Pointer { act, column, row }));
                time += 20.0;
                let (goes_on, _) = page.draw(time);
                assert!(goes_on);
                drop((
                    page.picture(),
                    page.curves(),
                    page.link(),
                    page.table(),
                    page.saved(),
                ));
            }
            page.step();
        }
        for time in [f64::NAN, f64::INFINITY, -1.0, 0.0] {
            page.draw(time);
        }
        press(&mut page, KeyName::Esc);
        press(&mut page, KeyName::Char('q'));
        assert!(!page.draw(time).0, "it has quit");
    }

    /// Curves are given when they have changed, and again for another size.
    #[test]
    fn curves_come_once() {
        let mut page = page("nodes=33");
        until(&mut page, "a frame", |page| {
            page.explorer.app.frame().is_some()
        });
        page.draw(1e6);
        assert!(page.curves().len() > 100);
        page.draw(1e6);
        assert!(page.curves().is_empty());
        page.resize(120, 40, (8, 16));
        page.draw(1e6);
        assert!(page.curves().len() > 100);
        // Under an overlay there are none.
        press(&mut page, KeyName::Char('?'));
        page.draw(1e6);
        assert_eq!(page.curves(), [0; 4]);
    }

    /// A run that has settled is swept between the turns of the page, a knob ends that.
    #[test]
    fn a_settled_run_is_swept() {
        let mut page = page("nodes=33\nA1=0\nA2=0");
        until(&mut page, "a sweep", |page| page.beside.borrow().is_some());
        let swept = |page: &WebPage| page.explorer.app.all_simulated().count();
        until(&mut page, "two points", |page| swept(page) >= 2);
        press(&mut page, KeyName::Right);
        page.step();
        assert!(page.beside.borrow().is_none());
    }
}
