//! Files that are wrong: the message for each fault, and no panic, hang or large allocation on anything.

use ambulo_formats::Error;
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_formats::table::Table;
use ambulo_formats::trc::Trc;
use proptest::prelude::*;

const STORAGE: &str = "Coordinates\nversion=1\nnRows=2\nnColumns=3\ninDegrees=yes\nendheader\n\
                       time\tx\ty\n0.0\t-12.5\t0.93\n0.01\t-12.25\t0.94\n";
const MARKERS: &str = "PathFileType\t4\t(X/Y/Z)\twalk.trc\n\
    DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n\
    100\t100\t2\t1\tmm\t100\t1\t2\nFrame#\tTime\tHeel\t\t\n\t\tX1\tY1\tZ1\n\n\
    1\t0.0\t12.5\t30\t-4.1\n2\t0.01\t13.5\t31\t-4.2\n";
const LOADS: &str = "<OpenSimDocument Version=\"40000\">\n<ExternalLoads name=\"walk\">\n<objects>\n\
    <ExternalForce name=\"right\">\n<appliesForce>true</appliesForce>\n<applied_to_body>calcn_r</applied_to_body>\n\
    <force_identifier>f</force_identifier>\n</ExternalForce>\n</objects>\n<datafile>a.mot</datafile>\n\
    </ExternalLoads>\n</OpenSimDocument>\n";

fn storage(text: impl AsRef<[u8]>) -> String {
    Table::read_storage(text.as_ref()).unwrap_err().to_string()
}

fn csv(text: impl AsRef<[u8]>) -> String {
    Table::read_csv(text.as_ref()).unwrap_err().to_string()
}

fn markers(text: impl AsRef<[u8]>) -> String {
    Trc::read(text.as_ref()).unwrap_err().to_string()
}

fn loads(text: impl AsRef<[u8]>) -> String {
    ExternalLoads::read(text.as_ref()).unwrap_err().to_string()
}

fn read_all(bytes: &[u8]) {
    let _ = (Table::read_storage(bytes), Table::read_csv(bytes), Trc::read(bytes), ExternalLoads::read(bytes));
}

#[test]
fn an_empty_file_says_what_was_expected() {
    let start = "the file is empty; expected";
    for text in ["", " \r\n\t\n", "\u{feff}"] {
        let header = "an OpenSim storage file: a header that ends with `endheader`, names, rows";
        assert_eq!(storage(text), format!("{start} {header}"));
        assert_eq!(csv(text), format!("{start} a header row of column names, then rows of numbers"));
        assert_eq!(markers(text), format!("{start} a TRC file, which begins with `PathFileType`"));
    }
    assert_eq!(loads(" \n"), format!("{start} an XML document with an <ExternalLoads> element"));
}

#[test]
fn a_header_without_end_is_named() {
    let cut = "the file ends here; expected a line `endheader` that closes the header. Is it truncated?";
    assert_eq!(storage("Coordinates\nversion=1\n"), format!("line 2: {cut}"));
    assert_eq!(storage(STORAGE.replace("endheader\ntime", "")), format!("line 8: {cut}"));
    assert_eq!(
        storage("a\n".repeat(10_000)),
        "line 4096: found a header without end; expected a line `endheader` among the first 4096 lines"
    );
}

#[test]
fn storage_without_names_or_rows_is_named() {
    let header = &STORAGE[..STORAGE.find("time").unwrap()];
    let what = "the file ends here; expected";
    assert_eq!(storage(header), format!("line 6: {what} a line of column names and rows of numbers. Is it truncated?"));
    let message = format!("line 7: {what} rows of numbers below the column names. Is it truncated?");
    assert_eq!(storage(format!("{header}time\tx\ty\n")), message);
}

