//! The fit to keypoints of video: all frames together, each point weighted by its own noise.
//!
//! The weight of a point is that of its landmark, lowered by its noise: 1 / (1/w + (σ/s)²), where s is what the joint
//! centres of a network and those of the body differ by. The frame-by-frame fit to the smooth paths is the start of the
//! fit to the recorded points, with the noise and the smoothness that the recording shows ([`recorded_noise`]).
//! Coordinates that keypoints hardly show are held near zero by weak springs.
//!
//! | code | symbol | unit |
//! |---|---|---|
//! | `noise` | σ | m |
//! | `MODEL_ERROR_M` | s | m |
//!
//! Pinned by: tests/keypoints.rs

use super::FitError;
use super::frames::{FEWEST, Frames};
use super::problem::FitProblem;
use super::result::MarkerFit;
use super::settings::{FitMethod, FitSettings, OutlierDetection, SmoothnessPrior};
use super::smoothing::Ending;
use super::{gaps, recorded_noise, report, sequence, smoothing};
use crate::findings::Findings;
use crate::kinematics::keypoints::{KeypointReport, Keypoints};
use crate::model::{Model, Movement, Side};
use crate::motion::{MarkerPath, MarkerRecording};
use crate::numerics::{mean, median};
use std::borrow::Cow;

/// Distance of a joint centre of a network from that of the body, besides noise [m].
const MODEL_ERROR_M: f64 = 0.010;
/// Standard deviations of coordinates that keypoints hardly show [rad]: bending and rotation between pelvis and thorax,
/// and extension of the toes, in walking; the pelvis from upright where nothing shows the trunk.
const LUMBAR_RAD: f64 = 0.1;
const TOE_RAD: f64 = 0.2;
const UPRIGHT_RAD: f64 = 0.2;

/// Keypoints that a model follows.
pub struct FollowedKeypoints {
    /// The motion of the model.
    pub fit: MarkerFit,
    /// The points on their smooth paths.
    pub smooth: MarkerRecording,
    /// What was found of the keypoints.
    pub report: KeypointReport,
}

/// Fits a model to keypoints.
pub fn fit_keypoints(
    model: &Model,
    keypoints: Keypoints,
    settings: &FitSettings,
    findings: &mut Findings,
) -> Result<FollowedKeypoints, FitError> {
    keypoints.report_noise(findings);
    let Keypoints { observed, smooth, mut report } = keypoints;
    let mut problem = FitProblem::new(model, &smooth, settings, findings)?;
    let number = |path: &Cow<'_, MarkerPath>| smooth.markers.iter().position(|marker| marker.name == path.name);
    let numbers: Vec<usize> = problem.paths.iter().filter_map(number).collect();
    let mut frames = Frames::new(&problem);
    report::missing(&problem, &frames, findings);
    let most = (0..frames.count()).map(|frame| frames.used_in(frame)).max().unwrap_or(0);
    if most < FEWEST {
        let common = problem.points.len();
        return Err(FitError::TooFewMarkers { recording: observed.name.clone(), most, common });
    }
    let jitter: Vec<f64> = numbers.iter().map(|&i| known_jitter(report.points[i].jitter_m)).collect();
    let springs = springs(model, &problem);
    let of_landmarks = problem.weights.clone();
    weigh(&mut problem, &of_landmarks, &jitter);
    let mut states = begin(model, &mut problem, &mut frames, &springs, settings.longest_gap_s);
    let in_band = recorded_noise::distances_in_band(&mut problem, &frames);
    let noise: Vec<f64> = jitter.iter().zip(&in_band).map(|(jitter, in_band)| jitter.max(*in_band)).collect();
    weigh(&mut problem, &of_landmarks, &noise);
    let sensitivities = recorded_noise::sensitivities(&mut problem, &frames);
    report.thigh_rotation = thigh_rotation(model, &problem, &sensitivities);
    let prior = prior(settings.method, median(noise).unwrap_or(0.0))
        .map(|prior| recorded_noise::with_smoothness(prior, model, &problem, &frames, &sensitivities));
    problem.paths = numbers.iter().map(|&i| Cow::Borrowed(&observed.markers[i])).collect();
    frames.observe(&problem.paths);
    if let Some(prior) = prior {
        problem.bounds.stiffness.clone_from(&springs);
        problem.bounds.anchor.fill(0.0);
        smoothing::smooth(model, &mut problem, &mut frames, &states, prior, Ending::NEAR);
    }
    gaps::open_unfitted(&mut problem, &mut frames, &mut states);
    report::unfitted(&problem, &frames, findings);
    report::coordinates(model, &problem, &frames, &states, settings.longest_gap_s, findings);
    let fit = report::fit(model, &observed, &mut problem, &frames, &states).alone();
    drop(problem);
    Ok(FollowedKeypoints { fit, smooth, report })
}

