//! Positive work of the legs in predicted walks and in ten adults, whose forces come from their motion alone.

use crate::shared_data::data;
use ambulo::findings::Findings;
use ambulo::gait::{Gait, Walk};
use ambulo::job::{FileError, Job};
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::model::full_body::full_body;
use ambulo::model::{Model, Movement, Side};
use ambulo::optimal::{OptimalWalk, WalkConditions};
use ambulo::study::Outcome;
use std::fs;
use std::path::{Path, PathBuf};

const MAN: Build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };
/// Speed of the comparison [m/s], near the mean of the people.
const SPEED: f64 = 1.1;
const MOVEMENTS: [Movement; 4] =
    [Movement::HipFlexion, Movement::HipAdduction, Movement::KneeFlexion, Movement::AnkleDorsiflexion];

/// Walks of the ten adults at the speed that they chose, with their standing trials.
fn own_speed(data: &Path) -> Vec<(PathBuf, PathBuf)> {
    let files = |folder: &Path| -> Vec<PathBuf> { fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect() };
    let persons = files(&data.join("adults-rehazenter")).into_iter().filter(|person| person.is_dir());
    let of_kind = |person: &Path, kind: &str| {
        let found = files(person).into_iter().find(|path| path.to_string_lossy().contains(kind));
        found.unwrap()
    };
    let mut walks: Vec<(PathBuf, PathBuf)> =
        persons.map(|person| (of_kind(&person, "_C4_"), of_kind(&person, "_ST."))).collect();
    walks.sort();
    walks
}

fn forces(trial: PathBuf, standing: PathBuf) -> Outcome {
    let job = Job { standing: Some(standing), ..Job::of(trial) };
    let findings = &mut Findings::default();
    let read = job.read(&mut |path: &Path| fs::read(path).map_err(FileError::from), findings).unwrap();
    read.run(findings).unwrap()
}

/// Positive work of hip, knee and ankle in a cycle of one leg [J/kg]: the mean of the cycles between two strikes of a
/// foot in a recording.
fn work_of_person(outcome: &Outcome) -> f64 {
    let (model, analysis): (&Model, _) = (&outcome.body, outcome.complete());
    let grid = analysis.trajectory.grid();
    let mut cycles = Vec::new();
    for side in Side::BOTH {
        let strikes: Vec<f64> = outcome.stances.iter().filter(|s| s.side == side).map(|s| s.start_s).collect();
        for pair in strikes.windows(2).filter(|pair| pair[0] > grid.start_s + grid.step_s) {
            let frames = [pair[0], pair[1]].map(|time_s| ((time_s - grid.start_s) / grid.step_s).round() as usize);
            let joints = MOVEMENTS.map(|movement| model.anatomy().coordinate(movement, Some(side)).unwrap().0);
            let power = |frame: usize| {
                let of = joints.map(|id| {
                    (analysis.forces.generalized[id.index()][frame] * analysis.trajectory.rates(id)[frame]).max(0.0)
                });
                of.iter().sum::<f64>()
            };
            let sum: f64 = (frames[0]..frames[1].min(grid.frames)).map(power).sum();
            cycles.push(sum * grid.step_s / analysis.mass.kg);
        }
    }
    assert!(!cycles.is_empty(), "{:?}", outcome.stances);
    cycles.iter().sum::<f64>() / cycles.len() as f64
}

/// The same of a predicted walk at a speed [m/s].
fn work_of_prediction(speed: f64) -> f64 {
    let leg_length = full_body(&MAN).unwrap().dimensions.leg_length;
    let mut gait = Gait::named("free").unwrap();
    gait.pace = gait.pace.with(Some(speed), None, None);
    let walk = Walk::new(&gait, leg_length, &mut Findings::default()).unwrap();
    let found = OptimalWalk::predict(&MAN, &walk, &WalkConditions::default()).unwrap();
    const STEPS: usize = 400;
    let times: Vec<f64> = (0..STEPS).map(|k| walk.cycle_s() * k as f64 / STEPS as f64).collect();
    let anatomy = found.human.model.anatomy();
    let joints = MOVEMENTS.map(|movement| anatomy.coordinate(movement, Some(Side::Right)).unwrap().0.index());
    let samples = found.solution.samples(&times).unwrap();
    let power = samples.iter().flat_map(|s| joints.map(|c| (s.forces[c] * s.posture[1][c]).max(0.0)));
    power.sum::<f64>() * walk.cycle_s() / STEPS as f64 / MAN.mass
}

/// The value at a place of the straight line through points.
fn on_line(points: &[(f64, f64)], place: f64) -> f64 {
    let count = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / count;
    let [x, y] = [mean(|p| p.0), mean(|p| p.1)];
    let [xy, xx] = points.iter().fold([0.0; 2], |[xy, xx], p| [xy + (p.0 - x) * (p.1 - y), xx + (p.0 - x).powi(2)]);
    y + xy / xx * (place - x)
}

#[test]
fn legs_of_a_predicted_walk_work_as_much_as_those_of_people() {
    let Some(data) = data() else { return };
    let walks = own_speed(&data);
    assert_eq!(walks.len(), 10);
    let points: Vec<(f64, f64)> = walks
        .into_iter()
        .map(|(trial, standing)| {
            let outcome = forces(trial, standing);
            let point = (outcome.complete().speed_m_s.unwrap(), work_of_person(&outcome));
            println!("a person at {:.2} m/s: {:.3} J/kg", point.0, point.1);
            point
        })
        .collect();
    let [people, predicted] = [on_line(&points, SPEED), work_of_prediction(SPEED)];
    println!(
        "at {SPEED} m/s: {people:.3} J/kg of people, {predicted:.3} predicted, {:+.0} %",
        100.0 * (predicted / people - 1.0)
    );
    assert!((predicted / people - 1.0).abs() < 0.25, "{predicted} and {people} J/kg");
}
