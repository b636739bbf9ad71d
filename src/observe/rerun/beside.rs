//! Several recordings as one: their runs side by side, in common ranges and colours, at common moments.
//!
//! ```text
//! a.rrd, b.rrd ──> frames ──> common ranges ──> a/..., b/..., difference/..., one layout
//! key      simulated time t, or the place of a crest of body 1: ∫ U1 dt
//! moments  those of the first run's pictures up to the least last key; of each other run the picture nearest by key
//! ```
//! Frames go the way of any recording's, so that what is seen beside each other differs by the runs alone. Fields come in
//! the half precision of the recordings; a run less itself is 0 to the bit.

mod layout;

use std::path::Path;

use rerun::{Color, SeriesLines, TextDocument};

use super::RecordedFrames;
use super::colour::curve::{GREEN, SKY, VERMILION};
use super::maps;
use super::moment::Moment;
use super::picture::Field;
use super::raster::{Height, RasterEntity};
use super::recorder::views::{Common, ViewState};
use super::series::Series;
use super::stream::Stream;
use super::text;
use crate::math::number::{GPA, counted, sig};
use crate::observe::{ObserveError, Overwrite};
use crate::picture::{Look, Ramp, Scope};
use crate::scene::Record;
use crate::sim::Frame;

/// Names of the runs, which stand before those of their entities.
const RUNS: [&str; 3] = ["a", "b", "c"];
/// Colour of each in curves that they share.
const COLOURS: [[u8; 3]; 3] = [VERMILION, SKY, GREEN];
/// What is compared, how, and how near.
const COMPARISON: &str = "text/comparison";
/// Curves that runs share a view of.
const SHARED: [&str; 5] = [
    "life/log10_relative",
    "material_point/cycles/counted",
    "series/pressure_GPa",
    "series/film_um",
    "series/friction",
];

/// What is equal where runs are shown together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ComparedBy {
    /// Simulated time since the start of the passage.
    Time,
    /// The way that body 1, and a crest on it, has gone.
    Place,
}

/// One of the runs.
pub struct RunBeside {
    /// What tells it from the others.
    pub name: String,
    /// Its frames.
    pub frames: RecordedFrames,
}

/// What was written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunsCompared {
    /// Moments at which all runs are shown.
    pub pictures: u64,
    /// How far a run's picture is from its moment at most, in its own steps.
    pub apart_steps: f64,
    /// Greatest pressure of a run less the first one's, Pa.
    pub difference_pa: f64,
}

/// A run with the keys of its steps.
struct KeyedRun<'a> {
    run: &'a RunBeside,
    steps: Vec<Frame>,
    keys: Vec<f64>,
    /// Places in `steps` that have pictures.
    shown: Vec<usize>,
}

impl<'a> KeyedRun<'a> {
    fn new(run: &'a RunBeside, by: ComparedBy) -> Result<Self, String> {
        let steps: Vec<Frame> = run.frames.steps().collect();
        let keys = keys(&steps, by);
        if keys.windows(2).any(|pair| pair[0] >= pair[1]) {
            return Err(format!(
                "{}: body 1 stands or turns back, so its crests have no place to compare by; compare by time",
                run.name
            ));
        }
        let numbers: Vec<u64> = steps.iter().map(|frame| frame.step).collect();
        let shown = run.frames.shown().into_iter();
        let shown = shown.filter_map(|step| numbers.binary_search(&step).ok());
        Ok(Self {
            run,
            shown: shown.collect(),
            steps,
            keys,
        })
    }

    fn last_key(&self) -> f64 {
        self.shown.last().map_or(0.0, |&at| self.keys[at])
    }

    /// The picture nearest to a key: its place among the steps.
    fn nearest(&self, key: f64) -> usize {
        let after = self.shown.partition_point(|&at| self.keys[at] < key);
        let near = [after.checked_sub(1), Some(after)];
        let near = near.into_iter().flatten().filter_map(|k| self.shown.get(k));
        let off = |at: usize| (self.keys[at] - key).abs();
        near.copied()
            .min_by(|one, two| off(*one).total_cmp(&off(*two)))
            .unwrap_or(0)
    }

    /// How far a step is from a key, in steps.
    fn apart(&self, at: usize, key: f64) -> f64 {
        let span = self.keys.last().unwrap_or(&0.0) - self.keys[0];
        let first = self.steps.first().map_or(0, |frame| frame.step);
        let steps = self.steps.last().map_or(0, |frame| frame.step) - first;
        (self.keys[at] - key).abs() * steps as f64 / span.max(f64::MIN_POSITIVE)
    }

