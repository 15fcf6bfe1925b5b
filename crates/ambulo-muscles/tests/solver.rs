//! Muscle forces of three walks: identities, and OpenSim 4.6's own static optimisation.

use crate::walks::Walk;
use ambulo_body::dynamics::{Workspace, inverse, inverse_frame};
use ambulo_body::kinematics::Posture;
use ambulo_body::model::Drive;
use ambulo_muscles::set::{CoordinateActuator, MuscleSet};
use ambulo_muscles::settings::{MuscleSettings, MuscleWeight, Reserves, SolverError};
use ambulo_muscles::solver::MuscleSolver;
use ambulo_muscles::strength::Pennation;
use ambulo_muscles::trial::{MuscleTrial, solve_trial};
use ambulo_muscles::wrap::WrapRule;

fn solve(walk: &Walk, settings: &MuscleSettings) -> MuscleTrial {
    let model = &walk.muscles.model;
    solve_trial(model, &walk.muscles.set, settings, &walk.trajectory, &walk.generalized).unwrap()
}

fn as_opensim() -> MuscleSettings {
    MuscleSettings { wraps: WrapRule::OpenSim, ..MuscleSettings::default() }
}

/// Largest and rms differences from OpenSim's static optimisation.
#[derive(Debug, Clone, Copy, Default)]
struct Differences {
    activation: f64,
    force: f64,
    rms: f64,
    iterations: f64,
}

fn against_opensim(walk: &Walk, settings: &MuscleSettings, shows: bool) -> Differences {
    let trial = solve(walk, settings);
    let (activations, forces) = (walk.reference("so", "_activation"), walk.reference("so", "_force"));
    let mut worst = Differences::default();
    let (mut squares, mut count) = (0.0, 0);
    for (muscle, series) in walk.muscles.set.muscles.iter().zip(&trial.muscles) {
        let far = |ours: &[f64], theirs: &[f64]| -> Vec<f64> { ours.iter().zip(theirs).map(|(a, b)| a - b).collect() };
        let most = |values: &[f64]| values.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let activation = far(&series.activation, activations.column(&muscle.name).unwrap());
        let force = far(&series.force, forces.column(&muscle.name).unwrap());
        let square: f64 = force.iter().map(|x| x * x).sum();
        if shows {
            let rms = (square / force.len() as f64).sqrt();
            println!(
                "  {:<14} activation {:.4}, {:>6.1} N, rms {rms:.2} N",
                muscle.name,
                most(&activation),
                most(&force)
            );
        }
        worst.activation = worst.activation.max(most(&activation));
        worst.force = worst.force.max(most(&force));
        squares += square;
        count += force.len();
    }
    worst.rms = (squares / f64::from(u32::try_from(count).unwrap())).sqrt();
    worst.iterations = trial.iterations.iter().sum::<usize>() as f64 / trial.iterations.len() as f64;
    assert!(trial.unmet_frames.is_empty());
    worst
}

#[test]
fn muscle_forces_agree_with_opensim() {
    for (name, rms) in [("gait2392", 1.0), ("gait10dof", 1.0), ("rajagopal", 2.0)] {
        let Some(walk) = Walk::load(name) else { return };
        let found = against_opensim(&walk, &as_opensim(), false);
        println!("{name}: {found:?}");
        assert!(found.activation < 0.01 && found.force < 20.0 && found.rms < rms, "{name}: {found:?}");
        // What must be noticed.
        let right = MuscleSettings { pennation: Pennation::Right, exponent: 2.0, ..as_opensim() };
        let cubes = MuscleSettings { exponent: 3.0, ..as_opensim() };
        if name != "gait2392" {
            assert!(against_opensim(&walk, &right, false).force > 20.0, "{name}");
        }
        assert!(against_opensim(&walk, &cubes, false).activation > 0.05, "{name}");
    }
}

#[test]
fn exact_paths_change_the_forces_of_muscles_over_surfaces() {
    let Some(walk) = Walk::load("rajagopal") else { return };
    println!("rajagopal, exact paths against OpenSim:");
    let found = against_opensim(&walk, &MuscleSettings::default(), true);
    println!("{found:?}");
    assert!(found.activation < 0.3, "{found:?}");
}

