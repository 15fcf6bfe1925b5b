//! Result folders in memory, and what a page made of them shows: its data and its numbers.

#![allow(dead_code, reason = "each test file is a crate of its own and uses its own part")]
#![allow(clippy::unwrap_used, reason = "helpers of tests may unwrap as tests do")]

use ambulo::analysis::feasibility::{MotionAndForces, Person, Thresholds, check};
use ambulo::analysis::{AnalysisSettings, PredictionInput, analyse, analyse_predicted};
use ambulo::findings::Findings;
use ambulo::ground::predict::PredictSettings;
use ambulo::model::Model;
use ambulo::motion::{Smoother, Window, coordinates_from_table, force_recordings};
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_formats::table::Table;
use ambulo_report::figure_files;
use ambulo_report::page::report_page;
use ambulo_results::{Folder, ResultsError};
use ambulo_results::{GroundSource, Input, output_files, prediction_files, summary};
use base64::Engine;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

/// Files of a result folder by name.
pub(crate) type Files = BTreeMap<String, Vec<u8>>;

/// The folder that `ambulo forces` writes of the invented recording of two strides.
pub(crate) fn recorded() -> Files {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../ambulo-cli/tests/recording");
    let read = |name: &str| std::fs::read(folder.join(name)).unwrap();
    let loads = ExternalLoads::read(&read("walk_grf.xml")).unwrap().0;
    let body = read("figure.osim");
    analysed(&body, &read("walk.mot"), &read("walk_grf.mot"), &loads)
}

/// The folder of recorded coordinates with the forces of plates.
pub(crate) fn analysed(body: &[u8], motion: &[u8], ground: &[u8], loads: &ExternalLoads) -> Files {
    let mut findings = Findings::default();
    let model = Model::from_osim(body, &mut findings).unwrap();
    let motion = Table::read_storage(motion).unwrap().0;
    let motion = coordinates_from_table(&model, &motion, "walk.mot", &mut findings).unwrap();
    let ground = Table::read_storage(ground).unwrap().0;
    let plates = force_recordings(&model, loads, &ground, &mut findings).unwrap();
    let settings = AnalysisSettings {
        smoother: Smoother::Off,
        force_filter: None,
        window: Window::default(),
        rate_hz: None,
        instrumented: None,
    };
    let mut analysis = analyse(&model, &motion, &plates, settings, &mut findings).unwrap();
    let evidence = MotionAndForces {
        model: &model,
        trajectory: &analysis.trajectory,
        forces: &analysis.forces,
        ground: &analysis.ground,
        device: None,
    };
    let verdict = check(&evidence, &Person::of_model(&model), &Thresholds::default(), &mut findings);
    analysis.verdict = Some(verdict);
    let input = Input {
        motion: "recordings/walk.mot".to_owned(),
        model: "recordings/figure.osim".to_owned(),
        standing: None,
        ground: Some("walk_grf.mot".to_owned()),
        loads: None,
        device: None,
        added_mass: Vec::new(),
        ground_source: GroundSource::Measured,
    };
    let summary = summary(&model, &analysis, &settings, input, &findings);
    let files = output_files(&model, &analysis, None).unwrap();
    let figures = figure_files(&model, &analysis).unwrap();
    let mut files: Files = files.into_iter().chain(figures).map(|file| (file.name, file.bytes)).collect();
    files.insert("subject.osim".to_owned(), body.to_vec());
    files.insert("summary.json".to_owned(), serde_json::to_vec(&summary).unwrap());
    files
}

/// The folder that `ambulo forces --predict` writes of the invented recording.
pub(crate) fn predicted() -> Files {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../ambulo-cli/tests/recording");
    let read = |name: &str| std::fs::read(folder.join(name)).unwrap();
    let (mut files, mut findings) = (recorded(), Findings::default());
    let model = Model::from_osim(&read("figure.osim"), &mut findings).unwrap();
    let table = |name: &str| Table::read_storage(&read(name)).unwrap().0;
    let motion = coordinates_from_table(&model, &table("walk.mot"), "walk.mot", &mut findings).unwrap();
    let loads = ExternalLoads::read(&read("walk_grf.xml")).unwrap().0;
    let plates = force_recordings(&model, &loads, &table("walk_grf.mot"), &mut findings).unwrap();
    let settings = AnalysisSettings {
        smoother: Smoother::Off,
        force_filter: None,
        window: Window::default(),
        rate_hz: None,
        instrumented: None,
    };
    let person = Person::of_model(&model);
    let order = PredictionInput { soles: &person.soles, settings: &PredictSettings::default(), plates_filter: None };
    let predicted = analyse_predicted(&model, &motion, &plates, settings, &order, &mut findings).unwrap();
    let written = output_files(&model, &predicted.analysis, None).unwrap();
    let figures = figure_files(&model, &predicted.analysis).unwrap();
    let beside = prediction_files(&model, &predicted).unwrap();
    files.extend(written.into_iter().chain(figures).chain(beside).map(|file| (file.name, file.bytes)));
    with_summary(&mut files, |summary| {
        summary["ground"] = serde_json::json!({"source": "predicted", "rule": "lever rule", "threshold_n": 20.0});
        summary["mass_kg"] = serde_json::json!(predicted.analysis.mass.kg);
    });
    files
}

