//! The evidence as tables and words.

mod made;

use std::fmt::Write as _;

use super::super::table::{MarkdownTable, figure};
use super::tried::{Judged, Tried};
use super::{Evidence, EvidenceRow};
use asperity_engine::physics::heat_estimate::inlet_factor;
use asperity_engine::scene::CycleBasis;

/// What a disagreement without a known cause is told by.
const UNKNOWN: &str = "no cause is known";

/// Every computed number.
pub fn evidence_table(result: &Evidence) -> MarkdownTable {
    let mut table = MarkdownTable::new(&[
        "grade",
        "case",
        "source",
        "what",
        "theirs",
        "nodes",
        "found",
        "limit",
        "deviation, %",
        "allowed, %",
        "agrees",
        "scene",
    ]);
    for row in &result.rows {
        let theirs = match row.spread {
            0.0 => number(row.theirs),
            spread => format!(
                "{} to {}",
                number(row.theirs - spread),
                number(row.theirs + spread)
            ),
        };
        table.rows.push(vec![
            row.grade.name().to_owned(),
            row.case.clone(),
            row.source.clone(),
            row.what.clone(),
            theirs,
            format!("{}, {}", row.nodes[0], row.nodes[1]),
            format!("{}, {}", number(row.found[0]), number(row.found[1])),
            number(row.limit),
            format!("{:+.1}", 100.0 * row.deviation),
            format!("{}", 100.0 * row.tolerance),
            match &row.failed {
                Some(reason) => format!("failed: {reason}"),
                None if row.agrees() => "yes".to_owned(),
                None => "no".to_owned(),
            },
            row.scene.clone(),
        ]);
    }
    table
}

/// Four figures.
fn number(value: f64) -> String {
    if value.abs() >= 1000.0 || !value.is_finite() {
        format!("{value:.0}")
    } else {
        let digits = 3 - value.abs().max(1e-3).log10().floor() as i32;
        format!("{value:.*}", digits.clamp(0, 6) as usize)
    }
}

/// The whole report as Markdown.
pub fn evidence_text(result: &Evidence) -> String {
    let mut text = format!(
        "What others computed and measured, beside what this program finds. Every row is a scene: `asperity run SCENE`, with \
         its words of the last column. Theirs are the sources' own numbers or converted from them \
         (`assets/studies/evidence.toml`); no constant of the program was chosen to meet one. {:.0} s since the last start.\n",
        result.seconds
    );
    if !result.rows.is_empty() {
        push_computed(&mut text, result);
    }
    if !result.experiments.is_empty() {
        push_experiments(&mut text, result);
    }
    push_left_out(&mut text);
    text
}

fn push_computed(text: &mut String, result: &Evidence) {
    let agreeing = result.rows.iter().filter(|row| row.agrees()).count();
    let _ = writeln!(
        text,
        "\n## Computations\n\nLimit: both grids extrapolated with the order q of the scheme, h + (h - h2)/(2^q - 1); q is 2, \
         or 3 in scenes with `order = \"high\"`. \
         {agreeing} of {} numbers agree within what is allowed.\n",
        result.rows.len()
    );
    text.push_str(&evidence_table(result).markdown());
    let apart: Vec<&EvidenceRow> = result.rows.iter().filter(|row| !row.agrees()).collect();
    if !apart.is_empty() {
        text.push_str("\nDisagreements, each with its most likely cause:\n\n");
    }
    for row in apart {
        let cause = row.failed.as_deref().or(row.cause.as_deref());
        let _ = writeln!(
            text,
            "- {}, {}: {:+.1} %. {}.",
            row.case,
            row.what,
            100.0 * row.deviation,
            capital(cause.unwrap_or(UNKNOWN))
        );
    }
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| {
        first.to_uppercase().collect::<String>() + letters.as_str()
    })
}

fn push_experiments(text: &mut String, result: &Evidence) {
    let _ = writeln!(
        text,
        "\n## Experiments\n\nDamage is 1/life of a body in its own loading cycles, on {} nodes, by every way of counting \
         (`life.cycles`); lives are relative to the smooth, frictionless contact. A rank holds where the ratio is above 1.1, \
         damages are alike within a factor of 1.5, a measured ratio is met within half a decade.",
        result.nodes
    );
    let ways = result.made.ways();
    let is_made = (result.experiments.iter()).any(|tried| !tried.pairs.damages[0].is_empty());
    if is_made {
        made::push_assumed(text, &result.made);
    }
    for tried in &result.experiments {
        push_experiment(text, tried);
        if is_made {
            made::push_experiment(text, tried, &result.made, &ways);
        }
    }
    push_countings(text, &result.experiments);
    if is_made {
        made::push_verdicts(text, &result.experiments, &result.made);
    }
}