    /// The moment of this run at a key, between two steps in proportion.
    fn moment(&self, key: f64) -> (f64, f64, f64) {
        let after = self.keys.partition_point(|&own| own <= key);
        let at = after.clamp(1, self.keys.len().saturating_sub(1).max(1)) - 1;
        let one = &self.steps[at];
        let two = self.steps.get(at + 1).unwrap_or(one);
        let span = self
            .keys
            .get(at + 1)
            .map_or(1.0, |next| next - self.keys[at]);
        let share = ((key - self.keys[at]) / span).clamp(0.0, 1.0);
        let between = |from: f64, to: f64| {
            if share == 1.0 {
                to
            } else {
                from + share * (to - from)
            }
        };
        (
            between(one.step as f64, two.step as f64),
            between(one.time_s, two.time_s),
            between(one.passages, two.passages),
        )
    }
}

/// Where on the common axis the steps are.
fn keys(steps: &[Frame], by: ComparedBy) -> Vec<f64> {
    if by == ComparedBy::Time {
        return steps.iter().map(|frame| frame.time_s).collect();
    }
    let speed =
        |frame: &Frame| frame.metrics.entrainment_m_s * (1.0 - 0.5 * frame.metrics.slide_roll);
    let (mut place, mut before) = (0.0, None);
    let mut key = |frame: &Frame| {
        let (time_s, now) = (frame.time_s, speed(frame));
        let (from_s, then) = before.replace((time_s, now)).unwrap_or((0.0, now));
        place += 0.5 * (now + then) * (time_s - from_s);
        place
    };
    steps.iter().map(&mut key).collect()
}

/// Writes two or three runs as one recording.
///
/// # Errors
/// When the file may not be written, or the runs have no key in common.
pub fn compare(
    runs: &[RunBeside],
    path: &Path,
    overwrite: Overwrite,
    by: ComparedBy,
) -> Result<RunsCompared, ObserveError> {
    let failed = |reason: String| ObserveError::new(path.display().to_string(), reason);
    let keyed = runs.iter().map(|run| KeyedRun::new(run, by));
    let keyed: Vec<KeyedRun> = keyed.collect::<Result<_, _>>().map_err(failed)?;
    let [first, others @ ..] = keyed.as_slice() else {
        return Err(failed("there is no run to show".to_owned()));
    };
    if others.is_empty() || keyed.len() > RUNS.len() {
        return Err(failed(format!(
            "two or three runs fit side by side, not {}",
            keyed.len()
        )));
    }
    let kinds = keyed.iter().map(|run| run.steps[0].kind);
    if kinds.into_iter().any(|kind| kind != first.steps[0].kind) {
        return Err(failed(
            "a point contact and a line contact have no picture in common".to_owned(),
        ));
    }
    let end = keyed
        .iter()
        .map(KeyedRun::last_key)
        .fold(f64::INFINITY, f64::min);
    let moments: Vec<usize> = first
        .shown
        .iter()
        .copied()
        .filter(|&at| first.keys[at] <= end)
        .collect();
    let scope = common_scope(&keyed).ok_or_else(|| failed("a run holds no picture".to_owned()))?;
    let mut stream = Stream::create(path, overwrite)?;
    let mut written = Written {
        stream: &stream,
        first,
        moments: &moments,
        end,
        scope,
        exaggeration: None,
        shown: Vec::new(),
        told: RunsCompared {
            pictures: moments.len() as u64,
            apart_steps: 0.0,
            difference_pa: 0.0,
        },
    };
    for (name, run) in RUNS.into_iter().zip(&keyed) {
        written.write(name, run)?;
    }
    let names: Vec<&str> = runs.iter().map(|run| run.name.as_str()).collect();
    written.tell(&names, by)?;
    layout::send(&stream, &written.shown, &names)?;
    let told = written.told;
    if let Some(file) = stream.to().file() {
        file.hold();
    }
    stream.close()?;
    Ok(told)
}

/// Ranges that hold for every step of every run.
fn common_scope(runs: &[KeyedRun]) -> Option<Scope> {
    let scopes = runs.iter().map(|run| {
        let at = *run.shown.first()?;
        let frames = &run.run.frames;
        let scene = Some(&*frames.scene);
        let mut scope = Scope::of(scene, &frames.frame(run.steps[at].step)?);
        for frame in &run.steps {
            scope.grows(scene, &frame.metrics);
        }
        Some(scope)
    });
    let scopes: Vec<Scope> = scopes.collect::<Option<_>>()?;
    scopes.into_iter().reduce(|one, other| one.with(&other))
}