#[test]
fn tensions_leave_the_reserves_to_inverse_dynamics() {
    for name in ["gait2392", "gait10dof", "rajagopal"] {
        let Some(walk) = Walk::load(name) else { return };
        let model = &walk.muscles.model;
        let mut solver = MuscleSolver::new(model, &walk.muscles.set, &MuscleSettings::default()).unwrap();
        let mut workspace = Workspace::new(model);
        let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
        let mut generalized = vec![0.0; model.coordinates().len()];
        walk.trajectory.for_each_posture(|frame, posture| {
            for (own, column) in generalized.iter_mut().zip(&walk.generalized) {
                *own = column[frame];
            }
            let values = solver.frame(posture, &generalized).clone();
            let mut loads: Vec<_> = walk.ground.iter().map(|series| series.at(frame)).collect();
            loads.extend(&values.body_loads);
            let mut left = inverse_frame(&mut workspace, posture, &loads).generalized().to_vec();
            // What moving points of paths exert on the coordinates that move them.
            let mut gears = vec![0.0; left.len()];
            solver.paths().add_gear_forces(&values.forces, &mut gears);
            left.iter_mut().zip(&gears).for_each(|(left, gear)| *left -= gear);
            fold(model, posture, &mut left);
            for ((id, reserve), unmet) in solver.coordinates().iter().zip(&values.reserves).zip(&values.unmet) {
                worst = worst.max((left[id.index()] - reserve - unmet).abs());
            }
            largest = values.required.iter().fold(largest, |most, x| most.max(x.abs()));
        });
        println!("{name}: {worst:.1e} of {largest:.0} N.m");
        assert!(worst < 1e-9 * largest, "{name}: {worst}");
    }
}

/// Adds the forces of coordinates that follow others to those of their leaders.
fn fold(model: &ambulo_body::model::Model, posture: Posture<'_>, forces: &mut [f64]) {
    for (i, coordinate) in model.coordinates().iter().enumerate() {
        if let Drive::Coupled(leader, function) = &coordinate.drive {
            forces[leader.index()] += function.at(posture.q[leader.index()])[1] * forces[i];
        }
    }
}

#[test]
fn a_frame_does_not_depend_on_the_frame_before() {
    let Some(walk) = Walk::load("gait2392") else { return };
    let (model, set) = (&walk.muscles.model, &walk.muscles.set);
    let mut warm = MuscleSolver::new(model, set, &MuscleSettings::default()).unwrap();
    let mut cold = warm.clone();
    let mut worst = 0.0_f64;
    let (mut warm_steps, mut cold_steps) = (0, 0);
    let mut generalized = vec![0.0; model.coordinates().len()];
    walk.trajectory.for_each_posture(|frame, posture| {
        for (own, column) in generalized.iter_mut().zip(&walk.generalized) {
            *own = column[frame];
        }
        cold.forget();
        let (a, b) = (warm.frame(posture, &generalized), cold.frame(posture, &generalized));
        worst = a.activations.iter().zip(&b.activations).fold(worst, |most, (a, b)| most.max((a - b).abs()));
        warm_steps += a.convergence.unwrap().iterations;
        cold_steps += b.convergence.unwrap().iterations;
    });
    let frames = walk.trajectory.grid().frames as f64;
    println!(
        "{worst:.1e}; {:.1} steps from the last frame, {:.1} from nothing",
        warm_steps as f64 / frames,
        cold_steps as f64 / frames
    );
    assert!(worst < 1e-9 && warm_steps < cold_steps, "{worst}");
}

#[test]
fn weak_muscles_are_seen_in_the_reserves() {
    let Some(walk) = Walk::load("gait10dof") else { return };
    let model = &walk.muscles.model;
    let knee = model.coordinate("knee_angle_r").unwrap();
    let used = |trial: &MuscleTrial| *trial.reserve_use().iter().find(|used| used.coordinate == knee).unwrap();
    let strong = used(&solve(&walk, &MuscleSettings::default()));
    let mut weak = walk.muscles.set.clone();
    for muscle in weak.muscles.iter_mut().filter(|muscle| muscle.name.ends_with("_r")) {
        muscle.parameters.max_isometric_force *= 0.02;
    }
    let weak = solve_trial(model, &weak, &MuscleSettings::default(), &walk.trajectory, &walk.generalized).unwrap();
    let weak = used(&weak);
    println!("right knee: {strong:?}\n            {weak:?}");
    assert!(strong.largest < 0.05 * strong.net, "{strong:?}");
    assert!(weak.largest > 0.5 * weak.net && weak.rms < weak.largest, "{weak:?}");
    // The net force of the coordinate is that of inverse dynamics.
    let largest = walk.generalized[knee.index()].iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    assert!((weak.net - largest).abs() < 1e-9 && (strong.net - largest).abs() < 1e-9);
}

