//! The table as Parquet (feature `parquet`): the CSV's own cells, so that both always agree. A column is of numbers
//! (f64, empty cells null) where every cell is one, else of texts.

use std::sync::Arc;

use parquet::data_type::{ByteArray, ByteArrayType, DoubleType};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::parser::parse_message_type;

/// A table's bytes from its CSV text.
///
/// # Errors
/// What the Parquet library says.
pub fn parquet_table(csv: &str) -> Result<Vec<u8>, String> {
    written(csv).map_err(|error| error.to_string())
}

fn written(csv: &str) -> Result<Vec<u8>, ParquetError> {
    let mut reader = csv::Reader::from_reader(csv.as_bytes());
    let refused = |error: csv::Error| ParquetError::General(error.to_string());
    let names: Vec<String> = reader
        .headers()
        .map_err(refused)?
        .iter()
        .map(str::to_owned)
        .collect();
    let rows: Vec<csv::StringRecord> = reader
        .records()
        .collect::<Result<_, _>>()
        .map_err(refused)?;
    let columns: Vec<TableColumn> = (0..names.len())
        .map(|k| TableColumn::of(&rows, k))
        .collect();
    let fields: Vec<String> = names
        .iter()
        .zip(&columns)
        // Dots part the levels of a nested schema.
        .map(|(name, column)| {
            let (kind, text) = column.schema();
            format!("{kind} {}{text};", name.replace('.', "_"))
        })
        .collect();
    let schema = parse_message_type(&format!("message sweep {{ {} }}", fields.join(" ")))?;
    let properties = Arc::new(WriterProperties::builder().build());
    let mut writer = SerializedFileWriter::new(Vec::new(), Arc::new(schema), properties)?;
    let mut group = writer.next_row_group()?;
    for column in columns {
        let Some(mut to) = group.next_column()? else {
            break;
        };
        match column {
            TableColumn::Numbers(values, levels) => {
                to.typed::<DoubleType>()
                    .write_batch(&values, Some(&levels), None)?;
            }
            TableColumn::Words(words) => {
                to.typed::<ByteArrayType>()
                    .write_batch(&words, None, None)?;
            }
        }
        to.close()?;
    }
    group.close()?;
    writer.into_inner()
}

/// One column.
enum TableColumn {
    /// Values that are there, and for every row whether it has one.
    Numbers(Vec<f64>, Vec<i16>),
    Words(Vec<ByteArray>),
}

impl TableColumn {
    fn of(rows: &[csv::StringRecord], k: usize) -> Self {
        let cells = || rows.iter().map(|row| row.get(k).unwrap_or(""));
        let (mut values, mut levels) = (Vec::new(), Vec::new());
        for cell in cells() {
            match cell.parse() {
                Ok(value) => values.push(value),
                Err(_) if cell.is_empty() => {}
                Err(_) => return Self::Words(cells().map(ByteArray::from).collect()),
            }
            levels.push(i16::from(!cell.is_empty()));
        }
        Self::Numbers(values, levels)
    }

    /// What stands before and after the name in a schema.
    fn schema(&self) -> (&'static str, &'static str) {
        match self {
            Self::Numbers(..) => ("OPTIONAL DOUBLE", ""),
            Self::Words(_) => ("REQUIRED BYTE_ARRAY", " (UTF8)"),
        }
    }
}

#[cfg(test)]
#[expect(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use parquet::file::reader::{FileReader as _, SerializedFileReader};
    use parquet::record::RowAccessor as _;

    #[test]
    fn a_table_reads_back() {
        let csv = "case,motion.slide_roll,end,life\n0,0.1,converged,1.5\n1,0.2,stalled,\n";
        let bytes = parquet_table(csv).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("table.parquet");
        std::fs::write(&path, bytes).unwrap();
        let reader = SerializedFileReader::new(std::fs::File::open(&path).unwrap()).unwrap();
        let rows: Vec<_> = reader
            .get_row_iter(None)
            .unwrap()
            .map(Result::unwrap)
            .collect();
        assert_eq!(rows.len(), 2);
        assert_eq!(rows[1].get_double(1).unwrap(), 0.2);
        assert_eq!(rows[0].get_double(3).unwrap(), 1.5);
        assert!(rows[1].get_double(3).is_err(), "an empty cell is null");
        assert_eq!(rows[1].get_string(2).unwrap(), "stalled");
        let schema = reader.metadata().file_metadata().schema_descr();
        assert_eq!(schema.column(1).name(), "motion_slide_roll");
    }
}
