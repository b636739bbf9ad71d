//! What a step is written as.

asperity_engine::closed_set! {
    /// What is written of a step: the word that chooses it, and what it is.
    pub enum Format {
        /// NumPy's archives.
        Npz = "npz" "Fields as numpy archives",
        /// One of them for all steps.
        NpzSeries = "npz-series" "Fields of all steps in one numpy archive, with a time axis",
        /// VTK's image data.
        Vti = "vti" "Fields for ParaView, and what else reads VTK",
        /// Pictures in pixels.
        Png = "png" "Maps and centre line as pictures",
        /// Pictures in vectors.
        Svg = "svg" "The same as papers print them: sized in mm, axes and text as vectors, no title",
        /// The same on pages.
        Pdf = "pdf" "The same as PDF",
        /// Pictures that move.
        Gif = "gif" "All steps one after another",
        /// A table.
        Csv = "csv" "Every scalar of every step (of a recording; a run has --table)",
    }
}

/// What becomes of steps in a format.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FormatKind {
    /// A file of arrays each.
    Fields,
    /// A file of arrays of all.
    Series,
    /// A file for each picture of each.
    Pictures,
    /// A file for each picture of all.
    Moving,
    /// Rows of a table, which this does not write.
    Table,
}

impl Format {
    pub(super) fn ending(self) -> &'static str {
        match self {
            Self::Npz | Self::NpzSeries => "npz",
            Self::Vti => "vti",
            Self::Png => "png",
            Self::Svg => "svg",
            Self::Pdf => "pdf",
            Self::Gif => "gif",
            Self::Csv => "csv",
        }
    }

    /// Whether it shows pictures.
    pub fn is_drawn(self) -> bool {
        matches!(self.kind(), FormatKind::Pictures | FormatKind::Moving)
    }

    pub(super) fn kind(self) -> FormatKind {
        match self {
            Self::Npz | Self::Vti => FormatKind::Fields,
            Self::NpzSeries => FormatKind::Series,
            Self::Png | Self::Svg | Self::Pdf => FormatKind::Pictures,
            Self::Gif => FormatKind::Moving,
            Self::Csv => FormatKind::Table,
        }
    }
}
