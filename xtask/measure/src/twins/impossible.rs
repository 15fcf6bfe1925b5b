//! Twins of recordings that no person could make.
//!
//! A recording is analysed, and its coordinates and ground forces are then changed:
//!
//! | twin        | change                                                                                            |
//! |-------------|---------------------------------------------------------------------------------------------------|
//! | `fast`      | the clock of motion and forces runs 1.5 times as fast; not of people who stand, who may do so     |
//! | `lifted`    | the body is 0.3 m higher, the forces stay                                                         |
//! | `wrong foot`| the force of each foot acts on the other one                                                      |
//! | `torque`    | a device works against both knees with 5 N.m/kg, more than twice what a knee can supply           |
//!
//! Every recording should be feasible or not judged, every twin infeasible. Only recordings that are called feasible
//! have twins; those that are refused or not judged are listed.

use crate::validate::recording::{Recording, all};
use ambulo::analysis::activity::ActivityKind;
use ambulo::analysis::feasibility::{Reason, Verdict, VerdictState};
use ambulo::findings::Findings;
use ambulo::ground::GroundForces;
use ambulo::job::{FileError, Job};
use ambulo::model::{Displacement, JointAxis, Movement, Side};
use ambulo::motion::{ForceRecording, Motion};
use ambulo::spatial::Vec3;
use ambulo::study::validation::TextTable;
use ambulo::study::{self, ForceFilter, MeasuredForces, Outcome, Settings, Source};
use ambulo_formats::table::Table;
use std::fs;
use std::path::Path;

/// A recording that is this much too fast [1].
const FASTER: f64 = 1.5;
/// Height of the lifted body above its place [m].
const LIFT_M: f64 = 0.3;
/// Moment of a device against the knee [N.m/kg].
const AGAINST_KNEE_NM_KG: f64 = 5.0;

/// The impossible change of a twin; see the table above.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Change {
    Fast,
    Lifted,
    WrongFoot,
    Torque,
}

impl Change {
    const ALL: [Change; 4] = [Change::Fast, Change::Lifted, Change::WrongFoot, Change::Torque];

    fn name(self) -> &'static str {
        match self {
            Change::Fast => "fast",
            Change::Lifted => "lifted",
            Change::WrongFoot => "wrong foot",
            Change::Torque => "torque",
        }
    }
}

/// A recording with its name; an error if it cannot be read.
type Named = (String, Result<Source, String>);

/// What was found.
pub(super) struct Impossible {
    /// Recordings and twins that are not judged as they should be, a line each.
    pub(super) remarks: Vec<String>,
    /// How many recordings were judged how, in a sentence.
    pub(super) recordings: String,
    pub(super) table: TextTable,
}

/// Judges all recordings whose name contains a text, and their twins.
pub(super) fn judged(data: &Path, only: &str) -> Result<Impossible, String> {
    let mut counts = [[0; 2]; Change::ALL.len()];
    let (mut feasible, mut infeasible, mut others) = (0, 0, 0);
    let mut remarks = Vec::new();
    for (name, source) in sources(data)?.into_iter().filter(|(name, _)| name.contains(only)) {
        let outcome = match source.and_then(|source| analysed(&source, &Settings::default())) {
            Ok(outcome) => outcome,
            Err(why) => {
                others += 1;
                remarks.push(format!("{name}: refused: {why}"));
                continue;
            }
        };
        match outcome.verdict.state {
            VerdictState::Feasible => feasible += 1,
            VerdictState::Infeasible => {
                infeasible += 1;
                remarks.push(format!("{name}: infeasible, falsely: {}", reasons(&outcome.verdict)));
                continue;
            }
            VerdictState::NotJudged => {
                others += 1;
                remarks.push(format!("{name}: not judged: {}", outcome.verdict.undecided.join("; ")));
                continue;
            }
        }
        for (change, count) in Change::ALL.into_iter().zip(&mut counts) {
            if change == Change::Fast && outcome.activity.kind == ActivityKind::Stand {
                continue;
            }
            let verdict = twin(&outcome, change)?;
            let is_found = verdict.state == VerdictState::Infeasible;
            count[0] += usize::from(is_found);
            count[1] += 1;
            if !is_found {
                remarks.push(format!(
                    "{name}, {}: {}, {}",
                    change.name(),
                    verdict.state.words(),
                    verdict.undecided.join("; ")
                ));
            }
        }
    }
    let recordings = format!(
        "{feasible} recordings of people are feasible, {infeasible} infeasible, {others} refused or not judged."
    );
    let mut table = TextTable::new(&["twin", "infeasible", "of"]);
    for (change, [found, made]) in Change::ALL.into_iter().zip(counts) {
        table.row([change.name().to_owned(), found.to_string(), made.to_string()]);
    }
    Ok(Impossible { remarks, recordings, table })
}

fn analysed(source: &Source, settings: &Settings) -> Result<Outcome, String> {
    study::run(source.clone(), settings, &mut Findings::default()).map_err(|e| e.to_string())
}

