//! Feet that sink into the floor, or float above it, in some stances of a level walk.

use ambulo::internals::{Middle, compared};
use ambulo::model::Side;

/// Heights of soles and pelvis at the stances of a foot [m], and what is reported.
fn above_m(heights: &[[f64; 2]]) -> Vec<f64> {
    let middle = |[sole_m, pelvis_m]: &[f64; 2]| Middle { at_s: 0.0, sole_m: *sole_m, pelvis_m: *pelvis_m };
    let middles: Vec<Middle> = heights.iter().map(middle).collect();
    compared(Side::Right, &middles).iter().map(|stance| (1e6 * stance.above_m).round() / 1e6).collect()
}

#[test]
fn a_stance_is_compared_with_the_others_of_its_foot() {
    assert_eq!(above_m(&[[0.02, 1.0], [0.02, 1.005], [-0.02, 0.995]]), [0.0, 0.0, -0.04]);
}

#[test]
fn stances_at_which_the_pelvis_is_higher_or_lower_are_not_judged() {
    assert_eq!(above_m(&[[0.0, 1.0], [0.0, 1.0], [0.0, 1.0], [0.04, 1.03], [-0.17, 0.83]]), [0.0, 0.0, 0.0]);
    let ramp: Vec<[f64; 2]> = (0..5).map(|step| [0.1 * f64::from(step), 1.0 + 0.1 * f64::from(step)]).collect();
    assert_eq!(above_m(&ramp), [0.0]);
}

#[test]
fn of_two_stances_nothing_is_said() {
    assert_eq!(above_m(&[[0.0, 1.0], [-0.04, 1.0]]), [0.0; 0]);
}
