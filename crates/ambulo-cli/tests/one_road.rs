//! The files of `ambulo forces` are equal, byte for byte, to those written from `study::run`.
//!
//! Each recording goes once through the command and once through the library, from the same bytes. `report.html` is
//! left out: it is written from the other files. In `summary.json`, `timing_ms` (the command's clock), `input` (names
//! of files), `run_id` and `files` (hashes of the files written) are left out.

use crate::shared_data;
use crate::workbench::Workbench;
use ambulo::findings::Findings;
use ambulo::model::anthropometry::SegmentTable;
use ambulo::model::{Model, to_osim};
use ambulo::motion::coordinates_from_table;
use ambulo::motion::skeleton::skeleton_from_bvh;
use ambulo::study::{
    self, ForceTable, GroundSettings, LaboratoryFile, MarkerBody, MarkerSource, MeasuredForces, Recording, Settings,
    Source, StandingTrial,
};
use ambulo_formats::bvh::Bvh;
use ambulo_formats::external_loads::{ExternalForce, ExternalLoads};
use ambulo_formats::table::Table;
use ambulo_report::{clinical_file, outcome_figures};
use ambulo_results::{Convention, GroundSource, Input, Keep, Summary, outcome_summary, outcome_tables};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Reads the source of a recording as the command does.
struct Reader {
    folder: PathBuf,
    findings: Findings,
}

impl Reader {
    fn of(folder: PathBuf) -> Reader {
        Reader { folder, findings: Findings::default() }
    }

