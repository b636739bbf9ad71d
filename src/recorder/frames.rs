//! A recording's frames, read back: fields as their pictures hold them, scalars to the bit.
//!
//! Fields come in half precision (0.05 %, what is below 6e-8 of the unit coarser) or in [levels](super::levels); written
//! again they are the same bits. What is drawn in every second picture only (traction, roughness) is that of the last one; a step whose
//! fields are all its own is [whole](RecordedFrames::whole).

mod found;

use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

use self::found::{FoundRows, Image, SteppedImages};
use super::beside::RUNS;
use super::classes;
use super::entities::{DAMAGE, maps, slice};
use super::levels::values_of;
use super::repeat::RereadError;
use super::scalars::{self, RowReader};
use asperity_engine::math::number::{GPA, KELVIN, MPA, UM, Unit};
use asperity_engine::scene::Scene;
use asperity_engine::sim::{DamageBlock, Frame, StressSlice};

/// What a recording holds of its run.
pub struct RecordedFrames {
    /// The scene of the run.
    pub scene: Arc<Scene>,
    /// As TOML.
    pub scene_toml: String,
    /// Program and version that recorded it.
    pub program: String,
    /// Nodes and lengths, no fields.
    grid: Frame,
    depths_m: Arc<[f64]>,
    /// Length, columns and depths of the damage blocks.
    blocks: [Vec<f64>; 2],
    reader: RowReader,
    rows: Vec<(i64, Vec<f64>)>,
    pictures: HashMap<String, SteppedImages>,
    /// What stood under *Now*.
    texts: Vec<(i64, String)>,
    /// The same for an audience.
    lectures: Vec<(i64, String)>,
    /// Of the life, with what the mesh costs.
    band: Option<[f64; 2]>,
    broken_off: Option<String>,
}

impl RecordedFrames {
    /// Reads a recording of a run or of the explorer.
    ///
    /// # Errors
    /// When it cannot be read, is damaged, is no recording of this version, or holds no picture. One that breaks off is
    /// read up to there ([`RecordedFrames::broken_off`]).
    pub fn read(path: &Path) -> Result<Self, RereadError> {
        Self::read_under(path, "")
    }

    /// Reads a recording of one run, or of runs side by side in their order; of these, steps of pictures are those of the
    /// first.
    ///
    /// # Errors
    /// Those of [`read`](Self::read).
    pub fn read_all(path: &Path) -> Result<Vec<Self>, RereadError> {
        let alone = Self::read(path);
        if alone.is_ok() {
            return alone.map(|run| vec![run]);
        }
        let runs = RUNS
            .iter()
            .map(|run| Self::read_under(path, &format!("{run}/")));
        // What is no recording of several is refused in the words for one.
        match runs.filter_map(Result::ok).collect::<Vec<_>>() {
            runs if runs.is_empty() => alone.map(|run| vec![run]),
            runs => Ok(runs),
        }
    }

    /// Reads the run whose entities have that before their names.
    fn read_under(path: &Path, under: &str) -> Result<Self, RereadError> {
        let refused = |reason: String| RereadError {
            path: path.display().to_string(),
            reason,
        };
        let found = FoundRows::read(path, under).map_err(refused)?;
        let no_run = match &found.broken_off {
            None => {
                "holds no run: not recorded by this version of asperity, or several side by side"
                    .to_owned()
            }
            Some(words) => {
                format!("{words}; what it holds names no run of this version of asperity")
            }
        };
        let origin = found.origin.ok_or_else(|| refused(no_run));
        let (program, scene_toml) = origin?;
        let scene = Scene::from_toml(&scene_toml).map_err(|error| refused(error.to_string()))?;
        let unfit = match &found.broken_off {
            None => "holds no frames that can be read back: its run made no step".to_owned(),
            Some(words) => format!("{words}; no step before that is whole"),
        };
        let grid = scalars::grid_of(&found.grid).ok_or_else(|| refused(unfit.clone()))?;
        let frames = Self {
            scene: Arc::new(scene),
            scene_toml,
            program,
            grid,
            depths_m: found.depths_m.into(),
            blocks: found.blocks,
            reader: RowReader::new(found.names),
            rows: found.rows,
            pictures: found.pictures,
            texts: found.texts,
            lectures: found.lectures,
            band: found.band,
            broken_off: found.broken_off,
        };
        if frames.shown().is_empty() || frames.steps().count() < frames.rows.len() {
            return Err(refused(unfit));
        }
        Ok(frames)
    }

