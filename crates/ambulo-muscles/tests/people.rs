//! Persons of the recordings on the built-in body.

use crate::shared_data;
use ambulo_body::findings::Findings;
use ambulo_body::kinematics::calibration::{BodyMeasurements, Calibrated, PersonMeasurements, Trial, calibrate};
use ambulo_body::kinematics::marker_fit::{FitSettings, MarkerFit, fit_markers};
use ambulo_body::model::anthropometry::SegmentTable;
use ambulo_body::model::marker_set::MarkerSet;
use ambulo_body::motion::{MarkerRecording, markers_from_trc};
use ambulo_formats::trc::Trc;
use std::path::{Path, PathBuf};

/// A person of a recording: body from quiet standing, motion of the walk.
pub(crate) struct Person {
    pub(crate) folder: PathBuf,
    pub(crate) body: Calibrated,
    pub(crate) walk: MarkerFit,
}

/// A TRC file of OpenSim's examples: y up, walking along +x.
fn trc(folder: &Path, name: &str) -> MarkerRecording {
    let file = Trc::read(&std::fs::read(folder.join(name)).unwrap()).unwrap().0;
    markers_from_trc(&file, &mut Findings::default()).unwrap()
}

fn person(folder: &str, [standing, walk]: [&str; 2], mass: f64, height: f64) -> Option<Person> {
    let folder = shared_data::data()?.join(folder);
    let [standing, walk] = [standing, walk].map(|file| trc(&folder, file));
    let (table, measurements) = (SegmentTable::DeLevaMale, BodyMeasurements::default());
    let person = PersonMeasurements { table, mass, height: Some(height), measurements };
    let known = MarkerSet::recognise(standing.markers.iter().map(|m| m.name.as_str())).unwrap();
    let body = calibrate(&standing, Trial::Standing, &known, &person, &mut Findings::default()).unwrap();
    let settings = FitSettings { weights: body.weights.clone(), ..FitSettings::default() };
    let walk = fit_markers(&body.human.model, &walk, &settings, &mut Findings::default()).unwrap();
    Some(Person { folder, body, walk })
}

/// The person of Gait2392's `subject01`.
pub(crate) fn subject01() -> Option<Person> {
    person("opensim-gait2392-subject01", ["subject01_static.trc", "subject01_walk1.trc"], 72.6, 1.8034)
}

/// The walker of Rajagopal's examples.
pub(crate) fn rajagopal_walker() -> Option<Person> {
    person("opensim-rajagopal-walk", ["static_walk_1.trc", "markers_walk.trc"], 85.07, 1.829)
}
