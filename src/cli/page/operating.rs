//! What a scene is, in rows of a report.

use asperity_engine::math::number::{GPA, MM, UM, sig};
use asperity_engine::physics::fluid::Rheology;
use asperity_engine::scene::{Body, Lubricant, Scene, Surface};

/// Bodies, oil, surfaces and model of a scene. What a sweep varies along its path is not among them.
pub(super) fn rows(scene: &Scene) -> Vec<(String, String)> {
    let mut rows = vec![("contact".to_owned(), contact(scene))];
    for (n, body) in [&scene.body_1, &scene.body_2].into_iter().enumerate() {
        rows.push((format!("body {}", n + 1), solid(body)));
        for line in surface(&body.surface) {
            rows.push((format!("surface {}", n + 1), line));
        }
    }
    match &scene.lubricant {
        Some(oil) => rows.extend(fluid(oil).map(|what| ("oil".to_owned(), what))),
        None => rows.push(("oil".to_owned(), "none: dry".to_owned())),
    }
    let friction = sig(scene.friction.boundary, 3);
    rows.push((
        "friction".to_owned(),
        format!("coefficient {friction} where surfaces touch"),
    ));
    if let Some(heat) = &scene.heat {
        let bulk = sig(heat.bulk_k - 273.15, 4);
        rows.push((
            "heat".to_owned(),
            format!("bulk {bulk} °C; {}", scene.warming().words()),
        ));
    }
    rows
}

fn contact(scene: &Scene) -> String {
    let hertz = scene.hertz();
    let across = match scene.contact.ry_m {
        Some(ry_m) => format!(", across {} mm", sig(MM * ry_m, 4)),
        None => ", a line".to_owned(),
    };
    format!(
        "R {} mm{across}; Hertz pressure {}, half-width {}; U {} m/s, S = {}",
        sig(MM * scene.contact.rx_m, 4),
        GPA.show(hertz.p_max_pa, 4),
        UM.show(hertz.a_m, 4),
        sig(scene.motion.entrainment_m_s, 4),
        sig(scene.motion.slide_roll, 3)
    )
}

fn solid(body: &Body) -> String {
    let hardness = match body.hardness_pa.filter(|pa| pa.is_finite()) {
        Some(pa) => format!(", hardness {}", GPA.show(pa, 3)),
        None => ", elastic".to_owned(),
    };
    format!(
        "E {}, Poisson's ratio {}{hardness}",
        GPA.show(body.young_pa, 4),
        sig(body.poisson, 3)
    )
}

fn surface(surface: &Surface) -> Vec<String> {
    let rough = format!(
        "Rq {}, Ra {}",
        UM.show(surface.rq_m(), 3),
        UM.show(surface.ra_m(), 3)
    );
    match surface {
        Surface::Smooth {} => vec!["smooth".to_owned()],
        Surface::Sinusoid {
            amplitude_m,
            wavelength_x_m,
            wavelength_y_m,
            ..
        } => {
            let wave = |length_m: f64| {
                if length_m.is_finite() {
                    UM.show(length_m, 4)
                } else {
                    "endless".to_owned()
                }
            };
            vec![format!(
                "sinusoid, an assumed one: amplitude {}, waves {} along and {} across; {rough}",
                UM.show(*amplitude_m, 3),
                wave(*wavelength_x_m),
                wave(*wavelength_y_m)
            )]
        }
        Surface::Random(_) | Surface::HeightMap { .. } => {
            let mut lines = surface.relief_lines();
            lines.push(rough);
            lines
        }
    }
}

fn fluid(oil: &Lubricant) -> impl Iterator<Item = String> {
    let rheology = match oil.rheology {
        Rheology::Newtonian => "Newtonian".to_owned(),
        Rheology::Eyring => format!("Eyring stress {} MPa", sig(1e-6 * oil.eyring_stress_pa, 3)),
    };
    let own = format!(
        "{} Pa s, pressure-viscosity coefficient {} 1/GPa, {rheology}, at most {} of the pressure as shear",
        sig(oil.viscosity_pa_s(), 4),
        sig(1e9 * oil.pressure_viscosity_per_pa(), 3),
        sig(oil.limiting_shear_ratio, 3)
    );
    oil.conversion().into_iter().chain([own])
}