/// What is written, run by run.
struct Written<'a> {
    stream: &'a Stream,
    first: &'a KeyedRun<'a>,
    /// Pictures of the first run: places among its steps.
    moments: &'a [usize],
    end: f64,
    scope: Scope,
    exaggeration: Option<f64>,
    shown: Vec<layout::ShownRun>,
    told: RunsCompared,
}

impl Written<'_> {
    /// Writes a run under its name.
    fn write(&mut self, name: &'static str, run: &KeyedRun) -> Result<(), ObserveError> {
        let stream = self.stream;
        stream.go_under(name);
        let scene = &run.run.frames.scene;
        self.at(self.moments.first().copied().unwrap_or(0));
        let begin = self.picture(run, self.moments.first().copied().unwrap_or(0))?;
        let keep = |entity: &str| SHARED.contains(&entity) || entity.starts_with("material_point/");
        let series = Series::chosen(stream, begin.kind, keep)?;
        self.colour(name, run)?;
        let common = Common {
            scope: self.scope.clone(),
            exaggeration: self.exaggeration,
        };
        let from = (Some(&**scene), &begin);
        let mut views = ViewState::of(stream, &Record::default(), from, series, Some(common))?;
        self.exaggeration = self.exaggeration.or_else(|| views.exaggeration());
        let toml = TextDocument::new(run.run.frames.scene_toml.as_str());
        stream.log_static(text::SCENE_TOML, &toml)?;
        self.write_series(&mut views, run)?;
        let mut difference = None;
        let mut followed = 0;
        for &moment in self.moments {
            let key = self.first.keys[moment];
            while followed < run.steps.len() && run.keys[followed] <= key {
                views.follow_point(&run.steps[followed]);
                followed += 1;
            }
            let frame = self.picture(run, moment)?;
            self.at(moment);
            views.follow(&frame);
            views.log(stream, Some(scene), &frame)?;
            let words = format!("## {}\n\n{}", run.run.name, run.run.frames.text(frame.step));
            stream.log(text::NOW, &TextDocument::from_markdown(words))?;
            if name != RUNS[0] {
                self.log_difference(&mut difference, moment, &frame)?;
            }
        }
        for kymograph in &mut views.kymographs {
            kymograph.log(stream)?;
        }
        self.shown.push(layout::ShownRun {
            name,
            views: views.shown(&begin, false),
        });
        stream.go_under("");
        Ok(())
    }

    /// What is logged next is of that moment of the first run.
    fn at(&self, moment: usize) {
        let frame = &self.first.steps[moment];
        let now = Moment::new(frame.step, frame.time_s, frame.passages);
        self.stream.set_time(now);
    }

    /// The picture of a run that is nearest to a moment.
    fn picture(&mut self, run: &KeyedRun, moment: usize) -> Result<Frame, ObserveError> {
        let key = self.first.keys[moment];
        let at = run.nearest(key);
        self.told.apart_steps = self.told.apart_steps.max(run.apart(at, key));
        let frame = run.run.frames.frame(run.steps[at].step);
        frame.ok_or_else(|| ObserveError::new(&*run.run.name, "one of its pictures is damaged"))
    }

    /// Curves of every step, at the first run's moments.
    fn write_series(&self, views: &mut ViewState, run: &KeyedRun) -> Result<(), ObserveError> {
        for (frame, key) in run.steps.iter().zip(&run.keys) {
            if *key > self.end {
                break;
            }
            let (step, time_s, passages) = self.first.moment(*key);
            let moved = Frame {
                step: step.round() as u64,
                time_s,
                passages,
                ..frame.clone()
            };
            views.series.follow(&moved);
            if views.series.is_full() {
                views.series.send(self.stream)?;
            }
        }
        views.series.send(self.stream)
    }

    /// Curves in views that runs share have the run's colour and name; the band is thin.
    fn colour(&self, name: &str, run: &KeyedRun) -> Result<(), ObserveError> {
        let colour = RUNS.iter().zip(COLOURS).find(|(own, _)| **own == name);
        let colour = Color::from(colour.map_or(SKY, |(_, colour)| colour));
        let what = &run.run.name;
        let life = SeriesLines::new()
            .with_colors([colour; 3])
            .with_widths([0.8, 2.4, 0.8])
            .with_names([
                format!("{what}, low"),
                what.clone(),
                format!("{what}, high"),
            ]);
        self.stream.log_static("life/log10_relative", &life)?;
        let peaks = SeriesLines::new()
            .with_colors([colour])
            .with_widths([1.8])
            .with_names([what.as_str()]);
        self.stream
            .log_static("material_point/cycles/counted", &peaks)
    }

    /// The pressure of a run less the first one's.
    fn log_difference(
        &mut self,
        raster: &mut Option<RasterEntity>,
        moment: usize,
        frame: &Frame,
    ) -> Result<(), ObserveError> {
        let first = self.picture(self.first, moment)?;
        let values = less(frame, &first);
        let greatest = values
            .iter()
            .fold(0.0_f32, |top, value| top.max(value.abs()));
        self.told.difference_pa = self.told.difference_pa.max(greatest.into());
        if raster.is_none() {
            let geometry = super::geometry::Geometry::of(&first, 1.0);
            let (pixels, plot) = (maps::pixels(geometry), maps::plot_box(geometry));
            let top = 0.5 * self.scope.ranges.pressure_pa;
            let look = Look::up_to("Δp", GPA, top, Ramp::Diverging);
            let new = RasterEntity::new(
                self.stream,
                layout::DIFFERENCE,
                look,
                pixels,
                &plot,
                Height::Fixed,
            );
            *raster = Some(new?);
        }
        match raster {
            Some(raster) => raster.log(self.stream, Field::BottomUp(&values, first.nx)),
            None => Ok(()),
        }
    }

    /// Says what stands beside what, and how near.
    fn tell(&self, names: &[&str], by: ComparedBy) -> Result<(), ObserveError> {
        let by = match by {
            ComparedBy::Time => "simulated time",
            ComparedBy::Place => "the place of a crest of body 1 (the way that body 1 has gone)",
        };
        let list = RUNS.iter().zip(names);
        let list: Vec<String> = list
            .map(|(run, name)| format!("- **{run}**: {name}"))
            .collect();
        let list = list.join("\n");
        let told = format!(
            "# Side by side\n\n{list}\n\nCompared by {by}. Timelines are those of {first}. All runs are shown at {moments} of \
             it, each by its nearest picture, at most {apart} of its own steps away. Colours, ranges and heights are \
             common to all. The difference is pressure less that of {first}, at most {difference} GPa.\n\n{caution}.\n",
            first = names.first().unwrap_or(&"a"),
            moments = counted(self.told.pictures, "moment"),
            apart = sig(self.told.apart_steps, 2),
            difference = sig(GPA.of(self.told.difference_pa), 3),
            caution = text::CAUTION,
        );
        self.stream
            .log_static(COMPARISON, &TextDocument::from_markdown(told))
    }
}

