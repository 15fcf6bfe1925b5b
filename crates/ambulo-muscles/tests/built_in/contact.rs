//! Knee contact force of the built-in body compared with that of Gait2392 in OpenSim, on the same walk.

use crate::people::{self, Person};
use crate::shared_data;
use ambulo_body::dynamics::{LoadSeries, Workspace, inverse};
use ambulo_body::kinematics::Trajectory;
use ambulo_body::model::{BySide, Model, Side};
use ambulo_body::spatial::STANDARD_GRAVITY;
use ambulo_formats::table::Table;
use ambulo_muscles::built_in::muscle_set;
use ambulo_muscles::contact_loads::{condyle_distance, contact_loads};
use ambulo_muscles::set::MuscleSet;
use ambulo_muscles::settings::MuscleSettings;
use ambulo_muscles::trial::solve_trial;

/// A walk with OpenSim's results.
struct Walk {
    /// Name of the model in OpenSim's tables.
    name: &'static str,
    /// Frames of OpenSim's static optimisation [s].
    window: [f64; 2],
    plates: [&'static str; 2],
    /// Body weight of the model [kg].
    mass: f64,
    knee: &'static str,
}

const GAIT2392: Walk = Walk {
    name: "gait2392",
    window: [0.6, 1.6],
    plates: ["subject01_walk1_grf.mot", "subject01_walk1_grf.xml"],
    mass: 72.6,
    knee: "knee",
};
const RAJAGOPAL: Walk = Walk {
    name: "rajagopal",
    window: [0.5, 1.7],
    plates: ["grf_walk.mot", "grf_walk.xml"],
    mass: 85.27,
    knee: "walker_knee",
};

impl Walk {
    fn peaks(&self, person: &Person, set: &MuscleSet) -> Peaks {
        let trajectory = person.trajectory(self.window);
        let ground = person.ground(self.plates, &trajectory);
        peaks(&person.model, set, &trajectory, &ground)
    }
}

/// Peaks of hip, knee and ankle of each side [body weights], and the worst reserve of a leg [N.m].
pub(super) struct Peaks {
    pub(super) joints: BySide<[f64; 3]>,
    pub(super) reserve: f64,
}

pub(super) fn peaks(model: &Model, set: &MuscleSet, trajectory: &Trajectory, ground: &[LoadSeries]) -> Peaks {
    let net = inverse(&mut Workspace::new(model), trajectory, ground);
    let trial = solve_trial(model, set, &MuscleSettings::default(), trajectory, &net.generalized).unwrap();
    let reader = trial.reader(model, trajectory, ground);
    let loads = contact_loads(model, trajectory, &reader, BySide::from_fn(|_| condyle_distance(None)));
    let weight = model.mass() * STANDARD_GRAVITY;
    let joints = loads.map(|leg| {
        leg.unwrap()
            .joints
            .map(|joint| joint.in_child.iter().map(|load| load.force.norm() / weight).fold(0.0, f64::max))
    });
    let reserves = trial.reserve_use().into_iter().filter(|reserve| {
        let name = &model.coordinates()[reserve.coordinate.index()].name;
        ["hip", "knee", "ankle"].iter().any(|stem| name.starts_with(stem))
    });
    for reserve in reserves.clone().filter(|reserve| reserve.largest > 1.0) {
        let name = &model.coordinates()[reserve.coordinate.index()].name;
        println!("  reserve of {name} {:.1} of {:.1} N.m", reserve.largest, reserve.net);
    }
    Peaks { joints, reserve: reserves.map(|reserve| reserve.largest).fold(0.0, f64::max) }
}

/// OpenSim's peaks with a published model on the same walk [body weights].
fn opensim(walk: &Walk) -> Option<BySide<[f64; 3]>> {
    let path = shared_data::data()?.join(format!("muscles/opensim46/jointreaction_{}.sto", walk.name));
    let table = Table::read_storage(&std::fs::read(path).unwrap()).unwrap().0;
    let weight = walk.mass * STANDARD_GRAVITY;
    let peak = |joint: &str, child: &str, side: Side| {
        let s = side.letter();
        let column = |axis: &str| table.column(&format!("{joint}_{s}_on_{child}_{s}_in_{child}_{s}_f{axis}")).unwrap();
        let [x, y, z] = ["x", "y", "z"].map(column);
        (0..x.len()).map(|i| (x[i] * x[i] + y[i] * y[i] + z[i] * z[i]).sqrt() / weight).fold(0.0, f64::max)
    };
    let joints = [("hip", "femur"), (walk.knee, "tibia"), ("ankle", "talus")];
    Some(BySide::from_fn(|side| joints.map(|(joint, child)| peak(joint, child, side))))
}

/// Prints all peaks; returns the worst ratio of knee peaks to the published ones, less 1.
fn show(found: &Peaks, published: &BySide<[f64; 3]>, walk: &Walk) -> f64 {
    println!("largest reserve of a leg {:.1} N.m", found.reserve);
    let mut worst = 0.0_f64;
    for side in Side::BOTH {
        for (k, joint) in ["hip", "knee", "ankle"].iter().enumerate() {
            let (own, other) = (found.joints[side][k], published[side][k]);
            let percent = 100.0 * (own / other - 1.0);
            println!("  {joint} {side}: {own:.2} body weights, {} {other:.2}, {percent:+.0} %", walk.name);
        }
        worst = worst.max((found.joints[side][1] / published[side][1] - 1.0).abs());
    }
    worst
}

#[test]
fn peaks_of_knee_contact_are_within_15_percent_of_gait2392() {
    let (Some(person), Some(published)) = (people::subject01(), opensim(&GAIT2392)) else { return };
    let set = muscle_set(&person.model).unwrap();
    assert!(show(&GAIT2392.peaks(&person, &set), &published, &GAIT2392) < 0.15);
    // Without gastrocnemii and hamstrings the peaks are others.
    let mut fewer = set;
    fewer.muscles.retain(|muscle| !["_gas_", "semi", "bifem"].iter().any(|part| muscle.name.contains(part)));
    assert!(show(&GAIT2392.peaks(&person, &fewer), &published, &GAIT2392) > 0.15);
}

/// The second person has another published model, whose muscles are stronger and whose knee has a patella.
#[test]
fn peaks_of_knee_contact_of_a_second_person_are_near_those_of_rajagopals_model() {
    let (Some(person), Some(published)) = (people::rajagopal_walker(), opensim(&RAJAGOPAL)) else { return };
    let set = muscle_set(&person.model).unwrap();
    assert!(show(&RAJAGOPAL.peaks(&person, &set), &published, &RAJAGOPAL) < 0.25);
}
