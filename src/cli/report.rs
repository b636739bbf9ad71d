//! The summary for people: what came out, with units, and what to mistrust.

mod complaints;
mod life;
mod motion;

use std::fmt::Write as _;

use asperity_engine::math::number::{counted, seconds, sig};
use asperity_engine::scene::{ContactKind, Scene};
use asperity_engine::sim::{CATALOGUE, LubricationRegime, Rhythm, Summary};
use asperity_session::run::{End, Outcome};

pub(crate) use self::complaints::complaints;
use self::life::push_life;

/// The outcome as text. `errors`: the discretisation error in words.
pub(crate) fn text(scene: &Scene, outcome: &Outcome, errors: Option<&str>) -> String {
    let mut text = String::new();
    if !scene.title.is_empty() {
        text.push_str(&scene.title);
        text.push_str("\n\n");
    }
    if let Some(summary) = &outcome.summary {
        line(&mut text, "run", &run_line(outcome));
        push_results(&mut text, scene, summary);
        if let Some(errors) = errors {
            line(&mut text, "discretisation", errors);
        }
    }
    for report in &outcome.reports {
        let skipped = if report.skipped > 0 {
            format!(", {} skipped", report.skipped)
        } else {
            String::new()
        };
        let size = if report.bytes > 0 {
            format!(", {:.1} MB", report.bytes as f64 * 1e-6)
        } else {
            String::new()
        };
        let note = if report.note.is_empty() {
            String::new()
        } else {
            format!("; {}", report.note)
        };
        let what = format!(
            "{} ({}{skipped}{size}{note})",
            report.output,
            counted(report.frames, "frame")
        );
        line(&mut text, "written", &what);
        if let Some(queue) = &report.queue {
            line(&mut text, "", &queue.to_string());
        }
    }
    text
}

fn run_line(outcome: &Outcome) -> String {
    let how = match (&outcome.end, outcome.n_unconverged) {
        (End::Stalled(_), _) => "stalled".to_owned(),
        (End::Stopped, _) if outcome.stopped => stopped(outcome),
        (End::Stopped, 0) => "stopped by the user, converged".to_owned(),
        (_, 0) => "converged".to_owned(),
        (_, n) => format!("{} did not converge", counted(n, "step")),
    };
    let pace = outcome
        .steps_per_s
        .map(|pace| format!(", {pace:.1} steps per second after the start-up"))
        .unwrap_or_default();
    format!(
        "{how}; {} in {:.1} s{pace}",
        counted(outcome.steps, "step"),
        outcome.wall_s
    )
}

/// A run that was stopped, with what it has done of what it was to do.
pub(crate) fn stopped(outcome: &Outcome) -> String {
    let planned = outcome.steps_planned.unwrap_or(outcome.steps);
    let unconverged = match outcome.n_unconverged {
        0 => String::new(),
        n => format!(", {n} of which did not converge"),
    };
    format!(
        "stopped by the user after {} of {planned} steps{unconverged}",
        outcome.steps
    )
}

fn push_results(text: &mut String, scene: &Scene, s: &Summary) {
    let zone = match scene.kind() {
        ContactKind::Point => "Hertz ellipse",
        ContactKind::Line => "Hertz width",
    };
    let contact = format!(
        "a {} µm, Hertz pressure {} GPa, load {}",
        sig(s.a_m * 1e6, 4),
        sig(s.p_hertz_pa * 1e-9, 4),
        load(scene, s.load_n)
    );
    line(text, "contact", &contact);
    line(text, "motion", &motion::text(scene));
    let pressure = format!(
        "greatest {} GPa = {} times Hertz; mean of the steps' greatest {} GPa",
        sig(s.p_max_greatest_pa * 1e-9, 4),
        sig(s.p_max_greatest_pa / s.p_hertz_pa, 3),
        sig(s.p_max_pa * 1e-9, 4)
    );
    line(text, "pressure", &pressure);
    let film = match s.regime {
        // What its solver leaves between dry bodies is rounding, of either sign.
        LubricationRegime::Dry => "none: the contact is dry".to_owned(),
        _ => format!(
            "central {} nm, least {} nm; mean of the steps' least {} nm",
            nm(s.h_central_m),
            nm(s.h_min_least_m),
            nm(s.h_min_m)
        ),
    };
    line(text, "film", &film);
    line(text, "regime", &regime(s, zone));
    line(
        text,
        "friction",
        &format!("coefficient {}", sig(s.friction_coefficient, 3)),
    );
    if s.n_body_1.is_some() || s.n_body_2.is_some() {
        let cycles = format!(
            "per passage of body 1: {}; of body 2: {}",
            cycles(s.n_body_1, s.n_counted_body_1),
            cycles(s.n_body_2, s.n_counted_body_2)
        );
        line(text, "cycles", &cycles);
    }
    if let (Some(stress), Some(depth), Some(x)) = (
        s.sigma_eff_max_pa,
        s.sigma_eff_max_depth_m,
        s.sigma_eff_max_x_m,
    ) {
        let stress = format!(
            "greatest effective stress {} GPa, {} µm deep at x = {} µm",
            sig(stress * 1e-9, 4),
            sig(depth * 1e6, 3),
            sig(x * 1e6, 3)
        );
        line(text, "stress", &stress);
    }
    if let Some(repetition) = repetition(s) {
        line(text, "passage", &repetition);
    }
    push_by_itself(text, scene, s);
    push_life(text, scene, s);
    let (load, mass) = (s.load_error, s.mass_error);
    line(text, "errors", &format!("load {load:.1e}, mass {mass:.1e}"));
    for (k, caution) in s.cautions.iter().enumerate() {
        line(text, if k == 0 { "cautions" } else { "" }, &caution.text);
    }
}

