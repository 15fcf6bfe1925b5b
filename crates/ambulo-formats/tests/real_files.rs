//! The recordings listed below are read, with the counts that their README states. Skipped where the data are not
//! there.

use crate::shared_data::data;
use ambulo_formats::bvh::Bvh;
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_formats::table::Table;
use ambulo_formats::trc::{LengthUnit, Trc};
use ambulo_formats::{Error, Remark};
use std::path::Path;

/// Files whose header is wrong, with the remark.
const REMARKS: [(&str, &str); 2] = [
    ("coordinates.sto", "line 9: the header states 40 columns, the file has 32; read 32"),
    ("hamner-subject04-run3/grf.mot", "the header states 11621 rows, the file has 4490; read 4490"),
];

/// OpenSim tables of coordinates, forces and reference results.
const STORAGE: &[&str] = &[
    "hamner-subject04-run3/grf.mot",
    "opensim-gait10dof-subject01/subject01_walk_ID.sto",
    "opensim-gait10dof-subject01/subject01_walk_IK.mot",
    "opensim-gait10dof-subject01/subject01_walk_grf.mot",
    "opensim-gait2392-subject01/InverseDynamicsOutput.sto",
    "opensim-gait2392-subject01/core-id-test/subject01_walk1_grf.mot",
    "opensim-gait2392-subject01/ik_uniform_weights.mot",
    "opensim-gait2392-subject01/subject01_walk1_grf.mot",
    "opensim-gait2392-subject01/subject01_walk1_ik.mot",
    "opensim-rajagopal-run/grf_run.mot",
    "opensim-rajagopal-walk/coordinates.sto",
    "opensim-rajagopal-walk/grf_walk.mot",
    "opensim-rajagopal-walk/id_walk.sto",
    "opensim-rajagopal-walk/ik_uniform_weights.mot",
];

/// Marker files.
const MARKERS: &[&str] = &[
    "hamner-subject04-run3/markers.trc",
    "opensim-gait2392-subject01/subject01_static.trc",
    "opensim-gait2392-subject01/subject01_walk1.trc",
    "opensim-rajagopal-run/motion_capture_run.trc",
    "opensim-rajagopal-run/static_run.trc",
    "opensim-rajagopal-walk/markers_walk.trc",
    "opensim-rajagopal-walk/static_walk_1.trc",
];

/// External loads, each next to the table that it names.
const LOADS: &[&str] = &[
    "opensim-gait10dof-subject01/subject01_walk_grf.xml",
    "opensim-gait2392-subject01/subject01_walk1_grf.xml",
    "opensim-rajagopal-run/grf_run.xml",
    "opensim-rajagopal-walk/grf_walk.xml",
];

/// Skeletons and comma-separated tables.
const OTHERS: &[&str] = &[
    "bvh/01_01.bvh",
    "bvh/AV_8Walk_Meredith_HVHA_Rep1.bvh",
    "normative/pinzone2014.csv",
    "normative/schwartz2008_angles.csv",
    "normative/schwartz2008_cycle_events.csv",
    "normative/schwartz2008_grf.csv",
    "normative/schwartz2008_moments.csv",
    "normative/schwartz2008_powers.csv",
];

#[track_caller]
fn read<T>(path: &Path, reader: impl Fn(&[u8]) -> Result<(T, Vec<Remark>), Error>) -> T {
    let (record, remarks) = reader(&std::fs::read(path).unwrap()).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let remarks: Vec<String> = remarks.iter().map(ToString::to_string).collect();
    let known = REMARKS.iter().filter(|(file, _)| path.ends_with(file)).map(|(_, remark)| *remark);
    assert_eq!(remarks, known.collect::<Vec<_>>(), "{}", path.display());
    record
}

#[test]
fn every_storage_file_is_read_and_written_back_to_the_same_bits() {
    let Some(folder) = data() else { return };
    for path in STORAGE.iter().map(|name| folder.join(name)) {
        let table = read(&path, Table::read_storage);
        let times = table.times().unwrap();
        assert!(times.windows(2).all(|pair| pair[0] < pair[1]), "{}", path.display());
        assert!(table.columns().all(|(_, values)| values.iter().all(|value| value.is_finite())), "{}", path.display());
        let (again, remarks) = Table::read_storage(&table.write_storage()).unwrap();
        assert_eq!((again.in_degrees, remarks), (table.in_degrees, vec![]));
        assert!(again.columns().eq(table.columns()), "{}", path.display());
        let (again, _) = Table::read_csv(&table.write_csv()).unwrap();
        assert!(again.columns().eq(table.columns()), "{}", path.display());
    }
}

#[test]
fn storage_files_have_the_stated_size_and_unit() {
    let Some(folder) = data() else { return };
    for (path, rows, columns, in_degrees) in [
        ("opensim-gait2392-subject01/subject01_walk1_ik.mot", 211, 24, Some(true)),
        ("opensim-gait2392-subject01/subject01_walk1_grf.mot", 1501, 19, Some(true)),
        ("opensim-gait2392-subject01/core-id-test/subject01_walk1_grf.mot", 9009, 19, Some(true)),
        ("opensim-gait2392-subject01/InverseDynamicsOutput.sto", 73, 24, Some(false)),
        ("opensim-rajagopal-walk/coordinates.sto", 1350, 32, Some(false)),
        ("opensim-rajagopal-run/grf_run.mot", 5091, 19, Some(true)),
    ] {
        let table = read(&folder.join(path), Table::read_storage);
        assert_eq!((table.rows(), table.names().len(), table.in_degrees), (rows, columns, in_degrees), "{path}");
    }
}

