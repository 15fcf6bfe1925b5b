//! Transfers the motion of a skeleton (animation file) to the built-in body.
//!
//! The body gets the segment lengths of the skeleton (`skeleton_body`), and its motion by [`fit_markers`]. The floor is
//! placed so that the ankles are at the height of the body's ankles during stance: at the [`STANDING`] quantile of
//! their height.
//!
//! Not handled: uneven floors, shoulders that move relative to the trunk, hands.
//! Pinned by: tests/retarget.rs

use super::flight_gravity::{FlightGravity, WRONG_CLOCK};
use super::marker_fit::{FitError, FitSettings, JointLimits, MarkerFit, OutlierDetection, fit_markers};
pub use super::skeleton_body::{JointCentreError, STANDING};
use super::skeleton_body::{body_of_joint_centres, standing_ankle_height};
use crate::findings::{Code, Findings};
use crate::model::anthropometry::{Build, Human};
use crate::model::full_body::full_body;
use crate::model::marker_set::Segment;
use crate::model::subject_shape::SolePlacement;
use crate::model::{Model, Side};
use crate::motion::MarkerRecording;
use crate::motion::skeleton::SkeletonRecording;

/// Result of [`retarget`].
#[derive(Debug, Clone)]
pub struct Retargeted {
    /// The body with the lengths of the skeleton and the points of the recording as markers.
    pub human: Human,
    /// The recording, moved so that the floor is y = 0.
    pub markers: MarkerRecording,
    /// The motion, and the distances of the body from the skeleton.
    pub fit: MarkerFit,
    /// Downward acceleration of the person in flight; `None` without a flight.
    pub flights: Option<FlightGravity>,
}

/// Transfers the motion of a skeleton to a body of this build.
///
/// # Errors
/// Implausible mass or stature, a skeleton without moving legs: see [`JointCentreError`].
pub fn retarget(
    build: &Build,
    skeleton: &SkeletonRecording,
    findings: &mut Findings,
) -> Result<Retargeted, JointCentreError> {
    let table = full_body(build)?;
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
    let fit = fit_skeleton(&human.model, &markers, findings)?;
    let flights = FlightGravity::of(&human.model, &fit.motion, &markers);
    report_clock(flights.filter(|flights| flights.wrong_by() > WRONG_CLOCK), findings);
    Ok(Retargeted { human, markers, fit, flights })
}

/// The coordinates that bring a body closest to the points of a skeleton.
pub(super) fn fit_skeleton(
    model: &Model,
    markers: &MarkerRecording,
    findings: &mut Findings,
) -> Result<MarkerFit, FitError> {
    // Animation files have no swapped labels, but arms so straight that only the ranges keep them from rotating.
    let settings =
        FitSettings { outliers: OutlierDetection::Off, limits: JointLimits::Ranges, ..FitSettings::default() };
    fit_markers(model, markers, &settings, findings)
}

/// Height of the floor under the recorded points of a skeleton [m]; the body stands on its floor at its default
/// coordinates.
pub(super) fn floor_under(model: &Model, markers: &MarkerRecording) -> f64 {
    let defaults: Vec<f64> = model.coordinates().iter().map(|coordinate| coordinate.default_value).collect();
    let standing = model.poses(&defaults);
    let ankle = |side: Side| Segment::Foot.body(model, Some(side)).map(|foot| standing[foot.index()].translation.y);
    let heights: Vec<f64> = Side::BOTH.into_iter().filter_map(ankle).collect();
    floor(markers, heights.iter().sum::<f64>() / heights.len() as f64)
}

/// Reports a frame rate that the fall of the person in flight contradicts.
fn report_clock(wrong: Option<FlightGravity>, findings: &mut Findings) {
    let Some(found) = wrong else { return };
    let FlightGravity { gravity, flights, stated_hz } = found;
    let message = format!(
        "in {flights} flight {} the person falls with {gravity:.1} m/s² at the stated {stated_hz:.0} frames per \
         second; gravity means about {:.0} frames per second. hint: every force depends on it; correct the frame rate \
         in the file",
        if flights == 1 { "phase" } else { "phases" },
        found.rate_hz()
    );
    findings.report(Code::MotionClock, message);
}

/// The recording, moved upwards by a distance [m], if that is known.
pub(super) fn raised(markers: &MarkerRecording, by: f64) -> MarkerRecording {
    let by = if by.is_finite() { by } else { 0.0 };
    let mut raised = markers.clone();
    raised.markers.iter_mut().flat_map(|path| &mut path.positions).for_each(|place| place.y += by);
    raised
}

/// Height of the floor in the axes of the recording [m]; NaN if no ankle was recorded.
fn floor(markers: &MarkerRecording, ankle_height: f64) -> f64 {
    standing_ankle_height(markers, &Side::BOTH) - ankle_height
}