#[test]
fn a_bad_header_value_is_named() {
    assert_eq!(
        storage(STORAGE.replace("nRows=2", "nRows=many")),
        "line 3: found nRows `many`; expected a whole number of rows or columns"
    );
    assert_eq!(
        storage(STORAGE.replace("nColumns=3", "nColumns=-3")),
        "line 4: found nColumns `-3`; expected a whole number of rows or columns"
    );
    assert_eq!(
        storage(STORAGE.replace("=yes", "=maybe")),
        "line 5: found inDegrees `maybe`; expected `inDegrees=yes` or `inDegrees=no`"
    );
    assert_eq!(
        storage(STORAGE.replace("inDegrees=yes", "DataType=Vec3")),
        "line 5: found DataType `Vec3`; expected `DataType=double`, one number per cell; \
         export the table flattened, with one column per component"
    );
}

#[test]
fn bad_column_names_are_named() {
    assert_eq!(
        storage(STORAGE.replace("x\ty", "x\tx")),
        "line 7: found two columns `x`; expected column names that differ"
    );
    let expected = "expected a first column `time`";
    assert_eq!(
        storage(STORAGE.replace("time", "frame")),
        format!("line 7: found the first column `frame`; {expected}")
    );
    assert_eq!(csv("x,x\n1,2\n"), "line 1: found two columns `x`; expected column names that differ");
    assert_eq!(csv("x,,y\n1,2,3\n"), "line 1: found no name for column 2; expected a name for every column");
    assert_eq!(csv("0.0,1.5\n1,2\n"), "line 1: found `0.0,1.5`; expected a header row of column names");
}

#[test]
fn a_row_of_another_width_is_named() {
    let expected = "expected 3, one a column";
    assert_eq!(storage(STORAGE.replace("0.0\t-12.5", "0.0")), format!("line 8: found 2 numbers; {expected}"));
    assert_eq!(storage(STORAGE.replace("0.0\t-12.5", "0.0\t1\t2")), format!("line 8: found 4 numbers; {expected}"));
    assert_eq!(storage(STORAGE.replace("0.94", "0.94\t1")), format!("line 9: found 4 numbers; {expected}"));
    assert_eq!(csv("time,x\n0,1\n1\n"), "line 3: found 1 cell; expected 2, one a column");
    let hint = "expected 2, one a column (a decimal comma splits a number in two)";
    assert_eq!(csv("time,x\n0,01,1,5\n"), format!("line 2: found 4 cells; {hint}"));
}

#[test]
fn an_incomplete_last_row_is_a_truncated_file() {
    let message = "line 9: the file ends here; expected the rest of a row of 3 numbers. Is it truncated?";
    let row = STORAGE.len() - "0.01\t-12.25\t0.94\n".len();
    for last in ["0.01", "0.01\t-12.25", "0.01\t-12.25\n", "0.01\t-", "0.01\t-12.25\t-", "0.01\t-12.25\t1e"] {
        assert_eq!(storage(format!("{}{last}", &STORAGE[..row])), message, "{last}");
    }
    let message = "line 8: the file ends here; expected the rest of a row of 5 cells. Is it truncated?";
    let row = MARKERS.len() - "2\t0.01\t13.5\t31\t-4.2\n".len();
    for last in ["2", "2\t0.01\t13.5", "2\t0.01\t13.5\t31\n", "2\t0.01\t13.5\t31\t-"] {
        assert_eq!(markers(format!("{}{last}", &MARKERS[..row])), message, "{last}");
    }
}

#[test]
fn a_cell_that_is_no_number_is_named() {
    assert_eq!(storage(STORAGE.replace("-12.5", "abc")), "line 8: found `abc`; expected a number");
    assert_eq!(storage(STORAGE.replace("0.94", "1.#FOO")), "line 9: found `1.#FOO`; expected a number");
    assert_eq!(csv("time,x\n0,abc\n"), "line 2: found `abc`; expected a number");
    assert_eq!(markers(MARKERS.replace("\t30", "\tabc")), "line 7: found `abc`; expected a number");
}

#[test]
fn a_decimal_comma_is_named() {
    let expected =
        "a number with a decimal point; the file appears to use a decimal comma; export it with a decimal point";
    assert_eq!(storage(STORAGE.replace("-12.5", "-12,5")), format!("line 8: found `-12,5`; expected {expected}"));
    assert_eq!(csv("time;x\n1,500;1\n"), format!("line 2: found `1,500`; expected {expected}"));
    assert_eq!(markers(MARKERS.replace("12.5", "12,5")), format!("line 7: found `12,5`; expected {expected}"));
}

