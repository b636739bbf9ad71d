//! A refusal fits what was written: it never shows a range that holds the refused value, and it names the slip.
#![expect(clippy::unwrap_used, reason = "tests")]

use asperity_engine::plan::{Plan, PlanError};
use asperity_engine::scene::keys::{self, Key, Kind};
use asperity_engine::scene::{Override, Scene, SceneError, presets};
use proptest::prelude::*;

/// What is said of the default scene with that setting: of the scene, or else of its plan; `None`: nothing.
fn refused(settings: &[&str]) -> Option<[String; 3]> {
    let overrides: Result<Vec<Override>, _> = settings.iter().map(|text| text.parse()).collect();
    match Scene::load_with(presets::DEFAULT, &overrides.unwrap()) {
        Err(SceneError::Value {
            key,
            value,
            allowed,
        }) => Some([key, value, allowed]),
        Err(other) => panic!("{settings:?}: {other}"),
        Ok(scene) => match Plan::new(&scene) {
            Ok(_) => None,
            Err(PlanError::Refused {
                key,
                value,
                allowed,
            }) => Some([key, value, allowed]),
        },
    }
}

/// The ranges and lists in a text that hold a number.
fn holds(text: &str, number: f64) -> bool {
    let read = |word: &str| {
        let end = |c: char| !(c.is_ascii_alphanumeric());
        word.trim_end_matches(end).parse::<f64>()
    };
    let words: Vec<&str> = text.split(' ').collect();
    let in_range = words
        .windows(3)
        .any(|three| match (read(three[0]), read(three[2])) {
            (Ok(low), Ok(high)) => three[1] == "to" && (low..=high).contains(&number),
            _ => false,
        });
    // Of the value itself, and not of what comes of it.
    let bound = |name: &str, passed: fn(f64, f64) -> bool| {
        let rest = text.strip_prefix(name).map(str::trim_start);
        let first = rest.and_then(|rest| rest.split(' ').next());
        first.is_some_and(|word| read(word).is_ok_and(|bound| passed(number, bound)))
    };
    let list = text.split_once("one of ").map_or("", |(_, list)| list);
    let in_list = list.split(", ").any(|one| one.parse() == Ok(number));
    in_range
        || in_list
        || bound("at least", |number, least| number >= least)
        || bound("at most", |number, most| number <= most)
}

