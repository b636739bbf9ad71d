//! Words of what is done with recordings, and of pictures.

use std::path::PathBuf;

use asperity_picture::export::Format;
use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

/// What to put side by side.
#[derive(Debug, Args)]
pub(crate) struct CompareArgs {
    /// Recordings, as written by run and explore
    #[arg(value_name = "FILE.rrd", required = true, num_args = 2..=3)]
    pub(crate) files: Vec<PathBuf>,
    /// Recording to write
    #[arg(long, value_name = "FILE.rrd", default_value = "both.rrd")]
    pub(crate) out: PathBuf,
    /// What is equal where runs are shown together
    #[arg(long, value_enum, value_name = "WHAT", default_value = "time")]
    pub(crate) by: CompareBy,
    /// Replace the file if it exists
    #[arg(long)]
    pub(crate) force: bool,
}

/// What is equal where runs are shown together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum CompareBy {
    /// Simulated time
    Time,
    /// The place of a crest of body 1
    Place,
}

/// The formats of exports by their words.
pub(super) fn export_formats() -> impl TypedValueParser<Value = Format> {
    let words = Format::ALL.map(|one| PossibleValue::new(one.key()).help(one.name()));
    PossibleValuesParser::new(words)
        .try_map(|chosen| Format::from_key(&chosen).ok_or("no format of an export"))
}

/// What to make of a recording.
#[derive(Debug, Args)]
pub(crate) struct ExportArgs {
    /// Recording, as written by run and explore
    #[arg(value_name = "FILE.rrd")]
    pub(crate) file: PathBuf,
    /// What to make
    #[arg(
        long = "as",
        value_name = "FORMATS",
        value_parser = export_formats(),
        value_delimiter = ',',
        default_value = "gif"
    )]
    pub(crate) formats: Vec<Format>,
    /// Folder to write to [default: ./NAME_export]
    #[arg(long, value_name = "FOLDER")]
    pub(crate) out: Option<PathBuf>,
    /// Recordings that are drawn beside it, each with its picture nearest in time
    #[arg(long, value_name = "FILE.rrd", value_delimiter = ',')]
    pub(crate) beside: Vec<PathBuf>,
    /// Which pictures, by name [default: all; of those that move the passage]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub(crate) show: Vec<String>,
    /// Still of the step nearest to this one [default: the last]
    #[arg(long, value_name = "N", conflicts_with = "every")]
    pub(crate) step: Option<u64>,
    /// Still of the step nearest to this simulated time, s
    #[arg(long, value_name = "S", conflicts_with_all = ["every", "step"], value_parser = finite)]
    pub(crate) at_s: Option<f64>,
    /// Stills of every N-th step at most
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) every: Option<u64>,
    /// Width of SVG and PDF, mm
    #[arg(long, value_name = "MM", default_value_t = 85.0, value_parser = within::<30, 1000>)]
    pub(crate) width_mm: f64,
    /// Pixels per inch of the fields in them
    #[arg(long, value_name = "DPI", default_value_t = 300.0, value_parser = within::<36, 1200>)]
    pub(crate) dpi: f64,
    /// Size of their type, points
    #[arg(long, value_name = "PT", default_value_t = 7.0, value_parser = within::<3, 24>)]
    pub(crate) font_pt: f64,
    /// Replace files that exist
    #[arg(long)]
    pub(crate) force: bool,
}

/// A number between two.
fn within<const LEAST: u32, const MOST: u32>(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|error| format!("{error}"))?;
    let fits = (f64::from(LEAST)..=f64::from(MOST)).contains(&value);
    fits.then_some(value)
        .ok_or_else(|| format!("allowed: {LEAST} to {MOST}"))
}

fn finite(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|error| format!("{error}"))?;
    let is_finite = value.is_finite().then_some(value);
    is_finite.ok_or_else(|| "a number of seconds is asked for".to_owned())
}

/// The values of a key that `--beside` names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct BesideValues {
    /// Key of a scene.
    pub(crate) key: String,
    /// As they were written.
    pub(crate) values: Vec<String>,
}

impl std::str::FromStr for BesideValues {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = "such as motion.slide_roll=0,0.5: a key and two or three values";
        let (key, values) = text.split_once('=').ok_or(wrong)?;
        let values: Vec<String> = values
            .split(',')
            .map(|value| value.trim().to_owned())
            .collect();
        let is_whole = !key.trim().is_empty() && values.iter().all(|value| !value.is_empty());
        if !is_whole || !(2..=3).contains(&values.len()) {
            return Err(wrong.to_owned());
        }
        Ok(Self {
            key: key.trim().to_owned(),
            values,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_read_or_refused() {
        let read = |text: &str| text.parse::<BesideValues>();
        let values = read("motion.slide_roll=0, 0.5").expect("two values");
        assert_eq!(
            (values.key.as_str(), values.values.len()),
            ("motion.slide_roll", 2)
        );
        for wrong in ["motion.slide_roll", "a=1", "a=1,,2", "=1,2", "a=1,2,3,4"] {
            assert!(read(wrong).is_err(), "{wrong}");
        }
    }
}
