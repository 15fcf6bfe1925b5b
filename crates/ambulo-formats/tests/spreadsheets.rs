//! Tables that a spreadsheet saved: other separators, a decimal comma, UTF-16, words for missing values, units.

use crate::shared_data::data;
use ambulo_formats::Remark;
use ambulo_formats::bvh::Bvh;
use ambulo_formats::table::Table;
use ambulo_formats::trc::Trc;

const STORAGE: &str = "Coordinates\nversion=1\nnRows=2\nnColumns=3\ninDegrees=yes\nendheader\ntime\tx\ty\n\
                       0.5\t-12.5\t0.93\n0.51\t-12.25\t0.94\n";
const MARKERS: &str = "PathFileType\t4\t(X/Y/Z)\twalk.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\t\
    OrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n100\t100\t2\t2\tmm\t100\t1\t2\nFrame#\tTime\tHeel\t\t\tToe\n\
    \t\tX1\tY1\tZ1\tX2\tY2\tZ2\n\n1\t0.5\t12.5\t30\t-4.1\t\t\t\n2\t0.51\t13.5\t31\t-4.25\t190.5\t21.5\t-3.5\n";

fn storage(text: &str) -> (Table, Vec<String>) {
    worded(Table::read_storage(text.as_bytes()).unwrap())
}

fn csv(text: &str) -> (Table, Vec<String>) {
    worded(Table::read_csv(text.as_bytes()).unwrap())
}

fn markers(text: &str) -> (Trc, Vec<String>) {
    worded(Trc::read(text.as_bytes()).unwrap())
}

fn worded<T>((read, remarks): (T, Vec<Remark>)) -> (T, Vec<String>) {
    (read, remarks.iter().map(ToString::to_string).collect())
}

fn assert_same_columns(table: &Table, original: &Table) {
    assert_eq!(table.names(), original.names());
    for ((name, values), (_, others)) in table.columns().zip(original.columns()) {
        let same = values.iter().zip(others).all(|(a, b)| a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan()));
        assert!(same && values.len() == others.len(), "{name}: {values:?}, {others:?}");
    }
}

/// As a spreadsheet saves it: as many cells in the header as in the table.
fn saved(text: &str, separator: &str, mark: &str) -> String {
    let cell = |cell: &str| if cell.parse::<f64>().is_ok() { cell.replace('.', mark) } else { cell.to_owned() };
    let line = |line: &str| {
        let mut cells: Vec<String> = line.split('\t').map(cell).collect();
        cells.resize(cells.len().max(8), String::new());
        cells.join(separator)
    };
    text.lines().map(line).collect::<Vec<_>>().join("\r\n") + "\r\n"
}

#[test]
fn a_spreadsheets_separators_are_read_and_named() {
    let original = storage(STORAGE).0;
    let comma = "the separator of the cells is a comma in place of a tab; the file was read with it";
    let both =
        "the separator of the cells is a semicolon in place of a tab, and numbers have a decimal comma; both were read";
    // Rows of storage that are wider than the names are not those of a table.
    let narrow = |text: &str| text.replace(",,,,,", "").replace(";;;;;", "");
    let (table, remarks) = storage(&narrow(&saved(STORAGE, ",", ".")));
    assert_same_columns(&table, &original);
    assert_eq!((table.in_degrees, remarks), (Some(true), vec![comma.to_owned()]));
    let (table, remarks) = storage(&narrow(&saved(STORAGE, ";", ",")));
    assert_same_columns(&table, &original);
    assert_eq!(remarks, [both]);
    let (table, remarks) = storage(&STORAGE.replace("inDegrees", "unit").replace('.', ","));
    assert_same_columns(&table, &original);
    assert_eq!(remarks, ["numbers have a decimal comma; they were read with it"]);

    let original = markers(MARKERS).0;
    for (separator, mark, remark) in [(",", ".", comma), (";", ",", both)] {
        let (trc, remarks) = markers(&saved(MARKERS, separator, mark));
        assert_eq!((trc.times(), trc.rate_hz), (original.times(), 100.0));
        assert_eq!(trc.markers()[0], original.markers()[0]);
        assert!(trc.markers()[1].positions_m[0][0].is_nan());
        assert_eq!(remarks, [remark]);
    }
    let (trc, _) = markers(&MARKERS.replace("PathFileType", "\"PathFileType\"").replace("Frame#", "\"Frame#\""));
    assert_eq!(trc.markers()[0], original.markers()[0]);
}

