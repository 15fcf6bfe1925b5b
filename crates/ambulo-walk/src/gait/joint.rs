//! The joints of a leg that a gait moves.

pub use crate::model::full_body::STANDING_TILT;

use crate::model::Side;

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

    /// Accepted angles [rad]; angles outside are probably typing errors. The range has a margin around the passive
    /// ranges of adults in textbooks (hip -30°..120°, knee -10°..150°, ankle -50°..30°; unverified).
    #[must_use]
    pub(crate) fn plausible(self) -> [f64; 2] {
        match self {
            LegJoint::Hip => [-45.0, 130.0],
            LegJoint::Knee => [-15.0, 160.0],
            LegJoint::Ankle => [-60.0, 50.0],
        }
        .map(|degrees| degrees * DEGREE)
    }
}

/// A part of the figure that a gait moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum WalkPart {
    /// A joint of a leg; flexion and dorsiflexion +.
    Leg(Side, LegJoint),
    /// Anterior tilt of the pelvis.
    Pelvis,
    /// Forward lean of the trunk.
    Trunk,
    /// Flexion of a shoulder.
    Shoulder(Side),
    /// Flexion of an elbow.
    Elbow(Side),
}

impl WalkPart {
    /// All parts.
    pub const ALL: [WalkPart; 12] = {
        use Side::{Left, Right};
        [
            WalkPart::Leg(Right, LegJoint::Hip),
            WalkPart::Leg(Right, LegJoint::Knee),
            WalkPart::Leg(Right, LegJoint::Ankle),
            WalkPart::Leg(Left, LegJoint::Hip),
            WalkPart::Leg(Left, LegJoint::Knee),
            WalkPart::Leg(Left, LegJoint::Ankle),
            WalkPart::Pelvis,
            WalkPart::Trunk,
            WalkPart::Shoulder(Right),
            WalkPart::Shoulder(Left),
            WalkPart::Elbow(Right),
            WalkPart::Elbow(Left),
        ]
    };

    /// Name in files and tables, such as `right knee`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            WalkPart::Leg(Side::Right, LegJoint::Hip) => "right hip",
            WalkPart::Leg(Side::Right, LegJoint::Knee) => "right knee",
            WalkPart::Leg(Side::Right, LegJoint::Ankle) => "right ankle",
            WalkPart::Leg(Side::Left, LegJoint::Hip) => "left hip",
            WalkPart::Leg(Side::Left, LegJoint::Knee) => "left knee",
            WalkPart::Leg(Side::Left, LegJoint::Ankle) => "left ankle",
            WalkPart::Pelvis => "pelvis",
            WalkPart::Trunk => "trunk",
            WalkPart::Shoulder(Side::Right) => "right shoulder",
            WalkPart::Shoulder(Side::Left) => "left shoulder",
            WalkPart::Elbow(Side::Right) => "right elbow",
            WalkPart::Elbow(Side::Left) => "left elbow",
        }
    }

    /// The side whose cycle the part follows; pelvis and trunk follow the right one.
    #[must_use]
    pub fn side(self) -> Side {
        match self {
            WalkPart::Leg(side, _) | WalkPart::Shoulder(side) | WalkPart::Elbow(side) => side,
            WalkPart::Pelvis | WalkPart::Trunk => Side::Right,
        }
    }

    /// The parts of a name: `knee` is both knees, `left knee` is one, `trunk` is one.
    #[must_use]
    pub fn of_name(name: &str) -> Vec<WalkPart> {
        let of_both = |part: &WalkPart| part.name().split_once(' ').is_some_and(|(_, joint)| joint == name);
        WalkPart::ALL.into_iter().filter(|part| part.name() == name || of_both(part)).collect()
    }

    /// Accepted angles [rad]: the ranges of the joints of a leg, and half a turn for other joints.
    #[must_use]
    pub(crate) fn plausible(self) -> [f64; 2] {
        match self {
            WalkPart::Leg(_, joint) => joint.plausible(),
            _ => [-std::f64::consts::PI, std::f64::consts::PI],
        }
    }
}
