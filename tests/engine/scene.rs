//! Scenes: presets, round trips, overrides and everything that must be refused.
#![expect(clippy::unwrap_used, reason = "tests")]

use asperity_engine::scene::{ErrorSource, Override, Scene, SceneError, Surface, keys, presets};
use proptest::prelude::*;

fn load(name: &str, settings: &[&str]) -> Result<Scene, SceneError> {
    let overrides: Result<Vec<Override>, _> = settings.iter().map(|text| text.parse()).collect();
    Scene::load_with(name, &overrides?)
}

/// The refusal of the default scene with that setting, as key, value, allowed.
fn refusal(setting: &str) -> (String, String, String) {
    match load(presets::DEFAULT, &[setting]) {
        Err(SceneError::Value {
            key,
            value,
            allowed,
        }) => (key, value, allowed),
        other => panic!("{setting} gave {other:?}"),
    }
}

#[test]
fn every_preset_is_valid_and_survives_printing() {
    for preset in presets::all() {
        let scene = Scene::load(preset.name).unwrap();
        scene.validate().unwrap();
        assert!(!scene.title.is_empty() && !scene.about.is_empty());
        let again = Scene::from_toml(&scene.to_toml()).unwrap();
        assert_eq!(scene, again, "{}", preset.name);
    }
}

#[test]
fn printed_scenes_document_every_key() {
    let text = Scene::load(presets::DEFAULT).unwrap().to_toml();
    for section in keys::SECTIONS {
        for key in section.keys {
            let documented = text
                .lines()
                .any(|line| line.contains(key.doc) && line.contains(&key.allowed()));
            assert!(documented, "{} has no comment", section.path_of(key.name));
        }
    }
}

#[test]
fn presets_have_the_operating_points_they_claim() {
    // Name, p_h in GPa, E' in GPa, S: the table of typical operating points. Three digits are printed.
    for (name, p_h, e_prime, s) in [
        ("ball_bearing", 2.00, 231.0, 0.005),
        ("ball_bearing_worn", 1.50, 231.0, 0.02),
        ("twin_disc", 1.20, 231.0, 0.5),
        ("micropitting_rig", 1.50, 231.0, 0.1),
        ("mtm_ball_on_disc", 1.007, 231.0, 0.5),
        ("ball_on_glass", 0.527, 117.0, 0.0),
        ("demonstration_quick", 1.73, 219.78, 0.5),
    ] {
        let scene = Scene::load(name).unwrap();
        let p_max = scene.hertz().p_max_pa * 1e-9;
        assert!((p_max / p_h - 1.0).abs() < 5e-3, "{name}: {p_max}");
        let modulus = scene.e_prime_pa() * 1e-9;
        assert!((modulus / e_prime - 1.0).abs() < 5e-3, "{name}: {modulus}");
        assert_eq!(scene.motion.slide_roll, s, "{name}");
    }
    // Composite roughness of the table, in micrometres.
    for (name, rq_um) in [
        ("ball_bearing", 0.06),
        ("ball_bearing_worn", 0.15),
        ("twin_disc", 0.4),
        ("micropitting_rig", 0.21),
        ("mtm_ball_on_disc", 0.015),
        ("ball_on_glass", 0.015),
        ("fzg_pitch_point", 0.18),
        ("fzg_point_a", 0.18),
        ("fzg_point_b", 0.18),
        ("fzg_point_e", 0.18),
        ("cam_nose", 0.28),
    ] {
        let rq = Scene::load(name).unwrap().composite_rq_m() * 1e6;
        assert!((rq / rq_um - 1.0).abs() < 5e-3, "{name}: {rq}");
    }
}

/// The rule by which the roughness of a preset is chosen: what its crests press on each other when the oil does not
/// help, elastic half-spaces, crest upon crest (Johnson, Contact Mechanics, 1985, ch. 13).
/// ```text
/// p_a = π E* Σ A_i |k_i|/2π          ripple of pressure that flattens the waves
/// p_max = p_h + p_a  where p_a ≤ p_h,   else  2 √(p_h p_a)
/// ```
/// Below 4 GPa: von Mises stress under a line contact is 0.56 of its greatest pressure, and hardened steel yields at
/// about 2.2 GPa in tension. What runs find is in `tests/life/counts.rs`.
#[test]
fn crests_of_the_presets_are_what_steel_carries() {
    for preset in presets::all() {
        let scene = Scene::load(preset.name).unwrap();
        let slope = |surface: &Surface| match *surface {
            Surface::Sinusoid {
                amplitude_m,
                wavelength_x_m,
                wavelength_y_m,
                ..
            } => amplitude_m * wavelength_x_m.recip().hypot(wavelength_y_m.recip()),
            _ => 0.0,
        };
        let slopes = slope(&scene.body_1.surface) + slope(&scene.body_2.surface);
        let ripple = std::f64::consts::PI * 0.5 * scene.e_prime_pa() * slopes;
        let p_h = scene.hertz().p_max_pa;
        let greatest = if ripple <= p_h {
            p_h + ripple
        } else {
            2.0 * (p_h * ripple).sqrt()
        };
        println!(
            "{:18} p_h {:.3} GPa, ripple {:.3} GPa, crest on crest {:.2} GPa; A/λ {slopes:.5}",
            preset.name,
            1e-9 * p_h,
            1e-9 * ripple,
            1e-9 * greatest
        );
        assert!(greatest < 4.0e9, "{}: {greatest:.2e} Pa", preset.name);
    }
}

