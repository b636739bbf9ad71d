//! Replay of one period of a passage that repeats, at any speed, while the cores do something else.

use std::sync::Arc;

use asperity_engine::sim::Frame;
use asperity_session::run::Settled;

/// Wall time in which a length of 4 a passes at first, s.
const PASSAGE_S: f64 = 6.0;
/// Slowest and fastest replay, over that.
const SPEEDS: [f64; 2] = [1.0 / 64.0, 16.0];

/// Whether a replay moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ReplayMotion {
    /// It does.
    Going,
    /// It stands, to be looked at frame by frame.
    Frozen,
}

/// A replay under way.
#[derive(Debug, Clone)]
pub struct Replay {
    settled: Arc<Settled>,
    /// Simulated time since the replay began, s; goes on over the periods.
    at_s: f64,
    /// Simulated per wall time at speed 1.
    usual: f64,
    speed: f64,
    motion: ReplayMotion,
}

impl Replay {
    /// From the first frame; `None` where nothing moves.
    pub fn new(settled: Arc<Settled>) -> Option<Self> {
        let first = settled.frames.first()?;
        if settled.frames.len() < 2 || settled.period_s <= 0.0 {
            return None;
        }
        let passage_s = 4.0 * first.a_m / first.metrics.entrainment_m_s.abs().max(1e-9);
        Some(Self {
            usual: passage_s / PASSAGE_S,
            settled,
            at_s: 0.0,
            speed: 1.0,
            motion: ReplayMotion::Going,
        })
    }

    /// So much wall time went by, s.
    pub fn advance(&mut self, wall_s: f64) {
        if self.motion == ReplayMotion::Going {
            self.at_s += wall_s * self.usual * self.speed;
        }
    }

    /// The frame of this moment.
    pub fn frame(&self) -> &Arc<Frame> {
        &self.settled.frames[self.place()]
    }

    /// Which frame of the period it is.
    pub fn place(&self) -> usize {
        self.place_at(self.at_s)
    }

    fn place_at(&self, at_s: f64) -> usize {
        let n = self.settled.frames.len();
        let part = (at_s / self.settled.period_s).rem_euclid(1.0);
        ((part * n as f64) as usize).min(n - 1)
    }

    /// The frame so many lengths of 4 a before this moment; the orbit has no beginning.
    pub fn before(&self, passages: f64) -> &Arc<Frame> {
        let ago_s = passages * self.usual * PASSAGE_S;
        &self.settled.frames[self.place_at(self.at_s - ago_s)]
    }

    /// Simulated time since the replay began, s.
    pub fn at_s(&self) -> f64 {
        self.at_s
    }

    /// What is replayed.
    pub fn settled(&self) -> &Settled {
        &self.settled
    }

    /// Lengths of 4 a that went by since the replay began.
    pub fn passages(&self) -> f64 {
        self.at_s / (self.usual * PASSAGE_S)
    }

    /// Simulated over wall time.
    pub fn rate(&self) -> f64 {
        self.usual * self.speed
    }

    /// Whether it moves.
    pub fn motion(&self) -> ReplayMotion {
        self.motion
    }

    /// Stops it, or lets it go on.
    pub fn toggle(&mut self) {
        self.motion = match self.motion {
            ReplayMotion::Going => ReplayMotion::Frozen,
            ReplayMotion::Frozen => ReplayMotion::Going,
        };
    }

    /// Twice as fast so many times; negative: half as fast.
    pub fn faster(&mut self, times: i32) {
        self.speed = (self.speed * 2.0_f64.powi(times)).clamp(SPEEDS[0], SPEEDS[1]);
    }

    /// Stops and goes so many frames on (negative: back).
    pub fn step(&mut self, frames: i32) {
        self.motion = ReplayMotion::Frozen;
        let each = self.settled.period_s / self.settled.frames.len() as f64;
        let here = (self.at_s / each + 1e-6).floor();
        // In the middle of a frame's time, so that rounding does not skip one.
        self.at_s = ((here + f64::from(frames) + 0.5) * each).max(0.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_engine::sim::Metrics;

    fn replay(n: u64) -> Replay {
        let frame = |step| {
            Arc::new(Frame {
                step,
                a_m: 1e-3,
                metrics: Metrics {
                    entrainment_m_s: 1.0,
                    ..Metrics::default()
                },
                ..Frame::default()
            })
        };
        let settled = Settled {
            frames: (0..n).map(frame).collect(),
            period_s: 2e-3,
            state: None,
            is_last: true,
            ground: None,
        };
        Replay::new(Arc::new(settled)).expect("it moves")
    }

    #[test]
    fn it_goes_round_at_its_speed() {
        let mut replay = replay(10);
        // 4 a pass in 6 s: the period of half of that in 3 s.
        replay.advance(1.5);
        assert_eq!(replay.place(), 5);
        replay.faster(1);
        replay.advance(1.5);
        assert_eq!((replay.place(), replay.frame().step), (5, 5));
        assert!((replay.passages() - 0.75).abs() < 1e-12);
    }

    #[test]
    fn single_frames_are_stepped_both_ways_and_round() {
        let mut replay = replay(3);
        let mut seen = Vec::new();
        for _ in 0..4 {
            seen.push(replay.place());
            replay.step(1);
        }
        assert_eq!(seen, [0, 1, 2, 0]);
        replay.step(-1);
        replay.step(-1);
        assert_eq!(replay.place(), 2);
        replay.advance(100.0);
        assert_eq!(replay.place(), 2, "it stands");
    }

    #[test]
    fn nothing_moves_nothing_is_replayed() {
        let still = Settled {
            frames: vec![Arc::default()],
            period_s: 0.0,
            state: None,
            is_last: true,
            ground: None,
        };
        assert!(Replay::new(Arc::new(still)).is_none());
    }
}
