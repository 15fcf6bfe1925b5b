//! The clinical axes of the pelvis, through its iliac spines.
//!
//! The neutral posture of a model has an arbitrary pelvic tilt. Clinically, pelvic tilt is the angle between
//! the ground and the line from the posterior to the anterior iliac spines, 10 to 15 degrees in standing, and hip
//! angles are relative to axes along that line. Both differ by a rotation that is constant for a body, determined here
//! from the markers on the spines:
//!
//!   right   = from the left to the right anterior spine
//!   forward = from midway between the posterior spines (or the sacrum) to midway between the anterior ones,
//!             perpendicular to `right`
//!   up      = right × forward
//!
//! Source: Kadaba 1990, Davis 1991, as in Plug-in-Gait (unverified); compared with its angles in
//! tests/clinical_angles.rs.

use crate::model::full_body::STANDING_TILT;
use crate::model::marker_set::{Landmark, MarkerSet, RecognisedMarkers};
use crate::model::{BodyId, Model, Side};
use crate::numerics::elementary::sin_cos;
use crate::spatial::{Mat3, Vec3};

/// Smallest distance between spines that defines a direction [m].
const LEAST_DISTANCE: f64 = 0.02;

/// The clinical axes of a pelvis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PelvicFrame {
    /// The body.
    pub pelvis: BodyId,
    /// Forward, up and right as columns, in the frame of the body.
    pub axes: Mat3,
}

/// Why a model has no clinical pelvic axes.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PelvicFrameError {
    /// A model without legs.
    #[error("the model `{model}` has no pelvis with two legs, so pelvic tilt is not defined")]
    NoPelvis {
        /// Name of the model.
        model: String,
    },
    /// A pelvis without markers on the iliac spines.
    #[error(
        "the pelvis of the model `{model}` has no marker on the {missing}; expected markers on both anterior iliac \
         spines (ASIS) and on both posterior ones (PSIS) or the sacrum. The angles of pelvis and hips are therefore \
         those of the coordinates of the model"
    )]
    NoLandmarks {
        /// Name of the model.
        model: String,
        /// The missing landmarks.
        missing: &'static str,
    },
    /// Markers on the spines that are on a line or at one position.
    #[error(
        "the markers on the iliac spines of the model `{model}` are on a line or at one position; expected a triangle"
    )]
    Degenerate {
        /// Name of the model.
        model: String,
    },
}

impl PelvicFrame {
    /// Determines the frame from the markers of a model, recognised by the built-in marker sets.
    ///
    /// # Errors
    /// A model without a pelvis, or one without markers on the iliac spines.
    pub fn of_model(model: &Model) -> Result<PelvicFrame, PelvicFrameError> {
        let names = model.markers().iter().map(|marker| marker.name.as_str());
        let recognised = MarkerSet::recognise(names).ok();
        PelvicFrame::find(model, |landmark, side| {
            recognised.as_ref().and_then(|known| known.on(landmark, side)).map(str::to_owned)
        })
    }

    /// Determines the frame from recognised markers of a model.
    ///
    /// # Errors
    /// A model without a pelvis, or one without markers on the iliac spines.
    pub fn of_markers(model: &Model, recognised: &RecognisedMarkers) -> Result<PelvicFrame, PelvicFrameError> {
        PelvicFrame::find(model, |landmark, side| recognised.on(landmark, side).map(str::to_owned))
    }

    /// The frame of a built-in figure, which has the anterior tilt [`STANDING_TILT`] when its coordinates are zero.
    ///
    /// # Errors
    /// A model without a pelvis.
    pub fn of_built_in(model: &Model) -> Result<PelvicFrame, PelvicFrameError> {
        let missing = || PelvicFrameError::NoPelvis { model: model.name().to_owned() };
        let pelvis = model.anatomy().pelvis().ok_or_else(missing)?;
        let neutral = model.anatomy().neutral().ok_or_else(missing)?;
        let (sin, cos) = sin_cos(STANDING_TILT);
        // Rotated forward about the axis to the right.
        let tilted = Mat3::new(cos, sin, 0.0, -sin, cos, 0.0, 0.0, 0.0, 1.0);
        Ok(PelvicFrame { pelvis, axes: neutral.poses[pelvis.index()].rotation.transpose() * neutral.axes * tilted })
    }

    fn find(
        model: &Model,
        name: impl Fn(Landmark, Option<Side>) -> Option<String>,
    ) -> Result<PelvicFrame, PelvicFrameError> {
        let model_name = || model.name().to_owned();
        let pelvis = model.anatomy().pelvis().ok_or_else(|| PelvicFrameError::NoPelvis { model: model_name() })?;
        let place = |landmark: Landmark, side: Option<Side>| -> Option<Vec3> {
            let name = name(landmark, side)?;
            let marker = model.markers().iter().find(|marker| marker.name == name && marker.body == Some(pelvis))?;
            Some(marker.location)
        };
        let both = |landmark: Landmark| Some([place(landmark, Some(Side::Right))?, place(landmark, Some(Side::Left))?]);
        let missing = |missing: &'static str| PelvicFrameError::NoLandmarks { model: model_name(), missing };
        let [right, left] = both(Landmark::Asis).ok_or_else(|| missing("anterior iliac spines"))?;
        let back = both(Landmark::Psis).map(|[a, b]| (a + b) * 0.5).or_else(|| place(Landmark::Sacrum, None));
        let back = back.ok_or_else(|| missing("posterior iliac spines or the sacrum"))?;
        axes(right - left, (right + left) * 0.5 - back)
            .map(|axes| PelvicFrame { pelvis, axes })
            .ok_or_else(|| PelvicFrameError::Degenerate { model: model_name() })
    }
}

/// Axes with the third along `right` and the first as near as possible to `forward`.
fn axes(right: Vec3, forward: Vec3) -> Option<Mat3> {
    let right = right.try_normalize(LEAST_DISTANCE)?;
    let forward = (forward - right * forward.dot(&right)).try_normalize(LEAST_DISTANCE)?;
    Some(Mat3::from_columns(&[forward, right.cross(&forward), right]))
}