#[test]
fn bad_values_are_refused_with_key_value_and_range() {
    for (setting, key, value, allowed) in [
        (
            "contact.rx_m=-0.01",
            "contact.rx_m",
            "-0.01",
            "1e-6 to 100 m",
        ),
        ("contact.rx_m=0", "contact.rx_m", "0", "1e-6 to 100 m"),
        (
            "motion.slide_roll=NaN",
            "motion.slide_roll",
            "\"NaN\"",
            "a number, -2 to 2",
        ),
        (
            "motion.slide_roll=nan",
            "motion.slide_roll",
            "NaN",
            "-2 to 2",
        ),
        (
            "motion.slide_roll=2.1",
            "motion.slide_roll",
            "2.1",
            "-2 to 2",
        ),
        (
            "motion.entrainment_m_s=0",
            "motion.entrainment_m_s",
            "0",
            "1e-6 to 200 m/s, or -200 to -1e-6 m/s; never 0",
        ),
        (
            "motion.entrainment_m_s=inf",
            "motion.entrainment_m_s",
            "inf",
            "1e-6 to 200 m/s, or -200 to -1e-6 m/s; never 0",
        ),
        (
            "load.hertz_pressure_pa=1e11",
            "load.hertz_pressure_pa",
            "1e11",
            "1e6 to 1e10 Pa; did you mean 1e8?",
        ),
        (
            "grid.nodes=128",
            "grid.nodes",
            "128",
            "one of 33, 65, 129, 257, 513, 1025",
        ),
        (
            "grid.nodes=129.0",
            "grid.nodes",
            "129.0",
            "a whole number, written without a point: 129",
        ),
        ("body_1.poisson=0.6", "body_1.poisson", "0.6", "0 to 0.5"),
        (
            "lubricant.rheology=plastic",
            "lubricant.rheology",
            "\"plastic\"",
            "\"newtonian\" or \"eyring\"",
        ),
        (
            "contact.kind=disc",
            "contact.kind",
            "\"disc\"",
            "\"point\" or \"line\"",
        ),
        (
            "body_1.surface.kind=fractal",
            "body_1.surface.kind",
            "\"fractal\"",
            "\"smooth\" or \"sinusoid\" or \"random\" or \"height_map\"",
        ),
        (
            "numerics.max_iterations=0",
            "numerics.max_iterations",
            "0",
            "a whole number, 1 to 1000",
        ),
    ] {
        assert_eq!(
            refusal(setting),
            (key.into(), value.into(), allowed.into()),
            "{setting}"
        );
    }
}

#[test]
fn every_number_key_refuses_what_is_no_number_or_out_of_range() {
    for path in keys::all_paths() {
        let key = keys::find(&path).unwrap();
        let bad: &[&str] = match key.kind {
            keys::Kind::Text(_) => &["1.0"],
            keys::Kind::Line(_) => &[
                "1.0",
                r#""two\nlines""#,
                r#""\u202ereversed""#,
                r#""\u001b[31m""#,
            ],
            keys::Kind::Number(..) => &["nan", "-inf", "inf", "\"x\"", "1e300", "true"],
            keys::Kind::EitherSign(..) => &["nan", "-inf", "inf", "\"x\"", "0.0", "-1e300", "true"],
            keys::Kind::NumberOrInf(..) => &["nan", "-inf", "-1.0", "0.0", "\"x\""],
            keys::Kind::Integer(..) | keys::Kind::IntegerOf(_) => {
                &["1.5", "-1", "9999999999", "nan"]
            }
            keys::Kind::Choice(_) => &["\"nonsense\"", "1.0", "nan"],
            keys::Kind::Switch => &["\"true\"", "1", "nan"],
        };
        for value in bad {
            let error = load(presets::DEFAULT, &[&format!("{path}={value}")]).unwrap_err();
            let SceneError::Value {
                key: named,
                allowed,
                ..
            } = &error
            else {
                panic!("{path}={value}: {error}");
            };
            assert_eq!(named, &path, "{value}");
            // The words around it are those of `refusals`.
            let is_fraction = allowed.contains("without a fraction");
            assert!(allowed.contains(&key.allowed()) || is_fraction, "{allowed}");
        }
    }
}

