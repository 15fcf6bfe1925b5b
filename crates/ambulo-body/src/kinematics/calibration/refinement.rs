//! Refines the marker positions of a body that was calibrated on a walk, using its joints.
//!
//! Calibration places each marker at its median position in segment axes that are constructed frame by frame. The
//! joints add information: a knee that only flexes shows the direction of its axis relative to the markers. The body is
//! fitted to some of the frames, and every marker is moved towards its mean position on the fitted body; both steps are
//! repeated. This solves
//!
//!   min Σ_frames Σ_markers w |m - p(q_frame, place)|² + κ Σ_markers w |place - place₀|²
//!
//! alternately for postures and marker positions. κ is a number of frames: positions that the walk does not determine
//! stay near the initial ones.
//!
//! Source: alternating least squares, as in Reinbolt et al. 2005 and Charlton et al. 2004 (unverified).

use super::Calibrated;
use super::axes::in_frame;
use crate::findings::Findings;
use crate::kinematics::marker_fit::{FitSettings, MarkerFit, fit_markers};
use crate::kinematics::{Posture, body_motion};
use crate::model::anthropometry::BuildError;
use crate::model::{Marker, Model};
use crate::motion::{MarkerPath, MarkerRecording};
use crate::spatial::Vec3;

/// Largest number of frames that are fitted.
const FRAMES: usize = 30;
/// Number of iterations.
const ROUNDS: usize = 8;
/// A marker farther from its place on the body has another one's label, or jumped [m].
const STRAY_M: f64 = 0.1;
/// κ: weight of the initial position of a marker [frames].
const PRIOR: f64 = 6.0;

/// Moves the markers of a body to their positions in the walk.
pub(super) fn refine(body: &mut Calibrated, recording: &MarkerRecording) -> Result<(), BuildError> {
    let sample = recording.sample(FRAMES);
    let first: Vec<Vec3> = body.human.model.markers().iter().map(|m| m.location).collect();
    for _ in 0..ROUNDS {
        let Some(fit) = fitted(body, &sample) else { return Ok(()) };
        let places = places(body, &sample, &fit, &first);
        let model = &body.human.model;
        let markers: Vec<Marker> = model
            .markers()
            .iter()
            .zip(&places)
            .map(|(marker, place)| Marker { location: *place, ..marker.clone() })
            .collect();
        let (bodies, coordinates) = (model.bodies().to_vec(), model.coordinates().to_vec());
        body.human.model = Model::new(model.name(), model.gravity(), bodies, coordinates, markers)?;
    }
    if let Some(fit) = fitted(body, &sample) {
        for place in &mut body.report.markers {
            if let Some(error) = fit.errors.iter().find(|e| e.name == place.name && e.rms_m.is_finite()) {
                place.rms_m = error.rms_m;
            }
        }
    }
    Ok(())
}

fn fitted(body: &Calibrated, sample: &MarkerRecording) -> Option<MarkerFit> {
    let settings = FitSettings { weights: body.weights.clone(), ..FitSettings::default() };
    fit_markers(&body.human.model, sample, &settings, &mut Findings::default()).ok()
}

/// Mean of the marker positions on the fitted body and the initial positions.
fn places(body: &Calibrated, sample: &MarkerRecording, fit: &MarkerFit, first: &[Vec3]) -> Vec<Vec3> {
    let model = &body.human.model;
    let mut sums: Vec<(Vec3, f64)> = first.iter().map(|place| (place * PRIOR, PRIOR)).collect();
    let paths: Vec<Option<&MarkerPath>> = model.markers().iter().map(|m| sample.marker(&m.name)).collect();
    for frame in 0..sample.frames() {
        let value = |id| fit.motion.column(id).map_or(0.0, |column: &[f64]| column[frame]);
        let q: Vec<f64> = model.coordinate_ids().map(value).collect();
        if !q.iter().all(|v| v.is_finite()) {
            continue;
        }
        let rest = vec![0.0; q.len()];
        let motion = body_motion(model, Posture { q: &q, qd: &rest, qdd: &rest });
        for ((marker, path), sum) in model.markers().iter().zip(&paths).zip(&mut sums) {
            let seen = path.map(|path| path.positions[frame]).filter(|p| p.iter().all(|x| x.is_finite()));
            let place = marker.body.zip(seen).map(|(id, seen)| in_frame(&motion[id.index()].pose, seen));
            if let Some(place) = place.filter(|place| (place - marker.location).norm() < STRAY_M) {
                sum.0 += place;
                sum.1 += 1.0;
            }
        }
    }
    sums.into_iter().map(|(sum, count)| sum / count).collect()
}
