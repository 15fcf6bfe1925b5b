//! Knee contact force of the built-in body compared with that of Gait2392 in OpenSim, on the same walk.

use crate::people::{self, Person};
use crate::shared_data;
use ambulo_body::dynamics::{Workspace, inverse};
use ambulo_body::model::{BySide, Side};
use ambulo_body::spatial::STANDARD_GRAVITY;
use ambulo_formats::table::Table;
use ambulo_muscles::built_in::muscle_set;
use ambulo_muscles::contact_loads::{condyle_distance, contact_loads};
use ambulo_muscles::set::MuscleSet;
use ambulo_muscles::settings::MuscleSettings;
use ambulo_muscles::trial::solve_trial;

/// Frames of OpenSim's static optimisation [s].
const WINDOW: [f64; 2] = [0.6, 1.6];
const PLATES: [&str; 2] = ["subject01_walk1_grf.mot", "subject01_walk1_grf.xml"];

/// Peaks of hip, knee and ankle of each side [body weights], and the worst reserve of a leg [N.m].
struct Peaks {
    joints: BySide<[f64; 3]>,
    reserve: f64,
}

fn peaks(person: &Person, set: &MuscleSet) -> Peaks {
    let model = &person.model;
    let trajectory = person.trajectory(WINDOW);
    let ground = person.ground(PLATES, &trajectory);
    let net = inverse(&mut Workspace::new(model), &trajectory, &ground);
    let trial = solve_trial(model, set, &MuscleSettings::default(), &trajectory, &net.generalized).unwrap();
    let reader = trial.reader(model, &trajectory, &ground);
    let loads = contact_loads(model, &trajectory, &reader, BySide::from_fn(|_| condyle_distance(None)));
    let weight = model.mass() * STANDARD_GRAVITY;
    let joints = loads.map(|leg| {
        leg.unwrap().joints.map(|joint| joint.in_child.iter().map(|load| load.force.norm() / weight).fold(0.0, f64::max))
    });
    let reserves = trial.reserve_use().into_iter().filter(|reserve| {
        let name = &model.coordinates()[reserve.coordinate.index()].name;
        ["hip", "knee", "ankle", "subtalar"].iter().any(|stem| name.starts_with(stem))
    });
    for reserve in reserves.clone().filter(|reserve| reserve.largest > 1.0) {
        let name = &model.coordinates()[reserve.coordinate.index()].name;
        println!("  reserve of {name} {:.1} of {:.1} N.m", reserve.largest, reserve.net);
    }
    Peaks { joints, reserve: reserves.map(|reserve| reserve.largest).fold(0.0, f64::max) }
}

/// OpenSim's peaks with Gait2392 on the same walk [body weights].
fn opensim() -> Option<BySide<[f64; 3]>> {
    let path = shared_data::data()?.join("muscles/opensim46/jointreaction_gait2392.sto");
    let table = Table::read_storage(&std::fs::read(path).unwrap()).unwrap().0;
    let weight = 72.6 * STANDARD_GRAVITY;
    let peak = |joint: &str, child: &str, side: Side| {
        let s = side.letter();
        let column = |axis: &str| table.column(&format!("{joint}_{s}_on_{child}_{s}_in_{child}_{s}_f{axis}")).unwrap();
        let [x, y, z] = ["x", "y", "z"].map(column);
        (0..x.len()).map(|i| (x[i] * x[i] + y[i] * y[i] + z[i] * z[i]).sqrt() / weight).fold(0.0, f64::max)
    };
    let joints = [("hip", "femur"), ("knee", "tibia"), ("ankle", "talus")];
    Some(BySide::from_fn(|side| joints.map(|(joint, child)| peak(joint, child, side))))
}

#[test]
fn peaks_of_knee_contact_are_within_15_percent_of_gait2392() {
    let (Some(person), Some(reference)) = (people::subject01(), opensim()) else { return };
    let set = muscle_set(&person.model).unwrap();
    let found = peaks(&person, &set);
    println!("largest reserve of a leg {:.1} N.m", found.reserve);
    for side in Side::BOTH {
        for (k, joint) in ["hip", "knee", "ankle"].iter().enumerate() {
            let (own, other) = (found.joints[side][k], reference[side][k]);
            println!("  {joint} {side}: {own:.2} body weights, Gait2392 {other:.2}, {:+.0} %", 100.0 * (own / other - 1.0));
        }
        let ratio = found.joints[side][1] / reference[side][1];
        assert!((ratio - 1.0).abs() < 0.15, "{side} {ratio}");
    }
    // Without gastrocnemii and hamstrings across the knee the peak is another.
    let mut fewer = set;
    fewer.muscles.retain(|muscle| !["_gas_", "semi", "bifem"].iter().any(|part| muscle.name.contains(part)));
    let without = peaks(&person, &fewer).joints;
    println!("  without: knee {:.2} and {:.2}", without.right[1], without.left[1]);
    assert!(Side::BOTH.iter().any(|side| (without[*side][1] / reference[*side][1] - 1.0).abs() > 0.15));
}
