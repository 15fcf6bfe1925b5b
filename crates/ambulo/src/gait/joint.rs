//! The joints of a leg that a gait moves.

pub use crate::model::full_body::STANDING_TILT;

/// One degree [rad].
const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// A joint of the leg in the sagittal plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum LegJoint {
    /// Hip; flexion +, thigh relative to pelvis.
    Hip,
    /// Knee; flexion +.
    Knee,
    /// Ankle; dorsiflexion +.
    Ankle,
}

impl LegJoint {
    /// All joints, from the pelvis down.
    pub const ALL: [LegJoint; 3] = [LegJoint::Hip, LegJoint::Knee, LegJoint::Ankle];

    /// Name in files and tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            LegJoint::Hip => "hip",
            LegJoint::Knee => "knee",
            LegJoint::Ankle => "ankle",
        }
    }

    /// Angle in upright standing [rad]; step length and step height scale the difference from it.
    #[must_use]
    pub fn neutral(self) -> f64 {
        match self {
            LegJoint::Hip => STANDING_TILT,
            LegJoint::Knee | LegJoint::Ankle => 0.0,
        }
    }

    /// Accepted angles [rad]; angles outside are probably typing errors. The range has a margin around the passive ranges of adults in
    /// textbooks (hip -30°..120°, knee -10°..150°, ankle -50°..30°; unverified).
    #[must_use]
    pub fn plausible(self) -> [f64; 2] {
        match self {
            LegJoint::Hip => [-45.0, 130.0],
            LegJoint::Knee => [-15.0, 160.0],
            LegJoint::Ankle => [-60.0, 50.0],
        }
        .map(|degrees| degrees * DEGREE)
    }
}