    /// Where and why the recording breaks off, in words; `None`: it is whole.
    pub fn broken_off(&self) -> Option<&str> {
        self.broken_off.as_deref()
    }

    /// The last step, and the band of its life with what the mesh costs, which only the end of a run knows; `None`: the run
    /// has none, or was stopped.
    pub fn last_band(&self) -> Option<(u64, [f64; 2])> {
        let (step, _) = self.rows.last()?;
        Some((u64::try_from(*step).ok()?, self.band?))
    }

    fn pictures_of(&self, entity: &str) -> &[(i64, Image)] {
        self.pictures.get(entity).map_or(&[], Vec::as_slice)
    }

    /// Every step that has scalars, in order, without fields.
    pub fn steps(&self) -> impl Iterator<Item = Frame> {
        self.rows.iter().filter_map(|(_, row)| self.scalars(row))
    }

    /// How many steps have scalars.
    pub fn n_steps(&self) -> usize {
        self.rows.len()
    }

    /// Steps that have pictures, in order.
    pub fn shown(&self) -> Vec<u64> {
        let pictures = self.pictures_of(maps::PRESSURE).iter();
        let has_row = |step: &i64| self.row(*step).is_some();
        let steps = pictures.map(|(step, _)| *step).filter(has_row);
        steps.filter_map(|step| u64::try_from(step).ok()).collect()
    }

    /// Those of them with the time, s, of what they show: of runs side by side, where steps are those of the first, their own.
    pub fn shown_at(&self) -> Vec<(u64, f64)> {
        let shown = self.shown().into_iter();
        let at = shown.filter_map(|step| {
            let frame = self.scalars(self.row(i64::try_from(step).ok()?)?)?;
            Some((step, frame.time_s))
        });
        at.collect()
    }

    /// Those of them whose fields are all their own.
    pub fn whole(&self) -> Vec<u64> {
        let traction = self.pictures_of(maps::TRACTION);
        let is_whole = |step: &u64| traction.iter().any(|(own, _)| *own == *step as i64);
        self.shown().into_iter().filter(is_whole).collect()
    }

    fn row(&self, step: i64) -> Option<&[f64]> {
        let at = self
            .rows
            .binary_search_by_key(&step, |(own, _)| *own)
            .ok()?;
        Some(&self.rows[at].1)
    }

    fn scalars(&self, row: &[f64]) -> Option<Frame> {
        let mut frame = self.grid.clone();
        self.reader.fill(row, &mut frame)?;
        Some(frame)
    }

    /// A step that has pictures.
    pub fn frame(&self, step: u64) -> Option<Frame> {
        let step = i64::try_from(step).ok()?;
        let mut frame = self.scalars(self.row(step)?)?;
        let (nx, nodes) = (frame.nx, frame.nx * frame.ny);
        let map = |entity, unit| {
            let values = self.values(entity, step, unit, nodes)?;
            Some(turned_over(&values, nx))
        };
        let flat = || vec![0.0; nodes];
        frame.pressure_pa = map(maps::PRESSURE, GPA)?;
        frame.film_m = map(maps::FILM, UM)?;
        frame.traction_pa = map(maps::TRACTION, MPA).unwrap_or_else(flat);
        frame.surface_rise_k = [maps::SURFACE_1, maps::SURFACE_2]
            .map(|entity| map(entity, KELVIN).unwrap_or_default());
        frame.film_rise_k = map(maps::OIL_RISE, KELVIN).unwrap_or_default();
        frame.roughness_1_m = map(maps::ROUGHNESS_1, UM).unwrap_or_else(flat);
        frame.roughness_2_m = map(maps::ROUGHNESS_2, UM).unwrap_or_else(flat);
        let touches = self
            .bytes(maps::CONTACT, step)
            .filter(|all| all.len() == nodes);
        let touches = touches.map(|all| turned_over(all, nx));
        frame.contact = touches.unwrap_or_else(|| vec![0; nodes]);
        frame
            .contact
            .iter_mut()
            .for_each(|class| *class = u8::from(*class == classes::TOUCHES));
        frame.slice = self.slice(step, nx);
        frame.damage = [0, 1].map(|body| self.damage(body, step));
        Some(frame)
    }