/// Quantities that the catalogue shows by themselves.
fn push_by_itself(text: &mut String, scene: &Scene, s: &Summary) {
    for quantity in CATALOGUE {
        let sums = quantity.over.iter().filter_map(|(over, key)| {
            let value = (*s.by_itself.get(*key)?)?;
            let value = quantity.in_words(value, scene.kind());
            Some(format!("{} of the steps {value}", over.word()))
        });
        let sums: Vec<String> = sums.collect();
        if !sums.is_empty() {
            let what = format!("{}: {}", quantity.meaning, sums.join(", "));
            line(text, quantity.symbol, &what);
        }
    }
}

fn nm(value_m: f64) -> String {
    sig(value_m * 1e9, 3)
}

/// A load with the unit of the scene's kind of contact.
fn load(scene: &Scene, value: f64) -> String {
    let unit = match scene.kind() {
        ContactKind::Point => "N",
        ContactKind::Line => "N/m",
    };
    format!("{} {unit}", sig(value, 4))
}

/// Who carries the load.
fn regime(s: &Summary, zone: &str) -> String {
    let lambda = s.lambda_ratio.map_or_else(String::new, |lambda| {
        let lambda = sig(lambda, 3);
        format!(", λ {lambda} (smooth central film by formula over composite roughness)")
    });
    format!(
        "{}{lambda}; {} % of the {zone} touches and carries {} % of the load",
        s.regime.name(),
        sig(s.contact_ratio * 100.0, 3),
        sig(s.contact_load_ratio * 100.0, 3)
    )
}

fn four(life: f64) -> String {
    sig(life, 4)
}

/// The discretisation error of a run, from a companion on `nodes` that took `wall_s`.
pub(crate) fn errors(s: &Summary, nodes: usize, wall_s: f64) -> String {
    let is_dry = s.regime == LubricationRegime::Dry;
    let share = |error: Option<f64>, value: f64| {
        error.map_or_else(
            || "unknown".to_owned(),
            |error| format!("{} %", sig(100.0 * error / value, 2)),
        )
    };
    let life = s.error_ln_life.map_or_else(String::new, |error| {
        format!(", life a factor of {}", sig(error.exp(), 3))
    });
    let limit = match (s.h_central_extrapolated_m, s.life_extrapolated) {
        (_, Some(life)) if is_dry => format!("; extrapolated: life {}", four(life)),
        (Some(film), Some(life)) => {
            let (film, life) = (nm(film), four(life));
            format!("; extrapolated: central film {film} nm, life {life}")
        }
        (Some(film), None) if !is_dry => {
            format!("; extrapolated: central film {} nm", nm(film))
        }
        _ => String::new(),
    };
    let films = if is_dry {
        String::new()
    } else {
        format!(
            "central film {}, least film {}, ",
            share(s.error_h_central_m, s.h_central_m),
            share(s.error_h_min_m, s.h_min_m)
        )
    };
    // Touching spots are in per cent already: their errors are in per cent of the ellipse and of the load, not of themselves.
    let part = |name: &str, value: f64, error: Option<f64>| {
        error
            .filter(|_| value > 0.0)
            .map_or_else(String::new, |error| {
                let (value, error) = (sig(100.0 * value, 3), sig(100.0 * error, 2));
                format!(", {name} ({value} ± {error}) %")
            })
    };
    let area = part("touching area", s.contact_ratio, s.error_contact_ratio);
    let load = part(
        "load on it",
        s.contact_load_ratio,
        s.error_contact_load_ratio,
    );
    let friction = if s.friction_coefficient == 0.0 {
        String::new()
    } else {
        format!(
            ", friction {}",
            share(s.error_friction_coefficient, s.friction_coefficient)
        )
    };
    format!(
        "{films}greatest pressure {}{friction}{area}{load}{life}; from {nodes} nodes in {wall_s:.1} s{limit}",
        share(s.error_p_max_pa, s.p_max_pa),
    )
}

/// Whether the passage repeats, in words.
fn repetition(s: &Summary) -> Option<String> {
    let (rhythm, period, repeats) = (s.rhythm?, s.period_s?, s.periodic?);
    let drift = s.period_drift.map_or_else(
        || "not seen twice yet".to_owned(),
        |drift| format!("drift {} %", sig(100.0 * drift, 2)),
    );
    let what = match rhythm {
        Rhythm::Steady => "steady".to_owned(),
        Rhythm::Orbit => format!("both bodies' waves come back after {}", seconds(period)),
        Rhythm::Statistics => "no common period of both bodies' waves; means".to_owned(),
    };
    let verdict = if repeats {
        "repeats"
    } else {
        "does not repeat"
    };
    Some(format!("{verdict}: {what}, {drift}"))
}

fn cycles(formula: Option<f64>, counted: Option<f64>) -> String {
    let formula = formula.map_or_else(|| "never ends".to_owned(), |n| sig(n, 3));
    match counted {
        Some(counted) => format!("{formula} (counted {})", sig(counted, 3)),
        None => formula,
    }
}

fn line(text: &mut String, name: &str, what: &str) {
    // Writing to a String cannot fail.
    let _ = writeln!(text, "{name:<14} {what}");
}
