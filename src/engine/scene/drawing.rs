//! Keys in the units of drawings, and the keys of a scene that they become when it is read.
//!
//! ```text
//! 1/R = 1/R_1 + 1/R_2                       radii of both bodies, concave ones below 0, flat where left out (Hertz 1881)
//! U = (U_1 + U_2)/2,  S = (U_2 − U_1)/U     surface speeds; U_i = 2π n_i R_i of a body that turns about its own centre
//! A = √2 Rq = (π/2) Ra = Rz/2               a wave along one direction; A = 2 Sq = (π²/4) Sa of a product of two (ISO 4287, 25178)
//! Rq = √(π/2) Ra                            a made surface: heights after Gauss
//! ```
//! What was converted is added to the scene's `about`, which every output shows.

use std::f64::consts::PI;
use std::fmt::Write as _;

use toml::{Table, Value};

use super::error::SceneError;
use super::key::{Key, Kind, Need, key};
use super::keys::{joined, short};
use crate::math::number::sig;

/// Keys of one table that stand for others of it.
struct Drawn {
    table: &'static str,
    keys: &'static [Key],
    /// What they become.
    becomes: &'static [&'static str],
}

const ROUND: Kind = Kind::EitherSign(1e-6, 1e6);
const TURNS: Kind = Kind::Number(-1e6, 1e6);
const ROUGH: Kind = Kind::Number(0.0, 1e-4);
const FLAT: Need = Need::Optional("flat");
const OTHERS: Need = Need::Optional("the scene's own keys");

#[rustfmt::skip]
const DRAWN: [Drawn; 5] = [
    Drawn { table: "contact", becomes: &["rx_m"], keys: &[
        key("radius_1_m", "m", ROUND, FLAT, "radius of body 1 along x, below 0 where it is concave; with radius_2_m in place of rx_m"),
        key("radius_2_m", "m", ROUND, FLAT, "radius of body 2 along x"),
    ] },
    Drawn { table: "contact", becomes: &["ry_m"], keys: &[
        key("radius_1_y_m", "m", ROUND, FLAT, "radius of body 1 across, in place of ry_m"),
        key("radius_2_y_m", "m", ROUND, FLAT, "radius of body 2 across"),
    ] },
    Drawn { table: "motion", becomes: &["entrainment_m_s", "slide_roll"], keys: &[
        key("speed_1_m_s", "m/s", Kind::Number(-400.0, 400.0), OTHERS, "speed of body 1's surface, with speed_2_m_s in place of entrainment_m_s and slide_roll"),
        key("speed_2_m_s", "m/s", Kind::Number(-400.0, 400.0), OTHERS, "speed of body 2's surface"),
        key("speed_1_rpm", "1/min", TURNS, OTHERS, "turns of body 1 about its centre, with contact.radius_1_m; in place of speed_1_m_s"),
        key("speed_2_rpm", "1/min", TURNS, OTHERS, "turns of body 2 about its centre, with contact.radius_2_m"),
    ] },
    Drawn { table: "body_1.surface", becomes: &["amplitude_m", "rq_m"], keys: ROUGHNESS },
    Drawn { table: "body_2.surface", becomes: &["amplitude_m", "rq_m"], keys: ROUGHNESS },
];
#[rustfmt::skip]
const ROUGHNESS: &[Key] = &[
    key("ra_m", "m", ROUGH, OTHERS, "mean height Ra of a sinusoid or a made surface, in place of amplitude_m or rq_m; a sinusoid takes rq_m too"),
    key("rz_m", "m", ROUGH, OTHERS, "height Rz of a sinusoid from valley to peak, in place of amplitude_m"),
];

/// The key with that full path.
pub(super) fn find(path: &str) -> Option<&'static Key> {
    let mut all = drawn_keys();
    all.find_map(|(own, key)| (own == path).then_some(key))
}

