//! Moment arms of the built-in body compared with those of Gait2392, in walking.

use crate::muscle_models::{MuscleModel, State, Table, load, postures};
use crate::people;
use ambulo_body::model::anthropometry::{Build, SegmentTable};
use ambulo_body::model::full_body::full_body;
use ambulo_body::model::{Model, Movement, Side};
use ambulo_body::motion::{Motion, interpolate};
use ambulo_muscles::built_in::muscle_set;
use ambulo_muscles::path::PathWorkspace;
use ambulo_muscles::wrap::WrapRule;
use std::collections::BTreeMap;

/// Joints of a leg, and the coordinates that are compared: names are the same in both models.
const JOINTS: [(&str, &[&str]); 3] =
    [("hip", &["hip_flexion", "hip_adduction", "hip_rotation"]), ("knee", &["knee_angle"]), ("ankle", &["ankle_angle"])];

/// Differences of the moment arms of a muscle about a coordinate over the postures.
#[derive(Default, Clone, Copy)]
struct Difference {
    squares: f64,
    largest: f64,
    /// Mean of Gait2392's arm [m].
    reference: f64,
    postures: usize,
}

/// The walking postures of the tables, with their times.
fn walking(muscles: &MuscleModel) -> Vec<(f64, State)> {
    let table = Table::read("postures_gait2392.csv").unwrap();
    let all = postures("gait2392", &muscles.model).unwrap();
    let walk = table.rows.iter().zip(all).filter(|(_, (kind, _))| kind == "walk");
    walk.map(|(row, (_, state))| (table.number(row, "time"), state)).collect()
}

/// Differences by muscle and coordinate; `own` gives the state of the built-in body.
fn differences(
    reference: &MuscleModel,
    model: &Model,
    own: impl Fn(f64, &State) -> State,
) -> BTreeMap<(String, String), Difference> {
    let set = muscle_set(model).unwrap();
    let mut theirs = PathWorkspace::new(&reference.model, &reference.set, WrapRule::Exact);
    let mut ours = PathWorkspace::new(model, &set, WrapRule::Exact);
    let mut found = BTreeMap::new();
    for (time, state) in walking(reference) {
        theirs.update(state.posture());
        ours.update(own(time, &state).posture());
        for (i, muscle) in set.muscles.iter().enumerate() {
            let other = reference.set.muscles.iter().position(|known| known.name == muscle.name).unwrap();
            for stem in JOINTS.iter().flat_map(|(_, stems)| *stems) {
                let name = format!("{stem}_{}", muscle.name.chars().last().unwrap());
                let own = ours.arm(i, model.coordinate(&name).unwrap());
                let arm = theirs.arm(other, reference.model.coordinate(&name).unwrap());
                if own.abs().max(arm.abs()) < 1e-9 {
                    continue;
                }
                if (own - arm).abs() > 0.0095 { println!("{} {stem} {time} own {own} ref {arm} q {:?}", muscle.name, reference.model.coordinates().iter().zip(&state.q).filter(|(c, _)| c.name.starts_with("knee") || c.name.starts_with("hip")).map(|(c, q)| (c.name.clone(), q.to_degrees().round())).collect::<Vec<_>>()); }
                let sum: &mut Difference = found.entry((muscle.name.clone(), (*stem).to_owned())).or_default();
                sum.squares += (own - arm).powi(2);
                sum.largest = sum.largest.max((own - arm).abs());
                sum.reference += arm;
                sum.postures += 1;
            }
        }
    }
    found
}

/// Prints a row per muscle and coordinate; returns the largest difference of each joint [m].
fn show(label: &str, found: &BTreeMap<(String, String), Difference>, all: bool) -> [f64; 3] {
    println!("{label}: moment arm of Gait2392 (mean), difference of the built-in body (rms, largest) [mm]");
    let millimetres = |metres: f64| 1e3 * metres;
    for ((muscle, stem), sum) in found.iter().filter(|_| all) {
        let count = sum.postures as f64;
        let [mean, rms, largest] = [sum.reference / count, (sum.squares / count).sqrt(), sum.largest].map(millimetres);
        println!("  {muscle:<12} {stem:<14} {mean:>6.1} {rms:>5.1} {largest:>5.1}");
    }
    JOINTS.map(|(joint, stems)| {
        let of_joint: Vec<_> = found.iter().filter(|((_, stem), _)| stems.contains(&stem.as_str())).collect();
        let worst = of_joint.iter().max_by(|a, b| a.1.largest.total_cmp(&b.1.largest)).unwrap();
        let mean_square = |sum: &Difference| sum.squares / sum.postures as f64;
        let rms = (of_joint.iter().map(|(_, sum)| mean_square(sum)).sum::<f64>() / of_joint.len() as f64).sqrt();
        let ((muscle, stem), sum) = worst;
        println!(
            "  {joint}: {} arms, rms {:.1} mm, worst {muscle} {stem} {:.1} mm",
            of_joint.len(),
            millimetres(rms),
            millimetres(sum.largest)
        );
        sum.largest
    })
}

/// The state of a recorded motion at a time.
fn state_at(model: &Model, motion: &Motion, time: f64) -> State {
    let value = |id| motion.column(id).map_or(0.0, |column: &[f64]| interpolate(&motion.times, column, time));
    let q: Vec<f64> = model.coordinate_ids().map(value).collect();
    let qd = vec![0.0; q.len()];
    State::new(q, qd)
}

/// The body and the motion follow from markers alone: joint centres, axes and angles are not those of Gait2392.
#[test]
fn moment_arms_in_the_walk_of_subject01_are_within_10_mm_of_gait2392() {
    let (Some(reference), Some(person)) = (load("gait2392"), people::subject01()) else { return };
    let model = &person.model;
    let found = differences(&reference, model, |time, _| state_at(model, &person.walk, time));
    let worst = show("subject01 by markers", &found, true);
    assert!(worst.iter().all(|worst| *worst < 0.010), "{worst:?}");
    // A knee that is 10 degrees off has other arms.
    let bent = |time: f64, _: &State| {
        let mut state = state_at(model, &person.walk, time);
        for side in Side::BOTH {
            let (id, _) = model.anatomy().coordinate(Movement::KneeFlexion, Some(side)).unwrap();
            state.q[id.index()] += 10_f64.to_radians();
        }
        state
    };
    assert!(show("knees 10 degrees off", &differences(&reference, model, bent), false)[1] > 0.010);
}

/// A body of usual proportions and the stature of the person, in the postures of Gait2392.
#[test]
fn moment_arms_of_usual_proportions_are_within_10_mm_of_gait2392() {
    let Some(reference) = load("gait2392") else { return };
    let build = Build { table: SegmentTable::DeLevaMale, mass: 72.6, height: 1.8034, toe_joint: true };
    let model = full_body(&build).unwrap().model;
    let same = |_: f64, state: &State| {
        let value = |name: &str| reference.model.coordinate(name).map_or(0.0, |id| state.q[id.index()]);
        let q: Vec<f64> = model.coordinates().iter().map(|c| value(&c.name)).collect();
        let qd = vec![0.0; q.len()];
        State::new(q, qd)
    };
    let worst = show("usual proportions", &differences(&reference, &model, same), false);
    assert!(worst.iter().all(|worst| *worst < 0.010), "{worst:?}");
    // Of a child of half the size they are not.
    let child = full_body(&Build { mass: 15.0, height: 0.9, ..build }).unwrap().model;
    assert!(show("half the size", &differences(&reference, &child, same), false).iter().all(|worst| *worst > 0.010));
}
