//! Every lesson played in a terminal by keys, as it comes: each question answered, if wrongly then again; a late digit; the
//! seconds of its beats. Some ten minutes:
//!
//! ```text
//! cargo test --release --test screen play:: -- --ignored --nocapture
//! ```
#![cfg(all(feature = "tui", unix))]
#![expect(clippy::unwrap_used, reason = "tests")]

use std::time::Instant;

use crate::common::pty::Terminal;
use asperity_explorer::tui::lessons::{Beat, LessonQuestion, built_in};

/// A screen on which no caption is cut.
const SIZE: (u16, u16) = (200, 60);

/// The words of the screen, without frames and breaks.
fn words(terminal: &Terminal) -> String {
    let text = terminal.text().replace('▌', " ");
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn wait(terminal: &mut Terminal, what: &str) {
    let what: String = what.split_whitespace().collect::<Vec<_>>().join(" ");
    terminal.wait(&what.clone(), |screen| {
        let text = screen.contents().replace('▌', " ");
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        text.contains(&what)
    });
}

/// Seconds from an answer to its verdict, which is told.
fn answer(terminal: &mut Terminal, place: usize) -> (f64, String) {
    let began = Instant::now();
    terminal.press(&(place + 1).to_string());
    terminal.wait("verdict", |screen| {
        let text = screen.contents();
        text.contains("Right:") || text.contains("You said")
    });
    (began.elapsed().as_secs_f64(), words(terminal))
}

/// A question, answered wrongly if the first answer is wrong, then rightly.
fn asked(terminal: &mut Terminal, question: &LessonQuestion) -> f64 {
    wait(terminal, &question.ask);
    let (seconds, told) = answer(terminal, 0);
    // An answer that comes late turns no knob and changes no verdict.
    terminal.press("2");
    wait(terminal, "digits answer while a question is asked");
    if told.contains("Right:") {
        return seconds;
    }
    let is_right = |text: &&String| told.contains(&format!("\u{201c}{text}\u{201d}."));
    let others = question.answers.iter().skip(1);
    let right = others.into_iter().position(|text| is_right(&text)).unwrap() + 1;
    terminal.press("N");
    wait(terminal, &question.ask);
    let (again, told) = answer(terminal, right);
    assert!(told.contains("Right:"), "{told}");
    seconds.max(again)
}

/// A beat to its end: the seconds until its verdict, or until the next one begins.
fn play(terminal: &mut Terminal, beat: &Beat, next: Option<&str>) -> f64 {
    let began = Instant::now();
    if let Some(question) = &beat.question {
        let seconds = asked(terminal, question);
        if next.is_some() {
            terminal.press("n");
        }
        return seconds;
    }
    if let Some(next) = next {
        wait(terminal, next);
    }
    began.elapsed().as_secs_f64()
}

#[test]
#[ignore = "ten minutes"]
fn every_lesson_by_keys() {
    let lessons = built_in();
    for (place, lesson) in lessons.iter().enumerate() {
        let mut terminal = Terminal::open(env!("CARGO_BIN_EXE_asperity"), &[]);
        terminal.resize(SIZE.0, SIZE.1);
        terminal.explore("\"$ASPERITY\" explore demonstration_quick --no-record --threads 2");
        terminal.press("t");
        wait(&mut terminal, &lesson.title);
        if place < 9 {
            terminal.press(&(place + 1).to_string());
        } else {
            // The list goes round: from the first one up to the last.
            for _ in place..lessons.len() {
                terminal.press("\x1b[A");
                std::thread::sleep(std::time::Duration::from_millis(300));
            }
            terminal.press("\r");
        }
        let beats = lesson.beats.len();
        let mut seconds = Vec::new();
        for (at, beat) in lesson.beats.iter().enumerate() {
            wait(&mut terminal, &format!("({}/{beats})", at + 1));
            let next = (at + 1 < beats).then(|| format!("({}/{beats})", at + 2));
            let took = play(&mut terminal, beat, next.as_deref());
            let what = if beat.question.is_some() {
                "verdict"
            } else {
                "shown and read"
            };
            seconds.push(format!("{what} {took:.1} s"));
        }
        println!(
            "{}/{} {}: {}",
            place + 1,
            lessons.len(),
            lesson.title,
            seconds.join(", ")
        );
        terminal.press("q");
    }
}