#[test]
fn the_words_fit_what_was_written() {
    for (setting, key, value, words) in [
        // A unit, a comma, quotes, a point, spaces, a list.
        (
            "load.force_n=\"800 N\"",
            "load.force_n",
            "\"800 N\"",
            "a number, without a unit, in N: 800",
        ),
        (
            "load.force_n=0.8 kN",
            "load.force_n",
            "\"0.8 kN\"",
            "a number, without a unit, in N",
        ),
        (
            "body_1.young_pa=210 GPa",
            "body_1.young_pa",
            "\"210 GPa\"",
            "a number, without a unit, in Pa; 1e6 to 1e13 Pa",
        ),
        (
            "contact.rx_m=19.05mm",
            "contact.rx_m",
            "\"19.05mm\"",
            "a number, without a unit, in m",
        ),
        (
            "load.force_n=1,5",
            "load.force_n",
            "\"1,5\"",
            "a number, with a point and not a comma, in N: 1.5",
        ),
        (
            "motion.slide_roll=0,5",
            "motion.slide_roll",
            "\"0,5\"",
            "a number, with a point and not a comma: 0.5",
        ),
        (
            "load.force_n=1,500",
            "load.force_n",
            "\"1,500\"",
            "a number, with a point and without marks of thousands, in N",
        ),
        (
            "load.force_n=1.234,5",
            "load.force_n",
            "\"1.234,5\"",
            "without marks of thousands",
        ),
        (
            "load.force_n=1 000",
            "load.force_n",
            "\"1 000\"",
            "a number, without spaces in it, in N",
        ),
        (
            "load.force_n=\"800\"",
            "load.force_n",
            "\"800\"",
            "a number, without quotes, in N: 800",
        ),
        (
            "load.force_n=fast",
            "load.force_n",
            "\"fast\"",
            "a number, 1e-6 to 1e8 N",
        ),
        (
            "load.force_n=[800]",
            "load.force_n",
            "a list",
            "a number, 1e-6 to 1e8 N",
        ),
        (
            "load.force_n=true",
            "load.force_n",
            "true",
            "a number, 1e-6 to 1e8 N",
        ),
        ("title=5", "title", "5", "of writing, in quotes"),
        // Whole numbers.
        (
            "grid.nodes=65.0",
            "grid.nodes",
            "65.0",
            "a whole number, written without a point: 65",
        ),
        (
            "grid.nodes=66.0",
            "grid.nodes",
            "66.0",
            "one of 33, 65, 129, 257, 513, 1025",
        ),
        (
            "grid.nodes=\"65\"",
            "grid.nodes",
            "\"65\"",
            "a whole number, without quotes: 65",
        ),
        (
            "stress.depths=24.5",
            "stress.depths",
            "24.5",
            "a whole number, without a fraction",
        ),
        (
            "stress.depths=1e3",
            "stress.depths",
            "1000.0",
            "a whole number, 8 to 256",
        ),
        (
            "stress.depths=24,5",
            "stress.depths",
            "\"24,5\"",
            "a whole number, without a comma",
        ),
        // Another unit.
        (
            "body_1.young_pa=210",
            "body_1.young_pa",
            "210",
            "1e6 to 1e13 Pa; did you mean 2.1e11?",
        ),
        (
            "body_1.young_pa=2.1e5",
            "body_1.young_pa",
            "2.1e5",
            "did you mean 2.1e11?",
        ),
        (
            "load.hertz_pressure_pa=1.2",
            "load.hertz_pressure_pa",
            "1.2",
            "did you mean 1.2e9?",
        ),
        (
            "contact.rx_m=200",
            "contact.rx_m",
            "200",
            "did you mean 0.2?",
        ),
        (
            "body_1.surface.amplitude_m=0.2",
            "body_1.surface.amplitude_m",
            "0.2",
            "0 to 1e-4 m; did you mean 2e-7?",
        ),
        (
            "lubricant.pressure_viscosity_per_pa=20",
            "lubricant.pressure_viscosity_per_pa",
            "20",
            "0 to 1e-7 1/Pa",
        ),
    ] {
        let [named, shown, allowed] = refused(&[setting]).unwrap();
        assert_eq!((&*named, &*shown), (key, value), "{setting}");
        assert!(allowed.contains(words), "{setting}: {allowed}");
    }
    // Nobody reads three hundred digits.
    let long = format!("load.force_n=1{}", "0".repeat(300));
    let [_, shown, allowed] = refused(&[&long]).unwrap();
    assert_eq!(shown, "1e300");
    assert!(allowed.contains("1e-6 to 1e8 N"), "{allowed}");
}

#[test]
fn a_key_that_is_far_from_what_is_usual_is_named_beside_the_one_that_suffers() {
    for (setting, words) in [
        // Millimetres: all waves are too short for so large a contact.
        (
            "contact.rx_m=19.05",
            "contact.rx_m = 19.05 m is far from what is usual, 0.001 to 0.5 m; did you mean 0.01905 m?",
        ),
        ("contact.ry_m=20", "contact.ry_m = 20 m is far"),
        (
            "load.force_n=8e5",
            "load.force_n = 8e5 N is far from what is usual, 0.01 to 1e5 N; did you mean 800 N?",
        ),
        (
            "body_1.surface.amplitude_m=2e-5",
            "amplitude_m = 2e-5 m is far",
        ),
    ] {
        let [key, value, allowed] = refused(&[setting]).unwrap();
        assert!(allowed.contains(words), "{key} = {value}: {allowed}");
    }
    // Without one there is nothing to say.
    let [_, _, allowed] = refused(&["body_1.surface.wavelength_x_m=2e-5"]).unwrap();
    assert!(!allowed.contains("usual"), "{allowed}");
}

