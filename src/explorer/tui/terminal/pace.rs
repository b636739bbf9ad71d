//! How fast the line takes bytes, and how many may be on their way.
//!
//! What is on its way cannot be taken back: a key's answer waits behind it. A line of which it is known that it is slow
//! is therefore never given more than it carries in a quarter of a second. It is known from the line's own setting
//! (`stty speed`), or found: writes that wait, one after another.

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Of the setting of a line that is slow, bits a second; a pseudo-terminal is set to 38400, which says nothing.
const SLOW_BAUD: f64 = 19_200.0;
/// Bits on the line for a byte.
const BITS: f64 = 10.0;
/// A line that is found to carry fewer bytes a second is slow: what waits before it (8 kB) takes long to be seen.
const SLOW: f64 = 20_000.0;
/// A write that takes longer has waited for the line.
const WAITED: Duration = Duration::from_millis(30);
/// Time over which writes must have waited before their rate is believed.
const LOOKED: Duration = Duration::from_millis(500);
/// How long what was found is believed: it may have been another hindrance.
const BELIEVED: Duration = Duration::from_mins(2);
/// Bytes that may wait in the system before a write has to.
const SYSTEM: f64 = 8192.0;
/// Seconds of the line's time that may be on their way.
const AHEAD_S: f64 = 0.25;
/// Part of a rate that was found that is used: what waits in unknown places melts away.
const USED: f64 = 0.85;
/// The fewest bytes that are worth beginning with.
const LEAST: f64 = 64.0;

/// What is known of the line.
#[derive(Debug, Clone)]
pub(super) struct LinePace {
    /// Bytes a second, and until when that is believed.
    slow: Option<(f64, Option<Instant>)>,
    /// Bytes on their way, when that was.
    ahead: (f64, Instant),
    waited: Option<Waited>,
}

/// Writes that wait, one after another.
#[derive(Debug, Clone, Copy)]
struct Waited {
    /// When the first one ended; the line was full then.
    since: Instant,
    /// When the last one ended.
    last: Instant,
    /// Bytes since the first.
    bytes: f64,
}

impl LinePace {
    /// Of a line that says how many bits a second it carries.
    pub(super) fn of(baud: Option<f64>, now: Instant) -> Self {
        let slow = baud.filter(|baud| (1.0..=SLOW_BAUD).contains(baud));
        Self {
            slow: slow.map(|baud| (baud / BITS, None)),
            ahead: (0.0, now),
            waited: None,
        }
    }

    /// Bytes that may be written now; `None`: as many as there are.
    pub(super) fn room(&mut self, now: Instant) -> Option<usize> {
        if let Some((_, Some(until))) = self.slow
            && now >= until
        {
            self.slow = None;
        }
        let (rate, _) = self.slow?;
        let (ahead, then) = self.ahead;
        let ahead = (ahead - rate * now.saturating_duration_since(then).as_secs_f64()).max(0.0);
        self.ahead = (ahead, now);
        let room = (AHEAD_S * rate).max(LEAST) - ahead;
        Some(if room < LEAST { 0 } else { room as usize })
    }

    /// Whether the line is known to be slow.
    pub(super) fn is_slow(&self) -> bool {
        self.slow.is_some()
    }

    /// So many bytes were written.
    pub(super) fn wrote(&mut self, bytes: usize, began: Instant, ended: Instant) {
        let bytes = bytes as f64;
        self.ahead.0 += bytes;
        let waits = ended.saturating_duration_since(began) > WAITED;
        let goes_on = |waited: &Waited| began.saturating_duration_since(waited.last) < LOOKED;
        let Some(mut waited) = self.waited.filter(goes_on) else {
            self.waited = waits.then_some(Waited {
                since: ended,
                last: ended,
                bytes: 0.0,
            });
            return;
        };
        waited.bytes += bytes;
        if waits {
            waited.last = ended;
        }
        self.waited = Some(waited);
        let over = waited.last.saturating_duration_since(waited.since);
        if waits && over > LOOKED {
            // The line is as full as it was then: what was written since is what it carried.
            let rate = waited.bytes / over.as_secs_f64();
            let is_set = matches!(self.slow, Some((_, None)));
            if rate < SLOW && !is_set {
                self.slow = Some((USED * rate, Some(ended + BELIEVED)));
                self.ahead = (SYSTEM, ended);
            }
            self.waited = None;
        }
    }
}

/// What the line is set to, bits a second.
pub(super) fn baud() -> Option<f64> {
    let mut stty = Command::new("stty");
    stty.arg("speed").stderr(Stdio::null());
    let said = stty.stdin(Stdio::inherit()).output().ok()?;
    String::from_utf8(said.stdout).ok()?.trim().parse().ok()
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "tests")]
    use super::*;

    fn after(start: Instant, seconds: f64) -> Instant {
        start + Duration::from_secs_f64(seconds)
    }

    #[test]
    fn a_line_that_says_so_is_never_given_more_than_it_carries() {
        let start = Instant::now();
        let mut pace = LinePace::of(Some(9600.0), start);
        let mut sum = 0;
        for tick in 0..400 {
            let now = after(start, 0.025 * f64::from(tick));
            let room = pace.room(now).unwrap();
            sum += room;
            pace.wrote(room, now, now);
        }
        // Ten seconds at 960 bytes a second, and a quarter of a second ahead.
        assert!((9_500..=9_840).contains(&sum), "{sum}");
        assert_eq!(LinePace::of(Some(38_400.0), start).room(start), None);
        assert_eq!(LinePace::of(None, start).room(start), None);
    }

    /// A line that carries `rate`, with so much room before it; every 25 ms as much as may be is written.
    fn found(rate: f64, seconds: f64) -> (LinePace, Instant) {
        let start = Instant::now();
        let mut pace = LinePace::of(None, start);
        let (mut now, mut free) = (0.0, SYSTEM);
        while now < seconds {
            let bytes = pace.room(after(start, now)).unwrap_or(2000).min(2000);
            let wait = ((bytes as f64 - free) / rate).max(0.0);
            free = (free - bytes as f64 + rate * wait).max(0.0);
            pace.wrote(bytes, after(start, now), after(start, now + wait));
            now += wait + 0.025;
            free = (free + rate * 0.025).min(SYSTEM);
        }
        (pace, after(start, now))
    }

    #[test]
    fn a_slow_line_is_found_and_a_fast_one_left_alone() {
        for rate in [300.0, 960.0, 5000.0] {
            let (pace, _) = found(rate, 30.0);
            let (known, _) = pace.slow.unwrap();
            assert!((known / (USED * rate) - 1.0).abs() < 0.2, "{rate}: {known}");
        }
        assert!(!found(1e5, 30.0).0.is_slow());
    }

    #[test]
    fn one_hindrance_is_no_slow_line_and_what_was_found_is_forgotten() {
        let start = Instant::now();
        let mut pace = LinePace::of(None, start);
        pace.wrote(500, start, after(start, 4.0));
        for tick in 0..10 {
            let now = after(start, 4.0 + 0.025 * f64::from(tick));
            pace.wrote(500, now, now);
        }
        pace.wrote(500, after(start, 60.0), after(start, 64.0));
        assert!(!pace.is_slow());
        let (mut pace, now) = found(960.0, 30.0);
        assert!(pace.is_slow());
        assert_eq!(pace.room(now + BELIEVED), None);
    }
}