/// Every such key in full, with its own words.
pub(super) fn drawn_keys() -> impl Iterator<Item = (String, &'static Key)> {
    let of = |drawn: &'static Drawn| {
        drawn
            .keys
            .iter()
            .map(|key| (joined(drawn.table, key.name), key))
    };
    DRAWN
        .iter()
        .flat_map(of)
        .chain(super::finish::finish_keys())
}

/// Takes out of a table what the key that is set on top of it stands for, or is stood for by: the last word counts.
pub(super) fn make_room(table: &mut Table, path: &str, name: &str) {
    let is_drawn = |drawn: &Drawn, name: &str| drawn.keys.iter().any(|own| own.name == name);
    for drawn in DRAWN.iter().filter(|drawn| drawn.table == path) {
        if !is_drawn(drawn, name) && !drawn.becomes.contains(&name) {
            continue;
        }
        let speed = name.rsplit_once("_rpm").or(name.rsplit_once("_m_s"));
        let twin = |key: &str| speed.is_some_and(|(body, _)| key.starts_with(body));
        table.retain(|key, _| {
            let stands_for = is_drawn(drawn, name) && drawn.becomes.contains(&key);
            let is_stood_for = drawn.becomes.contains(&name) && is_drawn(drawn, key);
            let is_height =
                path.ends_with("surface") && (is_drawn(drawn, key) || drawn.becomes.contains(&key));
            !(stands_for || is_stood_for || is_height || is_drawn(drawn, key) && twin(key))
        });
    }
}

/// Puts the keys of the scene in the place of those of drawings.
///
/// # Errors
/// [`SceneError::Value`] of a value out of its range, beside one of the keys that it stands for, or without what it needs.
pub(super) fn translate(scene: &mut Table) -> Result<(), SceneError> {
    let mut said = String::new();
    super::finish::translate(scene, &mut said)?;
    // Speeds in turns need the radii.
    let radii = [1, 2].map(|body| number(scene, "contact", &format!("radius_{body}_m")));
    for drawn in &DRAWN {
        let mut given = Vec::new();
        for key in drawn.keys {
            if let Some(value) = take(scene, drawn.table, key)? {
                given.push((key.name, value));
            }
        }
        if is_sinusoid(scene, drawn.table)
            && let Some(value) =
                number(scene, drawn.table, "rq_m").filter(|rq_m| ROUGH.takes(*rq_m))
        {
            at(scene, drawn.table).map(|table| table.remove("rq_m"));
            given.push(("rq_m", value));
        }
        let Some((first, value)) = given.first().copied() else {
            continue;
        };
        let table = at(scene, drawn.table);
        if let Some(other) =
            table.and_then(|table| drawn.becomes.iter().find(|name| table.contains_key(**name)))
        {
            return Err(refused(
                drawn.table,
                first,
                value,
                &format!("either this or {}", joined(drawn.table, other)),
            ));
        }
        let found = match drawn.becomes {
            ["entrainment_m_s", ..] => speeds(&given, radii)?,
            ["amplitude_m", ..] => heights(scene, drawn.table, &given)?,
            becomes => vec![(becomes[0], radius(drawn.table, &given)?)],
        };
        let given: Vec<String> = given
            .iter()
            .map(|(name, value)| format!("{name} = {}", short(*value)))
            .collect();
        for (name, value) in found {
            let full = joined(drawn.table, name);
            unsay(scene, &full);
            let _ = writeln!(
                said,
                "{full} = {} from {}.",
                rounded(value),
                given.join(", ")
            );
            if let Some(table) = at(scene, drawn.table) {
                table.insert(name.to_owned(), Value::Float(value));
            }
        }
    }
    if !said.is_empty() {
        let about = scene
            .get("about")
            .and_then(Value::as_str)
            .unwrap_or_default();
        scene.insert(
            "about".to_owned(),
            Value::String(format!("{about}\n{said}").trim().to_owned()),
        );
    }
    Ok(())
}

