//! Viewers that look on: missing, frozen or closed ones cost the run nothing and are told in words.
#![cfg(feature = "rerun")]
#![expect(clippy::unwrap_used, reason = "tests")]

use crate::common::synthetic;
use std::io::{BufRead as _, BufReader, Write as _};
use std::net::{Ipv4Addr, SocketAddr, TcpListener, TcpStream};
use std::process::{Command, Stdio};

use asperity_engine::observe::{Observer, Overwrite};
use asperity_engine::scene::Record;
use asperity_recorder::{Live, Recorder};
use asperity_session::{Queue, WhenFull};

const NODES: usize = 65;

fn listener() -> (TcpListener, SocketAddr) {
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
    let address = listener.local_addr().unwrap();
    (listener, address)
}

#[test]
fn a_missing_viewer_is_told_at_once_with_what_to_do() {
    let (listener, address) = listener();
    drop(listener);
    let refused = Recorder::live(Live::Connect(address), &Record::default());
    let error = refused.err().unwrap();
    assert!(error.output.contains(&address.to_string()), "{error}");
    assert!(error.reason.contains("--spawn"), "{error}");
}

#[test]
fn a_busy_port_is_told_and_not_served() {
    let (_listener, address) = listener();
    let refused = Recorder::live(Live::Serve(address.port()), &Record::default());
    let error = refused.err().unwrap();
    assert!(error.reason.contains("--serve=PORT"), "{error}");
}

/// It takes the connection, answers and never reads: the library's own stream would block for ever.
#[test]
fn a_frozen_viewer_loses_frames_and_the_file_none() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.rrd");
    let (listener, address) = listener();
    std::thread::spawn(move || {
        // An empty frame of settings to each, which stays open.
        let mut held = Vec::new();
        for mut stream in listener.incoming().flatten() {
            drop(std::io::Write::write_all(
                &mut stream,
                b"\0\0\0\x04\0\0\0\0\0",
            ));
            held.push(stream);
        }
    });
    let record = Record::default();
    let live = Recorder::live(Live::Connect(address), &record).unwrap();
    let mut live = Queue::spawn_live("frozen", 4, Box::new(live)).unwrap();
    let file = Recorder::create(&path, Overwrite::Refuse, &record).unwrap();
    let mut file = Queue::spawn("record", 4, WhenFull::Wait, Box::new(file)).unwrap();
    let context = synthetic::context(synthetic::scene(NODES, 1.0));
    live.begin(&context).unwrap();
    file.begin(&context).unwrap();
    let steps = 400;
    let made = synthetic::frame(NODES, 1);
    for step in 1..=steps {
        let mut frame = asperity_engine::sim::Frame::clone(&made);
        frame.step = step;
        let frame = std::sync::Arc::new(frame);
        live.frame(&frame).unwrap();
        file.frame(&frame).unwrap();
    }
    assert_eq!(live.stats().waits, 0);
    let complete = file.finish().unwrap();
    assert_eq!((complete.frames, complete.skipped), (steps, 0));
    let report = live.finish().unwrap();
    assert_eq!(report.frames + report.skipped, steps, "{report:?}");
    assert!(report.skipped > 0, "{report:?}");
}

/// A server takes everything without anybody there, and gives the port back.
#[test]
fn a_server_without_viewers_takes_everything() {
    let (listener, address) = listener();
    drop(listener);
    let live = Live::Serve(address.port());
    let recorder = Recorder::live(live, &Record::default()).unwrap();
    let mut queue = Queue::spawn_live("served", 64, Box::new(recorder)).unwrap();
    queue
        .begin(&synthetic::context(synthetic::scene(NODES, 1.0)))
        .unwrap();
    for step in 1..=20 {
        queue.frame(&synthetic::frame(NODES, step)).unwrap();
    }
    let report = queue.finish().unwrap();
    assert_eq!((report.frames, report.skipped), (20, 0), "{report:?}");
    assert_eq!(report.output, live.to_string());
}

/// The port that is told is the one that is served, on this machine alone, also when the run has ended; Enter ends it.
#[test]
fn a_held_server_serves_until_enter() {
    let folder = tempfile::tempdir().unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_asperity"))
        .args([
            "run",
            "--no-record",
            "--serve=0",
            "--hold",
            "--passages=0.25",
        ])
        .args([
            "--set=grid.nodes=33",
            "--set=life=none",
            "--set=stress=none",
        ])
        .args([
            "--set=body_1.surface.kind=smooth",
            "--set=body_2.surface.kind=smooth",
        ])
        .current_dir(folder.path())
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut words = BufReader::new(child.stderr.take().unwrap()).lines();
    let mut line_with = |what: &str| {
        let found = words.find(|line| line.as_ref().unwrap().contains(what));
        found.unwrap().unwrap()
    };
    let told = line_with("rerun+http://127.0.0.1:");
    let port = told.split("127.0.0.1:").nth(1).unwrap();
    let port: u16 = port.split('/').next().unwrap().parse().unwrap();
    line_with("until Enter or Ctrl-C");
    assert!(TcpStream::connect((Ipv4Addr::LOCALHOST, port)).is_ok());
    assert!(child.try_wait().unwrap().is_none());
    child.stdin.take().unwrap().write_all(b"\n").unwrap();
    assert!(matches!(child.wait().unwrap().code(), Some(0 | 2)));
}
