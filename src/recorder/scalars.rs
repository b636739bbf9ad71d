//! Every scalar of a step as one row in SI, for programs: what the catalogue has, and what a picture needs beside it.
//!
//! Curves for people have their units and logarithms; a row has the numbers that they were made of, each under its
//! name, so that a frame is read back to the bit ([`super::frames`]). What is not known is no number (NaN).

use rerun::{Scalars, SeriesLines};
use serde_json::Value;

use super::entities::GRID;
use super::entities::slice::DEPTHS;
use super::stream::Stream;
use asperity_engine::scene::ContactKind;
use asperity_engine::sim::{
    CATALOGUE, Frame, LifeEstimate, LubricationRegime, MaterialPoint, Metrics, PassedPeak,
};

/// Names of the grid's numbers.
const GRID_NAMES: [&str; 7] = ["line", "nx", "ny", "x_min_m", "dx_m", "y_min_m", "dy_m"];

/// How a number is read off a frame.
type FrameNumber = fn(&Frame) -> Option<f64>;

/// What a row has beside the catalogue.
const MORE: [(&str, FrameNumber); 10] = [
    ("regime_code", |f| Some(code(f.metrics.regime))),
    ("point_body", |f| Some(f.material_point?.body.into())),
    ("point_depth_m", |f| Some(f.material_point?.depth_m)),
    ("point_pressure_pa", |f| Some(f.material_point?.pressure_pa)),
    ("point_tau_xz_pa", |f| Some(f.material_point?.tau_xz_pa)),
    ("point_cycles_before", |f| f.material_point?.cycles_before),
    ("point_peak_x_m", |f| Some(f.material_point?.last_peak?.x_m)),
    ("point_peak_pa", |f| {
        Some(f.material_point?.last_peak?.pressure_pa)
    }),
    ("life_global", |f| {
        f.metrics.life.as_ref()?.detail.life_global
    }),
    ("life_damage", |f| {
        f.metrics.life.as_ref()?.detail.life_damage
    }),
];

/// From the regime in which oil does nothing to that in which it does all.
pub(crate) fn code(regime: LubricationRegime) -> f64 {
    match regime {
        LubricationRegime::Dry => 0.0,
        LubricationRegime::Boundary => 1.0,
        LubricationRegime::Mixed => 2.0,
        LubricationRegime::FullFilm => 3.0,
    }
}

/// `None`: no code of ours.
fn regime(code: f64) -> Option<LubricationRegime> {
    match code {
        0.0 => Some(LubricationRegime::Dry),
        1.0 => Some(LubricationRegime::Boundary),
        2.0 => Some(LubricationRegime::Mixed),
        3.0 => Some(LubricationRegime::FullFilm),
        _ => None,
    }
}

/// Names of a row's numbers.
pub(crate) fn names() -> impl Iterator<Item = &'static str> {
    let catalogue = CATALOGUE.iter().map(|quantity| quantity.name);
    catalogue.chain(MORE.iter().map(|(name, _)| *name))
}

/// Adds a step's row.
pub(crate) fn add(frame: &Frame, row: &mut Vec<f64>) {
    let number = |value: Option<f64>| value.unwrap_or(f64::NAN);
    row.extend(
        CATALOGUE
            .iter()
            .map(|quantity| number(quantity.number(frame))),
    );
    row.extend(MORE.iter().map(|(_, of)| number(of(frame))));
}

/// Logs nodes and lengths, and the depths of the slice.
pub(crate) fn log_grid(stream: &Stream, frame: &Frame) {
    let line = f64::from(u8::from(frame.kind == ContactKind::Line));
    let (nx, ny) = (frame.nx as f64, frame.ny as f64);
    let lengths = [frame.x_min_m, frame.dx_m, frame.y_min_m, frame.dy_m];
    let values = [line, nx, ny].into_iter().chain(lengths);
    let names = SeriesLines::update_fields().with_names(GRID_NAMES);
    stream.log_static(GRID, &Scalars::new(values));
    stream.log_static(GRID, &names);
    if let Some(slice) = &frame.slice {
        stream.log_static(DEPTHS, &Scalars::new(slice.depths_m.iter().copied()));
    }
}

/// A frame without fields of those nodes and lengths; `None`: they are not what was logged.
pub(crate) fn grid_of(values: &[f64]) -> Option<Frame> {
    let [line, nx, ny, x_min_m, dx_m, y_min_m, dy_m] = values.try_into().ok()?;
    let nodes = |value: f64| (1.0..=65_536.0).contains(&value).then_some(value as usize);
    let lengths = [x_min_m, dx_m, y_min_m, dy_m];
    let frame = Frame {
        kind: if line == 0.0 {
            ContactKind::Point
        } else {
            ContactKind::Line
        },
        nx: nodes(nx)?,
        ny: nodes(ny)?,
        x_min_m,
        dx_m,
        y_min_m,
        dy_m,
        stage: asperity_engine::sim::Stage::Passage,
        ..Frame::default()
    };
    let fits = lengths.iter().all(|length: &f64| length.is_finite()) && dx_m > 0.0 && dy_m > 0.0;
    fits.then_some(frame)
}

