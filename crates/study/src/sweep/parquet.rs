//! The table as a Parquet file.
//!
//! `table => one row group`: case and counts as 64-bit integers, columns with numbers in every row as doubles, the rest
//! as text; a cell that is empty is null. Columns are compressed by Snappy.

use std::io::{self, Write};
use std::sync::Arc;

use parquet::basic::{Compression, ConvertedType, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;

use crate::sweep::row::RESULTS;
use crate::sweep::table::Table;

/// Columns of whole numbers.
const COUNTS: [&str; 3] = ["case", "steps", "force_evaluations"];
/// Columns that are always text.
const TEXTS: [&str; 2] = ["status", "state_hash"];

/// Type of a column.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Count,
    Number,
    Text,
}

/// Writes a table.
///
/// # Errors
/// If the writer fails.
pub fn write(table: &Table, to: impl Write + Send) -> io::Result<()> {
    written(table, to).map_err(io::Error::other)
}

fn written(table: &Table, to: impl Write + Send) -> Result<(), ParquetError> {
    let kinds: Vec<Kind> = (0..table.header.len()).map(|column| kind(table, column)).collect();
    let fields = table.header.iter().zip(&kinds).map(|(name, kind)| field(name, *kind));
    let fields = fields.collect::<Result<Vec<_>, _>>()?;
    let schema = Type::group_type_builder("sweep").with_fields(fields).build()?;
    let properties = WriterProperties::builder().set_compression(Compression::SNAPPY);
    let properties =
        properties.set_created_by(concat!("dbd-sweep ", env!("CARGO_PKG_VERSION")).into());
    let mut file = SerializedFileWriter::new(to, Arc::new(schema), Arc::new(properties.build()))?;
    let mut rows = file.next_row_group()?;
    for (column, kind) in kinds.iter().enumerate() {
        let cells = || table.rows.iter().map(|row| row[column].as_str());
        match kind {
            Kind::Count => put::<Int64Type>(&mut rows, cells().map(|cell| cell.parse().ok()))?,
            Kind::Number => put::<DoubleType>(&mut rows, cells().map(|cell| cell.parse().ok()))?,
            Kind::Text => {
                let text = |cell: &str| (!cell.is_empty()).then(|| ByteArray::from(cell));
                put::<ByteArrayType>(&mut rows, cells().map(text))?;
            }
        }
    }
    rows.close()?;
    file.close()?;
    Ok(())
}

/// The type of a column by its name and, for an axis, its cells.
fn kind(table: &Table, column: usize) -> Kind {
    let name = table.header[column].as_str();
    let is_axis = (1..table.axes).contains(&column);
    let is_number = |row: &Vec<String>| row[column].parse::<f64>().is_ok();
    match () {
        () if is_axis && table.rows.iter().all(is_number) => Kind::Number,
        () if is_axis => Kind::Text,
        () if COUNTS.contains(&name) => Kind::Count,
        () if TEXTS.contains(&name) && column < table.axes + RESULTS.len() => Kind::Text,
        () => Kind::Number,
    }
}

fn field(name: &str, kind: Kind) -> Result<Arc<Type>, ParquetError> {
    let physical = match kind {
        Kind::Count => Physical::INT64,
        Kind::Number => Physical::DOUBLE,
        Kind::Text => Physical::BYTE_ARRAY,
    };
    let field = Type::primitive_type_builder(name, physical).with_repetition(Repetition::OPTIONAL);
    let field = match kind {
        Kind::Text => field
            .with_logical_type(Some(LogicalType::String))
            .with_converted_type(ConvertedType::UTF8),
        _ => field,
    };
    Ok(Arc::new(field.build()?))
}

/// Writes the next column: its values, and which rows have one.
fn put<T: DataType>(
    rows: &mut SerializedRowGroupWriter<'_, impl Write + Send>,
    cells: impl Iterator<Item = Option<T::T>>,
) -> Result<(), ParquetError> {
    let (mut values, mut present) = (Vec::new(), Vec::new());
    for cell in cells {
        present.push(i16::from(cell.is_some()));
        values.extend(cell);
    }
    let Some(mut column) = rows.next_column()? else {
        return Err(ParquetError::General("the table has too many columns".into()));
    };
    column.typed::<T>().write_batch(&values, Some(&present), None)?;
    column.close()
}

#[cfg(test)]
mod tests {
    use parquet::file::reader::{FileReader as _, SerializedFileReader};
    use parquet::record::Field;

    use super::*;

    #[test]
    fn a_file_is_read_back_to_the_bit() {
        let header = ["case", "scheme", "body.b.mass", "status", "state_hash", "step_s", "steps"];
        let header = header.iter().chain(&["a.max"]).map(|name| (*name).to_owned()).collect();
        let rows = [
            ["1", "rk4", "0.1", "ok", "00ff", "2e-5", "1000", "-0.3333333333333333"],
            ["2", "rk4", "5e-324", "failed: \"é\", so", "", "", "", ""],
        ];
        let rows = rows.map(|row| row.map(str::to_owned).to_vec()).to_vec();
        let table = Table { header, axes: 3, rows };
        let mut file = tempfile::tempfile().unwrap();
        write(&table, &mut file).unwrap();
        let reader = SerializedFileReader::new(file).unwrap();
        let read: Vec<Vec<(String, Field)>> =
            reader.get_row_iter(None).unwrap().map(|row| row.unwrap().into_columns()).collect();
        let text = |text: &str| Field::Str(text.to_owned());
        let expected = [
            [
                Field::Long(1),
                text("rk4"),
                Field::Double(0.1),
                text("ok"),
                text("00ff"),
                Field::Double(2e-5),
                Field::Long(1000),
                Field::Double(-1.0 / 3.0),
            ],
            [
                Field::Long(2),
                text("rk4"),
                Field::Double(5e-324),
                text("failed: \"é\", so"),
                Field::Null,
                Field::Null,
                Field::Null,
                Field::Null,
            ],
        ];
        assert_eq!(read.len(), expected.len());
        for (row, expected) in read.iter().zip(&expected) {
            assert!(row.iter().map(|(name, _)| name).eq(&table.header));
            assert!(row.iter().map(|(_, field)| field).eq(expected), "{row:?}");
        }
    }
}
