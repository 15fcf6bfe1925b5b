//! Error metrics between predicted forces and force plates.
//!
//! | claim                                              | tolerance and its reason                    |
//! |----------------------------------------------------|---------------------------------------------|
//! | identical forces have no error                     | rounding                                    |
//! | a tenth more force is a relative error of a tenth  | rounding                                    |
//! | time of a stance off the plates is left out        | a frame                                     |

use crate::walks;
use ambulo::analysis::feasibility::Person;
use ambulo::analysis::{
    Analysis, ComparedAnalyses, GroundAgreement, PlateCoverage, PredictedAnalysis, PredictionInput,
    analyse_predicted_trajectory, ground_agreement,
};
use ambulo::findings::Findings;
use ambulo::ground::predict::PredictSettings;
use ambulo::ground::{BodyForces, GroundForces, feet};
use ambulo::model::Side;
use ambulo::motion::ForceRecording;
use ambulo::simulation::synthetic::SyntheticWalk;
use ambulo::spatial::Vec3;
use std::sync::Arc;
use std::sync::LazyLock;

pub(crate) static WALK: LazyLock<&SyntheticWalk> = LazyLock::new(|| walks::corrected(walks::WITHOUT_TOES, 2));

pub(crate) fn predicted(plates: &[ForceRecording]) -> PredictedAnalysis {
    let soles = Person::of_human(&WALK.human).soles;
    let order = PredictionInput { soles: &soles, settings: &PredictSettings::default(), plates_filter: None };
    let (trajectory, mut findings) = (WALK.trajectory.clone(), Findings::default());
    let model = &WALK.human.model;
    analyse_predicted_trajectory(model, trajectory, plates, None, &order, &mut findings).unwrap()
}

fn seen(predicted: &PredictedAnalysis, plates: &[ForceRecording]) -> PlateCoverage {
    PlateCoverage::by_load(predicted.measured.as_ref().unwrap(), plates, &predicted.prediction.footfalls)
}

/// Compares the forces of the plates with a changed copy of them as the prediction.
fn against(change: impl Fn(&mut Analysis)) -> GroundAgreement {
    let whole = predicted(&WALK.loads);
    let measured = whole.measured.as_ref().unwrap();
    let mut changed = measured.clone();
    change(&mut changed);
    let model = &WALK.human.model;
    let compared = ComparedAnalyses { model, predicted: &changed, prediction: &whole.prediction, measured };
    ground_agreement(&compared, &seen(&whole, &WALK.loads))
}

/// Measured forces of each foot.
fn of_feet(analysis: &Analysis) -> Vec<BodyForces> {
    feet(&WALK.human.model, &analysis.ground).into_iter().map(|(_, forces)| forces.into_owned()).collect()
}

#[test]
fn identical_forces_have_no_error() {
    let same = against(|_| ());
    assert_eq!(same.feet.iter().map(|foot| foot.side.letter()).collect::<String>(), "rl");
    for foot in &same.feet {
        assert!(foot.samples > 60, "{} samples", foot.samples);
        for force in [foot.vertical, foot.fore_aft] {
            assert!(force.rmse_bw < 1e-12 && force.rrmse < 1e-12 && (force.r - 1.0).abs() < 1e-9, "{force:?}");
        }
        let center = &foot.center_of_pressure;
        assert!(center.fore_aft_mm < 1e-9 && center.lateral_weighted_mm < 1e-9 && center.missing == 0, "{center:?}");
    }
    assert_eq!(same.moments.len(), 6, "hip, knee and ankle of two legs");
    assert!(same.moments.iter().all(|moment| moment.rmse_nm < 1e-9 && moment.samples > 100), "{:?}", same.moments);
}

