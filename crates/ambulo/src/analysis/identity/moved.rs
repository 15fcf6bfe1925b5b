//! Markers that moved between the standing trial and the motion.
//!
//! The body of the standing trial is fitted to frames of the motion with the markers of pelvis and legs, once with all of
//! them and once without each. A marker that moved by d is then d from its place on the body, while the others come
//! nearer to theirs. With r the mean distance in the axes of the segment, with all markers, and r₀ that without this one,
//! the sum of squares of the fit falls by r · r₀ (least squares; Cook and Weisberg 1982, unverified), so that
//!
//!   d = |r₀| > [`MOVED_M`]    and    √(r · r₀) > [`CONTRADICTED_M`]
//!
//! A distance along a limb changes by d; one across it only in the second order, which is why the whole body is asked and
//! not distances alone.

use super::super::subject::Subject;
use super::Contradictions;
use crate::findings::{Code, Findings};
use crate::kinematics::marker_fit::{FitSettings, OutlierDetection, fit_markers};
use crate::kinematics::{Posture, body_motion};
use crate::model::{Marker, Model};
use crate::motion::{MarkerPath, MarkerRecording};
use crate::numerics::median;
use crate::spatial::Vec3;
use std::collections::BTreeMap;

/// A marker further than this from its place has moved [m]: skin slides by 10 to 20 mm on the mean of a walk.
const MOVED_M: f64 = 0.025;
/// How far the other markers must contradict it [m].
const CONTRADICTED_M: f64 = 0.012;
/// Frames of the motion, spread over it.
const FRAMES: usize = 16;
/// Most markers that are named.
const MOST: usize = 3;

/// Reports the markers of legs and pelvis that moved.
pub(in crate::analysis) fn report_moved(
    subject: &Subject,
    moving: &MarkerRecording,
    settings: &FitSettings,
    contradictions: &mut Contradictions,
    findings: &mut Findings,
) {
    let sample = sample(moving);
    let mut fitter = Fitter { model: &subject.model, sample: &sample, settings, left_out: Vec::new() };
    for _ in 0..MOST {
        let Some((name, away)) = fitter.farthest() else { return };
        let (distance, way) = (away.norm(), way(away));
        let message = format!(
            "marker `{name}` is {:.0} mm further {way} on the body than in the standing trial, while the other markers \
             agree: it moved, or was put on anew, between the two recordings. hint: check photographs or records; \
             without the standing trial the body follows the markers of the motion",
            1e3 * distance
        );
        findings.report(Code::MarkersMoved, message);
        contradictions.push(format!("marker `{name}` moved by {:.0} mm since the standing trial", 1e3 * distance));
        fitter.left_out.push(name);
    }
}

/// The direction of a displacement in the axes of a segment: forward, up, right.
fn way(away: Vec3) -> &'static str {
    const WAYS: [[&str; 2]; 3] = [["forward", "backward"], ["up", "down"], ["to the right", "to the left"]];
    let axis = away.iamax();
    WAYS[axis][usize::from(away[axis] < 0.0)]
}

/// Frames spread over a recording.
fn sample(recording: &MarkerRecording) -> MarkerRecording {
    let step = recording.frames().div_ceil(FRAMES).max(1);
    let path = |path: &MarkerPath| MarkerPath {
        name: path.name.clone(),
        positions: path.positions.iter().copied().step_by(step).collect(),
    };
    MarkerRecording {
        name: recording.name.clone(),
        rate_hz: recording.rate_hz / step as f64,
        times: recording.times.iter().copied().step_by(step).collect(),
        markers: recording.markers.iter().map(path).collect(),
    }
}

struct Fitter<'a> {
    model: &'a Model,
    sample: &'a MarkerRecording,
    settings: &'a FitSettings,
    /// Markers that are known to have moved.
    left_out: Vec<String>,
}