/// Changes the summary.
pub(crate) fn with_summary(files: &mut Files, change: impl FnOnce(&mut Value)) {
    let mut summary: Value = serde_json::from_slice(&files["summary.json"]).unwrap();
    change(&mut summary);
    files.insert("summary.json".to_owned(), serde_json::to_vec(&summary).unwrap());
}

/// Keeps the lines of a file that a test wants, and its head.
pub(crate) fn keep_lines(files: &mut Files, name: &str, keep: impl Fn(&str) -> bool) {
    let text = String::from_utf8(files[name].clone()).unwrap();
    let kept = text.lines().enumerate().filter(|(i, line)| *i == 0 || keep(line)).map(|(_, line)| format!("{line}\n"));
    files.insert(name.to_owned(), kept.collect::<String>().into_bytes());
}

/// The page of one folder.
pub(crate) fn page_of(name: &str, files: &Files) -> Result<String, ResultsError> {
    let file = |name: &str| files.get(name).cloned();
    report_page(&[Folder { name: name.to_owned(), file: &file }])
}

/// What a page shows.
pub(crate) struct Shown {
    pub(crate) page: Value,
    numbers: Vec<u16>,
}

impl Shown {
    /// Of the folder, which makes a page.
    #[track_caller]
    pub(crate) fn of(files: &Files) -> Shown {
        Shown::read(&page_of("folder", files).unwrap())
    }

    /// Reads a page as the viewer does.
    pub(crate) fn read(html: &str) -> Shown {
        let element = |id: &str| {
            let (_, after) = html.split_once(&format!("id=\"{id}\">")).unwrap();
            after.split_once("</script>").unwrap().0
        };
        let page = serde_json::from_str(element("ambulo-page")).unwrap();
        let bytes = base64::engine::general_purpose::STANDARD.decode(element("ambulo-numbers")).unwrap();
        let bytes = miniz_oxide::inflate::decompress_to_vec_zlib(&bytes).unwrap();
        let (low, high) = bytes.split_at(bytes.len() / 2);
        let mut last = 0_u16;
        let numbers = low.iter().zip(high).map(|(low, high)| {
            last = last.wrapping_add(u16::from_le_bytes([*low, *high]));
            last
        });
        let numbers = numbers.collect();
        Shown { page, numbers }
    }

    /// The only session.
    pub(crate) fn session(&self) -> &Value {
        &self.page["sessions"][0]
    }

    /// The numbers of a series.
    pub(crate) fn series(&self, series: &Value) -> Vec<f64> {
        let place = |key: &str| series[key].as_u64().unwrap() as usize;
        let (low, step) = (series["low"].as_f64().unwrap(), series["step"].as_f64().unwrap());
        let numbers = &self.numbers[place("at")..place("at") + place("count")];
        numbers.iter().map(|&q| if q == u16::MAX { f64::NAN } else { low + step * f64::from(q) }).collect()
    }

    /// All panels, those of quality too.
    pub(crate) fn panels(&self) -> Vec<&Value> {
        let session = self.session();
        let groups = [&session["groups"], &session["quality"]["groups"]];
        let groups = groups.into_iter().flat_map(|groups| groups.as_array().unwrap());
        groups.flat_map(|group| group["panels"].as_array().unwrap()).collect()
    }

    /// A panel by its word.
    #[track_caller]
    pub(crate) fn panel(&self, id: &str) -> &Value {
        self.panels().into_iter().find(|panel| panel["id"] == id).unwrap_or_else(|| panic!("no panel {id}"))
    }

    /// The cells of a table's row as shown.
    #[track_caller]
    pub(crate) fn row(&self, table: &str, name: &str) -> Vec<String> {
        let rows = self.rows(table).into_iter().find(|row| row[0]["text"] == name);
        let row = rows.unwrap_or_else(|| panic!("no row {name}"));
        row.iter().map(|cell| cell["text"].as_str().unwrap().to_owned()).collect()
    }

    /// The number behind a cell.
    #[track_caller]
    pub(crate) fn value(&self, table: &str, name: &str, column: usize) -> f64 {
        let row = self.rows(table).into_iter().find(|row| row[0]["text"] == name).unwrap();
        row[column]["value"].as_f64().unwrap_or_else(|| panic!("{name}: {:?}", row[column]))
    }

    /// Whether a cell is marked as outside of its range.
    #[track_caller]
    pub(crate) fn stands_out(&self, table: &str, name: &str, column: usize) -> bool {
        let row = self.rows(table).into_iter().find(|row| row[0]["text"] == name).unwrap();
        row[column]["outside"].as_bool().unwrap()
    }

    fn rows(&self, table: &str) -> Vec<&Vec<Value>> {
        let session = self.session();
        let tables = [&session["tables"], &session["quality"]["tables"]];
        let mut tables = tables.into_iter().flat_map(|tables| tables.as_array().unwrap());
        let table = tables.find(|known| known["id"] == table).unwrap();
        table["rows"].as_array().unwrap().iter().map(|row| row.as_array().unwrap()).collect()
    }

    /// Whether one of the sentences about what is missing says this.
    pub(crate) fn misses(&self, words: &str) -> bool {
        self.session()["missing"].as_array().unwrap().iter().any(|said| said.as_str().unwrap().contains(words))
    }

    /// The value of a line of the header.
    pub(crate) fn header(&self, label: &str) -> String {
        let lines = self.session()["header"].as_array().unwrap();
        let line = lines.iter().find(|line| line["label"] == label).unwrap();
        line["value"].as_str().unwrap().to_owned()
    }
}
