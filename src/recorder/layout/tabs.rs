//! The tabs: the first tells what happens, the next are for an audience and for looking closer; what is used rarely comes
//! last.

use rerun::blueprint::{ContainerLike, Grid, Horizontal, TextLogView, Vertical};

use super::views::Views;
use crate::ages::{self, AgeCurves};
use crate::damage;
use crate::entities::centre_line::CENTRE_LINE;
use crate::entities::maps::INTERFEROGRAM;
use crate::entities::profile::PROFILE;
use crate::entities::series::{LIFE, POINT_CYCLES, YIELDED};
use crate::entities::trace::TRACE;
use crate::entities::{self, DAMAGE, kymograph, maps, slice, slice_over_log_depth, text, tooth};
use crate::plot::Margin;
use crate::research;
use crate::series::{by_itself, entity};
use crate::shown::{Knobs, ShownViews};
use asperity_engine::scene::ContactKind;
use asperity_engine::sim::{Dimension, named};
use asperity_picture::Subject;

/// All tabs of a run.
pub(crate) fn all(views: &mut Views, shown: &ShownViews) -> Vec<ContainerLike> {
    let mut tabs: Vec<ContainerLike> = passage(views, shown).into_iter().collect();
    tabs.extend(tooth(views, shown));
    tabs.push(lecture(views, shown));
    tabs.push(contact(views, shown));
    // The rows of a line contact are all alike: maps of it would be pictures of curves.
    if shown.kind == ContactKind::Point {
        tabs.push(maps_of_a_point(views, shown));
    }
    if shown.trace.is_some() {
        tabs.push(point(views, shown));
    }
    if shown.life {
        tabs.push(life(views, shown));
    }
    tabs.extend(damage_of_both(views, shown));
    tabs.extend(analysis(views, shown));
    tabs.extend(heat(views, shown));
    tabs.extend(race(views, shown));
    tabs.extend(ageing(views, shown));
    tabs.push(scalars(views, shown));
    tabs.push(convergence(views));
    tabs.push(scene(views));
    tabs
}

/// What an audience sees: the contact large, the life in large type, what a point feels, pressure over time.
fn lecture(views: &mut Views, shown: &ShownViews) -> ContainerLike {
    let large = match shown.lecture {
        Some(camera) => {
            views.lecture_space(&shown.said("Pressure on the film, stress below"), camera)
        }
        None => views.map(Subject::Pressure.title(), maps::PRESSURE, &[], &shown.map),
    };
    let mut right = vec![views.document("What is seen", text::LECTURE)];
    if let Some(plot) = &shown.trace {
        right.push(views.plot("A point that passes", &[TRACE], plot, Margin::Plain));
    }
    right.push(over_time(views, shown, shown.kind == ContactKind::Point));
    let mut shares = vec![0.9];
    shares.resize(right.len(), 1.0);
    Horizontal::new([large, Vertical::new(right).with_row_shares(shares).into()])
        .with_column_shares(vec![1.6, 1.0])
        .with_name("Lecture")
        .into()
}

/// Both gears turning with the contact on them, and what it is like over the path of contact.
fn tooth(views: &mut Views, shown: &ShownViews) -> Option<ContainerLike> {
    let tooth = shown.tooth.as_ref()?;
    let title = "Where on the tooth the contact is";
    let large = views.plot(title, &[tooth::GEARS], &tooth.gears, Margin::Plain);
    let left = Vertical::new([large, views.document("What is seen", text::LECTURE)])
        .with_row_shares(vec![1.7, 1.0]);
    let titles = [
        "Hertz pressure over the path of contact, GPa",
        "Slide-to-roll ratio S over the path of contact (thin: the tooth's own)",
        "Radius R of the tooth over the path of contact, mm",
    ];
    let paths = titles.iter().zip(tooth::PATHS).zip(&tooth.paths);
    let paths =
        paths.map(|((title, entity), plot)| views.plot(title, &[entity], plot, Margin::Plain));
    let right = Vertical::new(paths.collect::<Vec<_>>());
    let both = Horizontal::new([ContainerLike::from(left), right.into()]);
    let both = both.with_column_shares(vec![1.25, 1.0]);
    Some(both.with_name("Tooth").into())
}

