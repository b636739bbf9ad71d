//! What surfaces came to on the axis of loading cycles, where they age: pictures, and numbers on a timeline of their own, `cycles`,
//! which stand in the finished recording. (Until then nobody knows them: jumps are taken again.)

use rerun::log::Chunk;
use rerun::time::TimePoint;
use rerun::{AsComponents, Color, Scalars, SeriesLines, TimeCell};

use super::colour::{ORANGE, SKY};
use super::moment::CYCLES;
use super::plot::{PlotBox, line, points, ticks_at};
use super::summary::chunk;
use asperity_engine::math::number::ticks;
use asperity_engine::scene::{Life, Scene, Surface};
use asperity_engine::sim::AgePoint;

/// Of body 1 and 2.
const COLOURS: [[u8; 3]; 2] = [SKY, ORANGE];

/// Curves of both bodies, or of the contact.
pub(crate) struct AgeCurves {
    pub(crate) entity: &'static str,
    pub(crate) title: &'static str,
    names: &'static [&'static str],
    values: fn(&AgePoint) -> [Option<f64>; 2],
    /// Whether a scene's surfaces have it.
    has: fn(&Scene) -> bool,
}

impl AgeCurves {
    /// Whether it is what damage and wear come to.
    pub(crate) fn is_of_the_race(&self) -> bool {
        self.is_life() || self.entity == PITS
    }

    /// Whether it is the life.
    pub(crate) fn is_life(&self) -> bool {
        self.entity == LIFE
    }
}

const PITS: &str = "ages/pits_percent";
const LIFE: &str = "ages/log10_life";

/// All of them.
pub(crate) static AGES: [AgeCurves; 7] = [
    AgeCurves {
        entity: "ages/worn_nm",
        title: "Worn, nm",
        names: &["body 1", "body 2"],
        values: |age| [age.wear_depth_1_m, age.wear_depth_2_m].map(|m| Some(1e9 * m)),
        has: |_| true,
    },
    AgeCurves {
        entity: "ages/rq_nm",
        title: "Roughness Rq, nm",
        names: &["body 1", "body 2"],
        values: |age| [age.rq_1_m, age.rq_2_m].map(|m| Some(1e9 * m)),
        has: |_| true,
    },
    AgeCurves {
        entity: "ages/lambda_ratio",
        title: "Lambda ratio",
        names: &["lambda ratio"],
        values: |age| [age.lambda_ratio, None],
        has: |scene| {
            scene.lubricant.is_some() && !scene.surfaces().into_iter().all(Surface::is_smooth)
        },
    },
    AgeCurves {
        entity: PITS,
        title: "Surface with pits, %",
        names: &["body 1", "body 2"],
        values: |age| [age.pitted_area_1, age.pitted_area_2].map(|area| Some(100.0 * area?)),
        has: pits,
    },
    AgeCurves {
        entity: "ages/p_max_GPa",
        title: "Greatest pressure, GPa",
        names: &["p_max"],
        values: |age| [Some(1e-9 * age.p_max_pa), None],
        has: |_| true,
    },
    AgeCurves {
        entity: "ages/friction_coefficient",
        title: "Friction coefficient",
        names: &["friction coefficient"],
        values: |age| [Some(age.friction_coefficient), None],
        has: |_| true,
    },
    AgeCurves {
        entity: LIFE,
        title: "Life of surfaces that stay so, log10",
        names: &["life, log10"],
        values: |age| {
            [
                age.life_relative.filter(|life| *life > 0.0).map(f64::log10),
                None,
            ]
        },
        has: |scene| life_of(scene).is_some(),
    },
];

fn life_of(scene: &Scene) -> Option<&Life> {
    scene.life.as_ref()
}

/// Whether a scene's damage is followed to where it makes pits.
pub(crate) fn pits(scene: &Scene) -> bool {
    let calibrated = life_of(scene).is_some_and(|life| life.calibration().is_some());
    scene.age.is_some() && calibrated
}

/// Those that a scene has; none where its surfaces stay new.
pub(crate) fn of(scene: &Scene) -> Vec<&'static AgeCurves> {
    let all = AGES.iter().filter(|_| scene.age.is_some());
    all.filter(|curves| (curves.has)(scene)).collect()
}

/// Lower edge of a picture, over its width.
const HEIGHT: f64 = 0.6;
/// Where the first cycles stand; left of it new surfaces do.
const FIRST: f64 = 0.12;

/// The frame of each picture; its ticks come with the numbers.
pub(crate) fn plot() -> PlotBox {
    PlotBox {
        x: [0.0, 1.0],
        y: [-HEIGHT, 0.0],
        x_title: "loading cycles".into(),
        ..PlotBox::default()
    }
}

/// Their chunks: pictures that always stand, and the numbers on their timeline.
///
/// # Errors
/// The library's words.
pub(crate) fn chunks(ages: &[AgePoint]) -> Result<Vec<Chunk>, String> {
    let mut chunks = Vec::new();
    for curves in &AGES {
        let n = curves.names.len();
        let rows = ages.iter().filter_map(|age| {
            let values: Option<Vec<f64>> = (curves.values)(age).into_iter().take(n).collect();
            Some((age.cycles, values?))
        });
        let rows: Vec<(f64, Vec<f64>)> = rows.collect();
        if rows.len() > 1 {
            curves.draw(&rows, &mut chunks)?;
            curves.list(&rows, &mut chunks)?;
        }
    }
    Ok(chunks)
}