#[test]
fn rules_between_keys() {
    let message = |settings: &[&str]| load(presets::DEFAULT, settings).unwrap_err().to_string();
    let heavy = message(&["load.force_n=1e7"]);
    assert!(
        heavy.contains("load.force_n") && heavy.contains("10 GPa") && heavy.contains("40.08"),
        "{heavy}"
    );
    let both = Scene::from_toml(
        "[contact]\nkind='point'\nrx_m=0.01\nry_m=0.01\n[motion]\nentrainment_m_s=1\n[load]\nforce_n=1\nhertz_pressure_pa=1e9",
    );
    assert!(both.unwrap_err().to_string().contains("exactly one"));
    let flat = message(&["body_1.surface.wavelength_x_m=inf"]);
    assert!(flat.contains("body_1.surface.wavelength_x_m"), "{flat}");
    let steep = message(&["body_2.surface.amplitude_m=1e-4"]);
    assert!(
        steep.contains("body_2.surface.amplitude_m") && steep.contains("slope"),
        "{steep}"
    );
    let lonely = message(&["stress=none"]);
    assert!(
        lonely.contains("life") && lonely.contains("[stress]"),
        "{lonely}"
    );
    let smooth = load(
        presets::DEFAULT,
        &[
            "body_1.surface.kind=smooth",
            "body_1.surface.amplitude_m=1e-7",
        ],
    );
    assert!(smooth.unwrap_err().to_string().contains("sinusoid"));
}

#[test]
fn unknown_keys_suggest_the_nearest() {
    for (setting, meant) in [
        ("motion.slide_rol=0.5", "motion.slide_roll"),
        ("slide_roll=0.5", "motion.slide_roll"),
        ("load.force=800", "load.force_n"),
        ("lubricant.viscosity_pas=0.1", "lubricant.viscosity_pa_s"),
    ] {
        let error = load(presets::DEFAULT, &[setting]).unwrap_err();
        let SceneError::UnknownKey { nearest, .. } = &error else {
            panic!("{setting}: {error}");
        };
        assert_eq!(nearest.as_deref(), Some(meant), "{setting}");
    }
    let nonsense = load(presets::DEFAULT, &["qqqq.zzzz=1"]).unwrap_err();
    assert!(matches!(
        nonsense,
        SceneError::UnknownKey { nearest: None, .. }
    ));
    let in_file = Scene::from_toml("[contact]\nkind='point'\nrx=0.01").unwrap_err();
    assert!(
        in_file.to_string().contains("did you mean contact.rx_m"),
        "{in_file}"
    );
}

#[test]
fn missing_keys_are_named() {
    let error = Scene::from_toml("[contact]\nkind='point'\nrx_m=0.01").unwrap_err();
    assert_eq!(
        error.to_string(),
        "contact.ry_m is missing; allowed: 1e-6 to 100 m"
    );
    let error = Scene::from_toml("").unwrap_err();
    assert!(
        error.to_string().contains("[contact] is missing"),
        "{error}"
    );
}

#[test]
fn overrides_replace_and_remove() {
    let scene = load(
        presets::DEFAULT,
        &[
            "load.hertz_pressure_pa=1e9",
            "motion.slide_roll=1",
            "life=none",
            "record=none",
            "body_2.surface.kind=smooth",
            "lubricant.viscosity_law=barus",
        ],
    )
    .unwrap();
    assert_eq!(scene.load.force_n, None);
    assert_eq!(scene.load.hertz_pressure_pa, Some(1e9));
    assert_eq!(scene.motion.slide_roll, 1.0);
    assert!(scene.life.is_none() && scene.record.is_none());
    assert_eq!(scene.body_2.surface, Surface::Smooth {});
    let dry = load(presets::DEFAULT, &["lubricant=none"]).unwrap();
    assert!(dry.lubricant.is_none());
    for malformed in ["motion.slide_roll", "=1", "motion.slide_roll=", ""] {
        assert!(
            matches!(
                load(presets::DEFAULT, &[malformed]),
                Err(SceneError::Override { .. })
            ),
            "{malformed}"
        );
    }
}

