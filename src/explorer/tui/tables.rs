//! What is on the screen as comma-separated tables, units in the header: the centre line, the material point's
//! crossing, and what was simulated at other S and speeds.

use std::fmt::Write as _;

use crate::tui::app::App;
use asperity_engine::sim::Frame;

/// File names and texts.
pub(super) fn of(app: &App, frame: &Frame) -> Vec<(&'static str, String)> {
    vec![
        ("centre_line.csv", centre_line(frame)),
        ("material_point.csv", material_point(app)),
        ("curves.csv", curves(app)),
    ]
}

/// A table from its header and rows; a cell that is `None` stays empty.
fn table(header: &str, rows: impl Iterator<Item = Vec<Option<f64>>>) -> String {
    let mut text = format!("{header}\n");
    for row in rows {
        for (column, cell) in row.into_iter().enumerate() {
            let comma = if column == 0 { "" } else { "," };
            let cell = cell.map_or_else(String::new, |value| value.to_string());
            // Writing to a string does not fail.
            let _ = write!(text, "{comma}{cell}");
        }
        text.push('\n');
    }
    text
}

fn centre_line(frame: &Frame) -> String {
    // The shortest number that is this one of single precision.
    let at = |field: &[f32], i: usize| frame.centre_line(field).get(i)?.to_string().parse().ok();
    let rows = (0..frame.nx).map(|i| {
        vec![
            Some(frame.x_min_m + i as f64 * frame.dx_m),
            at(&frame.pressure_pa, i),
            at(&frame.film_m, i),
            at(&frame.roughness_1_m, i),
            at(&frame.roughness_2_m, i),
            at(&frame.traction_pa, i),
        ]
    });
    table(
        "x_m,pressure_pa,film_m,roughness_1_m,roughness_2_m,traction_on_body_1_pa",
        rows,
    )
}

/// The whole crossing before (0) and the present one so far (1); of a replay the whole one, which it is part of.
fn material_point(app: &App) -> String {
    let point = app.point_now();
    let before = app.replay.trace.before().iter().map(|sample| (0.0, sample));
    let now = app
        .replay
        .trace
        .current()
        .iter()
        .map(|sample| (1.0, sample));
    let now = now.filter(|_| app.replay.playing.is_none());
    let samples = before.chain(now).map(|(crossing, sample)| {
        vec![
            Some(crossing),
            point.map(|point| f64::from(point.body)),
            point.map(|point| point.depth_m),
            Some(sample.x_m),
            Some(sample.pressure_pa),
            Some(sample.tau_xz_pa),
            Some(sample.effective_pa),
            Some(sample.cycles),
        ]
    });
    table(
        "crossing,body,depth_m,x_m,pressure_pa,tau_xz_pa,effective_pa,cycles_counted",
        samples,
    )
}

fn curves(app: &App) -> String {
    let rows = app.all_simulated().map(|found| {
        let at = &found.at;
        let life = |k: usize| found.life.map(|life| life[k]);
        vec![
            Some(at.slide_roll),
            Some(at.entrainment_m_s),
            Some(at.load_n),
            Some(at.amplitude_m[0]),
            Some(at.amplitude_m[1]),
            life(1),
            life(0),
            life(2),
            Some(found.friction),
            found.lambda,
        ]
    });
    table(
        "slide_roll,entrainment_m_s,load_n,amplitude_1_m,amplitude_2_m,life_relative,life_relative_low,\
         life_relative_high,friction_coefficient,lambda_ratio",
        rows,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_without_a_value_stay_empty() {
        let rows = [vec![Some(1.5), None], vec![None, Some(-2e-7)]];
        assert_eq!(
            table("a_m,b_pa", rows.into_iter()),
            "a_m,b_pa\n1.5,\n,-0.0000002\n"
        );
    }
}