/// What moves and what that does: both surfaces with the oil between them, under them what the point that rides on one has
/// felt; beside them the life in large type, and the pressure.
fn passage(views: &mut Views, shown: &ShownViews) -> Option<ContainerLike> {
    let title = "Both surfaces and the gap between them, along y = 0";
    let large = views.framed(title, &[PROFILE, TRACE], shown.profile?);
    let right = Vertical::new([
        views.document("What is seen", text::LECTURE),
        match shown.kind {
            ContactKind::Point => {
                let title = "Pressure, seen from above";
                views.map(title, maps::PRESSURE, &[], &shown.map)
            }
            ContactKind::Line => over_time(views, shown, true),
        },
    ]);
    let both = Horizontal::new([large, right.into()]).with_column_shares(vec![1.9, 1.0]);
    Some(both.with_name("Passage").into())
}

/// How much warmer than the bulk surfaces and film are: seen from above, and along y = 0 against time.
fn heat(views: &mut Views, shown: &ShownViews) -> Option<ContainerLike> {
    let mut all = Vec::new();
    let maps = shown
        .rises
        .iter()
        .filter(|_| shown.kind == ContactKind::Point);
    for (entity, subject) in maps {
        all.push(views.map(subject.title(), entity, &[], &shown.map));
    }
    // Short: at 1280 pixels a title has 200.
    let along = [
        ("Body 1", kymograph::SURFACE_1),
        ("Body 2", kymograph::SURFACE_2),
        ("Film", kymograph::OIL_RISE),
    ];
    for (_, (what, entity)) in shown.rises.iter().zip(along) {
        let title = format!("{what}, y = 0 over time");
        all.push(views.plot(&title, &[entity], &shown.kymograph, Margin::Legend));
    }
    if all.is_empty() {
        return None;
    }
    let greatest = by_itself().filter(|quantity| quantity.dimension == Dimension::Temperature);
    let curves = greatest.map(|quantity| {
        let label = quantity.label(shown.kind);
        views.single(&label, &entity(quantity, shown.kind))
    });
    // Pictures have titles and axes below and need the height that a third row would take.
    let parts = [
        Grid::new(all).with_grid_columns(3).into(),
        Vertical::new(curves).into(),
    ];
    let tab = Horizontal::new(parts).with_column_shares([3.0, 1.0]);
    Some(tab.with_name("Heat").into())
}

/// What a researcher looks for.
fn analysis(views: &mut Views, shown: &ShownViews) -> Option<ContainerLike> {
    let all = shown.research.iter().map(|what| {
        let entity = entities::research::entity(*what);
        views.plot(
            what.title(),
            &[&entity],
            &research::plot_box(),
            Margin::Plain,
        )
    });
    let all: Vec<ContainerLike> = all.collect();
    let grid = Grid::new(all).with_grid_columns(2).with_name("Analysis");
    (!shown.research.is_empty()).then(|| grid.into())
}

/// The damage that both bodies hold as wear carries it off, and what comes of it: pits, and the life.
fn race(views: &mut Views, shown: &ShownViews) -> Option<ContainerLike> {
    let maps = (1..).zip(shown.suffered).map(|(body, entity)| {
        let title = format!("Damage that body {body} holds: a pit from 0 on");
        views.plot(&title, &[*entity], &damage::plot_box(), Margin::Legend)
    });
    let mut all: Vec<ContainerLike> = maps.collect();
    let is_empty = all.is_empty();
    all.extend(over_cycles(views, shown, AgeCurves::is_of_the_race));
    let grid = Grid::new(all).with_grid_columns(2);
    (!is_empty).then(|| grid.with_name("Pits").into())
}

