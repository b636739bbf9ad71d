//! Paths: a gear tooth along its line of action, a ball round its race, a cam's flank.
//!
//! A path makes one case of every point by closed forms ([`asperity_engine::physics::gear`],
//! [`asperity_engine::physics::race_and_cam`]) and adds columns that say where the point is. `path.csv` holds all that
//! is known before anything is simulated: R, U1, U2, S, load, p_h, film by regression, λ, n of both bodies.
//!
//! ```toml
//! [gear]                              # the base scene must be a line contact; body 1 is the pinion, which drives
//! teeth = [16, 24]
//! module_m = 0.0045                   # or pitch_radii_m = [0.036, 0.054], the reference circles
//! pressure_angle_deg = 20.0
//! centre_distance_m = 0.0915          # left out: m (z1 + z2)/2
//! tip_diameters_m = [0.08246, 0.11836]     # left out: m (z + 2)
//! face_width_m = 0.014
//! torque_n_m = 200.0                  # of the pinion
//! speed_rpm = 1500.0                  # of the pinion
//! load_sharing = "half"               # "half", "trapezoid" (1/3 to 2/3) or "whole"
//! points = 17                         # evenly from A to E; B, C and D beside
//! spectrum = [                        # in place of torque_n_m and speed_rpm: what the pair carries, and for which part of
//!     { torque_n_m = 200.0, speed_rpm = 1500.0, time_share = 0.8 },     # its time; each step goes along the tooth
//!     { torque_n_m = 350.0, speed_rpm = 1000.0, time_share = 0.2 },
//! ]
//! ```
//! A `[cam]` goes along the flank, or along `angles_deg = [from, to]` of it, from the nose. Round the nose both
//! surfaces move against each other, |S| > 2: a scene's S ends at ±2 (one surface stands), so such angles are
//! refused by name.

use std::f64::consts::PI;

use toml::{Table, Value};

use super::axis::VariedKey;
use super::reader::{TableReader, both, shown};
use super::ring::Ring;
use asperity_engine::physics::gear::{GearPair, GearTeeth, LoadSharing};
use asperity_engine::physics::race_and_cam::{BallRace, FlatFollower};
use asperity_engine::scene::{ContactKind, Scene, SceneError, Tooth};

/// Fewest and most points of a path.
const POINTS: std::ops::RangeInclusive<i64> = 2..=10_000;

/// Where a case is on its path: columns of the table with their values.
#[derive(Debug, Clone, PartialEq)]
pub struct PathPoint {
    /// Name with unit, and value.
    pub values: Vec<(&'static str, f64)>,
}

/// Columns of a path.
pub(super) fn columns(points: &[PathPoint]) -> impl Iterator<Item = &'static str> + '_ {
    let values = points.first().map(|point| point.values.iter());
    values.into_iter().flatten().map(|(name, _)| *name)
}

/// The values of a column.
pub(super) fn column(points: &[PathPoint], name: &str) -> Option<Vec<f64>> {
    let at = columns(points).position(|column| column == name)?;
    Some(points.iter().map(|point| point.values[at].1).collect())
}

/// What a path goes along.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PathKind {
    Gear,
    Race,
    Cam,
}

impl PathKind {
    pub(super) const ALL: [Self; 3] = [Self::Gear, Self::Race, Self::Cam];

    /// Name of its table.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Gear => "gear",
            Self::Race => "race",
            Self::Cam => "cam",
        }
    }
}

/// The axes and points of a path.
pub(super) struct Path {
    pub(super) axes: Vec<VariedKey>,
    pub(super) points: Vec<PathPoint>,
    /// The tooth of a gear.
    pub(super) tooth: Option<Tooth>,
    /// The inner ring of a race.
    pub(super) ring: Option<Ring>,
}