/// Takes out of `about` what was converted into that key before: it is said anew, or no longer true.
pub(super) fn unsay(scene: &mut Table, full: &str) {
    if let Some(Value::String(about)) = scene.get_mut("about") {
        let begins = format!("{full} = ");
        let kept = |line: &&str| !(line.starts_with(&begins) && line.contains(" from "));
        if !about.lines().all(|line| kept(&line)) {
            *about = about.lines().filter(kept).collect::<Vec<_>>().join("\n");
        }
    }
}

/// The table at a path.
pub(super) fn at<'a>(scene: &'a mut Table, path: &str) -> Option<&'a mut Table> {
    path.split('.')
        .try_fold(scene, |table, name| table.get_mut(name)?.as_table_mut())
}

fn kind_of(scene: &mut Table, path: &str) -> Option<String> {
    Some(at(scene, path)?.get("kind")?.as_str()?.to_owned())
}

fn is_sinusoid(scene: &mut Table, path: &str) -> bool {
    kind_of(scene, path).as_deref() == Some("sinusoid")
}

fn number(scene: &mut Table, table: &str, name: &str) -> Option<f64> {
    let value = at(scene, table)?.get(name)?;
    value
        .as_float()
        .or_else(|| value.as_integer().map(|whole| whole as f64))
}

/// The value of a key, which leaves the table.
fn take(scene: &mut Table, table: &str, key: &Key) -> Result<Option<f64>, SceneError> {
    let value = number(scene, table, key.name);
    let Some(found) = at(scene, table).and_then(|table| table.remove(key.name)) else {
        return Ok(None);
    };
    match value.filter(|value| key.kind.takes(*value)) {
        Some(value) => Ok(Some(value)),
        None => Err(SceneError::value(
            joined(table, key.name),
            found,
            key.allowed(),
        )),
    }
}

/// To six figures.
fn rounded(value: f64) -> String {
    sig(value, 6).parse().map_or_else(|_| sig(value, 6), short)
}

fn refused(table: &str, name: &str, value: f64, allowed: &str) -> SceneError {
    SceneError::value(joined(table, name), short(value), allowed)
}

/// 1/R = 1/R_1 + 1/R_2.
fn radius(table: &str, given: &[(&str, f64)]) -> Result<f64, SceneError> {
    let curvature: f64 = given.iter().map(|(_, radius_m)| 1.0 / radius_m).sum();
    if curvature > 0.0 {
        return Ok(1.0 / curvature);
    }
    let (name, value) = given[0];
    let allowed = "radii whose sum of curvatures is above 0: a body fits into a hollow only if it is the rounder";
    Err(refused(table, name, value, allowed))
}

/// U and S of both surface speeds.
fn speeds(
    given: &[(&str, f64)],
    radii: [Option<f64>; 2],
) -> Result<Vec<(&'static str, f64)>, SceneError> {
    let mut speeds_m_s = [None; 2];
    for &(name, value) in given {
        let body = usize::from(name.starts_with("speed_2"));
        let speed_m_s = if name.ends_with("rpm") {
            let Some(radius_m) = radii[body] else {
                let allowed = format!(
                    "with contact.radius_{}_m, about whose centre the body turns",
                    body + 1
                );
                return Err(refused("motion", name, value, &allowed));
            };
            2.0 * PI * value / 60.0 * radius_m.abs()
        } else {
            value
        };
        if speeds_m_s[body].replace(speed_m_s).is_some() {
            return Err(refused(
                "motion",
                name,
                value,
                "either a speed in m/s or in turns",
            ));
        }
    }
    let [Some(one), Some(two)] = speeds_m_s else {
        let (name, value) = given[0];
        return Err(refused(
            "motion",
            name,
            value,
            "with the speed of the other body",
        ));
    };
    let entrainment_m_s = 0.5 * (one + two);
    if entrainment_m_s == 0.0 {
        let (name, value) = given[0];
        return Err(refused(
            "motion",
            name,
            value,
            "speeds that do not cancel: U1 = -U2 entrains no oil",
        ));
    }
    Ok(vec![
        ("entrainment_m_s", entrainment_m_s),
        ("slide_roll", (two - one) / entrainment_m_s),
    ])
}

