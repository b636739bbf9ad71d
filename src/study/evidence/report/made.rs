//! What made surfaces say of the experiments.

use std::fmt::Write as _;

use super::super::random::{AssumedRoughness, MadeWay, Verdict};
use super::super::set::Forecast;
use super::super::tried::Tried;
use crate::table::{MarkdownTable, figure};

/// The assumption, before all experiments.
pub(super) fn push_assumed(text: &mut String, made: &AssumedRoughness) {
    let cutoffs: Vec<String> = (made.cutoffs_short_m.iter())
        .map(|cutoff_m| microns(*cutoff_m))
        .collect();
    let _ = writeln!(
        text,
        "\nEach experiment is tried once more with made (random) surfaces of the same Rq, {} pairs, on {} nodes, over {} mm. {} \
         Shortest waves: {}. The ratio of a claim is the geometric mean over the pairs, in brackets the range in which that \
         lies with 90 %; a claim is met where it holds all over the range, not met where it holds nowhere in it, and else not \
         decided.",
        made.pairs,
        made.nodes,
        1e3 * made.period_x_m,
        made.about,
        cutoffs.join(" and "),
    );
    for variant in &made.variant {
        let words = variant.set.join(" --set ");
        let _ = writeln!(
            text,
            "*{}*: `--set {words}`. {}",
            variant.name, variant.about
        );
    }
}

/// The points with all pairs, and the claims.
pub(super) fn push_experiment(
    text: &mut String,
    tried: &Tried,
    made: &AssumedRoughness,
    ways: &[MadeWay],
) {
    let mut points = MarkdownTable::new(&["made surfaces, point"]);
    let mut claims = MarkdownTable::new(&["made surfaces, what it says", "measured"]);
    points
        .columns
        .extend(ways.iter().map(|way| name(way, made)));
    claims
        .columns
        .extend(ways.iter().map(|way| name(way, made)));
    let mut failures = Vec::new();
    for (at, point) in tried.experiment.point.iter().enumerate() {
        let is_stress = point.depth_m.is_some();
        let cell = |way: usize| match tried.pairs.scatter(at, way, is_stress) {
            Some(found) => {
                let what = if is_stress { "stress" } else { "life" };
                let [mean, scatter] = [found.mean, found.scatter].map(|v| figure(Some(v)));
                format!("{what} {mean}, one pair x {scatter}")
            }
            None if tried.pairs.damages[at][way].is_empty() => "-".to_owned(),
            None => "failed".to_owned(),
        };
        let body = if point.body == 1 { "" } else { " (body 2)" };
        let mut row = vec![format!("{}{body}", point.label)];
        row.extend((0..ways.len()).map(cell));
        points.rows.push(row);
        let of_point = tried.pairs.damages[at].iter().flatten();
        failures.extend(
            of_point
                .filter_map(|found| found.as_ref().err())
                .map(|why| format!("\n{} failed: {why}.\n", point.label)),
        );
    }
    for (judged, by_way) in tried.judged.iter().zip(&tried.pairs.judged) {
        let mut row = vec![judged.claim.says.clone(), figure(judged.claim.ratio)];
        row.extend(by_way.iter().enumerate().map(|(way, found)| match found {
            Some(found) => {
                let verdict = match judged.claim.not_compared {
                    Some(_) => "not compared",
                    None => found.verdict.name(),
                };
                let [least, most] = found.range.map(|v| figure(Some(v)));
                format!(
                    "{verdict} {} ({least} to {most})",
                    figure(Some(found.ratio))
                )
            }
            None if made_of_part(made, ways[way]) => "-".to_owned(),
            None => "failed".to_owned(),
        }));
        claims.rows.push(row);
    }
    let _ = write!(text, "\n{}\n{}", points.markdown(), claims.markdown());
    text.push_str(&failures.concat());
    if let Some(point) = tried.experiment.point.first()
        && let Ok(keys) = made.keys(point, ways[0], 1)
    {
        let words = keys.join(" --set ");
        let _ = writeln!(
            text,
            "\n{}, pair 1: `asperity run evidence/{} --set {words}`",
            point.label, point.scene
        );
    }
    if let Some(forecast) = &tried.experiment.forecast {
        push_forecast(text, tried, forecast, (made, ways));
    }
}

fn microns(length_m: f64) -> String {
    format!("{:.0} um", 1e6 * length_m)
}

