//! Several recordings as one: their runs side by side, in common ranges and colours, at common moments.
//!
//! ```text
//! a.rrd, b.rrd ──> frames ──> common ranges ──> a/..., b/..., difference/..., one layout
//! key      simulated time t, or the place of a crest of body 1: ∫ U1 dt
//! moments  those of the first run's pictures up to the smallest last key for which each other run has a picture within a
//!          step of its own; of it the nearest by key
//! ```
//! Frames go the way of any recording's, so that what is seen beside each other differs by the runs alone. Fields come in
//! the half precision of the recordings; a run less itself is 0 to the bit.

mod keyed;
mod layout;

use std::path::Path;

use rerun::{Color, SeriesLines, TextDocument};

pub use self::keyed::{ComparedBy, RunBeside};
use self::keyed::{KeyedRun, less};
pub(crate) use self::layout::RUNS;
use super::colour::curve::{GREEN, SKY, VERMILION};
use super::entities::series::{LIFE, POINT_CYCLES};
use super::entities::{self, DIFFERENCE, SCALARS};
use super::geometry::Geometry;
use super::maps;
use super::moment::Moment;
use super::picture::Field;
use super::raster::{Height, RasterEntity};
use super::run_views::{Common, RunViews};
use super::series::Series;
use super::stream::Stream;
use super::text;
use asperity_engine::math::number::{GPA, counted, sig};
use asperity_engine::observe::{ObserveError, Overwrite};
use asperity_engine::scene::Record;
use asperity_engine::sim::Frame;
use asperity_picture::{Look, Ramp, Scope};

/// Colour of each in curves that they share.
const COLOURS: [[u8; 3]; 3] = [VERMILION, SKY, GREEN];
/// Curves that runs share a view of.
const SHARED: [&str; 5] = [
    LIFE,
    POINT_CYCLES,
    "series/pressure_GPa",
    "series/film_um",
    "series/friction",
];

/// The life that a run ended with.
#[derive(Debug, Clone, PartialEq)]
pub struct LifeBeside {
    /// Name of the run.
    pub name: String,
    /// Relative to its own smooth contact.
    pub own: f64,
    /// Relative to the first run's; `None`: their models differ, or the recording is older than this number.
    pub common: Option<f64>,
}

impl std::fmt::Display for LifeBeside {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let common = (self.common).map_or_else(
            || "not comparable with the first run's".to_owned(),
            |life| format!("{} of the first run's smooth contact", sig(life, 3)),
        );
        write!(
            f,
            "{}: life {} of its own smooth contact, {common}",
            self.name,
            sig(self.own, 3)
        )
    }
}

/// Lives that runs ended with, as far as they have any: `life_common = life_relative life_smooth/life_smooth(first)`.
fn lives(runs: &[KeyedRun]) -> Vec<LifeBeside> {
    let of = |run: &KeyedRun| {
        let life = run.steps.last()?.metrics.life?;
        Some((life.life_relative, life.life_smooth))
    };
    let first = runs.first();
    let base = first.and_then(of).map_or(0.0, |(_, smooth)| smooth);
    let model = |run: &KeyedRun| run.run.frames.scene.life.clone();
    let same = |run: &KeyedRun| first.is_some_and(|first| model(first) == model(run));
    let life = |run: &KeyedRun| {
        let (own, smooth) = of(run)?;
        let common = (base > 0.0 && smooth > 0.0 && same(run)).then(|| own * smooth / base);
        Some(LifeBeside {
            name: run.run.name.clone(),
            own,
            common,
        })
    };
    runs.iter().filter_map(life).collect()
}

/// What was written.
#[derive(Debug, Clone, PartialEq)]
pub struct RunsCompared {
    /// Lives of the runs that have any.
    pub lives: Vec<LifeBeside>,
    /// Moments at which all runs are shown.
    pub pictures: u64,
    /// How far a run's picture is from its moment at most, in its own steps.
    pub apart_steps: f64,
    /// Maximum pressure of a run less the first one's, Pa.
    pub difference_pa: f64,
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
    let moments = together(first, others, moments);
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
        report: RunsCompared {
            lives: lives(&keyed),
            pictures: moments.len() as u64,
            apart_steps: 0.0,
            difference_pa: 0.0,
        },
    };
    for (name, run) in RUNS.into_iter().zip(&keyed) {
        written.write(name, run)?;
    }
    let names: Vec<&str> = runs.iter().map(|run| run.name.as_str()).collect();
    written.log_comparison(&names, by);
    layout::send(&stream, &written.shown, &names)?;
    let report = written.report;
    // Half a comparison is worth no name.
    stream.flush(None)?;
    if let Some(file) = stream.to().file() {
        file.mark_worth_keeping();
    }
    stream.close()?;
    Ok(report)
}

/// Farthest that a picture may be from its moment, in its own steps; less what rounding makes of a whole step.
const WITHIN: f64 = 1.0 + 1e-6;

/// The moments for which every other run has a picture within a step: where runs kept only every so-many-th step, not all
/// have one. All of them where there are hardly any such.
fn together(first: &KeyedRun, others: &[KeyedRun], moments: Vec<usize>) -> Vec<usize> {
    let is_near = |run: &KeyedRun, at: usize| {
        let key = first.keys[at];
        run.apart(run.nearest(key), key) <= WITHIN
    };
    let all_near = |at: &usize| others.iter().all(|run| is_near(run, *at));
    let near: Vec<usize> = moments.iter().copied().filter(all_near).collect();
    if near.len() >= 2 { near } else { moments }
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
    report: RunsCompared,
}

