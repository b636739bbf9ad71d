//! Surfaces by how they were finished: a word in place of the numbers of a made surface.
//!
//! Heights are published, lengths along and across the lay are not: those are assumed, and lives hang on them.
//! A shot-peened flank is not among them: no published height with its source was at hand.

use std::fmt::Write as _;

use toml::{Table, Value};

use super::drawing::at;
use super::error::SceneError;
use super::key::{Key, Kind, Need, key};
use super::keys::joined;
use crate::closed_set;

closed_set! {
    /// How a surface was finished.
    pub(super) enum Finish {
        /// A gear's flank, ground: the lay lies across the rolling.
        GroundFlank = "ground_flank",
        /// A gear's flank, honed: both ways alike.
        HonedFlank = "honed_flank",
        /// A gear's flank, finished in a vibrating bowl: no lay.
        SuperfinishedFlank = "superfinished_flank",
        /// A bearing's raceway, ground and honed: the lay lies along the rolling.
        Raceway = "raceway",
    }
}

/// The key that names it.
static FINISH: Key = key(
    "finish",
    "",
    Kind::Choice(Finish::KEYS),
    Need::Optional("the numbers are given"),
    "a made surface by how it was finished, in place of kind, rq_m and correlation lengths; any of its numbers beside it counts",
);

const BODIES: [&str; 2] = ["body_1.surface", "body_2.surface"];

/// Rq, correlation lengths along and across the rolling, all in m, and where the height comes from.
type Finished = (f64, [f64; 2], &'static str);

impl Finish {
    #[rustfmt::skip]
    fn finished(self) -> Finished {
        match self {
            Self::GroundFlank => (5e-7, [1.5e-5, 1.5e-4], "Ra 0.4 um, Gaussian (Britton, Elcoate, Alanou, Evans & Snidle 2000)"),
            Self::HonedFlank => (3.3e-7, [2e-5, 2e-5], "the middle of 6 to 20 microinches rms (GearCalc manual, 14.12)"),
            Self::SuperfinishedFlank => (6.3e-8, [4e-5, 4e-5], "Ra 0.05 um, Gaussian (Britton, Elcoate, Alanou, Evans & Snidle 2000)"),
            Self::Raceway => (1.4e-7, [1.5e-4, 1.5e-5], "Ra 0.10, Rq 0.14 um, ground and honed (Doll & Kotzalas)"),
        }
    }
}

/// The key of both bodies in full.
pub(super) fn finish_keys() -> impl Iterator<Item = (String, &'static Key)> {
    BODIES
        .iter()
        .map(|body| (joined(body, FINISH.name), &FINISH))
}

/// Puts a made surface in the place of its finish, and says so in `said`. In a line contact, which is the same at every y, its
/// ridges do not end.
///
/// # Errors
/// [`SceneError::Value`] of a word that is none, beside another kind of surface, or whose lay a line contact does not have.
pub(super) fn translate(scene: &mut Table, said: &mut String) -> Result<(), SceneError> {
    let kind = at(scene, "contact").and_then(|contact| contact.get("kind"));
    let is_line = kind.and_then(Value::as_str) == Some("line");
    for body in BODIES {
        let Some(surface) = at(scene, body) else {
            continue;
        };
        let Some(word) = surface.remove(FINISH.name) else {
            continue;
        };
        let refused =
            |allowed: String| SceneError::value(format!("{body}.finish"), word.clone(), allowed);
        let Some(finish) = word.as_str().and_then(Finish::from_key) else {
            return Err(refused(FINISH.allowed()));
        };
        if surface
            .get("kind")
            .is_some_and(|kind| kind.as_str() != Some("random"))
        {
            return Err(refused(format!("either this or {body}.kind")));
        }
        let (rq_m, [along, across], source) = finish.finished();
        let kind = || Value::String("random".to_owned());
        surface.entry("kind").or_insert_with(kind);
        if is_line && along > across && !surface.contains_key("correlation_y_m") {
            let allowed = "of a line contact a finish whose lay does not lie along the rolling";
            return Err(refused(allowed.to_owned()));
        }
        let assumed = "assumed: vary it";
        let (across, why_across) = if is_line {
            (f64::INFINITY, "a line contact is the same at every y")
        } else {
            (across, assumed)
        };
        for (name, value, why) in [
            ("rq_m", rq_m, source),
            ("correlation_x_m", along, assumed),
            ("correlation_y_m", across, why_across),
        ] {
            let is_given =
                surface.contains_key(name) || name == "rq_m" && surface.contains_key("ra_m");
            if !is_given {
                surface.insert(name.to_owned(), Value::Float(value));
                let key = finish.key();
                let _ = writeln!(
                    said,
                    "{body}.{name} = {value:e} from finish = {key}: {why}."
                );
            }
        }
    }
    Ok(())
}

#[cfg(test)]
#[expect(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::super::{Scene, Surface};
    use super::*;

    fn with(sets: &[String]) -> Result<Scene, String> {
        let sets: Vec<_> = sets.iter().map(|text| text.parse().unwrap()).collect();
        Scene::load_with("twin_disc", &sets).map_err(|error| error.to_string())
    }

    #[test]
    fn every_finish_makes_a_surface_and_says_what_is_assumed() {
        for finish in Finish::ALL {
            let word = format!("body_1.surface.finish={}", finish.key());
            let coarse = "body_1.surface.cutoff_short_m=1e-4".to_owned();
            let scene = with(&[word.clone(), coarse.clone()]).unwrap();
            let Surface::Random(made) = &scene.body_1.surface else {
                panic!("{:?}", scene.body_1.surface);
            };
            assert_eq!(made.rq_m, finish.finished().0);
            assert!(
                finish != Finish::GroundFlank
                    || scene
                        .about
                        .contains("correlation_x_m = 1.5e-5 from finish = ground_flank: assumed"),
                "{}",
                scene.about
            );
            assert_eq!(Scene::from_toml(&scene.to_toml()).unwrap(), scene);
            // What is said beside it counts.
            let own = with(&[word, coarse, "body_1.surface.rq_m=1e-7".to_owned()]).unwrap();
            let Surface::Random(made) = &own.body_1.surface else {
                panic!()
            };
            assert_eq!(made.rq_m, 1e-7);
            assert!(!own.about.contains("surface.rq_m = "), "{}", own.about);
        }
        let line = |word: &str| {
            let sets = [
                format!("body_1.surface.finish={word}"),
                "body_1.surface.cutoff_short_m=6e-5".to_owned(),
            ];
            let sets = sets.map(|set| set.parse().unwrap());
            Scene::load_with("fzg_point_b", &sets).map_err(|error| error.to_string())
        };
        for word in ["ground_flank", "honed_flank", "superfinished_flank"] {
            let scene = line(word).unwrap();
            let Surface::Random(made) = &scene.body_1.surface else {
                panic!()
            };
            assert_eq!(made.correlation_m()[1], f64::INFINITY, "{word}");
            assert!(
                scene.about.contains("the same at every y"),
                "{}",
                scene.about
            );
        }
        let refusal = line("raceway").unwrap_err();
        assert!(
            refusal.contains("finish") && refusal.contains("lay"),
            "{refusal}"
        );
        let refusal = with(&["body_1.surface.finish=polished".to_owned()]).unwrap_err();
        assert!(refusal.contains("ground_flank"), "{refusal}");
    }
}