/// Reads rows back, whichever of the names a file has.
pub(crate) struct RowReader {
    names: Vec<String>,
    metrics: Value,
    life: Value,
}

impl RowReader {
    /// Of rows whose numbers have these names.
    pub(crate) fn new(names: Vec<String>) -> Self {
        Self {
            names,
            // Plain data: nothing that JSON could not hold.
            metrics: serde_json::to_value(Metrics::default()).unwrap_or_default(),
            life: serde_json::to_value(LifeEstimate::default()).unwrap_or_default(),
        }
    }

    /// A number of a row; `None` where it is not known.
    pub(crate) fn number(&self, row: &[f64], name: &str) -> Option<f64> {
        let at = self.names.iter().position(|own| own == name)?;
        row.get(at).copied().filter(|value| value.is_finite())
    }

    /// Gives a frame the scalars of a row; `None` where they make none.
    pub(crate) fn fill(&self, row: &[f64], frame: &mut Frame) -> Option<()> {
        let of = |name: &str| self.number(row, name);
        frame.step = of("step")? as u64;
        (frame.time_s, frame.passages) = (of("time_s")?, of("passages")?);
        (frame.a_m, frame.b_m) = (of("a_m")?, of("b_m")?);
        frame.p_hertz_pa = of("p_hertz_pa")?;
        frame.material_point = self.point(row);
        let (mut metrics, mut life) = (self.metrics.clone(), self.life.clone());
        for (name, value) in self.names.iter().zip(row).filter(|(_, v)| v.is_finite()) {
            set(&mut metrics, name, *value);
            set(&mut life, name, *value);
        }
        let mut metrics: Metrics = serde_json::from_value(metrics).ok()?;
        metrics.regime = regime(of("regime_code").unwrap_or(3.0))?;
        metrics.yielded_m3 = match [of("yielded_body_1_m3"), of("yielded_body_2_m3")] {
            [Some(one), Some(two)] => Some([one, two]),
            _ => None,
        };
        if of("life_relative").is_some() {
            let mut life: LifeEstimate = serde_json::from_value(life).ok()?;
            life.detail.life_global = of("life_global");
            life.detail.life_damage = of("life_damage");
            metrics.life = Some(life);
        }
        frame.metrics = metrics;
        Some(())
    }

    fn point(&self, row: &[f64]) -> Option<MaterialPoint> {
        let of = |name: &str| self.number(row, name);
        let peak = of("point_peak_x_m").zip(of("point_peak_pa"));
        Some(MaterialPoint {
            body: of("point_body")? as u8,
            x_m: of("point_x_m")?,
            depth_m: of("point_depth_m")?,
            pressure_pa: of("point_pressure_pa")?,
            effective_pa: of("point_effective_pa")?,
            tau_xz_pa: of("point_tau_xz_pa")?,
            cycles_counted: of("point_cycles_counted")?,
            last_peak: peak.map(|(x_m, pressure_pa)| PassedPeak { x_m, pressure_pa }),
            cycles_before: of("point_cycles_before"),
        })
    }
}

/// Sets a field that there is.
fn set(fields: &mut Value, name: &str, value: f64) {
    if let Some(field) = fields.get_mut(name) {
        match field {
            Value::Bool(known) => *known = value != 0.0,
            Value::Number(number) if number.is_u64() => *field = Value::from(value as u64),
            Value::Null | Value::Number(_) => *field = Value::from(value),
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_engine::sim::LifeDetail;

    #[test]
    fn a_row_reads_back_to_the_bit() {
        let mut frame = Frame {
            step: 7,
            time_s: 1.0 / 3.0,
            passages: 0.7,
            a_m: 1e-4,
            b_m: 2e-4,
            p_hertz_pa: 1.5e9,
            stage: asperity_engine::sim::Stage::Passage,
            ..Frame::default()
        };
        frame.metrics = Metrics {
            converged: true,
            newton_iterations: 3,
            p_max_pa: 1.0e9 / 7.0,
            lambda_ratio: Some(0.3),
            yielded_m3: Some([1e-18, 0.0]),
            regime: LubricationRegime::Mixed,
            life: Some(LifeEstimate {
                life_relative: 0.1,
                phases: 5,
                settled: true,
                detail: LifeDetail {
                    life_damage: Some(0.2),
                    ..LifeDetail::default()
                },
                ..LifeEstimate::default()
            }),
            ..Metrics::default()
        };
        frame.material_point = Some(MaterialPoint {
            body: 2,
            x_m: -1e-5,
            cycles_before: Some(4.0),
            ..MaterialPoint::default()
        });
        let mut row = Vec::new();
        add(&frame, &mut row);
        let reader = RowReader::new(names().map(str::to_owned).collect());
        let mut back = Frame {
            stage: frame.stage,
            ..Frame::default()
        };
        reader.fill(&row, &mut back).expect("a frame");
        assert_eq!(back, frame);
    }
}
