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
            (
                Dimension::Plain
                | Dimension::Share
                | Dimension::Time
                | Dimension::Volume
                | Dimension::Temperature,
                _,
            ) => dimension.unit(kind),
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
        self.choose(GPA, MPA, Unit::new("ksi", 1.0 / 6.894_757_293_168e6))
    }

    /// Film thickness.
    pub fn film(self) -> Unit {
        self.choose(Unit::new("nm", 1e9), UM, MICROINCH)
    }

    /// Roughness height.
    pub fn height(self) -> Unit {
        self.choose(UM, UM, MICROINCH)
    }

    /// Size of the contact.
    pub fn length(self) -> Unit {
        self.choose(UM, UM, Unit::new("mil", 1e3 / INCH_M))
    }

    /// Radius of a body.
    pub fn radius(self) -> Unit {
        let mm = Unit::new("mm", 1e3);
        self.choose(mm, mm, Unit::new("in", 1.0 / INCH_M))
    }

    /// Load.
    pub fn force(self) -> Unit {
        let newton = Unit::new("N", 1.0);
        self.choose(newton, newton, Unit::new("lbf", 1.0 / LBF_N))
    }

    /// Load of a line.
    pub fn force_per_length(self) -> Unit {
        let newton_per_m = Unit::new("N/m", 1.0);
        self.choose(
            newton_per_m,
            newton_per_m,
            Unit::new("lbf/in", INCH_M / LBF_N),
        )
    }

    /// Speed.
    pub fn speed(self) -> Unit {
        let m_per_s = Unit::new("m/s", 1.0);
        self.choose(m_per_s, m_per_s, Unit::new("in/s", 1.0 / INCH_M))
    }

    fn choose(self, gpa: Unit, mpa: Unit, shop: Unit) -> Unit {
        match self {
            Self::Gpa => gpa,
            Self::Mpa => mpa,
            Self::Shop => shop,
        }
    }
}

/// An inch, m.
const INCH_M: f64 = 0.0254;
/// A pound-force, N.
const LBF_N: f64 = 4.448_221_615_260_5;
const MICROINCH: Unit = Unit::new("µin", 1e6 / INCH_M);

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