/// Pressure of a frame less that of another, on the other's nodes.
fn less(frame: &Frame, other: &Frame) -> Vec<f32> {
    let is_alike = (frame.nx, frame.ny) == (other.nx, other.ny)
        && [frame.x_min_m, frame.dx_m, frame.y_min_m, frame.dy_m]
            == [other.x_min_m, other.dx_m, other.y_min_m, other.dy_m];
    if is_alike {
        let pairs = frame.pressure_pa.iter().zip(&other.pressure_pa);
        return pairs.map(|(one, two)| one - two).collect();
    }
    let place = |at: f64, first: f64, step: f64, nodes: usize| {
        let place = (at - first) / step;
        (0.0..=(nodes - 1) as f64).contains(&place).then(|| {
            let low = (place as usize).min(nodes.saturating_sub(2));
            (low, place - low as f64)
        })
    };
    let mut values = Vec::with_capacity(other.pressure_pa.len());
    for (k, own) in other.pressure_pa.iter().enumerate() {
        let (i, j) = (k % other.nx, k / other.nx);
        let x = place(
            other.x_min_m + other.dx_m * i as f64,
            frame.x_min_m,
            frame.dx_m,
            frame.nx,
        );
        let y = place(
            other.y_min_m + other.dy_m * j as f64,
            frame.y_min_m,
            frame.dy_m,
            frame.ny,
        );
        // Beyond its edge there is no pressure.
        let value = x.zip(y).map_or(0.0, |((i, u), (j, v))| {
            let at = |i: usize, j: usize| {
                let (i, j) = (i.min(frame.nx - 1), j.min(frame.ny - 1));
                f64::from(frame.pressure_pa[j * frame.nx + i])
            };
            let row = |j: usize| at(i, j) * (1.0 - u) + at(i + 1, j) * u;
            row(j) * (1.0 - v) + row(j + 1) * v
        });
        values.push(value as f32 - own);
    }
    values
}
