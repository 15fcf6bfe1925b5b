//! Tables of Apache Parquet: columns of numbers and texts, each value possibly missing, with texts that describe the
//! file.
//!
//! One row group, Snappy compression, no nested columns: DuckDB, polars, pandas, pyarrow and Spark read it. The same
//! table always gives the same bytes.
//!
//! Source: Apache Parquet Format 2.x, <https://parquet.apache.org/docs/file-format/> (unverified).
//! Pinned by: the tests below; tests of the command, which other readers repeat

use crate::error::Error;
use bytes::Bytes;
use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::column::writer::ColumnWriter;
use parquet::data_type::{ByteArray, DataType};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;
use std::sync::Arc;

/// The values of a column; `None` is missing.
#[derive(Debug, Clone, PartialEq)]
pub enum ColumnValues {
    /// Texts.
    Text(Vec<Option<String>>),
    /// Whole numbers.
    Whole(Vec<Option<i64>>),
    /// Numbers of double precision. A NaN is missing.
    Double(Vec<f64>),
    /// Numbers of single precision, with about seven significant digits. A NaN is missing.
    Single(Vec<f32>),
}

/// A column.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Name of the column.
    pub name: String,
    /// Values of the column, one per row.
    pub values: ColumnValues,
}

/// A table in columns of the same length.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ParquetTable {
    /// The columns, in their order.
    pub columns: Vec<Column>,
    /// Texts about the file: key, value.
    pub about: Vec<(String, String)>,
}

impl ColumnValues {
    /// Number of values.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            ColumnValues::Text(values) => values.len(),
            ColumnValues::Whole(values) => values.len(),
            ColumnValues::Double(values) => values.len(),
            ColumnValues::Single(values) => values.len(),
        }
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    fn physical(&self) -> Physical {
        match self {
            ColumnValues::Text(_) => Physical::BYTE_ARRAY,
            ColumnValues::Whole(_) => Physical::INT64,
            ColumnValues::Double(_) => Physical::DOUBLE,
            ColumnValues::Single(_) => Physical::FLOAT,
        }
    }
}

impl ParquetTable {
    /// The bytes of a file.
    ///
    /// # Errors
    /// Columns of different lengths, or two with one name.
    pub fn write(&self) -> Result<Vec<u8>, Error> {
        self.check()?;
        self.bytes().map_err(|error| failed(&error))
    }

    /// Number of rows: values of the first column.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |column| column.values.len())
    }

    fn check(&self) -> Result<(), Error> {
        let rows = self.rows();
        for (k, column) in self.columns.iter().enumerate() {
            let found = column.values.len();
            if found != rows {
                return Err(Error::Record {
                    found: format!("the column `{}` with {found} values", column.name),
                    expected: format!("{rows}, as in the first column"),
                });
            }
            if self.columns[..k].iter().any(|other| other.name == column.name) {
                return Err(Error::Record {
                    found: format!("two columns `{}`", column.name),
                    expected: "different names".into(),
                });
            }
        }
        Ok(())
    }

    fn bytes(&self) -> Result<Vec<u8>, ParquetError> {
        let fields = self.columns.iter().map(|column| {
            let physical = column.values.physical();
            let logical = (physical == Physical::BYTE_ARRAY).then_some(LogicalType::String);
            let field = Type::primitive_type_builder(&column.name, physical)
                .with_repetition(Repetition::OPTIONAL)
                .with_logical_type(logical);
            field.build().map(Arc::new)
        });
        let fields = fields.collect::<Result<_, _>>()?;
        let schema = Type::group_type_builder("schema").with_fields(fields).build()?;
        let about = self.about.iter().map(|(key, value)| KeyValue::new(key.clone(), value.clone())).collect();
        let properties = WriterProperties::builder()
            .set_compression(Compression::SNAPPY)
            .set_key_value_metadata(Some(about))
            .build();
        let mut out = SerializedFileWriter::new(Vec::new(), Arc::new(schema), Arc::new(properties))?;
        let mut group = out.next_row_group()?;
        for column in &self.columns {
            write_column(&mut group, &column.values)?;
        }
        group.close()?;
        out.into_inner()
    }
}

fn write_column(group: &mut SerializedRowGroupWriter<'_, Vec<u8>>, values: &ColumnValues) -> Result<(), ParquetError> {
    let Some(mut column) = group.next_column()? else { return Ok(()) };
    let levels = |present: &mut dyn Iterator<Item = bool>| -> Vec<i16> { present.map(i16::from).collect() };
    match (column.untyped(), values) {
        (ColumnWriter::ByteArrayColumnWriter(out), ColumnValues::Text(values)) => {
            let known: Vec<ByteArray> = values.iter().flatten().map(|text| ByteArray::from(text.as_str())).collect();
            out.write_batch(&known, Some(&levels(&mut values.iter().map(Option::is_some))), None)?;
        }
        (ColumnWriter::Int64ColumnWriter(out), ColumnValues::Whole(values)) => {
            let known: Vec<i64> = values.iter().flatten().copied().collect();
            out.write_batch(&known, Some(&levels(&mut values.iter().map(Option::is_some))), None)?;
        }
        (ColumnWriter::DoubleColumnWriter(out), ColumnValues::Double(values)) => {
            let known: Vec<f64> = values.iter().copied().filter(|value| !value.is_nan()).collect();
            out.write_batch(&known, Some(&levels(&mut values.iter().map(|value| !value.is_nan()))), None)?;
        }
        (ColumnWriter::FloatColumnWriter(out), ColumnValues::Single(values)) => {
            let known: Vec<f32> = values.iter().copied().filter(|value| !value.is_nan()).collect();
            out.write_batch(&known, Some(&levels(&mut values.iter().map(|value| !value.is_nan()))), None)?;
        }
        // The schema was made from these columns.
        _ => return Err(ParquetError::General("a column of another type".to_owned())),
    }
    column.close()
}

