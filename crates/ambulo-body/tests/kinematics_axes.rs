//! Rotations from directions, and points in frames.

use ambulo_body::internals::{about_x, about_y, about_z};
use ambulo_body::kinematics::angles_zxy;
use ambulo_body::kinematics::calibration::fit_pose;
use ambulo_body::spatial::{Pose, Vec3};

#[test]
fn angles_reproduce_their_rotation() {
    let angles = [0.4, -0.3, 1.1];
    let found = angles_zxy(&(about_z(angles[0]) * about_x(angles[1]) * about_y(angles[2])));
    for (a, b) in angles.iter().zip(found) {
        assert!((a - b).abs() < 1e-14, "{found:?}");
    }
}

#[test]
fn a_rigid_motion_of_points_is_recovered_and_a_line_is_rejected() {
    let places =
        [Vec3::new(0.1, 0.0, 0.0), Vec3::new(0.0, 0.2, 0.0), Vec3::new(0.0, 0.0, 0.0), Vec3::new(0.0, 0.1, 0.3)];
    let pose = Pose { rotation: about_y(2.0) * about_x(0.3), translation: Vec3::new(1.0, 2.0, 3.0) };
    for count in [3, 4] {
        let points: Vec<Vec3> = places[..count].iter().map(|p| pose.place(*p)).collect();
        let found = fit_pose(&places[..count], &points).unwrap_or(Pose::IDENTITY);
        assert!(
            (found.rotation - pose.rotation).norm() < 1e-12 && (found.translation - pose.translation).norm() < 1e-12
        );
    }
    let line: Vec<Vec3> = (0..4).map(|i| Vec3::x() * f64::from(i)).collect();
    assert!(fit_pose(&line, &line).is_none());
}