fn push_experiment(text: &mut String, tried: &Tried) {
    let experiment = &tried.experiment;
    let _ = writeln!(
        text,
        "\n### {}\n\n*{}.* {}\n\nComparable: {}. Not: {}.\n",
        experiment.name,
        experiment.source,
        experiment.measured,
        experiment.comparable,
        experiment.not_comparable
    );
    let mut damages = by_counting(&["point", "scene"]);
    for (point, found) in experiment.point.iter().zip(&tried.damages) {
        let body = if point.body == 1 { "" } else { " (body 2)" };
        let sets: Vec<String> = point
            .set
            .iter()
            .map(|set| format!(" --set {set}"))
            .collect();
        let sets = sets.concat();
        let mut row = vec![
            format!("{}{body}", point.label),
            format!("evidence/{}{sets}", point.scene),
        ];
        row.extend(found.iter().map(|found| match found {
            Ok(damage) if point.depth_m.is_some() => {
                format!("stress {}", figure(Some(damage.value)))
            }
            Ok(damage) => format!("life {}", figure(Some(1.0 / damage.value))),
            Err(reason) => format!("failed: {reason}"),
        }));
        damages.rows.push(row);
    }
    text.push_str(&damages.markdown());
    text.push('\n');
    let mut claims = by_counting(&["what it says", "measured"]);
    for judged in &tried.judged {
        let mut row = vec![judged.claim.says.clone(), figure(judged.claim.ratio)];
        let found = judged.ratios.iter().zip(&judged.holds);
        row.extend(found.map(|(ratio, holds)| {
            let holds = match (&judged.claim.not_compared, holds) {
                (Some(_), _) => "not compared",
                (None, true) => "yes",
                (None, false) => "no",
            };
            format!("{holds} {}", figure(Some(*ratio)))
        }));
        claims.rows.push(row);
    }
    text.push_str(&claims.markdown());
    for judged in &tried.judged {
        if let Some(why) = &judged.claim.not_compared {
            let _ = writeln!(
                text,
                "\n*\"{}\"* is not compared: {why}.",
                judged.claim.says
            );
        } else if !judged.holds.iter().all(|holds| *holds) {
            let why = judged.claim.why.as_deref().unwrap_or(UNKNOWN);
            let _ = writeln!(text, "\n*\"{}\"* fails: {why}.", judged.claim.says);
        }
    }
    push_forecast(text, tried);
}