#[test]
fn csv_that_is_not_whole_is_named() {
    let message = "line 1: the file ends here; expected rows of numbers below the column names. Is it truncated?";
    assert_eq!(csv("time,x\n"), message);
    let expected = "column names whose quotes are closed on the same line";
    assert_eq!(csv("time,\"x\n0,1\n"), format!("line 1: found an open quote; expected {expected}"));
}

#[test]
fn a_file_of_another_kind_is_named() {
    assert_eq!(
        markers(STORAGE),
        "the content is an OpenSim table (.mot or .sto); expected a marker file (.trc). hint: give the file a name \
         that \
         ends with .mot or .sto"
    );
    let message = "line 1, element <Model>: found the outermost element <Model>; expected an <ExternalLoads> document";
    assert_eq!(loads("<Model/>"), message);
    assert_eq!(
        loads("<OpenSimDocument>\n<Model name=\"m\"/>\n</OpenSimDocument>"),
        "line 1, element <OpenSimDocument>: found <Model>; expected an <ExternalLoads> document"
    );
}

#[test]
fn a_bad_marker_header_is_named() {
    let change = |from, to| markers(MARKERS.replacen(from, to, 1));
    assert_eq!(change("mm", "inch"), "line 3: found Units `inch`; expected `mm`, `cm` or `m`");
    let rate = "expected a frame rate in Hz, a finite number above zero";
    assert_eq!(change("\n100\t", "\n0\t"), format!("line 3: found DataRate `0`; {rate}"));
    assert_eq!(change("100\t2\t1", "100\tx\t1"), "line 3: found NumFrames `x`; expected a whole number");
    assert_eq!(change("100\t1\t2", "100\tx\t2"), {
        let line = "`100\\t100\\t2\\t1\\tmm\\t100\\tx\\t2`";
        format!("line 3: found {line}; expected a whole number for OrigDataStartFrame")
    });
    assert_eq!(change("\t100\t1\t2", ""), "line 3: found 5 values; expected 8, one per key of the line above");
    let keys = "`DataRate\\tCameraRate\\tNumFrames\\tNumMarkers…`";
    assert_eq!(change("Units", "Unit"), format!("line 2: found {keys}; expected a key `Units`"));
}

#[test]
fn bad_marker_names_are_named() {
    let change = |from, to| markers(MARKERS.replacen(from, to, 1));
    let names = "expected `Frame#`, `Time`, then marker names";
    assert_eq!(change("Frame#", "Sample"), format!("line 4: found `Sample\\tTime\\tHeel`; {names}"));
    assert_eq!(change("Heel", ""), format!("line 4: found no marker names; {names}"));
    let twice = "line 4: found two markers `Heel`; expected marker names that differ";
    assert_eq!(change("Heel", "Heel\t\t\tHeel"), twice);
    let axes = "expected X, Y, Z for each of";
    assert_eq!(change("Heel", "Heel\t\t\tToe"), format!("line 5: found 3 axis names; {axes} 2 named markers"));
    assert_eq!(change("X1\tY1", "Y1\tX1"), format!("line 5: found `Y1`; {axes} 1 named marker"));
}

#[test]
fn bad_marker_rows_are_named() {
    let change = |from, to| markers(MARKERS.replacen(from, to, 1));
    let cells = "expected 5: frame, time and three per marker, separated by tabs, gaps empty";
    assert_eq!(change("\t30", ""), format!("line 7: found 4 cells; {cells}"));
    assert_eq!(change("\t30", "\t30\t31"), format!("line 7: found 6 cells; {cells}"));
    assert_eq!(change("\n1\t", "\none\t"), "line 7: found `one`; expected a frame number");
    assert_eq!(change("0.0\t", "nan\t"), "line 7: found time `nan`; expected a number");
    assert_eq!(change("0.0\t", "\t"), "line 7: found time nothing; expected a number");
}

