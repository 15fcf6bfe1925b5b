//! Markers that moved between the standing trial and the motion.
//!
//! The body of the standing trial is fitted to frames of the motion with the markers of pelvis and legs, once with all
//! of them and once without each. A marker that moved by d is then d from its place on the body, while the others come
//! nearer to theirs. With r the mean distance in the axes of the segment, with all markers, and r₀ that without this
//! one, the sum of squares of the fit falls by r · r₀ (least squares; Cook and Weisberg 1982, unverified), so that
//!
//!   d = |r₀| > [`MOVED_M`]    and    √(r · r₀) > [`CONTRADICTED_M`]
//!
//! with [`MOVED_SKIN_M`] for markers of the pelvis, where soft tissue lies under the skin, and for those that show no
//! joint.
//!
//! A displacement along a limb changes its length by d, a displacement across it only in the second order. The whole
//! body is therefore fitted, and distances alone are not used.

use super::super::subject::Subject;
use super::Contradictions;
use crate::findings::{Code, Findings};
use crate::kinematics::marker_fit::{FitSettings, OutlierDetection, fit_markers};
use crate::kinematics::{Posture, body_motion};
use crate::model::{CoordinateId, Marker, Model};
use crate::motion::{MarkerPath, MarkerRecording};
use crate::numerics::{Order, median};
use crate::spatial::Vec3;
use std::collections::BTreeMap;

/// A marker further than this from its place has moved [m]: skin slides by 10 to 20 mm on the mean of a walk.
const MOVED_M: f64 = 0.025;
/// The same where skin slides further: 30 mm at the pelvis.
const MOVED_SKIN_M: f64 = 0.035;
/// How far the other markers must contradict it [m].
const CONTRADICTED_M: f64 = 0.017;
/// Markers that are nearer to their place than this in the common fit are not tested [m]: √(r · r₀) is larger than
/// [`CONTRADICTED_M`] only if r is, or if the marker determines the body almost alone.
const SUSPICIOUS_M: f64 = 0.008;
/// Largest number of markers that are tested: the ones furthest from their places.
const MOST_ASKED: usize = 4;
/// Frames of the motion, spread over it.
const FRAMES: usize = 12;
/// If this many markers seem to have moved, the body is another person's, or all markers were put on again.
pub(super) const ANOTHER_PERSON: usize = 3;

/// The markers of legs and pelvis that moved, each with distance and direction; no more than show another person.
pub(in crate::analysis) fn moved(subject: &Subject, moving: &MarkerRecording, settings: &FitSettings) -> Vec<String> {
    let sample = moving.sample(FRAMES);
    let mut fitter = Fitter { subject, sample: &sample, settings, left_out: Vec::new() };
    let mut moved = Vec::new();
    while moved.len() < ANOTHER_PERSON {
        let Some((name, away)) = fitter.farthest() else { break };
        moved.push(format!("`{name}` {:.0} mm {}", 1e3 * away.norm(), way(away)));
        fitter.left_out.push(name);
    }
    moved
}

/// Reports markers that moved: one or two of them, or so many that the body is another person's.
pub(in crate::analysis) fn report_moved(
    moved: &[String],
    contradictions: &mut Contradictions,
    findings: &mut Findings,
) {
    let (code, what) = match moved.len() < ANOTHER_PERSON {
        true => (Code::MarkersMoved, "the other markers agree: moved, or put on anew, between the two recordings"),
        false => (
            Code::CalibrationOtherLimbs,
            "the standing trial is that of another person, or its markers were put on anew",
        ),
    };
    let listed = moved.join(", ");
    let message = format!(
        "on the body, markers of the recording are not where those of the standing trial were: {listed}; {what}. hint: \
         give the standing trial of these markers; without one the body follows the markers of the recording"
    );
    findings.report(code, message);
    contradictions.push(format!("markers that moved since the standing trial: {listed}"));
}

/// The direction of a displacement in the axes of a segment: forward, up, right.
fn way(away: Vec3) -> &'static str {
    const WAYS: [[&str; 2]; 3] =
        [["further forward", "further backward"], ["higher", "lower"], ["to the right", "to the left"]];
    let axis = away.iamax();
    WAYS[axis][usize::from(away[axis] < 0.0)]
}

struct Fitter<'a> {
    subject: &'a Subject,
    sample: &'a MarkerRecording,
    settings: &'a FitSettings,
    /// Markers that are known to have moved.
    left_out: Vec<String>,
}

