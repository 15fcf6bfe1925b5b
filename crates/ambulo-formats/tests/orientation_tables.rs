//! Tables of quaternions (`.sto` of OpenSense): reading, writing, and what is refused.

use ambulo_formats::table::{OrientationTable, Table};

/// As OpenSim 4.6 writes them.
const FILE: &str = "DataRate=100.000000\nDataType=Quaternion\nversion=3\nOpenSimVersion=4.6\nendheader\n\
    time\tpelvis_imu\tfemur_r_imu\n\
    0\t0.70710678,0,0.70710678,0\t1,0,0,0\n\
    0.01\t0.70710678,0,0.70710678,0\tnan,nan,nan,nan\n";

fn refused(from: &str, to: &str) -> String {
    assert!(FILE.contains(from), "{from}");
    OrientationTable::read(FILE.replacen(from, to, 1).as_bytes()).unwrap_err().to_string()
}

#[test]
fn quaternions_are_read_with_names_times_and_gaps() {
    assert!(OrientationTable::is_stated(FILE.as_bytes()));
    let table = OrientationTable::read(FILE.as_bytes()).unwrap();
    assert_eq!(table.times, [0.0, 0.01]);
    assert_eq!(table.rate_hz, Some(100.0));
    assert_eq!(table.lines, [7, 8]);
    let names: Vec<&str> = table.sensors.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["pelvis_imu", "femur_r_imu"]);
    let half = 0.5f64.sqrt();
    let [w, x, y, z] = table.sensors[0].1[0].unwrap();
    assert!([w - half, x, y - half, z].iter().all(|off| off.abs() < 1e-12), "length 1: {w} {x} {y} {z}");
    assert_eq!(table.sensors[1].1, [Some([1.0, 0.0, 0.0, 0.0]), None]);
}

#[test]
fn what_is_written_reads_back() {
    let table = OrientationTable::read(FILE.as_bytes()).unwrap();
    let again = OrientationTable::read(&table.write().unwrap()).unwrap();
    assert_eq!(again.sensors.len(), 2);
    for ((name, path), (again_name, again_path)) in table.sensors.iter().zip(&again.sensors) {
        assert_eq!(name, again_name);
        for (a, b) in path.iter().zip(again_path) {
            assert_eq!(a.is_some(), b.is_some());
            let (a, b) = (a.unwrap_or_default(), b.unwrap_or_default());
            let off = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off < 1e-15, "one rounding of the length");
        }
    }
    let twice = OrientationTable { sensors: vec![table.sensors[0].clone(); 2], ..table.clone() };
    assert!(twice.write().unwrap_err().to_string().contains("two sensors `pelvis_imu`"));
    let short = OrientationTable { times: vec![0.0], ..table };
    assert!(short.write().unwrap_err().to_string().contains("2 orientations of `pelvis_imu` at 1 times"));
}

#[test]
fn cells_that_are_no_rotations_are_refused_with_line_and_sensor() {
    let text = refused("\t1,0,0,0", "\t0,0,0,0");
    let wanted = "line 7: found `0,0,0,0` of length 0.000 for `femur_r_imu`; expected a rotation: w,x,y,z of length 1";
    assert!(text.starts_with(wanted), "{text}");
    assert!(
        refused("\t1,0,0,0", "\t1,0,0")
            .contains("found `1,0,0` for `femur_r_imu`; expected a quaternion of four numbers")
    );
    assert!(refused("\t1,0,0,0", "\t1,0,0,x").contains("expected a quaternion of four numbers"));
    assert!(refused("\t1,0,0,0", "").contains("line 7: found 2 cells; expected 3: the time and a quaternion"));
    assert!(refused("0.01\t", "late\t").contains("line 8: found `late`; expected the time in seconds"));
    assert!(refused("femur_r_imu", "pelvis_imu").contains("two columns `pelvis_imu`"));
    assert!(refused("DataType=Quaternion\n", "").contains("line 4: found a header without `DataType=Quaternion`"));
    assert!(
        refused("DataType=Quaternion", "DataType=Vec3")
            .contains("found DataType `Vec3`; expected `DataType=Quaternion`")
    );
    assert!(refused("endheader", "end").contains("the file ends here; expected a line `endheader`"));
    assert!(OrientationTable::read(b" ").unwrap_err().to_string().starts_with("the file is empty"));
}

#[test]
fn tables_of_numbers_are_not_tables_of_quaternions() {
    let numbers = Table::new("motion", vec![("time".into(), vec![0.0]), ("knee".into(), vec![0.1])]).unwrap();
    assert!(!OrientationTable::is_stated(&numbers.write_storage()));
    assert!(!OrientationTable::is_stated(b""));
}
