//! Marker fit (inverse kinematics): the posture of a model that brings its markers closest to the recorded ones, frame
//! by frame or in all frames together.
//!
//! q(t) = argmin Σ w |m(t) - p(q)|²    within the ranges of the coordinates
//!
//! Tasks can hold coordinates near values ([`CoordinateTask`]).
//!
//! | code | symbol | unit |
//! |---|---|---|
//! | `positions` | m, recorded marker | m |
//! | `points` | p, marker of the model | m |
//! | `weights` | w | 1 |
//! | `x` | q, free coordinates that move a marker | rad, m |
//!
//! The markers of a model are never exactly where those of the person are, so that each marker pulls on the posture
//! even at the best fit. When a marker is lost, its pull is lost too, and the posture would jump. Frames that lack
//! markers are therefore fitted with each marker at its offset, interpolated from the complete frames around them
//! (`gaps`). Coordinates that the visible markers do not determine are bridged up to a maximum length, and are NaN in
//! longer gaps.
//!
//! Source: T.-W. Lu, J.J. O'Connor 1999, J. Biomech. 32:129-134 (global optimisation) (unverified).
//! Cost: about 10 µs per step, three or four steps per frame; `cargo xtask bench-markers`.
//! The number of linear solves is bounded by 32 per frame and 3200 for the first (`budget`). If the body is lost, other
//! starts are tried, each with as many, and at last all frames are fitted together (`attempts`).
//! Not handled: markers fixed to ground; weights that vary in time.
//! Pinned by: tests/marker_fit.rs, tests/marker_gaps.rs, tests/marker_misplaced.rs, tests/marker_outliers.rs,
//! tests/marker_smoothing.rs

mod result;
mod settings;

pub(crate) mod branch_matrix;
mod budget;
mod normal;
mod problem;
mod solve;
mod tasks;
mod tree;

mod attempts;
mod frames;
mod sequence;
mod start;

pub(crate) mod gaps;
mod misplaced;
mod skin_motion;
mod smoothing;

mod keypoint_fit;
mod live_fit;
mod recorded_noise;
mod report;
pub(crate) mod rows;

#[doc(hidden)]
pub use keypoint_fit::{FollowedKeypoints, fit_keypoints};
pub use live_fit::LiveMarkerFit;
pub use result::{FitError, MarkerFit, MarkerResidual};
pub use settings::{
    CoordinateTask, FitMethod, FitSettings, JointLimits, OutlierDetection, SmoothnessPrior, TaskTarget,
};

use crate::findings::Findings;
use crate::model::Model;
use crate::motion::MarkerRecording;
use frames::{FEWEST, Frames};
use problem::FitProblem;
use smoothing::Ending;
use solve::STEPS;

/// Fits a model to recorded markers, both in world axes. Markers that only one of them has are reported as a note.
///
/// # Errors
/// No common marker, no coordinate that the markers determine, settings out of range: see [`FitError`].
///
/// A hip that is flexed by 0.4 rad, from three markers on the pelvis and three on the thigh:
///
/// ```
/// use ambulo_body::findings::Findings;
/// use ambulo_body::formats::osim::OsimMarker;
/// use ambulo_body::kinematics::marker_fit::{FitSettings, fit_markers};
/// use ambulo_body::kinematics::{Posture, body_motion};
/// use ambulo_body::model::anthropometry::{Build, SegmentTable};
/// use ambulo_body::model::{from_osim, to_osim};
/// use ambulo_body::motion::{MarkerPath, MarkerRecording};
///
/// let mut findings = Findings::default();
/// let build = Build { table: SegmentTable::DeLevaMale, mass: 72.6, height: 1.80, toe_joint: false };
/// let mut document = to_osim(&build.human()?.model)?;
/// for (i, location_m) in [[0.1, 0.0, 0.0], [0.0, -0.2, 0.1], [0.1, -0.1, -0.1]].into_iter().enumerate() {
///     for body in ["pelvis", "femur_r"] {
///         document.markers.push(OsimMarker { name: format!("{body}_{i}"), body: body.to_owned(), location_m, fixed: false });
///     }
/// }
/// let model = from_osim(&document, &mut findings)?;
/// let hip = model.coordinate("hip_flexion_r").ok_or("no such coordinate")?.index();
/// let still = vec![0.0; model.coordinates().len()];
/// let mut flexed = still.clone();
/// flexed[hip] = 0.4;
/// let poses = body_motion(&model, Posture { q: &flexed, qd: &still, qdd: &still });
/// let path = |marker: &ambulo_body::model::Marker| {
///     let body = marker.body.map_or(0, |body| body.index());
///     MarkerPath { name: marker.name.clone(), positions: vec![poses[body].pose.place(marker.location); 2] }
/// };
/// let markers = model.markers().iter().map(path).collect();
/// let recording = MarkerRecording { name: "hip".to_owned(), rate_hz: 100.0, times: vec![0.0, 0.01], markers };
/// let fit = fit_markers(&model, &recording, &FitSettings::default(), &mut findings)?;
/// let angles = fit.motion.columns[hip].as_ref().ok_or("not determined")?;
/// assert!((angles[0] - 0.4).abs() < 1e-4, "{angles:?}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn fit_markers(
    model: &Model,
    markers: &MarkerRecording,
    settings: &FitSettings,
    findings: &mut Findings,
) -> Result<MarkerFit, FitError> {
    let (fit, followed) = fitted(model, markers, (settings, STEPS), findings)?.following(markers.clone());
    Ok(MarkerFit { followed: Some(followed), ..fit })
}

