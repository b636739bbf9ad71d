//! What a researcher looks for, as views: the plots that the picture floor decides ([`ResearchPlot`]), every second picture.

use rerun::components::LineStrip2D;
use rerun::{LineStrips2D, Points2D, Radius};

use super::colour::{GREEN, GREY, ORANGE, PURPLE, SKY, faded};
use super::entities::research::entity;
use super::plot::{Labels, PlotBox};
use super::stream::{Holds, Stream};
use super::view::View;
use asperity_engine::scene::Scene;
use asperity_engine::sim::Frame;
use asperity_picture::plot::{Plot, Tone};
use asperity_picture::{PointTrace, Ranges, ResearchData, ResearchPlot, Scope, Spectra};

/// Means change slowly: they are drawn so many times less often, and once more at the end.
const SELDOM: u64 = 6;
/// Bytes that one takes at the end: three chunks of 2.4 kB and what is in them.
pub(crate) const LAST_BYTES: f64 = 9e3;
/// Height of a picture over its width.
const HEIGHT: f64 = 0.55;

/// Which of them a run with that first frame has.
pub(crate) fn shown(scene: &Scene, first: &Frame, rough: [bool; 2]) -> Vec<ResearchPlot> {
    let is_rough = rough.contains(&true);
    let has = |what: &ResearchPlot| match what {
        ResearchPlot::StressPath => first.material_point.is_some(),
        ResearchPlot::SnPoint => first.metrics.life.is_some(),
        ResearchPlot::Spectra => is_rough,
        ResearchPlot::AmplitudeRatio => is_rough && scene.lubricant.is_some(),
    };
    ResearchPlot::ALL.into_iter().filter(has).collect()
}

/// What each is drawn in; axes come with what is drawn.
pub(crate) fn plot_box() -> PlotBox {
    PlotBox {
        x: [0.0, 1.0],
        y: [-HEIGHT, 0.0],
        ..PlotBox::default()
    }
}

/// The plots and what they are made of.
pub(crate) struct ResearchEntity {
    scene: Scene,
    plots: Vec<ResearchPlot>,
    ranges: Ranges,
    trace: PointTrace,
    spectra: Spectra,
    /// Of each: the axes that the recording has, and what it has not yet.
    drawn: Vec<(Option<PlotBox>, Option<Plot>)>,
    pictures: u64,
}

impl ResearchEntity {
    /// Of these plots.
    pub(crate) fn new(scene: &Scene, plots: &[ResearchPlot], ranges: Ranges) -> Self {
        Self {
            scene: scene.clone(),
            plots: plots.to_vec(),
            ranges,
            trace: PointTrace::default(),
            spectra: Spectra::default(),
            drawn: vec![(None, None); plots.len()],
            pictures: 0,
        }
    }
}

impl View for ResearchEntity {
    fn widen(&mut self, _stream: &Stream, _scene: Option<&Scene>, scope: &Scope) {
        self.ranges = scope.ranges;
    }

    fn follow_scalars(&mut self, frame: &Frame) {
        self.trace.follow(frame);
    }

    fn follow_fields(&mut self, frame: &Frame) {
        self.spectra.follow(frame);
    }

    fn log(&mut self, _stream: &Stream, _frame: &Frame) {}

    fn log_seldom(&mut self, stream: &Stream, frame: &Frame) {
        let data = ResearchData {
            scene: &self.scene,
            trace: &self.trace,
            spectra: &self.spectra,
            ranges: &self.ranges,
            is_shared: false,
        };
        let is_due = self.pictures.is_multiple_of(SELDOM);
        self.pictures += 1;
        for (what, (axes, waiting)) in self.plots.iter().zip(&mut self.drawn) {
            *waiting = data.plot(*what, frame);
            if is_due || *what == ResearchPlot::StressPath {
                draw(stream, *what, axes, waiting.take());
            }
        }
    }

    fn finish(&mut self, stream: &Stream) {
        for (what, (axes, waiting)) in self.plots.iter().zip(&mut self.drawn) {
            draw(stream, *what, axes, waiting.take());
        }
    }
}

fn colour(tone: Tone) -> [u8; 3] {
    match tone {
        Tone::Stress => ORANGE,
        Tone::Film => SKY,
        Tone::Now => GREEN,
        Tone::Faint => GREY,
        Tone::Second => PURPLE,
    }
}

/// From shares of the axes to the view.
fn place([x, y]: [f64; 2]) -> [f32; 2] {
    [x as f32, (-HEIGHT * y) as f32]
}

fn axes(plot: &Plot) -> PlotBox {
    let named = plot.curves.iter().filter(|curve| !curve.name.is_empty());
    let names: Vec<_> = named.collect();
    let share = |k: usize| (k as f64 + 0.5) / names.len() as f64;
    let titles = names.iter().enumerate();
    let titles = titles.map(|(k, curve)| (share(k), curve.name.clone(), Some(colour(curve.tone))));
    let (x, y) = (plot.x.marks().into_iter(), plot.y.marks().into_iter());
    PlotBox {
        x_ticks: x.collect(),
        left_ticks: y.map(|(share, text)| (-HEIGHT * share, text)).collect(),
        x_title: format!("{}  (upwards: {})", plot.x.title, plot.y.title),
        titles: titles.collect(),
        ..plot_box()
    }
}

/// Draws a plot, where there is one, and its axes where the recording has others.
fn draw(stream: &Stream, what: ResearchPlot, has: &mut Option<PlotBox>, plot: Option<Plot>) {
    let Some(plot) = plot else {
        return;
    };
    let axes = axes(&plot);
    if has.as_ref() != Some(&axes) {
        axes.log(stream, &entity(what), Holds::FromNow);
        *has = Some(axes);
    }
    log(stream, what, &plot);
}

fn log(stream: &Stream, what: ResearchPlot, plot: &Plot) {
    let entity = entity(what);
    let (mut strips, mut colours, mut radii) = (Vec::new(), Vec::new(), Vec::new());
    for curve in &plot.curves {
        for part in plot.parts(curve) {
            strips.push(LineStrip2D::from_iter(part.into_iter().map(place)));
            colours.push(faded(colour(curve.tone), u8::MAX));
            let thin = curve.name.is_empty() || curve.tone == Tone::Faint;
            radii.push(Radius::new_ui_points(if thin { 0.75 } else { 1.5 }));
        }
    }
    let curves = LineStrips2D::new(strips)
        .with_colors(colours)
        .with_radii(radii)
        .with_draw_order(12.0);
    stream.log(&format!("{entity}/curves"), &curves);
    let marks = plot.marks.iter().filter_map(|mark| {
        let at = plot.x.share(mark.at[0]).zip(plot.y.share(mark.at[1]))?;
        Some((mark, [at.0, at.1]))
    });
    let marks: Vec<_> = marks.collect();
    let dots = Points2D::new(marks.iter().map(|(_, at)| place(*at)))
        .with_colors(marks.iter().map(|(mark, _)| faded(colour(mark.tone), 255)))
        .with_radii([Radius::new_ui_points(4.0)])
        .with_draw_order(26.0);
    stream.log(&format!("{entity}/marks"), &dots);
    let mut labels = Labels::default();
    for (mark, [x, y]) in marks {
        let down = if mark.is_below { 0.02 } else { -0.06 };
        labels.add([x, -HEIGHT * y + down], &mark.label);
    }
    match what {
        ResearchPlot::StressPath | ResearchPlot::SnPoint => {
            labels.log(stream, &format!("{entity}/words"), Holds::FromNow);
        }
        // Their marks have no words.
        ResearchPlot::Spectra | ResearchPlot::AmplitudeRatio => {}
    }
}
