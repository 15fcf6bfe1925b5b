//! Why orientations of sensors give no motion.

use crate::kinematics::marker_fit::FitError;
use crate::model::ModelError;
use crate::numerics::degrees;

/// Why orientations of sensors give no motion.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SensorError {
    /// No sensor is on a body of the model.
    #[error(
        "none of the sensors {sensors} is on a body of `{model}`; expected names of bodies with the ending `_imu`, \
         such as {example}. hint: rename the columns of the file"
    )]
    NoBody {
        /// Names of the sensors.
        sensors: String,
        /// Name of the model.
        model: String,
        /// Names that would be known.
        example: String,
    },
    /// A sensor has no data in the posture of the calibration.
    #[error(
        "the sensor `{sensor}` has no orientation in the standing posture ({place}); expected one. hint: choose a \
         standing trial in which all sensors send, or remove the column"
    )]
    NotCalibrated {
        /// Name of the sensor.
        sensor: String,
        /// Where the standing posture was searched for.
        place: String,
    },
    /// A sensor of the heading that is not there.
    #[error("there is no sensor `{found}` for the heading; expected one of {known}")]
    NoBaseSensor {
        /// Name of the sensor.
        found: String,
        /// Names of the sensors.
        known: String,
    },
    /// An axis of the heading that points up or down.
    #[error(
        "the axis {axis} of `{sensor}` is {} from the horizontal in the standing posture; expected one that points \
         forward",
        degrees(*angle_deg)
    )]
    HeadingAxis {
        /// The axis.
        axis: String,
        /// Name of the sensor.
        sensor: String,
        /// Angle of the axis above the floor [deg].
        angle_deg: f64,
    },
    /// A motion that does not show where forward is.
    #[error(
        "the direction forward is not known: {found}; expected knees that bend by {expected_deg:.0} degrees or more, \
         or a sensor whose axis points forward in the standing posture"
    )]
    Heading {
        /// Flexion of the knees.
        found: String,
        /// Required bending [deg].
        expected_deg: f64,
    },
    /// Coordinates that the sensors do not determine.
    #[error(
        "the sensors do not determine {coordinates}: a sensor is missing on a body between two others, none is on the \
         pelvis, or one sent nothing. hint: add the sensor, or lock the coordinates in the model"
    )]
    Undetermined {
        /// Names of the coordinates.
        coordinates: String,
    },
    /// A model without feet.
    #[error(
        "`{model}` has no two legs with hip, knee, ankle and foot; the place of the pelvis follows from the feet on \
         the ground"
    )]
    NoFeet {
        /// Name of the model.
        model: String,
    },
    /// The pelvis cannot move in all directions, so the feet cannot determine its place.
    #[error(
        "the root of `{model}` cannot move along all three directions; expected three translations with a coordinate \
         each"
    )]
    NoTranslation {
        /// Name of the model.
        model: String,
    },
    /// Parts of the model that do not fit together.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The fit failed.
    #[error(transparent)]
    Fit(#[from] FitError),
}
