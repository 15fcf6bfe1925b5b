//! Reads orientations of sensors (`.sto` with quaternions), for a model or for the built-in body.

use ambulo::internals::about_fixed_axes;
use ambulo::kinematics::sensor_fit::SensorAxes;
use ambulo::spatial::Vec3;

#[test]
fn turns_about_fixed_axes_follow_each_other() {
    let quarter = std::f64::consts::FRAC_PI_2;
    let up = about_fixed_axes([-quarter, 0.0, 0.0]) * Vec3::z();
    assert!((up - Vec3::y()).norm() < 1e-15, "z up becomes y up: {up}");
    let (default, own) = (SensorAxes::default().world_from_earth, about_fixed_axes([-quarter, 0.0, 0.0]));
    assert!((default - own).norm() < 1e-15);
    // x, about z to y after x about itself.
    let turned = about_fixed_axes([0.3, 0.0, quarter]) * Vec3::x();
    assert!((turned - Vec3::y()).norm() < 1e-15, "{turned}");
    let turned = about_fixed_axes([0.0, quarter, quarter]) * Vec3::z();
    assert!((turned - Vec3::y()).norm() < 1e-15, "z to x about y, then to y about z: {turned}");
}
