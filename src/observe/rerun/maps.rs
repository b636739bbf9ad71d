//! Maps of the contact plane seen from above: x to the right (rolling direction), y up, mm.

use rerun::components::{Colormap, ImageFormat};
use rerun::{AnnotationContext, AsComponents, ChannelDatatype, Rgba32, SegmentationImage};

use super::colour::WHITE;
use super::geometry::Geometry;
use super::interferogram::Interferogram;
use super::picture::{Field, Pixels, Scale, Sign};
use super::plot::{Hertz, PlotBox, ticks_at};
use super::raster::{Height, Raster};
use super::stream::Stream;
use super::text::Widened;
use super::waiting::ClassImage;
use crate::observe::ObserveError;
use crate::observe::scales::{GPA, MPA, Ranges, UM, ticks};
use crate::sim::Frame;

/// Entities of the maps, each with its unit.
pub(super) const PRESSURE: &str = "maps/pressure_GPa";
pub(super) const FILM: &str = "maps/film_um";
pub(super) const TRACTION: &str = "maps/traction_on_body_1_MPa";
pub(super) const ROUGHNESS_1: &str = "maps/roughness_body_1_um";
pub(super) const ROUGHNESS_2: &str = "maps/roughness_body_2_um";
/// Drawn over pressure and film.
pub(super) const CONTACT: &str = "maps/contact_spots";
/// Hertz's contact, drawn over every map.
pub(super) const HERTZ: &str = "maps/hertz_contact";

/// Classes of the picture over the film map.
const CLASS_FILM: u8 = 0;
const CLASS_CONTACT: u8 = 1;
const CLASS_THICK: u8 = 2;

/// The maps that change.
pub(super) struct Maps {
    geometry: Geometry,
    pressure: Raster,
    film: Raster,
    traction: Raster,
    roughness: [Option<Raster>; 2],
    interferogram: Interferogram,
    contact: ClassImage,
    hertz: Hertz,
}

impl Maps {
    /// Sets up the maps.
    pub(super) fn new(
        stream: &Stream,
        geometry: Geometry,
        ranges: &Ranges,
    ) -> Result<Self, ObserveError> {
        let up_to = Scale::up_to;
        let (positive, both) = (Sign::Positive, Sign::Both);
        let inferno = up_to(ranges.pressure_pa, GPA, positive, Colormap::Inferno);
        let viridis = up_to(ranges.film_m, UM, positive, Colormap::Viridis);
        let signed = up_to(ranges.traction_pa, MPA, both, Colormap::CyanToYellow);
        let rough_top = up_to(ranges.roughness_m, UM, both, Colormap::CyanToYellow);
        let map = |entity, scale: Scale, title: &str| {
            let title = format!("{title}, {}", scale.unit);
            let (pixels, plot) = (pixels(geometry), plot_box(geometry));
            Raster::new(
                stream,
                entity,
                scale,
                pixels,
                &plot,
                (&title, Height::Fixed),
            )
        };
        let rough_map = |k: usize, entity| {
            ranges.rough[k]
                .then(|| map(entity, rough_top.clone(), "height"))
                .transpose()
        };
        let maps = Self {
            geometry,
            pressure: map(PRESSURE, inferno, "p")?,
            film: map(FILM, viridis, "h")?,
            traction: map(TRACTION, signed, "shear")?,
            roughness: [rough_map(0, ROUGHNESS_1)?, rough_map(1, ROUGHNESS_2)?],
            interferogram: Interferogram::new(stream, geometry)?,
            contact: stream.class_image(CONTACT),
            hertz: Hertz::default(),
        };
        log_contact_style(stream, geometry)?;
        Ok(maps)
    }

    /// The images, for the notes in the recording and for what is told of them.
    pub(super) fn rasters(&self) -> impl Iterator<Item = (&'static str, &Raster)> {
        let [one, two] = &self.roughness;
        let always = [
            (PRESSURE, &self.pressure),
            (FILM, &self.film),
            (TRACTION, &self.traction),
        ];
        let rough = [(ROUGHNESS_1, one), (ROUGHNESS_2, two)];
        let rough = rough
            .into_iter()
            .filter_map(|(entity, raster)| Some((entity, raster.as_ref()?)));
        always.into_iter().chain(rough)
    }