#[test]
fn a_comma_that_may_divide_thousands_is_not_read() {
    let table = |cell: &str| Table::read_csv(format!("time;x\n0;{cell}\n1;{cell}\n").as_bytes());
    let refused = table("1,500").unwrap_err().to_string();
    assert!(refused.contains("decimal comma"), "{refused}");
    for (cell, value) in [("0,500", 0.5), ("1,50", 1.5), ("-12,0001", -12.0001)] {
        assert_eq!(table(cell).unwrap().0.column("x"), Some(&[value, value][..]), "{cell}");
    }
    // Numbers with a point beside them: the comma is no decimal mark.
    assert!(Table::read_csv(b"time;x\n0.5;1,5\n").is_err());
}

#[test]
fn text_in_utf_16_is_read() {
    let wide = |text: &str, mark: bool, unit: fn(u16) -> [u8; 2]| -> Vec<u8> {
        let mark = mark.then_some(0xfeff);
        mark.into_iter().chain(text.encode_utf16()).flat_map(unit).collect()
    };
    for (mark, unit) in [
        (true, u16::to_le_bytes as fn(u16) -> [u8; 2]),
        (true, u16::to_be_bytes),
        (false, u16::to_le_bytes),
        (false, u16::to_be_bytes),
    ] {
        let remark = ["the text is UTF-16; it was read as such"];
        let (table, remarks) = worded(Table::read_storage(&wide(STORAGE, mark, unit)).unwrap());
        assert_same_columns(&table, &storage(STORAGE).0);
        assert_eq!(remarks, remark);
        let (trc, remarks) = worded(Trc::read(&wide(MARKERS, mark, unit)).unwrap());
        assert_eq!(
            (trc.markers()[0].clone(), remarks[0].as_str()),
            (markers(MARKERS).0.markers()[0].clone(), remark[0])
        );
        let (table, _) = worded(Table::read_csv(&wide("time,x\n0,1\n", mark, unit)).unwrap());
        assert_eq!(table.column("x"), Some(&[1.0][..]));
    }
}

#[test]
fn words_for_missing_values_are_gaps() {
    let words =
        ["NA", "N/A", "#N/A", "null", "NULL", "None", "n.a.", "--", "#DIV/0!", "#VALUE!", "missing", "NaN", "1.#QNAN"];
    for word in words {
        let (table, _) = storage(&STORAGE.replace("-12.25", word));
        assert!(table.column("x").unwrap()[1].is_nan(), "{word}");
        let (table, _) = csv(&format!("time,x\n0,1\n1,{word}\n"));
        assert!(table.column("x").unwrap()[1].is_nan(), "{word}");
        let (trc, _) = markers(&MARKERS.replace("13.5", word));
        assert!(trc.markers()[0].positions_m[1].iter().all(|x| x.is_nan()), "{word}");
    }
}

#[test]
fn an_empty_cell_of_storage_is_a_gap_of_its_column() {
    let (table, remarks) = storage(&STORAGE.replace("\t-12.5\t", "\t\t"));
    assert!(table.column("x").unwrap()[0].is_nan());
    assert_eq!(table.column("y"), Some(&[0.93, 0.94][..]));
    assert_eq!(remarks, ["1 cell is empty; it was read as not-a-number"]);
}

#[test]
fn infinite_numbers_are_missing_ones() {
    let (trc, remarks) = markers(&MARKERS.replace("13.5", "inf"));
    assert!(trc.markers()[0].positions_m[1].iter().all(|x| x.is_nan()));
    assert_eq!(remarks, ["line 8: 1 position with an infinite number; read as a gap (first: marker `Heel`)"]);
    let (mut table, _) = storage(&STORAGE.replace("-12.25", "1e400").replace("0.93", "-3e15"));
    assert_eq!(
        table.without_impossible().unwrap().to_string(),
        "line 9: the value of `x` is infinite (2 such numbers); it was read as missing"
    );
    assert!(table.column("x").unwrap()[1].is_nan() && table.column("y").unwrap()[0].is_nan());
    assert_eq!(table.without_impossible(), None);
}