impl Fitter<'_> {
    fn model(&self) -> &Model {
        &self.subject.model
    }

    /// From which distance a marker has moved [m].
    fn limit_m(&self, name: &str) -> f64 {
        let anatomy = self.model().anatomy();
        let marker = self.model().markers().iter().find(|marker| marker.name == name);
        let is_on_pelvis = marker.is_some_and(|marker| marker.body == anatomy.pelvis());
        // Markers that define joints have the weight 1.
        let is_at_joint = self.subject.weights.get(name).is_none_or(|weight| *weight >= 1.0);
        if is_on_pelvis || !is_at_joint { MOVED_SKIN_M } else { MOVED_M }
    }

    /// The markers of pelvis and legs that the sample has.
    fn markers(&self) -> impl Iterator<Item = &Marker> {
        let anatomy = self.model().anatomy();
        let legs = anatomy.legs();
        let bodies: Vec<_> = legs
            .values()
            .flatten()
            .flat_map(|leg| [leg.thigh, leg.shank, leg.foot])
            .chain(legs.values().flatten().filter_map(|leg| self.model().bodies()[leg.hip.index()].joint.parent))
            .collect();
        let is_own = move |marker: &&Marker| marker.body.is_some_and(|body| bodies.contains(&body));
        let is_seen = |marker: &&Marker| {
            let path = self.sample.marker(&marker.name);
            path.is_some_and(|path| {
                2 * (0..path.positions.len()).filter(|f| path.is_seen(*f)).count() > self.sample.frames()
            })
        };
        self.model().markers().iter().filter(is_own).filter(is_seen)
    }

    /// The marker that moved furthest, with the displacement in the axes of its segment [m].
    fn farthest(&self) -> Option<(String, Vec3)> {
        let with_all = self.distances(None)?;
        let mut suspicious: Vec<(&String, Vec3)> = with_all
            .iter()
            .filter(|(name, own)| own.norm() > SUSPICIOUS_M && !self.left_out.contains(name))
            .map(|(name, own)| (name, *own))
            .collect();
        suspicious.sort_by_number(|(_, moved)| -moved.norm());
        let moved = suspicious.into_iter().take(MOST_ASKED).filter_map(|(name, own)| {
            let away = *self.distances(Some(name))?.get(name)?;
            let contradicted = own.dot(&away).max(0.0).sqrt();
            // Of two candidates the one that stands against the others by itself: a toe shows the ankle angle almost
            // alone, so that it is far away when another marker of the foot moved.
            let rank = own.dot(&away) / away.norm();
            (away.norm() > self.limit_m(name) && contradicted > CONTRADICTED_M).then(|| (name.clone(), away, rank))
        });
        let worst = moved.max_by(|a, b| a.2.total_cmp(&b.2));
        worst.map(|(name, away, _)| (name, away))
    }

    /// Median displacement of each marker from its place, in the axes of its segment [m], when one of them is left out.
    fn distances(&self, left_out: Option<&str>) -> Option<BTreeMap<String, Vec3>> {
        let is_used =
            |marker: &&Marker| Some(marker.name.as_str()) != left_out && !self.left_out.contains(&marker.name);
        let mut weights: BTreeMap<String, f64> =
            self.model().markers().iter().map(|marker| (marker.name.clone(), 0.0)).collect();
        weights.extend(self.markers().filter(is_used).map(|marker| (marker.name.clone(), 1.0)));
        let settings = FitSettings { weights, outliers: OutlierDetection::Off, ..self.settings.clone() };
        let fit = fit_markers(self.model(), self.sample, &settings, &mut Findings::default()).ok()?;
        let own: Vec<(&Marker, &MarkerPath)> =
            self.markers().filter_map(|marker| Some((marker, self.sample.marker(&marker.name)?))).collect();
        let mut seen: BTreeMap<String, Vec<Vec3>> = BTreeMap::new();
        for frame in 0..self.sample.frames() {
            let value = |id: CoordinateId| {
                let own = fit.motion.column(id).map(|column: &[f64]| column[frame]);
                own.unwrap_or(self.model().coordinates()[id.index()].default_value)
            };
            let q: Vec<f64> = self.model().coordinate_ids().map(value).collect();
            if q.iter().any(|value| !value.is_finite()) {
                continue;
            }
            let rest = vec![0.0; q.len()];
            let poses = body_motion(self.model(), Posture { q: &q, qd: &rest, qdd: &rest });
            for (marker, path) in own.iter().filter(|(_, path)| path.is_seen(frame)) {
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
