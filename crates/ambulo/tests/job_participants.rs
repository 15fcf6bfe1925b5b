//! Masses and statures of the people of a BIDS data set.

use ambulo::internals::{PARTICIPANTS_DESCRIPTION, PARTICIPANTS_TABLE, Size, sizes};
use ambulo::job::JobError;
use std::collections::BTreeMap;
use std::path::Path;

fn read(table: &str, description: &str) -> Result<BTreeMap<String, Size>, JobError> {
    sizes(table.as_bytes(), description.as_bytes(), Path::new(PARTICIPANTS_TABLE), Path::new(PARTICIPANTS_DESCRIPTION))
}

#[test]
fn sizes_are_read_in_the_units_that_are_stated() {
    let table = "participant_id\tage\theight\tweight\nsub-1\t30\t175\t70.5\nsub-2\tn/a\tn/a\t\n";
    let found = read(table, r#"{"weight": {"Units": "kg"}, "height": {"Units": "cm"}}"#).unwrap();
    assert_eq!(found["sub-1"], [Some(70.5), Some(1.75)]);
    assert_eq!(found["sub-2"], [None, None]);
}

#[test]
fn a_column_without_a_known_unit_is_not_read() {
    let table = "participant_id\theight\tweight\nsub-1\t175\t155\n";
    for description in ["{}", r#"{"weight": {"Units": "lb"}, "height": {"Description": "stature"}}"#] {
        assert_eq!(read(table, description).unwrap()["sub-1"], [None, None]);
    }
}

#[test]
fn a_description_that_is_no_json_is_an_error_that_says_what_belongs_there() {
    let error = read("participant_id\tweight\nsub-1\t70\n", "{\"weight\": kg}").unwrap_err().to_string();
    assert!(error.starts_with("participants.json: expected value at line 1 column 12; expected JSON with"), "{error}");
    assert!(error.contains("hint: {\"weight\": {\"Units\": \"kg\"}}"), "{error}");
}

#[test]
fn a_cell_that_is_no_size_is_an_error_with_its_line() {
    let error = read("participant_id\tweight\nsub-1\t-3\n", r#"{"weight": {"Units": "kg"}}"#).unwrap_err();
    assert_eq!(
        error.to_string(),
        "participants.tsv: line 2: found `-3` as `weight`; expected a number above 0, or n/a"
    );
}