fn reasons(verdict: &Verdict) -> String {
    verdict.reasons.iter().map(|reason: &Reason| reason.message.as_str()).collect::<Vec<_>>().join("; ")
}

/// The recordings of the validation, and every C3D file of one trial with force plates.
fn sources(data: &Path) -> Result<Vec<Named>, String> {
    let validated = all().into_iter().map(|recording: Recording| (recording.label.to_owned(), recording.read(data)));
    let mut list: Vec<_> = validated.collect();
    let is_of_people =
        |name: &str| ["biomechzoo-", "btkdata-", "motonms-", "opensim-core-"].iter().any(|n| name.starts_with(n));
    for folder in entries(data)?.into_iter().filter(|folder| is_of_people(&file_name(folder))) {
        for file in entries(&folder)?.into_iter().filter(|file| file.extension().is_some_and(|e| e == "c3d")) {
            list.push((file_name(&file), trial(&file)));
        }
    }
    Ok(list)
}

fn file_name(path: &Path) -> String {
    path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
}

fn entries(folder: &Path) -> Result<Vec<std::path::PathBuf>, String> {
    let read = fs::read_dir(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let mut list: Vec<_> = read.filter_map(|entry| Some(entry.ok()?.path())).collect();
    list.sort();
    Ok(list)
}

/// A file on the built-in body, weighed by its own plates.
fn trial(path: &Path) -> Result<Source, String> {
    let mut files = |path: &Path| fs::read(path).map_err(FileError::from);
    Ok(Job::of(path).read(&mut files, &mut Findings::default()).map_err(|error| error.text())?.source)
}

/// The verdict on a twin. Motion and forces are filtered already, and are filtered once more as those of a recording
/// are.
fn twin(outcome: &Outcome, change: Change) -> Result<Verdict, String> {
    let model = &outcome.body;
    let trajectory = &outcome.analysis.trajectory;
    let clock = if change == Change::Fast { FASTER } else { 1.0 };
    let times: Vec<f64> = trajectory.grid().times().iter().map(|time| time / clock).collect();
    let mut columns: Vec<Vec<f64>> = model.coordinate_ids().map(|id| trajectory.values(id).to_vec()).collect();
    if change == Change::Lifted {
        let id = vertical(outcome).ok_or("the root has no vertical translation")?;
        columns[id].iter_mut().for_each(|height| *height += LIFT_M);
    }
    let mut loads = loads(&outcome.analysis.ground, &times);
    if change == Change::WrongFoot {
        let feet = model.anatomy().feet().ok_or("the body has no feet")?;
        for load in &mut loads {
            load.body = if load.body == feet.right { feet.left } else { feet.right };
        }
    }
    let columns = columns.into_iter().map(Some).collect();
    let motion = Motion { origin: format!("twin, {}", change.name()), times: times.clone(), columns };
    let mut source = Source::coordinates(model.clone(), motion).with_forces(MeasuredForces::OnBodies(loads));
    if change == Change::Torque {
        source.device = Some(device(outcome, times)?);
    }
    let settings = Settings { force_filter: ForceFilter::Off, ..Settings::default() };
    Ok(analysed(&source, &settings)?.verdict)
}

/// The coordinate that moves the root along the vertical.
fn vertical(outcome: &Outcome) -> Option<usize> {
    let model = &outcome.body;
    let joint = &model.bodies().iter().find(|body| body.joint.parent.is_none())?.joint;
    let upward_part = |axis: &&JointAxis| (joint.parent_from_joint.rotation * axis.direction).dot(&model.up()).abs();
    let axis = joint.translations.iter().max_by(|a, b| upward_part(a).total_cmp(&upward_part(b)))?;
    match &axis.displacement {
        Displacement::Follows(id, _) => Some(id.index()),
        Displacement::Fixed(_) => None,
    }
}

/// The ground forces as loads on the same bodies.
fn loads(ground: &GroundForces, times: &[f64]) -> Vec<ForceRecording> {
    let load = |(number, foot): (usize, &ambulo::ground::BodyForces)| ForceRecording {
        name: format!("foot {number}"),
        body: foot.body,
        force_frame: None,
        point_frame: None,
        times: times.to_vec(),
        force: foot.force.clone(),
        point: vec![Vec3::zeros(); times.len()],
        moment: foot.moment.clone(),
    };
    ground.bodies.iter().enumerate().map(load).collect()
}

/// A constant moment that flexes both knees.
fn device(outcome: &Outcome, times: Vec<f64>) -> Result<Table, String> {
    let moment_nm = AGAINST_KNEE_NM_KG * outcome.body.mass();
    let count = times.len();
    let mut columns = vec![("time".to_owned(), times)];
    for side in Side::BOTH {
        let (id, sign) =
            outcome.body.anatomy().coordinate(Movement::KneeFlexion, Some(side)).ok_or("the body has no knees")?;
        let name = format!("{}_moment", outcome.body.coordinates()[id.index()].name);
        columns.push((name, vec![sign * moment_nm; count]));
    }
    Table::new("device", columns).map_err(|e| e.to_string())
}