impl AgeCurves {
    /// The picture.
    fn draw(&self, rows: &[(f64, Vec<f64>)], chunks: &mut Vec<Chunk>) -> Result<(), String> {
        let decades = rows.iter().filter(|(cycles, _)| *cycles > 0.0);
        let decades = decades.map(|(cycles, _)| cycles.log10());
        let (low, high) = decades.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| {
            (low.min(at.floor()), high.max(at))
        });
        let place = |decade: f64| FIRST + (1.0 - FIRST) * (decade - low) / (high - low).max(1e-9);
        let values = || rows.iter().flat_map(|(_, values)| values).copied();
        let top = values().fold(f64::NEG_INFINITY, f64::max);
        let bottom = values().fold(f64::INFINITY, f64::min);
        // From zero, unless what changes is small beside it, or is negative.
        let bottom = if bottom > 0.0 && bottom < 0.7 * top {
            0.0
        } else {
            bottom
        };
        let margin = 0.05 * (top - bottom).max(1e-6 * top.abs()).max(1e-12);
        let range = [
            if bottom == 0.0 { 0.0 } else { bottom - margin },
            top + margin,
        ];
        let height = |value: f64| -HEIGHT * (value - range[0]) / (range[1] - range[0]);
        let mut x_ticks = vec![(0.0, "new".to_owned())];
        let last = high.floor() as i32;
        x_ticks.extend(
            (low as i32..=last).map(|decade| (place(f64::from(decade)), format!("1e{decade}"))),
        );
        let shares = [0.25, 0.75];
        let titles = self.names.iter().zip(COLOURS).zip(shares);
        let plot = PlotBox {
            x_ticks,
            left_ticks: ticks_at(&ticks(range[0], range[1], 4), height),
            titles: titles
                .map(|((name, colour), share)| (share, (*name).to_owned(), Some(colour)))
                .collect(),
            ..plot()
        };
        let (frame, labels) = plot.drawn();
        let entity = |part: &str| format!("{}/{part}", self.entity);
        let mut add = |part: &str, data: &dyn AsComponents| {
            chunks.push(chunk(entity(part), TimePoint::default(), data)?);
            Ok::<(), String>(())
        };
        add("frame", &frame)?;
        add("labels", &labels.drawn())?;
        for (k, colour) in COLOURS.into_iter().enumerate().take(self.names.len()) {
            let curve = rows.iter().map(|(cycles, values)| {
                let x = if *cycles > 0.0 {
                    place(cycles.log10())
                } else {
                    0.0
                };
                [x, height(values[k])]
            });
            let curve = points(&curve.collect::<Vec<_>>());
            add(
                &format!("curve_{}", k + 1),
                &line(colour, 1.5).with_strips([curve]),
            )?;
        }
        Ok(())
    }

    /// The numbers.
    fn list(&self, rows: &[(f64, Vec<f64>)], chunks: &mut Vec<Chunk>) -> Result<(), String> {
        let entity = self.entity.replacen("ages", "ages_over_cycles", 1);
        let colours = COLOURS.map(Color::from).into_iter().take(self.names.len());
        let style = SeriesLines::new()
            .with_colors(colours)
            .with_names(self.names.iter().copied());
        chunks.push(chunk(entity.as_str(), TimePoint::default(), &style)?);
        for (cycles, values) in rows {
            let cell = TimeCell::from_sequence(cycles.round() as i64);
            let at = TimePoint::default().with_index(CYCLES, cell);
            chunks.push(chunk(
                entity.as_str(),
                at,
                &Scalars::new(values.iter().copied()),
            )?);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Curves lie in their frames, also those that do not change; what is not known has no picture.
    #[test]
    fn curves_lie_in_their_frames() {
        let age = |cycles: f64| AgePoint {
            cycles,
            wear_depth_1_m: 1e-15 * cycles,
            p_max_pa: 2e9,
            life_relative: Some(0.1),
            ..AgePoint::default()
        };
        let ages = [0.0, 2e4, 3e5, 1e7].map(age);
        let found = chunks(&ages).expect("chunks");
        let entities: Vec<String> = found.iter().map(|c| c.entity_path().to_string()).collect();
        let has = |entity: &str| entities.iter().filter(|own| own.ends_with(entity)).count();
        assert_eq!(
            (has("ages/worn_nm/curve_2"), has("ages/p_max_GPa/curve_1")),
            (1, 1)
        );
        assert_eq!(
            (
                has("ages/pits_percent/frame"),
                has("ages_over_cycles/worn_nm")
            ),
            (0, 5)
        );
        let mut drawn = 0;
        for chunk in &found {
            let strips = rerun::LineStrips2D::descriptor_strips().component;
            let points = chunk.iter_slices::<&[[f32; 2]]>(strips);
            for [x, y] in points.flatten().flatten() {
                drawn += 1;
                assert!(
                    (-0.02..=1.0).contains(x) && (-0.7..=0.02).contains(y),
                    "{x} {y}"
                );
            }
        }
        assert!(drawn > 50, "{drawn}");
        assert!(chunks(&ages[..1]).expect("none").is_empty());
    }
}
