//! Views that are drawn for looking at: the profile of both surfaces, the tooth of a gear, the logarithm of depth.
#![cfg(feature = "rerun")]
#![expect(clippy::unwrap_used, reason = "tests")]

use super::common::synthetic;
use super::recording::{Contents, record_scene};
use asperity_engine::scene::Tooth;

const NODES: usize = 33;
const STEPS: u64 = 8;

fn contents(tooth: Option<Tooth>) -> Contents {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.rrd");
    let mut scene = synthetic::scene(NODES, 0.25);
    scene.tooth = tooth;
    let frames: Vec<_> = (1..=STEPS)
        .map(|step| synthetic::frame(NODES, step))
        .collect();
    record_scene(&path, scene, &frames);
    Contents::read(&path)
}

#[test]
fn the_profile_has_the_gap_to_scale_in_every_picture() {
    let contents = contents(None);
    let pictures = STEPS as usize;
    let stress = contents.pictures("profile_y0/effective_stress_GPa/image");
    assert_eq!(stress.len(), pictures);
    // No more than half precision would take.
    assert!(stress.values().all(|bytes| bytes.len() <= 2 * 120 * 54));
    let values = contents.values("profile_y0/effective_stress_GPa/image");
    assert!(values.values().all(|values| values.len() == 120 * 54));
    let oil = contents.strips("profile_y0/oil");
    assert_eq!(oil.len(), pictures);
    // mm of the picture for a m of height: the axis is what can come, and the same in all of them.
    let mut scales = Vec::new();
    for (step, columns) in &oil {
        let frame = synthetic::frame(NODES, *step as u64);
        let row = frame.ny / 2 * frame.nx;
        assert_eq!(columns.len(), 192);
        // Columns end round: by so much they are shorter at both ends.
        let round = f64::from(columns[1][0][0] - columns[0][0][0]) * 0.8;
        for column in columns {
            let [[x, lower], [_, upper]] = [column[0], column[1]].map(|at| at.map(f64::from));
            let place = (x * 1e-3 - frame.x_min_m) / frame.dx_m;
            let (i, part) = (place.floor() as usize, place.fract());
            let film = |i: usize| f64::from(frame.film_m[row + i]);
            let film = film(i) * (1.0 - part) + film((i + 1).min(NODES - 1)) * part;
            // In the contact, where no surface leaves the picture.
            if (x * 1e-3 / frame.a_m).abs() < 0.7 && lower - upper > 1e-6 {
                scales.push((lower - upper + 2.0 * round) / film);
            }
        }
    }
    let (least, most) = scales
        .iter()
        .fold((f64::MAX, 0.0_f64), |(low, high), scale| {
            (low.min(*scale), high.max(*scale))
        });
    assert!(
        scales.len() > 8 * pictures && most / least < 1.001,
        "{least} {most}"
    );
    assert!(
        contents
            .entities()
            .iter()
            .all(|path| !path.starts_with("/tooth"))
    );
    assert!(
        contents
            .entities()
            .iter()
            .all(|path| !path.contains("log_depth"))
    );
}

#[test]
fn a_ride_shows_where_on_the_tooth_it_is() {
    let frame = synthetic::frame(NODES, STEPS);
    // So fast that the last step is at 6 of some 19 mm.
    let base_m = 0.5 * 16.0 * 4.5e-3 * 20_f64.to_radians().cos();
    let speed_rpm = 6e-3 / (base_m * frame.time_s) * 30.0 / std::f64::consts::PI;
    let contents = contents(Some(Tooth {
        pinion_teeth: 16,
        wheel_teeth: 24,
        module_m: 4.5e-3,
        pressure_angle_deg: 20.0,
        centre_distance_m: 91.5e-3,
        pinion_tip_diameter_m: 82.46e-3,
        wheel_tip_diameter_m: 118.36e-3,
        speed_rpm,
    }));
    let contact = contents.places("tooth/gears/contact");
    assert_eq!(contact.len(), STEPS as usize);
    let place = |step: u64| contact[&(step as i64)][0].map(f64::from);
    let [[x0, y0], [x1, y1]] = [place(1), place(STEPS)];
    // It goes along the line of action, inclined by the working angle of 22.44 degrees, as fast as the base circle turns.
    let angle = ((y0 - y1) / (x1 - x0)).atan().to_degrees();
    assert!((angle - 22.44).abs() < 0.01, "{angle}");
    let way = (x1 - x0).hypot(y1 - y0);
    let expected = 6.0 * (STEPS - 1) as f64 / STEPS as f64;
    assert!((way / expected - 1.0).abs() < 1e-3, "{way} {expected}");
    // The run's own pressure is on the axis of the path: where the contact is.
    let now = contents.places("tooth/path/hertz_pressure_GPa/now");
    let at = f64::from(now[&(STEPS as i64)][0][0]);
    assert!((at - 6.0).abs() < 1e-3, "{at}");
    for gear in ["tooth/gears/pinion", "tooth/gears/wheel"] {
        let outline = contents.strips(gear);
        assert_eq!(outline.len(), STEPS as usize);
        assert!(
            outline
                .values()
                .all(|strips| strips.iter().flatten().count() > 20)
        );
    }
}
