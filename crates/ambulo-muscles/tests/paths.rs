//! Lengths, speeds and moment arms against OpenSim 4.6, against differences, and as identities.

use crate::muscle_models::{MODELS, MuscleModel, State, Table, load, postures};
use ambulo_body::model::{CoordinateId, Drive, Model};
use ambulo_muscles::path::PathWorkspace;
use ambulo_muscles::wrap::WrapRule;

/// Largest differences from OpenSim over the paths that touch no surface.
#[derive(Debug, Default, Clone, Copy)]
struct Differences {
    length: f64,
    speed: f64,
    arm: f64,
    paths: usize,
    touching: usize,
}

fn against_opensim(name: &str, muscles: &MuscleModel, spoil: impl Fn(&mut State)) -> Option<Differences> {
    let MuscleModel { model, set, .. } = muscles;
    let table = Table::read(&format!("paths_{name}.csv"))?;
    let mut paths = PathWorkspace::new(model, set, WrapRule::Exact);
    let mut worst = Differences::default();
    let states = postures(name, model)?;
    let mut current = usize::MAX;
    for row in &table.rows {
        let posture: usize = table.text(row, "posture").parse().unwrap();
        if posture != current {
            current = posture;
            let mut state = states[posture].1.clone();
            spoil(&mut state);
            paths.update(state.posture());
        }
        if let Some(i) = set.muscles.iter().position(|muscle| muscle.name == table.text(row, "path")) {
            if table.number(row, "n_wraps_active") > 0.0 {
                worst.touching += 1;
                continue;
            }
            worst.paths += 1;
            let difference = (paths.lengths()[i] - table.number(row, "length_m")).abs();
            worst.length = worst.length.max(difference);
            worst.speed = worst.speed.max((paths.speeds()[i] - table.number(row, "speed_m_s")).abs());
            for column in table.header.iter().filter(|column| column.starts_with("r:")) {
                let id = model.coordinate(&column[2..]).unwrap();
                worst.arm = worst.arm.max((paths.arm(i, id) - table.number(row, column)).abs());
            }
        }
    }
    Some(worst)
}

#[test]
fn paths_of_an_old_document_agree_with_opensim() {
    let Some(muscles) = load("arm26") else { return };
    let found = against_opensim("arm26", &muscles, |_| ()).unwrap();
    println!("arm26: {found:?}");
    assert!(found.paths > 50 && found.length < 1e-8 && found.arm < 1e-7 && found.speed < 2e-8, "{found:?}");
}

#[test]
fn paths_without_contact_agree_with_opensim() {
    for (name, _) in MODELS {
        let Some(muscles) = load(name) else { return };
        let found = against_opensim(name, &muscles, |_| ()).unwrap();
        println!("{name}: {found:?}");
        assert!(found.paths > 1000 && found.length < 1e-8 && found.arm < 1e-7, "{name}: {found:?}");
        // OpenSim's own speeds differ from its arms by this much.
        assert!(found.speed < 2e-8, "{name}: {found:?}");
        let spoiled = against_opensim(name, &muscles, |state| state.q[6] += 1e-6).unwrap();
        assert!(spoiled.length > 1e-8 && spoiled.arm > 1e-7, "{name}: {spoiled:?}");
    }
}

/// The state with another value of a free coordinate; followers obey their couplers.
fn moved(model: &Model, state: &State, coordinate: usize, step: f64) -> State {
    let mut moved = state.clone();
    moved.q[coordinate] += step;
    for (i, c) in model.coordinates().iter().enumerate() {
        if let Drive::Coupled(leader, function) = &c.drive {
            moved.q[i] = function.at(moved.q[leader.index()])[0];
        }
    }
    moved
}

#[test]
fn moment_arms_are_the_derivative_of_length() {
    const STEP: f64 = 1e-3;
    for (name, _) in MODELS {
        let Some(muscles) = load(name) else { return };
        let MuscleModel { model, set, .. } = &muscles;
        let mut paths = PathWorkspace::new(model, set, WrapRule::Exact);
        let mut worst = 0.0_f64;
        let mut compared = 0;
        for (_, state) in postures(name, model).unwrap().iter().step_by(7) {
            let state = moved(model, state, 0, 0.0);
            for coordinate in model.coordinate_ids() {
                if !matches!(model.coordinates()[coordinate.index()].drive, Drive::Free) {
                    continue;
                }
                // Seven points: the error is of the sixth order of the step.
                let mut at = |step: f64| {
                    paths.update(moved(model, &state, coordinate.index(), step).posture());
                    let nodes: Vec<usize> = (0..paths.muscles()).map(|i| paths.nodes(i).len()).collect();
                    (paths.lengths().to_vec(), nodes)
                };
                let samples = [-3.0, -2.0, -1.0, 1.0, 2.0, 3.0].map(|n| at(n * STEP));
                paths.update(state.posture());
                for muscle in 0..set.muscles.len() {
                    let nodes = paths.nodes(muscle).len();
                    let is_smooth = samples.iter().all(|(_, counts)| counts[muscle] == nodes);
                    if !is_smooth {
                        continue;
                    }
                    let [a, b, c, d, e, f] = samples.each_ref().map(|(lengths, _)| lengths[muscle]);
                    let slope = ((f - a) - 9.0 * (e - b) + 45.0 * (d - c)) / (60.0 * STEP);
                    worst = worst.max((paths.arm(muscle, coordinate) + slope).abs());
                    compared += 1;
                }
            }
        }
        println!("{name}: {compared} arms within {worst:.1e} of -dL/dq");
        assert!(compared > 1000 && worst < 1e-9, "{name}: {worst:e} in {compared}");
    }
}

#[test]
fn speeds_are_the_rates_of_length() {
    for (name, _) in MODELS {
        let Some(MuscleModel { model, set, .. }) = load(name) else { return };
        let table = Table::read(&format!("paths_{name}.csv")).unwrap();
        for (_, rule) in WrapRule::ALL {
            let mut paths = PathWorkspace::new(&model, &set, rule);
            let (mut by_arms, mut by_opensim) = (0.0_f64, 0.0_f64);
            for (p, (_, state)) in postures(name, &model).unwrap().iter().enumerate() {
                paths.update(state.posture());
                for i in 0..set.muscles.len() {
                    let rate = |id: &CoordinateId| state.qd[id.index()];
                    let sum: f64 = paths.coordinates(i).iter().zip(paths.arms(i)).map(|(id, r)| -r * rate(id)).sum();
                    by_arms = by_arms.max((paths.speeds()[i] - sum).abs());
                    let row = &table.rows[p * set.muscles.len() + i];
                    by_opensim = by_opensim.max((paths.speeds()[i] - table.number(row, "speed_m_s")).abs());
                }
            }
            println!("{name} {rule:?}: {by_arms:.1e} m/s from the arms, {by_opensim:.1e} m/s from OpenSim");
            // The end forces of OpenSim's paths over surfaces are not those of its speeds.
            let found = if rule == WrapRule::Exact { by_arms } else { by_opensim };
            assert!(found < 2e-8, "{name} {rule:?}: {by_arms:e} {by_opensim:e}");
        }
    }
}
