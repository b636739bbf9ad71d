//! The decisions, one function each: what a scene needs, and why a stage is left out.

use super::LifeAsked;
use super::{
    Crests, Domain, EDGES_WORTH_A_WORD, FilmPlan, LeftOut, MOLECULE_M, OtherFilms, Plan,
    StressPlan, Symmetry, TimeDependence, TractionDeflection, Valleys, Warning,
};
use crate::math::number::fixed;
use crate::physics::film_regression;
use crate::physics::groups::Groups;
use crate::physics::hertz::Hertz;
use crate::physics::strength::is_steel;
use crate::scene::{
    ContactKind, CycleBasis, EyringFlow, Knob, Order, OrderAsked, Rheology, Scene, Spread, Surface,
    SurfaceKind,
};

/// What the regression formulas say of a film.
struct Regression {
    groups: Groups,
    central_m: f64,
    others: OtherFilms,
    radii_ratio: f64,
    ellipticity: f64,
}

fn regression(scene: &Scene, hertz: &Hertz) -> Option<Regression> {
    Some(match scene.kind() {
        ContactKind::Point => {
            let point = scene.operating_point()?;
            Regression {
                groups: point.groups(),
                central_m: film_regression::nijenbanning_central_m(&point),
                others: OtherFilms::HamrockDowson {
                    central_m: film_regression::hamrock_dowson_central_m(&point),
                    minimum_m: film_regression::hamrock_dowson_minimum_m(&point),
                },
                radii_ratio: point.rx_m / point.ry_m,
                ellipticity: hertz.b_m / hertz.a_m,
            }
        }
        ContactKind::Line => {
            let line = scene.line_point()?;
            Regression {
                groups: line.groups(),
                central_m: line.moes_central_m(),
                others: OtherFilms::DowsonHigginson {
                    minimum_m: line.dowson_higginson_minimum_m(),
                },
                radii_ratio: 0.0,
                ellipticity: 1.0,
            }
        }
    })
}

pub(super) fn film_plan(scene: &Scene, hertz: &Hertz) -> Option<FilmPlan> {
    let by_formula = regression(scene, hertz)?;
    let central_m = by_formula.central_m;
    let mut film = FilmPlan {
        groups: by_formula.groups,
        central_m,
        others: by_formula.others,
        central: central_m * scene.contact.rx_m / (hertz.a_m * hertz.a_m),
        lambda_ratio: None,
        radii_ratio: by_formula.radii_ratio,
        ellipticity: by_formula.ellipticity,
        valleys: valleys(scene),
        eyring_flow: eyring_flow(scene),
        order: scene.numerics.order,
    };
    film.lambda_ratio = film.lambda(scene.composite_rq_m());
    Some(film)
}

fn eyring_flow(scene: &Scene) -> Option<EyringFlow> {
    let oil = scene.lubricant.as_ref()?;
    match oil.rheology {
        Rheology::Newtonian => None,
        Rheology::Eyring => Some(oil.eyring_flow),
    }
}

fn valleys(scene: &Scene) -> Valleys {
    let kind = scene.kind();
    let leads_out = |surface: &Surface| match surface {
        Surface::Smooth {} => true,
        Surface::Sinusoid {
            wavelength_x_m,
            wavelength_y_m,
            ..
        } => {
            kind == ContactKind::Point
                && (wavelength_x_m.is_infinite() || wavelength_y_m.is_infinite())
        }
        Surface::Random(_) | Surface::HeightMap { .. } => false,
    };
    let surfaces = scene.surfaces();
    let is_map = |surface: &Surface| match surface.kind() {
        SurfaceKind::Smooth | SurfaceKind::Sinusoid => false,
        SurfaceKind::Random | SurfaceKind::HeightMap => true,
    };
    if surfaces.iter().any(|surface| leads_out(surface))
        && !surfaces.iter().any(|surface| is_map(surface))
    {
        Valleys::Open
    } else {
        Valleys::Closed
    }
}

pub(super) fn domain_warnings(domain: &Domain, film: Option<&FilmPlan>) -> Vec<Warning> {
    /// Error of the film by the mesh above which the user is told.
    const WORTH_A_WORD: f64 = 0.05;
    let Some(film) = film else {
        return Vec::new();
    };
    if !film.is_film() {
        return vec![Warning::NoFilm {
            film_m: film.central_m,
            valleys: film.valleys,
        }];
    }
    let mut warnings = Vec::new();
    let truncation = film.truncation();
    let mesh = truncation.mesh_error(domain.dx_a());
    if mesh > WORTH_A_WORD {
        warnings.push(Warning::CoarseForTheFilm { error: mesh });
    }
    let error = domain.edge_error(&truncation);
    if error > EDGES_WORTH_A_WORD {
        warnings.push(Warning::ShortDomain {
            error,
            x_min_a: domain.x_min_a,
            kind: truncation.kind,
        });
    }
    warnings
}

