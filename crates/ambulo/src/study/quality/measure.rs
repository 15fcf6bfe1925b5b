//! Measures of the quality of data, with the limits beyond which they are doubtful or bad.

use super::super::timing::MOST_OFFSET_M;
use super::{QualityReason, QualityState};
use crate::analysis::feasibility::LARGE_RESIDUAL_BW;
use crate::findings::word;
use crate::kinematics::WRONG_CLOCK;
use serde::{Deserialize, Serialize};

/// A measure of the quality of data.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// Residual force.
    ResidualForce,
    /// Residual moment about the root.
    ResidualMoment,
    /// Share of the motion with ground forces.
    GroundForces,
    /// Share of the motion with measured ground forces.
    MeasuredForces,
    /// Whether there is no time in which the measured forces can be compared with the motion.
    UncheckedForces,
    /// Whether none of the stances of a leg that stood on plates was measured, while those of the other leg were.
    UnmeasuredLeg,
    /// Share of the measured load that lies under no foot.
    UnassignedForces,
    /// Share of the stances on force plates that show no load.
    SilentPlates,
    /// Number of measured forces of which a part is missing or wrong.
    LostForces,
    /// Agreement of the horizontal forces with the direction from the centre of pressure to the mass centre.
    ForceDirections,
    /// Distance of the markers or joints of pelvis and legs from the fitted body.
    MarkerFit,
    /// Distance of the markers or joints of trunk and head from the fitted body.
    TrunkFit,
    /// Distance of standing markers from the scaled model.
    Scaling,
    /// Ratio of scale factors.
    ScaleFactors,
    /// Number of contradictions between the labels of markers, the standing trial and the person.
    WhoseMarkers,
    /// Number of coordinates of pelvis and legs that are not measured.
    NotMeasured,
    /// Difference of the body mass from that on the plates.
    Mass,
    /// Body mass index, relative to the range of people who walk.
    BodyMassIndex,
    /// Share of the frames with an unknown posture.
    Gaps,
    /// Speed of loaded soles along the ground.
    Sliding,
    /// Distance of the measured centre of pressure from the sole.
    CenterOfPressure,
    /// Distance of the measured centres of pressure from the lines of the soles, to one side.
    PlatePlace,
    /// Distance of the measured centre of pressure from where the motion needs it, along a foot that stands alone.
    CenterOffset,
    /// Distance of the sole of a stance from the floor of the other stances of the foot.
    StanceHeight,
    /// Number of jumps of coordinates.
    Jumps,
    /// Share of the time in which keypoints of the legs move as one rigid piece.
    FrozenPoints,
    /// Uncertainty of axial rotations from keypoints.
    AxialRotation,
    /// Share of the motion whose place was derived from the feet on the ground.
    DerivedPlace,
    /// Factor by which gravity in flight contradicts the stated frame rate.
    FrameRate,
    /// Delay of the measured forces.
    ForceDelay,
    /// Factor by which the balance of the body contradicts the stated frame rate.
    Tempo,
    /// Cut-off frequency that may be too low.
    LowCutoff,
    /// Cut-off frequency, relative to the frame rate, that may be too high.
    HighCutoff,
    /// Bandwidth of the recorded motion that forces were predicted from, relative to what its foot strikes need.
    MotionBandwidth,
}

/// Limits of doubtful and of bad data.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum QualityLimits {
    /// Larger values are doubtful, then bad.
    AtMost(f64, f64),
    /// Smaller values are doubtful, then bad.
    AtLeast(f64, f64),
}

impl Measure {
    /// All measures, in the order of the documentation.
    pub const ALL: [Measure; 34] = [
        Measure::ResidualForce,
        Measure::ResidualMoment,
        Measure::GroundForces,
        Measure::MeasuredForces,
        Measure::UncheckedForces,
        Measure::UnmeasuredLeg,
        Measure::UnassignedForces,
        Measure::SilentPlates,
        Measure::LostForces,
        Measure::ForceDirections,
        Measure::MarkerFit,
        Measure::TrunkFit,
        Measure::Scaling,
        Measure::ScaleFactors,
        Measure::WhoseMarkers,
        Measure::NotMeasured,
        Measure::Mass,
        Measure::BodyMassIndex,
        Measure::Gaps,
        Measure::Sliding,
        Measure::CenterOfPressure,
        Measure::PlatePlace,
        Measure::CenterOffset,
        Measure::StanceHeight,
        Measure::Jumps,
        Measure::FrozenPoints,
        Measure::AxialRotation,
        Measure::DerivedPlace,
        Measure::FrameRate,
        Measure::ForceDelay,
        Measure::Tempo,
        Measure::LowCutoff,
        Measure::HighCutoff,
        Measure::MotionBandwidth,
    ];