#[test]
fn weights_and_listed_motors_are_obeyed() {
    let Some(walk) = Walk::load("gait10dof") else { return };
    let model = &walk.muscles.model;
    let mean = |trial: &MuscleTrial, name: &str| {
        let index = walk.muscles.set.muscles.iter().position(|muscle| muscle.name == name).unwrap();
        let series = &trial.muscles[index].activation;
        series.iter().sum::<f64>() / series.len() as f64
    };
    let usual = solve(&walk, &MuscleSettings::default());
    let weights = vec![MuscleWeight { muscle: "gastroc_r".into(), weight: 20.0 }];
    let weighted = solve(&walk, &MuscleSettings { weights, ..MuscleSettings::default() });
    assert!(mean(&weighted, "gastroc_r") < 0.6 * mean(&usual, "gastroc_r"));
    assert!(mean(&weighted, "soleus_r") > mean(&usual, "soleus_r"));
    // The usual reserves as a list give the same result.
    let all = |id| CoordinateActuator {
        name: String::from("motor"),
        coordinate: id,
        optimal_force: if model.coordinates()[usize_of(id)].name.starts_with("pelvis") { 1000.0 } else { 1.0 },
        control_range: [-1e6, 1e6],
    };
    let list: Vec<_> = model.coordinate_ids().map(all).collect();
    let listed =
        solve(&walk, &MuscleSettings { reserves: Reserves::Listed(list.clone()), ..MuscleSettings::default() });
    let far = usual.muscles.iter().zip(&listed.muscles).flat_map(|(a, b)| a.activation.iter().zip(&b.activation));
    assert!(far.fold(0.0_f64, |most, (a, b)| most.max((a - b).abs())) < 1e-9);
    // Without any, the pelvis is not held: every frame has forces that nothing exerts, and says how much.
    let none = solve(&walk, &MuscleSettings { reserves: Reserves::Listed(Vec::new()), ..MuscleSettings::default() });
    assert_eq!(none.unmet_frames.len(), walk.trajectory.grid().frames);
    let pelvis = none.reserve_use().into_iter().find(|used| model.coordinate("pelvis_ty") == Some(used.coordinate));
    let net =
        walk.generalized[model.coordinate("pelvis_ty").unwrap().index()].iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    assert!((pelvis.unwrap().largest - net).abs() < 1e-6 * net);
}

fn usize_of(id: ambulo_body::model::CoordinateId) -> usize {
    id.index()
}

#[test]
fn settings_that_fit_nothing_are_refused() {
    let Some(walk) = Walk::load("gait10dof") else { return };
    let (model, set) = (&walk.muscles.model, &walk.muscles.set);
    let refused = |set: &MuscleSet, settings: MuscleSettings| MuscleSolver::new(model, set, &settings).unwrap_err();
    assert_eq!(refused(&MuscleSet::default(), MuscleSettings::default()), SolverError::NoMuscles);
    let weights = vec![MuscleWeight { muscle: "nobody".into(), weight: 1.0 }];
    let error = refused(set, MuscleSettings { weights, ..MuscleSettings::default() });
    assert_eq!(error.to_string(), "a weight is given for muscle `nobody`, which the model does not have");
    let motor = CoordinateActuator {
        name: "motor".into(),
        coordinate: model.coordinate("knee_angle_r").unwrap(),
        optimal_force: 0.0,
        control_range: [-1.0, 1.0],
    };
    let listed = Reserves::Listed(vec![motor]);
    let error = refused(set, MuscleSettings { reserves: listed, ..MuscleSettings::default() });
    assert_eq!(
        error.to_string(),
        "motor `motor` at coordinate `knee_angle_r`: an optimal force of 0; expected a number other than 0"
    );
    let error = refused(set, MuscleSettings { exponent: 0.5, ..MuscleSettings::default() });
    assert!(matches!(error, SolverError::Optimization(_)), "{error}");
}

#[test]
fn inverse_dynamics_of_a_trial_agrees_with_its_reserves() {
    // The same identity over a whole trial, through its load series.
    let Some(walk) = Walk::load("gait10dof") else { return };
    let trial = solve(&walk, &MuscleSettings::default());
    let loads: Vec<_> = walk.ground.iter().chain(&trial.loads).cloned().collect();
    let left = inverse(&mut Workspace::new(&walk.muscles.model), &walk.trajectory, &loads).generalized;
    let hip = walk.muscles.model.coordinate("hip_flexion_r").unwrap();
    let reserve = trial.reserves.iter().find(|series| series.coordinate == hip).unwrap();
    for (left, reserve) in left[hip.index()].iter().zip(&reserve.force) {
        assert!((left - reserve).abs() < 1e-7, "{left} {reserve}");
    }
}