/// A way in words.
fn name(way: &MadeWay, made: &AssumedRoughness) -> String {
    let more = way.variant.map(|at| format!(", {}", made.variant[at].name));
    let more = more.unwrap_or_default();
    format!("{}, {}{more}", way.basis.key(), microns(way.cutoff_short_m))
}

/// Whether some points only are tried that way.
fn made_of_part(made: &AssumedRoughness, way: MadeWay) -> bool {
    (way.variant).is_some_and(|at| !made.variant[at].points.is_empty())
}

/// What the known life foretells: its own band times that of the ratio over the pairs.
fn push_forecast(
    text: &mut String,
    tried: &Tried,
    forecast: &Forecast,
    (made, ways): (&AssumedRoughness, &[MadeWay]),
) {
    let claim = tried.experiment.claim.iter().position(|claim| {
        claim.more == forecast.known && claim.less.as_ref() == Some(&forecast.wanted)
    });
    let Some(claim) = claim else {
        return;
    };
    let _ = writeln!(
        text,
        "\nForecast of L10 of \"{}\" with made surfaces, millions, both bands multiplied:\n",
        forecast.wanted
    );
    for (way, found) in ways.iter().zip(&tried.pairs.judged[claim]) {
        let Some(found) = found else {
            continue;
        };
        let [l10, low, high] = [
            forecast.l10 * found.ratio,
            forecast.low * found.range[0],
            forecast.high * found.range[1],
        ]
        .map(|life| figure(Some(life)));
        let _ = writeln!(text, "- {}: {l10} ({low} to {high})", name(way, made));
    }
}

/// Claims met, not met and not decided, by way, beside the waves by the same counting.
pub(super) fn push_verdicts(text: &mut String, experiments: &[Tried], made: &AssumedRoughness) {
    let ways = &made.ways();
    text.push_str(
        "\n## Waves and made surfaces\n\nOf the claims that go by life and can be compared:\n\n",
    );
    let mut table = MarkdownTable::new(&[
        "counting",
        "waves: met",
        "not met",
        "made surfaces down to",
        "met",
        "not met",
        "not decided",
    ]);
    for (k, way) in ways.iter().enumerate() {
        let mut waves = [0; 2];
        let mut pairs = [0; Verdict::ALL.len()];
        for tried in experiments {
            for (judged, by_way) in tried.judged.iter().zip(&tried.pairs.judged) {
                let Some(found) = by_way[k].filter(|_| judged.counts()) else {
                    continue;
                };
                waves[usize::from(!judged.holds[way.basis as usize])] += 1;
                pairs[found.verdict as usize] += 1;
            }
        }
        let mut row = vec![way.basis.key().to_owned()];
        row.extend(waves.map(|n| n.to_string()));
        row.push(match way.variant {
            None => microns(way.cutoff_short_m),
            Some(at) => format!("{}, {}", microns(way.cutoff_short_m), made.variant[at].name),
        });
        row.extend(pairs.map(|n| n.to_string()));
        table.rows.push(row);
    }
    text.push_str(&table.markdown());
    let mut of_verdict = Verdict::ALL.map(|_| Vec::new());
    for tried in experiments {
        for (judged, by_way) in tried.judged.iter().zip(&tried.pairs.judged) {
            if let Some(found) = by_way[0].filter(|_| judged.counts()) {
                of_verdict[found.verdict as usize].push(format!("\"{}\"", judged.claim.says));
            }
        }
    }
    let _ = writeln!(text, "\nBy {}:\n", name(&ways[0], made));
    for (verdict, claims) in Verdict::ALL.iter().zip(&of_verdict) {
        let claims = if claims.is_empty() {
            "none".to_owned()
        } else {
            claims.join(", ")
        };
        let _ = writeln!(text, "- {}: {claims}", verdict.name());
    }
    for (k, way) in ways
        .iter()
        .enumerate()
        .filter(|(_, way)| way.variant.is_some())
    {
        let mut turned = Vec::new();
        for tried in experiments {
            for (judged, by_way) in tried.judged.iter().zip(&tried.pairs.judged) {
                let both = by_way[0].zip(by_way[k]).filter(|_| judged.counts());
                if let Some((without, with)) = both.filter(|(a, b)| a.verdict != b.verdict) {
                    turned.push(format!(
                        "\"{}\" from {} to {}",
                        judged.claim.says,
                        without.verdict.name(),
                        with.verdict.name()
                    ));
                }
            }
        }
        let turned = if turned.is_empty() {
            "nothing".to_owned()
        } else {
            turned.join(", ")
        };
        let _ = writeln!(text, "\n{} turns {turned}.", name(way, made));
    }
}
