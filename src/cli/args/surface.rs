//! The words of `asperity surface`.

use std::path::PathBuf;

use asperity_engine::scene::{MapLevel, MapOutliers};
use clap::Args;
use clap::builder::PossibleValuesParser;

/// `asperity surface`
#[derive(Debug, Args)]
pub(crate) struct SurfaceArgs {
    /// Heights (.npy, .csv, .txt, .x3p, .sur), or a scene: a preset's name, or its TOML file
    #[arg(value_name = "FILE|SCENE")]
    pub(crate) file: PathBuf,
    /// Side of a pixel, m [default: as the file says]
    #[arg(long, value_name = "M")]
    pub(crate) pixel_m: Option<f64>,
    /// Height that a value of 1 stands for, m [default: as the file says, else 1]
    #[arg(long, value_name = "M")]
    pub(crate) unit_m: Option<f64>,
    /// What is taken off by least squares
    #[arg(long, value_name = "FORM", default_value = MapLevel::Plane.key(), value_parser = PossibleValuesParser::new(MapLevel::KEYS))]
    level: String,
    /// What becomes of pixels that stand out
    #[arg(long, value_name = "WHAT", default_value = MapOutliers::Keep.key(), value_parser = PossibleValuesParser::new(MapOutliers::KEYS))]
    outliers: String,
    /// Rim that is cut off on every side, m, first of all
    #[arg(long, value_name = "M")]
    pub(crate) crop_m: Option<f64>,
    /// Turns the map from x towards y, degrees; lay: so that its ridges stand across x
    #[arg(long, value_name = "DEGREES|lay", allow_hyphen_values = true)]
    pub(crate) turn_deg: Option<Turn>,
    /// Cut-off of the S-filter, m: what is shorter is taken away, before the level (areal Gaussian, ISO 16610-61)
    #[arg(long, value_name = "M")]
    pub(crate) s_filter_m: Option<f64>,
    /// Cut-off of the L-filter, m: what is longer is taken away, after the level
    #[arg(long, value_name = "M")]
    pub(crate) l_filter_m: Option<f64>,
    /// Folder for pictures of the heights and of their spectrum along x
    #[arg(long, value_name = "FOLDER")]
    pub(crate) pictures: Option<PathBuf>,
    /// Scene to write with the surface on body 1; the file must not be there yet
    #[arg(long, value_name = "FILE.toml")]
    pub(crate) scene: Option<PathBuf>,
}

/// How a map is turned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Turn {
    /// By so much.
    Degrees(f64),
    /// Back by its lay.
    Lay,
}

impl std::str::FromStr for Turn {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "lay" {
            return Ok(Self::Lay);
        }
        let degrees = text
            .parse()
            .ok()
            .filter(|d: &f64| (-360.0..=360.0).contains(d));
        let degrees = degrees.map(Self::Degrees);
        degrees.ok_or_else(|| "a number, -360 to 360 degrees, or lay".to_owned())
    }
}

impl SurfaceArgs {
    /// The form that is taken off.
    pub(crate) fn level(&self) -> MapLevel {
        MapLevel::from_key(&self.level).unwrap_or(MapLevel::Plane)
    }

    /// What becomes of outliers.
    pub(crate) fn outliers(&self) -> MapOutliers {
        MapOutliers::from_key(&self.outliers).unwrap_or_default()
    }
}
