//! Axes from directions, and medians.

use crate::numerics::median;
use crate::spatial::{Mat3, Pose, Vec3};

/// Shorter than this, two points give no direction [m].
const SHORTEST: f64 = 1e-3;

/// Rounds after which a decomposition of three by three numbers is given up; a dozen are usual.
const SVD_ROUNDS: usize = 200;

/// The direction of a vector, if it has one.
pub(super) fn direction(v: Vec3) -> Option<Vec3> {
    let length = v.norm();
    (length > SHORTEST).then(|| v / length)
}

/// What is left of a vector beside a unit direction, as a direction.
pub(super) fn beside(v: Vec3, unit: Vec3) -> Option<Vec3> {
    direction(v - unit * v.dot(&unit))
}

/// Columns of a rotation.
fn columns(x: Vec3, y: Vec3, z: Vec3) -> Mat3 {
    Mat3::from_columns(&[x, y, z])
}

/// Axes with y exactly along `y`, z as near to `z` as that leaves.
pub(super) fn from_y_z(y: Vec3, z: Vec3) -> Option<Mat3> {
    let y = direction(y)?;
    let z = beside(z, y)?;
    Some(columns(y.cross(&z), y, z))
}

/// Axes with z exactly along `z`, x as near to `x` as that leaves.
pub(super) fn from_z_x(z: Vec3, x: Vec3) -> Option<Mat3> {
    let z = direction(z)?;
    let x = beside(x, z)?;
    Some(columns(x, z.cross(&x), z))
}

/// Axes with z exactly along `z`, y as near to `y` as that leaves.
pub(super) fn from_z_y(z: Vec3, y: Vec3) -> Option<Mat3> {
    let z = direction(z)?;
    let y = beside(y, z)?;
    Some(columns(y.cross(&z), y, z))
}

/// Axes with y exactly along `y`, x as near to `x` as that leaves.
pub(super) fn from_y_x(y: Vec3, x: Vec3) -> Option<Mat3> {
    let y = direction(y)?;
    let x = beside(x, y)?;
    Some(columns(x, y, x.cross(&y)))
}

/// Rotation about x [rad].
pub(super) fn about_x(angle: f64) -> Mat3 {
    let (s, c) = angle.sin_cos();
    Mat3::new(1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c)
}

/// Rotation about y [rad].
pub(super) fn about_y(angle: f64) -> Mat3 {
    let (s, c) = angle.sin_cos();
    Mat3::new(c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c)
}

/// Rotation about z [rad].
pub(super) fn about_z(angle: f64) -> Mat3 {
    let (s, c) = angle.sin_cos();
    Mat3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0)
}

/// Angles [rad] about z, then x, then y that make a rotation: R = R_z R_x R_y.
pub(super) fn angles_zxy(r: &Mat3) -> [f64; 3] {
    [(-r.m12).atan2(r.m22), r.m32.clamp(-1.0, 1.0).asin(), (-r.m31).atan2(r.m33)]
}

/// The middle of some points, coordinate by coordinate [m].
pub(super) fn median_point(points: &[Vec3]) -> Option<Vec3> {
    let one = |axis: usize| median(points.iter().map(|p| p[axis]));
    Some(Vec3::new(one(0)?, one(1)?, one(2)?))
}

/// A point of the world in a frame.
pub(super) fn inside(world_from_frame: &Pose, point: Vec3) -> Vec3 {
    world_from_frame.rotation.transpose() * (point - world_from_frame.translation)
}

/// The pose that brings `places` nearest to `points`, both in the same order, by weighted least squares (Kabsch 1976; unverified).
/// `None` for fewer than three points or points on a line.
pub(super) fn fitted(places: &[Vec3], points: &[Vec3]) -> Option<Pose> {
    let count = places.len();
    if count < 3 || count != points.len() {
        return None;
    }
    let mean = |list: &[Vec3]| list.iter().sum::<Vec3>() / count as f64;
    let (from, to) = (mean(places), mean(points));
    let spread: Mat3 = places.iter().zip(points).map(|(a, b)| (b - to) * (a - from).transpose()).sum();
    if !spread.iter().all(|x| x.is_finite()) {
        return None;
    }
    let svd = spread.try_svd(true, true, f64::EPSILON, SVD_ROUNDS)?;
    let (u, v_t) = (svd.u?, svd.v_t?);
    let mut singular: Vec<f64> = svd.singular_values.iter().copied().collect();
    singular.sort_by(f64::total_cmp);
    // On a line, only one singular value is left.
    if singular[1] < SHORTEST * SHORTEST {
        return None;
    }
    let least = svd.singular_values.imin();
    let mut turn = Mat3::identity();
    turn[(least, least)] = (u * v_t).determinant().signum();
    let rotation = u * turn * v_t;
    Some(Pose { rotation, translation: to - rotation * from })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_make_the_rotation_that_they_were_taken_from() {
        let angles = [0.4, -0.3, 1.1];
        let found = angles_zxy(&(about_z(angles[0]) * about_x(angles[1]) * about_y(angles[2])));
        for (a, b) in angles.iter().zip(found) {
            assert!((a - b).abs() < 1e-14, "{found:?}");
        }
    }

    #[test]
    fn a_moved_cloud_is_found_again_and_a_line_is_refused() {
        let places =
            [Vec3::new(0.1, 0.0, 0.0), Vec3::new(0.0, 0.2, 0.0), Vec3::new(0.0, 0.0, 0.0), Vec3::new(0.0, 0.1, 0.3)];
        let pose = Pose { rotation: about_y(2.0) * about_x(0.3), translation: Vec3::new(1.0, 2.0, 3.0) };
        for count in [3, 4] {
            let points: Vec<Vec3> = places[..count].iter().map(|p| pose.place(*p)).collect();
            let found = fitted(&places[..count], &points).unwrap_or(Pose::IDENTITY);
            assert!(
                (found.rotation - pose.rotation).norm() < 1e-12
                    && (found.translation - pose.translation).norm() < 1e-12
            );
        }
        let line: Vec<Vec3> = (0..4).map(|i| Vec3::x() * f64::from(i)).collect();
        assert!(fitted(&line, &line).is_none());
    }
}
