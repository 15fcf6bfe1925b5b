//! Recorded markers: units, gaps, axes.

use ambulo::findings::{Code, Findings};
use ambulo::motion::{
    MarkerError, MarkerPath, MarkerRecording, is_marker_table, markers_from_c3d, markers_from_table, markers_from_trc,
};
use ambulo::spatial::{Mat3, Vec3};
use ambulo_formats::c3d::{C3d, Group, Parameter, Point, Values};
use ambulo_formats::table::Table;
use ambulo_formats::trc::{Marker, Trc};

fn trc(markers: &[(&str, [[f64; 3]; 2])]) -> Trc {
    let marker = |(name, positions): &(&str, [[f64; 3]; 2])| Marker {
        name: (*name).to_owned(),
        positions_m: positions.to_vec(),
    };
    Trc::new(100.0, vec![0.0, 0.01], markers.iter().map(marker).collect()).unwrap()
}

#[test]
fn a_position_of_exactly_zero_is_a_gap_and_is_reported() {
    let mut findings = Findings::default();
    let file = trc(&[("HEEL", [[0.0; 3], [0.1, 0.0, 0.2]]), ("TOE", [[0.3, 0.0, 0.2]; 2])]);
    let markers = markers_from_trc(&file, &mut findings).unwrap();
    let heel = markers.marker("HEEL").unwrap();
    assert!(!heel.is_seen(0) && heel.is_seen(1), "{heel:?}");
    assert!(findings.has(Code::MarkersZeroIsGap));
    assert!(findings.as_slice()[0].message.contains("HEEL") && !findings.as_slice()[0].message.contains("TOE"));
}

#[test]
fn rotating_the_axes_rotates_every_position_and_keeps_gaps() {
    let gap = [f64::NAN; 3];
    let file = trc(&[("HEEL", [[1.0, 2.0, 3.0], gap])]);
    let markers = markers_from_trc(&file, &mut Findings::default()).unwrap();
    // Laboratory z up, walking along +y: x forward is +y, y up is +z, z right is +x.
    let turned = markers.rotated(&Mat3::new(0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0));
    assert_eq!(turned.markers[0].positions[0], Vec3::new(2.0, 3.0, 1.0));
    assert!(!turned.markers[0].is_seen(1));
    assert_eq!((turned.frames(), turned.rate_hz), (2, markers.rate_hz));
}

#[test]
fn a_recording_without_visible_markers_is_rejected_with_its_marker_names() {
    let error = markers_from_trc(&trc(&[("HEEL", [[f64::NAN; 3]; 2])]), &mut Findings::default()).unwrap_err();
    assert!(matches!(&error, MarkerError::NoMarker { frames: 2, .. }), "{error}");
    assert!(error.to_string().contains("HEEL"), "{error}");
}

#[test]
fn times_that_do_not_increase_are_rejected_with_the_frame() {
    let marker = Marker { name: "HEEL".to_owned(), positions_m: vec![[0.1, 0.2, 0.3]; 3] };
    let file = Trc::new(100.0, vec![0.0, 0.01, 0.01], vec![marker]).unwrap();
    let error = markers_from_trc(&file, &mut Findings::default()).unwrap_err();
    assert!(matches!(error, MarkerError::TimeNotRising { frame: 3, .. }), "{error}");
}

/// A C3D file in mm with all points at (100, 200, 300).
fn c3d(names: &[&str]) -> C3d {
    let mut file = C3d::new(100.0, "mm");
    file.points = names.iter().map(|name| Point::new(name, vec![[100.0, 200.0, 300.0]; 3])).collect();
    file
}

fn names(file: &C3d) -> Vec<String> {
    let markers = markers_from_c3d(file, &mut Findings::default()).unwrap();
    markers.markers.into_iter().map(|m| m.name).collect()
}

