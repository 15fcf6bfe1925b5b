//! Persons of the recordings on the built-in body: calibrated from quiet standing, moved by their markers.

use crate::shared_data;
use ambulo_body::dynamics::LoadSeries;
use ambulo_body::findings::Findings;
use ambulo_body::kinematics::Trajectory;
use ambulo_body::kinematics::calibration::{BodyMeasurements, PersonMeasurements, Trial, calibrate};
use ambulo_body::kinematics::marker_fit::{FitSettings, fit_markers};
use ambulo_body::model::Model;
use ambulo_body::model::anthropometry::SegmentTable;
use ambulo_body::model::marker_set::MarkerSet;
use ambulo_body::motion::filter::LowPass;
use ambulo_body::motion::{
    MarkerRecording, Motion, SmoothSettings, Smoother, Window, force_recordings, interpolate, markers_from_trc, smooth,
};
use ambulo_body::spatial::{Vec3, Wrench};
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_formats::table::Table;
use ambulo_formats::trc::Trc;
use std::path::{Path, PathBuf};

/// A person of a recording.
pub(crate) struct Person {
    /// The recording.
    pub(crate) folder: PathBuf,
    /// The built-in body of the person.
    pub(crate) model: Model,
    /// Its motion in the walk.
    pub(crate) walk: Motion,
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
    Some(Person { folder, model: body.human.model, walk: walk.motion })
}

/// The person of Gait2392's `subject01`.
pub(crate) fn subject01() -> Option<Person> {
    person("opensim-gait2392-subject01", ["subject01_static.trc", "subject01_walk1.trc"], 72.6, 1.8034)
}

/// The walker of Rajagopal's examples.
pub(crate) fn rajagopal_walker() -> Option<Person> {
    person("opensim-rajagopal-walk", ["static_walk_1.trc", "markers_walk.trc"], 85.07, 1.829)
}

impl Person {
    /// The walk with its derivatives, low-passed at 6 Hz.
    pub(crate) fn trajectory(&self, window: [f64; 2]) -> Trajectory {
        let smoother = Smoother::Butterworth(LowPass::MOTION);
        let window = Window { from_s: Some(window[0]), to_s: Some(window[1]) };
        let settings = SmoothSettings { smoother, window, rate_hz: None };
        let smooth = smooth(&self.model, &self.walk, settings, &mut Findings::default()).unwrap();
        Trajectory::complete(&self.model, smooth, &mut Findings::default()).unwrap()
    }

    /// The forces of the plates on the feet in the frames of a trajectory.
    pub(crate) fn ground(&self, [plates, loads]: [&str; 2], trajectory: &Trajectory) -> Vec<LoadSeries> {
        let file = |name: &str| std::fs::read(self.folder.join(name)).unwrap();
        let table = Table::read_storage(&file(plates)).unwrap().0;
        let loads = ExternalLoads::read(&file(loads)).unwrap().0;
        let recordings = force_recordings(&self.model, &loads, &table, &mut Findings::default()).unwrap();
        let grid = trajectory.grid();
        let series = recordings.into_iter().map(|recording| {
            let at = |values: &[Vec3], time: f64| {
                let one = |k: usize| {
                    let column: Vec<f64> = values.iter().map(|v| v[k]).collect();
                    interpolate(&recording.times, &column, time)
                };
                Vec3::new(one(0), one(1), one(2))
            };
            let times = grid.times();
            let points = times.iter().map(|time| at(&recording.point, *time)).collect();
            let wrench =
                |time: &f64| Wrench { force: at(&recording.force, *time), moment: at(&recording.moment, *time) };
            LoadSeries { body: recording.body, points, wrenches: times.iter().map(wrench).collect() }
        });
        series.collect()
    }
}
