//! The summary for people: what came out, with units, and what to mistrust.

mod complaints;
mod life;

use std::fmt::Write as _;

use asperity_engine::math::number::{GPA, NM, UM, counted, seconds, sig};
use asperity_engine::scene::{ContactKind, Lubricant, Scene};
use asperity_engine::sim::{CATALOGUE, LubricationRegime, Rhythm, Rung, Summary};
use asperity_session::run::{End, Outcome};

pub(crate) use self::complaints::complaints;

/// Lines of the report: a name, and what there is to say.
#[derive(Default)]
struct Lines(String);

impl Lines {
    fn add(&mut self, name: &str, what: impl AsRef<str>) {
        // Writing to a String cannot fail.
        let _ = writeln!(self.0, "{name:<14} {}", what.as_ref());
    }
}

/// What `text` says of a value, or nothing where it is not known.
fn known<T>(value: Option<T>, text: impl FnOnce(T) -> String) -> String {
    value.map_or_else(String::new, text)
}

/// The outcome as text. `errors`: the discretisation error in words.
pub(crate) fn text(scene: &Scene, outcome: &Outcome, errors: Option<&str>) -> String {
    let mut lines = Lines::default();
    if !scene.title.is_empty() {
        lines.0 = format!("{}\n\n", scene.title);
    }
    if let Some(summary) = &outcome.summary {
        if let Some(told) = summary.headline() {
            lines.add("life", told.life);
            lines.add("because", told.because);
            lines.add("trust", told.trust);
            lines.0.push('\n');
        }
        lines.add("run", run_line(outcome));
        if let Some(words) = steps_of_tolerance(scene, outcome) {
            lines.add("", words);
        }
        for (n, done) in summary.rungs.iter().enumerate() {
            let name = if n == 0 { "meshes" } else { "" };
            lines.add(
                name,
                format!("{}: {}", scene.kind().mesh(done.nodes), rung(done)),
            );
        }
        add_results(&mut lines, scene, summary);
        if let Some(errors) = errors {
            lines.add("discretisation", errors);
        }
    }
    for report in &outcome.reports {
        let mut notes = vec![counted(report.frames, "frame")];
        if report.skipped > 0 {
            notes.push(format!("{} skipped", report.skipped));
        }
        if report.bytes > 0 {
            notes.push(format!("{:.1} MB", report.bytes as f64 * 1e-6));
        }
        let note = known(Some(&report.note).filter(|note| !note.is_empty()), |note| {
            format!("; {note}")
        });
        lines.add(
            "written",
            format!("{} ({}{note})", report.output, notes.join(", ")),
        );
        if let Some(queue) = &report.queue {
            lines.add("", queue.to_string());
        }
    }
    lines.0
}

/// Adaptive steps that are more than the fixed ones would be.
fn steps_of_tolerance(scene: &Scene, outcome: &Outcome) -> Option<String> {
    let tolerance = scene.time.tolerance?;
    let fixed = outcome
        .steps_planned
        .filter(|fixed| outcome.steps > *fixed)?;
    Some(format!(
        "time.tolerance = {tolerance} took more steps than the {fixed} of time.step_nodes = {} alone",
        scene.time.step_nodes
    ))
}