#[test]
fn points_of_a_c3d_file_become_metres_at_the_times_of_its_frames() {
    let mut file = c3d(&["LASI"]);
    file.first_frame = 157;
    file.points[0].positions[1] = [f64::NAN; 3];
    let markers = markers_from_c3d(&file, &mut Findings::default()).unwrap();
    let times: Vec<i64> = markers.times.iter().map(|t| (t * 1000.0).round() as i64).collect();
    assert_eq!(times, [1560, 1570, 1580]);
    assert!((markers.markers[0].positions[0] - Vec3::new(0.1, 0.2, 0.3)).norm() < 1e-12);
    assert!(!markers.markers[0].is_seen(1) && markers.markers[0].is_seen(2));
}

#[test]
fn angles_forces_axes_and_unlabelled_points_are_not_markers() {
    let mut file = c3d(&["LASI", "LHipAngles", "*7", "", "LFEO", "LFEA", "LFEL", "LFEP", "PELO", "HEDA", "LKNEPower"]);
    let list = |name: &str, labels: &[&str]| {
        Parameter::list(name, Values::Texts(labels.iter().map(|l| (*l).to_owned()).collect()))
    };
    file.parameters.groups.push(Group {
        name: "POINT".to_owned(),
        description: String::new(),
        locked: false,
        parameters: vec![list("ANGLES", &["LHipAngles"]), list("POWERS", &["LKNEPower"])],
    });
    // A single point of an axis (PELO, HEDA) may be a marker with this name.
    assert_eq!(names(&file), ["LASI", "PELO", "HEDA"]);
}

#[test]
fn a_prefix_that_all_labels_share_is_cut_off() {
    assert_eq!(names(&c3d(&["Anna:LASI", "Anna:RASI", "Anna:*3"])), ["LASI", "RASI"]);
    assert_eq!(names(&c3d(&["Anna:LASI", "Ball:RASI"])), ["Anna:LASI", "Ball:RASI"]);
    assert_eq!(names(&c3d(&["Anna:LASI", "RASI"])), ["Anna:LASI", "RASI"]);
}

#[test]
fn of_two_points_with_one_name_the_one_visible_longer_is_kept() {
    let mut file = c3d(&["RANK", "LANK", "RANK"]);
    file.points[0].positions[0] = [f64::NAN; 3];
    file.points[2].positions[2] = [400.0; 3];
    let mut findings = Findings::default();
    let markers = markers_from_c3d(&file, &mut findings).unwrap();
    assert_eq!(markers.markers.len(), 2);
    assert!((markers.marker("RANK").unwrap().positions[2].x - 0.4).abs() < 1e-12);
    assert!(findings.has(Code::MarkersNameTwice));
}

#[test]
fn a_missing_unit_of_length_and_impossible_positions_are_reported() {
    let mut file = c3d(&["LASI", "RASI"]);
    file.points[1].positions[1] = [1e12, 0.0, 0.0];
    let mut findings = Findings::default();
    let markers = markers_from_c3d(&file, &mut findings).unwrap();
    assert!(findings.has(Code::MarkersImpossible) && !markers.markers[1].is_seen(1));
    file.point_unit = "deg".to_owned();
    let error = markers_from_c3d(&file, &mut findings).unwrap_err();
    assert!(matches!(&error, MarkerError::Unit { found } if found == "deg"), "{error}");
}

#[test]
fn ends_without_markers_are_removed_and_gaps_inside_are_kept() {
    let path = |name: &str, seen: std::ops::Range<usize>, gap: usize| MarkerPath {
        name: name.into(),
        positions: (0..20)
            .map(|i| if seen.contains(&i) && i != gap { Vec3::new(i as f64, 1.0, 0.0) } else { Vec3::repeat(f64::NAN) })
            .collect(),
    };
    let recording = MarkerRecording {
        name: "walk".into(),
        rate_hz: 10.0,
        times: (0..20).map(|i| i as f64 / 10.0).collect(),
        markers: vec![path("A", 3..17, 9), path("B", 5..19, 9), path("C", 5..15, 8), path("never", 0..0, 0)],
    };
    let seen = recording.trimmed_to_visible();
    // Two of the three markers that are ever visible: from frame 5 to frame 16.
    assert_eq!((seen.times.first(), seen.times.last()), (Some(&0.5), Some(&1.6)));
    assert!(!seen.markers[0].is_seen(4) && seen.markers[0].is_seen(5), "the gap at 0.9 s is still one");
    assert!((seen.markers[0].positions[0].x - 5.0).abs() < 1e-12);
    assert_eq!(seen.trimmed_to_visible().times, seen.times);
    let nothing = MarkerRecording { markers: vec![path("never", 0..0, 0)], ..recording };
    assert_eq!(nothing.trimmed_to_visible().frames(), 20);
}

