//! Three systems of units for people; how a number is written is [`asperity_engine::math::number`].

use crate::tui::kinds::shifted;
use asperity_engine::math::number::{GPA, MPA, UM};
use asperity_engine::scene::ContactKind;
use asperity_engine::sim::{Dimension, Frame, Quantity};

pub use asperity_engine::math::number::{
    Unit, bytes, nice_ceiling, seconds, sig, sig_or_dash, tick,
};

/// A number as people type it: decimal commas and typographic minus signs, too.
pub fn read_number(text: &str) -> Option<f64> {
    let plain = text.trim().replace(',', ".").replace('−', "-");
    plain.parse().ok()
}

/// A system of units for the screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Units {
    /// GPa, nm, µm, N, m/s.
    #[default]
    Gpa,
    /// MPa, µm, N, m/s.
    Mpa,
    /// ksi, µin, lbf, in/s.
    Shop,
}

impl Units {
    /// The next system.
    #[must_use]
    pub fn next(self) -> Self {
        shifted(&[Self::Gpa, Self::Mpa, Self::Shop], self, 1)
    }

    /// Unit of what is measured.
    pub fn unit(self, dimension: Dimension, kind: ContactKind) -> Unit {
        match (dimension, kind) {
            (Dimension::Pressure, _) => self.pressure(),
            (Dimension::Film, _) => self.film(),
            (Dimension::Height, _) => self.height(),
            (Dimension::Length, _) => self.length(),
            (Dimension::Speed, _) => self.speed(),
            (Dimension::Load, ContactKind::Point) => self.force(),
            (Dimension::Load, ContactKind::Line) => self.force_per_length(),
            (Dimension::Plain | Dimension::Share | Dimension::Time | Dimension::Volume, _) => {
                dimension.unit(kind)
            }
        }
    }

    /// A quantity of a frame with its unit; a dash while it is not known.
    pub fn show(self, quantity: &Quantity, frame: &Frame, digits: i32) -> String {
        let unit = self.unit(quantity.dimension, frame.kind);
        let text = quantity
            .number(frame)
            .map_or_else(|| "–".to_owned(), |value| unit.show(value, digits));
        text.trim_end().to_owned()
    }

    /// Pressure and stress.
    pub fn pressure(self) -> Unit {
        match self {
            Self::Gpa => GPA,
            Self::Mpa => MPA,
            Self::Shop => Unit::new("ksi", 1.0 / 6.894_757_293_168e6),
        }
    }

    /// Film thickness.
    pub fn film(self) -> Unit {
        match self {
            Self::Gpa => Unit::new("nm", 1e9),
            Self::Mpa => UM,
            Self::Shop => Unit::new("µin", 1e6 / 0.0254),
        }
    }

    /// Roughness height.
    pub fn height(self) -> Unit {
        match self {
            Self::Gpa | Self::Mpa => UM,
            Self::Shop => Unit::new("µin", 1e6 / 0.0254),
        }
    }

    /// Size of the contact.
    pub fn length(self) -> Unit {
        match self {
            Self::Gpa | Self::Mpa => UM,
            Self::Shop => Unit::new("mil", 1e3 / 0.0254),
        }
    }

    /// Radius of a body.
    pub fn radius(self) -> Unit {
        match self {
            Self::Gpa | Self::Mpa => Unit::new("mm", 1e3),
            Self::Shop => Unit::new("in", 1.0 / 0.0254),
        }
    }

    /// Load.
    pub fn force(self) -> Unit {
        match self {
            Self::Gpa | Self::Mpa => Unit::new("N", 1.0),
            Self::Shop => Unit::new("lbf", 1.0 / 4.448_221_615_260_5),
        }
    }

    /// Load of a line.
    pub fn force_per_length(self) -> Unit {
        match self {
            Self::Gpa | Self::Mpa => Unit::new("N/m", 1.0),
            Self::Shop => Unit::new("lbf/in", 0.0254 / 4.448_221_615_260_5),
        }
    }

    /// Speed.
    pub fn speed(self) -> Unit {
        match self {
            Self::Gpa | Self::Mpa => Unit::new("m/s", 1.0),
            Self::Shop => Unit::new("in/s", 1.0 / 0.0254),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_agree_on_the_quantity() {
        assert_eq!(Units::Gpa.pressure().show(1.73e9, 3), "1.73 GPa");
        assert_eq!(Units::Mpa.pressure().show(1.73e9, 4), "1730 MPa");
        assert_eq!(Units::Shop.pressure().show(1.73e9, 3), "251 ksi");
        assert_eq!(Units::Shop.force().show(800.0, 3), "180 lbf");
        assert_eq!(Units::Gpa.next().next().next(), Units::Gpa);
    }
}