/// A point under way: where it is, and what the scene gets.
struct PathStop {
    values: Vec<(&'static str, f64)>,
    keys: Vec<(&'static str, f64)>,
}

/// Reads `[gear]`, `[race]` or `[cam]` for a base scene.
pub(super) fn read(kind: PathKind, table: &Table, scene: &Scene) -> Result<Path, SceneError> {
    let (is, must) = match (kind, scene.kind()) {
        (PathKind::Race, ContactKind::Point)
        | (PathKind::Gear | PathKind::Cam, ContactKind::Line) => ("", ""),
        (PathKind::Race, ContactKind::Line) => ("\"line\"", "\"point\" on a [race]"),
        (PathKind::Gear | PathKind::Cam, ContactKind::Point) => {
            ("\"point\"", "\"line\" on a [gear] or [cam]")
        }
    };
    if !is.is_empty() {
        return Err(SceneError::value("contact.kind", is, must));
    }
    let mut keys = TableReader::new(kind.name(), table);
    let (mut tooth, mut ring) = (None, None);
    let stops = match kind {
        PathKind::Gear => {
            let n = keys.whole("points", POINTS, 17);
            let (pair, spectrum) = gear_pair(&mut keys)?;
            tooth = Some(Tooth::of(&pair.gears, pair.speed_rad_s));
            let mut stops = Vec::new();
            for step in &spectrum {
                stops.extend(gear(&step.load(pair), n, step)?);
            }
            stops
        }
        PathKind::Race => {
            let (stops, own) = race(&mut keys)?;
            ring = Some(own);
            stops
        }
        PathKind::Cam => cam(&mut keys)?,
    };
    let axis = |k: usize, name: &str| VariedKey {
        key: name.to_owned(),
        values: stops.iter().map(|s| Value::Float(s.keys[k].1)).collect(),
    };
    let names = stops[0].keys.iter().enumerate();
    Ok(Path {
        axes: names.map(|(k, (name, _))| axis(k, name)).collect(),
        points: stops
            .iter()
            .map(|stop| PathPoint {
                values: stop.values.clone(),
            })
            .collect(),
        tooth,
        ring,
    })
}

const RPM: f64 = PI / 30.0;

const LOAD_SHARING: [(&str, LoadSharing); 3] = [
    ("half", LoadSharing::Half),
    ("trapezoid", LoadSharing::Trapezoid),
    ("whole", LoadSharing::Whole),
];

/// Most steps of a spectrum.
const MOST_STEPS: usize = 100;

/// A step of what a pair of gears carries.
struct SpectrumStep {
    torque_n_m: f64,
    speed_rpm: f64,
    /// Part of the time; `None`: it is all there is.
    time_share: Option<f64>,
}

impl SpectrumStep {
    const KEYS: &'static str = "tables of torque_n_m, speed_rpm and time_share";

    fn read(value: &Value, at: usize) -> Result<Self, SceneError> {
        let path = format!("gear.spectrum.{at}");
        let Some(table) = value.as_table() else {
            return Err(SceneError::value(path, shown(value), Self::KEYS));
        };
        let mut keys = TableReader::new(path, table);
        let share = keys.number("time_share", 1e-9..=1.0, "of the time");
        let mut step = Self::of(&mut keys);
        keys.finish()?;
        step.time_share = Some(share);
        Ok(step)
    }

    fn of(keys: &mut TableReader) -> Self {
        Self {
            torque_n_m: keys.number("torque_n_m", 1e-3..=1e7, "N m"),
            speed_rpm: keys.number("speed_rpm", 0.01..=1e6, "1/min"),
            time_share: None,
        }
    }

    /// The pair under this load.
    fn load(&self, pair: GearPair) -> GearPair {
        GearPair {
            torque_n_m: self.torque_n_m,
            speed_rad_s: RPM * self.speed_rpm,
            ..pair
        }
    }

    /// What it says of a point of the path.
    fn values(&self) -> Vec<(&'static str, f64)> {
        self.time_share.map_or_else(Vec::new, |share| {
            vec![
                ("torque_n_m", self.torque_n_m),
                ("speed_rpm", self.speed_rpm),
                ("time_share", share),
            ]
        })
    }
}

/// The steps of `[gear]`: those of its spectrum, or the one of its torque and speed.
fn spectrum(keys: &mut TableReader) -> Result<Vec<SpectrumStep>, SceneError> {
    let Some(list) = keys.optional("spectrum", SpectrumStep::KEYS, Value::as_array) else {
        return Ok(vec![SpectrumStep::of(keys)]);
    };
    if !(1..=MOST_STEPS).contains(&list.len()) {
        let allowed = format!("1 to {MOST_STEPS} {}", SpectrumStep::KEYS);
        return Err(SceneError::value(
            "gear.spectrum",
            format!("a list of {}", list.len()),
            allowed,
        ));
    }
    let steps = (list.iter().enumerate()).map(|(k, value)| SpectrumStep::read(value, k));
    let steps = steps.collect::<Result<Vec<_>, _>>()?;
    let whole: f64 = steps.iter().filter_map(|step| step.time_share).sum();
    if (whole - 1.0).abs() > 1e-6 {
        let allowed = "shares of the time that make 1 together";
        return Err(SceneError::value("gear.spectrum", whole, allowed));
    }
    Ok(steps)
}

fn gear(pair: &GearPair, n: usize, step: &SpectrumStep) -> Result<Vec<PathStop>, SceneError> {
    let Some(line) = pair.gears.line_of_action() else {
        return Err(SceneError::value(
            "gear.tip_diameters_m",
            format!("{:?}", pair.gears.tip_diameters_m),
            GearTeeth::MESHING,
        ));
    };
    let even = |k: usize| line.a + (line.e - line.a) * k as f64 / (n - 1) as f64;
    let mut places: Vec<f64> = (0..n).map(even).collect();
    places[n - 1] = line.e;
    places.extend([line.b, line.c, line.d]);
    places.sort_by(f64::total_cmp);
    places.dedup_by(|one, two| (*one - *two).abs() < 1e-9);
    Ok(places
        .into_iter()
        .map(|place| {
            let mesh = pair.at(&line, place);
            // S of the pitch point is 0, not what rounding leaves of it.
            let s = mesh.slide_roll();
            let way = place - line.a;
            let mut values = vec![
                ("path_m", way),
                ("rho_1_m", mesh.radii_m[0]),
                ("rho_2_m", mesh.radii_m[1]),
                ("u_1_m_s", mesh.speeds_m_s[0]),
                ("u_2_m_s", mesh.speeds_m_s[1]),
                ("load_share", mesh.share),
                (
                    "time_s",
                    way / (pair.gears.base_radii_m()[0] * pair.speed_rad_s),
                ),
            ];
            values.extend(step.values());
            PathStop {
                values,
                keys: vec![
                    ("contact.rx_m", mesh.radius_m()),
                    ("load.force_n_per_m", mesh.load_n_per_m),
                    ("motion.entrainment_m_s", mesh.entrainment_m_s()),
                    ("motion.slide_roll", if s.abs() < 1e-9 { 0.0 } else { s }),
                ],
            }
        })
        .collect())
}

/// The pair under the first step of what it carries, and all steps.
fn gear_pair(keys: &mut TableReader) -> Result<(GearPair, Vec<SpectrumStep>), SceneError> {
    let range = 5.0..=1000.0;
    let allowed = "two whole numbers, 5 to 1000, pinion first";
    let teeth = keys.required("teeth", allowed, |value| {
        let teeth = both(value, &range)?;
        let are_whole = teeth.iter().all(|z| z.fract() == 0.0);
        are_whole.then(|| teeth.map(|z| z as u32))
    });
    let radii = keys.pair("pitch_radii_m", 1e-4..=10.0, "m, pinion first");
    let module_m = keys.optional_number("module_m", 1e-5..=0.1, "m");
    let centre = keys.optional_number("centre_distance_m", 1e-4..=10.0, "m");
    let tips = keys.pair("tip_diameters_m", 1e-4..=20.0, "m, pinion first");
    let load_sharing = keys.choice("load_sharing", &LOAD_SHARING);
    let angle = keys.optional_number("pressure_angle_deg", 10.0..=35.0, "degrees");
    let face_width_m = keys.number("face_width_m", 1e-4..=10.0, "m");
    let steps = spectrum(keys)?;
    keys.finish()?;
    let module_m = match (module_m, radii) {
        (Some(module_m), None) => module_m,
        (None, Some([one, two])) => {
            let modules = [
                2.0 * one / f64::from(teeth[0]),
                2.0 * two / f64::from(teeth[1]),
            ];
            if (modules[0] / modules[1] - 1.0).abs() > 1e-6 {
                return Err(SceneError::value(
                    "gear.pitch_radii_m",
                    format!("{one}, {two}"),
                    "radii in the ratio of the numbers of teeth",
                ));
            }
            modules[0]
        }
        (None, None) | (Some(_), Some(_)) => {
            return Err(SceneError::Missing {
                key: "gear.module_m".to_owned(),
                allowed: "exactly one of module_m (1e-5 to 0.1 m) and pitch_radii_m".to_owned(),
            });
        }
    };
    let standard = teeth.map(|z| module_m * f64::from(z));
    let pair = GearPair {
        gears: GearTeeth {
            teeth,
            module_m,
            pressure_angle_rad: angle.unwrap_or(20.0).to_radians(),
            centre_distance_m: centre.unwrap_or(0.5 * (standard[0] + standard[1])),
            tip_diameters_m: tips.unwrap_or(standard.map(|d| d + 2.0 * module_m)),
        },
        face_width_m,
        torque_n_m: 0.0,
        speed_rad_s: 0.0,
        load_sharing,
    };
    Ok((steps[0].load(pair), steps))
}

fn race(keys: &mut TableReader) -> Result<(Vec<PathStop>, Ring), SceneError> {
    let race = BallRace {
        ball_diameter_m: keys.number("ball_diameter_m", 1e-4..=1.0, "m"),
        pitch_diameter_m: keys.number("pitch_diameter_m", 1e-3..=10.0, "m"),
        conformity: keys.number("conformity", 0.501..=0.6, ""),
        balls: keys.number("balls", 3.0..=500.0, "") as u32,
        radial_load_n: keys.number("radial_load_n", 1e-3..=1e8, "N"),
        speed_rad_s: RPM * keys.number("speed_rpm", 0.01..=1e6, "1/min"),
    };
    let zone = keys.optional_number("half_zone_deg", 1.0..=85.0, "degrees");
    let n = keys.whole("points", POINTS, 9);
    keys.finish()?;
    if race.pitch_diameter_m <= race.ball_diameter_m {
        return Err(SceneError::value(
            "race.pitch_diameter_m",
            race.pitch_diameter_m,
            "more than the ball's diameter",
        ));
    }
    let zone = zone.unwrap_or(75.0);
    let [rx, ry] = race.radii_m();
    let ring = Ring {
        balls_a_turn: race.balls_a_turn(),
        speed_rpm: race.speed_rad_s / RPM,
    };
    let stops = (0..n)
        .map(|k| {
            let angle = zone * (2.0 * k as f64 / (n - 1) as f64 - 1.0);
            PathStop {
                values: vec![("path_deg", angle)],
                keys: vec![
                    ("contact.rx_m", rx),
                    ("contact.ry_m", ry),
                    ("load.force_n", race.load_n(angle.to_radians())),
                    ("motion.entrainment_m_s", race.entrainment_m_s()),
                ],
            }
        })
        .collect();
    Ok((stops, ring))
}

fn cam(keys: &mut TableReader) -> Result<Vec<PathStop>, SceneError> {
    let end = keys.number("half_angle_deg", 10.0..=170.0, "degrees");
    let cam = FlatFollower {
        base_radius_m: keys.number("base_radius_m", 1e-3..=1.0, "m"),
        lift_m: keys.number("lift_m", 1e-5..=0.5, "m"),
        half_angle_rad: end.to_radians(),
        speed_rad_s: RPM * keys.number("speed_rpm", 0.01..=1e6, "1/min"),
        preload_n: keys.number("preload_n", 0.0..=1e6, "N"),
        stiffness_n_per_m: keys.number("stiffness_n_per_m", 0.0..=1e9, "N/m"),
        mass_kg: keys.number("mass_kg", 0.0..=1e4, "kg"),
        width_m: keys.number("width_m", 1e-4..=1.0, "m"),
    };
    // The flank: from the turning point of the lift, where the follower's speed is 0, to the end of it. The
    // turning point itself has S = 2; half a step away from it both surfaces move.
    let n = keys.whole("points", POINTS, 9);
    let unit = "degrees from the nose, the lesser first";
    let ends = keys.pair("angles_deg", 0.0..=end, unit);
    keys.finish()?;
    let [near, far] = ends.unwrap_or([0.5 * end, end]);
    if near >= far {
        let allowed = format!("two numbers, 0 to {end} {unit}");
        return Err(SceneError::value(
            "cam.angles_deg",
            format!("[{near}, {far}]"),
            allowed,
        ));
    }
    let [near, far] = [near, far].map(f64::to_radians);
    (0..n)
        .map(|k| far - (far - near) * (k as f64 + 0.5) / n as f64)
        .map(|angle| cam_stop(&cam, angle))
        .collect()
}

/// The contact at `angle` (radians from the nose); refused where the cam does not touch or the surfaces move against
/// each other.
fn cam_stop(cam: &FlatFollower, angle: f64) -> Result<PathStop, SceneError> {
    let at = cam.at(angle);
    if at.radius_m <= 0.0 || at.load_n_per_m <= 0.0 {
        return Err(SceneError::value(
            "cam.lift_m",
            cam.lift_m,
            format!(
                "a cam that touches all along its flank; at {:.1} degrees from the nose R = {:.3e} m, load {:.3e} N/m",
                angle.to_degrees(),
                at.radius_m,
                at.load_n_per_m
            ),
        ));
    }
    let [follower, nose] = at.speeds_m_s;
    let entrainment = 0.5 * (follower + nose);
    if follower < 0.0 {
        let end = cam.half_angle_rad.to_degrees();
        return Err(SceneError::value(
            "cam.angles_deg",
            format!("{:.1}", angle.to_degrees()),
            format!(
                "angles of the flank, {:.1} to {end:.1} degrees from the nose: nearer to it the surfaces move \
                 against each other (here S = {:.1}), and motion.slide_roll goes from -2 to 2",
                0.5 * end,
                (nose - follower) / entrainment
            ),
        ));
    }
    Ok(PathStop {
        values: vec![
            ("path_deg", angle.to_degrees()),
            ("lift_m", at.lift_m),
            ("u_1_m_s", follower),
            ("u_2_m_s", nose),
        ],
        keys: vec![
            ("contact.rx_m", at.radius_m),
            ("load.force_n_per_m", at.load_n_per_m),
            ("motion.entrainment_m_s", entrainment),
            ("motion.slide_roll", (nose - follower) / entrainment),
        ],
    })
}
