//! What is known of every case by closed forms, before anything is simulated.

use super::case::Case;
use super::error::SweepError;
use super::spec::Sweep;
use super::table::{begin_row, write_values};
use crate::cells::{Cells, csv_line};
use asperity_engine::physics::cycles::{BodyId, Kinematics};

/// What a column holds of a case.
type OfCase = fn(&Case) -> Option<f64>;

#[rustfmt::skip]
const COLUMNS: [(&str, OfCase); 13] = [
    ("rx_m", |case| Some(case.scene.contact.rx_m)),
    ("u_1_m_s", |case| Some(case.plan.speeds_m_s[0])),
    ("u_2_m_s", |case| Some(case.plan.speeds_m_s[1])),
    ("entrainment_m_s", |case| Some(case.scene.motion.entrainment_m_s)),
    ("slide_roll", |case| Some(case.scene.motion.slide_roll)),
    ("load_n", |case| Some(case.plan.force_n)),
    ("a_m", |case| Some(case.plan.hertz.a_m)),
    ("p_hertz_pa", |case| Some(case.plan.hertz.p_max_pa)),
    ("h_regression_m", |case| case.regressions_m().map(|[central, _]| central)),
    ("h_min_regression_m", |case| case.regressions_m().map(|[_, minimum]| minimum)),
    ("lambda_ratio", |case| case.plan.film.as_ref()?.lambda_ratio),
    ("n_body_1", |case| contacts(case, BodyId::One)),
    ("n_body_2", |case| contacts(case, BodyId::Two)),
];

/// R, U1, U2, U, S, load (of a line N/m), a, p_h, film by regression, λ and n of both bodies of every case: the lines of a
/// table, header first, each made when it is asked for.
///
/// # Errors
/// [`SweepError`] when a case is no scene or cannot be planned.
pub fn points(sweep: &Sweep) -> impl Iterator<Item = Result<String, SweepError>> {
    let path: Vec<_> = super::path::columns(&sweep.path).collect();
    // What a path's own columns say already is not said twice.
    let shown: Vec<_> = COLUMNS
        .iter()
        .filter(|(name, _)| !path.contains(name))
        .collect();
    let mut head = vec!["case".to_owned()];
    head.extend(path.iter().map(|name| (*name).to_owned()));
    if sweep.path.is_empty() {
        head.extend(sweep.axes.iter().map(|axis| axis.key.clone()));
    }
    head.extend(shown.iter().map(|(name, _)| sweep.header(name).to_owned()));
    let mut row = Cells::default();
    let lines = (0..sweep.len()).map(move |index| {
        let case = sweep.case(index)?;
        begin_row(&mut row, sweep, index);
        if sweep.path.is_empty() {
            write_values(&mut row, sweep, index);
        }
        for (_, of) in &shown {
            row.optional(of(&case));
        }
        Ok(csv_line(row.iter()))
    });
    std::iter::once(Ok(csv_line(&head))).chain(lines)
}

/// All of it.
///
/// # Errors
/// Same.
pub fn points_csv(sweep: &Sweep) -> Result<String, SweepError> {
    points(sweep).collect()
}

/// Asperities of the mate that a point of a body meets in one loading cycle, n.
fn contacts(case: &Case, body: BodyId) -> Option<f64> {
    let motion = &case.scene.motion;
    let width_m = 2.0 * case.plan.hertz.a_m;
    let kinematics =
        Kinematics::from_slide_roll(motion.entrainment_m_s, motion.slide_roll, width_m);
    let mate = case.plan.waves[body.mate().index()];
    let crests = mate.map_or(0.0, |wave| wave.crests_per_m);
    kinematics.contacts(body, crests).per_cycle()
}
