//! Tables of scenes.

use ambulo_results::internals::RowTable;

#[test]
fn a_number_that_is_not_finite_is_reported_with_its_column_and_row() {
    let mut table = RowTable::new("joints.csv", "time,joint,value,rate");
    for rate in [1.0, f64::INFINITY, f64::NAN] {
        table.begin(0.5, &["knee, \"left\""]);
        table.append(&[2.0, rate]);
        table.end();
    }
    assert!(table.text().contains("\n0.5,\"knee, \"\"left\"\"\",2,1\n"), "{}", table.text());
    table.begin(0.6, &["=cmd|' /C calc'!A0"]);
    assert!(table.text().ends_with("\n0.6,'=cmd|' /C calc'!A0"), "{}", table.text());
    let error = table.file().err().unwrap().to_string();
    assert!(error.starts_with("joints.csv: column `rate`, row 2: found inf; expected a finite number"), "{error}");
}
