//! Signs and sides of the laws of angles outside the sagittal plane and of joint moments, in clinical terms, at free
//! speed.
//!
//! Phases are shares of the cycle of the right foot: 0 is right foot strike, 0.1 to 0.5 is right single support, 0.6
//! right foot off.

use ambulo::gait::{Jet, JointMomentLaws, JointMoments, OtherPlaneLaws, OtherPlanes};

/// Free walking, V / sqrt(g L).
const FREE: f64 = 0.429;

fn planes(phase: f64) -> OtherPlanes {
    OtherPlaneLaws::built_in().unwrap().at(Jet::constant(phase), Jet::constant(FREE))
}

fn moments(phase: f64) -> JointMoments {
    JointMomentLaws::built_in().unwrap().at(phase, FREE)
}

/// Angles from one phase to another, every percent of the cycle [deg].
fn angles(from: f64, to: f64, angle: impl Fn(OtherPlanes) -> Jet) -> Vec<f64> {
    phases(from, to).map(|phase| angle(planes(phase)).value.to_degrees()).collect()
}

fn phases(from: f64, to: f64) -> impl Iterator<Item = f64> {
    let count = ((to - from) * 100.0).round() as i32;
    (0..=count).map(move |k| from + 0.01 * f64::from(k))
}

fn all_above(values: &[f64], limit: f64) {
    assert!(values.iter().all(|value| *value > limit), "{values:.2?} are not all above {limit}");
}

fn all_below(values: &[f64], limit: f64) {
    assert!(values.iter().all(|value| *value < limit), "{values:.2?} are not all below {limit}");
}

#[test]
fn the_pelvis_is_up_on_the_stance_side_in_early_stance() {
    all_above(&angles(0.10, 0.22, |p| p.pelvis[0]), 2.0);
    all_below(&angles(0.60, 0.72, |p| p.pelvis[0]), -2.0);
}

#[test]
fn the_pelvis_is_forward_on_the_side_of_the_foot_strike() {
    all_above(&angles(0.0, 0.12, |p| p.pelvis[1]), 2.0);
    all_below(&angles(0.5, 0.62, |p| p.pelvis[1]), -2.0);
}

#[test]
fn the_trunk_turns_and_leans_against_the_pelvis() {
    all_below(&angles(0.06, 0.22, |p| p.trunk[0]), -3.0);
    all_above(&angles(0.56, 0.72, |p| p.trunk[0]), 3.0);
    all_below(&angles(0.0, 0.08, |p| p.trunk[1]), -2.0);
    all_above(&angles(0.5, 0.58, |p| p.trunk[1]), 2.0);
}

#[test]
fn the_hip_is_adducted_in_stance_and_abducted_in_early_swing() {
    all_above(&angles(0.12, 0.45, |p| p.hips[0][0]), 1.0);
    all_below(&angles(0.60, 0.75, |p| p.hips[0][0]), -3.0);
    // The left hip, half a cycle later.
    all_above(&angles(0.62, 0.95, |p| p.hips[1][0]), 1.0);
    all_below(&angles(0.10, 0.25, |p| p.hips[1][0]), -3.0);
}

#[test]
fn the_hip_is_rotated_externally_at_foot_off() {
    let mean = |angles: &[f64]| angles.iter().sum::<f64>() / angles.len() as f64;
    for (hip, later) in [(0, 0.0), (1, 0.5)] {
        let early = mean(&angles(0.10 + later, 0.20 + later, |p| p.hips[hip][1]));
        let foot_off = angles(0.56 + later, 0.66 + later, |p| p.hips[hip][1]);
        all_below(&foot_off, -3.0);
        assert!(mean(&foot_off) < early - 2.0, "hip {hip}: {early} deg in early stance, {foot_off:.2?} at foot off");
    }
}

#[test]
fn the_hip_extends_at_loading_and_flexes_before_foot_off() {
    let moment = |from, to| phases(from, to).map(|phase| moments(phase).hip_extension).collect::<Vec<_>>();
    all_above(&moment(0.04, 0.18), 0.02);
    all_below(&moment(0.42, 0.60), -0.02);
}

#[test]
fn the_knee_extends_at_loading_and_flexes_in_terminal_stance() {
    let moment = |from, to| phases(from, to).map(|phase| moments(phase).knee_extension).collect::<Vec<_>>();
    all_above(&moment(0.10, 0.18), 0.02);
    all_below(&moment(0.32, 0.44), -0.01);
}

#[test]
fn the_ankle_plantarflexes_with_its_largest_moment_in_late_stance() {
    let curve: Vec<f64> = phases(0.0, 1.0).map(|phase| moments(phase).plantarflexion).collect();
    let largest = (0..curve.len()).max_by(|a, b| curve[*a].total_cmp(&curve[*b])).unwrap();
    assert!((42..=52).contains(&largest), "largest at {largest} %");
    all_above(&curve[20..=54], 0.02);
    // Dorsiflexors lower the foot after the strike.
    all_below(&curve[4..=7], 0.0);
}

#[test]
fn the_hip_abducts_through_stance_with_two_humps() {
    let curve: Vec<f64> = phases(0.0, 1.0).map(|phase| moments(phase).hip_abduction).collect();
    all_above(&curve[10..=52], 0.02);
    let largest = |from: usize, to: usize| curve[from..=to].iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let valley = curve[22..=40].iter().copied().fold(f64::INFINITY, f64::min);
    let (first, second) = (largest(12, 22), largest(40, 52));
    assert!(first > 1.1 * valley && second > 1.1 * valley, "humps {first:.3} and {second:.3}, valley {valley:.3}");
    assert!(curve[62..].iter().all(|moment| moment.abs() < 0.02), "swing: {:.3?}", &curve[62..]);
}
