//! Positions of the feet from their markers, and their stances.

use super::super::foot_motion::FootMotion;
use crate::model::Side;
use crate::motion::{Landmarks, MarkerRecording, PlateRecording};
use crate::numerics::elementary::hypot;
use crate::spatial::{Vec3, level_distance};

/// The foot reaches this share of the distance from heel to toe marker beyond the toe marker.
const BEYOND_TOE: f64 = 0.2;
/// A marker further than this beyond an edge is off the plate [m]; heel markers are behind the heel.
pub(super) const OVER_EDGE_M: f64 = 0.02;
/// Heights above a plate of the lower one of heel and toe marker while the foot is on the plate [m]. A foot on the next
/// step of stairs is outside: steps are at least 0.15 m high.
const ON_PLATE_M: [f64; 2] = [-0.08, 0.14];

/// Markers, the feet that they belong to, and the events that were detected from them.
pub(crate) struct FeetInMotion<'a> {
    /// The markers.
    pub markers: &'a MarkerRecording,
    /// Landmarks of the feet among the markers.
    pub landmarks: Landmarks,
    /// Their strikes and offs.
    pub motion: &'a FootMotion,
}

impl FeetInMotion<'_> {
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

    /// Distance of a point on a plate from the foot [m]: along the ground, and by how much the foot is too high or too
    /// low for the plate.
    pub(super) fn distance(&self, side: Side, point: Vec3, plate: &PlateRecording, time_s: f64) -> Option<f64> {
        let line = self.line(side, time_s)?;
        let [heel, toe] = line;
        let foot = [heel, heel + (toe - heel) * (1.0 + BEYOND_TOE)];
        Some(hypot(level_distance(point, foot, plate.up), off_level_m(&line, plate)))
    }

    /// Distance of a point from the foot along the ground [m].
    pub(super) fn level_distance(&self, side: Side, point: Vec3, up: Vec3, time_s: f64) -> Option<f64> {
        let [heel, toe] = self.line(side, time_s)?;
        Some(level_distance(point, [heel, heel + (toe - heel) * (1.0 + BEYOND_TOE)], up))
    }

    /// Direction from heel to toe along the ground, a unit vector.
    pub(super) fn direction(&self, side: Side, up: Vec3, time_s: f64) -> Option<Vec3> {
        let [heel, toe] = self.line(side, time_s)?;
        let along = (toe - heel) - up * up.dot(&(toe - heel));
        along.try_normalize(1e-6)
    }

    /// A place near the mass centre: the middle of the pelvis or, without its markers, of all markers [m].
    pub(super) fn body_center(&self, time_s: f64) -> Option<Vec3> {
        let mean = |markers: &[usize]| {
            let seen: Vec<Vec3> = markers.iter().filter_map(|marker| self.place(Some(*marker), time_s)).collect();
            (!seen.is_empty()).then(|| seen.iter().sum::<Vec3>() / seen.len() as f64)
        };
        mean(&self.landmarks.pelvis()).or_else(|| mean(&(0..self.markers.markers.len()).collect::<Vec<_>>()))
    }

    /// Whether the foot is over the plate, at the height of a foot that stands on it.
    pub(super) fn is_on(&self, side: Side, plate: &PlateRecording, time_s: f64) -> bool {
        let Some(line) = self.line(side, time_s) else { return false };
        let is_over = line.iter().any(|p| plate.depth_inside(*p) > OVER_EDGE_M);
        is_over && off_level_m(&line, plate) == 0.0 && self.stands(side, time_s)
    }

    /// How many of heel and toe are over the plate, at the height of a foot that stands on it.
    pub(super) fn ends_inside(&self, side: Side, plate: &PlateRecording, time_s: f64) -> usize {
        let Some(line) = self.line(side, time_s).filter(|line| off_level_m(line, plate) == 0.0) else { return 0 };
        line.iter().filter(|end| plate.depth_inside(**end) > OVER_EDGE_M).count()
    }

    fn stands(&self, side: Side, time_s: f64) -> bool {
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

/// Distance of the lower end of a foot above or below the heights of a foot on the plate [m].
fn off_level_m(line: &[Vec3; 2], plate: &PlateRecording) -> f64 {
    let height = |p: &Vec3| (p - plate.center()).dot(&plate.up);
    let lower = height(&line[0]).min(height(&line[1]));
    let [lowest, highest] = ON_PLATE_M;
    (lowest - lower).max(lower - highest).max(0.0)
}