/// A table with those columns and one for every counting.
fn by_counting(first: &[&'static str]) -> MarkdownTable {
    MarkdownTable::new(&[first, CycleBasis::KEYS].concat())
}

/// What a known life foretells, by every counting.
fn push_forecast(text: &mut String, tried: &Tried) {
    let Some(forecast) = &tried.experiment.forecast else {
        return;
    };
    let at = |label: &str| tried.experiment.point.iter().position(|p| p.label == label);
    let Some((known, wanted)) = at(&forecast.known).zip(at(&forecast.wanted)) else {
        return;
    };
    // L50/L10 = (ln 2/ln(1/0.9))^{1/e}.
    let decades = (2.0_f64.ln() / (1.0_f64 / 0.9).ln()).ln();
    let slope = decades / (forecast.l50 / forecast.l10).ln();
    let _ = writeln!(
        text,
        "\nThe known life as the calibration point (`life.calibration_cycles`), Weibull slope {slope:.2} by its own L50/L10; \
         forecast of L10 of \"{}\", millions, with the band of the known one:\n",
        forecast.wanted
    );
    for (counting, basis) in CycleBasis::ALL.into_iter().enumerate() {
        let [known, wanted] = [known, wanted].map(|at| tried.damages[at][counting].as_ref());
        let (Ok(known), Ok(wanted)) = (known, wanted) else {
            continue;
        };
        let [l10, low, high] = [forecast.l10, forecast.low, forecast.high]
            .map(|life| figure(Some(life * known.value / wanted.value)));
        let _ = writeln!(text, "- {}: {l10} ({low} to {high})", basis.key());
    }
}

/// Which counting agrees with what.
fn push_countings(text: &mut String, experiments: &[Tried]) {
    text.push_str("\n## Countings\n\nClaims that hold, of those that go by life:\n\n");
    let by_life = |tried: &Tried| -> Vec<Judged> {
        let judged = tried.judged.iter().filter(|judged| judged.counts());
        judged.cloned().collect()
    };
    let mut table = by_counting(&["experiment"]);
    for tried in experiments {
        let judged = by_life(tried);
        let held = |k: usize| judged.iter().filter(|judged| judged.holds[k]).count();
        let mut row = vec![tried.experiment.name.clone()];
        let countings = 0..CycleBasis::KEYS.len();
        row.extend(countings.map(|k| format!("{} of {}", held(k), judged.len())));
        table.rows.push(row);
    }
    text.push_str(&table.markdown());
    let all: Vec<Judged> = experiments.iter().flat_map(by_life).collect();
    let _ = writeln!(text, "\n{}", verdict(&all));
}

/// The sentence: whether one counting agrees with all experiments.
pub(super) fn verdict(all: &[Judged]) -> String {
    let countings = CycleBasis::KEYS;
    let can_hold: Vec<&Judged> = all
        .iter()
        .filter(|judged| judged.holds.contains(&true))
        .collect();
    let held = |k: usize| can_hold.iter().filter(|judged| judged.holds[k]).count();
    let list: Vec<String> = countings
        .iter()
        .enumerate()
        .map(|(k, name)| format!("{name} {}", held(k)))
        .collect();
    let hopeless: Vec<String> = all
        .iter()
        .filter(|judged| !judged.holds.contains(&true))
        .map(|judged| format!("\"{}\"", judged.claim.says))
        .collect();
    let complete = (0..countings.len()).filter(|k| held(*k) == can_hold.len());
    let complete: Vec<&str> = complete.map(|k| countings[k]).collect();
    let names = complete.join(", ");
    let first = if complete.is_empty() {
        "**No counting agrees with all experiments**".to_owned()
    } else if hopeless.is_empty() {
        format!("**All claims are met by {names}**")
    } else {
        format!("**No counting agrees with all experiments; {names} meets all that any meets**")
    };
    let mut text = format!(
        "{first}: of {} claims that at least one counting meets, {}.",
        can_hold.len(),
        list.join(", ")
    );
    if !hopeless.is_empty() {
        let _ = write!(
            text,
            " None meets {}: what is missing there is not a counting.",
            hopeless.join(", ")
        );
    }
    text
}

fn push_left_out(text: &mut String) {
    let [rolling, half, one] = [0.0, 0.5, 1.0].map(|s| inlet_factor(s, 0.1));
    let _ = writeln!(
        text,
        "\n## Left out\n\n\
         - Inlet shear heating (Wilson & Sheu), but for the column with warm oil. By their factor the film would be \
         {rolling:.2}, {half:.2} and {one:.2} times as thick at S = 0, 0.5 and 1 where L_T = 0.1.\n\
         - Mass lost by wear (Brandão et al., FZG type C). Pits on surfaces that wear are judged apart, by `asperity study \
         wear`; the column *worn* has the lives of surfaces that have worn.\n\
         - ISO/TS 6336-22: a formula for a film, not a measurement."
    );
}

#[cfg(test)]
mod tests {
    use super::super::set::{Comparison, EvidenceClaim};
    use super::*;

    fn judged(says: &str, holds: &[usize]) -> Judged {
        let countings = 0..CycleBasis::ALL.len();
        Judged {
            claim: EvidenceClaim {
                says: says.to_owned(),
                kind: Comparison::Rank,
                more: String::new(),
                less: None,
                ratio: None,
                per_time: false,
                not_compared: None,
                why: None,
            },
            ratios: vec![1.0; CycleBasis::ALL.len()],
            holds: countings.map(|k| holds.contains(&k)).collect(),
            is_stress: false,
        }
    }

    #[test]
    fn the_sentence_says_what_the_table_says() {
        let first = CycleBasis::KEYS[0];
        let all = verdict(&[judged("a", &[0, 1]), judged("b", &[0])]);
        assert!(
            all.starts_with(&format!("**All claims are met by {first}**")),
            "{all}"
        );
        let rest = verdict(&[judged("a", &[0]), judged("wear", &[])]);
        assert!(
            rest.contains(&format!("{first} meets all that any meets")),
            "{rest}"
        );
        assert!(rest.contains("None meets \"wear\""), "{rest}");
        let none = verdict(&[judged("a", &[0]), judged("b", &[1])]);
        assert!(
            none.starts_with("**No counting agrees with all experiments**:"),
            "{none}"
        );
        assert!(none.contains("of 2 claims"), "{none}");
    }

    #[test]
    fn numbers_have_four_figures() {
        assert_eq!(number(0.0525), "0.05250");
        assert_eq!(number(377.0), "377.0");
        assert_eq!(number(1.0), "1.000");
        assert_eq!(number(f64::NAN), "NaN");
    }
}