#[test]
fn a_file_with_a_comma_or_a_unit_is_told_so() {
    let scene = Scene::load(presets::DEFAULT).unwrap().to_toml();
    for (line, words) in [
        ("slide_roll = 0,5", "a point, not a comma: 0.5 (slide_roll)"),
        ("slide_roll = 1,500", "a point, not a comma (slide_roll)"),
        ("slide_roll = 0.5 m", "without a unit: 0.5 (slide_roll)"),
        (
            "slide_roll = 2mm # millimetres",
            "without a unit: 2 (slide_roll)",
        ),
    ] {
        let own = scene
            .lines()
            .find(|line| line.starts_with("slide_roll"))
            .unwrap();
        let error = Scene::from_toml(&scene.replacen(own, line, 1)).unwrap_err();
        let told = error.to_string();
        assert!(told.contains(words), "{line}: {told}");
    }
    let error = Scene::from_toml("title = [").unwrap_err().to_string();
    assert!(!error.contains("a number is"), "{error}");
}

/// A bound that is printed rounded must not let in what it refuses.
#[test]
fn what_has_just_passed_a_bound_is_printed_beyond_it() {
    let most = |key: &str, low: f64, high: f64| {
        let fits = |value: f64| {
            let setting = format!("{key}={value:e}");
            refused(&[&setting]).is_none()
        };
        assert!(fits(low) && !fits(high), "{key}");
        let (mut low, mut high) = (low, high);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if fits(middle) {
                low = middle;
            } else {
                high = middle;
            }
        }
        high
    };
    for (key, low, high) in [
        ("load.force_n", 800.0, 1e7),
        ("body_2.surface.amplitude_m", 1e-7, 1e-4),
        ("body_1.surface.wavelength_x_m", 2e-4, 1e-5),
        ("contact.rx_m", 0.02, 19.0),
    ] {
        let edge = most(key, low, high);
        for beyond in [1.0, 1.0 + 1e-12, 1.0 + 1e-7, 1.0 + 1e-4] {
            let value = if high > low {
                edge * beyond
            } else {
                edge / beyond
            };
            let setting = format!("{key}={value:e}");
            let [named, shown, allowed] = refused(&[&setting]).unwrap();
            let number = shown.split(' ').next().unwrap().parse().unwrap();
            assert!(!holds(&allowed, number), "{named} = {shown}: {allowed}");
            // What it is beside its bound.
            for (one, bound) in [("makes ", 10.0), ("this one is ", 0.5)] {
                if let Some((_, rest)) = allowed.split_once(one) {
                    let is: f64 = rest.split([' ', ',', ';']).next().unwrap().parse().unwrap();
                    assert!(is > bound, "{named} = {shown}: {allowed}");
                }
            }
            if let Some((_, rest)) = allowed.split_once("now ") {
                let nodes: f64 = rest.split(' ').next().unwrap().parse().unwrap();
                assert!(nodes < 4.0, "{allowed}");
            }
        }
    }
}