/// Heights of both surfaces' crests together, m: the most that the scene or its events ask for.
pub(super) fn crest_m(scene: &Scene) -> f64 {
    let surfaces = scene.surfaces();
    let heights = [0, 1].map(|body: usize| {
        let own = surfaces[body].amplitude_m().abs();
        scripted(scene, Knob::AMPLITUDES[body])
            .map(f64::abs)
            .fold(own, f64::max)
    });
    heights.iter().sum()
}

/// Values that events give a knob.
fn scripted(scene: &Scene, knob: Knob) -> impl Iterator<Item = f64> {
    let sets = scene.events.iter().map(|event| &event.set);
    let values = sets.filter_map(move |set| set.get(knob.key()));
    values.copied()
}

/// Size of the largest contact that events make, over the scene's own: Hertz.
pub(super) fn maximum_size(scene: &Scene) -> f64 {
    let own = scene.force_n();
    let most = scripted(scene, Knob::of_load(scene.kind())).fold(own, f64::max);
    scene.kind().size_ratio(most / own)
}

/// Longest step, a, that high order is taken with by the mesh: 33 nodes with steps of 3 and 4 nodes (.42 and .56 a) make a smooth
/// film of 695 nm 1.6 and 2.0 times as thick, of second order 0.56 and 0.82 times. At .28 a high order errs less (65 nodes,
/// steps of 4: 1.11 against 0.43).
const LONGEST_HIGH_STEP_A: f64 = 0.3;

/// Order of the discretisation; without a film that of the deflection.
pub(super) fn order(scene: &Scene, film: Option<&FilmPlan>, domain: &Domain) -> Order {
    let asked = scene.numerics.order;
    let is_long = scene.time.step_nodes * domain.dx_a() > LONGEST_HIGH_STEP_A;
    match (asked, film) {
        (_, None) => asked.order(false),
        (OrderAsked::ByMesh, Some(_)) if is_long => Order::Second,
        (OrderAsked::Second | OrderAsked::High | OrderAsked::ByMesh, Some(film)) => {
            film.truncation().order(domain.dx_a())
        }
    }
}

/// Crests `crests_m` high together.
pub(super) fn crests(scene: &Scene, hertz: &Hertz, crests_m: f64) -> Crests {
    let (rx_m, height) = (scene.contact.rx_m, crests_m);
    // A line has no side.
    let across = scene
        .contact
        .ry_m
        .map_or(0.0, |ry_m| ry_m / hertz.b_m.powi(2));
    Crests {
        along: height * rx_m / hertz.a_m.powi(2),
        across: height * across,
    }
}

pub(super) fn symmetry(scene: &Scene) -> Symmetry {
    if scene.kind() == ContactKind::Line {
        Symmetry::Line
    } else if scene
        .surfaces()
        .iter()
        .all(|surface| surface.is_even_in_y())
    {
        Symmetry::MirrorY
    } else {
        Symmetry::General
    }
}

pub(super) fn time_dependence(scene: &Scene) -> TimeDependence {
    let surfaces = scene.surfaces();
    // A caption alone is a moment, too: one solution would have none for it.
    if !scene.events.is_empty() {
        TimeDependence::Transient
    } else if surfaces.iter().all(|surface| surface.is_smooth()) {
        TimeDependence::Steady {
            why: "both surfaces are smooth, so nothing changes in time",
        }
    } else if surfaces.iter().all(|surface| !surface.varies_along_x()) {
        TimeDependence::Steady {
            why: "the ridges lie along the rolling direction, so nothing changes in time",
        }
    } else {
        TimeDependence::Transient
    }
}

/// Events after the end of a run of that distance.
pub(super) fn late_events(scene: &Scene, distance_m: f64) -> impl Iterator<Item = Warning> {
    let end_s = distance_m / scene.motion.entrainment_m_s.abs();
    let late = scene.events.iter().filter(move |event| event.at_s > end_s);
    late.map(move |event| Warning::LateEvent {
        at_s: event.at_s,
        end_s,
    })
}

/// Bodies that are not steel and whose heat the scene does not describe, where it is followed.
pub(super) fn thermal_unknown(scene: &Scene) -> impl Iterator<Item = Warning> {
    let bodies = (1..).zip([&scene.body_1, &scene.body_2]);
    let unknown = bodies.filter(|(_, body)| {
        scene.heat.is_some() && body.heat.is_none() && !is_steel(body.young_pa)
    });
    unknown.map(|(body, of)| Warning::ThermalUnknown {
        body,
        young_pa: of.young_pa,
    })
}

pub(super) fn traction_deflection(scene: &Scene) -> Option<TractionDeflection> {
    let compliance =
        |young_pa: f64, poisson: f64| (1.0 + poisson) * (1.0 - 2.0 * poisson) / young_pa;
    let one = compliance(scene.body_1.young_pa, scene.body_1.poisson);
    let two = compliance(scene.body_2.young_pa, scene.body_2.poisson);
    let mismatch_per_pa = one - two;
    // Equal constants give exactly 0; the bound is for constants that differ in the last digit.
    (mismatch_per_pa.abs() > 1e-12 * one.max(two)).then_some(TractionDeflection { mismatch_per_pa })
}

