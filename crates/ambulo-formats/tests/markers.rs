//! Reading and writing marker trajectories.

use ambulo_formats::trc::{LengthUnit, Marker, Trc};
use proptest::prelude::*;

const WALK: &str = "PathFileType\t4\t(X/Y/Z)\twalk.trc\n\
    DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n\
    100\t100\t2\t2\tmm\t100\t23\t128\n\
    Frame#\tTime\tR.Heel\t\t\tR Toe\t\t\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n\n\
    23\t0.23\t12.5\t30\t-4.5\t190.25\t21.5\t-3.75\n24\t0.24\t13.5\t31\t-4.25\t191.25\t22.5\t-4\n";

fn read(text: &str) -> (Trc, Vec<String>) {
    let (trc, remarks) = Trc::read(text.as_bytes()).unwrap();
    (trc, remarks.iter().map(ToString::to_string).collect())
}

#[track_caller]
fn assert_is_walk(text: &str) {
    let (trc, remarks) = read(text);
    assert_eq!(remarks, Vec::<String>::new());
    assert_eq!((trc.frames(), trc.times()), (&[23, 24][..], &[0.23, 0.24][..]));
    assert_eq!(trc.markers()[0].positions_m, [[0.0125, 0.03, -0.0045], [0.0135, 0.031, -0.00425]]);
    assert_eq!(trc.markers()[1].positions_m, [[0.19025, 0.0215, -0.00375], [0.19125, 0.0225, -0.004]]);
}

#[test]
fn a_file_is_read_in_metres_with_its_own_frame_numbers() {
    assert_is_walk(WALK);
    let (trc, _) = read(WALK);
    assert_eq!((trc.name.as_str(), trc.unit, trc.orig_start_frame), ("walk.trc", LengthUnit::Millimetre, 23));
    assert_eq!(trc.rate_hz.to_bits(), 100_f64.to_bits());
    assert_eq!(trc.marker("R Toe").map(|marker| marker.positions_m.len()), Some(2));
    assert_eq!(trc.marker("L Toe"), None);
}

#[test]
fn every_unit_of_length_is_turned_into_metres() {
    for (unit, heel) in [("mm", 0.0125), ("cm", 0.125), ("m", 12.5), (" MM", 0.0125)] {
        let (trc, _) = read(&WALK.replace("\tmm\t", &format!("\t{unit}\t")));
        assert_eq!(trc.markers()[0].positions_m[0][0].to_bits(), f64::to_bits(heel), "{unit}");
    }
}

#[test]
fn line_ends_trailing_tabs_and_blank_lines_make_no_difference() {
    assert_is_walk(&WALK.replace('\n', "\r\n"));
    assert_is_walk(&WALK.replace('\n', "\r"));
    assert_is_walk(&WALK.replace('\n', "\t\t\t\t\n"));
    assert_is_walk(&WALK.replace("\n\n", "\n"));
    assert_is_walk(&WALK.replace("\n\n", "\n\n\n\t\n"));
    assert_is_walk(WALK.trim_end());
    assert_is_walk(&format!("\u{feff}{WALK}"));
}

#[test]
fn a_file_without_gaps_may_be_separated_by_spaces() {
    assert_is_walk(&WALK.replace("R Toe", "R.Toe").replace('\t', "  "));
}

#[test]
fn header_values_may_be_padded_with_doubled_tabs() {
    assert_is_walk(&WALK.replace("100\t100\t2\t2\tmm", "  100.0\t\t  100.0\t\t    2\t\t  2\t\t mm"));
}

#[test]
fn an_empty_header_value_does_not_shift_the_others() {
    assert_is_walk(&WALK.replace("100\t100\t2\t2\tmm", "100\t\t2\t2\tmm"));
}

#[test]
fn empty_cells_are_gaps() {
    let (trc, remarks) = read(&WALK.replace("13.5\t31\t-4.25", "\t\t").replace("191.25\t22.5\t-4\n", "\t\t\n"));
    assert_eq!(remarks, Vec::<String>::new());
    for marker in trc.markers() {
        assert!(marker.positions_m[0].iter().all(|value| value.is_finite()));
        assert!(marker.positions_m[1].iter().all(|value| value.is_nan()));
    }
}

#[test]
fn empty_columns_without_an_axis_are_skipped() {
    // An empty column before each marker, in the line of axes and in the rows.
    let text = WALK.replace("X1\tY1\tZ1\tX2", "\tX1\tY1\tZ1\t\tX2");
    let text = text.replace("12.5\t30", "\t12.5\t30").replace("13.5\t31", "\t13.5\t31");
    let text = text.replace("\t190.25", "\t\t190.25").replace("\t191.25", "\t\t191.25");
    assert!(text.contains("\tX1") && text.contains("\t\t191.25"), "{text}");
    assert_is_walk(&text);
    // A number in such a column is no gap.
    let odd = text.replace("\t\t191.25", "\t7\t191.25");
    let error = Trc::read(odd.as_bytes()).unwrap_err().to_string();
    assert!(error.contains("line 8: found 10 cells; expected 8"), "{error}");
}

#[test]
fn words_above_frames_and_times_and_units_vary() {
    assert_is_walk(&WALK.replace("Time", "Times"));
    assert_is_walk(&WALK.replace("Frame#\tTime", "Frame\tTime (s)"));
    assert_is_walk(&WALK.replace("\tmm\t", "\tMillimeters\t"));
}