#[test]
fn forces_that_are_a_tenth_larger_have_a_relative_error_of_a_tenth() {
    let larger = against(|analysis| {
        for foot in Arc::make_mut(&mut analysis.ground.bodies) {
            foot.force.iter_mut().for_each(|force| *force *= 1.1);
        }
    });
    let whole = predicted(&WALK.loads);
    let measured = whole.measured.as_ref().unwrap();
    let (grid, right) = (measured.trajectory.grid(), &of_feet(measured)[0]);
    let [from, to] = larger.feet[0].stances_s[0];
    let loaded = |i: &usize| {
        let time = grid.time(*i);
        larger.feet[0].stances_s.iter().any(|s| (s[0]..=s[1]).contains(&time)) && right.force[*i].y > 20.0
    };
    let squares: Vec<f64> = (0..grid.frames).filter(loaded).map(|i| right.force[i].y.powi(2)).collect();
    let rms = (squares.iter().sum::<f64>() / squares.len() as f64).sqrt();
    let expected = 0.1 * rms / (75.0 * 9.80665);
    let found = larger.feet[0].vertical;
    assert!((found.rmse_bw - expected).abs() < 0.02 * expected, "{} instead of {expected} BW", found.rmse_bw);
    assert!((found.r - 1.0).abs() < 1e-9 && to - from > 0.5, "a scale leaves the correlation: {}", found.r);
}

#[test]
fn swapped_feet_give_large_errors() {
    let exchanged = against(|analysis| {
        let [right, left] = &of_feet(analysis)[..] else { panic!("two feet") };
        let (mut on_right, mut on_left) = (left.clone(), right.clone());
        (on_right.body, on_left.body) = (right.body, left.body);
        analysis.ground = GroundForces { bodies: [on_right, on_left].into() };
    });
    for foot in &exchanged.feet {
        assert!(foot.vertical.rmse_bw > 0.5 && foot.vertical.r < 0.0, "{:?}", foot.vertical);
        assert!(foot.center_of_pressure.missing > 0, "the other foot swings");
    }
}

#[test]
fn time_of_a_stance_off_the_plates_is_left_out() {
    let grid = WALK.trajectory.grid();
    let whole = predicted(&WALK.loads);
    let [from, to] = seen(&whole, &WALK.loads).window.unwrap();
    assert!(from < grid.start_s + 0.05 && to > grid.end_s() - 0.05, "{from} to {to} s: every foot was on a plate");
    // The left foot's second whole stance was on the floor.
    let (_, [missed_from, missed_to]) =
        seen(&whole, &WALK.loads).stances.into_iter().filter(|(side, _)| *side == Side::Left).nth(1).unwrap();
    let mut plates = WALK.loads.clone();
    let left = |plate: &&mut ForceRecording| {
        Side::of_name(&WALK.human.model.bodies()[plate.body.index()].name) == Some(Side::Left)
    };
    for plate in plates.iter_mut().filter(left) {
        for i in 0..plate.times.len() {
            if (missed_from - 0.05..=missed_to + 0.05).contains(&plate.times[i]) {
                plate.force[i] = Vec3::zeros();
                plate.moment[i] = Vec3::zeros();
            }
        }
    }
    let partly = predicted(&plates);
    let found = seen(&partly, &plates);
    let [from, to] = found.window.unwrap();
    assert!(
        to < missed_from + 0.06 || from > missed_to - 0.06,
        "{from} to {to} s; missed {missed_from} to {missed_to}"
    );
    assert!(found.stances.iter().all(|(side, s)| *side == Side::Right || (s[0] - missed_from).abs() > 0.1));
}

#[test]
fn frames_beyond_the_plate_recording_are_left_out() {
    let grid = WALK.trajectory.grid();
    let middle = 0.5 * (grid.start_s + grid.end_s());
    let mut plates = WALK.loads.clone();
    for plate in &mut plates {
        let kept = plate.times.partition_point(|t| *t <= middle);
        plate.times.truncate(kept);
        plate.force.truncate(kept);
        plate.point.truncate(kept);
        plate.moment.truncate(kept);
    }
    let partly = predicted(&plates);
    let measured = of_feet(partly.measured.as_ref().unwrap());
    let after = |i: &usize| grid.time(*i) > middle + grid.step_s * 1.5;
    let total = |i: usize| measured.iter().map(|foot| foot.force[i].norm()).sum::<f64>();
    assert!((0..grid.frames).filter(after).all(|i| total(i) < f64::MIN_POSITIVE), "a force that was not measured");
    assert!((0..grid.frames).filter(|i| grid.time(*i) < middle).all(|i| total(i) > 300.0));
    let found = seen(&partly, &plates);
    assert!(found.window.unwrap()[1] <= middle && found.stances.iter().all(|(_, s)| s[1] <= middle), "{found:?}");
    // The prediction continues.
    assert!(partly.analysis.ground.bodies.iter().any(|foot| foot.force[grid.frames - 5].y > 300.0));
}