/// Something that a key does not take, and the number in it.
fn wrong(key: &Key, kind: usize, share: f64) -> Option<(String, f64)> {
    let between = |min: f64, max: f64| min + share * (max - min);
    let (min, max, inside) = match key.kind {
        Kind::Number(min, max) | Kind::NumberOrInf(min, max) => (min, max, between(min, max)),
        Kind::EitherSign(min, max) => (-max, max, between(min, max)),
        Kind::Integer(min, max) => (
            min as f64,
            max as f64,
            between(min as f64, max as f64).round(),
        ),
        Kind::IntegerOf(all) => {
            let one = all[(share * (all.len() - 1) as f64) as usize] as f64;
            (all[0] as f64, all[all.len() - 1] as f64, one)
        }
        Kind::Text(_) | Kind::Line(_) | Kind::Choice(_) | Kind::Switch => return None,
    };
    let is_whole = matches!(key.kind, Kind::Integer(..) | Kind::IntegerOf(_));
    let beyond = |size: f64| if is_whole { (size + 2.0).floor() } else { size };
    match kind {
        // Out of its range.
        0 => Some(max + beyond((1.0 + share) * max.abs().max(1e-9))).map(|x| (format!("{x:?}"), x)),
        1 => Some(min - beyond((1.0 + share) * min.abs().max(1e-9))).map(|x| (format!("{x:?}"), x)),
        2 if !is_whole => Some((format!("{:e}", max.next_up()), max.next_up())),
        // With a unit, with quotes, with a comma.
        3 => Some((
            format!(
                "\"{inside} {}\"",
                if key.unit.is_empty() { "x" } else { key.unit }
            ),
            inside,
        )),
        4 => Some((format!("\"{inside} kN\""), inside)),
        5 => Some((format!("\"{inside}\""), inside)),
        6 => {
            let text = format!("{inside:.4}").replace('.', ",");
            let number = text.replace(',', ".").parse().unwrap();
            Some((text, number))
        }
        // A whole number with a point, and between two of them.
        7 if is_whole => Some((format!("{inside:?}"), inside)),
        8 if is_whole => Some((format!("{:?}", inside + 0.5), inside + 0.5)),
        _ => None,
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn no_refusal_shows_a_range_that_holds_the_refused_value(share in 0.0..1.0_f64) {
        for path in keys::all_paths() {
            let key = keys::find(&path).unwrap();
            for kind in 0..9 {
                let Some((text, number)) = wrong(key, kind, share) else {
                    continue;
                };
                let setting = format!("{path}={text}");
                let [named, shown, allowed] = refused(&[&setting]).unwrap();
                prop_assert_eq!(&named, &path, "{}", setting);
                prop_assert!(!holds(&allowed, number), "{named} = {shown}: {allowed}");
                let word = match kind {
                    3 | 4 => "without a unit",
                    5 => "without quotes",
                    6 => "comma",
                    7 => "without a point",
                    _ => "",
                };
                prop_assert!(allowed.contains(word), "{named} = {shown}: {allowed}");
            }
        }
    }
}

/// Every number of every preset, a thousand times as large or as small: taken, or refused in words that hold true.
#[test]
fn wrong_by_a_thousand_is_taken_or_told() {
    let mut told = 0;
    for preset in presets::all() {
        let scene = Scene::load(preset.name).unwrap();
        let table: toml::Table = scene.to_toml().parse().unwrap();
        for path in keys::all_paths() {
            let at = |table: &toml::Value, name: &str| table.get(name).cloned();
            let value = path
                .split('.')
                .try_fold(toml::Value::Table(table.clone()), |table, name| {
                    at(&table, name)
                });
            let Some(value) = value.and_then(|value| value.as_float()) else {
                continue;
            };
            for number in [value * 1e3, value / 1e3] {
                let setting = Override::number(&path, number).unwrap();
                let scene = Scene::load_with(preset.name, &[setting]);
                let (key, allowed) = match scene.map(|scene| Plan::new(&scene)) {
                    Ok(Ok(_)) => continue,
                    Ok(Err(PlanError::Refused { key, allowed, .. }))
                    | Err(SceneError::Value { key, allowed, .. }) => (key, allowed),
                    Err(other) => panic!("{path} = {number}: {other}"),
                };
                told += 1;
                assert!(
                    key != path || !holds(&allowed, number),
                    "{}: {path} = {number}: {allowed}",
                    preset.name
                );
                // What was typed is named where it is not what is refused, if it is a length, a pressure, a load.
                let is_far = allowed.contains(&format!("{path} = "));
                let suffers = key.contains("wavelength") && path.contains("contact.r");
                assert!(
                    key == path || is_far || !suffers,
                    "{path} = {number}: {key}: {allowed}"
                );
            }
        }
    }
    assert!(told > 100, "{told}");
}
