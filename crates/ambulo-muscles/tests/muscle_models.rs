//! Models with muscles of the shared recordings, and the tables that OpenSim 4.6 made for them.

use crate::shared_data;
use ambulo_body::findings::Findings;
use ambulo_body::kinematics::Posture;
use ambulo_body::model::Model;
use ambulo_formats::osim::OsimModel;
use ambulo_muscles::set::MuscleSet;
use std::collections::BTreeMap;
use std::path::Path;

/// Name in the tables, and file of the model.
pub(crate) const MODELS: [(&str, &str); 3] = [
    ("gait2392", "opensim-gait2392-subject01/subject01_simbody.osim"),
    ("gait10dof", "opensim-gait10dof-subject01/subject01.osim"),
    ("rajagopal", "opensim-rajagopal-walk/subject_walk_scaled.osim"),
];

/// A model with its muscles.
pub(crate) struct MuscleModel {
    pub(crate) document: OsimModel,
    pub(crate) model: Model,
    pub(crate) set: MuscleSet,
    pub(crate) findings: Findings,
}

/// Reads a document.
pub(crate) fn read(bytes: &[u8]) -> MuscleModel {
    let document = OsimModel::read(bytes).unwrap();
    let mut findings = Findings::default();
    let model = ambulo_body::model::from_osim(&document, &mut Findings::default()).unwrap();
    let set = MuscleSet::of_document(&document, &model, &mut findings).unwrap();
    MuscleModel { document, model, set, findings }
}

/// The model with this name; `None` without the shared recordings.
pub(crate) fn load(name: &str) -> Option<MuscleModel> {
    let others = [
        ("arm26", "muscles/opensim46/models/arm26.osim"),
        ("ceinms", "muscles/B-ceinms-lowerlimb/gait2392.osim"),
        ("stanford", "muscles/A-stanford-matlabso/Rajagopal_scaled_Sub1_gasAvoid.osim"),
        ("opencap", "opencap-adult-83kg/LaiArnoldModified2017_poly_withArms_weldHand_scaled.osim"),
    ];
    let file = MODELS.into_iter().chain(others).find(|(known, _)| *known == name).unwrap().1;
    Some(read(&std::fs::read(shared_data::data()?.join(file)).unwrap()))
}

/// A table of OpenSim: columns by name.
pub(crate) struct Table {
    columns: BTreeMap<String, usize>,
    pub(crate) header: Vec<String>,
    pub(crate) rows: Vec<Vec<String>>,
}

impl Table {
    /// A file of `muscles/opensim46`.
    pub(crate) fn read(file: &str) -> Option<Table> {
        let path = shared_data::data()?.join("muscles/opensim46").join(file);
        Some(Table::of(&path))
    }

    fn of(path: &Path) -> Table {
        let text = std::fs::read_to_string(path).unwrap();
        let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
        let header = lines.next().unwrap();
        let columns = header.iter().enumerate().map(|(i, name)| (name.clone(), i)).collect();
        Table { columns, header, rows: lines.collect() }
    }

    pub(crate) fn text<'a>(&'a self, row: &'a [String], column: &str) -> &'a str {
        &row[self.columns[column]]
    }

    pub(crate) fn number(&self, row: &[String], column: &str) -> f64 {
        self.text(row, column).parse().unwrap()
    }
}

/// Coordinates with rates of one posture.
#[derive(Clone)]
pub(crate) struct State {
    pub(crate) q: Vec<f64>,
    pub(crate) qd: Vec<f64>,
    pub(crate) rest: Vec<f64>,
}

impl State {
    pub(crate) fn new(q: Vec<f64>, qd: Vec<f64>) -> State {
        let rest = vec![0.0; q.len()];
        State { q, qd, rest }
    }

    pub(crate) fn posture(&self) -> Posture<'_> {
        Posture { q: &self.q, qd: &self.qd, qdd: &self.rest }
    }
}

/// The postures of a model, with their kind.
pub(crate) fn postures(name: &str, model: &Model) -> Option<Vec<(String, State)>> {
    let table = Table::read(&format!("postures_{name}.csv"))?;
    let values = |row: &[String], prefix: &str| -> Vec<f64> {
        model.coordinates().iter().map(|c| table.number(row, &format!("{prefix}:{}", c.name))).collect()
    };
    let state =
        |row: &Vec<String>| (table.text(row, "kind").to_owned(), State::new(values(row, "q"), values(row, "u")));
    Some(table.rows.iter().map(state).collect())
}

/// Random numbers in 0 to 1, from a seed (splitmix64).
pub(crate) fn random(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15).wrapping_add(1);
    move || {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}
