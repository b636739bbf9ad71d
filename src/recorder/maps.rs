//! Maps of the contact plane seen from above: x to the right (rolling direction), y up, mm.

use rerun::components::ImageFormat;
use rerun::{AsComponents, ChannelDatatype};

use super::classes;
use super::colour::WHITE;
use super::geometry::Geometry;
use super::interferogram::Interferogram;
use super::picture::{Field, PixelField};
use super::plot::{HertzCurve, PlotBox, ticks_at};
use super::raster::{Height, RasterEntity};
use super::stream::Stream;
use super::text::Widened;
use super::waiting::ClassImage;
use asperity_engine::math::number::ticks;
use asperity_engine::observe::ObserveError;
use asperity_engine::sim::Frame;
use asperity_picture::{Look, Ranges, Subject};

/// Entities of the maps, each with its unit.
pub(super) const PRESSURE: &str = "maps/pressure_GPa";
pub(super) const FILM: &str = "maps/film_um";
pub(super) const TRACTION: &str = "maps/traction_on_body_1_MPa";
pub(super) const ROUGHNESS_1: &str = "maps/roughness_body_1_um";
pub(super) const ROUGHNESS_2: &str = "maps/roughness_body_2_um";
/// Drawn over the film.
pub(super) const CONTACT: &str = "maps/contact_spots";
/// Hertz's contact, drawn over every map.
pub(super) const HERTZ: &str = "maps/hertz_contact";

/// The maps and what they show.
const MAPS: [(&str, Subject); 5] = [
    (PRESSURE, Subject::Pressure),
    (FILM, Subject::Film),
    (TRACTION, Subject::Traction),
    (ROUGHNESS_1, Subject::Roughness1),
    (ROUGHNESS_2, Subject::Roughness2),
];

/// A map.
struct Map {
    entity: &'static str,
    subject: Subject,
    raster: RasterEntity,
}

impl Map {
    fn log(&self, stream: &Stream, frame: &Frame) -> Result<(), ObserveError> {
        match self.subject.field(frame) {
            Some(field) => self.raster.log(stream, Field::BottomUp(&field, frame.nx)),
            None => Ok(()),
        }
    }

    /// Whether it is in every picture: the others stand beside them in a tab of its own.
    fn is_first(&self) -> bool {
        matches!(self.subject, Subject::Pressure | Subject::Film)
    }
}

/// The maps that change.
pub(super) struct Maps {
    geometry: Geometry,
    shown: Vec<Map>,
    interferogram: Interferogram,
    contact: ClassImage,
    film: Look,
    hertz: HertzCurve,
}

impl Maps {
    /// Sets up the maps.
    pub(super) fn new(
        stream: &Stream,
        geometry: Geometry,
        ranges: &Ranges,
    ) -> Result<Self, ObserveError> {
        let listed = MAPS.into_iter().filter(|(_, subject)| match subject {
            Subject::Roughness1 => ranges.rough[0],
            Subject::Roughness2 => ranges.rough[1],
            Subject::Pressure
            | Subject::Film
            | Subject::Interferogram
            | Subject::Contact
            | Subject::Traction
            | Subject::RoughnessOfBoth
            | Subject::EffectiveStress
            | Subject::ShearStress => true,
        });
        let shown = listed.map(|(entity, subject)| {
            let look = Look::of(subject, ranges);
            let (pixels, plot) = (pixels(geometry), plot_box(geometry));
            let raster = RasterEntity::new(stream, entity, look, pixels, &plot, Height::Fixed)?;
            Ok(Map {
                entity,
                subject,
                raster,
            })
        });
        let maps = Self {
            geometry,
            shown: shown.collect::<Result<_, _>>()?,
            interferogram: Interferogram::new(stream, geometry)?,
            contact: stream.class_image(CONTACT),
            film: Look::of(Subject::Film, ranges),
            hertz: HertzCurve::default(),
        };
        let pixels = pixels(geometry);
        let format = ImageFormat::segmentation(pixels.resolution(), ChannelDatatype::U8);
        let image = classes::styled().with_format(format);
        let parts: [&dyn AsComponents; 3] = [&image, &pixels.transform(), &classes::context()];
        stream.log_static(CONTACT, &parts)?;
        Ok(maps)
    }

    /// The images, for the notes in the recording and for what is told of them.
    pub(super) fn rasters(&self) -> impl Iterator<Item = (&'static str, &RasterEntity)> {
        self.shown.iter().map(|map| (map.entity, &map.raster))
    }

    /// Widens the ranges from now on; what has changed, with its tops before and after.
    pub(super) fn reach(
        &mut self,
        stream: &Stream,
        ranges: &Ranges,
    ) -> Result<Vec<Widened>, ObserveError> {
        self.film = Look::of(Subject::Film, ranges);
        let mut widened = Vec::new();
        for map in &mut self.shown {
            let look = Look::of(map.subject, ranges);
            let tops = map.raster.reach(stream, look)?;
            widened.extend(tops.map(|tops| (map.entity, tops, look.unit.name)));
        }
        Ok(widened)
    }

    pub(super) fn interferogram(&self) -> &Interferogram {
        &self.interferogram
    }

    /// Logs one frame's pressure, film and contact spots, and Hertz's contact.
    pub(super) fn log(&mut self, stream: &Stream, frame: &Frame) -> Result<(), ObserveError> {
        let nx = self.geometry.nx;
        self.hertz.log_ring(stream, HERTZ, frame)?;
        for map in self.shown.iter().filter(|map| map.is_first()) {
            map.log(stream, frame)?;
        }
        let mut films = frame.film_m.chunks_exact(nx);
        stream.log_classes(self.contact, |classes| {
            Field::BottomUp(&frame.contact, nx).write_to(classes, |touches, classes| {
                classes::of_row(
                    &self.film,
                    touches,
                    films.next().unwrap_or_default(),
                    classes,
                );
            });
        })
    }

    /// Logs what stands beside them in a tab of its own: interferogram, shear, roughness.
    pub(super) fn log_beside(&self, stream: &Stream, frame: &Frame) -> Result<(), ObserveError> {
        for map in self.shown.iter().filter(|map| !map.is_first()) {
            map.log(stream, frame)?;
        }
        self.interferogram.log(stream, frame)
    }
}

/// A pixel for each node.
pub(super) fn pixels(g: Geometry) -> PixelField {
    PixelField {
        columns: g.nx,
        rows: g.ny,
        first: [g.x_min, -g.y_max()],
        size: [g.dx, g.dy],
    }
}

/// The axes of every map.
pub(super) fn plot_box(g: Geometry) -> PlotBox {
    let x = [g.x_min - 0.5 * g.dx, g.x_max() + 0.5 * g.dx];
    let y = [-g.y_max() - 0.5 * g.dy, -g.y_min + 0.5 * g.dy];
    PlotBox {
        x,
        y,
        x_ticks: ticks_at(&ticks(x[0], x[1], 5), |x| x),
        left_ticks: ticks_at(&ticks(-y[1], -y[0], 5), |y| -y),
        x_title: "x, mm  (rolling direction →)".into(),
        titles: vec![(0.1, "y, mm".into(), WHITE)],
        ..PlotBox::default()
    }
}