/// Amplitude of a sinusoid, or Rq of a made surface.
fn heights(
    scene: &mut Table,
    path: &str,
    given: &[(&str, f64)],
) -> Result<Vec<(&'static str, f64)>, SceneError> {
    let (name, value) = given[0];
    if let Some((other, value)) = given.get(1) {
        return Err(refused(
            path,
            other,
            *value,
            &format!("either this or {}", joined(path, name)),
        ));
    }
    let runs =
        |scene: &mut Table, wave: &str| number(scene, path, wave).is_some_and(f64::is_finite);
    let is_product = runs(scene, "wavelength_x_m") && runs(scene, "wavelength_y_m");
    let kind = kind_of(scene, path);
    match (kind.as_deref(), name) {
        (Some("sinusoid"), "rz_m") => Ok(vec![("amplitude_m", 0.5 * value)]),
        (Some("sinusoid"), "rq_m") if is_product => Ok(vec![("amplitude_m", 2.0 * value)]),
        (Some("sinusoid"), "rq_m") => Ok(vec![("amplitude_m", 2.0_f64.sqrt() * value)]),
        (Some("sinusoid"), _) if is_product => Ok(vec![("amplitude_m", PI * PI / 4.0 * value)]),
        (Some("sinusoid"), _) => Ok(vec![("amplitude_m", PI / 2.0 * value)]),
        (Some("random"), "ra_m") => Ok(vec![("rq_m", (PI / 2.0).sqrt() * value)]),
        (_, "rz_m") => Err(refused(
            path,
            name,
            value,
            "only of a sinusoid, whose peaks are all alike",
        )),
        _ => Err(refused(
            path,
            name,
            value,
            "only of a sinusoid or a made (random) surface",
        )),
    }
}

