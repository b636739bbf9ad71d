//! Views and their properties, which the layout's stream carries apart.

use rerun::blueprint::components::{BackgroundKind, Corner2D, Enabled, VisualBounds2D as Bounds};
use rerun::blueprint::{
    ContainerLike, Spatial2DView, Spatial3DView, TextDocumentView, TimeSeriesView,
};
use rerun::datatypes::{Range1D, Range2D};
use rerun::external::re_sdk_types::blueprint::archetypes::{
    Background, EyeControls3D, LineGrid3D, PlotLegend, ScalarAxis, TextDocumentFormat,
    VisualBounds2D,
};
use rerun::{AsComponents, Color};

use crate::colour::BACKGROUND;
use crate::entities::maps;
use crate::entities::space::{SPACE, UPPER_BODY, UPPER_LABELS};
use crate::plot::{Margin, PlotBox};

/// A property of a view and the path it goes to.
pub(crate) struct Property {
    pub(crate) path: String,
    pub(crate) value: Box<dyn AsComponents>,
}

/// What lines and labels are drawn on: their colours were chosen for it, and a viewer's theme may be light or dark.
fn background() -> Background {
    Background::new(BackgroundKind::SolidColor).with_color(Color::from(BACKGROUND))
}

/// Views under construction, with their properties.
#[derive(Default)]
pub(crate) struct Views {
    pub(crate) properties: Vec<Property>,
    /// The run of several whose entities views show, with a stroke behind it; empty: there is one.
    pub(crate) under: String,
}

impl Views {
    /// Notes a property of a view that has just been made.
    pub(crate) fn set(
        &mut self,
        view: &ContainerLike,
        name: &str,
        value: impl AsComponents + 'static,
    ) {
        if let ContainerLike::View(view) = view {
            self.properties.push(Property {
                path: format!("{}/{name}", view.blueprint_path()),
                value: Box::new(value),
            });
        }
    }

    /// A view of a plot: its own entity, what is drawn over it, and bounds with room for the axes.
    pub(crate) fn plot(
        &mut self,
        name: &str,
        contents: &[&str],
        plot: &PlotBox,
        right: Margin,
    ) -> ContainerLike {
        self.framed(name, contents, plot.bounds(right))
    }

    /// Same of several plots, with bounds that hold all of them.
    pub(crate) fn framed(
        &mut self,
        name: &str,
        contents: &[&str],
        [x, y]: [[f64; 2]; 2],
    ) -> ContainerLike {
        let contents = contents
            .iter()
            .map(|entity| format!("/{}{entity}/**", self.under));
        let view = Spatial2DView::new(name)
            .with_origin("/")
            .with_contents(contents)
            .into();
        let range = Range2D {
            x_range: Range1D(x),
            y_range: Range1D(y),
        };
        self.set(&view, "VisualBounds2D", VisualBounds2D::new(Bounds(range)));
        self.set(&view, "Background", background());
        view
    }

    pub(crate) fn map(
        &mut self,
        name: &str,
        entity: &str,
        over: &[&str],
        plot: &PlotBox,
    ) -> ContainerLike {
        let mut contents = vec![entity, maps::HERTZ];
        contents.extend_from_slice(over);
        self.plot(name, &contents, plot, Margin::Legend)
    }

    pub(crate) fn space(&mut self, name: &str, camera: [[f64; 3]; 2]) -> ContainerLike {
        let view = Spatial3DView::new(name)
            .with_origin(format!("/{}{SPACE}", self.under))
            .into();
        self.look(&view, camera);
        view
    }

    /// The same without the body above, which would hide the pressure.
    pub(crate) fn lecture_space(&mut self, name: &str, camera: [[f64; 3]; 2]) -> ContainerLike {
        let view = Spatial3DView::new(name)
            .with_origin(format!("/{}{SPACE}", self.under))
            .with_contents([
                format!("+ /{}{SPACE}/**", self.under),
                format!("- /{}{UPPER_BODY}/**", self.under),
                format!("- /{}{UPPER_LABELS}/**", self.under),
            ])
            .into();
        self.look(&view, camera);
        view
    }

    fn look(&mut self, view: &ContainerLike, [target, eye]: [[f64; 3]; 2]) {
        let controls = EyeControls3D::new()
            .with_position(eye.map(|v| v as f32))
            .with_look_target(target.map(|v| v as f32))
            .with_eye_up([0.0_f32, 0.0, 1.0]);
        self.set(view, "EyeControls3D", controls);
        self.set(view, "Background", background());
        self.set(view, "LineGrid3D", LineGrid3D::new().with_visible(false));
    }

    /// Curves whose title says all that a legend would, and hides none.
    pub(crate) fn single(&mut self, name: &str, entity: &str) -> ContainerLike {
        let view = self.series(name, &[entity]);
        self.set(&view, "PlotLegend", PlotLegend::new().with_visible(false));
        view
    }

    /// Curves with the viewer's legend.
    pub(crate) fn named(&mut self, what: &str, entities: &[&str]) -> ContainerLike {
        let view = self.series(what, entities);
        let legend = PlotLegend::new().with_corner(Corner2D::RightTop);
        self.set(&view, "PlotLegend", legend);
        view
    }

    /// Curves with the viewer's legend at the upper left, out of the way of values up to 1 (lines of yes and no).
    pub(crate) fn switches(&mut self, name: &str, entity: &str) -> ContainerLike {
        let view = self.series(name, &[entity]);
        let legend = PlotLegend::new().with_corner(Corner2D::LeftTop);
        self.set(&view, "PlotLegend", legend);
        let axis = ScalarAxis::new().with_range(Range1D([-0.1, 3.4]));
        self.set(&view, "ScalarAxis", axis);
        view
    }

    pub(crate) fn series(&mut self, name: &str, entities: &[&str]) -> ContainerLike {
        let contents = entities
            .iter()
            .map(|entity| format!("/{}{entity}/**", self.under));
        TimeSeriesView::new(name)
            .with_origin("/")
            .with_contents(contents)
            .into()
    }

    pub(crate) fn document(&mut self, name: &str, entity: &str) -> ContainerLike {
        let view = TextDocumentView::new(name)
            .with_origin(format!("/{}{entity}", self.under))
            .into();
        let format = TextDocumentFormat::new().with_monospace(Enabled::from(true));
        self.set(&view, "TextDocumentFormat", format);
        view
    }
}