/// What surfaces come to over loading cycles.
fn ageing(views: &mut Views, shown: &ShownViews) -> Option<ContainerLike> {
    let races = !shown.suffered.is_empty();
    let all = over_cycles(views, shown, |curves| !races || !curves.is_of_the_race());
    let is_empty = all.is_empty();
    let grid = Grid::new(all).with_grid_columns(3);
    (!is_empty).then(|| grid.with_name("Ageing").into())
}

fn over_cycles(
    views: &mut Views,
    shown: &ShownViews,
    which: impl Fn(&AgeCurves) -> bool,
) -> Vec<ContainerLike> {
    let own = shown.ages.iter().filter(|curves| which(curves));
    let plot =
        own.map(|curves| views.plot(curves.title, &[curves.entity], &ages::plot(), Margin::Plain));
    plot.collect()
}

fn over_time(views: &mut Views, shown: &ShownViews, pressure: bool) -> ContainerLike {
    let (title, entity) = if pressure {
        ("Pressure along y = 0 against time", kymograph::PRESSURE)
    } else {
        ("Film along y = 0 against time", kymograph::FILM)
    };
    views.plot(
        &shown.said(title),
        &[entity],
        &shown.kymograph,
        Margin::Legend,
    )
}

fn contact(views: &mut Views, shown: &ShownViews) -> ContainerLike {
    let mut upper = Vec::new();
    let mut shares = Vec::new();
    if let Some(camera) = shown.camera {
        upper.push(views.space("Contact cut open at y = 0", camera));
        shares.push(1.25);
    }
    match shown.kind {
        ContactKind::Point => {
            let film = shown.said(Subject::Film.title());
            upper.push(views.map(Subject::Pressure.title(), maps::PRESSURE, &[], &shown.map));
            upper.push(views.map(&film, maps::FILM, &[maps::CONTACT], &shown.map));
        }
        ContactKind::Line => {
            upper.push(over_time(views, shown, true));
            upper.push(over_time(views, shown, false));
        }
    }
    shares.extend([1.0, 1.0]);
    let mut lower = vec![views.document("Now", text::NOW)];
    let mut lower_shares = vec![0.75];
    if let Some(stress) = stress(views, shown, "") {
        lower.push(stress);
        lower_shares.push(1.0);
    }
    let centre = shown.said("Centre line: pressure and film");
    lower.push(views.plot(&centre, &[CENTRE_LINE], &shown.centre_line, Margin::Ticks));
    lower_shares.push(1.0);
    let last = if shown.life {
        life_series(views, shown)
    } else {
        pressure_series(views)
    };
    lower.push(last);
    lower_shares.push(0.7);
    Vertical::new([
        Horizontal::new(upper).with_column_shares(shares).into(),
        Horizontal::new(lower)
            .with_column_shares(lower_shares)
            .into(),
    ])
    .with_row_shares(vec![1.1, 1.0])
    .with_name("Contact")
    .into()
}

/// The effective stress with its maximum and the followed point: of a line over the logarithm of the depth; else a row
/// for each of the solver's depths, which crowd below the surface as on such an axis.
/// The `name` of a run of several ends the title.
pub(crate) fn stress(views: &mut Views, shown: &ShownViews, name: &str) -> Option<ContainerLike> {
    if let Some(plot) = &shown.over_log {
        let contents = [
            slice_over_log_depth::EFFECTIVE,
            slice_over_log_depth::MARKS,
            slice_over_log_depth::HERTZ,
        ];
        let title = format!("Stress σ_eff over log depth{name}");
        return Some(views.plot(&title, &contents, plot, Margin::Legend));
    }
    let contents = [slice::EFFECTIVE, slice::PEAK, slice::POINT, slice::HERTZ];
    let title = format!("Effective stress, a row per depth{name}");
    Some(views.plot(&title, &contents, shown.slice.as_ref()?, Margin::Legend))
}

/// The life over time; of surfaces that age over the cycles: each block begins its averages anew.
fn life_series(views: &mut Views, shown: &ShownViews) -> ContainerLike {
    match shown.ages.iter().find(|curves| curves.is_life()) {
        Some(aged) => views.plot(aged.title, &[aged.entity], &ages::plot(), Margin::Plain),
        None => views.named("Life, log10", &[LIFE]),
    }
}

