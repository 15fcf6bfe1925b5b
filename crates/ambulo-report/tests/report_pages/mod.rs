//! Result folders in memory, and readers for the data and numbers of their page.

use ambulo::findings::Findings;
use ambulo::model::Model;
use ambulo::motion::{Smoother, coordinates_from_table, force_recordings};
use ambulo::study::{self, ForceFilter, GroundSettings, MeasuredForces, Settings, Source};
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_formats::table::Table;
use ambulo_report::outcome_figures;
use ambulo_report::page::report_page;
use ambulo_results::{Convention, GroundSource, Input, Keep, outcome_summary, outcome_tables};
use ambulo_results::{Folder, ResultsError};
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
    folder_of(body, motion, ground, loads, GroundSettings::MeasuredOrPredicted)
}

/// The folder that `ambulo forces --predict` writes of the invented recording.
pub(crate) fn predicted() -> Files {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../ambulo-cli/tests/recording");
    let read = |name: &str| std::fs::read(folder.join(name)).unwrap();
    let loads = ExternalLoads::read(&read("walk_grf.xml")).unwrap().0;
    folder_of(&read("figure.osim"), &read("walk.mot"), &read("walk_grf.mot"), &loads, GroundSettings::Predicted)
}

fn folder_of(body: &[u8], motion: &[u8], ground: &[u8], loads: &ExternalLoads, forces: GroundSettings) -> Files {
    let mut findings = Findings::default();
    let model = Model::from_osim(body, &mut findings).unwrap();
    let motion = Table::read_storage(motion).unwrap().0;
    let motion = coordinates_from_table(&model, &motion, "walk.mot", &mut findings).unwrap();
    let ground = Table::read_storage(ground).unwrap().0;
    let plates = force_recordings(&model, loads, &ground, &mut findings).unwrap();
    let source = Source::coordinates(model, motion).with_forces(MeasuredForces::OnBodies(plates));
    let settings = Settings {
        smoother: Smoother::Off,
        force_filter: ForceFilter::Off,
        comparison_filter: None,
        ground: forces,
        ..Settings::default()
    };
    let outcome = study::run(source, &settings, &mut findings).unwrap();
    let input = Input {
        motion: "recordings/walk.mot".to_owned(),
        person: None,
        recorded_on: None,
        model: "recordings/figure.osim".to_owned(),
        standing: None,
        ground: Some("walk_grf.mot".to_owned()),
        loads: None,
        device: None,
        added_mass: Vec::new(),
        ground_source: GroundSource::None,
    };
    let summary = outcome_summary(&outcome, input, &findings);
    let tables = outcome_tables(&outcome, &Keep::all()).unwrap();
    let figures = outcome_figures(&outcome, Convention::Opensim).unwrap();
    let mut files: Files =
        tables.into_iter().chain(figures).map(|file| (file.name.clone(), file.bytes().unwrap())).collect();
    files.insert("subject.osim".to_owned(), body.to_vec());
    files.insert("summary.json".to_owned(), serde_json::to_vec(&summary).unwrap());
    files
}

/// Changes the summary.
pub(crate) fn with_summary(files: &mut Files, change: impl FnOnce(&mut Value)) {
    let mut summary: Value = serde_json::from_slice(&files["summary.json"]).unwrap();
    change(&mut summary);
    files.insert("summary.json".to_owned(), serde_json::to_vec(&summary).unwrap());
}

/// Keeps the header and the selected lines of a file.
pub(crate) fn keep_lines(files: &mut Files, name: &str, keep: impl Fn(&str) -> bool) {
    let text = String::from_utf8(files[name].clone()).unwrap();
    let kept = text.lines().enumerate().filter(|(i, line)| *i == 0 || keep(line)).map(|(_, line)| format!("{line}\n"));
    files.insert(name.to_owned(), kept.collect::<String>().into_bytes());
}

/// The page of one folder.
pub(crate) fn page_of(name: &str, files: &Files) -> Result<String, ResultsError> {
    let file = |name: &str| files.get(name).cloned();
    report_page(&[Folder::of_files(name, &file)])
}

/// What a page shows.
pub(crate) struct Shown {
    pub(crate) page: Value,
    numbers: Vec<u16>,
}

impl Shown {
    /// Makes the page of the folder.
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

    /// How many rows of tables with `rows` rows belong to each drawn instant.
    pub(crate) fn rows_per_instant(&self, rows: usize) -> usize {
        rows.div_ceil(self.session()["time"]["frames"].as_u64().unwrap() as usize)
    }

    /// All panels, including those of quality.
    pub(crate) fn panels(&self) -> Vec<&Value> {
        let session = self.session();
        let groups = [&session["groups"], &session["quality"]["groups"]];
        let groups = groups.into_iter().flat_map(|groups| groups.as_array().unwrap());
        groups.flat_map(|group| group["panels"].as_array().unwrap()).collect()
    }

    /// A panel by its id.
    #[track_caller]
    pub(crate) fn panel(&self, id: &str) -> &Value {
        self.panels().into_iter().find(|panel| panel["id"] == id).unwrap_or_else(|| panic!("no panel {id}"))
    }

    /// The displayed cells of a row of a table.
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

    /// Whether one of the sentences on missing parts contains this.
    pub(crate) fn misses(&self, words: &str) -> bool {
        self.session()["missing"].as_array().unwrap().iter().any(|sentence| sentence.as_str().unwrap().contains(words))
    }

    /// The value of a line of the header.
    pub(crate) fn header(&self, label: &str) -> String {
        let lines = self.session()["header"].as_array().unwrap();
        let line = lines.iter().find(|line| line["label"] == label).unwrap();
        line["value"].as_str().unwrap().to_owned()
    }
}
