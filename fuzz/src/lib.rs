//! The checks of the fuzz targets. Readers do not panic, and a file that was written reads back; scenes can be stepped; a study of a
//! small file ends in results or in an error.
//!
//! Each function is the body of the target of its name, and `examples/replay.rs` runs them on the corpus with a stable compiler.

use ambulo::analysis::feasibility::Thresholds;
use ambulo::findings::Findings;
use ambulo::gait::Gait;
use ambulo::job::{Job, ModelChoice};
use ambulo::kinematics::marker_fit::FitSettings;
use ambulo::kinematics::sensor_fit::{SensorAxes, SensorTrial, fit_sensors};
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::model::full_body::full_body;
use ambulo::model::marker_set::MarkerSet;
use ambulo::model::{BySide, from_osim, to_osim};
use ambulo::motion::{
    B3dTrial, SmplMotion, Window, events_from_mvnx, is_bids_markers, markers_from_bids,
    segment_poses_from_mvnx, sensors_from_table,
};
use ambulo::simulation::scene::{SavedState, Scene, SceneFile, SceneSettings};
use ambulo::study::StatedSize;
use ambulo_formats::b3d::B3d;
use ambulo_formats::bids_motion::BidsMotion;
use ambulo_formats::bvh::Bvh;
use ambulo_formats::c3d::C3d;
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_formats::mvnx::Mvnx;
use ambulo_formats::npz::Npz;
use ambulo_formats::osim::{OsimMarkerSet, OsimModel};
use ambulo_formats::setup::Setup;
use ambulo_formats::table::{OrientationTable, Table};
use ambulo_formats::trc::Trc;
use ambulo_results::Folder;
use std::path::Path;
use std::sync::LazyLock;

/// A check of one input.
pub type Check = fn(&[u8]);

