//! Simple rules for ground forces.
//!
//! | claim                                                                             | tolerance and its reason                    |
//! |-----------------------------------------------------------------------------------|---------------------------------------------|
//! | the curves of the smooth transition begin at 1 and end at 0                       | exp(-8) is what is left of the vertical one |
//! | both feet together carry the total force, or the weight                           | rounding                                    |
//! | the whole force is on the foot that stands alone                                  | rounding                                    |
//! | the rules are near the forces of a synthetic walk, and far from those of the other foot | a third of the range                  |

use crate::ground_agreement::{WALK, predicted};
use ambulo::analysis::feasibility::Person;
use ambulo::analysis::{ComparedAnalyses, PlateCoverage, ground_agreement};
use ambulo::ground::{GroundForces, feet};
use ambulo::model::{BySide, Side};
use ambulo::spatial::Vec3;
use ambulo::study::validation::baselines::{Baseline, foot_height, smooth_transition};

#[test]
fn the_curves_of_the_smooth_transition_begin_at_one_and_end_at_zero() {
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} {b}");
    near(smooth_transition::fore_aft(0.0), 1.0);
    near(smooth_transition::fore_aft(2.0), 0.0);
    // The top, but for the straight part, is at two thirds of half the double support.
    let k1 = (4.0_f64 / 9.0).exp();
    near(smooth_transition::fore_aft(2.0 / 3.0), k1 - k1 * (-16.0_f64 / 9.0).exp() / 3.0);
    near(smooth_transition::other(0.0), 1.0);
    near(smooth_transition::other(1.0), (-1.0_f64).exp());
    near(smooth_transition::other(2.0), (-8.0_f64).exp());
}

#[test]
fn the_centre_of_pressure_rolls_from_heel_to_ball_without_turning_back() {
    let shares: Vec<f64> = (-2..=12).map(|i| smooth_transition::roll(f64::from(i) / 10.0)).collect();
    assert!(shares[2].abs() < 1e-12 && (shares[12] - 1.0).abs() < 1e-12);
    assert!(shares.windows(2).all(|pair| pair[1] >= pair[0] - 1e-12), "{shares:?}");
    // Halfway in half of the time, by symmetry.
    assert!((smooth_transition::roll(0.5) - 0.5).abs() < 1e-12);
}

#[test]
fn the_weight_goes_to_the_lower_foot_by_its_height() {
    let shares = |right: f64, left: f64| foot_height::shares(BySide { right, left });
    for heights in [0.0, 0.3] {
        assert!((shares(heights, heights).right - 0.5).abs() < 1e-12);
    }
    let found = shares(0.0, foot_height::HEIGHT_M);
    assert!((found.left / found.right - (-1.0_f64).exp()).abs() < 1e-12);
    assert!((found.left + found.right - 1.0).abs() < 1e-12);
    assert_eq!(shares(-0.1, 0.0), shares(0.0, 0.0), "a foot below the floor is on it");
    // Even weights that are all zero have a sum.
    assert!((shares(1e6, 1e6).right - 0.5).abs() < 1e-12);
}

/// Ground forces of a rule on the synthetic walk.
fn ground(baseline: Baseline) -> GroundForces {
    let whole = predicted(&[]);
    let soles = Person::of_human(&WALK.human).soles;
    baseline.analysis(&WALK.human.model, &whole.analysis, &whole.prediction, &soles).unwrap().ground
}

fn force(ground: &GroundForces, side: Side, frame: usize) -> Vec3 {
    let (_, foot) = feet(&WALK.human.model, ground).into_iter().find(|(of, _)| *of == side).unwrap();
    foot.force[frame]
}

#[test]
fn both_feet_together_carry_the_total_force_or_the_weight() {
    let whole = predicted(&[]);
    let grid = WALK.trajectory.grid();
    let model = &WALK.human.model;
    let weight = model.up() * (model.mass() * model.gravity().norm());
    let [by_height, by_time] = Baseline::ALL.map(ground);
    let mut alone = [0, 0];
    for frame in (0..grid.frames).step_by(7) {
        let time = grid.time(frame);
        let sum = |ground: &GroundForces| force(ground, Side::Right, frame) + force(ground, Side::Left, frame);
        assert!((sum(&by_height) - weight).norm() < 1e-9, "{time}");
        let is_down = |side: Side| {
            let span = |fall: &ambulo::ground::footfalls::Footfall| {
                fall.strike_s.unwrap_or(f64::MIN) <= time && time < fall.off_s.unwrap_or(f64::MAX)
            };
            whole.prediction.footfalls.of(side).any(span)
        };
        let down = Side::BOTH.map(is_down);
        if down != [false, false] {
            assert!((sum(&by_time) - whole.prediction.total[frame].force).norm() < 1e-9, "{time}");
        }
        for (k, side) in Side::BOTH.into_iter().enumerate() {
            if !down[k] {
                assert!(force(&by_time, side, frame).norm() < 1e-12, "{side} {time}");
                alone[k] += 1;
            }
        }
    }
    assert!(alone.iter().all(|count| *count > 5), "{alone:?}");
}

#[test]
fn the_rules_are_near_the_forces_of_a_walk_and_far_from_those_of_the_other_foot() {
    let whole = predicted(&WALK.loads);
    let measured = whole.measured.as_ref().unwrap();
    let coverage = PlateCoverage::by_load(measured, &WALK.loads, &whole.prediction.footfalls);
    let soles = Person::of_human(&WALK.human).soles;
    let model = &WALK.human.model;
    for baseline in Baseline::ALL {
        let found = baseline.analysis(model, &whole.analysis, &whole.prediction, &soles).unwrap();
        let mut swapped = found.clone();
        let [right, left] = &found.ground.bodies[..] else { panic!("two feet") };
        let (mut on_right, mut on_left) = (left.clone(), right.clone());
        (on_right.body, on_left.body) = (right.body, left.body);
        swapped.ground = GroundForces { bodies: [on_right, on_left].into() };
        let agreement = |predicted| {
            let compared = ComparedAnalyses { model, predicted, prediction: &whole.prediction, measured };
            ground_agreement(&compared, &coverage)
        };
        for (own, other) in agreement(&found).feet.iter().zip(&agreement(&swapped).feet) {
            assert!(own.vertical.r > 0.5 && own.vertical.rmse_bw < 0.35, "{baseline:?} {own:?}");
            assert!(other.vertical.rmse_bw > 0.5, "{baseline:?} {other:?}");
        }
    }
}
