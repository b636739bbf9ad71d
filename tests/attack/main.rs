//! The attack: hostile inputs and faults, against the program itself.
//!
//! ```text
//! cargo test --release --test attack                                   a taste of each, two minutes at most
//! cargo test --release --test attack -- --ignored --nocapture          10 000 inputs
//! ASPERITY_ATTACK=scenes:123 cargo test --release --test attack hostile -- --nocapture      that one input again
//! tests/attack/fuzz/fuzz.sh scene 600                                  coverage-guided, on one parser (`fuzz/runs.md`)
//! ```
//! `ASPERITY_PROGRAM` names another build to attack. Inputs are made from a few seeds and from `corpus/` by a generator that is seeded with the input's number, so that
//! each can be made again. Every one is given to a process of its own, in a folder of its own, with a minute and
//! 2 GB of address space.
#![cfg(all(unix, feature = "rerun"))]
#![expect(clippy::unwrap_used, reason = "tests")]

mod child;
#[cfg(target_os = "linux")]
mod clock;
mod faults;
mod forged;
mod inputs;
mod mutate;
#[cfg(feature = "tui")]
#[path = "../common/pty.rs"]
#[expect(dead_code, reason = "each test uses its part")]
mod pty;
mod replay;
mod report;

use inputs::Arsenal;
use report::Tally;

/// Inputs of each kind: in the quick form, in the long one.
const COUNTS: [(&str, [u64; 2]); 8] = [
    ("scenes", [160, 4000]),
    ("sweeps", [80, 2000]),
    ("rides", [20, 400]),
    ("maps", [80, 1700]),
    ("states", [40, 900]),
    ("recordings", [30, 500]),
    ("folders", [8, 250]),
    ("collections", [12, 250]),
];

fn attack(form: usize) -> Vec<Tally> {
    let arsenal = Arsenal::new();
    let one = std::env::var("ASPERITY_ATTACK").ok();
    let one = one.as_deref().and_then(|text| text.split_once(':'));
    COUNTS
        .iter()
        .map(|(kind, counts)| match one {
            Some((name, number)) if name == *kind => {
                let number = number.parse().unwrap();
                arsenal.attack(kind, number..number + 1)
            }
            Some(_) => Tally::new(kind),
            None => arsenal.attack(kind, 0..counts[form]),
        })
        .collect()
}

fn assert_survived(tallies: &[Tally]) {
    println!("{}", report::table(tallies));
    let failures = tallies.iter().flat_map(|tally| &tally.failures);
    let failures: Vec<&String> = failures.collect();
    assert!(failures.is_empty(), "{failures:#?}");
}

#[test]
fn hostile_inputs_are_survived() {
    assert_survived(&attack(0));
}

#[test]
fn the_corpus_of_the_fuzzer_is_survived() {
    assert_survived(&replay::all());
}

#[test]
fn faults_lose_nothing() {
    assert_survived(&faults::all());
}

#[test]
#[ignore = "the long form: some minutes"]
fn the_whole_attack() {
    let mut tallies = attack(1);
    tallies.extend(replay::all());
    tallies.extend(faults::all());
    assert_survived(&tallies);
}
