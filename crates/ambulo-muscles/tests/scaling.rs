//! Muscles scaled with their bodies.

use crate::muscle_models::{MODELS, MuscleModel, load, postures};
use ambulo_body::spatial::Vec3;
use ambulo_muscles::path::PathWorkspace;
use ambulo_muscles::set::{MuscleSet, PointPlace, WrapShape};
use ambulo_muscles::wrap::WrapRule;

const SIZE: f64 = 1.1;

/// Ratio of the largest to the smallest of positive numbers, less one.
fn spread(ratios: &[f64]) -> f64 {
    let (least, most) = ratios.iter().fold((f64::MAX, 0.0_f64), |(a, b), r| (a.min(*r), b.max(*r)));
    most / least - 1.0
}

#[test]
fn scaling_a_model_scales_lengths_and_arms() {
    for (name, _) in MODELS {
        let Some(MuscleModel { model, set, .. }) = load(name) else { return };
        let factors = vec![Vec3::repeat(SIZE); model.bodies().len()];
        let larger = model.scaled(&factors, None).unwrap();
        let scaled = set.scaled(&model, &larger, &factors).unwrap();
        let mut own = PathWorkspace::new(&model, &set, WrapRule::Exact);
        let mut grown = PathWorkspace::new(&larger, &scaled, WrapRule::Exact);
        let mut forgotten = PathWorkspace::new(&larger, &set, WrapRule::Exact);
        let mut wrong = 0.0_f64;
        for (_, mut state) in postures(name, &model).unwrap() {
            own.update(state.posture());
            // Coordinates that are lengths of a coupled joint follow the size.
            for (value, coordinate) in state.q.iter_mut().zip(larger.coordinates()) {
                if coordinate.name.ends_with("_tx") || coordinate.name.ends_with("_ty") {
                    *value *= SIZE;
                }
            }
            grown.update(state.posture());
            forgotten.update(state.posture());
            for (i, muscle) in set.muscles.iter().enumerate() {
                let expected = SIZE * own.lengths()[i];
                assert!((grown.lengths()[i] - expected).abs() < 1e-12, "{name} {}", muscle.name);
                for (a, b) in own.arms(i).iter().zip(grown.arms(i)) {
                    assert!((b - SIZE * a).abs() < 1e-11, "{name} {}", muscle.name);
                }
                wrong = wrong.max((forgotten.lengths()[i] - expected).abs());
            }
        }
        assert!(wrong > 1e-3, "without scaled muscles the difference is only {wrong}");
        let ratio = |part: fn(&MuscleSet, usize) -> f64, i: usize| part(&scaled, i) / part(&set, i);
        for i in 0..set.muscles.len() {
            let fiber = ratio(|s, i| s.muscles[i].parameters.optimal_fiber_length, i);
            let tendon = ratio(|s, i| s.muscles[i].parameters.tendon_slack_length, i);
            let force = ratio(|s, i| s.muscles[i].parameters.max_isometric_force, i);
            assert!((fiber - SIZE).abs() < 1e-12 && (tendon - SIZE).abs() < 1e-12 && (force - 1.0).abs() < 1e-15);
        }
    }
}

#[test]
fn unequal_factors_scale_points_surfaces_and_fibres() {
    let Some(MuscleModel { model, set, .. }) = load("rajagopal") else { return };
    let s = Vec3::new(0.9, 1.2, 1.05);
    let factors = vec![s; model.bodies().len()];
    let other = model.scaled(&factors, None).unwrap();
    let scaled = set.scaled(&model, &other, &factors).unwrap();
    let mut ratios = Vec::new();
    for (a, b) in set.muscles.iter().zip(&scaled.muscles) {
        for (p, q) in a.path.points.iter().zip(&b.path.points) {
            if let (PointPlace::Fixed(p), PointPlace::Fixed(q)) = (&p.place, &q.place) {
                assert!((q - s.component_mul(p)).norm() < 1e-15);
            }
        }
        ratios.push(b.parameters.optimal_fiber_length / a.parameters.optimal_fiber_length);
        let tendon = b.parameters.tendon_slack_length / a.parameters.tendon_slack_length;
        assert!((tendon - ratios[ratios.len() - 1]).abs() < 1e-12);
    }
    assert!(spread(&ratios) > 0.05, "every muscle has its own ratio");
    for (a, b) in set.wraps.iter().zip(&scaled.wraps) {
        let (WrapShape::Cylinder { radius, length }, WrapShape::Cylinder { radius: r, length: l }) = (a.shape, b.shape)
        else {
            continue;
        };
        let of = |axis: usize| s.component_mul(&a.pose.rotation.column(axis)).norm();
        assert!((r - radius * (of(0) + of(1)) / 2.0).abs() < 1e-15 && (l - length * of(2)).abs() < 1e-15);
        assert!((b.pose.translation - s.component_mul(&a.pose.translation)).norm() < 1e-15);
    }
}

#[test]
fn factors_of_another_model_are_refused() {
    let Some(MuscleModel { model, set, .. }) = load("gait10dof") else { return };
    let error = set.scaled(&model, &model, &[Vec3::repeat(1.0)]).unwrap_err().to_string();
    assert!(error.contains("factors for 1 bodies; expected 12") || error.contains("factors for 1 bodies"), "{error}");
}