    /// The limits, in the unit of [`Measure::unit`].
    #[must_use]
    pub fn limits(self) -> QualityLimits {
        use QualityLimits::{AtLeast, AtMost};
        match self {
            Measure::ResidualForce => AtMost(LARGE_RESIDUAL_BW, 0.3),
            Measure::ResidualMoment => AtMost(0.6, 1.2),
            Measure::GroundForces => AtLeast(0.9, 0.5),
            Measure::MeasuredForces => AtLeast(0.1, 0.02),
            Measure::UncheckedForces | Measure::UnmeasuredLeg => AtMost(0.0, 1.0),
            Measure::UnassignedForces => AtMost(0.1, 0.5),
            Measure::SilentPlates => AtMost(0.0, 0.9),
            Measure::LostForces => AtMost(0.0, 3.0),
            Measure::ForceDirections => AtLeast(0.6, 0.5),
            Measure::MarkerFit => AtMost(0.02, 0.04),
            Measure::TrunkFit => AtMost(0.04, 1.0),
            Measure::Scaling => AtMost(0.035, 0.06),
            Measure::ScaleFactors => AtMost(1.35, 1.7),
            Measure::WhoseMarkers => AtMost(0.0, 3.0),
            Measure::NotMeasured => AtMost(0.0, 4.0),
            Measure::Mass => AtMost(0.05, 0.15),
            Measure::BodyMassIndex => AtMost(1.0, 1.5),
            Measure::Gaps => AtMost(0.1, 0.3),
            Measure::Sliding => AtMost(0.05, 0.15),
            Measure::CenterOfPressure => AtMost(0.03, 0.1),
            Measure::PlatePlace => AtMost(0.03, 0.1),
            Measure::CenterOffset => AtMost(MOST_OFFSET_M, 0.12),
            Measure::StanceHeight => AtMost(0.02, 0.05),
            Measure::Jumps => AtMost(0.0, 10.0),
            Measure::FrozenPoints => AtMost(0.05, 0.25),
            Measure::AxialRotation => AtMost(3.0, 180.0),
            Measure::DerivedPlace => AtMost(0.0, 1.0),
            Measure::FrameRate => AtMost(1.2, WRONG_CLOCK),
            Measure::ForceDelay => AtMost(0.01, 0.03),
            Measure::Tempo => AtMost(1.1, 10.0),
            Measure::LowCutoff => AtLeast(3.0, 1.0),
            Measure::HighCutoff => AtMost(0.2, 0.4),
            Measure::MotionBandwidth => AtLeast(1.0, 0.25),
        }
    }

