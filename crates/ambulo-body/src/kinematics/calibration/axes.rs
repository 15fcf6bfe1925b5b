//! Rotations from directions, and points in frames.

use crate::numerics::elementary::{asin, atan2, sin_cos};
use crate::numerics::{median, sort_numbers};
use crate::spatial::{Mat3, Pose, Vec3};

/// Smallest distance of two points that define a direction [m].
const SHORTEST: f64 = 1e-3;

/// Largest number of iterations of a singular value decomposition; a dozen are usual.
const SVD_ROUNDS: usize = 200;

/// Unit vector along a vector; `None` if it is too short.
pub(super) fn direction(v: Vec3) -> Option<Vec3> {
    let length = v.norm();
    (length > SHORTEST).then(|| v / length)
}

/// Direction of the part of a vector perpendicular to a unit vector.
pub(super) fn perpendicular(v: Vec3, unit: Vec3) -> Option<Vec3> {
    direction(v - unit * v.dot(&unit))
}

fn columns(x: Vec3, y: Vec3, z: Vec3) -> Mat3 {
    Mat3::from_columns(&[x, y, z])
}

/// Rotation with y along `y` and z as near as possible to `z`.
pub(super) fn from_y_z(y: Vec3, z: Vec3) -> Option<Mat3> {
    let y = direction(y)?;
    let z = perpendicular(z, y)?;
    Some(columns(y.cross(&z), y, z))
}

/// Rotation with z along `z` and x as near as possible to `x`.
pub(super) fn from_z_x(z: Vec3, x: Vec3) -> Option<Mat3> {
    let z = direction(z)?;
    let x = perpendicular(x, z)?;
    Some(columns(x, z.cross(&x), z))
}

/// Rotation with z along `z` and y as near as possible to `y`.
pub(super) fn from_z_y(z: Vec3, y: Vec3) -> Option<Mat3> {
    let z = direction(z)?;
    let y = perpendicular(y, z)?;
    Some(columns(y.cross(&z), y, z))
}

/// Rotation with y along `y` and x as near as possible to `x`.
pub(super) fn from_y_x(y: Vec3, x: Vec3) -> Option<Mat3> {
    let y = direction(y)?;
    let x = perpendicular(x, y)?;
    Some(columns(x, y, x.cross(&y)))
}

/// Rotation about x [rad].
pub fn about_x(angle: f64) -> Mat3 {
    let (s, c) = sin_cos(angle);
    Mat3::new(1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c)
}

/// Rotation about y [rad].
pub fn about_y(angle: f64) -> Mat3 {
    let (s, c) = sin_cos(angle);
    Mat3::new(c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c)
}

/// Rotation about z [rad].
pub fn about_z(angle: f64) -> Mat3 {
    let (s, c) = sin_cos(angle);
    Mat3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0)
}

/// Angles [rad] about z, x and y of a rotation R = R_z R_x R_y.
pub fn angles_zxy(r: &Mat3) -> [f64; 3] {
    [atan2(-r.m12, r.m22), asin(r.m32.clamp(-1.0, 1.0)), atan2(-r.m31, r.m33)]
}

/// Median of some points, coordinate by coordinate [m].
pub(super) fn median_point(points: &[Vec3]) -> Option<Vec3> {
    let one = |axis: usize| median(points.iter().map(|p| p[axis]));
    Some(Vec3::new(one(0)?, one(1)?, one(2)?))
}

/// Coordinates of a point of the world in a frame.
pub(super) fn in_frame(world_from_frame: &Pose, point: Vec3) -> Vec3 {
    world_from_frame.rotation.transpose() * (point - world_from_frame.translation)
}

/// The pose that maps `places` to `points`, in the same order, with least squares (Kabsch 1976; unverified).
/// `None` for fewer than three points or points on a line.
pub fn fit_pose(places: &[Vec3], points: &[Vec3]) -> Option<Pose> {
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
    sort_numbers(&mut singular);
    // Points on a line have only one singular value.
    if singular[1] < SHORTEST * SHORTEST {
        return None;
    }
    let least = svd.singular_values.imin();
    let mut turn = Mat3::identity();
    turn[(least, least)] = (u * v_t).determinant().signum();
    let rotation = u * turn * v_t;
    Some(Pose { rotation, translation: to - rotation * from })
}