/// [`fit_markers`] without a copy of the recording, for callers that do not need the original. Returns the result and
/// the corrected recording.
#[doc(hidden)]
pub fn fit_own_markers(
    model: &Model,
    markers: MarkerRecording,
    settings: &FitSettings,
    findings: &mut Findings,
) -> Result<(MarkerFit, MarkerRecording), FitError> {
    Ok(fitted(model, &markers, (settings, STEPS), findings)?.following(markers))
}

/// [`fit_markers`] in a few steps a frame: postures that are right to within millimetres, also where a weakly
/// determined angle would take many.
///
/// # Errors
/// As [`fit_markers`].
#[doc(hidden)]
pub fn nearly_fit_markers(
    model: &Model,
    markers: &MarkerRecording,
    settings: &FitSettings,
) -> Result<MarkerFit, FitError> {
    const FEW_STEPS: usize = 10;
    let fitted = fitted(model, markers, (settings, FEW_STEPS), &mut Findings::default())?;
    Ok(fitted.following(markers.clone()).0)
}

fn fitted(
    model: &Model,
    markers: &MarkerRecording,
    (settings, most_steps): (&FitSettings, usize),
    findings: &mut Findings,
) -> Result<report::Fitted, FitError> {
    let mut problem = FitProblem::new(model, markers, settings, findings)?;
    problem.most_steps = most_steps;
    let mut frames = Frames::new(&problem);
    let most = (0..frames.count()).map(|frame| frames.used_in(frame)).max().unwrap_or(0);
    if most < FEWEST {
        let common = problem.points.len();
        return Err(FitError::TooFewMarkers { recording: markers.name.clone(), most, common });
    }
    let default: Vec<f64> =
        (0..problem.tree.unknowns()).map(|u| model.coordinates()[problem.tree.coordinate(u)].default_value).collect();
    let mut tried = attempts::follow(&mut problem, &mut frames, settings.outliers, &default);
    problem.solver.budget.grant_afterwards(frames.count());
    let mut elsewhere = Vec::new();
    if settings.outliers != OutlierDetection::Off {
        misplaced::exchange_back(&mut problem, &mut frames);
    }
    if settings.outliers == OutlierDetection::On {
        elsewhere = misplaced::reduce_weights(&mut problem, &mut frames);
    }
    let mut states = gaps::refit(&mut problem, &mut frames, settings.longest_gap_s);
    let prior = match settings.method {
        FitMethod::Together(prior) => Some(prior),
        FitMethod::ByRecording | FitMethod::Frames => attempts::ended_early(&problem, &frames).then(|| {
            tried.push(report::together(&problem, &frames));
            SmoothnessPrior::default()
        }),
    };
    if let Some(prior) = prior {
        smoothing::smooth(model, &mut problem, &mut frames, &states, prior, Ending::EXACT);
    }
    gaps::open_unfitted(&mut problem, &mut frames, &mut states);
    report::missing(&problem, &frames, findings);
    report::excluded(&problem, &frames, findings);
    report::tried(&tried, findings);
    report::unfitted(&problem, &frames, findings);
    report::misplaced(&problem, &elsewhere, findings);
    report::coordinates(model, &problem, &frames, &states, settings.longest_gap_s, findings);
    Ok(report::fit(model, markers, &mut problem, &frames, &states))
}
