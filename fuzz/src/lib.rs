//! What the fuzz targets check of each reader: no panic, and what was written reads back.
//!
//! Each function is the body of the target of its name, and `examples/replay.rs` runs them on the corpus with a stable compiler.

use ambulo::findings::Findings;
use ambulo::gait::Gait;
use ambulo::model::from_osim;
use ambulo::model::marker_set::MarkerSet;
use ambulo::simulation::scene::SceneFile;
use ambulo_formats::bvh::Bvh;
use ambulo_formats::c3d::C3d;
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_formats::osim::OsimModel;
use ambulo_formats::table::Table;
use ambulo_formats::trc::Trc;

/// A check of one input.
pub type Check = fn(&[u8]);

/// All checks, by the name of target and corpus folder.
pub const CHECKS: [(&str, Check); 10] = [
    ("c3d", c3d),
    ("trc", trc),
    ("storage", storage),
    ("csv", csv),
    ("osim", osim),
    ("external_loads", external_loads),
    ("bvh", bvh),
    ("scene", scene),
    ("gait", gait),
    ("marker_set", marker_set),
];

/// C3D files: what is read can be used; what is written reads back with the same counts.
pub fn c3d(bytes: &[u8]) {
    let Ok((record, _)) = C3d::read(bytes) else { return };
    let _ = (record.platforms(), record.times(), record.analog_times(), record.metres_per_unit());
    if let Ok(written) = record.write() {
        let (again, _) = C3d::read(&written).expect("what was written reads back");
        assert_eq!(again.frames(), record.frames());
        assert_eq!(again.points.len(), record.points.len());
        assert_eq!(again.channels.len(), record.channels.len());
        assert_eq!(again.events.len(), record.events.len());
        assert_eq!(again.encoding.storage, record.encoding.storage);
    }
}

/// Marker trajectories: what is written reads back with the same counts.
pub fn trc(bytes: &[u8]) {
    let Ok((record, _)) = Trc::read(bytes) else { return };
    let (again, _) = Trc::read(&record.write()).expect("what was written reads back");
    assert_eq!(again.times().len(), record.times().len());
    assert_eq!(again.markers().len(), record.markers().len());
}

/// OpenSim's tables: what is written reads back with the same columns.
pub fn storage(bytes: &[u8]) {
    let Ok((table, _)) = Table::read_storage(bytes) else { return };
    let (again, _) = Table::read_storage(&table.write_storage()).expect("what was written reads back");
    assert!(again.columns().map(|(name, _)| name).eq(table.columns().map(|(name, _)| name)));
}

/// Tables in CSV: what is written reads back with the same columns.
pub fn csv(bytes: &[u8]) {
    let Ok((table, _)) = Table::read_csv(bytes) else { return };
    let (again, _) = Table::read_csv(&table.write_csv()).expect("what was written reads back");
    assert!(again.columns().map(|(name, _)| name).eq(table.columns().map(|(name, _)| name)));
}

/// OpenSim models: the document, and the model made from it.
pub fn osim(bytes: &[u8]) {
    if let Ok(document) = OsimModel::read(bytes) {
        let _ = from_osim(&document, &mut Findings::default());
    }
}

/// Lists of external loads: what is written reads back.
pub fn external_loads(bytes: &[u8]) {
    if let Ok((loads, _)) = ExternalLoads::read(bytes) {
        let _ = ExternalLoads::read(&loads.write()).expect("what was written reads back");
    }
}

/// Skeletons with their motion: what is written reads back with the same counts.
pub fn bvh(bytes: &[u8]) {
    let Ok((record, _)) = Bvh::read(bytes) else { return };
    let (again, _) = Bvh::read(&record.write()).expect("what was written reads back");
    assert_eq!(again.joints().len(), record.joints().len());
    assert_eq!(again.frames(), record.frames());
}

/// Scene files: parsed, not built.
pub fn scene(bytes: &[u8]) {
    if let Ok(text) = std::str::from_utf8(bytes) {
        let _ = SceneFile::parse(text);
    }
}

/// Synthetic gaits.
pub fn gait(bytes: &[u8]) {
    if let Ok(text) = std::str::from_utf8(bytes) {
        let _ = Gait::from_toml(text);
    }
}

/// Marker sets.
pub fn marker_set(bytes: &[u8]) {
    if let Ok(text) = std::str::from_utf8(bytes) {
        let _ = MarkerSet::from_toml(text);
    }
}
