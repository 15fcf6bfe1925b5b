//! The walking direction of each stance.

use ambulo::internals::WalkingDirection;
use ambulo::spatial::Vec3;

/// A pelvis that moves along a line at an angle to world x for 1 s.
fn going(angle_rad: f64, speed_m_s: f64, floor_velocity: Vec3) -> WalkingDirection {
    let along = Vec3::new(angle_rad.cos(), 0.0, angle_rad.sin()) * speed_m_s + floor_velocity;
    let times: Vec<f64> = (0..=100).map(|i| f64::from(i) * 0.01).collect();
    let pelvis = times.iter().map(|t| along * *t + Vec3::y()).collect();
    WalkingDirection { up: Vec3::y(), floor_velocity, times, pelvis }
}

#[test]
fn a_turn_has_its_own_axes_and_sway_keeps_the_world_axes() {
    let axes = |angle_deg: f64, speed| going(f64::to_radians(angle_deg), speed, Vec3::zeros()).during([0.2, 0.8]);
    let [forward, right] = axes(45.0, 1.2);
    assert!((forward - Vec3::new(0.5_f64.sqrt(), 0.0, 0.5_f64.sqrt())).norm() < 1e-12, "{forward}");
    assert!((right - Vec3::new(-(0.5_f64.sqrt()), 0.0, 0.5_f64.sqrt())).norm() < 1e-12, "{right}");
    for [forward, right] in [axes(19.0, 1.2), axes(90.0, 0.05)] {
        assert_eq!([forward, right], [Vec3::x(), Vec3::z()], "sways, stands");
    }
    assert!(axes(21.0, 1.2)[0].z > 0.3, "beyond swaying");
}

#[test]
fn the_displacement_is_relative_to_the_belt() {
    let belt = going(std::f64::consts::FRAC_PI_2, 1.0, Vec3::new(0.0, 0.0, -1.0)).during([0.0, 1.0]);
    assert!((belt[0] - Vec3::z()).norm() < 1e-12, "{}", belt[0]);
}
