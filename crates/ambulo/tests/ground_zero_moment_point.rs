//! The expected centre of pressure of feet that stand.

use ambulo::internals::{FootPlace, share_along_soles, zero_moment_point};
use ambulo::model::BySide;
use ambulo::spatial::{Vec3, Wrench};

#[test]
fn the_force_through_the_zero_moment_point_has_no_horizontal_moment() {
    let up = Vec3::y();
    let (place, force) = (Vec3::new(0.3, 0.1, -0.2), Vec3::new(40.0, 700.0, -25.0));
    let free_moment = up * 3.0;
    let total = Wrench { force, moment: place.cross(&force) + free_moment };
    let found = zero_moment_point(&total, 0.1, up, 700.0).unwrap();
    assert!((found - place).norm() < 1e-12, "{found:?}");
    assert!(zero_moment_point(&total, 0.1, up, 7000.0).is_none());
}

#[test]
fn two_feet_share_the_point() {
    let up = Vec3::y();
    let foot = |x: f64, z: f64, turned: f64| FootPlace {
        sole: [Vec3::new(x, 0.0, z), Vec3::new(x + 0.18, 0.0, z + turned), Vec3::new(x + 0.25, 0.0, z + 1.4 * turned)],
        shank: None,
    };
    let feet = BySide { right: foot(0.1, 0.12, 0.03), left: foot(-0.05, -0.1, -0.02) };
    for (share, on_right) in [(0.4, 0.5), (0.7, 0.2), (0.15, 0.9)] {
        let at = |foot: &FootPlace| foot.sole[0] + (foot.sole[2] - foot.sole[0]) * share;
        let point = at(&feet.right) * on_right + at(&feet.left) * (1.0 - on_right);
        let found = share_along_soles(feet.as_ref(), point, up);
        assert!((found - share).abs() < 1e-6, "{found} {share}");
    }
}
