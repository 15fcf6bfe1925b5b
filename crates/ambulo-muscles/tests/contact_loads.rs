//! Joint reactions with muscles against OpenSim 4.6's JointReaction, and the shares of the condyles.

use crate::muscle_models::Table;
use crate::walks::Walk;
use ambulo_body::dynamics::{LoadSeries, ReactionReader};
use ambulo_body::model::{BySide, Side};
use ambulo_body::spatial::{Vec3, Wrench};
use ambulo_muscles::contact_loads::{condyle_distance, contact_loads};
use ambulo_muscles::path::PathWorkspace;
use ambulo_muscles::settings::MuscleSettings;
use ambulo_muscles::trial::solve_trial;
use ambulo_muscles::wrap::WrapRule;

/// Tensions by the name of the muscle and the frame, as loads on all bodies.
fn loads_of(walk: &Walk, tension: impl Fn(&str, usize) -> f64) -> Vec<LoadSeries> {
    let (model, set) = (&walk.muscles.model, &walk.muscles.set);
    let mut paths = PathWorkspace::new(model, set, WrapRule::OpenSim);
    let mut series: Vec<LoadSeries> =
        model.body_ids().map(|body| LoadSeries { body, points: Vec::new(), wrenches: Vec::new() }).collect();
    let mut loads = Vec::new();
    walk.trajectory.for_each_posture(|frame, posture| {
        paths.update(posture);
        let tensions: Vec<f64> = set.muscles.iter().map(|muscle| tension(&muscle.name, frame)).collect();
        paths.loads(&tensions, &mut loads);
        for (series, load) in series.iter_mut().zip(&loads) {
            series.points.push(load.point);
            series.wrenches.push(load.wrench);
        }
    });
    series
}

/// The tensions that OpenSim's static optimisation found, times a factor.
fn reference_loads(walk: &Walk, factor: f64) -> Vec<LoadSeries> {
    let forces = walk.reference("so", "_force");
    loads_of(walk, |name, frame| forces.column(name).unwrap()[frame] * factor)
}

/// The tensions of the exact optimum (`so_MODEL_exact.csv`) with OpenSim's strengths, as loads on all bodies.
fn exact_loads(walk: &Walk) -> Vec<LoadSeries> {
    let [activations, strengths] = ["so_NAME_exact.csv", "optimal_force_NAME.csv"]
        .map(|file| Table::read(&file.replace("NAME", walk.name)).unwrap());
    let tension = |name: &str, frame: usize| {
        activations.number(&activations.rows[frame], name) * strengths.number(&strengths.rows[frame], name)
    };
    loads_of(walk, tension)
}

/// Largest difference of the reactions from OpenSim's over all frames and joints: forces in body weights, moments in
/// body weights times metres; `shows` prints each joint.
fn difference(walk: &Walk, muscles: &[LoadSeries], shows: bool) -> [f64; 2] {
    let model = &walk.muscles.model;
    let loads: Vec<LoadSeries> = walk.ground.iter().chain(muscles).cloned().collect();
    let reader = ReactionReader::new(model, &walk.trajectory, loads);
    let table = walk.reference("jointreaction", "");
    let mut worst = [0.0_f64; 2];
    for column in table.names().iter().filter(|name| name.ends_with("_fx")) {
        let stem = column.strip_suffix("_fx").unwrap();
        let body = model.body(stem.rsplit("_in_").next().unwrap()).unwrap();
        let part = |end: &str| table.column(&format!("{stem}_{end}")).unwrap();
        let [force, moment] = [["fx", "fy", "fz"], ["mx", "my", "mz"]].map(|ends| ends.map(part));
        let mut own = [0.0_f64; 2];
        for frame in 0..walk.trajectory.grid().frames {
            let turn = reader.body_motion(body, frame).pose.rotation.transpose();
            let Wrench { force: f, moment: m } = reader.at(body, frame).wrench;
            let at = |columns: &[&[f64]; 3]| Vec3::new(columns[0][frame], columns[1][frame], columns[2][frame]);
            own[0] = own[0].max((turn * f - at(&force)).norm() / walk.body_weight);
            own[1] = own[1].max((turn * m - at(&moment)).norm() / walk.body_weight);
        }
        if shows {
            println!("  {stem:<48} {:.4} BW, {:.5} BW.m", own[0], own[1]);
        }
        worst = [worst[0].max(own[0]), worst[1].max(own[1])];
    }
    worst
}

