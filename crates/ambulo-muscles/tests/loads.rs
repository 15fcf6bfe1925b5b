//! Tensions as loads on bodies: inverse dynamics of the loads gives back the moment arms.

use crate::muscle_models::{MODELS, MuscleModel, load, postures};
use ambulo_body::dynamics::{Workspace, inverse_frame};
use ambulo_body::model::Drive;
use ambulo_muscles::path::PathWorkspace;
use ambulo_muscles::wrap::WrapRule;

/// Largest difference between the generalised forces of tensions by inverse dynamics and by moment arms [N.m].
fn difference(name: &str, with_gears: bool) -> Option<f64> {
    let MuscleModel { model, set, .. } = load(name)?;
    let mut paths = PathWorkspace::new(&model, &set, WrapRule::Exact);
    let mut dynamics = Workspace::new(&model);
    let tensions: Vec<f64> = (0..set.muscles.len()).map(|i| 100.0 + 37.0 * (i % 11) as f64).collect();
    let mut loads = Vec::new();
    let mut worst = 0.0_f64;
    for (_, state) in postures(name, &model)? {
        paths.update(state.posture());
        paths.loads(&tensions, &mut loads);
        let bare = inverse_frame(&mut dynamics, state.posture(), &[]).generalized().to_vec();
        let loaded = inverse_frame(&mut dynamics, state.posture(), &loads).generalized().to_vec();
        // Loads take over a part of the forces that the motion needs.
        let mut forces: Vec<f64> = bare.iter().zip(&loaded).map(|(a, b)| a - b).collect();
        if with_gears {
            paths.add_gear_forces(&tensions, &mut forces);
        }
        let mut effective = forces.clone();
        for (i, coordinate) in model.coordinates().iter().enumerate() {
            if let Drive::Coupled(leader, function) = &coordinate.drive {
                effective[leader.index()] += function.at(state.q[leader.index()])[1] * forces[i];
            }
        }
        for id in model.coordinate_ids() {
            if matches!(model.coordinates()[id.index()].drive, Drive::Coupled(..)) {
                continue;
            }
            let by_arms: f64 = tensions.iter().enumerate().map(|(i, t)| t * paths.arm(i, id)).sum();
            worst = worst.max((effective[id.index()] - by_arms).abs());
        }
    }
    Some(worst)
}

#[test]
fn tensions_as_loads_have_the_moments_of_their_arms() {
    for (name, _) in MODELS {
        let Some(worst) = difference(name, true) else { return };
        println!("{name}: {worst:.1e} N.m");
        // Largest moments are about 1000 N.m.
        assert!(worst < 1e-9, "{name}: {worst:e}");
    }
    // Moving points do work against the mechanism that moves them.
    let Some(worst) = difference("gait2392", false) else { return };
    assert!(worst > 1.0, "{worst}");
}
