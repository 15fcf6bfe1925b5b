//! Frames of documents as poses, and back.

use crate::spatial::{Mat3, Pose, Vec3};
use ambulo_formats::osim::OsimFrame;

/// The pose of a frame in its body.
pub fn pose(frame: &OsimFrame) -> Pose {
    let [a, b, c] = frame.rotation;
    let rotation = Mat3::new(a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]);
    Pose { rotation, translation: Vec3::from(frame.translation_m) }
}

/// The frame with this pose in a body.
pub fn frame(body: String, pose: &Pose) -> OsimFrame {
    let row = |i: usize| std::array::from_fn(|j| pose.rotation[(i, j)]);
    OsimFrame { body, rotation: [row(0), row(1), row(2)], translation_m: pose.translation.into() }
}
