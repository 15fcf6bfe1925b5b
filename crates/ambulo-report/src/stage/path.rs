//! Poses of a body over time.

use ambulo::spatial::{Pose, Vec3, rotation_between};
use nalgebra::{Matrix3, Rotation3, UnitQuaternion};

/// A turn that takes the upward axis y to a direction: the smallest one, or half a turn about x if the direction is
/// down.
pub(crate) fn upward_to(direction: &Vec3) -> UnitQuaternion<f64> {
    let half_a_turn = || Matrix3::from_diagonal(&Vec3::new(1.0, -1.0, -1.0));
    let turn = rotation_between(&Vec3::y(), direction).unwrap_or_else(half_a_turn);
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(turn))
}

/// A rotation as a unit quaternion: x, y, z, w, as in the 3-D view of a page.
#[must_use]
pub fn quaternion(rotation: &Matrix3<f64>) -> [f64; 4] {
    unit_quaternion(rotation).coords.into()
}

fn unit_quaternion(rotation: &Matrix3<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*rotation))
}

/// Positions and orientations, one entry per instant.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BodyPath {
    /// Origin of the body in the world [m].
    pub position: Vec<Vec3>,
    /// World from body; neighbouring quaternions never differ by sign only.
    pub rotation: Vec<UnitQuaternion<f64>>,
}

impl BodyPath {
    /// Without entries, with room for this number of them.
    pub(crate) fn with_room(instants: usize) -> BodyPath {
        BodyPath { position: Vec::with_capacity(instants), rotation: Vec::with_capacity(instants) }
    }

    /// Adds the next instant.
    pub(crate) fn push(&mut self, pose: &Pose) {
        self.push_turned(pose.translation, unit_quaternion(&pose.rotation));
    }

    /// Adds the next instant. q and -q are the same orientation: the one nearer to the last is stored, so that linear
    /// interpolation between neighbours takes the short way.
    pub fn push_turned(&mut self, position: Vec3, rotation: UnitQuaternion<f64>) {
        let flips = self.rotation.last().is_some_and(|last| last.coords.dot(&rotation.coords) < 0.0);
        self.position.push(position);
        self.rotation.push(if flips { UnitQuaternion::new_unchecked(-rotation.into_inner()) } else { rotation });
    }

    /// A point of the body in the world [m].
    #[must_use]
    pub fn place(&self, instant: usize, point: Vec3) -> Vec3 {
        self.position[instant] + self.rotation[instant] * point
    }
}
