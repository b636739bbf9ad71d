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
    /// Folder for pictures of the heights and of their spectrum along x
    #[arg(long, value_name = "FOLDER")]
    pub(crate) pictures: Option<PathBuf>,
    /// Scene to write with the surface on body 1; the file must not be there yet
    #[arg(long, value_name = "FILE.toml")]
    pub(crate) scene: Option<PathBuf>,
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