#[test]
fn markers_without_rows_are_named() {
    let head = &MARKERS[..MARKERS.find("\n1\t").unwrap()];
    let message = "line 6: the file ends here; expected rows of frame, time and positions. Is it truncated?";
    assert_eq!(markers(format!("{head}\n")), message);
}

#[test]
fn bad_loads_are_named() {
    let change = |from, to| loads(LOADS.replace(from, to));
    assert_eq!(
        change("objects>", "things>"),
        "line 2, element <ExternalLoads name=\"walk\">: found no <objects>; \
         expected <objects> that holds <ExternalForce> elements"
    );
    assert_eq!(
        change("ExternalForce", "PrescribedForce"),
        "line 4, element <PrescribedForce name=\"right\">: found <PrescribedForce>; \
         expected <ExternalForce>; open the document in OpenSim 3 or 4 and save it again"
    );
    assert_eq!(
        change("calcn_r", " "),
        "line 4, element <ExternalForce name=\"right\">: found no <applied_to_body>; \
         expected the name of the body on which it acts"
    );
    assert_eq!(
        change(">true<", ">perhaps<"),
        "line 5, element <appliesForce>: found `perhaps`; expected `true` or `false`"
    );
}

#[test]
fn a_document_type_definition_is_refused() {
    let bomb = "<!DOCTYPE x [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;&a;\">]><ExternalLoads name=\"&b;\"/>";
    assert!(matches!(ExternalLoads::read(bomb.as_bytes()), Err(Error::Xml { .. })));
    assert_eq!(loads(bomb), "not a readable XML document: XML with DTD detected");
    assert!(matches!(ExternalLoads::read(b"\x00\xff"), Err(Error::Line { line: 1, .. })));
}

#[test]
fn a_very_long_line_is_refused() {
    let message = "found a line of more than 1048576 bytes; expected a text file with shorter lines";
    let long = "x".repeat((1 << 20) + 1);
    assert_eq!(
        (storage(&long), csv(&long), markers(&long)),
        (format!("line 1: {message}"), format!("line 1: {message}"), format!("line 1: {message}"))
    );
    assert_eq!(storage(format!("{STORAGE}{long}")), format!("line 10: {message}"));
}

#[test]
fn a_hundred_megabytes_of_garbage_are_refused() {
    let kinds: [Vec<u8>; 4] =
        [vec![0; 100 << 20], vec![b'a'; 100 << 20], b"a b\n".repeat(25 << 20), b"\xff,\"\n".repeat(25 << 20)];
    for garbage in kinds {
        assert!(Table::read_storage(&garbage).is_err() && Table::read_csv(&garbage).is_err());
        assert!(Trc::read(&garbage).is_err() && ExternalLoads::read(&garbage).is_err());
    }
}

#[test]
fn small_files_cut_or_damaged_at_any_byte_do_not_panic() {
    for text in [STORAGE, MARKERS, LOADS] {
        for k in 0..text.len() {
            read_all(&text.as_bytes()[..k]);
            for byte in [0, b'\t', b'\n', b'\r', b' ', b'"', b',', b'-', b'9', b'<', b'=', 0xff] {
                let mut damaged = text.as_bytes().to_vec();
                damaged[k] = byte;
                read_all(&damaged);
            }
        }
    }
}

proptest! {
    #[test]
    fn random_bytes_do_not_panic(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        read_all(&bytes);
    }

    #[test]
    fn random_tables_do_not_panic(body in "[0-9a-zA-Z.,;#()=\"\t\n\r \u{e4}\u{20ac}-]{0,200}") {
        read_all(body.as_bytes());
        let head = &MARKERS[..MARKERS.find("\n1\t").unwrap()];
        read_all(format!("endheader\ntime\tx\n{body}").as_bytes());
        read_all(format!("time,x\n{body}").as_bytes());
        read_all(format!("{head}\n{body}").as_bytes());
        read_all(LOADS.replace("calcn_r", &body).as_bytes());
    }
}