/// Fits each frame to the smooth paths.
fn begin(
    model: &Model,
    problem: &mut FitProblem<'_>,
    frames: &mut Frames,
    springs: &[f64],
    longest_gap_s: f64,
) -> Vec<gaps::Determination> {
    let coordinates = (0..problem.tree.unknowns()).map(|u| &model.coordinates()[problem.tree.coordinate(u)]);
    let default: Vec<f64> = coordinates.map(|coordinate| coordinate.default_value).collect();
    problem.bounds.stiffness.copy_from_slice(springs);
    sequence::run(problem, frames, OutlierDetection::Off, &default);
    problem.solver.budget.grant_afterwards(frames.count());
    gaps::refit(problem, frames, longest_gap_s)
}

/// The jitter of a point [m]; as large as the error of the model if it is not known.
fn known_jitter(jitter_m: f64) -> f64 {
    if jitter_m.is_finite() { jitter_m } else { MODEL_ERROR_M }
}

/// Lowers the weights of landmarks by the noise of their points [m].
fn weigh(problem: &mut FitProblem<'_>, of_landmarks: &[f64], noise: &[f64]) {
    for ((weight, of_landmark), noise) in problem.weights.iter_mut().zip(of_landmarks).zip(noise) {
        *weight = 1.0 / (1.0 / of_landmark + (noise / MODEL_ERROR_M).powi(2));
    }
}

/// The prior of a fit of all frames together to points with this usual noise [m], by which their weights are lowered;
/// `None` for a fit frame by frame.
fn prior(method: FitMethod, noise_m: f64) -> Option<SmoothnessPrior> {
    let prior = match method {
        FitMethod::Frames => return None,
        FitMethod::Together(prior) => prior,
        FitMethod::ByRecording => SmoothnessPrior::default(),
    };
    let weight = 1.0 / (1.0 + (noise_m / MODEL_ERROR_M).powi(2));
    let variance = prior.marker_noise_m.powi(2) + noise_m * noise_m;
    Some(SmoothnessPrior { marker_noise_m: (variance * weight).sqrt(), ..prior })
}

/// Stiffness of the springs that hold unknowns near zero; 0 for none.
fn springs(model: &Model, problem: &FitProblem<'_>) -> Vec<f64> {
    let trunk = model.anatomy().trunk();
    let is_on_trunk = |path: &Cow<'_, MarkerPath>| {
        model.markers().iter().any(|marker| marker.name == path.name && marker.body == trunk && trunk.is_some())
    };
    let upright = if problem.paths.iter().any(is_on_trunk) { f64::INFINITY } else { UPRIGHT_RAD };
    let held = [
        (Movement::TrunkObliquity, None, LUMBAR_RAD),
        (Movement::TrunkRotation, None, LUMBAR_RAD),
        (Movement::PelvicTilt, None, upright),
        (Movement::PelvicObliquity, None, upright),
        (Movement::ToeExtension, Some(Side::Right), TOE_RAD),
        (Movement::ToeExtension, Some(Side::Left), TOE_RAD),
    ];
    let mut stiffness = vec![0.0; problem.tree.unknowns()];
    for (movement, side, deviation) in held {
        let id = model.anatomy().coordinate(movement, side).map(|(id, _)| id.index());
        for (u, stiffness) in stiffness.iter_mut().enumerate() {
            if Some(problem.tree.coordinate(u)) == id {
                *stiffness = (MODEL_ERROR_M / deviation).powi(2);
            }
        }
    }
    stiffness
}

/// Standard deviation of the axial rotation of the thighs, from the errors of the points [rad].
fn thigh_rotation(model: &Model, problem: &FitProblem<'_>, sensitivities: &[f64]) -> f64 {
    let rotation = |side| model.anatomy().coordinate(Movement::HipRotation, Some(side)).map(|(id, _)| id.index());
    let rotations: Vec<usize> = Side::BOTH.into_iter().filter_map(rotation).collect();
    let own = (0..problem.tree.unknowns()).filter(|&u| rotations.contains(&problem.tree.coordinate(u)));
    let deviations: Vec<f64> = own.map(|u| MODEL_ERROR_M * sensitivities[u]).collect();
    if deviations.is_empty() { f64::NAN } else { mean(&deviations) }
}