    /// Widens the ranges from now on; what has changed, with its tops before and after.
    pub(super) fn reach(
        &mut self,
        stream: &Stream,
        ranges: &Ranges,
    ) -> Result<Vec<Widened>, ObserveError> {
        let mut widened = Vec::new();
        let [rough_1, rough_2] = &mut self.roughness;
        let always = [
            (PRESSURE, Some(&mut self.pressure), ranges.pressure_pa),
            (FILM, Some(&mut self.film), ranges.film_m),
            (TRACTION, Some(&mut self.traction), ranges.traction_pa),
            (ROUGHNESS_1, rough_1.as_mut(), ranges.roughness_m),
            (ROUGHNESS_2, rough_2.as_mut(), ranges.roughness_m),
        ];
        for (entity, raster, top_si) in always {
            if let Some(raster) = raster
                && let Some(tops) = raster.reach(stream, top_si)?
            {
                widened.push((entity, tops, raster.scale().unit));
            }
        }
        Ok(widened)
    }

    /// Upper end of the pressure's colour range, Pa.
    pub(super) fn pressure_top_pa(&self) -> f64 {
        self.pressure.scale().top / GPA.1
    }

    /// Upper end of the film's colour range, m.
    pub(super) fn film_top_m(&self) -> f64 {
        self.film.scale().top / UM.1
    }

    pub(super) fn interferogram(&self) -> &Interferogram {
        &self.interferogram
    }

    /// Which bodies are rough.
    pub(super) fn rough(&self) -> [bool; 2] {
        [self.roughness[0].is_some(), self.roughness[1].is_some()]
    }

    /// Logs one frame's pressure, film and contact spots, and Hertz's contact.
    pub(super) fn log(&mut self, stream: &Stream, frame: &Frame) -> Result<(), ObserveError> {
        let g = self.geometry;
        let upright = |field| Field::BottomUp(field, g.nx);
        self.hertz.log_ring(stream, HERTZ, frame)?;
        self.pressure.log(stream, upright(&frame.pressure_pa))?;
        self.film.log(stream, upright(&frame.film_m))?;
        let top = self.film_top_m() as f32;
        let mut films = frame.film_m.chunks_exact(g.nx);
        stream.log_classes(self.contact, |classes| {
            Field::BottomUp(&frame.contact, g.nx).write_to(classes, |touches, classes| {
                classify_row(touches, films.next().unwrap_or_default(), top, classes);
            });
        })
    }

    /// Logs what stands beside them in a tab of its own: interferogram, shear, roughness.
    pub(super) fn log_beside(&self, stream: &Stream, frame: &Frame) -> Result<(), ObserveError> {
        let g = self.geometry;
        let upright = |field| Field::BottomUp(field, g.nx);
        self.traction.log(stream, upright(&frame.traction_pa))?;
        let fields = [&frame.roughness_1_m, &frame.roughness_2_m];
        for (raster, field) in self.roughness.iter().zip(fields) {
            if let Some(raster) = raster {
                raster.log(stream, upright(field))?;
            }
        }
        self.interferogram.log(stream, frame)
    }
}

dispatched! {
    fn classify_row(touches: &[u8], film: &[f32], top: f32, classes: &mut [u8]) {
        for ((out, &touches), &film) in classes.iter_mut().zip(touches).zip(film) {
            let apart = if film > top { CLASS_THICK } else { CLASS_FILM };
            *out = if touches == 0 { apart } else { CLASS_CONTACT };
        }
    }
}

fn pixels(g: Geometry) -> Pixels {
    Pixels {
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

fn log_contact_style(stream: &Stream, g: Geometry) -> Result<(), ObserveError> {
    let pixels = pixels(g);
    let format = ImageFormat::segmentation(pixels.resolution(), ChannelDatatype::U8);
    let image = SegmentationImage::update_fields()
        .with_format(format)
        .with_opacity(1.0)
        .with_draw_order(5.0);
    let context = AnnotationContext::new([
        (
            CLASS_FILM.into(),
            "film",
            Rgba32::from_unmultiplied_rgba(0, 0, 0, 0),
        ),
        (
            CLASS_CONTACT.into(),
            "contact",
            Rgba32::from_rgb(90, 255, 250),
        ),
        // The bath around the contact would drown the film in the top colour.
        (
            CLASS_THICK.into(),
            "film above the colour range",
            Rgba32::from_rgb(30, 33, 40),
        ),
    ]);
    stream.log_static(
        CONTACT,
        &[&image as &dyn AsComponents, &pixels.transform(), &context],
    )
}