impl Written<'_> {
    /// Writes a run under its name.
    fn write(&mut self, name: &'static str, run: &KeyedRun) -> Result<(), ObserveError> {
        let stream = self.stream;
        stream.enter_run(name);
        let scene = &run.run.frames.scene;
        self.at(self.moments.first().copied().unwrap_or(0));
        let begin = self.picture(run, self.moments.first().copied().unwrap_or(0))?;
        let keep = |entity: &str| {
            SHARED.contains(&entity) || entity == SCALARS || entity.starts_with("material_point/")
        };
        let series = Series::chosen(stream, begin.kind, keep);
        self.colour(name, run);
        let common = Common {
            scope: self.scope.clone(),
            exaggeration: self.exaggeration,
        };
        let record = Record::default();
        let mut views = RunViews::new(stream, &record, Some(scene), &begin, series, Some(common))?;
        self.exaggeration = self.exaggeration.or(views.exaggeration);
        let toml = TextDocument::new(run.run.frames.scene_toml.as_str());
        stream.log_static(entities::text::SCENE_TOML, &toml);
        self.write_series(&mut views, run);
        let mut difference = None;
        let mut followed = 0;
        for &moment in self.moments {
            let key = self.first.keys[moment];
            while followed < run.steps.len() && run.keys[followed] <= key {
                views.follow_scalars(&run.steps[followed]);
                followed += 1;
            }
            let frame = self.picture(run, moment)?;
            self.at(moment);
            views.follow(&frame);
            views.log(stream, Some(scene), &frame);
            let words = format!("## {}\n\n{}", run.run.name, run.run.frames.text(frame.step));
            stream.log(entities::text::NOW, &TextDocument::from_markdown(words));
            let words = run.run.frames.lecture(frame.step);
            stream.log(entities::text::LECTURE, &TextDocument::from_markdown(words));
            if name != RUNS[0] {
                self.log_difference(&mut difference, moment, &frame)?;
            }
        }
        views.finish(stream);
        self.shown.push(layout::ShownRun {
            name,
            views: views.shown,
        });
        stream.enter_run("");
        Ok(())
    }

    /// What is logged next is of that moment of the first run.
    fn at(&self, moment: usize) {
        let frame = &self.first.steps[moment];
        let now = Moment::of_frame(frame);
        self.stream.set_time(now);
    }

    /// The picture of a run that is nearest to a moment.
    fn picture(&mut self, run: &KeyedRun, moment: usize) -> Result<Frame, ObserveError> {
        let key = self.first.keys[moment];
        let at = run.nearest(key);
        self.report.apart_steps = self.report.apart_steps.max(run.apart(at, key));
        let frame = run.run.frames.frame(run.steps[at].step);
        frame.ok_or_else(|| ObserveError::new(&*run.run.name, "one of its pictures is damaged"))
    }

    /// Curves of every step, at the first run's moments.
    fn write_series(&self, views: &mut RunViews, run: &KeyedRun) {
        for (frame, key) in run.steps.iter().zip(&run.keys) {
            if *key > self.end {
                break;
            }
            let (step, time_s, passages) = self.first.moment(*key);
            let step = step.round() as u64;
            self.stream.set_time(Moment::new(step, time_s, passages));
            views.series.follow(self.stream, frame);
        }
        views.series.send(self.stream);
    }

    /// Curves in views that runs share have the run's colour and name; the band is thin.
    fn colour(&self, name: &str, run: &KeyedRun) {
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
        self.stream.log_static(LIFE, &life);
        let peaks = SeriesLines::new()
            .with_colors([colour])
            .with_widths([1.8])
            .with_names([what.as_str()]);
        self.stream.log_static(POINT_CYCLES, &peaks);
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
        let maximum = values
            .iter()
            .fold(0.0_f32, |top, value| top.max(value.abs()));
        self.report.difference_pa = self.report.difference_pa.max(maximum.into());
        if raster.is_none() {
            let geometry = Geometry::of(&first, 1.0);
            let (pixels, plot) = (maps::pixels(geometry), maps::plot_box(geometry));
            let top = 0.5 * self.scope.ranges.pressure_pa;
            let look = Look::up_to("Δp", GPA, top, Ramp::Diverging);
            let height = Height::Fixed;
            let new = RasterEntity::new(self.stream, DIFFERENCE, look, pixels, &plot, height);
            *raster = Some(new);
        }
        if let Some(raster) = raster {
            raster.log(self.stream, Field::BottomUp(&values, first.nx));
        }
        Ok(())
    }

    /// Says what stands beside what, and how near.
    fn log_comparison(&self, names: &[&str], by: ComparedBy) {
        let by = match by {
            ComparedBy::Time => "simulated time",
            ComparedBy::Place => {
                "the place of a crest of body 1 (the distance that body 1 has gone)"
            }
        };
        let list = RUNS.iter().zip(names);
        let list: Vec<String> = list
            .map(|(run, name)| format!("- **{run}**: {name}"))
            .collect();
        let list = list.join("\n");
        let told = format!(
            "# Side by side\n\n{list}\n\nCompared by {by}. Timelines are those of {first}. All runs are shown at {moments} of \
             it, each by its nearest picture, at most {apart} of its own steps away. Colours, ranges and heights are \
             common to all. The difference is pressure less that of {first}, at most {difference} GPa.\n\n{lives}{caution}.\n",
            lives = self
                .report
                .lives
                .iter()
                .fold(String::new(), |text, life| format!("{text}- {life}\n"))
                + "\n",
            first = names.first().unwrap_or(&"a"),
            moments = counted(self.report.pictures, "moment"),
            apart = sig(self.report.apart_steps, 2),
            difference = sig(GPA.of(self.report.difference_pa), 3),
            caution = text::CAUTION,
        );
        let told = TextDocument::from_markdown(told);
        self.stream.log_static(entities::text::COMPARISON, &told);
    }
}
