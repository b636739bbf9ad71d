//! What is known of every case by closed forms, before anything is simulated.

use super::error::SweepError;
use super::run::prepare;
use super::spec::Sweep;
use super::table::write_value;
use crate::cells::{Cells, csv_line};
use asperity_engine::physics::cycles::{BodyId, Kinematics};
use asperity_engine::plan::{OtherFilms, Plan};
use asperity_engine::scene::Scene;

const COLUMNS: [&str; 13] = [
    "rx_m",
    "u_1_m_s",
    "u_2_m_s",
    "entrainment_m_s",
    "slide_roll",
    "load_n",
    "a_m",
    "p_hertz_pa",
    "h_regression_m",
    "h_min_regression_m",
    "lambda_ratio",
    "n_body_1",
    "n_body_2",
];

/// R, U1, U2, U, S, load (of a line N/m), a, p_h, film by regression, λ and n of both bodies of every case: the lines of a
/// table, header first, each made when it is asked for.
///
/// # Errors
/// [`SweepError`] when a case is no scene or cannot be planned.
pub fn points(sweep: &Sweep) -> impl Iterator<Item = Result<String, SweepError>> {
    let path: Vec<_> = super::path::columns(&sweep.path).collect();
    // What a path's own columns say already is not said twice.
    let shown: Vec<usize> = (0..COLUMNS.len())
        .filter(|k| !path.contains(&COLUMNS[*k]))
        .collect();
    let mut head = vec!["case".to_owned()];
    head.extend(path.iter().map(|name| (*name).to_owned()));
    if sweep.path.is_empty() {
        head.extend(sweep.axes.iter().map(|axis| axis.key.clone()));
    }
    head.extend(shown.iter().map(|k| sweep.header(COLUMNS[*k]).to_owned()));
    let mut row = Cells::default();
    let lines = (0..sweep.len()).map(move |case| {
        write_case(sweep, case, &shown, &mut row)?;
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

fn write_case(
    sweep: &Sweep,
    case: usize,
    shown: &[usize],
    row: &mut Cells,
) -> Result<(), SweepError> {
    let (scene, plan) = prepare(sweep, case)?;
    row.clear();
    row.text(case);
    if let Some(point) = sweep.path.get(case) {
        for (_, value) in &point.values {
            row.number(*value);
        }
    } else {
        for value in sweep.values(case) {
            write_value(row, value);
        }
    }
    let known = numbers(&scene, &plan);
    for k in shown {
        row.optional(known[*k]);
    }
    Ok(())
}

fn numbers(scene: &Scene, plan: &Plan) -> [Option<f64>; COLUMNS.len()] {
    let [u_1, u_2] = plan.speeds_m_s;
    let film = plan.film.as_ref();
    let (central, minimum) = match film.map(|film| (film.others, film.central_m)) {
        None => (None, None),
        Some((
            OtherFilms::HamrockDowson {
                central_m,
                minimum_m,
            },
            _,
        )) => (Some(central_m), Some(minimum_m)),
        Some((OtherFilms::DowsonHigginson { minimum_m }, central_m)) => {
            (Some(central_m), Some(minimum_m))
        }
    };
    let (u, s) = (scene.motion.entrainment_m_s, scene.motion.slide_roll);
    let kinematics = Kinematics::from_slide_roll(u, s, 2.0 * plan.hertz.a_m);
    let contacts = |body: BodyId| {
        let mate = plan.waves[body.mate().index()];
        let crests = mate.map_or(0.0, |wave| wave.crests_per_m);
        kinematics.contacts(body, crests).per_cycle()
    };
    [
        Some(scene.contact.rx_m),
        Some(u_1),
        Some(u_2),
        Some(u),
        Some(s),
        Some(plan.force_n),
        Some(plan.hertz.a_m),
        Some(plan.hertz.p_max_pa),
        central,
        minimum,
        film.and_then(|film| film.lambda_ratio),
        contacts(BodyId::One),
        contacts(BodyId::Two),
    ]
}
