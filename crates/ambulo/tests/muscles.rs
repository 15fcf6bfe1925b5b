//! Muscle forces of recordings with the built-in body: who carries the moment of the subtalar joint, and how far apart
//! the condyles are.

use crate::shared_data::data;
use ambulo::analysis::feasibility::{Likeness, likeness};
use ambulo::findings::Findings;
use ambulo::job::{FileError, Job, MuscleStatements};
use ambulo::muscles::emg::compare;
use ambulo::muscles::set::MuscleSet;
use ambulo::muscles::settings::MuscleSettings;
use ambulo::muscles::trial::solve_trial;
use ambulo::study::{MuscleOutcome, Outcome};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The outcome of a trial with muscles.
fn run(trial: PathBuf, standing: Option<PathBuf>, condyles_m: Option<f64>) -> Outcome {
    let muscles = Some(MuscleStatements { condyles_m, ..MuscleStatements::default() });
    let job = Job { standing, muscles, ..Job::of(trial) };
    let findings = &mut Findings::default();
    let read = job.read(&mut |path: &Path| fs::read(path).map_err(FileError::from), findings).unwrap();
    read.run(findings).unwrap()
}

fn muscles(outcome: &Outcome) -> &MuscleOutcome {
    outcome.muscles.as_ref().unwrap()
}

/// The walks of a folder with their standing trials.
fn walks_of_rehazenter(data: &Path) -> Vec<(PathBuf, PathBuf)> {
    let persons = fs::read_dir(data.join("adults-rehazenter")).unwrap().map(|entry| entry.unwrap().path());
    let mut walks: Vec<(PathBuf, PathBuf)> = persons
        .filter(|person| person.is_dir())
        .flat_map(|person| {
            let files: Vec<PathBuf> = fs::read_dir(&person).unwrap().map(|entry| entry.unwrap().path()).collect();
            let name = |path: &Path| path.file_stem().unwrap().to_str().unwrap().to_owned();
            let standing = files.iter().find(|path| name(path).ends_with("_ST")).unwrap().clone();
            let walks = files.into_iter().filter(|path| !name(path).ends_with("_ST"));
            walks.map(|walk| (walk, standing.clone())).collect::<Vec<_>>()
        })
        .collect();
    walks.sort();
    walks
}

/// Correlation of each muscle with its EMG, and the largest share of a reserve at a subtalar joint.
type Found = (BTreeMap<String, Vec<f64>>, usize);

/// Adds the correlations of a trial that was solved with this set.
fn add(found: &mut Found, outcome: &Outcome, set: &MuscleSet) {
    let (analysis, envelopes) = (outcome.complete(), &muscles(outcome).emg.as_ref().unwrap().envelopes);
    let forces = &analysis.forces.generalized;
    let settings = MuscleSettings::default();
    let trial = solve_trial(&outcome.body, set, &settings, &analysis.trajectory, forces).unwrap();
    let named = set.muscles.iter().zip(&trial.muscles);
    let activations: Vec<(&str, &[f64])> =
        named.map(|(muscle, series)| (muscle.name.as_str(), series.activation.as_slice())).collect();
    for compared in compare(envelopes, &activations, analysis.trajectory.grid(), 0.0) {
        found.0.entry(compared.muscle.to_string()).or_default().push(compared.r);
    }
    let at_joint = trial
        .reserve_use()
        .into_iter()
        .filter(|used| outcome.body.coordinates()[used.coordinate.index()].name.starts_with("subtalar"));
    // The share of a warning.
    found.1 += usize::from(at_joint.map(|used| used.largest / used.net).any(|share| share > 0.1));
}

/// Keeps the instants in which walks come nearest to the limits of what people do.
fn farthest(people: &mut BTreeMap<String, Likeness>, outcome: &Outcome) {
    for one in likeness(&outcome.body, &outcome.complete().trajectory, &outcome.person) {
        let part = one.quantity.trim_end_matches("_r").trim_end_matches("_l");
        let known = people.entry(format!("{} of {part}", one.measure)).or_insert_with(|| one.clone());
        if one.share > known.share {
            *known = one;
        }
    }
}

/// A motor carries the moment of the subtalar joint. With muscles alone there, they are too weak in many walks, and the
/// activation of tibialis anterior agrees less with its EMG; no other muscle differs by much.
#[test]
fn muscles_agree_better_with_emg_where_a_motor_carries_the_subtalar_joint() {
    let Some(data) = data() else { return };
    let walks = walks_of_rehazenter(&data);
    let [mut with_motor, mut alone] = [(); 2].map(|()| Found::default());
    let mut people: BTreeMap<String, Likeness> = BTreeMap::new();
    for (walk, standing) in &walks {
        let outcome = run(walk.clone(), Some(standing.clone()), None);
        farthest(&mut people, &outcome);
        let set = &muscles(&outcome).set;
        assert!(set.actuators.iter().any(|motor| motor.name == "subtalar_angle_r_motor"));
        let mut other = set.clone();
        other.actuators.retain(|motor| !motor.name.starts_with("subtalar"));
        add(&mut with_motor, &outcome, set);
        add(&mut alone, &outcome, &other);
    }
    for (measure, one) in &people {
        println!("{measure}: at most {:.3} {}, {:.2} of the limit for walks of people", one.value, one.unit, one.share);
        assert!(one.share < 0.8, "{}", one.message);
    }
    assert_eq!(people.len(), 5);
    println!("{} walks; muscles alone lack a tenth of the subtalar moment in {}", walks.len(), alone.1);
    println!("correlation with EMG: a motor at the subtalar joint, muscles alone, channels");
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    for (muscle, values) in &with_motor.0 {
        let [own, other] = [mean(values), mean(&alone.0[muscle])];
        println!("  {muscle:<24} {own:6.3} {other:6.3} {:3}", values.len());
        assert!(own > other - 0.02, "{muscle} {own} {other}");
    }
    let of_tibialis = |found: &Found| mean(&found.0["tibialis anterior"]);
    assert!(of_tibialis(&with_motor) > of_tibialis(&alone) + 0.05);
    assert!(alone.1 * 4 > walks.len(), "{} of {}", alone.1, walks.len());
}

/// The distance of the condyles follows the width of the knee in the file, and a stated distance goes before it.
#[test]
fn condyles_are_as_far_apart_as_the_recorded_width_of_the_knee_says() {
    let Some(data) = data() else { return };
    let folder = data.join("biomechzoo-HC032A");
    let (walk, standing) = (folder.join("HC032A03.c3d"), folder.join("HC032A01.c3d"));
    let file = ambulo::formats::c3d::C3d::read(&fs::read(&standing).unwrap()).unwrap().0;
    let width = |name: &str| 1e-3 * file.parameters.get("PROCESSING", name).unwrap().numbers().unwrap()[0];
    let knee_m = 0.5 * (width("RKneeWidth") + width("LKneeWidth"));
    let distance = |condyles_m: Option<f64>| {
        let outcome = run(walk.clone(), Some(standing.clone()), condyles_m);
        muscles(&outcome).loads.right.as_ref().unwrap().knee.condyle_distance_m
    };
    let expected = 0.04 * knee_m / 0.09;
    assert!((distance(None) - expected).abs() < 1e-12, "{} {expected}", distance(None));
    assert!((distance(Some(0.05)) - 0.05).abs() < 1e-12);
}
