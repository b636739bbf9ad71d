//! Maps of the contact plane seen from above: x to the right (rolling direction), y up, mm.

use rerun::components::ImageFormat;
use rerun::{AsComponents, ChannelDatatype};

use super::classes;
use super::entities::maps::{
    CONTACT, FILM, HERTZ, OIL_RISE, PRESSURE, ROUGHNESS_1, ROUGHNESS_2, SURFACE_1, SURFACE_2,
    TRACTION,
};
use super::geometry::Geometry;
use super::interferogram::Interferogram;
use super::picture::{Field, PixelField};
use super::plot::{HertzCurve, PlotBox, ticks_at};
use super::raster::{Height, RasterEntity};
use super::stream::Stream;
use super::view::View;
use asperity_engine::math::number::ticks;
use asperity_engine::scene::Scene;
use asperity_engine::sim::Frame;
use asperity_picture::{Look, Ranges, Scope, Subject};

/// The maps and what they show.
const MAPS: [(&str, Subject); 5] = [
    (PRESSURE, Subject::Pressure),
    (FILM, Subject::Film),
    (TRACTION, Subject::Traction),
    (ROUGHNESS_1, Subject::Roughness1),
    (ROUGHNESS_2, Subject::Roughness2),
];

/// The same of temperature.
const RISES: [(&str, Subject); 3] = [
    (SURFACE_1, Subject::Surface1),
    (SURFACE_2, Subject::Surface2),
    (OIL_RISE, Subject::OilRise),
];

/// What a run with that first frame shows of temperature.
pub(crate) fn rises(first: &Frame) -> &'static [(&'static str, Subject)] {
    if first.film_rise_k.is_empty() {
        &[]
    } else {
        &RISES
    }
}

/// A map.
struct Map {
    entity: &'static str,
    subject: Subject,
    raster: RasterEntity,
}

impl Map {
    fn log(&self, stream: &Stream, frame: &Frame) {
        if let Some(field) = self.subject.field(frame) {
            self.raster.log(stream, Field::BottomUp(&field, frame.nx));
        }
    }

    /// Whether it is in every picture: the others stand beside them in a tab of its own.
    fn is_first(&self) -> bool {
        matches!(self.subject, Subject::Pressure | Subject::Film)
    }
}

/// The maps that change.
pub(crate) struct Maps {
    geometry: Geometry,
    all: Vec<Map>,
    interferogram: Interferogram,
    film: Look,
    hertz: HertzCurve,
}

impl Maps {
    /// Sets up the maps.
    pub(crate) fn new(
        stream: &Stream,
        geometry: Geometry,
        ranges: &Ranges,
        rises: &[(&'static str, Subject)],
    ) -> Self {
        let is_shown = |subject: &Subject| match subject {
            Subject::Roughness1 => ranges.rough[0],
            Subject::Roughness2 => ranges.rough[1],
            Subject::Pressure
            | Subject::Film
            | Subject::Interferogram
            | Subject::Contact
            | Subject::Traction
            | Subject::Surface1
            | Subject::Surface2
            | Subject::OilRise
            | Subject::RoughnessOfBoth
            | Subject::EffectiveStress
            | Subject::ShearStress => true,
        };
        let all = MAPS.iter().chain(rises).copied();
        let shown = all.filter(|(_, subject)| is_shown(subject));
        let (pixels, plot) = (pixels(geometry), plot_box(geometry));
        let maps = shown.map(|(entity, subject)| {
            let look = Look::of(subject, ranges);
            Map {
                entity,
                subject,
                raster: RasterEntity::new(stream, entity, look, pixels, &plot, Height::Fixed),
            }
        });
        let maps = maps.collect();
        let format = ImageFormat::segmentation(pixels.resolution(), ChannelDatatype::U8);
        let image = classes::styled().with_format(format);
        let parts: [&dyn AsComponents; 3] = [&image, &pixels.transform(), &classes::context()];
        stream.log_static(CONTACT, &parts);
        Self {
            geometry,
            all: maps,
            interferogram: Interferogram::new(stream, geometry),
            film: Look::of(Subject::Film, ranges),
            hertz: HertzCurve::default(),
        }
    }

    pub(crate) fn interferogram(&self) -> &Interferogram {
        &self.interferogram
    }
}

impl View for Maps {
    fn widen(&mut self, stream: &Stream, _scene: Option<&Scene>, scope: &Scope) {
        self.film = Look::of(Subject::Film, &scope.ranges);
        for map in &mut self.all {
            map.raster
                .widen(stream, Look::of(map.subject, &scope.ranges));
        }
    }

    /// Pressure, film and contact spots, and Hertz's contact.
    fn log(&mut self, stream: &Stream, frame: &Frame) {
        let nx = self.geometry.nx;
        self.hertz.log_ring(stream, HERTZ, frame);
        for map in self.all.iter().filter(|map| map.is_first()) {
            map.log(stream, frame);
        }
        let mut films = frame.film_m.chunks_exact(nx);
        let mut image = Vec::new();
        Field::BottomUp(&frame.contact, nx).write_to(&mut image, |touches, classes| {
            let film = films.next().unwrap_or_default();
            classes::of_row(&self.film, touches, film, classes);
        });
        classes::log(stream, CONTACT, image);
    }

    /// What stands beside them in a tab of its own: interferogram, shear, roughness.
    fn log_seldom(&mut self, stream: &Stream, frame: &Frame) {
        for map in self.all.iter().filter(|map| !map.is_first()) {
            map.log(stream, frame);
        }
        self.interferogram.log(stream, frame);
    }

    fn rasters(&self) -> Vec<(&'static str, &RasterEntity)> {
        let all = self.all.iter();
        all.map(|map| (map.entity, &map.raster)).collect()
    }
}

/// A pixel for each node.
pub(crate) fn pixels(g: Geometry) -> PixelField {
    PixelField {
        columns: g.nx,
        rows: g.ny,
        first: [g.x_min, -g.y_max()],
        size: [g.dx, g.dy],
    }
}

/// The axes of every map.
pub(crate) fn plot_box(g: Geometry) -> PlotBox {
    let x = [g.x_min - 0.5 * g.dx, g.x_max() + 0.5 * g.dx];
    let y = [-g.y_max() - 0.5 * g.dy, -g.y_min + 0.5 * g.dy];
    let is_narrow = x[1] - x[0] < 0.4 * (y[1] - y[0]);
    PlotBox {
        x,
        y,
        // As many as there is room for beneath a narrow map.
        x_ticks: ticks_at(&ticks(x[0], x[1], if is_narrow { 2 } else { 5 }), |x| x),
        left_ticks: ticks_at(&ticks(-y[1], -y[0], 5), |y| -y),
        x_title: "x, mm  (rolling direction →)".into(),
        titles: vec![(0.1, "y, mm".into(), None)],
        ..PlotBox::default()
    }
}