#[test]
fn a_partly_empty_position_is_a_gap_and_remarked() {
    let (trc, remarks) = read(&WALK.replace("13.5\t31\t-4.25", "13.5\t\t-4.25"));
    assert!(trc.markers()[0].positions_m[1].iter().all(|value| value.is_nan()));
    assert_eq!(remarks, ["line 8: 1 position with one or two empty cells; read as a gap (first: marker `R.Heel`)"]);
}

#[test]
fn positions_exactly_zero_are_kept_and_remarked() {
    let (trc, remarks) = read(&WALK.replace("12.5\t30\t-4.5", "0\t0.0\t-0").replace("191.25\t22.5\t-4", "0\t0\t0"));
    assert!(trc.markers()[1].positions_m[1].iter().all(|value| value.abs() <= 0.0));
    let message = "line 7: 2 positions exactly 0 0 0, which some programs write for a gap";
    assert_eq!(remarks, [format!("{message} (first: marker `R.Heel`)")]);
}

#[test]
fn counts_that_disagree_with_the_data_are_remarked() {
    let (_, remarks) = read(&WALK.replace("100\t2\t2\t", "100\t3\t4\t"));
    let frames = "NumFrames states 3, the file has 2; read 2";
    assert_eq!(remarks, ["line 4: NumMarkers states 4, the file names 2; read 2", frames]);
    let (_, remarks) = read(WALK.replace("100\t2\t2\t", "100\t3\t2\t").trim_end());
    assert_eq!(remarks, [format!("{frames}; the last line has no line end, so its last number may be truncated")]);
}

#[test]
fn a_recording_in_memory_must_be_whole() {
    let marker = |name: &str, n| Marker { name: name.into(), positions_m: vec![[0.5; 3]; n] };
    let error = |rate, times: &[f64], markers| Trc::new(rate, times.to_vec(), markers).unwrap_err().to_string();
    let start = "not a valid record: found";
    assert_eq!(error(0.0, &[0.0], vec![]), format!("{start} a rate of 0 Hz; expected a finite rate above zero"));
    assert_eq!(error(1.0, &[f64::NAN], vec![]), format!("{start} time NaN; expected finite times"));
    assert_eq!(
        error(1.0, &[], vec![]),
        format!("{start} no frame or no marker; expected at least one frame and one marker")
    );
    assert_eq!(error(1.0, &[0.0], vec![marker("A", 2)]), format!("{start} 2 positions of `A`; expected 1, as times"));
    assert_eq!(
        error(1.0, &[0.0], vec![marker("A", 1), marker("A", 1)]),
        format!("{start} two markers `A`; expected names that differ")
    );
}

fn any_trc() -> impl Strategy<Value = Trc> {
    let names = prop::collection::btree_set("[A-Za-z*._0-9]([A-Za-z*._0-9 ]{0,8}[A-Za-z*._0-9])?", 1..5);
    // Metres in millimetres stay finite below 1e300.
    let seen = prop::array::uniform3(prop::num::f64::NORMAL.prop_filter("finite in mm", |v| v.abs() < 1e300));
    let position = prop_oneof![4 => seen, 1 => Just([f64::NAN; 3])];
    (names, 1..6_usize, 1e-3..1e4_f64).prop_flat_map(move |(names, frames, rate)| {
        let paths = prop::collection::vec(prop::collection::vec(position.clone(), frames), names.len());
        (paths, prop::collection::vec(-1e6..1e6_f64, frames)).prop_map(move |(paths, times)| {
            let markers = names.iter().cloned().zip(paths);
            let markers = markers.map(|(name, positions_m)| Marker { name, positions_m }).collect();
            Trc::new(rate, times, markers).unwrap()
        })
    })
}

fn all_bits(trc: &Trc) -> Vec<u64> {
    let positions = trc.markers().iter().flat_map(|marker| &marker.positions_m).flatten();
    let numbers = trc.times().iter().chain(positions).copied().chain([trc.rate_hz]);
    numbers.map(|value| if value.is_nan() { f64::NAN.to_bits() } else { value.to_bits() }).collect()
}

fn names(trc: &Trc) -> Vec<&str> {
    trc.markers().iter().map(|marker| marker.name.as_str()).collect()
}

proptest! {
    #[test]
    fn metres_read_back_to_the_same_bits(trc in any_trc()) {
        let (again, remarks) = Trc::read(&trc.write()).unwrap();
        prop_assert_eq!(remarks, vec![]);
        prop_assert_eq!(names(&again), names(&trc));
        prop_assert_eq!(again.frames(), trc.frames());
        prop_assert_eq!(all_bits(&again), all_bits(&trc));
    }

    #[test]
    fn millimetres_from_a_file_read_back_to_the_same_bits(mut trc in any_trc()) {
        trc.unit = LengthUnit::Millimetre;
        let (read, _) = Trc::read(&trc.write()).unwrap();
        let (again, _) = Trc::read(&read.write()).unwrap();
        prop_assert_eq!(again.unit, LengthUnit::Millimetre);
        prop_assert_eq!(all_bits(&again), all_bits(&read));
    }
}
