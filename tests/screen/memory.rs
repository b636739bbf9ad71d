//! Memory of the explorer stays where it is however long one sits before it: what a run held goes with it.
#![cfg(all(feature = "tui", target_os = "linux"))]
#![expect(clippy::unwrap_used, reason = "tests")]

use std::time::Duration;

use crate::common::pty::Terminal;

/// Resident memory of the program that the shell runs, MB.
fn resident_mb(terminal: &Terminal) -> f64 {
    let shell = terminal.shell.process_id().unwrap();
    let children = format!("/proc/{shell}/task/{shell}/children");
    let children = std::fs::read_to_string(children).unwrap();
    let child = children.split_whitespace().next().unwrap();
    let status = std::fs::read_to_string(format!("/proc/{child}/status")).unwrap();
    let line = status
        .lines()
        .find(|line| line.starts_with("VmRSS"))
        .unwrap();
    let kb: f64 = line.split_whitespace().nth(1).unwrap().parse().unwrap();
    kb / 1024.0
}

fn explorer() -> Terminal {
    // One arena: what the allocator keeps for threads that have ended is not the program's.
    let mut terminal = Terminal::open(env!("CARGO_BIN_EXE_asperity"), &[("MALLOC_ARENA_MAX", "1")]);
    let small = "--no-record --threads 1 --set grid.nodes=65 --set stress.depths=8";
    terminal.explore(&format!("\"$ASPERITY\" explore {small}"));
    terminal
}

/// Greatest of some looks at the memory, MB.
fn watch(terminal: &mut Terminal, looks: usize, mut between: impl FnMut(&mut Terminal)) -> f64 {
    let mut most = 0.0_f64;
    for _ in 0..looks {
        between(terminal);
        most = most.max(resident_mb(terminal));
    }
    most
}

fn another_scene(terminal: &mut Terminal) {
    terminal.press("e");
    std::thread::sleep(Duration::from_millis(60));
    terminal.press("\r");
    std::thread::sleep(Duration::from_millis(340));
}

#[test]
fn scenes_that_were_left_are_given_back() {
    let mut terminal = explorer();
    let first = watch(&mut terminal, 10, another_scene);
    let second = watch(&mut terminal, 30, another_scene);
    println!("at most {first:.0} MB in 10 scenes, {second:.0} MB in 30 more");
    // A scene that stays takes 4 MB: 120 more.
    assert!(second < first + 40.0, "{first} MB, {second} MB");
}

/// A letter of the keyboard but those that quit and write files, or what opens and runs another scene.
fn any_key(random: &mut u64) -> &'static str {
    const KEYS: &str = "kjhlHL123456789xX .,o-+=tnmMzpP[]<>bByucgui?e\r";
    *random = random
        .wrapping_mul(6364136223846793005)
        .wrapping_add(1442695040888963407);
    let place = (*random >> 33) as usize % KEYS.len();
    &KEYS[place..=place]
}

/// An hour of random keys (`ASPERITY_KEYS_S` for another time).
#[test]
#[ignore = "an hour"]
fn random_keys_leave_memory_where_it_is() {
    let seconds: f64 =
        std::env::var("ASPERITY_KEYS_S").map_or(3600.0, |text| text.parse().unwrap());
    let mut terminal = explorer();
    let mut random = 17;
    let mut least_most = Vec::new();
    for _ in 0..12 {
        let looks = (seconds / 12.0 / 0.5) as usize;
        least_most.push(watch(&mut terminal, looks, |terminal| {
            for _ in 0..20 {
                terminal.press(any_key(&mut random));
                std::thread::sleep(Duration::from_millis(25));
            }
        }));
    }
    println!("at most, MB, in each twelfth: {least_most:.0?}");
    let most = |part: &[f64]| part.iter().copied().fold(0.0, f64::max);
    assert!(most(&least_most[8..]) < 1.03 * most(&least_most[2..8]) + 20.0);
}
