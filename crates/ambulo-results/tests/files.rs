//! Files of a run.

use ambulo::analysis::Event;
use ambulo_formats::table::Table;
use ambulo_results::OutputFile;

fn table(values: Vec<f64>) -> Table {
    let rows = (0..values.len()).map(|row| row as f64).collect();
    Table::new("t", vec![("time".to_owned(), rows), ("knee".to_owned(), values)]).unwrap()
}

#[test]
fn no_table_holds_a_number_that_is_not_finite() {
    for found in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let error = OutputFile::storage("moments.sto", table(vec![1.0, found])).err().unwrap().to_string();
        let words = format!("moments.sto: column `knee`, row 2: found {found}; expected a finite number");
        assert!(error.starts_with(&words), "{error}");
        assert!(OutputFile::csv("cycles.csv", table(vec![found])).is_err());
        // An unknown value of the clinical curves is an empty cell.
        assert_eq!(OutputFile::csv("clinical.csv", table(vec![found])).is_ok(), found.is_nan());
        let event = Event { side: ambulo::model::Side::Right, kind: ambulo::analysis::EventKind::Off, time_s: found };
        assert!(OutputFile::events(&[event]).is_err());
    }
    assert!(OutputFile::storage("moments.sto", table(vec![1.0, f64::MAX])).is_ok());
}

#[test]
fn a_table_without_rows_is_no_result() {
    let error = OutputFile::csv("clinical.csv", table(Vec::new())).err().unwrap().to_string();
    assert!(error.contains("the table clinical.csv without rows; expected one row or more"), "{error}");
}