fn maps_of_a_point(views: &mut Views, shown: &ShownViews) -> ContainerLike {
    let map = &shown.map;
    let fringes = Subject::Interferogram.title();
    // Where no oil is there is no film to be seen by its colours.
    let mut all: Vec<_> = (!shown.is_dry())
        .then(|| views.map(fringes, INTERFEROGRAM, &[], &shown.interferogram))
        .into_iter()
        .collect();
    if shown.slides() {
        all.push(views.map(Subject::Traction.title(), maps::TRACTION, &[], map));
    }
    for (rough, subject, entity) in [
        (shown.rough[0], Subject::Roughness1, maps::ROUGHNESS_1),
        (shown.rough[1], Subject::Roughness2, maps::ROUGHNESS_2),
    ] {
        if rough {
            all.push(views.map(subject.title(), entity, &[], map));
        }
    }
    all.extend(shear(views, shown));
    all.push(over_time(views, shown, true));
    all.push(over_time(views, shown, false));
    if all.len() % 4 == 3 {
        all.push(views.document("Now", text::NOW));
    }
    let columns = if all.len() > 6 { 4 } else { 3 };
    let grid = Grid::new(all).with_grid_columns(columns);
    grid.with_name("Maps").into()
}

fn shear(views: &mut Views, shown: &ShownViews) -> Option<ContainerLike> {
    if let Some(plot) = &shown.over_log {
        let contents = [slice_over_log_depth::TAU_XZ, slice_over_log_depth::HERTZ];
        let title = "Shear τxz over log depth";
        return Some(views.plot(title, &contents, plot, Margin::Legend));
    }
    let contents = [slice::TAU_XZ, slice::HERTZ];
    let title = "Shear τxz, a row per depth";
    Some(views.plot(title, &contents, shown.slice.as_ref()?, Margin::Legend))
}

fn point(views: &mut Views, shown: &ShownViews) -> ContainerLike {
    let mut upper = Vec::new();
    if let Some(plot) = &shown.trace {
        let title = "What the followed point has felt";
        upper.push(views.plot(title, &[TRACE], plot, Margin::Plain));
    }
    match shown.kind {
        ContactKind::Point => {
            let contents = [slice::EFFECTIVE, slice::POINT];
            let plot = shown.slice.iter();
            upper.extend(
                plot.map(|plot| views.plot("Where the point is", &contents, plot, Margin::Legend)),
            );
        }
        ContactKind::Line => {
            upper.extend(stress(views, shown, ""));
            upper.extend(shear(views, shown));
        }
    }
    let cycles = [POINT_CYCLES, "material_point/cycles/formula"];
    let (stress, place) = ("material_point/stress_GPa", "material_point/position_mm");
    let lower = vec![
        views.named("At the point, GPa", &[stress]),
        views.named("Peaks in this crossing", &cycles),
        views.named("Where the point is, mm", &[place]),
    ];
    let mut shares = vec![1.6];
    shares.resize(upper.len(), 1.0);
    Vertical::new([
        Horizontal::new(upper).with_column_shares(shares).into(),
        Horizontal::new(lower).into(),
    ])
    .with_row_shares(vec![1.3, 1.0])
    .with_name("Material point")
    .into()
}

fn life(views: &mut Views, shown: &ShownViews) -> ContainerLike {
    let left = Vertical::new([
        life_series(views, shown),
        views.named("log10", &["life/log10_factors", "life/log10_factors/load"]),
    ]);
    let contacts = |views: &mut Views, body: usize| {
        let entity = |of: &str| format!("life/contacts_per_cycle/n_{body}_{of}");
        let (formula, counted) = (entity("formula"), entity("counted"));
        let title = format!("n of body {body}");
        views.named(&title, &[&formula, &counted])
    };
    let middle = Vertical::new([
        contacts(views, 1),
        contacts(views, 2),
        views.single("Maximum effective stress, GPa", "series/stress_GPa"),
    ]);
    let mut right = vec![views.document("Now", text::NOW)];
    if shown.knobs == Knobs::Turn {
        right.push(views.named("Motion", &["series/motion"]));
    }
    let right = Vertical::new(right);
    Horizontal::new([left, middle, right].map(ContainerLike::from))
        .with_column_shares(vec![1.0, 0.9, 0.8])
        .with_name("Life")
        .into()
}

