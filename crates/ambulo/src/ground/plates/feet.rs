//! Positions of the feet from their markers, and their stances.

use super::super::foot_motion::FootMotion;
use crate::model::Side;
use crate::motion::{Landmarks, MarkerRecording};
use crate::spatial::Vec3;

/// The foot reaches this share of the distance from heel to toe marker beyond the toe marker.
const BEYOND_TOE: f64 = 0.2;

/// Markers, the feet that they belong to, and the events that were detected from them.
pub(super) struct Feet<'a> {
    pub(super) markers: &'a MarkerRecording,
    pub(super) landmarks: Landmarks,
    pub(super) motion: &'a FootMotion,
}

impl Feet<'_> {
    /// Position of a marker at a time, interpolated linearly between frames.
    pub(super) fn place(&self, marker: Option<usize>, time_s: f64) -> Option<Vec3> {
        let path = &self.markers.markers[marker?].positions;
        let times = &self.markers.times;
        let next = times.partition_point(|&t| t <= time_s);
        let i = next.checked_sub(1)?;
        let j = next.min(times.len() - 1);
        let share = if j > i { (time_s - times[i]) / (times[j] - times[i]) } else { 0.0 };
        let place = path[i] * (1.0 - share) + path[j] * share;
        (place.iter().all(|x| x.is_finite()) && share <= 1.0).then_some(place)
    }

    /// Heel and toe markers, or their substitutes (ankle, side of the foot).
    pub(super) fn line(&self, side: Side, time_s: f64) -> Option<[Vec3; 2]> {
        let foot = self.landmarks.foot(side);
        let heel = self.place(foot.heel.or(foot.ankle), time_s)?;
        let toe = self.place(foot.toe.or(foot.side), time_s)?;
        Some([heel, toe])
    }

    /// Distance of a point from the foot along the ground [m].
    pub(super) fn distance(&self, side: Side, point: Vec3, up: Vec3, time_s: f64) -> Option<f64> {
        let [heel, toe] = self.line(side, time_s)?;
        let level = |v: Vec3| v - up * v.dot(&up);
        let along = level(toe - heel) * (1.0 + BEYOND_TOE);
        let to = level(point - heel);
        let share = (to.dot(&along) / along.norm_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        Some((to - along * share).norm())
    }

    pub(super) fn stands(&self, side: Side, time_s: f64) -> bool {
        self.stances(side).iter().any(|s| s[0] <= time_s && time_s <= s[1])
    }

    /// Stances of the foot, detected from its motion [s].
    pub(super) fn stances(&self, side: Side) -> Vec<[f64; 2]> {
        let (Some(&first), Some(&last)) = (self.markers.times.first(), self.markers.times.last()) else {
            return Vec::new();
        };
        self.motion.contacts_of(side).iter().map(|c| c.span(first, last)).collect()
    }

    /// The stance that overlaps a contact most.
    pub(super) fn stance_of(&self, side: Side, span: [f64; 2]) -> Option<[f64; 2]> {
        let overlap = |s: &[f64; 2]| s[1].min(span[1]) - s[0].max(span[0]);
        let stances = self.stances(side).into_iter().filter(|s| overlap(s) > 0.0);
        stances.max_by(|a, b| overlap(a).total_cmp(&overlap(b)))
    }
}