#[test]
fn headers_of_other_programs_are_read() {
    let original = storage(STORAGE).0;
    for time in ["Time", "Time (s)", "time_s", "t"] {
        let (table, _) = storage(&STORAGE.replace("\ntime\t", &format!("\n{time}\t")));
        assert_eq!(table.times(), original.times(), "{time}");
    }
    assert_eq!(storage(&STORAGE.replace("=yes", " = \"yes\"")).0.in_degrees, Some(true));
    let (table, remarks) = storage(&STORAGE.replace("endheader\n", ""));
    assert_same_columns(&table, &original);
    assert_eq!(remarks, ["line 6: no line `endheader` above the names of the columns; they were read as such"]);
    let rows = &STORAGE[STORAGE.find("time").unwrap()..];
    let (table, remarks) = storage(rows);
    assert_same_columns(&table, &original);
    assert_eq!((table.in_degrees, remarks.len()), (None, 1));
    let simm = "name walk\ndatacolumns 3\ndatarows 2\notherdata 1\nrange 0.5 0.51\nendheader\n\n";
    assert_eq!(storage(&format!("{simm}{rows}")).0.in_degrees, Some(true));
    let (trc, remarks) = markers(&MARKERS.replace("\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n", ""));
    assert_eq!(trc.markers()[0], markers(MARKERS).0.markers()[0]);
    assert_eq!(remarks, ["line 6: no line X1 Y1 Z1 below the names of the markers; three columns were read for each"]);
    assert_eq!(markers(&MARKERS.replace("\tmm\t", "\t[mm]\t")).0.times(), [0.5, 0.51]);
    let unit = Trc::read(MARKERS.replace("\tmm\t", "\t\t").as_bytes()).unwrap_err().to_string();
    assert_eq!(unit, "line 3: found Units nothing; expected `mm`, `cm` or `m`");
}

#[test]
fn rows_above_and_below_the_names_of_a_csv_are_understood() {
    for text in ["sep=;\ntime;x\n0;1\n", "# made by hand\n# twice\ntime,x\n0,1\n", "#time,x\n0,1\n", "# time,x\n0,1\n"]
    {
        let (table, _) = csv(text);
        assert_eq!((table.times(), table.column("x")), (Some(&[0.0][..]), Some(&[1.0][..])), "{text}");
    }
    let (table, remarks) = csv("time,hip,px,f\nms,deg,[mm],kN\n500,30,250,0.5\n");
    let values: Vec<f64> = table.columns().map(|(_, values)| values[0]).collect();
    assert_eq!((values, table.in_degrees), (vec![0.5, 30.0, 0.25, 500.0], Some(true)));
    assert_eq!(remarks, ["line 2: the row below the names has units; the numbers are in these units"]);
    assert!(Table::read_csv(b"time,hip,knee\ns,deg,rad\n0,1,2\n").is_err());
    // The index of pandas, and a separator at the end of each line.
    assert_eq!(csv(",time,x\n0,0.5,1\n1,0.6,2\n").0.names(), ["time", "x"]);
    assert_eq!(csv("time,x,\n0.5,1,\n0.6,2,\n").0.names(), ["time", "x"]);
    let refused = Table::read_csv(b"time,,x\n0,5,1\n").unwrap_err().to_string();
    assert_eq!(refused, "line 1: found no name for column 2; expected a name for every column");
}

#[test]
fn a_skeleton_with_decimal_commas_is_read() {
    let text = "HIERARCHY\nROOT Hips\n{\nOFFSET 0,0 1,5 0,0\nCHANNELS 1 Xrotation\n}\nMOTION\nFrames: 2\nFrame Time: \
        0,01\n1,5\n2,5\n";
    let (bvh, remarks) = worded(Bvh::read(text.as_bytes()).unwrap());
    assert_eq!((bvh.frame_time_s(), bvh.joints()[0].offset), (0.01, [0.0, 1.5, 0.0]));
    assert_eq!(remarks, ["numbers have a decimal comma; they were read with it"]);
}

#[test]
fn the_tables_of_the_case_are_read() {
    let Some(folder) = data() else { return };
    let read = |name: &str| std::fs::read(folder.join("cases/comma-separated-tables").join(name)).unwrap();
    let (table, remarks) = worded(Table::read_storage(&read("walk.mot")).unwrap());
    assert!(remarks[0].starts_with("the separator of the cells is a comma"), "{remarks:?}");
    assert!(table.rows() > 10 && table.columns().flat_map(|(_, values)| values).all(|x| x.is_finite()));
    let (trc, remarks) = worded(Trc::read(&read("walk.trc")).unwrap());
    assert!(remarks[0].starts_with("the separator of the cells is a comma"), "{remarks:?}");
    assert_eq!(trc.times().len(), 60);
}
