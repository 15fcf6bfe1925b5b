//! Recordings of markers with models and measured ground forces, from the data next to the repository.

use crate::shared_data::data;
use ambulo::findings::Findings;
use ambulo::model::Model;
use ambulo::motion::{ForceRecording, MarkerRecording, force_recordings, markers_from_trc};
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_formats::table::Table;
use ambulo_formats::trc::Trc;
use std::path::{Path, PathBuf};

/// A person with a scaled model, a walking trial and a static one.
pub(crate) struct Subject {
    pub(crate) model: Model,
    pub(crate) markers: MarkerRecording,
    pub(crate) standing: MarkerRecording,
    pub(crate) plates: Vec<ForceRecording>,
    folder: PathBuf,
}

impl Subject {
    /// OpenSim's fit of the walking trial [deg].
    pub(crate) fn opensim_angles(&self) -> Table {
        table(&self.folder.join("ik_uniform_weights.mot"))
    }
}

pub(crate) fn table(path: &Path) -> Table {
    Table::read_storage(&std::fs::read(path).unwrap()).unwrap().0
}

pub(crate) fn markers(path: &Path) -> MarkerRecording {
    let (trc, _) = Trc::read(&std::fs::read(path).unwrap()).unwrap();
    markers_from_trc(&trc, &mut Findings::default()).unwrap()
}

fn subject(folder: PathBuf, [model, walk, standing, grf, loads]: [&str; 5]) -> Subject {
    let bytes = |name: &str| std::fs::read(folder.join(name)).unwrap();
    let mut findings = Findings::default();
    let model = Model::from_osim(&bytes(model), &mut findings).unwrap();
    let (loads, _) = ExternalLoads::read(&bytes(loads)).unwrap();
    let plates = force_recordings(&model, &loads, &table(&folder.join(grf)), &mut findings).unwrap();
    let [markers, standing] = [walk, standing].map(|name| markers(&folder.join(name)));
    Subject { model, markers, standing, plates, folder }
}

pub(crate) fn rajagopal() -> Option<Subject> {
    let folder = data()?.join("opensim-rajagopal-walk");
    let files = ["subject_walk_scaled.osim", "markers_walk.trc", "static_walk_1.trc", "grf_walk.mot", "grf_walk.xml"];
    Some(subject(folder, files))
}

pub(crate) fn gait2392() -> Option<Subject> {
    let folder = data()?.join("opensim-gait2392-subject01");
    let files = [
        "subject01_simbody.osim",
        "subject01_walk1.trc",
        "subject01_static.trc",
        "subject01_walk1_grf.mot",
        "subject01_walk1_grf.xml",
    ];
    Some(subject(folder, files))
}