    /// The name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        word(&self)
    }

    /// Measured quantity, in words.
    #[must_use]
    pub fn meaning(self) -> &'static str {
        match self {
            Measure::ResidualForce => {
                "residual force at the root, rms over the frames with complete ground forces, in body weights"
            }
            Measure::ResidualMoment => "residual moment about the root, rms over the same frames, per body mass",
            Measure::GroundForces => "share of the motion with complete ground forces, measured or predicted",
            Measure::MeasuredForces => "share of the motion in which measured forces carry the body",
            Measure::UncheckedForces => "1 if forces were measured, but at no time those of all loaded feet",
            Measure::UnmeasuredLeg => "1 if a leg that stood on force plates was never measured, but the other leg was",
            Measure::UnassignedForces => "share of the loaded time in which a measured load lies under no foot",
            Measure::SilentPlates => "share of the stances on force plates that show no load",
            Measure::LostForces => "number of measured forces that are lost in part or for a time, scaled or turned",
            Measure::ForceDirections => {
                "correlation of a horizontal force with the direction from its centre of pressure to the mass centre"
            }
            Measure::MarkerFit => "distance of the markers or joints of pelvis and legs from the fitted body, rms",
            Measure::TrunkFit => "distance of the markers or joints of trunk and head from the fitted body, rms",
            Measure::Scaling => "distance of the markers of the standing trial from the scaled model, rms",
            Measure::ScaleFactors => "largest over smallest scale factor of the bodies of a scaled model",
            Measure::WhoseMarkers => {
                "number of contradictions: sides exchanged, limbs of another person, markers moved since standing"
            }
            Measure::NotMeasured => {
                "number of coordinates of pelvis and legs that nothing recorded determines, so that they have one value"
            }
            Measure::Mass => "difference of the body mass from that on the force plates or in the file, as a share",
            Measure::BodyMassIndex => "body mass index over 50 kg/m², or 11 kg/m² over it",
            Measure::Gaps => "share of the frames in which missing markers leave a coordinate unknown",
            Measure::Sliding => "speed along the ground of soles that carry half the body weight, lower quartile",
            Measure::CenterOfPressure => {
                "largest distance of the measured centre of pressure from the sole, where it is not a brief one"
            }
            Measure::PlatePlace => "distance of the measured centres of pressure from the feet to one side",
            Measure::CenterOffset => "distance of centres of pressure from where the motion needs them, along one foot",
            Measure::StanceHeight => {
                "largest height of a sole above or below that of the other stances of the foot, in level walking"
            }
            Measure::Jumps => "number of jumps of recorded coordinates",
            Measure::FrozenPoints => {
                "share of the time in which keypoints of a moving leg keep their distances like those of a rigid body"
            }
            Measure::AxialRotation => "standard deviation of axial rotation of the thighs, from errors of keypoints",
            Measure::DerivedPlace => {
                "share of the motion in which the place of the person was derived from the feet on the ground"
            }
            Measure::FrameRate => "factor between the stated frame rate and that of a fall with g in flight",
            Measure::ForceDelay => {
                "time by which measured forces are late or early against the motion, where it is longer than a frame"
            }
            Measure::Tempo => {
                "factor between the stated frame rate and that at which the body balances over its feet, if they differ"
            }
            Measure::LowCutoff => "cut-off frequency of the motion: a low one removes the movement",
            Measure::HighCutoff => "cut-off frequency of the motion over the frame rate: a high one leaves noise",
            Measure::MotionBandwidth => {
                "bandwidth of the recorded motion over what its foot strikes need, where forces were predicted"
            }
        }
    }

    /// Unit of the value and of its limits; `1` for shares, ratios and counts.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Measure::ResidualForce => "BW",
            Measure::ResidualMoment => "N.m/kg",
            Measure::MarkerFit
            | Measure::TrunkFit
            | Measure::Scaling
            | Measure::CenterOfPressure
            | Measure::PlatePlace
            | Measure::CenterOffset
            | Measure::StanceHeight => "m",
            Measure::Sliding => "m/s",
            Measure::AxialRotation => "deg",
            Measure::ForceDelay => "s",
            Measure::LowCutoff => "Hz",
            Measure::GroundForces
            | Measure::MeasuredForces
            | Measure::UncheckedForces
            | Measure::UnmeasuredLeg
            | Measure::UnassignedForces
            | Measure::SilentPlates
            | Measure::LostForces
            | Measure::ForceDirections
            | Measure::ScaleFactors
            | Measure::WhoseMarkers
            | Measure::NotMeasured
            | Measure::Mass
            | Measure::BodyMassIndex
            | Measure::Gaps
            | Measure::Jumps
            | Measure::FrozenPoints
            | Measure::DerivedPlace
            | Measure::FrameRate
            | Measure::Tempo
            | Measure::HighCutoff
            | Measure::MotionBandwidth => "1",
        }
    }

    /// Whether a value is beyond the second limit.
    pub(in crate::study) fn is_bad(self, value: f64) -> bool {
        self.limits().judge(value).is_some_and(|(state, _)| state == QualityState::Bad)
    }

    /// A reason, if the value is beyond the limits. `message` gets the limit of good data.
    #[doc(hidden)] // for tests
    pub fn reason(self, value: f64, message: impl FnOnce(f64) -> String) -> Option<QualityReason> {
        let (state, limit) = self.limits().judge(value)?;
        Some(QualityReason {
            measure: self,
            state,
            value,
            limit,
            unit: self.unit().to_owned(),
            message: message(limit),
        })
    }
}

impl QualityLimits {
    /// The state of a value, and the limit of good data; `None` for good data. A value that is not a number is bad.
    fn judge(self, value: f64) -> Option<(QualityState, f64)> {
        let (sign, doubtful, bad) = match self {
            QualityLimits::AtMost(doubtful, bad) => (1.0, doubtful, bad),
            QualityLimits::AtLeast(doubtful, bad) => (-1.0, doubtful, bad),
        };
        if sign * value <= sign * doubtful {
            None
        } else if sign * value <= sign * bad {
            Some((QualityState::Doubtful, doubtful))
        } else {
            Some((QualityState::Bad, doubtful))
        }
    }
}
