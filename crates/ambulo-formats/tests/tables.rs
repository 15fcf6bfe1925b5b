//! Reading and writing tables: storage of all ages, CSV, and that what is written reads back to the same bits.

use ambulo_formats::table::{Table, coordinate_of_state_path};
use proptest::prelude::*;

const VERSION_1: &str = "Coordinates\nversion=1\nnRows=2\nnColumns=3\ninDegrees=yes\nendheader\n\
                         time\thip_flexion_r\tpelvis_ty\n0.0\t-12.5\t0.93\n0.01\t-12.25\t0.94\n";

fn storage(text: &str) -> (Table, Vec<String>) {
    let (table, remarks) = Table::read_storage(text.as_bytes()).unwrap();
    (table, remarks.iter().map(ToString::to_string).collect())
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

#[track_caller]
fn assert_is_version_1_content(text: &str) {
    let (table, remarks) = storage(text);
    assert_eq!(remarks, Vec::<String>::new());
    assert_eq!(table.names(), ["time", "hip_flexion_r", "pelvis_ty"]);
    assert_eq!(table.times(), Some(&[0.0, 0.01][..]));
    assert_eq!(table.column("hip_flexion_r"), Some(&[-12.5, -12.25][..]));
    assert_eq!(table.column("pelvis_ty"), Some(&[0.93, 0.94][..]));
}

#[test]
fn version_1_is_read_with_name_degrees_and_lines() {
    assert_is_version_1_content(VERSION_1);
    let (table, _) = storage(VERSION_1);
    assert_eq!((table.name.as_str(), table.in_degrees, table.rows()), ("Coordinates", Some(true), 2));
    assert_eq!((table.line_of_row(0), table.line_of_row(1), table.line_of_row(2)), (Some(8), Some(9), None));
    assert_eq!(table.column("knee_angle_r"), None);
}

#[test]
fn version_3_is_read_with_its_state_paths_kept() {
    let text = "inDegrees=no\nnColumns=2\nnRows=1\nDataType=double\nversion=3\nOpenSimVersion=4.5\nendheader\n\
                time\t/jointset/hip_r/hip_flexion_r/value\n0.45\t0.25\n";
    let (table, remarks) = storage(text);
    assert_eq!((table.name.as_str(), table.in_degrees, remarks.len()), ("", Some(false), 0));
    assert_eq!(table.column("/jointset/hip_r/hip_flexion_r/value"), Some(&[0.25][..]));
}

#[test]
fn the_header_of_simm_is_read() {
    let text = "name grf.mot\t\t\ndatacolumns 3\t\t\ndatarows 2\t\t\nrange 0.0 0.01\t\t\nendheader\t\t\n\
                     time\t   hip_flexion_r\t   pelvis_ty\n0\t-12.5\t0.93\n0.01\t-12.25\t0.94\n";
    assert_is_version_1_content(text);
    let (table, _) = storage(text);
    assert_eq!((table.name.as_str(), table.in_degrees), ("grf.mot", Some(true)));
}

#[test]
fn every_kind_of_line_end_is_read() {
    assert_is_version_1_content(&VERSION_1.replace('\n', "\r\n"));
    assert_is_version_1_content(&VERSION_1.replace('\n', "\r"));
    assert_is_version_1_content(VERSION_1.trim_end());
    let (table, _) = storage(&VERSION_1.replace('\n', "\r"));
    assert_eq!(table.line_of_row(1), Some(9));
}

#[test]
fn spaces_tabs_and_both_separate_cells() {
    assert_is_version_1_content(&VERSION_1.replace('\t', "   "));
    assert_is_version_1_content(&VERSION_1.replace('\t', " \t "));
    assert_is_version_1_content(&VERSION_1.replacen('\t', " ", 3));
}

#[test]
fn ragged_tabs_blank_lines_and_a_byte_order_mark_are_passed_over() {
    assert_is_version_1_content(&VERSION_1.replace('\n', "\t\t\n"));
    assert_is_version_1_content(&VERSION_1.replace('\n', "\n\n \t\n"));
    assert_is_version_1_content(&format!("\u{feff}{VERSION_1}"));
}

#[test]
fn header_keys_are_read_in_any_case_and_with_spaces() {
    let text =
        VERSION_1.replace("nRows=2", "NROWS = 2").replace("inDegrees=yes", "indegrees =Yes").replace("end", "END");
    assert_is_version_1_content(&text);
    assert_eq!(storage(&text).0.in_degrees, Some(true));
}

#[test]
fn names_between_tabs_may_hold_spaces() {
    let (table, _) = storage(&VERSION_1.replace("hip_flexion_r", "hip flexion"));
    assert_eq!(table.names(), ["time", "hip flexion", "pelvis_ty"]);
}

#[test]
fn special_values_are_read_however_they_are_written() {
    let words = "nan NaN -nan -nan(ind) 1.#QNAN -1.#IND00 1.#QNAN0 nan(snan) inf -Inf 1.#INF -1.#INF00 Infinity";
    let names: Vec<String> = (1..=13).map(|k| format!("c{k}")).collect();
    let (table, _) = storage(&format!("endheader\ntime {}\n0 {words}\n", names.join(" ")));
    let values: Vec<f64> = table.columns().skip(1).map(|(_, column)| column[0]).collect();
    assert!(values[..8].iter().all(|value| value.is_nan()), "{values:?}");
    let (up, down) = (f64::INFINITY, f64::NEG_INFINITY);
    assert_eq!(bits(&values[8..]), bits(&[up, down, up, down, up]));
}

#[test]
fn the_sentence_about_angles_stands_in_for_the_key() {
    let text = VERSION_1.replace("version=1\n", "").replace("inDegrees=yes", "Angles are in radians.");
    assert_eq!(storage(&text).0.in_degrees, Some(false));
    let (table, remarks) = storage(&VERSION_1.replace("endheader", "Angles are in radians.\nendheader"));
    assert_eq!(table.in_degrees, Some(true));
    let expected =
        "`inDegrees` states degrees, but the header also has \"Angles are in radians.\"; `inDegrees` was used";
    assert_eq!(remarks, [expected]);
}

#[test]
fn counts_that_disagree_with_the_data_are_remarked() {
    let (_, remarks) = storage(&VERSION_1.replace("nRows=2", "nRows=5").replace("nColumns=3", "nColumns=4"));
    let rows = "the header states 5 rows, the file has 2; read 2";
    assert_eq!(remarks, ["line 7: the header states 4 columns, the file has 3; read 3", rows]);
    let (_, remarks) = storage(VERSION_1.replace("nRows=2", "nRows=5").trim_end());
    assert_eq!(remarks, [format!("{rows}; the last line has no line end, so its last number may be truncated")]);
    let (_, remarks) = storage(&VERSION_1.replace("nRows=2", "nRows=1"));
    assert_eq!(remarks, ["the header states 1 row, the file has 2; read 2"]);
}

#[test]
fn a_count_in_the_header_reserves_no_memory() {
    let (table, remarks) = storage(&VERSION_1.replace("nRows=2", &format!("nRows={}", usize::MAX)));
    assert_eq!((table.rows(), remarks.len()), (2, 1));
}

#[test]
fn a_newer_storage_version_is_remarked() {
    let (_, remarks) = storage(&VERSION_1.replace("version=1", "version=9"));
    assert_eq!(remarks, ["line 2: storage version `9`; the known versions are 1 to 3; it was read as one of them"]);
}

#[test]
fn storage_is_written_as_opensim_writes_it() {
    let (table, _) = storage(VERSION_1);
    assert_eq!(String::from_utf8(table.write_storage()).unwrap(), VERSION_1);
}

#[test]
fn a_name_that_looks_like_a_key_survives_writing() {
    for name in
        ["endheader", "nRows=7", "version 3", "a = b", "Range of motion", "inDegrees", "PathFileType 4", "<walk>", ""]
    {
        let mut table = Table::new(name, vec![("time".into(), vec![0.0])]).unwrap();
        table.in_degrees = Some(false);
        let (read, remarks) = Table::read_storage(&table.write_storage()).unwrap();
        assert_eq!((read.name.as_str(), read.in_degrees, read.rows(), remarks.len()), (name, Some(false), 1, 0));
    }
}

#[test]
fn csv_is_read_with_commas_semicolons_or_tabs() {
    for separator in [",", ";", "\t"] {
        let text = "time, F,\"x\"\n0.0,1.5,2\n\n0.5,-1e3,\n".replace(',', separator);
        let (table, remarks) = Table::read_csv(text.as_bytes()).unwrap();
        assert_eq!(table.names(), ["time", "F", "x"]);
        assert_eq!(table.column("F"), Some(&[1.5, -1000.0][..]));
        assert!(table.column("x").unwrap()[1].is_nan());
        assert_eq!(
            remarks.iter().map(ToString::to_string).collect::<Vec<_>>(),
            ["1 cell is empty; it was read as not-a-number"]
        );
        assert_eq!((table.line_of_row(0), table.line_of_row(1)), (Some(2), Some(4)));
    }
}

#[test]
fn control_characters_in_names_of_a_csv_are_blanks_and_do_not_separate_when_written() {
    let (table, _) = Table::read_csv("a\tb;\u{19}c\u{feff};d\n1;2;3\n".as_bytes()).unwrap();
    assert_eq!(table.names(), ["a b", "c", "d"]);
    assert_eq!(Table::read_csv(&table.write_csv()).unwrap().0.names(), table.names());
}

#[test]
fn names_of_a_csv_are_no_formulas_for_a_spreadsheet() {
    let names = ["=cmd|' /C calc'!A0", "+SUM(1)", "-x", "@a", "'=b", "''@c", "'d", "a=b", "-5", "x"];
    let table = Table::new("", names.iter().map(|name| ((*name).to_owned(), vec![1.0])).collect()).unwrap();
    let bytes = table.write_csv();
    let text = String::from_utf8(bytes.clone()).unwrap();
    let expected = "'=cmd|' /C calc'!A0,'+SUM(1),'-x,'@a,''=b,'''@c,'d,a=b,-5,x\n";
    assert_eq!(text.split_inclusive('\n').next(), Some(expected));
    assert_eq!(Table::read_csv(&bytes).unwrap().0.names(), names);
}

#[test]
fn csv_of_an_old_macintosh_is_read_with_its_lines() {
    let (table, _) = Table::read_csv(b"\xef\xbb\xbftime,x\r0,1\r1,2\r").unwrap();
    assert_eq!((table.times(), table.line_of_row(1)), (Some(&[0.0, 1.0][..]), Some(3)));
}

#[test]
fn csv_lines_are_counted_over_blank_lines_and_both_line_ends() {
    for end in ["\n", "\r\n", "\r"] {
        let text = "\n\ntime,x\n\n0,1\n , \n1,2\n\n\n2,3".replace('\n', end);
        let (table, _) = Table::read_csv(text.as_bytes()).unwrap();
        assert_eq!([0, 1, 2].map(|row| table.line_of_row(row)), [Some(5), Some(7), Some(10)], "{end:?}");
    }
}

#[test]
fn a_csv_table_need_not_have_times() {
    let (table, _) = Table::read_csv(b"pct_cycle,mean\n0,1\n").unwrap();
    assert_eq!(table.times(), None);
}

#[test]
fn a_table_with_ragged_columns_or_odd_names_cannot_be_made() {
    let make = |columns: &[(&str, &[f64])]| {
        let columns = columns.iter().map(|(name, values)| ((*name).to_owned(), values.to_vec())).collect();
        Table::new("t", columns).unwrap_err().to_string()
    };
    assert_eq!(make(&[]), "not a valid record: found a table without columns; expected one column or more");
    assert_eq!(
        make(&[("time", &[0.0]), ("x", &[] as &[f64])]),
        "not a valid record: found 0 values in column `x`; expected 1, as in column `time`"
    );
    assert_eq!(
        make(&[("x", &[0.0]), ("x", &[0.0])]),
        "not a valid record: found two columns `x`; expected names that differ"
    );
    let expected = "a name that is not empty, without control characters and without spaces at its ends";
    assert_eq!(make(&[("a\tb", &[0.0])]), format!("not a valid record: found the name `a\\tb`; expected {expected}"));
}

#[test]
fn the_coordinate_of_a_state_path_is_known_for_values_only() {
    for (column, coordinate) in [
        ("/jointset/hip_r/hip_flexion_r/value", Some("hip_flexion_r")),
        ("hip_r/hip_flexion_r/value", Some("hip_flexion_r")),
        ("hip_flexion_r", Some("hip_flexion_r")),
        ("/jointset/hip_r/hip_flexion_r/speed", None),
        ("hip_r/hip_flexion_r/speed", None),
        ("/forceset/soleus_r/activation", None),
        ("/value", None),
        ("", None),
        ("a/", None),
    ] {
        assert_eq!(coordinate_of_state_path(column), coordinate, "{column}");
    }
}

fn any_table() -> impl Strategy<Value = Table> {
    let name = "[a-zA-Z0-9_/.|;,\"']([a-zA-Z0-9_/. |;,\"'=]{0,12}[a-zA-Z0-9_/.|;,\"'])?";
    let names = prop::collection::btree_set(name, 0..6).prop_map(|mut names| {
        names.remove("time");
        names
    });
    let parts = (names, 1..8_usize, prop::option::of(any::<bool>()), "[a-zA-Z0-9= ]{0,12}");
    parts.prop_flat_map(|(names, rows, in_degrees, title)| {
        let count = names.len() + 1;
        prop::collection::vec(prop::collection::vec(any::<f64>(), rows), count).prop_map(move |data| {
            let names = std::iter::once("time".to_owned()).chain(names.iter().cloned());
            let mut table = Table::new(title.trim().trim_start_matches(['=', ' ']), names.zip(data).collect()).unwrap();
            table.in_degrees = in_degrees;
            table
        })
    })
}

/// All bits of the numbers; every not-a-number counts as the same.
fn all_bits(table: &Table) -> Vec<u64> {
    table.columns().flat_map(|(_, c)| c).map(|v| if v.is_nan() { f64::NAN.to_bits() } else { v.to_bits() }).collect()
}

proptest! {
    #[test]
    fn storage_reads_back_to_the_same_bits(table in any_table()) {
        let (read, remarks) = Table::read_storage(&table.write_storage()).unwrap();
        prop_assert_eq!(remarks, vec![]);
        prop_assert_eq!((&read.name, read.in_degrees, read.names()), (&table.name, table.in_degrees, table.names()));
        prop_assert_eq!(all_bits(&read), all_bits(&table));
    }

    #[test]
    fn csv_reads_back_to_the_same_bits(table in any_table()) {
        let (read, remarks) = Table::read_csv(&table.write_csv()).unwrap();
        prop_assert_eq!(remarks, vec![]);
        prop_assert_eq!(read.names(), table.names());
        prop_assert_eq!(all_bits(&read), all_bits(&table));
    }
}