    fn bytes(&self, name: &str) -> Vec<u8> {
        fs::read(self.folder.join(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    fn shown(&self, name: &str) -> String {
        self.folder.join(name).display().to_string()
    }

    fn model(&mut self, name: &str) -> Model {
        Model::from_osim(&self.bytes(name), &mut self.findings).unwrap()
    }

    fn coordinates(&mut self, model: &str, motion: &str) -> Source {
        let model = self.model(model);
        let (table, shown) = (self.table(motion), self.shown(motion));
        let motion = coordinates_from_table(&model, &table, &shown, &mut self.findings).unwrap();
        Source::coordinates(model, motion)
    }

    fn table(&self, name: &str) -> Table {
        let (table, remarks) = Table::read_storage(&self.bytes(name)).unwrap();
        assert!(remarks.is_empty(), "{name}: {remarks:?}");
        table
    }

    fn forces(&self, name: &str, feet: Option<[(&str, &str); 2]>) -> MeasuredForces {
        let force = |(side, (body, prefix)): (&str, (&str, &str))| ExternalForce::with_prefix(side, body, prefix);
        let loads = feet.map(|feet| ExternalLoads {
            name: "feet".into(),
            datafile: None,
            forces: ["right", "left"].into_iter().zip(feet).map(force).collect(),
        });
        MeasuredForces::Table(ForceTable { table: self.table(name), loads })
    }

    fn laboratory_file(&self, name: &str, findings: &mut Findings) -> LaboratoryFile {
        let read = if name.ends_with("c3d") { LaboratoryFile::from_c3d } else { LaboratoryFile::from_trc };
        read(&self.bytes(name), &self.shown(name), findings).unwrap()
    }

    fn markers(&mut self, trial: &str, standing: Option<&str>, body: impl FnOnce(&mut Reader) -> MarkerBody) -> Source {
        let mut findings = std::mem::take(&mut self.findings);
        let trial = self.laboratory_file(trial, &mut findings);
        let standing = standing.map(|name| {
            let read = |own: &mut Findings| Ok::<_, ()>(self.laboratory_file(name, own));
            Arc::new(StandingTrial::new(study::standing_trial(&mut findings, read).unwrap()))
        });
        self.findings = findings;
        let body = body(self);
        Source::markers(MarkerSource { trial, standing, body, plates: Vec::new() })
    }
}

fn built_in(mass_kg: Option<f64>, height_m: Option<f64>) -> MarkerBody {
    MarkerBody::BuiltIn { table: SegmentTable::DeLevaMale, mass_kg, height_m, set: None }
}

/// An input without file names.
fn unnamed() -> Input {
    Input {
        motion: String::new(),
        person: None,
        recorded_on: None,
        model: String::new(),
        standing: None,
        ground: None,
        loads: None,
        device: None,
        added_mass: Vec::new(),
        ground_source: GroundSource::None,
    }
}

/// The files of the library: name and bytes.
fn library_files(source: &Source, settings: &Settings, mut findings: Findings) -> (BTreeMap<String, Vec<u8>>, Value) {
    let outcome = study::run(source.clone(), settings, &mut findings).unwrap();
    let (clinical, convention) = clinical_file(&outcome, Convention::default());
    let files = outcome_tables(&outcome, &Keep::all())
        .unwrap()
        .into_iter()
        .chain(outcome_figures(&outcome, Convention::default()).unwrap())
        .chain([clinical]);
    let mut files: BTreeMap<String, Vec<u8>> = files.map(|file| (file.name.clone(), file.bytes().unwrap())).collect();
    files.insert("subject.osim".to_owned(), to_osim(&outcome.body).unwrap().write().unwrap());
    let summary = Summary { convention: Some(convention), ..outcome_summary(&outcome, unnamed(), &findings) };
    (files, serde_json::to_value(&summary).unwrap())
}

/// Runs the command with the arguments and compares its folder with the files of the library.
fn assert_same(bench: &Workbench, args: &[&str], source: &Source, settings: &Settings, findings: Findings) {
    let run = bench.run(&[&["forces"], args, &["-o", "out", "--quiet"]].concat());
    assert!(matches!(run.code, Some(0 | 1)), "{}", run.stderr);
    let (files, summary) = library_files(source, settings, findings);
    for (name, bytes) in &files {
        assert!(bench.read(&format!("out/{name}")) == *bytes, "{name} differs");
    }
    for name in written(&bench.folder.join("out")) {
        let of_the_command = matches!(name.as_str(), "summary.json" | "report.html");
        assert!(of_the_command || files.contains_key(&name), "the library does not make {name}");
    }
    let without_names_and_times = |mut summary: Value| {
        let object = summary.as_object_mut().unwrap();
        for of_the_command in ["timing_ms", "run_id", "files"] {
            object.remove(of_the_command).unwrap();
        }
        object.remove("input").unwrap();
        serde_json::to_string_pretty(&summary).unwrap()
    };
    let (command, library) = (bench.json("out/summary.json"), summary);
    assert_eq!(without_names_and_times(command), without_names_and_times(library));
}

/// Names of all files below a folder.
fn written(folder: &Path) -> Vec<String> {
    let mut names = Vec::new();
    for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
        let name = entry.file_name().into_string().unwrap();
        match entry.path().is_dir() {
            true => names.extend(written(&entry.path()).into_iter().map(|inner| format!("{name}/{inner}"))),
            false => names.push(name),
        }
    }
    names
}

fn predicting() -> Settings {
    Settings { ground: GroundSettings::Predicted, ..Settings::default() }
}

/// Coordinates of gait2392, with force columns named on the command line.
fn gait2392(name: &str, more: &[&str], settings: &Settings) {
    let Some(data) = shared_data::data() else { return };
    let mut reader = Reader::of(data.join("opensim-gait2392-subject01"));
    let (model, motion, grf) =
        ("subject01_simbody.osim", "subject01_walk1_ik.mot", "core-id-test/subject01_walk1_grf.mot");
    let source = reader.coordinates(model, motion);
    let feet = [("calcn_r", "ground_force_"), ("calcn_l", "l_ground_force_")];
    let source = source.with_forces(reader.forces(grf, Some(feet)));
    let [motion, model, grf] = [motion, model, grf].map(|name| reader.shown(name));
    let columns = ["--right", "calcn_r:ground_force_", "--left", "calcn_l:l_ground_force_"];
    let args = [&[motion.as_str(), "--model", &model, "--grf", &grf], &columns[..], more].concat();
    assert_same(&Workbench::empty(name), &args, &source, settings, reader.findings);
}

#[test]
fn coordinates_with_plates() {
    gait2392("one_road_gait2392", &[], &Settings::default());
}

#[test]
fn coordinates_with_a_prediction_and_plates() {
    gait2392("one_road_gait2392_predict", &["--predict"], &predicting());
}

#[test]
fn markers_with_a_standing_trial_and_plates() {
    let Some(data) = shared_data::data() else { return };
    let mut reader = Reader::of(data.join("biomechzoo-HC032A"));
    let source = reader.markers("HC032A03.c3d", Some("HC032A01.c3d"), |_| built_in(None, None));
    let [walk, still] = ["HC032A03.c3d", "HC032A01.c3d"].map(|name| reader.shown(name));
    let bench = Workbench::empty("one_road_hc032a03");
    assert_same(&bench, &[&walk, "--static", &still], &source, &Settings::default(), reader.findings);
}

#[test]
fn a_turn_with_a_prediction_and_plates() {
    let Some(data) = shared_data::data() else { return };
    let mut reader = Reader::of(data.join("biomechzoo-HC002D"));
    let source = reader.markers("HC002D25.c3d", Some("HC002D02.c3d"), |_| built_in(Some(32.1), Some(1.45)));
    let [walk, still] = ["HC002D25.c3d", "HC002D02.c3d"].map(|name| reader.shown(name));
    let args = [&walk, "--static", &still, "--mass", "32.1", "--height", "1.45", "--predict"];
    assert_same(&Workbench::empty("one_road_hc002d25"), &args, &source, &predicting(), reader.findings);
}

#[test]
fn markers_on_a_model_with_a_table_of_forces() {
    let Some(data) = shared_data::data() else { return };
    let mut reader = Reader::of(data.join("opensim-rajagopal-walk"));
    let (model, walk, grf) = ("subject_walk_scaled.osim", "markers_walk.trc", "grf_walk.mot");
    let source = reader.markers(walk, None, |reader| MarkerBody::Model {
        model: reader.model(model),
        mass_kg: None,
        protocol: None,
    });
    let source = source.with_forces(reader.forces(grf, None));
    let [walk, model, grf] = [walk, model, grf].map(|name| reader.shown(name));
    let bench = Workbench::empty("one_road_rajagopal");
    let args = [&walk, "--model", &model, "--grf", &grf];
    assert_same(&bench, &args.map(|arg| arg as &str), &source, &Settings::default(), reader.findings);
}

#[test]
fn a_run_on_a_treadmill_with_a_prediction() {
    let Some(data) = shared_data::data() else { return };
    let mut reader = Reader::of(data.join("opensim-rajagopal-run"));
    let (run, still, grf) = ("motion_capture_run.trc", "static_run.trc", "grf_run.mot");
    let source = reader.markers(run, Some(still), |_| built_in(Some(72.84), Some(1.8)));
    let source = source.with_forces(reader.forces(grf, None));
    let [run, still, grf] = [run, still, grf].map(|name| reader.shown(name));
    let args = [&run, "--static", &still, "--mass", "72.84", "--height", "1.8", "--grf", &grf, "--predict"];
    assert_same(&Workbench::empty("one_road_treadmill"), &args, &source, &predicting(), reader.findings);
}

#[test]
fn a_skeleton() {
    let Some(data) = shared_data::data() else { return };
    let mut reader = Reader::of(data.join("bvh"));
    let shown = reader.shown("01_01.bvh");
    let (bvh, remarks) = Bvh::read(&reader.bytes("01_01.bvh")).unwrap();
    assert!(remarks.is_empty(), "{remarks:?}");
    let skeleton = skeleton_from_bvh(&bvh, &shown, Some(1.75), &mut reader.findings).unwrap();
    let source = Source::new(Recording::Skeleton { skeleton, table: SegmentTable::DeLevaMale, mass_kg: 75.0 });
    let args = [shown.as_str(), "--mass", "75", "--height", "1.75"];
    assert_same(&Workbench::empty("one_road_bvh"), &args, &source, &Settings::default(), reader.findings);
}

#[test]
fn the_recording_of_the_demo() {
    let bench = Workbench::empty("one_road_demo");
    bench.run(&["demo", "-o", "demo", "--quiet"]).done();
    let mut reader = Reader::of(bench.folder.join("demo/input"));
    let source = reader.markers("walk.c3d", Some("standing.c3d"), |_| built_in(Some(75.0), Some(1.75)));
    let [walk, still] = ["walk.c3d", "standing.c3d"].map(|name| reader.shown(name));
    let args = [&walk, "--static", &still, "--mass", "75", "--height", "1.75"];
    assert_same(&bench, &args, &source, &Settings::default(), reader.findings);
}
