//! Tables of Apache Parquet.

use ambulo_formats::parquet::{Column, ColumnValues, ParquetTable};

fn table() -> ParquetTable {
    let column = |name: &str, values| Column { name: name.to_owned(), values };
    ParquetTable {
        columns: vec![
            column("trial", ColumnValues::Text(vec![Some("walk 1".into()), None, Some("größer, \"3\"".into())])),
            column("frames", ColumnValues::Whole(vec![Some(131), Some(-2), None])),
            column("mass_kg", ColumnValues::Double(vec![72.6, f64::NAN, 0.1])),
            column("knee_angle_r", ColumnValues::Single(vec![f32::NAN, 1.5, -0.25])),
        ],
        about: vec![("unit of mass_kg".into(), "kg".into()), ("version".into(), "1".into())],
    }
}

#[test]
fn a_table_is_read_as_it_was_written_with_missing_values_and_texts_about_it() {
    let bytes = table().write().unwrap();
    assert!(bytes.starts_with(b"PAR1") && bytes.ends_with(b"PAR1"));
    let read = ParquetTable::read(&bytes).unwrap();
    // A NaN is not equal to itself.
    assert_eq!(format!("{read:?}"), format!("{:?}", table()));
    assert_eq!(read.about("version"), Some("1"));
    assert_eq!(table().write().unwrap(), bytes, "the same table has the same bytes");
}

#[test]
fn columns_of_other_lengths_or_one_name_are_refused() {
    let mut longer = table();
    longer.columns[1].values = ColumnValues::Whole(vec![Some(1)]);
    let error = longer.write().unwrap_err().to_string();
    assert!(error.contains("`frames` with 1 values") && error.contains("3, as in the first"), "{error}");
    let mut twice = table();
    twice.columns[1].name = "trial".to_owned();
    assert!(twice.write().unwrap_err().to_string().contains("two columns `trial`"));
}

#[test]
fn a_file_that_was_cut_is_refused() {
    let bytes = table().write().unwrap();
    for end in [0, 4, bytes.len() / 2, bytes.len() - 1] {
        let error = ParquetTable::read(&bytes[..end]).unwrap_err().to_string();
        assert!(error.contains("a whole table of Apache Parquet"), "{end}: {error}");
    }
}

#[test]
fn a_table_without_rows_keeps_its_columns() {
    let empty = ParquetTable {
        columns: vec![Column { name: "trial".into(), values: ColumnValues::Text(Vec::new()) }],
        about: Vec::new(),
    };
    assert_eq!(ParquetTable::read(&empty.write().unwrap()).unwrap(), empty);
}