pub(super) fn stress_plan(
    scene: &Scene,
    hertz: &Hertz,
    warnings: &mut Vec<Warning>,
) -> Option<StressPlan> {
    let stress = scene.stress.as_ref()?;
    if scene.life.is_some() && stress.depth_max_a < 2.0 {
        warnings.push(Warning::ShallowStress {
            depth_max_a: stress.depth_max_a,
        });
    }
    // For an ellipse the stress reaches as deep as its narrow side says.
    Some(StressPlan {
        depths: stress.depths,
        depth_max_m: stress.depth_max_a * hertz.a_m.min(hertz.b_m),
    })
}

/// Whether what passes are waves alone, in conditions that stay, and the life counts what a settled one has seen.
pub(super) fn may_settle(scene: &Scene, time_dependence: TimeDependence) -> bool {
    let is_wave = |surface: &Surface| match surface {
        Surface::Smooth {} | Surface::Sinusoid { .. } => true,
        Surface::Random(_) | Surface::HeightMap { .. } => false,
    };
    let is_counted = scene.life.as_ref().is_some_and(|life| match life.cycles {
        CycleBasis::Damage | CycleBasis::Global => true,
        // A mean over the few points that have left: its settling says nothing of them.
        CycleBasis::Peaks => false,
    });
    time_dependence == TimeDependence::Transient
        && is_counted
        && scene.surfaces().into_iter().all(is_wave)
        && scene.events.is_empty()
        // What a loading cycle wears off is a mean over all places that have met.
        && scene.wear.is_none()
        && scene.age.is_none()
}

/// What a scene with `[life]` does not compute.
fn leave_parts_of_life(asked: &LifeAsked, leave: &mut impl FnMut(&'static str, &str)) {
    if !asked.volumes() {
        leave(
            "stress volume",
            "the life model looks at the plane y = 0 only, and life.spread does not ask for the others",
        );
    }
    match asked.spread {
        Spread::Off => leave("spread over models", "life.spread is \"off\""),
        Spread::Cycles => leave("other life models", "life.spread is \"cycles\""),
        Spread::Models => {}
    }
    match asked.maps {
        [true, true] => {}
        [true, false] => leave("damage map of body 2", "life.damage_map is \"body_1\""),
        [false, true] => leave("damage map of body 1", "life.damage_map is \"body_2\""),
        [false, false] => leave("damage maps", "life.damage_map is \"off\""),
    }
    if asked.calibration.is_none() {
        leave(
            "absolute life",
            "the scene gives no calibration point (life.calibration_cycles): lives are relative",
        );
    }
}

pub(super) fn left_out(scene: &Scene, plan: &Plan) -> Vec<LeftOut> {
    let mut list = Vec::new();
    let mut leave = |stage: &'static str, why: &str| {
        list.push(LeftOut {
            stage,
            why: why.to_owned(),
        });
    };
    match &scene.lubricant {
        None => leave("film and flow", "the scene has no [lubricant]: dry contact"),
        Some(_) if !plan.has_flow() => {
            let film_nm = plan.film.map_or(0.0, |film| 1e9 * film.central_m);
            leave(
                "film and flow",
                &format!(
                    "film by formula {} nm, less than one layer of molecules ({:.1} nm): solved dry",
                    fixed(film_nm, 2),
                    1e9 * MOLECULE_M
                ),
            );
        }
        Some(oil) if oil.rheology == Rheology::Newtonian => {
            leave("shear thinning", "lubricant.rheology is \"newtonian\"");
        }
        Some(_) => {}
    }
    for (wave, stage) in plan
        .waves
        .iter()
        .zip(["waves of body 1", "waves of body 2"])
    {
        if wave.is_none() {
            leave(stage, "its surface is smooth");
        }
    }
    if let TimeDependence::Steady { why } = plan.time_dependence {
        leave("time steps", why);
    }
    match plan.symmetry {
        Symmetry::MirrorY => leave(
            "rows y < 0",
            "both surfaces are symmetric in y, so half of the rows is enough",
        ),
        Symmetry::Line => leave("flow and gap along y", "line contact: uniform along y"),
        Symmetry::General => {}
    }
    if plan.traction_deflection.is_none() {
        leave(
            "deflection by traction",
            "both bodies have the same elastic constants, so it is zero",
        );
    }
    if plan.stress.is_none() {
        leave("subsurface stress", "the scene has no [stress]");
    }
    if let Some(life) = plan.life {
        leave_parts_of_life(&life.asked, &mut leave);
        for (surface, stage) in scene
            .surfaces()
            .into_iter()
            .zip(["damage of body 1", "damage of body 2"])
        {
            if !surface.has_block() {
                leave(
                    stage,
                    "its height map occurs once only, so no place on it comes back",
                );
            }
        }
    } else {
        leave("fatigue life", "the scene has no [life]");
    }
    if plan.record.is_none() {
        leave(
            "recording",
            "none is asked for (--no-record, or no [record])",
        );
    }
    list
}