#[test]
fn events_are_checked_like_keys() {
    let base = Scene::load(presets::DEFAULT).unwrap().to_toml();
    let with = |event: &str| Scene::from_toml(&format!("{base}\n[[event]]\n{event}\n"));
    let scene = with("at_s = 1e-3\nset = { \"motion.slide_roll\" = 1 }\ncaption = 'now'").unwrap();
    assert_eq!(scene.events[0].set["motion.slide_roll"], 1.0);
    assert_eq!(Scene::from_toml(&scene.to_toml()).unwrap(), scene);
    for (event, part) in [
        ("at_s = -1.0", "event[0].at_s = -1"),
        ("caption = 'x'", "event[0].at_s is missing"),
        (
            "at_s = 0.0\nset = { \"motion.slide_roll\" = 3.0 }",
            "-2 to 2",
        ),
        ("at_s = 0.0\nset = { \"grid.nodes\" = 65 }", "a knob"),
        ("at_s = 0.0\nset = { \"load.force_n\" = 1e7 }", "10 GPa"),
        ("at_s = 0.0\nwhen = 1", "event[0].when is not a key"),
    ] {
        let error = with(event).unwrap_err().to_string();
        assert!(error.contains(part), "{event}: {error}");
    }
    let on_smooth = base.replace("kind = \"sinusoid\"", "kind = \"smooth\"");
    assert!(
        Scene::from_toml(&on_smooth).is_err(),
        "waves of a smooth body are refused"
    );
}

#[test]
fn hostile_files_are_refused_quickly() {
    let dir = tempfile::tempdir().unwrap();
    let huge = dir.path().join("huge.toml");
    std::fs::write(&huge, vec![b'#'; (1 << 20) + 1]).unwrap();
    let error = Scene::load(huge.to_str().unwrap()).unwrap_err();
    assert!(error.to_string().contains("1 MiB"), "{error}");
    let binary = dir.path().join("binary.toml");
    std::fs::write(&binary, [0xff, 0xfe, 0x00]).unwrap();
    assert!(Scene::load(binary.to_str().unwrap()).is_err());
    assert!(Scene::load(dir.path().to_str().unwrap()).is_err());
    assert!(matches!(
        Scene::load("no_such_scene.toml"),
        Err(SceneError::Read { .. })
    ));
    let error = Scene::load("demonstratoin").unwrap_err().to_string();
    assert!(error.contains("did you mean demonstration?"), "{error}");
    // Nesting that would overflow the stack of a careless parser.
    let deep = format!("a = {}{}", "[".repeat(200_000), "]".repeat(200_000));
    assert!(Scene::from_toml(&deep).is_err());
    let long_key = format!("{} = 1", "k".repeat(500_000));
    let error = Scene::from_toml(&long_key).unwrap_err().to_string();
    assert!(error.len() < 300, "{} characters", error.len());
}

proptest! {
    /// Whatever passes the check is printed and read back without a change.
    #[test]
    fn valid_scenes_survive_printing(
        s in -2.0..=2.0_f64,
        u in 1e-3..50.0_f64,
        amplitude in 1e-9..1e-6_f64,
        wavelength in 1e-4..1e-2_f64,
        angle in -360.0..=360.0_f64,
        force in 1.0..1000.0_f64,
    ) {
        let mut scene = Scene::load(presets::DEFAULT).unwrap();
        scene.motion.slide_roll = s;
        scene.motion.entrainment_m_s = u;
        scene.load.force_n = Some(force);
        scene.body_1.surface = Surface::Sinusoid {
            amplitude_m: amplitude,
            wavelength_x_m: wavelength,
            wavelength_y_m: f64::INFINITY,
            angle_deg: angle,
            phase_deg: 0.0,
        };
        scene.validate().unwrap();
        prop_assert_eq!(Scene::from_toml(&scene.to_toml()).unwrap(), scene);
    }

    /// No text makes the parser panic.
    #[test]
    fn any_text_is_answered(text in "[\\[\\]a-z_0-9=.\"{}\n,# -]{0,200}") {
        let _ = Scene::from_toml(&text);
        let _ = text.parse::<Override>();
    }
}

/// `none` takes a key out, but where it is one of the key's own words.
#[test]
fn none_is_a_word_of_the_keys_that_know_it() {
    let set = |text: &str| -> Scene {
        let set: Override = text.parse().unwrap();
        Scene::load_with("demonstration_quick", &[set]).unwrap()
    };
    let source = |text: &str| set(text).numerics.error_estimate;
    assert_eq!(source("numerics.tolerance=1e-3"), ErrorSource::Companion);
    for text in [
        "numerics.error_estimate=none",
        "numerics.error_estimate=\"none\"",
    ] {
        assert_eq!(source(text), ErrorSource::None, "{text}");
    }
    assert!(set("time.tolerance=none").time.tolerance.is_none());
    assert!(set("record=none").record.is_none());
}
