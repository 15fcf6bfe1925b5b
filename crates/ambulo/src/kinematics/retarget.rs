//! Transfers the motion of a skeleton (animation file) to the built-in body.
//!
//! The body gets the segment lengths of the skeleton (`skeleton_body`), and its motion by [`fit_markers`]. The floor is placed so that the ankles are at the height of the body's ankles during stance: at the
//! [`STANDING`] quantile of their height.
//!
//! Not handled: uneven floors, shoulders that move relative to the trunk, hands.
//! Pinned by: tests/retarget.rs

use super::flight_gravity::FlightGravity;
use super::marker_fit::{FitError, FitSettings, JointLimits, MarkerFit, OutlierDetection, fit_markers};
pub use super::skeleton_body::{JointCentreError, STANDING};
use super::skeleton_body::{body_of_joint_centres, standing_ankle_height};
use crate::findings::{Code, Findings};
use crate::model::anthropometry::{Build, Human};
use crate::model::full_body::{SolePlacement, full_body};
use crate::model::{Model, Side};
use crate::motion::skeleton::SkeletonRecording;
use crate::motion::{MarkerRecording, Motion};

/// Result of [`retarget`].
#[derive(Debug, Clone)]
pub struct Retargeted {
    /// The body with the lengths of the skeleton and the points of the recording as markers.
    pub human: Human,
    /// The recording, moved so that the floor is y = 0.
    pub markers: MarkerRecording,
    /// The motion, and the distances of the body from the skeleton.
    pub fit: MarkerFit,
}

/// Why a skeleton is rejected.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RetargetError {
    /// The body cannot be built from the joint centres.
    #[error(transparent)]
    Body(#[from] JointCentreError),
    /// The marker fit failed.
    #[error(transparent)]
    Fit(#[from] FitError),
}

/// Transfers the motion of a skeleton to a body of this build.
///
/// # Errors
/// Implausible mass or stature, a skeleton without moving legs: see [`RetargetError`].
pub fn retarget(
    build: &Build,
    skeleton: &SkeletonRecording,
    findings: &mut Findings,
) -> Result<Retargeted, RetargetError> {
    let table = full_body(build).map_err(JointCentreError::from)?;
    let feet = [SolePlacement::of(&table.dimensions); 2];
    let human = body_of_joint_centres(&table, &skeleton.markers, feet, (Code::BvhLengths, findings))?;
    let floor = floor(&skeleton.markers, table.dimensions.ankle_height);
    let markers = raised(&skeleton.markers, -floor);
    if floor.is_finite() {
        let message = format!(
            "the floor was placed {:.3} m {} the origin of the skeleton, from the height of its ankles during stance",
            floor.abs(),
            if floor < 0.0 { "below" } else { "above" }
        );
        findings.report(Code::BvhFloor, message);
    }
    // Animation files have no swapped labels, but arms so straight that only the ranges keep them from rotating.
    let settings =
        FitSettings { outliers: OutlierDetection::Off, limits: JointLimits::Ranges, ..FitSettings::default() };
    let fit = fit_markers(&human.model, &markers, &settings, findings)?;
    report_clock(&human.model, &fit.motion, &markers, findings);
    Ok(Retargeted { human, markers, fit })
}

/// Reports a frame rate that the fall of the person in flight contradicts.
fn report_clock(model: &Model, motion: &Motion, markers: &MarkerRecording, findings: &mut Findings) {
    let Some(found) = FlightGravity::of(model, motion, markers) else { return };
    let stated_hz = markers.rate_hz;
    if let Some(true_hz) = found.contradicted_rate(stated_hz) {
        let FlightGravity { gravity, flights } = found;
        let message = format!(
            "in {flights} flight {} the person falls with {gravity:.1} m/s² at the stated {stated_hz:.0} frames per second; gravity means about {true_hz:.0} frames per second. hint: every force depends on it; correct the frame rate in the file",
            if flights == 1 { "phase" } else { "phases" }
        );
        findings.report(Code::MotionClock, message);
    }
}

fn raised(markers: &MarkerRecording, by: f64) -> MarkerRecording {
    let by = if by.is_finite() { by } else { 0.0 };
    let mut raised = markers.clone();
    raised.markers.iter_mut().flat_map(|path| &mut path.positions).for_each(|place| place.y += by);
    raised
}

/// Height of the floor in the axes of the recording [m]; NaN if no ankle was recorded.
fn floor(markers: &MarkerRecording, ankle_height: f64) -> f64 {
    standing_ankle_height(markers, &Side::BOTH) - ankle_height
}
