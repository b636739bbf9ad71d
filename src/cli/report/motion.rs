//! How the bodies move, as the scene says: titles do not know what `--set` changed.

use asperity_engine::math::number::sig;
use asperity_engine::scene::Scene;

/// S and the speeds of both bodies.
pub(super) fn text(scene: &Scene) -> String {
    let motion = &scene.motion;
    let when = if scene.events.is_empty() {
        ""
    } else {
        " at the start, before the scene's events"
    };
    let speed = |half: f64| sig(motion.entrainment_m_s * (1.0 + half * motion.slide_roll), 3);
    format!(
        "S = {}, U {} m/s; body 1 {} m/s, body 2 {} m/s{when}",
        sig(motion.slide_roll, 3),
        sig(motion.entrainment_m_s, 3),
        speed(-0.5),
        speed(0.5)
    )
}