fn run_line(outcome: &Outcome) -> String {
    let how = match (&outcome.end, outcome.n_unconverged) {
        (End::Stalled(_), _) => "stalled".to_owned(),
        (End::Stopped, _) if outcome.stopped => stopped(outcome),
        (End::Stopped, 0) => "stopped by the user, converged".to_owned(),
        (_, 0) => "converged".to_owned(),
        (_, n) => format!("{} did not converge", counted(n, "step")),
    };
    let pace = known(outcome.steps_per_s, |pace| {
        format!(", {pace:.1} steps per second after the start-up")
    });
    let steps = counted(outcome.steps, "step");
    let enough = if outcome.settled {
        ", until the life had settled"
    } else {
        ""
    };
    format!("{how}; {steps} in {:.1} s{pace}{enough}", outcome.wall_s)
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

/// What the program made of the oil and of the surfaces that it was given.
fn add_oil_and_surfaces(lines: &mut Lines, scene: &Scene) {
    for oil in scene.lubricant.iter().filter_map(Lubricant::conversion) {
        lines.add("oil", oil);
    }
    for (name, surface) in ["map 1", "map 2"].into_iter().zip(scene.surfaces()) {
        for (k, line) in surface.relief_lines().into_iter().enumerate() {
            lines.add(if k == 0 { name } else { "" }, line);
        }
    }
}

fn add_results(lines: &mut Lines, scene: &Scene, s: &Summary) {
    lines.add(
        "contact",
        format!(
            "a {}, Hertz pressure {}, load {}",
            UM.show(s.a_m, 4),
            GPA.show(s.p_hertz_pa, 4),
            load(scene, s.load_n)
        ),
    );
    lines.add("motion", motion(scene));
    add_oil_and_surfaces(lines, scene);
    lines.add(
        "pressure",
        format!(
            "maximum {} = {} times Hertz; mean of the steps' maxima {}",
            GPA.show(s.p_max_greatest_pa, 4),
            sig(s.p_max_greatest_pa / s.p_hertz_pa, 3),
            GPA.show(s.p_max_pa, 4)
        ),
    );
    let film = match s.regime {
        // What its solver leaves between dry bodies is rounding, of either sign.
        LubricationRegime::Dry => "none: the contact is dry".to_owned(),
        LubricationRegime::Boundary | LubricationRegime::Mixed | LubricationRegime::FullFilm => {
            format!(
                "central {}, minimum {}; mean of the steps' minima {}",
                NM.show(s.h_central_m, 3),
                NM.show(s.h_min_least_m, 3),
                NM.show(s.h_min_m, 3)
            )
        }
    };
    lines.add("film", film);
    lines.add("regime", regime(scene, s));
    lines.add(
        "friction",
        format!("coefficient {}", sig(s.friction_coefficient, 3)),
    );
    if s.n_body_1.is_some() || s.n_body_2.is_some() {
        let [one, two] = [
            cycles(s.n_body_1, s.n_counted_body_1),
            cycles(s.n_body_2, s.n_counted_body_2),
        ];
        lines.add(
            "cycles",
            format!("per passage of body 1: {one}; of body 2: {two}"),
        );
    }
    if let (Some(stress_pa), Some(depth_m), Some(x_m)) = (
        s.sigma_eff_max_pa,
        s.sigma_eff_max_depth_m,
        s.sigma_eff_max_x_m,
    ) {
        lines.add(
            "stress",
            format!(
                "maximum effective stress {}, {} deep at x = {}",
                GPA.show(stress_pa, 4),
                UM.show(depth_m, 3),
                UM.show(x_m, 3)
            ),
        );
    }
    if let Some(repetition) = repetition(s) {
        lines.add("passage", repetition);
    }
    add_by_itself(lines, scene, s);
    add_heat(lines, s);
    add_wear(lines, s);
    life::add_life(lines, scene, s);
    let (load, mass) = (s.load_error, s.mass_error);
    let heat = known(s.heat_error, |heat| format!(", heat {heat:.1e}"));
    lines.add("errors", format!("load {load:.1e}, mass {mass:.1e}{heat}"));
    for (k, caution) in s.cautions.iter().enumerate() {
        lines.add(if k == 0 { "cautions" } else { "" }, &caution.text);
    }
}

/// How warm the surfaces become.
fn add_heat(lines: &mut Lines, s: &Summary) {
    let (Some(greatest), Some(mean)) = (s.flash_temperature_max_k, s.flash_temperature_mean_k)
    else {
        return;
    };
    let blok = known(s.flash_temperature_blok_k, |blok| {
        format!(" (Blok's formula with this friction: {} K)", sig(blok, 3))
    });
    let share = known(s.heat_share_1, |share| {
        format!("; {} % of the heat enters body 1", sig(100.0 * share, 3))
    });
    let warmest = known(s.contact_temperature_max_k, |k| {
        format!(", up to {} degrees C", sig(k - 273.15, 4))
    });
    lines.add(
        "heat",
        format!(
            "flash temperature at most {} K{blok}, {} K on average over the Hertz area{warmest}{share}",
            sig(greatest, 3),
            sig(mean, 3)
        ),
    );
    let oil = known(s.film_temperature_max_k, |k| {
        format!("oil up to {} degrees C", sig(k - 273.15, 4))
    });
    let inlet = match s.inlet_heating_factor.zip(s.inlet_heating_factor_gupta) {
        Some((wilson, gupta)) => format!(
            "; film and friction are those of the warm oil; a smooth film by Wilson & Sheu (1983): {} times the cold one, by Gupta \
             et al. (1992) {}",
            sig(wilson, 3),
            sig(gupta, 3)
        ),
        None => "; film and friction are those of cold oil".to_owned(),
    };
    if !oil.is_empty() {
        lines.add("", format!("{oil}{inlet}"));
    }
}

/// What has been worn off, and what the surfaces came to on the way: at most so many lines.
fn add_wear(lines: &mut Lines, s: &Summary) {
    const SHOWN: usize = 16;
    let Some(cycles) = s.cycles else {
        return;
    };
    let depth = |depth_m: Option<f64>| match depth_m {
        Some(depth_m) if depth_m >= 1e-10 => NM.show(depth_m, 3),
        Some(depth_m) => format!("{} m", sig(depth_m, 3)),
        None => "nothing".to_owned(),
    };
    let [one, two] = [s.wear_depth_1_m, s.wear_depth_2_m].map(depth);
    let times = if cycles == 1.0 {
        "one loading cycle takes".to_owned()
    } else {
        format!("{} loading cycles have taken", sig(cycles, 3))
    };
    lines.add(
        "wear",
        format!("{times} at most {one} off body 1 and {two} off body 2"),
    );
    add_pits(lines, s);
    let n = s.ages.len();
    let every = n.div_ceil(SHOWN).max(1);
    for (k, age) in s.ages.iter().enumerate() {
        if k % every != 0 && k + 1 != n {
            continue;
        }
        lines.add(
            if k == 0 { "ages" } else { "" },
            format!(
                "{:>9} cycles: worn {} and {}, Rq {} and {}{}, p_max {}, on contacts {} %, friction {}{}{}",
                sig(age.cycles, 3),
                depth(Some(age.wear_depth_1_m)),
                depth(Some(age.wear_depth_2_m)),
                NM.show(age.rq_1_m, 3),
                NM.show(age.rq_2_m, 3),
                known(age.lambda_ratio, |lambda| format!(", lambda {}", sig(lambda, 3))),
                GPA.show(age.p_max_pa, 3),
                sig(100.0 * age.contact_load_ratio, 2),
                sig(age.friction_coefficient, 3),
                known(age.life_relative, |life| format!(", life {}", sig(life, 3))),
                pitted(age.pitted_area_1, age.pitted_area_2),
            ),
        );
    }
}

/// Pitted parts of both surfaces.
fn pitted(one: Option<f64>, two: Option<f64>) -> String {
    match (one, two) {
        (Some(one), Some(two)) => format!(
            ", pits on {} and {} %",
            sig(100.0 * one, 3),
            sig(100.0 * two, 3)
        ),
        _ => String::new(),
    }
}

/// Cycles to pits, with and without what wear does.
fn add_pits(lines: &mut Lines, s: &Summary) {
    let cycles = |cycles: Option<f64>| cycles.map_or("-".to_owned(), |n| sig(n, 3));
    for (body, area, pits) in [
        (1, s.pitted_area_1, s.pits_body_1),
        (2, s.pitted_area_2, s.pits_body_2),
    ] {
        let (Some(area), Some(p)) = (area, pits) else {
            continue;
        };
        lines.add(
            if body == 1 { "pits" } else { "" },
            format!(
                "body {body}: on {} % of the line y = 0, greatest damage {} at {} depth; the first after {} cycles, on 1 % {}, \
                 on 10 % {}; if it stayed new {}, {}, {}",
                sig(100.0 * area, 3),
                sig(p.damage_max, 3),
                UM.show(p.depth_m, 3),
                cycles(p.first_cycles),
                cycles(p.one_percent_cycles),
                cycles(p.ten_percent_cycles),
                cycles(p.unworn_first_cycles),
                cycles(p.unworn_one_percent_cycles),
                cycles(p.unworn_ten_percent_cycles),
            ),
        );
    }
}

/// Quantities that the catalogue shows by themselves.
fn add_by_itself(lines: &mut Lines, scene: &Scene, s: &Summary) {
    for quantity in CATALOGUE {
        let sums = quantity.over.iter().filter_map(|(over, key)| {
            let value = (*s.by_itself.get(*key)?)?;
            let value = quantity.in_words(value, scene.kind());
            Some(format!("{} of the steps {value}", over.word()))
        });
        let sums: Vec<String> = sums.collect();
        if !sums.is_empty() {
            lines.add(
                quantity.symbol,
                format!("{}: {}", quantity.meaning, sums.join(", ")),
            );
        }
    }
}

/// S and the speeds of both bodies, as the scene says: titles do not know what `--set` changed.
fn motion(scene: &Scene) -> String {
    let motion = &scene.motion;
    let when = if scene.events.is_empty() {
        ""
    } else {
        " at the start, before the scene's events"
    };
    let [one, two] = [-0.5, 0.5].map(|half| {
        let speed_m_s = motion.entrainment_m_s * (1.0 + half * motion.slide_roll);
        sig(speed_m_s, 3)
    });
    format!(
        "S = {}, U {} m/s; body 1 {one} m/s, body 2 {two} m/s{when}",
        sig(motion.slide_roll, 3),
        sig(motion.entrainment_m_s, 3),
    )
}

/// A load with the unit of the scene's kind of contact.
fn load(scene: &Scene, value: f64) -> String {
    let unit = match scene.kind() {
        ContactKind::Point => "N",
        ContactKind::Line => "N/m",
    };
    format!("{} {unit}", sig(value, 4))
}

/// What carries the load.
fn regime(scene: &Scene, s: &Summary) -> String {
    let zone = match scene.kind() {
        ContactKind::Point => "Hertz ellipse",
        ContactKind::Line => "Hertz width",
    };
    let lambda = known(s.lambda_ratio, |lambda| {
        let lambda = sig(lambda, 3);
        format!(", λ {lambda} (smooth central film by formula over composite roughness)")
    });
    format!(
        "{}{lambda}; asperity contact on {} % of the {zone}, which carries {} % of the load",
        s.regime.name(),
        sig(s.contact_ratio * 100.0, 3),
        sig(s.contact_load_ratio * 100.0, 3)
    )
}

/// What a mesh of a ladder came to, in one line.
pub(crate) fn rung(rung: &Rung) -> String {
    let after = format!("after {:.2} s", rung.seconds);
    let Some(life) = rung.life_relative else {
        return format!("done {after}");
    };
    let band = known(
        rung.life_relative_low.zip(rung.life_relative_high),
        |(low, high)| format!(", {} to {}", sig(low, 3), sig(high, 3)),
    );
    format!("life {}{band}, {after}", sig(life, 4))
}

/// The discretisation error of a run, from one on `nodes`; `wall_s`: what that took, where it was made for this alone.
pub(crate) fn errors(s: &Summary, nodes: usize, wall_s: Option<f64>) -> String {
    let is_dry = s.regime == LubricationRegime::Dry;
    let mut parts = Vec::new();
    let mut add = |name: &str, error: Option<f64>, value: f64| {
        let percent = error.map(|error| format!("{} %", sig(100.0 * error / value, 2)));
        parts.push(format!(
            "{name} {}",
            percent.as_deref().unwrap_or("unknown")
        ));
    };
    if !is_dry {
        add("central film", s.error_h_central_m, s.h_central_m);
        add("minimum film", s.error_h_min_m, s.h_min_m);
    }
    add("maximum pressure", s.error_p_max_pa, s.p_max_pa);
    if s.friction_coefficient != 0.0 {
        add(
            "friction",
            s.error_friction_coefficient,
            s.friction_coefficient,
        );
    }
    // Shares are in per cent already: their errors are in per cent of the ellipse and of the load, not of themselves.
    for (name, value, error) in [
        ("asperity contact", s.contact_ratio, s.error_contact_ratio),
        (
            "load on it",
            s.contact_load_ratio,
            s.error_contact_load_ratio,
        ),
    ] {
        if let Some(error) = error.filter(|_| value > 0.0) {
            let (value, error) = (sig(100.0 * value, 3), sig(100.0 * error, 2));
            parts.push(format!("{name} ({value} ± {error}) %"));
        }
    }
    if let Some(error) = s.error_ln_life {
        parts.push(format!("life a factor of {}", sig(error.exp(), 3)));
    }
    let film_m = s.h_central_extrapolated_m.filter(|_| !is_dry);
    let film = film_m.map(|film_m| format!("central film {}", NM.show(film_m, 3)));
    let life = s
        .life_extrapolated
        .map(|life| format!("life {}", sig(life, 4)));
    let limits: Vec<String> = film.into_iter().chain(life).collect();
    let limit = if limits.is_empty() {
        String::new()
    } else {
        format!("; extrapolated: {}", limits.join(", "))
    };
    let parts = parts.join(", ");
    let time = known(wall_s, |wall_s| format!(" in {wall_s:.1} s"));
    format!("{parts}; from {nodes} nodes{time}{limit}")
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
    let not = if repeats {
        "repeats"
    } else {
        "does not repeat"
    };
    Some(format!("{not}: {what}, {drift}"))
}

fn cycles(formula: Option<f64>, counted: Option<f64>) -> String {
    let formula = formula.map_or_else(|| "never ends".to_owned(), |n| sig(n, 3));
    let counted = known(counted, |n| format!(" (counted {})", sig(n, 3)));
    format!("{formula}{counted}")
}