    fn slice(&self, step: i64, nx: usize) -> Option<StressSlice> {
        let values = nx * self.depths_m.len();
        Some(StressSlice {
            depths_m: Arc::clone(&self.depths_m),
            effective_pa: self.values(slice::EFFECTIVE, step, GPA, values)?,
            tau_xz_pa: self
                .values(slice::TAU_XZ, step, GPA, values)
                .unwrap_or_else(|| vec![0.0; values]),
        })
    }

    /// A damage map down to the depths that are shown.
    fn damage(&self, body: usize, step: i64) -> Option<DamageBlock> {
        let [length_m, columns, depths @ ..] = self.blocks[body].as_slice() else {
            return None;
        };
        let (columns, rows) = (*columns as usize, depths.len());
        let powers = self.values(DAMAGE[body], step, Unit::new("", 1.0), columns * rows)?;
        let mut block = DamageBlock {
            length_m: *length_m,
            columns,
            depths_m: depths.into(),
            damage: vec![0.0; columns * rows],
            ..DamageBlock::default()
        };
        for column in 0..columns {
            let mut filled = false;
            for row in 0..rows {
                let power = powers[row * columns + column];
                if power.is_nan() {
                    continue;
                }
                filled = true;
                let damage = 10_f32.powf(power);
                block.damage[column * rows + row] = damage;
                if f64::from(damage) > block.pit_damage {
                    block.pit_damage = damage.into();
                    block.pit_depth_m = depths[row];
                    block.pit_place_m = length_m * (column as f64 + 0.5) / columns as f64;
                }
            }
            block.filled += usize::from(filled);
        }
        Some(block)
    }

    /// The caption and the numbers that stood beside a step.
    pub fn text(&self, step: u64) -> &str {
        text_at(&self.texts, step)
    }

    /// What stood beside it for an audience.
    pub fn lecture(&self, step: u64) -> &str {
        text_at(&self.lectures, step)
    }

    /// The picture that holds at a step.
    fn image(&self, entity: &str, step: i64) -> Option<&Image> {
        let pictures = self.pictures_of(entity);
        let after = pictures.partition_point(|(own, _)| *own <= step);
        pictures[..after].last().map(|(_, image)| image)
    }

    /// Its bytes, of a picture of classes.
    fn bytes(&self, entity: &str, step: i64) -> Option<&[u8]> {
        match self.image(entity, step)? {
            Image::Plain(bytes) => Some(bytes),
            Image::Levels(..) => None,
        }
    }

    /// Its values in SI, as many as are asked for.
    fn values(&self, entity: &str, step: i64, unit: Unit, count: usize) -> Option<Vec<f32>> {
        let values = match self.image(entity, step)? {
            Image::Levels(png, per_unit) => values_of(png, *per_unit, count)?,
            Image::Plain(bytes) => {
                let halves = bytes.chunks_exact(2);
                let halves = halves.map(|pair| u16::from_le_bytes([pair[0], pair[1]]));
                halves.map(value_of).collect()
            }
        };
        let si = |value: &f32| (f64::from(*value) / unit.per_si) as f32;
        (values.len() == count).then(|| values.iter().map(si).collect())
    }
}

/// The text that holds at a step.
fn text_at(texts: &[(i64, String)], step: u64) -> &str {
    let after = texts.partition_point(|(own, _)| *own <= step as i64);
    texts[..after].last().map_or("", |(_, text)| text)
}

/// Rows from the last to the first.
fn turned_over<T: Copy>(values: &[T], columns: usize) -> Vec<T> {
    values
        .chunks_exact(columns.max(1))
        .rev()
        .flatten()
        .copied()
        .collect()
}

/// IEEE 754 binary16.
fn value_of(half: u16) -> f32 {
    let (exponent, digits) = (i32::from((half >> 10) & 0x1f), f32::from(half & 0x3ff));
    let size = match exponent {
        0 => digits * 2.0_f32.powi(-24),
        31 => f32::NAN,
        _ => (1024.0 + digits) * 2.0_f32.powi(exponent - 25),
    };
    if half & 0x8000 == 0 { size } else { -size }
}