#[test]
fn every_marker_file_is_read_and_written_back_to_the_same_bits() {
    let Some(folder) = data() else { return };
    for path in MARKERS.iter().map(|name| folder.join(name)) {
        let trc = read(&path, Trc::read);
        assert_eq!(trc.unit, LengthUnit::Millimetre);
        let (again, remarks) = Trc::read(&trc.write()).unwrap();
        assert_eq!(remarks, vec![], "{}", path.display());
        assert!(again.markers() == trc.markers() && again.times() == trc.times(), "{}", path.display());
        assert_eq!((&again.name, again.frames()), (&trc.name, trc.frames()));
    }
}

#[test]
fn marker_files_have_the_stated_size_and_start() {
    let Some(folder) = data() else { return };
    for (path, frames, markers, start, time) in [
        ("opensim-gait2392-subject01/subject01_walk1.trc", 151, 41, 1, 0.0),
        ("opensim-gait2392-subject01/subject01_static.trc", 300, 49, 1, 0.0),
        ("opensim-rajagopal-walk/markers_walk.trc", 238, 41, 1, 0.0),
        ("opensim-rajagopal-walk/static_walk_1.trc", 287, 64, 1, 0.0),
        ("opensim-rajagopal-run/motion_capture_run.trc", 510, 42, 23, 0.23),
        ("opensim-rajagopal-run/static_run.trc", 397, 64, 1, 0.0),
    ] {
        let trc = read(&folder.join(path), Trc::read);
        assert_eq!((trc.times().len(), trc.markers().len(), trc.orig_start_frame), (frames, markers, start), "{path}");
        assert_eq!((trc.frames()[0], trc.times()[0].to_bits()), (start, f64::to_bits(time)), "{path}");
    }
}

#[test]
fn every_loads_document_names_two_feet_and_columns_that_its_data_file_has() {
    let Some(folder) = data() else { return };
    for path in LOADS.iter().map(|name| folder.join(name)) {
        let loads = read(&path, ExternalLoads::read);
        let bodies: Vec<&str> = loads.forces.iter().map(|force| force.applied_to_body.as_str()).collect();
        assert_eq!(bodies, ["calcn_r", "calcn_l"], "{}", path.display());
        let table = read(
            &path.with_file_name(Path::new(loads.datafile.as_ref().unwrap()).file_name().unwrap()),
            Table::read_storage,
        );
        for force in &loads.forces {
            assert!(
                force.enabled && force.force_expressed_in_body == "ground" && force.point_expressed_in_body == "ground"
            );
            for start in [&force.force_identifier, &force.point_identifier, &force.torque_identifier] {
                for axis in ["x", "y", "z"] {
                    let column = format!("{}{axis}", start.as_ref().unwrap());
                    assert!(table.column(&column).is_some(), "{}: {column}", path.display());
                }
            }
        }
        assert_eq!(ExternalLoads::read(&loads.write()).unwrap().0, loads);
    }
}

#[test]
fn documents_of_other_kinds_are_refused_as_loads() {
    let Some(folder) = data() else { return };
    for (path, message) in [
        (
            "opensim-rajagopal-run/id_setup_run.xml",
            "line 2, element <OpenSimDocument>: found <InverseDynamicsTool>; expected an <ExternalLoads> document",
        ),
        (
            "opensim-gait10dof-subject01/subject01.osim",
            "line 2, element <OpenSimDocument>: found <Model>; expected an <ExternalLoads> document",
        ),
    ] {
        let bytes = std::fs::read(folder.join(path)).unwrap();
        assert_eq!(ExternalLoads::read(&bytes).unwrap_err().to_string(), message);
    }
}

#[test]
fn csv_with_words_in_its_cells_is_refused_by_line() {
    let Some(folder) = data() else { return };
    let bytes = std::fs::read(folder.join("normative/schwartz2008_grf.csv")).unwrap();
    let message = Table::read_csv(&bytes).unwrap_err().to_string();
    assert_eq!(message, "line 2: found `Anterior/Posterior`; expected a number");
}

#[test]
fn real_files_cut_anywhere_do_not_panic() {
    let Some(folder) = data() else { return };
    for path in [STORAGE, MARKERS, LOADS, OTHERS].concat().into_iter().map(|name| folder.join(name)) {
        let bytes = std::fs::read(&path).unwrap();
        for end in (0..bytes.len()).step_by(if bytes.len() < 20_000 { 100 } else { 4001 }) {
            let cut = &bytes[..end];
            let _ = (Table::read_storage(cut), Table::read_csv(cut), Trc::read(cut), ExternalLoads::read(cut));
            let _ = Bvh::read(cut);
        }
    }
}

#[test]
fn skeletons_have_the_stated_size_and_are_written_back_to_the_same_bits() {
    let Some(folder) = data() else { return };
    for (file, joints, channels, frames, rate_hz) in
        [("AV_8Walk_Meredith_HVHA_Rep1.bvh", 23, 72, 1064, 120.0), ("01_01.bvh", 31, 96, 2752, 120.0)]
    {
        let bvh = read(&folder.join("bvh").join(file), Bvh::read);
        assert_eq!((bvh.joints().len(), bvh.channels(), bvh.frames()), (joints, channels, frames), "{file}");
        assert!((1.0 / bvh.frame_time_s() - rate_hz).abs() < 0.01, "{file}");
        let (again, remarks) = Bvh::read(&bvh.write()).unwrap();
        assert_eq!((&again, remarks), (&bvh, vec![]));
    }
}