fn failed(error: &ParquetError) -> Error {
    Error::Record { found: error.to_string(), expected: "a whole table of Apache Parquet".into() }
}

impl ParquetTable {
    /// Reads a table whose columns have the types that [`ParquetTable::write`] gives them.
    ///
    /// # Errors
    /// Bytes that are no whole file of Parquet; columns of other types.
    pub fn read(bytes: &[u8]) -> Result<ParquetTable, Error> {
        let reader = SerializedFileReader::new(Bytes::copy_from_slice(bytes)).map_err(|error| failed(&error))?;
        let metadata = reader.metadata().file_metadata();
        let about = metadata.key_value_metadata().into_iter().flatten();
        let about = about.filter_map(|pair| Some((pair.key.clone(), pair.value.clone()?))).collect();
        let schema = metadata.schema_descr();
        let mut columns = Vec::with_capacity(schema.num_columns());
        for column in schema.columns() {
            let nested = column.max_rep_level() > 0 || column.max_def_level() > 1;
            let values = match column.physical_type() {
                _ if nested => {
                    return Err(Error::Record {
                        found: format!("the nested column `{}`", column.path()),
                        expected: "one value per row and column".into(),
                    });
                }
                Physical::BYTE_ARRAY => ColumnValues::Text(Vec::new()),
                Physical::INT64 => ColumnValues::Whole(Vec::new()),
                Physical::DOUBLE => ColumnValues::Double(Vec::new()),
                Physical::FLOAT => ColumnValues::Single(Vec::new()),
                other => {
                    return Err(Error::Record {
                        found: format!("the column `{}` of the type {other}", column.name()),
                        expected: "texts, 64-bit whole numbers, or numbers of single or double precision".into(),
                    });
                }
            };
            columns.push(Column { name: column.name().to_owned(), values });
        }
        for k in 0..reader.num_row_groups() {
            let group = reader.get_row_group(k).map_err(|error| failed(&error))?;
            let rows = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
            for (i, column) in columns.iter_mut().enumerate() {
                let values = group.get_column_reader(i).and_then(|values| column.values.extend(values, rows));
                values.map_err(|error| failed(&error))?;
            }
        }
        Ok(ParquetTable { columns, about })
    }

    /// The values of a column.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&ColumnValues> {
        self.columns.iter().find(|column| column.name == name).map(|column| &column.values)
    }

    /// A text about the file.
    #[must_use]
    pub fn about(&self, key: &str) -> Option<&str> {
        self.about.iter().find(|(own, _)| own == key).map(|(_, value)| value.as_str())
    }
}

impl ColumnValues {
    /// Adds the values of a group of rows. Columns are read whole, not row by row: readers of rows are a large part of
    /// the crate.
    fn extend(&mut self, reader: ColumnReader, rows: usize) -> Result<(), ParquetError> {
        match (self, reader) {
            (ColumnValues::Text(values), ColumnReader::ByteArrayColumnReader(reader)) => {
                for value in known(reader, rows)? {
                    values.push(value.map(|text| text.as_utf8().map(str::to_owned)).transpose()?);
                }
            }
            (ColumnValues::Whole(values), ColumnReader::Int64ColumnReader(reader)) => {
                values.extend(known(reader, rows)?);
            }
            (ColumnValues::Double(values), ColumnReader::DoubleColumnReader(reader)) => {
                values.extend(known(reader, rows)?.into_iter().map(|value| value.unwrap_or(f64::NAN)));
            }
            (ColumnValues::Single(values), ColumnReader::FloatColumnReader(reader)) => {
                values.extend(known(reader, rows)?.into_iter().map(|value| value.unwrap_or(f32::NAN)));
            }
            // The column was made from the type in the file.
            _ => return Err(ParquetError::General("a column of another type".to_owned())),
        }
        Ok(())
    }
}

/// One value per row; `None` is missing.
fn known<T: DataType>(mut reader: ColumnReaderImpl<T>, rows: usize) -> Result<Vec<Option<T::T>>, ParquetError> {
    let (mut present, mut levels) = (Vec::new(), Vec::new());
    let (read, _, _) = reader.read_records(rows, Some(&mut levels), None, &mut present)?;
    if read < rows {
        return Err(ParquetError::General(format!("a column with {read} values instead of {rows}")));
    }
    let mut present = present.into_iter();
    // A column in which no value can be missing has no levels.
    if levels.is_empty() {
        return Ok(present.map(Some).collect());
    }
    Ok(levels.into_iter().map(|level| if level > 0 { present.next() } else { None }).collect())
}