impl Fitter<'_> {
    /// The markers of pelvis and legs that the sample has.
    fn markers(&self) -> impl Iterator<Item = &Marker> {
        let anatomy = self.model.anatomy();
        let legs = anatomy.legs();
        let bodies: Vec<_> = legs
            .values()
            .flatten()
            .flat_map(|leg| [leg.thigh, leg.shank, leg.foot])
            .chain(legs.values().flatten().filter_map(|leg| self.model.bodies()[leg.hip.index()].joint.parent))
            .collect();
        let is_own = move |marker: &&Marker| marker.body.is_some_and(|body| bodies.contains(&body));
        let is_seen = |marker: &&Marker| {
            let path = self.sample.marker(&marker.name);
            path.is_some_and(|path| 2 * (0..path.positions.len()).filter(|f| path.is_seen(*f)).count() > self.sample.frames())
        };
        self.model.markers().iter().filter(is_own).filter(is_seen)
    }

    /// The marker that moved furthest, with the displacement in the axes of its segment [m].
    fn farthest(&self) -> Option<(String, Vec3)> {
        let with_all = self.distances(None)?;
        let moved = self.markers().filter(|marker| !self.left_out.contains(&marker.name)).filter_map(|marker| {
            let own = *with_all.get(&marker.name)?;
            let away = *self.distances(Some(&marker.name))?.get(&marker.name)?;
            let contradicted = own.dot(&away).max(0.0).sqrt();
            if std::env::var("AMBULO_DEBUG_MOVED").is_ok() {
                eprintln!("MOVED {} own {:.0} {:.0} {:.0} away {:.0} {:.0} {:.0} |{:.0}| contra {:.0}", marker.name, 1e3*own.x,1e3*own.y,1e3*own.z,1e3*away.x,1e3*away.y,1e3*away.z, 1e3*away.norm(), 1e3*contradicted);
            }
            (away.norm() > MOVED_M && contradicted > CONTRADICTED_M).then(|| (marker.name.clone(), away, contradicted))
        });
        let worst = moved.max_by(|a, b| a.2.total_cmp(&b.2));
        worst.map(|(name, away, _)| (name, away))
    }

    /// Median displacement of each marker from its place, in the axes of its segment [m], when one of them is left out.
    fn distances(&self, left_out: Option<&str>) -> Option<BTreeMap<String, Vec3>> {
        let is_used = |marker: &&Marker| {
            Some(marker.name.as_str()) != left_out && !self.left_out.contains(&marker.name)
        };
        let mut weights: BTreeMap<String, f64> =
            self.model.markers().iter().map(|marker| (marker.name.clone(), 0.0)).collect();
        weights.extend(self.markers().filter(is_used).map(|marker| (marker.name.clone(), 1.0)));
        let settings = FitSettings { weights, outliers: OutlierDetection::Off, ..self.settings.clone() };
        let fit = fit_markers(self.model, self.sample, &settings, &mut Findings::default()).ok()?;
        let mut seen: BTreeMap<String, Vec<Vec3>> = BTreeMap::new();
        for frame in 0..self.sample.frames() {
            let value = |id: crate::model::CoordinateId| {
                let own = fit.motion.column(id).map(|column: &[f64]| column[frame]);
                own.unwrap_or(self.model.coordinates()[id.index()].default_value)
            };
            let q: Vec<f64> = self.model.coordinate_ids().map(value).collect();
            if q.iter().any(|value| !value.is_finite()) {
                continue;
            }
            let rest = vec![0.0; q.len()];
            let poses = body_motion(self.model, Posture { q: &q, qd: &rest, qdd: &rest });
            for marker in self.markers() {
                let Some(path) = self.sample.marker(&marker.name).filter(|path| path.is_seen(frame)) else { continue };
                let pose = poses[marker.body.map_or(0, |body| body.index())].pose;
                let away = pose.rotation.transpose() * (path.positions[frame] - pose.place(marker.location));
                seen.entry(marker.name.clone()).or_default().push(away);
            }
        }
        let middle = |list: Vec<Vec3>| {
            let axis = |axis: usize| median(list.iter().map(|away| away[axis])).unwrap_or(0.0);
            Vec3::new(axis(0), axis(1), axis(2))
        };
        Some(seen.into_iter().map(|(name, list)| (name, middle(list))).collect())
    }
}
