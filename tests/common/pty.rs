//! A shell in a pseudo-terminal, with what a person sees of it.

use std::io::{Read, Write};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use portable_pty::{Child, CommandBuilder, MasterPty, PtySize, native_pty_system};
use vt100::{MouseProtocolMode, Parser, Screen};

/// Longest wait for anything: a hang is told, a slow machine is not.
pub(crate) const PATIENCE: Duration = Duration::from_mins(2);

pub(crate) struct Terminal {
    pub(crate) parser: Arc<Mutex<Parser>>,
    pub(crate) master: Option<Box<dyn MasterPty + Send>>,
    pub(crate) keys: Option<Box<dyn Write + Send>>,
    pub(crate) shell: Box<dyn Child + Send + Sync>,
    pub(crate) folder: tempfile::TempDir,
    /// Milliseconds that the line takes for 4 kB.
    pub(crate) lag_ms: Arc<AtomicU64>,
    /// Bytes that came.
    pub(crate) received: Arc<AtomicU64>,
}

fn size(cols: u16, rows: u16) -> PtySize {
    PtySize {
        rows,
        cols,
        pixel_width: 0,
        pixel_height: 0,
    }
}

impl Terminal {
    /// A shell with job control, to which `$ASPERITY` is the program.
    pub(crate) fn open(program: &str, variables: &[(&str, &str)]) -> Self {
        let pair = native_pty_system().openpty(size(100, 30)).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let mut command = CommandBuilder::new("sh");
        command.args(["-i"]);
        command.cwd(folder.path());
        for name in ["NO_COLOR", "COLORTERM", "LC_ALL", "LC_CTYPE", "ENV"] {
            command.env_remove(name);
        }
        command.env("PS1", "READY> ");
        command.env("TERM", "xterm-256color");
        command.env("LANG", "C.UTF-8");
        command.env("ASPERITY", program);
        for (name, value) in variables {
            command.env(name, value);
        }
        let shell = pair.slave.spawn_command(command).unwrap();
        let mut reader = pair.master.try_clone_reader().unwrap();
        let keys = pair.master.take_writer().unwrap();
        let parser = Arc::new(Mutex::new(Parser::new(30, 100, 0)));
        let screen = Arc::clone(&parser);
        let lag_ms = Arc::new(AtomicU64::new(0));
        let lag = Arc::clone(&lag_ms);
        let received = Arc::new(AtomicU64::new(0));
        let count = Arc::clone(&received);
        std::thread::spawn(move || {
            let mut bytes = [0; 4096];
            while let Ok(n @ 1..) = reader.read(&mut bytes) {
                screen.lock().unwrap().process(&bytes[..n]);
                count.fetch_add(n as u64, Ordering::Relaxed);
                std::thread::sleep(Duration::from_millis(lag.load(Ordering::Relaxed)));
            }
        });
        let mut terminal = Self {
            parser,
            master: Some(pair.master),
            keys: Some(keys),
            shell,
            folder,
            lag_ms,
            received,
        };
        terminal.see("READY>");
        terminal
    }

    pub(crate) fn press(&mut self, keys: &str) {
        let sink = self.keys.as_mut().unwrap();
        sink.write_all(keys.as_bytes()).unwrap();
        sink.flush().unwrap();
    }

    pub(crate) fn text(&self) -> String {
        self.parser.lock().unwrap().screen().contents()
    }

    pub(crate) fn wait(&mut self, what: &str, ready: impl Fn(&Screen) -> bool) {
        let until = Instant::now() + PATIENCE;
        while !ready(self.parser.lock().unwrap().screen()) {
            assert!(Instant::now() < until, "no {what}:\n{}", self.text());
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    pub(crate) fn see(&mut self, text: &str) {
        self.wait(text, |screen| screen.contents().contains(text));
    }

    /// The shell asks for a line: what is typed before goes to the program.
    pub(crate) fn prompt(&mut self) {
        self.wait("prompt", |screen| {
            let text = screen.contents();
            !screen.alternate_screen() && text.trim_end().ends_with("READY>")
        });
    }

    pub(crate) fn explore(&mut self, how: &str) {
        self.press(&format!("clear; {how}\n"));
        self.wait("explorer", |screen| {
            screen.alternate_screen() && screen.contents().contains("smooth rolling")
        });
    }

    pub(crate) fn resize(&mut self, cols: u16, rows: u16) {
        self.parser
            .lock()
            .unwrap()
            .screen_mut()
            .set_size(rows, cols);
        self.master
            .as_ref()
            .unwrap()
            .resize(size(cols, rows))
            .unwrap();
    }

    /// The shell has its terminal back: no second screen, a cursor, no mouse, lines that echo.
    pub(crate) fn is_given_back(&mut self, code: &str) {
        self.prompt();
        // The words are put together by the shell, so that the line as typed does not hold them.
        self.press("stty -a | tr ' ;' '\\n\\n' | grep -xE -e '-?(icanon|echo)' | tr '\\n' ' '; echo en''d\n");
        self.wait("answer", |screen| {
            screen.contents().lines().any(|line| line.ends_with(" end"))
        });
        let text = self.text();
        assert!(text.contains("icanon echo end"), "{text}");
        assert!(
            !text.contains("-icanon") && !text.contains("-echo"),
            "{text}"
        );
        assert!(text.contains(code), "{code}:\n{text}");
        let parser = self.parser.lock().unwrap();
        let screen = parser.screen();
        assert!(!screen.hide_cursor());
        assert_eq!(screen.mouse_protocol_mode(), MouseProtocolMode::None);
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        // A shell that is gone already cannot be ended.
        drop(self.shell.kill());
        drop(self.shell.wait());
    }
}