/// All checks, by the name of target and corpus folder.
pub const CHECKS: [(&str, Check); 22] = [
    ("c3d", c3d),
    ("trc", trc),
    ("storage", storage),
    ("csv", csv),
    ("osim", osim),
    ("external_loads", external_loads),
    ("setup", setup),
    ("bvh", bvh),
    ("b3d", b3d),
    ("npz", npz),
    ("bids_motion", bids_motion),
    ("mvnx", mvnx),
    ("orientations", orientations),
    ("scene", scene),
    ("gait", gait),
    ("marker_set", marker_set),
    ("thresholds", thresholds),
    ("scene_run", scene_run),
    ("saved_state", saved_state),
    ("result_folder", result_folder),
    ("study_coordinates", study_coordinates),
    ("study_markers", study_markers),
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

/// OpenSim models: the document, and the model made from it; its markers as a set.
pub fn osim(bytes: &[u8]) {
    if let Ok(document) = OsimModel::read(bytes) {
        let _ = from_osim(&document, &mut Findings::default());
        if let Ok(set) = OsimMarkerSet::read(bytes) {
            let _ = document.with_marker_set(&set);
        }
    }
}

/// Lists of external loads: what is written reads back.
pub fn external_loads(bytes: &[u8]) {
    if let Ok((loads, _)) = ExternalLoads::read(bytes) {
        let _ = ExternalLoads::read(&loads.write()).expect("what was written reads back");
    }
}

/// Set-ups of OpenSim's tools; the files of their sets have the same bytes.
pub fn setup(bytes: &[u8]) {
    if let Ok((setup, _)) = Setup::read_with(bytes, &mut |_| Ok(bytes.to_vec())) {
        let _ = setup.tool();
    }
}

/// Skeletons with their motion: what is written reads back with the same counts.
pub fn bvh(bytes: &[u8]) {
    let Ok((record, _)) = Bvh::read(bytes) else { return };
    let (again, _) = Bvh::read(&record.write()).expect("what was written reads back");
    assert_eq!(again.joints().len(), record.joints().len());
    assert_eq!(again.frames(), record.frames());
}

/// Subjects of AddBiomechanics: every trial becomes a source or is refused; what is written reads back with the same counts.
pub fn b3d(bytes: &[u8]) {
    let Ok(record) = B3d::read(bytes) else { return };
    for (trial, frames) in record.trials.iter().enumerate() {
        let of_file = B3dTrial { header: &record.header, trial, frames, name: "trial" };
        let _ = Source::of_b3d(&of_file, Window::default(), &mut Findings::default());
        let _ = of_file.markers(&mut Findings::default());
    }
    if let Ok(written) = record.write() {
        let again = B3d::read(&written).expect("what was written reads back");
        assert_eq!(again.header.trials, record.header.trials);
        assert_eq!(again.header.markers, record.header.markers);
    }
}

/// Archives of arrays: a motion of the SMPL family or a refusal; what is written reads back with the same names.
pub fn npz(bytes: &[u8]) {
    let Ok(record) = Npz::read(bytes) else { return };
    let _ = SmplMotion::from_npz(&record);
    if let Ok(written) = record.write() {
        let again = Npz::read(&written).expect("what was written reads back");
        assert_eq!(again.arrays.len(), record.arrays.len());
    }
}

/// Motions of BIDS data sets: channels and motion in one input, divided by the first empty line.
pub fn bids_motion(bytes: &[u8]) {
    let divided = bytes.windows(2).position(|pair| pair == b"\n\n").unwrap_or(bytes.len());
    let (channels, motion) = bytes.split_at(divided);
    let Ok(bids) = BidsMotion::read(motion, channels) else { return };
    if is_bids_markers(&bids).is_ok_and(|has_markers| has_markers) {
        let _ = markers_from_bids(&bids, Some(100.0), "motion", &mut Findings::default());
    }
}

/// Motions of Xsens MVN: the poses of their segments, and their points.
pub fn mvnx(bytes: &[u8]) {
    let Ok((record, _)) = Mvnx::read(bytes) else { return };
    let _ = events_from_mvnx(&record);
    if let Ok(poses) = segment_poses_from_mvnx(&record, &mut Findings::default()) {
        let _ = poses.points("motion");
    }
}

/// Orientations of sensors: what is written reads back with the same sensors; short ones turn the built-in body.
pub fn orientations(bytes: &[u8]) {
    let Ok(table) = OrientationTable::read(bytes) else { return };
    if let Ok(written) = table.write() {
        let again = OrientationTable::read(&written).expect("what was written reads back");
        assert_eq!(again.times.len(), table.times.len());
        assert_eq!(again.sensors.len(), table.sensors.len());
    }
    let Ok(sensors) = sensors_from_table(&table, "motion") else { return };
    if table.times.len() > 20 {
        return;
    }
    let build = Build { table: SegmentTable::DeLevaMale, mass: 70.0, height: 1.75, toe_joint: true };
    let human = full_body(&build).expect("a usual body");
    let axes = SensorAxes::default();
    let trial = SensorTrial { moving: &sensors, standing: None, axes: &axes };
    let soles = BySide::from_fn(|side| human.sole(side));
    let _ = fit_sensors(&human.model, &soles, &trial, &FitSettings::default(), &mut Findings::default());
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

/// Limits of what a person can do.
pub fn thresholds(bytes: &[u8]) {
    if let Ok(text) = std::str::from_utf8(bytes) {
        let _ = Thresholds::from_toml(text);
    }
}

/// Largest number of bodies, figures and obstacles of a scene that is stepped, and number of steps.
const MOST_THINGS: usize = 12;
const STEPS: usize = 20;

/// A scene without other files, if it is small.
fn built(text: &str) -> Option<Scene> {
    let file = SceneFile::parse(text).ok()?;
    if file.bodies.len() + file.figures.len() + file.obstacles.len() > MOST_THINGS {
        return None;
    }
    let mut load = |path: &str| Err(format!("no file {path}"));
    Scene::build(&file, SceneSettings::default(), &mut load, &mut Findings::default()).ok()
}

/// Scene files: built and stepped; a saved state resumes.
pub fn scene_run(bytes: &[u8]) {
    let Some(mut scene) = std::str::from_utf8(bytes).ok().and_then(built) else { return };
    for _ in 0..STEPS {
        if scene.step(&mut Findings::default()).is_err() {
            return;
        }
    }
    let saved = scene.save();
    scene.resume(&saved).expect("a scene resumes its own state");
}

/// The scene of the saved states.
const TOP: &str = include_str!("../corpus/scene/top.toml");

/// Saved states of one scene: resumed and stepped.
pub fn saved_state(bytes: &[u8]) {
    let Ok(saved) = serde_json::from_slice::<SavedState>(bytes) else { return };
    let mut scene = built(TOP).expect("a scene of the corpus");
    if scene.resume(&saved).is_ok() {
        let _ = scene.step(&mut Findings::default());
    }
}

/// Result folders: every file of a folder has these bytes.
pub fn result_folder(bytes: &[u8]) {
    let file = |_: &str| Some(bytes.to_vec());
    let folder = Folder::of_files("results", &file);
    let _ = (folder.summary(), folder.events(), folder.cycles(), folder.body().is_ok());
    let _ = (folder.table("moments.sto"), folder.csv_table("clinical.csv"));
}

/// Largest number of samples of a recording that is studied.
const MOST_SAMPLES: usize = 100_000;

/// Coordinates of the built-in body, studied with predicted forces.
pub fn study_coordinates(bytes: &[u8]) {
    let Ok((table, _)) = Table::read_storage(bytes) else { return };
    if table.rows() * table.columns().count() > MOST_SAMPLES {
        return;
    }
    let mut files = |path: &Path| Ok(if path == Path::new(BODY) { body().to_vec() } else { bytes.to_vec() });
    let job = Job { model: Some(ModelChoice::File(BODY.into())), ..Job::of("recording.mot") };
    let mut findings = Findings::default();
    let _ = job.read(&mut files, &mut findings).and_then(|read| read.run(&mut findings));
}

/// File of the built-in body.
const BODY: &str = "body.osim";

/// The built-in body as a model of OpenSim, written once.
fn body() -> &'static [u8] {
    static BODY: LazyLock<Vec<u8>> = LazyLock::new(|| {
        let build = Build { table: SegmentTable::DeLevaFemale, mass: 60.0, height: 1.65, toe_joint: true };
        let model = build.human().expect("a built-in body").model;
        let written = to_osim(&model).expect("a body that OpenSim can represent").write();
        written.expect("a model that can be written")
    });
    &BODY
}

/// Markers with or without plates, studied with the built-in body.
pub fn study_markers(bytes: &[u8]) {
    let mut findings = Findings::default();
    let Ok((record, _)) = C3d::read(bytes) else { return };
    let poses = record.rotations.len() * record.rotations_per_frame();
    if record.frames() * (record.points.len() + poses) > MOST_SAMPLES {
        return;
    }
    let size = StatedSize { mass_kg: Some(60.0), height_m: None };
    let job = Job { segments: SegmentTable::DeLevaFemale, size, ..Job::of("recording.c3d") };
    let read = job.read(&mut |_: &Path| Ok(bytes.to_vec()), &mut findings);
    let _ = read.and_then(|read| read.run(&mut findings));
}