#[cfg(test)]
#[expect(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::super::{Scene, Surface};

    fn with(preset: &str, sets: &[&str]) -> Result<Scene, String> {
        let sets: Vec<_> = sets.iter().map(|text| text.parse().unwrap()).collect();
        Scene::load_with(preset, &sets).map_err(|error| error.to_string())
    }

    /// By hand: 1/0.03 − 1/0.06 = 1/0.06; 600 turns a minute at 30 mm are 1.88496 m/s, 450 at 60 mm 2.82743 m/s.
    #[test]
    fn radii_and_turns_become_equivalent_radius_entrainment_and_slide_roll() {
        let scene = with(
            "twin_disc",
            &[
                "contact.radius_1_m=0.03",
                "contact.radius_2_m=-0.06",
                "motion.speed_1_rpm=600",
                "motion.speed_2_rpm=450",
            ],
        )
        .unwrap();
        assert!((scene.contact.rx_m - 0.06).abs() < 1e-12);
        assert!((scene.motion.entrainment_m_s - 2.356_194).abs() < 1e-6);
        assert!((scene.motion.slide_roll - 0.4).abs() < 1e-12);
        assert!(
            scene
                .about
                .contains("contact.rx_m = 0.06 from radius_1_m = 0.03, radius_2_m = -0.06."),
            "{}",
            scene.about
        );
        // What is written again is the scene's own, and reads back as the same.
        assert_eq!(Scene::from_toml(&scene.to_toml()).unwrap(), scene);
        let in_m_s = with(
            "twin_disc",
            &[
                "motion.speed_1_m_s=1",
                "motion.speed_2_m_s=3",
                "motion.speed_2_m_s=2",
            ],
        )
        .unwrap();
        assert!((in_m_s.motion.slide_roll - 2.0 / 3.0).abs() < 1e-12);
        let flat = with(
            "ball_on_glass",
            &["contact.radius_1_y_m=0.01", "contact.radius_1_m=0.01"],
        )
        .unwrap();
        assert_eq!((flat.contact.rx_m, flat.contact.ry_m), (0.01, Some(0.01)));
    }

    /// Heights of A cos kx: ⟨|z|⟩ = 2A/π, √⟨z²⟩ = A/√2; of a product the squares of both factors; Gaussian heights.
    #[test]
    fn heights_of_drawings_become_amplitude_or_rq() {
        let amplitude = |sets: &[&str]| match with("demonstration", sets).unwrap().body_1.surface {
            Surface::Sinusoid { amplitude_m, .. } => amplitude_m,
            other => panic!("{other:?}"),
        };
        // Numerically: the mean over a wave, and over a cell of a product.
        let n = 400;
        let z = |i: i32| (std::f64::consts::TAU * (f64::from(i) + 0.5) / f64::from(n)).cos();
        let mean = |of: &dyn Fn(f64) -> f64| (0..n).map(|i| of(z(i))).sum::<f64>() / f64::from(n);
        let (ra, rq) = (mean(&f64::abs), mean(&|z| z * z).sqrt());
        let ridges = [
            "body_1.surface.wavelength_y_m=inf",
            "body_1.surface.wavelength_x_m=1e-4",
        ];
        let product = [
            "body_1.surface.wavelength_y_m=1e-4",
            "body_1.surface.wavelength_x_m=1e-4",
        ];
        for (lay, power) in [(ridges, 1), (product, 2)] {
            for (key, share) in [
                ("ra_m", ra.powi(power)),
                ("rq_m", rq.powi(power)),
                ("rz_m", 2.0),
            ] {
                let set = format!("body_1.surface.{key}=1e-7");
                let found = amplitude(&[lay[0], lay[1], &set]);
                assert!(
                    (found * share / 1e-7 - 1.0).abs() < 1e-4,
                    "{key} {power}: {found}"
                );
            }
        }
        let made = with("random_rollers", &["body_1.surface.ra_m=1e-7"]).unwrap();
        let Surface::Random(made) = made.body_1.surface else {
            panic!()
        };
        assert!((made.rq_m / 1.253_314e-7 - 1.0).abs() < 1e-6);
    }

    #[test]
    fn what_does_not_fit_is_refused_by_name() {
        for (preset, sets, says) in [
            (
                "twin_disc",
                &["contact.radius_1_m=0.03", "contact.radius_2_m=-0.02"][..],
                "contact.radius_1_m = 0.03",
            ),
            (
                "twin_disc",
                &["motion.speed_1_rpm=100", "motion.speed_2_rpm=100"],
                "contact.radius_1_m",
            ),
            (
                "twin_disc",
                &["motion.speed_1_m_s=1"],
                "speed of the other body",
            ),
            (
                "twin_disc",
                &["motion.speed_1_m_s=1", "motion.speed_2_m_s=-1"],
                "entrains no oil",
            ),
            ("twin_disc", &["contact.radius_1_m=0"], "contact.radius_1_m"),
            (
                "ball_on_glass",
                &["body_1.surface.kind=smooth", "body_1.surface.ra_m=1e-7"],
                "body_1.surface.ra_m",
            ),
            (
                "random_rollers",
                &["body_1.surface.rz_m=1e-7"],
                "peaks are all alike",
            ),
        ] {
            let refusal = with(preset, sets).unwrap_err();
            assert!(refusal.contains(says), "{refusal}");
        }
        let both = "[contact]\nkind=\"line\"\nrx_m=0.01\nradius_1_m=0.02\n[motion]\nentrainment_m_s=1.0\n[load]\nhertz_pressure_pa=1e9\n";
        let refusal = Scene::from_toml(both).unwrap_err().to_string();
        assert!(refusal.contains("either this or contact.rx_m"), "{refusal}");
    }
}