#[test]
fn reactions_with_opensims_forces_agree_with_opensim() {
    for name in ["gait2392", "gait10dof", "rajagopal"] {
        let Some(walk) = Walk::load(name) else { return };
        println!("{name}, muscle forces of OpenSim:");
        let found = difference(&walk, &reference_loads(&walk, 1.0), true);
        println!("  largest {:.4} BW, {:.5} BW.m", found[0], found[1]);
        assert!(found[0] < 0.005 && found[1] < 0.005, "{name}: {found:?}");
        // What must be noticed: one per cent more force, or none.
        assert!(difference(&walk, &reference_loads(&walk, 1.01), false)[0] > 0.005, "{name}");
        assert!(difference(&walk, &[], false)[0] > 1.0, "{name}");
    }
}

#[test]
fn reactions_with_our_forces_agree_with_opensim() {
    for name in ["gait2392", "gait10dof", "rajagopal"] {
        let Some(walk) = Walk::load(name) else { return };
        let settings = MuscleSettings { wraps: WrapRule::OpenSim, ..MuscleSettings::default() };
        let trial = solve_trial(&walk.muscles.model, &walk.muscles.set, &settings, &walk.trajectory, &walk.generalized);
        println!("{name}, own muscle forces:");
        let found = difference(&walk, &trial.unwrap().loads, true);
        println!("  largest {:.4} BW, {:.5} BW.m", found[0], found[1]);
        // OpenSim's optimiser stops early: the exact optimum of its own problem differs as much from its forces.
        let exact = difference(&walk, &exact_loads(&walk), false);
        println!("  exact optimum of OpenSim's problem: {:.4} BW, {:.5} BW.m", exact[0], exact[1]);
        assert!(found[0] < exact[0].max(0.03) + 1e-4 && found[1] < 0.03, "{name}: {found:?} {exact:?}");
        assert!(exact[0] < 0.035, "{name}: {exact:?}");
    }
}

#[test]
fn legs_carry_what_their_joints_carry() {
    for name in ["gait2392", "gait10dof", "rajagopal"] {
        let Some(walk) = Walk::load(name) else { return };
        let model = &walk.muscles.model;
        let settings = MuscleSettings::default();
        let trial = solve_trial(model, &walk.muscles.set, &settings, &walk.trajectory, &walk.generalized).unwrap();
        let reader = trial.reader(model, &walk.trajectory, &walk.ground);
        let loads = contact_loads(model, &walk.trajectory, &reader, BySide::from_fn(|_| condyle_distance(None)));
        let frames = walk.trajectory.grid().frames;
        for (side, leg) in loads.iter() {
            let leg = leg.as_ref().unwrap();
            let sizes: Vec<f64> = leg
                .joints
                .iter()
                .map(|joint| joint.in_child.iter().fold(0.0_f64, |m, w| m.max(w.force.norm())) / walk.body_weight)
                .collect();
            let compression: Vec<f64> = leg.joints[1].in_joint.iter().map(|load| -load.force.y).collect();
            let most = |values: &[f64]| values.iter().fold(f64::MIN, |most, value| most.max(*value)) / walk.body_weight;
            println!(
                "{name} {side:?}: hip {:.2}, knee {:.2}, ankle {:.2} BW; knee medial {:.2}, lateral {:.2} BW",
                sizes[0],
                sizes[1],
                sizes[2],
                most(&leg.knee.medial),
                most(&leg.knee.lateral)
            );
            for (frame, whole) in compression.iter().enumerate() {
                let sum = leg.knee.medial[frame] + leg.knee.lateral[frame];
                assert!((sum - whole).abs() < 1e-9 * walk.body_weight, "{sum} {whole}");
                // The same force in two frames.
                let [a, b] = [leg.joints[1].in_child[frame].force.norm(), leg.joints[1].in_joint[frame].force.norm()];
                assert!((a - b).abs() < 1e-9 * walk.body_weight, "{a} {b}");
            }
            // In single support the medial side carries more than half.
            let at = (0..frames).max_by(|a, b| compression[*a].total_cmp(&compression[*b])).unwrap();
            assert!(leg.knee.medial[at] > leg.knee.lateral[at], "{name} {side:?}");
        }
        // The published range of hip, knee and ankle loads by such models; OpenSim's own are in the README of the data.
        let knee = |side: Side| {
            loads[side].as_ref().unwrap().joints[1].in_child.iter().fold(0.0_f64, |m, w| m.max(w.force.norm()))
        };
        assert!(knee(Side::Right) > 2.0 * walk.body_weight);
    }
}

#[test]
fn condyles_are_apart_in_proportion_to_the_knee() {
    assert!((condyle_distance(Some(0.099)) - 0.044).abs() < 1e-15 && (condyle_distance(None) - 0.04).abs() < 1e-15);
}