/// What collects in both bodies and where the pit starts; `None`: nothing is mapped.
fn damage_of_both(views: &mut Views, shown: &ShownViews) -> Option<ContainerLike> {
    let bodies = (0..2).filter(|&body| shown.damaged[body]);
    let maps = bodies.map(|body| {
        let title = format!(
            "Damage of body {}, worst of the smooth contact = 0",
            body + 1
        );
        let contents = [DAMAGE[body]];
        views.plot(&title, &contents, &damage::plot_box(), Margin::Legend)
    });
    let maps: Vec<ContainerLike> = maps.collect();
    (!maps.is_empty()).then(|| Horizontal::new(maps).with_name("Damage").into())
}

fn pressure_series(views: &mut Views) -> ContainerLike {
    views.named("Pressure, GPa", &["series/pressure_GPa"])
}

/// Every scalar against time, where it has no better place.
fn scalars(views: &mut Views, shown: &ShownViews) -> ContainerLike {
    let kind = shown.kind;
    let mut all = vec![
        pressure_series(views),
        views.named(&shown.said("Film, µm"), &["series/film_um"]),
        views.named("Contact, %", &["series/contact_percent"]),
    ];
    if shown.slides() {
        all.push(views.single("Friction coefficient", "series/friction"));
    }
    if shown.knobs == Knobs::Turn {
        let load = match kind {
            ContactKind::Point => ("Load, N", "series/load_N"),
            ContactKind::Line => ("Load, N/m", "series/load_N_per_m"),
        };
        all.extend([
            views.named(load.0, &[load.1]),
            views.named("Hertz half-width, µm", &["series/half_width_um"]),
            views.single("λ ratio", "series/lambda_ratio"),
        ]);
        if !shown.is_dry() {
            all.push(views.single("Regime: 0 dry to 3 full film", "series/regime"));
        }
    }
    if shown.yields {
        let title = match kind {
            ContactKind::Point => "Yielded for good, µm³",
            ContactKind::Line => "Yielded for good, µm³ per metre",
        };
        all.push(views.named(title, &[YIELDED]));
    }
    // What is of heat has a tab of its own, and nothing shears the surfaces of bodies that roll.
    let shear = const { named("traction_max_pa") };
    let known = by_itself()
        .filter(|quantity| quantity.dimension != Dimension::Temperature)
        .filter(|quantity| quantity.name != shear.name || shown.slides());
    for quantity in known {
        all.push(views.single(&quantity.label(kind), &entity(quantity, kind)));
    }
    Grid::new(all)
        .with_grid_columns(3)
        .with_name("Scalars")
        .into()
}

fn convergence(views: &mut Views) -> ContainerLike {
    Grid::new([
        views.named("Errors, log10", &["convergence/log10_errors"]),
        views.named("Iterations", &["convergence/iterations"]),
        views.switches("Cautions (1: holds)", "series/cautions"),
        TextLogView::new("Log").with_origin("/log").into(),
    ])
    .with_grid_columns(2)
    .with_name("Convergence")
    .into()
}

/// What runs, while there is no picture of it.
pub(crate) fn before_the_first_frame(views: &mut Views) -> ContainerLike {
    let about = views.document("Starts: pictures come with its first step", text::ABOUT);
    Horizontal::new([about, views.document("Plan", text::PLAN)])
        .with_name("Starts")
        .into()
}

fn scene(views: &mut Views) -> ContainerLike {
    Horizontal::new([
        views.document("About", text::ABOUT),
        views.document("Scene (TOML)", text::SCENE_TOML),
        Vertical::new([
            views.document("Plan", text::PLAN),
            views.document("Notes on the data", text::NOTES),
        ])
        .into(),
    ])
    .with_name("Scene")
    .into()
}