/// Markers of a person of 1.7 m, in a unit of `per_metre` per metre.
fn standing_c3d(per_metre: f64) -> C3d {
    let mut file = c3d(&["LASI", "RASI", "RHEE", "LFHD"]);
    let frames = file.frames();
    for (point, height) in file.points.iter_mut().zip([1.0, 1.0, 0.05, 1.7]) {
        point.positions = vec![[0.1 * per_metre, 0.2 * per_metre, height * per_metre]; frames];
    }
    file
}

#[test]
fn the_size_of_the_person_tells_an_unknown_unit() {
    for (per_metre, name) in [(1000.0, "mm"), (100.0, "cm"), (1.0, "m")] {
        for unit in ["", "deg", "VICON"] {
            let mut file = standing_c3d(per_metre);
            file.point_unit = unit.to_owned();
            let mut findings = Findings::default();
            let markers = markers_from_c3d(&file, &mut findings).unwrap();
            assert!((markers.marker("LFHD").unwrap().positions[0].z - 1.7).abs() < 1e-6, "{name} {unit}");
            let expected = format!(
                "POINT:UNITS is `{unit}`, which is no unit of length; by the size of the markers lengths are in {name}"
            );
            assert!(findings.as_slice().iter().any(|finding| finding.message == expected), "{:?}", findings.as_slice());
        }
    }
    // A stated unit is not guessed, and a size of no person is refused.
    let mut file = standing_c3d(20.0);
    assert!(markers_from_c3d(&file, &mut Findings::default()).is_ok());
    file.point_unit = String::new();
    let error = markers_from_c3d(&file, &mut Findings::default()).unwrap_err().to_string();
    assert!(error.contains("their size is that of no person in mm, cm or m"), "{error}");
}

#[test]
fn a_table_with_three_columns_per_marker_is_a_recording() {
    for separator in ["_", ".", " ", ":", ""] {
        let mut columns = vec![("time".to_owned(), vec![0.0, 0.01])];
        for (name, height) in [("LASI", 1000.0), ("RASI", 1000.0), ("RHEE", 50.0), ("LFHD", 1700.0)] {
            for (axis, value) in [("X", 100.0), ("Y", height), ("Z", 7.0)] {
                columns.push((format!("{name}{separator}{axis}"), vec![value, value + 1.0]));
            }
        }
        let table = Table::new("walk", columns).unwrap();
        assert!(is_marker_table(&table), "{separator}");
        let mut findings = Findings::default();
        let markers = markers_from_table(&table, "walk.csv", &mut findings).unwrap();
        assert_eq!(markers.markers.len(), 4);
        assert!((markers.marker("LFHD").unwrap().positions[1].y - 1.701).abs() < 1e-9);
        assert!((markers.rate_hz - 100.0).abs() < 1e-9 && findings.has(Code::FileUnitGuessed));
    }
    let coordinates =
        ["time", "pelvis_tx", "pelvis_ty", "pelvis_tz", "ground_force_vx", "ground_force_vy", "ground_force_vz"];
    let columns = coordinates.map(|name| (name.to_owned(), vec![0.0, 0.1])).to_vec();
    assert!(!is_marker_table(&Table::new("coordinates", columns).unwrap()));
}
