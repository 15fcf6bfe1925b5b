//! Converts a posture to coordinates of a model, by their names.
//!
//! The signs of the models (docs/CONVENTIONS.md) differ from clinical ones at the knee (extension +), at the pelvis and
//! at the lumbar joint (backwards +). The pelvic tilt of a model is 0 in upright standing; the clinical tilt is then
//! [`STANDING_TILT`](super::STANDING_TILT) forwards, which is subtracted. The direction of the thigh, hip flexion minus
//! pelvic tilt, is the same in all conventions.
//!
//! ```text
//! thigh = hip - tilt                                                     forward of the vertical
//! own pelvis:            forward = tilt - standing,   hip_flexion = thigh + forward = hip - standing
//!                        pelvis_tilt = -forward,      lumbar_extension = forward - lean
//! pelvis in the trunk:   forward = lean,    hip_flexion = thigh + lean,    pelvis_tilt = -lean,   lumbar_extension = 0
//! ```

use super::jet::Jet;
use super::walk::WalkPosture;
use crate::model::{CoordinateId, Model};

/// Whether the pelvis of a model moves relative to its trunk.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Trunk {
    /// Pelvis and trunk are two bodies with the joint `lumbar_extension`.
    WithPelvis,
    /// Pelvis and trunk are one body.
    OneBody,
}

impl Trunk {
    /// The trunk of a model.
    #[must_use]
    pub fn of(model: &Model) -> Trunk {
        if model.coordinate("lumbar_extension").is_some() { Trunk::WithPelvis } else { Trunk::OneBody }
    }
}

/// Names of the coordinates of a posture, in the order of [`coordinates`].
pub const COORDINATE_NAMES: [&str; 12] = [
    "pelvis_tilt",
    "lumbar_extension",
    "hip_flexion_r",
    "knee_angle_r",
    "ankle_angle_r",
    "hip_flexion_l",
    "knee_angle_l",
    "ankle_angle_l",
    "arm_flex_r",
    "elbow_flex_r",
    "arm_flex_l",
    "elbow_flex_l",
];

/// The model's coordinates [rad] of a posture, one for each of [`COORDINATE_NAMES`].
#[must_use]
pub fn coordinates(posture: &WalkPosture, trunk: Trunk) -> [Jet; 12] {
    let forward = match trunk {
        Trunk::WithPelvis => posture.pelvis_tilt - posture.standing_tilt,
        Trunk::OneBody => posture.trunk_lean,
    };
    let hip = |hip: Jet| hip - posture.pelvis_tilt + forward;
    let (right, left) = (&posture.right, &posture.left);
    [
        -forward,
        forward - posture.trunk_lean,
        hip(right.hip),
        -right.knee,
        right.ankle,
        hip(left.hip),
        -left.knee,
        left.ankle,
        posture.shoulders[0],
        posture.elbows[0],
        posture.shoulders[1],
        posture.elbows[1],
    ]
}

/// The joints of a model that a walk moves.
#[derive(Debug, Clone, PartialEq)]
pub struct WalkCoordinates {
    trunk: Trunk,
    ids: [Option<CoordinateId>; 12],
}

impl WalkCoordinates {
    /// The coordinates of a model with the names of [`COORDINATE_NAMES`]; others are not changed.
    #[must_use]
    pub fn of(model: &Model) -> WalkCoordinates {
        WalkCoordinates { trunk: Trunk::of(model), ids: COORDINATE_NAMES.map(|name| model.coordinate(name)) }
    }

    /// Writes coordinates, rates and accelerations of a posture to arrays of a model.
    pub fn write(&self, posture: &WalkPosture, q: &mut [f64], qd: &mut [f64], qdd: &mut [f64]) {
        for (id, jet) in self.ids.iter().zip(coordinates(posture, self.trunk)) {
            if let Some(id) = id {
                q[id.index()] = jet.value;
                qd[id.index()] = jet.rate;
                qdd[id.index()] = jet.acceleration;
            }
        }
    }

    /// Names of the coordinates that are written.
    pub fn names(&self) -> impl Iterator<Item = &'static str> {
        self.ids.iter().zip(COORDINATE_NAMES).filter_map(|(id, name)| id.map(|_| name))
    }
}
